"""What ``graphcam exercise export`` does: variants for another system, in one folder."""

import secrets
from collections.abc import Callable, Sequence
from pathlib import Path

from graphcam.errors import DesignError
from graphcam.exercises.course.course_folder import TEACHER, AnswerKeys
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.exports import LearningSystem
from graphcam.exercises.exports.gradescope import student_by_email, write_autograder
from graphcam.exercises.exports.moodle import moodle_xml
from graphcam.exercises.exports.moodle_cloze import Issued, cloze_xml
from graphcam.exercises.exports.nbgrader import write_course
from graphcam.exercises.key.keying import issue
from graphcam.files import OutputError, whole_folder
from graphcam.language import ENGLISH, languages
from graphcam.tasks.sheet_tables import one_of

MOST = 1000
"""Variants of one export."""


def export(
    name: str,
    target: LearningSystem,
    students: Sequence[Student],
    folder: Path,
    secret: bytes | None = None,
    step: Callable[[int, int], None] = lambda done, total: None,
    language: str = ENGLISH.name,
) -> None:
    """Write the export for some students, or for as many variants that are nobody's, into a new folder.

    name : of an exercise, or the path of its file, which travels with the export
    language : of all that students read
    secret : of the course; without one a new one is drawn and written into the folder, for the teacher

    Raises
    ------
    OutputError : the folder is there already, or cannot be written
    TaskError : two students have one e-mail address, or the system cannot ask for what the exercise asks
    """
    if not 0 < len(students) <= MOST:
        raise DesignError("number of variants", len(students), f"from 1 to {MOST}")
    if folder.exists():
        raise OutputError(folder, "it is there already", "name a new folder, or remove that one first")
    one_of("language", language, languages())
    exercise = find_exercise(name, language)
    emails = student_by_email(students)
    key = secret or secrets.token_hex(32).encode()
    issued: list[Issued] = []
    for student in students:
        issued.append(Issued(student, *issue(exercise, student.id, key)))
        step(len(issued), len(students))
    answer_keys = [each.answer_key for each in issued]
    with whole_folder(folder) as draft:
        kept = AnswerKeys(draft / TEACHER)
        kept.keep_course(exercise_path(name), key, version=exercise.version, language=language, emails=emails)
        for answer_key in answer_keys:
            kept.keep(answer_key.student, answer_key.to_json())
        match target:
            case LearningSystem.MOODLE:
                (draft / f"{exercise.name}.xml").write_text(moodle_xml(exercise, answer_keys), encoding="utf-8")
            case LearningSystem.MOODLE_CLOZE:
                (draft / f"{exercise.name}.xml").write_text(cloze_xml(exercise, issued), encoding="utf-8")
            case LearningSystem.NBGRADER:
                write_course(draft, exercise, answer_keys)
            case LearningSystem.GRADESCOPE:
                write_autograder(draft, key)
        if secret is None:
            (draft / TEACHER / "secret").write_bytes(key)
