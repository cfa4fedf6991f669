"""A page on two sheets of A4, taped together at a seam and photographed one after the other.

Tape never holds them exactly in place.  So each photograph is to show the tags beyond the seam too, which
tell how the other sheet lies.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.page_surfaces import Surface
from graphcam.photo.pictures import PhotographError
from graphcam.photo.printed_page import SIDE_NAMES, Edges, PrintedPage, Side, half
from graphcam.photo.rectify import PIXELS_PER_MM, EvenPicture, rectify
from graphcam.photo.registration import CORNER_DIRECTIONS, Registration, register
from graphcam.photo.robust_fit import Numbers, Prior
from graphcam.photo.tags import Tags
from graphcam.words import say

Places = NDArray[np.complex128]
Photograph = NDArray[np.uint8]
MIN_NEIGHBOUR_TAGS = 2
"""The minimum number of tags beyond the seam that place the other sheet: one alone tells its turn badly."""
MAX_TAG_ERROR = 0.5
"""The maximum error of these tags, root of the mean square [mm]."""
MAX_SLIP = 8.0
"""The maximum shift of a sheet by the tape [mm]; with more, another sheet lies there."""
SEAM_NEIGHBOURHOOD = 45.0
"""The distance from the seam within which tags are near it [mm]."""
BLENDING_WIDTH = 2.0
"""The distance to both sides of the seam over which the pictures are blended [mm]."""
COMPARISON_WIDTH = 10.0
"""The distance to both sides of the seam in which the light of both pictures is compared [mm]."""


@dataclass(frozen=True, eq=False)
class Tile:
    """One sheet in a photograph.

    tags : all tags in the picture, the other sheet's too
    """

    picture: Photograph
    tags: Tags
    registration: Registration


@dataclass(frozen=True, eq=False)
class MovedSurface:
    """A surface of a sheet that is turned, then shifted [mm], on the paper."""

    surface: Surface
    turn: complex
    shift: complex

    def project(self, parameters: Numbers, points: Places) -> Places:
        """Points of the paper as places in the picture."""
        return self.surface.project(parameters, (points - self.shift) / self.turn)

    def unproject(self, parameters: Numbers, places: Places) -> Places:
        """Places of the picture as points of the paper."""
        return self.surface.unproject(parameters, places) * self.turn + self.shift

    def prior(self) -> Prior:
        """The prior of the surface's parameters."""
        return self.surface.prior()


def registered_tiles(
    picture: Photograph, tags: Tags, page: PrintedPage, focal: float | None = None
) -> dict[Side, Tile]:
    """The sheets of a page with a seam that a picture (h, w, 3) shows whole: one, or both.

    Raises
    ------
    PhotographError : it shows neither sheet whole
    """
    rows, columns = picture.shape[:2]
    found: dict[Side, Tile] = {}
    refused: list[tuple[int, PhotographError]] = []
    for side in SIDE_NAMES:
        sheet = half(page, side)
        own = tags.selected(np.isin(tags.numbers, list(sheet.tags)))
        try:
            found[side] = Tile(picture, tags, register(own, sheet, (columns, rows), focal))
        except PhotographError as error:
            refused.append((len(own), error))
    if not found:
        raise max(refused, key=lambda counted: counted[0])[1]
    return found


def joined_tiles(tiles: Mapping[Side, Tile], page: PrintedPage, anchor: Side = "left") -> dict[Side, Tile]:
    """Both sheets in the coordinates of one of them, the anchor, as they really lie.

    Raises
    ------
    PhotographError : one is missing, or the pictures do not show how they lie
    """
    missing = [side for side in SIDE_NAMES if side not in tiles]
    if missing:
        raise PhotographError(
            say("only one of the two sheets has been photographed"),
            say("photograph both, each with the marks beyond the seam"),
        )
    other: Side = SIDE_NAMES[1 - SIDE_NAMES.index(anchor)]
    # Tags of the other sheet as the anchor's picture shows them, and tags of the anchor as the other one's does.
    meant, there = _neighbours(tiles[anchor], half(page, other), page.seam or 0.0)
    back_there, back_meant = _neighbours(tiles[other], half(page, anchor), page.seam or 0.0)
    sources, targets = np.concatenate([meant, back_meant]), np.concatenate([there, back_there])
    if len(sources) < MIN_NEIGHBOUR_TAGS:
        raise PhotographError(
            say("the photographs do not show how the two sheets meet"),
            say("let each photograph show the marks beyond the seam too"),
        )
    turn, shift = _rigid(sources.ravel(), targets.ravel())
    missed = float(np.sqrt(np.mean(np.abs(sources * turn + shift - targets) ** 2)))
    slipped = float(np.abs(sources * turn + shift - sources).max())
    if missed > MAX_TAG_ERROR or slipped > MAX_SLIP:
        raise PhotographError(
            say("the two sheets do not form one page: their marks are {miss:.1f} mm off", miss=max(missed, slipped)),
            say("tape them flat, edge to edge, before drawing"),
        )
    moved = replace(tiles[other].registration, surface=MovedSurface(tiles[other].registration.surface, turn, shift))
    return {anchor: tiles[anchor], other: replace(tiles[other], registration=moved)}


def rectify_tiles(
    tiles: Mapping[Side, Tile], page: PrintedPage, box: Edges, per_mm: float = PIXELS_PER_MM
) -> EvenPicture:
    """A box of a joined page [mm] out of both pictures, which are blended over a few mm about the seam."""
    seam = page.seam or 0.0
    left, _, right, _ = box
    if right <= seam - BLENDING_WIDTH:
        return rectify(tiles["left"].picture, tiles["left"].registration, box, per_mm)
    if left >= seam + BLENDING_WIDTH:
        return rectify(tiles["right"].picture, tiles["right"].registration, box, per_mm)
    one = rectify(tiles["left"].picture, tiles["left"].registration, box, per_mm)
    two = rectify(tiles["right"].picture, tiles["right"].registration, box, per_mm)
    x = one.points(np.arange(one.linear.shape[1]) + 0j).real
    near = np.abs(x - seam) <= COMPARISON_WIDTH
    gain = np.median(one.linear[:, near], axis=(0, 1)) / np.maximum(np.median(two.linear[:, near], axis=(0, 1)), 1e-3)
    share = np.clip((x - seam) / BLENDING_WIDTH / 2 + 0.5, 0, 1).astype(np.float32)[:, None]
    linear = one.linear * (1 - share) + two.linear * (share * gain)
    return EvenPicture(np.asarray(linear, np.float32), one.box, per_mm)


def _neighbours(tile: Tile, sheet: PrintedPage, seam: float) -> tuple[Places, Places]:
    """Corners (n, 4) of the other sheet's tags in a picture: their intended places, and their real ones."""
    seen = tile.tags.selected(np.isin(tile.tags.numbers, list(sheet.tags)))
    corners: Places = np.array([sheet.tags[number] for number in seen.numbers.tolist()], np.complex128)
    meant = corners[:, None] + sheet.tag_side / 2 * (1 + 1j + CORNER_DIRECTIONS)
    # Farther tags are the farther from what the registration knows.
    near = np.abs(corners.real - seam) < SEAM_NEIGHBOURHOOD
    return meant[near], tile.registration.millimetres(seen.corners[near])


def _rigid(sources: Places, targets: Places) -> tuple[complex, complex]:
    """The turn and the shift that bring ``sources`` nearest to ``targets``."""
    start, end = complex(np.mean(sources)), complex(np.mean(targets))
    along = complex(np.vdot(sources - start, targets - end))
    turn = along / abs(along)
    return turn, end - turn * start
