"""How a command tells which files it wrote: each a link where the terminal knows links, and what to open first."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from graphcam.cli.voice import tell
from graphcam.words import Caption, say, say_many

if TYPE_CHECKING:
    from rich.text import Text

ABOUT: Mapping[str, Caption] = {
    "player": say("step by step in a browser, and the mechanism turning"),
    "sheet": say("the sheet, true to scale"),
    "worksheet": say("the sheet to be finished, true to scale"),
    "note": say("the calculation with formulas and numbers"),
    "comparison": say("drawn values beside exact ones"),
    "profile": say("the exact working profile, for CAD and machines"),
    "working-drawing": say("the cam as a part"),
    "solution": say("all of it, for programs"),
}
"""What the files of a solution are, by their names without page number and ending; in the order they are told."""
FIRST: Mapping[str, Caption] = {
    "player.html": say("in a browser"),
    "sheet.pdf": say("print at 100 %"),
    "worksheet.pdf": say("print at 100 %"),
}
"""What to open first, and how."""


def about(name: str) -> str:
    """Of which kind a file is, by its name.

    >>> about("sheet-12.svg"), about("working-drawing.pdf"), about("mine.txt")
    ('sheet', 'working-drawing', '')
    """
    stem = Path(name).stem
    first, dash, number = stem.rpartition("-")
    stem = first if dash and number.isdecimal() else stem
    return stem if stem in ABOUT else ""


def grouped(names: Iterable[str]) -> list[tuple[Caption | str, list[str]]]:
    """The files of each kind and what they are, in the order of ``ABOUT``; pages by their numbers.

    >>> for what, names in grouped(["solution.json", "sheet-10.svg", "sheet-2.svg", "sheet.svg"]):
    ...     print(what, names)
    the sheet, true to scale ['sheet.svg', 'sheet-2.svg', 'sheet-10.svg']
    all of it, for programs ['solution.json']
    """
    kinds: dict[str, list[str]] = {kind: [] for kind in (*ABOUT, "")}
    for name in sorted(names, key=lambda name: (Path(name).suffix, len(name), name)):
        kinds[about(name)].append(name)
    return [(ABOUT.get(kind, ""), found) for kind, found in kinds.items() if found]


def tell_files(folder: Path, names: Sequence[str]) -> None:
    """Print all files that were written into a folder, by kind, and which to open first."""
    # A terminal's abilities are rich's business.
    from rich.console import Console
    from rich.text import Text

    console = Console(highlight=False, markup=False, emoji=False, soft_wrap=True)
    count = tell(say_many("{count} file", "{count} files", len(names)))
    console.print(Text.assemble("\n", linked(folder, str(folder)), f": {count}"))
    for what, found in grouped(names):
        links = Text(", ").join(linked(folder / name, name) for name in found)
        console.print(Text.assemble("  ", links, f": {tell(what)}" if what else ""))
    first = [
        Text.assemble(linked(folder / name, str(folder / name)), f" ({tell(how)})")
        for name, how in FIRST.items()
        if name in names
    ]
    if first:
        begin, then = tell(say("Open first: ")), tell(say(", then "))
        console.print(Text.assemble(begin, Text(then).join(first)))


def tell_file(path: Path, what: Caption) -> None:
    """Print that a file was written, and what it is."""
    from rich.console import Console

    console = Console(highlight=False, markup=False, emoji=False, soft_wrap=True)
    console.print(linked(path, str(path)) + f": {tell(what)}")


def linked(path: Path, words: str) -> Text:
    """Words that open a file or folder when they are clicked; plain ones where nobody could."""
    from rich.style import Style
    from rich.text import Text

    return Text(words, Style(link=path.resolve().as_uri()))
