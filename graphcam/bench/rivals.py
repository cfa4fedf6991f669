"""The usual alternatives: sampled integration, general optimisers, polygon buffers."""

import math
from collections.abc import Callable
from importlib import import_module
from typing import Any

import numpy as np
from scipy.integrate import cumulative_simpson, cumulative_trapezoid
from scipy.interpolate import CubicSpline
from scipy.optimize import LinearConstraint, minimize
from scipy.spatial import ConvexHull, HalfspaceIntersection

from graphcam.given.laws import Floats, law
from graphcam.given.motion import Motion
from graphcam.sweeps.designs import Designs

Lines = tuple[Floats, Floats]
"""Normals (m, 2) and heights (m,) of half-planes: what keeps normals @ x >= heights is permitted."""
Point = tuple[float, float]
Integrator = Callable[[Floats, Floats], Floats]
"""s of the angles and the accelerations."""
SLSQP = {"ftol": 1e-15, "maxiter": 200}
"""What the optimiser is asked for."""


def optional(name: str) -> Any | None:
    """A module that may not be installed; None where it is not.

    >>> optional("no_such_module") is None
    True
    """
    try:
        return import_module(name)
    except ImportError:
        return None


# --- acceleration to displacement ------------------------------------------------------------------------------------


INTEGRATORS: dict[str, Integrator] = {
    "cumulative_trapezoid": lambda x, a: cumulative_trapezoid(cumulative_trapezoid(a, x, initial=0), x, initial=0),
    "cumulative_simpson": lambda x, a: cumulative_simpson(cumulative_simpson(a, x=x, initial=0), x=x, initial=0),
    "CubicSpline": lambda x, a: np.asarray(CubicSpline(x, a).antiderivative(2)(x)),
}
"""Double integrations by their names in scipy: s less its value at the start."""


def integrated(motion: Motion, method: Integrator, n: int) -> list[Floats]:
    """s of rise and return, less its value at their starts, at the ends of n equal parts."""
    u = np.linspace(0, 1, n + 1)
    return [method(motion.angle_at(k, u), motion.at(k, u)[2]) for k in (0, 2)]


def rises(motion: Motion, n: int) -> list[Floats]:
    """The exact values of the same."""
    return [s - s[0] for s in (motion.at(k, np.linspace(0, 1, n + 1))[0] for k in (0, 2))]


# --- derivatives by differences ---------------------------------------------------------------------------------------


def pressure_angles(s: Floats, phi: Floats, s0: float, offset: float) -> Floats:
    """The pressure angles [rad] of a translating follower, v by differences: their tangent is (v - e)/(s0 + s)."""
    return np.arctan2(np.gradient(s, phi) - offset, s0 + s)


def min_convex_radius(pitch: Floats, phi: Floats) -> float:
    """The minimum radius of curvature of convex parts of points (n, 2) in order, both derivatives by differences."""
    z = pitch @ [1, 1j]
    z1 = np.gradient(z, phi)
    bent = (z1.conj() * np.gradient(z1, phi)).imag / np.abs(z1) ** 3
    return 1 / float(np.max(bent * np.sign(np.sum(bent))))


# --- least radius ----------------------------------------------------------------------------------------------------


def translating_lines(motion: Motion, limit: float, n: int) -> Lines:
    """The half-planes for (e', s0) of n stations in each of rise and return, and of the rest."""
    u, slope = np.linspace(0, 1, n), math.tan(limit)
    (s, v, *_), (s_back, v_back, *_) = motion.at(0, u), motion.at(2, u)
    sides = np.repeat([1.0, -1.0, -1.0], [n, n, 1])
    heights = np.concatenate([v - slope * s, np.abs(v_back) - slope * s_back, [0.0]])
    return np.stack([sides, np.full(sides.size, slope)], axis=1), heights


def arm_lines(motion: Motion, limit: float, arm: float, n: int) -> Lines:
    """The half-planes for the cam centre, seen from the low trace point, of n stations of the rise; the arm is level.

    Both sides of the limit count at every station; the cam turns counter-clockwise.
    """
    s, v, _, _ = motion.at(0, np.linspace(0, 1, n))
    sides = np.array([[1.0], [-1.0]])
    angles = sides * limit - s
    normals = np.stack([sides * np.cos(angles), sides * np.sin(angles)], axis=-1)
    heights = sides * arm * (v * math.cos(limit) - 2 * np.sin(s / 2) * np.sin(sides * limit - s / 2))
    return normals.reshape(-1, 2), heights.ravel()


def by_optimiser(lines: Lines, start: Point) -> float:
    """The distance from the origin to the permitted region, by scipy's SLSQP with exact derivatives."""
    normals, heights = lines[0], lines[1] / math.hypot(*start)
    return _least_by_slsqp(start, _square, _kept(lambda x: normals @ x - heights, lambda _: normals), jac=True)


def by_linear_constraints(lines: Lines, start: Point) -> float:
    """The least radius with the half-planes as scipy's linear constraints."""
    heights: Any = lines[1] / math.hypot(*start)
    return _least_by_slsqp(start, _square, LinearConstraint(lines[0], heights, np.inf), jac=True)


def by_pressure_angles(motion: Motion, limit: float, n: int, start: Point) -> float:
    """The translating follower's minimum radius as one would first write it: SLSQP on (s0, e') and the pressure angles.

    The angles at n stations of rise and return and at the rest keep the limit; SLSQP takes its derivatives by
    differences.
    """
    u, size = np.linspace(0, 1, n), math.hypot(*start)
    s, v = (np.concatenate([motion.at(k, u)[i] for k in (0, 2)]) for i in (0, 1))

    def room(x: Floats) -> Floats:
        """The angles [rad] that are left to the limit on either side."""
        alpha = np.arctan2(v - size * x[1], size * x[0] + s)
        return np.concatenate([limit - alpha, limit + alpha])

    # NumPy's norm takes longer.
    return _least_by_slsqp(start, lambda x: float(np.hypot(x[0], x[1])), _kept(room))


def _square(x: Floats) -> tuple[float, Floats]:
    """The squared distance from the origin, and its derivative."""
    return float(x @ x), 2 * x


def _kept(room: Callable[[Floats], Floats], slope: Callable[[Floats], Floats] | None = None) -> dict[str, Any]:
    """The constraint that no room is negative, with its derivative."""
    return {"type": "ineq", "fun": room, "jac": slope}


def _least_by_slsqp(start: Point, size_of: Callable[[Floats], Any], constraint: Any, **given: Any) -> float:
    """The distance that scipy's SLSQP finds, from a start whose distance is its unit."""
    unit = math.hypot(*start)
    found = minimize(size_of, np.array(start) / unit, method="SLSQP", constraints=[constraint], options=SLSQP, **given)
    return unit * float(np.hypot(*found.x))


def by_half_planes(lines: Lines, inside: Point) -> float:
    """The least radius by scipy's HalfspaceIntersection, boxed in, from a point inside the region."""
    normals, heights = lines
    box = 4 * math.hypot(*inside)
    walls = np.array([[1.0, 0, -box], [-1, 0, -box], [0, 1, -box], [0, -1, -box]])
    region = HalfspaceIntersection(
        np.vstack([np.column_stack([-normals, heights]), walls]), np.array(inside, dtype=np.float64)
    )
    corners = region.intersections
    ends = corners[ConvexHull(corners).simplices]
    start, along = ends[:, 0], ends[:, 1] - ends[:, 0]
    share = np.clip(-np.sum(start * along, axis=1) / np.sum(along * along, axis=1), 0, 1)
    nearest = start + share[:, None] * along
    return float(np.hypot(nearest[:, 0], nearest[:, 1]).min())


# --- many cams -------------------------------------------------------------------------------------------------------

_AngleTerms = tuple[Floats, Floats, Floats]


def by_stations(designs: Designs, n: int) -> Floats:
    """(designs, 3) maximum pressure angles of rise and return, minimum convex radius, of n stations of each phase.

    A loop over the designs in plain NumPy, by the textbooks' formulas; all rises follow one law, and all returns.
    """
    u, found = np.linspace(0, 1, n), np.empty((len(designs), 3))
    columns = [designs.column(name).tolist() for name in ("lift", "rise_angle", "return_angle", "prime_radius")]
    places = [designs.column(name).tolist() for name in ("offset", "arm", "distance")]
    (up, up1, up2), (back, back1, back2) = (law(designs.column(name)[0])(u, 2) for name in ("rise_law", "return_law"))
    seen = _seen_by_arm if np.any(designs.arm) else _seen_by_stem
    for k, (lift, rise, fall, r0, *place) in enumerate(zip(*columns, *places, strict=True)):
        sharpest = 0.0
        for side, angle, s, v, a in ((0, rise, up, up1, up2), (1, fall, 1 - back, -back1, -back2)):
            along, across, bent = seen(lift * s, lift / angle * v, lift / angle**2 * a, r0, *place)
            alpha = np.arctan2(across, along)
            found[k, side] = alpha[np.argmax(np.abs(alpha))]
            sharpest = max(sharpest, (bent / np.hypot(along, across) ** 3).max())
        found[k, 2] = 1 / sharpest
    return found


def _seen_by_stem(s: Floats, v: Floats, a: Floats, r0: float, offset: float, *_: float) -> _AngleTerms:
    """Along and across the stem the vector whose argument is the pressure angle, and kappa times its cube."""
    along, across = math.sqrt(r0**2 - offset**2) + s, v - offset
    return along, across, along**2 + across**2 + v * across - a * along


def _seen_by_arm(s: Floats, v: Floats, a: Floats, r0: float, _: float, arm: float, distance: float) -> _AngleTerms:
    psi = math.acos((distance**2 + arm**2 - r0**2) / (2 * distance * arm)) + s
    along, across = distance * np.sin(psi), arm * (1 + v) - distance * np.cos(psi)
    return along, across, along**2 + across**2 + arm * v * (1 + v) * across - arm * a * along


# --- the roller's envelope -------------------------------------------------------------------------------------------


def buffered(pitch: Floats, roller_radius: float) -> Floats:
    """(k, 2) the corners of shapely's polygon of the pitch points, moved inwards by the roller radius [mm]."""
    shapely: Any = import_module("shapely")
    inner = shapely.Polygon(pitch).buffer(-roller_radius)
    return np.asarray(inner.exterior.coords)[:-1]
