"""The way of a cutter around the cam: the exact outline moved outwards by its radius, as arcs and lines.

It begins and ends where it is farthest from the axis.  There a quarter of a circle leads on and off: it stays beyond
the tangent, which no other place of the way reaches, since all are nearer to the axis.
"""

from dataclasses import dataclass

import numpy as np

from graphcam.errors import DesignError
from graphcam.mechanism.kinematics import Complexes
from graphcam.words import say
from graphcam.workshop.biarcs import Move, arcs_along, merged
from graphcam.workshop.outline import Outline

SAMPLINGS = 2048, 8192, 32768, 131072, 524288
"""Samples of the way: of these numbers the first that suffices ..."""
FEWEST = 17
"""The minimum number of samples of a span."""
SAME = 1e-6
"""Two tangents, or curvatures as parts of one another, that differ by no more are the same."""
SHORTEST = 1e-9
"""A span that moves the cutter by no more [mm] is a corner that it passes."""
LEAD = 0.1
"""Radius on which the cutter is led to the cam, as a part of the farthest place; not less than the cutter's."""

Samples = tuple[Complexes, Complexes]
"""Points and unit tangents, in order."""


@dataclass(frozen=True, eq=False)
class CutterPath:
    """The way of the cutter's centre, clockwise around the cam, in cam coordinates [mm].

    contour : closed;  lead_in, lead_out : arcs that touch it where it begins
    cutter_radius : 0 for the outline itself
    error : greatest distance from the exact way [mm]
    """

    contour: list[Move]
    lead_in: Move
    lead_out: Move
    cutter_radius: float
    error: float


def cutter_path(outline: Outline, cutter_radius: float, tolerance: float) -> CutterPath:
    """The way of a cutter that leaves the outline within a tolerance [mm].

    Raises
    ------
    DesignError : the cutter does not reach into a hollow of the profile

    >>> import graphcam as gc
    >>> from graphcam.workshop.outline import outline_of
    >>> path = cutter_path(outline_of(gc.solve(gc.builtin_task())), 8.0, 0.005)
    >>> path.contour[0].start == path.contour[-1].end, path.error < 0.005
    (True, True)
    """
    outline.check_cutter(cutter_radius)
    for count in SAMPLINGS:
        pieces = _from_the_farthest(_sampled(outline, cutter_radius, count))
        found = [arcs_along(points, tangents, tolerance) for points, tangents in pieces]
        fitted = [piece for piece in found if piece is not None]
        if len(fitted) == len(found):
            contour = merged([move for moves, _ in fitted for move in moves])
            start = contour[0].start
            ways = _leads(start, max(cutter_radius, LEAD * abs(start)))
            return CutterPath(contour, *ways, cutter_radius, max(error for _, error in fitted))
    limit = say("greater for this profile")
    raise DesignError("tolerance", tolerance, limit, say("give a larger part.profile_tolerance"))


def _sampled(outline: Outline, cutter_radius: float, count: int) -> list[Samples]:
    """The exact way of the cutter's centre, span by span and clockwise."""
    # Densely at the ends, where a cusp may be near.
    each = max(FEWEST, count // len(outline.spans))
    share = np.sin(np.linspace(0, np.pi / 2, each)) ** 2
    pieces: list[Samples] = []
    for span in outline.spans:
        at = span.begin + (span.end - span.begin) * share
        normals = span.normal(at)
        points, tangents = span.point(at) + cutter_radius * normals, -1j * normals
        if np.abs(np.diff(points)).sum() > SHORTEST:
            pieces.append((points, tangents) if outline.sense < 0 else (points[::-1], tangents[::-1]))
    return _joined(pieces if outline.sense < 0 else pieces[::-1])


def _joined(pieces: list[Samples]) -> list[Samples]:
    """The pieces, neighbours made one where the way has no corner; arcs stay by themselves, and so are met exactly."""
    joined: list[list[Samples]] = []
    after_arc = True
    for piece in pieces:
        arc = _is_arc(*piece)
        if arc or after_arc or abs(piece[1][0] - joined[-1][-1][1][-1]) > SAME:
            joined.append([])
        joined[-1].append(piece)
        after_arc = arc
    return [_one(parts) for parts in joined]


def _is_arc(points: Complexes, tangents: Complexes) -> bool:
    """Whether the curvature is the same everywhere."""
    curvature = np.angle(tangents[1:] / tangents[:-1]) / np.maximum(np.abs(np.diff(points)), SHORTEST)
    return bool(np.ptp(curvature) <= SAME * np.abs(curvature).max())


def _one(parts: list[Samples]) -> Samples:
    """Samples that follow one another, what two have in common once."""
    points, tangents = (np.concatenate([*(part[k][:-1] for part in parts[:-1]), parts[-1][k]]) for k in (0, 1))
    return points, tangents


def _from_the_farthest(pieces: list[Samples]) -> list[Samples]:
    """The pieces begun at the farthest of the samples."""
    k = int(np.argmax([np.abs(points).max() for points, _ in pieces]))
    points, tangents = pieces[k]
    j = int(np.argmax(np.abs(points)))
    parts = (points[j:], tangents[j:]), (points[: j + 1], tangents[: j + 1])
    around = [parts[0], *pieces[k + 1 :], *pieces[:k], parts[1]]
    return [(points, tangents) for points, tangents in around if points.size > 1]


def _leads(start: complex, radius: float) -> tuple[Move, Move]:
    outward = start / abs(start)
    centre, along = start + radius * outward, -1j * outward * radius
    return Move(centre - along, start, centre), Move(start, centre + along, centre)
