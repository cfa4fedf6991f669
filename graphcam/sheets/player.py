"""The step player: one page of HTML that shows a drawing step by step, and lets a mechanism turn, without a network.

The page holds the sheets as SVG with one group for each step, the words and readings of the steps, and what turns; the
templates stand in ``data/player``.
"""

import base64
import cmath
import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import groupby
from typing import Any, cast
from xml.sax.saxutils import escape

import numpy as np

from graphcam.drafting.ink import Caption, say
from graphcam.drafting.marks import Points
from graphcam.sheets.box import Box, around_all
from graphcam.sheets.fonts import font_file, points_size
from graphcam.sheets.model import ArcEntity, Circles, Curve, Drawing, Entity, Group, Heads, Page, Stroke, Strokes, Text
from graphcam.sheets.sampling import box_of
from graphcam.sheets.smooth import bezier
from graphcam.sheets.styles import STYLES, Style

MM_PER_POINT = 25.4 / 72
ANCHORS = {"left": "", "center": " middle", "right": " end"}
WORDS: Mapping[str, Caption] = {
    "construction": say("Construction"),
    "mechanism": say("Mechanism"),
    "contents": say("Contents"),
    "readings": say("Readings"),
    "drawing": say("The drawing"),
    "steps": say("Steps"),
    "step": say("Step"),
    "first": say("First step"),
    "previous": say("Previous step"),
    "next": say("Next step"),
    "last": say("Last step"),
    "chapter_back": say("Previous construction"),
    "chapter_on": say("Next construction"),
    "closer": say("Closer"),
    "farther": say("Farther away"),
    "whole": say("Whole sheet"),
    "follow": say("Follow the step"),
    "sheet": say("Sheet"),
    "print": say("Print the sheet"),
    "theme": say("Light or dark"),
    "keyboard": say("Keys: ← → steps, Page Up and Page Down constructions, Home and End, + − 0 zoom, M mechanism"),
    "all_values": say("All values"),
    "place": say("station"),
    "paper": say("on paper"),
    "value": say("value"),
    "play": say("Turn"),
    "pause": say("Stop"),
    "angle": say("Cam angle φ"),
    "speed": say("Turns a minute"),
    "pressure_angle": say("Pressure angle α"),
    "displacement": say("Displacement s"),
    "velocity": say("Velocity v"),
    "normal": say("normal"),
    "motion": say("motion"),
    "noscript": say("Without JavaScript the finished sheet is shown."),
}
"""What the page itself says."""
IDLE = re.compile(r"\.00|(?<=\.\d)0")
"""The idle digits of a number with two decimals."""
MARGIN = 8.0
"""Around what a step shows when it is looked at closely [mm]."""


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
            return _numbers("M%.2f %.2fL%.2f %.2f" * len(starts), np.column_stack([starts, ends]), height)
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
        case Heads(corners=corners):
            return _numbers("M%.2f %.2fL%.2f %.2fL%.2f %.2fZ" * len(corners), corners, height)
        case Text():
            raise AssertionError("a text has no path")


def _arc(arc: ArcEntity, height: float) -> str:
    # In two halves, so that the angle that each turns is never in doubt.
    turns = arc.start, (arc.start + arc.end) / 2, arc.end
    points = np.array([arc.centre + cmath.rect(arc.radius, turn) for turn in turns])
    r = _number(arc.radius)
    return _numbers(f"M%.2f %.2fA{r} {r} 0 0 0 %.2f %.2fA{r} {r} 0 0 0 %.2f %.2f", points, height)


def _numbers(template: str, points: Points, height: float) -> str:
    """A template with the coordinates of points: lengths to 0.01 mm, y down, without idle digits."""
    flat = np.ravel(points)
    written = template % tuple(np.column_stack([flat.real, height - flat.imag]).ravel().tolist())
    return _without_idle(written)


def _number(mm: float) -> str:
    """A length to 0.01 mm, without idle digits."""
    return _without_idle(f"{mm:.2f}")


def _without_idle(numbers: str) -> str:
    """Numbers of two decimals without the digits and signs that say nothing."""
    return IDLE.sub("", numbers.replace("-0.00", "0.00"))


@dataclass(frozen=True)
class ReadingText:
    """A reading as it is shown: how it came about, and the value; of many values a table (place, on paper, value)."""

    title: str
    taken: str
    value: str
    table: tuple[tuple[str, str, str], ...] = ()


@dataclass(frozen=True)
class Slide:
    """What is said of a step; ``chapter`` is the title of its construction, ``view`` the name of its drawing.

    why : what is said of the construction before its first step
    """

    chapter: str
    view: str
    title: str
    caption: str
    readings: tuple[ReadingText, ...] = ()
    why: str = ""


def player(
    drawing: Drawing,
    slides: Sequence[Slide],
    mechanism: Mapping[str, Any] | None,
    words: Mapping[str, str],
    language: str,
) -> str:
    """The page.

    slides : one for each step of the drawing, in order
    mechanism : what turns, see ``data/player/mechanism.js``; None for a drawing that nothing turns in
    words : what the page itself says, by the names of :data:`WORDS`
    """
    from jinja2 import Environment, PackageLoader, StrictUndefined
    from markupsafe import Markup

    loader = PackageLoader("graphcam", "data/player")
    environment = Environment(autoescape=True, loader=loader, undefined=StrictUndefined)
    environment.trim_blocks = environment.lstrip_blocks = True

    def whole(name: str) -> Markup:
        return Markup(loader.get_source(environment, name)[0])

    data = {"steps": _places(drawing, slides), "mechanism": mechanism, "words": dict(words)}
    entities = (entity for page in drawing.pages for group in page.groups for entity in group.entities)
    lettering = (entity.text for entity in entities if isinstance(entity, Text))
    said = [drawing.title, *words.values(), *(text for slide in slides for text in _texts(slide))]
    return environment.get_template("page.html").render(
        title=drawing.title,
        language=language,
        words=words,
        pages=[_page(page) for page in drawing.pages],
        slides=slides,
        chapters=[(name, [k for k, _ in run]) for name, run in groupby(enumerate(slides), key=lambda s: s[1].chapter)],
        style=whole("player.css") + Markup(roles_css()),
        scripts=[whole("player.js"), *([whole("mechanism.js")] if mechanism else [])],
        mechanism=mechanism,
        font=_font([*said, *lettering]),
        # No text of a drawing may end the script that holds it.
        data=Markup(json.dumps(data, ensure_ascii=False, allow_nan=False).replace("<", "\\u003c")),
    )


def _page(page: Page) -> dict[str, Any]:
    from markupsafe import Markup

    groups = [
        (group.key, group.key.startswith("step-"), view, Markup(group_svg(group, page.height)))
        for whole in page.groups
        for view, group in _by_view(whole)
    ]
    return {"width": f"{page.width:g}", "height": f"{page.height:g}", "groups": groups}


def _by_view(group: Group) -> list[tuple[str, Group]]:
    """The titles of several views as a group each, so that each can appear with its view; other groups as they are."""
    titles: dict[str, list[Entity]] = {}
    for text in group.entities:
        if isinstance(text, Text) and text.view:
            titles.setdefault(text.view, []).append(text)
    return [(view, Group(f"{group.key}-{view}", tuple(own))) for view, own in titles.items()] or [("", group)]


def _places(drawing: Drawing, slides: Sequence[Slide]) -> list[dict[str, Any]]:
    """For each step its group, its page, and the box of its view there: x, y from the upper left corner, size [mm]."""
    views = {f"step-{k:02d}": slide.view for k, slide in enumerate(slides, 1)}
    found: list[dict[str, Any]] = []
    for key, view in views.items():
        number, page = next((n, p) for n, p in enumerate(drawing.pages) if any(group.key == key for group in p.groups))
        boxes = [box_of(group.entities) for group in page.groups if views.get(group.key) == view]
        box = around_all([box for box in boxes if box] or [Box(0, 0, page.width, page.height)]).grown(MARGIN)
        left, top = max(0.0, box.left), max(0.0, page.height - box.top)
        width, height = min(page.width, box.right) - left, min(page.height, page.height - box.bottom) - top
        around = [round(x, 1) for x in (left, top, width, height)]
        found.append({"group": key, "page": number, "view": view, "box": around})
    return found


def _texts(slide: Slide) -> Iterable[str]:
    yield from (slide.chapter, slide.why, slide.title, slide.caption)
    for reading in slide.readings:
        yield from (reading.title, reading.taken, reading.value)


def _font(texts: Iterable[str]) -> str:
    """The typeface by which the sheet was lettered, with the characters of these texts alone: base64 of a WOFF."""
    from fontTools import subset

    # Widths were measured without kerning and ligatures.
    options = subset.Options(flavor="woff", layout_features=[], recalc_timestamp=False, notdef_outline=True)
    # The dates of the editor that it was drawn with.
    options.drop_tables += ["FFTM"]
    subsetter, written = subset.Subsetter(options), BytesIO()
    subsetter.populate(text="".join(sorted(set("".join(texts)))))
    with subset.load_font(str(font_file()), options) as font:
        subsetter.subset(font)
        subset.save_font(font, written, options)
    return base64.b64encode(written.getvalue()).decode("ascii")
