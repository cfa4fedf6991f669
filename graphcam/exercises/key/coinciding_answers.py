"""Answers that are right by chance: one number for several, or a number that the text gives."""

from collections.abc import Sequence

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.expected_answers import Expected

MAX_COINCIDENCE_SHARE = 0.5
"""The maximum part of all marks that one number, or a copy of another variant, may have."""


def by_one_number(exercise: Exercise, keys: Sequence[Expected], tolerances: Sequence[float]) -> float:
    """The largest part of all marks that one number earns by being right in two answers or more.

    It is handed in with the sign that each answer wants.  What is drawn, a number does not earn.

    keys, tolerances : of every answer, in the order of the exercise and in the unit of the answer

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> exercise = find_exercise("pressure-angle")
    >>> keys = [Expected(value, 0.5) for value in (0.6, 60.0, 0.9, 30.0, -31.5, 25.0, 20.0, 10.0, -5.0)]
    >>> by_one_number(exercise, keys, [0.1, 1.0, 0.1, *[1.0] * 6])  # two of one mark each, of 10
    0.2
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


SIMPLE_MULTIPLES = (0.5, 1.0, 2.0)
"""What a radius of the text may be multiplied by in a guess."""


RADII = ("rho", "roller_radius", "prime_radius")
"""Readings that are radii: the text's prime radius, as large as they are about, is a guess that suggests itself."""


def guessed_radii(
    exercise: Exercise, keys: Sequence[Expected], tolerances: Sequence[float], prime_radius: float | None
) -> tuple[str, ...]:
    """The names of the radii for which the prime radius that the text gives, or its half, is right.

    keys, tolerances : of every answer, in the order of the exercise

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> exercise = find_exercise("curvature-and-roller")
    >>> keys = [Expected(value, 1.0) for value in (-14.0, 8.0, 9.0, 0.5, 80.0, -9.0, 70.0, 20.0, 48.0, 24.0)]
    >>> guessed_radii(exercise, keys, [3.0] * 10, prime_radius=60.0), guessed_radii(exercise, keys, [3.0] * 10, 50.0)
    ((), ('rho', 'roller'))
    """
    return tuple(
        asked.name
        for asked, key, most in zip(exercise.answers, keys, tolerances, strict=True)
        if asked.reading in RADII
        and prime_radius
        and any(abs(float(key.value) - factor * prime_radius) <= most for factor in SIMPLE_MULTIPLES)
    )
