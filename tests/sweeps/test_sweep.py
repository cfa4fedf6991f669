"""Many cams at once: what they are checked against is one cam after the other, and textbook formulas at 50 digits."""

from __future__ import annotations

import math
import tracemalloc
from collections.abc import Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from reference import EPS, ReferenceArm, ReferenceCam, maximum

import graphcam as gc
from graphcam.errors import DesignError
from graphcam.mechanism.turn_extremes import max_acceleration, max_velocity
from graphcam.sweeps import sweep_quantities as asked
from graphcam.sweeps.sweep import CHUNKS_PER_JOB, JOBS_AHEAD
from graphcam.sweeps.sweep_quantities import QUANTITIES
from graphcam.workers import ordered_results

SAME = 1e-13
"""The relative error that a sweep may have."""
EXTREMES = {
    "max_pressure_angle_rise": "pressure_angle_rise",
    "max_pressure_angle_return": "pressure_angle_return",
    "min_pitch_curvature_radius": "min_convex_radius",
}


def some_designs(n: int, seed: int = 1) -> gc.Designs:
    """Every law, both senses, with and without dwells, offsets up to almost the prime radius."""
    random = np.random.default_rng(seed)
    r0 = random.uniform(10, 90, n)
    return gc.Designs(
        lift=random.uniform(1, 50, n),
        rise_angle=random.uniform(0.3, 2.5, n),
        dwell_angle=np.where(random.random(n) < 0.3, 0, random.uniform(0, 1.2, n)),
        return_angle=random.uniform(0.3, 2.5, n),
        prime_radius=r0,
        offset=r0 * random.uniform(-0.999, 0.999, n),
        roller_radius=random.uniform(0, 8, n),
        rise_law=random.choice(gc.LAWS, n),
        return_law=random.choice(gc.LAWS, n),
        rotation=random.choice(["ccw", "cw"], n),
    )


def some_arms(n: int, seed: int = 1) -> gc.Designs:
    """Arms with every law, both senses, pivots nearer and farther than the arm is long, nearly folded and stretched."""
    random = np.random.default_rng(seed)
    arm = random.uniform(40, 150, n)
    distance, psi0 = arm * random.uniform(0.6, 1.6, n), np.radians(random.uniform(2, 120, n))
    return gc.Designs(
        follower="oscillating",
        lift=np.radians(random.uniform(2, 45, n)),
        rise_angle=random.uniform(0.3, 2.5, n),
        dwell_angle=np.where(random.random(n) < 0.3, 0, random.uniform(0, 1.2, n)),
        return_angle=random.uniform(0.3, 2.5, n),
        prime_radius=np.sqrt((distance - arm) ** 2 + 4 * distance * arm * np.sin(psi0 / 2) ** 2),
        arm=arm,
        distance=distance,
        roller_radius=0.1,
        rise_law=random.choice(gc.LAWS, n),
        return_law=random.choice(gc.LAWS, n),
        rotation=random.choice(["ccw", "cw"], n),
    )


def same_bits(one: dict, other: dict) -> bool:
    return one.keys() == other.keys() and all(one[name].tobytes() == other[name].tobytes() for name in one)


@pytest.mark.parametrize("designs", [some_designs(60), some_arms(60)], ids=["translating", "oscillating"])
def test_a_sweep_finds_what_each_cam_finds_by_itself(designs):
    found = gc.sweep(designs)
    for k in range(len(designs)):
        cam = designs.cam(k)
        extremes = cam.extremes()
        for name, own in EXTREMES.items():
            assert found[name][k] == pytest.approx(getattr(extremes, own)[0], rel=SAME), (k, name)
        assert found["max_v"][k] == pytest.approx(max_velocity(cam.motion), rel=4 * EPS)
        assert found["max_a"][k] == pytest.approx(max_acceleration(cam.motion), rel=4 * EPS)


@settings(max_examples=25, deadline=None)
@given(
    laws=st.tuples(st.sampled_from(gc.LAWS), st.sampled_from(gc.LAWS)),
    lift=st.floats(1e-3, 100),
    angles=st.tuples(st.floats(0.05, 3), st.one_of(st.just(0.0), st.floats(1e-3, 0.2)), st.floats(0.05, 3)),
    radius=st.floats(1, 300),
    share=st.floats(-0.999999, 0.999999),
    rotation=st.sampled_from(["ccw", "cw"]),
)
def test_extremes_lie_at_ends_at_breaks_and_inside(laws, lift, angles, radius, share, rotation):
    rise, dwell, back = angles
    designs = gc.Designs(
        lift=lift, rise_angle=rise, dwell_angle=dwell, return_angle=back, prime_radius=radius, offset=share * radius,
        rise_law=laws[0], return_law=laws[1], rotation=rotation,
    )  # fmt: skip
    found, extremes = gc.sweep(designs), designs.cam(0).extremes()
    for name, own in EXTREMES.items():
        value = getattr(extremes, own)[0]
        # Of two angles as large as each other either sign may be told.
        if name != "min_pitch_curvature_radius" and found[name][0] * value < 0:
            value = -value
        assert found[name][0] == pytest.approx(value, rel=SAME), name


@pytest.mark.parametrize(
    ("reference", "sizes"),
    [
        (ReferenceCam, {"lift": 30, "offset": 9, "prime_radius": [42, 60]}),
        (
            ReferenceArm,
            {
                "follower": "oscillating",
                "lift": 0.4,
                "arm": 90,
                "distance": 95,
                "prime_radius": [42, 25],
                "rotation": ["ccw", "cw"],
            },
        ),
    ],
)
@pytest.mark.parametrize("laws", [("cycloidal", "3-4-5"), ("modified-sine", "cosine"), ("trapezoidal", "4-5-6-7")])
def test_against_fifty_digits(laws, reference, sizes):
    designs = gc.Designs(
        rise_angle=math.radians(110), dwell_angle=0.5, return_angle=math.radians(95), rise_law=laws[0],
        return_law=laws[1], **sizes,
    )  # fmt: skip
    found = gc.sweep(designs, ["max_pressure_angle_rise", "max_pressure_angle_return"])
    for k in range(2):
        cam = designs.cam(k)
        exact, extremes = reference(cam), (cam.extremes().pressure_angle_rise, cam.extremes().pressure_angle_return)
        for name, (value, about) in zip(found, extremes, strict=True):
            sign = math.copysign(1, value)
            peak = maximum(lambda t, sign=sign, exact=exact: sign * exact.pressure_angle(t), about - 0.05, about + 0.05)
            assert abs(found[name][k] / (sign * peak) - 1) < SAME


def test_a_jump_of_the_acceleration_counts_from_both_sides():
    designs = gc.Designs(
        lift=20, rise_angle=1.5, dwell_angle=0.4, return_angle=1.5, prime_radius=50, rise_law="rectangular",
        return_law="rectangular",
    )  # fmt: skip
    # Just after the middle of the rise, where s = 10, v = 2 h/F and a = -4 h/F^2: by the formula of the textbook.
    with mpmath.workdps(50):
        d, v, a = mpmath.mpf(60), 2 * mpmath.mpf(20) / 1.5, -4 * mpmath.mpf(20) / mpmath.mpf(1.5) ** 2
        rho = (d**2 + v**2) ** mpmath.mpf(1.5) / (d**2 + 2 * v**2 - d * a)
    found = gc.sweep(designs, ["min_pitch_curvature_radius"])["min_pitch_curvature_radius"][0]
    assert found == pytest.approx(float(rho), rel=SAME)


def test_under_a_flat_face():
    n = 40
    random = np.random.default_rng(3)
    designs = gc.Designs(
        lift=random.uniform(5, 30, n), rise_angle=random.uniform(1, 2.5, n), return_angle=random.uniform(1, 2.5, n),
        prime_radius=random.uniform(5, 80, n), rise_law=random.choice(gc.LAWS, n), follower="flat-faced",
    )  # fmt: skip
    found = gc.sweep(designs)
    exact = [designs.cam(k).extremes().min_convex_radius[0] for k in range(n)]
    # rho is a sum of terms that may cancel.
    np.testing.assert_allclose(found["min_pitch_curvature_radius"], exact, rtol=SAME, atol=1e-12)
    assert (found["feasible"] == (np.array(exact) > 0)).all()
    assert not found["max_pressure_angle_rise"].any()


@pytest.mark.parametrize("designs", [some_designs(60), some_arms(60)], ids=["translating", "oscillating"])
@pytest.mark.parametrize("chunk", [1, 7, 4096])
def test_the_same_bits_for_any_chunking(designs, chunk):
    assert same_bits(gc.sweep(designs), gc.sweep(designs, chunk=chunk))


def test_the_comparison_of_bits_can_fail():
    found = gc.sweep(some_designs(5))
    assert not same_bits(found, found | {"max_v": np.nextafter(found["max_v"], np.inf)})


@pytest.mark.parametrize("workers", [1, 2])
def test_the_same_bits_from_threads(workers):
    designs = some_designs(300)
    with ThreadPoolExecutor(workers) as executor:
        assert same_bits(gc.sweep(designs), gc.sweep(designs, executor=executor, chunk=16))


class AtOnce(Executor):
    """Does its jobs at once, and counts them."""

    def __init__(self) -> None:
        self.done = 0

    def submit(self, function, /, *args, **kwargs):
        found = Future()
        found.set_result(function(*args, **kwargs))
        self.done += 1
        return found


def test_results_that_nobody_has_taken_yet_are_bounded():
    """What takes results, as a file does, may be slower than what makes them."""
    executor = AtOnce()
    ahead = [executor.done - taken for taken, _ in enumerate(ordered_results(executor, abs, range(500), ahead=7))]
    assert (len(ahead), max(ahead), executor.done) == (500, 7, 500)


def test_a_sweep_keeps_to_its_own_bound(monkeypatch):
    executor, ahead = AtOnce(), []

    def watched(*given) -> Iterator[object]:
        for taken, found in enumerate(ordered_results(*given)):
            ahead.append(executor.done - taken)
            yield found

    monkeypatch.setattr("graphcam.sweeps.sweep.ordered_results", watched)
    designs = some_designs(3 * JOBS_AHEAD * CHUNKS_PER_JOB)
    assert same_bits(gc.sweep(designs), gc.sweep(designs, executor=executor, chunk=1))
    assert (max(ahead), executor.done) == (JOBS_AHEAD, 3 * JOBS_AHEAD)


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 2])
def test_the_same_bits_from_processes(workers):
    designs = some_designs(300)
    with ProcessPoolExecutor(workers, get_context("spawn")) as executor:
        assert same_bits(gc.sweep(designs), gc.sweep(designs, executor=executor, chunk=16))


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of the cluster's own closing
def test_the_same_bits_from_a_cluster():
    from distributed import Client, LocalCluster

    designs = some_designs(300)
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
        client.get_executor() as executor,
    ):
        assert same_bits(gc.sweep(designs), gc.sweep(designs, executor=executor, chunk=16))


def test_the_order_of_the_designs_does_not_matter():
    designs, order = some_designs(80), np.random.default_rng(2).permutation(80)
    found, permuted = gc.sweep(designs), gc.sweep(designs.part(order))
    assert same_bits({name: column[order] for name, column in found.items()}, permuted)


def test_what_cannot_be_is_nan_and_not_feasible():
    designs = gc.Designs(
        lift=[30, 30, 30, -1, 30, 30, math.nan], rise_angle=[2, 2, 2, 2, 4, 2, 2], return_angle=2.0,
        prime_radius=[10, 50, math.inf, 50, 50, -50, 50], offset=[10, 5, 0, 0, 0, 0, 0], dwell_angle=0.5,
    )  # fmt: skip
    found = gc.sweep(designs)
    possible = [False, True, False, False, False, False, False]
    for name in EXTREMES:
        assert np.isfinite(found[name]).tolist() == possible
    assert not found["feasible"][[0, 2, 3, 4, 5, 6]].any()
    assert np.isnan(found["max_v"]).tolist() == [False, False, False, True, True, False, True]


def test_an_arm_that_cannot_be_is_nan_and_not_feasible():
    """It does not reach the prime circle, or swings beyond the line of centres."""
    designs = gc.Designs(
        follower="oscillating", lift=[0.4, 0.4, 0.4, 0.4, 2.0], rise_angle=2.0, return_angle=1.8, arm=100, distance=120,
        prime_radius=[19.9, 90, 90, 220.1, 190], roller_radius=[5, 5, 90, 5, 5],
    )  # fmt: skip
    found = gc.sweep(designs)
    possible = []
    for k in range(len(designs)):
        try:
            possible.append(math.isfinite(designs.cam(k).extremes().min_convex_radius[0]))
        except DesignError as error:
            possible.append("roller" in str(error))
    assert possible == [False, True, True, False, False]
    for name in EXTREMES:
        assert np.isfinite(found[name]).tolist() == possible
    assert found["feasible"].tolist() == [False, True, False, False, False]


def test_the_usual_limit_is_that_of_the_follower():
    """45 degrees of an arm, 30 of a translating follower."""
    arms = gc.Designs(
        follower="oscillating", lift=0.4, rise_angle=1.2, return_angle=2.5, arm=100, distance=120,
        prime_radius=np.linspace(30, 110, 81),
    )  # fmt: skip
    sliding = gc.Designs(lift=30, rise_angle=1.6, return_angle=2.5, prime_radius=np.linspace(20, 90, 81))
    for designs, limit in ((arms, 45), (sliding, 30)):
        found = gc.sweep(designs)
        steep = np.degrees(np.abs(found["max_pressure_angle_rise"]))
        assert (found["feasible"] == (steep <= limit)).all()
        assert {True, False} == set(found["feasible"].tolist())
        assert ((steep > 30) & (steep < 45)).any()


def test_a_roller_and_a_pressure_angle_too_large_are_not_feasible():
    designs = gc.Designs(
        lift=30, rise_angle=2.0, return_angle=1.6, prime_radius=[50, 50, 50, 20], roller_radius=[10, 49, 50, 5]
    )
    found = gc.sweep(designs)
    angle, rho = np.degrees(found["max_pressure_angle_rise"]), found["min_pitch_curvature_radius"]
    assert (found["feasible"] == ((angle <= 30) & (designs.roller_radius < rho))).all()
    assert found["feasible"].tolist()[::3] == [True, False]


@pytest.mark.parametrize("follower", ["translating", "flat-faced"])
def test_a_profile_sharper_than_permitted_is_not_feasible(follower):
    sizes = {"prime_radius": np.linspace(35, 90, 40), "roller_radius": 12 if follower == "translating" else 0}
    designs = gc.Designs(lift=20, rise_angle=2.0, return_angle=1.6, follower=follower, **sizes)
    plain, limited = (gc.sweep(designs, limits=gc.Limits(curvature=least)) for least in (None, 18.0))
    profile = plain["min_pitch_curvature_radius"] - sizes["roller_radius"]
    assert (limited["feasible"] == plain["feasible"] & (profile >= 18)).all()
    assert 0 < limited["feasible"].sum() < plain["feasible"].sum()
    with pytest.raises(gc.DesignError, match="radius of curvature is -1, but must be"):
        gc.Limits(curvature=-1)


def test_only_what_is_asked_is_computed(monkeypatch):
    def forbidden(*_):
        raise AssertionError("a search where none is needed")

    monkeypatch.setattr(asked, "leg_maxima", forbidden)
    assert gc.sweep(some_designs(5), ["max_v", "max_a"]).keys() == {"max_v", "max_a"}
    with pytest.raises(AssertionError):
        gc.sweep(some_designs(5), ["max_pressure_angle_rise"])


def test_the_least_radius_is_searched_once_for_two_quantities(monkeypatch):
    calls, search = [], asked.leg_maxima
    monkeypatch.setattr(asked, "leg_maxima", lambda *given: calls.append(1) or search(*given))
    designs = gc.Designs(lift=30, rise_angle=2.0, return_angle=1.6, prime_radius=50)
    gc.sweep(designs, QUANTITIES)
    assert len(calls) == 4  # a rise and a return, of pressure angle and curvature


def test_the_memory_is_that_of_a_chunk():
    def peak(n: int) -> int:
        designs = gc.Designs(lift=30, rise_angle=2.0, return_angle=1.6, prime_radius=np.linspace(40, 60, n))
        tracemalloc.start()
        gc.sweep(designs, chunk=256)
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most - n * (5 * 8 + 1)

    peak(256)
    few, many = peak(1024), peak(8192)
    assert many < 1.2 * few
    assert many < 4 * 2**20


def test_the_working_set_of_a_full_chunk_is_four_mebibytes():
    designs = some_designs(4096)
    gc.sweep(designs.part(slice(0, 8)))
    tracemalloc.start()
    gc.sweep(designs)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most <= 4 * 2**20


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rise_law": "cicloidal"}, "did you mean 'cycloidal'"),
        ({"rotation": ["ccw", "up"]}, "rotation is 'up'"),
        ({"offset": [1, 2, 3]}, "number of designs is 2 and 3"),
        ({"offset": [[1, 2]]}, "an array of shape"),
        ({"offset": "five"}, "offset is 'five'"),
        ({"follower": "flat"}, "follower is 'flat'"),
        ({"follower": "flat-faced", "offset": 5}, "left out for a flat-faced follower"),
        ({"arm": 100}, "arm is given, but must be left out for a translating follower"),
        ({"follower": "oscillating", "arm": 100, "distance": 120, "offset": 5}, "left out for an oscillating follower"),
        ({"follower": "oscillating", "arm": 100}, "distance is left out"),
    ],
)
def test_designs_that_do_not_fit_say_why(change, message):
    with pytest.raises(DesignError, match=message):
        gc.Designs(**{"lift": 30, "rise_angle": 2.0, "return_angle": 1.6, "prime_radius": [40, 50]} | change)


def test_unknown_quantities_say_what_is_known():
    with pytest.raises(DesignError, match="known are max_pressure_angle_rise"):
        gc.sweep(some_designs(2), ["max_w"])


def test_angles_in_degrees_are_refused_where_no_design_is_within_a_turn():
    """One design within a turn is enough to show that the unit is right: the others are NaN then, as before."""
    sizes = {"lift": 30, "return_angle": 1.6, "prime_radius": 50}
    degrees = gc.Designs(rise_angle=[100, 120], **sizes)
    with pytest.raises(gc.DesignError, match=r"^rise_angle is 100 rad, .* write math.radians\(100\) if it is in deg"):
        gc.sweep(degrees)
    found = gc.sweep(gc.Designs(rise_angle=[2.0, 120], **sizes), "feasible")
    assert found["feasible"].tolist() == [True, False]


def test_lifts_of_arms_in_another_unit_are_refused():
    arms = {"rise_angle": 2.0, "return_angle": 1.6, "prime_radius": 50, "arm": 120, "distance": 130}
    with pytest.raises(gc.DesignError, match=r"^lift is 15 rad, .* an arm's lift is an angle in radians"):
        gc.sweep(gc.Designs(lift=[15, 20], follower="oscillating", **arms))


def test_one_quantity_may_be_named_alone():
    designs = gc.Designs(lift=30, rise_angle=2.0, return_angle=1.6, prime_radius=[50, 60])
    alone, listed = gc.sweep(designs, "max_v"), gc.sweep(designs, ["max_v"])
    assert list(alone) == ["max_v"]
    assert np.array_equal(alone["max_v"], listed["max_v"])
