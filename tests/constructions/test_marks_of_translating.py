"""What the drawings of a translating follower show: the region, the velocity plan, the angles, the scheme."""

from __future__ import annotations

import cmath
import math
import re
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from boards import board_of, coursework, limits, motion_of

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction, Step
from graphcam.drafting.marks import AngleMark, Arc, Arrow, Circle, Dimension, Dots, Label, Line, Region, Role, Segments
from graphcam.drafting.pencil import Pencil

BOARDS = {
    "built-in": coursework(),
    "ccw, to the right": coursework("3-4-5", rotation="ccw", offset=10.0),
    "ccw, on the wrong side": coursework("cosine", rotation="ccw", offset=-12.0, limits=limits(25, 45)),
    "central": coursework("3-4-5", offset=0.0, limits=limits(30, rest=False)),
    "form closure": coursework("3-4-5", offset=None, limits=limits(30, 40)),
    "free, ccw": coursework("cosine", rotation="ccw", offset=None),
    "foot": coursework("3-4-5", offset=None, limits=limits(40, rest=False)),
    "above a rest": board_of(motion_of((10, 80, "3-4-5"), (0, 30), (20, 80, "cosine"), (-30, 90, "3-4-5")), 8.0),
}
SIGMA, TURN = 0.2, 0.009
HANDS = {"perfect": None, "hand": Pencil(line=SIGMA, dividers=SIGMA, protractor=TURN, seed=5)}
EXACT, MANY = 1e-9, 6
"""mm, and so many standard deviations that no error of a fixed seed's hand is greater."""
CASES = [(name, hand) for name in BOARDS for hand in HANDS]
EVERY = pytest.mark.parametrize(("name", "hand"), CASES)


@cache
def chain(name: str, hand: str) -> Chain:
    return Chain(BOARDS[name], HANDS[hand] or Pencil())


@cache
def steps(name: str, hand: str, construction: str) -> list[Step]:
    return chain(name, hand)[construction].steps()


def of(step: Step, kind: type, role: Role | None = None) -> list:
    """The marks of a kind, and of a role, in their order."""
    return [mark for mark in step.marks if isinstance(mark, kind) and (role is None or mark.role is role)]


def one(step: Step, kind: type, role: Role | None = None):
    found = of(step, kind, role)
    assert len(found) == 1
    return found[0]


def says(step: Step, pattern: str) -> list[float]:
    """The numbers that a caption says where the pattern has groups."""
    found = re.search(pattern, str(step.caption))
    assert found, (pattern, str(step.caption))
    return [float(group) for group in found.groups()]


def side(name: str) -> int:
    """1 for a cam that turns counter-clockwise."""
    return 1 if BOARDS[name].rotation == "ccw" else -1


def slack(hand: str, errors: float) -> float:
    """How far [mm] a place may lie from where it should, by so many standard deviations of a line."""
    return EXACT if hand == "perfect" else MANY * SIGMA * errors


def square(a: complex, b: complex) -> float:
    """How far two directions are from a right angle, as a cosine."""
    return abs((a * b.conjugate()).real) / abs(a) / abs(b)


def names_of(name: str) -> list[str]:
    spans = BOARDS[name].stations.phases
    return [f"{k}" + "′" * n for n, span in enumerate(spans) for k in range(span.stop - span.start)]


def rising(name: str) -> np.ndarray:
    board = BOARDS[name]
    return np.array([board.motion.phases[k].direction for k in board.stations.phase]) > 0


# --- the least radius ------------------------------------------------------------------------------------------------


def diagram(name: str, hand: str) -> list[Step]:
    return steps(name, hand, "minimum_radius")


def s_and_v(name: str, hand: str) -> tuple[np.ndarray, np.ndarray, float]:
    """s and v on paper, both in the scale of s, and that scale."""
    read = chain(name, hand)["integration"].readings
    mu = float(read["s"].scale)
    return read["s"].paper, read["v"].value / mu, mu


@EVERY
def test_velocities_stand_square_to_the_motion_at_their_displacements_turned_with_the_cam(name, hand):
    step, (s, v, _) = diagram(name, hand)[0], s_and_v(name, hand)
    segments, dots, axis = one(step, Segments), one(step, Dots).points, one(step, Line, Role.AXIS).points
    assert np.all(segments.starts.real == 0)
    np.testing.assert_allclose(segments.starts.imag, s, atol=slack(hand, 1))
    np.testing.assert_array_equal(segments.ends.imag, segments.starts.imag)
    np.testing.assert_allclose(segments.ends, segments.starts + 1j * side(name) * 1j * v, atol=slack(hand, 1.5))
    np.testing.assert_array_equal(dots, segments.ends)
    assert np.all(axis.real == 0)
    assert axis[1].imag == pytest.approx(dots.imag.max() + 8)
    for label in of(step, Label):
        k = names_of(name).index(label.text)
        assert label.at == dots[k]
        assert label.towards == np.sign(dots[k].real) != 0
    # No end of a long segment but for want of room is without its name.
    assert len(of(step, Label)) >= len(BOARDS[name].stations.phases) * 5
    assert says(step, r"measures ([\d.]+) mm") == [pytest.approx(np.abs(dots.real).max(), abs=0.051)]
    assert ("counter-clockwise" in str(step.caption)) == (side(name) > 0)


@EVERY
def test_the_curves_run_through_the_ends_of_the_velocities_from_jump_to_jump(name, hand):
    first, second = diagram(name, hand)[:2]
    ends, curves = one(first, Dots).points, of(second, Line, Role.RESULT)
    assert len(curves) == len(BOARDS[name].stations.pieces)
    for piece, curve in zip(BOARDS[name].stations.pieces, curves, strict=True):
        through = curve.points[::8] if curve.points.size > ends[piece].size else curve.points
        np.testing.assert_allclose(through, ends[piece], atol=EXACT)


class Bound:
    """A drawn limit: its line, its angle with the motion, and where it permits."""

    def __init__(self, title: str, line: Line, upright: Segments, angle: AngleMark, limit: float, lean: int):
        self.title, self.upright, self.angle, self.limit, self.lean = title, upright, angle, limit, lean
        self.above, self.below = map(complex, line.points)
        way = self.below - self.above
        self.inward = way / abs(way) * (-1j if lean > 0 else 1j)
        """Below the line, which leans with its foot to the right (1) or to the left."""

    def inside(self, places):
        return ((places - self.above) * self.inward.conjugate()).real


@cache
def bounds(name: str, hand: str) -> list[Bound]:
    """The lines that a task asks for: which lean under which angle to which side."""
    permitted, step = BOARDS[name].limits, diagram(name, hand)[2]
    asked = [("rise", permitted.rise, side(name))]
    asked += [] if permitted.return_ is None else [("return", permitted.return_, -side(name))]
    asked += [("rest", permitted.rise, -side(name))] if permitted.rest else []
    marks = zip(of(step, Line, Role.LIMIT), of(step, Segments), of(step, AngleMark), strict=True)
    return [Bound(title, *found, limit, lean) for (title, limit, lean), found in zip(asked, marks, strict=True)]


@EVERY
def test_the_limits_lean_at_the_angles_that_they_bear(name, hand):
    bottom = one(diagram(name, hand)[0], Line, Role.AXIS).points[0].imag
    for bound in bounds(name, hand):
        way = bound.below - bound.above
        assert way.imag < 0
        turned = cmath.phase(way / -1j)
        assert turned == pytest.approx(bound.lean * bound.limit, abs=EXACT if hand == "perfect" else MANY * TURN)
        start, angle = complex(bound.upright.starts[0]), bound.angle
        assert bound.below.imag == pytest.approx(bottom)
        assert bound.inside(start) == pytest.approx(0, abs=EXACT)
        assert complex(bound.upright.ends[0]) == pytest.approx(start - 26.4j)
        assert angle.centre == start
        assert angle.radius == 22
        assert (angle.start, angle.end) == pytest.approx(sorted((-math.pi / 2, cmath.phase(way))))
        assert str(angle.text) == f"{math.degrees(bound.limit):g}°"
        # It is shown a third of the way down from where the line touches.
        touch = bound.above if bound.title == "rest" else bound.above + way * 10 / -way.imag
        assert start == pytest.approx(touch + (bound.below - touch) / 3)


@EVERY
def test_the_limits_touch_their_curves_and_cross_them_nowhere(name, hand):
    curves, up = of(diagram(name, hand)[1], Line), rising(name)
    for bound in bounds(name, hand):
        if bound.title == "rest":
            assert abs(bound.above) <= slack(hand, 1)
            continue
        pieces = zip(BOARDS[name].stations.pieces, curves, strict=True)
        whole = np.concatenate([c.points for piece, c in pieces if up[piece.start] == (bound.title == "rise")])
        inside = bound.inside(whole)
        near = int(np.argmax(inside))
        # The curve is drawn in chords; it lies beyond the line, and reaches it.
        assert abs(inside[near]) < 0.03 + (hand != "perfect") * MANY * SIGMA
        way = bound.below - bound.above
        assert abs(whole[near] - (bound.above + way * 10 / -way.imag)) < 4


@EVERY
def test_the_caption_says_which_limits_and_where_the_rises_meets_zero_lift(name, hand):
    step, rise = diagram(name, hand)[2], bounds(name, hand)[0]
    way = rise.below - rise.above
    at_zero = rise.above - way * rise.above.imag / way.imag
    assert says(step, r"lift ([\d.]+) mm") == [pytest.approx(abs(at_zero.real), abs=0.051)]
    said = [f"{math.degrees(b.limit):g}° {b.title}" for b in bounds(name, hand) if b.title != "rest"]
    assert f"({', '.join(said)})" in str(step.caption)
    assert ("spring" in str(step.caption)) == (BOARDS[name].limits.return_ is None)
    assert ("rest line" in str(step.caption)) == BOARDS[name].limits.rest


def permitted(name: str, hand: str, places, tolerance: float = 1e-7):
    return np.all([b.inside(np.asarray(places)) >= -tolerance for b in bounds(name, hand)], axis=0)


@EVERY
def test_the_region_holds_just_what_no_limit_cuts_off(name, hand):
    corners = one(diagram(name, hand)[3], Region).boundary
    ends, bottom = one(diagram(name, hand)[0], Dots).points, one(diagram(name, hand)[0], Line, Role.AXIS).points[0].imag
    x, y = np.meshgrid(np.linspace(ends.real.min(), ends.real.max(), 37), np.linspace(bottom, 0, 41))
    grid = (x + 1j * y).ravel()
    edges = np.roll(corners, -1) - corners
    turns = ((grid[:, None] - corners) * edges.conjugate()).imag
    within = np.all(turns >= -1e-6, axis=1) | np.all(turns <= 1e-6, axis=1)
    np.testing.assert_array_equal(within, permitted(name, hand, grid, 1e-6 / np.abs(edges).max()))
    assert within.any()


def crosses(name: str, hand: str) -> dict[str, complex]:
    """The alternatives by their names, where their crosses stand."""
    step = diagram(name, hand)[3]
    found = {}
    for strokes, label in zip(of(step, Segments), of(step, Label), strict=True):
        np.testing.assert_allclose(strokes.ends - strokes.starts, [3, 3j], atol=EXACT)
        np.testing.assert_allclose((strokes.ends + strokes.starts) / 2, [label.at, label.at], atol=EXACT)
        assert label.towards == 1 - 1j
        found[str(label.text)] = label.at
    return found


@EVERY
def test_the_alternatives_are_the_foot_the_apex_and_the_central_followers_centre(name, hand):
    found, lines = crosses(name, hand), {b.title: b for b in bounds(name, hand)}
    rise, back = lines["rise"], lines.get("return")
    assert list(found) == (["foot", "apex", "central"] if back else ["foot", "central"])
    assert f"alternatives: {', '.join(found)}." in str(diagram(name, hand)[3].caption)
    assert rise.inside(found["foot"]) == pytest.approx(0, abs=1e-7)
    way = (rise.below - rise.above) / abs(rise.below - rise.above)
    assert abs((found["foot"] * way.conjugate()).real) <= slack(hand, 2)
    if back:
        assert (rise.inside(found["apex"]), back.inside(found["apex"])) == pytest.approx((0, 0), abs=1e-7)
    assert found["central"].real == 0
    assert permitted(name, hand, found["central"])
    assert found["central"] == 0 or not permitted(name, hand, found["central"] + 0.01j)


@EVERY
def test_the_cam_centre_is_the_nearest_permitted_place_or_the_highest_at_the_offset(name, hand):
    step, offset, mu = diagram(name, hand)[4], BOARDS[name].follower.place, s_and_v(name, hand)[2]
    a = complex(one(step, Dots, Role.RESULT).points[0])
    np.testing.assert_allclose(one(step, Line, Role.LIMIT).points, [0, a], atol=EXACT)
    assert permitted(name, hand, a)
    if offset is None:
        lines = bounds(name, hand)
        # Over the border of the region: a fine walk along every line.
        walks = np.concatenate([b.above + (b.below - b.above) * np.linspace(-1, 2, 20001) for b in lines])
        nearest = np.abs(walks[permitted(name, hand, walks)]).min()
        assert abs(a) == pytest.approx(nearest, abs=0.01)
    else:
        assert a.real == pytest.approx(-offset / mu, abs=slack(hand, 1.5))
        assert not permitted(name, hand, a + 0.01j)
    label = one(step, Label)
    assert (label.at, label.towards, label.text) == (a, np.sign(a.real) - 1j, "A")
    size, *offsets = of(step, Dimension)
    assert (size.start, size.end) == (0, a)
    assert str(size.text) == f"r₀ = {abs(a) * mu:.2f}"
    assert size.aside == 0
    assert bool(offsets) == (abs(a.real) > EXACT)
    for each in offsets:
        assert (each.start, each.end, each.aside) == (1j * a.imag, a, -8)
        assert str(each.text) == ("e" if offset is None else f"e = {offset:g}")
        np.testing.assert_allclose(one(step, Line, Role.AXIS).points, [a - 6j, a.real + 6j])


@EVERY
def test_the_caption_of_the_cam_centre_says_what_is_measured_and_what_binds(name, hand):
    step, offset, mu = diagram(name, hand)[4], BOARDS[name].follower.place, s_and_v(name, hand)[2]
    a = complex(one(step, Dots, Role.RESULT).points[0])
    numbers = says(step, r"measures ([\d.]+) mm, so r₀ = ([\d.]+) mm with e = (-?[\d.]+) mm and s₀ = ([\d.]+) mm")
    assert numbers == pytest.approx([abs(a), abs(a) * mu, -a.real * mu, -a.imag * mu], abs=0.0051)
    assert numbers[1:] == pytest.approx([abs(a) * mu, -a.real * mu, -a.imag * mu], abs=0.00051)
    on = [b.title for b in bounds(name, hand) if abs(b.inside(a)) < 1e-6]
    assert (f"limit of: {', '.join(on)}." if on else "No line binds it.") in str(step.caption)
    assert (f"line at e = {offset:g} mm" if offset is not None else "nearest to the start") in str(step.caption)


def test_the_boards_bind_at_the_foot_at_a_corner_and_at_an_offset():
    bound_by = {
        name: [b.title for b in bounds(name, "perfect") if abs(b.inside(centre(name))) < 1e-6] for name in BOARDS
    }
    assert bound_by["foot"] == ["rise"]
    assert len(bound_by["form closure"]) == 2
    assert {len(titles) for titles in bound_by.values()} == {1, 2}


def centre(name: str) -> complex:
    return complex(one(diagram(name, "perfect")[4], Dots, Role.RESULT).points[0])


# --- the pressure angle ----------------------------------------------------------------------------------------------


def measured(name: str, hand: str) -> Construction:
    return chain(name, hand)["pressure_angle"]


def plan_scale(step: Step) -> float:
    """Machine millimetres a millimetre of paper, from the ratio in the title of the view."""
    left, right = re.search(r"([\d.]+):([\d.]+)$", str(step.view.title)).groups()
    return float(right) / float(left)


@cache
def corners(name: str, hand: str) -> dict[str, complex]:
    """A, B, C and D of the mechanism, and the heads of v1 and v2 from the pole."""
    plan, triangle, angle, _ = steps(name, hand, "pressure_angle")
    a, b, c = map(complex, one(triangle, Dots).points)
    v1, v2, v21 = of(plan, Arrow)
    assert v1.start == v2.start
    assert (v21.start, v21.end) == (v1.end, v2.end)
    found = {"p": v1.start, "v1": v1.end - v1.start, "v2": v2.end - v2.start, "v21": v21.end - v21.start}
    return found | {"A": a, "B": b, "C": c, "D": complex(one(angle, Dots).points[0])}


@EVERY
def test_the_plan_is_the_triangle_of_the_mechanism_turned_by_a_right_angle(name, hand):
    at, sigma = corners(name, hand), side(name)
    assert at["A"] == 0
    assert at["v1"] == pytest.approx(sigma * 1j * at["B"], abs=EXACT)
    assert at["v2"] == pytest.approx(1j * abs(at["C"]), abs=EXACT)
    assert at["v1"] + at["v21"] == pytest.approx(at["v2"], abs=EXACT)
    assert square(at["v21"], at["B"] - at["C"]) < EXACT
    assert at["C"] == pytest.approx(sigma * abs(at["C"]), abs=EXACT)
    # A C is laid off from B, as v2 turned with the cam, to D.
    assert at["D"] - at["B"] == pytest.approx(sigma * 1j * at["v2"], abs=EXACT)
    assert square(at["v21"], at["D"]) < EXACT


@EVERY
def test_the_mechanism_has_the_sizes_that_are_drawn_and_adopted(name, hand):
    at, k = corners(name, hand), shown(name, hand)
    s, v, mu = s_and_v(name, hand)
    step = steps(name, hand, "pressure_angle")[1]
    to_paper = mu / plan_scale(step)
    start, end = foot_and_end(name, hand)
    assert at["B"] == pytest.approx((1j * end.imag - start) * to_paper, abs=EXACT)
    assert at["D"] == pytest.approx((end - start) * to_paper, abs=EXACT)
    assert end == pytest.approx(1j * s[k] - side(name) * v[k], abs=slack(hand, 2))
    place, r0 = chain(name, hand).place, chain(name, hand).prime_radius
    assert start.real == pytest.approx(-place / mu, abs=slack(hand, 1.5))
    assert abs(start) == pytest.approx(r0 / mu, abs=slack(hand, 2))
    assert start.imag < 0
    assert at["B"].imag <= 70


def foot_and_end(name: str, hand: str) -> tuple[complex, complex]:
    """The cam centre and the end of the ray in the combined diagram."""
    last = steps(name, hand, "pressure_angle")[3]
    ray = one(last, Segments)
    assert complex(one(last, Dots, Role.RESULT).points[0]) == complex(ray.starts[0])
    return complex(ray.starts[0]), complex(ray.ends[0])


def shown(name: str, hand: str) -> int:
    """The station of the greatest angle among those where the follower rises at some speed."""
    v = chain(name, hand)["integration"].readings["v"].value
    alpha = np.abs(measured(name, hand).readings["alpha"].paper)
    moving = [k for k in range(v.size) if rising(name)[k] and v[k] >= v.max() / 4]
    return max(moving, key=lambda k: alpha[k])


@EVERY
def test_names_stand_at_the_corners_of_plan_and_mechanism(name, hand):
    plan, triangle, angle, _ = steps(name, hand, "pressure_angle")
    at, sigma = corners(name, hand), side(name)
    labels = {label.text: label for label in (*of(plan, Label), *of(triangle, Label), *of(angle, Label))}
    assert set(labels) == {"v₁", "v₂", "v₂₁", "p", "A", "B", "C", "D"}
    middle = {"v₁": at["v1"] / 2, "v₂": at["v2"] / 2, "v₂₁": (at["v1"] + at["v2"]) / 2, "p": 0}
    for text, place in middle.items():
        assert labels[text].at == pytest.approx(at["p"] + place)
    for text in "ABCD":
        assert labels[text].at == at[text]
    # Beside the arrows outside of the plan, that of v1 to its right; at the corners away from the triangle.
    inner = (at["v1"] + at["v2"]) / 3
    for text in ("v₂", "v₂₁"):
        towards = complex(labels[text].towards)
        assert ((inner - middle[text]) * towards.conjugate()).real < 0, text
    assert (at["v1"].conjugate() * labels["v₁"].towards).imag < 0
    assert labels["v₁"].towards.real == 0
    assert labels["p"].towards == -1 - 1j
    ways = {"A": -1j - sigma, "B": 1 + 1j, "C": -1j + sigma, "D": 1j - sigma}
    assert {text: labels[text].towards for text in ways} == ways
    # The plan stands clear of the mechanism, to its right.
    left = min((at["p"] + way).real for way in (0, at["v1"], at["v2"]))
    assert left == pytest.approx(max(0.0, at["B"].real, at["C"].real, at["D"].real) + 22)
    assert at["p"].imag == 8


@EVERY
def test_the_lines_of_the_mechanism_join_its_corners(name, hand):
    _, triangle, angle, _ = steps(name, hand, "pressure_angle")
    at = corners(name, hand)
    a, b, c, d = (at[corner] for corner in "ABCD")
    guide = one(triangle, Line, Role.AXIS).points
    ab, ac = (line.points for line in of(triangle, Line, Role.CURVE))
    normal = one(triangle, Line, Role.CONSTRUCTION).points
    np.testing.assert_allclose(guide, [b.real - 6j, b + 12j], atol=EXACT)
    np.testing.assert_allclose([*ab, *ac], [a, b, a, c], atol=EXACT)
    np.testing.assert_allclose(normal, [b + 0.12 * (b - c), c], atol=EXACT)
    bd, da = one(angle, Line, Role.CURVE).points, one(angle, Line, Role.LIMIT).points
    np.testing.assert_allclose([*bd, *da], [b, d, d, a], atol=EXACT)
    np.testing.assert_allclose(one(angle, Line, Role.CONSTRUCTION).points, [d, d - 0.62j * b.imag], atol=EXACT)


@EVERY
def test_the_drawn_pressure_angle_is_the_one_that_is_printed(name, hand):
    step, k, at = steps(name, hand, "pressure_angle")[2], shown(name, hand), corners(name, hand)
    mark, d = one(step, AngleMark), at["D"]
    # The angle at D from the motion downwards to A; it is positive where the cam's turning closes it.
    drawn = side(name) * cmath.phase(d / 1j)
    read = measured(name, hand).readings
    alpha, gamma = float(read["alpha"].paper[k]), float(read["transmission"].paper[k])
    assert alpha == pytest.approx(drawn, abs=EXACT if hand == "perfect" else MANY * TURN)
    assert gamma == pytest.approx(math.pi / 2 - abs(alpha))
    assert (mark.centre, mark.radius) == (d, pytest.approx(0.55 * at["B"].imag))
    assert (mark.start, mark.end) == pytest.approx(sorted((-math.pi / 2, -math.pi / 2 + cmath.phase(d / 1j))))
    assert str(mark.text) == f"α = {math.degrees(alpha):.1f}°"
    station, *numbers = re.search(r"station (\S+): (-?[\d.]+)°.* ([\d.]+)°", str(step.caption)).groups()
    assert station == names_of(name)[k]
    assert list(map(float, numbers)) == pytest.approx([math.degrees(alpha), math.degrees(gamma)], abs=0.0051)
    assert str(steps(name, hand, "pressure_angle")[0].title).endswith(f"station {station}")


@EVERY
def test_the_captions_of_the_plan_say_the_lengths_that_are_drawn(name, hand):
    plan, triangle, _, last = steps(name, hand, "pressure_angle")
    at, scale = corners(name, hand), plan_scale(plan)
    lengths = [abs(at[key]) for key in ("v1", "v2", "v21")]
    assert says(plan, r"AB, ([\d.]+) mm;.*guide, ([\d.]+) mm;.*with ([\d.]+) mm") == pytest.approx(lengths, abs=0.051)
    length, mu, value = says(triangle, r"dφ: ([\d.]+) mm · ([\d.]+) = ([\d.]+) mm/rad")
    assert (length, mu) == pytest.approx((abs(at["C"]), scale), abs=0.051)
    assert value == pytest.approx(abs(at["C"]) * scale, abs=0.0051)
    v = float(chain(name, hand)["integration"].readings["v"].value[shown(name, hand)])
    assert value == pytest.approx(v, abs=0.0051 + (hand != "perfect") * MANY * SIGMA * s_and_v(name, hand)[2])
    drawn = chain(name, hand)
    assert says(last, r"r₀ = ([\d.]+) mm and e = (-?[\d.]+) mm") == pytest.approx([drawn.prime_radius, drawn.place])


# --- the angle diagram -----------------------------------------------------------------------------------------------


@EVERY
def test_the_measured_angles_stand_over_their_cam_angles(name, hand):
    step, stations = steps(name, hand, "angle_diagram")[0], BOARDS[name].stations
    dots = one(step, Dots).points
    alpha = np.degrees(measured(name, hand).readings["alpha"].paper)
    np.testing.assert_allclose(dots.real, np.degrees(stations.phi), atol=slack(hand, 2))
    np.testing.assert_allclose(dots.imag, alpha, atol=slack(hand, 1))
    curves = of(step, Line, Role.RESULT)
    faired, rests = curves[: len(stations.pieces)], curves[len(stations.pieces) :]
    for piece, curve in zip(stations.pieces, faired, strict=True):
        through = curve.points[::8] if curve.points.size > dots[piece].size else curve.points
        np.testing.assert_allclose(through, dots[piece], atol=EXACT)
    # In the dwells the angle stays: level lines from the end of a phase to the start of the next.
    places = [1j * dots[-1].imag, *(dots[k] for p in stations.phases for k in (p.start, p.stop - 1)), 360]
    places[-1] += 1j * dots[-1].imag
    np.testing.assert_allclose([p for rest in rests for p in rest.points], places, atol=EXACT)
    assert all(abs(np.diff(rest.points.imag)[0]) < EXACT or hand != "perfect" for rest in rests)
    assert says(step, r"at ([\d.]+)° a millimetre") == [1]


@EVERY
def test_the_dimensions_of_the_phases_have_the_angles_that_they_bear(name, hand):
    step = steps(name, hand, "angle_diagram")[0]
    given, lowest = of(step, Dimension), min(0.0, one(step, Dots).points.imag.min())
    phases = [math.degrees(phase.angle) for phase in BOARDS[name].motion.phases]
    assert [float(re.search(r"= ([\d.]+)°", str(d.text)).group(1)) for d in given] == pytest.approx(phases)
    assert [(d.end - d.start).real for d in given] == pytest.approx(phases)
    assert given[0].start == pytest.approx(1j * (lowest - 24))
    assert all(a.end == b.start for a, b in pairwise(given))
    assert all(d.end.imag == d.start.imag for d in given)
    ticks = of(step, Segments, Role.SCALE)[-1]
    marked = [label for label in of(step, Label) if re.fullmatch(r"\d+°", str(label.text))]
    for label, start, end in zip(marked, ticks.starts, ticks.ends, strict=True):
        assert label.at == pytest.approx(float(str(label.text)[:-1])) == complex(start)
        assert complex(end) == complex(start) - 1.5j
        assert label.towards == -1j


@EVERY
def test_the_greatest_angles_are_read_where_the_curve_is_farthest_from_the_axis(name, hand):
    first, second = steps(name, hand, "angle_diagram")
    up, curves = rising(name), of(first, Line, Role.RESULT)
    tops = one(second, Dots, Role.LIMIT).points
    read = chain(name, hand)["angle_diagram"].readings
    for top, label, reading, rise in zip(
        tops, of(second, Label), ("max_rise", "max_return"), (True, False), strict=True
    ):
        pieces = zip(BOARDS[name].stations.pieces, curves, strict=False)
        whole = np.concatenate([c.points for piece, c in pieces if up[piece.start] == rise])
        far = whole[np.argmax(np.abs(whole.imag))]
        assert abs(top.imag) == pytest.approx(abs(far.imag), abs=0.05 + (hand != "perfect") * MANY * SIGMA)
        assert hand != "perfect" or abs(top - far) < 3
        assert top.imag == pytest.approx(float(read[reading].paper))
        assert label.at == top
        assert label.towards == np.sign(top.imag) * 1j
        assert str(label.text) == f"{top.imag:.1f}°"
    rise, rise_deg, back, back_deg = says(
        second, r"curve: (-?[\d.]+) mm on the rise, .* (-?[\d.]+)°, and (-?[\d.]+) mm on the return, (-?[\d.]+)°"
    )
    assert [rise, rise_deg, back, back_deg] == pytest.approx(np.repeat(tops.imag, 2), abs=0.0051)


# --- the scheme ------------------------------------------------------------------------------------------------------

SKETCHES = ("built-in", "ccw, to the right", "central", "above a rest")


@pytest.mark.parametrize("name", SKETCHES)
def test_in_the_scheme_the_roller_touches_the_cam_on_the_followers_line(name):
    step, drawn = steps(name, "perfect", "scheme")[0], chain(name, "perfect")
    scale = plan_scale(step)
    roller, shaft = of(step, Circle)
    outline = one(step, Line, Role.RESULT)
    b = roller.centre
    assert b.real == pytest.approx(drawn.place / scale, abs=EXACT)
    assert abs(b) == pytest.approx(drawn.prime_radius / scale, abs=EXACT)
    assert b.imag > 0
    assert roller.radius == pytest.approx(drawn.roller_radius / scale)
    assert np.abs(outline.points - b).min() == pytest.approx(roller.radius, abs=0.02)
    assert outline.closed
    assert 2 * np.abs(outline.points).max() <= 60
    assert says(step, r"at ([\d.]+):[\d.]+\.$") + says(step, r":([\d.]+)\.$") == pytest.approx(ratio(scale))
    assert (shaft.centre, shaft.radius) == (0, 1.2)


def ratio(scale: float) -> list[float]:
    return [1, scale] if scale >= 1 else [1 / scale, 1]


@pytest.mark.parametrize("name", SKETCHES)
def test_in_the_scheme_the_stem_slides_between_walls_and_the_cam_turns_as_said(name):
    step, drawn, sigma = steps(name, "perfect", "scheme")[0], chain(name, "perfect"), side(name)
    b = of(step, Circle)[0].centre
    stem, left, right, support = (line.points for line in of(step, Line, Role.CURVE))
    np.testing.assert_allclose(stem, [b, b + 30j])
    np.testing.assert_allclose(one(step, Line, Role.AXIS).points, [b.real - 6j, b + 35j])
    for wall, strokes, away in zip((left, right), of(step, Segments, Role.HATCH), (-1, 1), strict=False):
        np.testing.assert_allclose(wall, b + away * 2.2 + 1j * np.array([9, 17]))
        np.testing.assert_allclose(strokes.starts, wall[0] + 2j * np.arange(4), atol=EXACT)
        np.testing.assert_allclose(strokes.ends - strokes.starts, away * 0.9 * 2.2 + 1.6j, atol=EXACT)
    np.testing.assert_allclose(support, [-0.8 - 0.9j, -3 - 5j, 3 - 5j, 0.8 - 0.9j])
    ground = of(step, Segments, Role.HATCH)[2]
    np.testing.assert_allclose(ground.starts, np.linspace(-3, 3, 5) - 5j)
    np.testing.assert_allclose(ground.ends - ground.starts, -1.2 - 1.5j)
    lift = one(step, Arrow)
    assert (lift.start, lift.end) == (pytest.approx(b + 4 + 31j), pytest.approx(b + 4 + 39j))
    assert complex(one(step, Dots).points[0]) == b
    turn = one(step, Arc)
    radius = drawn.prime_radius / plan_scale(step) / 2
    assert (turn.centre, turn.radius, turn.arrow) == (0, pytest.approx(radius), "end" if sigma > 0 else "start")
    assert turn.end - turn.start == pytest.approx(0.9)
    # It begins on the left of the upright of a cam that turns clockwise, on the right of one that turns the other way.
    begin = turn.start if sigma > 0 else turn.end
    assert begin == pytest.approx(math.pi / 2 - sigma * 1.9)
    labels = {label.text: (label.at, label.towards) for label in of(step, Label)}
    assert labels == {"B": (b, 1 + 1j), "ω": (pytest.approx(radius * (1j - sigma)), -sigma), "A": (0, 1 - 1j)}
