"""Steps of constructions as a drawing: their views, with what stood in them before, and every letter in its place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphcam.drafting.act_order import pieces_of
from graphcam.drafting.ink import Construction, Step, View
from graphcam.drafting.marks import Origin
from graphcam.sheets.formats import Lettering
from graphcam.sheets.labels import lettered_steps, shading_parted
from graphcam.sheets.mark_entities import Placement, expand
from graphcam.sheets.model import Box, Entity, Group, Page, Source, bounding_box, by_place
from graphcam.sheets.styles import CURRENT_PART_STAGE, CURRENT_STEP_STAGE, FORMER_STEP_STAGE, in_progress
from graphcam.sheets.view_panels import Panel, clusters, panel_origins, panels
from graphcam.words import Tell

LETTER_HEIGHTS = Lettering(3.5, 3.0, 2.4)
"""Heights of letters [mm] in a drawing for the screen."""
MAX_WIDTH, MAX_HEIGHT = 230.0, 175.0
"""The maximum width and height of a view on a screen [mm]; a larger view is shown reduced."""
DRAWING_MARGIN = 5.0
"""The free margin around a drawing for its outermost labels [mm]."""
VIEW_GAP = 8.0
"""The gap between views [mm]."""
MAX_ASPECT_RATIO = 1.1
"""The width over height that columns of views without a common axis do not exceed by much."""


@dataclass(frozen=True, eq=False)
class StepBoard:
    """Views with all that constructions draw in them, laid out once, so that nothing moves from step to step.

    former : earlier steps in the same views, of the constructions that these start from
    steps : the steps themselves
    """

    former: tuple[Step, ...]
    steps: tuple[Step, ...]

    @property
    def views(self) -> dict[str, View]:
        """The views that the steps draw in, by name."""
        return {step.view.name: step.view for step in self.steps if step.marks}

    @cached_property
    def by_view(self) -> dict[str, StepBoard]:
        """A board for each view alone, by the view's name."""
        return {name: StepBoard(_in_view(self.former, name), _in_view(self.steps, name)) for name in self.views}

    @cached_property
    def factor(self) -> float:
        """The factor by which all views are reduced."""
        sizes = [panel.content for panel in self._full_size]
        return min(1.0, *(min(MAX_WIDTH / size.width, MAX_HEIGHT / size.height) for size in sizes))

    @property
    def origin(self) -> complex:
        """The place of the first view's origin on the page [mm]."""
        return -self._box.corner

    @cached_property
    def _full_size(self) -> list[Panel]:
        return panels((step for step in (*self.former, *self.steps) if step.marks), LETTER_HEIGHTS)

    @cached_property
    def _view_origins(self) -> dict[str, tuple[Panel, complex]]:
        """The views and their origins [mm] by name; the first origin is 0."""
        shown, factor = self._full_size, self.factor
        return _arranged_views(shown if factor == 1.0 else [replace(panel, factor=factor) for panel in shown])

    @cached_property
    def _has_titles(self) -> bool:
        return len(self._view_origins) > 1

    @cached_property
    def _box(self) -> Box:
        boxes = (
            (panel.box if self._has_titles else panel.content).moved(at) for panel, at in self._view_origins.values()
        )
        return bounding_box(boxes).grown(DRAWING_MARGIN)

    @cached_property
    def _titles(self) -> tuple[Entity, ...]:
        """The titles of several views; a single view has none, since the text beside the drawing names it."""
        titles = (e for panel, at in self._view_origins.values() for e in panel.title(self.origin + at))
        return tuple(titles) if self._has_titles else ()

    @cached_property
    def _entities(self) -> list[list[Entity]]:
        places = {name: Placement(self.origin + at, self.factor) for name, (_, at) in self._view_origins.items()}
        # A step without marks may name a view in which nothing is drawn.
        steps = (*self.former, *self.steps)
        expanded = [expand(s.marks, places.get(s.view.name, Placement(0j)), LETTER_HEIGHTS) for s in steps]
        return lettered_steps(expanded, self._titles, self._box.moved(self.origin))

    def page(self, current: int | None = None, part: int | None = None) -> Page:
        """The drawing up to the step with index ``current``, which is in colour; by default the finished drawing.

        part : index of the part up to which the step is drawn, which alone is in colour then; by default all are
        """
        count = len(self._entities) if current is None else len(self.former) + current + 1
        groups = [Group("titles", self._titles)] if self._has_titles else []
        stages = [(FORMER_STEP_STAGE, entities) for entities in self._entities[:count]]
        if current is not None:
            *stages, (_, last) = stages
            stages += [(CURRENT_STEP_STAGE, last)] if part is None else _stages_up_to(self.steps[current], part, last)
        for k, entities in enumerate(shading_parted([entities for _, entities in stages])):
            if current is not None:
                entities = tuple(replace(e, role=in_progress(e.role, stages[k][0])) for e in entities)
            groups.append(Group(f"step-{k + 1:02d}", entities))
        box = self._box.moved(self.origin)
        return Page(box.width, box.height, box, tuple(groups))

    def drawing_parts(self, current: int) -> list[int]:
        """The indices of the parts of a step that put something on the paper: some are words alone."""
        step, entities = self.steps[current], self._entities[len(self.former) + current]
        return [part for part in range(len(step.places)) if _stages_up_to(step, part, entities)[-1][1]]


def _stages_up_to(step: Step, part: int, entities: Sequence[Entity]) -> list[tuple[str, list[Entity]]]:
    """The stages of a step up to a part of it, each with its entities: what stood before, and what the part adds.

    What no part draws, such as the number of a reading, comes with the last of them; what is given is there before.
    """
    last, places = len(step.places) - 1, dict[Origin, dict[int, int]]()
    for k, each in enumerate(step.places):
        for piece in pieces_of(each.draws):
            of_act = places.setdefault(piece.act, {})
            of_act |= {at: of_act.get(at, k) for at in piece.at}
    given = {mark.of for mark in step.given}

    def since(source: Source | None, at: int | None) -> int:
        """The index of the part that draws a piece; -1 if the piece is there before."""
        if source is None or (source.of in given and source.of not in places):
            return -1
        of_act = places.get(source.of, {})
        return max(of_act.values(), default=last) if at is None else of_act.get(at, last)

    pieces = [(since(entity.source, at), piece) for entity in entities for at, piece in by_place(entity)]
    before, own = ([e for k, e in pieces if k < part], [e for k, e in pieces if k == part])
    return [(FORMER_STEP_STAGE, before), (CURRENT_PART_STAGE, own)]


def _in_view(steps: Sequence[Step], name: str) -> tuple[Step, ...]:
    return tuple(step for step in steps if step.view.name == name)


@dataclass
class Column:
    """A column of views one under the other.

    left, width : mm of the drawing
    down : the height that is filled [mm]
    """

    left: float
    width: float
    down: float = 0.0


def _arranged_views(views: Sequence[Panel]) -> dict[str, tuple[Panel, complex]]:
    """Views by name with their origins, the first one's at 0: along their common axes, otherwise in columns."""
    if len(views) == 1:
        return {views[0].view.name: (views[0], 0j)}
    groups = [(group, panel_origins(group, VIEW_GAP)) for group in clusters(views)]
    boxes = [bounding_box(p.box.moved(at) for p, at in zip(*group, strict=True)) for group in groups]
    room = max(
        *(box.height for box in boxes), math.sqrt(sum(box.width * box.height for box in boxes) / MAX_ASPECT_RATIO)
    )
    placed: dict[str, tuple[Panel, complex]] = {}
    columns, right = list[Column](), 0.0
    # The highest first: the low ones find room under them, where no column grows wider.
    for k in sorted(range(len(groups)), key=lambda k: -boxes[k].height):
        box = boxes[k]
        column = next((c for c in columns if box.width <= c.width and c.down + box.height <= room), None)
        if column is None:
            column = Column(right, box.width)
            columns.append(column)
            right += box.width + VIEW_GAP
        by = complex(column.left, -column.down) - complex(box.left, box.top)
        placed |= {panel.view.name: (panel, at + by) for panel, at in zip(*groups[k], strict=True)}
        column.down += box.height + VIEW_GAP
    _, first = placed[views[0].view.name]
    return {panel.view.name: (panel, placed[panel.view.name][1] - first) for panel in views}


def ancestors(construction: Construction) -> list[Construction]:
    """The constructions that one starts from, directly or indirectly, in the order of drawing.

    >>> import graphcam as gc
    >>> [c.name for c in ancestors(gc.solve(gc.builtin_task()).drawn["minimum_radius"])]
    ['acceleration', 'integration']
    """
    found: dict[str, Construction] = {}
    for given in vars(construction.givens).values():
        if isinstance(given, Construction):
            found |= {c.name: c for c in (*ancestors(given), given)}
    return list(found.values())


def board_of(construction: Construction, tell: Tell = str, on: Construction | None = None) -> StepBoard:
    """The board of a construction: the views that it draws in, with what was drawn in them before.

    on : a construction over which it is drawn, though it does not start from it
    """
    board = StepBoard((), tuple(step.translated(tell) for step in construction.steps()))
    before = (*ancestors(construction), *([on] if on else ()))
    former = tuple(step.translated(tell) for c in before for step in c.steps() if step.view.name in board.views)
    return StepBoard(former, board.steps)
