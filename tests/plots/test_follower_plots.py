"""Plots of elastic followers: the curves are the values, with both sides of every jump, and what is lost is marked."""

from __future__ import annotations

import math

import numpy as np
import pytest
from matplotlib.figure import Figure

import graphcam as gc

TRAIN = gc.FollowerTrain(mass=0.5, stiffness=2000, damping=0.05, spring=20, preload=200)


@pytest.fixture(scope="module")
def motion():
    return gc.builtin_task().motion()


def drawn(axes, label):
    return next(line for line in axes.lines if line.get_label() == label).get_xydata().T


def test_the_curves_of_a_spectrum_are_its_values():
    spectrum = gc.shock_spectrum("cycloidal", [3.5, 1.0, 2.0, 0.5])
    axes = spectrum.plot(ax=Figure().add_subplot())
    order = np.argsort(spectrum.n)
    for label, values in (("during the rise (primary)", spectrum.primary), ("in the dwell", spectrum.residual)):
        (line,) = [line for line in axes.lines if line.get_label().startswith(label)]
        n, height = line.get_xydata().T
        assert n.tolist() == [0.5, 1.0, 2.0, 3.5]
        assert height.tolist() == values[order].tolist()
    assert axes.get_title() == "Shock spectrum, cycloidal, without damping"
    assert axes.get_ylim()[1] > spectrum.maximum.max()
    assert axes.get_xscale() == "linear"


def test_ratios_over_many_decades_stand_on_logarithms_and_a_single_one_is_a_point():
    assert gc.shock_spectrum("cosine", [0.01, 1, 100]).plot(ax=Figure()).get_xscale() == "log"
    axes = gc.shock_spectrum("cosine", 1.0, 0.1).plot(ax=Figure())
    assert axes.lines[-1].get_marker() == "o"
    assert "damping ratio 0.1" in axes.get_title()


def test_the_curves_of_a_response_are_its_values_with_both_sides_of_every_jump():
    response = gc.follower_response("rectangular", 5.3)
    axes = response.plot(ax=Figure())
    upper, lower = axes.child_axes
    for diagram, k in ((upper, 0), (lower, 2)):
        u, mass = drawn(diagram, "mass")
        np.testing.assert_allclose(mass, response(u)[k], rtol=0, atol=1e-12)
        assert u.min() <= 0
        assert u.max() > 1.5
    u, a = drawn(lower, "cam")
    assert a[np.isclose(u, 0.5)].tolist() == pytest.approx([4, -4])
    assert a[np.isclose(u, 1.0)].tolist() == pytest.approx([-4, 0])
    assert a[np.isclose(u, 0.0)].tolist()[0] == 0


@pytest.mark.parametrize(("rpm", "lost"), [(600, True), (100, False)])
def test_the_curves_of_a_turn_are_its_values_and_lost_contact_is_marked(motion, rpm, lost):
    follower = gc.VibratingFollower(motion, TRAIN, rpm)
    axes = follower.plot(ax=Figure())
    upper, lower = axes.child_axes
    phi, a = drawn(upper, "mass")
    np.testing.assert_allclose(a, follower(np.radians(phi)).a, atol=1e-8 * np.abs(a).max())
    phi, force = drawn(lower, "force on the cam")
    np.testing.assert_allclose(force, follower(np.radians(phi)).force, atol=1e-8 * np.abs(force).max())
    # So dense that a vibration keeps its height.
    assert force.min() == pytest.approx(follower.min_force().value, abs=0.01 * np.ptp(force))
    marked = [patch for patch in lower.patches if patch.get_label() == "contact is lost"]
    assert bool(marked) == lost
    if lost:
        assert marked[0].get_x() == pytest.approx(math.degrees(follower.lost()[0][0]))
    axes.figure.canvas.draw()


def test_a_notebook_shows_all_three(motion):
    shown = gc.shock_spectrum("cosine"), gc.follower_response(motion, 3.2), gc.VibratingFollower(motion, TRAIN, 600)
    for value in shown:
        assert value._repr_svg_().startswith("<?xml")
