"""Answers beside the key, how far off they are, and which catalogued mistake explains them, in units of scatter."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from graphcam.exercises.definition.exercise import Answers, AskedAnswer, Exercise, Given
from graphcam.exercises.key.answer_key import AnswerKey, Hypothesis
from graphcam.exercises.key.expected_answers import AnswerDeviation, Expected
from graphcam.exercises.marking.record import Diagnosis

MAX_POINTS = 20_000
"""No curve by hand has more, and no submission shall keep the marking busy."""
MAX_READING = 1e15
"""No reading is larger, and no number up to here makes the arithmetic overflow."""
MAX_DEVIATIONS = 5.0
"""The standard deviations beyond which an answer speaks against a mistake no more: it may be a slip of its own."""
UNEXPLAINED_COST = 16.0
"""What a wrong number that is anywhere costs, in twice the logarithm of the probability: a mistake that brings numbers
more than four standard deviations off explains them no better."""
MIN_EXPLAINED_SHARE = 0.85
"""A mistake that does not look like so much of the answers that are wrong or would be by it, is not named; by marks."""
MAX_ERROR_GROWTH = 100.0
"""A hand's error grows with the length that is drawn, up to this factor."""
ALIKE_PROBABILITY = 0.1
"""A mistake that is at least this part as probable as the best one is not told from it."""
UNSEPARATED_PROBABILITY = 1e-3
"""One that the answers of the variant do not tell from the best one, if it is at least this part as probable."""
MIN_DIAGNOSIS_PROBABILITY = 0.5
"""A diagnosis less probable than this, together with those alike, is not made."""
MAX_COST_EXCESS = 30.0
"""A mistake worse by so much, in twice the logarithm of the probability, is not looked for in what is drawn."""


class ComparedAnswer(NamedTuple):
    """An answer that can be read, beside the key.

    place : among the answers of the exercise
    wrong : whether it lies outside the tolerance
    """

    place: int
    asked: AskedAnswer
    given: Given
    key: Expected
    off: AnswerDeviation
    wrong: bool


def compare(exercise: Exercise, answer_key: AnswerKey, answers: Answers) -> list[ComparedAnswer]:
    """The answers that can be read, in the order of the exercise."""
    found: list[ComparedAnswer] = []
    for place, asked in enumerate(exercise.answers):
        if (given := _readable_answer(asked, answers)) is not None:
            key = answer_key.keys[asked.name].expected
            # As far as anything is paid it must be told exactly.
            off = key.deviation_of(given, asked.kind, answer_key.bound * exercise.policy.near)
            # A NaN is wrong too.
            wrong = not abs(off.deviation) <= answer_key.bound
            found.append(ComparedAnswer(place, asked, given, key, off, wrong))
    return found


def _readable_answer(asked: AskedAnswer, answers: Answers) -> Given | None:
    """The answer as a finite number or as points, None where it is neither."""
    given = answers.values.get(asked.name)
    if asked.kind == "number":
        if isinstance(given, bool) or not isinstance(given, int | float):
            return None
        return float(given) if abs(given) <= MAX_READING else None
    if not isinstance(given, np.ndarray) or given.ndim != 1 or not 0 < given.size <= MAX_POINTS:
        return None
    # Compared this way round, for a NaN is not less than anything.
    fits = np.issubdtype(given.dtype, np.number) and bool((np.abs(given) <= MAX_READING).all())
    return given.astype(np.complex128) if fits else None


class _Explanation(NamedTuple):
    """The fit of one mistake to the answers.

    badness : minus twice the logarithm of the probability, each answer being anywhere if it is far off
    like : the places of the wrong answers that look like what the mistake brings
    near : those of them that give it its name: not what may be nought by its scatter
    explained : those of them that are what it brings, as exactly as an answer must be that earns its marks
    against : the places of the right answers that the mistake would have made wrong
    """

    badness: float
    like: frozenset[int]
    near: frozenset[int]
    explained: frozenset[int]
    against: frozenset[int]


def diagnose(answer_key: AnswerKey, compared: Sequence[ComparedAnswer]) -> tuple[Diagnosis, frozenset[int]] | None:
    """The most probable mistake and the places of the answers that it brings; None where none looks like any."""
    # "Something else": the right answers as a careful hand gives them, each wrong one anywhere.
    other = sum(map(_as_something_else, compared))
    fits = {
        name: fit
        for name, fit in _explanations(answer_key, compared, other).items()
        if fit.near and _explains_most(fit, compared)
    }
    if not fits:
        return None
    least = min(other, *(fit.badness for fit in fits.values()))
    weights = {name: math.exp((least - fit.badness) / 2) for name, fit in fits.items()}
    best = max(weights, key=lambda name: weights[name])
    not_told = answer_key.inseparable_from(best)
    least_part = {
        name: UNSEPARATED_PROBABILITY if name in not_told else ALIKE_PROBABILITY for name in weights if name != best
    }
    alike = tuple(name for name, part in least_part.items() if weights[name] >= part * weights[best])
    total = sum(weights.values()) + math.exp((least - other) / 2)
    if sum(weights[name] for name in (best, *alike)) < MIN_DIAGNOSIS_PROBABILITY * total:
        return None
    return Diagnosis(best, weights[best] / total, alike), fits[best].explained


def _explains_most(fit: _Explanation, compared: Sequence[ComparedAnswer]) -> bool:
    """Whether a mistake looks like most of what is wrong, or would be by it, each answer counted by its marks."""
    touched = sum(each.asked.marks for each in compared if each.wrong or each.place in fit.against)
    return sum(each.asked.marks for each in compared if each.place in fit.like) >= MIN_EXPLAINED_SHARE * touched


def _explanations(answer_key: AnswerKey, compared: Sequence[ComparedAnswer], other: float) -> dict[str, _Explanation]:
    """The fit of every mistake; one that the numbers make hopeless is left out where something is drawn."""
    bound, hypotheses = answer_key.bound, answer_key.hypotheses
    numbers = [(each.place, each.given, each.key) for each in compared if isinstance(each.given, float)]
    wrong = frozenset(each.place for each in compared if each.wrong)
    drawn = [each for each in compared if not isinstance(each.given, float)]
    fits = {name: _numbers_fit(values, numbers, wrong, bound) for name, values in hypotheses.items()}
    if not drawn:
        return fits
    # A drawing takes longer to compare than all numbers: only with what these leave possible.
    least = min([other, *(fit.badness + MAX_DEVIATIONS**2 * len(drawn) for fit in fits.values() if fit.near)])
    possible = {name: fit for name, fit in fits.items() if fit.badness <= least + MAX_COST_EXCESS}
    return {name: _with_drawings(fit, hypotheses[name], drawn, bound) for name, fit in possible.items()}


def _numbers_fit(
    values: Hypothesis, numbers: Sequence[tuple[int, float, Expected]], wrong: frozenset[int], bound: float
) -> _Explanation:
    """The fit of a mistake to the numbers, each given with its place and its key."""
    badness = 0.0
    like: list[int] = []
    similar: list[int] = []
    explained: list[int] = []
    against: list[int] = []
    # Most of the time of marking wrong work is spent here.
    for place, given, key in numbers:
        value, scatter = values.said[place]
        off = (given - value) / scatter
        near = -MAX_DEVIATIONS <= off <= MAX_DEVIATIONS
        badness += (off * off if near else MAX_DEVIATIONS * MAX_DEVIATIONS) + 2 * math.log(scatter)
        if place not in wrong:
            if not near and abs(key.deviation(value, "number")) > bound:
                against.append(place)
        elif near:
            like.append(place)
            # A mistake that makes an answer small is not made by who answers nought.
            if abs(given) > bound * scatter:
                similar.append(place)
                if abs(off) <= bound:
                    explained.append(place)
    return _Explanation(badness, *map(frozenset, (like, similar, explained, against)))


def _with_drawings(
    fit: _Explanation, values: Hypothesis, drawn: Sequence[ComparedAnswer], bound: float
) -> _Explanation:
    off = {each.place: values[each.place].deviation(each.given, each.asked.kind, MAX_DEVIATIONS) for each in drawn}
    near = {each.place for each in drawn if each.wrong and off[each.place] <= MAX_DEVIATIONS}
    explained = {place for place in near if off[place] <= bound}
    badness = fit.badness + sum(min(each, MAX_DEVIATIONS) ** 2 for each in off.values())
    against = {each.place for each in drawn if not each.wrong and off[each.place] > MAX_DEVIATIONS}
    return _Explanation(badness, fit.like | near, fit.near | near, fit.explained | explained, fit.against | against)


def _as_something_else(answer: ComparedAnswer) -> float:
    """What an answer costs if something else was done: a right one as by a careful hand, a wrong one anywhere."""
    # Of points the worst one counts, in a unit of its own, so no width is comparable there.
    width = 2 * math.log(answer.key.scatter) if isinstance(answer.key.scatter, float) else 0.0
    if not answer.wrong:
        return min(answer.off.deviation**2, MAX_DEVIATIONS**2) + width
    if not isinstance(answer.given, float) or not isinstance(answer.key.value, float):
        return MAX_DEVIATIONS**2 + width
    # A mistake that makes a number larger makes its scatter larger: that is no reason against it.
    size = max(abs(answer.key.value), answer.key.scatter)
    return UNEXPLAINED_COST + width + 2 * math.log(min(MAX_ERROR_GROWTH, max(1.0, abs(answer.given) / size)))
