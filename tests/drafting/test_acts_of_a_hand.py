"""Every act of a hand: what it leaves when nothing errs, and by what it errs, as CONSTRUCTIONS of textbooks say."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from graphcam.drafting.acts import Drawn, Kind
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, calculated_setting, distance_between
from graphcam.drafting.ink import say
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.slips import SQUARE_LENGTH

MEANING = Meaning("example", say("Example"), say("To try."), {"length": ReadingMeaning(say("length"), "l", "lift")})
SAMPLES, LINE, DIVIDERS, ANGLE = 5_000, 0.2, 0.3, 0.01
WITHIN = 0.06
"""Of a standard deviation from 5,000 samples: six of its own."""


def exact() -> Hand:
    return Hand(Pencil(), MEANING)


def trembling(**errors: float) -> Hand:
    return Hand(Pencil(**errors, samples=SAMPLES, seed=3), MEANING)


def scatter(values) -> np.ndarray:
    return np.std(values, axis=0)


def across(drawn: Drawn, through: complex, along: complex) -> np.ndarray:
    """How far places lie to the left of a line."""
    return ((drawn.points - through) * np.conj(along / abs(along))).imag


# --- dividers --------------------------------------------------------------------------------------------------------


def test_a_division_mark_is_off_by_a_divider_setting_along_the_way_and_the_ends_stand():
    hand = trembling(dividers=DIVIDERS)
    start, end = hand.given("start", 1 + 1j), hand.given("end", 1 + 31j)
    marks = hand.divide("marks", start, end, np.array([0.0, 1 / 3, 2 / 3, 1.0]))
    assert_allclose(marks.points.mean(axis=0), [1 + 1j, 1 + 11j, 1 + 21j, 1 + 31j], atol=0.02)
    assert_allclose(scatter(marks.points.imag), [0, DIVIDERS, DIVIDERS, 0], rtol=WITHIN, atol=1e-12)
    assert_allclose(marks.points.real, 1, atol=1e-12)


def test_a_length_laid_off_is_off_by_a_divider_setting_in_its_direction():
    hand = trembling(dividers=DIVIDERS)
    way = (3 + 4j) / 5
    ends = hand.lay_off("ends", hand.given("start", 2j), way, np.array([10.0, 0.0]))
    assert_allclose(scatter((ends.points / way).real), [DIVIDERS, 0], rtol=WITHIN, atol=1e-12)
    assert_allclose((ends.points / way).imag, (2j / way).imag, atol=1e-12)
    assert_allclose(ends.points[:, 1], 2j, atol=1e-12)  # nothing is set where there is nothing to lay off


def test_a_length_is_laid_off_along_a_line_of_any_length():
    hand = exact()
    line = hand.join("line", hand.given("a", 1j), hand.given("b", 6 + 1j))
    assert hand.lay_off("end", hand.given("start", 2j), line, 3.0).place == 3 + 2j
    assert hand.lay_off("up", hand.given("start", 2j), line.turned(1j), 3.0).place == 5j


def test_a_setting_is_the_distance_of_two_places_or_the_signed_way_along_a_direction():
    hand = exact()
    a, b = hand.given("a", 4 + 5j), hand.given("b", np.array([1 + 1j, 7 + 9j]))
    assert_allclose(distance_between(a, b).amount, [5, 5])
    assert_allclose(distance_between(a, b, UP).amount, [-4, 4])
    assert_allclose(distance_between(b, a, RIGHT).amount, [3, -3])
    assert_allclose(
        calculated_setting(np.maximum, distance_between(a, b, UP), distance_between(b, a, UP)).amount, [4, 4]
    )


def test_a_reading_is_carried_over_times_its_sample_s_factor():
    hand = trembling(dividers=DIVIDERS)
    start = hand.given("start", np.zeros(2))
    ends = hand.lay_off("ends", start, UP, np.array([10.0, 20.0]))
    read = hand.read("length", distance_between(start, ends, UP), 0.5)
    factor = np.linspace(1, 2, SAMPLES)
    assert_allclose(hand.carry(read, factor).amount, read.paper * factor[:, None])
    assert_allclose(hand.carry(read, 3.0).amount, 3 * read.paper)
    assert hand.at_scale(30.0, read).amount == 60


# --- ruler and set squares -------------------------------------------------------------------------------------------


def test_a_line_is_erected_beside_its_mark_by_a_line_and_upright():
    line = (hand := trembling(line=LINE)).erect("line", hand.given("foot", 5 + 0j))
    assert_allclose(scatter(line.points.real), LINE, rtol=WITHIN)
    assert_allclose(line.points.imag, 0, atol=1e-12)
    assert_allclose(line.directions, UP)


@pytest.mark.parametrize("act", ["parallel", "perpendicular"])
def test_what_set_squares_carry_is_off_by_a_line_and_turned_by_a_line_over_the_square(act):
    hand = trembling(line=LINE)
    to, through = hand.given("to", 0j, along=3 + 4j), hand.given("through", 5 + 5j)
    line = getattr(hand, act)("line", to, through)
    right = (3 + 4j) * (1 if act == "parallel" else 1j)
    assert_allclose(scatter(across(line, 5 + 5j, right)), LINE, rtol=WITHIN)
    turns = np.angle(line.directions / right)
    assert_allclose(scatter(turns), LINE / SQUARE_LENGTH, rtol=WITHIN)
    assert abs(np.corrcoef(turns, across(line, 5 + 5j, right))[0, 1]) < WITHIN
    perfect = getattr(exact(), act)("line", to, exact().given("through", 5 + 5j))
    assert_allclose(np.angle(perfect.directions / right), 0, atol=1e-15)


def test_a_place_is_projected_square_to_a_line_and_off_along_it_by_a_line():
    hand = trembling(line=LINE)
    onto = hand.given("onto", 10j, along=1 + 1j)
    feet = hand.project("feet", hand.given("points", np.array([4 + 10j, 10j])), onto)
    assert_allclose(feet.points.mean(axis=0), [2 + 12j, 10j], atol=0.02)
    assert_allclose(across(feet, 10j, 1 + 1j), 0, atol=1e-12)
    assert_allclose(scatter((feet.points * np.conj((1 + 1j) / math.sqrt(2))).real), [LINE, LINE], rtol=WITHIN)


def test_a_given_height_is_projected_to_where_it_stands_on_the_line():
    hand = exact()
    start = hand.given("start", np.zeros(2))
    ends = hand.lay_off("ends", start, UP, np.array([3.0, -2.0]))
    heights = distance_between(start, ends, UP)
    assert_allclose(hand.project("feet", heights, hand.given("axis", 1 + 0j, along=2j)).points, [1 + 3j, 1 - 2j])


def test_chords_set_end_to_end_start_from_the_end_of_the_one_before_and_gather_their_errors():
    hand = trembling(line=LINE)
    cuts = hand.given("cuts", np.array([0, 10, 20, 30, 50, 60.0]))
    rays = hand.given("rays", np.zeros(4), along=np.array([1 + 1j, 2 + 1j, 1 - 1j, 5 + 1j]))
    ends = hand.end_to_end("ends", rays, cuts, [(slice(0, 4), slice(0, 3)), (slice(4, 6), slice(3, 4))])
    assert_allclose(ends.points.mean(axis=0).imag, [0, 10, 15, 5, 0, 2], atol=0.02)
    assert_allclose(ends.points.real, np.broadcast_to(cuts.points.real, ends.points.shape), atol=1e-12)
    # A chord of slope m that is turned rises by 1 + m^2 times as much as one that lies level.
    each = [LINE * math.hypot(1, 10 * (1 + m**2) / SQUARE_LENGTH) for m in (1, 0.5, -1, 0.2)]
    expected = [0, each[0], math.hypot(*each[:2]), math.hypot(*each[:3]), 0, each[3]]
    assert_allclose(scatter(ends.points.imag), expected, rtol=WITHIN, atol=1e-12)


def test_a_line_through_two_places_is_as_good_as_they_are():
    hand = trembling(line=LINE, dividers=DIVIDERS, protractor=ANGLE)
    line = hand.join("line", hand.given("a", 1 + 0j), hand.given("b", np.array([4 + 4j, 1j])))
    assert_allclose(line.directions, np.broadcast_to([3 + 4j, -1 + 1j], (SAMPLES, 2)))
    assert_allclose(line.points, 1)


@pytest.mark.parametrize("degrees", [90, 30, 10])
def test_a_crossing_takes_the_errors_of_both_lines_over_the_sine_of_their_angle(degrees):
    hand, turn = trembling(line=LINE), math.radians(degrees)
    level = hand.erect("level", hand.given("a", 0j), RIGHT)
    sloping = hand.erect("sloping", hand.given("b", 0j), np.exp(1j * turn))
    crossing = hand.cross("crossing", level, sloping)
    assert_allclose(scatter(crossing.points.imag), LINE, rtol=WITHIN)
    along = math.sqrt(LINE**2 + (LINE * math.cos(turn)) ** 2) / math.sin(turn)
    assert_allclose(scatter(crossing.points.real), along, rtol=WITHIN)


def test_lines_that_cross_at_less_than_a_degree_meet_only_where_that_is_asked():
    hand = exact()
    level, flat = hand.given("level", 0j, along=1), hand.given("flat", 1j, along=1 - 0.01j)
    assert np.isnan(hand.cross("read", level, flat).points)
    assert hand.cross("reckoned", level, flat, flat=True).place == pytest.approx(100)


def test_a_ray_leaves_a_circle_and_two_circles_meet_to_the_left():
    hand = exact()
    circle = hand.circle("circle", hand.given("a", 1 + 1j), 5.0)
    ray = hand.given("ray", np.array([4 + 0j, 4 + 0j]), along=np.array([1j, -1j]))
    assert_allclose(hand.cross("ends", ray, circle).points, [4 + 5j, 4 - 3j])
    other = hand.circle("other", hand.given("b", 7 + 1j), 5.0)
    assert_allclose(hand.cross("above", circle, other).points, 4 + 5j)
    assert_allclose(hand.cross("below", other, circle).points, 4 - 3j)


# --- compass and protractor ------------------------------------------------------------------------------------------


def test_a_circle_s_centre_is_pricked_off_by_half_a_line_and_its_radius_by_a_setting():
    hand = trembling(line=LINE, dividers=DIVIDERS)
    circle = hand.circle("circle", hand.given("centre", 2 + 3j), 20.0)
    assert_allclose([scatter(circle.points.real), scatter(circle.points.imag)], LINE / 2, rtol=WITHIN)
    assert_allclose(scatter(circle.radius), DIVIDERS, rtol=WITHIN)
    assert circle.radius.mean() == pytest.approx(20, abs=0.02)


def test_a_bisector_is_off_at_both_crossings_of_the_arcs_by_a_line_over_the_root_of_two():
    hand = trembling(line=LINE)
    line = hand.bisect("line", hand.given("a", 0j), hand.given("b", 10 + 0j))
    apart = 10 * math.sqrt(0.8**2 - 0.5**2)
    off = {}
    for side in (1, -1):  # where the bisector passes the height of a crossing
        off[side] = (line.points + line.directions * (side * apart - line.points.imag) / line.directions.imag).real - 5
        assert_allclose(scatter(off[side]), LINE / math.sqrt(2), rtol=WITHIN)
    assert abs(np.corrcoef(off[1], off[-1])[0, 1]) < WITHIN
    middle = exact().bisect("line", exact().given("a", 1 + 2j), exact().given("b", 5 + 8j))
    assert (middle.place, complex(middle.directions)) == (3 + 5j, -6 + 4j)


def test_an_angle_is_off_by_the_protractor_and_its_line_by_a_line():
    hand = trembling(line=LINE, protractor=ANGLE)
    line = hand.protractor("line", hand.given("vertex", 1j), 2 + 0j, math.radians(30))
    assert_allclose(scatter(np.angle(line.directions)), ANGLE, rtol=WITHIN)
    assert np.angle(line.directions).mean() == pytest.approx(math.radians(30), abs=3 * ANGLE / math.sqrt(SAMPLES))
    aside = ((line.points - 1j) * np.conj(line.directions / np.abs(line.directions))).imag
    assert_allclose(scatter(aside), LINE, rtol=WITHIN)


# --- curves ----------------------------------------------------------------------------------------------------------

PARABOLA = np.linspace(-3, 4, 8)


def test_a_tangent_touches_the_faired_curve_and_no_place_lies_beyond_it():
    hand = exact()
    curve = hand.given("curve", PARABOLA + 1j * (9 - PARABOLA**2))
    inward = np.exp(1j * math.radians(60))
    line = hand.tangent("tangent", curve, [slice(0, 8)], inward)
    # The slope of the tangent square to 60 degrees is -cot 60: x = cot(60)/2.
    x = 1 / math.tan(math.radians(60)) / 2
    assert line.place == pytest.approx(x + 1j * (9 - x**2))
    assert line.directions / inward == pytest.approx(1j)
    beyond = ((curve.points - line.points) * np.conj(inward)).real
    assert beyond.max() < 1e-12


def test_a_tangent_is_off_across_itself_by_a_line_and_takes_the_turn_of_what_it_is_square_to():
    hand = trembling(line=LINE, protractor=ANGLE)
    curve = hand.given("curve", PARABOLA + 1j * (9 - PARABOLA**2))
    leaning = hand.protractor("leaning", hand.given("a", 0j), UP, 0.0)
    line = hand.tangent("tangent", curve, [slice(0, 8)], leaning)
    assert_allclose(scatter(np.angle(line.directions / -1)), ANGLE, rtol=WITHIN)
    level = hand.tangent("level", curve, [slice(0, 8)], UP)
    assert_allclose(scatter(level.points.imag), LINE, rtol=WITHIN)


def test_tangents_by_a_mirror_are_off_by_an_angle():
    hand = trembling(protractor=ANGLE)
    curve = hand.given("curve", np.array([0j, 1 + 1j, 2 + 4j]))
    lines = hand.tangents_at("tangents", curve, lambda points: 1 + 2j * points.real)
    assert_allclose(scatter(np.angle(lines.directions)), np.full(3, ANGLE), rtol=WITHIN)
    assert_allclose(lines.directions.mean(axis=0), [1, 1 + 2j, 1 + 4j], atol=0.002)


def test_a_curve_is_faired_piece_by_piece_through_its_points():
    hand = exact()
    corner = hand.given("corner", np.array([0, 1 + 1j, 2 + 2j, 3 + 1j, 4 + 0j]))
    line = hand.fair("line", corner, [slice(0, 3), slice(2, 5)], parts=2).points
    assert_allclose(line, [0, 0.5 + 0.5j, 1 + 1j, 1.5 + 1.5j, 2 + 2j, 2 + 2j, 2.5 + 1.5j, 3 + 1j, 3.5 + 0.5j, 4])


# --- what lies there -------------------------------------------------------------------------------------------------


def test_one_goes_on_with_places_in_a_row_and_in_each_sample_with_its_own():
    hand = trembling()
    a, b = hand.given("a", 1 + 0j), hand.given("b", np.array([2 + 0j, 3 + 0j]))
    row = hand.take("row", a, b)
    assert_allclose(row.points[0], [1, 2, 3])
    which = np.arange(SAMPLES)[:, None] % 3
    assert_allclose(hand.take("own", row, which=which).points[:4], [[1], [2], [3], [1]])
    assert_allclose(hand.take("ends", row, which=[0, 2]).points[5], [1, 3])


def test_what_is_shown_in_another_view_is_enlarged_turned_and_moved():
    hand = exact()
    places = hand.enlarged("view", hand.given("p", np.array([2 + 0j, 3 + 1j])), hand.given("o", 1 + 0j), 2j, to=10)
    assert_allclose(places.points, [10 + 2j, 8 + 4j])
    raised = hand.raised("raised", places, distance_between(hand.given("a", 0j), hand.given("b", 5j)))
    assert_allclose(raised.points, [10 + 7j, 8 + 9j])


def test_a_mirror_image_lies_as_far_beyond_the_line_and_has_its_lines_and_radii():
    hand = exact()
    axis = hand.given("axis", 1 + 0j, 2 + 2j)
    lines = hand.mirrored("lines", hand.given("l", np.array([3 + 0j, 1 + 0j]), np.array([1 + 0j, 1 + 1j])), axis)
    assert_allclose(lines.points, [1 + 2j, 1 + 0j], atol=1e-12)
    assert_allclose(lines.directions, [1j, 1 + 1j], atol=1e-12)
    circle = hand.mirrored("circle", hand.circle("c", hand.given("o", 5 + 1j), 3.0), axis)
    assert_allclose(circle.points, 2 + 4j)
    assert circle.radius == 3.0


def test_a_length_is_read_along_a_line_in_its_direction():
    hand = exact()
    a, b = hand.given("a", 0j), hand.given("b", np.array([5 + 5j, -1 + 0j]))
    assert_allclose(distance_between(a, b, hand.given("line", 9j, 3 + 4j)).amount, [7.0, -0.6])


# --- readings --------------------------------------------------------------------------------------------------------


def test_a_length_is_rounded_to_the_division_once_when_it_is_read():
    hand = Hand(Pencil(division=0.5), MEANING, "rad")
    setting = distance_between(hand.given("a", 0j), hand.given("b", 7.3j))
    assert hand.read("length", setting, 2.0).paper == 7.5
    assert hand.readings["length"].unit == "rad"
    assert hand.read("length", setting, 2.0, rounded=False).paper == 7.3
    assert hand.read("length", setting, 2.0, "mm").unit == "mm"


def test_a_rounded_reading_is_the_nearest_division():
    hand = Hand(Pencil(division=0.5), MEANING)
    lengths = np.linspace(0, 50, 1001)
    ends = hand.lay_off("ends", hand.given("start", np.zeros(lengths.size)), UP, lengths)
    read = hand.read("length", distance_between(hand.given("foot", 0j), ends, UP), 1.0).paper
    assert np.abs(read - lengths).max() <= 0.25 + 1e-12
    assert_allclose(read * 2, np.round(read * 2))


def test_the_errors_of_the_same_act_grow_with_the_pencil():
    thin, thick = (
        Hand(Pencil(line=sigma, seed=3), MEANING).erect("line", exact().given("feet", np.zeros(9))).points
        for sigma in (0.1, 0.4)
    )
    assert_allclose(thick, 4 * thin, rtol=1e-14)


def test_an_angle_is_measured_in_its_sense_and_off_by_the_protractor():
    hand = trembling(protractor=ANGLE)
    line = hand.given("line", 0j, along=np.exp(1j * np.array([0.3, -0.4])))
    angle = hand.angle("angle", hand.given("base", 0j, along=1), line, sense=-1)
    assert_allclose(angle.paper.mean(axis=0), [-0.3, 0.4], atol=3 * ANGLE / math.sqrt(SAMPLES))
    assert_allclose(scatter(angle.paper), ANGLE, rtol=WITHIN)
    assert (angle.unit, angle.scale) == ("rad", 1.0)


# --- the record ------------------------------------------------------------------------------------------------------


def test_an_act_says_with_what_from_where_and_at_which_stations():
    hand = exact()
    start = hand.given("start", np.array([0j, 1 + 0j]))
    end = hand.lay_off("end", start[1], UP, 5.0)
    assert (end.act.kind, end.act.kind.instrument, end.act.construction) == (Kind.LAY_OFF, "dividers", "example")
    assert end.act.takes["start"].whole is start
    assert end.act.takes["start"].at == 1
    assert end.act.takes["length"] == 5.0
    assert list(hand.acts) == ["start", "end"]
    assert hand.read("length", distance_between(start[1], end), 1.0).act.kind is Kind.READ


def test_the_errors_depend_on_the_seed_and_the_construction_alone():
    def errors(seed: int, name: str) -> np.ndarray:
        hand = Hand(Pencil(line=LINE, samples=3, seed=seed), Meaning(name, say("T"), say("W.")))
        return hand.erect("line", hand.given("foot", 0j)).points

    assert_allclose(errors(1, "a"), errors(1, "a"), rtol=0)
    assert np.abs(errors(1, "a") - errors(2, "a")).min() > 1e-6
    assert np.abs(errors(1, "a") - errors(1, "b")).min() > 1e-6


def test_every_sample_has_its_own_place_before_the_stations():
    hand = Hand(Pencil(samples=4), MEANING)
    place, stations = hand.given("place", 1j), hand.given("stations", np.arange(3.0))
    assert (place.points.shape, stations.points.shape) == ((4,), (4, 3))
    assert hand.join("lines", place, stations).directions.shape == (4, 3)
    assert hand.circle("circles", place, np.array([1.0, 2.0])).radius.shape == (4, 2)
    assert hand.protractor("rays", place, RIGHT, np.array([0.1, 0.2])).directions.shape == (4, 2)
    assert stations[1].first.place == 1
