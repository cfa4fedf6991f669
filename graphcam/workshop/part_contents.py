"""What the working drawing tells: the part, its exact outline, its polar table, and the title block."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from graphcam.drafting.scale import ratio_text
from graphcam.sheets.title_block import TitleBlock
from graphcam.solving.arcs_solution import AnySolution
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.sheet_tables import UNNAMED
from graphcam.words import Tell, say
from graphcam.workshop.cam_part import CamPart, cam_part
from graphcam.workshop.outline import Outline, outline_of
from graphcam.workshop.polar_table import PolarTable, polar_table


@dataclass(frozen=True, eq=False)
class PartContents:
    """What drawing and files tell of the cam of a solution as a part, before it finds its place.

    Each is found when it is first asked for, since the program of G-code takes no bore, and the solid no table.

    >>> import graphcam as gc
    >>> contents = PartContents(gc.solve(gc.builtin_task()))
    >>> contents.part.bore, contents.table.bound
    (28.0, 0.0125)
    """

    solution: AnySolution

    @property
    def given(self) -> PartTable:
        """What the task says of the part."""
        return self.solution.task.part or PartTable()

    @cached_property
    def outline(self) -> Outline:
        """The exact profile.

        Raises
        ------
        DesignError : no profile can be told that could be cut
        """
        return outline_of(self.solution)

    @cached_property
    def part(self) -> CamPart:
        """The sizes of the part, as :func:`~graphcam.workshop.cam_part.cam_part` settles them.

        Raises
        ------
        DesignError : the part cannot be
        """
        return cam_part(self.given, self.frame, self.outline.least_radius)

    @cached_property
    def table(self) -> PolarTable:
        """The polar table.

        Raises
        ------
        DesignError : as for :func:`~graphcam.workshop.polar_table.polar_table`
        """
        return polar_table(self.outline, self.given)

    @property
    def frame(self) -> str:
        """The frame of the sheet, which also chooses the standards."""
        return self.solution.task.drawing.frame

    @property
    def tell(self) -> Tell:
        """Says texts in the language of the task."""
        return self.solution.tell

    def check(self) -> None:
        """Refuse a part of which there can be no working drawing.

        Raises
        ------
        DesignError : as for what it tells
        """
        _ = self.part, self.table

    def title(self, scale: float) -> TitleBlock:
        """The title block of the part."""
        given, tell = self.solution.task.title, self.tell
        mass = self.part.mass(self.outline.area)
        # Three digits at least, and no powers of ten.
        decimals = max(0, 2 - math.floor(math.log10(mass)))
        told = say("{mass:.{decimals}f}") if self.frame == "gost" else say("{mass:.{decimals}f} kg")
        return TitleBlock(
            name=tell(say("Cam")) if given.name == str(UNNAMED) else given.told_name(tell),
            number=given.document,
            organisation=given.organisation,
            group=given.group,
            author=given.author,
            checked=given.checked,
            material=tell(self.part.material),
            mass=tell(told.where(mass=mass, decimals=decimals)),
            scale=tell(ratio_text(1 / scale)),
            remark=self.solution.task.drawing.remark,
        )
