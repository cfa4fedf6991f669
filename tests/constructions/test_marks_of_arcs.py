"""The marks of a cam of three arcs: each step is held against its theorem, in plain arithmetic on what is drawn."""

from __future__ import annotations

import cmath
import math
import re
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from test_arc_drawing import CASES, EXAMPLE, MIRRORED, board_of

import graphcam as gc
from graphcam.constructions.arc_chain import ArcBoard, ArcChain
from graphcam.drafting.ink import Step
from graphcam.drafting.marks import Arc, Circle, Dimension, Dots, Label, Line, Role, Segments
from graphcam.mechanism.arcs import three_arc_cam

NEAR = 1e-9
"""mm of paper: rounding."""
BY_HAND = 2.0
"""mm of paper: ten errors of a hand of 0.2 mm."""
DATA = 0.02
"""mm of paper: the data of the example are rounded, so that D, found again, is not quite the D that is given."""
OVERHANG, BEYOND = 6.0, 7.0
BOARDS: dict[str, tuple[dict[str, Any], dict[str, float]]] = {
    **{name: (data, {}) for name, data in CASES.items()},
    "clockwise": (MIRRORED, {}),
    "knife edge": (EXAMPLE, {"roller": 0.0}),
    "no dwell": (EXAMPLE, {"dwell": 0.0, "divisions": 3}),
    "by hand": (EXAMPLE, {}),
}
EVERY = pytest.mark.parametrize("name", BOARDS)
PERFECT = pytest.mark.parametrize("name", [name for name in BOARDS if name != "by hand"])


def board(name: str) -> ArcBoard:
    data, changes = BOARDS[name]
    return board_of(data, **changes)


@cache
def chain(name: str) -> ArcChain:
    hand = gc.Pencil(line=0.2, dividers=0.2, protractor=math.radians(0.5), seed=8)
    return ArcChain(board(name), hand if name == "by hand" else gc.Pencil())


@cache
def steps(name: str, construction: str) -> list[Step]:
    return chain(name)[construction].steps()


def all_of(step: Step, kind: type) -> list[Any]:
    return [mark for mark in step.marks if isinstance(mark, kind)]


def tolerance(name: str) -> float:
    return BY_HAND if name == "by hand" else NEAR


def numbers(step: Step) -> list[float]:
    """The numbers of the caption, but for those in names of points."""
    said = re.sub(r"[A-Z]\d|[ρμ][₀-₉]", "", str(step.caption))
    return [float(found) for found in re.findall(r"(?<![\w.])-?\d+(?:\.\d+)?", said)]


def told(step: Step, point: str) -> complex:
    """The coordinates that a caption tells of a point [mm]."""
    found = re.search(re.escape(point) + r" = \((\S+), (\S+)\) mm", str(step.caption))
    assert found is not None, (point, str(step.caption))
    return complex(float(found[1]), float(found[2]))


def named(step: Step, text: str) -> Label:
    """The one label of that text."""
    (label,) = (mark for mark in all_of(step, Label) if str(mark.text) == text)
    return label


def across(way: complex, other: complex) -> float:
    """How far ``other`` reaches square to ``way``."""
    return (way.conjugate() * other).imag / abs(way)


def is_outward(label: Label, away: complex = 0j) -> bool:
    return abs(cmath.phase(label.towards / (label.at - away))) < 1e-6


def per_mm(name: str) -> float:
    return board(name).mu_l.per_mm


def the(points: Any) -> list[complex]:
    return [complex(p) for p in points]


# --- the arcs --------------------------------------------------------------------------------------------------------


@EVERY
def test_the_given_points_are_plotted_where_the_data_say_and_the_outer_circle_passes_through_d(name):
    step, mu, data = steps(name, "three_arcs")[0], per_mm(name), BOARDS[name][0]
    (circle,), (dots,), axes = all_of(step, Circle), all_of(step, Dots), all_of(step, Line)
    given = [point for point in "ADG" if point in data]
    assert the(dots.points)[0] == 0
    for at, point in zip(the(dots.points)[1:], given, strict=True):
        assert abs(at * mu - complex(*data[point])) < (BY_HAND if name == "by hand" else DATA)
        assert named(step, point).at == at
        assert is_outward(named(step, point))
        assert told(step, point) == complex(*data[point])
    assert abs(circle.centre) < tolerance(name)
    assert abs(abs(named(step, "D").at) - circle.radius) < tolerance(name)
    assert (named(step, "O").at, named(step, "O").towards) == (0, -1 - 1j)
    for axis, way in zip(axes, (1, 1j), strict=True):
        assert np.allclose(axis.points, np.array([-1, 1]) * way * (circle.radius + OVERHANG), atol=NEAR)


@EVERY
def test_the_first_circle_touches_the_outer_one_in_d(name):
    step, mu, outer = steps(name, "three_arcs")[1], per_mm(name), all_of(steps(name, "three_arcs")[0], Circle)[0]
    (line,), (circle,), (dots,), (label,) = (all_of(step, kind) for kind in (Line, Circle, Dots, Label))
    (c1,), d = the(dots.points), named(steps(name, "three_arcs")[0], "D").at
    assert abs(circle.centre - c1) < tolerance(name)
    assert abs(circle.radius - BOARDS[name][0]["rho1"] / mu) < tolerance(name)
    assert abs(abs(c1) + circle.radius - outer.radius) < tolerance(name)
    start, end = the(line.points)
    assert start == 0
    assert abs(end - d) == pytest.approx(OVERHANG)
    assert abs(end) > abs(d)
    assert max(abs(across(end, c1)), abs(across(end, d))) < tolerance(name)
    assert (str(label.text), label.at) == ("C1", c1)
    assert is_outward(label, d)
    assert abs(told(step, "C1") - c1 * mu) < max(tolerance(name), 0.001)


@EVERY
def test_the_second_centre_is_as_far_from_a_as_from_g_and_lies_on_a_line_through_o(name):
    step, mu, data = steps(name, "three_arcs")[2], per_mm(name), BOARDS[name][0]
    g, (c2, a) = named(steps(name, "three_arcs")[0], "G").at, the(all_of(step, Dots)[0].points)
    base, (axis, radius, *bisected) = all_of(step, Circle)[0], all_of(step, Line)
    assert abs(abs(c2 - a) - abs(c2 - g)) < tolerance(name)
    assert (the(radius.points), axis.points[1]) == ([g, c2], c2)
    assert abs(across(c2, a)) < NEAR
    assert abs(axis.points[0] - a) == pytest.approx(OVERHANG)
    assert abs(axis.points[0]) > abs(a)
    assert abs(a - c2) > abs(c2)  # O lies between them
    assert abs(base.centre) + abs(base.radius - abs(a)) < tolerance(name)
    assert abs(told(step, "C2") - c2 * mu) < max(tolerance(name), 0.001)
    assert numbers(step)[-1] == pytest.approx(abs(c2 - g) * mu, abs=0.001)
    assert named(step, "C2").at == c2
    assert is_outward(named(step, "C2"))
    assert ("A" in data) or named(step, "A").at == a
    assert bool(bisected) == ("C2" not in data)
    if bisected:
        is_bisected(bisected, a, g, c2, NEAR)


def is_bisected(lines: list[Line], a: complex, b: complex, to: complex, near: float) -> None:
    """A chord from a to b, and the line from a little beyond its middle, square to it, to a place."""
    chord, bisector = (the(line.points) for line in lines)
    assert abs(chord[0] - a) + abs(chord[1] - b) < NEAR
    start, end = bisector
    assert end == to
    assert abs(across((b - a) * 1j, (a + b) / 2 - end)) < near
    assert abs(across((b - a) * 1j, (a + b) / 2 - start)) < near
    assert abs(start - (a + b) / 2) == pytest.approx(OVERHANG, abs=max(near, 1e-6))
    assert abs(end - start) > abs(end - (a + b) / 2)


ROOTS = pytest.mark.parametrize(("prime", "at"), [("", 3), ("′", 5)], ids=["this root", "the other"])


@EVERY
@ROOTS
def test_the_third_centre_is_as_far_from_p_as_from_c1_on_the_line_through_g_and_c2(name, prime, at):
    drawn, mu, near = steps(name, "three_arcs"), per_mm(name), tolerance(name)
    step, g, c1, c2 = drawn[at], named(drawn[0], "G").at, named(drawn[1], "C1").at, named(drawn[2], "C2").at
    p, c3 = the(all_of(step, Dots)[0].points)
    side = -1 if prime else 1
    assert abs((p - g) / (c2 - g) * abs(c2 - g) - side * BOARDS[name][0]["rho1"] / mu) < near
    assert abs(across(c2 - g, c3 - g)) < NEAR
    chord, bisector, line = all_of(step, Line)[:3]
    is_bisected([chord, bisector], c1, p, c3, near)
    assert abs(abs(c3 - p) - abs(c3 - c1)) < near
    farthest = max(((a, b) for a in (g, p, c3) for b in (g, p, c3)), key=lambda pair: abs(pair[0] - pair[1]))
    assert set(the(line.points)) == set(farthest)
    assert {mark.role for mark in all_of(step, Line)} == {Role.HIDDEN if prime else Role.CONSTRUCTION}
    for point, place in ((f"P{prime}", p), (f"C3{prime}", c3)):
        assert named(step, point).at == place
        assert is_outward(named(step, point))
    assert abs(told(step, f"C3{prime}") - c3 * mu) < 0.001
    (rho3,) = re.findall(r"G = (\d+\.\d+) mm", str(step.caption))
    assert float(rho3) == pytest.approx(abs(c3 - g) * mu, abs=0.001)


@EVERY
@ROOTS
def test_the_arcs_touch_on_their_line_of_centres(name, prime, at):
    drawn, mu, near = steps(name, "three_arcs"), per_mm(name), tolerance(name)
    step, g, c1, c2 = (
        drawn[at if prime else at + 1],
        *(named(drawn[k], text).at for k, text in enumerate(("G", "C1", "C2"))),
    )
    c3, f, line = named(drawn[at], f"C3{prime}").at, complex(all_of(step, Dots)[-1].points[0]), all_of(step, Line)[-1]
    assert abs(across(c1 - c3, f - c3)) < near
    assert abs(abs(f - c1) - BOARDS[name][0]["rho1"] / mu) < near
    assert abs(abs(f - c3) - abs(g - c3)) < near
    ends = the(line.points)
    assert abs(ends[0] - ends[1]) == pytest.approx(max(abs(f - c3), abs(f - c1), abs(c3 - c1)))
    assert all(min(abs(end - place) for place in (c1, c3, f)) < NEAR for end in ends)
    assert named(step, f"F{prime}").at == f
    assert is_outward(named(step, f"F{prime}"))
    assert abs(told(step, f"F{prime}") - f * mu) < 0.001
    for order in ([(f"F{prime}", f), ("C1", c1), (f"C3{prime}", c3)], [("G", g), (f"C3{prime}", c3), ("C2", c2)]):
        (_, first), *_, (_, last) = order
        places = sorted(order, key=lambda pair: ((pair[1] - first) / (last - first)).real)
        assert ", ".join(text for text, _ in places) in str(step.caption)
    assert ("can be built" in str(step.caption)) == (not prime)


def ends_of(arc: Arc) -> tuple[complex, complex]:
    return arc.centre + cmath.rect(arc.radius, arc.start), arc.centre + cmath.rect(arc.radius, arc.end)


def pairs(arcs: list[Arc]) -> list[tuple[Arc, Arc]]:
    """Each arc of the rise with that of the return."""
    return list(zip(arcs[:6:2], arcs[1:6:2], strict=True))


def are_mirrored(arcs: list[Arc], axis: complex) -> None:
    """Each arc of the return is that of the rise on the other side of a line through O."""
    for one, other in pairs(arcs):
        image = [axis / axis.conjugate() * place.conjugate() for place in (one.centre, *ends_of(one))]
        assert abs(other.centre - image[0]) < NEAR
        assert abs(ends_of(other)[0] - image[2]) + abs(ends_of(other)[1] - image[1]) < NEAR
        assert one.radius == pytest.approx(other.radius)


def dwell_of(name: str) -> float:
    return math.radians(BOARDS[name][1].get("dwell", 40.0))


def middle_of_the_dwell(name: str) -> complex:
    """The direction from O half a dwell from D on, away from G."""
    d, g = (named(steps(name, "three_arcs")[0], text).at for text in "DG")
    return cmath.rect(1, cmath.phase(d) + math.copysign(dwell_of(name) / 2, across(g, d)))


@EVERY
def test_the_profile_is_made_of_arcs_that_touch_and_of_their_mirror_images(name):
    drawn, mu = steps(name, "three_arcs"), per_mm(name)
    step, dwell = drawn[-1], dwell_of(name)
    arcs, g, f = all_of(step, Arc), named(drawn[0], "G").at, named(drawn[4], "F").at
    centres = {text: named(drawn[k], text).at for k, text in ((2, "C2"), (3, "C3"), (1, "C1"))}
    for (arc, _), centre in zip(pairs(arcs), centres.values(), strict=True):
        assert abs(arc.centre - centre) < tolerance(name)
    for joint, (one, _), (other, _) in zip((g, f), pairs(arcs), pairs(arcs)[1:], strict=False):
        assert min(abs(end - joint) for end in ends_of(one)) < tolerance(name)
        assert min(abs(end - joint) for end in ends_of(other)) < tolerance(name)
        assert abs(across(one.centre - joint, other.centre - joint)) < tolerance(name)
    are_mirrored(arcs, middle_of_the_dwell(name))
    assert sum(arc.end - arc.start for arc in arcs) == pytest.approx(2 * math.pi, abs=tolerance(name) / 20)
    assert (len(arcs) == 8) == (dwell > 0)
    if dwell:
        assert arcs[6].end - arcs[6].start == pytest.approx(dwell)
    rho2, rho3, rho1, base, outer, degrees = numbers(step)
    for mark, text, value in zip(all_of(step, Dimension), "₁₂₃", (rho1, rho2, rho3), strict=True):
        symbol, shown = str(mark.text).split(" = ")
        assert (symbol, float(shown)) == (f"ρ{text}", pytest.approx(value, abs=0.006))
        assert abs(mark.end - mark.start) * mu == pytest.approx(value, abs=max(tolerance(name), 0.001))
    radii = [arc.radius * mu for arc in (*arcs[:6:2], arcs[-1])]
    assert radii == pytest.approx([rho2, rho3, rho1, base], abs=max(tolerance(name), 0.001))
    assert outer == pytest.approx(abs(named(drawn[0], "D").at) * mu, abs=0.001)
    assert degrees == pytest.approx(math.degrees(dwell))
    assert {arc.role for arc in arcs} == {Role.RESULT}


# --- the roller ------------------------------------------------------------------------------------------------------


def radius_of_roller(name: str) -> float:
    return BOARDS[name][1].get("roller", 10.0) / per_mm(name)


@EVERY
def test_the_roller_keeps_to_arcs_about_the_same_centres(name):
    step, profile = steps(name, "arc_roller")[0], all_of(steps(name, "three_arcs")[-1], Arc)
    arcs, roller, near = all_of(step, Arc), radius_of_roller(name), tolerance(name)
    paths = arcs[len(profile) :]
    assert [ends_of(arc) for arc in arcs[: len(profile)]] == [ends_of(arc) for arc in profile]
    assert len(paths) == (len(profile) if roller else 0)
    for path, arc in zip(paths, profile, strict=False):
        assert abs(path.centre - arc.centre) < near
        assert abs(path.radius - arc.radius - roller) < near
        assert (path.role, path.end - path.start) == (Role.CURVE, pytest.approx(arc.end - arc.start, abs=near / 10))
        assert math.remainder(path.start - arc.start, math.tau) == pytest.approx(0.0, abs=near / 10)
    are_mirrored(profile, middle_of_the_dwell(name))
    if paths:
        are_mirrored(paths, middle_of_the_dwell(name))
    joints = [named(step, text).at for text in "AGFD"]
    (lines,) = all_of(step, Segments)
    for joint, end, c3 in zip(joints[1:3], lines.starts, lines.ends, strict=True):
        assert abs(abs(end - joint) - roller) < near
        assert abs(c3 - named(steps(name, "three_arcs")[3], "C3").at) < NEAR
        assert abs(across(end - c3, joint - c3)) < near
    for text in "AD":
        assert abs(across(named(step, text).at, named(step, text).towards)) < near
        assert (named(step, text).towards / named(step, text).at).real < 0
    assert (named(step, "O").at, the(all_of(step, Dots)[0].points)) == (0, [0])


@PERFECT
def test_the_cam_angles_of_the_joints_are_the_angles_between_the_lines_from_o(name):
    step, mu = steps(name, "arc_roller")[0], per_mm(name)
    roller, *angles = numbers(step)
    assert roller == pytest.approx(radius_of_roller(name) * mu)
    centres = [named(steps(name, "three_arcs")[k], text).at for k, text in ((2, "C2"), (3, "C3"), (3, "C3"), (1, "C1"))]
    joints = [named(step, text).at for text in "AGFD"]
    on_path = [p + (p - c) / abs(p - c) * radius_of_roller(name) for p, c in zip(joints, centres, strict=True)]
    seen = [abs(math.degrees(cmath.phase(p / on_path[0]))) for p in on_path[1:]]
    assert angles == pytest.approx(seen, abs=0.001)


@EVERY
def test_the_rays_divide_the_angle_of_each_arc_equally_and_meet_it_in_the_rollers_centres(name):
    step, near = steps(name, "arc_roller")[1], tolerance(name)
    (rays,), (rise, back), rollers = (all_of(step, kind) for kind in (Segments, Dots, Circle))
    n = len(rise.points) // 3
    arcs = pairs(all_of(steps(name, "arc_roller")[0], Arc)[-8 if dwell_of(name) else -7 :])
    turn, run = middle_of_the_dwell(name), None
    for k in range(3):
        ways = [
            cmath.phase(end - start) for start, end in list(zip(rays.starts, rays.ends, strict=True))[k * n : k * n + n]
        ]
        parts = [math.remainder(b - a, math.tau) for a, b in pairwise(ways)]
        assert max(parts) - min(parts) < max(NEAR, near / 20)
        run = run or math.copysign(1, parts[0])
        assert all(part * run > 0 for part in parts)
        for b, start, end in zip(
            *(each[k * n : k * n + n] for each in (rise.points, rays.starts, rays.ends)), strict=True
        ):
            assert abs(across(end - start, b - start)) < NEAR
            assert abs(start) < near
            assert abs(end) == pytest.approx(abs(rise.points[-1]) + BEYOND, abs=near)
            assert abs(abs(b - arcs[k][0].centre) - arcs[k][0].radius) < NEAR
    assert (
        max(abs(b - turn / turn.conjugate() * p.conjugate()) for p, b in zip(rise.points, back.points, strict=True))
        < NEAR
    )
    roller = radius_of_roller(name)
    assert [circle.centre for circle in rollers] == (
        [complex(rise.points[k * n + n // 2]) for k in range(3)] if roller else []
    )
    assert all(circle.radius == pytest.approx(roller) for circle in rollers)
    names = [str(label.text) for label in all_of(step, Label)]
    assert names == [str(k) for k in range(3 * n - 2)]
    ends = [rays.ends[k] for k in range(3 * n) if k not in (n - 1, 2 * n - 1)]
    for label, end in zip(all_of(step, Label), ends, strict=True):
        assert abs(label.at - end) < NEAR
        assert abs(across(end, label.towards)) < max(NEAR, near / 50)
        assert (label.towards / end).real > 0
    parts, lift = numbers(step)
    assert parts == n - 1
    assert lift == pytest.approx(abs(rise.points[-1]) - abs(rise.points[0]), abs=max(near, 0.01))


def scale_of_plan(step: Step) -> float:
    """mm of the cam in a mm of the plan."""
    found = re.search(r"at ([\d.]+):([\d.]+):", str(step.caption))
    assert found is not None
    return float(found[2]) / float(found[1])


@EVERY
def test_the_velocity_is_cut_off_by_the_rod_on_the_perpendicular_to_the_followers_line(name):
    step, near = steps(name, "arc_roller")[2], 5 * tolerance(name)
    rod, velocity, cut = all_of(step, Line)[1:]
    o, b, c, k = the(all_of(step, Dots)[0].points)
    assert o == 0
    assert abs(b.real) < near
    assert abs(k.imag) < near
    assert abs(across(b - c, k - c)) < NEAR
    assert [the(line.points) for line in (rod, velocity, cut)] == [[b, c], [o, k], [b, k]]
    low, high = the(all_of(step, Line)[0].points)
    assert (low.real, high) == (0, pytest.approx((b.imag + BEYOND) * 1j))
    for text, place in (("O", o), ("B", b), ("C1", c), ("K", k)):
        assert named(step, text).at == place
    side = named(step, "B").towards
    assert named(step, "K").towards == side
    assert named(step, "O").towards == named(step, "C1").towards == -side - 1j
    paper, v = numbers(step)[-2:]
    assert paper == pytest.approx(abs(k), abs=0.01)
    assert v == pytest.approx(paper * scale_of_plan(step), rel=0.001 if near < 1 else 0.1)
    # Seen with the follower upright, the cam turns away from the side on which the velocity lies.
    d, g = (named(steps(name, "three_arcs")[0], text).at for text in "DG")
    sigma = math.copysign(1, across(d, g))
    assert side == -sigma
    assert k.real * sigma * v > 0


@EVERY
def test_the_acceleration_follows_by_the_theorem_of_the_height(name):
    velocity, step, near = *steps(name, "arc_roller")[2:4], 5 * tolerance(name)
    _, b, c, k = the(all_of(velocity, Dots)[0].points)
    right, beyond, n, m = the(all_of(step, Dots)[0].points)
    assert abs(abs(right - c) - abs(k - c)) < near
    assert abs(((right - c) / (b - c)).real) < max(NEAR, near / 50)
    assert abs(((b - right) / (beyond - right)).real) < max(NEAR, near / 50)
    assert abs(across(b - c, beyond - c)) < NEAR
    assert abs(abs(n - c) - abs(beyond - c)) < near
    assert ((n - c) / (b - c)).real > 0 > ((beyond - c) / (b - c)).real
    assert abs(abs(n - c) * abs(b - c) - abs(k - c) ** 2) < near * abs(b - c)
    assert abs(across((b - c) * 1j, m - n)) < near
    assert abs(m.real) < near
    lines = [the(line.points) for line in all_of(step, Line)]
    assert lines == [[c, right, b], [right, beyond, c], [n, m], [0, m]]
    for text, place in (("N′", beyond), ("N", n), ("M", m)):
        assert named(step, text).at == place
    assert named(step, "N").towards == named(velocity, "B").towards
    assert named(step, "N′").towards == named(step, "M").towards == -named(velocity, "B").towards
    paper, a = numbers(step)[-2:]
    assert paper == pytest.approx(abs(m), abs=0.01)
    assert abs(a) == pytest.approx(paper * scale_of_plan(velocity), rel=0.001 if near < 1 else 0.1)
    assert (a > 0) == (m.imag < 0) == ("away from" in str(step.caption))


# --- the diagrams ----------------------------------------------------------------------------------------------------

DIAGRAMS = pytest.mark.parametrize(("k", "key"), list(enumerate(("a", "v", "s", "alpha"))))


def laid_off_at(step: Step) -> float:
    """Machine units in a mm of the ordinates; degrees in a mm of angles."""
    found = re.search(r"laid off at ([\d.]+)", str(step.caption))
    assert found is not None
    return float(found[1])


@PERFECT
@DIAGRAMS
def test_the_ordinates_are_the_lift_and_its_derivatives(name, k, key):
    """Ruler and compass make no error here, so the dots are where the exact motion is."""
    step, (data, changes) = steps(name, "arc_diagrams")[k], BOARDS[name]
    dwell = dwell_of(name)
    motion = three_arc_cam(**data)[0].motion(changes.get("roller", 10.0), dwell)
    stations = chain(name).stations
    phi, (s, v, a, _) = motion.at(stations.arc, stations.u)
    exact = {"s": s, "v": v, "a": a, "alpha": np.degrees(np.arctan2(v, motion.prime_radius + s))}[key]
    dots = all_of(step, Dots)[0].points
    assert np.allclose(dots.real, np.degrees(phi), atol=1e-6)  # a degree is a millimetre
    assert np.allclose(dots.imag, exact / laid_off_at(step), atol=1e-6)
    edges = np.degrees(motion.edges[:4])
    down = 2 * edges[-1] + math.degrees(dwell) - edges[::-1]
    (limits,) = (mark for mark in all_of(step, Segments) if mark.role == Role.CONSTRUCTION)
    heights = all_of(step, Line)[-1].points.imag
    assert np.allclose(limits.starts, np.array([*edges[1:], *down, 360]) + 1j * heights.min(), atol=1e-6)
    assert np.allclose(limits.ends, np.array([*edges[1:], *down, 360]) + 1j * heights.max(), atol=1e-6)


@EVERY
@DIAGRAMS
def test_the_curve_passes_through_the_ordinates_and_returns_as_its_mirror_image(name, k, key):
    step = steps(name, "arc_diagrams")[k]
    curve, dots = the(all_of(step, Line)[-1].points), the(all_of(step, Dots)[0].points)
    assert all(min(abs(point - dot) for point in curve) < NEAR for dot in dots)
    n = (len(curve) - 4) // 2
    rise, (up, held), back, rest = curve[:n], curve[n : n + 2], curve[n + 2 : -2], curve[-2:]
    sense = -1 if key in ("v", "alpha") else 1
    for point, image in zip(rise, reversed(back), strict=True):
        assert abs(image - complex((up + held).real - point.real, sense * point.imag)) < NEAR
    assert held.imag == up.imag == pytest.approx(dots[-1].imag if key == "s" else 0.0)
    assert held.real - up.real == pytest.approx(math.degrees(dwell_of(name)), abs=tolerance(name))
    assert [end.imag for end in rest] == [0, 0]
    assert rest[1].real == pytest.approx(360.0, abs=tolerance(name))
    assert rest[0].real == pytest.approx(back[-1].real, abs=tolerance(name))
    roles = [mark.role for mark in (*all_of(step, Line)[-1:], all_of(step, Dots)[0])]
    assert roles == [Role.RESULT, Role.CONSTRUCTION]


@EVERY
@DIAGRAMS
def test_the_greatest_is_told_as_it_is_drawn(name, k, key):
    step = steps(name, "arc_diagrams")[k]
    dots, *tops = all_of(step, Dots)
    degree, scale = float(re.findall(r"([\d.]+)° a millimetre", str(step.caption))[0]), laid_off_at(step)
    assert degree == 1.0
    if key == "s":
        assert tops == []
        assert numbers(step)[-1] == pytest.approx(dots.points[-1].imag * scale, abs=0.001)
        return
    ((top,),) = (the(mark.points) for mark in tops)
    assert tops[0].role == Role.LIMIT
    reached = max(dots.points, key=lambda dot: abs(dot.imag))
    assert abs(top.imag) > abs(reached.imag) - tolerance(name)
    assert min(abs(point - top) for point in all_of(step, Line)[-1].points) < 2.5
    (label,) = (mark for mark in all_of(step, Label) if mark.at == top)
    assert float(str(label.text)) == pytest.approx(top.imag * scale, abs=0.006)
    assert label.towards == (1j if top.imag > 0 else -1j)
    assert numbers(step)[-1] == pytest.approx(abs(top.imag) * scale, abs=0.001)
    if key != "alpha":
        assert numbers(step)[-2] == pytest.approx(abs(top.imag), abs=0.006)


@EVERY
def test_the_dimensions_of_the_phases_measure_what_they_say(name):
    step = steps(name, "arc_diagrams")[3]
    dimensions, lowest = all_of(step, Dimension), all_of(step, Line)[-1].points.imag.min()
    phases = ["rise", "dwell", "return", "rest"] if dwell_of(name) else ["rise", "return", "rest"]
    assert [str(mark.text).split()[0] for mark in dimensions] == phases
    for mark in dimensions:
        assert float(str(mark.text).split()[1].rstrip("°")) == pytest.approx(mark.end.real - mark.start.real, abs=0.006)
        assert mark.start.imag == mark.end.imag == pytest.approx(lowest - 24.0)
    edges = [0.0, *(mark.end.real for mark in dimensions)]
    assert [mark.start.real for mark in dimensions] == pytest.approx(edges[:-1], abs=NEAR)
    assert edges[-1] == pytest.approx(360.0, abs=tolerance(name))
