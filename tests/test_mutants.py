"""The tool that plants faults finds what the tests of a room miss, and changes nothing but its copy."""

from __future__ import annotations

import ast

import pytest
from mutants import ROOMS, ROOT, Room, equivalent, instead, judged, mutants, sample

TOY = '''"""Sums."""

def total(a: int | float, b: int | float) -> float:
    """As a child adds."""
    return a + b

def larger(a, b):
    return max(a, b)

def least(items):
    return sorted(items, reverse=False)[0]
'''
LISTED = """
[[mutant]]
file = "toy/sums.py"
old = "reverse=False"
new = "reverse=True"
why = "all are alike"
"""


def test_a_fault_that_no_test_finds_survives_and_one_that_is_found_is_killed(tmp_path, monkeypatch):
    monkeypatch.setattr("mutants.LIBRARIES", ())
    for name, text in {
        "toy/sums.py": TOY,
        "tests/test_sums.py": "from toy.sums import total\n\ndef test_total():\n    assert total(1, 2) == 3\n",
        "tests/mutants.toml": LISTED,
        "pyproject.toml": "[tool.pytest.ini_options]\npythonpath = ['.']\n",
    }.items():
        (path := tmp_path / name).parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    room = Room(("toy",), ("tests",))
    found = {mutant.difference(): (mutant.line, fate) for mutant, fate in judged(room, tmp_path, 99, seed=1)}
    assert found == {
        ("return a + b", "return a - b"): (5, "killed"),
        ("max(a, b)", "min(a, b)"): (8, "survived"),
        ("reverse=False", "reverse=True"): (11, "equivalent (all are alike)"),
        ("sorted(items, reverse=False)[0]", "sorted(items, reverse=False)[1]"): (11, "survived"),
    }
    assert (tmp_path / "toy/sums.py").read_text(encoding="utf-8") == TOY


@pytest.mark.parametrize(
    ("code", "faults"),
    [
        ("a <= b", ["a < b", "a > b"]),
        ("a and b", ["a or b"]),
        ("not a", ["a"]),
        ("-a", ["a"]),
        ("2.5", ["3.5"]),
        ("1j", ["-1j"]),
        ("0j", ["1j"]),
        ("a + 0j", []),
        ("True", ["False"]),
        ("min", ["max"]),
        ("z.real", ["z.imag"]),
        ("left", []),
        ("'text'", []),
    ],
)
def test_every_kind_of_fault_is_another_program(code, faults):
    found = [ast.unparse(each) for each in instead(ast.parse(code, mode="eval").body)]
    assert [each.strip("()") for each in found] == faults


def test_no_fault_is_planted_in_what_does_nothing_when_it_runs():
    code = '@wraps(1)\ndef f(a: int | None = None) -> 2:\n    "A text."\n    return zip(a, strict=True)\n'
    assert list(mutants("f.py", code)) == []


def test_the_same_seed_draws_the_same_faults():
    first, again, other = (sample(ROOMS["marking"], ROOT, 20, seed) for seed in (1, 1, 2))
    assert [each.source() for each in first] == [each.source() for each in again]
    assert [each.source() for each in first] != [each.source() for each in other]
    assert len({each.source() for each in first}) == 20


def test_every_fault_listed_as_no_fault_is_still_there_to_be_planted():
    listed = equivalent(ROOT)
    there = {
        (file, *mutant.difference())
        for file in {file for file, _, _ in listed}
        for mutant in mutants(file, (ROOT / file).read_text(encoding="utf-8"))
    }
    assert set(listed) <= there
