"""The long tables of the note."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from graphcam.comparison.quantities import Quantity
from graphcam.constructions.axes import station_names
from graphcam.drafting.units import unit
from graphcam.given.laws import Floats
from graphcam.report.markdown import number, table
from graphcam.report.paragraphs import digits, scale_of
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Tell, say

SIDES = (say("{name} drawn"), say("{name} exact"))
EXACT_DIGITS = 4
"""Decimals of an exact value, at least."""


def at_stations(solution: Solution) -> str:
    """s, v, a and the pressure angle at the stations, drawn and exact."""
    compared, stations, integrated = solution.comparison, solution.chain.board.stations, solution.drawn["integration"]
    drawn, exact = compared.drawn_stations, compared.exact_stations
    s, v, a, _ = exact.values
    columns = [
        ("s", drawn["s"], s, digits(scale_of(integrated, "s"))),
        ("v", drawn["v"], v, digits(scale_of(integrated, "v"))),
        ("a", drawn["a"], a, digits(scale_of(integrated, "a"))),
        ("α", np.degrees(drawn["alpha"]), np.degrees(exact.pressure_angle), 2),
    ]
    header = [say("station"), "φ", *(replace(side, values={"name": name}) for name, *_ in columns for side in SIDES)]
    rows = [
        [name, number(math.degrees(phi))]
        + [cell for _, d, e, decimals in columns for cell in _pair(float(d[k]), float(e[k]), decimals)]
        for k, (name, phi) in enumerate(zip(station_names(stations), stations.phi, strict=True))
    ]
    return table(header, rows, solution.tell)


def _pair(drawn: float, exact: float, decimals: int) -> tuple[Caption, Caption]:
    return number(drawn, decimals), number(exact, max(EXACT_DIGITS, decimals + 1))


def polar_coordinates(solution: Solution) -> str:
    """The polar coordinates of the pitch curve and of the working profile at the stations, drawn."""
    stations, pitch, profile = (
        solution.chain.board.stations, solution.drawn["inversion"], solution.drawn["working_profile"],
    )  # fmt: skip
    touch: Floats = np.angle(profile.first("touch"))
    columns = [
        pitch.value("radius"),
        np.degrees(pitch.value("polar_angle")),
        profile.value("radius"),
        np.degrees(touch),
    ]
    rows = [
        [name, number(math.degrees(phi)), *(number(float(column[k])) for column in columns)]
        for k, (name, phi) in enumerate(zip(station_names(stations), stations.phi, strict=True))
    ]
    header = [
        say("station"), "φ", say("R pitch curve"), say("θ pitch curve"), say("R profile"), say("θ profile"),
    ]  # fmt: skip
    return table(header, rows, solution.tell)


def compared(quantities: Mapping[str, Quantity], tell: Tell) -> str:
    """Every quantity drawn and exact, its error in machine units and in mm of paper, and the bound."""
    rows = [
        (
            q.title, unit(q.unit), number(q.drawn, 3), number(q.exact, EXACT_DIGITS),
            number(q.error, EXACT_DIGITS, sign=True), number(q.error_paper, 3, sign=True), number(q.tolerance_paper, 3),
        )
        for q in quantities.values()
        if math.isfinite(q.drawn) or math.isfinite(q.exact)  # else there is no such thing on this follower
    ]  # fmt: skip
    header = (
        say("quantity"), say("unit"), say("drawn"), say("exact"), say("error"), say("error, mm of paper"),
        say("bound, mm of paper"),
    )  # fmt: skip
    return table(header, rows, tell)
