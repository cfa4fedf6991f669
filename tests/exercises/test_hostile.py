"""Whatever is handed in: exactly one record, in time, no point, no key read, nothing left running."""

from __future__ import annotations

import os
import re
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import hostile
import pytest
from programs import program
from russian import english_words

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.grading import grade_one as work
from graphcam.exercises.grading.grade_one import Assignment, grade, read_submission
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.record import Record
from graphcam.exercises.running.levels import Level, ResourceLimits
from graphcam.exercises.running.probe import missing
from graphcam.exercises.running.sandbox import run_cells

SECONDS = 2.0
A_MOMENT = 1.0
OWNED = Path("/tmp/graphcam-owned")
"""What code that got out would write."""
STUDENT = "Anna"
SECRET = b"a secret that none may read"
FOUND = "[int(n) for n in os.listdir('/proc/self/fd') if int(n) > 2 and 'pipe' in os.readlink(f'/proc/self/fd/{n}')]"
PIPE = f"next(iter({FOUND}))"
"""The way out for answers, as code finds it that was not told."""


@pytest.fixture(scope="module")
def assignment(exercise: Exercise) -> Assignment:
    return Assignment(exercise, SECRET, limits=ResourceLimits(seconds=SECONDS))


@pytest.fixture(scope="module")
def answer_key(assignment: Assignment) -> str:
    from graphcam.exercises.key.keying import issue

    return issue(assignment.exercise, STUDENT, SECRET)[1].to_json()


def graded(assignment: Assignment, answer_key: str, folder: Path) -> Record:
    return grade(assignment, read_submission(STUDENT, folder, answer_key)).record


def filled(folder: Path, name: str) -> None:
    """The name of an answer, put into whatever files the hand-in has."""
    for path in folder.glob("answers.*"):
        if path.is_file() and not path.is_symlink() and path.stat().st_size < 1_000_000:
            data = path.read_bytes()
            path.write_bytes(data.replace(b"{0}", name.encode()).replace(b"{{", b"{").replace(b"}}", b"}"))


@pytest.mark.parametrize("case", hostile.DATA)
def test_data_gives_one_record_and_no_point(case: str, tmp_path: Path, assignment: Assignment, answer_key: str):
    name = assignment.exercise.answers[0].name
    key = AnswerKey.from_json(answer_key).keys[name].expected.value
    (tmp_path / "key.toml").write_text(f"{name} = {key!r}")
    folder = tmp_path / STUDENT
    folder.mkdir()
    hostile.DATA[case](folder)
    filled(folder, name)
    start = time.process_time()
    record = graded(assignment, answer_key, folder)
    assert time.process_time() - start < SECONDS + A_MOMENT
    assert (record.student, record.total, record.level) == (STUDENT, 0.0, "L0")
    assert len(record.answers) == len(assignment.exercise.answers)
    # It says what is wrong: of the file, or of the answer.
    assert record.notes or any("cannot be read" in said for said in record.feedback)
    assert not OWNED.exists()


FORMATS = {
    "answers",
    "toml",
    "csv",
    "ipynb",
    "dxf",
    "TOML",
    "CSV",
    "JSON",
    "DXF",
    "DWG",
    "UTF",
    "max",
    "HYPERLINK",
    "SPLINE",
}


@pytest.mark.parametrize("case", hostile.DATA)
def test_what_cannot_be_read_is_told_in_the_language_of_the_course(
    case: str, tmp_path: Path, assignment: Assignment, answer_key: str
):
    exercise = find_exercise(assignment.exercise.name, "ru")
    names = [asked.name for asked in exercise.answers]
    folder = tmp_path / STUDENT
    folder.mkdir()
    hostile.DATA[case](folder)
    filled(folder, names[0])
    record = graded(replace(assignment, exercise=exercise), answer_key, folder)
    said = " ".join([*record.notes, *record.feedback])
    assert english_words(said, [*names, "True"]) <= FORMATS
    assert re.search("[а-я]", said)


def test_the_key_itself_earns_its_marks(tmp_path: Path, assignment: Assignment, answer_key: str):
    """That the cases above earn nothing is their own fault, not the reader's."""
    keys = AnswerKey.from_json(answer_key).keys
    (tmp_path / "answers.toml").write_text("\n".join(f"{name} = {key.expected.value!r}" for name, key in keys.items()))
    assert graded(assignment, answer_key, tmp_path).total == assignment.exercise.marks


def test_what_never_ends_is_ended_even_where_a_library_catches_all(
    tmp_path: Path, assignment: Assignment, answer_key: str, monkeypatch: pytest.MonkeyPatch
):
    def read(*_: object) -> None:
        while True:
            with suppress(Exception):
                sum(range(10_000))

    monkeypatch.setattr(work, "READING", 0.2)
    monkeypatch.setattr(work, "from_files", read)
    record = graded(assignment, answer_key, tmp_path)
    assert record.total == 0
    assert "took more than 0.2 s" in record.notes[0]


def test_a_faulty_file_says_nothing_on_the_terminal(tmp_path: Path):
    hostile.notebook("s_max = 1if 1else 2 is '\\d'")(tmp_path)
    line = "0\nLINE\n5\nAA\n8\nPITCH\n10\n1\n20\n1\n11\n2\n21\n2\n"
    (tmp_path / "answers.dxf").write_text(f"0\nSECTION\n2\nENTITIES\n{line * 3}0\nENDSEC\n0\nEOF\n")
    # A process of its own, for here warnings and what is logged are caught.
    room = "graphcam.exercises.reading.submission_files"
    read = f"import sys; from {room} import *; from_files([], read_files(sys.argv[1])[0])"
    done = subprocess.run([sys.executable, "-c", read, str(tmp_path)], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")


@pytest.fixture(scope="module", params=[Level.L1, Level.L2])
def level(request: pytest.FixtureRequest) -> Level:
    if request.param is Level.L2:
        program("bwrap")
    assert missing(request.param) == ""
    return request.param


def running(mark: str) -> list[str]:
    """The command lines of processes that have the mark in their environment or arguments."""
    found: list[str] = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            line = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if mark in line:
            found.append(line)
    return found


@pytest.mark.slow
@pytest.mark.parametrize("case", hostile.CODE)
def test_code_gives_one_record_in_time(
    case: str, level: Level, tmp_path: Path, assignment: Assignment, answer_key: str
):
    name = assignment.exercise.answers[0].name
    places = {"key": tmp_path / "key.json", "secret": tmp_path / "secret", "grades": tmp_path / "grades.csv",
              "neighbour": tmp_path / "Boris" / "answers.toml"}  # fmt: skip
    (tmp_path / "Boris").mkdir()
    for path in places.values():
        path.write_text("MARK OF WHAT IS SECRET")
    folder = tmp_path / STUDENT
    folder.mkdir()
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(0.1)
        source = hostile.CODE[case].format(name, port=server.getsockname()[1], pipe=PIPE,
                                           **{key: str(path) for key, path in places.items()})  # fmt: skip
        hostile.notebook(source)(folder)
        start = time.monotonic()
        record = graded(replace(assignment, level=level), answer_key, folder)
        assert time.monotonic() - start < SECONDS + A_MOMENT
        assert (record.student, record.total, record.level) == (STUDENT, 0.0, level)
        if level is Level.L2:
            # At L1 code reads what the grader's own user reads: that is why it is for practice only.
            with pytest.raises(TimeoutError):
                server.accept()
            assert "MARK" not in str(record)
            assert not re.search(r"secret", str(record.answers))
            assert places["grades"].read_text() == "MARK OF WHAT IS SECRET"
            assert running(" /launcher.py") == []
            assert not OWNED.exists()
    OWNED.unlink(missing_ok=True)


LEAVING = """
import os, time
{left} = os.fork() == 0
if {left}:
    os.setsid()
    if os.fork() == 0:
        for _ in range(1500):
            os.mkdir("d")
            os.chdir("d")
        os.chmod(".", 0)
        time.sleep(60)
    os._exit(0)
time.sleep(0.5)
"""


@pytest.mark.slow
def test_nothing_is_left_behind_at_l1(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Neither a process that goes its own way, nor a tree of folders that is too deep for Python to remove."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    ended = run_cells(Level.L1, [LEAVING.format(left="left")], ["left"])
    assert ended.handed_out == b'{"left": false}\n'
    assert list(tmp_path.iterdir()) == []
    for path in Path("/proc").glob("[0-9]*/environ"):
        with suppress(OSError):
            assert os.fsencode(tmp_path) not in path.read_bytes() or path.parent.name == str(os.getpid())


def test_the_sandbox_has_no_more_of_the_host_than_python(level: Level, tmp_path: Path):
    """What the probe tries is what it says: the same attempts succeed outside."""
    (tmp_path / "secret").write_text("secret")
    ended = run_cells(level, [f"import os\nfound = os.path.exists({str(tmp_path / 'secret')!r})"], ["found"])
    assert ended.handed_out == (b'{"found": true}\n' if level is Level.L1 else b'{"found": false}\n')
    assert os.environ.get("HOME", "x") not in run_cells(level, ["import os\nhome = os.environ['HOME']"], ["home"]).text


def test_code_that_plots_earns_its_marks(level: Level, tmp_path: Path, assignment: Assignment, answer_key: str):
    """Libraries that look for the notebook program find as much of it as they need."""
    keys = AnswerKey.from_json(answer_key).keys
    answers = "\n".join(f"{name} = np.float64({key.expected.value!r})" for name, key in keys.items())
    shown = "plt.plot([1, 2])\nplt.show()\nfrom IPython.display import Image, display\ndisplay(Image())"
    hostile.notebook(f"import numpy as np\nimport matplotlib.pyplot as plt\n{shown}\n{answers}")(tmp_path)
    patient = replace(assignment, level=level, limits=ResourceLimits(seconds=60.0))
    record = graded(patient, answer_key, tmp_path)
    assert (record.total, record.notes) == (assignment.exercise.marks, ())
