"""PDF and PNG true to scale, by matplotlib.

The figure is the page; nothing is fitted or cropped.  Every group of the drawing is drawn by one artist, which joins
all lines of one role into one path.

PNG is written here (ISO/IEC 15948).  A sheet is mostly white, so its rows are compressed as they are.  Imaging
libraries try five filters on each row first, which takes as long as drawing the sheet, and saves a twentieth of the
file.
"""

import cmath
import math
import os
import struct
import zlib
from collections.abc import Iterator, Sequence
from functools import cache, lru_cache
from pathlib import Path as File
from typing import IO, Any, cast

import matplotlib as mpl
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backend_bases import GraphicsContextBase, RendererBase
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.textpath import TextPath
from matplotlib.transforms import Affine2D, Transform
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
from graphcam.sheets.smooth_curves import bezier
from graphcam.sheets.styles import STYLES_BY_ROLE
from graphcam.sheets.text_measures import Letters, letters_of, points_size, start_of
from graphcam.sheets.typefaces import FALLBACK_FAMILY, FONT_FAMILY, cubic

MM_PER_INCH = 25.4
POINTS_PER_MM = 72 / MM_PER_INCH
PAPER_COLOUR = (1.0, 1.0, 1.0, 1.0)
_RC_SETTINGS: dict[Any, Any] = {
    "pdf.fonttype": 42,
    "path.simplify": False,
    # Letters keep their measures, and are drawn sooner, where they are not fitted to the dots.
    "text.hinting": "none",
}


def write_pdf(drawing: Drawing, path: str | os.PathLike[str] | IO[bytes]) -> None:
    """Write all pages of a drawing into one PDF, 1 mm of the drawing 1 mm of paper."""
    about = {"Title": drawing.title, "Creator": "graphcam", "CreationDate": None}
    with mpl.rc_context(_RC_SETTINGS), PdfPages(path, metadata=about) as pdf:
        for page in drawing.pages:
            pdf.savefig(_figure(page, embeds_cubic=False))


def write_png(page: Page, path: str | os.PathLike[str] | IO[bytes], dpi: float = 100) -> None:
    """Write one page as a picture of ``dpi`` dots an inch, into a file by its name or open for writing."""
    with mpl.rc_context(_RC_SETTINGS):
        figure = _figure(page)
        figure.dpi = dpi
        canvas = FigureCanvasAgg(figure)
        canvas.draw()
    png = png_of(np.asarray(canvas.buffer_rgba()), dpi)
    if isinstance(path, str | os.PathLike):
        File(path).write_bytes(png)
    else:
        path.write(png)


def draw_on(axes: Axes, page: Page, origin: complex = 0j, factor: float = 1.0, colour: str | None = None) -> None:
    """Draw a page on axes of equal scales; letters and lines grow and shrink with them, as those of a print do.

    origin : where the axes' origin lies on the page [mm]
    factor : millimetres of the page to one unit of the axes
    colour : of all lines and letters, in place of their own
    """
    to_axes = Affine2D().translate(-origin.real, -origin.imag).scale(1 / factor)
    for group in page.groups:
        axes.add_artist(_GroupArtist(group, to_axes + axes.transData, colour=colour))
    (left, bottom), (right, top) = to_axes.transform([(0.0, 0.0), (page.width, page.height)]).tolist()
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal")


def _figure(page: Page, *, embeds_cubic: bool = True) -> Figure:
    """The page as a figure; ``embeds_cubic`` tells whether the kind of file can embed typefaces of every kind."""
    figure = Figure(figsize=(page.width / MM_PER_INCH, page.height / MM_PER_INCH))
    for group in page.groups:
        to_device = Affine2D().scale(1 / MM_PER_INCH) + figure.dpi_scale_trans
        figure.add_artist(_GroupArtist(group, to_device, embeds_cubic=embeds_cubic), clip=False)
    return figure


class _GroupArtist(Artist):
    """An artist that draws the entities of one group, in their order.

    to_device : the transform from mm of the page
    embeds_cubic : whether letters of cubic outlines are drawn as text
    colour : in place of those of the roles
    """

    def __init__(
        self, group: Group, to_device: Transform, *, embeds_cubic: bool = True, colour: str | None = None
    ) -> None:
        super().__init__()
        self.group, self.to_device, self.embeds_cubic, self.colour = group, to_device, embeds_cubic, colour
        self.set_in_layout(False)

    def draw(self, renderer: RendererBase) -> None:
        """Draw the lines and texts of the group."""
        for kind, role, run in _path_runs(self.group):
            if isinstance(run, Path):
                self._draw_path(renderer, run, kind, role)
            else:
                self._draw_texts(renderer, run, role)

    @property
    def _times(self) -> float:
        """The length of a millimetre of the page on the figure [mm]."""
        figure = self.get_figure(root=True)
        if self.axes is None or figure is None:
            return 1.0
        origin, unit = self.to_device.transform([(0.0, 0.0), (1.0, 0.0)])
        return math.hypot(*(unit - origin)) * MM_PER_INCH / figure.dpi

    def _context(self, renderer: RendererBase, colour: str, width: float) -> GraphicsContextBase:
        """The graphics context for lines of a width [mm of the page]."""
        context = renderer.new_gc()
        context.set_foreground(colour)
        context.set_linewidth(self._times * width * POINTS_PER_MM)
        if self.axes is not None:
            context.set_clip_rectangle(self.axes.bbox)
        return context

    def _draw_path(self, renderer: RendererBase, path: Path, kind: str, role: str) -> None:
        style, colour = STYLES_BY_ROLE[role], self.colour or STYLES_BY_ROLE[role].colour
        context = self._context(renderer, colour, 0.0 if kind == "filled" else style.width)
        context.set_joinstyle("miter" if kind == "filled" else "round")
        context.set_capstyle("butt")
        context.set_snap(False)
        if style.pattern and kind == "line":
            context.set_dashes(0.0, [self._times * POINTS_PER_MM * mm for mm in style.pattern])
        fill = {"filled": to_rgba(colour), "opaque": PAPER_COLOUR}.get(kind)
        renderer.draw_path(context, path, self.to_device, fill)
        context.restore()

    def _draw_texts(self, renderer: RendererBase, texts: Sequence[Text], role: str) -> None:
        context = self._context(renderer, self.colour or STYLES_BY_ROLE[role].colour, STYLES_BY_ROLE[role].width)
        set_pieces = [(piece, at, text.angle) for text in texts for piece, at in _set_pieces(text)]
        places = self.to_device.transform(_xy(np.array([at for _, at, _ in set_pieces])))
        if renderer.flipy():
            places[:, 1] = renderer.get_canvas_width_height()[1] - places[:, 1]
        times = self._times
        for (piece, _, angle), (x, y) in zip(set_pieces, places.tolist(), strict=True):
            font = _font(piece.face, times * piece.height)
            if not self.embeds_cubic and cubic(piece.face):
                _draw_outlines(renderer, context, piece, font, Affine2D().rotate(angle).translate(x, y))
            else:
                renderer.draw_text(context, x, y, piece.text, font, math.degrees(angle), ismath=False)
        context.restore()


def _set_pieces(text: Text) -> Iterator[tuple[Letters, complex]]:
    """The pieces of a text, each with the left end of its base line."""
    begin, turn = start_of(text), cmath.rect(1.0, text.angle)
    for piece in letters_of(text.text, text.height):
        yield piece, text.at + (begin + piece.start) * turn


def _draw_outlines(
    renderer: RendererBase, context: GraphicsContextBase, piece: Letters, font: FontProperties, place: Affine2D
) -> None:
    """Draw letters as filled outlines, for fonts that matplotlib would embed in a PDF as the wrong type."""
    context.set_linewidth(0.0)
    letters = TextPath((0, 0), piece.text, prop=font)
    renderer.draw_path(context, letters, place, context.get_rgb())


@cache
def _font(face: File, height: float) -> FontProperties:
    # A drawing names the family; that it is drawn by the face itself asks for no search among the machine's.
    return FontProperties(family=[FONT_FAMILY, FALLBACK_FAMILY], fname=str(face), size=points_size(height))


# PDF and PNG of a page are drawn one after another from the same paths.
@lru_cache(maxsize=256)
def _path_runs(group: Group) -> list[tuple[str, str, Path | list[Text]]]:
    """The runs of a group: kind, role, and one path for all lines of a run, or its texts."""
    found: list[tuple[str, str, Path | list[Text]]] = []
    for kind, role, run in group.runs():
        if kind == "text":
            found.append((kind, role, cast(list[Text], run)))
        else:
            path = Path.make_compound_path(*map(_path, run))
            path.should_simplify = False
            found.append((kind, role, path))
    return found


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
        case Polygons(corners=corners):
            closed = np.column_stack([corners, corners[:, :1]]).ravel()
            sides = [Path.LINETO] * (corners.shape[1] - 1)
            return Path(_xy(closed), [Path.MOVETO, *sides, Path.CLOSEPOLY] * len(corners))
        case Text():
            raise AssertionError("a text has no path")


def _xy(points: Points) -> Any:
    return np.column_stack([points.real, points.imag])


PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
METRES_AN_INCH = 0.0254
"""The length of an inch [m]."""
COMPRESSION_LEVEL = 1
"""The level of compression; lines on white get hardly smaller by a higher one."""


def png_of(pixels: NDArray[np.uint8], dpi: float) -> bytes:
    """The bytes of a PNG file of pixels (rows, columns, 4), red, green, blue and opacity, with ``dpi`` dots an inch.

    >>> white = png_of(np.full((2, 3, 4), 255, dtype=np.uint8), 100.0)
    >>> white[:4], int.from_bytes(white[16:20]), int.from_bytes(white[20:24])
    (b'\\x89PNG', 3, 2)
    """
    height, width, _ = pixels.shape
    # 8 bits a channel, four channels; no filter, no interlacing.
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    a_metre = round(dpi / METRES_AN_INCH)
    rows = np.zeros((height, 1 + 4 * width), dtype=np.uint8)
    rows[:, 1:] = pixels.reshape(height, -1)
    chunks = (
        (b"IHDR", header),
        (b"tEXt", b"Software\0graphcam"),
        (b"pHYs", struct.pack(">IIB", a_metre, a_metre, 1)),
        (b"IDAT", zlib.compress(rows.data, COMPRESSION_LEVEL)),
        (b"IEND", b""),
    )
    return PNG_SIGNATURE + b"".join(_chunk(name, data) for name, data in chunks)


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(data, zlib.crc32(name)))
