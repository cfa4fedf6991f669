"""Tables of the course: honest drawings that are called right, the author's checks, and the prompts of each notebook.

    python tests/notebooks/course_tables.py            the built-in cam
    python tests/notebooks/course_tables.py cam.toml   another task

Drawings are those of graphcam's own pencil, 200 for each line width; an author's check that does not hold for the task
is a statement of the prose that may be untrue of it.
"""

from __future__ import annotations

import contextlib
import io
import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jupytext
import matplotlib as mpl
import numpy as np

import graphcam as gc
from graphcam.drafting.ink import Reading
from graphcam.notebooks.question import Question, told_unit

FOLDER = Path(__file__).parents[2] / "notebooks"
LINES = 0.1, 0.2
"""Standard deviations of a pencil line [mm]."""
Asked = list[tuple[Question, Callable[[gc.Pencil], Reading]]]


def right_share(question: Question, draw: Callable[[gc.Pencil], Reading], line: float) -> float:
    """The part of 200 drawings by a pencil of a line [mm] that a question calls right."""
    read = draw(gc.Pencil.of(line, samples=200, seed=7))
    values = told_unit(read)[0] * np.atleast_1d(read.value)
    return float(np.mean([question.check(float(value)).status == "right" for value in values]))


def executed(script: Path) -> tuple[dict[str, Any], int, int]:
    """What a notebook's cells leave, how many checks of its author there are, and how many of them do not hold."""
    names: dict[str, Any] = {"display": lambda *_: None}
    checks = failed = 0
    for cell in jupytext.read(script).cells:
        if cell.cell_type != "code":
            continue
        checks += cell.source.count("assert ")
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(cell.source, str(script), "exec"), names)
        except AssertionError:
            failed += 1
        names |= dict.fromkeys(("show_steps", "explore"), lambda *_, **__: None)
    return names, checks, failed


def main(task: Path) -> None:
    """Print the tables for a task."""
    mpl.use("Agg")
    asked: Asked = []
    by = Question.by

    def kept(draw: Callable[[gc.Pencil], Reading], *args: Any, **kwargs: Any) -> Question:
        asked.append((by(draw, *args, **kwargs), draw))
        return asked[-1][0]

    Question.by = kept  # type: ignore[method-assign]
    type(gc.studio).__call__ = lambda *_, **__: None
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
        for each in (FOLDER / "hard_cases.toml", *task.parent.glob("*.csv")):
            shutil.copy(each, folder)
        shutil.copy(task, "task.toml")
        for script in sorted(FOLDER.glob("[0-9][0-9]_*.py")):
            asked.clear()
            names, checks, failed = executed(script)
            prompts = script.read_text(encoding="utf-8").count(".check(your_")
            said = f"{script.stem}: {prompts} prompts, {checks} checks of the prose, {failed} cells that do not hold"
            lines = [said]
            for question, draw in asked:
                name = next((name for name, found in names.items() if found is question), "?")
                shares = "  ".join(f"{line} mm {right_share(question, draw, line):.1%}" for line in LINES)
                lines.append(f"    {name:16s} right at {shares}")
            sys.stdout.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve() if len(sys.argv) > 1 else FOLDER / "task.toml")
