"""A page as an SVG file of its own: its size in mm, a group for each group of the page, and its letters inside.

The elements are those of the step player.  Their looks are attributes, which every drawing program reads; style sheets
are not read by all.
"""

import os
from pathlib import Path

from graphcam.sheets.model import Page, Text
from graphcam.sheets.player_svg import group_svg
from graphcam.sheets.styles import STYLES_BY_ROLE
from graphcam.sheets.typefaces import ALPHABET, FALLBACK_FAMILY, FONT_FAMILY, font_faces

TEXT_ANCHORS = {"left": "", "center": ' text-anchor="middle"', "right": ' text-anchor="end"'}


def write_svg(page: Page, path: str | os.PathLike[str]) -> None:
    """Write one page as an SVG file, see :func:`svg`."""
    Path(path).write_text(svg(page), encoding="utf-8", newline="\n")


def svg(page: Page, alphabet: str = ALPHABET) -> str:
    """The text of a page as SVG: its size in mm, a ``<g id="step-03">`` for each group, texts with their letters.

    alphabet : letters that the file carries beside those of its texts

    >>> from graphcam.sheets.model import Box
    >>> print(svg(Page(210.0, 297.0, Box(20, 5, 205, 292), ())).splitlines()[1][40:90])
    width="210mm" height="297mm" viewBox="0 0 210 297"
    """
    size = f'width="{page.width:g}mm" height="{page.height:g}mm" viewBox="0 0 {page.width:g} {page.height:g}"'
    looks = f'stroke-linejoin="round" font-family="{FONT_FAMILY}, {FALLBACK_FAMILY}"'
    texts = (e.text for group in page.groups for e in group.entities if isinstance(e, Text))
    drawn = (f'<g id="{group.key}">{group_svg(group, page.height, look=_look)}</g>' for group in page.groups)
    return "\n".join(
        [
            '<?xml version="1.0" encoding="utf-8"?>',
            f'<svg xmlns="http://www.w3.org/2000/svg" {size} {looks}>',
            f"<style>{font_faces(texts, alphabet)}</style>",
            '<rect width="100%" height="100%" fill="#ffffff"/>',
            *drawn,
            "</svg>\n",
        ]
    )


def _look(kind: str, role: str, align: str) -> str:
    """The attributes of an element: ink, width and line type of its role."""
    style = STYLES_BY_ROLE[role]
    if kind == "text":
        return f'fill="{style.colour}"{TEXT_ANCHORS[align]}'
    if kind == "filled":
        return f'fill="{style.colour}"'
    dashes = f' stroke-dasharray="{" ".join(f"{mm:g}" for mm in style.pattern)}"' if style.pattern else ""
    inside = "#ffffff" if kind == "opaque" else "none"
    return f'fill="{inside}" stroke="{style.colour}" stroke-width="{style.width:g}"' + dashes * (kind == "line")
