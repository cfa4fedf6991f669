"""Views, steps and parts, the pinned cam, phases, the board: what is shown, and that it is what the engine said."""

from __future__ import annotations

from html import unescape

import pytest
from studio_pages import settled, task_of
from studio_tasks import plain_task

from graphcam.studio.studio_page import SCRIPT_FILES, page as page_of
from graphcam.studio.worker_page import first_answer

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("name", ["arcs", "measured", "swinging-face"])
def test_every_view_of_a_task_is_drawn_large_and_small(opened, name):
    page = opened(name)
    names = page.evaluate("() => studio.shown.names.map((each) => each.name)")
    assert len(names) >= 6
    for view in names:
        page.evaluate("name => studio.open(name)", view)
        settled(page)
        drawn = page.evaluate("() => [...document.querySelectorAll('#steps > g')].map((g) => g.dataset.group)")
        assert drawn == page.evaluate("() => studio.shown.views[0].order")
        assert page.locator("#steps path").count() > 0
        # What is drawn lies in the frame.
        assert page.evaluate("""() => { const box = document.getElementById("steps").getBBox(),
            frame = document.getElementById("drawing").viewBox.baseVal;
            return box.x >= frame.x - 1 && box.y >= frame.y - 1 && box.x + box.width <= frame.x + frame.width + 1
                && box.y + box.height <= frame.y + frame.height + 1; }""")
        assert page.locator(f"[id='view-{view}'] path").count() > 0
    page.locator("#view-mechanism").click()
    settled(page)
    assert page.locator("#scene .body").is_visible()


def test_steps_and_their_parts_appear_one_by_one(opened):
    page = opened()
    page.keyboard.press("Home")
    assert page.locator("#counter").inner_text() == "1 / 8"
    assert page.locator("#steps > .later").count() == 7
    page.keyboard.press("ArrowRight")
    assert page.locator("#counter").inner_text() == "2.1 / 8"
    assert page.locator("#panel-step .parts [aria-current]").count() == 1
    shown = page.locator("#steps > .current > :not(.later)").count()
    page.keyboard.press("ArrowRight")
    assert page.locator("#counter").inner_text() == "2.2 / 8"
    assert page.locator("#steps > .current > :not(.later)").count() > shown
    page.locator(".whole-step").click()
    assert page.locator("#counter").inner_text() == "2 / 8"
    assert page.locator("#steps > .current > .later").count() == 0


def test_a_step_is_kept_by_its_name_when_sizes_change(opened):
    page = opened()
    for _ in range(3):
        page.keyboard.press("Shift+ArrowLeft")
    title = page.locator("#panel-step .name").inner_text()
    page.evaluate("() => studio.change({ 'motion.phases[0].angle': 70, 'motion.phases[1].angle': 55 })")
    settled(page)
    assert page.locator("#panel-step .name").inner_text() == title
    assert page.locator("#counter").inner_text() == "5 / 8"


def test_a_reading_lights_its_marks(opened):
    page = opened()
    for _ in range(3):
        page.keyboard.press("Shift+ArrowLeft")
    reading = page.locator("#panel-step dl > [data-lit]").first
    assert " × " in reading.inner_text()
    reading.hover()
    assert page.locator("#steps .pointed").count() > 0
    page.locator("header").hover()
    assert page.locator("#steps .pointed").count() == 0


def test_the_pinned_cam_stands_behind_with_its_curves_alone(opened, served):
    page = opened()
    page.keyboard.press("8")
    settled(page)
    page.keyboard.press("p")
    page.evaluate("() => studio.change({ 'follower.offset': 6 })")
    settled(page)
    seen = page.evaluate(
        """() => [...document.querySelectorAll("#pinned > g > *")].filter((e) => getComputedStyle(e).display !== "none")
        .map((e) => [...e.classList].find((name) => ["curve", "result", "limit"].includes(name)))"""
    )
    assert seen
    assert None not in seen
    # It is drawn with the scales of the present one, and behind it.
    asked = [each for each in served.asked if each["task"]["follower"]["offset"] == -10 and each["hold"]]
    assert asked
    assert page.evaluate("() => document.getElementById('pinned').nextElementSibling.id") == "steps"
    page.locator("#tab-values").click()
    cells = page.locator(".compare .pin").all_inner_texts()
    assert "−10.000 mm" in [" ".join(cell.split()) for cell in cells]
    page.keyboard.press("p")
    assert page.locator("#pinned > g").count() == 0
    assert page.locator("#told-pin").is_hidden()


def test_phases_are_chosen_changed_added_and_taken_away(opened):
    page = opened()
    page.locator("[data-key='phase/0']").click()
    page.locator("[data-key='phase-law']").select_option("cycloidal")
    settled(page)
    assert task_of(page)["motion"]["phases"][0]["law"] == "cycloidal"
    page.locator("[data-key='phase-angle_of_phase']").fill("70")
    page.keyboard.press("Enter")
    settled(page)
    assert [phase["angle"] for phase in task_of(page)["motion"]["phases"]] == [70, 55, 60, 175]
    page.locator("[data-key='edit-step']").click()
    settled(page)
    assert [phase["kind"] for phase in task_of(page)["motion"]["phases"]][:3] == ["rise", "dwell", "rise"]
    page.locator("[data-key='phase/1']").click()
    page.locator("[data-key='edit-remove']").click()
    settled(page)
    phases = task_of(page)["motion"]["phases"]
    assert len(phases) == 5
    assert sum(phase["angle"] for phase in phases) == 360


def test_a_phase_has_its_fields_once_also_in_another_form(opened):
    """Of another follower, or while sizes are locked, the form is made anew about the bar of phases."""
    page = opened()
    page.locator("[data-key='phase/0']").click()
    for kind in ("flat-faced", "translating"):
        page.locator("[data-key='follower.kind']").select_option(kind)
        settled(page)
        assert page.locator("[data-key='phase-lift']").count() == 1
        assert page.locator(".phase-editor [data-key='phase-law']").count() == 1


def test_a_border_of_phases_is_drawn_to_whole_fives(opened):
    page = opened()
    box = page.locator(".phase-bar").bounding_box()
    assert box
    turn = box["width"] / 360
    y = box["y"] + box["height"] + 10
    page.mouse.move(box["x"] + 80 * turn, y)
    page.mouse.down()
    page.mouse.move(box["x"] + 97 * turn, y, steps=8)
    page.mouse.move(box["x"] + 100.4 * turn, y)
    page.mouse.up()
    settled(page)
    assert [phase["angle"] for phase in task_of(page)["motion"]["phases"]] == [100, 25, 60, 175]
    assert page.evaluate("() => studio.state.past()") == 1


def test_another_kind_of_follower_takes_its_own_sizes(opened):
    page = opened()
    page.locator("[id='size-follower-kind']").select_option(label="flat-faced")
    settled(page)
    assert task_of(page)["follower"] == {"kind": "flat-faced"}
    assert page.locator("[id='size-limits-min_curvature_radius']").count() == 1
    page.locator("[id='size-follower-kind']").select_option(label="oscillating")
    settled(page)
    assert page.locator("[id='size-follower-arm']").is_visible()
    assert page.locator("body.stale").count() == 0


def test_an_open_size_is_found_or_given(opened):
    page = opened()
    page.locator("[data-key='cam.prime_radius/true']").click()
    settled(page)
    assert task_of(page)["cam"]["prime_radius"] == 44
    page.locator("[data-key='cam.prime_radius/false']").click()
    settled(page)
    assert task_of(page)["cam"] == {}
    assert page.locator(".found:visible").last.inner_text() == "found: 44 mm"


def test_the_board_shows_all_views_and_opens_one(opened):
    page = opened()
    page.keyboard.press("a")
    settled(page)
    cards = page.locator("#board .view")
    for k in range(cards.count()):
        assert cards.nth(k).locator("path").count() > 0
    page.locator("#board [data-open='plan']").click()
    settled(page)
    assert page.locator("#board").is_hidden()
    assert page.locator("#view-plan").get_attribute("aria-selected") == "true"


def test_files_are_written_by_who_serves_the_page(opened):
    page = opened()
    page.locator("[data-write='sheet']").click()
    page.wait_for_function("() => document.getElementById('written').textContent === 'Written to cam: sheet.pdf'")


def test_files_of_others_are_asked_about(opened, served):
    page = opened()
    written = []

    def write(path, request, usual=served.answered):
        if path != "/write":
            return usual(path, request)
        written.append(request["replace"])
        return (
            {"files": ["sheet.pdf"], "folder": "cam"}
            if request["replace"]
            else {"others": ["mine.pdf"], "folder": "cam"}
        )

    served.answered = write
    try:
        page.locator("[data-write='sheet']").click()
        page.locator("#replace").wait_for()
        assert "mine.pdf" in page.locator("#written").inner_text()
        page.locator("#replace").click()
        page.wait_for_function("() => document.getElementById('written').textContent === 'Written to cam: sheet.pdf'")
    finally:
        del served.answered
    assert written == [False, True]


def test_another_builtin_task_takes_the_place_of_this_one(opened):
    page = opened()
    page.locator("#builtin").select_option("flat")
    settled(page)
    assert task_of(page)["follower"]["kind"] == "flat-faced"
    page.locator("#undo").click()
    settled(page)
    assert task_of(page)["follower"]["kind"] == "translating"


def test_a_first_picture_is_there_before_the_engine_answers(opened):
    first = first_answer(plain_task("coursework"), "en")
    # The page around it is not there to answer.
    config = {"first": first, "transport": "parent", "id": "one", "opening": "mechanism"}
    page = opened(config=config, settle=False, reduced_motion="reduce")
    page.wait_for_selector("#scene .cam")
    assert page.locator("#steps-beside > g").count() == sum(len(view["order"]) for view in first["views"])
    assert page.locator("#told-limits").inner_text() == "All limits are satisfied"


def test_no_text_of_a_task_ends_the_script_that_holds_it():
    task = {"title": {"name": "</script><script>alert(1)</script>"}}
    text = page_of({"transport": "server", "task": task, "name": "own", "builtin": {"own": task}})
    assert "<script>alert" not in text


def test_the_page_asks_nobody_but_who_serves_it():
    text = unescape(page_of({"transport": "server", "task": {}, "name": "own", "builtin": {"own": {}}}))
    assert "connect-src 'self'" in text
    assert "default-src 'none'" in text
    assert text.replace("http://www.w3.org/2000/svg", "").count("://") == 0
    assert [name for name in SCRIPT_FILES if name == "studio.js"] == [SCRIPT_FILES[-1]]


def test_what_if_shows_curves_on_which_the_present_cam_lies(opened, served):
    page = opened()
    page.locator("#tab-what-if").click()
    page.wait_for_selector(".sweep .curve", state="attached")
    settled(page)
    sweeps = [each for each in served.asked if each["ask"] == "sweep"]
    assert sum(each["count"] for each in sweeps) == 200
    assert {each["path"] for each in sweeps} == {"follower.offset"}
    chart = page.locator(".sweep").first
    radius = page.evaluate("() => studio.shown.values.find((each) => each.id === 'minimum_prime_radius').exact")
    assert chart.locator("strong").inner_text() == f"{radius:.4g} mm"
    # A press on the chart takes the size there.
    plot = chart.locator(".plot").bounding_box()
    assert plot
    page.mouse.click(plot["x"] + plot["width"] / 2, plot["y"] + plot["height"] / 2)
    settled(page)
    assert abs(task_of(page)["follower"]["offset"]) <= 0.5
    # Another offset lies on the same curves.
    assert len([each for each in served.asked if each["ask"] == "sweep"]) == len(sweeps)


def test_what_if_draws_curves_that_begin_where_there_is_no_design(opened):
    """A slider of a point of the arcs begins at places that make no cam; the curves are there beyond them."""
    page = opened("arcs")
    page.click("#tab-what-if")
    page.select_option("#sweep-size", value="arcs.D[0]")
    page.wait_for_selector("figure.sweep .dot")
    settled(page)
    assert page.locator("figure.sweep .dot").count() == page.locator("figure.sweep").count() > 0
