"""The least radius of an oscillating follower: a region bounded by a line for every arm position.

The arm is drawn about its pivot in its positions, and along each from its end B the segment l v, outward when cam and
arm turn in opposite senses on the rise, towards the pivot when in the same sense, to D.  Seen from D, the cam centre A
makes the pressure angle with the arm's normal; so through every D the line at the permitted angle to that arm's normal
is drawn, and A may lie where no line cuts it off.  Between the positions the lines are faired like any other curve.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import degrees, numbers, pieces_of
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import LEAST_RADIUS, ON_THE_LINE, Boundary, nearest_of_many, permitted_part
from graphcam.constructions.views import REGION, at_scale
from graphcam.drafting.curve import faired
from graphcam.drafting.euclid import NOWHERE, UP, circles_meet, turned, unit
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Dimension, Dots, Label, Line, Mark, Points, Region, Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Hand, Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits
from graphcam.plane import dot


@dataclass(frozen=True, eq=False)
class ArmPositions:
    """The arm about its pivot, the origin, swinging clockwise from the left.

    ends : B (..., m); segments : l v laid off (..., m) [mm of paper]; angles : s (..., m) [rad]
    """

    ends: Points
    segments: Floats
    angles: Floats

    def tips(self, sigma: int) -> Points:
        """The D: l v from B along the arm, outward for sigma = +1."""
        return self.ends + sigma * self.segments * unit(self.ends)


@dataclass(frozen=True, eq=False)
class ArmLeastRadiusGivens:
    """What lies on the board; see :func:`arm_least_radius`."""

    integrated: Integrated
    rotation: Rotation
    limits: Limits
    arm: float
    distance: float | None
    mu_l: Scale


ArmRegion = Construction[ArmLeastRadiusGivens]


MEANING = Meaning(
    "minimum_radius",
    say("Least prime radius"),
    say(
        "The least radius is found before there is a cam: the velocity, as a length, is laid off along the arm in "
        "every position, and from its end the cam centre is seen under the pressure angle that it would cause. A line "
        "at the permitted angle cuts off the places that it may not take."
    ),
    {
        "prime_radius": LEAST_RADIUS,
        "distance": ReadingMeaning(
            say("centre distance c"), "c", "mm", (Compared("minimum_distance", say("its centre distance c")),)
        ),
    },
)


def arm_positions(integrated: Integrated, arm: float, mu_l: Scale, hand: Hand) -> ArmPositions:
    """Lay the displacements off as angles of the arm, and the velocities as segments along it.

    integrated : from :func:`~graphcam.constructions.integration.integration`, of an angle s [rad]
    arm : length [mm]; mu_l : scale of the drawing [mm/mm]
    """
    count, length = integrated.givens.stations.u.size, arm / mu_l.per_mm
    angles = integrated.readings["s"].value + hand.protractor(count)
    segments = integrated.readings["v"].value * length + hand.dividers(count)
    return ArmPositions(turned(-length + 0j, -angles) + hand.point(count), segments, angles)


def arm_least_radius(
    integrated: Integrated,
    rotation: Rotation,
    limits: Limits,
    arm: float,
    distance: float | None,
    mu_l: Scale,
    pencil: Pencil,
) -> ArmRegion:
    """Find the cam centre that is nearest to the start of the lift.

    arm : length [mm]; distance : of the pivot from the cam centre [mm], or None to let it be found
    mu_l : scale of the drawing [mm/mm]

    Readings: ``prime_radius`` and ``distance`` [mm].
    """
    hand = pencil.hand("minimum_radius")
    positions = arm_positions(integrated, arm, mu_l, hand)
    start = np.broadcast_to(np.asarray(-arm / mu_l.per_mm + 0j), positions.ends.shape[:-1])
    lines = boundaries(positions, integrated, rotation, limits, start)
    touches = np.concatenate([line.touch for line in lines], axis=-1)
    inwards = np.concatenate([line.inward for line in lines], axis=-1)
    if distance is None:
        centre, _ = nearest_of_many(touches, inwards, start)
    else:
        centre = _nearest_on_arc(touches, inwards, distance / mu_l.per_mm)
    return Construction(
        MEANING,
        ArmLeastRadiusGivens(integrated, rotation, limits, arm, distance, mu_l),
        pencil,
        hand.readings(mu_l.per_mm, "mm", prime_radius=np.abs(centre - start), distance=np.abs(centre)),
        {"start": start, "ends": positions.ends, "tips": positions.tips(sense(rotation)), "centre": centre}
        | {f"touch of {line.name}": line.touch for line in lines}
        | {f"inward of {line.name}": line.inward for line in lines},
        _draw,
    )


def boundaries(
    positions: ArmPositions,
    integrated: Integrated,
    rotation: Rotation,
    limits: Limits,
    start: Points,
) -> list[Boundary]:
    """The families of lines that bound the region, each (..., k): of the rises, of the returns, and at the rests.

    On a rise the velocity drives the angle to one side, on a return to the other.  The side away from it can bind only
    where the arm rests, so there both sides are drawn; without the rest condition the arm need only reach the cam.
    """
    motion, stations, sigma = integrated.givens.motion, integrated.givens.stations, sense(rotation)
    tips, angles = positions.tips(sigma), positions.angles

    def leaning(limit: float, side: int, angle: Floats) -> Points:
        """The direction of a line at the limit to the normal of an arm at an angle [rad]."""
        return -turned(side + 0j, side * limit - angle)

    def family(name: str, direction: int, limit: float, side: int) -> Boundary:
        """The lines at the limit of all arms of one direction of motion."""
        pieces = pieces_of(motion, stations, direction)
        touch = np.concatenate([faired(tips[..., piece]) for piece in pieces], axis=-1)
        angle = np.concatenate([faired(angles[..., piece] + 0j).real for piece in pieces], axis=-1)
        return Boundary(name, touch, leaning(limit, side, angle))

    top = np.argmax(angles, axis=-1)[..., None]
    resting = np.concatenate([start[..., None], np.take_along_axis(positions.ends, top, -1)], axis=-1)

    def at_rest(name: str, limit: float, side: int) -> Boundary:
        """The lines at the limit of the arms at rest, low and high."""
        angle = np.concatenate([np.zeros_like(angles[..., :1]), np.take_along_axis(angles, top, -1)], axis=-1)
        return Boundary(name, resting, leaning(limit, side, angle))

    lines = [family("rise", 1, limits.rise, sigma)]
    if limits.return_ is not None:
        lines.append(family("return", -1, limits.return_, -sigma))
    if limits.rest:
        lines.append(at_rest("rest", limits.rise, -sigma))
        if limits.return_ is not None:
            lines.append(at_rest("rest after the return", limits.return_, sigma))
    else:  # the arm stays above the line of centres in its lowest and its highest position
        lines.append(Boundary("reach", np.zeros_like(resting), UP * unit(resting)))
    return lines


def _nearest_on_arc(touches: Points, inwards: Points, radius: float) -> Points:
    """The permitted place on the circle about the pivot that is nearest to the start of the lift; NaN if none is."""
    # A line cuts the circle in two points, equally far from the foot of the perpendicular from the pivot; the permitted
    # arc lies between them, on the inward side.  From the left, the nearest place is where the last arc begins.
    reach = dot(inwards, touches) / radius
    with np.errstate(invalid="ignore"):
        half = np.where(reach < -1, np.inf, np.arccos(reach))
    middle = np.angle(-inwards)
    first, last = (middle - half).max(axis=-1), (middle + half).min(axis=-1)
    return np.where(first <= last, turned(-radius + 0j, first), NOWHERE)


def permitted_distances(region: ArmRegion, prime_radius: float) -> Floats:
    """The stretches (k, 2) of centre distances [mm] at which a prime radius [mm] keeps the limits, on one drawing.

    region : from :func:`arm_least_radius`
    """
    arm, mu = region.givens.arm / region.givens.mu_l.per_mm, region.givens.mu_l.per_mm
    start, radius = -arm + 0j, prime_radius / mu
    touches = np.concatenate([family.touch for family in _families(region)])
    inwards = np.concatenate([family.inward for family in _families(region)])
    # A line cuts the circle about the start in two points, equally far from the foot of the perpendicular from there.
    with np.errstate(invalid="ignore"):
        half = np.arccos(dot(inwards, touches - start) / radius)
    middle = np.angle(inwards)
    cuts = start + turned(radius + 0j, np.concatenate([middle - half, middle + half]))
    cuts = cuts[cuts.imag < 0]  # the cam lies below the arm
    ends = np.unique([abs(arm - radius), *np.abs(cuts), arm + radius])
    # No boundary crosses the region, so between two neighbouring cuts all places are permitted or none.
    centres = circles_meet(np.asarray(0j), (ends[:-1] + ends[1:]) / 2, np.asarray(start), radius)
    permitted = (dot(inwards, centres[:, None] - touches) >= -ON_THE_LINE).all(axis=-1)
    return mu * np.stack([ends[:-1], ends[1:]], axis=-1)[permitted]


# --- the steps -------------------------------------------------------------------------------------------------------

BELOW = 30.0
"""How far below the cam centre the region is shown [mm]."""
SHOWN_LINE = 0.35
"""Length of the thin line at the limit through each end, as a fraction of the arm."""


def _draw(region: ArmRegion) -> list[Step]:
    integrated, limits, mu_l = region.givens.integrated, region.givens.limits, region.givens.mu_l
    stations, shown = integrated.givens.stations, at_scale(REGION, mu_l)
    ends, tips, centre = region.first("ends"), region.first("tips"), complex(region.first("centre"))
    start = complex(region.first("start"))
    pivot = (Dots(np.array([0j])), Label(0j, "C", towards=1 + 0j))
    arms = (Segments(np.zeros_like(ends), ends, Role.CONSTRUCTION), Dots(ends, Role.CONSTRUCTION))
    lengths = np.abs(tips - ends)
    laid_off = (
        Segments(ends, tips, Role.CURVE),
        *(Line(faired(tips[piece]), Role.RESULT) for piece in stations.pieces),
        *numbers(tips, stations, tips, shown=lengths > 1),
    )
    side = say("outward") if sense(region.givens.rotation) > 0 else say("towards the pivot")
    permitted = say("{rise} on the rise, while a spring drives the return", rise=degrees(limits.rise))
    if limits.return_:
        angles = {"rise": degrees(limits.rise), "back": degrees(limits.return_)}
        permitted = say("{rise} on the rise and {back} on the return", **angles)
    return [
        Step(
            say("Arm positions"),
            say(
                "At {ratio} the arm, {arm:.1f} mm, is drawn about its pivot in its positions, turned by the "
                "displacements up to {most:.2f}°."
            ).where(ratio=ratio_text(mu_l.per_mm), arm=abs(start), most=np.degrees(integrated.value("s").max())),
            shown,
            (*arms, *pivot, Label(start, "B₀", towards=-1j)),
            given=pivot,
        ),
        Step(
            say("Velocities along the arm"),
            say(
                "Along every position the segment l·ds/dφ is laid off from its end, on the rise {side}, at most "
                "{longest:.1f} mm; the ends D are joined by smooth curves."
            ).where(side=side, longest=float(lengths.max())),
            shown,
            laid_off,
        ),
        Step(
            say("Lines at the permitted angles"),
            say(
                "Through every D the line at the permitted angle to that arm's normal is drawn: {limits}. The cam "
                "centre may lie where no line cuts it off."
            ).where(limits=permitted),
            shown,
            (*_lines(region), Region(_shown_region(region))),
        ),
        _result(region, start, centre),
    ]


def _families(region: ArmRegion) -> list[Boundary]:
    """The families of lines of the first sample."""
    names = [name.removeprefix("touch of ") for name in region.points if name.startswith("touch of ")]
    return [Boundary(n, region.first(f"touch of {n}"), region.first(f"inward of {n}")) for n in names]


def _lines(region: ArmRegion) -> tuple[Mark, ...]:
    """The lines at the stations, as far as they matter: from their ends down towards the region."""
    length = SHOWN_LINE * abs(complex(region.first("start")))
    marks: list[Mark] = []
    for family in _families(region):
        # Between two stations the faired family has more lines than are drawn.
        step = 8 if family.touch.size > 2 else 1
        touch, along = family.touch[::step], unit(family.along[::step])
        marks.append(Segments(touch, touch + length * 2.2 * along, Role.CONSTRUCTION))
    return tuple(marks)


def _shown_region(region: ArmRegion) -> Points:
    """The permitted places between the arm's end and the pivot, down to a little below the cam centre."""
    centre, start = complex(region.first("centre")), complex(region.first("start"))
    bottom = (centre.imag if np.isfinite(centre) else start.real) - BELOW
    corners = [complex(1.3 * start.real, bottom), complex(0, bottom), 0j, complex(1.3 * start.real, 0)]
    lines = [
        Boundary(family.name, touch, inward)
        for family in _families(region)
        for touch, inward in zip(family.touch, family.inward, strict=True)
    ]
    return permitted_part(lines, corners)


def _result(region: ArmRegion, start: complex, centre: complex) -> Step:
    title, distance = say("The least prime radius"), region.givens.distance
    shown = at_scale(REGION, region.givens.mu_l)
    if np.isnan(centre):
        said = say("No cam centre keeps all the limits.")
        if distance is not None:
            said = say("At this centre distance no cam centre keeps all the limits.")
        return Step(title, said, shown, ())
    reads = ("prime_radius", "distance")
    r0, c = (float(region.value(name)) for name in reads)
    place = say("The place of the region nearest to the start of the lift is the cam centre A.")
    if distance is not None:
        place = say(
            "The place of the region nearest to the start of the lift on the circle c = {c:g} mm is the cam centre A."
        ).where(c=distance)
    said = say(
        "{place} It lies {paper:.2f} mm from the start of the lift, so r₀ = {r0:.3f} mm, and {away:.2f} mm from the "
        "pivot, so c = {c:.3f} mm."
    ).where(place=place, paper=abs(centre - start), away=abs(centre), r0=r0, c=c)
    marks = (
        *(Line(np.array([start, centre]), Role.LIMIT), Line(np.array([0j, centre]), Role.AXIS)),
        *(Dots(np.array([centre]), Role.RESULT), Label(centre, "A", towards=-1j)),
        Dimension(start, centre, say("r₀ = {r0:.2f}", r0=r0), aside=-8.0),
        Dimension(centre, 0j, say("c = {c:.2f}", c=c), aside=-8.0),
    )
    return Step(title, said, shown, marks, reads)
