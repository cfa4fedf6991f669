"""Lift, velocity, acceleration and pressure angle of a roller on a cam of arcs, over the cam angle."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphcam.constructions.arc_roller import ArcStations, RollerOnArcs
from graphcam.constructions.axes import axes_over_phi, degree_ticks
from graphcam.constructions.views import ACCELERATION, ANGLE, DISPLACEMENT, VELOCITY
from graphcam.drafting.curve import at_greatest, faired, highest_and_lowest
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Construction, Reading, Step, View, reading, say
from graphcam.drafting.marks import Dimension, Dots, Label, Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, standard_scale
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN

VIEWS: Mapping[str, View] = {"a": ACCELERATION, "v": VELOCITY, "s": DISPLACEMENT, "alpha": ANGLE}
"""From the top down."""
SYMBOLS = {"a": "a", "v": "v", "s": "s", "alpha": "α"}
MIRROR = {"a": 1, "v": -1, "s": 1, "alpha": -1}
"""What becomes of a quantity on the mirrored flank, which is run over backwards."""
HEIGHTS = {"a": 100.0, "v": 80.0, "s": 60.0}
"""Each diagram takes the largest standard scale at which it is not higher [mm of paper]."""


@dataclass(frozen=True, eq=False)
class ArcDiagramsGivens:
    """What lies on the board; see :func:`arc_diagrams`."""

    rolled: RollerOnArcs
    mu_phi: Scale
    heights: Mapping[str, float]


MEANING = Meaning(
    "arc_diagrams",
    say("Motion of the follower"),
    say("What was read at the stations, over the cam angle. Where the arcs change, the acceleration jumps."),
    {
        "lift": ReadingMeaning(say("lift h"), "h", "mm"),
        "max_v": ReadingMeaning(
            say("greatest v"), "max v", "mm/rad", (Compared("max_v", candidates="v_candidates", rank=np.abs),)
        ),
        "max_a": ReadingMeaning(
            say("greatest a"), "max a", "mm/rad²", (Compared("max_a", candidates="a_candidates", rank=np.abs),)
        ),
        "max_alpha": ReadingMeaning(
            say("greatest α"),
            "max α",
            "rad",
            (
                Compared("max_pressure_angle_rise_deg", say("greatest α, rise"), "alpha_candidates", np.abs),
                Compared(
                    "max_pressure_angle_return_deg", say("greatest α, return"), "alpha_candidates", np.abs, sign=-1
                ),
            ),
        ),
    },
)


def arc_diagrams(
    rolled: RollerOnArcs, mu_phi: Scale, pencil: Pencil, heights: Mapping[str, float] = HEIGHTS
) -> Construction[ArcDiagramsGivens]:
    """Carry what was found at the stations over to diagrams, fair the curves arc by arc, and read their tops.

    rolled : from :func:`~graphcam.constructions.arc_roller.arc_roller`
    mu_phi : scale of the cam angle, and of the pressure angle [rad/mm]
    heights : that the diagrams of a, v and s should keep to [mm of paper]

    Readings: the ``lift``; ``max_v``, ``max_a`` and ``max_alpha``, the greatest magnitudes; ``v_candidates``,
    ``a_candidates`` and ``alpha_candidates`` (..., 2), highest and lowest, which they were chosen from.
    Points: the plotted ``a``, ``v``, ``s`` and ``alpha`` of the rise, and ``a_tops`` ..., highest and lowest.
    """
    hand, stations = pencil.hand("arc_diagrams"), rolled.givens.stations
    x = rolled.readings["phi"].paper / mu_phi.per_mm
    points: dict[str, Points] = {}
    readings: dict[str, Reading] = {}
    for name in VIEWS:
        source = rolled.readings[name]
        scale = mu_phi.per_mm if name == "alpha" else _scale(rolled, name, heights[name]).per_mm
        points[name] = x + UP * (source.value / scale + hand.line(stations.u.size))
        if name == "s":
            readings["lift"] = reading(hand.read(points[name].imag[..., -1]), scale, source.unit)
            continue
        tops = highest_and_lowest(points[name], stations.spans)
        greatest = hand.read(np.abs(tops.imag))
        points[f"{name}_tops"] = tops
        readings[f"max_{name}"] = reading(np.max(greatest, axis=-1), scale, source.unit)
        readings[f"{name}_candidates"] = reading(greatest, scale, source.unit)
    givens = ArcDiagramsGivens(rolled, mu_phi, heights)
    return Construction(MEANING, givens, pencil, readings, points, _draw)


def _scale(rolled: RollerOnArcs, name: str, height: float) -> Scale:
    """The scale of a diagram that should not be higher, by what is read in the first sample."""
    values: Floats = np.nan_to_num(rolled.value(name))
    low, high = min(0.0, float(values.min())), max(0.0, float(values.max()))
    # On the return the velocity goes as far down as it went up.
    return standard_scale((2 * high if name == "v" else high - low) or 1.0, height)


# --- the steps -------------------------------------------------------------------------------------------------------


TITLES = {
    "a": say("Acceleration over the cam angle"),
    "v": say("Velocity over the cam angle"),
    "s": say("Displacement over the cam angle"),
    "alpha": say("Pressure angle over the cam angle"),
}
SPANS = (
    *(say("rise {angle:.2f}°"), say("dwell {angle:.2f}°")),
    *(say("return {angle:.2f}°"), say("rest {angle:.2f}°")),
)
"""The phases and their angles."""
CARRIED = {
    "a": say(
        "Plotted over the cam angle, {degree:.4g}° a millimetre, are the accelerations OM, laid off at {mu:g} "
        "(mm/rad²)/mm; they jump where one arc takes over from another. The greatest measures {paper:.2f} mm, which is "
        "{value:.3f} mm/rad². The curve is faired arc by arc, and the return is the mirror image."
    ),
    "v": say(
        "Plotted over the cam angle, {degree:.4g}° a millimetre, are the velocities OK, laid off at {mu:g} "
        "(mm/rad)/mm. The greatest measures {paper:.2f} mm, which is {value:.3f} mm/rad. The curve is faired arc by "
        "arc, and the return is the mirror image."
    ),
    "s": say(
        "Plotted over the cam angle, {degree:.4g}° a millimetre, are the displacements, laid off at {mu:g} mm/mm, up "
        "to the lift of {lift:.3f} mm. The curve is faired arc by arc, and the return is the mirror image."
    ),
    "alpha": say(
        "Plotted over the cam angle, {degree:.4g}° a millimetre, are the angles between the line of centres and the "
        "ray, laid off at {mu:g}° a millimetre. The greatest is {value:.3f}°. The curve is faired arc by arc, and the "
        "return is the mirror image."
    ),
}


def _draw(plotted: Construction[ArcDiagramsGivens]) -> list[Step]:
    rolled, mu_phi = plotted.givens.rolled, plotted.givens.mu_phi
    if np.isnan(rolled.first("phi")).any():
        said = say("Without a path of the roller there is nothing to plot.")
        return [Step(say("No diagrams"), said, DISPLACEMENT, ())]
    edges = _edges(rolled, mu_phi)
    return [_diagram(plotted, name, edges) for name in VIEWS]


def _edges(rolled: RollerOnArcs, mu_phi: Scale) -> Floats:
    """Where the arcs, the dwell and the turn begin and end, on the paper."""
    rise: Floats = rolled.first("edges")
    down = 2 * rise[-1] + rolled.givens.arcs.givens.dwell - rise[::-1]
    return np.concatenate([rise, down, [FULL_TURN]]) / mu_phi.per_mm


def _diagram(plotted: Construction[ArcDiagramsGivens], name: str, edges: Floats) -> Step:
    rolled, mu_phi = plotted.givens.rolled, plotted.givens.mu_phi
    curve = plotted.first(name)
    held = float(curve[-1].imag) if name == "s" else 0.0
    line = _whole_turn(curve, rolled.givens.stations, edges, MIRROR[name], held)
    low, high = float(np.nanmin(line.imag)), float(np.nanmax(line.imag))
    heights = plotted.givens.heights
    mu = np.degrees(mu_phi.per_mm) if name == "alpha" else _scale(rolled, name, heights[name]).per_mm
    axes = axes_over_phi(edges[-1], line.imag, SYMBOLS[name])
    if name == "alpha":
        axes += degree_ticks(mu_phi)
    marks: list[Mark] = [
        *axes,
        Segments(edges[1:] + low * UP, edges[1:] + high * UP, Role.CONSTRUCTION),
        Dots(curve, Role.CONSTRUCTION),
        Line(line, Role.RESULT),
    ]
    if name == "alpha":
        marks += _phases(edges, mu_phi, low - 24.0)
    values = {"degree": np.degrees(mu_phi.per_mm), "mu": mu, "lift": float(rolled.value("lift"))}
    if name != "s":
        tops = plotted.first(f"{name}_tops")
        top = complex(at_greatest(tops, np.abs(tops.imag)))
        paper = float(plotted.first(f"max_{name}"))
        values |= {"paper": paper, "value": paper * mu}
        marks += [
            Dots(np.array([top]), Role.LIMIT),
            Label(top, say("{value:.2f}", value=np.sign(top.imag) * paper * mu), towards=np.sign(top.imag) * UP),
        ]
    reads = ("lift",) if name == "s" else (f"max_{name}",)
    return Step(TITLES[name], CARRIED[name].where(**values), VIEWS[name], tuple(marks), reads, axes)


def _whole_turn(curve: Points, stations: ArcStations, edges: Floats, mirror: int, held: float) -> Points:
    """The curve over the turn: the faired rise, the dwell at the height ``held``, the rise mirrored, the rest."""
    pieces = [faired(curve[span][~np.isnan(curve[span])]) for span in stations.spans]
    rise = np.concatenate([np.array([0j]), *pieces])
    back = edges[3] + edges[4] - rise[::-1].real + UP * mirror * rise[::-1].imag
    return np.concatenate([rise, edges[3:5] + UP * held, back, edges[-2:] + 0j])


def _phases(edges: Floats, mu_phi: Scale, height: float) -> list[Mark]:
    """The angles of rise, dwell and return."""
    ends = edges[[0, 3, 4, 7, 8]] + UP * height
    angles = np.degrees(np.diff(ends.real) * mu_phi.per_mm)
    spans = zip(pairwise(ends), SPANS, angles, strict=True)
    return [Dimension(a, b, said.where(angle=angle)) for (a, b), said, angle in spans if angle > 0]
