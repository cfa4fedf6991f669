"""What the drawings of a translating follower show: the region, the velocity plan, the angles."""

from __future__ import annotations

import cmath
import math
import re
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from boards import board_of, coursework, limits, motion_of
from over_all import over_all

from graphcam.constructions.adoption import Adoption, adoption_step
from graphcam.constructions.chain import Chain
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.constructions.views import COMBINED
from graphcam.drafting.acts import Kind
from graphcam.drafting.ink import Construction, Part, Step
from graphcam.drafting.marks import AngleMark, Arc, Arrow, Dimension, Dots, Label, Line, Region, Role, Segments
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
EVERY = over_all(("name", "hand"), CASES)


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


def says(step: Step | Part, pattern: str) -> list[float]:
    """The numbers that a caption says where the pattern has groups."""
    found = re.search(pattern, str(step.caption))
    assert found, (pattern, str(step.caption))
    return [float(group) for group in found.groups()]


def beside(x: float) -> str:
    """How a caption says to which side something lies."""
    return "to the right" if x > 0 else "to the left"


def side(name: str) -> int:
    """1 for a cam that turns anticlockwise."""
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
    segments = one(step, Segments)
    # The part over B₀ is given, the part below it is as long as the region needs.
    axis = np.array([line.points for line in of(step, Line, Role.AXIS)])
    axis = np.array([axis[1, 0], axis[0, 1]])
    heights, dots = (each.points for each in of(step, Dots))
    assert np.all(segments.starts.real == 0)
    np.testing.assert_allclose(segments.starts.imag, s, atol=slack(hand, 1))
    np.testing.assert_array_equal(segments.starts, heights)
    np.testing.assert_array_equal(segments.ends.imag, segments.starts.imag)
    np.testing.assert_allclose(segments.ends, segments.starts + 1j * side(name) * 1j * v, atol=slack(hand, 1.5))
    np.testing.assert_array_equal(dots, segments.ends)
    assert np.all(axis.real == 0)
    assert axis[1].imag == pytest.approx(dots.imag.max() + 8)
    start, *named = of(step, Label)
    assert (start.at, start.text, start.towards) == (0, "B₀", side(name) - 1j)  # away from the rest line
    for label in named:
        k = names_of(name).index(label.text)
        assert label.at == dots[k]
        # On the line of motion, where several ends lie in one place, rises are named on their side of it.
        up, outer = s[k] > s.mean(), -side(name) * (1 if rising(name)[k] else -1)
        expected = np.sign(dots[k].real) if abs(dots[k].real) > 1 else complex(outer, 1 if up else -1)
        assert label.towards == expected
    assert {label.text for label in named} >= {names_of(name)[k] for p in BOARDS[name].stations.phases for k in ends(p)}
    assert len(named) >= len(BOARDS[name].stations.phases) * 5


def ends(phase: slice) -> tuple[int, int]:
    return phase.start, phase.stop - 1


@EVERY
def test_the_caption_of_the_velocities_says_factor_sides_and_one_station_in_full(name, hand):
    step, read = diagram(name, hand)[0], chain(name, hand)["integration"].readings
    caption, x = str(step.caption), of(step, Dots)[1].points.real
    assert says(step, r"measures ([\d.]+) mm") == [pytest.approx(np.abs(x).max(), abs=0.051)]
    assert f"{beside(-side(name))} on a rise and {beside(side(name))} on a return" in caption
    assert ("anticlockwise" in caption) == (side(name) > 0)
    factor = float(read["v"].scale) / float(read["s"].scale)
    assert says(step, r"μᵥ/μₛ = ([\d.]+),") == [pytest.approx(factor, abs=5.1e-4)]
    station, *numbers = re.search(
        r"Station (\S+): mark it ([\d.]+) mm up and lay off ([\d.]+) mm × ([\d.]+) = ([\d.]+) mm\.", caption
    ).groups()
    k = names_of(name).index(station)
    assert rising(name)[k]
    assert 0 < k < 12
    s, v, by, length = map(float, numbers)
    assert (s, v, by) == pytest.approx((read["s"].paper[k], read["v"].paper[k], factor), abs=0.0051)
    assert length == pytest.approx(v * factor, abs=0.02) == pytest.approx(abs(x[k]), abs=0.02 + slack(hand, 1.5))


@EVERY
def test_every_station_of_the_velocities_is_a_part_with_its_own_numbers(name, hand):
    step, read = diagram(name, hand)[0], chain(name, hand)["integration"].readings
    first, *parts = step.places
    assert "B₀" in str(first.caption)
    s, v, x = read["s"].paper, read["v"].paper, of(step, Dots)[1].points.real
    factor = float(read["v"].scale) / float(read["s"].scale)
    for k, (part, station) in enumerate(zip(parts, names_of(name), strict=True)):
        caption, (height, end) = str(part.caption), part.draws
        assert caption.startswith(f"Station {station}: ")
        assert (height.index.tolist(), end.index.tolist()) == ([k], [k])
        assert (height.act, end.act) == tuple(dots.of for dots in of(step, Dots))
        if abs(s[k]) < 0.005:
            assert "at B₀, " in caption
        else:
            assert says(part, r": (-?[\d.]+) mm up, ") == [pytest.approx(s[k], abs=0.0051)]
        if abs(v[k]) < 0.005:
            assert caption.endswith("v = 0.")
        else:
            found = says(part, r"v ([\d.]+) mm × ([\d.]+) = ([\d.]+) mm to")
            assert found == pytest.approx([abs(v[k]), factor, abs(v[k]) * factor], abs=0.0051)
            assert caption.endswith(f" {beside(x[k])}.")


@EVERY
def test_the_curves_run_through_the_ends_of_the_velocities_from_jump_to_jump(name, hand):
    first, second = diagram(name, hand)[:2]
    ends, curves = of(first, Dots)[1].points, of(second, Line, Role.RESULT)
    assert len(curves) == len(BOARDS[name].stations.pieces)
    for piece, curve in zip(BOARDS[name].stations.pieces, curves, strict=True):
        through = curve.points[::8] if curve.points.size > ends[piece].size else curve.points
        np.testing.assert_allclose(through, ends[piece], atol=EXACT)


@EVERY
def test_the_pieces_of_the_curves_are_parts_and_meet_in_corners(name, hand):
    step, pieces = diagram(name, hand)[1], BOARDS[name].stations.pieces
    spans = [f"From {names_of(name)[piece.start]} to {names_of(name)[piece.stop - 1]}" for piece in pieces]
    corners = [names_of(name)[b.start] for a, b in pairwise(pieces) if a.stop - 1 == b.start]
    assert ("There is a corner" in str(step.caption)) == bool(corners)
    assert not corners or f"corner at {', '.join(corners)}," in str(step.caption)
    for part, span, line in zip(step.places, spans, of(step, Line), strict=True):
        tool = "French curve" if line.points.size > 2 else "ruler"
        assert str(part.caption) == f"{span}: with the {tool}."
        assert [drawn.act for drawn in part.draws] == [line.of]


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
    asked += [("dwell", permitted.rise, -side(name))] if permitted.rest else []
    marks = zip(of(step, Line, Role.LIMIT), of(step, Segments), of(step, AngleMark), strict=True)
    return [Bound(title, *found, limit, lean) for (title, limit, lean), found in zip(asked, marks, strict=True)]


@EVERY
def test_the_limits_lean_at_the_angles_that_they_bear(name, hand):
    bottom = of(diagram(name, hand)[0], Line, Role.AXIS)[1].points[0].imag
    for bound in bounds(name, hand):
        way = bound.below - bound.above
        assert way.imag < 0
        turned = cmath.phase(way / -1j)
        assert turned == pytest.approx(bound.lean * bound.limit, abs=EXACT if hand == "perfect" else MANY * TURN)
        start, angle = complex(bound.upright.starts[0]), bound.angle
        # It ends with the hatching; where another line cuts that off, a little below the crossing.
        if permitted(name, hand, bound.below):
            assert bound.below.imag == pytest.approx(bottom)
        else:
            assert bound.below.imag > bottom - EXACT
            assert abs(bound.below - bound.above) > 60 - EXACT or bound.below.imag == pytest.approx(bottom)
        assert bound.inside(start) == pytest.approx(0, abs=EXACT)
        # It is shown not far below where the line touches; the rest line's low, to the other side.
        touch = bound.above if bound.title == "dwell" else bound.above + way * 10 / -way.imag
        down = -1 if bound.title == "dwell" else 1
        assert start == pytest.approx(touch + (bound.below - touch) * (0.12 if down > 0 else 0.85))
        assert complex(bound.upright.ends[0]) == pytest.approx(start - 26.4j * down)
        assert angle.centre == start
        assert angle.radius == 22
        assert (angle.start, angle.end) == pytest.approx(sorted((-down * math.pi / 2, cmath.phase(down * way))))
        assert str(angle.text) == f"{math.degrees(bound.limit):g}°"


@EVERY
def test_the_limits_touch_their_curves_and_cross_them_nowhere(name, hand):
    curves, up = of(diagram(name, hand)[1], Line), rising(name)
    for bound in bounds(name, hand):
        if bound.title == "dwell":
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
    assert says(step, r"horizontal through B₀ ([\d.]+) mm") == [pytest.approx(abs(at_zero.real), abs=0.051)]
    assert f"mm {beside(at_zero.real)} of it." in str(step.caption)
    assert ("spring" in str(step.caption)) == (BOARDS[name].limits.return_ is None)


@EVERY
def test_every_limit_is_a_part_that_says_angle_lean_side_and_touch(name, hand):
    step, (s, _, _), names = diagram(name, hand)[2], s_and_v(name, hand), names_of(name)
    ends = of(diagram(name, hand)[0], Dots)[1].points
    for part, bound in zip(step.parts, bounds(name, hand), strict=True):
        caption, down = str(part.caption), bound.below - bound.above
        assert says(part, r"at ([\d.]+)° to the line of motion") == [pytest.approx(math.degrees(bound.limit))]
        assert {drawn.act for drawn in part.draws} >= {bound.angle.of, bound.upright.of}
        if bound.title == "dwell":
            said = f"From B₀ draw the dwell line at {math.degrees(bound.limit):g}° to the line of motion, "
            assert f"{said}down {beside(down.real)}" in caption
            continue
        lean = beside(-down.real)
        assert f"leaning {lean} going up, and slide it in from the lower {lean.split()[-1]}" in caption
        # It is slid in from the side of what it permits.
        assert (bound.inward.real > 0) == (lean == "to the right")
        assert bound.inward.imag < 0
        assert f"limit on the {bound.title} " in caption
        assert f"the curve of the {bound.title}" in caption
        where = caption.partition(": here ")[2].partition(".")[0]
        if between := re.fullmatch(r"between (\S+) and (\S+)", where):
            k, after = map(names.index, between.groups())
            assert after == k + 1
        else:
            k = names.index(where.removeprefix("at "))
            touched = bound.above - down * 10 / down.imag
            assert hand != "perfect" or abs(touched - ends[k]) < 0.06 * np.abs(np.diff(ends)).max()
        assert rising(name)[k] == (bound.title == "rise")
        touch = bound.above - down * 10 / down.imag
        clearest = np.array(bound.inside(ends))
        clearest[rising(name) != (bound.title == "rise")] = -np.inf
        # It is one of the stations about the touch that come nearest to the line, or pass it with a trembling hand.
        assert abs(k - int(np.argmax(clearest))) <= 1 + (hand != "perfect")
        assert abs(touch.imag - s[k]) < np.abs(np.diff(s)).max() + slack(hand, 3)


@EVERY
def test_the_caption_of_the_region_says_which_side_each_line_cuts_off(name, hand):
    step = diagram(name, hand)[3]
    for bound in bounds(name, hand):
        level = "in the lower dwell" if bound.title == "dwell" else f"on the {bound.title}"
        side_of = f"A cam centre {beside(-bound.inward.real)} of the {bound.title} line"
        assert f"{side_of} would give more than {math.degrees(bound.limit):g}° {level}." in str(step.caption)
    hatching, *others = step.parts
    assert [drawn.act for drawn in hatching.draws] == [one(step, Region).of]
    for part, (title, place) in zip(others, crosses(name, hand).items(), strict=True):
        choice = "Thin crosses mark the points that textbooks choose. " if part is others[0] else ""
        assert str(part.caption).lower().startswith(f"{choice}{title}, {NAMES[title]}: ".lower())
        assert says(part, r"([\d.]+) mm (?:long|from B₀)\.") == [pytest.approx(abs(place), abs=0.051)]
        assert part.draws[0].place == place


def permitted(name: str, hand: str, places, tolerance: float = 1e-7):
    return np.all([b.inside(np.asarray(places)) >= -tolerance for b in bounds(name, hand)], axis=0)


@EVERY
def test_the_region_holds_just_what_no_limit_cuts_off(name, hand):
    corners = one(diagram(name, hand)[3], Region).boundary
    bottom = of(diagram(name, hand)[0], Line, Role.AXIS)[1].points[0].imag
    x, y = np.meshgrid(np.linspace(corners.real.min(), corners.real.max(), 37), np.linspace(bottom, 0, 41))
    grid = (x + 1j * y).ravel()
    edges = np.roll(corners, -1) - corners
    turns = ((grid[:, None] - corners) * edges.conjugate()).imag
    within = np.all(turns >= -1e-6, axis=1) | np.all(turns <= 1e-6, axis=1)
    np.testing.assert_array_equal(within, permitted(name, hand, grid, 1e-6 / np.abs(edges).max()))
    assert within.any()


FOOT, APEX, CENTRAL = "A₁", "A₂", "A₃"
NAMES = {FOOT: "the foot of the perpendicular", APEX: "the apex", CENTRAL: "of a central follower (e = 0)"}
"""What the captions say of the names on the drawing."""


def crosses(name: str, hand: str) -> dict[str, complex]:
    """The alternatives by their names, where their crosses stand."""
    step = diagram(name, hand)[3]
    found = {}
    for strokes, label in zip(of(step, Segments), of(step, Label), strict=True):
        np.testing.assert_allclose(strokes.ends - strokes.starts, [3, 3j], atol=EXACT)
        np.testing.assert_allclose((strokes.ends + strokes.starts) / 2, [label.at, label.at], atol=EXACT)
        outwards = sum(b.inward for b in bounds(name, hand) if abs(b.inside(label.at)) < 1e-6)
        assert label.towards == pytest.approx(-outwards or 1 - 1j)
        found[str(label.text)] = label.at
    return found


@EVERY
def test_the_alternatives_are_the_foot_the_apex_and_the_central_followers_centre(name, hand):
    found, lines = crosses(name, hand), {b.title: b for b in bounds(name, hand)}
    rise, back = lines["rise"], lines.get("return")
    assert list(found) == [FOOT, *([APEX] if back else []), CENTRAL]
    assert rise.inside(found[FOOT]) == pytest.approx(0, abs=1e-7)
    way = (rise.below - rise.above) / abs(rise.below - rise.above)
    assert abs((found[FOOT] * way.conjugate()).real) <= slack(hand, 2)
    if back:
        assert (rise.inside(found[APEX]), back.inside(found[APEX])) == pytest.approx((0, 0), abs=1e-7)
    assert found[CENTRAL].real == 0
    assert permitted(name, hand, found[CENTRAL])
    assert found[CENTRAL] == 0 or not permitted(name, hand, found[CENTRAL] + 0.01j)


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
    assert (label.at, label.towards, label.text) == (a, np.sign(a.real) - 1j, "A₀")
    size, *others = of(step, Dimension)
    assert (size.start, size.end) == (0, a)
    assert str(size.text) == f"min r₀ = {abs(a) * mu:.2f}"  # not the one that is adopted
    assert size.aside == 0
    if abs(a.real) < EXACT:
        assert not others
        return
    across, below = others
    assert (across.start, across.end, across.aside) == (1j * a.imag, a, -8)
    assert str(across.text) == (f"e = {abs(a.real) * mu:.2f}" if offset is None else f"e = {abs(offset):g}")
    assert (below.start, below.end) == (0, 1j * a.imag)
    # It stands on the other side of the line of motion than A: to the left of a line that goes down is its right.
    assert below.aside == -14 * np.sign(a.real)
    assert str(below.text) == f"s₀ = {-a.imag * mu:.2f}"
    np.testing.assert_allclose(one(step, Line, Role.AXIS).points, [a - 6j, a.real + 6j])
    np.testing.assert_allclose(one(step, Line, Role.CONSTRUCTION).points, [a, 1j * a.imag], atol=EXACT)


@EVERY
def test_the_parts_of_the_cam_centre_say_what_is_measured_and_what_binds(name, hand):
    step, offset, mu = diagram(name, hand)[4], BOARDS[name].follower.place, s_and_v(name, hand)[2]
    a = complex(one(step, Dots, Role.RESULT).points[0])
    assert says(step, r"measure: ([\d.]+) mm × ([\d.]+) = ([\d.]+) mm = r₀") == pytest.approx(
        [abs(a), mu, abs(a) * mu], abs=0.0051
    )
    assert ("Carry A₀ horizontally" in str(step.caption)) == (abs(a.real) > EXACT)
    if abs(a.real) > EXACT:
        pattern = r"T-square: ([\d.]+) mm × [\d.]+, so e = (-?[\d.]+) mm, and ([\d.]+) mm × [\d.]+ = ([\d.]+) mm = s₀"
        said = says(step, pattern)
        assert said == pytest.approx([abs(a.real), -a.real * mu, -a.imag, -a.imag * mu], abs=0.0051)
    on = [f"the {b.title} line" for b in bounds(name, hand) if abs(b.inside(a)) < 1e-6]
    caption = str(step.caption)
    if offset is None:
        how = "the perpendicular from B₀ meets" if len(on) == 1 else "it lies on"
        assert f"nearest to B₀, where {how} {' and '.join(on)}." in caption
    else:
        assert f"enters the hatched region, {f'on {on[0]}' if on else 'level with B₀'}" in caption
    if offset:
        assert_offset(step.parts[0], offset, mu)
        line = one(step, Line, Role.AXIS)
        assert [drawn.act for drawn in step.parts[0].draws] == [line.of]
    assert ("With e = 0, " in caption) == (offset == 0)
    marks = {mark.of for mark in step.marks if not isinstance(mark, Dimension | Label) and mark.of is not None}
    assert {drawn.act for part in step.parts for drawn in part.draws} == marks


def assert_offset(part: Part, offset: float, mu: float) -> None:
    """The upright lies on the other side of B₀ than the follower of the cam centre, in the scale of s."""
    e, size, paper = says(part, r"e = (-?[\d.]+) mm the follower moves ([\d.]+) mm to .*/[\d.]+ = ([\d.]+) mm")
    assert (e, size, paper) == (offset, abs(offset), pytest.approx(abs(offset) / mu, abs=0.0051))
    assert f"{beside(offset)} of the cam centre" in str(part.caption)
    assert str(part.caption).endswith(f"mm {beside(-offset)} of B₀.")


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
    left, right = re.search(r", ([\d.]+):([\d.]+), μᵥ", str(step.view.title)).groups()
    return float(right) / float(left)


@cache
def plan_steps(name: str, hand: str) -> tuple[Step, ...]:
    """The steps of the pressure angle but the first two, which are in the combined diagram."""
    found = steps(name, hand, "pressure_angle")
    assert [str(step.title).partition(" at ")[0] for step in found] == [
        "The adopted prime radius",
        "The cam centre",
        "The mechanism",
        "Velocity plan",
        "The normal and the triangle ABC",
        "The pressure angle",
        "The pressure angle",
    ]
    return tuple(found[2:])


@cache
def corners(name: str, hand: str) -> dict[str, complex]:
    """A, B, C and D of the mechanism, and the heads of v1 and v2 from the pole."""
    mechanism, plan, normal, angle, _ = plan_steps(name, hand)
    a, b = (complex(dots.points[0]) for dots in of(mechanism, Dots))
    c = complex(one(normal, Dots).points[0])
    v1, v2, v21 = of(plan, Arrow)
    assert v1.start == v2.start
    assert (v21.start, v21.end) == (v1.end, v2.end)
    found = {"p": v1.start, "v1": v1.end - v1.start, "v2": v2.end - v2.start, "v21": v21.end - v21.start}
    return found | {"A": a, "B": b, "C": c, "D": complex(one(angle, Dots).points[0])}


@EVERY
def test_the_compass_finds_the_adopted_cam_centre_on_the_upright_of_the_offset(name, hand):
    rounding, step = steps(name, hand, "pressure_angle")[:2]
    drawn, mu = chain(name, hand), s_and_v(name, hand)[2]
    r0, e = drawn.prime_radius, drawn.place
    assert not rounding.marks
    assert says(rounding, r"On paper r₀ is ([\d.]+)/([\d.]+) = ([\d.]+) mm") == pytest.approx(
        [r0, mu, r0 / mu], abs=0.0051
    )
    arc, a = one(step, Arc), complex(one(step, Dots, Role.RESULT).points[0])
    assert abs(arc.centre) <= slack(hand, 1)
    assert arc.radius == pytest.approx(r0 / mu, abs=slack(hand, 1))
    # Seven millimetres to either side of A.
    assert (arc.end - arc.start) * arc.radius == pytest.approx(14)
    middle = arc.centre + cmath.rect(arc.radius, (arc.start + arc.end) / 2)
    assert middle == pytest.approx(a, abs=EXACT)
    assert a.imag < 0
    label = one(step, Label)
    assert str(label.text) == f"A (r₀ = {r0:g}, e = {e:g})"
    assert (label.at, label.towards) == (a, -1j - np.sign(a.real))
    compass = says(step, r"Compass ([\d.]+) mm, ([\d.]+)/([\d.]+), about B₀")
    assert compass == pytest.approx([r0 / mu, r0, mu], abs=0.0051)
    assert says(step, r"A lies ([\d.]+) mm × [\d.]+ = ([\d.]+) mm = s₀") == pytest.approx(
        [-a.imag, -a.imag * mu], abs=0.0051 + slack(hand, 0.5)
    )
    if e:
        assert_offset(step.parts[1], e, mu)
        np.testing.assert_allclose(one(step, Line, Role.AXIS).points, [a - 6j, a.real + 6j])
    assert len(step.parts) == 2 + bool(e)
    again, before = of(step, Dots, Role.CONSTRUCTION), of(diagram(name, hand)[0], Dots)
    for dots, there in zip(again, before, strict=True):
        np.testing.assert_allclose(dots.points, there.points, atol=slack(hand, 3))
    assert [drawn.act for drawn in step.parts[0].draws] == [dots.of for dots in again]
    assert ("the line of motion itself, as e = 0" in str(step.caption)) == (not e)


def test_the_rounding_compares_what_is_adopted_with_the_least_radius_there():
    """By a hand without error: a decision is not a matter of a trembling one."""
    for name in BOARDS:
        drawn = chain(name, "perfect")
        said = [str(steps(name, hand, "pressure_angle")[0].caption) for hand in HANDS]
        assert said[0].partition(" On paper")[0] == said[1].partition(" On paper")[0]
        place = BOARDS[name].follower.place
        numbers = re.search(r"Round the minimum radius, ([\d.]+) mm, up to r₀ = ([\d.]+) mm\.", said[0])
        least, adopted = map(float, numbers.groups())
        assert adopted == drawn.prime_radius
        assert 0 <= adopted - least < drawn.rounding
        if place is None:
            found, rounded = map(float, re.search(r"e = (-?[\d.]+) mm, is rounded to (-?[\d.]+) mm", said[0]).groups())
            assert found == pytest.approx(float(drawn["minimum_radius"].readings["offset"].value), rel=1e-4)
            assert rounded == drawn.place
            there = Chain(replace(BOARDS[name], follower=DrawnTranslating(rounded)))["minimum_radius"]
            assert adopted >= float(there.readings["prime_radius"].value)
        else:
            assert "rounded to" not in said[0]
        # What is rounded is what was found in the step before.
        assert least == pytest.approx(float(drawn["minimum_radius"].readings["prime_radius"].value), rel=1e-4)


@over_all(
    ("adopted", "said"),
    [
        (Adoption(44.0, -10.0, 43.28, None, False, 1.0), "Round the minimum radius, 43.28 mm, up to r₀ = 44 mm."),
        (
            Adoption(44.0, -10.0, 44.0, None, False, 1.0),
            "Take r₀ = 44 mm, which is the minimum permitted radius itself.",
        ),
        (
            Adoption(44.0, -10.0, 43.31, -9.7, False, 1.0, 43.28),
            "The value found, c = -9.7 mm, is rounded to -10 mm. Round the minimum radius, 43.28 mm, up to r₀ = 44 mm.",
        ),
        (
            Adoption(45.0, -10.0, 44.02, -9.7, False, 1.0, 43.98),
            (
                "Read the minimum radius again at c = -10 mm: 44.02 mm. "
                "Round the minimum radius, 44.02 mm, up to r₀ = 45 mm."
            ),
        ),
        (
            Adoption(47.0, -10.0, 43.28, -9.7, False, 1.0),
            "Take r₀ = 47 mm, a round value that goes with it; the minimum",
        ),
        (Adoption(61.0, 150.0, 32.81, None, True, 1.0), "The task gives r₀ = 61 mm, which is larger than the minimum"),
        (Adoption(30.0, 150.0, 32.81, None, True, 1.0), "smaller than the minimum permitted radius, 32.81 mm: a limit"),
        (Adoption(30.0, 150.0, math.nan, None, True, 1.0), "The task gives r₀ = 30 mm. On paper"),
        (
            Adoption(30.0, 150.0, math.nan, 149.6, False, 1.0),
            "The value found, c = 149.6 mm, is rounded to 150 mm. Take",
        ),
    ],
)
def test_a_rounding_says_what_is_adopted_and_against_what(adopted, said):
    step = adoption_step(adopted, "c", 0.5, COMBINED)
    assert said in str(step.caption)
    assert ("the given radius" in str(step.why)) == adopted.given
    assert str(step.caption).endswith(
        f"On paper r₀ is {adopted.prime_radius:g}/0.5 = {adopted.prime_radius * 2:.2f} mm."
    )


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
    step = plan_steps(name, hand)[0]
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
    rays = one(plan_steps(name, hand)[4], Segments)
    a = one(steps(name, hand, "pressure_angle")[1], Dots, Role.RESULT).points[0]
    np.testing.assert_array_equal(rays.starts, a)
    return complex(a), complex(rays.ends[shown(name, hand)])


def shown(name: str, hand: str) -> int:
    """The station of the greatest angle among those where the follower rises at some speed."""
    v = chain(name, hand)["integration"].readings["v"].value
    alpha = np.abs(measured(name, hand).readings["alpha"].paper)
    moving = [k for k in range(v.size) if rising(name)[k] and v[k] >= v.max() / 4]
    return max(moving, key=lambda k: alpha[k])


@EVERY
def test_names_stand_at_the_corners_of_plan_and_mechanism(name, hand):
    at, sigma = corners(name, hand), side(name)
    labels = {label.text: label for step in plan_steps(name, hand)[:4] for label in of(step, Label)}
    assert set(labels) == {"v₁", "v₂", "v₂₁", "p", "A", "B", "C", "D"}
    middle = {"v₁": at["v1"] / 2, "v₂": at["v2"] / 2, "v₂₁": (at["v1"] + at["v2"]) / 2, "p": 0}
    for text, place in middle.items():
        assert labels[text].at == pytest.approx(at["p"] + place)
    for text in "ABCD":
        assert labels[text].at == at[text]
    # Beside the arrows outside of the plan, that of v1 to its right; at the corners away from the triangle.
    inner = (at["v1"] + at["v2"]) / 3
    for text, side_of in (("v₁", at["v1"]), ("v₂", at["v2"]), ("v₂₁", at["v21"])):
        towards = complex(labels[text].towards)
        assert ((inner - middle[text]) * towards.conjugate()).real < 0, text
        assert square(towards, side_of) < EXACT
    assert labels["p"].towards == -1 - 1j
    ways = {"A": -1j - sigma, "B": 1 + 1j, "C": -1j + sigma, "D": 1j - sigma}
    assert {text: labels[text].towards for text in ways} == ways
    # The plan stands clear of the mechanism, to its right.
    left = min((at["p"] + way).real for way in (0, at["v1"], at["v2"]))
    assert left == pytest.approx(max(0.0, at["B"].real, at["C"].real, at["D"].real) + 22)
    assert at["p"].imag == 8


@EVERY
def test_the_lines_of_the_mechanism_join_its_corners(name, hand):
    triangle, _, met, angle, _ = plan_steps(name, hand)
    at = corners(name, hand)
    a, b, c, d = (at[corner] for corner in "ABCD")
    guide = one(triangle, Line, Role.AXIS).points
    ab, ac = (one(step, Line, Role.CURVE).points for step in (triangle, met))
    normal = one(met, Line, Role.CONSTRUCTION).points
    np.testing.assert_allclose(guide, [b.real - 6j, b + 12j], atol=EXACT)
    np.testing.assert_allclose([*ab, *ac], [a, b, a, c], atol=EXACT)
    np.testing.assert_allclose(normal, [b + 0.12 * (b - c), c], atol=EXACT)
    bd, da = one(angle, Line, Role.CURVE).points, one(angle, Line, Role.LIMIT).points
    np.testing.assert_allclose([*bd, *da], [b, d, d, a], atol=EXACT)
    np.testing.assert_allclose(one(angle, Line, Role.CONSTRUCTION).points, [d, d - 0.62j * b.imag], atol=EXACT)


@EVERY
def test_the_drawn_pressure_angle_is_the_one_that_is_printed(name, hand):
    step, k, at = plan_steps(name, hand)[3], shown(name, hand), corners(name, hand)
    mark, d = one(step, AngleMark), at["D"]
    # The angle at D from the motion downwards to A; it is positive where the cam's turning closes it.
    drawn = side(name) * cmath.phase(d / 1j)
    read = measured(name, hand).readings["alpha"].paper[k]
    assert float(read) == pytest.approx(drawn, abs=EXACT if hand == "perfect" else MANY * TURN)
    assert (mark.centre, mark.radius) == (d, pytest.approx(0.55 * at["B"].imag))
    assert (mark.start, mark.end) == pytest.approx(sorted((-math.pi / 2, -math.pi / 2 + cmath.phase(d / 1j))))
    # The plan itself is measured, by a hand that errs no more.
    assert str(mark.text) == f"α = {math.degrees(drawn):.1f}°"
    station, *numbers = re.search(r"station (\S+) .* α = (-?[\d.]+)°, .* = ([\d.]+)°", str(step.caption)).groups()
    assert station == names_of(name)[k]
    assert list(map(float, numbers)) == pytest.approx([math.degrees(drawn), 90 - abs(math.degrees(drawn))], abs=0.0051)
    mechanism, plan, _, angle, _ = plan_steps(name, hand)
    assert all(str(each.title).endswith(f"station {station}") for each in (mechanism, plan, angle))


@EVERY
def test_the_captions_of_the_plan_say_the_lengths_that_are_drawn(name, hand):
    mechanism, plan, met, angle, _ = plan_steps(name, hand)
    at, scale, sigma, (_, _, mu) = corners(name, hand), plan_scale(plan), side(name), s_and_v(name, hand)
    k, e = shown(name, hand), chain(name, hand).place
    # The mechanism: B lies s0 + s above A, and e beside it.
    s0, s, total, paper, ab = says(
        mechanism,
        r"s₀ \+ s = ([\d.]+) \+ ([\d.]+) = ([\d.]+) mm above A, which is ([\d.]+) mm of paper.* B: ([\d.]+) mm",
    )
    assert s == pytest.approx(float(chain(name, hand)["integration"].readings["s"].value[k]), rel=1e-4)
    assert s0 == pytest.approx(float(measured(name, hand).readings["s0"].value), rel=1e-4)
    assert total == pytest.approx(s0 + s, abs=2e-3)
    assert total == pytest.approx(at["B"].imag * scale, abs=2e-3 + slack(hand, 1.5) * mu)
    assert (paper, ab) == pytest.approx((at["B"].imag, abs(at["B"])), abs=0.0051)
    if e:
        assert says(mechanism, r"vertical, ([\d.]+) mm") == [pytest.approx(abs(at["B"].real), abs=0.0051)]
        assert abs(at["B"].real) * scale == pytest.approx(abs(e), abs=EXACT + slack(hand, 2) * mu)
        assert f"mm {beside(e)} of A" in str(mechanism.caption)
    else:
        assert "vertical through A" in str(mechanism.caption)
    # The plan, with the angular velocity divided out.
    across, per_mm = says(plan, r"v₁ = AB = ([\d.]+) mm")[0], says(plan, r"1 mm of the plan is ([\d.]+) mm/rad")[0]
    assert (across, per_mm) == pytest.approx((abs(at["v1"]), scale), abs=0.0051)
    assert f"from it {'anti' * (sigma > 0)}clockwise." in str(plan.caption)
    combined, by, v, along = says(plan, r"diagram, ([\d.]+) mm × ([\d.]+) = ([\d.]+) mm/rad, is ([\d.]+) mm here")
    start, end = foot_and_end(name, hand)
    assert (combined, by) == pytest.approx((abs(end.real), mu), abs=0.0051)
    assert (v, along) == pytest.approx((abs(end.real) * mu, abs(at["v2"])), abs=0.0051)
    assert says(plan, r"v₂₁ measures ([\d.]+) mm") == [pytest.approx(abs(at["v21"]), abs=0.0051)]
    # C and D.
    length, again, by, value = says(met, r"C, ([\d.]+) mm .* AC = ([\d.]+) mm × ([\d.]+) = ([\d.]+) mm/rad")
    assert (length, by, value) == pytest.approx((abs(at["C"]), scale, abs(at["C"]) * scale), abs=0.0051)
    assert again == length
    assert f"mm {beside(at['C'].real)} of A" in str(met.caption)
    assert value == pytest.approx(v, abs=0.011)
    assert says(angle, r", ([\d.]+) mm to D") == [pytest.approx(abs(at["D"] - at["B"]), abs=0.0051)]
    assert f"from B horizontally {beside((at['D'] - at['B']).real)}," in str(angle.caption)
    assert start.imag < 0


def test_a_negative_angle_leaves_its_magnitude_for_the_transmission():
    """Far on the wrong side the follower is pushed back even as it rises."""
    board = coursework("3-4-5", offset=-60.0, limits=limits(30, rest=False))
    region, measured = (Chain(board)[name].steps() for name in ("minimum_radius", "pressure_angle"))
    alpha, gamma = says(measured[5], r"α = (-[\d.]+)°, .* = ([\d.]+)°")
    assert gamma == pytest.approx(90 + alpha, abs=0.011)
    # There the level of the start cuts the upright before any line does.
    assert "A₀ is where this vertical enters the hatched region, level with B₀" in str(region[4].caption)
    assert "s₀ = 0, because it lies level with B₀" in str(region[4].caption)


@EVERY
def test_a_ray_to_every_end_has_the_angle_that_its_part_says(name, hand):
    step, names = plan_steps(name, hand)[4], names_of(name)
    rays, alpha = one(step, Segments), np.degrees(measured(name, hand).readings["alpha"].paper)
    np.testing.assert_allclose(rays.ends, of(diagram(name, hand)[0], Dots)[1].points, atol=slack(hand, 3))
    ways = rays.ends - rays.starts
    for k, (part, way) in enumerate(zip(step.places, ways, strict=True)):
        station, angle = re.fullmatch(r"Ray (\S+): (-?[\d.]+)°\.", str(part.caption)).groups()
        assert station == names[k]
        assert [(drawn.act, drawn.index.tolist()) for drawn in part.draws] == [(rays.of, [k])]
        assert float(angle) == pytest.approx(alpha[k], abs=0.0051)
        # Positive where it leans to the side of the rise's ends.
        leans = -side(name) * math.degrees(math.atan2(way.real, way.imag))
        assert float(angle) == pytest.approx(leans, abs=0.0051 if hand == "perfect" else math.degrees(MANY * TURN))
    shown_at, angle, greatest, where, gamma = re.search(
        r"Ray (\S+), the one of the plan: (-?[\d.]+)°\. .* is (-?[\d.]+)°, at (\S+); .* minimum, ([\d.]+)°",
        str(step.caption),
    ).groups()
    assert (shown_at, float(angle)) == (names[shown(name, hand)], pytest.approx(alpha[shown(name, hand)], abs=0.0051))
    assert float(greatest) == pytest.approx(alpha[names.index(where)], abs=0.0051)
    assert abs(float(greatest)) == pytest.approx(np.abs(alpha).max(), abs=0.0051)
    transmission = np.degrees(measured(name, hand).readings["transmission"].paper)
    assert float(gamma) == pytest.approx(transmission.min(), abs=0.0051)
    assert f"leans {beside(-side(name))} going up" in str(step.caption)


# --- parts and reasons -----------------------------------------------------------------------------------------------


@EVERY
def test_parts_draw_every_place_of_every_mark_once_and_nothing_else_is_left_over(name, hand):
    for step in (*diagram(name, hand), *steps(name, hand, "pressure_angle")):
        drawn = [(piece.act, k) for part in step.places for piece in part.draws for k in piece.index.tolist()]
        assert len(drawn) == len(set(drawn)), str(step.title)
        for mark in step.own_marks:
            if getattr(mark, "role", None) is Role.AXIS or mark.of is None or mark.of.kind is Kind.READ:
                continue
            assert mark.index is not None
            at = set(mark.index.tolist())
            assert at <= {k for act, k in drawn if act is mark.of}, (str(step.title), mark)


@EVERY
def test_every_step_has_a_reason(name, hand):
    for step in (*diagram(name, hand), *steps(name, hand, "pressure_angle")):
        assert re.fullmatch(r"(?!Because)[A-Z][^.]*\.", str(step.why)), str(step.title)
        told = " ".join([str(step.caption), *(str(place.caption) for place in step.places)])
        assert not re.search(r"\b-?0\.00? mm|\bnan\b", told)


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
    dwells = [p for a, b in zip(places[::2], places[1::2], strict=True) if (b - a).real > EXACT for p in (a, b)]
    np.testing.assert_allclose([p for rest in rests for p in rest.points], dwells, atol=EXACT)
    assert all(abs(np.diff(rest.points.imag)[0]) < EXACT or hand != "perfect" for rest in rests)
    assert says(step, r"dividers, ([\d.]+)° a millimetre") == [1]


@EVERY
def test_the_dimensions_of_the_phases_have_the_angles_that_they_bear(name, hand):
    step = steps(name, hand, "angle_diagram")[0]
    given, lowest = of(step, Dimension), min(0.0, one(step, Dots).points.imag.min())
    phases = [math.degrees(phase.angle) for phase in BOARDS[name].motion.phases]
    assert [float(re.search(r"= ([\d.]+)°", str(d.text)).group(1)) for d in given] == pytest.approx(phases)
    assert [(d.end - d.start).real for d in given] == pytest.approx(phases)
    assert given[0].start == pytest.approx(1j * (lowest - 26))
    assert all(a.end == b.start for a, b in pairwise(given))
    assert all(d.end.imag == d.start.imag for d in given)
    marked = [label for label in of(step, Label) if re.fullmatch(r"\d+°", str(label.text))]
    assert [label.at.real for label in marked] == pytest.approx([float(str(label.text)[:-1]) for label in marked])


@EVERY
def test_the_greatest_angles_are_read_where_the_curve_is_farthest_from_the_axis(name, hand):
    first, second = steps(name, hand, "angle_diagram")
    up, curves = rising(name), of(first, Line, Role.RESULT)
    tops = np.concatenate([dots.points for dots in of(second, Dots, Role.LIMIT)[:2]])  # then those inside a phase
    read = chain(name, hand)["angle_diagram"].readings
    for top, label, reading, rise in zip(
        tops, of(second, Label)[:2], ("max_rise", "max_return"), (True, False), strict=True
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
    for phase, top in zip(("rise", "return"), tops.imag, strict=True):
        found = says(second, rf"On the {phase} the farthest point of the curve is at (-?[\d.]+) mm, so α = (-?[\d.]+)°")
        assert found == pytest.approx([top, top], abs=0.0051)
