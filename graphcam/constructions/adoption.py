"""Adopting sizes as in a design office: round numbers, as far as the drawn region has any."""

import math

import numpy as np

from graphcam.given.laws import Floats

ROUNDING_SLACK = 1e-9
"""A reading this close to a multiple, in parts of it, is that multiple."""


def multiple(count: int, step: float) -> float:
    """So many steps [mm].

    >>> 7 * 0.1, multiple(7, 0.1)
    (0.7000000000000001, 0.7)
    """
    # Divided rather than multiplied where the step is a fraction: 7 * 0.1 is not 0.7, but 7 / 10 is.
    return count * step if step >= 1 else count / round(1 / step)


def steps_up(value: float, step: float) -> int:
    """How many steps reach a value: a multiple that was read is not raised.

    >>> steps_up(43.28, 1.0), steps_up(44 + 1e-12, 1.0)
    (44, 44)
    """
    return math.ceil(value / step - ROUNDING_SLACK)


def lies_in(stretches: Floats, place: float, step: float) -> bool:
    """Whether one of the stretches (k, 2) holds the place, but for rounding of the arithmetic."""
    low, high = stretches.T
    return bool(np.any((low <= place + ROUNDING_SLACK * step) & (place - ROUNDING_SLACK * step <= high)))


def nearest_multiple(stretches: Floats, wanted: float, step: float) -> float | None:
    """The multiple of ``step`` inside one of the stretches (k, 2) that is nearest to ``wanted``; None if there is none.

    >>> nearest_multiple(np.array([[81.2, 83.7], [90.1, 90.8]]), 88.0, 1.0)
    83.0
    >>> nearest_multiple(np.array([[90.1, 90.8]]), 88.0, 1.0)
    """
    places: list[float] = []
    for low, high in stretches.tolist():
        # Inside, and not at the end: there the limits may be broken by a rounding, or the mechanism be stretched out.
        first, last = math.floor(low / step + ROUNDING_SLACK) + 1, math.ceil(high / step - ROUNDING_SLACK) - 1
        if first <= last:
            places.append(multiple(min(max(round(wanted / step), first), last), step))
    return min(places, key=lambda place: abs(place - wanted), default=None)
