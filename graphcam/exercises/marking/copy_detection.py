"""Which submissions of a course agree more than chance explains: another's variant handed in, the same wrong numbers.

Both are told by a likelihood ratio whose mean over honest submissions is at most one.  It therefore exceeds x by chance
with a probability of at most 1 / x (Markov), which times the number of pairs compared is the probability of a pair.
Numbers alone are compared, not what is drawn.  Right numbers prove nothing, nor what a mistake that both made brings.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.expected_answers import Floats

Flags = NDArray[np.bool_]
Kind = Literal["variant", "wrong numbers"]
Agreement = tuple[int, int, float, Flags]
"""Two students, the probability of such a pair by chance, and the answers that agree."""
FALSE_ALARM_RATE = 0.005
"""A pair is named where chance brings any in at most so many honest courses; of each of the two kinds."""
RELATED_ANSWERS_FACTOR = 10.0
"""A mistake that nobody knows may bring several answers near another's key: that ratio must be so much larger."""
COPIED_PART = 0.5
"""The part of wrong numbers that a student who copies is held to take over."""
MIN_AGREEING_ANSWERS = 2
"""Answers that must agree: a single one may be a slip of the pen."""
SAME_KEY_SCATTERS = 6.0
"""Two keys nearer than so many scatters ask for the same number: what is only calculated from it is the same too."""
STEPS = np.array([part * 10.0**power for power in range(-4, 4) for part in (1, 5)])
"""How coarsely a number may be rounded: to 0.0001, 0.0005, 0.001, ... 5000."""


@dataclass(frozen=True, eq=False)
class CourseNumbers:
    """The numbers of a course: arrays over its students and the answers that are numbers.

    given : NaN where there is none, or where it only follows from the student's own earlier ones
    wrong : whether each lost its marks;  bound : pencil units that are accepted of each student (students,)
    expected, scatter : of the key and of what every mistake brings (students, 1 + mistakes, answers)
    drawn : whether a hand's errors are in an answer at all (answers,)
    """

    given: Floats
    wrong: Flags
    bound: Floats
    expected: Floats
    scatter: Floats
    drawn: Flags


@dataclass(frozen=True)
class AlikePair:
    """Two submissions that agree beyond chance, in the answers of these names.

    kind : "variant" where the student's numbers fit the other's key, "wrong numbers" where both are wrong and the same
    probability : that chance brings such a pair in an honest course, at most
    """

    student: str
    other: str
    kind: Kind
    answers: tuple[str, ...]
    probability: float


def alike_pairs(
    exercise: Exercise, records: Sequence[Mapping[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> list[AlikePair]:
    """The pairs of a course that agree beyond chance, the least probable first; who has no key is not compared."""
    names = np.array([asked.name for asked in exercise.answers if asked.kind == "number"])
    # Of an answer key, which is large, no more than these rows is kept.
    rows = [_row(exercise, one, key) for one in records if (key := answer_keys.get(one["student"]))]
    if len(rows) < 2 or not names.size:
        return []
    students, given, wrong, bound, said, drawn = zip(*rows, strict=True)
    expected, scatter = np.moveaxis(np.array(said, dtype=np.float64), -1, 0)
    numbers = CourseNumbers(np.array(given), np.array(wrong), np.array(bound), expected, scatter, np.any(drawn, axis=0))
    kinds: dict[Kind, list[Agreement]] = {
        "variant": of_another_variant(numbers),
        "wrong numbers": same_wrong_numbers(numbers),
    }
    found = [
        AlikePair(students[i], students[j], kind, tuple(names[which].tolist()), p)
        for kind, listed in kinds.items()
        for i, j, p, which in listed
    ]
    return sorted(found, key=lambda pair: (pair.probability, pair.student, pair.other))


def _row(exercise: Exercise, record: Mapping[str, Any], answer_key: AnswerKey) -> tuple[Any, ...]:
    places = [place for place, asked in enumerate(exercise.answers) if asked.kind == "number"]
    answers = [record["answers"][place] for place in places]
    keys = [answer_key.keys[exercise.answers[place].name] for place in places]
    # One slip is one agreement, however many right answers follow from it.
    given = [None if one["outcome"] == "follow-through" else one["given"] for one in answers]
    numbers = [float(one) if isinstance(one, int | float) else math.nan for one in given]
    said = [[answer_key.hypotheses[name].said[place] for place in places] for name in exercise.misconceptions]
    said = [[(key.expected.value, key.expected.scatter) for key in keys], *said]
    wrong = [one["outcome"] == "wrong" for one in answers]
    return record["student"], numbers, wrong, answer_key.bound, said, [key.drawn for key in keys]


def of_another_variant(numbers: CourseNumbers) -> list[Agreement]:
    """The students whose numbers fit the key of another one.

    An honest number is as a careful hand draws by the own key, or as one of the own mistakes brings it, or anywhere
    where the numbers of this course lie: half of that follows the keys of all students, half is a normal distribution
    as wide as they are.
    """
    value, scatter = numbers.expected[:, 0], numbers.scatter[:, 0]
    middle, width = value.mean(axis=0), np.maximum(value.std(axis=0), scatter.max(axis=0))
    suspected = np.flatnonzero(numbers.wrong.sum(axis=1) >= MIN_AGREEING_ANSWERS).tolist()
    pairs = RELATED_ANSWERS_FACTOR * len(suspected) * (len(value) - 1)
    found: list[Agreement] = []
    for i in suspected:
        given = numbers.given[i]
        fits = numbers.wrong[i] & (np.abs(given - value) <= numbers.bound[:, None] * scatter)
        fits[i] = False
        enough = np.count_nonzero(fits, axis=1) >= MIN_AGREEING_ANSWERS
        if enough.any():
            by_key = _density(given, value, scatter)
            # What lies beyond all keys may be anything: the least density that arithmetic bears.
            anywhere = np.maximum((by_key.mean(axis=0) + _density(given, middle, width)) / 2, 1e-300)
            explained = np.maximum(_density(given, numbers.expected[i], numbers.scatter[i]), by_key[i])
            own = np.log(np.maximum(explained, anywhere)).sum(axis=1).max()
            p = pairs * np.exp(np.minimum(own - np.log(np.maximum(by_key, anywhere)).sum(axis=1), 0.0))
            found += [(i, int(j), float(p[j]), fits[j]) for j in np.flatnonzero(enough & (p <= FALSE_ALARM_RATE))]
    return found


def _density(given: Floats, value: Floats, scatter: Floats) -> Floats:
    """The normal density; nought where nothing is given."""
    with np.errstate(over="ignore"):
        return np.nan_to_num(np.exp(-0.5 * ((given - value) / scatter) ** 2) / (math.sqrt(2 * math.pi) * scatter))


def same_wrong_numbers(numbers: CourseNumbers) -> list[Agreement]:
    """The students whose wrong numbers are the same to the last digit.

    Of numbers that are wrong in both and that no mistake brings to both, each is the same by :func:`chance`, and with
    the probability ``COPIED_PART`` where one was taken over from the other.
    """
    given, value, scatter = numbers.given, numbers.expected[:, 0], numbers.scatter[:, 0]
    suspected = np.flatnonzero(numbers.wrong.sum(axis=1) >= MIN_AGREEING_ANSWERS)
    pairs = suspected.size * (suspected.size - 1) // 2
    off = np.abs(given[:, None] - numbers.expected[:, 1:])
    brought = off <= numbers.bound[:, None, None] * numbers.scatter[:, 1:]
    found: list[Agreement] = []
    for k, i in enumerate(suspected.tolist()):
        j = suspected[k + 1 :]
        j = j[np.count_nonzero(given[i] == given[j], axis=1) >= MIN_AGREEING_ANSWERS]
        unlike = np.abs(value[i] - value[j]) > SAME_KEY_SCATTERS * (scatter[i] + scatter[j])
        both = numbers.wrong[i] & numbers.wrong[j] & ~(brought[i] & brought[j]).any(axis=1) & (numbers.drawn | unlike)
        same, p = both & (given[i] == given[j]), chance(numbers, i, j)
        ratio = np.where(same, COPIED_PART / p, np.where(both, (1 - COPIED_PART) / np.maximum(1 - p, 1e-3), 1.0))
        by_chance = pairs / ratio.prod(axis=1)
        named = np.flatnonzero(
            (np.count_nonzero(same, axis=1) >= MIN_AGREEING_ANSWERS) & (by_chance <= FALSE_ALARM_RATE)
        )
        found += [(i, int(j[pair]), float(by_chance[pair]), same[pair]) for pair in named]
    return found


def chance(numbers: CourseNumbers, i: int, j: NDArray[np.intp]) -> Floats:
    """The probability (pairs, answers) that honest wrong numbers of a student are the same as those of others.

    At most: both draw the same wrong thing, and two careful hands then read the same digits with the probability
    step / (2 sqrt(pi) scatter).  It counts too how many others of the course say that number.
    """
    given, value, scatter = numbers.given[i], np.abs(numbers.expected[:, 0]), numbers.scatter[:, 0]
    parts = given[:, None] / STEPS
    rounded = np.abs(parts - np.round(parts)) < 1e-7 * np.maximum(1.0, np.abs(parts))
    # A wrong drawing that is smaller scatters less.
    size = np.clip(np.abs(given) / np.maximum(np.maximum(value[i], value[j]), 1e-9), 1e-3, 1.0)
    by_hand = np.where(rounded, STEPS, STEPS[0]).max(axis=1) / np.minimum(scatter[i], scatter[j]) / size
    others = (np.count_nonzero(numbers.given == given, axis=0) - 2) / len(numbers.given)
    return np.clip(np.maximum(by_hand / (2 * math.sqrt(math.pi)), others), 1e-6, 1.0)
