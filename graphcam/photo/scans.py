"""Scans as PDF: pages made pictures, one at a time, at the scan's own resolution."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import closing
from ctypes import c_float, c_uint
from typing import Any, BinaryIO

import numpy as np
from pypdfium2 import PdfDocument, PdfiumError, PdfPage, raw

from graphcam.photo.images import MOST_PAGES
from graphcam.photo.pictures import KEPT_PIXELS, WIDE, Photograph, check_size
from graphcam.photo.refusal import PhotographError
from graphcam.words import say

POINTS = 72.0
"""Points of an inch."""
DPI = 300.0
"""The resolution of a page that is more than one picture."""
WHOLE = 0.9
"""The part of a page that its one picture covers at least."""
NESTED = 8
"""Groups within groups in which pictures are looked for."""


def scanned_pages(file: BinaryIO, name: str) -> Iterator[Photograph | PhotographError]:
    """The pages of a PDF, or why one is none.

    Raises
    ------
    PhotographError : there is none
    """
    try:
        document = PdfDocument(file)
    except PdfiumError as error:
        if "password" in str(error).lower():
            raise PhotographError(say("the PDF is locked with a password"), say("save it without one")) from None
        raise PhotographError(say("the PDF is damaged or incomplete"), say("send it again")) from None
    with closing(document):
        count = len(document)
        if not count:
            raise PhotographError(say("the PDF has no pages"), say("send it again"))
        if count > MOST_PAGES:
            raise PhotographError(
                say("the PDF has more than {most} pages", most=MOST_PAGES), say("send fewer pages in a file")
            )
        for number in range(count):
            page_name = name if count == 1 else f"{name}, {number + 1}"
            try:
                yield _picture(document, number, page_name)
            except PhotographError as error:
                yield error
            except PdfiumError:
                yield PhotographError(say("page {number} is damaged", number=number + 1), say("scan it again"))


def _picture(document: PdfDocument, number: int, name: str) -> Photograph:
    with closing(document[number]) as page:
        width, height = page.get_size()
        if not (width > 0 and height > 0):
            raise PhotographError(say("page {number} is empty", number=number + 1), say("scan it again"))
        scale: Any = min(_scale(page, width * height), float(np.sqrt(KEPT_PIXELS / (width * height))))
        with closing(page.render(scale=scale)) as bitmap:
            pixels = np.asarray(bitmap.to_numpy())
            if pixels.ndim == 2 or pixels.shape[2] == 1:
                pixels = np.repeat(pixels.reshape(*pixels.shape[:2], 1), 3, axis=2)
            return Photograph(name, np.ascontiguousarray(pixels[..., :3], np.uint8))


def _scale(page: PdfPage, area: float) -> float:
    """Pixels a point: those of the page's one picture, or the usual ones.

    Raises
    ------
    PhotographError : a picture in it is too large
    """
    found = [_measured(picture.raw) for picture in page.get_objects([raw.FPDF_PAGEOBJ_IMAGE], max_depth=NESTED)]
    for columns, rows, _ in found:
        check_size(columns, rows, WIDE)
    if len(found) == 1:
        columns, rows, covered = found[0]
        if covered >= WHOLE * area:
            return float(np.sqrt(columns * rows / covered))
    return DPI / POINTS


def _measured(picture: Any) -> tuple[int, int, float]:
    """Columns and rows of a picture in a PDF, and the area of the page that it covers.

    The library's own methods for it are called differently in its versions 4 and 5.
    """
    columns, rows = c_uint(), c_uint()
    left, bottom, right, top = (c_float() for _ in range(4))
    raw.FPDFImageObj_GetImagePixelSize(picture, columns, rows)
    raw.FPDFPageObj_GetBounds(picture, left, bottom, right, top)
    return columns.value, rows.value, (right.value - left.value) * (top.value - bottom.value)
