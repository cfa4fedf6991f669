"""The published examples of the site: short, with a source, and with numbers that stand in the tests."""

from __future__ import annotations

import ast
import doctest
import runpy

import pytest
from pages import PAGES, ROOT

SCRIPTS = sorted((PAGES / "gallery" / "published").glob("*.py"))
LONGEST_SCRIPT = 25
KNOWN_IN = ("tests/data/cases.toml", "tests/mechanism/test_contact.py")
NAMES = {"printed", "known", "drawn"}
"""What a script calls the numbers of its source."""


def known_numbers(script):
    assigned = [node for node in ast.walk(ast.parse(script)) if isinstance(node, ast.Assign)]
    values = [node.value for node in assigned if isinstance(node.targets[0], ast.Name) and node.targets[0].id in NAMES]
    return {node.value for value in values for node in ast.walk(value) if isinstance(node, ast.Constant)}


def test_there_are_ten():
    assert len(SCRIPTS) == 10


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_a_published_example_is_short_and_true(path, capsys):
    script = path.read_text(encoding="utf-8")
    assert len(script.splitlines()) <= LONGEST_SCRIPT
    assert "\n\nSource: " in ast.get_docstring(ast.parse(script))
    known = " ".join((ROOT / name).read_text(encoding="utf-8") for name in KNOWN_IN)
    numbers = {number for number in known_numbers(script) if isinstance(number, int | float)}
    assert numbers
    assert [number for number in numbers if f"{number:g}" not in known] == []
    runpy.run_path(str(path))  # with its own assertion
    assert capsys.readouterr().out


def test_the_same_cam_in_the_words_of_other_programs():
    failed, tried = doctest.testfile(str(PAGES / "other-programs.md"), module_relative=False)
    assert tried > 0
    assert failed == 0
