"""A construction step by step: the drawing so far, the current step in colour, its caption and its readings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from html import escape

import numpy as np

from graphcam.constructions.readings import ReadingRow, rows
from graphcam.drafting.ink import Construction, Step
from graphcam.errors import DesignError
from graphcam.notebooks.picture import Picture
from graphcam.sheets.box import Box
from graphcam.sheets.expand import Placement, expand
from graphcam.sheets.formats import Lettering
from graphcam.sheets.labels import lettered, shading_parted
from graphcam.sheets.model import Entity, Group, Page
from graphcam.sheets.panels import Panel
from graphcam.sheets.styles import CURRENT_STEP, FORMER_STEP, in_progress
from graphcam.words import Tell, say

LETTERS = Lettering(3.5, 3.0, 2.4)
"""Heights of letters [mm], for a page that is read on a screen."""
WIDEST, HIGHEST = 230.0, 175.0
"""What a screen shows well [mm]: a larger drawing is shown reduced."""
MARGIN = 5.0
"""Free margin around a drawing, where its outermost labels find room [mm]."""


@dataclass(frozen=True, eq=False)
class Stage:
    """One step of a construction, as a notebook shows it.

    number : of the step, from 1
    step : what is done, in words
    page : the drawing so far; None for a step of words alone
    reads : what is read off the paper with this step
    tell : says all texts
    """

    number: int
    step: Step
    page: Page | None
    reads: tuple[ReadingRow, ...]
    tell: Tell

    @property
    def picture(self) -> Picture | None:
        """The drawing so far with the current step in colour."""
        if self.page is None:
            return None
        # The renderer loads matplotlib.
        from graphcam.sheets.matplotlib_renderer import svg

        title, view = self.tell(self.step.title), self.tell(self.step.view.title)
        alt = say(
            "{view}. Drawn so far, with step {number} in colour: {title}. {caption}",
            view=view,
            number=self.number,
            title=title,
            caption=self.step.caption,
        )
        return Picture(svg(self.page), self.tell(alt), f"{view}: {title[0].lower()}{title[1:]}")

    @property
    def html(self) -> str:
        """Title, caption, drawing and readings."""
        title, caption = escape(self.tell(self.step.title)), escape(self.tell(self.step.caption))
        words = f"<h4>{self.number}. {title}</h4><p>{caption}</p>"
        shown = self.picture.html if self.picture else ""
        read = "".join(f"<li>{_reading(row, self.tell)}</li>" for row in self.reads)
        readings = f'<ul class="readings">{read}</ul>' if read else ""
        return f'<section class="step">{words}{shown}{readings}</section>'

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {
            "text/html": self.html,
            "text/plain": f"{self.number}. {self.tell(self.step.title)}: {self.tell(self.step.caption)}",
        }


def _reading(row: ReadingRow, tell: Tell) -> str:
    """A reading as mm x mu = value; of one at many stations the greatest, and all of them to be unfolded."""
    if not row.paper.ndim:
        return escape(tell(say("{title} = {said}", title=row.title, said=row.said())))
    greatest = int(np.nanargmax(np.abs(row.paper)))
    lines = "".join(f"<li>{place}: {escape(tell(row.said(k)))}</li>" for k, place in enumerate(row.places))
    place, said = row.places[greatest], row.said(greatest)
    first = say("{title}, the greatest at {place} = {said}", title=row.title, place=place, said=said)
    return f"<details><summary>{escape(tell(first))}</summary><ul>{lines}</ul></details>"


@dataclass(frozen=True, eq=False)
class StepBoard:
    """One view of a construction with all that is drawn in it, so that nothing moves from one step to the next.

    former : steps of the constructions that this one starts from, drawn in the same view before it
    steps : its own
    """

    former: tuple[Step, ...]
    steps: tuple[Step, ...]

    @cached_property
    def _panel(self) -> Panel:
        marks = tuple(mark for step in (*self.former, *self.steps) for mark in step.marks)
        panel = Panel(self.steps[-1].view, marks, LETTERS)
        size = panel.content
        return replace(panel, factor=min(1.0, WIDEST / size.width, HIGHEST / size.height))

    @cached_property
    def _box(self) -> Box:
        return self._panel.content.grown(MARGIN)

    @cached_property
    def _drawn(self) -> list[list[Entity]]:
        place = Placement(-self._box.corner, self._panel.factor)
        expanded = [expand(step.marks, place, LETTERS) for step in (*self.former, *self.steps)]
        return lettered(expanded, [], self._box.moved(-self._box.corner))

    def page(self, current: int | None = None) -> Page:
        """The drawing up to the own step of that index, which is in colour; by default the finished drawing."""
        count = len(self._drawn) if current is None else len(self.former) + current + 1
        groups: list[Group] = []
        for k, entities in enumerate(shading_parted(self._drawn[:count])):
            stage = CURRENT_STEP if k == count - 1 else FORMER_STEP
            shown = entities if current is None else tuple(_in_progress(e, stage) for e in entities)
            groups.append(Group(f"step-{k + 1:02d}", shown))
        box = self._box.moved(-self._box.corner)
        return Page(box.width, box.height, box, tuple(groups))


def _in_progress(entity: Entity, stage: str) -> Entity:
    return replace(entity, role=in_progress(entity.role, stage))


def ancestors(construction: Construction) -> list[Construction]:
    """The constructions that one starts from, directly or not, the first drawn first.

    >>> from graphcam.solving.solve import solve
    >>> from graphcam.tasks.task_file import builtin_task
    >>> [c.name for c in ancestors(solve(builtin_task()).drawn["minimum_radius"])]
    ['acceleration', 'integration']
    """
    found: dict[str, Construction] = {}
    for given in construction.givens.values():
        if isinstance(given, Construction):
            found |= {c.name: c for c in (*ancestors(given), given)}
    return list(found.values())


def boards(construction: Construction, tell: Tell = str, on: Construction | None = None) -> dict[str, StepBoard]:
    """The views that a construction draws in, by name, each with what stood in it before.

    on : a construction that it does not start from, but is drawn over
    """
    steps = [step.told(tell) for step in construction.steps()]
    before = [step.told(tell) for c in (*ancestors(construction), *([on] if on else ())) for step in c.steps()]
    names = dict.fromkeys(step.view.name for step in steps if step.marks)
    return {name: StepBoard(_in_view(before, name), _in_view(steps, name)) for name in names}


def _in_view(steps: Sequence[Step], name: str) -> tuple[Step, ...]:
    return tuple(step for step in steps if step.view.name == name)


def stages(construction: Construction, tell: Tell = str, on: Construction | None = None) -> Iterator[Stage]:
    """The steps of a construction, each with the drawing so far; ``tell`` says all texts, ``on`` as for boards."""
    of_view, drawn = boards(construction, tell, on), Counter[str]()
    for number, step in enumerate(construction.steps(), 1):
        name = step.view.name
        page = of_view[name].page(drawn[name]) if name in of_view else None
        drawn[name] += 1
        yield Stage(number, step, page, tuple(rows(construction, step)), tell)


def drawing(construction: Construction, view: str | None = None, tell: Tell = str) -> Picture:
    """The finished drawing of a construction in one of its views, by default the first; ``tell`` says all texts.

    >>> from graphcam.solving.solve import solve
    >>> from graphcam.tasks.task_file import builtin_task
    >>> drawing(solve(builtin_task()).drawn["minimum_radius"]).caption
    'Displacement and velocity: the least radius'

    Raises
    ------
    DesignError : the construction draws nothing in that view
    """
    from graphcam.sheets.matplotlib_renderer import svg

    of_view = boards(construction, tell)
    if view is not None and view not in of_view:
        raise DesignError("view", view, f"one of {', '.join(of_view)}")
    board = of_view[view] if view is not None else next(iter(of_view.values()))
    title = str(board.steps[-1].view.title)
    return Picture(svg(board.page()), f"{title}. {board.steps[-1].caption}", title)


def show_steps(construction: Construction, *numbers: int, tell: Tell = str, on: Construction | None = None) -> None:
    """Show steps of a construction in a notebook, by their numbers from 1; without a number all of them.

    tell : says all texts, such as ``task.drawing.tell`` in the language of the task
    on : a construction that this one does not start from, but is drawn over: it is shown below it
    """
    from IPython.display import display

    for stage in stages(construction, tell, on):
        if not numbers or stage.number in numbers:
            display(stage)
