"""A page on two sheets of paper that meet at a seam: what one of them is alone."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.printed import Edges, PrintedPage, PrintedView

Side = Literal["left", "right"]
SIDES: tuple[Side, Side] = ("left", "right")


def half(page: PrintedPage, side: Side) -> PrintedPage:
    """One sheet of a page with a seam, in the page's own millimetres: its tags, and its parts of the views."""
    seam = _seam(page)
    low, high = (-np.inf, seam) if side == "left" else (seam, np.inf)
    tags = {number: corner for number, corner in page.tags.items() if low <= corner.real < high}
    views = {name: view for name, whole in page.views.items() if (view := _part(whole, low, high)) is not None}
    return replace(page, tags=tags, views=views, seam=None)


def side_seen(numbers: NDArray[np.int64], page: PrintedPage) -> Side:
    """The sheet of a page with a seam of which more tags are seen."""
    counts = [np.isin(numbers, list(half(page, side).tags)).sum() for side in SIDES]
    return SIDES[int(np.argmax(counts))]


def _part(view: PrintedView, low: float, high: float) -> PrintedView | None:
    left, bottom, right, top = view.room
    room: Edges = (max(left, low), bottom, min(right, high), top)
    return replace(view, room=room) if room[0] < room[2] else None


def _seam(page: PrintedPage) -> float:
    if page.seam is None:
        raise ValueError("the page has no seam")
    return page.seam
