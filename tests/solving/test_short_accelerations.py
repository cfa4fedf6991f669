"""What is drawn where accelerations are short: within its bound, or warned of.

    python tests/solving/test_short_accelerations.py --cases 1000 --seed 0

solves random motions with short accelerations, straight parts and jumps, and says what was found.
"""

from __future__ import annotations

import argparse
import math
import re
import tomllib
from collections import Counter
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import graphcam as gc
from graphcam.comparison.chord_readings import MAX_FINER_PARTS, MAX_S_SHARE, MAX_V_SHARE, chord_readings, finer_parts
from graphcam.given.motion import MovingPhase
from graphcam.given.stations import divide
from graphcam.report.documents import contents_of
from graphcam.report.sheet_data import data
from graphcam.tasks.task_file import task_from

PHASES = """
rotation = "ccw"
[motion]
phases = [
  {{ kind = "rise", angle = {rise[0]}, lift = 30, {rise[1]} }},
  {{ kind = "dwell", angle = 60 }},
  {{ kind = "return", angle = {back[0]}, lift = 30, {back[1]} }},
  {{ kind = "dwell", angle = {rest} }},
]
[follower]
kind = "translating"
offset = 0
roller_radius = 0
[cam]
prime_radius = 60
[drawing]
{drawing}
"""


def straight(blends: object) -> str:
    return f'law = "constant-velocity", blends = {blends}'


def solved(rise: tuple[float, str], back: tuple[float, str], drawing: str = "") -> gc.Solution:
    text = PHASES.format(rise=rise, back=back, rest=300 - rise[0] - back[0], drawing=drawing)
    return gc.solve(task_from(tomllib.loads(text)))


def of_divisions(solution: gc.Solution) -> list[str]:
    return [str(caution.said) for caution in solution.cautions if caution.of == "divisions"]


COSINE = 'law = "cosine"'


@pytest.mark.parametrize("blend", [0.3, 0.2, 0.1, 0.05, 0.02, 0.01, 0.001])
@pytest.mark.parametrize("straight_is_first", [True, False])
def test_a_straight_phase_is_drawn_with_its_slope(blend, straight_is_first):
    phases = (100, straight([blend, blend])), (120, COSINE)
    solution = solved(*(phases if straight_is_first else phases[::-1]))
    span = solution.chain.spans[0 if straight_is_first else 1]
    steepest = np.abs(solution.chain["integration"].value("v")[span]).max()
    assert steepest == pytest.approx(30 / math.radians(100) / (1 - blend), rel=0.04 if blend == 0.3 else 0.02)
    assert not of_divisions(solution)


@pytest.mark.parametrize("law", gc.LAWS)
def test_phases_of_the_laws_keep_their_equal_parts(law):
    solution = solved((100, f'law = "{law}"'), (120, f'law = "{law}"'))
    assert solution.chain.board.finer == {}
    assert [part.stop - part.start for part in solution.chain.board.stations.parts] == [12, 12]


def test_only_the_short_acceleration_is_divided_and_the_sheet_says_so():
    solution = solved((100, straight([0.02, 0.1])), (120, COSINE))
    stations = solution.chain.board.stations
    assert stations.finer == (0,)
    short, usual = stations.parts
    assert usual.stop - usual.start == 12
    assert 12 < short.stop - short.start <= MAX_FINER_PARTS
    assert {0.02, 0.9} <= set(stations.u[stations.phases[0]].round(9).tolist())
    assert any("divisions of" in str(row[0]) for row in data(solution).rows)
    (middles,) = [step for step in solution.chain["acceleration"].steps() if str(step.title) == "Middle ordinates"]
    assert "lasts less than a usual part" in str(middles.parts[0].caption)


def test_divisions_that_are_given_are_kept_and_warned_of_with_divisions_that_keep_the_bound():
    given = solved((120, COSINE), (100, straight([0.05, 0.05])), "divisions = 12")
    assert given.chain.board.stations.left.size == 24
    (said,) = of_divisions(given)
    assert said.endswith("Divide each phase into 72 parts, or leave their number open.")
    for drawing in ("", "divisions = 72"):
        assert not of_divisions(solved((120, COSINE), (100, straight([0.05, 0.05])), drawing))


def test_where_nothing_rises_on_the_paper_divisions_that_are_left_out_suffice():
    blends = straight([0.02, 0.02])
    with pytest.raises(gc.DesignError, match=r"maximum displacement on paper.*leave drawing\.divisions out"):
        _ = solved((120, blends), (100, blends), "divisions = 12").chain["integration"]
    assert not of_divisions(solved((120, blends), (100, blends)))


@pytest.mark.parametrize("n", [5, 12, 24])
def test_the_chords_are_those_of_the_drawing(n):
    rise, back = (110, straight([0.07, 0.2])), (90, 'law = "rectangular", ratio = 3')
    solution = solved(rise, back, f"divisions = {n}")
    board, drawn = solution.chain.board, solution.chain["integration"]
    readings = chord_readings(board.motion, board.stations)
    exact = solution.comparison.exact_stations
    for k, (span, phase) in enumerate(zip(board.stations.phases, readings.phase, strict=True)):
        part = board.motion.phases[phase]
        assert isinstance(part, MovingPhase)
        s_off = np.abs(drawn.value("s")[span] - exact.values[0][span]).max() / board.motion.lift
        assert readings.s[k] == pytest.approx(s_off, abs=1e-9)
        peak = part.normalised.peak_velocity * part.lift / part.angle
        assert readings.v[k] >= np.abs(drawn.value("v")[span] - exact.values[1][span]).max() / peak - 1e-9


def test_only_parts_that_need_it_are_halved():
    rise = gc.Rise(30, 2.0, gc.constant_velocity_law(0.1, 0.1))
    motion = gc.Motion([rise, gc.Return(30, 2 * math.pi - 2.0, "cosine")])
    finer = finer_parts(motion, 12, lambda finer: divide(motion, 12, finer=finer))
    cuts = np.array(finer[0])
    assert_allclose(cuts[(cuts > 0.1) & (cuts < 0.9)], 0.1 + 0.08 * np.arange(1, 10))
    assert 4 <= (cuts < 0.1).sum() == (cuts > 0.9).sum() <= 9


def test_no_fitted_curve_overshoots_a_straight_part():
    """The plateau of v is a piece of its own, so a parabola across the corner does not read a higher maximum."""
    solution = solved((100, straight([0.01, 0.01])), (120, straight([0.01, 0.01])))
    drawn = solution.chain["integration"]
    assert float(drawn.value("max_v")) == pytest.approx(np.abs(drawn.value("v")).max(), rel=1e-12)


@pytest.mark.parametrize("blend", [0.5 / 361, 1e-3, 1e-4])
def test_an_ordinate_that_is_left_out_looks_at_every_phase(blend):
    """A short acceleration between two samples was not seen, and was drawn 150 m high."""
    solution = solved((120, COSINE), (100, straight([blend, blend])))
    greatest = solution.chain["acceleration"].first("greatest")
    assert np.abs(greatest).max() < 400
    contents_of(solution)


def test_drawn_values_beyond_their_bounds_are_told_in_one_sentence():
    solution = solved((100, COSINE), (120, COSINE))
    assert solution.warnings == []
    wrong = gc.Cam(solution.cam.motion, solution.cam.follower, 80.0, solution.cam.rotation)
    told = gc.Solution(solution.task, solution.chain, wrong).warnings
    assert len([said for said in told if said.startswith("Outside the bound: ")]) == 1


# --- random motions ---------------------------------------------------------------------------------------------------


def measured(phases: list[dict[str, Any]], column: str, step: float, decimals: int) -> dict[str, Any]:
    """The table of a motion in rows of ``step`` degrees."""
    task = {"rotation": "ccw", "motion": {"phases": phases}, "follower": {"kind": "translating", "offset": 0}}
    phi = np.arange(0, 360, step)
    s = np.round(task_from(task).motion()(np.radians(phi))[0], decimals)
    rows = [list(row) for row in zip(phi.tolist(), s.tolist(), strict=True)]
    return {"table": {"file": "rows.csv", "column": column, "rows": rows}, "tolerance": 0.05}


def by_conditions(short: float, steep: float) -> dict[str, Any]:
    """A rise that begins within ``short`` degrees, and goes on straight to a long return."""
    lift, rest, end = 20.0, {"v": 0, "a": 0}, 180 - short
    v = steep * lift / math.radians(180 - short)
    at = v * math.radians(short) / 2
    points = [
        [{"angle": 0, "s": 0, **rest}, {"angle": short, "s": at, "v": v, "a": 0}],
        [{"angle": short, "s": at, "v": v, "a": 0}, {"angle": end, "s": lift - at, "v": v, "a": 0}],
        [{"angle": end, "s": lift - at, "v": v, "a": 0}, {"angle": 180, "s": lift, **rest}],
        [{"angle": 200, "s": lift, **rest}, {"angle": 350, "s": 0, **rest}],
    ]
    return {"parts": [{"kind": "polynomial", "points": part} for part in points]}


def random_task(seed: int) -> dict[str, Any]:
    """A motion with short accelerations, straight parts or jumps, under any follower, with any divisions."""
    random = np.random.default_rng([36, seed])
    blends = (0.001, 0.005, 0.02, 0.04, 0.1, 0.3)

    def law() -> dict[str, Any]:
        if random.random() < 0.6:
            return {"law": "constant-velocity", "blends": random.choice(blends, 2).tolist()}
        name = str(random.choice(gc.LAWS))
        return {"law": name} | ({"ratio": float(random.choice([0.1, 1, 12]))} if name == "rectangular" else {})

    kind = str(random.choice(["translating", "oscillating", "flat-faced"]))
    lift = 15.0 if kind == "oscillating" else 20.0
    lifts = [lift] if random.random() < 0.7 else [0.4 * lift, 0.6 * lift]
    moves = [{"kind": "rise", "lift": h, **law()} for h in lifts] + [{"kind": "return", "lift": lift, **law()}]
    phases = [phase for move in moves for phase in (move, {"kind": "dwell"})]
    angles = np.round(random.dirichlet([4.0 if "lift" in phase else 2.0 for phase in phases]) * 300 + 60 / len(phases))
    angles[-1] += 360 - angles.sum()
    phases = [{**phase, "angle": float(angle)} for phase, angle in zip(phases, angles, strict=True)]
    motion = {"phases": phases}
    if (source := random.random()) < 0.15:
        column = "s_deg" if kind == "oscillating" else "s_mm"
        motion = measured(phases, column, step=float(random.choice([2, 5])), decimals=int(random.choice([2, 4])))
    elif source < 0.3:
        motion = by_conditions(float(random.choice([10, 30, 80])), float(random.choice([0.5, 1, 1.4])))
    cam = {"prime_radius": 400.0 if kind == "flat-faced" else 80.0}
    sizes = {
        "translating": {"offset": float(random.choice([0, 10])), "roller_radius": float(random.choice([0, 8]))},
        "oscillating": {"arm": 100.0, "distance": 130.0, "roller_radius": 8.0},
        "flat-faced": {},
    }
    given = {"divisions": int(random.choice([3, 8, 12, 30]))} if random.random() < 0.3 else {}
    return {
        "rotation": str(random.choice(["ccw", "cw"])),
        "motion": motion,
        "follower": {"kind": kind, **sizes[kind]},
        "cam": cam,
        "drawing": given,
    }


def check_case(seed: int) -> str:
    """What became of a random motion; what is drawn beyond its bound is warned of."""
    try:
        solution = gc.solve(task_from(random_task(seed)))
        sentences = solution.warnings
    except gc.GraphcamError as error:
        told = str(error)
    else:
        told = ""
    if told:
        assert re.search("leave drawing.divisions out|give a greater tolerance", told), (seed, told)
        return "refused"
    beyond = [q for q in solution.comparison.quantities.values() if q.is_beyond_bound]
    assert bool(beyond) == any(said.startswith("Outside the bound") for said in sentences), seed
    if of_divisions(solution):
        assert solution.task.drawing.divisions is not None or solution.chain.board.finer, seed
        return "warned of its divisions"
    stations, motion = solution.chain.board.stations, solution.cam.motion
    exact, drawn = solution.comparison.exact_stations, solution.chain["integration"]
    assert np.abs(drawn.value("s") - exact.values[0]).max() <= MAX_S_SHARE * motion.lift, seed
    for span in stations.phases:
        phase = motion.phases[stations.phase[span.start]]
        assert isinstance(phase, MovingPhase)
        peak = phase.normalised.peak_velocity * phase.lift / phase.angle
        assert np.abs(drawn.value("v")[span] - exact.values[1][span]).max() <= MAX_V_SHARE * peak, seed
    fastest = max(np.abs(exact.values[1]).max(), solution.comparison.exact["max_v"])
    assert abs(float(drawn.value("max_v")) - fastest) <= MAX_V_SHARE * fastest, seed
    return "beyond its bound, told" if beyond else "within its bounds"


def test_no_drawn_value_is_beyond_its_bound_without_a_warning():
    found = Counter(check_case(seed) for seed in range(12))
    assert found["within its bounds"] >= 4, found


def test_a_level_stretch_of_v_is_read_at_its_height_and_not_where_rounding_has_its_corner():
    assert check_case(1150) == "within its bounds"


@pytest.mark.slow
def test_no_drawn_value_of_60_motions_is_beyond_its_bound_without_a_warning():
    found = Counter(check_case(seed) for seed in range(60))
    assert found["within its bounds"] >= 20, found


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--cases", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0, help="of the first case")
    asked = parser.parse_args()
    print(*Counter(check_case(seed) for seed in range(asked.seed, asked.seed + asked.cases)).items(), sep="\n")  # noqa: T201
