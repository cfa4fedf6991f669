"""A space of designs: each size one value, a list or a range, and every combination of them a cam.

It mirrors a file (degrees, mm); a design is made of its number when it is needed, so that millions need no memory.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError, TaskError, nearest_word_remedy
from graphcam.given.follower import FOLLOWERS_BY_KIND, Kind, Limits, Rotation
from graphcam.given.laws import LAWS, LawName
from graphcam.given.motion_law import Law
from graphcam.given.plausible_ranges import NUMBER_TYPES, bounded, check_positive
from graphcam.sweeps.designs import CLOSURE_TOLERANCE, SIZE_NAMES, Designs
from graphcam.sweeps.sweep import computed, usual_limit
from graphcam.sweeps.sweep_quantities import QUANTITIES
from graphcam.tasks.dataclass_reader import classes_of
from graphcam.tasks.task_file import checked_table, other_file, read_content, read_toml
from graphcam.words import Words, say

ANGLE_KEYS = ("rise_angle", "dwell_angle", "return_angle", "max_pressure_angle_rise", "max_pressure_angle_return")
"""What a file gives and gets in degrees."""
MAX_DESIGNS = 10**12
"""Designs; nobody waits for more."""
MAX_VALUES = 10**6
"""The maximum number of values of one size."""
_RANGE_KEYS = ("start", "stop", "count")
_ALLOWED_FORMS = say("a number, a list of numbers, or {{ start = 40, stop = 60, count = 21 }}")
Columns = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class SpaceMotionTable:
    """``[motion]``: lift [mm], angles [degrees] and laws of rise, high dwell and return; the low dwell is the rest.

    The lift of an arm is in degrees.
    """

    lift: Any
    rise_angle: Any
    return_angle: Any
    dwell_angle: Any = 0.0
    rise_law: Any = "3-4-5"
    return_law: Any = "3-4-5"

    def __post_init__(self) -> None:
        for name in ("lift", "rise_angle", "return_angle", "dwell_angle"):
            number_axis(name, getattr(self, name))
        for name in ("rise_law", "return_law"):
            word_axis(name, getattr(self, name), LAWS)


@dataclass(frozen=True)
class SpaceCamTable:
    """``[cam]``: mm; each follower has its own of them."""

    prime_radius: Any
    offset: Any = 0.0
    arm: Any = 0.0
    distance: Any = 0.0
    roller_radius: Any = 0.0
    face_offset: Any = 0.0

    def __post_init__(self) -> None:
        for each in fields(self):
            number_axis(each.name, getattr(self, each.name))


@dataclass(frozen=True)
class SpaceLimitsTable:
    """``[limits]``: permitted pressure angles [degrees]; None is the usual one on the rise, none on the return.

    min_curvature_radius : mm, of the convex parts of the profile; None is no limit
    """

    pressure_angle_rise: float | None = None
    pressure_angle_return: float | None = None
    min_curvature_radius: float | None = None

    def __post_init__(self) -> None:
        self("translating")

    def __call__(self, follower: str) -> Limits:
        """The limits in radians."""
        rise, back = (
            None if given is None else math.radians(given)
            for given in (self.pressure_angle_rise, self.pressure_angle_return)
        )
        return Limits(usual_limit(follower) if rise is None else rise, back, curvature=self.min_curvature_radius)


@dataclass(frozen=True)
class Space:
    """Every combination of the values given; the last axis runs fastest.

    >>> space = Space(SpaceMotionTable(lift=30, rise_angle=[90, 120], return_angle=90),
    ...               SpaceCamTable(prime_radius={"start": 40, "stop": 60, "count": 3}))
    >>> len(space), space.varied
    (6, ('rise_angle', 'prime_radius'))
    >>> space.columns(1, 4)["prime_radius"].tolist()
    [50.0, 60.0, 40.0]
    """

    motion: SpaceMotionTable
    cam: SpaceCamTable
    limits: SpaceLimitsTable = field(default_factory=SpaceLimitsTable)
    follower: Kind = "translating"
    rotation: Any = "ccw"
    quantities: tuple[str, ...] = QUANTITIES

    def __post_init__(self) -> None:
        word_axis("rotation", self.rotation, ("ccw", "cw"))
        for name in self.quantities:
            if name not in QUANTITIES:
                raise DesignError(
                    "quantities", name, say("quantities of a sweep"), nearest_word_remedy(name, QUANTITIES)
                )
        if not self.quantities:
            found = say("an empty list")
            raise DesignError("quantities", found, say("at least one"), say("leave it out for all of them"))
        if len(self) > MAX_DESIGNS:
            quantity = say("number of designs")
            raise DesignError(quantity, len(self), say("at most {most}", most=MAX_DESIGNS), say("give fewer values"))
        self._check_turn()
        self.designs(0, 1)

    def _check_turn(self) -> None:
        """Refuse phases that in no design fit into a turn; where they do in some, the others have empty rows."""
        angles = [self.axes[name].min().item() for name in ("rise_angle", "dwell_angle", "return_angle")]
        if sum(angles) > 360 + CLOSURE_TOLERANCE:
            told = say("{sum:g} degrees at least", sum=sum(angles))
            limit = say("at most 360 degrees in some design")
            raise DesignError(say("rise, dwell and return together"), told, limit, say("give smaller angles"))

    @cached_property
    def axes(self) -> Columns:
        """The values of every parameter, in the order of the fields."""
        given = {each.name: getattr(part, each.name) for part in (self.motion, self.cam) for each in fields(part)}
        given["rotation"] = self.rotation
        return {
            name: np.asarray(value if isinstance(value, list) else [value])
            if name in ("rise_law", "return_law", "rotation")
            else number_axis(name, value)
            for name, value in given.items()
        }

    def __len__(self) -> int:
        return math.prod(axis.size for axis in self.axes.values())

    @property
    def angles(self) -> tuple[str, ...]:
        """What is in degrees: an arm's lift too."""
        return (*ANGLE_KEYS, "lift") if FOLLOWERS_BY_KIND[self.follower].lift_unit == "rad" else ANGLE_KEYS

    @property
    def varied(self) -> tuple[str, ...]:
        """The parameters that have more than one value."""
        return tuple(name for name, axis in self.axes.items() if axis.size > 1)

    @property
    def varied_columns(self) -> tuple[str, ...]:
        """The columns of the results that hold the varied parameters; one in degrees ends in ``_deg``."""
        return tuple(self._column(name) for name in self.varied)

    def _column(self, name: str) -> str:
        return name + "_deg" if name in self.angles else name

    def columns(self, start: int, stop: int) -> Columns:
        """The varied parameters of the designs from number ``start`` up to ``stop``, as in the file."""
        shape = tuple(self.axes[name].size for name in self.varied)
        places = np.unravel_index(np.arange(start, stop), shape) if shape else ()
        return {name: self.axes[name][place] for name, place in zip(self.varied, places, strict=True)}

    def designs(self, start: int, stop: int) -> Designs:
        """The designs from number ``start`` up to ``stop``."""
        values = {name: axis[0] for name, axis in self.axes.items()} | self.columns(start, stop)
        values |= {name: np.radians(values[name]) for name in values if name in self.angles}
        return Designs(**values, follower=self.follower)

    def results(self, numbers: tuple[int, int]) -> Columns:
        """Varied parameters and quantities of the designs between two numbers; a name of degrees ends in ``_deg``."""
        found = computed(self.designs(*numbers), self.quantities, self.limits(self.follower))
        found |= {name: np.degrees(column) for name, column in found.items() if name in ANGLE_KEYS}
        columns = self.columns(*numbers) | found
        return {self._column(name): column for name, column in columns.items()}


def number_axis(name: str, value: Any) -> NDArray[np.float64]:
    """The numbers that a value, a list or a range stands for.

    >>> number_axis("offset", {"start": 0, "stop": 10, "count": 3}).tolist()
    [0.0, 5.0, 10.0]

    Raises
    ------
    DesignError : it is neither, is empty, or has unknown or missing keys
    """
    if isinstance(value, dict):
        return _range(name, value)
    values: list[Any] = value if isinstance(value, list) else [value]
    if not values:
        raise DesignError(name, say("an empty list"), _ALLOWED_FORMS)
    if not all(isinstance(x, int | float) and not isinstance(x, bool) and abs(x) < math.inf for x in values):
        raise DesignError(name, value, _ALLOWED_FORMS)
    unit = "mm (degrees for an arm)" if name == "lift" else "degrees" if name.endswith("_angle") else "mm"
    for x in values:
        # An offset may be next to nothing; a size that is negative or zero makes no cam, which its row tells.
        (check_positive if x > 0 and not name.endswith("offset") else bounded)(name, x, unit)
    return np.array(values, dtype=np.float64)


def _range(name: str, value: dict[str, Any]) -> NDArray[np.float64]:
    for key in value:
        if key not in _RANGE_KEYS:
            raise DesignError(
                f"{name}.{key}", say("an unknown key"), say("a key of this table"), _range_remedy(key, value)
            )
    for key in _RANGE_KEYS:
        if key not in value:
            raise DesignError(f"{name}.{key}", say("missing"), say("given"), say("a range has start, stop and count"))
    count = value["count"]
    if not isinstance(count, int) or isinstance(count, bool) or not 1 <= count <= MAX_VALUES:
        raise DesignError(f"{name}.count", count, say("a whole number from 1 to {most}", most=MAX_VALUES))
    ends = number_axis(name, value["start"]), number_axis(name, value["stop"])
    if ends[0].size > 1 or ends[1].size > 1:
        raise DesignError(name, value, _ALLOWED_FORMS)
    return np.linspace(ends[0][0], ends[1][0], count)


def _range_remedy(key: str, value: dict[str, Any]) -> Words:
    """The remedy for an unknown key of a range: a step is told as the count that it makes."""
    near = nearest_word_remedy(key, _RANGE_KEYS)
    numbers = [value.get(name) for name in ("start", "stop", key)]
    if "step" not in key.casefold() or not all(isinstance(each, int | float) and each for each in numbers[1:]):
        return near
    start, stop, step = (float(each or 0) for each in numbers)
    count = (stop - start) / step + 1
    whole = count == round(count) and count > 1
    return say("write count = {count:g}, with both ends, in place of it", count=count) if whole else near


def word_axis(name: str, value: Any, known: tuple[str, ...]) -> None:
    """Check one name or a list of names.

    Raises
    ------
    DesignError : one is unknown, or there is none
    """
    values: list[Any] = value if isinstance(value, list) else [value]
    if not values:
        raise DesignError(name, say("an empty list"), say("a name or a list of names"))
    for word in values:
        if word not in known:
            raise DesignError(
                name, word, say("a name or a list of names in quotes"), nearest_word_remedy(str(word), known)
            )


_REMEDY = say("graphcam/data/space.toml in the package is a commented example")


def load_space(path: str | Path) -> Space:
    """The space of designs in a TOML file.

    Raises
    ------
    TaskError : there is no such file, it is not TOML, or a field is missing, unknown or wrong

    >>> from importlib.resources import files
    >>> len(load_space(files("graphcam") / "data" / "space.toml"))
    34850
    """
    with other_file(say("space file"), _REMEDY):
        read = read_toml(str(path), read_content(path))
        if isinstance(motion := read.data.get("motion"), dict) and "phases" in motion:
            found, expected = say("a task"), say("a space of designs: 'graphcam init FILE --sweep' writes one")
            raise TaskError(str(path), say("the file"), found, expected, say("'graphcam solve' takes a task"))
        return checked_table(Space, classes_of(Space), str(path), read.data, read.data, read)


# --- designs in memory -----------------------------------------------------------------------------------------------

MAX_GRID_DESIGNS = 10**7
"""Designs; more do not fit into memory beside their quantities."""
Axis = float | Sequence[float] | NDArray[Any] | Mapping[str, float]
"""One value, several, or a range {"start": 40, "stop": 60, "count": 21}."""


def grid(
    *,
    lift: Axis,
    rise_angle: Axis,
    return_angle: Axis,
    prime_radius: Axis,
    dwell_angle: Axis = 0.0,
    offset: Axis = 0.0,
    arm: Axis = 0.0,
    distance: Axis = 0.0,
    roller_radius: Axis = 0.0,
    face_offset: Axis = 0.0,
    rise_law: LawName | Law | Sequence[LawName | Law] = "3-4-5",
    return_law: LawName | Law | Sequence[LawName | Law] = "3-4-5",
    rotation: Rotation | Sequence[Rotation] = "ccw",
    follower: Kind = "translating",
) -> Designs:
    """The designs of every combination of the values given; the last one that has several runs fastest.

    The names and units are those of :class:`graphcam.Designs`: mm and radians.  Each size is one value, several, or a
    range as in a file of ``graphcam sweep``, with both ends.

    Raises
    ------
    DesignError : a list is empty, a range has other keys than start, stop and count, or there are too many designs

    >>> import numpy as np
    >>> import graphcam as gc
    >>> designs = gc.grid(lift=30, rise_angle=np.radians([90, 120]), return_angle=np.radians(90), offset=10,
    ...                   prime_radius={"start": 50, "stop": 60, "count": 2})
    >>> gc.sweep(designs, "max_pressure_angle_rise").array
    array([(1.57079633, 50., 0.38959234), (1.57079633, 60., 0.33902234),
           (2.0943951 , 50., 0.2614178 ), (2.0943951 , 60., 0.22599739)],
          dtype=[('rise_angle', '<f8'), ('prime_radius', '<f8'), ('max_pressure_angle_rise', '<f8')])
    """
    given = dict(locals())
    axes: dict[str, Any] = {
        name: _axis(name, given[name]) for name in (*SIZE_NAMES, "rise_law", "return_law", "rotation")
    }
    count = math.prod(len(axis) for axis in axes.values())
    if count > MAX_GRID_DESIGNS:
        remedy = say("give fewer values, or write a file for graphcam sweep")
        raise DesignError(say("number of designs"), count, say("at most {most}", most=MAX_GRID_DESIGNS), remedy)
    several = [name for name, axis in axes.items() if len(axis) > 1]
    places = np.unravel_index(np.arange(count), [len(axes[name]) for name in several]) if several else ()
    values = {name: axis[0] for name, axis in axes.items()}
    values |= {name: axes[name][place] for name, place in zip(several, places, strict=True)}
    return Designs(**values, follower=follower)


def _axis(name: str, value: Any) -> NDArray[Any]:
    """(n,) the values of a size, a law or a sense of rotation."""
    if isinstance(value, Mapping):
        return number_axis(name, dict(value))
    if isinstance(value, str | Law) or np.ndim(value) == 0:
        value = [value]
    if not len(value):
        raise DesignError(name, say("an empty list"), say("at least one"))
    words = not isinstance(value[0], int | float | np.number)
    if name in SIZE_NAMES and not all(
        isinstance(each, NUMBER_TYPES) and not np.shape(np.asarray(each)) for each in value
    ):
        raise DesignError(name, say("no number"), say("a number, a list of numbers, or a range"))
    found = np.empty(len(value), dtype=object) if words else np.asarray(value, dtype=np.float64)
    if words:
        found[:] = value
        return found if any(isinstance(each, Law) for each in value) else found.astype(str)
    return found
