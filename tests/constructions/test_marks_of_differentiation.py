"""What graphical differentiation draws: chords or tangents, rays parallel to them, and what the rays cut off."""

from __future__ import annotations

import cmath
import math
import re
from functools import cache

import numpy as np
import pytest
from numpy.testing import assert_allclose
from over_all import over_all

import graphcam as gc
from graphcam.constructions.differentiation import TANGENT_HALF_LENGTH, differentiation
from graphcam.constructions.graduation import NUMBERS_ROOM, RAYS_ROOM
from graphcam.drafting.acts import Act, Kind
from graphcam.drafting.ink import Construction, Step
from graphcam.drafting.marks import Arrow, Dimension, Dots, Label, Line, Mark, Role, Segments
from graphcam.drafting.pencil import Pencil

MU_PHI, MU_S, POLES, TURN = gc.Scale(math.radians(1), "rad"), gc.Scale(0.5, "mm"), (40.0, 50.0), 360.0
X = np.array([3.0, 32.0, 60.0, 94.0, 121.0, 149.0, 180.0, 213.0, 240.0, 268.0, 301.0, 333.0])
"""Unequal parts, and no station at the start of the turn."""
SIGMA = 0.2
TREMBLING = Pencil(line=SIGMA, dividers=SIGMA, protractor=0.009, seed=5)
MANY = 6
"""So many standard deviations no error of a fixed seed's hand is greater than."""
EXACT = 1e-9


def displacement(x):
    """Ordinates on paper [mm], without a symmetry in which errors could cancel."""
    phi = np.radians(x)
    return 2 * (20 - 12 * np.cos(phi - 0.3) + 3 * np.sin(2 * phi))


BUILT_IN = ("the built-in task",)
KINDS = [(by, turn) for by in ("chords", "tangents") for turn in (TURN, None)]
EVERY = over_all("kind", [*KINDS, BUILT_IN])


@cache
def steps_of(kind: tuple, pencil: Pencil | None = None) -> list[Step]:
    return drawn(kind, pencil).steps()


@cache
def drawn(kind: tuple, pencil: Pencil | None = None) -> Construction:
    if kind == BUILT_IN:
        return gc.solve(gc.builtin_task("measured"), pencil).drawn["differentiation"]
    by, turn = kind
    return differentiation(X, displacement(X), MU_PHI, MU_S, POLES, pencil or Pencil(), turn=turn, by=by)


def cyclic(kind: tuple) -> bool:
    return kind == BUILT_IN or kind[1] is not None


def by_chords(kind: tuple) -> bool:
    return kind == BUILT_IN or kind[0] == "chords"


def one(step: Step, kind: type, k: int = 0):
    """The k-th mark of a kind in a step, but for what is drawn before the first act: axes and their graduation."""
    return [mark for mark in step.marks if isinstance(mark, kind) and not graduates(mark)][k]


def graduates(mark: Mark) -> bool:
    """Whether a mark is a stroke, a line or a number of a graduation."""
    strokes = isinstance(mark, Segments | Line) and mark.role is Role.SCALE and mark.of is None
    return strokes or (isinstance(mark, Label) and mark.small and mark.of is None)


def number(caption: object, pattern: str) -> float:
    """The number that a caption says where the pattern has a group."""
    return float(re.search(pattern, str(caption)).group(1))


def passes(kind: tuple, pencil: Pencil | None = None):
    """Of both derivations the plotted curve that is derived, the steps, the pole's distance and its index."""
    c = drawn(kind, pencil)
    steps = steps_of(kind, pencil)
    plotted = [one(steps[0], Dots).points, *(one(steps[k], Dots, 1).points for k in (2, 5))]
    pole_dots = [one(steps[k], Dots).points for k in (2, 5)]
    assert all(dot.shape == (1,) for dot in pole_dots)
    for k in (0, 1):
        yield plotted[k], plotted[k + 1], steps[3 * k + 1 : 3 * k + 4], c.givens.poles[k], "₁₂"[k]


def ends_of_chords(kind: tuple, plotted):
    """The places that chords join: of a turn the first one once more, a turn further on."""
    return np.append(plotted, plotted[0] + drawn(kind).givens.turn) if cyclic(kind) else plotted


# --- what is plotted -------------------------------------------------------------------------------------------------


@EVERY
def test_the_displacement_stands_upright_on_its_stations(kind):
    c = drawn(kind)
    step = c.steps()[0]
    dots, uprights = one(step, Dots), one(step, Segments)
    assert_allclose(dots.points.real, c.givens.x, atol=EXACT)
    if kind != BUILT_IN:
        assert_allclose(dots.points.imag, displacement(X), atol=EXACT)
    assert_allclose(uprights.starts, c.givens.x, atol=EXACT)
    assert_allclose(uprights.ends, dots.points, atol=EXACT)
    assert number(step.caption, r"at (\d+) stations") == c.givens.x.size
    assert ("the next turn begins with station 0" in str(step.caption)) == cyclic(kind)
    k = int(number(step.caption, r"station (\d+) lies"))
    assert number(step.caption, r"lies ([\d.]+) mm") == pytest.approx(dots.points[k].real, abs=0.0051)
    assert number(step.caption, r"ordinate is ([\d.]+) mm") == pytest.approx(dots.points[k].imag, abs=0.0051)
    assert number(step.caption, r"axis, 1 mm = (\S+)°") == pytest.approx(math.degrees(c.givens.mu_phi.per_mm), rel=1e-3)
    assert number(step.caption, r"each, 1 mm = (\S+) mm") == pytest.approx(c.givens.mu_s.per_mm, rel=1e-3)


@EVERY
def test_every_diagram_has_its_axes_and_their_names_at_the_heads(kind):
    c = drawn(kind)
    for at, symbol in ((0, "s"), (2, "v"), (5, "a")):
        step = c.steps()[at]
        heights = one(step, Dots, int(symbol != "s")).points.imag
        end = c.givens.turn or c.givens.x[-1]
        across, up = one(step, Arrow), one(step, Arrow, 1)
        assert (across.start, across.end) == (0, pytest.approx(end + 8))
        assert up.start == pytest.approx(1j * min(0, heights.min()))
        assert up.end == pytest.approx(1j * (max(0, heights.max()) + 8))
        names = [one(step, Label), one(step, Label, 1)]
        unit = {"s": "mm", "v": "mm/rad", "a": "mm/rad²"}[symbol]
        assert [(str(name.text), name.at) for name in names] == [("φ, °", across.end), (f"{symbol}, {unit}", up.end)]
        assert names[0].towards == -1j  # below the head
        assert names[1].towards == -1 - 1j  # left of the upright axis


@EVERY
@over_all("at", [0, 3, 6])
def test_the_curve_runs_through_every_plotted_point_and_over_the_ends_of_the_turn(kind, at):
    c = drawn(kind)
    steps = c.steps()
    curve, dots = one(steps[at], Line), one(steps[max(at - 1, 0)], Dots, int(at > 0))
    assert curve.role is Role.RESULT
    # A place in the interval over the end of the turn may lie beyond it: there the curve begins anew.
    places = np.where(dots.points.real > (c.givens.turn or np.inf), dots.points - (c.givens.turn or 0), dots.points)
    assert np.abs(places[:, None] - curve.points[None, :]).min(axis=1).max() < EXACT
    assert np.all(np.diff(curve.points.real) > 0)
    if cyclic(kind):
        turn = c.givens.turn
        widest = np.diff(curve.points.real).max()
        assert 0 <= curve.points[0].real < widest
        assert 0 <= turn - curve.points[-1].real < widest
        # What runs out on the right comes in on the left, with the slope of both.
        ways = curve.points[1] - curve.points[0], curve.points[-1] - curve.points[-2]
        gap = curve.points[0] + turn - curve.points[-1]
        if abs(gap) > 1e-6:
            middle = np.mean([way.imag / way.real for way in ways])
            assert gap.imag / gap.real == pytest.approx(middle, abs=0.1 * (1 + abs(middle)))
    else:
        assert_allclose(curve.points[[0, -1]], dots.points[[0, -1]], atol=EXACT)


# --- chords and tangents ---------------------------------------------------------------------------------------------


@over_all("pencil", [None, TREMBLING])
@over_all("kind", [k for k in [*KINDS, BUILT_IN] if by_chords(k)])
def test_chords_join_neighbouring_ordinates_and_come_round(kind, pencil):
    for plotted, _, (chords, *_), _, _ in passes(kind, pencil):
        polygon = one(chords, Line)
        assert_allclose(polygon.points, ends_of_chords(kind, plotted), atol=EXACT)
        assert polygon.role is Role.LIMIT
        assert number(chords.caption, r"others, (\d+) in all") == polygon.points.size - 1


def neighbours(kind: tuple, plotted):
    """Places with one more before and behind, where the turn goes on."""
    turn = drawn(kind).givens.turn
    return np.concatenate([plotted[-1:] - turn, plotted, plotted[:1] + turn]) if turn else plotted


@over_all("pencil", [None, TREMBLING])
@over_all("kind", [k for k in KINDS if not by_chords(k)])
def test_a_tangent_touches_its_point_and_crosses_neither_chord_there(kind, pencil):
    """Between the slopes of the two chords at a point lies that of the tangent: it passes without crossing them."""
    for plotted, _, (tangents, *_), _, _ in passes(kind, pencil):
        lines = one(tangents, Segments)
        beside = MANY * pencil.line if pencil else EXACT
        assert_allclose(np.abs((lines.starts + lines.ends) / 2 - plotted), 0, atol=beside)
        assert_allclose(np.abs(lines.ends - lines.starts), 2 * TANGENT_HALF_LENGTH, atol=EXACT)
        assert np.all(lines.ends.real > lines.starts.real)
        assert number(tangents.caption, r"others, (\d+) in all") == plotted.size
        chords = np.angle(np.diff(neighbours(kind, plotted)))
        inside = slice(None) if cyclic(kind) else slice(1, -1)
        seen = np.angle(lines.ends - lines.starts)[inside]
        slack = MANY * pencil.protractor if pencil else EXACT
        assert np.all(seen >= np.minimum(chords[:-1], chords[1:]) - slack)
        assert np.all(seen <= np.maximum(chords[:-1], chords[1:]) + slack)


@over_all("kind", [k for k in KINDS if not by_chords(k)])
def test_a_tangent_has_the_slope_of_the_parabola_through_its_point_and_its_neighbours(kind):
    for plotted, _, (tangents, *_), _, _ in passes(kind):
        lines, places = one(tangents, Segments), neighbours(kind, plotted)
        for k, p in enumerate(plotted):
            at = min(max(k + cyclic(kind), 1), places.size - 2)
            a, b, c = ((q.real, q.imag) for q in places[at - 1 : at + 2])
            slope = np.polyder(np.poly1d(np.polyfit(*zip(a, b, c, strict=True), 2)))(p.real)
            way = lines.ends[k] - lines.starts[k]
            assert way.imag / way.real == pytest.approx(slope, abs=1e-8)


# --- pole and rays ---------------------------------------------------------------------------------------------------


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_the_pole_lies_its_distance_to_the_left_and_the_distance_is_set_down_below_the_rays(kind, pencil):
    slack = MANY * SIGMA if pencil else EXACT
    for _, _, (_, step, _), distance, index in passes(kind, pencil):
        pole = complex(one(step, Dots).points[0])
        assert abs(pole + distance) < slack
        assert_allclose(one(step, Line).points, [pole, 0], atol=EXACT)
        name, rays = one(step, Label, 2), one(step, Segments)
        assert (name.at, name.text) == (pole, f"P{index}")
        assert name.towards.real < 0 < name.towards.imag
        measure = one(step, Dimension)
        assert (measure.start, measure.end) == (pole, 0)
        assert number(measure.text, rf"H{index} = (\S+)") == pytest.approx(distance)
        assert number(step.caption, rf"H{index} = ([\d.]+) mm") == pytest.approx(distance)
        assert measure.aside == pytest.approx(min(0, rays.ends.imag.min()) - 5)


def slopes_of(kind: tuple, plotted, step: Step):
    """The slopes of the chords or of the tangents that are drawn in a step."""
    tangents = None if by_chords(kind) else one(step, Segments)
    ways = tangents.ends - tangents.starts if tangents else np.diff(one(step, Line).points)
    return ways.imag / ways.real


@EVERY
def test_every_ray_is_parallel_to_its_chord_or_tangent_and_every_one_of_those_has_its_ray(kind):
    for plotted, _, (traced, step, _), distance, _ in passes(kind):
        rays, slopes = one(step, Segments), slopes_of(kind, plotted, traced)
        ways = rays.ends - rays.starts
        assert_allclose(rays.starts, -distance, atol=EXACT)
        assert_allclose(rays.ends.real, 0, atol=EXACT)
        beside = np.abs((ways.imag / ways.real)[:, None] - slopes[None, :])
        assert beside.min(axis=1).max() < EXACT  # parallel to one of them
        assert beside.min(axis=0).max() * distance < 2e-3  # those that fall on one another are drawn once
        assert np.diff(rays.ends.imag).min() > 1e-4


@EVERY
def test_what_a_ray_cuts_off_is_carried_straight_across_to_the_middle_or_the_station(kind):
    for plotted, derived, (traced, step, _), distance, _ in passes(kind):
        across = one(step, Segments, 1)
        assert_allclose(across.starts.real, 0, atol=EXACT)
        assert_allclose(across.starts.imag, across.ends.imag, atol=EXACT)
        assert_allclose(across.ends, derived, atol=EXACT)
        assert_allclose(derived.imag, distance * slopes_of(kind, plotted, traced), atol=EXACT)
        joined = ends_of_chords(kind, plotted)
        places = (joined[1:] + joined[:-1]).real / 2 if by_chords(kind) else plotted.real
        assert_allclose(derived.real, places, atol=EXACT)


@EVERY
def test_a_trembling_hand_draws_the_rays_beside_the_pole_parallel_but_for_its_set_square(kind):
    for plotted, derived, (traced, step, _), _, _ in passes(kind, TREMBLING):
        rays, across = one(step, Segments), one(step, Segments, 1)
        pole = complex(one(step, Dots).points[0])
        directions = np.angle(rays.ends - rays.starts)
        traced_directions = np.arctan(slopes_of(kind, plotted, traced))
        assert np.abs(directions[:, None] - traced_directions[None, :]).min(axis=1).max() < MANY * SIGMA / 150
        assert np.abs(rays.starts - pole).max() < MANY * SIGMA
        assert_allclose(rays.ends.real, 0, atol=EXACT)
        assert 0 < np.abs((across.ends - across.starts).imag).max() < MANY * SIGMA
        assert_allclose(across.ends, derived, atol=EXACT)


# --- what is said ----------------------------------------------------------------------------------------------------


def top_of_three(heights, at: int, *, round_about: bool) -> float:
    """The top of the parabola through the highest of equally counted ordinates and its neighbours."""
    n = len(heights)
    if not round_about and at in (0, n - 1):
        at = 1 if at == 0 else n - 2
    a, b, c = heights[at - 1], heights[at], heights[(at + 1) % n]
    bend, slope = a - 2 * b + c, (c - a) / 2
    if not bend < 0 or abs(slope / bend) > 1:
        return max(heights)
    return b - slope**2 / (2 * bend)


@EVERY
def test_the_greatest_ordinate_said_is_the_top_of_the_plotted_points(kind):
    for _, derived, (*_, step), _, _ in passes(kind):
        found = []
        for side in (1, -1):
            heights = list(side * derived.imag)
            found.append(top_of_three(heights, int(np.argmax(heights)), round_about=cyclic(kind)))
        assert number(step.caption, r"ordinate, ([\d.]+) mm") == pytest.approx(max(found), abs=0.006)
        side, near = re.search(r"mm (up|down), is near point (\d+)", str(step.caption)).groups()
        assert side == ("up" if found[0] >= found[1] else "down")
        k = int(near) - by_chords(kind)
        assert (derived.imag if side == "up" else -derived.imag)[k] == max(
            derived.imag if side == "up" else -derived.imag
        )


@EVERY
def test_the_scales_said_follow_from_the_poles_and_turn_the_greatest_ordinates_into_values(kind):
    c = drawn(kind)
    steps = c.steps()
    mu_v = c.givens.mu_s.per_mm / (c.givens.mu_phi.per_mm * c.givens.poles[0])
    mu_a = mu_v / (c.givens.mu_phi.per_mm * c.givens.poles[1])
    said = f"{steps[-2].caption} {steps[-1].caption}"
    for symbols, wanted, above, pole in (
        ("μᵥ = μₛ/(μᵩ·H₁)", mu_v, c.givens.mu_s.per_mm, c.givens.poles[0]),
        ("μₐ = μᵥ/(μᵩ·H₂)", mu_a, mu_v, c.givens.poles[1]),
    ):
        numbers = re.search(re.escape(symbols) + r" = ([\d.]+)/\(([\d.]+) · ([\d.]+)\) = ([\d.]+) ", said).groups()
        assert [float(each) for each in numbers] == pytest.approx(
            [above, c.givens.mu_phi.per_mm, pole, wanted], rel=2e-4
        )
    for name, step, mu in (("velocity", steps[3], mu_v), ("acceleration", steps[6], mu_a)):
        paper = number(step.caption, r"ordinate, ([\d.]+) mm")
        found = re.search(rf"maximum {name} is ([\d.]+) mm × (\S+) = (\S+) ", said).groups()
        assert [float(each) for each in found] == pytest.approx([paper, mu, paper * mu], rel=4e-4)
    for view, mu in ((steps[0].view, c.givens.mu_s.per_mm), (steps[3].view, mu_v), (steps[6].view, mu_a)):
        assert number(view.title, r"μ. = (\S+) ") == pytest.approx(mu, rel=1e-3)


# --- part by part ----------------------------------------------------------------------------------------------------


def named(by: int, kind: tuple) -> list[str]:
    """The numbers of as many slopes: of chords from 1, of tangents from 0."""
    return [f"{k + by_chords(kind)}" for k in range(by)]


def told(caption, pattern: str, nothing: str) -> float:
    """How far up a caption says that something runs or lies."""
    found = re.search(rf"(?:{pattern})(?:([\d.]+) mm (up|down)|{nothing})\.", str(caption))
    return float(found[1]) * (1 if found[2] == "up" else -1) if found[1] else 0.0


def told_height(caption) -> float:
    """The height that a caption says a ray ends at."""
    return told(caption, ": |axis, ", "at the origin")


@EVERY
@over_all("pencil", [None, TREMBLING])
def test_ray_k_is_drawn_parallel_to_chord_or_tangent_k_and_every_row_bears_that_number_and_says_its_lengths(
    kind, pencil
):
    noun = "Chord" if by_chords(kind) else "Tangent"
    for plotted, derived, (traced, rays, _), distance, _ in passes(kind, pencil):
        names = named(derived.size, kind)
        assert len(traced.parts) == len(rays.parts) == 1
        assert [str(row.name) for row in traced.parts[0].rows] == [f"{noun} {name}" for name in names]
        assert [str(row.name) for row in rays.parts[0].rows] == [f"Ray {name}" for name in names]
        for k, (trace, ray) in enumerate(zip(traced.places, rays.places, strict=True)):
            slope, line = trace.draws[0], ray.draws[0]
            across = (line.directions * slope.directions.conjugate()).imag / abs(line.directions * slope.directions)
            assert abs(across) < (MANY * SIGMA / 150 if pencil else EXACT)
            way = complex(slope.directions.item())
            assert told_height(ray.caption) == pytest.approx(
                distance * way.imag / way.real, abs=MANY * 0.5 if pencil else 0.006
            )
            assert told_height(ray.caption) == pytest.approx(ray.draws[1].place.imag, abs=0.0051)
            assert ray.draws[2].place == derived[k]
            if by_chords(kind):
                ends = ends_of_chords(kind, plotted)[k : k + 2]
                assert slope.place == ends[0]
                assert told(trace.caption, "mm across, |mm ", "level") == pytest.approx(
                    (ends[1] - ends[0]).imag, abs=0.0051
                )
                assert number(trace.caption, r": ([\d.]+) mm (?:across|level)") == pytest.approx(
                    (ends[1] - ends[0]).real, abs=0.0051
                )
            else:
                said = re.search(r"(rises|falls) at ([\d.]+)°|is level", str(trace.caption))
                lean = float(said[2]) * (1 if said[1] == "rises" else -1) if said[1] else 0.0
                assert lean == pytest.approx(math.degrees(cmath.phase(way)), abs=0.051)


@EVERY
def test_the_points_that_a_chord_joins_are_told_by_its_number(kind):
    for number_of_pass, (plotted, derived, (traced, *_), *_) in enumerate(passes(kind)):
        if not by_chords(kind):
            assert re.search(r"mirror at point (\d+),", str(traced.caption))[1] in named(derived.size, kind)
            continue
        # The points of s are counted from 0, so a chord has the number of its end; those of v from 1.
        rule = ("of the point at its end", "of the point where it begins")[number_of_pass]
        assert f"A chord has the number {rule}." in str(traced.caption)
        round_about = f"The last one runs to point {number_of_pass} of the next turn."
        assert (round_about in str(traced.caption)) == cyclic(kind) == (derived.size == plotted.size)


@EVERY
def test_the_caption_of_a_step_works_the_steepest_slope_and_says_how_many_there_are(kind):
    for *_, (traced, rays, _), _, index in passes(kind):
        heights = [abs(place.draws[1].place.imag) for place in rays.places]
        (name,) = [row.name for row in rays.parts[0].rows if row.draws[1].place.imag in (max(heights), -max(heights))][
            :1
        ]
        _, name = str(name).split()
        noun = "chord" if by_chords(kind) else "tangent"
        assert f"from {noun} {name} to P{index}: ray {name} ends" in str(rays.caption)
        assert f": point {name} of " in str(rays.caption)
        worked = rays.places[[str(row.name) for row in rays.parts[0].rows].index(f"Ray {name}")]
        assert told_height(rays.caption) == told_height(worked.caption)
        (row,) = [row for row in traced.parts[0].rows if str(row.name).endswith(f" {name}")]
        assert f"{row.name}" in str(traced.caption)
        assert f"{row.setting}." in str(traced.caption)
        for step in (traced, rays):
            assert number(step.caption, r"others, (\d+) in all") == len(step.places)


@EVERY
def test_the_parts_of_a_step_leave_all_its_own_marks(kind):
    for step in drawn(kind).steps():
        left = {(part.act, k) for each in step.places for part in each.draws for k in part.index.tolist()}
        for mark in step.own_marks:
            if mark.of is None or mark.of.kind is Kind.READ:
                continue  # a graduation
            assert {(mark.of, k) for k in mark.index.tolist()} <= left, (str(step.title), mark)


def all_of_range(text: str) -> set[str]:
    """The numbers that a label stands for: of 3-5, 9 these are 3, 4, 5 and 9."""
    found: set[str] = set()
    for run in text.split(", "):
        first, _, last = run.partition("-")
        found |= {f"{k}" for k in range(int(first), int(last or first) + 1)}
    return found


def slope_begins_above(plotted, k: int) -> bool:
    """Whether a slope begins above the axis."""
    return plotted[k].imag >= 0


@EVERY
def test_numbers_stand_at_the_ends_of_their_rays_and_at_their_points(kind):
    for plotted, derived, (traced, rays, _), distance, _ in passes(kind):
        names = named(derived.size, kind)
        at_axis = [mark for mark in rays.own_marks if isinstance(mark, Label) and abs(mark.at.real) < EXACT]
        at_points = [mark for mark in rays.own_marks if isinstance(mark, Label) and mark not in at_axis]
        assert len(at_axis) >= 3
        assert len(at_points) >= derived.size // 4
        slopes = slopes_of(kind, plotted, traced)
        # Every ray has its number, at an end that is no farther off than there is room for two numbers.
        assert sorted(name for label in at_axis for name in all_of_range(str(label.text))) == sorted(names)
        for label in at_axis:
            for name in all_of_range(str(label.text)):
                slope = slopes[names.index(name)]
                assert abs(distance * slope - label.at.imag) < RAYS_ROOM
            assert label.towards == 1
        heights = sorted(label.at.imag for label in at_axis)
        assert np.diff(heights).min() > 0
        for label in at_points:
            assert label.at == derived[names.index(str(label.text))]
            assert label.towards.imag * label.at.imag >= 0 == label.towards.real
        numbered = [mark for mark in traced.own_marks if isinstance(mark, Label)]
        for label in numbered:
            assert label.at == pytest.approx(complex(plotted[names.index(str(label.text))]), abs=EXACT)
            assert label.towards == (1j if slope_begins_above(plotted, names.index(str(label.text))) else -1j)
        spacing = np.diff([label.at.real for label in numbered])
        assert spacing.size == 0 or spacing.min() >= 0.7 * NUMBERS_ROOM  # the parts are unequal
        # A chord's number would stand beside a point's; the point of v that a tangent touches bears its own already.
        assert bool(numbered) == (not by_chords(kind) and traced.view.name == "measured displacement")


@EVERY
def test_every_step_has_a_reason_in_one_sentence(kind):
    for step in drawn(kind).steps():
        assert re.fullmatch(r"(?!Because)[A-Z][^.]+\.", str(step.why)), str(step.why)


@EVERY
def test_every_mark_but_an_axis_names_its_act(kind):
    for step in drawn(kind).steps():
        for mark in step.own_marks:
            assert isinstance(mark.of, Act) or graduates(mark), (str(step.title), mark)


@EVERY
def test_rise_and_run_are_read_on_the_chords_or_on_the_rays_parallel_to_the_tangents(kind):
    c = drawn(kind)
    (plotted, derived, *_, distance, _), _ = passes(kind)
    ways = np.diff(ends_of_chords(kind, plotted)) if by_chords(kind) else distance + 1j * derived.imag
    assert_allclose(c.readings["run"].value, ways.real * c.givens.mu_phi.per_mm, atol=EXACT)
    assert_allclose(c.readings["rise"].value, ways.imag * c.givens.mu_s.per_mm, atol=EXACT)
    assert (c.readings["run"].unit, c.readings["rise"].unit) == ("rad", c.givens.mu_s.unit)
