"""Finding every text a place off the lines and off the other texts.

The page is a raster; each cell knows what a letter in it would cost.  A text takes the place at which the sum over its
cells, and what the place itself costs, is least.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points, Role
from graphcam.sheets.box import Box
from graphcam.sheets.expand import Drawn
from graphcam.sheets.hatching import interrupted
from graphcam.sheets.model import Entity, Strokes, Text
from graphcam.sheets.sampling import corners, pieces, sampled
from graphcam.sheets.styles import BOLD, MEDIUM, STYLES
from graphcam.sheets.writing import Floats, Writing

CELL = 0.5
"""Side of a cell of the raster, mm."""
AIR = 0.45
"""Free margin around a text, mm."""
FORBIDDEN, ON_MEDIUM, ON_THIN, ON_HATCH = 200.0, 6.0, 1.5, 0.4
"""Cost of a cell with another text or a bold line in it, or with a lighter line."""


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

    def _where(self, points: Points) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        offset = (points - self.corner) / CELL
        row = np.clip(np.floor(offset.imag).astype(np.intp) + 1, 0, self.cells.shape[0] - 1)
        column = np.clip(np.floor(offset.real).astype(np.intp) + 1, 0, self.cells.shape[1] - 1)
        return row, column

    def take(self, points: Points, cost: float) -> None:
        """Occupy the cells of the points, unless they cost more already."""
        where = self._where(points)
        self.cells[where] = np.maximum(self.cells[where], cost)

    def cost(self, points: Points) -> Floats:
        """What letters in the cells of points (..., n) cost together, (...)."""
        return self.cells[self._where(points)].sum(axis=-1, dtype=np.float64)

    def take_entity(self, entity: Entity) -> None:
        """Occupy the cells of a line, circle, arc or text."""
        if isinstance(entity, Text):
            a, b, _, d = corners(entity).tolist()
            self.take(_grid(a, b - a, d - a), FORBIDDEN)
        else:
            self.take(sampled(*pieces(entity), 0.7 * CELL), _line_cost(entity.role))


def _line_cost(role: str) -> float:
    if role == Role.HATCH:
        return ON_HATCH
    width = STYLES[role].width
    return FORBIDDEN if width >= BOLD else ON_MEDIUM if width >= MEDIUM else ON_THIN


def _grid(corner: complex, along: complex, up: complex) -> Points:
    """Points in every cell of a parallelogram (n,)."""
    across = np.linspace(0.0, 1.0, math.ceil(abs(along) / CELL) + 1)
    upwards = np.linspace(0.0, 1.0, math.ceil(abs(up) / CELL) + 1)
    return (corner + across * along + upwards[:, None] * up).ravel()


def place(writings: Sequence[Writing], drawn: Iterable[Entity], inside: Box) -> list[list[Entity]]:
    """A text for every writing, and its leader where it had to go far, kept off what is drawn and inside a box.

    Texts of dimensions choose first: they belong to their lines.
    """
    paper = Occupancy(inside)
    for entity in drawn:
        paper.take_entity(entity)
    placed: dict[int, list[Entity]] = {}
    for k in sorted(range(len(writings)), key=lambda k: not writings[k].bound):
        placed[k] = _set(writings[k], _choose(writings[k], paper))
        for entity in placed[k]:
            paper.take_entity(entity)
    return [placed[k] for k in range(len(writings))]


def _choose(writing: Writing, paper: Occupancy) -> int:
    """The cheapest place.  The near ones are tried first: most texts need no other."""
    size = writing.size + 2 * AIR * (1 + 1j)
    around = _grid(-size / 2, complex(size.real), 1j * size.imag)
    best, least = 0, math.inf
    for start in range(0, len(writing.centres), 24):
        part = slice(start, start + 24)
        if writing.cost[part].min() >= least:
            continue
        turned = around * np.exp(1j * writing.angles[part])[:, None]
        cost = writing.cost[part] + paper.cost(writing.centres[part, None] + turned)
        cost += _leader_cost(writing, part, paper)
        k = int(np.argmin(cost))
        if cost[k] < least:
            best, least = start + k, float(cost[k])
    return best


def _leader_cost(writing: Writing, part: slice, paper: Occupancy) -> Floats:
    anchors, centres = writing.anchors[part], writing.centres[part]
    led = np.isfinite(anchors)
    cost = np.zeros(len(centres))
    if led.any():
        ends = _leader_end(writing, centres[led], anchors[led])
        share = np.linspace(0.1, 0.95, 24)
        # A leader may cross lines, at a small cost, but no text.
        cost[led] = 0.1 * paper.cost(anchors[led][:, None] + share * (ends - anchors[led])[:, None])
    return cost


def _leader_end(writing: Writing, centres: Points, anchors: Points) -> Points:
    """The place on the text's box that is nearest to the anchor."""
    half, away = writing.size / 2 + 0.4 * (1 + 1j), anchors - centres
    return centres + np.clip(away.real, -half.real, half.real) + 1j * np.clip(away.imag, -half.imag, half.imag)


def _set(writing: Writing, k: int) -> list[Entity]:
    drawn: list[Entity] = [writing.set_at(k)]
    if np.isfinite(writing.anchors[k]):
        end = _leader_end(writing, writing.centres[k : k + 1], writing.anchors[k : k + 1])
        drawn.append(Strokes(writing.anchors[k : k + 1], end, Role.DIMENSION))
    return drawn


def lettered(steps: Sequence[Drawn], beside: Iterable[Entity], inside: Box) -> list[list[Entity]]:
    """The entities of every step with its texts, which keep off all steps and what else stands ``beside`` them.

    steps : from :func:`graphcam.sheets.expand.expand`, in the order in which they are drawn
    inside : the box that no text leaves
    """
    lines = [*beside, *(entity for entities, _ in steps for entity in entities)]
    placed = iter(place([writing for _, writings in steps for writing in writings], lines, inside))
    return [[*entities, *(e for _ in writings for e in next(placed))] for entities, writings in steps]


def shading_parted(steps: Sequence[Sequence[Entity]]) -> list[tuple[Entity, ...]]:
    """The same steps, their shading interrupted where a text of any of them stands."""
    texts = [e for entities in steps for e in entities if isinstance(e, Text)]
    return [tuple(interrupted(e, texts) if e.role == Role.HATCH else e for e in entities) for entities in steps]
