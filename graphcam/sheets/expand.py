"""From marks to entities: dimensions, arrows, angles and hatching become lines, arcs, triangles and texts."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from graphcam.drafting import marks
from graphcam.drafting.marks import Points, Role
from graphcam.sheets.fonts import extent
from graphcam.sheets.formats import Lettering
from graphcam.sheets.hatching import hatch
from graphcam.sheets.model import Angle, ArcEntity, Circles, Curve, Entity, Heads, Length, Stroke, Strokes
from graphcam.sheets.styles import STYLES
from graphcam.sheets.writing import Writing, along, around, outside, over

DOT = 0.75
"""Radius of the small open circle that marks a plotted point, mm."""
SMOOTH = 40
"""A closed bold line through at least so many points is drawn as a smooth curve: nobody draws such a polygon."""
SAME = 1e-6
"""Points so close together are one, mm."""
GAP, OVERRUN = 1.0, 2.0
"""Extension lines begin so far from what they measure and run so far beyond the dimension line, mm."""


@dataclass(frozen=True)
class Placement:
    """Where a view stands: its origin on the page, and the factor by which it is shown reduced."""

    origin: complex
    factor: float = 1.0

    def __call__(self, points: Points) -> Points:
        """Points of the view on the page."""
        return self.origin + self.factor * np.asarray(points, dtype=np.complex128)

    def point(self, at: complex) -> complex:
        """One point of the view on the page."""
        return self.origin + self.factor * complex(at)


Drawn = tuple[list[Entity], list[Writing]]
"""Entities, and the texts that still have to find their place."""


def expand(step_marks: Iterable[marks.Mark], place: Placement, letters: Lettering) -> Drawn:
    """The entities of marks, and the texts that still have to find their place."""
    entities: list[Entity] = []
    writings: list[Writing] = []
    for mark in step_marks:
        match mark:
            case marks.Line():
                entities += _line(mark, place)
            case marks.Segments():
                starts, ends = place(mark.starts), place(mark.ends)
                long = np.abs(ends - starts) > SAME
                if np.any(long):
                    entities.append(Strokes(starts[long], ends[long], mark.role))
            case marks.Circle():
                entities.append(
                    Circles(np.array([place.point(mark.centre)]), mark.radius * place.factor, mark.role))  # fmt: skip
            case marks.Arc():
                entities += _arc(mark, place)
            case marks.Dots():
                entities.append(Circles(np.atleast_1d(place(mark.points)), DOT, mark.role, opaque=True))
            case marks.Arrow():
                entities += arrow(place.point(mark.start), place.point(mark.end), mark.role)
            case marks.Label():
                height = letters.small if mark.small else letters.label
                writings.append(around(place.point(mark.at), str(mark.text), height, mark.towards))
            case marks.Dimension():
                drawn, text = _dimension(mark, place, letters.label)
                entities += drawn
                writings.append(text)
            case marks.AngleMark():
                drawn, text = _angle(mark, place, letters.label)
                entities += drawn
                writings.append(text)
            case marks.Region():
                entities.append(hatch(place(mark.boundary)))
    return entities, writings


def _line(mark: marks.Line, place: Placement) -> list[Entity]:
    points = place(mark.points)
    # A repeated point would make a piece of no length.
    following = np.roll(points, -1) if mark.closed else np.append(points[1:], np.inf)
    points = points[np.abs(following - points) > SAME]
    if len(points) < 2:
        return []
    if mark.closed and mark.role is Role.RESULT and len(points) >= SMOOTH:
        return [Curve(points, mark.role)]
    return [Stroke(points, mark.role, mark.closed)]


def head(tip: complex, direction: complex, role: str) -> Heads:
    """A slim arrow head with its ``tip``, pointing in the ``direction``; longer on bolder lines."""
    length = 3.0 + 3.0 * STYLES[role].width
    back = -length * direction / abs(direction)
    return Heads(np.array([[tip, tip + back * (1 + 0.16j), tip + back * (1 - 0.16j)]]), role)


def _shaft_end(tip: complex, direction: complex, role: str) -> complex:
    """Where the line behind a head stops, so that a bold one does not blunt the tip."""
    return tip - 1.5 * STYLES[role].width * direction / abs(direction)


def arrow(start: complex, end: complex, role: str) -> list[Entity]:
    """A line with a head at its end; without length it is nothing."""
    if abs(end - start) == 0 or not cmath.isfinite(end - start):
        return []
    tip = _shaft_end(end, end - start, role)
    return [Strokes(np.array([start]), np.array([tip]), role), head(end, end - start, role)]


def _arc(mark: marks.Arc, place: Placement) -> list[Entity]:
    centre, radius = place.point(mark.centre), mark.radius * place.factor
    drawn: list[Entity] = [ArcEntity(centre, radius, mark.start, mark.end, mark.role)]
    if mark.arrow:
        drawn.append(_arc_head(centre, radius, mark.end if mark.arrow == "end" else mark.start, mark.arrow, mark.role))
    return drawn


def _arc_head(centre: complex, radius: float, at: float, end: str, role: str) -> Heads:
    """A head at the direction ``at`` of an arc.  It lies on the chord, so that it does not leave the arc."""
    sense = 1 if end == "end" else -1
    half = min(1.0, (3.0 + 3.0 * STYLES[role].width) / (2 * radius))
    return head(centre + cmath.rect(radius, at), sense * 1j * cmath.rect(1.0, at - sense * half), role)


def _dimension(mark: marks.Dimension, place: Placement, height: float) -> tuple[list[Entity], Writing]:
    """Extension lines, the dimension line with its heads (from outside where there is no room), and its text."""
    start, end = place.point(mark.start), place.point(mark.end)
    direction = (end - start) / abs(end - start) if end != start else 1.0 + 0j
    # Shown reduced, the line comes nearer too, but not so near that its text would touch what it measures.
    distance = math.copysign(min(abs(mark.aside), max(6.0, place.factor * abs(mark.aside))), mark.aside)
    aside = 1j * direction * distance
    foot, tip, length = start + aside, end + aside, abs(end - start)
    drawn: list[Entity] = []
    if abs(distance) > GAP:
        away = aside / abs(aside)
        origins = np.array([start, end])
        drawn.append(Strokes(origins + GAP * away, origins + aside + OVERRUN * away, Role.DIMENSION))
    if length >= 9.0:
        heads = [head(foot, -direction, Role.DIMENSION), head(tip, direction, Role.DIMENSION)]
        before, after = 0.0, 0.0
    else:
        heads = [head(foot, direction, Role.DIMENSION), head(tip, -direction, Role.DIMENSION)]
        before, after = 6.0, 6.0
    line = foot - before * direction, tip + after * direction
    drawn += [Strokes(np.array(line[:1]), np.array(line[1:]), Role.DIMENSION), *heads]
    text = str(mark.text)
    standing = along if extent(text, height)[0] + 1.0 <= length else over
    return drawn, replace(standing(foot, tip, text, height), of=Length(start, end, foot, tuple(drawn)))


def _angle(mark: marks.AngleMark, place: Placement, height: float) -> tuple[list[Entity], Writing]:
    """An arc with heads at both ends (from outside where there is no room) and its text beyond the middle."""
    centre, radius = place.point(mark.centre), mark.radius * place.factor
    start, end = sorted((mark.start, mark.end))
    wide = (end - start) * radius >= 9.0
    tails = 0.0 if wide else 6.0 / radius
    heads = [
        _arc_head(centre, radius, start, "start" if wide else "end", Role.DIMENSION),
        _arc_head(centre, radius, end, "end" if wide else "start", Role.DIMENSION),
    ]
    arcs: list[Entity] = [ArcEntity(centre, radius, start - tails, end + tails, Role.DIMENSION)]
    drawn = [*arcs, *heads]
    writing = outside(centre, radius, start, end, str(mark.text), height)
    return drawn, replace(writing, of=Angle(centre, radius, start, end, tuple(drawn)))
