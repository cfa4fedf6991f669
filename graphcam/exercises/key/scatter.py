"""Many careful students draw: what they answer, and how it scatters."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.chain import Chain
from graphcam.drafting.curve import faired
from graphcam.drafting.marks import Points
from graphcam.drafting.slips import EVENLY
from graphcam.exercises.definition.drawn_answers import ask, construction_of, per_mm
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.key.expectation import Expected, Floats, distance_to_curve
from graphcam.given.motion import FULL_TURN

Drawn = list[NDArray[Any]]
"""One entry an answer: numbers ([samples,]) or complex points ([samples,] m)."""
CALCULATED = 1e-3
"""Relative standard deviation of what is only calculated: three figures are carried."""
NORMAL_95 = 1.959964
"""95 % of normally distributed values lie within so many standard deviations."""
PROFILES = ("inversion", "working_profile")
"""Constructions about the cam centre, whose curves are closed."""


def answers_of(exercise: Exercise, chain: Chain) -> Drawn:
    """What the hands that drew this answer: many hands round as asked, a perfect one without samples does not."""
    samples = chain.pencil.samples
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
    read = 0.0 if math.isnan(length) else length * math.hypot(exercise.hand.line, exercise.hand.division * EVENLY)
    return max(EVENLY * 10.0**-asked.decimals, CALCULATED * abs(value), read)


def torn(exercise: Exercise, chain: Chain, hands: Drawn) -> bool:
    """Whether careful hands name different sides of a signed greatest that is asked: then no one answer is right."""
    return any(
        samples.min() < 0 < samples.max()
        for asked, samples in zip(exercise.answers, hands, strict=True)
        if (said := construction_of(chain, asked.construction).meaning.readings.get(asked.reading))
        and any(compared.sides for compared in said.compared)
    )


def distances(exercise: Exercise, perfect: Drawn, hands: Drawn) -> Drawn:
    """How far the answers of many hands lie from those of a perfect one: (samples,) each, of points (samples, m)."""
    return [
        distance_to_curve(value, samples) if asked.kind == "curve" else np.abs(samples - value)
        for asked, value, samples in zip(exercise.answers, perfect, hands, strict=True)
    ]


def expected(
    exercise: Exercise, perfect: Drawn, off: Drawn, lengths: list[float], bent: list[Floats] | None = None
) -> list[Expected]:
    """Values and scatters of all answers.

    perfect : of a perfect hand; off : :func:`distances` of careful ones
    lengths : units of each answer in one mm of paper; bent : bulges of each, where it matters
    """
    bent = bent or [np.empty(0)] * len(lengths)
    found: list[Expected] = []
    for asked, value, apart, length, bulge in zip(exercise.answers, perfect, off, lengths, bent, strict=True):
        if asked.kind == "number":
            least = least_scatter(exercise, asked, float(value), length)
            found.append(Expected(float(value), max(least, float(np.sqrt(np.mean(apart**2))))))
            continue
        scatter = np.maximum(np.sqrt(np.mean(apart**2, axis=0) / 2), exercise.hand.line)
        # The worst of many points strays farther than one number does; in this unit it strays as far.
        worst = float(np.quantile((apart / scatter).max(axis=1), 0.95))
        found.append(Expected(np.asarray(value), scatter * worst / NORMAL_95, bulge))
    return found


def lengths_of(exercise: Exercise, chain: Chain) -> list[float]:
    """Units of each answer in one mm of paper, NaN for what is not a length; drawn by a perfect hand."""
    return [per_mm(chain, asked) for asked in exercise.answers]


def bulges_of(exercise: Exercise, chain: Chain) -> list[Floats]:
    """The bulges of every answer that is a curve, of others none; drawn by a perfect hand."""
    return [bulges(chain, asked) if asked.kind == "curve" else np.empty(0) for asked in exercise.answers]


def deviations(exercise: Exercise, keys: list[Expected], off: Drawn) -> NDArray[np.float64]:
    """How far each of many submissions is off, (samples, answers), in pencil units, from its :func:`distances`.

    A hand that joins its plotted points is nowhere farther off than at one of them, so of curves these count alone.
    """
    relative = [each / key.scatter for each, key in zip(off, keys, strict=True)]
    columns = [
        each if asked.kind == "number" else each.max(axis=1)
        for asked, each in zip(exercise.answers, relative, strict=True)
    ]
    return np.stack(columns, axis=1)


def bulges(chain: Chain, asked: Asked) -> Floats:
    """The bulges of a curve, as many as it has points where it is closed, else one fewer, else none: all straight.

    chain : drawn by a hand without samples

    Inside a moving phase the curve is faired through the points; in a dwell a profile is an arc about the cam centre,
    and a diagram a straight line.
    """
    points, stations = ask(chain, asked), chain.board.stations
    if points.size != stations.u.size:
        return np.empty(0)
    found = np.zeros(points.size)
    for piece in stations.pieces:
        plotted = points[piece]
        # Of two points alone the second comes back, which lies on the chord as well.
        middle = faired(plotted, between=2)[1::2]
        found[piece.start : piece.stop - 1] = _bulge(plotted[:-1], middle, plotted[1:])
    if asked.construction not in PROFILES:
        return found[:-1]
    # The angles at the cam centre after every moving phase, counter-clockwise [rad].
    inside = np.delete(np.angle(points[1:] / points[:-1]), stations.last[:-1])
    after = (stations.phi[(stations.last + 1) % points.size] - stations.phi[stations.last]) % FULL_TURN
    found[stations.last] = np.tan(np.copysign(after, inside.sum()) / 4)
    return found


def _bulge(start: Points, middle: Points, end: Points) -> Floats:
    half = (end - start) / 2
    bent: Points = np.divide(middle - start - half, half, out=np.zeros_like(half), where=half != 0)
    return np.asarray(-bent.imag, dtype=np.float64)
