"""The damped oscillator of one mass, solved exactly over stretches of a given forcing; nothing is stepped.

    y'' + 2 zeta nu y' + nu^2 y = g(t)

Over a cell, a stretch on which g is smooth, g is the Chebyshev series through its values at :data:`NODES` places, as
good as the machine's numbers or the cell is halved.  One particular solution of that series is a series again:

- in a short cell, nu times half the cell at most :data:`MAX_FAST_RATE`, the one that starts from rest, for w = y'' and
  the integration S from the cell's start: (I + 2 zeta nu S + nu^2 S^2) w = g, near the identity;
- in a long one, from :data:`MIN_SLOW_RATE` on, the one that follows g without vibrating, for the differentiation D:
  (nu^2 I + 2 zeta nu D + D^2) y = g, triangular and again near the identity.

In between the cell is divided until it is short.  To it comes the free vibration in closed form, the same from cell to
cell, so that a state is carried over m equal cells by log2(m) sums.  Every number comes from bounded terms and no error
is handed on and magnified: a stiff oscillator costs what a soft one costs, with any damping from none to ten times the
critical one.

Sources: L. N. Trefethen, *Approximation Theory and Approximation Practice* (2013), chapters 2 to 8; the free vibration:
S. S. Rao, *Mechanical Vibrations* (2011), chapter 2.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import check_number
from graphcam.given.laws import Floats
from graphcam.given.piecewise import CHUNK_SIZE
from graphcam.words import say

NODES = 20
"""Places in a cell through which the forcing's series goes."""
MAX_FAST_RATE, MIN_SLOW_RATE = 2.0, 64.0
"""The fast rate of the free vibration times half a cell, at most, and the slow one, at least."""
RESOLVED_SHARE = 2e-14
"""A series whose last three coefficients are no more than this part of the greatest is as good as its values."""
MAX_CELLS = 64
"""The maximum number of cells into which a smooth stretch is divided to resolve its forcing."""
MAX_DAMPING = 10.0
"""Times the critical damping; from here on a percentage is likelier than a ratio."""
RESONANCE_SHARE = 1e-6
"""A free vibration that comes back after a turn to this part of itself is in resonance."""
PLACES_PER_PERIOD, MIN_CELL_PLACES = 16, 9
"""Places a natural period, and a cell, between which a quantity is taken to have one extreme at most."""

_CHEBYSHEV_NODES = np.cos(np.pi * (np.arange(NODES) + 0.5) / NODES)
_VALUES_TO_SERIES = chebyshev.chebvander(_CHEBYSHEV_NODES, NODES - 1).T * (2 / NODES)
_VALUES_TO_SERIES[0] /= 2
_DERIVATIVE_MATRIX = np.zeros((NODES, NODES))
_DERIVATIVE_MATRIX[:-1] = chebyshev.chebder(np.eye(NODES))
_FIRST_INTEGRAL, _SECOND_INTEGRAL = (chebyshev.chebint(np.eye(NODES), times, lbnd=-1) for times in (1, 2))
_WIDTH = NODES + 2
"""Coefficients of a solution."""
_START_SIGNS = (-1.0) ** np.arange(_WIDTH)


Which = NDArray[np.intp] | slice
"""Numbers of oscillators, or a slice of them."""
ALL_OSCILLATORS = slice(None)


def check_damping(damping: float) -> None:
    """Check a damping ratio.

    Raises
    ------
    DesignError : it is negative, not a number, or more than :data:`MAX_DAMPING`
    """
    limit = say("a ratio to the critical damping from 0 to {most:g}", most=MAX_DAMPING)
    check_number("damping", damping, limit, say("2 % is 0.02"), least=0, most=MAX_DAMPING)


@dataclass(frozen=True, eq=False)
class Oscillator:
    """Oscillators of one damping ratio.

    frequency : (N,) nu, undamped, in rad per unit of time;  damping : zeta, the ratio to the critical damping

    >>> swing = Oscillator(np.array([2.0]), 0.0)
    >>> y, y1 = swing.free(np.array([math.pi / 2]), np.array([1.0]), np.array([0.0]))  # half a period
    >>> y.round(12).tolist()
    [-1.0]
    """

    frequency: Floats
    damping: float

    @cached_property
    def rates(self) -> tuple[Floats, Floats]:
        """(N,) the magnitudes of the slow and of the fast root of the characteristic equation; below critical nu."""
        zeta = self.damping
        if zeta <= 1:
            return self.frequency, self.frequency
        fast = self.frequency * (zeta + math.sqrt((zeta - 1) * (zeta + 1)))
        return self.frequency * (self.frequency / fast), fast  # their product is nu^2: the difference has no digits

    def free(self, t: Floats, y: Floats, y1: Floats, who: Which = ALL_OSCILLATORS) -> tuple[Floats, Floats]:
        """(y, y') at times t after a state (y, y'), left to itself; the leading axis is that of the oscillators.

        who : the numbers of those that are meant, as many as the leading axis has
        """
        shape = (-1, *(1,) * (np.ndim(t) - 1))
        nu = self.frequency[who].reshape(shape)
        zeta = self.damping
        if zeta < 1:
            turning = nu * math.sqrt((1 - zeta) * (1 + zeta))
            decay = np.exp(-zeta * nu * t)
            even, odd = decay * np.cos(turning * t), decay * np.sin(turning * t) / turning
        else:
            apart = 2 * nu * math.sqrt((zeta - 1) * (zeta + 1)) * t
            decay = np.exp(-self.rates[0][who].reshape(shape) * t)
            even = decay * (1 + np.exp(-apart)) / 2
            odd = decay * t * np.divide(-np.expm1(-apart), apart, out=np.ones_like(apart), where=apart != 0)
        damped = zeta * nu * odd
        return (even + damped) * y + odd * y1, (even - damped) * y1 - nu * nu * odd * y

    def first_turning(self, y: Floats, y1: Floats) -> Floats:
        """(N,) the first time at which a state that is left to itself turns, y' = 0; inf where it never does."""
        nu, zeta = self.frequency, self.damping
        # y' = y1 even - (zeta nu y1 + nu^2 y) odd, see free.
        across = zeta * nu * y1 + nu * nu * y
        if zeta < 1:
            turning = nu * math.sqrt((1 - zeta) * (1 + zeta))
            return np.mod(np.arctan2(turning * y1, across), np.pi) / turning
        spread = nu * math.sqrt((zeta - 1) * (zeta + 1))
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = y1 / across
            time = np.arctanh(spread * ratio) / spread if zeta > 1 else ratio
            return np.where((ratio > 0) & np.isfinite(time), time, np.inf)

    def free_peak(self, y: Floats, y1: Floats) -> Floats:
        """(N,) the greatest |y| of a state that is left to itself, from now on."""
        time = self.first_turning(y, y1)
        there = self.free(np.where(np.isfinite(time), time, 0.0), y, y1)[0]
        return np.maximum(np.abs(y), np.abs(there))


@dataclass(frozen=True, eq=False)
class Drive:
    """A forcing g(t) from the first of the edges to the last, smooth between them.

    edges : (p + 1,) in order;  forcing : g at an array of times, none of which is an edge
    """

    edges: Floats
    forcing: Callable[[Floats], Floats]

    def series(self, stretch: int, count: int) -> Floats:
        """(count, NODES) the Chebyshev series of g on equal cells of a stretch."""
        start, end = self.edges[stretch : stretch + 2]
        half = (end - start) / (2 * count)
        middles = start + half * (2 * np.arange(count)[:, None] + 1)
        return self.forcing((middles + half * _CHEBYSHEV_NODES).ravel()).reshape(count, NODES) @ _VALUES_TO_SERIES.T

    @cached_property
    def resolved(self) -> list[int]:
        """The number of equal cells on which each stretch's series are as good as their values; 0 where g is 0."""
        largest, first = 0.0, []
        for stretch in range(self.edges.size - 1):
            first.append(np.abs(self.series(stretch, 1)))
            largest = max(largest, float(first[-1].max()))
        return [self._resolved(stretch, series, largest) for stretch, series in enumerate(first)]

    def _resolved(self, stretch: int, series: Floats, largest: float) -> int:
        if not series.any():
            return 0
        count = 1
        while series[:, -3:].max() > RESOLVED_SHARE * largest and count < MAX_CELLS:
            count *= 2
            series = np.abs(self.series(stretch, count))
        return count

    def counts(self, oscillator: Oscillator) -> NDArray[np.intp]:
        """(N, p) the number of cells of each stretch; negative where they are long."""
        slow, fast = oscillator.rates
        columns: list[NDArray[np.intp]] = []
        for resolved, width in zip(self.resolved, np.diff(self.edges).tolist(), strict=True):
            half = width / 2 / max(resolved, 1)
            finer = np.exp2(np.ceil(np.log2(np.maximum(fast * half / MAX_FAST_RATE, 1.0)))).astype(np.intp)
            long = (slow * half >= MIN_SLOW_RATE) | (resolved == 0)
            columns.append(np.where(long, -max(resolved, 1), finer * resolved))
        return np.stack(columns, axis=1)


@dataclass(frozen=True, eq=False)
class DrivenOscillators:
    """Oscillators under a drive: what they do at any time; before it begins they are taken to be where they begin.

    oscillator : of N;  end : when the drive ends; from then on they are free
    starts, halves : (C,) where each cell begins, and half its length
    forcing : (C, NODES) series of g;  position, rate : (N, C, W) series of the particular solution, and of its y'
    loose : (2, N, C + 1) y and y' of the free vibration where each cell begins, and where the drive ends
    """

    oscillator: Oscillator
    end: float
    starts: Floats
    halves: Floats
    forcing: Floats
    position: Floats
    rate: Floats
    loose: Floats

    @property
    def final(self) -> tuple[Floats, Floats]:
        """(N,) y and y' where the drive ends."""
        return self.loose[0, :, -1], self.loose[1, :, -1]

    def at(self, t: ArrayLike) -> tuple[Floats, Floats]:
        """(N, P) y and y' at times (P,)."""
        t = np.asarray(t, dtype=np.float64)
        cell = np.clip(np.searchsorted(self.starts, t, side="right") - 1, 0, None)
        tau = (t - self.starts[cell]) / self.halves[cell] - 1
        left, left1 = self.final
        y, y1 = self.oscillator.free(np.maximum(t - self.end, 0.0)[None], left[:, None], left1[:, None])
        driven = t < self.end
        y[:, driven], y1[:, driven], _ = self.values(ALL_OSCILLATORS, cell[driven], np.maximum(tau[driven], -1.0))
        return y, y1

    def values(self, who: Which, cell: NDArray[np.intp], tau: Floats) -> tuple[Floats, Floats, Floats]:
        """y, y' and g at places tau from -1 to 1 of cells, (P,): (N, P) of all oscillators, or (P,) of one at each.

        who : all, as a slice, or (P,) the number of the oscillator at each place
        """
        count = self.oscillator.frequency.size if isinstance(who, slice) else 1
        out = np.empty((3, count, tau.size))
        size = max(CHUNK_SIZE // count, 1)
        for here in (slice(k, k + size) for k in range(0, tau.size, size)):
            out[..., here] = self._values(who if isinstance(who, slice) else who[here], cell[here], tau[here])
        y, y1, g = out if isinstance(who, slice) else out[:, 0]
        return y, y1, g

    def _values(self, who: Which, cell: NDArray[np.intp], tau: Floats) -> Floats:
        basis = chebyshev.chebvander(tau, _WIDTH - 1)
        y, y1 = self.loose[:, who, cell]
        t = (tau + 1) * self.halves[cell]
        y, y1 = self.oscillator.free(t[None] if isinstance(who, slice) else t, y, y1, who)
        y += np.einsum("...w,...w->...", self.position[who, cell], basis)
        y1 += np.einsum("...w,...w->...", self.rate[who, cell], basis)
        g = np.einsum("...w,...w->...", self.forcing[cell], basis[..., :NODES])
        found = np.stack([y, y1, np.broadcast_to(g, y.shape)])
        return found if isinstance(who, slice) else found[:, None]

    def times(self, cell: NDArray[np.intp], tau: Floats) -> Floats:
        """The times of places of cells."""
        return self.starts[cell] + (tau + 1) * self.halves[cell]

    def places(self) -> tuple[NDArray[np.intp], Floats]:
        """(P,) cells and places of them, in order, both ends among them, between which extremes lie one by one."""
        fast = float(self.oscillator.rates[1].max())
        counts = np.ceil(PLACES_PER_PERIOD * fast * 2 * self.halves / math.tau).astype(np.intp) + MIN_CELL_PLACES
        cell = np.repeat(np.arange(self.starts.size), counts)
        first = np.repeat(np.cumsum(counts) - counts, counts)
        return cell, 2 * (np.arange(cell.size) - first) / (counts[cell] - 1) - 1


def driven(oscillator: Oscillator, drive: Drive, start: Floats | None = None) -> DrivenOscillators:
    """Oscillators under a drive, from a state (2, N) of y and y', or from rest.

    All of them must have the same :meth:`Drive.counts`.

    >>> push = Drive(np.array([0.0, 1.0]), lambda t: np.ones_like(t))
    >>> y, y1 = driven(Oscillator(np.array([math.tau]), 0.0), push).at([0.5, 1.0])  # a step: 1 - cos over nu^2
    >>> (y * math.tau**2).round(12).tolist()
    [[2.0, 0.0]]
    """
    state = np.zeros((2, oscillator.frequency.size)) if start is None else start
    starts, halves, forcing, positions, rates, loose = ([] for _ in range(6))
    for stretch, count in enumerate(drive.counts(oscillator)[0].tolist()):
        low, high = drive.edges[stretch : stretch + 2].tolist()
        half = (high - low) / (2 * abs(count))
        series = drive.series(stretch, abs(count))
        position, rate = (_following if count < 0 else _rest_solution)(oscillator, series, half)
        states = _carried(oscillator, position, rate, half, state)
        loose.append(states[..., :-1] - np.stack([position @ _START_SIGNS, rate @ _START_SIGNS]))
        state = states[..., -1]
        starts.append(np.linspace(low, high, abs(count), endpoint=False))
        halves.append(np.full(abs(count), half))
        forcing.append(series)
        positions.append(position)
        rates.append(rate)
    loose.append(state[..., None])
    return DrivenOscillators(
        oscillator,
        float(drive.edges[-1]),
        np.concatenate(starts),
        np.concatenate(halves),
        np.concatenate(forcing),
        np.concatenate(positions, axis=1),
        np.concatenate(rates, axis=1),
        np.concatenate(loose, axis=2),
    )


def steady(oscillator: Oscillator, drive: Drive) -> DrivenOscillators | None:
    """Oscillators under a drive that repeats itself without end; None where resonance lets no such motion be.

    >>> push = Drive(np.array([0.0, 1.0]), lambda t: np.sin(math.tau * t))
    >>> steady(Oscillator(np.array([math.tau]), 0.0), push) is None
    True
    >>> y, _ = steady(Oscillator(np.array([3.5]), 0.0), push).at([0.25])  # sin/(3.5^2 - (2 pi)^2)
    >>> round(y.item() * (3.5**2 - math.tau**2), 12)
    1.0
    """
    y, y1 = driven(oscillator, drive).final
    turn = np.full(oscillator.frequency.size, drive.edges[-1] - drive.edges[0])
    one, none = np.ones_like(y), np.zeros_like(y)
    (a, c), (b, d) = oscillator.free(turn, one, none), oscillator.free(turn, none, one)
    determinant = (1 - a) * (1 - d) - b * c
    if determinant.min() < RESONANCE_SHARE**2:
        return None
    start = np.stack([(1 - d) * y + b * y1, c * y + (1 - a) * y1]) / determinant
    return driven(oscillator, drive, start)


def _following(oscillator: Oscillator, series: Floats, half: float) -> tuple[Floats, Floats]:
    """(N, C, W) the series of the solution that follows g, and of its y'."""
    span = (oscillator.frequency * half)[:, None, None]
    matrix = (
        np.eye(NODES)
        + (2 * oscillator.damping / span) * _DERIVATIVE_MATRIX
        + _DERIVATIVE_MATRIX @ _DERIVATIVE_MATRIX / span**2
    )
    followed = np.linalg.solve(matrix, series.T[None] / oscillator.frequency[:, None, None] ** 2)
    return _rows(followed), _rows(_DERIVATIVE_MATRIX @ followed / half)


def _rest_solution(oscillator: Oscillator, series: Floats, half: float) -> tuple[Floats, Floats]:
    """(N, C, W) the series of the solution that starts from rest in each cell, and of its y'."""
    span = (oscillator.frequency * half)[:, None, None]
    matrix = (
        np.eye(NODES) + 2 * oscillator.damping * span * _FIRST_INTEGRAL[:NODES] + span**2 * _SECOND_INTEGRAL[:NODES]
    )
    bent = np.linalg.solve(matrix, np.broadcast_to(series.T, (span.shape[0], *series.T.shape)))
    return _rows(_SECOND_INTEGRAL @ bent * half**2), _rows(_FIRST_INTEGRAL @ bent * half)


def _rows(columns: Floats) -> Floats:
    """(N, C, W) of (N, k, C): the coefficients last, and as many as the longest series has."""
    padded = np.zeros((columns.shape[0], columns.shape[2], _WIDTH))
    padded[..., : columns.shape[1]] = columns.transpose(0, 2, 1)
    return padded


def _carried(oscillator: Oscillator, position: Floats, rate: Floats, half: float, state: Floats) -> Floats:
    """(2, N, C + 1) the states at the ends of C equal cells, from the first one."""
    n, count, _ = position.shape
    (y, y1), after = (np.stack([position @ ends, rate @ ends]) for ends in (_START_SIGNS, np.ones(_WIDTH)))
    width = np.full((n, 1), 2 * half)
    gained = after - np.stack(oscillator.free(width, y, y1))
    step = 1
    while step < count:
        y, y1 = gained[:, :, :-step]
        gained[:, :, step:] += np.stack(oscillator.free(step * width, y, y1))
        step *= 2
    times = width * np.arange(count + 1)
    y, y1 = state[..., None]
    states = np.stack(oscillator.free(times, y, y1))
    states[:, :, 1:] += gained
    return states
