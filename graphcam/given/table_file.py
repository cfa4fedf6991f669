"""Tables of a measured motion in CSV files: a header, then a cam angle and a value on every line.

The columns stand apart by commas, semicolons or tabs, as the header has them; a spreadsheet that separates them by
semicolons writes decimals with a comma, and both are read.
"""

import csv
import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Literal, get_args

import numpy as np

from graphcam.errors import TaskError, unreadable_error
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
ANGLE_COLUMN = "phi_deg"
_HEADERS = ", ".join(f"'{ANGLE_COLUMN},{column}'" for column in get_args(Column))
_MAX_VALUES = {
    "s_mm": PLAUSIBLE_RANGES["mm"][1],
    "s_deg": PLAUSIBLE_RANGES["degrees"][1],
    "a": PLAUSIBLE_RANGES["mm/rad^2"][1],
}
"""The greatest magnitude of a value."""
_FIRST_ROW = 2
"""Line of the first row, below the header."""


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

    def __call__(self, tolerance: float | None = None, unit: float = 1.0) -> MeasuredMotion:
        """The motion through the rows.

        tolerance : how far it may pass a displacement, in the unit of the table; None is 0.01
        unit : what one unit of displacement is in the API: 1 mm, or for an arm 1 degree in radians
        """
        return _motion(self, DEFAULT_TOLERANCE if tolerance is None else tolerance, unit)


@lru_cache(maxsize=16)  # because a task asks for its motion in several places, and the fit takes its time
def _motion(table: CurveTable, tolerance: float, unit: float) -> MeasuredMotion:
    phi, values = np.transpose(table.rows)
    made = integrated_motion if table.column == "a" else measured_motion
    return made(np.radians(phi), values * unit, tolerance * unit)


def read_table(path: Path, name: str, tolerance: float | None = None) -> CurveTable:
    """The table in a CSV file.

    path : where the file is;  name : how the task calls it
    tolerance : how far the last row may miss the first where it repeats it a turn later; None is 0.01

    Raises
    ------
    TaskError : there is no such file, or a line of it is wrong; the first is named
    """
    return table_from_text(_text(path), name, str(path), tolerance)


def table_from_text(text: str, name: str, path: str, tolerance: float | None = None) -> CurveTable:
    r"""The table in the text of a CSV file.

    path : how messages call it;  name, tolerance : as for :func:`read_table`

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
    column = _column(path, header, between)
    rows = tuple(_row(path, number, line, column, between) for number, line in enumerate(lines[1:], _FIRST_ROW))
    phi, values = np.array(rows).reshape(-1, 2).T
    try:
        closes_to = math.inf if column == "a" else DEFAULT_TOLERANCE if tolerance is None else tolerance
        check_rows(np.radians(phi), values, closes_to)
    except RowError as error:
        line = say("line {number}: {quantity}", number=error.row + _FIRST_ROW, quantity=error.args[0])
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


def _column(path: str, header: str, between: str) -> Column:
    names = _cells(header, between)
    for column in get_args(Column):
        if names == [ANGLE_COLUMN, column]:
            return column
    expected = say("one of {headers}", headers=_HEADERS)
    raise TaskError(path, say("line 1"), _short_line(header), expected, say("name the two columns of the table"))


def _cells(line: str, between: str) -> list[str]:
    """The cells of a line, without spaces and quotes around them."""
    try:
        return [cell.strip() for row in csv.reader([line], delimiter=between) for cell in row]
    except csv.Error:
        return [line]


def _row(path: str, number: int, line: str, column: Column, between: str) -> tuple[float, float]:
    try:
        phi, value = (float(cell.replace(",", ".")) for cell in _cells(line, between))
    except ValueError:
        phi = value = math.nan
    if not (math.isfinite(phi) and math.isfinite(value)):
        limit = say("two finite numbers, {angles} and {column}", angles=ANGLE_COLUMN, column=column)
        remedy = say("write decimals with a point, or separate the columns by semicolons")
        raise TaskError(path, say("line {number}", number=number), _short_line(line), limit, remedy)
    if abs(value) > _MAX_VALUES[column]:
        what = say("line {number}: {column}", number=number, column=column)
        raise TaskError(path, what, value, say("at most {most:.15g}", most=_MAX_VALUES[column]), UNIT_REMEDY)
    return phi, value


def _short_line(line: str) -> str:
    return line if len(line) <= 60 else line[:60] + "..."
