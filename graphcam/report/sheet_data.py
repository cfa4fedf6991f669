"""The tables that the sheet and the note have in common."""

from __future__ import annotations

import math
from collections.abc import Mapping

from graphcam.comparison.quantities import Quantity
from graphcam.constructions.axes import degrees, phase_title, turning
from graphcam.constructions.law_names import law_name
from graphcam.drafting.units import unit
from graphcam.given.measured import MeasuredMotion
from graphcam.given.motion import Dwell, Motion
from graphcam.report.markdown import number
from graphcam.sheets.tables import Table
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Words, say, sequence

Row = tuple[Words, Words, Words]
"""What something is called, its value, and where it comes from."""
GIVEN, ADOPTED, LIMIT = say("given"), say("adopted"), say("limit")
AT_SPEED: Mapping[str, tuple[Caption, ...]] = {
    "mm": (say("t, s"), say("v, m/s"), say("a, m/s²")),
    "rad": (say("t, s"), say("v, rad/s"), say("a, rad/s²")),
}
"""What is told of a phase at a speed, by the unit of the lift: v and a are the greatest."""


def sizes(solution: Solution) -> list[Row]:
    """The sizes of the cam that is built: name, value, and whether it was given or adopted."""
    cam, board = solution.cam, solution.chain.board
    follower, prime_radius = board.follower, _mm(cam.prime_radius)
    asked = {follower.place_name: follower.place, "roller_radius": board.roller_radius}
    return [
        (say("prime radius r₀"), prime_radius, _by(board.prime_radius)),
        *(
            (size.title, _mm(size.value + 0.0), _by(asked.get(size.name, size.value)))
            for size in follower.sizes(solution.chain.place, cam.roller_radius)
            if size.value is not None
        ),
    ]


def _mm(length: float) -> Caption:
    return say("{length:g} mm", length=length)


def _by(asked: float | None) -> Caption:
    return ADOPTED if asked is None else GIVEN


def data(solution: Solution) -> Table:
    """The data of the cam, and which of them the task gives; a limit may be the usual one."""
    task = solution.task
    rows: list[Row] = [
        (say("rotation"), turning(task.rotation), GIVEN),
        *([(say("speed"), say("{rpm:g} rpm", rpm=task.speed_rpm), GIVEN)] if task.speed_rpm else []),
        *sizes(solution),
        *_limits(solution),
        *_measured(solution),
    ]
    found = frozenset((row, 1) for row, (_, _, by) in enumerate(rows) if by in (ADOPTED, ""))
    return Table(say("Data"), (say("quantity"), say("value"), ""), tuple(rows), found)


def _measured(solution: Solution) -> list[Row]:
    """Of a measured motion: its table, how near it comes to the rows, and from where its cam angle is counted."""
    table, motion = solution.task.motion.table, solution.chain.board.motion
    if table is None or not isinstance(motion, MeasuredMotion):
        return []
    lift_unit = solution.task.motion.lift_unit
    swings = solution.chain.board.follower.unit == "rad"
    residual = say(
        "{greatest:.2g}, rms {rms:.2g}",
        greatest=motion.greatest_residual / lift_unit,
        rms=motion.rms_residual / lift_unit,
    )
    return [
        (say("table of the motion"), table.file, GIVEN),
        (say("tolerance"), degrees(motion.tolerance) if swings else _mm(motion.tolerance), GIVEN),
        (say("residual"), residual, ""),
        *([(say("cam angle 0 of the table at"), degrees(-motion.zero), "")] if motion.zero else []),
    ]


def _limits(solution: Solution) -> list[Row]:
    limits, least = solution.chain.board.limits, solution.task.limits.min_curvature_radius
    if "pressure_angle" not in solution.drawn:
        return [(say("permitted radius of curvature"), _mm(least or 0), LIMIT)]
    back = degrees(limits.return_) if limits.return_ else say("force closure")
    return [
        (say("permitted angle, rise"), degrees(limits.rise), LIMIT),
        (say("permitted angle, return"), back, LIMIT),
    ]


def phases(solution: Solution) -> Table:
    """The phases of the motion; an arm's lift is an angle."""
    motion, swings = solution.cam.motion, solution.chain.board.follower.unit == "rad"
    rows = tuple(
        (phase_title(motion, k), degrees(phase.angle), _lift(phase.lift, swings=swings), law_title(motion, k))
        for k, phase in enumerate(motion.phases)
    )
    lift = say("lift") if swings else say("lift, mm")
    return Table(say("Motion"), (say("phase"), say("angle"), lift, say("law")), rows)


def _lift(lift: float, *, swings: bool) -> Words:
    """The lift of a phase, nothing for a dwell."""
    if not lift:
        return ""
    return degrees(lift) if swings else say("{lift:g}", lift=lift)


def phases_at_speed(solution: Solution) -> Table:
    """The phases; with a speed their times and greatest velocity and acceleration."""
    table, speed = phases(solution), solution.comparison.phases(solution.task.speed_rpm)
    if not speed:
        return table
    rows = tuple(
        (*row, number(p.time, 4), *(say("{x:.4g}", x=x) if x else "" for x in (p.max_velocity, p.max_acceleration)))
        for row, p in zip(table.rows, speed, strict=True)
    )
    header = (*table.header, *AT_SPEED[solution.chain.board.follower.unit])
    found = frozenset((row, column) for row in range(len(rows)) for column in range(len(table.header), len(header)))
    return Table(say("Motion, greatest v and a"), header, rows, found)


def law_title(motion: Motion, k: int) -> Words:
    """The name of a phase's law, with the ratio of its two parts where they are unequal; nothing for a dwell."""
    phase = motion.phases[k]
    if isinstance(phase, Dwell):
        return ""
    law = phase.normalised
    name = law_name(law)
    return say("{law}, ratio {ratio:g}", law=name, ratio=law.ratio) if law.ratio != 1 else name


def comparison(quantities: Mapping[str, Quantity]) -> Table:
    """Every quantity, drawn and exact, with its error and the bound in mm of paper."""
    rows = tuple(
        (
            sequence([q.title, unit(q.unit)]), number(q.drawn, 3), number(q.exact, 3),
            number(q.error_paper, 3, sign=True), number(q.tolerance_paper, 3),
        )
        for q in quantities.values()
        if math.isfinite(q.drawn) or math.isfinite(q.exact)  # else there is no such thing on this follower
    )  # fmt: skip
    header = (say("quantity"), say("drawn"), say("exact"), say("error, mm of paper"), say("bound"))
    found = frozenset((row, column) for row in range(len(rows)) for column in range(1, len(header)))
    return Table(say("Drawn and exact"), header, rows, found)
