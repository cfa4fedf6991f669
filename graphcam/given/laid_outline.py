"""The outline of a given cam as it lies on the drawing board: places of it, with the normals there."""

import cmath
import math
from dataclasses import dataclass
from functools import singledispatch
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.given.cam_by_radii import OutlineArc
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.outline_motion import STILL, OutlineMotion
from graphcam.given.point_outline import TracedMotion

PARTS_A_STEP = 2
"""The curvature of an outline through points changes along it: a step of the cam angle has so many parts."""
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


GivenCamMotion = OutlineMotion | TracedMotion
"""A motion that a given cam makes."""


@singledispatch
def laid_outline(motion: GivenCamMotion, step: float) -> LaidOutline:
    """The outline of a given cam where the motion begins, at places between which the normal turns by about a step.

    Of a cam through points these are twice as many in every phase as steps of the cam angle, and a phase is a piece.

    step : rad

    >>> import graphcam as gc
    >>> cam = gc.cam_by_radii(base_radius=28, flank_radius="straight", lift=15, ascent=math.radians(70))
    >>> laid = laid_outline(gc.outline_motion(cam, gc.Translating(roller_radius=16)), math.radians(15))
    >>> len(laid.pieces), laid.dwells, complex(laid.points[4].round(4))
    (4, (3,), (21.4222+28j))
    """
    raise TypeError(type(motion))


@laid_outline.register
def _(motion: OutlineMotion, step: float) -> LaidOutline:
    roller, sigma = motion.prime_radius - motion.outline.base_radius, sense(motion.rotation)
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
def _(motion: TracedMotion, step: float) -> LaidOutline:
    phi, pieces, dwells = list[Floats](), list[slice](), list[int]()
    first = 0
    for number, (_, start, end) in enumerate(motion.timing):
        parts = max(MIN_ARC_PARTS, math.ceil(PARTS_A_STEP * (end - start) / step))
        pieces.append(slice(first, first + parts + 1))
        phi.append(np.linspace(start, end, parts, endpoint=False))
        first += parts
        if not motion.directions[number]:
            dwells.append(number)
    place = motion.touched(np.append(np.concatenate(phi), FULL_TURN))
    turned = cmath.exp(1j * sense(motion.rotation) * motion.zero)
    points, normals = turned * motion.outline(place)[0], turned * motion.outline.outward(place)
    points[-1], normals[-1] = points[0], normals[0]
    return LaidOutline(points, normals, tuple(pieces), tuple(dwells))


def _turn(arc: OutlineArc, following: OutlineArc, sigma: int) -> float:
    """How far the normal turns on a part, counter-clockwise [rad]: a cam meets its follower against its rotation."""
    if math.isinf(arc.radius):
        return 0.0
    way = -sigma if arc.radius > 0 else sigma
    return way * (FULL_TURN if following is arc else way * cmath.phase(following.outward / arc.outward) % FULL_TURN)
