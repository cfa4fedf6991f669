"""Curvature of the pitch curve by three points, at its sharpest place.

The perpendicular bisectors of two neighbouring chords meet in the centre of the circle through the three points.  In a
dwell the pitch curve is an arc about the cam centre; its ends and its middle are three such points.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import phase_symbol, station_names
from graphcam.constructions.profile_view import Inverted
from graphcam.constructions.views import CURVATURE, PROFILE, at_scale
from graphcam.drafting.euclid import UP, centre_of_circle, crossing, perpendicular_bisector, stepped_off
from graphcam.drafting.ink import Caption, Construction, Step, reading, say
from graphcam.drafting.marks import Arc, Dots, Label, Line, Mark, Points, Role
from graphcam.drafting.meaning import Compared, Converges, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import ratio_text, standard_scale
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Moving
from graphcam.given.stations import Stations
from graphcam.plane import cross, dot
from graphcam.words import sequence


@dataclass(frozen=True, eq=False)
class CurvatureGivens:
    """The pitch curve, and in which samples it turns a corner."""

    inverted: Inverted
    corner: NDArray[np.bool_]


Curved = Construction[CurvatureGivens]


LEAST_CURVATURE = {
    "rho": ReadingMeaning(
        say("least radius of curvature ρ"),
        "ρ",
        "mm",
        (Compared("min_pitch_curvature_radius", say("least curvature radius ρ"), "rho_candidates"),),
        Converges("least curvature radius", "min_moving_curvature_radius", of="rho_candidates"),
    )
}
"""The least radius of curvature, however it is found."""
MEANING = Meaning(
    "curvature",
    say("Least radius of curvature"),
    say(
        "Three near points of a curve determine the circle that fits it best. The least radius of curvature limits "
        "the roller."
    ),
    {**LEAST_CURVATURE, "phi": ReadingMeaning(say("cam angles φ"), "φ", "rad")},
    "report.paragraphs.curvature",
)


def curvature(inverted: Inverted, pencil: Pencil) -> Curved:
    """Find the sharpest convex place among three neighbouring points of a smooth piece, and the arcs of the rests.

    inverted : from :func:`~graphcam.constructions.inversion.inversion`

    Readings: ``rho``, the least radius of curvature [mm], and the ``rho_candidates`` (..., 2) it is the smaller of, in
    the moving phases and in the rests, infinite where nothing is convex; ``phi`` (..., 3), the cam angles of the three
    points.  NaN where no bend is readable, and of the moving phases and of rho where the curve turns a corner that
    three points cannot tell.
    Points: the ``triple`` (..., 3) at the sharpest place and its ``centre``.
    """
    hand = pencil.hand("curvature")
    moving, resting = _moving(inverted), _resting(inverted)
    radii = [_convex_radii(inverted, triples) for triples in (moving, resting)]
    corner = _turns_a_corner(inverted)
    candidates = [_least(radii[0], unknown=corner | np.isnan(radii[0]).all(axis=-1)), _least(radii[1])]
    rho = np.where(corner, np.nan, np.fmin(*candidates))
    rho = np.where(np.isfinite(rho), rho, np.nan)
    everywhere = np.concatenate(radii, axis=-1)
    best = np.argmin(np.where(np.isnan(everywhere), np.inf, everywhere), axis=-1)[..., None, None]
    triple = np.take_along_axis(np.concatenate([moving[0], resting[0]], axis=-2), best, -2)[..., 0, :]
    turns = np.take_along_axis(np.concatenate([moving[1], resting[1]], axis=-2), best, -2)[..., 0, :]
    unread = np.isnan(rho)
    lengths = hand.readings(inverted.givens.mu_l.per_mm, "mm", rho=rho, rho_candidates=np.stack(candidates, axis=-1))
    return Construction(
        MEANING,
        CurvatureGivens(inverted, corner),
        pencil,
        {**lengths, "phi": reading(np.where(unread[..., None], np.nan, turns), 1.0, "rad")},
        {
            "triple": np.where(unread[..., None], np.nan, triple),
            "centre": np.where(unread, np.nan, _centres(inverted, triple)),
        },
        _draw,
    )


Triples = tuple[Points, Floats]
"""(..., k, 3) three points each, and their cam angles [rad]."""


def _none(pitch: Points) -> Triples:
    """A triple that cannot be read, where there is none."""
    unread = np.full((*pitch.shape[:-1], 1, 3), np.nan)
    return unread + 0j, unread


def _moving(inverted: Inverted) -> Triples:
    """Every station with its neighbours, never across a jump of the acceleration.

    Where the bisectors cross at less than a degree the second neighbours are taken in place of the first, or the
    fourth, and so on: with very many parts the chords between neighbours hardly bend.
    """
    stations, pitch = inverted.givens.integrated.givens.stations, inverted.points["pitch"]
    places = [
        (k, min(k - piece.start, piece.stop - 1 - k))
        for piece in stations.pieces
        for k in range(piece.start + 1, piece.stop - 1)
    ]
    if not places:
        return _none(pitch)
    middle, reach = np.transpose(places)
    step = np.ones((*pitch.shape[:-1], middle.size), dtype=np.intp)
    while True:
        at = np.stack([middle - step, middle + 0 * step, middle + step], axis=-1)
        triples = np.take_along_axis(pitch[..., None, :], at, -1)
        wider = np.isnan(_centres(inverted, triples)) & (2 * step <= reach)
        if not wider.any():
            return triples, stations.phi[at]
        step = np.where(wider, 2 * step, step)


INSTANT = math.radians(5)
"""Three points of the arc of an instant's rest are taken so far apart."""
NO_ACCELERATION = 1e-9
"""Part of the greatest acceleration that is none."""


def _resting(inverted: Inverted) -> Triples:
    """Three points of the arc about the cam centre on which the trace point rests, in each dwell.

    Where two moving phases meet and the acceleration of either vanishes, it rests for an instant on such an arc.
    """
    integrated, pitch = inverted.givens.integrated, inverted.points["pitch"]
    motion, stations = integrated.givens.motion, integrated.givens.stations
    sigma = sense(inverted.givens.rotation)
    arcs: list[Points] = []
    phi: list[Floats] = []
    for k, last in zip(stations.phase[stations.last], stations.last, strict=True):
        # What follows a moving phase is a dwell or the next moving phase; the last is followed by the first.
        before, following = motion.phases[k], motion.phases[(k + 1) % len(motion.phases)]
        if isinstance(following, Dwell):
            turns = following.angle * np.array([0.0, 0.5, 1.0])
        elif _vanishes(before, 1.0) or _vanishes(following, 0.0):
            turns = INSTANT * np.array([-1.0, 0.0, 1.0])
        else:
            continue
        arcs.append(stepped_off(pitch[..., last, None], 0j, -sigma * turns))
        phi.append(stations.phi[last] + turns)
    if not arcs:
        return _none(pitch)
    points = np.stack(arcs, axis=-2)
    return points, np.broadcast_to(np.stack(phi), points.shape)


def _vanishes(phase: Moving, u: float) -> bool:
    """Whether the given acceleration of a phase is zero at its end u."""
    law = phase.normalised
    return abs(float(law(u)[2])) <= NO_ACCELERATION * law.peak_acceleration


def _centres(inverted: Inverted, triples: Points) -> Points:
    """The centres of the circles through three points (..., 3); NaN where the bisectors cross at less than a degree.

    In a drawing that is divided again to see what finer parts would change, every crossing counts.
    """
    a, b, c = np.moveaxis(triples, -1, 0)
    if inverted.givens.integrated.givens.stations.refine > 1:
        return crossing(*perpendicular_bisector(a, b), *perpendicular_bisector(b, c))
    return centre_of_circle(a, b, c)


def _convex_radii(inverted: Inverted, triples: Triples) -> Floats:
    """(..., k) the radii of the circles on paper, infinite where they are not convex, NaN where they are not read."""
    a, b, c = np.moveaxis(triples[0], -1, 0)
    centres = _centres(inverted, triples[0])
    # Numbered against the rotation, a convex curve turns the other way than the cam.
    convex = sense(inverted.givens.rotation) * cross(b - a, c - b) < 0
    return np.where(np.isnan(centres), np.nan, np.where(convex, np.abs(centres - b), np.inf))


def _least(radii: Floats, unknown: NDArray[np.bool_] | bool = False) -> Floats:
    """The least radius that is read; infinite where nothing is convex."""
    return np.where(unknown, np.nan, np.min(np.where(np.isnan(radii), np.inf, radii), axis=-1))


CORNER = math.radians(45)
"""A curve that turns by so much more than the follower does between a rest and the next point has a corner there."""


def _turns_a_corner(inverted: Inverted) -> NDArray[np.bool_]:
    """Whether the pitch curve turns inwards by more than can be read between the end of a phase and the next point.

    Where the follower rests the curve runs square to the ray from the cam centre.
    """
    stations, pitch = inverted.givens.integrated.givens.stations, inverted.points["pitch"]
    ends = np.array([[span.start, span.stop - 1] for span in stations.phases]).ravel()
    onwards = np.tile([1, -1], len(stations.phases))
    end, following = pitch[..., ends], pitch[..., ends + onwards]
    chord, along = following - end, -sense(inverted.givens.rotation) * onwards * UP * end
    # The chord of an arc about the cam centre leaves it by half of what the cam has turned.
    by_turning = np.abs(np.angle(following / end)) / 2
    return np.any((dot(chord, end) < 0) & (np.abs(np.angle(chord / along)) > by_turning + CORNER), axis=-1)


# --- the steps -------------------------------------------------------------------------------------------------------

DETAIL = 70.0
"""The detail is enlarged to the largest standard scale at which the radius of curvature is not longer [mm]."""
SAME_ANGLE = 1e-9
"""Cam angles this near to one another [rad] are the same: rounding."""
READABLE_STEP = math.radians(10)
"""Over a smaller step of the cam angle a hand's error outweighs the bend."""
ONLY_RESTS = say(
    "In the moving phases no bend is readable, for too few points stand between the jumps of the acceleration: only "
    "the rests are compared. More parts are needed."
)
"""What is said where the radius of the moving phases is not known."""


def _draw(curved: Curved) -> list[Step]:
    inverted = curved.givens.inverted
    stations, mu_l = inverted.givens.integrated.givens.stations, inverted.givens.mu_l
    triple, centre = curved.first("triple"), complex(curved.first("centre"))
    if np.isnan(centre):
        return [Step(say("Curvature at the sharpest place"), _unreadable(curved), PROFILE, ())]
    phi = curved.first("phi")
    place, names = _named(inverted.givens.integrated.givens.motion, stations, phi)
    rho = float(curved.value("rho"))
    scale = standard_scale(rho, DETAIL)
    curvature = at_scale(CURVATURE, scale)
    enlarged = (triple - triple[1]) * mu_l.per_mm / scale.per_mm
    hub = complex(centre - triple[1]) * mu_l.per_mm / scale.per_mm
    first, second = np.abs(np.diff(enlarged))
    sharpest = say(
        "The sharpest place is B, {place}, at φ = {phi:.1f}°. The chords to its neighbours are drawn enlarged, at "
        "{ratio}: {first:.2f} mm and {second:.2f} mm. {spread}"
    )
    sharpest = sharpest.where(place=place, phi=np.degrees(phi[1] % FULL_TURN), ratio=ratio_text(scale.per_mm))
    named = zip(enlarged.tolist(), (names[0], "B", names[1]), strict=True)
    chords = (Line(enlarged, Role.CURVE), Dots(enlarged), *(Label(at, name, towards=-hub) for at, name in named))
    bisected = say("The chords are bisected; the perpendiculars meet in O, the centre of curvature.")
    bisectors = tuple(mark for a, b in pairwise(enlarged) for mark in _bisector(a, b, hub))
    measured = say(
        "OB measures {paper:.2f} mm, so the least radius of curvature of the pitch curve is ρ = {rho:.3f} mm."
    ).where(paper=abs(hub), rho=rho)
    marked = say("On the profile the centre of curvature of the sharpest place is marked.")
    on_profile = (
        *(Line(np.array([centre, triple[1]]), Role.LIMIT), Dots(np.array([centre]), Role.LIMIT)),
        Label(centre, "O", towards=centre - triple[1]),
    )
    enlarging = sharpest.where(first=first, second=second, spread=_spread(curved))
    return [
        Step(say("Chords at the sharpest place"), enlarging, curvature, chords, reads=("phi",)),
        Step(say("Perpendicular bisectors"), bisected, curvature, bisectors),
        Step(say("Radius of curvature"), measured, curvature, _radius(enlarged, hub, rho)),
        Step(say("Centre of curvature on the profile"), marked, PROFILE, on_profile, reads=("rho",)),
    ]


def _spread(curved: Curved) -> Caption:
    """What step of the cam angle the chords span, and what that is worth."""
    phi = curved.first("phi")
    said = [say("They span {step:.3g}° of the cam angle.", step=np.degrees(phi[2] - phi[0]))]
    if phi[2] - phi[0] < READABLE_STEP:
        said.append(say("Over so small a step a hand's error is large."))
    if np.isnan(curved.first("rho_candidates")[0]):
        said.append(ONLY_RESTS)
    return sequence(said, " ")


def _unreadable(curved: Curved) -> Caption:
    """Why there is no radius."""
    if np.ravel(curved.givens.corner)[0]:
        return say(
            "No bend is readable: beside a rest the curve turns by more than 45° within one part, so its sharpest "
            "place lies between the points."
        )
    return say("No bend is readable: the bisectors of neighbouring chords cross at less than a degree.")


def _named(motion: Motion, stations: Stations, phi: Floats) -> tuple[Caption, tuple[str, str]]:
    """What the middle place of three is called, at the cam angles phi (3,) [rad], and its two neighbours."""
    here = np.flatnonzero(np.abs(stations.phi - phi[1]) < SAME_ANGLE)
    if here.size == 0:  # no stations in dwells
        resting = int(np.searchsorted(motion.starts, phi[1] % FULL_TURN, side="right")) - 1
        return say("the middle of a dwell ({symbol})", symbol=phase_symbol(motion, resting)), ("", "")
    names, k = station_names(stations), int(here[0])
    around = [np.flatnonzero(np.abs(stations.phi - phi[side]) < SAME_ANGLE) for side in (0, 2)]
    if not all(found.size for found in around):  # three points of the arc of an instant
        resting = say("station {name}, where the follower rests for an instant on an arc about the cam centre")
        return resting.where(name=names[k]), ("", "")
    return say("station {name}", name=names[k]), (names[int(around[0][-1])], names[int(around[1][0])])


def _bisector(a: complex, b: complex, hub: complex) -> tuple[Mark, ...]:
    """The line from beyond a chord's middle to the centre, and the arcs of the compass that found it."""
    middle, direction = (complex(x) for x in perpendicular_bisector(np.asarray(a), np.asarray(b)))
    reach = abs(b - a) * 0.8
    out = direction / abs(direction) * math.sqrt(reach**2 - abs(b - a) ** 2 / 4)
    line = Line(np.array([middle - (hub - middle) * 0.12, hub + (hub - middle) * 0.06]), Role.CONSTRUCTION)
    settings = [(end, float(np.angle(meeting - end))) for meeting in (middle + out, middle - out) for end in (a, b)]
    return (line, *(Arc(end, reach, to - 0.12, to + 0.12, Role.CONSTRUCTION) for end, to in settings))


def _radius(triple: Points, hub: complex, rho: float) -> tuple[Mark, ...]:
    """The radius of curvature ``rho`` [mm], from the centre to the middle place, and a little of its circle."""
    return (
        Line(np.array([hub, triple[1]]), Role.LIMIT),
        Arc(hub, abs(hub), *_sector(triple, hub), Role.CONSTRUCTION),
        Dots(np.array([hub]), Role.RESULT),
        Label(hub, "O", towards=hub),
        Label(hub / 2, say("ρ = {rho:.2f}", rho=rho), towards=hub * UP),
    )


def _sector(triple: Points, hub: complex) -> tuple[float, float]:
    """The directions, counter-clockwise, between which the circle of curvature is shown: a little beyond the chords."""
    middle = float(np.angle(triple[1] - hub))
    wide = max(abs(float(np.angle((end - hub) / (triple[1] - hub)))) for end in (triple[0], triple[2]))
    return middle - 1.6 * wide, middle + 1.6 * wide
