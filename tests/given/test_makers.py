"""Every maker of motions: what its cams, forces, profiles and files say is what the motion itself says.

The makers are phases, conditions, tables of displacements and of accelerations, laws through samples, laws of one's own
and circular arcs; many of the motions are on their way at 0 degrees.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from over_all import over_all, over_seeds
from scipy.interpolate import BSpline, KroghInterpolator
from scipy.spatial import cKDTree

import graphcam as gc
from graphcam.tasks.task_file import task_from

TURN = 2 * math.pi
PHI = np.linspace(0, TURN, 4001)
ROWS = np.radians(np.arange(0, 360, 4))
P, Poly, Spline = gc.MotionPoint, gc.PolynomialPart, gc.SplinePart
REST = {"v": 0, "a": 0}


def at(degrees: float, **given: float) -> gc.MotionPoint:
    return P(math.radians(degrees), **given)


def by_phases(rise: float, rest: float, back: float, h: float, law: str | gc.Law, turned: float = 0) -> gc.Motion:
    """A rise, dwells and a return, which begin with the last part ``turned`` [degrees] of the second dwell."""
    a, b, c = map(math.radians, (rise, rest, back))
    first = [gc.Dwell(math.radians(turned))] if turned else []
    last = TURN - a - b - c - math.radians(turned)
    return gc.Motion([*first, gc.Rise(h, a, law), gc.Dwell(b), gc.Return(h, c, law), gc.Dwell(last)])


def in_one(v: float, a: float, top: float, low: float = 250, h: float = 20) -> gc.Motion:
    """A turn of one polynomial that is halfway up at 0."""
    joint = {"s": h / 2, "v": v, "a": a}
    return gc.boundary_motion([Poly([at(0, **joint), at(top, s=h), at(low, s=0), at(360, **joint)])])


def up_and_down(low: float, rise: float, dwell: float, back: float, h: float = 20) -> gc.Motion:
    """A rise from ``low`` degrees on, a dwell and a return, each a polynomial; it may go on beyond 360 degrees."""
    top, left = low + rise, low + rise + dwell
    up = Poly([at(low, s=0, **REST), at(top, s=h, **REST)])
    return gc.boundary_motion([up, Poly([at(left, s=h, **REST), at(left + back, s=0, **REST)])])


def two_lobes(part: type[gc.PolynomialPart | gc.SplinePart], h: float) -> gc.Motion:
    low = {"s": 0, **REST}
    tops = at(90, s=h, v=0), at(270, s=h, v=0)
    return gc.boundary_motion([part([at(0, **low), tops[0], at(180, **low), tops[1], at(360, **low)])])


def from_mid_rise() -> gc.Motion:
    first, top, last = at(0, s=10, v=5, a=0), at(120, s=30, **REST), at(360, s=10, v=5, a=0)
    return gc.boundary_motion([Poly([first, top]), Poly([top, last])])


def splined(v: float) -> gc.Motion:
    inner = [at(60 * k, s=s) for k, s in enumerate((18, 16, 8, 0, 4), 1)]
    return gc.boundary_motion([Spline([at(0, s=10, v=v, a=0), *inner, at(360, s=10, v=v, a=0)])])


def measured(turned: float, law: str, noise: float = 0) -> gc.Motion:
    """A table of a motion, which begins ``turned`` degrees after the motion does."""
    table = by_phases(100, 60, 120, 20, law)(ROWS + math.radians(turned))[0]
    table = table + np.random.default_rng(4).normal(0, noise, table.size) if noise else table
    return gc.measured_motion(ROWS, table, max(0.02, 6 * noise))


def integrated(turned: float, law: str) -> gc.Motion:
    accelerations = by_phases(100, 60, 120, 20, law)(ROWS + math.radians(turned))[2]
    return gc.integrated_motion(ROWS, accelerations, 0.05)


def own_law() -> gc.Law:
    def formula(u):
        return u**2 * (3 - 2 * u), 6 * u * (1 - u), 6 - 12 * u, 0 * u - 12

    return gc.Law("my own", formula)


def sampled() -> gc.Law:
    u = np.linspace(0, 1, 15)
    return gc.sampled_law("through samples", u, u**3 * (10 - 15 * u + 6 * u**2))


MAKERS: dict[str, Callable[[], gc.Motion]] = {
    **{f"phases, {law}": lambda law=law: by_phases(95, 40, 110, 18, law) for law in gc.LAWS},
    "phases, constant velocity": lambda: by_phases(90, 50, 70, 18, "constant-velocity"),
    "phases, a dwell over 0": lambda: by_phases(90, 30, 80, 20, "3-4-5", 25),
    "phases, on its way down at 0": lambda: gc.Motion(
        [gc.Return(7, 0.9, "cosine"), gc.Rise(20, 1.7), gc.Return(13, TURN - 2.6, "cycloidal")]
    ),
    **{
        f"conditions, v = {v}, a = {a}, top at {top}": lambda v=v, a=a, top=top: in_one(v, a, top)
        for v, a, top in ((-19.5, 0, 90), (-14, 5, 90), (5, -7, 85), (14, 0, 100), (19.5, 20, 90), (0, 0, 90))
    },
    "conditions, s as far up at 180 as at 0": lambda: in_one(-17, 0, 90, 270),
    **{
        f"conditions, the rise from {low} degrees on": lambda low=low, back=back: up_and_down(low, 150, 40, back)
        for low, back in ((20, 170), (170, 120), (300, 100), (0, 120))
    },
    **{f"conditions, two lobes of {h}, {part.name}": lambda h=h, part=part: two_lobes(part, h)
       for part in (Poly, Spline) for h in (5, 10, 12.5, 30)},
    "conditions, parts that start mid-rise": from_mid_rise,
    **{f"conditions, a spline with v = {v}": lambda v=v: splined(v) for v in (8, 6.5)},
    **{f"measured from {turned} degrees on, {law}": lambda turned=turned, law=law: measured(turned, law)
       for turned, law in ((0, "3-4-5"), (30, "cycloidal"), (130, "cosine"), (200, "modified-sine"))},
    "measured with noise": lambda: measured(50, "4-5-6-7", 0.02),
    **{f"integrated from {turned} degrees on": lambda turned=turned: integrated(turned, "modified-sine")
       for turned in (0, 45, 210)},
    "a law through samples": lambda: by_phases(100, 40, 90, 20, sampled()),
    "a law of one's own": lambda: by_phases(100, 40, 90, 20, own_law(), 15),
    "a law by conditions": lambda: by_phases(
        100, 40, 90, 20, gc.boundary_law([P(0, s=0, **REST), P(0.45, s=0.5), P(1, s=1, **REST)]), 15
    ),
}  # fmt: skip


@cache
def made(name: str) -> gc.Motion:
    return MAKERS[name]()


@cache
def cam_of(name: str) -> gc.Cam:
    return gc.Cam(made(name), gc.Translating(offset=3, roller_radius=5), prime_radius=90)


def every(check: Callable[[str], None]) -> None:
    """Run a check of every maker's motion, and report all that fail."""
    failed: list[str] = []
    for name in MAKERS:
        try:
            check(name)
        except (AssertionError, ArithmeticError, LookupError, ValueError) as error:
            failed.append(f"{name}: {type(error).__name__} {str(error).strip()[:300]}")
    assert not failed, "\n".join(failed)


def test_phases_starts_and_levels_are_those_of_the_motion():
    def check(name: str) -> None:
        motion = made(name)
        ends = np.append(motion.starts, TURN)
        assert ends[0] == 0
        assert ends.size == len(motion.phases) + 1 == motion.levels.size
        assert_allclose(np.diff(ends), motion.angles, atol=1.01e-9, rtol=0)
        assert np.isin(motion.starts, motion.breaks).all()
        assert np.diff(motion.breaks, append=TURN).min() > 1e-10  # no slivers
        assert motion.levels.min() == 0
        assert_allclose(motion(ends, "left")[0], motion.levels, atol=1e-8 * motion.lift)
        rises = np.diff(motion.levels)
        assert_allclose(rises, [p.direction * p.lift for p in motion.phases], atol=1e-8 * motion.lift)

    every(check)


def test_within_every_phase_s_v_a_and_j_are_those_at_the_cam_angle():
    def check(name: str) -> None:
        motion = made(name)
        phi = np.setdiff1d(PHI[1:-1], motion.breaks)
        phase = motion.starts.searchsorted(phi, "right") - 1
        in_phase = motion.at(phase, (phi - motion.starts[phase]) / motion.angles[phase])
        far = np.abs(phi[:, None] - motion.breaks).min(axis=1) > 1e-6
        for here, there in zip(motion(phi), in_phase, strict=True):
            assert_allclose(here[far], there[far], atol=1e-6 * float(np.abs(here).max()), rtol=0)
        for phase, direction in enumerate(motion.directions):
            v = motion.at(phase, np.linspace(0, 1, 201))[1]
            off = v if direction == 0 else np.minimum(direction * v, 0)
            assert np.abs(off).max() <= 1e-9 * motion.lift

    every(check)


def test_the_extremes_of_a_cam_are_those_of_its_dense_stations():
    def check(name: str) -> None:
        cam = cam_of(name)
        extremes, alpha, v = cam.extremes(), np.abs(cam.pressure_angle(PHI)), cam.motion(PHI)[1]
        for (angle, phi), way in ((extremes.pressure_angle_rise, 1), (extremes.pressure_angle_return, -1)):
            dense = alpha[way * v > 1e-9].max()
            assert dense - 1e-9 <= abs(angle) <= dense + 2e-4
            assert abs(abs(cam.at(phi).pressure_angle) - abs(angle)) < 1e-6
        assert cam.undercuts() == []

    every(check)


def test_the_written_profile_is_that_of_the_cam(tmp_path):
    def check(name: str) -> None:
        cam = cam_of(name)
        phi = np.linspace(0, TURN, 20_001)
        nearest = cKDTree(cam.profile(phi))
        apart = 1.1 * float(np.abs(np.diff(phi)[0] * (90 + cam.motion.lift)))
        spline = gc.profile_spline(cam)
        drawn = BSpline(spline.knots, np.asarray(spline.control), spline.degree)(np.linspace(0, spline.knots[-1], 3001))
        assert nearest.query(drawn)[0].max() < apart / 2 + spline.deviation + 1e-3
        rows = np.loadtxt(gc.write_profile(cam, tmp_path, ["csv"])["csv"], delimiter=",", skiprows=1)
        # Cam angle 0 of the file is that of the given table or conditions.
        zero = getattr(cam.motion, "zero", 0.0)
        turned = (cam.profile(np.radians(rows[:, 0]) - zero) @ (1, 1j)) * np.exp(-1j * cam.kinematics.sigma * zero)
        assert_allclose(rows[:, 1:3] @ (1, 1j), turned, atol=1e-3)

    every(check)


def test_the_load_on_a_follower_is_mass_spring_preload_and_friction_against_its_velocity():
    def check(name: str) -> None:
        motion = made(name)
        load = gc.SpringLoad(0.5, 300, 4, preload=100, friction=20)
        forces = gc.CamForces(cam_of(name), load)
        phi = np.setdiff1d(np.linspace(0.011, TURN - 0.01, 97), motion.breaks)
        s, v, a, _ = motion(phi)
        moving = np.abs(v) > 1e-6 * motion.lift
        expected = load.mass / 1000 * a * load.omega**2 + 100 + 4 * s + 20 * np.sign(v)
        assert_allclose(forces.at(phi).load[moving], expected[moving], rtol=1e-9)

    every(check)


TABLES = {
    "conditions, the rise from 20 degrees on": """
        { kind = "polynomial", points = [{ angle = 20, s = 0, v = 0, a = 0 }, { angle = 170, s = 20, v = 0, a = 0 }] },
        { kind = "polynomial", points = [{ angle = 210, s = 20, v = 0, a = 0 }, { angle = 380, s = 0, v = 0, a = 0 }] },
    """,
    "conditions, parts that start mid-rise": """
        { kind = "polynomial", points = [{ angle = 0, s = 10, v = 5, a = 0 }, { angle = 120, s = 30, v = 0, a = 0 }]},
        { kind = "polynomial", points = [{ angle = 120, s = 30, v = 0, a = 0 }, { angle = 360, s = 10, v = 5, a = 0 }]},
    """,
}


@over_all("name", TABLES)
def test_a_task_whose_motion_moves_at_0_is_solved(name):
    text = f'rotation = "ccw"\n[motion]\nparts = [{TABLES[name]}]\n[follower]\nkind = "translating"'
    solution = gc.solve(task_from(tomllib.loads(text)))
    assert_allclose(solution.cam.motion(PHI)[0], made(name)(PHI)[0], atol=1e-9)
    assert_allclose(solution.cam.motion.starts, made(name).starts, atol=1e-9)


def test_on_three_arcs_v_a_and_j_are_the_derivatives_of_s():
    cam, _ = gc.three_arc_cam(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40))
    motion = cam.motion(roller_radius=10, dwell=math.radians(40))
    phi = np.arange(0.003, TURN, 0.01)
    near = np.array([motion(phi + step) for step in (-1e-5, 1e-5)])
    smooth = np.abs(near[1, 3] - near[0, 3]) < 1e-2 * np.abs(near[:, 3]).max()
    for order in range(3):
        difference = (near[1, order] - near[0, order]) / 2e-5
        expected = np.asarray(motion(phi)[order + 1])
        assert_allclose(difference[smooth], expected[smooth], atol=1e-4 * float(np.abs(expected).max()))
    assert smooth.mean() > 0.95


# --- tables of accelerations that no smooth motion has ----------------------------------------------------------------


def motion_through(seed: int) -> bool:
    """Whether a motion is found through accelerations with noise, or in steps; what is refused is told."""
    random = np.random.default_rng([9, seed])
    step = int(random.choice([1, 2, 5]))
    phi = np.radians(np.arange(0, 360, step))
    motion = by_phases(100, 60, 120, 20, str(random.choice(["modified-trapezoidal", "rectangular", "cosine"])))
    a = motion(phi)[2]
    size = float(np.abs(a).max())
    if seed % 2:
        unit = size / float(random.choice([1, 2, 4, 8]))
        a = np.round(a / unit) * unit
    else:
        a = a + random.normal(0, 0.05 * size, a.size)
    try:
        found = gc.integrated_motion(phi, a, float(random.choice([0.01, 0.05, 0.1, 1, 5])))
    except gc.DesignError:
        return False
    assert found.max_residual <= found.tolerance
    assert_allclose(np.diff(found.starts, append=TURN), found.angles, atol=1.01e-9, rtol=0)
    return True


def test_tables_of_accelerations_with_noise_and_in_steps_give_a_motion_or_a_message():
    assert sum(motion_through(seed) for seed in range(12)) > 3


@pytest.mark.slow
@over_seeds(8)
def test_any_table_of_accelerations_gives_a_motion_or_a_message(seed):
    motion_through(seed)


@over_all(("seed", "tolerance"), [(118, 0.05), (137, 0.1)])
def test_where_no_row_is_near_the_median_the_motion_does_not_rest(seed, tolerance):
    motion = gc.Motion(
        [
            gc.Rise(20, math.radians(100), "modified-trapezoidal"), gc.Dwell(math.radians(60)),
            gc.Return(20, math.radians(120), "modified-trapezoidal"), gc.Dwell(math.radians(80)),
        ]
    )  # fmt: skip
    phi = np.radians(np.arange(0, 360, 1))
    a = motion(phi)[2]
    a = a + np.random.default_rng(seed).normal(0, 0.05 * np.abs(a).max(), a.size)
    found = gc.integrated_motion(phi, a, tolerance)
    assert found.max_residual <= tolerance
    assert found.lift == pytest.approx(20, rel=0.2)


# --- answers that do not depend on the scale --------------------------------------------------------------------------


def in_thirds(h: float) -> list[gc.MotionPoint]:
    low, middle = {"s": 0, "v": 0, "a": 0}, 0.75 * h
    return [at(0, **low), at(50, s=0.25 * h), at(100, s=middle), at(180, s=middle, v=0), at(360, **low)]


@over_all("h", range(1, 61))
def test_a_turning_at_a_point_is_at_it_for_every_lift(h):
    turnings = np.degrees(Poly(in_thirds(h)).polynomials.turnings()).tolist()
    assert turnings == pytest.approx([127.172373, 180.0, 252.74261], abs=1e-6)


@over_all("h", [5, 10, 12.5, 20, 30, 1e-30, 1e30])
def test_two_lobes_by_one_polynomial_are_those_of_scipy(h):
    motion = two_lobes(Poly, h)
    x = np.radians([0, 0, 0, 90, 90, 180, 180, 180, 270, 270, 360, 360, 360])
    y = np.array([0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0]) * float(h)
    reference = KroghInterpolator(x, y)
    begun = PHI[:-1] + motion.zero
    for order, values in enumerate(motion(PHI[:-1])):
        expected = reference.derivative(begun, order) if order else reference(begun) - motion.lowest
        assert_allclose(values, expected, atol=1e-8 * float(np.abs(expected).max()), rtol=0)


@over_all("v", range(-20, 21))
def test_a_motion_as_high_at_180_degrees_as_at_0_closes(v):
    motion = in_one(v, 0, 90, 270)
    assert motion(-motion.zero)[0] + motion.lowest == pytest.approx(10)


def shape(seed: int, h: float) -> list[gc.MotionPoint]:
    """Random conditions: s, v, a in units of h, some of them in a row at one level."""
    random = np.random.default_rng([35, seed])
    degrees = np.cumsum(random.integers(3, 9, int(random.integers(3, 6)))) * 15.0
    degrees *= 360 // degrees[-1]
    levels = np.round(random.random(degrees.size - 1) * 4) / 4
    joint = {"s": round(float(random.random()), 2) * h, "v": int(random.integers(-2, 3)) * h / 10, "a": 0}
    inner = [
        at(angle, s=level * h, **({"v": 0} if flat else {}))
        for angle, level, flat in zip(degrees, levels, random.random(levels.size) < 0.5, strict=False)
    ]
    return [at(0, **joint), *inner, at(360, **joint)]


def answer(points: list[gc.MotionPoint], h: float) -> tuple[object, ...]:
    """What is answered about conditions: the phases in units of h, or what is refused."""
    try:
        motion = gc.boundary_motion([Poly(points)])
    except gc.DesignError as error:
        return ("refused", str(error.quantity))
    return (
        *((phase.kind, round(phase.angle, 7), round(phase.lift / h, 7)) for phase in motion.phases),
        round(motion.zero, 7),
        round(motion.lowest / h, 7),
    )


def check_scales(seed: int, lifts: list[float]) -> None:
    answers = {answer(shape(seed, h), h) for h in lifts}
    assert len(answers) == 1, answers


@over_seeds(10)
def test_the_answer_does_not_depend_on_the_lift(seed):
    check_scales(seed, [1.0, 3.0, 12.5, 60.0])


@pytest.mark.slow
@over_seeds(2)
def test_the_answer_does_not_depend_on_any_of_sixty_lifts(seed):
    check_scales(seed, [float(h) for h in range(1, 61)])
