"""The files of a solution: all there, named where they are, readable, the same every time."""

from __future__ import annotations

import csv
import json

import ezdxf
import pytest
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.drafting.pencil import Pencil
from graphcam.files import digest
from graphcam.report.output_folder import write
from graphcam.solving.solve import solve
from graphcam.tasks.task_file import builtin_task

REPEATABLE = ("solution.json", "comparison.csv", "comparison.md", "note.md", "note.html", "player.html")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder with the built-in task's files, and what ``write`` said of them."""
    place = tmp_path_factory.mktemp("solved") / "out"
    return place, write(solve(builtin_task()), place)


@pytest.fixture(scope="module")
def document(folder):
    """``solution.json``, read as strictly as it must be written."""

    def refuse(word: str):
        raise AssertionError(f"{word} is not JSON")

    return json.loads((folder[0] / "solution.json").read_text(encoding="utf-8"), parse_constant=refuse)


def test_files_are_written_and_named(folder, document):
    place, files = folder
    written = {path.name: digest(path) for path in place.iterdir() if path.name != "solution.json"}
    spline = document["profile_spline"]
    assert spline["degree"] == 3
    assert 0 < spline["deviation"] <= 0.0005
    assert document == solve(builtin_task()).to_dict() | {"files": files, "profile_spline": spline, "written": written}
    named = {name for name in files.values() if name}
    assert named == {
        "sheet.pdf", "sheet.svg", "sheet.png", "sheet.dxf", "comparison.csv", "comparison.md", "note.md", "note.html",
        "player.html",
        "profile.dxf", "profile.csv", "profile.xyz",
    }  # fmt: skip
    assert {path.name for path in place.iterdir()} == named | {"solution.json"}
    assert all((place / name).stat().st_size > 0 for name in named)


def test_csv_says_what_the_json_says(folder, document):
    with (folder[0] / "comparison.csv").open(newline="", encoding="utf-8") as file:
        rows = {row["quantity"]: row for row in csv.DictReader(file)}
    assert rows.keys() == document["quantities"].keys()
    columns = {"drawn": "drawn", "exact": "exact", "error": "error", "error_paper_mm": "error_paper",
               "tolerance_paper_mm": "tolerance_paper"}  # fmt: skip
    for name, q in document["quantities"].items():
        assert rows[name]["unit"] == q["unit"]
        for column, key in columns.items():
            assert float(rows[name][column]) == q[key]


def test_a_quantity_that_a_follower_does_not_have_is_an_empty_cell(tmp_path):
    write(solve(builtin_task("flat")), tmp_path / "out")
    text = (tmp_path / "out" / "comparison.csv").read_text(encoding="utf-8")
    assert "minimum_offset,,,,,," in text or "minimum_offset,mm,,,,," in text
    assert "nan" not in text


@pytest.mark.slow
def test_two_runs_write_the_same(folder, tmp_path):
    write(solve(builtin_task()), tmp_path)
    for name in REPEATABLE:
        assert (tmp_path / name).read_bytes() == (folder[0] / name).read_bytes()


def test_two_runs_of_one_hand_draw_the_same():
    first, second = (solve(builtin_task(), Pencil(line=0.2, dividers=0.2, seed=3)).to_dict() for _ in range(2))
    assert first == second
    assert first != solve(builtin_task(), Pencil(line=0.2, dividers=0.2, seed=4)).to_dict()


def test_many_hands_at_once():
    """Of a sampled pencil the first drawing is told; the sizes are those of a hand without error."""
    solution = solve(builtin_task(), Pencil(line=0.2, dividers=0.2, samples=50))
    document = solution.to_dict()
    json.dumps(document, allow_nan=False)
    assert document["cam"] == solve(builtin_task()).to_dict()["cam"]
    scatter = solution.drawn["minimum_radius"].readings["prime_radius"].value
    assert scatter.shape == (50,)
    assert document["quantities"]["minimum_prime_radius"]["drawn"] == scatter[0]
    assert 0.05 < scatter.std() < 1.5
    for name, q in document["quantities"].items():
        assert abs(q["error_paper"]) <= q["tolerance_paper"], name


@pytest.fixture
def printed(tmp_path, monkeypatch):
    """What ``graphcam solve`` with more words prints as JSON."""
    monkeypatch.chdir(tmp_path)

    def run(*words: str):
        result = CliRunner().invoke(app, ["solve", "--json", *words])
        assert result.exit_code == 0, result.output
        return json.loads(result.stdout)

    return run


def test_the_command_line_prints_the_json_alone(printed, document, tmp_path):
    own = {key: told for key, told in document.items() if key not in ("written", "profile_spline")}
    assert printed() == own | {"files": dict.fromkeys(document["files"])}
    assert list(tmp_path.iterdir()) == []


def test_divisions_reach_the_drawing(printed):
    document = printed("--divisions", "24")
    assert document["task"]["drawing"]["divisions"] == 24
    assert len(document["stations"]) == 2 * 25


def test_pencil_and_seed_reach_the_drawing(printed, document):
    one, other = printed("--pencil", "0.2"), printed("--pencil", "0.2", "--seed", "1")
    drawn = [each["quantities"]["max_v"]["drawn"] for each in (document, one, other)]
    assert len(set(drawn)) == 3
    exact = [each["quantities"]["max_v"]["exact"] for each in (document, one, other)]
    assert len(set(exact)) == 1


@pytest.mark.slow
def test_a_dxf_for_cad_programs_has_dimensions(tmp_path):
    result = CliRunner().invoke(app, ["solve", "--dxf", "cad", "--out", str(tmp_path)])
    assert result.exit_code == 0
    assert ezdxf.readfile(tmp_path / "sheet.dxf").modelspace().query("DIMENSION")


def test_an_unknown_kind_of_dxf_leaves_nothing(tmp_path):
    result = CliRunner().invoke(app, ["solve", "--dxf", "dwg", "--out", str(tmp_path / "new")])
    assert result.exit_code == INPUT_ERROR_STATUS
    assert "dxf is 'dwg', but must be one of plain, cad" in result.output
    assert not (tmp_path / "new").exists()
