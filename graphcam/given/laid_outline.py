"""The outline of a given cam as it lies on the drawing board: places of it, with the normals there."""

import cmath
import math
from dataclasses import dataclass
from functools import singledispatch
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.given.cam_by_radii import OutlineArc
from graphcam.given.follower import Rotation, sense
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.given.outline_motion import STILL, OutlineMotion
from graphcam.given.point_outline import TracedMotion

PLACES_A_POINT, PARTS_A_STEP = 8, 2
"""The spline between two points is looked at in so many places; it is divided in so many parts a step."""
MIN_ARC_PARTS = 4
"""An arc, or a straight part, is divided into so many parts at least."""


@dataclass(frozen=True, eq=False)
class LaidOutline:
    """A closed outline at phi = 0, in the order in which the follower meets it.

    points, normals : (m,) complex [mm], from the cam centre, and unit normals away from the cam; the last point is the
        first again
    pieces : slices between places where the curvature jumps; neighbours share the point there
    dwells : the numbers of the pieces that are arcs about the cam centre
    """

    points: NDArray[np.complex128]
    normals: NDArray[np.complex128]
    pieces: tuple[slice, ...]
    dwells: tuple[int, ...] = ()


@singledispatch
def laid_outline(motion: Motion, rotation: Rotation, step: float) -> LaidOutline:
    """The outline of a given cam where its motion begins, at places between which the normal turns by about a step.

    rotation : of the cam;  step : rad

    >>> import graphcam as gc
    >>> cam = gc.cam_by_radii(base_radius=28, flank_radius="straight", lift=15, ascent=math.radians(70))
    >>> laid = laid_outline(gc.outline_motion(cam, gc.Translating(roller_radius=16)), "ccw", math.radians(15))
    >>> len(laid.pieces), laid.dwells, complex(laid.points[4].round(4))
    (4, (3,), (21.4222+28j))
    """
    raise NotImplementedError(type(motion).__name__)


@laid_outline.register
def _(motion: OutlineMotion, rotation: Rotation, step: float) -> LaidOutline:
    roller, sigma = motion.prime_radius - motion.outline.base_radius, sense(rotation)
    points, normals, pieces, dwells = list[complex](), list[complex](), list[slice](), list[int]()
    for number, (arc, following) in enumerate(pairwise([*motion.arcs, motion.arcs[0]])):
        turn = _turn(arc, following, sigma)
        parts = max(MIN_ARC_PARTS, math.ceil(abs(turn) / step))
        outward = arc.outward * np.exp(1j * turn * np.arange(parts) / parts)
        begin, end = (each.point - roller * each.outward for each in (arc, following))
        on_arc = arc.centre + (arc.radius - roller) * outward
        straight = begin + (end - begin) * np.arange(parts) / parts
        pieces.append(slice(len(points), len(points) + parts + 1))
        points += (on_arc if math.isfinite(arc.radius) else straight).tolist()
        normals += outward.tolist()
        if abs(arc.centre) <= STILL * motion.prime_radius and math.isfinite(arc.radius):
            dwells.append(number)
    closed, around = (np.array([*each, each[0]]) for each in (points, normals))
    return LaidOutline(closed, around, tuple(pieces), tuple(dwells))


@laid_outline.register
def _(motion: TracedMotion, rotation: Rotation, step: float) -> LaidOutline:
    outline, sigma = motion.outline, sense(rotation)
    # As many places for the way round as for the turns of the normal: close together where the outline is sharp.
    number = np.arange(outline.points.size * PLACES_A_POINT + 1)[::-sigma] / PLACES_A_POINT
    turns, way = np.abs(np.diff(np.unwrap(np.angle(outline.outward(number))))), np.abs(np.diff(outline(number)[0]))
    passed = np.append(0.0, np.cumsum(turns / FULL_TURN + way / way.sum()))
    parts = math.ceil(passed[-1] * FULL_TURN * PARTS_A_STEP / step)
    place = np.interp(np.linspace(0.0, passed[-1], parts + 1), passed, number)
    turned = np.exp(1j * sigma * motion.zero)
    return LaidOutline(turned * outline(place)[0], turned * outline.outward(place), (slice(0, parts + 1),))


def _turn(arc: OutlineArc, following: OutlineArc, sigma: int) -> float:
    """How far the normal turns on a part, counter-clockwise [rad]: a cam meets its follower against its rotation."""
    if math.isinf(arc.radius):
        return 0.0
    way = -sigma if arc.radius > 0 else sigma
    return way * (FULL_TURN if following is arc else way * cmath.phase(following.outward / arc.outward) % FULL_TURN)
