"""Straight lines and their crossings, with arcs, digits and gaps about."""

import numpy as np
import pytest
from photo.drawn_flats import circle, profile_sheet

from graphcam.photo.pencil_ink import ink_of
from graphcam.photo.pictures import PhotographError
from graphcam.photo.straight_lines import Segment, crossing, read_lines

pytestmark = pytest.mark.slow

PLACE = 0.1
"""mm, of a ruled line."""
CROSSING = 0.2
RAYS = [(10 * np.exp(1j * a), 45 * np.exp(1j * (a + 0.15))) for a in np.radians([12, 48, 80, 131, 170, 215, 260, 318])]


def off(segment: Segment, start: complex, end: complex) -> float:
    """The greater distance of a segment's ends from the line through two points."""
    ahead = (end - start) / abs(end - start)
    return max(abs(((place - start) * np.conj(ahead)).imag) for place in (segment.start, segment.end))


@pytest.fixture(scope="module")
def found() -> list[Segment]:
    sheet = profile_sheet()
    for ray in RAYS:
        sheet.stroke(np.array(ray), "fine")
    sheet.by_hand(circle(36))
    for k in range(6):
        sheet.write(str(k), 46 * np.exp(1j * k))
    return read_lines(ink_of(sheet.flat(), sheet.page()), sheet.view)


@pytest.mark.parametrize("ray", RAYS)
def test_every_ray_is_found(found: list[Segment], ray: tuple[complex, complex]) -> None:
    best = min(found, key=lambda segment: off(segment, *ray))
    assert off(best, *ray) < PLACE
    assert best.length == pytest.approx(abs(ray[1] - ray[0]), abs=2.5)
    assert best.cover > 0.9


def test_arcs_and_print_are_no_lines(found: list[Segment]) -> None:
    assert len(found) == len(RAYS)
    assert [segment.length for segment in found] == sorted((segment.length for segment in found), reverse=True)


def test_crossings_lie_where_the_rulers_cross(found: list[Segment]) -> None:
    segments = [min(found, key=lambda segment: off(segment, *ray)) for ray in RAYS]
    for one, other in ((0, 2), (1, 3), (4, 6)):
        wanted = crossing(Segment(*RAYS[one], 1.0), Segment(*RAYS[other], 1.0))
        assert abs(crossing(segments[one], segments[other]) - wanted) < CROSSING


def test_a_gap_ends_a_line() -> None:
    sheet = profile_sheet()
    sheet.stroke(np.array([-45 + 20j, -12 + 20j]))
    sheet.stroke(np.array([-4 + 20j, 45 + 20j]))
    lengths = [segment.length for segment in read_lines(ink_of(sheet.flat(), sheet.page()), sheet.view)]
    assert lengths == pytest.approx([49, 33], abs=1.5)


def test_a_dashed_line_makes_no_crossing() -> None:
    sheet = profile_sheet()
    for x in np.arange(-40, 40, 5.4):
        sheet.stroke(np.array([x + 15j, x + 2.4 + 15j]))
    sheet.stroke(np.array([-20 - 30j, 15 + 40j]))
    lines = read_lines(ink_of(sheet.flat(), sheet.page()), sheet.view)
    dashed = [line for line in lines if abs(line.start.imag - 15) < 1 and abs(line.end.imag - 15) < 1]
    for line in dashed:
        with pytest.raises(PhotographError, match="% of a line"):
            crossing(line, Segment(0j, 30j, 1.0))


def test_lines_that_are_nearly_parallel_make_no_crossing() -> None:
    with pytest.raises(PhotographError, match="cross at 11°"):
        crossing(Segment(0j, 10 + 0j, 1.0), Segment(0j, 10 + 2j, 1.0))


def test_an_empty_sheet_has_none() -> None:
    sheet = profile_sheet()
    sheet.stroke(circle(20))
    assert read_lines(ink_of(sheet.flat(), sheet.page()), sheet.view) == []
