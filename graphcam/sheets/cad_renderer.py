"""DXF with entities that a CAD program can edit: true dimensions, a title block with attributes, viewports.

The sheet is the same as in :mod:`graphcam.sheets.dxf_renderer`, and drawn by it; but the lines of a dimension are a
DIMENSION, the frame with its title block is a block that carries its entries as ATTRIBs, and every page has a layout in
paper space that shows it 1:1.

Every reader is to show every text in its place.  LibreCAD shows no ATTRIB, sets the text of an angle along its arc and
that of a length along its line.  So the entries are TEXT, the ATTRIBs behind them, for lists of parts, are invisible,
and so is the text of a DIMENSION that stands otherwise: it is TEXT too.
"""

import cmath
import math
import os
from typing import Any

from ezdxf.document import Drawing as Document
from ezdxf.entities import DimStyleOverride
from ezdxf.layouts import Modelspace

from graphcam.sheets import dxf_renderer as dxf
from graphcam.sheets.dxf_renderer import TEXT_STYLE, draw, layer, set_text, xy
from graphcam.sheets.mark_entities import EXTENSION_GAP, EXTENSION_OVERRUN
from graphcam.sheets.model import Angle, Drawing, Group, Length, Text
from graphcam.sheets.text_measures import letters_of

DIMENSION_STYLE = "GRAPHCAM"
ARROW_HEAD_LENGTH = 3.5
"""The length of arrow heads [mm]."""
PARALLEL = 1e-6
"""The sine of an angle up to which two lines are parallel."""


def write_cad(drawing: Drawing, path: str | os.PathLike[str]) -> None:
    """Write all pages of a drawing, side by side in model space, each with a layout in paper space at 1:1."""
    with dxf.repeatable():
        document = dxf.sheet_document(drawing)
        lengths = {
            "dimasz": ARROW_HEAD_LENGTH,
            "dimexo": EXTENSION_GAP,
            "dimexe": EXTENSION_OVERRUN,
            "dimgap": 0.8,
            "dimscale": 1.0,
            "dimlfac": 1.0,
        }
        document.dimstyles.add(DIMENSION_STYLE, dxfattribs={"dimtxsty": TEXT_STYLE, "dimtad": 1, **lengths})
        dxf.draw_pages(document, drawing, _draw_group)
        _add_layouts(document, drawing)
        dxf.save(document, path)


def _add_layouts(document: Document, drawing: Drawing) -> None:
    for number, (left, page) in enumerate(dxf.side_by_side(drawing), 1):
        name = f"Sheet {number}"
        if number == 1:
            document.layouts.rename("Layout1", name)
        layout = document.paperspace(name) if number == 1 else document.layouts.new(name)
        size, middle = (page.width, page.height), (page.width / 2, page.height / 2)
        layout.page_setup(size=size, margins=(0, 0, 0, 0), units="mm")
        layout.add_viewport(middle, size, (left + middle[0], middle[1]), page.height)


def _draw_group(document: Document, group: Group, prefix: str, left: float) -> None:
    if group.name == "frame":
        _draw_frame(document, group, prefix, left)
        return
    space = document.modelspace()
    texts = [e for e in group.entities if isinstance(e, Text)]
    lines = {line for text in texts if text.of and _measurable(text.of) for line in text.of.lines}
    for entity in group.entities:
        on = layer(document, group, prefix, entity.role)
        match entity:
            case Text(of=Length() | Angle() as measured) if _measurable(measured):
                lettered = _stands_along(entity, measured)
                _add_dimension(space, entity, measured, on, left, lettered)
                if not lettered:
                    draw(space, entity, on, left)
            case _ if entity not in lines:
                draw(space, entity, on, left)
            case _:
                pass


def _measurable(measured: Length | Angle) -> bool:
    """Whether a DIMENSION can measure it: of angles, only those between two lines of less than half a turn."""
    return isinstance(measured, Length) or measured.end - measured.start < math.pi


def _stands_along(text: Text, measured: Length | Angle) -> bool:
    """Whether a text stands along its dimension line, where every reader sets it, in one piece."""
    if isinstance(measured, Angle) or measured.of_radius or len(letters_of(text.text, text.height)) > 1:
        return False
    across = cmath.rect(1.0, text.angle) / (measured.end - measured.start)
    return abs(across.imag) < PARALLEL * abs(across)


def _draw_frame(document: Document, group: Group, prefix: str, left: float) -> None:
    """Draw the frame as a block with the entries of the task's title as attributes, and their texts over it."""
    block = document.blocks.new(f"{prefix}FRAME")
    entries: dict[str, str] = {}
    for entity in group.entities:
        on = layer(document, group, prefix, entity.role)
        if isinstance(entity, Text) and entity.field:
            tag = entity.field.upper()
            # An entry that is broken into lines, or stands in two places, has an attribute for each.
            tag += f"_{1 + sum(other.startswith(tag) for other in entries)}" * (tag in entries)
            entries[tag] = entity.text
            entry = block.add_attdef(tag, text=entity.text)
            entry.is_invisible = True
            set_text(entry, entity, on)
            draw(document.modelspace(), entity, on, left)
        else:
            draw(block, entity, on)
    placed = document.modelspace().add_blockref(block.name, (left, 0.0), dxfattribs={"layer": "0"})
    for attribute in placed.add_auto_attribs(entries).attribs:
        attribute.is_invisible = True


def _add_dimension(
    space: Modelspace, text: Text, measured: Length | Angle, on: str, left: float, lettered: bool
) -> None:
    """Add a dimension; ``lettered`` tells whether it bears its text, or a blank."""
    told = _lettering(text, on, left) | ({} if lettered else {"text": " "})
    made = (
        _add_length(space, measured, left, told)
        if isinstance(measured, Length)
        else _add_angle(space, measured, left, told)
    )
    made.render()
    if not lettered:
        # Of a blank ezdxf tells no place, which its own reader asks for.
        made.dimension.dxf.text_midpoint = told["location"]


def _add_length(space: Modelspace, measured: Length, left: float, told: dict[str, Any]) -> DimStyleOverride:
    start, end, foot = (xy(point + left) for point in (measured.start, measured.end, measured.foot))
    slope = math.degrees(cmath.phase(measured.end - measured.start))
    if measured.of_radius:
        # Its text stands beside it.
        told = {name: value for name, value in told.items() if name not in ("location", "text_rotation")}
        return space.add_radius_dim(center=start, mpoint=end, radius=abs(measured.end - measured.start), **told)
    return space.add_linear_dim(foot, start, end, angle=slope, **told)


def _add_angle(space: Modelspace, measured: Angle, left: float, told: dict[str, Any]) -> DimStyleOverride:
    ways = measured.start, measured.end, (measured.start + measured.end) / 2
    first, last, between = (xy(measured.centre + cmath.rect(measured.radius, way) + left) for way in ways)
    centre = xy(measured.centre + left)
    # Between two lines: LibreCAD passes over the kind that has a centre and two points.  ezdxf draws the arc from the
    # second to the first.
    lines = (centre, last), (centre, first)
    return space.add_angular_dim_2l(between, *lines, **told)


def _lettering(text: Text, on: str, left: float) -> dict[str, Any]:
    """The attributes of a dimension: text, middle of the text, style and layer."""
    middle = xy(text.at + cmath.rect(text.height / 2, text.angle + math.pi / 2) + left)
    said = {"text": text.text, "location": middle, "text_rotation": math.degrees(text.angle)}
    return said | {"dimstyle": DIMENSION_STYLE, "override": {"dimtxt": text.height}, "dxfattribs": {"layer": on}}
