"""What was read off one photograph, without the key: it is kept as JSON beside the pictures of its views."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import TaskError
from graphcam.photo.printed_page import Edges, Points
from graphcam.words import say

TABLE = "table of answers"
"""The picture name of the table; no view is called so."""
BARS = ("length of the bar across", "length of the bar up")
"""The picture names of the boxes in which the measured lengths of the scale bars are written."""


FORMAT_VERSION = 2
PLACE_DECIMALS = 3
"""Decimals of a place in mm: a thousandth is far below what a photograph shows."""
UNREADABLE_REMEDY = say("delete the folder that holds it, and read the photographs again")


@dataclass(frozen=True, eq=False)
class ReadAnswer:
    """One answer as a photograph shows it.

    place : name of the view
    points : (n,) mm of paper from the view's origin: a curve in its order, plotted points, a crossing, the two ends of
        a length; None where there are none
    faint : (m,) places that are a little like plotted points, of which only the key can tell that one may be there
    share : part of what must be seen that is seen
    confidence : from 0, a guess, to 1
    measures : by name, what the reader measured besides
    why, remedy : why it is not read, in the language of the course, and what to do; empty where it is
    """

    place: str
    points: Points | None
    faint: Points = field(default_factory=lambda: np.zeros(0, np.complex128))
    closed: bool = False
    share: float = 1.0
    confidence: float = 1.0
    measures: Mapping[str, float] = field(default_factory=dict[str, float])
    why: str = ""
    remedy: str = ""


@dataclass(frozen=True)
class KeptPicture:
    """A flat picture of a part of the page.

    file : its name beside the readings
    box : what it shows, in mm: of a view from the view's origin, else from the lower left corner of the page
    """

    file: str
    box: Edges


@dataclass(frozen=True, eq=False)
class ReadPhoto:
    """One photograph of one page.

    name : of its file, and of its place in the file where that holds several;  digest : of the file, and the place
    student, page : whose page it is; page 0 where that is not known
    tags, expected : marks that were found, and that were printed
    residual : of the marks [px];  kind : of the paper: plane, fold or cylinder
    answers : by name, those that are drawn on the page
    pictures : of the views by their names, and of the table of answers
    bars : printed lengths of the scale bars, across and up [mm]
    half : "left" or "right" of one that shows one of the two sheets of a page, and is read with the other one
    why, remedy : why the photograph is refused as a whole, and what to do
    """

    name: str
    digest: str
    student: str = ""
    page: int = 0
    tags: int = 0
    expected: int = 0
    residual: float = 0.0
    kind: str = ""
    answers: Mapping[str, ReadAnswer] = field(default_factory=dict[str, ReadAnswer])
    pictures: Mapping[str, KeptPicture] = field(default_factory=dict[str, KeptPicture])
    bars: tuple[float, float] = (0.0, 0.0)
    half: str = ""
    why: str = ""
    remedy: str = ""

    @property
    def is_identified(self) -> bool:
        """Whether it is known whose page it shows."""
        return self.page > 0


def to_json(photos: list[ReadPhoto], basis: str) -> str:
    """The photographs as JSON text.

    basis : tells what the photographs were read with
    """
    said = [{**vars(photo)} for photo in photos]
    for each, photo in zip(said, photos, strict=True):
        each["answers"] = {name: _answer_data(one) for name, one in photo.answers.items()}
        each["pictures"] = {name: [one.file, one.box] for name, one in photo.pictures.items()}
    return json.dumps({"format": FORMAT_VERSION, "basis": basis, "photos": said}, allow_nan=False)


def from_json(text: str, path: str = "readings") -> tuple[list[ReadPhoto], str]:
    """Photographs out of their text, and what they were read with.

    Raises
    ------
    TaskError : the text is none, or of another format

    >>> photos, basis = from_json(to_json([ReadPhoto("a.jpg", "d", answers={"x": ReadAnswer("profile", None)})], "b"))
    >>> photos[0].name, photos[0].answers["x"].place, basis
    ('a.jpg', 'profile', 'b')
    """
    try:
        said = json.loads(text)
        if said["format"] != FORMAT_VERSION:
            raise ValueError(f"format {said['format']}")
        return [_photo_from_data(each) for each in said["photos"]], str(said["basis"])
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        found = say("not readable ({error})", error=str(error))
        raise TaskError(
            path, say("the reading"), found, say("one of format {format}", format=FORMAT_VERSION), UNREADABLE_REMEDY
        ) from None


def _photo_from_data(said: dict[str, Any]) -> ReadPhoto:
    answers = {name: _answer_from_data(each) for name, each in said["answers"].items()}
    pictures: dict[str, KeptPicture] = {}
    for name, (file, (left, bottom, right, top)) in said["pictures"].items():
        pictures[name] = KeptPicture(file, (left, bottom, right, top))
    across, up = said["bars"]
    plain = {name: value for name, value in said.items() if name not in ("answers", "pictures", "bars")}
    return replace(ReadPhoto(**plain), answers=answers, pictures=pictures, bars=(across, up))


def _answer_data(answer: ReadAnswer) -> dict[str, Any]:
    points = None if answer.points is None else pairs(answer.points)
    return {**vars(answer), "points": points, "faint": pairs(answer.faint)}


def _answer_from_data(said: dict[str, Any]) -> ReadAnswer:
    points = None if said["points"] is None else _points_from_data(said["points"])
    return replace(ReadAnswer(**said), points=points, faint=_points_from_data(said["faint"]))


def _points_from_data(said: list[list[float]]) -> Points:
    return np.array(said, dtype=np.float64).reshape(-1, 2).view(np.complex128)[:, 0]


def pairs(points: NDArray[np.complexfloating[Any, Any]]) -> list[list[float]]:
    """Points as JSON and TOML take them.

    >>> pairs(np.array([1 + 2j]))
    [[1.0, 2.0]]
    """
    return np.round(np.column_stack([points.real, points.imag]), PLACE_DECIMALS).tolist()
