"""The command that tries tests over seeds with others than the suite runs."""

from __future__ import annotations

import pytest
from over_all import over_seeds
from random_cases import main

FILE = """
from over_all import over_seeds

@over_seeds(2)
def test_small(seed):
    assert seed < 12, "large"

@over_seeds(2)
def test_any(seed):
    pass

def test_without_seeds():
    assert False
"""


@pytest.mark.parametrize(
    ("arguments", "said", "status"),
    [
        (["--cases", "4", "--seed", "10"], ["test_small, seed 12: ", "test_small, seed 13: ", "2 of 8 fail"], 1),
        (["--cases", "4"], ["0 of 8 fail"], 0),
        (["--cases", "4", "--seed", "10", "--only", "any"], ["0 of 4 fail"], 0),
    ],
)
def test_every_seed_that_fails_is_told(tmp_path, capsys, arguments, said, status):
    file = tmp_path / "test_seeds.py"
    file.write_text(FILE, encoding="utf-8")
    assert main([str(file), *arguments]) == status
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(said)
    assert all(line.startswith(start) for line, start in zip(lines, said, strict=True)), lines


def test_a_file_without_tests_over_seeds_is_told(capsys):
    with pytest.raises(SystemExit):
        main([__file__])
    assert "has no test over seeds" in capsys.readouterr().err


def test_the_suite_runs_the_first_seeds():
    tried: list[int] = []

    @over_seeds(3)
    def test(seed):
        tried.append(seed)

    test()
    assert tried == [0, 1, 2]
