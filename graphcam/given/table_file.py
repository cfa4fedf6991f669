"""Tables of a measured motion in CSV files: a header, then a cam angle and a value on every line.

The columns stand apart by commas, semicolons or tabs, as the header has them; a spreadsheet that separates them by
semicolons writes decimals with a comma, and both are read.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np

from graphcam.errors import TaskError, unreadable_error
from graphcam.given.laws import Floats
from graphcam.given.measured import (
    DEFAULT_TOLERANCE,
    MeasuredMotion,
    RowError,
    check_rows,
    integrated_motion,
    measured_motion,
)
from graphcam.given.plausible_ranges import PLAUSIBLE_RANGES, UNIT_REMEDY
from graphcam.words import say

Column = Literal["s_mm", "s_deg", "a"]
ANGLE_COLUMNS = {"phi_deg": 1.0, "phi_rad": math.degrees(1)}
"""Heads of the cam angles, and the degrees of their unit."""
VALUE_COLUMNS: dict[str, tuple[Column, float]] = {
    **{column: (column, 1.0) for column in get_args(Column)},
    "s_in": ("s_mm", 25.4),
    "s_thou": ("s_mm", 0.0254),
}
"""Heads of the values: what they are, and the mm (or degrees) of their unit; "thou" are thousandths of an inch."""
_HEADERS = ", ".join(f"'phi_deg,{column}'" for column in VALUE_COLUMNS)
_MAX_VALUES = {
    "s_mm": PLAUSIBLE_RANGES["mm"][1],
    "s_deg": PLAUSIBLE_RANGES["degrees"][1],
    "a": PLAUSIBLE_RANGES["mm/rad^2"][1],
}
"""The greatest magnitude of a value."""
ANGLE_CLOSURE = 1e-9
"""Angles that differ by no more [degrees] are the same."""
_FIRST_ROW = 2
"""Line of the first row, below the header."""


@dataclass(frozen=True)
class Turn:
    """Which part of the cam's turn the rows of a table are.

    symmetric : they are half of a cam, which goes back in mirror image and dwells for the rest of the turn
    per_cam_degree : so many degrees of the table are one of the cam, as 2 crank degrees of a four-stroke engine

    >>> phi, s = Turn(symmetric=True)(np.array([0.0, 45.0, 90.0]), np.array([0.0, 1.0, 4.0]))
    >>> phi.tolist(), s.tolist()
    ([0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 360.0], [0.0, 1.0, 4.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    """

    symmetric: bool = False
    per_cam_degree: float = 1.0

    @classmethod
    def given_in(cls, motion: Mapping[str, Any]) -> Turn:
        """What a file's table ``[motion]`` says; what is wrong with its fields is told when the task is read."""
        per = motion.get("per_cam_degree", 1.0)
        sound = isinstance(per, int | float) and 0 < per < math.inf
        return cls(motion.get("symmetric") is True, float(per) if sound else 1.0)

    def __call__(self, phi: Floats, values: Floats) -> tuple[Floats, Floats]:
        """The rows of the whole turn, in degrees of the cam."""
        phi = phi / self.per_cam_degree
        if not self.symmetric or phi.size < 2:
            return phi, values
        left, step = 360 - 2 * (phi[-1] - phi[0]), float(np.max(np.diff(phi)))
        if left < -ANGLE_CLOSURE:
            limit, half = say("at most 180 degrees"), say("{degrees:g} degrees", degrees=phi[-1] - phi[0])
            raise RowError(phi.size - 1, say("half of the cam"), half, limit, say("leave motion.symmetric out"))
        phi, values = np.append(phi, 2 * phi[-1] - phi[-2::-1]), np.append(values, values[-2::-1])
        if left <= ANGLE_CLOSURE:
            return phi, values
        # A dwell at the level of the first row.
        rest = np.linspace(phi[-1], phi[-1] + left, max(round(left / step), 1) + 1)[1:]
        return np.append(phi, rest), np.append(values, np.full(rest.size, values[0]))


WHOLE_TURN = Turn()


@dataclass(frozen=True)
class CurveTable:
    """What a CSV file says of a motion.

    file : its name, as the task gives it
    column : "s_mm", displacements; "s_deg", those of an arm; "a", accelerations per rad^2 in the same unit
    rows : cam angle [degrees] and value
    """

    file: str
    column: Column
    rows: tuple[tuple[float, float], ...]

    def __call__(self, tolerance: float | None = None, unit: float = 1.0, turn: Turn = WHOLE_TURN) -> MeasuredMotion:
        """The motion through the rows.

        tolerance : how far it may pass a displacement, in the unit of the table; None is 0.01
        unit : what one unit of displacement is in the API: 1 mm, or for an arm 1 degree in radians
        turn : which part of the turn the rows are
        """
        return _motion(self, DEFAULT_TOLERANCE if tolerance is None else tolerance, unit, turn)


@lru_cache(maxsize=16)  # because a task asks for its motion in several places, and the fit takes its time
def _motion(table: CurveTable, tolerance: float, unit: float, turn: Turn) -> MeasuredMotion:
    phi, values = turn(*np.transpose(table.rows))
    made = integrated_motion if table.column == "a" else measured_motion
    return made(np.radians(phi), values * unit, tolerance * unit)


def read_table(path: Path, name: str, tolerance: float | None = None, turn: Turn = WHOLE_TURN) -> CurveTable:
    """The table in a CSV file.

    path : where the file is;  name : how the task calls it
    tolerance : how far the last row may miss the first where it repeats it a turn later; None is 0.01
    turn : which part of the turn the rows are

    Raises
    ------
    TaskError : there is no such file, or a line of it is wrong; the first is named
    """
    return table_from_text(_text(path), name, str(path), tolerance, turn)


def table_from_text(
    text: str, name: str, path: str, tolerance: float | None = None, turn: Turn = WHOLE_TURN
) -> CurveTable:
    r"""The table in the text of a CSV file.

    path : how messages call it;  name, tolerance, turn : as for :func:`read_table`

    Raises
    ------
    TaskError : a line of it is wrong; the first is named

    >>> rows = "".join(f"{15 * k},{min(k, 12)}\n" for k in range(24))
    >>> table_from_text("phi_deg,a\n" + rows, "a.csv", "a.csv").rows[:2]
    ((0.0, 0.0), (15.0, 1.0))
    >>> table_from_text(("phi_deg,a\n" + rows).replace(",", ";"), "a.csv", "a.csv").rows[:2]
    ((0.0, 0.0), (15.0, 1.0))
    """
    lines = text.rstrip().splitlines()
    header = lines[0] if lines else ""
    between = next((sign for sign in ";\t" if sign in header), ",")
    heads = _heads(path, header, between)
    column, factors = VALUE_COLUMNS[heads[1]][0], (ANGLE_COLUMNS[heads[0]], VALUE_COLUMNS[heads[1]][1])
    rows = tuple(_row(path, number, line, heads, between) for number, line in enumerate(lines[1:], _FIRST_ROW))
    rows = tuple((phi * factors[0], value * factors[1]) for phi, value in rows)
    phi, values = np.array(rows).reshape(-1, 2).T
    try:
        closes_to = math.inf if column == "a" else DEFAULT_TOLERANCE if tolerance is None else tolerance
        phi, values = turn(phi, values)
        check_rows(np.radians(phi), values, closes_to)
    except RowError as error:
        number = min(error.row, max(len(rows) - 1, 0)) + _FIRST_ROW
        line = say("line {number}: {quantity}", number=number, quantity=error.args[0])
        raise TaskError(path, line, *error.args[1:]) from None
    return CurveTable(name, column, rows)


def _text(path: Path) -> str:
    try:
        content = path.read_bytes()
    except (OSError, ValueError) as error:
        raise unreadable_error(path, say("the table"), say("a CSV file"), error, say("check motion.table")) from None
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line, wrong = content.count(b"\n", 0, error.start) + 1, content[error.start : error.start + 1]
        what = say("line {line}", line=line)
        raise TaskError(str(path), what, wrong, say("text in UTF-8"), say("save the file as UTF-8")) from None


def _heads(path: str, header: str, between: str) -> tuple[str, str]:
    names = _cells(header, between)
    if len(names) == 2 and names[0] in ANGLE_COLUMNS and names[1] in VALUE_COLUMNS:
        return names[0], names[1]
    expected = say("one of {headers}", headers=_HEADERS)
    raise TaskError(path, say("line 1"), _short_line(header), expected, say("name the two columns of the table"))


def _cells(line: str, between: str) -> list[str]:
    """The cells of a line, without spaces and quotes around them."""
    try:
        return [cell.strip() for row in csv.reader([line], delimiter=between) for cell in row]
    except csv.Error:
        return [line]


def _row(path: str, number: int, line: str, heads: tuple[str, str], between: str) -> tuple[float, float]:
    try:
        phi, value = (float(cell.replace(",", ".")) for cell in _cells(line, between))
    except ValueError:
        phi = value = math.nan
    if not (math.isfinite(phi) and math.isfinite(value)):
        limit = say("two finite numbers, {angles} and {column}", angles=heads[0], column=heads[1])
        remedy = say("write decimals with a point, or separate the columns by semicolons")
        raise TaskError(path, say("line {number}", number=number), _short_line(line), limit, remedy)
    column, factor = VALUE_COLUMNS[heads[1]]
    if abs(value * factor) > _MAX_VALUES[column]:
        what = say("line {number}: {column}", number=number, column=heads[1])
        raise TaskError(path, what, value, say("at most {most:.15g}", most=_MAX_VALUES[column] / factor), UNIT_REMEDY)
    return phi, value


def _short_line(line: str) -> str:
    return line if len(line) <= 60 else line[:60] + "..."
