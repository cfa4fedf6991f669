"""What is drawn for a flat face: s over a with its tangent, the radii laid off from it, the faces of the inversion."""

from __future__ import annotations

import math
import re
from functools import cache

import numpy as np
import pytest
from boards import flat_board, flat_motion, motion_of
from numpy.testing import assert_allclose

import graphcam as gc
from graphcam.constructions.axes import station_names
from graphcam.constructions.chain import Chain
from graphcam.constructions.flat_inversion import FACE_BEYOND
from graphcam.drafting.acts import Act
from graphcam.drafting.marks import AngleMark, Arrow, Circle, Dimension, Dots, Label, Line, Role, Segments
from graphcam.drafting.pencil import Pencil

SIGMA, MANY, EXACT = 0.2, 6, 1e-9
"""A hand's error [mm]; so many deviations no error of a fixed seed's hand is greater than; rounding [mm]."""
TREMBLING = Pencil(line=SIGMA, dividers=SIGMA, protractor=0.009, seed=5)
BOARDS = {
    "smooth": flat_board(flat_motion("3-4-5")),
    "clockwise": flat_board(flat_motion("cycloidal"), rotation="cw"),
    "jumps": flat_board(flat_motion("rectangular", 1.5), rotation="cw"),
    "corners": flat_board(flat_motion("trapezoidal")),
    "rests": flat_board(motion_of((2, 150, "cosine"), (0, 20), (-2, 150, "cosine")), prime_radius=20.0),
}
EVERY = pytest.mark.parametrize("name", ["the built-in task", *BOARDS])


@cache
def chain(name: str, pencil: Pencil | None = None):
    if name == "the built-in task":
        return gc.solve(gc.builtin_task("flat"), pencil).drawn
    return Chain(BOARDS[name], pencil or Pencil())


def of_kind(step, kind):
    return [mark for mark in step.marks if isinstance(mark, kind)]


def number(caption, pattern: str) -> float:
    """The number that a caption says where the pattern has a group."""
    return float(re.search(pattern, str(caption)).group(1))


def lengths(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """On paper in the scale of s: s, a and a before a jump [mm], and the scale."""
    readings = chain(name)["integration"].readings
    mu = float(readings["s"].scale)
    return *(readings[key].value / mu for key in ("s", "a", "a_before")), mu


def stations(name: str):
    return chain(name)["integration"].givens.stations


def expected_curve(name: str) -> list[np.ndarray]:
    """The ends of the accelerations, stretch by stretch, each up to the near side of the jump at its end."""
    s, a, before, _ = lengths(name)
    found = []
    for stretch in stations(name).stretches:
        across = np.append(a[stretch.start : stretch.stop - 1], before[stretch.stop - 1])
        found.append(across + 1j * s[stretch])
    return found


# --- the displacement over the acceleration --------------------------------------------------------------------------


@EVERY
def test_every_acceleration_is_laid_off_level_at_its_displacement_in_the_scale_of_s(name):
    step = chain(name)["minimum_radius"].steps()[0]
    laid_off = of_kind(step, Segments)
    assert_allclose(np.concatenate([lines.starts.real for lines in laid_off]), 0, atol=EXACT)
    for lines in laid_off:
        assert_allclose(lines.starts.imag, lines.ends.imag, atol=EXACT)
    ends, wanted = np.concatenate([lines.ends for lines in laid_off]), np.concatenate(expected_curve(name))
    apart = np.abs(ends[:, None] - wanted[None, :])
    assert apart.min(axis=0).max() < EXACT
    assert apart.min(axis=1).max() < EXACT
    assert number(step.caption, r"longest measures ([\d.]+) mm") == pytest.approx(np.abs(wanted.real).max(), abs=0.051)
    assert (len(laid_off) == 2) == (name == "jumps")


@EVERY
def test_smooth_curves_join_the_ends_between_jumps_and_corners_and_bear_their_first_station(name):
    step = chain(name)["minimum_radius"].steps()[0]
    curves = [line for line in of_kind(step, Line) if line.role is Role.RESULT]
    assert len(curves) == len(stations(name).stretches)
    names = station_names(stations(name))
    labels = of_kind(step, Label)[2:]
    for curve, places, label, stretch in zip(
        curves, expected_curve(name), labels, stations(name).stretches, strict=True
    ):
        assert_allclose(curve.points[[0, -1]], places[[0, -1]], atol=EXACT)
        assert np.abs(places[:, None] - curve.points[None, :]).min(axis=1).max() < EXACT
        assert label.text == names[stretch.start]
        assert label.at == pytest.approx(complex(places[0]), abs=EXACT)
        assert label.towards == np.sign(round(places[0].real, 9))  # away from the axis


@EVERY
def test_a_dwell_is_a_point_of_the_axis_at_its_displacement(name):
    integration = chain(name)["integration"]
    (dots,) = of_kind(chain(name)["minimum_radius"].steps()[0], Dots)
    motion, mu = integration.givens.motion, float(integration.readings["s"].scale)
    levels = [motion.levels[k] / mu for k, phase in enumerate(motion.phases) if phase.kind == "dwell"]
    assert_allclose(dots.points.real, 0, atol=EXACT)
    assert_allclose(np.sort(dots.points.imag), np.sort(levels), atol=1e-6)


@EVERY
def test_the_axes_of_s_and_a_reach_beyond_all_that_is_drawn(name):
    region = chain(name)["minimum_radius"]
    up, across = of_kind(region.steps()[0], Arrow)
    curve = np.concatenate(expected_curve(name))
    centre, zero = of_kind(region.steps()[2], Dots)[0].points[0], of_kind(region.steps()[1], Dots)[0].points[1]
    assert up.start == pytest.approx(1j * (min(centre.imag, zero.imag) - 8), abs=EXACT)
    assert up.end == pytest.approx(1j * (curve.imag.max() + 8))
    assert (across.start, across.end) == (pytest.approx(curve.real.min()), pytest.approx(curve.real.max() + 8))
    s, a = of_kind(region.steps()[0], Label)[:2]
    assert [(s.text, s.at, s.towards), (a.text, a.at, a.towards)] == [("s", up.end, -1), ("a", across.end, -1j)]


# --- the tangent and the radii ---------------------------------------------------------------------------------------


def sums_drawn(name: str, shown) -> list[list[float]]:
    """The sums of s and a at the plotted points of each smooth curve, and of each dwell."""
    found = []
    for curve, stretch in zip(of_kind(shown, Line), stations(name).stretches, strict=True):
        # A faired curve has eight chords a part, but through two points it is one.
        parts = stretch.stop - stretch.start - 1
        plotted = curve.points[:: 8 if parts > 1 else 1]
        assert plotted.size == parts + 1
        found.append(list(plotted.real + plotted.imag))
    return found + [[float(place.imag)] for place in of_kind(shown, Dots)[0].points]


def lowest_of(sums: list[float]) -> float:
    """The bottom of the parabola through the lowest of equally counted values and its neighbours."""
    k = int(np.argmin(sums))
    if len(sums) < 3:
        return sums[k]
    a, b, c = sums[min(max(k, 1), len(sums) - 2) - 1 :][:3]
    bend, slope = a - 2 * b + c, (c - a) / 2
    return b - slope**2 / (2 * bend) if bend > 0 and abs(slope / bend) <= 1 else sums[k]


@EVERY
@pytest.mark.parametrize("pencil", [None, TREMBLING], ids=["perfect", "hand"])
def test_the_tangent_leans_by_45_degrees_touches_the_curve_and_crosses_it_nowhere(name, pencil):
    region = chain(name, pencil)["minimum_radius"]
    shown, step = region.steps()[:2]
    (line,), (dots,), (angle,) = (of_kind(step, kind) for kind in (Line, Dots, AngleMark))
    touch, zero = dots.points
    for way in (line.points[1] - line.points[0], *(line.points - touch)):
        assert abs(way.real + way.imag) < EXACT  # places of equal s + a
    # From above its touch to beyond the axis.
    assert line.points[0] - touch == pytest.approx(-12 + 12j)
    assert line.points[1] - zero == pytest.approx(16 - 16j)
    assert abs(zero.real) < EXACT
    assert zero.imag == pytest.approx(touch.real + touch.imag, abs=EXACT)
    lowest = [lowest_of(sums) for sums in sums_drawn(name, shown)]
    assert zero.imag == pytest.approx(min(lowest), abs=MANY * SIGMA if pencil else EXACT)
    # Between the plotted points the faired curve leaves the parabola of the touch by a small part.
    faired = np.concatenate([mark.points for mark in of_kind(shown, Line)])
    assert (faired.real + faired.imag).min() > zero.imag - (0.01 * abs(zero.imag) + (MANY * SIGMA if pencil else EXACT))
    assert angle.centre == pytest.approx(complex(zero), abs=EXACT)
    assert (angle.start, angle.end) == (pytest.approx(-math.pi / 2), pytest.approx(-math.pi / 4))
    assert math.degrees(angle.end - angle.start) == pytest.approx(float(str(angle.text).rstrip("°")))
    assert angle.radius < abs(line.points[1] - zero)
    mu = float(np.ravel(region.readings["need"].scale)[0])
    assert number(step.caption, r"axis of s at (-?[\d.]+) mm") == pytest.approx(zero.imag, abs=0.0051)
    assert number(step.caption, r"is (-?[\d.]+) mm") == pytest.approx(-zero.imag * mu, abs=0.00051)
    assert float(region.readings["need"].paper) == pytest.approx(-zero.imag, abs=EXACT)


@EVERY
@pytest.mark.parametrize("pencil", [None, TREMBLING], ids=["perfect", "hand"])
def test_the_cam_centre_lies_the_least_radius_below_the_start_of_the_lift(name, pencil):
    region = chain(name, pencil)["minimum_radius"]
    step, mu = region.steps()[2], float(np.ravel(region.readings["need"].scale)[0])
    (dot,), (label,), (measure,) = (of_kind(step, kind) for kind in (Dots, Label, Dimension))
    centre, zero = complex(dot.points[0]), complex(of_kind(region.steps()[1], Dots)[0].points[1])
    least, slack = region.givens.least_curvature, MANY * SIGMA if pencil else EXACT
    r0 = least - zero.imag * mu
    assert centre == pytest.approx(-1j * r0 / mu, abs=slack)
    assert abs(centre.real) < EXACT
    assert (label.text, label.at) == ("A", centre)
    assert label.towards.imag < 0 < label.towards.real
    assert (measure.start, measure.end) == (0, centre)
    assert number(measure.text, r"r₀ = ([\d.]+)") == pytest.approx(r0, abs=0.0051)
    assert abs(measure.end - measure.start) * mu == pytest.approx(r0, abs=slack * mu + EXACT)
    # Left of the axis, on the side where the tangent does not run: the way down has its left on the right.
    assert measure.aside < 0
    said = [float(each) for each in re.findall(r"-?\d+\.?\d*", str(step.caption))]
    assert said == [pytest.approx(least), pytest.approx(-zero.imag * mu, abs=0.00051), pytest.approx(r0, abs=0.00051)]


@EVERY
@pytest.mark.parametrize("pencil", [None, TREMBLING], ids=["perfect", "hand"])
def test_the_least_radius_of_curvature_reaches_from_the_adopted_centre_to_the_tangent(name, pencil):
    drawn = chain(name, pencil)
    curved, region = drawn["curvature"], drawn["minimum_radius"]
    (step,), mu = curved.steps(), float(np.ravel(region.readings["need"].scale)[0])
    (dot,), (measure,) = of_kind(step, Dots), of_kind(step, Dimension)
    zero, slack = complex(of_kind(region.steps()[1], Dots)[0].points[1]), MANY * SIGMA if pencil else EXACT
    r0 = curved.givens.prime_radius
    assert dot.points[0] == pytest.approx(-1j * r0 / mu, abs=slack)
    assert (measure.start, measure.end) == (dot.points[0], zero)
    rho = abs(measure.end - measure.start) * mu
    assert number(measure.text, r"ρ = (-?[\d.]+)") == pytest.approx(rho, abs=0.0051)
    assert number(step.caption, r"profile, (-?[\d.]+) mm") == pytest.approx(rho, abs=0.00051)
    assert number(step.caption, r"r₀ = ([\d.]+) mm") == pytest.approx(r0)
    assert float(np.ravel(curved.readings["rho"].value)[0]) == pytest.approx(rho, abs=1e-7)
    # Beside the dimension of r0, not on it.
    assert measure.aside < of_kind(region.steps()[2], Dimension)[0].aside - 2


# --- the inversion ---------------------------------------------------------------------------------------------------


@EVERY
@pytest.mark.parametrize("pencil", [None, TREMBLING], ids=["perfect", "hand"])
def test_the_rays_turn_against_the_rotation_and_carry_the_prime_radius_and_the_displacement(name, pencil):
    inverted = chain(name, pencil)["inversion"]
    step, mu = inverted.steps()[0], inverted.givens.mu_l.per_mm
    (circle,), rays = of_kind(step, Circle), of_kind(step, Segments)[0]
    r0, slack = inverted.givens.prime_radius / mu, MANY * SIGMA if pencil else EXACT
    assert circle.centre == pytest.approx(0, abs=slack)
    assert circle.radius == pytest.approx(r0, abs=slack)
    assert_allclose(rays.starts, 0, atol=slack)
    s = chain(name, pencil)["integration"].readings["s"].value / mu
    assert_allclose(np.abs(rays.ends), r0 + s, atol=2 * slack)
    against = 1 if inverted.givens.rotation == "cw" else -1
    turned = np.angle(rays.ends / 1j * np.exp(-1j * against * stations(name).phi))
    assert np.abs(turned).max() < (MANY * (TREMBLING.protractor + SIGMA / r0) if pencil else EXACT)
    said = str(step.caption)
    assert f"r₀ = {inverted.givens.prime_radius:g} mm" in said
    assert ("(clockwise)" in said) == (inverted.givens.rotation == "cw")


@EVERY
def test_every_face_stands_square_on_the_end_of_its_ray_and_reaches_beyond_its_touch_and_its_ray(name):
    inverted = chain(name)["inversion"]
    rays, (faces,) = of_kind(inverted.steps()[0], Segments)[0], of_kind(inverted.steps()[1], Segments)
    touch = of_kind(inverted.steps()[1], Dots)[0].points
    along, way = rays.ends / np.abs(rays.ends), faces.ends - faces.starts
    assert np.abs((way * along.conjugate()).real).max() < EXACT  # square to the ray
    assert np.abs(((faces.starts - rays.ends) * along.conjugate()).real).max() < EXACT  # through its end
    to_the_right = along / 1j
    left, touched, right = (
        ((places - rays.ends) * to_the_right.conjugate()).real for places in (faces.starts, touch, faces.ends)
    )
    assert_allclose(left, np.minimum(touched, 0) - FACE_BEYOND, atol=EXACT)
    assert_allclose(right, np.maximum(touched, 0) + FACE_BEYOND, atol=EXACT)


@EVERY
def test_the_touch_lies_ds_dphi_beside_the_ray_on_the_rise_to_the_right_of_a_cam_that_turns_counter_clockwise(name):
    inverted = chain(name)["inversion"]
    rays, touch = (
        of_kind(inverted.steps()[0], Segments)[0].ends,
        of_kind(inverted.steps()[1], Dots)[0].points,
    )
    v = chain(name)["integration"].readings["v"].value / inverted.givens.mu_l.per_mm
    to_the_right = v if inverted.givens.rotation == "ccw" else -v
    assert_allclose(touch - rays, rays / np.abs(rays) / 1j * to_the_right, atol=EXACT)


@EVERY
def test_the_half_widths_said_are_how_far_the_touches_wander_to_either_side(name):
    """The farthest plotted touch, and at most a little farther between two of them."""
    inverted = chain(name)["inversion"]
    step, mu = inverted.steps()[1], inverted.givens.mu_l.per_mm
    rays, touch = of_kind(inverted.steps()[0], Segments)[0].ends, of_kind(step, Dots)[0].points
    beside = ((touch - rays) * (rays / np.abs(rays) / 1j).conjugate()).real * mu
    for side, said in ((-1, r"most ([\d.]+) mm to the left"), (1, r"and ([\d.]+) mm to the right")):
        half_width, farthest = number(step.caption, said), (side * beside).max()
        assert farthest - 0.0051 <= half_width <= 1.02 * farthest + 0.0051


@EVERY
def test_every_mark_but_an_axis_names_its_act(name):
    drawn = chain(name)
    for key in ("minimum_radius", "curvature", "inversion"):
        for step in drawn[key].steps():
            for mark in step.own:
                if getattr(mark, "role", None) not in (Role.AXIS, Role.SCALE):
                    assert isinstance(mark.of, Act), (key, str(step.title), mark)
