"""What one number earns that is handed in for every answer: a variant whose answers coincide asks for too little."""

from collections.abc import Sequence

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.expectation import Expected

HALF = 0.5
"""The maximum part of all marks that one number, or a copy of another variant, may have."""


def by_one_number(exercise: Exercise, keys: Sequence[Expected], tolerances: Sequence[float]) -> float:
    """The largest part of all marks that one number earns by being right in two answers or more.

    It is handed in with the sign that each answer wants.  What is drawn, a number does not earn.

    keys, tolerances : of every answer, in the order of the exercise and in the unit of the answer

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> exercise = find_exercise("pressure-angle")
    >>> keys = [Expected(value, 0.5) for value in (60.0, 30.0, -31.5, 25.0, 20.0, 10.0, -5.0)]
    >>> by_one_number(exercise, keys, [1.0] * 7)  # the second and the third, of 2 marks of 8
    0.25
    """
    sizes = [
        (abs(float(key.value)), most, asked.marks)
        for asked, key, most in zip(exercise.answers, keys, tolerances, strict=True)
        if asked.kind == "number"
    ]
    # Wherever some tolerances overlap, they do so at the upper end of one of them.
    together = [
        [marks for size, most, marks in sizes if size - most <= edge + reach <= size + most] for edge, reach, _ in sizes
    ]
    return max((sum(earned) for earned in together if len(earned) > 1), default=0.0) / exercise.marks
