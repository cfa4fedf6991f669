"""Grades hand-ins that mean harm in a process of its own, and says what did not hold: also a program.

It reads the cases' names as JSON from standard input, and writes sentences as JSON; the level is its argument.
"""

from __future__ import annotations

import ctypes
import json
import os
import socket
import sys
import tempfile
import time
from collections.abc import Generator, Iterable
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path

import hostile
import hostile_code

from graphcam.exercises.definition.exercise_file import find_exercise
from graphcam.exercises.grading.grade_one import Assignment, grade, read_submission
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.key_making import issue
from graphcam.exercises.marking.record import Record
from graphcam.exercises.running.isolation_levels import Level, ResourceLimits

STUDENT = "Anna"
SECRET = b"a secret that none may read"
MARK = "MARK OF WHAT IS SECRET"
OWNED = "graphcam-owned"
"""The name of whatever code leaves behind."""
AT_ONCE = 4
CONTROL = "control"
"""A case that means no harm: it shows that the others were run."""
LARGEST = 100_000
"""Letters of a record, whatever is handed in."""
FOUND = "[int(n) for n in os.listdir('/proc/self/fd') if int(n) > 2 and 'pipe' in os.readlink(f'/proc/self/fd/{n}')]"
PIPE = f"next(iter({FOUND}))"
"""The way out for answers, as code finds it that was not told."""
NEW_PARENT = 36
"""The number of prctl's that makes a process the parent of all orphans below it."""
SEGMENTS = tuple(Path("/proc/sysvipc", kind) for kind in ("shm", "sem", "msg"))


def faults(names: Iterable[str], level: Level, seconds: float = 2.0) -> list[str]:
    """What did not hold of some cases, in sentences."""
    ctypes.CDLL(None).prctl(NEW_PARENT, 1, 0, 0, 0)
    exercise = find_exercise("acceleration-and-scales")
    assignment = Assignment(exercise, SECRET, level, ResourceLimits(seconds=seconds))
    answer_key = issue(exercise, STUDENT, SECRET)[1].to_json()
    with tempfile.TemporaryDirectory(prefix="graphcam-hostile-") as place, listening() as server:
        before = _around()
        tempfile.tempdir = str(Path(place, "scratch"))
        Path(place, "scratch").mkdir()
        one = partial(_faults_of, assignment=assignment, answer_key=answer_key, place=Path(place), server=server)
        with ThreadPoolExecutor(AT_ONCE) as pool:
            found = [fault for some in pool.map(one, enumerate([CONTROL, *names])) for fault in some]
        found += [f"left in the folder for temporary files: {path.name}" for path in Path(place, "scratch").iterdir()]
        tempfile.tempdir = None
        found += [f"left: {left}" for left in sorted(_around() - before)]
        with suppress(TimeoutError):
            server.accept()
            found.append("the network was reached")
    return found + _processes()


@contextmanager
def listening() -> Generator[socket.socket]:
    """A server of the host's, who is to hear nothing."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(0.1)
        yield server


def source_of(case: str, told: tuple[str, str, str, str, str, int]) -> str:
    """The code of a case; the name of an answer, the places that it is after and a port are put in."""
    if case in hostile_code.CODE:
        places = dict(zip(("key", "secret", "neighbour", "grades", "port"), told[1:], strict=True))
        return hostile_code.CODE[case].format(told[0], pipe=PIPE, **places)
    code = "globals()[answer] = 12.0 + len(pipes)" if case == CONTROL else hostile_code.MORE_CODE[case]
    return hostile_code.TOLD.format(told=told) + code


def filled(folder: Path, name: str) -> None:
    """The name of an answer, put into whatever files the hand-in has."""
    for path in folder.glob("answers.*"):
        if path.is_file() and not path.is_symlink() and path.stat().st_size < 1_000_000 and os.access(path, os.W_OK):
            data = path.read_bytes()
            path.write_bytes(data.replace(b"{0}", name.encode()).replace(b"{{", b"{").replace(b"}}", b"}"))


def _faults_of(
    numbered: tuple[int, str], assignment: Assignment, answer_key: str, place: Path, server: socket.socket
) -> Generator[str]:
    """What did not hold of one case."""
    number, case = numbered
    course, name = place / str(number), assignment.exercise.answers[0].name
    folder, kept = course / STUDENT, [course / file for file in ("key.json", "secret", "Boris.toml", "grades.csv")]
    folder.mkdir(parents=True)
    for path in kept:
        path.write_text(MARK)
    if case in hostile.DATA:
        (course / "key.toml").write_text(f"{name} = {AnswerKey.from_json(answer_key).keys[name].expected.value!r}")
        hostile.DATA[case](folder)
        filled(folder, name)
    else:
        key, secret, neighbour, grades = map(str, kept)
        told = (name, key, secret, neighbour, grades, server.getsockname()[1])
        hostile.notebook(source_of(case, told))(folder)
    limit = time.monotonic() + assignment.limits.seconds + 10.0
    record = grade(assignment, read_submission(STUDENT, folder, answer_key)).record
    if time.monotonic() > limit:
        yield f"{case}: it took more than ten seconds over its limit"
    yield from (f"{case}: {why}" for why in _wrong_with(record, case, assignment.level))
    if any(path.read_text() != MARK or path.stat().st_nlink != 1 for path in kept):
        yield f"{case}: a file of the course has changed"


def _wrong_with(record: Record, case: str, level: Level) -> Generator[str]:
    """What a record says that it must not."""
    text = json.dumps(record.to_dict(), allow_nan=False)
    if (record.student, record.total, record.level) != (STUDENT, 0.0, level):
        yield f"the record is of {record.student}, with {record.total:g} marks, at {record.level}"
    if MARK in text:
        yield "what is secret was read"
    if len(text) > LARGEST:
        yield f"the record has {len(text)} letters"
    if case == CONTROL and level is not Level.L0 and record.answers[0].given != 13.0:
        yield f"what means no harm was not run: {record.notes}"


def _around() -> set[str]:
    """What outlives a process, of the host's."""
    found = {f"/tmp/{OWNED}"} if os.path.lexists(f"/tmp/{OWNED}") else set[str]()
    for folder in ("/dev/shm", "/dev/mqueue"):
        with suppress(OSError):
            found |= {str(path) for path in Path(folder).glob(f"{OWNED}*")}
    for path in (*SEGMENTS, Path("/proc/keys")):
        with suppress(OSError):
            lines = path.read_text().splitlines()
            mine = f" {os.getuid()} " if path in SEGMENTS else OWNED
            found |= {f"{path}: {line}" for line in lines if mine in line or OWNED in line}
    return found


def _processes() -> list[str]:
    """The processes that the cases left, which are this one's children now; those that are dying have ten seconds."""
    until = time.monotonic() + 10.0
    while True:
        try:
            number, _ = os.waitpid(-1, os.WNOHANG)
        except ChildProcessError:
            return []
        if not number and time.monotonic() > until:
            tasks = Path("/proc/self/task").glob("*/children")
            return [f"a process is left: {number}" for path in tasks for number in path.read_text().split()]
        if not number:
            time.sleep(0.05)


if __name__ == "__main__":
    print(json.dumps(faults(json.load(sys.stdin), Level(sys.argv[1]))))  # noqa: T201
