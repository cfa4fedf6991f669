"""Numbers of slopes: beside a row of places over the cam angle, and where their rays end on the vertical axis."""

import math
from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import EVERY, in_runs
from graphcam.drafting.acts import Drawn
from graphcam.drafting.marks import Label, Points
from graphcam.drafting.units import NOTHING
from graphcam.words import Caption, say

NUMBERS_ROOM = 12.0
"""Places stand at least so far apart that are numbered [mm]: points and chords have numbers beside one another."""
RAYS_ROOM = 5.0
"""Heights of rays stand at least so far apart that are numbered [mm]."""
SAME_HEIGHT = 3
"""Decimals of a millimetre: rays that end no farther apart fall on one line, and are drawn once."""


def every_kth(places: Points) -> int:
    """Every how many of places in a row have room for a number.

    >>> every_kth(5 * np.arange(24) + 0j)
    3
    """
    spacing = float(np.median(np.abs(np.diff(places.real))))
    return next((k for k in EVERY if k * spacing >= NUMBERS_ROOM), places.size)


def row_numbers(places: Drawn, first: int, towards: Points) -> tuple[Label, ...]:
    """The numbers of places in a row, counted from ``first``, of every k-th where there is no room for all.

    towards : (n,) where each number stands, seen from its place
    """
    every = every_kth(places.shown)
    kept = [k for k in range(places.shown.size) if (first + k) % every == 0]
    return tuple(places[k].label(f"{first + k}", complex(towards[k]), small=True) for k in kept)


def falling_together(heights: Drawn) -> list[NDArray[np.intp]]:
    """Which of heights on an axis fall on one another, from the lowest to the highest."""
    levels, of = np.unique(np.round(heights.shown.imag, SAME_HEIGHT), return_inverse=True)
    return [np.flatnonzero(of == level) for level in range(levels.size)]


def ray_numbers(heights: Drawn, first: int, groups: Sequence[NDArray[np.intp]], every: int) -> Iterator[Label]:
    """The numbers of rays where they end, as far as there is room: a ray has those of all that fall on it.

    first : the number of the first ray;  groups : as :func:`falling_together` finds them
    every : so many-th are numbered elsewhere: rays of other numbers have none
    """
    below = -math.inf
    for group in groups:
        end = heights[int(group[0])]
        if end.place.imag - below >= RAYS_ROOM and np.any((first + group) % every == 0):
            yield end.label(ranges(first + group), -1 + 0j, small=True)
            below = end.place.imag


def ranges(numbers: NDArray[np.intp]) -> str:
    """Growing numbers; of three or more that follow one another the first and the last.

    >>> ranges(np.array([3, 4, 5, 9, 11, 12]))
    '3-5, 9, 11, 12'
    """
    runs = np.split(numbers, np.flatnonzero(np.diff(numbers) > 1) + 1)
    return in_runs([str(number) for number in run] for run in runs)


def raised(mm: float, nothing: Caption) -> Caption:
    """How far up or down a place lies; ``nothing`` where it does neither.

    >>> str(raised(-1.5, say("at the origin"))), str(raised(0.001, say("at the origin")))
    ('1.50 mm down', 'at the origin')
    """
    if abs(mm) < NOTHING:
        return nothing
    return say("{mm:.2f} mm up", mm=mm) if mm > 0 else say("{mm:.2f} mm down", mm=-mm)


def run_of_chord(way: complex) -> Caption:
    """How far across and how far up or down a chord runs.

    >>> str(run_of_chord(7.5 + 2j))
    '7.50 mm across, 2.00 mm up'
    """
    if abs(way.imag) < NOTHING:
        return say("{run:.2f} mm level", run=way.real)
    return say("{run:.2f} mm across, {climb}", run=way.real, climb=raised(way.imag, Caption("")))
