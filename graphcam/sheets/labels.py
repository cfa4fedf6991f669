"""The places of texts, off the lines and off one another.

The page is a raster; each cell knows what a letter in it would cost.  A text takes the place at which the sum over its
cells, and what the place itself costs, is least.

A thin line is parted where a text had to be set on it; curves, results and what measures are never.  Each part of a
line keeps the place of the act that left the line.

Where the packer is free while a drawing changes under the hand, a label may hop across its point whenever another line
takes its room.  Held, each label takes that of its places which is nearest to where it stood; what it crosses then is
not asked, so no raster of the paper is needed either.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points, Role
from graphcam.sheets.label_candidates import Floats, LabelText
from graphcam.sheets.mark_entities import Drawn
from graphcam.sheets.model import ArcEntity, Box, Circles, Entity, Stroke, Strokes, Text
from graphcam.sheets.sampling import box_around, box_of, corners, linework, pieces, sampled, spans_in_box
from graphcam.sheets.styles import BOLD, STYLES_BY_ROLE, THIN

CELL_SIDE = 0.5
"""The side of a cell of the raster [mm]."""
TEXT_MARGIN = 0.45
"""The free margin around a text [mm]."""
TEXT_COST, BOLD_LINE_COST, MEASURE_COST, THIN_LINE_COST, HATCH_COST = 2000.0, 200.0, 80.0, 2.0, 0.4
"""Costs of a cell with another text, a bold line, a dimension, curve or axis, construction lines, or hatching."""
LEADER_CROSSING_COST = 250.0
"""The cost of a leader that crosses another one."""
ORDERS_OF_CROSSED: tuple[Callable[[list[int]], Sequence[int]], ...] = (
    lambda labels: labels,
    lambda labels: labels[::-1],
    lambda labels: labels[::2] + labels[1::2],
)
"""The orders in which labels with crossing leaders choose once more."""
BARRED_COST = 1000.0
"""The cost of a place in another view."""
ROLE_COSTS: Mapping[str, float] = {
    Role.HATCH: HATCH_COST,
    **dict.fromkeys((Role.DIMENSION, Role.SCALE, Role.CURVE, Role.LIMIT, "gauge", "table"), MEASURE_COST),
}
"""Costs by role, where they do not follow from the width of its lines."""
HATCHING_MARGIN = 0.8
"""The free margin in the hatching around a text [mm]."""
SHELF_GAP = 0.6
"""The gap between a text and the shelf of its leader [mm]."""
FIRST_PLACES = 24
"""The number of places of a text that are tried before the others."""
LEADER_FRACTIONS = np.linspace(0.1, 0.95, 60)
"""The fractions of a leader at which its cost is taken."""
BARRED_FRACTIONS = LEADER_FRACTIONS[::3]
"""Those at which it is in the box of another view, which is far wider than a letter."""


PARTED_ROLES = Role.CONSTRUCTION, Role.AXIS, Role.HIDDEN, Role.DIMENSION
"""The roles of lines that may be parted; of dimensions only the leaders."""
TEXT_GAP = 0.6
"""The gap between a text and the ends of the line that it parts [mm]."""
ARC_STEP = 0.05
"""The step along an arc in search of the places where it meets a text [mm]."""


def parted_steps(steps: Sequence[Sequence[Entity]]) -> list[list[Entity]]:
    """The steps with their thin lines parted where a text of any of them stands on one.

    >>> line = Stroke(np.array([-10 + 1j, 20 + 1j]), Role.CONSTRUCTION)
    >>> (around,), _ = parted_steps([[line], [Text(0j, "A", 3.5)]])
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
    return entity.role in PARTED_ROLES and isinstance(entity, Stroke | Strokes | Circles | ArcEntity)


def _crossed(thin: Sequence[Entity], texts: Sequence[Points]) -> Iterator[tuple[int, list[Points]]]:
    """The lines that run through texts, by their ``id``, each with the boxes of those texts."""
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
            enter, leave = spans_in_box(starts[near], ends[near], box, THIN / 2)
            for k in np.unique(owner[near[enter < leave]]).tolist():
                found.setdefault(id(thin[k]), []).append(box)
    yield from found.items()


def _parts(entity: Entity, boxes: Sequence[Points]) -> list[Entity]:
    """The pieces of the entity outside the boxes."""
    match entity:
        case Stroke() if boxes:
            return [_lines_outside(_segments(entity), boxes)]
        case Strokes() if boxes:
            return [_lines_outside(entity, boxes)]
        case Circles() if boxes:
            return list(_bows_of(entity, boxes))
        case ArcEntity() if boxes:
            return [replace(entity, start=a, end=b) for a, b in _open_arcs(entity, boxes)]
        case _:
            return [entity]


def _segments(line: Stroke) -> Strokes:
    """The sides of a polyline; each belongs to the place of the corner to which it leads."""
    starts, ends = pieces(line)
    arriving = (np.arange(len(starts)) + 1) % len(line.points)
    return Strokes(starts, ends, line.role, line.source and line.source.part(arriving, len(line.points)))


def _lines_outside(lines: Strokes, boxes: Sequence[Points]) -> Strokes:
    starts, ends, piece = lines.starts, lines.ends, np.arange(len(lines.starts))
    for box in boxes:
        low, high = spans_in_box(starts, ends, box, TEXT_GAP)
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
    """The circles that stay whole, and the arcs that are left of the others."""
    whole: list[int] = []
    source, count = circles.source, len(circles.centres)
    for k, centre in enumerate(circles.centres.tolist()):
        own = source and source.part(slice(k, k + 1), count)
        ring = ArcEntity(centre, circles.radius, 0.0, 2 * math.pi, circles.role, own)
        bows = _open_arcs(ring, boxes)
        if bows == [(ring.start, ring.end)]:
            whole.append(k)
        else:
            yield from (replace(ring, start=a, end=b) for a, b in bows)
    if len(whole) == count:
        yield circles
    elif whole:
        yield replace(circles, centres=circles.centres[whole], source=source and source.part(whole, count))


def _open_arcs(arc: ArcEntity, boxes: Sequence[Points]) -> list[tuple[float, float]]:
    """The parts of an arc outside the boxes, as start and end [rad]."""
    count = max(2, math.ceil((arc.end - arc.start) * arc.radius / ARC_STEP))
    ways = np.linspace(arc.start, arc.end, count + 1)
    free = np.ones(len(ways), dtype=bool)
    for box in boxes:
        near = np.flatnonzero(_visible_directions(ways, box - arc.centre))
        free[near] &= ~_inside(arc.centre + arc.radius * np.exp(1j * ways[near]), box)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], free, [False]]).astype(int)))
    return [(float(ways[a]), float(ways[b - 1])) for a, b in pairwise(edges.tolist()) if free[a] and b - a > 1]


def _visible_directions(ways: Floats, box: Points) -> NDArray[np.bool_]:
    """Flags (n,) of directions from the origin in which a text's box with its margin may lie."""
    middle = complex(box.mean())
    reach = float(np.abs(box - middle).max()) + 2 * TEXT_GAP
    if abs(middle) <= reach:
        return np.ones(len(ways), dtype=bool)
    off = ways - cmath.phase(middle)
    return np.abs(off - 2 * math.pi * np.round(off / (2 * math.pi))) <= math.asin(reach / abs(middle))


def _inside(points: Points, box: Points) -> NDArray[np.bool_]:
    """Flags (n,) of points in a text's box with its margin."""
    turn = cmath.exp(-1j * cmath.phase(complex(box[1] - box[0])))
    at, level = points * turn, box * turn
    across = (level.real.min() - TEXT_GAP < at.real) & (at.real < level.real.max() + TEXT_GAP)
    return across & (level.imag.min() - TEXT_GAP < at.imag) & (at.imag < level.imag.max() + TEXT_GAP)


class Occupancy:
    """The cost of a letter in each cell of a page, in mm from the lower left corner of ``inside``.

    >>> paper = Occupancy(Box(0, 0, 20, 10))
    >>> paper.take(np.array([5 + 5j]), 7.0)
    >>> paper.cost(np.array([[5.1 + 5.2j, 5.3 + 5.3j], [9 + 5j, 9 + 5j], [-1 + 5j, 9 + 5j]])).tolist()
    [14.0, 0.0, 200.0]
    """

    def __init__(self, inside: Box) -> None:
        self.corner = inside.corner
        # A ring of forbidden cells keeps texts inside.
        shape = math.ceil(inside.height / CELL_SIDE) + 2, math.ceil(inside.width / CELL_SIDE) + 2
        self.leaders: list[Strokes] = []
        self.cells: NDArray[np.float32] = np.full(shape, BOLD_LINE_COST, dtype=np.float32)
        self.cells[1:-1, 1:-1] = 0.0

    def _cell_numbers(self, x: NDArray[np.floating[Any]], y: NDArray[np.floating[Any]]) -> NDArray[np.intp]:
        """The numbers of the cells, row after row, of places; those of places outside are in a ring around."""
        (rows, columns), corner = self.cells.shape, self.corner
        return _cell_numbers(y - corner.imag, rows) * columns + _cell_numbers(x - corner.real, columns)

    def take(self, points: Points, cost: float) -> None:
        """Set the cost of the points' cells, unless it is higher already."""
        self._raise_cost(self._cell_numbers(points.real, points.imag), cost)

    def _raise_cost(self, where: NDArray[np.intp], cost: float) -> None:
        cells = self.cells.reshape(-1)
        cells[where] = np.maximum(cells[where], cost)

    def cost(self, points: Points) -> Floats:
        """The summed costs (...) of letters in the cells of points (..., n)."""
        return self._cost(self._cell_numbers(points.real, points.imag))

    def cost_level(self, x: Floats, y: Floats) -> Floats:
        """The summed costs (k,) of letters in all cells of columns at x (k, n) and rows at y (k, m)."""
        where = self._cell_numbers(x[:, None, :], y[:, :, None])
        return self._cost(where.reshape(len(where), -1))

    def _cost(self, where: NDArray[np.intp]) -> Floats:
        return self.cells.reshape(-1).take(where).sum(axis=-1, dtype=np.float64)

    def copy(self) -> Occupancy:
        """A copy that can be taken otherwise."""
        copied = copy(self)
        copied.cells, copied.leaders = self.cells.copy(), list(self.leaders)
        return copied

    def footprint(self, entities: Sequence[Entity]) -> Footprint:
        """What a label's text and leader take."""
        leaders = [each for each in entities if isinstance(each, Strokes)]
        return Footprint(list(self._cells_of(entities)), leaders)

    def put(self, label: Footprint) -> None:
        """Occupy the cells of a label."""
        for where, cost in label.cells:
            self._raise_cost(where, cost)
        self.leaders += label.leaders

    def take_entities(self, entities: Iterable[Entity]) -> None:
        """Occupy the cells of lines, circles, arcs and texts."""
        for where, cost in self._cells_of(entities):
            self._raise_cost(where, cost)

    def _cells_of(self, entities: Iterable[Entity]) -> Iterator[tuple[NDArray[np.intp], float]]:
        """The cells of entities, and what a letter in them costs."""
        lines: dict[float, list[Entity]] = {}
        for entity in entities:
            if isinstance(entity, Text):
                a, b, _, d = corners(entity).tolist()
                points = _grid(a, b - a, d - a)
                yield self._cell_numbers(points.real, points.imag), TEXT_COST
            else:
                lines.setdefault(_line_cost(entity.role), []).append(entity)
        for cost, alike in lines.items():
            points = sampled(*linework(alike), 0.7 * CELL_SIDE)
            yield self._cell_numbers(points.real, points.imag), cost


@dataclass(frozen=True, eq=False)
class Footprint:
    """What a label takes of the paper: cells with what a letter in them costs, and leaders."""

    cells: list[tuple[NDArray[np.intp], float]]
    leaders: list[Strokes]


def _cell_numbers(along: NDArray[np.floating[Any]], count: int) -> NDArray[np.intp]:
    """The cells of a row, of ``count``, in which places lie, the first and the last of them beyond the ends."""
    return np.minimum(np.maximum(np.floor(along / CELL_SIDE), -1), count - 2).astype(np.intp) + 1


def _line_cost(role: str) -> float:
    return ROLE_COSTS.get(role, BOLD_LINE_COST if STYLES_BY_ROLE[role].width >= BOLD else THIN_LINE_COST)


def _grid(corner: complex, along: complex, up: complex) -> Points:
    """Points in every cell of a parallelogram (n,)."""
    return (corner + _shares(abs(along)) * along + _shares(abs(up))[:, None] * up).ravel()


@lru_cache(maxsize=1024)
def _shares(length: float) -> Floats:
    """Fractions (n,) of a length, from 0 to 1, which lie in every cell along it."""
    return np.linspace(0.0, 1.0, math.ceil(length / CELL_SIDE) + 1)


def chosen_places(writings: Sequence[LabelText], drawn: Iterable[Entity], inside: Box) -> list[int]:
    """The index of the place of every label, kept off what is drawn and inside a box.

    Texts of dimensions choose first: they belong to their lines.  Those whose leaders cross choose once more, after all
    others and in other orders, as long as that leaves fewer crossings.
    """
    paper = Occupancy(inside)
    paper.take_entities(drawn)
    lines, chosen = paper.copy(), dict[int, int]()
    footprints = dict[int, Footprint]()
    order = sorted(range(len(writings)), key=lambda k: not writings[k].bound)
    _choose_in_turn(writings, order, paper, chosen, footprints)
    crossed = _labels_crossed(writings, chosen)
    others: Occupancy | None = None
    for reordered in ORDERS_OF_CROSSED:
        if not crossed:
            break
        if others is None:
            others = lines.copy()
            for k in chosen.keys() - crossed.keys():
                others.put(footprints[k])
        tried, taken = dict(chosen), dict(footprints)
        _choose_in_turn(writings, reordered(list(crossed)), others.copy(), tried, taken)
        if sum((left := _labels_crossed(writings, tried)).values()) < sum(crossed.values()):
            chosen, crossed, footprints, others = tried, left, taken, None
    return [chosen[k] for k in range(len(writings))]


def _choose_in_turn(
    writings: Sequence[LabelText],
    order: Iterable[int],
    paper: Occupancy,
    chosen: dict[int, int],
    footprints: dict[int, Footprint],
) -> None:
    """Let labels choose one after the other, beside all that is on the paper; note their places and what they take."""
    for k in order:
        chosen[k] = _choose(writings[k], paper)
        footprints[k] = paper.footprint(placed_label(writings[k], chosen[k]))
        paper.put(footprints[k])


def _labels_crossed(writings: Sequence[LabelText], chosen: Mapping[int, int]) -> dict[int, int]:
    """The labels whose leaders cross others, in the order of choice, and how many each crosses."""
    led = [k for k, place in chosen.items() if np.isfinite(writings[k].anchors[place])]
    # Each has its way to the text, and its shelf.
    starts, ends = (each[::2] for each in linework(placed_label(writings[k], chosen[k])[1] for k in led))
    counts = _crossed_leaders(starts, ends, starts, ends).astype(int).tolist()
    return {k: count for k, count in zip(led, counts, strict=True) if count}


def _choose(writing: LabelText, paper: Occupancy) -> int:
    """The index of the cheapest place.  The near ones are tried first: most texts need no other."""
    best, least = 0, math.inf
    for start, end in ((0, FIRST_PLACES), (FIRST_PLACES, len(writing.centres))):
        part = start + np.flatnonzero(writing.cost[start:end] < least)
        if part.size:
            cost = writing.cost[part] + _letters_cost(writing, part, paper) + _leader_cost(writing, part, paper)
            if writing.barred.size:
                cost += _barred_cost(writing, part)
            k = int(np.argmin(cost))
            if cost[k] < least:
                best, least = int(part[k]), float(cost[k])
    return best


def _letters_cost(writing: LabelText, part: NDArray[np.intp], paper: Occupancy) -> Floats:
    size, centres, angles = writing.size + 2 * TEXT_MARGIN * (1 + 1j), writing.centres[part], writing.angles[part]
    if angles.any():
        turned = _grid(-size / 2, complex(size.real), 1j * size.imag) * np.exp(1j * angles)[:, None]
        return paper.cost(centres[:, None] + turned)
    # The points of a level text stand in rows and columns, so each coordinate is looked up once.
    across, up = (_shares(side) * side - side / 2 for side in (size.real, size.imag))
    return paper.cost_level(centres.real[:, None] + across, centres.imag[:, None] + up)


def _leader_cost(writing: LabelText, part: NDArray[np.intp], paper: Occupancy) -> Floats:
    anchors, centres = writing.anchors[part], writing.centres[part]
    led = np.isfinite(anchors)
    cost = np.zeros(len(centres))
    if led.any():
        ends = _leader_end(writing, centres[led], anchors[led])
        # A leader may cross lines, at a small cost, but no text.
        cost[led] = 0.04 * paper.cost(anchors[led][:, None] + LEADER_FRACTIONS * (ends - anchors[led])[:, None])
        if paper.leaders:
            cost[led] += LEADER_CROSSING_COST * _crossed_leaders(anchors[led], ends, *linework(paper.leaders))
    return cost


def _crossed_leaders(starts: Points, ends: Points, others: Points, other_ends: Points) -> Floats:
    """How many of other leaders each of leaders (n,) crosses."""
    way, other = (ends - starts)[:, None], other_ends - others
    turn, between = (way.conjugate() * other).imag, others - starts[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        shares = ((between.conjugate() * other).imag / turn, (between.conjugate() * way).imag / turn)
    return np.all([(share > 0) & (share < 1) for share in shares], axis=0).sum(axis=1).astype(np.float64)


def _barred_cost(writing: LabelText, part: NDArray[np.intp]) -> Floats:
    """The costs (k,) of the boxes of other views that the text or its leader enters."""
    centres, anchors = writing.centres[part], writing.anchors[part]
    half, led = writing.size / 2, np.isfinite(anchors)
    turned = np.abs(np.sin(writing.angles[part])) > math.sqrt(0.5)
    across, up = np.where(turned, half.imag, half.real), np.where(turned, half.real, half.imag)
    left, bottom, right, top = edges = writing.barred[..., None]
    inside = (centres.real + across > left) & (centres.real - across < right)
    inside &= (centres.imag + up > bottom) & (centres.imag - up < top)
    if led.any():
        left, bottom, right, top = edges[..., None]
        way = anchors[led][:, None] + BARRED_FRACTIONS * (centres[led] - anchors[led])[:, None]
        within = (way.real > left) & (way.real < right) & (way.imag > bottom) & (way.imag < top)
        # Where it begins in another view already, a leader leads out of it.
        inside[:, led] |= (within & ~within[..., :1]).any(axis=-1)
    return BARRED_COST * inside.sum(axis=0)


def _leader_end(writing: LabelText, centres: Points, anchors: Points) -> Points:
    """The end of the text's shelf that is nearer to the anchor; the shelf is over the text where that lies higher."""
    half, away = writing.size / 2 + SHELF_GAP * (1 + 1j), anchors - centres
    across, up = np.where(away.real < 0, -1, 1), np.where(away.imag > half.imag, 1, -1)
    return centres + across * half.real + 1j * up * half.imag


def placed_label(writing: LabelText, k: int) -> list[Entity]:
    """The text in one of its places, and where that is far a leader with the shelf on which the text stands."""
    drawn: list[Entity] = [writing.set_at(k)]
    if np.isfinite(writing.anchors[k]):
        centre, anchor = writing.centres[k : k + 1], writing.anchors[k : k + 1]
        end = _leader_end(writing, centre, anchor)
        ways = np.concatenate([anchor, end]), np.concatenate([end, end + 2 * (centre - end).real])
        drawn.append(Strokes(*ways, Role.DIMENSION, writing.source))
    return drawn


def lettered_steps(steps: Sequence[Drawn], beside: Iterable[Entity], inside: Box) -> list[list[Entity]]:
    """The entities of every step with its texts, kept off all steps and what else stands ``beside`` them.

    A thin line is parted where a text found no place off it.

    steps : from :func:`graphcam.sheets.mark_entities.expand`, in the order in which they are drawn
    inside : the box that no text leaves
    """
    return with_texts(steps, places_of(steps, beside, inside))


def places_of(steps: Sequence[Drawn], beside: Iterable[Entity], inside: Box) -> list[int]:
    """The indices of the places of the texts of all steps, one step's after the other's."""
    lines = [*beside, *(entity for entities, _ in steps for entity in entities)]
    return chosen_places([writing for _, writings in steps for writing in writings], lines, inside)


def with_texts(steps: Sequence[Drawn], places: Sequence[int | None]) -> list[list[Entity]]:
    """The entities of every step with its texts in these of their places; with None a text is left out.

    A thin line is parted where a text stands on it.
    """
    at = iter(places)
    placed = [[(writing, next(at)) for writing in writings] for _, writings in steps]
    texts = [[e for writing, k in of_one if k is not None for e in placed_label(writing, k)] for of_one in placed]
    return parted_steps([[*entities, *own] for (entities, _), own in zip(steps, texts, strict=True)])


def shading_parted(steps: Sequence[Sequence[Entity]]) -> list[tuple[Entity, ...]]:
    """The steps with their shading interrupted where a text of any of them stands."""
    texts = [e for entities in steps for e in entities if isinstance(e, Text)]
    return [tuple(interrupted(e, texts) if e.role == Role.HATCH else e for e in entities) for entities in steps]


def interrupted(entity: Entity, texts: Iterable[Text]) -> Entity:
    """The entity; if it is separate lines, without the parts that run through texts.

    >>> line = Strokes(np.array([-10 + 1j]), np.array([20 + 1j]), Role.HATCH)
    >>> len(interrupted(line, [Text(0j, "A", 3.5)]).starts)
    2
    """
    if not isinstance(entity, Strokes):
        return entity
    starts, ends = entity.starts, entity.ends
    drawn = box_of([entity])
    for box in map(corners, texts):
        if drawn is None or not box_around(box).grown(HATCHING_MARGIN).meets(drawn):
            continue
        low, high = spans_in_box(starts, ends, box, HATCHING_MARGIN)
        cut = low < high
        steps = ends - starts
        before, after = cut & (low > 0), cut & (high < 1)
        starts, ends = (
            np.concatenate([starts[~cut], starts[before], (starts + high * steps)[after]]),
            np.concatenate([ends[~cut], (starts + low * steps)[before], ends[after]]),
        )
    return Strokes(starts, ends, entity.role)


MAX_HOP = 9.0
"""The maximum move of a label at once [mm]; one that would move farther is hidden until the change is finished."""
TURN_COST = 10.0
"""The cost of a turn by 1 rad, as a distance on the paper [mm]."""


@dataclass(frozen=True)
class LabelPlace:
    """The place of a label: the middle of its box [mm], and the direction of its base line [rad]."""

    centre: complex
    angle: float


def nearest_place(writing: LabelText, former: LabelPlace) -> int | None:
    """The index of a text's place that is nearest to its former one; None if even that is too far away.

    >>> from graphcam.sheets.label_candidates import label_around
    >>> label = label_around(0j, "A", 3.5, 1j)
    >>> k = nearest_place(label, LabelPlace(-4 + 0.5j, 0.0))
    >>> bool(label.centres[k].real < -2), nearest_place(label, LabelPlace(90j, 0.0))
    (True, None)
    """
    ways = np.abs(writing.centres - former.centre)
    turned = np.abs(np.angle(np.exp(1j * (writing.angles - former.angle)))) if writing.angles.any() else 0.0
    k = int(np.argmin(ways + TURN_COST * turned))
    return k if ways[k] <= MAX_HOP else None


def held_places(names: Sequence[str], steps: Sequence[Drawn], former: Mapping[str, LabelPlace]) -> list[int | None]:
    """The indices of the places that texts keep; None for new texts, and for those that would hop.

    names : of the texts of all steps, one step's after the other's
    """
    writings = (writing for _, of_one in steps for writing in of_one)
    return [
        nearest_place(writing, former[name]) if name in former else None
        for name, writing in zip(names, writings, strict=True)
    ]


def label_places(
    names: Sequence[str], steps: Sequence[Drawn], places: Sequence[int | None], former: Mapping[str, LabelPlace]
) -> dict[str, LabelPlace]:
    """The present places of texts, by name; one that was left out keeps its former place, so that it may come back."""
    writings = (writing for _, of_one in steps for writing in of_one)
    return dict(former) | {
        name: LabelPlace(complex(writing.centres[k]), float(writing.angles[k]))
        for name, writing, k in zip(names, writings, places, strict=True)
        if k is not None
    }
