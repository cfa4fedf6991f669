"""The least radius from the combined diagram: the shaded region.

At every displacement s_i on the follower's line, v_i is laid off turned by 90 degrees in the sense of the cam's
rotation, to D_i, in the scale of s.  Seen from a cam centre A, the angle between A D_i and the line of motion is the
pressure angle; so the tangents to the curve of the D_i at the permitted angles bound the region in which A may lie.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import OVERHANG, degrees, numbers, pieces_of, turning
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import (
    LEAST_RADIUS,
    ON_THE_LINE,
    Boundary,
    binding,
    lowest_on,
    nearest,
    permitted_part,
)
from graphcam.constructions.views import COMBINED
from graphcam.drafting.curve import faired, farthest_of
from graphcam.drafting.euclid import UP, foot, meet, turned
from graphcam.drafting.ink import Caption, Construction, Step, Words, say
from graphcam.drafting.marks import AngleMark, Dimension, Dots, Label, Line, Mark, Points, Region, Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.given.follower import Rotation, sense
from graphcam.given.limits import Limits
from graphcam.words import say_in, sequence

START = np.zeros((), dtype=complex)
"""The start of the lift, the origin of the combined diagram."""


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
    integrated: Integrated,
    rotation: Rotation,
    limits: Limits,
    offset: float | None,
    pencil: Pencil,
) -> LeastRadius:
    """Find the cam centre that is nearest to the start of the lift.

    integrated : from :func:`~graphcam.constructions.integration.integration`
    offset : of the follower's line [mm, machine sign], or None to let it be found

    Readings: ``prime_radius``, ``offset`` and ``s0`` [mm].
    """
    hand = pencil.hand("minimum_radius")
    s, v, stations = integrated.readings["s"], integrated.readings["v"], integrated.givens.stations
    mu, count = s.scale, stations.u.size
    # The heights are projected across from the displacement diagram; the segments are set with dividers, in its scale.
    segment = v.value / np.asarray(mu)[..., None] + hand.dividers(count)
    ends = -sense(rotation) * segment + UP * (s.paper + hand.line(count))
    lines = boundaries(ends, integrated, rotation, limits)
    centre = nearest(lines, START) if offset is None else lowest_on(lines, -offset / mu)
    return Construction(
        MEANING,
        LeastRadiusGivens(integrated, rotation, limits, offset),
        pencil,
        hand.readings(mu, "mm", prime_radius=np.abs(centre), offset=-centre.real, s0=-centre.imag),
        {"ends": ends, "centre": centre} | {line.name: line.touch for line in lines},
        _draw,
    )


def boundaries(ends: Points, integrated: Integrated, rotation: Rotation, limits: Limits) -> list[Boundary]:
    """The lines that bound the region: the rise's tangent, the return's unless a spring drives it, the rest line.

    ends : (..., m) the D_i of all stations
    """
    sigma = sense(rotation)
    motion, stations = integrated.givens.motion, integrated.givens.stations

    def touching(name: str, direction: int, inward: Points) -> Boundary:
        return Boundary(name, farthest_of(ends, pieces_of(motion, stations, direction), inward), inward)

    # A line at the angle A to the motion, leaning to the side on which the rise's segments lie, permits the side away
    # from them; the return's line and the rest line lean the other way.
    def leaning(angle: float, side: int) -> Points:
        return -turned(side + 0j, side * angle)

    lines = [touching("rise", 1, leaning(limits.rise, sigma))]
    if limits.return_ is not None:
        lines.append(touching("return", -1, leaning(limits.return_, -sigma)))
    if limits.rest:
        lines.append(Boundary("rest", np.broadcast_to(START, ends.shape[:-1]), leaning(limits.rise, -sigma)))
    return lines


def active(region: LeastRadius) -> list[Boundary]:
    """The boundaries on which the cam centre lies, in the first sample."""
    return binding(_shown(region), complex(region.first("centre")))


def _shown(region: LeastRadius) -> list[Boundary]:
    """The boundaries of the first sample."""
    integrated, limits = region.givens.integrated, region.givens.limits
    return boundaries(region.first("ends"), integrated, region.givens.rotation, limits)


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
    integrated = region.givens.integrated
    stations, limits = integrated.givens.stations, region.givens.limits
    ends, centre, lines = region.first("ends"), complex(region.first("centre")), _shown(region)
    others = _alternatives(lines)
    marked = [place for place in (centre, *others.values()) if not np.isnan(place)]
    bottom = min(0.0, *(place.imag for place in marked)) - REGION_DEPTH
    line = (Line(UP * np.array([bottom, float(ends.imag.max()) + OVERHANG]), Role.AXIS),)
    laid_off = (Segments(UP * ends.imag, ends, Role.CONSTRUCTION), Dots(ends, Role.CONSTRUCTION))
    # The ends of the phases lie on the line of motion and need no number.
    named = numbers(ends, stations, np.sign(ends.real) + 0j, shown=np.abs(ends.real) > 1)
    curves = tuple(Line(faired(ends[piece]), Role.RESULT) for piece in stations.pieces)
    alternatives = [mark for name, place in others.items() for mark in _cross(place, PLACES[name])]
    return [
        Step(
            say("Velocities at the displacements"),
            say(
                "On the follower's line the displacements are marked; at each of them v is laid off in the scale of "
                "s, turned by 90° in the sense of the cam's rotation, {rotation}. The longest measures {longest:.1f} "
                "mm."
            ).where(rotation=turning(region.givens.rotation), longest=float(np.abs(ends.real).max())),
            COMBINED,
            (*line, *laid_off, *named),
            given=line,
        ),
        Step(
            say("Curves of rise and return"),
            say("The ends are joined by smooth curves, one for the rise and one for the return."),
            COMBINED,
            curves,
        ),
        Step(
            say("Tangents at the permitted angles"),
            say(
                "To each curve that is limited the tangent is drawn at its permitted angle to the line of motion "
                "({angles}); {zero}{further}"
            ).where(angles=_angles(lines, limits), zero=_at_zero_lift(lines[0]), further=_spring_and_rest(limits)),
            COMBINED,
            tuple(mark for line in lines for mark in _limit_line(line, bottom, limits)),
        ),
        Step(
            say("The region of the cam centre"),
            say(
                "Every place in the shaded region keeps all limits; thin crosses mark the alternatives: {names}."
            ).where(names=sequence([PLACES[name] for name in others])),
            COMBINED,
            (Region(permitted_part(lines, _box(ends, bottom))), *alternatives),
        ),
        _result(region, centre),
    ]


def _result(region: LeastRadius, centre: complex) -> Step:
    title, offset = say("The least prime radius"), region.givens.offset
    if np.isnan(centre):
        unreadable = say(
            "No cam centre can be read: the lines that bound the region cross one another, or the "
            "line of the offset, at less than a degree."
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
    ).where(place=place, binding=_bound_by(active(region)), paper=abs(centre), **values)
    marks = (
        Line(np.array([0j, centre]), Role.LIMIT),
        Dots(np.array([centre]), Role.RESULT),
        Label(centre, "A", towards=-1j + np.sign(centre.real)),
        Dimension(0j, centre, say("r₀ = {r0:.2f}", r0=values["prime_radius"]), aside=0.0),
        *_centre_lines(centre, offset),
    )
    return Step(title, said, COMBINED, marks, reads)


def _at_zero_lift(line: Boundary) -> Caption:
    """How far from the line of motion the rise's boundary meets zero lift."""
    place = meet(line.touch, line.along, START, np.asarray(1 + 0j))
    if np.isnan(place):
        return say("the rise's meets zero lift too flatly to be read.")
    return say("the rise's meets zero lift {distance:.1f} mm from the line of motion.", distance=abs(float(place.real)))


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


def _angles(lines: list[Boundary], limits: Limits) -> Caption:
    """The permitted angles of the tangents."""
    tangents = [line for line in lines if line.name != "rest"]
    return sequence([say("{angle} {line}", angle=_limit(line, limits), line=LINES[line.name]) for line in tangents])


def _limit(line: Boundary, limits: Limits) -> Caption:
    return degrees(limits.return_ if line.name == "return" and limits.return_ is not None else limits.rise)


def _limit_line(line: Boundary, bottom: float, limits: Limits) -> tuple[Mark, ...]:
    """The boundary from a little above its touch down to the bottom, with its angle to the vertical."""
    touch, along = complex(line.touch), complex(line.along / abs(line.along.imag))
    above = touch - along * (0.0 if line.name == "rest" else 10.0)
    below = touch + along * (touch.imag - bottom)
    # The angle is shown where the line has run a third of its way down.
    at = touch + along * (touch.imag - bottom) / 3
    first, last = sorted((-np.pi / 2, float(np.angle(line.along))))
    return (
        Line(np.array([above, below]), Role.LIMIT),
        Segments(np.array([at]), np.array([at - UP * ANGLE_RADIUS * 1.2]), Role.CONSTRUCTION),
        AngleMark(at, ANGLE_RADIUS, first, last, _limit(line, limits)),
    )


def _alternatives(lines: list[Boundary]) -> dict[str, complex]:
    """Other places that textbooks take: the apex, the foot on the rise's tangent, the central follower's centre."""
    by_name = {line.name: line for line in lines}
    rise, return_ = by_name["rise"], by_name.get("return")
    places = {"foot": foot(START, rise.touch, rise.along)}
    if return_ is not None:
        places["apex"] = meet(rise.touch, rise.along, return_.touch, return_.along)
    places["central"] = lowest_on(lines, 0.0)
    return {name: complex(place) for name, place in places.items() if np.isfinite(place)}


def _cross(place: complex, name: Caption) -> tuple[Mark, ...]:
    arms = 1.5 * np.array([1, 1j])
    return (Segments(place - arms, place + arms, Role.CONSTRUCTION), Label(place, name, towards=1 - 1j, small=True))


def _centre_lines(centre: complex, offset: float | None) -> tuple[Mark, ...]:
    """The follower's line seen from the cam centre, and how far the line of motion lies from it."""
    if abs(centre.real) < ON_THE_LINE:
        return ()
    top = centre.real + UP * 6
    return (
        Line(np.array([centre - 6 * UP, top]), Role.AXIS),
        Dimension(1j * centre.imag, centre, "e" if offset is None else say("e = {e:g}", e=offset), aside=-8.0),
    )


def _box(ends: Points, bottom: float) -> list[complex]:
    """The corners of the paper between the outermost ends, from zero lift down to the bottom."""
    left, right = float(ends.real.min()), float(ends.real.max())
    return [complex(left, bottom), complex(right, bottom), complex(right, 0), complex(left, 0)]
