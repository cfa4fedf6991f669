"""Exports: what Moodle, Gradescope and nbgrader read is what graphcam marks."""

from __future__ import annotations

import base64
import csv
import email
import hashlib
import io
import json
import math
import os
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import nbformat
import pytest
from issued_variants import SECRET, issued, key, marked
from russian import english_words

from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.roster import Student, folder_name, read_roster
from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.exports import LearningSystem, gradescope
from graphcam.exercises.exports.export import export
from graphcam.exercises.exports.gradescope import write_wheel
from graphcam.exercises.exports.moodle import moodle_xml
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.marking import mark

NAME = "acceleration-and-scales"
IDS = ("Anna", "=cmd", "Иван")


def questions(name: str) -> list[ElementTree.Element]:
    exercise, answer_key = issued(name)
    return list(ElementTree.fromstring(moodle_xml(exercise, [answer_key]).encode()))


def text(element: ElementTree.Element | None) -> str:
    assert element is not None
    return element.findtext("text") or ""


def moodle_says(question: ElementTree.Element, value: float) -> tuple[float, str]:
    """Fraction and feedback of a numerical question by Moodle's rule: the first answer within whose tolerance it is."""
    for answer in question.findall("answer"):
        tolerance = float(answer.findtext("tolerance") or "nan")
        if text(answer) == "*" or abs(value - float(text(answer))) <= tolerance:
            return float(answer.get("fraction", "nan")) / 100, text(answer.find("feedback"))
    return 0.0, ""


@pytest.mark.parametrize("name", [NAME, "inversion-translating"])
def test_moodle_has_the_key_its_tolerance_and_the_marks(name: str):
    exercise, answer_key = issued(name)
    kinds = [question.get("type") for question in questions(name)]
    assert kinds == ["category", "description", *("numerical" if asked.kind == "number" else "essay"
                                                  for asked in exercise.answers)]  # fmt: skip
    for asked, question in zip(exercise.answers, questions(name)[2:], strict=True):
        assert float(question.findtext("defaultgrade") or "nan") == asked.marks
        if asked.kind == "number":
            first = question.findall("answer")[0]
            expected = answer_key.keys[asked.name]
            assert float(text(first)) == pytest.approx(expected.expected.value, rel=1e-9)
            assert float(first.findtext("tolerance") or "nan") == pytest.approx(expected.tolerance, rel=1e-9)
            assert first.get("fraction") == "100"
        else:
            assert asked.layer in text(question.find("questiontext"))


def russian_texts(folder: Path) -> list[str]:
    """What a student reads of an export."""
    found = [path.read_text(encoding="utf-8") for path in folder.glob("sheets/*.md")]
    for path in folder.glob("*.xml"):
        found += [element.text or "" for element in ElementTree.parse(path).iter("text")]
    for path in folder.glob("source/*/*.ipynb"):
        cells = nbformat.read(path, 4).cells
        found += [cell.source for cell in cells if cell.cell_type == "markdown"]
    return found


@pytest.mark.parametrize("target", [LearningSystem.MOODLE, LearningSystem.NBGRADER])
def test_an_export_is_in_the_language_of_the_course(target: LearningSystem, tmp_path: Path):
    export("inversion-translating", target, [Student("Анна")], tmp_path / "out", SECRET, language="ru")
    exercise = find_exercise("inversion-translating", "ru")
    names = [asked.name for asked in exercise.answers]
    texts = russian_texts(tmp_path / "out")
    assert len(texts) > len(names)
    for text in texts:
        assert english_words(text, [*names, "course", "None", "DXF", "PITCH"]) == set()
    assert AnswerKeys(tmp_path / "out" / TEACHER_FOLDER).course_exercise().language == "ru"


def test_gradescope_tells_the_result_in_the_language_of_the_course():
    exercise = find_exercise(NAME, "ru")
    record = mark(exercise, issued(NAME)[1], Answers({"mu_s": 1.0}))
    results = gradescope.results(exercise, record.to_dict())
    told = [results["output"], *(test["output"] for test in results["tests"])]
    assert set().union(*(english_words(text, [asked.name for asked in exercise.answers]) for text in told)) == set()


def test_moodle_keeps_a_student_of_any_name_in_one_category():
    exercise, answer_key = issued(NAME)
    xml = moodle_xml(exercise, [replace(answer_key, student="a/b\x07")])
    category = ElementTree.fromstring(xml.encode()).findtext("question/category/text")
    assert category == f"$course$/{exercise.title}/a%2Fb%07"


def test_moodle_marks_one_answer_as_graphcam_does():
    exercise, answer_key = issued(NAME)
    for asked, question in zip(exercise.answers, questions(NAME)[2:], strict=True):
        expected = answer_key.keys[asked.name]
        for part in (-30.0, -1 - 1e-6, -1 + 1e-6, -0.3, 0.0, 0.999, 1.001, 4.0):
            value = float(str(expected.expected.value)) + part * expected.tolerance
            ours = next(one for one in marked(NAME, **{asked.name: value}).answers if one.name == asked.name)
            assert moodle_says(question, value)[0] == (1.0 if ours.outcome == "right" else 0.0), (asked.name, part)


def test_moodle_says_which_mistake_it_was():
    exercise, answer_key = issued(NAME)
    said = 0
    for k, (asked, question) in enumerate(zip(exercise.answers, questions(NAME)[2:], strict=True)):
        keyed = answer_key.keys[asked.name]
        for name, values in answer_key.hypotheses.items():
            wrong = float(str(values[k].value))
            fraction, feedback = moodle_says(question, wrong)
            if abs(wrong - float(str(keyed.expected.value))) <= keyed.tolerance:
                assert fraction == 1.0
            else:
                assert fraction == 0.0
                said += feedback == str(misconception(name).said)
        assert "careful drawing" in moodle_says(question, 1e7)[1]
    assert said >= len(answer_key.hypotheses)


RESULTS = {"score", "execution_time", "output", "output_format", "test_output_format", "test_name_format",
           "visibility", "stdout_visibility", "extra_data", "tests", "leaderboard"}  # fmt: skip
TEST = {"score", "max_score", "status", "name", "name_format", "number", "output", "output_format", "tags",
        "visibility", "extra_data"}  # fmt: skip
"""The keys that Gradescope's documentation of results.json names."""


def test_an_autograder_writes_gradescopes_results_and_takes_the_exercise_with_it(tmp_path: Path):
    mine = tmp_path / "mine" / "week-5.toml"
    mine.parent.mkdir()
    mine.write_bytes(exercise_path(NAME).read_bytes())
    source = tmp_path / "autograder" / "source"
    export(str(mine), LearningSystem.GRADESCOPE, [Student("anna@example.org")], source)
    mine.unlink()
    answer_key = AnswerKey.from_json(AnswerKeys(source / TEACHER_FOLDER).find("anna@example.org"))
    root = source.parent
    (root / "submission").mkdir()
    (root / "submission_metadata.json").write_text(json.dumps({"users": [{"email": "anna@example.org"}]}))
    values = {name: float(str(value)) for name, value in key(answer_key).items()}
    first = next(iter(values))
    values[first] += 100.0
    (root / "submission" / "answers.toml").write_text(
        "".join(f"{name} = {value!r}\n" for name, value in values.items())
    )
    gradescope.main(root)
    found = json.loads((root / "results" / "results.json").read_text())
    assert set(found) <= RESULTS
    assert found["visibility"] == "visible"
    assert found["stdout_visibility"] == "hidden"
    exercise = issued(NAME)[0]
    assert [test["name"] for test in found["tests"]] == [asked.name for asked in exercise.answers]
    for test, asked in zip(found["tests"], exercise.answers, strict=True):
        assert set(test) <= TEST
        assert (test["max_score"], test["status"] == "passed") == (asked.marks, asked.name != first)
    assert found["score"] == sum(test["score"] for test in found["tests"]) == exercise.marks - exercise.answers[0].marks
    # The student sees this: of the key there is nothing in it.
    shown = json.dumps(found)
    numbers = [value for value in values.values() if not math.isclose(value, round(value))]
    assert numbers
    assert not any(f"{value:.4g}" in shown for value in numbers)
    assert (root / "source" / "run_autograder").stat().st_mode & 0o111


def gradescope_of(tmp_path: Path) -> Path:
    """An autograder's folder, exported for a roster with addresses."""
    roster = tmp_path / "roster.csv"
    roster.write_text("id,email,name\n7,Anna@Example.org,Anna\n8,ben@example.org,Ben\n", encoding="utf-8")
    root = tmp_path / "autograder"
    export(NAME, LearningSystem.GRADESCOPE, read_roster(roster), root / "source", SECRET)
    (root / "submission").mkdir()
    values = key(issued(NAME, "7")[1])
    text = "".join(f"{name} = {float(str(value))!r}\n" for name, value in values.items())
    (root / "submission" / "answers.toml").write_text(text)
    return root


def hand_in_as(root: Path, email: str) -> None:
    (root / "submission_metadata.json").write_text(json.dumps({"users": [{"email": email}]}))


@pytest.mark.slow
def test_gradescope_grades_by_the_rosters_addresses_and_gives_a_stranger_no_variant(tmp_path: Path):
    root = gradescope_of(tmp_path)
    kept = root / "source" / TEACHER_FOLDER / "certificates"
    certificates = {path.name for path in kept.iterdir()}
    assert certificates == {"7.json", "8.json"}
    for address, share in (("anna@example.org", 1.0), ("BEN@example.org", None), ("stranger@example.org", 0.0)):
        hand_in_as(root, address)
        gradescope.main(root)
        found = json.loads((root / "results" / "results.json").read_text())
        assert set(found) <= RESULTS
        if share is None:
            # Another one's answers are not right for the own variant.
            assert len(found["tests"]) > 0
            assert found["score"] < issued(NAME)[0].marks
        else:
            assert found["score"] == share * issued(NAME)[0].marks
    assert found["tests"] == []
    assert "stranger@example.org" in found["output"]
    assert {path.name for path in kept.iterdir()} == certificates


def test_two_students_of_one_address_are_refused(tmp_path: Path):
    students = [Student("7", email="a@example.org"), Student("8", email="A@example.org")]
    with pytest.raises(TaskError, match=r"email.*a@example\.org.*'7'"):
        export(NAME, LearningSystem.GRADESCOPE, students, tmp_path / "out", SECRET)
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_an_autograder_installs_the_wheel_that_lies_in_it_and_grades_with_that(tmp_path: Path):
    root = gradescope_of(tmp_path)
    hand_in_as(root, "anna@example.org")
    assert "pip3 install /autograder/source/graphcam-*.whl" in (root / "source" / "setup.sh").read_text()
    (wheel,) = (root / "source").glob("graphcam-*.whl")
    elsewhere = tmp_path / "installed"
    pip = ("-m", "pip", "install", "--no-deps", "--no-index", "--no-compile", "--target", str(elsewhere), str(wheel))
    run(*pip)
    # The folder stands before every other graphcam that is installed here.
    environment = os.environ | {"PYTHONPATH": str(elsewhere)}
    where = run("-c", "import graphcam; print(graphcam.__file__)", cwd=tmp_path, env=environment)
    assert Path(where.strip()).is_relative_to(elsewhere)
    run("-m", "graphcam.exercises.exports.gradescope", str(root), cwd=tmp_path, env=environment)
    found = json.loads((root / "results" / "results.json").read_text())
    assert found["score"] == issued(NAME)[0].marks
    names = run("-m", "graphcam", "exercise", "list", cwd=tmp_path, env=environment)
    assert NAME in names


def test_every_file_of_the_wheel_is_recorded_with_its_digest(tmp_path: Path):
    wheel = zipfile.ZipFile(write_wheel(tmp_path))
    names = wheel.namelist()
    assert len(names) == len(set(names))
    (record,) = (name for name in names if name.endswith(".dist-info/RECORD"))
    rows = list(csv.reader(io.StringIO(wheel.read(record).decode())))
    assert [row[0] for row in rows] == names
    for name, digest, size in rows[:-1]:
        data = wheel.read(name)
        coded = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")
        assert (digest, int(size)) == (f"sha256={coded}", len(data))
    assert rows[-1][1:] == ["", ""]
    about = email.message_from_bytes(wheel.read(record.replace("RECORD", "METADATA")))
    assert about["Name"] == "graphcam"
    assert any(one.startswith("numpy") for one in about.get_all("Requires-Dist", []))
    assert "graphcam/data/fonts/osifont.ttf" in names
    assert "graphcam/exercises/library/whole-cam.toml" in names


def run(*command: str, **settings: Any) -> str:
    """What a Python of its own prints."""
    done = subprocess.run([sys.executable, *command], capture_output=True, text=True, check=False, **settings)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture
def course(tmp_path: Path) -> Path:
    export(NAME, LearningSystem.NBGRADER, [Student(name) for name in IDS], tmp_path / "course", SECRET)
    (tmp_path / "secret").write_bytes(SECRET)
    return tmp_path / "course"


@pytest.mark.slow
def test_an_nbgrader_assignment_has_a_cell_for_every_answer(course: Path):
    exercise = issued(NAME)[0]
    notebook = nbformat.read(course / "source" / NAME / "answers.ipynb", as_version=4)
    nbformat.validate(notebook)
    said = [cell.metadata.nbgrader for cell in notebook.cells if cell.cell_type == "code"]
    assert [(one.grade_id, one.points) for one in said] == [(asked.name, asked.marks) for asked in exercise.answers]
    assert all(one.schema_version == 3 and one.grade and one.solution and not one.locked for one in said)
    assert {path.stem for path in (course / "sheets").iterdir()} == {folder_name(student) for student in IDS}


def submission(course: Path, notebook: Path) -> None:
    """Every student hands the notebook in, filled in: the first all right, the second one off, the third one open."""
    for k, student in enumerate(IDS):
        values = dict(key(issued(NAME, student)[1]))
        first = next(iter(values))
        values[first] = (values[first], 1e4, None)[k]
        filled = nbformat.read(notebook, as_version=4)
        for cell in filled.cells:
            if cell.cell_type == "code":
                name = cell.source.split(" =")[0]
                cell.source = cell.source.replace(f"{name} = None", f"{name} = {values[name]!r}")
        folder = course / "submitted" / folder_name(student) / NAME
        folder.mkdir(parents=True)
        nbformat.write(filled, folder / "answers.ipynb")


@pytest.mark.slow
def test_what_nbgrader_collects_is_graded(course: Path):
    submission(course, course / "source" / NAME / "answers.ipynb")
    grade_course(Course(course, course.parent / "secret", course / "grades.csv"))
    records = {record["student"]: record for record in json.loads((course / "grades.json").read_text())}
    exercise = issued(NAME)[0]
    lost = exercise.marks - exercise.answers[0].marks
    assert {student: records[student]["total"] for student in IDS} == dict(
        zip(IDS, (exercise.marks, lost, lost), strict=True)
    )
    assert [records[student]["answers"][0]["outcome"] for student in IDS] == ["right", "wrong", "missing"]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of nbgrader's own use of its database
def test_nbgrader_takes_the_course_and_its_grade_book_the_scores(course: Path):
    from nbgrader.api import Gradebook

    nbgrader(course, "generate_assignment", NAME)
    release = course / "release" / NAME / "answers.ipynb"
    submission(course, release)
    assert "Success" in nbgrader(course, "validate", str(course / "submitted" / "Anna" / NAME / "answers.ipynb"))
    database = f"sqlite:///{course / 'gradebook.db'}"
    grade_course(Course(course, course.parent / "secret", course / "grades.csv", gradebook=database))
    records = {record["student"]: record for record in json.loads((course / "grades.json").read_text())}
    exercise = issued(NAME)[0]
    lost = exercise.marks - exercise.answers[0].marks
    assert {record["total"] for record in records.values()} == {exercise.marks, lost}
    with Gradebook(database, NAME) as book:
        assert book.find_assignment(NAME).max_score == issued(NAME)[0].marks
        for student, record in records.items():
            assert book.find_submission(NAME, student).score == record["total"]
            for answer in record["answers"]:
                where = answer["name"], "answers", NAME, student
                assert book.find_grade(*where).score == answer["marks"]
                assert not book.find_grade(*where).needs_manual_grade
                assert (book.find_comment(*where).comment or "").startswith(f"{answer['name']}: ")


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of nbgrader's own use of its database
def test_what_was_changed_in_the_grade_book_stays_and_is_told(course: Path):
    """Marks that were found anew are entered where nobody changed those before."""
    from nbgrader.api import Gradebook

    submission(course, course / "source" / NAME / "answers.ipynb")
    order = Course(course, course.parent / "secret", course / "grades.csv", gradebook=f"sqlite:///{course / 'book.db'}")
    first, second = (asked.name for asked in issued(NAME)[0].answers[:2])
    assert not any("grade book" in str(line) for line in grade_course(order))
    with Gradebook(order.gradebook, NAME) as book:
        changed = book.find_grade(first, "answers", NAME, "Anna")
        changed.manual_score = 0.25
        book.find_comment(second, "answers", NAME, "Anna").manual_comment = "well drawn"
        book.db.commit()
    (course / "teacher" / "overrides.csv").write_text(
        f"student,answer,marks,comment\nAnna,{first},0.5,\nAnna,{second},0.75,see me\n{IDS[1]},{first},0.75,\n"
    )
    for _ in range(2):
        told = [str(line) for line in grade_course(order)][1:]
        assert told == [
            f"Anna, {first}: the grade book keeps 0.25, not 0.5",
            f"Anna, {second}: the grade book keeps its comment",
            # What is handed in here is the answer key itself.
            f"to check: readings as exact as by a program: 3 ({', '.join(sorted(IDS))}); see grades.html",
        ]
        with Gradebook(order.gradebook, NAME) as book:
            scores = [book.find_grade(name, "answers", NAME, "Anna").manual_score for name in (first, second)]
            assert scores == [0.25, 0.75]
            assert book.find_comment(second, "answers", NAME, "Anna").manual_comment == "well drawn"
            assert book.find_grade(first, "answers", NAME, IDS[1]).manual_score == 0.75


def nbgrader(course: Path, *command: str) -> str:
    done = subprocess.run([sys.executable, "-m", "nbgrader", *command], cwd=course, capture_output=True, text=True,
                          check=False)  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout + done.stderr
