"""The diagrams over the cam angle part by part: what every sub-step says in numbers is what its marks show."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
from boards import arm_board, arm_motion, coursework, limits
from over_all import over_all
from test_marks_of_integration import BOARDS, EVERY, MANY, PASSES, SIGMA, Pass, drawn, names_of, of, starts, steps

from graphcam.constructions.chain import Chain
from graphcam.constructions.graduation import RAYS_ROOM
from graphcam.drafting.act_order import FollowedBoard, pieces_of, visible_places
from graphcam.drafting.acts import Act, Kind
from graphcam.drafting.ink import Part, Step
from graphcam.drafting.marks import Dots, Label, Line, Role, Segments

NUMBER = r"(-?[\d.]+)"
CENTI, DECI = 0.0051, 0.051
"""What two digits, or one, after the point leave open."""


def numbers(part: Part, pattern: str) -> list[float]:
    """The numbers that a part says where the pattern has groups."""
    found = re.search(pattern, str(part.caption))
    assert found, (pattern, str(part.caption))
    return [float(group) for group in found.groups()]


def opened(names: str, name: str) -> list[str]:
    """All the names of parts in a list such as '1-3, 5, 1′'."""
    every = [n for n in names_of(name) if not n.startswith("0")]
    found: list[str] = []
    for run in names.split(", "):
        first, _, last = run.partition("-")
        found += every[every.index(first) : every.index(last or first) + 1]
    return found


def parts_of(name: str) -> list[str]:
    """The parts' names in order."""
    return [n for n in names_of(name) if not n.startswith("0")]


def diagrams(name: str, hand: str) -> list[Step]:
    """The steps of the acceleration diagram and of the integrations."""
    return [*steps(name, hand, "acceleration"), *steps(name, hand, "integration")]


def own_pieces(step: Step) -> set[tuple[Act, int]]:
    """The places of acts that the marks of a step show, but for what is given, the axes and the numbers of readings."""
    marks = [mark for mark in step.own_marks if getattr(mark, "role", None) not in (Role.AXIS, Role.SCALE)]
    marks = [mark for mark in marks if mark.of.kind is not Kind.READ]
    return {
        (mark.of, int(k)) for mark in marks for k in (mark.index if mark.index is not None else range(mark.of.size))
    }


# --- what every step owes --------------------------------------------------------------------------------------------


@EVERY
def test_every_step_says_why_and_its_parts_draw_all_its_marks(name, hand):
    for step in diagrams(name, hand):
        assert re.fullmatch(r"(?!Because)[A-Z].*[^.]\.", str(step.why)), str(step.why)
        assert step.parts
        done = {(piece.act, k) for part in step.places for piece in pieces_of(part.draws) for k in piece.at}
        assert own_pieces(step) <= done, str(step.title)
        for part in (*step.parts, *step.places):
            assert re.fullmatch(r"[A-Z].*[^.]\.", str(part.caption)), str(part.caption)
            assert not re.search(r"nan|[{}]|-0\.0+\b| 0\.00 mm (?:at|is|in)", str(part.caption))


# --- acceleration ----------------------------------------------------------------------------------------------------


@EVERY
def test_the_axis_is_cut_where_the_phases_end(name, hand):
    level, upright = steps(name, hand, "acceleration")[0].parts
    assert numbers(level, rf"{NUMBER} mm long") == [360]
    told = re.search(r"set off (.*) mm with", str(upright.caption)).group(1)
    assert [float(x) for x in told.split(", ")] == pytest.approx(starts(name)[1:], abs=DECI)
    cuts = upright.draws[0].shown
    ends = {round(x) for k in (0, 1) for x in starts(name)[np.array(moving_of(name)) + k]}
    assert {round(x) for x in cuts.real} == ends
    assert [piece.draws[0].act.name for piece in (level, upright)] == ["turn", "axis"]


def moving_of(name: str) -> list[int]:
    return [k for k, phase in enumerate(BOARDS[name].motion.phases) if phase.direction]


@EVERY
def test_the_largest_ordinate_of_a_phase_is_the_chosen_one_times_what_stands_beside_it(name, hand):
    step = steps(name, hand, "acceleration")[1]
    phases = [BOARDS[name].motion.phases[k] for k in moving_of(name)]
    first = next(k for k, phase in enumerate(phases) if phase.direction > 0)
    chosen = numbers(step.parts[0], rf"Choose {NUMBER} mm for the maximum ordinate of rise \S+; its scale is found")
    assert chosen[0] == pytest.approx(50, abs=DECI + MANY * SIGMA)
    for part in step.parts[1:]:
        (piece,) = pieces_of(part.draws)
        ours, theirs = phases[piece.at[0]], phases[first]
        said = str(part.caption).rpartition("For ")[2]
        y = numbers(part, rf"{NUMBER} mm(?: again)?\.$")[0]
        times = math.prod(
            (float(a) / float(b)) ** (2 if square else 1)
            for a, b, square in re.findall(r"([\d.]+)°?/([\d.]+)°?(\)²)?", said.partition("×")[2])
        )
        pairs = [(each.normalised.peak_acceleration, each.lift, 1 / each.angle**2) for each in (ours, theirs)]
        assert times == pytest.approx(np.prod(np.divide(*pairs)), rel=3e-4)
        # What both have alike is not among the factors.
        assert len(re.findall("/", said)) == sum(not math.isclose(a, b) for a, b in zip(*pairs, strict=True))
        assert y == pytest.approx(50 * times, abs=0.12 if hand == "perfect" else 4 * MANY * SIGMA)
        assert y == pytest.approx(abs(step.marks[piece.at[0]].end.imag), abs=DECI)
    assert {piece.at for part in step.parts for piece in pieces_of(part.draws)} == {(k,) for k in range(len(phases))}
    assert [mark.index.tolist() for mark in step.marks] == [[k] for k in range(len(phases))]


@EVERY
def test_the_ordinates_told_of_a_law_lie_on_its_curve_and_the_ruler_draws_it_where_it_is_straight(name, hand):
    step = steps(name, hand, "acceleration")[2]
    for part, line in zip(step.parts, of(step, Line, Role.RESULT), strict=True):
        told = np.array([[float(y), float(x)] for y, x in re.findall(rf"{NUMBER} at {NUMBER}", str(part.caption))])
        x, y = line.points.real, line.points.imag
        for height, at in told:
            assert np.hypot(x - at, y - height).min() < 0.08
        assert part.draws[0].shown == pytest.approx(line.points)
        ruler = "with the ruler" in str(part.caption)
        assert np.all(np.abs(np.diff(told, axis=0)).max(axis=1) > 0.09)
        # A corner, where one branch goes on from another, is a point of both.
        points = np.column_stack([x, y])[1:-1]
        points = points[np.append(True, np.hypot(*np.diff(points, axis=0).T) > 0.09)]
        assert ruler == (len(told) == len(points))
        if ruler:
            # The points that are told are all there are.
            np.testing.assert_allclose(told[:, ::-1], points, atol=DECI)


@EVERY
def test_the_parts_of_a_phase_are_as_wide_and_as_high_as_is_told(name, hand):
    step = steps(name, hand, "acceleration")[3]
    ordinate = dict(zip(parts_of(name), of(step, Segments, Role.CONSTRUCTION)[0].ends.imag, strict=True))
    x = (of(step, Segments, Role.SCALE)[0].starts + of(step, Segments, Role.SCALE)[0].ends).real / 2
    told: list[str] = []
    for k, span in enumerate(BOARDS[name].stations.phases):
        cut, raised = step.parts[2 * k : 2 * k + 2]
        runs = re.findall(rf"{NUMBER} to {NUMBER} mm into (\d+) parts of {NUMBER} mm", str(cut.caption))
        at = span.start
        for start, stop, n, width in runs:
            end = at + int(n)
            assert (float(start), float(stop)) == pytest.approx((x[at], x[end]), abs=DECI)
            assert float(width) == pytest.approx((x[end] - x[at]) / int(n), abs=CENTI)
            at = end
        assert at == span.stop - 1
        first, last = re.search(r"cuts (\S+) to (\S+)\.", str(cut.caption)).groups()
        assert (first, last) == (names_of(name)[span.start], names_of(name)[span.stop - 1])
        for names, y in re.findall(rf"([^:;]+): {NUMBER}(?:;|\.$)", str(raised.caption).partition("in mm: ")[2]):
            for part in opened(names.strip(), name):
                told.append(part)
                assert float(y) == pytest.approx(ordinate[part], abs=DECI)
    assert told == parts_of(name)


# --- the two integrations --------------------------------------------------------------------------------------------


def rays_told(run: Pass) -> list[tuple[str, float]]:
    """The names of the rays, and how high they end, as the parts say it."""
    found = [re.fullmatch(rf"Rays? (.*?): [av] = {NUMBER} mm\.", str(row.caption)) for row in run.rays.parts[1].rows]
    assert all(found)
    middles = "the ordinate at the middle of each chord of v", "each middle ordinate of a"
    assert sum(text in str(run.rays.parts[1].caption).replace("Carry", "carry") for text in middles) == 1
    return [(each.group(1), float(each.group(2))) for each in found]


@PASSES
@EVERY
def test_every_part_has_its_ray_and_rays_that_fall_on_one_another_are_one_with_all_their_numbers(name, hand, index):
    run = Pass(name, hand, index)
    told = rays_told(run)
    shared = [opened(names, name) for names, _ in told]
    assert sorted(n for names in shared for n in names) == sorted(parts_of(name))
    levels = run.levels.starts.imag
    assert len(set(np.round(levels, 8))) == levels.size == len(told)
    for (_, y), level, names in zip(told, levels, shared, strict=True):
        assert y == pytest.approx(level, abs=CENTI)
        middles = [run.middles.imag[parts_of(name).index(n)] for n in names]
        np.testing.assert_allclose(middles, level, atol=EXACT if hand == "perfect" else MANY * SIGMA)
    assert numbers(run.rays.parts[0], rf"{NUMBER} mm to the left") == [run.pole]


EXACT = 1e-8


@PASSES
@EVERY
def test_numbers_stand_at_the_ends_of_their_rays_and_find_room(name, hand, index):
    run = Pass(name, hand, index)
    told = {level: names for (names, _), level in zip(rays_told(run), run.levels.starts.imag, strict=True)}
    labels = [label for label in of(run.rays, Label) if label.small]
    assert labels
    heights = sorted(label.at.imag for label in labels)
    assert np.diff(heights).min(initial=math.inf) > 0
    for label in labels:
        assert label.at.real == 0 == label.towards.imag
        # In the line that is carried level from the ray's end.
        assert label.along > 0
    # Every ray is numbered once, at an end that is less than a letter off.
    assert sorted(each for label in labels for each in expanded(label.text)) == sorted(
        each for names in told.values() for each in expanded(names)
    )
    for level, names in told.items():
        (label,) = (label for label in labels if expanded(names)[0] in expanded(label.text))
        assert abs(label.at.imag - level) < RAYS_ROOM


def expanded(names: object) -> list[str]:
    """The single names of several, such as 1-3, 5′."""
    found: list[str] = []
    for run in str(names).split(", "):
        first, _, last = run.partition("-")
        phase = "′" * first.count("′")
        numbers = (int(end.replace("′", "")) for end in (first, last or first))
        found += [f"{k}{phase}" for k in range(next(numbers), next(numbers) + 1)]
    return found


@PASSES
@EVERY
def test_middle_ordinates_of_v_are_dots_halfway_along_its_chords(name, hand, index):
    run = Pass(name, hand, index)
    dots = of(run.rays, Dots, Role.CONSTRUCTION)
    assert len(dots) == index
    for each in dots:
        np.testing.assert_allclose(each.points, run.middles, atol=1e-9 if hand == "perfect" else MANY * SIGMA)


def chord_parts(run: Pass) -> list[Part]:
    return [place for place in run.chords.places if str(place.caption).startswith("Chord ")]


@PASSES
@EVERY
def test_chord_k_bears_the_number_of_the_ray_that_it_is_parallel_to_and_climbs_as_is_told(name, hand, index):
    run = Pass(name, hand, index)
    ends = np.concatenate(run.polygons)
    ray = {n: y / run.pole for names, y in rays_told(run) for n in opened(names, name)}
    parts, stations = chord_parts(run), names_of(name)
    assert len(parts) == len(ray)
    for part, own in zip(parts, parts_of(name), strict=True):
        said = re.fullmatch(r"Chord (\S+): (.*)\.", str(part.caption)).groups()
        k = stations.index(own)
        assert said[0] == own
        rise = (ends[k] - ends[k - 1]).imag
        words = {1: "climbs", -1: "falls"}.get(np.sign(rise) * (abs(rise) >= 0.005), "is horizontal")
        assert said[1].startswith(words)
        if words != "is horizontal":
            assert float(said[1].split()[1]) == pytest.approx(abs(rise), abs=CENTI)
        width = (ends[k] - ends[k - 1]).real
        loose = 1e-9 if hand == "perfect" else MANY * SIGMA * (2 + 3 * abs(ray[own]))
        assert rise == pytest.approx(ray[own] * width, abs=loose + CENTI * width / run.pole)
        assert k in pieces_of(part.draws)[0].at
    for label in of(run.chords, Label)[2:]:
        if label.of and label.of.name != "axis" and label.small and label not in run.chords.given:
            assert ends[stations.index(label.text)] == label.at
            k = stations.index(label.text)
            near = [
                j for j in (k - 1, k + 1) if 0 <= j < len(stations) and stations[j].count("′") == stations[k].count("′")
            ]
            climbs = sum((abs(ends[k].imag) - abs(ends[j].imag)) * (k - j) for j in near)
            # Outside of the curve: left where it leaves the axis, right where it comes back.
            assert abs(climbs) < 0.01 or label.towards == -np.sign(climbs)


@PASSES
@EVERY
def test_beside_chord_k_ray_k_is_lit_and_no_other(name, hand, index):
    every = diagrams(name, hand)
    board = FollowedBoard(visible_places(every))
    run = Pass(name, hand, index)
    rays = next(mark.of for mark in of(run.rays, Segments) if mark.of.name.startswith("rays"))
    kept = of(run.rays, Segments)[1].index
    told = {n: int(k) for (names, _), k in zip(rays_told(run), kept, strict=True) for n in opened(names, name)}
    for step in every:
        moves = board.followed(step)
        if step is run.chords or str(step.title) == str(run.chords.title):
            for part, move in zip(step.places, moves, strict=True):
                if named := re.match(r"Chord (\S+):", str(part.caption)):
                    lit = [(piece.act, piece.at) for piece in move.lit if piece.act.name == rays.name]
                    assert [at for _, at in lit] == [(told[named.group(1)],)]


@PASSES
@EVERY
def test_the_worked_chord_climbs_by_the_area_of_its_part_over_the_pole_distance(name, hand, index):
    run = Pass(name, hand, index)
    found = re.search(
        r"Chord (\S+): slide the set square from ray (\S+) to point (\S+) and draw as far as vertical (\S+); "
        rf"it climbs by y·Δx/H = {NUMBER}·{NUMBER}/{NUMBER} = {NUMBER} mm",
        str(run.chords.caption),
    )
    y, width, pole, rise = map(float, found.groups()[4:])
    k = names_of(name).index(found.group(1))
    assert found.groups()[1:4] == (names_of(name)[k], names_of(name)[k - 1], names_of(name)[k])
    ends = np.concatenate(run.polygons)
    assert pole == run.pole
    assert width == pytest.approx((ends[k] - ends[k - 1]).real, abs=CENTI)
    assert y == pytest.approx(run.middles.imag[parts_of(name).index(found.group(1))], abs=CENTI + (hand != "perfect"))
    assert rise == pytest.approx((ends[k] - ends[k - 1]).imag, abs=CENTI)
    loose = 0.005 * (width / pole + abs(y) / pole) + CENTI
    assert rise == pytest.approx(y * width / pole, abs=loose + (hand != "perfect") * MANY * SIGMA * (2 + abs(y) / pole))


@PASSES
@EVERY
def test_what_is_checked_is_the_curve_and_what_is_left_is_shared_out(name, hand, index):
    run = Pass(name, hand, index)
    stations, ends = names_of(name), np.concatenate(run.polygons)
    checks = [part for part in run.chords.parts if "Check: " in str(part.caption)]
    for part, span in zip(checks, BOARDS[name].stations.phases, strict=True):
        said = re.search(
            rf"Check: ([vs]) is {NUMBER} mm at (\S+) and (?:zero|{NUMBER} mm) at (\S+)\.", str(part.caption)
        ).groups()
        assert said[0] == "vs"[index]
        assert float(said[1]) == pytest.approx(run.points[stations.index(said[2])].imag, abs=CENTI)
        assert span.start <= stations.index(said[2]) < span.stop
        assert float(said[3] or 0) == pytest.approx(run.points[span.stop - 1].imag, abs=CENTI)
        assert said[4] == stations[span.stop - 1]
        off = (run.points - ends)[[span.start, span.stop - 1]].imag
        assert ("Distribute the residual" in str(part.caption)) == (np.abs(off).max() > 0.005)
        if "Distribute the residual" in str(part.caption):
            own = str(part.caption).partition("Distribute")[2].partition("Check")[0]
            shared = [float(each) for each in re.findall(r"([+-][\d.]+) mm", own)]
            assert shared == pytest.approx([each for each in off if abs(each) > 0.005 or each == off[1]], abs=CENTI)
        assert pieces_of(part.draws)[0].at == tuple(range(span.start, span.stop))


@EVERY
def test_a_phase_of_s_starts_where_the_one_before_ended(name, hand):
    run = Pass(name, hand, 1)
    begins = [place for place in run.chords.places if str(place.caption).startswith("Start of ")]
    for k, (part, polygon) in enumerate(zip(begins, run.polygons, strict=True)):
        y, said = polygon[0].imag, str(part.caption)
        if abs(y) < 0.005:
            assert said.endswith("on the axis.")
        else:
            assert numbers(part, rf"{NUMBER} mm (?:high|below)")[0] == pytest.approx(y, abs=CENTI)
            assert ("the previous phase" in said) == (k > 0)
        assert (
            re.search(r"vertical (\S+?)[,.;]", said + ",").group(1)
            == names_of(name)[BOARDS[name].stations.phases[k].start]
        )


@PASSES
@EVERY
def test_the_ruler_joins_what_lies_on_one_line_and_the_french_curve_the_rest(name, hand, index):
    run, stations = Pass(name, hand, index), names_of(name)
    begins = {span.start for span in BOARDS[name].stations.phases}
    straight = []
    for piece in BOARDS[name].stations.pieces:
        points = run.points[piece]
        way = points[-1] - points[0]
        straight.append(np.abs(((points - points[0]) * np.conj(way)).imag / abs(way)).max() < 0.05)
    # Where one instrument draws all pieces, it is named once for all.
    both = any(straight) and not all(straight)
    rows = zip(run.curves.parts[0].rows, BOARDS[name].stations.pieces, straight, strict=True)
    for part, piece, by_ruler in rows:
        first, last = re.match(r"From (\S+?) to (\S+?)[.:]", str(part.caption)).groups()
        assert (first, last) == (stations[piece.start], stations[piece.stop - 1])
        assert ("with the ruler" in str(part.caption)) == (both and by_ruler)
        assert ("with the French curve" in str(part.caption)) == (both and not by_ruler)
        assert (f" at {first} " in str(part.caption)) == (piece.start not in begins)
    if hand == "perfect" and name == "built-in":
        assert all(straight) == (index == 0)
    said = str(run.curves.caption)
    assert ("with the ruler" in said, "French curve" in said) == (any(straight), not all(straight))
    resting = len(run.curves.parts) - 1
    assert resting == ("In the dwells" in said) == any(phase.direction == 0 for phase in BOARDS[name].motion.phases)


@EVERY
def test_the_scales_are_divided_as_is_told(name, hand):
    scales, board = steps(name, hand, "integration")[6:], BOARDS[name]
    lift, paper, mu_s = numbers(scales[0].parts[0], rf"= ([\d.e-]+) \S+/{NUMBER} mm = ([\d.e-]+) ")
    assert lift == pytest.approx(board.motion.lift, rel=1e-5)
    assert mu_s == pytest.approx(lift / paper, rel=2e-4)
    before = mu_s
    for step, pole in zip(scales[1:], board.poles[::-1], strict=True):
        source, mu_phi, h, mu = numbers(step.parts[0], rf"= ([\d.e-]+)/\(([\d.e-]+)·{NUMBER}\) = ([\d.e-]+) ")
        assert source == pytest.approx(before, rel=1e-4)
        assert (mu_phi, h) == (pytest.approx(math.pi / 180, rel=1e-4), pole)
        assert mu == pytest.approx(source / (mu_phi * h), rel=1e-4)
        before = mu
    read = drawn(name, hand, "integration").readings
    for symbol, step in zip("sva", scales, strict=True):
        last = str(step.parts[1].caption)
        k = names_of(name).index(re.match(r"Station (\S+):", last).group(1))
        y, mu, value = re.search(rf"{symbol} = {NUMBER} mm × ([\d.e-]+) = (-?[\d.e-]+) ", last).groups()
        assert float(y) == pytest.approx(read[symbol].paper[k], abs=CENTI)
        assert float(value) == pytest.approx(float(y) * float(mu), rel=1e-4, abs=CENTI * float(mu))
        assert float(mu) == pytest.approx(read[symbol].per_mm, rel=1e-4)
        divided = [label for label in step.own_marks if isinstance(label, Label)]
        # An arm's angle is told in degrees.
        said = [str(label.text) for label in divided]
        # Over a graduation at the other end of the turn its name stands.
        assert (symbol != "s") == said[-1].startswith(f"{symbol}, ")
        divided, said = (divided[:-1], said[:-1]) if symbol != "s" else (divided, said)
        values = [math.radians(float(text[:-1])) if text.endswith("°") else float(text) for text in said]
        heights = [value / float(mu) for value in values]
        assert [label.at.imag for label in divided] == pytest.approx(heights, rel=1e-4)
        assert {label.at.real > 0 for label in divided} == {symbol != "s"}  # from the pole rays run to the axis


# --- the diagram of the pressure angle -------------------------------------------------------------------------------

ANGLES = {
    "built-in": coursework(),
    "form closure": coursework("3-4-5", offset=None, limits=limits(30, 40)),
    "too small": coursework("3-4-5", prime_radius=30.0),
    "arm": arm_board(arm_motion("modified-sine")),
}


@over_all("name", ANGLES)
def test_every_angle_is_set_off_at_its_station_upward_where_it_is_positive(name):
    chain = Chain(ANGLES[name])
    step = chain["angle_diagram"].steps()[0]
    alpha = np.degrees(chain["pressure_angle"].readings["alpha"].paper)
    plotted = of(step, Dots)[0].points
    own = [place for place in step.places if str(place.caption).startswith("Station ")]
    for k, (part, at, angle) in enumerate(zip(own, plotted, alpha, strict=True)):
        way = "upward" if angle >= 0 else "downward"
        told, y = numbers(part, rf": {NUMBER}°, {NUMBER} mm {way}\.")
        assert (y, told) == (pytest.approx(abs(at.imag), abs=CENTI), pytest.approx(angle, abs=CENTI))
        assert pieces_of(part.draws)[0].at == (k,)
        assert np.sign(at.imag) == np.sign(angle)
    done = {(piece.act, k) for place in step.places for piece in pieces_of(place.draws) for k in piece.at}
    assert own_pieces(step) <= done


@over_all("name", ANGLES)
def test_the_largest_angles_are_compared_with_their_limits(name):
    board, step = ANGLES[name], Chain(ANGLES[name])["angle_diagram"].steps()[1]
    dots, labels = of(step, Dots, Role.LIMIT), of(step, Label)
    drawn = list(zip(step.parts, dots, labels, strict=True))
    inner = [each for each in drawn if "inside it" in str(each[0].caption)]
    for part, dot, label in inner:  # a maximum of the other sign has no limit of its own
        y, alpha = numbers(part, rf"the farthest point is at {NUMBER} mm, so α = {NUMBER}°")
        assert (y, alpha) == (pytest.approx(dot.points[0].imag, abs=CENTI), pytest.approx(y, abs=CENTI))
        assert float(str(label.text).rstrip("°")) == pytest.approx(alpha, abs=DECI)
    assert bool(inner) == (name == "arm")
    farthest = [each for each in drawn if "inside it" not in str(each[0].caption)]
    limits = board.limits.rise, board.limits.return_
    for (part, dot, label), limit in zip(farthest, limits, strict=True):
        y, alpha = numbers(part, rf"farthest point of the curve is at {NUMBER} mm, so α = {NUMBER}°: ")
        assert y == pytest.approx(dot.points[0].imag, abs=CENTI)
        assert alpha == pytest.approx(y, abs=CENTI)  # a degree is a millimetre
        assert label.at == dot.points[0]
        assert float(str(label.text).rstrip("°")) == pytest.approx(alpha, abs=DECI)
        said = str(part.caption).partition("°: ")[2]
        if limit is None:
            assert said == "a spring drives the return, so the angle is not limited."
            continue
        permitted = math.degrees(limit)
        if abs(abs(y) - permitted) <= 0.2:
            assert said == f"equal to the limit of {permitted:.4g}° within drawing accuracy."
        else:
            sign, word = ("<", "within the limit") if abs(y) < permitted else (">", "the limit is exceeded")
            assert said == f"{abs(alpha):.2f}° {sign} {permitted:.4g}°, {word}."
        assert str(step.caption).count(said) == 1


def test_all_ways_to_compare_an_angle_are_among_those_tried():
    said = " ".join(str(Chain(board)["angle_diagram"].steps()[1].caption) for board in ANGLES.values())
    assert all(each in said for each in ("within the limit", "exceeded", "within drawing accuracy", "not limited"))
