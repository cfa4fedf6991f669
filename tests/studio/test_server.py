"""The local server: what it answers, and everything that it refuses."""

from __future__ import annotations

import json
import socket
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from http.client import HTTPConnection
from io import StringIO

import pytest

from graphcam.studio import server as of
from graphcam.studio.server import MAX_BODY_BYTES, StudioServer

PAGE = '<script type="application/json">{}</script><script>let a = 1;</script>'
JSON = {"Content-Type": "application/json"}


def engine(request):
    if request.get("ask") == "fail":
        raise RuntimeError("a fault on purpose")
    if request.get("ask") == "wait":
        time.sleep(request["seconds"])
    return {"seq": request.get("seq"), "ok": True}


@contextmanager
def running(
    engine=engine, write=lambda request: {"files": [request.get("kind")], "folder": "out"}
) -> Iterator[StudioServer]:
    with StudioServer(PAGE, engine, write) as server:
        thread = threading.Thread(target=server.run)
        thread.start()
        try:
            yield server
        finally:
            server._ends = {b"": 0.0}
            thread.join()


@pytest.fixture(scope="module")
def server() -> Iterator[StudioServer]:
    with running() as one:
        yield one


def bearer(server: StudioServer) -> dict[str, str]:
    return {"Authorization": f"Bearer {server.token}", **JSON}


def ask(server: StudioServer, method="POST", path="/engine", body: object = "{}", headers=None, host=None):
    """Status, headers and body of an answer."""
    connection = HTTPConnection("127.0.0.1", server.port, timeout=20)
    connection.putrequest(method, path, skip_host=True, skip_accept_encoding=True)
    connection.putheader("Host", host or f"127.0.0.1:{server.port}")
    for name, value in (bearer(server) if headers is None else headers).items():
        connection.putheader(name, value)
    if method == "POST":
        connection.putheader("Content-Length", str(len(body)))
    connection.endheaders()
    connection.send(body.encode() if method == "POST" else b"")
    with closing(connection), connection.getresponse() as answer:
        return answer.status, answer.headers, answer.read()


def raw(server: StudioServer, text: str, *later: str, pause: float = 0.0) -> bytes:
    """What comes back on bytes that no client would send."""
    with socket.create_connection(("127.0.0.1", server.port), timeout=20) as connection:
        connection.sendall(text.replace("\n", "\r\n").encode())
        got = b""
        # A server that has enough may hang up while one still speaks.
        with suppress(ConnectionError):
            for part in later:
                time.sleep(pause)
                connection.sendall(part.encode())
            while more := connection.recv(65536):
                got += more
        return got


def head(server: StudioServer, *lines: str) -> str:
    """The head of a request to the engine that lacks nothing but what the lines say."""
    token = f"Authorization: Bearer {server.token}"
    host = f"Host: 127.0.0.1:{server.port}"
    return "\n".join(["POST /engine HTTP/1.1", host, token, "Content-Type: application/json", *lines, "", ""])


def test_the_engine_answers_who_knows_the_token(server):
    status, headers, body = ask(server, body='{"seq": 3}')
    assert (status, json.loads(body)) == (200, {"seq": 3, "ok": True})
    assert headers["Content-Type"] == "application/json"


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost"])
def test_both_names_of_the_machine_are_known(server, host):
    place = f"{host}:{server.port}"
    headers = {**bearer(server), "Origin": f"http://{place}"}
    assert ask(server, host=place, headers=headers)[0] == 200


def test_it_listens_on_this_machine_alone(server):
    assert server.server_address[0] == "127.0.0.1"
    assert server.server_address[1] > 1023


def test_every_server_has_a_token_of_its_own_in_the_fragment():
    with StudioServer(PAGE, engine, engine) as one, StudioServer(PAGE, engine, engine) as other:
        assert one.token != other.token
        before, _, token = one.address.partition("#t=")
    assert before == f"http://127.0.0.1:{one.port}/"
    # 256 bits in letters of six.
    assert token == one.token
    assert len(token) * 6 >= 256


def test_the_page_needs_no_token_runs_its_own_scripts_and_stands_in_no_frame(server):
    status, headers, body = ask(server, "GET", "/", headers={})
    assert (status, body.decode()) == (200, PAGE)
    assert server.token.encode() not in body
    policy = headers["Content-Security-Policy"]
    assert "frame-ancestors 'none'" in policy
    assert "default-src 'none'" in policy
    # The SHA-256 of "let a = 1;", by openssl.
    assert policy.count("sha256-") == 1
    assert "script-src 'sha256-xY6QKfH9PRsQnLz56nj6MBwiK5oHg+im1Jkpdp1x/Ck=';" in policy


def test_nothing_else_is_a_page(server):
    assert ask(server, "POST", "/")[0] == 405
    assert ask(server, "GET", "/ru", headers={})[0] == 404


@pytest.mark.parametrize(
    ("method", "path"), [("GET", "/"), ("POST", "/engine"), ("GET", "/nothing"), ("OPTIONS", "/engine")]
)
def test_no_answer_is_stored_sniffed_or_given_to_other_origins(server, method, path):
    _, headers, _ = ask(server, method, path)
    assert headers["X-Content-Type-Options"] == "nosniff"
    assert headers["Referrer-Policy"] == "no-referrer"
    assert headers["Cache-Control"] == "no-store"
    assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]
    assert [name for name in headers if name.lower().startswith("access-control")] == []
    assert headers["Server"] == "graphcam"


@pytest.mark.parametrize("host", ["example.com", "127.0.0.1", "localhost", "127.0.0.1:1", "[::1]", "0.0.0.0", ""])
@pytest.mark.parametrize(
    ("method", "path"), [("GET", "/"), ("POST", "/engine"), ("POST", "/alive"), ("POST", "/write")]
)
def test_a_foreign_host_is_refused(server, host, method, path):
    assert raw_host(server, method, path, f"Host: {host}").startswith(b"HTTP/1.1 403 ")


def raw_host(server, method, path, host):
    rest = f"Authorization: Bearer {server.token}\nContent-Type: application/json\nContent-Length: 2\n\n{{}}"
    return raw(server, f"{method} {path} HTTP/1.1\n{host}\n{rest}")


def test_no_host_and_two_hosts_are_refused(server):
    right = f"Host: 127.0.0.1:{server.port}"
    assert raw_host(server, "POST", "/engine", "X: y").startswith(b"HTTP/1.1 403 ")
    assert raw_host(server, "POST", "/engine", f"{right}\nHost: example.com").startswith(b"HTTP/1.1 403 ")
    assert raw_host(server, "POST", "/engine", f"{right}\nHost: example.com:{server.port}").startswith(b"HTTP/1.1 403 ")


@pytest.mark.parametrize("origin", ["http://example.com", "null", "https://127.0.0.1:{port}", "http://127.0.0.1", "http://localhost:1",
                                    "http://127.0.0.1:{port}.example.com", "file://"])  # fmt: skip
@pytest.mark.parametrize(
    ("method", "path"), [("GET", "/"), ("POST", "/engine"), ("POST", "/write"), ("POST", "/alive")]
)
def test_a_foreign_origin_is_refused(server, origin, method, path):
    headers = {**bearer(server), "Origin": origin.format(port=server.port)}
    assert ask(server, method, path, headers=headers)[0] == 403


@pytest.mark.parametrize("path", ["/engine", "/write", "/alive", "/alive?end"])
@pytest.mark.parametrize(
    "change", [lambda t: "", lambda t: t[:-1], lambda t: t + "A", lambda t: t.swapcase(), lambda t: "é" * len(t)]
)
def test_a_wrong_token_is_refused(server, path, change):
    wrong = {**JSON, "Authorization": f"Bearer {change(server.token)}".encode()}
    status, headers, _ = ask(server, path=path, headers=wrong)
    assert status == 401
    # A browser would ask its user for a password.
    assert "WWW-Authenticate" not in headers


@pytest.mark.parametrize(
    "given", [{}, {"Authorization": "Basic eDp5"}, {"Cookie": "t={token}"}, {"Authorization": "{token}"}]
)
def test_a_token_is_given_as_bearer_only(server, given):
    headers = {name: value.format(token=server.token) for name, value in given.items()}
    assert ask(server, headers={**JSON, **headers})[0] == 401
    assert ask(server, path=f"/engine?t={server.token}", headers=JSON)[0] == 404


def test_a_preflight_gets_no_leave(server):
    for path in ("/", "/engine", "*"):
        headers = {"Origin": "http://example.com", "Access-Control-Request-Method": "POST"}
        assert ask(server, "OPTIONS", path, headers=headers)[0] == 403


@pytest.mark.parametrize(("method", "path"), [("GET", "/engine"), ("GET", "/write"), ("GET", "/alive"), ("POST", "/")])
def test_a_place_has_one_method(server, method, path):
    assert ask(server, method, path)[0] == 405


@pytest.mark.parametrize("method", ["PUT", "DELETE", "HEAD", "PATCH", "TRACE", "CONNECT", "NONSENSE"])
def test_other_methods_are_refused(server, method):
    assert ask(server, method, "/engine")[0] in (405, 501)


@pytest.mark.parametrize(
    "path",
    ["/x", "/engine/", "/engine?x", "/../etc/passwd", "/%2e%2e/etc/passwd", "/..%2f..%2fetc%2fpasswd",
     "/etc/passwd", "/alive?nothing", "/index.html", "http://127.0.0.1/engine", "/engine#x", "/\\..\\x",
     "/a/../../pyproject.toml"],
)  # fmt: skip
@pytest.mark.parametrize("method", ["GET", "POST"])
def test_there_are_no_other_places_and_no_files(server, method, path):
    status, _, body = ask(server, method, path)
    assert (status, json.loads(body)["error"]["message"]) == (404, "there is nothing here")


@pytest.mark.parametrize(
    "kind",
    ["text/plain", "application/x-www-form-urlencoded", "multipart/form-data", "text/json", "", "application/jsonp"],
)
def test_a_body_must_be_json_by_its_type(server, kind):
    for path in ("/engine", "/write"):
        assert ask(server, path=path, headers={**bearer(server), "Content-Type": kind})[0] == 415


@pytest.mark.parametrize(
    "body",
    ["", "{", "[]", "3", '"x"', "null", '{"a": NaN}', '{"a": Infinity}', "[" * 100_000, "\x00", '{"a": 1}x',
     '{"a": ' + "9" * 5000 + "}"],
    ids=lambda body: body[:9],
)  # fmt: skip
def test_a_body_that_is_no_table_is_refused(server, body):
    assert ask(server, body=body)[0] == 400


def test_a_body_may_have_a_mebibyte_and_no_more(server):
    whole = '{"a":"' + "x" * (MAX_BODY_BYTES - 8) + '"}'
    assert len(whole) == MAX_BODY_BYTES == 1024 * 1024
    assert ask(server, body=whole)[0] == 200
    # It is refused by what it says, before it has come.
    assert raw(server, head(server, f"Content-Length: {MAX_BODY_BYTES + 1}")).startswith(b"HTTP/1.1 413 ")


@pytest.mark.parametrize(
    ("lines", "status"),
    [
        (["Transfer-Encoding: chunked"], 411),
        (["Transfer-Encoding: chunked", "Content-Length: 2"], 411),
        (["Transfer-Encoding: gzip, chunked"], 411),
        ([], 411),
        (["Content-Length: 2", "Content-Length: 2"], 411),
        (["Content-Length: -1"], 400),
        (["Content-Length: 0x10"], 400),
        (["Content-Length: +2"], 400),
        (["Content-Length: ٢"], 400),
        (["Content-Length: " + "9" * 30], 400),
    ],
)
def test_a_body_says_its_length(server, lines, status):
    chunk = "2\r\n{}\r\n0\r\n\r\n"
    assert raw(server, head(server, *lines), chunk).startswith(f"HTTP/1.1 {status} ".encode())


def test_a_refused_body_is_not_the_next_request(server):
    smuggled = f"POST /engine HTTP/1.1\nHost: 127.0.0.1:{server.port}\n\n".replace("\n", "\r\n")
    answers = raw(server, head(server, "Transfer-Encoding: chunked"), smuggled)
    assert answers.count(b"HTTP/1.1 ") == 1


def test_one_connection_carries_many_requests(server):
    connection = HTTPConnection("127.0.0.1", server.port, timeout=20)
    for seq in range(20):
        connection.request("POST", "/engine", json.dumps({"seq": seq}), bearer(server))
        assert json.loads(connection.getresponse().read())["seq"] == seq
    connection.close()


def test_a_slow_request_is_given_up(server, monkeypatch):
    monkeypatch.setattr(of, "REQUEST_SECONDS", 0.6)
    began = time.monotonic()
    # A byte now and then does not keep it open.
    got = raw(server, head(server, "Content-Length: 100"), *"{" * 4, pause=0.25)
    assert got.startswith(b"HTTP/1.1 408 ")
    assert raw(server, "POST /engine HTT", *"P/1.", pause=0.25) == b""
    assert time.monotonic() - began < 10
    assert ask(server)[0] == 200


def test_a_body_that_breaks_off_is_refused(server):
    with socket.create_connection(("127.0.0.1", server.port), timeout=20) as connection:
        connection.sendall((head(server, "Content-Length: 100") + "{").replace("\n", "\r\n").encode())
        connection.shutdown(socket.SHUT_WR)
        assert connection.recv(65536).startswith(b"HTTP/1.1 400 ")


@pytest.mark.parametrize(
    "text",
    ["\n\n", "nonsense\n\n", "GET /\n\n", "GET / HTTP/9.9\n\n", "GET / HTTP/x\n\n", "A" * 70_000 + "\n",
     "GET / HTTP/1.1\n" + "A: b\n" * 200 + "\n", "\x16\x03\x01\x02\n\n"],
    ids=lambda text: repr(text)[:20],
)  # fmt: skip
def test_what_is_no_http_gets_no_page(server, text):
    assert b"200" not in raw(server, text)[:20]
    assert PAGE.encode() not in raw(server, text)
    assert ask(server)[0] == 200


def test_a_fault_of_the_engine_is_told_and_the_next_request_answered(server, monkeypatch):
    told = StringIO()
    monkeypatch.setattr(sys, "stderr", told)
    status, _, body = ask(server, body='{"ask": "fail"}')
    assert status == 500
    assert "graphcam has failed" in json.loads(body)["error"]["message"]
    assert ask(server)[0] == 200
    until = time.monotonic() + 10
    # It is told after the answer.
    while "a fault on purpose" not in told.getvalue() and time.monotonic() < until:
        time.sleep(0.01)
    assert "a fault on purpose" in told.getvalue()


def test_who_goes_away_leaves_no_trace(server, capfd):
    with socket.create_connection(("127.0.0.1", server.port)) as connection:
        body = '{"ask": "wait", "seconds": 0.3}'
        connection.sendall((head(server, f"Content-Length: {len(body)}").replace("\n", "\r\n") + body).encode())
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\x01\0\0\0\0\0\0\0")
    time.sleep(0.5)
    assert ask(server)[0] == 200
    assert capfd.readouterr().err == ""


def test_the_engine_is_asked_by_one_at_a_time():
    inside, most = 0, 0

    def counting(request):
        nonlocal inside, most
        inside += 1
        most = max(most, inside)
        time.sleep(0.05)
        inside -= 1
        return {"seq": request["seq"]}

    with running(counting) as server:
        answers: list[int] = []
        body = '{"seq": %d}'
        threads = [
            threading.Thread(target=lambda k=k: answers.append(json.loads(ask(server, body=body % k)[2])["seq"]))
            for k in range(8)
        ]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    assert sorted(answers) == list(range(8))
    assert most == 1


def test_an_answer_that_takes_too_long_is_an_error(monkeypatch):
    monkeypatch.setattr(of, "ANSWER_SECONDS", 0.2)
    with running() as server:
        status, _, body = ask(server, body='{"ask": "wait", "seconds": 0.5, "seq": 9}')
        answer = json.loads(body)
        assert (status, answer["seq"], answer["ok"]) == (200, 9, False)
        assert "longer than 0.2 s" in answer["error"]["message"]
        time.sleep(0.5)
        assert json.loads(ask(server, body='{"seq": 10}')[2]) == {"seq": 10, "ok": True}


def test_files_are_written_by_their_kind(server):
    status, _, body = ask(server, path="/write", body='{"kind": "sheet", "task": {}}')
    assert (status, json.loads(body)) == (200, {"files": ["sheet"], "folder": "out"})


def ends(server: StudioServer, *signs: tuple[str, str]) -> float:
    """Seconds after the last of the signs of life of tabs until the server ends."""
    thread = threading.Thread(target=server.run)
    thread.start()
    for tab, sign in signs:
        assert ask(server, path=sign, body=tab)[0] == 200
    last = time.monotonic()
    thread.join()
    return time.monotonic() - last


def test_it_ends_when_the_last_tab_has_gone(monkeypatch):
    # A browser may stand still, behind a lid or at a breakpoint, without having gone.
    assert of.LIFE_SECONDS["/alive"] >= 1800
    monkeypatch.setitem(of.LIFE_SECONDS, "/alive", 1.5)
    monkeypatch.setitem(of.LIFE_SECONDS, "/alive?end", 0.3)
    with StudioServer(PAGE, engine, engine) as server:
        assert ends(server, ("a", "/alive")) >= 1.3
    # One that says that it goes takes its own time along, and not the others'.
    with StudioServer(PAGE, engine, engine) as server:
        assert ends(server, ("a", "/alive"), ("b", "/alive"), ("b", "/alive?end")) >= 1.0
    monkeypatch.setitem(of.LIFE_SECONDS, "/alive", 60.0)
    with StudioServer(PAGE, engine, engine) as server:
        assert ends(server, ("a", "/alive"), ("a", "/alive?end")) < 30
    # Nobody listens any more.
    with pytest.raises(ConnectionRefusedError):
        ask(server)


def test_it_waits_for_the_first_tab(monkeypatch):
    monkeypatch.setitem(of.LIFE_SECONDS, "/alive", 0.0)
    with StudioServer(PAGE, engine, engine) as server:
        thread = threading.Thread(target=server.run)
        thread.start()
        time.sleep(0.6)
        assert thread.is_alive()
        assert ask(server, path="/alive", body="")[0] == 200
        thread.join()


def test_a_wrong_sign_of_life_gives_no_time(monkeypatch):
    monkeypatch.setitem(of.LIFE_SECONDS, "/alive", 0.0)
    with running() as server:
        ask(server, path="/alive", headers={})
        assert not server._ends
