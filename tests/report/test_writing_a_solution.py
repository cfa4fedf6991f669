"""``solution.write``: exactly the files that are asked for, or none."""

from __future__ import annotations

import json

import pytest

import graphcam as gc
from graphcam.report import output_folder
from graphcam.solving.shown_solution import FILES


@pytest.fixture(scope="module", params=["coursework", "arcs"])
def solution(request):
    return gc.solve(gc.builtin_arcs_task() if request.param == "arcs" else gc.builtin_task())


def there(folder):
    return {path.name for path in folder.iterdir()}


@pytest.mark.parametrize("kinds", [("pdf",), ("svg", "csv"), ["player"], {"note", "md"}, ()])
def test_what_is_asked_for_is_written(solution, tmp_path, kinds):
    files = solution.write(tmp_path / "out", kinds)
    assert list(files) == list(FILES)
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
        gc.DesignError, match=r"must be a list of kinds among pdf, svg, png, dxf, csv, md, note, player"
    ):
        solution.write(tmp_path / "out", files)
    assert not (tmp_path / "out").exists()


def test_an_error_leaves_nothing(solution, tmp_path, monkeypatch):
    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(output_folder, "player_of", fail)
    with pytest.raises(OSError, match="No space left"):
        solution.write(tmp_path / "out", ["csv", "player"])
    assert list(tmp_path.iterdir()) == []


def test_a_worksheet_alone(solution, tmp_path):
    files = solution.write(tmp_path, ["pdf", "player"], upto=0)
    assert files["pdf"] == "worksheet.pdf"
    assert files["player"] is None
