"""Pencil is told from light print, whatever the light, the camera and the printer."""

import numpy as np
import pytest
from numpy.typing import NDArray
from photo.drawn_flats import Camera, Sheet, cam, circle, profile_sheet

from graphcam.photo.pencil_ink import Ink, ink_of

HALF_A_PIXEL = 0.06
"""mm."""


def crest(ink: Ink, places: NDArray[np.complex128]) -> float:
    """The median density on places less that beside them, 1 mm to the right."""
    return float(np.median(ink.at(places) - ink.at(places + 1)))


@pytest.fixture
def sheet() -> Sheet:
    return profile_sheet()


@pytest.mark.parametrize(("ink", "camera"), [("colour", Camera()), ("grey", Camera()), ("colour", Camera(grey=True))])
def test_print_vanishes_and_pencil_stays(ink: str, camera: Camera) -> None:
    sheet = profile_sheet(ink)
    pencil = circle(40, 10, 80)
    sheet.stroke(pencil, "2H")
    read = ink_of(sheet.flat(camera), sheet.page())
    drawn = crest(read, sheet.origin + pencil)
    left = abs(crest(read, sheet.origin + circle(28, 10, 80)))
    assert drawn > 6 * left
    assert drawn > 10 * read.noise


def test_pencil_over_print_is_as_dark_as_beside_it(sheet: Sheet) -> None:
    for radius in (28.0, 40.0):
        sheet.stroke(circle(radius, 10, 80))
    read = ink_of(sheet.flat(), sheet.page())
    over, beside = (crest(read, sheet.origin + circle(radius, 10, 80)) for radius in (28.0, 40.0))
    assert over == pytest.approx(beside, rel=0.15)


def test_the_white_balance_makes_no_difference() -> None:
    found: list[float] = []
    for cast in ((0.9, 0.9, 0.9), (1.05, 0.9, 0.6)):
        sheet = profile_sheet(seed=3)
        sheet.stroke(circle(40, 10, 80))
        found.append(crest(ink_of(sheet.flat(Camera(cast=cast)), sheet.page()), sheet.origin + circle(40, 10, 80)))
    assert found[0] == pytest.approx(found[1], rel=0.1)


def test_the_colour_of_the_print_is_found_without_a_patch_in_sight(sheet: Sheet) -> None:
    there = ink_of(sheet.flat(), sheet.page())
    patches = sheet.flat()
    sheet.patches[:] = [300 + 200j]
    lines_only = ink_of(sheet.flat(), sheet.page())
    assert lines_only.residue < 2 * there.residue + 0.01
    sheet.patches[:] = [32 + 22j]
    elsewhere = ink_of(sheet.flat(), sheet.page(), patches=[patches])
    assert elsewhere.residue < 2 * there.residue + 0.01


def test_black_print_hides(sheet: Sheet) -> None:
    sheet.print_black((-20, 30, 0, 36))
    sheet.stroke(np.array([-30 + 33j, 30 + 33j]))
    read = ink_of(sheet.flat(), sheet.page())
    places = sheet.origin + np.array([-10 + 33j, 20 + 33j])
    assert read.black.at(places, nearest=True).tolist() == [1, 0]
    assert read.at(places)[0] == 0
    assert read.at(places)[1] > 0.3


def test_sharp_places_are_where_the_line_is(sheet: Sheet) -> None:
    curve = cam()
    sheet.stroke(curve, "2H")
    read = ink_of(sheet.flat(), sheet.page())
    across = np.arange(-0.6, 0.65, 0.05)
    places = sheet.origin + curve[::10]
    profile = read.sharp.at(places[:, None] * 1 + (curve[::10] / np.abs(curve[::10]))[:, None] * across)
    assert abs(float(across[np.median(profile, 0).argmax()])) <= HALF_A_PIXEL


def test_beside_print_is_within_a_mm_of_it(sheet: Sheet) -> None:
    read = ink_of(sheet.flat(), sheet.page())
    at = sheet.origin + np.exp(0.7j) * np.array([28.0, 28.5, 30.0, 9.2])
    assert read.beside_print(at).tolist() == [True, True, False, True]
