"""Exact values to 50 digits by mpmath, where it is installed: they see the rounding of the exact side.

Written from the textbooks' formulas, not from graphcam's own, which are arranged to round little.
"""

import math
from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from graphcam.bench.rivals import optional
from graphcam.bench.scenes import LIFT, LIMIT, TestScene
from graphcam.given.laws import Floats
from graphcam.given.motion_point import MotionPoint

EPS = float(np.finfo(float).eps)
DIGITS = 50
mp: Any = optional("mpmath")


def available() -> bool:
    """Whether there is mpmath."""
    return mp is not None


def _lift(law: str, u: Any) -> Any:
    """f(u) of a law."""
    if law == "rectangular":
        return 2 * u**2 if 2 * u < 1 else 1 - 2 * (1 - u) ** 2
    if law == "cosine":
        return (1 - mp.cos(mp.pi * u)) / 2
    if law == "cycloidal":
        return u - mp.sin(2 * mp.pi * u) / (2 * mp.pi)
    if law == "3-4-5":
        return u**3 * (10 - 15 * u + 6 * u**2)
    return u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3)


REFERENCED = ("rectangular", "cosine", "cycloidal", "3-4-5", "4-5-6-7")


def law_values(law: str, u: Floats) -> Floats:
    """(4, n) f, f', f'', f''' rounded from 50 digits, by differences at a higher precision."""
    with mp.workdps(DIGITS):
        rows = [[float(mp.diff(partial(_lift, law), mp.mpf(x), k)) for x in u.tolist()] for k in range(4)]
    return np.array(rows)


def profile_points(where: TestScene, u: Floats) -> Floats:
    """(n, 2) the working profile at fractions of the rise of a translating follower, rounded from 50 digits."""
    motion, sizes = where.board.motion, where.sizes
    angle, sigma = motion.phases[0].angle, where.cam.sigma
    points: list[tuple[float, float]] = []
    with mp.workdps(DIGITS):
        e, r0 = mp.mpf(sizes.place), mp.mpf(sizes.prime_radius)
        s0 = mp.sqrt(r0**2 - e**2)
        for x in u.tolist():
            s, f1 = LIFT * _lift(where.law, mp.mpf(x)), mp.diff(partial(_lift, where.law), mp.mpf(x))
            z = mp.mpc(e, s0 + s)
            along = mp.mpc(0, LIFT * f1 / mp.mpf(angle)) - mp.mpc(0, sigma) * z
            profile = z - sizes.roller_radius * mp.mpc(0, sigma) * along / abs(along)
            # The double next to the angle at which the cam itself is asked.
            profile *= mp.expj(-sigma * mp.mpf(float(motion.angle_at(0, x))))
            points.append((float(profile.real), float(profile.imag)))
    return np.array(points)


def least_radius(where: TestScene) -> float:
    """The minimum radius of the free scene, where the rise's and the return's tangent meet, rounded from 50 digits."""
    with mp.workdps(DIGITS):
        slope = mp.tan(mp.mpf(LIMIT))
        heights: list[Any] = []
        for k in (0, 2):
            angle = mp.mpf(where.board.motion.phases[k].angle)

            def rising(u: Any, angle: Any = angle) -> Any:
                """How high the tangent at u meets the axis, of the lift."""
                return mp.diff(partial(_lift, where.law), u) / angle - slope * _lift(where.law, u)

            # The tangent touches where the acceleration still pushes, between the start and the middle.
            u = mp.findroot(partial(mp.diff, rising), (0.01, 0.49), solver="anderson", tol=mp.mpf(10) ** -40)
            heights.append(LIFT * rising(u))
        across, up = (heights[0] - heights[1]) / 2, (heights[0] + heights[1]) / (2 * slope)
        return float(mp.hypot(across, up))


def in_eps(value: float, exact: float) -> float:
    """The relative error in units of 2.22e-16.

    >>> in_eps(1 + 2 * EPS, 1.0)
    2.0
    """
    return abs(value - exact) / (EPS * abs(exact)) if exact else math.nan


def conditioned(points: Sequence[MotionPoint], phi: Floats) -> Floats:
    """(3, n) s, v and a of the polynomial that meets the conditions of points, rounded from 50 digits."""
    with mp.workdps(DIGITS):
        asked = [(mp.mpf(point.angle), k, mp.mpf(value)) for point in points for k, value in point.given.items()]
        size = len(asked)
        rows = [[mp.ff(power, k) * at ** max(power - k, 0) for power in range(size)] for at, k, _ in asked]
        solved = mp.lu_solve(mp.matrix(rows), mp.matrix([value for *_, value in asked]))
        falling = [solved[size - 1 - power] for power in range(size)]
        values = [mp.polyval(falling, mp.mpf(x), derivative=1) for x in phi.tolist()]
        second = [
            sum((power * (power - 1) * solved[power] * mp.mpf(x) ** (power - 2) for power in range(2, size)), mp.mpf(0))
            for x in phi.tolist()
        ]
        return np.array([[float(s) for s, _ in values], [float(v) for _, v in values], [float(a) for a in second]])
