"""Exact values to 50 digits by mpmath, where it is installed: they see the rounding of the exact side.

Written from the textbooks' formulas, not from graphcam's own, which are arranged to round little.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from graphcam.bench.bench_followers import ARM, LIFT, PERMITTED_ANGLE, BenchFollower
from graphcam.bench.rivals import optional
from graphcam.given.boundary_parts import MotionPoint
from graphcam.given.laws import DECLARED_LAWS, Floats, LawName, law as law_of

EPS = float(np.finfo(float).eps)
REFERENCE_DIGITS = 50
mp: Any = optional("mpmath")
INNER = np.random.default_rng(0).uniform(0.01, 0.99, 24)
"""Places inside a phase at which that is done, the same in every run."""


def printed_lift(law: str) -> Callable[[Any], Any]:
    """f(u) of a law as the books print it, at the digits of mpmath."""
    return lambda u: DECLARED_LAWS[law].printed(u, mp)


def law_values(law: str, u: Floats) -> Floats:
    """(4, n) f, f', f'', f''' rounded from 50 digits, by differences at a higher precision."""
    with mp.workdps(REFERENCE_DIGITS):
        return np.array([[float(mp.diff(printed_lift(law), mp.mpf(x), k)) for x in u.tolist()] for k in range(4)])


def profile_points(where: BenchFollower, u: Floats) -> Floats:
    """(n, 2) the working profile at fractions of the rise of a translating follower, rounded from 50 digits."""
    turn, points = mp.mpc(0, where.cam.sigma), list[tuple[float, float]]()
    with mp.workdps(REFERENCE_DIGITS):
        for x in u.tolist():
            z, v, _ = pitch_place(where, 0, mp.mpf(x))
            along = mp.mpc(0, v) - turn * z
            profile = z - where.sizes.roller_radius * turn * along / abs(along)
            # The double next to the angle at which the cam itself is asked.
            profile *= mp.exp(-turn * mp.mpf(float(where.board.motion.angle_at(0, x))))
            points.append((float(profile.real), float(profile.imag)))
    return np.array(points)


def least_radius(where: BenchFollower) -> float:
    """The minimum radius of the free scene, where the rise's and the return's tangent meet, rounded from 50 digits."""
    with mp.workdps(REFERENCE_DIGITS):
        slope, lift, heights = mp.tan(mp.mpf(PERMITTED_ANGLE)), printed_lift(where.law), list[Any]()
        for k in (0, 2):
            angle = mp.mpf(where.board.motion.phases[k].angle)

            def rising(u: Any, angle: Any = angle) -> Any:
                """How far the tangent at u lies across the line of motion, in lifts."""
                return mp.diff(lift, u) / angle - slope * lift(u)

            # The tangent touches where the acceleration still pushes, between the start and the middle.
            u = mp.findroot(partial(mp.diff, rising), (0.01, 0.49), solver="anderson", tol=mp.mpf(10) ** -40)
            heights.append(LIFT * rising(u))
        across, up = (heights[0] - heights[1]) / 2, (heights[0] + heights[1]) / (2 * slope)
        return float(mp.hypot(across, up))


def arm_radius(where: BenchFollower) -> float:
    """The minimum radius where the tangent of the rise meets the line of the rest, rounded from 50 digits."""
    with mp.workdps(REFERENCE_DIGITS):
        rise, f, limit = where.board.motion.phases[0], printed_lift(where.law), mp.mpf(where.board.limits.rise)

        def radius(u: Any) -> Any:
            """How far along the line of the rest the line of the place u meets it [mm]."""
            s, v = rise.lift * f(u), rise.lift / mp.mpf(rise.angle) * mp.diff(f, u)
            height = v * mp.cos(limit) - 2 * mp.sin(s / 2) * mp.sin(limit - s / 2)
            return ARM * height / mp.sin(2 * limit - s)

        u = mp.findroot(partial(mp.diff, radius), (0.05, 0.6), solver="anderson", tol=mp.mpf(10) ** -40)
        return float(radius(u))


def pitch_place(where: BenchFollower, k: int, x: Any) -> tuple[Any, Any, Any]:
    """The place of a stem's trace point in a phase, and its v and a [mm]."""
    phase, f, e, r0 = where.board.motion.phases[k], printed_lift(where.law), where.sizes.place, where.sizes.prime_radius
    back, angle, e = k == 2, mp.mpf(phase.angle), mp.mpf(e)
    s, *slopes = (LIFT * mp.diff(f, x, n) / angle**n for n in range(3))
    s, v, a = (LIFT - s, -slopes[0], -slopes[1]) if back else (s, *slopes)
    return mp.mpc(e, mp.sqrt(mp.mpf(r0) ** 2 - e**2) + s), v, a


def conditioned(points: Sequence[MotionPoint], phi: Floats) -> Floats:
    """(3, n) s, v and a of the polynomial that meets the conditions of points, rounded from 50 digits."""
    with mp.workdps(REFERENCE_DIGITS):
        conditions = [(point.angle, k, value) for point in points for k, value in point.given.items()]

        def powers(angle: float, k: int) -> Any:
            """The derivatives of order k of all powers of the cam angle [rad]."""
            at = mp.mpf(angle)
            return [mp.ff(power, k) * at ** max(power - k, 0) for power in range(len(conditions))]

        rows = [powers(angle, k) for angle, k, _ in conditions]
        solved = list(mp.lu_solve(mp.matrix(rows), mp.matrix([mp.mpf(value) for *_, value in conditions])))
        return np.array([[float(mp.fdot(powers(x, k), solved)) for x in phi.tolist()] for k in range(3)])


# --- the rounding of the exact side, None without mpmath -------------------------------------------------------------


def rounding(found: Floats, exact: Floats) -> float:
    """The maximum rounding of rows of values [eps], each relative to its maximum value."""
    return float((np.abs(found - exact).max(axis=-1) / np.abs(exact).max(axis=-1)).max()) / EPS


def law_eps(law: LawName) -> float | None:
    """The rounding of a law and its derivatives [eps]."""
    if mp is None or law not in DECLARED_LAWS:
        return None
    the_law = law_of(law)
    off = np.abs(np.array(the_law(INNER)) - law_values(law, INNER)).max(axis=1)
    greatest = np.abs(np.array(the_law(np.linspace(0, 1, 1001)))).max(axis=1)
    return float((off[greatest > 0] / greatest[greatest > 0]).max()) / EPS


def displacement_eps(where: BenchFollower) -> float | None:
    """The maximum error of s on the rise, of the lift [eps]."""
    if mp is None:
        return None
    s, exact = where.board.motion.at(0, INNER)[0] / LIFT, law_values(where.law, INNER)[0]
    return float(np.abs(s - exact).max()) / EPS


def least_radius_eps(where: BenchFollower) -> float | None:
    """The error of the minimum radius of the free scene [eps]."""
    return None if mp is None else abs(where.exact_least_radius().prime_radius / least_radius(where) - 1) / EPS


def arm_radius_eps(where: BenchFollower) -> float | None:
    """The error of an arm's minimum radius [eps]."""
    return None if mp is None else abs(where.exact_least_radius().prime_radius / arm_radius(where) - 1) / EPS


def pressure_angle_eps(where: BenchFollower) -> float | None:
    """The maximum error of the pressure angle on the rise of a translating follower, of its maximum [eps]."""
    if mp is None:
        return None
    with mp.workdps(REFERENCE_DIGITS):
        at = [pitch_place(where, 0, mp.mpf(x)) for x in INNER.tolist()]
        exact = np.array([float(mp.atan2(v - where.cam.sigma * z.real, z.imag)) for z, v, _ in at])
    return rounding(where.cam.pressure_angle(where.board.motion.angle_at(0, INNER)), exact)


def curvature_eps(where: BenchFollower) -> float | None:
    """The error of the minimum radius of curvature of a translating follower [eps], at the place that was found.

    There it hardly changes with the place.
    """
    if mp is None:
        return None
    (found, phi), motion = where.cam.extremes().min_convex_radius, where.board.motion
    (k, (_, start, _)) = next((k, span) for k, span in enumerate(motion.timing) if span[1] <= phi <= span[2])
    with mp.workdps(REFERENCE_DIGITS):
        z, v, a = pitch_place(where, k, (mp.mpf(phi) - mp.mpf(start)) / mp.mpf(motion.phases[k].angle))
        turn = mp.mpc(0, where.cam.sigma)
        first = mp.mpc(0, v) - turn * z
        second = mp.mpc(0, a) - 2 * turn * mp.mpc(0, v) - z
        exact = float(abs(first) ** 3 / abs((mp.conj(first) * second).imag))
    return abs(found / exact - 1) / EPS


def profile_eps(where: BenchFollower) -> float | None:
    """The maximum error of a coordinate of the profile on the rise, of the prime radius [eps]."""
    if mp is None:
        return None
    off = where.cam.profile(where.board.motion.angle_at(0, INNER)) - profile_points(where, INNER)
    return float(np.abs(off).max()) / where.sizes.prime_radius / EPS
