"""What is drawn of an oscillating follower: arm positions, lines at the limits, velocity plan, inversion, scheme."""

from __future__ import annotations

import cmath
import math
import re
from functools import cache

import numpy as np
import pytest
from boards import arm_board, arm_motion, arm_motion_of, limits
from numpy.testing import assert_allclose

import graphcam as gc
from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction, Step
from graphcam.drafting.marks import AngleMark, Arrow, Circle, Dimension, Dots, Label, Line, Region, Role, Segments
from graphcam.drafting.pencil import Pencil

SIGMA = 0.1
TREMBLING = Pencil(line=SIGMA, dividers=SIGMA, protractor=0.004, seed=3)
MANY = 6
"""So many standard deviations no error of a fixed seed's hand is greater than."""
EXACT = 1e-9
FREE, FORM = None, limits(45, 35)
REACH = "no rest line"
BOARDS = {
    "force, ccw": arm_board(arm_motion("3-4-5"), FREE),
    "form, ccw": arm_board(arm_motion("cycloidal"), FREE, limits=FORM),
    "form, cw": arm_board(arm_motion("3-4-5"), FREE, rotation="cw", limits=FORM),
    "given distance, cw": arm_board(arm_motion("cosine"), 120.0, rotation="cw"),
    "dwell first": arm_board(arm_motion_of((0, 30), (20, 80, "rectangular"), (0, 40), (-20, 100, "cosine")), FREE),
    "return first": arm_board(arm_motion_of((-20, 80, "3-4-5"), (0, 40), (20, 100, "cosine")), 110.0, arm=90.0),
    REACH: arm_board(arm_motion("cosine", 60.0), FREE, limits=limits(15, rest=False)),
}
EVERY = pytest.mark.parametrize("name", ["built-in", *BOARDS])


@cache
def chain(name: str, pencil: Pencil | None = None) -> Chain:
    if name == "built-in":
        return gc.solve(gc.builtin_task("arm"), pencil).chain
    return Chain(BOARDS[name], pencil or Pencil())


def steps_of(name: str, construction: str, pencil: Pencil | None = None) -> tuple[Construction, list[Step]]:
    drawn = chain(name, pencil)[construction]
    return drawn, drawn.steps()


def marks(step: Step, kind: type, role: Role | None = None) -> list:
    """The marks of a kind in a step, or those of them in one role."""
    return [mark for mark in step.marks if isinstance(mark, kind) and (role is None or mark.role is role)]


def labels(step: Step) -> dict[str, Label]:
    return {str(mark.text): mark for mark in marks(step, Label)}


def numbers(caption: object, pattern: str) -> list[float]:
    """The numbers that a caption says where the pattern has groups."""
    found = re.search(pattern, str(caption))
    assert found, caption
    return [float(each) for each in found.groups()]


def sense(drawn: Construction) -> int:
    return 1 if drawn.givens.rotation == "ccw" else -1


def motion(drawn: Construction) -> tuple[np.ndarray, np.ndarray]:
    """Displacement [rad] and velocity [rad/rad] at the stations."""
    integrated = drawn.givens.integrated
    return integrated.value("s"), integrated.value("v")


def directions(drawn: Construction) -> np.ndarray:
    """At each station 1 on a rise, -1 on a return."""
    phases = drawn.givens.integrated.givens.motion.phases
    return np.array([phases[k].direction for k in drawn.givens.integrated.givens.stations.phase])


def station(drawn: Construction, name: str) -> int:
    """The index of a station by its name, such as 5′."""
    return drawn.givens.integrated.givens.stations.phases[name.count("′")].start + int(name.rstrip("′"))


def ratio(scale: float) -> str:
    return f"1:{scale:g}" if scale >= 1 else f"{1 / scale:g}:1"


def angle_at_pivot(drawn: Construction) -> float:
    """Between the arm at rest and the line of centres, by the law of cosines."""
    c, arm, r0 = drawn.givens.distance, drawn.givens.arm, drawn.givens.prime_radius
    return math.acos((c * c + arm * arm - r0 * r0) / (2 * c * arm))


# --- the least radius ------------------------------------------------------------------------------------------------


def positions(region: Construction) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    """The arm's length on paper, the directions of its positions from the pivot, its ends B, and the ends D."""
    (s, v), length = motion(region), region.givens.arm / region.givens.mu_l.per_mm
    outward = -np.exp(-1j * s)
    return length, outward, length * outward, length * (1 + sense(region) * v) * outward


@EVERY
def test_the_arm_swings_about_its_pivot_by_the_displacements(name):
    region, steps = steps_of(name, "minimum_radius")
    length, _, ends, _ = positions(region)
    (arms,), (dots, pivot) = marks(steps[0], Segments), marks(steps[0], Dots)
    assert_allclose(arms.starts, 0, atol=EXACT)
    assert_allclose(arms.ends, ends, atol=EXACT)
    assert_allclose(dots.points, ends, atol=EXACT)
    assert_allclose(pivot.points, [0], atol=EXACT)
    named = labels(steps[0])
    assert named["C"].at == 0
    assert named["C"].towards == 1
    assert named["B₀"].at == pytest.approx(-length)
    assert named["B₀"].towards == -1j
    said = str(steps[0].caption)
    assert said.startswith(f"At {ratio(region.givens.mu_l.per_mm)} the arm, {length:.1f} mm,")
    assert numbers(said, r"up to ([\d.]+)°") == [round(math.degrees(motion(region)[0].max()), 2)]


@EVERY
def test_the_velocities_are_laid_off_along_the_arm_and_a_curve_is_faired_through_their_ends(name):
    region, steps = steps_of(name, "minimum_radius")
    _, _, ends, tips = positions(region)
    (laid_off,), curves = marks(steps[1], Segments), marks(steps[1], Line)
    assert_allclose(laid_off.starts, ends, atol=EXACT)
    assert_allclose(laid_off.ends, tips, atol=EXACT)
    pieces = region.givens.integrated.givens.stations.pieces
    for curve, piece in zip(curves, pieces, strict=True):
        assert_allclose(curve.points[:: 8 if len(curve.points) > 2 else 1], tips[piece], atol=EXACT)
    for text, label in labels(steps[1]).items():
        k = station(region, text)
        assert label.at == pytest.approx(tips[k])
        assert cmath.phase(label.towards / tips[k]) == pytest.approx(0, abs=EXACT)
        assert abs(tips[k] - ends[k]) > 1
    assert numbers(steps[1].caption, r"at most ([\d.]+) mm") == [pytest.approx(np.abs(tips - ends).max(), abs=0.05)]
    assert ("on the rise outward" in str(steps[1].caption)) == (sense(region) > 0)
    assert ("on the rise towards the pivot" in str(steps[1].caption)) == (sense(region) < 0)


@EVERY
def test_through_every_d_runs_the_line_at_the_permitted_angle_to_the_arms_normal(name):
    region, steps = steps_of(name, "minimum_radius")
    length, outward, ends, tips = positions(region)
    permitted, sigma, at = region.givens.limits, sense(region), directions(region)
    families = [(tips[at > 0], outward[at > 0], permitted.rise, sigma)]
    if permitted.return_ is not None:
        families.append((tips[at < 0], outward[at < 0], permitted.return_, -sigma))
    top = int(np.argmax(motion(region)[0]))
    rests, along = np.array([-length, ends[top]]), np.array([-1, outward[top]])
    if permitted.rest:
        families.append((rests, along, permitted.rise, -sigma))
        if permitted.return_ is not None:
            families.append((rests, along, permitted.return_, sigma))
    else:  # the arms themselves, from the pivot
        families.append((np.zeros(2), along, math.pi / 2, 1))
    for drawn, (places, arms, limit, side) in zip(marks(steps[2], Segments), families, strict=True):
        assert_allclose(drawn.starts, places, atol=EXACT)
        way, wanted = drawn.ends - drawn.starts, 1j * arms * np.exp(1j * side * limit)
        assert_allclose(np.abs(way), 0.77 * length, rtol=1e-12)
        assert_allclose((way * wanted.conj()).imag, 0, atol=1e-7)  # on the line at the limit
        assert np.all(way.imag < EXACT)  # and down, where the cam lies
    said = str(steps[2].caption)
    assert f"{math.degrees(permitted.rise):.6g}° on the rise" in said
    if permitted.return_ is None:
        assert "while a spring drives the return" in said
    else:
        assert f"{math.degrees(permitted.return_):.6g}° on the return" in said


def from_edge(place: complex, corners: np.ndarray) -> float:
    """How far a place lies from the edge of a polygon."""
    found = []
    for a, b in zip(corners, np.roll(corners, -1), strict=True):
        way = b - a
        t = 0.0 if way == 0 else min(1.0, max(0.0, ((place - a) * way.conjugate()).real / abs(way) ** 2))
        found.append(abs(place - a - t * way))
    return min(found)


@pytest.mark.parametrize("name", ["built-in", *(name for name in BOARDS if name != REACH)])
def test_the_cam_centre_lies_on_the_edge_of_the_region_that_no_line_cuts(name):
    region, steps = steps_of(name, "minimum_radius")
    length, outward, _, tips = positions(region)
    (shaded,), (centre,) = marks(steps[2], Region), marks(steps[3], Dots)
    corners, place = shaded.boundary, complex(centre.points[0])
    assert from_edge(place, corners) < 1e-6
    assert corners.imag.min() == pytest.approx(place.imag - 30)
    assert -1.3 * length - EXACT <= corners.real.min() < corners.real.max() <= EXACT
    at, sigma = directions(region), sense(region)
    drives = np.where(at > 0, region.givens.limits.rise, region.givens.limits.return_ or math.nan)
    for corner in corners:
        # Seen from every D, no corner is farther from the arm's normal than is permitted to the driven side.
        alpha = sigma * at * np.angle((corner - tips) / (1j * outward))
        seen = np.abs(corner - tips) > 1e-6
        assert np.all((alpha <= drives + 1e-7)[seen & ~np.isnan(drives)])


@EVERY
@pytest.mark.parametrize("pencil", [None, TREMBLING], ids=["perfect", "a hand"])
def test_the_least_radius_and_the_distance_are_as_long_as_their_dimensions_say(name, pencil):
    region, steps = steps_of(name, "minimum_radius", pencil)
    step, mu = steps[3], region.givens.mu_l.per_mm
    (to_start,), (to_pivot,) = marks(step, Line, Role.LIMIT), marks(step, Line, Role.AXIS)
    start, place = (complex(each) for each in to_start.points)
    assert abs(start + region.givens.arm / mu) < (MANY * SIGMA if pencil else EXACT)
    assert_allclose(to_pivot.points, [0, place], atol=EXACT)
    assert_allclose(marks(step, Dots)[0].points, [place], atol=EXACT)
    assert (labels(step)["A"].at, labels(step)["A"].towards) == (pytest.approx(place), -1j)
    radius, distance = marks(step, Dimension)
    assert (radius.start, radius.end, distance.start, distance.end) == pytest.approx((start, place, place, 0))
    assert radius.aside == distance.aside == -8
    r0, c = mu * abs(place - start), mu * abs(place)
    assert (str(radius.text), str(distance.text)) == (f"r₀ = {r0:.2f}", f"c = {c:.2f}")
    assert (radius.of.name, distance.of.name) == ("prime_radius", "distance")
    said = numbers(step.caption, r"lies ([\d.]+) mm .* r₀ = ([\d.]+) mm, and ([\d.]+) mm .* so c = ([\d.]+) mm")
    assert said == pytest.approx([abs(place - start), r0, abs(place), c], abs=0.0051)
    if region.givens.distance is not None:
        assert f"on the circle c = {region.givens.distance:g} mm" in str(step.caption)
        assert c == pytest.approx(region.givens.distance, abs=MANY * SIGMA * mu if pencil else 1e-9)


# --- the pressure angle ----------------------------------------------------------------------------------------------


def mechanism(steps: list[Step]) -> tuple[complex, complex, complex, complex]:
    """A, B, C and D as they are plotted."""
    a, b, c, d = (complex(place) for place in marks(steps[1], Dots)[0].points)
    return a, b, c, d


def shown_at(measured: Construction, steps: list[Step]) -> tuple[int, float]:
    """The station of the plan, and the scale of the plan [mm/mm]."""
    numerator, denominator = numbers(steps[1].caption, r"at ([\d.]+):([\d.]+) the segment")
    name = re.fullmatch(r"Velocity plan at station (\d+′*)", str(steps[0].title)).group(1)
    return station(measured, name), denominator / numerator


@EVERY
def test_the_plans_mechanism_is_the_one_of_the_sizes_and_the_displacement(name):
    """C A B by the law of cosines, the line of centres level, the cam centre at the origin."""
    measured, steps = steps_of(name, "pressure_angle")
    k, scale = shown_at(measured, steps)
    (s, v), arm, c = motion(measured), measured.givens.arm / scale, measured.givens.distance / scale
    b = c - arm * cmath.exp(-1j * (angle_at_pivot(measured) + s[k]))
    d = b + sense(measured) * v[k] * (b - c)
    assert mechanism(steps) == pytest.approx((0, b, c, d), abs=1e-9)
    sides = [tuple(line.points) for line in marks(steps[1], Line)]
    assert np.array(sides) == pytest.approx(np.array([(0, c), (c, b), (b, d), (0, b)]), abs=1e-9)
    roles = [line.role for line in marks(steps[1], Line)]
    assert roles == [Role.AXIS, Role.CURVE, Role.RESULT, Role.CONSTRUCTION]
    named = labels(steps[1])
    assert {key: label.at for key, label in named.items()} == pytest.approx({"A": 0, "B": b, "C": c, "D": d}, abs=1e-9)
    assert [named[key].towards for key in "ABCD"] == [-1 - 1j, 1 + 1j, 1 - 1j, -1 + 1j]
    said = numbers(steps[1].caption, r"arm: ([\d.]+) mm .* = ([\d.]+) mm")
    assert said == pytest.approx([abs(d - b), measured.givens.arm * abs(v[k])], abs=0.051)
    side = "from B away from the pivot" if sense(measured) * v[k] > 0 else "from B towards the pivot"
    assert side in str(steps[1].caption)


@EVERY
@pytest.mark.parametrize("pencil", [None, TREMBLING], ids=["perfect", "a hand"])
def test_the_velocity_plan_is_square_to_the_mechanisms_triangle(name, pencil):
    measured, steps = steps_of(name, "pressure_angle", pencil)
    a, b, c, d = mechanism(steps)
    v1, v2, v21 = marks(steps[0], Arrow)
    pole = v1.start
    assert (v2.start, v21.start, v21.end) == pytest.approx((pole, v1.end, v2.end))
    assert pole == pytest.approx(c.real + 0.6 * abs(b) + 12)  # clear of the mechanism
    turn = 1j * sense(measured)
    assert v1.end - pole == pytest.approx(turn * (b - a))  # the cam's point goes round A in the sense of the rotation
    assert d - b == pytest.approx(turn * (v2.end - pole))  # BD is v₂, turned in the sense of the rotation
    assert (v21.end - v21.start) == pytest.approx(-turn * (d - a))  # across the profile's normal D A
    named = labels(steps[0])
    halves = {"v₁": (pole + v1.end) / 2, "v₂": (pole + v2.end) / 2, "v₂₁": (v1.end + v2.end) / 2, "p": pole}
    assert {key: label.at for key, label in named.items()} == pytest.approx(halves)
    side = math.copysign(1, (v1.end - pole).real)
    assert [named[key].towards for key in halves] == [-1j * side, -side, 1j + side, -1 - 1j]
    said = numbers(steps[0].caption, r"radius AB, ([\d.]+) mm; .* to the arm, ([\d.]+) mm; .* with ([\d.]+) mm")
    assert said == pytest.approx([abs(each.end - each.start) for each in (v1, v2, v21)], abs=0.051)
    if pencil is None:
        assert abs(((v2.end - pole) * (b - c).conjugate()).real) < 1e-6  # v₂ across the arm


@EVERY
def test_the_pressure_angle_that_is_printed_is_the_one_between_da_and_the_arms_normal(name):
    measured, steps = steps_of(name, "pressure_angle")
    a, b, c, d = mechanism(steps)
    (ray,), (normal,) = marks(steps[2], Line, Role.LIMIT), marks(steps[2], Line, Role.CONSTRUCTION)
    (arc,), square = marks(steps[2], AngleMark), 1j * (b - c) / abs(b - c)
    assert tuple(ray.points) == pytest.approx((d, a), abs=1e-9)
    assert tuple(normal.points) == pytest.approx((d, d + 0.7 * abs(d) * square), abs=1e-9)
    alpha = cmath.phase((a - d) / square)
    assert (arc.centre, arc.radius) == (pytest.approx(d), pytest.approx(0.6 * abs(d)))
    first, last = (cmath.phase(square), cmath.phase(square) + alpha)[:: 1 if alpha > 0 else -1]
    assert cmath.exp(1j * arc.start) == pytest.approx(cmath.exp(1j * first))
    assert arc.end - arc.start == pytest.approx(last - first)
    assert str(arc.text) == f"α = {math.degrees(alpha):.1f}°"
    k, _ = shown_at(measured, steps)
    assert measured.value("alpha")[k] == pytest.approx(alpha, abs=1e-9)
    assert measured.value("transmission")[k] == pytest.approx(math.pi / 2 - abs(alpha), abs=1e-9)
    said = numbers(steps[2].caption, r"angle at station \d+′*: (-?[\d.]+)°, and the transmission angle ([\d.]+)°")
    assert said == pytest.approx([math.degrees(alpha), 90 - abs(math.degrees(alpha))], abs=0.0051)
    assert f"at station {str(steps[0].title).split()[-1]}:" in str(steps[2].caption)


# --- the inversion ---------------------------------------------------------------------------------------------------


def inverted_positions(inverted: Construction) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The pivots, where the arm at rest meets the prime circle, and the pitch points, on paper."""
    mu, phi = inverted.givens.mu_l.per_mm, inverted.givens.integrated.givens.stations.phi
    towards, psi = np.exp(-1j * sense(inverted) * phi), angle_at_pivot(inverted)
    pivots, arm = inverted.givens.distance / mu * towards, inverted.givens.arm / mu * towards
    return pivots, pivots - arm * np.exp(-1j * psi), pivots - arm * np.exp(-1j * (psi + motion(inverted)[0]))


@EVERY
def test_prime_circle_and_pivot_circle_have_the_sizes_that_are_told(name):
    inverted, steps = steps_of(name, "inversion")
    mu, c, r0 = inverted.givens.mu_l.per_mm, inverted.givens.distance, inverted.givens.prime_radius
    circles = [(circle.centre, circle.radius) for circle in marks(steps[0], Circle)]
    assert circles == [(0, pytest.approx(r0 / mu)), (0, pytest.approx(c / mu))]
    (arrow,), text = marks(steps[0], Arrow), f"r₀ = {r0:g}"
    assert (arrow.start, abs(arrow.end)) == (0, pytest.approx(r0 / mu))
    assert labels(steps[0])[text].at == pytest.approx(0.6 * arrow.end)
    told = f"prime circle r₀ = {r0:g} mm and the circle of the pivot, c = {c:g} mm, are drawn at {ratio(mu)}: "
    assert told + f"{r0 / mu:.1f} mm and {c / mu:.1f} mm." in str(steps[0].caption)


@EVERY
def test_the_pivot_is_stepped_off_against_the_rotation(name):
    inverted, steps = steps_of(name, "inversion")
    pivots, starts, _ = inverted_positions(inverted)
    assert_allclose(marks(steps[1], Dots)[0].points, pivots, atol=EXACT)
    sigma, phases = sense(inverted), inverted.givens.integrated.givens.motion.phases
    begin = cmath.phase(starts[0]) + sigma * inverted.givens.integrated.givens.stations.phi[0]
    for arc, phase in zip(marks(steps[1], AngleMark), phases, strict=True):
        assert arc.end - arc.start == pytest.approx(phase.angle)
        assert cmath.exp(1j * (arc.end if sigma > 0 else arc.start)) == pytest.approx(cmath.exp(1j * begin))
        assert str(arc.text).endswith(f" = {math.degrees(phase.angle):.6g}°")
        begin -= sigma * phase.angle
    turning = {1: "counter-clockwise", -1: "clockwise"}[sigma]
    angles = ", ".join(f"{math.degrees(phase.angle):.6g}°" for phase in phases)
    assert str(steps[1].caption).endswith(f"against the rotation ({turning}); the phases take {angles}.")


@EVERY
def test_from_every_pivot_the_arm_is_turned_by_the_displacement(name):
    inverted, steps = steps_of(name, "inversion")
    pivots, _, pitch = inverted_positions(inverted)
    (arms,), (dots,) = marks(steps[2], Segments), marks(steps[2], Dots)
    assert_allclose(arms.starts, pivots, atol=EXACT)
    assert_allclose(arms.ends, pitch, atol=EXACT)
    assert_allclose(dots.points, pitch, atol=EXACT)
    named = labels(steps[2])
    pivot = named.pop("C")
    assert (pivot.at, pivot.towards) == pytest.approx((pivots[0], pivots[0]))
    for text, label in named.items():
        k = station(inverted, text)
        assert (label.at, label.towards) == pytest.approx((pitch[k], pitch[k] / abs(pitch[k])))
    said = numbers(steps[2].caption, r"arm's length, ([\d.]+) mm, .* at most ([\d.]+)°")
    arm, most = inverted.givens.arm / inverted.givens.mu_l.per_mm, math.degrees(motion(inverted)[0].max())
    assert said == [round(arm, 1), round(most, 2)]
    # What moves is square to the arm, away from the cam.
    away = (pivots - pitch) / np.abs(pivots - pitch) * 1j
    assert_allclose(inverted.points["motion"], away, atol=EXACT)


@EVERY
def test_the_pitch_curve_is_closed_once_round_the_centre_through_all_its_points(name):
    inverted, steps = steps_of(name, "inversion")
    _, _, pitch = inverted_positions(inverted)
    (curve,) = marks(steps[3], Line)
    assert curve.closed
    assert np.abs(curve.points[:, None] - pitch).min(axis=0).max() < EXACT
    turns = np.angle(np.roll(curve.points, -1) / curve.points).sum() / (2 * math.pi)
    assert turns == pytest.approx(-sense(inverted))


def test_a_hands_arms_reach_from_the_pivot_circle_to_their_length():
    inverted, steps = steps_of("built-in", "inversion", TREMBLING)
    circle = marks(steps[0], Circle)[1]
    pivots, (arms,) = marks(steps[1], Dots)[0].points, marks(steps[2], Segments)
    assert_allclose(np.abs(pivots - circle.centre), circle.radius, atol=EXACT)
    assert_allclose(arms.starts, pivots, atol=EXACT)
    length = inverted.givens.arm / inverted.givens.mu_l.per_mm
    assert 0.1 * SIGMA < np.abs(np.abs(arms.ends - arms.starts) - length).max() < MANY * 2 * SIGMA


# --- the scheme ------------------------------------------------------------------------------------------------------


@EVERY
def test_the_scheme_shows_the_arm_at_the_start_of_the_turn(name):
    scheme, (step,) = steps_of(name, "scheme")
    inverted = scheme.givens.profile.givens.inverted
    numerator, denominator = numbers(step.caption, r"at ([\d.]+):([\d.]+)\.")
    scale = denominator / numerator
    c, arm = inverted.givens.distance / scale, inverted.givens.arm / scale
    first = inverted.givens.integrated.givens.motion.levels[0]
    b = c - arm * cmath.exp(-1j * (angle_at_pivot(inverted) + first))
    roller, hinge, _ = marks(step, Circle)
    assert (roller.centre, roller.radius) == pytest.approx((b, scheme.givens.profile.givens.roller_radius / scale))
    assert (hinge.centre, hinge.radius) == pytest.approx((c, 1.2))
    rod, support = marks(step, Line, Role.CURVE)[:2]
    assert tuple(rod.points) == pytest.approx((b, c))
    assert tuple(marks(step, Line, Role.AXIS)[0].points) == pytest.approx((0, c))
    assert tuple(support.points - c) == pytest.approx((-0.8 - 0.9j, -3 - 5j, 3 - 5j, 0.8 - 0.9j))
    hatch = marks(step, Segments, Role.HATCH)[0]
    assert tuple(hatch.starts - c) == pytest.approx(tuple(np.array([-3, -1.5, 0, 1.5, 3]) - 5j))
    assert_allclose(hatch.ends - hatch.starts, -1.2 - 1.5j)
    assert_allclose(marks(step, Dots)[0].points, [b])
    named = labels(step)
    assert (named["B"].at, named["C"].at) == pytest.approx((b, c))
    assert named["B"].towards == named["C"].towards == 1 + 1j
