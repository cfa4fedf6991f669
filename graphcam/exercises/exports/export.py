"""What ``graphcam exercise export`` does: variants for another system, in one folder."""

from collections.abc import Callable, Sequence
from pathlib import Path

from graphcam.errors import DesignError
from graphcam.exercises.course.course_folder import SECRET_FILE, TEACHER_FOLDER, AnswerKeys, make_secret, write_secret
from graphcam.exercises.course.roster import Student
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import exercise_path, find_exercise
from graphcam.exercises.exports import LearningSystem
from graphcam.exercises.exports.canvas import write_quizzes
from graphcam.exercises.exports.gradescope import student_by_email, write_autograder
from graphcam.exercises.exports.moodle import cloze_xml, moodle_xml
from graphcam.exercises.exports.nbgrader import write_course
from graphcam.exercises.exports.prairielearn import write_question
from graphcam.exercises.exports.qti import write_package
from graphcam.exercises.exports.question_parts import IssuedVariant
from graphcam.exercises.marking.course_variants import course_variants
from graphcam.files import OutputError, whole_folder
from graphcam.language import ENGLISH, languages
from graphcam.tasks.sheet_tables import check_choice
from graphcam.words import say

MAX_VARIANTS = 1000
"""Variants of one export."""


def export(
    name: str,
    target: LearningSystem,
    students: Sequence[Student],
    folder: Path,
    secret: bytes | None = None,
    step: Callable[[int, int], None] = lambda done, total: None,
    language: str = ENGLISH.name,
    hand: str = "",
) -> None:
    """Write the export for some students, or for as many variants that are nobody's, into a new folder.

    name : of an exercise, or the path of its file, which travels with the export
    language : of all that students read
    hand : of the students, by its name; else as the exercise says
    secret : of the course; without one a new one is drawn and written into the folder, for the teacher

    Raises
    ------
    OutputError : the folder is there already, or cannot be written
    TaskError : two students have one e-mail address, or the system cannot ask for what the exercise asks
    """
    if not 0 < len(students) <= MAX_VARIANTS:
        raise DesignError(say("number of variants"), len(students), say("from 1 to {most}", most=MAX_VARIANTS))
    if folder.exists():
        raise OutputError(folder, say("it already exists"), say("choose another folder, or remove that one first"))
    check_choice("language", language, languages())
    exercise = find_exercise(name, language, hand)
    emails = student_by_email(students)
    key = secret or make_secret()
    issued: list[IssuedVariant] = []
    variants = course_variants(exercise, (student.id for student in students), key)
    for student, (variant, answer_key) in zip(students, variants, strict=True):
        issued.append(IssuedVariant(student, variant, answer_key))
        step(len(issued), len(students))
    with whole_folder(folder) as draft:
        kept = AnswerKeys(draft / TEACHER_FOLDER)
        noted = {"version": exercise.version, "language": language, "hand": hand, "emails": emails}
        kept.keep_course(exercise_path(name), key, **noted)
        for each in issued:
            kept.keep(each.student.id, each.answer_key.to_json())
        _write(target, draft, exercise, issued)
        # The autograder marks far from the teacher's own file.
        if secret is None or target is LearningSystem.GRADESCOPE:
            write_secret(draft / TEACHER_FOLDER / SECRET_FILE, key)


def _write(target: LearningSystem, folder: Path, exercise: Exercise, issued: Sequence[IssuedVariant]) -> None:
    """Write what the system reads into a folder that has the teacher's files already."""
    match target:
        case LearningSystem.MOODLE:
            text = moodle_xml(exercise, [each.answer_key for each in issued])
            (folder / f"{exercise.name}.xml").write_text(text, encoding="utf-8", newline="\n")
        case LearningSystem.MOODLE_CLOZE:
            (folder / f"{exercise.name}.xml").write_text(cloze_xml(exercise, issued), encoding="utf-8", newline="\n")
        case LearningSystem.CANVAS:
            write_quizzes(folder / f"{exercise.name}.zip", exercise, issued)
        case LearningSystem.QTI:
            write_package(folder / f"{exercise.name}.zip", exercise, issued)
        case LearningSystem.PRAIRIELEARN:
            write_question(folder / "questions" / exercise.name, exercise, issued)
        case LearningSystem.NBGRADER:
            write_course(folder, exercise, [each.answer_key for each in issued])
        case LearningSystem.GRADESCOPE:
            write_autograder(folder)
