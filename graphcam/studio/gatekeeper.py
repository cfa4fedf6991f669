"""Who may ask the local server: the page that it has served itself, opened with the token, and nobody else.

Other pages in the same browser can send requests to every port of this machine, and other programs and people on it
can too.  So a request must name this server as its host (a foreign name that was made to point here is refused), come
from no other origin, and bear a token that only the opened address tells.
"""

from __future__ import annotations

import hmac
import re
import secrets
from dataclasses import dataclass
from email.message import Message
from http import HTTPStatus

TOKEN_BYTES = 32
LARGEST = 1 << 20
"""Bytes of a request's body."""
JSON = "application/json"


class RefusedError(Exception):
    """A request that is not answered: the status of HTTP, and why."""

    def __init__(self, status: HTTPStatus, why: str) -> None:
        super().__init__(status, why)
        self.status = status
        self.why = why


def new_token() -> str:
    """256 random bits, in letters that an address may hold.

    >>> len(new_token()), new_token() != new_token()
    (43, True)
    """
    return secrets.token_urlsafe(TOKEN_BYTES)


@dataclass(frozen=True)
class Gatekeeper:
    """What a request must say of itself.

    port : the one at which the server listens
    token : what the page must know
    """

    port: int
    token: str

    @property
    def hosts(self) -> tuple[str, ...]:
        """The names of the server."""
        return f"127.0.0.1:{self.port}", f"localhost:{self.port}"

    def check_place(self, headers: Message) -> None:
        """Check that a request means this server, and that no foreign page has sent it.

        Raises
        ------
        RefusedError : it names another host, or comes from another origin
        """
        if _only(headers, "Host") not in self.hosts:
            raise RefusedError(HTTPStatus.FORBIDDEN, f"the host must be {self.hosts[0]}")
        if "Origin" in headers and _only(headers, "Origin") not in [f"http://{host}" for host in self.hosts]:
            raise RefusedError(HTTPStatus.FORBIDDEN, "no other origin may ask")

    def check_token(self, headers: Message) -> None:
        """Check that a request knows the token; it takes as long to refuse an almost right one as any other.

        Raises
        ------
        RefusedError : it does not
        """
        given, right = _only(headers, "Authorization") or "", f"Bearer {self.token}"
        if not hmac.compare_digest(given.encode("utf-8", "surrogateescape"), right.encode()):
            raise RefusedError(HTTPStatus.UNAUTHORIZED, "open the address that 'graphcam studio' has printed")


def body_length(headers: Message) -> int:
    """The bytes of a request's body, as it says itself.

    Raises
    ------
    RefusedError : it says no length, or one that is too large

    >>> from email import message_from_string
    >>> body_length(message_from_string("Content-Length: 12"))
    12
    """
    if "Transfer-Encoding" in headers:
        raise RefusedError(HTTPStatus.LENGTH_REQUIRED, "a body is sent with its Content-Length, not in chunks")
    said = _only(headers, "Content-Length")
    if said is None:
        raise RefusedError(HTTPStatus.LENGTH_REQUIRED, "a body is sent with its Content-Length")
    if not re.fullmatch(r"[0-9]{1,18}", said):
        raise RefusedError(HTTPStatus.BAD_REQUEST, "Content-Length is a number")
    if int(said) > LARGEST:
        raise RefusedError(HTTPStatus.REQUEST_ENTITY_TOO_LARGE, f"a body has at most {LARGEST} bytes")
    return int(said)


def check_json(headers: Message) -> None:
    """Check that a body is JSON: a form of a foreign page, which needs no leave to be sent, cannot say that.

    Raises
    ------
    RefusedError : it is something else

    >>> from email import message_from_string
    >>> check_json(message_from_string("Content-Type: application/json; charset=utf-8"))
    """
    if headers.get_content_type() != JSON:
        raise RefusedError(HTTPStatus.UNSUPPORTED_MEDIA_TYPE, f"the Content-Type must be {JSON}")


def _only(headers: Message, name: str) -> str | None:
    """The value of a header that stands there once."""
    values = headers.get_all(name, [])
    return str(values[0]) if len(values) == 1 else None
