"""The working drawing of the cam with its callouts, from which alone a machinist can make the part.

It takes the smallest sheet on which everything stands side by side at a standard scale; what is too long even for the
largest goes on with the polar table on further pages.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.drafting.scale import ratio_text
from graphcam.sheets.labels import lettered_steps, shading_parted
from graphcam.sheets.mark_entities import Drawn
from graphcam.sheets.model import Box, Drawing, Entity, Group, Page, Text
from graphcam.sheets.packing import MESH, Grid, Preference, Room
from graphcam.sheets.part_symbols import (
    LINE_PROFILE_TOLERANCE,
    PERPENDICULARITY_TOLERANCE,
    PartSymbol,
    leader,
    nearest_place,
    roughness,
    shelf_leader,
    tolerance_frame,
)
from graphcam.sheets.sampling import linework, sampled
from graphcam.sheets.sheet_frame import frame as empty_sheet
from graphcam.words import say
from graphcam.workshop.cam_part import profile_tolerance
from graphcam.workshop.part_contents import PartContents
from graphcam.workshop.part_layout import PartLayout, Placed, drawn_blocks, part_layout, table_pages
from graphcam.workshop.part_views import (
    DATUM_LETTER,
    DETAIL_LETTER,
    KEYWAY_LETTER,
    SECTION_LETTER,
    ShownPart,
    bore_box,
    bore_view,
    dimensioned_radii,
    front_box,
    front_view,
    heights,
    section_box,
    section_view,
)

SYMBOL_OFFSET = 30.0
"""The distance from the left face of the section to its symbols [mm]."""
EDGE_DISTANCE = 4.0
"""The distance from the edges of a face at which a line ends on it [mm]; at most a third of its height."""


RADIUS_LINE_ANGLE = math.radians(10)
"""The angle between the line of a radius and the end of another line on the profile, about the axis [rad]."""


@dataclass(frozen=True, eq=False)
class Callout:
    """A symbol of a view with a line to a face.

    wanted : the best place for the lower left corner of its box;  face : places on the face
    lead : draws the line from the symbol's box to the nearest of these
    """

    view: str
    symbol: PartSymbol
    wanted: complex
    face: Points
    lead: Callable[[Box, complex], list[Entity]]


def placed_callouts(contents: PartContents, layout: PartLayout, lines: Iterable[Entity]) -> dict[str, list[Entity]]:
    """The symbols with their leaders, each in free room near its face, by the view; ``lines`` stand there already."""
    room = Room(layout.sheet.content.grown(-2))
    room.take_points(sampled(*linework(lines), 1.0), 2.0)
    found: dict[str, list[Entity]] = {}
    for asked in _callouts(contents, layout):
        symbol, wanted = asked.symbol, asked.wanted
        found_room = room.find([symbol.box.grown(1.0)], _nearness((wanted - room.corner) / MESH))
        by = wanted if found_room is None else found_room
        box = symbol.box.moved(by)
        room.take(box.grown(2))
        middle = complex((box.left + box.right) / 2, (box.bottom + box.top) / 2)
        place = complex(asked.face[np.argmin(np.abs(asked.face - middle))])
        found.setdefault(asked.view, []).extend([*symbol.drawn(by), *asked.lead(box, place)])
    return found


def _nearness(wanted: complex) -> Preference:
    def distance(x: Grid, y: Grid) -> Grid:
        """The square of the distance, in cells."""
        return (x - wanted.real) ** 2 + (y - wanted.imag) ** 2

    return distance


def _callouts(contents: PartContents, layout: PartLayout) -> list[Callout]:
    shown, table, tell = layout.shown, contents.part.table, contents.tell
    height = layout.sheet.lettering.label
    value = tell(say("{value:g}", value=profile_tolerance(table, contents.outline.greatest_radius)))
    bore_axis = tell(DATUM_LETTER)
    # The keyway sets the cam angle, so the profile is toleranced from it too.
    datums = (bore_axis, tell(KEYWAY_LETTER)) if contents.part.keyway else (bore_axis,)

    def ra(micrometres: float) -> PartSymbol:
        """The symbol of a roughness Ra."""
        return roughness(tell(say("Ra {ra:g}", ra=micrometres)), height)

    line = tolerance_frame(LINE_PROFILE_TOLERANCE, value, datums, height)
    square = tolerance_frame(PERPENDICULARITY_TOLERANCE, value, (bore_axis,), height)
    front, bore = front_box(shown), bore_box(shown)
    # On the side away from the arrow of the angle.
    across = front.right - line.box.width if shown.outline.sense > 0 else front.left
    upper, lower = _side(shown, 1), _side(shown, -1)
    on_bore = layout.bore + _bore_face(shown)
    above = complex(-SYMBOL_OFFSET, float(upper.imag.mean()))
    below = complex(-SYMBOL_OFFSET, float(lower.imag.mean()) - 2 * height)
    of_profile, of_bore = ra(table.profile_roughness), ra(table.bore_roughness)
    corners = complex(across, front.top - 16), complex(front.left, front.bottom + 10)
    boxes = line.box.moved(corners[0]), of_profile.box.moved(corners[1])
    on_profile = [layout.front + _profile_face(shown, nearest_place(box, 0j)) for box in boxes]
    return [
        Callout("front", line, layout.front + corners[0], on_profile[0], leader),
        Callout("front", of_profile, layout.front + corners[1], on_profile[1], shelf_leader),
        Callout("section", square, layout.section + above, layout.section + upper, leader),
        Callout("section", of_bore, layout.section + below, layout.section + lower, shelf_leader),
        Callout("bore", of_bore, layout.bore + complex(bore.left, bore.bottom + 16), on_bore, shelf_leader),
    ]


def _profile_face(shown: ShownPart, start: complex) -> Points:
    """Places on the profile that a line from a start reaches without crossing those of the radii or their heads."""
    free = np.full(shown.wall.shape, True)
    for at, _ in dimensioned_radii(shown):
        side = math.copysign(1.0, (start / at).imag)
        free &= side * np.angle(shown.wall / at) > RADIUS_LINE_ANGLE
    return shown.wall[free] if free.any() else shown.wall


def _side(shown: ShownPart, way: int) -> Points:
    """Places on the visible left face of the section, above or below the bore."""
    *_, low, high = heights(shown)
    inner, outer = shown.scale * shown.part.keyway_top, high if way > 0 else -low
    edge = min(EDGE_DISTANCE, (outer - inner) / 3)
    return 1j * way * np.linspace(inner + edge, outer - edge, 50)


def _bore_face(shown: ShownPart) -> Points:
    ways: Points = np.exp(-1j * np.linspace(2.4, 3.0, 30))
    return shown.bore_scale * shown.part.bore / 2 * ways


def working_drawing_of(contents: PartContents) -> Drawing:
    """The working drawing of a cam, and after it that of the second one of a conjugate pair.

    Raises
    ------
    DesignError : the part is impossible, or no profile can be cut

    >>> import graphcam as gc
    >>> drawing = working_drawing_of(PartContents(gc.solve(gc.builtin_task())))
    >>> len(drawing.pages), drawing.pages[0].width
    (1, 420.0)
    """
    views, tables = part_layout(contents)
    sheet = views.sheet
    further = table_pages(contents, sheet) if tables is None else []
    count = 1 + len(further)
    title = contents.title(views.shown.scale)
    pages = [
        _first_page(contents, views, tables or [], empty_sheet(sheet, title, 1, count, contents.tell, gauged=False))
    ]
    for k, blocks in enumerate(further, 2):
        empty = empty_sheet(sheet, title, k, count, contents.tell, gauged=False)
        pages.append(Page(*sheet.size, sheet.content, (empty, Group("tables", drawn_blocks(blocks)))))
    if contents.given.second_roller is not None and not contents.second:
        pages += working_drawing_of(replace(contents, second=True)).pages
    return Drawing(title.name, tuple(pages))


def _first_page(contents: PartContents, views: PartLayout, tables: Placed, empty: Group) -> Page:
    shown, sheet = views.shown, views.sheet
    drawn: dict[str, Drawn] = {
        "front": front_view(shown, views.front),
        "section": section_view(shown, views.section),
        "bore": bore_view(shown, views.bore),
    }
    words = [*drawn_blocks(tables), *drawn_blocks(views.fixed), *views.general[0].drawn(views.general[1])]
    titles = _view_titles(views)
    lines = [*empty.entities, *words, *titles, *(entity for entities, _ in drawn.values() for entity in entities)]
    for name, entities in placed_callouts(contents, views, lines).items():
        drawn[name][0].extend(entities)
    beside = [*empty.entities, *words, *titles]
    placed = shading_parted(lettered_steps(list(drawn.values()), beside, sheet.content))
    groups = [Group(name, entities) for name, entities in zip(drawn, placed, strict=True)]
    origins = {"front": views.front, "section": views.section}
    extra = [Group("titles", tuple(titles)), Group("tables", tuple(words))]
    return Page(*sheet.size, sheet.content, (empty, *extra, *groups), origins)


def _view_titles(views: PartLayout) -> list[Entity]:
    shown, tell, height = views.shown, views.shown.tell, views.sheet.lettering.title
    letter = tell(SECTION_LETTER)
    section = views.section + complex(shown.scale * shown.part.length / 2, section_box(shown).top - 8)
    bore = views.bore + 1j * (bore_box(shown).top - 6)
    scale = tell(ratio_text(1 / shown.bore_scale))
    return [
        Text(section, f"{letter}–{letter}", height, "center", view="section"),
        Text(bore, f"{tell(DETAIL_LETTER)} ({scale})", height, "center", view="bore"),
    ]
