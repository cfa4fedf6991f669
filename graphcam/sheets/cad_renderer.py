"""DXF with what a CAD program can go on working with: true dimensions, a title block with attributes, viewports.

The sheet is the same as in :mod:`graphcam.sheets.dxf_renderer`, and drawn by it; but the lines of a dimension are a
DIMENSION, the frame with its title block is a block whose entries are ATTRIBs, and every page has a layout in paper
space that shows it 1:1.  Not every reader knows these; the plain file is for all of them.
"""

from __future__ import annotations

import cmath
import math
import os
from typing import TYPE_CHECKING

from graphcam.sheets.dxf_renderer import (
    ALIGNED,
    BETWEEN_PAGES,
    LETTERS,
    draw,
    draw_pages,
    layer,
    repeatable,
    sheet_document,
)
from graphcam.sheets.expand import GAP, OVERRUN
from graphcam.sheets.model import Angle, Drawing, Group, Length, Text

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document

STYLE = "GRAPHCAM"
"""The name of the style of dimensions."""
HEAD = 3.5
"""Length of the heads of arrows, mm."""


def write_cad(drawing: Drawing, path: str | os.PathLike[str]) -> None:
    """All pages of a drawing, side by side in the model space, each with a layout in paper space that shows it 1:1."""
    with repeatable():
        document = sheet_document(drawing)
        _add_style(document)
        draw_pages(document, drawing, _draw_group)
        _add_layouts(document, drawing)
        document.saveas(path)


def _add_style(document: Document) -> None:
    document.dimstyles.add(
        STYLE,
        dxfattribs={
            "dimtxsty": LETTERS, "dimasz": HEAD, "dimexo": GAP, "dimexe": OVERRUN, "dimgap": 0.8, "dimtad": 1,
            "dimscale": 1.0, "dimlfac": 1.0,
        },
    )  # fmt: skip


def _add_layouts(document: Document, drawing: Drawing) -> None:
    left = 0.0
    for number, page in enumerate(drawing.pages, 1):
        name = f"Sheet {number}"
        if number == 1:
            document.layouts.rename("Layout1", name)
        layout = document.paperspace(name) if number == 1 else document.layouts.new(name)
        size, middle = (page.width, page.height), (page.width / 2, page.height / 2)
        layout.page_setup(size=size, margins=(0, 0, 0, 0), units="mm")
        layout.add_viewport(middle, size, (left + middle[0], middle[1]), page.height)
        left += page.width + BETWEEN_PAGES


def _draw_group(document: Document, group: Group, prefix: str, left: float) -> None:
    if group.name == "frame":
        _draw_frame(document, group, prefix, left)
        return
    lines = {line for e in group.entities if isinstance(e, Text) and e.of and _measurable(e.of) for line in e.of.lines}
    for entity in group.entities:
        on = layer(document, group, prefix, entity.role)
        match entity:
            case Text(of=Length() as measured):
                _add_length(document, entity, measured, on, left)
            case Text(of=Angle() as measured) if _measurable(measured):
                _add_angle(document, entity, measured, on, left)
            case _ if entity not in lines:
                draw(document.modelspace(), entity, on, left)
            case _:
                pass


def _measurable(measured: Length | Angle) -> bool:
    """Whether a DIMENSION can measure it: an angle between two lines is less than half a turn."""
    return isinstance(measured, Length) or measured.end - measured.start < math.pi


def _draw_frame(document: Document, group: Group, prefix: str, left: float) -> None:
    """The frame as a block; what the task's title says are attributes of it, which can be edited."""
    block = document.blocks.new(f"{prefix}FRAME")
    entries: dict[str, str] = {}
    for entity in group.entities:
        on = layer(document, group, prefix, entity.role)
        if isinstance(entity, Text) and entity.field:
            tag = entity.field.upper()
            # An entry that is broken into lines, or stands in two places, has an attribute for each.
            tag += f"_{1 + sum(other.startswith(tag) for other in entries)}" * (tag in entries)
            entries[tag] = entity.text
            attribute = block.add_attdef(tag, text=entity.text, height=entity.height,
                                         rotation=math.degrees(entity.angle),
                                         dxfattribs={"layer": on, "style": LETTERS})  # fmt: skip
            attribute.set_placement((entity.at.real, entity.at.imag), align=ALIGNED[entity.align])
        else:
            draw(block, entity, on, 0.0)
    placed = document.modelspace().add_blockref(block.name, (left, 0.0), dxfattribs={"layer": "0"})
    placed.add_auto_attribs(entries)


def _add_length(document: Document, text: Text, measured: Length, on: str, left: float) -> None:
    document.modelspace().add_linear_dim(
        base=_xy(measured.foot, left), p1=_xy(measured.start, left), p2=_xy(measured.end, left),
        location=_xy(_middle(text), left), text=text.text, text_rotation=math.degrees(text.angle),
        angle=math.degrees(cmath.phase(measured.end - measured.start)), dimstyle=STYLE,
        override={"dimtxt": text.height}, dxfattribs={"layer": on},
    ).render()  # fmt: skip


def _add_angle(document: Document, text: Text, measured: Angle, on: str, left: float) -> None:
    first, last = (measured.centre + cmath.rect(measured.radius, way) for way in (measured.start, measured.end))
    between = measured.centre + cmath.rect(measured.radius, (measured.start + measured.end) / 2)
    centre = _xy(measured.centre, left)
    # Between two lines: LibreCAD passes over the kind that has a centre and two points.
    document.modelspace().add_angular_dim_2l(
        base=_xy(between, left), line1=(centre, _xy(first, left)), line2=(centre, _xy(last, left)),
        location=_xy(_middle(text), left), text=text.text, text_rotation=math.degrees(text.angle), dimstyle=STYLE,
        override={"dimtxt": text.height}, dxfattribs={"layer": on},
    ).render()  # fmt: skip


def _middle(text: Text) -> complex:
    """The middle of the letters of a centred text."""
    return text.at + cmath.rect(text.height / 2, text.angle + math.pi / 2)


def _xy(point: complex, left: float) -> tuple[float, float]:
    return point.real + left, point.imag
