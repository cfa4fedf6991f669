"""A course, graded: the same bytes however often, by however many, after whatever interruption; nobody is left out."""

from __future__ import annotations

import csv
import json
import os
import re
import subprocess
import sys
import time
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import deadly
import pytest
from issued_variants import SECRET, answer_lines, course_of, issued, key

from graphcam.errors import GraphcamError
from graphcam.exercises.course.course_folder import TEACHER_FOLDER, AnswerKeys
from graphcam.exercises.course.submissions import hand_ins_in
from graphcam.exercises.grading import course_grading as run
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.grading.grade_one import Assignment, read_submission
from graphcam.exercises.running.isolation_levels import Level
from graphcam.exercises.running.isolation_probe import reason_unavailable
from graphcam.files import OutputError
from graphcam.workers import WorkerPool, processes, results

pytestmark = pytest.mark.slow

NAME = "acceleration-and-scales"
IDS = (
    "Анна Кузнецова", "../x", "/etc/passwd", "=cmd|' /C calc'!A0", "+1", "-2+3", "@SUM(A1)", "\t=1", "a\r=1", "a\n=1",
    "a;=1", 'a","=1', "n" * 300, "n" * 299 + "m", "CON", "anna", "Anna ", "<script>alert(1)</script>", "💣", "",
)  # fmt: skip
"""Ids that mean something to a file system, to a spreadsheet, or to a page."""


def course_at(place: Path, ids: tuple[str, ...]) -> Path:
    """A course: the first half have all right, the others have the first answer off by a tenth."""
    handed_in: dict[str, str | None] = {}
    for k, student in enumerate(ids):
        values = key(issued(NAME, student)[1])
        if k >= len(ids) / 2:
            first = next(iter(values))
            values[first] *= 1.1
        handed_in[student] = answer_lines(values)
    return course_of(place, NAME, handed_in)


@pytest.fixture(scope="module")
def ours(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return course_at(tmp_path_factory.mktemp("course"), IDS)


@pytest.fixture
def threads(monkeypatch: pytest.MonkeyPatch) -> Callable[[int], WorkerPool]:
    """Threads in place of processes, which take seconds to start."""

    def pool(workers: int, *_: str) -> WorkerPool:
        return WorkerPool(partial(ThreadPoolExecutor, workers), workers)

    monkeypatch.setattr(run, "worker_pool", lambda workers, *_: pool(workers))
    return pool


def graded(place: Path, out: Path, **more: object) -> dict[str, bytes]:
    """Everything that grading writes, by name."""
    grade_course(Course(place, place / "secret", out / "grades.csv", feedback=out / "pages", **more))  # type: ignore[arg-type]
    return written(out)


def written(out: Path) -> dict[str, bytes]:
    return {str(path.relative_to(out)): path.read_bytes() for path in sorted(out.rglob("*")) if path.is_file()}


def rows(text: bytes) -> list[dict[str, str]]:
    return list(csv.DictReader(text.decode().splitlines(keepends=True)))


@pytest.mark.usefixtures("threads")
def test_every_id_has_one_record_and_its_own_page(ours: Path, tmp_path: Path):
    files = graded(ours, tmp_path)
    records = json.loads(files["grades.json"])
    assert sorted(record["student"] for record in records) == sorted(IDS)
    assert len([name for name in files if name.startswith("pages/")]) == len(IDS)
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith(".")] == []
    assert not (tmp_path.parent / "x").exists()
    right = {record["student"] for record in records if record["total"] == record["of"]}
    assert set(IDS[: len(IDS) // 2]) <= right
    assert next(record for record in records if record["student"] == IDS[-1])["answers"][0]["outcome"] == "wrong"


@pytest.mark.usefixtures("threads")
def test_no_cell_is_a_formula(ours: Path, tmp_path: Path):
    """Also where the reader separates by semicolons or tabs, and the id is found again behind the guard."""
    files = graded(ours, tmp_path)
    for name in ("grades.csv", "grades-long.csv", "grades-moodle.csv", "grades-canvas.csv"):
        for delimiter in ",;\t":
            # As a spreadsheet splits: a line is a line also behind a lone CR.
            lines = files[name].decode().replace("\r", "\n").splitlines(keepends=True)
            for row in csv.reader(lines, delimiter=delimiter):
                for cell in row:
                    first = cell.strip(" \"'")[:1] if cell.startswith(("'", '"', " ")) else cell[:1]
                    harmless = cell.startswith("'") or first not in tuple("=+-@\t\r＝＋－＠") or number(cell)
                    assert harmless, (name, delimiter, cell)
    table = rows(files["grades.csv"])
    assert len(table) == len(IDS)
    found = {re.sub("(?<=[;\t\r\n])'(?==)", "", row["student"].removeprefix("'")) for row in table}
    assert found == set(IDS)


def number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


@pytest.mark.usefixtures("threads")
def test_an_unguarded_table_holds_formulas(ours: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """The check above finds what it looks for."""
    monkeypatch.setattr("graphcam.exercises.course.spreadsheet.cell", str)
    with pytest.raises(AssertionError):
        test_no_cell_is_a_formula(ours, tmp_path)


@pytest.mark.usefixtures("threads")
def test_grading_again_and_by_two_gives_the_same_bytes(ours: Path, tmp_path: Path):
    once = graded(ours, tmp_path / "once")
    assert graded(ours, tmp_path / "again") == once
    assert graded(ours, tmp_path / "by two", workers=2) == once
    # Over the old files too.
    assert graded(ours, tmp_path / "once") == once


@pytest.mark.usefixtures("threads")
def test_an_interrupted_run_goes_on_where_it_was(ours: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    whole = graded(ours, tmp_path / "whole")

    def interrupt(done: int, total: int) -> None:
        if done == 7:
            raise KeyboardInterrupt

    out = tmp_path / "resumed"
    order = Course(ours, ours / "secret", out / "grades.csv", feedback=out / "pages")
    with pytest.raises(KeyboardInterrupt):
        grade_course(order, interrupt)
    assert not (out / "grades.csv").exists()
    fresh: list[str] = []
    grade = run.grade
    monkeypatch.setattr(run, "grade", lambda assignment, one: fresh.append(one.student) or grade(assignment, one))
    # What a student hands in meanwhile is graded anew.
    grade_course(order)
    assert written(out) == whole
    assert len(fresh) == len(IDS) - 7


@pytest.mark.usefixtures("threads")
def test_a_changed_hand_in_is_not_taken_from_the_interrupted_run(tmp_path: Path):
    exercise, place = issued(NAME)[0], course_at(tmp_path / "course", ("Anna", "Boris"))
    out = tmp_path / "grades.csv"

    def interrupt(done: int, total: int) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        grade_course(Course(place, place / "secret", out), interrupt)
    (place / "students" / "Anna" / "answers.toml").write_text("")
    grade_course(Course(place, place / "secret", out))
    # Without any answer nothing is handed in.
    left = f"{exercise.marks - exercise.answers[0].marks:g}"
    assert [row["total"] for row in rows(out.read_bytes())] == ["", left]


@pytest.mark.usefixtures("threads")
@pytest.mark.parametrize("torn", [1, 40, 10_000])
def test_a_torn_journal_costs_only_the_records_that_are_torn(
    ours: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, torn: int
):
    """As a machine leaves it that stops while it writes; a second interruption appends to what is torn."""
    whole = graded(ours, tmp_path / "whole")

    def interrupt(done: int, total: int) -> None:
        if done == stop:
            raise KeyboardInterrupt

    out, stop = tmp_path / "resumed", 7
    order = Course(ours, ours / "secret", out / "grades.csv", feedback=out / "pages")
    with pytest.raises(KeyboardInterrupt):
        grade_course(order, interrupt)
    (journal,) = out.glob(".*/records.jsonl")
    journal.write_bytes(journal.read_bytes()[:-torn])
    stop = 12
    with pytest.raises(KeyboardInterrupt):
        grade_course(order, interrupt)
    fresh: list[str] = []
    grade = run.grade
    monkeypatch.setattr(run, "grade", lambda assignment, one: fresh.append(one.student) or grade(assignment, one))
    grade_course(order)
    assert written(out) == whole
    assert len(fresh) == len(IDS) - 12


def test_a_folder_that_may_not_be_looked_into_is_one_hand_in(tmp_path: Path):
    (tmp_path / "Anna").mkdir(mode=0o000)
    user = os.geteuid()
    if user == 0:
        os.seteuid(65534)  # root may look into everything
    try:
        submission = read_submission("Anna", tmp_path / "Anna", assignment="week-5")
    finally:
        os.seteuid(user)
        (tmp_path / "Anna").chmod(0o700)
    assert submission.files == {}
    assert [str(error) for error in submission.errors] == ["the submission is not a folder"]


@pytest.mark.usefixtures("threads")
def test_students_may_be_called_students_and_teacher_and_hand_in_a_file_for_the_folder(tmp_path: Path):
    names = ["Anna", "students", "teacher"]
    for name in names:
        (tmp_path / "hand-ins" / name).mkdir(parents=True)
    (tmp_path / "hand-ins" / "read-me.txt").touch()
    (tmp_path / "secret").write_bytes(SECRET)
    order = Course(tmp_path / "hand-ins", tmp_path / "secret", tmp_path / "grades.csv", exercise=NAME)
    grade_course(order)
    assert [row["student"] for row in rows(order.out.read_bytes())] == names
    (tmp_path / "hand-ins" / "Anna").rmdir()
    (tmp_path / "hand-ins" / "Anna").write_text("mu_s = 1")
    grade_course(order)
    table = rows(order.out.read_bytes())
    assert [row["student"] for row in table] == names
    assert "not a folder" in table[0]["notes"]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"folder": "nowhere"}, r"there is no folder \S*nowhere; check the name"),
        ({"folder": "secret"}, r"secret: the folder is a file, but must be one with a folder for every student"),
        (
            {"secret_file": "lost"},
            r"there is no file \S*lost; name the file with the secret that the course was made with",
        ),
        ({"secret_file": "."}, r": the secret is a folder, but must be a file .*; name the file in it"),
        ({"secret_file": "other"}, r"other: the secret is another one"),
        ({"exercise": "integration"}, r"--exercise.*'integration'.*'acceleration-and-scales'"),
        ({"feedback": "secret"}, r"secret.*is a file"),
        # With nbgrader, which the extra `test` does not bring.
        pytest.param(
            {"gradebook": "gradebook"}, r"--gradebook: the grade book is gradebook \(", marks=pytest.mark.slow
        ),
        pytest.param(
            {"gradebook": "sqlite:////nowhere/to/be/found.db"}, r"--gradebook: .*unable to open", marks=pytest.mark.slow
        ),
    ],
)
def test_wrong_input_is_told_before_anything_is_graded(
    ours: Path, tmp_path: Path, wrong: dict[str, str], message: str
):  # fmt: skip
    (tmp_path / "other").write_bytes(b"of another course")
    (tmp_path / "secret").write_bytes(SECRET)
    places = {name: tmp_path / text if name in ("folder", "secret_file", "feedback") else text
              for name, text in wrong.items()}  # fmt: skip
    kept = {path: path.read_bytes() for path in sorted((ours / TEACHER_FOLDER).rglob("*")) if path.is_file()}
    order = Course(ours, tmp_path / "secret", tmp_path / "out" / "grades.csv")
    with pytest.raises(GraphcamError, match=message):
        grade_course(replace(order, **places))  # type: ignore[arg-type]
    assert sorted(path.name for path in tmp_path.iterdir()) == ["other", "secret"]
    assert all(path.read_bytes() == before for path, before in kept.items())


@pytest.mark.usefixtures("threads")
@pytest.mark.parametrize(
    ("was", "now", "field"),
    [
        ("lift = { start = 15, stop = 50", "lift = { start = 16, stop = 60", "parameters.lift"),
        ("version = 5", "version = 6", "version"),
    ],
)
def test_an_exercise_that_draws_other_variants_than_were_handed_out_is_refused(
    tmp_path: Path, was: str, now: str, field: str
):
    place = course_at(tmp_path / "course", ("anna", "boris"))
    file = place / TEACHER_FOLDER / f"{NAME}.toml"
    text = file.read_text(encoding="utf-8")
    assert was in text
    # The marks of an answer may change.
    file.write_text(text.replace("marks = 2", "marks = 3", 1), encoding="utf-8")
    graded(place, tmp_path / "grades.csv")
    file.write_text(text.replace(was, now), encoding="utf-8")
    with pytest.raises(GraphcamError, match=rf"{field} is changed, but must be as it was when the handouts were made"):
        graded(place, tmp_path / "other.csv")


def test_a_second_run_into_the_same_grades_waits_for_the_first(tmp_path: Path):
    store = run.Store.for_run(tmp_path / "new" / "grades.csv", assignment())
    with store.lock(), pytest.raises(OutputError, match=r"grades\.csv.*another run is grading into it"), store.lock():
        pass
    # The next one may, and where nothing was graded nothing is left.
    with store.lock():
        pass
    assert list(tmp_path.iterdir()) == []


LOADED = """
import sys
from graphcam.cli import app
app(sys.argv[1:], standalone_mode=False)
print(*{name.partition(".")[0] for name in sys.modules})
"""


@pytest.mark.usefixtures("threads")
def test_the_command_loads_only_what_reads_marks_and_reports(ours: Path, tmp_path: Path):
    """What draws, solves and shows costs more time than a group of students; by processes the files are the same.

    Only a student's page shows a drawing.
    """
    command = [sys.executable, "-c", LOADED, "exercise", "grade", str(ours), "--secret-file", str(ours / "secret")]
    plain = ["--out", str(tmp_path / "plain" / "grades.csv")]
    ran = subprocess.run([*command, *plain], check=True, capture_output=True, text=True)
    loaded = set(ran.stdout.splitlines()[-1].split())
    assert {"graphcam", "numpy"} <= loaded
    assert loaded.isdisjoint({"matplotlib", "scipy", "ezdxf", "rich", "nbformat", "distributed"})
    paged = ["--out", str(tmp_path / "command" / "grades.csv"), "--feedback", str(tmp_path / "command" / "pages")]
    subprocess.run([*command, *paged], check=True, capture_output=True)
    assert written(tmp_path / "command") == graded(ours, tmp_path / "here")


def test_a_run_that_is_killed_goes_on(ours: Path, tmp_path: Path):
    """By SIGKILL, from the command line; whole batches of a real pool are lost, none is done twice."""
    command = [sys.executable, "-m", "graphcam", "exercise", "grade", str(ours), "--secret-file", str(ours / "secret"),
               "--workers", "2"]  # fmt: skip
    whole = tmp_path / "whole"
    subprocess.run([*command, "--out", str(whole / "grades.csv")], check=True, capture_output=True, text=True)
    out = tmp_path / "killed"
    slow = subprocess.Popen([*command, "--out", str(out / "grades.csv")], stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL, start_new_session=True)  # fmt: skip
    deadline = time.monotonic() + 60
    while not list(out.glob(".*/records.jsonl")) and slow.poll() is None and time.monotonic() < deadline:
        time.sleep(0.001)
    slow.kill()
    slow.wait()
    # Its workers end too, instead of waiting for jobs for ever.
    while session(slow.pid) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert session(slow.pid) == []
    subprocess.run([*command, "--out", str(out / "grades.csv")], check=True, capture_output=True, text=True)
    assert written(out) == written(whole)


PAGES = """
import sys, time
from pathlib import Path
from graphcam.exercises.grading.course_grading import Course, grade_course
from graphcam.exercises.reports import report_files
page, seen = report_files.student_page, []
def slow(*given, **more):
    if seen:
        print("half of them", flush=True)
        time.sleep(60)
    seen.append(given)
    return page(*given, **more)
report_files.student_page = slow
folder, out, feedback = map(Path, sys.argv[1:])
grade_course(Course(folder, folder / "secret", out, feedback=feedback))
"""


@pytest.mark.parametrize("later", ["pages", "elsewhere", ""])
def test_pages_that_a_killed_run_left_are_cleared_by_the_next(later: str, ours: Path, tmp_path: Path):
    """Also by one that writes its pages elsewhere, or none."""
    out, pages = tmp_path / "grades.csv", tmp_path / "pages"
    with subprocess.Popen([sys.executable, "-c", PAGES, ours, out, pages], stdout=subprocess.PIPE, text=True) as run:
        assert run.stdout is not None
        assert run.stdout.readline() == "half of them\n"
        run.kill()
    assert len(list(tmp_path.glob("**/new/*.html"))) == 1
    feedback = tmp_path / later if later else None
    grade_course(Course(ours, ours / "secret", out, feedback=feedback))
    assert list(tmp_path.rglob(".graphcam-draft-*")) == []
    assert pages.exists() is (later == "pages")
    # Neither is what was noted of them kept.
    assert [path.name for path in tmp_path.glob(".*")] == []


def test_a_run_that_is_killed_ends_the_code_that_it_runs(tmp_path: Path):
    if os.getuid() == 0 and reason_unavailable(Level.L1):
        pytest.skip(str(reason_unavailable(Level.L1)))
    scratch, source = tmp_path / "scratch", "import time\nopen('begun', 'w').close()\ntime.sleep(100)"
    cell = {"cell_type": "code", "metadata": {}, "source": source, "outputs": []}
    for student in ("Anna", "Boris", "Clara"):
        (tmp_path / "hand-ins" / student).mkdir(parents=True)
        (tmp_path / "hand-ins" / student / "answers.ipynb").write_text(json.dumps({"cells": [cell]}))
    scratch.mkdir()
    (tmp_path / "secret").write_bytes(SECRET)
    command = [sys.executable, "-m", "graphcam", "exercise", "grade", str(tmp_path / "hand-ins"), "--exercise", NAME,
               "--secret-file", str(tmp_path / "secret"), "--out", str(tmp_path / "grades.csv"), "--workers", "2",
               "--level", "L1", "--i-trust-these-students", "--seconds", "60"]  # fmt: skip
    run = subprocess.Popen(command, stderr=subprocess.DEVNULL, env={**os.environ, "TMPDIR": str(scratch)})
    deadline = time.monotonic() + 60
    while not list(scratch.glob("*/begun")) and time.monotonic() < deadline:
        time.sleep(0.01)
    run.kill()
    run.wait()
    while list(scratch.glob("graphcam-run-*")) and time.monotonic() < deadline:
        time.sleep(0.01)
    # The worker removes the folder when the code has ended, and begins with nobody else's.  An empty one of the killed
    # process itself, which nobody could remove, stays.
    assert list(scratch.glob("graphcam-run-*")) == []
    assert [path for folder in scratch.iterdir() for path in folder.iterdir()] == []


def session(leader: int) -> list[str]:
    """The processes of a session that run."""
    found: list[str] = []
    for path in Path("/proc").glob("[0-9]*/stat"):
        with suppress(OSError):
            state, _, _, number = path.read_text().rpartition(")")[2].split()[:4]
            if int(number) == leader and state != "Z":
                found.append(path.parent.name)
    return found


def test_a_worker_that_dies_costs_one_record_only(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    ids = tuple(f"{'deadly' if k in (3, 20) else 'student'} {k:02d}" for k in range(24))
    place = tmp_path / "course"
    for student in ids:
        (place / student).mkdir(parents=True)
        (place / student / "answers.toml").write_text("")
    monkeypatch.setattr(run, "grade", deadly.grade)
    store = run.Store.for_run(tmp_path / "grades.csv", assignment())
    kept = AnswerKeys(tmp_path)
    records = run.grade_folder(hand_ins_in(place, kept)[0], assignment(), processes(2), store, kept)
    assert [record["student"] for record in records] == sorted(ids)
    broken = [record["student"] for record in records if any("failed" in note for note in record["notes"])]
    assert broken == [student for student in sorted(ids) if student.startswith("deadly")]


def assignment() -> Assignment:
    return Assignment(issued(NAME)[0], SECRET)


@pytest.mark.filterwarnings("ignore")  # of the cluster's own closing
def test_processes_and_a_cluster_give_the_same_bytes(ours: Path, tmp_path: Path):
    from distributed import LocalCluster

    one = graded(ours, tmp_path / "one", workers=1)
    assert graded(ours, tmp_path / "two", workers=2) == one
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        assert graded(ours, tmp_path / "cluster", cluster=cluster.scheduler_address) == one


class Fragile(ThreadPoolExecutor):
    """Breaks after one job, as a pool does whose worker is killed while it waits."""

    done = 0

    def submit(self, *args: Any, **more: Any) -> Any:
        self.done += 1
        if self.done > 1:
            raise BrokenExecutor
        return super().submit(*args, **more)


def test_an_executor_that_breaks_between_two_jobs_costs_no_record():
    pool = WorkerPool(partial(Fragile, 1), 1)
    assert sorted(results(pool, abs, range(-40, 0))) == [(k, -k) for k in range(-40, 0)]


def test_jobs_are_shared_out_and_come_back_each_once():
    pool = WorkerPool(partial(ThreadPoolExecutor, 3), 3)
    assert sorted(results(pool, abs, range(-100, 0))) == [(k, -k) for k in range(-100, 0)]
