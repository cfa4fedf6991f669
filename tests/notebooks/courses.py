"""The notebooks of the course, executed once for all tests that look at them."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from nbformat import NotebookNode

from graphcam.notebooks.notebook_execution import execute
from graphcam.notebooks.notebook_folder import to_html

FOLDER = Path(__file__).parents[2] / "notebooks"
COURSE = sorted(path.stem for path in FOLDER.glob("[0-9][0-9]_*.py"))


@cache
def executed(name: str) -> NotebookNode:
    """A notebook with its outputs, from a clean kernel."""
    # The names of the notebooks are known without it.
    import jupytext

    return execute(jupytext.read(FOLDER / f"{name}.py"), FOLDER)


@cache
def page(name: str) -> str:
    """Its page."""
    return to_html(executed(name), name)
