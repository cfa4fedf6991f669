"""The paper that a task's sheet has for views, with the drawing scales of its standard."""

from graphcam.drafting.scale import STANDARD_RATIOS, Paper
from graphcam.sheets.formats import Format
from graphcam.sheets.layout import profile_room
from graphcam.sheets.leaves import free_rooms
from graphcam.tasks.sheet_tables import SheetTable


def format_of(drawing: SheetTable) -> Format:
    """The sheet that a task asks for."""
    return Format(drawing.format, drawing.frame, drawing.orientation)


def profile_paper(drawing: SheetTable, share: float = 1.0) -> Paper:
    """What the cam's profile may take of the sheet, or a share of its width and height."""
    width, height = profile_room(drawing.format, drawing.frame, drawing.orientation)
    return Paper(share * width, share * height, STANDARD_RATIOS[drawing.frame])


def papers(drawing: SheetTable, beside: complex = 0j) -> list[Paper]:
    """The largest free boxes of a page, the widest first, that hold more than what stands beside a view.

    beside : wide + i high [mm of paper]

    >>> [paper.height for paper in papers(SheetTable("A3"), complex(100.0, 240.0))]
    [258.0, 272.0]
    """
    rooms, ratios = free_rooms(format_of(drawing)), STANDARD_RATIOS[drawing.frame]
    return [Paper(*room, ratios) for room in rooms if room[0] > beside.real and room[1] > beside.imag]


def largest_drawn(drawing: SheetTable, size: complex, beside: complex) -> Paper:
    """The free box of a page in which a view is drawn the largest.

    size : of the view, wide + i high [mm];  beside : what stands around it [mm of paper]
    """
    return min(papers(drawing, beside), key=lambda paper: paper.scale(size, beside).per_mm)
