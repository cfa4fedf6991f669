"""Parts of a kinematic diagram, which is a sketch: not to scale, and its cam is a plain one that tells no answer."""

from __future__ import annotations

import cmath
import math

import numpy as np

from graphcam.constructions.profile_view import rotation_arrow
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.ink import Words, say
from graphcam.drafting.marks import Arc, Arrow, Circle, Dimension, Dots, Label, Line, Mark, Points, Role, Segments

BASE_RADIUS, NOSE_RADIUS, NOSE_DISTANCE = 12.0, 5.0, 16.0
"""The plain cam: radius of its base circle and of its nose, and the distance of the nose's centre from A [mm]."""
NOSE_ANGLE = math.radians(120)
"""The follower stands low; so far the cam turns until the nose has come under it [rad]."""
ROLLER_RADIUS = 5.0
"""Radius of a roller [mm]."""
ROTATION_ARROW_RADIUS = 6.5
"""Radius of the arrow of the rotation [mm]."""
GUIDE_HALF_WIDTH, GUIDE_LENGTH, LINE_OVERHANG = 2.2, 8.0, 5.0
"""Half the width and the length of a guide, and how far the line of motion goes on above the stem [mm]."""
KNIFE_EDGE_HEIGHT, LEADER_LENGTH = 5.0, 6.0
"""The height of a knife edge, and the length of the leader of a link's number [mm]."""
STEM_LENGTH, GUIDE_HEIGHT, SKETCH_OFFSET = 30.0, 9.0, 8.0
"""The length of a stem on an edge, the height of its guide above the roller, and an offset [mm]."""
LINE_BOTTOM = -20.0
"""How far the line of motion goes down, and the height of the offset's dimension [mm]."""


def plain_cam(towards: complex, sigma: int, centre: str = "A") -> tuple[Mark, ...]:
    """A base circle and a nose with straight flanks, on its bearing; the follower stands on it in a direction.

    >>> base, nose, flanks, *_ = plain_cam(UP, 1)
    >>> bool(np.allclose(((flanks.ends - flanks.starts) * flanks.starts.conj()).real, 0))  # they touch the base circle
    True
    """
    axis = cmath.phase(towards) - sigma * NOSE_ANGLE
    half = math.acos((BASE_RADIUS - NOSE_RADIUS) / NOSE_DISTANCE)
    nose = cmath.rect(NOSE_DISTANCE, axis)
    ends: Points = np.exp(1j * np.array([axis - half, axis + half]))
    begin = cmath.phase(towards) + sigma * 0.2
    arrow = rotation_arrow(begin, sigma, ROTATION_ARROW_RADIUS)
    middle = cmath.rect(ROTATION_ARROW_RADIUS, (arrow.start + arrow.end) / 2)
    return (
        Arc(0j, BASE_RADIUS, axis + half, axis - half + 2 * math.pi, Role.RESULT),
        Arc(nose, NOSE_RADIUS, axis - half, axis + half, Role.RESULT),
        Segments(BASE_RADIUS * ends, nose + NOSE_RADIUS * ends, Role.RESULT),
        *bearing(0j, centre, 1 - 1j),
        arrow,
        Label(middle, "ω", middle),
        *link("1", nose, nose),
        *link("0", -3 - 5j, -1 - 1j),
    )


def bearing(at: complex, name: str, towards: complex = 1 + 1j) -> tuple[Mark, ...]:
    """The marks of a shaft or a hinge in the frame, with its name."""
    ground = at + np.arange(-3, 3.1, 1.5) - 5j
    return (
        Circle(at, 1.2, Role.CURVE),
        Line(at + np.array([-0.8 - 0.9j, -3 - 5j, 3 - 5j, 0.8 - 0.9j]), Role.CURVE),
        Segments(ground, ground - 1.2 - 1.5j, Role.HATCH),
        Label(at, name, towards),
    )


def low_point(across: float, roller_radius: float | None) -> complex:
    """The place B of a follower that stands on the base circle, so far to the right of A [mm]."""
    return complex(
        across, math.sqrt((BASE_RADIUS if roller_radius == 0 else BASE_RADIUS + ROLLER_RADIUS) ** 2 - across**2)
    )


def edge(b: complex, roller_radius: float | None, towards: complex) -> tuple[Mark, ...]:
    """The roller about B with its name in a direction, or a knife edge; the radius [mm] is None where it is open."""
    point = (Dots(np.array([b])), Label(b, "B"))
    if roller_radius == 0:
        wedge = b + KNIFE_EDGE_HEIGHT * UP * np.array([1 - 0.5j, 0, 1 + 0.5j])
        return (Line(wedge, Role.CURVE, closed=True), Label(b, "B"))
    return (
        *link("3", b + 0.5 * ROLLER_RADIUS * (1 - 1j), 1 - 1j),
        Circle(b, ROLLER_RADIUS, Role.CURVE),
        *point,
        Label(b + ROLLER_RADIUS * towards / abs(towards), size("r", roller_radius), towards),
    )


def link(number: str, at: complex, towards: complex) -> tuple[Mark, ...]:
    """The number of a link, on a leader from the link: 0 is the frame, 1 the cam, 2 the follower, 3 its roller."""
    end = at + LEADER_LENGTH * towards / abs(towards)
    return (Line(np.array([at, end]), Role.DIMENSION), Label(end, number, towards, small=True))


def size(symbol: str, length: float | None) -> Words:
    """The symbol of a size, with its length [mm] where that is given.

    >>> str(size("r", 12.0)), str(size("r", None))
    ('r = 12', 'r')
    """
    return symbol if length is None else say("{symbol} = {length:g}", symbol=symbol, length=length)


def guided_stem(b: complex, stem: float, guide: float) -> tuple[Mark, ...]:
    """Stem, line of motion, guide and sense of the lift; the trace point, or the middle of the face, is B.

    stem : its length;  guide : its height above B [mm]

    >>> len(guided_stem(40j, stem=30.0, guide=9.0))
    9
    """
    levels: Points = b + UP * np.array([guide, guide + GUIDE_LENGTH])
    strokes, tail = b + UP * (guide + np.linspace(0, GUIDE_LENGTH, 5)[:-1]), b + 2 * GUIDE_HALF_WIDTH + UP * (stem + 1)
    sides = np.array([-GUIDE_HALF_WIDTH, GUIDE_HALF_WIDTH]) * RIGHT
    return (
        Line(np.array([b, b + stem * UP]), Role.CURVE),
        Line(np.array([complex(b.real, LINE_BOTTOM), b + (stem + LINE_OVERHANG) * UP]), Role.AXIS),
        *(Line(levels + side, Role.CURVE) for side in sides),
        *link("2", b + 0.9 * stem * UP, -1 + 0.5j),
        *(Segments(strokes + side, strokes + 1.9 * side + 1.6 * UP, Role.HATCH) for side in sides),
        Arrow(tail, tail + 8 * UP, Role.CURVE),
    )


def offset_marks(across: float, offset: float | None) -> tuple[Mark, ...]:
    """The upright through A, and the offset of the line of motion from it; none where the line goes through A."""
    if across == 0:
        return ()
    below, text = LINE_BOTTOM * UP, size("e", None if offset is None else abs(offset))
    return (Line(np.array([0j, below]), Role.AXIS), Dimension(below + min(across, 0), below + max(across, 0), text))


def sketched_stem(
    centre: str, side: float, sigma: int, roller_radius: float | None, offset: float | None
) -> tuple[Mark, ...]:
    """The whole diagram of a stem with a roller or a knife edge: cam on its bearing ``centre``, stem and guide.

    side : where the line of motion stands: -1 to the left of the centre, 0 over it, +1 to the right
    roller_radius, offset : mm, None where they are open
    """
    b = low_point(SKETCH_OFFSET * side, roller_radius)
    return (
        *plain_cam(b, sigma, centre),
        *edge(b, roller_radius, -1),
        *guided_stem(b, STEM_LENGTH, GUIDE_HEIGHT),
        *offset_marks(SKETCH_OFFSET * side, offset),
    )
