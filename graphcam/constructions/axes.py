"""What every diagram over the cam angle has: its axes, the phases' limits and the stations' names."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Caption, Construction, Words, say
from graphcam.drafting.marks import Arrow, Dimension, Label, Line, Mark, Points, Role, Segments
from graphcam.drafting.scale import BrokenScale, Scale, unit
from graphcam.given.follower import Rotation
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.given.stations import Stations
from graphcam.words import say_in

AXIS_OVERHANG = 8.0
"""How far an axis runs on beyond what is drawn [mm]."""
NUMBER_ROOM = 4.5, 6.0
"""Stations are named that stand at least so far apart [mm of paper]; where some have names of two digits, so far."""
NAMED_STATION_STEPS = (1, 2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30, 40, 50)
"""Every how many stations may be named."""
MIN_INFINITE_ARROW, ARROW_OVERHANG = 14.0, 5.0
"""An arrow for an infinite value is at least so long, and so much longer than the curve is high [mm of paper]."""
SAME_LEVEL = 1e-6
"""Levels that differ by less than this part of the lift are one."""
LEVEL_DIGITS = 9
"""Decimals of a millimetre to which heights are equal but for rounding: a hand that errs makes no two alike."""
SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


BROKEN_DWELL = 14.0
"""A dwell that is broken takes so much of the axis of the cam angle [mm of paper]."""
MIN_SHORTENED = 6.0
"""A dwell is broken where this shortens it by so much at least [mm of paper]."""


def broken_axis(motion: Motion, per_mm: float) -> Scale:
    """The scale [rad/mm] of an axis of the cam angle whose long dwells are broken.

    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, 2.0), gc.Return(30, 2.0), gc.Dwell(FULL_TURN - 4.0)])
    >>> axis = broken_axis(motion, 0.02)
    >>> axis.paper([2.0, FULL_TURN]).tolist(), round(axis.left_out, 2)
    ([100.0, 214.0], 2.0)
    """
    angles = np.array([phase.angle for phase in motion.phases])
    dwells = np.array([phase.kind == "dwell" for phase in motion.phases])
    broken = dwells & (angles / per_mm >= BROKEN_DWELL + MIN_SHORTENED)
    if not broken.any():
        return Scale(per_mm, "rad")
    places = np.cumsum([0.0, *np.where(broken, BROKEN_DWELL, angles / per_mm)])
    ends = (*np.asarray(motion.starts).tolist(), FULL_TURN)
    return BrokenScale(per_mm, "rad", ends, tuple(places.tolist()), tuple(np.flatnonzero(broken).tolist()))


class OverStations(Protocol):
    """What lies on a board on which the phases were divided."""

    @property
    def motion(self) -> Motion:
        """The motion whose phases were divided."""
        ...

    @property
    def stations(self) -> Stations:
        """The ends of the parts of the phases."""
        ...


def sense_caption(rotation: Rotation) -> Caption:
    """The word for a sense of rotation.

    >>> str(sense_caption("cw"))
    'clockwise'
    """
    return say("clockwise") if rotation == "cw" else say("anticlockwise")


def station_names(stations: Stations) -> list[str]:
    """The stations' names: 0, 1, 2 ... in the first moving phase, 0′, 1′ ... in the second, and so on.

    Where the velocity jumps, two stations stand at one place; the one on the moving side is 0⁺, or 12⁻.

    >>> from math import pi
    >>> import graphcam as gc
    >>> from graphcam.given.stations import divide
    >>> station_names(divide(gc.Motion([gc.Rise(30, pi), gc.Return(30, pi)]), 2))
    ['0', '1', '2', '0′', '1′', '2′']
    """
    numbers, twins = _numbers_of_stations(stations)
    signs = {0: "", 1: "⁺", -1: "⁻"}
    return [
        f"{number}{'′' * phase}{signs[way]}"
        for number, way, phase in zip(numbers, twins, stations.moving.tolist(), strict=True)
    ]


def _numbers_of_stations(stations: Stations) -> tuple[list[int], list[int]]:
    """The number of each station in its phase, and on which side of a blow it stands: 1 behind it, -1 before it."""
    numbers, sides = list[int](), list[int]()
    for parts in stations.parts:
        blows = stations.blows[parts].tolist()
        counted = [0, *np.cumsum(~stations.blows[parts]).tolist()]
        numbers += counted
        behind = (blow and not number for blow, number in zip([False, *blows], counted, strict=True))
        before = (blow and number > 0 for blow, number in zip([*blows, False], counted, strict=True))
        sides += [int(after) - int(ahead) for after, ahead in zip(behind, before, strict=True)]
    return numbers, sides


def part_names(stations: Stations) -> list[str]:
    """The parts' names, which their rays and chords bear too: each is called as the station at which it ends.

    >>> from math import pi
    >>> import graphcam as gc
    >>> from graphcam.given.stations import divide
    >>> part_names(divide(gc.Motion([gc.Rise(30, pi), gc.Return(30, pi)]), 2))
    ['1', '2', '1′', '2′']
    """
    names = station_names(stations)
    return [names[k + 1].replace("⁻", "") for k in stations.left]


def joined_parts(parts: Iterable[int], stations: Stations) -> str:
    """The names of several parts, in order; of three or more neighbours in a phase the first and the last.

    >>> from math import pi
    >>> import graphcam as gc
    >>> from graphcam.given.stations import divide
    >>> halves = divide(gc.Motion([gc.Rise(30, pi), gc.Return(30, pi)]), 5)
    >>> joined_parts([0, 1, 2, 4, 5, 6], halves)
    '1-3, 5, 1′, 2′'
    """
    names, runs = part_names(stations), list[list[int]]()
    starts = {parts.start for parts in stations.parts}
    for part in parts:
        if runs and part == runs[-1][-1] + 1 and part not in starts:
            runs[-1].append(part)
        else:
            runs.append([part])
    return joined_runs([names[part] for part in run] for run in runs)


def joined_runs(runs: Iterable[Sequence[str]]) -> str:
    """Names in runs of neighbours; of three or more in a run the first and the last.

    >>> joined_runs([["1", "2", "3"], ["5"], ["7", "8"]])
    '1-3, 5, 7, 8'
    """
    return ", ".join(f"{run[0]}-{run[-1]}" if len(run) > 2 else ", ".join(run) for run in runs)


def part_titles(drawn: Construction[OverStations]) -> list[Caption]:
    """The titles of the parts of the moving phases, by the station at which each ends."""
    names, stations = station_names(drawn.givens.stations), drawn.givens.stations
    return [say("part {name}", name=names[k + 1]) for k in stations.left]


def phase_names(drawn: Construction[OverStations]) -> list[Caption]:
    """The names of the moving phases, with the symbols of their angles."""
    stations = drawn.givens.stations
    return [phase_title(drawn.givens.motion, int(stations.phase[span.start])) for span in stations.phases]


SYMBOLS = {
    "rise": say_in("angle of a rise", "φ{number.index}"),
    "return": say_in("angle of a return", "φ{number.index}"),
    "upper dwell": say_in("angle of the dwell at the top", "φ{number.index}"),
    "lower dwell": say_in("angle of the dwell at the bottom", "φ{number.index}"),
    "dwell": say_in("angle of a dwell between", "φ{number.index}"),
}
LOW_DWELL = say_in("angle of the profile's arc at the bottom", "δ{number.index}")
PHASES = {
    "rise": say("rise {symbol}"),
    "return": say("return {symbol}"),
    "upper dwell": say_in("at the top", "dwell {symbol}"),
    "lower dwell": say_in("at the bottom", "dwell {symbol}"),
    "dwell": say_in("between", "dwell {symbol}"),
}
"""Names of phases and symbols of their angles, by kind and, of a dwell, by where it rests."""


@dataclass(frozen=True)
class PhaseNumber:
    """The number of a phase as subscripts: among all phases, and among those of its kind if there are several."""

    index: str
    again: str


def phase_symbol(motion: Motion, k: int) -> Caption:
    """The symbol of the angle of phase ``k``; schools name it by its number or by its kind.

    >>> import graphcam as gc
    >>> str(phase_symbol(gc.Motion([gc.Rise(30, 2.0), gc.Dwell(1.0), gc.Return(30, 2.0),
    ...     gc.Dwell(FULL_TURN - 5.0)]), 3))
    'φ₄'
    """
    return SYMBOLS[phase_kind(motion, k)].with_values(number=_number(motion, k))


def low_dwell_symbol(motion: Motion, k: int) -> Caption:
    """The symbol of the angle of the profile's arc on which the follower rests at the bottom in phase ``k``.

    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, 2.0), gc.Return(30, 2.0), gc.Dwell(FULL_TURN - 4.0)])
    >>> str(low_dwell_symbol(motion, 2))
    'δ₃'
    """
    return LOW_DWELL.with_values(number=_number(motion, k))


def _number(motion: Motion, k: int) -> PhaseNumber:
    kinds = [phase_kind(motion, i) for i in range(len(motion.phases))]
    again = f"{kinds[: k + 1].count(kinds[k])}" if kinds.count(kinds[k]) > 1 else ""
    return PhaseNumber(f"{k + 1}".translate(SUBSCRIPTS), again.translate(SUBSCRIPTS))


def phase_title(motion: Motion, k: int) -> Caption:
    """The name of phase ``k`` with its symbol: "rise φ₁"."""
    return PHASES[phase_kind(motion, k)].with_values(symbol=phase_symbol(motion, k))


def phase_angle(motion: Motion, k: int) -> Caption:
    """The symbol and the angle of phase ``k``: "φ₁ = 80°"."""
    return say("{symbol} = {angle}", symbol=phase_symbol(motion, k), angle=degrees(motion.phases[k].angle))


def phase_kind(motion: Motion, k: int) -> str:
    """The kind of phase ``k``, a dwell with its level.

    >>> import graphcam as gc
    >>> phase_kind(gc.Motion([gc.Rise(30, 2.0), gc.Return(30, 2.0), gc.Dwell(FULL_TURN - 4.0)]), 2)
    'lower dwell'
    """
    kind, level = motion.phases[k].kind, motion.levels[k]
    if kind != "dwell":
        return kind
    if math.isclose(level, max(motion.levels), abs_tol=SAME_LEVEL * motion.lift):
        return "upper dwell"
    return "lower dwell" if math.isclose(level, min(motion.levels), abs_tol=SAME_LEVEL * motion.lift) else kind


def phase_ends(motion: Motion, mu_phi: Scale) -> Floats:
    """Where the phases begin on the axis of the cam angle, and where the turn ends [mm of paper]."""
    return mu_phi.paper(np.append(motion.starts, FULL_TURN))


def height_range(heights: Floats) -> tuple[float, float]:
    """The lowest and the highest of heights [mm of paper] and of the axis."""
    return float(np.fmin.reduce(heights, initial=0.0)), float(np.fmax.reduce(heights, initial=0.0))


def ordinate_title(symbol: str, lift_unit: str) -> Caption:
    """The title of an ordinate axis, with its unit; ``lift_unit`` is that of s, of which an angle is in degrees.

    >>> str(ordinate_title("a", "mm")), str(ordinate_title("α", "mm")), str(ordinate_title("s", "rad"))
    ('a, mm/rad²', 'α, °', 's, °')
    """
    per = {"s": "", "v": "/rad", "a": "/rad²", "j": "/rad³"}
    in_degrees = symbol not in per or (symbol, lift_unit) == ("s", "rad")
    return say("{symbol}, {unit}", symbol=symbol, unit="°" if in_degrees else unit(lift_unit + per[symbol]))


def axes_over_phi(
    end: float, mu_phi: Scale, heights: Floats, name: Words, ticks: Segments | None = None
) -> tuple[Mark, ...]:
    """The two axes of a diagram that reaches up to ``end`` and over ``heights`` [mm of paper], and their names.

    ticks : the strokes across the axis of the cam angle; None is degrees
    """
    low, high = height_range(heights)
    right, top = complex(end + AXIS_OVERHANG), (high + AXIS_OVERHANG) * UP
    # Beside a broken dwell there is no room for it: it stands once, with the degrees under the lowest diagram.
    scale = () if mu_phi.middles else (Label(complex(end), _scale_text(mu_phi), towards=-1 - 1j, small=True),)
    return (
        *(Arrow(0j, right, Role.SCALE), Arrow(low * UP, top, Role.SCALE), ticks or degree_ticks(end, mu_phi)),
        *(Label(right, say("φ, °"), towards=-UP), Label(top, name, towards=-1 - 1j, axis=True)),
        *scale,
    )


def _scale_text(mu_phi: Scale) -> Caption:
    degrees = math.degrees(mu_phi.per_mm)
    return say("μᵩ = {mu:.4g} rad/mm ({degrees:.4g}°/mm)", mu=mu_phi.per_mm, degrees=degrees)


def phi_axes(motion: Motion, stations: Stations, mu_phi: Scale, heights: Floats, name: Words) -> tuple[Mark, ...]:
    """The axes of a diagram over one turn of the motion, strokes at the stations, thin lines where the phases end."""
    ends, (low, high) = phase_ends(motion, mu_phi), height_range(heights)
    x, (low_ends, high_ends) = mu_phi.paper(np.unique(stations.phi)), break_strokes(mu_phi)
    starts, stops = np.append(x + SHORT_TICK * UP, low_ends), np.append(x - SHORT_TICK * UP, high_ends)
    ticks = Segments(starts, stops, Role.SCALE)
    across, up, *others = axes_over_phi(ends[-1], mu_phi, heights, name, ticks)
    return (across, up, Segments(ends[1:] + low * UP, ends[1:] + high * UP, Role.CONSTRUCTION), *others)


def pole_marks(pole: Drawn, distance: float, index: str, heights: Floats) -> tuple[Mark, ...]:
    """A pole to the left on the axis, its distance [mm] set down below the lowest of the rays' ``heights`` there."""
    named, below = say("H{index} = {pole:.6g}", index=index, pole=distance), -5.0 + height_range(heights)[0]
    level = Line(np.array([pole.place, 0j]), Role.SCALE, of=pole.act, spare=True)
    return (
        *(level, pole.dots(), pole.label(f"P{index}", -1 + 1j)),
        Dimension(pole.place, 0j, named, below, of=pole.act),
    )


SHORT_TICK, TICK, LONG_TICK = 0.8, 1.0, 1.8
"""Lengths of strokes where stations have numbers, of those of a graduation, and of those that are numbered [mm]."""
TICKS_ROOM = 2.0
"""The strokes of a graduation stand at least so far apart [mm of paper]."""
DEGREES_ROOM = 12.0
"""Numbers of degrees stand at least so far apart [mm of paper]."""
DEGREE_STEPS = 10, 30, 60, 90
"""Every so many degrees of the cam angle there may be a stroke, and a number."""


BREAK_GAP, BREAK_STROKE = 0.75, 0.8 + 2.0j
"""Half the gap between the two strokes of a break, and half of such a stroke [mm of paper]."""


def break_strokes(mu_phi: Scale, level: complex = 0j) -> tuple[Points, Points]:
    """The lower and the upper ends of the two strokes where an axis at this ``level`` is broken [mm of paper]."""
    middles = np.array(mu_phi.middles)
    at = np.ravel(middles[:, None] + BREAK_GAP * np.array([-1.0, 1.0])) + level
    return at - BREAK_STROKE, at + BREAK_STROKE


def degree_steps(mu_phi: Scale) -> tuple[int, int]:
    """The steps in degrees of the cam angle for which a stroke, and a number, find room.

    >>> degree_steps(Scale(math.radians(1), "rad")), degree_steps(Scale(math.radians(4), "rad"))
    ((10, 30), (10, 60))
    """
    tick, number = (
        next((n for n in DEGREE_STEPS if math.radians(n) / mu_phi.per_mm >= room), DEGREE_STEPS[-1])
        for room in (TICKS_ROOM, DEGREES_ROOM)
    )
    return tick, number


def degree_ticks(end: float, mu_phi: Scale) -> Segments:
    """Strokes along the axis of the cam angle up to ``end`` [mm of paper], across it where degrees are numbered below.

    They are so short that the numbers of stations keep their places.
    """
    tick, number = degree_steps(mu_phi)
    degrees = np.arange(tick, math.degrees(mu_phi.value(end)) + tick / 2, tick)
    x = mu_phi.paper(np.radians(degrees))
    return Segments(x + np.where(degrees % number, 0, SHORT_TICK) * UP, x - SHORT_TICK * UP, Role.SCALE)


DEGREES_OFFSET, PHASES_OFFSET = 7.0, 26.0
"""So far below the lowest diagram the degrees stand, and the angles of the phases [mm]."""
SCALE_OFFSET = 7.5
"""So far below the line of degrees the scale of a broken axis stands [mm]."""
SAME_TICK = 1e-6
"""An angle so near to a stroke, in parts of their distance, lies on it."""
MIN_SHOWN_ORIGIN = 0.1
"""Degrees that no drawing shows: where the motion begins nearer to its table's beginning, it begins with it."""
SECOND_LINE = 12.0
"""So far below the line of degrees that of the table stands, where it begins elsewhere; what follows is lower [mm]."""


def degrees_below(end: float, mu_phi: Scale, low: float) -> tuple[Mark, ...]:
    """A graduated line under a diagram that reaches down to ``low`` [mm of paper], with the numbers of its degrees.

    On the axis itself the numbers of the stations stand, and the curve.
    """
    return _degrees_line(end, mu_phi, (low - DEGREES_OFFSET) * UP, 0.0)


def _degrees_line(end: float, mu_phi: Scale, level: complex, first: float) -> tuple[Mark, ...]:
    """A line at a level, from x = 0 to ``end`` [mm of paper], with the numbers of its degrees from ``first`` on."""
    tick, every = degree_steps(mu_phi)
    last = first + math.degrees(mu_phi.value(end))
    degrees = np.arange(tick * math.ceil(first / tick - SAME_TICK), last + tick * SAME_TICK, tick)
    degrees = degrees[mu_phi.shows(np.radians(degrees - first))]
    x, lengths = mu_phi.paper(np.radians(degrees - first)) + level, np.where(degrees % every, TICK, LONG_TICK)
    below = ((n % 360 or n, complex(at)) for n, at in zip(degrees, x - LONG_TICK * UP, strict=True) if n % every == 0)
    low_ends, high_ends = break_strokes(mu_phi, level)
    strokes = Segments(np.append(x, low_ends), np.append(x - lengths * UP, high_ends), Role.SCALE)
    return (
        *(Line(np.array([0.0, end]) + level, Role.SCALE), strokes),
        *(Label(at, say("{n:g}°", n=n), towards=-UP, small=True, axis=True) for n, at in below),
        *([Label(level - SCALE_OFFSET * UP, _scale_text(mu_phi), 1 + 0j, small=True)] if mu_phi.middles else []),
    )


def broken_angles(motion: Motion, mu_phi: Scale, low: float) -> tuple[Mark, ...]:
    """The angles of the broken dwells, on the graduated line under a diagram that reaches down to ``low`` [mm]."""
    at = (low - DEGREES_OFFSET + BREAK_STROKE.imag) * UP
    named = {int(np.searchsorted(motion.starts, mu_phi.value(x), side="right")) - 1: x for x in mu_phi.middles}
    return tuple(Label(x + at, degrees(motion.phases[k].angle), towards=UP, small=True) for k, x in named.items())


def phases_below(motion: Motion, mu_phi: Scale, low: float) -> tuple[Mark, ...]:
    """The degrees under the lowest diagram, which reaches down to ``low`` [mm of paper], and the phases' angles.

    Where the motion begins elsewhere in the turn than what it was made of, a second line has the degrees of that.
    """
    ends = phase_ends(motion, mu_phi)
    spans = enumerate(pairwise(ends + (low - PHASES_OFFSET - second_line(motion)) * UP))
    as_given: tuple[Mark, ...] = ()
    if second_line(motion):
        level = (low - DEGREES_OFFSET - SECOND_LINE) * UP
        line = _degrees_line(ends[-1], mu_phi, level, math.degrees(motion.origin))
        as_given = (*line, Label(level, say("φ as given"), towards=-1 + 0j, small=True))
    return (
        *degrees_below(ends[-1], mu_phi, low),
        *as_given,
        *(Dimension(complex(a), complex(b), phase_angle(motion, k)) for k, (a, b) in spans),
    )


def second_line(motion: Motion) -> float:
    """How much lower everything stands for the second line of degrees [mm of paper]; 0 where there is none."""
    return SECOND_LINE if abs(math.degrees(motion.origin)) >= MIN_SHOWN_ORIGIN else 0.0


def numbered_stations(points: Points, stations: Stations) -> list[int]:
    """The stations that are named: both ends of each phase, and every k-th between, so that the names find room.

    >>> from math import pi
    >>> import graphcam as gc
    >>> from graphcam.given.stations import divide
    >>> halves = divide(gc.Motion([gc.Rise(30, pi), gc.Return(30, pi)]), 5)
    >>> numbered_stations(np.arange(12) + 0j, halves), numbered_stations(10.0 * np.arange(12) + 0j, halves)[:6]
    ([0, 5, 6, 11], [0, 1, 2, 3, 4, 5])
    """
    found: list[int] = []
    numbers, sides = (np.array(each) for each in _numbers_of_stations(stations))
    for span, own in zip(stations.phases, stations.parts, strict=True):
        parts = int(numbers[span.stop - 1])
        between = np.abs(np.diff(points[span]))[~stations.blows[own]]
        # A covered touch point is none.
        spacing = float(np.nanmedian(between)) if np.isfinite(between).any() else 0.0
        every = next((k for k in NAMED_STATION_STEPS if k * spacing >= NUMBER_ROOM[parts >= 10]), parts)
        # The last one before the end would stand too near to it.
        named = {*(k for k in range(0, parts, every) if k == 0 or parts - k >= every), parts}
        # Of two stations at one place that at rest is named.
        found += [
            k
            for k in range(span.start, span.stop)
            if numbers[k] in named and not (sides[k] and abs(points[k] - points[k - sides[k]]) < NUMBER_ROOM[0])
        ]
    return found


def number_labels(
    points: Drawn, stations: Stations, towards: complex | Points, shown: NDArray[np.bool_] | bool = True
) -> tuple[Mark, ...]:
    """The stations' names beside their points, in one direction or in one for each, where they are ``shown``."""
    names, size = station_names(stations), points.shown.shape
    ways, kept = (np.broadcast_to(each, size) for each in (towards, shown))
    places = [k for k in numbered_stations(points.shown, stations) if kept[k]]
    return tuple(points.first[k].label(names[k], complex(ways[k]), small=True) for k in places)


def clear_numbers(points: Points, stations: Stations, beside: Points) -> NDArray[np.bool_]:
    """The stations (n,) whose number has room among crowded points: off others of the phase, and off ``beside``.

    The ends of a phase come first, then what follows from its beginning.

    >>> from math import pi
    >>> import graphcam as gc
    >>> from graphcam.given.stations import divide
    >>> halves = divide(gc.Motion([gc.Rise(30, pi), gc.Return(30, pi)]), 5)
    >>> crowded = np.array([0, 1, 6, 16, 22, 23]) + 0j
    >>> clear_numbers(np.append(crowded, crowded + 50j), halves, np.array([50 + 0j]))[:6].tolist()
    [True, False, True, True, False, True]
    """
    clear, named = np.zeros(points.shape, dtype=bool), numbered_stations(points, stations)
    for span in stations.phases:
        parts = span.stop - span.start - 1
        own = sorted((k for k in named if span.start <= k < span.stop), key=lambda k: (k - span.start) % parts)
        clear[standing_apart(points, own, beside)] = True
    return clear


def standing_apart(points: Points, order: Iterable[int], beside: Iterable[complex] = ()) -> list[int]:
    """The numbers of points whose names have room beside those before them in an order, and ``beside`` others.

    >>> standing_apart(np.array([0, 1, 6, 7, np.nan]) + 0j, [3, 0, 1, 2, 4])
    [0, 3]
    """
    found, taken = list[int](), list(beside)
    for k in order:
        # What cannot be read has no place.
        if not np.isnan(points[k]) and all(abs(points[k] - other) >= NUMBER_ROOM[0] for other in taken):
            found.append(k)
            taken.append(points[k])
    return sorted(found)


def pieces_of(motion: Motion, stations: Stations, direction: int) -> list[slice]:
    """The smooth pieces of the rises (1) or of the returns (-1), as slices of the stations."""
    return [p for p in stations.pieces if motion.phases[int(stations.phase[p.start])].direction == direction]


def first_at_height(heights: Floats) -> NDArray[np.intp]:
    """The number of the first of heights (..., n) that is as high as each: what falls on it is not drawn again.

    >>> first_at_height(np.array([3.0, 1.0, 3.0, -2.0, 1.0])).tolist()
    [0, 1, 0, 3, 1]
    """
    level = np.round(heights, LEVEL_DIGITS)
    order = np.argsort(level, axis=-1, kind="stable")
    ascending = np.take_along_axis(level, order, -1)
    # In ascending order: where each run of equal heights begins.
    begins = np.concatenate([np.ones_like(ascending[..., :1]), np.diff(ascending)], axis=-1) != 0
    run = np.maximum.accumulate(np.where(begins, np.arange(level.shape[-1]), 0), axis=-1)
    found = np.empty_like(order)
    np.put_along_axis(found, order, np.take_along_axis(order, run, -1), -1)
    return found


def degrees(angle: float) -> Caption:
    """An angle in radians as text in degrees, without needless zeros.

    >>> str(degrees(math.pi / 3))
    '60°'
    """
    return say("{angle:.6g}°", angle=math.degrees(angle))
