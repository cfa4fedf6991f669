"""What the inversion, the three points, the roller and the working profile show, mark by mark."""

from __future__ import annotations

import cmath
import math
import re
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from boards import board_of, coursework, motion_of

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction, Step
from graphcam.drafting.marks import AngleMark, Arc, Arrow, Circle, Dots, Label, Line, Role, Segments
from graphcam.drafting.pencil import Pencil

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
every = pytest.mark.parametrize(("name", "hand"), [*((name, None) for name in BOARDS), ("ccw, to the right", HAND)])


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
def test_the_circles_have_the_adopted_radii_and_their_arrows_end_on_them(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[0]
    mu = chain.profile_scale.per_mm
    sizes = [chain.prime_radius, *([abs(chain.place)] if chain.place else [])]
    circles, arrows = only(step, Circle), only(step, Arrow)
    assert [circle.radius * mu for circle in circles] == pytest.approx(sizes, abs=close(hand, mu))
    assert [str(label.text) for label in only(step, Label)[1:]] == [
        f"{symbol} = {size:g}" for symbol, size in zip(("r₀", "e"), sizes, strict=False)
    ]
    for circle, arrow, label in zip(circles, arrows, only(step, Label)[1:], strict=True):
        assert abs(circle.centre) < close(hand)
        assert abs(arrow.start - circle.centre) < 1e-9
        assert abs(arrow.end - arrow.start) == pytest.approx(circle.radius, abs=1e-9)
        assert label.at == pytest.approx(arrow.start + 0.6 * (arrow.end - arrow.start))
        assert label.towards / (arrow.end * 1j) == pytest.approx(1)
    read = numbers(step)
    for size in sizes:
        assert any(number == pytest.approx(size / mu, abs=0.051) for number in read)


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


@every
def test_the_displacement_lies_between_the_prime_circle_and_the_end(name, hand):
    chain = chain_of(name, hand)
    _, positions, ends, _ = steps(name, hand, "inversion")
    (lines,), (dots,) = only(positions, Segments, Role.CONSTRUCTION), only(ends, Dots)
    r0, mu, longest = chain.prime_radius, chain.profile_scale.per_mm, 0.0
    for foot, end, plotted, s in zip(
        lines.starts, lines.ends, dots.points, chain["integration"].value("s"), strict=True
    ):
        assert end == plotted
        start = math.sqrt((r0 / mu) ** 2 - abs(foot) ** 2)
        assert abs(end - foot) == pytest.approx(start + s / mu, abs=close(hand, 3))
        longest = max(longest, s / mu)
    assert any(number == pytest.approx(longest, abs=0.06 + close(hand)) for number in numbers(ends))


@every
def test_the_phase_angles_follow_one_another_from_the_start_against_the_rotation(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "inversion")[1]
    marks, (rays,) = only(step, AngleMark), only(step, Segments, Role.AXIS)
    pitch = only(steps(name, hand, "inversion")[2], Dots)[0].points
    e = chain.place / chain.prime_radius
    begin = math.atan2(math.sqrt(1 - e * e), e)
    total = 0.0
    for k, (mark, phase) in enumerate(zip(marks, chain.board.motion.phases, strict=True)):
        low, high = mark.start, mark.end
        assert high - low == pytest.approx(phase.angle)
        from_ = low if sigma(chain) < 0 else high
        off = math.remainder(from_ - begin + sigma(chain) * total, math.tau)
        assert off == pytest.approx(0, abs=close(hand, 0.1))
        assert str(mark.text).endswith(f"= {math.degrees(phase.angle):.6g}°")
        assert abs(mark.centre) == abs(rays.starts[k]) == 0
        assert mark.radius == pytest.approx(float(np.abs(pitch).max()) + 9)
        assert abs(rays.ends[k] - cmath.rect(mark.radius + 4.5, from_)) < 1e-9
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


# --- three points ----------------------------------------------------------------------------------------------------


def centre_of(a: complex, b: complex, c: complex) -> complex:
    """Of the circle through three points, by the equations of equal distances."""
    rows = [[2 * (q - p).real, 2 * (q - p).imag] for p, q in ((a, b), (b, c))]
    return complex(*np.linalg.solve(rows, [abs(q) ** 2 - abs(p) ** 2 for p, q in ((a, b), (b, c))]))


@every
def test_three_points_of_the_pitch_curve_are_shown_enlarged_about_b(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "curvature")[0]
    (line,), (dots,) = only(step, Line), only(step, Dots)
    curved = chain["curvature"]
    assert abs(line.points[1]) == 0
    np.testing.assert_array_equal(dots.points, line.points)
    on_paper, of_machine = (float(part) for part in re.search(r"at ([\d.]+):([\d.]+):", str(step.caption)).groups())
    times = on_paper / of_machine * chain.profile_scale.per_mm
    pitch, b = only(steps(name, hand, "inversion")[2], Dots)[0].points, curved.points["triple"][1]
    assert curved.value("rho_candidates")[0] == curved.value("rho")  # not in a rest
    for place in line.points / times:
        assert np.abs(pitch - b - place).min() < 1e-8
    chords = [abs(q - p) for p, q in pairwise(line.points)]
    assert all(f"{chord:.2f} mm" in str(step.caption) for chord in chords)
    assert f"φ = {math.degrees(curved.first('phi')[1] % math.tau):.1f}°" in str(step.caption)
    hub = only(steps(name, hand, "curvature")[2], Dots)[0].points[0]
    for label, at in zip(only(step, Label), line.points, strict=True):
        assert label.at == at
        assert dot(label.towards, hub) < 0


@every
def test_the_bisectors_are_square_to_the_chords_go_through_their_middles_and_meet_in_o(name, hand):
    chords, bisectors, radius, _ = steps(name, hand, "curvature")
    (polygon,), lines = only(chords, Line), only(bisectors, Line)
    hub = only(radius, Dots)[0].points[0]
    for (a, b), line in zip(pairwise(polygon.points), lines, strict=True):
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
    (polygon,), arcs = only(chords, Line), only(bisectors, Arc)
    assert len(arcs) == 8
    for k, (a, b) in enumerate(pairwise(polygon.points)):
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
    chords, _, step, on_profile = steps(name, hand, "curvature")
    points, (line,), (arc,) = only(chords, Line)[0].points, only(step, Line), only(step, Arc)
    rho, hub = float(chain["curvature"].value("rho")), only(step, Dots)[0].points[0]
    assert abs(hub - centre_of(*points)) < close(hand, 60)
    assert abs(line.points[0] - hub) + abs(line.points[1] - points[1]) == 0
    assert arc.centre == hub
    assert arc.radius == pytest.approx(abs(hub - points[1]))
    for end in (points[0], points[2]):  # shown a little beyond the chords
        turn = math.remainder(cmath.phase(end - hub) - (arc.start + arc.end) / 2, math.tau)
        assert abs(turn) < (arc.end - arc.start) / 2 < 3.5 * abs(turn)
    assert f"OB measures {abs(hub - points[1]):.2f} mm" in str(step.caption)
    assert f"ρ = {rho:.3f} mm" in str(step.caption)
    o, read = only(step, Label)
    assert (str(o.text), o.at) == ("O", hub)
    assert dot(o.towards, hub) > 0
    assert str(read.text) == f"ρ = {rho:.2f}"
    assert read.at == hub / 2
    assert read.towards / (hub * 1j) == pytest.approx(1)
    # The same circle on the profile, at its scale.
    (small,) = only(on_profile, Line)
    assert abs(small.points[1] - small.points[0]) * chain.profile_scale.per_mm == pytest.approx(rho)
    (centre,), (name_of_it,) = only(on_profile, Dots), only(on_profile, Label)
    assert centre.points[0] == small.points[0] == name_of_it.at
    assert str(name_of_it.text) == "O"
    assert cmath.phase((small.points[1] - small.points[0]) / -hub) == pytest.approx(0, abs=1e-9)
    assert dot(name_of_it.towards, hub) > 0


# --- the roller and the working profile ------------------------------------------------------------------------------


def test_the_rules_candidates_are_reckoned_from_rho_and_the_prime_radius():
    chain = chain_of("cw, to the left", None)
    (step,) = chain["roller"].steps()
    rho, r0 = float(chain["curvature"].value("rho")), chain.prime_radius
    expected = [term.factor * (rho if term.of == "rho" else r0) - term.margin for term in chain.board.roller_rule]
    assert chain["roller"].value("candidates") == pytest.approx(expected)
    assert step.marks == ()
    for radius in expected:
        assert f"{radius:.2f} mm" in str(step.caption)
    assert f"the smallest is taken, {min(expected):.2f} mm" in str(step.caption)


@every
def test_roller_circles_stand_about_the_pitch_points(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "working_profile")[0]
    pitch = only(steps(name, hand, "inversion")[2], Dots)[0].points
    circles, radius = only(step, Circle), chain.roller_radius / chain.profile_scale.per_mm
    assert len(circles) == pitch.size
    for circle, at in zip(circles, pitch, strict=True):
        assert abs(circle.centre - at) < close(hand)
        assert circle.radius == pytest.approx(radius, abs=close(hand))
    assert f"r = {chain.roller_radius:g} mm, {radius:.1f} mm on paper" in str(step.caption)


def touched(chain: Chain) -> np.ndarray:
    return np.asarray(chain["working_profile"].points["touch"])


@every
def test_the_working_profile_touches_every_circle_on_the_inside_and_cuts_none(name, hand):
    chain = chain_of(name, hand)
    circles = only(steps(name, hand, "working_profile")[0], Circle)
    step = steps(name, hand, "working_profile")[1]
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
    if covered:
        assert f"At {covered[0].points.size} stations" in str(step.caption)


@every
def test_the_pressure_angle_is_drawn_between_the_followers_line_and_the_normal(name, hand):
    chain, step = chain_of(name, hand), steps(name, hand, "working_profile")[2]
    touch, stations = touched(chain), chain.board.stations
    pitch = only(steps(name, hand, "inversion")[2], Dots)[0].points
    (ways,) = only(steps(name, hand, "inversion")[1], Segments, Role.CONSTRUCTION)
    along = (ways.ends - ways.starts) / np.abs(ways.ends - ways.starts)
    with np.errstate(invalid="ignore"):
        angles = np.degrees(np.angle((pitch - touch) / along))
    marks, lines, normals = only(step, AngleMark), only(step, Line, Role.CONSTRUCTION), only(step, Line, Role.LIMIT)
    assert len(marks) == len(lines) == len(normals) == len(stations.phases)
    for mark, line, normal, span in zip(marks, lines, normals, stations.phases, strict=True):
        k = span.start + int(np.nanargmax(np.abs(angles[span])))
        assert mark.centre == line.points[0] == pytest.approx(pitch[k])
        assert normal.points[0] == touch[k]
        far = (pitch[k] - touch[k]) / abs(pitch[k] - touch[k]) * 30
        assert line.points[1] == pytest.approx(pitch[k] + 30 * along[k], abs=close(hand, 5))
        assert normal.points[1] == pytest.approx(pitch[k] + far)
        assert mark.radius == 26
        ends = sorted((cmath.phase(line.points[1] - line.points[0]), cmath.phase(along[k]) + math.radians(angles[k])))
        assert [mark.start, mark.end] == pytest.approx(ends, abs=close(hand, 0.1))
        assert math.degrees(mark.end - mark.start) == pytest.approx(abs(angles[k]), abs=close(hand, 3))
        assert str(mark.text) == f"{math.degrees(mark.end - mark.start):.1f}°"


def test_without_a_roller_the_profile_is_the_pitch_curve():
    drawn: dict[str, Construction] = dict(Chain(coursework("3-4-5", roller_radius=0.0)))
    (step,) = drawn["working_profile"].steps()
    pitch = drawn["inversion"].steps()[3].marks[0]
    np.testing.assert_allclose(step.marks[0].points, pitch.points)
    radii = np.abs(drawn["inversion"].value("radius"))
    assert f"from {radii.min():.2f} to {radii.max():.2f} mm" in str(step.caption)
