"""Curvature of the pitch curve by three points, at its sharpest place.

The perpendicular bisectors of two neighbouring chords meet in the centre of the circle through the three points.  In a
dwell the pitch curve is an arc about the cam centre; its ends and its middle are three such points.
"""

import math
from dataclasses import dataclass
from functools import partial
from itertools import product

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import phase_symbol, station_names
from graphcam.constructions.profile_view import Inverted
from graphcam.constructions.views import CURVATURE, PROFILE, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP, centre_of_circle, crossing, perpendicular_bisector
from graphcam.drafting.hand import COMPASS, Hand, between, reckoned, showing
from graphcam.drafting.ink import Caption, Construction, Step, say
from graphcam.drafting.marks import Arc, Label, Line, Mark, Points, Role
from graphcam.drafting.meaning import Compared, Converges, Meaning, ReadingMeaning, sharpness
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import ratio_text, standard_scale
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Moving
from graphcam.given.stations import Stations
from graphcam.plane import cross, dot
from graphcam.words import sequence


@dataclass(frozen=True, eq=False)
class CurvatureGivens:
    """The pitch curve, and in which samples it turns a corner."""

    inverted: Inverted
    corner: NDArray[np.bool_]


Curved = Construction[CurvatureGivens]


LEAST_CURVATURE = {
    "rho": ReadingMeaning(
        say("least radius of curvature ρ"),
        "ρ",
        "mm",
        (
            Compared(
                "min_pitch_curvature_radius",
                say("least curvature radius ρ"),
                "rho_candidates",
                (np.negative, sharpness),
            ),
        ),
        Converges("least curvature radius", "min_moving_curvature_radius", of="rho_candidates"),
    )
}
"""The least radius of curvature, however it is found."""
MEANING = Meaning(
    "curvature",
    say("Least radius of curvature"),
    say(
        "Three near points of a curve determine the circle that fits it best. The least radius of curvature limits "
        "the roller."
    ),
    {**LEAST_CURVATURE, "phi": ReadingMeaning(say("cam angles φ"), "φ", "rad")},
    "report.paragraphs.curvature",
)


def curvature(inverted: Inverted, pencil: Pencil) -> Curved:
    """Find the sharpest convex place among three neighbouring points of a smooth piece, and the arcs of the rests.

    Readings: besides ``rho`` and ``phi`` the ``rho_candidates`` (..., 2), of moving phases and of rests, infinite
    where nothing is convex.  NaN where no bend is readable, and of the moving phases and of rho where the curve turns a
    corner that three points cannot tell.
    Points: the ``triple`` (..., 3) at the sharpest place and its ``centre``.
    """
    hand, integrated, mu_l = Hand(pencil, MEANING), inverted.givens.integrated, inverted.givens.mu_l.per_mm
    pitch, centre, nowhere = hand.found(inverted, "pitch"), hand.given("cam centre"), hand.given("nowhere", [np.nan])
    rests, angles = _rests(hand, inverted, pitch, centre)
    places, corner = hand.take("places", pitch, rests, nowhere), _turns_a_corner(inverted)
    # The eye takes one place of the moving phases and one of the rests.
    of_rests = inverted.points["pitch"].shape[-1] + np.arange(rests.points.shape[-1]).reshape(-1, 3)
    candidates = _neighbours(inverted), np.broadcast_to(of_rests, (*rests.points.shape[:-1], *of_rests.shape))
    seen = [_sharpest(inverted, places.points, triples) for triples in candidates]
    at, looks = np.stack([triple for triple, _ in seen], axis=-2), np.stack([radius for _, radius in seen], axis=-1)
    # Where nothing rests no arc is near, seen from any place.
    at[..., 1, :] = np.where(np.isnan(looks[..., 1:]), 0, at[..., 1, :])
    names = ("before B", "B", "after B")
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
    # On the axis the place has its station's mark; it is carried down to the scale of degrees, where it is read.
    marks, degrees_axis = hand.take("cam angles", angles, nowhere, which=chosen), hand.given("degrees", along=RIGHT)
    phi = between(hand.given("start of the turn"), hand.project("on the degrees", marks, degrees_axis), RIGHT)
    hand.read("rho", between(triple[1], o), mu_l)
    hand.read("rho_candidates", between(b, centres), mu_l, "mm")
    in_radians = partial(np.multiply, integrated.givens.mu_phi.per_mm)
    hand.read("phi", reckoned(in_radians, phi), 1.0, rounded=False)
    return hand.finished(CurvatureGivens(inverted, corner), _draw, {"triple": triple, "centre": o})


Triples = NDArray[np.intp]
"""(..., k, 3) which three points each: of those of the pitch curve, then of the rests, then one that is nowhere."""


def _neighbours(inverted: Inverted) -> Triples:
    """Every station with its neighbours, never across a jump of the acceleration.

    Where the bisectors cross at less than a degree the second neighbours are taken in place of the first, or the
    fourth, and so on: with very many parts the chords between neighbours hardly bend.
    """
    stations, pitch = inverted.givens.integrated.givens.stations, inverted.points["pitch"]
    middle = np.concatenate([np.arange(piece.start + 1, piece.stop - 1) for piece in stations.pieces])
    within = [np.arange(1, piece.stop - piece.start - 1) for piece in stations.pieces]
    reach = np.concatenate([np.minimum(inside, inside[::-1]) for inside in within])
    step = np.ones((*pitch.shape[:-1], middle.size), dtype=np.intp)
    while True:
        at = np.stack([middle - step, middle + 0 * step, middle + step], axis=-1)
        wider = np.isnan(_centres(inverted, _at(pitch, at))) & (2 * step <= reach)
        if not wider.any():
            return at
        step = np.where(wider, 2 * step, step)


INSTANT = math.radians(5)
"""Three points of the arc of an instant's rest are taken so far apart."""
NO_ACCELERATION = 1e-9
"""Part of the greatest acceleration that is none."""


def _resting(motion: Motion, stations: Stations) -> list[tuple[int, Floats]]:
    """After which station the follower rests, and how far round three places of its arc lie [rad].

    Where two moving phases meet and the acceleration of either vanishes, it rests for an instant.
    """
    before = stations.phase[stations.last]
    # What follows a moving phase is a dwell or the next moving phase; the last is followed by the first.
    following = (before + 1) % len(motion.phases)
    vanishes = _vanishes(motion, before, 1.0) | _vanishes(motion, following, 0.0)
    found: list[tuple[int, Floats]] = []
    for last, k, instant in zip(stations.last.tolist(), following, vanishes, strict=True):
        phase = motion.phases[k]
        if isinstance(phase, Dwell):
            found.append((last, phase.angle * np.array([0.0, 0.5, 1.0])))
        elif instant:
            found.append((last, INSTANT * np.array([-1.0, 0.0, 1.0])))
    return found


def _rests(hand: Hand, inverted: Inverted, pitch: Drawn, centre: Drawn) -> tuple[Drawn, Drawn]:
    """Three points on the arc of each rest, and the places of all points on the axis of the cam angle."""
    integrated = inverted.givens.integrated.givens
    resting = _resting(integrated.motion, integrated.stations)
    last = np.array([after for after, _ in resting], dtype=np.intp)
    turns, each = np.ravel([turn for _, turn in resting]), np.repeat(np.arange(last.size), 3)
    arcs = hand.circle("arcs of the rests", centre, between(centre, pitch[last]))
    ends = hand.join("rays to the rests", centre, pitch[last])[each]
    rays = hand.protractor("rays of the rests", centre, ends, -sense(inverted.givens.rotation) * turns)
    axis = hand.found(integrated.diagram, "axis")
    beyond = hand.lay_off("rests on the axis", axis[last][each], RIGHT, turns / integrated.mu_phi.per_mm)
    return hand.cross("rests", rays, arcs[each]), hand.take("axis", axis, beyond)


def _vanishes(motion: Motion, phases: NDArray[np.intp], u: float) -> NDArray[np.bool_]:
    """Of which phases the given acceleration is zero at the end u; of a dwell too."""
    ends = [motion.phases[k] for k in phases]
    greatest = [p.normalised.peak_acceleration * p.lift / p.angle**2 if isinstance(p, Moving) else 0.0 for p in ends]
    return np.abs(motion.at(phases, u)[2]) <= NO_ACCELERATION * np.array(greatest)


def _at(points: Points, at: Triples) -> Points:
    return np.take_along_axis(points[..., None, :], at, -1)


def _centres(inverted: Inverted, triples: Points) -> Points:
    """The centres of the circles through three points (..., 3); NaN where the bisectors cross at less than a degree.

    In a drawing that is divided again to see what finer parts would change, every crossing counts.
    """
    a, b, c = np.moveaxis(triples, -1, 0)
    if inverted.givens.integrated.givens.stations.refine > 1:
        return crossing(*perpendicular_bisector(a, b), *perpendicular_bisector(b, c))
    return centre_of_circle(a, b, c)


def _sharpest(inverted: Inverted, points: Points, triples: Triples) -> tuple[NDArray[np.intp], Floats]:
    """(..., 3) which of the triples of points (..., m) looks bent most, and the radius on paper.

    The radius is infinite where no bend is convex, NaN where none can be read.
    """
    none = np.full_like(triples, points.shape[-1] - 1, shape=(*triples.shape[:-2], 1, 3))
    triples = np.concatenate([triples, none], axis=-2)
    shown = _at(points, triples)
    a, b, c = np.moveaxis(shown, -1, 0)
    centres = _centres(inverted, shown)
    # Numbered against the rotation, a convex curve turns the other way than the cam.
    convex = sense(inverted.givens.rotation) * cross(b - a, c - b) < 0
    radii = np.where(np.isnan(centres), np.nan, np.where(convex, np.abs(centres - b), np.inf))
    best = np.argmin(np.where(np.isnan(radii), np.inf, radii), axis=-1)[..., None]
    return np.take_along_axis(triples, best[..., None], -2)[..., 0, :], np.fmin.reduce(radii, axis=-1)


CORNER = math.radians(45)
"""A curve that turns by so much more than the follower does between a rest and the next point has a corner there."""


def _turns_a_corner(inverted: Inverted) -> NDArray[np.bool_]:
    """Whether the pitch curve turns inwards by more than can be read between the end of a phase and the next point.

    Where the follower rests the curve runs square to the ray from the cam centre.
    """
    stations, pitch = inverted.givens.integrated.givens.stations, inverted.points["pitch"]
    ends = np.array([[span.start, span.stop - 1] for span in stations.phases]).ravel()
    onwards = np.tile([1, -1], len(stations.phases))
    end, following = pitch[..., ends], pitch[..., ends + onwards]
    chord, along = following - end, -sense(inverted.givens.rotation) * onwards * UP * end
    # The chord of an arc about the cam centre leaves it by half of what the cam has turned.
    by_turning = np.abs(np.angle(following * end.conj())) / 2
    return np.any((dot(chord, end) < 0) & (np.abs(np.angle(chord * along.conj())) > by_turning + CORNER), axis=-1)


# --- the steps -------------------------------------------------------------------------------------------------------

DETAIL = 70.0
"""The detail is enlarged to the largest standard scale at which the radius of curvature is not longer [mm]."""
READABLE_STEP = math.radians(10)
"""Over a smaller step of the cam angle a hand's error outweighs the bend."""
ONLY_RESTS = say(
    "In the moving phases no bend is readable, for too few points stand between the jumps of the acceleration: only "
    "the rests are compared. More parts are needed."
)
"""What is said where the radius of the moving phases is not known."""


def _draw(curved: Curved) -> list[Step]:
    inverted = curved.givens.inverted
    if np.isnan(curved.first("centre")):
        return [Step(say("Curvature at the sharpest place"), _unreadable(curved), PROFILE, ())]
    triple, o, hand = curved.acts["triple"].first, curved.acts["centre"].first[0], showing(curved)
    scale = standard_scale(float(curved.value("rho")), DETAIL)
    curvature, times = at_scale(CURVATURE, scale), inverted.givens.mu_l.per_mm / scale.per_mm
    detail, hub = (hand.enlarged(d.act.name, d, triple[1], times) for d in (triple, o))
    first, second = np.abs(np.diff(detail.shown))
    place, names = _named(curved)
    sharpest = say(
        "The sharpest place is B, {place}, at φ = {phi:.1f}°. The chords to its neighbours are drawn enlarged, at "
        "{ratio}: {first:.2f} mm and {second:.2f} mm. {spread}"
    ).where(place=place, phi=np.degrees(curved.first("phi")[1] % FULL_TURN), ratio=ratio_text(scale.per_mm))
    named = [detail[k].label(name, -hub.place) for k, name in enumerate((names[0], "B", names[1]))]
    chords = (detail.line(Role.CURVE), detail.dots(), *named)
    bisected = say("The chords are bisected; the perpendiculars meet in O, the centre of curvature.")
    measured = say(
        "OB measures {paper:.2f} mm, so the least radius of curvature of the pitch curve is ρ = {rho:.3f} mm."
    ).where(paper=abs(hub.place), rho=curved.value("rho"))
    marked = say("On the profile the centre of curvature of the sharpest place is marked.")
    ob = hand.join("OB", o, triple[1])
    on_profile = (
        *(Line(np.array([o.place, triple[1].place]), Role.LIMIT, of=ob.act), o.dots(Role.LIMIT)),
        o.label("O", o.place - triple[1].place),
    )
    enlarging = sharpest.where(first=first, second=second, spread=_spread(curved))
    return [
        Step(say("Chords at the sharpest place"), enlarging, curvature, chords, reads=("phi",)),
        Step(say("Perpendicular bisectors"), bisected, curvature, _bisectors(curved, hand, detail, times)),
        Step(say("Radius of curvature"), measured, curvature, _radius(curved, hand, detail, hub)),
        Step(say("Centre of curvature on the profile"), marked, PROFILE, on_profile, reads=("rho",)),
    ]


def _spread(curved: Curved) -> Caption:
    """What step of the cam angle the chords span, and what that is worth."""
    phi = curved.first("phi")
    said = [say("They span {step:.3g}° of the cam angle.", step=np.degrees(phi[2] - phi[0]))]
    if phi[2] - phi[0] < READABLE_STEP:
        said.append(say("Over so small a step a hand's error is large."))
    if np.isnan(curved.first("rho_candidates")[0]):
        said.append(ONLY_RESTS)
    return sequence(said, " ")


def _unreadable(curved: Curved) -> Caption:
    """Why there is no radius."""
    if np.ravel(curved.givens.corner)[0]:
        return say(
            "No bend is readable: beside a rest the curve turns by more than 45° within one part, so its sharpest "
            "place lies between the points."
        )
    return say("No bend is readable: the bisectors of neighbouring chords cross at less than a degree.")


def _named(curved: Curved) -> tuple[Caption, tuple[str, str]]:
    """What the middle place of three is called, and its two neighbours."""
    integrated = curved.givens.inverted.givens.integrated.givens
    motion, stations = integrated.motion, integrated.stations
    names, at = station_names(stations), np.atleast_2d(curved.acts["triple"].act.takes["which"])[0]
    if at[1] < len(names):
        return say("station {name}", name=names[at[1]]), (names[at[0]], names[at[2]])
    last, turns = _resting(motion, stations)[(at[1] - len(names)) // 3]
    if turns[1]:  # no stations in dwells
        dwell = (int(stations.phase[last]) + 1) % len(motion.phases)
        return say("the middle of a dwell ({symbol})", symbol=phase_symbol(motion, dwell)), ("", "")
    resting = say("station {name}, where the follower rests for an instant on an arc about the cam centre")
    return resting.where(name=names[last]), ("", "")


def _bisectors(curved: Curved, hand: Hand, detail: Drawn, times: float) -> tuple[Mark, ...]:
    """The lines from beyond the middles of the chords to the centre, and the arcs of the compass that found them."""
    best = int(np.ravel(curved.acts["centre"].act.takes["which"])[0])
    origin = curved.acts["triple"].first[1]
    drawn = [curved.acts[f"{which} bisectors"].first[best] for which in ("first", "second")]
    lines = [hand.enlarged(line.act.name, line, origin, times) for line in drawn]
    hub = hand.cross("O", *lines).place
    marks = list[Mark]()
    for k, line in enumerate(lines):
        a, b, middle = detail[k], detail[k + 1], line.place
        ends = np.array([middle - (hub - middle) * 0.12, hub + (hub - middle) * 0.06])
        marks.append(Line(ends, Role.CONSTRUCTION, of=line.act))
        setting = reckoned(partial(np.multiply, COMPASS), between(a, b))
        arcs = [hand.circle(f"arcs of {line.act.name}", end, setting) for end in (a, b)]
        for meeting, arc in product((hand.cross("left", *arcs), hand.cross("right", *arcs[::-1])), arcs):
            to, radius = float(np.angle(meeting.place - arc.place)), float(np.asarray(arc.radius))
            marks.append(Arc(arc.place, radius, to - 0.12, to + 0.12, Role.CONSTRUCTION, of=arc.act))
    return tuple(marks)


def _radius(curved: Curved, hand: Hand, detail: Drawn, hub: Drawn) -> tuple[Mark, ...]:
    """The radius of curvature, from the centre to the middle place, and a little of its circle."""
    ob, read = hand.join("OB", hub, detail[1]), curved.readings["rho"]
    circle = hand.circle("circle of curvature", hub, between(hub, detail[1]))
    before, middle, after = detail.shown - hub.place
    turn, wide = float(np.angle(middle)), max(abs(float(np.angle(end / middle))) for end in (before, after))
    # The circle is shown a little beyond the chords.
    low, high = turn - 1.6 * wide, turn + 1.6 * wide
    said = say("ρ = {rho:.2f}", rho=float(curved.value("rho")))
    return (
        Line(np.array([hub.place, detail[1].place]), Role.LIMIT, of=ob.act),
        Arc(hub.place, abs(hub.place), low, high, Role.CONSTRUCTION, of=circle.act),
        hub.dots(Role.RESULT),
        hub.label("O", hub.place),
        Label(hub.place / 2, said, hub.place * UP, of=read.act),
    )
