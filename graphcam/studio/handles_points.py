"""Handles of the points through which a motion goes: those of its conditions, and rows of a measured table."""

import math
from collections.abc import Iterator
from pathlib import PurePath
from typing import NamedTuple

from graphcam.constructions.views import DISPLACEMENT
from graphcam.drafting.euclid import UP
from graphcam.solving.solution import Solution
from graphcam.studio.handle import Changes, Handle, HandleAxis, changes_with, size_handle
from graphcam.studio.size_ranges import SizeRange, round_up, step_for
from graphcam.words import say

ROWS_BETWEEN = 12
"""The rows of a table between two that can be dragged, as a part of all of them."""
EDITED = "-edited"
"""The file of an edited table is called so."""


class _Paper(NamedTuple):
    """What a millimetre of the diagram stands for, degrees and displacement, and the displacement at its axis."""

    degrees: float
    lift: float
    axis: float

    def place(self, angle: float, lift: float) -> complex:
        """Where a cam angle [degrees] and a displacement are."""
        return complex(angle / self.degrees, (lift - self.axis) / self.lift)


def _paper(solution: Solution, lifts: list[float]) -> _Paper:
    scale = solution.chain["integration"].readings["s"].per_mm / solution.task.motion.lift_unit
    return _Paper(math.degrees(solution.chain.board.mu_phi.per_mm), scale, min(lifts))


def _lifts(values: list[float]) -> SizeRange:
    step = step_for(max(values) - min(values) or 1.0)
    return SizeRange(min(0.0, *values), round_up(1.6 * max(*map(abs, values), step)), step)


def conditions(solution: Solution) -> Iterator[Handle]:
    """The points of a motion by conditions with a displacement: of those within a part the cam angle is moved too.

    Where a part begins at the height at which the one before it has ended, both go together.
    """
    parts = solution.task.motion.parts
    if parts is None:
        return
    unit = solution.task.follower.column.removeprefix("s_").replace("deg", "°")
    given = [point.s for part in parts for point in part.points if point.s is not None]
    if not given:
        return
    paper, lifts = _paper(solution, given), _lifts(given)
    for k, part in enumerate(parts):
        following = parts[(k + 1) % len(parts)].points[0]
        for j, point in enumerate(part.points):
            # The height from which the follower sets out is that of all others.
            if not point.s:
                continue
            path, extra, axes = f"motion.parts[{k}].points[{j}]", {}, []
            within = 0 < j < len(part.points) - 1
            if within:
                room = SizeRange(part.points[j - 1].angle + 1.0, part.points[j + 1].angle - 1.0, 1.0)
                axes.append(HandleAxis(f"{path}.angle", say("Cam angle φ"), "°", point.angle, room, "x"))
            elif j and following.s == point.s:
                extra = {"with": {f"motion.parts[{(k + 1) % len(parts)}].points[0].s": 1.0}}
            elif not j:
                continue
            rising = HandleAxis(f"{path}.s", say("Displacement s"), unit, point.s, lifts, "y", extra)
            at, moved = paper.place(point.angle, point.s), (*axes, rising)

            def drag(to: complex, fine: bool, moved: tuple[HandleAxis, ...] = moved, at: complex = at) -> Changes:
                """The angle across, the displacement upwards."""
                *across, rising = moved
                angles = {each.path: each.range.nearest_step(to.real * paper.degrees, fine=fine) for each in across}
                height = rising.range.nearest_step(rising.value + (to.imag - at.imag) * paper.lift, fine=fine)
                return angles | changes_with(rising.extra or {}, rising.path, height)

            name, shape = say("Point of the motion at {angle:g}°", angle=point.angle), "xy" if within else "y"
            yield Handle(DISPLACEMENT.name, f"point {k}.{j}", name, at, shape, moved, drag)


def rows(solution: Solution) -> Iterator[Handle]:
    """Some rows of a measured displacement: those beside a dragged one follow it, less and less.

    The table is called edited from then on.
    """
    table = solution.task.motion.table
    if table is None or table.column not in ("s_mm", "s_deg") or solution.task.motion.symmetric:
        return
    unit = "°" if table.column == "s_deg" else "mm"
    given, apart = table.rows, max(1, len(table.rows) // ROWS_BETWEEN)
    reach = 3 * apart // 2
    heights, file = [s for _, s in given], PurePath(table.file)
    paper, lifts = _paper(solution, heights), _lifts(heights)
    edited = table.file if file.stem.endswith(EDITED) else f"{file.stem}{EDITED}{file.suffix}"
    cam_degree = 1.0 / (solution.task.motion.per_cam_degree or 1.0)
    for k in range(apart, len(given) - apart, apart):
        beside = range(max(k - reach, 0), min(k + reach + 1, len(given)))
        # What rests is left as it is.
        if len({given[j][1] for j in beside}) == 1:
            continue
        start, at = given[k][1], paper.place(given[k][0] * cam_degree, given[k][1])
        # A wave is added whose ends are level and without acceleration.
        shares = {j: round(((1.0 + math.cos(math.pi * (j - k) / reach)) / 2.0) ** 2, 3) for j in beside if j != k}
        extra = {
            "first": {"motion.table.file": edited},
            "with": {f"motion.table.rows[{j}][1]": share for j, share in shares.items()},
            "beyond": {f"motion.table.rows[{j}][1]": round(given[j][1] - start * shares[j], 4) for j in shares},
        }
        axis = HandleAxis(f"motion.table.rows[{k}][1]", say("Displacement s"), unit, start, lifts, "y", extra)
        name = say("Row of the table at {angle:g}°", angle=given[k][0])
        yield size_handle(DISPLACEMENT.name, f"point {k}", name, at, UP / paper.lift, axis)
