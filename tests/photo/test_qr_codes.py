"""QR codes in pictures: small, oblique, blurred, in shadow."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
import segno
from photographed import FINE, Camera, drawn, page_of, photograph

from graphcam.photo.qr_codes import codes_in
from graphcam.photo.tags import find_tags

pytestmark = pytest.mark.slow

TEXT = "GC1/inversion-translating/3f2a/17/0/1/9f3c2a77"
PAGE = page_of()


def with_code(module=0.75):
    """A page with a code at the lower right."""
    paper = drawn(PAGE)
    dark = np.array([list(row) for row in segno.make_qr(TEXT, error="m").matrix]) == 1
    size = round(module * FINE)
    cells = np.kron(dark, np.ones((size, size))) > 0
    top, left = round(180 * FINE), round(350 * FINE)
    paper[top : top + len(cells), left : left + len(cells)][cells] = 0.03
    return paper


@pytest.mark.parametrize(
    ("size", "tilt", "shot"),
    [
        ((4000, 3000), (0.0, 0.0, 0.0), {}),
        ((4000, 3000), (25.0, -20.0, 170.0), {"blur": 1.5}),
        ((4000, 3000), (10.0, 10.0, 90.0), {"blur": 2.2, "noise": 0.02}),
        ((2592, 1944), (15.0, -10.0, 0.0), {"quality": 80}),
        ((2592, 1944), (5.0, 5.0, 5.0), {"blur": 1.7}),
    ],
)
def test_codes_are_read(size, tilt, shot):
    picture = photograph(Camera(PAGE, tilt, size, (0, 0)), with_code(), **shot)
    assert codes_in(picture, find_tags(picture)) == [TEXT]


def test_tags_help_where_the_code_is_blurred():
    read = []
    for seed in range(4):
        camera = Camera(PAGE, (8.0, -12.0, 3.0), (2592, 1944), (0, 0))
        picture = photograph(camera, with_code(), blur=1.9, seed=seed)
        read.append((bool(codes_in(picture)), bool(codes_in(picture, find_tags(picture)))))
    alone, helped = np.sum(read, axis=0)
    assert helped >= alone
    assert helped >= 3


def test_a_shadow_hides_no_code():
    picture = photograph(Camera(PAGE, (5.0, 5.0, 2.0), lens=(0, 0)), with_code())
    shade = np.linspace(1.0, 0.2, picture.shape[1])
    assert codes_in((picture * shade).astype(np.uint8)) == [TEXT]


def test_colours_and_no_codes():
    picture = photograph(Camera(PAGE, (0.0, 0.0, 0.0), lens=(0, 0)), with_code())
    assert codes_in(cv2.cvtColor(picture, cv2.COLOR_GRAY2BGR)) == [TEXT]
    blank = np.full((300, 400), 200, np.uint8)
    assert codes_in(blank) == codes_in(blank, find_tags(blank)) == []
    assert codes_in(np.zeros((1, 1), np.uint8)) == []


def test_the_code_of_a_second_sheet_is_found_in_the_whole_picture():
    """In the reduced one only the nearer sheet's code is large enough; that there are two the doubled tags tell."""
    camera = Camera(PAGE, (0.0, 0.0, 0.0), (2600, 1950), (0, 0))
    one = photograph(camera, with_code())
    other = np.array([list(row) for row in segno.make_qr("GC1/another/sheet", error="m").matrix]) == 1
    small = np.where(np.kron(np.pad(other, 4), np.ones((2, 2))) > 0, 20, 220).astype(np.uint8)
    two = np.pad(np.concatenate([one, one]), ((0, 0), (0, 3400)), constant_values=220)
    two[-len(small) - 40 : -40, 40 : 40 + len(small)] = small
    tags = find_tags(two)
    assert len(tags) == 0
    assert tags.doubled == len(PAGE.tags)
    assert sorted(codes_in(two, tags)) == ["GC1/another/sheet", TEXT]
    assert codes_in(two) == [TEXT]
    assert find_tags(one).doubled == 0
