"""Answers drawn in a CAD program: points and curves on named layers, in mm of paper from the marked origin."""

from collections import deque
from dataclasses import dataclass, field
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from graphcam.exercises.reading.answer_values import Points, short_text
from graphcam.exercises.reading.regular_file import UnreadableError
from graphcam.words import say

MAX_END_GAP = 0.2
"""Ends as near as this meet, mm: the width of a pencil line."""
MAX_PIECES = 5000
"""Pieces that are joined; nobody draws one curve of more."""
ORIGIN_LAYER = "origin"
"""The layer whose one POINT marks the origin of the paper; ``<layer>-origin`` that of one layer alone."""
POINT_DECIMALS = 3
"""Points that agree to so many decimals of a mm are one."""
MAX_LISTED_LAYERS = 8
"""Layers that a sentence names."""


def one_curve(layer: str, pieces: list[Points]) -> Points:
    """The pieces (n,) each, joined at their ends; a closed curve ends where it begins.

    Raises
    ------
    UnreadableError : they do not make one curve; the sentence says where it breaks

    >>> one_curve("s", [np.array([1 + 1j, 2 + 0j]), np.array([1 + 1j, 0j])])
    array([0.+0.j, 1.+1.j, 2.+0.j])
    """
    if len(pieces) > MAX_PIECES:
        why = say(
            "the layer {layer} holds more than {most} pieces of a curve; join them to one polyline",
            layer=layer,
            most=MAX_PIECES,
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
    """The first free piece, prolonged at both its ends by those that follow there; all these are free no more."""
    first = int(np.argmax(free))
    free[first] = False
    chain = deque([pieces[first]])
    for at_start in (False, True):
        while free.any():
            tail = chain[0][0] if at_start else chain[-1][-1]
            distance = np.where(free[:, None], np.abs(ends - tail), np.inf)
            k, side = divmod(int(np.argmin(distance)), 2)
            if distance[k, side] > MAX_END_GAP:
                break
            free[k] = False
            if at_start:
                chain.appendleft(pieces[k] if side else pieces[k][::-1])
            else:
                chain.append(pieces[k][::-1] if side else pieces[k])
    return np.concatenate([chain[0], *(piece[1:] for piece in islice(chain, 1, None))])


def _distinct(pieces: list[Points]) -> list[Points]:
    """The pieces without those of no length, and without one that is drawn twice."""
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


@dataclass
class Layer:
    """What stands on one layer, mm of paper: points, centres of circles, curves, and kinds that are neither."""

    points: list[complex] = field(default_factory=list[complex])
    centres: list[complex] = field(default_factory=list[complex])
    curves: list[Points] = field(default_factory=list[Points])
    strange: set[str] = field(default_factory=set[str])


@dataclass(frozen=True, eq=False)
class CadDrawing:
    """A drawing: its layers by their names in small letters; its places are counted from the marked origin."""

    layers: dict[str, Layer]

    def points(self, name: str) -> Points:
        """The points on a layer, each once: POINTs, or the centres of circles where there are none.

        Raises
        ------
        UnreadableError : no such layer, or no points on it

        >>> CadDrawing({"touch": Layer(points=[1 + 2j])}).points("TOUCH")
        array([1.+2.j])
        """
        layer = self._layer(name)
        found = layer.points or layer.centres
        if not found:
            raise UnreadableError(say("there is no point on the layer {layer}; mark it with a POINT", layer=name))
        # One that was copied onto itself is seen as one.
        _, first = np.unique(np.round(found, POINT_DECIMALS), return_index=True)
        return np.array(found)[np.sort(first)] - self._origin(name)

    def curve(self, name: str) -> Points:
        """The one curve on a layer, of whatever pieces it is drawn.

        Raises
        ------
        UnreadableError : no such layer, nothing on it, something that is no curve, or more than one curve
        """
        layer = self._layer(name)
        if layer.strange:
            why = say(
                "the layer {layer} holds {kinds}, which is not a plain curve; draw lines, arcs, polylines or splines",
                layer=name,
                kinds=", ".join(sorted(layer.strange)),
            )
            raise UnreadableError(why)
        if not layer.curves:
            raise UnreadableError(say("there is no curve on the layer {layer}", layer=name))
        return one_curve(name, layer.curves) - self._origin(name)

    def marks_origin(self, name: str) -> bool:
        """Whether the origin is marked for a layer, or for all."""
        return any(layer in self.layers for layer in _origin_layers(name))

    def _layer(self, name: str) -> Layer:
        if name.lower() not in self.layers:
            there = ", ".join(short_text(layer) for layer in sorted(self.layers)[:MAX_LISTED_LAYERS])
            if not there:
                raise UnreadableError(say("the drawing is empty"))
            why = say("the drawing has nothing on the layer {layer}; its layers are {there}", layer=name, there=there)
            raise UnreadableError(why)
        return self.layers[name.lower()]

    def _origin(self, name: str) -> complex:
        """The marked origin; the drawing's own zero where none is marked."""
        layer = next((layer for layer in _origin_layers(name) if layer in self.layers), None)
        if layer is None:
            return 0j
        marks = set(np.round(self.layers[layer].points or self.layers[layer].centres, 6).tolist())
        if len(marks) != 1:
            held = len(marks)
            why = say("the layer {layer} must hold one POINT, the origin, but holds {count}", layer=layer, count=held)
            raise UnreadableError(why)
        return marks.pop()


def _origin_layers(name: str) -> tuple[str, str]:
    return f"{name.lower()}-{ORIGIN_LAYER}", ORIGIN_LAYER
