"""The command that holds every function against references of its own counts what it should, and finds nothing."""

from __future__ import annotations

from inspect import isfunction

import adversary
import pytest
from adversary import TRIALS, Trial, main

import graphcam as gc


def refusing(draw):
    raise gc.DesignError("size", 1, "2")


def crashing(draw):
    raise IndexError


FAULTS = {
    "wrong": (lambda draw: 1.0, [3, 0, 0]),
    "no number": (lambda draw: float("nan"), [3, 0, 0]),
    "refusing": (refusing, [0, 3, 0]),
    "crashing": (crashing, [0, 0, 3]),
    "right": (lambda draw: 1e-3, [0, 0, 0]),
}


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_is_counted_and_ends_with_1(name, capsys):
    case, counts = FAULTS[name]
    status = main(["--cases", "3", "--seed", "7"], [Trial(name, 0.5, case)])
    _, line, *seeds = capsys.readouterr().out.splitlines()
    assert line.split()[-6] == "3"
    assert [int(word) for word in line.split()[-3:]] == counts
    assert status == (sum(counts) > 0)
    assert [line.rpartition("seeds ")[2] for line in seeds] == (["7, 8, 9"] if status else [])


def test_it_ends_when_its_time_is_over(capsys):
    assert main(["--seconds", "0"], [Trial("right", 1.0, lambda draw: 0.0)]) == 0
    assert main(["--seconds", "0.05"], [Trial("right", 1.0, lambda draw: 0.0)]) == 0
    assert int(capsys.readouterr().out.splitlines()[-1].split()[1]) > 1


def test_every_trial_has_a_name_of_its_own():
    assert len({each.name for each in TRIALS}) == len(TRIALS)


READ_OR_WRITTEN = {"builtin_arcs_task", "builtin_task", "load_task", "grid", "sizing_sheet", "size_task"}
"""Public functions that read, write or arrange; what ``size_task`` computes is ``size_cam``."""


def test_every_public_function_that_computes_has_a_trial():
    functions = {name for name in gc.__all__ if isfunction(getattr(gc, name))} - READ_OR_WRITTEN
    assert {name for name in functions if not any(name in each.name for each in TRIALS)} == set()
    assert len(functions) > 30


@pytest.mark.slow
@pytest.mark.parametrize("each", TRIALS, ids=[each.name for each in TRIALS])
def test_no_function_fails_its_first_cases(each):
    alone = adversary.Trial(each.name, each.permitted, each.case)
    for seed in range(3):
        alone.run(seed)
    assert not alone.failed, list(adversary.table([alone]))
