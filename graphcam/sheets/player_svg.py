"""A page as the inside of an SVG for the step player: small, and without a look; a style sheet gives that to the roles.

An element's classes say what it is: its kind (``line``, ``filled``, ``opaque``, ``text``) and its role.  Neighbours of
one kind and role make one path, of which every sub-path is one entity of the drawing.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable
from typing import cast
from xml.sax.saxutils import escape

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.sheets.fonts import points_size
from graphcam.sheets.model import ArcEntity, Circles, Curve, Entity, Group, Heads, Stroke, Strokes, Text
from graphcam.sheets.smooth import bezier
from graphcam.sheets.styles import STYLES, Style

MM_PER_POINT = 25.4 / 72
ANCHORS = {"left": "", "center": " middle", "right": " end"}


def group_svg(group: Group, height: float) -> str:
    """The elements of a group on a page of that height [mm]; 1 unit is 1 mm, y points down.

    >>> import numpy as np
    >>> print(group_svg(Group("step-01 a", (Strokes(np.array([0, 5j]), np.array([10, 10 + 5j]), "axis"),)), 297.0))
    <path class="line axis" d="M0 297L10 297M0 292L10 292"/>
    """
    return "".join(_run(kind, role, run, height) for kind, role, run in group.runs())


def roles_css() -> str:
    """The width, the line type and the ink in print of every role, as variables of its class."""
    # Roles of a drawing in progress have two words: the style sheet knows what is former and what current.
    return "\n".join(_role_css(role, style) for role, style in STYLES.items() if " " not in role)


def _role_css(role: str, style: Style) -> str:
    dashes = f"stroke-dasharray:{' '.join(f'{mm:g}' for mm in style.pattern)};" if style.pattern else ""
    return f".page .{role}{{--width:{style.width:g}px;--print:{style.colour};{dashes}}}"


def _run(kind: str, role: str, run: Iterable[Entity], height: float) -> str:
    if kind == "text":
        return "".join(_text(cast(Text, text), height) for text in run)
    paths = "".join(_path(entity, height) for entity in run)
    return f'<path class="{kind} {role}" d="{paths}"/>'


def _text(text: Text, height: float) -> str:
    x, y = _number(text.at.real), _number(height - text.at.imag)
    size = f"{points_size(text.height) * MM_PER_POINT:.3f}"
    turn = f' transform="rotate({-math.degrees(text.angle):.2f} {x} {y})"' if text.angle else ""
    classes = f"text{ANCHORS[text.align]}" + (f" {text.role}" if text.role != "text" else "")
    return f'<text class="{classes}" x="{x}" y="{y}" font-size="{size}"{turn}>{escape(text.text)}</text>'


def _path(entity: Entity, height: float) -> str:
    match entity:
        case Strokes(starts=starts, ends=ends):
            pairs = zip(_xy(starts, height), _xy(ends, height), strict=True)
            return "".join(f"M{start}L{end}" for start, end in pairs)
        case Stroke(points=points, closed=closed):
            return "M" + "L".join(_xy(points, height)) + "Z" * closed
        case Curve(points=points):
            start, *control = _xy(bezier(points), height)
            return f"M{start}C{' '.join(control)}Z"
        case Circles(centres=centres, radius=radius):
            # Two half turns: an arc of a whole turn is none in SVG.
            r, d = _number(radius), _number(2 * radius)
            starts = _xy(centres - radius, height)
            return "".join(f"M{start}a{r} {r} 0 1 1 {d} 0a{r} {r} 0 1 1 -{d} 0z" for start in starts)
        case ArcEntity():
            return _arc(entity, height)
        case Heads(corners=corners):
            return "".join("M" + "L".join(_xy(triangle, height)) + "Z" for triangle in corners)
        case Text():
            raise AssertionError("a text has no path")


def _arc(arc: ArcEntity, height: float) -> str:
    # In two halves, so that the angle that each turns is never in doubt.
    turns = arc.start, (arc.start + arc.end) / 2, arc.end
    points = np.array([arc.centre + cmath.rect(arc.radius, turn) for turn in turns])
    (start, middle, end), r = _xy(points, height), _number(arc.radius)
    return f"M{start}A{r} {r} 0 0 0 {middle}A{r} {r} 0 0 0 {end}"


def _xy(points: Points, height: float) -> list[str]:
    return [f"{_number(point.real)} {_number(height - point.imag)}" for point in points.tolist()]


def _number(mm: float) -> str:
    """A length to 0.01 mm, without idle digits."""
    return f"{mm:.2f}".rstrip("0").rstrip(".") if round(mm, 2) else "0"
