"""What every diagram over the cam angle has drawn about it: axes, limits of the phases, degrees, names of stations."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from boards import coursework_motion
from numpy.testing import assert_allclose
from over_all import over_all

import graphcam as gc
from graphcam.constructions.axes import (
    AXIS_OVERHANG,
    DEGREES_ROOM,
    axes_over_phi,
    degree_ticks,
    degrees_below,
    first_at_height,
    joined_parts,
    number_labels,
    numbered_stations,
    part_names,
    phase_symbol,
    phases_below,
    phi_axes,
    station_names,
)
from graphcam.constructions.graduation import (
    close_ends_caption,
    coinciding_heights,
    graduation_marks,
    ray_numbers,
)
from graphcam.drafting.hand import Hand
from graphcam.drafting.ink import say
from graphcam.drafting.marks import Arrow, Dimension, Label, Role, Segments
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.stations import divide

MOTION = coursework_motion("3-4-5")
DEGREE = gc.Scale(math.radians(1), "rad")
HALF_A_DEGREE, TWO_DEGREES, TWO_AND_A_HALF, SIX = (gc.Scale(math.radians(n), "rad") for n in (0.5, 2, 2.6, 6))


def hand() -> Hand:
    return Hand(Pencil(), Meaning("board", say("Board"), say("Something is drawn.")))


@over_all("heights", [[3.0, -20.0, 11.0], [5.0, 7.0], [-5.0, -7.0], [np.nan, 4.0]])
def test_the_axes_reach_over_all_heights_and_the_axis_itself_and_are_named_at_their_heads(heights):
    across, up, ticks, phi, symbol, mu = axes_over_phi(90.0, TWO_DEGREES, np.array(heights), "v, mm/rad")
    assert isinstance(across, Arrow)
    assert (across.start, across.end, across.role) == (0, 90 + AXIS_OVERHANG, Role.SCALE)
    lowest, highest = min(0, np.nanmin(heights)), max(0, np.nanmax(heights))
    assert (up.start, up.end, up.role) == (lowest * 1j, (highest + AXIS_OVERHANG) * 1j, Role.SCALE)
    assert (phi.at, str(phi.text), symbol.at, symbol.text) == (across.end, "φ, °", up.end, "v, mm/rad")
    assert (phi.towards, symbol.towards) == (-1j, -1 - 1j)
    assert (mu.at, str(mu.text), mu.small) == (90, "μᵩ = 0.03491 rad/mm (2°/mm)", True)
    assert mu.towards.real < 0
    assert_allclose(ticks.starts.real, np.arange(10, 181, 10) / 2)


@over_all("scale", [DEGREE, HALF_A_DEGREE])
def test_a_thin_line_stands_where_each_phase_ends_from_the_lowest_to_the_highest(scale):
    stations = divide(MOTION, 4)
    marks = phi_axes(MOTION, stations, scale, np.array([-10.0, 25.0]), "a")
    limits, strokes = (mark for mark in marks if isinstance(mark, Segments))
    # The axis has strokes at the stations; degrees stand below the lowest diagram.
    assert_allclose(strokes.starts.real, stations.phi / scale.per_mm)
    ends = np.array([80, 125, 185, 360]) * math.radians(1) / scale.per_mm
    assert_allclose(limits.starts, ends - 10j)
    assert_allclose(limits.ends, ends + 25j)
    assert limits.role is Role.CONSTRUCTION
    assert marks[0].end == pytest.approx(ends[-1] + AXIS_OVERHANG)


ROOM = over_all(
    ("scale", "tick", "every"), [(DEGREE, 10, 30), (HALF_A_DEGREE, 10, 10), (TWO_AND_A_HALF, 10, 60), (SIX, 30, 90)]
)


@ROOM
def test_strokes_cross_the_axis_where_degrees_are_numbered_below_the_lowest_diagram(scale, tick, every):
    end = 360 * math.radians(1) / scale.per_mm
    strokes, degrees = degree_ticks(end, scale), np.arange(tick, 361, tick)
    x = degrees * math.radians(1) / scale.per_mm
    assert_allclose(strokes.starts, x + 0.8j * (degrees % every == 0))
    assert_allclose(strokes.ends, x - 0.8j)
    assert strokes.role is Role.SCALE


@ROOM
def test_degrees_are_numbered_on_a_line_below_the_lowest_diagram_where_they_have_room(scale, tick, every):
    end = 360 * math.radians(1) / scale.per_mm
    line, strokes, *labels = degrees_below(end, scale, -20.0)
    assert_allclose(line.points, [-27j, end - 27j])
    degrees = np.arange(0, 361, tick)
    assert_allclose(strokes.starts, degrees * math.radians(1) / scale.per_mm - 27j)
    assert_allclose((strokes.starts - strokes.ends).imag, np.where(degrees % every, 1.0, 1.8))
    assert [str(label.text) for label in labels] == [f"{n}°" for n in range(0, 361, every)]
    assert_allclose([label.at for label in labels], strokes.ends[degrees % every == 0])
    assert {label.towards for label in labels} == {-1j}
    assert all(label.small for label in labels)
    assert np.diff([label.at.real for label in labels]).min() >= DEGREES_ROOM


@over_all("scale", [DEGREE, HALF_A_DEGREE])
def test_the_dimensions_of_the_phases_below_the_degrees_add_up_to_the_turn(scale):
    dimensions = [mark for mark in phases_below(MOTION, scale, -20.0) if isinstance(mark, Dimension)]
    assert [str(mark.text) for mark in dimensions] == ["φ₁ = 80°", "φ₂ = 45°", "φ₃ = 60°", "φ₄ = 175°"]
    assert {mark.start.imag for mark in dimensions} == {mark.end.imag for mark in dimensions} == {-46.0}
    assert [a.end == b.start for a, b in pairwise(dimensions)] == [True] * 3
    assert dimensions[-1].end.real * scale.per_mm == pytest.approx(math.tau)


@over_all("right", [None, 360.0])
@over_all(
    ("low", "high", "per_mm", "every", "parts"),
    [
        (0, 50, 0.6, 10, 5),
        (-66, 50, 0.8594, 10, 5),
        (-80, 80, 0.4852, 5, 5),
        (0, 56, 0.004654, 0.05, 5),
        (0, 8, 1, 5, 1),
    ],
)
def test_an_ordinate_axis_has_round_values_away_from_the_rays(low, high, per_mm, every, parts, right):
    strokes, *labels = graduation_marks(np.array([low, high]), per_mm, right)
    at, out = (0, -1) if right is None else (right, 1)
    assert_allclose(strokes.starts.real, at)
    counts = strokes.starts.imag * per_mm * parts / every
    assert_allclose(counts, np.round(counts), atol=1e-9)  # a stroke at each part of the step, and none at the axis
    assert sorted([*np.round(counts), 0]) == list(range(round(counts.min()) * (low < 0), round(counts.max()) + 1))
    assert low <= strokes.starts.imag.min()
    assert high - every / parts / per_mm < strokes.starts.imag.max() <= high
    for label in labels:
        assert label.at.imag * per_mm == pytest.approx(float(str(label.text)))
        assert (label.at.real, label.towards) == (pytest.approx(at + 1.8 * out), out)
    assert [float(str(label.text)) for label in labels] == pytest.approx(
        [n * every for n in range(math.ceil(low * per_mm / every), math.floor(high * per_mm / every) + 1) if n]
    )
    assert every / per_mm >= (10 if high > 20 else 5)


def test_the_ordinates_of_an_arm_are_graduated_in_degrees():
    """15 degrees are 56.25 mm high: every 5 degrees a number, 18.75 mm apart."""
    _, *labels = graduation_marks(np.array([0.0, 56.25]), math.radians(15) / 56.25, lift_unit="rad")
    assert [str(label.text) for label in labels] == ["5°", "10°", "15°"]
    assert [label.at.imag for label in labels] == pytest.approx([18.75, 37.5, 56.25])


def test_stations_are_named_at_their_places_in_their_directions_and_know_the_act_that_left_them():
    stations = divide(MOTION, 6)
    places = np.arange(14) * (10 + 1j)
    towards = np.where(np.arange(14) % 2, 1j, -1j)
    left = hand().given("places", places)
    labels = number_labels(left, stations, towards)
    names = station_names(stations)
    assert [label.text for label in labels] == names == [*"0123456", *(f"{k}′" for k in range(7))]
    assert_allclose([label.at for label in labels], places)
    assert_allclose([label.towards for label in labels], towards)
    assert all(label.small and label.of is left.act for label in labels)
    shown = np.arange(14) > 3
    assert [label.text for label in number_labels(left, stations, 1j, shown)] == names[4:]
    assert {label.towards for label in number_labels(left, stations, 1j, shown)} == {1j}


def test_where_stations_stand_close_every_second_or_third_is_named_and_both_ends_of_a_phase():
    stations = divide(MOTION, 12)
    for apart, every in ((7.0, 1), (3.1, 2), (2.1, 3)):
        labels = number_labels(hand().given("places", np.arange(26) * apart + 0j), stations, 1j)
        named = [int(str(label.text)) for label in labels if not str(label.text).endswith("′")]
        assert named == [*range(0, 12, every), 12]
        assert min(np.diff(named)) * apart >= 6


def test_heights_that_fall_on_one_another_are_found_together_from_the_lowest():
    heights = hand().given("heights", np.array([3, 1, 3.0001, -2, 1.0]) * 1j)
    assert [group.tolist() for group in coinciding_heights(heights)] == [[3], [1, 4], [0, 2]]


def test_of_equal_heights_the_first_stands_for_all_in_every_sample():
    heights = np.array([[3.0, 1.0, 3.0 + 1e-12, -2.0, 1.0], [5.0, 4.0, 3.0, 2.0, 5.0]])
    assert first_at_height(heights).tolist() == [[0, 1, 0, 3, 1], [0, 1, 2, 3, 0]]
    assert first_at_height(heights[0]).tolist() == [0, 1, 0, 3, 1]
    assert first_at_height(np.array([1.0, 1.0 + 1e-8])).tolist() == [0, 1]


def test_every_ray_is_numbered_those_that_end_close_together_side_by_side():
    ends = hand().given("ends", np.array([5.9, 6.0, 13.0, 20.0, 22.5, -6.5, 0.0, 15.4]) * 1j)
    rays = [[7], [0, 3], [1], [2], [4], [5], [6], [8]]
    labels = ray_numbers(ends, np.arange(8.0), rays, lambda some: " ".join(map(str, some)))
    assert [label.text for label in labels] == ["5", "6", "0 3 7", "1 8", "2", "4"]
    assert [label.at for label in labels] == [-6.5j, 0j, 6j, 15.4j, 20j, 22.5j]
    assert [label.along for label in labels] == [5.0, 6.0, 1.0, 7.0, 3.0, 4.0]
    assert all(label.small and label.of is ends.act for label in labels)
    (said,) = close_ends_caption(ends)
    assert "less than 2.5 mm apart" in str(said)
    assert close_ends_caption(ends[[0, 2]]) == ()


def test_neighbours_are_named_together_within_a_phase_only():
    stations = divide(MOTION, 6)
    assert part_names(stations) == [*"123456", *(f"{k}′" for k in range(1, 7))]
    assert joined_parts([3, 4, 5, 6, 7], stations) == "4-6, 1′, 2′"
    assert joined_parts([0, 2, 3, 11], stations) == "1, 3, 4, 6′"


@over_all("parts", [9, 10, 100])
@over_all("every", [1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30, 40, 50])
def test_the_stations_named_are_as_many_as_find_room_and_their_numbers_are_round(parts, every):
    """4.5 mm for one digit, 6 mm for two; of rounder steps the first that is wide enough."""
    turn = gc.Motion([gc.Rise(30, math.pi), gc.Return(30, math.pi)])
    room = 4.5 if parts < 10 else 6.0
    apart = room / every * (1 + 1e-9)
    named = [k for k in numbered_stations(apart * np.arange(2 * parts + 2) + 0j, divide(turn, parts)) if k <= parts]
    expected = [k for k in range(0, parts, every) if k == 0 or parts - k >= every] if every <= parts else [0]
    assert named == [*expected, parts]


def test_phases_of_one_kind_are_counted_among_themselves_where_there_are_several():
    """A school that names phases by their kind writes an index only where the kind comes again."""
    twice = gc.Motion([gc.Rise(10, 1.0), gc.Dwell(1.0), gc.Rise(20, 1.0), gc.Return(30, 2.0), gc.Dwell(math.tau - 5)])
    numbers_of = [phase_symbol(twice, k).values["number"] for k in range(5)]
    assert [number.index for number in numbers_of] == ["₁", "₂", "₃", "₄", "₅"]
    assert [number.again for number in numbers_of] == ["₁", "", "₂", "", ""]


def test_a_table_that_begins_elsewhere_in_the_turn_has_its_own_degrees_below():
    """Row 0 of a table is cam angle 0 of the cam: its numbers stand where its rows lie in the motion."""
    shift, phi = math.radians(37), np.radians(np.arange(0, 360, 2))
    s = gc.Motion([gc.Rise(20, 2.0), gc.Return(20, 2 * math.pi - 2.0)])(phi - shift).s
    motion, mu_phi = gc.measured_motion(phi, s, tolerance=0.01), Scale(math.radians(1), "rad")
    assert math.degrees(motion.origin) == pytest.approx(37, abs=0.5)
    lines = [mark for mark in phases_below(motion, mu_phi, -10.0) if isinstance(mark, Label) and mark.at.imag < -25]
    title, *numbers = sorted(lines, key=lambda mark: mark.at.real)
    assert str(title.text) == "φ as given"
    assert [str(mark.text) for mark in numbers] == [f"{n % 360 or n}°" for n in range(60, 391, 30)]
    assert_allclose([mark.at.real + math.degrees(motion.origin) for mark in numbers], range(60, 391, 30))
    # What stood below is so much lower; a motion that begins where its table does has no second line.
    given = gc.Motion(motion.phases)
    low = [
        [mark.start.imag for mark in phases_below(each, mu_phi, -10.0) if isinstance(mark, Dimension)]
        for each in (motion, given)
    ]
    assert_allclose(np.array(low[1]) - low[0], 12)
    assert all("given" not in str(mark.text) for mark in phases_below(given, mu_phi, -10.0) if isinstance(mark, Label))
