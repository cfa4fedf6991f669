"""Where the eye of a camera or of a scanner sees a point of the paper, and the other way round.

Places on paper are complex mm, x to the right and y up from the lower left corner; those in a picture are complex
pixels, x to the right and y *down*, and whole numbers are the middles of pixels.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import cv2
import numpy as np
from bent_paper import Bend, Floats, Points
from scipy.interpolate import BSpline, make_interp_spline

Size = tuple[int, int]
"""Width and height in pixels."""
CELL = 12
"""The map of a picture is known at every so many pixels; a spline gives it between."""
FARTHEST = 250.0
"""So far beside the paper the table is still looked at, mm."""


class Eye(Protocol):
    """What sees the paper."""

    @property
    def size(self) -> Size:
        """Of its picture."""
        ...

    def pixels(self, points: Points) -> Points:
        """Where points (...) of the paper are seen."""
        ...


@dataclass(frozen=True, eq=False)
class Camera:
    """A pinhole with a lens.

    focal : length in pixels
    centre : of the lens, in the picture
    lens : k1 and k2 of its distortion
    turned : rotation (3, 3) from the paper's directions (x right, y down, z away) to the camera's
    place : of the paper's middle, seen from the camera [mm]
    """

    size: Size
    focal: float
    centre: complex
    lens: tuple[float, float]
    turned: Floats
    place: Floats
    bend: Bend

    def pixels(self, points: Points) -> Points:
        """Where points (...) of the paper are seen."""
        plan, height = self.bend.raised(np.asarray(points))
        seen = np.stack([plan.real, -plan.imag, -height], axis=-1) @ self.turned.T + self.place
        flat = (seen[..., 0] + 1j * seen[..., 1]) / seen[..., 2]
        square = flat.real**2 + flat.imag**2
        first, second = self.lens
        return np.asarray(self.focal * flat * (1 + square * (first + second * square)) + self.centre)


@dataclass(frozen=True, eq=False)
class Scanner:
    """A scanner, whose carriage does not run as exactly as its line of cells.

    per_mm : pixels, across and down
    turned : by how much the sheet lies askew [radians]
    corner : where the paper's lower left corner is seen
    """

    size: Size
    per_mm: tuple[float, float]
    turned: float
    corner: complex

    def pixels(self, points: Points) -> Points:
        """Where points (...) of the paper are seen."""
        lying = np.asarray(points) * np.exp(1j * self.turned)
        return np.asarray(self.corner + self.per_mm[0] * lying.real - 1j * self.per_mm[1] * lying.imag)


@dataclass(frozen=True, eq=False)
class Upright:
    """An eye whose picture was turned afterwards, by quarters of a turn clockwise."""

    eye: Eye
    quarters: int

    @property
    def size(self) -> Size:
        """Of the picture after turning."""
        width, height = self.eye.size
        return (height, width) if self.quarters % 2 else (width, height)

    def pixels(self, points: Points) -> Points:
        """Where points (...) of the paper are seen."""
        seen, (width, height) = self.eye.pixels(points), self.eye.size
        for _ in range(self.quarters % 4):
            seen, (width, height) = height - 1 + 1j * seen, (height, width)
        return seen


def rotation(across: float, up: float, about: float) -> Floats:
    """The rotation (3, 3) by three angles [degrees]: about x, then y, then the line of sight."""
    turned = np.eye(3)
    for axis, degrees in enumerate((across, up, about)):
        vector = np.zeros(3)
        vector[axis] = np.radians(degrees)
        turned = cv2.Rodrigues(vector)[0] @ turned
    return turned


def aimed(
    page: tuple[float, float],
    size: Size,
    turned: Floats,
    bend: Bend,
    *,
    focal: float = 0.78,
    lens: tuple[float, float] = (0.0, 0.0),
    fill: float = 0.92,
    aside: complex = 0j,
    shown: tuple[float, float, float, float] | None = None,
) -> Camera:
    """A camera so far away that the paper, or a part of it, fills its picture.

    page : width and height of the paper
    focal : length, of the picture's longer side
    fill : part of the picture, in the direction in which it is filled most
    aside : where in the room that is left the paper is, each way from -1 to 1
    shown : left, bottom, right and top of the part; None for all of the paper
    """
    left, low, right, high = shown or (0.0, 0.0, *page)
    width, height, edge = right - left, high - low, np.linspace(0, 1, 9)
    border = np.concatenate([edge * width, edge * width + 1j * height, 1j * edge * height, width + 1j * edge * height])
    border += left + 1j * low
    middle, longer = complex(size[0] - 1, size[1] - 1) / 2, max(size)
    place = np.array([0.0, 0.0, 1.5 * max(page)])
    camera = Camera(size, focal * longer, middle, lens, turned, place, bend)
    for _ in range(40):
        camera = Camera(size, focal * longer, middle, lens, turned, place, bend)
        seen = camera.pixels(border)
        spans = np.array([np.ptp(seen.real) / size[0], np.ptp(seen.imag) / size[1]])
        room = np.maximum(np.array(size) * (1 - spans), 0) / 2
        wanted = middle + aside.real * room[0] + 1j * aside.imag * room[1]
        now = complex(seen.real.min() + seen.real.max(), seen.imag.min() + seen.imag.max()) / 2
        shift = (wanted - now) * place[2] / camera.focal
        place = np.array([place[0] + shift.real, place[1] + shift.imag, place[2] * (spans.max() / fill) ** 0.8])
    return camera


def places_seen(eye: Eye, pixels: Points, page: tuple[float, float]) -> Points:
    """Which points of the paper, or of the table beside it, are seen at pixels (...); the inverse of ``Eye.pixels``."""
    width, height = page
    corners = np.array([0, width, width + 1j * height, 1j * height])
    seen = eye.pixels(corners)
    flat = cv2.getPerspectiveTransform(*(_pairs(each).astype(np.float32) for each in (seen, corners)))
    at = cv2.perspectiveTransform(_pairs(pixels.reshape(-1, 1)), flat)
    places = _near((at[..., 0] + 1j * at[..., 1]).reshape(pixels.shape), page)
    small = 0.01
    for _ in range(6):
        here = eye.pixels(places)
        across, up = (eye.pixels(places + small) - here) / small, (eye.pixels(places + small * 1j) - here) / small
        off, area = pixels - here, (np.conj(across) * up).imag
        area = np.where(np.abs(area) < 1e-6, 1e-6, area)
        step = (np.conj(off) * up).imag / area + 1j * (np.conj(across) * off).imag / area
        length = np.maximum(np.abs(step), 1e-12)
        places = _near(places + step * np.minimum(length, 150.0) / length, page)
    return places


def _near(places: Points, page: tuple[float, float]) -> Points:
    return np.clip(places.real, -FARTHEST, page[0] + FARTHEST) + 1j * np.clip(
        places.imag, -FARTHEST, page[1] + FARTHEST
    )


def _pairs(points: Points) -> Floats:
    return np.stack([points.real, points.imag], axis=-1)


@dataclass(frozen=True, eq=False)
class SeenPlaces:
    """What every pixel of an eye's picture sees.

    coarse : (rows, columns) the paper at every so many pixels; fine : the same at every pixel, x and y (2, h, w)
    """

    coarse: Points
    fine: tuple[NDFloat32, NDFloat32]


NDFloat32 = np.ndarray[tuple[int, ...], np.dtype[np.float32]]


def seen_places(eye: Eye, page: tuple[float, float]) -> SeenPlaces:
    """What every pixel sees, on paper."""
    width, height = eye.size
    columns, rows = (np.arange(0, length + 2 * CELL, CELL, dtype=np.float64) for length in (width, height))
    coarse = places_seen(eye, columns + 1j * rows[:, None], page)
    # Not cv2.resize or cv2.remap: these round places to 1/32 of a cell.
    down, across = _spline(rows, height), _spline(columns, width)
    fine = [_enlarged(part, rows, columns, down, across) for part in (coarse.real, coarse.imag)]
    return SeenPlaces(coarse, (fine[0], fine[1]))


def _spline(knots: Floats, count: int) -> BSpline:
    spline = make_interp_spline(knots, np.zeros(knots.size), k=3)
    return BSpline.design_matrix(np.arange(count, dtype=np.float64), spline.t, 3).astype(np.float32).tocsr()


def _enlarged(part: Floats, rows: Floats, columns: Floats, down: BSpline, across: BSpline) -> NDFloat32:
    of_rows = make_interp_spline(rows, part, k=3, axis=0).c
    of_both = make_interp_spline(columns, of_rows, k=3, axis=1).c
    # The spline's coefficients come with the interpolated axis first or where it was, by the version.
    if of_both.shape != part.shape:
        of_both = of_both.T
    wide = across @ np.ascontiguousarray(of_both.T, dtype=np.float32)
    return np.ascontiguousarray(down @ np.ascontiguousarray(wide.T))
