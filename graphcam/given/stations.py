"""Dividing the phases: the stations of a drawing, at the ends of equal parts of each moving phase."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import Dwell, Motion
from graphcam.given.motion_law import Law
from graphcam.words import say


@dataclass(frozen=True, eq=False)
class Stations:
    """The ends of the parts of every moving phase, both ends of each phase included.

    Attributes
    ----------
    phase : (m,) index of the phase that each station belongs to
    u, phi : (m,) fraction of the phase and cam angle [rad]
    phases : slice of the stations of each moving phase, in order
    pieces : slices between places where the acceleration jumps, and of the ``finer`` phases between its corners;
        neighbours inside a phase share the station there
    stretches : slices of equal parts, which may be shorter than the pieces; neighbours share a station too
    left : (p,) station at which each part begins; it ends at ``left + 1``
    blows : (p,) whether a part is a blow, so that it has no width that could be drawn
    refine : into how many each of the divisions was divided again, 1 for a drawing as it was asked for
    finer : the phases that have more parts than the others, because their acceleration is short
    """

    phase: NDArray[np.intp]
    u: Floats
    phi: Floats
    phases: tuple[slice, ...]
    pieces: tuple[slice, ...]
    stretches: tuple[slice, ...]
    left: NDArray[np.intp]
    blows: NDArray[np.bool_]
    refine: int = 1
    finer: tuple[int, ...] = ()

    @property
    def moving(self) -> NDArray[np.intp]:
        """(m,) which of the moving phases each station belongs to, counted from 0."""
        return np.repeat(np.arange(len(self.phases)), [span.stop - span.start for span in self.phases])

    @property
    def last(self) -> NDArray[np.intp]:
        """The last station of each moving phase."""
        return np.array([span.stop - 1 for span in self.phases])

    @property
    def parts(self) -> tuple[slice, ...]:
        """The parts of each moving phase, as slices of ``left``."""
        # Every phase before k has one part fewer than it has stations.
        return tuple(slice(s.start - k, s.stop - k - 1) for k, s in enumerate(self.phases))


MAX_FINER_PARTS = 48
"""A phase whose acceleration is short is divided into at most so many parts."""
EQUAL_WIDTH = 1e-9
"""Parts whose widths differ by less, as parts of their phase, are equal."""
NO_PHASES: Mapping[int, Sequence[float]] = {}


def divide(
    motion: Motion,
    divisions: int,
    refine: int = 1,
    *,
    at_corners: bool = False,
    finer: Mapping[int, Sequence[float]] = NO_PHASES,
) -> Stations:
    """Divide each moving phase into ``divisions`` equal parts, and each of these again into ``refine``.

    A phase whose acceleration jumps inside is divided so that the jump falls on a division: each stretch between
    jumps gets its own whole number of equal parts, in proportion, at least one.  With ``at_corners`` the corners of the
    acceleration fall on divisions too, where what is looked for may be greatest in a corner.

    finer : the cuts u, both ends of the phase among them, of phases by their index that are not divided equally

    A blow, in which the velocity jumps, is a part of its own beside the ``divisions``.

    Raises
    ------
    DesignError : divisions is less than 1

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi, "rectangular", ratio=3.0), gc.Return(30, pi, "cosine")])
    >>> stations = divide(motion, 4)
    >>> stations.u.tolist()
    [0.0, 0.25, 0.5, 0.75, 1.0, 0.0, 0.25, 0.5, 0.75, 1.0]
    >>> stations.pieces
    (slice(0, 2, None), slice(1, 5, None), slice(5, 10, None))
    >>> triangular = gc.Motion([gc.Rise(30, pi, "triangular"), gc.Return(30, pi, "cosine")])
    >>> divide(triangular, 6, at_corners=True).u[:7].round(3).tolist()
    [0.0, 0.125, 0.25, 0.417, 0.583, 0.75, 1.0]
    >>> divide(triangular, 3, finer={0: [0, 0.125, 0.25, 0.75, 1]}).stretches
    (slice(0, 3, None), slice(2, 4, None), slice(3, 5, None), slice(5, 9, None))
    """
    if divisions < 1:
        raise DesignError("divisions", divisions, say("1 or more parts per phase"))
    phase: list[int] = []
    u: list[float] = []
    phases: list[slice] = []
    pieces: list[slice] = []
    stretches: list[slice] = []
    for k, part in enumerate(motion.phases):
        if isinstance(part, Dwell):
            continue
        law = part.normalised
        # Where the stretches of equal parts begin and end.
        blows = _ends_of_blows(law)
        apart = (*law.jumps, *blows, 1.0)
        ends = (0.0, *sorted({*apart, *(law.corners if at_corners else ())}))
        runs = zip(pairwise(ends), _shares(ends, divisions + len(blows)), strict=True)
        if k in finer:
            # Across a short acceleration no hand fairs a curve: the line on either side of it is nearly straight.
            apart = (*apart, *law.corners)
            runs = _runs(finer[k], apart)
        first = begun = len(u)
        u.append(0.0)
        for (start, end), share in runs:
            n = share * refine
            stretches.append(slice(len(u) - 1, len(u) + n))
            # The end itself, since a rounding beyond it the acceleration has jumped.
            u.extend([*(start + (end - start) * np.arange(1, n) / n), end])
            if end in apart:
                pieces.append(slice(begun, len(u)))
                begun = len(u) - 1
        phase += [k] * (len(u) - first)
        phases.append(slice(first, len(u)))
    phase_of, fraction = np.array(phase), np.array(u)
    angles = np.array([part.angle for part in motion.phases])
    left = np.concatenate([np.arange(s.start, s.stop - 1) for s in phases])
    phi = motion.starts[phase_of] + fraction * angles[phase_of]
    blows = motion.in_blow(phase_of[left], (fraction[left] + fraction[left + 1]) / 2)
    made = phase_of, fraction, phi, tuple(phases), tuple(pieces), tuple(stretches), left, blows, refine
    return Stations(*made, tuple(finer))


def falling_blows(motion: Motion, stations: Stations) -> list[tuple[int, int]]:
    """The first and the last station of each place where the velocity falls at once: the cam has a corner there.

    >>> import graphcam as gc
    >>> uniform = gc.constant_velocity_law(0, 0)
    >>> heart = gc.Motion([gc.Rise(30, np.pi, uniform), gc.Return(30, np.pi, uniform)])
    >>> falling_blows(heart, divide(heart, 2))
    [(3, 6)]
    """
    v, starts, found = motion.at(stations.phase, stations.u)[1], stations.left, list[tuple[int, int]]()
    for first in starts[stations.blows & (v[starts + 1] < v[starts])].tolist():
        # Where no dwell lies between them, two phases meet in one corner.
        if found and found[-1][1] + 1 == first and stations.phi[first] - stations.phi[first - 1] < EQUAL_WIDTH:
            found[-1] = found[-1][0], first + 1
        else:
            found.append((first, first + 1))
    return found


def _ends_of_blows(law: Law) -> tuple[float, ...]:
    """The inner places u where a blow ends or begins."""
    return tuple(u for u in law.steady if 0 < u < 1)


def cuts_at_corners(law: Law, divisions: int) -> Floats:
    """The cuts u of so many parts, or more, with the jumps and corners of the acceleration, unless these are too many.

    >>> import graphcam as gc
    >>> cuts_at_corners(gc.law("trapezoidal"), 4).tolist()
    [0.0, 0.125, 0.375, 0.625, 0.875, 1.0]
    """
    corners = law.corners if len(law.jumps) + len(law.corners) < MAX_FINER_PARTS else ()
    blows = _ends_of_blows(law)
    ends = (0.0, *sorted({*law.jumps, *corners, *blows}), 1.0)
    shares = zip(pairwise(ends), _shares(ends, divisions + len(blows)), strict=True)
    return np.append(np.concatenate([np.linspace(*ends, n, endpoint=False) for ends, n in shares]), 1.0)


def _runs(cuts: Sequence[float], apart: Sequence[float]) -> list[tuple[tuple[float, float], int]]:
    """The stretches of equal parts between cuts, broken at some of them, and how many parts each has."""
    widths, last = np.diff(cuts), len(cuts) - 1
    bounds = [k for k in range(1, last) if cuts[k] in apart or abs(widths[k] - widths[k - 1]) > EQUAL_WIDTH]
    return [((float(cuts[a]), float(cuts[b])), b - a) for a, b in pairwise((0, *bounds, last))]


@lru_cache
def _shares(ends: tuple[float, ...], divisions: int) -> tuple[int, ...]:
    """Whole numbers of parts for the stretches between ``ends``: in proportion, each at least one."""
    lengths = np.diff(ends)
    shares = np.ones(lengths.size, dtype=np.intp)
    while shares.sum() < divisions:
        # The rule of Sainte-Lague: of two stretches it rounds the shares to the nearest, and of any it keeps the sum.
        shares[np.argmax(lengths / (shares + 0.5))] += 1
    return tuple(shares.tolist())
