"""The axes of the sizing sheet's charts: each has a scale of its own, and round numbers along it."""

from dataclasses import dataclass

import numpy as np

from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import say
from graphcam.drafting.marks import Arrow, Label, Mark, Points, Role, Segments
from graphcam.given.laws import Floats
from graphcam.words import Caption

TICKS = 6
"""Parts of an axis with numbers, at most."""
BEYOND = 8.0
"""By so much an axis is longer than its span [mm of paper]."""
Span = tuple[float, float]


@dataclass(frozen=True)
class ChartAxes:
    """Two axes.

    size : width and height on paper [mm];  across, up : what their ends stand for
    names : of the axes
    """

    size: complex
    across: Span
    up: Span
    names: tuple[Caption, Caption]

    def place(self, across: Floats | float, up: Floats | float) -> Points:
        """Places on paper [mm] of values."""
        (x0, x1), (y0, y1) = self.across, self.up
        x, y = (np.asarray(across) - x0) / (x1 - x0), (np.asarray(up) - y0) / (y1 - y0)
        return np.asarray(x * self.size.real + UP * y * self.size.imag)

    def marks(self) -> tuple[Mark, ...]:
        """Both axes with their numbers and names."""
        across, up = self.size.real + 0j, self.size.imag * UP
        return (
            Arrow(0j, across + BEYOND, Role.SCALE),
            Arrow(0j, up + BEYOND * UP, Role.SCALE),
            *_ticks(across, self.across, -UP),
            *_ticks(up, self.up, -1 + 0j),
            Label(across + BEYOND, self.names[0], towards=1 - 1j),
            Label(up + BEYOND * UP, self.names[1], towards=-1 + 0j),
        )


def _ticks(end: complex, span: Span, outwards: complex) -> tuple[Mark, ...]:
    """Short strokes with round numbers along an axis from the origin."""
    low, high = span
    values = round_values(low, high)
    at = (values - low) / (high - low) * end
    labels = (
        Label(complex(x), say("{value:g}", value=float(value)), outwards, small=True)
        for x, value in zip(at, values, strict=True)
    )
    return (Segments(at, at + 1.5 * outwards, Role.SCALE), *labels)


def round_values(low: float, high: float) -> Floats:
    """Round numbers from one end of a span to the other.

    >>> round_values(60, 120).tolist()
    [60.0, 70.0, 80.0, 90.0, 100.0, 110.0, 120.0]
    """
    from matplotlib.ticker import MaxNLocator

    round_ = np.asarray(MaxNLocator(TICKS, steps=[1, 2, 5, 10]).tick_values(low, high))
    # With the slack of a rounding at either end.
    return round_[(round_ >= low - 1e-9 * (high - low)) & (round_ <= high + 1e-9 * (high - low))]
