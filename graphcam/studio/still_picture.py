"""A view of the studio as a picture that stands still: for pages behind which no engine runs."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from graphcam.sheets.player_svg import roles_css
from graphcam.sheets.typefaces import FAMILY, font_faces
from graphcam.studio.views_answer import views_answer

PX_PER_MM = 1.2
"""How large it is shown at least: two of them side by side on a page; it settles how large the letters are."""
FIRST = "combined", "profile"
"""The view that is shown if none is named; where there is none of these, the first."""
INKS = f"""
.line, .opaque {{ fill: none; stroke: var(--print); stroke-width: var(--width); stroke-linejoin: round }}
.page .opaque {{ fill: #fff }}
.filled, .text {{ fill: var(--print, #000); font-family: {FAMILY} }}
.middle {{ text-anchor: middle }}
.end {{ text-anchor: end }}
"""
"""Everything in print, as on a sheet."""


@dataclass(frozen=True)
class StillPicture:
    """A view of a task, all of its steps drawn.

    svg : the picture, with its letters
    title : of the view
    caption : what the last of its steps says
    """

    svg: str
    title: str
    caption: str


def still_picture(task: Mapping[str, Any], view: str | None = None, language: str = "en") -> StillPicture:
    """The picture of a view.

    task : as plain data
    view : its name; by default the region, or the profile

    Raises
    ------
    GraphcamError : the task has no cam, or no such view

    >>> import graphcam as gc
    >>> picture = still_picture(gc.builtin_task().to_dict(), "profile")
    >>> picture.title, picture.svg.startswith("<svg")
    ('Cam profile, 2:1', True)
    """
    asked = {"task": task, "language": language, "told": True}
    if view is None:
        names = [each["name"] for each in views_answer({**asked, "told": False})["names"]]
        view = next((name for name in FIRST if name in names), names[0])
    (drawn,) = views_answer({**asked, "views": [{"name": view, "px_per_mm": PX_PER_MM}]})["views"]
    steps = [drawn["steps"][name] for name in drawn["order"]]
    lines = "".join(step["svg"] for step in steps)
    frame = " ".join(f"{number:g}" for number in drawn["frame"])
    letters = font_faces(re.findall(r">([^<]+)<", lines))
    svg = (
        f'<svg xmlns="http://www.w3.org/2000/svg" class="page" viewBox="{frame}">'
        f"<style>{letters}{roles_css()}{INKS}</style>{lines}</svg>"
    )
    return StillPicture(svg, drawn["title"], steps[-1]["caption"])
