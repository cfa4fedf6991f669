"""Random cases of the public functions against references of their own, in one table.

``python tests/adversary.py`` tries them in turn for five minutes of processor, ``--seconds 60`` for one, and
``--cases 50`` each of them fifty times; ``--seed 1000`` begins with other cases, ``--only band`` takes those with that
in their names.  The table says how many cases a function had, its worst error, how often that exceeds what is permitted
(wrong), how often a sound case was refused, and how often anything else was raised (crashed); it ends with 1 if any
is, and the cases are named by their seeds.

The references are the textbooks' definitions at 50 digits (:mod:`reference`), brute force over dense places, Newton's
and Hertz's formulas written out, exact rational numbers, and the theorem that a function's result has to satisfy.
Errors are relative to the greatest value of what is computed.
"""

from __future__ import annotations

import argparse
import csv
import math
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import count
from tempfile import TemporaryDirectory

import numpy as np
from mpmath import diff, mp, mpf
from reference import (
    EPS,
    ReferenceArm,
    ReferenceCam,
    ReferenceFace,
    ReferenceSwingingFace,
    displacement,
    least_radius,
    lift,
)

import graphcam as gc
from graphcam.comparison.integrals import accurate_cumsum
from graphcam.given.laws import DWELL_TO_DWELL_LAWS, LAWS
from graphcam.given.motion import FULL_TURN

Random = np.random.Generator
Try = Callable[[Random], float]
DEFAULT_SECONDS = 300.0
PLACES = 4
"""Places at which a case is held against 50 digits."""


@dataclass
class Trial:
    """One function, how far it may be off, and what became of its cases."""

    name: str
    permitted: float
    case: Try
    cases: int = 0
    worst: float = 0.0
    wrong: list[int] = field(default_factory=list)
    refused: list[int] = field(default_factory=list)
    crashed: list[int] = field(default_factory=list)

    def run(self, seed: int) -> None:
        """Try one case more."""
        self.cases += 1
        try:
            error = float(self.case(np.random.default_rng([seed, len(self.name)])))
        except gc.GraphcamError:
            self.refused.append(seed)
        except Exception:  # noqa: BLE001 - whatever it is, it is counted
            self.crashed.append(seed)
        else:
            self.worst = max(self.worst, error) if error == error else math.nan
            if not error <= self.permitted:
                self.wrong.append(seed)

    @property
    def failed(self) -> bool:
        """Whether a case went wrong in any way."""
        return bool(self.wrong or self.refused or self.crashed)


TRIALS: list[Trial] = []


def trial(name: str, permitted: float) -> Callable[[Try], Try]:
    """Enter a case into the table; it draws its input, and returns the error of the function beside the reference."""

    def entered(case: Try) -> Try:
        TRIALS.append(Trial(name, permitted, case))
        return case

    return entered


# --- input -----------------------------------------------------------------------------------------------------------


def motion(draw: Random, low: float = 5, high: float = 25, laws: tuple[str, ...] = tuple(DWELL_TO_DWELL_LAWS)):
    """A rise, a dwell, a return, a dwell, any of the laws."""
    angles = draw.dirichlet(np.full(4, 8.0)) * FULL_TURN
    height = draw.uniform(low, high)
    up, down = (str(name) for name in draw.choice(laws, 2))
    rise, back = gc.Rise(height, angles[0], up), gc.Return(height, angles[2], down)
    return gc.Motion([rise, gc.Dwell(angles[1]), back, gc.Dwell(FULL_TURN - angles[:3].sum())])


def sense(draw: Random) -> str:
    return str(draw.choice(["cw", "ccw"]))


def translating(draw: Random) -> gc.Cam:
    """A cam with an offset and a small roller."""
    follower = gc.Translating(draw.uniform(-15, 15), draw.uniform(2, 8))
    return gc.Cam(motion(draw), follower, draw.uniform(60, 100), sense(draw))


def arm(draw: Random) -> gc.Cam:
    """A cam of an arm that swings by 6 to 17 degrees."""
    follower = gc.Oscillating(80.0, draw.uniform(95, 115), draw.uniform(2, 8))
    return gc.Cam(motion(draw, 0.1, 0.3), follower, draw.uniform(50, 75), sense(draw))


def places(draw: Random) -> list[float]:
    return draw.uniform(0, FULL_TURN, PLACES).tolist()


def apart(found, exact) -> float:
    """The greatest difference, as a part of the greatest exact value."""
    exact = [mpf(x) for x in exact]
    off = max(abs(mpf(float(a)) - b) for a, b in zip(found, exact, strict=True))
    return float(off / max(max(map(abs, exact)), mpf("1e-300")))


def highest(quantity, cam: gc.Cam, signed: bool = True) -> float:
    """The greatest magnitude over a dense turn, then closer about the highest places."""
    phi = np.linspace(0, FULL_TURN, 20_001)
    height = (lambda x: np.abs(quantity(x))) if signed else quantity
    values, best = height(phi), -math.inf
    starts = cam.motion.breaks
    best = max(values.max(), height(starts).max(), *height(np.nextafter(starts[1:], 0)).tolist())
    for k in np.argsort(-values)[:4]:
        low, high = phi[max(k - 1, 0)], phi[min(k + 1, phi.size - 1)]
        for _ in range(4):
            near = np.linspace(low, high, 101)
            here = height(near)
            top, best = int(here.argmax()), max(best, here.max())
            low, high = near[max(top - 1, 0)], near[min(top + 1, 100)]
    return float(best)


# --- laws, motions, integrals ----------------------------------------------------------------------------------------


@trial("law", 8 * EPS)
def _(draw: Random) -> float:
    name = str(draw.choice(list(LAWS)))
    u, normalised = draw.uniform(0.01, 0.99), gc.law(name)
    exact = [diff(lambda x: lift(name, x), mpf(u), n) for n in (0, 1)]
    peaks = 1.0, normalised.peak_velocity
    return max(abs(float(mpf(float(f)) - e)) / most for f, e, most in zip(normalised(u), exact, peaks, strict=False))


@trial("Motion", 32 * EPS)
def _(draw: Random) -> float:
    moved = motion(draw)
    phi = places(draw)
    s, v, *_ = moved(np.array(phi))
    by_height = apart(s, [displacement(moved, mpf(x)) for x in phi]) if s.max() > 0.1 else 0.0
    fastest = max(phase.normalised.peak_velocity * phase.lift / phase.angle for phase in moved.phases[::2])
    slopes = [diff(lambda t: displacement(moved, t), mpf(x)) for x in phi]
    return max(by_height, *(abs(float(mpf(float(a)) - b)) / fastest for a, b in zip(v, slopes, strict=True)))


@trial("cam_angle", 2 * EPS)
def _(draw: Random) -> float:
    degrees = float(draw.integers(-(10**9), 10**9)) * 360 + draw.uniform(0, 360)
    exact = float(Fraction(degrees) % 360 / 360 * Fraction(FULL_TURN))
    return abs(float(gc.cam_angle(degrees, turn=360.0)) - exact) / FULL_TURN


@trial("accurate_cumsum", 4 * EPS)
def _(draw: Random) -> float:
    values = draw.normal(0, 1, 5000) * 10.0 ** draw.integers(-8, 8, 5000)
    return abs(float(accurate_cumsum(values)[-1]) - math.fsum(values)) / float(np.abs(values).sum())


@trial("boundary_motion", 1e-9)
def _(draw: Random) -> float:
    top, height = draw.uniform(1.5, 3.0), draw.uniform(5, 30)
    low, high = {"s": 0.0, "v": 0.0, "a": 0.0}, {"s": height, "v": 0.0, "a": 0.0}
    rise = gc.PolynomialPart([gc.MotionPoint(0.0, **low), gc.MotionPoint(top, **high)])
    back = gc.PolynomialPart([gc.MotionPoint(top, **high), gc.MotionPoint(FULL_TURN, **low)])
    found = gc.boundary_motion([rise, back])
    # The polynomial of lowest degree with these conditions is the law 3-4-5.
    u = draw.uniform(0, 1, 50)
    exact = height * u**3 * (10 - 15 * u + 6 * u * u)
    return float(np.abs(found(top * u)[0] - exact).max() / height)


@trial("measured_motion", 1.0)
def _(draw: Random) -> float:
    """No row is left by more than the tolerance."""
    moved = motion(draw, 15, 30, ("3-4-5", "cycloidal", "4-5-6-7"))
    phi = np.radians(np.arange(0, 360, 2.0))
    tolerance = 0.05
    rows = moved(phi)[0] + draw.uniform(-0.5, 0.5, phi.size) * tolerance
    fitted = gc.measured_motion(phi, rows, tolerance)
    return float(np.abs(fitted(phi - fitted.zero)[0] + rows.min() - rows).max() / (2 * tolerance))


@trial("boundary_motion, spline", 1e-9)
def _(draw: Random) -> float:
    """The B-spline on the same knots, solved by a dense matrix."""
    from scipy.interpolate import BSpline

    top, height = draw.uniform(2.0, 4.0), draw.uniform(5, 30)
    rest = {"v": 0.0, "a": 0.0}
    middle = {"s": height * draw.uniform(0.4, 0.6)}
    points = [
        gc.MotionPoint(0.0, s=0.0, **rest),
        gc.MotionPoint(top / 2, **middle),
        gc.MotionPoint(top, s=height, **rest),
    ]
    inner = (top * draw.uniform([0.3, 0.55], [0.45, 0.7])).tolist()
    back = gc.PolynomialPart([points[-1], gc.MotionPoint(FULL_TURN, s=0.0, **rest)])
    found = gc.boundary_motion([gc.SplinePart(points, degree=4, knots=inner), back])
    knots = np.array([0.0] * 5 + inner + [top] * 5)
    n = knots.size - 5
    asked = [(x.angle, k, value) for x in points for k, value in x.given.items()]
    rows = [[float(BSpline(knots, np.eye(n)[i], 4)(x, nu=k)) for i in range(n)] for x, k, _ in asked]
    exact = BSpline(knots, np.linalg.solve(np.array(rows), [value for *_, value in asked]), 4)
    phi = draw.uniform(0, top, 50)
    moved = found(phi - found.origin)[0] - found(-found.origin)[0]
    return float(np.abs(moved - exact(phi)).max() / height)


@trial("boundary_law", 1e-12)
def _(draw: Random) -> float:
    """A polynomial through a point on the way, solved at 50 digits."""
    at, reached = draw.uniform(0.45, 0.55), draw.uniform(0.45, 0.55)
    points = [gc.MotionPoint(0, s=0, v=0, a=0), gc.MotionPoint(at, s=reached), gc.MotionPoint(1, s=1, v=0, a=0)]
    found, u = gc.boundary_law(points), draw.uniform(0, 1, PLACES)
    conditions = [(mpf(x.angle), k, value) for x in points for k, value in x.given.items()]
    rows = [[mp.ff(m, k) * x ** max(m - k, 0) for m in range(7)] for x, k, _ in conditions]
    c = mp.lu_solve(mp.matrix(rows), mp.matrix([mpf(value) for *_, value in conditions]))
    return apart(found(u)[0], [mp.polyval(list(c)[::-1], mpf(x)) for x in u])


@trial("constant_velocity_law", 16 * EPS)
def _(draw: Random) -> float:
    """Between the blends the lift is that of a line which meets the ends of the blends' middles."""
    start, end = draw.uniform(0.05, 0.45, 2)
    found = gc.constant_velocity_law(start, end, int(draw.integers(1, 4)))
    u, fastest = draw.uniform(start, 1 - end), 2 / (2 - start - end)
    f, f1, *_ = found.at(u)
    return max(abs(f - fastest * (u - start / 2)), abs(f1 / fastest - 1), abs(found.peak_velocity / fastest - 1))


@trial("sampled_law", 1e-9)
def _(draw: Random) -> float:
    """The quintic spline through the same rows, by scipy."""
    from scipy.interpolate import make_interp_spline

    name, u = str(draw.choice(["3-4-5", "cycloidal", "4-5-6-7"])), np.linspace(0, 1, int(draw.integers(12, 60)))
    f = gc.law(name)(u)[0]
    ends = [(1, 0.0), (2, 0.0)]
    places = draw.uniform(0, 1, 50)
    return float(
        np.abs(gc.sampled_law("own", u, f)(places)[0] - make_interp_spline(u, f, 5, bc_type=(ends, ends))(places)).max()
    )


@trial("integrated_motion", 1.0)
def _(draw: Random) -> float:
    """The rows' second integral by scipy, closed; and no row of it is left by more than the tolerance."""
    from scipy.interpolate import PPoly

    moved = motion(draw, 15, 30, ("3-4-5", "cycloidal", "4-5-6-7"))
    phi = np.radians(np.arange(0, 360, 1.0))
    a = moved(phi)[2] + draw.uniform(-0.3, 0.3)
    tolerance = 0.05
    fitted = gc.integrated_motion(phi, a, tolerance)
    ends, values = np.append(phi, FULL_TURN), np.append(a, a[0])
    line = PPoly(np.array([np.diff(values) / np.diff(ends), values[:-1]]), ends)
    closed = PPoly(line.c - np.array([[0.0], [float(line.integrate(0, FULL_TURN)) / FULL_TURN]]), ends)
    twice = closed.antiderivative(2)
    s = twice(phi) - twice(FULL_TURN) / FULL_TURN * phi
    s -= s.mean() - fitted.measured.mean()
    off = np.abs(fitted.measured - s).max() / np.ptp(s)
    return max(float(off) / 1e-9, float(np.abs(fitted(phi - fitted.zero)[0] - fitted.measured).max()) / tolerance)


@trial("cam_by_radii, outline_motion", 1e-6)
def _(draw: Random) -> float:
    """The roller comes down the stem until it rests on the outline, by brute force over its places."""
    base, nose, reach, roller = draw.uniform(15, 25), draw.uniform(3, 8), draw.uniform(4, 9), draw.uniform(5, 15)
    distance = base + reach - nose
    # Any flank that touches both circles from outside is longer than half of what they take along the line of centres.
    flank = (base + nose + distance) / 2 * draw.uniform(1.5, 4)
    cam = gc.cam_by_radii(base, flank, nose_radius=nose, lift=reach)
    found = gc.outline_motion(cam, gc.Translating(roller_radius=roller))
    along = ((flank - base) ** 2 - (flank - nose) ** 2 + distance**2) / (2 * distance)
    centre = complex(along, math.sqrt((flank - base) ** 2 - along**2))
    ends = np.angle(-centre), np.angle(distance - centre)
    arc = np.linspace(*np.unwrap(ends), 20_000)
    flanks = centre + flank * np.exp(1j * arc)
    circle = np.exp(1j * np.linspace(0, FULL_TURN, 40_000))
    outline = np.concatenate([base * circle, distance + nose * circle, flanks, flanks.conj()])
    phi = draw.uniform(0, 2 * cam.ascent, PLACES)
    # The apex comes under the stem at the end of the ascent.
    exact = _heights(phi - cam.ascent, outline, roller) - base - roller
    return float(np.abs(found(phi)[0] - exact).max() / reach)


def _heights(places, outline, roller: float) -> np.ndarray:
    """How high a roller's centre rests on points of an outline that has turned by angles, on the x axis."""
    seen = (outline * np.exp(-1j * turned) for turned in places)
    near = (points[np.abs(points.imag) < roller] for points in seen)
    return np.array([float((points.real + np.sqrt(roller**2 - points.imag**2)).max()) for points in near])


@trial("ArcMotion", 1e-6)
def _(draw: Random) -> float:
    """The roller on the three arcs, by brute force over their places."""
    rho1, roller = draw.uniform(12, 22), draw.uniform(4, 15)
    root = gc.three_arc_cam(D=(51.68, 18.81), G=(22.24, 37.84), rho1=rho1, A=(0, 40))[0]
    moved = root.motion(roller)
    a, g, f, d, c1, c2, c3 = (complex(*point) for point in (root.A, root.G, root.F, root.D, root.C1, root.C2, root.C3))
    arcs = []
    for middle, start, end in ((c2, a, g), (c3, g, f), (c1, f, d)):
        turn = np.unwrap([np.angle(start - middle), np.angle(end - middle)])
        arcs.append(middle + abs(start - middle) * np.exp(1j * np.linspace(*turn, 20_000)))
    outline = np.concatenate([*arcs, abs(a) * np.exp(1j * np.linspace(math.pi / 2, 1.5 * math.pi, 20_000))]) / (
        a / abs(a)
    )
    places = draw.uniform(0, moved.rise, PLACES)
    exact = _heights(-places, outline, roller) - abs(a) - roller
    return float(np.abs(moved(places)[0] - exact).max() / moved.lift)


@trial("cam_through_points", 1.1)
def _(draw: Random) -> float:
    """An eccentric disc through points; its follower moves by Pythagoras, the fitted one within the tolerance."""
    radius, e, roller, turn = draw.uniform(25, 40), draw.uniform(3, 10), draw.uniform(5, 12), draw.uniform(0, FULL_TURN)
    centre = e * np.exp(1j * turn)
    points = centre + radius * np.exp(1j * np.linspace(0, FULL_TURN, 360, endpoint=False))
    found = gc.outline_motion(gc.cam_through_points(points), gc.Translating(roller_radius=roller))
    phi = np.array(places(draw))
    # The stem stands on the y axis; the cam turns counter-clockwise.
    seen = centre * np.exp(1j * (phi + found.zero))
    exact = seen.imag + np.sqrt((radius + roller) ** 2 - seen.real**2) - (radius + roller - e)
    return float(np.abs(found(phi)[0] - exact).max() / 0.01)


# --- profiles --------------------------------------------------------------------------------------------------------


def on_profile(cam: gc.Cam, exact, draw: Random) -> float:
    found = [(x, cam.profile(x), exact.profile(mpf(x))) for x in places(draw)]
    return max(float(max(abs(mpf(float(p[i])) - e[i]) for i in (0, 1))) / cam.prime_radius for _, p, e in found)


@trial("Cam.profile, translating", 16 * EPS)
def _(draw: Random) -> float:
    cam = translating(draw)
    return on_profile(cam, ReferenceCam(cam), draw)


@trial("Cam.profile, oscillating", 64 * EPS)
def _(draw: Random) -> float:
    cam = arm(draw)
    return on_profile(cam, ReferenceArm(cam), draw)


@trial("Cam.profile, flat-faced", 16 * EPS)
def _(draw: Random) -> float:
    cam = gc.Cam(motion(draw), gc.FlatFaced(), draw.uniform(80, 120), sense(draw))
    return on_profile(cam, ReferenceFace(cam), draw)


@trial("Cam.profile, oscillating flat", 64 * EPS)
def _(draw: Random) -> float:
    follower = gc.OscillatingFlat(draw.uniform(100, 130), draw.uniform(-5, 5))
    cam = gc.Cam(motion(draw, 0.05, 0.15), follower, draw.uniform(50, 60), sense(draw))
    return on_profile(cam, ReferenceSwingingFace(cam), draw)


@trial("Cam.pressure_angle", 64 * EPS)
def _(draw: Random) -> float:
    cam = translating(draw) if draw.integers(2) else arm(draw)
    exact = (ReferenceCam if hasattr(cam.follower, "offset") else ReferenceArm)(cam)
    off = [float(mpf(float(cam.pressure_angle(x))) - exact.pressure_angle(mpf(x))) for x in places(draw)]
    return max(map(abs, off)) / (math.pi / 2)


@trial("Cam.pitch_curvature", 256 * EPS)
def _(draw: Random) -> float:
    cam = translating(draw) if draw.integers(2) else arm(draw)
    exact = (ReferenceCam if hasattr(cam.follower, "offset") else ReferenceArm)(cam)
    at = places(draw)
    return apart(cam.pitch_curvature(np.array(at)), [exact.curvature(mpf(x)) for x in at])


@trial("Cam.extremes", 1e-9)
def _(draw: Random) -> float:
    cam = translating(draw) if draw.integers(2) else arm(draw)
    found = cam.extremes()
    steepest = max(abs(found.pressure_angle_rise[0]), abs(found.pressure_angle_return[0]))
    sharpest = 1 / highest(cam.pitch_curvature, cam, signed=False)
    return max(abs(steepest / highest(cam.pressure_angle, cam) - 1), abs(found.min_convex_radius[0] / sharpest - 1))


@trial("Cam.undercuts", 0.0)
def _(draw: Random) -> float:
    """A roller larger than the least radius leaves a loop, a smaller one nothing."""
    cam = translating(draw)
    sharpest = 1 / highest(cam.pitch_curvature, cam, signed=False)
    excess = draw.choice([0.5, 0.99, 1.01, 1.2])
    roller = sharpest * excess if sharpest * excess < cam.prime_radius else sharpest / excess
    follower = gc.Translating(cam.follower.offset, roller)
    cut = gc.Cam(cam.motion, follower, cam.prime_radius, cam.rotation).undercuts()
    return float(bool(cut) != (follower.roller_radius > sharpest))


@trial("Cam.trimmed_profile", 1e-9)
def _(draw: Random) -> float:
    """No place of what is left of an undercut profile lies nearer to the pitch curve than the roller's radius."""
    from scipy.spatial import cKDTree

    knife = translating(draw)
    roller = min(1 / highest(knife.pitch_curvature, knife, signed=False), 40.0) * draw.uniform(1.01, 1.2)
    cam = gc.Cam(knife.motion, gc.Translating(knife.follower.offset, roller), knife.prime_radius, knife.rotation)
    pitch = cam.pitch_curve(np.linspace(0, FULL_TURN, 20_001))
    near = cKDTree(pitch).query(np.concatenate([*cam.trimmed_profile(500)]).reshape(-1, 2))[0]
    return max(0.0, roller - float(near.min())) / roller


@trial("circumradius", 1e-9)
def _(draw: Random) -> float:
    centre, radius = draw.uniform(-50, 50, 2), draw.uniform(1, 100)
    turn = np.sort(draw.uniform(0, FULL_TURN, 3))
    points = [(centre + radius * np.array([math.cos(t), math.sin(t)])).tolist() for t in turn]
    return abs(float(gc.circumradius(*points)) / radius - 1) * min(1.0, np.diff(turn).min() ** 2)


@trial("three_arc_cam", 1e-9)
def _(draw: Random) -> float:
    """F lies on the circle about C1 and on the flank's about C3, which passes through G and is tangent there."""
    c1 = np.array([draw.uniform(15, 25), draw.uniform(10, 20)])
    given = {"D": [40.0, 20.0], "G": [0.0, 30.0], "rho1": 5.0, "C1": c1.tolist(), "C2": [0.0, -draw.uniform(5, 50)]}
    found, _ = gc.three_arc_cam(**given)
    f = np.array(found.F)
    if found.straight:
        return abs(float(np.hypot(*(f - c1))) / 5.0 - 1)
    c3, g, c2 = (np.array(point) for point in (found.C3, given["G"], given["C2"]))
    across = np.cross([*(g - c3), 0], [*(g - c2), 0])[2] / (np.hypot(*(g - c3)) * np.hypot(*(g - c2)))
    circles = [np.hypot(*(f - c1)) / 5.0, np.hypot(*(f - c3)) / found.rho3, np.hypot(*(g - c3)) / found.rho3]
    return float(max(abs(across), *np.abs(np.array(circles) - 1)))


# --- sizes -----------------------------------------------------------------------------------------------------------


@trial("minimum_radius, translating", 16 * EPS)
def _(draw: Random) -> float:
    moved = motion(draw, laws=("cosine", "cycloidal", "3-4-5", "4-5-6-7"))
    limit, back = np.radians(draw.uniform(15, 50)), float(np.radians(draw.uniform(20, 60)))
    found = gc.minimum_radius(moved, gc.Translating(), rise=float(limit), return_=back)
    return abs(float(mpf(found.prime_radius) / least_radius(moved, float(limit), back, rest=True)) - 1)


@trial("minimum_radius, oscillating", 1e-9)
def _(draw: Random) -> float:
    """The limits are kept with this radius and place, and one of them is reached."""
    moved, follower = motion(draw, 0.1, 0.3), gc.Oscillating(80.0)
    rise, back = np.radians(draw.uniform(35, 50, 2)).tolist()
    turn = sense(draw)
    found = gc.minimum_radius(moved, follower, turn, rise=rise, return_=back)
    cam = gc.Cam(moved, gc.Oscillating(80.0, found.place), found.prime_radius, turn)
    tops = [
        highest(lambda phi, d=d: np.where(d * moved(phi)[1] > 0, cam.pressure_angle(phi), 0.0), cam) for d in (1, -1)
    ]
    return max(tops[0] - rise, tops[1] - back, 0.0) + max(0.0, min(rise - tops[0], back - tops[1]) - 1e-6)


@trial("minimum_radius, flat-faced", 1e-9)
def _(draw: Random) -> float:
    moved, least = motion(draw), draw.uniform(2, 20)
    found = gc.minimum_radius(moved, gc.FlatFaced(), curvature=least)
    at = gc.Cam(moved, gc.FlatFaced(), 1000.0)
    needed = highest(lambda phi: -(moved(phi)[0] + moved(phi)[2]), at, signed=False)
    return abs(found.prime_radius - max(least + needed, 0.0)) / found.prime_radius


@trial("minimum_radius, oscillating flat", 1e-5)
def _(draw: Random) -> float:
    """The profile's radius of curvature, by differences of its points, comes down to the one that is permitted."""
    moved, turn = motion(draw, 0.05, 0.15, ("cycloidal", "3-4-5", "4-5-6-7")), sense(draw)
    follower, least = gc.OscillatingFlat(draw.uniform(100, 130), draw.uniform(-5, 5)), draw.uniform(15, 30)
    found = gc.minimum_radius(moved, follower, turn, curvature=least)
    cam, h = gc.Cam(moved, follower, found.prime_radius, turn), 1e-4

    def bend(phi):
        """The curvature, which has no sign to lose where the radius is far from zero."""
        before, here, after = (cam.profile(phi + k * h) @ [1, 1j] for k in (-1, 0, 1))
        first, second = (after - before) / (2 * h), (after - 2 * here + before) / h**2
        return np.abs((first.conj() * second).imag) / np.abs(first) ** 3

    return abs(1 / highest(bend, cam, signed=False) / least - 1)


@trial("size_cam", 2e-6)
def _(draw: Random) -> float:
    """Wider ranges refuse nothing that narrower ones keep, and lose nothing: the radius is no larger."""
    moved = motion(draw, 6, 12, ("cosine", "cycloidal", "3-4-5", "triangular"))
    load = gc.SpringLoad(0.2, draw.uniform(50, 200), 1.0, preload=draw.uniform(200, 1200))
    given = {"offset": (-8, 6), "roller_radius": (5, 20), "width": (6, 33), "permitted_stress": 500.0}
    narrow = gc.size_cam(moved, load, prime_radius=(25, 80), **given, rise=math.radians(29))
    wide = gc.size_cam(moved, load, prime_radius=(draw.uniform(11, 25), 80), **given, rise=math.radians(29))
    return max(0.0, wide.radius / narrow.radius - 1)


@trial("largest_roller", 1e-9)
def _(draw: Random) -> float:
    cam = translating(draw) if draw.integers(2) else arm(draw)
    sharpest = 1 / highest(cam.pitch_curvature, cam, signed=False)
    return abs(gc.largest_roller(cam) / min(sharpest, cam.prime_radius) - 1)


@trial("ConjugateCam.profile", 1e-9)
def _(draw: Random) -> float:
    """The second centre moves along with the stem; the profile lies a radius inside its path, square to it."""
    cam, roller = gc.Cam(motion(draw, 3, 10), gc.Translating(roller_radius=8.0), 60.0, sense(draw)), draw.uniform(5, 12)
    x, y = draw.uniform(-4, 4), -draw.uniform(60, 70)
    second = gc.ConjugateCam(cam, at=(x, y), roller_radius=roller)
    turn = -1j if cam.rotation == "ccw" else 1j

    def path(phi):
        return (complex(x, y) + 1j * cam.motion(phi)[0]) * np.exp(turn * phi)

    phi = np.array(places(draw))
    _, v, *_ = cam.motion(phi)
    along = (1j * v + turn * (complex(x, y) + 1j * cam.motion(phi)[0])) * np.exp(turn * phi)
    inside = second.profile(phi) @ [1, 1j] - path(phi)
    square = (inside * along.conj()).real / (roller * np.abs(along))
    inwards = (inside * path(phi).conj()).real < 0
    return max(float(np.abs(np.abs(inside) / roller - 1).max()), float(np.abs(square).max()), float(not inwards.all()))


@trial("face_width", 1e-9)
def _(draw: Random) -> float:
    moved, turn = motion(draw), sense(draw)
    at, sigma = gc.Cam(moved, gc.FlatFaced(), 1000.0), 1 if turn == "ccw" else -1
    found = gc.face_width(moved, turn)
    right, left = (highest(lambda phi, k=k: k * sigma * moved(phi)[1], at, signed=False) for k in (1, -1))
    return max(abs(found.right / right - 1), abs(found.left / left - 1))


@trial("face_reach", 1e-9)
def _(draw: Random) -> float:
    moved, turn = motion(draw, 0.05, 0.15), sense(draw)
    follower, radius = gc.OscillatingFlat(draw.uniform(100, 130), draw.uniform(-5, 5)), draw.uniform(50, 60)
    cam, sigma = gc.Cam(moved, follower, radius, turn), 1 if turn == "ccw" else -1
    start = math.asin((radius + follower.face_offset) / follower.distance)

    def reach(phi):
        s, v, *_ = moved(phi)
        return follower.distance * np.cos(start + s) / (1 + sigma * v)

    found = gc.face_reach(moved, follower, radius, turn)
    near = -highest(lambda phi: -reach(phi), cam, signed=False)
    return max(abs(found.near / near - 1), abs(found.far / highest(reach, cam, signed=False) - 1))


@trial("radius_sensitivity", 1e-5)
def _(draw: Random) -> float:
    """By the permitted angle, by a difference of the minimum radius itself."""
    moved, step = motion(draw, laws=("cosine", "cycloidal", "3-4-5", "4-5-6-7")), 1e-5
    limit, offset = math.radians(draw.uniform(20, 45)), draw.uniform(-5, 5)
    given = {"rotation": sense(draw), "offset": offset}
    found = gc.radius_sensitivity(moved, gc.Translating(), rise=limit, **given)["rise"]
    radii = [gc.minimum_radius(moved, gc.Translating(), rise=limit + k * step, **given).prime_radius for k in (1, -1)]
    return abs((radii[0] - radii[1]) / (2 * step) / found - 1)


@trial("sensitivities", 1e-12)
def _(draw: Random) -> float:
    """Across the flank an error lifts by 1/cos(alpha), beside it by tan(alpha)."""
    cam, phi = translating(draw), np.array(places(draw))
    found, alpha = gc.sensitivities(cam).motion(phi), cam.pressure_angle(phi)
    across, beside = found["profile"][0], np.abs(found["offset"][0])
    return max(apart(across, 1 / np.cos(alpha)), apart(beside, np.abs(np.tan(alpha))))


@trial("MadeCam", 1e-9)
def _(draw: Random) -> float:
    """A roller that is too large rests on the parallel curve of the pitch curve, sought by bisection."""
    from scipy.optimize import brentq

    cam, larger = translating(draw), draw.uniform(-0.1, 0.1)
    made = gc.MadeCam(cam, gc.Deviations((), np.zeros(0), {"roller_radius": larger}))
    e, sigma = cam.follower.offset, 1 if cam.rotation == "ccw" else -1
    rest = math.sqrt(cam.prime_radius**2 - e**2)

    def centre(theta: float, phi: float) -> complex:
        pitch, profile = (points(theta) @ [1, 1j] for points in (cam.pitch_curve, cam.profile))
        return (pitch + larger * (pitch - profile) / abs(pitch - profile)) * np.exp(1j * sigma * phi)

    off = []
    for phi in places(draw):
        theta = brentq(lambda t, phi=phi: centre(t, phi).real - e, phi - 0.1, phi + 0.1, xtol=1e-15)
        off.append(abs(float(made(phi)[0]) - (centre(theta, phi).imag - rest)))
    return max(off) / cam.motion.lift


# --- forces, tolerances, sweeps, drawings ----------------------------------------------------------------------------


@trial("CamForces.at", 1e-12)
def _(draw: Random) -> float:
    """Newton's second law with a spring, along the stem; across the contact the normal is longer by 1/cos(alpha)."""
    cam = translating(draw)
    load = gc.SpringLoad(draw.uniform(0.1, 2), draw.uniform(30, 400), draw.uniform(0.5, 5), preload=5000.0)
    phi = np.array(places(draw))
    s, _, a, _ = cam.motion(phi)
    omega = 2 * math.pi * load.speed_rpm / 60
    along = load.mass * a * 1e-3 * omega**2 + 5000.0 + load.stiffness * s
    return apart(gc.CamForces(cam, load).at(phi).normal, along / np.cos(cam.pressure_angle(phi)))


@trial("mean_torque", 1e-9)
def _(draw: Random) -> float:
    """Without friction a turn takes no work."""
    cam, load = translating(draw), gc.SpringLoad(0.5, 200, 2.0, preload=3000.0)
    forces = gc.CamForces(cam, load)
    return abs(gc.mean_torque(forces)) / abs(forces.max_torque().value)


@trial("hertz_line_contact", 1e-12)
def _(draw: Random) -> float:
    force, width = draw.uniform(10, 5000), draw.uniform(3, 40)
    first, second = draw.uniform(2, 50), draw.uniform(5, 200)
    found = gc.hertz_line_contact(force, width, first, second)
    modulus, curvature = 206_000 / (2 * (1 - 0.09)), 1 / first + 1 / second
    return abs(found.peak_pressure / math.sqrt(force * modulus * curvature / (math.pi * width)) - 1)


@trial("ContactStress.max_pressure", 1e-9)
def _(draw: Random) -> float:
    """Hertz's pressure of a steel roller that Newton's second law presses onto the profile, by brute force."""
    cam, load = translating(draw), gc.SpringLoad(0.5, draw.uniform(30, 200), 2.0, preload=3000.0)
    width, roller, omega = draw.uniform(5, 30), cam.follower.roller_radius, 2 * math.pi * load.speed_rpm / 60

    def pressure(phi):
        s, _, a, _ = cam.motion(phi)
        force = (load.mass * a * 1e-3 * omega**2 + load.preload + load.stiffness * s) / np.cos(cam.pressure_angle(phi))
        bend = cam.pitch_curvature(phi)
        relative = 1 / roller + bend / (1 - roller * bend)
        return np.sqrt(force * 206_000 / (2 * (1 - 0.09)) * relative / (math.pi * width))

    found = gc.ContactStress(gc.CamForces(cam, load), gc.RollerContact(width)).max_pressure()
    return abs(found.value / highest(pressure, cam) - 1)


@trial("spring_preload", 1e-9)
def _(draw: Random) -> float:
    """The spring just holds the follower where it is flung off most."""
    cam, load = translating(draw), gc.SpringLoad(1.0, draw.uniform(300, 900), draw.uniform(0.1, 2))
    omega = 2 * math.pi * load.speed_rpm / 60
    needed = highest(
        lambda phi: -(load.mass * cam.motion(phi)[2] * 1e-3 * omega**2 + load.stiffness * cam.motion(phi)[0]),
        cam,
        signed=False,
    )
    return abs(gc.spring_preload(cam, load).preload / needed - 1)


@trial("CamForces.at, oscillating", 1e-12)
def _(draw: Random) -> float:
    """Euler's second law about the pivot with a torsion spring; the normal force acts on the lever l cos(alpha)."""
    cam, phi = arm(draw), np.array(places(draw))
    load = gc.ArmLoad(draw.uniform(500, 3000), draw.uniform(30, 300), draw.uniform(1e3, 1e4), preload=1e6)
    s, _, a, _ = cam.motion(phi)
    omega = 2 * math.pi * load.speed_rpm / 60
    torque = load.inertia * a * 1e-3 * omega**2 + 1e6 + load.stiffness * s
    return apart(gc.CamForces(cam, load).at(phi).normal, torque / (80.0 * np.cos(cam.pressure_angle(phi))))


@trial("Contact", 1e-9)
def _(draw: Random) -> float:
    """The extremes of the force, and how much of the turn it is negative."""
    cam = translating(draw)
    load = gc.SpringLoad(0.5, draw.uniform(300, 900), draw.uniform(0.5, 3), preload=draw.uniform(0, 200))
    omega, found = 2 * math.pi * load.speed_rpm / 60, gc.Contact(cam.motion, load)

    def force(phi):
        s, _, a, _ = cam.motion(phi)
        return load.mass * a * 1e-3 * omega**2 + load.preload + load.stiffness * s

    top, bottom = highest(force, cam, signed=False), -highest(lambda phi: -force(phi), cam, signed=False)
    phi = np.linspace(0, FULL_TURN, 40_001)
    inside = np.zeros(phi.shape, dtype=bool)
    for start, end in found.lost():
        inside |= np.mod(phi - start, FULL_TURN) < end - start
    missed = np.abs(force(phi))[inside != (force(phi) < 0)]
    # At a jump of the force a sample may lie on either side.
    lost = float(np.count_nonzero(missed > 0.01 * top) > 2 * len(cam.motion.breaks))
    return max(abs(found.max_force().value / top - 1), abs(found.min_force().value - bottom) / top, lost)


@trial("jamming_margin", 1e-9)
def _(draw: Random) -> float:
    """The cam drags a roller's follower on in its own sense."""
    cam, mu = translating(draw), draw.uniform(0, 0.4)
    margin = -highest(
        lambda phi: mu * np.sin(cam.pressure_angle(phi)) - np.cos(cam.pressure_angle(phi)), cam, signed=False
    )
    return abs(gc.jamming_margin(cam, mu).value - margin)


@trial("follower_response", 1e-8)
def _(draw: Random) -> float:
    """The mass on the end of a spring and a damper, by an integrator of the eighth order."""
    from scipy.integrate import solve_ivp

    name = str(draw.choice(["3-4-5", "cycloidal", "4-5-6-7"]))
    n, damping, driven = draw.uniform(0.5, 6), draw.uniform(0, 0.2), gc.law(name)
    omega = 2 * math.pi * n

    def slope(u, state):
        f, f1 = driven(min(u, 1.0), derivatives=1)
        return [state[1], omega**2 * (f - state[0]) + 2 * damping * omega * (f1 - state[1])]

    solved = solve_ivp(slope, (0, 1), [0.0, 0.0], "DOP853", rtol=1e-12, atol=1e-13, t_eval=[0.5, 1.0], max_step=0.05)
    x, x1, _ = gc.follower_response(name, n, damping)([0.5, 1.0])
    return float(max(np.abs(x - solved.y[0]).max(), np.abs(x1 - solved.y[1]).max() / 2))


@trial("shock_spectrum", 1e-10)
def _(draw: Random) -> float:
    """The residual of the cycloidal law in closed form."""
    n = draw.uniform(1.1, 9, 5)
    exact = 4 * math.pi * n * np.abs(np.sin(math.pi * n)) / (n * n - 1)
    return float(np.abs(gc.shock_spectrum("cycloidal", n).residual - exact).max() / exact.max())


@trial("VibratingFollower", 1e-6)
def _(draw: Random) -> float:
    """The equation of motion, with the acceleration by differences of the velocity; and it is periodic."""
    moved, speed = motion(draw), draw.uniform(200, 900)
    train = gc.FollowerTrain(0.5, draw.uniform(500, 3000), draw.uniform(0.02, 0.1), spring=20.0, preload=200.0)
    follower, omega, h = gc.VibratingFollower(moved, train, speed), 2 * math.pi * speed / 60, 1e-5
    phi = np.array([x for x in places(draw) if np.abs(np.array(moved.breaks) - x).min() > 0.01] or [0.01])
    at, around = follower(phi), [follower(phi + k * h).v for k in (-1, 1)]
    s, v, *_ = moved(phi)
    acceleration = (around[1] - around[0]) / (2 * h)
    critical = 2 * math.sqrt((train.stiffness + train.spring) * 1e3 * train.mass)
    damper = train.damping * critical * 1e-3
    inertia = train.mass * 1e-3 * omega**2 * acceleration
    left = inertia + damper * omega * (at.v - v) + train.stiffness * (at.x - s) + train.spring * at.x
    ends = follower(np.array([0.0, FULL_TURN]))
    largest = train.mass * 1e-3 * omega**2 * np.abs(follower(np.linspace(0, FULL_TURN, 500)).a).max()
    return max(float(np.abs(left).max() / largest), float(np.abs(np.diff(ends.x))[0] / moved.lift))


@trial("contact_by_elements", 2e-3)
def _(draw: Random) -> float:
    """Hertz's pressure."""
    force, width, first, second = (
        draw.uniform(200, 3000),
        draw.uniform(10, 30),
        draw.uniform(20, 60),
        draw.uniform(8, 30),
    )
    found = gc.contact_by_elements(force, width, first, second, parts=12)
    relative = 1 / first + 1 / second
    return abs(found.peak_pressure / math.sqrt(force * 206_000 / (2 * (1 - 0.09)) * relative / (math.pi * width)) - 1)


@trial("write_profile", 1.0)
def _(draw: Random) -> float:
    """The points of the file, to its digits."""
    cam = translating(draw)
    with TemporaryDirectory() as folder:
        path = gc.write_profile(cam, folder, "csv")["csv"]
        rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    angle, x, y = (np.array([float(row[name]) for row in rows]) for name in [*rows[0]][:3])
    return float(np.abs(cam.profile(np.radians(angle)) - np.column_stack([x, y])).max() / 1e-9)


@trial("motion_bands", 1e-9)
def _(draw: Random) -> float:
    cam = translating(draw)
    amplitude, waves, zone = draw.uniform(1e-5, 1e-3), int(draw.integers(1, 30)), draw.uniform(0.01, 0.2)
    found = gc.motion_bands(cam, gc.MakingErrors((amplitude,), (waves,), offset=zone)).widest[0]

    def half_width(phi):
        """A wave lifts by 1/cos(alpha), an offset by tan(alpha); the greater part of both at most their sum."""
        alpha = cam.pressure_angle(phi)
        by_wave, by_offset = amplitude / np.cos(alpha), zone / 2 * np.abs(np.tan(alpha))
        normal = 1.959963984540054 * np.sqrt(by_wave**2 / 2 + by_offset**2 / 9)
        return np.minimum(normal, by_wave + by_offset)

    return abs(found.value / highest(half_width, cam) - 1)


@trial("sweep", 1e-9)
def _(draw: Random) -> float:
    """Every design of a sweep by brute force."""
    angles = draw.uniform(1.2, 2.2, 2)
    sizes = {"lift": draw.uniform(5, 20), "prime_radius": draw.uniform(40, 80), "offset": draw.uniform(-8, 8)}
    up, down = (str(name) for name in draw.choice(["3-4-5", "cycloidal", "cosine"], 2))
    laws = {"rise_law": up, "return_law": down}
    many = gc.Designs(rise_angle=angles[0], return_angle=angles[1], roller_radius=4.0, **sizes, **laws)
    found, cam = gc.sweep(many, ["max_pressure_angle_rise"]), many.cam(0)
    top = highest(lambda phi: np.where(cam.motion(phi)[1] > 0, cam.pressure_angle(phi), 0.0), cam)
    return abs(abs(float(found["max_pressure_angle_rise"][0])) / top - 1)


@trial("profile_spline", 1.02)
def _(draw: Random) -> float:
    """No place of the profile lies farther from the spline than it says."""
    from scipy.interpolate import BSpline
    from scipy.spatial import cKDTree

    cam = translating(draw)
    spline = gc.profile_spline(cam, 0.005)
    curve = BSpline(spline.knots, np.asarray(spline.control), spline.degree)
    corners = curve(np.linspace(spline.knots[0], spline.knots[-1], 200_001))
    points = cam.profile(np.linspace(0, FULL_TURN, 2001))
    k = np.clip(cKDTree(corners).query(points)[1], 1, len(corners) - 2)
    # The nearest place lies on the chord on either side of the nearest corner.
    chords = [(corners[k - 1], corners[k]), (corners[k], corners[k + 1])]
    off = [_distance_to_chord(points, *ends) for ends in chords]
    return float(np.minimum(*off).max() / spline.deviation)


def _distance_to_chord(points, start, end):
    way = end - start
    share = np.clip(((points - start) * way).sum(axis=1) / (way**2).sum(axis=1), 0, 1)
    return np.hypot(*(points - start - share[:, None] * way).T)


@trial("solve: estimated and proved bounds", 1.0)
def _(draw: Random) -> float:
    """The drawn beside the exact values, as parts of their bounds; what does not show in print is no part."""
    sys.path.append(str(__file__).replace("adversary.py", "comparison"))
    from random_tasks import random_task

    try:
        quantities = gc.solve(random_task(int(draw.integers(10**6)))).comparison.quantities.values()
    except gc.DesignError as why:
        if why.quantity in ("minimum prime radius", "roller radius"):  # no cam has what was drawn by lot
            return 0.0
        raise
    return max(
        max(abs(q.error_paper) - 5e-4, 0.0) / q.tolerance_paper
        for q in quantities
        if math.isfinite(q.error) and math.isfinite(q.tolerance_paper)
    )


# --- the command -----------------------------------------------------------------------------------------------------


def table(trials: list[Trial]) -> Iterator[str]:
    """The lines of the table, and the seeds of the cases that failed."""
    yield f"{'function':36}{'cases':>8}{'worst error':>13}{'permitted':>11}{'wrong':>7}{'refused':>9}{'crashed':>9}"
    for each in trials:
        counts = f"{len(each.wrong):7}{len(each.refused):9}{len(each.crashed):9}"
        yield f"{each.name:36}{each.cases:8}{each.worst:13.2e}{each.permitted:11.1e}{counts}"
    for each in trials:
        for what, seeds in (("wrong", each.wrong), ("refused", each.refused), ("crashed", each.crashed)):
            if seeds:
                yield f"{each.name}, {what} with the seeds {', '.join(map(str, seeds[:20]))}"


def main(arguments: list[str] | None = None, trials: list[Trial] = TRIALS) -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, help="of each function; by default as many as the time allows")
    parser.add_argument("--seconds", type=float, default=DEFAULT_SECONDS, help="of processor")
    parser.add_argument("--seed", type=int, default=0, help="the first one")
    parser.add_argument("--only", default="", help="part of the names of the functions")
    asked = parser.parse_args(arguments)
    chosen = [each for each in trials if asked.only in each.name]
    if not chosen:
        parser.error(f"no function has {asked.only!r} in its name")
    began = time.process_time()
    for seed in count(asked.seed):
        spent = time.process_time() - began > asked.seconds
        if seed - asked.seed == asked.cases or (asked.cases is None and spent):
            break
        for each in chosen:
            each.run(seed)
    sys.stdout.writelines(f"{line}\n" for line in table(chosen))
    return int(any(each.failed for each in chosen))


if __name__ == "__main__":
    sys.exit(main())
