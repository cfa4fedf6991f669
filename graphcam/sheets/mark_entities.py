"""Marks as entities: dimensions, arrows, angles and hatching become lines, arcs, triangles and texts."""

import cmath
import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting import marks
from graphcam.drafting.marks import Points, Role
from graphcam.sheets.formats import Lettering
from graphcam.sheets.label_candidates import (
    LabelText,
    label_along,
    label_along_arc,
    label_around,
    label_in_line,
    label_over,
    unit,
)
from graphcam.sheets.model import Angle, ArcEntity, Circles, Curve, Entity, Heads, Length, Source, Stroke, Strokes
from graphcam.sheets.styles import STYLES_BY_ROLE
from graphcam.sheets.text_measures import extent
from graphcam.words import Tell

DOT_RADIUS = 0.75
"""The radius of the small open circle that marks a plotted point [mm]."""
MIN_SMOOTH_POINTS = 40
"""The minimum number of points of a closed bold line that is drawn as a smooth curve: nobody draws such a polygon."""
SAME_POINT = 1e-6
"""The maximum distance of points that count as one [mm]."""
EXTENSION_GAP, EXTENSION_OVERRUN = 1.0, 2.0
"""The gap between an extension line and what it measures, and its overrun over the dimension line [mm]."""
MIN_INNER_HEADS, TAIL_LENGTH = 9.0, 6.0
"""The length of a dimension line below which its heads are outside, and the length of their tails [mm]."""
MIN_DISTANCE = 6.0
"""The minimum distance of a dimension line from what it measures, when the view is shown reduced [mm]."""
HATCHING_SPACING = 3.0
"""The distance of hatching lines [mm]."""
MAX_HATCHING_LINES = 2000
"""The maximum number of lines of a hatching, more than the largest sheet holds; beyond it they are wider apart."""


@dataclass(frozen=True)
class Placement:
    """The place of a view: its origin on the page, and the factor by which it is shown reduced."""

    origin: complex
    factor: float = 1.0

    def __call__(self, points: Points) -> Points:
        """Points on the page of points of the view [mm]."""
        return self.origin + self.factor * np.asarray(points, dtype=np.complex128)

    def point(self, at: complex) -> complex:
        """The point on the page of a point of the view [mm]."""
        return self.origin + self.factor * complex(at)


Drawn = tuple[list[Entity], list[LabelText]]
"""Entities, and texts without a place yet."""


def expand(step_marks: Iterable[marks.Mark], place: Placement, letters: Lettering, tell: Tell = str) -> Drawn:
    """The entities of marks, and their texts, translated by ``tell``, without a place yet."""
    drawn = [_sourced(mark, *_expanded(mark, place, letters, tell)) for mark in step_marks]
    return [e for entities, _ in drawn for e in entities], [writing for _, writings in drawn for writing in writings]


def _sourced(mark: marks.Mark, entities: list[Entity], writings: list[LabelText]) -> Drawn:
    """The entities and texts with the mark's source, where they have none of their own."""
    if mark.of is None:
        return entities, writings
    source = Source(mark.of, mark.index)
    return (
        [entity if entity.source else replace(entity, source=source) for entity in entities],
        [replace(writing, source=source) for writing in writings],
    )


def _source_of_pieces(mark: marks.Line | marks.Segments, kept: NDArray[np.bool_]) -> Source | None:
    if mark.of is None:
        return None
    return Source(mark.of, None if mark.index is None else mark.index[kept])


def _expanded(mark: marks.Mark, place: Placement, letters: Lettering, tell: Tell) -> Drawn:
    match mark:
        case marks.Line():
            return _line(mark, place), []
        case marks.Segments():
            starts, ends = place(mark.starts), place(mark.ends)
            long = np.abs(ends - starts) > SAME_POINT
            strokes = Strokes(starts[long], ends[long], mark.role, _source_of_pieces(mark, long))
            return [strokes] if np.any(long) else [], []
        case marks.Circle():
            return [Circles(np.array([place.point(mark.centre)]), mark.radius * place.factor, mark.role)], []
        case marks.Arc():
            return _arc(mark, place), []
        case marks.Dots():
            # A curve runs on through the points that it is drawn through, and ends at pivots and centres.
            opaque = mark.role is not Role.CONSTRUCTION
            return [Circles(np.atleast_1d(place(mark.points)), DOT_RADIUS, mark.role, opaque=opaque)], []
        case marks.Arrow():
            return arrow(place.point(mark.start), place.point(mark.end), mark.role), []
        case marks.Label():
            height = letters.small if mark.small else letters.label
            writing = label_around(place.point(mark.at), tell(mark.text), height, mark.towards)
            return [], [label_in_line(writing, place.point(mark.at), place.factor * mark.along)]
        case marks.Dimension():
            return _dimension(mark, place, tell(mark.text), letters.label)
        case marks.AngleMark():
            return _angle(mark, place, tell(mark.text), letters.label)
        case marks.Region():
            # Where nothing is permitted nothing is hatched.
            return [hatch(place(mark.boundary))] if np.size(mark.boundary) else [], []


def _line(mark: marks.Line, place: Placement) -> list[Entity]:
    points = place(mark.points)
    # A repeated point would make a piece of no length.
    following = np.roll(points, -1) if mark.closed else np.append(points[1:], np.inf)
    apart = np.abs(following - points) > SAME_POINT
    points, source = points[apart], _source_of_pieces(mark, apart)
    if len(points) < 2:
        return []
    if mark.closed and mark.role is Role.RESULT and len(points) >= MIN_SMOOTH_POINTS:
        return [Curve(points, mark.role, source)]
    return [Stroke(points, mark.role, mark.closed, source)]


def _head_length(role: str) -> float:
    return 3.0 + 3.0 * STYLES_BY_ROLE[role].width


def head(tip: complex, direction: complex, role: str) -> Heads:
    """A slim arrow head with its ``tip``, pointing in the ``direction``; longer on bolder lines."""
    back = -_head_length(role) * direction / abs(direction)
    return Heads(np.array([[tip, tip + back * (1 + 0.16j), tip + back * (1 - 0.16j)]]), role)


def arrow(start: complex, end: complex, role: str) -> list[Entity]:
    """A line with a head at its end; nothing if it has no length."""
    way = end - start
    if way == 0 or not cmath.isfinite(way):
        return []
    # The line stops behind the tip, so that a bold one does not blunt it.
    tip = end - 1.5 * STYLES_BY_ROLE[role].width * way / abs(way)
    return [Strokes(np.array([start]), np.array([tip]), role), head(end, way, role)]


def _arc(mark: marks.Arc, place: Placement) -> list[Entity]:
    centre, radius = place.point(mark.centre), mark.radius * place.factor
    drawn: list[Entity] = [ArcEntity(centre, radius, mark.start, mark.end, mark.role)]
    if mark.arrow:
        drawn.append(_arc_head(centre, radius, mark.end if mark.arrow == "end" else mark.start, mark.arrow, mark.role))
    return drawn


def _arc_head(centre: complex, radius: float, at: float, end: str, role: str) -> Heads:
    """A head at the direction ``at`` of an arc, along the chord, so that it does not leave the arc."""
    sense = 1 if end == "end" else -1
    half = min(1.0, _head_length(role) / (2 * radius))
    return head(centre + cmath.rect(radius, at), sense * 1j * cmath.rect(1.0, at - sense * half), role)


def _dimension(mark: marks.Dimension, place: Placement, text: str, height: float) -> Drawn:
    """Extension lines, the dimension line with its heads (from outside where there is no room), and its text."""
    start, end = place.point(mark.start), place.point(mark.end)
    direction, length = unit(end - start), abs(end - start)
    # Shown reduced, the line comes nearer too, but not so near that its text would touch what it measures.
    distance = math.copysign(min(abs(mark.aside), max(MIN_DISTANCE, place.factor * abs(mark.aside))), mark.aside)
    aside = 1j * direction * distance
    foot, tip = start + aside, end + aside
    drawn: list[Entity] = []
    if abs(distance) > EXTENSION_GAP:
        away, origins = aside / abs(aside), np.array([start, end])
        drawn.append(
            Strokes(origins + EXTENSION_GAP * away, origins + aside + EXTENSION_OVERRUN * away, Role.DIMENSION)
        )
    inside = length >= (MIN_INNER_HEADS / 2 if mark.of_radius else MIN_INNER_HEADS)
    tail, outwards = (0.0, direction) if inside else (TAIL_LENGTH, -direction)
    line = np.array([foot - (0.0 if mark.of_radius else tail) * direction, tip + tail * direction])
    drawn.append(Strokes(line[:1], line[1:], Role.DIMENSION))
    drawn += [] if mark.of_radius else [head(foot, -outwards, Role.DIMENSION)]
    drawn.append(head(tip, outwards, Role.DIMENSION))
    standing = label_along if extent(text, height)[0] + 1.0 <= length else label_over
    return drawn, [
        replace(standing(foot, tip, text, height), of=Length(start, end, foot, tuple(drawn), mark.of_radius))
    ]


def _angle(mark: marks.AngleMark, place: Placement, text: str, height: float) -> Drawn:
    """An arc with heads at both ends (from outside where there is no room) and its text beyond the middle."""
    centre, radius = place.point(mark.centre), mark.radius * place.factor
    start, end = sorted((mark.start, mark.end))
    tail, at_start, at_end = (0.0, "start", "end")
    if (end - start) * radius < MIN_INNER_HEADS:
        # Of an angle that is hardly to be seen the tails go round at most.
        tail, at_start, at_end = min(TAIL_LENGTH / radius, math.pi - (end - start) / 2), "end", "start"
    drawn: list[Entity] = [
        ArcEntity(centre, radius, start - tail, end + tail, Role.DIMENSION),
        _arc_head(centre, radius, start, at_start, Role.DIMENSION),
        _arc_head(centre, radius, end, at_end, Role.DIMENSION),
    ]
    writing = label_along_arc(centre, radius, start, end, text, height)
    return drawn, [replace(writing, of=Angle(centre, radius, start, end, tuple(drawn)))]


def hatch(boundary: Points, spacing: float = HATCHING_SPACING) -> Strokes:
    """Hatching lines at 45 degrees inside a polygon (n,), which may have notches.

    Every line runs inside from an odd crossing of the outline to the next one.

    >>> square = np.array([0, 10, 10 + 10j, 10j])
    >>> lines = hatch(square, spacing=5.0)
    >>> bool(np.all(np.abs(lines.ends - lines.starts) < 14.15))
    True
    """
    # Turned by -45 degrees the lines of hatching lie level, at heights that are whole multiples of the spacing.
    turn = cmath.rect(1.0, -math.pi / 4)
    corners = np.asarray(boundary, dtype=np.complex128) * turn
    nexts = np.roll(corners, -1)
    spacing = max(spacing, float(np.ptp(corners.imag)) / MAX_HATCHING_LINES)
    low, high = math.floor(corners.imag.min() / spacing), math.ceil(corners.imag.max() / spacing)
    starts: list[complex] = []
    ends: list[complex] = []
    for level in spacing * np.arange(low, high + 1):
        # A corner on the line belongs to the side above it, so crossings come in pairs.
        cut = (corners.imag <= level) != (nexts.imag <= level)
        a, b = corners[cut], nexts[cut]
        x = np.sort(a.real + (level - a.imag) * (b.real - a.real) / (b.imag - a.imag))
        starts += list(x[::2] + 1j * level)
        ends += list(x[1::2] + 1j * level)
    return Strokes(np.array(starts, dtype=complex) / turn, np.array(ends, dtype=complex) / turn, Role.HATCH)
