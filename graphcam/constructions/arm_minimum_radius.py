"""The least radius of an oscillating follower: a region bounded by a line for every arm position.

The arm is drawn about its pivot in its positions, and along each from its end B the segment l v, outward when cam and
arm turn in opposite senses on the rise, towards the pivot when in the same sense, to D.  Seen from D, the cam centre A
makes the pressure angle with the arm's normal; so through every D the line at the permitted angle to that arm's normal
is drawn, and A may lie where no line cuts it off.  Between the positions the lines are faired like any other curve.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.adoption import ChainSettings
from graphcam.constructions.arm_limit_lines import bounding_length, dwells_step, family_step, highest_arm, reach_step
from graphcam.constructions.arm_positions import (
    ArmGivens,
    arc_through,
    arm_positions,
    cam_centre,
    detail_scale,
    enlarged_region_step,
    lift_directions,
    positions_step,
    velocities_step,
)
from graphcam.constructions.axes import pieces_of, station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import (
    LEAST_RADIUS,
    ON_THE_LINE,
    Boundary,
    RegionPicture,
    nearest_for_many,
    picture_of,
    touched_stations,
)
from graphcam.constructions.views import REGION, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import NOWHERE, UP, circle_crossing, turned_direction, unit
from graphcam.drafting.hand import Hand, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import Dimension, Label, Line, Mark, Points, Region, Role
from graphcam.drafting.meaning import (
    ALPHA,
    ARM,
    DISTANCE,
    PSI0,
    R0,
    SIGMA,
    ComparedReading,
    Formula,
    Meaning,
    ReadingMeaning,
    S,
    V,
    Values,
)
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Limits, Rotation, sense
from graphcam.given.laws import Floats
from graphcam.plane_vectors import dot
from graphcam.words import and_list, sequence


@dataclass(frozen=True, eq=False)
class ArmLeastRadiusGivens(ArmGivens, ChainSettings):
    """What lies on the board; see :func:`arm_least_radius`.

    adopted : tells which cam centre is taken in the end, where one is: the region is drawn as far as there
    """

    limits: Limits
    distance: float | None


ArmRegion = Construction[ArmLeastRadiusGivens]


def _triangle(region: ArmRegion) -> Values:
    """The formula's values: the triangle of A0, B0 and the pivot, where a cam centre is found."""
    centre, arm = complex(region.first("centre")) * region.givens.mu_l.per_mm, region.givens.arm
    if not np.isnan(centre):
        c, psi0 = abs(centre), float(np.angle(-centre))
        r0 = math.sqrt(arm**2 + c**2 - 2 * arm * c * math.cos(psi0))
        yield {"l": arm, "c": c, "psi0": math.degrees(psi0), "r0": r0}


def _worst(region: ArmRegion) -> Values:
    """The formula's values for every family of lines: the position in which the angle comes nearest to its limit."""
    integrated, limits, sigma = region.givens.integrated, region.givens.limits, sense(region.givens.rotation)
    s, v = (integrated.value(name) for name in "sv")
    moving, names = lift_directions(integrated), station_names(integrated.givens.stations)
    at_rest = np.zeros_like(moving, bool)
    at_rest[[0, int(np.argmax(s))]] = True
    families = (
        ("rise", limits.rise, sigma, moving > 0),
        ("return", limits.return_, -sigma, moving < 0),
        ("rest", limits.rise, -sigma, at_rest),
        ("rest after the return", limits.return_, sigma, at_rest),
    )
    for triangle in _triangle(region):
        arm, c, psi = triangle["l"], triangle["c"], math.radians(triangle["psi0"]) + s
        for name, limit, side, of in families:
            if f"limits: {name}" not in region.acts or limit is None:
                continue
            along = 0.0 * v if name in DWELL_ACTS else sigma * v
            tangent = (arm * (1 + along) - c * np.cos(psi)) / (c * np.sin(psi))
            k = int(np.argmax(np.where(of, side * tangent, -np.inf)))
            found = {"tangent": float(tangent[k]), "alpha": math.degrees(math.atan(tangent[k]))}
            terms = {"v": abs(float(along[k])), "sign": "-" if along[k] < 0 else "+", "s": math.degrees(s[k])}
            bound = {"least": r"\le" if side > 0 else r"\ge", "limit": side * math.degrees(limit)}
            yield {**triangle, **terms, **found, **bound, "k": "0" if name in DWELL_ACTS and not k else names[k]}


FORMULAS = (
    Formula(
        r"\tan\alpha = \frac{l\,(1 + \sigma v) - c\cos(\psi_0 + s)}{c\,\sin(\psi_0 + s)}",
        r"\tan\alpha_{<k>} = \frac{<l:.6g>\,(1 <sign> <v:.4f>) - <c:.3f>\cos(<psi0:.3f>^\circ + <s:.3f>^\circ)}"
        r"{<c:.3f>\,\sin(<psi0:.3f>^\circ + <s:.3f>^\circ)} = <tangent:.4f>, "
        r"\qquad \alpha_{<k>} = <alpha:.2f>^\circ <least> <limit:g>^\circ",
        _worst,
        (ALPHA, ARM, SIGMA, V, DISTANCE, PSI0, S),
        of="prime_radius",
    ),
    Formula(
        r"r_0 = \sqrt{l^2 + c^2 - 2lc\cos\psi_0}",
        r"r_0 = \sqrt{<l:.6g>^2 + <c:.3f>^2 - 2 \cdot <l:.6g> \cdot <c:.3f>\cos <psi0:.3f>^\circ} = "
        r"<r0:.2f>\ \text{<mm>}",
        _triangle,
        (R0,),
        of="prime_radius",
    ),
)
MEANING = Meaning(
    "minimum_radius",
    say("Minimum prime radius"),
    say(
        "The minimum radius is found before the cam exists: in every position the velocity, as a length, is laid "
        "off along the arm, and from its end the cam centre is seen at the pressure angle that it would cause. A "
        "line at the permitted angle cuts off the positions that it must not take."
    ),
    {
        "prime_radius": LEAST_RADIUS,
        "distance": ReadingMeaning(
            say("centre distance c"),
            "c",
            "mm",
            (ComparedReading("minimum_distance", say("its centre distance c"), beside=("prime_radius",)),),
        ),
    },
    FORMULAS,
)


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
    hand, givens = Hand(pencil, MEANING), ArmLeastRadiusGivens(integrated, rotation, arm, mu_l, limits, distance)
    drawn = arm_positions(hand, integrated, rotation, arm, mu_l)
    families = _boundaries(hand, drawn, givens)
    lines = hand.take("lines", *families.values())
    if distance is None:
        centre = _nearest_permitted(hand, lines, drawn["start"])
    else:
        centre = _nearest_on_circle(
            hand, lines, hand.circle("circle of the centre", drawn["pivot"], distance / mu_l.per_mm)
        )
    hand.join("prime radius", drawn["start"], centre)
    hand.read("prime_radius", distance_between(drawn["start"], centre), mu_l.per_mm)
    hand.read("distance", distance_between(drawn["pivot"], centre), mu_l.per_mm)
    places = {name: drawn[name] for name in ("start", "ends", "tips")} | {"centre": centre}
    touches = {f"touch of {name}": family for name, family in families.items()}
    inwards = {f"inward of {name}": _inward_directions(family) for name, family in families.items()}
    return hand.finished(givens, _draw, {**places, **touches, **inwards})


def _boundaries(hand: Hand, drawn: Mapping[str, Drawn], givens: ArmLeastRadiusGivens) -> dict[str, Drawn]:
    """The lines that bound the region, with what is permitted on their right: of rises, of returns, and at the rests.

    On a rise the velocity drives the angle to one side, on a return to the other.  The side away from it can bind only
    where the arm rests, so there both sides are drawn; without the rest condition the arm need only reach the cam.
    """
    motion, stations = givens.integrated.givens.motion, givens.integrated.givens.stations
    limits, sigma, moving = givens.limits, sense(givens.rotation), lift_directions(givens.integrated)

    def at_limit(name: str, ends: Drawn, arms: Drawn, limit: float, side: int) -> Drawn:
        """Lines at the permitted angle [rad] to the directions in which the tips move."""
        return hand.protractor(f"limits: {name}", ends, arms.turned(UP), side * limit).turned(side)

    def family(name: str, direction: int, limit: float, side: int) -> Drawn:
        """The limit lines of all rises (direction +1) or returns (-1)."""
        at = np.flatnonzero(moving == direction)
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


def _inward_directions(lines: Drawn) -> Points:
    """The directions across lines to the permitted side."""
    return -UP * unit(lines.directions)


def _nearest_permitted(hand: Hand, lines: Drawn, start: Drawn) -> Drawn:
    """The permitted place nearest to the start of the lift: the corner of two lines, or the foot on one; or none."""
    place, pair = nearest_for_many(lines.points, _inward_directions(lines), start.points)
    bind = hand.take("lines that bind", lines, which=pair)
    corner, foot = hand.cross("corner", bind[0], bind[1], flat=True), hand.project("foot", start, bind[0])
    which = np.where(np.isnan(place), 2, pair[..., 0] == pair[..., 1])
    return hand.take("centre", corner, foot, hand.given("nowhere", NOWHERE), which=which[..., None])[0]


def _nearest_on_circle(hand: Hand, lines: Drawn, circle: Drawn) -> Drawn:
    """The permitted place on the circle about the pivot that is nearest to the start of the lift; or none."""
    # A line cuts the circle in two points, equally far from the foot of the perpendicular from the pivot; the permitted
    # arc lies between them, on the inward side.  From the left, the nearest place is where the last arc begins.
    inwards, radius = _inward_directions(lines), np.asarray(circle.radius)[..., None]
    depth = dot(inwards, lines.points - circle.points[..., None]) / radius
    with np.errstate(invalid="ignore"):
        half = np.where(depth < -1, np.inf, np.arccos(depth))
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
    touches, inwards = lines.points, _inward_directions(lines)
    # A line cuts the circle about the start in two points, equally far from the foot of the perpendicular from there.
    with np.errstate(invalid="ignore"):
        half = np.arccos(dot(inwards, touches - start) / radius)
    middle = np.angle(inwards)
    cuts = start + turned_direction(radius + 0j, np.concatenate([middle - half, middle + half]))
    cuts = cuts[cuts.imag < 0]  # the cam lies below the arm
    ends = np.unique([abs(arm - radius), *np.abs(cuts), arm + radius])
    # No boundary crosses the region, so between two neighbouring cuts all places are permitted or none.
    centres = circle_crossing(np.asarray(0j), (ends[:-1] + ends[1:]) / 2, np.asarray(start), radius)
    permitted = (dot(inwards, centres[:, None] - touches) >= -ON_THE_LINE).all(axis=-1)
    return mu * np.stack([ends[:-1], ends[1:]], axis=-1)[permitted]


# --- the steps -------------------------------------------------------------------------------------------------------

BOUND_CAPTIONS = {
    "rise": say("the lines of the rise"),
    "return": say("the lines of the return"),
    "rest": say("the line of the dwell from {place}"),
    "rest after the return": say("the line of the dwell from {place}"),
    "reach": say("the lines of the arm"),
}
"""What bounds the region, by the names of the acts."""
BINDING_CAPTIONS = {
    "rise": say("rise, {station}"),
    "return": say("return, {station}"),
    "rest": say("dwell, {station}"),
    "rest after the return": say("dwell, {station}"),
    "reach": say("arm {station}"),
}
"""How a line that binds is labelled, by the names of the acts."""
NO_CENTRE = (
    say("No cam centre satisfies all the limits."),
    say("At this centre distance no cam centre satisfies all the limits."),
)
"""What is said where none is found: wherever the pivot is, and at a given distance."""
DWELL_ACTS = ("rest", "rest after the return")
"""The acts that draw two lines: one from B₀ and one from the end of the highest arm."""


def _draw(region: ArmRegion) -> list[Step]:
    limits, found = region.givens.limits, np.isfinite(region.acts["centre"][0].place)
    picture = picture_of([region.acts["start"].place, region.acts["centre"][0].place, *_adopted(region)])
    hatched = picture.permitted(_shown_boundaries(region))
    families = [family_step(region, "rise", 1, limits.rise, hatched)]
    if limits.return_ is not None:
        families.append(family_step(region, "return", -1, limits.return_, hatched))
    dwells = dwells_step(region, limits, hatched) if limits.rest else reach_step(region)
    return [
        positions_step(region),
        velocities_step(region),
        *families,
        dwells,
        _shaded(region, picture, hatched),
        _result(region, hatched, found=found),
        *(_enlarged(region) if found else []),
    ]


def _enlarged(region: ArmRegion) -> list[Step]:
    """The step that enlarges the surroundings of the cam centre, where they are small and one is adopted; else none."""
    adopted = region.givens.adopted()
    scale = adopted and detail_scale(adopted.prime_radius, region.givens.mu_l, region.givens.paper.ratios)
    if scale is None:
        return []
    bind = [(region.acts["lines that bind"].first[n], name) for n, name in _binding_captions(region)]
    return [enlarged_region_step(region, scale, _shown_boundaries(region), bind, _adopted(region))]


def _shown_boundaries(region: ArmRegion) -> list[Boundary]:
    lines = region.acts["lines"].first
    return [Boundary("", *line) for line in zip(lines.points, _inward_directions(lines), strict=True)]


def _adopted(region: ArmRegion) -> list[complex]:
    """The adopted cam centre where there is one, else nothing."""
    adopted, arm, mu = region.givens.adopted(), region.givens.arm, region.givens.mu_l.per_mm
    if adopted is None:
        return []
    return [cam_centre(arm, adopted.place, adopted.prime_radius) / mu]


def _shaded(region: ArmRegion, picture: RegionPicture, hatched: Points) -> Step:
    corners = picture.corners
    edges = errorless_hand(region).given("edges of the picture", corners, np.diff([*corners, corners[0]]))
    bounds = errorless_hand(region).take("bounds", region.acts["lines"].first, edges)
    said = say(
        "Hatch the region on the permitted side of all lines; between the stations its edge is the curve that the "
        "lines touch."
    )
    if region.givens.limits.return_ is None:
        said = sequence([said, say("A spring drives the return, which therefore has no lines.")], " ")
    return Step(
        *(say("The permitted region"), (Part(said, (bounds,)),), at_scale(REGION, region.givens.mu_l)),
        *((Region(hatched, of=bounds.act),),),
        why=say("With a cam centre in the hatched region no position of the arm exceeds its permitted angle."),
    )


def _bound_by(region: ArmRegion) -> list[tuple[int, str, int]]:
    """The lines that bind, each once: its place among them, its family, and its number from the end of the family."""
    which = np.asarray(region.acts["lines that bind"].act.takes["which"])
    families = [name for name in BOUND_CAPTIONS if f"limits: {name}" in region.acts]
    ends = np.cumsum([region.acts.get(name, region.acts[f"limits: {name}"]).shown.size for name in families])
    bind, places = np.unique(which[0] if region.acts["lines"].sampled else which, return_index=True)
    of = np.searchsorted(ends, bind, side="right").tolist()
    return [(n, families[f], int(k - ends[f])) for n, f, k in zip(places.tolist(), of, bind.tolist(), strict=True)]


def _binding_marks(region: ArmRegion, hatched: Points) -> tuple[Mark, ...]:
    """The lines that bind, drawn out along the region, each with the name of what it limits."""
    bind, centre = region.acts["lines that bind"], region.acts["centre"][0].place
    lines, named = list[Mark](), list[Mark]()
    for n, text in _binding_captions(region):
        touch = complex(bind.shown[n])
        way = complex(unit(np.asarray(centre - touch)))
        end = touch + way * max(bounding_length(touch, way, hatched), abs(centre - touch))
        lines.append(Line(np.array([touch, end]), Role.LIMIT, of=bind.act, index=bind.index[[n, n]]))
        named.append(Label(end, text, way, small=True, of=bind.act, index=bind.index[[n]]))
    return (*lines, *named)


def _binding_captions(region: ArmRegion) -> list[tuple[int, Caption]]:
    """The place of every line that binds among all of them, and a caption of what it limits."""
    bind, integrated, tips = region.acts["lines that bind"], region.givens.integrated, region.acts["tips"].shown
    named = list[tuple[int, Caption]]()
    for n, family, k in _bound_by(region):
        if family in ("rise", "return"):
            at = touched_stations(integrated, tips, complex(bind.shown[n]), 1 if family == "rise" else -1)
        else:
            at = [_dwell_line_starts(region)[k]]
        named.append((n, BINDING_CAPTIONS[family].with_values(station="–".join(at))))
    return named


def _dwell_line_starts(region: ArmRegion) -> tuple[str, str]:
    return "B₀", highest_arm(region)


def centre_caption(region: ArmRegion) -> Caption:
    """A sentence on where in the region the cam centre is found, and on which lines: two at a corner, else one."""
    found = dict[tuple[str, str], Caption]()
    for _, family, k in _bound_by(region):
        place = _dwell_line_starts(region)[k] if family in DWELL_ACTS else ""
        found[family, place] = BOUND_CAPTIONS[family].with_values(place=place)
    bounds = and_list(list(found.values()))
    if region.givens.distance is not None:
        return say(
            "the point of the arc nearest to B₀ in the hatched region, where the arc meets {bounds}", bounds=bounds
        )
    if len(_bound_by(region)) > 1:
        return say("the corner of the hatched region nearest to B₀, between {bounds}", bounds=bounds)
    return say(
        "the point of the hatched region nearest to B₀, the foot of the perpendicular to {bounds}", bounds=bounds
    )


def _result(region: ArmRegion, hatched: Points, *, found: bool) -> Step:
    c, acts, length = region.givens.distance, region.acts, region.givens.mu_l.paper
    start, centre, arcs, parts = acts["start"], acts["centre"][0], list[Mark](), list[Part]()
    if c is not None:
        circle = acts["circle of the centre"]
        middle = centre.place if found else -length(c) * np.exp(0.2j)
        arcs.append(arc_through(circle, middle * np.exp([-0.15j, 0.15j])))
        about = say("Draw an arc of {paper:.1f} mm about C with the compass, for c = {c:g} mm.", paper=length(c), c=c)
        parts.append(Part(about, (circle,)))
    title, view = say("The minimum prime radius"), at_scale(REGION, region.givens.mu_l)
    why = say("The prime circle goes through B₀, so the nearest permitted cam centre gives the smallest cam.")
    if not found:
        return Step(title, (*parts, Part(NO_CENTRE[c is not None])), view, tuple(arcs), why=why)
    line = errorless_hand(region).join("line of centres", acts["pivot"].first, centre.first)
    reads = ("prime_radius", "distance")
    r0, away = (float(region.value(name)) for name in reads)
    joining = say(
        "Join A₀ to B₀ and C and measure: A₀B₀ = {paper:.2f} mm, so r₀ = {r0:.3f} mm, and A₀C = {away:.2f} mm, so c = "
        "{c:.3f} mm."
    ).with_values(paper=abs(centre.place - start.place), r0=r0, away=abs(centre.place), c=away)
    parts.append(Part(say("Mark A₀, {place}.", place=centre_caption(region)), (acts["lines that bind"], centre)))
    parts.append(Part(joining, (acts["prime radius"], line)))
    marks = (
        *(*arcs, *_binding_marks(region, hatched)),
        *(acts["prime radius"].way(Role.LIMIT), line.way(Role.AXIS)),
        *(centre.dots(Role.RESULT), centre.label("A₀", -UP)),
        Dimension(
            start.place, centre.place, say("min r₀ = {r0:.2f}", r0=r0), -8.0, of=region.readings["prime_radius"].act
        ),
        Dimension(centre.place, 0j, say("c = {c:.2f}", c=away), -8.0, of=region.readings["distance"].act),
    )
    return Step(title, tuple(parts), view, marks, reads, why=why)
