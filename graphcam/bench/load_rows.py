"""The cost of loaded and elastic followers on the exact side: forces, shock spectra, motions by conditions.

Each is compared with a user's own alternative: samples of the forces, steps of an integrator, scipy's interpolation.
"""

from collections.abc import Iterator
from functools import partial
from math import pi, radians

import numpy as np
from scipy import integrate
from scipy.interpolate import KroghInterpolator

from graphcam.bench import reference
from graphcam.bench.bench_followers import ARM, FOLLOWER_KINDS, scene
from graphcam.bench.exact_rows import LOOPED_DESIGNS, STATIONS, SWEEP_RUNS, designs
from graphcam.bench.rows import MILLISECONDS, BenchRow, Effort, Section, Unit, faster_than
from graphcam.bench.timing import Timer
from graphcam.given.boundary_motion import BoundaryMotion, boundary_motion
from graphcam.given.boundary_parts import MotionPoint, PolynomialPart
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.spring_load import ArmLoad, SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.shock_response import shock_spectrum
from graphcam.sweeps.designs import Designs
from graphcam.sweeps.sweep import CHUNK_OF_DESIGNS, sweep
from graphcam.sweeps.sweep_forces import FORCE_QUANTITIES
from graphcam.words import say

FRICTION_COEFFICIENT = 0.05
STEM_LOAD = SpringLoad(mass=0.5, speed_rpm=300.0, stiffness=4.0, preload=400.0)
ARM_LOAD = ArmLoad(inertia=0.5 * ARM**2, speed_rpm=300.0, stiffness=4.0 * ARM**2, preload=400.0 * ARM)
"""The load of an arm with the mass and the spring of the stem at its end."""
SAMPLED_STATIONS = 100, 1000, 10_000
"""Stations of a turn at which forces are sampled."""
RISE_TIME_RATIOS = np.linspace(0.5, 10.0, 96)
"""Rise times over natural periods of a spectrum, between the whole numbers and on them."""
INTEGRATOR_TOLERANCES = 1e-6, 1e-10
"""Relative ones of the integrator; the absolute ones are a thousandth."""
MOTION_CONDITIONS = (
    MotionPoint(0.0, s=0.0, v=0.0, a=0.0),
    MotionPoint(radians(60), s=14.0),
    MotionPoint(radians(120), s=30.0, v=0.0),
    MotionPoint(radians(220), s=0.0, v=0.0, a=0.0),
)
"""A rise and a return without a dwell between, by nine conditions: degree 8."""
REFERENCE_PLACES = 16
"""Places of the motion by conditions at which it is held against 50 digits."""


def load_rows(effort: Effort) -> Iterator[BenchRow]:
    """Forces of one cam and of many, spectra, and motions by conditions."""
    timer, few = effort.timer, effort.unit(STATIONS, LOOPED_DESIGNS)
    for follower in FOLLOWER_KINDS:
        yield from _force_rows(follower, few, timer)
    for follower in ("translating", "arm"):
        yield from _swept_rows(follower, few, timer)
    yield from _spectrum_rows(few, timer)
    yield from condition_rows(effort)


# --- forces ----------------------------------------------------------------------------------------------------------


def load_of(follower: str) -> SpringLoad | ArmLoad:
    """What presses a follower of the bench."""
    return ARM_LOAD if follower == "arm" else STEM_LOAD


def extreme_forces(cam: Cam, follower: str) -> tuple[float, float, float]:
    """The maximum and the minimum normal force [N], and the maximum torque [N mm]."""
    forces = CamForces(cam, load_of(follower), friction=FRICTION_COEFFICIENT)
    return forces.max_normal().value, forces.min_normal().value, forces.max_torque().value


def sampled_forces(cam: Cam, follower: str, n: int) -> tuple[float, float, float]:
    """The extremes of the forces among n stations of the turn."""
    at = CamForces(cam, load_of(follower), friction=FRICTION_COEFFICIENT).at((np.arange(n) + 0.5) * FULL_TURN / n)
    return float(np.max(at.normal)), float(np.min(at.normal)), float(np.max(at.torque))


def looped_forces(some: Designs, follower: str) -> list[tuple[float, float, float]]:
    """The extremes of one cam after another."""
    return [extreme_forces(some.cam(k), follower) for k in range(len(some))]


def _force_rows(follower: str, unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    """Rows of one cam: the extremes, beside samples, which always miss them on the unsafe side."""
    cam, name = scene(follower, "3-4-5").cam, f"forces, {follower}"
    exact, seconds = np.array(extreme_forces(cam, follower)), timer.seconds(extreme_forces, cam, follower)
    yield unit.row(name, "maximum and minimum normal force, maximum torque", seconds)
    for n in SAMPLED_STATIONS:
        off = np.abs(np.array(sampled_forces(cam, follower, n)) / exact - 1).max()
        what, sampled = (
            f"beside samples at {n} stations: off by {off:.1e}",
            timer.seconds(sampled_forces, cam, follower, n),
        )
        yield faster_than(seconds).row(name, what, sampled)


def _swept_rows(follower: str, unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    """The forces of a chunk of designs, beside a loop over some of them."""
    many, name = designs(follower, "3-4-5", CHUNK_OF_DESIGNS), f"forces in a sweep, {follower}"
    some, forces = (
        many.part(slice(0, LOOPED_DESIGNS)),
        partial(sweep, load=load_of(follower), friction=FRICTION_COEFFICIENT),
    )
    normal, every = (
        timer.patient(SWEEP_RUNS).seconds(forces, many, quantities) / CHUNK_OF_DESIGNS
        for quantities in (["max_normal_force", "min_normal_force"], FORCE_QUANTITIES)
    )
    swept = forces(some, FORCE_QUANTITIES)
    found = np.stack([swept[quantity] for quantity in FORCE_QUANTITIES[:3]], axis=1)
    eps = float(np.abs(found / np.array(looped_forces(some, follower)) - 1).max()) / reference.EPS
    yield unit.row(name, "maximum and minimum normal force of a design", normal, "<= 2", eps)
    yield unit.row(name, "all forces of a design", every)
    looped = timer.seconds(looped_forces, some, follower) / LOOPED_DESIGNS
    yield faster_than(normal).row(name, "beside a loop over CamForces, which finds the places too", looped)


# --- shock spectra ---------------------------------------------------------------------------------------------------


def residual_of_cycloid(n: Floats) -> Floats:
    """The residual acceleration of the cycloidal law without damping, in closed form [lifts/rise time^2].

    >>> residual_of_cycloid(np.array([0.5, 1.5])).round(6).tolist()
    [8.37758, 15.079645]
    """
    # Near a whole number the sine is told from the rest, whose rounding is as small as it.
    rest = n - np.round(n)
    return 4 * pi * n * np.abs(np.sin(pi * rest)) / np.abs(n * n - 1)


def stepped_residual(n: float, tolerance: float) -> float:
    """The residual vibration of one ratio by scipy's integrator of the eighth order."""
    omega = 2 * pi * n

    def slope(u: float, state: Floats) -> list[float]:
        """The derivatives of place and velocity by u."""
        return [state[1], -(omega**2) * state[0] - 2 * pi * np.sin(2 * pi * u)]

    solved = integrate.solve_ivp(slope, (0, 1), [0.0, 0.0], "DOP853", rtol=tolerance, atol=tolerance / 1000)
    y, y1 = solved.y[:, -1]
    return float(omega * np.hypot(omega * y, y1))


def _spectrum_rows(unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    """The spectrum of the cycloidal law, its residual against the closed form, beside an integrator."""
    name, ratios = "shock spectrum", RISE_TIME_RATIOS[RISE_TIME_RATIOS != 1]
    exact, found = residual_of_cycloid(ratios), shock_spectrum("cycloidal", ratios).residual
    seconds = timer.seconds(shock_spectrum, "cycloidal", RISE_TIME_RATIOS) / RISE_TIME_RATIOS.size
    eps = reference.rounding(found, exact)
    yield unit.row(name, "primary and residual at one ratio", seconds, error_eps=eps)
    some = ratios[::12]

    def stepped(tolerance: float) -> list[float]:
        """The residuals at all of these ratios."""
        return [stepped_residual(n, tolerance) for n in some]

    for tolerance in INTEGRATOR_TOLERANCES:
        off = np.abs(stepped(tolerance) - residual_of_cycloid(some)).max() / exact.max()
        what = f"beside DOP853 at a tolerance of {tolerance:g}, the residual alone: off by {off:.1e}"
        yield faster_than(seconds).row(name, what, timer.seconds(stepped, tolerance) / some.size)


# --- motions by conditions -------------------------------------------------------------------------------------------


def by_conditions() -> BoundaryMotion:
    """The motion of :data:`MOTION_CONDITIONS`."""
    return boundary_motion([PolynomialPart(MOTION_CONDITIONS)])


def conditions_eps() -> float | None:
    """The maximum rounding of s, v and a [eps], each relative to its maximum value."""
    phi = MOTION_CONDITIONS[-1].angle * (np.arange(REFERENCE_PLACES) + 0.5) / REFERENCE_PLACES
    found = np.array(by_conditions()(phi)[:3])
    return reference.rounding(found, reference.conditioned(MOTION_CONDITIONS, phi)) if reference.mp else None


def condition_rows(effort: Effort) -> Iterator[BenchRow]:
    """A rise and return by nine conditions, beside scipy's interpolation with the same conditions."""
    timer, n, name, motion = effort.timer, effort.law_stations, "motion by conditions", by_conditions()
    phi = (np.arange(n) + 0.5) * FULL_TURN / n
    within = phi[phi < MOTION_CONDITIONS[-1].angle]
    seconds = timer.seconds(motion, phi)
    yield effort.unit(n).row(name, f"s, v, a, j at {n} stations", seconds, error_eps=conditions_eps())
    made = timer.seconds(by_conditions)
    yield MILLISECONDS.row(name, "made of nine conditions, in exact fractions", made)
    at, values = zip(
        *((point.angle, value) for point in MOTION_CONDITIONS for value in point.given.values()), strict=True
    )
    rival = partial(KroghInterpolator(at, values).derivatives, within, der=4)
    apart = reference.EPS * reference.rounding(rival()[:3], np.array(motion(within)[:3]))
    what = f"beside scipy's KroghInterpolator, s, v, a, j: {apart:.1e} apart"
    yield faster_than(seconds / n).row(name, what, timer.seconds(rival) / within.size)


LOADS_SECTION = Section(
    "loads",
    say("Forces, spectra, motions by conditions"),
    "Forces under a spring with friction, to full precision, beside samples; of many designs at once beside one after "
    "another. The residual of the cycloidal law against its closed form. Motions by conditions against 50 digits.",
    load_rows,
)
