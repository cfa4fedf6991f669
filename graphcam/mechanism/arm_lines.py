"""The lines that bound the region for the cam centre of an arm, on the side to which the velocity drives the angle.

What they are is said in :mod:`~graphcam.mechanism.least_radius_arm`.  With P = l + R, the vector from the pivot to the
cam centre, |P| = c, the point R lies beyond the line of a place by

    E = l cos(A) (|v| + tau) - tau c cos(psi - tau A),   E' = l cos(A) |v|' + s' (conj(n) P).imag

where w is the fraction of a leg from its lower end, and a dash is the derivative by it.
"""

import cmath
import math
from bisect import bisect_right
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.half_planes import HalfPlane, Line
from graphcam.mechanism.leg_places import LegPlaces, OneLeg

SAME_PLACE = 1e-9
"""Fraction of a phase; at a greatest value a step this small no longer changes the value in double precision."""


class Side(NamedTuple):
    """The lines of all rises or of all returns.

    tau : +1 or -1, the side of the limit [rad];  force : l cos(A) [mm]
    """

    name: Line
    tau: int
    limit: float
    arm: float
    force: float
    legs: LegPlaces

    def excess(self, point: complex) -> Floats:
        """How far the point lies beyond the line of each place, over l cos(A), less tau."""
        from_pivot = self.arm + point
        beyond = self.legs.s + (cmath.phase(from_pivot) - self.tau * self.limit)
        np.cos(beyond, beyond)
        beyond *= -self.tau * abs(from_pivot) / self.force
        beyond += self.legs.v
        return beyond

    def peaks(self, excess: Floats, kept: Sequence[HalfPlane]) -> list[int]:
        """The numbers of places beside which the excess may exceed 0, but for those where a line touches already."""
        rising = excess[1:] > excess[:-1]
        found: list[int] = []
        for k in (rising[:-1] > rising[1:]).nonzero()[0].tolist():
            before, here, after = excess[k : k + 3].tolist()
            # A peak rises above its sample by an eighth of the second difference, if its neighbours are as far.
            if 3 * here - before - after + self.tau >= 0 and not [line for line in kept if self._touches(line, k + 1)]:
                found.append(k + 1)
        return found

    def _touches(self, line: HalfPlane, k: int) -> bool:
        """Whether a line touches beside the k-th place."""
        if line.touch is None or line.touch.side is not self:
            return False
        w = self.legs.w
        return line.touch.leg is self.legs.leg_of(k) and w.item(k - 1) <= line.touch.w <= w.item(k + 1)

    def number(self, k: int, point: complex) -> HalfPlane:
        """The line of the k-th place; at a break it belongs to the piece into which the excess grows."""
        leg, w = self.legs.leg_of(k), self.legs.w.item(k)
        ends = (0.0, *leg.law.breaks, 1.0)
        piece = bisect_right(ends, w, hi=len(ends) - 1)
        line = self.line(leg, w, ends[piece - 1], ends[piece])
        if 0 < w == ends[piece - 1] and slopes(line, point)[0] <= 0:
            return self.line(leg, w, ends[piece - 2], w)
        return line

    def line(self, leg: OneLeg, w: float, low: float, high: float) -> HalfPlane:
        """The line of a place of a smooth piece between two others."""
        f, f1, f2, f3 = leg.law.at(w, "left" if w == high else "right")
        half, turned = (leg.low + leg.lift * f) / 2, self.tau * self.limit
        lowered = 2 * self.arm * math.sin(half) * math.sin(turned - half)
        height = self.force * leg.lift / leg.angle * f1 - self.tau * lowered
        return HalfPlane(
            self.name, cmath.rect(self.tau, turned - 2 * half), height, Touch(self, leg, w, low, high, f1, f2, f3)
        )

    def greatest(self, k: int, point: complex) -> HalfPlane:
        """The line, of those beside the k-th place, that the point lies farthest beyond."""
        line = self.number(k, point)
        low, high = max(line.touch.low, self.legs.w.item(k - 1)), min(line.touch.high, self.legs.w.item(k + 1))
        while True:
            leg, w = line.touch.leg, line.touch.w
            low, high = (w, high) if slopes(line, point)[0] > 0 else (low, w)
            place = higher(line, point, low, high)
            if abs(place - w) <= SAME_PLACE:
                return line
            line = self.line(leg, place, line.touch.low, line.touch.high)


class Touch(NamedTuple):
    """A place at which a line touches: side, place w of a leg, ends of its smooth piece, and f', f'', f''' there."""

    side: Side
    leg: OneLeg
    w: float
    low: float
    high: float
    f1: float
    f2: float
    f3: float


def slopes(line: HalfPlane, point: complex) -> tuple[float, float]:
    """The first and the second derivative of the excess by w."""
    side, leg, _, _, _, f1, f2, f3 = line.touch
    seen, along, pushed = line.normal.conjugate() * (side.arm + point), leg.lift * f1, side.force * leg.lift / leg.angle
    return pushed * f2 + along * seen.imag, pushed * f3 + leg.lift * f2 * seen.imag + along * along * seen.real


def higher(line: HalfPlane, point: complex, low: float, high: float) -> float:
    """The place between two others to which Newton's method goes for the greatest excess."""
    first, second = slopes(line, point)
    w = line.touch.w
    if not first:
        return w
    if second < 0:
        step = w - first / second
        return min(max(step, low), high)
    return (w + (high if first > 0 else low)) / 2
