"""The bore of the part, enlarged: bore and keyway with their tolerances, and the datum."""

from __future__ import annotations

import numpy as np

from graphcam.drafting.marks import Dimension, Mark, Role, Segments
from graphcam.sheets.box import Box
from graphcam.sheets.expand import Drawn
from graphcam.sheets.model import Entity
from graphcam.sheets.part_symbols import datum_letter, datum_triangle, segments
from graphcam.words import Caption, Words, say, say_in
from graphcam.workshop.cam_part import CamPart
from graphcam.workshop.limits_and_fits import tolerance
from graphcam.workshop.part_views import BESIDE, OVERHANG, ShownPart, bore_marks, size

DATUM = say_in("of a datum", "B")


def bore_box(shown: ShownPart) -> Box:
    """The room of the enlarged bore about its axis."""
    r, top = (shown.bore_scale * x for x in (shown.part.bore / 2, shown.part.keyway_top))
    return Box(-r - 30, -r - 20, r + 24, top + BESIDE + 20)


def bore_view(shown: ShownPart, origin: complex) -> Drawn:
    """Bore and keyway with their tolerances, and the datum: the axis."""
    part, k = shown.part, shown.bore_scale
    r, top = k * part.bore / 2, k * part.keyway_top
    marks: list[Mark] = list(bore_marks(part, k))
    over = OVERHANG - 1.0
    starts, ends = (
        np.array([complex(-r - over), complex(0, -r - over)]),
        np.array([complex(r + over), complex(0, top + over)]),
    )
    marks.append(Segments(starts, ends, Role.AXIS))
    marks.append(Dimension(complex(-r), complex(r), bore_text(part, shown.frame), -r - BESIDE))
    if part.keyway:
        half = k * part.keyway.width / 2
        marks.append(Dimension(complex(-half, top), complex(half, top), keyway_text(part), BESIDE))
        over = upper_deviation(part.keyway.depth_over, shown.frame)
        depth = say("{size} {over}", size=size(part.bore + part.keyway.depth), over=over)
        marks.append(Dimension(complex(half, -r), complex(half, top), depth, -(r - half) - BESIDE))
    entities, writings = shown.expanded(marks, origin)
    return [*entities, *_datum(shown, origin + complex(r, -r - BESIDE))], writings


def _datum(shown: ShownPart, at: complex) -> list[Entity]:
    """The datum triangle on the extension line of the bore's diameter, in line with the dimension: its axis."""
    height = shown.letters.label
    letter = datum_letter(shown.tell(DATUM), height)
    corner = at + complex(height + 5.0, -height)
    triangle = datum_triangle(at, 1 + 0j, height)
    return [triangle, segments((at + height, at + height + 5.0)), *letter.drawn(corner)]


def bore_text(part: CamPart, frame: str) -> Words:
    """Diameter, tolerance class and its deviations."""
    grade = part.table.bore_tolerance
    over = tolerance(part.bore, int(grade[1:]))
    text = say("⌀{size} {grade}", size=size(part.bore), grade=grade)
    return text if over is None else say("{text} ({over})", text=text, over=upper_deviation(over, frame))


def upper_deviation(over: float, frame: str) -> Caption:
    """The upper deviation of two; the lower one, which is zero, is told by ISO 129-1 and not by GOST 2.307.

    >>> str(upper_deviation(0.021, "iso")), str(upper_deviation(0.021, "gost"))
    ('+0.021/0', '+0.021')
    """
    return (say("+{over:g}/0") if frame == "iso" else say("+{over:g}")).where(over=over)


def keyway_text(part: CamPart) -> Words:
    """Width, tolerance class JS9 of a normal fit, and its deviations."""
    assert part.keyway is not None
    zone = tolerance(part.keyway.width, 9)
    assert zone is not None
    return say("{size} JS9 (±{half:g})", size=size(part.keyway.width), half=zone / 2)
