"""The page and its local server in a browser: it works under its own rules, and no other page gets anything."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import pytest
from studio_pages import settled

import graphcam as gc
from graphcam.studio import server as of
from graphcam.studio.address import StudioPlace, address_of
from graphcam.studio.local_studio import local_studio, opened_address
from graphcam.studio.server import StudioServer
from graphcam.studio.task_text import built_in_tasks

pytestmark = pytest.mark.slow


@pytest.fixture
def local(tmp_path, monkeypatch) -> Iterator[tuple[StudioServer, threading.Thread]]:
    """A server that ends soon after its last tab, and what it runs in."""
    monkeypatch.setitem(of.LIFE_SECONDS, "/alive", 6.0)
    monkeypatch.setitem(of.LIFE_SECONDS, "/alive?end", 1.0)
    with local_studio(tmp_path / "out") as server:
        thread = threading.Thread(target=server.run)
        thread.start()
        yield server, thread
        server._ends = {b"": 0.0}
        thread.join()


@pytest.fixture
def window(browser):
    """A window, and what it complained of."""
    context = browser.new_context()
    page, complaints = context.new_page(), []
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    yield page, complaints
    context.close()


def test_the_page_shows_the_task_writes_and_ends_its_server(local, window, tmp_path):
    (server, thread), (page, complaints) = local, window
    foreign: list[str] = []
    own = f"http://127.0.0.1:{server.port}/"
    page.on("request", lambda one: one.url.startswith((own, "data:", "blob:")) or foreign.append(one.url))
    page.goto(opened_address(server, gc.builtin_task("arm")))
    settled(page)
    assert page.evaluate("() => studio.state.get().task.follower.arm") == 125
    # It opens with what moves, beside its diagrams.
    assert page.evaluate("() => studio.panes.map((pane) => pane.names().length)") == [1, 4]
    assert page.locator("#scene .cam").is_visible()
    # The token is nowhere to be seen or handed on.
    assert server.token not in page.url
    assert page.evaluate("() => document.cookie") == ""
    page.locator("[data-write=note]").evaluate("button => button.click()")
    page.wait_for_function("() => document.getElementById('written').textContent.includes('note.md')")
    assert {path.name for path in (tmp_path / "out").iterdir()} >= {"note.md", "solution.json"}
    # Loaded anew it knows its token still.
    page.reload()
    settled(page)
    assert page.evaluate("() => studio.state.get().task.follower.arm") == 125
    assert (complaints, foreign) == ([], [])
    assert thread.is_alive()
    page.close()
    thread.join(20)
    assert not thread.is_alive()


@contextmanager
def elsewhere(html: str) -> Iterator[str]:
    """The address of a page of another origin."""

    class Page(BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write(html.encode())

        def log_message(self, *said):
            pass

    with ThreadingHTTPServer(("127.0.0.1", 0), Page) as server:
        thread = threading.Thread(target=server.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{server.server_address[1]}/"
        server.shutdown()
        thread.join()


TRIES = """async ({ to, token }) => {
  const got = {}, body = '{"kind": "note", "task": {}}';
  const attempt = async (name, path, more) => {
    try { const answer = await fetch(to + path, more); got[name] = [answer.status, answer.type, await answer.text()]; }
    catch (error) { got[name] = error.name; }
  };
  const type = { "Content-Type": "application/json" }, bearer = { ...type, Authorization: `Bearer ${token}` };
  await attempt("page", "", {});
  await attempt("simple", "write", { method: "POST", body });
  await attempt("json", "write", { method: "POST", headers: type, body });
  await attempt("token", "write", { method: "POST", headers: bearer, body });
  await attempt("blind", "write", { method: "POST", mode: "no-cors", body });
  await attempt("alive", "alive", { method: "POST", mode: "no-cors" });
  return got;
}"""


def test_another_page_gets_nothing_even_with_the_token(local, window, tmp_path):
    (server, _), (page, _) = local, window
    asked = []
    server.write, server.engine = asked.append, asked.append
    own = f"http://127.0.0.1:{server.port}/"
    frame, form = (
        f'<iframe src="{own}"></iframe>',
        f'<form method="post" action="{own}write"><input name="kind"></form>',
    )
    with elsewhere(f'<link rel="icon" href="data:,">{frame}{form}') as address:
        page.goto(address)
        got = page.evaluate(TRIES, {"to": own, "token": server.token})
        assert got == dict.fromkeys(("page", "simple", "json", "token", "blind", "alive"), "TypeError")
        # The frame stays empty, for the page stands in no frame.
        time.sleep(0.5)
        assert page.frames[1].evaluate("() => typeof studio") == "undefined"
        page.locator("form").evaluate("form => form.submit()")
        page.wait_for_url(f"{own}write")
        assert "no other origin may ask" in page.content()
    assert asked == []
    assert not server._ends
    assert not (tmp_path / "out").exists()


def test_an_address_in_another_language_opens_the_page_in_it(local, window):
    (server, _), (page, complaints) = local, window
    place = StudioPlace(built_in_tasks()["arm"], "arm", view="profile", language="ru")
    page.goto(f"{server.address}&{address_of(place, built_in_tasks()).removeprefix('#')}")
    settled(page)
    assert page.evaluate("() => document.documentElement.lang") == "ru"
    assert page.evaluate("() => [studio.state.get().view, studio.state.get().task.follower.arm]") == ["profile", 125]
    assert page.evaluate("async () => (await addressOf(studio.config).read(location.hash)).language") == "ru"
    assert complaints == []
