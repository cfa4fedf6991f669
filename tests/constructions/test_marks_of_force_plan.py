"""What the force plan draws: load, contact force and reaction, end to end, along the lines that the mechanism gives."""

from __future__ import annotations

import cmath
import math
import re
from functools import cache

import numpy as np
import pytest
from boards import SIZES, coursework
from numpy.testing import assert_allclose
from over_all import over_all

import graphcam as gc
from graphcam.constructions.axes import station_names
from graphcam.constructions.chain import Chain
from graphcam.constructions.force_plan import BASE, LINE_OVERHANG, LOAD_LENGTH, force_plan
from graphcam.drafting.acts import Act
from graphcam.drafting.marks import AngleMark, Arrow, Dots, Label, Line, Role
from graphcam.drafting.pencil import Pencil

LOAD = gc.SpringLoad(mass=0.5, speed_rpm=120, stiffness=2, preload=150)
GUIDE = gc.Guide(friction=0.12, overhang=60, length=90)
SIGMA, MANY, EXACT = 0.2, 6, 1e-9
"""A hand's error [mm]; so many deviations no error of a fixed seed's hand is greater than; rounding [mm]."""
TREMBLING = Pencil(line=SIGMA, dividers=SIGMA, protractor=0.009, seed=5)
RISE, RETURN = 4, 20
"""Stations in the middle of the rise and of the return."""
PLANS = [(rotation, k, guide) for rotation in ("cw", "ccw") for k in (RISE, RETURN) for guide in (None, GUIDE)]
EVERY = over_all(("rotation", "k", "guide"), PLANS)


@cache
def angles(rotation: str):
    return Chain(coursework("3-4-5", rotation=rotation), decided=SIZES)["pressure_angle"]


def drawn(rotation: str, k: int | None, guide: gc.Guide | None, pencil: Pencil | None = None):
    return force_plan(angles(rotation), LOAD, pencil or Pencil(), guide, station=k)


def of_kind(step, kind):
    return [mark for mark in step.marks if isinstance(mark, kind)]


def numbers(caption) -> list[float]:
    """All numbers of a caption."""
    return [float(each) for each in re.findall(r"-?\d+(?:\.\d+)?", str(caption))]


def products(caption) -> list[list[float]]:
    """Length on paper, scale and value, of each that a caption says."""
    found = re.findall(r"([\d.]+) mm × ([\d.]+) = ([\d.]+) N", str(caption))
    return [[float(each) for each in product] for product in found]


def corners(plan) -> tuple[complex, complex]:
    """The head of Q and the third corner, as drawn."""
    load, *_, last = plan.steps()
    return of_kind(load, Arrow)[0].end, of_kind(last, Arrow)[0].end


@EVERY
def test_the_load_hangs_below_its_tail_as_long_as_its_force_at_the_scale(rotation, k, guide):
    plan, measured = drawn(rotation, k, guide), angles(rotation)
    step, integrated = plan.steps()[0], measured.givens.integrated
    s, a = (float(integrated.readings[name].value[k]) for name in ("s", "a"))
    force = 0.5e-3 * (a * (120 * math.tau / 60) ** 2) + 150 + 2 * s
    (arrow,), (name,), (dots,) = of_kind(step, Arrow), of_kind(step, Label), of_kind(step, Dots)
    mu = plan.givens.mu_force.per_mm
    assert arrow.start == 0
    assert arrow.end == pytest.approx(-1j * force / mu, abs=EXACT)
    assert 0.4 * LOAD_LENGTH < abs(arrow.end) <= LOAD_LENGTH
    assert_allclose(dots.points, [0, arrow.end], atol=EXACT)
    assert (name.text, name.at) == ("Q", pytest.approx(arrow.end / 2))
    # On the side away from the triangle.
    _, corner = corners(plan)
    assert name.towards.real * corner.real < 0 == name.towards.imag
    said = str(step.caption)
    assert f"Q = {force:.1f} N: inertia {force - 150 - 2 * s:.1f} N, preload 150.0 N, spring {2 * s:.1f} N." in said
    assert f"drawn s = {s:.2f} mm and a = {a:.2f} mm/rad²" in said
    assert f"μ_F = {mu:g} N/mm set the dividers to {force:.1f}/{mu:g} = {force / mu:.1f} mm" in said
    assert said.endswith("straight down.")
    title = station_names(integrated.givens.stations)[k]
    assert str(step.title) == f"Force plan at station {title}: the load"
    assert f"At station {title} " in said
    assert f"{mu:g} N/mm" in str(step.view.title)


@EVERY
def test_the_line_of_the_contact_force_leans_by_the_pressure_angle_and_bears_its_number(rotation, k, guide):
    plan = drawn(rotation, k, guide)
    step, (foot, corner) = plan.steps()[1], corners(plan)
    alpha = float(angles(rotation).readings["alpha"].paper[k])
    line, motion = of_kind(step, Line)
    assert line.points[0] == pytest.approx(foot, abs=EXACT)
    # Counter-clockwise from the motion for a cam that turns so: against its sense the cam pushes the stem along.
    lean = cmath.phase((line.points[1] - line.points[0]) / 1j)
    assert lean == pytest.approx(alpha if rotation == "ccw" else -alpha, abs=EXACT)
    assert abs(line.points[1] - foot) == pytest.approx(abs(corner - foot) + LINE_OVERHANG)
    assert motion.role is Role.AXIS
    assert motion.points[0] == pytest.approx(foot, abs=EXACT)
    up = motion.points[1] - motion.points[0]
    assert (up.real, up.imag > 0) == (pytest.approx(0, abs=EXACT), True)
    (mark,) = of_kind(step, AngleMark)
    assert mark.centre == pytest.approx(foot, abs=EXACT)
    directions = math.pi / 2, cmath.phase(line.points[1] - line.points[0])
    assert [mark.start, mark.end] == pytest.approx(sorted(directions))
    assert mark.end - mark.start == pytest.approx(abs(alpha))
    assert numbers(mark.text)[0] == pytest.approx(math.degrees(alpha), abs=0.051)
    assert 0 < mark.radius < abs(up)
    assert mark.radius < abs(line.points[1] - foot)
    side = "right" if (line.points[1] - foot).real > 0 else "left"
    assert f"α = {abs(math.degrees(alpha)):.2f}° from the vertical to the {side}," in str(step.caption)


@EVERY
def test_the_line_of_the_reaction_leans_against_the_motion_by_the_friction_of_the_bearings(rotation, k, guide):
    plan = drawn(rotation, k, guide)
    step, (_, corner) = plan.steps()[2], corners(plan)
    line, *laid_off = of_kind(step, Line)
    start, end = line.points
    assert abs(start.real * end.imag - start.imag * end.real) < EXACT  # through the tail of Q
    assert start == pytest.approx(-0.3 * end, abs=EXACT)
    assert abs(end.real) == pytest.approx(BASE)
    assert end.real * corner.real > 0
    assert (end * corner.conjugate()).imag == pytest.approx(0, abs=1e-7)  # the third corner lies on it
    if guide is None:
        assert end.imag == pytest.approx(0, abs=EXACT)
        assert laid_off == []
        assert "horizontal line through the tail" in str(step.caption)
        (part,) = step.parts
        assert [drawn.act.name for drawn in part.draws] == ["line of R"]
        return
    s = float(angles(rotation).givens.integrated.readings["s"].value[k])
    sense = 1 if k == RISE else -1
    # The bearings' friction mu (l + 2 b) over l, with the roller s mm higher b is so much less.
    assert end.imag / abs(end.real) == pytest.approx(sense * 0.12 * (90 + 2 * (60 - s)) / 90)
    base, incline = laid_off
    assert_allclose(base.points, [0, end.real], atol=EXACT)
    assert_allclose(incline.points, [end.real, end], atol=EXACT)
    side, way = ("right" if end.real > 0 else "left"), ("up" if end.imag > 0 else "down")
    along, up, joined = (str(part.caption) for part in step.parts)
    assert f"lay off {abs(end.real):g} mm from the tail of Q horizontally to the {side}, for l = 90 mm." in along
    *lengths, height = re.search(
        r"= ([\d.]+) · ([\d.]+) · \(([\d.]+) \+ 2 · ([\d.]+)\)/([\d.]+) = ([\d.]+) mm straight " + way, up
    ).groups()
    assert [float(each) for each in lengths] == pytest.approx([30, 0.12, 90, 60 - s, 90], abs=0.0051)
    assert float(height) == pytest.approx(abs(end.imag), abs=0.0051)
    assert joined.startswith("Join the tail of Q")
    assert [part.draws[0].act.name for part in step.parts] == ["base", "incline", "line of R"]


@EVERY
def test_the_forces_close_a_triangle_and_every_number_is_a_length_times_the_scale(rotation, k, guide):
    plan = drawn(rotation, k, guide)
    step, (foot, corner), mu = plan.steps()[3], corners(plan), plan.givens.mu_force.per_mm
    force, reaction = of_kind(step, Arrow)
    assert (force.start, reaction.end) == (pytest.approx(foot), 0)
    assert force.end == reaction.start == corner  # end to end
    (parted,), (dot,) = of_kind(step, Line), of_kind(step, Dots)
    assert_allclose(parted.points, [corner, 1j * corner.imag], atol=EXACT)
    assert_allclose(dot.points, [corner], atol=EXACT)
    f, r = of_kind(step, Label)
    assert (f.text, r.text) == ("F", "R")
    assert f.at == pytest.approx((foot + corner) / 2)
    assert r.at == pytest.approx(corner / 2)
    # Each name stands outside of the triangle: away from the corner that it does not touch.
    assert f.towards.real * corner.real > 0 > f.towards.imag
    assert r.towards == 1j
    lengths = abs(corner - foot), (corner - foot).imag, abs(corner.real), abs(corner.imag)
    *_, f_said, r_said, sides = (str(part.caption) for part in step.parts)
    told = [product for said in (f_said, r_said, sides) for product in products(said)]
    in_order = [lengths[0], abs(corner), *lengths[1 : 3 + (guide is not None)]]
    assert len(told) == len(in_order)
    for (paper, scale, force), length in zip(told, in_order, strict=True):
        assert paper == pytest.approx(length, abs=0.051)
        assert scale == pytest.approx(mu)
        assert force == pytest.approx(length * mu, abs=0.051)
    assert ("friction" in sides) == (guide is not None)
    assert_allclose(
        [float(plan.readings[name].paper) for name in ("normal", "along", "side", "friction", "reaction", "load")],
        [*lengths, abs(corner), abs(foot)],
        atol=EXACT,
    )


@EVERY
def test_a_trembling_hand_s_triangle_closes_as_well_on_lines_that_are_off_by_its_errors(rotation, k, guide):
    plan = drawn(rotation, k, guide, TREMBLING)
    steps, (foot, corner) = plan.steps(), corners(plan)
    force, reaction = of_kind(steps[3], Arrow)
    assert (force.start, force.end, reaction.start, reaction.end) == (foot, corner, corner, 0)
    for step in steps[1:3]:
        start, end = of_kind(step, Line)[0].points
        way = (end - start) / abs(end - start)
        assert abs(((corner - start) * way.conjugate()).imag) < EXACT  # the corner lies on both lines
    line = of_kind(steps[1], Line)[0].points
    assert 0 < abs(line[0] - foot) < MANY * SIGMA
    lean = cmath.phase((line[1] - line[0]) / 1j) * (1 if rotation == "ccw" else -1)
    alpha = float(angles(rotation).readings["alpha"].paper[k])
    assert 0 < abs(lean - alpha) < MANY * TREMBLING.protractor
    assert math.degrees(alpha) == pytest.approx(numbers(of_kind(steps[1], AngleMark)[0].text)[0], abs=0.051)


def test_a_plan_that_does_not_close_shows_both_lines_and_no_corner():
    tight = gc.Guide(friction=1.2, overhang=60, length=20)
    steps = drawn("cw", RISE, tight).steps()
    line = of_kind(steps[1], Line)[0].points
    assert abs(line[1] - line[0]) == pytest.approx(2 * LOAD_LENGTH)
    assert of_kind(steps[1], AngleMark)[0].radius == pytest.approx(0.4 * LOAD_LENGTH)
    assert steps[3].marks == ()


def test_a_guide_without_friction_has_nothing_to_lay_off_along_the_motion():
    line, *laid_off = of_kind(drawn("cw", RISE, gc.Guide(0.0, 60, 90)).steps()[2], Line)
    assert laid_off == []
    assert np.abs(line.points.imag).max() < EXACT


@EVERY
def test_the_parts_of_a_step_leave_all_its_own_marks_and_every_step_has_a_reason(rotation, k, guide):
    for step in drawn(rotation, k, guide).steps():
        assert re.fullmatch(r"(?!Because)[A-Z][^.]+\.", str(step.why)), str(step.why)
        left = {(part.act, at) for each in step.parts for part in each.draws for at in part.index.tolist()}
        for mark in step.own_marks:
            if getattr(mark, "role", None) is Role.AXIS:
                continue
            index = [0] if mark.index is None else mark.index.tolist()
            assert {(mark.of, at) for at in index} <= left, (str(step.title), mark)


def test_terms_of_the_load_that_are_nothing_are_not_told_and_friction_is():
    """A follower without mass has no inertia; friction adds to the load on a rise and relieves it on a return."""
    for k, sign in ((RISE, 1), (RETURN, -1)):
        load = gc.SpringLoad(mass=0.0, speed_rpm=120, stiffness=2, preload=150, friction=4.0)
        said = str(force_plan(angles("cw"), load, Pencil(), station=k).steps()[0].caption)
        s = float(angles("cw").givens.integrated.readings["s"].value[k])
        assert (
            f"Q = {150 + 2 * s + 4 * sign:.1f} N: preload 150.0 N, spring {2 * s:.1f} N, friction {4.0 * sign:.1f} N."
            in said
        )


@EVERY
def test_every_mark_but_the_axis_names_its_act(rotation, k, guide):
    for step in drawn(rotation, k, guide).steps():
        for mark in step.own_marks:
            if getattr(mark, "role", None) is not Role.AXIS:
                assert isinstance(mark.of, Act), (str(step.title), mark)
