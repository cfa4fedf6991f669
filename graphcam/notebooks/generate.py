"""The step-by-step notebook of a task."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import PurePath
from typing import Any

import nbformat.v4 as nb
from nbformat import NotebookNode

from graphcam.arcs_task import ArcsTask
from graphcam.main_job import markdown
from graphcam.main_job.arcs import AnySolution, ArcsSolution
from graphcam.main_job.kinds import solve
from graphcam.notebooks.backgrounds import BACKGROUNDS, CHECKED, ERRORS, FIRST, QUESTIONS
from graphcam.notebooks.extra import needed
from graphcam.task import Task

TASK_FILE = "task.toml"
"""The task's file, beside the notebook."""
SETUP = f"""\
import graphcam as gc
from graphcam.notebooks import Question, Slider, changed, compared, drawing, explore, player, show_steps

task = gc.load_task("{TASK_FILE}")
solution = gc.solve(task)"""
PYTHON = {
    "language_info": {"name": "python"},
    "kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"},
}
PARTS = """\
def with_parts(parts):
    finer = gc.solve(changed(task, {{"drawing.divisions": parts}}))
    return drawing(finer.drawn["{construction}"], "{view}")

explore(with_parts, parts=Slider("parts", {values}, {start}, {shown}))"""


def task_files(task: Task | ArcsTask) -> dict[str, str]:
    """The files of a task by their names: TOML, and the table of a measured motion.

    >>> from graphcam.task_file import builtin_task
    >>> list(task_files(builtin_task("measured")))
    ['task.toml', 'measured.csv']

    Raises
    ------
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    """
    said = _filled(task.to_dict())
    table = task.motion.table if isinstance(task, Task) else None
    tables: dict[str, str] = {}
    if table is not None:
        name = said["motion"]["table"] = PurePath(table.file).name
        rows = "".join(f"{phi!r},{value!r}\n" for phi, value in table.rows)
        tables[name] = f"phi_deg,{table.column}\n{rows}"
    return {TASK_FILE: needed("tomli_w", "writing a task").dumps(said), **tables}


def _filled(table: Mapping[str, Any]) -> dict[str, Any]:
    """A table of a task without its empty texts and tables, which are defaults."""
    filled = {key: _filled(value) if isinstance(value, Mapping) else value for key, value in table.items()}
    return {key: value for key, value in filled.items() if value not in ("", {})}


def write_notebook(task: Task | ArcsTask) -> NotebookNode:
    """The notebook of a task, to be executed beside its :func:`task_files`.

    >>> from graphcam.task_file import builtin_task
    >>> notebook = write_notebook(builtin_task("flat"))
    >>> [cell.source.splitlines()[0] for cell in notebook.cells if cell.source.startswith("## ")][:3]
    ['## The task', '## Acceleration diagram', '## Velocity, displacement and the scales']

    Raises
    ------
    DesignError : there is no such cam
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    """
    solution = solve(task)
    toml = task_files(task)[TASK_FILE]
    cells = [
        _text(f"# {markdown.text(task.title.name) or 'Cam'}\n\n{FIRST}"),
        _text(f"## The task\n\n```toml\n{toml.strip()}\n```"),
        _hidden(SETUP),
        *(_text(f"> **Mind:** {markdown.text(sentence)}") for sentence in solution.warnings),
        *(cell for name in solution.drawn for cell in _chapter(name)),
        *_spring(solution),
        _text(f"## Try it yourself\n\n{CHECKED}"),
        *(cell for name in _asked(solution) for cell in _question(solution, name)),
        _text("## Move it\n\nMore parts, fewer parts: what changes, and what is worth the work?"),
        _hidden(_parts(solution)),
        _text("## Drawn and exact\n\nError and bound are millimetres on the paper."),
        _hidden("compared(solution)"),
        _text(f"## Where the error comes from\n\n{ERRORS}"),
        _text("## The sheet, step by step"),
        _hidden("player(solution)"),
        _text(f"## Questions\n\n{QUESTIONS}"),
    ]
    # Without random names a notebook that is written anew is the same.
    for k, cell in enumerate(cells):
        cell["id"] = f"cell-{k}"
    title = {"title": task.title.name, "language_info": {"name": "python"}}
    return nb.new_notebook(
        cells=cells, metadata={**title, "kernelspec": {"name": "python3", "display_name": "Python 3"}}
    )


def _text(source: str) -> NotebookNode:
    return nb.new_markdown_cell(source)


def _hidden(source: str) -> NotebookNode:
    return nb.new_code_cell(source, metadata={"tags": ["remove-input"], "jupyter": {"source_hidden": True}})


def _chapter(name: str) -> list[NotebookNode]:
    title, background = BACKGROUNDS[name]
    return [_text(f"## {title}\n\n{background}"), _hidden(f'show_steps(solution.drawn["{name}"])')]


def _spring(solution: AnySolution) -> list[NotebookNode]:
    """The force plan of a follower that a spring holds on its cam."""
    if isinstance(solution, ArcsSolution) or not solution.spring or not solution.spring.force_plan:
        return []
    title, background = BACKGROUNDS["force_plan"]
    return [_text(f"## {title}\n\n{background}"), _hidden("show_steps(solution.spring.force_plan)")]


def _asked(solution: AnySolution) -> list[str]:
    """The quantities that a reader of the drawing is asked for."""
    asked = ("max_v", "minimum_prime_radius", "max_pressure_angle_rise_deg", "min_pitch_curvature_radius", "lift")
    quantities = solution.comparison.quantities
    return [name for name in asked if name in quantities and quantities[name].drawn == quantities[name].drawn]


def _question(solution: AnySolution, name: str) -> list[NotebookNode]:
    q = solution.comparison.quantities[name]
    source = (
        f'your_{name} = None  # {q.unit}\nQuestion.about(solution.comparison.quantities["{name}"]).check(your_{name})'
    )
    return [nb.new_code_cell(source, metadata={"tags": ["try-it"]})]


def _parts(solution: AnySolution) -> str:
    """A slider for the number of parts, on the drawing that shows them best."""
    construction = "arc_diagrams" if isinstance(solution, ArcsSolution) else "integration"
    view = "acceleration" if isinstance(solution, ArcsSolution) else "displacement"
    start = solution.task.drawing.divisions
    values = sorted({2, 4, 8, 12, 24, start})
    shown = tuple(sorted({4, start}))
    return PARTS.format(construction=construction, view=view, values=values, start=start, shown=shown)
