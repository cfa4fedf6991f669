"""What the inversion, the three points, the roller and the working profile show, mark by mark."""

from __future__ import annotations

import cmath
import math
import re
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from boards import arm_board, arm_motion_of, board_of, coursework, motion_of
from numpy.testing import assert_allclose
from over_all import over_all

from graphcam.constructions.chain import Chain
from graphcam.drafting.acts import Kind
from graphcam.drafting.curve import faired_line
from graphcam.drafting.ink import Construction, Step
from graphcam.drafting.marks import AngleMark, Arc, Circle, Dimension, Dots, Label, Line, Role, Segments
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import GOST_2_302, Paper
from graphcam.given.roller_rule import roller_rule

BOARDS = {
    "cw, to the left": coursework("3-4-5"),
    "ccw, to the right": coursework("cosine", offset=12.0, rotation="ccw"),
    "central": coursework("3-4-5", offset=0.0),
    "undercut": board_of(
        motion_of((10, 60, "cycloidal"), (0, 30), (-10, 60, "cycloidal")),
        rotation="ccw", offset=5.0, prime_radius=30.0, roller_radius=20.0, divisions=24,
    ),
}  # fmt: skip
HAND = Pencil(line=0.02, dividers=0.02, protractor=math.radians(0.01), seed=3)
every = over_all(("name", "hand"), [*((name, None) for name in BOARDS), ("ccw, to the right", HAND)])


@cache
def chain_of(name: str, hand: Pencil | None) -> Chain:
    return Chain(BOARDS[name], hand or Pencil())


@cache
def steps(name: str, hand: Pencil | None, construction: str) -> list[Step]:
    return chain_of(name, hand)[construction].steps()


def close(hand: Pencil | None, factor: float = 1.0) -> float:
    """How far from true a theorem may be: rounding, or some errors of the hand."""
    return 6 * 0.02 * factor if hand else 1e-8


def only(step: Step, kind: type, role: Role | None = None):
    """The marks of a kind, and of a role."""
    return [mark for mark in step.marks if isinstance(mark, kind) and role in (None, getattr(mark, "role", None))]


def numbers(step: Step) -> list[float]:
    return [float(number) for number in re.findall(r"\d+(?:\.\d+)?", str(step.caption))]


def sigma(chain: Chain) -> int:
    return 1 if chain.board.rotation == "ccw" else -1


def dot(a: complex, b: complex) -> float:
    return (a * b.conjugate()).real


# --- the inversion ---------------------------------------------------------------------------------------------------


@every
def test_the_circles_have_the_adopted_radii_and_that_of_the_prime_circle_is_dimensioned_from_its_centre(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[0]
    mu = chain.profile_scale.per_mm
    sizes = [chain.prime_radius, *([abs(chain.place)] if chain.place else [])]
    circles = only(step, Circle)
    assert [circle.radius * mu for circle in circles] == pytest.approx(sizes, abs=close(hand, mu))
    _, centre = only(step, Label)
    assert (str(centre.text), centre.at) == ("A", 0)
    (radius,) = (mark for mark in only(step, Dimension) if mark.of_radius)
    assert str(radius.text) == f"r₀ = R{chain.prime_radius:g}"
    assert all(abs(circle.centre) < close(hand) for circle in circles)
    assert abs(radius.start - circles[0].centre) < 1e-9
    assert abs(radius.end - radius.start) == pytest.approx(circles[0].radius, abs=1e-9)
    ratio = f"{1 / mu:g}:1" if mu < 1 else f"1:{mu:g}"
    drawn = "the prime circle about the cam centre A", "the offset circle about A"
    for size, symbol, circle, part in zip(sizes, ("r₀", "|e|"), drawn, step.parts, strict=False):
        said = f"Set the compass to {size / mu:.1f} mm ({symbol} = {size:g} mm at {ratio}) and draw {circle}."
        assert str(part.caption) == said
    assert (f"With e = {chain.place:g} mm" in str(step.caption)) == (len(sizes) == 2) == bool(chain.place)
    assert len(step.parts) == len(sizes) + 1


@every
def test_the_offset_is_the_distance_of_the_upright_axes(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[0]
    lengths = [length for length in only(step, Dimension) if not length.of_radius]
    uprights = [line.points for line in only(step, Line, Role.AXIS) if not np.ptp(line.points.real)]
    assert len(lengths) == bool(chain.place)
    for length in lengths:
        assert str(length.text) == f"e = {abs(chain.place):g}"
        ends = sorted((length.start.real, length.end.real))
        assert ends == pytest.approx(sorted(points[0].real for points in uprights))
        for points in uprights:
            assert points.imag.min() < length.start.imag == length.end.imag < points.imag.max()


@every
def test_line_0_stands_upright_on_the_side_of_the_offset_and_ends_on_the_prime_circle(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[0]
    line, mu = only(step, Line, Role.CURVE)[0], chain.profile_scale.per_mm
    e, r0 = chain.place / mu, chain.prime_radius / mu
    assert line.points == pytest.approx([complex(e), complex(e, math.sqrt(r0**2 - e**2))], abs=close(hand, 3))
    said = str(step.parts[-1].caption)
    assert said.endswith(": line 0.")
    side = "from A " if e == 0 else "from the left end" if e < 0 else "from the right end"
    assert side in said


@every
def test_the_arrow_of_the_rotation_points_as_the_cam_turns(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[0]
    (arc,), omega = only(step, Arc), only(step, Label)[0]
    head, tail = (arc.end, arc.start) if arc.arrow == "end" else (arc.start, arc.end)
    assert math.remainder(head - tail, math.tau) == pytest.approx(sigma(chain) * 0.9)
    assert tail == pytest.approx(-math.pi / 2)
    assert abs(arc.centre) == 0
    assert arc.radius == pytest.approx(0.6 * chain.prime_radius / chain.profile_scale.per_mm)
    assert str(omega.text) == "ω"
    assert cmath.phase(omega.at / cmath.rect(1, (head + tail) / 2)) == pytest.approx(0)
    assert dot(omega.towards, complex(sigma(chain), -1)) > 0


@every
def test_the_followers_line_touches_the_circle_e_and_goes_round_against_the_rotation(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[1]
    (lines,) = only(step, Segments, Role.CONSTRUCTION)
    e = chain.place / chain.profile_scale.per_mm
    for foot, end, phi in zip(lines.starts, lines.ends, chain.board.stations.phi, strict=True):
        turn = cmath.rect(1, -sigma(chain) * phi)
        assert abs(foot - e * turn) < close(hand, 3)
        assert abs((end - foot) / abs(end - foot) - 1j * turn) < close(hand, 0.05)
        assert abs(end) * chain.profile_scale.per_mm == pytest.approx(chain.prime_radius, abs=close(hand, 3))


def names_of(chain: Chain) -> list[str]:
    """0, 1 ... in the first moving phase, with a prime for each one before in the others."""
    return [f"{k}" + "′" * p for p, s in enumerate(chain.board.stations.phases) for k in range(s.stop - s.start)]


@every
def test_every_position_says_its_angle_the_sense_against_the_rotation_and_where_it_is_counted_from(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[1]
    against = "clockwise" if sigma(chain) > 0 else "anticlockwise"
    origin = "line 0" if not chain.place else f"the {'left' if chain.place < 0 else 'right'} end of the offset circle"
    angles = [f"{round(math.degrees(phi), 2):g}°" for phi in chain.board.stations.phi]
    (turned,), (phases,) = step.parts, steps(name, hand, "working_profile")[-1].parts
    for k, (row, at, angle) in enumerate(zip(turned.rows, names_of(chain), angles, strict=True)):
        assert str(row.caption) == f"Station {at}: {angle}."
        rays, *_, motion = row.draws
        assert (rays.act.name, motion.act.name) == ("inverted positions", "motion")
        assert all(drawn.index.tolist() == [k] for drawn in row.draws)
    said = str(turned.caption)
    assert f"other way, {against}" in said
    assert f"count {against} from {origin}, from station to station" in said
    assert f"so station 4 at {angles[4]};" in said
    assert ("draw the tangent" in said, "number the rays" in said) == (bool(chain.place), not chain.place)
    spans = chain.board.stations.phases
    for span, number in zip(spans, "₁₃", strict=True):
        part = round(math.degrees(chain.board.stations.phi[span.start + 1] - chain.board.stations.phi[span.start]), 2)
        assert f"{part:g}° in φ{number}" in str(step.caption)
    listed = ", ".join(f"{math.degrees(phase.angle):.6g}°" for phase in chain.board.motion.phases)
    assert listed in str(phases.caption)
    assert against in str(phases.caption)


@every
def test_the_lines_are_numbered_where_they_start_or_on_the_prime_circle(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[1]
    (lines,), labels = only(step, Segments, Role.CONSTRUCTION), only(step, Label)
    on_offset_circle = abs(chain.place) / chain.profile_scale.per_mm >= 12
    places = lines.starts if on_offset_circle else lines.ends
    assert {"0", "12" if name != "undercut" else "24"} <= {str(label.text) for label in labels}
    for label in labels:
        at = places[names_of(chain).index(str(label.text))]
        assert abs(label.at - at) < close(hand)
        assert label.towards == pytest.approx(-label.at / abs(label.at))


@every
def test_the_displacement_lies_between_the_prime_circle_and_the_end(name, hand):
    chain = chain_of(name, hand)
    _, positions, ends, _ = steps(name, hand, "inversion")
    (lines,), (dots,) = only(positions, Segments, Role.CONSTRUCTION), only(ends, Dots)
    (laid_off,), integrated = only(ends, Segments), chain["integration"]
    r0, mu, drawn = chain.prime_radius, chain.profile_scale.per_mm, dict[int, complex]()
    for k, start, end in zip(laid_off.index, laid_off.starts, laid_off.ends, strict=True):
        assert (start, end) == (lines.ends[k], dots.points[k])
        drawn[int(k)] = end
    mu_s = float(integrated.readings["s"].scale)
    for k, (foot, end, part) in enumerate(zip(lines.starts, dots.points, ends.places, strict=True)):
        s, paper, at = float(integrated.value("s")[k]), float(integrated.readings["s"].paper[k]), names_of(chain)[k]
        start = math.sqrt((r0 / mu) ** 2 - abs(foot) ** 2)
        assert abs(end - foot) == pytest.approx(start + s / mu, abs=close(hand, 3))
        assert (k in drawn) == (abs(s / mu) >= 0.005)
        assert [each.index.tolist() for each in part.draws] == [[k]]
        factor = "" if math.isclose(mu_s, mu) else f"{abs(paper):.2f} mm × {mu_s / mu:.5g} = "
        said = f"{factor}{abs(s) / mu:.2f} mm" + ("." if s > 0 else " inward.")
        expected = said if k in drawn else "s is zero, so the point lies on the prime circle."
        assert str(part.caption) == f"Station {at}: {expected}"
    assert f"{mu_s:.5g} mm × {1 / mu:g} = {mu_s / mu:.5g} mm here" in str(ends.caption)
    s, paper = integrated.value("s")[4], integrated.readings["s"].paper[4]
    assert f"from the prime circle outward: station 4: {paper:.2f} mm × {mu_s / mu:.5g} = {s / mu:.2f} mm." in str(
        ends.caption
    )


@every
def test_the_phase_angles_follow_one_another_from_the_start_against_the_rotation(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "working_profile")[-1]
    marks, (rays,) = only(step, AngleMark), only(step, Segments, Role.AXIS)
    pitch = only(steps(name, hand, "inversion")[2], Dots)[0].points
    e = chain.place / chain.prime_radius
    begin = math.atan2(math.sqrt(1 - e * e), e)
    total, roller = 0.0, chain.roller_radius / chain.profile_scale.per_mm
    for k, (mark, phase) in enumerate(zip(marks, chain.board.motion.phases, strict=True)):
        low, high = mark.start, mark.end
        assert high - low == pytest.approx(phase.angle)
        from_ = low if sigma(chain) < 0 else high
        off = math.remainder(from_ - begin + sigma(chain) * total, math.tau)
        assert off == pytest.approx(0, abs=close(hand, 0.1))
        assert str(mark.text).endswith(f"= {math.degrees(phase.angle):.6g}°")
        assert abs(mark.centre) == abs(rays.starts[k]) == 0
        # The arc lies outside the pitch points and the roller's circles between its ends, and no farther than need be;
        # nor beyond the sheet's room, where that lies 9 mm outside the pitch curve.
        turned = pitch * cmath.exp(-0.5j * (low + high))
        inside = np.abs(np.angle(turned)) <= phase.angle / 2 + 1e-6
        room = max(np.abs(pitch).max() + 9, min(chain.board.paper.width, chain.board.paper.height) / 2 - 13)
        assert mark.radius >= min(np.abs(pitch[inside]).max(initial=0) + roller + 2, room) - 0.01
        assert mark.radius <= np.abs(pitch).max() + roller + 2.01
        beside = marks[k - 1].radius
        assert abs(rays.ends[k] - cmath.rect(max(mark.radius, beside) + 2, from_)) < 1e-9
        total += phase.angle
    assert total == pytest.approx(math.tau)


@every
def test_stations_are_named_outside_their_points(name, hand):
    step = steps(name, hand, "inversion")[2]
    (dots,) = only(step, Dots)
    names = [
        f"{k}" + "′" * p
        for p, s in enumerate(chain_of(name, hand).board.stations.phases)
        for k in range(s.stop - s.start)
    ]
    labels = only(step, Label)
    assert len(labels) > 2
    for label in labels:
        at = dots.points[names.index(str(label.text))]
        assert label.at == at
        assert label.towards == pytest.approx(at / abs(at))


def of_curve(name: str, hand: Pencil | None, points: np.ndarray, line: np.ndarray) -> None:
    """The curve goes through every point, and rests on arcs about the cam centre in the dwells."""
    chain = chain_of(name, hand)
    for point in points[~np.isnan(points)]:
        assert np.abs(line - point).min() < 1e-8
    motion, sense = chain.board.motion, sigma(chain)
    for k, span in enumerate(chain.board.stations.phases):
        at = points[span.stop - 1]
        following = int(chain.board.stations.phase[span.start]) + 1
        if following < len(motion.phases) and motion.phases[following].kind == "dwell" and not np.isnan(at):
            for share in (0.0, 1.0):
                there = at * cmath.rect(1, -sense * motion.phases[following].angle * share)
                assert np.abs(line - there).min() < 1e-8, k
            within = np.angle(line / at) * -sense
            edge = 0.01 if hand else 1e-6  # there a hand may begin the next phase
            resting = line[(within > edge) & (within < motion.phases[following].angle - edge)]
            assert np.abs(resting) == pytest.approx(np.full(resting.size, abs(at)))
            assert resting.size > 5


@every
def test_the_pitch_curve_is_closed_goes_through_its_points_and_rests_on_arcs(name, hand):
    _, _, ends, curve = steps(name, hand, "inversion")
    (line,) = only(curve, Line)
    assert line.closed
    of_curve(name, hand, only(ends, Dots)[0].points, line.points)
    by_pieces(chain_of(name, hand), curve, line)


def by_pieces(chain: Chain, step: Step, line: Line) -> None:
    """The pieces make the whole curve, in order; of an arc the compass is set to how far it runs from the centre."""
    pieces = step.parts[-1].rows
    drawn, arcs = [row.draws[0].shown for row in pieces], 0
    np.testing.assert_array_equal(np.concatenate(drawn), line.points)
    for row, points in zip(pieces, drawn, strict=True):
        said = str(row.caption)
        if arc := re.fullmatch(r"In the dwell φ.: compass ([\d.]+) mm, an arc of .*° about A\.", said):
            arcs += 1
            assert np.abs(points) == pytest.approx(np.full(points.size, float(arc[1])), abs=0.051)
        else:
            start, end = re.match(r"From (\d+′*) to (\d+′*), .* φ.: with the French curve\.", said).groups()
            assert names_of(chain).index(start) < names_of(chain).index(end)
    assert arcs == sum(phase.kind == "dwell" for phase in chain.board.motion.phases)
    assert ("In the dwells swing arcs about A with the compass." in str(step.caption)) == bool(arcs)


# --- three points ----------------------------------------------------------------------------------------------------


def centre_of(a: complex, b: complex, c: complex) -> complex:
    """Of the circle through three points, by the equations of equal distances."""
    rows = [[2 * (q - p).real, 2 * (q - p).imag] for p, q in ((a, b), (b, c))]
    return complex(*np.linalg.solve(rows, [abs(q) ** 2 - abs(p) ** 2 for p, q in ((a, b), (b, c))]))


@every
def test_three_points_of_the_pitch_curve_are_shown_enlarged_about_b(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "curvature")[0]
    (chords,), (dots,) = only(step, Segments), only(step, Dots)
    curved, points = chain["curvature"], dots.points
    assert abs(points[1]) == 0
    np.testing.assert_array_equal(chords.starts, points[:2])
    np.testing.assert_array_equal(chords.ends, points[1:])
    on_paper, of_machine = (float(part) for part in re.search(r"([\d.]+):([\d.]+)\.", str(step.caption)).groups())
    times = on_paper / of_machine * chain.profile_scale.per_mm
    b = curved.points["triple"][1]
    assert curved.value("rho_candidates")[0] == curved.value("rho")  # not in a rest
    enlarged = f"enlarged to {times:g} times its size, at " if times > 1 else f"reduced to 1/{1 / times:g}, at "
    assert ("at the same scale, " if times == 1 else enlarged) in str(step.caption)
    assert_allclose(points / times + b, curved.points["triple"], atol=1e-9)
    first, second = (abs(q - p) for p, q in pairwise(points))
    assert f"{first:.2f} mm and {second:.2f} mm" in str(step.parts[1].caption)
    assert f"φ = {math.degrees(float(curved.first('phi')) % math.tau):.1f}°" in str(step.caption)
    hub = only(steps(name, hand, "curvature")[1], Dots)[0].points[0]
    for label, at in zip(only(step, Label), points, strict=True):
        assert label.at == at
        assert dot(label.towards, hub) < 0
    assert [str(label.text) for label in only(step, Label)] == ["P", "B", "Q"]
    assert "Copy P, B and Q with dividers" in str(step.caption)


@every
def test_the_three_points_lie_on_the_drawn_curve_or_on_its_image_beyond_an_end(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "curvature")[0]
    inverted, curved, caption = chain["inversion"], chain["curvature"], str(step.caption)
    pitch, stations = inverted.first("pitch"), inverted.givens.integrated.givens.stations
    p, b, q = curved.points["triple"]
    lines = [faired_line(pitch[piece]) for piece in stations.pieces if piece.stop - piece.start > 2]
    place = min(((line, int(np.argmin(np.abs(line - b)))) for line in lines), key=lambda each: abs(each[0] - b).min())
    line, at = place
    near = 0.02  # next to an end the image lies beside the curve that is faired here, in place of a point on a parabola
    assert abs(line[at] - b) < near
    apart = round(8 * float(re.search(r"step off ([\d.]+) parts before and after", caption)[1]))
    # Where the curve ends, the images of the points before are in the ray from A.
    for end, k, found in ((0, at - apart, p), (line.size - 1, at + apart, q)):
        inside, ray = line[abs(end - abs(end - k))], line[end] / abs(line[end])
        image = inside.conjugate() * ray**2
        assert abs((inside if 0 <= k < line.size else image) - found) < near
    assert ("its mirror image in this ray" in caption) == (at < apart or at + apart >= line.size)


@every
def test_what_short_chords_may_miss_is_reckoned_and_what_those_for_a_pencil_read(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "curvature")[0]
    caption, before = str(steps(name, hand, "curvature")[3].caption), str(step.caption)
    mu, rho, (p, b, q) = (
        chain.profile_scale.per_mm,
        float(chain["curvature"].value("rho")),
        chain["curvature"].points["triple"],
    )
    first, second = abs(b - p), abs(q - b)
    chord = (first + second) / 2
    missed = 4 * 0.15 * rho / mu / chord**2
    by = f"{100 * missed:.0f} %" if missed < 1 else "more than ρ itself"
    assert f"by {by}: 4 × 0.15 mm × ρ/h², with h = ({first:.2f} + {second:.2f})/2 = {chord:.1f} mm" in caption
    assert f"and ρ = {rho / mu:.1f} mm" in caption
    wide = re.search(r"step off ([\d.]+) parts instead: with chords of ([\d.]+) mm .* ρ = ([\d.]+) mm instead", caption)
    parts = float(re.search(r"step off ([\d.]+) parts before and after", before)[1])
    assert float(wide[1]) > parts
    assert float(wide[2]) > chord
    assert float(wide[3]) == pytest.approx(rho, rel=0.4)


def test_chords_that_a_hand_cannot_tell_from_a_line_are_said_to_be_so():
    drawn = Chain(coursework("3-4-5", divisions=96))["curvature"]
    caption = str(drawn.steps()[-1].caption)
    assert "ρ may be off by more than ρ itself" in caption
    assert "For drawing by hand step off 14.375 parts instead: with chords of 11.7 mm ρ may be off by 11 %" in caption


def test_a_radius_too_small_on_paper_is_said_to_be_so_and_a_larger_view_can_tell_it():
    """The cam is sharp enough for 12 mm, which at 1:2 is 6 mm of paper."""
    board = arm_board(arm_motion_of((12, 100, "cosine"), (0, 20), (-12, 70, "4-5-6-7")), 160.0, 150.0)
    small, large = Chain(board), Chain(replace(board, paper=Paper(900.0, 900.0, GOST_2_302)))
    said = [str(chain["curvature"].steps()[-1].caption) for chain in (small, large)]
    assert ["cannot be told by three points" in caption for caption in said] == [True, False]


@every
def test_the_bisectors_are_square_to_the_chords_go_through_their_middles_and_meet_in_o(name, hand):
    chords, bisectors, *_ = steps(name, hand, "curvature")
    (dots,), lines = only(chords, Dots), only(bisectors, Line)
    (hub,), (label,) = only(bisectors, Dots)[0].points, only(bisectors, Label)
    assert (str(label.text), label.at) == ("O", hub)
    assert dot(label.towards, hub) > 0
    for (a, b), line in zip(pairwise(dots.points), lines, strict=True):
        way, middle = line.points[1] - line.points[0], (a + b) / 2
        assert abs(dot(way / abs(way), (b - a) / abs(b - a))) < close(hand, 0.1)
        for place in (middle, hub):  # both lie on it, and it runs on a little beyond them
            t = (place - line.points[0]) / way
            assert abs(t.imag) * abs(way) < close(hand, 3)
            assert 0 < t.real < 1
        assert line.points[0] == pytest.approx(middle - 0.12 * (hub - middle), abs=close(hand, 3))
        assert line.points[1] == pytest.approx(hub + 0.06 * (hub - middle), abs=close(hand, 3))


@every
def test_the_compass_was_set_to_one_radius_at_both_ends_of_a_chord(name, hand):
    chords, bisectors, *_ = steps(name, hand, "curvature")
    (dots,), arcs = only(chords, Dots), only(bisectors, Arc)
    assert len(arcs) == 8
    settings = [0.8 * abs(b - a) for a, b in pairwise(dots.points)]
    assert f"to {settings[0]:.1f} mm (0.8 of the first chord)" in str(bisectors.parts[0].caption)
    assert f"with {settings[1]:.1f} mm on the second" in str(bisectors.parts[1].caption)
    for k, (a, b) in enumerate(pairwise(dots.points)):
        four = arcs[4 * k : 4 * k + 4]
        assert [arc.centre for arc in four] == [a, b, a, b]
        for arc in four:
            assert arc.radius == pytest.approx(0.8 * abs(b - a))
            assert arc.end - arc.start == pytest.approx(0.24)
        met = [arc.centre + cmath.rect(arc.radius, (arc.start + arc.end) / 2) for arc in four]
        assert met[0] == pytest.approx(met[1])
        assert met[2] == pytest.approx(met[3])
        assert ((met[0] - a) / (b - a)).imag > 0 > ((met[2] - a) / (b - a)).imag


@every
def test_o_is_the_centre_of_the_circle_through_the_three_points_and_ob_is_the_radius_read(name, hand):
    chain = chain_of(name, hand)
    chords, bisectors, step, on_profile = steps(name, hand, "curvature")
    points, (line,), (arc,) = only(chords, Dots)[0].points, only(step, Line), only(step, Arc)
    rho, hub = float(chain["curvature"].value("rho")), only(bisectors, Dots)[0].points[0]
    assert abs(hub - centre_of(*points)) < close(hand, 60)
    assert abs(line.points[0] - hub) + abs(line.points[1] - points[1]) == 0
    assert arc.centre == hub
    assert arc.radius == pytest.approx(abs(hub - points[1]))
    for end in (points[0], points[2]):  # shown a little beyond the chords
        turn = math.remainder(cmath.phase(end - hub) - (arc.start + arc.end) / 2, math.tau)
        assert abs(turn) < (arc.end - arc.start) / 2 < 3.5 * abs(turn)
    assert f"OB measures {abs(hub - points[1]):.2f} mm" in str(step.parts[0].caption)
    assert f"ρ = {rho:.3f} mm" in str(step.parts[0].caption)
    (read,) = only(step, Label)
    assert str(read.text) == f"ρ = {rho:.2f}"
    assert read.at == hub / 2
    assert read.towards / (hub * 1j) == pytest.approx(1)
    # The same circle on the profile, at its scale.
    (small,) = only(on_profile, Line)
    assert abs(small.points[1] - small.points[0]) * chain.profile_scale.per_mm == pytest.approx(rho)
    (centre,), (name_of_it, name_of_b) = only(on_profile, Dots), only(on_profile, Label)
    assert centre.points[0] == small.points[0] == name_of_it.at
    assert (str(name_of_it.text), str(name_of_b.text)) == ("O", "B")
    assert name_of_b.at == small.points[1]
    assert dot(name_of_b.towards, hub) < 0
    assert f"{abs(small.points[1] - small.points[0]):.1f} mm from B" in str(on_profile.caption)
    assert cmath.phase((small.points[1] - small.points[0]) / -hub) == pytest.approx(0, abs=1e-9)
    assert dot(name_of_it.towards, hub) > 0


# --- the roller and the working profile ------------------------------------------------------------------------------


def test_the_rules_candidates_are_reckoned_from_rho_and_the_prime_radius():
    chain = chain_of("cw, to the left", None)
    (step,) = chain["roller"].steps()
    rho, r0 = float(chain["curvature"].value("rho")), chain.prime_radius
    expected = [term.factor * (rho if term.of == "rho" else r0) - term.margin for term in chain.board.roller_rule]
    assert chain["roller"].value("candidates") == pytest.approx(expected)
    terms = ["0.7 ρ", "0.4 r₀"]
    said = ", ".join(f"{term} = {radius:.2f} mm" for term, radius in zip(terms, expected, strict=True))
    assert f"With ρ = {rho:.2f} mm and r₀ = {r0:g} mm the rule proposes {said}" in str(step.caption)
    assert f"take the smallest, {min(expected):.2f} mm" in str(step.caption)
    laid_off_from_b(chain, step, dict(zip(terms, expected, strict=True)))


def laid_off_from_b(chain: Chain, step: Step, radii: dict[str, float]) -> None:
    """Radii of the machine stand on the way from B to the centre of curvature, in the scale of the detail."""
    hub = only(chain["curvature"].steps()[1], Dots)[0].points[0]
    per_mm = float(chain["curvature"].value("rho")) / abs(hub)
    for dots, label, part, (name, radius) in zip(
        only(step, Dots), only(step, Label), step.parts, radii.items(), strict=True
    ):
        assert dots.points[0] == label.at == pytest.approx(radius / per_mm * hub / abs(hub))
        assert str(label.text) == f"{name} = {radius:.4g}"
        assert label.towards / hub == pytest.approx(1j if name == "r" else -1j)
        expected = f"Lay off {name} = {radius:.2f} mm from B towards O: {radius / per_mm:.1f} mm."
        assert str(part.caption).endswith(expected)
        assert str(step.caption).count(expected) == 1


def test_the_proposed_roller_is_rounded_down_in_a_step_of_its_own():
    chain = Chain(coursework())
    step, *_ = chain["working_profile"].steps()
    proposed = float(chain["roller"].value("roller_radius"))
    assert str(step.title) == "Roller radius rounded"
    assert str(step.caption).startswith(f"Round {proposed:.2f} mm down to {math.floor(proposed)} mm")
    laid_off_from_b(chain, step, {"r": chain.roller_radius})


@over_all(
    ("rule", "said"),
    [("0.5 r0", "The proposed radius of 20 mm is adopted unchanged."), ("0.52 r0", "Round 20.80 mm down to 20 mm")],
)
def test_a_round_proposal_is_kept(rule, said):
    drawn = Chain(coursework("3-4-5", prime_radius=40.0, roller_rule=roller_rule(rule)))["working_profile"]
    assert said in str(drawn.steps()[0].caption)


def test_where_a_hand_proposes_less_than_was_decided_it_is_said():
    board = coursework("3-4-5", roller_rule=roller_rule("0.7 rho"))
    chains = [Chain(board, Pencil(line=0.5, seed=seed)) for seed in range(12)]
    less = [chain for chain in chains if chain["roller"].value("roller_radius") < chain.roller_radius]
    assert less
    for chain in less:
        caption = str(chain["working_profile"].steps()[0].caption)
        assert caption.startswith(f"This drawing gives {float(chain['roller'].value('roller_radius')):.2f} mm; ")
        assert f"with the ideal pencil: {chain.roller_radius:g} mm." in caption


@over_all("radius", [0.0, 12.0, 40.0])
def test_a_given_roller_is_taken_without_the_rule_and_without_rounding(radius):
    chain = Chain(coursework("3-4-5", roller_radius=radius, prime_radius=46.0))
    caption, rho = str(chain["roller"].steps()[0].caption), float(chain["curvature"].value("rho"))
    assert "the rule is not applied" in caption
    assert (f"a roller of {radius:g} mm" in caption) == bool(radius)
    assert (f"It leaves ρ − r = {rho - radius:.2f} mm at B." in caption) == (0 < radius < rho)
    assert (f"It is not smaller than ρ = {rho:.2f} mm" in caption) == (radius >= rho)
    assert all("rounded" not in str(step.title) for step in chain["working_profile"].steps())


def profile_step(name: str, hand: Pencil | None, title: str) -> Step:
    (found,) = (step for step in steps(name, hand, "working_profile") if str(step.title) == title)
    return found


@every
def test_roller_circles_stand_about_the_pitch_points(name, hand):
    chain, step = chain_of(name, hand), profile_step(name, hand, "Roller circles")
    pitch = only(steps(name, hand, "inversion")[2], Dots)[0].points
    circles, radius = only(step, Circle), chain.roller_radius / chain.profile_scale.per_mm
    assert len(circles) == pitch.size
    for circle, at, place, its_name in zip(circles, pitch, step.places, names_of(chain), strict=True):
        assert abs(circle.centre - at) < close(hand)
        assert circle.radius == pytest.approx(radius, abs=close(hand))
        assert str(place.caption) == f"Circle {its_name}."
    assert "the circle of the roller about every point of the pitch curve" in str(step.caption)
    assert f"Set the compass to {radius:.1f} mm (r = {chain.roller_radius:g} mm at " in str(step.caption)
    assert f"from 0 to {names_of(chain)[-1]}." in str(step.caption)


@every
def test_touch_points_lie_a_roller_radius_inward_square_to_the_pitch_curve(name, hand):
    chain, step = chain_of(name, hand), profile_step(name, hand, "Contact points")
    pitch = only(steps(name, hand, "inversion")[2], Dots)[0].points
    radius, (dots,) = chain.roller_radius / chain.profile_scale.per_mm, only(step, Dots)
    assert f"{radius:.1f} mm inward" in str(step.caption)
    for k, (touch, at, place) in enumerate(zip(dots.points, pitch, step.places, strict=True)):
        assert abs(touch - at) == pytest.approx(radius, abs=close(hand, 2))
        inward = (at - touch) / abs(at - touch)
        if 0 < k < pitch.size - 1 and any(p.start < k < p.stop - 1 for p in chain.board.stations.pieces):
            centre = centre_of(*pitch[k - 1 : k + 2])
            assert abs(((at - centre) / abs(at - centre) / inward).imag) < close(hand, 1)
        assert str(place.caption) == f"Contact point {names_of(chain)[k]}."
        assert place.draws[0].index.tolist() == [k]


def touched(chain: Chain) -> np.ndarray:
    return np.asarray(chain["working_profile"].points["touch"])


@every
def test_the_working_profile_touches_every_circle_on_the_inside_and_cuts_none(name, hand):
    chain = chain_of(name, hand)
    circles = only(profile_step(name, hand, "Roller circles"), Circle)
    step = profile_step(name, hand, "Working profile")
    (line,), touch = only(step, Line), touched(chain)
    assert line.closed
    of_curve(name, hand, touch, line.points)
    for k, circle in enumerate(circles):
        if not np.isnan(touch[k]):
            assert abs(touch[k] - circle.centre) == pytest.approx(circle.radius, abs=1e-8)
            assert abs(touch[k]) < abs(circle.centre)
            others = [c for j, c in enumerate(circles) if j != k]
            assert min(abs(touch[k] - c.centre) - c.radius for c in others) > -close(hand, 3)
    radii = np.abs(touch[~np.isnan(touch)]) * chain.profile_scale.per_mm
    assert f"from {radii.min():.2f} to {radii.max():.2f} mm" in str(step.caption)
    covered = only(step, Dots)
    assert bool(covered) == bool(np.isnan(touch).any())
    for place in covered[0].points if covered else ():
        assert min(abs(place - c.centre) - c.radius for c in circles) < 0
    by_pieces(chain, step, line)
    if covered:
        lost = ", ".join(each for each, at in zip(names_of(chain), touch, strict=True) if np.isnan(at))
        assert f"At {covered[0].points.size} stations ({lost})" in str(step.parts[0].caption)
        np.testing.assert_array_equal(step.parts[0].draws[0].shown, covered[0].points)


@every
def test_the_pressure_angle_is_drawn_between_the_followers_line_and_the_normal(name, hand):
    chain, step = chain_of(name, hand), profile_step(name, hand, "Pressure angles on the profile")
    touch, stations = touched(chain), chain.board.stations
    pitch = only(steps(name, hand, "inversion")[2], Dots)[0].points
    (ways,) = only(steps(name, hand, "inversion")[1], Segments, Role.CONSTRUCTION)
    along = (ways.ends - ways.starts) / np.abs(ways.ends - ways.starts)
    # A plane that moves at v along the line turns with the cam about the point v beside A, square to the line.
    v = chain["integration"].value("v") / chain.profile_scale.per_mm
    centres = -1j * sigma(chain) * v * along
    angles = np.degrees(np.angle((pitch - centres) / along))
    angles[np.isnan(touch)] = np.nan
    marks, lines, normals = only(step, AngleMark), only(step, Line, Role.CONSTRUCTION), only(step, Line, Role.LIMIT)
    assert len(marks) == len(lines) == len(normals) == len(stations.phases)
    for mark, line, normal, span, place in zip(marks, lines, normals, stations.phases, step.places, strict=True):
        k = span.start + int(np.nanargmax(np.abs(angles[span])))
        assert mark.centre == line.points[0] == pytest.approx(pitch[k])
        assert normal.points[0] == pytest.approx(centres[k], abs=close(hand, 5))
        far = (pitch[k] - centres[k]) / abs(pitch[k] - centres[k]) * 30
        # The contact point lies on it, as well as the neighbouring points show the curve.
        assert abs(((touch[k] - pitch[k]) / far).imag * 30) < 1.5
        assert line.points[1] == pytest.approx(pitch[k] + 30 * along[k], abs=close(hand, 5))
        assert normal.points[1] == pytest.approx(pitch[k] + far, abs=close(hand, 5))
        assert mark.radius == 26
        ends = sorted((cmath.phase(line.points[1] - line.points[0]), cmath.phase(along[k]) + math.radians(angles[k])))
        assert [mark.start, mark.end] == pytest.approx(ends, abs=close(hand, 0.1))
        assert math.degrees(mark.end - mark.start) == pytest.approx(abs(angles[k]), abs=close(hand, 3))
        assert str(mark.text) == f"{math.degrees(mark.end - mark.start):.1f}°"
        # The diagram's angle, from the velocity: tan(alpha) = (v - e sign)/(s0 + s).
        integrated, e = chain["integration"], -sigma(chain) * chain.place
        s0 = math.sqrt(chain.prime_radius**2 - e**2)
        exact = math.degrees(math.atan2(integrated.value("v")[k] + e, s0 + integrated.value("s")[k]))
        diagram = abs(math.degrees(chain["pressure_angle"].first("alpha")[k]))
        assert diagram == pytest.approx(abs(exact), abs=close(hand, 5))
        at = names_of(chain)[k]
        shown = f"I {abs(centres[k]):.1f} mm from A, {abs(angles[k]):.1f}° ({diagram:.1f}° in the diagram)."
        assert str(place.caption) == f"Station {at}: {shown}"
        assert hand or abs(angles[k]) == pytest.approx(diagram, abs=1e-9)


def test_without_a_roller_the_profile_is_the_pitch_curve():
    drawn: dict[str, Construction] = dict(Chain(coursework("3-4-5", roller_radius=0.0)))
    step, *_ = drawn["working_profile"].steps()
    pitch = drawn["inversion"].steps()[3].marks[0]
    np.testing.assert_allclose(step.marks[0].points, pitch.points)
    radii = np.abs(drawn["inversion"].value("radius"))
    assert f"from {radii.min():.2f} to {radii.max():.2f} mm" in str(step.caption)


# --- every step ------------------------------------------------------------------------------------------------------


@every
def test_every_step_has_a_reason_and_its_parts_draw_all_of_its_own_marks(name, hand):
    for construction in ("inversion", "curvature", "roller", "working_profile"):
        for step in steps(name, hand, construction):
            why = str(step.why)
            assert re.fullmatch(r"(?!Because)[A-Z][^.]+\.", why), step.title
            drawn = {(each.act, k) for part in step.places for each in part.draws for k in each.index.tolist()}
            acts = {act for act, _ in drawn}
            for mark in step.own_marks if step.parts else ():
                if getattr(mark, "role", None) in (Role.AXIS, Role.SCALE) or mark.of.kind is Kind.READ:
                    continue
                assert mark.of in acts, (step.title, mark)
                if mark.index is not None:
                    assert {(mark.of, int(k)) for k in mark.index} <= drawn, (step.title, mark)
            for part in step.parts:
                assert re.fullmatch(r"[A-Z].*\.", str(part.caption))
                assert not re.search(r"(?<!\d)0\.00 mm", str(part.caption))
