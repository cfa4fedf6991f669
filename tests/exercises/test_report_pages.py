"""The pages of a graded course: complete in themselves, and a student's without the key."""

from __future__ import annotations

import json
import re
from html import unescape
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browsers import opened
from issued_variants import SECRET, course_of, issued, key
from over_all import fast_first
from russian import english_words

from graphcam.exercises.course.course_folder import TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.drawn_answers import board_chain, construction_of, per_mm
from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.exercises.definition.variant import drawn, fill_in
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.marking.copy_detection import AlikePair
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.reports.first_wrong_step import PASSING_KINDS, first_step_off, first_step_showing
from graphcam.exercises.reports.group_page import Mistake, group_page, mistakes
from graphcam.exercises.reports.student_page import student_page
from graphcam.exercises.reports.unrolled_drawings import (
    CURVE_PLACES,
    PICTURE_HEIGHT,
    bundle,
    deviations_along,
    key_line,
)
from graphcam.plots.step_board import StepBoard

NAME = "inversion-translating"
BUMP = 5.2
"""How far the curve of Clara is out at one point [mm]: more than her tolerance."""
HOSTILE = "<img src=http://127.0.0.1/x onerror=alert(1)>"
IDS = ("Anna", "Boris", "Clara", "Dmitri", HOSTILE)


def answers(student: str, answer_key: AnswerKey) -> str:
    """By Anna a careful hand's, by Boris those of the wrong offset, by Clara a bump, by Dmitri nearly none."""
    exercise = issued(NAME)[0]
    values = dict(key(answer_key))
    rng = np.random.default_rng(len(student))
    values = {
        name: value + answer_key.keys[name].tolerance / 5 * rng.standard_normal() for name, value in values.items()
    }
    if student == "Boris":
        wrong = answer_key.hypotheses["offset-sign"]
        values = {asked.name: each.value for asked, each in zip(exercise.answers, wrong, strict=True)}
    if student == "Clara":
        bump = BUMP * np.exp(-(((np.arange(values["pitch"].size) - 9) / 1.5) ** 2))
        values["pitch"] = values["pitch"] * (1 + bump / np.abs(values["pitch"]))
    if student == "Dmitri":
        values = {"s_8": values["s_8"]}
    if student == HOSTILE:
        return f'"{HOSTILE}" = 1\npitch = "{HOSTILE}"\n'
    return "".join(
        f"{name} = {[[z.real, z.imag] for z in value.tolist()] if isinstance(value, np.ndarray) else value}\n"
        for name, value in values.items()
    )


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    handed_in = {student: answers(student, issued(NAME, student)[1]) for student in IDS}
    place = course_of(tmp_path_factory.mktemp("course"), NAME, handed_in)
    grade_course(Course(place, place / "secret", place / "grades.csv", feedback=place / "pages"))
    return place


def page_of(place: Path, student: str) -> Path:
    return place / "pages" / f"{folder_name(student)}.html"


@pytest.mark.slow
def test_the_pages_need_nothing_from_elsewhere_and_run_nothing(pages: Path):
    for path in (pages / "grades.html", *(page_of(pages, student) for student in ("Boris", HOSTILE))):
        with opened(path) as (page, wrong):
            assert page.title()
            assert page.evaluate("document.images.length") == 0
            # Nothing sticks out of the page, on a desk or on a telephone.
            for width in (1200, 390):
                page.set_viewport_size({"width": width, "height": 900})
                assert page.evaluate("document.documentElement.scrollWidth") == width
        assert wrong == []


@pytest.mark.slow
def test_a_table_that_is_wider_than_a_telephone_is_moved_in_its_own_box_and_breaks_no_words(pages: Path):
    with opened(pages / "grades.html") as (page, _):
        page.set_viewport_size({"width": 390, "height": 900})
        box = page.locator(".wide", has=page.get_by_text("Discrimination", exact=True))
        assert box.evaluate("box => box.scrollWidth > box.clientWidth")
        assert box.evaluate("box => { box.scrollLeft = 1000; return box.scrollLeft > 0 }")
        # No name of an answer is on two lines.
        heights = box.locator("td:first-child").evaluate_all("cells => cells.map(cell => cell.clientHeight)")
        assert len(heights) == len(issued(NAME)[0].answers)
        assert len(set(heights)) == 1


def numbers_of(html: str, decimals: int = 1) -> set[float]:
    """The numbers of a page that have so many decimals at least."""
    text = re.sub(r"<style>.*?</style>", "", html, flags=re.DOTALL)
    return {float(number) for number in re.findall(rf"-?\d+\.\d{{{decimals},}}", text.replace("−", "-"))}


def disclosed(html: str, answer_key: AnswerKey) -> list[str]:
    """Answers whose keys stand on a page, to three decimals, or of points most of them to two."""
    shown, exact = numbers_of(html), numbers_of(html, 2)
    found: list[str] = []
    for name, value in key(answer_key).items():
        if isinstance(value, np.ndarray):
            near = [any(abs(x - part) < 0.006 for x in shown) for z in value for part in (z.real, -z.imag)]
            if np.mean(near) > 0.5:
                found.append(name)
        # A place of the drawing, of one decimal, is the same by chance.
        elif any(abs(x - float(value)) < 1e-3 * max(1.0, abs(float(value))) / 10 for x in exact):
            found.append(name)
    return found


@pytest.mark.slow
def test_a_students_page_does_not_hold_the_key(pages: Path):
    for student in IDS[1:]:
        answer_key = issued(NAME, student)[1]
        html = page_of(pages, student).read_text()
        own = {name for name in key(answer_key) if f"{name} = " in answers(student, answer_key)}
        # What the student gave right stands there as the student's own.
        given_right = {
            answer["name"] for record in json.loads((pages / "grades.json").read_text()) if record["student"] == student
            for answer in record["answers"] if answer["outcome"] == "right"
        }  # fmt: skip
        assert set(disclosed(html, answer_key)) <= given_right & own, student


@pytest.mark.slow
def test_the_teachers_page_shows_the_key_so_the_check_above_would_find_it(pages: Path):
    assert {"pitch", "x_8"} <= set(disclosed((pages / "grades.html").read_text(), issued(NAME, "Boris")[1]))


@pytest.mark.parametrize("name", fast_first(library(), 3))
def test_no_exercise_discloses_a_key_on_the_page_of_who_has_it_wrong_and_all_do_where_it_is_to_be_shown(name: str):
    """Each by a student with the mistake that is first in its catalogue."""
    exercise, answer_key = issued(name)
    mistaken = next(iter(answer_key.hypotheses.values()))
    values = {asked.name: each.value for asked, each in zip(exercise.answers, mistaken, strict=True)}
    record = mark(exercise, answer_key, Answers(values)).to_dict()
    given_right = {answer["name"] for answer in record["answers"] if answer["outcome"] == "right"}
    assert len(given_right) < len(exercise.answers)
    assert set(disclosed(student_page(exercise, record, answer_key), answer_key)) <= given_right
    told = student_page(exercise, record, answer_key, right=True)
    rows = [words_of(row) for row in re.findall(r"<tr><td>.*?</tr>", told, flags=re.DOTALL)]
    for asked, row in zip(exercise.answers, rows, strict=True):
        expected = answer_key.keys[asked.name].expected.value
        if asked.kind == "number":
            found = re.search(r"right: ([-−\d.]+) ± ", row)
            assert found is not None
            shown = float(found[1].replace("−", "-"))
            assert shown == pytest.approx(float(str(expected)), abs=0.5001 * 10**-asked.decimals)
        else:
            assert "right: see the drawing" in row
            assert asked.name in disclosed(told, answer_key)


def test_the_right_drawing_lies_under_the_own_one_and_the_construction_goes_on_to_the_step_that_is_off(pages: Path):
    exercise = find_exercise(NAME)
    records = {record["student"]: record for record in json.loads((pages / "grades.json").read_text())}
    answer_key = issued(NAME, "Clara")[1]
    html = student_page(exercise, records["Clara"], answer_key, right=True)
    assert html.count('<polyline class="key"') == 1
    assert "pitch: your drawing is red, the right one blue; the largest deviation is circled." in html
    before, told = (first_step_off(exercise, records["Clara"], right=right) for right in (False, True))
    assert before is not None
    assert told is not None
    assert (before.step, before.told, told.step, told.told) == (told.step, False, before.step, True)
    assert before.picture is not None
    assert told.picture is not None
    assert len(told.picture.drawn) > len(before.picture.drawn)
    # Who has all right sees no step, and the curve as it should be.
    assert "right one blue.<" in student_page(exercise, records["Anna"], issued(NAME, "Anna")[1], right=True)


def graded(pages: Path, out: Path, **more: object) -> str:
    """Boris' page."""
    order = Course(pages, pages / "secret", out / "grades.csv", feedback=out / "pages", **more)  # type: ignore[arg-type]
    grade_course(order)
    return words_of((out / "pages" / "Boris.html").read_text(encoding="utf-8"))


def test_what_is_right_is_shown_only_when_it_is_asked_for(pages: Path, tmp_path: Path):
    assert "right: " not in graded(pages, tmp_path / "not asked for")
    assert "right: " in graded(pages, tmp_path / "asked for", show_right=True)


def test_the_report_tells_what_to_teach_again(pages: Path):
    text = (pages / "grades.html").read_text()
    from graphcam.exercises.definition.mistakes import misconception

    assert str(misconception("offset-sign").said) in text
    assert "<img" not in text
    assert "<img" not in page_of(pages, HOSTILE).read_text()


def test_mistakes_that_are_named_together_are_counted_together():
    def named(student: str, misconception: str, *alike: str) -> dict[str, Any]:
        diagnosis = {"misconception": misconception, "alike": list(alike)}
        return {"student": student, "diagnosis": diagnosis, "of": 8.0, "total": 5.0}

    first, second = "numbering-sense", "rotation-sense"
    found = mistakes([named("a", first, second), named("b", second, first), named("c", first)])
    assert found == [Mistake((first, second), ("a", "b"), 6.0), Mistake((first,), ("c",), 3.0)]


def test_the_pages_of_a_russian_course_are_russian(pages: Path):
    kept = AnswerKeys(pages / TEACHER_FOLDER)
    exercise = find_exercise(NAME, "ru")
    records = json.loads((pages / "grades.json").read_text())
    answer_keys = {student: AnswerKey.from_json(kept.find(student)) for student in IDS}
    # The sentences of a record were said when it was marked; here the pages' own words are looked at.
    records = [record | {"feedback": [], "notes": []} for record in records if record["student"] != HOSTILE]
    alike = [AlikePair(IDS[1], IDS[2], kind, ("s_8",), 1e-4) for kind in ("variant", "wrong numbers")]
    html = [group_page(exercise, records, answer_keys, alike)]
    assert html[0].count("0,0001") == 2
    html += [
        student_page(exercise, record, answer_keys[record["student"]], right=right)
        for record in records
        for right in (False, True)
    ]
    for page in html:
        text = re.sub(r"<style>.*?</style>|<[^>]*>", " ", page, flags=re.DOTALL)
        names = (*IDS, *(asked.name for asked in exercise.answers), *exercise.parameters)
        assert english_words(text, names) == set()
        assert not re.search(r"\d\.\d", text)


def test_a_bump_is_circled_where_it_is(pages: Path):
    """Too far out at the tenth point, and the page says the tenth."""
    record = next(one for one in json.loads((pages / "grades.json").read_text()) if one["student"] == "Clara")
    pitch = next(answer for answer in record["answers"] if answer["name"] == "pitch")
    assert pitch["station"] == 9
    # The nearest place of the curve does not lie straight inwards.
    assert pitch["off_paper"] == pytest.approx(0.8 * BUMP, abs=0.5)
    html = page_of(pages, "Clara").read_text()
    assert "most of all at point 10" in html
    spot = re.search(r'class="spot" cx="(-?[\d.]+)" cy="(-?[\d.]+)"', html)
    assert spot is not None
    # The circle stands where the student's curve comes nearest to the key's point.
    place = key(issued(NAME, "Clara")[1])["pitch"][9]
    assert abs(complex(float(spot[1]), -float(spot[2])) - place) == pytest.approx(pitch["off_paper"], abs=0.02)


def words_of(html: str) -> str:
    return re.sub(r"\s+", " ", re.sub(r"<style>.*?</style>|<[^>]*>", " ", html, flags=re.DOTALL))


def test_a_student_reads_every_sentence_once_and_in_the_row_of_its_answer(pages: Path):
    for record in json.loads((pages / "grades.json").read_text()):
        html = unescape(page_of(pages, record["student"]).read_text())
        rows = re.findall(r"<tr><td>.*?</tr>", html, flags=re.DOTALL)
        assert len(rows) == len(record["answers"])
        for answer, row in zip(record["answers"], rows, strict=True):
            begin = f"{answer['name']}: "
            said = next(each.removeprefix(begin) for each in record["feedback"] if each.startswith(begin))
            tail = said[1:]
            if answer["outcome"] not in ("right", "missing"):
                assert tail in words_of(row)
                assert words_of(html).count(tail) == sum(each.endswith(tail) for each in record["feedback"])
        remarks = record["feedback"][len(record["answers"]) :]
        assert re.findall(r"<li>(.*?)</li>", html, flags=re.DOTALL) == [*remarks, *record["notes"]]


def test_a_drawing_has_a_scale_and_its_worst_place_stands_enlarged(pages: Path):
    html = page_of(pages, "Clara").read_text()
    whole, detail = re.findall(r'<svg class="paper.*?</svg>', html, flags=re.DOTALL)
    for picture in (whole, detail):
        assert re.search(r'class="bar" d="M[-\d. ]+h10"', picture)
        assert "10 mm" in picture
    boxes = [[float(x) for x in re.search(r'viewBox="(.*?)"', one)[1].split()] for one in (whole, detail)]
    widths = [float(re.search(r' width="(\d+)"', one)[1]) for one in (whole, detail)]
    # The detail shows a millimetre at least twice as long, and the circled place is its middle.
    assert widths[1] / boxes[1][2] > 2 * widths[0] / boxes[0][2]
    spot = re.search(r'class="spot" cx="(-?[\d.]+)" cy="(-?[\d.]+)"', whole)
    left, top, width, height = boxes[1]
    assert (left + width / 2, top + height / 2) == pytest.approx((float(spot[1]), float(spot[2])), abs=0.06)
    assert html.count('class="paper') == 2
    assert page_of(pages, "Anna").read_text().count('class="paper') == 1


def test_the_teacher_sees_all_drawings_unrolled_along_their_keys(pages: Path):
    """Of the three that were drawn Anna's lies on the key, and Boris' goes out and in; of three the median is there."""
    html = (pages / "grades.html").read_text()
    assert html.count('<polyline class="each"') == 3
    assert html.count('<polyline class="median"') == 1
    assert "pitch: deviations of all 3 drawings" in html


@pytest.mark.parametrize(("turn", "name"), [(1, "outwards"), (-1, "outwards, drawn the other way round")])
def test_a_drawing_that_lies_outside_its_arcs_deviates_outwards_by_as_much(turn: int, name: str):
    stations = np.exp(1j * turn * np.arange(24) * np.pi / 12) * 40
    circle = Expected(stations, np.ones(24), np.full(24, turn * np.tan(np.pi / 48)))
    assert np.abs(key_line(circle)) == pytest.approx(np.full(key_line(circle).size, 40.0))
    outside = 43 * np.exp(1j * np.linspace(0, 2 * np.pi, 400))
    # Between the places of the key its arc is a chord, of little rise.
    assert deviations_along(circle, outside, "curve") == pytest.approx(np.full(CURVE_PLACES, 3.0), abs=0.05), name
    assert deviations_along(circle, outside / 43 * 38, "curve") == pytest.approx(
        np.full(CURVE_PLACES, -2.0), abs=0.05
    ), name


def test_a_table_of_points_goes_back_to_its_first_but_a_drawing_that_is_open_stays_so():
    around = 40 * np.exp(2j * np.pi * np.arange(24) / 24)
    circle = Expected(around, np.ones(24), np.full(24, np.tan(np.pi / 48)))
    assert np.abs(deviations_along(circle, around, "curve")).max() < 0.4
    assert np.abs(deviations_along(circle, around[:-4], "curve")).max() > 10


def test_the_picture_of_a_bundle_has_the_median_and_the_quartiles_of_all_and_a_bounded_number_of_lines():
    drawings = [np.full(CURVE_PLACES, 0.01 * k) for k in range(401)]
    shown = bundle(drawings, 1.0)
    assert (shown.count, len(shown.lines)) == (401, 300)
    most = shown.ticks[-1][1]

    def deviations_of(line: str) -> set[float]:
        return {
            round((PICTURE_HEIGHT / 2 - float(point.split(",")[1])) * 2 * most / PICTURE_HEIGHT, 1)
            for point in line.split()
        }

    assert deviations_of(shown.median) == {2.0}
    assert deviations_of(shown.quartiles) == {1.0, 3.0}


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        # The ordinates of v and s stand on paper long before their scales are found.
        (
            "integration",
            {"v_2": 1, "v_3_return": 1, "s_5": 4, "s_max": 4, "s_3_return": 4, "mu_v": 1, "mu_a": 8, "v_max": 1},
        ),
        (
            "inversion-translating",
            {
                "a_4_return_paper": 0,
                "v_2_paper": 1,
                "v_2_return_paper": 1,
                "mu_s": 4,
                "s_8": 4,
                "radius_8": 2,
                "x_8": 2,
                "y_8": 2,
                "angle_8": 2,
                "pitch": 2,
            },
        ),
        (
            "inversion-arm",
            {
                "a_4_return_paper": 0,
                "v_2_paper": 1,
                "v_2_return_paper": 1,
                "s_max": 4,
                "psi_4": 4,
                "pivot_4": 1,
                "pivot_y_4": 1,
                "radius_10": 3,
                "angle_10": 3,
                "rollers": 3,
            },
        ),
        (
            "pressure-angle",
            {
                "mu_s": 4,
                "s0": 1,
                "mu_v": 1,
                "v_4": 1,
                "D_4": 1,
                "D_6_return": 1,
                "alpha_4": 1,
                "alpha_8": 1,
                "alpha_6_return": 1,
            },
        ),
    ],
)
def test_the_step_that_shows_an_answer_is_known(name: str, shown: dict[str, int]):
    exercise = find_exercise(name)
    chain = board_chain(drawn(exercise, "Anna", SECRET, 0).task)
    found = {
        asked.name: first_step_showing(construction_of(chain, asked.construction), asked) for asked in exercise.answers
    }
    assert found == shown


def test_a_line_is_named_by_its_own_step_though_its_ends_are_hidden_too():
    exercise = find_exercise("pressure-angle")
    chain = board_chain(drawn(exercise, "Anna", SECRET, 0).task)
    construction = construction_of(chain, "pressure_angle")
    alpha = next(asked for asked in exercise.answers if asked.name == "alpha_4")
    assert (
        str(construction.steps()[first_step_showing(construction, alpha, PASSING_KINDS)].title)
        == "The pressure angle at every station"
    )


def test_a_page_draws_the_construction_up_to_the_first_step_that_is_off_and_no_farther(pages: Path):
    exercise = find_exercise(NAME)
    records = {record["student"]: record for record in json.loads((pages / "grades.json").read_text())}
    for student in ("Boris", "Clara"):
        found = first_step_off(exercise, records[student])
        assert found is not None
        off = next(answer for answer in records[student]["answers"] if answer["outcome"] in ("wrong", "partial"))
        assert found.answer == off["name"]
        assert str(found.step) == "Displacements laid off"
        assert found.notebook == 5
        html = page_of(pages, student).read_text()
        assert "go through the step “Displacements laid off” of" in html
        assert found.picture is not None
        assert ('class="mine"' in html) == bool(found.picture.own)
        # A place of the pitch curve, which the next step finds, is the end of no line and no dot's place.
        chain = board_chain(fill_in(exercise, records[student]["parameters"]))
        steps = construction_of(chain, "inversion").steps()
        board = StepBoard((), steps[:2])
        places = board.origin + board.factor * key(issued(NAME, student)[1])["pitch"]
        drawn_places = [
            complex(float(x), found.picture.height - float(y))
            for x, y in re.findall(r"[ML](-?[\d.]+) (-?[\d.]+)", found.picture.drawn)
        ]
        near = [min(abs(place - other) for other in drawn_places) < 0.15 for place in places]
        assert np.mean(near) < 0.5
    # Boris' x is a line across the view, as far to the right of the centre as he said.
    found = first_step_off(exercise, records["Boris"])
    assert found is not None
    assert found.picture is not None
    chain = board_chain(fill_in(exercise, records["Boris"]["parameters"]))
    board = StepBoard((), construction_of(chain, "inversion").steps()[:2])
    asked = next(asked for asked in exercise.answers if asked.name == "x_8")
    given = next(answer["given"] for answer in records["Boris"]["answers"] if answer["name"] == "x_8")
    at = board.origin.real + board.factor * given / per_mm(chain, asked)
    assert float(found.picture.own.split(",")[0]) == pytest.approx(at, abs=0.06)
    assert first_step_off(exercise, records["Anna"]) is None
    assert "The first wrong step" not in page_of(pages, "Anna").read_text()
    # What was never read has no variant either where the record knows none.
    assert first_step_off(exercise, records["Boris"] | {"parameters": {}}) is None
