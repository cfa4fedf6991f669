"""The least radius from the combined diagram: the shaded region.

Seen from a cam centre A, the angle between A D_i, where D_i is the end of v in the combined diagram, and the line of
motion is the pressure angle; so the tangents to the curve of the D_i at the permitted angles bound the region in which
A may lie.
"""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from graphcam.constructions.adoption import ChainSettings
from graphcam.constructions.axes import degrees, pieces_of
from graphcam.constructions.combined_diagram import (
    combined_scale,
    combined_view,
    curves_step,
    displacement_step,
    offset_caption,
    offset_line,
    side_caption,
    velocities,
)
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import (
    LEAST_RADIUS,
    ON_THE_LINE,
    Boundary,
    RegionPicture,
    binding_boundaries,
    boundary,
    highest_on,
    nearest_permitted,
    picture_of,
    touched_stations,
)
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import AngleMark, Dimension, Line, Mark, Region, Role, Segments
from graphcam.drafting.meaning import (
    OFFSET,
    R0,
    S0,
    SIGMA,
    ComparedReading,
    Formula,
    Meaning,
    ReadingMeaning,
    Symbol,
    Values,
)
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NEGLIGIBLE_SIZE
from graphcam.drafting.telling import introduced_parts
from graphcam.given.follower import Limits, Rotation, sense
from graphcam.words import and_list, say_in, sequence


@dataclass(frozen=True, eq=False)
class LeastRadiusGivens(ChainSettings):
    """What lies on the board; see :func:`least_radius`.

    adopted : tells which cam centre is taken in the end, where one is: the region is drawn as far as there
    """

    integrated: Integrated
    rotation: Rotation
    limits: Limits
    offset: float | None


LeastRadius = Construction[LeastRadiusGivens]


def _touch_values(side: str, drawn: LeastRadius) -> Values:
    """The formula's values: where the tangent of the rise or of the return touches, and its bound for the centre."""
    limits = drawn.givens.limits
    angle = limits.rise if side == "rise" else limits.return_
    if side in drawn.points and angle is not None:
        touch = complex(drawn.first(side)) * drawn.readings["s0"].per_mm
        s, v = touch.imag, abs(touch.real)
        yield {"angle": math.degrees(angle), "s": s, "v": v, "least": v - s * math.tan(angle)}


def _rests(name: str, drawn: LeastRadius) -> Values:
    if name in drawn.points:
        yield {"angle": math.degrees(_limit_of(name, drawn.givens.limits))}


def _radius(drawn: LeastRadius) -> Values:
    """The formula's values: the place of the cam centre and the radius, where one is found."""
    s0, e = (float(drawn.value(name)) for name in ("s0", "offset"))
    if not math.isnan(s0):
        yield {"s0": s0, "e": abs(e), "r0": math.hypot(s0, e)}


FORMULAS = (
    Formula(
        r"s_0\tan[\alpha_1] + \sigma e \ge v_1 - s_1\tan[\alpha_1]",
        r"s_0\tan <angle:g>^\circ + \sigma e \ge <v:.2f> - <s:.2f>\tan <angle:g>^\circ = <least:.2f>\ \text{<mm>}",
        partial(_touch_values, "rise"),
        (
            S0,
            Symbol(r"[\alpha_1]", say("the pressure angle permitted on the rise"), "°"),
            SIGMA,
            OFFSET,
            Symbol("v_1", say("the velocity where the rise line touches the curve"), "mm/rad"),
            Symbol("s_1", say("the displacement there"), "mm"),
        ),
        of="prime_radius",
    ),
    Formula(
        r"s_0\tan[\alpha_2] - \sigma e \ge |v_2| - s_2\tan[\alpha_2]",
        r"s_0\tan <angle:g>^\circ - \sigma e \ge <v:.2f> - <s:.2f>\tan <angle:g>^\circ = <least:.2f>\ \text{<mm>}",
        partial(_touch_values, "return"),
        (
            Symbol(r"[\alpha_2]", say("the pressure angle permitted on the return"), "°"),
            Symbol("v_2", say("the velocity where the return line touches the curve"), "mm/rad"),
            Symbol("s_2", say("the displacement there"), "mm"),
        ),
        of="prime_radius",
    ),
    Formula(
        r"s_0\tan[\alpha_1] - \sigma e \ge 0",
        r"s_0\tan <angle:g>^\circ - \sigma e \ge 0",
        partial(_rests, "rest"),
        of="prime_radius",
    ),
    Formula(
        r"s_0\tan[\alpha_2] + \sigma e \ge 0",
        r"s_0\tan <angle:g>^\circ + \sigma e \ge 0",
        partial(_rests, "rest after the return"),
        of="prime_radius",
    ),
    Formula(
        r"r_0 = \sqrt{s_0^2 + e^2}",
        r"r_0 = \sqrt{<s0:.2f>^2 + <e:.2f>^2} = <r0:.2f>\ \text{<mm>}",
        _radius,
        (R0,),
        of="prime_radius",
    ),
)


MEANING = Meaning(
    "minimum_radius",
    say("Minimum prime radius"),
    say(
        "The minimum radius is found before the cam exists, from displacement and velocity alone: from each "
        "position of the cam centre they are seen at the pressure angles that it would cause."
    ),
    {
        "prime_radius": LEAST_RADIUS,
        "offset": ReadingMeaning(say("offset e"), "e", "mm", (ComparedReading("minimum_offset", say("its offset e")),)),
        "s0": ReadingMeaning(say("distance s₀"), "s₀", "mm"),
    },
    FORMULAS,
)


def least_radius(
    integrated: Integrated, rotation: Rotation, limits: Limits, offset: float | None, pencil: Pencil
) -> LeastRadius:
    """Find the cam centre that is nearest to the start of the lift.

    offset : of the follower's line [mm, machine sign], or None to let it be found
    """
    givens = LeastRadiusGivens(integrated, rotation, limits, offset)
    hand, scale = Hand(pencil, MEANING), combined_scale(integrated)
    start, level = hand.given("start of the lift"), hand.given("zero lift", along=RIGHT)
    lines = _bounds(hand, givens, velocities(hand, integrated, rotation), start)
    hand.cross("rise at zero lift", lines[0], level)
    near = nearest_permitted(hand, "nearest", lines, start)
    highest_on(hand, "central", lines, hand.given("line of motion", along=UP), level)
    if offset is not None:
        near = highest_on(hand, "highest", lines, offset_line(hand, start, integrated, offset), level)
    centre = hand.take("centre", near)
    hand.read("prime_radius", distance_between(start, centre), scale)
    hand.read("offset", distance_between(centre, start, RIGHT), scale)
    hand.read("s0", distance_between(centre, start, UP), scale)
    places = {"ends": hand.acts["ends"], "centre": centre} | {line.act.name: line for line in lines}
    return hand.finished(givens, _draw, places)


def _bounds(hand: Hand, givens: LeastRadiusGivens, ends: Drawn, start: Drawn) -> list[Drawn]:
    """The lines that bound the region: the rise's tangent, the return's unless a spring drives it, the rest lines.

    What a line permits lies to its right: of a line at the angle to the motion that leans to the side on which the
    rise's segments lie, the side away from them.  The return's line and the rest line lean the other way.  At the end
    of a return the angle is the same with the other sign: unless the return permits less than the rise, the tangent of
    the rise cuts off more than a second rest line would.
    """
    sigma, limits, integrated = sense(givens.rotation), givens.limits, givens.integrated

    def touching(name: str, direction: int, limit: float, side: int) -> Drawn:
        """The tangent of the rises (direction +1) or returns (-1) at the permitted angle [rad]."""
        along = hand.protractor(f"direction of {name}", start, -side * UP, side * limit)
        pieces = pieces_of(integrated.givens.motion, integrated.givens.stations, direction)
        return hand.tangent(name, ends, pieces, along.turned(-UP))

    lines = [touching("rise", 1, limits.rise, sigma)]
    if limits.return_ is not None:
        lines.append(touching("return", -1, limits.return_, -sigma))
    if limits.rest:
        lines.append(hand.protractor("rest", start, sigma * UP, -sigma * limits.rise))
        if limits.return_ is not None and limits.return_ < limits.rise:
            lines.append(hand.protractor("rest after the return", start, -sigma * UP, sigma * limits.return_))
    return lines


def active_boundaries(region: LeastRadius) -> list[Boundary]:
    """The boundaries on which the cam centre lies, in the first sample."""
    return binding_boundaries(shown_boundaries(region), complex(region.first("centre")))


def shown_boundaries(region: LeastRadius) -> list[Boundary]:
    """The boundaries of the first sample."""
    return [boundary(region.acts[name].first) for name in LINE_NAMES if name in region.acts]


# --- the steps -------------------------------------------------------------------------------------------------------

ANGLE_RADIUS = 22.0
"""Radius of the arcs that show the permitted angles [mm]."""
HIGHEST_ANGLE_PLACE, LOWEST_ANGLE_PLACE = 0.12, 0.85
"""So far down the lines of the region their angles are shown."""
REST_LINES = "rest", "rest after the return"
"""The lines that are drawn from the start of the lift."""
LINE_NAMES = {
    "rise": say("the rise line"),
    "return": say("the return line"),
    "rest": say("the dwell line"),
    "rest after the return": say("the dwell line of the return"),
}
"""The lines that bound the region, by their names inside a sentence."""
LIMIT_NAMES = {
    "rise": say_in("a limit", "on the rise"),
    "return": say_in("a limit", "on the return"),
    "rest": say_in("a limit", "in the lower dwell"),
    "rest after the return": say_in("a limit", "at the end of the return"),
}
"""Where each of them limits the pressure angle."""
REST_CAPTIONS = {
    "rest": say(
        "From B₀ draw the dwell line at {angle} to the line of motion, down {side}: it keeps the angle in "
        "the lower dwell within its limit."
    ),
    "rest after the return": say(
        "From B₀ draw the dwell line of the return at {angle} to the line of motion, down {side}: it keeps the angle "
        "at the end of the return, where less is permitted than on the rise, within its limit."
    ),
}
CURVE_NAMES = {"rise": say("the curve of the rise"), "return": say("the curve of the return")}
SLIDE_CAPTIONS = {
    1: say("leaning to the right going up, and slide it in from the lower right"),
    -1: say("leaning to the left going up, and slide it in from the lower left"),
}
PLACE_NAMES = {"foot": "A₁", "apex": "A₂", "central": "A₃"}
"""The places that textbooks take besides the nearest one, which is A₀."""
PLACE_CAPTIONS = {
    "foot": say(
        "A₁, the foot of the perpendicular: drop it from B₀ to the rise line with two set squares, {distance:.1f} mm "
        "long."
    ),
    "apex": say("A₂, the apex: mark where the rise line and the return line cross, {distance:.1f} mm from B₀."),
    "central": say(
        "A₃, of a central follower (e = 0): mark where the line of motion enters the region, {distance:.1f} mm from B₀."
    ),
}
"""How each of the textbooks' places of the cam centre is constructed, by the names in ``PLACE_NAMES``."""


def _draw(region: LeastRadius) -> list[Step]:
    centre, lines = region.acts["centre"].first, shown_boundaries(region)
    others = (place.place for place in _alternatives(region).values())
    picture = picture_of((0j, centre.place, *others, *_adopted(region)), lines)
    found = _unreadable(region) if np.isnan(centre.place) else _result(region)
    steps = (
        displacement_step(region, picture.bottom),
        curves_step(region),
        _touching(region, picture),
        _shaded(region, picture),
    )
    return [*steps, found]


def _adopted(region: LeastRadius) -> list[complex]:
    """The adopted cam centre where there is one, else nothing."""
    adopted, mu = region.givens.adopted(), region.readings["prime_radius"].per_mm
    if adopted is None:
        return []
    r0, e = adopted.prime_radius, adopted.place
    return [complex(-e, -np.sqrt((r0 - e) * (r0 + e))) / mu]


def _touching(region: LeastRadius, picture: RegionPicture) -> Step:
    hand, limits = errorless_hand(region), region.givens.limits
    lines = [_limit_line(region, hand, line, picture) for line in shown_boundaries(region)]
    parts = [part for part, _ in lines]
    if not limits.return_:
        none = say("A spring drives the return (force closure), so no line is drawn for the return.")
        parts[-1] = Part(sequence([parts[-1].caption, none], " "), parts[-1].draws)
    why = say(
        "From a point on a tangent the end of v that it touches is seen at exactly the permitted angle to the motion, "
        "and from points below the tangent at less."
    )
    marks = tuple(mark for _, drawn in lines for mark in drawn)
    return Step(
        say("Tangents at the permitted angles"), tuple(parts), combined_view(region.givens.integrated), marks, why=why
    )


def _limit_line(
    region: LeastRadius, hand: Hand, line: Boundary, picture: RegionPicture
) -> tuple[Part, tuple[Mark, ...]]:
    """A boundary from a little above its touch down to the picture's edge, with its angle to the vertical."""
    drawn = region.acts[line.name].first
    direction = region.acts.get(f"direction of {line.name}")
    limit = drawn if direction is None else direction.first
    above = drawn.place - complex(line.along / abs(line.along.imag)) * (0.0 if line.name in REST_LINES else 10.0)
    below = picture.end(line, [other for other in shown_boundaries(region) if other.name != line.name])
    # The angles stand apart, and beside the region: a tangent's not far below its touch, the rest line's low.
    share, way = (LOWEST_ANGLE_PLACE, UP) if line.name in REST_LINES else (HIGHEST_ANGLE_PLACE, -UP)
    at = hand.cross(
        f"{line.name} on its way",
        drawn,
        hand.given(f"level of {line.name}", UP * (drawn.place + share * (below - drawn.place)).imag, RIGHT),
        flat=True,
    )
    upright, angle = hand.erect(f"upright at {line.name}", at), _limit(line, region.givens.limits)
    first, last = sorted((float(np.angle(way)), float(np.angle(-line.along if way == UP else line.along))))
    marks = (
        Line(np.array([above, below]), Role.LIMIT).left_by(drawn),
        Segments(at.shown, at.shown + way * ANGLE_RADIUS * 1.2, Role.CONSTRUCTION).left_by(upright),
        AngleMark(at.place, ANGLE_RADIUS, first, last, angle).left_by(limit),
    )
    lean = float(line.along.real)
    if line.name in REST_LINES:
        said = REST_CAPTIONS[line.name].with_values(angle=angle, side=side_caption(lean))
    else:
        said = say(
            "For the limit {limited} set a set square at {angle} to the line of motion, {slide} until it touches "
            "{curve}: here {where}."
        ).with_values(
            limited=LIMIT_NAMES[line.name],
            angle=angle,
            slide=SLIDE_CAPTIONS[-1 if lean > 0 else 1],
            curve=CURVE_NAMES[line.name],
            where=_touch(region, line.name, drawn.place),
        )
    if line.name == "rise":
        said = sequence([said, _at_zero_lift(region)], " ")
    return Part(said, (drawn, upright) if limit is drawn else (limit, drawn, upright)), marks


def _touch(region: LeastRadius, name: str, touch: complex) -> Caption:
    direction = 1 if name == "rise" else -1
    first, *last = touched_stations(region.givens.integrated, region.acts["ends"].shown, touch, direction)
    if not last:
        return say_in("a touch", "at {name}", name=first)
    return say_in("a touch", "between {first} and {last}", first=first, last=last[0])


def _at_zero_lift(region: LeastRadius) -> Caption:
    """A sentence on how far from the line of motion the rise's boundary meets zero lift."""
    place = region.acts["rise at zero lift"].place
    if np.isnan(place):
        return say("The rise line meets the horizontal through B₀ at too flat an angle to be read.")
    said = say("The rise line meets the horizontal through B₀ {distance:.1f} mm {side} of it.")
    return said.with_values(distance=abs(place.real), side=side_caption(place.real))


def _shaded(region: LeastRadius, picture: RegionPicture) -> Step:
    hand, lines, others = errorless_hand(region), shown_boundaries(region), _alternatives(region)
    permitted = hand.given("permitted places", picture.permitted(lines))
    sides = [
        say(
            "A cam centre {side} of {line} would give more than {angle} {limited}.",
            side=side_caption(-float(line.inward.real)),
            line=LINE_NAMES[line.name],
            angle=_limit(line, region.givens.limits),
            limited=LIMIT_NAMES[line.name],
        )
        for line in lines
    ]
    hatch = say("Hatch the region below the lines that none of them cuts off.")
    marks: list[Mark] = [Region(permitted.points).left_by(permitted)]
    crosses = list[Part]()
    for name, place in others.items():
        strokes = hand.erect(f"cross at {place.act.name}", place.first, np.array([1, UP]))
        starts, tips = (strokes.points + side * 1.5 * strokes.directions for side in (-1, 1))
        marks.append(Segments(starts, tips, Role.CONSTRUCTION).left_by(strokes))
        marks.append(place.first.label(PLACE_NAMES[name], _outside(lines, place.place), small=True))
        crosses.append(Part(PLACE_CAPTIONS[name].with_values(distance=abs(place.place)), (place.first, strokes)))
    chosen = say("Thin crosses mark the points that textbooks choose.")
    parts = Part(sequence([*sides, hatch], " "), (permitted,)), *introduced_parts(chosen, crosses)
    why = say("The cam centre must satisfy all limits at once.")
    return Step(
        say("The region of the cam centre"), parts, combined_view(region.givens.integrated), tuple(marks), why=why
    )


def _outside(lines: list[Boundary], place: complex) -> complex:
    """The direction out of the region at a place on its boundaries."""
    return -sum((complex(line.inward) for line in binding_boundaries(lines, place)), 0j) or 1 - 1j


def _unreadable(region: LeastRadius) -> Step:
    """The last step where no cam centre can be read."""
    said = say(
        "No cam centre can be read: the lines that bound the region cross one another, or the line of the offset, "
        "at less than a degree."
    )
    why = say("Lines at so flat an angle do not show where they cross.")
    return Step(say("The minimum prime radius"), (Part(said),), combined_view(region.givens.integrated), (), why=why)


def _result(region: LeastRadius) -> Step:
    offset, centre, start = region.givens.offset, region.acts["centre"].first, region.acts["start of the lift"].first
    hand, mu = errorless_hand(region), region.readings["prime_radius"].per_mm
    reads = ("prime_radius", "offset", "s0")
    # Adding zero makes a plain zero of the negative one that a central follower's offset is read as.
    paper, values = ({name: float(get(name)) + 0.0 for name in reads} for get in (region.first, region.value))
    joined, x = hand.join("r₀", start, centre), centre.place.real
    level = hand.project("level", centre, hand.given("line of motion", along=UP))
    parts: list[Part] = []
    if offset:
        parts.append(Part(offset_caption(offset, mu), (region.acts["line of the offset"].first,)))
    parts.append(Part(_centre_caption(region), (centre,)))
    measured = say("Join A₀ to B₀ and measure: {paper:.2f} mm × {mu:.5g} = {r0:.3f} mm = r₀.")
    parts.append(Part(measured.with_values(paper=paper["prime_radius"], mu=mu, r0=values["prime_radius"]), (joined,)))
    if abs(x) > ON_THE_LINE:
        carried = say(
            "Carry A₀ horizontally to the line of motion with the T-square: {aside:.2f} mm × {mu:.5g}, so e = "
            "{e:.3f} mm, and {height}."
        ).with_values(
            aside=abs(paper["offset"]), mu=mu, e=values["offset"], height=_height(paper["s0"], mu, values["s0"])
        )
        parts.append(Part(carried, (level,)))
    shown, read = say("min r₀ = {r0:.2f}", r0=values["prime_radius"]), region.readings["prime_radius"].act
    marks = (
        joined.way(Role.LIMIT),
        centre.dots(Role.RESULT),
        centre.label("A₀", towards=-1j + np.sign(x)),
        Dimension(start.place, centre.place, shown, aside=0.0, of=read),
        *_centre_lines(region, level),
    )
    why = say(
        "The nearer the cam centre is to B₀, the smaller the cam, and points of the hatched region satisfy all limits."
    )
    return Step(
        say("The minimum prime radius"), tuple(parts), combined_view(region.givens.integrated), marks, reads, why=why
    )


def _height(paper: float, mu: float, s0: float) -> Caption:
    """A sentence on how far below the start of the lift the cam centre lies."""
    if paper < NEGLIGIBLE_SIZE:
        return say("s₀ = 0, because it lies level with B₀")
    return say("{paper:.2f} mm × {mu:.5g} = {s0:.3f} mm = s₀ below B₀", paper=paper, mu=mu, s0=s0)


def _centre_caption(region: LeastRadius) -> Caption:
    offset, bound = region.givens.offset, [LINE_NAMES[line.name] for line in active_boundaries(region)]
    if offset is None:
        nearest_place = say("The offset is free: A₀ is the point of the hatched region nearest to B₀, {where}.")
        if len(bound) == 1:
            return nearest_place.with_values(where=say("where the perpendicular from B₀ meets {line}", line=bound[0]))
        crossing = say("where it lies on {lines}", lines=and_list(bound))
        return nearest_place.with_values(where=crossing if bound else say("B₀ itself"))
    on = say(", on {lines}", lines=and_list(bound)) if bound else say(", level with B₀")
    if not offset:
        return say("With e = 0, A₀ is where the line of motion itself enters the hatched region{on}.", on=on)
    return say("A₀ is where this vertical enters the hatched region{on}.", on=on)


def _limit(line: Boundary, limits: Limits) -> Caption:
    return degrees(_limit_of(line.name, limits))


def _limit_of(name: str, limits: Limits) -> float:
    of_return = name in ("return", "rest after the return")
    return limits.return_ if of_return and limits.return_ is not None else limits.rise


def _alternatives(region: LeastRadius) -> dict[str, Drawn]:
    """Places that some textbooks take: the apex, the foot on the rise's tangent, the central follower's centre."""
    acts = region.acts
    places = {"foot": acts["foot on rise"], "apex": acts.get("rise and return"), "central": acts["central"][0]}
    return {name: place for name, place in places.items() if place is not None and np.isfinite(place.place)}


def _centre_lines(region: LeastRadius, level: Drawn) -> tuple[Mark, ...]:
    """The follower's line seen from the cam centre, with the distances of the line of motion and of B₀ from it."""
    centre, offset = region.acts["centre"].place, region.givens.offset
    if abs(centre.real) < ON_THE_LINE:
        return ()
    line, e, s0 = region.acts.get("line of the offset"), region.readings["offset"].act, region.readings["s0"].act
    of, index = (line.act, line.first.index.repeat(2)) if offset and line is not None else (None, None)
    shown = say("s₀ = {s0:.2f}", s0=float(region.value("s0")))
    # A length has no sign: the side is seen.
    found = say("e = {e:.2f}", e=abs(float(region.value("offset"))))
    shown_offset = found if offset is None else say("e = {e:g}", e=abs(offset))
    return (
        Line(np.array([centre - 6 * UP, centre.real + 6 * UP]), Role.AXIS, of=of, index=index),
        level.line_from(centre, Role.CONSTRUCTION),
        Dimension(level.place, centre, shown_offset, aside=-8.0, of=e),
        Dimension(0j, level.place, shown, aside=14.0 * np.sign(-centre.real), of=s0),
    )
