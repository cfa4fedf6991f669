"""The roller radius by the rule of the school, and the working profile as the envelope of the roller's circles."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.curvature import Curved
from graphcam.constructions.profile_view import Inverted, closed_curve
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import UP, tangent_of_circle, unit
from graphcam.drafting.ink import Caption, Construction, Step, reading, say
from graphcam.drafting.marks import AngleMark, Circle, Dots, Line, Mark, Points, Role
from graphcam.drafting.meaning import Compared, Converges, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.roller_rule import Candidate
from graphcam.given.stations import Stations
from graphcam.words import say_many, sequence

TOUCHING = 1e-9
"""A touch point this little inside another circle, as a fraction of its radius, still lies on it: rounding."""
TREMBLE = 3.0
"""So many of a hand's errors may set a point inside a circle that only touches it."""


@dataclass(frozen=True, eq=False)
class RollerGivens:
    """What lies on the board; see :func:`roller_radius`."""

    curved: Curved
    rule: tuple[Candidate, ...]
    given: float | None


@dataclass(frozen=True, eq=False)
class ProfileGivens:
    """The pitch curve, and the radius of the roller [mm]."""

    inverted: Inverted
    roller_radius: float


Profile = Construction[ProfileGivens]


ROLLER_MEANING = Meaning(
    "roller",
    say("Roller radius"),
    say("The roller must stay below the least radius of curvature, and is chosen by a rule."),
    {
        "candidates": ReadingMeaning(say("proposals"), "r", "mm"),
        "roller_radius": ReadingMeaning(
            say("roller radius r"), "r", "mm", (Compared("roller_radius", say("roller radius"), "candidates"),)
        ),
    },
    "report.paragraphs.roller",
)
PROFILE_MEANING = Meaning(
    "working_profile",
    say("Working profile"),
    say("The profile is what touches all positions of the follower: the inner envelope."),
    {
        "radius": ReadingMeaning(
            say("polar radius"), "R", "mm", converges=Converges("working profile", "profile", "from the profile")
        )
    },
    "report.paragraphs.working_profile",
)


def roller_radius(
    curved: Curved, rule: tuple[Candidate, ...], given: float | None, pencil: Pencil
) -> Construction[RollerGivens]:
    """What the rule proposes from the least radius of curvature and the prime radius; the smallest is taken.

    curved : from :func:`~graphcam.constructions.curvature.curvature`
    given : the roller radius [mm] where the task gives one, which is then taken, or None

    Readings: the ``candidates``, one a term of the rule or the given one, and their least, ``roller_radius`` [mm].
    """
    inverted, rho = curved.givens.inverted, curved.readings["rho"].paper
    mu_l = inverted.givens.mu_l.per_mm
    r0 = pencil.sheets(inverted.givens.prime_radius / mu_l)
    if given is None:
        terms = [term.factor * (rho if term.of == "rho" else r0) - term.margin / mu_l for term in rule]
        candidates = np.stack(terms, axis=-1)
    else:
        candidates = pencil.sheets([given / mu_l])
    # Where no bend is readable, rho limits nothing.
    least = np.fmin.reduce(candidates, axis=-1)
    return Construction(
        ROLLER_MEANING,
        RollerGivens(curved, rule, given),
        pencil,
        {"candidates": reading(candidates, mu_l, "mm"), "roller_radius": reading(least, mu_l, "mm")},
        {},
        _draw,
    )


def working_profile(inverted: Inverted, roller: float, pencil: Pencil) -> Profile:
    """From each pitch point the roller's radius [mm] towards the cam, square to the circle through its neighbours.

    inverted : from :func:`~graphcam.constructions.inversion.inversion`

    Readings: ``radius`` of the touch points from the cam centre [mm]; NaN where another roller circle covers the point.
    Points: ``touch`` (..., m), NaN where covered; ``covered`` the touch points that were dropped.
    """
    hand = pencil.hand("working_profile")
    stations, mu_l = inverted.givens.integrated.givens.stations, inverted.givens.mu_l
    pitch = inverted.points["pitch"]
    radius = roller / mu_l.per_mm
    touch = pitch + radius * _inward(pitch, stations, sense(inverted.givens.rotation)) + hand.point(stations.u.size)
    tremble = TREMBLE * math.hypot(pencil.line, pencil.dividers)
    covered = _covered(touch, pitch, radius * (1 - TOUCHING) - tremble)
    kept = np.where(covered, np.nan, touch)
    return Construction(
        PROFILE_MEANING,
        ProfileGivens(inverted, roller),
        pencil,
        {"radius": reading(hand.read(np.abs(kept)), mu_l.per_mm, "mm")},
        {"touch": kept, "covered": np.where(covered, touch, np.nan)},
        _draw_profile,
    )


def _inward(pitch: Points, stations: Stations, sigma: int) -> Points:
    """The unit normals of the pitch curve at its points, towards the inside of the cam."""
    along = np.empty_like(pitch)
    inner = np.ones(stations.u.size, dtype=bool)
    for span in stations.phases:
        inner[[span.start, span.stop - 1]] = False
    at = np.flatnonzero(inner)
    along[..., at] = tangent_of_circle(pitch[..., at - 1], pitch[..., at], pitch[..., at + 1])
    # A phase ends at rest, where the curve runs on as an arc about the cam centre.
    ends = np.flatnonzero(~inner)
    along[..., ends] = -UP * sigma * unit(pitch[..., ends])
    # No circle is drawn across a jump of the acceleration, where the curvature jumps too: the circles of the pieces on
    # either side end there, and a chord makes equal angles with the tangents at its two ends.
    for jump in sorted({p.start for p in stations.pieces} - {span.start for span in stations.phases}):
        before = unit(pitch[..., jump] - pitch[..., jump - 1])
        after = unit(pitch[..., jump + 1] - pitch[..., jump])
        along[..., jump] = unit(before * before / along[..., jump - 1] + after * after / along[..., jump + 1])
    return -UP * sigma * along


def _covered(touch: Points, pitch: Points, radius: float) -> NDArray[np.bool_]:
    """Which touch points lie nearer than ``radius`` to the centre of another roller circle."""
    covered = np.zeros(touch.shape, dtype=bool)
    for k in range(pitch.shape[-1]):
        inside = np.abs(touch - pitch[..., k : k + 1]) < radius
        inside[..., k] = False  # its own circle it touches, however the hand may have set it
        covered |= inside
    return covered


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(rolled: Construction[RollerGivens]) -> list[Step]:
    rule, given, candidates = rolled.givens.rule, rolled.givens.given, rolled.value("candidates")
    taken = float(rolled.value("roller_radius"))
    if given is None:
        terms = [_proposal(term, radius) for term, radius in zip(rule, candidates, strict=True)]
        caption = say("The rule proposes {proposed}; the smallest is taken, {taken:.2f} mm.").where(
            proposed=sequence(terms), taken=taken
        )
        if rule and rule[0].source:
            caption = sequence([caption, say("It is a rule of {source}.", source=rule[0].source)], " ")
    else:
        caption = say("The task gives a roller of {taken:g} mm; the rule is not asked.", taken=taken)
    return [Step(say("Roller radius"), caption, PROFILE, (), reads=("candidates", "roller_radius"))]


def _proposal(term: Candidate, radius: float) -> Caption:
    if np.isfinite(radius):
        return say("{term} = {radius:.2f} mm", term=term.said, radius=radius)
    return say("{term}, which cannot be read", term=term.said)


def _draw_profile(profile: Profile) -> list[Step]:
    inverted, roller = profile.givens.inverted, profile.givens.roller_radius
    mu_l = inverted.givens.mu_l
    touch, covered, pitch = profile.first("touch"), profile.first("covered"), inverted.first("pitch")
    lost, measured = int(np.sum(~np.isnan(covered))), profile.first("radius") * mu_l.per_mm
    radii = {"least": np.nanmin(measured), "greatest": np.nanmax(measured)}
    curve = Line(closed_curve(inverted, touch), Role.RESULT, closed=True)
    if not roller:
        caption = say(
            "Without a roller the curve is the working profile itself; its radii run from {least:.2f} to "
            "{greatest:.2f} mm."
        ).where(**radii)
        return [Step(say("Working profile"), caption, PROFILE, (curve,), reads=("radius",))]
    envelope = say(
        "The inner envelope of the circles is the working profile; its radii run from {least:.2f} to {greatest:.2f} mm."
    ).where(**radii)
    undercut = say_many(
        "At {count} station the touch point lies inside another roller circle: the profile is undercut and cannot be "
        "cut so.",
        "At {count} stations the touch point lies inside another roller circle: the profile is undercut and cannot be "
        "cut so.",
        lost,
    )
    drawn = say(
        "From every point of the pitch curve the circle of the adopted roller is drawn, r = {roller:g} mm, "
        "{paper:.1f} mm on paper."
    ).where(roller=roller, paper=roller / mu_l.per_mm)
    circles = tuple(Circle(complex(at), roller / mu_l.per_mm, Role.CONSTRUCTION) for at in pitch)
    said, marks = envelope, (curve,)
    if lost:
        said, marks = sequence([envelope, undercut], " "), (curve, Dots(covered[~np.isnan(covered)], Role.LIMIT))
    measured_anew = say(
        "Where the profile was touched its normal runs through the roller's centre; its angle with the follower's line "
        "is the pressure angle of that station, shown where it is greatest in each phase. It is measured anew on this "
        "drawing, so it agrees with the diagram only as well as the touch points are found."
    )
    normals = tuple(mark for at in _steepest(profile) for mark in _normal(profile, at))
    return [
        Step(say("Roller circles"), drawn, PROFILE, circles),
        Step(say("Working profile"), said, PROFILE, marks, reads=("radius",)),
        Step(say("Pressure angles on the profile"), measured_anew, PROFILE, normals),
    ]


def _angles(profile: Profile) -> Floats:
    """The angles from the follower's line to the profile's normal at the stations [rad], in the first sample."""
    inverted = profile.givens.inverted
    pitch = inverted.first("pitch")
    return np.angle((pitch - profile.first("touch")) / inverted.first("motion"))


def _steepest(profile: Profile) -> list[int]:
    """The station of the greatest angle in each moving phase; none where the whole phase is covered."""
    stations, angles = profile.givens.inverted.givens.integrated.givens.stations, np.abs(_angles(profile))
    touched = [span for span in stations.phases if not np.isnan(angles[span]).all()]
    return [int(span.start + np.nanargmax(angles[span])) for span in touched]


def _normal(profile: Profile, at: int) -> tuple[Mark, ...]:
    inverted, angle = profile.givens.inverted, float(_angles(profile)[at])
    places = (inverted.first("pitch"), inverted.first("motion"), profile.first("touch"))
    pitch, line, touch = (complex(place[at]) for place in places)
    normal = (pitch - touch) / abs(pitch - touch)
    start, end = sorted((float(np.angle(line)), float(np.angle(line)) + angle))
    return (
        Line(np.array([pitch, pitch + (NORMAL + 4) * line]), Role.CONSTRUCTION),
        Line(np.array([touch, pitch + (NORMAL + 4) * normal]), Role.LIMIT),
        AngleMark(pitch, NORMAL, start, end, say("{alpha:.1f}°", alpha=abs(np.degrees(angle)))),
    )


NORMAL = 26.0
"""Radius of the arcs that show a pressure angle on the profile [mm]."""
