"""Views as panels: what is drawn in them, the box that they need, and how those that share an axis stand together."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from graphcam.drafting.ink import Step, View
from graphcam.drafting.marks import Mark, Points
from graphcam.sheets.box import Box, around_all
from graphcam.sheets.expand import Placement, expand
from graphcam.sheets.fonts import width, wrap
from graphcam.sheets.formats import Lettering
from graphcam.sheets.model import Entity, Text
from graphcam.sheets.packing import Room
from graphcam.sheets.sampling import around, box_of_lines, linework, sampled
from graphcam.words import Tell, say

AIR = 3.0
"""Free margin around what is drawn in a view, where labels find room, mm."""
STRIP, STRIPS = 6.0, 30
"""The footprint of a view is taken in strips of at least this height [mm], and of at most about so many."""
TITLE_AIR = 1.5
"""Between a title and the lines below it, mm."""
BLANK = "_____"
"""Where a number is to be written."""
LEADING = 1.7
"""From base line to base line, in heights of the letters."""


@dataclass(frozen=True, eq=False)
class Panel:
    """A view with everything that is drawn in it, shown reduced by ``factor``; boxes are about the view's origin.

    noted : whether the title says by how much it is shown reduced
    """

    view: View
    marks: tuple[Mark, ...]
    letters: Lettering
    factor: float = 1.0
    tell: Tell = str
    noted: bool = True

    @cached_property
    def _drawn(self) -> list[Entity]:
        entities, writings = expand(self.marks, Placement(0j, self.factor), self.letters)
        return [*entities, *(writing.set_at(0) for writing in writings)]

    @cached_property
    def _lines(self) -> tuple[Points, Points]:
        return linework(self._drawn)

    @cached_property
    def points(self) -> Points:
        """Points 1 mm apart on all that is drawn."""
        return sampled(*self._lines, 1.0)

    @cached_property
    def content(self) -> Box:
        """The box of the drawing, with room for its labels."""
        return (box_of_lines(*self._lines) or Box(0, 0, 1, 1)).grown(AIR)

    @cached_property
    def heading(self) -> list[Text]:
        """The title about the lower left corner of its box: its first words large, what follows a comma as a note."""
        name, _, note = str(self.view.title).partition(", ")
        if self.noted and self.factor != 1:
            note += "; " * bool(note) + self.tell(say("shown reduced 1:{times:g}", times=1 / self.factor))
        large, small = self.letters.title, self.letters.label
        room = max(self.content.width, 17.0 * self.letters.title)
        lines = wrap(name, large, room)
        end = width(lines[-1], large) + large if lines else 0.0
        # The note follows on the same line if it fits there.
        behind = end + width(note, small) <= room
        notes = [] if behind else wrap(note, small, room)
        texts: list[Text] = []
        base = LEADING * (small * len(notes) + large * len(lines)) + 0.2 * large
        for line, height in [*((line, large) for line in lines), *((line, small) for line in notes)]:
            base -= LEADING * height
            texts.append(Text(complex(AIR, base), line, height))
        return [*texts, Text(complex(AIR + end, base), note, small)] if behind else texts

    @cached_property
    def title_box(self) -> Box:
        """The room of the title, over the left end of the drawing, as low as its lines leave room."""
        content = self.content
        wide = max(text.at.real + width(text.text, text.height) for text in self.heading) + AIR
        high = max(text.at.imag + (LEADING - 0.2) * text.height for text in self.heading)
        # Over a diagram whose axis stands at the left, the title begins at the axis, one under the other in a column.
        left = 4.0 if -content.width / 4 < content.left < 0 else content.left
        room = Room(Box(left, content.top - high, left + wide + 1.0, content.top + high + 1.0))
        room.take_points(self.points, TITLE_AIR)
        title = Box(left, content.top, left + wide, content.top + high)
        by = room.find([title], lambda x, y: y + 100 * x)
        return title.moved(by) if by is not None else title

    @cached_property
    def box(self) -> Box:
        """The whole box, title included."""
        return around_all([self.content, self.title_box])

    @cached_property
    def footprint(self) -> list[Box]:
        """Boxes that together cover the view more closely than one: other things may stand in its empty corners."""
        points, strip = self.points, max(STRIP, self.content.height / STRIPS)
        level = np.floor(points.imag / strip)
        strips = [points[level == k] for k in np.unique(level)]
        return [*(around(p).grown(AIR) for p in strips), self.title_box]

    def empty(self, origin: complex) -> Room:
        """The empty parts of the drawing."""
        room = Room(self.content.moved(origin), [self.title_box.moved(origin)])
        room.take_points(self.points + origin, 2 * AIR)
        return room

    def title(self, origin: complex, *, answered: bool = True) -> list[Entity]:
        """The title's texts on the page, with what is only found by drawing or a blank to write it in."""
        corner, answer = origin + self.title_box.corner, str(self.view.answer or "")
        texts = [replace(text, at=corner + text.at, view=self.view.name) for text in self.heading if text.text]
        if answered or not answer:
            return [*texts]
        return [replace(text, text=text.text.replace(answer, BLANK)) for text in texts]


def panels(steps: Iterable[Step], letters: Lettering, tell: Tell = str) -> list[Panel]:
    """The views of steps in the order of their first step; of several titles of one view the last counts."""
    views: dict[str, View] = {}
    marks: dict[str, list[Mark]] = {}
    for step in steps:
        views[step.view.name] = step.view
        marks.setdefault(step.view.name, []).extend(step.marks)
    return [Panel(view, tuple(marks[name]), letters, tell=tell) for name, view in views.items()]


def clusters(views: Sequence[Panel]) -> list[list[Panel]]:
    """Panels that share an axis, directly or through others, together."""
    found: list[list[Panel]] = []
    for panel in views:
        sharing = [cluster for cluster in found if shares(panel, cluster)]
        found = [c for c in found if c not in sharing] + [[*(p for c in sharing for p in c), panel]]
    return found


def shares(panel: Panel, others: Iterable[Panel]) -> bool:
    """Whether a view shares an axis with one of the others."""
    return any(panel.view.across == other.view.across or panel.view.up == other.view.up for other in others)


def stand(group: Sequence[Panel], gap: float) -> list[complex]:
    """Origins of panels, the first at 0: what shares ``across`` one under the other, what shares ``up`` side by side.

    >>> from graphcam.drafting.ink import say
    >>> from graphcam.drafting.marks import Line, Role
    >>> import numpy as np
    >>> line = Line(np.array([0, 10 + 10j]), Role.CURVE)
    >>> upper, lower = (Panel(View(n, say(""), "phi", n), (line,), Lettering(5, 3.5, 2.5)) for n in ("v", "s"))
    >>> stand([upper, lower], 4.0)
    [0j, -26.25j]
    """
    columns: dict[str, list[Box]] = {}
    for panel in group:
        columns.setdefault(panel.view.across, []).append(panel.box)
    x: dict[str, float] = {}
    edge = 0.0
    for across, boxes in columns.items():
        # The first column's origin is 0; the others stand to the right of all that the former ones hold.
        x[across] = edge + gap - min(box.left for box in boxes) if x else 0.0
        edge = x[across] + max(box.right for box in boxes)
    y: dict[str, float] = {}
    bottoms: dict[str, float] = {}
    for panel in group:
        across, up, box = panel.view.across, panel.view.up, panel.box
        origin = y.setdefault(up, bottoms[across] - gap - box.top if across in bottoms else 0.0)
        bottoms[across] = min(bottoms.get(across, origin + box.bottom), origin + box.bottom)
    return [complex(x[panel.view.across], y[panel.view.up]) for panel in group]


def apart(boxes: Sequence[Box]) -> bool:
    """Whether no two boxes overlap."""
    return not any(a.meets(b) for k, a in enumerate(boxes) for b in boxes[:k])
