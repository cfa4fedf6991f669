"""Bar charts as the boxes and labels that a page draws."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

WIDTH, HEIGHT, LETTERS = 640, 70, 18
"""Pixels: of the chart, and of the line of labels under it."""


@dataclass(frozen=True)
class Bar:
    """One box, in pixels from the upper left corner; ``kind`` is its class for a colour."""

    kind: str
    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True)
class Chart:
    """Stacked bars over a base line; labels are (x, anchor, text); ``band`` (x, width) is shaded."""

    bars: tuple[Bar, ...]
    labels: tuple[tuple[float, str, str], ...]
    band: tuple[float, float] | None = None
    width: int = WIDTH
    height: int = HEIGHT + LETTERS
    base: int = HEIGHT


def stacked(
    counts: Mapping[str, Sequence[int]], labels: Sequence[tuple[float, str]], band: tuple[float, float] | None = None
) -> Chart:
    """A chart of counts a bar, of several kinds one on the other.

    labels : (part of the width, text);  band : from, to as parts of the width

    >>> chart = stacked({"right": [1, 2]}, [(0.5, "0")])
    >>> chart.bars[1].height, chart.labels
    (64.0, ((320.0, 'middle', '0'),))
    """
    size = len(next(iter(counts.values())))
    highest = max([sum(column) for column in zip(*counts.values(), strict=True)] + [1])
    unit, step = (HEIGHT - 6) / highest, WIDTH / size
    bars: list[Bar] = []
    for k in range(size):
        top = float(HEIGHT)
        for kind, column in counts.items():
            if column[k]:
                height = unit * column[k]
                top -= height
                bars.append(Bar(kind, *(round(length, 2) for length in (k * step + 1, top, step - 2, height))))
    anchors = {0.0: "start", 1.0: "end"}
    placed = tuple((part * WIDTH, anchors.get(part, "middle"), text) for part, text in labels)
    return Chart(tuple(bars), placed, band and (band[0] * WIDTH, (band[1] - band[0]) * WIDTH))
