"""The construction drawn again from a student's possible own answers: how later answers depend on earlier ones."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.pencil import Pencil
from graphcam.exercises.drawing import ask, board_chain, with_own
from graphcam.exercises.exercise import Asked, Exercise
from graphcam.exercises.expectation import Expected
from graphcam.exercises.follow import NODES, Dependence, Effect, Together, span
from graphcam.task import Task

NOTHING = 0.05
"""Effects of less than this part of the tolerance are none."""
TRIALS = 24
"""Drawings from several own values at once, to see how effects go together."""
SPREAD = 0.4
"""By what part of themselves the own values of these are off at most."""


def dependences(exercise: Exercise, task: Task, keys: list[Expected], bound: float) -> dict[str, Dependence]:
    """How every numeric answer depends on the numeric ones before it; answers that depend on none are left out."""
    numbers = [(asked, key) for asked, key in zip(exercise.answers, keys, strict=True) if asked.kind == "number"]
    found: dict[str, Dependence] = {}
    for k in range(1, len(numbers)):
        asked, key = numbers[k]
        effects = _effects(task, numbers[:k], asked, bound * float(key.scatter), float(np.real(key.value)))
        if effects:
            found[asked.name] = _put_together(task, numbers[:k], asked, effects, float(np.real(key.value)))
    return found


def _effects(
    task: Task, earlier: list[tuple[Asked, Expected]], asked: Asked, tolerance: float, key: float
) -> dict[str, Effect]:
    count = len(earlier)
    centres = np.array([float(np.real(each.value)) for _, each in earlier])
    widths = np.array([max(abs(c) / 4, 4 * float(each.scatter)) for c, (_, each) in zip(centres, earlier, strict=True)])
    own = np.tile(centres, (count, NODES, 1))
    for i in range(count):
        t = np.linspace(-1, 1, NODES) * span(centres[i], widths[i])
        own[i, :, i] = centres[i] + widths[i] * np.sinh(t)
    drawn = _drawn_again(task, earlier, asked, own.reshape(-1, count)).reshape(count, NODES)
    effects: dict[str, Effect] = {}
    for i, (before, _) in enumerate(earlier):
        change = np.abs(drawn[i] - key)
        if np.nanmax(change, initial=0.0) > NOTHING * tolerance:
            # Seven figures are far finer than the parabola between the nodes, and quicker to read.
            values = tuple(float(f"{value:.7g}") if math.isfinite(value) else None for value in drawn[i])
            effects[before.name] = Effect(float(centres[i]), float(widths[i]), values)
    return effects


def _put_together(
    task: Task, earlier: list[tuple[Asked, Expected]], asked: Asked, effects: dict[str, Effect], key: float
) -> Dependence:
    centres = np.array([float(np.real(each.value)) for _, each in earlier])
    random = np.random.RandomState(0)
    own = centres * (1 + SPREAD * random.uniform(-1, 1, (TRIALS, centres.size)))
    drawn = _drawn_again(task, earlier, asked, own)
    names = [before.name for before, _ in earlier]

    def missed(together: Together) -> float:
        rule = Dependence(effects, together)
        off = [rule.expected(key, dict(zip(names, row, strict=True))) for row in own.tolist()]
        return float(np.nanmedian(np.abs(np.array(off) - drawn)))

    by_factors = bool(key) and missed("product") <= missed("sum")
    return Dependence(effects, "product" if by_factors else "sum")


def _drawn_again(
    task: Task, earlier: list[tuple[Asked, Expected]], asked: Asked, own: NDArray[np.float64]
) -> NDArray[np.float64]:
    """The answer (n,) drawn by a perfect hand from rows of own values (n, earlier)."""
    chain = board_chain(task, Pencil(samples=len(own)))
    with np.errstate(all="ignore"):
        chain = with_own(chain, [(before, own[:, i]) for i, (before, _) in enumerate(earlier)])
        return np.broadcast_to(ask(chain, asked), (len(own),))
