"""The tables that both the sheet and the note have."""

import math
from collections.abc import Mapping, Sequence
from itertools import product

from graphcam.comparison.quantities import Quantity
from graphcam.constructions.axes import degrees, phase_title, sense_caption
from graphcam.constructions.law_names import LAW_TITLES, law_title
from graphcam.drafting.scale import printed_unit, unit
from graphcam.given.arc_loop import ArcLoop
from graphcam.given.boundary_motion import BoundaryMotion
from graphcam.given.boundary_parts import DERIVATIVE_NAMES
from graphcam.given.measured import MeasuredMotion
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.given.outline_motion import OutlineMotion
from graphcam.given.point_outline import TracedMotion
from graphcam.report.markdown import digits, number
from graphcam.sheets.tables import Table
from graphcam.solving.adopted_sizes import FaceDesign
from graphcam.solving.solution import Solution
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.units import UNITS, numbers_in_units
from graphcam.words import Caption, Words, say, sequence

Row = tuple[Words, Words, Words]
"""Name, value and origin of a quantity."""
DRAWN_AND_EXACT_TITLE = say("Drawn and exact")
GIVEN_LABEL, ADOPTED_LABEL, LIMIT_LABEL = say("given"), say("adopted"), say("limit")
FOUND_LABEL = say("found")
SPEED_HEADINGS: Mapping[str, tuple[Caption, ...]] = {
    "mm": (say("t, s"), say("v, m/s"), say("a, m/s²")),
    "rad": (say("t, s"), say("v, rad/s"), say("a, rad/s²")),
}
"""Headings for a phase at a speed, by the unit of the lift: its time, and the maxima of v and a."""


HAND_READING = 10
"""A hand reads the paper so much coarser than the finest scale shows: to 0.1 mm."""
MAX_SHEET_ROWS = 16
"""The maximum number of rows of a table on the sheet; a longer one stands in the note only."""
TITLE_IN_MM, TITLE_IN_DEGREES = (
    say("Conditions of the motion, mm and rad"),
    say("Conditions of the motion, degrees and rad"),
)


def conditions(solution: Solution) -> Table | None:
    """The table of the points of all parts, in the units of the task; None where the motion has another source.

    >>> import graphcam as gc
    >>> conditions(gc.solve(gc.builtin_task())) is None
    True
    """
    motion, tables = solution.chain.board.motion, solution.task.motion.parts
    if not isinstance(motion, BoundaryMotion) or tables is None:
        return None
    points = [point for table in tables for point in table.points]
    asked = [name for name in DERIVATIVE_NAMES if any(getattr(point, name) is not None for point in points)]
    rows: list[tuple[Words, ...]] = []
    for table, part in zip(tables, motion.parts, strict=True):
        named: Words = say("{name}, degree {degree}", name=LAW_TITLES[part.name], degree=part.highest_power)
        for point in table.points:
            given = (getattr(point, name) for name in asked)
            values = ("" if x is None else say("{x:g}", x=x) for x in given)
            rows.append((named, say("{angle:g}°", angle=point.angle), *values))
            named = ""
    swings = solution.task.follower.column == "s_deg"
    return Table(TITLE_IN_DEGREES if swings else TITLE_IN_MM, (say("part of the motion"), "φ", *asked), tuple(rows))


def conditions_on_sheet(solution: Solution) -> tuple[Table, ...]:
    """The table of conditions if the sheet has room for it, else nothing."""
    table = conditions(solution)
    return () if table is None or len(table.rows) > MAX_SHEET_ROWS else (table,)


def sizes(solution: Solution) -> list[Row]:
    """Rows of the sizes of the cam that is built: name, value, and whether it was given or adopted."""
    cam, board = solution.cam, solution.chain.board
    follower, prime_radius = board.follower, mm(cam.prime_radius)
    asked = {follower.place_name: follower.place, "roller_radius": board.roller_radius}
    return [
        (say("prime radius r₀"), prime_radius, _limit_origin(board.prime_radius)),
        *(
            (size.title, mm(size.value + 0.0), _limit_origin(asked.get(size.name, size.value)))
            for size in follower.sizes(solution.chain.place, cam.roller_radius)
            if size.value is not None
        ),
        *_face(solution.face),
    ]


def _face(face: FaceDesign | None) -> list[Row]:
    """Rows of the face that is built, and of the margin that the task asks for; none without a face."""
    if face is None:
        return []
    (left, right), whole = face.adopted, sum(face.adopted)
    return [
        (say("face margin on each side"), mm(face.margin), GIVEN_LABEL),
        (say("face, left + right"), say("{left:g} + {right:g} mm", left=left, right=right), ADOPTED_LABEL),
        (say("width of the face"), mm(whole), ADOPTED_LABEL),
    ]


def mm(length: float) -> Caption:
    """A length [mm] as it is given."""
    return say("{length:g} mm", length=length)


def _limit_origin(asked: float | None) -> Caption:
    return ADOPTED_LABEL if asked is None else GIVEN_LABEL


def data(solution: Solution) -> Table:
    """The table of the cam's data and their origin: given, adopted, or the usual limit."""
    task = solution.task
    rows: list[Row] = [
        (say("rotation"), sense_caption(task.rotation), GIVEN_LABEL),
        *speed(task.speed_rpm),
        *sizes(solution),
        *_limits(solution),
        *_measured(solution),
        *_by_conditions(solution),
        *_given_cam(solution),
        *_finer_phases(solution),
    ]
    return data_table(task, rows, (ADOPTED_LABEL, ""))


def speed(rpm: float | None) -> list[Row]:
    """The row of the speed; none where no speed is given."""
    return [(say("speed"), say("{rpm:g} rpm", rpm=rpm), GIVEN_LABEL)] if rpm else []


def data_table(task: Task | ArcsTask, rows: Sequence[Row], found: Sequence[Words]) -> Table:
    """The table of rows, and the units of the task's file; a worksheet leaves values empty that are by ``found``."""
    rows = [*rows, *_file_units(task)]
    answers = frozenset((row, 1) for row, (_, _, by) in enumerate(rows) if by in found)
    return Table(say("Data"), (say("quantity"), say("value"), ""), tuple(rows), answers)


def _file_units(task: Task | ArcsTask) -> list[Row]:
    """Rows on the units in which a task's file gives numbers, where they are others than graphcam's own."""
    used = dict.fromkeys((given.own, given.unit) for _, given in numbers_in_units(task) if given.own != given.unit)
    said = say("1 {unit} = {factor:.7g} {own}")
    values = [said.with_values(unit=printed_unit(n), own=printed_unit(own), factor=UNITS[own][n]) for own, n in used]
    return [("" if k else say("units in the task file"), value, GIVEN_LABEL) for k, value in enumerate(values)]


def _measured(solution: Solution) -> list[Row]:
    """Rows on a measured motion: its table, the maximum deviation from it, and the origin of its cam angle."""
    table, motion = solution.task.motion.table, solution.chain.board.motion
    if table is None or not isinstance(motion, MeasuredMotion):
        return []
    lift_unit = solution.task.motion.lift_unit
    swings = solution.chain.board.follower.unit == "rad"
    # To a tenth of the tolerance's last decimal: a smaller deviation is none.
    decimals = 1 + max(0, -math.floor(math.log10(motion.tolerance / lift_unit)))
    greatest, rms = (number(x / lift_unit, decimals) for x in (motion.max_residual, motion.rms_residual))
    said = say("at most {greatest}°, rms {rms}°") if swings else say("at most {greatest} mm, rms {rms} mm")
    what = say("points of the cam") if isinstance(motion, TracedMotion) else say("table of the motion")
    return [
        (what, table.file, GIVEN_LABEL),
        (say("tolerance"), degrees(motion.tolerance) if swings else mm(motion.tolerance), GIVEN_LABEL),
        (say("residual"), said.with_values(greatest=greatest, rms=rms), ""),
        *([(say("cam angle 0 of the table at"), degrees(-motion.zero), "")] if motion.zero else []),
    ]


def _by_conditions(solution: Solution) -> list[Row]:
    """Rows on the origins of cam angle and displacement of a motion by conditions, where these are not 0."""
    motion = solution.chain.board.motion
    if not isinstance(motion, BoundaryMotion):
        return []
    lowest = motion.lowest / solution.task.motion.lift_unit
    return [
        *([(say("cam angle 0 of the conditions at"), degrees(-motion.zero), "")] if motion.zero else []),
        *([(say("lowest s of the conditions"), say("{s:.6g}", s=lowest), "")] if motion.lowest else []),
    ]


def _given_cam(solution: Solution) -> list[Row]:
    """Rows on the radii of a given cam; the one that follows from the others is found."""
    motion, radii, table = solution.chain.board.motion, solution.task.motion.radii, solution.task.motion.table
    if not isinstance(motion, OutlineMotion):
        return []
    if isinstance(motion.outline, ArcLoop) or radii is None:
        radius = [abs(arc.radius) for arc in motion.outline.arcs()]
        lengths = sequence([mm(r) if math.isfinite(r) else say("straight") for r in radius], ", ")
        return [
            (say("points of the cam"), table.file if table else "", GIVEN_LABEL),
            (say("radii of its parts"), lengths, FOUND_LABEL),
            (say("cam angle 0 of the table at"), degrees(-motion.zero), ""),
        ]
    cam, given = motion.outline, vars(radii)
    base: Row = say("base radius"), mm(cam.base_radius), GIVEN_LABEL
    nose: Row = say("nose radius"), mm(cam.nose_radius), GIVEN_LABEL if given["nose_radius"] else FOUND_LABEL
    if cam.is_eccentric:
        return [base, (say("radius of the eccentric circle"), mm(cam.nose_radius), FOUND_LABEL)]
    flank = mm(cam.flank_radius) if cam.has_arcs else say("straight")
    ascent = GIVEN_LABEL if given["ascent"] else FOUND_LABEL
    return [
        base,
        (say("flank radius"), flank, GIVEN_LABEL if given["flank_radius"] else FOUND_LABEL),
        nose,
        (say("distance of the nose's centre"), mm(cam.nose_distance), FOUND_LABEL),
        (say("angle of ascent"), degrees(cam.ascent), ascent),
    ]


def _finer_phases(solution: Solution) -> list[Row]:
    """Rows on the phases that are divided into more parts, because their acceleration is short."""
    stations, motion = solution.chain.board.stations, solution.chain.board.motion
    parts = dict(zip(stations.phase[stations.last].tolist(), stations.parts, strict=True))
    counts = [(phase_title(motion, k), parts[k].stop - parts[k].start) for k in stations.finer]
    value = say("{n:d} parts, shorter where a changes")
    return [(say("divisions of {phase}", phase=phase), value.with_values(n=n), "") for phase, n in counts]


def _limits(solution: Solution) -> list[Row]:
    board, least, part = solution.chain.board, solution.task.limits.min_curvature_radius, solution.task.part
    limits, bores = board.limits, list[Row]()
    if part is not None and part.bore is not None and board.prime_radius is None:
        bores = [(say("bore"), mm(part.bore), GIVEN_LABEL)]
    if "pressure_angle" not in solution.drawn:
        return [(say("permitted radius of curvature"), mm(least or 0), LIMIT_LABEL), *bores]
    back = degrees(limits.return_) if limits.return_ else say("force closure")
    sharp = [] if least is None else [(say("permitted radius of curvature"), mm(least), LIMIT_LABEL)]
    return [
        (say("permitted angle, rise"), degrees(limits.rise), LIMIT_LABEL),
        (say("permitted angle, return"), back, LIMIT_LABEL),
        *sharp,
        *bores,
    ]


def phases(solution: Solution) -> Table:
    """The table of the phases of the motion; an arm's lift is an angle."""
    motion, swings = solution.cam.motion, solution.chain.board.follower.unit == "rad"
    lifts = [lift_words(motion, k) if not swings else degrees(phase.lift) for k, phase in enumerate(motion.phases)]
    begins = (motion.starts + motion.origin) % FULL_TURN
    rows = tuple(
        (
            *(phase_title(motion, k), *([degrees(begins[k])] if motion.origin else []), degrees(phase.angle)),
            *(lifts[k] if phase.lift else "", law_title(motion, k)),
        )
        for k, phase in enumerate(motion.phases)
    )
    # Where the table's cam angle 0 lies inside a phase, the diagrams begin elsewhere.
    from_ = [say("from, of the table")] if motion.origin else []
    lift = say("lift") if swings else say("lift, mm")
    return Table(say("Motion"), (say("phase"), *from_, say("angle"), lift, say("law")), rows)


def phases_at_speed(solution: Solution) -> Table:
    """The table of the phases, with a speed also their times, maximum velocities and accelerations."""
    table, at_speed = phases(solution), solution.comparison.phases(solution.task.speed_rpm)
    if not at_speed:
        return table
    rows = tuple(
        (*row, number(p.time, 4), *(say("{x:.4g}", x=x) if x else "" for x in p.greatest))
        for row, p in zip(table.rows, at_speed, strict=True)
    )
    header = (*table.header, *SPEED_HEADINGS[solution.chain.board.follower.unit])
    found = frozenset(product(range(len(rows)), range(len(table.header), len(header))))
    return Table(say("Motion, maximum v and a"), header, rows, found)


def lift_words(motion: Motion, k: int) -> Caption:
    """The lift of a phase [mm]: as it is given, or of a measured motion to a hundredth."""
    lift = motion.phases[k].lift
    return number(lift) if isinstance(motion, MeasuredMotion) else say("{lift:g}", lift=lift)


def paper_errors(q: Quantity) -> tuple[Caption, Caption]:
    """The error and the bound of a quantity [mm of paper]."""
    return number(q.error_paper, 3, sign=True), number(q.tolerance_paper, 3)


def comparison(quantities: Mapping[str, Quantity], title: Caption = DRAWN_AND_EXACT_TITLE) -> Table:
    """The table of every quantity, drawn and exact, with its error and its bound in mm of paper.

    All have as many decimals as can be read on the paper.
    """
    rows = tuple(
        (
            sequence([q.title, unit(q.unit)]),
            *(number(value, digits(HAND_READING * abs(q.per_mm))) for value in (q.drawn, q.exact)),
            *(number(q.error_paper, sign=True), number(q.tolerance_paper)),
        )
        for q in quantities.values()
        if q.exists
    )
    header = (say("quantity"), say("drawn"), say("exact"), say("error, mm of paper"), say("bound"))
    found = frozenset(product(range(len(rows)), range(1, len(header))))
    return Table(title, header, rows, found)
