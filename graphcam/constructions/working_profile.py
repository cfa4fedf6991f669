"""The working profile: the envelope of the roller's circles, and the pressure angles that it shows."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import low_dwell_symbol, phase_kind, station_names
from graphcam.constructions.profile_view import Inverted, phases_step, piecewise_curve
from graphcam.constructions.roller import Rolled, laid_off_on_ob
from graphcam.constructions.views import PROFILE
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import UP, tangent_of_circle, unit
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, say
from graphcam.drafting.marks import AngleMark, Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Meaning, ReadingConvergence, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.telling import STATION, circle_caption, introduced_parts, no_setting, run
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.stations import Stations, falling_blows
from graphcam.words import and_list, say_in, say_many, sequence

TOUCH_ROUNDING = 1e-9
"""A touch point this little inside another circle, as a fraction of its radius, still lies on it: rounding."""
SIDES = "one side", "other side"
HAND_ERRORS = 3.0
"""So many of a hand's errors may set a point inside a circle that only touches it."""


@dataclass(frozen=True, eq=False)
class ProfileGivens:
    """The pitch curve, the radius of the roller [mm], and what the steps compare with.

    rolled : what the rule proposed, where it was applied;  measured : the pressure angles, where a follower has any
    """

    inverted: Inverted
    roller_radius: float
    rolled: Rolled | None
    measured: Construction | None


Profile = Construction[ProfileGivens]


MEANING = Meaning(
    "working_profile",
    say("Working profile"),
    say("The profile is the curve that touches the follower in all its positions: the inner envelope."),
    {
        "radius": ReadingMeaning(
            say("polar radius"),
            "R",
            "mm",
            converges=ReadingConvergence("working profile", "profile", "from the profile"),
        )
    },
)


def working_profile(
    inverted: Inverted,
    roller: float,
    pencil: Pencil,
    rolled: Rolled | None = None,
    measured: Construction | None = None,
) -> Profile:
    """Lay the roller's radius [mm] off from each pitch point towards the cam, square to the pitch curve there.

    rolled, measured : what the rule proposed, and the pressure angles, for the steps to compare with

    Readings besides those of the meaning: ``low_dwells``, the angles (..., k) of the arcs of the lower dwells, if any.
    Points: ``touch`` (..., m), NaN where covered; ``covered`` the touch points that were dropped.
    """
    hand, mu_l = Hand(pencil, MEANING), inverted.givens.mu_l.per_mm
    stations, sigma, radius = inverted.givens.integrated.givens.stations, sense(inverted.givens.rotation), roller / mu_l
    found = pitch = hand.earlier_places(inverted, "pitch")
    tangents = None
    if roller:
        tangents = hand.tangents_at("tangents", pitch, partial(_tangents, stations, sigma))
        circles = hand.circle("roller circles", pitch, radius)
        found = hand.cross("touch points", tangents.turned(-UP * sigma), circles)
    tremble = HAND_ERRORS * math.hypot(pencil.line, pencil.dividers)
    covered = _covered(found.points, pitch.points, radius * (1 - TOUCH_ROUNDING) - tremble)
    nowhere, at = hand.given("nowhere", [np.nan]), np.arange(stations.u.size)
    which = np.where(covered, at.size, at)
    corners = falling_blows(inverted.givens.integrated.givens.motion, stations)
    if tangents and corners:
        # What lies beyond the edge in which both sides of a corner meet is left out.
        ends = np.array(corners)
        sides = [
            hand.parallel(f"{side} of the edges", tangents[k], found[k]) for side, k in zip(SIDES, ends.T, strict=True)
        ]
        nowhere = hand.take("edges", nowhere, hand.cross("edges", *sides, flat=True))
        for k, (first, last) in enumerate(corners):
            covered[..., first : last + 1] = False
            which[..., first : last + 1] = at.size + 1 + k
    touch = hand.take("touch", found, nowhere, which=which)
    dropped = hand.take("covered", found, nowhere, which=np.where(covered, at, at.size))
    hand.read("radius", distance_between(hand.given("cam centre"), touch), mu_l)
    _measure_dwells(hand, inverted, touch)
    givens = ProfileGivens(inverted, roller, rolled, measured)
    return hand.finished(givens, _draw, {"touch": touch, "covered": dropped})


def low_dwells(inverted: Inverted) -> list[tuple[int, int, int]]:
    """The lower dwells: the number of each among all phases, and the stations at the ends of its arc."""
    motion, phase = inverted.givens.integrated.givens.motion, inverted.givens.integrated.givens.stations.phase
    found: list[tuple[int, int, int]] = []
    for k in range(len(motion.phases)):
        if phase_kind(motion, k) == "lower dwell":
            end = int(np.searchsorted(phase, k))
            found.append((k, (end - 1) % phase.size, end % phase.size))
    return found


def _measure_dwells(hand: Hand, inverted: Inverted, touch: Drawn) -> None:
    """Measure the angles between the radii to the ends of the arcs of the lower dwells."""
    dwells, motion = low_dwells(inverted), inverted.givens.integrated.givens.motion
    if not dwells:
        return
    centre, (numbers, starts, ends) = hand.given("cam centre"), np.array(dwells).T
    first, last = (
        hand.join(f"radii to the {name} of the dwells", centre, touch[at])
        for name, at in (("start", starts), ("end", ends))
    )
    angles = hand.angle("angles of the radii", first, last, -sense(inverted.givens.rotation))
    given = np.array([motion.phases[k].angle for k in numbers])
    found = calculated_setting(partial(_beyond_a_half_turn, given), hand.carry(angles))
    hand.read("low_dwells", found, 1.0, "rad", rounded=False)


def _beyond_a_half_turn(given: Floats, measured: Floats) -> Floats:
    """The angles [rad] as a protractor reads them, or the rest of the turn, whichever is the arc's."""
    return measured + FULL_TURN * np.round((given - measured) / FULL_TURN)


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
    blows = stations.left[stations.blows]
    for jump in sorted({p.start for p in stations.pieces} - {span.start for span in stations.phases}):
        # Across a blow, in which the curve turns at one point, there is no chord.
        beside = [jump - 1] if jump in blows else [jump + 1] if jump - 1 in blows else [jump - 1, jump + 1]
        chords = [unit(pitch[..., k] - pitch[..., jump]) ** 2 * along[..., k].conj() for k in beside]
        along[..., jump] = unit(np.sum(chords, axis=0))
    return along


def _covered(touch: Points, pitch: Points, radius: float) -> NDArray[np.bool_]:
    """The touch points (..., m) that lie nearer than ``radius`` to the centre of another roller circle, as a mask.

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


def _draw(profile: Profile) -> list[Step]:
    rounded = [_rounding_step(profile, profile.givens.rolled)] if profile.givens.rolled else []
    inverted, roller = profile.givens.inverted, profile.givens.roller_radius
    phases = phases_step(inverted, roller / inverted.givens.mu_l.per_mm)
    if not roller:
        return [_envelope(profile), *_arcs_of_dwells(profile), phases]
    steps = [*rounded, _circles(profile), _contact_points_step(profile), _envelope(profile), _angles(profile)]
    return [*steps, *_arcs_of_dwells(profile), phases]


def _rounding_step(profile: Profile, rolled: Rolled) -> Step:
    proposed, adopted = float(rolled.value("roller_radius")), profile.givens.roller_radius
    if math.isclose(proposed, adopted, rel_tol=1e-9):
        said = say("The proposed radius of {adopted:g} mm is adopted unchanged.")
    elif adopted < proposed:
        said = say("Round {proposed:.2f} mm down to {adopted:g} mm, the radius of the roller that is made.")
    else:
        said = say(
            "This drawing gives {proposed:.2f} mm; the radius is decided on a drawing with the ideal "
            "pencil: {adopted:g} mm."
        )
    why = say("Rollers are made in round sizes, and a larger one would violate the rule.")
    view, marks, parts = laid_off_on_ob(rolled, ["r"], np.array([adopted]))
    said = said.with_values(proposed=proposed, adopted=adopted)
    return Step(say("Roller radius rounded"), introduced_parts(said, parts), view, marks, why=why)


def _names(profile: Profile) -> list[str]:
    return station_names(profile.givens.inverted.givens.integrated.givens.stations)


def _circles(profile: Profile) -> Step:
    roller, mu_l = profile.givens.roller_radius, profile.givens.inverted.givens.mu_l.per_mm
    circles, names = profile.acts["roller circles"].first, _names(profile)
    each = say_in("drawn", "the circle of the roller about every point of the pitch curve, from {first} to {last}")
    said = circle_caption(each.with_values(first=names[0], last=names[-1]), "r", roller, mu_l)
    why = say("The roller's centre runs on the pitch curve: these circles are positions of the roller.")
    part = run(said, say("Circle {name}"), names, circles, settings=no_setting)
    marks = tuple(circles[k].drawn_circle(Role.CONSTRUCTION) for k in range(len(names)))
    return Step(say("Roller circles"), (part,), PROFILE, marks, why=why)


def _contact_points_step(profile: Profile) -> Step:
    paper = profile.givens.roller_radius / profile.givens.inverted.givens.mu_l.per_mm
    found, names = profile.acts["touch points"].first, _names(profile)
    said = say(
        "At every point of the pitch curve hold a set square or a mirror square to the curve, which runs there "
        "along the circle through the point and its two neighbours. Mark the contact point {paper:.1f} mm "
        "inward, on the roller's circle."
    ).with_values(paper=paper)
    why = say("A circle touches the profile where the common normal of profile and pitch curve cuts it.")
    # Where two neighbours lie in one place, the curve has no direction that could be seen.
    seen = np.flatnonzero(~np.isnan(found.points))
    part = run(said, say("Contact point {name}"), [names[k] for k in seen], found[seen], settings=no_setting)
    return Step(say("Contact points"), (part,), PROFILE, (found[seen].dots(Role.CONSTRUCTION),), why=why)


def _envelope(profile: Profile) -> Step:
    covered, measured = profile.acts["covered"].first, profile.value("radius")
    curve = piecewise_curve("working profile", profile.givens.inverted, profile.acts["touch"])
    marks: list[Mark] = [curve.whole.line(Role.RESULT, closed=True)]
    lost, parts = np.flatnonzero(~np.isnan(covered.points)), list[Part]()
    joined = say(
        "Join the contact points with the French curve: the line touches every circle on its inner side and cuts "
        "none, so it is their inner envelope, the working profile."
    )
    why = say("The roller touches the cam from outside in every position and never enters it.")
    if not profile.givens.roller_radius:
        joined = say("Without a roller the curve is the working profile itself: draw over it with a thick line.")
        why = say("There is no roller between the cam and the points that were found.")
    integrated = profile.givens.inverted.givens.integrated.givens
    if edges := [first for first, _ in falling_blows(integrated.motion, integrated.stations)]:
        corner = say_many(
            "At station {names} the pitch curve has a corner: the tangents at the contact points on both sides of it "
            "meet in an edge of the profile, and what lies beyond is left out.",
            "At stations {names} the pitch curve has corners: the tangents at the contact points on both sides of each "
            "meet in an edge of the profile, and what lies beyond is left out.",
            len(edges),
            names=and_list([_names(profile)[k].replace("⁻", "") for k in edges]),
        )
        if profile.givens.roller_radius:
            parts.append(Part(corner, (profile.acts["touch"].first[edges],)))
    if lost.size:
        marks.append(covered[lost].dots(Role.LIMIT))
        parts.append(Part(_undercut([_names(profile)[k] for k in lost]), (covered[lost],)))
        joined = say(
            "Join the other contact points with the French curve: the line cuts no circle, so it is their inner "
            "envelope, the working profile."
        )
    radii = say("Its radii run from {least:.2f} to {greatest:.2f} mm.")
    radii = radii.with_values(least=np.fmin.reduce(measured), greatest=np.fmax.reduce(measured))
    parts.append(curve.told(joined, radii))
    return Step(say("Working profile"), tuple(parts), PROFILE, tuple(marks), ("radius",), why=why)


def _undercut(lost: Sequence[str]) -> Caption:
    return say_many(
        "At {count} station ({names}) the contact point lies inside another roller circle and is left out: the "
        "profile is undercut and cannot be made.",
        "At {count} stations ({names}) the contact point lies inside another roller circle and is left out: the "
        "profile is undercut and cannot be made.",
        len(lost),
        names=sequence(lost),
    )


def _angles(profile: Profile) -> Step:
    """The step of the pressure angles on the finished profile, beside those found without it."""
    marks, rows, measured = list[Mark](), list[Row](), profile.givens.measured
    for found in _normals(profile):
        name, degrees = _names(profile)[found.at], abs(math.degrees(found.angle))
        shown = say("I {distance:.1f} mm from A, {alpha:.1f}°", distance=found.distance, alpha=degrees)
        if measured is not None:
            planned = abs(math.degrees(measured.first("alpha")[found.at]))
            shown = say(
                "I {distance:.1f} mm from A, {alpha:.1f}° ({planned:.1f}° in the diagram)",
                distance=found.distance,
                alpha=degrees,
                planned=planned,
            )
        marks += found.marks
        rows.append(Row(STATION.with_values(name=name), shown, found.draws))
    title = say("Pressure angles on the profile")
    if not rows:
        none = say(
            "All contact points of the moving phases lie inside other circles: no pressure angle can be measured."
        )
        why = say("The roller presses along the common normal, which runs through its centre.")
        return Step(title, (Part(none),), PROFILE, (), why=why)
    centre = say(
        "In each moving phase, at the station where the pressure angle has its maximum, lay off the velocity v from A, "
        "at the scale of the profile and square to the line on which the follower moves, on the rise {side} as seen "
        "along its motion and on the return to the other side: it ends in I, the instant centre of cam and "
        "follower."
    )
    sides = say("to its left"), say("to its right")
    if "pivots" in profile.givens.inverted.acts:
        centre = say(
            "In each moving phase, at the station where the pressure angle has its maximum, mark I, the instant centre "
            "of cam and follower, on the line of centres, on the rise {side} and on the return the other way: its "
            "distances from A and from the pivot are as v to 1."
        )
        sides = say("beyond A"), say("between A and the pivot")
    drawn = say(
        "Draw the line from I through the point of the pitch curve: it is the common normal, and the contact point "
        "lies on it. Draw the line on which the follower moves, and measure the angle between them with a protractor."
    )
    centre = centre.with_values(side=sides[profile.givens.inverted.givens.rotation == "ccw"])
    why = say(
        "In the instant centre cam and follower have the same velocity, so that the common normal runs through it; the "
        "contact points show this line only as well as the curve is drawn."
    )
    return Step(title, (Part(sequence([centre, drawn], " "), rows=tuple(rows)),), PROFILE, tuple(marks), why=why)


DWELL_ARC_SHARE = 0.82
"""The arc that shows the angle of a lower dwell has this part of the radius there."""


def _arcs_of_dwells(profile: Profile) -> Iterator[Step]:
    """The step of the angles of the arcs of the lower dwells, on which the profile does no work."""
    inverted, measured = profile.givens.inverted, profile.acts.get("radii to the start of the dwells")
    if measured is None:
        return
    sigma, touch = sense(inverted.givens.rotation), profile.acts["touch"].first
    marks, parts = list[Mark](), list[Part]()
    for (k, start, end), angle in zip(low_dwells(inverted), profile.value("low_dwells").tolist(), strict=True):
        if math.isnan(angle):
            continue
        places, direction = touch[[start, end]], float(np.angle(touch[start].place))
        (low, high), degrees = sorted((direction, direction - sigma * angle)), math.degrees(angle)
        symbol = low_dwell_symbol(inverted.givens.integrated.givens.motion, k)
        said = say("{symbol} = {angle:.1f}°", symbol=symbol, angle=degrees)
        radius = DWELL_ARC_SHARE * abs(touch[start].place)
        marks += [
            Segments(0 * places.shown, places.shown, Role.AXIS).left_by(places),
            AngleMark(0j, radius, low, high, said, of=places.act, index=places.index[:1]),
        ]
        names = [_names(profile)[at] for at in (start, end)]
        each = say(
            "Join A to the contact points {start} and {end}, the ends of the arc of the lower dwell on the working "
            "profile, and measure with a protractor the angle between them: {said}; {rest:.1f}° are left of the turn."
        )
        parts.append(Part(each.with_values(start=names[0], end=names[1], said=said, rest=360 - degrees), (places,)))
    if not parts:
        return
    why = say(
        "The follower dwells on an arc about the cam centre, whose angle is that of the dwell; the rest of the "
        "profile, which moves the follower, is its working part."
    )
    yield Step(say("Angle of the lower dwell"), tuple(parts), PROFILE, tuple(marks), why=why)


@dataclass(frozen=True, eq=False)
class ShownAngle:
    """A pressure angle [rad] on the profile at a station, its marks, and what they are of.

    distance : of the instant centre from the cam centre [mm of paper]
    """

    at: int
    angle: float
    distance: float
    marks: tuple[Mark, ...]
    draws: tuple[Drawn, ...]


def _normals(profile: Profile) -> Iterator[ShownAngle]:
    """The normal and the follower's line, where the angle between them is largest in each moving phase.

    None where the contact points of the whole phase are covered.
    """
    hand, inverted = errorless_hand(profile), profile.givens.inverted
    motion, pitch, touch = inverted.acts["motion"].first, inverted.acts["pitch"].first, profile.acts["touch"].first
    centres = _instant_centres(hand, inverted)
    normals = hand.join("normals", centres, pitch)
    alpha = hand.angle("pressure angles", motion, normals)
    lines, beyond = (hand.lay_off(f"far on {d.act.name}", pitch, d, ANGLE_ARC_RADIUS + 4) for d in (motion, normals))
    for span in inverted.givens.integrated.givens.stations.phases:
        angles = np.where(np.isnan(touch.points[span]), np.nan, np.abs(alpha.paper[span]))
        if np.isnan(angles).all():
            continue
        at = int(span.start + np.nanargmax(angles))
        direction, angle, centre = float(np.angle(motion.directions[at])), float(alpha.paper[at]), centres[at]
        start, end = sorted((direction, direction + angle))
        said, index = say("{alpha:.1f}°", alpha=abs(np.degrees(angle))), normals[at].index
        # An instant centre may lie far off the paper: then the normal is drawn towards it.
        towards, place = centre.place - pitch[at].place, pitch[at].place
        near = abs(towards) <= FARTHEST_CENTRE * abs(place)
        inner = centre.place if near else place + towards / abs(towards) * abs(place)
        marks = (
            lines[at].line_from(pitch[at], Role.CONSTRUCTION),
            Line(np.array([inner, beyond[at].place]), Role.LIMIT, of=normals.act, index=index.repeat(2)),
            AngleMark(place, ANGLE_ARC_RADIUS, start, end, said, of=normals.act, index=index),
            *((centre.dots(Role.LIMIT), centre.label("I", towards)) if near else ()),
        )
        draws = (centre, normals[at], beyond[at], lines[at])
        yield ShownAngle(at, angle, float(abs(centre.place)), marks, draws)


def _instant_centres(hand: Hand, inverted: Inverted) -> Drawn:
    """The instant centres of cam and follower at the stations, as the cam is drawn.

    Square to the motion of a stem they lie v from the cam centre; on the line of centres of an arm AI : IC is v : 1.
    """
    integrated, sigma, pivots = inverted.givens.integrated, sense(inverted.givens.rotation), inverted.acts.get("pivots")
    a, v, read = hand.given("cam centre"), integrated.first("v"), integrated.readings["v"]
    if pivots is None:
        factor = read.per_mm / inverted.givens.mu_l.per_mm
        velocity = Setting(v * factor, reading=read, factor=factor)
        return hand.lay_off("instant centres", a, inverted.acts["motion"].first.turned(-UP * sigma), velocity)
    velocity, centres = Setting(v * read.per_mm, reading=read, factor=read.per_mm), hand.join("AC", a, pivots.first)
    divided = calculated_setting(partial(_from_cam_centre, sigma), velocity, distance_between(a, pivots.first))
    return hand.lay_off("instant centres", a, centres, divided)


def _from_cam_centre(sigma: int, velocity: Floats, distance: Floats) -> Floats:
    """How far the instant centre lies from the cam centre towards the pivot of an arm."""
    apart = velocity + sigma
    return distance * velocity / np.where(apart == 0, PARALLEL, apart)


FARTHEST_CENTRE = 2.0
"""An instant centre is shown that is no farther from the pitch curve than so many radii of it."""
PARALLEL = 1e-9
"""Where cam and arm turn alike the instant centre is infinitely far: the normal is parallel to the line of centres."""
ANGLE_ARC_RADIUS = 26.0
"""Radius of the arcs that show a pressure angle on the profile [mm]."""
