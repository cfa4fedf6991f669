"""A page that is folded once or rolled, under a camera whose lens is known about: paper bends, but does not stretch."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.fitting import Numbers, Prior
from graphcam.photo.planes import LENS, Frame, Plane, bent

Places = NDArray[np.complex128]
FAR = 100.0
"""mm that count as one in a place, so that the parameters are alike."""
USUAL_FOCAL = 1.48
"""The focal length of a telephone's lens, in halves of the picture's longer side."""
FOCAL_OFF = 0.15
"""The part by which a lens that is not known may differ from that."""
FOCAL_KNOWN_OFF = 0.05
"""The part by which a picture's own word may be wrong."""
STRETCHED = 0.007
"""The part by which a printer may draw longer across than up."""
TURNED = 3.0
"""Radians: a direction may be any."""
FOLDED = 0.3
"""Angles of folds, in radians."""
ROLLED = (0.2, 0.07, 0.15, 0.07)
"""Slopes that a rolled sheet gains towards its edge: evenly, to one side, faster and faster, and faster yet."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(6)
"""Gauss nodes and weights for lengths along a rolled sheet."""
POSE = 10
"""Parameters that every bent sheet has before those of its shape."""
SEARCHED = 25
"""Rounds in which a place of the picture is found on the paper."""
SLIGHT = 0.02
"""mm for the slope of the map there."""


@dataclass(frozen=True, eq=False)
class Sheet:
    """What folded and rolled sheets have in common.

    Their parameters: the logarithm of the focal length over ``focal``, a rotation (3), a place (3, in ``FAR``), k1
    and k2, the stretch across; then the direction in which the height changes, and what the shape says.

    focal : of the lens [px]
    focal_off : the part by which it may be wrong
    flat : the plane through the same tags and its parameters, near which places are searched
    """

    frame: Frame
    focal: float
    focal_off: float
    flat: tuple[Plane, Numbers]

    def shaped(self, along: Numbers, shape: Numbers) -> tuple[Numbers, Numbers]:
        """Distance and height [mm] at lengths (..., n) along the paper, for a shape's numbers (k, ..., 1)."""
        raise NotImplementedError

    def shape_spread(self) -> list[float]:
        """How large the parameters of the shape may be."""
        raise NotImplementedError

    def shape_starts(self) -> list[tuple[float, ...]]:
        """Shapes to begin with, their direction first."""
        raise NotImplementedError

    def prior(self) -> Prior:
        """The lens is known about; where the sheet lies is not."""
        spread = [self.focal_off, *[np.inf] * 6, *LENS, STRETCHED, TURNED, *self.shape_spread()]
        return Prior(np.zeros(len(spread)), np.array(spread))

    def starts(self, points: Places, found: Places) -> Numbers:
        """Parameters (b, m) to begin with: the flat sheet's poses and every shape."""
        paper = points - self.frame.middle
        # The camera looks along its third axis, and rows go down.
        solid = np.stack([paper.real, -paper.imag, np.zeros(len(paper))], -1)
        picture = np.stack([found.real, found.imag], -1)
        centre = self.frame.centre
        camera = np.array([[self.focal, 0, centre.real], [0, self.focal, centre.imag], [0, 0, 1]])
        try:
            poses = cv2.solvePnPGeneric(solid, picture, camera, None, flags=cv2.SOLVEPNP_IPPE)[1:3]
        except cv2.error:
            # Tags in a line tell no pose.
            poses = ((), ())
        begun = [
            [0.0, *np.ravel(turn), *np.ravel(place) / FAR, 0.0, 0.0, 0.0]
            for turn, place in zip(*poses, strict=True)
            if np.ravel(place)[2] > 0
        ]
        starts = [[*pose, *shape] for pose, shape in product(begun, self.shape_starts())]
        return np.array(starts).reshape(len(starts), len(self.prior().values))

    def project(self, parameters: Numbers, points: Places) -> Places:
        """Points (..., n) of the paper [mm] as places in the picture [px], for parameters (..., m)."""
        paper = points - self.frame.middle
        focal, stretch = self.focal * np.exp(parameters[..., 0, None]), parameters[..., 9, None]
        paper = paper.real * (1 + stretch) + 1j * paper.imag * (1 - stretch)
        turned = paper * np.exp(-1j * parameters[..., POSE, None])
        along, height = self.shaped(turned.real, np.moveaxis(parameters[..., POSE + 1 :, None], -2, 0))
        laid = (along + 1j * turned.imag) * np.exp(1j * parameters[..., POSE, None])
        rotation = _rotations(parameters[..., 1:4])
        solid = np.stack([laid.real, -laid.imag, np.broadcast_to(height, laid.shape)], -2)
        seen = rotation @ solid + FAR * parameters[..., 4:7, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            straight = (seen[..., 0, :] + 1j * seen[..., 1, :]) / seen[..., 2, :]
        pixels = straight * focal / self.frame.unit
        return self.frame.centre + self.frame.unit * bent(pixels, parameters[..., 7:9])

    def unproject(self, parameters: Numbers, places: Places) -> Places:
        """Places (n,) of the picture [px] as points of the paper [mm], for parameters (m,)."""
        plane, flat = self.flat
        points = plane.unproject(flat, places)
        for _ in range(SEARCHED):
            here = self.project(parameters, points)
            across = (self.project(parameters, points + SLIGHT) - here) / SLIGHT
            upward = (self.project(parameters, points + SLIGHT * 1j) - here) / SLIGHT
            missing = places - here
            area = (across.conj() * upward).imag
            right, up = (missing.conj() * upward).imag / area, (across.conj() * missing).imag / area
            points = points + right + 1j * up
            if np.abs(missing).max(initial=0.0) < 1e-9:
                break
        return points


class Folded(Sheet):
    """Folded once along a straight line: the direction across it, its place, and the angle [rad]."""

    def shaped(self, along: Numbers, shape: Numbers) -> tuple[Numbers, Numbers]:
        """Flat up to the fold, and flat again after it."""
        place, angle = shape
        beyond = np.maximum(along - FAR * place, 0.0)
        return along - beyond * (1 - np.cos(angle)), beyond * np.sin(angle)

    def shape_spread(self) -> list[float]:
        """Anywhere on the sheet."""
        return [1.5, FOLDED]

    def shape_starts(self) -> list[tuple[float, ...]]:
        """Across and along and slanting, at several places, to both sides."""
        half = self.frame.half
        starts = []
        for turn, part, angle in product((0.0, 0.7, 1.57, -0.7), (-0.5, 0.0, 0.5), (-0.15, 0.15)):
            reach = abs(half.real * np.cos(turn)) + abs(half.imag * np.sin(turn))
            starts.append((turn, part * reach / FAR, angle))
        return starts


class Rolled(Sheet):
    """Rolled as a part of a cylinder of any section: the direction across it, and how its slope changes along that."""

    def shaped(self, along: Numbers, shape: Numbers) -> tuple[Numbers, Numbers]:
        """Lengths along the paper stay, so that the distance is the sum of the slopes' cosines, the height of sines."""
        size = abs(self.frame.half)
        part = along / size
        cosines, sines = np.zeros_like(part), np.zeros_like(part)
        for node, weight in zip((NODES + 1) / 2, WEIGHTS / 2, strict=True):
            there = part * node
            first, second, third, fourth = shape
            slope = there * (first + second * there + third * np.abs(there) + fourth * there**2)
            cosines, sines = cosines + weight * np.cos(slope), sines + weight * np.sin(slope)
        return along * cosines, along * sines

    def shape_spread(self) -> list[float]:
        """Slopes at half the sheet's diagonal from its middle."""
        return [*ROLLED]

    def shape_starts(self) -> list[tuple[float, ...]]:
        """Start values in four directions, to both sides."""
        return [(turn, slope, 0.0, 0.0, 0.0) for turn, slope in product((0.0, 0.7, 1.57, -0.7), (-0.1, 0.1))]


def bent_sheets(frame: Frame, focal: float | None, flat: tuple[Plane, Numbers]) -> tuple[Folded, Rolled]:
    """Both shapes, with the usual focal length [px] if none is known, and the plane with its parameters."""
    known, off = (USUAL_FOCAL * frame.unit, FOCAL_OFF) if focal is None else (focal, FOCAL_KNOWN_OFF)
    return Folded(frame, known, off, flat), Rolled(frame, known, off, flat)


def _rotations(turns: Numbers) -> Numbers:
    """Matrices (..., 3, 3) of rotations about vectors (..., 3) by their lengths [rad]."""
    angle = np.linalg.norm(turns, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(turns, -1, 0)
    none = np.zeros_like(x)
    cross = np.stack([none, -z, y, z, none, -x, -y, x, none], -1).reshape(*turns.shape[:-1], 3, 3)
    return np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * np.sinc(angle / 2 / np.pi) ** 2 * cross @ cross
