"""The notebook of any task, and what ``graphcam notebook`` writes."""

from __future__ import annotations

import re
import subprocess
from dataclasses import replace
from html import unescape
from urllib.parse import unquote

import nbformat
import pytest
from browsers import opened
from over_all import over_all
from programs import program
from russian import english_words
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.cli.shared import INPUT_ERROR_STATUS
from graphcam.notebooks import changed, notebook_execution
from graphcam.notebooks.notebook_execution import execute
from graphcam.notebooks.notebook_folder import notebook_of, to_html
from graphcam.report.sheet_contents import names_of
from graphcam.tasks.material_table import MaterialTable
from graphcam.tasks.task import SpringTable
from graphcam.tasks.task_writer import task_files
from graphcam.tasks.tolerances_table import TolerancesTable

pytestmark = pytest.mark.slow

COURSEWORK, ARM, FLAT = (gc.builtin_task(name) for name in ("coursework", "arm", "flat"))
SMOOTH = tuple(
    changed(phase, {"law": "cycloidal"}) if phase.kind != "dwell" else phase for phase in COURSEWORK.motion.phases
)
SPRING = {"speed_rpm": 300.0, "spring": SpringTable(mass=0.5, stiffness=3.0)}
TASKS = {
    "coursework": COURSEWORK,
    "offset left open": changed(COURSEWORK, {"follower.offset": None, "limits.pressure_angle_return": 50.0}),
    "knife edge": changed(COURSEWORK, {"follower.roller_radius": 0.0}),
    "undercut": changed(
        COURSEWORK, {"motion.phases": SMOOTH, "cam.prime_radius": 30.0, "follower.roller_radius": 20.0}
    ),
    "A4, few parts": changed(
        COURSEWORK,
        {"drawing.format": "A4", "drawing.ordinate": 20.0, "drawing.poles": (12.0, 12.0), "drawing.divisions": 5},
    ),
    "spring": changed(COURSEWORK, SPRING),
    "arm": ARM,
    "arm, distance left open": changed(ARM, {"follower.distance": None, "cam.prime_radius": None}),
    "flat": FLAT,
    "flat with a spring": changed(FLAT, SPRING),
    "spring, material, tolerances": changed(
        COURSEWORK, {**SPRING, "material": MaterialTable(width=12.0), "tolerances": TolerancesTable((0.01,), (2,))}
    ),
    "measured": gc.builtin_task("measured"),
    "arcs": gc.builtin_arcs_task(),
}

EXECUTED = ("spring, material, tolerances", "arm, distance left open", "arcs")
"""A stem with all that a task may ask for, an arm, three arcs: the cells of the others are like theirs."""


def written(folder, task):
    for name, text in task_files(task).items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@over_all("name", TASKS)
def test_the_task_beside_a_notebook_is_the_task(name, tmp_path):
    assert gc.load_task(written(tmp_path, TASKS[name]) / "task.toml") == TASKS[name]


@over_all("name", TASKS)
def test_every_construction_has_its_chapter(name):
    notebook = notebook_of(gc.solve(TASKS[name]))
    nbformat.validate(notebook)
    source = "\n".join(cell.source for cell in notebook.cells)
    # Where a cell takes a construction from, there it is.
    solution = gc.solve(TASKS[name])
    taken = re.findall(r"show_steps\((solution[^,]*), within=solution", source)
    assert [eval(each, {"solution": solution}).name for each in taken] == names_of(solution)
    assert not any(cell.get("outputs") for cell in notebook.cells)
    assert nbformat.writes(notebook_of(gc.solve(TASKS[name]))) == nbformat.writes(notebook)


def in_russian(name):
    task = TASKS[name]
    titled = replace(task, title=replace(task.title, name="Кулачок"))  # the name is the user's
    return changed(titled, {"drawing.language": "ru"})


NAMES = ("graphcam", "None", "drawing.divisions", r"cam.prime\_radius")


@over_all("name", TASKS)
def test_a_russian_notebook_has_no_english_word_and_no_decimal_point(name):
    told = [cell.source for cell in notebook_of(gc.solve(in_russian(name))).cells if cell.cell_type == "markdown"]
    text = "\n".join(source for source in told if "```toml" not in source)
    assert english_words(text, NAMES) == set()
    assert re.findall(r"\d\.\d", text) == []


def test_a_russian_page_has_no_english_word(tmp_path):
    task = in_russian("arcs")
    page = to_html(execute(notebook_of(gc.solve(task)), written(tmp_path, task)), "Кулачок", "ru")
    # Without the player, which is looked at elsewhere, the task's file and the code of the questions.
    page = re.sub(r"<iframe.*?</iframe>|<style>.*?</style>|<pre.*?</pre>|<annotation.*?</annotation>", "", page,
                  flags=re.DOTALL)  # fmt: skip
    alts = re.findall(r'alt="([^"]*)"', page)
    pictures = [unquote(data) for data in re.findall(r"svg\+xml,([^\"]+)", page)]
    lettered = [text for picture in pictures for text in re.findall(r"<text[^>]*>(.*?)</text>", picture, re.DOTALL)]
    assert '<html lang="ru">' in page
    assert len(alts) >= 8
    assert lettered
    for text in (page, *lettered):
        assert english_words(unescape(re.sub(r"<[^>]*>", " ", text)), NAMES) == set()
    assert set().union(*map(english_words, alts)) == set()


def test_warnings_are_told():
    source = "\n".join(cell.source for cell in notebook_of(gc.solve(TASKS["undercut"])).cells)
    assert "**Note:** The profile cannot be cut" in source


def test_a_title_is_no_markup():
    task = replace(COURSEWORK, title=replace(COURSEWORK.title, name="Cam *A* <b>"))
    assert notebook_of(gc.solve(task)).cells[0].source.startswith("# Cam \\*A\\* \\<b\\>")


@over_all("name", EXECUTED)
def test_a_notebook_runs_beside_its_task(name, tmp_path):
    page = to_html(execute(notebook_of(gc.solve(TASKS[name])), written(tmp_path, TASKS[name])), name)
    images = re.findall(r"<img[^>]*>", page)
    assert len(images) >= 8
    assert all(re.search(r'alt="[^"]{20,}"', image) for image in images)
    assert max(map(len, images)) <= 200_000


def test_the_command_writes_notebook_page_and_print(tmp_path):
    program("chromium")
    done = CliRunner().invoke(app, ["notebook", "--out", str(tmp_path / "lesson"), "--execute", "--html", "--pdf"])
    assert done.exit_code == 0, done.output
    folder = tmp_path / "lesson"
    assert {path.name for path in folder.iterdir()} == {"notebook.ipynb", "notebook.html", "notebook.pdf", "task.toml"}
    about = subprocess.run([program("pdfinfo"), folder / "notebook.pdf"], capture_output=True, text=True, check=True)
    # What a student prints, and what a learning platform takes.
    assert 10 <= int(re.search(r"Pages: +(\d+)", about.stdout)[1]) <= 25
    assert (folder / "notebook.ipynb").stat().st_size <= 3_000_000
    assert any(cell.get("outputs") for cell in nbformat.read(folder / "notebook.ipynb", 4).cells)
    with opened(folder / "notebook.html") as (shown, wrong):
        assert shown.locator("figure img").count() > 20
        # The reason for each construction, in letters that need no typesetting.
        assert "μᵥ = μₛ/(μᵩ·H₂)" in shown.inner_text("body")
        assert shown.frame_locator("iframe").locator("svg").count() >= 1
    assert wrong == []


def test_without_options_nothing_is_executed(tmp_path):
    done = CliRunner().invoke(app, ["notebook", "--out", str(tmp_path)])
    assert done.exit_code == 0, done.output
    assert sorted(path.name for path in tmp_path.iterdir()) == ["notebook.ipynb", "task.toml"]
    assert not any(cell.get("outputs") for cell in nbformat.read(tmp_path / "notebook.ipynb", 4).cells)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["nowhere.toml"], "there is no file nowhere.toml; check the name"),
        (["--out", "/dev/null/x"], "the output '/dev/null/x' cannot be written"),
        (["--language", "xx"], "language is 'xx', but must be"),
    ],
)
def test_wrong_input_ends_with_one_message(words, message, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(app, ["notebook", *words])
    assert done.exit_code == INPUT_ERROR_STATUS
    said = [line for line in done.stderr.splitlines() if not line.endswith("...")]
    assert said[0].startswith(f"graphcam: {message}")
    assert list(tmp_path.iterdir()) == []


def test_a_missing_extra_is_named_and_nothing_is_left(tmp_path, monkeypatch):
    def missing(name):
        raise ImportError(name)

    monkeypatch.setattr(notebook_execution, "import_module", missing)
    done = CliRunner().invoke(app, ["notebook", "--out", str(tmp_path / "out"), "--execute"])
    assert done.exit_code == INPUT_ERROR_STATUS
    assert 'pip install ".[notebooks]"' in done.stderr
    assert not (tmp_path / "out").exists()


def test_without_chromium_there_is_one_message_before_anything_is_executed(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    done = CliRunner().invoke(app, ["notebook", "--out", str(tmp_path / "out"), "--pdf"])
    assert done.exit_code == INPUT_ERROR_STATUS
    assert "there is no Chromium to print it" in done.stderr
    assert not (tmp_path / "out").exists()
