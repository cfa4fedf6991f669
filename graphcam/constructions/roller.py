"""The roller radius by the rule of the school, and the working profile as the envelope of the roller's circles."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.curvature import Curved
from graphcam.constructions.profile_view import Inverted, closed_curve
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import RIGHT, UP, tangent_of_circle, unit
from graphcam.drafting.hand import Hand, between, reckoned, showing
from graphcam.drafting.ink import Caption, Construction, Step, say
from graphcam.drafting.marks import AngleMark, Line, Mark, Points, Role
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

    given : the roller radius [mm] where the task gives one, which is then taken, or None
    """
    hand, inverted = Hand(pencil, ROLLER_MEANING), curved.givens.inverted
    mu_l, centre = inverted.givens.mu_l.per_mm, hand.given("cam centre")
    if given is None:
        prime_radius = between(centre, hand.found(inverted, "starts")[0])
        proposed = reckoned(partial(_proposed, rule, mu_l), hand.carry(curved.readings["rho"]), prime_radius)
    else:
        proposed = reckoned(np.atleast_1d, hand.at_scale(given, inverted.readings["radius"]))
    # The compass is set to each; where nothing is convex there is nothing to set it to.
    set_to, own = hand.lay_off("roller", centre, RIGHT, reckoned(_finite, proposed)), proposed.amount.shape[-1]
    which = np.where(np.isinf(proposed.amount), own, np.arange(own))
    laid_off = hand.take("proposals", set_to, hand.given("far away", [np.inf]), which=which)
    candidates = between(centre, laid_off, RIGHT)
    hand.read("candidates", candidates, mu_l, rounded=False)
    # Where no bend is readable, rho limits nothing.
    hand.read("roller_radius", reckoned(partial(np.fmin.reduce, axis=-1), candidates), mu_l, rounded=False)
    return hand.finished(RollerGivens(curved, rule, given), _draw, {})


def _proposed(rule: tuple[Candidate, ...], mu_l: float, rho: Floats, prime_radius: Floats) -> Floats:
    """What each term of the rule makes of the two radii, all on paper: (..., k)."""
    return np.stack([t.factor * (rho if t.of == "rho" else prime_radius) - t.margin / mu_l for t in rule], axis=-1)


def _finite(radii: Floats) -> Floats:
    """Nothing in place of what is infinite."""
    return np.where(np.isinf(radii), 0.0, radii)


def working_profile(inverted: Inverted, roller: float, pencil: Pencil) -> Profile:
    """From each pitch point the roller's radius [mm] towards the cam, square to the circle through its neighbours.

    Points: ``touch`` (..., m), NaN where covered; ``covered`` the touch points that were dropped.
    """
    hand, mu_l = Hand(pencil, PROFILE_MEANING), inverted.givens.mu_l.per_mm
    stations, sigma, radius = inverted.givens.integrated.givens.stations, sense(inverted.givens.rotation), roller / mu_l
    found = pitch = hand.found(inverted, "pitch")
    if roller:
        tangents = hand.tangents_at("tangents", pitch, partial(_tangents, stations, sigma))
        circles = hand.circle("roller circles", pitch, radius)
        found = hand.cross("touch points", tangents.turned(-UP * sigma), circles)
    tremble = TREMBLE * math.hypot(pencil.line, pencil.dividers)
    covered = _covered(found.points, pitch.points, radius * (1 - TOUCHING) - tremble)
    nowhere, at = hand.given("nowhere", [np.nan]), np.arange(stations.u.size)
    touch = hand.take("touch", found, nowhere, which=np.where(covered, at.size, at))
    dropped = hand.take("covered", found, nowhere, which=np.where(covered, at, at.size))
    hand.read("radius", between(hand.given("cam centre"), touch), mu_l)
    return hand.finished(ProfileGivens(inverted, roller), _draw_profile, {"touch": touch, "covered": dropped})


def _tangents(stations: Stations, sigma: int, pitch: Points) -> Points:
    """The directions of the pitch curve at its points: of the circle through three, or of the arc of a rest."""
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
        along[..., jump] = unit(before**2 * along[..., jump - 1].conj() + after**2 * along[..., jump + 1].conj())
    return along


def _covered(touch: Points, pitch: Points, radius: float) -> NDArray[np.bool_]:
    """Which touch points lie nearer than ``radius`` to the centre of another roller circle.

    Of the centres that follow one another a whole run lies too far from most points, so few are looked at singly.
    """
    covered, count = np.zeros(touch.shape, dtype=bool), touch.shape[-1]
    size = math.isqrt(count)
    for start in range(0, count, size):
        run = pitch[..., start : start + size]
        middle = run.mean(axis=-1, keepdims=True)
        reach = radius + np.abs(run - middle).max(axis=-1, keepdims=True)
        near = np.nonzero(~covered & ~(np.abs(touch - middle) >= reach))
        inside = np.abs(touch[near][:, None] - run[near[:-1]]) < radius
        # Its own circle a point touches, however the hand may have set it.
        other = near[-1][:, None] != start + np.arange(run.shape[-1])
        covered[near] |= np.any(inside & other, axis=-1)
    return covered


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(rolled: Construction[RollerGivens]) -> list[Step]:
    rule, given, candidates = rolled.givens.rule, rolled.givens.given, rolled.value("candidates")
    taken = float(rolled.value("roller_radius"))
    if given is None:
        terms = [_proposal(term, radius) for term, radius in zip(rule, candidates, strict=True)]
        caption = say("The rule proposes {proposed}; the smallest is taken, {taken:.2f} mm.")
        caption = caption.where(proposed=sequence(terms), taken=taken)
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
    mu_l, covered, measured = inverted.givens.mu_l.per_mm, profile.acts["covered"].first, profile.value("radius")
    lost = np.flatnonzero(~np.isnan(covered.points))
    radii = {"least": np.fmin.reduce(measured), "greatest": np.fmax.reduce(measured)}
    curve = closed_curve("working profile", inverted, profile.acts["touch"]).line(Role.RESULT, closed=True)
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
        lost.size,
    )
    drawn = say(
        "From every point of the pitch curve the circle of the adopted roller is drawn, r = {roller:g} mm, "
        "{paper:.1f} mm on paper."
    ).where(roller=roller, paper=roller / mu_l)
    circle = profile.acts["roller circles"].first
    circles = tuple(circle[k].drawn_circle(Role.CONSTRUCTION) for k in range(circle.points.size))
    said, marks = envelope, (curve,)
    if lost.size:
        said, marks = sequence([envelope, undercut], " "), (curve, covered[lost].dots(Role.LIMIT))
    measured_anew = say(
        "Where the profile was touched its normal runs through the roller's centre; its angle with the follower's line "
        "is the pressure angle of that station, shown where it is greatest in each phase. It is measured anew on this "
        "drawing, so it agrees with the diagram only as well as the touch points are found."
    )
    return [
        Step(say("Roller circles"), drawn, PROFILE, circles),
        Step(say("Working profile"), said, PROFILE, marks, reads=("radius",)),
        Step(say("Pressure angles on the profile"), measured_anew, PROFILE, _normals(profile)),
    ]


def _normals(profile: Profile) -> tuple[Mark, ...]:
    """The profile's normal and the follower's line where they enclose the greatest angle in each moving phase.

    None where the whole phase is covered.
    """
    hand, inverted = showing(profile), profile.givens.inverted
    motion, pitch, touch = inverted.acts["motion"].first, inverted.acts["pitch"].first, profile.acts["touch"].first
    normals = hand.join("normals", touch, pitch)
    alpha = hand.angle("pressure angles", motion, normals)
    lines, beyond = (hand.lay_off(f"far on {d.act.name}", pitch, d, NORMAL + 4) for d in (motion, normals))
    marks = list[Mark]()
    for span in inverted.givens.integrated.givens.stations.phases:
        angles = np.abs(alpha.paper[span])
        if np.isnan(angles).all():
            continue
        at = int(span.start + np.nanargmax(angles))
        direction, angle = float(np.angle(motion.directions[at])), float(alpha.paper[at])
        start, end = sorted((direction, direction + angle))
        said = say("{alpha:.1f}°", alpha=abs(np.degrees(angle)))
        marks += [
            lines[at].line_from(pitch[at], Role.CONSTRUCTION),
            Line(np.array([touch[at].place, beyond[at].place]), Role.LIMIT, of=normals.act),
            AngleMark(pitch[at].place, NORMAL, start, end, said, alpha.act),
        ]
    return tuple(marks)


NORMAL = 26.0
"""Radius of the arcs that show a pressure angle on the profile [mm]."""
