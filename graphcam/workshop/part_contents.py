"""What the working drawing tells: the part, its exact outline, its polar table, and the title block."""

from __future__ import annotations

import math
from dataclasses import dataclass

from graphcam.drafting.scale import ratio_text
from graphcam.sheets.title_block import TitleBlock
from graphcam.solving.arcs_solution import AnySolution
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.sheet_tables import TitleTable
from graphcam.words import Tell, say
from graphcam.workshop.cam_part import CamPart, cam_part
from graphcam.workshop.outline import Outline, outline_of
from graphcam.workshop.polar_table import PolarTable, polar_table


@dataclass(frozen=True, eq=False)
class PartContents:
    """What the drawing tells, before it finds its place.

    table : the polar table;  outline : the exact profile
    """

    solution: AnySolution
    part: CamPart
    outline: Outline
    table: PolarTable

    @property
    def frame(self) -> str:
        """Of the sheet, which also chooses the standards."""
        return self.solution.task.drawing.frame

    @property
    def tell(self) -> Tell:
        """Says texts in the language of the task."""
        return self.solution.tell

    def title(self, scale: float) -> TitleBlock:
        """The title block of the part."""
        given, tell = self.solution.task.title, self.tell
        mass = self.part.mass(self.outline.area)
        # Three digits at least, and no powers of ten.
        decimals = max(0, 2 - math.floor(math.log10(mass)))
        told = say("{mass:.{decimals}f}") if self.frame == "gost" else say("{mass:.{decimals}f} kg")
        return TitleBlock(
            name=tell(say("Cam")) if given.name == TitleTable().name else given.name,
            number=given.document,
            organisation=given.organisation,
            group=given.group,
            author=given.author,
            checked=given.checked,
            material=tell(self.part.material),
            mass=tell(told.where(mass=mass, decimals=decimals)),
            scale=tell(ratio_text(1 / scale)),
        )


def part_contents(solution: AnySolution) -> PartContents:
    """The part of a solution, with its exact outline and its polar table.

    Raises
    ------
    DesignError : the part cannot be, or no profile can be cut
    """
    table, outline = solution.task.part or PartTable(), outline_of(solution)
    part = cam_part(table, solution.task.drawing.frame, outline.least_radius)
    return PartContents(solution, part, outline, polar_table(outline, table))
