"""The scripts of the course and the notebooks beside them; they are executed where the site is built of them."""

from __future__ import annotations

import re
import sys
import tomllib
from contextlib import chdir
from pathlib import Path
from typing import Any

import hard_cases
import jupytext
import nbformat
import pytest
from courses import COURSE, FOLDER
from over_all import over_all

import graphcam as gc
from graphcam.notebooks import changed, lesson_task
from graphcam.tasks.task_file import task_from
from graphcam.tasks.task_writer import task_files

sys.path.append(str(FOLDER))
import pair

pytestmark = pytest.mark.slow

PARTS = ("**Aim.**", "**You need**", "**Time:**", "## Background", "## Try it yourself", "## Drawn and exact",
         "## Where the error comes from", "## Questions")  # fmt: skip
"""What every notebook has, in this order; its background may bear a title of its own."""


@over_all("name", COURSE)
def test_what_a_double_click_opens_is_the_script_without_outputs(name):
    """``python notebooks/pair.py`` writes them again after a change of the scripts."""
    script = FOLDER / f"{name}.py"
    text = script.with_suffix(".ipynb").read_text(encoding="utf-8")
    assert text == pair.notebook_text(script), "python notebooks/pair.py"
    notebook = nbformat.reads(text, as_version=4)
    nbformat.validate(notebook)
    assert notebook.metadata.kernelspec.name == "python3"
    code = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert all(cell.outputs == [] and cell.execution_count is None for cell in code)
    # Read back as a script it is the same course, cell by cell.
    assert [cell.source for cell in notebook.cells] == [cell.source for cell in jupytext.read(script).cells]


def test_every_script_has_its_notebook_and_nothing_else_is_stored():
    found = {path.name for path in FOLDER.iterdir() if path.is_file()}
    assert found == {
        "README.md",
        "pair.py",
        "task.toml",
        "hard_cases.toml",
        *(f"{name}{end}" for name in COURSE for end in (".py", ".ipynb")),
    }


@over_all("name", COURSE)
def test_a_notebook_has_its_parts_and_asserts_a_number(name):
    notebook = jupytext.read(FOLDER / f"{name}.py")
    text = "\n".join(cell.source for cell in notebook.cells if cell.cell_type == "markdown")
    places = [text.find(part) for part in PARTS if part != "## Background"]
    assert -1 not in places, PARTS[places.index(-1)]
    assert places == sorted(places)
    assert text.startswith(f"# {int(name[:2])}. ")
    asked, answered = text[places[-1] :].split("<details><summary>Model answers</summary>")
    assert re.findall(r"^\d+\. ", asked, re.MULTILINE) == re.findall(r"^\d+\. ", answered, re.MULTILINE) != []
    code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    assert any(re.search(r"^assert .*\d", cell, re.MULTILINE) for cell in code)
    # The cells to try give the reader's number and nothing else away, and a page shows the last line's verdict only.
    tried = [cell.source for cell in notebook.cells if "try-it" in cell.metadata.get("tags", ())]
    assert tried
    assert all(re.fullmatch(r"(your_\w+) = None  # .+\n\w+\.check\(\1\)\n?", cell) for cell in tried)


BEATS = dict.fromkeys(("01", "02", "03", "04", "05", "06", "08", "09", "13"), "pdw") | {"10": "pw", "12": "pw"}
"""By notebook whether it lets predict a construction, draw it on a half-done sheet, and write its method.

Notebook 10 draws the whole sheet, and the phase plane of notebook 12 needs none.
"""
MAX_MODEL_LINES = 8


@over_all("name", [name for name in COURSE if name[:2] in BEATS])
def test_a_construction_is_predicted_drawn_written_and_compared(name):
    cells = jupytext.read(FOLDER / f"{name}.py").cells
    text = "\n".join(cell.source for cell in cells if cell.cell_type == "markdown")
    beats = BEATS[name[:2]]
    assert ("**Predict" in text) is ("p" in beats)
    assert ("--upto" in text) is ("d" in beats)
    assert ("**Write it.**" in text) is ("w" in beats)
    # What is printed half-done ends with a construction that the sheet has.
    own = re.findall(r"```toml\n(.*?)```", text, re.DOTALL)
    drawn = gc.solve(task_from(tomllib.loads(own[0])) if own else gc.builtin_task()).drawn
    for upto in re.findall(r"--upto ([\w.]*\w)", text):
        chapter, _, step = upto.partition(".")
        assert upto in drawn or int(step) < len(drawn[list(drawn)[int(chapter) - 1]].steps())
    lines = [cell.source for cell in cells if "hide-input" in cell.metadata.get("tags", ())]
    assert len(lines) == ("w" in beats)
    for source in lines:
        body = [line for line in source.splitlines() if line.strip() and not line.strip().startswith(('"""', "print("))]
        assert len(body) <= MAX_MODEL_LINES
    # The model lines are judged by the questions that ask for them, where the notebook is executed.
    asked = re.findall(r"^(\w+) = ArrayQuestion\(", "\n".join(cell.source for cell in cells), re.MULTILINE)
    checked = "\n".join(cell.source for cell in cells if "remove-cell" in cell.metadata.get("tags", ()))
    assert all(f"{question}.check(" in checked for question in asked)


def test_the_hard_cases_of_the_course_are_those_of_the_table():
    """So the values that notebook 7 compares with are computed by mpmath at 50 digits, as all of the table's are."""
    shown = tomllib.loads((FOLDER / "hard_cases.toml").read_text(encoding="utf-8"))["case"]
    table = {row["name"]: row for row in tomllib.loads(hard_cases.TABLE.read_text(encoding="utf-8"))["drawn"]}
    assert len(shown) >= 6
    for case in shown:
        row = table[case["name"]]
        assert (case["phases"], case["reference"]) == (row["phases"], row[case["quantity"]])
        same = {"cam.prime_radius": "prime_radius", "limits.pressure_angle_rise": "rise",
                "drawing.divisions": "divisions"}  # fmt: skip
        assert {key: case.get(key) for key in same} == {key: row.get(name) for key, name in same.items()}
        usual, follower = 10.0, row["follower"]
        assert case.get("follower.offset", usual) == follower.get("offset", "open")
        assert case.get("follower.roller_radius") == follower.get("roller_radius")


@pytest.mark.parametrize(
    ("name", "goes_on"), [("flat", True), ("arm", True), ("measured", False), ("coursework", False)]
)
def test_a_lesson_that_needs_another_follower_goes_on_with_the_built_in_cam(name, goes_on, tmp_path, capsys):
    for file, text in task_files(gc.builtin_task(name)).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    task = lesson_task(tmp_path / "task.toml", "translating")
    assert (task != gc.builtin_task(name)) is goes_on
    assert ("Markdown object" in capsys.readouterr().out) is goes_on
    assert task.follower.kind == "translating"
    # A given cam has the radius that a lesson seeks.
    given = Path(__file__).parents[1] / "given-cam.toml"
    assert lesson_task(given, "translating") == lesson_task(given) != gc.load_task(given)
    by_laws = lesson_task(tmp_path / "task.toml", by_laws=True)
    assert by_laws.motion.phases is not None
    assert not goes_on or {getattr(phase, "law", "3-4-5") for phase in task.motion.phases} == {"3-4-5"}


OTHER_TASKS = {
    "anticlockwise, central": {"rotation": "ccw", "follower.offset": 0.0},
    "constant acceleration": {"rotation": "cw"},
    "unequal parts of the laws": {
        "motion.phases": tuple(
            changed(phase, {"ratio": 1.8}) if phase.kind != "dwell" else phase
            for phase in gc.builtin_task().motion.phases
        ),
        "drawing.divisions": 6,
    },
    "few parts, another pole": {"drawing.divisions": 8, "drawing.poles": (50.0, 30.0), "drawing.ordinate": 40.0},
}
FOLLOWING = ("01", "02", "03", "04", "05", "06", "09", "10")
"""The notebooks that follow the task, but for 7, which takes longer."""


@over_all("name", OTHER_TASKS)
def test_the_course_takes_another_task(name, tmp_path, monkeypatch):
    """All cells, in this process, without steps and sliders; its assertions hold for the other task as well."""
    # Not the room itself, which graphcam does not take back once it has been another.
    monkeypatch.setattr(type(gc.studio), "__call__", staticmethod(lambda *_, **__: None))
    task = changed(gc.builtin_task(), OTHER_TASKS[name])
    for file, text in task_files(task).items():
        (tmp_path / file).write_text(text, encoding="utf-8")
    with chdir(tmp_path):
        for script in sorted(path for path in FOLDER.glob("[0-9][0-9]_*.py") if path.name[:2] in FOLLOWING):
            shown: list[object] = []
            names: dict[str, Any] = {"display": shown.append}
            for cell in jupytext.read(script).cells:
                if cell.cell_type == "code":
                    exec(compile(cell.source, str(script), "exec"), names)
                    names |= dict.fromkeys(("show_steps", "explore"), lambda *_, **__: None)
            assert names["task"].rotation == task.rotation
