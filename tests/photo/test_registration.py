"""Where the paper is: flat, folded and rolled sheets, and refusals."""

from __future__ import annotations

import pickle
import time
from dataclasses import replace

import numpy as np
import pytest
from over_all import over_all
from photographed import Camera, folded, page_of, photograph, rolled

from graphcam.photo.pictures import PhotographError
from graphcam.photo.registration import register
from graphcam.photo.tags import Tags, find_tags

pytestmark = pytest.mark.slow

A3 = page_of()
A4 = page_of(210.0, 297.0, side=9.0, edge=6.0)
RANDOM = np.random.default_rng(18)
TILTS = [tuple(RANDOM.uniform(-1, 1, 3) * [20, 20, 180]) for _ in range(4)]


def size_of(page, megapixels):
    size = {12: (4000, 3000), 5: (2592, 1944)}[megapixels]
    return size if page.width > page.height else size[::-1]


def registered(camera, **shot):
    return register(camera.tags(**shot), camera.page, camera.size)


@pytest.mark.parametrize("tilt", [*TILTS, (30.0, 0.0, 0.0), (0.0, -30.0, 90.0), (0.0, 0.0, 0.0)])
@pytest.mark.parametrize(("megapixels", "most"), [(12, 0.05), (5, 0.12)])
@pytest.mark.parametrize("page", [A3, A4])
def test_a_flat_page_is_registered(page, megapixels, most, tilt):
    camera = Camera(page, tilt, size_of(page, megapixels))
    found = registered(camera, noise=0.12)
    misses = camera.misses(found)
    assert found.kind == "plane"
    assert (found.tags, found.expected) == (8, 8)
    assert np.percentile(misses, 95) < most
    assert misses.max() < 2 * most
    assert misses.max() < 1.6 * found.doubt < 0.2


@pytest.mark.parametrize("page", [A3, A4])
@pytest.mark.parametrize(("megapixels", "most", "shot"), [(12, 0.05, {}), (5, 0.12, {"blur": 1.5, "quality": 70})])
def test_a_picture_of_a_flat_page_is_registered(page, megapixels, most, shot):
    camera = Camera(page, (14.0, -12.0, 4.0), size_of(page, megapixels), (0, 0))
    picture = photograph(camera, **shot)
    started = time.process_time()
    found = register(find_tags(picture), page, camera.size)
    assert time.process_time() - started < 0.6
    misses = camera.misses(found)
    assert found.kind == "plane"
    assert found.tags == 8
    assert np.percentile(misses, 95) < most
    assert misses.max() < 2 * most
    assert 0.1 < found.blur < 0.8


@pytest.mark.parametrize("hidden", [(0, 7), (0, 1), (3, 4), (2,)])
def test_two_tags_may_be_hidden(hidden):
    camera = Camera(A3)
    found = registered(camera, hidden=hidden)
    assert found.tags == 8 - len(hidden)
    assert camera.misses(found).max() < 0.1


@over_all(("page", "slope", "degrees"), [(A3, 0.0, -15), (A4, 0.08, -8), (A3, 5.0, 4), (A4, 0.0, 15), (A3, 0.08, 15)])
def test_a_fold_is_registered_or_refused(page, slope, degrees):
    refused = 0
    for place in (-60.0, 0.0, 55.0):
        camera = Camera(page, TILTS[0], size_of(page, 12), bend=folded(place, slope, degrees))
        try:
            found = registered(camera)
        except PhotographError:
            refused += 1
            continue
        misses = camera.misses(found)
        assert found.kind == "fold"
        assert np.percentile(misses, 95) < 0.3
        assert misses.max() < 1.6 * found.doubt < 0.8
    assert refused <= 1


@over_all(
    ("page", "direction", "lift"), [(A3, 0.0, -8.0), (A4, 90.0, -3.0), (A3, 35.0, 2.0), (A4, 0.0, 8.0), (A3, 90.0, 8.0)]
)
def test_a_rolled_sheet_is_registered(page, direction, lift):
    for megapixels in (12, 5):
        camera = Camera(page, TILTS[1], size_of(page, megapixels), bend=rolled(lift, direction, page.width))
        found = registered(camera)
        misses = camera.misses(found)
        assert found.kind == "cylinder"
        assert np.percentile(misses, 95) < 0.3
        assert misses.max() < 1.6 * found.doubt


def test_the_focal_length_that_a_picture_tells_is_used_not_believed():
    camera = Camera(A3, TILTS[2], bend=rolled(6.0, 0.0, 420.0))
    for factor in (0.97, 1.04, 1.0):
        found = register(camera.tags(), A3, camera.size, camera.focal * factor)
        assert np.percentile(camera.misses(found), 95) < 0.2


@pytest.mark.parametrize("bend", [folded(20.0, 0.1, 12), rolled(5.0, 20.0, 420.0)])
def test_the_way_back_is_the_inverse(bend):
    camera = Camera(A3, TILTS[3], bend=bend)
    points = np.array([[40 + 50j, 210 + 148j], [380 + 250j, 231 + 149j]])
    found = pickle.loads(pickle.dumps(registered(camera)))
    places = found.pixels(points)
    assert places.shape == points.shape
    assert np.abs(found.millimetres(places) - points).max() < 1e-6
    assert complex(found.millimetres(found.pixels(100 + 100j))) == pytest.approx(100 + 100j)


@pytest.mark.parametrize("quarter", range(4))
def test_scans_may_lie_in_any_direction(quarter):
    # 200 dots an inch.
    per_mm = 200 / 25.4
    size = round(297 * per_mm), round(210 * per_mm)
    page = page_of(297.0, 210.0, side=9.0, edge=6.0)
    camera = Camera(page, (0.0, 0.0, 0.7), size, (0, 0), filled=0.99)
    picture = np.ascontiguousarray(np.rot90(photograph(camera, blur=0.6, quality=92), quarter))
    found = register(find_tags(picture), page, picture.shape[::-1])
    points = np.array([50 + 60j, 250 + 70j, 148 + 100j])
    places = camera.pixels(points)
    for turn in range(quarter):
        places = places.imag + 1j * (size[turn % 2] - 1 - places.real)
    assert np.abs(found.millimetres(places) - points).max() < 0.05


def test_a_printer_that_scales_or_spreads_its_ink_misplaces_nothing():
    camera = Camera(A3)
    found = registered(camera)
    # The black squares are larger by a tenth of a mm all round.
    grown = replace(A3, tag_side=A3.tag_side - 0.2, tags={n: z + 0.1 + 0.1j for n, z in A3.tags.items()})
    fatter = register(camera.tags(), grown, camera.size)
    assert fatter.growth == pytest.approx(found.growth + 0.1, abs=0.03)
    assert camera.misses(fatter).max() < 0.1


def refusal(*arguments) -> str:
    with pytest.raises(PhotographError) as caught:
        register(*arguments)
    assert str(caught.value.remedy)
    return str(caught.value)


def test_too_few_tags_are_refused():
    camera = Camera(A3)
    nothing = Tags(np.zeros(0, int), np.zeros((0, 4), complex))
    assert "none of the 8 marks" in refusal(nothing, A3, camera.size)
    assert "only 2 of 8 marks" in refusal(camera.tags(hidden=range(6)), A3, camera.size)


def test_tags_on_one_side_only_are_refused():
    camera = Camera(A3)
    assert "which does not fix the position of a line" in refusal(camera.tags(hidden=range(3, 8)), A3, camera.size)


def test_another_page_is_refused():
    camera = Camera(A3)
    renamed = replace(A3, tags={number + 20: place for number, place in A3.tags.items()})
    assert "belong to another page" in refusal(camera.tags(), renamed, camera.size)
    assert "not in the positions of this page" in refusal(camera.tags(), A4, camera.size)


def test_a_mirrored_picture_is_refused():
    camera = Camera(A3, size=(2592, 1944), lens=(0, 0))
    mirrored = photograph(camera)[:, ::-1].copy()
    assert "mirrored" in refusal(find_tags(mirrored), A3, camera.size)


def test_a_crumpled_sheet_is_refused():
    camera = Camera(A3)
    tags = camera.tags()
    pushed = np.random.default_rng(1).normal(0, 6, 8) + 1j * np.random.default_rng(2).normal(0, 6, 8)
    assert "bent too much" in refusal(Tags(tags.numbers, tags.corners + pushed[:, None]), A3, camera.size)

    def twice(points):
        return folded(-70.0, 0.1, 9)(points) + folded(60.0, -0.2, -9)(points) * [0, 0, 1]

    refusal(Camera(A3, bend=twice).tags(), A3, camera.size)


def test_a_blurred_picture_is_refused():
    camera = Camera(A3, (5.0, 5.0, 0.0), (2592, 1944), (0, 0))
    assert "blurred" in refusal(find_tags(photograph(camera, blur=3.2, noise=0.0)), A3, camera.size)


def test_a_picture_may_be_cut():
    for cut in (150, 300 + 200j):
        camera = Camera(A3, TILTS[0], filled=0.8)
        tags = camera.tags()
        found = register(Tags(tags.numbers, tags.corners - cut), A3, (4000 - 150, 3000 - 100))
        left = camera.pixels(np.array([60 + 70j, 350 + 220j, 200 + 90j]))
        assert np.abs(found.millimetres(left - cut) - [60 + 70j, 350 + 220j, 200 + 90j]).max() < 0.15


def test_a_drawing_beyond_the_picture_is_refused():
    camera = Camera(A3, (0.0, 0.0, 0.0))
    tags = camera.tags()
    assert "outside the picture" in refusal(Tags(tags.numbers, tags.corners - 500), A3, camera.size)


def test_one_tag_out_of_its_place_is_left_out():
    camera = Camera(A3)
    tags = camera.tags()
    tags.corners[3] += 25
    found = register(tags, A3, camera.size)
    assert found.tags in (7, 8)
    assert np.percentile(camera.misses(found), 95) < 0.3


def test_a_bent_page_costs_little():
    camera = Camera(A3, bend=rolled(6.0, 0.0, 420.0))
    tags = camera.tags()
    started = time.process_time()
    register(tags, A3, camera.size)
    assert time.process_time() - started < 2.0
