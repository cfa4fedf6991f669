"""Laws that a user writes: a smooth one, one whose acceleration jumps, one through samples, one of several swings.

What follows from them is held against dense sampling, which knows nothing of breaks, tangents or peaks.
"""

from __future__ import annotations

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from over_all import fast_first, over_all
from scipy.optimize import brentq, minimize_scalar

import graphcam as gc
from graphcam.constructions.law_names import law_name
from graphcam.mechanism.least_radius_lines import steepest_tangent
from graphcam.mechanism.turn_extremes import max_acceleration, max_velocity
from graphcam.report.documents import note_of, sheet_of
from graphcam.report.output_folder import write
from graphcam.tasks.motion_tables import DwellTable, MotionTable, ReturnTable, RiseTable
from graphcam.tasks.task_writer import task_files

PI = math.pi
AS_SAMPLED = 1e-8
"""What dense sampling misses of a greatest value."""
M = 0.35
"""Where the acceleration of the law with a jump changes its sign."""
DENSE = np.sort(np.append(np.linspace(0, 1, 100_001), [M, 1 - M]))


def smooth(u):
    p = u * (1 - u)
    f = u**5 * (126 - 420 * u + 540 * u**2 - 315 * u**3 + 70 * u**4)
    return f, 630 * p**4, 2520 * p**3 * (1 - 2 * u), 2520 * p**2 * (3 - 14 * p)


def speeding_up(u):
    return u**2 / M, 2 * u / M, 2 / M, 0


def slowing_down(u):
    n = 1 - M
    w = (1 - u) / n
    return 1 - n * w**3 * (2 - w), 2 * w**2 * (3 - 2 * w), -12 * w * (1 - w) / n, 12 * (1 - 2 * w) / n**2


def swings(u):
    """f' = (1 - cos 2 pi u)(1 + 0.8 cos 6 pi u): it speeds up four times."""
    waves = ((1.0, 0.0), (-1.0, 2 * PI), (0.8, 6 * PI), (-0.4, 8 * PI), (-0.4, 4 * PI))
    f = sum(a * (np.sin(k * u) / k if k else u) for a, k in waves)
    return f, *(sum(a * k**n * np.cos(k * u + n * PI / 2) for a, k in waves) for n in range(3))


def sampled() -> gc.Law:
    u = np.linspace(0, 1, 31)
    return gc.sampled_law(
        "my samples", u, u**3 * (10 - 15 * u + 6 * u**2) + 0.02 * np.sin(PI * u) ** 3 * np.cos(PI * u)
    )


LAWS = {
    "smooth": gc.Law("5-6-7-8-9", smooth),
    "jump": gc.Law("sudden", [speeding_up, slowing_down], [M]),
    "samples": sampled(),
    "swings": gc.Law("swings", swings),
}
every_law = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)


def motion_of(law: str | gc.Law, lift: float = 30.0) -> gc.Motion:
    return gc.Motion([gc.Rise(lift, 1.5, law), gc.Dwell(0.6), gc.Return(lift, 1.9, law), gc.Dwell(2 * PI - 4.0)])


def densely(motion: gc.Motion, phase: int) -> tuple[np.ndarray, ...]:
    """(s, v, a) of a phase, at a jump from both sides."""
    both = [motion.at(phase, DENSE, side) for side in ("left", "right")]
    return tuple(np.concatenate(columns) for columns in zip(*both, strict=True))[:3]


# --- the laws themselves ---------------------------------------------------------------------------------------------


@every_law
def test_the_derivatives_are_one_another_s(law):
    """By central differences, but for where they would reach over a break."""
    h = 1e-5
    u = np.linspace(0.01, 0.99, 997)
    u = u[np.min(np.abs(u - np.array([*law.breaks, 2.0])[:, None]), axis=0) > h]
    for order, values in enumerate(law(u)[1:]):
        difference = (law(u + h)[order] - law(u - h)[order]) / (2 * h)
        np.testing.assert_allclose(values, difference, atol=1e-6 * np.abs(law(DENSE)[order + 1]).max())


@every_law
def test_peaks_and_jumps_are_found(law):
    _, f1, f2, _ = law(np.sort(np.append(DENSE, law.breaks)))
    assert law.peak_velocity == pytest.approx(f1.max(), rel=AS_SAMPLED)
    assert law.peak_acceleration == pytest.approx(np.abs(f2).max(), rel=1e-7)
    assert law.jumps == ((M,) if law is LAWS["jump"] else ())
    assert law.corners == ()
    assert str(law_name(law)) == law.name


def test_the_peaks_of_a_polynomial_are_found_to_the_last_digits():
    assert LAWS["smooth"].peak_velocity == 315 / 128
    assert LAWS["smooth"].peak_acceleration == pytest.approx(1215 / (49 * math.sqrt(7)), rel=4e-16)


def test_a_jump_is_seen_from_both_sides():
    law = LAWS["jump"]
    assert [float(law(M, side=side)[2]) for side in ("left", "right")] == [2 / M, 0.0]
    motion = motion_of(law)
    assert motion(motion.breaks, "left")[2] != pytest.approx(motion(motion.breaks)[2])


@every_law
def test_backwards_it_is_the_same_law(law):
    u = np.linspace(0, 1, 401)
    f, f1, f2, f3 = law(1 - u, side="left")
    for values, expected in zip(law.reversed(u), (1 - f, f1, -f2, f3), strict=True):
        np.testing.assert_allclose(values, expected, atol=1e-11 * max(1.0, np.abs(expected).max()))


def test_samples_are_met_and_what_is_between_them_comes_near_their_law():
    u = np.linspace(0, 1, 41)
    law = gc.sampled_law("seven", u, u**4 * (35 - 84 * u + 70 * u**2 - 20 * u**3))
    exact = gc.law("4-5-6-7")
    np.testing.assert_allclose(law(u)[0], exact(u)[0], atol=1e-15)
    for off, found, known in zip((1e-8, 1e-6, 1e-4, 2e-2), law(DENSE), exact(DENSE), strict=True):
        np.testing.assert_allclose(found, known, atol=off * np.abs(known).max())
    near = law([1e-12, 1 - 1e-12])
    assert 0 < near[0][0] < 1e-30  # no rounding where the lift has just begun
    assert (near[1] < 1e-20).all()


def test_a_mirrored_law_keeps_its_digits_to_the_end():
    law = gc.Law("5-6-7-8-9", smooth, mirrored=True)
    motion = motion_of(law)
    for w in (2.0**-20, 2.0**-40):
        s, v, *_ = (float(x) for x in motion.at(2, 1 - w))
        f, f1, *_ = smooth(w)
        assert (s / 30, -v * 1.9 / 30) == (pytest.approx(f, rel=1e-14), pytest.approx(f1, rel=1e-14))


@every_law
def test_it_travels_to_other_processes(law):
    motion = motion_of(law)
    again = pickle.loads(pickle.dumps(motion))
    assert [x.tobytes() for x in again(DENSE)] == [x.tobytes() for x in motion(DENSE)]


# --- the exact side --------------------------------------------------------------------------------------------------


@every_law
@pytest.mark.parametrize("k", [0.02, 0.3, 2.0, 1e5])
def test_the_steepest_tangent_is_found(law, k):
    """For a law that speeds up several times the highest of several."""
    for seen in (law, law.reversed):
        f, f1 = seen(DENSE, 1)
        u, height = steepest_tangent(seen, k)
        assert height == pytest.approx((f1 - f / k).max(), rel=1e-7)
        f, f1 = seen(u, 1)
        assert height == pytest.approx(float(f1 - f / k), rel=1e-12)


@over_all("k", [1e-15, 1e-9, 1e-4])
def test_the_steepest_tangent_of_a_steep_limit_lies_near_the_start(k):
    """A law that begins as c u^n has it at (n - 1) k."""
    for law, n, c in ((LAWS["smooth"], 5, 126.0), (LAWS["jump"], 2, 1 / M)):
        u, height = steepest_tangent(law, k)
        assert u == pytest.approx((n - 1) * k, rel=10 * n * k + 1e-12)
        assert height == pytest.approx(c * u ** (n - 1), rel=10 * n * k + 1e-9)


@every_law
@pytest.mark.parametrize("back", [None, 0.7])
def test_the_least_radius_of_a_translating_follower(law, back):
    motion, rise = motion_of(law), 0.55
    s, v, _ = densely(motion, 0)
    lines = [(1, np.tan(rise), np.max(v - s * np.tan(rise))), (-1, np.tan(rise), 0.0)]
    if back:
        s, v, _ = densely(motion, 2)
        lines.append((-1, np.tan(back), np.max(-v - s * np.tan(back))))

    def radius(e: float) -> float:
        return math.hypot(e, max(0.0, *((height - side * e) / slope for side, slope, height in lines)))

    fixed = gc.minimum_radius(motion, gc.Translating(), rise=rise, return_=back, offset=7.0)
    assert fixed.prime_radius == pytest.approx(radius(7.0), rel=AS_SAMPLED)
    free = gc.minimum_radius(motion, gc.Translating(), rise=rise, return_=back)
    best = minimize_scalar(radius, bounds=(-100, 100), method="bounded", options={"xatol": 1e-9})
    assert free.prime_radius == pytest.approx(best.fun, rel=1e-7)
    assert radius(free.offset) == pytest.approx(free.prime_radius, rel=AS_SAMPLED)


@every_law
def test_the_least_radius_of_an_arm(law):
    motion, limit, arm = motion_of(law, lift=0.4), 0.8, 80.0

    def beyond(r0: float, distance: float) -> float:
        """How far the pressure angle passes the limit."""
        cam = gc.Cam(motion, gc.Oscillating(arm, distance), r0)
        return (
            max(np.abs(cam.at(k, DENSE[::10], side).pressure_angle).max() for k in (0, 2) for side in ("left", "right"))
            - limit
        )

    free = gc.minimum_radius(motion, gc.Oscillating(arm), rise=limit, return_=limit)
    assert beyond(free.prime_radius, free.distance) == pytest.approx(0, abs=1e-7)
    for distance in (free.distance, 0.99 * free.distance, 1.01 * free.distance):
        fixed = gc.minimum_radius(motion, gc.Oscillating(arm, distance), rise=limit, return_=limit).prime_radius
        assert fixed >= free.prime_radius * (1 - 1e-12)
        exact = brentq(beyond, 0.97 * fixed, 1.03 * fixed, args=(distance,))
        assert fixed == pytest.approx(exact, rel=1e-6)


@every_law
def test_the_least_radius_under_a_flat_face(law):
    motion = motion_of(law)
    lowest = min(np.min(s + a) for s, _, a in (densely(motion, 0), densely(motion, 2)))
    least = gc.minimum_radius(motion, gc.FlatFaced(), curvature=8.0)
    assert least.prime_radius == pytest.approx(8 - lowest, rel=1e-7)


@every_law
@pytest.mark.parametrize("follower", [gc.Translating(6.0, 5.0), gc.Oscillating(90.0, 100.0, 5.0), gc.FlatFaced()])
def test_the_extremes_of_a_cam_are_those_of_dense_sampling(law, follower):
    arm, flat = isinstance(follower, gc.Oscillating), isinstance(follower, gc.FlatFaced)
    cam = gc.Cam(motion_of(law, 0.35 if arm else 30.0), follower, 150.0 if flat else 55.0)
    found = cam.extremes()
    for name, phase in (("pressure_angle_rise", 0), ("pressure_angle_return", 2)):
        alpha = np.concatenate([cam.at(phase, DENSE, side).pressure_angle for side in ("left", "right")])
        expected = alpha[np.argmax(np.abs(alpha))]
        assert getattr(found, name)[0] == pytest.approx(expected, rel=1e-7, abs=1e-12)
    if flat:
        least = min(np.min(150 + s + a) for s, _, a in (densely(cam.motion, 0), densely(cam.motion, 2)))
    else:
        least = 1 / max(cam.at(k, DENSE, side).curvature.max() for k in (0, 2) for side in ("left", "right"))
    assert found.min_convex_radius_moving[0] == pytest.approx(least, rel=1e-6)


def test_a_sweep_takes_laws_of_one_s_own_beside_names():
    laws = np.array([*LAWS.values(), "cycloidal", *LAWS.values(), "2-3"], dtype=object)
    sizes = {"lift": np.linspace(20, 40, laws.size), "rise_angle": 1.5, "return_angle": 1.9, "dwell_angle": 0.6}
    designs = gc.Designs(**sizes, prime_radius=55, offset=6, roller_radius=5, rise_law=laws, return_law=laws[::-1])
    found = gc.sweep(designs, chunk=3)
    for k in range(len(designs)):
        cam = designs.cam(k)
        extremes = cam.extremes()
        assert cam.motion.phases[0].law == laws[k]
        assert found["max_pressure_angle_rise"][k] == pytest.approx(extremes.pressure_angle_rise[0], rel=1e-12)
        assert found["max_pressure_angle_return"][k] == pytest.approx(extremes.pressure_angle_return[0], rel=1e-12)
        assert found["min_pitch_curvature_radius"][k] == pytest.approx(extremes.min_convex_radius[0], rel=1e-12)
        assert found["max_v"][k] == pytest.approx(max_velocity(cam.motion), rel=1e-15)
        assert found["max_a"][k] == pytest.approx(max_acceleration(cam.motion), rel=1e-15)
    one = gc.sweep(gc.Designs(30, 1.5, 1.9, [50, 60], dwell_angle=0.6, rise_law=LAWS["jump"]), ["max_a"])
    assert one["max_a"].tolist() == [30 * (2 / M) / 1.5**2] * 2


PLAIN = {
    "cosine": lambda u: (
        (1 - np.cos(PI * u)) / 2, PI / 2 * np.sin(PI * u), PI**2 / 2 * np.cos(PI * u), -(PI**3) / 2 * np.sin(PI * u),
    ),
    "cycloidal": lambda u: (
        u - np.sin(2 * PI * u) / (2 * PI), 1 - np.cos(2 * PI * u), 2 * PI * np.sin(2 * PI * u),
        4 * PI**2 * np.cos(2 * PI * u),
    ),
    "2-3": lambda u: (3 * u**2 - 2 * u**3, 6 * u - 6 * u**2, 6 - 12 * u, -12),
    "3-4-5": lambda u: (
        10 * u**3 - 15 * u**4 + 6 * u**5, 30 * u**2 - 60 * u**3 + 30 * u**4, 60 * u - 180 * u**2 + 120 * u**3,
        60 - 360 * u + 360 * u**2,
    ),
}  # fmt: skip


@over_all("name", PLAIN)
@over_all("limit", [0.2, 0.5, 1.2])
def test_a_built_in_law_written_plainly_has_the_least_radius_of_its_closed_form(name, limit):
    built_in, own = motion_of(name), motion_of(gc.Law("plain", PLAIN[name]))
    for offset in (None, 5.0):
        radii = [
            gc.minimum_radius(motion, gc.Translating(), rise=limit, return_=limit, offset=offset).prime_radius
            for motion in (built_in, own)
        ]
        assert radii[0] == pytest.approx(radii[1], rel=1e-12)


def test_the_rectangular_law_written_plainly_has_it_too():
    own = gc.Law(
        "plain",
        [lambda u: (u**2 / 0.4, 2 * u / 0.4, 5, 0), lambda u: (1 - (1 - u) ** 2 / 0.6, 2 * (1 - u) / 0.6, -2 / 0.6, 0)],
        [0.4],
    )
    for limit in (0.2, 0.5, 1.2):
        for seen, closed in ((own, gc.law("rectangular", 1.5)), (own.reversed, gc.law("rectangular", 1.5).reversed)):
            k = 1 / (math.tan(limit) * 1.5)
            assert steepest_tangent(seen, k) == pytest.approx(steepest_tangent(closed, k), rel=1e-12)


# --- the drawn side --------------------------------------------------------------------------------------------------


def task_of(law: gc.Law, divisions: int) -> gc.Task:
    phases = (RiseTable(120, 30, law), DwellTable(30), ReturnTable(110, 30, law), DwellTable(100))
    task = gc.builtin_task()
    return replace(task, motion=MotionTable(phases), drawing=replace(task.drawing, divisions=divisions))


@every_law
def test_the_drawn_chain_comes_nearer_to_the_exact_cam(law):
    """Eight times the parts leave less than a twentieth of the error: the order is two or more."""
    errors = []
    for divisions in (24, 192):
        quantities = gc.solve(task_of(law, divisions)).to_dict()["quantities"]
        errors.append(
            [abs(quantities[name]["error"]) / quantities[name]["exact"] for name in ("max_v", "minimum_prime_radius")]
        )
    assert np.all((np.array(errors[1]) < np.array(errors[0]) / 20) | (np.array(errors[1]) < 1e-9)), errors


@pytest.mark.parametrize("law", fast_first(LAWS.values()))
def test_the_sheet_and_the_note_name_it(law):
    solution = gc.solve(task_of(law, 12))
    assert sheet_of(solution).pages
    assert law.name in str(solution.drawn["acceleration"].steps()[2].caption)
    assert law.name in note_of(solution)
    assert solution.to_dict()["task"]["motion"]["phases"][0]["law"] == law.name


@pytest.mark.slow
def test_all_files_are_written(tmp_path):
    files = write(gc.solve(task_of(LAWS["jump"], 12)), tmp_path / "out")
    assert all((tmp_path / "out" / name).exists() for name in files.values() if name)


# --- what is no law --------------------------------------------------------------------------------------------------


def changed(**powers: float):
    """The smooth law with some of its functions times a factor."""
    factors = [powers.get(name, 1.0) for name in ("f", "f1", "f2", "f3")]
    return lambda u: tuple(x * factor for x, factor in zip(smooth(u), factors, strict=True))


def kinked(u):
    first = [np.broadcast_to(x, u.shape) for x in speeding_up(u)]
    return [np.where(u < M, a, b) for a, b in zip(first, slowing_down(u), strict=True)]


WRONG = {
    r"f\(1\) of the law 'x' is 2.0, but must be 1": lambda: gc.Law("x", changed(f=2)),
    r"f'\(0\) of the law 'x' is 1.0, but must be 0; a law leads from rest to rest": lambda: gc.Law(
        "x", lambda u: (u, 1 + 0 * u, 0, 0)
    ),
    r"integral of f' from u = 0.471 to 0.529 of the law 'x' is 0.144.*, but must be 0.144.*, the change of f": lambda: (
        gc.Law("x", changed(f1=1.001))
    ),
    r"integral of f'' from u = .* of the law 'x'": lambda: gc.Law("x", changed(f2=0.999)),
    r"integral of f''' from u = .* of the law 'x' .* correct the derivative": lambda: gc.Law("x", changed(f3=2)),
    r"integral of .* give an edge and a formula for either side": lambda: gc.Law("x", kinked),
    r"jump of f' at u = 0.4 of the law 'x' is .*, but must be 0": lambda: gc.Law(
        "x",
        [lambda u: (2.2 * u**2, 4.4 * u, 4.4, 0), lambda u: (u**2 * (3 - 2 * u), 6 * u * (1 - u), 6 - 12 * u, -12)],
        [0.4],
    ),
    r"f' at u = .* of the law 'x' is -.*, but must be 0 or more; .* several phases": lambda: gc.Law(
        "x", lambda u: tuple(2 * a - b for a, b in zip(swings(u), smooth(u), strict=True))
    ),
    r"f'' of the law 'x' is not finite": lambda: gc.Law("x", lambda u: (*smooth(u)[:2], np.full_like(u, np.inf), 0)),
    r"formula of the law 'x' is .* returns f, f', f'', f'''": lambda: gc.Law("x", lambda u: smooth(u)[:3]),
    r"formula of the law 'x' is .* use numpy": lambda: gc.Law("x", lambda u: (math.sin(u), 0, 0, 0)),
    r"number of formulas of the law 'x' is 1, but must be 2": lambda: gc.Law("x", smooth, [0.5]),
    r"edges of the law 'x' is \[0.7, 0.2\], but must be between 0 and 1, in order": lambda: gc.Law(
        "x", [smooth] * 3, [0.7, 0.2]
    ),
    r"given max f' of the law 'x' is 2.4, but must be 2.4609375": lambda: gc.Law("x", smooth, peaks=(2.4, 9.4)),
    r"tangent for k = 0.05 of the law 'x'": lambda: gc.Law("x", smooth, tangents=(lambda k: (0.3, 1.0), None)),
    r"shapes of the samples of the law 'x' is \(3,\) and \(2,\)": lambda: gc.sampled_law("x", [0, 0.5, 1], [0, 1]),
    r"samples u of the law 'x' is .*, but must be growing from 0 to 1; divide by the last": lambda: gc.sampled_law(
        "x", [0, 0.5, 0.5, 1], [0, 0.3, 0.5, 1]
    ),
    r"samples f of the law 'x' is .* grow": lambda: gc.sampled_law("x", [0, 0.5, 1], [0, np.nan, 1]),
    r"ratio is 2.0, but must be 1 for the 5-6-7-8-9 law": lambda: gc.Rise(30, 1, LAWS["smooth"], 2.0),
    "law is <function smooth .* a motion law that graphcam knows": lambda: gc.Rise(30, 1, smooth),
    "rise_law is <function smooth .* a name that graphcam knows": lambda: gc.Designs(30, 1, 1, 50, rise_law=smooth),
}


@over_all("message", WRONG)
def test_what_is_no_law_is_refused(message):
    with pytest.raises(gc.DesignError, match=message):
        WRONG[message]()


@over_all(
    ("choices", "message"),
    [
        ({"formulas": lambda u: (u, u)}, r"one that returns 2 values, but must be one that takes an array of u"),
        ({"peaks": (1.5,)}, r"peaks of the law 'mine' is \(1.5,\), but must be two numbers"),
        ({"ratio": -1.0}, "ratio of the law 'mine' is -1.0, but must be greater than 0"),
    ],
)
def test_what_goes_with_a_law_is_checked(choices, message):
    def formula(u):
        return u * u * (3 - 2 * u), 6 * u * (1 - u), 6 - 12 * u, -12 + 0 * u

    with pytest.raises(gc.DesignError, match=message):
        gc.Law("mine", **{"formulas": formula} | choices)


def test_a_function_in_place_of_a_law_is_told_what_makes_it_one():
    with pytest.raises(gc.DesignError, match=r"gc.Law\(name, formula\)"):
        gc.Rise(30, 2.0, lambda u: u)


def test_no_file_names_a_law_of_ones_own():
    """Not even one that is called like a built-in law: it would be read as that."""
    built_in = gc.law("3-4-5")
    own = gc.Law("cosine", lambda u: built_in(u))
    task = gc.builtin_task()
    phases = tuple(replace(phase, law=own) if phase.kind == "rise" else phase for phase in task.motion.phases)
    with pytest.raises(gc.DesignError, match=r"motion.phases\[0\].law is 'cosine'"):
        task_files(replace(task, motion=replace(task.motion, phases=phases)))


@over_all("name", gc.LAWS)
@over_all("ratio", [1.0, 2.5])
def test_a_built_in_law_and_its_reverse_would_pass_the_check_that_they_are_spared(name, ratio):
    law = gc.law(name, ratio=ratio if name == "rectangular" else 1.0)
    for built in (law, law.reversed):
        assert replace(built).pieces == built.pieces
    with pytest.raises(gc.DesignError, match="given max f'"):
        replace(law, peaks=(3.0, law.peak_acceleration))


@over_all("law", LAWS.values())
def test_an_arm_of_the_least_radius_just_keeps_its_limits(law):
    motion = gc.Motion([gc.Rise(0.35, 1.6, law), gc.Dwell(0.7), gc.Return(0.35, 1.3, law), gc.Dwell(2 * PI - 3.6)])
    for distance in (None, 140.0):
        least = gc.minimum_radius(motion, gc.Oscillating(100, distance), rise=PI / 4, return_=PI / 3)
        extremes = gc.Cam(motion, gc.Oscillating(100, least.distance), least.prime_radius).extremes()
        angles = extremes.pressure_angle_rise[0] / (PI / 4), extremes.pressure_angle_return[0] / (PI / 3)
        assert max(map(abs, angles)) == pytest.approx(1, abs=1e-13)


def only_of_arrays(u):
    f = np.empty((4, u.size))
    f[:] = smooth(u)
    return f


@over_all("law", [*LAWS.values(), gc.Law("of arrays", only_of_arrays), *map(gc.law, gc.LAWS)])
def test_a_law_at_one_place_is_that_at_many(law):
    u = np.array([0.0, 1e-9, 0.01, *law.edges, 0.3, 0.77, 1 - 1e-9, 1.0])
    for side in ("left", "right"):
        many = np.array(law(u, side=side))
        one = np.array([law.at(x, side) for x in u.tolist()]).T
        np.testing.assert_allclose(one, many, rtol=1e-14, atol=1e-15)
