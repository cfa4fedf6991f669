"""Which submissions of a course agree more than chance explains: another's variant handed in, the same wrong numbers.

Both are told by a likelihood ratio whose mean over honest submissions is at most one.  It therefore exceeds x by chance
with a probability of at most 1 / x (Markov), which times the number of pairs compared is the probability of a pair.
Numbers alone are compared, not what is drawn.  Right numbers prove nothing, nor what a mistake that both made brings.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.expectation import Floats

Flags = NDArray[np.bool_]
Students = NDArray[np.intp]
"""Students by their places in the course."""
FALSE_ALARM = 0.005
"""A pair is named where chance brings any in at most so many honest courses; of each of the two kinds."""
RELATED = 10.0
"""The answers of a drawing go together, so a mistake that nobody knows may bring several near another's key: the ratio
for another's variant must be larger by this factor, which :mod:`~graphcam.exercises.marking.honest_courses` tests."""
COPIED_PART = 0.5
"""The part of wrong numbers that a student who copies is held to take over."""
FEWEST = 2
"""Answers that must agree: a single one may be a slip of the pen."""
ROWS = 64
"""Students compared with all others at a time, which bounds the memory."""
PAIRS = 1 << 16
"""Pairs looked at closely at a time, which bounds the memory too."""
ALIKE_KEYS = 6.0
"""Two keys nearer than so many scatters ask for the same number: a mistake that both make brings the same."""
UNIT_NORMAL = 1 / math.sqrt(2 * math.pi)


@dataclass(frozen=True, eq=False)
class CourseNumbers:
    """The numbers of a course, stacked.

    given : (students, answers), NaN where there is none, or where it only follows from the student's own earlier ones
    wrong : whether each lost its marks (students, answers)
    value, scatter : of the keys (students, answers);  bound : pencil units of each student (students,)
    mistaken, mistaken_scatter : of what every mistake brings (students, mistakes, answers)
    drawn : whether a hand's errors are in an answer at all (answers,)
    """

    given: Floats
    wrong: Flags
    value: Floats
    scatter: Floats
    bound: Floats
    mistaken: Floats
    mistaken_scatter: Floats
    drawn: Flags

    @cached_property
    def suspected(self) -> Students:
        """The students who have enough wrong numbers to be told by them."""
        return np.flatnonzero(self.wrong.sum(axis=1) >= FEWEST)

    @cached_property
    def reach(self) -> Floats:
        """The tolerances of the keys (students, answers)."""
        return self.bound[:, None] * self.scatter

    @cached_property
    def anywhere(self) -> Floats:
        """The density of each number of the suspected (students, answers) where the numbers of this course lie."""
        numbers = np.full_like(self.given, np.nan)
        numbers[self.suspected] = self.given[self.suspected]
        found = np.empty_like(self.given)
        for a in range(found.shape[1]):
            # Many give the same number.
            given, which = np.unique(numbers[:, a], return_inverse=True)
            some = np.split(given, range(ROWS, given.size, ROWS))
            by_key = [_density(each[:, None], self.value[:, a], self.scatter[:, a]).mean(axis=1) for each in some]
            middle, width = float(np.mean(self.value[:, a])), float(np.std(self.value[:, a]))
            wide = _density(given, middle, max(width, float(np.max(self.scatter[:, a]))))
            # What lies beyond all keys may be anything: the least density that arithmetic bears.
            found[:, a] = np.maximum((np.concatenate(by_key) + wide) / 2, 1e-300)[which]
        return found

    @cached_property
    def brought(self) -> NDArray[np.uint8]:
        """The mistakes that bring each given number (students, answers, bytes), a bit a mistake."""
        reach = self.bound[:, None, None] * self.mistaken_scatter
        return np.packbits((np.abs(self.given[:, None] - self.mistaken) <= reach).swapaxes(1, 2), axis=2)

    @cached_property
    def step(self) -> Floats:
        """How coarsely each given number was rounded (students, answers)."""
        return _steps(self.given)

    @cached_property
    def said(self) -> NDArray[np.intp]:
        """How many students of the course gave the same number (students, answers), each counted too."""
        count = np.zeros_like(self.given, dtype=np.intp)
        for a in range(count.shape[1]):
            course, given = np.sort(self.given[:, a]), self.given[:, a]
            count[:, a] = np.searchsorted(course, given, side="right") - np.searchsorted(course, given, side="left")
        return count


@dataclass(frozen=True)
class AlikePair:
    """Two submissions that agree beyond chance.

    kind : "variant" where the student's numbers fit the other's key, "wrong numbers" where both are wrong and the same
    answers : names of those that agree
    probability : that chance brings such a pair in an honest course, at most
    """

    student: str
    other: str
    kind: Literal["variant", "wrong numbers"]
    answers: tuple[str, ...]
    probability: float


def alike_pairs(
    exercise: Exercise, records: Sequence[Mapping[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> list[AlikePair]:
    """The pairs of a course that agree beyond chance, the least probable first.

    records : as JSON takes them;  answer_keys : by student; who has none is not compared
    """
    names = [asked.name for asked in exercise.answers if asked.kind == "number"]
    read = [_student_numbers(exercise, each, key) for each in records if (key := answer_keys.get(each["student"]))]
    if len(read) < 2 or not names:
        return []
    students, numbers = [each.student for each in read], _course_numbers(read)
    found: list[AlikePair] = []
    for i, j, probability in of_another_variant(numbers):
        off = np.abs(numbers.given[i] - numbers.value[j])
        fits = numbers.wrong[i] & (off <= numbers.reach[j])
        found.append(_pair(students[i], students[j], "variant", names, fits, probability))
    for i, j, probability in same_wrong_numbers(numbers):
        same = _same_wrong(numbers, np.array([i]), np.array([j]))[0][0]
        found.append(_pair(students[i], students[j], "wrong numbers", names, same, probability))
    return sorted(found, key=lambda pair: (pair.probability, pair.student, pair.other))


@dataclass(frozen=True, eq=False)
class _StudentNumbers:
    """What :class:`CourseNumbers` has of one student; of the answer key, which is larger, nothing else is kept.

    numbers : given, value, scatter (3, answers);  mistaken : value and scatter (mistakes, answers, 2)
    """

    student: str
    numbers: Floats
    wrong: Flags
    bound: float
    mistaken: Floats
    drawn: Flags


def _student_numbers(exercise: Exercise, record: Mapping[str, Any], key: AnswerKey) -> _StudentNumbers:
    places = [place for place, asked in enumerate(exercise.answers) if asked.kind == "number"]
    keys = [key.keys[exercise.answers[place].name] for place in places]
    answers = [record["answers"][place] for place in places]
    said = [[key.hypotheses[name].said[place] for place in places] for name in exercise.misconceptions]
    expected = [each.expected for each in keys]
    numbers = [map(_number, answers), (each.value for each in expected), (each.scatter for each in expected)]
    return _StudentNumbers(
        str(record["student"]),
        np.array([list(row) for row in numbers], dtype=np.float64),
        np.array([answer["outcome"] == "wrong" for answer in answers], dtype=np.bool_),
        key.bound,
        np.array(said, dtype=np.float64).reshape(len(said), len(places), 2),
        np.array([each.drawn for each in keys], dtype=np.bool_),
    )


def _course_numbers(students: Sequence[_StudentNumbers]) -> CourseNumbers:
    given, value, scatter = np.stack([each.numbers for each in students], axis=1)
    mistaken = np.array([each.mistaken for each in students])
    return CourseNumbers(
        given=given,
        wrong=np.array([each.wrong for each in students]),
        value=value,
        scatter=scatter,
        bound=np.array([each.bound for each in students]),
        mistaken=mistaken[..., 0],
        mistaken_scatter=mistaken[..., 1],
        drawn=np.any([each.drawn for each in students], axis=0),
    )


def of_another_variant(numbers: CourseNumbers) -> list[tuple[int, int, float]]:
    """The students i whose numbers fit the key of another one j, and with what probability by chance.

    An honest number is as a careful hand draws by the own key, or as one of the own mistakes brings it, or anywhere
    where the numbers of this course lie: half of that follows the keys of all students, half is a normal distribution
    as wide as they are.
    """
    wrong = numbers.suspected
    pairs = RELATED * wrong.size * (len(numbers.given) - 1)
    found: list[tuple[int, int, float]] = []
    for rows in np.split(wrong, range(ROWS, wrong.size, ROWS)):
        row, j = np.nonzero(_fitting(numbers, rows) >= FEWEST)
        i = rows[row]
        if not i.size:
            continue
        gained = _gained(numbers, rows, row, j)
        named = (i != j) & (gained >= math.log(max(pairs, 1) / FALSE_ALARM))
        found += [(int(i[k]), int(j[k]), pairs * math.exp(-float(gained[k]))) for k in np.flatnonzero(named)]
    return found


def _fitting(numbers: CourseNumbers, rows: Students) -> NDArray[np.uint8]:
    """How many wrong numbers of each student lie within the tolerance of every key (rows, students)."""
    count = np.zeros((rows.size, len(numbers.given)), dtype=np.uint8)
    for a in range(numbers.given.shape[1]):
        given = np.where(numbers.wrong[rows, a], numbers.given[rows, a], np.nan)
        count += np.abs(given[:, None] - numbers.value[:, a]) <= numbers.reach[:, a]
    return count


def _gained(numbers: CourseNumbers, rows: Students, row: Students, key: Students) -> Floats:
    """The logarithm of the likelihood ratio (pairs,) of another's key to the student's own explanations.

    rows : students;  row, key : of every pair the student's place in ``rows``, and whose key
    """
    given, anywhere = numbers.given[rows], numbers.anywhere[rows]
    other = np.zeros(row.size)
    for a in range(given.shape[1]):
        by_key = _density(given[row, a], numbers.value[key, a], numbers.scatter[key, a])
        other += np.log(np.maximum(by_key, anywhere[row, a]))
    own = np.maximum(_density(given, numbers.value[rows], numbers.scatter[rows]), anywhere)
    mistaken = _density(given[:, None], numbers.mistaken[rows], numbers.mistaken_scatter[rows])
    # The own key is an explanation too, where no mistake is catalogued.
    explained = np.log(np.maximum(mistaken, own[:, None])).sum(axis=2)
    best = np.maximum(explained.max(axis=1, initial=-np.inf), np.log(own).sum(axis=1))
    return other - best[row]


def _density(given: Floats, value: Floats | float, scatter: Floats | float) -> Floats:
    """The normal density; nought where nothing is given."""
    with np.errstate(over="ignore"):
        # In place: three thousand students have millions of pairs.
        found = np.asarray((given - value) / scatter)
        found *= found
        found *= -0.5
        np.exp(found, out=found)
        found *= UNIT_NORMAL / scatter
    found[np.isnan(found)] = 0.0
    return found


def same_wrong_numbers(numbers: CourseNumbers) -> list[tuple[int, int, float]]:
    """The students i < j whose wrong numbers are the same to the last digit, with what probability by chance.

    Of numbers that are wrong in both and that no mistake brings to both, each is the same by :func:`chance`, and with
    the probability ``COPIED_PART`` where one was taken over from the other.
    """
    wrong = numbers.suspected
    pairs = wrong.size * (wrong.size - 1) // 2
    found: list[tuple[int, int, float]] = []
    for rows in np.split(wrong, range(ROWS, wrong.size, ROWS)):
        equal = np.zeros((rows.size, wrong.size), dtype=np.uint8)
        for a in range(numbers.given.shape[1]):
            equal += numbers.given[rows, a][:, None] == numbers.given[wrong, a]
        left, right = np.nonzero((rows[:, None] < wrong) & (equal >= FEWEST))
        for some in np.split(np.arange(left.size), range(PAIRS, left.size, PAIRS)):
            found += _named_by_wrong_numbers(numbers, rows[left[some]], wrong[right[some]], pairs)
    return found


def _named_by_wrong_numbers(
    numbers: CourseNumbers, i: Students, j: Students, pairs: int
) -> list[tuple[int, int, float]]:
    """The pairs, of those compared, that are named by their wrong numbers."""
    same, both = _same_wrong(numbers, i, j)
    enough = np.count_nonzero(same, axis=1) >= FEWEST
    i, j, same, both = i[enough], j[enough], same[enough], both[enough]
    p = chance(numbers, i, j)
    ratio = np.where(same, COPIED_PART / p, np.where(both, (1 - COPIED_PART) / np.maximum(1 - p, 1e-3), 1.0))
    gained = np.log(ratio).sum(axis=1)
    named = np.flatnonzero(gained >= math.log(max(pairs, 1) / FALSE_ALARM))
    return [(int(i[k]), int(j[k]), pairs * math.exp(-float(gained[k]))) for k in named]


def _same_wrong(numbers: CourseNumbers, i: Students, j: Students) -> tuple[Flags, Flags]:
    """The answers (pairs, answers) that are wrong in both and the same, and those that are wrong in both.

    Left out are those that one mistake brings to both, and what is only calculated from the same sizes.
    """
    shared = (numbers.brought[i] & numbers.brought[j]).any(axis=2)
    alike = np.abs(numbers.value[i] - numbers.value[j]) <= ALIKE_KEYS * (numbers.scatter[i] + numbers.scatter[j])
    both = numbers.wrong[i] & numbers.wrong[j] & ~shared & (numbers.drawn | ~alike)
    return both & (numbers.given[i] == numbers.given[j]), both


def chance(numbers: CourseNumbers, i: Students, j: Students) -> Floats:
    """The probability (pairs, answers) that two honest wrong numbers are the same.

    At most: both draw the same wrong thing, and two careful hands then read the same digits with the probability
    step / (2 sqrt(pi) scatter).  It counts too how many others of the course say that number.
    """
    # A wrong drawing that is smaller scatters less.
    size = np.abs(numbers.given[i]) / np.maximum(np.maximum(np.abs(numbers.value[i]), np.abs(numbers.value[j])), 1e-9)
    scatter = np.minimum(numbers.scatter[i], numbers.scatter[j]) * np.clip(size, 1e-3, 1.0)
    by_hand = numbers.step[i] / (2 * math.sqrt(math.pi) * scatter)
    others = (numbers.said[i] - 2) / len(numbers.given)
    return np.clip(np.maximum(by_hand, others), 1e-6, 1.0)


def _steps(given: Floats) -> Floats:
    """How coarsely numbers were rounded: the largest of 1000, 500, 100, ... 0.0001 that each is a multiple of.

    >>> _steps(np.array([37.0, 37.5, 37.25, 40.0])).tolist()
    [1.0, 0.5, 0.05, 10.0]
    """
    found = np.full(given.shape, 1e-4)
    for power in range(-4, 4):
        for step in (10.0**power, 5 * 10.0**power):
            parts = given / step
            found[np.abs(parts - np.round(parts)) < 1e-7 * np.maximum(1.0, np.abs(parts))] = step
    return found


def _pair(
    student: str, other: str, kind: Literal["variant", "wrong numbers"], names: list[str], which: Flags, chance: float
) -> AlikePair:
    return AlikePair(student, other, kind, tuple(np.array(names)[which].tolist()), chance)


def _number(answer: Mapping[str, Any]) -> float:
    # One slip is one agreement, however many right answers follow from it.
    given = math.nan if answer["outcome"] == "follow-through" else answer["given"]
    return float(given) if isinstance(given, int | float) else math.nan
