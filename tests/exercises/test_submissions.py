"""Folders as learning systems pack them: each student's is found by the roster, and what is nobody's is told."""

from __future__ import annotations

import csv
import json
import stat
import zipfile
from pathlib import Path

import pytest
from issued_variants import course_of, issued, key
from over_all import fast_first
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.errors import TaskError
from graphcam.exercises.course import zipped_submissions as packed_files
from graphcam.exercises.course.course_folder import ANSWER_KEYS_FOLDER, ROSTER_FILE, TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.submissions import hand_ins_in
from graphcam.exercises.grading.course_grading import FORMER_TABLES, Course, grade_course

NAME = "acceleration-and-scales"
STUDENTS = """id,name,email
s-17,Anna Müller,anna.m@uni.edu
S 18,Ben Berg,ben@uni.edu
4711,Анна Кузнецова,kuz@uni.edu
bb_4,Cem van der Aa,cem@uni.edu
"""
IDS = ("s-17", "S 18", "4711", "bb_4")


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A course as 'make' leaves it, with the roster and everybody's answer key."""
    course_of(tmp_path, NAME, dict.fromkeys(IDS))
    (tmp_path / TEACHER_FOLDER / ROSTER_FILE).write_text(STUDENTS, encoding="utf-8")
    (tmp_path / "packed").mkdir()
    return tmp_path


def answers(student: str) -> str:
    return "".join(f"{name} = {value!r}\n" for name, value in key(issued(NAME, student)[1]).items())


def grade(course: Path, **more: object) -> tuple[str, dict[str, float]]:
    """What the command says, and every student's marks."""
    out = course / "out" / "grades.csv"
    told = grade_course(Course(course / "packed", course / "secret", out, feedback=course / "pages", **more))  # type: ignore[arg-type]
    said = "\n".join(map(str, told))
    records = json.loads(out.with_suffix(".json").read_text(encoding="utf-8"))
    return said, {record["student"]: record["total"] for record in records}


FOLDERS = {
    "Moodle": [
        ("Anna Müller_1234_assignsubmission_file_", "s-17"),
        ("Ben Berg_1235_assignsubmission_file", "S 18"),
        ("Анна Кузнецова_1236_assignsubmission_file_", "4711"),
    ],
    "plain": [("S-17", "s-17"), ("s18", "S 18"), ("KUZ@uni.edu", "4711"), ("van der Aa, Cem", "bb_4")],
    "composed otherwise": [("Anna Mu\u0308ller", "s-17")],
}
FILES = {
    "Canvas": [
        ("mulleranna_12345_67890_answers.toml", "s-17"),
        ("bergben_LATE_12346_67891_answers.toml", "S 18"),
        ("someone_4711_67892_answers.toml", "4711"),
    ],
    "Blackboard": [
        ("Cams 1_s-17_attempt_2026-11-20-12-30-00_answers.toml", "s-17"),
        ("Cams_2_bb_4_attempt_2026-11-20-12-31-00_answers.toml", "bb_4"),
    ],
    "Moodle": [("Anna Müller_1234_assignsubmission_file_answers.toml", "s-17")],
}


@pytest.mark.parametrize("system", fast_first(FOLDERS))
def test_a_folder_of_a_learning_system_is_that_of_the_student(course: Path, system: str):
    for folder, student in FOLDERS[system]:
        (course / "packed" / folder).mkdir()
        (course / "packed" / folder / "answers.toml").write_text(answers(student))
    said, marks = grade(course)
    assert marks == {student: issued(NAME)[0].marks for _, student in FOLDERS[system]}
    assert "not graded" not in said


@pytest.mark.parametrize("system", FILES)
def test_files_of_a_learning_system_are_those_of_the_student(course: Path, system: str):
    for file, student in FILES[system]:
        (course / "packed" / file).write_text(answers(student))
    (course / "packed" / "read-me.txt").touch()
    said, marks = grade(course)
    assert marks == {student: issued(NAME)[0].marks for _, student in FILES[system]}
    assert "not graded" not in said


def test_a_stranger_gets_neither_marks_nor_a_key_and_is_told_by_name(course: Path):
    for folder in ("s-17", "Dora Nobody_1_assignsubmission_file_", "Anna"):
        (course / "packed" / folder).mkdir()
    before = sorted(path.name for path in (course / TEACHER_FOLDER / ANSWER_KEYS_FOLDER).iterdir())
    said, marks = grade(course)
    assert marks == {"s-17": 0}
    assert sorted(path.name for path in (course / TEACHER_FOLDER / ANSWER_KEYS_FOLDER).iterdir()) == before
    assert [path.name for path in (course / "pages").iterdir()] == ["s-17.html"]
    why = "no student of the course has this id, address or name"
    assert said.splitlines()[1:] == [
        f"not graded: Anna: {why}",
        f"not graded: Dora Nobody_1_assignsubmission_file_: {why}",
        "not handed in: 4711, S 18, bb_4, s-17",
    ]
    table = list(csv.DictReader((course / "out" / "grades-not-graded.csv").read_text(encoding="utf-8").splitlines()))
    assert [row["folder"] for row in table] == ["Anna", "Dora Nobody_1_assignsubmission_file_"]
    assert f"Anna: {why}" in (course / "out" / "grades.html").read_text(encoding="utf-8")
    # Once the folders are renamed, the table does not go on telling about them.
    for folder in ("Dora Nobody_1_assignsubmission_file_", "Anna"):
        (course / "packed" / folder).rmdir()
    grade(course)
    assert len((course / "out" / "grades-not-graded.csv").read_text().splitlines()) == 1


def test_what_may_be_that_of_two_is_graded_for_neither(course: Path):
    with (course / TEACHER_FOLDER / ROSTER_FILE).open("a", encoding="utf-8") as roster:
        roster.write("s19,Müller Anna,\n")
    for folder in ("Anna Müller_1_assignsubmission_file_", "4711", "kuz@uni.edu"):
        (course / "packed" / folder).mkdir()
    found, refused = hand_ins_in(course / "packed", AnswerKeys(course / TEACHER_FOLDER))
    assert found == []
    assert {one.place: str(one.why) for one in refused} == {
        "Anna Müller_1_assignsubmission_file_": "it may belong to several students: s-17, s19",
        "4711": "several of these belong to 4711; keep one",
        "kuz@uni.edu": "several of these belong to 4711; keep one",
    }


def test_of_several_attempts_the_last_one_counts_and_it_is_noted(course: Path):
    name = "Cams_s-17_attempt_2026-11-{day}-12-30-00"
    (course / "packed" / f"{name.format(day=19)}_answers.toml").write_text("")
    (course / "packed" / f"{name.format(day=20)}_answers.toml").write_text(answers("s-17"))
    (course / "packed" / f"{name.format(day=20)}.txt").write_text("Name: Anna")
    _, marks = grade(course)
    assert marks == {"s-17": issued(NAME)[0].marks}
    record = json.loads((course / "out" / "grades.json").read_text(encoding="utf-8"))[0]
    assert "2 attempts were handed in; the last one with answers counts" in record["notes"]


def attempts(course: Path, made: dict[str, int]) -> dict[str, object]:
    """The record of a student with folders of attempts, each with so many answers."""
    for name, right in made.items():
        folder = course / "packed" / "s-17" / name
        folder.mkdir(parents=True)
        (folder / "answers.toml").write_text("".join(answers("s-17").splitlines(keepends=True)[:right]))
    grade(course)
    return json.loads((course / "out" / "grades.json").read_text(encoding="utf-8"))[0]


def test_the_attempt_with_the_highest_number_counts(course: Path):
    found = attempts(course, {"Attempt_2": 3, "attempt 1": 1, "attempt 10": 2, "Попытка 3": 99})
    assert found["notes"] == ["4 attempts were handed in; the last one with answers counts"]
    assert sum(answer["marks"] > 0 for answer in found["answers"]) == 2
    assert "4 attempts were handed in" in (course / "pages" / "s-17.html").read_text(encoding="utf-8")


def test_of_any_number_of_attempts_the_newest_are_looked_into(course: Path):
    """Students may pack as many folders as they like, each of which takes time."""
    made = {f"attempt {k}": 0 for k in range(1, 400)}
    assert attempts(course, {**made, "attempt 200": 99})["total"] == 0
    (course / "packed" / "s-17" / "attempt 395" / "answers.toml").write_text(answers("s-17"))
    assert attempts(course, {})["total"] == issued(NAME)[0].marks


def test_folders_of_attempts_beside_answers_are_not_read_and_a_link_is_no_attempt(course: Path):
    folder = course / "packed" / "s-17"
    (course / "elsewhere").mkdir()
    (course / "elsewhere" / "answers.toml").write_text("")
    folder.mkdir()
    (folder / "attempt 11").symlink_to(course / "elsewhere")
    assert attempts(course, {"attempt 1": 1, "attempt 2": 99})["total"] == issued(NAME)[0].marks
    (folder / "answers.toml").write_text(answers("s-17"))
    found = attempts(course, {"attempt 3": 1})
    assert found["total"] == issued(NAME)[0].marks
    assert "the folders of attempts beside the answers are not read" in found["notes"]


IN_THE_PLATFORM = "keep deadlines, late penalties, attempts and questions about marks in your learning platform"


@pytest.mark.parametrize("table", FORMER_TABLES)
def test_a_table_that_is_not_read_any_more_is_told_before_anything_is_graded(course: Path, table: str):
    (course / TEACHER_FOLDER / table).write_text("student,deadline\ns-17,2026-12-08T23:59+01:00\n")
    (course / "packed" / "s-17").mkdir()
    told = rf"{table}: the table is given, but must be left out; {IN_THE_PLATFORM}, and delete the file"
    with pytest.raises(TaskError, match=told):
        grade(course)
    assert not (course / "out").exists()


@pytest.mark.parametrize("option", ["--deadline=2026-12-01T23:59", "--late=0.1/day", "--attempts=best:3"])
def test_an_option_that_went_ends_with_one_message(course: Path, option: str):
    out = course / "out" / "grades.csv"
    ran = CliRunner().invoke(app, ["exercise", "grade", str(course / "packed"), "--out", str(out), option])
    assert ran.exit_code == 2
    value = option.partition("=")[2]
    told = f"graphcam: --deadline, --late or --attempts is '{value}', but must be left out; {IN_THE_PLATFORM}\n"
    assert ran.output == told
    assert not out.parent.exists()


def test_an_attempt_without_a_file_reads_nobody_elses_answers(course: Path):
    (course / "packed" / "answers.toml").write_text(answers("s-17"))
    (course / "packed" / "Cams_s-17_attempt_2026-11-20-12-30-00.txt").write_text("Name: Anna")
    assert grade(course)[1] == {"s-17": 0}


def test_a_roster_that_is_named_counts_instead_of_the_kept_one(course: Path):
    (course / "other.csv").write_text("id,name\ns-17,Eva Dorn\n")
    (course / "packed" / "Eva Dorn_9_assignsubmission_file_").mkdir()
    (course / "packed" / "4711").mkdir()
    said, marks = grade(course, roster=course / "other.csv")
    assert list(marks) == ["s-17"]
    assert "not graded: 4711:" in said


def packed(course: Path, files: dict[str, str]) -> zipfile.ZipFile:
    archive = zipfile.ZipFile(course / "all.zip", "w", zipfile.ZIP_DEFLATED)
    for name, text in files.items():
        archive.writestr(name, text)
    return archive


def graded_zip(course: Path) -> tuple[str, dict[str, float]]:
    out = course / "out" / "grades.csv"
    said = "\n".join(map(str, grade_course(Course(course / "all.zip", course / "secret", out))))
    records = json.loads(out.with_suffix(".json").read_text(encoding="utf-8"))
    return said, {record["student"]: record["total"] for record in records}


def test_a_zip_of_all_is_graded_as_its_folders_are(course: Path):
    files = {
        "Anna Müller_1234_assignsubmission_file_/answers.toml": answers("s-17"),
        "bergben_12346_67891_answers.toml": answers("S 18"),
        "__MACOSX/._answers.toml": "",
        "Кузнецова Анна/": "",
    }
    packed(course, files).close()
    said, marks = graded_zip(course)
    assert marks == {"s-17": issued(NAME)[0].marks, "S 18": issued(NAME)[0].marks, "4711": 0}
    assert "not graded" not in said


def test_what_a_zip_would_put_elsewhere_is_told_and_the_others_are_graded(course: Path):
    link = zipfile.ZipInfo("S 18/answers.toml")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    files = {name: answers("s-17") for name in ("../4711/answers.toml", "/tmp/answers.toml", "s-17/answers.toml")}
    with packed(course, {**files, "a/b/c/d/answers.toml": ""}) as archive:
        archive.writestr(link, str(course / "secret"))
    said, marks = graded_zip(course)
    assert marks == {"s-17": issued(NAME)[0].marks}
    assert not (course / "4711").exists()
    assert said.splitlines()[1:5] == [
        "not graded: ../4711/answers.toml: its path leads out of the folder",
        "not graded: /tmp/answers.toml: its path leads out of the folder",
        "not graded: a/b/c/d/answers.toml: it lies too deep",
        "not graded: S 18/answers.toml: it is a link or a device, not a file",
    ]
    assert said.splitlines()[5].startswith("not handed in: 4711, ")


def test_a_file_that_unpacks_without_end_is_read_to_its_limit_only(course: Path, monkeypatch: pytest.MonkeyPatch):
    packed(course, {"s-17/answers.toml": " " * 30_000_000, "4711/answers.toml": answers("4711")}).close()
    assert graded_zip(course)[1] == {"s-17": 0, "4711": issued(NAME)[0].marks}
    monkeypatch.setattr(packed_files, "MAX_BYTES", 10_000_000)
    with pytest.raises(TaskError, match="bytes unpacked"):
        graded_zip(course)


def test_a_zip_that_is_broken_or_of_no_course_is_told(course: Path, tmp_path_factory: pytest.TempPathFactory):
    packed(course, {"s-17/answers.toml": answers("s-17")}).close()
    data = (course / "all.zip").read_bytes()
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    (elsewhere / "all.zip").write_bytes(data)
    with pytest.raises(TaskError, match="beside the folder 'teacher'"):
        grade_course(Course(elsewhere / "all.zip", course / "secret", elsewhere / "grades.csv", exercise=NAME))
    (course / "all.zip").write_bytes(data[:40])
    with pytest.raises(TaskError, match="the folder is a file, but must be one with a folder for every student"):
        graded_zip(course)
    assert sorted(path.name for path in elsewhere.iterdir()) == ["all.zip"]
