"""How much darker a drawing is than its paper, and what of that is print.

Light that passes layers of ink is multiplied, so densities (minus logarithms) add: pencil over print is the
sum of both.
"""

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.printed import PrintedPage
from graphcam.photo.raster import Raster

Channels = NDArray[np.float32]
"""Values (rows, columns, 3), red, green and blue."""
LUMA = np.array([0.3, 0.59, 0.11], np.float32)
"""Weights of a camera's brightness, which JPEG keeps sharp while it blurs the colours."""
PAPER = 5.0
"""Within so many mm there is bare paper beside every line."""
COARSE = 4
"""Pixels to a side of those in which the paper is looked for."""
DARKEST = 0.02
"""Below this share of the paper's light nothing is told."""
COLOURED = 0.2
"""How far the densities of an ink lie from grey, as a share of them, before its colour is used: that of light cyan is
half of them, that of a grey picture nothing."""
BARE_LINES = (5, 35)
"""Percentiles of the brightness on printed lines between which they bear no pencil."""
PATCH_EDGE = 1.2
"""The width of a patch's edge [mm], where blur mixes it with the paper."""
PATCH_RING = 1.5
"""The width of a ring beside a patch [mm], where bare paper is looked for."""
PATCH_DENSITY = (0.04, 1.2)
"""Densities that a patch of light print may have: others are a finger, or the edge of the photograph."""
PATCH_UNEVEN = 0.25
"""The difference of the quartiles of a patch, and of the paper about it; a greater one is half covered."""
GREY = np.ones(3)


def densities(linear: Channels, per_mm: float) -> Channels:
    """Density (rows, columns, 3) of what lies on the paper, against the paper about each place.

    linear : light, so that uneven light divides out

    >>> half = np.ones((64, 64, 3), np.float32)
    >>> half[:, 30:33] = 0.5
    >>> densities(half, 4.0)[32, 31].round(2).tolist()
    [0.6899999976158142, 0.6899999976158142, 0.6899999976158142]
    """
    rows, columns = linear.shape[:2]
    small = cv2.resize(linear, (max(columns // COARSE, 1), max(rows // COARSE, 1)), interpolation=cv2.INTER_AREA)
    width = round(PAPER * per_mm / COARSE) | 1
    closed = cv2.morphologyEx(small, cv2.MORPH_CLOSE, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (width, width)))
    paper = cv2.resize(cv2.GaussianBlur(closed, (0, 0), width / 4), (columns, rows), interpolation=cv2.INTER_LINEAR)
    np.maximum(paper, 1e-3, out=paper)
    np.divide(linear, paper, out=paper)
    np.clip(paper, DARKEST, 1.5, out=paper)
    return np.asarray(-cv2.log(paper), np.float32)


def ink_of_patches(pictures: Sequence[Raster], page: PrintedPage) -> NDArray[np.float64] | None:
    """Densities (3,) of the printed ink, from the patches that are filled with it; None where no patch is shown.

    pictures : light, linear, of parts of the page
    """
    seen = [_patch(picture, corner, page.patch_side) for picture in pictures for corner in page.patches]
    found = [density for density in seen if density is not None]
    return np.mean(found, 0) if found else None


def ink_of_lines(soft: Raster, lines: Sequence[NDArray[np.complex128]]) -> NDArray[np.float64] | None:
    """The ink measured on the printed lines, where they bear no pencil; None where there are none.

    soft : densities (rows, columns, 3), blurred
    """
    on = soft.values[lines_mask(lines, soft) > 0]
    if not on.size:
        return None
    grey = on @ LUMA
    low, high = np.percentile(grey, BARE_LINES)
    return np.median(on[(grey >= low) & (grey <= high)], 0).astype(float)


def weights_against(ink: NDArray[np.float64], soft: Channels) -> NDArray[np.float32]:
    """Weights (3,) of the channels that answer to grey with its density, to the ink with nought, and least to noise.

    soft : densities, blurred as they are used

    >>> grey = np.random.default_rng(1).normal(size=(50, 50, 3)).astype(np.float32)
    >>> weights = weights_against(np.array([0.4, 0.2, 0.05]), grey)
    >>> round(float(weights.sum()), 3), round(abs(float(weights @ [0.4, 0.2, 0.05])), 3)
    (1.0, 0.0)
    """
    precision = np.linalg.inv(_noise_of_lines(soft))
    wanted = np.stack([GREY, ink], 1) if is_coloured(ink) else GREY[:, None]
    answers = np.eye(wanted.shape[1])[0]
    return (precision @ wanted @ np.linalg.solve(wanted.T @ precision @ wanted, answers)).astype(np.float32)


def is_coloured(ink: NDArray[np.float64]) -> bool:
    """Whether an ink's densities (3,) can be told from grey."""
    return float(np.linalg.norm(ink - ink.mean())) > COLOURED * float(np.linalg.norm(ink))


def lines_mask(lines: Sequence[NDArray[np.complex128]], picture: Raster) -> NDArray[np.uint8]:
    """A mask of the lines (rows, columns), one pixel wide: 255 there, else 0."""
    mask = np.zeros(picture.values.shape[:2], np.uint8)
    fraction = 4
    for line in lines:
        corners = np.round(picture.pixels(line) * 2**fraction).astype(np.int32)
        cv2.polylines(mask, [corners], False, 255, 1, cv2.LINE_8, fraction)
    return mask


def lines_about(lines: Sequence[NDArray[np.complex128]], picture: Raster) -> NDArray[np.uint8]:
    """How many lines run within a mm of each pixel (rows, columns); where they cross, their densities add."""
    rows, columns = picture.values.shape[:2]
    count = np.zeros((-(-rows // COARSE), -(-columns // COARSE)), np.uint8)
    coarse = Raster(count, picture.left, picture.top, picture.per_mm / COARSE)
    for line in lines:
        mask = np.zeros(count.shape, np.uint8)
        cv2.polylines(mask, [np.round(coarse.pixels(line)).astype(np.int32)], False, 1, round(2 * coarse.per_mm))
        count += mask
    return np.asarray(np.repeat(np.repeat(count, COARSE, 0), COARSE, 1)[:rows, :columns])


def _patch(linear: Raster, corner: complex, side: float) -> NDArray[np.float64] | None:
    left, bottom, right, top = linear.box
    edge = PATCH_RING + 0.5
    if not (left < corner.real - edge and corner.real + side + edge < right):
        return None
    if not (bottom < corner.imag - edge and corner.imag + side + edge < top):
        return None
    middle, across = corner + side / 2 * (1 + 1j), np.linspace(PATCH_EDGE - side / 2, side / 2 - PATCH_EDGE, 30)
    inside = middle + across[:, None] + 1j * across
    ring = middle + np.outer(np.array([1, 1j, -1, -1j]), side / 2 + PATCH_RING + 1j * across)
    channels = [linear.like(np.ascontiguousarray(linear.values[..., channel])) for channel in range(3)]
    paper, inked = (
        np.log(np.maximum([channel.at(places).ravel() for channel in channels], DARKEST)) for places in (ring, inside)
    )
    density = np.median(paper, 1) - np.median(inked, 1)
    quartiles = [float(np.ptp(np.percentile(part, (25, 75), axis=1), axis=0).max()) for part in (paper, inked)]
    faintest, darkest = PATCH_DENSITY
    return density if max(quartiles) < PATCH_UNEVEN and faintest < density @ LUMA < darkest else None


def _noise_of_lines(soft: Channels) -> NDArray[np.float64]:
    """Covariance (3, 3) of the channels on bare paper, at the width of a line."""
    fine = soft[::3, ::3]
    bands = (fine - cv2.GaussianBlur(fine, (0, 0), 2.0))[::2, ::2].reshape(-1, 3)
    grey = bands.mean(1)
    away = np.abs(grey - np.median(grey))
    quiet = bands[away <= 2 * np.median(away)]
    return np.cov(quiet.T) + 1e-8 * np.eye(3)
