"""Steps of constructions as a drawing: their views, with what stood in them before, and every letter in its place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from graphcam.drafting.ink import Construction, Step, View
from graphcam.drafting.marks import Label
from graphcam.sheets.box import Box, around_all
from graphcam.sheets.expand import Placement, expand
from graphcam.sheets.formats import Lettering
from graphcam.sheets.labels import lettered, shading_parted
from graphcam.sheets.model import Entity, Group, Page
from graphcam.sheets.panels import Panel, clusters, panels, stand
from graphcam.sheets.styles import CURRENT_STEP, FORMER_STEP, in_progress
from graphcam.words import Tell

LETTERS = Lettering(3.5, 3.0, 2.4)
"""Heights of letters [mm], for a drawing that is read on a screen."""
WIDEST, HIGHEST = 230.0, 175.0
"""What a screen shows well [mm]: a larger view is shown reduced."""
MARGIN = 5.0
"""Free margin around a drawing, where its outermost labels find room [mm]."""
GAP = 8.0
"""Between views [mm]."""
LYING = 1.1
"""Views that share no axis are laid out in columns, so that all are at most about so many times as wide as high."""


@dataclass(frozen=True, eq=False)
class StepBoard:
    """Views of constructions with all that is drawn in them, so that nothing moves from one step to the next.

    former : steps that were drawn in the same views before, of the constructions that these start from
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
        """Every view on a board of its own."""
        return {name: StepBoard(_in_view(self.former, name), _in_view(self.steps, name)) for name in self.views}

    @cached_property
    def factor(self) -> float:
        """What all views are shown reduced by."""
        sizes = [panel.content for panel in self._full_size]
        return min(1.0, *(min(WIDEST / size.width, HIGHEST / size.height) for size in sizes))

    @property
    def origin(self) -> complex:
        """Where the origin of the first view lies on the page [mm]."""
        return -self._box.corner

    @cached_property
    def _full_size(self) -> list[Panel]:
        shown = panels((step for step in (*self.former, *self.steps) if step.marks), LETTERS)
        return [replace(panel, noted=False) for panel in shown]

    @cached_property
    def _placed(self) -> dict[str, tuple[Panel, complex]]:
        """The views by name, each with its origin, that of the first one at 0."""
        shown, factor = self._full_size, self.factor
        return _arranged(shown if factor == 1.0 else [replace(panel, factor=factor) for panel in shown])

    @cached_property
    def _titled(self) -> bool:
        return len(self._placed) > 1

    @cached_property
    def _box(self) -> Box:
        boxes = ((panel.box if self._titled else panel.content).moved(at) for panel, at in self._placed.values())
        return around_all(boxes).grown(MARGIN)

    @cached_property
    def _titles(self) -> tuple[Entity, ...]:
        """Of several views; a single one is named beside the drawing."""
        titles = (e for panel, at in self._placed.values() for e in panel.title(self.origin + at))
        return tuple(titles) if self._titled else ()

    @cached_property
    def _drawn(self) -> list[list[Entity]]:
        places = {name: Placement(self.origin + at, self.factor) for name, (_, at) in self._placed.items()}
        # A step without marks may name a view in which nothing is drawn.
        steps = (*self.former, *self.steps)
        expanded = [expand(s.marks, places.get(s.view.name, Placement(0j)), LETTERS) for s in steps]
        return lettered(expanded, self._titles, self._box.moved(self.origin))

    def page(self, current: int | None = None) -> Page:
        """The drawing up to the own step of that index, which is in colour; by default the finished drawing."""
        count = len(self._drawn) if current is None else len(self.former) + current + 1
        groups = [Group("titles", self._titles)] if self._titled else []
        for k, entities in enumerate(shading_parted(self._drawn[:count])):
            stage = CURRENT_STEP if k == count - 1 else FORMER_STEP
            if current is not None:
                entities = tuple(replace(e, role=in_progress(e.role, stage)) for e in entities)
            groups.append(Group(f"step-{k + 1:02d}", entities))
        box = self._box.moved(self.origin)
        return Page(box.width, box.height, box, tuple(groups))


def _in_view(steps: Sequence[Step], name: str) -> tuple[Step, ...]:
    return tuple(step for step in steps if step.view.name == name)


def _arranged(views: Sequence[Panel]) -> dict[str, tuple[Panel, complex]]:
    """Views by name with their origins, the first one's 0: those that share an axis as it asks, others in columns."""
    if len(views) == 1:
        return {views[0].view.name: (views[0], 0j)}
    # In the order of their first views.
    groups = [(group, stand(group, GAP)) for group in sorted(clusters(views), key=lambda group: views.index(group[0]))]
    boxes = [around_all(p.box.moved(at) for p, at in zip(*group, strict=True)) for group in groups]
    room = max(*(box.height for box in boxes), math.sqrt(sum(box.width * box.height for box in boxes) / LYING))
    placed: dict[str, tuple[Panel, complex]] = {}
    left = right = down = 0.0
    for (group, origins), box in zip(groups, boxes, strict=True):
        if down > 0 and down + box.height > room:
            left, down = right + GAP, 0.0
        by = complex(left, -down) - complex(box.left, box.top)
        placed |= {panel.view.name: (panel, at + by) for panel, at in zip(group, origins, strict=True)}
        right, down = max(right, left + box.width), down + box.height + GAP
    _, first = placed[views[0].view.name]
    return {panel.view.name: (panel, placed[panel.view.name][1] - first) for panel in views}


def ancestors(construction: Construction) -> list[Construction]:
    """The constructions that one starts from, directly or not, the first drawn first.

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
    """The views that a construction draws in, each with what stood in it before.

    on : a construction that it does not start from, but is drawn over
    """
    board = StepBoard((), tuple(step.told(tell) for step in construction.steps()))
    before = (*ancestors(construction), *([on] if on else ()))
    former = tuple(step.told(tell) for c in before for step in c.steps() if step.view.name in board.views)
    # Where no point is named, lines were drawn over what is not here: alone they say nothing.
    named = {s.view.name for s in (*former, *board.steps) if any(isinstance(mark, Label) for mark in s.marks)}
    steps = (step if step.view.name in named else replace(step, marks=()) for step in board.steps)
    return StepBoard(former, tuple(steps))
