"""The files of the exact profile, read back."""

from __future__ import annotations

import csv
import math

import ezdxf
import numpy as np
import pytest
from numpy.testing import assert_allclose

from graphcam.given.follower import Translating
from graphcam.given.motion import Dwell, Motion, Return, Rise
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.profile_spline import profile_spline
from graphcam.workshop.profile_files import PROFILE_POINTS, write_curves

DEG = math.pi / 180
MOTION = Motion([Rise(30, 60 * DEG), Dwell(30 * DEG), Return(30, 60 * DEG), Dwell(210 * DEG)])
LAST_DIGIT = 0.51e-9


@pytest.fixture(params=[(5.0, 12.0, 60.0), (5.0, 20.0, 30.0)], ids=["sound", "undercut"])
def cam(request):
    offset, roller, r0 = request.param
    return Cam(MOTION, Translating(offset, roller), r0)


def test_the_table_holds_the_profile_and_its_polar_coordinates(cam, tmp_path):
    write_curves(cam, profile_spline(cam, trimmed=True), tmp_path)
    with (tmp_path / "profile.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == PROFILE_POINTS
    phi, x, y, radius, angle = (
        np.array([float(row[name]) for row in rows]) for name in ("phi_deg", "x", "y", "radius", "angle_deg")
    )
    assert_allclose(np.stack([x, y], axis=1), cam.trimmed_profile(PROFILE_POINTS), rtol=0, atol=LAST_DIGIT)
    assert_allclose(radius * np.exp(1j * angle * DEG), x + 1j * y, rtol=0, atol=1e-8)
    assert_allclose(np.stack([x, y], axis=1), cam.profile(phi * DEG), rtol=0, atol=1e-8)  # a corner is on its branch


def test_the_curve_file_is_closed_and_flat(cam, tmp_path):
    write_curves(cam, profile_spline(cam, trimmed=True), tmp_path)
    lines = (tmp_path / "profile.xyz").read_text(encoding="ascii").splitlines()
    points = np.array([[float(number) for number in line.split("\t")] for line in lines])
    assert points.shape == (PROFILE_POINTS + 1, 3)
    assert np.all(points[:, 2] == 0)
    assert lines[0] == lines[-1]
    assert_allclose(points[:-1, :2], cam.trimmed_profile(PROFILE_POINTS), rtol=0, atol=LAST_DIGIT)


def test_the_dxf_holds_one_clamped_spline_in_mm(cam, tmp_path):
    write_curves(cam, profile_spline(cam, trimmed=True), tmp_path)
    document = ezdxf.readfile(tmp_path / "profile.dxf")
    assert document.units == ezdxf.units.MM
    assert not document.audit().errors
    (spline,) = document.modelspace()
    assert spline.dxftype() == "SPLINE"
    assert spline.dxf.degree == 3
    assert not spline.weights
    exact = profile_spline(cam, trimmed=True)
    assert_allclose(np.array(spline.control_points)[:, :2], exact.control, rtol=0, atol=1e-12)
    assert_allclose(spline.knots, exact.knots, rtol=0, atol=1e-12)
    # As another program reads it: its curve is the profile.
    tool = spline.construction_tool()
    read = np.array([tuple(p)[:2] for p in tool.points(np.linspace(0, exact.knots[-1], 50))])
    assert_allclose(read, exact(np.linspace(0, exact.knots[-1], 50)), rtol=0, atol=1e-9)


def test_the_same_cam_makes_the_same_files(cam, tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        names = write_curves(cam, profile_spline(cam, trimmed=True), tmp_path / folder)
    for name in names.values():
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
