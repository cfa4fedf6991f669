"""The views of the part: the profile in true view, its section through the axis, and the bore enlarged.

A view is drawn about a place of the page; its labels find room by themselves.
"""

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

from graphcam.drafting.marks import Arc, Circle, Dimension, Label, Line, Mark, Points, Region, Role, Segments
from graphcam.given.limits_and_fits import KeySection, tolerance
from graphcam.sheets.formats import Lettering
from graphcam.sheets.label_candidates import LabelText, label_along
from graphcam.sheets.mark_entities import MIN_INNER_HEADS, TAIL_LENGTH, Drawn, Placement, expand, head
from graphcam.sheets.model import Box, Curve, Entity, Length, Stroke
from graphcam.sheets.part_symbols import (
    SYMMETRY_TOLERANCE,
    cutting_plane,
    datum_letter,
    datum_triangle,
    segments,
    sense_arrow,
    tolerance_frame,
)
from graphcam.sheets.sampling import box_around
from graphcam.sheets.text_measures import width
from graphcam.words import Caption, Tell, Words, say, say_in
from graphcam.workshop.cam_part import CamPart, radius_decimals
from graphcam.workshop.part_outline import Groove, Outline

FIRST_DIMENSION_OFFSET, DIMENSION_SPACING = 9.0, 8.0
"""Distances of the first dimension line from the view, and from each to the next [mm of paper]."""
CENTRE_LINE_OVERHANG, AXIS_OVERHANG = 5.0, 4.0
"""The overhang of centre lines over the outline, and of the axis over the section [mm of paper]."""
ZERO_MARK_LENGTH = 6.0
"""The length of the zero mark [mm of paper]."""
DRAWN_POINT_STEP = 12
"""The step at which dense points of the outline are taken for the drawn smooth curve, exact between them."""
DISK_POINTS = 720
"""The number of points on the edge of a disk with a groove, for finding room."""
SHELF_OFFSET = 5.0
"""The distance from the left face of the section to the shelf of its chamfer [mm of paper]."""
CUTTING_PLANE_OFFSET = 11.0
"""The distance of the strokes of the cutting plane from the profile [mm of paper]."""
ARROW_GAP = 5.0
"""The gap between the profile and an arrow outside it [mm of paper]."""
SAME_RADIUS = 0.05
"""The change of a radius [mm of paper] up to which it counts as constant."""
SECTION_LETTER, DETAIL_LETTER = say_in("of a view", "A"), say_in("of a detail", "C")


@dataclass(frozen=True, eq=False)
class ShownPart:
    """A part as its views show it.

    frame : of the sheet, "iso" or "gost";  scale : mm of paper for a mm of the part;  bore_scale : the same of the
    bore enlarged
    """

    part: CamPart
    frame: str
    outline: Outline
    groove: Groove | None
    scale: float
    bore_scale: float
    letters: Lettering
    tell: Tell

    def paper(self, seen: Points) -> Points:
        """Points (n,) of the outline on paper [mm], in true view with the zero mark upwards."""
        return 1j * self.scale * (seen if self.outline.sense > 0 else np.conj(seen))

    @cached_property
    def profile(self) -> Points:
        """The dense outline (n,) on paper, about the axis [mm]."""
        return self.paper(self.outline.points)

    @cached_property
    def wall(self) -> Points:
        """The outermost wall on which a roller runs (n,) on paper [mm]: of a groove the outer one, else the profile."""
        return self.paper(self.groove.wall.points) if self.groove else self.profile

    @cached_property
    def contour(self) -> Points:
        """The edge of the part (n,) on paper, about the axis [mm]: the profile, or the disk with the groove."""
        if self.groove is None:
            return self.profile
        around: Points = np.exp(1j * np.linspace(0, 2 * math.pi, DISK_POINTS, endpoint=False))
        return self.scale * self.groove.disk_radius * around

    @cached_property
    def extent(self) -> Box:
        """The box of the part on paper, about the axis."""
        return box_around(self.contour)

    def reach(self, start: float, sweep: float) -> float:
        """The maximum radius on paper [mm] between the directions ``start`` and ``start + sweep`` [rad]."""
        low, high = sorted((start, start + sweep))
        turned = (np.angle(self.contour) - low) % (2 * math.pi)
        inside = turned <= high - low + 0.05
        return float(np.abs(self.contour[inside]).max())

    def radius(self, direction: complex) -> float:
        """The radius of the part on paper [mm] in a direction."""
        return radius_of(self.contour, direction)

    def expanded(self, marks: Sequence[Mark], origin: complex) -> Drawn:
        """Entities of marks about a place, their texts in the language of the drawing."""
        told = [
            replace(mark, text=self.tell(mark.text)) if isinstance(mark, Label | Dimension) else mark for mark in marks
        ]
        return expand(told, Placement(origin), self.letters)


def radius_of(curve: Points, direction: complex) -> float:
    """The radius of a dense curve (n,) round the axis in a direction."""
    turned = np.angle(curve / direction)
    order = np.argsort(turned)
    return float(np.interp(0.0, turned[order], np.abs(curve)[order]))


def size(length: float) -> Caption:
    """A length [mm] as on drawings, without needless zeros.

    >>> str(size(22.800000000000001)), str(size(27.0)), str(size(12.345))
    ('22.8', '27', '12.345')
    """
    return say("{length:g}", length=round(length, 9))


# --- the true view ---------------------------------------------------------------------------------------------------


def front_box(shown: ShownPart) -> Box:
    """The box of the true view about the axis, with its symbols."""
    box = shown.extent
    # Beyond the ends of the cutting plane with their letters.
    beyond = CUTTING_PLANE_OFFSET + 6.0 + 1.7 * shown.letters.title
    return Box(box.left - 16, box.bottom - beyond, box.right + 16, box.top + beyond)


def front_view(shown: ShownPart, origin: complex) -> Drawn:
    """The true view: profile, bore, hub, centre lines, zero mark, senses of angle and rotation, and cutting plane."""
    marks = [*bore_marks(shown.part, shown.scale), *_front_marks(shown), *_sense_labels(shown)]
    entities, writings = shown.expanded(marks, origin)
    radii = [_radius_dimension(shown, origin, place) for place in dimensioned_radii(shown)]
    entities += [*_profile(shown, origin), *_cutting_planes(shown, origin), *_senses(shown, origin)]
    return [*entities, *(e for lines, _ in radii for e in lines)], [*writings, *(w for _, w in radii)]


def _profile(shown: ShownPart, origin: complex) -> list[Entity]:
    """The profile as one closed curve; if it has corners, as a polygon through all its dense points."""
    points = origin + shown.profile
    if shown.outline.corners:
        return [Stroke(points, Role.RESULT, closed=True)]
    walls = [points, origin + shown.wall] if shown.groove else [points]
    return [Curve(wall[::DRAWN_POINT_STEP], Role.RESULT) for wall in walls]


def _front_marks(shown: ShownPart) -> list[Mark]:
    box, up = shown.extent, shown.radius(1j)
    ends = np.array([complex(box.left - CENTRE_LINE_OVERHANG), complex(0, box.bottom - CENTRE_LINE_OVERHANG)])
    others = np.array([complex(box.right + CENTRE_LINE_OVERHANG), complex(0, box.top + CENTRE_LINE_OVERHANG)])
    scribed = Line(np.array([1j * (up - 1.0), 1j * (up - 1.0 - ZERO_MARK_LENGTH)]), Role.CURVE)
    hub = shown.part.hub
    return [
        Segments(ends, others, Role.AXIS),
        scribed,
        Label(1j * (up - ZERO_MARK_LENGTH), say("0°"), 1 - 0.3j),
        *([Circle(0j, shown.scale * hub.diameter / 2, Role.RESULT)] if hub else []),
        *([Circle(0j, shown.radius(1j), Role.RESULT)] if shown.groove else []),
        *_detail_circle(shown),
    ]


def _detail_circle(shown: ShownPart) -> list[Mark]:
    radius = shown.scale * shown.part.keyway_top + 3.0
    at = radius * np.exp(-0.25j * math.pi)
    return [Circle(0j, radius, Role.DIMENSION), Label(complex(at), DETAIL_LETTER, 1 - 1j)]


def bore_marks(part: CamPart, scale: float) -> list[Mark]:
    """The bore with its keyway upwards."""
    radius = scale * part.bore / 2
    if part.keyway is None:
        return [Circle(0j, radius, Role.RESULT)]
    half, top = scale * part.keyway.width / 2, scale * part.keyway_top
    side = math.acos(half / radius)
    foot = 1j * math.sqrt(radius**2 - half**2)
    corners = np.array([half + foot, half + 1j * top, -half + 1j * top, -half + foot])
    return [Arc(0j, radius, math.pi - side, 2 * math.pi + side, Role.RESULT), Line(corners, Role.RESULT)]


def dimensioned_radii(shown: ShownPart) -> list[tuple[complex, Caption]]:
    """The places of the minimum and the maximum radius on the profile, each with the text of its dimension."""
    radii, decimals = np.abs(shown.outline.points), radius_decimals(shown.part.table, shown.outline.greatest_radius)
    told: list[tuple[complex, Caption]] = []
    # The profile's tolerance limits them, so they stand for reference.
    name = say("R{radius}*") if shown.frame == "gost" else say("(R{radius})")
    for extreme in (radii.min(), radii.max()):
        at = shown.profile[np.abs(radii - extreme) * shown.scale <= SAME_RADIUS]
        # Away from the centre lines, where the text has most room, and from the arrow of the rotation.
        oblique = np.abs(np.sin(2 * np.angle(at))) - 2.0 * ((at.real > 0) & (at.imag < 0))
        way = np.angle(at[np.argmax(oblique.round(6))])
        told.append(
            (cmath.rect(shown.scale * extreme, way), name.with_values(radius=size(round(float(extreme), decimals))))
        )
    return told


def _radius_dimension(
    shown: ShownPart, origin: complex, place: tuple[complex, Caption]
) -> tuple[list[Entity], LabelText]:
    """A line from the axis to the profile with one head, and its text."""
    at, text = origin + place[0], place[1]
    way = place[0] / abs(place[0])
    told, height = shown.tell(text), shown.letters.label
    inner, room = origin + way * (shown.scale * shown.part.keyway_top + 4.0), width(told, height) + 5.0
    outside = abs(at - inner) < room
    # Between the detail's circle and the profile where there is room, else beyond the profile.
    begin, end = (at + 2 * way, at + room * way) if outside else (inner, at)
    lines: tuple[Entity, ...] = (segments((origin, end)), head(at - 0.35 * way, way, Role.DIMENSION))
    writing = label_along(begin, end, told, height)
    measured = Length(origin, at, origin, lines)
    return list(lines), replace(writing, of=measured)


def _cutting_planes(shown: ShownPart, origin: complex) -> list[Entity]:
    letter, height = shown.tell(SECTION_LETTER), shown.letters.title
    above = cutting_plane(origin + 1j * (shown.radius(1j) + CUTTING_PLANE_OFFSET), 1j, 1.0, letter, height)
    below = cutting_plane(origin - 1j * (shown.radius(-1j) + CUTTING_PLANE_OFFSET), -1j, 1.0, letter, height)
    return above + below


@dataclass(frozen=True)
class SenseArrow:
    """An arrow about the axis: its name, its radius [mm of paper], its start and its sweep [rad]."""

    name: Caption
    radius: float
    start: float
    sweep: float


def _sense_arrows(shown: ShownPart) -> list[SenseArrow]:
    """The arrows outside the profile for the sense of the angle and that of the rotation."""
    sense = shown.outline.sense
    # Beside the zero mark, and at the lower right.
    counted, turned = (math.pi / 2 + 0.12 * sense, 0.5 * sense), (-0.35 - 0.275 * (1 - sense), -0.55 * sense)
    named = (say("θ"), counted), (say("rotation"), turned)
    return [SenseArrow(name, shown.reach(*arrow) + ARROW_GAP, *arrow) for name, arrow in named]


def _senses(shown: ShownPart, origin: complex) -> list[Entity]:
    arrows = _sense_arrows(shown)
    return [entity for a in arrows for entity in sense_arrow(origin, a.radius, a.start, a.sweep)]


def _sense_labels(shown: ShownPart) -> list[Mark]:
    ways = [(arrow, cmath.rect(1.0, arrow.start + arrow.sweep / 2)) for arrow in _sense_arrows(shown)]
    return [Label(arrow.radius * way, arrow.name, way) for arrow, way in ways]


# --- the section -----------------------------------------------------------------------------------------------------


def section_box(shown: ShownPart) -> Box:
    """The box of the section, about the axis on the left face."""
    box, part = shown.extent, shown.part
    beside = FIRST_DIMENSION_OFFSET * (part.hub is not None) + DIMENSION_SPACING * (shown.groove is not None)
    right = shown.scale * part.length + beside + (DIMENSION_SPACING if beside else 0.0)
    below = FIRST_DIMENSION_OFFSET + (DIMENSION_SPACING if part.hub else 0.0) + 4
    return Box(-34, box.bottom - below, right + 20, box.top + (22 if shown.groove is None else 26))


def section_view(shown: ShownPart, origin: complex) -> Drawn:
    """The section through axis and keyway seen from the left, with the edges behind it."""
    part, k = shown.part, shown.scale
    # The edges over the hatching that ends on them.
    marks: list[Mark] = [*_cut_faces(shown), *_cut_edges(shown), *_section_dimensions(shown)]
    marks.append(
        Segments(np.array([-AXIS_OVERHANG + 0j]), np.array([complex(k * part.length + AXIS_OVERHANG)]), Role.AXIS)
    )
    return shown.expanded(marks, origin)


def heights(shown: ShownPart) -> tuple[float, float, float, float]:
    """Heights on paper [mm]: the cut profile below and above the axis, and the profile seen behind it."""
    behind = shown.contour[shown.contour.real >= 0]
    cut = -shown.radius(-1j), shown.radius(1j)
    return (*cut, min(float(behind.imag.min()), cut[0]), max(float(behind.imag.max()), cut[1]))


def _cut_edges(shown: ShownPart) -> list[Mark]:
    part, k = shown.part, shown.scale
    low, high, seen_low, seen_high = heights(shown)
    w, end, c = k * part.width, k * part.length, k * part.chamfer
    r, top = k * part.bore / 2, k * part.keyway_top
    edge = math.sqrt(r**2 - (k * part.keyway.width / 2) ** 2) if part.keyway else r
    pairs = [(complex(0, seen_low), complex(w, seen_low)), (complex(0, seen_high), complex(w, seen_high))]
    # The cut and what is seen behind it are told apart where both can be seen.
    pairs += [(complex(0, y), complex(w, y)) for y, seen in ((low, seen_low), (high, seen_high)) if abs(y - seen) > 0.7]
    pairs += [(complex(0, seen_low), complex(0, seen_high))]
    if part.hub:
        half = k * part.hub.diameter / 2
        pairs += [(complex(w, seen_low), complex(w, -half)), (complex(w, half), complex(w, seen_high))]
        pairs += [(complex(w, y), complex(end, y)) for y in (-half, half)]
        pairs += [(complex(end, -half), complex(end, half))]
    else:
        pairs += [(complex(w, seen_low), complex(w, seen_high))]
    pairs += [(complex(c, -r), complex(end - c, -r)), (complex(c, edge), complex(end - c, edge))]
    pairs += [(complex(x, -r), complex(x, edge)) for x in (c, end - c)]
    pairs += [(complex(0, -r - c), complex(c, -r)), (complex(end, -r - c), complex(end - c, -r))]
    if part.keyway:
        # The keyway cuts the chamfers farther from the axis than the bore.
        rim = math.sqrt((r + c) ** 2 - (k * part.keyway.width / 2) ** 2)
        pairs += [(complex(0, top), complex(end, top))]
        pairs += [(complex(0, rim), complex(c, edge)), (complex(end, rim), complex(end - c, edge))]
    else:
        pairs += [(complex(0, r + c), complex(c, r)), (complex(end, r + c), complex(end - c, r))]
    for notch in _notches(shown):
        pairs += pairwise(notch)
    starts, ends = zip(*pairs, strict=True)
    return [Segments(np.array(starts), np.array(ends), Role.RESULT)]


def _notches(shown: ShownPart) -> list[list[complex]]:
    """The groove in the section, above and below the axis, from its outer wall to its inner one; none without it."""
    if shown.groove is None:
        return []
    face, bottom = shown.scale * shown.part.width, shown.scale * (shown.part.width - shown.groove.depth)
    walls = [[way.imag * radius_of(wall, way) for wall in (shown.wall, shown.profile)] for way in (1j, -1j)]
    return [
        [complex(face, outer), complex(bottom, outer), complex(bottom, inner), complex(face, inner)]
        for outer, inner in walls
    ]


def _cut_faces(shown: ShownPart) -> list[Mark]:
    """The hatched faces of the section: below the bore, and above the keyway."""
    part, k = shown.part, shown.scale
    low, high, *_ = heights(shown)
    w, end, c = k * part.width, k * part.length, k * part.chamfer
    r, top = k * part.bore / 2, k * part.keyway_top
    half = k * part.hub.diameter / 2 if part.hub else None

    notches = _notches(shown) or [[], []]

    def face(side: float, reach: float, inner: Sequence[complex]) -> Mark:
        """One of the two faces; ``inner`` runs along the bore from right to left."""
        outer = [complex(0, side * reach), complex(w, side * reach), *notches[0 if side > 0 else 1]]
        outer += [complex(w, side * half), complex(end, side * half)] if half else []
        return Region(np.array([*outer, *inner]))

    bevelled = [complex(end, r + c), complex(end - c, r), complex(c, r), complex(0, r + c)]
    above = [complex(end, top), complex(0, top)] if part.keyway else bevelled
    return [face(1.0, high, above), face(-1.0, -low, [z.conjugate() for z in bevelled])]


def _section_dimensions(shown: ShownPart) -> list[Mark]:
    part, k = shown.part, shown.scale
    _, _, low, _ = heights(shown)
    w, end = k * part.width, k * part.length
    marks: list[Mark] = [Dimension(complex(0, low), complex(w, low), size(part.width), -FIRST_DIMENSION_OFFSET)]
    if part.hub:
        half = k * part.hub.diameter / 2
        # Both from one level, so that their lines are parallel.
        marks.append(
            Dimension(
                complex(0, low), complex(end, low), size(part.hub.length), -FIRST_DIMENSION_OFFSET - DIMENSION_SPACING
            )
        )
        marks.append(Line(np.array([complex(end, -half - 1), complex(end, low - 2)]), Role.DIMENSION))
        diameter = say("⌀{length}", length=size(part.hub.diameter))
        marks.append(Dimension(complex(end, -half), complex(end, half), diameter, -FIRST_DIMENSION_OFFSET))
    if shown.groove:
        high = shown.extent.top
        depth, across = say("{length}", length=size(shown.groove.depth)), size(2 * shown.groove.disk_radius)
        bottom = complex(w - k * shown.groove.depth, high)
        marks.append(Dimension(bottom, complex(w, high), depth, FIRST_DIMENSION_OFFSET - 2))
        beyond = end - w + FIRST_DIMENSION_OFFSET + (DIMENSION_SPACING if part.hub else 0.0)
        marks.append(Dimension(complex(w, -high), complex(w, high), say("⌀{length}", length=across), -beyond))
    return [*marks, *_chamfer_marks(shown)]


def _chamfer_marks(shown: ShownPart) -> list[Mark]:
    """The size of the chamfer on a shelf at the left of the section, with a line to the chamfer."""
    text = say("{size} × 45°", size=size(shown.part.chamfer))
    c, r = shown.scale * shown.part.chamfer, shown.scale * shown.part.bore / 2
    face, knee = complex(c / 2, -r - c / 2), complex(-SHELF_OFFSET, SHELF_OFFSET - r)
    end = knee - width(shown.tell(text), shown.letters.label) - 1.0
    return [Line(np.array([face, knee, end]), Role.DIMENSION), Label((knee + end) / 2, text, 1j)]


DATUM_LETTER, KEYWAY_LETTER = say_in("of a datum", "B"), say_in("of the keyway as a datum", "D")
TRIANGLE_LEG = 5.0
"""The length of the line from a datum's triangle to its letter [mm of paper]."""


def bore_box(shown: ShownPart) -> Box:
    """The box of the enlarged bore, about its axis."""
    r, top = (shown.bore_scale * x for x in (shown.part.bore / 2, shown.part.keyway_top))
    return Box(-r - 30, -r - 20, r + 24, top + FIRST_DIMENSION_OFFSET + 20)


def bore_view(shown: ShownPart, origin: complex) -> Drawn:
    """The enlarged bore and keyway with their tolerances, and the axis as datum."""
    part, k = shown.part, shown.bore_scale
    r, top = k * part.bore / 2, k * part.keyway_top
    marks: list[Mark] = list(bore_marks(part, k))
    over = CENTRE_LINE_OVERHANG - 1.0
    starts, ends = (
        np.array([complex(-r - over), complex(0, -r - over)]),
        np.array([complex(r + over), complex(0, top + over)]),
    )
    marks.append(Segments(starts, ends, Role.AXIS))
    marks.append(Dimension(complex(-r), complex(r), bore_text(part, shown.frame), -r - FIRST_DIMENSION_OFFSET))
    if part.keyway:
        half = k * part.keyway.width / 2
        marks.append(Dimension(complex(-half, top), complex(half, top), keyway_text(part), FIRST_DIMENSION_OFFSET))
        over = upper_deviation(part.keyway.depth_over, shown.frame)
        depth = say("{size}{over}", size=size(part.bore + part.keyway.depth), over=over)
        marks.append(Dimension(complex(half, -r), complex(half, top), depth, -(r - half) - FIRST_DIMENSION_OFFSET))
    entities, writings = shown.expanded(marks, origin)
    entities += _datum(shown, origin + complex(r, -r - FIRST_DIMENSION_OFFSET), DATUM_LETTER, 0.0)
    if part.keyway:
        half, level = k * part.keyway.width / 2, top + FIRST_DIMENSION_OFFSET
        tail = 0.0 if 2 * half >= MIN_INNER_HEADS else TAIL_LENGTH
        entities += _datum(shown, origin + complex(half, level), KEYWAY_LETTER, tail)
        entities += _symmetry(shown, part.keyway, origin + complex(-half - tail, level))
    return entities, writings


def _datum(shown: ShownPart, at: complex, name: Caption, beyond: float) -> list[Entity]:
    """The datum triangle of an axis or a middle plane, in line with its dimension, on the extension line ``at``.

    beyond : how far the dimension line runs on beyond that, to the triangle [mm]
    """
    height = shown.letters.label
    letter, at = datum_letter(shown.tell(name), height), at + beyond
    corner = at + complex(height + TRIANGLE_LEG, -height)
    triangle = datum_triangle(at, 1 + 0j, height)
    return [triangle, segments((at + height, at + height + TRIANGLE_LEG)), *letter.drawn(corner)]


def _symmetry(shown: ShownPart, keyway: KeySection, at: complex) -> list[Entity]:
    """The frame of the keyway's symmetry to the bore, in line with the dimension of the width, whose end is ``at``."""
    if keyway.symmetry is None:
        return []
    value, datum = shown.tell(say("{value:g}", value=keyway.symmetry)), shown.tell(DATUM_LETTER)
    told = tolerance_frame(SYMMETRY_TOLERANCE, value, (datum,), shown.letters.label)
    corner = at - complex(told.box.width + TRIANGLE_LEG, told.box.height / 2)
    return [*told.drawn(corner), segments((at - TRIANGLE_LEG, at))]


def bore_text(part: CamPart, frame: str) -> Words:
    """The text of the bore's dimension: diameter, tolerance class and deviations."""
    grade = part.table.bore_tolerance
    over = tolerance(part.bore, int(grade[1:]))
    text = say("⌀{size} {grade}", size=size(part.bore), grade=grade)
    return text if over is None else say("{text} ({over})", text=text, over=upper_deviation(over, frame))


def upper_deviation(over: float, frame: str) -> Caption:
    """The text of deviations up to ``over`` mm; the lower one, zero, stands by ISO 129-1 and not by GOST 2.307.

    They are set one over the other, see :mod:`graphcam.sheets.text_measures`.

    >>> str(upper_deviation(0.021, "iso")), str(upper_deviation(0.021, "gost"))
    ('^{+0.021}_{0}', '^{+0.021}_{}')
    """
    return say("^{{+{over:g}}}_{{{under}}}", over=over, under="0" if frame == "iso" else "")


def keyway_text(part: CamPart) -> Words:
    """The text of the keyway's dimension: width, tolerance class JS9 of a normal fit, and deviations."""
    assert part.keyway is not None
    zone = tolerance(part.keyway.width, 9)
    assert zone is not None
    return say("{size} JS9 (±{half:g})", size=size(part.keyway.width), half=zone / 2)
