"""The extremes of a cam are those that interval arithmetic proves, and enclosures hold what they enclose."""

from __future__ import annotations

import math

import numpy as np
import pytest
from intervals import Sum, backwards, greatest, law_of, law_of_polynomials, quantities
from mpmath import atan, mpf
from over_all import over_all, over_seeds

import graphcam as gc
from graphcam.given.laws import LAWS, RISE_FALL_LAWS
from graphcam.given.monotone_spline import MEASURED_LAW
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise

CLOSE = 1e-13
"""Of what the exact side tells; its own rounding is some 1e-15."""


def laws_of(motion: Motion, own: dict[str, list[Sum]] | None = None) -> list[list[Sum]]:
    def pieces(phase) -> list[Sum]:
        if isinstance(phase, Dwell):
            return []
        here = phase.normalised
        if own and here.name in own:
            return own[here.name]
        if here.name in RISE_FALL_LAWS and phase.direction < 0:
            return backwards(law_of(here.name))
        return law_of_polynomials(here) if here.name == MEASURED_LAW else law_of(here.name, here.middle)

    return [pieces(phase) for phase in motion.phases]


def check(cam: gc.Cam, own: dict[str, list[Sum]] | None = None) -> None:
    """What is told of a cam is what is proved of it."""
    laws, extremes = laws_of(cam.motion, own), cam.extremes()
    tangent, curvature = quantities(cam)
    flat = isinstance(cam.follower, gc.FlatFaced)
    for direction, (alpha, phi) in ((1, extremes.pressure_angle_rise), (-1, extremes.pressure_angle_return)):
        proved = 0 if flat else atan(greatest(cam, laws, tangent, direction, signed=True))
        assert abs(alpha) == pytest.approx(float(proved), rel=CLOSE, abs=CLOSE)
        if not flat:
            assert float(cam.pressure_angle(phi)) == pytest.approx(alpha, abs=1e-9)
    sharpest = max(greatest(cam, laws, curvature, direction, signed=False) for direction in (1, -1))
    told, _ = extremes.min_convex_radius_moving
    if flat:
        assert told == pytest.approx(float(-sharpest), rel=CLOSE, abs=CLOSE * cam.prime_radius)
    else:
        assert told == pytest.approx(float(1 / sharpest) if sharpest > 0 else math.inf, rel=CLOSE)


def random_follower(
    rng: np.random.Generator, kind: int
) -> tuple[gc.Translating | gc.Oscillating | gc.FlatFaced, float]:
    """One of the three, and its prime radius."""
    r0 = float(rng.uniform(20, 80))
    if kind == 1:
        arm = float(rng.uniform(60, 150))
        return gc.Oscillating(arm, float(arm + rng.uniform(-0.4, 0.7) * r0)), r0
    return gc.FlatFaced() if kind == 2 else gc.Translating(float(rng.uniform(-0.8, 0.8) * r0)), r0


def random_cam(seed: int) -> gc.Cam:
    """All laws, ratios and followers; lifts from a tenth of the prime radius to twice it; phases from 9 degrees on."""
    rng = np.random.default_rng(seed)
    follower, r0 = random_follower(rng, seed % 3)
    lift = float(r0 * 10 ** rng.uniform(-1, 0.3)) / (follower.arm * 3 if seed % 3 == 1 else 1)
    angles = FULL_TURN * rng.dirichlet([1.0] * 4) * 0.9 + 0.05 * FULL_TURN / 2
    angles[3] = FULL_TURN - math.fsum(angles[:3])
    names = [str(name) for name in rng.choice(LAWS, 2)]
    ratios = [float(10 ** rng.uniform(-3, 3)) if name == "rectangular" else 1.0 for name in names]
    rise, back = Rise(lift, angles[0], names[0], ratios[0]), Return(lift, angles[2], names[1], ratios[1])
    motion = Motion([rise, Dwell(angles[1]), back, Dwell(angles[3])])
    return gc.Cam(motion, follower, r0, ("ccw", "cw")[int(rng.integers(2))])


def measured_cam(seed: int) -> gc.Cam:
    """A cam whose motion is a spline through a table."""
    rng = np.random.default_rng(seed)
    follower, r0 = random_follower(rng, 2 * (seed % 2))
    name, back = (str(name) for name in rng.choice(["3-4-5", "cycloidal", "cosine", "modified-sine"], 2))
    source = Motion([Rise(20, 2.0, name), Dwell(0.8), Return(20, 1.7, back), Dwell(FULL_TURN - 4.5)])
    phi = np.radians(np.arange(0, 360, 3.0))
    return gc.Cam(gc.measured_motion(phi, source(phi)[0], 0.02), follower, r0)


@over_seeds(3)
def test_no_value_exceeds_the_extremes_of_random_cams(seed):
    check(random_cam(seed))


def test_no_value_exceeds_the_extremes_of_a_measured_motion():
    check(measured_cam(1))


@pytest.mark.slow
@over_seeds(4)
def test_no_value_exceeds_the_extremes_of_measured_motions(seed):
    check(measured_cam(seed))


# --- cams that are made to hide an extreme ---------------------------------------------------------------------------


def waving_law(waves: int, height: float) -> tuple[gc.Law, list[Sum]]:
    """The cycloidal law with so many waves on it: u - sin(2 pi u)/(2 pi) + height sin^4(pi u) sin(2 pi waves u)."""
    # sin^4 x = 3/8 - cos(2x)/2 + cos(4x)/8, and each product of a cosine and a sine is a sum of two sines.
    parts = [(0, 3 / 8), (1, -1 / 4), (-1, -1 / 4), (2, 1 / 16), (-2, 1 / 16)]
    sines = [(-1 / (2 * math.pi), 2 * math.pi), *((height * c, 2 * math.pi * (waves + n)) for n, c in parts)]

    def formula(u):
        terms = [(a, k, np.sin(k * u), np.cos(k * u)) for a, k in sines]
        return (
            u + sum(a * s for a, _, s, _ in terms), 1 + sum(a * k * c for a, k, _, c in terms),
            -sum(a * k**2 * s for a, k, s, _ in terms), -sum(a * k**3 * c for a, k, _, c in terms),
        )  # fmt: skip

    name = f"{waves} waves"
    exact = Sum(mpf(1), (0, 1), tuple((mpf(a), mpf(k), mpf(0)) for a, k in sines))
    return gc.Law(name, formula, trusted=True), [exact]  # it waves too fast for the check of laws


@over_all(("waves", "height"), [(60, 2e-6), (300, 3e-8)])
def test_waves_much_shorter_than_any_step_of_a_search_hide_no_extreme(waves, height):
    own, exact = waving_law(waves, height)
    motion = Motion([Rise(20, 2.0, own), Dwell(0.5), Return(20, 1.5, own), Dwell(FULL_TURN - 4.0)])
    cam = gc.Cam(motion, gc.Translating(4.0, 5.0), 45.0)
    phase, u = np.meshgrid([0, 2], np.linspace(0, 1, 40_001), indexing="ij")
    at, extremes = cam.at(phase, u), cam.extremes()
    assert extremes.pressure_angle_rise[0] >= np.abs(at.pressure_angle[0]).max()
    assert abs(extremes.pressure_angle_return[0]) >= np.abs(at.pressure_angle[1]).max()
    assert 1 / extremes.min_convex_radius_moving[0] >= at.curvature.max()
    if waves < 100:
        check(cam, {own.name: exact})


@over_all(("first", "second"), [(1e-3, 1e3), (1e3, 1e3), (1e-3, 1e-3)])
def test_lopsided_laws_hide_no_extreme(first, second):
    rise, back = Rise(12, 1.4, "rectangular", first), Return(12, 1.1, "rectangular", second)
    check(gc.Cam(Motion([rise, Dwell(0.6), back, Dwell(FULL_TURN - 3.1)]), gc.Translating(-3.0, 5.0), 30.0))


def test_tiny_phases_hide_no_extreme():
    phases = [Rise(1e-3, 1e-3, "4-5-6-7"), Dwell(1.0), Return(1e-3, 2e-3, "cycloidal"), Rise(9.0, 2.0, "modified-sine")]
    phases += [Return(9.0, FULL_TURN - 3.003, "3-4-5")]
    check(gc.Cam(Motion(phases), gc.Translating(2.0, 5.0), 40.0))


def test_of_two_nearly_equal_pressure_angles_the_greater_is_told():
    """At the low rest an offset gives the rise an angle of the other sign, here of the same size to 1e-12."""
    motion = Motion([Rise(20, 2.0), Dwell(0.5), Return(20, 2.0), Dwell(FULL_TURN - 4.5)])
    low, high = 0.0, 39.0
    for _ in range(60):
        offset = (low + high) / 2
        cam = gc.Cam(motion, gc.Translating(offset), 40.0)
        low, high = (offset, high) if cam.extremes().pressure_angle_rise[0] > 0 else (low, offset)
    for near in (offset * (1 - 1e-12), offset * (1 + 1e-12)):
        cam = gc.Cam(motion, gc.Translating(near), 40.0)
        check(cam)
    assert [
        gc.Cam(motion, gc.Translating(offset * k), 40.0).extremes().pressure_angle_rise[0] > 0
        for k in (1 - 1e-12, 1 + 1e-12)
    ] == [True, False]


def test_an_eccentric_under_a_flat_face_is_a_circle():
    """Its radius of curvature is the same all over: nothing stands out, and nothing is divided without end."""
    motion = Motion([Rise(10, math.pi, "cosine"), Return(10, math.pi, "cosine")])
    radius, phi = gc.Cam(motion, gc.FlatFaced(), 30.0).extremes().min_convex_radius
    assert (radius, phi) == (pytest.approx(35.0, rel=1e-15), 0.0)
