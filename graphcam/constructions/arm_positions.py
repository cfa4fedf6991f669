"""An arm in its positions about its pivot, with the velocity of its end laid off along it in each.

The displacements are angles of the arm.  l v is laid off from its end B along it, outward when cam and arm turn in
opposite senses on the rise, towards the pivot when in the same sense, to D: seen from there, the cam centre makes the
pressure angle with the arm's normal.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import clear_numbers, number_labels, numbered_stations, sense_caption, station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import PICTURE_MARGIN, Boundary, RegionPicture
from graphcam.constructions.views import CAM_CENTRE, REGION, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP, circle_crossing, unit
from graphcam.drafting.hand import Hand, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, Words, say
from graphcam.drafting.marks import Arc, Label, Line, Mark, Points, Region, Role
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, Ratios, Scale, ratio_text, standard_scale
from graphcam.drafting.telling import STATION, run, setting, stretch_caption
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
    """The cam centre [mm] from the pivot, the arm at rest on the left; NaN where the three lengths close no triangle.

    flat : to take the nearest place, where they close none
    """
    return complex(circle_crossing(np.asarray(0j), distance, np.asarray(-arm + 0j), prime_radius, flat=flat))


def lift_directions(integrated: Integrated) -> NDArray[np.intp]:
    """The direction of the lift at the stations (n,): 1 on a rise, -1 on a return."""
    motion, stations = integrated.givens.motion, integrated.givens.stations
    return np.array([motion.phases[k].direction for k in stations.phase])


# --- the steps -------------------------------------------------------------------------------------------------------

ARC_OVERHANG = 0.03
"""How far an arc is drawn beyond what it is drawn for [rad]."""
MIN_PROTRACTOR_ANGLE = 0.5
"""Less cannot be set off with a protractor that is divided into degrees, but with dividers on the arc [degrees]."""
SAME_POSITION = 1.0
"""Arms whose ends are nearer to one another bear one number [mm]."""


def example_station(integrated: Integrated, places: Drawn, direction: int = 1) -> int:
    """The worked station: of the rises or of the returns the fastest, rather one that is named."""
    v, named = direction * integrated.first("v"), numbered_stations(places.shown, integrated.givens.stations)
    preferred = np.where(np.isin(np.arange(v.size), named), v, v / 2)
    # A short phase has no named station that moves, and a pencil lets the dwells move.
    return int(np.argmax(np.where(lift_directions(integrated) == direction, preferred, -np.inf)))


def arc_through(circle: Drawn, places: Points, beyond: float = ARC_OVERHANG) -> Arc:
    """The part of a circle on which places lie, drawn a little beyond them [rad]."""
    ways = places - circle.place
    turns = np.angle(ways[0]) + np.angle(ways / ways[0])
    radius, role = float(np.asarray(circle.first.radius).item()), Role.CONSTRUCTION
    return Arc(circle.place, radius, turns.min() - beyond, turns.max() + beyond, role, "").left_by(circle)


def stroke(line: Drawn, length: float) -> Line:
    """A line from its place on, ``length`` mm long."""
    ends = line.place + np.array([0, length]) * complex(unit(line.first.directions))
    return Line(ends, Role.CONSTRUCTION).left_by(line)


def arm_sense_caption(way: float) -> Caption:
    """The sense along the arm from its end in which something is laid off: outward where it is positive."""
    return say("away from C") if way > 0 else say("towards C")


def positions_step(drawn: ArmPositions) -> Step:
    """The step that draws the arm in all its positions, its displacements set off as angles."""
    integrated, mu_l, acts = drawn.givens.integrated, drawn.givens.mu_l, drawn.acts
    pivot, start, ends, arms, arc = (acts[name] for name in ("pivot", "start", "ends", "arms", "arc of the arm"))
    level = acts["arm at rest"]
    stations, s, k = integrated.givens.stations, integrated.first("s"), example_station(integrated, acts["tips"])
    factor, arm = np.degrees(integrated.readings["s"].per_mm), drawn.givens.arm / mu_l.per_mm
    names, given, turns = station_names(stations), (pivot.dots(), pivot.label("C", 1 + 0j)), s * factor
    base = say(
        "Mark the pivot C on the right. At {ratio} the arm is {arm:.1f} mm long: draw CB₀ horizontally to the left, "
        "and with the compass an arc of {arm:.1f} mm about C."
    ).with_values(ratio=ratio_text(mu_l.per_mm), arm=arm)
    said = say(
        "Multiply every ordinate of the displacement by {factor:.5g}°/mm, set the angle off at C with the protractor, "
        "upwards from CB₀ (clockwise), draw the arm there as far as the arc and number it. Station {name}: {angle}. "
        "The largest angle is {most:.2f}°."
    ).with_values(factor=factor, name=names[k], angle=turning_angle(s[k], factor), most=s.max() * factor)

    small = (np.abs(turns) > NEGLIGIBLE_SIZE) & (np.abs(turns) < MIN_PROTRACTOR_ANGLE)
    if small.any():
        by_dividers = say("An angle too small for the protractor is set off along the arc with the dividers.")
        said = sequence([said, by_dividers], " ")

    def swung(n: int) -> Words:
        """The angle of station n, and its chord on paper where the protractor is too coarse."""
        angle, chord = turning_angle(s[n], factor), abs(ends.shown[n] - start.place)
        return say("{angle}, {chord:.2f} mm along the arc", angle=angle, chord=chord) if small[n] else angle

    towards = ends.shown * (1 - UP * lift_directions(drawn.givens.integrated))
    marks = (
        *(*given, start.label("B₀", -UP, small=True)),
        stroke(level, abs(start.place - level.place)),
        arc_through(arc, np.append(ends.shown, start.place)),
        *(arms.segments(Role.CONSTRUCTION), ends.dots(Role.CONSTRUCTION)),
        *number_labels(ends, stations, towards, shown=_first_at_place(ends, start, stations)),
    )
    swings = run(said, STATION, names, arms, ends, settings=swung)
    return Step(
        say("Arm positions"),
        (Part(base, (level, arc, start)), swings),
        *(at_scale(REGION, mu_l), marks),
        given=given,
        why=say("The displacement of an arm is the angle through which it turns about its pivot."),
    )


def turning_angle(paper: float, factor: float) -> Words:
    """The angle [degrees] that an arm is turned by for an ordinate of the displacement [mm of paper]."""
    if abs(paper * factor) < NEGLIGIBLE_SIZE:
        return "0°"
    return say("{paper:.2f} mm × {factor:.5g}°/mm = {angle:.2f}°", paper=paper, factor=factor, angle=paper * factor)


def _first_at_place(ends: Drawn, start: Drawn, stations: Stations) -> NDArray[np.bool_]:
    """The stations (n,) whose arm lies neither on CB₀ nor where an earlier phase has one: their numbers have room."""
    near = np.abs(np.subtract.outer(ends.shown, ends.shown)) < SAME_POSITION
    earlier = np.less.outer(stations.moving, stations.moving).T
    named = np.logical_or.reduce(near & earlier, axis=1) | (np.abs(ends.shown - start.place) < SAME_POSITION)
    return np.logical_not(named) & clear_numbers(ends.shown, stations, np.array([start.place]))


def velocities_step(drawn: ArmPositions) -> Step:
    """The step that lays the velocity off along the arm in all positions, with the curves through the ends D."""
    integrated, sigma = drawn.givens.integrated, sense(drawn.givens.rotation)
    ends, tips = drawn.acts["ends"], drawn.acts["tips"]
    stations, v, k = integrated.givens.stations, integrated.first("v"), example_station(integrated, tips)
    names, mu, arm = station_names(stations), integrated.readings["v"].per_mm, drawn.givens.mu_l.paper(drawn.givens.arm)
    said = say(
        "Multiply every ordinate of the velocity by l·μᵥ = {arm:.1f} mm × {mu:.5g}/mm = {factor:.5g} and lay it off "
        "with dividers along the arm from its end, to D: on the rise {rise}, on the return {back}. Station {name}: "
        "{length}."
    ).with_values(
        arm=arm, mu=mu, factor=arm * mu, rise=arm_sense_caption(sigma), back=arm_sense_caption(-sigma), name=names[k]
    )

    def laid_off(n: int) -> Words:
        """The length at station n, and the side to which it is laid off."""
        length = setting(tips.first[[n]])
        return length if length == "0" else say("{length} {side}", length=length, side=arm_sense_caption(sigma * v[n]))

    hand, pieces = errorless_hand(drawn), stations.pieces
    curves = [hand.fair(f"curve of the tips {n}", tips.first, [piece]) for n, piece in enumerate(pieces)]
    through = tuple(
        Row(stretch_caption(f"D{names[piece.start]}", f"D{names[piece.stop - 1]}"), "", (curve,))
        for curve, piece in zip(curves, pieces, strict=True)
    )
    smooth = say("Join the ends D by smooth curves with the French curve, from jump to jump of the acceleration.")
    laid = run(said.with_values(length=setting(tips.first[[k]])), STATION, names, tips, settings=laid_off)
    marks = (
        *(tips.segments_from(ends, Role.CURVE), *(curve.line(Role.RESULT) for curve in curves)),
        *number_labels(tips, stations, tips.shown, shown=clear_numbers(tips.shown, stations, ends.shown)),
    )
    why = say(
        "The end of the arm has the velocity l·ds/dφ square to the arm; turned by 90° in the sense of the cam's "
        "rotation ({rotation}) it lies along the arm."
    ).with_values(rotation=sense_caption(drawn.givens.rotation))
    view = at_scale(REGION, drawn.givens.mu_l)
    return Step(say("Velocities along the arm"), (laid, Part(smooth, rows=through)), view, marks, why=why)


SMALL_RADIUS, ENLARGED_RADIUS = 30.0, 60.0
"""Where the adopted prime radius is shorter than this on the arm positions, it is shown at the largest standard scale
at which it is not longer than that [mm]."""
HATCHING_MARGIN = 20.0
"""So far beside the places that it shows the region is hatched [mm]."""


def detail_scale(prime_radius: float, mu_l: Scale, ratios: Ratios) -> Scale | None:
    """The scale of the detail for an adopted prime radius [mm], or None where the arm positions are large enough.

    >>> from graphcam.drafting.scale import ISO_5455
    >>> [detail_scale(radius, Scale(1.0, "mm"), ISO_5455) for radius in (12.0, 61.0)]
    [Scale(per_mm=0.2, unit='mm'), None]
    """
    if mu_l.paper(prime_radius) >= SMALL_RADIUS:
        return None
    scale = standard_scale(prime_radius, ENLARGED_RADIUS, ratios)
    return scale if scale.per_mm < mu_l.per_mm else None


def enlarged_region_step(
    region: ArmPositions,
    scale: Scale,
    lines: Sequence[Boundary],
    bind: Sequence[tuple[Drawn, Caption]],
    adopted: Sequence[complex],
) -> Step:
    """The step that enlarges the region about the cam centre found.

    lines : all that bound it;  bind : those on which the cam centre lies, with their names
    adopted : the cam centre that is taken in the end, on the arm positions: the region is hatched as far as there
    """
    hand, start, centre = errorless_hand(region), region.acts["start"].first, region.acts["centre"].first[0]
    times = region.givens.mu_l.per_mm / scale.per_mm
    b, a = (hand.enlarged(name, drawn, start, times) for name, drawn in (("B₀", start), ("A₀", centre)))
    shown: Points = np.array([b.place, a.place, *((place - start.place) * times for place in adopted)])
    left, right, bottom = (
        shown.real.min() - HATCHING_MARGIN,
        shown.real.max() + HATCHING_MARGIN,
        shown.imag.min() - PICTURE_MARGIN,
    )
    picture = RegionPicture(float(left), float(right), float(bottom), 0.0)
    enlarged = [Boundary("", (line.touch - start.place) * times, line.inward) for line in lines]
    permitted = hand.given("permitted places", picture.permitted(enlarged))
    marks: list[Mark] = [Region(permitted.points).left_by(permitted), *(b.dots(Role.CONSTRUCTION), b.label("B₀", UP))]
    through = list[Drawn]()
    for k, (line, name) in enumerate(bind):
        drawn = hand.enlarged(f"line {k} through A₀", line, start, times)
        through.append(drawn)
        way = complex(unit(np.asarray(a.place - drawn.place)))
        above, below = min(abs(a.place - drawn.place), abs(a.place)), (a.place.imag - bottom) / max(-way.imag, 0.5)
        ends = a.place + way * np.array([-above, below])
        marks.append(Line(ends, Role.LIMIT).left_by(drawn))
        marks.append(Label(complex(ends[1]), name, way, small=True).left_by(drawn))
    marks += [a.dots(Role.RESULT), a.label("A₀", 1 + 0j if a.place.real > 0 else -1 + 0j)]
    first = say("Draw B₀ and A₀ again at {ratio}, {paper:.1f} mm from one another.")
    first = first.with_values(ratio=ratio_text(scale.per_mm), paper=abs(a.place))
    second = say("Draw the lines on which A₀ lies, and hatch again the region that no line cuts off.")
    return Step(
        *(say("The cam centre enlarged"), (Part(first, (b, a)), Part(second, (*through, permitted)))),
        *(at_scale(CAM_CENTRE, scale), tuple(marks)),
        why=say("At the scale of the arm, points so close to its end cannot be told apart."),
    )


def enlarged_centre_step(measured: Construction[Any], scale: Scale, label: Caption) -> Step:
    """The step that marks the adopted cam centre in the enlarged region."""
    hand, start, centre = errorless_hand(measured), measured.acts["start"].first, measured.acts["centre"].first
    a = hand.enlarged("A", centre, start, measured.givens.mu_l.per_mm / scale.per_mm)
    said = say("Mark A in the enlarged drawing too, {paper:.1f} mm from B₀.", paper=abs(a.place))
    return Step(
        *(say("The adopted cam centre enlarged"), (Part(said, (a,)),), at_scale(CAM_CENTRE, scale)),
        (a.dots(Role.RESULT), a.label(label, -UP)),
        why=say("The enlarged drawing shows that A lies in the hatched region."),
    )
