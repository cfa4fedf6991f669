"""Surfaces laid through the tags that are seen: a flat page if they lie on one, else one that is folded or rolled."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.bends import Folded, Rolled, bent_sheets
from graphcam.photo.fitting import FittedParameters, Numbers, Prior, fitted
from graphcam.photo.planes import Frame, Plane

Places = NDArray[np.complex128]
Kind = Literal["plane", "fold", "cylinder"]
LEAST_TAGS = 3
"""The minimum number of tags by which a page is located."""
EXPECTED = 0.1
"""How far a tag's corner is misplaced [px] in an ordinary picture."""
GROWTH = 0.1
"""mm by which printing or light may move every edge of a tag outward, one and the same in the whole picture."""
ROUNDS = 40
"""The maximum number of rounds of a fit; it ends earlier as a rule."""
FLAT = 0.2
"""Pixels by which the corners of a flat page miss on the average; if they miss by more, bent sheets are tried."""
SIMPLER = 2.0
"""A flat page may fit worse by this factor: a bent one has four or five parameters more."""
ALIKE, ALIKE_AT_LEAST = 1.3, 4.0
"""Bent sheets of which the other is worse by no more than this factor and sum are not told apart."""
STRAY = 6.0
"""A tag that misses by so many times the middle one is out of its place: partly hidden, or bent up."""
NEARLY = 0.25
"""Pixels that no tag is called out of its place for."""


class Surface(Protocol):
    """A shape that paper can have under a camera, with parameters (m,)."""

    def project(self, parameters: Numbers, points: Places) -> Places:
        """Points (..., n) of the paper [mm] as places in the picture [px], for parameters (..., m)."""
        ...

    def unproject(self, parameters: Numbers, places: Places) -> Places:
        """Places of the picture [px] as points of the paper [mm], for parameters (m,)."""
        ...

    def prior(self) -> Prior:
        """What is known of the parameters before."""
        ...


@dataclass(frozen=True, eq=False)
class Sight:
    """The tags of a page that are seen in a picture.

    points, outward : (n, 4) their corners on the paper [mm], and the way out of the square to each
    found : (n, 4) the corners in the picture [px]
    """

    points: Places
    outward: Places
    found: Places

    def only(self, kept: NDArray[np.bool_]) -> Sight:
        """The tags that a mask (n,) chooses."""
        return Sight(self.points[kept], self.outward[kept], self.found[kept])


@dataclass(frozen=True, eq=False)
class Laid:
    """A surface laid through the tags.

    fit : its parameters, the growth of the tags as the last one
    sight : the tags that were used
    residual : by how much they miss [px], root of the mean square
    loss : of all tags, those too that were left out
    """

    kind: Kind
    surface: Surface
    fit: FittedParameters
    sight: Sight
    residual: float
    loss: float


def laid_surfaces(sight: Sight, frame: Frame, focal: float | None) -> list[Laid]:
    """Surfaces that the tags lie on about equally well, the best one first; a flat one alone if it does."""
    plane = Plane(frame)
    points, found = sight.points.ravel(), sight.found.ravel()
    flat = laid_through(sight, "plane", plane, plane.start(points, found)[None])
    if flat.residual <= FLAT and len(flat.sight.points) == len(sight.points):
        return [flat]
    folded, rolled = bent_sheets(frame, focal, (plane, flat.fit.parameters[:-1]))
    kinds: list[tuple[Kind, Folded | Rolled]] = [("fold", folded), ("cylinder", rolled)]
    bends: list[Laid] = []
    for kind, sheet in kinds:
        starts = sheet.starts(points, found)
        if len(starts):
            bends.append(laid_through(sight, kind, sheet, starts))
    bends.sort(key=lambda laid: laid.loss)
    if not bends or flat.loss <= SIMPLER * bends[0].loss:
        return [flat]
    best = bends[0]
    return [laid for laid in bends if laid.loss <= ALIKE * best.loss + ALIKE_AT_LEAST]


def laid_through(sight: Sight, kind: Kind, surface: Surface, starts: Numbers) -> Laid:
    """A surface through the tags, from starts (b, m); tags out of their places are left out, one in four at most."""
    fit = _fit(sight, surface, np.column_stack([starts, np.zeros(len(starts))]))
    misses = np.abs(_misplaced(sight, surface, fit.parameters)).max(-1)
    loss = fit.loss
    limit = max(NEARLY, STRAY * float(np.median(misses)))
    kept = misses <= limit
    if not kept.all() and kept.sum() >= max(LEAST_TAGS, 0.75 * len(kept)):
        sight = sight.only(kept)
        fit = _fit(sight, surface, fit.parameters[None])
    residual = float(np.sqrt(np.mean(np.abs(_misplaced(sight, surface, fit.parameters)) ** 2)))
    return Laid(kind, surface, fit, sight, residual, loss)


def _fit(sight: Sight, surface: Surface, starts: Numbers) -> FittedParameters:
    known = surface.prior()
    prior = Prior(np.append(known.values, 0.0), np.append(known.spread, GROWTH))

    def misses(parameters: Numbers) -> Numbers:
        """By how much the corners miss, in units of what is expected: columns, then rows."""
        places = _misplaced(sight, surface, parameters) / EXPECTED
        flat = places.reshape(*places.shape[:-2], -1)
        return np.concatenate([flat.real, flat.imag], -1)

    return fitted(misses, prior, starts, ROUNDS)


def _misplaced(sight: Sight, surface: Surface, parameters: Numbers) -> Places:
    """The misses of the corners (..., n, 4) [px], for parameters (..., m + 1)."""
    points = sight.points + parameters[..., -1, None, None] * sight.outward
    flat = points.reshape(*points.shape[:-2], -1)
    return surface.project(parameters[..., :-1], flat).reshape(points.shape) - sight.found
