"""What the diagrams of acceleration, velocity and displacement show: ordinates, rays, chords, curves and scales."""

from __future__ import annotations

import math
import re
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from boards import arm_board, arm_motion, board_of, coursework, motion_of
from over_all import over_all

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction, Step
from graphcam.drafting.marks import Arrow, Dimension, Dots, Label, Line, Role, Segments
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.slips import SQUARE_LENGTH

SEVERAL = motion_of(
    (10, 40, "3-4-5"), (0, 20), (20, 80, "cosine"), (-25, 60, "2-3"), (15, 60, "cycloidal"), (-20, 100, "triangular")
)
BOARDS = {
    "built-in": coursework(),
    "other poles": coursework("cosine", poles=(35.0, 55.0), rotation="ccw", offset=10.0),
    "few parts": coursework("3-4-5", divisions=4),
    "unequal parts": coursework("rectangular", 2.5),
    "several": board_of(SEVERAL),
    "dwell first": board_of(motion_of((0, 30), (30, 80, "3-4-5"), (0, 40), (-30, 100, "cosine"))),
    "return first": board_of(motion_of((-30, 80, "3-4-5"), (0, 40), (30, 100, "cosine"))),
    "arm": arm_board(arm_motion("modified-sine")),
}
SIGMA, EXACT, MANY = 0.2, 1e-9, 6
"""A hand's deviation, what is rounding [mm], and so many deviations that no error of a fixed seed's hand is greater."""
HANDS = {"perfect": None, "hand": Pencil(line=SIGMA, dividers=SIGMA, protractor=0.009, seed=5)}
EVERY = over_all(("name", "hand"), [(name, hand) for name in BOARDS for hand in HANDS])
PASSES = over_all("index", [0, 1])


@cache
def drawn(name: str, hand: str, construction: str) -> Construction:
    return Chain(BOARDS[name], HANDS[hand] or Pencil())[construction]


@cache
def steps(name: str, hand: str, construction: str) -> list[Step]:
    return drawn(name, hand, construction).steps()


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


def slack(hand: str, errors: float) -> float:
    return EXACT if hand == "perfect" else MANY * SIGMA * errors


def moving(name: str) -> list[int]:
    """The indices of the phases in which the follower moves."""
    return [k for k, phase in enumerate(BOARDS[name].motion.phases) if phase.direction]


def starts(name: str) -> np.ndarray:
    """Where the phases start, and where the last one ends [mm, of one degree each]."""
    return np.concatenate([[0.0], np.cumsum([math.degrees(p.angle) for p in BOARDS[name].motion.phases])])


def middles(x, name: str):
    """Halfway between neighbouring stations of one phase."""
    return np.concatenate([(x[span][:-1] + x[span][1:]) / 2 for span in BOARDS[name].stations.phases])


def ordinates(step: Step) -> tuple[np.ndarray, np.ndarray]:
    """The feet and the tops of the middle ordinates."""
    segments = one(step, Segments, Role.CONSTRUCTION)
    return segments.starts, segments.ends


def stations(name: str, hand: str) -> np.ndarray:
    """The ticks of the stations on the axis."""
    (ticks,) = of(steps(name, hand, "acceleration")[3], Segments, Role.SCALE)
    np.testing.assert_allclose(ticks.ends - ticks.starts, 2j, atol=EXACT)
    return (ticks.starts + ticks.ends).real / 2


# --- acceleration ----------------------------------------------------------------------------------------------------


def check_axes(step: Step, name: str, symbol: str, heights) -> None:
    """Two arrows, their names, and thin lines where the phases end."""
    across, up = of(step, Arrow, Role.SCALE)
    low, high = min(0.0, np.min(heights)), max(0.0, np.max(heights))
    assert (across.start, across.end) == (0, pytest.approx(368))
    assert (up.start, up.end) == (pytest.approx(1j * low), pytest.approx(1j * high + 8j))
    limits = of(step, Segments, Role.CONSTRUCTION)[0]
    np.testing.assert_allclose(limits.starts, starts(name)[1:] + 1j * low)
    np.testing.assert_allclose(limits.ends, starts(name)[1:] + 1j * high)
    phi, vertical = (label for label in of(step, Label) if not label.small)
    assert (phi.at, str(phi.text), phi.towards) == (across.end, "φ, °", -1j)
    assert (vertical.at, vertical.towards) == (up.end, -1 - 1j)
    lift, per = BOARDS[name].follower.unit, {"a": "/rad²", "v": "/rad", "s": ""}[symbol]
    # An arm's angle is told in degrees.
    unit = "°" if (symbol, lift) == ("s", "rad") else f"{lift}{per}"
    assert str(vertical.text) == f"{symbol}, {unit}"


@EVERY
def test_a_revolution_is_laid_off_with_its_phases(name, hand):
    first, _, curves, _ = steps(name, hand, "acceleration")
    turn = one(first, Line, Role.RESULT).points
    assert turn[0] == 0
    assert turn[1] == pytest.approx(360, abs=slack(hand, 1))
    assert turn[1].imag == 0
    check_axes(first, name, "a", np.concatenate([line.points.imag for line in of(curves, Line)]))
    length, degree, mu = says(
        first, r"line ([\d.]+) mm long for one revolution, so 1 mm is ([\d.]+)° and μᵩ = ([\d.]+) rad"
    )
    assert (length, degree, mu) == (360, 1, pytest.approx(math.pi / 180, abs=6e-6))
    ends = re.search(r"set off (.*) mm with the ruler, where", str(first.caption)).group(1)
    assert [float(end) for end in ends.split(", ")] == pytest.approx(starts(name)[1:], abs=0.051)


def law_heights(name: str, hand: str) -> list[float]:
    """The greatest ordinates that close the displacement, from the one that is chosen."""
    phases = [BOARDS[name].motion.phases[k] for k in moving(name)]
    steep = [phase.normalised.peak_acceleration * phase.lift / phase.angle**2 for phase in phases]
    first = next(k for k, phase in enumerate(phases) if phase.direction > 0)
    return [50 * each / steep[first] for each in steep]


@EVERY
def test_the_greatest_ordinates_are_as_long_as_their_dimensions_say(name, hand):
    _, second, curves, _ = steps(name, hand, "acceleration")
    dimensions, lines = of(second, Dimension), of(curves, Line)
    told = re.search(r"of its law, here (.*\))\. ", str(second.caption)).group(1)
    chosen = says(second, r"Choose ([\d.]+) mm")
    peaks = [BOARDS[name].motion.phases[k].normalised.peak_acceleration for k in moving(name)]
    assert [float(c) for c in re.findall(r"([\d.]+) \(", told)] == pytest.approx(peaks, rel=6e-5)
    heights = law_heights(name, hand)
    first = next(n for n, k in enumerate(moving(name)) if BOARDS[name].motion.phases[k].direction > 0)
    assert chosen == [pytest.approx(abs(dimensions[first].end - dimensions[first].start), abs=0.051)]
    for d, line, height, k in zip(dimensions, lines, heights, moving(name), strict=True):
        assert d.start == d.end.real
        assert abs(d.end - d.start) == pytest.approx(height, abs=slack(hand, 1.5) + 0.02)
        assert str(d.text) == f"{abs(d.end - d.start):.1f}"
        (part,) = (part for part in second.parts if part.draws[0].index.tolist() == d.index.tolist())
        assert f" {d.text} mm" in str(part.caption)
        # It stands on the curve, whose points stand close, as high as any of it, and its line clear to the right of it.
        assert np.abs(line.points - d.end).min() < 0.02
        assert np.abs(line.points.imag).max() == pytest.approx(abs(d.end.imag), rel=1e-3)
        right = d.start + d.aside * (1j if d.end.imag > 0 else -1j) * 1j
        assert d.start.real < right.real <= starts(name)[k + 1]
        beside = line.points[(line.points.real > right.real) & (line.points.imag * d.end.imag > 0)]
        assert beside.size == 0


@EVERY
def test_each_law_runs_from_the_axis_to_the_axis_over_its_phase(name, hand):
    step = steps(name, hand, "acceleration")[2]
    lines = of(step, Line, Role.RESULT)
    said = str(step.caption)
    for line, k, height in zip(lines, moving(name), law_heights(name, hand), strict=True):
        phase, (begin, end) = BOARDS[name].motion.phases[k], starts(name)[k : k + 2]
        u = (line.points.real - begin) / (end - begin)
        assert (line.points[0].imag, line.points[-1].imag) == (0, 0)
        np.testing.assert_allclose(line.points[[0, -1]].real, [begin, end], atol=slack(hand, 1.5))
        if hand == "perfect":
            inner = slice(1, -1)
            # At a jump the line stands upright, from one side's ordinate to the other's.
            sides = [
                phase.direction * height * phase.normalised(np.clip(u[inner] + by, 0, 1))[2]
                for by in (-1e-9, 0.0, 1e-9)
            ]
            off = np.abs(line.points.imag[inner] - np.array(sides) / phase.normalised.peak_acceleration)
            assert off.min(axis=0).max() < 1e-5
        # The area under a law is none: the follower is at rest before and after.
        area = np.trapezoid(line.points.imag, line.points.real)
        assert abs(area) < 0.002 * np.trapezoid(np.abs(line.points.imag), line.points.real)
    said = said.partition(". ")[0]
    assert [len(re.findall(kind, said)) for kind in ("rise φ", "return φ")] == [
        sum(BOARDS[name].motion.phases[k].direction == way for k in moving(name)) for way in (1, -1)
    ]


@EVERY
def test_the_middle_ordinates_stand_halfway_between_stations_and_reach_the_law(name, hand):
    _, _, curves, step = steps(name, hand, "acceleration")
    feet, tops = ordinates(step)
    phi = np.degrees(BOARDS[name].stations.phi)
    x = stations(name, hand)
    np.testing.assert_allclose(x, phi, atol=slack(hand, 2))
    np.testing.assert_allclose(feet, middles(x, name), atol=slack(hand, 1))
    np.testing.assert_array_equal(feet.imag, 0)
    np.testing.assert_allclose(tops.real, feet.real, atol=EXACT)
    np.testing.assert_array_equal(one(step, Dots).points, tops)
    for line, span in zip(of(curves, Line), BOARDS[name].stations.parts, strict=True):
        on_the_law = np.interp(feet.real[span], line.points.real, line.points.imag)
        np.testing.assert_allclose(tops.imag[span], on_the_law, atol=0.05 + (hand != "perfect") * 8)
    # How high they are, and into how many parts each phase is divided, is told phase by phase: see the parts.
    assert "each part has the number of the cut at its end" in str(step.caption)


def names_of(name: str) -> list[str]:
    spans = BOARDS[name].stations.phases
    return [f"{k}" + "′" * n for n, span in enumerate(spans) for k in range(span.stop - span.start)]


@EVERY
def test_the_stations_are_named_at_their_places_where_no_ordinates_stand(name, hand):
    x, step = stations(name, hand), steps(name, hand, "acceleration")[3]
    read = drawn(name, hand, "acceleration").readings
    mean = read["before"].paper + read["stations"].paper
    given = [label for label in steps(name, hand, "integration")[4].given if isinstance(label, Label) and label.small]
    named = [label for label in given if label.of]
    for label in of(step, Label):
        k = names_of(name).index(label.text)
        assert label.at == x[k]
        assert label.towards == (1j if mean[k] < 0 else -1j)
    for label in named:
        assert label.at == x[names_of(name).index(label.text)]
        assert label.towards == -1j
    ends = {names_of(name)[k] for span in BOARDS[name].stations.phases for k in (span.start, span.stop - 1)}
    assert ends <= {label.text for label in of(step, Label)} == {label.text for label in named}


# --- the two integrations --------------------------------------------------------------------------------------------


class Pass:
    """One integration: the middle ordinates that it starts from, its rays, chords and curve."""

    def __init__(self, name: str, hand: str, index: int):
        found = steps(name, hand, "integration")
        self.rays, self.chords, self.curves = found[3 * index : 3 * index + 3]
        self.pole = BOARDS[name].poles[index]
        self.x = stations(name, hand)
        spans = BOARDS[name].stations.phases
        if index:
            # Of v: halfway along the chords of its curve.
            ends = curve_points(found[1])
            self.middles = np.concatenate([(ends[s][:-1] + ends[s][1:]) / 2 for s in spans])
        else:
            self.middles = ordinates(steps(name, hand, "acceleration")[3])[1]
        self.levels, self.joined = of(self.rays, Segments, Role.CONSTRUCTION)
        self.dot = complex(of(self.rays, Dots, Role.CURVE)[0].points[0])
        self.polygons = [line.points for line in of(self.chords, Line, Role.CONSTRUCTION)]
        self.points = curve_points(self.chords)


def curve_points(step: Step) -> np.ndarray:
    """The tops of the ordinates beside the chords: what the curve goes through."""
    return of(step, Segments, Role.CONSTRUCTION)[-1].ends


@cache
def integration(name: str, hand: str, index: int) -> Pass:
    return Pass(name, hand, index)


@PASSES
@EVERY
def test_the_pole_stands_at_its_distance_on_the_axis(name, hand, index):
    run, sub = integration(name, hand, index), "₁₂"[index]
    axis, dot = one(run.rays, Line, Role.SCALE).points, run.dot
    assert dot == pytest.approx(-run.pole, abs=slack(hand, 1))
    np.testing.assert_array_equal(axis, [dot, 0])
    label, size = of(run.rays, Label)[0], one(run.rays, Dimension)
    assert (label.at, str(label.text), label.towards) == (dot, f"P{sub}", -1 + 1j)
    assert (size.start, size.end) == (dot, 0)
    assert str(size.text) == f"H{sub} = {run.pole:g}"
    assert size.aside == pytest.approx(-5 + min(0, run.levels.starts.imag.min()))
    assert says(run.rays, r"= ([\d.]+) mm to the left") == [run.pole]
    assert f"Mark the pole P{sub} on the axis, H{sub} = " in str(run.rays.caption)


@PASSES
@EVERY
def test_projections_are_level_and_every_ray_joins_the_pole_to_one(name, hand, index):
    run = integration(name, hand, index)
    np.testing.assert_array_equal(run.levels.starts.real, 0)
    np.testing.assert_array_equal(run.levels.starts.imag, run.levels.ends.imag)
    np.testing.assert_array_equal(run.joined.ends, run.levels.starts)
    np.testing.assert_array_equal(run.joined.starts, run.dot)
    # From every middle ordinate comes one, and each reaches the farthest that is as high.
    height = run.levels.starts.imag
    off = np.abs(run.middles.imag[:, None] - height)
    assert off.min(axis=1).max() <= 0.002 + slack(hand, 1)
    assert off.min(axis=0).max() <= 0.002 + slack(hand, 1)
    for y, reach in zip(height, run.levels.ends.real, strict=True):
        ends = run.middles[np.abs(run.middles.imag - y) <= 0.002 + slack(hand, 1)]
        assert np.abs(ends.real - reach).min() < slack(hand, 2) + 1e-6
        assert hand != "perfect" or reach == pytest.approx(ends.real.max())


@PASSES
@EVERY
def test_chords_are_parallel_to_their_rays_and_set_end_to_end(name, hand, index):
    run = integration(name, hand, index)
    k = 0
    for span, polygon in zip(BOARDS[name].stations.phases, run.polygons, strict=True):
        # The chords end on the uprights, which stand beside the marks of the axis.
        np.testing.assert_allclose(polygon.real, run.x[span], atol=slack(hand, 1))
        slopes = np.diff(polygon.imag) / np.diff(polygon.real)
        rays = run.middles.imag[k : k + slopes.size] / run.pole
        # Of a hand: the height, the pole, the chord's own place and turn.
        widths = np.diff(polygon.real)
        errors = MANY * SIGMA * (1 / run.pole + np.abs(rays) / run.pole + 1 / widths + (1 + rays**2) / SQUARE_LENGTH)
        assert np.all(np.abs(slopes - rays) <= (1e-9 if hand == "perfect" else errors))
        k += slopes.size
    assert k == run.middles.size


@PASSES
@EVERY
def test_the_curve_comes_back_to_rest_by_turning_its_base_line_or_sharing_out(name, hand, index):
    run, spans = integration(name, hand, index), BOARDS[name].stations.phases
    marked = of(run.chords, Segments, Role.CONSTRUCTION)[-1]
    np.testing.assert_array_equal(marked.starts, marked.ends.real)
    np.testing.assert_allclose(marked.ends.real, run.x, atol=EXACT)
    lefts = []
    for span, polygon in zip(spans, run.polygons, strict=True):
        off = polygon - run.points[span]
        # What is taken up grows evenly along the phase.
        share = (run.x[span] - run.x[span][0]) / (run.x[span][-1] - run.x[span][0])
        even = off[0] + (off[-1] - off[0]) * share
        np.testing.assert_allclose(off.imag, even.imag, atol=slack(hand, 2.5))
        np.testing.assert_allclose(off.real, 0, atol=slack(hand, 1))
        lefts.append(abs(off[-1].imag) if index == 0 else off[-1].imag)
        if index == 0:
            assert abs(run.points[span][-1].imag) <= slack(hand, 1)
            assert polygon[0].imag == 0
    if index:
        for one_end, next_start in pairwise(spans):
            end, start = run.points[one_end.stop - 1].imag, run.points[next_start.start].imag
            assert end == pytest.approx(start, abs=slack(hand, 2))
        assert run.points[-1].imag == pytest.approx(run.points[0].imag, abs=slack(hand, 2))
        assert run.points.imag.min() == pytest.approx(0, abs=slack(hand, 2))
        assert all(a[-1].imag == pytest.approx(b[0].imag, abs=EXACT) for a, b in pairwise(run.polygons))
    left = max(lefts) if index == 0 else abs((run.polygons[-1][-1] - run.polygons[0][0]).imag)
    read = drawn(name, hand, "integration").readings[("closing_v", "closing_s")[index]].paper
    if np.abs(read).max() > 0.005:
        assert says(run.chords, r"([\d.]+) mm(?: at most)?, is") == [pytest.approx(np.abs(read).max(), abs=0.0051)]
    else:
        assert "left" not in str(run.chords.caption)
    assert np.abs(read).max() == pytest.approx(left, abs=slack(hand, 1.5))


@PASSES
@EVERY
def test_the_curve_is_faired_from_jump_to_jump_and_level_in_the_dwells(name, hand, index):
    run, board = integration(name, hand, index), BOARDS[name]
    check_axes(run.chords, name, "vs"[index], run.points.imag)
    lines = of(run.curves, Line, Role.RESULT)
    faired, rests = lines[: len(board.stations.pieces)], lines[len(board.stations.pieces) :]
    for piece, curve in zip(board.stations.pieces, faired, strict=True):
        through = curve.points[::8] if curve.points.size > run.points[piece].size else curve.points
        np.testing.assert_allclose(through, run.points[piece], atol=EXACT)
    places = [1j * run.points[-1].imag, *(run.points[k] for s in board.stations.phases for k in (s.start, s.stop - 1))]
    places.append(360 + 1j * run.points[-1].imag)
    # Where one phase follows on another there is no dwell between them.
    bounds = [0, *(x for k in moving(name) for x in starts(name)[k : k + 2]), 360]
    pairs = [places[k : k + 2] for k in range(0, len(places), 2) if bounds[k + 1] - bounds[k] > EXACT]
    np.testing.assert_allclose([rest.points for rest in rests], pairs, atol=EXACT)


@EVERY
def test_the_known_lift_fixes_the_scales(name, hand):
    step, *through = steps(name, hand, "integration")[6:]
    run, board = integration(name, hand, 1), BOARDS[name]
    size, lift = one(step, Dimension), board.motion.lift
    top = run.points[np.argmax(run.points.imag)]
    assert size.start == size.end.real
    assert size.end.imag == pytest.approx(top.imag, abs=slack(hand, 2))
    assert np.abs(run.points - size.end).min() < EXACT
    assert str(size.text) == f"{size.end.imag:.1f}"
    assert size.aside == -6
    paper, known, mu_s = says(step, r"measures ([\d.]+) mm .* lift of ([\d.e-]+) \w+, so μₛ = .* mm = ([\d.e-]+) ")
    (mu_v,), (mu_a,) = (says(each, r"\) = ([\d.e-]+) ") for each in through)
    assert paper == pytest.approx(size.end.imag, abs=0.0051)
    assert known == pytest.approx(lift, rel=1e-5)
    expected = lift / size.end.imag
    h1, h2 = board.poles
    for mu in (mu_s, mu_v, mu_a):
        assert mu == pytest.approx(expected, rel=1e-4)
        expected *= {mu_s: 180 / math.pi / h2, mu_v: 180 / math.pi / h1}.get(mu, 1)
    rises = [k for k in moving(name) if board.motion.phases[k].direction > 0]
    assert any(size.end.real == pytest.approx(starts(name)[k + 1], abs=slack(hand, 2)) for k in rises)


def test_what_is_carried_on_with_a_t_square_is_not_rounded_to_the_division_of_a_rule():
    """The ordinates and the closing errors go on as they stand; s and v are read off a rule."""
    chain = Chain(coursework("3-4-5"), Pencil(division=0.5))
    exact = Chain(coursework("3-4-5"))
    for name in ("greatest", "stations", "before", "middles", "base"):
        read, drawn = (each["acceleration"].readings[name].paper for each in (chain, exact))
        np.testing.assert_allclose(read, drawn, rtol=1e-14)
    for name in ("s", "v"):
        halves = 2 * chain["integration"].readings[name].paper
        np.testing.assert_allclose(halves, np.round(halves), atol=1e-12)
        assert np.abs(halves / 2 - exact["integration"].readings[name].paper).max() > 0.05
