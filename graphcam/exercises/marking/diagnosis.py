"""Which catalogued mistake explains a set of answers: the comparison is in units of scatter."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from graphcam.exercises.definition.answers import Given
from graphcam.exercises.definition.exercise import Asked
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.expectation import Expected
from graphcam.exercises.key.hypothesis import Hypothesis
from graphcam.exercises.marking.record import Diagnosis

FAR = 5.0
"""Beyond so many standard deviations an answer speaks against a mistake no more: it may be a slip of its own."""
ALIKE = 0.1
"""A mistake that is at least this part as probable as the best one is not told from it."""
SURE = 0.5
"""A diagnosis less probable than this, together with those alike, is not made."""
HOPELESS = 30.0
"""A mistake worse by so much, in twice the logarithm of the probability, is not looked for in what is drawn."""

Seen = Sequence[tuple[int, Asked, Given]]
"""The answers that can be compared, each with its number in the exercise."""


class _Explanation(NamedTuple):
    """How well a mistake fits.

    badness : minus twice the logarithm of the probability, each answer being anywhere if it is far off
    near : the numbers of the wrong answers that look like what the mistake brings: they give it its name
    explained : those of them that are what it brings, as exactly as an answer must be that earns its marks
    """

    badness: float
    near: frozenset[int]
    explained: frozenset[int]


def diagnose(
    answer_key: AnswerKey, keys: Sequence[Expected], seen: Seen, off: Mapping[int, float], wrong: set[int]
) -> tuple[Diagnosis, frozenset[int]] | None:
    """The most probable mistake and the wrong answers that are what it brings; None where none looks like any.

    off : deviations of the answers seen from the key, by their numbers; wrong : the numbers of those that are wrong
    """
    # "Something else": the right answers as a careful hand gives them, each wrong one anywhere.
    other = sum((FAR**2 if k in wrong else min(off[k] ** 2, FAR**2)) + _width(keys[k]) for k, _, _ in seen)
    numbers = [(k, given) for k, _, given in seen if isinstance(given, float)]
    drawn = [each for each in seen if not isinstance(each[2], float)]
    hypotheses = answer_key.hypotheses
    fits = {name: _numbers_fit(values, numbers, wrong, answer_key.bound) for name, values in hypotheses.items()}
    if drawn:
        # A drawing takes longer to compare than all numbers: only with what these leave possible.
        least = min([other, *(fit.badness + FAR**2 * len(drawn) for fit in fits.values() if fit.near)])
        fits = {name: _with_drawn(fit, hypotheses[name], drawn, wrong, answer_key.bound)
                for name, fit in fits.items() if fit.badness <= least + HOPELESS}  # fmt: skip
    badness = {name: fit.badness for name, fit in fits.items() if fit.near}
    if not badness:
        return None
    least = min(other, *badness.values())
    weights = {name: math.exp((least - bad) / 2) for name, bad in badness.items()}
    best = max(weights, key=lambda name: weights[name])
    alike = tuple(name for name in weights if name != best and weights[name] >= ALIKE * weights[best])
    total = sum(weights.values()) + math.exp((least - other) / 2)
    if sum(weights[name] for name in (best, *alike)) < SURE * total:
        return None
    return Diagnosis(best, weights[best] / total, alike), fits[best].explained


def _numbers_fit(
    values: Hypothesis, numbers: Sequence[tuple[int, float]], wrong: set[int], bound: float
) -> _Explanation:
    badness = 0.0
    similar: list[int] = []
    explained: list[int] = []
    # Most of the time of marking wrong work is spent here.
    for k, given in numbers:
        value, scatter = values.said[k]
        off = (given - value) / scatter
        near = -FAR <= off <= FAR
        badness += (off * off if near else FAR * FAR) + 2 * math.log(scatter)
        # A mistake that makes an answer small is not made by who answers nought.
        if near and k in wrong and abs(given) > bound * scatter:
            similar.append(k)
            if abs(off) <= bound:
                explained.append(k)
    return _Explanation(badness, frozenset(similar), frozenset(explained))


def _with_drawn(fit: _Explanation, values: Hypothesis, drawn: Seen, wrong: set[int], bound: float) -> _Explanation:
    off = {k: values[k].deviation(given, asked.kind, FAR) for k, asked, given in drawn}
    near = {k for k in off if k in wrong and off[k] <= FAR}
    explained = {k for k in near if off[k] <= bound}
    badness = fit.badness + sum(min(each, FAR) ** 2 for each in off.values())
    return _Explanation(badness, fit.near | near, fit.explained | explained)


def _width(value: Expected) -> float:
    # Of points the worst one counts, in a unit of its own, so no width is comparable there.
    return 2 * math.log(value.scatter) if isinstance(value.scatter, float) else 0.0
