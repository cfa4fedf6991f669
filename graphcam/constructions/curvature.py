"""Curvature of the pitch curve by three points, at its sharpest place.

The perpendicular bisectors of two neighbouring chords meet in the centre of the circle through the three points.  They
are stepped off along the drawn curve, so far apart that the line's own errors do not bend it.  In a dwell the pitch
curve is an arc about the cam centre; its ends and its middle are three such points.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import accumulate, product

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import degrees, phase_symbol, station_names
from graphcam.constructions.profile_view import Inverted
from graphcam.constructions.sharpest_bend import (
    CURVE_PLACES,
    Stretch,
    dwell_arcs,
    share_of_phase,
    sharpest_of,
    steps_along,
    stretches_of,
    turns_a_corner,
)
from graphcam.constructions.views import CURVATURE, PROFILE, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP, centre_of_circle
from graphcam.drafting.hand import BISECTION_SHARE, Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Step, View, say
from graphcam.drafting.marks import Arc, Label, Line, Mark, Points, Role
from graphcam.drafting.meaning import (
    RHO,
    ComparedReading,
    Formula,
    Meaning,
    ReadingConvergence,
    ReadingMeaning,
    Symbol,
    Values,
    sharpness,
)
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import ratio_text, standard_scale
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.words import and_list, sequence


@dataclass(frozen=True, eq=False)
class CurvatureGivens:
    """The pitch curve, and the samples ([samples]) in which it turns a corner.

    profile : whether this curve is the profile itself, because a flat face runs on it
    """

    inverted: Inverted
    corner: NDArray[np.bool_]
    profile: bool = False


Curved = Construction[CurvatureGivens]


LEAST_CURVATURE = {
    "rho": ReadingMeaning(
        say("minimum radius of curvature ρ"),
        "ρ",
        "mm",
        (
            ComparedReading(
                "min_pitch_curvature_radius",
                say("minimum radius of curvature ρ"),
                "rho_candidates",
                (np.negative, sharpness),
            ),
        ),
        ReadingConvergence("minimum radius of curvature", "min_moving_curvature_radius", of="rho_candidates"),
    )
}
"""The least radius of curvature, however it is found."""


def _radius_values(curved: Curved) -> Values:
    """The formula's values: OB and the radius that it measures, where one is readable."""
    rho, mu = float(curved.value("rho")), curved.readings["rho"].per_mm
    if math.isfinite(rho):
        yield {"mu": mu, "ob": rho / mu, "rho": rho}


FORMULAS = (
    Formula(
        r"\rho = \mu_l \cdot OB",
        r"\rho = <mu:g> \cdot <ob:.2f> = <rho:.2f>\ \text{<mm>}",
        _radius_values,
        (RHO, Symbol(r"\mu_l", say("the scale of the drawing"), "mm/mm")),
        of="rho",
    ),
)


MEANING = Meaning(
    "curvature",
    say("Minimum radius of curvature"),
    say(
        "Three close points of a curve determine the circle that fits it best. The minimum radius of curvature "
        "limits the roller."
    ),
    {**LEAST_CURVATURE, "phi": ReadingMeaning(say("cam angle φ of B"), "φ", "rad")},
    FORMULAS,
)


PROFILE_MEANING = replace(
    MEANING,
    why=say(
        "Three close points of a curve determine the circle that fits it best. The minimum radius of curvature tells "
        "how sharp the profile is."
    ),
)


def curvature(inverted: Inverted, pencil: Pencil, *, profile: bool = False) -> Curved:
    """Find the sharpest convex place among three points along the drawn curve, and the arcs of the dwells.

    Readings: besides ``rho`` and ``phi`` the ``rho_candidates`` (..., 2), of moving phases and of rests, infinite
    where nothing is convex.  NaN where no bend is readable, and of the moving phases and of rho where the curve turns a
    corner that three points cannot tell.
    Points: the ``triple`` (..., 3) at the sharpest place and its ``centre``.
    """
    hand, integrated = Hand(pencil, PROFILE_MEANING if profile else MEANING), inverted.givens.integrated
    mu_l = inverted.givens.mu_l.per_mm
    pitch, centre, nowhere = (
        hand.earlier_places(inverted, "pitch"),
        hand.given("cam centre"),
        hand.given("nowhere", [np.nan]),
    )
    stretches = stretches_of(inverted)
    curve, axis = _drawn_curve(hand, inverted, stretches, pitch, centre)
    rests, beyond = _dwell_arcs(hand, inverted, pitch, centre)
    places, corner = hand.take("places", curve, rests, nowhere), turns_a_corner(inverted)
    # The eye takes one place of the moving phases and one of the rests.
    of_rests = curve.points.shape[-1] + np.arange(rests.points.shape[-1]).reshape(-1, 3)
    share = share_of_phase(max(pencil.line, pencil.dividers))
    moving = steps_along(inverted, stretches, curve.points, share)
    resting = np.broadcast_to(of_rests, (*moving.shape[:-2], *of_rests.shape))
    seen = [sharpest_of(inverted, places.points, triples) for triples in (moving, resting)]
    at, looks = np.stack([triple for triple, _ in seen], axis=-2), np.stack([radius for _, radius in seen], axis=-1)
    # Where nothing rests there is no arc: the places of the moving phases stand for it, and are not counted.
    at[..., 1, :] = np.where(np.isnan(looks[..., 1:]), at[..., 0, :], at[..., 1, :])
    names = ("P", "B", "Q")
    before, b, after = (hand.take(name, places, which=at[..., k]) for k, name in enumerate(names))
    bisectors = hand.bisect("first bisectors", before, b), hand.bisect("second bisectors", b, after)
    met = hand.cross("crossings", *bisectors, flat=integrated.givens.stations.refine > 1)
    # A rest is an arc about the cam centre; of what is not bent the centre is far away.
    unknown = np.stack([corner | np.isnan(looks[..., 0]), np.zeros_like(corner)], axis=-1)
    which = np.where(unknown, 3, np.where(np.isfinite(looks), [0, 2], 4))
    centres = hand.take("centres", met, centre, nowhere, hand.given("far away", [np.inf]), which=which)

    radii = np.abs(centres.points - b.points)
    unread = corner | ~np.isfinite(radii).any(axis=-1)
    best = np.argmin(np.where(np.isnan(radii), np.inf, radii), axis=-1)
    chosen = np.take_along_axis(at, best[..., None, None], -2)[..., 0, :]
    chosen = np.where(unread[..., None], places.points.shape[-1] - 1, chosen)
    triple = hand.take("triple", places, which=chosen)
    o = hand.take("centre", centres, nowhere, which=np.where(unread, 2, best)[..., None])[0]
    # On the axis the place has its own mark; it is carried down to the scale of degrees, where it is read.
    marks, degrees_axis = (
        hand.take("cam angles", axis, beyond, nowhere, which=_on_axis(stretches, chosen[..., 1:2])),
        hand.given("degrees", along=RIGHT),
    )
    phi = distance_between(
        hand.given("start of the turn"), hand.project("on the degrees", marks, degrees_axis)[0], RIGHT
    )
    hand.read("rho", distance_between(triple[1], o), mu_l)
    hand.read("rho_candidates", distance_between(b, centres), mu_l, "mm")
    hand.read("phi", calculated_setting(integrated.givens.mu_phi.value, phi), 1.0, rounded=False)
    return hand.finished(CurvatureGivens(inverted, corner, profile), _draw, {"triple": triple, "centre": o})


def _drawn_curve(
    hand: Hand, inverted: Inverted, stretches: Sequence[Stretch], pitch: Drawn, centre: Drawn
) -> tuple[Drawn, Drawn]:
    """The drawn curve with its images beyond the ends of the phases, and the marks of its own places on the axis."""
    axis, none = hand.earlier_places(inverted.givens.integrated.givens.diagram, "axis"), np.empty(0, dtype=np.intp)
    if not stretches:
        return hand.take("drawn curve", pitch, which=none), hand.take("places on the axis", axis, which=none)
    images = [image for stretch in stretches for image in stretch.images]
    ends = [end for stretch in stretches for end in (stretch.stations.start, stretch.stations.stop - 1)]
    count, of = pitch.points.shape[-1], np.concatenate(images)
    rays = hand.join("rays to the ends", centre, pitch[np.repeat(ends, [image.size for image in images])])
    beyond = hand.mirrored("beyond the ends", pitch[of], rays)
    # Before each stretch, its own stations, after it.
    firsts = count + np.cumsum([0, *(image.size for image in images)])
    rows, pieces, first = list[NDArray[np.intp]](), list[slice](), 0
    for k, stretch in enumerate(stretches):
        own = np.arange(stretch.stations.start, stretch.stations.stop)
        row = np.concatenate([np.arange(*firsts[2 * k : 2 * k + 2]), own, np.arange(*firsts[2 * k + 1 : 2 * k + 3])])
        rows.append(row)
        pieces.append(slice(first, first + row.size))
        first += row.size
    points = hand.take("points of the curve", pitch, beyond, which=np.concatenate(rows))
    own_pieces = [stretch.stations for stretch in stretches]
    return hand.fair("drawn curve", points, pieces), hand.fair("places on the axis", axis, own_pieces)


def _on_axis(stretches: Sequence[Stretch], places: NDArray[np.intp]) -> NDArray[np.intp]:
    """The numbers on the axis, which has no images, of own places of the curve, of the rests, or of none."""
    lengths = [stretch.own.stop - stretch.own.start for stretch in stretches]
    shifts = [
        first - stretch.own.start for stretch, first in zip(stretches, accumulate(lengths, initial=0), strict=False)
    ]
    numbers = np.concatenate(
        [np.arange(stretch.count) + shift for stretch, shift in zip(stretches, shifts, strict=True)]
        + [np.empty(0, dtype=np.intp)]
    )
    rests = places - numbers.size
    return np.where(rests < 0, numbers[np.minimum(rests, -1)] if numbers.size else 0, rests + sum(lengths))


def _dwell_arcs(hand: Hand, inverted: Inverted, pitch: Drawn, centre: Drawn) -> tuple[Drawn, Drawn]:
    """Three points on the arc of each dwell, and their places on the axis of the cam angle."""
    integrated = inverted.givens.integrated.givens
    resting = dwell_arcs(integrated.motion, integrated.stations)
    last = np.array([after for after, _ in resting], dtype=np.intp)
    turns, each = np.ravel([turn for _, turn in resting]), np.repeat(np.arange(last.size), 3)
    arcs = hand.circle("arcs of the rests", centre, distance_between(centre, pitch[last]))
    ends = hand.join("rays to the rests", centre, pitch[last])[each]
    rays = hand.protractor("rays of the rests", centre, ends, -sense(inverted.givens.rotation) * turns)
    axis = hand.earlier_places(integrated.diagram, "axis")
    mu_phi, since = integrated.mu_phi, integrated.stations.phi[last][each]
    along = mu_phi.paper(since + turns) - mu_phi.paper(since)
    beyond = hand.lay_off("rests on the axis", axis[last][each], RIGHT, along)
    return hand.cross("rests", rays, arcs[each]), beyond


# --- the steps -------------------------------------------------------------------------------------------------------

MAX_DETAIL_RADIUS = 70.0
"""The detail has the largest standard scale at which neither the radius of curvature nor a chord is longer [mm]."""
CAREFUL_ERROR = 0.15
"""The error of a point in a careful drawing [mm]."""
ONLY_RESTS = say(
    "In the moving phases the curvature cannot be read, because there are too few points between the jumps of "
    "the acceleration; only the dwells are compared. Use more parts."
)
"""What is said where the radius of the moving phases is not known."""


@dataclass(frozen=True, eq=False)
class Detail:
    """The sharpest place in a view of its own, with B at the origin.

    hand : draws there;  per_mm : its scale [mm/mm];  times : so many times as large as the profile
    triple : B between its neighbours;  hub : the centre of curvature O
    """

    hand: Hand
    view: View
    per_mm: float
    times: float
    triple: Drawn
    hub: Drawn


def detail_of(curved: Curved) -> Detail | None:
    """The detail, or None where no radius is readable."""
    if np.isnan(curved.first("centre")):
        return None
    triple, o, hand = curved.acts["triple"].first, curved.acts["centre"].first[0], errorless_hand(curved)
    paper, mu_l = curved.givens.inverted.givens.paper, curved.givens.inverted.givens.mu_l.per_mm
    longest = max(float(curved.value("rho")), mu_l * float(np.abs(np.diff(triple.shown)).max()))
    scale = paper.kept_scale(CURVATURE.name) or standard_scale(longest, MAX_DETAIL_RADIUS, paper.ratios)
    times = mu_l / scale.per_mm
    shown, hub = (hand.enlarged(drawn.act.name, drawn, triple[1], times) for drawn in (triple, o))
    return Detail(hand, at_scale(CURVATURE, scale), scale.per_mm, times, shown, hub)


def _draw(curved: Curved) -> list[Step]:
    detail = detail_of(curved)
    if detail is None:
        title, why = say("Curvature at the sharpest point"), say("Three points on a line lie on no circle.")
        if curved.givens.inverted.givens.integrated.givens.motion.corners:
            why = say("No circle fits a corner.")
        return [Step(title, (Part(_unreadable(curved)),), PROFILE, (), why=why)]
    return [_chords(curved, detail), _bisected(curved, detail), _measured(curved, detail), _on_profile(curved)]


def _chords(curved: Curved, detail: Detail) -> Step:
    triple, place = detail.triple, _place(curved)
    first, second = np.abs(np.diff(triple.shown))
    names = ("", "B", "") if place.resting else ("P", "B", "Q")
    found = say(
        "Find the sharpest outward bend of the pitch curve and call this point B: here {place}, at φ = {phi:.1f}°."
    )
    if curved.givens.profile:
        found = say(
            "Find the sharpest outward bend of the profile and call this point B: here {place}, at φ = {phi:.1f}°."
        )
    found = found.with_values(place=place.caption, phi=np.degrees(curved.value("phi") % FULL_TURN))
    copied = say("Copy {points} with dividers to a free part of the sheet, {copied}.")
    points = say("B and both ends of the arc") if place.resting else say("P, B and Q")
    copied = copied.with_values(points=points, copied=_copied(detail))
    joined = say("Join them with a ruler: the chords measure {first:.2f} mm and {second:.2f} mm.")
    joined = joined.with_values(first=first, second=second)
    more = [ONLY_RESTS] if np.isnan(curved.first("rho_candidates")[0]) else []
    why = say(
        "The circle through three points is found by two of its chords, and it is smallest where the curve bends most."
    )
    chords = detail.hand.join("chords", triple[:2], triple[1:])
    marks = (
        *(chords.segments(Role.CURVE), triple.dots()),
        *(triple[k].label(name, -detail.hub.place) for k, name in enumerate(names)),
    )
    said = sequence([found, *place.steps, copied], " ")
    parts = Part(said, (triple,)), Part(sequence([joined, *more], " "), (chords,))
    return Step(say("Chords at the sharpest point"), parts, detail.view, marks, ("phi",), why=why)


def _copied(detail: Detail) -> Caption:
    ratio = ratio_text(detail.per_mm)
    if math.isclose(detail.times, 1):
        return say("at the same scale, {ratio}", ratio=ratio)
    if detail.times < 1:
        return say("reduced to 1/{times:g}, at {ratio}", times=round(1 / detail.times, 4), ratio=ratio)
    return say("enlarged to {times:g} times its size, at {ratio}", times=round(detail.times, 4), ratio=ratio)


def _missed(curved: Curved) -> list[Caption]:
    """Sentences on the error of such chords, and on what those for a pencil read; none in the arc of a dwell.

    A hand that misses every point by sigma scatters rho by the root of six times sigma rho/h^2, on chords h: nine
    hands of ten read it within four times sigma rho/h^2.
    """
    places, mu_l = curved.acts["triple"].first, curved.givens.inverted.givens.mu_l.per_mm
    chords, rho = np.abs(np.diff(places.shown)), float(curved.value("rho"))
    if _place(curved).resting:
        return []
    said = say(
        "If every point may be off by {careful:g} mm, ρ may be off by {missed}: 4 × {careful:g} mm × ρ/h², with "
        "h = ({first:.2f} + {second:.2f})/2 = {chord:.1f} mm and ρ = {rho:.1f} mm on the profile."
    ).with_values(
        careful=CAREFUL_ERROR,
        missed=_percent(_share_missed(chords, rho / mu_l)),
        chord=float(chords.mean()),
        rho=rho / mu_l,
        first=chords[0],
        second=chords[1],
    )
    small = too_small_on_paper(curved)
    wide = _for_a_pencil(curved)
    if wide is None:
        return [said, *small]
    parts, other = wide
    longer, radius = np.abs(np.diff(other)), _radius_through(curved, other)
    wider = say(
        "For drawing by hand step off {parts} instead: with chords of {chord:.1f} mm ρ may be off by {missed}, and "
        "they give ρ = {other:.1f} mm instead of {rho:.1f} mm, because the curvature changes along them."
    )
    missed = _percent(_share_missed(longer, radius / mu_l))
    return [
        said,
        wider.with_values(parts=parts, chord=float(longer.mean()), missed=missed, other=radius, rho=rho),
        *small,
    ]


LEAST_READABLE_RADIUS = 10.0
"""A smaller radius of curvature cannot be told by three points [mm of paper]."""


def too_small_on_paper(curved: Curved) -> list[Caption]:
    """The sentence on a radius of curvature that is too small on paper; none where it can be told, or of a rest."""
    paper = float(curved.value("rho")) / curved.givens.inverted.givens.mu_l.per_mm
    if not paper < LEAST_READABLE_RADIUS or _place(curved).resting:
        return []
    said = say(
        "On paper ρ is only {paper:.1f} mm: at this scale it cannot be told by three points, because chords that are "
        "short enough for so sharp a bend are too short for a pencil. Draw the place at a larger scale."
    )
    return [said.with_values(paper=paper)]


def _share_missed(chords: Floats, rho: float) -> float:
    """The part of ρ that nine careful hands of ten miss it by; both on paper [mm]."""
    return 4 * CAREFUL_ERROR * rho / float(chords.mean()) ** 2


def _percent(part: float) -> Caption:
    return say("{part:.0f} %", part=100 * part) if part < 1 else say("more than ρ itself")


def _radius_through(curved: Curved, points: Points) -> float:
    """The radius [mm] of the circle through three points of the paper."""
    return float(np.abs(centre_of_circle(*points) - points[1])) * curved.givens.inverted.givens.mu_l.per_mm


def _for_a_pencil(curved: Curved) -> tuple[Caption, Points] | None:
    """How far apart a careful hand steps the points off, and where they lie; None where they lie so far apart."""
    inverted, curve = curved.givens.inverted, curved.acts["drawn curve"].first.shown
    stretches = stretches_of(inverted)
    steps = steps_along(inverted, stretches, curve, share_of_phase(CAREFUL_ERROR))
    at, radius = sharpest_of(inverted, np.append(curve, np.nan), steps)
    if not np.isfinite(radius) or at[1] - at[0] <= np.diff(_chosen_places(curved))[0]:
        return None
    return _parts_caption(int(at[1] - at[0])), curve[at]


def _parts_caption(places: int) -> Caption:
    """How many parts so many places of the drawn curve are."""
    return say("{parts:g} parts", parts=places / CURVE_PLACES)


def _bisected(curved: Curved, detail: Detail) -> Step:
    lines, settings = _bisectors(curved, detail)
    first = say(
        "Set the compass to {setting:.1f} mm ({share:g} of the first chord), strike arcs about both of its ends that "
        "cross on either side of it, and draw the line through the two crossings."
    )
    second = say("Do the same with {setting:.1f} mm on the second chord.")
    why = say("The centre of a circle is equally far from both ends of a chord.")
    told = (first.with_values(setting=settings[0], share=BISECTION_SHARE), second.with_values(setting=settings[1]))
    halves = [Part(caption, of) for caption, (_, of) in zip(told, lines, strict=True)]
    hub, marks = detail.hub, [mark for made, _ in lines for mark in made]
    found = Part(say("The two lines meet in O, the centre of curvature."), (hub,))
    title, all_marks = say("Perpendicular bisectors"), (*marks, hub.dots(Role.RESULT), hub.label("O", hub.place))
    return Step(title, (*halves, found), detail.view, all_marks, why=why)


def _measured(curved: Curved, detail: Detail) -> Step:
    said = say(
        "Join O to B with a ruler: OB measures {paper:.2f} mm, at {ratio}, so the minimum radius of curvature of "
        "the pitch curve is ρ = {rho:.3f} mm."
    )
    if curved.givens.profile:
        said = say(
            "Join O to B with a ruler: OB measures {paper:.2f} mm, at {ratio}, so the minimum radius of curvature of "
            "the profile is ρ = {rho:.3f} mm."
        )
    said = said.with_values(paper=abs(detail.hub.place), ratio=ratio_text(detail.per_mm), rho=curved.value("rho"))
    check = say(
        "Check with the compass: the arc about O through B passes through the neighbouring points and follows the "
        "curve closely."
    )
    why = say("The circle through the three points replaces the curve near B, and its radius is OB.")
    marks, ob, circle = _radius(curved, detail)
    parts = Part(said, (ob,)), Part(check, (circle,))
    return Step(say("Radius of curvature"), parts, detail.view, marks, why=why)


def _on_profile(curved: Curved) -> Step:
    triple, o, hand = curved.acts["triple"].first, curved.acts["centre"].first[0], errorless_hand(curved)
    ob, b = hand.join("OB", o, triple[1]), triple[1]
    said = say(
        "On the profile mark O too, {paper:.1f} mm from B, square to the pitch curve on its inner side: the roller's "
        "centre turns about it while the roller passes B."
    )
    why = say("The place of O shows how much of the cam is left between the roller and O.")
    if curved.givens.profile:
        said = say("On the profile mark O too, {paper:.1f} mm from B, square to the profile on its inner side.")
        why = say("While the face passes B the profile is nearly an arc about O.")
    said = said.with_values(paper=abs(b.place - o.place))
    marks = (
        Line(np.array([o.place, b.place]), Role.LIMIT).left_by(ob),
        *(o.dots(Role.LIMIT), o.label("O", o.place - b.place), b.label("B", b.place - o.place)),
    )
    missed = _missed(curved)
    parts = Part(said, (ob, o, b)), *([Part(sequence(missed, " "), (triple[[0, 2]],))] if missed else [])
    return Step(say("Centre of curvature on the profile"), tuple(parts), PROFILE, marks, reads=("rho",), why=why)


def _unreadable(curved: Curved) -> Caption:
    """A sentence on why there is no radius."""
    if corners := curved.givens.inverted.givens.integrated.givens.motion.corners:
        said = say(
            "At {places} the velocity falls at once: there the pitch curve has a corner, whose radius of curvature is "
            "zero. It limits no roller, for none follows it: the roller rounds the corner."
        )
        return said.with_values(places=and_list([degrees(phi) for phi in corners]))
    if np.ravel(curved.givens.corner)[0]:
        return say(
            "The curvature cannot be read: next to a dwell the curve turns by more than 45° within one part, so "
            "its sharpest point lies between the drawn points."
        )
    return say("The curvature cannot be read: the bisectors of neighbouring chords cross at less than a degree.")


def _chosen_places(curved: Curved) -> list[int]:
    """The three places that were taken: numbers of places of the drawn curve, then of the dwells."""
    return np.atleast_2d(curved.acts["triple"].act.takes["which"])[0].tolist()


@dataclass(frozen=True)
class ToldPlace:
    """Where B lies, and how the points beside it are found.

    resting : whether it lies on the arc of a rest
    """

    caption: Caption
    steps: tuple[Caption, ...]
    resting: bool


def _place(curved: Curved) -> ToldPlace:
    integrated = curved.givens.inverted.givens.integrated.givens
    motion, stations = integrated.motion, integrated.stations
    names, (before, at, after) = station_names(stations), _chosen_places(curved)
    first = 0
    for stretch in stretches_of(curved.givens.inverted):
        if at < first + stretch.count:
            place = stretch.stations.start + (at - first - stretch.own.start) / CURVE_PLACES
            low = math.floor(place)
            caption = say("station {name}", name=names[low])
            if low < place:
                caption = say("between the stations {before} and {after}", before=names[low], after=names[low + 1])
            told = [
                say(
                    "On the drawn curve step off {parts} before and after it, to P and Q.",
                    parts=_parts_caption(after - at),
                )
            ]
            image = say(
                "At station {name} the follower is at rest and the curve runs square to the ray from A, so take it to "
                "go on beyond as its mirror image in this ray: {point} is the image of the point of the curve there."
            )
            if before < first + stretch.own.start:
                told.append(image.with_values(name=names[stretch.stations.start], point="P"))
            elif after >= first + stretch.own.stop:
                told.append(image.with_values(name=names[stretch.stations.stop - 1], point="Q"))
            return ToldPlace(caption, tuple(told), resting=False)
        first += stretch.count
    last, turns = dwell_arcs(motion, stations)[(at - first) // 3]
    if turns[1]:  # no stations in dwells
        dwell = (int(stations.phase[last]) + 1) % len(motion.phases)
        return ToldPlace(say("the middle of a dwell ({symbol})", symbol=phase_symbol(motion, dwell)), (), resting=True)
    resting = say("station {name}, where the follower is at rest for an instant, on an arc about the cam centre")
    return ToldPlace(resting.with_values(name=names[last]), (), resting=True)


Bisected = tuple[list[Mark], tuple[Drawn, ...]]
"""The marks of one bisector, and what they are of."""


def _bisectors(curved: Curved, detail: Detail) -> tuple[list[Bisected], list[float]]:
    """The bisector of each chord with the arcs of the compass, as marks with their acts, and the settings [mm]."""
    hand, triple = detail.hand, detail.triple
    best = int(np.ravel(curved.acts["centre"].act.takes["which"])[0])
    origin, found, settings = curved.acts["triple"].first[1], list[Bisected](), list[float]()
    bisectors = [curved.acts[f"{which} bisectors"].first[best] for which in ("first", "second")]
    lines = [hand.enlarged(line.act.name, line, origin, detail.times) for line in bisectors]
    hub = hand.cross("O", *lines).place
    for k, line in enumerate(lines):
        a, b, middle = triple[k], triple[k + 1], line.place
        ends = np.array([middle - (hub - middle) * 0.12, hub + (hub - middle) * 0.06])
        setting = calculated_setting(partial(np.multiply, BISECTION_SHARE), distance_between(a, b))
        arcs = [hand.circle(f"arcs of {line.act.name}", end, setting) for end in (a, b)]
        marks: list[Mark] = [Line(ends, Role.CONSTRUCTION).left_by(line)]
        for meeting, arc in product((hand.cross("left", *arcs), hand.cross("right", *arcs[::-1])), arcs):
            to, radius = float(np.angle(meeting.place - arc.place)), float(np.asarray(arc.radius))
            marks.append(Arc(arc.place, radius, to - 0.12, to + 0.12, Role.CONSTRUCTION).left_by(arc))
        found.append((marks, (*arcs, line)))
        settings.append(float(setting.amount))
    return found, settings


def _radius(curved: Curved, detail: Detail) -> tuple[tuple[Mark, ...], Drawn, Drawn]:
    """The marks of the radius of curvature and of a little of its circle; with the acts of both."""
    hand, triple, hub = detail.hand, detail.triple, detail.hub
    ob, read = hand.join("OB", hub, triple[1]), curved.readings["rho"]
    circle = hand.circle("circle of curvature", hub, distance_between(hub, triple[1]))
    before, middle, after = triple.shown - hub.place
    turn, wide = float(np.angle(middle)), max(abs(float(np.angle(end / middle))) for end in (before, after))
    # The circle is shown a little beyond the chords.
    low, high = turn - 1.6 * wide, turn + 1.6 * wide
    said = say("ρ = {rho:.2f}", rho=float(curved.value("rho")))
    marks = (
        Line(np.array([hub.place, triple[1].place]), Role.LIMIT).left_by(ob),
        Arc(hub.place, abs(hub.place), low, high, Role.CONSTRUCTION).left_by(circle),
        Label(hub.place / 2, said, hub.place * UP, of=read.act),
    )
    return marks, ob, circle
