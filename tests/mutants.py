"""Mutants: small faults put into a room at random, one at a time, to see whether the tests of the room find them.

``python tests/mutants.py marking --count 100 --seed 1`` prints every mutant with its place, what stood there and what
it became, and the part that was killed of those that do something else.  The working tree is left alone: the tests
run in a copy of it.  Slow tests are left out.  With ``--whole``, all other quick tests follow those of the room, up to
the first that fails.

A mutant exchanges an operator, a comparison, ``and`` and ``or``, a function for its opposite (``min`` and ``max``),
the parts of a complex number or the sides of a box, ``True`` and ``False``; it adds one to a number, turns the sign of
an imaginary one, leaves out a minus, a ``not`` or a call that stands alone, or turns a condition round.  Never drawn
is what does nothing when all is right: texts, annotations, decorators, ``zip(strict=...)`` and code for type checkers.
Everything else is, colours and widths of lines too; the mutants that change nothing that anybody could see or read
stand in ``mutants.toml``, each with the reason.
"""

from __future__ import annotations

import argparse
import ast
import contextlib
import copy
import multiprocessing
import os
import random
import shutil
import signal
import sys
import tempfile
import time
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from queue import SimpleQueue

ROOT = Path(__file__).parents[1]
LIBRARIES = (
    *("pytest", "hypothesis.strategies", "numpy", "scipy.interpolate", "scipy.optimize", "scipy.integrate", "shapely"),
    *("typer.testing", "jinja2", "babel.support", "ezdxf", "fontTools.subset", "matplotlib.textpath"),
    *("matplotlib.figure", "matplotlib.backends.backend_pdf", "matplotlib.backends.backend_svg"),
)
"""What the rooms and their tests load, and what is the same for every mutant."""
EQUIVALENT = Path(__file__).with_name("mutants.toml")


@dataclass(frozen=True)
class Room:
    """Folders of the package, and the tests that belong to them, the fastest first."""

    folders: tuple[str, ...]
    tests: tuple[str, ...]


DRAWN = ("integration", "translating", "profile", "arms", "flat_faces", "arcs", "axes", "differentiation", "force_plan")
"""Whose marks are tested each in a file of its own: these are quick, so they come first."""
ROOMS = {
    "constructions": Room(
        ("graphcam/constructions", "graphcam/drafting"),
        (
            *("tests/drafting", *(f"tests/constructions/test_marks_of_{drawn}.py" for drawn in DRAWN)),
            *("tests/constructions/test_acts.py", "graphcam/drafting", "graphcam/constructions", "tests/constructions"),
            *("tests/test_golden.py", "tests/test_golden_random.py"),
        ),
    ),
    "marking": Room(
        ("graphcam/exercises/marking",),
        (
            *("graphcam/exercises/marking", "tests/exercises/test_diagnosis.py", "tests/exercises/test_comparing.py"),
            *("tests/exercises/test_follow_through.py", "tests/exercises/test_feedback.py"),
            *("tests/exercises/test_copy_detection.py", "tests/exercises/test_single_slips.py"),
            *("tests/exercises/test_exactness.py", "tests/exercises/test_marks_policy.py"),
            *("tests/exercises/test_simulated_counts.py", "tests/exercises/test_marking.py"),
        ),
    ),
    "mechanism": Room(
        ("graphcam/mechanism",),
        (
            *("graphcam/mechanism", "tests/mechanism/test_translating.py", "tests/mechanism/test_oscillating.py"),
            *("tests/mechanism/test_flat_faced.py", "tests/mechanism/test_forces.py", "tests/mechanism"),
            *("tests/test_table_of_hard_cases.py", "tests/comparison", "tests/solving"),
        ),
    ),
    "sheets": Room(
        ("graphcam/sheets",),
        (
            *("graphcam/sheets", "tests/sheets/test_boxes_and_rooms.py", "tests/sheets/test_label_candidates.py"),
            *("tests/sheets/test_mark_entities.py", "tests/sheets/test_sampling.py", "tests/sheets/test_fields.py"),
            *("tests/sheets/test_occupancy.py", "tests/sheets/test_tables.py", "tests/sheets/test_rendered.py"),
            "tests/sheets",
        ),
    ),
}

EXCHANGED = {
    name: others.split()
    for name, _, others in (
        pair.partition(" ")
        for pair in (
            *("Add Sub", "Sub Add", "Mult Div", "Div Mult", "FloorDiv Mult", "Mod Mult", "Pow Mult", "MatMult Mult"),
            *("Lt LtE GtE", "LtE Lt Gt", "Gt GtE LtE", "GtE Gt Lt", "Eq NotEq", "NotEq Eq", "Is IsNot", "IsNot Is"),
            *("In NotIn", "NotIn In", "And Or", "Or And", "BitAnd BitOr"),
        )
    )
}
"""What is put in place of an operator, by the names that they have in a tree."""
FUNCTIONS = [
    *(("min", "max"), ("minimum", "maximum"), ("argmin", "argmax"), ("any", "all"), ("floor", "ceil"), ("sin", "cos")),
]
PARTS = [("real", "imag"), ("left", "right"), ("top", "bottom"), ("width", "height"), ("start", "end")]
OPPOSITE = {a: b for pair in FUNCTIONS + PARTS for a, b in (pair, pair[::-1])}
SHOWN = (ast.expr, ast.keyword, ast.Assign, ast.AnnAssign, ast.AugAssign, ast.Return)
"""What says more of a mutant than the changed expression alone, which may be a mere number."""


@dataclass(frozen=True)
class Mutant:
    """One fault: what stands in a field of a node of the tree of a file, and what is put there instead.

    shown : the part of the tree that says what was done; None if it is what is exchanged
    """

    file: str
    tree: ast.Module
    node: ast.AST
    field: str
    place: int | None
    new: ast.AST
    shown: ast.AST | None

    @property
    def old(self) -> ast.AST:
        """What stands there."""
        held = getattr(self.node, self.field)
        return held if self.place is None else held[self.place]

    @property
    def line(self) -> int:
        """Where it stands, counted from 1."""
        return next(n.lineno for n in (self.old, self.node) if hasattr(n, "lineno"))

    def source(self, shown: ast.AST | None = None) -> str:
        """The file, or a part of it, with the fault in it."""
        old = self.old
        self._put(self.new)
        try:
            return ast.unparse(shown or self.tree)
        finally:
            self._put(old)

    def difference(self) -> tuple[str, str]:
        """What stood there and what it became, with what stands about it."""
        if self.shown is None:
            return ast.unparse(self.old), ast.unparse(self.new)
        return ast.unparse(self.shown), self.source(self.shown)

    def _put(self, value: ast.AST) -> None:
        if self.place is None:
            setattr(self.node, self.field, value)
        else:
            getattr(self.node, self.field)[self.place] = value


def instead(node: ast.AST) -> Iterator[ast.AST]:
    """What may be put in place of a node.

    >>> [ast.unparse(each) for each in instead(ast.parse("a < b", mode="eval").body)]
    ['a <= b', 'a >= b']
    """
    match node:
        case ast.BinOp(op=ast.Add() | ast.Sub(), right=ast.Constant(value=complex(imag=0.0))):
            # It only makes a number complex.
            return
        case ast.BinOp(op=operator) | ast.AugAssign(op=operator) | ast.BoolOp(op=operator):
            for other in _exchanged(operator):
                yield _changed(node, op=other)
        case ast.Compare(ops=operators):
            for k, operator in enumerate(operators):
                for other in _exchanged(operator):
                    yield _changed(node, ops=[*operators[:k], other, *operators[k + 1 :]])
        case ast.UnaryOp(op=ast.USub() | ast.Not(), operand=operand):
            yield operand
        case ast.Constant(value=bool(value)):
            yield ast.Constant(not value)
        case ast.Constant(value=complex(imag=value)):
            yield ast.Constant(complex(0.0, -value) if value else 1j)
        case ast.Constant(value=int(value) | float(value)):
            yield ast.Constant(value + 1)
        case ast.Name(id=name) if any(name in pair for pair in FUNCTIONS):
            yield _changed(node, id=OPPOSITE[name])
        case ast.Attribute(attr=name) if name in OPPOSITE:
            yield _changed(node, attr=OPPOSITE[name])
        case ast.Expr(value=ast.Call()):
            yield ast.Pass()
        case _:
            pass


def _exchanged(operator: ast.AST) -> list[ast.AST]:
    return [getattr(ast, name)() for name in EXCHANGED.get(type(operator).__name__, ())]


def _changed(node: ast.AST, **fields: object) -> ast.AST:
    new = copy.copy(node)
    for name, value in fields.items():
        setattr(new, name, value)
    return new


def mutants(file: str, source: str) -> Iterator[Mutant]:
    """Every mutant of one file, in the order of its text."""
    tree = ast.parse(source)
    waiting: list[tuple[ast.AST, ast.AST | None]] = [(tree, None)]
    while waiting:
        node, shown = waiting.pop()
        if not isinstance(node, ast.Slice):
            shown = node if isinstance(node, SHOWN) else None
        below: list[tuple[ast.AST, ast.AST | None]] = []
        for field, place, child in _children(node):
            below.append((child, shown))
            for new in instead(child):
                yield Mutant(file, tree, node, field, place, new, shown)
            condition = field == "test" and isinstance(node, ast.If | ast.IfExp | ast.While)
            if condition and not isinstance(child, ast.Compare | ast.UnaryOp):
                yield Mutant(file, tree, node, field, place, ast.UnaryOp(ast.Not(), child), shown)
        waiting += reversed(below)


def _children(node: ast.AST) -> Iterator[tuple[str, int | None, ast.AST]]:
    """What stands in a node and does something when it runs, with its place."""
    if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
        return
    for field, value in ast.iter_fields(node):
        if field in ("annotation", "returns", "decorator_list", "ctx", "op", "ops"):
            continue
        for place, child in enumerate(value) if isinstance(value, list) else ((None, value),):
            if isinstance(child, ast.AST) and not (isinstance(child, ast.keyword) and child.arg == "strict"):
                yield field, place, child


def sample(room: Room, root: Path, count: int, seed: int) -> list[Mutant]:
    """Mutants of a room at random, the same ones for the same seed; all of them where there are fewer."""
    files = sorted(path for folder in room.folders for path in (root / folder).rglob("*.py"))
    every = [
        mutant
        for path in files
        for mutant in mutants(path.relative_to(root).as_posix(), path.read_text(encoding="utf-8"))
    ]
    chosen = random.Random(seed).sample(range(len(every)), min(count, len(every)))
    return [every[k] for k in sorted(chosen)]


def passed(folder: Path, tests: Sequence[str], limit: float | None = None) -> bool:
    """Whether the tests pass in a copy of the tree; those that take longer than the limit [s] do not."""
    # Every run is a child of a process that has loaded the libraries, which takes longer than most runs.
    context = multiprocessing.get_context("forkserver")
    context.set_forkserver_preload([*LIBRARIES])
    process = context.Process(target=_tested, args=(folder, tests))
    process.start()
    process.join(limit)
    with contextlib.suppress(ProcessLookupError):
        # With whatever the tests have started.
        os.killpg(process.pid, signal.SIGKILL)
    process.join()
    return process.exitcode == 0


def _tested(folder: Path, tests: Sequence[str]) -> None:
    """Run the tests in the copy, in a process of its own."""
    import pytest

    os.setsid()
    os.chdir(folder)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)
    # Nothing of the tree itself; but an environment may lie in it.
    kept = [path for path in sys.path if "site-packages" in path or not Path(path).resolve().is_relative_to(ROOT)]
    sys.path[:] = [str(folder), *kept]
    # No byte code: two mutants of one file within a second could not be told apart by it.
    sys.dont_write_bytecode = True
    os.environ |= {"PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    quick = ("-x", "-q", "-p", "no:cacheprovider", "-p", "_hypothesis_pytestplugin", "--hypothesis-profile=ci")
    sys.exit(pytest.main([*quick, *tests]))


def survives(mutant: Mutant, folder: Path, tests: Sequence[str], limit: float) -> bool:
    """Whether all tests pass in the copy of the tree with the fault in it."""
    path = folder / mutant.file
    before = path.read_text(encoding="utf-8")
    path.write_text(mutant.source(), encoding="utf-8")
    # What bears the name of the file is about it, and fails first.
    subject = path.stem.split("_")[0]
    try:
        return passed(folder, [mutant.file, *sorted(tests, key=lambda test: subject not in test)], limit)
    finally:
        path.write_text(before, encoding="utf-8")


def equivalent(root: Path) -> dict[tuple[str, str, str], str]:
    """The mutants that do the same as what stood there, with the reasons: by file, expression and what it became."""
    path = root / EQUIVALENT.relative_to(ROOT)
    told = tomllib.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
    return {(each["file"], each["old"], each["new"]): each["why"] for each in told.get("mutant", [])}


def judged(
    room: Room, root: Path, count: int, seed: int, workers: int = 1, *, whole: bool = False
) -> Iterator[tuple[Mutant, str]]:
    """The mutants drawn, each with what became of it.

    whole : whether the other quick tests follow those of the room
    """
    same = equivalent(root)
    files = [path for test in room.tests for path in (sorted((root / test).glob("test_*.py")) or [root / test])]
    if whole:
        # The tests of the tool itself plant faults on their own.
        files += [*sorted(path for path in (root / "tests").rglob("test_*.py") if path.stem != "test_mutants")]
        files += [root / "graphcam"]
    tests = list(dict.fromkeys(path.relative_to(root).as_posix() for path in files))
    with tempfile.TemporaryDirectory() as place:
        folders: SimpleQueue[Path] = SimpleQueue()
        for worker in range(workers):
            folders.put(folder := Path(place) / str(worker))
            shutil.copytree(root, folder, ignore=shutil.ignore_patterns(".*"))
        before = time.monotonic()
        if not passed(folder, tests):
            raise SystemExit("The tests fail before anything is changed.")
        limit = 3 * workers * (time.monotonic() - before) + 20

        def judge(mutant: Mutant) -> str:
            if reason := same.get((mutant.file, *mutant.difference())):
                return f"equivalent ({reason})"
            folder = folders.get()
            try:
                return "survived" if survives(mutant, folder, tests, limit) else "killed"
            finally:
                folders.put(folder)

        with ThreadPoolExecutor(workers) as pool:
            drawn = sample(room, root, count, seed)
            yield from zip(drawn, pool.map(judge, drawn), strict=True)


def main() -> None:
    """Read the command line, and print what becomes of every mutant as soon as it is known."""
    sys.stdout.reconfigure(line_buffering=True)
    write = sys.stdout.write
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("room", choices=ROOMS)
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--whole", action="store_true")
    chosen = parser.parse_args()
    found: Counter[str] = Counter()
    drawn = judged(ROOMS[chosen.room], ROOT, chosen.count, chosen.seed, chosen.workers, whole=chosen.whole)
    for mutant, fate in drawn:
        found[fate.split()[0]] += 1
        write(f"{mutant.file}:{mutant.line}: {' -> '.join(mutant.difference())}: {fate}\n")
    live = found["killed"] + found["survived"]
    counts = ", ".join(f"{found[fate]} {fate}" for fate in ("killed", "survived", "equivalent"))
    write(f"{counts}: {found['killed'] / max(live, 1):.1%} killed of the {live} that do something else\n")


if __name__ == "__main__":
    main()
