"""A test over all cases tells of each that fails, and of none that it did not try."""

from __future__ import annotations

import inspect

import pytest
from over_all import over_all


def fails(test, **arguments) -> list[str]:
    """What is noted of the cases that fail."""
    with pytest.raises(ExceptionGroup) as caught:
        test(**arguments)
    return [note for each in caught.value.exceptions for note in each.__notes__]


def test_every_case_that_fails_is_told_whatever_it_fails_of():
    @over_all("n", range(5))
    def test(n):
        if n == 3:
            raise ValueError("three")
        assert n < 4

    assert fails(test) == ["where n = 3", "where n = 4"]


def test_what_does_not_raise_is_told_and_the_others_are_tried():
    @over_all("n", [0, 1, 2])
    def test(n):
        with pytest.raises(ZeroDivisionError):
            assert 1 / n

    assert fails(test) == ["where n = 1", "where n = 2"]


def test_other_arguments_are_left_to_fixtures_and_several_are_taken_together():
    @over_all("n", [1, 2])
    @over_all(("a", "b"), [(1, 1), (2, 2)])
    def test(a, b, n, fixture):
        assert a * n == b * fixture

    assert list(inspect.signature(test).parameters) == ["fixture"]
    assert fails(test, fixture=1) == ["where n = 2"]
    with pytest.raises(AssertionError, match="lambda"):
        over_all("missing", [1])(lambda n: None)


def test_a_case_that_is_skipped_and_no_case_at_all_are_faults():
    @over_all("n", [1, 2])
    def test(n):
        if n == 2:
            pytest.skip("today")

    assert fails(test) == ["where n = 2"]
    with pytest.raises(AssertionError, match="no case"):
        over_all("n", [])
