"""The least radius under a flat face: the displacement drawn over the acceleration.

The profile under a flat face perpendicular to its motion has the radius of curvature rho = r0 + s + a.  In a diagram of
s over a with equal scales, places of equal s + a lie on lines at 45 degrees; the lowest of them that touches the curve
meets the axis of s where the greatest of -(s + a) is read.  With unequal scales the tangent would lean by
arctan(mu_a/mu_s) in place of 45 degrees.
"""

from dataclasses import dataclass, replace
from itertools import pairwise
from operator import itemgetter

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import OVERHANG, station_names
from graphcam.constructions.curvature import LEAST_CURVATURE
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import LEAST_RADIUS
from graphcam.constructions.views import COMBINED
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, between, reckoned, showing
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import AngleMark, Arrow, Dimension, Dots, Label, Line, Mark, Points, Role
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.given.laws import Floats
from graphcam.given.motion import Dwell

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
    # It may be negative here, and has no rival.
    {
        "rho": replace(
            LEAST_CURVATURE["rho"], compared=(Compared("min_pitch_curvature_radius", say("least curvature radius ρ")),)
        )
    },
)


def flat_least_radius(integrated: Integrated, least_curvature: float, pencil: Pencil) -> FlatRegion:
    """Find the least prime radius at which the profile is nowhere sharper than permitted.

    least_curvature : the least permitted radius of curvature of the profile [mm]
    """
    hand, stations = Hand(pencil, LEAST_RADIUS_MEANING), integrated.givens.stations
    s, a, before = (integrated.readings[name] for name in ("s", "a", "a_before"))
    origin, axis, count = hand.given("origin"), hand.given("axis of s", along=UP), stations.u.size
    heights = hand.project("displacements", hand.carry(s), axis)
    # Equal scales: the accelerations are laid off in the scale of s.  At a jump the curve has two ends.
    equal = np.asarray(a.scale) / np.asarray(s.scale)
    after = hand.lay_off("accelerations", heights, RIGHT, hand.carry(a, equal))
    jumps = np.flatnonzero((a.paper != before.paper).reshape(-1, count).any(axis=0))
    nearer = reckoned(itemgetter((..., jumps)), hand.carry(before, equal))
    near = hand.lay_off("before the jumps", heights[jumps], RIGHT, nearer)
    ends = np.arange(count)
    ends[jumps] = count + np.arange(jumps.size)
    order = [np.append(np.arange(p.start, p.stop - 1), ends[p.stop - 1]) for p in stations.stretches]
    curve = hand.take("curve", after, near, which=np.concatenate(order))
    # Where the follower rests there is no acceleration: a point of the axis of s.
    rests = hand.take("rests", heights, which=_rests(integrated))
    tangent = hand.tangent("touch", hand.take("curve and rests", curve, rests), _smooth(integrated), DOWN_LEFT)
    zero = hand.cross("zero", tangent, axis)
    need = between(zero, origin, UP)
    radius = reckoned(_enough, hand.at_scale(least_curvature, s), need)
    hand.lay_off("A", origin, -UP, hand.carry(hand.read("prime_radius", radius, s.scale)))
    hand.read("need", need, s.scale)
    givens = FlatLeastRadiusGivens(integrated, least_curvature)
    return hand.finished(givens, _draw, {"curve": curve, "rests": rests, "touch": tangent, "zero": zero})


def _enough(least: Floats, need: Floats) -> Floats:
    """The radius; where s + a is never negative any will do that the permitted curvature itself needs."""
    return np.maximum(least + need, 0.0)


def _smooth(integrated: Integrated) -> list[slice]:
    """The pieces of the curve that are faired, and then the rests, each for itself."""
    ends = np.cumsum([stretch.stop - stretch.start for stretch in integrated.givens.stations.stretches]).tolist()
    ends += [ends[-1] + k + 1 for k in range(_rests(integrated).size)]
    return [slice(start, end) for start, end in pairwise([0, *ends])]


def _rests(integrated: Integrated) -> NDArray[np.intp]:
    """The last stations of the moving phases that a dwell follows."""
    motion, last = integrated.givens.motion, integrated.givens.stations.last
    following = (integrated.givens.stations.phase[last] + 1) % len(motion.phases)
    return last[[isinstance(motion.phases[k], Dwell) for k in following]]


def flat_curvature(region: FlatRegion, prime_radius: float, pencil: Pencil) -> FlatCurved:
    """Read the least radius of curvature of the profile off the same diagram, at the adopted prime radius [mm].

    It is negative where the profile under the face would have to turn inside out, and its own only candidate.
    """
    hand, need = Hand(pencil, CURVATURE_MEANING), region.readings["need"]
    origin, zero = hand.given("origin"), hand.found(region, "zero")
    centre = hand.lay_off("A", origin, -UP, hand.at_scale(prime_radius, need))
    rho = reckoned(np.subtract, between(centre, origin, UP), hand.carry(need))
    hand.read("rho", rho, need.scale)
    hand.read("rho_candidates", reckoned(itemgetter((..., None)), rho), need.scale, "mm")
    return hand.finished(FlatCurvatureGivens(region, prime_radius), _draw_curvature, {"zero": zero})


def _draw_curvature(curved: FlatCurved) -> list[Step]:
    centre, rho = curved.acts["A"], float(curved.value("rho"))
    said = say(
        "From the adopted cam centre, r₀ = {r0:g} mm below the start of the lift, up to where the tangent meets the "
        "axis is the least radius of curvature of the profile, {rho:.3f} mm."
    ).where(r0=curved.givens.prime_radius, rho=rho)
    zero, named = complex(curved.first("zero")), say("ρ = {rho:.2f}", rho=rho)
    marks = (centre.dots(Role.RESULT), Dimension(centre.place, zero, named, -14.0, curved.readings["rho"].act))
    return [Step(say("The least radius of curvature"), said, COMBINED, marks, reads=("rho",))]


def _draw(region: FlatRegion) -> list[Step]:
    curve, line, centre = region.first("curve"), region.acts["touch"], region.acts["A"]
    touch, zero = line.place, region.acts["zero"].place
    r0, need = (float(region.value(name)) for name in ("prime_radius", "need"))
    axes = _axes(curve, min(centre.place.imag, zero.imag) - OVERHANG)
    laid_off = say(
        "At every displacement the acceleration is laid off in the scale of s, to the right where it is positive; the "
        "longest measures {longest:.1f} mm. The ends are joined by smooth curves between jumps and corners of the "
        "acceleration; a dwell is a point of the axis."
    ).where(longest=float(np.abs(curve.real).max()))
    touching = say(
        "Where s + a is least the tangent at 45° touches the curve; it meets the axis of s at {meets:.2f} mm, so the "
        "greatest of −(s + a) is {need:.3f} mm. With unequal scales it would have to lean by arctan(μₐ/μₛ)."
    ).where(meets=zero.imag, need=need)
    tangent = (
        Line(np.array([touch + 12 * (UP - RIGHT), zero + 16 * (RIGHT - UP)]), Role.LIMIT, of=line.act),
        Dots(np.array([touch, zero]), Role.LIMIT, of=line.act),
        AngleMark(zero, 12.0, -np.pi / 2, -np.pi / 4, "45°", of=line.act),
    )
    found = say(
        "With the least permitted radius of curvature ρ = {least:g} mm, r₀ = ρ + {need:.3f} = {r0:.3f} mm; it is laid "
        "off below the start of the lift to the cam centre A."
    ).where(least=region.givens.least_curvature, need=need, r0=r0)
    radius = (
        *(centre.dots(Role.RESULT), centre.label("A", 1 - 1j)),
        Dimension(0j, centre.place, say("r₀ = {r0:.2f}", r0=r0), -10.0, region.readings["prime_radius"].act),
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
    integrated, acts, smooth = region.givens.integrated, region.acts, showing(region)
    stations, curve, jumps = integrated.givens.stations, acts["curve"].first, acts["before the jumps"]
    lines, named = list[Mark]([acts["accelerations"].from_(acts["displacements"], Role.CONSTRUCTION)]), list[Mark]()
    if jumps.shown.size:
        lines.append(jumps.from_(jumps.shown.imag * UP, Role.CONSTRUCTION))
    for piece, stretch in zip(_smooth(integrated), stations.stretches, strict=False):
        begin, name = curve[piece.start], station_names(stations)[stretch.start]
        lines.append(smooth.fair(f"from {name}", curve[piece], [slice(None)]).line(Role.RESULT))
        named.append(begin.label(name, np.sign(begin.place.real) + 0j, small=True))
    return (*lines, acts["rests"].dots(Role.RESULT), *named)
