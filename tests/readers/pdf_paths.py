"""The lines of a PDF's page as PDFium reads them."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pypdfium2
import pypdfium2.raw as pdfium

MM = 25.4 / 72


@dataclass(frozen=True, eq=False)
class PdfPath:
    """A path: its points (n,) as complex numbers in mm, where a new run begins, width of its line [mm], 0 if filled."""

    points: np.ndarray
    begins: np.ndarray
    width: float

    @property
    def straight(self) -> tuple[np.ndarray, np.ndarray]:
        """Starts and ends of the lines from point to point."""
        within = ~self.begins[1:]
        return self.points[:-1][within], self.points[1:][within]


@dataclass(frozen=True, eq=False)
class PdfPage:
    """A page, ``width`` x ``height`` mm, and its paths."""

    width: float
    height: float
    paths: list[PdfPath]

    @property
    def straight(self) -> tuple[np.ndarray, np.ndarray]:
        """Starts and ends of all lines from point to point."""
        lines = [path.straight for path in self.paths]
        starts, ends = ([line[k] for line in lines] for k in (0, 1))
        return np.concatenate([np.empty(0, complex), *starts]), np.concatenate([np.empty(0, complex), *ends])


def pages(path: Path) -> list[PdfPage]:
    """All pages of a PDF."""
    with pypdfium2.PdfDocument(path) as document:
        return [
            PdfPage(
                page.get_width() * MM,
                page.get_height() * MM,
                [_path(found) for found in page.get_objects(filter=[pdfium.FPDF_PAGEOBJ_PATH])],
            )
            for page in document
        ]


def _path(found: pypdfium2.PdfObject) -> PdfPath:
    count = pdfium.FPDFPath_CountSegments(found)
    points, begins = np.empty(count, complex), np.zeros(count, bool)
    x, y = ctypes.c_float(), ctypes.c_float()
    for k in range(count):
        segment = pdfium.FPDFPath_GetPathSegment(found, k)
        pdfium.FPDFPathSegment_GetPoint(segment, x, y)
        points[k] = complex(x.value, y.value)
        begins[k] = pdfium.FPDFPathSegment_GetType(segment) == pdfium.FPDF_SEGMENT_MOVETO
    m = pdfium.FS_MATRIX()
    pdfium.FPDFPageObj_GetMatrix(found, m)
    placed = points.real * complex(m.a, m.b) + points.imag * complex(m.c, m.d) + complex(m.e, m.f)
    fill, stroke, width = ctypes.c_int(), ctypes.c_int(), ctypes.c_float()
    pdfium.FPDFPath_GetDrawMode(found, fill, stroke)
    pdfium.FPDFPageObj_GetStrokeWidth(found, width)
    # A line keeps its width under the page's own scale.
    drawn = width.value * abs(m.a * m.d - m.b * m.c) ** 0.5 * MM if stroke.value else 0.0
    return PdfPath(placed * MM, begins, drawn)
