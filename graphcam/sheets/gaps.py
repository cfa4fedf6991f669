"""Gaps in thin lines where a text had to be set on them: letters with a line through them are hard to read.

Curves, results and what measures are never parted.  Each part of a line keeps the place of the act that left the line.
"""

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points, Role
from graphcam.sheets.model import ArcEntity, Circles, Entity, Stroke, Strokes, Text
from graphcam.sheets.sampling import corners, linework, pieces, within
from graphcam.sheets.styles import THIN
from graphcam.sheets.writing import Floats

PARTED = Role.CONSTRUCTION, Role.AXIS, Role.HIDDEN, Role.DIMENSION
"""The roles of lines that are parted; of dimensions only the leaders."""
GAP = 0.6
"""Between a text and the ends of the line that it parts, mm."""
STEP = 0.05
"""An arc is followed in steps of this length to find where it runs into a text, mm."""


def parted(steps: Sequence[Sequence[Entity]]) -> list[list[Entity]]:
    """The steps with their thin lines parted where a text of any of them stands on one.

    >>> line = Stroke(np.array([-10 + 1j, 20 + 1j]), Role.CONSTRUCTION)
    >>> (around,), _ = parted([[line], [Text(0j, "A", 3.5)]])
    >>> [points.real.round(1).tolist() for points in pieces(around)]
    [[-10.0, 3.5], [-0.6, 20.0]]
    """
    texts = [e for entities in steps for e in entities if isinstance(e, Text) and e.text]
    measuring = {id(line) for text in texts if text.of for line in text.of.lines}
    thin = [e for entities in steps for e in entities if _can_be_parted(e) and id(e) not in measuring]
    crossed = dict(_crossed(thin, [corners(text) for text in texts]))
    return [[part for e in entities for part in _parts(e, crossed.get(id(e), []))] for entities in steps]


def _can_be_parted(entity: Entity) -> bool:
    if isinstance(entity, Circles) and entity.opaque:
        return False
    return entity.role in PARTED and isinstance(entity, Stroke | Strokes | Circles | ArcEntity)


def _crossed(thin: Sequence[Entity], texts: Sequence[Points]) -> Iterator[tuple[int, list[Points]]]:
    """The lines that run through texts, by their identity, and the boxes of those texts."""
    starts, ends = linework(thin)
    owner = np.repeat(np.arange(len(thin)), [len(pieces(entity)[0]) for entity in thin])
    left, right = np.minimum(starts.real, ends.real), np.maximum(starts.real, ends.real)
    low, high = np.minimum(starts.imag, ends.imag), np.maximum(starts.imag, ends.imag)
    x, y = np.real(texts).reshape(-1, 4), np.imag(texts).reshape(-1, 4)
    reach = x.min(axis=1) - THIN, x.max(axis=1) + THIN, y.min(axis=1) - THIN, y.max(axis=1) + THIN
    found: dict[int, list[Points]] = {}
    for box, west, east, south, north in zip(texts, *(side.tolist() for side in reach), strict=True):
        near = np.flatnonzero((left < east) & (right > west) & (low < north) & (high > south))
        # Most texts stand off every thin line.
        if near.size:
            enter, leave = within(starts[near], ends[near], box, THIN / 2)
            for k in np.unique(owner[near[enter < leave]]).tolist():
                found.setdefault(id(thin[k]), []).append(box)
    yield from found.items()


def _parts(entity: Entity, boxes: Sequence[Points]) -> list[Entity]:
    """The entity without what stands in boxes."""
    match entity:
        case Stroke() if boxes:
            return [_without(_segments(entity), boxes)]
        case Strokes() if boxes:
            return [_without(entity, boxes)]
        case Circles() if boxes:
            return list(_bows_of(entity, boxes))
        case ArcEntity() if boxes:
            return [replace(entity, start=a, end=b) for a, b in _open(entity, boxes)]
        case _:
            return [entity]


def _segments(line: Stroke) -> Strokes:
    """The sides of a polyline; each belongs to the place of the corner to which it leads."""
    starts, ends = pieces(line)
    arriving = (np.arange(len(starts)) + 1) % len(line.points)
    return Strokes(starts, ends, line.role, line.source and line.source.part(arriving, len(line.points)))


def _without(lines: Strokes, boxes: Sequence[Points]) -> Strokes:
    starts, ends, piece = lines.starts, lines.ends, np.arange(len(lines.starts))
    for box in boxes:
        low, high = within(starts, ends, box, GAP)
        cut, steps = low < high, ends - starts
        before, after = cut & (low > 0), cut & (high < 1)
        starts, ends, piece = (
            np.concatenate([starts[~cut], starts[before], starts[after] + high[after] * steps[after]]),
            np.concatenate([ends[~cut], starts[before] + low[before] * steps[before], ends[after]]),
            np.concatenate([piece[~cut], piece[before], piece[after]]),
        )
    order = np.argsort(piece, kind="stable")
    source = lines.source and lines.source.part(piece[order], len(lines.starts))
    return Strokes(starts[order], ends[order], lines.role, source)


def _bows_of(circles: Circles, boxes: Sequence[Points]) -> Iterator[Entity]:
    """The circles that stay whole, and arcs of the others."""
    whole: list[int] = []
    source, count = circles.source, len(circles.centres)
    for k, centre in enumerate(circles.centres.tolist()):
        own = source and source.part(slice(k, k + 1), count)
        ring = ArcEntity(centre, circles.radius, 0.0, 2 * math.pi, circles.role, own)
        bows = _open(ring, boxes)
        if bows == [(ring.start, ring.end)]:
            whole.append(k)
        else:
            yield from (replace(ring, start=a, end=b) for a, b in bows)
    if len(whole) == count:
        yield circles
    elif whole:
        yield replace(circles, centres=circles.centres[whole], source=source and source.part(whole, count))


def _open(arc: ArcEntity, boxes: Sequence[Points]) -> list[tuple[float, float]]:
    """The parts of an arc outside boxes, from where to where [rad]."""
    count = max(2, math.ceil((arc.end - arc.start) * arc.radius / STEP))
    ways = np.linspace(arc.start, arc.end, count + 1)
    free = np.ones(len(ways), dtype=bool)
    for box in boxes:
        near = np.flatnonzero(_seen(ways, box - arc.centre))
        free[near] &= ~_inside(arc.centre + arc.radius * np.exp(1j * ways[near]), box)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], free, [False]]).astype(int)))
    return [(float(ways[a]), float(ways[b - 1])) for a, b in pairwise(edges.tolist()) if free[a] and b - a > 1]


def _seen(ways: Floats, box: Points) -> NDArray[np.bool_]:
    """In which directions from the origin a text's box, or what is so near to it, may be seen."""
    middle = complex(box.mean())
    reach = float(np.abs(box - middle).max()) + 2 * GAP
    if abs(middle) <= reach:
        return np.ones(len(ways), dtype=bool)
    off = ways - cmath.phase(middle)
    return np.abs(off - 2 * math.pi * np.round(off / (2 * math.pi))) <= math.asin(reach / abs(middle))


def _inside(points: Points, box: Points) -> NDArray[np.bool_]:
    """Which points stand in a text's box or so near to it."""
    turn = cmath.exp(-1j * cmath.phase(complex(box[1] - box[0])))
    at, level = points * turn, box * turn
    across = (level.real.min() - GAP < at.real) & (at.real < level.real.max() + GAP)
    return across & (level.imag.min() - GAP < at.imag) & (at.imag < level.imag.max() + GAP)
