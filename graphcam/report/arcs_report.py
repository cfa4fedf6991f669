"""The sheet and the note of a cam of three circular arcs."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from graphcam.comparison.arc_quantities import OF_ARCS
from graphcam.comparison.speed import PER_SPEED
from graphcam.constructions.axes import turning
from graphcam.drafting.ink import Caption, say
from graphcam.drafting.scale import ratio_text
from graphcam.drafting.units import unit
from graphcam.given.three_arcs import Point
from graphcam.report.contents import Contents
from graphcam.report.markdown import blocks, number, table
from graphcam.report.note import against_exact, drawn_how, heading, markdown_table, told_jumps, whole_note
from graphcam.report.note_tables import SIDES
from graphcam.report.sheet_contents import title_block
from graphcam.report.sheet_data import ADOPTED, GIVEN, Row, comparison
from graphcam.sheets.formats import Format
from graphcam.sheets.tables import Table
from graphcam.solving.arcs_solution import ArcsSolution

CASES = {
    1: say("both centres C1 and C2 are given"),
    2: say("C1 is given, and C2 is found on the line OA"),
    3: say("C2 is given, and C1 is found on the line OD"),
    4: say("C1 is found on the line OD and C2 on the line OA"),
}
TITLES = {
    "three_arcs": say("The arcs"),
    "arc_roller": say("The roller on the arcs"),
    "arc_diagrams": say("Motion of the follower"),
}
IMPACT = say(
    "The arcs touch, so the velocity is continuous, and the acceleration jumps where one arc takes over from another: "
    "the impact is soft."
)
DRAWN = say("drawn")
RADII = (("ρ₂", "rho2"), ("ρ₃", "rho3"))


def arcs_contents(solution: ArcsSolution) -> Contents:
    """What stands on its sheets: the arcs, the roller on them, the diagrams, the data, drawn against exact values."""
    drawing, titles = solution.task.drawing, _titles(solution)
    steps = tuple(
        (name, replace(step, view=replace(step.view, title=titles.get(step.view.name, step.view.title))))
        for name, construction in solution.drawn.items()
        for step in construction.steps()
    )
    # In two tables, so that they fit on the smallest format.
    quantities = solution.comparison.quantities
    of_arcs = {name: q for name, q in quantities.items() if name in OF_ARCS}
    of_motion = {name: q for name, q in quantities.items() if name not in OF_ARCS}
    return Contents(
        steps=steps,
        givens=(_data(solution),),
        results=(comparison(of_arcs), comparison(of_motion)),
        notes=(),
        title=title_block(solution.task.title, solution.chain.board.mu_l, drawing.tell),
        sheet=Format(drawing.format, drawing.frame, drawing.orientation),
        tell=drawing.tell,
    )


def _titles(solution: ArcsSolution) -> dict[str, Caption]:
    """The views' titles with their scales."""
    board, diagrams = solution.chain.board, solution.drawn["arc_diagrams"]
    ratio = ratio_text(board.mu_l.per_mm)

    def scale(name: str) -> dict[str, object]:
        return {"mu": float(np.ravel(diagrams.readings[name].scale)[0]), "unit": unit(diagrams.readings[name].unit)}

    return {
        "arcs": say("Three arcs, {ratio}", ratio=ratio),
        "roller": say("The roller on the arcs, {ratio}", ratio=ratio),
        "acceleration": say("Acceleration a, μₐ = {mu:.4g} ({unit})/mm", **scale("max_a")),
        "velocity": say("Velocity v, μᵥ = {mu:.4g} ({unit})/mm", **scale("max_v")),
        "displacement": say("Displacement s, μₛ = {mu:.4g} {unit}/mm", **scale("lift")),
        "angle": say("Pressure angle α, μ = {mu:g}°/mm", mu=math.degrees(board.mu_phi.per_mm)),
    }


def _xy(point: Point) -> Caption:
    return say("({x}, {y}) mm", x=number(point[0], 3), y=number(point[1], 3))


def _data(solution: ArcsSolution) -> Table:
    """What is given, and what was drawn."""
    given, task, arcs = solution.task.arcs(), solution.task, solution.drawn["three_arcs"]
    points = [(name, getattr(given, name)) for name in ("A", "D", "G", "C1", "C2")]
    found = [name for name, point in points if point is None and name != "A"] + ["C3", "F"]
    drawn = {name: (float(arcs.value(f"{name}_x")), float(arcs.value(f"{name}_y"))) for name in found}
    rows: list[Row] = [
        *((name, _xy(point), GIVEN) for name, point in points if point is not None),
        ("ρ₁", say("{length:g} mm", length=given.rho1), GIVEN),
        *((name, _xy(point), DRAWN) for name, point in drawn.items()),
        *((name, say("{length:.3f} mm", length=float(arcs.value(key))), DRAWN) for name, key in RADII),
        (say("upper dwell"), say("{angle:g}°", angle=task.arcs.dwell), GIVEN),
        (say("roller radius"), say("{length:g} mm", length=task.follower.roller_radius), GIVEN),
        (say("rotation"), turning(solution.rotation), ADOPTED),
        *_at_speed(solution),
    ]
    found = frozenset((row, 1) for row, (_, _, by) in enumerate(rows) if by == DRAWN)
    return Table(say("Data"), (say("quantity"), say("value"), ""), tuple(rows), found)


def _at_speed(solution: ArcsSolution) -> list[Row]:
    """The speed, and the greatest velocity and acceleration at it."""
    rpm = solution.task.speed_rpm
    if rpm is None:
        return []
    omega, tops = rpm * 2 * math.pi / 60, solution.drawn["arc_diagrams"]
    v, a = (float(tops.value(f"max_{name}")) * omega**k / PER_SPEED["mm"] for k, name in ((1, "v"), (2, "a")))
    return [
        (say("speed"), say("{rpm:g} rpm", rpm=rpm), GIVEN),
        (say("v max"), say("{v:.4g} m/s", v=v), DRAWN),
        (say("a max"), say("{a:.4g} m/s²", a=a), DRAWN),
    ]


def arcs_note(solution: ArcsSolution) -> str:
    """The note in Markdown.

    >>> from graphcam.solving.arcs_solution import solve_arcs
    >>> from graphcam.tasks.task_file import builtin_arcs_task
    >>> "C1, F, C3 instead of F, C1, C3" in arcs_note(solve_arcs(builtin_arcs_task()))
    True
    """
    case, tell = solution.task.arcs().design_case, solution.tell
    head = blocks(
        heading(solution.task.title, tell),
        tell(
            say(
                "The flank of a disk cam is to consist of three circular arcs: AG about C2, GF about C3 and FD about "
                "C1. It is the design case {case} of Lanni, Ceccarelli and Figliolini (2002): {told}. The cam moves a "
                "central translating follower; the return is the mirror image of the rise.",
                case=case, told=CASES[case],
            )
        ),
        markdown_table(_data(solution), tell),
        tell(drawn_how(solution.chain.pencil)),
    )  # fmt: skip
    jumps = told_jumps(solution.motion.jumps, "a", "mm/rad²", tell)
    chapters = [
        *((TITLES[name], " ".join(tell(s.caption) for s in c.steps())) for name, c in solution.drawn.items()),
        (say("Both roots"), _roots(solution)),
        (say("Kind of impact"), f"{tell(IMPACT)} {jumps}"),
        (say("Values at the stations"), _stations(solution)),
        (say("Drawn against exact"), against_exact(solution)),
    ]
    return whole_note(head, chapters, solution)


def _roots(solution: ArcsSolution) -> str:
    """Both roots, exactly, and why one of them is taken."""
    tell, (first, second) = solution.tell, solution.roots
    rows = [
        (name, _xy(root.C3.tolist()), _xy(root.F.tolist()), say("{length} mm", length=number(root.rho3, 3)),
         say("yes") if root.sound else say("no"))
        for name, root in ((say("first"), first), (say("second"), second))
    ]  # fmt: skip
    return blocks(
        tell(say("Two circles about points of the line G C2 touch the circle about C1. Exactly they are these.")),
        table((say("root"), "C3", "F", "ρ₃", say("sound")), rows, tell),
        tell(say("- The first root: {why}", why=first.reason)) + "\n"
        + tell(say("- The second root: {why}", why=second.reason)),
    )  # fmt: skip


def _stations(solution: ArcsSolution) -> str:
    phi, (s, v, a, _), alpha, _ = solution.comparison.exact_stations
    drawn, stations = solution.comparison.drawn_stations, solution.chain.stations
    columns = [("s", drawn["s"], s), ("v", drawn["v"], v), ("a", drawn["a"], a),
               ("α", np.degrees(drawn["alpha"]), np.degrees(alpha))]  # fmt: skip
    header = [say("station"), "φ", *(replace(side, values={"name": name}) for name, *_ in columns for side in SIDES)]
    rows = [
        [name, number(math.degrees(phi[k]))]
        + [cell for _, d, e in columns for cell in (number(float(d[k]), 3), number(float(e[k]), 4))]
        for k, name in enumerate(stations.names)
    ]
    said = say(
        "Displacement s in mm, velocity v in mm/rad, acceleration a in mm/rad² and pressure angle α in degrees on the "
        "rise. Where two arcs meet, the station stands twice, once for each."
    )
    return solution.tell(said) + "\n\n" + table(header, rows, solution.tell)
