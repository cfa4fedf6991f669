"""Cams through points of their outline: against cams by radii in closed form, round trips, and what cannot be.

``python tests/random_cases.py tests/given/test_point_outline.py --cases 300 --seed 1000`` tries as many as asked.
"""

import math

import numpy as np
import pytest
from over_all import over_all, over_seeds
from test_outline_motion import outline_points, random_cam

import graphcam as gc
from graphcam.given.point_outline import trace
from graphcam.tasks.task_writer import task_files

CLOSE = 1.5e-4
"""How far s may lie from that of the arcs, as a part of the lift: where their acceleration jumps points smooth it."""
CLOSE_SLOPE = 0.02
"""How far v may lie from that of the arcs, as a part of its maximum."""
ROUND = np.radians(np.arange(0, 360, 1.0))


def points_of(cam, follower, rotation, count):
    """(count,) points at equal lengths along a cam by radii, as it lies at the cam angle 0."""
    if isinstance(follower, gc.OscillatingFlat):
        start = 1j * np.exp(-1j * math.asin((cam.base_radius + follower.face_offset) / follower.distance))
    else:
        way = None if isinstance(follower, gc.FlatFaced) else trace(follower, cam.base_radius)
        start = 1j if way is None else complex(way.position(way.prime_radius)) / way.prime_radius
    z = outline_points(cam)
    z = start * (z if rotation == "ccw" else z.conj())
    along = np.append(0, np.cumsum(np.abs(np.diff(z))))
    kept = np.append(True, np.diff(along) > 0)
    at = np.linspace(0, along[-1], count, endpoint=False)
    return np.interp(at, along[kept], z.real[kept]) + 1j * np.interp(at, along[kept], z.imag[kept])


def faults_of_case(seed):
    """What is wrong with the motion through points of one random cam; None where there is no such cam."""
    rng = np.random.default_rng(seed)
    found = random_cam(rng)
    if found is None:
        return None
    cam, follower, rotation, exact = found
    points = points_of(cam, follower, rotation, 720)
    points = points[:: int(rng.choice([1, -1]))]
    motion = gc.outline_motion(gc.cam_through_points(points), follower, rotation)
    phi = np.linspace(0, 2 * math.pi, 1441)
    s, v = motion(phi - motion.zero)[:2]
    there, slope = exact(phi)[:2]
    off = [f"s is off by {part:.1e} of the lift"] if (part := np.abs(s - there).max() / exact.lift) > CLOSE else []
    part = np.abs(v - slope).max() / np.abs(slope).max()
    off += [f"v is off by {part:.1e} of its maximum"] if part > CLOSE_SLOPE else []
    size = abs(motion.prime_radius - exact.prime_radius)
    return off + ([f"the prime radius is off by {size:.1e} mm"] if size > 1e-4 else [])


@over_seeds(4)
def test_points_of_a_cam_by_radii_move_the_follower_as_its_arcs_do(seed):
    assert not faults_of_case(seed)


def test_the_profile_of_a_cam_gives_its_motion_back():
    phases = [gc.Rise(20, 1.5, "3-4-5"), gc.Dwell(0.5), gc.Return(20, 1.8, "cycloidal"), gc.Dwell(2 * math.pi - 3.8)]
    phi = np.linspace(0, 2 * math.pi, 1080, endpoint=False)
    for follower in (gc.Translating(8, 10), gc.Oscillating(60, 80, 10)):
        lift = 20 if isinstance(follower, gc.Translating) else 0.3
        given = gc.Motion([type(p)(lift, p.angle, p.law) if p.direction else p for p in phases])
        cam = gc.Cam(given, follower, 45.0, "cw")
        points = cam.profile(phi)
        back = gc.outline_motion(gc.cam_through_points(points), follower, "cw")
        s, v, a, _ = back(phi - back.zero)
        there = given(phi)
        assert np.abs(s - there[0]).max() < 2e-5 * lift
        assert np.abs(v - there[1]).max() < 2e-3 * np.abs(there[1]).max()
        assert np.abs(a - there[2]).max() < 0.05 * np.abs(there[2]).max()
        assert back.prime_radius == pytest.approx(45.0, abs=1e-4)


def test_an_eccentric_disc_is_exact():
    e, r, roller = 6.0, 30.0, 12.0
    points = 1j * (r * np.exp(1j * ROUND) + e)  # the farthest point on top
    motion = gc.outline_motion(gc.cam_through_points(points), gc.Translating(roller_radius=roller), "ccw")
    phi = np.linspace(0, 2 * math.pi, 361)
    there = e * np.cos(phi) + np.sqrt((r + roller) ** 2 - (e * np.sin(phi)) ** 2)
    assert np.abs(motion(phi - motion.zero)[0] - (there - (r + roller - e))).max() < 1e-5


def test_a_measured_outline_is_smoothed_within_its_tolerance():
    rng = np.random.default_rng(7)
    clean = 1j * (30 * np.exp(1j * ROUND) + 5)
    noisy = clean * (1 + 0.004 / 30 * rng.standard_normal(clean.size))
    exact = gc.outline_motion(gc.cam_through_points(clean), gc.Translating(roller_radius=10))
    found = gc.outline_motion(gc.cam_through_points(noisy), gc.Translating(roller_radius=10), tolerance=0.03)
    phi = np.linspace(0, 2 * math.pi, 721)
    assert np.abs(found(phi - found.zero)[0] - exact(phi - exact.zero)[0]).max() < 0.03
    assert [phase.kind for phase in found.phases] == [phase.kind for phase in exact.phases]


def test_a_roller_fits_a_hollow_as_long_as_it_is_smaller():
    """Four lobes r = 30 + 6 cos 4 x: the hollow has the radius r^2/(16 x 6 - r) at r = 24."""
    points = (30 + 6 * np.cos(4 * ROUND)) * np.exp(1j * ROUND)
    cam, hollow = gc.cam_through_points(points), 24**2 / (16 * 6 - 24)
    assert gc.outline_motion(cam, gc.Translating(roller_radius=0.85 * hollow)).lift == pytest.approx(12, abs=0.01)
    with pytest.raises(gc.DesignError, match=r"roller radius is 9\.5, but must be at most (7\.9|8\.0)\d* mm"):
        gc.outline_motion(cam, gc.Translating(roller_radius=9.5))
    with pytest.raises(gc.DesignError, match="outline is hollow at"):
        gc.outline_motion(cam, gc.FlatFaced())


DISC = 3 + 30 * np.exp(1j * ROUND)


def swapped(points):
    points = points.copy()
    points[[20, 21]] = points[[21, 20]]
    return points


@over_all(
    ("points", "said"),
    [
        (DISC + 80, "outline is beside the cam centre"),
        (DISC[:300], "gap between the last point and the first is 30.45 mm"),
        (DISC[299::-1], "gap between the last point and the first is 30.45 mm"),
        (swapped(DISC), "point is .* one after the other round the cam centre"),
        (DISC[:8], "number of points is 8"),
        (np.full(20, np.nan), "point is nan"),
        (DISC * 1e5, "point is"),
        (np.zeros(20), "outline is beside"),
        ("abc", "points is not of numbers"),
        (np.ones((20, 3)), "points is not of numbers"),
        (30 * np.exp(1j * ROUND), "round about the cam centre"),
    ],
)
def test_points_that_are_no_cam_are_told(points, said):
    with pytest.raises(gc.DesignError, match=said):
        gc.outline_motion(gc.cam_through_points(points), gc.Translating(roller_radius=10))


@over_all(
    ("head", "unit"),
    [
        *[("x_mm,y_mm", 1.0), ("X;Y", 1.0), ("x_in\ty_in", 25.4), ("no,x,y,z", 1.0), ("angle_deg,radius_mm", None)],
        *[("X (mm)\tY (mm)", 1.0), ("x [cm];y [cm]", 10.0), ("Winkel (°);Radius", None), ("угол,радиус мм", None)],
        *[("theta,rho", None), ("角度(°),半径(mm)", None), ("góc (độ),bán kính (mm)", None)],
    ],
)
def test_tables_of_points_in_files(tmp_path, head, unit):
    between = next(sign for sign in ";\t," if sign in head)
    rows = []
    for k, z in enumerate(1j * DISC):
        first, second = (math.degrees(np.angle(z)), abs(z)) if unit is None else (z.real / unit, z.imag / unit)
        cells = [f"{float(number)!r}" for number in (first, second)]
        rows.append(between.join([str(k), *cells, "0"] if head.startswith("no") else cells))
    (tmp_path / "cam.csv").write_text("\n".join(["# measured", "", head, *rows]), encoding="utf-8")
    task = '[outline]\nfile = "cam.csv"\n[follower]\nkind = "translating"\noffset = 0\nroller_radius = "1 cm"\n'
    (tmp_path / "cam.toml").write_text(task, encoding="utf-8")
    found = gc.load_task(tmp_path / "cam.toml")
    assert found.motion().lift == pytest.approx(6, abs=1e-4)
    assert found.prime_radius == pytest.approx(37, abs=1e-4)
    # What is written reads alike.
    for name, text in task_files(found).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert gc.load_task(tmp_path / "task.toml") == found


@over_all(
    ("task", "said"),
    [
        ("[outline]\nfil = 'cam.csv'", "outline.fil is an unknown key.*did you mean 'file'"),
        ("[outline]\ntolerance = 0.1", "outline.file is missing"),
        ("[outline]\nfile = 3", "outline.file is 3, but must be text"),
        ("[outline]\nfile = 'none.csv'", "there is no file none.csv .*check outline.file"),
        ("[outline]\nfile = 'cam.csv'\n[arcs]\nD = 3", "arcs is a table, but must be left out"),
        ("[outline]\nfile = 'cam.csv'\ntolerance = -1", "outline.tolerance is -1"),
        ("[outline]\nfile = 'motion.csv'", "outline.file is the table of a motion"),
        (
            "[arcs]\nbase_radius = 30\nlift = 9\nD = [1, 2]",
            "arcs is with base_radius and D, but must be given by radii or",
        ),
        (
            "[arcs]\nbase_radius = 30\nlift = 9\n[motion]\nphases = []",
            "motion is a table.*left out where the cam is given",
        ),
        (
            "[arcs]\neccentricity = 8\nradius = 30",
            "arcs is without both, but must be a table with base_radius, or with D",
        ),
        ("[arcs]\nbase_diameter = 60\nlift = 9", "arcs.base_diameter is an unknown key.*write base_radius = 30"),
        ("[outline]\nfile = 'beside.csv'", r"beside\.csv: outline is beside the cam centre"),
        (
            "cam.prime_radius = 40\n[outline]\nfile = 'cam.csv'",
            "cam.prime_radius is 40.*left out where the cam is given",
        ),
    ],
)
def test_files_that_are_no_outline_are_told(tmp_path, task, said):
    text = "".join(f"{z.real},{z.imag}\n" for z in DISC)
    (tmp_path / "cam.csv").write_text(f"x,y\n{text}", encoding="utf-8")
    (tmp_path / "beside.csv").write_text("x,y\n" + "".join(f"{z.real + 90},{z.imag}\n" for z in DISC), encoding="utf-8")
    rows = "".join(f"{x:.0f},{5 - 5 * math.cos(math.radians(x))}\n" for x in range(0, 360, 5))
    (tmp_path / "motion.csv").write_text(f"phi_deg,s_mm\n{rows}", encoding="utf-8")
    follower = "[follower]\nkind = 'translating'\noffset = 0\nroller_radius = 10\n"
    (tmp_path / "cam.toml").write_text(f"{task}\n{follower}", encoding="utf-8")
    with pytest.raises(gc.GraphcamError, match=said):
        gc.load_task(tmp_path / "cam.toml")


def test_an_arm_that_does_not_reach_a_cam_of_points_is_told(tmp_path):
    (tmp_path / "cam.csv").write_text("x,y\n" + "".join(f"{z.real},{z.imag}\n" for z in DISC), encoding="utf-8")
    follower = "[follower]\nkind = 'oscillating'\narm = 30\ndistance = 200\nroller_radius = 10\n"
    (tmp_path / "cam.toml").write_text(f"[outline]\nfile = 'cam.csv'\n{follower}", encoding="utf-8")
    with pytest.raises(gc.GraphcamError, match=r"base radius is \d.*, but must be between 170 and 230 mm"):
        gc.load_task(tmp_path / "cam.toml")
