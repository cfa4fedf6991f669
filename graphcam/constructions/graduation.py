"""Round values along the ordinate axis of a diagram: strokes, and numbers where there is room."""

import math
from collections.abc import Sequence

import numpy as np

from graphcam.constructions.axes import LONG_TICK, TICK, TICKS_ROOM, reach
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.ink import say
from graphcam.drafting.marks import Label, Mark, Origin, Role, Segments
from graphcam.given.laws import Floats

NUMBERS_APART = 10.0, 5.0
"""The numbers of a graduation stand at least so far apart [mm of paper], in a low diagram so far."""
ROUND = (1, 2, 5, 10)
"""Round steps within a power of ten."""


def graduated(
    heights: Floats, per_mm: float, right: float | None = None, of: Origin | None = None, lift_unit: str = ""
) -> tuple[Mark, ...]:
    """The graduation of the ordinate axis of a diagram over ``heights`` [mm of paper], ``per_mm`` units to each.

    right : where it stands instead [mm of paper], if rays run to the axis from the left: at the other end of the turn
    of : the reading whose scale it shows, where that is only found by drawing
    lift_unit : "rad" where the ordinates are angles, which a reader wants in degrees

    >>> [str(mark.text) for mark in graduated(np.array([-12.0, 31.0]), 0.5)[1:]]
    ['-5', '5', '10', '15']
    """
    low, high = reach(heights)
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
        *(Label(at, value.where(value=n * every), towards=way[0], small=True, of=of) for at, n in named),
    )


def divisions(farthest: float, per_mm: float) -> tuple[float, int]:
    """The round step between numbers up to a height [mm of paper], and into how many parts strokes divide it.

    >>> divisions(50.0, 0.6), divisions(50.0, 1.231)
    ((10.0, 5), (20.0, 4))
    """
    steps = [round_up(apart * per_mm, ROUND) for apart in NUMBERS_APART]
    # A low diagram would have no number at all.
    every, lead = next((step for step in steps if step[0] / per_mm <= farthest), steps[-1])
    parts = 4 if lead == 2 else 5
    return every, parts if every / per_mm / parts >= TICKS_ROOM else 1


def round_up(least: float, leads: Sequence[float]) -> tuple[float, float]:
    """The least of the leads times a power of ten that is not less than a value, and its lead.

    >>> round_up(0.3, (1, 2, 5, 10))
    (0.5, 5)
    """
    power = 10.0 ** math.floor(math.log10(least))
    lead = next(n for n in leads if n * power >= least)
    return lead * power, lead
