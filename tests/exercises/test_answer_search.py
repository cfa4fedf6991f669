"""Answers in zips, in folders within folders and under other names; and what is handed in without any."""

from __future__ import annotations

import csv
import html
import io
import json
import struct
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from issued_variants import answer_lines, course_of, issued, key
from over_all import fast_first

from graphcam.errors import TaskError
from graphcam.exercises.course import answer_search, zipped_submissions
from graphcam.exercises.course.course_folder import HIDDEN_FOLDER, ROSTER_FILE, TEACHER_FOLDER
from graphcam.exercises.course.handouts import answer_file
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.marks_policy import MarksPolicy
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.grading.overrides import OVERRIDES_FILE
from graphcam.files import OutputError

NAME = "acceleration-and-scales"
EXERCISE = find_exercise(NAME)
IDS = ("s1", "s2", "s3")
BLANK = answer_file(EXERCISE)
"""answers.toml as it is handed out."""


def right(student: str) -> str:
    """The answers that are right for a student."""
    return answer_lines(key(issued(NAME, student)[1]))


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A course of three; the folder is empty."""
    course_of(tmp_path, NAME, dict.fromkeys(IDS))
    (tmp_path / TEACHER_FOLDER / ROSTER_FILE).write_text(
        "id,name\ns1,Anna Berg\ns2,Eva Müller\ns3,Ben Dorn\n", encoding="utf-8"
    )
    (tmp_path / "in").mkdir()
    return tmp_path


def grade(course: Path, **more: Any) -> tuple[str, dict[str, dict[str, Any]]]:
    """What the command says, and the records by student."""
    out = course / "out" / "grades.csv"
    said = grade_course(Course(course / "in", course / "secret", out, feedback=course / "pages", **more))
    return "\n".join(map(str, said)), {
        one["student"]: one for one in json.loads(out.with_suffix(".json").read_text(encoding="utf-8"))
    }


def table(course: Path, name: str = "grades.csv") -> list[dict[str, str]]:
    return list(csv.DictReader((course / "out" / name).read_text(encoding="utf-8").splitlines()))


def hand_in(course: Path, files: Mapping[str, str | bytes]) -> None:
    for name, text in files.items():
        path = course / "in" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text if isinstance(text, bytes) else text.encode())


def packed(files: Mapping[str, str | bytes]) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(name, text)
    return data.getvalue()


FOUND = {
    "a zip": lambda: {"s1/s1.zip": packed({"answers.toml": right("s1"), "worksheet.pdf": ""})},
    "a folder in a zip": lambda: {
        "s1/s1.zip": packed({"s1/answers.toml": right("s1"), "__MACOSX/s1/._answers.toml": ""})
    },
    "a folder": lambda: {"s1/214514/answers.toml": right("s1")},
    "another name": lambda: {"s1/answers_Fritz.toml": right("s1"), "s1/task.toml": "lift = 3"},
    "a table of another name": lambda: {"s1/mine.csv": right("s1").replace(" = ", ",")},
    "beside the empty handout": lambda: {
        "s1/answers.toml": BLANK,
        "s1/done/answers.toml": right("s1"),
        "s1/scan.pdf": "x",
    },
    "a zip among files": lambda: {"Anna Berg_12_34_answers.zip": packed({"answers.toml": right("s1")})},
}


@pytest.mark.parametrize("kind", FOUND)
@pytest.mark.parametrize("zipped", fast_first([False, True]))
def test_answers_are_found_where_students_put_them(course: Path, kind: str, zipped: bool):
    hand_in(course, FOUND[kind]())
    if zipped:
        (course / "in.zip").write_bytes(packed(FOUND[kind]()))
        out = course / "out" / "grades.csv"
        said = "\n".join(map(str, grade_course(Course(course / "in.zip", course / "secret", out))))
        assert table(course)[0]["total"] == f"{EXERCISE.marks:g}"
    else:
        said, records = grade(course)
        assert records["s1"]["total"] == EXERCISE.marks
        assert any("read" in note for note in records["s1"]["notes"])
    assert said.splitlines()[1] == "not handed in: s2, s3"


UNREAD = {
    "no answers can be read from scan.pdf": lambda: {"s1/scan.pdf": "%PDF", "s1/answers.toml": BLANK},
    "answers are in several places, keep one: a, b.zip": lambda: {
        "s1/a/answers.toml": right("s1"),
        "s1/b.zip": packed({"answers.toml": right("s2")}),
    },
    "x.zip is not a zip that can be unpacked": lambda: {"s1/x.zip": b"PK\x03\x04 and no more"},
    "answers are in several places, keep one: a.toml, b.toml": lambda: {
        "s1/a.toml": right("s1"),
        "s1/b.toml": right("s1"),
    },
}


@pytest.mark.parametrize("why", UNREAD)
def test_what_cannot_be_read_is_not_graded_and_told_with_the_reason(course: Path, why: str):
    hand_in(course, {**UNREAD[why](), "s2/answers.toml": right("s2")})
    said, _ = grade(course)
    assert said.splitlines()[1:3] == [f"not graded: s1: {why}", "not handed in: s3"]
    assert said.splitlines()[3].startswith("to check: submissions without readable answers: 1 (s1)")
    assert [row["total"] for row in table(course)] == ["", f"{EXERCISE.marks:g}"]
    assert table(course, "grades-not-graded.csv") == [{"folder": "s1", "why": why}]
    assert why in (course / "out" / "grades-moodle.csv").read_text(encoding="utf-8")


def test_the_table_of_students_says_of_whom_no_answer_can_be_read(course: Path):
    words = "\n".join(f'{asked.name} = "see the drawing"' for asked in EXERCISE.answers)
    hand_in(course, {"s1/answers.toml": words, "s2/answers.toml": right("s2")})
    said, _ = grade(course)
    assert "to check: submissions without readable answers: 1 (s1); see grades.html" in said
    page = html.unescape((course / "out" / "grades.html").read_text(encoding="utf-8"))
    assert page.count("no answer can be read; the student's page says why") == 1


def test_bytes_that_stand_in_a_zip_under_one_name_many_times_count_as_often(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """The directory of a zip may name the same bytes again and again; they are not unpacked again and again."""
    monkeypatch.setattr(zipped_submissions, "MAX_BYTES", 20_000_000)
    once = packed({"s1/answers.toml": " " * 1_000_000})
    start, end = once.find(b"PK\1\2"), once.rfind(b"PK\5\6")
    count, entry = 50, once[start:end]
    tail = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, count, count, len(entry) * count, start, 0)
    (tmp_path / "in.zip").write_bytes(once[:start] + entry * count + tail)
    whole = pytest.raises(TaskError, match="the size is larger, but must be at most 20000000 bytes unpacked")
    with whole, zipped_submissions.unpacked(tmp_path / "in.zip"):
        raise AssertionError("it was unpacked")


def test_a_bomb_within_a_zip_takes_neither_room_nor_marks(course: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr("graphcam.exercises.course.zipped_submissions.MAX_STUDENT_BYTES", 1_000_000)
    hand_in(course, {"s1/bomb.zip": packed({f"{k}.toml": " " * 900_000 for k in range(9)})})
    hand_in(course, {"s2/far.zip": packed({"../../s3/answers.toml": right("s3")})})
    said, _ = grade(course)
    assert "not graded: s1: bomb.zip is not a zip that can be unpacked" in said
    assert "not graded: s2: no answers can be read from far.zip" in said
    assert not (course / "in" / "s3").exists()


def test_the_handouts_given_back_are_no_submission(course: Path):
    hand_in(
        course,
        {
            "s1/answers.toml": BLANK,
            "s1/worksheet.pdf": "%PDF",
            "s1/timestamp.txt": "2026",
            "s2/answers.toml": right("s2"),
        },
    )
    said, _ = grade(course)
    assert said.startswith("submissions graded: 1, ")
    assert "not handed in: s1, s3" in said
    page = (course / "out" / "grades.html").read_text(encoding="utf-8")
    assert f"Submissions: 1. Marks on average: {EXERCISE.marks:.1f} of" in page
    rows = {row["student"]: row for row in table(course)}
    assert (rows["s1"]["total"], rows["s1"][EXERCISE.answers[0].name], rows["s1"]["name"]) == ("", "", "Anna Berg")
    assert list(rows["s2"])[-1] == "name"
    for name in ("grades-moodle.csv", "grades-canvas.csv"):
        marks = {line.split(",")[0]: line for line in (course / "out" / name).read_text().splitlines()}
        assert '"0"' not in marks['"s1"']
    assert "No answers were handed in" in (course / "pages" / "s1.html").read_text(encoding="utf-8")
    # In the table of all, those without a folder too.
    assert all(f"<td>{name}</td>" in page for name in ("Anna Berg", "Eva Müller", "Ben Dorn"))


def test_an_empty_handout_hides_no_attempts_and_an_empty_attempt_counts_for_nothing(course: Path):
    hand_in(
        course, {"s1/answers.toml": BLANK, "s1/attempt 1/answers.toml": "", "s1/attempt 2/answers.toml": right("s1")}
    )
    hand_in(course, {"s2/attempt 1/answers.toml": right("s2"), "s2/attempt 2/answers.toml": BLANK})
    _, records = grade(course)
    assert [records[student]["total"] for student in ("s1", "s2")] == [EXERCISE.marks] * 2
    assert "2 attempts were handed in; the last one with answers counts" in records["s2"]["notes"]


def test_the_student_whom_a_strange_folder_may_mean_is_named(course: Path):
    hand_in(course, {"Mueller_E/answers.toml": right("s2"), "s1/answers.toml": right("s1")})
    assert (
        "not graded: Mueller_E: no student of the course has this id, address or name; did you mean s2 (Eva"
        in (grade(course)[0])
    )


def test_a_total_is_taken_for_anyone_of_the_roster(course: Path):
    hand_in(course, {"s1/answers.toml": right("s1")})
    (course / TEACHER_FOLDER / OVERRIDES_FILE).write_text(
        "student,answer,marks,comment\nEva Müller,total,3,drawn on paper\n"
    )
    said, records = grade(course)
    assert records["s2"]["total"] == 3
    assert "not handed in: s3" in said
    assert "drawn on paper" in (course / "pages" / "s2.html").read_text(encoding="utf-8")
    name = EXERCISE.answers[0].name
    (course / TEACHER_FOLDER / OVERRIDES_FILE).write_text(f"student,answer,marks,comment\ns2,{name},1,\n")
    with pytest.raises(
        TaskError, match=r"line 2: answer is .*total: s2 has not handed in; give the marks as the total"
    ):
        grade(course)


def test_after_full_marks_by_hand_nothing_is_called_wrong(course: Path):
    first = EXERCISE.answers[0]
    wrong = {**key(issued(NAME, "s1")[1]), first.name: 1e4}
    hand_in(course, {"s1/answers.toml": answer_lines(wrong)})
    _, records = grade(course, follow_through=MarksPolicy().follow_through)
    assert "farther off" in " ".join(records["s1"]["feedback"])
    text = f"student,answer,marks,comment\ns1,{first.name},{first.marks:g},another ordinate\n"
    (course / TEACHER_FOLDER / OVERRIDES_FILE).write_text(text)
    _, records = grade(course)
    assert records["s1"]["total"] == EXERCISE.marks
    page = (course / "pages" / "s1.html").read_text(encoding="utf-8")
    assert "by your teacher: another ordinate" in page
    for said in ("farther off", "steps again", 'class="wrong"', "The first wrong step"):
        assert said not in page
    assert "farther off" not in (course / "out" / "grades-moodle.csv").read_text(encoding="utf-8")


def test_notes_reach_the_feedback_for_moodle(course: Path):
    hand_in(course, {"s1/answers.toml": right("s1") + "S0 9 = 3\n"})
    _, records = grade(course)
    (row,) = table(course, "grades-moodle.csv")
    assert records["s1"]["notes"]
    assert all(note in row["Feedback"] for note in records["s1"]["notes"])


def test_a_course_without_its_teachers_folder_is_recognised(course: Path, tmp_path: Path):
    alone = tmp_path / "alone"
    (alone / "students" / "s1").mkdir(parents=True)
    (alone / "students" / "s1" / "answers.toml").write_text(right("s1"))
    out = tmp_path / "g.csv"
    with pytest.raises(TaskError, match="alone: the course's secret is missing, but must be given") as error:
        grade_course(Course(alone, None, out, exercise=NAME))
    assert HIDDEN_FOLDER not in str(error.value)
    grade_course(Course(alone, course / "secret", out, exercise=NAME))
    assert [row["student"] for row in csv.DictReader(out.read_text().splitlines())] == ["s1"]


def test_grades_are_written_into_no_workbook(course: Path):
    with pytest.raises(OutputError, match=r"name a file that ends in \.csv"):
        grade_course(Course(course / "in", course / "secret", course / "grades.xlsx"))


def test_what_is_lost_of_a_course_is_named(course: Path):
    (course / TEACHER_FOLDER / "course.json").write_text('{"exercise": "mine"}')
    with pytest.raises(TaskError, match=r"there is no file .*mine.toml; put the exercise's file back there"):
        grade(course)
    (course / TEACHER_FOLDER / "course.json").write_text(json.dumps({"exercise": NAME}))
    (course / TEACHER_FOLDER / "keys.csv").touch()
    with pytest.raises(TaskError, match=r"keys\.csv still has the keys for marking by hand"):
        grade_course(Course(course / "in", None, course / "grades.csv"))


def test_only_so_many_files_are_looked_into(course: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(answer_search, "MAX_SEARCHED_PLACES", 2)
    hand_in(course, {f"s1/{k}.toml": "" for k in range(5)} | {"s1/x.toml": right("s1")})
    assert "not graded: s1: no answers can be read from 0.toml, 1.toml, 2.toml" in grade(course)[0]
