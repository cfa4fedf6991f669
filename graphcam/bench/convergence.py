"""Error against the number of parts: every construction of every scene beside its exact counterpart.

All errors are relative: to the greatest exact value of the quantity, lengths on the cam to the prime radius.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from graphcam.bench.scenes import BENCH_LAWS, FOLLOWERS, TestScene, scene
from graphcam.constructions.chain import Chain
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.kinematics import Complexes
from graphcam.mechanism.peaks import max_acceleration, max_velocity

PARTS = (6, 8, 12, 16, 24, 32, 48, 64, 96)
FITTED = (12, 24, 48, 96)
"""The numbers of parts through which the order is fitted."""
EXACT = 1e-12
"""A relative error below this is rounding: the construction is exact."""
ROUNDS, SAMPLES, NARROWED = 6, 41, 10.0
"""Of the nested search for the nearest place of the profile: it ends within 1e-7 rad, which moves a distance across the
profile by 1e-14 of a radius."""
Measure = Callable[[TestScene, Chain], float]


@dataclass(frozen=True)
class Series:
    """The relative errors of one quantity, by the number of parts."""

    follower: str
    law: str
    construction: str
    quantity: str
    parts: tuple[int, ...]
    errors: tuple[float, ...]

    @property
    def exact(self) -> bool:
        """Whether nothing but rounding is left."""
        return max(self.errors) < EXACT

    @property
    def order(self) -> float | None:
        """p of error ~ 1/n^p, fitted by least squares to the logarithms; None for an exact construction."""
        return None if self.exact else fitted_order(self.parts, self.errors)

    @property
    def constant(self) -> float:
        """The greatest n^2 error: the error is at most this over n^2, whatever its ups and downs."""
        return max(n * n * error for n, error in zip(self.parts, self.errors, strict=True))


def fitted_order(parts: Sequence[int], errors: Sequence[float]) -> float | None:
    """The order of convergence over n = 12, 24, 48, 96, or over all parts if fewer than two of these are there.

    >>> fitted_order((6, 12, 24), (9.0, 1.0, 0.25))
    2.0
    """
    pairs = [(n, error) for n, error in zip(parts, errors, strict=True) if n in FITTED]
    if len(pairs) < 2:
        pairs = list(zip(parts, errors, strict=True))
    if len(pairs) < 2 or not all(error > 0 for _, error in pairs):
        return None
    n, error = np.log(np.array(pairs, dtype=np.float64)).T
    return round(-float(np.polyfit(n, error, 1)[0]), 12)


def convergence(parts: Sequence[int] = PARTS, laws: Sequence[str] = BENCH_LAWS) -> list[Series]:
    """The errors of all constructions of all scenes."""
    found: list[Series] = []
    for follower in FOLLOWERS:
        for law in laws:
            where = scene(follower, law)
            chains = [where.chain(n) for n in parts]
            for (construction, quantity), measure in MEASURES.items():
                if construction in chains[0] and (follower, construction) != ("flat", "working_profile"):
                    errors = tuple(measure(where, chain) for chain in chains)
                    found.append(Series(follower, law, construction, quantity, tuple(parts), errors))
    return found


# --- the measures ----------------------------------------------------------------------------------------------------


def displacement_error(where: TestScene, chain: Chain) -> float:
    """The greatest error of s at the stations."""
    return _at_stations("s", where, chain)


def least_radius_error(where: TestScene, chain: Chain) -> float:
    """The error of the least prime radius."""
    return _off(chain["minimum_radius"].value("prime_radius"), where.least().prime_radius)


def profile_error(where: TestScene, chain: Chain) -> float:
    """The greatest distance of the touch points from the exact profile."""
    profile = chain["working_profile"]
    touch = profile.points["touch"] * profile.givens.inverted.givens.mu_l.per_mm
    distance = distance_from_profile(where.cam, touch, chain.board.stations.phi)
    return float(distance.max()) / where.sizes.prime_radius


def distance_from_profile(cam: Cam, points: Complexes, near: Floats, reach: float = math.radians(3)) -> Floats:
    """How far points lie from the exact profile of a roller, which passes each within ``reach`` [rad] of its angle."""
    phi = near
    for _ in range(ROUNDS):
        around = phi[:, None] + np.linspace(-reach, reach, SAMPLES)
        best = np.argmin(np.abs(as_complex(cam.profile(around)) - points[:, None]), axis=1)
        phi = around[np.arange(phi.size), best]
        reach /= NARROWED
    # Across the profile, so that what is left of the search along it does not count.
    at = as_complex(cam.profile(phi))
    normal = (as_complex(cam.pitch_curve(phi)) - at) / cam.roller_radius
    return np.abs(((points - at) * normal.conj()).real)


def nearest_angles(cam: Cam, points: Complexes) -> Floats:
    """The cam angles [rad] at which the profile is seen from the cam centre in the direction of the points."""
    phi = np.linspace(0, 2 * math.pi, 3600, endpoint=False)
    seen = as_complex(cam.profile(phi))
    seen = seen / np.abs(seen)
    directions = points / np.abs(points)
    return phi[[int(np.argmin(np.abs(seen - direction))) for direction in directions]]


def as_complex(points: Floats) -> Complexes:
    """Points (..., 2) as complex numbers."""
    return points[..., 0] + 1j * points[..., 1]


def _off(drawn: Any, exact: float) -> float:
    return abs(float(drawn) / exact - 1)


def _greatest(name: str, greatest: Callable[[Motion], float], where: TestScene, chain: Chain) -> float:
    return _off(chain["integration"].value(name), greatest(where.board.motion))


def _at_stations(name: str, where: TestScene, chain: Chain) -> float:
    stations = chain.board.stations
    exact = where.board.motion.at(stations.phase, stations.u)["sva".index(name)]
    return float(np.abs(chain["integration"].value(name) - exact).max() / np.abs(exact).max())


def _pressure_angle_error(where: TestScene, chain: Chain) -> float:
    stations = chain.board.stations
    exact = where.cam.at(stations.phase, stations.u).pressure_angle
    return float(np.nanmax(np.abs(chain["pressure_angle"].value("alpha") - exact)) / np.abs(exact).max())


def _greatest_angle_error(where: TestScene, chain: Chain) -> float:
    return _off(chain["angle_diagram"].value("max_rise"), where.cam.extremes().pressure_angle_rise[0])


def _pitch_error(where: TestScene, chain: Chain) -> float:
    inverted, exact = chain["inversion"], where.cam.pitch_curve(chain.board.stations.phi)
    distance = np.hypot(inverted.value("x") - exact[:, 0], inverted.value("y") - exact[:, 1])
    return float(distance.max()) / where.sizes.prime_radius


def _curvature_error(where: TestScene, chain: Chain) -> float:
    curvature = chain["curvature"]
    name = "rho_candidates" if "rho_candidates" in curvature.readings else "rho"
    return _off(np.atleast_1d(curvature.value(name))[0], where.cam.extremes().min_convex_radius_moving[0])


MEASURES: Mapping[tuple[str, str], Measure] = {
    ("integration", "displacement"): displacement_error,
    ("integration", "velocity"): partial(_at_stations, "v"),
    ("integration", "greatest velocity"): partial(_greatest, "max_v", max_velocity),
    ("integration", "greatest acceleration"): partial(_greatest, "max_a", max_acceleration),
    ("minimum_radius", "least prime radius"): least_radius_error,
    ("pressure_angle", "pressure angle"): _pressure_angle_error,
    ("angle_diagram", "greatest angle, rise"): _greatest_angle_error,
    ("inversion", "pitch curve"): _pitch_error,
    ("curvature", "least curvature radius"): _curvature_error,
    ("working_profile", "working profile"): profile_error,
}
"""The relative error of each quantity, by construction and quantity."""
