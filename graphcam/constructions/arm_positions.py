"""An arm in its positions about its pivot, with the velocity of its end laid off along it in each.

The displacements are angles of the arm.  l v is laid off from its end B along it, outward when cam and arm turn in
opposite senses on the rise, towards the pivot when in the same sense, to D: seen from there, the cam centre makes the
pressure angle with the arm's normal.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import clear_numbers, numbered, numbers, station_names, turning
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import REGION, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP, circles_meet, unit
from graphcam.drafting.hand import Hand, showing
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import Arc, Line, Points, Role
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.drafting.units import NOTHING
from graphcam.given.follower import Rotation, sense
from graphcam.given.stations import Stations
from graphcam.words import sequence


@dataclass(frozen=True, eq=False)
class ArmGivens:
    """An arm of a length [mm] with its motion, and the scale at which it is drawn [mm/mm]."""

    integrated: Integrated
    rotation: Rotation
    arm: float
    mu_l: Scale


ArmPositions = Construction[ArmGivens]


def arm_positions(
    hand: Hand, integrated: Integrated, rotation: Rotation, arm: float, mu_l: Scale
) -> Mapping[str, Drawn]:
    """Lay the displacements off as angles of the arm, and the velocities as segments along it.

    integrated : of an angle s [rad];  arm : length [mm];  mu_l : scale of the drawing [mm/mm]
    returns : by name the ``pivot``; the ``arm at rest``, on its left, with its end, the ``start``; the ``arms``, that
        swing clockwise from there, with their ``ends`` B; and the ``tips`` D of the segments
    """
    pivot, length, (s, v) = hand.given("pivot"), arm / mu_l.per_mm, (integrated.readings[name] for name in "sv")
    arc = hand.circle("arc of the arm", pivot, length)
    hand.cross("start", hand.erect("arm at rest", pivot, -RIGHT), arc)
    ends = hand.cross("ends", hand.protractor("swung", pivot, -RIGHT, hand.carry(s, -np.asarray(s.scale))), arc)
    outward = hand.join("arms", pivot, ends).turned(sense(rotation))
    hand.lay_off("tips", ends, outward, hand.carry(v, length * np.asarray(v.scale)))
    return hand.acts


def cam_centre(arm: float, distance: float, prime_radius: float, *, flat: bool = False) -> complex:
    """The cam centre [mm] from the pivot, the arm at rest on its left; NaN where the three lengths close no triangle.

    flat : to take the nearest place, where they close none
    """
    return complex(circles_meet(np.asarray(0j), distance, np.asarray(-arm + 0j), prime_radius, flat=flat))


def directions(givens: ArmGivens) -> NDArray[np.intp]:
    """At each station 1 on a rise, -1 on a return."""
    motion, stations = givens.integrated.givens.motion, givens.integrated.givens.stations
    return np.array([motion.phases[k].direction for k in stations.phase])


# --- the steps -------------------------------------------------------------------------------------------------------

BEYOND = 0.03
"""How far an arc is drawn beyond what it is drawn for [rad]."""
SMALLEST_ANGLE = 0.5
"""Less cannot be set off with a protractor that is divided into degrees, but with dividers on the arc [degrees]."""
NEAR = 1.0
"""Arms whose ends are nearer to one another bear one number [mm]."""


def example(integrated: Integrated, places: Drawn, direction: int = 1) -> int:
    """The station that is worked as an example: of those that are named the fastest of the rises, or the returns."""
    v, named = direction * integrated.first("v"), numbered(places.shown, integrated.givens.stations)
    return int(np.argmax(np.where(np.isin(np.arange(v.size), named), v, v / 2)))


def arc_through(circle: Drawn, places: Points, beyond: float = BEYOND) -> Arc:
    """The part of one circle that places lie on, drawn a little beyond them [rad]."""
    ways = places - circle.place
    turns = np.angle(ways[0]) + np.angle(ways / ways[0])
    radius, role = float(np.asarray(circle.first.radius).item()), Role.CONSTRUCTION
    return Arc(circle.place, radius, turns.min() - beyond, turns.max() + beyond, role, "").left_by(circle)


def stroke(line: Drawn, length: float) -> Line:
    """So much of one line, from its place on [mm]."""
    ends = line.place + np.array([0, length]) * complex(unit(line.first.directions))
    return Line(ends, Role.CONSTRUCTION).left_by(line)


def along_the_arm(way: float) -> Caption:
    """In which sense something is laid off along the arm from its end: outward where it is positive."""
    return say("away from C") if way > 0 else say("towards C")


def positions_step(drawn: ArmPositions) -> Step:
    """The arm in all its positions, its displacements set off as angles."""
    integrated, mu_l, acts = drawn.givens.integrated, drawn.givens.mu_l, drawn.acts
    pivot, start, ends, arms, arc = (acts[name] for name in ("pivot", "start", "ends", "arms", "arc of the arm"))
    level = acts["arm at rest"]
    stations, s, k = integrated.givens.stations, integrated.first("s"), example(integrated, acts["tips"])
    factor, arm = np.degrees(integrated.readings["s"].per_mm), drawn.givens.arm / mu_l.per_mm
    worked = say("{paper:.2f} mm × {factor:.4g}°/mm = {angle:.2f}°")
    angles = [worked.where(paper=paper, factor=factor, angle=paper * factor) for paper in s.tolist()]
    said = say(
        "Mark the pivot C on the right. At {ratio} the arm is {arm:.1f} mm long: draw CB₀ horizontally to the "
        "left, and with the compass an arc of {arm:.1f} mm about C. Multiply every ordinate of the displacement "
        "by {factor:.4g}°/mm and set the angle off at C with the protractor, upwards from CB₀ (clockwise), as "
        "far as the arc. Station {name}: {angle}. Repeat for the others and number them; the largest angle is "
        "{most:.2f}°."
    ).where(ratio=ratio_text(mu_l.per_mm), arm=arm, factor=factor, most=s.max() * factor, angle=angles[k])
    base = say(
        "Draw CB₀ horizontally to the left from C, {arm:.1f} mm long, and an arc of {arm:.1f} mm about C.", arm=arm
    )
    down = say("Arm {name}: the displacement is zero, so it lies on CB₀.")
    up = say("Arm {name}: {angle}; set it off at C upwards from CB₀ and draw the arm as far as the arc.")
    names, given = station_names(stations), (pivot.dots(), pivot.label("C", 1 + 0j))
    parts = [
        by_dividers((up if abs(turn) > NOTHING else down).where(name=names[n], angle=angles[n]), turn, chord)
        for n, (turn, chord) in enumerate(zip((s * factor).tolist(), np.abs(ends.shown - start.place), strict=True))
    ]
    towards = ends.shown * (1 - UP * directions(drawn.givens))
    marks = (
        *(*given, start.label("B₀", -UP, small=True)),
        stroke(level, abs(start.place - level.place)),
        arc_through(arc, np.append(ends.shown, start.place)),
        *(arms.ways(Role.CONSTRUCTION), ends.dots(Role.CONSTRUCTION)),
        *numbers(ends, stations, towards, shown=_first_here(ends, start, stations)),
    )
    return Step(
        *(say("Arm positions"), said.where(name=names[k]), at_scale(REGION, mu_l), marks),
        given=given,
        why=say("Because the displacement of an arm is the angle through which it turns about its pivot."),
        parts=(Part(base, (level, arc, start)), *(Part(part, (arms[n], ends[n])) for n, part in enumerate(parts))),
    )


def by_dividers(said: Caption, turn: float, chord: float) -> Caption:
    """How an angle [degrees] of an arm is set off, and what is to be done with a small one: its chord [mm of paper]."""
    if not NOTHING < abs(turn) < SMALLEST_ANGLE:
        return said
    small = say(
        "The angle is too small for the protractor: with dividers set off {chord:.2f} mm along the arc.", chord=chord
    )
    return sequence([said, small], " ")


def _first_here(ends: Drawn, start: Drawn, stations: Stations) -> NDArray[np.bool_]:
    """At which stations the arm lies neither on CB₀ nor where one lies in an earlier phase: its number has room."""
    near = np.abs(np.subtract.outer(ends.shown, ends.shown)) < NEAR
    earlier = np.less.outer(stations.moving, stations.moving).T
    named = np.logical_or.reduce(near & earlier, axis=1) | (np.abs(ends.shown - start.place) < NEAR)
    return np.logical_not(named) & clear_numbers(ends.shown, stations, np.array([start.place]))


def velocities_step(drawn: ArmPositions) -> Step:
    """The velocity of the arm's end laid off along it in all positions, and the curves through the ends D."""
    integrated, sigma = drawn.givens.integrated, sense(drawn.givens.rotation)
    ends, tips = drawn.acts["ends"], drawn.acts["tips"]
    stations, v, k = integrated.givens.stations, integrated.first("v"), example(integrated, tips)
    names, mu, arm = station_names(stations), integrated.readings["v"].per_mm, drawn.givens.mu_l.paper(drawn.givens.arm)
    worked, smooth = say("{paper:.2f} mm × {factor:.4g} = {length:.2f} mm"), showing(drawn)
    lengths = [worked.where(paper=paper, factor=arm * mu, length=arm * mu * paper) for paper in np.abs(v).tolist()]
    said = say(
        "Multiply every ordinate of the velocity by l·μᵥ = {arm:.1f} mm × {mu:.4g}/mm = {factor:.4g} and lay it off "
        "with dividers along the arm from its end, to D: on the rise {rise}, on the return {back}. Station {name}: "
        "{length}. Repeat for the others and join the ends D by smooth curves."
    ).where(arm=arm, mu=mu, factor=arm * mu, rise=along_the_arm(sigma), back=along_the_arm(-sigma))
    none = say("D{name}: the velocity is zero, so D is the end of the arm.")
    some = say("D{name}: {length}; lay it off from the end of arm {name} along it, {side}.")
    parts = list[Part]()
    for n, way in enumerate(arm * mu * v):
        text = some.where(length=lengths[n], side=along_the_arm(sigma * way)) if abs(way) > NOTHING else none
        parts.append(Part(text.where(name=names[n]), (tips[n],)))
    curves = [smooth.fair(f"curve of the tips {n}", tips.first, [piece]) for n, piece in enumerate(stations.pieces)]
    for curve, piece in zip(curves, stations.pieces, strict=True):
        text = say("Join D{first} to D{last} through those between by a smooth curve, with the French curve.")
        parts.append(Part(text.where(first=names[piece.start], last=names[piece.stop - 1]), (curve,)))
    marks = (
        *(tips.from_(ends, Role.CURVE), *(curve.line(Role.RESULT) for curve in curves)),
        *numbers(tips, stations, tips.shown, shown=clear_numbers(tips.shown, stations, ends.shown)),
    )
    why = say(
        "Because the end of the arm has the velocity l·ds/dφ square to the arm; turned by 90° in the sense of the "
        "cam's rotation ({rotation}) it lies along the arm."
    ).where(rotation=turning(drawn.givens.rotation))
    said, view = said.where(name=names[k], length=lengths[k]), at_scale(REGION, drawn.givens.mu_l)
    return Step(say("Velocities along the arm"), said, view, marks, why=why, parts=tuple(parts))
