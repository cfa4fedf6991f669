"""A worksheet as a printer leaves it on paper: rendered, its light tints dissolved into dots, a little too large.

What is printed is linear light, blue, green and red, in pixels of the *page*: a pixel covers what the file says there,
wherever the printer puts it on paper.
"""

from __future__ import annotations

import hashlib
import subprocess
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import cv2
import numpy as np
import pypdfium2
from bent_paper import Points
from camera import NDFloat32
from numpy.typing import NDArray

Print = NDArray[np.uint8]
"""(rows, columns, 3) of 255, which is bare paper."""
DPI, PRINTED_DPI = 300, 600
"""Of what is kept, and of the printer."""
PER_MM = DPI / 25.4
INKS = ((0.86, 0.42, 0.02), (0.26, 0.02, 0.84), (0.03, 0.89, 0.98), (0.03, 0.03, 0.03))
"""What full cyan, magenta, yellow and black let through: blue, green, red, linear."""
ANGLES = (15.0, 75.0, 0.0, 45.0)
"""Of their screens [degrees]."""
BLOCK = 512
"""Pixels of the printer that are screened at a time, each way; even, as two by two of them become one."""


@dataclass(frozen=True)
class Printer:
    """How a printer puts dots on paper.

    lines : of the screen, to an inch; 0 is a printer whose dots lie about at random, as ink jets do
    spread : standard deviation of how far toner or ink spreads, in its own pixels; strength : of the ink
    """

    lines: float = 141.0
    spread: float = 0.7
    strength: float = 1.0

    @property
    def name(self) -> str:
        """For its files."""
        return f"{self.lines:.0f}-{self.spread:.2f}-{self.strength:.2f}"


@dataclass(frozen=True)
class Placing:
    """Where a printer puts the page on paper.

    stretched : across and up, 1 where a millimetre is one
    turned : [radians]; shifted : [mm]
    """

    stretched: tuple[float, float] = (1.0, 1.0)
    turned: float = 0.0
    shifted: complex = 0j

    def paper(self, points: Points) -> Points:
        """Where points (...) of the page are on paper."""
        across, up = self.stretched
        points = np.asarray(points)
        return np.asarray((across * points.real + 1j * up * points.imag) * np.exp(1j * self.turned) + self.shifted)

    def page(self, points: Points) -> Points:
        """Of which points of the page points (...) of the paper are; the inverse of :meth:`paper`."""
        back = (np.asarray(points) - self.shifted) * np.exp(-1j * self.turned)
        return np.asarray(back.real / self.stretched[0] + 1j * back.imag / self.stretched[1])

    def by_hand(self, way: Points) -> Points:
        """What on the page (...) are ways that a hand measures in true millimetres along the printed axes."""
        return np.asarray(way.real / self.stretched[0] + 1j * way.imag / self.stretched[1])


def by_poppler(pdf: Path, page: int) -> NDArray[np.uint8]:
    """Page (counted from 0) of a PDF as poppler draws it: (rows, columns, 3), blue, green, red."""
    said = ["-f", str(page + 1), "-l", str(page + 1), "-singlefile", "-r", str(PRINTED_DPI), "-png", str(pdf)]
    # Worksheets have one name, and several are printed at a time.
    with TemporaryDirectory() as folder:
        subprocess.run(["pdftoppm", *said, f"{folder}/page"], check=True, capture_output=True)
        picture = cv2.imread(f"{folder}/page.png", cv2.IMREAD_COLOR)
    assert picture is not None
    return picture


def by_pdfium(pdf: Path, page: int) -> NDArray[np.uint8]:
    """Page of a PDF as PDFium draws it, which is what Chromium prints PDF files by."""
    document = pypdfium2.PdfDocument(pdf)
    drawn = document[page].render(scale=PRINTED_DPI / 72).to_numpy()
    picture = np.ascontiguousarray(drawn[..., :3])
    document.close()
    return picture


RENDERERS = {"poppler": by_poppler, "pdfium": by_pdfium}


def printed(pdf: Path, page: int, printer: Printer, renderer: str, scratch: Path) -> Print:
    """What the printer leaves of a page (rows, columns, 3); kept in ``scratch`` for the next photograph of it."""
    digest = hashlib.sha256(pdf.read_bytes()).hexdigest()[:16]
    kept = scratch / f"{digest}-{page}-{printer.name}-{renderer}.npy"
    if not kept.is_file():
        scratch.mkdir(parents=True, exist_ok=True)
        found = screened(RENDERERS[renderer](pdf, page), printer)
        draft = kept.with_suffix(f".{np.random.default_rng().integers(1 << 40)}.npy")
        np.save(draft, found)
        draft.replace(kept)
    return np.asarray(np.load(kept, mmap_mode="r"))


def screened(picture: NDArray[np.uint8], printer: Printer) -> Print:
    """What is left on paper of a picture (2 rows, 2 columns, 3) of the printer's dots, in (rows, columns, 3)."""
    rows, columns = (length // 2 for length in picture.shape[:2])
    found = np.full((rows, columns, 3), 255, np.uint8)
    for top in range(0, 2 * rows, BLOCK):
        for left in range(0, 2 * columns, BLOCK):
            block = picture[top : min(top + BLOCK, 2 * rows), left : min(left + BLOCK, 2 * columns)]
            if block.min() < 250:
                light = _block(block, top, left, printer)
                found[top // 2 :, left // 2 :][: light.shape[0], : light.shape[1]] = light
    return found


def _block(block: NDArray[np.uint8], top: int, left: int, printer: Printer) -> Print:
    tints = 1 - block.astype(np.float32) / 255
    black = tints.min(axis=-1)
    # Greys and black by the black ink alone; what has a colour by the others.
    grey = tints.max(axis=-1) - black < 0.06
    inks = [np.where(grey, 0, tints[..., 2 - k]) for k in range(3)] + [np.where(grey, black, 0)]
    light = np.ones((block.shape[0] // 2, block.shape[1] // 2, 3), np.float32)
    for tint, through, angle in zip(inks, INKS, ANGLES, strict=True):
        if tint.max() > 0.02:
            dots = (tint > _screen(tint.shape, top, left, angle, printer)).astype(np.float32)
            dots = cv2.GaussianBlur(dots, (0, 0), printer.spread)
            dots = cv2.resize(dots, (light.shape[1], light.shape[0]), interpolation=cv2.INTER_AREA)
            light *= 1 - printer.strength * dots[..., None] * (1 - np.array(through, np.float32))
    return np.round(light * 255).astype(np.uint8)


def _screen(shape: tuple[int, ...], top: int, left: int, angle: float, printer: Printer) -> NDFloat32:
    """From which tint on there is ink at a dot."""
    if not printer.lines:
        rng = np.random.default_rng([top, left, round(angle)])
        return rng.uniform(0.02, 0.98, shape[:2]).astype(np.float32)
    y, x = np.mgrid[top : top + shape[0], left : left + shape[1]].astype(np.float32)
    turn, wave = np.radians(angle), 2 * np.pi * printer.lines / PRINTED_DPI
    u, v = wave * (x * np.cos(turn) + y * np.sin(turn)), wave * (y * np.cos(turn) - x * np.sin(turn))
    height = (np.cos(u) + np.cos(v)) / 2
    # As many dots as the tint says: the part of a screen that is higher than this.
    levels = np.linspace(-1, 1, 65)
    grid = np.cos(np.linspace(0, np.pi, 256))
    parts = ((grid[:, None] + grid) / 2).ravel()
    above = 1 - np.searchsorted(np.sort(parts), levels) / parts.size
    return np.clip(np.interp(height, levels, above), 0.01, 0.99).astype(np.float32)
