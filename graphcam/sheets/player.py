"""The step player: one page of HTML, without a network, that shows a drawing step by step and a turning mechanism.

The page holds the sheets as SVG with one group for each step, the words and readings of the steps, and what turns; the
templates stand in ``data/player``.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from itertools import groupby
from typing import TYPE_CHECKING, Any

from graphcam.drafting.act_data import WrittenActs
from graphcam.drafting.ink import Caption, say
from graphcam.language import language as language_of
from graphcam.sheets.model import (
    Box,
    Drawing,
    Entity,
    Group,
    Page,
    Source,
    Text,
    bounding_box,
)
from graphcam.sheets.player_svg import group_svg, roles_css
from graphcam.sheets.sampling import box_of
from graphcam.sheets.typefaces import font_faces
from graphcam.subscripts import in_html

if TYPE_CHECKING:
    from jinja2 import Template
    from markupsafe import Markup

PAGE_CAPTIONS: Mapping[str, Caption] = {
    "construction": say("Construction"),
    "mechanism": say("Mechanism"),
    "contents": say("Contents"),
    "readings": say("Readings"),
    "drawing": say("The drawing"),
    "looking": say("Zoom"),
    "said": say("What to do"),
    "live": say("The mechanism at this angle"),
    "steps": say("Steps"),
    "step": say("Step"),
    "step_of": say("step {step} of {steps}", step="{step}", steps="{steps}"),
    "part_of": say("part {part} of {parts}", part="{part}", parts="{parts}"),
    "part_by_part": say("Part by part"),
    "whole_step": say("Whole step"),
    "why": say("Why"),
    "previous": say("Back"),
    "next": say("Next"),
    "whole_back": say("Previous whole step"),
    "whole_on": say("Next whole step"),
    "run": say("Play the steps"),
    "halt": say("Stop playing"),
    "pace": say("Speed"),
    "protocol": say("Construction protocol"),
    "print_protocol": say("Print the protocol"),
    "close": say("Close"),
    "no": say("No."),
    "name": say("Name"),
    "done": say("Caption"),
    "shown": say("Shown"),
    "closer": say("Zoom in"),
    "farther": say("Zoom out"),
    "whole": say("Whole sheet"),
    "follow": say("Follow the step"),
    "sheet": say("Sheet"),
    "print": say("Print the sheet"),
    "theme": say("Light or dark"),
    "keyboard": say(
        "Keys: ← → parts, with Shift whole steps; Page Up and Page Down constructions; Space plays; P protocol; "
        "+ − 0 zoom; M mechanism"
    ),
    "all_values": say("All values"),
    "place": say("where"),
    "paper": say("on paper"),
    "value": say("value"),
    "play": say("Turn"),
    "pause": say("Stop"),
    "angle": say("Cam angle φ"),
    "speed": say("Revolutions per minute"),
    "pressure_angle": say("Pressure angle α"),
    "displacement": say("Displacement s"),
    "velocity": say("Velocity v"),
    "normal": say("normal"),
    "motion": say("motion"),
    "noscript": say("JavaScript is off: only the finished sheet is shown."),
}
"""The captions of the page itself, by name."""

WIDE_PATTERN = re.compile(r"[\u3000-\u9fff\uff00-\uffef]")
"""A letter of Chinese, which is as wide as two others."""
INDENT_PATTERN = re.compile(r"\n\s+(?=<)")
"""The invisible space before an element that begins a line of the template."""
IDLE_PATTERN = re.compile(r'(?P<text>"(?:[^"\\]|\\.)*")|(?<=\d)\.0(?=[,\]}])')
"""Texts, which stay as they are, and the needless ".0" of whole numbers."""
SCRIPT_FILES = ("gestures.js", "camera.js", "board.js", "lights.js", "player.js")
"""The scripts of the steps; later ones use the functions of earlier ones."""
STEP_MARGIN = 8.0
"""The margin around a step in the close view [mm]."""


Pieces = list[list[Any]]
"""Places of acts as the page knows them: [number of the act, [its places] or None for all of them]."""


@dataclass(frozen=True)
class RowText:
    """One value of a reading of many, for the page; ``lit`` are the pieces from which it is read."""

    place: str
    paper: str
    value: str
    lit: Pieces = field(default_factory=Pieces)


@dataclass(frozen=True)
class ReadingText:
    """A reading for the page: its derivation, and the value; of many values a table.

    lit : the pieces of the drawing from which it is read
    name : of the reading in its construction
    """

    title: str
    taken: str
    value: str
    table: tuple[RowText, ...] = ()
    lit: Pieces = field(default_factory=Pieces)
    name: str = ""


@dataclass(frozen=True)
class PartText:
    """A part of a step for the page.

    caption : the instruction; empty in a step without parts
    tools : the instruments, with their settings
    draws, lit : the pieces that it draws, and those from which these are found
    moves : all its acts in order, also invisible ones
    views : names of the views that show what is drawn or lit, that of the step first
    """

    caption: str
    tools: tuple[str, ...]
    draws: Pieces
    lit: Pieces
    moves: Pieces
    views: tuple[str, ...]


@dataclass(frozen=True)
class RunText:
    """A run of like parts for the page: one instruction, with a table of its places.

    first : the place of its first part among all parts
    head : the common beginning of the names of its places, such as "Station"
    rows : of every place the rest of its name, and its setting, if that is not everywhere the same
    tools : the instruments that every place needs
    """

    caption: str
    first: int
    head: str
    rows: tuple[tuple[str, str], ...]
    tools: tuple[str, ...]

    @property
    def widest(self) -> int:
        """The number of letters of its longest row."""
        return max(len(WIDE_PATTERN.sub("xx", name + setting)) for name, setting in self.rows)

    @property
    def settings(self) -> bool:
        """Whether any of its places has a setting."""
        return any(setting for _, setting in self.rows)


@dataclass(frozen=True)
class Slide:
    """The texts of a step; ``chapter`` is the title of its construction, ``view`` the name of its drawing.

    caption : the instruction, if it has no parts
    why : the reason of the construction, before its first step
    number : of the step within the task, such as "3.2";  reason : for the step
    parts : at least one;  runs : runs of like parts
    reads : the numbers of the acts by which something is read, by the reading's name
    finds : the views whose scales are known from this step on, with the text in their titles
    """

    chapter: str
    view: str
    title: str
    caption: str
    readings: tuple[ReadingText, ...] = ()
    why: str = ""
    number: str = ""
    reason: str = ""
    parts: tuple[PartText, ...] = ()
    runs: tuple[RunText, ...] = ()
    reads: Mapping[str, int] = field(default_factory=dict[str, int])
    finds: Mapping[str, str] = field(default_factory=dict[str, str])

    @property
    def listed(self) -> list[tuple[int, PartText | None, RunText | None]]:
        """The parts and runs in order: the place of a part with the part, or of a run's first part with the run."""
        runs = {run.first: run for run in self.runs}
        inside = {run.first + k for run in self.runs for k in range(len(run.rows))}
        every = enumerate(self.parts if len(self.parts) > 1 else ())
        return [(k, None if k in runs else part, runs.get(k)) for k, part in every if k in runs or k not in inside]


@dataclass(frozen=True)
class Acts:
    """The acts of a drawing as plain data, from which it can be drawn again.

    record : of all acts
    numbers : numbers of the acts that the drawing shows
    in_parts : numbers of the acts that are drawn part by part
    """

    record: WrittenActs = field(default_factory=WrittenActs)
    numbers: Mapping[Any, int] = field(default_factory=dict[Any, int])
    in_parts: Set[int] = frozenset()

    def shown_by(self, source: Source) -> tuple[int | None, bool]:
        """The number of the act that an entity shows, and whether it is drawn in parts."""
        number = self.numbers.get(source.of)
        return number, number in self.in_parts


NO_ACTS = Acts()


def player(
    drawing: Drawing,
    slides: Sequence[Slide],
    mechanism: Mapping[str, Any] | None,
    words: Mapping[str, str],
    language: str,
    acts: Acts = NO_ACTS,
) -> str:
    """The player's page of HTML.

    slides : one for each step of the drawing, in order
    acts : the acts of the drawing, with the numbers that the slides' parts use
    mechanism : data of ``data/player/mechanism.js``; None without a mechanism
    words : the texts of the page itself, by the names of :data:`PAGE_CAPTIONS`
    """
    from markupsafe import Markup

    def whole(name: str) -> Markup:
        """The text of a file of the page."""
        return Markup((files("graphcam") / "data" / "player" / name).read_text(encoding="utf-8"))

    steps, views = _places(drawing, slides)
    finds = {view: (said, k) for k, slide in enumerate(slides) for view, said in slide.finds.items()}
    data = {"steps": steps, "views": views, "acts": acts.record.rows, "mechanism": mechanism, "words": dict(words)}
    lettering = (text.text for text in drawing.texts)
    remark = language_of(language).remark
    said = [drawing.title, remark, *words.values(), *(text for slide in slides for text in _texts(slide))]
    page = _template().render(
        title=drawing.title,
        language=language,
        remark=remark,
        words=words,
        pages=[_page(page, acts, finds) for page in drawing.pages],
        slides=slides,
        chapters=[(name, [k for k, _ in run]) for name, run in groupby(enumerate(slides), key=lambda s: s[1].chapter)],
        style=whole("player.css") + Markup(roles_css()),
        scripts=[whole(name) for name in (*SCRIPT_FILES, *(("mechanism.js", "turning.js") if mechanism else ()))],
        mechanism=mechanism,
        fonts=Markup(font_faces([*said, *lettering])),
        data=Markup(_json(data)),
    )
    return INDENT_PATTERN.sub("\n", page)


@cache
def _template() -> Template:
    from jinja2 import Environment, PackageLoader, StrictUndefined

    loader = PackageLoader("graphcam", "data/player")
    environment = Environment(autoescape=True, loader=loader, undefined=StrictUndefined)
    environment.filters["indexed"] = _indexed
    environment.filters["json"] = _json
    environment.trim_blocks = environment.lstrip_blocks = True
    return environment.get_template("page.html")


def _json(data: object) -> str:
    """Plain data as JSON without needless spaces and digits; no text in it can end the script that holds it.

    >>> print(_json({"a": [1.0, -20.5, 30.0], "b": "[1.0]</script>"}))
    {"a":[1,-20.5,30],"b":"[1.0]\\u003c/script>"}
    """
    written = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return IDLE_PATTERN.sub(lambda found: found["text"] or "", written).replace("<", "\\u003c")


def _indexed(text: str) -> Markup:
    from markupsafe import Markup, escape

    return Markup(in_html(str(escape(text))))


Finds = Mapping[str, tuple[str, int]]
"""The text in its title, and the step that finds it, for every view whose scale is found by drawing."""


def _page(page: Page, acts: Acts, finds: Finds) -> dict[str, Any]:
    from markupsafe import Markup

    groups = [
        (group.key, group.key.startswith("step-"), view, since, Markup(group_svg(group, page.height, acts.shown_by)))
        for whole in page.groups
        for view, since, group in _by_view(whole, finds)
    ]
    return {"width": f"{page.width:g}", "height": f"{page.height:g}", "groups": groups}


def _by_view(group: Group, finds: Finds) -> list[tuple[str, int | None, Group]]:
    """The groups, titles of several views as a group each, so that each can appear with its view.

    A scale in a title that is found by drawing is a group of its own, with the step that finds it.
    """
    titles: dict[tuple[str, int | None], list[Entity]] = {}
    for text in group.entities:
        if isinstance(text, Text) and text.view:
            said, since = finds.get(text.view, ("", None))
            titles.setdefault((text.view, since if said and said in text.text else None), []).append(text)
    named = {key: f"{group.key}-{key[0]}" + ("" if key[1] is None else "-scale") for key in titles}
    return [(*key, Group(named[key], tuple(own))) for key, own in titles.items()] or [("", None, group)]


def _places(drawing: Drawing, slides: Sequence[Slide]) -> tuple[list[dict[str, Any]], dict[str, dict[str, Any]]]:
    """The group, the parts and the box of each step; for each view its page and the box there.

    A box is x, y from the upper left corner, width and height [mm].
    """
    views = {f"step-{k:02d}": slide.view for k, slide in enumerate(slides, 1)}
    found: list[dict[str, Any]] = []
    stand: dict[str, dict[str, Any]] = {}
    for slide, (key, view) in zip(slides, views.items(), strict=True):
        number, page = next((n, p) for n, p in enumerate(drawing.pages) if any(group.key == key for group in p.groups))
        if view not in stand or stand[view]["page"] != number:
            box = _box_of_view(page, view, {key for key, own in views.items() if own == view})
            stand[view] = {"page": number, "box": box}
        parts = [
            {"draws": part.draws, "lit": part.lit, "moves": part.moves, "views": part.views} for part in slide.parts
        ]
        said = {"number": slide.number, "reads": dict(slide.reads), "parts": parts}
        found.append({"group": key, "view": view, **stand[view], **said})
    return found, stand


def _box_of_view(page: Page, view: str, keys: Set[str]) -> list[float]:
    """The box about the drawing of the steps with those keys, and about the title of their view."""
    shown = [
        box_of(e for e in group.entities if group.key in keys or (isinstance(e, Text) and e.view == view))
        for group in page.groups
    ]
    box = bounding_box([box for box in shown if box] or [Box(0, 0, page.width, page.height)]).grown(STEP_MARGIN)
    left, top = max(0.0, box.left), max(0.0, page.height - box.top)
    width, height = min(page.width, box.right) - left, min(page.height, page.height - box.bottom) - top
    return [round(x, 1) for x in (left, top, width, height)]


def _texts(slide: Slide) -> Iterable[str]:
    yield from (slide.chapter, slide.why, slide.number, slide.title, slide.caption, slide.reason)
    for part in slide.parts:
        yield from (part.caption, *part.tools)
    yield from (run.caption for run in slide.runs)
    for reading in slide.readings:
        yield from (reading.title, reading.taken, reading.value)
