"""What the commands share: how they end on wrong input, read tasks, and print tables, progress and files."""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
import sys
import textwrap
import time
import warnings
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

import graphcam
from graphcam.cli.command_language import language_in, translated, voice
from graphcam.cli.usage_errors import INPUT_ERROR_STATUS
from graphcam.errors import DesignError, GraphcamError, LetteringWarning, TaskError
from graphcam.words import Caption, Words, say, say_many

if TYPE_CHECKING:
    from rich.text import Text

    from graphcam.tasks.arcs_task import ArcsTask
    from graphcam.tasks.task import Task

REFRESH_INTERVAL = 0.1
"""The minimum time between two updates of a progress bar [s]."""
NUMBER_PATTERN = re.compile(r"[-−]?\d+\.\d+(e[-+]?\d+)?[*%]?")
"""A decimal number in a table, perhaps a percentage."""
DEFAULT_FOLDER = Path("graphcam-out")
"""The folder for output where none is named."""


def nonempty_place(place: str) -> str:
    """The place, if it is not empty: an empty one would be taken for the current folder."""
    if not place:
        raise typer.BadParameter(translated(say("the name of a file or folder ('.' is the current one)")))
    return place


def nonempty_path(path: str | Path) -> Path:
    """The path, if it is not empty."""
    return Path(nonempty_place(str(path)))


path_option, path_argument = (partial(kind, parser=nonempty_path) for kind in (typer.Option, typer.Argument))
"""An option and an argument that is a path, as typer has them."""


def quoted(path: Path) -> str:
    """A path as it is typed on a command line of this system.

    >>> quoted(Path("cam.toml"))
    'cam.toml'
    """
    return subprocess.list2cmdline([str(path)]) if sys.platform == "win32" else shlex.quote(str(path))


def echo(words: Words, *, err: bool = False) -> None:
    """Print a text in the language of the command that is run."""
    typer.echo(translated(words), err=err)


def echo_line(words: Words) -> None:
    """Print a text as a single line, since a name may hold line breaks or characters that control a terminal."""
    line = translated(words)
    typer.echo(line if line.isprintable() else ascii(line))


TaskFile = Annotated[
    Path | None, path_argument(metavar="TASK.toml", help="Task file; the default is the built-in coursework task.")
]


@contextmanager
def input_errors() -> Generator[None]:
    """Let wrong input end the command with one message and status 2."""
    try:
        yield
    except GraphcamError as error:
        typer.echo(f"graphcam: {translated(error)}", err=True)
        raise typer.Exit(INPUT_ERROR_STATUS) from None
    except OSError as error:
        # Without the number that the system gives it.
        said = error.args[0] if error.args and isinstance(error.args[0], Caption) else str(error)
        told = f"{error.filename}: {error.strerror}" if error.filename and error.strerror else said
        typer.echo(f"graphcam: {translated(told)}", err=True)
        raise typer.Exit(INPUT_ERROR_STATUS) from None


@contextmanager
def short_warnings() -> Generator[None]:
    """Print a warning about characters that no font has on one line."""
    with warnings.catch_warnings(action="always", category=LetteringWarning):
        otherwise = warnings.showwarning

        def told(message: Warning | str, category: type[Warning], *where: Any) -> None:
            """Print a lettering warning on one line; other warnings are shown as before."""
            if issubclass(category, LetteringWarning):
                echo(say("warning: {message}", message=message), err=True)
            else:
                otherwise(message, category, *where)

        warnings.showwarning = told
        yield


def progress_lines(*, quiet: bool) -> Callable[[Words], None]:
    """A printer of progress on standard error; with ``quiet`` it prints only where that is a terminal."""
    silent = quiet and not sys.stderr.isatty()
    return lambda line: None if silent else typer.echo(f"{translated(line)} ...", err=True)


def print_table(
    columns: Sequence[Words], rows: Iterable[Sequence[str]], words: int = 1, *, title: Words = "", caption: Words = ""
) -> None:
    """Print a table: the first ``words`` columns are words, the others numbers, which are aligned to the right."""
    width = shutil.get_terminal_size().columns
    head = [translated(column) for column in columns]
    said = [[*row[:words], *map(_number, row[words:])] for row in rows]
    lines = [translated(title), *table_lines([head, *said], words, width), translated(caption)]
    typer.echo("\n".join(line for line in lines if line))


def _number(cell: str) -> str:
    """The cell with the decimal sign of the language, if it is a number; any other text as it is."""
    return cell.replace(".", voice().language.decimal) if NUMBER_PATTERN.fullmatch(cell) else cell


def table_lines(rows: Sequence[Sequence[str]], words: int, width: int) -> list[str]:
    """The lines of a table whose first row is its head; if it is wider than ``width``, columns of words move above.

    There, words that several rows share stand once.

    >>> table = [("what", "of what", "ratio"), ("law", "f", "0.9"), ("law", "f and f'", "1.2")]
    >>> print(*table_lines(table, 2, 80), sep="\\n")
    what  of what   ratio
    ─────────────────────
    law   f           0.9
    law   f and f'    1.2
    >>> print(*table_lines(table, 2, 18), sep="\\n")
    what
      of what   ratio
    ─────────────────
    law
      f           0.9
      f and f'    1.2
    """
    above, aligned = 0, _aligned(rows, words)
    while above < words and len(aligned[0]) > width:
        above += 1
        aligned = ["  " + line for line in _aligned([row[above:] for row in rows], words - above)]
    lines: list[str] = []
    said = ""
    for k, (row, line) in enumerate(zip(rows, aligned, strict=True)):
        shared = ": ".join(row[:above])
        if shared != said:
            lines += textwrap.wrap(shared, width, subsequent_indent="  ", break_on_hyphens=False)
            said = shared
        lines += [line.rstrip()] if k else [line.rstrip(), "─" * len(line)]
    return lines


def _aligned(rows: Sequence[Sequence[str]], words: int) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    places = [f"{'<' if k < words else '>'}{width}" for k, width in enumerate(widths)]
    return ["  ".join(map(format, row, places)) for row in rows]


@contextmanager
def progress_bar(things: Words) -> Generator[Callable[[int, int], None]]:
    """A bar on standard error if it is a terminal; call what it yields with (done, total)."""
    if not sys.stderr.isatty():
        yield lambda done, total: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    shown = -REFRESH_INTERVAL

    def step(done: int, total: int) -> None:
        """Set the bar to ``done`` of ``total``, and show it when it is due."""
        nonlocal shown
        now = time.monotonic()
        due = now - shown >= REFRESH_INTERVAL
        shown = now if due else shown
        progress.update(bar, completed=done, total=total, refresh=due)

    columns = (TextColumn(translated(things)), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    # Without a thread that refreshes: a process with threads is better not forked.
    with Progress(*columns, console=Console(stderr=True), transient=True, auto_refresh=False) as progress:
        bar = progress.add_task(str(things), total=None)
        yield step


COMMAND_OPTIONS = ("pencil", "seed", "upto", "dxf", "files", "working_drawing")
"""Quantities of a :class:`DesignError` that are options of the command line, not values of the task file."""


def read_task(path: Path | None, builtin: str = "coursework") -> Task | ArcsTask:
    """The task in a file, or without one the built-in task of that name.

    Raises
    ------
    TaskError : the file is no task; the language that it names is spoken by then
    """
    if path is None:
        return graphcam.builtin_task(builtin)
    voice().adopt_language(language_in(path))
    return graphcam.load_task(path)


@contextmanager
def errors_name(path: Path | None) -> Generator[None]:
    """Name the file of the task, if it has one, in errors about the design too."""
    try:
        yield
    except DesignError as error:
        option = {"pencil seed": "seed", "pencil line": "pencil"}.get(error.quantity, error.quantity)
        if option in COMMAND_OPTIONS:
            raise DesignError(f"--{option.replace('_', '-')}", *error.args[1:]) from None
        if path is None:
            raise
        raise TaskError(str(path), *error.args) from None


FILE_DESCRIPTIONS: Mapping[str, Caption] = {
    "player": say("step by step in a browser, and the mechanism turning"),
    "sheet": say("the sheet, true to scale"),
    "worksheet": say("the sheet to be finished, true to scale"),
    "note": say("the calculation with formulas and numbers"),
    "comparison": say("drawn values beside exact ones"),
    "profile": say("the exact working profile, for CAD and machines"),
    "working-drawing": say("the cam as a part"),
    "solution": say("all of it, for programs"),
}
"""What each file of a solution is, by its name without page number and ending, in the order of printing."""
FILES_TO_OPEN_FIRST: Mapping[str, Caption] = {
    "player.html": say("in a browser"),
    "sheet.pdf": say("print at 100 %"),
    "worksheet.pdf": say("print at 100 %"),
}
"""How the files that are to be opened first are opened, by their names."""


def file_kind(name: str) -> str:
    """The kind of a file, which is a key of ``FILE_DESCRIPTIONS``, by its name; empty for a file of another origin.

    >>> file_kind("sheet-12.svg"), file_kind("working-drawing.pdf"), file_kind("mine.txt")
    ('sheet', 'working-drawing', '')
    """
    stem = Path(name).stem
    first, dash, number = stem.rpartition("-")
    stem = first if dash and number.isdecimal() else stem
    return stem if stem in FILE_DESCRIPTIONS else ""


def files_by_kind(names: Iterable[str]) -> list[tuple[Caption | str, list[str]]]:
    """Descriptions with the files of each kind, in the order of ``FILE_DESCRIPTIONS``; pages by their numbers.

    >>> for what, names in files_by_kind(["solution.json", "sheet-10.svg", "sheet-2.svg", "sheet.svg"]):
    ...     print(what, names)
    the sheet, true to scale ['sheet.svg', 'sheet-2.svg', 'sheet-10.svg']
    all of it, for programs ['solution.json']
    """
    kinds: dict[str, list[str]] = {kind: [] for kind in (*FILE_DESCRIPTIONS, "")}
    for name in sorted(names, key=lambda name: (Path(name).suffix, len(name), name)):
        kinds[file_kind(name)].append(name)
    return [(FILE_DESCRIPTIONS.get(kind, ""), found) for kind, found in kinds.items() if found]


def print_files(folder: Path, names: Sequence[str]) -> None:
    """Print all files that were written into a folder, by kind, and which to open first."""
    # A terminal's abilities are rich's business.
    from rich.console import Console
    from rich.text import Text

    console = Console(highlight=False, markup=False, emoji=False, soft_wrap=True)
    count = translated(say_many("{count} file", "{count} files", len(names)))
    console.print(Text.assemble("\n", linked_text(folder, str(folder)), f": {count}"))
    for what, found in files_by_kind(names):
        links = Text(", ").join(linked_text(folder / name, name) for name in found)
        console.print(Text.assemble("  ", links, f": {translated(what)}" if what else ""))
    first = [
        Text.assemble(linked_text(folder / name, str(folder / name)), f" ({translated(how)})")
        for name, how in FILES_TO_OPEN_FIRST.items()
        if name in names
    ]
    if first:
        begin, then = translated(say("Open first: ")), translated(say(", then "))
        console.print(Text.assemble(begin, Text(then).join(first)))


def print_file(path: Path, what: Caption) -> None:
    """Print the path of a file that was written, and ``what`` it is."""
    from rich.console import Console

    console = Console(highlight=False, markup=False, emoji=False, soft_wrap=True)
    console.print(linked_text(path, str(path)) + f": {translated(what)}")


def linked_text(path: Path, words: str) -> Text:
    """Words that open a file or folder when they are clicked; plain words where the terminal has no links."""
    from rich.style import Style
    from rich.text import Text

    return Text(words, Style(link=path.resolve().as_uri()))
