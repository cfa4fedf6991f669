"""The least radius from the combined diagram: the shaded region.

At every displacement s_i on the follower's line, v_i is laid off turned by 90 degrees in the sense of the cam's
rotation, to D_i, in the scale of s.  Seen from a cam centre A, the angle between A D_i and the line of motion is the
pressure angle; so the tangents to the curve of the D_i at the permitted angles bound the region in which A may lie.
"""

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import OVERHANG, degrees, numbers, pieces_of, turning
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import (
    LEAST_RADIUS,
    ON_THE_LINE,
    Boundary,
    binding,
    boundary,
    highest_on,
    nearest,
    permitted_part,
)
from graphcam.constructions.views import COMBINED
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, between, showing
from graphcam.drafting.ink import Caption, Construction, Reading, Step, Words, say
from graphcam.drafting.marks import AngleMark, Dimension, Line, Mark, Region, Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.given.follower import Rotation, sense
from graphcam.given.limits import Limits
from graphcam.words import say_in, sequence


@dataclass(frozen=True, eq=False)
class LeastRadiusGivens:
    """What lies on the board; see :func:`least_radius`."""

    integrated: Integrated
    rotation: Rotation
    limits: Limits
    offset: float | None


LeastRadius = Construction[LeastRadiusGivens]


MEANING = Meaning(
    "minimum_radius",
    say("Least prime radius"),
    say(
        "The least radius is found before there is a cam, from displacement and velocity alone: every place of the "
        "cam centre sees them under the pressure angles that it would cause."
    ),
    {
        "prime_radius": LEAST_RADIUS,
        "offset": ReadingMeaning(say("offset e"), "e", "mm", (Compared("minimum_offset", say("its offset e")),)),
        "s0": ReadingMeaning(say("distance s₀"), "s₀", "mm"),
    },
    "report.translating_paragraphs.least_radius",
)


def least_radius(
    integrated: Integrated, rotation: Rotation, limits: Limits, offset: float | None, pencil: Pencil
) -> LeastRadius:
    """Find the cam centre that is nearest to the start of the lift.

    offset : of the follower's line [mm, machine sign], or None to let it be found
    """
    givens = LeastRadiusGivens(integrated, rotation, limits, offset)
    hand, s = Hand(pencil, MEANING), integrated.readings["s"]
    start, level = hand.given("start of the lift"), hand.given("zero lift", along=RIGHT)
    lines = _bounds(hand, givens, velocities(hand, integrated, rotation), start)
    hand.cross("rise at zero lift", lines[0], level)
    near = nearest(hand, "nearest", lines, start)
    highest_on(hand, "central", lines, hand.given("line of motion", along=UP), level)
    if offset is not None:
        near = highest_on(hand, "highest", lines, offset_line(hand, start, offset, s), level)
    centre = hand.take("centre", near)
    hand.read("prime_radius", between(start, centre), s.scale)
    hand.read("offset", between(centre, start, RIGHT), s.scale)
    hand.read("s0", between(centre, start, UP), s.scale)
    places = {"ends": hand.acts["ends"], "centre": centre} | {line.act.name: line for line in lines}
    return hand.finished(givens, _draw, places)


def velocities(hand: Hand, integrated: Integrated, rotation: Rotation) -> Drawn:
    """The ends of v, laid off at the displacements in the scale of s, turned by 90 degrees in the sense of the cam."""
    s, v = integrated.readings["s"], integrated.readings["v"]
    # The heights are projected across from the displacement diagram; the segments are set with dividers, in its scale.
    heights = hand.project("displacements", hand.carry(s), hand.given("line of motion", along=UP))
    return hand.lay_off("ends", heights, -sense(rotation) * RIGHT, hand.carry(v, v.scale / s.scale))


def offset_line(hand: Hand, start: Drawn, offset: float, s: Reading) -> Drawn:
    """The line on which the cam centre lies at an offset [mm], in the scale of s: downwards."""
    return hand.erect("line of the offset", hand.lay_off("offset", start, -RIGHT, hand.at_scale(offset, s)), -UP)


def _bounds(hand: Hand, givens: LeastRadiusGivens, ends: Drawn, start: Drawn) -> list[Drawn]:
    """The lines that bound the region: the rise's tangent, the return's unless a spring drives it, the rest line.

    What a line permits lies to its right: of a line at the angle to the motion that leans to the side on which the
    rise's segments lie, the side away from them.  The return's line and the rest line lean the other way.
    """
    sigma, limits, integrated = sense(givens.rotation), givens.limits, givens.integrated

    def touching(name: str, direction: int, limit: float, side: int) -> Drawn:
        """The tangent at a limit to the curve of the rises (1) or of the returns (-1)."""
        along = hand.protractor(f"direction of {name}", start, -side * UP, side * limit)
        pieces = pieces_of(integrated.givens.motion, integrated.givens.stations, direction)
        return hand.tangent(name, ends, pieces, along.turned(-UP))

    lines = [touching("rise", 1, limits.rise, sigma)]
    if limits.return_ is not None:
        lines.append(touching("return", -1, limits.return_, -sigma))
    if limits.rest:
        lines.append(hand.protractor("rest", start, sigma * UP, -sigma * limits.rise))
    return lines


def active(region: LeastRadius) -> list[Boundary]:
    """The boundaries on which the cam centre lies, in the first sample."""
    return binding(_shown(region), complex(region.first("centre")))


def _shown(region: LeastRadius) -> list[Boundary]:
    """The boundaries of the first sample."""
    return [boundary(region.acts[name].first) for name in LINES if name in region.acts]


# --- the steps -------------------------------------------------------------------------------------------------------

REGION_DEPTH = 14.0
"""How far below the lowest of the marked cam centres the region is shaded [mm]."""
ANGLE_RADIUS = 22.0
"""Radius of the arcs that show the permitted angles [mm]."""
LINES = {"rise": say("rise"), "return": say("return"), "rest": say_in("a line of the region", "rest")}
"""The lines that bound the region, by what they limit."""
PLACES = {"foot": say("foot"), "apex": say("apex"), "central": say("central")}
"""The places that textbooks take besides the nearest one."""


def _draw(region: LeastRadius) -> list[Step]:
    integrated, limits, hand = region.givens.integrated, region.givens.limits, showing(region)
    stations, heights, ends = integrated.givens.stations, region.acts["displacements"], region.acts["ends"]
    v, lines, others = ends.shown.real, _shown(region), _alternatives(region)
    marked = [place.place for place in (region.acts["centre"].first, *others.values()) if not np.isnan(place.place)]
    bottom = min(0.0, *(place.imag for place in marked)) - REGION_DEPTH
    line = (Line(UP * np.array([bottom, float(ends.shown.imag.max()) + OVERHANG]), Role.AXIS),)
    laid_off = (ends.from_(heights, Role.CONSTRUCTION), ends.dots(Role.CONSTRUCTION))
    # The ends of the phases lie on the line of motion and need no number.
    named = numbers(ends, stations, np.sign(v) + 0j, shown=np.abs(v) > 1)
    curves = tuple(hand.fair("curve", ends.first, [piece]).line(Role.RESULT) for piece in stations.pieces)
    alternatives = [mark for name, place in others.items() for mark in _cross(hand, place, PLACES[name])]
    left, right = float(ends.shown.real.min()), float(ends.shown.real.max())
    paper = [complex(left, bottom), complex(right, bottom), complex(right, 0), complex(left, 0)]
    permitted = hand.given("permitted places", permitted_part(lines, paper))
    hatched = Region(permitted.points, permitted.act)
    floor = hand.given("lower edge", UP * bottom, RIGHT)
    marked_on = say(
        "On the follower's line the displacements are marked; at each of them v is laid off in the scale of s, turned "
        "by 90° in the sense of the cam's rotation, {rotation}. The longest measures {longest:.1f} mm."
    ).where(rotation=turning(region.givens.rotation), longest=float(np.abs(v).max()))
    joined = say("The ends are joined by smooth curves, one for the rise and one for the return.")
    leaning = [line for line in lines if line.name != "rest"]
    angles = [say("{angle} {line}", angle=_limit(line, limits), line=LINES[line.name]) for line in leaning]
    touching = say(
        "To each curve that is limited the tangent is drawn at its permitted angle to the line of motion ({angles}); "
        "{zero}{further}"
    ).where(angles=sequence(angles), zero=_at_zero_lift(region), further=_spring_and_rest(limits))
    tangents = tuple(mark for line in lines for mark in _limit_line(region, hand, line, floor))
    shaded = say("Every place in the shaded region keeps all limits; thin crosses mark the alternatives: {names}.")
    shaded = shaded.where(names=sequence([PLACES[name] for name in others]))
    return [
        Step(say("Velocities at the displacements"), marked_on, COMBINED, (*line, *laid_off, *named), given=line),
        Step(say("Curves of rise and return"), joined, COMBINED, curves),
        Step(say("Tangents at the permitted angles"), touching, COMBINED, tangents),
        Step(say("The region of the cam centre"), shaded, COMBINED, (hatched, *alternatives)),
        _result(region),
    ]


def _result(region: LeastRadius) -> Step:
    title, offset = say("The least prime radius"), region.givens.offset
    centre, start = region.acts["centre"].first, region.acts["start of the lift"].first
    if np.isnan(centre.place):
        unreadable = say(
            "No cam centre can be read: the lines that bound the region cross one another, or the line of the offset, "
            "at less than a degree."
        )
        return Step(title, unreadable, COMBINED, ())
    place = say("The place of the region nearest to the start of the lift is the cam centre A.")
    if offset is not None:
        place = say("The highest permitted place on the line at e = {e:g} mm is the cam centre A.", e=offset)
    reads = ("prime_radius", "offset", "s0")
    # Adding zero makes a plain zero of the negative one that a central follower's offset is read as.
    values = {name: float(region.value(name)) + 0.0 for name in reads}
    said = say(
        "{place} {binding} The distance to the start of the lift measures {paper:.2f} mm, so r₀ = {prime_radius:.3f} "
        "mm with e = {offset:.3f} mm and s₀ = {s0:.3f} mm."
    ).where(place=place, binding=_bound_by(active(region)), paper=float(region.first("prime_radius")), **values)
    shown, read = say("r₀ = {r0:.2f}", r0=values["prime_radius"]), region.readings["prime_radius"].act
    marks = (
        showing(region).join("r₀", start, centre).way(Role.LIMIT),
        region.acts["centre"].dots(Role.RESULT),
        centre.label("A", towards=-1j + np.sign(centre.place.real)),
        Dimension(start.place, centre.place, shown, aside=0.0, of=read),
        *_centre_lines(region, centre.place),
    )
    return Step(title, said, COMBINED, marks, reads)


def _at_zero_lift(region: LeastRadius) -> Caption:
    """How far from the line of motion the rise's boundary meets zero lift."""
    place = region.acts["rise at zero lift"].place
    if np.isnan(place):
        return say("the rise's meets zero lift too flatly to be read.")
    return say("the rise's meets zero lift {distance:.1f} mm from the line of motion.", distance=abs(place.real))


def _spring_and_rest(limits: Limits) -> Caption:
    """Which limits there are besides the rise's."""
    further: list[Words] = [""]
    if not limits.return_:
        further.append(say("A spring drives the return, so it does not limit the radius."))
    if limits.rest:
        further.append(say("The rest line keeps the angle at the low rest permitted."))
    return sequence(further, " ")


def _bound_by(lines: list[Boundary]) -> Caption:
    if not lines:
        return say("No line binds it.")
    return say("It lies on the limit of: {lines}.", lines=sequence([LINES[line.name] for line in lines]))


def _limit(line: Boundary, limits: Limits) -> Caption:
    return degrees(limits.return_ if line.name == "return" and limits.return_ is not None else limits.rise)


def _limit_line(region: LeastRadius, hand: Hand, line: Boundary, floor: Drawn) -> tuple[Mark, ...]:
    """The boundary from a little above its touch down to the bottom, with its angle to the vertical."""
    drawn, limit = region.acts[line.name].first, region.acts.get(f"direction of {line.name}", region.acts[line.name])
    above = drawn.place - complex(line.along / abs(line.along.imag)) * (0.0 if line.name == "rest" else 10.0)
    below = hand.cross(f"{line.name} at the edge", drawn, floor, flat=True)
    # The angle is shown where the line has run a third of its way down.
    at = hand.divide(f"{line.name} on its way", drawn, below, 1 / 3)
    upright = hand.erect(f"upright at {line.name}", at)
    first, last = sorted((-np.pi / 2, float(np.angle(line.along))))
    return (
        Line(np.array([above, below.place]), Role.LIMIT, of=drawn.act),
        Segments(at.shown, at.shown - UP * ANGLE_RADIUS * 1.2, Role.CONSTRUCTION, of=upright.act),
        AngleMark(at.place, ANGLE_RADIUS, first, last, _limit(line, region.givens.limits), of=limit.act),
    )


def _alternatives(region: LeastRadius) -> dict[str, Drawn]:
    """Other places that textbooks take: the apex, the foot on the rise's tangent, the central follower's centre."""
    acts = region.acts
    places = {"foot": acts["foot on rise"], "apex": acts.get("rise and return"), "central": acts["central"][0]}
    return {name: place for name, place in places.items() if place is not None and np.isfinite(place.place)}


def _cross(hand: Hand, place: Drawn, name: Caption) -> tuple[Mark, ...]:
    strokes = hand.erect(f"cross at {place.act.name}", place.first, np.array([1, UP]))
    starts, ends = (strokes.points + side * 1.5 * strokes.directions for side in (-1, 1))
    return Segments(starts, ends, Role.CONSTRUCTION, of=strokes.act), place.label(name, towards=1 - 1j, small=True)


def _centre_lines(region: LeastRadius, centre: complex) -> tuple[Mark, ...]:
    """The follower's line seen from the cam centre, and how far the line of motion lies from it."""
    if abs(centre.real) < ON_THE_LINE:
        return ()
    offset, of = region.givens.offset, region.readings["offset"].act
    return (
        Line(np.array([centre - 6 * UP, centre.real + 6 * UP]), Role.AXIS),
        Dimension(1j * centre.imag, centre, "e" if offset is None else say("e = {e:g}", e=offset), aside=-8.0, of=of),
    )
