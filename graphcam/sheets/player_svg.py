"""Groups of a drawing as elements of SVG in the step player's page, each with the act that it shows and its place."""

import cmath
import math
import re
from collections.abc import Callable, Iterable, Iterator
from html import escape
from itertools import groupby
from typing import cast

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.sheets.model import (
    ArcEntity,
    Circles,
    Curve,
    Entity,
    Group,
    Polygons,
    Source,
    Stroke,
    Strokes,
    Text,
    by_place,
    kind_of,
)
from graphcam.sheets.smooth_curves import bezier
from graphcam.sheets.styles import STYLES_BY_ROLE, Style
from graphcam.sheets.text_measures import letters_of, points_size

MM_PER_POINT = 25.4 / 72
ANCHOR_CLASSES = {"left": "", "center": " middle", "right": " end"}
IDLE_DIGITS_PATTERN = re.compile(r"\.00|(?<=\.\d)0")
"""The needless digits of a number with two decimals."""
UPRIGHT_PATTERN = re.compile(r"M([-\d.]+) ([-\d.]+)L\1 ([-\d.]+)(?=M|$)")
LEVEL_PATTERN = re.compile(r"M([-\d.]+) ([-\d.]+)L([-\d.]+) \2(?=M|$)")
"""A single horizontal stroke, of which one number tells where it ends."""


Numbers = Callable[[Source], tuple[int | None, bool]]
"""The number of the act that an entity shows (None without one), and whether it is drawn in parts."""


def _unnumbered(_: Source) -> tuple[None, bool]:
    return None, False


Look = Callable[[str, str, str], str]
"""The attributes for the looks of an element, by its kind, its role and the alignment of its text."""


def _classes(kind: str, role: str, align: str) -> str:
    """The classes that the page's style sheet knows."""
    shown = kind + ANCHOR_CLASSES[align] + (f" {role}" if role != kind else "")
    return f'class="{shown}"'


def group_svg(group: Group, height: float, numbers: Numbers = _unnumbered, look: Look = _classes) -> str:
    """The elements of a group as SVG on a page of ``height`` mm; 1 unit is 1 mm, y points down.

    numbers : which act an entity shows; look : how it looks, by default as classes of a style sheet

    >>> import numpy as np
    >>> print(group_svg(Group("step-01 a", (Strokes(np.array([0, 5j]), np.array([10, 10 + 5j]), "axis"),)), 297.0))
    <path class="line axis" d="M0 297H10M0 292H10"/>
    """
    pieces = ((place, entity) for whole in group.entities for place, entity in _in_pieces(whole, numbers))
    runs = groupby(pieces, key=lambda piece: (piece[0], kind_of(piece[1]), piece[1].role))
    return "".join(_run(kind, role, where, [e for _, e in run], height, look) for (where, kind, role), run in runs)


def _in_pieces(entity: Entity, numbers: Numbers) -> Iterator[tuple[str, Entity]]:
    """An entity, or its pieces by the places of its act, each with the attributes for act and place."""
    number, in_parts = numbers(entity.source) if entity.source else (None, False)
    if number is None:
        yield "", entity
        return
    for place, piece in by_place(entity) if in_parts else [(None, entity)]:
        yield f' data-act="{number}"' + ("" if place is None else f' data-at="{place}"'), piece


def roles_css() -> str:
    """The CSS variables of every role's class: width, line type and ink in print."""
    # Roles of a drawing in progress have two words: the style sheet knows what is former and what current.
    return "\n".join(_role_css(role, style) for role, style in STYLES_BY_ROLE.items() if " " not in role)


def _role_css(role: str, style: Style) -> str:
    dashes = f"stroke-dasharray:{' '.join(f'{mm:g}' for mm in style.pattern)};" if style.pattern else ""
    return f".page .{role}{{--width:{style.width:g}px;--print:{style.colour};{dashes}}}"


def _run(kind: str, role: str, where: str, run: Iterable[Entity], height: float, look: Look) -> str:
    if kind == "text":
        return "".join(_text(cast(Text, text), where, height, look) for text in run)
    paths = "".join(_path(entity, height) for entity in run)
    return f'<path {look(kind, role, "left")}{where} d="{paths}"/>'


def _text(text: Text, where: str, height: float, look: Look) -> str:
    x, y = _number(text.at.real), _number(height - text.at.imag)
    size = _size(text.height)
    turn = f' transform="rotate({-math.degrees(text.angle):.2f} {x} {y})"' if text.angle else ""
    shown = look("text", text.role, text.align)
    return f'<text {shown}{where} x="{x}" y="{y}" font-size="{size}"{turn}>{_letters(text)}</text>'


def _letters(text: Text) -> str:
    written, lowered = "", 0.0
    for piece in letters_of(text.text, text.height):
        drop = -piece.start.imag
        size = f' font-size="{_size(piece.height)}"' if piece.index else ""
        shift = f' dy="{_number(drop - lowered)}"' if drop != lowered else ""
        letters = escape(piece.text, quote=False)
        written, lowered = written + (f"<tspan{size}{shift}>{letters}</tspan>" if size or shift else letters), drop
    return written


def _size(height: float) -> str:
    return f"{points_size(height) * MM_PER_POINT:.3f}"


def _path(entity: Entity, height: float) -> str:
    match entity:
        case Strokes(starts=starts, ends=ends):
            strokes = _numbers("M%.2f %.2fL%.2f %.2f" * len(starts), np.column_stack([starts, ends]), height)
            return LEVEL_PATTERN.sub(r"M\1 \2H\3", UPRIGHT_PATTERN.sub(r"M\1 \2V\3", strokes))
        case Stroke(points=points, closed=closed):
            return _numbers("M" + "L".join(["%.2f %.2f"] * len(points)) + "Z" * closed, points, height)
        case Curve(points=points):
            control = bezier(points)
            return _numbers("M%.2f %.2fC" + " ".join(["%.2f %.2f"] * (len(control) - 1)) + "Z", control, height)
        case Circles(centres=centres, radius=radius):
            # Two half turns: an arc of a whole turn is none in SVG.
            r, d = _number(radius), _number(2 * radius)
            turns = f"a{r} {r} 0 1 1 {d} 0a{r} {r} 0 1 1 -{d} 0z"
            return _numbers(f"M%.2f %.2f{turns}" * len(centres), centres - radius, height)
        case ArcEntity():
            return _arc(entity, height)
        case Polygons(corners=corners):
            sides = "L%.2f %.2f" * (corners.shape[1] - 1)
            return _numbers(f"M%.2f %.2f{sides}Z" * len(corners), corners, height)
        case Text():
            raise AssertionError("a text has no path")


def _arc(arc: ArcEntity, height: float) -> str:
    # In two halves, so that the angle that each turns is never in doubt.
    turns = arc.start, (arc.start + arc.end) / 2, arc.end
    points = np.array([arc.centre + cmath.rect(arc.radius, turn) for turn in turns])
    r = _number(arc.radius)
    return _numbers(f"M%.2f %.2fA{r} {r} 0 0 0 %.2f %.2fA{r} {r} 0 0 0 %.2f %.2f", points, height)


def _numbers(template: str, points: Points, height: float) -> str:
    """A template with the coordinates of points filled in, to 0.01 mm, y down, without needless digits."""
    flat = np.ravel(points)
    written = template % tuple(np.column_stack([flat.real, height - flat.imag]).ravel().tolist())
    return _without_idle(written)


def _number(mm: float) -> str:
    """The text of a length to 0.01 mm, without needless digits."""
    return _without_idle(f"{mm:.2f}")


def _without_idle(numbers: str) -> str:
    return IDLE_DIGITS_PATTERN.sub("", numbers.replace("-0.00", "0.00"))
