"""What a motion by conditions was asked for, as a table of the sheet and of the note."""

from graphcam.constructions.law_names import LAW_TITLES
from graphcam.given.boundary_motion import BoundaryMotion
from graphcam.given.motion_point import ORDERS
from graphcam.sheets.tables import Table
from graphcam.solving.solution import Solution
from graphcam.words import Words, say

MOST_ON_SHEET = 16
"""A longer table stands in the note only."""
IN_MM, IN_DEGREES = say("Conditions of the motion, mm and rad"), say("Conditions of the motion, degrees and rad")


def conditions(solution: Solution) -> Table | None:
    """The points of all parts, in the units of the task file; None where the motion has another source.

    >>> import graphcam as gc
    >>> conditions(gc.solve(gc.builtin_task())) is None
    True
    """
    motion, tables = solution.chain.board.motion, solution.task.motion.parts
    if not isinstance(motion, BoundaryMotion) or tables is None:
        return None
    points = [point for table in tables for point in table.points]
    asked = [name for name in ORDERS if any(getattr(point, name) is not None for point in points)]
    rows: list[tuple[Words, ...]] = []
    for table, part in zip(tables, motion.parts, strict=True):
        named: Words = say("{name}, degree {degree}", name=LAW_TITLES[part.name], degree=part.highest_power)
        for point in table.points:
            given = (getattr(point, name) for name in asked)
            values = ("" if x is None else say("{x:g}", x=x) for x in given)
            rows.append((named, say("{angle:g}°", angle=point.angle), *values))
            named = ""
    swings = solution.task.follower.column == "s_deg"
    return Table(IN_DEGREES if swings else IN_MM, (say("part of the motion"), "φ", *asked), tuple(rows))


def on_sheet(solution: Solution) -> tuple[Table, ...]:
    """The same where there is room for it."""
    table = conditions(solution)
    return () if table is None or len(table.rows) > MOST_ON_SHEET else (table,)
