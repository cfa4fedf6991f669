"""A flat page under a camera: a homography, and a lens that bends straight lines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.fitting import Numbers, Prior

Places = NDArray[np.complex128]
REACH = 200.0
"""mm that count as one in a homography, so that its numbers are alike."""
LENS = (0.08, 0.03)
"""How much a lens may bend: k1 and k2, at half the picture's longer side from its centre."""
CROPPED = 0.1
"""How far the lens's middle may be from the picture's, in the same unit: people cut off edges."""
UNDONE = 12
"""Rounds in which the lens is taken away again; each makes the miss ten times smaller at least."""


@dataclass(frozen=True, eq=False)
class Frame:
    """What a page and a picture are measured by.

    middle : of the paper's part with tags [mm];  half : from there to its upper right corner
    centre : of the picture [px]; the lens is round about it
    unit : half the picture's longer side [px]
    """

    middle: complex
    half: complex
    centre: complex
    unit: float

    @staticmethod
    def of(points: Places, size: tuple[int, int]) -> Frame:
        """The frame for places on the paper (n,) [mm], and a picture of so many columns and rows."""
        columns, rows = size
        low, high = complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max())
        return Frame((low + high) / 2, (high - low) / 2, complex(columns - 1, rows - 1) / 2, max(size) / 2)


@dataclass(frozen=True, eq=False)
class Plane:
    """A flat page.

    Its parameters are eight of a homography, two of the lens, and two of where its middle is in the picture.
    """

    frame: Frame

    def prior(self) -> Prior:
        """Nothing is known of where the page lies; lenses bend little, and pictures are cut little."""
        return Prior(np.zeros(12), np.array([*[np.inf] * 8, *LENS, CROPPED, CROPPED]))

    def start(self, points: Places, found: Places) -> Numbers:
        """The parameters (12,) for which points of the paper (n,) are about where they were found."""
        paper, picture = (points - self.frame.middle) / REACH, (found - self.frame.centre) / self.frame.unit
        from_paper, to_picture = (np.stack([places.real, places.imag], -1) for places in (paper, picture))
        matrix = cast("Numbers | None", cv2.findHomography(from_paper, to_picture)[0])
        if matrix is None or abs(matrix[2, 2]) < 1e-9:
            matrix = np.eye(3)
        return np.concatenate([(matrix / matrix[2, 2]).ravel()[:8], np.zeros(4)])

    def project(self, parameters: Numbers, points: Places) -> Places:
        """Points (..., n) of the paper [mm] as places in the picture, for parameters (..., 12)."""
        paper = (points - self.frame.middle) / REACH
        a, b, c, d, e, f, g, h = np.moveaxis(parameters[..., :8], -1, 0)[..., None]
        x, y = paper.real, paper.imag
        with np.errstate(divide="ignore", invalid="ignore"):
            straight = (a * x + b * y + c + 1j * (d * x + e * y + f)) / (g * x + h * y + 1)
        middle = parameters[..., 10, None] + 1j * parameters[..., 11, None]
        return self.frame.centre + self.frame.unit * (middle + bent(straight - middle, parameters[..., 8:10]))

    def unproject(self, parameters: Numbers, places: Places) -> Places:
        """Places of the picture as points of the paper [mm], for parameters (12,)."""
        middle = complex(parameters[10], parameters[11])
        straight = middle + unbent((places - self.frame.centre) / self.frame.unit - middle, parameters[8:10])
        back = np.linalg.inv(np.append(parameters[:8], 1.0).reshape(3, 3))
        x, y = straight.real, straight.imag
        over, up, depth = (row[0] * x + row[1] * y + row[2] for row in back)
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.frame.middle + REACH * (over + 1j * up) / depth


def bent(straight: Places, lens: Numbers) -> Places:
    """The places to which a lens (..., 2) of k1 and k2 puts places (..., n)."""
    squared = straight.real**2 + straight.imag**2
    first, second = np.moveaxis(lens, -1, 0)[..., None]
    return straight * (1 + first * squared + second * squared**2)


def unbent(seen: Places, lens: Numbers) -> Places:
    """The places that a lens (2,) puts where they are seen."""
    radius = np.abs(seen)
    straight = radius.copy()
    first, second = lens
    for _ in range(UNDONE):
        value = straight * (1 + first * straight**2 + second * straight**4)
        slope = np.maximum(1 + 3 * first * straight**2 + 5 * second * straight**4, 0.2)
        straight = straight - (value - radius) / slope
    return seen * np.divide(straight, radius, out=np.ones_like(radius), where=radius > 0)
