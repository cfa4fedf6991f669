"""'graphcam exercise make' that is killed, as by a power cut, leaves a whole course or none."""

from __future__ import annotations

import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from graphcam.exercises.course.course_folder import SECRET_FILE, STUDENTS_FOLDER, TEACHER_FOLDER
from graphcam.exercises.course.course_making import make

pytestmark = pytest.mark.slow

if sys.platform == "win32":
    pytest.skip("nothing is killed so there", allow_module_level=True)

NAMES = ("s-1", "s-2")
AT_RENAME = """
import os, signal, sys
from graphcam.exercises.course.course_making import make

left = int(sys.argv[3])

def counted(event, arguments):
    global left
    if event == "os.rename":
        left -= 1
        if left < 0:
            os.kill(os.getpid(), signal.SIGKILL)

sys.addaudithook(counted)
make("acceleration-and-scales", sys.argv[1], None, sys.argv[2])
"""
"""Makes a course and is killed before its next rename after so many."""


def child(roster: Path, out: Path, renames: int) -> subprocess.Popen[bytes]:
    return subprocess.Popen([sys.executable, "-c", AT_RENAME, str(roster), str(out), str(renames)])


@pytest.fixture
def roster(tmp_path: Path) -> Path:
    path = tmp_path / "roster.csv"
    path.write_text("id\n" + "\n".join(NAMES) + "\n", encoding="utf-8")
    return path


def is_whole(course: Path) -> bool:
    """Whether all of a course is there; fails where a part of it is."""
    shown = {path.name for path in course.iterdir() if not path.name.startswith(".")} if course.exists() else set()
    shown.discard("notes.txt")
    if not shown:
        return False
    # Students without the secret could never be marked.
    assert (course / TEACHER_FOLDER / SECRET_FILE).read_bytes()
    if shown == {TEACHER_FOLDER, STUDENTS_FOLDER}:
        for name in NAMES:
            assert (course / TEACHER_FOLDER / "keys" / f"{name}.pdf").read_bytes().rstrip().endswith(b"%%EOF")
            assert (course / STUDENTS_FOLDER / name / "answers.toml").is_file()
        return True
    assert shown == {TEACHER_FOLDER}
    return False


def killed_at_every_rename(roster: Path, out: Path) -> list[bool]:
    """Whether the course was whole after a run that was killed at its first rename, its second, and so on."""
    found: list[bool] = []
    for renames in range(20):
        run = child(roster, out / str(renames), renames)
        code = run.wait(120)
        found.append(is_whole(out / str(renames)))
        if code == 0:
            return found
        assert code == -signal.SIGKILL
    raise AssertionError("it renames more often than that")


def test_between_its_renames_there_is_all_or_nothing_in_a_new_folder(roster: Path, tmp_path: Path):
    found = killed_at_every_rename(roster, tmp_path / "courses")
    assert found == [*(len(found) - 1) * [False], True]
    for killed in range(len(found) - 1):
        # Nothing of it is there, not even the folder, so the next run makes it.
        assert not (tmp_path / "courses" / str(killed)).exists()
    assert make("acceleration-and-scales", roster, None, tmp_path / "courses" / "0") == len(NAMES)
    assert is_whole(tmp_path / "courses" / "0")


def test_in_a_folder_that_holds_something_the_secret_comes_first(roster: Path, tmp_path: Path):
    for renames in range(20):
        (tmp_path / "courses" / str(renames)).mkdir(parents=True)
        (tmp_path / "courses" / str(renames) / "notes.txt").write_text("kept", encoding="utf-8")
    found = killed_at_every_rename(roster, tmp_path / "courses")
    assert found[-1]
    assert not any(found[:-1])
    kept = {(tmp_path / "courses" / str(k) / "notes.txt").read_text(encoding="utf-8") for k in range(len(found))}
    assert kept == {"kept"}


def test_at_any_moment_there_is_all_or_nothing(roster: Path, tmp_path: Path):
    begin = time.monotonic()
    assert child(roster, tmp_path / "measured", 1000).wait(120) == 0
    needed = time.monotonic() - begin
    moments = random.Random(41)
    for k in range(2):
        run = child(roster, tmp_path / str(k), 1000)
        try:
            run.wait(moments.uniform(0.3, 1.1) * needed)
        except subprocess.TimeoutExpired:
            run.kill()
            run.wait()
        is_whole(tmp_path / str(k))
