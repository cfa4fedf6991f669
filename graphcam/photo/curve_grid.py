"""The places at which a curve may run: once round an origin, or over an axis; and what speaks for each of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.pencil_ink import Ink
from graphcam.photo.printed import Points, PrintedView
from graphcam.photo.raster import Raster
from graphcam.photo.ridges import DIRECTIONS, PER_MM, ridges, spread
from graphcam.photo.trellis import Rewards

ACROSS = 0.2
"""Step across an axis [mm]; the place of a curve is refined afterwards."""
RELATIVE, WIDEST = 0.0035, 0.4
"""Step across a curve round an origin, as a share of the distance from it, so that slopes have equal steps everywhere,
and the widest one [mm], which is as wide as a stroke."""
MOST_STATES = 900
"""Across an axis: a diagram on A1 takes no more memory than one on A3."""
ROUND = 360
"""Stations round an origin."""
SHORTEST, LONGEST = 0.5, 1.0
"""Step along an axis [mm]: a drawing over 360 mm has as many stations as one round an origin."""
INNER = 10.0
"""No curve runs nearer to its origin [mm]: there all rays of a construction meet."""
EDGE = 0.8
"""The margin beside the edge of the room [mm] in which its own line may be printed."""
STEEPEST_ROUND = 1.2
"""Slope against the circle, 50 degrees: a cam's pressure angle is less."""
STEEPEST_OVER = 3.7
"""Slope over an axis, 75 degrees."""
LOST = -0.02
"""Reward of a place without room, as little as noise has."""


@dataclass(frozen=True, eq=False)
class CurveGrid:
    """Places on the page, by stations along and states across.

    base : (stations, 1) from where the states are counted
    across : (stations, 1) towards the next state, of length one
    offsets : (states,) of the states from the base [mm]
    along : (stations, states) from a place to that of the next station with the same state
    steepest : greatest slope, in states a station
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
        """(stations, states) mm of page."""
        return self.base + self.across * self.offsets

    @cached_property
    def spacing(self) -> NDArray[np.float64]:
        """(states,) mm from state to state."""
        return np.gradient(self.offsets)

    def between(self, states: NDArray[np.float64]) -> Points:
        """Places (stations,) of states that need not be whole."""
        return self.base[:, 0] + self.across[:, 0] * np.interp(states, np.arange(self.offsets.size), self.offsets)


@dataclass(frozen=True, eq=False)
class Evidence:
    """What speaks for the places of a grid.

    answers : how much more ink lies on a line with each slope than beside it (stations, states, slopes)
    best : the same of a line in any direction (stations, states)
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
    turn = 2 * np.pi / ROUND
    outwards = np.exp(1j * turn * np.arange(ROUND))[:, None]
    corners = np.array([complex(x, y) for x in (left, right) for y in (bottom, top)])
    farthest = max(float(np.abs(corners - view.origin).max()), INNER + 1)
    relative = min(RELATIVE, WIDEST / farthest)
    radius = INNER * np.exp(relative * np.arange(int(np.log(farthest / INNER) / relative) + 2))
    base = np.full(outwards.shape, view.origin, np.complex128)
    along = 1j * outwards * radius * turn
    steepest = round(STEEPEST_ROUND * turn / relative)
    return CurveGrid(base, outwards, radius, along, steepest, True, _inside(base + outwards * radius, view))


def _over_axis(view: PrintedView) -> CurveGrid:
    _, bottom, _, top = view.room
    step = min(max((view.end - view.start) / ROUND, SHORTEST), LONGEST)
    count = round((view.end - view.start) / step) + 1
    base = np.asarray(view.origin + np.linspace(view.start, view.end, count)[:, None], np.complex128)
    spacing = max(ACROSS, (top - bottom) / MOST_STATES)
    offsets = np.arange(bottom, top, spacing) - view.origin.imag
    upwards = np.full(base.shape, 1j)
    along = np.full((count, offsets.size), complex(base[1, 0] - base[0, 0]))
    steepest = round(STEEPEST_OVER * step / spacing)
    return CurveGrid(base, upwards, offsets, along, steepest, False, _inside(base + upwards * offsets, view))


def _inside(places: Points, view: PrintedView) -> NDArray[np.bool_]:
    """Whether places (...) are in the room; the ends of an axis may lie at its edge."""
    left, bottom, right, top = view.room
    beside = EDGE if view.closed else -np.inf
    across = (places.real > left + beside) & (places.real < right - beside)
    return np.asarray(across & (places.imag > bottom + EDGE) & (places.imag < top - EDGE))


def evidence_of(ink: Ink, grid: CurveGrid) -> Evidence:
    """What the pencil says for every place and slope."""
    reduced = ink.pencil.reduced(PER_MM)
    answers = np.empty((DIRECTIONS, *grid.places.shape), np.float32)
    quiet: list[NDArray[np.float32]] = []
    for k, (_, answer) in enumerate(ridges(reduced)):
        answers[k] = answer.at(grid.places)
        quiet.append(answer.values[::6, ::6].ravel())
    slopes = np.arange(-grid.steepest, grid.steepest + 1)
    chosen = np.empty((*grid.places.shape, slopes.size), np.float32)
    for k, slope in enumerate(slopes):
        angle = np.angle(grid.along + slope * grid.spacing * grid.across)
        direction = np.round(angle * DIRECTIONS / np.pi).astype(np.int64) % DIRECTIONS
        chosen[:, :, k] = np.take_along_axis(answers, direction[None], 0)[0]
    chosen[~grid.inside] = LOST
    return Evidence(chosen, answers.max(0), spread(np.concatenate(quiet)))


def hidden_in(black: Raster, grid: CurveGrid) -> NDArray[np.bool_]:
    """Whether black print lies at each place (stations, states)."""
    return black.at(grid.places, nearest=True) > 0.5
