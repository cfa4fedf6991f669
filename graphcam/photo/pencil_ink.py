"""What was drawn on a page, with the print removed, as far as a photograph shows it; no curve is known here.

Light print is removed by its colour: all channels are blurred alike (cameras blur the colours anyway), and weighed so
that the ink of the printed patches vanishes.  Where there is no colour, the print's own profile is taken off along its
lines.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.paper import (
    GREY,
    LUMA,
    densities,
    ink_of_lines,
    ink_of_patches,
    is_coloured,
    lines_about,
    lines_mask,
    weights_against,
)
from graphcam.photo.printed import Edges, Points, PrintedPage
from graphcam.photo.raster import Raster
from graphcam.photo.rectify import Flat
from graphcam.photo.ridges import spread

BLUR = 0.22
"""All channels are blurred by so much before they are mixed [mm]: print then vanishes a third better."""
BLUR_PIXELS = 2.0
"""The minimum blur in pixels of the photograph, as wide as its colours are blurred."""
CAMERA_PIXEL = 0.112
"""Side of a pixel of the photograph on the paper [mm], if it is not given: A3 at 12 megapixels."""
BLACK_EDGE = 0.45
"""The width of the margin about black print [mm] that its blur reaches."""
OF_PRINT = 1.4
"""What is darker than so many times a printed line has been drawn, whatever its colour."""
PROFILE_BIN = 0.05
"""Steps of the distance to a printed line [mm] in which its profile is measured."""
PROFILE = 1.2
"""Half the width of a printed line's profile [mm]."""
FLANK = 0.9
"""The distance from which on the profile is bare paper [mm]."""
BESIDE_PRINT = 0.8
"""The distance from a printed line [mm] within which a stroke must be told from what is left of the line."""
RESIDUE_STEP = 0.5
"""Places along printed lines [mm] at which is looked what is left of them."""


@dataclass(frozen=True, eq=False)
class Ink:
    """What was drawn.

    pencil : density with the print removed, soft; nought on black print
    sharp : the same as sharp as the photograph is, to place a line by
    black : 1 where black print hides what was drawn, else 0
    print_distance : to the nearest printed light line [mm], at most ``PROFILE`` (all of it, where there is none)
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
        """Density of the pencil at places on the page (...)."""
        return self.pencil.at(points)

    def beside_print(self, points: Points) -> NDArray[np.bool_]:
        """Whether places on the page (...) lie at a printed light line."""
        return self.print_distance.at(points, nearest=True) < BESIDE_PRINT


def ink_of(flat: Flat, page: PrintedPage, pixel: float = CAMERA_PIXEL, patches: Sequence[Flat] = ()) -> Ink:
    """The pencil in a rectified photograph.

    flat : light, linear;  page : what was printed;  pixel : side of a photograph's pixel on the paper [mm]
    patches : further parts of the photograph, in which patches of the printed ink may be shown
    """
    light = _light(flat)
    density = densities(flat.linear, flat.per_mm)
    blur = max(BLUR, BLUR_PIXELS * pixel) * flat.per_mm
    soft = np.asarray(cv2.GaussianBlur(density, (0, 0), blur), np.float32)
    sharp, blurred = density @ LUMA, soft @ LUMA
    del density
    ink = _printed_ink(page, [light, *(_light(part) for part in patches)], light.like(soft))
    black = light.like(_black(page.black + _patch_boxes(page), light))
    distance = light.like(_distance(page.givens, light))
    if is_coloured(ink):
        neutral = soft @ weights_against(ink, soft)
        # JPEG smears the print's colour into a dark stroke over it, which then seems to be print; but print is light.
        most = OF_PRINT * _crest(light.like(blurred), black, page.givens)
        np.maximum(neutral, blurred - np.float32(most) * np.maximum(lines_about(page.givens, light), 1), out=neutral)
        # The sharp picture has no colour of its own: it is dimmed where the soft one is print.
        sharp *= np.clip(neutral / np.maximum(blurred, 0.02), 0, 1)
    else:
        neutral = _without_profile(blurred, distance.values, black.values)
        sharp = _without_profile(sharp, distance.values, black.values)
    del soft, blurred
    neutral[black.values > 0] = 0
    sharp[black.values > 0] = 0
    pencil = light.like(neutral.astype(np.float32))
    residue = _crest(pencil, black, page.givens)
    return Ink(pencil, light.like(sharp.astype(np.float32)), black, distance, residue, _noise(pencil))


def _light(flat: Flat) -> Raster:
    return Raster(flat.linear, flat.box[0], flat.box[3], flat.per_mm)


def _printed_ink(page: PrintedPage, pictures: Sequence[Raster], soft: Raster) -> NDArray[np.float64]:
    """Densities (3,) of the ink of the givens, as far as any can be told."""
    if page.ink == "grey":
        return GREY
    for ink in (ink_of_patches(pictures, page), ink_of_lines(soft, page.givens)):
        if ink is not None:
            return ink
    return GREY


def _black(boxes: Sequence[Edges], light: Raster) -> NDArray[np.uint8]:
    mask = np.zeros(light.values.shape[:2], np.uint8)
    for left, bottom, right, top in boxes:
        first, last = light.pixels(np.array([complex(left, top), complex(right, bottom)]))
        edge = BLACK_EDGE * light.per_mm
        columns, rows = (
            slice(max(0, int(np.floor(low - edge))), max(0, int(np.ceil(high + edge)) + 1))
            for low, high in zip(first, last, strict=True)
        )
        mask[rows, columns] = 1
    return mask


def _patch_boxes(page: PrintedPage) -> tuple[Edges, ...]:
    side = page.patch_side
    return tuple((at.real, at.imag, at.real + side, at.imag + side) for at in page.patches)


def _distance(givens: Sequence[Points], light: Raster) -> NDArray[np.float32]:
    lines = lines_mask(givens, light)
    if not lines.any():
        return np.full(lines.shape, PROFILE, np.float32)
    distance = cv2.distanceTransform(255 - lines, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) / light.per_mm
    return np.minimum(distance, PROFILE).astype(np.float32)


def _without_profile(
    density: NDArray[np.float32], distance: NDArray[np.float32], black: NDArray[np.uint8]
) -> NDArray[np.float32]:
    """The median profile across the printed lines taken off: most of their length bears no pencil."""
    bins = np.round(distance / PROFILE_BIN).astype(np.uint8)
    near = (distance < PROFILE) & (black == 0)
    values, of = density[near], bins[near]
    order = np.argsort(of, kind="stable")
    pieces = np.split(values[order], np.searchsorted(of[order], np.arange(1, round(PROFILE / PROFILE_BIN) + 1)))
    profile = np.array([np.median(piece) if piece.size else 0.0 for piece in pieces], np.float32)
    flank = round(FLANK / PROFILE_BIN)
    profile = np.maximum(profile - np.median(profile[flank:-1]), 0)
    profile[flank:] = 0
    return density - profile[bins]


def _crest(density: Raster, black: Raster, givens: Sequence[Points]) -> float:
    """How dark the printed lines are: the middle less the flanks, the median along them, pencil or no pencil."""
    across = np.arange(-PROFILE, PROFILE + 0.05, 0.1)
    left = [_across(line, across) for line in givens if line.size > 1]
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


def _across(line: Points, across: NDArray[np.float64]) -> Points:
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
