"""Ruler and compass on arrays of points (complex numbers, mm of paper).

A line is a point and a direction of any length.  Everything broadcasts.  What a hand could not read off is NaN, in that
element alone: lines that cross at less than :data:`READABLE_CROSSING`, a line that misses a circle.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.marks import Points
from graphcam.plane_vectors import cross, dot

Floats = NDArray[np.floating[Any]]

READABLE_CROSSING = math.radians(1)
"""Two lines that cross at a smaller angle have no readable point in common."""
NOWHERE = complex(math.nan, math.nan)
"""A place that cannot be found."""
UP = 1j
RIGHT = 1 + 0j


def unit(direction: Points) -> Points:
    """The direction at length one; NaN for no direction.

    >>> complex(unit(np.array(0 - 4j)))
    -1j
    """
    with np.errstate(invalid="ignore"):
        return direction / np.abs(direction)


def turned_direction(direction: Points | complex, angle: Floats | float) -> Points:
    """A direction turned counter-clockwise by an angle [rad].

    >>> complex(np.round(turned_direction(1 + 0j, np.pi / 2), 15))
    1j
    """
    return np.asarray(direction * np.exp(1j * np.asarray(angle)))


def division_points(a: Points | complex, b: Points | complex, parts: int) -> Points:
    """The ends of equal parts of the segment from a to b, both its own ends included: (..., parts + 1).

    >>> [complex(at) for at in division_points(0j, 3 + 6j, 3)]
    [0j, (1+2j), (2+4j), (3+6j)]
    """
    start: Points = np.asarray(a)[..., None]
    length: Points = np.asarray(b - a)[..., None]
    share: Points = np.arange(parts + 1) / parts + 0j
    return start + length * share


def climb_along(direction: Points, width: Floats) -> Floats:
    """How far a line along a direction climbs over a width across [mm].

    >>> float(climb_along(np.asarray(40 + 20j), np.asarray(10.0)))
    5.0
    """
    return direction.imag * width / direction.real


def crossing(p: Points, d: Points, q: Points, e: Points) -> Points:
    """The point that the line through p along d and the line through q along e have in common; NaN for parallels.

    What a hand can read is :func:`readable_crossing`; this is for lines of which only the envelope is drawn.

    >>> at = np.asarray
    >>> complex(crossing(at(0j), at(1 + 1j), at(2 + 0j), at(1j)))
    (2+2j)
    """
    turn = cross(d, e)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):  # beyond all numbers is infinitely far away
        along = np.where(turn != 0, cross(q - p, e) / turn, np.nan)
        return p + along * d


def readable_crossing(p: Points, d: Points, q: Points, e: Points) -> Points:
    """The point where the line through p along d meets the line through q along e; NaN when they are almost parallel.

    >>> at = np.asarray
    >>> complex(readable_crossing(at(0j), at(1 + 1j), at(2 + 0j), at(1j)))
    (2+2j)
    >>> bool(np.isnan(readable_crossing(at(0j), at(1 + 0j), at(1j), at(1 + 0.01j))))
    True
    """
    readable = np.abs(cross(d, e)) >= math.sin(READABLE_CROSSING) * np.abs(d) * np.abs(e)
    return np.where(readable, crossing(p, d, q, e), NOWHERE)


def foot(p: Points, q: Points, d: Points) -> Points:
    """The foot of the perpendicular from p on the line through q along d.

    >>> at = np.asarray
    >>> complex(foot(at(1 + 3j), at(0j), at(2 + 0j)))
    (1+0j)
    """
    return q + d * (dot(d, np.asarray(p - q)) / dot(d, d))


def perpendicular_bisector(a: Points, b: Points) -> tuple[Points, Points]:
    """The line of points as far from a as from b: its point halfway, and its direction.

    >>> middle, direction = perpendicular_bisector(np.asarray(0j), np.asarray(4 + 0j))
    >>> complex(middle), complex(direction)
    ((2+0j), 4j)
    """
    return (a + b) / 2, (b - a) * UP


def centre_of_circle(a: Points, b: Points, c: Points) -> Points:
    """The centre of the circle through three points, where the bisectors of two chords meet; NaN on a straight line.

    >>> at = np.asarray
    >>> complex(centre_of_circle(at(2 + 0j), at(1 + 1j), at(0j)))
    (1+0j)
    """
    # As by readable_crossing of the perpendicular bisectors; both are turned by a right angle, so the chords tell all.
    u, v = b - a, c - b
    turn = cross(u, v)
    readable = np.abs(turn) >= math.sin(READABLE_CROSSING) * np.abs(u) * np.abs(v)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        centre = (a + b) / 2 + UP * u * dot(u + v, v) / (2 * turn)
    return np.where(readable, centre, NOWHERE)


def tangent_of_circle(a: Points, b: Points, c: Points) -> Points:
    """The unit direction, a to c, in which the circle through three points passes b.

    The angle between a chord and the tangent at its end equals the angle over the chord (Euclid III.32), so the tangent
    is found without the centre, which may lie off the board: for points on a line it is the line.

    >>> at = np.asarray
    >>> complex(np.round(tangent_of_circle(at(-1 + 0j), at(1j), at(1 + 0j)), 15))
    (1+0j)
    """
    return unit((c - b) * (b - a) * np.conj(c - a))


def ray_to_circle(p: Points, d: Points, centre: Points | complex, radius: Floats | float) -> Points:
    """Where the ray from p along d leaves a circle; NaN when its line misses the circle.

    >>> at = np.asarray
    >>> complex(ray_to_circle(at(3 + 0j), at(1j), 0j, 5.0))
    (3+4j)
    """
    near = foot(np.asarray(centre), p, d)
    distance = np.abs(near - centre)
    radius = np.asarray(radius, dtype=np.float64)
    # The factored difference of squares keeps its digits when the line almost touches the circle.
    square = (radius - distance) * (radius + distance)
    half_chord = np.sqrt(np.where(square >= 0, square, np.nan))
    return near + unit(d) * half_chord


def circle_crossing(
    p: Points, radius_p: Floats | float, q: Points, radius_q: Floats | float, *, flat: bool = False
) -> Points:
    """Where two circles meet, to the left of the way from p to q; NaN when they do not, or at less than a degree.

    flat : to take any crossing for one, and circles that miss one another to touch halfway

    >>> at = np.asarray
    >>> complex(circle_crossing(at(0j), 5.0, at(6 + 0j), 5.0))
    (3+4j)
    """
    way = q - p
    distance = np.abs(way)
    radius_p = np.asarray(radius_p, dtype=np.float64)
    with np.errstate(divide="ignore", invalid="ignore"):  # about one centre they meet nowhere
        along = (distance + (radius_p - radius_q) * (radius_p + radius_q) / distance) / 2
        square = (radius_p - along) * (radius_p + along)
        aside = np.sqrt(np.where(square >= 0, square, 0.0 if flat else np.nan))
        # The radii to the meeting enclose the angle at which the circles cross: its sine from the triangle's area.
        readable = flat | (distance * aside >= math.sin(READABLE_CROSSING) * radius_p * radius_q)
        return p + unit(way) * np.where(readable, along + UP * aside, np.nan)
