"""Round values along the axes of a diagram: strokes, numbers where there is room; seconds where the cam has a speed.

Over time the curves stay as they are.  As t = phi/omega, the scale of the time is mu_t = mu_phi/omega, and those of
velocity, acceleration and jerk are mu_v omega, mu_a omega^2 and mu_j omega^3.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import (
    LONG_TICK,
    NAMED_STATION_STEPS,
    PHASES_OFFSET,
    TICK,
    TICKS_ROOM,
    break_strokes,
    height_range,
    joined_runs,
)
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.ink import Caption, Words, say
from graphcam.drafting.marks import Label, Line, Mark, Origin, Points, Role, Segments
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, Scale, unit
from graphcam.given.follower import MM_PER_M
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.words import sequence

NUMBER_SPACINGS = 10.0, 5.0
"""The numbers of a graduation stand at least so far apart [mm of paper], in a low diagram so far."""
ROUND_STEPS = (1, 2, 5, 10)
"""Round steps within a power of ten."""


def graduation_marks(
    heights: Floats,
    per_mm: float,
    right: float | None = None,
    of: Origin | None = None,
    lift_unit: str = "",
    name: Words = "",
) -> tuple[Mark, ...]:
    """The graduation of the ordinate axis of a diagram over ``heights`` [mm of paper], ``per_mm`` units to each.

    right : where it stands instead [mm of paper], if rays run to the axis from the left: at the other end of the turn
    name : of the ordinate with its unit, over a graduation there
    of : the reading whose scale it shows, where that is only found by drawing
    lift_unit : "rad" where the ordinates are angles, which a reader wants in degrees

    >>> [str(mark.text) for mark in graduation_marks(np.array([-12.0, 31.0]), 0.5)[1:]]
    ['-5', '5', '10', '15']
    """
    low, high = height_range(heights)
    angles = lift_unit == "rad"
    per_mm, value = (math.degrees(per_mm), say("{value:.6g}°")) if angles else (per_mm, say("{value:.6g}"))
    every, parts = divisions(max(-low, high), per_mm)
    finest = every / parts / per_mm
    counts = np.arange(math.ceil(low / finest), math.floor(high / finest) + 1)
    counts = counts[counts != 0]
    whole = counts % parts == 0
    way = (-RIGHT, 0.0) if right is None else (RIGHT, right)
    starts = way[1] + counts * finest * UP
    ends = starts + np.where(whole, LONG_TICK, TICK) * way[0]
    named = zip(ends[whole].tolist(), (counts[whole] // parts).tolist(), strict=True)
    return (
        Segments(starts, ends, Role.SCALE, of=of),
        *(
            Label(at, value.with_values(value=n * every), towards=way[0], small=True, axis=True, of=of)
            for at, n in named
        ),
        *([Label(way[1] + high * UP, name, towards=UP, of=of)] if name else []),
    )


def divisions(farthest: float, per_mm: float) -> tuple[float, int]:
    """The round step between numbers up to a height [mm of paper], and the number of parts that strokes make of it.

    >>> divisions(50.0, 0.6), divisions(50.0, 1.231)
    ((10.0, 5), (20.0, 4))
    """
    steps = [round_up(apart * per_mm, ROUND_STEPS) for apart in NUMBER_SPACINGS]
    # A low diagram would have no number at all.
    every, lead = next((step for step in steps if step[0] / per_mm <= farthest), steps[-1])
    parts = 4 if lead == 2 else 5
    return every, parts if every / per_mm / parts >= TICKS_ROOM else 1


def round_up(least: float, leads: Sequence[float]) -> tuple[float, float]:
    """The smallest of the leads times a power of ten that is not less than a value, and its lead.

    >>> round_up(0.3, (1, 2, 5, 10))
    (0.5, 5)
    """
    power = 10.0 ** math.floor(math.log10(least))
    lead = next(n for n in leads if n * power >= least)
    return lead * power, lead


TIME_SPACING = 16.0
"""Numbers of seconds stand at least so far apart [mm of paper]."""
BELOW_PHASES_OFFSET, BELOW_DEGREES_OFFSET = 6.0, 10.0
"""The times stand so far below the angles of the phases, and below a line of degrees without them [mm of paper]."""
SECOND_GRADUATION_OFFSET = 17.0
"""The second graduation of an ordinate stands so far beside the first one [mm of paper]."""
LONG_NUMBER = 10_000.0
"""Values from this one on are numbered in thousands."""
UNITS_AT_SPEED = {"mm": ("m/s", "m/s²", "m/s³"), "rad": ("rad/s", "rad/s²", "rad/s³")}
"""The units of velocity, acceleration and jerk at a speed, by that of the lift."""
SYMBOLS = "vaj"


def time_scale(mu_phi: Scale, omega: float) -> Scale:
    """The scale of the time [s/mm] along the axis of the cam angle, at an angular velocity [rad/s].

    >>> round(time_scale(Scale(math.radians(1), "rad"), 2 * math.pi).per_mm * 360, 12)
    1.0
    """
    return Scale(mu_phi.per_mm / omega, "s")


def scale_at_speed(per_mm: float, symbol: str, omega: float, lift_unit: str) -> Scale:
    """The scale of v, a or j at an angular velocity [rad/s], from that per radian of the cam.

    >>> scale_at_speed(2.0, "a", 10.0, "mm")
    Scale(per_mm=0.2, unit='m/s²')
    """
    order = SYMBOLS.index(symbol) + 1
    per_unit = MM_PER_M if lift_unit == "mm" else 1.0
    return Scale(per_mm * omega**order / per_unit, UNITS_AT_SPEED[lift_unit][order - 1])


def times_below(end: float, mu_phi: Scale, low: float, omega: float | None, *, phases: bool = True) -> tuple[Mark, ...]:
    """A line graduated in seconds under a diagram that reaches down to ``low`` [mm of paper]; none without a speed.

    phases : whether the angles of the phases stand above it, or degrees alone
    """
    if omega is None:
        return ()
    mu_t, level = (
        time_scale(mu_phi, omega),
        low - (PHASES_OFFSET + BELOW_PHASES_OFFSET if phases else BELOW_DEGREES_OFFSET + DEGREES_LINE_LENGTH),
    )
    every, lead = round_up(TIME_SPACING * mu_t.per_mm, ROUND_STEPS)
    parts = 4 if lead == 2 else 5
    parts = parts if every / mu_t.per_mm / parts >= TICKS_ROOM else 1
    counts = np.arange(math.floor(mu_phi.value(end) / omega / every * parts * (1 + 1e-12)) + 1)
    turned = counts * (every / parts * omega)
    counts, turned = counts[mu_phi.shows(turned)], turned[mu_phi.shows(turned)]
    whole, x = counts % parts == 0, mu_phi.paper(turned) + level * UP
    below = x - np.where(whole, LONG_TICK, TICK) * UP
    named = zip(below[whole].tolist(), (counts[whole] // parts).tolist(), strict=True)
    low_ends, high_ends = break_strokes(mu_phi, level * UP)
    return _spare(
        Line(np.array([0.0, end]) + level * UP, Role.SCALE),
        Segments(np.append(x, low_ends), np.append(below, high_ends), Role.SCALE),
        *(Label(at, say("{t:.6g}", t=n * every), towards=-UP, small=True) for at, n in named),
        # The scale stands over the line, in the last phase: beside it there may be another view.
        Label(complex(end, level), say("t, {unit}", unit=unit("s")), 1 + 0j),
        Label(complex(end, level), say("μₜ = {mu:.4g} {unit}/mm", unit=unit("s"), mu=mu_t.per_mm), -1 + 1j, small=True),
    )


DEGREES_LINE_LENGTH = 11.0
"""So far below the lowest place of a diagram a line of degrees ends, with its numbers [mm of paper]."""


def _spare(*marks: Mark) -> tuple[Mark, ...]:
    return tuple(replace(mark, spare=True) for mark in marks)


def time_axis_caption(mu_phi: Scale, omega: float) -> Caption:
    """A sentence on how the axis of the cam angle becomes one of time."""
    return say(
        "At ω = {omega:.5g} rad/s one revolution takes T = 2π/ω = {turn:.4g} s, so the same axis is one of time: μₜ = "
        "μᵩ/ω = {mu:.4g} s/mm."
    ).with_values(omega=omega, turn=FULL_TURN / omega, mu=time_scale(mu_phi, omega).per_mm)


_FACTORS = say("ω"), say("ω²"), say("ω³")


def time_scale_caption(per_mm: float, symbol: str, omega: float, lift_unit: str) -> Caption:
    """A sentence on the scale of v, a or j in metres and seconds, beside that per radian of the cam."""
    at = scale_at_speed(per_mm, symbol, omega, lift_unit)
    said = say("Over time a millimetre is {mu:.5g}·{factor} = {value:.4g} {unit}: the graduation farther to the right.")
    factor = _FACTORS[SYMBOLS.index(symbol)]
    if lift_unit == "mm":
        said = say(
            "Over time a millimetre is {mu:.5g}·{factor}/1000 = {value:.4g} {unit}: the graduation farther to the "
            "right."
        )
    return said.with_values(mu=per_mm, factor=factor, value=at.per_mm, unit=unit(at.unit))


def graduated_at_speed(
    heights: Floats, per_mm: float, symbol: str, omega: float, lift_unit: str, end: float, of: Origin | None
) -> tuple[Mark, ...]:
    """The second graduation of the ordinates of v, a or j, beside the one at the ``end`` of the turn [mm of paper]."""
    at, x = scale_at_speed(per_mm, symbol, omega, lift_unit), end + SECOND_GRADUATION_OFFSET
    low, high = height_range(heights)
    per_mm, of_unit = at.per_mm, unit(at.unit)
    if max(-low, high) * per_mm >= LONG_NUMBER:
        per_mm, of_unit = per_mm / 1000, say("10³ {unit}", unit=of_unit)
    return _spare(
        Line(x + UP * np.array([low, high]), Role.SCALE, of=of),
        *graduation_marks(heights, per_mm, x, of, name=sequence([symbol, of_unit])),
    )


NUMBERS_ROOM = 12.0
"""Places stand at least so far apart that are numbered [mm]: points and chords have numbers beside one another."""
RAYS_ROOM = 2.5
"""Ends of rays that are less apart have their numbers side by side [mm of paper]."""
HEIGHT_DECIMALS = 3
"""Decimals of a millimetre: rays that end no farther apart fall on one line, and are drawn once."""


def numbering_step(places: Points) -> int:
    """The smallest k for which the numbers of every k-th of places in a row find room.

    >>> numbering_step(5 * np.arange(24) + 0j)
    3
    """
    spacing = float(np.median(np.abs(np.diff(places.real))))
    return next((k for k in NAMED_STATION_STEPS if k * spacing >= NUMBERS_ROOM), places.size)


def row_numbers(places: Drawn, first: int, towards: Points) -> tuple[Label, ...]:
    """The numbers of places in a row, counted from ``first``, of every k-th where there is no room for all.

    towards : (n,) where each number stands, seen from its place
    """
    every = numbering_step(places.shown)
    kept = [k for k in range(places.shown.size) if (first + k) % every == 0]
    return tuple(places[k].label(f"{first + k}", complex(towards[k]), small=True) for k in kept)


def coinciding_heights(heights: Drawn) -> list[NDArray[np.intp]]:
    """The groups of heights on an axis that fall on one another, from the lowest to the highest, by their numbers."""
    levels, of = np.unique(np.round(heights.shown.imag, HEIGHT_DECIMALS), return_inverse=True)
    return [np.flatnonzero(of == level) for level in range(levels.size)]


def ray_numbers(
    ends: Drawn, reach: Floats, rays: Sequence[Sequence[int]], told: Callable[[list[int]], str]
) -> tuple[Label, ...]:
    """The numbers of rays in the lines that are carried level from their ends.

    Rays that end close together, or on one another, have theirs side by side.

    ends : (n,) on the vertical axis
    reach : (n,) how far to the right the level lines run [mm of paper]
    rays : the rays that end there, by their numbers;  told : names several of them
    """
    labels: list[Label] = []
    for run in close_ends(ends):
        k = run[len(run) // 2]
        label = ends[k].label(told(sorted(ray for end in run for ray in rays[end])), RIGHT + 0j, small=True)
        labels.append(replace(label, along=float(reach[k])))
    return tuple(labels)


def close_ends(ends: Drawn) -> list[list[int]]:
    """The ends of rays on an axis from the lowest to the highest, those together that are less than a letter apart."""
    heights, runs = ends.shown.imag, list[list[int]]()
    for k in np.argsort(heights, kind="stable").tolist():
        if runs and heights[k] - heights[runs[-1][0]] < RAYS_ROOM:
            runs[-1].append(k)
        else:
            runs.append([k])
    return runs


def close_ends_caption(ends: Drawn) -> tuple[Caption, ...]:
    """A sentence on the numbers of rays that end close together, where there are any."""
    said = say("Rays that end less than {room:g} mm apart have their numbers side by side.", room=RAYS_ROOM)
    return (said,) if len(close_ends(ends)) < ends.shown.size else ()


def ranges(numbers: NDArray[np.intp]) -> str:
    """Growing numbers as text; of three or more that follow one another the first and the last.

    >>> ranges(np.array([3, 4, 5, 9, 11, 12]))
    '3-5, 9, 11, 12'
    """
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    return joined_runs([str(number) for number in run] for run in runs)


def height_caption(mm: float, nothing: Caption) -> Caption:
    """A caption of how far up or down a place lies; ``nothing`` where it does neither.

    >>> str(height_caption(-1.5, say("at the origin"))), str(height_caption(0.001, say("at the origin")))
    ('1.50 mm down', 'at the origin')
    """
    if abs(mm) < NEGLIGIBLE_SIZE:
        return nothing
    return say("{mm:.2f} mm up", mm=mm) if mm > 0 else say("{mm:.2f} mm down", mm=-mm)


def run_of_chord(way: complex) -> Caption:
    """A caption of how far across and how far up or down a chord runs.

    >>> str(run_of_chord(7.5 + 2j))
    '7.50 mm across, 2.00 mm up'
    """
    if abs(way.imag) < NEGLIGIBLE_SIZE:
        return say("{run:.2f} mm level", run=way.real)
    return say("{run:.2f} mm across, {climb}", run=way.real, climb=height_caption(way.imag, Caption("")))
