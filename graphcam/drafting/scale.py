"""Scale factors, machine units per millimetre of paper, and the units by their names in readings and files."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import check_number
from graphcam.typed_words import table
from graphcam.words import Caption, Words, say

Ratios = tuple[float, ...]
"""Drawing scales, paper over machine, the largest first."""
GOST_2_302: Ratios = (
    *(100.0, 50.0, 40.0, 20.0, 10.0, 5.0, 4.0, 2.5, 2.0, 1.0),
    *(1 / 2, 1 / 2.5, 1 / 4, 1 / 5, 1 / 10, 1 / 15, 1 / 20, 1 / 25, 1 / 40, 1 / 50, 1 / 75),
    *(1 / 100, 1 / 200, 1 / 400, 1 / 500, 1 / 800, 1 / 1000),
)
ISO_5455: Ratios = (
    *(100.0, 50.0, 20.0, 10.0, 5.0, 2.0, 1.0),
    *(1 / 2, 1 / 5, 1 / 10, 1 / 20, 1 / 50, 1 / 100, 1 / 200, 1 / 500, 1 / 1000),
)
"""The standard's scales, its series continued to 100:1."""
STANDARD_RATIOS = {"gost": GOST_2_302, "iso": ISO_5455}
"""The standard scales, by the frame of the sheet."""


RATIO_PATTERN = re.compile(r"(\d+(?:[.,]\d+)?)\s*[:：]\s*(\d+(?:[.,]\d+)?)")
"""A drawing scale as people write it, decimals with a point or a comma."""


@dataclass(frozen=True)
class Scale:
    """mu = ``per_mm`` machine units of ``unit`` for one millimetre of paper.

    >>> import graphcam as gc
    >>> gc.Scale(0.6, "mm").value(50), gc.Scale(0.6, "mm").paper(30)
    (30.0, 50.0)
    """

    per_mm: float
    unit: str
    left_out = 0.0
    """The part of the whole that shortened stretches of an axis leave out."""

    def __post_init__(self) -> None:
        limit = say("a finite number of {unit} per mm greater than 0", unit=self.unit)
        check_number("scale", self.per_mm, limit, above=0)

    def value(self, paper: Any) -> Any:
        """The machine value of a length on paper, or several: mu times mm."""
        return self.per_mm * paper

    def paper(self, value: Any) -> Any:
        """The length on paper of a machine value, or several [mm]."""
        return value / self.per_mm

    @property
    def middles(self) -> list[float]:
        """The middles of the stretches of an axis that are shortened [mm of paper]."""
        return []

    def shows(self, values: ArrayLike) -> NDArray[np.bool_]:
        """Whether values can be read on an axis, outside of its shortened stretches."""
        return np.ones(np.shape(values), dtype=bool)


@dataclass(frozen=True)
class BrokenScale(Scale):
    """A scale along an axis of which some stretches are drawn shortened, each between two break strokes.

    Lengths outside of them have the scale ``per_mm``; places are mapped by :meth:`paper` and :meth:`value`, through the
    ends of all stretches.

    values : (k,) machine values of the ends of the stretches, ascending from 0
    places : (k,) their places [mm of paper]
    broken : the stretches that are shortened, by their numbers

    >>> axis = BrokenScale(2.0, "mm", (0.0, 40.0, 140.0, 160.0), (0.0, 20.0, 30.0, 40.0), (1,))
    >>> axis.paper([40.0, 150.0]).tolist(), axis.value([25.0]).tolist(), axis.middles, axis.left_out
    ([20.0, 35.0], [90.0], [25.0], 80.0)
    >>> axis.shows([30.0, 90.0, 140.0]).tolist()
    [True, False, True]
    """

    values: tuple[float, ...]
    places: tuple[float, ...]
    broken: tuple[int, ...]

    def paper(self, value: Any) -> Any:
        """The places on paper of machine values."""
        return np.interp(value, self.values, self.places)

    def value(self, paper: Any) -> Any:
        """The machine values of places on paper."""
        return np.interp(paper, self.places, self.values)

    @property
    def middles(self) -> list[float]:
        """The middles of the shortened stretches [mm of paper]."""
        return [(self.places[k] + self.places[k + 1]) / 2 for k in self.broken]

    @property
    def left_out(self) -> float:  # pyright: ignore[reportIncompatibleVariableOverride]
        """The part of the whole that the shortened stretches leave out."""
        return self.values[-1] - self.per_mm * self.places[-1]

    def shows(self, values: ArrayLike) -> NDArray[np.bool_]:
        """Whether values lie outside the shortened stretches, where they can be read."""
        at = np.asarray(values)
        inside = [(at > self.values[k]) & (at < self.values[k + 1]) for k in self.broken]
        return ~np.any(inside, axis=0)


def standard_scale(size: float, room: float, ratios: Ratios) -> Scale:
    """The largest standard drawing scale at which ``size`` mm of machine fit into ``room`` mm of paper.

    >>> standard_scale(150, 310, GOST_2_302).per_mm
    0.5
    >>> standard_scale(100, 250, GOST_2_302).per_mm, standard_scale(100, 250, ISO_5455).per_mm
    (0.4, 0.5)
    """
    for ratio in ratios:
        if size * ratio <= room:
            return Scale(1 / ratio, "mm")
    # Beyond the standard series: powers of ten go on for ever.
    return Scale(10.0 ** math.ceil(math.log10(size / room)), "mm")


NO_HELD_SCALES: Mapping[str, float] = {}
"""No view keeps its scale."""


@dataclass(frozen=True)
class Paper:
    """The room of a view on the sheet [mm of paper], and the standard drawing scales.

    bounded : whether a view has no other place on the sheet, so that nothing beside it may go beyond the room
    held : scales [mm/mm] that views keep from an earlier drawing, by name, whatever would fit now

    >>> Paper(200, 100, ISO_5455).scale(complex(30, 20)).per_mm
    0.2
    """

    width: float
    height: float
    ratios: Ratios
    bounded: bool = True
    held: Mapping[str, float] = field(default_factory=lambda: NO_HELD_SCALES, hash=False)

    def kept_scale(self, view: str) -> Scale | None:
        """The scale that the view of that name keeps, None if it keeps none."""
        return Scale(self.held[view], "mm") if view in self.held else None

    def scale(self, size: complex, beside: complex = 0j) -> Scale:
        """The largest standard scale for a view ``size`` mm of machine wide + i high.

        beside : what stands around it and does not grow with it [mm of paper], wide + i high
        """
        across = standard_scale(size.real, self.width - beside.real, self.ratios)
        return coarsest_scale(across, standard_scale(size.imag, self.height - beside.imag, self.ratios))


UNLIMITED = Paper(math.inf, math.inf, GOST_2_302)
"""Paper without bounds, for what is drawn on no sheet."""


def coarsest_scale(*scales: Scale) -> Scale:
    """The scale with the most machine units per millimetre, at which things are drawn smallest."""
    return max(scales, key=lambda scale: scale.per_mm)


def ratio_from_text(text: str) -> float | None:
    """The machine units per millimetre of paper of a drawing scale that a text tells; None if it tells none.

    >>> ratio_from_text("2:1"), ratio_from_text("M 1:2,5"), ratio_from_text("none")
    (0.5, 2.5, None)
    """
    found = RATIO_PATTERN.search(text)
    paper, machine = (float(number.replace(",", ".")) for number in found.groups()) if found else (0.0, 0.0)
    return machine / paper if paper and machine else None


def ratio_text(per_mm: float) -> Caption:
    """A drawing scale as a title block gives it.

    >>> [str(ratio_text(per_mm)) for per_mm in (0.5, 2.5, 1.0)]
    ['2:1', '1:2.5', '1:1']
    """
    return say("{times:g}:1", times=1 / per_mm) if per_mm < 1 else say("1:{times:g}", times=per_mm)


UNITS: Mapping[str, Caption] = {
    str(unit): unit
    for unit in (
        *(say("mm"), say("mm/rad"), say("mm/rad²"), say("mm/rad³"), say("rad"), say("rad/rad"), say("rad/rad²")),
        *(say("rad/rad³"), say("deg"), say("m/s³"), say("rad/s³")),
        *(say("mm of paper"), say("m"), say("s"), say("m/s"), say("m/s²"), say("rad/s"), say("rad/s²"), say("N")),
        *(say("N·mm"), say("N/mm"), say("N·mm/rad"), say("MPa"), say("rpm"), say("kg"), say("kg·mm²")),
        *(say("µm"), say("µm/rad"), say("mrad"), say("mrad/rad"), say("mrad/rad²")),
        *(say("mm/mm"), say("(mm/rad)/mm"), say("(mm/rad²)/mm"), say("N·s/m"), say("N·mm·s/rad"), say("W")),
    )
}

UNIT_SIZES = {
    **dict.fromkeys(("mm", "deg", "n", "mpa"), 1.0), "cm": 10.0, "m": 1000.0, "rad": math.degrees(1.0), "kn": 1000.0,
    "gpa": 1000.0,
}  # fmt: skip
"""Sizes of units that people write in place of one another, in the smallest of their kind."""
UNIT_KINDS = ({"mm", "cm", "m"}, {"deg", "rad"}, {"n", "kn"}, {"mpa", "gpa"})


_PER_PATTERN = re.compile(r"\s+(?:per|на|trên|pro)\s+|每")
_BETWEEN_UNITS_PATTERN = re.compile(r"\s*([/·])\s*")
_INVERSE_PATTERN = re.compile(r"[\s·*]*\b(\w+?)\^?[-−]1$")


def plain_unit(written: str) -> str:
    """A unit as all of its spellings are told: that of the table of typed words, in small letters, without brackets.

    >>> plain_unit("град."), plain_unit("(мм/рад)"), plain_unit("mm per rad"), plain_unit("mm·rad⁻¹"), plain_unit("°")
    ('deg', 'mm/rad', 'mm/rad', 'mm/rad', 'deg')
    """
    bare = re.sub(r"[][().]", "", unicodedata.normalize("NFKC", written.replace("°", "deg"))).strip().casefold()
    if whole := _spelled_units().get(bare):
        return whole
    parts = _BETWEEN_UNITS_PATTERN.split(_INVERSE_PATTERN.sub(r"/\1", _PER_PATTERN.sub("/", bare)))
    return "".join(map(_plain_part, parts))


def _plain_part(part: str) -> str:
    """One unit of a quotient, with its power."""
    bare = part.strip().replace("^", "")
    name = bare.rstrip("23")
    return _spelled_units().get(name, name) + bare[len(name) :]


@cache
def _spelled_units() -> Mapping[str, str]:
    """Units by all of their spellings, both in small letters."""
    named = [(word, name) for name, words in table()["units"].items() for word in (name, *words)]
    return {unicodedata.normalize("NFKC", word).casefold(): name.casefold() for word, name in named}


def unit_factor(written: str, asked: str) -> float | None:
    """How many of the unit that is asked for make one that is written; None where they are not of one kind.

    >>> unit_factor("cm", "mm"), unit_factor("°", "degrees"), unit_factor("kg", "mm")
    (10.0, 1.0, None)
    """
    one, other = plain_unit(written), plain_unit(asked)
    if one == other:
        return 1.0
    alike = any({one, other} <= kind for kind in UNIT_KINDS)
    return UNIT_SIZES[one] / UNIT_SIZES[other] if alike else None


NEGLIGIBLE_SIZE = 0.005
"""A length on paper [mm], or an angle [degrees], of less is written as 0.00: it is neither set nor told."""


def printed_unit(typed: str) -> Words:
    """A unit as it is printed, by its name as it is typed in a file.

    >>> str(printed_unit("kg mm^2")), printed_unit("uin")
    ('kg·mm²', 'µin')
    """
    printed = typed.replace(" ", "·").replace("^2", "²").replace("^3", "³").replace("u", "µ")
    return UNITS.get(printed, printed)


def unit(name: str) -> Caption:
    """The unit of that name, as a caption.

    >>> str(unit("mm/rad"))
    'mm/rad'
    """
    return UNITS[name]
