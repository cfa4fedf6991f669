"""The local server: it carries requests of its own page to the engine, on this machine alone.

It listens at 127.0.0.1 only, at a port that the system chooses.  The page itself holds nothing of the task; whatever
does is given to who knows the token.  No request names a file: `/write` names a
kind of files, and the folder is the one of the command line.

Other pages in the same browser can send requests to every port of this machine, and other programs and people on it
can too.  So a request must name this server as its host (a foreign name that was made to point here is refused), come
from no other origin, and bear a token that only the opened address tells.
"""

from __future__ import annotations

import hmac
import io
import json
import re
import secrets
import socket
import sys
import time
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from email.message import Message
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler
from socketserver import ThreadingTCPServer
from typing import Any

from graphcam.studio.studio_page import script_names

REQUEST_SECONDS = 10.0
"""Seconds in which a request must have arrived."""
ANSWER_SECONDS = 8.0
"""Seconds after which the engine's answer is no longer waited for."""
LIFE_SECONDS = {"/alive": 3600.0, "/alive?end": 10.0}
"""How long a server lives on after a sign of life of a tab: one that is quiet may be frozen, hidden, or behind a closed
lid; one that ends says so, but may come back, for it is loaded anew."""
MAX_TABS = 100
"""Tabs that are told apart."""
DRAIN_SECONDS = 1.0
"""Seconds for which what is left of a refused request is read."""
CHECK_INTERVAL = 0.25
"""Seconds between two looks whether there is a tab."""
Engine = Callable[[Mapping[str, Any]], Mapping[str, Any]]
EMPTY_POLICY = "default-src 'none'; frame-ancestors 'none'"
"""What a browser may do with an answer that is no page."""
PAGE_POLICY = (
    "default-src 'none'; script-src {scripts}; style-src 'unsafe-inline'; connect-src 'self'; img-src data: blob:; "
    "font-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
"""The content policy of the page: run the scripts that stand in it, ask this server, nothing else."""
HEADERS = {
    "Cache-Control": "no-store",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


TOKEN_BYTES = 32
MAX_BODY_BYTES = 1 << 20
"""Bytes of a request's body."""
JSON_TYPE = "application/json"


class RefusedError(Exception):
    """A request that is not answered: the status of HTTP, and why."""


def _single_header(headers: Message, name: str) -> str | None:
    """The value of a header that stands there once."""
    values = headers.get_all(name, [])
    return str(values[0]) if len(values) == 1 else None


class StudioServer(ThreadingTCPServer):
    """A page, and the functions that answer it.

    page : HTML; its scripts stand in it
    engine : answers requests of the page, one at a time
    write : writes the files of a kind, for a request {"kind", "task"}; one at a time too
    port, hosts, token : at which it listens; its names; what the page must know

    >>> with StudioServer("<title>page</title>", lambda request: {}, lambda request: {}) as server:
    ...     server.address.startswith("http://127.0.0.1:"), "/#t=" in server.address
    (True, True)
    """

    daemon_threads = True

    def __init__(self, page: str, engine: Engine, write: Engine) -> None:
        super().__init__(("127.0.0.1", 0), _Handler)
        # A new connection is looked for so often, see run.
        self.timeout = CHECK_INTERVAL
        self.page, self.policy = page, PAGE_POLICY.format(scripts=script_names(page) or "'none'")
        self.port, self.token = self.server_address[1], secrets.token_urlsafe(TOKEN_BYTES)
        self.hosts = f"127.0.0.1:{self.port}", f"localhost:{self.port}"
        self.engine, self.write = engine, write
        self._engine_room, self._writing_room = ThreadPoolExecutor(1), ThreadPoolExecutor(1)
        # When each tab is given up; not before the first has shown itself.
        self._ends: dict[bytes, float] = {}

    @property
    def address(self) -> str:
        """The address to be opened, with the token where no server sees it and no referrer tells it."""
        return f"http://{self.hosts[0]}/#t={self.token}"

    def run(self) -> None:
        """Serve until the last tab is closed."""
        while not self._ends or time.monotonic() < max(self._ends.values()):
            self.handle_request()

    def server_close(self) -> None:
        """Stop listening, and forget what is still waiting to be answered."""
        super().server_close()
        for room in (self._engine_room, self._writing_room):
            room.shutdown(wait=False, cancel_futures=True)

    def keep_alive(self, seconds: float, tab: bytes = b"") -> None:
        """Hear a sign of life of a tab, known by what it calls itself, which gives its server so many seconds."""
        self._ends.pop(tab, None)
        while len(self._ends) >= MAX_TABS:
            self._ends.pop(next(iter(self._ends)))
        self._ends[tab] = time.monotonic() + seconds

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Faults of the program are told; that a browser went away while it was answered is none."""
        if not isinstance(sys.exc_info()[1], OSError):
            super().handle_error(request, client_address)

    def answer(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        """The engine's answer, or the error that it takes too long; it is not interrupted, but nobody waits for it."""
        work = self._engine_room.submit(self.engine, request)
        try:
            return work.result(ANSWER_SECONDS)
        except TimeoutError:
            work.cancel()
            message = f"the answer takes longer than {ANSWER_SECONDS:g} s"
            error = {"field": "", "message": message, "remedy": "try again, or draw with fewer divisions"}
            return {"seq": request.get("seq"), "ok": False, "error": error}

    def write_files(self, request: Mapping[str, Any]) -> Mapping[str, Any]:
        """Write the files that a request asks for, one request after the other: their names, or the error."""
        return self._writing_room.submit(self.write, request).result()


class _TimedStream(io.RawIOBase):
    """What comes over a connection up to a moment: a byte now and then does not keep it open."""

    def __init__(self, connection: socket.socket) -> None:
        self.connection, self.until = connection, 0.0

    def readable(self) -> bool:
        """Whether the stream can be read: it can."""
        return True

    def readinto(self, buffer: Any) -> int:
        """How many bytes have come into a buffer."""
        self.connection.settimeout(max(self.until - time.monotonic(), 1e-6))
        return self.connection.recv_into(buffer)


class _Handler(BaseHTTPRequestHandler):
    """A connection of a browser."""

    server: StudioServer  # pyright: ignore[reportIncompatibleVariableOverride]
    protocol_version = "HTTP/1.1"
    # Head and body of an answer are not held back to be sent as one.
    disable_nagle_algorithm = True

    def setup(self) -> None:
        """Read within a time limit."""
        super().setup()
        self.rfile.close()
        self._stream = _TimedStream(self.connection)
        self.rfile = io.BufferedReader(self._stream)

    def handle_one_request(self) -> None:
        self._stream.until = time.monotonic() + REQUEST_SECONDS
        super().handle_one_request()

    def do_GET(self) -> None:
        try:
            self._answer()
        except RefusedError as error:
            self._refuse(error)
        except Exception:
            # A fault of the program: the page is told that there is one, the terminal which.
            self._refuse(RefusedError(HTTPStatus.INTERNAL_SERVER_ERROR, "graphcam has failed; see its terminal"))
            raise

    do_POST = do_GET  # noqa: N815

    def do_OPTIONS(self) -> None:
        """No other origin gets leave to ask."""
        self._refuse(RefusedError(HTTPStatus.FORBIDDEN, "no other origin may ask"))

    def _answer(self) -> None:
        self._check_place()
        if self.path == "/":
            self._check_method("GET")
            self._send(HTTPStatus.OK, "text/html; charset=utf-8", self.server.page.encode(), self.server.policy)
        elif self.path in ("/engine", "/write"):
            self._check_method("POST")
            given = self._request()
            self._send_json(self.server.answer(given) if self.path == "/engine" else self.server.write_files(given))
        elif self.path in LIFE_SECONDS:
            self._check_method("POST")
            self._check_token()
            self.server.keep_alive(LIFE_SECONDS[self.path], self._body())
            self._send_json({})
        else:
            raise RefusedError(HTTPStatus.NOT_FOUND, "there is nothing here")

    def _check_place(self) -> None:
        """Check that a request means this server, and that no foreign page has sent it."""
        hosts = self.server.hosts
        if _single_header(self.headers, "Host") not in hosts:
            raise RefusedError(HTTPStatus.FORBIDDEN, f"the host must be {hosts[0]}")
        origins = [f"http://{host}" for host in hosts]
        if "Origin" in self.headers and _single_header(self.headers, "Origin") not in origins:
            raise RefusedError(HTTPStatus.FORBIDDEN, "no other origin may ask")

    def _check_token(self) -> None:
        """Check that a request knows the token; it takes as long to refuse an almost right one as any other."""
        given, right = _single_header(self.headers, "Authorization") or "", f"Bearer {self.server.token}"
        if not hmac.compare_digest(given.encode("utf-8", "surrogateescape"), right.encode()):
            raise RefusedError(HTTPStatus.UNAUTHORIZED, "open the address that 'graphcam studio' has printed")

    def _check_method(self, method: str) -> None:
        if self.command != method:
            raise RefusedError(HTTPStatus.METHOD_NOT_ALLOWED, f"it must be {method}")

    def _request(self) -> Mapping[str, Any]:
        self._check_token()
        # A form of a foreign page, which needs no leave to be sent, cannot say that.
        if self.headers.get_content_type() != JSON_TYPE:
            raise RefusedError(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, f"the Content-Type must be {JSON_TYPE}")
        try:
            request = json.loads(self._body(), parse_constant=_no_number)
        except (ValueError, RecursionError):
            raise RefusedError(HTTPStatus.BAD_REQUEST, "the body is not JSON") from None
        if not isinstance(request, dict):
            raise RefusedError(HTTPStatus.BAD_REQUEST, "the body must be a table")
        return request

    def _body_length(self) -> int:
        """The bytes of a request's body, as it says itself."""
        said = _single_header(self.headers, "Content-Length")
        if said is None or "Transfer-Encoding" in self.headers:
            raise RefusedError(HTTPStatus.LENGTH_REQUIRED, "a body is sent with its Content-Length, not in chunks")
        if not re.fullmatch(r"[0-9]{1,18}", said):
            raise RefusedError(HTTPStatus.BAD_REQUEST, "Content-Length is a number")
        if int(said) > MAX_BODY_BYTES:
            raise RefusedError(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"a body has at most {MAX_BODY_BYTES} bytes")
        return int(said)

    def _body(self) -> bytes:
        length = self._body_length()
        try:
            body = self.rfile.read(length)
        except TimeoutError:
            raise RefusedError(HTTPStatus.REQUEST_TIMEOUT, f"a request arrives within {REQUEST_SECONDS:g} s") from None
        if len(body) < length:
            raise RefusedError(HTTPStatus.BAD_REQUEST, "the body is shorter than its Content-Length")
        return body

    def _send_json(self, answer: Mapping[str, Any]) -> None:
        text = json.dumps(answer, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
        self._send(HTTPStatus.OK, JSON_TYPE, text.encode())

    def _refuse(self, error: RefusedError) -> None:
        """Say why, and end the connection: a body that nobody has read would be taken for the next request."""
        self.close_connection = True
        status, why = error.args
        text = json.dumps({"ok": False, "error": {"field": "", "message": why, "remedy": ""}})
        self._send(status, JSON_TYPE, text.encode())
        # What still comes is read and dropped for a moment: a connection that is closed upon it takes the answer along.
        self.connection.shutdown(socket.SHUT_WR)
        self._stream.until = time.monotonic() + DRAIN_SECONDS
        with suppress(OSError):
            while self.rfile.read1(MAX_BODY_BYTES):
                pass

    def send_error(self, code: int, message: str | None = None, explain: str | None = None) -> None:
        """What the base class refuses is refused as everything else."""
        self._refuse(RefusedError(HTTPStatus(code), message or HTTPStatus(code).phrase))

    def _send(self, status: HTTPStatus, kind: str, body: bytes, policy: str = EMPTY_POLICY) -> None:
        self.connection.settimeout(REQUEST_SECONDS)
        self.send_response(status)
        headers = {"Content-Type": kind, "Content-Length": str(len(body)), "Content-Security-Policy": policy, **HEADERS}
        for name, value in (headers | ({"Connection": "close"} if self.close_connection else {})).items():
            self.send_header(name, value)
        self.end_headers()
        if self.command != "HEAD":
            self.wfile.write(body)

    def version_string(self) -> str:
        """What the server calls itself: nobody need know its versions."""
        return "graphcam"

    def log_message(self, format: str, *args: Any) -> None:  # noqa: A002 (the base class calls it so)
        """Nothing is logged: the addresses would fill the screen."""


def _no_number(said: str) -> None:
    raise ValueError(said)
