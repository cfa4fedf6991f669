"""A picture of a notebook: a drawing with its caption and the words for those who cannot see it."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from graphcam.sheets.model import Page

SHEET_DPI = 65
"""Dots an inch at which a sheet of A1 is as sharp as a screen is wide."""
SHADES = 16


@dataclass(frozen=True)
class Picture:
    """An image.

    image : the file, an SVG as text or a PNG
    alt : what is seen on it, in words
    caption : the line below it; may be empty

    >>> print(Picture("<svg/>", "a blank sheet", "Nothing").html)
    <figure><img src="data:image/svg+xml;base64,PHN2Zy8+" alt="a blank sheet"><figcaption>Nothing</figcaption></figure>
    """

    image: str | bytes
    alt: str
    caption: str = ""

    @property
    def html(self) -> str:
        """The picture as a figure of a web page, with nothing to be fetched."""
        kind, data = ("svg+xml", self.image.encode()) if isinstance(self.image, str) else ("png", self.image)
        below = f"<figcaption>{escape(self.caption)}</figcaption>" if self.caption else ""
        source = f"data:image/{kind};base64,{base64.b64encode(data).decode()}"
        return f'<figure><img src="{source}" alt="{escape(self.alt)}">{below}</figure>'

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/html": self.html, "text/plain": self.alt}


def picture_of_page(page: Page, alt: str, caption: str = "") -> Picture:
    """The picture of a page of a sheet; a PNG, which is smaller than an SVG of so many lines."""
    from PIL import Image

    from graphcam.sheets.matplotlib_renderer import write_png

    drawn, image = BytesIO(), BytesIO()
    write_png(page, drawn, SHEET_DPI)
    # A drawing has few inks: so many shades are enough for their edges, and make a third of the file.
    Image.open(drawn).convert("RGB").quantize(SHADES).save(image, "png", optimize=True)
    return Picture(image.getvalue(), alt, caption)


def chart(across: str, up: str, height: float = 3.0) -> tuple[Figure, Axes]:
    """An empty matplotlib figure and its axes, for what is plotted rather than drawn.

    across, up : what the axes say
    height : of the figure [inches], which is 7 wide

    >>> chart("φ, °", "s, mm")[1].get_xlabel()
    'φ, °'
    """
    from matplotlib.figure import Figure

    figure = Figure((7.0, height))
    axes = figure.subplots()
    axes.set_xlabel(across)
    axes.set_ylabel(up)
    axes.grid(visible=True, color="#dddddd", linewidth=0.5)
    axes.spines[["top", "right"]].set_visible(False)
    return figure, axes


def picture_of(figure: Figure, alt: str, caption: str = "") -> Picture:
    """The picture of a matplotlib figure: for charts, which are no constructions.

    >>> from matplotlib.figure import Figure
    >>> picture_of(Figure((1, 1)), "an empty chart").image.startswith("<?xml")
    True
    """
    from graphcam.plots.figures import figure_svg

    return Picture(figure_svg(figure), alt, caption)
