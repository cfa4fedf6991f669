"""Outlines whose points lie on arcs and straight parts, which are found again, against followers laid on the points."""

import math
from dataclasses import replace

import numpy as np
import pytest
from over_all import over_seeds
from test_outline_motion import highest, random_cam

import graphcam as gc
from graphcam.given.arc_loop import arc_loop
from graphcam.tasks.task import Task

LAID_ON = 1e-4
"""How far a follower that is laid on points of the outline may be from one on its arcs [mm]."""


def sampled(parts, spacing):
    """Points on parts, clockwise, each from where it begins to before the next."""
    found = []
    for arc, following in zip(parts, [*parts[1:], parts[0]], strict=True):
        if math.isinf(arc.radius):
            count = math.ceil(abs(following.point - arc.point) / spacing)
            found.append(arc.point + (following.point - arc.point) * np.arange(count) / count)
            continue
        way = -1 if arc.radius > 0 else 1
        sweep = way * ((way * np.angle(following.outward / arc.outward)) % (2 * math.pi) or 2 * math.pi)
        count = max(math.ceil(abs(arc.radius * sweep) / spacing), 8)
        found.append(arc.centre + arc.radius * arc.outward * np.exp(1j * sweep * np.arange(count) / count))
    return np.concatenate(found)


def laid(points, follower, phi, rotation, base):
    """The displacements (n,) of a follower on points that turn with the cam by angles (n,)."""
    sigma = 1 if rotation == "ccw" else -1
    return np.array([highest(points * np.exp(1j * sigma * at), follower, base) for at in phi])


@over_seeds(15)
def test_cams_by_their_radii_are_found_again_from_their_points_however_they_lie(seed):
    rng = np.random.default_rng([3, seed])
    faces = gc.FlatFaced | gc.OscillatingFlat
    while (found := random_cam(rng)) is None or isinstance(found[1], faces) or 0 < found[0].dwell < 0.05:
        pass
    cam, follower, rotation, _ = found
    turn, mirrored = np.exp(1j * rng.uniform(0, 7)), rng.random() < 0.5
    points = turn * sampled(cam.arcs(), 0.2)[::-1]
    points = points.conj()[::-1] if mirrored else points
    loop = arc_loop(np.roll(points, int(rng.integers(points.size))))
    assert loop is not None
    assert len(loop.parts) == len(cam.arcs())
    assert sorted(abs(part.radius) for part in loop.parts) == pytest.approx(
        sorted(abs(part.radius) for part in cam.arcs()), rel=1e-6
    )
    motion = gc.outline_motion(loop, follower, rotation)
    phi = rng.uniform(0, 2 * math.pi, 40)
    dense = np.concatenate([a + (b - a) * np.arange(20) / 20 for a, b in zip(points, np.roll(points, -1), strict=True)])
    arm = follower.arm if isinstance(follower, gc.Oscillating) else 1.0
    miss = arm * (laid(dense, follower, phi, rotation, loop.base_radius) - motion(phi - motion.origin)[0])
    # The chords of the points lie inside an arc, by less than this.
    assert np.abs(miss).max() < LAID_ON + 0.2**2 / 8 / min(abs(part.radius) for part in loop.parts)


def lopsided_points(spacing):
    """Points, clockwise, of a cam with a round flank above the x axis and a straight one below it."""
    base, nose, at, flank = 30.0, 12.0, 32.0, 90.0
    along = ((flank - base) ** 2 - (flank - nose) ** 2 + at**2) / (2 * at)
    centre = complex(along, -math.sqrt((flank - base) ** 2 - along**2))
    leaves, meets = -centre / abs(centre), (at - centre) / abs(at - centre)
    lean = (base - nose) / at
    below = complex(lean, -math.sqrt(1 - lean**2))

    def arc(about, radius, first, last):
        sweep = -((-np.angle(last / first)) % (2 * math.pi))
        count = math.ceil(abs(radius * sweep) / spacing)
        return about + radius * first * np.exp(1j * sweep * np.arange(count) / count)

    start, end = at + nose * below, base * below
    count = math.ceil(abs(end - start) / spacing)
    straight = start + (end - start) * np.arange(count) / count
    return np.concatenate(
        [arc(centre, flank, leaves, meets), arc(at, nose, meets, below), straight, arc(0, base, below, leaves)]
    )


FOLLOWERS = (gc.Translating(0.0, 10.0), gc.Translating(-6.0, 10.0), gc.Oscillating(90.0, 100.0, 8.0))


@pytest.mark.parametrize("rotation", ["ccw", "cw"])
@pytest.mark.parametrize(
    "follower", FOLLOWERS, ids=lambda follower: f"{follower.kind} {getattr(follower, 'offset', '')}"
)
def test_a_cam_with_unlike_flanks_moves_its_follower_as_its_points_do(follower, rotation):
    loop = arc_loop(lopsided_points(0.1)[::-1])
    assert loop is not None
    assert [round(part.radius, 6) for part in loop.arcs(1)] == [90.0, 12.0, math.inf, 30.0]
    motion, phi = gc.outline_motion(loop, follower, rotation), np.linspace(0, 2 * math.pi, 61)
    arm = getattr(follower, "arm", 1.0)
    miss = arm * (laid(lopsided_points(0.005), follower, phi, rotation, 30.0) - motion(phi - motion.origin)[0])
    assert np.abs(miss).max() < LAID_ON
    # The acceleration jumps where the parts meet, four times a turn, and the velocity does not.
    _, v, a, _ = motion(motion.breaks, side="left")
    right = motion(motion.breaks, side="right")
    assert np.abs(right[1] - v).max() < 1e-6
    assert np.sum(np.abs(right[2] - a) > 0.05 * np.abs(a).max()) >= 4


def test_a_flat_face_on_a_straight_flank_is_refused_by_the_outline():
    with pytest.raises(gc.DesignError, match="outline is straight"):
        gc.outline_motion(arc_loop(lopsided_points(0.1)[::-1]), gc.FlatFaced())


@pytest.mark.parametrize("law", ["cycloidal", "3-4-5", "cosine", "modified-sine"])
@pytest.mark.parametrize("count", [90, 720, 5000])
def test_other_cams_are_no_arcs(law, count):
    rise, back = (kind(15, 2.0, law) for kind in (gc.Rise, gc.Return))
    motion = gc.Motion([rise, gc.Dwell(1.0), back, gc.Dwell(2 * math.pi - 5)])
    cam = gc.Cam(motion, gc.Translating(roller_radius=8), prime_radius=40)
    points = cam.profile(np.linspace(0, 2 * math.pi, count, endpoint=False)) @ [1, 1j]
    assert arc_loop(points[::-1]) is None
    assert arc_loop(np.round(points[::-1], 3)) is None


def test_a_corner_or_a_disc_about_the_cam_centre_is_no_loop_of_arcs():
    around = np.exp(1j * np.linspace(0, 2 * math.pi, 400, endpoint=False))
    assert arc_loop(30 * around) is None
    lens = 40 * np.exp(1j * np.linspace(-0.7, 0.7, 100)) - 25
    assert arc_loop(np.concatenate([lens[:-1], -lens[:-1]])) is None
    square = np.concatenate([20j**k * (1 + 1j + 2j * np.arange(50) / 50) for k in range(4)])
    assert arc_loop(square) is None


def test_a_task_keeps_the_jumps_of_a_drawing_whose_tolerance_it_does_not_need(tmp_path):
    rows = "".join(f"{z.real!r},{z.imag!r}\n" for z in lopsided_points(0.3).tolist())
    (tmp_path / "cam.csv").write_text("x_mm,y_mm\n" + rows, encoding="utf-8")
    text = 'rotation = "ccw"\n[outline]\nfile = "cam.csv"\ntolerance = 0.05\n'
    (tmp_path / "cam.toml").write_text(
        text + '[follower]\nkind = "translating"\nroller_radius = 10\n', encoding="utf-8"
    )
    task = gc.load_task(tmp_path / "cam.toml")
    assert isinstance(task, Task)
    solution = gc.solve(replace(task))
    assert solution.cam.extremes().min_convex_radius.value == pytest.approx(22, rel=1e-6)
