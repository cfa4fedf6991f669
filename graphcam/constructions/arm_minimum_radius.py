"""The least radius of an oscillating follower: a region bounded by a line for every arm position.

The arm is drawn about its pivot in its positions, and along each from its end B the segment l v, outward when cam and
arm turn in opposite senses on the rise, towards the pivot when in the same sense, to D.  Seen from D, the cam centre A
makes the pressure angle with the arm's normal; so through every D the line at the permitted angle to that arm's normal
is drawn, and A may lie where no line cuts it off.  Between the positions the lines are faired like any other curve.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import degrees, numbers, pieces_of
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import LEAST_RADIUS, ON_THE_LINE, Boundary, nearest_of_many, permitted_part
from graphcam.constructions.views import REGION, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import NOWHERE, RIGHT, UP, circles_meet, turned, unit
from graphcam.drafting.hand import Hand, between, showing
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Dimension, Points, Region, Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text
from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.limits import Limits
from graphcam.plane import dot


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
    """
    hand, givens = Hand(pencil, MEANING), ArmLeastRadiusGivens(integrated, rotation, limits, arm, distance, mu_l)
    drawn = arm_positions(hand, integrated, rotation, arm, mu_l)
    families = _boundaries(hand, drawn, givens)
    lines = hand.take("lines", *families.values())
    if distance is None:
        centre = _nearest(hand, lines, drawn["start"])
    else:
        centre = _nearest_on(hand, lines, hand.circle("circle of the centre", drawn["pivot"], distance / mu_l.per_mm))
    hand.join("prime radius", drawn["start"], centre)
    hand.read("prime_radius", between(drawn["start"], centre), mu_l.per_mm)
    hand.read("distance", between(drawn["pivot"], centre), mu_l.per_mm)
    places = {name: drawn[name] for name in ("start", "ends", "tips")} | {"centre": centre}
    touches = {f"touch of {name}": family for name, family in families.items()}
    inwards = {f"inward of {name}": _inward(family) for name, family in families.items()}
    return hand.finished(givens, _draw, {**places, **touches, **inwards})


def _boundaries(hand: Hand, drawn: Mapping[str, Drawn], givens: ArmLeastRadiusGivens) -> dict[str, Drawn]:
    """The lines that bound the region, with what is permitted on their right: of rises, of returns, and at the rests.

    On a rise the velocity drives the angle to one side, on a return to the other.  The side away from it can bind only
    where the arm rests, so there both sides are drawn; without the rest condition the arm need only reach the cam.
    """
    motion, stations = givens.integrated.givens.motion, givens.integrated.givens.stations
    limits, sigma = givens.limits, sense(givens.rotation)
    directions = np.array([motion.phases[k].direction for k in stations.phase])

    def at_limit(name: str, ends: Drawn, arms: Drawn, limit: float, side: int) -> Drawn:
        """The lines at the limit to the normals of arms."""
        return hand.protractor(f"limits: {name}", ends, arms.turned(UP), side * limit).turned(side)

    def family(name: str, direction: int, limit: float, side: int) -> Drawn:
        """The lines at the limit of all arms of one direction of motion, faired between the positions."""
        at = np.flatnonzero(directions == direction)
        lines = at_limit(name, drawn["tips"][at], drawn["arms"][at], limit, side)
        pieces = pieces_of(motion, stations, direction)
        begins = np.searchsorted(at, [piece.start for piece in pieces]).tolist()
        faired = [slice(k, k + piece.stop - piece.start) for k, piece in zip(begins, pieces, strict=True)]
        return hand.fair(name, lines, faired)

    top = np.argmax(givens.integrated.readings["s"].paper, axis=-1)[..., None]
    both = np.concatenate([np.zeros_like(top), 1 + top], axis=-1)
    ends = hand.take("ends at rest", drawn["start"], drawn["ends"], which=both)
    arms = hand.take("arms at rest", drawn["arm at rest"], drawn["arms"], which=both)
    lines = {"rise": family("rise", 1, limits.rise, sigma)}
    if limits.return_ is not None:
        lines["return"] = family("return", -1, limits.return_, -sigma)
    if limits.rest:
        lines["rest"] = at_limit("rest", ends, arms, limits.rise, -sigma)
        if limits.return_ is not None:
            lines["rest after the return"] = at_limit("rest after the return", ends, arms, limits.return_, sigma)
    else:  # the arm stays above the line of centres in its lowest and its highest position
        lines["reach"] = hand.take("limits: reach", arms.turned(-1))
    return lines


def _inward(lines: Drawn) -> Points:
    """The directions across lines to the permitted side."""
    return -UP * unit(lines.directions)


def _nearest(hand: Hand, lines: Drawn, start: Drawn) -> Drawn:
    """The permitted place nearest to the start of the lift: the corner of two lines, or the foot on one; or none."""
    place, pair = nearest_of_many(lines.points, _inward(lines), start.points)
    bind = hand.take("lines that bind", lines, which=pair)
    corner, foot = hand.cross("corner", bind[0], bind[1], flat=True), hand.project("foot", start, bind[0])
    which = np.where(np.isnan(place), 2, pair[..., 0] == pair[..., 1])
    return hand.take("centre", corner, foot, hand.given("nowhere", NOWHERE), which=which[..., None])[0]


def _nearest_on(hand: Hand, lines: Drawn, circle: Drawn) -> Drawn:
    """The permitted place on the circle about the pivot that is nearest to the start of the lift; or none."""
    # A line cuts the circle in two points, equally far from the foot of the perpendicular from the pivot; the permitted
    # arc lies between them, on the inward side.  From the left, the nearest place is where the last arc begins.
    inwards, radius = _inward(lines), np.asarray(circle.radius)[..., None]
    reach = dot(inwards, lines.points - circle.points[..., None]) / radius
    with np.errstate(invalid="ignore"):
        half = np.where(reach < -1, np.inf, np.arccos(reach))
    middle = np.angle(-inwards)
    first, last = middle - half, (middle + half).min(axis=-1)
    bind = hand.take("lines that bind", lines, which=np.argmax(first, axis=-1)[..., None])[0]
    begins, which = hand.cross("where the arc begins", bind.turned(-1), circle), ~(first.max(axis=-1) <= last)
    return hand.take("centre", begins, hand.given("nowhere", NOWHERE), which=which[..., None].astype(np.intp))[0]


def permitted_distances(region: ArmRegion, prime_radius: float) -> Floats:
    """The stretches (k, 2) of centre distances [mm] at which a prime radius [mm] keeps the limits, on one drawing."""
    arm, mu = region.givens.arm / region.givens.mu_l.per_mm, region.givens.mu_l.per_mm
    start, radius = -arm + 0j, prime_radius / mu
    lines = region.acts["lines"].first
    touches, inwards = lines.points, _inward(lines)
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
SHOWN_LINE = 0.77
"""Length of the thin line at the limit through each end, as a fraction of the arm."""


def _draw(region: ArmRegion) -> list[Step]:
    integrated, limits, mu_l = region.givens.integrated, region.givens.limits, region.givens.mu_l
    stations, shown = integrated.givens.stations, at_scale(REGION, mu_l)
    pivot, start, ends, tips = (region.acts[name] for name in ("pivot", "start", "ends", "tips"))
    given, lengths, smooth = (pivot.dots(), pivot.label("C", 1 + 0j)), np.abs(tips.shown - ends.shown), showing(region)
    laid_off = (
        tips.from_(ends, Role.CURVE),
        *(smooth.fair("curve of the tips", tips.first, [piece]).line(Role.RESULT) for piece in stations.pieces),
        *numbers(tips, stations, tips.shown, shown=lengths > 1),
    )
    side = say("outward") if sense(region.givens.rotation) > 0 else say("towards the pivot")
    permitted = say("{rise} on the rise, while a spring drives the return", rise=degrees(limits.rise))
    if limits.return_:
        angles = {"rise": degrees(limits.rise), "back": degrees(limits.return_)}
        permitted = say("{rise} on the rise and {back} on the return", **angles)
    most = np.degrees(integrated.value("s").max())
    positions = (region.acts["arms"].ways(Role.CONSTRUCTION), ends.dots(Role.CONSTRUCTION))
    turned = say(
        "At {ratio} the arm, {arm:.1f} mm, is drawn about its pivot in its positions, turned by the displacements up "
        "to {most:.2f}°."
    ).where(ratio=ratio_text(mu_l.per_mm), arm=region.givens.arm / mu_l.per_mm, most=most)
    along = say(
        "Along every position the segment l·ds/dφ is laid off from its end, on the rise {side}, at most {longest:.1f} "
        "mm; the ends D are joined by smooth curves."
    ).where(side=side, longest=float(lengths.max()))
    cut_off = say(
        "Through every D the line at the permitted angle to that arm's normal is drawn: {limits}. The cam centre may "
        "lie where no line cuts it off."
    ).where(limits=permitted)
    return [
        Step(say("Arm positions"), turned, shown, (*positions, *given, start.label("B₀", -UP)), given=given),
        Step(say("Velocities along the arm"), along, shown, laid_off),
        Step(say("Lines at the permitted angles"), cut_off, shown, (*_lines(region), _shaded(region))),
        _result(region),
    ]


def _lines(region: ArmRegion) -> list[Segments]:
    """The lines at the limits as far as they matter: from the ends D down towards the region."""
    length, marks = SHOWN_LINE * abs(region.acts["start"].place), list[Segments]()
    for lines in (drawn.first for name, drawn in region.acts.items() if name.startswith("limits: ")):
        along = unit(lines.directions)
        down = np.where(along.imag < 0, along, -along)
        marks.append(Segments(lines.points, lines.points + length * down, Role.CONSTRUCTION, of=lines.act))
    return marks


def _shaded(region: ArmRegion) -> Region:
    """The permitted places between the arm's end and the pivot, down to a little below the cam centre."""
    centre, start, lines = region.acts["centre"][0].place, region.acts["start"].place, region.acts["lines"].first
    bottom = (centre.imag if np.isfinite(centre) else start.real) - BELOW
    corners = [complex(1.3 * start.real, bottom), complex(0, bottom), 0j, complex(1.3 * start.real, 0)]
    hand, sides = showing(region), np.diff([*corners, corners[0]])
    bounds = hand.take("bounds", lines, hand.given("edges of the picture", corners, sides))
    cuts = zip(lines.points, _inward(lines), strict=True)
    return Region(permitted_part([Boundary("", *cut) for cut in cuts], corners), of=bounds.act)


def _result(region: ArmRegion) -> Step:
    title, distance = say("The least prime radius"), region.givens.distance
    start, centre, shown = region.acts["start"], region.acts["centre"][0], at_scale(REGION, region.givens.mu_l)
    if np.isnan(centre.place):
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
    ).where(place=place, paper=abs(centre.place - start.place), away=abs(centre.place), r0=r0, c=c)
    marks = (
        *(region.acts["prime radius"].way(Role.LIMIT), centre.line_from(0j, Role.AXIS)),
        *(centre.dots(Role.RESULT), centre.label("A", -UP)),
        Dimension(start.place, centre.place, say("r₀ = {r0:.2f}", r0=r0), -8.0, region.readings["prime_radius"].act),
        Dimension(centre.place, 0j, say("c = {c:.2f}", c=c), -8.0, region.readings["distance"].act),
    )
    return Step(title, said, shown, marks, reads)
