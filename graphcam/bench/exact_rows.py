"""The exact side as ratios: its cost in sine-cosine pairs or beside a general optimiser, and its rounding in eps.

Beside it stand running sums, in memory copies, and the order of the curvature through three points.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from graphcam.bench import reference
from graphcam.bench.rivals import (
    arm_lines,
    by_half_planes,
    by_optimiser,
    by_pressure_angles,
    translating_lines,
)
from graphcam.bench.scenes import ARM, FOLLOWERS, LIMIT, free_scene, scene
from graphcam.bench.sweep_times import STATIONS, sweep_times
from graphcam.bench.timing import Timer
from graphcam.bench.tradeoff import INSIDE, exact_profile_error, inner_places, turn
from graphcam.comparison.integrals import accurate_cumsum
from graphcam.given.laws import Floats, law
from graphcam.mechanism.three_points import circumradius

RIVAL_STATIONS = 360
RIVAL_RUNS = 40
ANGLES = "SLSQP on pressure angles"
LINES = "SLSQP given the half-planes"
"""The optimiser as one would first use it, and with graphcam's own formulation and exact derivatives."""
GOALS = {
    "3-4-5": "<= 0.7", "4-5-6-7": "<= 0.7", "cosine": "<= 1.3", "cycloidal": "<= 1.3", "rectangular": "<= 1.6",
    "modified-sine": "<= 1.6", "modified-trapezoidal": "<= 1.6",
}  # fmt: skip
"""Of the laws: polynomial, trigonometric, piecewise."""
FEW = 360
"""Stations of one drawing, for which the overhead of a call counts."""
SUMMED = 10_000_000
"""Values of the running sums."""
HALVINGS = 8
"""Of the chords between three points of a curve, from 0.1 rad on."""


@dataclass(frozen=True)
class ExactRow:
    """One figure of the exact side.

    ratio : in ``unit``, or how many times faster;  goal : what the ratio should keep to
    error_eps : the rounding, None where it was not held against
    more digits;  seconds : on this machine, for the terminal alone
    """

    name: str
    what: str
    ratio: float
    unit: str
    goal: str
    error_eps: float | None
    seconds: float


def exact_rows(stations: int, points: int, timer: Timer) -> list[ExactRow]:
    """Laws at ``stations``, cam points at ``points`` stations, extremes, and least radii beside their rivals."""
    return [
        *_laws(stations, timer),
        *_cam_points(points, timer),
        *_extremes(timer),
        *_sweeps(timer),
        *_least_radii(timer),
        *_sums(timer),
        *_three_points(timer),
    ]


def _laws(n: int, timer: Timer) -> list[ExactRow]:
    unit, u, checked = timer.pairs(n), np.linspace(0, 1, n), inner_places()
    rows: list[ExactRow] = []
    for name, goal in GOALS.items():
        the_law = law(name)
        seconds = timer.seconds(lambda the_law=the_law: the_law(u))
        error = None
        if name in reference.REFERENCED and reference.available():
            exact = reference.law_values(name, checked)
            greatest = np.abs(np.array(the_law(np.linspace(0, 1, 1001)))).max(axis=1)
            off = np.abs(np.array(the_law(checked)) - exact).max(axis=1)
            error = float((off[greatest > 0] / greatest[greatest > 0]).max()) / reference.EPS
        rows.append(ExactRow(f"law {name}", f"f, f', f'', f''' at {n} places", seconds / unit, f"SC({n})", goal, error,
                        seconds))  # fmt: skip
    return rows


def _cam_points(n: int, timer: Timer) -> list[ExactRow]:
    unit, phi, where = timer.pairs(n), turn(n), scene("translating", "3-4-5")
    cam, motion = where.cam, where.board.motion

    def row(name: str, what: str, work: Callable[[], object], goal: str = "", error: float | None = None) -> ExactRow:
        """The time of work at all stations, in their sines and cosines."""
        seconds = timer.seconds(work)
        return ExactRow(name, f"{what} at {n} stations", seconds / unit, f"SC({n})", goal, error, seconds)

    off = exact_profile_error(where)
    return [
        row("motion", "s, v, a, j", lambda: motion(phi)),
        _few_stations(timer),
        row("profile", "working profile", lambda: cam.profile(phi), "", None if off is None else off / reference.EPS),
        row("cam points", "pitch curve, profile and curvature",
            lambda: cam.curves(phi), "<= 2.5"),
    ]  # fmt: skip


def _extremes(timer: Timer) -> list[ExactRow]:
    unit = timer.pairs(RIVAL_STATIONS)
    rows: list[ExactRow] = []
    for follower in FOLLOWERS:
        cam = scene(follower, "3-4-5").cam
        seconds = timer.seconds(cam.extremes)
        rows.append(ExactRow(f"extremes, {follower}", "pressure angles and least convex radius", seconds / unit,
                        f"SC({RIVAL_STATIONS})", "", None, seconds))  # fmt: skip
    return rows


def _sweeps(timer: Timer) -> list[ExactRow]:
    rows: list[ExactRow] = []
    for t in sweep_times(timer):
        eps, ratio = t.error / reference.EPS, t.seconds / t.pairs
        rows.append(ExactRow(f"sweep, {t.name}", "all quantities of a design", ratio, f"SC({STATIONS})", "<= 1.6", eps,
                        t.seconds))  # fmt: skip
        rows.append(ExactRow(f"sweep, {t.name}", "beside a loop over the extremes of one cam", t.looped / t.seconds,
                        "times faster", ">= 8", None, t.looped))  # fmt: skip
    return rows


def _least_radii(timer: Timer) -> list[ExactRow]:
    free, arm, n = free_scene("3-4-5"), scene("arm", "3-4-5"), RIVAL_STATIONS
    unit = timer.pairs(n)
    closed, exchange = timer.seconds(free.least), timer.seconds(arm.least)
    lines = translating_lines(free.board.motion, LIMIT, n)
    arms = arm_lines(arm.board.motion, arm.board.limits.rise, ARM, n)
    start = 0.2 * ARM, 0.9 * ARM
    error = None
    if reference.available():
        error = reference.in_eps(free.least().prime_radius, reference.least_radius(free))
    least, arm_least = free.least().prime_radius, arm.least().prime_radius
    rivals: list[tuple[str, str, float, Callable[[], float], float]] = [
        (
            "translating",
            ANGLES,
            closed,
            lambda: by_pressure_angles(free.board.motion, LIMIT, n, (INSIDE[1], 0.0)),
            least,
        ),
        ("translating", LINES, closed, lambda: by_optimiser(lines, INSIDE), least),
        ("translating", "HalfspaceIntersection", closed, lambda: by_half_planes(lines, INSIDE), least),
        ("arm", LINES, exchange, lambda: by_optimiser(arms, start), arm_least),
    ]
    rows = [
        ExactRow("least radius, translating", "closed form", closed / unit, f"SC({n})", "<= 5 µs", error, closed),
        ExactRow(
            "least radius, arm", "exchange of half-planes", exchange / unit, f"SC({n})", "<= 3000 µs", None, exchange
        ),
    ]
    # A matrix routine that meets other work on its processors takes many times as long: only the best of many runs is
    # the rival's own time.
    patient = Timer(timer.budget, max(timer.least_runs, RIVAL_RUNS))
    for follower, rival, ours, work, exact in rivals:
        seconds, off = patient.seconds(work), work() / exact - 1
        what = f"beside {rival}, {n} stations: off by {off:+.1e}"
        goal = ">= 100" if rival in (ANGLES, LINES) else ""
        rows.append(ExactRow(f"least radius, {follower}", what, seconds / ours, "times faster", goal, None, seconds))
    return rows


def _few_stations(timer: Timer) -> ExactRow:
    motion, phi = scene("translating", "3-4-5").board.motion, turn(FEW)
    seconds, what = timer.seconds(lambda: motion(phi)), f"s, v, a, j at {FEW} stations"
    return ExactRow("motion", what, seconds / timer.pairs(FEW), f"SC({FEW})", "<= 100 µs", None, seconds)


def _sums(timer: Timer) -> list[ExactRow]:
    """Running sums of values of one sign, beside numpy's own, against the correctly rounded sum."""
    values = np.random.default_rng(0).uniform(0.0, 1.0, SUMMED)
    copied = np.empty_like(values)
    copy, exact = timer.seconds(lambda: np.copyto(copied, values)), math.fsum(values)
    rows: list[ExactRow] = []
    for name, goal, work in (("accurate", "<= 4", accurate_cumsum), ("plain", "", np.cumsum)):
        seconds, error = timer.seconds(lambda work=work: work(values)), abs(float(work(values)[-1]) - exact) / exact
        rows.append(ExactRow(f"running sum, {name}", f"{SUMMED} values", seconds / copy, "memory copies", goal,
                        error / reference.EPS, seconds))  # fmt: skip
    return rows


def _three_points(timer: Timer) -> list[ExactRow]:
    """The order of the curvature through three points of the pitch curve, at equal and at unequal chords."""
    cam = scene("translating", "3-4-5").cam
    at, steps = 0.6, 0.1 / 2 ** np.arange(HALVINGS)
    exact = float(cam.pitch_curvature(at))
    rows: list[ExactRow] = []
    for name, goal, share in (("equal", "2.00 ± 0.05", 1.0), ("unequal", "1.00 ± 0.05", 2.0)):
        chords = share * steps, steps

        def curvature(chords: tuple[Floats, Floats] = chords) -> Floats:
            """By the circle through three points [1/mm]."""
            return 1 / circumradius(*(cam.pitch_curve(at + turn) for turn in (-chords[0], 0 * steps, chords[1])))

        errors = np.abs(curvature() - exact)
        order = float(np.polyfit(np.log(steps), np.log(errors), 1)[0])
        rows.append(ExactRow("three points", f"curvature, {name} chords", order, "order", goal, None,
                        timer.seconds(curvature)))  # fmt: skip
    return rows
