"""The profile by inversion: the cam stands still and the frame turns about it, against the cam's rotation."""

from dataclasses import dataclass

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.axes import numbers, station_names, turning
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import RIGHT, UP, unit
from graphcam.drafting.hand import Hand, showing
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import Line, Role, Segments
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.drafting.units import NOTHING
from graphcam.given.follower import Rotation
from graphcam.given.laws import Floats
from graphcam.words import say_in, sequence


@dataclass(frozen=True, eq=False)
class InversionGivens(profile_view.InvertedGivens):
    """What lies on the board; see :func:`inversion`."""

    offset: float


OffsetInverted = Construction[InversionGivens]


MEANING = Meaning(
    "inversion",
    say("Pitch curve by inversion"),
    say(
        "The cam is held still and the frame is turned about it, against the cam's rotation. In each position "
        "the follower is moved by its displacement: its positions give the cam."
    ),
    profile_view.CURVE,
    "report.translating_paragraphs.inversion",
    scales={"profile": "x"},
)


def inversion(
    integrated: Integrated, rotation: Rotation, prime_radius: float, offset: float, mu_l: Scale, pencil: Pencil
) -> OffsetInverted:
    """Lay the displacements off along the follower's line in its inverted positions: the pitch curve.

    mu_l : drawing scale of the profile [mm/mm]
    """
    hand, s = Hand(pencil, MEANING), integrated.readings["s"]
    prime = profile_view.prime_circle(hand, prime_radius, mu_l)
    if offset:
        hand.circle("offset circle", hand.given("cam centre"), abs(offset) / mu_l.per_mm)
        rays = profile_view.inverted_positions(hand, integrated, rotation, RIGHT * np.sign(offset))
        feet = hand.lay_off("feet", rays, rays, abs(offset) / mu_l.per_mm)
        lines = hand.perpendicular("tangents", rays.turned(np.sign(offset)), feet)
    else:
        # A central follower has no circle e: its lines are rays through the cam centre.
        lines = profile_view.inverted_positions(hand, integrated, rotation, UP)
        feet = hand.take("feet", lines)
    motion = hand.take("motion", lines)
    met, touch = hand.cross("circle and lines", motion, prime), hand.project("touch", prime, motion)
    # A line that misses the circle, by the hand's errors, is taken to touch it.
    at = np.arange(integrated.givens.stations.u.size)
    starts = hand.take("starts", met, touch, which=np.where(np.isnan(met.points), at.size + at, at))
    pitch = hand.lay_off("pitch", starts, motion, hand.carry(s, s.scale / mu_l.per_mm))
    profile_view.curve_readings(hand, pitch, mu_l)
    givens = InversionGivens(integrated, rotation, prime_radius, mu_l, offset)
    places = {"feet": feet, "starts": starts, "pitch": pitch, "motion": motion.directions}
    return hand.finished(givens, _draw, places)


# --- the steps -------------------------------------------------------------------------------------------------------

NUMBERED = 12.0
"""The tangents are numbered on the offset circle, if its radius is not less [mm of paper]; else on the prime circle."""


def _draw(inverted: OffsetInverted) -> list[Step]:
    return [_circles(inverted), _positions(inverted), *profile_view.pitch_steps(inverted, _laid_off(inverted))]


def _side(inverted: OffsetInverted) -> Caption:
    """At which end of the offset circle's level diameter the follower stands."""
    if inverted.givens.offset < 0:
        return say_in("end of a level diameter", "left")
    return say_in("end of a level diameter", "right")


def _circles(inverted: OffsetInverted) -> Step:
    """The prime circle, the offset circle, and the follower's line at the start of the turn."""
    mu_l, e, r0 = inverted.givens.mu_l.per_mm, inverted.givens.offset, inverted.givens.prime_radius
    start, hand = profile_view.start_of_turn(inverted), showing(inverted)
    foot = hand.lay_off("foot of the line", hand.given("cam centre"), RIGHT, e / mu_l)
    line = hand.erect("follower's line", foot)
    top = hand.cross("top of the line", line, inverted.acts["prime circle"].first)
    drawn = Line(np.array([foot.place, top.place]), Role.CURVE).left_by(line)
    values = {"r0": r0, "paper": r0 / mu_l, "ratio": ratio_text(mu_l), "line": _first_line(inverted)}
    if not e:
        said = say(
            "Set the compass to {paper:.1f} mm and draw the prime circle, r₀ = {r0:g} mm at {ratio}, about the "
            "cam centre A. Draw the vertical from A to the circle: {line}."
        )
        why = say(
            "Because with e = 0 the follower's line passes through the cam centre in every position, and s "
            "is counted from the prime circle."
        )
        upright = Part(say("Draw the vertical from A up to the circle: {line}.", line=values["line"]), (line, top))
        parts, title, marks = (upright,), say("Prime circle"), (drawn,)
        return profile_view.prime_step(inverted, title, said.where(**values), start, (), marks, why=why, parts=parts)
    said = say(
        "Set the compass to {paper:.1f} mm and draw the prime circle, r₀ = {r0:g} mm at {ratio}, about the cam "
        "centre A; set it to {e_paper:.1f} mm and draw the offset circle, e = {e:g} mm. Draw the vertical that "
        "touches the offset circle on the {side}: {line}."
    ).where(e=e, e_paper=abs(e) / mu_l, side=_side(inverted), **values)
    why = say(
        "Because the follower's line passes the cam centre at the distance e in every position, it always touches the "
        "offset circle; s is counted from the prime circle."
    )
    circle = inverted.acts["offset circle"]
    arrow, of_arrow = profile_view.radius_arrow(inverted, circle, start * UP, "e", abs(e))
    upright = say("Draw the vertical from the {side} end of the offset circle up to the prime circle: {line}.")
    parts = (
        Part(profile_view.compass_said(inverted, "|e|", abs(e)), (circle, *of_arrow)),
        Part(upright.where(side=_side(inverted), line=values["line"]), (line, top)),
    )
    circles, title = (circle.drawn_circle(Role.CONSTRUCTION),), say("Prime circle and offset circle")
    return profile_view.prime_step(inverted, title, said, start, circles, (*arrow, drawn), why=why, parts=parts)


def _first_line(inverted: OffsetInverted) -> Caption:
    """What the follower's line at the start of the turn is called: a motion may begin with a dwell."""
    if inverted.givens.integrated.givens.stations.phi[0]:
        return say("the follower's line at the start of the turn")
    return say("line 0")


def _positions(inverted: OffsetInverted) -> Step:
    """The follower's line in its inverted positions, numbered."""
    stations, e = inverted.givens.integrated.givens.stations, inverted.givens.offset
    motion, starts, feet = (inverted.acts[name] for name in ("motion", "starts", "feet"))
    lines = Segments(motion.shown, starts.shown, Role.CONSTRUCTION).left_by(motion)
    numbered = feet if abs(e) / inverted.givens.mu_l.per_mm >= NUMBERED else starts
    phases, last = profile_view.phase_angles(inverted, profile_view.start_of_turn(inverted))
    marks = (
        lines,
        *numbers(numbered, stations, -unit(numbered.shown)),
        *phases,
    )
    said = say(
        "The cam turns {rotation}; hold it still and turn the follower the other way, {against}. Set the protractor on "
        "A and count {against} from {line}, from station to station {steps}, so station {name} at {angle}; draw and "
        "number the rays. The phases take {angles}."
    )
    tangents = say(
        "The cam turns {rotation}; hold it still and turn the follower the other way, {against}. Set the "
        "protractor on A, count {against} from the {side} end of the offset circle, from station to station "
        "{steps}, so station {name} at {angle}; mark these points on the offset circle. At each draw the tangent "
        "with set squares, square to the radius, to the same side as {line}, and number it. The phases take "
        "{angles}."
    )
    line = _first_line(inverted)
    said = (tangents if e else said).where(side=_side(inverted), line=line, **profile_view.divided_by(inverted))
    why = say(
        "Because only the motion relative to the cam shapes it: a frame that turns {against} about the fixed cam "
        "is the same as a cam that turns {rotation} in the frame."
    ).where(rotation=turning(inverted.givens.rotation), against=profile_view.against(inverted))
    title = say("Inverted positions of the follower's line")
    parts = [_position(inverted, k) for k in range(stations.u.size)]
    return Step(title, said, PROFILE, marks, why=why, parts=(*parts, last))


def _position(inverted: OffsetInverted, k: int) -> Part:
    """The follower's line at one station."""
    rays, *drawn = (inverted.acts[name].first[k] for name in ("inverted positions", "feet", "starts", "motion"))
    ray = say("Station {name}: set off {angle} at A, {against} from {line}, and draw ray {name}.")
    tangent = say(
        "Station {name}: set off {angle} at A, {against} from the {side} end of the offset circle; at this point "
        "draw tangent {name}, square to the radius, as far as the prime circle."
    )
    names = station_names(inverted.givens.integrated.givens.stations)
    said = (tangent if inverted.givens.offset else ray).where(
        name=names[k],
        angle=profile_view.turn_of(inverted, k),
        against=profile_view.against(inverted),
        side=_side(inverted),
        line=_first_line(inverted),
    )
    return Part(said, (rays, *drawn))


def _laid_off(inverted: OffsetInverted) -> Step:
    """The displacements along the follower's lines, from the prime circle."""
    integrated, starts, pitch = inverted.givens.integrated, inverted.acts["starts"], inverted.acts["pitch"]
    stations, s, mu_l = integrated.givens.stations, integrated.first("s"), inverted.givens.mu_l.per_mm
    at, moved = profile_view.worked_station(stations), np.flatnonzero(_lengths(inverted))
    drawn = pitch.first[moved].from_(starts.first[moved], Role.CONSTRUCTION)
    mu_s, names = integrated.readings["s"].per_mm, station_names(stations)
    said = say(
        "Take s at every station from the displacement diagram with dividers; 1 mm there is {mu_s:.4g} mm × {times:g} "
        "= {factor:.4g} mm here. Lay it off along the line of that station, from the prime circle outward: station "
        "{name}: {s:.2f} mm × {factor:.4g} = {length:.1f} mm. Repeat for the others; the longest is {longest:.1f} mm. "
        "The ends are points of the pitch curve."
    ).where(
        mu_s=mu_s,
        times=round(1 / mu_l, 6),
        factor=mu_s / mu_l,
        name=names[at],
        s=s[at],
        length=s[at] * mu_s / mu_l,
        longest=float(np.abs(pitch.shown - starts.shown).max()),
    )
    if (_lengths(inverted) < 0).any():
        said = sequence([said, say("A negative s is laid off inward.")], " ")
    why = say(
        "Because at s = 0 the trace point is on the prime circle, and in every position it has moved outward "
        "along the follower's line by s."
    )
    parts = tuple(Part(_length_said(inverted, k), (pitch.first[k],)) for k in range(stations.u.size))
    reads = profile_view.CURVE_READINGS
    return Step(say("Displacements laid off"), said, PROFILE, (drawn,), reads=reads, why=why, parts=parts)


def _lengths(inverted: OffsetInverted) -> Floats:
    """What is laid off at the stations [mm of paper]; nothing where it is less than can be set."""
    s = inverted.givens.integrated.readings["s"]
    lengths = inverted.givens.integrated.first("s") * s.per_mm / inverted.givens.mu_l.per_mm
    return np.where(np.abs(lengths) < NOTHING, 0.0, lengths)


def _length_said(inverted: OffsetInverted, k: int) -> Caption:
    """What is laid off at one station."""
    integrated, length = inverted.givens.integrated, float(_lengths(inverted)[k])
    name = station_names(integrated.givens.stations)[k]
    if not length:
        return say("Station {name}: s is zero, so the point lies on the prime circle.", name=name)
    outward = say("Station {name}: lay off {s:.2f} mm × {factor:.4g} = {length:.2f} mm from the prime circle outward.")
    inward = say("Station {name}: lay off {s:.2f} mm × {factor:.4g} = {length:.2f} mm from the prime circle inward.")
    return (outward if length > 0 else inward).where(
        name=name,
        s=abs(float(integrated.first("s")[k])),
        factor=integrated.readings["s"].per_mm / inverted.givens.mu_l.per_mm,
        length=abs(length),
    )
