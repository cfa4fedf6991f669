"""The profile by inversion: the cam stands still and the frame turns about it, against the cam's rotation."""

import math
from dataclasses import dataclass

import numpy as np

from graphcam.constructions import profile_view
from graphcam.constructions.axes import number_labels, sense_caption, station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.euclid import RIGHT, UP, unit
from graphcam.drafting.hand import Hand, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import Dimension, Line, Mark, Role, Segments
from graphcam.drafting.meaning import OFFSET, RADIUS, S0, Formula, Meaning, S, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, Scale
from graphcam.drafting.telling import STATION, circle_caption, run, setting
from graphcam.given.follower import Rotation
from graphcam.given.laws import Floats
from graphcam.words import Words, say_in, sequence


@dataclass(frozen=True, eq=False)
class InversionGivens(profile_view.InvertedGivens):
    """What lies on the board; see :func:`inversion`."""

    offset: float


OffsetInverted = Construction[InversionGivens]


def _worked_values(inverted: OffsetInverted) -> Values:
    """The formula's values: the polar radius at the worked station."""
    givens, stations = inverted.givens, inverted.givens.integrated.givens.stations
    k, e, r0 = profile_view.worked_station(stations), abs(givens.offset), givens.prime_radius
    s0, s = math.sqrt(r0**2 - e**2), float(givens.integrated.value("s")[k])
    yield {"k": station_names(stations)[k], "e": e, "s0": s0, "s": s, "radius": math.hypot(e, s0 + s)}


FORMULAS = (
    Formula(
        r"R = \sqrt{e^2 + (s_0 + s)^2}",
        r"R_{<k>} = \sqrt{<e:.2f>^2 + (<s0:.2f> + <s:.2f>)^2} = <radius:.2f>\ \text{<mm>}",
        _worked_values,
        (RADIUS, OFFSET, S0, S),
        of="radius",
    ),
)


MEANING = Meaning(
    "inversion",
    say("Pitch curve by inversion"),
    say(
        "The cam is held still and the frame is turned about it, against the cam's rotation. In each position "
        "the follower is moved by its displacement: its positions give the cam."
    ),
    profile_view.CURVE_MEANINGS,
    FORMULAS,
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

AXIS_DIMENSION_DEPTH = 3.0
"""How far below the upper end of the axes their distance is dimensioned [mm of paper]."""
MIN_NUMBERED_RADIUS = 12.0
"""The tangents are numbered on the offset circle, if its radius is not less [mm of paper]; else on the prime circle."""


def _draw(inverted: OffsetInverted) -> list[Step]:
    return [_circles(inverted), _positions(inverted), *profile_view.pitch_steps(inverted, _displacement_step(inverted))]


def _side(inverted: OffsetInverted) -> Caption:
    """The end of the offset circle's level diameter at which the follower stands, as a caption."""
    if inverted.givens.offset < 0:
        return say_in("end of a level diameter", "left")
    return say_in("end of a level diameter", "right")


def _circles(inverted: OffsetInverted) -> Step:
    mu_l, e = inverted.givens.mu_l.per_mm, inverted.givens.offset
    start, hand = profile_view.start_of_turn(inverted), errorless_hand(inverted)
    foot = hand.lay_off("foot of the line", hand.given("cam centre"), RIGHT, e / mu_l)
    line = hand.erect("follower's line", foot)
    top = hand.cross("top of the line", line, inverted.acts["prime circle"].first)
    drawn = Line(np.array([foot.place, top.place]), Role.CURVE).left_by(line)
    title, circles, further, parts = say("Prime circle"), tuple[Mark, ...](), tuple[Mark, ...](), list[Part]()
    upright = say("Draw the vertical from A up to the circle: {line}.")
    why = say(
        "With e = 0 the follower's line passes through the cam centre in every position, and s is counted from the "
        "prime circle."
    )
    if e:
        circle, title = inverted.acts["offset circle"], say("Prime circle and offset circle")
        told = circle_caption(say_in("drawn", "the offset circle about A"), "|e|", abs(e), mu_l)
        circles, parts = (circle.drawn_circle(Role.CONSTRUCTION),), [Part(told, (circle,))]
        # The distance of two axes, at the upper end of both.
        high = UP * profile_view.centre_line_end(inverted)
        axis = Line(np.array([top.place, foot.place.real + high]), Role.AXIS).left_by(line)
        ends = sorted((0.0, foot.place.real))
        named = say("{symbol} = {length:g}", symbol="e", length=abs(e))
        level = high - AXIS_DIMENSION_DEPTH * UP
        further = axis, Dimension(ends[0] + level, ends[1] + level, named).left_by(foot)
        upright = say(
            "With e = {e:g} mm draw the vertical from the {side} end of the horizontal diameter of the offset circle "
            "up to the prime circle: {line}."
        ).with_values(e=e, side=_side(inverted))
        why = say(
            "The follower's line passes the cam centre at the distance e in every position, so it always touches the "
            "offset circle; s is counted from the prime circle."
        )
    parts.append(Part(upright.with_values(line=_first_line(inverted)), (foot, line, top)))
    return profile_view.prime_step(inverted, title, start, circles, (*further, drawn), why=why, parts=tuple(parts))


def _first_line(inverted: OffsetInverted) -> Caption:
    """The name of the follower's line at the start of the turn: a motion may begin with a dwell."""
    if inverted.givens.integrated.givens.stations.phi[0]:
        return say("the follower's line at the start of the turn")
    return say("line 0")


def _positions(inverted: OffsetInverted) -> Step:
    stations, e = inverted.givens.integrated.givens.stations, inverted.givens.offset
    motion, starts, feet = (inverted.acts[name] for name in ("motion", "starts", "feet"))
    lines = Segments(motion.shown, starts.shown, Role.CONSTRUCTION).left_by(motion)
    numbered = feet if abs(e) / inverted.givens.mu_l.per_mm >= MIN_NUMBERED_RADIUS else starts
    marks = (lines, *number_labels(numbered, stations, -unit(numbered.shown)))
    said = say(
        "The cam turns {rotation}; hold it still and turn the follower the other way, {against}. Set the protractor on "
        "A and count {against} from {line}, from station to station {steps}, so station {name} at {angle}; draw and "
        "number the rays."
    )
    tangents = say(
        "The cam turns {rotation}; hold it still and turn the follower the other way, {against}. Set the "
        "protractor on A, count {against} from the {side} end of the offset circle, from station to station "
        "{steps}, so station {name} at {angle}; mark these points on the offset circle. At each draw the tangent "
        "with set squares, square to the radius, to the same side as {line}, as far as the prime circle, and number it."
    )
    values = {"side": _side(inverted), "line": _first_line(inverted), **profile_view.position_words(inverted)}
    why = say(
        "Only the motion relative to the cam shapes it: a frame that turns {against} about the fixed cam "
        "is the same as a cam that turns {rotation} in the frame."
    ).with_values(rotation=sense_caption(inverted.givens.rotation), against=profile_view.inversion_sense(inverted))
    title, rays = say("Inverted positions of the follower's line"), inverted.acts["inverted positions"]
    names = station_names(stations)
    turned = run((tangents if e else said).with_values(**values), STATION, names, rays, feet, starts, motion)
    return Step(title, (turned,), PROFILE, marks, why=why)


def _displacement_step(inverted: OffsetInverted) -> Step:
    integrated, starts, pitch = inverted.givens.integrated, inverted.acts["starts"], inverted.acts["pitch"]
    stations, mu_l = integrated.givens.stations, inverted.givens.mu_l.per_mm
    at, moved = profile_view.worked_station(stations), np.flatnonzero(_lengths(inverted))
    drawn = pitch.first[moved].segments_from(starts.first[moved], Role.CONSTRUCTION)
    mu_s, names = integrated.readings["s"].per_mm, station_names(stations)
    said = say(
        "Take s at every station from the displacement diagram with dividers; 1 mm there is {mu_s:.5g} mm × {times:g} "
        "= {factor:.5g} mm here. Lay it off along the line of that station, from the prime circle outward: station "
        "{name}: {length}. The ends are points of the pitch curve."
    ).with_values(
        mu_s=mu_s, times=round(1 / mu_l, 6), factor=mu_s / mu_l, name=names[at], length=setting(pitch.first[at])
    )
    lengths = _lengths(inverted)

    def laid_off(k: int) -> Words:
        """The length at station k, and inward where it is."""
        if not lengths[k]:
            return say("s is zero, so the point lies on the prime circle")
        return say("{length} inward", length=setting(pitch.first[k])) if lengths[k] < 0 else setting(pitch.first[k])

    if (lengths < 0).any():
        said = sequence([said, say("A negative s is laid off inward.")], " ")
    why = say(
        "At s = 0 the trace point is on the prime circle, and in every position it has moved outward "
        "along the follower's line by s."
    )
    part = run(said, STATION, names, pitch, settings=laid_off)
    return Step(say("Displacements laid off"), (part,), PROFILE, (drawn,), profile_view.CURVE_READINGS, why=why)


def _lengths(inverted: OffsetInverted) -> Floats:
    """The lengths laid off at the stations [mm of paper]; 0 where they are less than can be set."""
    s = inverted.givens.integrated.readings["s"]
    lengths = inverted.givens.integrated.first("s") * s.per_mm / inverted.givens.mu_l.per_mm
    return np.where(np.abs(lengths) < NEGLIGIBLE_SIZE, 0.0, lengths)
