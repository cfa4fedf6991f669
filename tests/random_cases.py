"""Random cases in any number: the tests over seeds, of which the test suite runs the first few.

``python tests/random_cases.py tests/mechanism/test_proved_extremes.py --cases 300 --seed 1000`` tries every test of the
file that goes over seeds with 300 of them from 1000 on, prints those that fail, and ends with 1 if there is any.
``--only TEXT`` takes the tests with TEXT in their names, ``--workers 2`` two processes.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
import tomllib
import traceback
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from functools import cache, partial
from pathlib import Path

ROOT = Path(__file__).parents[1]
Case = Callable[[int], None]


@cache
def tests_over_seeds(file: Path) -> dict[str, Case]:
    """The tests of a file that go over seeds, each as a test of one seed, by their names."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    # Where pytest looks for what the tests of a folder share.
    sys.path[:0] = [str(ROOT / folder) for folder in settings["tool"]["pytest"]["ini_options"]["pythonpath"]]
    spec = importlib.util.spec_from_file_location(file.stem, file)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return {name: test.of_one_seed for name, test in vars(module).items() if hasattr(test, "of_one_seed")}


def failure(file: Path, name: str, seed: int) -> str:
    """Why a test fails with a seed, in a line; nothing if it passes."""
    try:
        tests_over_seeds(file)[name](seed=seed)
    except Exception as why:  # noqa: BLE001 - whatever it is, the other seeds are tried
        return f"{name}, seed {seed}: {traceback.format_exception_only(why)[-1].strip().splitlines()[0]}"
    return ""


def main(arguments: list[str] | None = None) -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path)
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--seed", type=int, default=0, help="the first one")
    parser.add_argument("--only", default="", help="part of the names of the tests")
    parser.add_argument("--workers", type=int, default=1)
    asked = parser.parse_args(arguments)
    names = [name for name in tests_over_seeds(asked.file) if asked.only in name]
    if not names:
        parser.error(f"{asked.file} has no test over seeds with {asked.only!r} in its name")
    failed = 0
    with ProcessPoolExecutor(asked.workers) as processes:
        for name in names:
            seeds = range(asked.seed, asked.seed + asked.cases)
            for why in filter(None, processes.map(partial(failure, asked.file, name), seeds)):
                failed += 1
                sys.stdout.write(f"{why}\n")
    sys.stdout.write(f"{failed} of {len(names) * asked.cases} fail\n")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
