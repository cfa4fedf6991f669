"""What the page has written: the files of ``solve``, of one cam, in the chosen folder and nowhere else."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import graphcam as gc
from graphcam.studio.local_studio import FILES_BY_CHOICE, WrittenFiles
from graphcam.studio.task_text import built_in_tasks, plain_task

TASK = plain_task(gc.builtin_task())
OTHER = {**TASK, "cam": {"prime_radius": 60}}


def names(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file()}


def radius(folder: Path) -> float:
    return json.loads((folder / "solution.json").read_text(encoding="utf-8"))["cam"]["prime_radius"]


def test_the_note_is_that_of_solve(tmp_path):
    written = WrittenFiles(tmp_path / "page").write({"kind": "note", "task": TASK})
    files = ["comparison.csv", "comparison.md", "note.md", "note.html"]
    assert written == {"files": files, "folder": str(tmp_path / "page")}
    gc.solve(gc.builtin_task()).write(tmp_path / "solve", ["csv", "md", "note", "note_html"])
    for name in names(tmp_path / "solve"):
        assert (tmp_path / "page" / name).read_bytes() == (tmp_path / "solve" / name).read_bytes()


@pytest.mark.slow
def test_the_folder_holds_one_cam(tmp_path):
    files = WrittenFiles(tmp_path)
    files.write({"kind": "note", "task": TASK})
    assert radius(tmp_path) == 44
    files.write({"kind": "working drawing", "task": OTHER})
    assert radius(tmp_path) == 60
    assert {"note.md", "working-drawing.pdf", "profile.step"} <= names(tmp_path)
    # The note that was asked for before has come along.
    assert "60" in (tmp_path / "note.md").read_text(encoding="utf-8")
    # A cam without a working drawing keeps nobody from its note, and has no drawing of another cam.
    part = {**TASK, "cam": {"prime_radius": 44}, "part": {"bore": 80}}
    refused = files.write({"kind": "working drawing", "task": part})
    assert refused["error"]["message"].startswith("part.bore")
    assert radius(tmp_path) == 60
    assert "note.md" in files.write({"kind": "note", "task": part})["files"]
    assert radius(tmp_path) == 44
    assert "working-drawing.pdf" not in names(tmp_path)


def test_the_notebook_has_a_folder_of_its_own_as_from_the_command(tmp_path):
    written = WrittenFiles(tmp_path).write({"kind": "notebook", "task": built_in_tasks()["measured"]})
    assert written == {"files": ["measured.csv", "notebook.ipynb", "task.toml"], "folder": str(tmp_path / "notebook")}
    assert names(tmp_path) == {f"notebook/{name}" for name in written["files"]}


@pytest.mark.slow
@pytest.mark.parametrize("kind", FILES_BY_CHOICE)
@pytest.mark.parametrize("name", ["coursework", "arcs"])
def test_every_kind_of_file_is_written(tmp_path, kind, name):
    written = WrittenFiles(tmp_path).write({"kind": kind, "task": built_in_tasks()[name]})
    assert set(written["files"]) == {Path(path).name for path in names(tmp_path)} - {"solution.json"}


@pytest.mark.parametrize(
    "file", ["../../x.csv", "..", "", "/etc/x", "notebook.ipynb", "x\0y", "con", "a\\..\\b", "x" * 300]
)
def test_the_page_cannot_name_the_file_of_a_table(tmp_path, file):
    task = json.loads(json.dumps(built_in_tasks()["measured"]))
    task["motion"]["table"]["file"] = file
    WrittenFiles(tmp_path / "a" / "b").write({"kind": "notebook", "task": task})
    assert names(tmp_path) == {f"a/b/notebook/{name}" for name in ("notebook.ipynb", "measured.csv", "task.toml")}


@pytest.mark.parametrize(
    "task",
    [None, {}, [], "x", {"rotation": "up"}, {**TASK, "drawing": {"language": 3}}, {**TASK, "drawing": 4},
     {**TASK, "drawing": {"language": "xx"}}],
)  # fmt: skip
def test_what_is_no_task_is_told_and_nothing_written(tmp_path, task):
    answer = WrittenFiles(tmp_path / "out").write({"kind": "note", "task": task})
    assert answer["error"]["message"]
    assert names(tmp_path) == set()


def test_a_folder_that_cannot_be_is_told(tmp_path):
    (tmp_path / "out").write_text("a file")
    answer = WrittenFiles(tmp_path / "out").write({"kind": "note", "task": TASK})
    assert "cannot be written" in answer["error"]["message"]


def test_files_of_others_are_replaced_only_when_that_is_asked_for(tmp_path):
    (tmp_path / "note.md").write_text("my own note", encoding="utf-8")
    files, request = WrittenFiles(tmp_path), {"kind": "note", "task": TASK}
    assert files.write(request) == {"others": ["note.md"], "folder": str(tmp_path)}
    assert names(tmp_path) == {"note.md"}
    assert "note.md" in files.write(request | {"replace": True})["files"]
    # What it has written itself it writes anew, until somebody has changed it.
    assert "note.md" in files.write({"kind": "note", "task": OTHER})["files"]
    assert radius(tmp_path) == 60
    (tmp_path / "comparison.md").write_text("changed", encoding="utf-8")
    assert files.write(request)["others"] == ["comparison.md"]
    assert radius(tmp_path) == 60


def test_another_session_does_not_replace_what_one_has_written(tmp_path):
    request = {"kind": "notebook", "task": TASK}
    WrittenFiles(tmp_path).write(request)
    assert set(WrittenFiles(tmp_path).write(request)) == {"others", "folder"}
