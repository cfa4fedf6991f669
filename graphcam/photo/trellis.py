"""The best way through a grid of places: a dynamic programme whose states are a place across and a slope.

The slope is part of the state, so that a line that bends costs more than one that runs on.  R. Bellman, "Dynamic
Programming", 1957; for lines in pictures U. Montanari, "On the optimal detection of curves in noisy pictures",
Communications of the ACM 14 (1971).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

BEND = 0.03
"""Price of a slope that changes by one, in rewards of the best possible station."""
FARTHEST_BEND = 2
"""The slope changes by at most so much a station, except at a corner."""
CORNER = 1.5
"""Price of a corner, at which the slope changes at will: a station and a half without a line."""
NOWHERE = np.float32(-1e6)
BLOCK = 32
"""Stations whose values are kept at a time: those of the others are reckoned again on the way back, to save memory."""

Rewards = NDArray[np.float32]
"""(stations, states, slopes): of leaving a state of a station with a slope, which is the change of the state up to the
next station; slopes run from -m to m."""


@dataclass(frozen=True, eq=False)
class BestWay:
    """A way through the grid: at each station (n,) its state and the slope with which it leaves."""

    states: NDArray[np.int64]
    slopes: NDArray[np.int64]


def best_way(rewards: Rewards, wraps: bool) -> BestWay:
    """The way with the greatest sum of rewards, less what its bends cost.

    wraps : whether the last station is followed by the first

    >>> rewards = np.zeros((6, 9, 5), np.float32)
    >>> rewards[np.arange(6), [1, 2, 3, 4, 5, 6]] = 1
    >>> best_way(rewards, wraps=False).states.tolist()
    [1, 2, 3, 4, 5, 6]
    """
    count = rewards.shape[0]
    if not wraps:
        return _best(rewards, np.arange(count))
    # Two turns, of which the middle one has forgotten where it began and does not know where it ends.
    half = count // 2
    turned = _best(rewards, np.arange(2 * count) % count)
    middle = slice(half, half + count)
    return BestWay(np.roll(turned.states[middle], half), np.roll(turned.slopes[middle], half))


def _best(rewards: Rewards, stations: NDArray[np.int64]) -> BestWay:
    """The best way through the stations in this order."""
    _, states, slopes = rewards.shape
    value = np.zeros((slopes, states), np.float32)
    blocks = np.split(stations, np.arange(BLOCK, stations.size, BLOCK))
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
        arrived[k][from_outside] = NOWHERE
        value = _turned(arrived[k])
    return arrived, value


def _turned(arrived: NDArray[np.float32]) -> NDArray[np.float32]:
    """The best values (slopes, states) after the slope may have changed."""
    best = np.maximum(arrived, arrived.max(0) - np.float32(CORNER))
    for change in range(1, FARTHEST_BEND + 1):
        price = np.float32(BEND * change)
        np.maximum(best[change:], arrived[:-change] - price, out=best[change:])
        np.maximum(best[:-change], arrived[change:] - price, out=best[:-change])
    return best


def _traced_back(arrived: NDArray[np.float32], slope: int, state: int) -> NDArray[np.int64]:
    """States and slopes (2, stations) on the way to a state that is left with a slope, both counted from 0.

    arrived : (stations, slopes, states)
    """
    count, slopes, states = arrived.shape
    prices = np.minimum(BEND * np.arange(slopes), CORNER)
    prices[FARTHEST_BEND + 1 :] = CORNER
    way = np.empty((2, count), np.int64)
    for k in range(count - 1, -1, -1):
        slope = int(np.argmax(arrived[k, :, state] - prices[np.abs(np.arange(slopes) - slope)]))
        state = min(max(state - (slope - slopes // 2), 0), states - 1)
        way[:, k] = state, slope
    return way
