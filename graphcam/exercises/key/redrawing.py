"""The construction drawn again from a student's possible own answers: how later answers depend on earlier ones."""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.drafting.pencil import Pencil
from graphcam.exercises.definition.drawn_answers import drawn_answer, with_own_answers
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.key.expected_answers import Expected, Floats
from graphcam.exercises.key.follow_through import NODE_COUNT, OWN_VALUE_RANGE, Dependence, Effect, Together, span

NEGLIGIBLE_EFFECT = 0.05
"""Effects of less than this part of the tolerance are none."""
TRIAL_COUNT = 24
"""Drawings from several own values at once, to see how effects go together."""
TRIAL_SPREAD = 0.4
"""The maximum part of themselves by which own values are off in the trials."""


def dependences(exercise: Exercise, chain: Chain, keys: list[Expected], bound: float) -> dict[str, Dependence]:
    """The dependence of every numeric answer on those before it; answers that depend on none are left out.

    chain : the right drawing
    """
    numbers = [(asked, key) for asked, key in zip(exercise.answers, keys, strict=True) if asked.kind == "number"]
    if len(numbers) < 2:
        return {}
    asked = [each for each, _ in numbers]
    centres = np.array([float(np.real(key.value)) for _, key in numbers])
    scatters = np.array([float(key.scatter) for _, key in numbers])
    widths = np.maximum(np.abs(centres) / 4, 4 * scatters)
    # One drawing for all: in its samples one own value each is off, then several at once.
    alone, trials = _single_own_values(centres, widths), _several_own_values(centres)
    own = np.concatenate([alone.reshape(-1, centres.size), trials.reshape(-1, centres.size)])
    one, several = np.split(_redrawn_answers(chain, asked, own), [alone.size // centres.size])
    one, several = one.reshape(alone.shape), several.reshape(trials.shape)
    found: dict[str, Dependence] = {}
    for k in range(1, centres.size):
        effects = {
            asked[i].name: _effect(float(centres[i]), float(widths[i]), alone[i, :, i], one[i, :, k], float(centres[k]))
            for i in range(k)
            if np.nanmax(np.abs(one[i, :, k] - centres[k]), initial=0.0) > NEGLIGIBLE_EFFECT * bound * scatters[k]
        }
        if effects:
            rows = [dict(zip([each.name for each in asked[:k]], row, strict=False)) for row in trials[k - 1].tolist()]
            found[asked[k].name] = _put_together(effects, float(centres[k]), rows, several[k - 1, :, k])
    return found


POWERS = (1, -1, 2, -2)
"""The powers of an own value with which an answer may go."""
POWER_ROUNDING = 1e-6
"""The maximum part of themselves by which drawings are off a power."""


def _effect(centre: float, width: float, own: Floats, drawn: Floats, key: float) -> Effect:
    """The effect of own values on an answer; exactly, where it goes with a power of them."""
    if centre and key:
        # The drawings by own values that may be looked up.
        near = np.isfinite(drawn) & (np.abs(own) * OWN_VALUE_RANGE >= abs(centre))
        for power in POWERS:
            by_power = key * (own[near] / centre) ** power
            if near.any() and np.allclose(drawn[near], by_power, rtol=POWER_ROUNDING, atol=0.0):
                return Effect(centre, width, (key,), power)
    return Effect(centre, width, _figures(drawn))


def _single_own_values(centres: Floats, widths: Floats) -> Floats:
    """Own values (n - 1, NODE_COUNT, n): in each row one of the first n - 1 is off, from little to far."""
    own = np.tile(centres, (centres.size - 1, NODE_COUNT, 1))
    for i in range(centres.size - 1):
        t = np.linspace(-1, 1, NODE_COUNT) * span(centres[i], widths[i])
        own[i, :, i] = centres[i] + widths[i] * np.sinh(t)
    return own


def _several_own_values(centres: Floats) -> Floats:
    """Own values (n - 1, TRIAL_COUNT, n): those before the second answer are off at random, those before the third,
    ..."""
    own = np.tile(centres, (centres.size - 1, TRIAL_COUNT, 1))
    for k in range(1, centres.size):
        own[k - 1, :, :k] *= 1 + TRIAL_SPREAD * np.random.RandomState(0).uniform(-1, 1, (TRIAL_COUNT, k))
    return own


def _redrawn_answers(chain: Chain, asked: Sequence[AskedAnswer], own: Floats) -> Floats:
    """The answers (rows, n) of a perfect hand, each drawn from the own values (rows, n) of those before it."""
    drawn = np.empty(own.shape)
    chain = chain.by(Pencil(samples=len(own)))
    with np.errstate(all="ignore"):
        for k, each in enumerate(asked):
            drawn[:, k] = drawn_answer(chain, each)
            chain = with_own_answers(chain, each, own[:, k])
    return drawn


def _figures(values: Floats) -> tuple[float | None, ...]:
    """Seven figures, which are far finer than the parabola between the nodes, and quicker to read."""
    return tuple(float(f"{value:.7g}") if math.isfinite(value) else None for value in values.tolist())


def _put_together(effects: Mapping[str, Effect], key: float, own: list[dict[str, float]], drawn: Floats) -> Dependence:
    """The effects, with the rule that comes nearer to what was drawn (rows,) from several own values at once."""

    def missed(together: Together) -> float:
        """How far a rule is off what was drawn, in the unit of the answer: the median."""
        rule = Dependence(effects, together)
        return float(np.nanmedian(np.abs(np.array([rule.expected(key, row) for row in own]) - drawn)))

    by_factors = bool(key) and missed("product") <= missed("sum")
    return Dependence(effects, "product" if by_factors else "sum")
