"""The studio in Firefox, steered by its own protocol: from the local server, and as one file with WebAssembly."""

from __future__ import annotations

import json
import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

import pytest
from programs import program, pyodide_folder
from studio_pages import Engine

import graphcam as gc
from graphcam.studio.address import StudioPlace, address_of
from graphcam.studio.task_text import built_in_tasks
from graphcam.studio.worker_page import write_one_file

pytestmark = pytest.mark.slow

PREFERENCES = 'user_pref("marionette.port", 0);\nuser_pref("datareporting.policy.dataSubmissionEnabled", false);\n'
SETTLED = "return Boolean(window.studio && document.querySelector('#drawing [data-group]') && studio.quiet())"
OFFSET = "return studio.state.get().task.follower.offset"
DRAWN = "return document.getElementById('drawing').innerHTML"
STARTED_IN = 300
"""Seconds at most, on a machine with much else to do."""


class Firefox:
    """A client of Marionette, by which Firefox is steered: messages of JSON, each behind its length."""

    def __init__(self, port: int) -> None:
        self.socket = socket.create_connection(("127.0.0.1", port))
        self.read = self.socket.makefile("rb")
        self.number = 0
        self._message()
        self.do("WebDriver:NewSession")

    def _message(self) -> Any:
        digits = b""
        while not digits.endswith(b":"):
            digits += self.read.read(1)
        return json.loads(self.read.read(int(digits[:-1])))

    def do(self, command: str, **values: Any) -> Any:
        self.number += 1
        message = json.dumps([0, self.number, command, values]).encode()
        self.socket.sendall(b"%d:%b" % (len(message), message))
        _, _, error, found = self._message()
        assert error is None, error
        return found

    def close(self) -> None:
        self.read.close()
        self.socket.close()

    def script(self, text: str) -> Any:
        return self.do("WebDriver:ExecuteScript", script=text, args=[])["value"]

    def wait(self, text: str) -> None:
        end = time.monotonic() + STARTED_IN
        while not self.script(text):
            assert time.monotonic() < end, text
            time.sleep(0.1)


@pytest.fixture(scope="module")
def firefox(tmp_path_factory) -> Iterator[Firefox]:
    profile = tmp_path_factory.mktemp("firefox")
    (profile / "user.js").write_text(PREFERENCES, encoding="utf-8")
    command = [program("firefox-esr"), "--headless", "--marionette", "--no-remote", "--profile", str(profile)]
    with started(command):
        active = profile / "MarionetteActivePort"
        end = time.monotonic() + STARTED_IN
        while not (active.exists() and active.read_text(encoding="utf-8")):
            assert time.monotonic() < end
            time.sleep(0.1)
        with closing(Firefox(int(active.read_text(encoding="utf-8")))) as client:
            yield client


@contextmanager
def started(command: list[str]) -> Iterator[None]:
    running = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        running.terminate()
        running.wait(60)


def moved_by_keys(firefox: Firefox) -> None:
    """A key on the slider of the offset moves it, the picture follows, and undo brings both back."""
    firefox.wait(SETTLED)
    before, drawn = firefox.script(OFFSET), firefox.script(DRAWN)
    firefox.script("document.querySelector('[data-key=\"follower.offset/range\"]').focus()")
    slider = firefox.do("WebDriver:GetActiveElement")["value"]
    (key,) = slider.values()
    firefox.do("WebDriver:ElementSendKeys", id=key, text="\ue014")
    firefox.wait(f"{OFFSET.replace('return ', 'return (')}) > {before}")
    firefox.wait(SETTLED)
    assert firefox.script(DRAWN) != drawn
    firefox.script("document.getElementById('undo').click()")
    firefox.wait(f"{OFFSET.replace('return ', 'return (')}) === {before}")
    firefox.wait(SETTLED)


def test_a_size_is_moved_by_a_key(firefox):
    engine = Engine()
    engine.serve()
    firefox.do("WebDriver:Navigate", url=engine.url)
    moved_by_keys(firefox)
    engine.close()


@pytest.mark.slow
def test_the_one_file_works_without_a_server(firefox, tmp_path_factory):
    page = Path(tmp_path_factory.mktemp("one-file"), "studio.html")
    write_one_file(page, pyodide_folder(tmp_path_factory.mktemp("pyodide")), gc.builtin_task())
    # Not the cam that turns: its picture is never at rest.
    shown = address_of(StudioPlace(built_in_tasks()["coursework"], view="combined"), built_in_tasks())
    firefox.do("WebDriver:Navigate", url=page.as_uri() + shown)
    # Before the engine is there a picture made beforehand is shown.
    firefox.wait("return studio.stats.length > 0")
    moved_by_keys(firefox)
