"""What the built-in tasks and a given cam read and draw, as plain data, to hold against what they read and drew before.

``python tests/golden.py`` writes ``tests/golden.json`` anew: where a value, a mark or a caption is meant to change.
Of a mark or an entity stand what it is, its texts, and three sums of its coordinates, of which at least one changes
when any point of it moves.
"""

from __future__ import annotations

import json
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

import graphcam as gc
from graphcam.drafting.marks import Mark, Region
from graphcam.words import Caption

FILE = Path(__file__).with_name("golden.json")
BUILT_IN = Path(gc.__file__).parent / "data" / "tasks"
TASKS = {path.stem: path for path in (*sorted(BUILT_IN.glob("*.toml")), Path(__file__).with_name("given-cam.toml"))}
"""The built-in tasks, and one of a given cam, by name."""


def numbers(values: Any) -> list[float]:
    """Real numbers in a row, of complex ones the two parts; no minus zero."""
    flat = np.atleast_1d(np.asarray(values, dtype=complex if np.iscomplexobj(values) else float)).ravel()
    return [float(x) + 0.0 for x in (flat.view(float) if np.iscomplexobj(flat) else flat)]


def summary(value: Any) -> Any:
    """A mark or an entity as its class's name, its words, and its coordinates summed up."""
    if isinstance(value, np.ndarray):
        flat = np.array(numbers(value))
        # The cosine gives every coordinate a weight of its own, the square tells a swap of two from none.
        return [flat.size, float(flat.sum()), float(flat @ np.cos(np.arange(flat.size))), float(flat @ flat)]
    if isinstance(value, complex):
        return [value.real + 0.0, value.imag + 0.0]
    if isinstance(value, Caption):
        return str(value)
    if isinstance(value, Region):
        # Rounding may double a corner of it: what counts is how far it reaches.
        points = value.boundary
        return ["Region", *(float(x) for part in (points.real, points.imag) for x in (part.min(), part.max()))]
    if is_dataclass(value):
        # What a mark belongs to is no part of how it looks.
        left_out = {"of", "index", "spare", "axis"} if isinstance(value, Mark) else {"source"}
        parts = [getattr(value, field.name) for field in fields(value) if field.name not in left_out]
        return [type(value).__name__, *map(summary, parts)]
    if isinstance(value, tuple):
        return [summary(item) for item in value]
    return value if isinstance(value, int | float | None) else str(value)


def readings(drawn: gc.Construction) -> dict[str, list[Any]]:
    """Of each reading what was measured on the paper, the scale and the unit."""
    return {name: [numbers(read.paper), numbers(read.scale), read.unit] for name, read in drawn.readings.items()}


def construction(drawn: gc.Construction) -> dict[str, Any]:
    """The readings, the points and the steps."""
    return {
        "readings": readings(drawn),
        "points": {name: numbers(points) for name, points in drawn.points.items()},
        "steps": [
            [str(step.title), str(step.caption), step.view.name, [summary(mark) for mark in step.marks]]
            for step in drawn.steps()
        ],
    }


def sheet(solution: Any) -> list[dict[str, Any]]:
    """The pages of the finished sheet, group by group; entities of one class are summed up together."""
    from graphcam.report.documents import sheet_of

    def group(entities: tuple[Any, ...]) -> dict[str, Any]:
        kinds = sorted({type(entity).__name__ for entity in entities})
        return {kind: totals([e for e in entities if type(e).__name__ == kind]) for kind in kinds}

    return [{g.name: group(g.entities) for g in page.groups} for page in sheet_of(solution).pages]


def totals(entities: list[Any]) -> list[Any]:
    """How many there are, all their words, and the sums of all their numbers."""
    found: list[Any] = []

    def collect(value: Any) -> None:
        if isinstance(value, list):
            for item in value:
                collect(item)
        else:
            found.append(value)

    collect([summary(entity) for entity in entities])
    words = [value for value in found if isinstance(value, str)]
    sums = np.array([float(value) for value in found if isinstance(value, int | float)])
    return [len(entities), " ".join(words), float(sums.sum()), float(sums @ np.cos(np.arange(sums.size)))]


def solved(name: str) -> dict[str, Any]:
    """All of one task."""
    solution = gc.solve(gc.load_task(TASKS[name]))
    return {
        "constructions": {name: construction(drawn) for name, drawn in solution.drawn.items()},
        "quantities": solution.to_dict()["quantities"],
        "sheet": sheet(solution),
    }


def differences(before: Any, now: Any, tolerance: float, where: str = "") -> list[str]:
    """Where two values of plain data differ, numbers by more than the tolerance, of themselves if they are large.

    What has names is compared by name, in whatever order it comes.
    """
    if isinstance(before, dict) and isinstance(now, dict):
        if before.keys() != now.keys():
            return [f"{where}: {list(before)} became {list(now)}"]
        return [found for key in before for found in differences(before[key], now[key], tolerance, f"{where}/{key}")]
    if isinstance(before, list) and isinstance(now, list):
        if len(before) != len(now):
            return [f"{where}: {len(before)} items became {len(now)}"]
        pairs = enumerate(zip(before, now, strict=True))
        return [found for k, (old, new) in pairs for found in differences(old, new, tolerance, f"{where}/{k}")]
    if isinstance(before, float) and isinstance(now, float):
        alike = (np.isnan(before) and np.isnan(now)) or before == now
        near = abs(now - before) <= tolerance * max(1.0, abs(before))
        return [] if alike or near else [f"{where}: {before!r} became {now!r}"]
    return [] if before == now else [f"{where}: {before!r} became {now!r}"]


if __name__ == "__main__":
    text = json.dumps({name: solved(name) for name in TASKS}, ensure_ascii=False)
    FILE.write_text(text + "\n", encoding="utf-8")
