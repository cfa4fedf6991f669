"""The report of speed against error: what it says, never how long it took."""

from __future__ import annotations

import csv
import json
import math
import sys

import numpy as np
import pytest
from typer.testing import CliRunner

import graphcam as gc
from graphcam.bench import bench_report as reports, convergence as drawn, load_rows as loads, peers, reference, rivals
from graphcam.bench.bench_followers import ARM, PERMITTED_ANGLE, free_scene, scene
from graphcam.bench.exact_rows import designs
from graphcam.bench.hand_errors import budgets, by_hand
from graphcam.bench.rows import BenchRow, Effort
from graphcam.bench.sweep_curve import swept_file
from graphcam.bench.timing import Timer
from graphcam.bench.tradeoff import INNER_POINT
from graphcam.bench.waiting_rows import built_in
from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS, table_lines
from graphcam.sweeps.sweep import sweep
from graphcam.sweeps.sweep_forces import FORCE_QUANTITIES
from graphcam.sweeps.sweep_quantities import QUANTITIES

SMOOTH = ("cycloidal", "3-4-5")
SECOND_ORDER = ("displacement", "velocity", "maximum acceleration", "pitch curve", "working profile")
SIZES = dict.fromkeys(("graphical", "profile", "integrators"), (12, 24)) | {"buffer": (24, 96)}
TINY = Effort(
    *((12, 24, 48), ("cycloidal", "rectangular"), 20, (6, 12, 24)),
    SIZES | dict.fromkeys(("half_planes", "optimiser"), (12, 36)),
    *(1000, 1000, 0.0),
    least_runs=1,
    motions=40,
)


@pytest.mark.parametrize("follower", ["translating", "arm", "flat"])
def test_sampled_forces_come_near_the_extremes_from_inside(follower):
    """No sample exceeds the extreme that is found; more samples come nearer."""
    cam = scene(follower, "3-4-5").cam
    exact, few, many = (
        loads.extreme_forces(cam, follower),
        *(loads.sampled_forces(cam, follower, n) for n in (60, 6000)),
    )
    for sign, found, coarse, fine in zip((1, -1, 1), exact, few, many, strict=True):
        assert sign * (coarse - found) <= 1e-12 * abs(found)
        assert abs(fine - found) <= abs(coarse - found) + 1e-12 * abs(found)
        assert fine == pytest.approx(found, rel=1e-5)


@pytest.mark.parametrize("follower", ["translating", "arm"])
def test_swept_forces_are_those_of_one_cam_after_another(follower):
    some = designs(follower, "3-4-5", 6)
    swept = sweep(some, FORCE_QUANTITIES, load=loads.load_of(follower), friction=loads.FRICTION_COEFFICIENT)
    looped = np.array(loads.looped_forces(some, follower))
    for k, name in enumerate(FORCE_QUANTITIES[:3]):
        assert np.abs(swept[name] / looped[:, k] - 1).max() < 1e-12


def test_steps_and_spectrum_come_to_the_closed_form_of_the_cycloid():
    n = np.array([0.5, 2.0, 3.3, 7.5])
    exact = loads.residual_of_cycloid(n)
    assert np.abs(gc.shock_spectrum("cycloidal", n).residual - exact).max() < 1e-13 * exact.max()
    assert [loads.stepped_residual(x, 1e-10) for x in n] == pytest.approx(exact, abs=1e-8 * exact.max())


def test_a_motion_by_conditions_is_right_to_a_few_eps_and_its_rows_have_a_rival():
    assert loads.conditions_eps() < 8
    rows = list(loads.condition_rows(TINY))
    assert [row.name for row in rows] == ["motion by conditions"] * 3
    assert float(rows[-1].what.split()[-2]) < 1e-12


@pytest.fixture(scope="module")
def series():
    return drawn.convergence(drawn.FITTED_PARTS)


def test_smooth_laws_are_drawn_with_the_second_order(series):
    seen = [s for s in series if s.law in SMOOTH and s.quantity in SECOND_ORDER]
    assert len(seen) == 2 * (5 + 5 + 4)
    for s in seen:
        if (s.law, s.quantity) == ("cycloidal", "velocity"):  # a cosine keeps its shape under the pole method
            assert s.exact
        else:
            assert s.order == pytest.approx(2.0, abs=0.1), s
            assert all(after < before for before, after in zip(s.errors, s.errors[1:], strict=False)), s


def test_constant_acceleration_is_drawn_exactly(series):
    for s in series:
        if s.law == "rectangular" and s.quantity in {"displacement", "velocity", "pitch curve", "pressure angle"}:
            assert s.exact, s


def test_every_error_is_bounded_and_falls_in_the_end(series):
    for s in series:
        assert all(math.isfinite(error) and error >= 0 for error in s.errors), s
        if not s.exact:
            assert s.errors[-1] < 0.5 * s.errors[0], s


def test_errors_are_the_same_in_every_run():
    assert drawn.convergence((6, 12), ("3-4-5",)) == drawn.convergence((6, 12), ("3-4-5",))
    assert by_hand("3-4-5", 10, (6, 12)) == by_hand("3-4-5", 10, (6, 12))


def test_the_order_is_fitted_to_a_power_exactly():
    n = np.array([6, 12, 24, 48, 96])
    errors = 3.0 / n**1.5
    errors[0] = 1e3  # not among the parts that are fitted
    assert drawn.fitted_order(n.tolist(), errors.tolist()) == pytest.approx(1.5, abs=1e-12)
    assert drawn.fitted_order((12, 24), (1.0, 0.0)) is None


def test_the_hand_has_a_best_number_of_parts():
    hands = by_hand("cycloidal", 400, (4, 12, 96))
    assert hands.best_parts == 12
    # In 12 parts lines alone leave 0.85 %; every setting of the dividers and every upright comes to it.
    assert 100 * hands.floor == pytest.approx(1.25, rel=0.15)
    assert hands.low[1] < hands.mean[1] < hands.high[1]


@pytest.mark.slow
def test_the_error_budget_names_what_makes_every_reading_scatter():
    rows = list(budgets("3-4-5"))
    assert {row.follower for row in rows} == {"translating", "arm", "flat"}
    for row in rows:
        assert row.deviation > 0, row
        assert sum(row.parts.values()) == pytest.approx(1.0)
    largest = {(row.construction, row.reading): max(row.parts, key=lambda kind: row.parts[kind]) for row in rows[:20]}
    assert largest["acceleration", "base"] == "lay off"  # the only act that it takes
    assert largest["integration", "closing_s"] == "parallel"  # chord after chord


def test_the_exact_side_is_right_to_four_eps():
    fixed, free = scene("translating", "cycloidal"), free_scene("cycloidal")
    for eps in (reference.displacement_eps(fixed), reference.least_radius_eps(free), reference.profile_eps(fixed)):
        assert eps <= 4


@pytest.mark.parametrize(
    ("name", "order"), [("cumulative_trapezoid", 2), ("cumulative_simpson", 4), ("CubicSpline", 4)]
)
def test_sampled_integration_has_its_textbook_order(name, order):
    parts = (48, 96, 192)
    motion = scene("translating", "cycloidal").board.motion
    method = rivals.INTEGRATORS[name]
    errors = [np.abs(np.subtract(rivals.integrated(motion, method, n), rivals.rises(motion, n))).max() for n in parts]
    assert -np.polyfit(np.log(parts), np.log(errors), 1)[0] == pytest.approx(order, abs=0.25)


@pytest.mark.parametrize("law", SMOOTH)
def test_a_sampled_least_radius_is_too_small_and_comes_near_with_the_second_order(law):
    free = free_scene(law)
    exact, motion = free.exact_least_radius().prime_radius, free.board.motion
    for solve in (
        lambda n: rivals.by_half_planes(rivals.translating_lines(motion, PERMITTED_ANGLE, n), INNER_POINT),
        lambda n: rivals.by_optimiser(rivals.translating_lines(motion, PERMITTED_ANGLE, n), INNER_POINT),
        lambda n: rivals.by_pressure_angles(motion, PERMITTED_ANGLE, n, (INNER_POINT[1], 0.0)),
    ):
        few, many = (solve(n) / exact - 1 for n in (60, 600))
        assert few < many < 0
        assert abs(many) < 1e-5


def test_a_sampled_least_radius_of_an_arm_is_too_small():
    arm = scene("arm", "3-4-5")
    lines = rivals.arm_lines(arm.board.motion, arm.board.limits.rise, ARM, 360)
    assert -1e-4 < rivals.by_optimiser(lines, (20.0, 90.0)) / arm.exact_least_radius().prime_radius - 1 < 0


def test_a_loop_over_stations_misses_the_extremes_of_a_sweep_with_the_second_order():
    for follower, law in (("translating", "cycloidal"), ("arm", "3-4-5")):
        some = designs(follower, law, 40)
        swept = sweep(some, QUANTITIES[:3])
        exact = np.stack([swept[name] for name in QUANTITIES[:3]], axis=1)
        # It sees angles that are too small, and radii that are too large.
        missed = [(rivals.by_stations(some, n) / exact - 1) * [-1, -1, 1] for n in (181, 721)]
        assert min(m.min() for m in missed) > -1e-12
        assert 1e-6 < missed[0].max() < 1e-3
        assert missed[1].max() < missed[0].max() / 8


@pytest.mark.slow
def test_a_sweep_into_a_file_tells_what_it_took():
    seconds, processor_seconds, peak_bytes = swept_file(1000, workers=2)
    assert min(seconds, processor_seconds) > 0
    if sys.platform == "linux":
        assert peak_bytes > 2**25  # an interpreter with NumPy alone has as much


def test_the_distance_from_the_profile_is_that_along_its_normal():
    cam = scene("translating", "3-4-5").cam
    phi = np.linspace(0.1, 6.0, 40)
    profile, pitch = (points @ [1, 1j] for points in (cam.profile(phi), cam.pitch_curve(phi)))
    moved = profile + 0.25 / cam.roller_radius * (pitch - profile)
    assert drawn.distance_from_profile(cam, moved, phi + 0.01) == pytest.approx(np.full(40, 0.25), abs=1e-12)
    near = drawn.nearest_angles(cam, profile)
    assert drawn.distance_from_profile(cam, profile, near) == pytest.approx(np.zeros(40), abs=1e-11)


def test_a_package_that_is_not_there_is_left_out_with_the_reason(monkeypatch):
    for name in ("mechanism", "pylinkage", "pylinkage.cam"):
        monkeypatch.setitem(sys.modules, name, None)
    found = list(peers.peers(Timer(0.0)))
    assert [(p.package, p.error) for p in found] == [("mechanism", None), ("pylinkage", None)]
    assert all("not installed" in p.reason for p in found)


@pytest.mark.slow
def test_the_faults_of_another_package_are_found_again():
    found = {p.quantity: p for p in peers.peers(Timer(0.0)) if p.package.startswith("mechanism")}
    assert found["working profile"].error == pytest.approx(4.76, abs=0.005)
    assert found["displacement"].error < 1e-12


@pytest.mark.slow
def test_the_command_shows_the_hard_cases(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, ["bench", "--hard"])
    assert result.exit_code == 0, result.output
    assert "Computed, beside 50 digits" in result.output
    assert "offset near the prime radius" in result.output
    assert "two parts a phase of an arm: maximum a" in result.output
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_the_command_writes_the_whole_report(tmp_path, monkeypatch):
    monkeypatch.setattr(reports, "QUICK_EFFORT", TINY)
    monkeypatch.setenv("COLUMNS", "80")
    result = CliRunner().invoke(app, ["bench", "--quick", "--out", str(tmp_path / "report")])
    assert result.exit_code == 0, result.output
    assert "Error against the number of parts" in result.output
    assert sorted(path.name for path in (tmp_path / "report").iterdir()) == sorted(reports.FILE_NAMES)

    def no_constant(name: str) -> None:
        raise AssertionError(name)

    document = json.loads((tmp_path / "report" / "bench.json").read_text(), parse_constant=no_constant)
    _check(document)
    _check_waiting(document["waiting"], document["studio"])
    with (tmp_path / "report" / "bench.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    measured = {section.key for section in reports.ROWS} - {"workers"}  # which take too long when it must be quick
    drawn = {"convergence", "pencil", "pencil_errors", "budget", "time", "peers", "readings", "steps", "rendering"}
    assert {row["section"] for row in rows} == drawn | measured
    markdown = (tmp_path / "report" / "bench.md").read_text()
    tables = [line for line in markdown.splitlines() if line.startswith("|")]
    assert len(tables) > 60
    assert markdown.count("\n## ") == len(reports.REPORT_SECTIONS) - 1
    printed = result.output[result.output.index("\nError against the number") :].splitlines()[:-1]
    assert len(printed) > 120
    assert max(map(len, printed)) <= 80


@pytest.mark.parametrize(
    ("goal", "ratio", "seconds", "met"),
    [
        ("<= 0.7", 0.7, 1.0, True),
        ("<= 0.7", 0.71, 1.0, False),
        (">= 10", 10.0, 1.0, True),
        (">= 10", 9.9, 1.0, False),
        ("<= 5 µs", 9.0, 4.9e-6, True),
        ("<= 5 µs", 0.1, 5.1e-6, False),
        ("<= 0.5 s", 9.0, 0.4, True),
        ("<= 120 MB", 130.0, 1e-9, False),
        ("2.00 ± 0.05", 1.96, 1.0, True),
        ("2.00 ± 0.05", 2.06, 1.0, False),
        ("<= 0.7", math.nan, 1.0, False),
        ("", 1.0, 1.0, None),
    ],
)
def test_a_goal_is_met_by_the_ratio_or_by_the_time_where_it_names_one(goal, ratio, seconds, met):
    assert BenchRow("", "", ratio, "MB", goal, None, seconds).goal_met is met


@pytest.mark.parametrize("goal", ["0.7", "< 0.7", "<= fast", "<= 5 minutes"])
def test_a_goal_that_cannot_be_read_is_no_goal_met(goal):
    with pytest.raises(ValueError, match=r"goal|float"):
        _ = BenchRow("", "", 0.0, "SC(1)", goal, None, 0.0).goal_met


@pytest.mark.parametrize("width", [60, 80, 120])
def test_no_word_and_no_number_of_a_table_is_cut_or_leaves_the_window(width):
    words = ("minimum prime radius, translating", "beside SLSQP given the half-planes, 360 stations: off by -5.0e-06")
    numbers = ("0.864 SC(1000000)", "2.00 ± 0.05", "yes", "3000 µs", "371.7")
    rows = [("what", "of what", "ratio", "goal", "goal met", "here", "eps"), (*words, *numbers), (*words, *numbers)]
    lines = table_lines(rows, 2, width)
    assert max(map(len, lines)) <= width
    assert sum(all(number in line for number in numbers) for line in lines) == 2
    assert " ".join(": ".join(words).split()) in " ".join(" ".join(lines).split())
    # A second row of the same words does not say them again.
    assert len([line for line in lines if words[0] in line]) == 1


def _check(document) -> None:
    assert "seconds" not in json.dumps(document)
    for row in (row for section in reports.ROWS for row in document[section.key]):
        assert row["ratio"] > 0 or row["unit"].startswith("of ")  # of so many none was wrong
        assert row["goal_met"] in ((True, False) if row["goal"] else (None,))
    for method in document["error_against_time"]:
        assert len(method["n"]) == len(method["pairs"]) == len(method["errors"])
        assert min(method["pairs"]) > 0
    graphical = [m for m in document["error_against_time"] if m["kind"] == "graphical"]
    assert (
        {m["question"] for m in graphical}
        == set(drawn.questions())
        == {p["question"] for p in document["pencil_errors"]}
    )
    for m in graphical:
        assert m["errors"][-1] < m["errors"][0]
    for entry in document["drawing"]:
        assert entry["readings"] > 0
        assert entry["steps"] > 0
    assert set(document["rendering"]) == {"layout", "PDF", "PNG"}


def _check_waiting(rows, dragged) -> None:
    """What a user waits for, with a unit and a goal each, of every built-in task."""
    whole, *solved = rows
    assert (whole["name"], whole["goal"], whole["ratio"] > 1) == ("solve, all files", "<= 2.2", True)
    goals = {"layout": "<= 250", "step player": "<= 150", "view after a size changed": "<= 30"}
    assert {row["name"]: row["goal"] for row in solved} == goals
    for some in (solved, dragged):
        assert all(row["unit"] == "ms" and row["ratio"] > 0 for row in some)
        assert {row["what"].partition(",")[0] for row in some} == {*built_in()}
    assert (len(solved), len(dragged)) == (3 * len(built_in()), 9 + 10 + 6 + 7 + 12 + 9)


def test_a_folder_that_cannot_be_written_is_told_before_anything_is_measured(tmp_path, monkeypatch):
    def measured(*_):
        raise AssertionError

    monkeypatch.setattr("graphcam.bench.bench_report.measure", measured)
    (tmp_path / "file").write_text("in the way")
    result = CliRunner().invoke(app, ["bench", "--quick", "--out", str(tmp_path / "file")])
    assert result.exit_code == INPUT_ERROR_STATUS
    assert "cannot be written" in result.output
