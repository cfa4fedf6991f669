"""What every drawing about the cam centre has: closed curves, the phases' angles, the sense of the rotation."""

import math
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import degrees, numbers, phase_angle, turning
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import PROFILE
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP, turned, unit
from graphcam.drafting.hand import Direction, Hand, between, showing
from graphcam.drafting.ink import Caption, Construction, Step, Words, say
from graphcam.drafting.marks import AngleMark, Arc, Arrow, Dots, Label, Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Converges, ReadingMeaning
from graphcam.drafting.scale import Scale
from graphcam.given.follower import Rotation, sense
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.words import sequence


@dataclass(frozen=True, eq=False)
class InvertedGivens:
    """What every inversion starts from: the motion, its sense, the prime circle [mm], the profile's scale [mm/mm]."""

    integrated: Integrated
    rotation: Rotation
    prime_radius: float
    mu_l: Scale


Inverted = Construction[InvertedGivens]


BEYOND = 9.0
"""How far the arcs of the phase angles, and their numbers, lie outside the pitch curve [mm]."""


CURVE = {
    "x": ReadingMeaning(say("x"), "x", "mm", converges=Converges("pitch curve", "pitch_curve", "from the pitch curve")),
    "y": ReadingMeaning(say("y"), "y", "mm"),
    "radius": ReadingMeaning(say("polar radius"), "R", "mm"),
    "polar_angle": ReadingMeaning(say("polar angle"), "θ", "rad"),
}
"""What is read of the points of any follower's inverted motion."""
CURVE_READINGS = tuple(CURVE)


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
        hand.read(name, between(centre, curve, along), mu_l.per_mm)
    hand.angle("polar_angle", RIGHT, hand.join("polar rays", centre, curve))


def divided_by(inverted: Inverted) -> dict[str, Words]:
    """What a caption says of the inverted positions: the ``rotation`` they are numbered against, and the ``angles``."""
    phases = inverted.givens.integrated.givens.motion.phases
    angles = sequence([degrees(phase.angle) for phase in phases])
    return {"rotation": turning(inverted.givens.rotation), "angles": angles}


def closed_curve(name: str, inverted: Inverted, points: Drawn) -> Drawn:
    """A closed curve through one point a station: faired between jumps, an arc about the cam centre in every dwell.

    points : (m,) places on the paper, NaN where there is none
    """
    hand, integrated = showing(inverted), inverted.givens.integrated
    motion, stations, sigma = integrated.givens.motion, integrated.givens.stations, sense(inverted.givens.rotation)
    spans = {int(stations.phase[span.start]): span for span in stations.phases}
    points, centre, parts = points.first, hand.given("cam centre"), list[Drawn]()
    missing = np.isnan(points.points)
    at, since = missing.size - 1, stations.phi[-1] - FULL_TURN  # the end of the motion before
    for k, phase in enumerate(motion.phases):
        if k in spans:
            span = spans[k]
            pieces = [p for p in stations.pieces if span.start <= p.start < span.stop - 1]
            kept = [np.flatnonzero(~missing[piece]) + piece.start for piece in pieces]
            parts += [hand.fair(f"{name} {k}", points[places], [slice(None)]) for places in kept]
            at, since = span.stop - 1, stations.phi[span.stop - 1]
        else:
            turns = motion.starts[k] - since + np.linspace(0, phase.angle, max(2, round(phase.angle / ARC_STEP)))
            # Where the point before the dwell is missing, the one after it lies on the same arc.
            after = (at + 1) % missing.size
            end, back = (after, (stations.phi[after] - since) % FULL_TURN) if missing[at] else (at, 0.0)
            ray = hand.join(f"ray to the dwell {k}", centre, points[end])
            rays = hand.protractor(f"rays of the dwell {k}", centre, ray, sigma * (back - turns))
            parts.append(hand.lay_off(f"{name} {k}", centre, rays, between(centre, points[end])))
    known = ~np.isnan(np.concatenate([part.points for part in parts]))
    return hand.take(name, *parts, which=np.flatnonzero(known))


ROTATION_ARC = 0.9
"""Length of the arc that shows the sense of the rotation [rad]."""
ARC_STEP = math.radians(1)
"""The arcs of a closed curve are drawn through points this far apart [rad]."""


def radius_arrow(inverted: Inverted, circle: Drawn, start: complex, symbol: str, radius: float) -> tuple[Mark, ...]:
    """An arrow to a circle from its centre, in the middle of the longest phase, where there is most room.

    start : the direction in which the circle is at the start of the turn; radius : of the machine [mm]
    """
    motion: Motion = inverted.givens.integrated.givens.motion
    longest = int(np.argmax([phase.angle for phase in motion.phases]))
    middle = motion.starts[longest] + motion.phases[longest].angle / 2
    hand, sigma = showing(inverted), sense(inverted.givens.rotation)
    towards = complex(turned(start / abs(start), -sigma * middle))
    ray = hand.erect(f"radius {symbol}", circle.first, towards)
    tip = hand.cross(f"tip of {symbol}", ray, circle.first)
    text = say("{symbol} = {radius:g}", symbol=symbol, radius=radius)
    return (
        Arrow(ray.place, tip.place, Role.DIMENSION, of=ray.act),
        hand.divide(symbol, ray, tip, 0.6).label(text, tip.place * UP),
    )


def rotation_arrow(direction: float, sigma: int, radius: float) -> Arc:
    """An arc about the cam centre that starts in a direction [rad] and points in the sense of the rotation."""
    start, end = sorted((direction, direction + sigma * ROTATION_ARC))
    return Arc(0j, radius, start, end, Role.CURVE, arrow="end" if sigma > 0 else "start")


def start_of_turn(inverted: Inverted) -> complex:
    """Where the turn begins on the prime circle: a start of the lift, turned back; above the centre if none is read."""
    turn = sense(inverted.givens.rotation) * inverted.givens.integrated.givens.stations.phi
    back = turned(inverted.acts["starts"].shown, turn)
    return complex(np.append(back[~np.isnan(back)], UP)[0])


def phase_angles(inverted: Inverted, start: complex) -> list[Mark]:
    """The angles of the phases outside the curve, against the rotation, from the point where the lift starts."""
    motion: Motion = inverted.givens.integrated.givens.motion
    sigma, radius = sense(inverted.givens.rotation), _outer_radius(inverted)
    limits = np.angle(start) - sigma * np.append(motion.starts, FULL_TURN)
    rays: Points = np.exp(1j * limits[:-1])
    turns, of = enumerate(pairwise(limits)), inverted.acts["inverted positions"].act
    angles = [AngleMark(0j, radius, min(a, b), max(a, b), phase_angle(motion, k), of) for k, (a, b) in turns]
    return [Segments(0.0 * rays, (radius + BEYOND / 2) * rays, Role.AXIS), *angles]


def _outer_radius(inverted: Inverted) -> float:
    """Where the arcs of the phase angles are drawn: outside the prime circle and the pitch curve [mm of paper]."""
    prime = inverted.givens.prime_radius / inverted.givens.mu_l.per_mm
    return float(np.fmax.reduce(np.abs(inverted.first("pitch")), initial=prime)) + BEYOND


def ground(inverted: Inverted) -> tuple[Mark, ...]:
    """Cam centre, centre lines and the sense of the rotation."""
    prime, sigma = inverted.givens.prime_radius / inverted.givens.mu_l.per_mm, sense(inverted.givens.rotation)
    reach = (_outer_radius(inverted) + BEYOND) * np.array([-1, 1])
    return (
        Line(reach + 0j, Role.AXIS),
        Line(UP * reach, Role.AXIS),
        rotation_arrow(-np.pi / 2, sigma, 0.6 * prime),
        Label(0.6 * prime * complex(turned(-UP, sigma * ROTATION_ARC / 2)), "ω", towards=-UP + sigma),
        Dots(np.array([0j]), Role.RESULT),
    )


def prime_step(
    inverted: Inverted,
    title: Caption,
    said: Caption,
    start: complex,
    circles: tuple[Mark, ...] = (),
    further: tuple[Mark, ...] = (),
) -> Step:
    """Cam centre and prime circle, with its radius towards ``start``, other circles, and what is drawn on them."""
    centre, circle = ground(inverted), inverted.acts["prime circle"]
    arrow = radius_arrow(inverted, circle, start, "r₀", inverted.givens.prime_radius)
    marks = (*centre, circle.drawn_circle(Role.CONSTRUCTION), *circles, *arrow, *further)
    return Step(title, said, PROFILE, marks, given=centre)


PITCH_CURVE = say("Pitch curve")
PITCH_SAID = say("A smooth curve through the points, with arcs about the centre in the dwells, is the pitch curve.")


def pitch_steps(
    inverted: Inverted, laid_off: Step, title: Caption = PITCH_CURVE, said: Caption = PITCH_SAID
) -> list[Step]:
    """The points of the pitch curve, or of the profile under a flat face, and the curve through them."""
    pitch, stations = inverted.acts["pitch"], inverted.givens.integrated.givens.stations
    points = (pitch.dots(Role.CONSTRUCTION), *numbers(pitch, stations, unit(pitch.shown)))
    curve = closed_curve("pitch curve", inverted, pitch).line(Role.CURVE, closed=True)
    return [replace(laid_off, marks=(*laid_off.marks, *points)), Step(title, said, PROFILE, (curve,))]
