"""Where on a page things would rather stand: what it costs to put their lower left corner at x, y (in cells)."""

from __future__ import annotations

from graphcam.sheets.packing import Grid


def top_left(x: Grid, y: Grid) -> Grid:
    """At the left, then high."""
    return 10 * x - y


def top_right(x: Grid, y: Grid) -> Grid:
    """High, then at the right."""
    return -x - 10 * y


def bottom_left(x: Grid, y: Grid) -> Grid:
    """Low, then at the left."""
    return x + 10 * y


def bottom_right(x: Grid, y: Grid) -> Grid:
    """At the right, then low."""
    return y - 3 * x


def high(x: Grid, y: Grid) -> Grid:
    """High, then at the left."""
    return x - 10 * y


def left(x: Grid, y: Grid) -> Grid:
    """At the left, at middle height."""
    return 10 * x + abs(y - y.mean())


def top(x: Grid, y: Grid) -> Grid:
    """High, in the middle of the width."""
    return abs(x - x.mean()) - 10 * y


def middle(x: Grid, y: Grid) -> Grid:
    """In the middle of the free room."""
    return (x - x.mean()) ** 2 + (y - y.mean()) ** 2
