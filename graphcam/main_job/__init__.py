"""The main job: from a task to a solution, and from a solution to its files."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from graphcam.main_job.arcs import ArcsSolution
    from graphcam.main_job.kinds import sheet_of, solve, worksheet
    from graphcam.main_job.output import check_papers, write
    from graphcam.main_job.solution import Solution

__all__ = ["ArcsSolution", "Solution", "check_papers", "sheet_of", "solve", "worksheet", "write"]

_WHEN_USED = {
    "ArcsSolution": "arcs", "Solution": "solution", "check_papers": "output", "sheet_of": "kinds", "solve": "kinds",
    "worksheet": "kinds", "write": "output",
}  # fmt: skip
"""Where the names stand: who only wants the drawing board of a task does not load all that solves and writes."""


def __getattr__(name: str) -> Any:
    if name not in _WHEN_USED:
        raise AttributeError(f"module 'graphcam.main_job' has no attribute '{name}'")
    value = globals()[name] = getattr(import_module(f"graphcam.main_job.{_WHEN_USED[name]}"), name)
    return value
