"""The diagram of the pressure angle over the cam angle, from which the greatest angles are read."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import degree_ticks, phase_angle, phase_ends, phi_axes
from graphcam.constructions.views import ANGLE
from graphcam.drafting.curve import faired, farthest_of
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Construction, Step, reading, say
from graphcam.drafting.marks import Dimension, Dots, Label, Line, Points, Role
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale


def angle_diagram(measured: Construction, mu_alpha: Scale, pencil: Pencil) -> Construction:
    """Plot the pressure angles over the cam angle, fair the curve between breaks, and read off the greatest.

    measured : the follower's pressure angles, with a reading ``alpha``
    mu_alpha : scale of the pressure angle [rad/mm]

    Readings: ``max_rise`` and ``max_return``, the signed angles of greatest magnitude [mm times mu_alpha, rad]; the
    ``rise_candidates`` and ``return_candidates`` (..., 2) they were chosen from, highest and lowest.
    """
    hand = pencil.hand("angle_diagram")
    integrated = measured.givens["integrated"]
    motion, stations = integrated.givens["motion"], integrated.givens["stations"]
    height = measured.readings["alpha"].paper / mu_alpha.per_mm + hand.line(stations.u.size)
    curve = integrated.points["s_curve"].real + UP * height

    def tops(direction: int) -> Points:
        """The highest and the lowest place of the curve."""
        pieces = [p for p in stations.pieces if motion.phases[stations.phase[p.start]].direction == direction]
        return np.stack([farthest_of(curve, pieces, side * UP) for side in (1, -1)], axis=-1)

    def greatest(places: Points) -> Points:
        """The place farthest from the axis, on either side."""
        best = np.argmax(np.abs(places.imag), axis=-1)[..., None]
        return np.take_along_axis(places, best, -1)[..., 0]

    rises, returns = tops(1), tops(-1)
    rise, return_ = greatest(rises), greatest(returns)
    return Construction(
        "angle_diagram",
        {"measured": measured, "mu_alpha": mu_alpha, "pencil": pencil},
        {
            "max_rise": reading(hand.read(rise.imag), mu_alpha.per_mm, "rad"),
            "max_return": reading(hand.read(return_.imag), mu_alpha.per_mm, "rad"),
            "rise_candidates": reading(hand.read(rises.imag), mu_alpha.per_mm, "rad"),
            "return_candidates": reading(hand.read(returns.imag), mu_alpha.per_mm, "rad"),
        },
        {"curve": curve, "max_rise": rise, "max_return": return_},
        _draw,
    )


def _draw(plotted: Construction) -> list[Step]:
    measured = plotted.givens["measured"]
    integrated = measured.givens["integrated"]
    motion, stations, mu_phi = (integrated.givens[name] for name in ("motion", "stations", "mu_phi"))
    curve, ends = plotted.first("curve"), phase_ends(motion, mu_phi)
    tops = [complex(plotted.first(name)) for name in ("max_rise", "max_return")]
    greatest = [np.degrees(plotted.value(name)) for name in ("max_rise", "max_return")]
    low = min(0.0, float(np.nanmin(curve.imag))) - 24.0
    rests = np.concatenate([[curve[-1].imag], curve.imag[stations.last]])
    starts = np.concatenate([[0.0], ends[stations.phase[stations.last] + 1]])
    stops = np.concatenate([ends[stations.phase[[span.start for span in stations.phases]]], [ends[-1]]])
    axes = (
        *phi_axes(motion, mu_phi, curve.imag, "α"),
        *degree_ticks(mu_phi),
        *(Dimension(a + UP * low, b + UP * low, phase_angle(motion, k)) for k, (a, b) in enumerate(pairwise(ends))),
    )
    return [
        Step(
            say("The pressure angle over the cam angle"),
            say(
                "The angles are plotted at {scale:.4g}° a millimetre and the curve is faired between the jumps of "
                "the acceleration; in the dwells the angle stays.",
                scale=np.degrees(plotted.givens["mu_alpha"].per_mm),
            ),
            ANGLE,
            (
                *axes,
                Dots(curve, Role.CONSTRUCTION),
                *(Line(faired(curve[piece]), Role.RESULT) for piece in stations.pieces),
                *(
                    Line(np.array([a, b]) + UP * level, Role.RESULT)
                    for a, b, level in zip(starts, stops, rests, strict=True)
                ),
            ),
            given=axes,
        ),
        Step(
            say("The greatest pressure angles"),
            say(
                "The greatest angles are read off the faired curve: {rise:.2f} mm on the rise, which stands for "
                "{rise_deg:.2f}°, and {back:.2f} mm on the return, {back_deg:.2f}°.",
                rise=tops[0].imag, rise_deg=greatest[0],
                back=tops[1].imag, back_deg=greatest[1],
            ),
            ANGLE,
            (
                Dots(np.array(tops), Role.LIMIT),
                *(
                    Label(top, say("{alpha:.1f}°", alpha=alpha), towards=np.sign(top.imag) * UP)
                    for top, alpha in zip(tops, greatest, strict=True)
                ),
            ),
            reads=("max_rise", "max_return"),
        ),
    ]  # fmt: skip
