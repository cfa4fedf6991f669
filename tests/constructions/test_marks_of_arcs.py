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
from over_all import over_all
from test_arc_drawing import CASES, EXAMPLE, MIRRORED, board_of

import graphcam as gc
from graphcam.constructions.arc_chain import ArcBoard, ArcChain
from graphcam.drafting.ink import Step
from graphcam.drafting.marks import AngleMark, Arc, Arrow, Circle, Dimension, Dots, Label, Line, Role, Segments
from graphcam.mechanism.three_arc_cam import three_arc_cam

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
EVERY = over_all("name", BOARDS)
PERFECT = over_all("name", [name for name in BOARDS if name != "by hand"])


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


def plotted(step: Step) -> list[complex]:
    """All dots, in order."""
    return [complex(p) for dots in all_of(step, Dots) for p in dots.points]


def captions(step: Step) -> list[str]:
    return [str(place.caption) for place in step.places]


def the(points: Any) -> list[complex]:
    return [complex(p) for p in points]


# --- the arcs --------------------------------------------------------------------------------------------------------


@EVERY
def test_the_given_points_are_plotted_where_the_data_say(name):
    step, mu, data = steps(name, "three_arcs")[0], per_mm(name), BOARDS[name][0]
    given, dots = [point for point in "ADG" if point in data], plotted(step)
    assert dots[0] == 0
    for at, point, said in zip(dots[1:], given, captions(step), strict=True):
        x, y = data[point]
        assert abs(at - complex(x, y) / mu) < tolerance(name)
        assert named(step, point).at == at
        assert is_outward(named(step, point))
        assert told(step, point) == complex(x, y)
        ways = [f"{abs(x) / mu:.2f} mm to the {'right' if x > 0 else 'left'}"] * bool(x)
        ways += [f"{abs(y) / mu:.2f} mm {'up' if y > 0 else 'down'}"] * bool(y)
        plotting = f"{point} = ({x:g}, {y:g}) mm: from O lay off {' and '.join(ways)}."
        assert said.endswith(plotting)
        assert (said == plotting) == (point != given[0])
    assert f"every length times {1 / mu:g}." in str(step.caption)
    assert (named(step, "O").at, named(step, "O").towards) == (0, -1 - 1j)
    for axis, way in zip(all_of(step, Line), (1, 1j), strict=True):
        assert np.allclose(axis.points, np.array([-1, 1]) * way * (math.hypot(*data["D"]) / mu + OVERHANG), atol=NEAR)
    assert set(map(id, step.given)) == set(map(id, step.marks))


@EVERY
def test_the_first_circle_touches_the_outer_one_in_d(name):
    step, mu, data = steps(name, "three_arcs")[1], per_mm(name), BOARDS[name][0]
    (line,), (circle, outer), (c1, d), (label,) = (
        all_of(step, Line),
        all_of(step, Circle),
        plotted(step),
        all_of(step, Label),
    )
    assert abs(d - named(steps(name, "three_arcs")[0], "D").at) < (BY_HAND if name == "by hand" else DATA)
    assert abs(outer.centre) + abs(outer.radius - abs(d)) < tolerance(name)
    assert abs(circle.centre - c1) < tolerance(name)
    assert abs(circle.radius - data["rho1"] / mu) < tolerance(name)
    assert abs(abs(c1) + circle.radius - outer.radius) < tolerance(name)
    start, end = the(line.points)
    assert start == 0
    assert abs(end - d) == pytest.approx(OVERHANG)
    assert abs(end) > abs(d)
    assert max(abs(across(end, c1)), abs(across(end, d))) < tolerance(name)
    assert (str(label.text), label.at) == ("C₁", c1)
    assert is_outward(label, d)
    assert abs(told(step, "C₁") - c1 * mu) < max(tolerance(name), 0.001)
    set_to = [float(found) for found in re.findall(r"compass ([\d.]+) mm", str(step.caption))]
    assert set_to == pytest.approx([data["rho1"] / mu, abs(d)], abs=0.006)
    assert ("C1" in data) == ("D is the one beyond C₁" in str(step.caption))
    assert ("C1" not in data) == ("from D towards O" in str(step.caption))


@EVERY
def test_the_second_centre_is_as_far_from_a_as_from_g_and_lies_on_a_line_through_o(name):
    step, mu, data = steps(name, "three_arcs")[2], per_mm(name), BOARDS[name][0]
    g, (c2, a) = named(steps(name, "three_arcs")[0], "G").at, plotted(step)
    base, (axis, radius, *bisected) = all_of(step, Circle)[0], all_of(step, Line)
    assert abs(abs(c2 - a) - abs(c2 - g)) < tolerance(name)
    assert (the(radius.points), axis.points[1]) == ([g, c2], c2)
    assert abs(across(c2, a)) < NEAR
    assert abs(axis.points[0] - a) == pytest.approx(OVERHANG)
    assert abs(axis.points[0]) > abs(a)
    assert abs(a - c2) > abs(c2)  # O lies between them
    assert abs(base.centre) + abs(base.radius - abs(a)) < tolerance(name)
    assert abs(told(step, "C₂") - c2 * mu) < max(tolerance(name), 0.001)
    (swept,) = all_of(step, Arc)
    assert abs(swept.centre - c2) + abs(swept.radius - abs(g - c2)) < tolerance(name)
    more = OVERHANG / swept.radius
    (low, high), ends = sorted((cmath.phase(g - c2), cmath.phase(a - c2))), (swept.start + more, swept.end - more)
    assert ends == pytest.approx((low, high), abs=max(1e-6, tolerance(name) / 50))
    paper, factor, rho2 = (float(x) for x in re.findall(r"C₂ G = (\S+) mm × (\S+) = (\S+) mm", str(step.caption))[0])
    assert (paper, factor) == (pytest.approx(abs(c2 - g), abs=0.006), mu)
    assert rho2 == pytest.approx(abs(c2 - g) * mu, abs=0.001)
    assert numbers(step)[-1] == pytest.approx(abs(a), abs=0.006)
    if "C2" not in data:
        (compass,) = re.findall(r"Bisect AG: compass (\S+) mm", str(step.caption))
        assert float(compass) == pytest.approx(0.8 * abs(g - complex(*data["A"]) / mu), abs=max(0.006, tolerance(name)))
    assert named(step, "C₂").at == c2
    assert is_outward(named(step, "C₂"))
    assert ("A" in data) or named(step, "A").at == a
    assert bool(bisected) == ("C2" not in data)
    if bisected:
        is_bisected(bisected, named(steps(name, "three_arcs")[0], "A").at, g, c2, tolerance(name))


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


ROOTS = over_all(("prime", "at"), [("", 3), ("′", 5)])


@EVERY
@ROOTS
def test_the_third_centre_is_as_far_from_p_as_from_c1_on_the_line_through_g_and_c2(name, prime, at):
    drawn, mu, near = steps(name, "three_arcs"), per_mm(name), tolerance(name)
    step, g, c1, c2 = drawn[at], named(drawn[0], "G").at, named(drawn[1], "C₁").at, named(drawn[2], "C₂").at
    p, c3 = plotted(step)[:2]
    side = -1 if prime else 1
    assert str(step.title) == ("The other root" if prime else "The third centre")
    rho1 = BOARDS[name][0]["rho1"] / mu
    first = f"Set the dividers to {rho1:.2f} mm, ρ₁, and lay it off on the line G C₂ from G"
    assert captions(step)[0] == f"{first} {'away from' if prime else 'towards'} C₂: P{prime}."
    (compass,) = re.findall(r"compass (\S+) mm", str(step.caption))
    assert float(compass) == pytest.approx(0.8 * abs(p - c1), abs=0.006)
    assert abs((p - g) / (c2 - g) * abs(c2 - g) - side * BOARDS[name][0]["rho1"] / mu) < near
    assert abs(across(c2 - g, c3 - g)) < NEAR
    line, chord, bisector = all_of(step, Line)[:3]
    is_bisected([chord, bisector], c1, p, c3, near)
    assert abs(abs(c3 - p) - abs(c3 - c1)) < near
    farthest = max(((a, b) for a in (g, p, c3) for b in (g, p, c3)), key=lambda pair: abs(pair[0] - pair[1]))
    assert set(the(line.points)) == set(farthest)
    assert {mark.role for mark in all_of(step, Line)} == {Role.HIDDEN if prime else Role.CONSTRUCTION}
    for point, place in ((f"P{prime}", p), (f"C₃{prime}", c3)):
        assert named(step, point).at == place
        assert is_outward(named(step, point))
    assert abs(told(step, f"C₃{prime}") - c3 * mu) < 0.001
    ((paper, factor, rho3),) = re.findall(r"G = (\S+) mm × (\S+) = (\S+) mm", str(step.caption))
    assert (float(paper), float(factor)) == (pytest.approx(abs(c3 - g), abs=0.006), mu)
    assert float(rho3) == pytest.approx(abs(c3 - g) * mu, abs=0.001)


@EVERY
@ROOTS
def test_the_arcs_touch_on_their_line_of_centres(name, prime, at):
    drawn, mu, near = steps(name, "three_arcs"), per_mm(name), tolerance(name)
    step, g, c1, c2 = (
        drawn[at if prime else at + 1],
        *(named(drawn[k], text).at for k, text in enumerate(("G", "C₁", "C₂"))),
    )
    c3, f, line = named(drawn[at], f"C₃{prime}").at, plotted(step)[-1], all_of(step, Line)[-1]
    (far,) = re.findall(r"The crossing (\S+) mm from C₃", str(step.caption))
    assert float(far) == pytest.approx(abs(g - c3), abs=0.006)
    assert abs(across(c1 - c3, f - c3)) < near
    assert abs(abs(f - c1) - BOARDS[name][0]["rho1"] / mu) < near
    assert abs(abs(f - c3) - abs(g - c3)) < near
    ends = the(line.points)
    assert abs(ends[0] - ends[1]) == pytest.approx(max(abs(f - c3), abs(f - c1), abs(c3 - c1)))
    assert all(min(abs(end - place) for place in (c1, c3, f)) < NEAR for end in ends)
    assert named(step, f"F{prime}").at == f
    assert is_outward(named(step, f"F{prime}"))
    assert abs(told(step, f"F{prime}") - f * mu) < 0.001
    for order in ([(f"F{prime}", f), ("C₁", c1), (f"C₃{prime}", c3)], [("G", g), (f"C₃{prime}", c3), ("C₂", c2)]):
        (_, first), *_, (_, last) = order
        places = sorted(order, key=lambda pair: ((pair[1] - first) / (last - first)).real)
        assert ", ".join(text for text, _ in places) in str(step.caption)
    assert ("can be made" in str(step.caption)) == (not prime)


def ends_of(arc: Arc) -> tuple[complex, complex]:
    return arc.centre + cmath.rect(arc.radius, arc.start), arc.centre + cmath.rect(arc.radius, arc.end)


def pairs(arcs: list[Arc]) -> list[tuple[Arc, Arc]]:
    """Each arc of the rise with that of the return."""
    return list(zip(arcs[:3], arcs[-2:-5:-1], strict=True))


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
    g, (_, d) = named(steps(name, "three_arcs")[0], "G").at, plotted(steps(name, "three_arcs")[1])
    return cmath.rect(1, cmath.phase(d) + math.copysign(dwell_of(name) / 2, across(g, d)))


@EVERY
def test_the_profile_is_made_of_arcs_that_touch_and_of_their_mirror_images(name):
    drawn, mu = steps(name, "three_arcs"), per_mm(name)
    step, dwell = drawn[-1], dwell_of(name)
    arcs, g, f = all_of(step, Arc), named(drawn[0], "G").at, named(drawn[4], "F").at
    centres = {text: named(drawn[k], text).at for k, text in ((2, "C₂"), (3, "C₃"), (1, "C₁"))}
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
        assert arcs[3].end - arcs[3].start == pytest.approx(dwell)
    rise = re.findall(r"Arc (\w\w) about (C[₁₂₃]): compass (\S+) mm, (\S+) = (\S+) mm", str(step.caption))
    assert [row[:2] for row in rise] == [("AG", "C₂"), ("GF", "C₃"), ("FD", "C₁")]
    rho2, rho3, rho1 = (float(row[-1]) for row in rise)
    assert [float(row[2]) for row in rise] == pytest.approx(
        [arc.radius for arc in arcs[:3]], abs=max(0.006, tolerance(name))
    )
    back = re.findall(r"Mirror (C[₁₂₃]) and the ends of (\w\w) .*?compass (\S+) mm", str(step.caption))
    assert [(arc, centre) for centre, arc, _ in back] == [row[:2] for row in rise[::-1]]
    assert [float(radius) for *_, radius in back] == [float(row[2]) for row in rise[::-1]]
    dwells = re.findall(r"([UL]\w+) dwell, .*?compass (\S+) mm, (\S+) mm of the cam", str(step.caption))
    assert [kind for kind, *_ in dwells] == (["Upper", "Lower"] if dwell else ["Lower"])
    on_paper = [arc.radius for arc in arcs[3:-4]] + [arcs[-1].radius]
    assert [float(paper) for _, paper, _ in dwells] == pytest.approx(on_paper, abs=max(0.006, tolerance(name)))
    assert [float(value) for *_, value in dwells] == pytest.approx(
        [x * mu for x in on_paper], abs=max(0.001, tolerance(name))
    )
    base, (axis,) = float(dwells[-1][2]), all_of(step, Line)
    assert axis.points[0] == 0
    assert abs(across(middle_of_the_dwell(name), complex(axis.points[1]))) < tolerance(name)
    assert abs(axis.points[1]) == pytest.approx(abs(plotted(drawn[1])[1]) + OVERHANG, abs=tolerance(name))
    if dwell:
        ((degrees, sense),) = re.findall(r"from D (\S+)° (\w+) about O", str(step.caption))
        ((half, again),) = re.findall(r"protractor to (\S+)° from OD, (\w+)", str(step.caption))
        d = named(drawn[0], "D").at
        turned = math.degrees(cmath.phase(complex(axis.points[1]) / d))
        assert (float(degrees), float(half)) == (math.degrees(dwell), pytest.approx(abs(turned), abs=1.0))
        assert sense == again == ("clockwise" if turned < 0 else "anticlockwise")
    for mark, text, value in zip(all_of(step, Dimension), "₂₃₁", (rho2, rho3, rho1), strict=True):
        symbol, shown = str(mark.text).split(" = R")
        assert mark.of_radius
        assert (symbol, float(shown)) == (f"ρ{text}", pytest.approx(value, abs=0.006))
        assert abs(mark.end - mark.start) * mu == pytest.approx(value, abs=max(tolerance(name), 0.001))
    radii = [arc.radius * mu for arc in (*arcs[:3], arcs[-1])]
    assert radii == pytest.approx([rho2, rho3, rho1, base], abs=max(tolerance(name), 0.001))
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
    line = "the middle line of the dwell" if dwell_of(name) else "the line OD"
    assert f"Return: mirror the points B in {line}." in str(steps(name, "arc_roller")[2].caption)
    assert (f"Return: the three arcs, mirrored in {line}." in captions(step)) == bool(roller)
    for path, arc in zip(paths, profile, strict=False):
        assert abs(path.centre - arc.centre) < near
        assert abs(path.radius - arc.radius - roller) < near
        assert (path.role, path.end - path.start) == (Role.CURVE, pytest.approx(arc.end - arc.start, abs=near / 10))
        assert math.remainder(path.start - arc.start, math.tau) == pytest.approx(0.0, abs=near / 10)
    are_mirrored(profile, middle_of_the_dwell(name))
    if paths:
        are_mirrored(paths, middle_of_the_dwell(name))
    joints, (lines,) = [named(step, text).at for text in "AGFD"], all_of(step, Segments)
    c3, c1 = named(steps(name, "three_arcs")[3], "C₃").at, named(steps(name, "three_arcs")[1], "C₁").at
    assert [named(step, text).at for text in ("C₃", "C₁")] == [c3, c1]
    for joint, end, centre, at in zip(joints[1:], lines.starts, lines.ends, (c3, c3, c1), strict=True):
        assert centre == at
        assert abs(abs(end - joint) - roller) < near
        assert abs(across(end - centre, joint - centre)) < near
    for text in "AD":
        assert abs(across(named(step, text).at, named(step, text).towards)) < near
        assert (named(step, text).towards / named(step, text).at).real < 0
    assert (named(step, "O").at, named(step, "O").towards, plotted(step)[0]) == (0, -1 - 1j, 0)
    (prime,) = all_of(step, Circle)
    assert abs(prime.centre) + abs(prime.radius - abs(joints[0]) - roller) < near
    said = [float(found) for found in re.findall(r"compass (\S+) mm", " ".join(captions(step)))]
    shown = [arc.radius for arc in paths[:-4]] + [prime.radius]
    assert said == pytest.approx(shown, abs=0.006)


@over_all("name", ["case 2", "clockwise"])
def test_the_arcs_of_the_path_pass_through_a_through_g_and_through_d(name):
    """Where the lengths that were set off have errors, the two ends of an arc lie at different distances."""
    data, changes = BOARDS[name]
    errs = ArcChain(board_of(data, **changes), gc.Pencil(dividers=0.2, seed=8, only=frozenset({"lay off"})))
    step = errs["arc_roller"].steps()[0]
    (lines,), (first, middle, last) = all_of(step, Segments), all_of(step, Arc)[-8:-5]
    to_g, to_f, to_d = np.abs(lines.starts - lines.ends)
    assert (middle.radius, last.radius) == (pytest.approx(to_g, abs=1e-9), pytest.approx(to_d, abs=1e-9))
    assert abs(to_f - middle.radius) > 0.01
    a, g = errs["arc_roller"].points["trace"][:2]
    assert first.radius == pytest.approx(abs(a - first.centre), abs=1e-9)
    assert abs(abs(g - first.centre) - first.radius) > 0.01


@PERFECT
def test_the_radii_of_the_path_are_told_as_they_are_drawn(name):
    step, mu, roller = steps(name, "arc_roller")[0], per_mm(name), radius_of_roller(name)
    paths, (prime,) = all_of(step, Arc)[-8 if dwell_of(name) else -7 :], all_of(step, Circle)
    if not roller:
        assert str(step.caption).startswith("The knife edge")
        assert numbers(step) == [pytest.approx(prime.radius, abs=0.006)]
        return
    assert numbers(step) == pytest.approx([roller * mu, roller, paths[0].radius, prime.radius], abs=0.006)
    out = [said for said in captions(step) if said.startswith("From")]
    joints = (("A", "O"), ("G", "C₃"), ("F", "C₃"), ("D", "C₁"))
    assert out == [f"From {p}: on the line from {c}." for p, c in joints]
    assert f"from every joint set {roller:.2f} mm off outward on its line of centres" in str(step.caption)


@PERFECT
def test_the_cam_angles_of_the_joints_are_the_angles_between_the_lines_from_o(name):
    paths, step = steps(name, "arc_roller")[:2]
    centres = [named(steps(name, "three_arcs")[k], text).at for k, text in ((2, "C₂"), (3, "C₃"), (3, "C₃"), (1, "C₁"))]
    joints = [named(paths, text).at for text in "AGFD"]
    on_path = [p + (p - c) / abs(p - c) * radius_of_roller(name) for p, c in zip(joints, centres, strict=True)]
    (lines,) = all_of(step, Segments)
    assert np.allclose(lines.starts, 0, atol=NEAR)
    assert np.allclose(lines.ends, on_path, atol=NEAR)
    turned = [math.degrees(cmath.phase(p / on_path[0])) for p in on_path[1:]]
    seen = [abs(angle) for angle in turned]
    assert numbers(step) == pytest.approx(seen, abs=0.001)
    sense = "clockwise" if turned[0] < 0 else "anticlockwise"
    assert re.findall(r"\b\w*clockwise", str(step.caption)) == [sense]
    rows = [f"Line O{joint}: {angle:.3f}°." for joint, angle in zip("GFD", seen, strict=True)]
    assert captions(step) == ["Line OA.", *rows]
    for mark, angle, end in zip(all_of(step, AngleMark), seen, on_path[1:], strict=True):
        assert str(mark.text) == f"{angle:.2f}°"
        assert math.degrees(mark.end - mark.start) == pytest.approx(angle)
        sides = [cmath.phase(p) for p in ((end, on_path[0]) if sense == "clockwise" else (on_path[0], end))]
        apart = [math.remainder(a - b, math.tau) for a, b in zip((mark.start, mark.end), sides, strict=True)]
        assert apart == pytest.approx([0, 0], abs=NEAR)


@EVERY
def test_the_rays_divide_the_angle_of_each_arc_equally_and_meet_it_in_the_rollers_centres(name):
    step, near = steps(name, "arc_roller")[2], tolerance(name)
    (rays, lifts), (rise, back), rollers = (all_of(step, kind) for kind in (Segments, Dots, Circle))
    n, (prime,) = len(rise.points) // 3, all_of(steps(name, "arc_roller")[0], Circle)
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
    assert np.allclose(np.abs(lifts.starts - prime.centre), prime.radius, atol=NEAR)
    assert np.array_equal(lifts.ends, rise.points)
    roller = radius_of_roller(name)
    assert [circle.centre for circle in rollers] == (
        [complex(rise.points[k * n + n // 2]) for k in range(3)] if roller else []
    )
    assert all(circle.radius == pytest.approx(roller) for circle in rollers)
    names = [str(label.text) for label in all_of(step, Label)]
    assert names == [str(k) for k in range(3 * n - 2)]
    ends = [rays.ends[k] for k in range(3 * n) if k not in (n, 2 * n)]
    for label, end in zip(all_of(step, Label), ends, strict=True):
        assert abs(label.at - end) < max(NEAR, near / 50)
        assert abs(across(end, label.towards)) < max(NEAR, near / 50)
        assert (label.towards / end).real > 0


CENTRES = ("C₂", "C₃", "C₁")


def station_of(name: str, title: str) -> int:
    """The place among all stations of "4", the first of that name, or of "4 on GF"."""
    number, _, arc = title.partition(" on ")
    names, arcs = chain(name).stations.names, chain(name).stations.arc
    return next(k for k, each in enumerate(names) if each == number and (not arc or ("AG", "GF", "FD")[arcs[k]] == arc))


@PERFECT
def test_every_ray_is_told_with_its_angle_its_arc_and_how_far_the_roller_is_out(name):
    step, (prime,) = steps(name, "arc_roller")[2], all_of(steps(name, "arc_roller")[0], Circle)
    rise, parts, mu = the(all_of(step, Dots)[0].points), len(chain(name).stations.u) // 3 - 1, per_mm(name)
    turned = [math.degrees(cmath.phase(b / rise[0])) for b in rise]
    sense = "clockwise" if turned[1] < 0 else "anticlockwise"
    *rays, back = captions(step)
    assert back.startswith("Return: mirror the points B")
    assert len(rays) == 3 * parts + 1
    for k, said in enumerate(rays):
        at = station_of(name, str(k))
        assert said.startswith(f"Ray {k}: {abs(turned[at]):.3f}°, on the ")
        out = abs(rise[at]) - prime.radius
        if out > 0.01:
            centre = CENTRES[int(chain(name).stations.arc[at])]
            assert said.endswith(f"°, on the arc about {centre} {out:.2f} mm outside the prime circle.")
        else:
            assert said.endswith("°, on the prime circle.")
    at = 2 * (parts + 1) + round(parts / 2)
    out = abs(rise[at]) - prime.radius
    number = int(chain(name).stations.names[at])
    exact = [parts, number, abs(turned[at]), out, mu, out * mu]
    assert numbers(step) == pytest.approx(exact, abs=0.0051)
    assert f"the other way, {sense}." in str(step.caption)


SCALES = (0.05, 0.1, 0.2, 0.25, 0.4, 0.5, 1.0, 2.0, 2.5, 4.0, 5.0, 10.0, 15.0, 20.0)
"""mm of the cam in a mm of paper, of the standard scales."""


def fits(size: float, scale: float, room: float) -> bool:
    """Whether a drawing of that size [mm of paper] has the largest scale at which it is not larger than its room."""
    return size <= room < size * scale / SCALES[SCALES.index(scale) - 1]


@PERFECT
def test_plan_and_diagrams_are_drawn_as_large_as_there_is_room_for(name):
    velocity, acceleration = steps(name, "arc_roller")[3:5]
    places = np.array([*plotted(velocity), *plotted(acceleration)])
    assert fits(max(np.ptp(places.real), np.ptp(places.imag)), scale_of_plan(velocity), 190.0)
    for step, room in zip(steps(name, "arc_diagrams"), (100.0, 80.0, 60.0), strict=False):
        heights = all_of(step, Dots)[0].points.imag
        low, high = min(0.0, heights.min()), max(0.0, heights.max())
        size = 2 * high if step.view.name == "velocity" else high - low
        assert fits(size, laid_off_at(step), room), str(step.title)


def scale_of_plan(step: Step) -> float:
    """mm of the cam in a mm of the plan."""
    found = re.search(r"at ([\d.]+):([\d.]+) with", str(step.caption))
    assert found is not None
    return float(found[2]) / float(found[1])


@EVERY
def test_the_velocity_is_cut_off_by_the_rod_on_the_perpendicular_to_the_followers_line(name):
    step, near = steps(name, "arc_roller")[3], 5 * tolerance(name)
    parts = len(chain(name).stations.u) // 3 - 1
    station = 2 * parts + round(parts / 2)  # in the middle of the third arc
    titles = [str(each.title) for each in steps(name, "arc_roller")[3:5]]
    assert titles == [f"{what} at station {station}" for what in ("Velocity", "Acceleration")]
    rod, velocity, cut = all_of(step, Line)[1:]
    o, b, c, k = plotted(step)
    assert o == 0
    assert abs(b.real) < near
    assert abs(k.imag) < near
    assert abs(across(b - c, k - c)) < NEAR
    for line, ends in ((rod, [b, c]), (velocity, [o, k]), (cut, [b, k])):
        assert np.allclose(line.points, ends, atol=NEAR)
    low, high = the(all_of(step, Line)[0].points)
    assert (low.real, high) == (0, pytest.approx((b.imag + BEYOND) * 1j))
    m = named(steps(name, "arc_roller")[4], "M").at
    assert low.imag == pytest.approx(min(0.0, m.imag, c.imag) - BEYOND)
    for text, place in (("O", o), ("B", b), ("C₁", c), ("K", k)):
        assert named(step, text).at == place
    side = named(step, "B").towards
    assert named(step, "K").towards == side
    assert named(step, "O").towards == named(step, "C₁").towards == -side - 1j
    ob, oc, bc, paper, scale, v = numbers(step)[-6:]
    assert (ob, oc, bc) == pytest.approx((abs(b), abs(c), abs(b - c)), abs=0.006)
    assert f"on the {'left' if c.real < 0 else 'right'} of the line" in str(step.caption)
    assert paper == pytest.approx(abs(k), abs=0.006)
    assert scale == scale_of_plan(step)
    assert v == pytest.approx(paper * scale, rel=0.001 if near < 1 else 0.1)
    assert f"every length times {per_mm(name) / scale:g}." in str(step.caption)
    # Seen with the follower upright, the cam turns away from the side on which the velocity lies.
    d, g = (named(steps(name, "three_arcs")[0], text).at for text in "DG")
    sigma = math.copysign(1, across(d, g))
    assert side == -sigma
    assert k.real * sigma * v > 0


@EVERY
def test_the_acceleration_follows_by_the_theorem_of_the_height(name):
    velocity, step, near = *steps(name, "arc_roller")[3:5], 5 * tolerance(name)
    _, b, c, k = plotted(velocity)
    right, beyond, n, m = plotted(step)
    assert abs(abs(right - c) - abs(k - c)) < near
    assert abs(((right - c) / (b - c)).real) < max(NEAR, near / 50)
    assert ((right - c) / (b - c)).imag > 0  # to the left, going from C1 to B
    assert abs(((b - right) / (beyond - right)).real) < max(NEAR, near / 50)
    assert abs(across(b - c, beyond - c)) < NEAR
    assert abs(abs(n - c) - abs(beyond - c)) < near
    assert ((n - c) / (b - c)).real > 0 > ((beyond - c) / (b - c)).real
    assert abs(abs(n - c) * abs(b - c) - abs(k - c) ** 2) < near * abs(b - c)
    assert abs(across((b - c) * 1j, m - n)) < near
    assert abs(m.real) < near
    lines = [[c, right], [right, b], [right, beyond], [beyond, c], [n, m], [0, m]]
    for line, ends in zip(all_of(step, Line), lines, strict=True):
        assert np.allclose(line.points, ends, atol=NEAR)
    for text, place in (("E", right), ("N′", beyond), ("N", n), ("M", m)):
        assert named(step, text).at == place
    assert named(step, "N").towards == named(step, "E").towards == named(velocity, "B").towards
    assert named(step, "N′").towards == named(step, "M").towards == -named(velocity, "B").towards
    ck, cn, paper, scale, a = numbers(step)
    assert (ck, cn, paper) == pytest.approx((abs(k - c), abs(n - c), abs(m)), abs=0.006)
    assert scale == scale_of_plan(velocity)
    assert abs(a) == pytest.approx(paper * scale, rel=0.001 if near < 1 else 0.1)
    assert (a > 0) == (m.imag < 0) == ("away from" in str(step.caption))


@PERFECT
def test_the_velocities_of_all_stations_are_cut_off_by_their_rods(name):
    stations, step, mu = steps(name, "arc_roller")[2], steps(name, "arc_roller")[5], per_mm(name)
    b, k, (rods, velocities) = the(all_of(stations, Dots)[0].points), plotted(step), all_of(step, Segments)
    centres = [named(steps(name, "three_arcs")[j], text).at for j, text in ((2, "C₂"), (3, "C₃"), (1, "C₁"))]
    assert np.allclose(rods.starts, b, atol=NEAR)
    assert np.allclose(rods.ends, k, atol=NEAR)
    assert np.allclose(velocities.starts, 0, atol=NEAR)
    assert np.allclose(velocities.ends, k, atol=NEAR)
    for j, (at, cut) in enumerate(zip(b, k, strict=True)):
        centre = centres[int(chain(name).stations.arc[j])]
        assert abs(across(at - centre, cut - centre)) < 1e-6
        assert abs((cut * at.conjugate()).real) < 1e-6 * abs(at)
    named_k = [(str(label.text), label.at) for label in all_of(step, Label)]
    assert named_k == [(str(j), k[station_of(name, str(j))]) for j in range(len(named_k))]
    for j, said in enumerate(captions(step)):
        at = station_of(name, str(j))
        if abs(k[at]) < 1e-6:
            assert said.startswith(f"Station {j}: the rod lies on the ray, so K coincides with O")
            continue
        assert said.startswith(f"Station {j}: OK = ")
        tilt = math.degrees(abs(cmath.phase((b[at] - k[at]) / b[at])))
        found = re.findall(r"OK = (\S+) mm × (\S+) = (\S+) mm/rad, and (\S+)°\.", said)
        exact = (abs(k[at]), mu, abs(k[at]) * mu, tilt)
        assert [float(x) for x in found[0]] == pytest.approx(exact, abs=0.0051)
    assert worked_row(step) == captions(step)[station_of(name, re.findall(r"Station (\S+):", str(step.caption))[0]) - 2]


def worked_row(step: Step) -> str:
    """The row that the caption of a run of stations works out, which ends it."""
    return str(step.caption)[str(step.caption).index("Station ") :]


@PERFECT
def test_the_accelerations_of_all_stations_lie_on_their_rays(name):
    """In the plane of the drawing itself: CN is CK²/CB, N lies on the rod, M square to it on the ray."""
    (*_, step, _), mu = steps(name, "arc_roller"), per_mm(name)
    stations, velocities = steps(name, "arc_roller")[2], steps(name, "arc_roller")[5]
    b, k = the(all_of(stations, Dots)[0].points), plotted(velocities)
    times = mu * scale_of_view(step)
    copied, m, n = ([complex(p) / times for p in dots.points] for dots in all_of(step, Dots))
    assert np.allclose(copied, b, atol=1e-6)
    centres = [named(steps(name, "three_arcs")[j], text).at for j, text in ((2, "C₂"), (3, "C₃"), (1, "C₁"))]
    for j, said in enumerate(captions(step)):
        arc = int(chain(name).stations.arc[j])
        c = centres[arc]
        assert abs(abs(n[j] - c) * abs(b[j] - c) - abs(k[j] - c) ** 2) < 1e-5
        assert abs(across(b[j] - c, n[j] - c)) < 1e-6
        assert abs(((m[j] - n[j]) * (b[j] - c).conjugate()).real) < 1e-4
        assert abs(across(b[j], m[j])) < 1e-6
        title, centre, _, ck, cn, om, way, factor, a = re.findall(
            r"Station (\S+(?: on \w+)?): (C[₁₂₃])E = (C[₁₂₃])K = (\S+) mm, (?:C[₁₂₃]N = (\S+) mm|N in C[₁₂₃]), "
            r"OM = (\S+) mm (.*), × (\S+): a = (\S+) mm/rad²",
            said,
        )[0]
        assert (station_of(name, title), centre) == (j, CENTRES[arc])
        sense = -1 if (m[j] / b[j]).real > 0 else 1
        assert way == ("beyond O" if sense > 0 else "towards B")
        exact = (abs(k[j] - c), abs(n[j] - c), abs(m[j]), mu, sense * abs(m[j]) * mu)
        assert [float(x or 0) for x in (ck, cn, om, factor, a)] == pytest.approx(exact, abs=0.0051)
    assert worked_row(step) in captions(step)
    (rays, accelerations, normals) = all_of(step, Segments)
    for mark, starts, ends in ((rays, [0] * len(b), b), (accelerations, [0] * len(b), m), (normals, n, m)):
        assert np.allclose(mark.starts / times, starts, atol=1e-6)
        assert np.allclose(mark.ends / times, ends, atol=1e-6)
    places = np.array([0, *b, *m, *n]) * times
    assert fits(max(np.ptp(places.real), np.ptp(places.imag)), 1 / scale_of_view(step), 190.0)


def scale_of_view(step: Step) -> float:
    """mm of the view in a mm of the cam."""
    found = re.search(r"at ([\d.]+):([\d.]+),", str(step.caption))
    assert found is not None
    return float(found[1]) / float(found[2])


# --- the diagrams ----------------------------------------------------------------------------------------------------

DIAGRAMS = over_all(("k", "key"), list(enumerate(("a", "v", "s", "alpha"))))


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
    limits, ordinates = (mark for mark in all_of(step, Segments) if mark.role == Role.CONSTRUCTION)
    assert np.array_equal(ordinates.ends, dots)
    assert np.allclose(ordinates.starts, dots.real, atol=NEAR)
    heights = all_of(step, Line)[-1].points.imag
    assert np.allclose(limits.starts, np.array([*edges[1:], *down, 360]) + 1j * heights.min(), atol=1e-6)
    assert np.allclose(limits.ends, np.array([*edges[1:], *down, 360]) + 1j * heights.max(), atol=1e-6)


@PERFECT
def test_the_accelerations_at_the_joints_are_those_on_either_side(name):
    data, changes = BOARDS[name]
    motion = three_arc_cam(**data)[0].motion(changes.get("roller", 10.0), dwell_of(name))
    ends = {"A": (0, 0), "G_before": (0, 1), "G_after": (1, 0), "F_before": (1, 1), "F_after": (2, 0), "D": (2, 1)}
    rolled = chain(name)["arc_roller"]
    for end, (arc, u) in ends.items():
        exact = motion.at(np.array([arc]), np.array([float(u)]))[1][2]
        assert float(rolled.value(f"a_{end}")) == pytest.approx(float(exact[0]))
    read = [set(step.reads) for step in steps(name, "arc_roller")]
    assert read[-3:-1] == [{"v", "alpha"}, {"a", *(f"a_{end}" for end in ends)}]
    assert set[str]().union(*read) | {"phi", "edges"} == set(rolled.readings)
    radii = {"prime_radius": motion.prime_radius, "lift": motion.at(np.array([2]), np.array([1.0]))[1][0][0]}
    radii |= {"roller_radius": radius_of_roller(name) * per_mm(name), "rise": motion.edges[3], "phi_G": motion.edges[1]}
    for reading, exact in radii.items():
        assert float(rolled.value(reading)) == pytest.approx(float(exact)), reading
    path = [arc.radius for arc in all_of(steps(name, "arc_roller")[0], Arc)]
    least = min(path[-4], path[-1])  # about C1, and about O
    assert float(rolled.first("rho")) == pytest.approx(least)


@EVERY
@DIAGRAMS
def test_the_axes_reach_beyond_the_curve(name, k, key):
    step = steps(name, "arc_diagrams")[k]
    heights, (phi, up) = all_of(step, Line)[-1].points.imag, all_of(step, Arrow)
    assert (phi.start, phi.end) == (0, pytest.approx(368.0, abs=tolerance(name)))
    assert (up.start, up.end) == (heights.min() * 1j, pytest.approx((heights.max() + 8.0) * 1j))
    assert phi in step.given
    assert up in step.given


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
        ((paper, lift),) = re.findall(r"The lift measures (\S+) mm, which is (\S+) mm", str(step.caption))
        assert float(paper) == pytest.approx(dots.points[-1].imag, abs=0.006)
        assert float(lift) == pytest.approx(dots.points[-1].imag * scale, abs=0.001)
        return
    ((top,),) = (the(mark.points) for mark in tops)
    assert tops[0].role == Role.LIMIT
    reached = max(dots.points, key=lambda dot: abs(dot.imag))
    assert abs(top.imag) > abs(reached.imag) - tolerance(name)
    assert min(abs(point - top) for point in all_of(step, Line)[-1].points) < 2.5
    (label,) = (mark for mark in all_of(step, Label) if mark.at == top and "." in str(mark.text))
    assert str(label.text).endswith("°") == (key == "alpha")
    assert float(str(label.text).rstrip("°")) == pytest.approx(top.imag * scale, abs=0.006)
    assert label.towards == (1j if top.imag > 0 else -1j)
    (value,) = re.findall(r"maximum(?: magnitude)? is (\d+\.\d+)", captions(step)[-1])
    assert float(value) == pytest.approx(abs(top.imag) * scale, abs=0.001)
    side = "above" if top.imag > 0 else "below"
    assert f"touches the curve: {abs(top.imag):.2f} mm {side} the axis." in captions(step)[-1]


@EVERY
def test_the_dimensions_of_the_phases_measure_what_they_say(name):
    step = steps(name, "arc_diagrams")[3]
    dimensions, lowest = all_of(step, Dimension), all_of(step, Line)[-1].points.imag.min()
    phases = ["rise", "dwell", "return", "dwell"] if dwell_of(name) else ["rise", "return", "dwell"]
    assert [str(mark.text).rpartition(" ")[0] for mark in dimensions] == phases
    for mark in dimensions:
        assert float(str(mark.text).split()[-1].rstrip("°")) == pytest.approx(
            mark.end.real - mark.start.real, abs=0.021 if mark is dimensions[-1] else 0.006
        )
        assert mark.start.imag == mark.end.imag == pytest.approx(lowest - 26.0)
    # The last one takes up what rounding leaves.
    assert sum(float(str(mark.text).split()[-1].rstrip("°")) for mark in dimensions) == pytest.approx(360, abs=1e-9)
    edges = [0.0, *(mark.end.real for mark in dimensions)]
    assert [mark.start.real for mark in dimensions] == pytest.approx(edges[:-1], abs=NEAR)
    assert edges[-1] == pytest.approx(360.0, abs=tolerance(name))


@PERFECT
@DIAGRAMS
def test_every_ordinate_is_told_with_what_it_is_carried_from_and_its_place(name, k, key):
    """From the drawing of the roller: OM, OK or the way out of the prime circle, or the angle between rod and ray."""
    step, (_, _, stations, *_, velocities, _, _) = steps(name, "arc_diagrams")[k], steps(name, "arc_roller")
    mu, (prime,) = laid_off_at(step), all_of(steps(name, "arc_roller")[0], Circle)
    b, cut, dots = the(all_of(stations, Dots)[0].points), plotted(velocities), the(all_of(step, Dots)[0].points)
    source = {
        "a": np.abs(chain(name)["arc_roller"].first("M")),
        "v": np.abs(cut),
        "s": np.abs(b) - prime.radius,
        "alpha": [math.degrees(abs(cmath.phase((p - q) / p))) for p, q in zip(b, cut, strict=True)],
    }[key]
    factor = 1.0 if key == "alpha" else per_mm(name) / mu
    told_at = captions(step)[1 : len(dots) + 1]
    for said, dot, length in zip(told_at, dots, source, strict=True):
        title, rest = re.findall(r"Station (\S+(?: on \w\w)?): (.*)", said)[0]
        assert dots[station_of(name, title)] == dot
        assert rest.endswith(f" at {round(float(dot.real), 2):g} mm.")
        if abs(dot.imag) < 1e-6:
            assert rest.startswith("0 at")
            continue
        if key == "alpha":
            found = *re.findall(r"(\d+\.\d+)° are (\d+\.\d+) mm", rest)[0], 1.0
        else:
            found = re.findall(r"(\d+\.\d+) mm(?: × (\S+) = (\S+) mm)?", rest)[0]
            found = found[0], found[2] or found[0], found[1] or 1.0
        exact = (length, length * factor, factor)
        assert [float(x) for x in found] == pytest.approx(exact, abs=0.0051)
        assert length * factor == pytest.approx(abs(dot.imag), abs=1e-6)
        side = re.findall(r"mm (up|down) at", rest)
        assert side == (["up" if dot.imag > 0 else "down"] if key == "a" else [])
    assert ("up from the axis" in str(step.caption)) == (dots[1].imag > 0 or key == "a")
    parts = len(dots) // 3 - 1
    shown = 2 * (parts + 1) + round(parts / 2)
    worked = f"{chain(name).stations.names[shown]}, {source[shown]:.2f}"
    assert f"for station {worked}" in str(step.caption)
    told = captions(step)[1 + shown].split(": ")[1]
    assert f"for station {chain(name).stations.names[shown]}, {told}" in str(step.caption)


@PERFECT
@DIAGRAMS
def test_the_parts_of_a_diagram_draw_its_curve_in_pieces(name, k, key):
    step = steps(name, "arc_diagrams")[k]
    curve = all_of(step, Line)[-1]
    limits, _ = (mark for mark in all_of(step, Segments) if mark.role == Role.CONSTRUCTION)
    drawn = [part for part in step.places if any(each.act is curve.of for each in part.draws)]
    places = [at for part in drawn for each in part.draws for at in each.index.tolist()]
    assert places == list(range(len(curve.points)))
    assert len(drawn) == (4 if dwell_of(name) else 3)
    rise = drawn[0].draws[0].shown
    assert rise[-1].real == pytest.approx(limits.starts[2].real)
    middle = [found for said in captions(step) for found in re.findall(r"Return: .*? (\d+\.\d+) mm", said)]
    between = (limits.starts[2].real + limits.starts[3].real) / 2
    assert [float(found) for found in middle] == [pytest.approx(between, abs=0.006)]
    ends = re.findall(r"(\d+\.\d+)(?=,| mm, and)", captions(step)[0])
    assert [float(end) for end in ends] == pytest.approx(np.unique(limits.starts.real.round(6)).tolist(), abs=0.006)


@PERFECT
@DIAGRAMS
def test_the_stations_of_a_diagram_are_named(name, k, key):
    step = steps(name, "arc_diagrams")[k]
    dots, names = the(all_of(step, Dots)[0].points), chain(name).stations.names
    labels = [mark for mark in all_of(step, Label) if re.fullmatch(r"\d+", str(mark.text)) and mark.of]
    for label in labels:
        assert any(label.at == dot and str(label.text) == each for dot, each in zip(dots, names, strict=True))
        assert label.towards == (1j if label.at.imag >= 0 else -1j)
    n = len(dots) // 3
    assert {str(label.text) for label in labels} >= {"0", str(n - 1), str(2 * n - 2), str(3 * n - 3)}
    assert len({label.at for label in labels}) == len(labels)
