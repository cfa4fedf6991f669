"""Hard cases: what is computed and drawn of each, beside 50-digit values, with the digits that are left.

The cases are those of ``graphcam/data/hard_cases.toml``, of which 30 digits of every value are kept; no part of
graphcam computed them.  Digits are counted as -log10 of the error, as a part of the greatest value that the quantity
has there: a number of 53 binary places holds 15.95 of them.
"""

import math
import tomllib
from collections.abc import Callable, Iterable, Iterator, Mapping
from decimal import Decimal
from functools import cache
from importlib import resources
from typing import Any, NamedTuple

import numpy as np

from graphcam.comparison.integrals import accurate_cumsum
from graphcam.errors import DesignError
from graphcam.given.follower import Translating
from graphcam.given.laws import law
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise, cam_angle
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.mechanism.three_arc_cam import three_arc_cam
from graphcam.mechanism.three_point_circle import circumradius
from graphcam.report.markdown import table
from graphcam.solving.solve import solve
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import task_from
from graphcam.words import Caption, say

MAX_DIGITS = -math.log10(np.finfo(np.float64).eps / 2)
"""What a floating-point number holds: more is not counted."""
SHORTEST_DWELL = 1e-9
"""A turn that lacks less than this angle [rad] is complete."""
Row = dict[str, Any]
Digits = Iterator[tuple[str, float]]
"""Of each value its name, and the digits that are left."""


class ComputedKind(NamedTuple):
    """The computed cases of one kind: how many values, and the one with the fewest digits."""

    kind: Caption
    values: int
    worst: str
    digits: float


class DrawnCase(NamedTuple):
    """A drawn case, and its quantity with the fewest digits: NaN where nothing is drawn, with the reason."""

    name: str
    quantity: str
    drawn: float
    exact: float
    digits: float
    refusal: str = ""


@cache
def hard_cases() -> Mapping[str, list[Row]]:
    """The rows of the table by their kinds.

    >>> sum(map(len, hard_cases().values()))
    285
    """
    path = resources.files("graphcam").joinpath("data", "hard_cases.toml")
    return tomllib.loads(path.read_text(encoding="utf-8"))


def digits_left(found: Any, exact: str | float, size: float = 0.0) -> float:
    """The digits of a number that are left.

    size : the greatest value of the quantity; by default the exact value itself

    >>> round(digits_left(3.14, "3.14159265358979323846"), 1)
    3.3
    """
    off, size = abs(float(Decimal(float(found)) - Decimal(exact))), size or abs(float(exact))
    return min(MAX_DIGITS, max(0.0, -math.log10(off / size))) if off and size else MAX_DIGITS


def motion_of(row: Row) -> Motion:
    """The motion of a row; a dwell closes the turn."""
    kinds = {"rise": Rise, "return": Return}
    phases: list[Any] = [
        kinds[kind](h, math.radians(angle), *by_law) if h else Dwell(math.radians(angle))
        for kind, h, angle, *by_law in row["phases"] * row.get("repeat", 1)
    ]
    rest = FULL_TURN - math.fsum(phase.angle for phase in phases)
    return Motion([*phases, Dwell(rest)] if rest > SHORTEST_DWELL else phases)


def cam_of(row: Row) -> Cam:
    """The translating cam of a row."""
    return Cam(motion_of(row), Translating(row["offset"], row["roller"]), row["prime_radius"], row["rotation"])


def task_of(row: Row) -> Task:
    """The task of a drawn row."""
    moved = [
        {"kind": kind, "angle": angle, **({"lift": h} | dict(zip(("law", "ratio"), by_law, strict=False)) if h else {})}
        for kind, h, angle, *by_law in row["phases"] * row.get("repeat", 1)
    ]
    rest = 360 - math.fsum(phase["angle"] for phase in moved)
    closed = [*moved, {"kind": "dwell", "angle": rest}] if rest > SHORTEST_DWELL else moved
    given = {
        "rotation": "cw",
        "motion": {"phases": closed},
        "follower": row["follower"],
        "cam": {"prime_radius": row.get("prime_radius")},
        "limits": {f"pressure_angle_{way}": row.get(way) for way in ("rise", "return")},
        "drawing": {"divisions": row.get("divisions", 12)},
    }
    tables = {name: _without_none(each) if isinstance(each, dict) else each for name, each in given.items()}
    found = task_from({name: each for name, each in tables.items() if each != {}})
    assert isinstance(found, Task)
    return found


def _without_none(given: Row) -> Row:
    return {name: value for name, value in given.items() if value is not None}


# --- what is computed ------------------------------------------------------------------------------------------------


def _law_end(row: Row) -> Digits:
    normalised = law(row["law"], row["ratio"])
    sizes = 1.0, normalised.peak_velocity, normalised.peak_acceleration
    for symbol, found, exact, size in zip("sva", normalised(row["x"]), row["start"], sizes, strict=False):
        yield f"{row['law']}, {symbol} at u = {row['x']:g}", digits_left(found, exact, size)


def _many_turns(row: Row) -> Digits:
    phi = cam_angle(row["angle"], turn={"degrees": 360.0, "turns": 1.0}[row["unit"]])
    yield f"{row['angle']:.12g} {row['unit']}", digits_left(phi, row["phi"], FULL_TURN)


def _cam(row: Row) -> Digits:
    at = cam_of(row).at(row["phase"], row["u"])
    size = float(np.abs(at.pitch).max())
    columns = {
        "pitch curve, x": (at.pitch[:, 0], row["x"], size),
        "pitch curve, y": (at.pitch[:, 1], row["y"], size),
        "profile, x": (at.profile[:, 0], row["profile_x"], size),
        "profile, y": (at.profile[:, 1], row["profile_y"], size),
        "pressure angle": (at.pressure_angle, row["pressure_angle"], math.pi / 2),
        "curvature": (at.curvature, row["curvature"], 0.0),
    }
    for name, (found, exact, scale) in columns.items():
        for value, reference in zip(found, exact, strict=True):
            yield f"{row['name']}: {name}", digits_left(value, reference, scale)


def _inflection(row: Row) -> Digits:
    kappa = cam_of(row).pitch_curvature(row["phi"])
    yield row["name"], digits_left(kappa, row["curvature"], 1 / row["prime_radius"])


def _least_radius(row: Row) -> Digits:
    motion, limit = motion_of(row), math.radians(row["limit"])
    ways: dict[str, Row] = {"free": {}, "with_return": {"return_": limit}, "central": {"offset": 0.0}}
    for name, given in ways.items():
        least = minimum_radius(motion, Translating(), rise=limit, **given)
        yield f"{row['phases'][0][3]}, limit {row['limit']:g}°", digits_left(least.prime_radius, row[name])


def _critical_roller(row: Row) -> Digits:
    if row["expected"] == "loop":
        (loop,) = cam_of(row).undercuts()
        for found, exact in zip(loop.crossing[2:], row["crossing"][2:], strict=True):
            yield f"r/ρ - 1 = {float(row['excess']):.1g}", digits_left(found, exact, row["prime_radius"])


def _orientation(row: Row) -> Digits:
    if row["turns"] != "not":
        yield f"R = {float(row['radius']):.3g}", digits_left(circumradius(*row["points"]), row["radius"])


def _sum(row: Row) -> Digits:
    values = np.tile(np.array(row["cycle"]), row["count"] // len(row["cycle"]))
    yield f"{row['cycle']}", digits_left(accurate_cumsum(values)[-1], row["total"], float(np.abs(values).sum()))


def _straight_flank(row: Row) -> Digits:
    cam, _ = three_arc_cam(**{name: row[name] for name in ("D", "G", "rho1", "C1", "C2")})
    for found, exact in zip(cam.F, row["F"], strict=True):
        yield f"C₁ = {row['C1']}", digits_left(found, exact, math.hypot(*row["G"]))


COMPUTED: Mapping[str, tuple[Caption, Callable[[Row], Digits]]] = {
    "law_end": (say("ends of laws"), _law_end),
    "many_turns": (say("thousand million turns"), _many_turns),
    "cam": (say("cams at the edge: offset near r₀, tiny and huge sizes, 500 phases"), _cam),
    "inflection": (say("inflections of the pitch curve"), _inflection),
    "least_radius": (say("minimum radius, limits near 0° and 90°"), _least_radius),
    "critical_roller": (say("cusps: crossings of tiny loops"), _critical_roller),
    "orientation": (say("three points almost on a line"), _orientation),
    "sum": (say("sums of ten million values"), _sum),
    "straight_flank": (say("flanks that are almost straight"), _straight_flank),
}


def computed_kinds() -> Iterator[ComputedKind]:
    """Every kind of computed cases, with the value that has lost most digits."""
    for name, (kind, values) in COMPUTED.items():
        found = [each for row in hard_cases()[name] for each in values(row)]
        worst, left = min(found, key=lambda each: each[1])
        yield ComputedKind(kind, len(found), worst, left)


# --- what is drawn ---------------------------------------------------------------------------------------------------


def drawn_cases(rows: Iterable[Row] | None = None) -> Iterator[DrawnCase]:
    """Every drawn case, with the quantity whose drawn value has the fewest digits of the exact one.

    rows : some of them; None for all
    """
    for row in hard_cases()["drawn"] if rows is None else rows:
        try:
            quantities = solve(task_of(row)).comparison.quantities.values()
        except DesignError as why:
            yield DrawnCase(row["name"], "", math.nan, math.nan, math.nan, str(why))
            continue
        read = [q for q in quantities if q.unit and math.isfinite(q.error)]
        left = [digits_left(q.drawn, q.exact) for q in read]
        worst = read[int(np.argmin(left))]
        yield DrawnCase(row["name"], str(worst.title), worst.drawn, worst.exact, min(left))


COMPUTED_HEAD = say("kind"), say("worst value"), say("values"), say("digits left")
DRAWN_HEAD = say("case"), say("quantity"), say("drawn"), say("exact"), say("digits left")
PAGE_TITLE = say("Hard cases")
PAGE_HEAD = say(
    "What is computed stands beside values to 50 digits that graphcam had no part in: of all values of a kind the one "
    "is shown that has the fewest digits left, and a floating-point number holds 16. What is drawn with an ideal "
    "pencil stands beside its exact value: of every drawing the quantity with the fewest digits is shown."
)
COMPUTED_TITLE, DRAWN_TITLE = say("Computed, beside 50 digits"), say("Drawn, beside exact")


def computed_rows() -> list[tuple[str, ...]]:
    """The lines of the table of what is computed."""
    return [(str(each.kind), each.worst, f"{each.values}", f"{each.digits:.1f}") for each in computed_kinds()]


def drawn_rows(rows: Iterable[Row] | None = None) -> list[tuple[str, ...]]:
    """The lines of the table of what is drawn; what is refused has the first words of the message."""
    return [
        (each.name, each.refusal.split(",")[0], "–", "–", "–")
        if each.refusal
        else (each.name, each.quantity, f"{each.drawn:.6g}", f"{each.exact:.6g}", f"{each.digits:.1f}")
        for each in drawn_cases(rows)
    ]


def hard_cases_page(computed: list[tuple[str, ...]], drawn: list[tuple[str, ...]]) -> str:
    """Both tables in Markdown."""
    tables = (COMPUTED_TITLE, COMPUTED_HEAD, computed), (DRAWN_TITLE, DRAWN_HEAD, drawn)
    parts = [f"# {PAGE_TITLE}", str(PAGE_HEAD)]
    for title, head, rows in tables:
        parts += [f"## {title}", table(head, rows, of_words=False).strip()]
    return "\n\n".join(parts) + "\n"
