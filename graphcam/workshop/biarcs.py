"""A smooth curve as arcs with common tangents: biarcs within a tolerance.

Two places of a curve with their tangents are joined by two arcs with a common tangent, one at each place.  Of the
many such pairs that with two equal lengths of tangent is taken, d from either place:

    d = v.v / (v.t + sqrt((v.t)^2 + 2 (1 - t0.t1) v.v)),    v = p1 - p0,  t = t0 + t1,

written so that it holds for parallel tangents too.  From every place the next one is the farthest whose biarc keeps
the tolerance.  Sources: K. M. Bolton, "Biarc curves", *Computer-Aided Design* 7 (1975); D. S. Meek, D. J. Walton,
"Approximating smooth planar curves by arc splines", *J. Comput. Appl. Math.* 59 (1995).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.kinematics import Complexes
from graphcam.plane_vectors import dot

MIN_SAMPLES = 8
"""The minimum number of samples under a biarc: with fewer its distance from the curve is not known."""
SAME_CENTRE_DISTANCE = 5e-5
"""The maximum distance of two centres [mm] for arcs that touch to be one."""
STRAIGHT_RISE = 2e-5
"""The rise of an arc over its chord [mm] below which it is a straight line."""


@dataclass(frozen=True)
class Move:
    """A straight line, or an arc of less than a turn, in the plane [mm]; ``centre`` is None if straight."""

    start: complex
    end: complex
    centre: complex | None = None
    clockwise: bool = False

    def reversed(self) -> "Move":
        """The move in the opposite direction."""
        return Move(self.end, self.start, self.centre, not self.clockwise)

    @property
    def turn(self) -> float:
        """The angle by which an arc turns [rad], positive."""
        if self.centre is None:
            return 0.0
        turned = float(np.angle((self.end - self.centre) / (self.start - self.centre)))
        return (-turned if self.clockwise else turned) % math.tau


@dataclass(frozen=True)
class Biarc:
    """Two arcs through ``joint``; ``middle`` is their tangent there, ``error`` their distance from the curve [mm]."""

    joint: complex
    middle: complex
    error: float


def arcs_along(points: Complexes, tangents: Complexes, tolerance: float) -> tuple[list[Move], float] | None:
    """The arcs that follow a smooth curve, and their maximum distance from it [mm]; None if its samples are too few.

    points, tangents : (n,) dense samples of the curve, and its unit tangents there

    >>> phi = np.linspace(0, 1.5, 200)
    >>> moves, error = arcs_along(10 * np.exp(1j * phi), 1j * np.exp(1j * phi), 0.001)
    >>> len(moves), moves[0].clockwise, error < 1e-12
    (1, False, True)
    """
    moves: list[Move] = []
    greatest, here, last, guess = 0.0, 0, points.size - 1, points.size
    while here < last:
        guess = _longest_biarc(points, tangents, here, guess, tolerance)
        if guess < min(MIN_SAMPLES, last - here):
            return None
        there = here + guess
        biarc = _biarc(points[here : there + 1], tangents[here : there + 1])
        greatest = max(greatest, biarc.error)
        moves.append(_arc(complex(points[here]), biarc.joint, complex(tangents[here])))
        moves.append(_arc(biarc.joint, complex(points[there]), biarc.middle))
        here = there
    return merged_moves(moves), greatest


def _longest_biarc(points: Complexes, tangents: Complexes, here: int, guess: int, tolerance: float) -> int:
    """The number of samples to the farthest place whose biarc is within the tolerance; at least one."""
    good, bad, trial = 0, points.size - here, guess
    while bad - good > 1:
        trial = trial if good < trial < bad else (good + bad) // 2
        along = slice(here, here + trial + 1)
        if _biarc(points[along], tangents[along]).error <= tolerance:
            good, trial = trial, 2 * trial
        else:
            bad, trial = trial, (good + trial) // 2
    return max(good, 1)


def _biarc(points: Complexes, tangents: Complexes) -> Biarc:
    """The biarc from the first to the last of some samples; its error is infinite if it turns by 90 degrees or more."""
    p0, p1, t0, t1 = complex(points[0]), complex(points[-1]), complex(tangents[0]), complex(tangents[-1])
    v, t = p1 - p0, t0 + t1
    along, opened = float(dot(v, t)), 1 - float(dot(t0, t1))
    reach = along + math.sqrt(along**2 + 2 * max(opened, 0.0) * abs(v) ** 2)
    if opened >= 1 or not reach > 0:
        return Biarc(p1, t1, math.inf)
    d = abs(v) ** 2 / reach
    joint = (p0 + p1 + d * (t0 - t1)) / 2
    chord = (joint - p0) / t0
    middle = t0 * (chord / abs(chord)) ** 2
    first = dot(points - joint, middle) < 0
    errors = np.where(
        first, _deviations_from_circle(points, p0, t0, joint), _deviations_from_circle(points, joint, middle, p1)
    )
    return Biarc(joint, middle, float(np.abs(errors).max()))


def _deviations_from_circle(points: Complexes, start: complex, tangent: complex, end: complex) -> Floats:
    """Distances (n,) [mm] of points from the circle through two places with a tangent at the first, also a flat one."""
    seen, chord = (points - start) / tangent, (end - start) / tangent
    bend = 2 * chord.imag / abs(chord) ** 2
    off = seen.imag - bend * np.abs(seen) ** 2 / 2
    return 2 * off / (1 + np.sqrt(np.maximum(1 - 2 * bend * off, 0)))


def _arc(start: complex, end: complex, tangent: complex) -> Move:
    chord = (end - start) / tangent
    bend = 2 * chord.imag / abs(chord) ** 2
    if abs(bend) * abs(chord) ** 2 / 8 < STRAIGHT_RISE:
        return Move(start, end)
    return Move(start, end, start + 1j * tangent / bend, bend < 0)


def merged_moves(moves: list[Move]) -> list[Move]:
    """The moves, neighbours on one circle joined as far as they make up half a turn."""
    kept = moves[:1]
    for move in moves[1:]:
        last = kept[-1]
        if _on_one_circle(last, move) and last.turn + move.turn <= math.pi:
            kept[-1] = replace(last, end=move.end)
        else:
            kept.append(move)
    return kept


def _on_one_circle(one: Move, other: Move) -> bool:
    if one.centre is None or other.centre is None:
        return False
    return one.clockwise == other.clockwise and abs(one.centre - other.centre) <= SAME_CENTRE_DISTANCE
