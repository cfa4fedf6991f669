"""Every combination of sizes as designs, as a file of ``graphcam sweep`` gives them."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.follower import Kind, Rotation
from graphcam.given.laws import LawName
from graphcam.given.motion_law import Law
from graphcam.given.plausible_ranges import NUMBER_TYPES
from graphcam.sweeps.design_space import number_axis
from graphcam.sweeps.designs import SIZE_NAMES, Designs
from graphcam.words import say

MAX_DESIGNS = 10**7
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
    if count > MAX_DESIGNS:
        remedy = say("give fewer values, or write a file for graphcam sweep")
        raise DesignError(say("number of designs"), count, say("at most {most}", most=MAX_DESIGNS), remedy)
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
