"""The tables about the sheet, which every task file has; checks of values, and values as plain data."""

import dataclasses
from dataclasses import dataclass, field, replace
from typing import Any, Literal, Self

from graphcam.errors import DesignError, choice_limit
from graphcam.given.motion_law import Law
from graphcam.language import ENGLISH, language, languages
from graphcam.tasks.number_limits import check_limits
from graphcam.tasks.units import InUnit
from graphcam.words import Tell, say

Format = Literal["A1", "A2", "A3", "A4"]
Frame = Literal["gost", "iso"]
Orientation = Literal["landscape", "portrait"]


DEFAULT_NAME = say("Cam mechanism")
"""The name of a task whose file gives none."""
BUILTIN_NAMES = {
    str(name): name
    for name in (
        DEFAULT_NAME,
        say("Cam with an oscillating arm"),
        say("Cam with a flat-faced follower"),
        say("Cam with an oscillating flat face"),
        say("Cam by a measured motion"),
        say("Cam of three circular arcs"),
    )
}
"""The names of the built-in tasks, which are translated."""


def check_choice(quantity: str, value: str, known: tuple[str, ...]) -> None:
    """Refuse a word that is not among the known ones."""
    if value not in known:
        raise DesignError(quantity, value, *choice_limit(value, known))


@dataclass(frozen=True)
class TitleTable:
    """``[title]``: what the title block says; every key may be left out, and the numbers of sheets are added.

    name : of the mechanism
    organisation : of the author
    author : who draws
    checked : who checks
    group : of students
    document : number of the drawing
    mass : of the cam, only as text
    scale : only as text; left out: on each sheet the scale of what is drawn on it: of the cam, or else of the largest
        other view that has a drawing scale; a sheet of diagrams, each with scales of its own, has none
    """

    name: str = str(DEFAULT_NAME)
    organisation: str = ""
    author: str = ""
    checked: str = ""
    group: str = ""
    document: str = ""
    mass: str = ""
    scale: str | None = None

    def __post_init__(self) -> None:
        for key in dataclasses.fields(self):
            if not ((text := getattr(self, key.name)) or "").isprintable():
                raise DesignError(key.name, text, say("printable text on one line"))

    def translated_name(self, tell: Tell) -> str:
        """The name in the file; that of a built-in task in the language of the sheet."""
        return tell(BUILTIN_NAMES.get(self.name, self.name))


@dataclass(frozen=True)
class SheetTable:
    """The part of ``[drawing]`` that is about the sheet.

    format : "A1", "A2", "A3" or "A4"
    frame : "gost" or "iso", whatever the language
    orientation : "landscape" or "portrait"; left out: landscape, but A4 in the frame "gost" stands
    language : of sheet, note and player: "en", "ru", "vi" or "zh"
    """

    format: Format = "A1"
    frame: Frame = "gost"
    orientation: Orientation | None = field(default=None, kw_only=True)
    language: str = ENGLISH.name

    def __post_init__(self) -> None:
        check_limits(self)
        check_choice("language", self.language, languages())

    def on(self, format_: Format) -> Self:
        """The table for another format."""
        return replace(self, format=format_)

    @property
    def tell(self) -> Tell:
        """Translates texts into the language of the sheet."""
        return language(self.language).text

    @property
    def remark(self) -> str:
        """The remark on the sheet about its translation; empty where there is none."""
        return language(self.language).remark


def plain_data(value: Any) -> Any:
    """A table as dictionaries, lists, numbers and texts; what is None is left out, a law is its name."""
    if type(value) in (float, int, str):
        return value
    if isinstance(value, tuple):
        return [plain_data(item) for item in value]  # pyright: ignore[reportUnknownVariableType]
    if isinstance(value, Law):
        return value.name
    if isinstance(value, InUnit):
        return float(value)
    if not dataclasses.is_dataclass(value):
        return value
    keys = [item.name for item in dataclasses.fields(value) if item.init]
    # The kind comes first, as one reads it in a file.
    keys.sort(key=lambda key: key != "kind")
    return {key: plain_data(part) for key in keys if (part := getattr(value, key)) is not None}
