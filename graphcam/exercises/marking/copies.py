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
from graphcam.exercises.key.expectation import Floats

Flags = NDArray[np.bool_]
FALSE_ALARM = 0.005
"""A pair is named where chance brings any in at most so many honest courses; of each of the two kinds."""
RELATED = 10.0
"""The answers of a drawing go together, so a mistake that nobody knows may bring several near another's key: the ratio
for another's variant must be larger by this factor, which :mod:`~graphcam.exercises.marking.honest_courses` tests."""
COPIED_PART = 0.5
"""Who takes wrong numbers over is held to take over this part of them."""
FEWEST = 2
"""Answers that must agree: a single one may be a slip of the pen."""
ROWS = 256
"""Students compared with all others at a time, which bounds the memory."""
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
    known = [record for record in records if record["student"] in answer_keys]
    names = [asked.name for asked in exercise.answers if asked.kind == "number"]
    if len(known) < 2 or not names:
        return []
    numbers = course_numbers(exercise, known, answer_keys)
    students = [str(record["student"]) for record in known]
    found: list[AlikePair] = []
    for i, j, probability in of_another_variant(numbers):
        fits = _fits(numbers, i, j)
        found.append(_pair(students[i], students[j], "variant", names, fits, probability))
    for i, j, probability in same_wrong_numbers(numbers):
        same = _same_wrong(numbers, np.array([i]), np.array([j]))[0][0]
        found.append(_pair(students[i], students[j], "wrong numbers", names, same, probability))
    return sorted(found, key=lambda pair: (pair.probability, pair.student, pair.other))


def course_numbers(
    exercise: Exercise, records: Sequence[Mapping[str, Any]], answer_keys: Mapping[str, AnswerKey]
) -> CourseNumbers:
    """The numbers of these records, each of which has an answer key."""
    places = [place for place, asked in enumerate(exercise.answers) if asked.kind == "number"]
    names = [exercise.answers[place].name for place in places]
    keys = [answer_keys[record["student"]] for record in records]
    answers = [[record["answers"][place] for place in places] for record in records]
    # A row (value, scatter) an answer, of every mistake of every student.
    said = [
        [[each.said[place] for place in places] for name in exercise.misconceptions if (each := key.hypotheses[name])]
        for key in keys
    ]
    mistaken = np.array(said, dtype=np.float64).reshape(len(keys), -1, len(places), 2)
    expected = [[key.keys[name].expected for name in names] for key in keys]
    return CourseNumbers(
        given=np.array([[_number(each) for each in row] for row in answers]),
        wrong=np.array([[each["outcome"] == "wrong" for each in row] for row in answers]),
        value=np.array([[each.value for each in row] for row in expected], dtype=np.float64),
        scatter=np.array([[each.scatter for each in row] for row in expected], dtype=np.float64),
        bound=np.array([key.bound for key in keys]),
        mistaken=mistaken[..., 0],
        mistaken_scatter=mistaken[..., 1],
        drawn=np.array([any(key.keys[name].drawn for key in keys) for name in names]),
    )


def of_another_variant(numbers: CourseNumbers) -> list[tuple[int, int, float]]:
    """The students i whose numbers fit the key of another one j, and with what probability by chance.

    An honest number is as a careful hand draws by the own key, or as one of the own mistakes brings it, or anywhere
    where the numbers of this course lie: half of that follows the keys of all students, half is a normal distribution
    as wide as they are.
    """
    wrong = np.flatnonzero(numbers.wrong.sum(axis=1) >= FEWEST)
    pairs = RELATED * wrong.size * (len(numbers.given) - 1)
    found: list[tuple[int, int, float]] = []
    for rows in np.split(wrong, range(ROWS, wrong.size, ROWS)):
        gained = _gained(numbers, rows)
        gained[np.arange(rows.size), rows] = -np.inf
        for row, j in np.argwhere(gained >= math.log(max(pairs, 1) / FALSE_ALARM)).tolist():
            i = int(rows[row])
            if np.count_nonzero(_fits(numbers, i, j)) >= FEWEST:
                found.append((i, j, pairs * math.exp(-float(gained[row, j]))))
    return found


def _gained(numbers: CourseNumbers, rows: NDArray[np.intp]) -> Floats:
    """The logarithm of the likelihood ratio (rows, students) of every key to the student's own explanations."""
    given = numbers.given[rows]
    other = np.zeros((rows.size, len(numbers.given)))
    anywhere = np.empty(given.shape)
    for a in range(given.shape[1]):
        by_key = _density(given[:, a, None], numbers.value[:, a], numbers.scatter[:, a])
        middle, width = float(np.mean(numbers.value[:, a])), float(np.std(numbers.value[:, a]))
        wide = _density(given[:, a], middle, max(width, float(np.max(numbers.scatter[:, a]))))
        # What lies beyond all keys may be anything: the least density that arithmetic bears.
        anywhere[:, a] = np.maximum((by_key.mean(axis=1) + wide) / 2, 1e-300)
        other += np.log(np.maximum(by_key, anywhere[:, a, None]))
    own = np.maximum(_density(given, numbers.value[rows], numbers.scatter[rows]), anywhere)
    mistaken = _density(given[:, None], numbers.mistaken[rows], numbers.mistaken_scatter[rows])
    # The own key is an explanation too, where no mistake is catalogued.
    explained = np.log(np.maximum(mistaken, own[:, None])).sum(axis=2)
    best = np.maximum(explained.max(axis=1, initial=-np.inf), np.log(own).sum(axis=1))
    return other - best[:, None]


def _density(given: Floats, value: Floats | float, scatter: Floats | float) -> Floats:
    """The normal density; nought where nothing is given."""
    with np.errstate(over="ignore"):
        return np.nan_to_num(np.exp(-0.5 * ((given - value) / scatter) ** 2) * (UNIT_NORMAL / scatter))


def _fits(numbers: CourseNumbers, i: int, j: int) -> Flags:
    """The wrong numbers (answers,) of student i that lie within the tolerance of student j."""
    off = np.abs(numbers.given[i] - numbers.value[j])
    return numbers.wrong[i] & (off <= numbers.bound[j] * numbers.scatter[j])


def same_wrong_numbers(numbers: CourseNumbers) -> list[tuple[int, int, float]]:
    """The students i < j whose wrong numbers are the same to the last digit, with what probability by chance.

    Of numbers that are wrong in both and that no mistake brings to both, each is the same by :func:`chance`, and with
    the probability ``COPIED_PART`` where one was taken over from the other.
    """
    wrong = np.flatnonzero(numbers.wrong.sum(axis=1) >= FEWEST)
    pairs = wrong.size * (wrong.size - 1) // 2
    found: list[tuple[int, int, float]] = []
    for rows in np.split(wrong, range(ROWS, wrong.size, ROWS)):
        equal = np.zeros((rows.size, wrong.size), dtype=np.intp)
        for a in range(numbers.given.shape[1]):
            equal += numbers.given[rows, a][:, None] == numbers.given[wrong, a]
        left, right = np.nonzero((rows[:, None] < wrong) & (equal >= FEWEST))
        i, j = rows[left], wrong[right]
        same, both = _same_wrong(numbers, i, j)
        p = chance(numbers, i, j)
        ratio = np.where(same, COPIED_PART / p, np.where(both, (1 - COPIED_PART) / np.maximum(1 - p, 1e-3), 1.0))
        gained = np.log(ratio).sum(axis=1)
        named = (gained >= math.log(max(pairs, 1) / FALSE_ALARM)) & (np.count_nonzero(same, axis=1) >= FEWEST)
        found += [(int(i[k]), int(j[k]), pairs * math.exp(-float(gained[k]))) for k in np.flatnonzero(named)]
    return found


def _same_wrong(numbers: CourseNumbers, i: NDArray[np.intp], j: NDArray[np.intp]) -> tuple[Flags, Flags]:
    """Of pairs the answers (pairs, answers) that are wrong in both and the same, and those that are wrong in both.

    Left out are those that one mistake brings to both, and what is only calculated from the same sizes.
    """
    reach = numbers.bound[:, None, None] * numbers.mistaken_scatter
    brought = np.abs(numbers.given[:, None] - numbers.mistaken) <= reach
    shared = (brought[i] & brought[j]).any(axis=1)
    alike = np.abs(numbers.value[i] - numbers.value[j]) <= ALIKE_KEYS * (numbers.scatter[i] + numbers.scatter[j])
    both = numbers.wrong[i] & numbers.wrong[j] & ~shared & (numbers.drawn | ~alike)
    return both & (numbers.given[i] == numbers.given[j]), both


def chance(numbers: CourseNumbers, i: NDArray[np.intp], j: NDArray[np.intp]) -> Floats:
    """The probability (pairs, answers) that two honest wrong numbers are the same.

    At most: both draw the same wrong thing, and two careful hands then read the same digits with the probability
    step / (2 sqrt(pi) scatter).  It counts too how many others of the course say that number.
    """
    # A wrong drawing that is smaller scatters less.
    size = np.abs(numbers.given[i]) / np.maximum(np.maximum(np.abs(numbers.value[i]), np.abs(numbers.value[j])), 1e-9)
    scatter = np.minimum(numbers.scatter[i], numbers.scatter[j]) * np.clip(size, 1e-3, 1.0)
    by_hand = _steps(numbers.given[i]) / (2 * math.sqrt(math.pi) * scatter)
    others = np.empty_like(numbers.given[i])
    for a in range(others.shape[1]):
        course, said = np.sort(numbers.given[:, a]), numbers.given[i, a]
        count = np.searchsorted(course, said, side="right") - np.searchsorted(course, said, side="left")
        others[:, a] = (count - 2) / len(numbers.given)
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
