"""Measured figures and their goals: the rows of a module, and their place in the report."""

import math
import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from graphcam.bench.timing import Timer

SECONDS = {"µs": 1e-6, "ms": 1e-3, "s": 1.0}
"""Seconds of each unit in which a goal that is a time is written."""
_GOAL = re.compile(r"(?:(?P<sense>[<>]=) (?P<limit>\S+)|(?P<middle>\S+) ± (?P<room>\S+))(?: (?P<unit>.+))?")


@dataclass(frozen=True)
class BenchRow:
    """One measured figure.

    ratio : in ``unit``, or how many times faster
    goal : what it should keep to, "<= 0.7", ">= 10" or "2.00 ± 0.05"; the time itself where a unit of time follows, as
        in "<= 5 µs", else the ratio; "" for none
    error_eps : the rounding, None where it was not held against more digits
    seconds : on this machine, for the tables alone; NaN where nothing was timed
    """

    name: str
    what: str
    ratio: float
    unit: str
    goal: str
    error_eps: float | None
    seconds: float

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
        read = _GOAL.fullmatch(self.goal)
        if read is None or read["unit"] not in (None, self.unit, *SECONDS):
            raise ValueError(f"the goal {self.goal!r} of {self.name!r} cannot be read")
        figure = self.seconds / SECONDS[read["unit"]] if read["unit"] in SECONDS else self.ratio
        if read["middle"]:
            return abs(figure - float(read["middle"])) <= float(read["room"])
        return figure <= float(read["limit"]) if read["sense"] == "<=" else figure >= float(read["limit"])


@dataclass(frozen=True)
class Unit:
    """The time of n sines and n cosines, which other times are told in."""

    n: int
    seconds: float

    def row(self, name: str, what: str, seconds: float, goal: str = "", error_eps: float | None = None) -> BenchRow:
        """A time [s] in this unit."""
        return BenchRow(name, what, seconds / self.seconds, f"SC({self.n})", goal, error_eps, seconds)


@dataclass(frozen=True)
class Gauge:
    """What rows are measured with.

    stations : of the motion laws
    points : of the cam
    swept : designs of sweeps into files
    """

    timer: Timer
    stations: int
    points: int
    swept: tuple[int, ...] = ()

    def unit(self, n: int) -> Unit:
        """The time of n sines and cosines, measured now."""
        return Unit(n, self.timer.pairs(n))


@dataclass(frozen=True)
class Section:
    """A table of rows: its key in CSV and JSON, its title, what is said above it, and what measures it."""

    key: str
    title: str
    note: str
    measured: Callable[[Gauge], Iterable[BenchRow]]


def spoken_time(seconds: float) -> str:
    """Three digits of a time, in the unit that it is told in; nothing of what was not timed.

    >>> spoken_time(4.2e-05), spoken_time(0.0432), spoken_time(12.0)
    ('42 µs', '43.2 ms', '12 s')
    """
    if math.isnan(seconds):
        return ""
    unit = next((unit for unit, size in SECONDS.items() if seconds < 999.5 * size), "s")
    return f"{seconds / SECONDS[unit]:.3g} {unit}"
