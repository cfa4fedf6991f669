"""Deadlines, late penalties and attempts: what is lost, which attempt counts, and where a time was taken from."""

from __future__ import annotations

import csv
import json
import os
import re
import zipfile
from collections.abc import Mapping
from datetime import datetime
from html import unescape
from pathlib import Path
from typing import Any

import pytest
from issued_variants import answer_lines, course_of, issued, key
from russian import english_words
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.errors import DesignError, TaskError
from graphcam.exercises.course.course_folder import TEACHER, AnswerKeys
from graphcam.exercises.course.hand_in_times import SUBMITTED_TIMES, HandInTime, hand_in_times
from graphcam.exercises.course.hand_ins import hand_ins_in
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.grading.attempts import AttemptRule, attempt_rule_of
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.grading.deadlines import EXTENSIONS, LatePenalty, deadline_of, late_penalty_of
from graphcam.exercises.grading.overrides import OVERRIDES
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reports.group_page import group_page
from graphcam.exercises.reports.student_page import student_page

NAME = "acceleration-and-scales"
EXERCISE = issued(NAME)[0]
FIRST = EXERCISE.answers[0]
DEADLINE = datetime.fromisoformat("2026-12-01T23:59+01:00")
TENTH_A_DAY = LatePenalty(0.1)
IDS = ("Anna", "Boris", "Clara")


def values(student: str, right: int = 100) -> dict[str, Any]:
    """A student's key, of which so many answers are handed in."""
    return dict(list(key(issued(NAME, student)[1]).items())[:right])


def touch(folder: Path, time: str) -> None:
    changed = datetime.fromisoformat(time).timestamp()
    for path in folder.iterdir():
        os.utime(path, (changed, changed))


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """All have all right; their files were changed in time, one minute late, and three days and an hour late."""
    place = course_of(tmp_path, NAME, {student: answer_lines(values(student)) for student in IDS})
    for student, time in zip(IDS, ("2026-12-01T23:59:59", "2026-12-02T00:00:00", "2026-12-05T00:59:00"), strict=True):
        touch(place / "students" / student, f"{time}+01:00")
    return place


def grade(course: Path, **more: object) -> dict[str, dict[str, Any]]:
    """The records by student."""
    out = course / "out" / "grades.csv"
    order = Course(course, course / "secret", out, feedback=course / "pages", **more)  # type: ignore[arg-type]
    grade_course(order)
    return {record["student"]: record for record in json.loads(out.with_suffix(".json").read_text(encoding="utf-8"))}


def late(course: Path, **more: object) -> dict[str, dict[str, Any]]:
    return grade(course, **{"deadline": DEADLINE, "late": TENTH_A_DAY, **more})


def totals(records: Mapping[str, dict[str, Any]]) -> dict[str, float]:
    """The part of the marks that each has."""
    return {student: record["total"] / record["of"] for student, record in records.items()}


def teacher(course: Path, name: str, text: str) -> None:
    (course / TEACHER / name).write_text(text, encoding="utf-8")


def rows(course: Path) -> dict[str, dict[str, str]]:
    lines = (course / "out" / "grades.csv").read_text(encoding="utf-8").splitlines()
    return {row["student"]: row for row in csv.DictReader(lines)}


def test_every_day_that_has_begun_costs_its_part_and_a_second_of_the_last_minute_nothing(course: Path):
    found = late(course)
    assert totals(found) == pytest.approx({"Anna": 1.0, "Boris": 0.9, "Clara": 0.6})
    # What the drawing earned is still told, answer by answer and in all.
    assert all(answer["marks"] == answer["of"] for answer in found["Clara"]["answers"])
    assert found["Clara"]["late"]["earned"] == EXERCISE.marks
    table = rows(course)
    assert [float(table[student]["earned"]) for student in IDS] == [EXERCISE.marks] * 3
    assert float(table["Clara"]["total"]) == pytest.approx(0.6 * EXERCISE.marks)
    assert float(table["Clara"]["hours_late"]) == 73
    assert {row["time_from"] for row in table.values()} == {"file"}
    page = unescape((course / "pages" / "Clara.html").read_text(encoding="utf-8"))
    assert "Handed in late: 2026-12-05 00:59, but the deadline was 2026-12-01 23:59." in page
    assert f"Of the {EXERCISE.marks:g} marks earned, 60 % count: {0.6 * EXERCISE.marks:g}." in page
    assert f"{EXERCISE.marks:g} before the late penalty" in page
    assert "lateness" not in (course / "pages" / "Anna.html").read_text(encoding="utf-8")
    group = (course / "out" / "grades.html").read_text(encoding="utf-8")
    assert "from the times at which the files were changed: 3" in group
    assert group.count("2026-12-05 00:59") == 1
    assert "Without the late penalty" in group


def test_without_a_deadline_nothing_is_told_of_times_and_without_a_penalty_nothing_is_lost(course: Path):
    assert "late" not in grade(course)["Clara"]
    assert "earned" not in rows(course)["Clara"]
    found = grade(course, deadline=DEADLINE)
    assert totals(found) == {"Anna": 1.0, "Boris": 1.0, "Clara": 1.0}
    assert found["Clara"]["late"]["hours"] == 73
    assert "Handed in late" in (course / "pages" / "Clara.html").read_text(encoding="utf-8")


def test_a_penalty_stops_at_the_least_part_and_may_count_hours(course: Path):
    assert totals(late(course, late=LatePenalty(0.3, least=0.5)))["Clara"] == pytest.approx(0.5)
    assert totals(late(course, late=LatePenalty(0.01, "hour")))["Clara"] == pytest.approx(1 - 0.73)


def test_an_extension_is_the_deadline_of_its_student_alone(course: Path):
    teacher(course, EXTENSIONS, "student;deadline;why\nCLARA;2026-12-04T12:00+01:00;ill\n")
    assert totals(late(course)) == pytest.approx({"Anna": 1.0, "Boris": 0.9, "Clara": 0.9})
    assert rows(course)["Clara"]["deadline"] == "2026-12-04 12:00:00+01:00"


def test_the_table_of_the_learning_system_counts_before_the_files_own_time(course: Path):
    """As Canvas writes a time, and with a line of somebody who handed nothing in."""
    text = "student,submitted\nAnna,2026-12-02 23:00:00 UTC\nClara,2026-12-01T20:00+01:00\nBoris,\n"
    teacher(course, SUBMITTED_TIMES, text)
    assert totals(late(course)) == pytest.approx({"Anna": 0.8, "Boris": 0.9, "Clara": 1.0})
    assert {student: row["time_from"] for student, row in rows(course).items()} == {
        "Anna": "table",
        "Boris": "file",
        "Clara": "table",
    }


def test_a_zip_keeps_the_times_of_its_files_and_a_name_tells_its_own(course: Path):
    with zipfile.ZipFile(course / "all.zip", "w") as archive:
        archive.writestr(zipfile.ZipInfo("Anna/answers.toml", (2026, 12, 3, 10, 0, 0)), answer_lines(values("Anna")))
        name = "Cams_Boris_attempt_2026-12-02-10-00-00_answers.toml"
        archive.writestr(zipfile.ZipInfo(name, (2026, 12, 31, 10, 0, 0)), answer_lines(values("Boris")))
    out = course / "out" / "grades.csv"
    # Neither tells its zone; that of the machine is meant, as of the deadline.
    deadline = deadline_of("2026-12-01T23:59")
    grade_course(Course(course / "all.zip", course / "secret", out, deadline=deadline, late=TENTH_A_DAY))
    table = rows(course)
    assert {student: (row["time_from"], float(row["total"])) for student, row in table.items()} == {
        "Anna": ("file", pytest.approx(0.8 * EXERCISE.marks)),
        "Boris": ("name", pytest.approx(0.9 * EXERCISE.marks)),
    }


def test_marks_by_hand_win_a_total_over_the_penalty_too(course: Path):
    rest = EXERCISE.marks - FIRST.marks
    teacher(course, OVERRIDES, f"student,answer,marks,comment\nBoris,{FIRST.name},0,\nClara,total,1,as agreed\n")
    found = late(course)
    assert found["Boris"]["total"] == pytest.approx(0.9 * rest, abs=0.005)
    assert found["Clara"]["total"] == 1
    assert found["Clara"]["late"]["earned"] == 1
    page = (course / "pages" / "Clara.html").read_text(encoding="utf-8")
    assert "Handed in late" in page
    assert "before the late penalty" not in page


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of nbgrader's own use of its database
def test_nbgraders_grade_book_takes_the_penalty_off_the_scores(course: Path):
    from nbgrader.api import Gradebook

    database = f"sqlite:///{course / 'book.db'}"
    late(course, gradebook=database)
    with Gradebook(database, NAME) as book:
        handed_in = {student: book.find_submission_notebook("answers", NAME, student) for student in IDS}
        assert {student: one.score for student, one in handed_in.items()} == dict.fromkeys(IDS, EXERCISE.marks)
        lost = {student: one.late_submission_penalty / EXERCISE.marks for student, one in handed_in.items()}
    assert lost == pytest.approx({"Anna": 0.0, "Boris": 0.1, "Clara": 0.4})


def attempts(course: Path, made: Mapping[str, tuple[int, str]]) -> None:
    """In place of Anna's folder one with folders of attempts: how many answers are in each, and when it came."""
    folder = course / "students" / "Anna"
    (folder / "answers.toml").unlink()
    for name, (right, time) in made.items():
        (folder / name).mkdir()
        (folder / name / "answers.toml").write_text(answer_lines(values("Anna", right)))
        touch(folder / name, time)


MADE = {
    "Attempt_2": (3, "2026-12-01T11:00+01:00"),
    "attempt 1": (1, "2026-12-01T10:00+01:00"),
    "attempt 10": (2, "2026-12-01T13:00+01:00"),
    "Попытка 3": (100, "2026-12-20T12:00+01:00"),
}
"""The best one comes so late that the second is worth more; the tenth is the last."""


@pytest.mark.parametrize(
    ("rule", "number"),
    [("last", 10), ("best", 2), ("last:2", 2), ("best:1", 1), ("last:3", 3)],
)
def test_the_attempt_counts_that_the_rule_says(course: Path, rule: str, number: int):
    attempts(course, MADE)
    record = late(course, attempts=attempt_rule_of(rule))["Anna"]
    assert [one["attempt"] for one in record["attempts"]] == [1, 2, 3, 10]
    assert [one["attempt"] for one in record["attempts"] if one["counts"]] == [number]
    chosen = {"1": 1, "2": 3, "3": 100, "10": 2}[str(number)]
    assert sum(answer["marks"] > 0 for answer in record["answers"]) == min(chosen, len(record["answers"]))
    assert rows(course)["Anna"]["attempt"] == str(number)
    assert len(rows(course)) == 3
    assert any(note.startswith("4 attempts were handed in") for note in record["notes"])
    page = unescape((course / "pages" / "Anna.html").read_text(encoding="utf-8"))
    assert page.count("<td>counts</td>") == 1
    assert "Your attempts" in page


def test_without_a_penalty_the_best_attempt_is_the_one_with_most_marks_and_of_equals_the_later(course: Path):
    attempts(course, MADE)
    best = AttemptRule("best")
    assert grade(course, attempts=best)["Anna"]["total"] == EXERCISE.marks
    (course / "students" / "Anna" / "attempt 10" / "answers.toml").write_text(answer_lines(values("Anna")))
    record = grade(course, attempts=best)["Anna"]
    assert [one["attempt"] for one in record["attempts"] if one["counts"]] == [10]


def test_a_time_in_the_table_is_that_of_the_attempt_it_names_or_else_of_the_last(course: Path):
    attempts(course, MADE)
    text = "student,attempt,submitted\nAnna,2,2026-12-03T00:00+01:00\nAnna,,2026-12-04T00:00+01:00\n"
    teacher(course, SUBMITTED_TIMES, text)
    found = {one["attempt"]: one["submitted"] for one in late(course)["Anna"]["attempts"]}
    assert found == {
        1: "2026-12-01 10:00:00+01:00",
        2: "2026-12-03 00:00:00+01:00",
        3: "2026-12-20 12:00:00+01:00",
        10: "2026-12-04 00:00:00+01:00",
    }


def test_of_any_number_of_attempts_the_first_and_the_last_are_read(course: Path):
    """Students may pack as many folders as they like, each of which takes the time of a hand-in."""
    attempts(course, {f"attempt {k}": (0, "2026-12-01T10:00+01:00") for k in range(1, 400)})
    (course / "students" / "Anna" / "attempt 200" / "answers.toml").write_text(answer_lines(values("Anna")))
    record = grade(course, attempts=AttemptRule("best"))["Anna"]
    assert [one["attempt"] for one in record["attempts"]] == [*range(1, 11), *range(390, 400)]
    assert record["total"] == 0
    assert "only the first 10 and the last 10 attempts are read" in record["notes"]


def test_a_time_that_nothing_tells_is_not_late_and_told_as_not_known(course: Path):
    """Of an empty folder, and of one that may not be looked into."""
    (course / "students" / "Anna" / "answers.toml").unlink()
    (course / "students" / "Boris").chmod(0o000)
    user = os.geteuid()
    found, _ = hand_ins_in(course / "students", AnswerKeys(course / TEACHER))
    if user == 0:
        os.seteuid(65534)  # root may look into everything
    try:
        times = hand_in_times([one for one in found if one.student != "Clara"], {}, NAME)
    finally:
        os.seteuid(user)
        (course / "students" / "Boris").chmod(0o700)
    assert times == [HandInTime(None, "")] * 2
    teacher(course, "overrides.csv", "student,answer,marks,comment\nAnna,total,1,on paper\n")
    assert late(course)["Anna"]["late"]["hours"] == 0
    assert "time of handing in not known: 1" in (course / "out" / "grades.html").read_text(encoding="utf-8")


def test_folders_of_attempts_beside_answers_are_not_read_and_a_link_is_no_attempt(course: Path):
    attempts(course, MADE)
    (course / "students" / "Anna" / "attempt 11").symlink_to(course / "students" / "Boris")
    assert len(grade(course)["Anna"]["attempts"]) == 4
    (course / "students" / "Anna" / "answers.toml").write_text(answer_lines(values("Anna")))
    record = grade(course)["Anna"]
    assert record["total"] == EXERCISE.marks
    assert "attempts" not in record
    assert "the folders of attempts beside the answers are not read" in record["notes"]


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        (EXTENSIONS, "student,deadline\nDora,2026-12-03T00:00\n", r"line 2: student is 'Dora'.*check the id"),
        (EXTENSIONS, "student,deadline\nAnna,tomorrow\n", r"line 2: deadline is 'tomorrow', .* a date and a time"),
        (EXTENSIONS, "student,deadline\nAnna,2026-12-03\n", r"line 2: deadline is '2026-12-03'"),
        (EXTENSIONS, "student,deadline\nAnna,2026-12-03T00:00\nANNA,2026-12-04T00:00\n", r"line 3: .* student once"),
        (EXTENSIONS, "who,until\nAnna,2026-12-03T00:00\n", r"the first line is 'who,until', .* with student,deadline"),
        (SUBMITTED_TIMES, "student,submitted\nAnna,31.12.2026\n", r"line 2: submitted is '31.12.2026'"),
        (SUBMITTED_TIMES, "student,submitted,attempt\nAnna,2026-12-03T00:00,two\n", r"line 2: attempt is 'two'"),
        (SUBMITTED_TIMES, "student,submitted\nAnna,2026-12-03T00:00\nAnna,2026-12-03T00:00\n", r"line 3: attempt"),
    ],
)
def test_a_table_that_cannot_be_used_is_told_before_anything_is_graded(
    course: Path, name: str, text: str, message: str
):
    teacher(course, name, text)
    with pytest.raises(TaskError, match=message):
        late(course)
    assert not (course / "out").exists()
    # Without a deadline it is not needed.
    assert totals(grade(course))["Anna"] == 1


@pytest.mark.parametrize("text", ["1.5/day", "0/day", "0.1", "0.1/week", "-0.1/day", "0.1/day:2", "nan/day", ""])
def test_a_penalty_that_is_none_is_told(text: str):
    with pytest.raises(DesignError, match=r"--late is .*such as 0.1/day or 0.1/day:0.5"):
        late_penalty_of(text)


@pytest.mark.parametrize("text", ["best:0", "first", "best:", "2", "best:11"])
def test_a_rule_for_attempts_that_is_none_is_told(text: str):
    with pytest.raises(DesignError, match=r"--attempts is .*last or best"):
        attempt_rule_of(text)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--deadline", "2026-12-01"], "--deadline is '2026-12-01', but must be a date and a time such as"),
        (["--late", "0.1/day"], "--late: the deadline is not given"),
        (["--deadline", "2026-12-01T23:59", "--late", "much"], "--late is 'much'"),
    ],
)
def test_the_command_ends_on_a_wrong_option_with_one_message(course: Path, options: list[str], message: str):
    place, secret, out = str(course), str(course / "secret"), str(course / "out" / "grades.csv")
    ran = CliRunner().invoke(
        app, ["exercise", "grade", place, "--secret-file", secret, "--out", out, "--workers", "1", *options]
    )
    assert ran.exit_code == 2
    assert message in " ".join(ran.output.split())
    assert not (course / "out").exists()


def test_the_pages_say_it_in_russian(course: Path):
    attempts(course, MADE)
    late(course, attempts=attempt_rule_of("best:3"))
    kept, exercise = AnswerKeys(course / TEACHER), find_exercise(NAME, "ru")
    course_json = json.loads((course / TEACHER / "course.json").read_text())
    (course / TEACHER / "course.json").write_text(json.dumps(course_json | {"language": "ru"}))
    records = late(course, attempts=attempt_rule_of("best:3"))
    answer_keys = {student: AnswerKey.from_json(kept.find(student)) for student in IDS}
    pages = [group_page(exercise, list(records.values()), answer_keys)]
    pages += [student_page(exercise, records[student], answer_keys[student]) for student in IDS]
    for page in pages:
        text = re.sub(r"<style>.*?</style>|<[^>]*>", " ", page, flags=re.DOTALL)
        names = (*IDS, *(asked.name for asked in exercise.answers), *exercise.parameters, "submitted.csv")
        assert english_words(text, names) == set()
    assert "Сдано с опозданием" in pages[3]
