"""The closed loops that bound the part in its plane: outline, hub, and bore with keyway; of lines, arcs and splines.

Each loop runs with the material to its left, an outer one anticlockwise and an inner one clockwise.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from graphcam.given.laws import Floats
from graphcam.mechanism.kinematics import Complexes
from graphcam.mechanism.profile_spline import ProfileSpline
from graphcam.plane_vectors import cross
from graphcam.workshop.biarcs import Move
from graphcam.workshop.cam_part import CamPart

MAX_EDGE_PARTS = 4
"""The maximum number of parts, between knots, of an edge."""


@dataclass(frozen=True, eq=False)
class SplineEdge:
    """A smooth clamped B-spline of the degree p: knots (m + p + 1,) and control points (m,) [mm]."""

    degree: int
    knots: Floats
    control: Complexes

    @property
    def start(self) -> complex:
        """The point at which the edge begins [mm]."""
        return complex(self.control[0])

    @property
    def end(self) -> complex:
        """The point at which the edge ends [mm]."""
        return complex(self.control[-1])


PlaneEdge = Move | SplineEdge
Loop = Sequence[PlaneEdge]


def spline_loop(spline: ProfileSpline) -> list[SplineEdge]:
    """The profile's spline as edges without corners, two or more, anticlockwise.

    Where an edge ends a knot stands p times, so that the control point there is a point of the curve: at a corner it
    does so anyway, elsewhere it is inserted.  An edge has few knots inside, because kernels integrate along it at as
    many places as its degree wants: the volume of a cam with an edge for half of it they miss by up to a hundredth, and
    that of one with edges of four parts by some millionths.
    """
    from scipy.interpolate import BSpline

    p, knots, control = spline.degree, spline.knots, spline.control[:, 0] + 1j * spline.control[:, 1]
    if np.sum(cross(control[:-1], control[1:])) < 0:
        knots, control = knots[-1] - knots[::-1], control[::-1]
    places, times = np.unique(knots, return_counts=True)
    cuts = _cuts(np.flatnonzero(times >= p).tolist())
    curve = BSpline(knots, np.ascontiguousarray(control), p)
    for k in cuts:
        if times[k] < p:
            curve = curve.insert_knot(places[k], p - int(times[k]))
    knots, control, ends = curve.t, curve.c, places[cuts]
    firsts = np.searchsorted(knots, ends)
    firsts[0] = 1  # the first knot stands once more than p times, and so does the last
    return [
        SplineEdge(p, np.concatenate([[a], knots[i : j + p], [b]]), control[i - 1 : j])
        for (i, j), (a, b) in zip(pairwise(firsts.tolist()), pairwise(ends), strict=True)
    ]


def _cuts(corners: list[int]) -> list[int]:
    """The numbers of the knots at which edges begin and end: the corners, and some between each two."""
    cuts = corners[:1]
    for a, b in pairwise(corners):
        count = max(math.ceil((b - a) / MAX_EDGE_PARTS), 2 if len(corners) == 2 else 1)
        cuts += np.round(np.linspace(a, b, count + 1)[1:]).astype(int).tolist()
    return cuts


def circle_loop(radius: float) -> list[Move]:
    """A circle about the axis in two halves, anticlockwise."""
    right, left = complex(radius), complex(-radius)
    return [Move(right, left, 0j), Move(left, right, 0j)]


def bore_loop(part: CamPart, zero: float) -> list[Move]:
    """The bore, clockwise; the middle of its keyway lies in the direction ``zero`` [rad].

    >>> from graphcam.tasks.part_table import PartTable
    >>> from graphcam.workshop.cam_part import cam_part
    >>> loop = bore_loop(cam_part(PartTable(bore=20), "iso", 27), 0.0)
    >>> [move.start for move in loop[-3:]], [move.centre is None for move in loop]
    ([(9.539392014169456+3j), (12.8+3j), (12.8-3j)], [False, False, True, True, True])
    """
    radius = part.bore / 2
    if part.keyway is None:
        return [move.reversed() for move in reversed(circle_loop(radius))]
    half, way = part.keyway.width / 2, complex(math.cos(zero), math.sin(zero))
    side = math.sqrt(radius**2 - half**2)
    top = part.keyway_top
    corners = (side, -half), (side, half), (top, half), (top, -half)
    before, behind, upper, lower = (complex(x, y) * way for x, y in corners)
    opposite = -radius * way
    return [
        Move(before, opposite, 0j, clockwise=True),
        Move(opposite, behind, 0j, clockwise=True),
        Move(behind, upper),
        Move(upper, lower),
        Move(lower, before),
    ]
