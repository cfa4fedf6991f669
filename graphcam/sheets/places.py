"""Entities apart by the places of the acts that they show: chord by chord, ray by ray."""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from graphcam.sheets.model import Circles, Curve, Entity, Stroke, Strokes


def by_place(entity: Entity) -> Iterator[tuple[int | None, Entity]]:
    """The pieces of an entity, each with its place of the act, or None where it belongs to all.

    >>> from graphcam.drafting.acts import Act, Kind
    >>> from graphcam.sheets.model import Source
    >>> chords = Source(Act(Kind.PARALLEL, "integration", "chords of v", {}, 3), np.array([0, 1, 2]))
    >>> curve = Stroke(np.array([0j, 1 + 2j, 2 + 3j]), "curve", False, chords)
    >>> [(at, chord.points.tolist()) for at, chord in by_place(curve)]
    [(1, [0j, (1+2j)]), (2, [(1+2j), (2+3j)])]
    """
    source = entity.source
    if source is None or (index := source.index) is None:
        yield None, entity
    elif isinstance(entity, Stroke | Curve):
        points = entity.points
        if isinstance(entity, Curve) or entity.closed:
            points, index = np.append(points, points[0]), np.append(index, index[0])
        # What leads to a corner belongs to its place: of a closed line also what leads back to the first.
        ends = [*(np.flatnonzero(np.diff(index[1:])) + 1), len(index) - 1]
        for start, end in pairwise([0, *ends]):
            yield int(index[end]), Stroke(points[start : end + 1], entity.role, False, entity.source)
    elif isinstance(entity, Strokes) and source.by_piece(len(entity.starts)):
        for k, at in enumerate(index.tolist()):
            yield at, replace(entity, starts=entity.starts[k : k + 1], ends=entity.ends[k : k + 1])
    elif isinstance(entity, Circles) and source.by_piece(len(entity.centres)):
        for k, at in enumerate(index.tolist()):
            yield at, replace(entity, centres=entity.centres[k : k + 1])
    else:
        one_place = len(index) > 0 and bool(np.all(index == index[0]))
        yield int(index[0]) if one_place else None, entity
