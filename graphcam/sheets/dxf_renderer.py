"""DXF for real CAD programs, by ezdxf: R2010, the whole sheet in model space, 1 unit = 1 mm of paper.

The profile of entities is narrow on purpose, because every program reads it: LINE, LWPOLYLINE, CIRCLE, ARC, SOLID, TEXT
and one clamped non-rational SPLINE for the cam; a layer for every step and role.
"""

import cmath
import math
import os
import re
from collections.abc import Callable, Generator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import ezdxf
import numpy as np
from ezdxf import options, units
from ezdxf.document import Drawing as Document
from ezdxf.entities import Text as DXFText
from ezdxf.enums import TextEntityAlignment
from ezdxf.layouts import BaseLayout
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.sheets.model import (
    ArcEntity,
    Circles,
    Curve,
    Drawing,
    Entity,
    Group,
    Page,
    Polygons,
    Stroke,
    Strokes,
    Text,
)
from graphcam.sheets.smooth_curves import clamped_spline
from graphcam.sheets.styles import ACCENT, CENTER, CYAN_TINT, DASHED, GREY, GREY_TINT, STYLES_BY_ROLE
from graphcam.sheets.text_measures import letters_of, start_of
from graphcam.sheets.typefaces import is_chinese

PAGE_GAP = 40.0
"""The gap between pages side by side [mm]."""
TEXT_STYLE = "lc_opengost-br"
"""The name of the text style, by which LibreCAD chooses the font: this one has Cyrillic, Greek and primes."""
CHINESE_TEXT_STYLE = "unicode"
"""The text style of LibreCAD's font with Chinese; other programs are told of FangSong, as GB/T 14691 has it."""
LINETYPES: dict[tuple[float, ...], tuple[str, str]] = {
    CENTER: ("CENTER", "Center ____ _ ____ _"),
    DASHED: ("DASHED", "Dashed __ __ __"),
}
POINT_STYLE, POINT_SIZE = 34, 3.0
"""The display of a POINT as a cross in a circle, and its size [mm]."""
COLOUR_NUMBERS = {GREY: 8, ACCENT: 1, CYAN_TINT: 4, GREY_TINT: 9}
"""Numbers of the AutoCAD palette; 7 is black on paper and white on a screen."""
DrawGroup = Callable[[Document, Group, str, float], None]
"""Draws a group in a document; takes the prefix of its layers' names, and its shift to the right [mm]."""


def write_dxf(
    drawing: Drawing, path: str | os.PathLike[str], origins: Mapping[str, str] | None = None, layers: Sequence[str] = ()
) -> None:
    """Write all pages of a drawing, side by side in the model space of one file.

    origins : names of views by that of the layer on which a POINT marks the view's origin
    layers : names of additional empty layers
    """
    with repeatable():
        document = sheet_document(drawing)
        draw_pages(document, drawing, draw_group)
        for name in layers:
            document.layers.add(name)
        _mark_origins(document, drawing, origins or {})
        save(document, path)


def _mark_origins(document: Document, drawing: Drawing, origins: Mapping[str, str]) -> None:
    for name, view in origins.items():
        for left, page in side_by_side(drawing):
            if view in page.origins:
                document.layers.add(name, color=COLOUR_NUMBERS[ACCENT])
                document.modelspace().add_point(xy(page.origins[view] + left), dxfattribs={"layer": name})
                document.header["$PDMODE"], document.header["$PDSIZE"] = POINT_STYLE, POINT_SIZE


def write_spline(
    control: NDArray[np.floating[Any]],
    knots: NDArray[np.floating[Any]],
    path: str | os.PathLike[str],
    layer: str,
    told: Mapping[str, str],
) -> None:
    """Write one clamped B-spline into a file, 1 unit = 1 mm.

    control : (m, 2) [mm];  knots : (m + p + 1,) of one of the degree p
    told : properties of the drawing, which CAD programs show beside it
    """
    with repeatable():
        document = _empty_document()
        low, high = control.min(axis=0).tolist(), control.max(axis=0).tolist()
        _set_extents(document, (*low, 0.0), (*high, 0.0))
        for name, value in told.items():
            document.header.custom_vars.append(name, value)
        document.layers.add(layer)
        _add_spline(document.modelspace(), control.tolist(), knots.tolist(), {"layer": layer})
        middle = (low[0] + high[0]) / 2, (low[1] + high[1]) / 2
        document.set_modelspace_vport(height=1.1 * (high[1] - low[1]), center=middle)
        save(document, path)


@contextmanager
def repeatable() -> Generator[None]:
    """Suppress dates and random identifiers, so that the same drawing makes the same file."""
    former = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = former


def save(document: Document, path: str | os.PathLike[str]) -> None:
    """Write a document with its classes sorted: ezdxf itself takes them from a set, in the order of their hashes."""
    for name in sorted(document.entitydb.dxf_types_in_use()):
        document.classes.add_class(name)
    document.saveas(path)


def _empty_document() -> Document:
    document = ezdxf.new("R2010", setup=False)
    document.units = units.MM
    document.header["$MEASUREMENT"] = 1
    return document


def sheet_document(drawing: Drawing) -> Document:
    """An empty document with the size, line types and letters of a drawing."""
    document = _empty_document()
    document.header["$LTSCALE"] = 1.0
    document.header["$LWDISPLAY"] = 1
    # The style of dimension texts, which LibreCAD takes for their font too.
    document.header["$DIMTXSTY"] = TEXT_STYLE
    # LibreCAD prints an empty page where this is 0.
    document.header["$PSVPSCALE"] = 1.0
    first = drawing.pages[0]
    total = sum(page.width for page in drawing.pages) + PAGE_GAP * (len(drawing.pages) - 1)
    _set_extents(document, (0.0, 0.0, 0.0), (total, first.height, 0.0))
    document.modelspace().reset_limits((0.0, 0.0), (total, first.height))
    document.paperspace().page_setup(size=(first.width, first.height), margins=(0, 0, 0, 0), units="mm")
    for pattern, (name, description) in LINETYPES.items():
        signed = [mm if k % 2 == 0 else -mm for k, mm in enumerate(pattern)]
        document.linetypes.add(name, [sum(pattern), *signed], description=description)
    document.styles.add(TEXT_STYLE, font="osifont.ttf")
    if any(is_chinese(letter) for text in drawing.texts for letter in text.text):
        document.styles.add(CHINESE_TEXT_STYLE, font="simfang.ttf")
    document.set_modelspace_vport(height=first.height, center=(total / 2, first.height / 2))
    return document


def draw_pages(document: Document, drawing: Drawing, draw_group: DrawGroup) -> None:
    """Draw every group of every page, the pages side by side."""
    for number, (left, page) in enumerate(side_by_side(drawing), 1):
        for group in page.groups:
            prefix = f"p{number}-" if len(drawing.pages) > 1 else ""
            draw_group(document, group, prefix, left)


def side_by_side(drawing: Drawing) -> Generator[tuple[float, Page]]:
    """The pages, each with its shift to the right [mm]."""
    left = 0.0
    for page in drawing.pages:
        yield left, page
        left += page.width + PAGE_GAP


def _set_extents(document: Document, low: tuple[float, float, float], high: tuple[float, float, float]) -> None:
    """Set the extents of the drawing.  ezdxf puts those of the model space into the header, if not the origin."""
    document.modelspace().reset_extents(low, high)
    document.header["$EXTMIN"], document.header["$EXTMAX"] = low, high


def draw_group(document: Document, group: Group, prefix: str, left: float) -> None:
    """Draw every entity of a group on the layer of its role, moved ``left`` mm to the right."""
    for entity in group.entities:
        draw(document.modelspace(), entity, layer(document, group, prefix, entity.role), left)


def layer(document: Document, group: Group, prefix: str, role: str) -> str:
    """The name of the layer of a group and role, which is added if need be."""
    # A name of a layer may hold letters, digits, hyphens and underscores in every program.
    name = prefix + re.sub(r"[^\w-]+", "-", f"{group.name}-{role}")
    if name not in document.layers:
        style = STYLES_BY_ROLE[role]
        colour, linetype = COLOUR_NUMBERS.get(style.colour, 7), LINETYPES.get(style.pattern, ("CONTINUOUS",))[0]
        document.layers.add(name, color=colour, linetype=linetype, lineweight=round(100 * style.width))
    return name


def draw(space: BaseLayout, entity: Entity, layer: str, left: float = 0.0) -> None:
    """Draw one entity as entities of DXF, moved ``left`` mm to the right."""
    on = {"layer": layer}
    match entity:
        case Strokes(starts=starts, ends=ends):
            for start, end in zip(_xy(starts, left), _xy(ends, left), strict=True):
                space.add_line(start, end, dxfattribs=on)
        case Stroke(points=points, closed=closed):
            space.add_lwpolyline(_xy(points, left), close=closed, dxfattribs=on)
        case Curve(points=points):
            control, knots = clamped_spline(points)
            _add_spline(space, _xy(control, left), knots, on)
        case Circles(centres=centres, radius=radius):
            for centre in _xy(centres, left):
                space.add_circle(centre, radius, dxfattribs=on)
        case ArcEntity(centre=centre, radius=radius, start=start, end=end):
            space.add_arc(xy(centre + left), radius, math.degrees(start), math.degrees(end), dxfattribs=on)
        case Polygons(corners=corners):
            # The third and the fourth corner of a SOLID lie crosswise.
            order = [0, 1, 3, 2] if corners.shape[1] == 4 else [0, 1, 2]
            for polygon in corners[:, order]:
                space.add_solid(_xy(polygon, left), dxfattribs=on)
        case Text():
            _add_text(space, entity, layer, left)


def _add_text(space: BaseLayout, text: Text, layer: str, left: float) -> None:
    """Add a text in pieces, each fitted between the places where it begins and ends in our font.

    In a program with another font its letters could otherwise overlap others.  A single letter is not fitted.
    """
    begin, turn = start_of(text), cmath.rect(1.0, text.angle)
    for piece in letters_of(text.text, text.height):
        letters, *ends = piece.ink
        made = space.add_text(letters)
        _set_style(made, layer, piece.height, text.angle)
        if is_chinese(letters[0]):
            made.dxf.style = CHINESE_TEXT_STYLE
        start, end = (text.at + (begin + end) * turn + left for end in ends)
        if len(letters) > 1:
            made.set_placement(xy(start), xy(end), align=TextEntityAlignment.FIT)
        else:
            # A letter that is but an upright line cannot be widened: LibreCAD would not draw it.
            made.set_placement(xy((start + end) / 2), align=TextEntityAlignment.CENTER)


def set_text(made: DXFText, text: Text, layer: str, left: float = 0.0) -> None:
    """Set layer, letters and place of a text of the document."""
    _set_style(made, layer, text.height, text.angle)
    made.set_placement(xy(text.at + left), align=TextEntityAlignment[text.align.upper()])


def _set_style(made: DXFText, layer: str, height: float, angle: float) -> None:
    made.dxf.update({"layer": layer, "style": TEXT_STYLE, "height": height, "rotation": math.degrees(angle)})


def _add_spline(
    space: BaseLayout, control: Sequence[Sequence[float]], knots: Sequence[float], on: dict[str, str]
) -> None:
    spline = space.add_spline(degree=len(knots) - len(control) - 1, dxfattribs=on)
    spline.control_points, spline.knots = control, knots
    # Neither closed nor rational nor planar: flags that some programs misread.
    spline.dxf.flags = 0


def xy(point: complex) -> tuple[float, float]:
    """The coordinates (x, y) of a point."""
    return point.real, point.imag


def _xy(points: Points, left: float) -> list[tuple[float, float]]:
    return [xy(point + left) for point in points.tolist()]
