"""The hands of students: how exactly they draw and read, one more so than another, on paper that stretches.

Students differ.  Of every error a table says the least and the greatest standard deviation, and every student has a
place of their own between them for each: who draws finely need not set the dividers finely, and few have all the worst
habits.  Paper takes up moisture, and a printer scales by a little: all lengths of one sheet are longer or shorter by
the same part, and its angles stay.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property, lru_cache
from threading import Lock
from typing import Any, NamedTuple

import numpy as np

from graphcam.drafting.acts import Floats, Kind
from graphcam.drafting.pencil import Pencil, Stream
from graphcam.drafting.slips import SLIPS
from graphcam.errors import DesignError, choice_limit
from graphcam.words import say


class Range(NamedTuple):
    """A range of deviations: of the finest student and of the coarsest; one number is both.

    >>> Range(0.1, 0.3).middle
    0.2
    """

    least: float
    greatest: float

    @property
    def middle(self) -> float:
        """The deviation of a student in the middle."""
        return (self.least + self.greatest) / 2

    def of(self, coarse: Floats) -> Floats:
        """The deviations of students from the finest, 0, to the coarsest, 1."""
        return self.least + coarse * (self.greatest - self.least)


def _range(said: float | tuple[float, float]) -> Range:
    return Range(*said) if isinstance(said, tuple) else Range(said, said)


class Errors(NamedTuple):
    """Standard deviations of the errors of a course's students.

    line, dividers : of a line's place, of a length that dividers carry [mm]
    division : to which a rule is read [mm]: students read to the finer or to the coarser one
    protractor_deg : of an angle [degrees]
    stretch : by what part of itself every length on a sheet may be longer or shorter
    """

    line: Range
    dividers: Range
    division: Range
    protractor_deg: Range
    stretch: float


HANDS = {
    "careful": Errors(Range(0.1, 0.2), Range(0.1, 0.2), Range(0.5, 0.5), Range(0.2, 0.3), 0.002),
    "usual": Errors(Range(0.1, 0.3), Range(0.1, 0.3), Range(0.5, 1.0), Range(0.25, 0.6), 0.005),
    "first-year": Errors(Range(0.2, 0.4), Range(0.2, 0.4), Range(1.0, 1.0), Range(0.6, 1.2), 0.005),
}
"""The hands that have a name: of practised draughtsmen with sharp pencils, of a course, and of its first weeks."""


KEPT_STREAM_COUNT = 16
"""Streams whose numbers are kept: those of all constructions, by one seed."""


@dataclass(frozen=True)
class SteadyPencil(Pencil):
    """A :class:`~graphcam.Pencil` with the stream of random numbers that NumPy promises never to change.

    Marks must not change with the version of a library, and a variant's parameters rest on them too.

    >>> float(SteadyPencil(line=1.0, seed=1).stream("inversion").standard_normal((1,))[0])
    0.3506619882060858
    """

    def stream(self, construction: str) -> Stream:
        """A stream of random numbers as of any pencil, but of the frozen generator."""
        return _RecalledNormals(self.seed, construction)


class _RecalledNormals:
    """The numbers of a frozen stream from its start: most were drawn before, for another variant or mistake."""

    def __init__(self, seed: int, construction: str) -> None:
        self._source, self._place = _normals_of(seed, construction), 0

    def standard_normal(self, size: tuple[int, ...], /) -> Floats:
        """The next numbers of the stream, in this shape."""
        start, self._place = self._place, self._place + math.prod(size)
        return self._source.first(self._place)[start:].reshape(size)


class _KeptNormals:
    """The numbers of a frozen stream that were asked for so far."""

    def __init__(self, seed: int, construction: str) -> None:
        self._random = np.random.RandomState([seed, *construction.encode()])
        self._drawn, self._lock = np.empty(0), Lock()

    def first(self, count: int) -> Floats:
        """The first numbers (count,); drawn in parts they are the same as at once."""
        with self._lock:
            if (missing := count - self._drawn.size) > 0:
                more = self._random.standard_normal(max(missing, self._drawn.size // 4))
                self._drawn = np.append(self._drawn, more)
            return self._drawn[:count]


_normals_of = lru_cache(maxsize=KEPT_STREAM_COUNT)(_KeptNormals)


@dataclass(frozen=True)
class ManyHands(SteadyPencil):
    """A pencil in the hands of many students, each of whom draws all of one sample.

    Its own deviations are those of the coarsest hand.

    errors : of the students
    """

    errors: Errors = HANDS["usual"]

    @cached_property
    def _students(self) -> Mapping[str, Floats]:
        """What is each student's own in every sample (samples,), evenly from 0 to 1, by the field of the errors."""
        assert self.samples is not None
        own = np.random.RandomState([self.seed, *b"students"]).uniform(size=(len(Errors._fields), self.samples))
        return dict(zip(Errors._fields, own, strict=True))

    @cached_property
    def stretch_factors(self) -> Floats:
        """The factor by which the paper makes every sample's lengths off (samples,)."""
        return 1 + self.errors.stretch * (2 * self._students["stretch"] - 1)

    def slips(self, kind: Kind, what: str, stream: Stream, shape: tuple[int, ...]) -> Floats:
        """The errors of an act, every sample by its student's own deviation."""
        off = super().slips(kind, what, stream, shape)
        of = SLIPS[kind][what].of
        field = "protractor_deg" if of == "protractor" else of
        own: Range = getattr(self.errors, field)
        if not own.greatest or len(shape) == 0:
            return off
        return off * _along_samples(own.of(self._students[field]) / own.greatest, shape)

    def read_off(self, lengths: Floats) -> Floats:
        """Lengths as they are read: by some students to the finer division, by the others to the coarser."""
        fine, coarse = self.errors.division
        if not coarse or not self.deviation(Kind.READ, "length"):
            return lengths
        division = _along_samples(np.where(self._students["division"] < 0.5, fine, coarse), lengths.shape)
        return np.where(division > 0, np.round(lengths / np.where(division > 0, division, 1.0)) * division, lengths)


def _along_samples(of_samples: Floats, shape: tuple[int, ...]) -> Floats:
    """Values (samples,) so that they go with arrays (samples, ...)."""
    return of_samples.reshape(-1, *(1,) * (len(shape) - 1))


@dataclass(frozen=True)
class HandTable:
    """``[hand]``: how exactly the students draw for whom the tolerances are made.

    name : "careful", "usual" or "first-year"
    line, dividers, division, protractor_deg, stretch : what is other than with these, as of :class:`Errors`; but for
        the stretch one number, or those of the finest and of the coarsest student

    >>> HandTable(line=0.15).errors.line
    Range(least=0.15, greatest=0.15)
    """

    name: str = "usual"
    line: float | tuple[float, float] | None = None
    dividers: float | tuple[float, float] | None = None
    division: float | tuple[float, float] | None = None
    protractor_deg: float | tuple[float, float] | None = None
    stretch: float | None = None

    def __post_init__(self) -> None:
        if self.name not in HANDS:
            raise DesignError("hand.name", self.name, *choice_limit(self.name, HANDS))
        for field, said in self._own.items():
            least, greatest = said if isinstance(said, tuple) else (said, said)
            if not 0 <= least <= greatest < math.inf:
                limit = say("0 or more, or the minimum and the maximum of such numbers")
                raise DesignError(f"hand.{field}", said, limit)
        if not self.errors.stretch < 1:
            raise DesignError("hand.stretch", self.stretch, say("a part less than 1, such as 0.005"))

    @property
    def _own(self) -> dict[str, Any]:
        said = {field: getattr(self, field) for field in Errors._fields}
        return {field: value for field, value in said.items() if value is not None}

    @cached_property
    def errors(self) -> Errors:
        """The errors of the named hand, but for what is given otherwise."""
        own = {field: said if field == "stretch" else _range(said) for field, said in self._own.items()}
        return HANDS[self.name]._replace(**own)

    def pencil(self, samples: int, seed: int = 0) -> ManyHands:
        """A pencil for as many students."""
        errors = self.errors
        return ManyHands(
            line=errors.line.greatest,
            dividers=errors.dividers.greatest,
            division=errors.division.greatest,
            protractor=math.radians(errors.protractor_deg.greatest),
            samples=samples,
            seed=seed,
            errors=errors,
        )
