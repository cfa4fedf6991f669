"""Photographs of several kinds, and what becomes of a trial: its journal, its figures, its table."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import trial
from figures import pooled, row, rows_of, table_of
from measuring import measured
from printed_courses import GIVEN_CAM, CourseKind
from scenes import KIND_SHARES, scene_of
from trial_goals import COURSES, SEED, check_goals, photographs, shared_scratch

pytestmark = pytest.mark.slow

RECORD = Path(__file__).parent / "record.json"


SEVERAL = (0, 3)
"""Photographs of two kinds; ``python tests/photos/trial.py`` takes thousands, of every kind."""


def test_photographs_of_several_kinds(tmp_path_factory: pytest.TempPathFactory) -> None:
    photos = photographs(SEVERAL, shared_scratch(tmp_path_factory))
    assert len({photo["kind"] for photo in photos}) == len(SEVERAL)
    check_goals(photos)


GIVEN_CAMS = (CourseKind(GIVEN_CAM, "A3", "colour", ("17", "18")),)


def test_the_pitch_curve_of_a_given_cam_is_read_beside_its_printed_outline(
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    scratch, kinds = shared_scratch(tmp_path_factory), ("careful", "mistake", "half")
    scenes = [scene_of(number, SEED, scratch, GIVEN_CAMS, kind=kind) for number, kind in enumerate(kinds)]
    assert all(set(scene.page.views) == {"analysis"} for scene in scenes)
    check_goals([measured(scene, scratch) for scene in scenes])


def test_a_photograph_is_told_by_its_number(tmp_path_factory: pytest.TempPathFactory) -> None:
    scratch = shared_scratch(tmp_path_factory)
    first, again, other = (scene_of(number, SEED, scratch, COURSES, kind="careful") for number in (0, 0, 1))
    assert first.jpeg == again.jpeg != other.jpeg


def test_all_kinds_together_are_all_photographs() -> None:
    assert sum(KIND_SHARES.values()) == pytest.approx(1.0)


def test_a_trial_goes_on_where_it_was_interrupted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    taken: list[int] = []

    def photograph(number: int, seed: int, scratch: Path) -> dict[str, object]:
        taken.append(number)
        return {"number": number, "kind": "careful", "megapixels": 12, "bend": "flat", "crash": "of no use"}

    monkeypatch.setattr(trial, "photograph", photograph)
    journal = tmp_path / "record.jsonl"
    trial.run([0, 1], 1, tmp_path, journal, 1, lambda done, total: None)
    # What a run that was killed leaves.
    with journal.open("a", encoding="utf-8") as file:
        file.write('{"seed": 1, "number": 2, "ki')
    records = trial.run([0, 1, 2], 1, tmp_path, journal, 1, lambda done, total: None)
    assert taken == [0, 1, 2]
    assert [record["number"] for record in records] == [0, 1, 2]
    # Another seed has other photographs.
    trial.run([0], 2, tmp_path, journal, 1, lambda done, total: None)
    assert taken == [0, 1, 2, 0]


def test_errors_of_all_photographs_are_pooled() -> None:
    photos = [{"off": [0.0, 1.0]}, {"off": [2.0, 3.0, 4.0]}, {}]
    assert pooled(photos, "off", 50) == 2.0
    assert pooled([{}], "off", 50) is None


def test_the_table_says_what_was_not_met_and_what_was_not_measured() -> None:
    rows = [row("this", "<= 1", 2.0, 3, met=False), row("that", "<= 1", None, 0, met=False)]
    assert table_of(rows).splitlines()[2:] == ["| this | <= 1 | 2 | 3 | NO |", "| that | <= 1 |  | 0 |  |"]


def test_there_is_a_row_for_every_check_without_a_photograph() -> None:
    rows = rows_of([])
    assert len(rows) > 20
    assert all(each.get("measured") in (None, 0.0) for each in rows)


def test_the_record_is_small_and_says_that_nothing_real_was_photographed() -> None:
    record = json.loads(RECORD.read_text(encoding="utf-8"))
    assert RECORD.stat().st_size < 100_000
    assert record["of"] == trial.OF
    assert record["photos"] >= 100
