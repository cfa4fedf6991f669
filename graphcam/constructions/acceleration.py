"""The acceleration diagram, drawn in a scale that is not yet known.

The greatest ordinate of the first rise is chosen.  The lift of a phase goes as y F^2/C, so for the displacement to come
back to the axis every other ordinate must be y = y1 (C h/F^2)/(C1 h1/F1^2).  Which acceleration a millimetre means is
known only after two integrations, when the known lift fixes the scale.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import numbers, phase_ends, phase_title, phi_axes
from graphcam.constructions.law_names import law_name
from graphcam.constructions.views import ACCELERATION
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, between, showing
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Dimension, Points, Role, Segments
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.laws import Floats, Side
from graphcam.given.motion import FULL_TURN, Motion, Moving
from graphcam.given.stations import Stations
from graphcam.words import Caption, joined, sequence


@dataclass(frozen=True, eq=False)
class AccelerationGivens:
    """What lies on the board; see :func:`acceleration_diagram`."""

    motion: Motion
    stations: Stations
    ordinate: float
    mu_phi: Scale
    unit: str


AccelerationDiagram = Construction[AccelerationGivens]


MEANING = Meaning(
    "acceleration",
    say("Acceleration diagram"),
    say(
        "The laws of the motion give the shape of the acceleration. Its scale stays open: the first ordinate is "
        "chosen, the others follow so that the displacement comes back to the axis."
    ),
    {
        "greatest": ReadingMeaning(say("greatest ordinates"), "y", "mm of paper"),
        "middles": ReadingMeaning(say("middle ordinates"), "yₘ", "mm of paper"),
        "base": ReadingMeaning(say("length of the axis"), "b", "rad"),
    },
    "report.paragraphs.acceleration",
)


def acceleration_diagram(
    motion: Motion, stations: Stations, ordinate: float, mu_phi: Scale, unit: str, pencil: Pencil
) -> AccelerationDiagram:
    """Lay off the cam angle, choose the ordinate of the first rise, compute the others, plot the middle ordinates.

    ordinate : greatest ordinate of the first rise [mm of paper]
    mu_phi : scale of the cam angle [rad/mm];  unit : of the lift

    Readings besides those of the meaning: ordinates at the ``stations``, and ``before``, on the near side of a jump.
    Points: the stations on the ``axis``.
    """
    hand, phases = Hand(pencil, MEANING), moving_phases(motion, stations)
    steepness = np.array([p.normalised.peak_acceleration * p.lift / p.angle**2 for p in phases])
    first_rise = next(k for k, phase in enumerate(phases) if phase.direction > 0)
    greatest = ordinate * steepness / steepness[first_rise]

    origin, u, left = hand.given("origin"), stations.u, stations.left
    turn = hand.lay_off("turn", origin, RIGHT, FULL_TURN / mu_phi.per_mm)
    axis, begins = _divided(hand, origin, stations, mu_phi), [span.start for span in stations.phases]

    def ordinates(u: Floats, spans: tuple[slice, ...], side: Side = "right") -> Floats:
        """The given ordinates of all phases, one phase after another."""
        return np.concatenate([y * _shape(p, u[s], side) for p, y, s in zip(phases, greatest, spans, strict=True)])

    tops = hand.lay_off("greatest", axis[begins], UP, greatest)
    after, before = ordinates(u, stations.phases), ordinates(u, stations.phases, "left")
    plotted = hand.lay_off("stations", axis, UP, after)
    # Where the acceleration jumps a second ordinate stands on the near side.
    jumps = np.flatnonzero(np.abs(after - before) > LEVEL * ordinate)
    near = hand.lay_off("before the jumps", axis[jumps], UP, before[jumps])
    which = np.arange(u.size)
    which[jumps] = u.size + np.arange(jumps.size)
    middles = hand.divide("middles of the parts", axis[left], axis[left + 1], 0.5)
    middle = hand.lay_off("middles", middles, UP, ordinates((u[left] + u[left + 1]) / 2, stations.parts))
    hand.read("greatest", between(axis[begins], tops, UP), 1.0, rounded=False)
    nearer = hand.take("before", plotted, near, which=which)
    for name, ends in (("stations", plotted), ("before", nearer)):
        hand.read(name, between(axis, ends, UP), 1.0, "mm of paper", rounded=False)
    hand.read("middles", between(middles, middle, UP), 1.0, rounded=False)
    hand.read("base", between(origin, turn), mu_phi.per_mm, rounded=False)
    givens = AccelerationGivens(motion, stations, ordinate, mu_phi, unit)
    return hand.finished(givens, _draw, {"axis": axis})


def _divided(hand: Hand, origin: Drawn, stations: Stations, mu_phi: Scale) -> Drawn:
    """The stations on the axis: the phases are laid off, and each of their stretches is divided into equal parts."""
    bounds = np.array([[stretch.start, stretch.stop - 1] for stretch in stations.stretches])
    places, at = np.unique(stations.phi[bounds], return_inverse=True)
    cuts = hand.lay_off("cuts", origin, RIGHT, places / mu_phi.per_mm)
    station = np.arange(stations.u.size)
    stretch = np.searchsorted(bounds[:, 0], station, side="right") - 1
    start, end = at.reshape(bounds.shape)[stretch].T
    share = (station - bounds[stretch, 0]) / (bounds[:, 1] - bounds[:, 0])[stretch]
    return hand.divide("axis", cuts[start], cuts[end], share)


def moving_phases(motion: Motion, stations: Stations) -> list[Moving]:
    """The rises and returns that the stations divide, in order."""
    phases = [motion.phases[k] for k in stations.phase[stations.last]]
    return [phase for phase in phases if isinstance(phase, Moving)]


def equal_parts(stations: Stations) -> Caption:
    """Which parts are equal to one another."""
    if stations.stretches == stations.pieces:
        return say("equal between jumps of the acceleration")
    return say("equal between jumps and corners of the acceleration")


def _shape(phase: Moving, u: Floats, side: Side = "right") -> Floats:
    """The given ordinates of a law as fractions of its greatest; a return begins downwards."""
    return phase.direction * phase.normalised(u, side=side)[2] / phase.normalised.peak_acceleration


def _draw(diagram: AccelerationDiagram) -> list[Step]:
    motion, stations = diagram.givens.motion, diagram.givens.stations
    phases, greatest = moving_phases(motion, stations), diagram.first("greatest")
    x = diagram.first("axis").real
    ends = [(x[span.start], x[span.stop - 1]) for span in stations.phases]
    curves = [_curve(diagram, k, *given) for k, given in enumerate(zip(phases, greatest, ends, strict=True))]
    chosen = next(k for k, phase in enumerate(phases) if phase.direction > 0)
    ordinates = say(
        "The greatest ordinate of the first rise is chosen, {ordinate:.1f} mm, in a scale that is not yet known. So "
        "that the displacement comes back to the axis, the others follow from y = y₁·(C·h/φ²)/(C₁·h₁/φ₁²): {greatest} "
        "mm."
    ).where(ordinate=greatest[chosen], greatest=sequence([say("{y:.1f}", y=y) for y in greatest]))
    dimensions = tuple(_ordinate(diagram, curve.shown, y) for curve, y in zip(curves, greatest, strict=True))
    moving = zip(stations.phase[stations.last].tolist(), phases, strict=True)
    laws = [say("{phase} {law}", phase=phase_title(motion, k), law=law_name(p.normalised)) for k, p in moving]
    plotted = say("In each moving phase the acceleration is plotted by its law: {laws}.", laws=sequence(laws))
    lines = tuple(curve.line(Role.RESULT) for curve in curves)
    return [
        _axis(diagram, np.concatenate([curve.shown.imag for curve in curves])),
        Step(say("Ordinates of the phases"), ordinates, ACCELERATION, dimensions, reads=("greatest",)),
        Step(say("Acceleration by the law"), plotted, ACCELERATION, lines),
        _middle_ordinates(diagram),
    ]


def _axis(diagram: AccelerationDiagram, heights: Floats) -> Step:
    """The axes, for ordinates of these ``heights`` [mm]."""
    motion, mu_phi = diagram.givens.motion, diagram.givens.mu_phi
    ends = phase_ends(motion, mu_phi)
    axes = (*phi_axes(motion, mu_phi, heights, "a"), diagram.acts["turn"].line_from(0j, Role.RESULT))
    told = sequence([say("{end:.1f}", end=end) for end in ends[1:]])
    said = say(
        "One revolution is laid off as {length:.1f} mm, so 1 mm is {degree:.4g}° and μᵩ = {mu:.5f} rad/mm. "
        "The phases end at {ends} mm."
    ).where(length=ends[-1], degree=np.degrees(mu_phi.per_mm), mu=mu_phi.per_mm, ends=told)
    return Step(say("Axis of the cam angle"), said, ACCELERATION, axes, ("base",), given=axes)


def _middle_ordinates(diagram: AccelerationDiagram) -> Step:
    """The ordinates between the stations."""
    stations, axis, middles = diagram.givens.stations, diagram.acts["axis"], diagram.acts["middles"]
    ordinates, x = diagram.first("middles"), axis.shown
    marks = (
        middles.from_(diagram.acts["middles of the parts"], Role.CONSTRUCTION),
        middles.dots(Role.CONSTRUCTION),
        Segments(x - UP, x + UP, Role.SCALE, of=axis.act),
        # On the side of the axis where no ordinates stand.
        *numbers(axis, stations, np.where(diagram.first("before") + diagram.first("stations") < 0, UP, -UP)),
    )
    parts, third = joined([f"{s.stop - s.start}" for s in stations.parts]), ordinates[min(2, ordinates.size - 1)]
    said = say(
        "The moving phases are divided into {parts} parts, {equal}, and the ordinate is erected at the middle of each "
        "part; the third of them measures {third:.1f} mm."
    ).where(parts=parts, equal=equal_parts(stations), third=third)
    return Step(say("Middle ordinates"), said, ACCELERATION, marks, ("middles",), given=marks)


def _curve(diagram: AccelerationDiagram, k: int, phase: Moving, greatest: float, ends: tuple[float, float]) -> Drawn:
    """The law over the k-th phase, from the axis and back to it, upright where the acceleration jumps."""
    hand, places, heights = showing(diagram), [np.zeros(1)], [np.zeros(1)]
    for first, last in pairwise((0.0, *phase.normalised.jumps, 1.0)):
        u = np.linspace(first, last, 97)
        places.append(u)
        heights += [greatest * _shape(phase, u[:-1]), greatest * _shape(phase, u[-1:], "left")]
    u = np.concatenate([*places, np.ones(1)])
    feet = hand.given("feet of the law", ends[0] + (ends[1] - ends[0]) * u)
    return hand.lay_off(f"law {k}", feet, UP, np.concatenate([*heights, np.zeros(1)]))


BESIDE = 6.0
"""The dimension of the greatest ordinate stands so far beyond the part of the curve that is on its side [mm]."""


def _ordinate(diagram: AccelerationDiagram, line: Points, greatest: float) -> Dimension:
    """The dimension of a phase's greatest ordinate, beyond where the curve crosses the axis: clear of the others."""
    height = np.sign(line.imag[np.argmax(np.abs(line.imag))]) * line.imag
    top = complex(line[np.flatnonzero(height >= (1 - LEVEL) * height.max())[-1]])
    crossing = float(line.real[np.flatnonzero(height > LEVEL * height.max())[-1]])
    by = crossing + min(BESIDE, (float(line.real[-1]) - crossing) / 2) - top.real
    # To the right of an ordinate that points up is on the negative side of its dimension.
    aside, of = -by if top.imag > 0 else by, diagram.readings["greatest"].act
    return Dimension(complex(top.real), top, say("{y:.1f}", y=greatest), aside, of)


LEVEL = 1e-6
"""Ordinates that differ by less than this part of the greatest are one."""
