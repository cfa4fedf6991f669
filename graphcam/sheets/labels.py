"""Finding every text a place off the lines and off the other texts.

The page is a raster; each cell knows what a letter in it would cost.  A text takes the place at which the sum over its
cells, and what the place itself costs, is least.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points, Role
from graphcam.sheets.box import Box
from graphcam.sheets.expand import Drawn
from graphcam.sheets.gaps import parted
from graphcam.sheets.model import Entity, Strokes, Text
from graphcam.sheets.sampling import around, box_of, corners, linework, sampled, within
from graphcam.sheets.styles import BOLD, MEDIUM, STYLES
from graphcam.sheets.writing import Floats, Writing

CELL = 0.5
"""Side of a cell of the raster, mm."""
AIR = 0.45
"""Free margin around a text, mm."""
ON_TEXT, FORBIDDEN, ON_MEASURE, ON_MEDIUM, ON_THIN, ON_HATCH = 2000.0, 200.0, 80.0, 80.0, 2.0, 0.4
"""Cost of a cell with another text in it, a bold line, a dimension, leader or axis, or a lighter line."""
COSTS: Mapping[str, float] = {Role.HATCH: ON_HATCH, Role.DIMENSION: ON_MEASURE, Role.SCALE: ON_MEASURE}
"""Of roles that cost more or less than the width of their lines says."""
AROUND_TEXT = 0.8
"""Free margin in the hatching around a text, mm."""
NEAR = 24
"""So many places of a text are looked at before the further ones."""
LEADER_SHARES = np.linspace(0.1, 0.95, 60)
"""Fractions of a leader at which it is looked at what it crosses."""


class Occupancy:
    """What a letter would cost in each cell of a page, mm from the lower left corner of ``inside``.

    >>> paper = Occupancy(Box(0, 0, 20, 10))
    >>> paper.take(np.array([5 + 5j]), 7.0)
    >>> paper.cost(np.array([[5.1 + 5.2j, 5.3 + 5.3j], [9 + 5j, 9 + 5j], [-1 + 5j, 9 + 5j]])).tolist()
    [14.0, 0.0, 200.0]
    """

    def __init__(self, inside: Box) -> None:
        self.corner = inside.corner
        # A ring of forbidden cells keeps texts inside.
        shape = math.ceil(inside.height / CELL) + 2, math.ceil(inside.width / CELL) + 2
        self.cells: NDArray[np.float32] = np.full(shape, FORBIDDEN, dtype=np.float32)
        self.cells[1:-1, 1:-1] = 0.0

    def _where(self, x: NDArray[np.floating[Any]], y: NDArray[np.floating[Any]]) -> NDArray[np.intp]:
        """The numbers of the cells, row after row, that places lie in; those outside lie in the ring."""
        (rows, columns), corner = self.cells.shape, self.corner
        return _within(y - corner.imag, rows) * columns + _within(x - corner.real, columns)

    def take(self, points: Points, cost: float) -> None:
        """Occupy the cells of the points, unless they cost more already."""
        cells, where = self.cells.reshape(-1), self._where(points.real, points.imag)
        cells[where] = np.maximum(cells[where], cost)

    def cost(self, points: Points) -> Floats:
        """What letters in the cells of points (..., n) cost together, (...)."""
        return self._cost(self._where(points.real, points.imag))

    def cost_level(self, x: Floats, y: Floats) -> Floats:
        """What letters in all cells of columns at x (k, n) and rows at y (k, m) cost together, (k,)."""
        where = self._where(x[:, None, :], y[:, :, None])
        return self._cost(where.reshape(len(where), -1))

    def _cost(self, where: NDArray[np.intp]) -> Floats:
        return self.cells.reshape(-1).take(where).sum(axis=-1, dtype=np.float64)

    def take_entities(self, entities: Iterable[Entity]) -> None:
        """Occupy the cells of lines, circles, arcs and texts."""
        lines: dict[float, list[Entity]] = {}
        for entity in entities:
            if isinstance(entity, Text):
                a, b, _, d = corners(entity).tolist()
                self.take(_grid(a, b - a, d - a), ON_TEXT)
            else:
                lines.setdefault(_line_cost(entity.role), []).append(entity)
        for cost, alike in lines.items():
            self.take(sampled(*linework(alike), 0.7 * CELL), cost)


def _within(along: NDArray[np.floating[Any]], count: int) -> NDArray[np.intp]:
    """The cells of a row, of ``count``, in which places lie, the first and the last of them beyond the ends."""
    return np.minimum(np.maximum(np.floor(along / CELL), -1), count - 2).astype(np.intp) + 1


def _line_cost(role: str) -> float:
    if role in COSTS:
        return COSTS[role]
    width = STYLES[role].width
    return FORBIDDEN if width >= BOLD else ON_MEDIUM if width >= MEDIUM else ON_THIN


def _grid(corner: complex, along: complex, up: complex) -> Points:
    """Points in every cell of a parallelogram (n,)."""
    return (corner + _shares(abs(along)) * along + _shares(abs(up))[:, None] * up).ravel()


@lru_cache(maxsize=1024)
def _shares(length: float) -> Floats:
    """The fractions of a length, from 0 to 1, at which points stand in every cell."""
    return np.linspace(0.0, 1.0, math.ceil(length / CELL) + 1)


def chosen_places(writings: Sequence[Writing], drawn: Iterable[Entity], inside: Box) -> list[int]:
    """The place that every label takes, kept off what is drawn and inside a box.

    Texts of dimensions choose first: they belong to their lines.
    """
    paper = Occupancy(inside)
    paper.take_entities(drawn)
    chosen = [0] * len(writings)
    for k in sorted(range(len(writings)), key=lambda k: not writings[k].bound):
        chosen[k] = _choose(writings[k], paper)
        paper.take_entities(set_at(writings[k], chosen[k]))
    return chosen


def _choose(writing: Writing, paper: Occupancy) -> int:
    """The cheapest place.  The near ones are tried first: most texts need no other."""
    best, least = 0, math.inf
    for start, end in ((0, NEAR), (NEAR, len(writing.centres))):
        part = start + np.flatnonzero(writing.cost[start:end] < least)
        if part.size:
            cost = writing.cost[part] + _letters_cost(writing, part, paper) + _leader_cost(writing, part, paper)
            k = int(np.argmin(cost))
            if cost[k] < least:
                best, least = int(part[k]), float(cost[k])
    return best


def _letters_cost(writing: Writing, part: NDArray[np.intp], paper: Occupancy) -> Floats:
    size, centres, angles = writing.size + 2 * AIR * (1 + 1j), writing.centres[part], writing.angles[part]
    if angles.any():
        turned = _grid(-size / 2, complex(size.real), 1j * size.imag) * np.exp(1j * angles)[:, None]
        return paper.cost(centres[:, None] + turned)
    # The points of a level text stand in rows and columns, so each coordinate is looked up once.
    across, up = (_shares(side) * side - side / 2 for side in (size.real, size.imag))
    return paper.cost_level(centres.real[:, None] + across, centres.imag[:, None] + up)


def _leader_cost(writing: Writing, part: NDArray[np.intp], paper: Occupancy) -> Floats:
    anchors, centres = writing.anchors[part], writing.centres[part]
    led = np.isfinite(anchors)
    cost = np.zeros(len(centres))
    if led.any():
        ends = _leader_end(writing, centres[led], anchors[led])
        # A leader may cross lines, at a small cost, but no text.
        cost[led] = 0.04 * paper.cost(anchors[led][:, None] + LEADER_SHARES * (ends - anchors[led])[:, None])
    return cost


def _leader_end(writing: Writing, centres: Points, anchors: Points) -> Points:
    """The place on the text's box that is nearest to the anchor."""
    half, away = writing.size / 2 + 0.4 * (1 + 1j), anchors - centres
    return centres + np.clip(away.real, -half.real, half.real) + 1j * np.clip(away.imag, -half.imag, half.imag)


def set_at(writing: Writing, k: int) -> list[Entity]:
    """The text in one of its places, and its leader where that is far."""
    drawn: list[Entity] = [writing.set_at(k)]
    if np.isfinite(writing.anchors[k]):
        end = _leader_end(writing, writing.centres[k : k + 1], writing.anchors[k : k + 1])
        drawn.append(Strokes(writing.anchors[k : k + 1], end, Role.DIMENSION, writing.source))
    return drawn


def lettered(steps: Sequence[Drawn], beside: Iterable[Entity], inside: Box) -> list[list[Entity]]:
    """The entities of every step with its texts, which keep off all steps and what else stands ``beside`` them.

    A thin line is parted where a text found no place off it.

    steps : from :func:`graphcam.sheets.expand.expand`, in the order in which they are drawn
    inside : the box that no text leaves
    """
    return with_texts(steps, places_of(steps, beside, inside))


def places_of(steps: Sequence[Drawn], beside: Iterable[Entity], inside: Box) -> list[int]:
    """The places that the texts of all steps take, one step's after the other's."""
    lines = [*beside, *(entity for entities, _ in steps for entity in entities)]
    return chosen_places([writing for _, writings in steps for writing in writings], lines, inside)


def with_texts(steps: Sequence[Drawn], places: Sequence[int | None]) -> list[list[Entity]]:
    """The entities of every step with its texts in these of their places; with None a text is left out.

    A thin line is parted where a text stands on it.
    """
    at = iter(places)
    placed = [[(writing, next(at)) for writing in writings] for _, writings in steps]
    texts = [[e for writing, k in of_one if k is not None for e in set_at(writing, k)] for of_one in placed]
    return parted([[*entities, *own] for (entities, _), own in zip(steps, texts, strict=True)])


def shading_parted(steps: Sequence[Sequence[Entity]]) -> list[tuple[Entity, ...]]:
    """The steps with their shading interrupted where a text of any of them stands."""
    texts = [e for entities in steps for e in entities if isinstance(e, Text)]
    return [tuple(interrupted(e, texts) if e.role == Role.HATCH else e for e in entities) for entities in steps]


def interrupted(entity: Entity, texts: Iterable[Text]) -> Entity:
    """Separate lines without the parts that run through texts; other entities as they are.

    >>> line = Strokes(np.array([-10 + 1j]), np.array([20 + 1j]), Role.HATCH)
    >>> len(interrupted(line, [Text(0j, "A", 3.5)]).starts)
    2
    """
    if not isinstance(entity, Strokes):
        return entity
    starts, ends = entity.starts, entity.ends
    drawn = box_of([entity])
    for box in map(corners, texts):
        if drawn is None or not around(box).grown(AROUND_TEXT).meets(drawn):
            continue
        low, high = within(starts, ends, box, AROUND_TEXT)
        cut = low < high
        steps = ends - starts
        before, after = cut & (low > 0), cut & (high < 1)
        starts, ends = (
            np.concatenate([starts[~cut], starts[before], (starts + high * steps)[after]]),
            np.concatenate([ends[~cut], (starts + low * steps)[before], ends[after]]),
        )
    return Strokes(starts, ends, entity.role)
