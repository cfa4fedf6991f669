"""Waiting times: a task solved with all its files, and one view of it drawn anew after a size was changed."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from graphcam.bench.rows import BenchRow, Gauge, Section
from graphcam.plots.step_board import StepBoard
from graphcam.report.documents import contents_of, drawing_of, sheet_of
from graphcam.report.step_player import player_of
from graphcam.sheets.player import group_svg
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solve import solve
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import BUILT_IN, builtin_arcs_task, builtin_task

LIBRARIES = "import numpy, matplotlib.figure, ezdxf"
"""What loading a program that draws takes at least."""
TIMES = 1.6
"""How many times the loading of the libraries a whole run may take, and a second more."""
STARTED = 3
"""Times that each program is started, the best of which counts: the first one compiles it."""
PROGRAM = "import sys; from graphcam.cli import main; sys.argv = ['graphcam', 'solve', '--out', sys.argv[1]]; main()"


def solve_rows(gauge: Gauge) -> Iterator[BenchRow]:
    """A whole run of the built-in task; of every built-in one layout, step player and the slowest of its views."""
    with TemporaryDirectory() as folder:
        libraries, whole = (_processor_seconds(program, Path(folder)) for program in (LIBRARIES, PROGRAM))
    unit = f"s beyond {TIMES:g} times the libraries"
    yield BenchRow("solve, all files", "coursework", whole - TIMES * libraries, unit, "<= 1", None, whole)
    for name, task in _tasks().items():
        solution = solve(task)
        contents = contents_of(solution)
        drawing = drawing_of(contents)
        yield _milliseconds("layout", name, gauge.timer.seconds(partial(sheet_of, solution)), 250)
        yield _milliseconds("step player", name, gauge.timer.seconds(partial(player_of, contents, drawing)), 150)
        times = {view: gauge.timer.seconds(again) for view, again in _views(solution).items()}
        slowest = max(times, key=times.__getitem__)
        yield _milliseconds("view after a size changed", f"{name}, {slowest}", times[slowest], 30)


def _milliseconds(name: str, what: str, seconds: float, most: int) -> BenchRow:
    return BenchRow(name, what, 1e3 * seconds, "ms", f"<= {most}", None, seconds)


def _processor_seconds(program: str, folder: Path) -> float:
    """What a Python of its own takes, from its start to its end."""
    # As where graphcam is installed, its modules are compiled once.
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    paths = {"PYTHONPYCACHEPREFIX": str(folder / "compiled"), "PYTHONPATH": os.pathsep.join(sys.path)}
    found: list[float] = []
    for run in range(STARTED):
        before = os.times()
        command = [sys.executable, "-c", program, str(folder / str(run))]
        subprocess.run(command, check=True, capture_output=True, env=kept | paths)
        after = os.times()
        found.append(after.children_user + after.children_system - before.children_user - before.children_system)
    return min(found)


def _tasks() -> Mapping[str, Task | ArcsTask]:
    return {name: builtin_task(name) for name in BUILT_IN} | {"arcs": builtin_arcs_task()}


def _views(solution: AnySolution) -> Mapping[str, Callable[[], str]]:
    """What draws each view of a solution anew."""
    drawn: dict[str, list[str]] = {}
    for name, construction in solution.drawn.items():
        for view in {step.view.name for step in construction.steps() if step.marks}:
            drawn.setdefault(view, []).append(name)
    task = resized(solution)
    return {view: partial(view_svg, task, view, names) for view, names in drawn.items()}


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


WAITING = Section(
    "waiting",
    "Waiting times of a user",
    "A whole run is told by what it takes beyond the loading of the libraries that draw, which depends on the disk and "
    "on their versions; everything else in milliseconds of the processor on this machine.",
    solve_rows,
)
