"""Answers drawn in a CAD program: points and curves on named layers, in mm of paper from the marked origin."""

from dataclasses import dataclass

import numpy as np

from graphcam.dxf_curves import Layer, one_curve
from graphcam.errors import UnreadableError
from graphcam.exercises.reading.answer_values import Points, short_text
from graphcam.words import say

ORIGIN_LAYER = "origin"
"""The layer whose one POINT marks the origin of the paper; ``<layer>-origin`` that of one layer alone."""
POINT_DECIMALS = 3
"""Points that agree to so many decimals of a mm are one."""
MAX_LISTED_LAYERS = 8
"""Layers that a sentence names."""


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
