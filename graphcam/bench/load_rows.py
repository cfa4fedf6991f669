"""The cost of loaded and elastic followers on the exact side: forces, shock spectra, motions by conditions.

Each is compared with a user's own alternative: samples of the forces, steps of an integrator, scipy's interpolation.
"""

from collections.abc import Iterator
from functools import partial
from math import pi, radians
from typing import Any

import numpy as np

from graphcam.bench import reference
from graphcam.bench.exact_rows import LOOPED, RUNS, STATIONS, designs
from graphcam.bench.rivals import optional
from graphcam.bench.rows import BenchRow, Gauge, Section, Unit
from graphcam.bench.scenes import ARM, FOLLOWERS, scene
from graphcam.bench.timing import Timer
from graphcam.given.arm_load import ArmLoad
from graphcam.given.boundary_motion import BoundaryMotion, boundary_motion
from graphcam.given.boundary_parts import PolynomialPart
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.motion_point import MotionPoint
from graphcam.given.spring_load import SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.shock_response import shock_spectrum
from graphcam.sweeps.designs import Designs
from graphcam.sweeps.sweep import CHUNK_OF_DESIGNS, sweep
from graphcam.sweeps.sweep_forces import FORCES

FRICTION = 0.05
STEM = SpringLoad(mass=0.5, speed_rpm=300.0, stiffness=4.0, preload=400.0)
LEVER = ArmLoad(inertia=0.5 * ARM**2, speed_rpm=300.0, stiffness=4.0 * ARM**2, preload=400.0 * ARM)
"""The load of an arm with the mass and the spring of the stem at its end."""
SAMPLED = 100, 1000, 10_000
"""Stations of a turn at which forces are sampled."""
RATIOS = np.linspace(0.5, 10.0, 96)
"""Rise times over natural periods of a spectrum, between the whole numbers and on them."""
TOLERANCES = 1e-6, 1e-10
"""Relative ones of the integrator; the absolute ones are a thousandth."""
CONDITIONS = (
    MotionPoint(0.0, s=0.0, v=0.0, a=0.0),
    MotionPoint(radians(60), s=14.0),
    MotionPoint(radians(120), s=30.0, v=0.0),
    MotionPoint(radians(220), s=0.0, v=0.0, a=0.0),
)
"""A rise and a return without a dwell between, by nine conditions: degree 8."""
PLACES = 16
"""Places of the motion by conditions at which it is held against 50 digits."""


def load_rows(gauge: Gauge) -> Iterator[BenchRow]:
    """Forces of one cam and of many, spectra, and motions by conditions."""
    few = Unit(STATIONS, gauge.timer.pairs(STATIONS * LOOPED) / LOOPED)
    for follower in FOLLOWERS:
        yield from force_rows(follower, few, gauge.timer)
    for follower in ("translating", "arm"):
        yield from swept_rows(follower, few, gauge.timer)
    yield from spectrum_rows(few, gauge.timer)
    yield from condition_rows(gauge.unit(gauge.stations), gauge.timer)


# --- forces ----------------------------------------------------------------------------------------------------------


def load_of(follower: str) -> SpringLoad | ArmLoad:
    """What presses a follower of the bench."""
    return LEVER if follower == "arm" else STEM


def extreme_forces(cam: Cam, follower: str) -> tuple[float, float, float]:
    """The maximum and the minimum normal force [N], and the maximum torque [N mm]."""
    forces = CamForces(cam, load_of(follower), friction=FRICTION)
    return forces.greatest_normal().value, forces.least_normal().value, forces.greatest_torque().value


def sampled_forces(cam: Cam, follower: str, n: int) -> tuple[float, float, float]:
    """The extremes of the forces among n stations of the turn."""
    forces, motion = CamForces(cam, load_of(follower), friction=FRICTION), cam.motion
    phi = (np.arange(n) + 0.5) * FULL_TURN / n
    phase = np.searchsorted(motion.starts, phi, side="right") - 1
    angles = np.array([each.angle for each in motion.phases])[phase]
    at = forces.at(phase, (phi - motion.starts[phase]) / angles)
    return float(np.max(at.normal)), float(np.min(at.normal)), float(np.max(at.torque))


def force_rows(follower: str, unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    """Rows of one cam: the extremes, beside samples, which always miss them on the unsafe side."""
    cam = scene(follower, "3-4-5").cam
    exact, seconds = extreme_forces(cam, follower), timer.seconds(partial(extreme_forces, cam, follower))
    yield unit.row(f"forces, {follower}", "maximum and minimum normal force, maximum torque", seconds)
    for n in SAMPLED:
        sampled, work = sampled_forces(cam, follower, n), partial(sampled_forces, cam, follower, n)
        off = max(abs(a / b - 1) for a, b in zip(sampled, exact, strict=True))
        slower, what = timer.seconds(work), f"beside samples at {n} stations: off by {off:.1e}"
        yield BenchRow(f"forces, {follower}", what, slower / seconds, "times faster", "", None, slower)


def swept_rows(follower: str, unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    """The forces of a chunk of designs, beside a loop over some of them."""
    many, load = designs(follower, "3-4-5", CHUNK_OF_DESIGNS), load_of(follower)
    some, name = many.part(slice(0, LOOPED)), f"forces in a sweep, {follower}"
    patient = Timer(timer.budget, max(timer.least_runs, RUNS))
    work = partial(sweep, many, ["max_normal_force", "min_normal_force"], load=load, friction=FRICTION)
    seconds = patient.seconds(work) / CHUNK_OF_DESIGNS
    every = partial(sweep, many, FORCES, load=load, friction=FRICTION)
    looped = timer.seconds(partial(looped_forces, some, follower)) / LOOPED
    swept = sweep(some, FORCES, load=load, friction=FRICTION)
    found = np.stack([swept[quantity] for quantity in FORCES[:3]], axis=1)
    error_eps = float(np.abs(found / np.array(looped_forces(some, follower)) - 1).max()) / reference.EPS
    yield unit.row(name, "maximum and minimum normal force of a design", seconds, "<= 2", error_eps)
    yield unit.row(name, "all forces of a design", patient.seconds(every) / CHUNK_OF_DESIGNS)
    what = "beside a loop over CamForces, which finds the places too"
    yield BenchRow(name, what, looped / seconds, "times faster", "", None, looped)


def looped_forces(some: Designs, follower: str) -> list[tuple[float, float, float]]:
    """The extremes of one cam after another."""
    return [extreme_forces(some.cam(k), follower) for k in range(len(some))]


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
    integrate: Any = optional("scipy.integrate")
    omega = 2 * pi * n

    def slope(u: float, state: Floats) -> list[float]:
        return [state[1], -(omega**2) * state[0] - 2 * pi * np.sin(2 * pi * u)]

    solved = integrate.solve_ivp(slope, (0, 1), [0.0, 0.0], "DOP853", rtol=tolerance, atol=tolerance / 1000)
    y, y1 = solved.y[:, -1]
    return float(omega * np.hypot(omega * y, y1))


def spectrum_rows(unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    """The spectrum of the cycloidal law, its residual against the closed form, beside an integrator."""
    work, ratios = partial(shock_spectrum, "cycloidal", RATIOS), RATIOS[RATIOS != 1]
    exact, found = residual_of_cycloid(ratios), shock_spectrum("cycloidal", ratios).residual
    error_eps, seconds = float(np.abs(found - exact).max() / exact.max()) / reference.EPS, timer.seconds(work)
    yield unit.row(
        "shock spectrum", "primary and residual at one ratio", seconds / RATIOS.size, "", error_eps=error_eps
    )
    if optional("scipy.integrate") is None:
        return
    for tolerance in TOLERANCES:
        some = ratios[::12]
        stepped = timer.seconds(lambda tolerance=tolerance, some=some: [stepped_residual(n, tolerance) for n in some])
        values = np.array([stepped_residual(n, tolerance) for n in some])
        off = np.abs(values - residual_of_cycloid(some)).max() / exact.max()
        what = f"beside DOP853 at a tolerance of {tolerance:g}, the residual alone: off by {off:.1e}"
        slower = stepped / some.size
        yield BenchRow("shock spectrum", what, slower * RATIOS.size / seconds, "times faster", "", None, slower)


# --- motions by conditions -------------------------------------------------------------------------------------------


def by_conditions() -> BoundaryMotion:
    """The motion of :data:`CONDITIONS`."""
    return boundary_motion([PolynomialPart(CONDITIONS)])


def conditions_error() -> float | None:
    """The maximum rounding of s, v and a [eps], each relative to its maximum value."""
    if not reference.available():
        return None
    motion, phi = by_conditions(), CONDITIONS[-1].angle * (np.arange(PLACES) + 0.5) / PLACES
    exact, found = reference.conditioned(CONDITIONS, phi), np.array(motion(phi)[:3])
    return float((np.abs(found - exact).max(axis=1) / np.abs(exact).max(axis=1)).max()) / reference.EPS


def condition_rows(unit: Unit, timer: Timer) -> Iterator[BenchRow]:
    """A rise and return by nine conditions, beside scipy's interpolation with the same conditions."""
    motion, phi = by_conditions(), (np.arange(unit.n) + 0.5) * FULL_TURN / unit.n
    seconds, making = timer.seconds(partial(motion, phi)), timer.seconds(by_conditions)
    name = "motion by conditions"
    yield unit.row(name, f"s, v, a, j at {unit.n} stations", seconds, "", conditions_error())
    yield BenchRow(name, "made of nine conditions, in exact fractions", 1e3 * making, "ms", "", None, making)
    interpolate: Any = optional("scipy.interpolate")
    if interpolate is None:
        return
    at = [point.angle for point in CONDITIONS for _ in point.given]
    values = [value for point in CONDITIONS for value in point.given.values()]
    within = phi[phi < CONDITIONS[-1].angle]
    rival = partial(interpolate.KroghInterpolator(at, values).derivatives, within, der=4)
    slower, found = timer.seconds(rival) / within.size, rival()[:3]
    exact = np.array(motion(within)[:3])
    off = (np.abs(found - exact).max(axis=1) / np.abs(exact).max(axis=1)).max()
    what = f"beside scipy's KroghInterpolator, s, v, a, j: {off:.1e} apart"
    yield BenchRow(name, what, slower * unit.n / seconds, "times faster", "", None, slower)


LOADS = Section(
    "loads",
    "Forces, spectra, motions by conditions",
    "Forces under a spring with friction, to full precision, beside samples; of many designs at once beside one after "
    "another. The residual of the cycloidal law against its closed form. Motions by conditions against 50 digits.",
    load_rows,
)
