"""Pieces drawn end to end, in any order and sense, as the one curve they are."""

from __future__ import annotations

import numpy as np

from graphcam.exercises.reading.regular_file import UnreadableError
from graphcam.exercises.reading.values import Points
from graphcam.words import say

TOUCHING = 0.2
"""Ends as near as this meet, mm: the width of a pencil line."""


def one_curve(layer: str, pieces: list[Points]) -> Points:
    """The pieces (n,) each, joined at their ends; a closed curve ends where it begins.

    Raises
    ------
    UnreadableError : they do not make one curve; the sentence says where it breaks

    >>> one_curve("s", [np.array([1 + 1j, 2 + 0j]), np.array([1 + 1j, 0j])])
    array([2.+0.j, 1.+1.j, 0.+0.j])
    """
    left = _distinct(pieces)
    if not left:
        raise UnreadableError(say("there is no curve on the layer {layer}", layer=layer))
    forward, left = _extended([left[0]], left[1:])
    backward, left = _extended([piece[::-1] for piece in reversed(forward)], left)
    curve = _joined(backward)
    if left:
        gap, at = min((abs(end - other), end) for end in curve[[0, -1]] for piece in left for other in piece[[0, -1]])
        raise UnreadableError(say(
            "the layer {layer} holds {count} separate curves instead of one; the nearest gap, {gap:.1f} mm, is at "
            "({x:.1f}, {y:.1f})",
            layer=layer, count=1 + _curves(left), gap=float(gap), x=float(at.real), y=float(at.imag),
        ))  # fmt: skip
    return curve


def _extended(chain: list[Points], left: list[Points]) -> tuple[list[Points], list[Points]]:
    """The chain prolonged at its end by all pieces that follow there, and the pieces that are left."""
    starts = np.array([piece[0] for piece in left], dtype=complex)
    ends = np.array([piece[-1] for piece in left], dtype=complex)
    free = np.ones(len(left), dtype=bool)
    chain = list(chain)
    while free.any():
        tail = chain[-1][-1]
        distance = np.where(free, np.minimum(np.abs(starts - tail), np.abs(ends - tail)), np.inf)
        k = int(np.argmin(distance))
        if distance[k] > TOUCHING:
            break
        free[k] = False
        chain.append(left[k] if abs(starts[k] - tail) <= abs(ends[k] - tail) else left[k][::-1])
    return chain, [piece for piece, is_free in zip(left, free, strict=True) if is_free]


def _curves(left: list[Points]) -> int:
    count = 0
    while left:
        chain, left = _extended([left[0]], left[1:])
        _, left = _extended([piece[::-1] for piece in reversed(chain)], left)
        count += 1
    return count


def _joined(chain: list[Points]) -> Points:
    parts = [chain[0], *(piece[1:] for piece in chain[1:])]
    return np.concatenate(parts)


def _distinct(pieces: list[Points]) -> list[Points]:
    """Without pieces of no length, and without one that is drawn twice."""
    seen: set[tuple[complex, ...]] = set()
    kept: list[Points] = []
    for piece in pieces:
        marks = [complex(np.round(z, 3)) for z in (piece[0], piece[len(piece) // 2], piece[-1])]
        key = tuple(
            sorted((marks[0], marks[-1]), key=lambda z: (z.real, z.imag)) + ([marks[1]] if len(piece) > 2 else [])
        )
        if np.ptp(piece.real) + np.ptp(piece.imag) > 0 and key not in seen:
            kept.append(piece)
            seen.add(key)
    return kept
