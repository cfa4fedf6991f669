"""Windows, as far as a machine without it can show: what only Unix has is hidden, and so it is for worker processes.

Hidden are the modules, functions, flags and signals in hidden/sitecustomize.py, and every way to start a process but
"spawn".  Python's own library and others stay those of this machine: they know Windows themselves.
"""

from __future__ import annotations

import ast
import csv
import json
import os
import subprocess
import sys
import time
import types
from pathlib import Path

import pytest

import graphcam
from graphcam import file_locks
from graphcam.cli import shared
from graphcam.exercises.grading import grade_one
from graphcam.exercises.grading.grade_one import LateError
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reading import regular_file
from graphcam.exercises.reading.submission_files import read_files
from graphcam.exercises.running import isolation_probe
from graphcam.exercises.running.isolation_levels import Level
from graphcam.workers import processes

HIDDEN = Path(__file__).parent / "hidden"
PACKAGE = Path(graphcam.__file__).parent


def run(folder: Path, *words: str, **variables: str) -> subprocess.CompletedProcess[str]:
    """Python there, with all that is of Unix hidden, and an error for every file that is opened in no said encoding."""
    path = os.pathsep.join(map(str, (HIDDEN, PACKAGE.parent)))
    variables = {**os.environ, "PYTHONPATH": path, "PYTHONWARNDEFAULTENCODING": "1", **variables}
    command = [sys.executable, "-W", "error::EncodingWarning:graphcam", *words]
    return subprocess.run(
        command, cwd=folder, env=variables, capture_output=True, encoding="utf-8", errors="replace", check=False
    )


def told(folder: Path, *words: str) -> str:
    """What graphcam says there, which must do what it is told."""
    done = run(folder, "-m", "graphcam", *words)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_what_is_of_unix_is_hidden(tmp_path):
    """Or the other tests of this file would prove nothing."""
    for code in ("import fcntl", "import resource", "import os; os.fork", "import signal; signal.SIGKILL"):
        assert run(tmp_path, "-c", code).returncode == 1
    code = "import multiprocessing as m; print(m.get_all_start_methods(), m.get_start_method())"
    assert run(tmp_path, "-c", code).stdout.strip() == "['spawn'] spawn"


@pytest.mark.slow
def test_every_module_that_is_not_of_the_sandbox_is_imported_without_unix(tmp_path):
    modules = [".".join(path.relative_to(PACKAGE.parent).with_suffix("").parts) for path in PACKAGE.rglob("*.py")]
    # What level L1 and L2 are made of; and the autograder of a system that is Linux.
    of_linux = {
        f"graphcam.exercises.running.{name}" for name in ("launcher", "sandbox", "scratch_folders", "code_answers")
    }
    asked = sorted({name.removesuffix(".__init__") for name in modules} - of_linux - {"graphcam.__main__"})
    code = f"import importlib\nfor name in {asked}: importlib.import_module(name)"
    done = run(tmp_path, "-c", code)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_a_task_is_solved_and_its_notebook_written(tmp_path):
    assert "cam.toml" in told(tmp_path, "init", "cam.toml")
    told(tmp_path, "solve", "cam.toml", "--out", "cam")
    assert json.loads((tmp_path / "cam" / "solution.json").read_text(encoding="utf-8"))["quantities"]
    told(tmp_path, "notebook", "cam.toml", "--out", "lesson")
    assert (tmp_path / "lesson" / "notebook.ipynb").is_file()


@pytest.mark.slow
def test_a_course_is_made_simulated_and_graded_by_spawned_workers(tmp_path):
    (tmp_path / "roster.csv").write_text("id\nanna\nboris\n", encoding="utf-8")
    (tmp_path / "secret").write_bytes(b"secret of a course")
    course = ("pressure-angle", "--roster", "roster.csv", "--secret-file", "secret", "--out", "week")
    told(tmp_path, "exercise", "make", *course, "--workers", "2", "--paper", "unmarked")
    (kept,) = (tmp_path / "week" / "teacher").rglob("anna.json")
    answer_key = AnswerKey.from_json(kept.read_text(encoding="utf-8"))
    anna, boris = (tmp_path / "hand-ins" / name for name in ("anna", "boris"))
    anna.mkdir(parents=True)
    boris.mkdir()
    lines = "".join(f"{name} = {key.expected.value}\n" for name, key in answer_key.keys.items())
    (anna / "answers.toml").write_text(lines, encoding="utf-8")
    (boris / "answers.toml").symlink_to(anna / "answers.toml")
    graded = ("hand-ins", "--exercise", "pressure-angle", "--secret-file", "secret", "--out", "grades.csv")
    told(tmp_path, "exercise", "grade", *graded, "--workers", "2")
    with (tmp_path / "grades.csv").open(encoding="utf-8", newline="") as file:
        totals = {row["student"]: (row["total"], row["of"], row["notes"]) for row in csv.DictReader(file)}
    assert totals["anna"][0] == totals["anna"][1]
    assert totals["boris"][0] == "0"
    assert "is a link" in totals["boris"][2]
    simulated = told(tmp_path, "exercise", "simulate", "pressure-angle", "--hands", "3", "--workers", "2", "--json")
    assert json.loads(simulated)["false_acceptances"] == 0


SPACE = """\
[motion]
lift = 30
rise_angle = 110
dwell_angle = 40
return_angle = 90
[cam]
prime_radius = { start = 40, stop = 80, count = 20 }
roller_radius = 12
"""


@pytest.mark.slow
def test_a_space_is_swept_into_a_file_and_into_a_folder(tmp_path):
    (tmp_path / "space.toml").write_text(SPACE, encoding="utf-8")
    for place in ("designs.csv", "designs"):
        told(tmp_path, "sweep", "space.toml", "--out", place, "--workers", "2")
    assert len((tmp_path / "designs.csv").read_text(encoding="utf-8").splitlines()) == 21


@pytest.mark.slow
def test_the_studio_is_served(tmp_path):
    code = """
from pathlib import Path
from urllib.request import urlopen
import threading, graphcam
from graphcam.studio.local_studio import local_studio, opened_address
with local_studio(Path("out"), "en") as server:
    threading.Thread(target=server.run, daemon=True).start()
    print("studio" in urlopen(opened_address(server, graphcam.builtin_task())).read().decode().lower())
"""
    done = run(tmp_path, "-c", code)
    assert done.stdout.strip() == "True", done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("encoding", ["cp1252", "ascii"])
def test_a_table_is_printed_in_every_encoding(tmp_path, encoding):
    done = run(tmp_path, "-m", "graphcam", "exercise", "list", PYTHONIOENCODING=encoding)
    assert done.returncode == 0, done.stderr
    assert "pressure-angle" in done.stdout


def test_levels_that_run_code_say_in_one_line_that_they_need_linux(monkeypatch):
    isolation_probe.reason_unavailable.cache_clear()
    monkeypatch.setattr(isolation_probe, "sys", types.SimpleNamespace(platform="win32"))
    assert isolation_probe.reason_unavailable(Level.L0) == ""
    for level in (Level.L1, Level.L2):
        with pytest.raises(isolation_probe.LevelError, match=r"Linux.*bubblewrap.*L0") as refused:
            isolation_probe.require(level)
        assert "\n" not in str(refused.value)
    isolation_probe.reason_unavailable.cache_clear()


def test_no_more_workers_than_windows_waits_for(monkeypatch):
    monkeypatch.setattr("graphcam.workers.sys", types.SimpleNamespace(platform="win32"))
    assert processes(100).workers == 61
    assert processes(4).workers == 4


def test_a_hand_in_that_takes_too_long_is_ended_without_the_clock_of_unix(monkeypatch):
    def busy(seconds: float) -> None:
        until = time.process_time() + seconds
        while time.process_time() < until:
            pass

    monkeypatch.delattr("signal.setitimer")
    monkeypatch.setattr(grade_one, "CHECK_INTERVAL", 0.01)
    with pytest.raises(LateError, match=r"0\.05 s"), grade_one._seconds(0.05):
        busy(5.0)
    with grade_one._seconds(5.0):
        busy(0.05)


def test_files_are_read_by_their_path_where_no_folder_can_be_opened(monkeypatch, tmp_path):
    monkeypatch.setattr(regular_file, "OPENS_BY_DESCRIPTOR", False)
    monkeypatch.delattr("os.O_NOFOLLOW")
    (tmp_path / "answers.csv").write_text("v_4,1\n", encoding="utf-8")
    (tmp_path / "key").write_text("v_4 = 1\n", encoding="utf-8")
    (tmp_path / "answers.toml").symlink_to(tmp_path / "key")
    files, errors = read_files(tmp_path)
    assert files == {"answers.csv": b"v_4,1\n"}
    assert [str(error) for error in errors] == ["answers.toml is a link; hand in the file itself"]
    (tmp_path.parent / "linked").symlink_to(tmp_path)
    assert read_files(tmp_path.parent / "linked")[0] == {}


class LocksOfWindows(types.ModuleType):
    """The part of Python's msvcrt that locks: a file, against every other opening of it."""

    LK_NBLCK = 2

    def __init__(self) -> None:
        super().__init__("msvcrt")
        self.held: dict[tuple[int, int], int] = {}

    def locking(self, descriptor: int, mode: int, count: int) -> None:
        assert (mode, count) == (self.LK_NBLCK, 1)
        status = os.fstat(descriptor)
        other = self.held.setdefault((status.st_dev, status.st_ino), descriptor)
        if other != descriptor:
            raise PermissionError(13, "Permission denied")


def test_a_folder_is_locked_by_a_file_beside_it_on_windows(monkeypatch, tmp_path):
    monkeypatch.setitem(sys.modules, "fcntl", None)
    monkeypatch.setitem(sys.modules, "msvcrt", LocksOfWindows())
    monkeypatch.delattr("os.O_DIRECTORY")
    folder = tmp_path / "store"
    folder.mkdir()
    with file_locks.locked_folder(folder):
        assert [path.name for path in tmp_path.iterdir() if path != folder] == ["store.lock"]
        with pytest.raises(BlockingIOError), file_locks.locked_folder(folder):
            pass
        folder.rmdir()
    assert list(tmp_path.iterdir()) == []


def test_a_path_is_quoted_as_the_system_types_it(monkeypatch):
    path = Path("my cams/cam.toml")
    assert shared.quoted(path) == "'my cams/cam.toml'"
    monkeypatch.setattr(shared, "sys", types.SimpleNamespace(platform="win32"))
    assert shared.quoted(path) == '"my cams/cam.toml"'
    assert shared.quoted(Path("C:\\cams\\cam.toml")) == "C:\\cams\\cam.toml"


def writes_of(path: Path) -> list[ast.Call]:
    """The calls that write a text into a file."""
    calls = [node for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))) if isinstance(node, ast.Call)]
    found = []
    for call in calls:
        name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
        modes = {arg.value for arg in call.args[:1] if isinstance(arg, ast.Constant)}
        if name == "write_text" or (name == "open" and modes & {"w", "x", "a"}):
            found.append(call)
    return found


@pytest.mark.slow
def test_every_text_is_written_in_a_said_encoding_and_with_the_same_ends_of_lines_everywhere():
    calls = [(path, call) for path in PACKAGE.rglob("*.py") for call in writes_of(path)]
    assert len(calls) > 20
    for path, call in calls:
        said = {keyword.arg for keyword in call.keywords}
        assert {"encoding", "newline"} <= said, f"{path}:{call.lineno}"
