"""Pages on two sheets: each alone, how they lie, and one picture out of both."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from photographed import CORNERS, Camera, page_of

from graphcam.photo.pictures import PhotographError
from graphcam.photo.printed_page import half, side_seen
from graphcam.photo.registration import register
from graphcam.photo.tags import Tags
from graphcam.photo.taped_tiles import joined_tiles, rectify_tiles, registered_tiles

pytestmark = pytest.mark.slow

SIZES = {12: (3000, 4000), 5: (1944, 2592), 1: (900, 1200)}
SHEET = page_of(210.0, 297.0)


def whole_page():
    """Two sheets with eight tags each; those of the right one are numbered from 8 on."""
    tags = {number + 8 * k: place + 210 * k for k in (0, 1) for number, place in SHEET.tags.items()}
    view = replace(SHEET.views["profile"], room=(30.0, 30.0, 390.0, 267.0))
    return replace(SHEET, width=420.0, tags=tags, views={"profile": view}, seam=210.0)


PAGE = whole_page()


def slipped(points, slip):
    """Where points of the right sheet lie when tape has slipped by (dx + dy i, turn)."""
    shift, turn = slip
    return (points - 210 - 148.5j) * np.exp(1j * turn) + 210 + 148.5j + shift


def photographed(side, slip=(0.0, 0.0), seed=0, noise=0.08, beyond=True, megapixels=12, tilt=(10.0, -7.0, 3.0)):
    """The picture's tags of one side, with those near the seam of the other; and its camera on the left sheet's mm."""
    low = 0.0 if side == "left" else 160.0
    seen = replace(PAGE, width=260.0, tags={}, views={})
    camera = Camera(seen, tilt, SIZES[megapixels], filled=0.95)
    random = np.random.default_rng(seed)
    numbers, corners = [], []
    for number, place in PAGE.tags.items():
        other = (place.real > 210) != (side == "right")
        if other and (not beyond or abs(place.real + 6 - 210) > 40):
            continue
        points = place + 12 * CORNERS
        points = slipped(points, slip) if place.real > 210 else points
        numbers.append(number)
        corners.append(camera.pixels(points - low))
    found = np.array(corners) + random.normal(0, noise, (len(corners), 4, 2)) @ [1, 1j]
    picture = np.full((*camera.size[::-1], 3), 200, np.uint8)
    return picture, Tags(np.array(numbers), found), lambda points: camera.pixels(points - low)


def tiles_of(slip, **shot):
    tiles, cameras = {}, {}
    for k, side in enumerate(("left", "right")):
        picture, tags, cameras[side] = photographed(side, slip, seed=7 * k + 1, **shot)
        tiles |= registered_tiles(picture, tags, PAGE)
    return tiles, cameras


def test_a_half_has_its_tags_and_its_part_of_the_views():
    left, right = half(PAGE, "left"), half(PAGE, "right")
    assert (sorted(left.tags), sorted(right.tags)) == (list(range(8)), list(range(8, 16)))
    assert left.views["profile"].room == (30.0, 30.0, 210.0, 267.0)
    assert right.views["profile"].room == (210.0, 30.0, 390.0, 267.0)
    one_side = replace(PAGE, views={"profile": replace(PAGE.views["profile"], room=(30.0, 30.0, 190.0, 267.0))})
    assert half(one_side, "right").views == {}
    assert side_seen(np.array([1, 2, 3, 8, 9]), PAGE) == "left"


def test_a_photograph_of_one_sheet_is_registered():
    picture, tags, camera = photographed("right")
    assert list(registered_tiles(picture, tags, PAGE)) == ["right"]
    alone = register(tags, PAGE, SIZES[12])
    points = np.array([230 + 40j, 380 + 250j])
    assert np.abs(alone.millimetres(camera(points)) - points).max() < 0.1


@pytest.mark.parametrize("megapixels", [12, 5])
def test_sheets_lie_where_the_tape_holds_them(megapixels):
    random = np.random.default_rng(3)
    jumps = []
    for _ in range(12):
        slip = complex(*random.normal(0, 0.5, 2)), random.normal(0, 0.0015)
        tilt = tuple(random.uniform(-1, 1, 3) * [12, 12, 4])
        tiles, cameras = tiles_of(slip, megapixels=megapixels, tilt=tilt)
        placed = joined_tiles(tiles, PAGE)
        assert placed["left"] is tiles["left"]
        meant = 215 + 1j * np.linspace(30, 267, 20)
        there = slipped(meant, slip)
        off = placed["right"].registration.millimetres(cameras["right"](there)) - there
        jumps.append(np.abs(off).max())
        assert np.abs(placed["right"].registration.pixels(there) - cameras["right"](there)).max() < 3
    assert np.percentile(jumps, 95) < 0.2
    assert np.median(jumps) < 0.06


def test_the_right_sheet_may_be_the_one_that_counts():
    slip = 0.7 - 0.4j, 0.002
    tiles, cameras = tiles_of(slip)
    placed = joined_tiles(tiles, PAGE, "right")
    meant = 150 + 100j
    # In the right sheet's own mm, what lies on the left one has moved the other way.
    wanted = (meant - 210 - 148.5j - slip[0]) * np.exp(-1j * slip[1]) + 210 + 148.5j
    assert placed["left"].registration.millimetres(cameras["left"](np.array([meant]))) == pytest.approx(wanted, abs=0.1)


def refusal(function, *arguments) -> str:
    with pytest.raises(PhotographError) as caught:
        function(*arguments)
    return str(caught.value)


def test_what_does_not_tell_how_sheets_lie_is_refused():
    tiles, _ = tiles_of((0.0, 0.0), beyond=False)
    assert "how the two sheets meet" in refusal(joined_tiles, tiles, PAGE)
    assert "only one of the two" in refusal(joined_tiles, {"left": tiles["left"]}, PAGE)
    tiles, _ = tiles_of((12.0 + 3j, 0.0))
    assert "do not form one page" in refusal(joined_tiles, tiles, PAGE)
    picture, tags, _ = photographed("left")
    assert "only 2" in refusal(registered_tiles, picture, tags.selected(np.arange(len(tags)) < 2), PAGE)


def test_one_picture_out_of_both():
    tiles, _ = tiles_of((0.5 + 0.3j, 0.0), megapixels=1, noise=0.03)
    rows, columns = np.mgrid[:1200, :900]
    places = columns + 1j * rows
    placed = joined_tiles(tiles, PAGE)
    pictures = {}
    for side, tile in placed.items():
        # Light falls off upwards in one and is a third weaker in the other; a dark line runs across the seam.
        line = np.abs(tile.registration.millimetres(places).imag - 120.0) < 1.0
        pictures[side] = replace(tile, picture=np.where(line[..., None], 60, [[[200, 200, 200]]]).astype(np.uint8))
    pictures["right"] = replace(pictures["right"], picture=(pictures["right"].picture * 0.85).astype(np.uint8))
    flat = rectify_tiles(pictures, PAGE, (150.0, 100.0, 270.0, 140.0))
    assert flat.linear.shape == (320, 960, 3)
    across = 150.2 + np.arange(0, 119, 0.5)
    assert np.ptp(flat.at(across + 120j)[:, 0]) < 0.05
    assert np.ptp(flat.at(across + 130j)[:, 0]) < 0.05
    up = 115 + np.arange(0, 10, 0.05)
    for x in (160.0, 209.0, 211.0, 260.0):
        dark = np.clip(0.4 - flat.at(x + 1j * up)[:, 1], 0, None)
        assert (dark * up).sum() / dark.sum() == pytest.approx(120.0, abs=0.15)
    for box in ((30.0, 50.0, 80.0, 90.0), (300.0, 50.0, 350.0, 90.0)):
        assert rectify_tiles(pictures, PAGE, box, 2.0).box == box
