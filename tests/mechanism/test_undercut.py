"""Undercut: loops against 50 digits from the smallest to large ones, and what is left against every roller circle."""

from __future__ import annotations

import math
import tracemalloc

import numpy as np
import pytest
from mpmath import findroot, mp, mpf
from over_all import over_all, over_seeds
from reference import ReferenceCam, lift
from scipy.spatial import cKDTree

from graphcam.errors import DesignError
from graphcam.given.follower import FlatFaced, Oscillating, Translating
from graphcam.given.laws import LAWS
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam, largest_roller
from graphcam.mechanism.undercut import Undercut, _sides_that_cross, trimmed_profile

DEG = math.pi / 180
ROTATIONS = ("ccw", "cw")
EXCESSES = (2e-12, 1e-11, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 0.05, 0.2)
"""By which part the roller is larger than the minimum radius of curvature."""


def one_loop(law: str, rotation: str, excess: float) -> Cam:
    """A cam that is most sharply bent on the rise; the return is gentle."""
    motion = Motion([Rise(30, 70 * DEG, law), Dwell(30 * DEG), Return(30, 200 * DEG, "3-4-5"), Dwell(60 * DEG)])
    e = 5.0 if rotation == "ccw" else -5.0
    return with_roller(Cam(motion, Translating(e), 40.0, rotation), 1 + excess)


def with_roller(cam: Cam, share: float) -> Cam:
    """The same cam with a roller of this share of the largest one."""
    roller = largest_roller(cam) * share
    follower = cam.follower
    changed = (
        Translating(follower.offset, roller)
        if isinstance(follower, Translating)
        else Oscillating(follower.arm, follower.distance, roller)
    )
    return Cam(cam.motion, changed, cam.prime_radius, cam.rotation)


def distance(undercut: Undercut, point) -> float:
    x, y = undercut.crossing[2:]
    return float(mp.hypot(mpf(x) - point[0], mpf(y) - point[1]))


# --- one loop, from the smallest on ----------------------------------------------------------------------------------


@over_all("rotation", ROTATIONS)
@over_all("excess", EXCESSES)
def test_crossing_of_a_smooth_loop_against_50_digits(rotation, excess):
    """Two cusps with sqrt(3) between loop and cusps; the corner where the two branches meet in 50 digits."""
    cam = one_loop("4-5-6-7", rotation, excess)
    (loop,) = cam.undercuts()
    exact = ReferenceCam(cam)
    phi1, phi2 = loop.crossing[:2]
    size = phi2 - phi1
    # The way between the branches, as a mean over the loop so that the root at phi1 = phi2 is none.
    root = findroot(
        lambda m, t: list((exact.profile(m + t) - exact.profile(m - t)) / t**3),
        (mpf(phi1 + phi2) / 2, mpf(size) / 2),
        tol=1e-40 / size**4,
        maxsteps=30,
    )
    assert float(2 * root[1]) == pytest.approx(size, rel=1e-3 if excess < 1e-6 else 1e-8)
    assert distance(loop, exact.profile(root[0] - root[1])) <= 1e-12
    assert size / (loop.cusps[1] - loop.cusps[0]) == pytest.approx(math.sqrt(3), rel=2e-3 + math.sqrt(excess))


@over_all("rotation", ROTATIONS)
@over_all(("law", "r0"), [("rectangular", 30.0), ("cosine", 60.0)])
@over_all("excess", EXCESSES)
def test_crossing_at_a_jump_against_50_digits(law, r0, rotation, excess):
    """Most sharply bent where the rise ends with a jump: the loop is closed by the arc of the dwell."""
    motion = Motion([Rise(30, 60 * DEG, law), Dwell(120 * DEG), Return(30, 150 * DEG, "3-4-5"), Dwell(30 * DEG)])
    cam = with_roller(Cam(motion, Translating(0.0), r0, rotation), 1 + excess)
    end = float(motion.starts[1])
    assert cam.extremes().min_convex_radius[1] == end
    (loop,) = cam.undercuts()
    assert loop.cusps[1] == end
    r, sigma = mpf(cam.roller_radius), cam.sigma

    def pitch(phi):
        u = phi / mpf(motion.phases[0].angle)
        s = 30 * lift(law, u)
        return 1j * (mpf(r0) + s) * mp.expj(-sigma * phi)

    def profile(phi):
        along = mp.diff(pitch, phi)
        return pitch(phi) - r * sigma * 1j * along / abs(along)

    # On the arc of the dwell; where the branches touch at the end they do so twice.
    root = findroot(
        lambda phi: (abs(profile(phi)) - (r0 + 30 - r)) / (phi - end) ** 2,
        (mpf(loop.crossing[0]), mpf(loop.cusps[0])),
        tol=1e-25,
    )
    assert float(end - root) == pytest.approx(end - loop.crossing[0], rel=1e-2 if excess < 1e-10 else 1e-4)
    point = profile(root)
    assert distance(loop, (point.real, point.imag)) <= 1e-12


@over_all("law", ["3-4-5", "cosine", "rectangular", "modified-sine"])
@over_all("rotation", ROTATIONS)
@over_all("share", [-5e-13, -1e-15, 0.0, 1e-15, 5e-13])
def test_at_the_critical_roller_there_is_a_cusp_within_tolerance(law, rotation, share):
    cam = one_loop(law, rotation, share)
    (cusp,) = cam.undercuts()
    assert cusp.is_cusp
    assert cusp.cusps == (cusp.crossing[0],) * 2
    assert cusp.cusps[0] == pytest.approx(cam.extremes().min_convex_radius[1], abs=1e-12)
    np.testing.assert_allclose(cusp.crossing[2:], cam.profile(cusp.cusps[0]), atol=1e-12)
    assert cam.trimmed_profile(200).shape == (200, 2)


# --- how many loops, and what is left --------------------------------------------------------------------------------


def random_cam(seed: int) -> Cam:
    """All laws, followers and rotations, with rollers (faces) from sound to hopeless."""
    rng = np.random.default_rng(seed)
    laws = LAWS[seed % 10], LAWS[(3 * seed + seed // 10) % 10]
    angles = rng.uniform(0.1, 1.5, 4)
    angles *= FULL_TURN / angles.sum()
    kind, rotation = seed % 4, ROTATIONS[rng.integers(2)]
    h = rng.uniform(0.1, 0.5) if kind == 2 else rng.uniform(5, 60)
    motion = Motion([Rise(h, angles[0], laws[0]), Dwell(angles[1]), Return(h, angles[2], laws[1]), Dwell(angles[3])])
    if kind == 3:
        return Cam(motion, FlatFaced(), rng.uniform(2, 60), rotation)
    r0 = rng.uniform(20, 120)
    arm = rng.uniform(100, 200)
    follower = (
        Oscillating(arm, arm + rng.uniform(-0.5, 0.5) * r0) if kind == 2 else Translating(rng.uniform(-0.7, 0.7) * r0)
    )
    cam = Cam(motion, follower, r0, rotation)
    return with_roller(cam, min(rng.choice([0.5, 0.999, 1.001, 1.1, 1.3, 2, 4]), 0.98 * r0 / largest_roller(cam)))


@over_seeds(5)
def test_what_is_left_is_a_simple_curve_that_no_roller_reaches_into(seed):
    cam, n = random_cam(seed), 1000
    cut = trimmed_profile(cam.envelope, n)
    lost = [loop for loop in cam.undercuts() if not loop.is_cusp]
    assert cut.points.shape == (n, 2)
    assert np.isfinite(cut.points).all()
    assert cut.corner.sum() == len(lost)
    assert cut.points[cut.corner].tolist() == [list(loop.crossing[2:]) for loop in lost]
    np.testing.assert_allclose(cut.points[~cut.corner], cam.profile(cut.phi[~cut.corner]), atol=1e-11)
    assert deepest_cut(cam, cut.points, lost) <= 1e-9
    assert not polygon_crosses_itself(cut.points)
    assert polygon_winds_once(cut.points, cam.sigma)


def deepest_cut(cam: Cam, points: np.ndarray, lost: list[Undercut]) -> float:
    """By how much the roller circles, or the half planes above the face, reach over the points [mm]."""
    phi = np.linspace(0, FULL_TURN, 1001 if isinstance(cam.follower, FlatFaced) else 20001)
    phi = np.concatenate([phi, *(x + np.linspace(-0.1, 0.1, 1001) for loop in lost for x in loop.crossing[:2])])
    if isinstance(cam.follower, FlatFaced):
        up = np.stack([cam.sigma * np.sin(phi), np.cos(phi)])
        return float((points @ up - (cam.prime_radius + cam.motion(phi)[0])).max())
    return float(cam.roller_radius - cKDTree(cam.pitch_curve(phi)).query(points)[0].min())


def polygon_crosses_itself(points: np.ndarray) -> bool:
    ends = np.roll(points, -1, axis=0)
    side = ends - points

    def left(k: int, q: np.ndarray) -> np.ndarray:
        return side[k, 0] * (q[:, 1] - points[k, 1]) - side[k, 1] * (q[:, 0] - points[k, 0]) > 0

    parted = np.array([left(k, points) != left(k, ends) for k in range(len(points))])
    k = np.arange(len(points))
    apart = np.abs(k[:, None] - k)
    return bool((parted & parted.T & (apart > 1) & (apart < len(points) - 1)).any())


def polygon_winds_once(points: np.ndarray, sigma: int) -> bool:
    z = points[:, 0] + 1j * points[:, 1]
    return round(np.angle(np.roll(z, -1) / z).sum() / FULL_TURN) == -sigma


@over_seeds(5)
def test_every_backward_stretch_is_lost_and_bounded_by_cusps(seed):
    """The profile runs backwards where rho < r; counted on both sides of every break and between."""
    cam = random_cam(seed)
    lost = [loop for loop in cam.undercuts() if not loop.is_cusp]
    phase, u = np.meshgrid(np.arange(4), np.linspace(0, 1, 4001), indexing="ij")
    at = cam.at(phase, u)
    rho = 1 / at.curvature
    behind = rho < 0 if isinstance(cam.follower, FlatFaced) else (rho > 0) & (rho < cam.roller_radius)
    behind, phi = behind.ravel(), at.phi.ravel()
    turns = np.count_nonzero(behind != np.roll(behind, 1))
    assert sum(len(loop.cusps) for loop in lost) == turns
    for x in phi[behind]:
        assert any(
            (x - first) % FULL_TURN < (last - first) % FULL_TURN for first, last, *_ in (loop.crossing for loop in lost)
        )
    assert bool(lost) == (turns > 0)


@over_all("share", [1 - 1e-9, 1 + 1e-9])
@over_all("seed", [k for k in range(30) if k % 4 != 3])
def test_the_largest_roller_parts_sound_cams_from_undercut_ones(seed, share):
    cam = with_roller(random_cam(seed), 1.0)
    if cam.roller_radius < 0.99 * cam.prime_radius:
        assert bool(with_roller(cam, share).undercuts()) == (share > 1)
        assert largest_roller(cam) == cam.extremes().min_convex_radius[0]


def test_loops_that_swallow_each_other_leave_one_corner():
    """A short high dwell between two loops is lost with them: the flanks of rise and return cross."""
    motion = Motion([Rise(30, 60 * DEG), Dwell(4 * DEG), Return(30, 60 * DEG), Dwell(236 * DEG)])
    cam = Cam(motion, Translating(0, 25), 30)
    (loop,) = cam.undercuts()
    assert len(loop.cusps) == 4
    # Rise and return mirror each other about the middle of the dwell.
    axis = 62 * DEG
    assert loop.crossing[0] + loop.crossing[1] == pytest.approx(2 * axis, abs=1e-13)
    assert math.atan2(loop.crossing[2], loop.crossing[3]) == pytest.approx(axis, abs=1e-13)
    assert deepest_cut(cam, cam.trimmed_profile(500), [loop]) <= 1e-9


def test_flanks_may_cross_without_a_cusp():
    """A lobe on a neck narrower than the roller falls off whole, though nothing is bent too sharply."""
    rise, back = Rise(80, 35 * DEG, "rectangular", 10), Return(80, 35 * DEG, "rectangular", 0.1)
    motion = Motion([rise, Dwell(10 * DEG), back, Dwell(280 * DEG)])
    cam = Cam(motion, Translating(0, 9), 10)
    assert largest_roller(cam) > 9
    (loop,) = cam.undercuts()
    assert loop.cusps == ()
    assert loop.crossing[0] + loop.crossing[1] == pytest.approx(80 * DEG, abs=1e-13)
    cut = cam.trimmed_profile(500)
    assert deepest_cut(cam, cut, [loop]) <= 1e-9
    assert np.linalg.norm(cut, axis=1).max() < 0.5 * np.linalg.norm(cam.profile(np.linspace(0, 1, 1000)), axis=1).max()


def test_too_few_points_are_refused():
    cam = one_loop("3-4-5", "ccw", 0.1)
    with pytest.raises(DesignError, match="number of points is 3, but must be 4 or more"):
        cam.trimmed_profile(3)
    assert cam.trimmed_profile(4).shape == (4, 2)


def test_a_flat_face_has_no_largest_roller():
    with pytest.raises(DesignError, match="follower is 'flat-faced'"):
        largest_roller(random_cam(3))


@over_seeds(3)
def test_a_mirror_mirrors_the_loops(seed):
    cam = with_roller(random_cam(4 * seed), 1.05)
    f = cam.follower
    mirrored = Cam(
        cam.motion, Translating(-f.offset, f.roller_radius), cam.prime_radius, ROTATIONS[cam.rotation == "ccw"]
    )
    for here, there in zip(cam.undercuts(), mirrored.undercuts(), strict=True):
        np.testing.assert_allclose(there.cusps, here.cusps, atol=1e-12)
        np.testing.assert_allclose(there.crossing, np.array(here.crossing) * [1, 1, -1, 1], atol=1e-11)


# --- many loops ------------------------------------------------------------------------------------------------------


def scribble(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Points of polygons that cross all over, also on equal and on upright sides, and the polygon of each."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(0, 1, 120) + 1j * rng.uniform(0, 1, 120)
    if seed % 2:
        points = np.round(4 * points.real) + 1j * np.round(4 * points.imag)
    return points, np.sort(rng.integers(0, 5, 120))


def sides_of_a_cam(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Points of a random cam's forward arcs, and the arc of each; its loops cross."""
    cam = random_cam(seed)
    phi = np.linspace(0, FULL_TURN, 700)
    ahead = cam.envelope.speed(phi, cam.envelope.piece(phi)) > 0
    points = cam.profile(phi)[ahead] @ [1, 1j]
    return points, np.cumsum(np.diff(phi[ahead], prepend=0) > 0.02)


@over_all("drawn", [scribble, sides_of_a_cam])
@over_all("seed", range(12))
def test_the_sides_that_cross_are_those_that_part_each_other_s_ends(drawn, seed):
    """Against every side beside every other one."""
    points, polygon = drawn(seed)
    side = points[1:] - points[:-1]
    between = points - points[:-1, None]
    left = side.real[:, None] * between.imag - side.imag[:, None] * between.real >= 0
    parted, same = left[:, :-1] != left[:, 1:], polygon[1:] == polygon[:-1]
    brute = np.argwhere(np.triu(parted & parted.T & same & same[:, None], k=2))
    assert sorted(zip(*_sides_that_cross(points, polygon), strict=True)) == [tuple(pair) for pair in brute.tolist()]


def lobes(angles: np.ndarray, share: float) -> Cam:
    """A cam that lifts by 0.5 mm in one angle and lowers in the next, all around."""
    phases = [(Rise, Return)[k % 2](0.5, float(angle), "cosine") for k, angle in enumerate(angles)]
    return with_roller(Cam(Motion(phases), Translating(0.0), 100.0), share)


def test_equal_lobes_lose_equal_parts_in_little_memory():
    """A hundred of them, where comparing all sides of the profile with each other would take hundreds of MB."""
    n = 100
    cam = lobes(np.full(2 * n, FULL_TURN / (2 * n)), 1.5)
    tracemalloc.start()
    lost = cam.undercuts()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak <= 20e6
    crossings = np.array([loop.crossing for loop in lost])
    np.testing.assert_allclose(np.diff(crossings[:, :2], axis=0), FULL_TURN / n, atol=1e-12)
    np.testing.assert_allclose(np.hypot(*crossings[:, 2:].T), math.hypot(*lost[0].crossing[2:]), atol=1e-12)
    assert [len(loop.cusps) for loop in lost] == [2] * n


def test_what_is_lost_of_one_lobe_does_not_depend_on_the_others():
    """The crossings are sought all at once; each ends where it would alone."""
    rng = np.random.default_rng(5)
    first = rng.uniform(0.02, 0.05, 60)
    rest = FULL_TURN - first.sum()
    others = [np.append(first, np.full(n, rest / n)) for n in (2, 120)]
    few, many = (lobes(angles, 1.0) for angles in others)
    roller = 2 * largest_roller(many)
    half = first[:-1].sum()
    corners = [
        [
            loop.crossing
            for loop in Cam(cam.motion, Translating(0.0, roller), 100.0).undercuts()
            if loop.crossing[1] < half
        ]
        for cam in (few, many)
    ]
    assert len(corners[0]) > 10
    np.testing.assert_allclose(*corners, rtol=0, atol=1e-11)
