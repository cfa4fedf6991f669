"""What an answer is expected to be, how far a careful hand scatters about it, and how far a given one is off."""

import math
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.exercises.definition.exercise import Given, Kind
from graphcam.exercises.key.curve_distance import distance_from_drawn, distance_to_curve

Floats = NDArray[np.float64]
Scatter = float | Floats


class Off(NamedTuple):
    """How far an answer is off.

    deviation : in standard deviations of a careful hand ("pencil units"); signed for a number
    station : of points and curves, the place of the largest deviation, counted from 0
    paper : of points and curves, that deviation in mm of paper
    """

    deviation: float
    station: int | None = None
    paper: float | None = None


STRAIGHT: Floats = np.empty(0)
"""Of what is no curve, or one whose parts are all straight."""


@dataclass(frozen=True, eq=False)
class Expected:
    """The value that a perfect hand reads, and the standard deviation of careful ones.

    value : a number, or complex points (m,) [mm of paper]; scatter : a number, or one a point (m,) [mm of paper]
    bulge : of a curve, how far it bends between its points: see :mod:`graphcam.exercises.key.curve_distance`
    """

    value: Given
    scatter: Scatter
    bulge: Floats = field(default_factory=lambda: STRAIGHT)

    def deviation(self, given: Given, kind: Kind, far: float = math.inf) -> float:
        """How far an answer is off, in pencil units; what is farther off than ``far`` need not be told exactly.

        >>> Expected(10.0, 0.5).deviation(11.0, "number")
        2.0
        """
        return self.off(given, kind, far).deviation

    def off(self, given: Given, kind: Kind, far: float = math.inf) -> Off:
        """How far an answer is off, and where most; what is farther off than ``far`` need not be told exactly.

        Of points, in whatever order, the worst counts.  Of a curve it is the worst distance of an expected point to
        the curve, or of a place on the curve to what is expected, whichever is larger: else a scribble that passes
        through everything would be as good as the curve.  Where the number of points differs it is infinite, and
        nowhere.
        """
        if not isinstance(given, np.ndarray):
            off = math.inf if isinstance(self.value, np.ndarray) else (given - self.value) / float(self.scatter)
            return Off(off)
        distances = self.distances(given, kind)
        relative = distances / self.scatter
        # Where one is infinite or a NaN, that is the place.
        worst = int(relative.argmax())
        deviation = float(relative[worst])
        if not math.isfinite(deviation):
            return Off(math.inf)
        found = Off(deviation, worst, float(distances[worst]))
        if kind != "curve" or found.deviation > far:
            return found
        distances, part = distance_from_drawn(given, np.asarray(self.value), self.bulge)
        scatter = np.asarray(self.scatter)
        relative = distances / np.maximum(scatter[part], scatter[(part + 1) % scatter.size])
        worst = int(relative.argmax())
        return max(found, Off(float(relative[worst]), int(part[worst]), float(distances[worst])))

    def distances(self, given: Points, kind: Kind) -> Floats:
        """How far the points or the curve given lie from every expected point (m,) [mm of paper]."""
        value = np.atleast_1d(np.asarray(self.value, dtype=np.complex128))
        if kind == "curve":
            return distance_to_curve(value, np.asarray(given, dtype=np.complex128))
        if given.shape != value.shape:
            return np.full(value.shape, np.inf)
        return np.abs(paired(given, value) - value)


def stored(expected: Expected) -> list[Any]:
    """As JSON takes it: value and scatter, and of points the bulge; a point is a pair."""
    if not isinstance(expected.value, np.ndarray):
        return [expected.value, float(expected.scatter)]
    points = [[z.real, z.imag] for z in expected.value.tolist()]
    return [points, np.asarray(expected.scatter).tolist(), expected.bulge.tolist()]


def from_stored(said: list[Any]) -> Expected:
    """What :func:`stored` wrote.

    >>> stored(from_stored([[[0.0, 1.0]], [0.5], []]))
    [[[0.0, 1.0]], [0.5], []]
    """
    if len(said) == 2:
        return Expected(float(said[0]), float(said[1]))
    value, scatter, bulge = (np.array(each, dtype=np.float64) for each in said)
    return Expected(value.reshape(-1, 2).view(np.complex128)[:, 0], scatter, bulge)


def paired(given: Points, wanted: Points) -> Points:
    """As many points (n,) in the order of the wanted ones, paired so that they lie as near as they can together.

    A drawing does not say which point is which, and a CAD program may save them in another order.  The distances
    themselves are summed, not their squares, so that one point in a wrong place is left as that one.

    >>> paired(np.array([5 + 1j, 0.2 + 0j]), np.array([0j, 5 + 0j]))
    array([0.2+0.j, 5. +1.j])
    """
    from scipy.optimize import linear_sum_assignment

    _, order = linear_sum_assignment(np.abs(wanted[:, None] - given))
    return given[order]
