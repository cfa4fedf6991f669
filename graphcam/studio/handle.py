"""What the hand takes hold of in a drawing: where it lies, which sizes it changes, and what they become when it moves.

Places are complex, in mm of a view from its origin, y upwards; the page counts y downwards.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from graphcam.drafting.euclid import UP
from graphcam.drafting.scale import printed_unit
from graphcam.errors import DesignError
from graphcam.given.motion import FULL_TURN
from graphcam.given.stations import Stations
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.solution import Solution
from graphcam.studio.form_fields import unit_of
from graphcam.studio.size_ranges import SizeRange, present_value, ranges
from graphcam.tasks.declared_numbers import numbers_of
from graphcam.words import Caption, Tell, say

Changes = dict[str, Any]
"""New values of a task by their paths."""
MAGNET_REACH = 2.5
"""A magnet draws what comes this near to it [mm of paper]."""
COARSE_STEPS = 10
"""A coarse step is so many steps."""
DECIMALS = 3
MAX_DISTANCE = 1e5
"""No place on paper is farther away [mm]."""
Mark = Callable[[Any], Any] | Callable[[Any, Any], Any]
"""The place of a mark for one size or two [mm of paper]."""
MAX_STEPS, NUDGE = 30, 1e-6
"""The number of Newton's steps at most, and how far a size is nudged to see where its mark goes."""
TURN_RANGE = SizeRange(0.0, 360.0, 0.5)
"""The range of the cam angle [degrees]."""


def changes_with(extra: Mapping[str, Any], path: str, value: float) -> Changes:
    """The changes that give a task another value of a size.

    extra : what goes with it: ``first``, what is put into the task before; ``sum``, another size that is the rest of a
        total; ``with``, other sizes that go with it, such parts of it beyond what ``beyond`` says of them, usually 0

    >>> changes_with({"sum": {"path": "b", "total": 10.0}, "with": {"c": 0.5}}, "a", 4.0)
    {'a': 4.0, 'b': 6.0, 'c': 2.0}
    """
    rest = {sum_["path"]: round(sum_["total"] - value, 9)} if (sum_ := extra.get("sum")) else {}
    beyond = extra.get("beyond", {})
    shares = {
        other: round(beyond.get(other, 0.0) + value * share, 12) for other, share in extra.get("with", {}).items()
    }
    return {**extra.get("first", {}), path: value, **rest, **shares}


@dataclass(frozen=True)
class HandleAxis:
    """A size that a handle changes, as one slider for the keyboard.

    path : of the size;  name, unit : as they are told
    value : at present;  range : of it
    screen : "x" or "y", along which the arrow keys move it
    extra : what must be changed with it, see :func:`changes_with`
    """

    path: str
    name: Caption
    unit: str
    value: float
    range: SizeRange
    screen: str
    extra: Mapping[str, Any] = field(default_factory=dict[str, Any])

    def plain(self, tell: Tell) -> dict[str, Any]:
        """The axis as plain data for the page."""
        each = self.range.widened_to(self.value)
        return {
            "path": self.path,
            "name": tell(self.name),
            "unit": tell(printed_unit(self.unit)),
            "value": self.value,
            **each.plain(),
            "fine": round(each.step / 5, 9),
            "coarse": COARSE_STEPS * each.step,
            "screen": self.screen,
            **self.extra,
        }


def axis_of(solution: AnySolution, path: str, screen: str, room: SizeRange | None = None, **extra: Any) -> HandleAxis:
    """The axis of a number of a task, as its table declares it.

    room : its range, if it is another one than in the form;  extra : see :class:`HandleAxis`
    """
    number = numbers_of(solution.task)[path]
    assert number.name
    value, unit = present_value(solution, path), unit_of(solution.task, path, number)
    return HandleAxis(path, number.name, unit, value or 0.0, room or ranges(solution)[path], screen, extra)


@dataclass(frozen=True, eq=False)
class Handle:
    """A place of a drawing that can be moved.

    key : its own among those of its view
    at : where it lies
    shape : how it moves: "x", "y", "xy" or "along", in the direction ``along``
    drag : what the sizes become if it is moved to a place, finely or not; snapped, and within their ranges
    limit : whether it lies where a limit is not kept
    """

    view: str
    key: str
    name: Caption
    at: complex
    shape: str
    axes: Sequence[HandleAxis]
    drag: Callable[[complex, bool], Changes]
    along: complex | None = None
    limit: bool = False

    @property
    def id(self) -> str:
        """An identifier that no other handle of the views has."""
        return f"{self.view}/{self.key}"

    def plain(self, tell: Tell) -> dict[str, Any]:
        """The handle as plain data for the page."""
        return {
            "id": self.id,
            "view": self.view,
            "name": tell(self.name),
            "at": on_page(self.at),
            "shape": self.shape,
            "along": None if self.along is None else on_page(self.along),
            "limit": self.limit,
            "axes": [axis.plain(tell) for axis in self.axes],
        }


def sizes_at(mark: Mark, start: Sequence[float], to: complex) -> tuple[float, ...]:
    """The sizes that bring a mark as near to a place as they can, by Newton's steps on the mark's own place.

    mark : the place of the mark for the sizes [mm of paper];  start : the sizes from which it goes there

    >>> [round(size, 6) for size in sizes_at(lambda a, b: a + 1j * a * b, [1.0, 1.0], 2 + 6j)]
    [2.0, 3.0]
    """
    at: Callable[..., Any] = mark
    sizes, off = np.array(start, dtype=float), complex(to - at(*start))
    for _ in range(MAX_STEPS):
        nudges = NUDGE * np.eye(sizes.size)
        slopes = [complex(at(*(sizes + each)) - at(*(sizes - each))) / (2 * NUDGE) for each in nudges]
        step = np.linalg.lstsq(np.array([[each.real, each.imag] for each in slopes]).T, [off.real, off.imag])[0]
        left = complex(to - at(*(sizes + step)))
        # A whole step may lead beyond it where the mark goes along a curve.
        while not abs(left) < abs(off) and np.abs(step).max() > NUDGE:
            step = step / 2
            left = complex(to - at(*(sizes + step)))
        if np.abs(step).max() <= NUDGE:
            break
        sizes, off = sizes + step, left
    return tuple(sizes.tolist())


def mark_handle(
    view: str,
    key: str,
    name: Caption,
    mark: Mark,
    axes: Sequence[HandleAxis],
    *,
    magnets: Sequence[float] = (),
    reach: float = MAGNET_REACH,
    rooms: Callable[[Sequence[float], float], tuple[SizeRange, Sequence[float]]] | None = None,
    places: Sequence[complex] = (),
    limit: bool = False,
) -> Handle:
    """A handle on a mark that the sizes of its axes move: the sizes are sought that bring it to the hand.

    mark : the place of the mark for the sizes [mm of paper]
    magnets : values that draw the last size;  places : that draw the mark;  reach : from so near [mm of paper]
    rooms : range and magnets of a size, by those before it and by where the hand would have it; if not as above

    >>> width = HandleAxis("b", say("Offset e"), "mm", 4.0, SizeRange(0.0, 10.0, 0.5), "x")
    >>> mark_handle("profile", "b", say("Offset e"), lambda b: 2j - 0.5 * b, [width]).drag(-3.6 + 9j, False)
    {'b': 7.0}
    """
    values = [axis.value for axis in axes]
    place: Callable[..., Any] = mark

    def drag(to: complex, fine: bool) -> Changes:
        """The sizes, one after the other snapped, and what goes with them."""
        drawn = [] if fine else [place for place in places if abs(place - to) <= reach]
        known: tuple[float, ...] = ()
        changes: Changes = {}
        for k, axis in enumerate(axes):
            own = partial(place, *known)
            wanted = sizes_at(own, values[k:], drawn[0] if drawn else to)
            room, near = rooms(known, wanted[0]) if rooms else (axis.range, magnets if k == len(axes) - 1 else ())
            room = room._replace(step=room.step / 5) if drawn else room
            goes = abs(_way(own, wanted)) / (2 * NUDGE)
            value = snapped(wanted[0], room, fine=fine, magnets=near if goes else (), reach=reach / (goes or 1.0))
            changes |= changes_with(axis.extra, axis.path, value)
            known += (value,)
        return changes

    way = _way(place, values)
    way = way / abs(way)
    shape = "xy" if len(axes) > 1 else "y" if abs(way.real) < NUDGE else "x" if abs(way.imag) < NUDGE else "along"
    return Handle(view, key, name, complex(place(*values)), shape, axes, drag, way if shape == "along" else None, limit)


def _way(mark: Callable[..., Any], sizes: Sequence[float]) -> complex:
    """How far and in which direction a mark goes when its first size is nudged to both sides."""
    first, *others = sizes
    return complex(mark(first + NUDGE, *others) - mark(first - NUDGE, *others))


def station_handle(
    view: str, key: str, name: Caption, at: complex, axis: HandleAxis, places: ArrayLike, values: Sequence[float]
) -> Handle:
    """A handle that goes to the nearest of some places (n,), each of which stands for a value of its axis."""
    return Handle(view, key, name, at, "xy", (axis,), lambda to, fine: {axis.path: values[nearest_station(places, to)]})


def turn_handle(
    view: str, key: str, name: Caption, at: complex, phi: float, places: ArrayLike, angles: ArrayLike
) -> Handle:
    """A handle of the cam angle [degrees], at the nearest of some places, which belong to angles [rad]."""
    degrees = [round(each, 6) for each in np.degrees(angles).tolist()]
    return station_handle(view, key, name, at, phi_axis(phi), places, degrees)


def radius_handle(
    solution: Solution,
    view: str,
    key: str,
    name: Caption,
    mu: float,
    least: float,
    room: SizeRange | None = None,
    **extra: Any,
) -> Handle:
    """A handle of the prime radius, as far below the cam centre; the least one, on a fine step, draws it.

    mu : mm to a millimetre of paper;  least : NaN where there is none;  room, extra : see :func:`axis_of`
    """
    axis = axis_of(solution, "cam.prime_radius", "y", room, sign=-1, **extra)
    fine = axis.range.step / 5
    found = [] if math.isnan(least) else [round(math.ceil(least / fine - 1e-9) * fine, 9)]
    too_small = axis.value < least - fine / 10
    return mark_handle(view, key, name, lambda r0: -UP * r0 / mu, [axis], magnets=found, limit=too_small)


def on_page(place: complex) -> list[float]:
    """A place or direction as the page counts it.

    >>> on_page(3 + 4j)
    [3.0, -4.0]
    """
    return [round(place.real, DECIMALS) + 0.0, round(-place.imag, DECIMALS) + 0.0]


def snapped(
    value: float, within: SizeRange, *, fine: bool = False, magnets: Sequence[float] = (), reach: float = 0.0
) -> float:
    """A value on the nearest magnet in reach, or else on a step, within its range; finely there are no magnets.

    >>> room = SizeRange(0.0, 10.0, 0.5)
    >>> snapped(4.2, room, magnets=[0.0, 5.0], reach=1.0), snapped(4.2, room, fine=True, magnets=[5.0], reach=1.0)
    (5.0, 4.2)
    """
    near = [] if fine else [each for each in magnets if abs(each - value) <= reach]
    pulled = min(near, key=lambda each: abs(each - value), default=None)
    if pulled is not None and within.least <= pulled <= within.most:
        return pulled
    return within.nearest_step(value, fine=fine)


def place_of(name: str, at: Any) -> complex:
    """A place as the page counts it, ``[x, y]``, as a complex number; it is what a request says under a name.

    Raises
    ------
    DesignError : it is none

    >>> place_of("guess", [3.0, -4.0])
    (3+4j)
    """
    try:
        x, y = (float(coordinate) for coordinate in at)
    except (TypeError, ValueError, OverflowError):
        x = y = math.nan
    if not (abs(x) <= MAX_DISTANCE and abs(y) <= MAX_DISTANCE):
        raise DesignError(name, f"{at!r}"[:40], say("two numbers, x and y in mm of the view"))
    return complex(x, -y)


def phi_axis(phi: float, screen: str = "x") -> HandleAxis:
    """The axis of a handle that sets the cam angle [degrees]."""
    return HandleAxis("phi", say("Cam angle φ"), "°", phi, TURN_RANGE, screen)


def over_stations(
    stations: Stations, phi: float, values: ArrayLike, before: ArrayLike | None = None, *, rests: bool = False
) -> complex:
    """A value or a place at a cam angle [rad], straight between those at the stations.

    values : (m,);  before : where they jump, those on the left;  rests : whether it is zero in dwells; else it stays
        what it was at the station before

    >>> import graphcam as gc
    >>> from graphcam.given.stations import divide
    >>> halves = divide(gc.Motion([gc.Rise(30, 2.0), gc.Dwell(1.0), gc.Return(30, FULL_TURN - 3.0)]), 2)
    >>> over_stations(halves, 0.5, [0, 10, 30, 30, 20, 0]).real, over_stations(halves, 2.5, [0, 10, 30, 30, 20, 0]).real
    (5.0, 30.0)
    """
    after, turn = np.asarray(values), phi % FULL_TURN
    ends = after if before is None else np.asarray(before)
    first, last = stations.phi[stations.left], stations.phi[stations.left + 1]
    within = np.flatnonzero((first <= turn) & (turn <= last))
    if within.size:
        k = int(within[0])
        share, left = (turn - first[k]) / (last[k] - first[k]), int(stations.left[k])
        return complex((1 - share) * after[left] + share * ends[left + 1])
    if rests:
        return 0j
    earlier = np.flatnonzero(stations.phi <= turn)
    return complex(after[earlier[-1] if earlier.size else -1])


def nearest_station(places: ArrayLike, to: complex) -> int:
    """The number of the place nearest to another one.

    >>> nearest_station([0j, 3j, 5j], 1 + 4.5j)
    2
    """
    return int(np.nanargmin(np.abs(np.asarray(places) - to)))
