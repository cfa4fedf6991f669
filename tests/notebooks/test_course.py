"""The scripts of the course and the notebooks beside them; they are executed where the site is built of them."""

from __future__ import annotations

import re
import sys
import tomllib

import hard_cases
import jupytext
import nbformat
import pytest
from courses import COURSE, FOLDER
from over_all import over_all

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
    code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    assert any(re.search(r"^assert .*\d", cell, re.MULTILINE) for cell in code)
    # The cells to try give the reader's number and nothing else away, and a page shows the last line's verdict only.
    tried = [cell.source for cell in notebook.cells if "try-it" in cell.metadata.get("tags", ())]
    assert tried
    assert all(re.fullmatch(r"(your_\w+) = None  # .+\n\w+\.check\(\1\)\n?", cell) for cell in tried)


def test_the_hard_cases_of_the_course_are_those_of_the_table():
    """So the values that notebook 7 compares with are computed by mpmath at 50 digits, as all of the table's are."""
    shown = tomllib.loads((FOLDER / "hard_cases.toml").read_text(encoding="utf-8"))["case"]
    table = {row["name"]: row for row in tomllib.loads(hard_cases.TABLE.read_text(encoding="utf-8"))["drawn"]}
    assert len(shown) >= 6
    for case in shown:
        row = table[case["name"]]
        assert (case["phases"], case["reference"]) == (row["phases"], row[case["quantity"]])
        same = {"follower.offset": "offset", "follower.roller_radius": "roller", "cam.prime_radius": "prime_radius",
                "limits.pressure_angle_rise": "rise", "drawing.divisions": "divisions"}  # fmt: skip
        assert {key: case.get(key) for key in same} == {key: row.get(name) for key, name in same.items()}
