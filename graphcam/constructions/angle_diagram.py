"""The diagram of the pressure angle over the cam angle, from which the greatest angles are read."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import degree_ticks, phase_angle, phase_ends, phi_axes, pieces_of
from graphcam.constructions.pressure_angle import MeasuredAngles
from graphcam.constructions.views import ANGLE
from graphcam.drafting.curve import at_greatest, faired, highest_and_lowest
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Dimension, Dots, Label, Line, Role
from graphcam.drafting.meaning import Compared, Converges, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale


@dataclass(frozen=True, eq=False)
class AngleDiagramGivens:
    """The measured angles, and the scale in which they are plotted [rad/mm]."""

    measured: MeasuredAngles
    mu_alpha: Scale


MEANING = Meaning(
    "angle_diagram",
    say("Greatest pressure angles"),
    say("The angles of all stations over the cam angle; the greatest lie between stations, on the curve."),
    {
        "max_rise": ReadingMeaning(
            say("greatest α on the rise"),
            "max α",
            "rad",
            (Compared("max_pressure_angle_rise_deg", say("pressure angle, rise"), "rise_candidates", np.abs),),
            Converges("greatest angle, rise", "max_pressure_angle_rise"),
        ),
        "max_return": ReadingMeaning(
            say("greatest α on the return"),
            "max α",
            "rad",
            (Compared("max_pressure_angle_return_deg", say("pressure angle, return"), "return_candidates", np.abs),),
        ),
    },
    "report.paragraphs.greatest_angles",
)


def angle_diagram(measured: MeasuredAngles, mu_alpha: Scale, pencil: Pencil) -> Construction[AngleDiagramGivens]:
    """Plot the pressure angles over the cam angle, fair the curve between breaks, and read off the greatest.

    measured : the follower's pressure angles, with a reading ``alpha``
    mu_alpha : scale of the pressure angle [rad/mm]

    Readings: ``max_rise`` and ``max_return``, the signed angles of greatest magnitude [mm times mu_alpha, rad]; the
    ``rise_candidates`` and ``return_candidates`` (..., 2) they were chosen from, highest and lowest.
    """
    hand = pencil.hand("angle_diagram")
    integrated = measured.givens.integrated
    motion, stations = integrated.givens.motion, integrated.givens.stations
    height = measured.readings["alpha"].paper / mu_alpha.per_mm + hand.line(stations.u.size)
    curve = integrated.points["s_curve"].real + UP * height
    rises, returns = (highest_and_lowest(curve, pieces_of(motion, stations, direction)) for direction in (1, -1))
    # Of both ends the one farther from the axis.
    rise, return_ = (at_greatest(places, np.abs(places.imag)) for places in (rises, returns))
    candidates = {"rise_candidates": rises.imag, "return_candidates": returns.imag}
    return Construction(
        MEANING,
        AngleDiagramGivens(measured, mu_alpha),
        pencil,
        hand.readings(mu_alpha.per_mm, "rad", max_rise=rise.imag, max_return=return_.imag, **candidates),
        {"curve": curve, "max_rise": rise, "max_return": return_},
        _draw,
    )


def _draw(plotted: Construction[AngleDiagramGivens]) -> list[Step]:
    measured = plotted.givens.measured
    integrated = measured.givens.integrated
    motion, stations, mu_phi = integrated.givens.motion, integrated.givens.stations, integrated.givens.mu_phi
    curve, ends = plotted.first("curve"), phase_ends(motion, mu_phi)
    tops = [complex(plotted.first(name)) for name in ("max_rise", "max_return")]
    greatest = [np.degrees(plotted.value(name)) for name in ("max_rise", "max_return")]
    low = min(0.0, float(np.nanmin(curve.imag))) - 24.0
    rests = np.concatenate([[curve[-1].imag], curve.imag[stations.last]])
    starts = np.concatenate([[0.0], ends[stations.phase[stations.last] + 1]])
    stops = np.concatenate([ends[stations.phase[[span.start for span in stations.phases]]], [ends[-1]]])
    held = zip(np.stack([starts, stops], axis=-1), rests, strict=True)
    axes = (
        *phi_axes(motion, mu_phi, curve.imag, "α"),
        *degree_ticks(mu_phi),
        *(Dimension(a + UP * low, b + UP * low, phase_angle(motion, k)) for k, (a, b) in enumerate(pairwise(ends))),
    )
    curves = (
        *axes,
        Dots(curve, Role.CONSTRUCTION),
        *(Line(faired(curve[piece]), Role.RESULT) for piece in stations.pieces),
        *(Line(between + UP * level, Role.RESULT) for between, level in held),
    )
    said = say(
        "The angles are plotted at {scale:.4g}° a millimetre and the curve is faired between the jumps of the "
        "acceleration; in the dwells the angle stays."
    ).where(scale=np.degrees(plotted.givens.mu_alpha.per_mm))
    found = say(
        "The greatest angles are read off the faired curve: {rise:.2f} mm on the rise, which stands for {rise_deg:.2f}"
        "°, and {back:.2f} mm on the return, {back_deg:.2f}°."
    ).where(rise=tops[0].imag, rise_deg=greatest[0], back=tops[1].imag, back_deg=greatest[1])
    told = [
        Label(top, say("{alpha:.1f}°", alpha=alpha), towards=np.sign(top.imag) * UP)
        for top, alpha in zip(tops, greatest, strict=True)
    ]
    reads = ("max_rise", "max_return")
    return [
        Step(say("The pressure angle over the cam angle"), said, ANGLE, curves, given=axes),
        Step(say("The greatest pressure angles"), found, ANGLE, (Dots(np.array(tops), Role.LIMIT), *told), reads),
    ]
