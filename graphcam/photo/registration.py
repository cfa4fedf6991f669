"""The place of the paper in a picture: from the tags, by the simplest surface that fits them."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.page_surfaces import (
    CORNER_ERROR,
    MIN_TAGS,
    Frame,
    Kind,
    LaidSurface,
    SeenTags,
    Surface,
    laid_surfaces,
)
from graphcam.photo.pictures import PhotographError
from graphcam.photo.printed_page import Edges, PrintedPage, half, side_seen
from graphcam.photo.robust_fit import Numbers
from graphcam.photo.tags import Tags
from graphcam.words import say

Places = NDArray[np.complex128]
MAX_CORNER_ERROR = 0.7
"""The maximum mean error of the corners [px]."""
OTHER_PAGE_ERROR = 15.0
"""The mean error of the corners [px] above which they belong to another page."""
DOUBT_DEVIATIONS = 2.0
"""The doubt in standard deviations."""
MAX_BLUR = 0.7
"""The maximum blur of an edge [mm of paper]: twice the width of a pencil line."""
MAX_DOUBT = 0.5
"""The maximum error of places by the tags [mm]."""
DOUBT_GRID = 7
"""The number of points of a view in either direction at which the doubt is computed."""
CORNER_DIRECTIONS = np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
"""Directions (4,) from the middle of a tag to its corners, in their order."""


@dataclass(frozen=True, eq=False)
class Registration:
    """The place of the paper in a picture.

    kind : what shape the paper has
    residual : by how much the tags' corners miss [px], root of the mean square
    tags, expected : how many tags were used, and how many there are on the paper
    doubt : by how much the worst place of the views may be misplaced [mm], as far as the tags tell
    blur : width of an edge [mm], None if it was not measured
    growth : by how much the black squares' edges lie outside of their places [mm]
    """

    surface: Surface
    parameters: Numbers
    kind: Kind
    residual: float
    tags: int
    expected: int
    doubt: float
    blur: float | None
    growth: float

    def pixels(self, points: Places | complex) -> Places:
        """Points of the paper (...) [mm] as places in the picture [px]."""
        given = np.asarray(points, complex)
        return self.surface.project(self.parameters, given.ravel()).reshape(given.shape)

    def millimetres(self, places: Places | complex) -> Places:
        """Places of the picture (...) [px] as points of the paper [mm]."""
        given = np.asarray(places, complex)
        return self.surface.unproject(self.parameters, given.ravel()).reshape(given.shape)


def register(tags: Tags, page: PrintedPage, size: tuple[int, int], focal: float | None = None) -> Registration:
    """The registration of a page in a picture; of a page on two sheets, of the one that is seen better.

    size : columns and rows of the picture
    focal : length of the lens [px], None if it is not known

    Raises
    ------
    PhotographError : the picture does not tell where a line of the drawing is
    """
    if page.seam is not None:
        page = half(page, side_seen(tags.numbers, page))
    mine = tags.selected(np.isin(tags.numbers, list(page.tags)))
    _check_tag_count(len(mine), len(tags), len(page.tags))
    corners = np.array([page.tags[number] for number in mine.numbers.tolist()])
    outward = np.broadcast_to(CORNER_DIRECTIONS, mine.corners.shape)
    points = corners[:, None] + page.tag_side / 2 * (1 + 1j + outward)
    sight = SeenTags(points, outward, mine.corners)
    blur = _blur(mine, page)
    laid = laid_surfaces(
        sight, Frame.of(np.array(list(page.tags.values())) + page.tag_side * (0.5 + 0.5j), size), focal
    )
    if laid[0].residual > OTHER_PAGE_ERROR:
        raise PhotographError(say("the marks are not in the positions of this page"), say("check which page it is"))
    if laid[0].residual > MAX_CORNER_ERROR:
        raise PhotographError(
            say("the paper is bent too much: its marks miss by {miss:.1f} pixels", miss=laid[0].residual),
            say("press the sheet flat on a table, or scan it"),
        )
    return _checked_registration(laid, page, size, blur)


def _check_tag_count(mine: int, seen: int, expected: int) -> None:
    if not seen:
        raise PhotographError(
            say("none of the {expected} marks along the edges is seen", expected=expected),
            say("take the whole sheet from above, in good light, not mirrored"),
        )
    if not mine:
        raise PhotographError(say("the marks along the edges belong to another page"), say("check which page it is"))
    if mine < MIN_TAGS:
        raise PhotographError(
            say("only {seen} of {expected} marks along the edges are seen", seen=mine, expected=expected),
            say("include the whole sheet, and keep fingers off its marks"),
        )


def _blur(tags: Tags, page: PrintedPage) -> float | None:
    """The width of blurred edges [mm] in the worse of the two directions; None if it was not measured.

    Raises
    ------
    PhotographError : edges are too wide to place a line
    """
    if tags.widths is None:
        return None
    sides = np.abs(np.roll(tags.corners, -1, axis=1) - tags.corners)
    # What smears an edge shortens or lengthens as the sides across it do.
    smeared = tags.widths / np.roll(sides, 1, axis=1) * page.tag_side
    blur = float(max(np.median(smeared[:, ::2]), np.median(smeared[:, 1::2])))
    if blur > MAX_BLUR:
        raise PhotographError(
            say("the picture is blurred: edges are {width:.1f} mm wide", width=blur),
            say("hold still, use more light, or let the camera focus"),
        )
    return blur


def _checked_registration(
    plausible: list[LaidSurface], page: PrintedPage, size: tuple[int, int], blur: float | None
) -> Registration:
    best = plausible[0]
    rooms = [view.room for view in page.views.values()] or [(0.0, 0.0, page.width, page.height)]
    points = np.concatenate([_grid(room) for room in rooms])
    doubt = max([_doubt(laid, points) for laid in plausible])
    count, expected = len(best.sight.points), len(page.tags)
    found = Registration(
        best.surface,
        best.fit.parameters[:-1],
        best.kind,
        best.residual,
        count,
        expected,
        doubt,
        blur,
        float(best.fit.parameters[-1]),
    )
    places = found.pixels(points)
    for other in plausible[1:]:
        apart = other.surface.unproject(other.fit.parameters[:-1], places) - points
        found = replace(found, doubt=max(found.doubt, float(np.abs(apart).max())))
    if not found.doubt <= MAX_DOUBT:
        raise PhotographError(
            say(
                "{seen} of {expected} marks are seen, which does not fix the position of a line: it may be "
                "{doubt:.1f} mm off",
                seen=count,
                expected=expected,
                doubt=found.doubt,
            ),
            say("lay the sheet flat, include the marks on all its sides, and keep fingers off them"),
        )
    inside = _inside_picture(places, size)
    if not inside.all():
        raise PhotographError(say("part of the drawing is outside the picture"), say("include the whole sheet"))
    return found


def _inside_picture(places: Places, size: tuple[int, int]) -> NDArray[np.bool_]:
    columns, rows = size
    across, down = np.abs(places.real - (columns - 1) / 2), np.abs(places.imag - (rows - 1) / 2)
    return (across <= columns / 2) & (down <= rows / 2)


def _grid(room: Edges) -> Places:
    left, bottom, right, top = room
    return (np.linspace(left, right, DOUBT_GRID) + 1j * np.linspace(bottom, top, DOUBT_GRID)[:, None]).ravel()


def _doubt(laid: LaidSurface, points: Places) -> float:
    """The maximum error of points (n,) [mm], by the spread that the corners' misses leave."""
    parameters, project = laid.fit.parameters[:-1], laid.surface.project
    count = len(parameters)
    step = 1e-5
    shifted = project(parameters + step * np.eye(count), points[None])
    here = project(parameters, points)
    slopes = (shifted - here) / step
    covariance = laid.fit.covariance[:-1, :-1] * max(1.0, laid.residual / np.sqrt(2) / CORNER_ERROR) ** 2
    variance = np.einsum("mn,mk,kn->n", slopes.real, covariance, slopes.real)
    variance += np.einsum("mn,mk,kn->n", slopes.imag, covariance, slopes.imag)
    enlarged = np.abs(project(parameters, points + 0.5) - project(parameters, points - 0.5))
    upward = np.abs(project(parameters, points + 0.5j) - project(parameters, points - 0.5j))
    return DOUBT_DEVIATIONS * float(np.max(np.sqrt(np.maximum(variance, 0)) / np.minimum(enlarged, upward)))
