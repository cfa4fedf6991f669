"""The tags against OpenCV, which looks for them."""

import numpy as np
import pytest

from graphcam.photo.tag_family import CELLS, COUNT, dark_cells


def test_the_tags_are_those_of_the_family():
    cv2 = pytest.importorskip("cv2")
    family = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    for number in range(COUNT):
        drawn = cv2.aruco.generateImageMarker(family, number, CELLS, borderBits=1)
        assert np.array_equal(dark_cells(number), drawn == 0)


def test_no_tag_is_another_turned():
    tags = [np.rot90(dark_cells(number), turn) for number in range(COUNT) for turn in range(4)]
    assert len({tag.tobytes() for tag in tags}) == 4 * COUNT


@pytest.mark.parametrize("number", [-1, COUNT])
def test_there_are_no_others(number: int):
    with pytest.raises(IndexError):
        dark_cells(number)
