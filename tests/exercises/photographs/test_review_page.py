"""The review page: what a teacher drags, types and exports is what the command takes; nobody's way is barred."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from chromium import chromium
from playwright.sync_api import Browser, Page

from graphcam.exercises.photographs.corrections import kept_corrections
from graphcam.exercises.reports.unrolled_drawings import key_line

pytestmark = pytest.mark.slow

NAME = "pitch"
CLARA = "<b>Clara</b>"
WINDOWS = {"desk": (1440, 900), "phone": (390, 844)}


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    with chromium() as started:
        yield started


@pytest.fixture
def opened(browser: Browser) -> Iterator:
    """Opens a page; at the end nothing may have gone wrong, and nothing have been asked for elsewhere."""
    contexts, wrong = [], []

    def opened(path: Path, window: str = "desk", scheme: str = "light") -> Page:
        width, height = WINDOWS[window]
        # axe-core is put into the page, which the page forbids to all others.
        context = browser.new_context(
            viewport={"width": width, "height": height}, color_scheme=scheme, bypass_csp=True, accept_downloads=True
        )
        contexts.append(context)
        page = context.new_page()
        page.on("console", lambda said: wrong.append(said.text))
        page.on("pageerror", lambda error: wrong.append(str(error)))
        own = (path.as_uri(), "data:", "blob:")
        page.on("request", lambda asked: None if asked.url.startswith(own) else wrong.append(asked.url))
        page.goto(path.as_uri())
        return page

    yield opened
    for context in contexts:
        context.close()
    assert wrong == []


def dense(course, student: str) -> np.ndarray:
    return key_line(course.key(student).keys[NAME].expected)[:-1]


@pytest.fixture
def review(course) -> Path:
    """Anna has it right, of Boris too little is seen, Clara's is foreign; one photograph is nobody's."""
    refused = {"why": "60 % of the curve can be seen", "remedy": "draw over it", "share": 0.6}
    course.keep(
        course.photograph("Anna", course.reading("Anna", dense(course, "Anna"))),
        course.photograph("Boris", course.reading("Boris", dense(course, "Boris")[:90], **refused)),
        course.photograph(CLARA, course.reading(CLARA, 1.4 * dense(course, CLARA))),
        course.photograph("", None, "nobody.jpg", page=0, why="the QR code cannot be seen", remedy="take it in"),
    )
    path = course.place.parent / "review.html"
    course.read(review=path)
    return path


def exported(page: Page, course) -> Path:
    with page.expect_download() as found:
        page.get_by_role("button", name="Export corrections").click()
    file = course.place.parent / "exported.json"
    found.value.save_as(file)
    assert found.value.suggested_filename == "photo-corrections.json"
    return file


def of(page: Page, student: str):
    return page.locator("article", has=page.get_by_role("heading", name=student))


@pytest.mark.parametrize(
    ("window", "scheme"),
    [
        ("desk", "light"),
        ("phone", "dark"),
        pytest.param("desk", "dark", marks=pytest.mark.slow),
        pytest.param("phone", "light", marks=pytest.mark.slow),
    ],
)
def test_axe_core_finds_nothing_and_nothing_sticks_out(review, opened, window, scheme):
    page = opened(review, window, scheme)
    page.get_by_label("Show the right drawing").check()
    page.locator("summary").click()
    of(page, "Anna").get_by_label("across, 250 mm").fill("200")
    found = Axe().run(page).response["violations"]
    assert [f"{each['id']}: {[node['target'] for node in each['nodes']]}" for each in found] == []
    assert page.evaluate("document.documentElement.scrollWidth") == WINDOWS[window][0]


def test_each_student_has_a_row_with_what_became_of_the_drawing(review, opened):
    page = opened(review)
    # What lies beyond the window is not laid out yet, so it has no inner text.
    assert [" ".join(text.split()) for text in page.locator("article h2").all_text_contents()] == [
        "Anna read",
        "Boris to check",
        f"{CLARA} to check",
    ]
    assert "60 % of the curve can be seen; draw over it" in of(page, "Boris").inner_text()
    assert "every usual mistake" in (of(page, "Clara").text_content() or "")
    assert "nobody.jpg: the QR code cannot be seen; take it in" in page.locator("main").inner_text()
    page.get_by_label("Only what needs checking").check()
    assert not of(page, "Anna").is_visible()
    assert of(page, "Boris").is_visible()
    # The right curve is not in the way of a look at the pencil.
    assert page.locator(".right path").count() == 0
    page.get_by_label("Show the right drawing").check()
    assert page.locator(".right path").count() > 0


def test_nothing_changed_exports_nothing(review, opened, course):
    said = json.loads(exported(opened(review), course).read_text())
    assert said == {"format": 1, "exercise": course.exercise.name, "students": {}}


def test_arrow_keys_move_a_point_by_a_tenth_and_its_neighbours_less(review, opened, course):
    page = opened(review)
    of(page, "Anna").locator(".board").focus()
    for key in ("Home", "ArrowRight", "ArrowRight", "Shift+ArrowUp"):
        page.keyboard.press(key)
    points = np.round(dense(course, "Anna"), 3)
    x, y = points[0].real + 0.2, points[0].imag + 1.0
    said = of(page, "Anna").locator("output").inner_text().replace("−", "-")
    assert said == f"pitch: point 1 of {points.size} at x {x:.2f}, y {y:.2f} mm"
    corrections = json.loads(exported(page, course).read_text())["students"]
    assert list(corrections) == ["Anna"]
    one = corrections["Anna"]["answers"][NAME]
    assert one["verdict"] == "corrected"
    moved = np.array(one["value"]) @ [1, 1j] - points
    assert moved[0] == pytest.approx(0.2 + 1.0j, abs=1e-3)
    far = np.abs(points - points[0]) > 10
    assert np.abs(moved[far]).max() < 1e-6
    near = (np.abs(points - points[0]) < 9) & (np.arange(points.size) > 0)
    assert ((np.abs(moved[near]) > 0) & (np.abs(moved[near]) < 1.02)).all()


def test_what_is_dragged_typed_and_confirmed_is_taken_and_comes_back(review, opened, course):
    page = opened(review)
    anna = of(page, "Anna")
    anna.locator(".board svg").scroll_into_view_if_needed()
    box = anna.locator(".board svg").bounding_box()
    point = dense(course, "Anna")[40]
    scale = min(box["width"], box["height"]) / 232
    start = (box["x"] + box["width"] / 2 + scale * point.real, box["y"] + box["height"] / 2 - scale * point.imag)
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move(start[0] + 5 * scale, start[1], steps=4)
    page.mouse.up()
    first = course.exercise.answers[0].name
    anna.locator(f"[data-number={first}]").fill("12,75")
    anna.get_by_label("across, 250 mm").fill("251.5")
    of(page, "Boris").get_by_label("What counts").select_option("left out")
    of(page, "Clara").get_by_label("What counts").select_option("confirmed")
    of(page, "Clara").get_by_label("Done with").check()
    assert page.locator("#progress").inner_text() == "1 of 3 done"
    found = course.read(corrections=exported(page, course), review=review)
    by_student = {one.student: one for one in found.students}
    status = {student: one.answers[-1].status for student, one in by_student.items()}
    assert status == {"Anna": "corrected", "Boris": "left out", CLARA: "confirmed"}
    assert by_student["Anna"].values()[first] == 12.75
    moved = np.asarray(by_student["Anna"].answers[-1].points) - np.round(dense(course, "Anna"), 3)
    assert np.abs(moved).max() == pytest.approx(5, abs=0.15)
    again = opened(review)
    assert of(again, "Anna").locator(f"[data-number={first}]").input_value() == "12.75"
    assert of(again, "Anna").get_by_label("What counts").input_value() == "corrected"
    # Exported again without a change, the corrections are the same.
    kept = kept_corrections(course.place / "teacher", course.exercise, by_student)
    before = {student: one.bars for student, one in kept.items()}
    course.read(corrections=exported(again, course))
    kept = kept_corrections(course.place / "teacher", course.exercise, by_student)
    assert (
        {student: one.bars for student, one in kept.items()}
        == before
        == {"Anna": {2: (251.5, None)}, "Boris": {}, CLARA: {}}
    )
    # As it was read: what was kept goes.
    of(again, "Anna").get_by_role("button", name="As read").click()
    of(again, "Anna").get_by_label("across, 250 mm").fill("")
    of(again, "Anna").locator(f"[data-number={first}]").fill("")
    found = course.read(corrections=exported(again, course))
    assert found.students[0].answers[-1].status == "read"
    assert list(found.students[0].values()) == [NAME]


@pytest.mark.parametrize(("field", "typed", "why"), [
    ("across, 250 mm", "225", "measure again: from 242.5 to 257.5 mm"),
    ("s_8 [mm]", "12 mm", "not a number"),
])  # fmt: skip
def test_what_cannot_be_is_said_at_once_and_not_exported(review, opened, field, typed, why):
    page = opened(review)
    box = of(page, "Anna").get_by_label(field, exact=True)
    box.fill(typed)
    assert why in of(page, "Anna").get_by_role("alert").all_inner_texts()[0] or why in of(page, "Anna").inner_text()
    assert box.get_attribute("aria-invalid") == "true"
    page.get_by_role("button", name="Export corrections").click()
    assert box.evaluate("field => field === document.activeElement")


def test_points_are_added_and_removed(plotted, opened):
    right = plotted.right("Anna")
    plotted.keep(plotted.photograph("Anna", plotted.reading("Anna", right[:-1])))
    review = plotted.place.parent / "review.html"
    plotted.read(review=review)
    page = opened(review)
    assert f"{right.size - 1} of {right.size} points are seen" in of(page, "Anna").inner_text()
    of(page, "Anna").get_by_role("button", name="Add a point").click()
    for key, count in (("ArrowUp", 3), ("Shift+ArrowRight", 2)):
        for _ in range(count):
            page.keyboard.press(key)
    said = json.loads(exported(page, plotted).read_text())["students"]["Anna"]["answers"]["rollers"]
    assert len(said["value"]) == right.size
    assert said["value"][-1] == pytest.approx([2.0, 0.3])
    page.keyboard.press("Tab")
    of(page, "Anna").locator(".board").focus()
    page.keyboard.press("Home")
    page.keyboard.press("Delete")
    said = json.loads(exported(page, plotted).read_text())["students"]["Anna"]["answers"]["rollers"]
    assert len(said["value"]) == right.size - 1
    assert said["value"][0] == pytest.approx([round(right[1].real, 3), round(right[1].imag, 3)])


def test_larger_shows_the_surroundings_of_the_chosen_point(review, opened):
    page = opened(review)
    anna = of(page, "Anna")
    frame = anna.locator("svg").get_attribute("viewBox")
    anna.get_by_role("button", name="Next point").click()
    anna.get_by_role("button", name="Larger").click()
    width = [float(box.split()[2]) for box in (frame, anna.locator("svg").get_attribute("viewBox"))]
    assert width[0] / width[1] == pytest.approx(4)
    anna.get_by_role("button", name="Larger").click()
    assert float(anna.locator("svg").get_attribute("viewBox").split()[2]) == width[0]
