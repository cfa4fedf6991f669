"""What counts of photographs: the best one, nothing foreign, nothing that was not seen, and the teacher's word."""

from __future__ import annotations

import json
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from graphcam.errors import TaskError
from graphcam.exercises.photographs.corrections import (
    CORRECTIONS_FILE,
    NO_CORRECTIONS,
    Correction,
    StudentCorrections,
    stretch_of,
    to_json,
)
from graphcam.exercises.photographs.counted_answers import SEARCH_BAND, settled_student

pytestmark = pytest.mark.slow

NAME = "pitch"


def answers(course, student: str, name: str = "answers.toml") -> dict:
    return tomllib.loads((course.photos / student / name).read_text())


def dense(course, student: str) -> np.ndarray:
    """The right curve in steps as a reader takes them."""
    from graphcam.exercises.reports.unrolled_drawings import key_line

    return key_line(course.key(student).keys[NAME].expected)[:-1]


def one(course, student: str, points, corrections=NO_CORRECTIONS, **changes):
    photo = course.photograph(student, course.reading(student, points, **changes))
    return settled_student(course.exercise, student, [photo], course.key(student), corrections)


def last(found):
    return found.answers[-1]


def test_a_careful_drawing_counts_as_it_was_read(course, wobbled):
    drawn = wobbled(dense(course, "Anna"))
    course.keep(course.photograph("Anna", course.reading("Anna", drawn)))
    found = course.read()
    assert [photo.name for photo in found.photos] == ["Anna.jpg"]
    written = answers(course, "Anna")
    # The curve goes back to its first point.
    assert written[NAME] == answers(course, "Anna", "readings.toml")[NAME]
    assert written[NAME][0] == written[NAME][-1]
    assert np.allclose(np.array(written[NAME])[:-1, 0], drawn.real, atol=1e-3)
    assert list(written) == [NAME]


def test_a_usual_mistake_is_taken_and_a_foreign_curve_is_not(course):
    wrong = course.key("Anna").hypotheses["offset-sign"]
    place = len(course.exercise.answers) - 1
    assert last(one(course, "Anna", np.asarray(wrong[place].value))).status == "read"
    foreign = 1.35 * dense(course, "Anna")
    found = last(one(course, "Anna", foreign))
    assert (found.status, found.given) == ("refused", None)
    assert "every usual mistake" in str(found.why)
    # Somebody else's sheet, drawn on one's own.
    other = last(one(course, "Anna", dense(course, "Boris")))
    assert other.status in ("refused", "read")


def test_the_band_is_of_most_of_the_curve_and_one_bad_place_is_a_slip(course):
    drawn = dense(course, "Anna").copy()
    few = np.arange(drawn.size) < 0.03 * drawn.size
    drawn[few] *= 1 + 2 * SEARCH_BAND / np.abs(drawn[few])
    assert last(one(course, "Anna", drawn)).status == "read"


def test_a_scribble_through_all_places_of_the_key_is_foreign(course):
    drawn = dense(course, "Anna")
    scribble = np.stack([drawn, 0.4 * drawn], -1).ravel()
    assert last(one(course, "Anna", scribble)).status == "refused"


def test_what_the_reader_refuses_is_left_out_and_said(course):
    drawn = dense(course, "Anna")
    refused = course.reading("Anna", drawn, share=0.6, why="60 % of the curve can be seen", remedy="draw over it")
    course.keep(course.photograph("Anna", refused))
    course.read()
    assert answers(course, "Anna") == answers(course, "Anna", "readings.toml") == {}
    report = json.loads((course.photos / "Anna" / "report.json").read_text())
    assert report["to_be_looked_at"]
    assert f"{NAME} is not marked: 60 % of the curve can be seen; draw over it" in report["notes"]
    assert report["answers"][-1]["status"] == "refused"


def test_the_best_of_several_photographs_counts_and_the_others_are_named(course, wobbled):
    drawn = wobbled(dense(course, "Anna"))
    photos = [
        course.photograph("Anna", course.reading("Anna", drawn), "far.jpg", residual=0.8),
        course.photograph("Anna", course.reading("Anna", drawn), "near.jpg", residual=0.2),
        course.photograph("Anna", course.reading("Anna", drawn, why="blurred", share=1.0), "bad.jpg", residual=0.1),
        course.photograph("Anna", None, "bent.jpg", why="the paper is not flat", remedy="press it flat"),
    ]
    course.keep(*photos)
    course.read()
    report = json.loads((course.photos / "Anna" / "report.json").read_text())
    counts = {photo["photograph"]: photo["counts"] for photo in report["photographs"]}
    assert counts == {"far.jpg": False, "near.jpg": True, "bad.jpg": False, "bent.jpg": False}
    assert any("far.jpg shows page 2 too; near.jpg is the better photograph" in note for note in report["notes"])
    table = (course.photos / "report.csv").read_text().splitlines()
    assert len(table) == 1 + len(photos)
    assert any('"bent.jpg","Anna","2","refused"' in line and "press it flat" in line for line in table)


def test_without_an_answer_key_nothing_counts(course):
    photo = course.photograph("Anna", course.reading("Anna", dense(course, "Anna")))
    assert last(settled_student(course.exercise, "Anna", [photo], None)).status == "refused"


def test_points_are_chosen_by_their_band_and_never_made_up(plotted):
    right = plotted.right("Anna")
    centre = np.array([0j, 5 + 5j])
    assert last(one(plotted, "Anna", np.concatenate([centre, right]))).status == "read"
    found = last(one(plotted, "Anna", np.concatenate([centre, right])))
    assert np.asarray(found.given).size == right.size
    missing = last(one(plotted, "Anna", right[1:]))
    assert (missing.status, str(missing.why)) == ("refused", f"{right.size - 1} of {right.size} points are seen")
    # A place without a sure point takes a faint one that is seen there, if it is the only one; no other place does.
    faint = last(one(plotted, "Anna", right[1:], faint=np.array([right[0] + 0.4, right[0] + 40, right[5] + 1])))
    assert faint.status == "read"
    assert set(np.asarray(faint.given)) == {right[0] + 0.4, *right[1:]}
    assert last(one(plotted, "Anna", right[1:], faint=right[0] + np.array([-1, 1]))).status == "refused"
    assert last(one(plotted, "Anna", right[: right.size // 2], faint=right[right.size // 2 :])).status == "refused"
    # Two near one place: which one is meant is not for a program to say.
    double = last(one(plotted, "Anna", np.append(right, right[3] + 3)))
    assert double.status == "refused"


@pytest.mark.parametrize("verdict", ["confirmed", "corrected", "left out"])
def test_the_teachers_word_counts(course, verdict):
    drawn = 1.35 * dense(course, "Anna")
    value = dense(course, "Anna") if verdict == "corrected" else None
    said = StudentCorrections({NAME: Correction(verdict, value)})
    found = last(one(course, "Anna", drawn, said))
    assert found.status == verdict
    assert found.as_read is None
    if verdict == "left out":
        assert found.given is None
    else:
        wanted = drawn if verdict == "confirmed" else value
        assert np.allclose(np.asarray(found.given)[:-1], wanted)


def test_typed_numbers_and_measured_bars_count_and_are_kept_apart_from_what_was_read(course):
    drawn = dense(course, "Anna") / 1.01
    course.keep(course.photograph("Anna", course.reading("Anna", drawn)))
    number = course.exercise.answers[0].name
    said = StudentCorrections({number: Correction("corrected", 12.5)}, {2: (252.5, 181.8)})
    file = course.place.parent / "corrections.json"
    file.write_text(to_json(course.exercise, {"Anna": said}))
    course.read(corrections=file)
    assert (course.place / "teacher" / CORRECTIONS_FILE).is_file()
    for _ in range(2):
        written, read = answers(course, "Anna"), answers(course, "Anna", "readings.toml")
        assert written[number] == 12.5
        assert number not in read
        assert np.allclose(np.array(written[NAME]), 1.01 * np.array(read[NAME]), atol=2e-3)
        # Another run, which is told nothing, comes to the same.
        course.read()


def test_a_bar_that_no_printer_makes_is_asked_again_and_changes_nothing(course):
    course.keep(course.photograph("Anna", course.reading("Anna", dense(course, "Anna"))))
    course.read()
    before = {path: path.read_bytes() for path in course.place.rglob("*") if path.is_file()}
    file = course.place.parent / "corrections.json"
    file.write_text(to_json(course.exercise, {"Anna": StudentCorrections({}, {2: (225.0, None)})}))
    with pytest.raises(TaskError, match=r"scale bar across is 225 mm, but must be from 242.5 to 257.5 mm; measure"):
        course.read(corrections=file)
    assert before == {path: path.read_bytes() for path in course.place.rglob("*") if path.is_file()}
    assert stretch_of((250.0, 180.0), (None, None), "") == (1.0, 1.0)


def test_a_correction_outlives_a_better_photograph_but_is_to_be_looked_at_again(course):
    first = course.photograph("Anna", course.reading("Anna", dense(course, "Anna")), "first.jpg", residual=0.9)
    said = StudentCorrections({NAME: Correction("corrected", dense(course, "Anna"), first.digest)}, reviewed=True)
    assert not settled_student(course.exercise, "Anna", [first], course.key("Anna"), said).open
    second = course.photograph("Anna", course.reading("Anna", dense(course, "Anna")), "second.jpg", residual=0.2)
    found = settled_student(course.exercise, "Anna", [first, second], course.key("Anna"), said)
    assert found.open
    assert last(found).status == "corrected"
    assert "another photograph than second.jpg" in str(found.notes[0])


def pixels(path: Path) -> np.ndarray:
    return np.asarray(Image.open(path)).astype(int)


def test_the_overlay_for_the_student_shows_no_key(course, wobbled):
    # All of it 3 mm too large, so that the two lines lie apart.
    right = dense(course, "Anna")
    drawn = right * (1 + 3 / np.abs(right))
    course.keep(course.photograph("Anna", course.reading("Anna", drawn)))
    course.read()

    def coloured(name: str) -> tuple[int, int]:
        red, green, blue = np.moveaxis(pixels(course.photos / "Anna" / name), -1, 0)
        bluish = blue - red > 50
        # A line is two pixels and more; beside a red one a packed picture may have a single bluish pixel.
        line = bluish & (
            np.roll(bluish, 1, 0) | np.roll(bluish, -1, 0) | np.roll(bluish, 1, 1) | np.roll(bluish, -1, 1)
        )
        return int((red - np.maximum(green, blue) > 60).sum()), int(line.sum())

    own, key = coloured("traced-2.jpg")
    assert own > 500
    assert key == 0
    own, key = coloured("overlay-2.jpg")
    assert own > 500
    assert key > 500


def test_files_of_a_run_before_go_and_what_the_teacher_puts_there_stays(course):
    photo = course.photograph("Anna", course.reading("Anna", dense(course, "Anna")))
    course.keep(photo)
    course.read()
    folder = course.photos / "Anna"
    (folder / "notes.txt").write_text("mine")
    course.keep(replace(photo, answers={}, pictures={}))
    course.read()
    assert {path.name for path in folder.iterdir()} == {"answers.toml", "readings.toml", "report.json", "notes.txt"}
