"""Parts of the paper made even: places, light, and the map that is enlarged."""

from __future__ import annotations

import time

import cv2
import numpy as np
import pytest
from photographed import FINE, Camera, drawn, folded, page_of, photograph, rolled

from graphcam.photo.rectify import EvenPicture, lookup_maps, rectify, sampled
from graphcam.photo.registration import register
from graphcam.photo.tags import find_tags

pytestmark = pytest.mark.slow

PAGE = page_of()
DOTS = (np.linspace(60, 360, 7) + 1j * np.linspace(50, 250, 5)[:, None]).ravel()


def with_dots(page):
    """The page with round dots of 1.5 mm across."""
    paper = drawn(page)
    rows, columns = np.indices(paper.shape, sparse=True)
    x, y = (columns + 0.5) / FINE, page.height - (rows + 0.5) / FINE
    for dot in DOTS:
        near = np.abs(x[0] - dot.real) < 2, np.abs(y[:, 0] - dot.imag) < 2
        distance = np.hypot(x[:, near[0]] - dot.real, y[near[1]] - dot.imag)
        paper[np.ix_(near[1], near[0])] -= 0.7 * np.clip((0.75 - distance) * FINE + 0.5, 0, 1)
    return paper


def test_places_and_pixels_are_each_others_inverse():
    flat = EvenPicture(np.zeros((40, 80, 3), np.float32), (10.0, 20.0, 20.0, 25.0), 8.0)
    assert flat.pixels(10 + 25j) == -0.5 - 0.5j
    assert flat.pixels(20 + 20j) == 79.5 + 39.5j
    assert flat.points(0j) == pytest.approx(10.0625 + 24.9375j)
    points = np.array([[11 + 21j, 19 + 24j]])
    assert np.allclose(flat.points(flat.pixels(points)), points)


def test_light_between_pixels_is_in_between():
    image = np.arange(12.0, dtype=np.float32).reshape(3, 4, 1)
    places = np.array([[1 + 1j, 1.5 + 1j], [0.25 + 0.5j, 99 + 99j]])
    assert np.allclose(sampled(image, places)[..., 0], [[5, 5.5], [2.25, 11]], atol=0.02)


@pytest.mark.parametrize("size", [(4000, 3000), (2592, 1944)])
def test_dots_are_where_they_were_printed(size):
    camera = Camera(PAGE, (14.0, -12.0, 4.0), size, (0, 0))
    grey = photograph(camera, with_dots(PAGE))
    picture = cv2.cvtColor(grey, cv2.COLOR_GRAY2BGR)
    registration = register(find_tags(grey), PAGE, size)
    flat = rectify(picture, registration, (30.0, 30.0, 390.0, 267.0))
    assert flat.linear.shape == (237 * 8, 360 * 8, 3)
    assert flat.linear.dtype == np.float32
    near = (np.linspace(-1.5, 1.5, 61) + 1j * np.linspace(-1.5, 1.5, 61)[:, None]).ravel()
    for dot in DOTS:
        light = flat.at(dot + near)[:, 1]
        dark = np.clip(light.max() - light - 0.1, 0, None)
        assert abs((dark * near).sum() / dark.sum()) < 0.03
    white = flat.at(np.array([35 + 35j, 200 + 100j, 385 + 262j]))
    assert np.allclose(white, 0.8, atol=0.08)


def test_colours_come_in_their_order_and_as_light():
    camera = Camera(PAGE, (0.0, 0.0, 0.0), lens=(0, 0))
    registration = register(camera.tags(), PAGE, camera.size)
    picture = np.empty((3000, 4000, 3), np.uint8)
    picture[...] = 255, 188, 0
    flat = rectify(picture, registration, (100.0, 100.0, 110.0, 105.0))
    assert flat.linear.shape == (40, 80, 3)
    assert np.allclose(flat.linear, [0.0, 0.503, 1.0], atol=0.002)


@pytest.mark.parametrize(
    ("bend", "most"),
    [(None, 0.003), (rolled(8.0, 30.0, 420.0), 0.02), (folded(20.0, 0.3, 15), 0.5)],
    ids=["flat", "rolled", "folded"],
)
def test_the_enlarged_map_is_the_map(bend, most):
    camera = Camera(PAGE, (14.0, -12.0, 4.0)) if bend is None else Camera(PAGE, (14.0, -12.0, 4.0), bend=bend)
    registration = register(camera.tags(), PAGE, camera.size)
    box = (100.0, 50.0, 320.0, 250.0)
    column, row = lookup_maps(registration, box, 4.0)
    flat = EvenPicture(np.zeros((*column.shape, 3), np.float32), box, 4.0)
    rows, columns = np.mgrid[: column.shape[0] : 7, : column.shape[1] : 7]
    places = registration.pixels(flat.points(columns + 1j * rows))
    off = np.abs(column[::7, ::7] + 1j * row[::7, ::7] - places)
    assert off.max() < most
    # At a fold, within a mm of it.
    assert np.percentile(off, 95) < 0.01


def test_a_box_costs_little():
    camera = Camera(PAGE, lens=(0, 0))
    registration = register(camera.tags(), PAGE, camera.size)
    picture = np.full((3000, 4000, 3), 200, np.uint8)
    started = time.process_time()
    rectify(picture, registration, (80.0, 20.0, 340.0, 280.0))
    assert time.process_time() - started < 0.5


def test_what_lies_outside_of_the_picture_looks_like_its_edge():
    camera = Camera(PAGE, (0.0, 0.0, 0.0), lens=(0, 0))
    registration = register(camera.tags(), PAGE, camera.size)
    picture = np.full((3000, 4000, 3), 255, np.uint8)
    flat = rectify(picture, registration, (-60.0, -60.0, 20.0, 20.0), 2.0)
    assert np.isfinite(flat.linear).all()
    assert flat.linear.min() == 1.0
