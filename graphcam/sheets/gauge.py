"""The gauge: 100 mm on every sheet, so that a print can be checked with a ruler."""

from __future__ import annotations

import numpy as np

from graphcam.sheets.box import Box
from graphcam.sheets.model import Entity, Strokes, Text
from graphcam.words import Tell, say

LENGTH = 100.0
"""mm"""


def gauge(at: complex, tell: Tell = str) -> list[Entity]:
    """A rule of 100 mm in divisions of 10 mm, its zero at ``at``."""
    marks = at + np.arange(0.0, LENGTH + 1.0, 10.0)
    ticks = np.array([3.0, 1.5, 1.5, 1.5, 1.5, 3.0, 1.5, 1.5, 1.5, 1.5, 3.0])
    return [
        Strokes(np.array([at]), np.array([at + LENGTH]), "gauge"),
        Strokes(marks, marks + 1j * ticks, "ruling"),
        *(Text(at + x + 4j, f"{x:g}", 2.5, "center") for x in (0.0, 50.0, LENGTH)),
        Text(at + 75 + 4j, tell(say("mm, true to scale")), 2.0, "center"),
    ]


def gauge_box(at: complex) -> Box:
    """The room that the gauge takes."""
    return Box(at.real - 4, at.imag - 2, at.real + LENGTH + 5, at.imag + 8)
