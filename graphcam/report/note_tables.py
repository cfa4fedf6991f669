"""The note's chapters of long tables."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from graphcam.comparison.bounds import ErrorBudget, Shares
from graphcam.comparison.quantities import Quantity, transmission_deg
from graphcam.constructions.arc_chain import ArcChain
from graphcam.constructions.axes import sense_caption, station_names
from graphcam.constructions.chain import Chain
from graphcam.drafting.acts import Kind
from graphcam.drafting.ink import Construction
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import unit
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.report.markdown import Block, Grid, digits, number, numbers
from graphcam.report.sheet_data import paper_errors
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Words, say
from graphcam.workshop.part_outline import of_cam
from graphcam.workshop.polar_table import PolarCurve

SIDE_HEADINGS = (say("{name} drawn"), say("{name} exact"))
EXACT_DIGITS = 4
"""The minimum number of decimals of an exact value."""
ROUND_DIGITS = 3
"""Decimals of a radius of the exact profile [mm]."""
STATION_TABLE_NOTE = say(
    "Displacement s in {s}, velocity v in {v}, acceleration a in {a}, pressure angle α and transmission angle γ = "
    "90° − |α| in degrees, drawn and exact. The acceleration at both ends of a phase is the one inside the phase."
)
STATION_TABLE_NOTE_ARM = say(
    "Displacement s in degrees, velocity v in {v}, acceleration a in {a}, pressure angle α and transmission angle γ = "
    "90° − |α| in degrees, drawn and exact. The acceleration at both ends of a phase is the one inside the phase."
)
STATION_TABLE_NOTE_FACE = say(
    "Displacement s in {s}, velocity v in {v} and acceleration a in {a}, drawn and exact. The acceleration at both "
    "ends of a phase is the one inside the phase."
)
"""The legend of the table of stations."""
Column = tuple[str, Floats, Floats, int]
"""A quantity at the stations: its symbol, drawn and exact values, and the decimals of the drawn ones."""


def at_stations(solution: Solution) -> list[Block]:
    """The table of s, v, a, pressure angle and transmission angle at the stations, drawn and exact; an arm's s in °."""
    of_lift, swings = solution.chain.board.follower.unit, solution.chain.board.follower.unit == "rad"
    units = {name: unit(of_lift + per) for name, per in (("s", ""), ("v", "/rad"), ("a", "/rad²"))}
    compared, stations, integrated = solution.comparison, solution.chain.board.stations, solution.drawn["integration"]
    drawn, exact = compared.drawn_stations, compared.exact_stations
    columns = [
        (name, drawn[name], values, digits(integrated.readings[name].per_mm))
        for name, values in zip(("s", "v", "a"), exact.values, strict=False)
    ]
    if swings:
        columns[0] = ("s", np.degrees(drawn["s"]), np.degrees(exact.values[0]), 3)
    said = (
        STATION_TABLE_NOTE_FACE
        if "pressure_angle" not in solution.drawn
        else STATION_TABLE_NOTE_ARM
        if swings
        else STATION_TABLE_NOTE
    )
    if "pressure_angle" in solution.drawn:
        columns.append(("α", np.degrees(drawn["alpha"]), np.degrees(exact.pressure_angle), 2))
        columns.append(("γ", transmission_deg(drawn["alpha"]), transmission_deg(exact.pressure_angle), 2))
    return [said.with_values(**units), station_table(station_names(stations), stations.phi, columns)]


def station_table(names: Sequence[str], phi: Floats, columns: Sequence[Column]) -> Grid:
    """The table of the stations: cam angles [rad], and drawn and exact values at them."""
    header = [
        say("station"),
        "φ",
        *(replace(side, values={"name": name}) for name, *_ in columns for side in SIDE_HEADINGS),
    ]
    told = [
        [number(float(value), places) for value in values]
        for _, drawn, exact, decimals in columns
        for values, places in ((drawn, decimals), (exact, max(EXACT_DIGITS, decimals + 1)))
    ]
    rows = zip(names, map(number, np.degrees(phi).tolist()), *told, strict=True)
    return Grid(say("Values at the stations"), header, rows)


def polar_coordinates(solution: Solution) -> list[Block]:
    """The tables of polar coordinates of the drawn pitch curve and working profile at the stations.

    Under a flat face they are one curve.  Where the task asks for a table of the profile, that follows, exact.
    """
    stations, pitch = solution.chain.board.stations, solution.drawn["inversion"]
    profile = solution.drawn["working_profile"]
    phi, theta, touch = map(np.degrees, (stations.phi, pitch.value("polar_angle"), np.angle(profile.first("touch"))))
    columns, header = (pitch.value("radius"), theta), (say("R pitch curve"), say("θ pitch curve"))
    if "pressure_angle" not in solution.drawn:
        columns, header = (), ()
    columns = (phi, *columns, profile.value("radius"), touch)
    rows = zip(station_names(stations), *(map(number, column.tolist()) for column in columns), strict=True)
    header = (say("station"), "φ", *header, say("R profile"), say("θ profile"))
    said = say(
        "Radius R in mm and angle θ in degrees, from the cam centre, as drawn. θ is counted anticlockwise from "
        "the horizontal, on the cam as it stands at φ = 0. A dash marks a station where no point of the profile "
        "is left."
    )
    return [said, Grid(say("Polar coordinates"), header, rows), *_at_round_angles(solution)]


def _at_round_angles(solution: Solution) -> list[Block]:
    """The table of the exact profile in the steps of the task's table ``[part]``; none without one."""
    if solution.task.part is None:
        return []
    step = solution.task.part.table_step
    angles = np.arange(0.0, 360.0, step)
    try:
        outline = of_cam(solution.cam)
        radii = PolarCurve(outline).radius(np.radians(angles))
    except DesignError:  # a warning of the solution says what is wrong with the profile
        return []
    said = say(
        "The exact working profile every {step}° of the polar angle ϑ, counted {turning} on the cam from the direction "
        "in which the follower meets it at φ = 0 (θ = {zero}°):",
        step=step,
        turning=sense_caption("ccw" if outline.sense > 0 else "cw"),
        zero=number(math.degrees(outline.zero)),
    )
    rows = zip((f"{angle:g}°" for angle in angles), (number(r, ROUND_DIGITS) for r in radii.tolist()), strict=True)
    return [said, Grid(say("The exact working profile"), ("ϑ", say("R profile")), rows)]


def comparison_table(quantities: Mapping[str, Quantity]) -> Grid:
    """The table of every quantity: drawn, exact, its error in machine units and mm of paper, and known bounds."""
    there = [q for q in quantities.values() if q.exists]
    rows = [(q.title, unit(q.unit), number(q.drawn, 3), *_exact_captions(q), *paper_errors(q)) for q in there]
    header = (say("quantity"), say("unit"), say("drawn"), say("exact"), say("error"))
    header += say("error, mm of paper"), say("estimated bound, mm of paper")
    if any(math.isfinite(q.proved_paper) for q in there):
        header += (say("proved bound, mm of paper"),)
        rows = [(*row, number(q.proved_paper, 3)) for row, q in zip(rows, there, strict=True)]
    return Grid(say("Drawn against exact"), header, rows)


def _exact_captions(q: Quantity) -> tuple[Caption, Caption]:
    return number(q.exact, EXACT_DIGITS), number(q.error, EXACT_DIGITS, sign=True)


SHARE_SOURCES: Mapping[Kind | None, Caption] = {
    Kind.DIVIDE: say("divisions"),
    Kind.ERECT: say("verticals"),
    Kind.PROJECT: say("projections"),
    Kind.LAY_OFF: say("lengths laid off"),
    Kind.PARALLEL: say("parallels"),
    Kind.PERPENDICULAR: say("perpendiculars"),
    Kind.TANGENT: say("tangents"),
    Kind.BISECT: say("bisectors"),
    Kind.CIRCLE: say("circles"),
    Kind.PROTRACTOR: say("protractor"),
    Kind.READ: say("readings"),
    None: say("together"),
}
"""Column headings of the shares: the acts of a kind; None is those of several kinds together."""
NEGLIGIBLE_SHARE = 0.005
"""The share below which none is shown."""


def budget_table(drawn: Chain | ArcChain, pencil: Pencil) -> tuple[tuple[Words, ...], list[tuple[Words, ...]]]:
    """Header and rows of a table: for every reading its scatter and bias, then the shares of kinds of acts in percent.

    >>> import graphcam as gc
    >>> header, rows = budget_table(gc.solve(gc.builtin_arcs_task()).chain, gc.Pencil.of(0.2))
    >>> [str(cell) for cell in header][:4], str(rows[0][1])
    (['reading', 'scatter', 'bias', 'verticals'], '0.32 mm')
    """
    budget = ErrorBudget(drawn, pencil)
    told = [
        (construction, reading, budget.of(construction.name, reading))
        for construction in drawn.values()
        for reading in construction.meaning.readings
    ]
    kinds = [kind for kind in SHARE_SOURCES if any(_share(shares, kind) >= NEGLIGIBLE_SHARE for *_, shares in told)]
    header = (say("reading"), say("scatter"), say("bias"), *(SHARE_SOURCES[kind] for kind in kinds))
    return header, [
        (
            say("{construction}: {reading}", construction=c.meaning.title, reading=c.meaning.reading(reading).title),
            _scatter(c, reading, shares.deviation),
            _scatter(c, reading, shares.bias),
            *(number(100 * share, 0) if (share := _share(shares, kind)) >= NEGLIGIBLE_SHARE else "" for kind in kinds),
        )
        for c, reading, shares in told
        if shares.deviation > 0
    ]


def _share(shares: Shares, kind: Kind | None) -> float:
    return shares.together if kind is None else shares.of.get(kind, 0.0)


def _scatter(construction: Construction, reading: str, deviation: float) -> Caption:
    """The standard deviation of a reading, as a length on paper or as the measured angle."""
    read = construction.readings[reading]
    if read.unit == "rad" and read.per_mm == 1:
        return say("{angle:.2f}°", angle=np.degrees(deviation))
    return say("{length} mm", **numbers(length=deviation))
