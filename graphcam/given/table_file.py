"""Tables of a measured motion, or of points of a cam, in CSV files: a header, then two numbers on every line.

The columns stand apart by commas, semicolons or tabs, as the header has them; a spreadsheet that separates them by
semicolons writes decimals with a comma, and both are read.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal, NamedTuple

import numpy as np

from graphcam.decoded_text import decoded_text
from graphcam.errors import DesignError, TaskError, unreadable_error
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
from graphcam.given.point_outline import cam_through_points
from graphcam.typed_words import names_of, plain
from graphcam.words import say

Column = Literal["s_mm", "s_deg", "a", "outline"]
_LENGTHS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "um": 1e-3, "in": 25.4, "mil": 0.0254, "thou": 0.0254}
_ANGLES = {"deg": 1.0, "rad": math.degrees(1)}
UNITS: dict[str, dict[str, float]] = {
    **dict.fromkeys(("x", "y", "radius"), _LENGTHS | {"": 1.0}),
    "angle": _ANGLES | {"": 1.0},
    "lift": _LENGTHS | _ANGLES,
    "a": {"": 1.0},
}
"""What a column has, and its units in mm or degrees; without one it is in mm or degrees."""
_HEAD = re.compile(r"(.+?)(?:(?:\s*[\[(]|[\s_,]+)([^\s_,()\[\]]+)[\])]?)?")
"""A name, and a unit behind it or in brackets."""
_HEADERS = "phi_deg,s_mm", "phi_deg,s_deg", "phi_deg,a", "x_mm,y_mm", "angle_deg,radius_mm"
"""Heads of tables, for a message; any unit may stand in place of these."""
_MAX_VALUES: dict[Column, float] = {
    "s_mm": PLAUSIBLE_RANGES["mm"][1],
    "s_deg": PLAUSIBLE_RANGES["degrees"][1],
    "a": PLAUSIBLE_RANGES["mm/rad^2"][1],
    "outline": PLAUSIBLE_RANGES["mm"][1],
}
"""The greatest magnitude of a value."""
ANGLE_CLOSURE = 1e-9
"""Angles that differ by no more [degrees] are the same."""
MISSING_VALUES = "n/a", "na", "nan", "null", "none", "-", "--", "#n/a", "?"
"""What stands in a table for a value that was not measured."""


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
    column : "s_mm", displacements; "s_deg", those of an arm; "a", accelerations per rad^2 in the same unit; "outline",
        points of a given cam
    rows : cam angle [degrees] and value, or x and y of a point [mm]
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
    # What programs write about the measurement stands above the header.
    before = next((k for k, line in enumerate(lines) if line.strip() and line[0] not in "#%"), 0)
    header, first_row = lines[before] if lines else "", before + 2
    between = next((sign for sign in ";\t" if sign in header), ",")
    heads = _heads(path, before + 1, header, between)
    below = enumerate(lines[before + 1 :], first_row)
    rows = tuple(_row(path, number, line, heads, between) for number, line in below)
    phi, values = np.array(rows).reshape(-1, 2).T
    try:
        if heads.column == "outline":
            cam_through_points(rows)
        else:
            closes_to = math.inf if heads.column == "a" else DEFAULT_TOLERANCE if tolerance is None else tolerance
            phi, values = turn(phi, values)
            check_rows(np.radians(phi), values, closes_to)
    except RowError as error:
        number = min(error.row, max(len(rows) - 1, 0)) + first_row
        line = say("line {number}: {quantity}", number=number, quantity=error.args[0])
        raise TaskError(path, line, *error.args[1:]) from None
    except DesignError as error:
        raise TaskError(path, *error.args) from None
    return CurveTable(name, heads.column, rows)


def _text(path: Path) -> str:
    try:
        content = path.read_bytes()
    except (OSError, ValueError) as error:
        raise unreadable_error(path, say("the table"), say("a CSV file"), error, say("check motion.table")) from None
    return decoded_text(path, say("the table"), content, say("a CSV file in UTF-8"), say("save it as CSV UTF-8"))


class _Head(NamedTuple):
    """The head of a column as it stands, what the column has, empty where that is not known, and its unit."""

    text: str
    column: str
    unit: str


class _Heads(NamedTuple):
    """The heads of a table: their names, what the values are, and the degrees or mm of their units.

    columns : where the two stand, and how many there are;  polar : whether points are given by angle and radius
    """

    names: tuple[str, str]
    column: Column
    factors: tuple[float, float]
    columns: tuple[int, int, int]
    polar: bool = False


def _head(text: str) -> _Head:
    """The head of a column, in the words and units that people type.

    >>> _head("X (mm)")[1:], _head("phi_deg")[1:], _head("Hub [mm]")[1:], _head("Winkel")[1:], _head("y_mm per rad")[1:]
    (('x', 'mm'), ('angle', 'deg'), ('lift', 'mm'), ('angle', ''), ('', ''))
    """
    for parts in ((text, ""), (match := _HEAD.fullmatch(text)) and match.groups("")):
        if parts and (name := next(iter(names_of(parts[0], "columns")), plain(parts[0]))) in UNITS:
            unit = next(iter(names_of(parts[1], "units")), parts[1].lower())
            if unit in UNITS[name]:
                return _Head(text, name, unit)
    return _Head(text, "", "")


def _heads(path: str, number: int, header: str, between: str) -> _Heads:
    found = [_head(cell) for cell in _cells(header, between)]
    named = [head.column for head in found]
    for names in (("x", "y"), ("angle", "radius"), ("angle", "lift"), ("angle", "a")):
        outline = names[1] in ("y", "radius")
        # Programs that write points have further columns, as z or the number of the point.
        if all(named.count(name) == 1 for name in names) and (outline or len(found) == 2):
            places = named.index(names[0]), named.index(names[1])
            first, second = (found[k] for k in places)
            of_arm: Column = "s_deg" if second.unit in _ANGLES else "s_mm"
            column: Column = "outline" if outline else "a" if second.column == "a" else of_arm
            factors = UNITS[first.column][first.unit], UNITS[second.column][second.unit]
            return _Heads((first.text, second.text), column, factors, (*places, len(found)), names[0] == "angle")
    expected = say("one of {headers}", headers=", ".join(f"'{head}'" for head in _HEADERS))
    line = say("line {number}", number=number)
    remedy = say("name the two columns of the table, with their units: mm, cm, in, thou, deg, rad")
    raise TaskError(path, line, _short_line(header), expected, remedy)


def _cells(line: str, between: str) -> list[str]:
    """The cells of a line, without spaces and quotes around them."""
    try:
        return [cell.strip() for row in csv.reader([line], delimiter=between) for cell in row]
    except csv.Error:
        return [line]


def _row(path: str, number: int, line: str, heads: _Heads, between: str) -> tuple[float, float]:
    """Cam angle [degrees] and value, or x and y of a point [mm]."""
    try:
        cells, (one, other, count) = _cells(line, between), heads.columns
        if len(cells) != count:
            raise ValueError(count)
        first, second = (float(cells[k].replace(",", ".")) for k in (one, other))
    except ValueError:
        first = second = math.nan
    if not (math.isfinite(first) and math.isfinite(second)):
        limit = say("two finite numbers, {angles} and {column}", angles=heads.names[0], column=heads.names[1])
        remedy = say("write decimals with a point, or separate the columns by semicolons")
        if any(not cell or cell.casefold() in MISSING_VALUES for cell in _cells(line, between)):
            remedy = say("delete the row: a value that was not measured is left out")
        raise TaskError(path, say("line {number}", number=number), _short_line(line), limit, remedy)
    factor = heads.factors[1]
    if abs(second * factor) > _MAX_VALUES[heads.column]:
        what = say("line {number}: {column}", number=number, column=heads.names[1])
        most = say("at most {most:.15g}", most=_MAX_VALUES[heads.column] / factor)
        raise TaskError(path, what, second, most, UNIT_REMEDY)
    first, second = first * heads.factors[0], second * factor
    if heads.column == "outline" and heads.polar:
        angle = math.radians(first)
        return second * math.cos(angle), second * math.sin(angle)
    return first, second


def _short_line(line: str) -> str:
    return line if len(line) <= 60 else line[:60] + "..."
