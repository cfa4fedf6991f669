"""What ``graphcam exercise export`` does: variants for another system, in one folder."""

import secrets
from collections.abc import Callable
from pathlib import Path

from graphcam.errors import DesignError
from graphcam.exercises.course.course_folder import TEACHER, AnswerKeys
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.exports.gradescope import write_autograder
from graphcam.exercises.exports.moodle import moodle_xml
from graphcam.exercises.exports.nbgrader import write_course
from graphcam.exercises.exports.systems import LearningSystem
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.keying import issue
from graphcam.files import OutputError, whole_folder
from graphcam.language import ENGLISH, languages
from graphcam.tasks.sheet_tables import one_of

MOST = 1000
"""Variants of one export."""


def export(
    name: str,
    target: LearningSystem,
    students: list[str],
    folder: Path,
    secret: bytes | None = None,
    step: Callable[[int, int], None] = lambda done, total: None,
    language: str = ENGLISH.name,
) -> None:
    """Write the export for some students, or for as many nameless variants, into a new folder.

    name : of an exercise, or the path of its file, which travels with the export
    language : of all that students read
    secret : of the course; without one a new one is drawn and written into the folder, for the teacher

    Raises
    ------
    OutputError : the folder is there already, or cannot be written
    """
    if not 0 < len(students) <= MOST:
        raise DesignError("number of variants", len(students), f"from 1 to {MOST}")
    if folder.exists():
        raise OutputError(folder, "it is there already", "name a new folder, or remove that one first")
    one_of("language", language, languages())
    exercise = find_exercise(name, language)
    key = secret or secrets.token_hex(32).encode()
    answer_keys: list[AnswerKey] = []
    for student in students:
        answer_keys.append(issue(exercise, student, key)[1])
        step(len(answer_keys), len(students))
    with whole_folder(folder) as draft:
        kept = AnswerKeys(draft / TEACHER)
        kept.keep_course(exercise_path(name), key, version=exercise.version, language=language)
        for answer_key in answer_keys:
            kept.keep(answer_key.student, answer_key.to_json())
        match target:
            case LearningSystem.MOODLE:
                (draft / f"{exercise.name}.xml").write_text(moodle_xml(exercise, answer_keys), encoding="utf-8")
            case LearningSystem.NBGRADER:
                write_course(draft, exercise, answer_keys)
            case LearningSystem.GRADESCOPE:
                write_autograder(draft, key)
        if secret is None:
            (draft / TEACHER / "secret").write_bytes(key)
