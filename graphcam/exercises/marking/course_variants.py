"""The variants of a whole course, told apart: nobody earns much with the answers of a neighbour."""

from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial

from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.coinciding_answers import MAX_COINCIDENCE_SHARE
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.marking.marking import mark
from graphcam.workers import ordered_results

GROUP_SIZE = 40
"""Students who sit together.  In a simulation of so many every one is marked by every other's key."""
LUCKY_TOLERANCES = 1.25
"""A copy may be right by luck: an answer counts that is off by so many tolerances."""
MAX_REDRAWS = 20
"""How often at most a variant is drawn again: an exercise with few parameters has not enough of them for a group."""


def course_variants(
    exercise: Exercise, students: Iterable[str], secret: bytes, executor: Executor | None = None
) -> Iterator[tuple[Variant, AnswerKey]]:
    """A variant for each of these students, in their order, with its answer key.

    One is drawn again by which, or for which, a copy from one of the group of forty before it in the roster earns more
    than half of the marks.
    The same exercise, secret and students in the same order give the same variants; who is added at the end changes
    none.

    Raises
    ------
    DesignError : there is a student for whom no draw of the parameters can be diagnosed
    """
    before: deque[AnswerKey] = deque(maxlen=GROUP_SIZE)
    names = list(students)
    first = ordered_results(executor, partial(_first_variant, exercise, secret), names)
    for student, (variant, answer_key) in zip(names, first, strict=True):
        for _ in range(MAX_REDRAWS):
            if not any(too_near(exercise, answer_key, other) for other in before):
                break
            variant, answer_key = issue(exercise, student, secret, variant.draw + 1)
        before.append(answer_key)
        yield variant, answer_key


def _first_variant(exercise: Exercise, secret: bytes, student: str) -> tuple[Variant, AnswerKey]:
    return issue(exercise, student, secret)


def too_near(exercise: Exercise, one: AnswerKey, other: AnswerKey) -> bool:
    """Whether the right answers of one of two variants earn more than half of the marks in the other."""
    return any(
        (record := mark(exercise, replace(to, bound=LUCKY_TOLERANCES * to.bound), right_answers(copied))).total
        > MAX_COINCIDENCE_SHARE * record.of
        for to, copied in ((one, other), (other, one))
    )


def right_answers(answer_key: AnswerKey) -> Answers:
    """What a perfect hand answers."""
    return Answers({name: key.expected.value for name, key in answer_key.keys.items()})
