"""A page as photographs show it: even pictures of its parts, and what of them is kept to be looked at."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.exercises.course.page_parts import LENGTH_FIELD_SIZE
from graphcam.exercises.photographs.read_photo import BARS, TABLE
from graphcam.photo.pencil_ink import Ink, ink_of
from graphcam.photo.pictures import Photograph
from graphcam.photo.printed_page import Edges, PrintedPage, PrintedView, Side
from graphcam.photo.rectify import PIXELS_PER_MM, EvenPicture, rectify
from graphcam.photo.registration import Registration
from graphcam.photo.taped_tiles import Tile, rectify_tiles

JPEG_QUALITY = 80
"""The quality of JPEG: a pencil line keeps its edges, and a view of A3 takes 60 kB."""


def jpeg(pixels: NDArray[np.uint8]) -> bytes:
    """A picture (rows, columns, 3), blue, green, red, as JPEG.

    >>> jpeg(np.zeros((8, 8, 3), np.uint8))[:2].hex()
    'ffd8'
    """
    # Colours as sharp as light, or a thin coloured line would be grey.
    sharp = [cv2.IMWRITE_JPEG_SAMPLING_FACTOR, cv2.IMWRITE_JPEG_SAMPLING_FACTOR_444]
    _, data = cv2.imencode(".jpg", pixels, [cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY, *sharp])
    return data.tobytes()


SHOWN_PER_MM = 3.0
"""Pixels a mm of the pictures that are shown: a pencil line is one wide, and a view of A3 takes 60 kB."""
MAX_SHOWN_PIXELS = 1000
"""Pixels of the longer side of a picture that is shown."""
OVERSAMPLING = 2
"""A picture that is shown is taken out of the photograph so many times finer, and reduced, so that no line is lost."""
MAX_PIXELS = 9e6
"""The maximum pixels of an even picture that is read: more would not fit the memory, and is finer than a photograph."""
PAPER_MARGIN = 4.0
"""The margin about what is read, where paper is looked at [mm]."""
MIN_TABLE_AREA = 1500.0
"""mm² of the table of answers; nothing else that is printed in black is as large."""


@dataclass(frozen=True, eq=False)
class SeenPage:
    """A page in a photograph, or a page on two sheets in two.

    rectified : an even picture of a box of the page, with so many pixels a mm
    registered : where a place of the page is registered
    """

    page: PrintedPage
    rectified: Callable[[Edges, float], EvenPicture]
    registered: Callable[[complex], Registration]

    @staticmethod
    def from_photograph(photograph: Photograph, page: PrintedPage, registration: Registration) -> SeenPage:
        """A page in one photograph."""
        return SeenPage(page, partial(rectify, photograph.pixels, registration), lambda place: registration)

    @staticmethod
    def of_tiles(tiles: Mapping[Side, Tile], page: PrintedPage) -> SeenPage:
        """A page on two sheets that are joined."""

        def rectified(box: Edges, per_mm: float) -> EvenPicture:
            return rectify_tiles(tiles, page, box, per_mm)

        def registered(place: complex) -> Registration:
            return tiles["left" if place.real < (page.seam or 0.0) else "right"].registration

        return SeenPage(page, rectified, registered)

    def ink(self, view: PrintedView) -> Ink:
        """The pencil in a view."""
        left, bottom, right, top = box = self._view_box(view)
        per_mm = min(PIXELS_PER_MM, float(np.sqrt(MAX_PIXELS / ((right - left) * (top - bottom)))))
        return ink_of(self.rectified(box, per_mm), self.page, 1 / self._pixels_a_mm(view))

    def _view_box(self, view: PrintedView) -> Edges:
        """The room of a view, and what shows the ink of the givens, within the page."""
        left, bottom, right, top = view.room
        page = self.page
        # The patches tell the print's colour; with no patch in sight it would be taken for grey.
        places = [complex(left, bottom), complex(right, top)]
        places += [corner + side * (1 + 1j) for corner in page.patches for side in (0.0, page.patch_side)]
        x, y = [place.real for place in places], [place.imag for place in places]
        lower = (max(0.0, min(x) - PAPER_MARGIN), max(0.0, min(y) - PAPER_MARGIN))
        return (*lower, min(page.width, max(x) + PAPER_MARGIN), min(page.height, max(y) + PAPER_MARGIN))

    def _pixels_a_mm(self, view: PrintedView) -> float:
        """Pixels of the photograph in a mm of the view, where they are fewest."""
        left, bottom, right, top = view.room
        middle = complex((left + right) / 2, (bottom + top) / 2)
        ends = self.registered(middle).pixels(middle + np.array([-1.0, 1.0, -1j, 1j]))
        return float(min(abs(ends[1] - ends[0]), abs(ends[3] - ends[2])) / 2)

    def shown_pictures(self) -> Iterator[tuple[str, tuple[bytes, Edges]]]:
        """JPEGs by name of the views, of the table of answers and of the bars' written lengths, with their boxes.

        The box of a view is counted from its origin.
        """
        page = self.page
        for name, view in page.views.items():
            data, (left, bottom, right, top) = self._picture(view.room)
            x, y = view.origin.real, view.origin.imag
            yield name, (data, (left - x, bottom - y, right - x, top - y))
        boxes = [box for box in page.black if _area(box) >= MIN_TABLE_AREA]
        if boxes:
            yield TABLE, self._picture(max(boxes, key=_area))
        for name, size in zip(BARS, (LENGTH_FIELD_SIZE, LENGTH_FIELD_SIZE[::-1]), strict=True):
            fields = [box for box in page.black if np.allclose((box[2] - box[0], box[3] - box[1]), size, atol=0.1)]
            if fields:
                left, bottom, right, top = fields[0]
                around = (left - PAPER_MARGIN, bottom - PAPER_MARGIN, right + PAPER_MARGIN, top + PAPER_MARGIN)
                yield name, self._picture(around, turned=size != LENGTH_FIELD_SIZE)

    def _picture(self, box: Edges, *, turned: bool = False) -> tuple[bytes, Edges]:
        """A part of the page as JPEG, and what it shows.

        turned : whether it is read from the right, and is shown upright
        """
        left, bottom, right, top = box
        per_mm = min(SHOWN_PER_MM, MAX_SHOWN_PIXELS / max(right - left, top - bottom))
        flat = self.rectified(box, OVERSAMPLING * per_mm)
        rows, columns = (max(1, length // OVERSAMPLING) for length in flat.linear.shape[:2])
        linear = cv2.resize(flat.linear, (columns, rows), interpolation=cv2.INTER_AREA)
        # Light as a screen shows it, near enough for a picture to look at.
        screen = (255 * np.clip(linear, 0, 1) ** (1 / 2.2)).astype(np.uint8)
        upright = np.rot90(screen, -1) if turned else screen
        return jpeg(np.ascontiguousarray(upright[..., ::-1])), flat.box


def _area(box: Edges) -> float:
    left, bottom, right, top = box
    return (right - left) * (top - bottom)
