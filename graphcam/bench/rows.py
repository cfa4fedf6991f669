"""What the report is made of: sections, and the rows of measured figures with their goals.

A section is declared once, beside what measures it, and so is a row; tables, CSV, JSON and goals follow from them.
"""

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any

from graphcam.bench.timing import Timer
from graphcam.words import Caption

SECONDS_BY_UNIT = {"µs": 1e-6, "ms": 1e-3, "s": 1.0}
"""Seconds of each unit in which a goal that is a time is written."""
EMPTY_CELL = "–"
GOAL = re.compile(r"(?P<sense><=|>=|\S+ ±) (?P<limit>\S+)(?: (?P<unit>.+))?")
Parts = tuple[int, ...]
"""Numbers of parts a phase, or of stations."""
Line = Mapping[str, str | int | float | None]
"""A line of the long table of numbers, by the names of its columns."""


@dataclass(frozen=True)
class BenchRow:
    """One measured figure with its goal.

    ratio : in ``unit``, or how many times faster
    goal : what it should keep to, "<= 0.7", ">= 10" or "2.00 ± 0.05"; the time itself where a unit of time follows, as
        in "<= 5 µs", else the ratio; "" for none
    error_eps : the rounding, None where it was not held against more digits
    seconds : on this machine, for the tables alone; NaN where nothing was timed
    missing : what stands in the way of the goal, where this is known
    """

    name: str
    what: str
    ratio: float
    unit: str
    goal: str = ""
    error_eps: float | None = None
    seconds: float = math.nan
    missing: str = ""

    @property
    def goal_met(self) -> bool | None:
        """Whether the figure keeps to its goal; None without one.

        >>> BenchRow("law", "f", 0.8, "SC(360)", "<= 0.7", None, 4e-6).goal_met
        False
        >>> BenchRow("law", "f", 0.8, "SC(360)", "<= 5 µs", None, 4e-6).goal_met
        True

        Raises
        ------
        ValueError : the goal is none of the three forms, or in a unit that is neither the row's nor one of time
        """
        if not self.goal:
            return None
        figure, sense, limit = self._against_goal()
        match sense:
            case "<=":
                return figure <= limit
            case ">=":
                return figure >= limit
            case middle:
                return abs(figure - float(middle.removesuffix(" ±"))) <= limit

    def _against_goal(self) -> tuple[float, str, float]:
        """The figure that the goal is about, and the goal's sense and limit."""
        read = GOAL.fullmatch(self.goal)
        if read is None or read["unit"] not in (None, self.unit, *SECONDS_BY_UNIT):
            raise ValueError(f"the goal {self.goal!r} of {self.name!r} cannot be read")
        figure = self.seconds / SECONDS_BY_UNIT[read["unit"]] if read["unit"] in SECONDS_BY_UNIT else self.ratio
        return figure, read["sense"], float(read["limit"])

    @property
    def verdict(self) -> str:
        """Whether the goal is met, and how far off is one that is not.

        >>> BenchRow("law", "f", 0.8, "SC(360)", "<= 0.5").verdict
        'no: 1.6 times'
        """
        if self.goal_met is not False:
            return "yes" if self.goal_met else ""
        figure, sense, limit = self._against_goal()
        return f"no: {figure / limit:.2g} times" if limit and sense in ("<=", ">=") else "no"

    @property
    def explanation(self) -> str:
        """What was measured, and where its goal is missed what stands in the way."""
        return f"{self.what}; {self.missing}" if self.missing and self.goal_met is False else self.what


@dataclass(frozen=True)
class Unit:
    """What a time is told in: a unit of time, sines and cosines, or the time of what it is compared with."""

    name: str
    seconds: float

    def row(
        self, name: str, what: str, seconds: float, goal: str = "", error_eps: float | None = None, missing: str = ""
    ) -> BenchRow:
        """A time [s] in this unit."""
        return BenchRow(name, what, seconds / self.seconds, self.name, goal, error_eps, seconds, missing)


MILLISECONDS = Unit("ms", 1e-3)


def faster_than(ours: float) -> Unit:
    """How many times as long a rival takes."""
    return Unit("times faster", ours)


@dataclass(frozen=True)
class Effort:
    """How much is measured: parts, laws and hands, stations of laws and of cams, designs of sweeps into files.

    sizes : the numbers of parts or stations in which methods are timed, by the kind of method
    motions : random ones that are measured with noise
    budget, least_runs : seconds, and runs at least, for every measurement of a time
    """

    parts: Parts
    laws: tuple[str, ...]
    hands: int
    pencil_parts: Parts
    sizes: Mapping[str, Parts]
    law_stations: int
    cam_stations: int
    budget: float
    swept: Parts = ()
    least_runs: int = 3
    motions: int = 100

    @cached_property
    def timer(self) -> Timer:
        """The timer of this effort."""
        return Timer(self.budget, self.least_runs)

    @cached_property
    def pair(self) -> float:
        """The time of one sine and one cosine on this machine [s], the unit of all times."""
        return self.timer.pairs(100_000) / 100_000

    def unit(self, n: int, times: int = 1) -> Unit:
        """The time of n sines and cosines, measured now, over several times as many where these are few."""
        return Unit(f"SC({n})", self.timer.pairs(n * times) / times)


def time_text(seconds: float) -> str:
    """Three digits of a time, in the unit that it is told in; nothing of what was not timed.

    >>> time_text(4.2e-05), time_text(0.0432), time_text(12.0)
    ('42 µs', '43.2 ms', '12 s')
    """
    if math.isnan(seconds):
        return ""
    unit = next((unit for unit, size in SECONDS_BY_UNIT.items() if seconds < 999.5 * size), "s")
    return f"{seconds / SECONDS_BY_UNIT[unit]:.3g} {unit}"


def _texts_of_rows(rows: Sequence[BenchRow], _: float) -> Iterator[list[str]]:
    yield ["what", "of what", "ratio", "goal", "goal met", "here", "eps"]
    for r in rows:
        ratio, rounding = f"{r.ratio:.3g} {r.unit}", "" if r.error_eps is None else f"{r.error_eps:.1f}"
        yield [r.name, r.explanation, ratio, r.goal, r.verdict, time_text(r.seconds), rounding]


def _line_of_row(r: BenchRow) -> Iterator[Line]:
    """The line of a measured figure in the long table, with its goal."""
    found = {"error": r.error_eps, "error_unit": "eps", "ratio": r.ratio, "ratio_unit": r.unit}
    yield {"subject": r.name, "quantity": r.what, **found, "goal": r.goal, "goal_met": r.verdict.partition(":")[0]}


@dataclass(frozen=True)
class Section:
    """A table of the report, by default one of :class:`BenchRow`.

    key : in JSON and CSV
    note : what is said above the table
    measured : gives its records
    texts : head and rows of the records, told where a pair of a sine and a cosine takes so long [s]
    lines : the lines of a record in the long table of numbers
    derived : properties of a record that JSON tells with its fields
    words : so many first columns hold words, the others numbers
    brief : whether it goes to the terminal too
    """

    key: str
    title: Caption
    note: str
    measured: Callable[[Effort], Iterable[Any]]
    texts: Callable[[Sequence[Any], float], Iterable[list[str]]] = _texts_of_rows
    lines: Callable[[Any], Iterable[Line]] = _line_of_row
    derived: tuple[str, ...] = ("goal_met", "verdict")
    words: int = 2
    brief: bool = True

    def to_dict(self, record: Any) -> dict[str, Any]:
        """Ratios and errors of a record as plain data: no seconds are kept."""
        fields = asdict(record) | {name: getattr(record, name) for name in self.derived}
        return {name: value for name, value in fields.items() if name != "seconds"}
