"""A graded page to be shown: a student whose hand is right but for one usual mistake."""

from __future__ import annotations

from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.key.answer_scatter import answers_of
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.simulate import submission
from graphcam.exercises.reports.student_page import student_page


def graded_page(name: str = "inversion-translating", mistake: str = "offset-sign", *, seed: int = 1) -> str:
    """The feedback, as HTML, to a student who drew an exercise with a mistake and with the errors of a hand.

    seed : of the hand's errors
    """
    exercise = find_exercise(name)
    variant, answer_key = issue(exercise, "Anna", b"shown")
    hand = exercise.hand.pencil(1, seed)
    wrongly = answers_of(exercise, misconception(mistake).change(board_chain(variant.task, hand)))
    record = mark(exercise, answer_key, submission(exercise, wrongly, 0))
    return student_page(exercise, record.to_dict(), answer_key, right=True)
