"""Whatever is handed in: exactly one record, in time, no point, no key read, nothing left running."""

from __future__ import annotations

import json
import os
import platform
import re
import socket
import subprocess
import sys
import tempfile
import time
import tomllib
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

import hostile
import hostile_code
import pytest
from hostile_grading import PIPE, SECRET, STUDENT, filled
from programs import program
from russian import english_words

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.grading import grade_one as work
from graphcam.exercises.grading.grade_one import Assignment, grade, read_submission
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.marking.record import Record
from graphcam.exercises.reading.answer_values import MAX_NUMBER
from graphcam.exercises.reports.group_page import group_page
from graphcam.exercises.running.isolation_levels import MEBIBYTE, Level, ResourceLimits
from graphcam.exercises.running.isolation_probe import reason_unavailable
from graphcam.exercises.running.sandbox import run_cells
from graphcam.exercises.running.scratch_folders import scratch_folder

pytestmark = pytest.mark.slow

SECONDS = 2.0
A_MOMENT = 1.0
OWNED = Path("/tmp/graphcam-owned")
"""What code that got out would write."""


@pytest.fixture(scope="module")
def assignment(exercise: Exercise) -> Assignment:
    return Assignment(exercise, SECRET, limits=ResourceLimits(seconds=SECONDS))


@pytest.fixture(scope="module")
def answer_key(assignment: Assignment) -> str:
    from graphcam.exercises.key.key_making import issue

    return issue(assignment.exercise, STUDENT, SECRET)[1].to_json()


def graded(assignment: Assignment, answer_key: str, folder: Path) -> Record:
    return grade(assignment, read_submission(STUDENT, folder, answer_key)).record


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


@pytest.mark.parametrize("case", hostile.NUMBERS)
def test_a_number_at_a_limit_earns_nothing(case: str, tmp_path: Path, assignment: Assignment, answer_key: str):
    name = assignment.exercise.answers[0].name
    (tmp_path / "answers.toml").write_text(f"{name} = {hostile.NUMBERS[case]}")
    record = graded(assignment, answer_key, tmp_path)
    # What no drawing can say is not read, and the others are wrong.
    expected = "unreadable" if abs(tomllib.loads(f"x = {hostile.NUMBERS[case]}")["x"]) > MAX_NUMBER else "wrong"
    assert (record.total, record.answers[0].outcome) == (0.0, expected)
    json.dumps(record.to_dict(), allow_nan=False)


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
    "INSUNITS",
    "nan",
    "inf",
    "href",
    "cmd",
    "calc",
    "Calc",
    "SUM",
}


@pytest.mark.parametrize("case", [*hostile.DATA][::3])
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
    # A file that is called otherwise is named as it is called.
    files = [path.name.strip() for path in folder.iterdir()] if folder.is_dir() else []
    assert english_words(said, [*names, *files, "True"]) <= FORMATS
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

    monkeypatch.setattr(work, "READING_SECONDS", 0.2)
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
    elif os.getuid() == 0 and reason_unavailable(request.param):
        pytest.skip(str(reason_unavailable(request.param)))
    assert reason_unavailable(request.param) == ""
    return request.param


def running(mark: str) -> list[str]:
    """The command lines of processes that have the mark in them."""
    found: list[str] = []
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            line = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if mark in line:
            found.append(line)
    return found


@pytest.mark.parametrize("case", hostile_code.CODE)
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
    # A size that no other sandbox on the machine has: when that one is gone, all that ran in it are.
    own = replace(assignment.limits, written=assignment.limits.written + os.getpid())
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(0.1)
        source = hostile_code.CODE[case].format(name, port=server.getsockname()[1], pipe=PIPE,
                                           **{key: str(path) for key, path in places.items()})  # fmt: skip
        hostile.notebook(source)(folder)
        start = time.monotonic()
        record = graded(replace(assignment, level=level, limits=own), answer_key, folder)
        assert time.monotonic() - start < SECONDS + A_MOMENT
        assert (record.student, record.total, record.level) == (STUDENT, 0.0, level)
        if level is Level.L2:
            # At L1 code reads what the grader's own user reads: that is why it is for practice only.
            with pytest.raises(TimeoutError):
                server.accept()
            assert "MARK" not in str(record)
            assert not re.search(r"secret", str(record.answers))
            assert places["grades"].read_text() == "MARK OF WHAT IS SECRET"
            assert running(f" --size {own.written} ") == []
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


def test_nothing_is_left_behind_at_l1(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Neither a process that goes its own way, nor a tree of folders that is too deep for Python to remove."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    if os.getuid() == 0 and reason_unavailable(Level.L1):
        pytest.skip(str(reason_unavailable(Level.L1)))
    ended = run_cells(Level.L1, [LEAVING.format(left="left")], ["left"])
    assert ended.handed_out == b'{"left": false}\n'
    assert list(tmp_path.iterdir()) == []
    for path in Path("/proc").glob("[0-9]*/environ"):
        with suppress(OSError):
            assert os.fsencode(tmp_path) not in path.read_bytes() or path.parent.name == str(os.getpid())


def test_the_sandbox_has_no_more_of_the_host_than_python(level: Level):
    """What the probe tries is what it says: the same attempts succeed outside."""
    # In a folder that every user can enter: at L1 root's code has a user of its own.
    with tempfile.TemporaryDirectory(prefix="graphcam-open-", dir="/tmp") as place:
        Path(place).chmod(0o755)
        ended = run_cells(level, [f"import os\nfound = os.path.exists({place!r})"], ["found"])
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


def test_the_bound_of_memory_that_was_in_force_is_told(tmp_path: Path, assignment: Assignment, answer_key: str):
    """In the record, and to whoever reads on the group; at L0 there is none."""
    (tmp_path / "answers.toml").write_text("")
    records = [
        graded(replace(assignment, level=level), answer_key, tmp_path).to_dict() for level in (Level.L0, Level.L2)
    ]
    assert [record["memory"] for record in records] == [None, 1024]
    pages = [group_page(assignment.exercise, [record], {}) for record in records]
    assert ["limited to 1024 MiB" in page for page in pages] == [False, True]


def test_memory_of_all_processes_together_is_bounded():
    program("bwrap")
    source = """
import os, time
for _ in range({children}):
    if os.fork() == 0:
        break
x = b"1" * (60 << 20)
time.sleep({seconds})"""
    limits = ResourceLimits(seconds=20.0, memory=200 * MEBIBYTE)
    many = run_cells(Level.L2, [source.format(children=5, seconds=20)], [], limits)
    assert (many.late, many.large) == (False, True)
    # One of them alone is within it.
    one = run_cells(Level.L2, [source.format(children=0, seconds=0.2)], [], limits)
    assert (one.status, one.late, one.large) == (0, False, False)


def test_files_with_nothing_in_them_count_as_memory():
    program("bwrap")
    source = "import itertools, os\nfor k in itertools.count(): os.mkdir('{place}/' + str(k))"
    for place in ("/tmp", "/dev/shm"):
        limits = ResourceLimits(seconds=60.0, memory=100 * MEBIBYTE)
        ended = run_cells(Level.L2, [source.format(place=place)], [], limits)
        assert (ended.large, ended.late) == (True, False)


REFUSALS = {
    "a file in memory": "os.memfd_create('x')",
    "shared memory that outlives": "system(29, 0, 4096, 0o1600)",
    "the keys of whoever grades": "system(250, 0, -3, 0)",
    "a key": "system(248, b'user', b'name', b'x', 1, -3)",
    "a name space of users": "system(272, 0x10000000)",
    "a name space by clone": "system(56, 0x10000011, 0, 0, 0, 0)",
    "a file among the devices": "open('/dev/graphcam', 'w')",
    "a larger file in shared memory": "[open(f'/dev/shm/{k}', 'wb').write(bytes(20 << 20)) for k in range(2)]",
}
"""What is refused at L2 with an error; the numbers are those of x86_64."""
CALLING = """
import ctypes, os
library = ctypes.CDLL(None, use_errno=True)
def system(*arguments):
    if library.syscall(*arguments) < 0:
        raise OSError(ctypes.get_errno(), "refused")
held = False
try:
    {attempt}
except OSError as error:
    held = error.errno in (1, 28, 30)
"""


@pytest.mark.parametrize("case", REFUSALS)
def test_the_sandbox_refuses(case: str):
    program("bwrap")
    if platform.machine() != "x86_64":
        pytest.skip("the numbers of the calls are those of x86_64")
    ended = run_cells(Level.L2, [CALLING.format(attempt=REFUSALS[case])], ["held"])
    assert ended.handed_out == b'{"held": true}\n'


def test_a_folder_that_was_moved_is_removed_and_what_a_link_in_its_place_shows_is_not(tmp_path: Path):
    kept, moved = tmp_path / "kept", tmp_path / "moved"
    kept.mkdir(mode=0o750)
    (kept / "file").write_text("kept")
    with scratch_folder() as folder:
        Path(folder).rename(moved)
        Path(folder).symlink_to(kept)
        (moved / "link").symlink_to(kept)
        (moved / "closed" / "inner").mkdir(parents=True)
        (moved / "closed" / "inner").chmod(0)
        (moved / "closed").chmod(0)
        (moved / ".0").mkdir()
        moved.chmod(0)
    assert not os.path.lexists(folder)
    assert list(tmp_path.iterdir()) == [kept]
    assert (kept.stat().st_mode & 0o777, (kept / "file").read_text()) == (0o750, "kept")


def test_a_folder_that_is_deeper_than_a_path_is_removed():
    here = os.open(".", os.O_RDONLY)
    with scratch_folder() as folder:
        os.chdir(folder)
        for _ in range(1500):
            Path("d").mkdir()
            os.chdir("d")
        os.fchdir(here)
    os.close(here)
    assert not os.path.lexists(folder)


def test_level_l1_is_refused_where_the_students_are_not_trusted(tmp_path: Path):
    """Code there is kept from nothing: whoever chooses it says so."""
    (tmp_path / "hand-ins" / STUDENT).mkdir(parents=True)
    (tmp_path / "secret").write_bytes(SECRET)
    command = [sys.executable, "-m", "graphcam", "exercise", "grade", "hand-ins", "--secret-file", "secret",
               "--out", "grades.csv", "--exercise", "pressure-angle", "--level", "L1"]  # fmt: skip
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert "--i-trust-these-students" in " ".join(done.stderr.split())
    assert not (tmp_path / "grades.csv").exists()
