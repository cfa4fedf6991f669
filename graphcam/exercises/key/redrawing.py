"""The construction drawn again from a student's possible own answers: how later answers depend on earlier ones."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.drafting.pencil import Pencil
from graphcam.exercises.definition.drawn_answers import drawn_answer, with_own_answers
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.key.answer_scatter import Drawn, least_scatter
from graphcam.exercises.key.expected_answers import Expected, Floats
from graphcam.exercises.key.follow_through import NODE_COUNT, OWN_VALUE_RANGE, Dependence, Effect, Together, span

NEGLIGIBLE_EFFECT = 0.05
"""Effects of less than this part of the tolerance are none."""
TRIAL_COUNT = 24
"""Drawings from several own values at once, to see how effects go together."""
FOLLOWING_HANDS = 200
"""Careful hands behind the scatter of an answer about what follows from their own earlier ones."""
TRIAL_SPREAD = 0.4
"""The maximum part of themselves by which own values are off in the trials."""


def dependences(
    exercise: Exercise, chain: Chain, keys: list[Expected], bound: float, hands: Drawn, lengths: Sequence[float]
) -> dict[str, Dependence]:
    """The dependence of every numeric answer on those before it; answers that depend on none are left out.

    chain : the right drawing
    hands : what careful hands answer; lengths : units of each answer in one mm of paper
    """
    rows = zip(exercise.answers, keys, hands, lengths, strict=True)
    numbers = [row for row in rows if row[0].kind == "number"]
    if len(numbers) < 2:
        return {}
    asked = [each for each, *_ in numbers]
    centres = np.array([float(np.real(key.value)) for _, key, *_ in numbers])
    scatters = np.array([float(key.scatter) for _, key, *_ in numbers])
    least = [least_scatter(exercise, each, float(key.value), length) for each, key, _, length in numbers]
    careful = np.stack([samples[:FOLLOWING_HANDS] for _, _, samples, _ in numbers], axis=1)
    widths = np.maximum(np.abs(centres) / 4, 4 * scatters)
    # One drawing for all: in its samples one own value each is off, then several at once.
    alone, trials = _single_own_values(centres, widths), _several_own_values(centres)
    own = np.concatenate([alone.reshape(-1, centres.size), trials.reshape(-1, centres.size)])
    one, several = np.split(_redrawn_answers(chain, asked, own), [alone.size // centres.size])
    one, several = one.reshape(alone.shape), several.reshape(trials.shape)
    found: dict[str, Dependence] = {}
    hand_rows: list[dict[str, float]] = [{} for _ in careful]
    for k, key in enumerate(centres.tolist()):
        effects = {
            asked[i].name: _effect(float(centres[i]), float(widths[i]), alone[i, :, i], one[i, :, k], key)
            for i in range(k)
            if np.nanmax(np.abs(one[i, :, k] - key), initial=0.0) > NEGLIGIBLE_EFFECT * bound * scatters[k]
        }
        own = careful[:, k].tolist()
        if effects:
            rows = _moved_rows(found, asked[:k], centres, trials[k - 1])
            whole = _put_together(effects, key, rows, several[k - 1, :, k])
            following = [whole.expected(key, row) for row in hand_rows]
            off = float(np.sqrt(np.nanmean((np.array(following) - own) ** 2)))
            found[asked[k].name] = replace(whole, scatter=max(least[k], off))
            own = [whole.moved(key, given, expected) for given, expected in zip(own, following, strict=True)]
        for row, moved in zip(hand_rows, own, strict=True):
            row[asked[k].name] = moved
    return found


def _moved_rows(
    found: Mapping[str, Dependence], asked: Sequence[AskedAnswer], centres: Floats, own: Floats
) -> list[dict[str, float]]:
    """The own values (rows, n) of the answers asked, each as it would be if those before it were right."""
    rows: list[dict[str, float]] = []
    for values in own.tolist():
        row: dict[str, float] = {}
        for each, key, given in zip(asked, centres.tolist(), values, strict=False):
            dependence = found.get(each.name)
            row[each.name] = dependence.moved(key, given, dependence.expected(key, row)) if dependence else given
        rows.append(row)
    return rows


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
    """Own values (n - 1, NODE_COUNT, n): in each row one of the first n - 1 is off, from little to far.

    The others are NaN: they follow.
    """
    own = np.full((centres.size - 1, NODE_COUNT, centres.size), np.nan)
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
    """The answers (rows, n) of a perfect hand, each drawn from the own values (rows, n) of those before it.

    own : NaN where an answer follows from those before it
    """
    drawn = np.empty(own.shape)
    chain = chain.by(Pencil(samples=len(own)))
    with np.errstate(all="ignore"):
        for k, each in enumerate(asked):
            drawn[:, k] = drawn_answer(chain, each)
            chain = with_own_answers(chain, each, np.where(np.isnan(own[:, k]), drawn[:, k], own[:, k]))
    return drawn


def _figures(values: Floats) -> tuple[float | None, ...]:
    """Seven figures, which are far finer than the parabola between the nodes, and quicker to read."""
    return tuple(float(f"{value:.7g}") if math.isfinite(value) else None for value in values.tolist())


def _put_together(effects: Mapping[str, Effect], key: float, own: list[dict[str, float]], drawn: Floats) -> Dependence:
    """The effects, with the rule that comes nearer to what was drawn (rows,) from several own values at once."""

    def missed(together: Together) -> float:
        """How far a rule is off what was drawn, in the unit of the answer: the median."""
        rule = Dependence(effects, together, 0.0)
        return float(np.nanmedian(np.abs(np.array([rule.expected(key, row) for row in own]) - drawn)))

    by_factors = bool(key) and missed("product") <= missed("sum")
    return Dependence(effects, "product" if by_factors else "sum", 0.0)
