"""How long one waits: a task with all its files, a view drawn anew, a picture of a drag, a construction, the sheet."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import count
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from graphcam.bench.bench_followers import FOLLOWER_KINDS, scene
from graphcam.bench.rows import MILLISECONDS, BenchRow, Effort, Line, Section, Unit
from graphcam.bench.timing import seconds_of_programs
from graphcam.plots.step_board import StepBoard
from graphcam.report.documents import contents_of, drawing_of, sheet_of
from graphcam.report.step_player import player_of
from graphcam.sheets.model import Drawing
from graphcam.sheets.player import group_svg
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solve import solve
from graphcam.studio.engine import answer
from graphcam.studio.task_paths import changed_task, value_at
from graphcam.studio.task_text import plain_task
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import BUILTIN_TASK_NAMES, builtin_arcs_task, builtin_task
from graphcam.words import say

LOADED_LIBRARIES = "import numpy, matplotlib.figure, matplotlib.backends.backend_agg, ezdxf"
"""What loading a program that draws takes at least."""
START_COUNT = 3
"""Times that each program is started, the best of which counts: the first one compiles it."""
PROGRAM = (
    "import sys; from graphcam.__main__ import main; sys.argv = ['graphcam', 'solve', '--out', sys.argv[1]]; main()"
)
PX_PER_MM = 1.9
"""How large a view of the studio is shown."""
SIZE_STEP = 1e-3
"""How much a size grows from one picture of a drag to the next [mm or degrees]."""


def built_in() -> Mapping[str, Task | ArcsTask]:
    """Every built-in task by its name.

    >>> [*built_in()]
    ['coursework', 'arm', 'flat', 'swinging-face', 'measured', 'arcs']
    """
    return {name: builtin_task(name) for name in BUILTIN_TASK_NAMES} | {"arcs": builtin_arcs_task()}


# --- a task solved ---------------------------------------------------------------------------------------------------


def solve_rows(effort: Effort) -> Iterator[BenchRow]:
    """A whole run of the built-in task; of every built-in one layout, step player and the slowest of its views."""
    seconds = effort.timer.seconds
    with TemporaryDirectory() as folder:
        libraries, whole = (_processor_seconds(program, Path(folder)) for program in (LOADED_LIBRARIES, PROGRAM))
    missing = "the rest is graphcam, its command line, formulas and fonts loaded, and 13 files drawn and written"
    loaded = Unit("times the loading of the libraries", libraries)
    yield loaded.row("solve, all files", "coursework", whole, "<= 2.2", missing=missing)
    for name, task in built_in().items():
        solution = solve(task)
        contents = contents_of(solution)
        yield MILLISECONDS.row("layout", name, seconds(_laid_out, contents.solution), "<= 250")
        yield MILLISECONDS.row("step player", name, seconds(player_of, contents, drawing_of(contents)), "<= 150")
        again = resized(solution)
        slowest, view = max((seconds(view_svg, again, view, names), view) for view, names in _views(solution).items())
        yield MILLISECONDS.row("view after a size changed", f"{name}, {view}", slowest, "<= 30")


def _processor_seconds(program: str, folder: Path) -> float:
    """What a Python of its own takes, from its start to its end."""
    # As where graphcam is installed, its modules are compiled once.
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    paths = {"PYTHONPYCACHEPREFIX": str(folder / "compiled"), "PYTHONPATH": os.pathsep.join(sys.path)}
    found: list[float] = []
    for run in range(START_COUNT):
        before = seconds_of_programs()
        command = [sys.executable, "-c", program, str(folder / str(run))]
        subprocess.run(command, check=True, capture_output=True, env=kept | paths)
        found.append(seconds_of_programs() - before)
    return min(found)


def _views(solution: AnySolution) -> Mapping[str, list[str]]:
    """The constructions that draw each view of a solution."""
    drawn: dict[str, list[str]] = {}
    for name, construction in solution.drawn.items():
        for view in {step.view.name for step in construction.steps() if step.marks}:
            drawn.setdefault(view, []).append(name)
    return drawn


def _laid_out(solution: AnySolution) -> Drawing:
    """The sheets of a solution, of which nothing is kept from before."""
    contents_of.cache_clear()
    return sheet_of(solution)


def resized(solution: AnySolution) -> Task | ArcsTask:
    """The task of a solution with one size changed a little: the roller's radius, or of a flat face the prime radius.

    >>> resized(solve(builtin_task())).follower.roller_radius
    16.5
    """
    if isinstance(solution, ArcsSolution):
        arcs = solution.task
        return replace(arcs, follower=replace(arcs.follower, roller_radius=arcs.follower.roller_radius - 0.5))
    task, sizes = solution.task, solution.chain.sizes
    if sizes.roller_radius:
        return replace(task, follower=replace(task.follower, roller_radius=sizes.roller_radius - 0.5))
    return replace(task, cam=replace(task.cam, prime_radius=sizes.prime_radius + 0.5))


def view_svg(task: Task | ArcsTask, view: str, names: Sequence[str]) -> str:
    """The steps of one view as SVG, a group each; nothing is drawn but the constructions ``names`` and what they need.

    >>> view_svg(builtin_task(), "velocity", ["integration"]).count("<g id=")
    4
    """
    drawn = solve(task).drawn
    steps = (step for name in names for step in drawn[name].steps() if step.marks and step.view.name == view)
    page = StepBoard((), tuple(steps)).page()
    return "".join(f'<g id="{group.key}">{group_svg(group, page.height)}</g>' for group in page.groups)


WAITING_SECTION = Section(
    "waiting",
    say("Waiting times of a user"),
    "A whole run is told beside the loading of the libraries that draw, which depends on the disk and on their "
    "versions; everything else in milliseconds of the processor on this machine.",
    solve_rows,
)

# --- a size dragged in the studio ------------------------------------------------------------------------------------


def studio_rows(effort: Effort) -> Iterator[BenchRow]:
    """Every view of every built-in task while one of its sizes is dragged."""
    for name, given in built_in().items():
        task = plain_task(given)
        for view in answer({"task": task, "views": []})["names"]:
            seconds = effort.timer.seconds(dragging(task, view["name"]))
            yield MILLISECONDS.row("view while dragged", f"{name}, {view['name']}", seconds, "<= 30")


def dragging(task: dict[str, Any], view: str) -> Callable[[], dict[str, Any]]:
    """What answers the next picture of a drag: each time with the size a little farther on.

    >>> again = dragging(plain_task(builtin_task()), "profile")
    >>> again()["ok"], again()["sizes"]["offset"]
    (True, -9.998)
    """
    path = dragged_size(task)
    asked = [{"name": view, "px_per_mm": PX_PER_MM}]
    hold, steps = answer({"task": task, "views": asked})["hold"], count(1)

    def next_picture() -> dict[str, Any]:
        """The answer with the next size."""
        moved = changed_task(task, {path: value_at(task, path) + SIZE_STEP * next(steps)})
        return answer({"task": moved, "views": asked, "hold": hold})

    return next_picture


def dragged_size(task: dict[str, Any]) -> str:
    """The size that is dragged: the first of some that a task gives, on which every view depends."""
    sizes = ("follower.offset", "arcs.rho1", "cam.prime_radius", "limits.min_curvature_radius")
    return next(path for path in sizes if value_at(task, path) is not None)


STUDIO_SECTION = Section(
    "studio",
    say("Waiting times in the studio"),
    "One view, solved and drawn anew while a size is dragged, with its labels and scales held; in milliseconds of "
    "processor time on this machine.",
    studio_rows,
)

# --- constructions and their sheet, in sine-cosine pairs --------------------------------------------------------------


@dataclass(frozen=True)
class DrawingTime:
    """Times of one construction in sine-cosine pairs; what it starts from is drawn before.

    readings : None for a stage of the sheet, which takes one time alone
    """

    follower: str
    construction: str
    readings: float | None
    steps: float


def drawing_times(effort: Effort, parts: int = 12, law: str = "3-4-5") -> Iterator[DrawingTime]:
    """Every construction of every follower; then laying out and rendering the sheet of the built-in task."""
    # matplotlib takes long to load, so it comes when there is something to draw.
    from graphcam.sheets.matplotlib_renderer import write_pdf, write_png

    for follower in FOLLOWER_KINDS:
        chain = scene(follower, law).chain(parts)
        for name in chain:
            # The function itself draws anew, from constructions that the chain keeps.
            readings, steps = effort.timer.seconds(chain.own[name], chain), effort.timer.seconds(chain[name].steps)
            yield DrawingTime(follower, name, readings / effort.pair, steps / effort.pair)
    once, solution = replace(effort.timer, least_runs=1), solve(builtin_task())
    drawing = sheet_of(solution)
    with TemporaryDirectory() as folder:
        for stage, seconds in (
            ("layout", once.seconds(_laid_out, solution)),
            ("PDF", once.seconds(write_pdf, drawing, Path(folder, "sheet.pdf"))),
            ("PNG", once.seconds(write_png, drawing.pages[0], Path(folder, "sheet.png"))),
        ):
            yield DrawingTime("sheet", stage, None, seconds / effort.pair)


def _texts(found: Sequence[DrawingTime], pair: float) -> Iterator[list[str]]:
    yield ["follower", "construction", "readings, ms", "steps, ms"]
    for d in found:
        times = ("" if pairs is None else f"{1e3 * pair * pairs:.3g}" for pairs in (d.readings, d.steps))
        yield [d.follower, d.construction, *times]


def _lines(d: DrawingTime) -> Iterator[Line]:
    of = {"subject": d.follower, "quantity": d.construction, "ratio_unit": "sine-cosine pairs"}
    if d.readings is not None:
        yield {**of, "section": "readings", "ratio": d.readings}
    yield {**of, "section": "rendering" if d.readings is None else "steps", "ratio": d.steps}


DRAWING = Section(
    "drawing",
    say("Readings, steps and rendering"),
    "Milliseconds on this machine, 12 parts per phase: for the readings, for the steps drawn from them, and for the "
    "whole sheet.",
    drawing_times,
    _texts,
    _lines,
    derived=(),
)
