"""How large the diagrams over the cam angle are drawn where the task leaves it open: the ordinate and the poles."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import count, pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import broken_axis
from graphcam.drafting.scale import Scale
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Motion, MovingPhase
from graphcam.given.stations import Stations

STANDARD_ORDINATES = (80.0, 60.0, 50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.0, 10.0, 8.0, 6.0, 5.0)
"""Ordinates that are chosen from [mm of paper]."""
SMALL_ORDINATES = (40.0, 30.0, 25.0, 20.0, 15.0, 12.0, 10.0, 8.0, 6.0, 5.0)
"""Tenths of these, hundredths and so on where even the last of them is too large."""
STANDARD_POLES = (12.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 80.0)
"""Pole distances that are chosen from [mm of paper]."""
DEFAULT_POLE = 40.0
"""At 1 degree a millimetre [mm of paper]; where the axis is shorter it is shorter in proportion, so that chords keep
their slopes."""
MIN_POLE = 30.0
"""Rays from a shorter pole are too short for a straightedge; where there is room, no pole is shorter [mm of paper]."""
MIN_DISPLACEMENT = 15.0
"""For longer poles the displacement is drawn no lower than this [mm of paper]."""
LOW_DIAGRAM_SHARE = 0.7
"""A diagram that is lower than this part of its room gets a shorter pole, as long as it keeps to the room."""
MAX_POLE_SHARE = 0.25
"""The maximum pole, as a part of the axis of the cam angle: a longer one would take the room of the diagrams."""
HEIGHT_SHARE_WITH_JERK = 0.75
"""The part of their heights that the diagrams keep where that of the jerk shares their column."""
PHASE_SAMPLES = 361
"""The number of samples of each phase, however short it is."""
PIECE_SAMPLES = 9
"""The number of further samples of a piece of a law that lies between few of these, its middle among them."""
SHORT_PIECE = PIECE_SAMPLES / PHASE_SAMPLES


MIN_PART_WIDTH, NARROW_PART_WIDTH = 5.0, 4.0
"""Parts of a phase are so wide where the usual axis has room, and so wide where the page has it [mm of paper]."""
FINER_AXES = (2.5, 2.0, 1.5, 1.25, 1.0, 0.8, 0.75, 0.6, 0.5, 0.4, 0.3, 0.25, 0.2, 0.15, 0.125, 0.1)
"""Scales of a cam angle whose long dwells are broken [degrees/mm]."""


def narrowest_part(stations: Stations) -> float:
    """The smallest part of a phase that is drawn [rad]; infinite where nothing moves but in jumps."""
    return float(np.diff(stations.phi)[stations.left][~stations.blows].min(initial=math.inf))


def cam_angle_scale(
    motion: Motion, stations: Stations, usual: float, longest: float, *, breaks: bool = True, long: bool = True
) -> Scale:
    """The scale of the cam angle [rad/mm]: the usual one, or a finer one with broken dwells where parts were narrow.

    usual : degrees/mm, for a whole turn;  longest : that the axis and a pole may be on a page [mm of paper]
    breaks : whether dwells may be broken
    long : whether the axis is rather longer than usual than its parts narrower than 5 mm
    """
    least = narrowest_part(stations)
    whole = Scale(math.radians(usual), "rad")
    if whole.paper(least) >= MIN_PART_WIDTH * (1 - SAME_WIDTH):
        return whole
    scales = [math.radians(each) for each in (usual, *FINER_AXES) if each <= usual]
    finer = [broken_axis(motion, each) if breaks else Scale(each, "rad") for each in scales]
    lengths = [
        (axis, float(axis.paper(FULL_TURN)), min(MIN_POLE, math.radians(DEFAULT_POLE) / axis.per_mm)) for axis in finer
    ]
    usual_room = [axis for axis, length, _ in lengths if length <= whole.paper(FULL_TURN) * (1 + SAME_WIDTH)] or [whole]
    page = [axis for axis, length, pole in lengths if length + pole <= longest] or usual_room
    narrow, longer = (usual_room, NARROW_PART_WIDTH), (page, MIN_PART_WIDTH)
    between = (longer, narrow) if long else (narrow, longer)
    for axes, width in ((usual_room, MIN_PART_WIDTH), *between, (page, NARROW_PART_WIDTH)):
        if wide := [axis for axis in axes if least / axis.per_mm >= width * (1 - SAME_WIDTH)]:
            return wide[0 if width == MIN_PART_WIDTH or axes is page else -1]
    # Where no axis has wide parts, those of the finest are the widest.
    return min((*usual_room, *page), key=lambda axis: axis.per_mm)


SAME_WIDTH = 1e-9
"""Widths that differ by less than this part are equal."""


@dataclass(frozen=True)
class DiagramRoom:
    """What the diagrams of a format are drawn for.

    degrees_per_mm : of the cam angle, so that a turn and the poles fit across the sheet
    a, v, s : heights that the whole diagrams should keep to [mm of paper]
    pole : the longest that there is room for [mm of paper]
    """

    degrees_per_mm: float
    a: float
    v: float
    s: float
    pole: float = math.inf

    @property
    def beside_jerk(self) -> DiagramRoom:
        """The room where the jerk stands in the column too."""
        a, v, s = (HEIGHT_SHARE_WITH_JERK * high for high in (self.a, self.v, self.s))
        return replace(self, a=a, v=v, s=s)


@dataclass(frozen=True, eq=False)
class DrawnHeights:
    """The heights of a motion's diagrams [mm of paper], by the ordinate of the first rise and the poles.

    >>> from math import pi
    >>> import graphcam as gc
    >>> slow, steep = gc.Return(30, 4 * pi / 3, "3-4-5"), gc.Return(30, pi / 4, "3-4-5")
    >>> room, page = DiagramRoom(2.0, a=90.0, v=75.0, s=40.0), DiagramRoom(2.0, a=162.0, v=162.0, s=162.0)
    >>> mu_phi = Scale(math.radians(2.0), "rad")
    >>> DrawnHeights(gc.Motion([gc.Rise(30, 2 * pi / 3, "3-4-5"), slow]), mu_phi).choose(room, page)
    (40.0, (30.0, 40.0))
    >>> DrawnHeights(gc.Motion([gc.Rise(30, 7 * pi / 4, "3-4-5"), steep]), mu_phi).choose(room, page)
    (1.5, (20.0, 20.0))
    """

    motion: Motion
    mu_phi: Scale

    @cached_property
    def values(self) -> tuple[Floats, Floats, Floats]:
        """s, v and a over the turn."""
        return over_the_turn(self.motion)

    @property
    def turn(self) -> float:
        """How long the axis of the cam angle is."""
        return float(self.mu_phi.paper(FULL_TURN))

    @property
    def degrees_per_mm(self) -> float:
        """The scale of the cam angle."""
        return math.degrees(self.mu_phi.per_mm)

    @cached_property
    def unit(self) -> tuple[float, float, float]:
        """Acceleration, velocity and displacement at an ordinate and poles of 1 mm."""
        _, mu_a = self.motion.reference
        mu_phi = self.mu_phi.per_mm
        s, v, a = map(_height, self.values)
        # mu_v = mu_a mu_phi H1, mu_s = mu_v mu_phi H2.
        return a / mu_a, v / (mu_a * mu_phi), s / (mu_a * mu_phi**2)

    def largest_ordinate(self, most: DiagramRoom, poles: tuple[float, float]) -> float:
        """The largest at which no diagram exceeds a room."""
        (a, v, s), (first, second) = self.unit, poles
        # Where the velocity jumps in every phase, no acceleration is drawn.
        return min(most.a / a if a else math.inf, most.v * first / v, most.s * first * second / s)

    def fit(self, most: DiagramRoom, ordinate: float, poles: tuple[float, float]) -> bool:
        """Whether an ordinate and poles leave diagrams within a room."""
        return max(poles) <= most.pole and ordinate <= self.largest_ordinate(most, poles)

    def displacement(self, ordinate: float, poles: tuple[float, float]) -> float:
        """How high the displacement is drawn."""
        return ordinate * self.unit[2] / (poles[0] * poles[1])

    def choose(
        self,
        room: DiagramRoom,
        most: DiagramRoom,
        ordinate: float | None = None,
        poles: tuple[float, float] | None = None,
    ) -> tuple[float, tuple[float, float]]:
        """The ordinate and the poles: those that are given, or else such that the diagrams keep to their room.

        most : what no diagram may exceed, for no page would take it
        """
        first, found = self.highest(room, most, ordinate, poles)
        return first, poles or self._lengthened(most, first, found)

    def highest(
        self,
        room: DiagramRoom,
        most: DiagramRoom,
        ordinate: float | None = None,
        poles: tuple[float, float] | None = None,
    ) -> tuple[float, tuple[float, float]]:
        """As :meth:`choose`, with poles so short that velocity and displacement fill their room."""
        first = ordinate or self._chosen_ordinate(room, most)
        found = poles or self._chosen_poles(room, most, first)
        if ordinate is None:
            # Poles that are given, or the longest, may not make velocity and displacement low enough.
            largest = self.largest_ordinate(most, found)
            first = next(y for y in _ordinates() if y <= min(first, largest))
        return first, found

    def jerk_pole(self, room: DiagramRoom, ordinate: float) -> float:
        """The longest pole of a round series at which the jerk keeps to the room of the velocity."""
        mu_a = self.motion.reference[1] / ordinate
        phase, u = _places(self.motion)
        sides = np.concatenate([self.motion.at(phase, u, side)[3] for side in ("right", "left")])
        # A pole of 1 mm cuts off the slope of the acceleration on paper.
        height = _height(sides) * self.mu_phi.per_mm / mu_a
        longest = min(MAX_POLE_SHARE * self.turn, room.pole)
        return next(pole for pole in _jerk_poles(longest) if pole * height <= room.v)

    def _chosen_ordinate(self, room: DiagramRoom, most: DiagramRoom) -> float:
        """The largest of a round series at which the acceleration keeps to its room."""
        a, v, s = self.unit
        if not a:  # the velocity jumps in every phase, and is what is laid off
            pole = DEFAULT_POLE / self.degrees_per_mm
            return next(y for y in _ordinates() if y * v <= room.v * pole and y * s <= room.s * pole**2)
        # Rather than a very small ordinate a diagram that is higher than usual.
        usual = (y for y in STANDARD_ORDINATES if y * a <= (most if y == STANDARD_ORDINATES[-1] else room).a)
        return next(usual, None) or next(y for y in _ordinates() if y * a <= most.a)

    def _chosen_poles(self, room: DiagramRoom, most: DiagramRoom, ordinate: float) -> tuple[float, float]:
        """Acceleration to velocity and on to displacement.

        The usual ones; longer ones where a diagram would be too high, shorter ones where it would be much lower than
        its room.
        """
        _, v, s = (ordinate * height for height in self.unit)
        possible = self._possible_poles(most)
        first = self._pole(possible, min(room.v, most.v), lambda pole: v / pole)
        second = self._pole(possible, min(room.s, most.s), lambda pole: s / (first * pole))
        if s > most.s * first * second:
            # The second alone would be too long.
            longer = [pole for pole in possible if pole >= first]
            first = next((pole for pole in longer if s <= most.s * pole * second), longer[-1])
        return first, second

    def _possible_poles(self, most: DiagramRoom) -> Sequence[float]:
        longest = min(max(MAX_POLE_SHARE * self.turn, MIN_POLE), most.pole)
        return [pole for pole in STANDARD_POLES if pole <= longest] or STANDARD_POLES[:1]

    def _lengthened(self, most: DiagramRoom, ordinate: float, poles: tuple[float, float]) -> tuple[float, float]:
        """Poles near to others, neither of them shorter than ``MIN_POLE``, or else the shorter as long as possible."""
        possible, product_of_both = self._possible_poles(most), poles[0] * poles[1]
        longest = max(product_of_both, ordinate * self.unit[2] / MIN_DISPLACEMENT)
        pairs = [(p, q) for p in possible for q in possible if p >= poles[0] and product_of_both <= p * q <= longest]

        def merit(pair: tuple[float, float]) -> tuple[float, float]:
            """How long the shorter pole is, and then how near the poles are to the others."""
            return min(MIN_POLE, *pair), -sum(abs(math.log(new / old)) for new, old in zip(pair, poles, strict=True))

        return max(pairs, key=merit, default=poles)

    def _pole(self, possible: Sequence[float], high: float, height: Callable[[float], float]) -> float:
        usual = DEFAULT_POLE / self.degrees_per_mm
        k = min(range(len(possible)), key=lambda k: abs(possible[k] - usual))
        while k + 1 < len(possible) and height(possible[k]) > high:
            k += 1
        while k > 0 and height(possible[k]) < LOW_DIAGRAM_SHARE * high and height(possible[k - 1]) <= high:
            k -= 1
        return possible[k]


@lru_cache(maxsize=16)  # because an arm's scale is chosen by it too
def over_the_turn(motion: Motion) -> tuple[Floats, Floats, Floats]:
    """s, v and a at many places of every phase; in a blow, which is not drawn, a is 0."""
    phase, u = _places(motion)
    s, v, a, _ = motion.at(phase, u)
    return s, v, np.where(motion.in_blow(phase, u), 0.0, a)


def _places(motion: Motion) -> tuple[NDArray[np.intp], Floats]:
    """The phases, and fractions of them, at which the heights are taken; pieces that may lie between two have more."""
    fractions: list[Floats] = []
    for phase in motion.phases:
        ends = (0.0, *phase.normalised.edges, 1.0) if isinstance(phase, MovingPhase) else ()
        short = [np.linspace(*piece, PIECE_SAMPLES) for piece in pairwise(ends) if np.diff(piece) < SHORT_PIECE]
        fractions.append(np.concatenate([np.linspace(0.0, 1.0, PHASE_SAMPLES), *short]))
    return np.repeat(np.arange(len(fractions)), [u.size for u in fractions]), np.concatenate(fractions)


def _height(values: Floats) -> float:
    return float(max(0.0, values.max()) - min(0.0, values.min()))


def _jerk_poles(longest: float) -> Iterator[float]:
    """The poles that are usually chosen from, the longest first, and ever smaller ones."""
    yield from (pole for pole in reversed(STANDARD_POLES) if pole <= longest)
    for k in count(0):
        yield from (y / 10**k for y in (10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.2))


def _ordinates() -> Iterator[float]:
    """The ordinates that are usually chosen from, and ever smaller ones."""
    yield from STANDARD_ORDINATES
    for k in count(1):
        yield from (y / 10**k for y in SMALL_ORDINATES)
