"""One test per invariant over many cases: it goes through all of them, and reports every one that fails."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable
from typing import Any

import pytest

Test = Callable[..., None]


def over_all(names: str | tuple[str, ...], cases: Iterable[Any]) -> Callable[[Test], Test]:
    """Make one test of a test of one case: as ``pytest.mark.parametrize``, but collected and reported once.

    names : an argument of the test, or a tuple of several
    cases : a value each, or a tuple of as many as there are names

    >>> @over_all("n", [1, 2, 3])
    ... def test_all_are_odd(n):
    ...     assert n % 2
    >>> test_all_are_odd()
    Traceback (most recent call last):
    ExceptionGroup: test_all_are_odd: 1 of 3 fail (1 sub-exception)
    """
    keys = [names] if isinstance(names, str) else [*names]
    every = [(case,) if isinstance(names, str) else tuple(case) for case in cases]
    assert every, "a test over no case cannot fail"

    def made(test: Test) -> Test:
        @functools.wraps(test)
        def whole(**others: Any) -> None:
            failed: list[Exception] = []
            for case in every:
                try:
                    test(**dict(zip(keys, case, strict=True)), **others)
                except pytest.skip.Exception as why:
                    # Of many cases none is passed over in silence.
                    failed.append(told(AssertionError(f"skipped: {why}"), case))
                except pytest.fail.Exception as why:
                    # It is no Exception: what did not raise, say.
                    failed.append(told(AssertionError(str(why)), case))
                except Exception as why:  # noqa: BLE001 - whatever it is, the other cases are tried
                    failed.append(told(why, case))
            if failed:
                raise ExceptionGroup(f"{test.__name__}: {len(failed)} of {len(every)} fail", failed)

        def told(why: Exception, case: tuple[Any, ...]) -> Exception:
            said = ", ".join(f"{key} = {value!s:.200}" for key, value in zip(keys, case, strict=True))
            why.add_note(f"where {said}")
            return why

        signature = inspect.signature(test)
        kept = [each for name, each in signature.parameters.items() if name not in keys]
        assert len(kept) == len(signature.parameters) - len(keys), (test.__name__, names)
        whole.__signature__ = signature.replace(parameters=kept)
        return whole

    return made


def pairs(ones: Iterable[Any], others: Iterable[Any], every: int = 3) -> list[tuple[Any, Any]]:
    """One in so many of all pairs, so that each value occurs with several of the other list.

    >>> pairs("abc", range(6))
    [('a', 0), ('a', 3), ('b', 2), ('b', 5), ('c', 1), ('c', 4)]
    """
    row = list(others)
    return [(one, other) for k, one in enumerate(ones) for n, other in enumerate(row) if (k + n) % every == 0]


def fast_first(cases: Iterable[Any], fast: int = 1) -> list[Any]:
    """Parameters of a test whose first few are quick tests, and the others slow ones.

    >>> [str(each) if isinstance(each, str) else [mark.name for mark in each.marks] for each in fast_first("ab")]
    ['a', ['slow']]
    """
    return [case if k < fast else slow(case) for k, case in enumerate(cases)]


def slow(case: Any) -> Any:
    """A case, or a tuple of the values of several parameters, that is a slow test."""
    return pytest.param(*(case if isinstance(case, tuple) else [case]), marks=pytest.mark.slow)


def over_seeds(seeds: int | Iterable[int]) -> Callable[[Test], Test]:
    """Make one test of a test of one seed, over some; ``python tests/random_cases.py`` takes any others.

    seeds : those of the suite, or how many from 0 on

    >>> @over_seeds(3)
    ... def test_all_are_small(seed):
    ...     assert seed < 2
    >>> test_all_are_small()
    Traceback (most recent call last):
    ExceptionGroup: test_all_are_small: 1 of 3 fail (1 sub-exception)
    """

    def made(test: Test) -> Test:
        whole = over_all("seed", range(seeds) if isinstance(seeds, int) else seeds)(test)
        whole.of_one_seed = test
        return whole

    return made
