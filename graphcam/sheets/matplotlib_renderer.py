"""PDF, SVG and PNG, true to scale, by matplotlib.

The figure is the page; nothing is fitted or cropped.  Every group of the drawing is drawn by one artist, which opens a
group of the renderer (a ``<g>`` of the SVG) and joins all lines of one role into one path.
"""

from __future__ import annotations

import cmath
import math
import os
import re
from collections.abc import Sequence
from functools import cache
from io import StringIO
from pathlib import Path as File
from typing import IO, TYPE_CHECKING, Any, cast

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from graphcam.drafting.marks import Points
from graphcam.sheets.fonts import FAMILY, points_size, width
from graphcam.sheets.model import ArcEntity, Circles, Curve, Drawing, Entity, Group, Heads, Page, Stroke, Strokes, Text
from graphcam.sheets.smooth import bezier
from graphcam.sheets.styles import STYLES

if TYPE_CHECKING:
    from matplotlib.backend_bases import RendererBase

INCH = 25.4
POINT = 72 / INCH
"""Points to a millimetre."""
PAPER = (1.0, 1.0, 1.0, 1.0)

_SETTINGS: dict[Any, Any] = {
    "pdf.fonttype": 42,
    "svg.fonttype": "none",
    "svg.hashsalt": "graphcam",
    "path.simplify": False,
    "font.family": FAMILY,
}


def write_pdf(drawing: Drawing, path: str | os.PathLike[str]) -> None:
    """All pages of a drawing in one PDF, 1 mm of the drawing 1 mm of paper."""
    about = {"Title": drawing.title, "Creator": "graphcam", "CreationDate": None}
    with mpl.rc_context(_SETTINGS), PdfPages(path, metadata=about) as pdf:
        for page in drawing.pages:
            pdf.savefig(_figure(page))


def write_svg(page: Page, path: str | os.PathLike[str]) -> None:
    """One page as an SVG file, see :func:`svg`."""
    File(path).write_text(svg(page), encoding="utf-8")


def svg(page: Page) -> str:
    """One page as SVG: its size in mm, a ``<g id="step-03">`` for each group, texts as texts."""
    text = StringIO()
    with mpl.rc_context(_SETTINGS):
        _figure(page).savefig(text, format="svg", metadata={"Date": None, "Creator": "graphcam"})
    # matplotlib gives the size in points.
    size = f'width="{page.width:g}mm" height="{page.height:g}mm"'
    return re.sub(r'width="[\d.]+pt" height="[\d.]+pt"', size, text.getvalue(), count=1)


def write_png(page: Page, path: str | os.PathLike[str] | IO[bytes], dpi: float = 100) -> None:
    """One page as a picture of ``dpi`` dots an inch, into a file by its name or open for writing."""
    with mpl.rc_context(_SETTINGS):
        # Lines on white: a harder compression takes longer and saves nothing.
        quick, about = {"compress_level": 1}, {"Software": "graphcam"}
        _figure(page).savefig(path, format="png", dpi=dpi, metadata=about, pil_kwargs=quick)


def _figure(page: Page) -> Figure:
    figure = Figure(figsize=(page.width / INCH, page.height / INCH))
    for group in page.groups:
        figure.add_artist(_GroupArtist(group), clip=False)
    return figure


class _GroupArtist(Artist):
    """Draws the entities of one group, in their order."""

    def __init__(self, group: Group) -> None:
        super().__init__()
        self.group = group

    def draw(self, renderer: RendererBase) -> None:
        """Draw into the group of the renderer that bears the group's key."""
        figure = self.get_figure(root=True)
        assert figure is not None
        to_device = Affine2D().scale(1 / INCH) + figure.dpi_scale_trans
        renderer.open_group("group", gid=self.group.key)
        for kind, role, run in self.group.runs():
            if kind == "text":
                for text in run:
                    _draw_text(renderer, cast(Text, text), to_device)
            else:
                _draw_path(renderer, run, kind, role, to_device)
        renderer.close_group("group")


def _draw_path(renderer: RendererBase, entities: Sequence[Entity], kind: str, role: str, to_device: Any) -> None:
    style = STYLES[role]
    context = renderer.new_gc()
    context.set_foreground(style.colour)
    context.set_joinstyle("miter" if kind == "filled" else "round")
    context.set_capstyle("butt")
    context.set_snap(False)
    context.set_linewidth(0.0 if kind == "filled" else style.width * POINT)
    if style.pattern and kind == "line":
        context.set_dashes(0.0, [POINT * mm for mm in style.pattern])
    fill = {"filled": to_rgba(style.colour), "opaque": PAPER}.get(kind)
    path = Path.make_compound_path(*(_path(entity) for entity in entities))
    path.should_simplify = False
    renderer.draw_path(context, path, to_device, fill)
    context.restore()


def _draw_text(renderer: RendererBase, text: Text, to_device: Any) -> None:
    context = renderer.new_gc()
    context.set_foreground(STYLES[text.role].colour)
    context.set_linewidth(STYLES[text.role].width * POINT)
    # The renderers place the left end of the base line.
    shift = {"left": 0.0, "center": 0.5, "right": 1.0}[text.align] * width(text.text, text.height)
    start = text.at - cmath.rect(shift, text.angle)
    x, y = to_device.transform((start.real, start.imag))
    if renderer.flipy():
        y = renderer.get_canvas_width_height()[1] - y
    renderer.draw_text(context, x, y, text.text, _font(text.height), math.degrees(text.angle), ismath=False)
    context.restore()


@cache
def _font(height: float) -> FontProperties:
    return FontProperties(family=FAMILY, size=points_size(height))


def _path(entity: Entity) -> Path:
    match entity:
        case Strokes(starts=starts, ends=ends):
            return Path(_xy(np.column_stack([starts, ends]).ravel()), [Path.MOVETO, Path.LINETO] * len(starts))
        case Stroke(points=points, closed=closed):
            return Path(_xy(np.append(points, points[:1]) if closed else points), closed=closed)
        case Curve(points=points):
            control = bezier(points)
            return Path(_xy(control), [Path.MOVETO] + [Path.CURVE4] * (len(control) - 1))
        case Circles(centres=centres, radius=radius):
            return Path.make_compound_path(*(Path.circle((c.real, c.imag), radius) for c in centres.tolist()))
        case ArcEntity(centre=centre, radius=radius, start=start, end=end):
            arc = Path.arc(math.degrees(start), math.degrees(end))
            return Path(np.asarray(arc.vertices) * radius + (centre.real, centre.imag), arc.codes)
        case Heads(corners=corners):
            closed = np.column_stack([corners, corners[:, :1]]).ravel()
            return Path(_xy(closed), [Path.MOVETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY] * len(corners))
        case Text():
            raise AssertionError("a text has no path")


def _xy(points: Points) -> Any:
    return np.column_stack([points.real, points.imag])
