"""The outer wall of a groove and the second cam of a conjugate pair: against circles along paths laid by hand."""

from __future__ import annotations

import csv
import math

import ezdxf
import numpy as np
import pytest
from over_all import over_all, over_seeds
from scipy.spatial import KDTree
from test_translating import random_cam

import graphcam as gc

TURN = np.linspace(0, math.tau, 40_001)
SOME = np.linspace(0, math.tau, 97, endpoint=False)


def rocker(rotation: str = "ccw") -> gc.Cam:
    swing = math.radians(18)
    motion = gc.Motion(
        [gc.Rise(swing, 1.9), gc.Dwell(0.7), gc.Return(swing, 2.1, "cycloidal"), gc.Dwell(math.tau - 4.7)]
    )
    return gc.Cam(motion, gc.Oscillating(arm=90, distance=110, roller_radius=9), 55, rotation)


def stem(rotation: str = "ccw") -> gc.Cam:
    motion = gc.Motion([gc.Rise(18, 1.9), gc.Dwell(0.7), gc.Return(18, 2.1, "cycloidal"), gc.Dwell(math.tau - 4.7)])
    return gc.Cam(motion, gc.Translating(offset=8, roller_radius=9), 50, rotation)


def path_of(cam: gc.Cam, at: complex) -> np.ndarray:
    """Where a point of the follower goes on the cam, as complex numbers: slid along y, or turned about the pivot."""
    s = cam.motion(TURN)[0]
    if isinstance(cam.follower, gc.Oscillating):
        pivot = cam.follower.distance
        seen = pivot + (at - pivot) * np.exp(-1j * s)
    else:
        seen = at + 1j * s
    return seen * np.exp(-1j * (1 if cam.rotation == "ccw" else -1) * TURN)


def nearest(points: np.ndarray, path: np.ndarray) -> np.ndarray:
    tree = KDTree(np.column_stack([path.real, path.imag]))
    return tree.query(points)[0]


EVERY = over_all(("made", "at"), [(stem, 8 - 62j), (rocker, 12 - 60j), (stem, -3 - 80j), (rocker, 30 - 75j)])


@EVERY
@over_all("rotation", ["ccw", "cw"])
def test_the_second_roller_touches_its_cam_all_the_way(made, at, rotation):
    """Every point of the profile lies a roller's radius from the path of its centre, and inside of it."""
    cam = made(rotation)
    second, path = gc.ConjugateCam(cam, (at.real, at.imag), 11.0), path_of(cam, at)
    profile = second.profile(SOME)
    assert np.allclose(nearest(profile, path), 11.0, atol=2e-5)
    assert np.allclose(second.pitch_curve(TURN[::1000]) @ [1, 1j], path[::1000], atol=1e-11)
    assert np.all(np.hypot(*profile.T) < np.hypot(*second.pitch_curve(SOME).T))


@EVERY
def test_the_least_radius_is_that_of_the_bent_path(made, at):
    """By differences of the path laid by hand; where the acceleration does not jump."""
    cam = made()
    path, step = path_of(cam, at), TURN[1]
    first, bent = (path[2:] - path[:-2]) / (2 * step), (path[2:] - 2 * path[1:-1] + path[:-2]) / step**2
    curvature = -(first.conj() * bent).imag / np.abs(first) ** 3
    found = gc.ConjugateCam(cam, (at.real, at.imag), 1.0).min_convex_radius
    assert found.value == pytest.approx(1 / curvature.max(), rel=2e-4)


def test_of_equal_breadth_both_cams_are_one():
    """s(phi + pi) = lift - s(phi): the second profile is the first, seen from the other side, for any distance."""
    motion = gc.Motion([gc.Rise(24, math.pi, "cycloidal"), gc.Return(24, math.pi, "cycloidal")])
    cam = gc.Cam(motion, gc.Translating(offset=0, roller_radius=7), 45)
    second = gc.ConjugateCam(cam, (0, -(45 + 24)), 7)
    assert np.allclose(second.profile(SOME), cam.profile(SOME + math.pi), atol=1e-12)


@over_all(
    ("change", "said"),
    [
        ({"at": (8, 90)}, "at is \\(8, 90\\), but must be where the second cam pushes the follower back to the first"),
        ({"roller_radius": 500.0}, "roller_radius is 500.0, but must be less than"),
        ({"roller_radius": -1.0}, "roller_radius is -1.0, but must be a finite length of 0 mm or more"),
        ({"at": (math.nan, -60)}, "at is nan, but must be two finite coordinates in mm"),
        ({"cam": gc.Cam(stem().motion, gc.FlatFaced(), 60)}, "follower is 'flat-faced', but must be one with a roller"),
    ],
)
def test_what_is_no_pair_is_refused(change, said):
    with pytest.raises(gc.DesignError, match=said):
        gc.ConjugateCam(**{"cam": stem(), "at": (8, -62), "roller_radius": 9.0} | change)


@over_seeds(5)
def test_the_outer_wall_of_a_groove_lies_a_roller_outside_of_the_pitch_curve(seed):
    cam = random_cam(seed)
    cam = gc.Cam(cam.motion, gc.Translating(cam.follower.offset, 2.0), cam.prime_radius + 10, cam.rotation)
    path = cam.pitch_curve(TURN) @ [1, 1j]
    wall = cam.profile(SOME, side="outer")
    assert np.allclose(nearest(wall, path), 2.0, atol=1e-4)
    assert np.all(np.hypot(*wall.T) > np.hypot(*cam.pitch_curve(SOME).T))
    assert np.allclose(np.hypot(*(wall - cam.profile(SOME)).T), 4.0, atol=1e-12)


def test_a_roller_too_large_for_a_hollow_has_no_outer_wall():
    motion = gc.Motion([gc.Rise(60, 0.8, "cycloidal"), gc.Return(60, 0.8, "cycloidal"), gc.Dwell(math.tau - 1.6)])
    cam = gc.Cam(motion, gc.Translating(roller_radius=20), 60)
    path = cam.pitch_curve(TURN) @ [1, 1j]
    step = TURN[1]
    first, bent = (path[2:] - path[:-2]) / (2 * step), (path[2:] - 2 * path[1:-1] + path[:-2]) / step**2
    hollow = 1 / ((first.conj() * bent).imag / np.abs(first) ** 3).max()
    assert 0 < hollow < 20
    with pytest.raises(gc.DesignError, match=f"roller radius is 20, but must be less than {hollow:.3g}"):
        cam.profile(0, side="outer")
    with pytest.raises(gc.DesignError, match="a groove guides a roller"):
        gc.Cam(motion, gc.Translating(), 60).profile(0, side="outer")


def test_a_groove_is_written_as_two_curves(tmp_path):
    cam = stem()
    made = gc.write_profile(cam, tmp_path, ["csv", "dxf", "xyz"], groove=True)
    assert [path.name for kind, path in made.items() if kind.startswith("outer")] == [
        "profile-outer.csv", "profile-outer.dxf", "profile-outer.xyz",
    ]  # fmt: skip
    with made["outer csv"].open(encoding="utf-8") as file:
        rows = [[float(row[key]) for key in ("phi_deg", "x", "y")] for row in csv.DictReader(file)]
    phi, x, y = np.array(rows).T
    assert np.allclose(np.column_stack([x, y]), cam.profile(np.radians(phi), side="outer"), atol=1e-7)
    (spline,) = ezdxf.readfile(made["outer dxf"]).modelspace().query("SPLINE")
    drawn = np.array([(point.x, point.y) for point in spline.construction_tool().approximate(400)])
    dense = cam.profile(np.linspace(0, math.tau, 400_001), side="outer") @ [1, 1j]
    assert np.allclose(nearest(drawn, dense), 0, atol=2e-3)
    with pytest.raises(gc.DesignError, match="kinds is 'step', but must be of csv, dxf, xyz, for a groove"):
        gc.write_profile(cam, tmp_path, "step", groove=True)


@over_all(("made", "at"), [(stem, 8 - 62j), (rocker, 12 - 60j)])
def test_the_second_cam_is_written_as_the_first_is(tmp_path, made, at):
    """The spline within the deviation that it tells, the cutter's way a cutter's radius outside of the profile."""
    second = gc.ConjugateCam(made(), (at.real, at.imag), 11.0)
    files = gc.write_profile(second, tmp_path, ["csv", "dxf", "step", "gcode"], cutter_radius=8, profile_tolerance=0.01)
    with files["csv"].open(encoding="utf-8") as file:
        phi, x, y = np.array([[float(row[key]) for key in ("phi_deg", "x", "y")] for row in csv.DictReader(file)]).T
    assert np.allclose(np.column_stack([x, y]), second.profile(np.radians(phi)), atol=1e-7)
    (spline,) = ezdxf.readfile(files["dxf"]).modelspace().query("SPLINE")
    drawn = np.array([(point.x, point.y) for point in spline.construction_tool().approximate(400)])
    dense = second.profile(np.linspace(0, math.tau, 400_001)) @ [1, 1j]
    assert gc.profile_spline(second).deviation < 1e-3
    assert np.allclose(nearest(drawn, dense), 0, atol=2e-3)
    ends = [line.split() for line in files["gcode"].read_text().splitlines() if line.startswith(("G2", "G3"))]
    way = np.array([[float(word[1:]) for word in words[1:3]] for words in ends])
    assert np.allclose(nearest(way[:-1], dense), 8, atol=0.01)  # but the last, which leads off
    assert files["step"].stat().st_size > 1000
