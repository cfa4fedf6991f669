"""The bars of every exercise, by Monte Carlo with other hands than those behind the certificates."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from issued_variants import SECRET
from over_all import over_all, over_seeds
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.exercises.definition.exercise_file import find_exercise, library
from graphcam.exercises.definition.student_hands import HANDS as HANDS_OF
from graphcam.exercises.grading import course_speed
from graphcam.exercises.grading.course_grading import grade_course
from graphcam.exercises.grading.course_speed import HANDS, SECRET as SPEED_SECRET, simulated
from graphcam.exercises.grading.grade_one import Assignment, grade
from graphcam.exercises.marking.simulate import simulate

FEWEST_VARIANTS = 60
EXERCISES = Path(__file__).parents[2] / "exercises"


def simulated_record(name: str) -> dict[str, Any]:
    """What 'graphcam exercise simulate NAME --variants 60 --hands 100' found, as it is kept."""
    return json.loads((EXERCISES / "simulated" / f"{name}.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("name", library())
def test_many_variants_are_separable_and_keep_the_bars(name: str):
    exercise, found = find_exercise(name), simulated_record(name)
    # An exercise that was changed must be simulated again.
    assert (found["exercise"], found["version"]) == (name, exercise.version)
    assert set(found["rows"]) == set(exercise.misconceptions)
    assert found["variants"] == sum(found["issued"]) >= FEWEST_VARIANTS
    hands = found["careful"]
    assert hands >= 100 * found["variants"]
    assert all(row["hands"] == hands == sum(row["named"].values()) for row in found["rows"].values())
    assert found["false_rejections"] == found["losing"] / found["careful"] <= exercise.careful == 0.02
    accepted = sum(row["accepted"] for row in found["rows"].values())
    assert found["false_acceptances"] == accepted / sum(row["hands"] for row in found["rows"].values()) <= 0.005
    assert found["right_diagnoses"] >= 0.99
    # Mistakes that are not looked for may be given a name in 3 %, and no copy earns more than about half.
    assert found["outside_named"] <= 0.03
    # Nor may one that the exercise does not list keep all marks in more.
    assert found["unlisted_kept"] <= 0.03
    assert found["copies"]["above_half"] <= 0.005 * found["copies"]["pairs"]
    assert all(found["populations"][hand]["hands"] == hands for hand in HANDS_OF)
    assert found["populations"]["careful"]["losing"] <= found["losing"] <= found["populations"]["first-year"]["losing"]


@pytest.mark.parametrize("name", library())
def test_the_readme_says_what_was_found(name: str):
    found = simulated_record(name)
    losing = [found["populations"][hand]["losing"] / found["careful"] for hand in ("careful", "first-year")]
    rates = [found["false_rejections"], *losing, found["false_acceptances"], found["right_diagnoses"]]
    told = [f"{rate:.2%}" for rate in [*rates, found["outside_named"]]]
    told += [f"{found['copies']['best']:.0%}", f"{found['unlisted_kept']:.2%}"]
    row = f"| `{name}` | {found['draws']:.2f} | {len(found['issued'])} | {' | '.join(told)} |".replace("%", " %")
    assert row in (EXERCISES / "README.md").read_text(encoding="utf-8").splitlines()


@pytest.mark.slow
@over_all("name", library())
@over_seeds(1)
def test_careful_hands_pass_and_mistakes_are_named(name, seed):
    """In every variant that is issued, not on average alone: of what each student may be given."""
    found = simulate(find_exercise(name), f"{SECRET!r} {seed}".encode(), variants=1, hands=100)
    # 2 % of 100 hands are 2; a rate of 2 % gives more than 7 once in a thousand runs.
    assert found.losing <= 7
    assert found.false_acceptances <= 0.005
    assert found.right_diagnoses >= 0.99
    for mistake, row in found.rows.items():
        assert row.named_share(mistake) >= 0.95, (mistake, row.named)


@pytest.mark.parametrize(
    ("name", "why"), [("there.json", "it already exists"), ("nowhere/new.json", "its folder does not exist")]
)
def test_a_wrong_place_for_the_figures_is_told_before_anything_is_simulated(tmp_path, monkeypatch, name, why):
    (tmp_path / "there.json").write_text("kept", encoding="utf-8")
    monkeypatch.setattr("graphcam.exercises.marking.simulate.simulate", None)
    result = CliRunner().invoke(app, ["exercise", "simulate", "integration", "--out", str(tmp_path / name)])
    assert result.exit_code == 2
    assert why in " ".join(result.output.split())
    assert (tmp_path / "there.json").read_text(encoding="utf-8") == "kept"


def test_the_figures_are_printed_as_json():
    result = CliRunner().invoke(
        app, ["exercise", "simulate", "acceleration-and-scales", "--variants", "1", "--hands", "20", "--json"]
    )
    figures = json.loads(result.stdout)
    assert figures["careful"] == 20
    assert set(figures["rows"]) == set(find_exercise("acceleration-and-scales").misconceptions)
    assert all(sum(row["named"].values()) == 20 for row in figures["rows"].values())


def test_a_bound_that_no_hand_keeps_fails_everybody(monkeypatch):
    # The figures can fail: with a bound that no hand keeps everybody loses a point.
    from dataclasses import replace

    from graphcam.exercises.marking import simulate as module

    course_variants = module.course_variants

    def strict(*arguments):
        return ((variant, replace(key, bound=1e-3)) for variant, key in course_variants(*arguments))

    monkeypatch.setattr(module, "course_variants", strict)
    assert simulate(find_exercise("integration"), SECRET, 1, 20).false_rejections == 1.0


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # of the cluster's own closing
def test_processes_and_a_cluster_count_the_same():
    from distributed import LocalCluster

    exercise = find_exercise("integration")
    one = simulate(exercise, SECRET, 3, 10)
    assert one.careful == 30
    assert simulate(exercise, SECRET, 3, 10, workers=2) == one
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        assert simulate(exercise, SECRET, 3, 10, cluster=cluster.scheduler_address) == one


@pytest.mark.slow
def test_what_is_timed_is_the_work_that_hand_ins_make():
    """Careful ones are read and earn their marks, curves too; in the others the mistake is found."""
    exercise = find_exercise("inversion-translating")
    submissions = simulated(exercise)
    known = submissions[0][0].answer_key
    careful, wrong = ([grade(Assignment(exercise, SPEED_SECRET), each) for each in some] for some in submissions)
    # The key that is known is not made again.
    assert known
    assert {each.answer_key for each in [*careful, *wrong]} == {""}
    assert not any(each.record.notes for each in [*careful, *wrong])
    assert sum(each.record.total == exercise.marks for each in careful) >= 0.9 * HANDS
    assert sum(each.record.diagnosis is not None for each in wrong) >= 0.9 * HANDS * len(exercise.misconceptions)


@pytest.mark.slow
def test_the_speed_of_marking_is_printed():
    result = CliRunner().invoke(app, ["exercise", "speed", "acceleration-and-scales"])
    row = next(line for line in result.stdout.splitlines() if "acceleration-and-scales" in line)
    careful, wrong, course, papers = (float(cell) for cell in re.findall(r"[\d.]+", row))
    assert min(careful, wrong, course, papers) > 0


def test_the_course_that_is_timed_is_graded_as_any_other(tmp_path, monkeypatch):
    """Every folder has its record, with the marks of careful students."""
    monkeypatch.setattr(course_speed, "GRADED_STUDENTS", 70)
    exercise = find_exercise("integration")
    course = course_speed.course_at(tmp_path, "integration", exercise)
    kept = sorted(path.read_bytes() for path in (tmp_path / "teacher" / "certificates").iterdir())
    grade_course(course)
    records = json.loads(course.out.with_suffix(".json").read_text(encoding="utf-8"))
    assert len(records) == 70
    assert not any(record["notes"] for record in records)
    assert sum(record["total"] == exercise.marks for record in records) >= 0.9 * 70
    # No answer key was made anew, which would take longer than all else.
    assert sorted(path.read_bytes() for path in (tmp_path / "teacher" / "certificates").iterdir()) == kept
