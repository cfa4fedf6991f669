"""The acceleration diagram, drawn in a scale that is not yet known.

The greatest ordinate of the first rise is chosen.  The lift of a phase goes as y F^2/C, so for the displacement to come
back to the axis every other ordinate must be y = y1 (C h/F^2)/(C1 h1/F1^2).  Which acceleration a millimetre means is
known only after two integrations, when the known lift fixes the scale.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import numbers, phase_ends, phase_title, phi_axes
from graphcam.constructions.law_names import law_name
from graphcam.constructions.views import ACCELERATION
from graphcam.drafting.euclid import UP, divided
from graphcam.drafting.ink import Construction, Step, reading, say
from graphcam.drafting.marks import Dimension, Dots, Line, Points, Role, Segments
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

    motion, stations : the phases and how they are divided
    ordinate : greatest ordinate of the first rise [mm of paper]
    mu_phi : scale of the cam angle [rad/mm]
    unit : of the lift

    Readings, all in mm of paper: ``greatest`` ordinate of each moving phase, ordinates at the ``stations`` (``before``:
    on the near side of a jump) and at the ``middles`` of the parts, and the ``base``, the length of the axis.
    Points: the stations on the ``axis``.
    """
    phases = moving_phases(motion, stations)
    steepness = np.array([p.normalised.peak_acceleration * p.lift / p.angle**2 for p in phases])
    first_rise = next(k for k, phase in enumerate(phases) if phase.direction > 0)
    greatest = ordinate * steepness / steepness[first_rise]

    # On the paper the phases are laid off, and each of their stretches is divided into equal parts.
    axis = np.empty(stations.u.size)
    for stretch in stations.stretches:
        start, end = stations.phi[[stretch.start, stretch.stop - 1]] / mu_phi.per_mm + 0j
        axis[stretch] = divided(start, end, stretch.stop - stretch.start - 1).real
    u = stations.u
    middle = (u[stations.left] + u[stations.left + 1]) / 2

    def ordinates(u: Floats, spans: tuple[slice, ...], side: Side = "right") -> Floats:
        """The given ordinates of all phases, one phase after another."""
        return np.concatenate([y * _shape(p, u[s], side) for p, y, s in zip(phases, greatest, spans, strict=True)])

    lengths = {"greatest": greatest, "stations": ordinates(u, stations.phases)}
    lengths |= {"before": ordinates(u, stations.phases, "left"), "middles": ordinates(middle, stations.parts)}
    readings = {name: reading(pencil.sheets(length), 1.0, "mm of paper") for name, length in lengths.items()}
    readings["base"] = reading(pencil.sheets(FULL_TURN / mu_phi.per_mm), mu_phi.per_mm, "rad")
    givens = AccelerationGivens(motion, stations, ordinate, mu_phi, unit)
    points = {"axis": pencil.sheets(axis + 0j)}
    return Construction(MEANING, givens, pencil, readings, points, _draw)


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
    curves = [_curve(p, y, *between) for p, y, between in zip(phases, greatest, ends, strict=True)]
    chosen = next(k for k, phase in enumerate(phases) if phase.direction > 0)
    ordinates = say(
        "The greatest ordinate of the first rise is chosen, {ordinate:.1f} mm, in a scale that is not yet known. So "
        "that the displacement comes back to the axis, the others follow from y = y₁·(C·h/φ²)/(C₁·h₁/φ₁²): {greatest} "
        "mm."
    ).where(ordinate=greatest[chosen], greatest=sequence([say("{y:.1f}", y=y) for y in greatest]))
    dimensions = tuple(_ordinate(line, y) for line, y in zip(curves, greatest, strict=True))
    plotted = say("In each moving phase the acceleration is plotted by its law: {laws}.", laws=_laws(motion, stations))
    lines = tuple(Line(line, Role.RESULT) for line in curves)
    return [
        _axis(diagram, np.concatenate([line.imag for line in curves])),
        Step(say("Ordinates of the phases"), ordinates, ACCELERATION, dimensions, reads=("greatest",)),
        Step(say("Acceleration by the law"), plotted, ACCELERATION, lines),
        _middle_ordinates(diagram, x),
    ]


def _laws(motion: Motion, stations: Stations) -> Caption:
    """The moving phases with their laws."""
    phases = zip(stations.phase[stations.last].tolist(), moving_phases(motion, stations), strict=True)
    return sequence([say("{phase} {law}", phase=phase_title(motion, k), law=law_name(p.normalised)) for k, p in phases])


def _axis(diagram: AccelerationDiagram, heights: Floats) -> Step:
    """The axes, for ordinates of these ``heights`` [mm]."""
    motion, mu_phi = diagram.givens.motion, diagram.givens.mu_phi
    ends = phase_ends(motion, mu_phi)
    axes = (*phi_axes(motion, mu_phi, heights, "a"), Line(np.array([0, ends[-1]]) + 0j, Role.RESULT))
    told = sequence([say("{end:.1f}", end=end) for end in ends[1:]])
    said = say(
        "One revolution is laid off as {length:.1f} mm, so 1 mm is {degree:.4g}° and μᵩ = {mu:.5f} rad/mm. "
        "The phases end at {ends} mm."
    ).where(length=ends[-1], degree=np.degrees(mu_phi.per_mm), mu=mu_phi.per_mm, ends=told)
    return Step(say("Axis of the cam angle"), said, ACCELERATION, axes, ("base",), given=axes)


def _middle_ordinates(diagram: AccelerationDiagram, x: Floats) -> Step:
    """The ordinates between the stations, which stand at ``x`` [mm] on the axis."""
    stations = diagram.givens.stations
    middle_x, middle_y = (x[stations.left] + x[stations.left + 1]) / 2, diagram.first("middles")
    middles = (
        Segments(middle_x + 0j, middle_x + UP * middle_y, Role.CONSTRUCTION),
        Dots(middle_x + UP * middle_y, Role.CONSTRUCTION),
        Segments(x - UP, x + UP, Role.SCALE),
        # On the side of the axis where no ordinates stand.
        *numbers(x + 0j, stations, np.where(diagram.first("before") + diagram.first("stations") < 0, UP, -UP)),
    )
    parts, third = joined([f"{s.stop - s.start}" for s in stations.parts]), middle_y[min(2, middle_y.size - 1)]
    said = say(
        "The moving phases are divided into {parts} parts, {equal}, and the ordinate is erected at the middle of each "
        "part; the third of them measures {third:.1f} mm."
    ).where(parts=parts, equal=equal_parts(stations), third=third)
    return Step(say("Middle ordinates"), said, ACCELERATION, middles, ("middles",), given=middles)


def _curve(phase: Moving, greatest: float, start: float, end: float) -> Points:
    """The law over its phase on the paper, from the axis and back to it, upright where the acceleration jumps."""
    cuts = (0.0, *phase.normalised.jumps, 1.0)
    ordinates: list[Points] = []
    for first, last in pairwise(cuts):
        u = np.linspace(first, last, 97)
        height = phase.normalised(u)[2]
        height[-1] = phase.normalised(u[-1], side="left")[2]
        scaled = greatest * phase.direction * height / phase.normalised.peak_acceleration
        ordinates.append(start + (end - start) * u + UP * scaled)
    return np.concatenate([[start + 0j], *ordinates, [end + 0j]])


BESIDE = 6.0
"""The dimension of the greatest ordinate stands so far beyond the part of the curve that is on its side [mm]."""


def _ordinate(line: Points, greatest: float) -> Dimension:
    """The dimension of a phase's greatest ordinate, beyond where the curve crosses the axis: clear of the others."""
    height = np.sign(line.imag[np.argmax(np.abs(line.imag))]) * line.imag
    top = complex(line[np.flatnonzero(height >= (1 - LEVEL) * height.max())[-1]])
    crossing = float(line.real[np.flatnonzero(height > LEVEL * height.max())[-1]])
    by = crossing + min(BESIDE, (float(line.real[-1]) - crossing) / 2) - top.real
    # To the right of an ordinate that points up is on the negative side of its dimension.
    return Dimension(complex(top.real), top, say("{y:.1f}", y=greatest), aside=-by if top.imag > 0 else by)


LEVEL = 1e-6
"""Ordinates that differ by less than this part of the greatest are one."""
