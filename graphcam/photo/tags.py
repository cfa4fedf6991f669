"""The square tags of a page in a picture: their numbers, and the places of their corners.

Places in a picture are complex: columns to the right, rows down, and whole numbers at the centres of pixels.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.pictures import LINEAR_LIGHT
from graphcam.photo.tag_family import CELLS_PER_SIDE, TAG_COUNT, dark_cells

Places = NDArray[np.complex128]
"""Places in a picture [px]."""
Grey = NDArray[np.uint8]
SEARCH_PIXELS = 2000
"""The longer side of the picture in which tags are looked for [px]; corners are then found at full size."""
MIN_CIRCUMFERENCE = 0.02
"""The minimum circumference of a tag, as a share of the picture's longer side: 10 pixels a side."""
MAX_SQUARES = 400
"""The maximum number of squares that are examined, the largest first."""
MAX_WRONG_CELLS = 3
"""The maximum number of wrong cells of a tag; any two tags differ in at least eleven."""
EDGE_FRACTIONS = np.linspace(0.08, 0.92, 49)
"""The fractions of an edge (49,) at which it is examined, away from the neighbouring edges."""
EDGE_REACH = 0.7
"""The distance to both sides of an edge that is examined [cells]: the rim is one wide, and so is the white."""
MIN_EDGE_SAMPLES = 24
"""The minimum number of samples across an edge; otherwise there are two per pixel."""
REFINEMENT_ROUNDS = 3
"""The number of rounds that refine the corners."""
EDGE_LEVELS = np.array([0.2, 0.5, 0.8])
"""Light levels from black (0) to white (1): the edge is at the middle one, its width is between the others."""
_UNIT_SQUARE = np.array([[0, 1], [1, 1], [1, 0], [0, 0]], np.float32)
"""The corners of a unit square in the order of a tag's, rows down."""
MIN_CONTRAST = 0.08
"""The minimum contrast of white over black, as a share of full light."""
MIN_VISIBLE_SHARE = 0.6
"""The minimum part of an edge that is seen: a finger may hide the rest."""


@dataclass(frozen=True, eq=False)
class Tags:
    """Tags in a picture.

    numbers : (n,) of the tags
    corners : (n, 4) of the black squares: those at the lower left, lower right, upper right, upper left on the paper
    widths : (n, 4) of their edges [px], below, right, above, left, in which the light goes from a fifth of
        the way between black and white to four fifths; None if they were not measured
    doubled : how many numbers were left out because they are there twice, as in a photograph of two sheets
    """

    numbers: NDArray[np.int64]
    corners: Places
    widths: NDArray[np.float64] | None = None
    doubled: int = 0

    def __len__(self) -> int:
        return len(self.numbers)

    def selected(self, kept: NDArray[np.bool_]) -> Tags:
        """The tags that a mask (n,) chooses."""
        widths = None if self.widths is None else self.widths[kept]
        return Tags(self.numbers[kept], self.corners[kept], widths, self.doubled)


def find_tags(grey: Grey) -> Tags:
    """The tags in a picture (h, w); a number that is there twice is ambiguous, and left out."""
    found: dict[int, list[tuple[Places, NDArray[np.float64]]]] = {}
    for square in _squares(grey):
        sharp = _sharpened_corners(grey, square)
        read = None if sharp is None else _read_tag(grey, sharp[0])
        if sharp is None or read is None:
            continue
        number, turns = read
        corners, widths = np.roll(sharp[0], -turns), np.roll(sharp[1], -turns)
        others = found.setdefault(number, [])
        # One that was found along both sides of its rim is one.
        if all(np.abs(corners - other).max() > np.abs(corners[2] - corners[0]) / CELLS_PER_SIDE for other, _ in others):
            others.append((corners, widths))
    single = {number: places[0] for number, places in sorted(found.items()) if len(places) == 1}
    return Tags(
        np.array(list(single), int),
        np.array([corners for corners, _ in single.values()], complex).reshape(-1, 4),
        np.array([widths for _, widths in single.values()], float).reshape(-1, 4),
        len(found) - len(single),
    )


def _squares(grey: Grey) -> Places:
    """Candidates (n, 4) for black squares: their corners anticlockwise on the paper, from any of them on."""
    shrink = max(1.0, max(grey.shape) / SEARCH_PIXELS)
    small = cv2.resize(grey, None, fx=1 / shrink, fy=1 / shrink, interpolation=cv2.INTER_AREA) if shrink > 1 else grey
    tags, _, others = _detector().detectMarkers(small)
    found = np.array([*tags, *others], float).reshape(-1, 4, 2)
    # Half pixels, as an enlarged pixel's centre moves.
    corners = (found[..., 0] + 1j * found[..., 1] + 0.5 + 0.5j) * shrink - 0.5 - 0.5j
    diagonals = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    area = (diagonals[0].conj() * diagonals[1]).imag
    # With rows that go down, what goes round with the clock in the picture has a positive area.
    corners = np.where((area > 0)[:, None], corners[:, ::-1], corners)
    large = np.argsort(-np.abs(area), kind="stable")[:MAX_SQUARES]
    return corners[np.sort(large)]


@cache
def _detector() -> cv2.aruco.ArucoDetector:
    settings = cv2.aruco.DetectorParameters()
    settings.minMarkerPerimeterRate = MIN_CIRCUMFERENCE
    family = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_APRILTAG_36h11)
    return cv2.aruco.ArucoDetector(family, settings)


@cache
def _family() -> NDArray[np.float64]:
    """The cells (n, 4, 64) of every tag, white 1 and black -1, in its four orientations."""
    cells = [np.where(dark_cells(number), -1.0, 1.0) for number in range(TAG_COUNT)]
    return np.array([[np.rot90(tag, turns).ravel() for turns in range(4)] for tag in cells])


def _read_tag(grey: Grey, corners: Places) -> tuple[int, int] | None:
    """The number of the tag within corners (4,), and the shift that puts these in order; None if it is none."""
    middles = (np.arange(CELLS_PER_SIDE) + 0.5) / CELLS_PER_SIDE
    right, down = np.meshgrid(middles, middles)
    ends = np.stack([corners.real, corners.imag], -1).astype(np.float32)
    inside = np.asarray(
        cv2.perspectiveTransform(np.stack([right, down], -1), cv2.getPerspectiveTransform(_UNIT_SQUARE, ends))
    )
    light = _sampled(grey, inside[..., 0] + 1j * inside[..., 1])
    if light is None:
        return None
    rim = np.concatenate([light[0], light[-1], light[:, 0], light[:, -1]])
    middle = (rim.mean() + np.sort(light[1:-1, 1:-1], axis=None)[-6:].mean()) / 2
    wrong = (_family() * np.sign(light - middle).ravel() < 0).sum(-1)
    number, turns = np.unravel_index(np.argmin(wrong), wrong.shape)
    return (int(number), int(turns)) if wrong[number, turns] <= MAX_WRONG_CELLS else None


def _sharpened_corners(grey: Grey, corners: Places) -> tuple[Places, NDArray[np.float64]] | None:
    """The corners (4,) where lines along the black square's edges meet, and the widths (4,) of the edges [px]."""
    widths = np.zeros(4)
    for _ in range(REFINEMENT_ROUNDS):
        edges = _edges(grey, corners)
        if edges is None:
            return None
        starts, ends, widths = edges
        moved = _meeting(np.roll(starts, 1), np.roll(ends, 1), starts, ends)
        if np.abs(moved - corners).max() > 0.1 * np.abs(corners[2] - corners[0]):
            return None
        corners = moved
    return corners, widths


def _edges(grey: Grey, corners: Places) -> tuple[Places, Places, NDArray[np.float64]] | None:
    """Two points (4,) of the line along each edge, and the widths (4,) of the edges; None if too little is seen."""
    following = np.roll(corners, -1)
    sides = following - corners
    lengths = np.abs(sides)
    # The corners go round against the clock on the paper, and so they do in the picture, whose rows go down.
    outward = 1j * sides / lengths
    reach = EDGE_REACH * lengths.min() / CELLS_PER_SIDE
    across = np.linspace(-reach, reach, max(MIN_EDGE_SAMPLES, round(4 * reach)))
    base = corners[:, None] + sides[:, None] * EDGE_FRACTIONS
    light = _sampled(grey, base[..., None] + outward[:, None, None] * across)
    if light is None:
        return None
    quarter = len(across) // 4
    black, white = light[..., :quarter].mean(-1), light[..., -quarter:].mean(-1)
    rise = white - black
    with np.errstate(divide="ignore", invalid="ignore"):
        parts = (light - black[..., None]) / rise[..., None]
    places, crossed = _crossings(parts, across)
    good = crossed.all(0) & (rise > MIN_CONTRAST)
    if (good.mean(-1) < MIN_VISIBLE_SHARE).any():
        return None
    ends = np.array([_line(offsets, seen) for offsets, seen in zip(places[1], good, strict=True)])
    widths = [np.median((high - low)[seen]) for low, high, seen in zip(places[0], places[2], good, strict=True)]
    return corners + outward * ends[:, 0], following + outward * ends[:, 1], np.array(widths)


def _sampled(grey: Grey, places: Places) -> NDArray[np.float64] | None:
    """The light at places of the picture, interpolated; None if one is outside."""
    columns, rows = np.floor(places.real).astype(int), np.floor(places.imag).astype(int)
    height, width = grey.shape
    if columns.min() < 0 or rows.min() < 0 or columns.max() > width - 2 or rows.max() > height - 2:
        return None
    right, down = places.real - columns, places.imag - rows
    above = LINEAR_LIGHT[grey[rows, columns]] * (1 - right) + LINEAR_LIGHT[grey[rows, columns + 1]] * right
    below = LINEAR_LIGHT[grey[rows + 1, columns]] * (1 - right) + LINEAR_LIGHT[grey[rows + 1, columns + 1]] * right
    return above * (1 - down) + below * down


def _crossings(
    parts: NDArray[np.float64], across: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Places where profiles (..., k) last pass each level before they are white, and flags of whether they do so."""
    places, crossed = [], []
    for level in EDGE_LEVELS:
        above = parts >= level
        # The last step from below to above.
        step = ~above[..., :-1] & above[..., 1:]
        last = step.shape[-1] - 1 - np.argmax(step[..., ::-1], axis=-1)
        low = np.take_along_axis(parts, last[..., None], -1)[..., 0]
        high = np.take_along_axis(parts, last[..., None] + 1, -1)[..., 0]
        with np.errstate(divide="ignore", invalid="ignore"):
            places.append(across[last] + (across[1] - across[0]) * (level - low) / (high - low))
        crossed.append(step.any(-1))
    return np.array(places), np.array(crossed)


def _line(offsets: NDArray[np.float64], seen: NDArray[np.bool_]) -> tuple[float, float]:
    """Offsets at both ends of the straight line through the seen ones, in which outliers weigh little."""
    along, found = EDGE_FRACTIONS[seen] - 0.5, offsets[seen]
    weights = np.ones_like(found)
    middle = slope = 0.0
    for _ in range(4):
        total = weights.sum()
        centre, mean = weights @ along / total, weights @ found / total
        slope = weights @ ((along - centre) * (found - mean)) / (weights @ (along - centre) ** 2)
        middle = mean - slope * centre
        misses = np.abs(found - middle - slope * along)
        weights = 1 / (1 + (misses / (2 * np.median(misses) + 1e-6)) ** 2)
    return float(middle - slope / 2), float(middle + slope / 2)


def _meeting(start: Places, end: Places, other_start: Places, other_end: Places) -> Places:
    way, other = end - start, other_end - other_start
    turned = (other_start - start) * other.conj()
    return start + way * turned.imag / (way * other.conj()).imag
