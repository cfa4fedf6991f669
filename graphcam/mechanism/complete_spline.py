"""The complete cubic spline of the textbooks: twice continuously differentiable through points, clamped at its ends.

Its slopes solve a tridiagonal system, whose diagonal outweighs the rest, so that elimination in order is stable.  With
this a profile needs no ``scipy.interpolate``, which takes longer to load than a task takes to be solved.
"""

from dataclasses import dataclass

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.kinematics import Complexes


@dataclass(frozen=True, eq=False)
class CompleteSpline:
    """Through ``points`` (n + 1,) at rising parameters ``at`` (n + 1,), with the derivatives ``slopes`` (n + 1,) there.

    >>> cube = spline_through(np.array([0.0, 1.0, 3.0]), np.array([0j, 1, 27]), 0j, 27 + 0j)
    >>> cube.slopes[1].item(), cube.beyond(np.array([[1.0], [1.0]])).ravel().tolist()
    ((3+0j), [(1+0j), (8+0j)])
    """

    at: Floats
    points: Complexes
    slopes: Complexes

    @property
    def _bends(self) -> tuple[Complexes, Complexes]:
        """The second derivative halved at the start of each part, and a sixth of the third derivative in it."""
        steps, (before, after) = np.diff(self.at), (self.slopes[:-1], self.slopes[1:])
        chords = np.diff(self.points) / steps
        return (3 * chords - 2 * before - after) / steps, (before + after - 2 * chords) / steps**2

    def beyond(self, distances: Floats) -> Complexes:
        """The points (n, m) at distances (n, m) of the parameter from the start of each part."""
        square, cube = self._bends
        higher = square[:, None] + distances * cube[:, None]
        return self.points[:-1, None] + distances * (self.slopes[:-1, None] + distances * higher)

    @property
    def knots(self) -> Floats:
        """(n + 7,) of the same curve as a clamped cubic B-spline."""
        return np.concatenate([[self.at[0]] * 3, self.at, [self.at[-1]] * 3])

    @property
    def control(self) -> Complexes:
        """(n + 3,) its control points: the blossoms of a part at three knots that follow one another."""
        steps, points, slopes = np.diff(self.at), self.points, self.slopes
        before, after = steps[:-1], steps[1:]
        inner = points[1:-1] + slopes[1:-1] * (after - before) / 3 - self._bends[0][1:] * after * before / 3
        first, last = points[0] + slopes[0] * steps[0] / 3, points[-1] - slopes[-1] * steps[-1] / 3
        return np.concatenate([points[:1], [first], inner, [last], points[-1:]])


def spline_through(at: Floats, points: Complexes, first: complex, last: complex) -> CompleteSpline:
    """The spline with these derivatives at its ends.

    >>> line = spline_through(np.array([0.0, 1.0, 4.0]), np.array([0j, 2, 8]), 2 + 0j, 2 + 0j)
    >>> line.control.round(3).tolist()
    [0j, (0.667+0j), (3.333+0j), (6+0j), (8+0j)]
    """
    steps = np.diff(at)
    return CompleteSpline(at, points, _slopes(steps, np.diff(points) / steps, first, last))


def closed_spline_through(at: Floats, points: Complexes) -> CompleteSpline:
    """The closed spline, as smooth at its seam as elsewhere; the last point is the first.

    >>> at = np.linspace(0, 2 * np.pi, 41)
    >>> circle = closed_spline_through(at, np.exp(1j * at))
    >>> bool(abs(circle.slopes[0] - 1j) < 1e-5), bool(circle.slopes[0] == circle.slopes[-1])
    (True, True)
    """
    steps = np.diff(at)
    chords = np.diff(points) / steps
    # The slopes go linearly with that at the seam, which is set by the condition that holds at the other points.
    rest, unit = _slopes(steps, chords, 0j, 0j), _slopes(steps, 0 * chords, 1 + 0j, 1 + 0j)
    before, after = steps[-1], steps[0]
    wanted = 3 * (after * chords[-1] + before * chords[0]) - after * rest[-2] - before * rest[1]
    seam = wanted / (after * unit[-2] + 2 * (before + after) + before * unit[1])
    return CompleteSpline(at, points, rest + seam * unit)


def _slopes(steps: Floats, chords: Complexes, first: complex, last: complex) -> Complexes:
    """The derivatives (n + 1,) at which the second derivative is continuous, from parts and slopes of chords (n,)."""
    before, after = steps[:-1], steps[1:]
    wanted = 3 * (after * chords[:-1] + before * chords[1:])
    rows = zip(after.tolist(), (2 * (before + after)).tolist(), before.tolist(), wanted.tolist(), strict=True)
    # Each slope as a multiple of the next one, and a rest.
    times, rest = [0.0], [first]
    for left, middle, right, known in rows:
        pivot = middle + left * times[-1]
        rest.append((known - left * rest[-1]) / pivot)
        times.append(-right / pivot)
    slopes = [last]
    for factor, known in zip(times[:0:-1], rest[:0:-1], strict=True):
        slopes.append(known + factor * slopes[-1])
    return np.array([first, *slopes[::-1]])
