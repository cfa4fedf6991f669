"""A closed smooth curve through dense points: cubic pieces, as a chain of Bezier curves or as one B-spline."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points

CORNER_ANGLE = np.radians(20.0)
"""The minimum turn of a polygon of dense points at a corner of the curve [rad]."""


@dataclass(frozen=True, eq=False)
class SmoothCurve:
    """A closed curve through points (n,), piece k from point k to the next.

    chords : (n,) length of each piece's chord, which is its span of the parameter
    leaving, arriving : (n,) derivative at the start and at the end of each piece
    corner : (n,) whether the curve has a corner at the point
    """

    points: Points
    chords: NDArray[np.float64]
    leaving: Points
    arriving: Points
    corner: NDArray[np.bool_]

    def handles(self) -> tuple[Points, Points]:
        """The two inner control points (n,) of every piece."""
        ends = np.roll(self.points, -1)
        return self.points + self.leaving * self.chords / 3, ends - self.arriving * self.chords / 3


def smooth(points: Points) -> SmoothCurve:
    """A closed curve with the tangents of the quartics through each point and two neighbours on either side.

    So it errs by the fourth power of the spacing; at a corner each side has the direction of its own chord.
    """
    chords = np.abs(np.roll(points, -1) - points)
    back = np.roll(chords, 1)
    # Parameters of the four neighbours, counted from the point along the chords.
    at = np.stack([-back - np.roll(chords, 2), -back, chords, chords + np.roll(chords, -1)])
    near = np.stack([np.roll(points, shift) for shift in (2, 1, -1, -2)])
    tangent = np.zeros_like(points)
    for j in range(4):
        others = np.delete(at, j, axis=0)
        weight = np.prod(-others / (at[j] - others), axis=0) / at[j]
        tangent += weight * (near[j] - points)
    slope, slope_back = (near[2] - points) / chords, (points - near[1]) / back
    corner = np.abs(np.angle(slope / slope_back)) > CORNER_ANGLE
    # Beside a corner four neighbours would reach across it; the parabola through two does not.
    beside = np.roll(corner, 1) | np.roll(corner, -1)
    tangent = np.where(beside, (slope * back + slope_back * chords) / (back + chords), tangent)
    leaving, arriving = np.where(corner, slope, tangent), np.where(corner, slope_back, tangent)
    return SmoothCurve(points, chords, leaving, np.roll(arriving, -1), corner)


def bezier(points: Points) -> Points:
    """Control points (3n + 1,) of the chain of cubic Bezier curves through points (n,).

    >>> control = bezier(np.exp(2j * np.pi * np.arange(60) / 60))
    >>> middle = (control[0] + 3 * control[1] + 3 * control[2] + control[3]) / 8
    >>> bool(abs(abs(middle) - 1) < 1e-6)
    True
    """
    curve = smooth(points)
    return np.append(np.column_stack([points, *curve.handles()]).ravel(), points[0])


def clamped_spline(points: Points) -> tuple[Points, list[float]]:
    """The curve as one clamped cubic B-spline: control points (m,) and knots (m + 4,).

    Where the pieces share a derivative their common end is no control point, and its knot is double.
    """
    curve = smooth(points)
    first, second = curve.handles()
    ends = np.cumsum(curve.chords).tolist()
    control, knots = [points[0]], [0.0] * 4
    last = len(points) - 1
    for k in range(last + 1):
        control += [first[k], second[k]]
        if k < last and curve.corner[k + 1]:
            control.append(points[k + 1])
            knots.append(ends[k])
        if k < last:
            knots += [ends[k]] * 2
    return np.array([*control, points[0]]), knots + [ends[last]] * 4
