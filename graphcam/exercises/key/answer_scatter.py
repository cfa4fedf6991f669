"""Many careful students draw: what they answer, and how it scatters."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.chain import Chain
from graphcam.drafting.curve import faired_line
from graphcam.drafting.marks import Points
from graphcam.drafting.slips import UNIFORM_DEVIATION
from graphcam.exercises.definition.drawn_answers import construction_of, drawn_answer, is_length, per_mm
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.student_hands import ManyHands
from graphcam.exercises.key.expected_answers import Expected, Floats, distance_to_curve
from graphcam.given.motion import FULL_TURN

Drawn = list[NDArray[Any]]
"""One entry an answer: numbers ([samples,]) or complex points ([samples,] m)."""
CALCULATION_DEVIATION = 3.5e-3
"""Relative standard deviation of what is only calculated: three figures are carried, of 1° = 0.0175 rad too, whose
square is in a scale of a."""
NORMAL_99 = 2.575829
"""99 % of normally distributed values lie within so many standard deviations."""
DWELL_STEP = math.radians(15)
"""The maximum angle between points of a curve on the arc of a dwell, as seen from the cam centre."""
PROFILE_CONSTRUCTIONS = ("inversion", "working_profile")
"""Constructions about the cam centre, whose curves are closed."""


def answers_of(exercise: Exercise, chain: Chain) -> Drawn:
    """What the hands that drew this answer: many hands round as asked, a perfect one without samples does not."""
    return [answer_of(chain, asked) for asked in exercise.answers]


def answer_of(chain: Chain, asked: AskedAnswer) -> NDArray[Any]:
    """What the hands that drew this give for one answer."""
    answer = np.asarray(curve_of(chain, asked) if asked.kind == "curve" else drawn_answer(chain, asked))
    pencil = chain.pencil
    if pencil.samples is None:
        return answer
    stretched = pencil.stretch_factors if isinstance(pencil, ManyHands) else np.ones(pencil.samples)
    if asked.kind == "number":
        # An angle or a scale is what it was, whatever becomes of the paper.
        return np.round(answer * (stretched if is_length(chain, asked) else np.ones(pencil.samples)), asked.decimals)
    return answer * stretched[:, None]


def least_scatter(exercise: Exercise, asked: AskedAnswer, value: float, length: float) -> float:
    """What every number scatters by at least: by its rounding, by reading a scale, by calculating.

    length : units of the answer in one mm of paper, NaN for what is not a length
    """
    errors = exercise.hand.errors
    read = (
        0.0
        if math.isnan(length)
        else length * math.hypot(errors.line.middle, errors.division.middle * UNIFORM_DEVIATION)
    )
    return max(UNIFORM_DEVIATION * 10.0**-asked.decimals, CALCULATION_DEVIATION * abs(value), read)


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
        scatter = np.maximum(np.sqrt(np.mean(apart**2, axis=0) / 2), exercise.hand.errors.line.middle)
        # The worst of many points strays farther than one number does; in this unit it strays as far.
        worst = float(np.quantile((apart / scatter).max(axis=1), 0.99))
        found.append(Expected(np.asarray(value), scatter * worst / NORMAL_99, bulge))
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


def curve_of(chain: Chain, asked: AskedAnswer) -> Points:
    """The points ([samples,] m) of a curve: its stations, and of a profile some on the arc of every dwell.

    An arc has its points by the compasses about the cam centre, from the last station of the one moving phase to the
    first of the next: a drawing without its dwells is not near them.
    """
    points = drawn_answer(chain, asked)
    if not _is_closed(chain, asked, points):
        return points
    stations, turns = chain.board.stations, _dwells(chain)
    turning = np.sign(np.delete(np.angle(points[..., 1:] / points[..., :-1]), stations.last[:-1], axis=-1).sum(axis=-1))
    found: list[Points] = []
    for span, last, after in zip(stations.phases, stations.last, turns, strict=True):
        start, end = points[..., last, None], points[..., (last + 1) % points.shape[-1], None]
        turn = (turning * after)[..., None]
        # What the hand's errors add to the angle of the dwell, or take from it.
        turn = turn + np.angle(end / start * np.exp(-1j * turn))
        along = np.arange(1, _dwell_part_count(after)) / _dwell_part_count(after)
        radius = np.abs(start) + (np.abs(end) - np.abs(start)) * along
        found += [points[..., span], radius * np.exp(1j * (np.angle(start) + turn * along))]
    return np.concatenate(found, axis=-1)


def _is_closed(chain: Chain, asked: AskedAnswer, points: Points) -> bool:
    return asked.construction in PROFILE_CONSTRUCTIONS and points.shape[-1] == chain.board.stations.u.size


def _dwells(chain: Chain) -> Floats:
    """The angle from every moving phase to the next one [rad]."""
    stations = chain.board.stations
    turns: Floats = (stations.phi[(stations.last + 1) % stations.phi.size] - stations.phi[stations.last]) % FULL_TURN
    return turns


def _dwell_part_count(dwell: float) -> int:
    """The number of parts into which the arc of a dwell is divided; rounding makes no part more."""
    return max(1, math.ceil(dwell / DWELL_STEP - 1e-6))


def bulges(chain: Chain, asked: AskedAnswer) -> Floats:
    """The bulges between the points of :func:`curve_of`, as many where the curve is closed, else one fewer.

    There are none where all parts are straight.
    chain : drawn by a hand without samples

    Inside a moving phase the curve is faired through the points; in a dwell a profile is an arc about the cam centre,
    and a diagram a straight line.
    """
    points, stations = drawn_answer(chain, asked), chain.board.stations
    on_given_cam = asked.construction == "analysis" and asked.points == "pitch"
    if points.size != stations.u.size and not on_given_cam:
        return np.empty(0)
    found = np.zeros(points.size)
    for piece in chain.analysis.givens.outline.pieces if on_given_cam else stations.pieces:
        plotted = points[piece]
        # Of two points alone the second comes back, which lies on the chord as well.
        middle = faired_line(plotted, between=2)[1::2]
        found[piece.start : piece.stop - 1] = _bulges_of_parts(plotted[:-1], middle, plotted[1:])
    if not _is_closed(chain, asked, points):
        return found[:-1]
    # The angles at the cam centre after every moving phase, counter-clockwise [rad].
    inside = np.delete(np.angle(points[1:] / points[:-1]), stations.last[:-1])
    steps = np.array([_dwell_part_count(after) for after in _dwells(chain)])
    found[stations.last] = np.tan(np.copysign(_dwells(chain) / steps, inside.sum()) / 4)
    times = np.ones(points.size, dtype=np.intp)
    times[stations.last] = steps
    return np.repeat(found, times)


def _bulges_of_parts(start: Points, middle: Points, end: Points) -> Floats:
    half = (end - start) / 2
    bent: Points = np.divide(middle - start - half, half, out=np.zeros_like(half), where=half != 0)
    return np.asarray(-bent.imag, dtype=np.float64)
