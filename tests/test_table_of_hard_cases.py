"""The table of hard cases: every value against 50 digits, every drawing within its bound or with a sentence.

Nothing raises but what the table says, and nothing warns.
"""

from __future__ import annotations

import json
import math
from typing import Any

import hard_cases
import numpy as np
import pytest
from mpmath import mpf
from over_all import over_all
from reference import EPS

import graphcam as gc
from graphcam.bench.hard_cases import (
    COMPUTED,
    MAX_DIGITS,
    cam_of,
    computed_kinds,
    digits_left,
    drawn_cases,
    hard_cases as all_hard_cases,
    motion_of,
    task_of,
)
from graphcam.comparison.integrals import accurate_cumsum
from graphcam.given.laws import LAWS, law
from graphcam.given.motion import FULL_TURN, cam_angle
from graphcam.given.motion_law import Law
from graphcam.mechanism.three_point_circle import circumradius
from graphcam.solving.solution import Solution

Row = dict[str, Any]
TABLE = all_hard_cases()
POLYNOMIAL = ("rectangular", "2-3", "3-4-5", "4-5-6-7")
SMALLEST = 5e-324
"""The smallest number above zero: what lies below it is 0."""

pytestmark = pytest.mark.filterwarnings("error")


def rows(kind: str) -> Any:
    """One test over the rows of a kind."""
    return over_all("row", TABLE[kind])


def off(computed: Any, exact: str) -> float:
    """How far a computed value lies from the exact one."""
    return float(abs(mpf(float(computed)) - mpf(exact)))


# --- the table itself ------------------------------------------------------------------------------------------------


QUICK = ("many_turns", "inflection", "orientation", "sum", "straight_flank")


@over_all("name", QUICK)
def test_the_script_writes_this_table(name):
    text = hard_cases.TABLE.read_text(encoding="utf-8")
    assert all(part in text for part in hard_cases.section(name))


@pytest.mark.slow
@over_all("name", [name for name in hard_cases.SECTIONS if name not in (*QUICK, "law_end")])
def test_the_script_writes_the_rest_of_it(name):
    """But for the ends of the laws, which take half a minute: ``python tests/hard_cases.py`` writes them all."""
    test_the_script_writes_this_table.__wrapped__(name)


def test_every_law_is_in_it():
    assert {row["law"] for row in TABLE["law_end"]} == set(LAWS)


# --- the exact side --------------------------------------------------------------------------------------------------


@rows("law_end")
def test_laws_keep_their_digits_to_their_ends(row):
    """4 eps of each function's maximum everywhere; s and v of the polynomials to 4 eps of themselves."""
    normalised, x = law(row["law"], row["ratio"]), row["x"]
    greatest = [1.0, normalised.peak_velocity, normalised.peak_acceleration, greatest_jerk(normalised)]
    end = [piece[0] for piece in normalised.pieces[-1].formula(np.array([x]))]
    for computed, exact in ((normalised(x), row["start"]), (end, row["end"])):
        for order, (c, e, most) in enumerate(zip(computed, exact, greatest, strict=True)):
            assert off(c, e) <= 4 * EPS * most, order
            if row["law"] in POLYNOMIAL and order < 2:
                assert off(c, e) <= 4 * EPS * float(e) + SMALLEST, order


def greatest_jerk(normalised: Law) -> float:
    u = np.linspace(0, 1, 1001)
    return max(float(np.abs(normalised(u, side=side)[3]).max()) for side in ("left", "right"))


@pytest.mark.parametrize("kind", POLYNOMIAL)
def test_a_return_keeps_the_lift_that_is_missing(kind):
    """As near to its end as a float comes, s and v are known to 4 eps of themselves."""
    motion = gc.Motion([gc.Rise(1.0, math.pi), gc.Return(1.0, math.pi, kind)])
    for w in (2.0**-53, 3 * 2.0**-52, 2.0**-30):
        s, v, *_ = motion.at(1, 1 - w)
        with hard_cases.workdps(200):
            exact, slope = (hard_cases.diff(lambda u: hard_cases.lift(kind, u), mpf(w), n) for n in (0, 1))
        assert off(s, exact) <= 4 * EPS * exact
        assert off(v, -slope / mpf(math.pi)) <= 4 * EPS * slope / mpf(math.pi)


@rows("many_turns")
def test_a_thousand_million_turns_are_told_apart(row):
    """The angle to one rounding of 2 pi, and s, v, a, j to what that and 4 eps leave."""
    motion = motion_of(row)
    phi = cam_angle(row["angle"], turn={"degrees": 360.0, "turns": 1.0}[row["unit"]])
    assert off(phi, row["phi"]) <= 2 * EPS * FULL_TURN
    values = motion(np.linspace(0, FULL_TURN, 2001))
    greatest = [float(np.abs(value).max()) for value in values]
    for c, e, most, slope in zip(motion(phi), row["values"], greatest, [*greatest[1:], 40 * greatest[3]], strict=True):
        assert off(c, e) <= 4 * EPS * most + 2 * EPS * FULL_TURN * slope


ORDINARY, NEAR_THE_PRIME_RADIUS = 16, 500
"""eps of rho."""


@rows("cam")
def test_cams_at_the_edge(row):
    """Coordinates to 4 eps of the point's distance, pressure angles to 4 eps of a right angle, rho to 16 eps."""
    cam = cam_of(row)
    at = cam.at(row["phase"], row["u"])
    size = np.hypot(*(np.array(row[key], dtype=float) for key in "xy"))
    for computed, key in ((at.pitch, ""), (at.profile, "profile_")):
        for column, axis in enumerate("xy"):
            assert np.all(apart(computed[:, column], row[key + axis]) <= 4 * EPS * size)
    assert np.all(apart(at.pressure_angle, row["pressure_angle"]) <= 4 * EPS * math.pi / 2)
    rho = np.abs(np.array(row["curvature"], dtype=float)) * EPS
    near = abs(row["offset"]) > 0.99 * row["prime_radius"]
    assert np.all(apart(at.curvature, row["curvature"]) <= (NEAR_THE_PRIME_RADIUS if near else ORDINARY) * rho)
    # The exact side is asked for all of it, with its extremes and what is lost of the profile.
    assert np.isfinite([value for value, _ in vars(cam.extremes()).values()]).all()
    assert isinstance(cam.undercuts(), list)


def apart(computed: np.ndarray, exact: list[str]) -> np.ndarray:
    return np.array([off(c, e) for c, e in zip(computed, exact, strict=True)])


@rows("inflection")
def test_an_inflection_is_straight_and_not_nan(row):
    """kappa is 0 within 16 eps of the curvature of the prime circle; where it is exactly 0, it is 0."""
    cam = cam_of(row)
    kappa = float(cam.pitch_curvature(row["phi"]))
    assert off(kappa, row["curvature"]) <= (ORDINARY * EPS / row["prime_radius"] if float(row["curvature"]) else 0.0)
    assert math.isfinite(cam.extremes().min_convex_radius[0])
    assert np.isfinite(cam.profile(row["phi"])).all()
    assert cam.undercuts() == []


@rows("least_radius")
def test_least_radii_at_limits_near_0_and_90_degrees(row):
    """To 4 eps."""
    motion, limit = motion_of(row), math.radians(row["limit"])
    found = {
        "free": gc.minimum_radius(motion, gc.Translating(), rise=limit),
        "with_return": gc.minimum_radius(motion, gc.Translating(), rise=limit, return_=limit),
        "central": gc.minimum_radius(motion, gc.Translating(), rise=limit, offset=0.0),
    }
    for name, least in found.items():
        assert off(least.prime_radius, row[name]) <= 4 * EPS * float(row[name]), name


CROSSING = 1e-14
"""mm"""


@rows("critical_roller")
def test_rollers_about_the_critical_one(row):
    """A smaller roller leaves nothing to tell, one within 1e-12 a cusp, a larger one a loop with its crossing."""
    cam = cam_of(row)
    lost = cam.undercuts()
    assert ["sound", "cusp", "loop"][len(lost) and 2 - lost[0].is_cusp] == row["expected"]
    assert np.isfinite(cam.trimmed_profile(100)).all()
    if row["expected"] == "loop":
        (loop,) = lost
        # In tiny loops the angles are known to less than the point is.
        depth = float(row["excess"])
        angles = [off(c, e) for c, e in zip(loop.crossing[:2], row["crossing"][:2], strict=True)]
        assert max(angles) <= EPS / depth + 1e-13
        x, y = (off(c, e) for c, e in zip(loop.crossing[2:], row["crossing"][2:], strict=True))
        assert math.hypot(x, y) <= row.get("reached", CROSSING)


@rows("orientation")
def test_three_points_nearly_on_a_line_turn_as_they_do(row):
    radius = float(circumradius(*row["points"]))
    if row["turns"] == "not":
        assert math.isinf(radius)
    else:
        assert (radius > 0) == (row["turns"] == "left")
        assert off(radius, row["radius"]) <= LOST_DIGITS * abs(float(row["radius"]))


LOST_DIGITS = 1e-6
"""Of the radius, where the points themselves hardly tell it."""


@pytest.mark.slow
@rows("sum")
def test_sums_over_ten_million_stations(row):
    """4 eps of the sum, or, where signs cancel, of the sum of the magnitudes."""
    values = np.tile(np.array(row["cycle"]), row["count"] // len(row["cycle"]))
    assert off(accurate_cumsum(values)[-1], row["total"]) <= 4 * EPS * np.abs(values).sum()


@rows("straight_flank")
def test_flanks_that_are_nearly_straight(row):
    cam, _ = gc.three_arc_cam(D=row["D"], G=row["G"], rho1=row["rho1"], C1=row["C1"], C2=row["C2"])
    assert row["flank"] == ("straight" if cam.straight else "hollow" if cam.hollow else "convex")
    assert max(off(c, e) for c, e in zip(cam.F, row["F"], strict=True)) <= 4 * EPS * math.hypot(*row["G"])
    bend = (-1 if cam.hollow else 1) / cam.rho3
    # What a sum of lengths rounds away bends no flank.
    assert off(bend, row["bend"]) <= 8 * EPS * abs(float(row["bend"])) + 8 * EPS / math.dist(row["G"], row["C1"])


# --- the drawn side --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "row", [pytest.param(row, id=row["name"], marks=[pytest.mark.slow] * row.get("slow", 0)) for row in TABLE["drawn"]]
)
def test_what_is_hard_to_draw_is_within_its_bound_or_said_to_be_unread(row):
    if "refused" in row:
        with pytest.raises(gc.DesignError) as refusal:
            gc.solve(task_of(row))
        assert row["refused"] in str(refusal.value)
        return
    solution = gc.solve(task_of(row))
    quantities = {name: q for name, q in solution.comparison.quantities.items() if q.unit}
    unread = [name for name, q in quantities.items() if math.isnan(q.drawn) and math.isfinite(q.exact)]
    no_bound = [name for name, q in quantities.items() if math.isfinite(q.drawn) and math.isnan(q.tolerance_paper)]
    assert unread == row.get("unread", [])
    assert no_bound == row.get("no_bound", [])
    for name, q in quantities.items():
        if name not in unread + no_bound and math.isfinite(q.exact):
            assert abs(q.error_paper) <= q.tolerance_paper, name
        if name in row:
            assert q.exact == pytest.approx(float(row[name]), rel=1e-12), name
    said = captions(solution)
    assert [words for words in row.get("says", []) if words not in said] == []
    assert row.get("warns", "") in " ".join(solution.warnings)
    assert json.dumps(solution.to_dict(), allow_nan=False)


def captions(solution: Solution) -> str:
    """All sentences of the drawing; every step is drawn for them."""
    steps = [step for construction in solution.drawn.values() for step in construction.steps()]
    return " ".join(f"{step.title} {step.caption}" for step in steps)


# --- what is shown of them -------------------------------------------------------------------------------------------


def test_every_kind_is_shown_with_the_digits_that_are_left():
    """Of 15.95 that a number holds no computed value has lost two; a wrong one would show."""
    shown = list(computed_kinds())
    assert len(shown) == len(COMPUTED)
    assert set(TABLE) - set(COMPUTED) == {"drawn"}
    assert all(14 < each.digits <= MAX_DIGITS for each in shown)
    assert sum(each.values for each in shown) > 1000
    assert digits_left(1.001, "1.0") == pytest.approx(3.0)
    assert digits_left(-1.0, "1.0") == 0.0


def test_what_is_drawn_stands_beside_its_exact_value():
    rows = {row["name"]: row for row in TABLE["drawn"]}
    some = [rows["two parts a phase"], rows["lines that cross at less than a degree, nothing given"]]
    drawn, refused = drawn_cases(some)
    assert drawn.quantity == "maximum a"
    assert drawn.exact == pytest.approx(float(rows["two parts a phase"]["max_a"]), rel=1e-12)
    assert drawn.digits == pytest.approx(-math.log10(abs(drawn.drawn / drawn.exact - 1)))
    assert math.isnan(refused.digits)
    assert "permitted pressure angle" in refused.refusal
