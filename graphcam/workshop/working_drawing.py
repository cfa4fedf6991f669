"""The working drawing of the cam: from it alone a machinist can make the part.

It takes the smallest sheet on which everything stands side by side at a standard scale; what is too long even for the
largest goes on with the polar table on further pages.
"""

from __future__ import annotations

from graphcam.drafting.scale import ratio_text
from graphcam.sheets.expand import Drawn
from graphcam.sheets.frame import frame as empty_sheet
from graphcam.sheets.labels import lettered, shading_parted
from graphcam.sheets.model import Drawing, Entity, Group, Page, Text
from graphcam.workshop.bore_view import bore_box, bore_view
from graphcam.workshop.part_callouts import called_out
from graphcam.workshop.part_contents import PartContents
from graphcam.workshop.part_layout import PartLayout, Placed, drawn_blocks, laid_out, table_pages
from graphcam.workshop.part_views import (
    DETAIL,
    SECTION,
    front_view,
    section_box,
    section_view,
)


def working_drawing_of(contents: PartContents) -> Drawing:
    """The working drawing of a cam.

    Raises
    ------
    DesignError : the part cannot be, or no profile can be cut

    >>> import graphcam as gc
    >>> drawing = working_drawing_of(PartContents(gc.solve(gc.builtin_task())))
    >>> len(drawing.pages), drawing.pages[0].width
    (1, 420.0)
    """
    views, tables = laid_out(contents)
    sheet = views.sheet
    further = table_pages(contents, sheet) if tables is None else []
    count = 1 + len(further)
    title = contents.title(views.shown.scale)
    pages = [_first_page(contents, views, tables or [], empty_sheet(sheet, title, 1, count, contents.tell))]
    for k, blocks in enumerate(further, 2):
        empty = empty_sheet(sheet, title, k, count, contents.tell)
        pages.append(Page(*sheet.size, sheet.content, (empty, Group("tables", drawn_blocks(blocks)))))
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
    for name, entities in called_out(contents, views, lines).items():
        drawn[name][0].extend(entities)
    beside = [*empty.entities, *words, *titles]
    placed = shading_parted(lettered(list(drawn.values()), beside, sheet.content))
    groups = [Group(name, entities) for name, entities in zip(drawn, placed, strict=True)]
    origins = {"front": views.front, "section": views.section}
    extra = [Group("titles", tuple(titles)), Group("tables", tuple(words))]
    return Page(*sheet.size, sheet.content, (empty, *extra, *groups), origins)


def _view_titles(views: PartLayout) -> list[Entity]:
    """The titles over the section and over the enlarged bore."""
    shown, tell, height = views.shown, views.shown.tell, views.sheet.lettering.title
    letter = tell(SECTION)
    section = views.section + complex(shown.scale * shown.part.length / 2, section_box(shown).top - 8)
    bore = views.bore + 1j * (bore_box(shown).top - 6)
    scale = tell(ratio_text(1 / shown.bore_scale))
    return [
        Text(section, f"{letter}–{letter}", height, "center", view="section"),
        Text(bore, f"{tell(DETAIL)} ({scale})", height, "center", view="bore"),
    ]
