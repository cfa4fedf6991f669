"""``solution.write``: exactly the files that are asked for, or none."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.files import OutputError, digest
from graphcam.report import output_folder
from graphcam.solving.shown_solution import FILE_KINDS
from graphcam.tasks.task import CamTable
from graphcam.tasks.task_writer import task_files


@pytest.fixture(scope="module", params=["coursework", "arcs"])
def solution(request):
    return gc.solve(gc.builtin_arcs_task() if request.param == "arcs" else gc.builtin_task())


def there(folder):
    return {path.name for path in folder.iterdir()}


def listed(folder):
    return json.loads((folder / "solution.json").read_text(encoding="utf-8"))["written"]


@pytest.mark.parametrize("kinds", [("pdf",), ("svg", "csv"), ["player"], {"note", "md"}, ()])
def test_what_is_asked_for_is_written(solution, tmp_path, kinds):
    files = solution.write(tmp_path / "out", kinds)
    assert list(files) == list(FILE_KINDS)
    assert {kind for kind, name in files.items() if name} == set(kinds)
    assert there(tmp_path / "out") == {name for name in files.values() if name} | {"solution.json"}
    assert json.loads((tmp_path / "out" / "solution.json").read_text(encoding="utf-8"))["files"] == files


def test_parts_of_the_profile(tmp_path):
    files = gc.solve(gc.builtin_task()).write(tmp_path, ["profile_xyz"])
    assert files["profile_xyz"] == "profile.xyz"
    assert there(tmp_path) == {"profile.xyz", "solution.json"}
    # A cam of arcs has no such file.
    arcs = gc.solve(gc.builtin_arcs_task())
    assert set(arcs.write(tmp_path / "arcs", ["profile_xyz"]).values()) == {None}


@pytest.mark.slow
def test_a_part_is_the_same_as_in_the_whole(tmp_path):
    solution = gc.solve(gc.builtin_task())
    solution.write(tmp_path / "all")
    for kind in ("csv", "player", "profile_dxf"):
        files = solution.write(tmp_path / kind, [kind])
        assert (tmp_path / kind / files[kind]).read_bytes() == (tmp_path / "all" / files[kind]).read_bytes()


def test_one_kind_alone_is_told_how_it_is_written(solution, tmp_path):
    with pytest.raises(gc.DesignError, match=r"files is 'pdf', but must be a list of kinds; .* write \['pdf'\]"):
        solution.write(tmp_path / "out", "pdf")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("files", [["pdf", "pfd"], ["json"]])
def test_an_unknown_kind_is_refused_by_naming_all(solution, tmp_path, files):
    with pytest.raises(
        gc.DesignError, match=r"must be a list of kinds among pdf, svg, png, dxf, csv, md, note, note_html, player"
    ):
        solution.write(tmp_path / "out", files)
    assert not (tmp_path / "out").exists()


def test_an_error_leaves_nothing(solution, tmp_path, monkeypatch):
    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(output_folder, "player_of", fail)
    with pytest.raises(OutputError, match=r"out' cannot be written \(No space left on device\); make room on the disk"):
        solution.write(tmp_path / "out", ["csv", "player"])
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("upto", [0, "displacement"])
def test_beside_an_unfinished_sheet_stand_no_answers(solution, tmp_path, upto):
    upto = 0 if upto == 0 else list(solution.drawn)[1]
    files = solution.write(tmp_path, ["svg", *FILE_KINDS[4:]], upto=upto)
    assert {kind for kind, name in files.items() if name} == {"svg"}
    assert there(tmp_path) == {"worksheet.svg", "solution.json"}
    document = json.loads((tmp_path / "solution.json").read_text(encoding="utf-8"))
    assert document == {
        "graphcam": gc.__version__,
        "task": solution.task.to_dict(),
        "files": files,
        "written": {"worksheet.svg": digest(tmp_path / "worksheet.svg")},
    }


@pytest.mark.slow
def test_the_command_line_tells_no_answers_of_a_worksheet(tmp_path, monkeypatch):
    """Neither in its table, nor in its warnings, nor as JSON."""
    (tmp_path / "cam.toml").write_text(
        *task_files(replace(gc.builtin_task(), cam=CamTable(prime_radius=30.0))).values()
    )
    monkeypatch.chdir(tmp_path)
    whole = CliRunner().invoke(app, ["solve", "cam.toml", "--json"])
    assert "warning" in whole.stderr
    told = CliRunner().invoke(app, ["solve", "cam.toml", "--worksheet", "--out", "out"])
    sheets = [f"worksheet{end}" for end in (".dxf", ".pdf", ".png", "-2.png", ".svg", "-2.svg")]
    assert told.stdout.splitlines() == [
        "",
        "out: 7 files",
        f"  {', '.join(sheets)}: the sheet to be finished, true to scale",
        "  solution.json: all of it, for programs",
        "Open first: out/worksheet.pdf (print at 100 %)",
    ]
    assert all(line.endswith("...") for line in told.stderr.splitlines())
    as_json = json.loads(CliRunner().invoke(app, ["solve", "cam.toml", "--worksheet", "--json"]).stdout)
    assert as_json == {key: json.loads(whole.stdout)[key] for key in ("graphcam", "task", "files")}


def on_paper(paper):
    task = gc.builtin_task()
    return gc.solve(replace(task, drawing=replace(task.drawing, format=paper)))


def test_the_folder_is_the_runs(tmp_path):
    """Of a run before, all goes that the new one does not write: further pages, worksheets, what was not asked for."""
    small, large = on_paper("A3"), on_paper("A1")
    small.write(tmp_path, ["svg", "csv"])
    first = there(tmp_path)
    assert {"sheet.svg", "sheet-2.svg", "comparison.csv"} <= first
    assert set(listed(tmp_path)) == first - {"solution.json"}, "the list is complete"
    small.write(tmp_path, ["svg"], upto=0)
    assert {"worksheet.svg", "worksheet-2.svg"} <= there(tmp_path)
    assert not there(tmp_path) & (first - {"solution.json"})
    large.write(tmp_path, ["svg"])
    assert there(tmp_path) == {"sheet.svg", "solution.json"}


def test_what_is_not_the_runs_stays(tmp_path):
    on_paper("A3").write(tmp_path, ["svg"])
    drawn_on, linked = tmp_path / "sheet-2.svg", tmp_path / "sheet-3.svg"
    drawn_on.write_text(drawn_on.read_text(encoding="utf-8") + "<!-- mine -->", encoding="utf-8")
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    linked.replace(elsewhere / "sheet-3.svg")
    linked.symlink_to(elsewhere / "sheet-3.svg")
    (tmp_path / "sheet-9.svg").write_text("mine")
    on_paper("A1").write(tmp_path, ["svg"])
    assert there(tmp_path) == {
        "sheet.svg", "solution.json", "sheet-2.svg", "sheet-3.svg", "sheet-9.svg", "elsewhere",
    }  # fmt: skip
    assert drawn_on.read_text(encoding="utf-8").endswith("<!-- mine -->")
    assert (elsewhere / "sheet-3.svg").exists()


@pytest.mark.parametrize(
    "text",
    ["", "{", "[]", "[" * 100_000, "\0", '"written"', '{"written": ["mine"]}', '{"written": {"mine": 1, "..": null}}'],
)
def test_a_list_that_is_none_costs_no_file(tmp_path, text):
    (tmp_path / "mine").write_text("mine")
    (tmp_path / "solution.json").write_text(text)
    gc.solve(gc.builtin_task()).write(tmp_path, ["csv"])
    assert there(tmp_path) == {"mine", "comparison.csv", "solution.json"}


def test_a_list_reaches_no_other_folder(tmp_path):
    (tmp_path / "mine").write_text("mine")
    known = digest(tmp_path / "mine")
    out = tmp_path / "out"
    out.mkdir()
    names = ["../mine", str(tmp_path / "mine"), "..", ".", ""]
    (out / "solution.json").write_text(json.dumps({"written": dict.fromkeys(names, known)}))
    gc.solve(gc.builtin_task()).write(out, ["csv"])
    assert there(tmp_path) == {"mine", "out"}
