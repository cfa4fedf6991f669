"""What every drawing about the cam centre has: closed curves, the phases' angles, the sense of the rotation."""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphcam.constructions.adoption import ChainSettings
from graphcam.constructions.axes import (
    degrees,
    number_labels,
    phase_angle,
    phase_symbol,
    phase_title,
    sense_caption,
    station_names,
)
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.acts import Drawn, Kind
from graphcam.drafting.euclid import RIGHT, UP, turned_direction, unit
from graphcam.drafting.hand import Direction, Hand, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, Words, say
from graphcam.drafting.marks import AngleMark, Arc, Dimension, Dots, Label, Line, Mark, Role, Segments
from graphcam.drafting.meaning import ReadingConvergence, ReadingMeaning
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, Scale
from graphcam.drafting.telling import FRENCH_CURVE, circle_caption, stretch_caption
from graphcam.given.follower import Rotation, sense
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.given.stations import Stations, falling_blows
from graphcam.words import say_in, sequence


@dataclass(frozen=True, eq=False)
class InvertedGivens(ChainSettings):
    """What every inversion starts from: the motion, its sense, the prime circle [mm], the profile's scale [mm/mm]."""

    integrated: Integrated
    rotation: Rotation
    prime_radius: float
    mu_l: Scale


Inverted = Construction[InvertedGivens]


PRIME_WHY = say(
    "Only the motion of the cam relative to the follower matters: with the cam held still, its outline "
    "is what the follower touches on its way round."
)
PHASE_ARC_OFFSET, PHASE_RAY_OVERRUN = 2.0, 2.0
"""How far the arcs of the phase angles lie outside all that is drawn in a phase, and their limits beyond them [mm]."""
PHASE_ARC_NEAREST, PHASE_TEXT_ROOM = 9.0, 13.0
"""Where the sheet has no more room they lie so far outside the pitch curve, and so far inside the room [mm]."""
CENTRE_LINE_OVERRUN = 9.0
"""How far the centre lines go beyond the pitch curve [mm]."""


CURVE_MEANINGS = {
    "x": ReadingMeaning(
        say("x"), "x", "mm", converges=ReadingConvergence("pitch curve", "pitch_curve", "from the pitch curve")
    ),
    "y": ReadingMeaning(say("y"), "y", "mm"),
    "radius": ReadingMeaning(say("polar radius"), "R", "mm"),
    "polar_angle": ReadingMeaning(say("polar angle"), "θ", "rad"),
}
"""What is read of the points of any follower's inverted motion."""
CURVE_READINGS = tuple(CURVE_MEANINGS)


def prime_circle(hand: Hand, prime_radius: float, mu_l: Scale) -> Drawn:
    """The prime circle, at the scale of the profile."""
    return hand.circle("prime circle", hand.given("cam centre"), prime_radius / mu_l.per_mm)


def inverted_positions(hand: Hand, integrated: Integrated, rotation: Rotation, base: Direction) -> Drawn:
    """The lines through the cam centre that a line of the frame takes at the stations, turned from ``base``."""
    # Numbered against the rotation: in the cam's view the frame goes round the other way.
    turns = -sense(rotation) * integrated.givens.stations.phi
    return hand.protractor("inverted positions", hand.given("cam centre"), base, turns)


def curve_readings(hand: Hand, curve: Drawn, mu_l: Scale) -> None:
    """``x``, ``y`` and ``radius`` [mm] and the ``polar_angle`` [rad] of points of a profile about the cam centre."""
    centre = hand.given("cam centre")
    for name, along in (("x", RIGHT), ("y", UP), ("radius", None)):
        hand.read(name, distance_between(centre, curve, along), mu_l.per_mm)
    hand.angle("polar_angle", RIGHT, hand.join("polar rays", centre, curve))


WORKED_STATION = 4
"""The station that a caption works out, counted in the first moving phase."""


def worked_station(stations: Stations) -> int:
    """The station that a caption works for all: the fourth, or the last of a phase of fewer parts."""
    first = stations.phases[0]
    return min(first.start + WORKED_STATION, first.stop - 1)


def position_words(inverted: Inverted) -> dict[str, Words]:
    """The caption's values for the inverted positions.

    rotation, against : how the cam turns, and how the follower goes round it
    angles : of the phases;  steps : from station to station in each moving phase
    name, angle : of the station that is worked out, counted from the start of the turn
    """
    motion, stations = inverted.givens.integrated.givens.motion, inverted.givens.integrated.givens.stations
    at = worked_station(stations)
    return {
        "rotation": sense_caption(inverted.givens.rotation),
        "against": inversion_sense(inverted),
        "angles": sequence([degrees(phase.angle) for phase in motion.phases]),
        "steps": sequence([_step_of(motion, stations, span) for span in stations.phases]),
        "name": station_names(stations)[at],
        "angle": turn_of(inverted, at),
    }


def _step_of(motion: Motion, stations: Stations, span: slice) -> Caption:
    """A caption of the angles from station to station in a moving phase: its stretches may be divided differently."""
    steps = np.diff(stations.phi[span])[~stations.blows[stations.parts[stations.phases.index(span)]]]
    new = np.append(True, ~np.isclose(np.diff(steps), 0.0))
    symbol = phase_symbol(motion, int(stations.phase[span.start]))
    each = [_turn(step) for step in steps[new]]
    return say("{steps} in {symbol}", steps=sequence(each, "/"), symbol=symbol)


def _turn(angle: float) -> Caption:
    return say("{angle:g}°", angle=round(math.degrees(angle), 2))


def turn_of(inverted: Inverted, station: int) -> Caption:
    """A caption of how far the follower has gone round at a station, from the start of the turn."""
    return _turn(float(inverted.givens.integrated.givens.stations.phi[station]))


def inversion_sense(inverted: Inverted) -> Caption:
    """The word for the sense in which the follower goes round the cam that stands still."""
    return sense_caption("ccw" if inverted.givens.rotation == "cw" else "cw")


@dataclass(frozen=True, eq=False)
class PiecewiseCurve:
    """A closed curve on the paper, piece by piece: faired between jumps, an arc about the cam centre in every dwell.

    whole : all of it;  rows : each piece, with its instrument;  rests : whether some are arcs of dwells
    """

    whole: Drawn
    rows: tuple[Row, ...]
    rests: bool

    def told(self, said: Caption, *more: Caption) -> Part:
        """The part that draws the pieces: ``said`` of those between the dwells, then their arcs, then ``more``."""
        arcs = (say("In the dwells swing arcs about A with the compass."),) if self.rests else ()
        return Part(sequence([said, *arcs, *more], " "), rows=self.rows)


def piecewise_curve(name: str, inverted: Inverted, points: Drawn) -> PiecewiseCurve:
    """A closed curve through one point a station: faired between jumps, an arc about the cam centre in every dwell.

    points : (m,) places on the paper, NaN where there is none
    """
    pieces = _pieces(name, inverted, points.first)
    known = np.flatnonzero(~np.isnan(np.concatenate([piece.points for _, piece in pieces])))
    whole = errorless_hand(inverted).take(name, *(piece for _, piece in pieces), which=known)
    ends = [0, *np.searchsorted(known, np.cumsum([piece.points.size for _, piece in pieces])).tolist()]
    # Where a phase has lost all its points there is no piece of it.
    left = [(k, piece, whole[a:b]) for (k, piece), (a, b) in zip(pieces, pairwise(ends), strict=True) if a < b]
    rows = tuple(_piece_row(inverted, k, piece, at) for k, piece, at in left)
    return PiecewiseCurve(whole, rows, any(k is not None and piece.act.kind is Kind.LAY_OFF for k, piece, _ in left))


def _pieces(name: str, inverted: Inverted, points: Drawn) -> list[tuple[int | None, Drawn]]:
    """The pieces of a closed curve in order, each with the number of its phase; None of an arc in a hollow corner."""
    hand, integrated = errorless_hand(inverted), inverted.givens.integrated
    motion, stations, sigma = integrated.givens.motion, integrated.givens.stations, sense(inverted.givens.rotation)
    spans = {int(stations.phase[span.start]): span for span in stations.phases}
    centre, found = hand.given("cam centre"), list[tuple[int | None, Drawn]]()
    missing, blows = np.isnan(points.points), stations.left[stations.blows].tolist()
    edges = {k for ends in falling_blows(motion, stations) for k in ends}
    turning = [j for j in blows if abs(points.points[j + 1] - points.points[j]) > NEGLIGIBLE_SIZE]
    off = np.angle(points.points * inverted.acts["pitch"].first.points.conj())
    at, since = missing.size - 1, stations.phi[-1] - FULL_TURN  # the end of the motion before
    for k, phase in enumerate(motion.phases):
        if k in spans:
            span = spans[k]
            pieces = [p for p in stations.pieces if span.start <= p.start < span.stop - 1]
            kept = [np.flatnonzero(~missing[piece]) + piece.start for piece in pieces]
            found += [
                (None, _about_roller(hand, f"{name} at {piece.start}", inverted, points, piece.start))
                if piece.start in turning
                else (k, hand.fair(f"{name} {k}", points[places], [slice(None)]))
                for piece, places in zip(pieces, kept, strict=True)
            ]
            at, since = span.stop - 1, stations.phi[span.stop - 1]
        else:
            # Where the point before the dwell is missing, the one after it lies on the same arc.
            after = (at + 1) % missing.size
            # An edge stands beside the ray of its station.
            beyond, before = (sigma * off[j] if j in edges else 0.0 for j in (at, after))
            steps = max(2, round(phase.angle / ARC_STEP))
            turns = motion.starts[k] - since + np.linspace(0, phase.angle - before + beyond, steps)
            end, back = (after, (stations.phi[after] - since) % FULL_TURN) if missing[at] else (at, 0.0)
            ray = hand.join(f"ray to the dwell {k}", centre, points[end])
            rays = hand.protractor(f"rays of the dwell {k}", centre, ray, sigma * (back - turns))
            found.append((k, hand.lay_off(f"{name} {k}", centre, rays, distance_between(centre, points[end]))))
    return found


def _about_roller(hand: Hand, name: str, inverted: Inverted, points: Drawn, at: int) -> Drawn:
    """The arc about the roller's centre in a hollow corner, where the contact passes from one point to another."""
    centre, ends = inverted.acts["pitch"].first[at], points[[at, at + 1]]
    first, last = (hand.join(f"ray to {name}", centre, ends[j]) for j in (0, 1))
    turn = float(np.angle(last.directions * np.conj(first.directions)))
    rays = hand.protractor(f"rays of {name}", centre, first, np.linspace(0, turn, max(2, round(abs(turn) / ARC_STEP))))
    return hand.lay_off(name, centre, rays, distance_between(centre, ends[0]))


def _piece_row(inverted: Inverted, k: int | None, piece: Drawn, drawn: Drawn) -> Row:
    """The row of a piece of a closed curve: from which station to which it is drawn, and with which instrument."""
    motion, stations = inverted.givens.integrated.givens.motion, inverted.givens.integrated.givens.stations
    if k is None:
        arc = say("compass, an arc about the point of the pitch curve")
        return Row(say("In the hollow corner"), arc, (drawn,))
    phase = phase_title(motion, k)
    if piece.act.kind is Kind.FAIR:
        names, at = station_names(stations), piece.act.takes["points"].index
        return Row(sequence([stretch_caption(names[at[0]], names[at[-1]]), phase]), FRENCH_CURVE, (drawn,))
    arc = say("compass {radius:.1f} mm, an arc of {angle} about A")
    arc = arc.with_values(radius=abs(piece.shown[0]), angle=degrees(motion.phases[k].angle))
    return Row(say("In the {phase}", phase=phase), arc, (drawn,))


ROTATION_ARC = 0.9
"""Length of the arc that shows the sense of the rotation [rad]."""
ARC_STEP = math.radians(1)
"""The arcs of a closed curve are drawn through points this far apart [rad]."""


def _dimensioned_radius(inverted: Inverted, circle: Drawn, start: complex) -> tuple[Mark, Drawn]:
    """The radius of the prime circle from its centre, in the middle of the longest phase, where there is most room.

    start : the direction in which the circle is at the start of the turn

    Returns
    -------
    its mark, and what it is of
    """
    motion: Motion = inverted.givens.integrated.givens.motion
    longest = int(np.argmax([phase.angle for phase in motion.phases]))
    middle = motion.starts[longest] + motion.phases[longest].angle / 2
    hand, sigma = errorless_hand(inverted), sense(inverted.givens.rotation)
    towards = complex(turned_direction(start / abs(start), -sigma * middle))
    ray = hand.erect("radius r₀", circle.first, towards)
    tip = hand.cross("tip of r₀", ray, circle.first)
    text = say("r₀ = R{radius:g}", radius=inverted.givens.prime_radius)
    return Dimension(ray.place, tip.place, text, of_radius=True).left_by(ray), ray


def rotation_arrow(direction: float, sigma: int, radius: float) -> Arc:
    """An arc about the cam centre that starts in a direction [rad] and points in the sense of the rotation."""
    start, end = sorted((direction, direction + sigma * ROTATION_ARC))
    return Arc(0j, radius, start, end, Role.CURVE, arrow="end" if sigma > 0 else "start")


def start_of_turn(inverted: Inverted) -> complex:
    """The place on the prime circle where the turn begins: a start of the lift, turned back; else above the centre."""
    turn = sense(inverted.givens.rotation) * inverted.givens.integrated.givens.stations.phi
    back = turned_direction(inverted.acts["starts"].shown, turn)
    return complex(np.append(back[~np.isnan(back)], UP)[0])


def phases_step(inverted: Inverted, roller: float) -> Step:
    """The step of the angles of the phases, against the rotation, each outside all that is drawn in its phase.

    They are counted from the point where the lift starts, of an arm and a swinging face from the pivot's first place.

    roller : the radius of the roller's circles [mm of paper]
    """
    motion: Motion = inverted.givens.integrated.givens.motion
    sigma, pivots = sense(inverted.givens.rotation), inverted.acts.get("pivots")
    start = start_of_turn(inverted) if pivots is None else RIGHT
    limits = np.angle(start) - sigma * np.append(motion.starts, FULL_TURN)
    spans = [(min(each), max(each)) for each in pairwise(limits.tolist())]
    radii = np.array([_reach(inverted, roller, *span) for span in spans]) + PHASE_ARC_OFFSET
    radii = np.minimum(radii, _outermost(inverted))
    hand = errorless_hand(inverted)
    rays = hand.erect("limits of the phases", hand.given("cam centre", 0j * limits[:-1]), np.exp(1j * limits[:-1]))
    of, index = rays.act, rays.index
    ends = (np.maximum(radii, np.roll(radii, 1)) + PHASE_RAY_OVERRUN) * rays.directions
    angles = [
        AngleMark(0j, radius, *span, phase_angle(motion, k), of=of, index=index[k : k + 1])
        for k, (radius, span) in enumerate(zip(radii.tolist(), spans, strict=True))
    ]
    said = say("Mark the angles of the phases outside, {against}: {angles}.").with_values(**position_words(inverted))
    why = say("While the follower does what it does in a phase, this part of the cam passes it.")
    marks = Segments(0.0 * ends, ends, Role.AXIS, of=of, index=index), *angles
    return Step(say("Phase angles"), (Part(said, (rays,)),), PROFILE, marks, why=why)


def _outermost(inverted: Inverted) -> float:
    """How far out an arc of a phase angle may lie [mm of paper]: no scale is coarser for arcs outside the rollers."""
    paper = inverted.givens.paper
    if not paper.bounded or paper.kept_scale(PROFILE.name) is not None:
        return math.inf  # a kept scale was chosen by the room that there is
    pitch = float(np.fmax.reduce(np.abs(inverted.first("pitch")), initial=0.0))
    return max(pitch + PHASE_ARC_NEAREST, min(paper.width, paper.height) / 2 - PHASE_TEXT_ROOM)


def _reach(inverted: Inverted, roller: float, start: float, end: float) -> float:
    """How far the curves and the roller's circles reach between two directions from the cam centre [mm of paper]."""
    places, pivots = inverted.first("pitch"), inverted.acts.get("pivots")
    seen = places[:, None] * np.exp(-1j * np.linspace(start, end, max(2, round((end - start) / ARC_STEP))))
    # Where a direction meets a circle the second time.
    across = roller**2 - seen.imag**2
    beyond = np.where(across >= 0, seen.real + np.sqrt(np.maximum(across, 0.0)), 0.0).max(axis=1)
    within = np.abs(np.angle(places * np.exp(-0.5j * (start + end)))) <= (end - start) / 2
    farthest = np.where(within, np.abs(places) + roller, beyond)
    inner = inverted.givens.prime_radius / inverted.givens.mu_l.per_mm
    return float(np.fmax.reduce(farthest, initial=inner if pivots is None else np.abs(pivots.first.points[0])))


def centre_line_end(inverted: Inverted) -> float:
    """How far the centre lines go from the cam centre, beyond prime circle and pitch curve [mm].

    It is the same for all directions, so that a worksheet does not tell where the curve will lie.
    """
    prime = inverted.givens.prime_radius / inverted.givens.mu_l.per_mm
    return float(np.fmax.reduce(np.abs(inverted.first("pitch")), initial=prime)) + CENTRE_LINE_OVERRUN


def centre_marks(inverted: Inverted) -> tuple[Mark, ...]:
    """Cam centre, centre lines and the sense of the rotation, as marks."""
    prime, sigma = inverted.givens.prime_radius / inverted.givens.mu_l.per_mm, sense(inverted.givens.rotation)
    return (
        *(Line(way * centre_line_end(inverted) * np.array([-1, 1]), Role.AXIS) for way in (RIGHT, UP)),
        rotation_arrow(-np.pi / 2, sigma, 0.6 * prime),
        Label(0.6 * prime * complex(turned_direction(-UP, sigma * ROTATION_ARC / 2)), "ω", towards=-UP + sigma),
        Dots(np.array([0j]), Role.RESULT),
        Label(0j, "A", towards=1 - 1j),
    )


def prime_step(
    inverted: Inverted,
    title: Caption,
    start: complex,
    circles: tuple[Mark, ...] = (),
    further: tuple[Mark, ...] = (),
    *,
    why: Caption = PRIME_WHY,
    parts: tuple[Part, ...] = (),
) -> Step:
    """The step that draws cam centre and prime circle, its radius towards ``start``, and what is drawn on them.

    parts : what is drawn after the prime circle
    """
    centre, circle = centre_marks(inverted), inverted.acts["prime circle"]
    radius, ray = _dimensioned_radius(inverted, circle, start)
    marks = (*centre, circle.drawn_circle(Role.CONSTRUCTION), *circles, radius, *further)
    prime = say_in("drawn", "the prime circle about the cam centre A")
    told = circle_caption(prime, "r₀", inverted.givens.prime_radius, inverted.givens.mu_l.per_mm)
    parts = (Part(told, (circle, ray)), *parts)
    return Step(title, parts, PROFILE, marks, given=centre, why=why)


PITCH_CURVE = say("Pitch curve")
PITCH_SAID = say("Join the points of each phase with the French curve, from jump to jump of the acceleration.")
PITCH_WHY = say(
    "The follower moves smoothly between the stations, and in a dwell keeps its distance from the cam centre."
)


def pitch_steps(
    inverted: Inverted,
    laid_off: Step,
    title: Caption = PITCH_CURVE,
    said: Caption = PITCH_SAID,
    why: Caption = PITCH_WHY,
) -> list[Step]:
    """The steps that find the points of the pitch curve, or of a profile under a flat face, and join them.

    laid_off : how the points are found, with its reason and its parts
    said : how the curve is drawn between the dwells
    """
    pitch, stations = inverted.acts["pitch"], inverted.givens.integrated.givens.stations
    points = (pitch.dots(Role.CONSTRUCTION), *number_labels(pitch, stations, unit(pitch.shown)))
    curve = piecewise_curve("pitch curve", inverted, pitch)
    line = curve.whole.line(Role.CURVE, closed=True)
    return [
        replace(laid_off, marks=(*laid_off.marks, *points)),
        Step(title, (curve.told(said),), PROFILE, (line,), why=why),
    ]
