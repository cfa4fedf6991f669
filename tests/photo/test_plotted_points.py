"""Crosses, dots and rings are found, also on rays; digits and crossings of construction lines are none."""

import numpy as np
import pytest
from numpy.typing import NDArray
from photo.drawn_flats import Camera, Sheet, cam, circle, profile_sheet

from graphcam.photo.pencil_ink import ink_of
from graphcam.photo.plotted_points import Mark, PointReading, read_points

pytestmark = pytest.mark.slow

NEAR = 0.25
"""mm, of a point's place."""
SPOTS = 38 * np.exp(1j * np.radians(np.arange(20, 360, 40)))


def draw(sheet: Sheet, kind: Mark, places: NDArray[np.complex128], pen: str) -> None:
    for place in places:
        if kind == "cross":
            sheet.cross(place, pen)
        elif kind == "ring":
            sheet.stroke(place + circle(0.75), pen)
        else:
            sheet.stroke(place + circle(0.2), pen)


def read(sheet: Sheet, camera: Camera | None = None) -> PointReading:
    return read_points(ink_of(sheet.flat(camera), sheet.page()), sheet.view)


def assert_found(reading: PointReading, places: NDArray[np.complex128]) -> None:
    assert reading.points.size == places.size
    nearest = np.abs(reading.points[:, None] - places).min(0)
    assert nearest.max() < NEAR


@pytest.mark.parametrize("kind", ["cross", "dot", "ring"])
@pytest.mark.parametrize("pen", ["HB", "2H"])
def test_marks_in_the_open(kind: Mark, pen: str) -> None:
    sheet = profile_sheet()
    draw(sheet, kind, SPOTS, pen)
    reading = read(sheet)
    assert_found(reading, SPOTS)
    assert set(reading.kinds) == {kind}


@pytest.mark.parametrize("kind", ["cross", "dot", "ring"])
def test_marks_on_rays(kind: Mark) -> None:
    sheet = profile_sheet(seed=2)
    for place in SPOTS:
        sheet.stroke(np.array([place / 4, 1.25 * place]), "fine")
    draw(sheet, kind, SPOTS, "HB")
    reading = read(sheet)
    nearest = np.abs(reading.points[:, None] - SPOTS).min(0)
    assert (nearest < NEAR).sum() >= SPOTS.size - 1
    assert reading.points.size <= SPOTS.size


def test_crossings_of_construction_lines_are_no_marks() -> None:
    sheet = profile_sheet(seed=1)
    for place in SPOTS:
        sheet.stroke(np.array([place / 4, 1.2 * place]), "HB")
    for radius in (20.0, 34.0, 42.0):
        sheet.stroke(circle(radius), "HB")
    assert read(sheet).points.size <= 1


def test_curves_print_and_numbers_are_no_marks() -> None:
    sheet = profile_sheet()
    sheet.by_hand(cam())
    for k, place in enumerate(SPOTS):
        sheet.write(str(k), 1.3 * place)
    assert read(sheet).points.size <= 1


def test_the_surest_come_first_and_nothing_outside_the_room() -> None:
    sheet = profile_sheet()
    draw(sheet, "cross", SPOTS, "2H")
    sheet.cross(SPOTS[3], "HB")
    reading = read(sheet)
    assert (np.diff(reading.scores) <= 0).all()
    assert read_points(ink_of(sheet.flat(), sheet.page()), type(sheet.view)(0j, (0, 0, 1, 1), True)).points.size == 0


@pytest.mark.parametrize("kind", ["cross", "dot", "ring"])
def test_fainter_points_are_found_besides_the_sure_ones_and_take_no_place_from_them(kind: Mark) -> None:
    sheet = profile_sheet(seed=3)
    for place in SPOTS:
        sheet.stroke(np.array([place / 4, 1.25 * place]), "HB")
        sheet.stroke(place + circle(2.0)[:30], "HB")
    draw(sheet, kind, SPOTS, "2H")
    ink = ink_of(sheet.flat(), sheet.page())
    sure, more = read_points(ink, sheet.view), read_points(ink, sheet.view, less=0.2)
    assert sure.sure.all()
    assert sure.points.tolist() == more.points[more.sure].tolist()
    assert more.points.size > sure.points.size
