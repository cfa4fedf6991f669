"""The trial of reading photographs: so many simulated ones are read and marked; an interrupted run goes on.

    python tests/photos/trial.py --photos 2000 --out tests/photos/record.json --workers 2

What was found out by each photograph stands in a journal beside the record, a line each.
"""

from __future__ import annotations

import argparse
import json
import os
import platform
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

if __name__ == "__main__":
    # Before numpy starts threads: figures of time are of one.
    os.environ["OMP_NUM_THREADS"] = "1"
    # Run as a program; pytest knows these places by its settings.
    sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parents[1]), str(Path(__file__).parents[2])]

import cv2
import numpy as np
import scipy
from figures import rows_of, table_of
from measuring import measured
from printed_courses import GIVEN_CAM_KINDS, KINDS, CourseKind
from scenes import scene_of
from two_sheets import tiles_measured

import graphcam
from graphcam.workers import executor_of, ordered_results

SEED = 18
"""Of the record in the repository; the tests take another."""
TWO_SHEETS = 1_000_000
"""From this number on two photographs are taken of a page on two sheets; one such pair to so many others:"""
PAIRS = 50
OF = "simulated photographs only: no real one was taken"
SCRATCH = Path(__file__).parents[2] / "build" / "photos"
"""Where courses and prints are kept, some GB."""


def photograph(number: int, seed: int, scratch: Path, kinds: tuple[CourseKind, ...] = KINDS) -> dict[str, Any]:
    """What is found out by the photograph of a number."""
    cv2.setNumThreads(1)
    if number >= TWO_SHEETS:
        return tiles_measured(number, seed, scratch)
    scene = scene_of(number, seed, scratch, kinds)
    return measured(scene, scratch)


def run(
    numbers: list[int],
    seed: int,
    scratch: Path,
    journal: Path,
    workers: int,
    step: Callable[[int, int], None],
    **kinds: tuple[CourseKind, ...],
) -> list[dict[str, Any]]:
    """The records of photographs, those that the journal has and those that are taken now, which go into it."""
    done = {record["number"]: record for record in _read(journal, seed)}
    left = [number for number in numbers if number not in done]
    job = partial(photograph, seed=seed, scratch=scratch, **kinds)
    with executor_of(workers) as executor, journal.open("a", encoding="utf-8") as file:
        for record in ordered_results(executor, job, left, ahead=2 * workers):
            done[record["number"]] = record
            # On a line of its own, whatever an interrupted run left.
            file.write(f"\n{json.dumps({'seed': seed} | record)}\n")
            file.flush()
            step(len(done), len(numbers))
    return [done[number] for number in numbers]


def _read(journal: Path, seed: int) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = []
    for line in journal.read_text(encoding="utf-8").splitlines() if journal.is_file() else ():
        try:
            record = json.loads(line)
        except json.JSONDecodeError:
            # Empty, or what was being written when a run was killed.
            continue
        if record["seed"] == seed:
            found.append(record)
    return found


def record_of(records: list[dict[str, Any]], seed: int) -> dict[str, Any]:
    """What is kept of a trial: its figures, and with what it was made."""
    versions = {"graphcam": graphcam.__version__, "opencv": cv2.__version__}
    versions |= {"numpy": np.__version__, "scipy": scipy.__version__, "python": platform.python_version()}
    return {"photos": len(records), "seed": seed, "of": OF, "versions": versions, "rows": rows_of(records)}


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--photos", type=int, default=2000)
    parser.add_argument("--first", type=int, default=0, help="number of the first one")
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--scratch", type=Path, default=SCRATCH)
    parser.add_argument("--given-cam", action="store_true", help="only the exercise of a given cam")
    said = parser.parse_args()
    said.scratch.mkdir(parents=True, exist_ok=True)
    numbers = list(range(said.first, said.first + said.photos))
    numbers += list(range(TWO_SHEETS + said.first, TWO_SHEETS + said.first + said.photos // PAIRS))
    kinds = {"kinds": GIVEN_CAM_KINDS} if said.given_cam else {}
    step = partial(print, "photographs", end="\r", flush=True)
    records = run(numbers, said.seed, said.scratch, said.out.with_suffix(".jsonl"), said.workers, step, **kinds)
    record = record_of(records, said.seed)
    said.out.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    sys.stdout.write("\n" + table_of(record["rows"]) + "\n")


if __name__ == "__main__":
    main()
