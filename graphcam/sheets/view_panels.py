"""Views as panels: their entities, the box that they need, and how those that share an axis stand together."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from graphcam.drafting.ink import Step, View
from graphcam.drafting.marks import Mark, Points
from graphcam.sheets.formats import Lettering
from graphcam.sheets.mark_entities import Placement, expand
from graphcam.sheets.model import Box, Entity, Text, bounding_box
from graphcam.sheets.packing import MESH, Room
from graphcam.sheets.sampling import box_around, box_of_lines, linework, outermost, sampled
from graphcam.sheets.text_measures import width, wrap

LABEL_MARGIN = 3.0
"""The free margin around the drawing of a view, for labels [mm]."""
STRIP_HEIGHT, MIN_STRIP_COUNT = 8.0, 12
"""The height of the boxes that cover the outline of a view [mm], and the minimum number of them."""
TITLE_GAP = 1.5
"""The gap between a title and the lines below it [mm]."""
BLANK_FIELD = "_____"
"""The blank in which a number is to be written."""
LINE_SPACING = 1.7
"""The distance from base line to base line, in heights of the letters."""


@dataclass(frozen=True, eq=False)
class Panel:
    """A view with everything that is drawn in it; its boxes are about the view's origin.

    factor : the reduction on a screen, or a trial enlargement; on paper it is 1
    under : marks that it has only where no view of the same column stands below
    lowest : whether no view of the same column stands below
    """

    view: View
    marks: tuple[Mark, ...]
    letters: Lettering
    factor: float = 1.0
    under: tuple[Mark, ...] = ()
    lowest: bool = False

    @property
    def base(self) -> tuple[Mark, ...]:
        """The marks that the panel has because it is the lowest of its column."""
        return self.under if self.lowest else ()

    @cached_property
    def as_lowest(self) -> "Panel":
        """The panel as the lowest of its column."""
        return replace(self, lowest=True) if self.under else self

    def enlarged(self, times: float) -> "Panel":
        """The panel with its drawing so many times as large, and then in no column or row with others."""
        own = replace(self.view, across=self.view.name, up=self.view.name)
        return self if times == 1.0 else replace(self, factor=times * self.factor, view=own)

    @cached_property
    def _entities(self) -> list[Entity]:
        entities, writings = expand(self.marks + self.base, Placement(0j, self.factor), self.letters)
        return [*entities, *(writing.set_at(writing.close) for writing in writings)]

    @cached_property
    def _lines(self) -> tuple[Points, Points]:
        return linework(self._entities)

    @cached_property
    def points(self) -> Points:
        """Points (n,), 1 mm apart, on all that is drawn."""
        return sampled(*self._lines, 1.0)

    @cached_property
    def drawn(self) -> Box:
        """The box of the drawing."""
        return box_of_lines(*self._lines) or Box(0, 0, 1, 1)

    @property
    def content(self) -> Box:
        """The box of the drawing, with room for its labels."""
        return self.drawn.grown(LABEL_MARGIN)

    @cached_property
    def heading(self) -> list[Text]:
        """The title about the lower left corner of its box: its first words large, what follows a comma as a note."""
        name, _, note = str(self.view.title).replace("，", ", ").partition(", ")
        large, small = self.letters.title, self.letters.label
        room = max(self.content.width, 17.0 * self.letters.title)
        lines = wrap(name, large, room)
        end = width(lines[-1], large) + large if lines else 0.0
        # The note follows on the same line if it fits there.
        behind = end + width(note, small) <= room
        notes = [] if behind else _in_lines(note, small, room)
        texts: list[Text] = []
        base = LINE_SPACING * (small * len(notes) + large * len(lines)) + 0.2 * large
        for line, height in [*((line, large) for line in lines), *((line, small) for line in notes)]:
            base -= LINE_SPACING * height
            texts.append(Text(complex(LABEL_MARGIN, base), line, height))
        return [*texts, Text(complex(LABEL_MARGIN + end, base), note, small)] if behind else texts

    @cached_property
    def title_box(self) -> Box:
        """The box of the title, over the left end of the drawing, as low as its lines leave room."""
        content = self.content
        wide = max(text.at.real + width(text.text, text.height) for text in self.heading) + LABEL_MARGIN
        high = max(text.at.imag + (LINE_SPACING - 0.2) * text.height for text in self.heading)
        # Over a diagram whose axis stands at the left, the title begins at the axis, one under the other in a column.
        at_axis = -content.width / 4 < content.left < 0
        # Beside an axis numbers want the room below a title: there it goes down only where the grid has it to spare.
        left, air = (4.0, 1.0) if at_axis else (content.left, MESH)
        room = Room(Box(left, content.top - high, left + wide + air, content.top + high + air))
        room.take_points(self.points, TITLE_GAP)
        title = Box(left, content.top, left + wide, content.top + high)
        by = room.find([title], lambda x, y: y + 100 * x)
        return title.moved(by) if by is not None else title

    @cached_property
    def box(self) -> Box:
        """The whole box, title included."""
        return bounding_box([self.content, self.title_box])

    @cached_property
    def outline(self) -> list[Box]:
        """Boxes that together cover the convex outline of the view with its title, with room for labels."""
        title = self.title_box.grown(-LABEL_MARGIN)
        hull = outermost(np.concatenate([self.points, title.corners]))
        # Densely, so that every strip has a point on either side.
        count = max(MIN_STRIP_COUNT, round(self.box.height / STRIP_HEIGHT))
        shares = np.linspace(0.0, 1.0, 10 * count)[:, None]
        points = (hull + shares * (np.roll(hull, -1) - hull)).ravel()
        levels = np.linspace(self.box.bottom + LABEL_MARGIN, self.box.top - LABEL_MARGIN, count + 1)
        # The hull is that of some directions: what a long drawing has in its middle may stick out of it.
        of_hull, drawn = (_in_bands(each, levels) for each in (points, self.points))
        both = ([*(box.grown(LABEL_MARGIN) for box in hull), *own] for hull, own in zip(of_hull, drawn, strict=True))
        return [bounding_box(boxes) for boxes in both if boxes]

    @cached_property
    def hollow(self) -> Room:
        """The empty parts of the drawing, where something with air of its own may stand; read only."""
        room = Room(self.content, [self.title_box])
        room.take_points(self.points, LABEL_MARGIN)
        return room

    def title(self, origin: complex, *, answered: bool = True) -> list[Entity]:
        """The title's texts on the page, with the scale that is found by drawing or a blank to write it in."""
        corner, answer = origin + self.title_box.corner, str(self.view.answer or "")
        texts = [replace(text, at=corner + text.at, view=self.view.name) for text in self.heading if text.text]
        if answered or not answer:
            return [*texts]
        return [replace(text, text=text.text.replace(answer, BLANK_FIELD)) for text in texts]


def _in_bands(points: Points, levels: Iterable[float]) -> list[list[Box]]:
    """The boxes of the points between each two levels; none for a band without points."""
    bands = (points[(points.imag >= low - 0.1) & (points.imag <= high + 0.1)] for low, high in pairwise(levels))
    return [[box_around(band)] if len(band) else [] for band in bands]


def _in_lines(note: str, height: float, room: float) -> list[str]:
    """The lines of a note, no wider than ``room`` mm, broken at its commas where that is enough."""
    lines: list[str] = []
    for part in note.split(", "):
        if lines and width(f"{lines[-1]}, {part}", height) <= room:
            lines[-1] += f", {part}"
        else:
            lines = [*lines[:-1], *(f"{line}," for line in lines[-1:]), *wrap(part, height, room)]
    return lines


def panels(steps: Iterable[Step], letters: Lettering) -> list[Panel]:
    """The views of steps as panels, in the order of their first step; of several titles of one view the last counts."""
    views: dict[str, View] = {}
    marks: dict[str, list[Mark]] = {}
    under: dict[str, tuple[Mark, ...]] = {}
    for step in steps:
        views[step.view.name] = step.view
        marks.setdefault(step.view.name, []).extend(step.marks)
        under[step.view.name] = under.get(step.view.name, ()) + step.under
    return [Panel(view, tuple(marks[name]), letters, under=under[name]) for name, view in views.items()]


def with_lowest(group: Sequence[Panel]) -> list[Panel]:
    """The views with the last of each column as the lowest."""
    last = {panel.view.across: panel for panel in group}
    return [panel.as_lowest if panel is last[panel.view.across] else panel for panel in group]


def clusters(views: Sequence[Panel]) -> list[list[Panel]]:
    """Groups of panels that share an axis, directly or through others."""
    found: list[list[Panel]] = []
    for panel in views:
        sharing = [cluster for cluster in found if shares(panel, cluster)]
        found = [c for c in found if c not in sharing] + [[*(p for c in sharing for p in c), panel]]
    return found


def shares(panel: Panel, others: Iterable[Panel]) -> bool:
    """Whether a view shares an axis with one of the others."""
    return any(panel.view.across == other.view.across or panel.view.up == other.view.up for other in others)


def panel_origins(group: Sequence[Panel], gap: float) -> list[complex]:
    """Origins of panels, the first at 0: those that share ``across`` one under the other, ``up`` side by side.

    >>> from graphcam.drafting.ink import say
    >>> from graphcam.drafting.marks import Line, Role
    >>> import numpy as np
    >>> line = Line(np.array([0, 10 + 10j]), Role.CURVE)
    >>> upper, lower = (Panel(View(n, say(""), "phi", n), (line,), Lettering(5, 3.5, 2.5)) for n in ("v", "s"))
    >>> panel_origins([upper, lower], 4.0)
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


def are_disjoint(boxes: Sequence[Box]) -> bool:
    """Whether no two boxes overlap."""
    return not any(a.meets(b) for k, a in enumerate(boxes) for b in boxes[:k])
