"""Gradescope's ``results.json`` (otter's too), and an autograder that writes it.

The autograder lies in ``/autograder``: it reads ``submission_metadata.json`` and the folder ``submission``.  graphcam
comes along as a wheel, made of its installed files: an index of packages may have something else by that name, and what
marks must be what made the variants.  See the binary distribution format of the Python Packaging User Guide.
"""

import base64
import hashlib
import json
import sys
from collections.abc import Iterator, Sequence
from importlib import metadata, resources
from pathlib import Path, PurePosixPath
from typing import Any

from graphcam.errors import TaskError
from graphcam.exercises.course.course_folder import SECRET_FILE, TEACHER_FOLDER, AnswerKeys, read_secret
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.exercise_file import exercise_path, library
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.exports.content_package import write_zip
from graphcam.exercises.grading.grade_one import Assignment, grade, read_submission
from graphcam.exercises.reports.student_page import OUTCOME_CAPTIONS
from graphcam.words import say

PACKAGE_NAME = "graphcam"
EXERCISE_LIBRARY = f"{PACKAGE_NAME}/exercises/library"
"""The place of the exercises in an installed package; in a checkout they stand at the top level."""
TAG = "py3-none-any"
WHEEL_METADATA = f"Wheel-Version: 1.0\nGenerator: {PACKAGE_NAME}\nRoot-Is-Purelib: true\nTag: {TAG}\n"


def write_wheel(folder: Path) -> Path:
    """Write the wheel into a folder; its path.

    Raises
    ------
    TaskError : graphcam is run from a folder and not installed, so its dependencies are not known
    """
    try:
        distribution = metadata.distribution(PACKAGE_NAME)
    except metadata.PackageNotFoundError:
        remedy = say("install it with pip, a checkout with 'pip install -e .'")
        raise TaskError(PACKAGE_NAME, say("the package"), say("not installed"), say("installed"), remedy) from None
    about = f"{PACKAGE_NAME}-{distribution.version}.dist-info"
    held = dict(_package()) | dict(_about(distribution, about))
    record = [f"{name},sha256={_digest(data)},{len(data)}" for name, data in held.items()]
    held[f"{about}/RECORD"] = "\n".join([*record, f"{about}/RECORD,,", ""]).encode()
    wheel = folder / f"{PACKAGE_NAME}-{distribution.version}-{TAG}.whl"
    write_zip(wheel, held)
    return wheel


def _package() -> Iterator[tuple[str, bytes]]:
    """The files of the package by their names in the wheel, the exercises among them."""
    root = Path(str(resources.files(PACKAGE_NAME)))
    for path in sorted(root.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            yield str(PurePosixPath(PACKAGE_NAME, *path.relative_to(root).parts)), path.read_bytes()
    for name in library():
        yield f"{EXERCISE_LIBRARY}/{name}.toml", exercise_path(name).read_bytes()


def _about(distribution: metadata.Distribution, folder: str) -> Iterator[tuple[str, bytes]]:
    """The files of the folder of metadata: dependencies, commands and licences, as they were installed."""
    yield f"{folder}/WHEEL", WHEEL_METADATA.encode()
    for name in ("METADATA", "entry_points.txt"):
        if text := distribution.read_text(name):
            yield f"{folder}/{name}", text.encode()
    for path in distribution.files or ():
        if path.parts[0] == folder and "licenses" in path.parts:
            yield path.as_posix(), path.read_binary()


def _digest(data: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()


SETUP_SCRIPT = """#!/usr/bin/env bash
set -e
pip3 install /autograder/source/graphcam-*.whl
"""
RUN_SCRIPT = """#!/usr/bin/env bash
cd /autograder/source && python3 -m graphcam.exercises.exports.gradescope /autograder
"""


def results(exercise: Exercise, record: dict[str, Any]) -> dict[str, Any]:
    """A record as ``results.json`` wants it: one test for every answer.

    Gradescope shows outputs to the student, so nothing of the key and no deviation is in them.
    """
    marked = zip(exercise.answers, record["answers"], strict=True)
    return {
        "score": record["total"],
        "output": "\n".join([*record["feedback"], *record["notes"]]),
        "output_format": "text",
        "visibility": "visible",
        "stdout_visibility": "hidden",
        "tests": [_test(exercise, asked, answer, record["parameters"]) for asked, answer in marked],
        "extra_data": {name: record[name] for name in ("exercise", "version", "level")},
    }


def _test(exercise: Exercise, asked: AskedAnswer, answer: dict[str, Any], parameters: dict[str, Any]) -> dict[str, Any]:
    text = sentence(asked.text, parameters, exercise.tell)
    return {
        "name": asked.name,
        "score": answer["marks"],
        "max_score": answer["of"],
        "status": "passed" if answer["outcome"] == "right" or answer["marks"] == answer["of"] else "failed",
        "output": f"{text} {exercise.tell(OUTCOME_CAPTIONS[answer['outcome']])}",
        "output_format": "text",
        "visibility": "visible",
    }


def _no_variant_result(exercise: Exercise, email: str) -> dict[str, Any]:
    """What somebody gets who was given no variant: no marks, and a sentence that says why."""
    why = say("No variant was issued to {email}. Tell your teacher, who has the list of addresses.", email=email)
    shown = {"output_format": "text", "visibility": "visible", "stdout_visibility": "hidden"}
    return {"score": 0.0, "output": exercise.tell(why), "tests": [], **shown}


def student_by_email(students: Sequence[Student]) -> dict[str, str]:
    """The students by address, from the roster's e-mail; an id that is an address counts too.

    >>> student_by_email([Student("7", email="Anna@example.org"), Student("ben@example.org")])
    {'7': '7', 'anna@example.org': '7', 'ben@example.org': 'ben@example.org'}

    Raises
    ------
    TaskError : two students have the same
    """
    found: dict[str, str] = {}
    for student in students:
        for name in filter(None, (_normalised_address(student.id), _normalised_address(student.email))):
            if found.setdefault(name, student.id) != student.id:
                expected = say("another one than that of {found!r}", found=found[name])
                raise TaskError(
                    say("the roster"), "email", name, expected, say("give each student an address of their own")
                )
    return found


def _normalised_address(email: str) -> str:
    """Addresses that differ in capitals are one mailbox."""
    return email.strip().casefold()


def write_autograder(folder: Path) -> None:
    """The files of an autograder; packed as a zip they are what Gradescope asks for.

    Raises
    ------
    TaskError : graphcam is not installed, so that there is no wheel of it
    """
    write_wheel(folder)
    for name, program in (("setup.sh", SETUP_SCRIPT), ("run_autograder", RUN_SCRIPT)):
        (folder / name).write_text(program, encoding="utf-8", newline="\n")
        (folder / name).chmod(0o755)


def main(root: Path) -> None:
    """Grade the one submission of an autograder's container."""
    source = root / "source"
    metadata = json.loads((root / "submission_metadata.json").read_bytes())
    email = str(metadata["users"][0]["email"])
    kept = AnswerKeys(source / TEACHER_FOLDER)
    exercise = kept.course_exercise()
    student = kept.course().get("emails", {}).get(_normalised_address(email))
    if student is None:
        found = _no_variant_result(exercise, email)
    else:
        assignment = Assignment(exercise, read_secret(source / TEACHER_FOLDER / SECRET_FILE))
        graded = grade(assignment, read_submission(student, root / "submission", kept.find(student)))
        found = results(exercise, graded.record.to_dict())
    (root / "results").mkdir(exist_ok=True)
    text = json.dumps(found, indent=1, allow_nan=False)
    (root / "results" / "results.json").write_text(text, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
