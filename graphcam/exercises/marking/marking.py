"""Marking: arithmetic on the answer key, the same result whenever and wherever it is done.

Outcomes become marks in one place, :func:`earned`.
"""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from graphcam.exercises.definition.exercise import Answers, AskedAnswer, Exercise
from graphcam.exercises.definition.marks_policy import MarksPolicy
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.follow_through import Dependence
from graphcam.exercises.marking.diagnosis import ComparedAnswer, compare, diagnose
from graphcam.exercises.marking.exactness import too_exact
from graphcam.exercises.marking.feedback import feedback
from graphcam.exercises.marking.record import MarkedAnswer, Outcome, Record
from graphcam.exercises.marking.single_slips import single_slip

ROUNDING = 1e-9
"""What the arithmetic may take from a whole number."""


class JudgedAnswer(NamedTuple):
    """One answer, judged and not yet paid.

    outcome : never "partial", which is a matter of pay
    tolerances : how many it is off
    share : part of a curve that is right, 0 where that is too little to be paid
    """

    asked: AskedAnswer
    outcome: Outcome
    tolerances: float = math.inf
    share: float = 0.0


def earned(policy: MarksPolicy, judged: Sequence[JudgedAnswer], mistakes: Sequence[str]) -> list[float]:
    """The marks of every answer.

    mistakes : the diagnosed one and those alike; where all are capped every answer is paid less, in one proportion

    >>> first, second = (AskedAnswer(name, "A length.", "integration", reading="v", marks=2) for name in "ab")
    >>> judged = [JudgedAnswer(first, "right"), JudgedAnswer(second, "follow-through")]
    >>> earned(MarksPolicy(follow_through=0.5, caps={"offset-sign": 0.5}), judged, ["offset-sign"])
    [1.33, 0.66]
    """
    marks = [_alone(policy, each) for each in judged]
    total, most = sum(marks), policy.max_share(mistakes) * sum(each.asked.marks for each in judged)
    if total <= most:
        return marks
    return [math.floor(100 * each * most / total + ROUNDING) / 100 for each in marks]


def _alone(policy: MarksPolicy, judged: JudgedAnswer) -> float:
    """What an answer earns without regard to the others: the best of what it may be paid for."""
    marks = judged.asked.marks
    if judged.outcome == "right":
        return marks
    part = _part(marks, max(judged.share, policy.part(judged.tolerances)))
    return max(part, marks * policy.follow_through) if judged.outcome == "follow-through" else part


def _part(marks: float, share: float) -> float:
    """A part of the marks, in whole tenths of a mark, and never all.

    >>> _part(4.0, 0.71), _part(1.0, 1.0)
    (2.8, 0.9)
    """
    return max(0.0, min(math.floor(10 * marks * share), math.ceil(10 * marks) - 1) / 10)


MIN_CURVE_SHARE = 0.5
"""A curve of which less is right earns nothing: with most mistakes a dwell or two lie on the right circle."""
SMALL_KEY_TOLERANCES = 8.0
"""A key of fewer tolerances is no length that grows with a scale: its tolerance would grow without bounds."""


def mark(exercise: Exercise, answer_key: AnswerKey, answers: Answers, *, level: str = "L0") -> Record:
    """The record of one submission, marked.

    An answer is right within the tolerance of the key.  Else it earns its marks as follow-through where it lies within
    the tolerance of what follows from the student's own earlier answers, or where the diagnosed mistake was made in an
    earlier step and everything since was done right: one slip costs its own step only.  From an absurd earlier answer
    nothing follows, and nought follows from nothing.  A curve that is right in part earns that part of its marks.  What
    else is paid, and how much, is the policy of the exercise.

    answers : untrusted data; whatever it holds, there is one record
    level : how the answers were come by, for the record

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.key.key_making import issue
    >>> exercise = find_exercise("acceleration-and-scales")
    >>> variant, answer_key = issue(exercise, "Anna", b"secret")
    >>> mark(exercise, answer_key, Answers({"mu_s": float("nan")})).total
    0.0
    """
    compared = compare(exercise, answer_key, answers)
    diagnosis, following = None, set[str]()
    if any(each.wrong for each in compared):
        diagnosis, explained = diagnose(answer_key, compared) or (None, frozenset[int]())
        following = _following(answer_key, compared, explained)
    beside_key = {each.asked.name: each for each in compared}
    judged = [
        _judged(asked, beside_key.get(asked.name), answers, following, answer_key.bound) for asked in exercise.answers
    ]
    mistakes = (diagnosis.misconception, *diagnosis.alike) if diagnosis else ()
    policy = exercise.policy
    policies = (policy, policy.without_follow_through, policy.without_caps)
    marks, strict, uncapped = (earned(each, judged, mistakes) for each in policies)
    marked = tuple(_marked(one, beside_key.get(one.asked.name), paid) for one, paid in zip(judged, marks, strict=True))
    slip = None if diagnosis else single_slip(compared, following, answer_key.bound, answer_key.keys)
    most = policy.max_share(mistakes) * exercise.marks if sum(marks) < sum(uncapped) else None
    return Record(
        student=answer_key.student,
        exercise=answer_key.exercise,
        version=answer_key.version,
        draw=answer_key.draw,
        parameters=answer_key.parameters,
        answers=marked,
        total=sum(each.marks for each in marked),
        of=exercise.marks,
        diagnosis=diagnosis,
        too_exact=too_exact(answer_key, compared),
        feedback=feedback(exercise, marked, answers, diagnosis or slip, most),
        notes=tuple(map(exercise.tell, answers.notes)),
        level=level,
        without_follow_through=sum(strict),
        without_caps=sum(uncapped),
    )


def _following(answer_key: AnswerKey, compared: Sequence[ComparedAnswer], explained: frozenset[int]) -> set[str]:
    """The names of the wrong answers that follow from the student's own earlier ones.

    explained : the places of those that the diagnosed mistake brings
    """
    found: set[str] = set()
    own: dict[str, float] = {}
    first = min(each.place for each in compared if each.wrong)
    # Once the mistake has shown in the student's own answers, what it brings with it is a consequence.
    caused = sorted(explained)[1:]
    for each in compared:
        given, key, dependence = each.given, each.key.value, answer_key.dependences.get(each.asked.name)
        follows = each.place in caused
        if isinstance(given, float) and isinstance(key, float):
            moved = given
            if dependence:
                expected = dependence.expected(key, own)
                moved = dependence.moved(key, given, expected)
                follows |= each.place > first and _is_follow_through(answer_key.bound, each, dependence, expected)
            own[each.asked.name] = moved
        if follows:
            found.add(each.asked.name)
    return found


def _is_follow_through(bound: float, answer: ComparedAnswer, dependence: Dependence, expected: float) -> bool:
    """Whether a number is what follows, within the tolerance that a hand has there."""
    given, key, scatter = float(answer.given), float(answer.key.value), float(answer.key.scatter)
    # What careful hands share with their own earlier answers, as the error of a scale, is in what follows already.
    tolerance = bound * min(scatter, dependence.scatter)
    # Nought follows from too much that was never drawn.
    if not answer.wrong or abs(given) <= tolerance < abs(key):
        return False
    if dependence.together == "product" and not answer.asked.unit.startswith("deg"):
        # A hand's error grows with the lengths that a wrong scale makes, and does not shrink with them.
        tolerance *= max(1.0, abs(expected) / max(abs(key), SMALL_KEY_TOLERANCES * tolerance))
    return abs(given - expected) <= tolerance


def _judged(
    asked: AskedAnswer, answer: ComparedAnswer | None, answers: Answers, following: set[str], bound: float
) -> JudgedAnswer:
    if answer is None:
        there = asked.name in answers.values or asked.name in answers.problems
        return JudgedAnswer(asked, "unreadable" if there else "missing")
    if not answer.wrong:
        return JudgedAnswer(asked, "right")
    share = 0.0
    if isinstance(answer.given, np.ndarray) and asked.kind == "curve":
        share = answer.key.share(answer.given, bound, MIN_CURVE_SHARE)
    outcome = "follow-through" if asked.name in following else "wrong"
    return JudgedAnswer(asked, outcome, abs(answer.off.deviation) / bound, share)


def _marked(judged: JudgedAnswer, answer: ComparedAnswer | None, marks: float) -> MarkedAnswer:
    name, of = judged.asked.name, judged.asked.marks
    if answer is None:
        return MarkedAnswer(name, judged.outcome, marks, of)
    outcome = "partial" if judged.outcome == "wrong" and marks > 0 else judged.outcome
    given: Any = answer.given
    if isinstance(given, np.ndarray):
        given = np.column_stack((given.real, given.imag)).tolist()
    return MarkedAnswer(name, outcome, marks, of, given, *answer.off)
