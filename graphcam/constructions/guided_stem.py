"""In the scheme of the mechanism: a stem that slides in its guide."""

from __future__ import annotations

import numpy as np

from graphcam.drafting.euclid import UP
from graphcam.drafting.marks import Label, Line, Mark, Role, Segments

WALL, GUIDE_LENGTH, FOOT = 2.2, 8.0, -6.0
"""Half the width and the length of the guide, and the height at which the axis begins [mm]."""


def guided_stem(b: complex, stem: float, guide: float) -> tuple[Mark, ...]:
    """Stem, axis and guide of a follower whose trace point, or middle of the face, is B.

    b : on paper;  stem : its length;  guide : its height above B [mm]

    >>> len(guided_stem(40j, stem=30.0, guide=9.0))
    7
    """
    ends, ticks = b + np.array([guide, guide + GUIDE_LENGTH]) * UP, np.linspace(0, GUIDE_LENGTH, 5)[:-1]
    walls = (-WALL, WALL)
    return (
        Line(np.array([b, b + stem * UP]), Role.CURVE),
        Line(np.array([complex(b.real, FOOT), b + (stem + 5) * UP]), Role.AXIS),
        *(Line(ends + wall, Role.CURVE) for wall in walls),
        *(Segments(ends[0] + w + ticks * UP, ends[0] + w * 1.9 + (ticks + 1.6) * UP, Role.HATCH) for w in walls),
        Label(b, "B", towards=1 + 1j),
    )
