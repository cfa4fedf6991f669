"""The least radius under a flat face: the displacement drawn over the acceleration.

The profile under a flat face perpendicular to its motion has the radius of curvature rho = r0 + s + a.  In a diagram of
s over a with equal scales, places of equal s + a lie on lines at 45 degrees; the lowest of them that touches the curve
meets the axis of s where the greatest of -(s + a) is read.  With unequal scales the tangent would lean by
arctan(mu_a/mu_s) in place of 45 degrees.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import OVERHANG, station_names
from graphcam.constructions.curvature import LEAST_CURVATURE
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import LEAST_RADIUS
from graphcam.constructions.views import COMBINED
from graphcam.drafting.curve import at_greatest, faired, farthest
from graphcam.drafting.euclid import RIGHT, UP, meet
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import AngleMark, Arrow, Dimension, Dots, Label, Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.given.motion import Dwell
from graphcam.plane import dot

DOWN_LEFT = -RIGHT - UP
"""Square to the lines of equal s + a, towards smaller ones."""


@dataclass(frozen=True, eq=False)
class FlatLeastRadiusGivens:
    """The diagrams, and the least permitted radius of curvature of the profile [mm]."""

    integrated: Integrated
    least_curvature: float


FlatRegion = Construction[FlatLeastRadiusGivens]


@dataclass(frozen=True, eq=False)
class FlatCurvatureGivens:
    """The diagram of s over a, and the adopted prime radius [mm]."""

    region: FlatRegion
    prime_radius: float


FlatCurved = Construction[FlatCurvatureGivens]


LEAST_RADIUS_MEANING = Meaning(
    "minimum_radius",
    say("Least prime radius"),
    say(
        "Under a flat face the profile has the radius of curvature ρ = r₀ + s + a, and no pressure angle limits it. "
        "Drawn over the acceleration, the displacement shows where s + a is least: a tangent at 45° touches it there."
    ),
    {"prime_radius": LEAST_RADIUS, "need": ReadingMeaning(say("greatest −(s + a)"), "−(s + a)", "mm")},
)
CURVATURE_MEANING = Meaning(
    "curvature",
    say("Least radius of curvature"),
    say(
        "The prime radius is adopted, and s + a is drawn already: their sum is the radius of curvature of the profile. "
        "The least of it tells how sharp the cam is."
    ),
    LEAST_CURVATURE,
)


def flat_least_radius(integrated: Integrated, least_curvature: float, pencil: Pencil) -> FlatRegion:
    """Find the least prime radius at which the profile is nowhere sharper than permitted.

    integrated : from :func:`~graphcam.constructions.integration.integration`
    least_curvature : the least permitted radius of curvature of the profile [mm]

    Readings: ``prime_radius`` and the greatest ``need`` = -(s + a) [mm].
    """
    hand = pencil.hand("minimum_radius")
    s, a, before = (integrated.readings[name] for name in ("s", "a", "a_before"))
    stations = integrated.givens.stations
    mu, count = np.asarray(s.scale), stations.u.size
    height = s.paper + hand.line(count)
    errors = hand.dividers(count)
    # Equal scales: the accelerations are laid off in the scale of s.  At a jump the curve has two ends.
    curve = a.value / mu[..., None] + errors + UP * height
    ends = before.value / mu[..., None] + errors + UP * height
    pieces = [
        np.append(curve[..., p.start : p.stop - 1], ends[..., p.stop - 1 : p.stop], -1) for p in stations.stretches
    ]
    # Where the follower rests there is no acceleration: a point of the axis of s.
    rests = UP * height[..., _rests(integrated)]
    tops = np.concatenate([np.stack([farthest(piece, DOWN_LEFT) for piece in pieces], axis=-1), rests], axis=-1)
    touch = at_greatest(tops, dot(DOWN_LEFT, tops))
    zero = meet(touch, np.asarray(RIGHT - UP), np.asarray(0j), np.asarray(UP))
    # Where s + a is never negative any radius will do that the permitted curvature itself needs.
    prime_radius = np.maximum(least_curvature / mu - zero.imag, 0.0)
    return Construction(
        LEAST_RADIUS_MEANING,
        FlatLeastRadiusGivens(integrated, least_curvature),
        pencil,
        hand.readings(mu, "mm", prime_radius=prime_radius, need=0.0 - zero.imag),
        {"curve": np.concatenate(pieces, axis=-1), "rests": rests, "touch": touch, "zero": zero},
        _draw,
    )


def _rests(integrated: Integrated) -> NDArray[np.intp]:
    """The last stations of the moving phases that a dwell follows."""
    motion, last = integrated.givens.motion, integrated.givens.stations.last
    following = (integrated.givens.stations.phase[last] + 1) % len(motion.phases)
    return last[[isinstance(motion.phases[k], Dwell) for k in following]]


def flat_curvature(region: FlatRegion, prime_radius: float, pencil: Pencil) -> FlatCurved:
    """Read the least radius of curvature of the profile off the same diagram, at the adopted prime radius [mm].

    region : from :func:`flat_least_radius`

    Readings: ``rho`` [mm], negative where the profile under the face would have to turn inside out, and its only
    candidate.
    """
    hand, need = pencil.hand("curvature"), region.readings["need"]
    rho = prime_radius / np.asarray(need.scale) - need.paper
    return Construction(
        CURVATURE_MEANING,
        FlatCurvatureGivens(region, prime_radius),
        pencil,
        hand.readings(need.scale, "mm", rho=rho, rho_candidates=rho[..., None]),
        {"zero": region.points["zero"]},
        _draw_curvature,
    )


def _draw_curvature(curved: FlatCurved) -> list[Step]:
    zero, rho = complex(curved.first("zero")), float(curved.value("rho"))
    centre = zero - float(curved.first("rho")) * UP
    said = say(
        "From the adopted cam centre, r₀ = {r0:g} mm below the start of the lift, up to where the tangent meets the "
        "axis is the least radius of curvature of the profile, {rho:.3f} mm."
    ).where(r0=curved.givens.prime_radius, rho=rho)
    radius = Dimension(centre, zero, say("ρ = {rho:.2f}", rho=rho), aside=-14.0)
    marks = (Dots(np.array([centre]), Role.RESULT), radius)
    return [Step(say("The least radius of curvature"), said, COMBINED, marks, reads=("rho",))]


def _draw(region: FlatRegion) -> list[Step]:
    curve = region.first("curve")
    touch, zero = complex(region.first("touch")), complex(region.first("zero"))
    r0, need = float(region.first("prime_radius")), float(region.first("need"))
    mu, centre = region.readings["need"].per_mm, -r0 * UP
    axes = _axes(curve, min(-r0, zero.imag) - OVERHANG)
    laid_off = say(
        "At every displacement the acceleration is laid off in the scale of s, to the right where it is positive; the "
        "longest measures {longest:.1f} mm. The ends are joined by smooth curves between jumps and corners of the "
        "acceleration; a dwell is a point of the axis."
    ).where(longest=float(np.abs(curve.real).max()))
    touching = say(
        "Where s + a is least the tangent at 45° touches the curve; it meets the axis of s at {meets:.2f} mm, so the "
        "greatest of −(s + a) is {need:.3f} mm. With unequal scales it would have to lean by arctan(μₐ/μₛ)."
    ).where(meets=zero.imag, need=need * mu)
    tangent = (
        Line(np.array([touch + 12 * (UP - RIGHT), zero + 16 * (RIGHT - UP)]), Role.LIMIT),
        Dots(np.array([touch, zero]), Role.LIMIT),
        AngleMark(zero, 12.0, -np.pi / 2, -np.pi / 4, "45°"),
    )
    found = say(
        "With the least permitted radius of curvature ρ = {least:g} mm, r₀ = ρ + {need:.3f} = {r0:.3f} mm; it is laid "
        "off below the start of the lift to the cam centre A."
    ).where(least=region.givens.least_curvature, need=need * mu, r0=r0 * mu)
    radius = (
        *(Dots(np.array([centre]), Role.RESULT), Label(centre, "A", towards=1 - 1j)),
        Dimension(0j, centre, say("r₀ = {r0:.2f}", r0=r0 * mu), aside=-10.0),
    )
    return [
        Step(say("Displacement over acceleration"), laid_off, COMBINED, (*axes, *_curve(region)), given=axes),
        Step(say("The tangent at 45 degrees"), touching, COMBINED, tangent, reads=("need",)),
        Step(say("The least prime radius"), found, COMBINED, radius, reads=("prime_radius",)),
    ]


def _axes(curve: Points, below: float) -> tuple[Mark, ...]:
    """The axes of s and a, that of s from ``below`` [mm]."""
    top, right = float(curve.imag.max()) + OVERHANG, float(curve.real.max()) + OVERHANG
    return (
        Arrow(below * UP, top * UP, Role.SCALE),
        Arrow(curve.real.min() + 0j, right + 0j, Role.SCALE),
        Label(top * UP, "s", towards=-1 + 0j),
        Label(right + 0j, "a", towards=-1j),
    )


def _curve(region: FlatRegion) -> tuple[Mark, ...]:
    """The accelerations, and the smooth curves through their ends, each with the name of its first station."""
    stations, curve = region.givens.integrated.givens.stations, region.first("curve")
    ends = np.cumsum([stretch.stop - stretch.start for stretch in stations.stretches])
    pieces = np.split(curve, ends[:-1])
    names = [station_names(stations)[stretch.start] for stretch in stations.stretches]
    begins = [complex(piece[0]) for piece in pieces]
    return (
        Segments(UP * curve.imag, curve, Role.CONSTRUCTION),
        *(Line(faired(piece), Role.RESULT) for piece in pieces),
        Dots(region.first("rests"), Role.RESULT),
        *(Label(at, k, towards=np.sign(at.real) + 0j, small=True) for at, k in zip(begins, names, strict=True)),
    )
