"""Many careful students draw: what they answer, and how it scatters."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.chain import Chain
from graphcam.exercises.bulges import bulges
from graphcam.exercises.curve_distance import distance_to_curve
from graphcam.exercises.drawing import ask, board_chain, per_mm
from graphcam.exercises.exercise import Asked, Exercise
from graphcam.exercises.expectation import Expected, Floats
from graphcam.task import Task

Drawn = list[NDArray[Any]]
"""One entry an answer: numbers ([samples,]) or complex points ([samples,] m)."""
Change = Callable[[Chain], Chain]

UNIFORM = 1 / math.sqrt(12)
"""Standard deviation of a rounding, in its steps."""
CALCULATED = 1e-3
"""Relative standard deviation of what is only calculated: three figures are carried."""
NORMAL_95 = 1.959964
"""95 % of normally distributed values lie within so many standard deviations."""


def answers_of(
    exercise: Exercise, task: Task, samples: int | None, seed: int = 0, change: Change | None = None
) -> Drawn:
    """What careful hands answer, each rounding as asked, or a perfect one (``samples`` None) that does not round."""
    pencil = None if samples is None else exercise.hand.pencil(samples, seed)
    chain = board_chain(task, pencil)
    chain = change(chain) if change else chain
    given: Drawn = []
    for asked in exercise.answers:
        answer = np.asarray(ask(chain, asked))
        if samples is None:
            given.append(answer)
        elif asked.kind == "number":
            given.append(np.round(np.broadcast_to(answer, (samples,)), asked.decimals))
        else:
            given.append(np.broadcast_to(answer, (samples, answer.shape[-1])))
    return given


def least_scatter(exercise: Exercise, asked: Asked, value: float, length: float) -> float:
    """What every number scatters by at least: by its rounding, by reading a scale, by calculating.

    length : units of the answer in one mm of paper, NaN for what is not a length
    """
    read = 0.0 if math.isnan(length) else length * math.hypot(exercise.hand.line, exercise.hand.division * UNIFORM)
    return max(UNIFORM * 10.0**-asked.decimals, CALCULATED * abs(value), read)


def expected(
    exercise: Exercise, perfect: Drawn, hands: Drawn, lengths: list[float], bent: list[Floats] | None = None
) -> list[Expected]:
    """Values and scatters of all answers, from a perfect hand and from careful ones.

    lengths : units of each answer in one mm of paper; bent : bulges of each, where it matters
    """
    bent = bent or [np.empty(0)] * len(lengths)
    found: list[Expected] = []
    for asked, value, samples, length, bulge in zip(exercise.answers, perfect, hands, lengths, bent, strict=True):
        off = _distances(asked, value, samples)
        if asked.kind == "number":
            least = least_scatter(exercise, asked, float(value), length)
            found.append(Expected(float(value), max(least, float(np.sqrt(np.mean(off**2))))))
            continue
        scatter = np.maximum(np.sqrt(np.mean(off**2, axis=0) / 2), exercise.hand.line)
        # The worst of many points strays farther than one number does; in this unit it strays as far.
        worst = float(np.quantile((off / scatter).max(axis=1), 0.95))
        found.append(Expected(np.asarray(value), scatter * worst / NORMAL_95, bulge))
    return found


def lengths_of(exercise: Exercise, task: Task) -> list[float]:
    """Units of each answer in one mm of paper, NaN for what is not a length."""
    chain = board_chain(task)
    return [per_mm(chain, asked) for asked in exercise.answers]


def bulges_of(exercise: Exercise, task: Task, change: Change | None = None) -> list[Floats]:
    """The bulges of every answer that is a curve, of others none."""
    chain = board_chain(task)
    chain = change(chain) if change else chain
    return [bulges(chain, asked) if asked.kind == "curve" else np.empty(0) for asked in exercise.answers]


def deviations(exercise: Exercise, keys: list[Expected], hands: Drawn) -> NDArray[np.float64]:
    """How far each of many hand-ins is off, (samples, answers), in pencil units.

    A hand that joins its plotted points is nowhere farther off than at one of them, so of curves these count alone.
    """
    relative = [
        _distances(asked, key.value, samples) / key.scatter
        for asked, key, samples in zip(exercise.answers, keys, hands, strict=True)
    ]
    columns = [
        off if asked.kind == "number" else off.max(axis=1)
        for asked, off in zip(exercise.answers, relative, strict=True)
    ]
    return np.stack(columns, axis=1)


def _distances(asked: Asked, value: Any, samples: NDArray[Any]) -> NDArray[np.float64]:
    """How far every sample lies from the value, of points (samples, m) from every point."""
    return distance_to_curve(value, samples) if asked.kind == "curve" else np.abs(samples - value)
