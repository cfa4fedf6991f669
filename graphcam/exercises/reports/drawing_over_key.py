"""A student's drawing over what would have been right."""

from typing import Any

import numpy as np

from graphcam.exercises.definition.exercise import Kind
from graphcam.exercises.key.expectation import Expected
from graphcam.exercises.reports.curves import CurvePicture, picture, points_of
from graphcam.exercises.reports.unrolled_drawings import key_line


def over_key(key: Expected, answer: dict[str, Any], kind: Kind, spot: complex | None) -> CurvePicture:
    """The picture of a drawn answer of a record, the key's stations as dots, and of a curve its line.

    spot : the place that is circled, None where none is
    """
    curves = [("key", np.atleast_1d(np.asarray(key.value)), False), ("own", points_of(answer), kind == "curve")]
    if kind == "curve":
        curves.insert(0, ("key", key_line(key), True))
    return picture(curves, spot)
