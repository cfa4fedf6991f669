"""What is printed on a page, for who reads its photograph: the light lines, and where anything black stands."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.photo.printed import Edges
from graphcam.sheets.model import ArcEntity, Circles, Curve, Entity, Group, Stroke, Text
from graphcam.sheets.sampling import box_of, pieces
from graphcam.sheets.styles import LIGHT

Polyline = NDArray[np.complex128]


def black_boxes(groups: Iterable[Group]) -> list[Edges]:
    """Boxes about all that is printed in black."""
    light = set(LIGHT.values())
    boxes = [box_of([e]) for group in groups for e in group.entities if e.role not in light]
    return [(box.left, box.bottom, box.right, box.top) for box in boxes if box is not None]


def polylines(entities: Iterable[Entity]) -> list[Polyline]:
    """The lines of entities, texts left out.

    >>> [line.tolist() for line in polylines([Stroke(np.array([0, 2, 2j]), "light grey", closed=True)])]
    [[0j, (2+0j), 2j, 0j]]
    """
    return [np.asarray(line, dtype=np.complex128) for entity in entities for line in _lines(entity)]


def _lines(entity: Entity) -> Iterable[Points]:
    match entity:
        case Text():
            return []
        case Stroke(closed=False):
            return [entity.points]
        case Stroke() | Curve():
            return [_closed(entity.points)]
        case ArcEntity():
            starts, ends = pieces(entity)
            return [np.append(starts, ends[-1:])]
        case Circles(centres=centres):
            starts, _ = pieces(entity)
            return [_closed(ring) for ring in starts.reshape(len(centres), -1)]
        case _:
            return np.column_stack(pieces(entity))


def _closed(points: Points) -> Points:
    return np.append(points, points[:1])
