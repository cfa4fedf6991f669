"""A printed page as a reader of photographs must know it: tags, bars, print, and the views for drawing.

It is stored when the page is printed, since paper does not change with the program.  Lengths are mm of paper, and
places are complex, x to the right and y up from the lower left corner of the page.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import TaskError
from graphcam.words import say

Points = NDArray[np.complex128]
Edges = tuple[float, float, float, float]
"""Left, bottom, right and top of a box [mm]."""
Ink = Literal["colour", "grey"]
"""The ink of the givens: a light tint, or light grey."""
FORMAT_VERSION = 1


@dataclass(frozen=True, eq=False)
class PrintedView:
    """A view on a page for a drawing.

    origin : of the view, on the page
    room : the box for the drawing
    closed : whether a curve runs once round the origin, or else over the x axis from ``start`` to ``end``
    start, end : of a curve that is not closed, from the origin along x
    """

    origin: complex
    room: Edges
    closed: bool
    start: float = 0.0
    end: float = 0.0


@dataclass(frozen=True, eq=False)
class PrintedPage:
    """One printed page.

    code : the text of its QR code, which also says whose it is
    width, height : of the page; of an A3 page on two A4 tiles that of both together
    tags : the lower left corner of each black square, by the tag's number
    tag_side : of the black square
    bars : start and end of the scale bars, across and up
    patches, patch_side : lower left corners of the squares that are filled with the ink of the givens
    ink : of the givens
    givens : the printed light lines, as polylines
    black : boxes about what is printed in black: texts, tables, tags
    views : by name
    seam : the x at which two tiles meet; None of a page on one sheet
    """

    code: str
    width: float
    height: float
    tags: Mapping[int, complex]
    tag_side: float
    bars: tuple[tuple[complex, complex], ...]
    patches: tuple[complex, ...]
    patch_side: float
    ink: Ink
    givens: tuple[Points, ...]
    black: tuple[Edges, ...]
    views: Mapping[str, PrintedView]
    seam: float | None = None

    def to_json(self) -> str:
        """The page as JSON text."""
        said = {name: getattr(self, name) for name in ("code", "width", "height", "tag_side", "patch_side", "ink")}
        said |= {"format": FORMAT_VERSION, "seam": self.seam, "black": self.black, "patches": _pairs(self.patches)}
        said["tags"] = {str(number): _pair(corner) for number, corner in self.tags.items()}
        said["bars"] = [_pairs(bar) for bar in self.bars]
        said["givens"] = [_pairs(np.round(line, 3).tolist()) for line in self.givens]
        said["views"] = {
            name: {"origin": _pair(view.origin), "room": view.room, "closed": view.closed}
            | {"start": view.start, "end": view.end}
            for name, view in self.views.items()
        }
        return json.dumps(said, allow_nan=False)

    @staticmethod
    def from_json(text: str, path: str = "page") -> PrintedPage:
        """The page in a JSON text.

        Raises
        ------
        TaskError : the text is no page, or of another format
        """
        try:
            return _page_from_data(json.loads(text))
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            found = say("not readable ({error})", error=str(error))
            wanted = say("one of format {format}", format=FORMAT_VERSION)
            raise TaskError(path, say("the page"), found, wanted, say("make the course again")) from None


def _page_from_data(said: dict[str, Any]) -> PrintedPage:
    if said["format"] != FORMAT_VERSION:
        raise ValueError(f"format {said['format']}")
    return PrintedPage(
        **{name: said[name] for name in ("code", "width", "height", "tag_side", "patch_side", "ink", "seam")},
        tags={int(number): complex(*corner) for number, corner in said["tags"].items()},
        bars=tuple((complex(*start), complex(*end)) for start, end in said["bars"]),
        patches=tuple(complex(*corner) for corner in said["patches"]),
        givens=tuple(np.array([complex(*place) for place in line]) for line in said["givens"]),
        black=tuple((left, bottom, right, top) for left, bottom, right, top in said["black"]),
        views={
            name: PrintedView(complex(*view["origin"]), tuple(view["room"]), view["closed"], view["start"], view["end"])
            for name, view in said["views"].items()
        },
    )


def _pair(place: complex) -> tuple[float, float]:
    return (place.real, place.imag)


def _pairs(places: Any) -> list[tuple[float, float]]:
    return [_pair(place) for place in places]


Side = Literal["left", "right"]
SIDE_NAMES: tuple[Side, Side] = ("left", "right")


def half(page: PrintedPage, side: Side) -> PrintedPage:
    """One sheet of a page with a seam, in the page's own millimetres: its tags, and its parts of the views."""
    if page.seam is None:
        raise ValueError("the page has no seam")
    low, high = (-np.inf, page.seam) if side == "left" else (page.seam, np.inf)
    tags = {number: corner for number, corner in page.tags.items() if low <= corner.real < high}
    views = {name: view for name, whole in page.views.items() if (view := _part(whole, low, high)) is not None}
    return replace(page, tags=tags, views=views, seam=None)


def side_seen(numbers: NDArray[np.int64], page: PrintedPage) -> Side:
    """The sheet of a page with a seam of which more tags are seen, by their numbers."""
    counts = [np.isin(numbers, list(half(page, side).tags)).sum() for side in SIDE_NAMES]
    return SIDE_NAMES[int(np.argmax(counts))]


def _part(view: PrintedView, low: float, high: float) -> PrintedView | None:
    left, bottom, right, top = view.room
    room: Edges = (max(left, low), bottom, min(right, high), top)
    return replace(view, room=room) if room[0] < room[2] else None
