"""The texts of QR codes in a picture, also where the paper is oblique, dark or smeared."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np
import zxingcpp
from numpy.typing import NDArray

from graphcam.photo.pictures import LINEAR_LIGHT
from graphcam.photo.tags import CELLS_PER_SIDE, Grey, Places, Tags

Photograph = NDArray[np.uint8]
MIN_PIXELS = 21
"""The minimum side of a picture [px]: no code has fewer modules."""
COARSE_PIXELS = 2000
"""The longer side of the reduced picture that is tried first [px]; most codes are read in it."""
PAPER_PARTS = 25
"""The shorter side of a picture over the distance within which the brightest place shows bare paper."""
MAX_PIXELS = 4000
"""The maximum longer side of a picture that is evened [px]."""
CELL_PIXELS = 8.0
"""The side of a tag's cell in an evened picture [px]: a cell of a code is at most half as wide."""
DEBLURRING_SETTINGS = ((1.0, 0.03), (1.0, 0.1), (1.5, 0.03), (1.5, 0.01), (2.0, 0.03), (2.0, 0.01))
"""Settings of deblurring: the part of the blur that is removed, and the noise that is assumed."""
LIKELY_PLACES = 4
"""The number of places with many edges, as a code has, that are deblurred."""
WINDOW_CELLS, MARGIN_CELLS = 10.0, 16.0
"""The window in which edges are counted, and the half side of a part that is tried [cells of a tag]."""
ENLARGEMENT = 1.5
"""The factor by which a code is enlarged for another try."""
DEFAULT_BLUR_WIDTHS = (1.5, 3.0)
"""The widths of blur for which pictures are sharpened where none was measured [px]."""
EDGE_DEVIATIONS = 1.683
"""The width of a blurred edge between a fifth and four fifths of its light, in standard deviations."""
MIN_CORNER_SCALE = 0.3
"""The minimum scale at the farthest corner of a picture, as a part of that in its middle."""
MIN_TAGS = 3
"""The minimum number of tags for the perspective of the paper."""
SHARPENING = 2.0
"""The multiple of the difference to the blurred picture that sharpening adds."""


def codes_in(pixels: Photograph, tags: Tags | None = None) -> list[str]:
    """The texts of the QR codes in a picture (h, w, 3) or (h, w), each once.

    tags : those of the page, if they have been found; they help where the paper is oblique, and where some are there
        twice another sheet's code is looked for in the whole picture too
    """
    grey = pixels if pixels.ndim == 2 else np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY), np.uint8)
    if min(grey.shape) < MIN_PIXELS:
        return []
    texts: dict[str, None] = {}
    for picture in _tries(grey, tags):
        found = zxingcpp.read_barcodes(picture, formats=zxingcpp.BarcodeFormat.QRCode)  # pyright: ignore[reportArgumentType]
        texts |= {code.text: None for code in found if code.valid and code.text}
        reduced = picture.size < grey.size
        if texts and not (reduced and tags is not None and tags.doubled):
            break
    return list(texts)


def _tries(grey: Grey, tags: Tags | None) -> Iterator[Grey]:
    """Versions of the picture for the reader of codes, the cheapest first."""
    shrink = COARSE_PIXELS / max(grey.shape)
    if shrink < 1:
        yield _enlarged(grey, shrink)
    yield grey
    even = _even(grey)
    yield even
    upright = None if tags is None else _upright_picture(even, tags)
    if upright is not None:
        yield upright.picture
        for place in _likely_parts(upright):
            for clear in _unblurred(place, upright.blur):
                yield clear
                yield _enlarged(clear, ENLARGEMENT)
    for width in DEFAULT_BLUR_WIDTHS:
        yield _sharpened(even, width)
    # Small codes of small pictures.
    if max(grey.shape) < COARSE_PIXELS:
        yield _enlarged(even, 2.0)


def _enlarged(grey: Grey, factor: float) -> Grey:
    way = cv2.INTER_AREA if factor < 1 else cv2.INTER_CUBIC
    return np.asarray(cv2.resize(grey, None, fx=factor, fy=factor, interpolation=way), np.uint8)


def _even(grey: Grey) -> Grey:
    """The picture without shadows, its paper white everywhere."""
    small = cv2.resize(grey, None, fx=0.125, fy=0.125, interpolation=cv2.INTER_AREA)
    size = max(3, min(small.shape) // PAPER_PARTS | 1)
    paper = cv2.blur(cv2.dilate(small, np.ones((size, size), np.uint8)), (size, size))
    height, width = grey.shape
    wide = cv2.resize(paper, (width, height), interpolation=cv2.INTER_LINEAR)
    return np.asarray(cv2.divide(grey, wide, scale=235), np.uint8)


def _sharpened(grey: Grey, width: float) -> Grey:
    blurred = cv2.GaussianBlur(grey, (0, 0), width)
    return np.asarray(cv2.addWeighted(grey, 1 + SHARPENING, blurred, -SHARPENING, 0), np.uint8)


def _likely_parts(upright: UprightPicture) -> Iterator[Grey]:
    """Parts of a picture with many edges in both directions, as a code has."""
    picture, cell = upright.picture, upright.cell
    size = (round(WINDOW_CELLS * cell), round(WINDOW_CELLS * cell))
    across, down = (cv2.Sobel(picture, cv2.CV_32F, *way) for way in ((1, 0), (0, 1)))
    counts: NDArray[np.float32] = np.minimum(cv2.blur(np.abs(across), size), cv2.blur(np.abs(down), size))
    for middle in upright.tags.tolist():
        counts[_window_slices(middle.imag, middle.real, round(CELLS_PER_SIDE * cell))] = 0
    for _ in range(LIKELY_PLACES):
        row, column = divmod(int(np.argmax(counts)), counts.shape[1])
        near = _window_slices(row, column, round(MARGIN_CELLS * cell))
        yield np.ascontiguousarray(picture[near])
        counts[near] = 0


def _window_slices(row: float, column: float, reach: int) -> tuple[slice, slice]:
    low, left = max(0, round(row) - reach), max(0, round(column) - reach)
    return slice(low, max(0, round(row) + reach)), slice(left, max(0, round(column) + reach))


def _unblurred(grey: Grey, blur: float) -> Iterator[Grey]:
    """Versions of a picture before a Gaussian blur [px], by Wiener's filter."""
    rows, columns = (cv2.getOptimalDFTSize(length) for length in grey.shape)
    height, width = grey.shape
    # Beyond the picture it is as at its edges, which otherwise would shine into it.
    wide = cv2.copyMakeBorder(grey, 0, rows - height, 0, columns - width, cv2.BORDER_REPLICATE)
    light = LINEAR_LIGHT[np.asarray(wide, np.uint8)]
    seen = np.fft.rfft2(light)
    squared = np.fft.fftfreq(rows)[:, None] ** 2 + np.fft.rfftfreq(columns) ** 2
    for part, noise in DEBLURRING_SETTINGS:
        lost = np.exp(-2 * (np.pi * part * blur) ** 2 * squared)
        found = np.fft.irfft2(seen * (lost / (lost**2 + noise)), (rows, columns))[:height, :width]
        yield np.clip(found * (255 / np.percentile(found, 97)), 0, 255).astype(np.uint8)


@dataclass(frozen=True, eq=False)
class UprightPicture:
    """A picture as if seen from straight above.

    blur : standard deviation [px] in its middle
    tags : (n,) their middles;  cell : the side of their cells [px]
    """

    picture: Grey
    blur: float
    tags: Places
    cell: float


def _upright_picture(grey: Grey, tags: Tags) -> UprightPicture | None:
    """The picture as if seen from straight above, by its tags; None if these do not determine it."""
    level = _level(grey, tags)
    if level is None:
        return None
    # What has lost its perspective becomes right by an affine map that makes the tags squares.
    seen = _mapped_places(level, tags.corners)
    right = ((seen[:, 1] - seen[:, 0]) + (seen[:, 2] - seen[:, 3])).mean() / 2
    up = ((seen[:, 3] - seen[:, 0]) + (seen[:, 2] - seen[:, 1])).mean() / 2
    affine = np.eye(3)
    affine[:2, :2] = (
        CELL_PIXELS * CELLS_PER_SIDE * np.diag([1, -1]) @ np.linalg.inv([[right.real, up.real], [right.imag, up.imag]])
    )
    height, width = grey.shape
    ends = _mapped_places(affine @ level, np.array([0, width, width + 1j * height, 1j * height]))
    low = complex(ends.real.min(), ends.imag.min())
    spans = np.array([ends.real.max() - low.real, ends.imag.max() - low.imag])
    scale = min(1.0, MAX_PIXELS / spans.max())
    placed = np.diag([scale, scale, 1.0]) @ np.array([[1, 0, -low.real], [0, 1, -low.imag], [0, 0, 1]])
    columns, rows = np.ceil(spans * scale).astype(int)
    upright = cv2.warpPerspective(grey, placed @ affine @ level, (int(columns), int(rows)), borderValue=255)
    sides = np.abs(np.roll(tags.corners, -1, axis=1) - tags.corners)
    widths = 0.02 * sides if tags.widths is None else tags.widths
    cell = CELL_PIXELS * scale
    blur = float(np.median(widths / sides)) * CELLS_PER_SIDE * cell / EDGE_DEVIATIONS
    middles = _mapped_places(placed @ affine @ level, tags.corners.mean(axis=1))
    return UprightPicture(np.asarray(upright, np.uint8), blur, middles, cell)


def _level(grey: Grey, tags: Tags) -> NDArray[np.float64] | None:
    """The matrix (3, 3) that removes the perspective, by which all tags get one size; None if there is none.

    Seen obliquely, areas shrink with the third power of the distance, whose inverse is linear in the picture.
    """
    if len(tags) < MIN_TAGS:
        return None
    first, second = tags.corners[:, 2] - tags.corners[:, 0], tags.corners[:, 3] - tags.corners[:, 1]
    near = np.cbrt(np.abs((first.conj() * second).imag))
    middles = tags.corners.mean(axis=1)
    design = np.stack([middles.real, middles.imag, np.ones(len(middles))], -1)
    horizon = np.linalg.lstsq(design, near / near.mean(), rcond=None)[0]
    height, width = grey.shape
    corners = np.array([[0, 0, 1], [width, 0, 1], [width, height, 1], [0, height, 1]], float)
    if (corners @ horizon <= MIN_CORNER_SCALE).any():
        return None
    return np.array([[1, 0, 0], [0, 1, 0], horizon])


def _mapped_places(matrix: NDArray[np.float64], places: Places) -> Places:
    solid = np.stack([places.real, places.imag, np.ones(places.shape)], -1) @ matrix.T
    return (solid[..., 0] + 1j * solid[..., 1]) / solid[..., 2]
