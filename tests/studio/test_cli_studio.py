"""``graphcam studio``: what it opens, what it writes, and how it ends."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
import webbrowser
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from http.client import HTTPConnection
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from typer.testing import CliRunner

import graphcam as gc
from graphcam.cli import app
from graphcam.studio.address import place_of
from graphcam.studio.server import StudioServer
from graphcam.studio.task_text import built_in_tasks, plain_task
from graphcam.tasks.task_file import task_from

ROOT = Path(__file__).parents[2]


@pytest.fixture
def opened(tmp_path, monkeypatch):
    """Runs the command with a server that ends at once; the addresses that were opened."""
    addresses: list[str] = []
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(StudioServer, "run", lambda self: time.sleep(0.1))
    monkeypatch.setattr(webbrowser, "open", addresses.append)

    def run(*words: object):
        return CliRunner().invoke(app, ["studio", *map(str, words)]), addresses

    return run


def shown(address: str):
    """What the page shows that an address opens."""
    token, state = re.fullmatch(r"http://127\.0\.0\.1:\d+/#t=([\w-]{43})&(1\..*)", address).groups()
    assert token not in state
    return place_of(f"#{state}", built_in_tasks())


def test_without_a_word_the_coursework_is_opened(opened):
    result, addresses = opened()
    assert result.exit_code == 0
    address, last = result.stdout.splitlines()
    assert addresses == [address]
    assert last == "It ends with its last tab, or with Ctrl-C."
    assert task_from(shown(address).task) == gc.builtin_task()


def test_a_task_file_is_opened_and_no_browser_with_no_browser(opened, tmp_path):
    CliRunner().invoke(app, ["init", "cam.toml"])
    text = (tmp_path / "cam.toml").read_text(encoding="utf-8").replace("offset = -10", "offset = 3.25")
    (tmp_path / "cam.toml").write_text(text, encoding="utf-8")
    result, addresses = opened("cam.toml", "--no-browser")
    assert addresses == []
    place = shown(result.stdout.splitlines()[0])
    assert place.task["follower"]["offset"] == 3.25
    assert task_from(place.task) == gc.load_task("cam.toml")


def test_a_measured_table_is_opened_with_its_rows(opened, tmp_path):
    task = gc.builtin_task("measured")
    rows = [f"{phi},{value * 1.01}" for phi, value in task.motion.table.rows]
    (tmp_path / "own.csv").write_text("phi_deg,s_mm\n" + "\n".join(rows), encoding="utf-8")
    text = 'rotation = "cw"\n[motion]\ntable = "own.csv"\n[follower]\nkind = "translating"\n'
    (tmp_path / "own.toml").write_text(text, encoding="utf-8")
    result, _ = opened("own.toml")
    assert result.exit_code == 0
    address = result.stdout.splitlines()[0]
    assert len(address) > 2000
    # A browser is started with it as one word of a command.
    assert len(address) < 100_000


def test_arcs_and_another_language_are_opened(opened, tmp_path):
    (tmp_path / "arcs.toml").write_text("[arcs]\nD = [51.68, 18.81]\nG = [22.24, 37.84]\nrho1 = 17\nA = [0, 40]\n")
    result, _ = opened("arcs.toml", "--language", "ru")
    place = shown(result.stdout.splitlines()[0])
    assert place.built_in == "arcs"
    assert place.task["drawing"]["language"] == "ru"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["gone.toml"], "there is no file gone.toml; check the name"),
        (["wrong.toml"], "wrong.toml: line 16: follower.kind is 'x', but must be one of"),
        (["--language", "xx"], "language is 'xx', but must be one of en, ru"),
        (["--html", "s.html"], "--pyodide is missing, but must be given with --html"),
        (["--site", "s"], "--pyodide is missing, but must be given with --site"),
        (["--site", "s", "--html", "s.html", "--pyodide", "p"], "--site is 's', but must be left out with --html"),
        (["--pyodide", "p"], "--pyodide is 'p', but must be left out without --html and --site"),
        (["--html", "s.html", "--pyodide", "gone"], "there is no file pyodide.js in the folder gone; run there: npm"),
        (["--site", "s", "--pyodide", "gone"], "there is no file pyodide.js in the folder gone; run there: npm"),
        (["--html", "", "--pyodide", "p"], None),
    ],
)
def test_wrong_input_is_one_message_and_status_2(opened, tmp_path, words, message):
    text = (ROOT / "graphcam/data/tasks/arm.toml").read_text(encoding="utf-8").replace('"oscillating"', '"x"')
    (tmp_path / "wrong.toml").write_text(text, encoding="utf-8")
    result, addresses = opened(*words)
    assert result.exit_code == 2
    # What is no word for a place is told by the reader of the command line.
    if message is not None:
        assert result.stderr.startswith(f"graphcam: {message}")
        assert result.stderr.count("\n") == 1
    assert result.stdout == ""
    assert {path.name for path in tmp_path.iterdir()} == {"wrong.toml"}
    assert addresses == []


def test_the_studio_without_a_server_is_written_with_its_task(opened, tmp_path, monkeypatch):
    written = []
    for name in ("write_one_file", "write_site"):
        monkeypatch.setattr(
            f"graphcam.studio.worker_page.{name}", lambda *given, name=name: written.append((name, *given))
        )
    for option, place in (("--html", "s.html"), ("--site", "s")):
        result, addresses = opened(option, place, "--pyodide", "p", "--language", "ru")
        assert result.exit_code == 0
        assert result.stdout == f"{place} записан\n"
    assert addresses == []
    task = replace(gc.builtin_task(), drawing=replace(gc.builtin_task().drawing, language="ru"))
    assert written == [
        ("write_one_file", Path("s.html"), Path("p"), task, "ru"),
        ("write_site", Path("s"), Path("p"), task, "ru"),
    ]


@contextmanager
def started(folder: Path) -> Iterator[tuple[subprocess.Popen, str]]:
    """The command as a process, and the address that it prints."""
    command = [sys.executable, "-m", "graphcam", "studio", "--no-browser", "--out", "out"]
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    # It may be tested by a process that does not hear Ctrl-C, and would hand that on.
    heard = {"preexec_fn": lambda: signal.signal(signal.SIGINT, signal.default_int_handler)}
    with subprocess.Popen(command, cwd=folder, env=environment, **pipes, **heard) as process:
        try:
            yield process, process.stdout.readline().strip()
        finally:
            process.kill()


def post(address: str, path: str, body: object) -> dict:
    """What the server answers who has opened the address."""
    parts = urlsplit(address)
    token = parts.fragment.partition("&")[0].removeprefix("t=")
    connection = HTTPConnection(parts.hostname, parts.port, timeout=60)
    headers = {"Authorization": f"Bearer {token}", "Content-Type": "application/json"}
    try:
        connection.request("POST", path, json.dumps(body), headers)
        return json.loads(connection.getresponse().read())
    finally:
        connection.close()


@pytest.mark.slow
def test_it_answers_writes_into_its_folder_and_ends_with_ctrl_c(tmp_path):
    task = plain_task(gc.builtin_task())
    with started(tmp_path) as (process, address):
        found = post(address, "/engine", {"seq": 1, "task": task, "views": [{"name": "profile"}]})
        assert (found["seq"], found["ok"], found["sizes"]["prime_radius"]) == (1, True, 44.0)
        written = post(address, "/write", {"kind": "note", "task": task})
        assert written == {"files": ["comparison.csv", "comparison.md", "note.md", "note.html"], "folder": "out"}
        for kind in ("../note", "/etc", "", None, 3, ["note"], {"folder": "/tmp"}):
            assert "must be one of" in post(address, "/write", {"kind": kind, "task": task})["error"]["message"]
        stolen = {**task, "motion": {"table": "/etc/passwd"}}
        for path in ("/engine", "/write"):
            error = post(address, path, {"kind": "note", "task": stolen, "folder": "/tmp/x", "out": "/tmp/x"})["error"]
            assert "no file is read here" in error["remedy"]
        process.send_signal(signal.SIGINT)
        assert process.wait(10) == 130
        assert process.stderr.read() == "graphcam: interrupted\n"
    assert sorted(path.name for path in tmp_path.rglob("*") if path.is_file()) == [
        "comparison.csv", "comparison.md", "note.html", "note.md", "solution.json",
    ]  # fmt: skip
