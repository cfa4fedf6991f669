"""Whatever is handed in holds at L0 and L2, for root and for an ordinary user who grades."""

from __future__ import annotations

import json
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import hostile
import hostile_code
import hostile_grading
import pytest
from hostile_grading import CONTROL
from over_all import over_seeds
from programs import program

from graphcam.exercises.definition.exercise_file import exercise_path
from graphcam.exercises.running.isolation_levels import Level
from graphcam.exercises.running.sandbox import visible_folders

pytestmark = pytest.mark.slow

ORDINARY = 61_234
"""A number that no account has."""
CODE = [*hostile_code.CODE, *hostile_code.MORE_CODE]
NOTEBOOKS = [*CODE, *hostile.DATA]
GROUPS = 10
"""Into so many the cases are dealt, like cards, and each of these into two: for root and for an ordinary user.
The test takes one of them, ``python tests/random_cases.py`` with 20 cases all."""
SAMPLE = CODE[::8]


def test_there_are_two_hundred_cases_and_no_two_of_a_name():
    assert len({*NOTEBOOKS, CONTROL}) == len(NOTEBOOKS) + 1 >= 201
    assert len({*hostile_code.CODE.values(), *hostile_code.MORE_CODE.values()}) == len(CODE)


def test_code_is_not_run_at_l0():
    assert faults(CODE, Level.L0) == []


def test_a_sample_of_code_holds_at_l2():
    needed()
    assert faults(SAMPLE, Level.L2) == []


@over_seeds(1)
def test_cases_hold_at_l2_for_root_or_for_an_ordinary_user(seed: int):
    """With ten seeds more the halves change places."""
    needed()
    group = NOTEBOOKS[seed % GROUPS :: GROUPS]
    turn = seed // GROUPS % 2
    assert faults(group[turn::2], Level.L2) == []
    with tempfile.TemporaryDirectory(prefix="graphcam-home-", dir="/tmp") as home:
        os.chmod(home, 0o777)  # noqa: PTH101  another user's
        for level in (Level.L0, Level.L2):
            assert faults(group[1 - turn :: 2], level, ordinary(Path(home))) == []


def test_what_breaks_out_is_seen():
    """At L1, which keeps an ordinary user's files from nobody, the same cases do what they are meant to."""
    needed()
    with tempfile.TemporaryDirectory(prefix="graphcam-home-", dir="/tmp") as home:
        os.chmod(home, 0o777)  # noqa: PTH101  another user's
        found = faults(["reading the key", "writing the grade book", "the network"], Level.L1, ordinary(Path(home)))
    assert found == [
        "reading the key: what is secret was read",
        "writing the grade book: a file of the course has changed",
        "the network was reached",
    ]


def needed() -> None:
    """What the cases at L2 need of the machine."""
    program("bwrap")
    if platform.machine() != "x86_64":
        pytest.skip("the numbers of the calls are those of x86_64")


def faults(names: list[str], level: Level, start: tuple[str, ...] = ()) -> list[str]:
    """What did not hold, from a process of its own.

    start : what comes before the command
    """
    command = [*start, sys.executable, hostile_grading.__file__, level]
    done = subprocess.run(command, input=json.dumps(names), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def ordinary(home: Path) -> tuple[str, ...]:
    """The start of a command line that runs as an ordinary user; nothing for who is one already.

    Root's Python may lie in folders that are closed to others.  There the user sees an open folder in place of the
    closed one, and in it what grading needs and nothing else.

    home : a folder of the user's
    """
    if os.getuid() != 0:
        return ()
    needs = {path for path in visible_folders() if path.is_dir()} | {Path(hostile_grading.__file__).parent}
    # In a checkout the exercises lie beside the package.
    needs.add(exercise_path("acceleration-and-scales").parent)
    # A virtual environment's python is a link, which must be found by its own name too.
    needs |= {Path(sys.prefix), Path(sys.executable).parent}
    closed = sorted({folder for need in needs if (folder := _closed(need)) is not None})
    command = [program("bwrap"), "--dev-bind", "/", "/", "--cap-add", "ALL"]
    for folder in closed:
        command += ["--perms", "0755", "--tmpfs", str(folder)]
    for need in sorted(needs):
        if _closed(need) is not None:
            command += [*_open_folders(need), "--ro-bind", str(need), str(need)]
    search = os.pathsep.join(filter(None, (os.environ.get("PYTHONPATH"), *_repository())))
    for name, value in (("HOME", str(home)), ("TMPDIR", "/tmp"), ("PYTHONPATH", search)):
        command += ["--setenv", name, value]
    user = str(ORDINARY)
    rights = ["--inh-caps=-all", "--bounding-set=-all"]
    setpriv = [shutil.which("setpriv") or "setpriv", "--reuid", user, "--regid", user, "--clear-groups", *rights]
    return (*command, "--chdir", str(home), *setpriv)


def _repository() -> list[str]:
    """graphcam's folder, which has no other way onto the path than to be named."""
    return [str(path.parent) for path in visible_folders() if path.name == "graphcam"]


def _closed(folder: Path) -> Path | None:
    """The outermost of the folders on the way to one that others cannot enter."""
    return next((one for one in [*reversed(folder.parents), folder] if not one.stat().st_mode & 0o001), None)


def _open_folders(folder: Path) -> list[str]:
    """Folders on the way that others can enter, as bubblewrap makes them."""
    closed = _closed(folder)
    between = [one for one in reversed(folder.parents) if closed is not None and one.is_relative_to(closed)]
    return [word for one in between for word in ("--perms", "0755", "--dir", str(one))]
