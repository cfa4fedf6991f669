"""The variants of a whole course, told apart: nobody earns much with the answers of a neighbour."""

from collections import deque
from collections.abc import Iterable, Iterator
from concurrent.futures import Executor
from dataclasses import replace
from functools import partial

from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.coinciding_answers import MAX_COINCIDENCE_SHARE
from graphcam.exercises.key.key_making import MAX_DRAWS, drawn_or_refused, issue, key_or_reason
from graphcam.exercises.key.mistake_separation import PerfectHands
from graphcam.exercises.key.refused_draws import RefusedDraw
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
    first = ordered_results(executor, partial(issue, exercise, secret=secret), names)
    for student, (variant, answer_key) in zip(names, first, strict=True):
        if any(too_near(exercise, answer_key, other) for other in before):
            variant, answer_key = _drawn_again(exercise, student, secret, variant.draw, before)
        before.append(answer_key)
        yield variant, answer_key


def _drawn_again(
    exercise: Exercise, student: str, secret: bytes, draw: int, before: Iterable[AnswerKey]
) -> tuple[Variant, AnswerKey]:
    """The next variant that is not too near to those before it, or the last of :data:`MAX_REDRAWS`.

    Whether its answers earn much by their keys is known before it has a key itself, and most are passed over by that.
    Only those count that would be issued, which is found out where their number decides.
    """
    near, passed_over = 1, deque[tuple[Variant, PerfectHands]]()
    last = draw + MAX_REDRAWS * MAX_DRAWS
    while near < MAX_REDRAWS and draw < last:
        draw += 1
        variant = drawn(exercise, student, secret, draw)
        hands = drawn_or_refused(variant)
        if isinstance(hands, RefusedDraw):
            continue
        rows = zip(exercise.answers, hands.answers, strict=True)
        right = Answers({asked.name: float(value) if asked.kind == "number" else value for asked, value in rows})
        if any(earns_much(exercise, other, right) for other in before):
            passed_over.append((variant, hands))
        elif isinstance(answer_key := key_or_reason(variant, hands), AnswerKey):
            if not any(earns_much(exercise, answer_key, right_answers(other)) for other in before):
                return variant, answer_key
            near += 1
        while passed_over and near + len(passed_over) >= MAX_REDRAWS:
            near += isinstance(key_or_reason(*passed_over.popleft()), AnswerKey)
    return issue(exercise, student, secret, draw + 1)


def too_near(exercise: Exercise, one: AnswerKey, other: AnswerKey) -> bool:
    """Whether the right answers of one of two variants earn more than half of the marks in the other."""
    return any(earns_much(exercise, to, right_answers(copied)) for to, copied in ((one, other), (other, one)))


def earns_much(exercise: Exercise, answer_key: AnswerKey, answers: Answers) -> bool:
    """Whether answers to another variant earn more than half of the marks, or would by a little luck."""
    record = mark(exercise, replace(answer_key, bound=LUCKY_TOLERANCES * answer_key.bound), answers)
    return record.total > MAX_COINCIDENCE_SHARE * record.of


def right_answers(answer_key: AnswerKey) -> Answers:
    """What a perfect hand answers."""
    return Answers({name: key.expected.value for name, key in answer_key.keys.items()})
