"""The box of the turning mechanism holds all that shows in any position."""

from __future__ import annotations

import numpy as np
import pytest

import graphcam as gc
from graphcam.report.documents import scene_of
from graphcam.report.mechanism_view import mechanism_view
from graphcam.tasks.task_file import task_from


@pytest.mark.parametrize("name", ["coursework", "arm", "flat", "swinging-face", "measured", "arcs"])
def test_the_pitch_curve_and_the_profile_stay_in_the_box_over_the_turn(name):
    scene = scene_of(gc.solve(gc.builtin_arcs_task() if name == "arcs" else gc.builtin_task(name)))
    data = mechanism_view(scene, str)
    left, top, width, height = data["box"]
    turn = np.exp(1j * np.linspace(0, 2 * np.pi, 73))
    curves = [np.array(data[key]) @ (1, 1j) for key in ("profile", "pitch") if data[key]]
    assert len(curves) == (1 if name in ("flat", "swinging-face") else 2)
    for curve in [*(np.multiply.outer(turn, curve) for curve in curves), scene.trace, scene.contact]:
        assert curve.real.min() > left
        assert curve.real.max() < left + width
        assert -curve.imag.max() > top
        assert -curve.imag.min() < top + height


def test_a_face_that_swings_reaches_from_its_pivot_to_the_farthest_contact():
    scene = scene_of(gc.solve(gc.builtin_task("swinging-face")))
    foot = scene.pivot - 10.0 * scene.normal  # the offset of the face, towards the cam
    along = ((scene.contact - foot) * np.conj(1j * scene.normal)).real
    assert np.abs(foot + along * 1j * scene.normal - scene.contact).max() < 1e-9
    assert (along.min(), along.max()) == pytest.approx(scene.face, abs=0.01)
    assert np.abs((scene.motion * np.conj(scene.contact - scene.pivot)).real).max() < 1e-9


@pytest.mark.parametrize("name", ["coursework", "arm", "flat", "swinging-face", "measured", "arcs"])
def test_the_radius_of_curvature_is_the_length_of_the_profile_by_the_turning_of_its_normal(name):
    scene = scene_of(gc.solve(gc.builtin_arcs_task() if name == "arcs" else gc.builtin_task(name)))
    on_cam = np.exp(-1j * scene.sigma * scene.phi)
    profile, normal = scene.contact * on_cam, scene.normal * on_cam
    # The cam is run round against its rotation.
    along = -scene.sigma * 1j * normal
    length = ((profile[2:] - profile[:-2]) * np.conj(along[1:-1])).real
    turned = -scene.sigma * np.angle(normal[2:] / normal[:-2])
    sharp = 1 / scene.rho
    # The curvature changes between the two places, most where the acceleration jumps.
    changed = np.maximum(np.abs(sharp[2:] - sharp[1:-1]), np.abs(sharp[1:-1] - sharp[:-2]))
    assert (np.abs(turned - length * sharp[1:-1]) <= 1e-5 + np.abs(length) * changed).all()
    assert np.median(np.abs(turned)) > 50 * np.median(np.abs(length) * changed)
    data = mechanism_view(scene, str)
    assert data["arrays"]["curvature_radius"][100] == pytest.approx(scene.rho[100], abs=1e-3)


def test_what_is_cut_away_has_no_radius_of_curvature():
    whole = gc.builtin_task().to_dict()
    follower = whole["follower"] | {"roller_radius": 34.0}
    rho = scene_of(gc.solve(task_from(whole | {"cam": {"prime_radius": 44.0}, "follower": follower}))).rho
    assert 0 < np.isnan(rho).mean() < 0.2
