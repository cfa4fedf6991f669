"""In the scheme of the mechanism: a stem that slides in its guide."""

import numpy as np

from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand
from graphcam.drafting.marks import Line, Mark, Role

WALL, GUIDE_LENGTH, FOOT = 2.2, 8.0, -6.0
"""Half the width and the length of the guide, and the height at which the axis begins [mm]."""


def guided_stem(hand: Hand, b: Drawn, stem: float, guide: float) -> tuple[Mark, ...]:
    """Stem, axis and guide of a follower whose trace point, or middle of the face, is B.

    stem : its length;  guide : its height above B [mm]

    >>> import graphcam as gc
    >>> from graphcam.drafting.ink import say
    >>> from graphcam.drafting.meaning import Meaning
    >>> hand = Hand(gc.Pencil(), Meaning("scheme", say("Scheme"), say("A stem in its guide.")))
    >>> len(guided_stem(hand, hand.given("B", 40j), stem=30.0, guide=9.0))
    7
    """
    levels, strokes = np.array([guide, guide + GUIDE_LENGTH]), np.linspace(0, GUIDE_LENGTH, 5)[:-1]
    sides = {w: hand.lay_off(f"wall at {w}", hand.lay_off("guide", b, UP, levels), RIGHT, w) for w in (-WALL, WALL)}
    starts = {w: hand.lay_off(f"strokes at {w}", wall[0], UP, strokes) for w, wall in sides.items()}
    return (
        hand.lay_off("stem", b, UP, stem).line_from(b, Role.CURVE),
        Line(np.array([complex(b.place.real, FOOT), b.place + (stem + 5) * UP]), Role.AXIS),
        *(wall.line(Role.CURVE) for wall in sides.values()),
        *(hand.erect(f"hatching at {w}", at, 0.9 * w + 1.6 * UP).ways(Role.HATCH) for w, at in starts.items()),
        b.label("B"),
    )
