"""The sheet and the note of a cam of three circular arcs."""

from collections.abc import Sequence

import numpy as np

from graphcam.comparison.quantities import UNITS_PER_SPEED
from graphcam.constructions.axes import sense_caption
from graphcam.given.follower import omega_of
from graphcam.given.laws import Floats
from graphcam.mechanism.three_arc_cam import ThreeArcCam
from graphcam.report.markdown import Block, Grid, number
from graphcam.report.note import (
    against_exact,
    constructions,
    errors_of_the_hand,
    hand_description,
    heading,
    jumps_sentence,
    of_sheet,
    whole_note,
)
from graphcam.report.note_tables import station_table
from graphcam.report.sheet_contents import Contents, scaled_steps, title_block
from graphcam.report.sheet_data import ADOPTED_LABEL, GIVEN_LABEL, Row, comparison, data_table, mm, speed
from graphcam.sheets.tables import Table
from graphcam.solving.arcs_solution import ArcsSolution
from graphcam.subscripts import indexed
from graphcam.words import Caption, Words, say, sequence

CASE_CAPTIONS = {
    1: say("both centres C₁ and C₂ are given"),
    2: say("C₁ is given, and C₂ is found on the line OA"),
    3: say("C₂ is given, and C₁ is found on the line OD"),
    4: say("C₁ is found on the line OD and C₂ on the line OA"),
}
IMPACT_NOTE = say(
    "The arcs touch, so the velocity is continuous, and the acceleration jumps where one arc meets the next: the "
    "impact is soft."
)
DRAWN_LABEL = say("drawn")
ARC_SIZES_TITLE, MOTION_TITLE = say("Sizes of the arcs: drawn and exact"), say("Motion: drawn and exact")


def arcs_contents(solution: ArcsSolution) -> Contents:
    """The contents of its sheets: the arcs, the roller on them, the diagrams, the data, drawn against exact values."""
    quantities = solution.comparison.quantities
    # In two tables, so that they fit on the smallest format.
    on_arcs = {said.name for _, said in solution.drawn["three_arcs"].meaning.compared_readings}
    of_arcs = {name: q for name, q in quantities.items() if name in on_arcs}
    of_motion = {name: q for name, q in quantities.items() if name not in on_arcs}
    results = comparison(of_arcs, ARC_SIZES_TITLE), comparison(of_motion, MOTION_TITLE)
    title = title_block(solution.task.title, solution.tell, solution.task.drawing.remark)
    return Contents(solution, title, solution.drawn, scaled_steps(solution.drawn), (_data(solution),), results)


def _xy(point: Sequence[float] | Floats) -> Caption:
    return say("({x}, {y}) mm", x=number(point[0], 3), y=number(point[1], 3))


def _radius(length: float) -> Caption:
    return say("{length} mm", length=number(length, 3))


def _data(solution: ArcsSolution) -> Table:
    given, task, arcs = solution.task.arcs(), solution.task, solution.drawn["three_arcs"]
    points = {name: getattr(given, name) for name in ("A", "D", "G", "C1", "C2")}
    found = [name for name, point in points.items() if point is None and name != "A"] + ["C3", "F"]
    rows: list[Row] = [
        *((indexed(name), _xy(point), GIVEN_LABEL) for name, point in points.items() if point is not None),
        ("ρ₁", mm(given.rho1), GIVEN_LABEL),
        *((indexed(name), _xy([float(arcs.value(f"{name}_{axis}")) for axis in "xy"]), DRAWN_LABEL) for name in found),
        *((name, _radius(float(arcs.value(key))), DRAWN_LABEL) for name, key in (("ρ₂", "rho2"), ("ρ₃", "rho3"))),
        (say("upper dwell"), say("{angle:g}°", angle=task.arcs.dwell), GIVEN_LABEL),
        (say("roller radius"), mm(task.follower.roller_radius), GIVEN_LABEL),
        (say("rotation"), sense_caption(solution.rotation), ADOPTED_LABEL),
        *_at_speed(solution),
    ]
    return data_table(task, rows, (DRAWN_LABEL,))


def _at_speed(solution: ArcsSolution) -> list[Row]:
    """Rows of the data: the speed, and the maximum velocity and acceleration at it."""
    rpm = solution.task.speed_rpm
    if rpm is None:
        return []
    omega, tops = omega_of(rpm), solution.drawn["arc_diagrams"]
    v, a = (float(tops.value(f"max_{name}")) * omega**k / UNITS_PER_SPEED["mm"] for k, name in ((1, "v"), (2, "a")))
    return [
        *speed(rpm),
        (say("v max"), say("{v:.4g} m/s", v=v), DRAWN_LABEL),
        (say("a max"), say("{a:.4g} m/s²", a=a), DRAWN_LABEL),
    ]


def arcs_note(solution: ArcsSolution) -> str:
    """The note of a cam of arcs, in Markdown.

    >>> import graphcam as gc
    >>> "C₁, F, C₃ instead of F, C₁, C₃" in arcs_note(gc.solve(gc.builtin_arcs_task()))
    True
    """
    case = solution.task.arcs().design_case
    designed = say(
        "The flank of a disk cam is to consist of three circular arcs: AG about C₂, GF about C₃ and FD about C₁. It is "
        "the design case {case} of Lanni, Ceccarelli and Figliolini (2002): {told}. The cam moves a central "
        "translating follower; the return is the mirror image of the rise.",
        case=case,
        told=CASE_CAPTIONS[case],
    )
    paper = heading(solution.task.title, solution.task.drawing)
    head = [*paper, designed, of_sheet(_data(solution)), hand_description(solution.chain.pencil)]
    chapters = [
        *constructions(solution),
        (say("Both roots"), _roots(solution)),
        (say("Kind of impact"), [IMPACT_NOTE, jumps_sentence(solution.motion.jumps, "a", "mm/rad²")]),
        (say("Values at the stations"), _stations(solution)),
        (say("Drawn against exact"), against_exact(solution)),
        *errors_of_the_hand(solution),
    ]
    return whole_note(head, chapters, solution)


def _roots(solution: ArcsSolution) -> list[Block]:
    """The paragraphs on both roots, exactly, and on the reason for taking one of them."""
    first, second = solution.roots
    rows = [_root(say("first"), first), _root(say("second"), second)]
    why = say("- The first root: {why}", why=first.reason), say("- The second root: {why}", why=second.reason)
    return [
        say("Two circles about points of the line G C₂ touch the circle about C₁."),
        Grid(say("Both roots, exactly"), (say("root"), "C₃", "F", "ρ₃", say("valid")), rows),
        sequence(why, "\n"),
    ]


def _root(name: Caption, root: ThreeArcCam) -> tuple[Words, ...]:
    return name, _xy(root.C3), _xy(root.F), _radius(root.rho3), say("yes") if root.sound else say("no")


def _stations(solution: ArcsSolution) -> list[Block]:
    phi, values, alpha, _ = solution.comparison.exact_stations
    drawn = solution.comparison.drawn_stations
    columns = [(name, drawn[name], exact, 3) for name, exact in zip("sva", values, strict=False)]
    columns.append(("α", np.degrees(drawn["alpha"]), np.degrees(alpha), 3))
    said = say(
        "Displacement s in mm, velocity v in mm/rad, acceleration a in mm/rad² and pressure angle α in degrees "
        "on the rise. Where two arcs meet, the station is listed twice, once for each arc."
    )
    return [said, station_table(solution.chain.stations.names, phi, columns)]
