"""The tags against OpenCV, which looks for them."""

import numpy as np
import pytest

from graphcam.photo.tag_family import CELLS_PER_SIDE, TAG_COUNT, dark_cells


def test_the_tags_are_those_of_the_family():
    cv2 = pytest.importorskip("cv2")
    family = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    for number in range(TAG_COUNT):
        drawn = cv2.aruco.generateImageMarker(family, number, CELLS_PER_SIDE, borderBits=1)
        assert np.array_equal(dark_cells(number), drawn == 0)


def test_no_tag_is_another_turned():
    tags = [np.rot90(dark_cells(number), turn) for number in range(TAG_COUNT) for turn in range(4)]
    assert len({tag.tobytes() for tag in tags}) == 4 * TAG_COUNT


@pytest.mark.parametrize("number", [-1, TAG_COUNT])
def test_there_are_no_others(number: int):
    with pytest.raises(IndexError):
        dark_cells(number)
