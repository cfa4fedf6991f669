"""Tags in pictures: which are found, where their corners are, and in what order."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from photographed import CORNERS, Camera, page_of, photograph

from graphcam.photo.tags import find_tags

pytestmark = pytest.mark.slow

PAGE = page_of(200.0, 150.0, 3, 2)
SIZE = (1600, 1200)


def camera_of(page=PAGE, tilt=(12.0, -8.0, 5.0), size=SIZE):
    return Camera(page, tilt, size, lens=(0, 0))


def true_corners(camera, numbers):
    corners = np.array([camera.page.tags[number] for number in numbers.tolist()])[:, None]
    return camera.pixels((corners + camera.page.tag_side * CORNERS).ravel()).reshape(-1, 4)


@pytest.mark.parametrize("quarter", range(4))
def test_corners_are_in_order_however_the_paper_is_turned(quarter):
    camera = camera_of()
    found = find_tags(np.ascontiguousarray(np.rot90(photograph(camera), quarter)))
    assert found.numbers.tolist() == sorted(PAGE.tags)
    wanted = true_corners(camera, found.numbers)
    for _ in range(quarter):
        # A quarter against the clock: the column becomes the row from below.
        wide = SIZE[0] if _ % 2 == 0 else SIZE[1]
        wanted = wanted.imag + 1j * (wide - 1 - wanted.real)
    assert np.abs(found.corners - wanted).max() < 0.5


@pytest.mark.parametrize(
    ("shot", "most"),
    [
        ({}, 0.05),
        ({"blur": 2.0}, 0.1),
        ({"blur": 0.6, "quality": 60}, 0.1),
        ({"noise": 0.04, "quality": 80}, 0.1),
        # The white cells shine over the black rim.
        ({"blur": 2.6}, 0.35),
    ],
)
def test_tags_are_where_they_are_whatever_blurs_them(shot, most):
    camera = camera_of()
    found = find_tags(photograph(camera, **shot))
    assert len(found) == len(PAGE.tags)
    misses = found.corners - true_corners(camera, found.numbers)
    # All edges may move out a little, as paper shines over; that moves no middle.
    assert np.abs(misses.mean(axis=1)).max() < most
    assert np.abs(misses).max() < 0.3 + 2 * most


def test_the_edges_widths_tell_the_blur():
    camera = camera_of(tilt=(0.0, 0.0, 0.0))
    widths = {blur: np.median(find_tags(photograph(camera, blur=blur, quality=95)).widths) for blur in (1.0, 2.0, 3.0)}
    for blur, width in widths.items():
        # 1.68 standard deviations from a fifth to four fifths; pixels blur a little too.
        assert width == pytest.approx(1.683 * np.hypot(blur, 0.4), rel=0.1)


def test_motion_blurs_edges_across_it():
    picture = photograph(camera_of(tilt=(0.0, 0.0, 0.0)), blur=0.7)
    moved = find_tags(cv2.blur(picture, (9, 1)))
    below, right, above, left = np.median(moved.widths, axis=0)
    assert min(left, right) > 2 * max(below, above)


def test_a_number_that_is_there_twice_is_nobodys():
    camera = camera_of(tilt=(0.0, 0.0, 0.0))
    picture = photograph(camera)
    corners = true_corners(camera, np.array([0, 2]))
    size = int(np.abs(corners[0, 1] - corners[0, 0])) + 24
    places = [(int(c.real.min()) - 12, int(c.imag.min()) - 12) for c in corners]
    (from_x, from_y), (to_x, to_y) = places
    picture[to_y : to_y + size, to_x : to_x + size] = picture[from_y : from_y + size, from_x : from_x + size]
    assert find_tags(picture).numbers.tolist() == [1, 3, 4, 5]


def test_a_finger_hides_a_tag_or_leaves_it_where_it_is():
    camera = camera_of(tilt=(0.0, 0.0, 0.0))
    wanted = true_corners(camera, np.arange(6))
    for part in (0.15, 0.3, 0.6, 0.9):
        picture = photograph(camera)
        low = wanted[3].imag.max()
        reach = part * np.abs(wanted[3, 2] - wanted[3, 1])
        cv2.circle(picture, (int(wanted[3].real.mean()), int(low + 60 - reach)), 60, 150, -1)
        found = find_tags(picture)
        assert set(found.numbers.tolist()) >= {0, 1, 2, 4, 5}
        assert np.abs(found.corners - wanted[found.numbers]).max() < 1.5


def test_small_and_large_tags_are_found():
    for size in ((640, 480), (4000, 3000)):
        camera = camera_of(size=size)
        found = find_tags(photograph(camera))
        assert len(found) == len(PAGE.tags)
        assert np.abs(found.corners - true_corners(camera, found.numbers)).max() < 0.6


def test_there_are_no_tags_in_other_pictures():
    random = np.random.default_rng(0)
    pictures = [
        np.full((300, 400), 200, np.uint8),
        random.integers(0, 255, (300, 400), np.uint8),
        np.kron(random.integers(0, 2, (60, 80)), np.full((20, 20), 255)).astype(np.uint8),
        np.zeros((1, 1), np.uint8),
        np.zeros((3, 2000), np.uint8),
        photograph(camera_of())[:, ::-1].copy(),
    ]
    for picture in pictures:
        tags = find_tags(picture)
        assert len(tags) == 0
        assert tags.corners.shape == tags.widths.shape == (0, 4)
