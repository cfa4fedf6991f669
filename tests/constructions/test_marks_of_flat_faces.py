"""What is drawn for a flat face: s over a with its tangent, the radii laid off from it, the faces of the inversion."""

from __future__ import annotations

import math
import re
from functools import cache

import numpy as np
import pytest
from boards import flat_board, flat_motion, motion_of
from numpy.testing import assert_allclose
from over_all import over_all

import graphcam as gc
from graphcam.constructions.axes import station_names
from graphcam.constructions.chain import Chain
from graphcam.constructions.flat_inversion import FACE_OVERHANG
from graphcam.drafting.acts import Act
from graphcam.drafting.ink import Step
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
OWN = ("minimum_radius", "inversion", "curvature")
LAID_OFF = "minimum_radius", "Displacement over acceleration"
JOINED = "minimum_radius", "The curve of s over a"
TANGENT = "minimum_radius", "The tangent at 45 degrees"
FOUND = "minimum_radius", "The minimum prime radius"
CIRCLE = "inversion", "Prime circle"
RAYS = "inversion", "Rays of the inverted positions"
FACES = "inversion", "Faces"
CONTACTS = "inversion", "Contact points"
EVERY = over_all("name", ["the built-in task", *BOARDS])


@cache
def chain(name: str, pencil: Pencil | None = None):
    if name == "the built-in task":
        return gc.solve(gc.builtin_task("flat"), pencil).drawn
    return Chain(BOARDS[name], pencil or Pencil())


@cache
def steps(name: str, pencil: Pencil | None = None) -> dict[tuple[str, str], Step]:
    """The steps of a flat face's own constructions, by construction and title."""
    drawn = chain(name, pencil)
    return {(key, str(step.title)): step for key in OWN for step in drawn[key].steps()}


def step_of(name: str, key: str, title: str, pencil: Pencil | None = None) -> Step:
    return steps(name, pencil)[key, title]


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
    step = step_of(name, *LAID_OFF)
    laid_off = of_kind(step, Segments)
    assert_allclose(np.concatenate([lines.starts.real for lines in laid_off]), 0, atol=EXACT)
    for lines in laid_off:
        assert_allclose(lines.starts.imag, lines.ends.imag, atol=EXACT)
    ends, wanted = np.concatenate([lines.ends for lines in laid_off]), np.concatenate(expected_curve(name))
    apart = np.abs(ends[:, None] - wanted[None, :])
    assert apart.min(axis=0).max() < EXACT
    assert apart.min(axis=1).max() < EXACT
    said = re.search(r"μₐ/μₛ = ([\d.]+)/([\d.]+) = ([\d.]+),", str(step.caption)).groups()
    readings = chain(name)["integration"].readings
    mu_s, mu_a = (float(readings[key].scale) for key in "sa")
    assert [float(each) for each in said] == pytest.approx([mu_a, mu_s, mu_a / mu_s], rel=1e-3)
    assert (len(laid_off) == 2) == (name == "jumps")


@EVERY
def test_every_station_is_told_with_what_is_laid_off_there(name):
    """Where the acceleration jumps, on both sides."""
    step, (s, a, before, mu) = step_of(name, *LAID_OFF), lengths(name)
    factor = float(chain(name)["integration"].readings["a"].scale) / mu
    names = station_names(stations(name))
    assert len(step.parts) == 1
    assert len(step.places) == len(names)
    worked = re.search(r"(Station \S+: .*) Number the ends", str(step.caption))[1]
    assert worked in [str(place.caption) for place in step.places]
    for k, part in enumerate(step.places):
        said = str(part.caption)
        assert said.startswith(f"Station {names[k]}: ")
        height = re.search(r"([\d.]+) mm (above|below) the axis of a", said)
        assert (float(height[1]) * (1 if height[2] == "above" else -1) if height else 0) == pytest.approx(
            s[k], abs=0.0051
        )
        wanted = [a[k]] if a[k] == before[k] else [before[k], a[k]]
        found = re.findall(r"([\d.]+) mm × ([\d.]+) = ([\d.]+) mm to the (right|left)", said)
        assert len(found) == sum(abs(each) > 0.005 * factor for each in wanted)
        for (ordinate, times, length, side), across in zip(found, wanted, strict=False):
            assert float(times) == pytest.approx(factor, abs=5.1e-5)
            assert float(ordinate) == pytest.approx(abs(across) / factor, abs=0.0051)
            assert float(length) == pytest.approx(abs(across), abs=0.0051)
            assert side == ("right" if across > 0 else "left")
        assert ("before the jump" in said) == (len(wanted) == 2)
        assert_allclose(sorted(drawn.place.real for drawn in part.draws), sorted(wanted), atol=EXACT)
        assert all(drawn.place.imag == pytest.approx(s[k], abs=EXACT) for drawn in part.draws)


@EVERY
def test_the_ends_bear_their_stations_names_away_from_the_axis(name):
    step, (s, a, before, _) = step_of(name, *LAID_OFF), lengths(name)
    names, labels = station_names(stations(name)), of_kind(step, Label)[2:]
    assert {str(label.text) for label in labels} >= {names[span.start] for span in stations(name).phases}
    for label in labels:
        k = names.index(str(label.text))
        assert label.at in (pytest.approx(a[k] + 1j * s[k]), pytest.approx(before[k] + 1j * s[k]))
        if abs(label.at.real) > EXACT:
            assert label.towards == np.sign(label.at.real)
    jumps = [names[k] for k in np.flatnonzero(a != before)]
    assert all(sum(label.text == jump for label in labels) >= 1 for jump in jumps)


@EVERY
def test_smooth_curves_join_the_ends_between_jumps_and_corners(name):
    step = step_of(name, *JOINED)
    curves = [line for line in of_kind(step, Line) if line.role is Role.RESULT]
    assert len(curves) == len(stations(name).stretches)
    names = station_names(stations(name))
    for curve, places, part, stretch in zip(
        curves, expected_curve(name), step.places, stations(name).stretches, strict=False
    ):
        assert_allclose(curve.points[[0, -1]], places[[0, -1]], atol=EXACT)
        assert np.abs(places[:, None] - curve.points[None, :]).min(axis=1).max() < EXACT
        assert str(part.caption) == f"From {names[stretch.start]} to {names[stretch.stop - 1]}."


@EVERY
def test_a_dwell_is_a_point_of_the_axis_at_its_displacement(name):
    integration = chain(name)["integration"]
    step = step_of(name, *JOINED)
    (dots,) = of_kind(step, Dots)
    motion, mu = integration.givens.motion, float(integration.readings["s"].scale)
    levels = [motion.levels[k] / mu for k, phase in enumerate(motion.phases) if phase.kind == "dwell"]
    assert_allclose(dots.points.real, 0, atol=EXACT)
    assert_allclose(np.sort(dots.points.imag), np.sort(levels), atol=1e-6)
    told = [str(part.caption) for part in step.places[-dots.points.size :]]
    for said, level in zip(told, dots.points.imag, strict=True):
        assert said.startswith("In the dwell after ")
        height = re.search(r": ([\d.]+) mm above", said)
        assert (float(height[1]) if height else 0) == pytest.approx(level, abs=0.0051)


@EVERY
def test_the_axes_of_s_and_a_reach_beyond_all_that_is_drawn(name):
    step = step_of(name, *LAID_OFF)
    up, across = of_kind(step, Arrow)
    curve = np.concatenate(expected_curve(name))
    centre, zero = (
        of_kind(step_of(name, *FOUND), Dots)[0].points[0],
        of_kind(step_of(name, *TANGENT), Dots)[1].points[0],
    )
    adopted = of_kind(step_of(name, "curvature", "The minimum radius of curvature"), Dots)[0].points[0]
    assert up.start == pytest.approx(1j * (min(centre.imag, zero.imag, adopted.imag) - 8), abs=EXACT)
    assert up.end == pytest.approx(1j * (curve.imag.max() + 8))
    assert (across.start, across.end) == (pytest.approx(curve.real.min()), pytest.approx(curve.real.max() + 8))
    s, a = of_kind(step, Label)[:2]
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
@over_all("pencil", [None, TREMBLING])
def test_the_tangent_leans_by_45_degrees_touches_the_curve_and_crosses_it_nowhere(name, pencil):
    region = chain(name, pencil)["minimum_radius"]
    shown, step = (step_of(name, *title, pencil) for title in (JOINED, TANGENT))
    (line,), (touched, met), (angle,) = (of_kind(step, kind) for kind in (Line, Dots, AngleMark))
    (touch,), (zero,) = touched.points, met.points
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
    height = re.search(r"axis of s (?:([\d.]+) mm (above|below) the axis of a|at the axis of a)", str(step.caption))
    side = {"above": 1, "below": -1, None: 0}[height[2]]
    assert side * float(height[1] or 0) == pytest.approx(zero.imag, abs=0.0051)
    found = re.search(r"is (?:(-?[\d.]+) mm × ([\d.]+) = (-?[\d.]+) mm|zero)\.", str(step.caption))
    paper, scale, need = (float(each) for each in found.groups(default="0"))
    assert paper == pytest.approx(-zero.imag, abs=0.0051)
    assert scale == (pytest.approx(mu, rel=1e-4) if found[1] else 0)
    assert need == pytest.approx(-zero.imag * mu, abs=0.00051)
    # The ends that are told to be nearest are.
    (_, at), (s, a, before, _) = str(step.parts[0].caption).rsplit(" ", 1), lengths(name)
    k = station_names(stations(name)).index(at.rstrip("."))
    ends = np.concatenate([a + 1j * s, before + 1j * s, 1j * s[stations(name).last]])
    here = np.array([a[k] + 1j * s[k], before[k] + 1j * s[k], 1j * s[k]])
    assert np.abs(here - touch).min() <= np.abs(ends - touch).min() + (MANY * SIGMA if pencil else 1e-3)
    own = chain(name)["integration"].readings["a"].scale / chain(name)["integration"].readings["s"].scale
    assert number(step.caption, r"= ([\d.]+)°") == pytest.approx(
        math.degrees(math.atan(own)), abs=0.6 if pencil else 0.051
    )
    assert float(region.readings["need"].paper) == pytest.approx(-zero.imag, abs=EXACT)


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_the_cam_centre_lies_the_least_radius_below_the_start_of_the_lift(name, pencil):
    region = chain(name, pencil)["minimum_radius"]
    step, mu = step_of(name, *FOUND, pencil), float(np.ravel(region.readings["need"].scale)[0])
    (dot,), (label,), (measure,) = (of_kind(step, kind) for kind in (Dots, Label, Dimension))
    centre, zero = complex(dot.points[0]), complex(of_kind(step_of(name, *TANGENT, pencil), Dots)[1].points[0])
    least, slack = region.givens.least_curvature, MANY * SIGMA if pencil else EXACT
    r0 = least - zero.imag * mu
    assert centre == pytest.approx(-1j * r0 / mu, abs=slack)
    assert abs(centre.real) < EXACT
    assert (label.text, label.at) == ("A₀", centre)
    assert label.towards.imag < 0 < label.towards.real
    assert (measure.start, measure.end) == (0, centre)
    assert number(measure.text, r"r₀ = ([\d.]+)") == pytest.approx(r0, abs=0.0051)
    assert abs(measure.end - measure.start) * mu == pytest.approx(r0, abs=slack * mu + EXACT)
    # Left of the axis, on the side where the tangent does not run: the way down has its left on the right.
    assert measure.aside < 0
    said = str(step.caption)
    assert f"at least ρ = {least:g} mm" in said
    total = re.search(r"r₀ = (?:([\d.]+) ([+−]) ([\d.]+)|ρ) = ([\d.]+) mm", said)
    need = float(total[3]) * (1 if total[2] == "+" else -1) if total[3] else 0.0
    assert need == pytest.approx(-zero.imag * mu, abs=0.00051)
    assert float(total[4]) == pytest.approx(r0, abs=0.00051)
    value, scale, paper = re.search(r"dividers to ([\d.]+)/([\d.]+) = ([\d.]+) mm", said).groups()
    assert float(value) == pytest.approx(r0, abs=0.00051)
    assert float(scale) == pytest.approx(mu, rel=1e-4)
    assert float(paper) == pytest.approx(r0 / mu, abs=0.0051)


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_the_least_radius_of_curvature_reaches_from_the_adopted_centre_to_the_tangent(name, pencil):
    drawn = chain(name, pencil)
    curved, region = drawn["curvature"], drawn["minimum_radius"]
    step, mu = (
        step_of(name, "curvature", "The minimum radius of curvature", pencil),
        float(np.ravel(region.readings["need"].scale)[0]),
    )
    (dot,), (measure,) = of_kind(step, Dots), of_kind(step, Dimension)
    zero = complex(of_kind(step_of(name, *TANGENT, pencil), Dots)[1].points[0])
    slack = MANY * SIGMA if pencil else EXACT
    r0 = curved.givens.prime_radius
    assert dot.points[0] == pytest.approx(-1j * r0 / mu, abs=slack)
    assert (measure.start, measure.end) == (dot.points[0], zero)
    rho = abs(measure.end - measure.start) * mu
    assert number(measure.text, r"ρ = (-?[\d.]+)") == pytest.approx(rho, abs=0.0051)
    found = re.search(r"measures ([\d.]+) mm × ([\d.]+) = ([\d.]+) mm", str(step.caption)).groups()
    assert [float(each) for each in found] == pytest.approx([rho / mu, mu, rho], abs=0.0051)
    adopted = re.search(r"dividers to ([\d.]+)/([\d.]+) = ([\d.]+) mm", str(step.caption)).groups()
    assert [float(each) for each in adopted] == pytest.approx([r0, mu, r0 / mu], abs=0.0051)
    (named,) = of_kind(step, Label)
    assert (str(named.text), named.at) == (f"A (r₀ = {r0:g})", dot.points[0])
    assert named.towards.real < 0  # on the other side than A₀
    assert float(np.ravel(curved.readings["rho"].value)[0]) == pytest.approx(rho, abs=1e-7)
    # Beside the dimension of r0, not on it.
    assert measure.aside < of_kind(step_of(name, *FOUND, pencil), Dimension)[0].aside - 2


# --- the inversion ---------------------------------------------------------------------------------------------------


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_the_rays_turn_against_the_rotation_up_to_the_prime_circle_and_go_on_by_the_displacement(name, pencil):
    inverted = chain(name, pencil)["inversion"]
    circle_step, step, faces = (step_of(name, *title, pencil) for title in (CIRCLE, RAYS, FACES))
    (circle,), rays, further = of_kind(circle_step, Circle), of_kind(step, Segments)[0], of_kind(faces, Segments)[0]
    mu, slack = inverted.givens.mu_l.per_mm, MANY * SIGMA if pencil else EXACT
    r0 = inverted.givens.prime_radius / mu
    assert circle.centre == pytest.approx(0, abs=slack)
    assert circle.radius == pytest.approx(r0, abs=slack)
    assert_allclose(rays.starts, 0, atol=slack)
    assert_allclose(np.abs(rays.ends), r0, atol=2 * slack)
    assert_allclose(further.starts, rays.ends, atol=EXACT)
    s = chain(name, pencil)["integration"].readings["s"].value / mu
    assert_allclose(np.abs(further.ends), r0 + s, atol=2 * slack)
    against = 1 if inverted.givens.rotation == "cw" else -1
    turned = np.angle(rays.ends / 1j * np.exp(-1j * against * stations(name).phi))
    assert np.abs(turned).max() < (MANY * (TREMBLING.protractor + SIGMA / r0) if pencil else EXACT)
    said = re.search(r"compass to ([\d.]+) mm \(r₀ = ([\d.]+) mm at ([\d.]+):([\d.]+)\)", str(circle_step.caption))
    paper, whole, *ratio = (float(each) for each in said.groups())
    assert (paper, whole) == (pytest.approx(r0, abs=0.051), inverted.givens.prime_radius)
    assert ratio[1] / ratio[0] == pytest.approx(mu)


@EVERY
def test_every_ray_is_told_with_its_angle_and_the_sense_against_the_rotation_and_bears_its_number(name):
    inverted, step = chain(name)["inversion"], step_of(name, *RAYS)
    rays, names = of_kind(step, Segments)[0], station_names(stations(name))
    other = "anticlockwise|counter-clockwise" if inverted.givens.rotation == "cw" else "(?<!anti)(?<!counter-)clockwise"
    assert re.search(rf"turn the follower the other way, (?:{other})\.", str(step.caption))
    assert re.search(rf"from the vertical, (?:{other}), draw the ray from the cam centre", str(step.caption))
    assert len(step.parts) == 1
    assert len(step.places) == len(names)
    for k, part in enumerate(step.places):
        angle = re.fullmatch(rf"Ray {names[k]}: ([\d.]+)°\.", str(part.caption))[1]
        assert float(angle) == pytest.approx(math.degrees(stations(name).phi[k]), abs=0.0051)
        assert part.draws[1].place == pytest.approx(complex(rays.ends[k]), abs=EXACT)
    worked = re.search(r": ray (\S+) at ([\d.]+°)\.", str(step.caption))
    assert f"Ray {worked[1]}: {worked[2]}." in [str(place.caption) for place in step.places]
    for label in (label for label in of_kind(step, Label) if str(label.text) in names):
        assert label.at == pytest.approx(complex(rays.ends[names.index(str(label.text))]), abs=EXACT)
        assert (label.towards / label.at).real < 0  # inside the circle
    degrees = [math.degrees(phase.angle) for phase in inverted.givens.integrated.givens.motion.phases]
    told = re.findall(r"([\d.]+)°", str(chain(name)["working_profile"].steps()[-1].caption))
    assert [float(each) for each in told] == pytest.approx(degrees, rel=1e-5)


def laid_off_at(part) -> tuple[float, float, float] | None:
    """Ordinate, factor and length that a part says are laid off, if any."""
    found = re.search(r"([\d.]+) mm × ([\d.]+) = ([\d.]+) mm", str(part.caption))
    return found and tuple(float(each) for each in found.groups())


@EVERY
def test_every_face_stands_square_on_the_end_of_its_ray_and_reaches_beyond_its_touch_and_its_ray(name):
    step = step_of(name, *FACES)
    lengthened, faces = of_kind(step, Segments)
    (ends,) = of_kind(step, Dots)
    touch = of_kind(step_of(name, *CONTACTS), Dots)[0].points
    assert_allclose(ends.points, lengthened.ends, atol=EXACT)
    along, way = ends.points / np.abs(ends.points), faces.ends - faces.starts
    assert np.abs((way * along.conjugate()).real).max() < EXACT  # square to the ray
    assert np.abs(((faces.starts - ends.points) * along.conjugate()).real).max() < EXACT  # through its end
    to_the_right = along / 1j
    left, touched, right = (
        ((places - ends.points) * to_the_right.conjugate()).real for places in (faces.starts, touch, faces.ends)
    )
    assert_allclose(left, np.minimum(touched, 0) - FACE_OVERHANG, atol=EXACT)
    assert_allclose(right, np.maximum(touched, 0) + FACE_OVERHANG, atol=EXACT)


@EVERY
def test_every_face_is_told_with_the_displacement_that_is_laid_off(name):
    step, names = step_of(name, *FACES), station_names(stations(name))
    readings, mu = chain(name)["integration"].readings, chain(name)["inversion"].givens.mu_l.per_mm
    s, factor = readings["s"].paper, float(readings["s"].scale) / mu
    assert len(step.parts) == 1
    assert len(step.places) == len(names)
    assert f"μₛ/μₗ = {float(readings['s'].scale):.5g}/{mu:g} = {factor:.5g}. Station " in str(step.caption)
    assert laid_off_at(step) in [laid_off_at(place) for place in step.places]
    for k, part in enumerate(step.places):
        assert str(part.caption).startswith(f"Station {names[k]}: ")
        said = laid_off_at(part)
        assert (said is None) == (abs(s[k]) < 0.005)
        if said:
            assert said == pytest.approx((s[k], factor, s[k] * factor), abs=0.0051)
        assert part.draws[0].place == pytest.approx(complex(of_kind(step, Dots)[0].points[k]))


@EVERY
def test_the_touch_lies_ds_dphi_beside_the_ray_on_the_rise_to_the_right_of_a_cam_that_turns_counter_clockwise(name):
    inverted, step = chain(name)["inversion"], step_of(name, *CONTACTS)
    ends = of_kind(step_of(name, *FACES), Dots)[0].points
    touch, names = of_kind(step, Dots)[0].points, station_names(stations(name))
    reading, mu = chain(name)["integration"].readings["v"], inverted.givens.mu_l.per_mm
    to_the_right = (reading.value if inverted.givens.rotation == "ccw" else -reading.value) / mu
    assert_allclose(touch - ends, ends / np.abs(ends) / 1j * to_the_right, atol=EXACT)
    assert len(step.parts) == 2
    assert len(step.places) == len(names) + 1
    assert laid_off_at(step) in [laid_off_at(place) for place in step.places[:-1]]
    for k, part in enumerate(step.places[:-1]):
        assert str(part.caption).startswith(f"Station {names[k]}: ")
        said = laid_off_at(part)
        assert (said is None) == (abs(reading.paper[k]) < 0.005)
        if said:
            length = abs(to_the_right[k])
            assert said == pytest.approx((abs(reading.paper[k]), float(reading.scale) / mu, length), abs=0.0051)
            assert ("to the right" if to_the_right[k] > 0 else "to the left") in str(part.caption)
        assert part.draws[0].place == pytest.approx(complex(touch[k]))
    side = "right" if inverted.givens.rotation == "ccw" else "left"
    assert f"on a rise to the {side}, seen from the cam centre" in str(step.caption)


@EVERY
def test_the_half_widths_said_are_how_far_the_touches_wander_to_either_side(name):
    """The farthest plotted touch, and at most a little farther between two of them."""
    step, mu = step_of(name, *CONTACTS), chain(name)["inversion"].givens.mu_l.per_mm
    ends, touch = of_kind(step_of(name, *FACES), Dots)[0].points, of_kind(step, Dots)[0].points
    beside = ((touch - ends) * (ends / np.abs(ends) / 1j).conjugate()).real
    said = str(step.parts[-1].caption)
    assert said in str(step.caption)
    left, right, scale, *widths = (float(each) for each in re.findall(r"\d+(?:\.\d+)?", said))
    assert scale == pytest.approx(mu)
    for side, paper, half_width in ((-1, left, widths[0]), (1, right, widths[1])):
        farthest = (side * beside).max()
        assert farthest - 0.0051 <= paper <= 1.02 * farthest + 0.0051
        assert half_width == pytest.approx(paper * mu, abs=0.0051 * (1 + mu))


@over_all("given", [None, 60.0, 15.0])
def test_the_adopted_radius_is_told_before_anything_is_drawn_with_it(given):
    drawn = Chain(flat_board(flat_motion("cycloidal"), prime_radius=given))
    first, circle = drawn["inversion"].steps()[:2]
    least = float(drawn["minimum_radius"].value("prime_radius"))
    said, r0 = str(first.caption), drawn["inversion"].givens.prime_radius
    assert (str(first.title), str(circle.title)) == ("The adopted prime radius", "Prime circle")
    assert f"{least:.5g} mm" in said
    assert f"r₀ = {r0:g} mm" in said
    assert ("Round the minimum radius" in said) == (given is None)
    assert ("larger than the minimum" in said) == (given == 60.0)
    assert ("smaller than the minimum" in said) == (given == 15.0)
    if given is None:
        assert r0 == math.ceil(least)


@EVERY
def test_the_profile_is_the_envelope_it_crosses_no_face(name):
    """But for the chords between its points: every place of the curve lies on the centre's side of every face."""
    (curve,) = of_kind(step_of(name, "inversion", "Profile"), Line)
    faces = of_kind(step_of(name, *FACES), Dots)[0].points
    touch = of_kind(step_of(name, *CONTACTS), Dots)[0].points
    assert np.abs(touch[:, None] - curve.points[None, :]).min(axis=1).max() < EXACT
    along = faces / np.abs(faces)
    beyond = (curve.points[None, :] * along.conjugate()[:, None]).real - np.abs(faces)[:, None]
    assert beyond.max() < 0.02 * np.abs(faces).max()


# --- what all steps have ---------------------------------------------------------------------------------------------


@EVERY
def test_the_parts_of_a_step_leave_all_its_own_marks_that_are_of_a_place(name):
    for (_, title), step in steps(name).items():
        left = {(part.act, k) for each in step.places for part in each.draws for k in part.index.tolist()}
        for mark in step.own_marks if step.parts else ():
            if mark.of is not None and mark.index is not None:
                assert {(mark.of, k) for k in mark.index.tolist()} <= left, (title, mark)


@EVERY
def test_every_step_has_a_reason_in_one_sentence(name):
    for (_, title), step in steps(name).items():
        assert re.fullmatch(r"(?!Because)[A-Z][^.]+\.", str(step.why)), title


@EVERY
def test_every_mark_but_an_axis_names_its_act(name):
    for (key, title), step in steps(name).items():
        for mark in step.own_marks:
            if getattr(mark, "role", None) not in (Role.AXIS, Role.SCALE):
                assert isinstance(mark.of, Act), (key, title, mark)


@EVERY
def test_the_face_reaches_to_the_extreme_velocities_by_the_sense_of_the_cam(name):
    inverted = chain(name)["inversion"]
    told = [values for formula in inverted.meaning.formulas if formula.values for values in formula.values(inverted)]
    (reach,) = (values for values in told if "left_of" in values)
    left, right = reach["left_of"], reach["right_of"]
    assert (r"\max" in right, r"\min" in left) == (inverted.givens.rotation == "ccw",) * 2
    assert (r"\max" in left, r"\min" in right) == (inverted.givens.rotation == "cw",) * 2
