"""What a step reads off the paper, as a reader writes it down: millimetres times a scale are a value."""

from dataclasses import dataclass, replace

import numpy as np

from graphcam.constructions.arc_roller import ArcStations
from graphcam.constructions.axes import station_names
from graphcam.drafting.ink import Caption, Construction, Step, say
from graphcam.drafting.scale import unit
from graphcam.given.laws import Floats
from graphcam.given.stations import Stations
from graphcam.words import Words

PAPER_UNIT = "mm of paper"
"""The unit of a reading that stands for nothing but its own length."""
ROUNDING = 1e-9
"""A length or an angle of less [mm or degrees] is rounding of the arithmetic."""


@dataclass(frozen=True, eq=False)
class ReadingRow:
    """One reading of a step in the first sample, as it is written down; angles are in degrees.

    paper : what was measured, () or (m,) [mm, or degrees of an angle that was measured itself]
    mu : what a millimetre stands for [``unit``/mm], None where what was measured is itself the value
    value : () or (m,) [``unit``];  unit : with "°" for an angle
    places : (m,) names of what the values belong to; empty for a scalar
    stations : whether these are stations
    judged : which of several values counts, as the meaning of the reading says
    """

    name: str
    title: Caption
    paper: Floats
    mu: float | None
    value: Floats
    unit: str
    places: tuple[Words, ...] = ()
    stations: bool = False
    judged: str = "extremes"

    @property
    def extremes(self) -> list[tuple[Caption, int]]:
        """The extremes that are told of several values, each with its place: minimum, maximum, or one of each sign."""
        least = say("minimum"), int(np.nanargmin(self.value))
        greatest = say("maximum"), int(np.nanargmax(self.value))
        if self.judged == "least" or self.value[greatest[1]] < 0:
            return [least]
        return [greatest] if self.value[least[1]] >= 0 else [least, greatest]

    def extreme_caption(self, what: Caption, place: int) -> Caption:
        """An extreme with its place, such as "minimum (station 4)"."""
        name = self.places[place]
        return say("{what} ({place})", what=what, place=say("station {name}", name=name) if self.stations else name)

    def caption(self, place: int | None = None) -> Caption:
        """The reading in one line, of an array the value at a ``place``."""
        at = () if place is None else (place,)
        paper, value = float(self.paper[at]), float(self.value[at])
        if self.mu is None:
            return say("{value:.2f}°", value=value) if self.unit == "°" else say("{paper:.2f} mm", paper=paper)
        if self.unit == "°":
            return say("{paper:.2f} mm × {mu:.5g}°/mm = {value:.5g}°", paper=paper, mu=self.mu, value=value)
        said = say("{paper:.2f} mm × {mu:.5g} {unit}/mm = {value:.5g} {unit}")
        if "/" in self.unit:
            said = say("{paper:.2f} mm × {mu:.5g} ({unit})/mm = {value:.5g} {unit}")
        return said.with_values(paper=paper, mu=self.mu, value=value, unit=unit(self.unit))


def rows(construction: Construction, step: Step) -> list[ReadingRow]:
    """The readings that a step of a construction takes; one that could not be read anywhere is left out.

    >>> import graphcam as gc
    >>> region = gc.solve(gc.builtin_task()).drawn["minimum_radius"]
    >>> for row in rows(region, region.steps()[-1]):
    ...     print(row.title, "=", row.caption())
    prime radius r₀ = 72.13 mm × 0.6 mm/mm = 43.28 mm
    offset e = -16.67 mm × 0.6 mm/mm = -10 mm
    distance s₀ = 70.18 mm × 0.6 mm/mm = 42.109 mm
    """
    found = [_row(construction, name) for name in step.reads]
    return [row for row in found if not np.isnan(row.paper).all()]


def _row(construction: Construction, name: str) -> ReadingRow:
    reading = construction.readings[name]
    # Not Construction.first: a place of the same name would come before the reading.
    paper = reading.paper[0] if construction.pencil.samples is not None else reading.paper
    paper = np.where(np.abs(paper) < ROUNDING, 0.0, paper)
    meaning = construction.meaning.reading(name)
    mu = reading.per_mm
    if reading.unit == PAPER_UNIT:
        row = ReadingRow(name, meaning.title, paper, None, paper, "mm")
    elif reading.unit == "rad":
        degrees = np.degrees(paper * mu)
        # An angle that was measured as such has the scale 1 on every sheet.
        measured, scale = (degrees, None) if mu == 1 else (paper, float(np.degrees(mu)))
        row = ReadingRow(name, meaning.title, measured, scale, degrees, "°")
    else:
        row = ReadingRow(name, meaning.title, paper, mu, paper * mu, reading.unit)
    if not paper.ndim:
        return row
    names = meaning.over(construction) if meaning.over else _stations(construction)
    # What its meaning does not tell, and is not over the stations, is counted.
    counted = tuple(str(k) for k in range(1, paper.size + 1)) if len(names) != paper.size else ()
    of_stations = meaning.over is None and not counted
    return replace(row, places=counted or tuple(names), stations=of_stations, judged=meaning.judged)


def _stations(construction: Construction) -> tuple[str, ...]:
    """The names of the stations that lie on a construction's board, or on that of those it started from."""
    for given in vars(construction.givens).values():
        if isinstance(given, Construction):
            if names := _stations(given):
                return names
        elif isinstance(given, Stations):
            return tuple(station_names(given))
        elif isinstance(given, ArcStations):
            return tuple(given.names)
    return ()
