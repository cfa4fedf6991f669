"""A page made by hand, where no course is at hand: tags, bars, patches, light givens, a view for a closed curve."""

from __future__ import annotations

import cv2
import numpy as np
import segno
from bent_paper import Points
from camera import Size
from numpy.typing import NDArray
from printer import PRINTED_DPI

from graphcam.photo.printed_page import Ink, PrintedPage, PrintedView

WIDTH, HEIGHT = 420.0, 297.0
TAG, EDGE = 12.0, 10.0
"""Side of a tag, and its distance from the edge of the paper, mm."""
ORIGIN, ROOM = 270 + 160j, 92.0
TINTS: dict[Ink, tuple[int, int, int]] = {"colour": (255, 220, 166), "grey": (182, 182, 182)}
"""35 % cyan and 29 % grey: blue, green, red."""
CODE = "GC1/stand-in/1/Anna/0/1/00000000"
PER_MM = PRINTED_DPI / 25.4
TEXTS = ("Profile by inversion", "s_8 =            mm", "radius_8 =       mm", "x_8 =            mm")
Drawn = NDArray[np.uint8]


def stand_in(ink: Ink = "colour") -> PrintedPage:
    """The page."""
    left, right, low, top = EDGE, WIDTH - EDGE - TAG, EDGE, HEIGHT - EDGE - TAG
    xs, ys = np.linspace(left, right, 4), np.linspace(low, top, 3)
    places = [complex(x, y) for y in (low, top) for x in xs] + [complex(x, ys[1]) for x in (left, right)]
    turns = np.exp(2j * np.pi * np.arange(0, 361) / 360)
    givens = [ORIGIN + radius * turns for radius in (16.0, 50.0)]
    givens += [ORIGIN + way * np.array([-ROOM, ROOM]) for way in (1, 1j)]
    givens += [ORIGIN + np.array([0, 50 * np.exp(2j)]), ORIGIN + 30 * turns[20:70]]
    room = (ORIGIN.real - ROOM, ORIGIN.imag - ROOM, ORIGIN.real + ROOM, ORIGIN.imag + ROOM)
    return PrintedPage(
        code=CODE,
        width=WIDTH,
        height=HEIGHT,
        tags=dict(enumerate(places)),
        tag_side=TAG,
        bars=((80 + 30j, 330 + 30j), (36 + 60j, 36 + 240j)),
        patches=(175 + 54j, 188 + 54j),
        patch_side=7.0,
        ink=ink,
        givens=tuple(givens),
        black=((50.0, 180.0, 165.0, 255.0), (50.0, 80.0, 90.0, 120.0)),
        views={"profile": PrintedView(ORIGIN, room, closed=True)},
    )


def drawn_page(page: PrintedPage) -> Drawn:
    """The page as a renderer would draw it, at the printer's dots: (rows, columns, 3) blue, green, red."""
    size: Size = (2 * round(page.width * PER_MM / 2), 2 * round(page.height * PER_MM / 2))
    picture = np.full((size[1], size[0], 3), 255, np.uint8)
    tint = TINTS[page.ink]
    for line in page.givens:
        _line(picture, page, line, 0.18, tint)
    for corner in page.patches:
        _square(picture, page, corner, page.patch_side, tint)
    for start, end in page.bars:
        _line(picture, page, np.array([start, end]), 0.35, (0, 0, 0))
        for place in (start, end):
            way = 2j * (end - start) / abs(end - start)
            _line(picture, page, np.array([place - way, place + way]), 0.25, (0, 0, 0))
    family = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    for number, corner in page.tags.items():
        _cells(picture, page, corner, page.tag_side, cv2.aruco.generateImageMarker(family, number, 8) > 0)
    code = segno.make(page.code, error="q", micro=False)
    _cells(picture, page, 55 + 82j, 34.0, ~np.array([list(row) for row in code.matrix], dtype=bool))
    for k, text in enumerate(
        ("Profile by inversion", "s_8 =            mm", "radius_8 =       mm", "x_8 =            mm")
    ):
        at = _pixels(page, np.array(55 + 1j * (240 - 14 * k))).astype(int).tolist()
        cv2.putText(picture, text, at, cv2.FONT_HERSHEY_SIMPLEX, 3.4, (0, 0, 0), 7, cv2.LINE_AA)
    return picture


def _pixels(page: PrintedPage, points: Points) -> NDArray[np.float64]:
    return np.stack([points.real * PER_MM - 0.5, (page.height - points.imag) * PER_MM - 0.5], axis=-1)


def _line(picture: Drawn, page: PrintedPage, line: Points, width: float, colour: tuple[int, ...]) -> None:
    way = np.round(_pixels(page, line) * 16).astype(np.int32)
    cv2.polylines(picture, [way], False, colour, max(1, round(width * PER_MM)), cv2.LINE_AA, 4)


def _square(
    picture: NDArray[np.uint8], page: PrintedPage, corner: complex, side: float, colour: tuple[int, ...]
) -> None:
    corners = corner + side * np.array([0, 1, 1 + 1j, 1j])
    cv2.fillPoly(picture, [np.round(_pixels(page, corners) * 16).astype(np.int32)], colour, cv2.LINE_8, 4)


def _cells(
    picture: NDArray[np.uint8], page: PrintedPage, corner: complex, side: float, white: NDArray[np.bool_]
) -> None:
    cell = side / len(white)
    for row, column in np.argwhere(~white):
        _square(picture, page, corner + cell * (column + 1j * (len(white) - 1 - row)), cell, (0, 0, 0))
