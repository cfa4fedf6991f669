"""A grid of places for a curve, once round an origin or over an axis, and the best way through the grid.

The best way is found by a dynamic programme whose states are a place across and a slope.  The slope is part of it, so
that a line that bends costs more than one that runs on.  R. Bellman, "Dynamic Programming", 1957; for lines in pictures
U. Montanari, "On the optimal detection of curves in noisy pictures", Communications of the ACM 14 (1971).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.pencil_ink import Ink
from graphcam.photo.printed_page import Points, PrintedView
from graphcam.photo.raster import DIRECTION_COUNT, PIXELS_PER_MM, Raster, ridges, spread

ACROSS_STEP = 0.2
"""The step across an axis [mm]; the place of a curve is refined afterwards."""
RELATIVE_STEP, MAX_STEP = 0.0035, 0.4
"""The step across a curve round an origin as a share of the distance from it, and its maximum [mm], a stroke's width.
"""
MAX_STATES = 900
"""The maximum number of states across an axis: a diagram on A1 takes no more memory than one on A3."""
ROUND_STATIONS = 360
"""The number of stations round an origin."""
MIN_STATION_STEP, MAX_STATION_STEP = 0.5, 1.0
"""The bounds of the step along an axis [mm]; an axis of 360 mm has as many stations as a curve round an origin."""
INNER_RADIUS = 10.0
"""The minimum distance of a curve from its origin [mm], where all rays of a construction meet."""
EDGE_MARGIN = 0.8
"""The margin beside the edge of the room [mm] in which its own line may be printed."""
MAX_ROUND_SLOPE = 1.2
"""The maximum slope against the circle, 50 degrees; a cam's pressure angle is less."""
MAX_AXIS_SLOPE = 3.7
"""The maximum slope over an axis, 75 degrees."""
OUTSIDE_REWARD = -0.02
"""The reward of a place outside the room, as small as that of noise."""


BEND_PRICE = 0.03
"""The price of a change of slope by one, in rewards of the best possible station."""
MAX_BEND = 2
"""The maximum change of slope from station to station, except at a corner."""
CORNER_PRICE = 1.5
"""The price of a corner, at which the slope changes freely: that of one and a half stations without a line."""
FORBIDDEN_REWARD = np.float32(-1e6)
BLOCK_STATIONS = 32
"""The number of stations whose values are kept at a time; the others are computed again on the way back."""

Rewards = NDArray[np.float32]
"""Rewards (stations, states, slopes) of leaving a state of a station with a slope, the change of the state up to the
next station; slopes run from -m to m."""


@dataclass(frozen=True, eq=False)
class BestWay:
    """A way through the grid: at each station (n,) its state and the slope with which it leaves."""

    states: NDArray[np.int64]
    slopes: NDArray[np.int64]


def best_way(rewards: Rewards, wraps: bool) -> BestWay:
    """The way with the maximum sum of rewards less the prices of its bends.

    wraps : whether the last station is followed by the first

    >>> rewards = np.zeros((6, 9, 5), np.float32)
    >>> rewards[np.arange(6), [1, 2, 3, 4, 5, 6]] = 1
    >>> best_way(rewards, wraps=False).states.tolist()
    [1, 2, 3, 4, 5, 6]
    """
    count = rewards.shape[0]
    if not wraps:
        return _best_way(rewards, np.arange(count))
    # Two turns, of which the middle one has forgotten where it began and does not know where it ends.
    half = count // 2
    turned = _best_way(rewards, np.arange(2 * count) % count)
    middle = slice(half, half + count)
    return BestWay(np.roll(turned.states[middle], half), np.roll(turned.slopes[middle], half))


def _best_way(rewards: Rewards, stations: NDArray[np.int64]) -> BestWay:
    _, states, slopes = rewards.shape
    value = np.zeros((slopes, states), np.float32)
    blocks = np.split(stations, np.arange(BLOCK_STATIONS, stations.size, BLOCK_STATIONS))
    before: list[NDArray[np.float32]] = []
    for block in blocks:
        before.append(value)
        _, value = _arrived(rewards, block, value)
    slope, state = divmod(int(value.argmax()), states)
    ways: list[NDArray[np.int64]] = []
    for block, start in zip(reversed(blocks), reversed(before), strict=True):
        way = _traced_back(_arrived(rewards, block, start)[0], slope, state)
        slope, state = int(way[1, 0]), int(way[0, 0])
        ways.append(way)
    whole = np.concatenate(ways[::-1], axis=1)
    return BestWay(whole[0], whole[1] - slopes // 2)


def _arrived(
    rewards: Rewards, stations: NDArray[np.int64], value: NDArray[np.float32]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Values (stations, slopes, states) of arriving behind each station, and those (slopes, states) behind the last.

    value : (slopes, states) before the first, with which slope it is left
    """
    _, states, slopes = rewards.shape
    slope = np.arange(slopes)[:, None] - slopes // 2
    before = np.arange(states) - slope
    from_outside = (before < 0) | (before >= states)
    arriving = np.arange(slopes)[:, None] * states + np.clip(before, 0, states - 1)
    arrived = np.empty((stations.size, slopes, states), np.float32)
    for k, station in enumerate(stations):
        np.take(value + rewards[station].T, arriving, out=arrived[k])
        arrived[k][from_outside] = FORBIDDEN_REWARD
        value = _with_slope_changes(arrived[k])
    return arrived, value


def _with_slope_changes(arrived: NDArray[np.float32]) -> NDArray[np.float32]:
    """The best values (slopes, states) after a change of slope."""
    best = np.maximum(arrived, arrived.max(0) - np.float32(CORNER_PRICE))
    for change in range(1, MAX_BEND + 1):
        price = np.float32(BEND_PRICE * change)
        np.maximum(best[change:], arrived[:-change] - price, out=best[change:])
        np.maximum(best[:-change], arrived[change:] - price, out=best[:-change])
    return best


def _traced_back(arrived: NDArray[np.float32], slope: int, state: int) -> NDArray[np.int64]:
    """States and slopes (2, stations) on the way to a state that is left with a slope, both counted from 0.

    arrived : (stations, slopes, states)
    """
    count, slopes, states = arrived.shape
    prices = np.minimum(BEND_PRICE * np.arange(slopes), CORNER_PRICE)
    prices[MAX_BEND + 1 :] = CORNER_PRICE
    way = np.empty((2, count), np.int64)
    for k in range(count - 1, -1, -1):
        slope = int(np.argmax(arrived[k, :, state] - prices[np.abs(np.arange(slopes) - slope)]))
        state = min(max(state - (slope - slopes // 2), 0), states - 1)
        way[:, k] = state, slope
    return way


@dataclass(frozen=True, eq=False)
class CurveGrid:
    """A grid of places on the page, by stations along and states across.

    base : (stations, 1) places from which the states are counted
    across : (stations, 1) unit vectors towards the next state
    offsets : (states,) of the states from the base [mm]
    along : (stations, states) vectors from a place to that of the next station with the same state
    steepest : maximum slope, in states per station
    inside : (stations, states) whether there is room
    """

    base: Points
    across: Points
    offsets: NDArray[np.float64]
    along: Points
    steepest: int
    wraps: bool
    inside: NDArray[np.bool_]

    @cached_property
    def places(self) -> Points:
        """The places (stations, states) [mm of page]."""
        return self.base + self.across * self.offsets

    @cached_property
    def spacing(self) -> NDArray[np.float64]:
        """The distances (states,) from state to state [mm]."""
        return np.gradient(self.offsets)

    def between(self, states: NDArray[np.float64]) -> Points:
        """Places (stations,) of states that need not be whole numbers."""
        return self.base[:, 0] + self.across[:, 0] * np.interp(states, np.arange(self.offsets.size), self.offsets)


@dataclass(frozen=True, eq=False)
class Evidence:
    """The ink that is evidence for a line at the places of a grid.

    answers : how much more ink lies on a line with each slope than beside it (stations, states, slopes)
    best : the maximum of such answers over all directions (stations, states)
    noise : standard deviation of an answer on bare paper
    """

    answers: Rewards
    best: NDArray[np.float32]
    noise: float


def grid_of(view: PrintedView) -> CurveGrid:
    """The grid of places at which the curve of a view may run."""
    return _round_origin(view) if view.closed else _over_axis(view)


def _round_origin(view: PrintedView) -> CurveGrid:
    left, bottom, right, top = view.room
    turn = 2 * np.pi / ROUND_STATIONS
    outwards = np.exp(1j * turn * np.arange(ROUND_STATIONS))[:, None]
    corners = np.array([complex(x, y) for x in (left, right) for y in (bottom, top)])
    farthest = max(float(np.abs(corners - view.origin).max()), INNER_RADIUS + 1)
    relative = min(RELATIVE_STEP, MAX_STEP / farthest)
    radius = INNER_RADIUS * np.exp(relative * np.arange(int(np.log(farthest / INNER_RADIUS) / relative) + 2))
    base = np.full(outwards.shape, view.origin, np.complex128)
    along = 1j * outwards * radius * turn
    steepest = round(MAX_ROUND_SLOPE * turn / relative)
    return CurveGrid(base, outwards, radius, along, steepest, True, _inside(base + outwards * radius, view))


def _over_axis(view: PrintedView) -> CurveGrid:
    _, bottom, _, top = view.room
    step = min(max((view.end - view.start) / ROUND_STATIONS, MIN_STATION_STEP), MAX_STATION_STEP)
    count = round((view.end - view.start) / step) + 1
    base = np.asarray(view.origin + np.linspace(view.start, view.end, count)[:, None], np.complex128)
    spacing = max(ACROSS_STEP, (top - bottom) / MAX_STATES)
    offsets = np.arange(bottom, top, spacing) - view.origin.imag
    upwards = np.full(base.shape, 1j)
    along = np.full((count, offsets.size), complex(base[1, 0] - base[0, 0]))
    steepest = round(MAX_AXIS_SLOPE * step / spacing)
    return CurveGrid(base, upwards, offsets, along, steepest, False, _inside(base + upwards * offsets, view))


def _inside(places: Points, view: PrintedView) -> NDArray[np.bool_]:
    """Whether places (...) are in the room; the ends of an axis may lie at its edge."""
    left, bottom, right, top = view.room
    beside = EDGE_MARGIN if view.closed else -np.inf
    across = (places.real > left + beside) & (places.real < right - beside)
    return np.asarray(across & (places.imag > bottom + EDGE_MARGIN) & (places.imag < top - EDGE_MARGIN))


def evidence_of(ink: Ink, grid: CurveGrid) -> Evidence:
    """The pencil's answers for every place and slope of a grid."""
    reduced = ink.pencil.reduced(PIXELS_PER_MM)
    answers = np.empty((DIRECTION_COUNT, *grid.places.shape), np.float32)
    quiet: list[NDArray[np.float32]] = []
    for k, (_, answer) in enumerate(ridges(reduced)):
        answers[k] = answer.at(grid.places)
        quiet.append(answer.values[::6, ::6].ravel())
    slopes = np.arange(-grid.steepest, grid.steepest + 1)
    chosen = np.empty((*grid.places.shape, slopes.size), np.float32)
    for k, slope in enumerate(slopes):
        angle = np.angle(grid.along + slope * grid.spacing * grid.across)
        direction = np.round(angle * DIRECTION_COUNT / np.pi).astype(np.int64) % DIRECTION_COUNT
        chosen[:, :, k] = np.take_along_axis(answers, direction[None], 0)[0]
    chosen[~grid.inside] = OUTSIDE_REWARD
    return Evidence(chosen, answers.max(0), spread(np.concatenate(quiet)))


def hidden_places(black: Raster, grid: CurveGrid) -> NDArray[np.bool_]:
    """Whether black print lies at each place (stations, states)."""
    return black.at(grid.places, nearest=True) > 0.5
