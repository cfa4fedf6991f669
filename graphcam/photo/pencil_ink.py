"""The pencil on a page, with the print removed, as far as a photograph shows it; nothing here knows curves.

Light print is removed by its colour: all channels are blurred alike (cameras blur the colours anyway), and weighed so
that the ink of the printed patches vanishes.  Where there is no colour, the print's own profile is taken off along its
lines.

Light that passes layers of ink is multiplied, so densities (minus logarithms) add: pencil over print is the
sum of both.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.printed_page import Edges, Points, PrintedPage
from graphcam.photo.raster import Raster, spread
from graphcam.photo.rectify import EvenPicture

BLUR_WIDTH = 0.22
"""The blur of all channels before they are mixed [mm], by which print vanishes a third better."""
BLUR_PIXELS = 2.0
"""The minimum blur [px of the photograph], as wide as its colours are blurred."""
CAMERA_PIXEL = 0.112
"""The default side of a pixel of the photograph on the paper [mm]: A3 at 12 megapixels."""
BLACK_PRINT_MARGIN = 0.45
"""The width of the margin about black print [mm] that its blur reaches."""
MAX_PRINT_FACTOR = 1.4
"""The darkness, as a multiple of a printed line's, above which something was drawn, whatever its colour."""
PROFILE_BIN = 0.05
"""The step of the distance to a printed line in which its profile is measured [mm]."""
PROFILE_REACH = 1.2
"""Half the width of a printed line's profile [mm]."""
FLANK_DISTANCE = 0.9
"""The distance from which on a profile shows bare paper [mm]."""
PRINT_NEIGHBOURHOOD = 0.8
"""The distance from a printed line within which a stroke may be confused with what is left of it [mm]."""
RESIDUE_STEP = 0.5
"""The step along printed lines at which their residue is measured [mm]."""


Channels = NDArray[np.float32]
"""Values (rows, columns, 3), red, green and blue."""
LUMA_WEIGHTS = np.array([0.3, 0.59, 0.11], np.float32)
"""Weights of a camera's brightness, which JPEG keeps sharp while it blurs the colours."""
BARE_PAPER_REACH = 5.0
"""The distance within which there is bare paper beside every line [mm]."""
COARSE_PIXELS = 4
"""The side of the coarse pixels in which the paper is looked for [px]."""
MIN_LIGHT_SHARE = 0.02
"""The minimum brightness, as a share of the paper's, for a density."""
MIN_COLOUR_SHARE = 0.2
"""The minimum distance of an ink's densities from grey, as a share of them, for use of its colour: half for light cyan,
zero for a grey picture."""
BARE_LINE_PERCENTILES = (5, 35)
"""The percentiles of brightness between which printed lines bear no pencil."""
PATCH_EDGE = 1.2
"""The width of a patch's edge, where blur mixes it with the paper [mm]."""
PATCH_RING = 1.5
"""The width of the ring of bare paper beside a patch [mm]."""
PATCH_DENSITY = (0.04, 1.2)
"""The range of densities of a patch of light print: others are a finger, or the edge of the photograph."""
MAX_PATCH_UNEVENNESS = 0.25
"""The maximum difference of the quartiles of a patch, and of the paper about it; a greater one is half covered."""
GREY_INK = np.ones(3)


def densities(linear: Channels, per_mm: float) -> Channels:
    """Densities (rows, columns, 3) on the paper, relative to the bare paper about each place.

    linear : light, so that uneven light divides out

    >>> half = np.ones((64, 64, 3), np.float32)
    >>> half[:, 30:33] = 0.5
    >>> densities(half, 4.0)[32, 31].round(2).tolist()
    [0.6899999976158142, 0.6899999976158142, 0.6899999976158142]
    """
    rows, columns = linear.shape[:2]
    small = cv2.resize(
        linear, (max(columns // COARSE_PIXELS, 1), max(rows // COARSE_PIXELS, 1)), interpolation=cv2.INTER_AREA
    )
    width = round(BARE_PAPER_REACH * per_mm / COARSE_PIXELS) | 1
    closed = cv2.morphologyEx(small, cv2.MORPH_CLOSE, cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (width, width)))
    paper = cv2.resize(cv2.GaussianBlur(closed, (0, 0), width / 4), (columns, rows), interpolation=cv2.INTER_LINEAR)
    np.maximum(paper, 1e-3, out=paper)
    np.divide(linear, paper, out=paper)
    np.clip(paper, MIN_LIGHT_SHARE, 1.5, out=paper)
    return np.asarray(-cv2.log(paper), np.float32)


def ink_of_patches(pictures: Sequence[Raster], page: PrintedPage) -> NDArray[np.float64] | None:
    """Densities (3,) of the printed ink, from the patches filled with it; None where no patch is seen.

    pictures : light, linear, of parts of the page
    """
    seen = [_patch(picture, corner, page.patch_side) for picture in pictures for corner in page.patches]
    found = [density for density in seen if density is not None]
    return np.mean(found, 0) if found else None


def ink_of_lines(soft: Raster, lines: Sequence[NDArray[np.complex128]]) -> NDArray[np.float64] | None:
    """Densities (3,) of the printed ink, from printed lines without pencil; None where there are none.

    soft : densities (rows, columns, 3), blurred
    """
    on = soft.values[lines_mask(lines, soft) > 0]
    if not on.size:
        return None
    grey = on @ LUMA_WEIGHTS
    low, high = np.percentile(grey, BARE_LINE_PERCENTILES)
    return np.median(on[(grey >= low) & (grey <= high)], 0).astype(float)


def weights_against(ink: NDArray[np.float64], soft: Channels) -> NDArray[np.float32]:
    """Weights (3,) of the channels that answer to grey with its density, to the ink with zero, and least to noise.

    soft : densities, blurred as they are used

    >>> grey = np.random.default_rng(1).normal(size=(50, 50, 3)).astype(np.float32)
    >>> weights = weights_against(np.array([0.4, 0.2, 0.05]), grey)
    >>> round(float(weights.sum()), 3), round(abs(float(weights @ [0.4, 0.2, 0.05])), 3)
    (1.0, 0.0)
    """
    precision = np.linalg.inv(_noise_of_lines(soft))
    wanted = np.stack([GREY_INK, ink], 1) if is_coloured(ink) else GREY_INK[:, None]
    answers = np.eye(wanted.shape[1])[0]
    return (precision @ wanted @ np.linalg.solve(wanted.T @ precision @ wanted, answers)).astype(np.float32)


def is_coloured(ink: NDArray[np.float64]) -> bool:
    """Whether an ink's densities (3,) can be told from grey."""
    return float(np.linalg.norm(ink - ink.mean())) > MIN_COLOUR_SHARE * float(np.linalg.norm(ink))


def lines_mask(lines: Sequence[NDArray[np.complex128]], picture: Raster) -> NDArray[np.uint8]:
    """A mask (rows, columns) of the lines, one pixel wide: 255 on a line, else 0."""
    mask = np.zeros(picture.values.shape[:2], np.uint8)
    fraction = 4
    for line in lines:
        corners = np.round(picture.pixels(line) * 2**fraction).astype(np.int32)
        cv2.polylines(mask, [corners], False, 255, 1, cv2.LINE_8, fraction)
    return mask


def lines_about(lines: Sequence[NDArray[np.complex128]], picture: Raster) -> NDArray[np.uint8]:
    """The number (rows, columns) of lines within a mm of each pixel; where they cross, their densities add."""
    rows, columns = picture.values.shape[:2]
    count = np.zeros((-(-rows // COARSE_PIXELS), -(-columns // COARSE_PIXELS)), np.uint8)
    coarse = Raster(count, picture.left, picture.top, picture.per_mm / COARSE_PIXELS)
    for line in lines:
        mask = np.zeros(count.shape, np.uint8)
        cv2.polylines(mask, [np.round(coarse.pixels(line)).astype(np.int32)], False, 1, round(2 * coarse.per_mm))
        count += mask
    return np.asarray(np.repeat(np.repeat(count, COARSE_PIXELS, 0), COARSE_PIXELS, 1)[:rows, :columns])


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
    channels = [linear.with_values(np.ascontiguousarray(linear.values[..., channel])) for channel in range(3)]
    paper, inked = (
        np.log(np.maximum([channel.at(places).ravel() for channel in channels], MIN_LIGHT_SHARE))
        for places in (ring, inside)
    )
    density = np.median(paper, 1) - np.median(inked, 1)
    quartiles = [float(np.ptp(np.percentile(part, (25, 75), axis=1), axis=0).max()) for part in (paper, inked)]
    faintest, darkest = PATCH_DENSITY
    return density if max(quartiles) < MAX_PATCH_UNEVENNESS and faintest < density @ LUMA_WEIGHTS < darkest else None


def _noise_of_lines(soft: Channels) -> NDArray[np.float64]:
    """The covariance (3, 3) of the channels on bare paper, at the width of a line."""
    fine = soft[::3, ::3]
    bands = (fine - cv2.GaussianBlur(fine, (0, 0), 2.0))[::2, ::2].reshape(-1, 3)
    grey = bands.mean(1)
    away = np.abs(grey - np.median(grey))
    quiet = bands[away <= 2 * np.median(away)]
    return np.cov(quiet.T) + 1e-8 * np.eye(3)


@dataclass(frozen=True, eq=False)
class Ink:
    """The drawn ink of a page.

    pencil : density with the print removed, blurred; zero on black print
    sharp : that density without blur, to place a line by
    black : 1 where black print hides what was drawn, else 0
    print_distance : to the nearest printed light line [mm], at most ``PROFILE_REACH`` (all of it, where there is none)
    residue : density that is left of the printed lines, against their surroundings
    noise : standard deviation of the density at the size of a line's width
    """

    pencil: Raster
    sharp: Raster
    black: Raster
    print_distance: Raster
    residue: float
    noise: float

    def at(self, points: Points) -> NDArray[np.float32]:
        """Densities (...) of the pencil at places (...) on the page."""
        return self.pencil.at(points)

    def beside_print(self, points: Points) -> NDArray[np.bool_]:
        """Flags (...) of places (...) on the page at a printed light line."""
        return self.print_distance.at(points, nearest=True) < PRINT_NEIGHBOURHOOD


def ink_of(
    flat: EvenPicture, page: PrintedPage, pixel: float = CAMERA_PIXEL, patches: Sequence[EvenPicture] = ()
) -> Ink:
    """The pencil in a rectified photograph.

    flat : light, linear;  page : what was printed;  pixel : side of a photograph's pixel on the paper [mm]
    patches : further parts of the photograph, in which patches of the printed ink may be shown
    """
    light = _light(flat)
    density = densities(flat.linear, flat.per_mm)
    blur = max(BLUR_WIDTH, BLUR_PIXELS * pixel) * flat.per_mm
    soft = np.asarray(cv2.GaussianBlur(density, (0, 0), blur), np.float32)
    sharp, blurred = density @ LUMA_WEIGHTS, soft @ LUMA_WEIGHTS
    del density
    ink = _printed_ink(page, [light, *(_light(part) for part in patches)], light.with_values(soft))
    side = page.patch_side
    squares = ((at.real, at.imag, at.real + side, at.imag + side) for at in page.patches)
    black = light.with_values(_black((*page.black, *squares), light))
    distance = light.with_values(_distance(page.givens, light))
    if is_coloured(ink):
        neutral = soft @ weights_against(ink, soft)
        # JPEG smears the print's colour into a dark stroke over it, which then seems to be print; but print is light.
        most = MAX_PRINT_FACTOR * _crest(light.with_values(blurred), black, page.givens)
        np.maximum(neutral, blurred - np.float32(most) * np.maximum(lines_about(page.givens, light), 1), out=neutral)
        # The sharp picture has no colour of its own: it is dimmed where the soft one is print.
        sharp *= np.clip(neutral / np.maximum(blurred, 0.02), 0, 1)
    else:
        neutral = _without_profile(blurred, distance.values, black.values)
        sharp = _without_profile(sharp, distance.values, black.values)
    del soft, blurred
    neutral[black.values > 0] = 0
    sharp[black.values > 0] = 0
    pencil = light.with_values(neutral.astype(np.float32))
    residue = _crest(pencil, black, page.givens)
    return Ink(pencil, light.with_values(sharp.astype(np.float32)), black, distance, residue, _noise(pencil))


def _light(flat: EvenPicture) -> Raster:
    return Raster(flat.linear, flat.box[0], flat.box[3], flat.per_mm)


def _printed_ink(page: PrintedPage, pictures: Sequence[Raster], soft: Raster) -> NDArray[np.float64]:
    """Densities (3,) of the ink of the givens, as far as they can be measured."""
    if page.ink == "grey":
        return GREY_INK
    for ink in (ink_of_patches(pictures, page), ink_of_lines(soft, page.givens)):
        if ink is not None:
            return ink
    return GREY_INK


def _black(boxes: Sequence[Edges], light: Raster) -> NDArray[np.uint8]:
    mask = np.zeros(light.values.shape[:2], np.uint8)
    for left, bottom, right, top in boxes:
        first, last = light.pixels(np.array([complex(left, top), complex(right, bottom)]))
        edge = BLACK_PRINT_MARGIN * light.per_mm
        columns, rows = (
            slice(max(0, int(np.floor(low - edge))), max(0, int(np.ceil(high + edge)) + 1))
            for low, high in zip(first, last, strict=True)
        )
        mask[rows, columns] = 1
    return mask


def _distance(givens: Sequence[Points], light: Raster) -> NDArray[np.float32]:
    lines = lines_mask(givens, light)
    if not lines.any():
        return np.full(lines.shape, PROFILE_REACH, np.float32)
    distance = cv2.distanceTransform(255 - lines, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) / light.per_mm
    return np.minimum(distance, PROFILE_REACH).astype(np.float32)


def _without_profile(
    density: NDArray[np.float32], distance: NDArray[np.float32], black: NDArray[np.uint8]
) -> NDArray[np.float32]:
    """Densities without the median profile across printed lines, most of whose length bears no pencil."""
    bins = np.round(distance / PROFILE_BIN).astype(np.uint8)
    near = (distance < PROFILE_REACH) & (black == 0)
    values, of = density[near], bins[near]
    order = np.argsort(of, kind="stable")
    pieces = np.split(values[order], np.searchsorted(of[order], np.arange(1, round(PROFILE_REACH / PROFILE_BIN) + 1)))
    profile = np.array([np.median(piece) if piece.size else 0.0 for piece in pieces], np.float32)
    flank = round(FLANK_DISTANCE / PROFILE_BIN)
    profile = np.maximum(profile - np.median(profile[flank:-1]), 0)
    profile[flank:] = 0
    return density - profile[bins]


def _crest(density: Raster, black: Raster, givens: Sequence[Points]) -> float:
    """The density of the printed lines: the median along them of the middle less the flanks."""
    across = np.arange(-PROFILE_REACH, PROFILE_REACH + 0.05, 0.1)
    left = [_places_across(line, across) for line in givens if line.size > 1]
    if not left:
        return 0.0
    places = np.concatenate(left)
    found = density.at(places)
    box = density.box
    middle = places[:, across.size // 2]
    inside = (box[0] < middle.real) & (middle.real < box[2]) & (box[1] < middle.imag) & (middle.imag < box[3])
    free = inside & (black.at(middle, nearest=True) < 0.5)
    if not free.any():
        return 0.0
    flanks = found[free][:, np.abs(across) > 0.75].mean(1)
    return max(0.0, float(np.median(found[free][:, np.abs(across) < 0.25].mean(1) - flanks)))


def _places_across(line: Points, across: NDArray[np.float64]) -> Points:
    """Places (n, m) across a polyline, every half mm along it."""
    lengths = np.abs(np.diff(line))
    run = np.concatenate([[0.0], np.cumsum(lengths)])
    at = np.arange(RESIDUE_STEP / 2, run[-1], RESIDUE_STEP)
    piece = np.clip(np.searchsorted(run, at, side="right") - 1, 0, lengths.size - 1)
    ahead = np.diff(line)[piece] / np.maximum(lengths[piece], 1e-9)
    middle = line[piece] + ahead * (at - run[piece])
    return middle[:, None] + 1j * ahead[:, None] * across


def _noise(pencil: Raster) -> float:
    fine = pencil.reduced(pencil.per_mm / 2).values
    return spread(np.asarray(fine - cv2.GaussianBlur(fine, (0, 0), 0.6 * pencil.per_mm / 2), np.float32))
