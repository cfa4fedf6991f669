"""Surfaces laid through the tags that are seen: a flat page if they lie on one, else one that is folded or rolled."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from typing import Literal, Protocol, cast

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.robust_fit import FittedParameters, Numbers, Prior, best_fit

Places = NDArray[np.complex128]
Kind = Literal["plane", "fold", "cylinder"]
MIN_TAGS = 3
"""The minimum number of tags for locating a page."""
CORNER_ERROR = 0.1
"""The expected error of a tag's corner in an ordinary picture [px]."""
EDGE_GROWTH = 0.1
"""The expected outward shift of tag edges by printing or light [mm], the same in the whole picture."""
FIT_ROUNDS = 40
"""The maximum number of rounds of a fit; it ends earlier as a rule."""
FLAT_PAGE_ERROR = 0.2
"""The mean error of the corners of a flat page [px] above which bent sheets are tried."""
SIMPLER_FIT_FACTOR = 2.0
"""The factor by which the error of a flat page may be greater: a bent one has four or five parameters more."""
SAME_FIT_FACTOR, SAME_FIT_SUM = 1.3, 4.0
"""The factor and the sum within which the errors of two bent sheets count as equal."""
STRAY_TAG_FACTOR = 6.0
"""The error of a tag, as a multiple of the median, above which it is out of place: partly hidden, or bent up."""
MIN_STRAY_PIXELS = 0.25
"""The minimum error of a tag that counts as out of place [px]."""


PLACE_UNIT = 100.0
"""mm that count as one in a place, so that the parameters are alike."""
DEFAULT_FOCAL_LENGTH = 1.48
"""The focal length of a telephone's lens, in halves of the picture's longer side."""
FOCAL_DEVIATION = 0.15
"""The standard deviation of an unknown focal length, as a part of it."""
KNOWN_FOCAL_DEVIATION = 0.05
"""The standard deviation of a focal length that the picture states, as a part of it."""
STRETCH_DEVIATION = 0.007
"""The standard deviation of a printer's stretch across against up, as a part."""
TURN_DEVIATION = 3.0
"""The standard deviation of a direction [rad]: any is possible."""
FOLD_DEVIATION = 0.3
"""The standard deviation of the angle of a fold [rad]."""
ROLL_DEVIATIONS = (0.2, 0.07, 0.15, 0.07)
"""Standard deviations of slopes that a roll gains towards its edge: evenly, to one side, faster, and faster yet."""
GAUSS_NODES, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(6)
"""Gauss nodes and weights for lengths along a rolled sheet."""
POSE_PARAMETERS = 10
"""The number of parameters of every bent sheet before those of its shape."""
SEARCH_ROUNDS = 25
"""The number of rounds in which a place of the picture is found on the paper."""
DIFFERENCE_STEP = 0.02
"""The step for the slope of the map there [mm]."""


HOMOGRAPHY_UNIT = 200.0
"""mm that count as one in a homography, so that its numbers are alike."""
LENS_DEVIATIONS = (0.08, 0.03)
"""Standard deviations of a lens's k1 and k2, at half the picture's longer side from its centre."""
CENTRE_DEVIATION = 0.1
"""The standard deviation of the lens's centre from the picture's, in the same unit: pictures may be cropped."""
UNDISTORTION_ROUNDS = 12
"""The number of rounds that remove the lens; each reduces the error at least ten times."""


@dataclass(frozen=True, eq=False)
class Frame:
    """The units and origins in which a page and a picture are measured.

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
        """The frame for places on the paper (n,) [mm], and a picture of ``size`` columns and rows."""
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
        """The prior: the pose is unknown; lenses bend little, and pictures are cropped little."""
        return Prior(np.zeros(12), np.array([*[np.inf] * 8, *LENS_DEVIATIONS, CENTRE_DEVIATION, CENTRE_DEVIATION]))

    def start(self, points: Places, found: Places) -> Numbers:
        """Parameters (12,) by which points of the paper (n,) are about where they were found."""
        paper, picture = (points - self.frame.middle) / HOMOGRAPHY_UNIT, (found - self.frame.centre) / self.frame.unit
        from_paper, to_picture = (np.stack([places.real, places.imag], -1) for places in (paper, picture))
        matrix = cast("Numbers | None", cv2.findHomography(from_paper, to_picture)[0])
        if matrix is None or abs(matrix[2, 2]) < 1e-9:
            matrix = np.eye(3)
        return np.concatenate([(matrix / matrix[2, 2]).ravel()[:8], np.zeros(4)])

    def project(self, parameters: Numbers, points: Places) -> Places:
        """Points (..., n) of the paper [mm] as places in the picture, for parameters (..., 12)."""
        paper = (points - self.frame.middle) / HOMOGRAPHY_UNIT
        a, b, c, d, e, f, g, h = np.moveaxis(parameters[..., :8], -1, 0)[..., None]
        x, y = paper.real, paper.imag
        with np.errstate(divide="ignore", invalid="ignore"):
            straight = (a * x + b * y + c + 1j * (d * x + e * y + f)) / (g * x + h * y + 1)
        middle = parameters[..., 10, None] + 1j * parameters[..., 11, None]
        return self.frame.centre + self.frame.unit * (
            middle + distorted_places(straight - middle, parameters[..., 8:10])
        )

    def unproject(self, parameters: Numbers, places: Places) -> Places:
        """Places of the picture as points of the paper [mm], for parameters (12,)."""
        middle = complex(parameters[10], parameters[11])
        straight = middle + undistorted_places(
            (places - self.frame.centre) / self.frame.unit - middle, parameters[8:10]
        )
        back = np.linalg.inv(np.append(parameters[:8], 1.0).reshape(3, 3))
        x, y = straight.real, straight.imag
        over, up, depth = (row[0] * x + row[1] * y + row[2] for row in back)
        with np.errstate(divide="ignore", invalid="ignore"):
            return self.frame.middle + HOMOGRAPHY_UNIT * (over + 1j * up) / depth


def distorted_places(straight: Places, lens: Numbers) -> Places:
    """Places (..., n) after distortion by a lens (..., 2) of k1 and k2."""
    squared = straight.real**2 + straight.imag**2
    first, second = np.moveaxis(lens, -1, 0)[..., None]
    return straight * (1 + first * squared + second * squared**2)


def undistorted_places(seen: Places, lens: Numbers) -> Places:
    """Places before distortion by a lens (2,), from places where they are seen."""
    radius = np.abs(seen)
    straight = radius.copy()
    first, second = lens
    for _ in range(UNDISTORTION_ROUNDS):
        value = straight * (1 + first * straight**2 + second * straight**4)
        slope = np.maximum(1 + 3 * first * straight**2 + 5 * second * straight**4, 0.2)
        straight = straight - (value - radius) / slope
    return seen * np.divide(straight, radius, out=np.ones_like(radius), where=radius > 0)


@dataclass(frozen=True, eq=False)
class Sheet:
    """What folded and rolled sheets have in common: pose and lens.

    Parameters: the logarithm of the focal length over ``focal``, a rotation (3), a place (3, in ``PLACE_UNIT``), k1
    and k2, the stretch across; then the direction in which the height changes, and those of the shape.

    focal : of the lens [px]
    focal_off : its standard deviation, as a part of it
    flat : the plane through the same tags and its parameters, near which places are searched
    """

    frame: Frame
    focal: float
    focal_off: float
    flat: tuple[Plane, Numbers]

    def shaped(self, along: Numbers, shape: Numbers) -> tuple[Numbers, Numbers]:
        """Distance and height [mm] at lengths (..., n) along the paper, for parameters (k, ..., 1) of a shape."""
        raise NotImplementedError

    def shape_spread(self) -> list[float]:
        """Standard deviations of the parameters of the shape."""
        raise NotImplementedError

    def shape_starts(self) -> list[tuple[float, ...]]:
        """Start values of the parameters of the shape, its direction first."""
        raise NotImplementedError

    def prior(self) -> Prior:
        """The prior: the lens is roughly known, the pose is not."""
        spread = [
            self.focal_off,
            *[np.inf] * 6,
            *LENS_DEVIATIONS,
            STRETCH_DEVIATION,
            TURN_DEVIATION,
            *self.shape_spread(),
        ]
        return Prior(np.zeros(len(spread)), np.array(spread))

    def starts(self, points: Places, found: Places) -> Numbers:
        """Start values (b, m) of the parameters: the flat sheet's poses with every shape."""
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
            [0.0, *np.ravel(turn), *np.ravel(place) / PLACE_UNIT, 0.0, 0.0, 0.0]
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
        turned = paper * np.exp(-1j * parameters[..., POSE_PARAMETERS, None])
        along, height = self.shaped(turned.real, np.moveaxis(parameters[..., POSE_PARAMETERS + 1 :, None], -2, 0))
        laid = (along + 1j * turned.imag) * np.exp(1j * parameters[..., POSE_PARAMETERS, None])
        rotation = _rotations(parameters[..., 1:4])
        solid = np.stack([laid.real, -laid.imag, np.broadcast_to(height, laid.shape)], -2)
        seen = rotation @ solid + PLACE_UNIT * parameters[..., 4:7, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            straight = (seen[..., 0, :] + 1j * seen[..., 1, :]) / seen[..., 2, :]
        pixels = straight * focal / self.frame.unit
        return self.frame.centre + self.frame.unit * distorted_places(pixels, parameters[..., 7:9])

    def unproject(self, parameters: Numbers, places: Places) -> Places:
        """Places (n,) of the picture [px] as points of the paper [mm], for parameters (m,)."""
        plane, flat = self.flat
        points = plane.unproject(flat, places)
        for _ in range(SEARCH_ROUNDS):
            here = self.project(parameters, points)
            across = (self.project(parameters, points + DIFFERENCE_STEP) - here) / DIFFERENCE_STEP
            upward = (self.project(parameters, points + DIFFERENCE_STEP * 1j) - here) / DIFFERENCE_STEP
            missing = places - here
            area = (across.conj() * upward).imag
            right, up = (missing.conj() * upward).imag / area, (across.conj() * missing).imag / area
            points = points + right + 1j * up
            if np.abs(missing).max(initial=0.0) < 1e-9:
                break
        return points


class Folded(Sheet):
    """A sheet folded once along a straight line: the direction across it, its place, and the angle [rad]."""

    def shaped(self, along: Numbers, shape: Numbers) -> tuple[Numbers, Numbers]:
        """Distance and height: flat up to the fold, and flat again behind it."""
        place, angle = shape
        beyond = np.maximum(along - PLACE_UNIT * place, 0.0)
        return along - beyond * (1 - np.cos(angle)), beyond * np.sin(angle)

    def shape_spread(self) -> list[float]:
        """Standard deviations of the fold: it may be anywhere on the sheet."""
        return [1.5, FOLD_DEVIATION]

    def shape_starts(self) -> list[tuple[float, ...]]:
        """Start values: folds across, along and slanting, at several places, to both sides."""
        half = self.frame.half
        starts = []
        for turn, part, angle in product((0.0, 0.7, 1.57, -0.7), (-0.5, 0.0, 0.5), (-0.15, 0.15)):
            reach = abs(half.real * np.cos(turn)) + abs(half.imag * np.sin(turn))
            starts.append((turn, part * reach / PLACE_UNIT, angle))
        return starts


class Rolled(Sheet):
    """A sheet rolled as a part of a cylinder of any section: the direction across it, and the change of its slope."""

    def shaped(self, along: Numbers, shape: Numbers) -> tuple[Numbers, Numbers]:
        """Distance and height as sums of the slopes' cosines and sines, since lengths along the paper stay."""
        size = abs(self.frame.half)
        part = along / size
        cosines, sines = np.zeros_like(part), np.zeros_like(part)
        for node, weight in zip((GAUSS_NODES + 1) / 2, GAUSS_WEIGHTS / 2, strict=True):
            there = part * node
            first, second, third, fourth = shape
            slope = there * (first + second * there + third * np.abs(there) + fourth * there**2)
            cosines, sines = cosines + weight * np.cos(slope), sines + weight * np.sin(slope)
        return along * cosines, along * sines

    def shape_spread(self) -> list[float]:
        """Standard deviations of the slopes at half the sheet's diagonal from its middle."""
        return [*ROLL_DEVIATIONS]

    def shape_starts(self) -> list[tuple[float, ...]]:
        """Start values in four directions, to both sides."""
        return [(turn, slope, 0.0, 0.0, 0.0) for turn, slope in product((0.0, 0.7, 1.57, -0.7), (-0.1, 0.1))]


def bent_sheets(frame: Frame, focal: float | None, flat: tuple[Plane, Numbers]) -> tuple[Folded, Rolled]:
    """A folded and a rolled sheet, with the default focal length [px] if none is known, and the plane."""
    known, off = (
        (DEFAULT_FOCAL_LENGTH * frame.unit, FOCAL_DEVIATION) if focal is None else (focal, KNOWN_FOCAL_DEVIATION)
    )
    return Folded(frame, known, off, flat), Rolled(frame, known, off, flat)


def _rotations(turns: Numbers) -> Numbers:
    """Matrices (..., 3, 3) of rotations about vectors (..., 3) by their lengths [rad]."""
    angle = np.linalg.norm(turns, axis=-1)[..., None, None]
    x, y, z = np.moveaxis(turns, -1, 0)
    none = np.zeros_like(x)
    cross = np.stack([none, -z, y, z, none, -x, -y, x, none], -1).reshape(*turns.shape[:-1], 3, 3)
    return np.eye(3) + np.sinc(angle / np.pi) * cross + 0.5 * np.sinc(angle / 2 / np.pi) ** 2 * cross @ cross


class Surface(Protocol):
    """A shape of paper under a camera, with parameters (m,)."""

    def project(self, parameters: Numbers, points: Places) -> Places:
        """Points (..., n) of the paper [mm] as places in the picture [px], for parameters (..., m)."""
        ...

    def unproject(self, parameters: Numbers, places: Places) -> Places:
        """Places of the picture [px] as points of the paper [mm], for parameters (m,)."""
        ...

    def prior(self) -> Prior:
        """The prior of the parameters."""
        ...


@dataclass(frozen=True, eq=False)
class SeenTags:
    """The tags of a page in a picture.

    points, outward : (n, 4) their corners on the paper [mm], and the direction outwards at each
    found : (n, 4) the corners in the picture [px]
    """

    points: Places
    outward: Places
    found: Places

    def selected(self, kept: NDArray[np.bool_]) -> SeenTags:
        """The tags that a mask (n,) chooses."""
        return SeenTags(self.points[kept], self.outward[kept], self.found[kept])


@dataclass(frozen=True, eq=False)
class LaidSurface:
    """A surface fitted to the tags.

    fit : its parameters, the growth of the tags as the last one
    sight : the tags that were used
    residual : by how much they miss [px], root of the mean square
    loss : of all tags, also those that were left out
    """

    kind: Kind
    surface: Surface
    fit: FittedParameters
    sight: SeenTags
    residual: float
    loss: float


def laid_surfaces(sight: SeenTags, frame: Frame, focal: float | None) -> list[LaidSurface]:
    """Surfaces that fit the tags about equally well, the best one first; a flat one alone if it fits."""
    plane = Plane(frame)
    points, found = sight.points.ravel(), sight.found.ravel()
    flat = laid_through(sight, "plane", plane, plane.start(points, found)[None])
    if flat.residual <= FLAT_PAGE_ERROR and len(flat.sight.points) == len(sight.points):
        return [flat]
    folded, rolled = bent_sheets(frame, focal, (plane, flat.fit.parameters[:-1]))
    kinds: list[tuple[Kind, Folded | Rolled]] = [("fold", folded), ("cylinder", rolled)]
    bends: list[LaidSurface] = []
    for kind, sheet in kinds:
        starts = sheet.starts(points, found)
        if len(starts):
            bends.append(laid_through(sight, kind, sheet, starts))
    bends.sort(key=lambda laid: laid.loss)
    if not bends or flat.loss <= SIMPLER_FIT_FACTOR * bends[0].loss:
        return [flat]
    best = bends[0]
    return [laid for laid in bends if laid.loss <= SAME_FIT_FACTOR * best.loss + SAME_FIT_SUM]


def laid_through(sight: SeenTags, kind: Kind, surface: Surface, starts: Numbers) -> LaidSurface:
    """A surface fitted to the tags from starts (b, m); tags out of place are left out, at most one in four."""
    fit = _fit(sight, surface, np.column_stack([starts, np.zeros(len(starts))]))
    misses = np.abs(_misplaced(sight, surface, fit.parameters)).max(-1)
    loss = fit.loss
    limit = max(MIN_STRAY_PIXELS, STRAY_TAG_FACTOR * float(np.median(misses)))
    kept = misses <= limit
    if not kept.all() and kept.sum() >= max(MIN_TAGS, 0.75 * len(kept)):
        sight = sight.selected(kept)
        fit = _fit(sight, surface, fit.parameters[None])
    residual = float(np.sqrt(np.mean(np.abs(_misplaced(sight, surface, fit.parameters)) ** 2)))
    return LaidSurface(kind, surface, fit, sight, residual, loss)


def _fit(sight: SeenTags, surface: Surface, starts: Numbers) -> FittedParameters:
    known = surface.prior()
    prior = Prior(np.append(known.values, 0.0), np.append(known.spread, EDGE_GROWTH))

    def misses(parameters: Numbers) -> Numbers:
        """The misses (..., n) of the corners in units of their expected error: columns, then rows."""
        places = _misplaced(sight, surface, parameters) / CORNER_ERROR
        flat = places.reshape(*places.shape[:-2], -1)
        return np.concatenate([flat.real, flat.imag], -1)

    return best_fit(misses, prior, starts, FIT_ROUNDS)


def _misplaced(sight: SeenTags, surface: Surface, parameters: Numbers) -> Places:
    """The misses of the corners (..., n, 4) [px], for parameters (..., m + 1)."""
    points = sight.points + parameters[..., -1, None, None] * sight.outward
    flat = points.reshape(*points.shape[:-2], -1)
    return surface.project(parameters[..., :-1], flat).reshape(points.shape) - sight.found
