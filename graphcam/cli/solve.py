"""The command ``graphcam solve``, which draws a task and compares it with exact values."""

from __future__ import annotations

import gc
import json
from collections.abc import Generator, Iterable
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from typer import Option

import graphcam
from graphcam.cli.command_language import help_text_of, translated, voice
from graphcam.cli.shared import (
    DEFAULT_FOLDER,
    TaskFile,
    echo,
    errors_name,
    file_kind,
    input_errors,
    path_option,
    print_files,
    print_table,
    progress_lines,
    read_task,
    short_warnings,
)
from graphcam.language import languages
from graphcam.words import Caption, Words, say, say_in, sequence

if TYPE_CHECKING:
    from graphcam.solving.arcs_solution import AnySolution
    from graphcam.solving.solution import Solution
    from graphcam.tasks.arcs_task import ArcsTask
    from graphcam.tasks.task import Task

LARGE_FORMATS = ("A1", "A2")
"""Formats that are too large for one construction."""
OUT_HELP = help_text_of(say("Folder for the files; the default is {folder}.", folder=str(DEFAULT_FOLDER)))
JSON_HELP = "Print only the solution, as JSON; write files only with --out."
OWN_SHEETS_HELP = "Each construction on sheets of its own; A3 if the task has A1 or A2."
BLANK_HELP = "A blank sheet to draw on, without answers: axes, divisions, and the data of the task."
UPTO_HELP = "A half-done sheet: up to step K, or to the end of the construction NAME, without the later answers."
MAX_PENCIL = 10.0
"""The largest standard deviation of a pencil [mm]: of more nothing can be read off the drawing."""
PENCIL_HELP = "Standard deviation, in mm, of random errors in lines, divider settings and at the protractor's edge."
DXF_HELP = "plain: for any CAD program; cad: with true dimensions and attributes."
# Brackets are markup here.
PART_HELP = r"Also the cam's working drawing, a solid and G-code for the workshop, from the task's table \[part]."
LANGUAGE_HELP = help_text_of(
    say("Language of sheet and note, instead of the task's: {names}.", names=", ".join(languages()))
)


GIVEN_LABEL, FOUND_LABEL, MINIMUM_LABEL = say("given"), say("found"), say("minimum")


def adopted_sizes(solution: AnySolution) -> Caption | None:
    """A line with the adopted sizes and the origin of each; None for a cam of arcs, whose sizes are all given.

    >>> import graphcam as gc
    >>> print(adopted_sizes(gc.solve(gc.builtin_task())))
    adopted: prime radius 44 mm (found), offset -10 mm (given), roller radius 17 mm (found)
    """
    from graphcam.solving.solution import Solution

    if not isinstance(solution, Solution):
        return None
    return say("adopted: {sizes}", sizes=sequence([*_cam_sizes(solution), *_spring_sizes(solution)]))


def _cam_sizes(solution: Solution) -> list[Caption]:
    chain, board = solution.chain, solution.chain.board
    given = {size.name: size.value for size in board.follower.sizes(board.follower.place, board.roller_radius)}
    said = [
        _size_caption(
            say("prime radius"),
            chain.prime_radius,
            say("mm"),
            FOUND_LABEL if board.prime_radius is None else GIVEN_LABEL,
        )
    ]
    for size in board.follower.sizes(chain.place, solution.cam.roller_radius):
        if size.value is not None:
            where = FOUND_LABEL if given[size.name] is None else GIVEN_LABEL
            said += [_size_caption(size.title, size.value, say("mm"), where)]
    return said


def _spring_sizes(solution: Solution) -> list[Caption]:
    spring = solution.spring
    if spring is None:
        return []
    from graphcam.drafting.scale import unit

    where = MINIMUM_LABEL if spring.open_preload else GIVEN_LABEL
    return [_size_caption(say("preload"), spring.load.preload, unit(spring.units[1]), where)]


def _size_caption(name: Words, value: float, of: Words, where: Words) -> Caption:
    # No powers of ten: four digits, and zeros.
    told = float(f"{value:.4g}") if where is MINIMUM_LABEL else value
    return say("{name} {value:.7g} {unit} ({where})", name=name, value=told, unit=of, where=where)


@contextmanager
def _garbage_collector_off() -> Generator[None]:
    """Switch the garbage collector off, since nearly nothing that is loaded and drawn becomes garbage meanwhile."""
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


@_garbage_collector_off()
def solve(
    task: TaskFile = None,
    out: Annotated[Path | None, path_option(metavar="DIR", help=OUT_HELP)] = None,
    as_json: Annotated[bool, Option("--json", help=JSON_HELP)] = False,
    pencil: Annotated[float | None, Option(metavar="SIGMA_MM", help=PENCIL_HELP, min=0, max=MAX_PENCIL)] = None,
    divisions: Annotated[
        int | None, Option(metavar="N", help="Number of parts per phase or arc, instead of the task's.")
    ] = None,
    language: Annotated[str | None, Option(metavar="NAME", help=LANGUAGE_HELP)] = None,
    seed: Annotated[int, Option(metavar="N", help="Seed of the pencil's random errors.")] = 0,
    per_construction: Annotated[bool, Option("--per-construction", help=OWN_SHEETS_HELP)] = False,
    worksheet: Annotated[bool, Option("--worksheet", help=BLANK_HELP)] = False,
    upto: Annotated[str | None, Option(metavar="K|NAME", help=UPTO_HELP)] = None,
    dxf: Annotated[str, Option(metavar="KIND", help=DXF_HELP)] = "plain",
    working_drawing: Annotated[bool, Option("--working-drawing", help=PART_HELP)] = False,
) -> None:
    """Solve a task: draw the sheet, write the note and the tables, compare with exact values.

    [bold]Examples[/bold]

    graphcam solve

    graphcam solve cam.toml --out cam

    graphcam solve cam.toml --json > solution.json

    graphcam solve cam.toml --pencil 0.2 --seed 7   (with drawing errors of 0.2 mm)

    graphcam solve cam.toml --language ru

    graphcam solve cam.toml --divisions 24   (finer: the errors become smaller)

    graphcam solve cam.toml --worksheet   (blank, for students)

    graphcam solve cam.toml --per-construction --upto integration

    graphcam solve cam.toml --dxf cad   (with dimensions and a title block that a CAD program can edit)

    graphcam solve cam.toml --working-drawing   (the cam as a part, with its polar table)
    """
    voice().choose(language)
    progress = progress_lines(quiet=as_json)
    folder = DEFAULT_FOLDER if out is None and not as_json else out
    with input_errors(), short_warnings():
        last = _last_step(upto, worksheet=worksheet)
        given = _read_task(task, divisions, language, small=per_construction)
        # Loads the renderers: only when the input has been found right.
        from graphcam.report.documents import contents_of
        from graphcam.report.output_folder import check_choices
        from graphcam.solving.solve import solve as solved

        progress(say("drawing and computing"))
        with errors_name(task):
            hand = None if pencil is None else graphcam.Pencil.of(pencil, seed=seed)
            solution = solved(given, hand)
            if folder is not None:  # as it is drawn on the sheets
                solution = contents_of(solution, per_construction=per_construction).solution
            document = _document(solution, finished=last is None)
            if folder is None:
                # A wrong choice is one even where nothing is drawn by it.
                check_choices(solution, last, dxf=dxf, working_drawing=working_drawing)
            else:
                document["files"] = solution.write(
                    folder,
                    upto=last,
                    per_construction=per_construction,
                    dxf=dxf,
                    working_drawing=working_drawing,
                    progress=progress,
                )
    # Warnings and sizes tell what somebody with an unfinished sheet is to find.
    finished = last is None
    sizes = adopted_sizes(solution) if finished else None
    _print_solution(document, folder, solution.warnings if finished else (), sizes, as_json=as_json)
    if folder is not None and finished and not (as_json or per_construction):
        _print_hint(solution, folder)


def _read_task(path: Path | None, divisions: int | None, language: str | None, *, small: bool) -> Task | ArcsTask:
    """The task with what the options change; ``small`` sheets are for one construction each."""
    task = read_task(path)
    asked = {"divisions": divisions, "language": language}
    drawing = replace(task.drawing, **{key: value for key, value in asked.items() if value is not None})
    if small and drawing.format in LARGE_FORMATS:
        drawing = drawing.on("A3")
    return replace(task, drawing=drawing)


def _last_step(upto: str | None, *, worksheet: bool) -> int | str | None:
    if worksheet and upto is not None:
        limit = say("left out with --worksheet")
        raise graphcam.DesignError("upto", upto, limit, say("a worksheet is the sheet up to step 0"))
    if worksheet:
        return 0
    return int(upto) if upto is not None and upto.isdecimal() else upto


def _document(solution: AnySolution, *, finished: bool) -> dict[str, Any]:
    """The figures of a solution for printing; of an unfinished sheet nothing that holds an answer."""
    from graphcam.solving.shown_solution import without_answers

    return solution.to_dict() if finished else without_answers(solution.to_dict())


def _print_solution(
    document: dict[str, Any], folder: Path | None, sentences: Iterable[object], sizes: Caption | None, *, as_json: bool
) -> None:
    """Print the document as JSON, or quantities and sizes (none of an unfinished sheet), warnings, and the files."""
    if as_json:
        typer.echo(json.dumps(document, indent=2, allow_nan=False))
    else:
        if "quantities" in document:
            _print_quantities(document["quantities"])
        if sizes:
            echo(f"\n{translated(sizes)}")
    for sentence in sentences:
        echo(say("warning: {sentence}", sentence=sentence), err=True)
    if folder is not None and not as_json:
        # Loaded already, by what wrote the files.
        from graphcam.report.output_folder import written_files

        print_files(folder, written_files(folder))


def _print_hint(solution: AnySolution, folder: Path) -> None:
    """Print the sizes of the diagrams with which fewer sheets would do, and a format on which parts are wider."""
    # Loaded already, by what wrote the files.
    from graphcam.report.documents import contents_of
    from graphcam.report.fewer_sheets import fewer_sheets, larger_paper
    from graphcam.report.output_folder import written_files

    pages = sum(file_kind(name) == "sheet" and name.endswith(".svg") for name in written_files(folder))
    fewer = fewer_sheets(contents_of(solution), pages) if pages > 1 else None
    for hint in filter(None, (fewer, *larger_paper(solution))):
        echo("", err=True)
        echo(hint, err=True)


def _print_quantities(quantities: dict[str, dict[str, Any]]) -> None:
    # Loaded already, by what drew.
    from graphcam.drafting.scale import UNITS

    rows: list[list[str]] = []
    for name, row in quantities.items():
        numbers = (row[key] for key in ("drawn", "exact", "error_paper", "tolerance_paper"))
        # Adding zero makes a positive zero of what rounds to a negative one.
        rows.append(
            [
                name,
                translated(UNITS.get(row["unit"], row["unit"])),
                *("-" if x is None else f"{round(x, 3) + 0:.3f}" for x in numbers),
            ]
        )
    columns = say("quantity"), say_in("a column", "unit"), say("drawn"), say("exact"), say("error")
    print_table(
        (*columns, say_in("a column", "bound")), rows, words=2, caption=say("error and estimated bound in mm on paper")
    )
