"""The studio's page in a browser, asking an engine in the same process; and what is seen of it."""

from __future__ import annotations

import base64
import json
import threading
import zlib
from collections.abc import Callable
from contextlib import suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import TYPE_CHECKING, Any

from studio_tasks import BUILT_IN, plain_task

from graphcam.studio.engine import answer
from graphcam.studio.studio_page import page

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

Plain = dict[str, Any]


class Engine:
    """A server of the page and of its engine; what is asked is written down, and can be answered otherwise."""

    def __init__(self) -> None:
        self.asked: list[Plain] = []
        self.answering: Callable[[Plain], Plain] = answer
        self.html = ""
        self.server = ThreadingHTTPServer(("127.0.0.1", 0), self._handler())
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def close(self) -> None:
        self.server.shutdown()
        self.server.server_close()

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.server.server_address[1]}/"

    def serve(self, name: str = "coursework", **config: Any) -> None:
        """Serve the page of a built-in task."""
        builtin = {each: plain_task(each) for each in BUILT_IN}
        usual = {"transport": "server", "task": builtin[name], "name": name, "builtin": builtin, "writes": ["sheet"]}
        # Most tests begin with a drawing that lies still.
        usual["opening"] = "construction"
        self.html = page(usual | config)
        self.asked.clear()
        self.answering = answer

    def pictures(self) -> list[Plain]:
        """The requests of the large view."""
        return [each for each in self.asked if "station" in each]

    def answered(self, path: str, request: Plain) -> Plain:
        if path == "/engine":
            self.asked.append(request)
            return self.answering(request)
        return {"files": ["sheet.pdf"], "folder": "cam"} if path == "/write" else {}

    def _handler(engine) -> type[BaseHTTPRequestHandler]:  # noqa: N805
        class Handler(BaseHTTPRequestHandler):
            protocol_version = "HTTP/1.1"

            def do_GET(self) -> None:
                self.put(engine.html, "text/html; charset=utf-8")

            def do_POST(self) -> None:
                request = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
                self.put(json.dumps(engine.answered(self.path, request)), "application/json")

            def put(self, text: str, kind: str) -> None:
                body = text.encode()
                self.send_response(200)
                self.send_header("Content-Type", kind)
                self.send_header("Content-Length", f"{len(body)}")
                self.end_headers()
                # A page may be closed before it is answered.
                with suppress(ConnectionError):
                    self.wfile.write(body)

            def log_message(self, *_: object) -> None:
                """Nothing is written about requests."""

        return Handler


AT_REST = """async () => {
  const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  const isThere = () => window.studio && document.querySelector("#drawing [data-group], #scene .cam");
  const rests = () => isThere() && studio.isAtRest() && !document.body.classList.contains("held");
  // What a new size of a pane calls for comes with the next frame.
  for (let quiet = 0; quiet < 3; quiet = rests() ? quiet + 1 : 0) await frame();
  return true;
}"""
"""Of a page: a picture is there, no hand is down, nothing is asked or waits to be, and nothing glides."""


def settled(page: Page) -> None:
    """Wait until a picture is there, nothing is asked, and nothing moves."""
    page.wait_for_function("() => window.studio")
    page.evaluate(AT_REST)


def hand(page: Page, name: str) -> Locator:
    """The knob of a handle."""
    return page.locator(f".hand[data-id='{name}']")


def middle(knob: Locator) -> tuple[float, float]:
    box = knob.bounding_box()
    assert box
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def task_of(page: Page) -> Plain:
    return page.evaluate("() => studio.state.get().task")


def frame_of(page: Page) -> str:
    return page.evaluate("() => document.querySelector('#drawing').getAttribute('viewBox')")


def in_hash(page: Page) -> Plain:
    """What the address says."""
    letters = page.evaluate("() => location.hash").removeprefix("#1.")
    packed = base64.urlsafe_b64decode(letters + "=" * (-len(letters) % 4))
    return json.loads(zlib.decompress(packed, -15))
