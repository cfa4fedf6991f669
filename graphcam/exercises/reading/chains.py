"""Pieces drawn end to end, in any order and sense, as the one curve they are."""

from __future__ import annotations

from collections import deque
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from graphcam.exercises.reading.regular_file import UnreadableError
from graphcam.exercises.reading.values import Points
from graphcam.words import say

TOUCHING = 0.2
"""Ends as near as this meet, mm: the width of a pencil line."""
MOST_PIECES = 5000
"""Pieces that are joined; nobody draws one curve of more."""


def one_curve(layer: str, pieces: list[Points]) -> Points:
    """The pieces (n,) each, joined at their ends; a closed curve ends where it begins.

    Raises
    ------
    UnreadableError : they do not make one curve; the sentence says where it breaks

    >>> one_curve("s", [np.array([1 + 1j, 2 + 0j]), np.array([1 + 1j, 0j])])
    array([0.+0.j, 1.+1.j, 2.+0.j])
    """
    if len(pieces) > MOST_PIECES:
        why = say(
            "the layer {layer} holds more than {most} pieces of a curve; join them to one polyline",
            layer=layer,
            most=MOST_PIECES,
        )
        raise UnreadableError(why)
    left = _distinct(pieces)
    if not left:
        raise UnreadableError(say("there is no curve on the layer {layer}", layer=layer))
    ends, free = np.array([piece[[0, -1]] for piece in left]), np.ones(len(left), dtype=bool)
    curve = _traced(left, ends, free)
    if free.any():
        gap, at = min((float(np.abs(ends[free] - end).min()), end) for end in curve[[0, -1]].tolist())
        count = 1
        while free.any():
            _traced(left, ends, free)
            count += 1
        why = say(
            "the layer {layer} holds {count} separate curves instead of one; the nearest gap, {gap:.1f} mm, is at "
            "({x:.1f}, {y:.1f})",
            layer=layer,
            count=count,
            gap=gap,
            x=at.real,
            y=at.imag,
        )
        raise UnreadableError(why)
    return curve


def _traced(pieces: list[Points], ends: Points, free: NDArray[np.bool_]) -> Points:
    """The first free piece, prolonged at both its ends by those that follow there; all these are free no more.

    ends : of every piece (n, 2)
    """
    first = int(np.argmax(free))
    free[first] = False
    chain = deque([pieces[first]])
    for at_start in (False, True):
        while free.any():
            tail = chain[0][0] if at_start else chain[-1][-1]
            distance = np.where(free[:, None], np.abs(ends - tail), np.inf)
            k, side = divmod(int(np.argmin(distance)), 2)
            if distance[k, side] > TOUCHING:
                break
            free[k] = False
            if at_start:
                chain.appendleft(pieces[k] if side else pieces[k][::-1])
            else:
                chain.append(pieces[k][::-1] if side else pieces[k])
    return np.concatenate([chain[0], *(piece[1:] for piece in islice(chain, 1, None))])


def _distinct(pieces: list[Points]) -> list[Points]:
    """Without pieces of no length, and without one that is drawn twice."""
    seen: set[tuple[complex, ...]] = set()
    kept: list[Points] = []
    for piece in pieces:
        marks = [complex(np.round(z, 3)) for z in (piece[0], piece[len(piece) // 2], piece[-1])]
        ends = sorted((marks[0], marks[-1]), key=lambda z: (z.real, z.imag))
        key = tuple(ends + ([marks[1]] if len(piece) > 2 else []))
        if np.ptp(piece.real) + np.ptp(piece.imag) > 0 and key not in seen:
            kept.append(piece)
            seen.add(key)
    return kept
