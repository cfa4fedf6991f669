"""Gradescope's ``results.json`` (otter's too), and an autograder that writes it.

The autograder lies in ``/autograder``: it reads ``submission_metadata.json`` and the folder ``submission``.
"""

import json
import sys
from pathlib import Path
from typing import Any

from graphcam.exercises.course.course_folder import TEACHER, AnswerKeys, read_secret
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.grading.grade_one import Assignment, grade, read_submission
from graphcam.exercises.reports.student_page import OUTCOMES

SETUP = """#!/usr/bin/env bash
set -e
pip3 install graphcam
"""
RUN = """#!/usr/bin/env bash
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


def _test(exercise: Exercise, asked: Asked, answer: dict[str, Any], parameters: dict[str, Any]) -> dict[str, Any]:
    text = sentence(asked.text, parameters, exercise.tell)
    return {
        "name": asked.name,
        "score": answer["marks"],
        "max_score": answer["of"],
        "status": "passed" if answer["marks"] == answer["of"] else "failed",
        "output": f"{text} {exercise.tell(OUTCOMES[answer['outcome']])}",
        "output_format": "text",
        "visibility": "visible",
    }


def write_autograder(folder: Path, secret: bytes) -> None:
    """The files of an autograder; packed as a zip they are what Gradescope asks for."""
    for name, program in (("setup.sh", SETUP), ("run_autograder", RUN)):
        (folder / name).write_text(program, encoding="utf-8")
        (folder / name).chmod(0o755)
    (folder / TEACHER / "secret").write_bytes(secret)


def main(root: Path) -> None:
    """Grade the one submission of an autograder's container."""
    source = root / "source"
    metadata = json.loads((root / "submission_metadata.json").read_bytes())
    student = str(metadata["users"][0]["email"])
    kept = AnswerKeys(source / TEACHER)
    exercise = find_exercise(kept.exercise(), kept.language())
    assignment = Assignment(exercise, read_secret(source / TEACHER / "secret"))
    graded = grade(assignment, read_submission(student, root / "submission", kept.find(student)))
    (root / "results").mkdir(exist_ok=True)
    text = json.dumps(results(exercise, graded.record.to_dict()), indent=1, allow_nan=False)
    (root / "results" / "results.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
