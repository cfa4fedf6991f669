"""The assignment of a cam of three circular arcs: a task file with a table ``[arcs]`` in place of a motion."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any, Literal

from graphcam.given.follower import Translating
from graphcam.given.three_arcs import ThreeArcs
from graphcam.showing import parts_text
from graphcam.tasks.declared_numbers import About, Fixed, Ruled
from graphcam.tasks.number_limits import Within, check_limits
from graphcam.tasks.part_table import PartTable
from graphcam.tasks.sheet_tables import SheetTable, TitleTable, plain_data
from graphcam.tasks.units import Length, PartOfTurn, Size, SizeOrZero, Speed
from graphcam.words import say

MAX_PARTS = 200
"""The maximum number of parts of an arc; more cannot be drawn apart."""
PARTS_LIMIT = say("from 2 to {most} parts of each arc", most=MAX_PARTS)
XY = tuple[Length, Length]


@dataclass(frozen=True)
class ArcsTable:
    """``[arcs]``: a cam of three circular arcs by its points, as [x, y], and a radius.

    D : mm, end of the rise
    G : mm, where the second and third arcs meet
    rho1 : mm, radius of the first arc
    A : mm, start of the rise; left out: found
    C1 : mm, centre of the first arc; left out: found
    C2 : mm, centre of the second arc; left out: found
    dwell : degrees of the upper dwell on the outer circle; the return is the rise's mirror image
    """

    D: XY
    G: XY
    rho1: Annotated[Size, say("Radius of the first arc ρ₁"), Ruled()]
    A: XY | None = None
    C1: XY | None = None
    C2: XY | None = None
    dwell: Annotated[PartOfTurn, say("Upper dwell"), Fixed(0.0, 180.0, 1.0)] = 0.0

    def __post_init__(self) -> None:
        self()
        check_limits(self)

    def __call__(self) -> ThreeArcs:
        """The data of the cam."""
        return ThreeArcs(self.D, self.G, self.rho1, self.A, self.C1, self.C2)


@dataclass(frozen=True)
class RollerTable:
    """``[follower]``: a central translating follower.

    roller_radius : mm, 0 for a knife edge
    """

    roller_radius: Annotated[SizeOrZero, say("Roller radius r"), Ruled()] = 0.0
    kind: Literal["translating"] = "translating"

    def __post_init__(self) -> None:
        self()
        check_limits(self)

    def __call__(self) -> Translating:
        """The follower."""
        return Translating(0.0, self.roller_radius)


@dataclass(frozen=True)
class ArcsDrawingTable(SheetTable):
    """``[drawing]``: the sheet, and the divisions of the arcs.

    divisions : equal parts of each arc, at whose ends the roller is drawn
    """

    divisions: Annotated[int, Within(2, MAX_PARTS, PARTS_LIMIT), say("Divisions of a phase"), Fixed(2, 12, 1)] = 4


@dataclass(frozen=True)
class ArcsTask:
    """A cam of three circular arcs, as its file says it.

    speed_rpm : rpm, speed of the cam; left out: velocities and accelerations per radian of the cam

    Raises
    ------
    DesignError : an impossible value, alone or together with another

    >>> import graphcam as gc
    >>> gc.ArcsTask(ArcsTable(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40))).arcs().design_case
    4
    """

    arcs: ArcsTable
    follower: RollerTable = field(default_factory=RollerTable)
    speed_rpm: Annotated[Speed | None, say("Speed"), About(300.0)] = None
    title: TitleTable = field(default_factory=TitleTable)
    drawing: ArcsDrawingTable = field(default_factory=ArcsDrawingTable)
    part: PartTable | None = None
    __repr__ = parts_text

    def __post_init__(self) -> None:
        check_limits(self)

    def to_dict(self) -> dict[str, Any]:
        """The task with the keys of its file, as plain lists, numbers and text; what is open is left out.

        >>> import graphcam as gc
        >>> table = ArcsTable(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40))
        >>> gc.ArcsTask(table).to_dict()["arcs"]["A"]
        [0, 40]
        """
        return plain_data(self)
