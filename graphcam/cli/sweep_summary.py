"""The summary at the end of ``graphcam sweep``: how many designs satisfy the limits, the smallest, the Pareto front."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from graphcam.cli.command_language import translated
from graphcam.cli.shared import echo, print_file, print_table
from graphcam.files import whole_file
from graphcam.sweeps.pareto_front import ANGLE, FEASIBLE, SIZE_COLUMN, FoundBest, front_csv
from graphcam.words import Caption, say, say_many

if TYPE_CHECKING:
    from graphcam.sweeps.dataset import Summary
    from graphcam.sweeps.design_space import Space
    from graphcam.sweeps.sweep import Columns

MAX_TABLE_ROWS = 12
"""The maximum number of rows that are printed; the file has all."""


def print_sweep(space: Space, found: FoundBest | Summary) -> None:
    """Print how many designs satisfy the limits, the smallest of them, and the front as a table."""
    designs = say_many("{count} design", "{count} designs", found.designs)
    if found.feasible is None:
        echo(
            say('{designs}; to be told the best, put "{column}" among the quantities', designs=designs, column=FEASIBLE)
        )
        return
    echo(say("{designs}, {feasible} keep the limits", designs=designs, feasible=str(found.feasible)))
    if not found.feasible:
        echo(say("none keeps the limits: try larger prime radii or larger angles of rise and return"))
    elif found.front is not None:
        _print_front(space, found.front)


def _print_front(space: Space, front: Columns) -> None:
    shown = [name for name in dict.fromkeys((SIZE_COLUMN, *space.varied_columns, ANGLE)) if name in front]
    echo(say("the smallest: {values}", values=_first_values(front, shown)))
    count = front[SIZE_COLUMN].size
    if count == 1:
        return
    same = [name for name in shown if np.all(front[name] == front[name][0])]
    differing = [name for name in shown if name not in same]
    rows = np.unique(np.linspace(0, count - 1, min(count, MAX_TABLE_ROWS)).round().astype(int)).tolist()
    title = say("No design is both smaller and of a smaller pressure angle than one of these:")
    if same:
        title = say(
            "No design is both smaller and of a smaller pressure angle than one of these, all with {values}:",
            values=_first_values(front, same),
        )
    part = say(
        "{shown} of {count}, from the smallest to that of the minimum angle", shown=str(len(rows)), count=str(count)
    )
    print_table(
        [_short_name(name) for name in differing],
        [[_value(front, name, row) for name in differing] for row in rows],
        words=0,
        title=f"\n{translated(title)}",
        caption=translated(part) if len(rows) < count else "",
    )


def write_front(space: Space, out: str, front: Columns | None) -> None:
    """Write the front beside a file of results, or into a folder of them, as a table and as a figure.

    Raises
    ------
    OutputError : a file cannot be written
    """
    from graphcam.sweeps.dataset import is_file
    from graphcam.sweeps.shared_folder import SharedFolder

    if front is None or not front[SIZE_COLUMN].size:
        return
    for ending, text, what in _front_files(space, front):
        if is_file(out):
            path = Path(out).with_name(f"{Path(out).stem}-front{ending}")
            with whole_file(path) as draft:
                draft.write_text(text, encoding="utf-8", newline="")
            print_file(path, what)
        else:
            # Readers of data sets pass over what begins so.
            name = f"_front{ending}"
            with SharedFolder.open_folder(out).open_for_writing(name) as file:
                file.write(text.encode())
            echo(f"{out.rstrip('/')}/{name}: {translated(what)}")


def _front_files(space: Space, front: Columns) -> Iterator[tuple[str, str, Caption]]:
    """Ending, text and description of each file of a front; the figure only if it has more than one design."""
    yield ".csv", front_csv(front), say("these designs with all their quantities")
    if front[SIZE_COLUMN].size > 1:
        # Loads matplotlib.
        from graphcam.plots.figures import figure_svg
        from graphcam.plots.front_figure import front_figure

        limit = float(np.degrees(space.limits(space.follower).rise))
        yield ".svg", figure_svg(front_figure(front, limit)), say("their pressure angle over their size, as a figure")


def _first_values(front: Columns, names: list[str]) -> str:
    return ", ".join(f"{_short_name(name)} {_value(front, name, 0)}" for name in names)


def _short_name(name: str) -> str:
    """A column's name in the table, short enough for a terminal.

    >>> _short_name("max_pressure_angle_rise_deg"), _short_name("rise_angle_deg"), _short_name("offset")
    ('pressure_angle', 'rise_angle', 'offset')
    """
    return "pressure_angle" if name == ANGLE else name.removesuffix("_deg")


def _value(front: Columns, name: str, row: int) -> str:
    value = front[name][row]
    return str(value) if front[name].dtype.kind == "U" else f"{value:.5g}"
