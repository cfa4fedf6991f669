"""The studio without a server, in Chromium: the engine in WebAssembly against the same engine here."""

from __future__ import annotations

import functools
import gzip
import json
import math
import re
import threading
from contextlib import contextmanager
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from itertools import islice

import pytest
from chromium import chromium
from golden_random import TASKS
from programs import pyodide_folder
from studio_tasks import BUILT_IN, builtin

from graphcam.studio.engine import answer
from graphcam.studio.task_text import plain_task
from graphcam.studio.worker_page import write_one_file, write_site

pytestmark = pytest.mark.slow
MEGABYTE = 1_000_000
TOLERANCE = 1e-12
STARTED_IN = 300
"""Seconds at most, on a machine with much else to do."""


@pytest.fixture(scope="module")
def pyodide(tmp_path_factory):
    return pyodide_folder(tmp_path_factory.mktemp("pyodide"))


@pytest.fixture(scope="module")
def browser():
    with chromium() as started:
        yield started


@pytest.fixture(scope="module")
def one_file(tmp_path_factory, pyodide):
    path = tmp_path_factory.mktemp("one-file") / "studio.html"
    write_one_file(path, pyodide, builtin("coursework"))
    return path


@contextmanager
def opened(browser, address):
    """A page whose engine has answered, with all that it asked for and complained of."""
    context = browser.new_context()
    page = context.new_page()
    page.asked, page.wrong = [], []
    context.on("request", lambda request: page.asked.append(request.url))
    page.on("pageerror", lambda error: page.wrong.append(str(error)))
    page.on("console", lambda message: page.wrong.append(message.text) if message.type == "error" else None)
    page.goto(address)
    answers(page)
    yield page
    context.close()


def answers(page) -> None:
    """Wait until the engine has answered; the page permits no text to be made a program, so it is asked."""
    for _ in range(STARTED_IN * 2):
        if page.evaluate("Boolean(window.studio?.stats.length)"):
            return
        assert page.wrong == []
        page.wait_for_timeout(500)
    raise AssertionError("the engine has not answered")


@pytest.fixture(scope="module")
def page(browser, one_file):
    with opened(browser, one_file.as_uri()) as page:
        yield page


def test_one_file_opens_without_a_request(page, one_file):
    assert one_file.stat().st_size <= 9 * MEGABYTE
    foreign = [url for url in page.asked if not url.startswith((one_file.as_uri(), "blob:"))]
    assert foreign == []
    assert page.wrong == []
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', one_file.read_text(encoding="utf-8"))[1]
    assert "connect-src" not in policy
    assert "'unsafe-inline'" not in re.search("script-src[^;]*", policy)[0]
    assert page.evaluate("fetch('https://example.org').then(() => 'came', () => 'refused')") == "refused"


def test_the_first_picture_is_there_before_the_engine(browser, one_file):
    page = browser.new_page()
    page.goto(one_file.as_uri())
    assert page.evaluate("[studio.stats.length, document.querySelectorAll('#steps-beside g').length > 5]") == [0, True]
    page.close()


def wanted(task) -> dict:
    plain = json.loads(json.dumps(plain_task(task)))
    return {"ask": "views", "seq": 1, "language": "en", "task": plain, "views": [], "values": True}


def numbers(found: dict) -> dict:
    """Every quantity, drawn and exact; or why there is none."""
    if not found["ok"]:
        return found["error"]
    return {(value["id"], kind): value[kind] for value in found["values"] for kind in ("drawn", "exact")} | found[
        "sizes"
    ]


def same(one, other) -> bool:
    if isinstance(one, float | int) and isinstance(other, float | int):
        return math.isclose(one, other, rel_tol=TOLERANCE, abs_tol=TOLERANCE)
    return one == other


ASKED = {name: builtin(name) for name in BUILT_IN} | dict(islice(TASKS.items(), 0, 75, 6))


def test_quantities_are_those_of_this_machine(page):
    for name, task in ASKED.items():
        here = numbers(json.loads(json.dumps(answer(wanted(task)))))
        there = numbers(page.evaluate("request => studio.ask(request)", wanted(task)))
        assert here.keys() == there.keys(), name
        assert [key for key in here if not same(here[key], there[key])] == [], name
    assert len(ASKED) >= 18


def test_the_engine_speaks_russian(page):
    request = {**wanted(builtin("coursework")), "language": "ru", "told": True}
    request["views"] = [{"name": "combined", "px_per_mm": 2.0}]
    here = json.loads(json.dumps(answer(request)))["views"][0]
    there = page.evaluate("request => studio.ask(request)", request)["views"][0]
    assert here["title"] == there["title"]
    assert [step["caption"] for step in here["steps"].values()] == [s["caption"] for s in there["steps"].values()]


def test_an_error_is_an_answer(page):
    request = wanted(builtin("coursework"))
    request["task"]["follower"]["offset"] = "left"
    assert page.evaluate("request => studio.ask(request)", request)["error"] == answer(request)["error"]


# --- a site ----------------------------------------------------------------------------------------------------------


class Silent(SimpleHTTPRequestHandler):
    """A web server that says nothing."""

    def log_message(self, *_: object) -> None:
        """Nothing."""


@contextmanager
def served(folder):
    with ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Silent, directory=folder)) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}/"
        server.shutdown()


def test_a_site_works_without_a_network_after_the_first_visit(browser, pyodide, tmp_path):
    write_site(tmp_path / "site", pyodide, builtin("arm"))
    sizes = [len(gzip.compress(path.read_bytes())) for path in (tmp_path / "site").iterdir()]
    assert sum(sizes) <= 7.5 * MEGABYTE
    with served(tmp_path / "site") as address, opened(browser, address) as page:
        assert [url for url in page.asked if not url.startswith((address, f"blob:{address}"))] == []
        page.evaluate("navigator.serviceWorker.ready.then(() => true)")
        assert len(page.evaluate("caches.keys()")) == 1
        page.context.set_offline(True)
        page.reload()
        answers(page)
        found = page.evaluate("request => studio.ask(request)", wanted(builtin("arm")))
        assert numbers(found).keys() == numbers(answer(wanted(builtin("arm")))).keys()
        assert page.wrong == []
