"""The code on a page of a worksheet: whose page of which exercise it is, signed with the course's secret; no key."""

from __future__ import annotations

import hashlib
import hmac
from collections.abc import Iterable
from dataclasses import dataclass
from urllib.parse import quote, unquote

from graphcam.errors import TaskError
from graphcam.words import Words, say

CODE_PREFIX = "GC1"
"""What every code begins with: the program and how the fields stand."""
MAX_NAME_LENGTH = 32
"""Letters of a name in the code: a longer one would take modules finer than a camera sees, and is a digest."""
SIGNATURE_DIGITS = 8
"""Hex digits of the signature: one in four thousand millions is guessed."""
DIGEST_PREFIX = "~"
"""What a digest begins with, which no quoted name does."""


@dataclass(frozen=True)
class SheetCode:
    """What the code of a page says.

    exercise, version : of the exercise, by its name
    student : the student's id
    draw : of the variant
    page : of the worksheet, from 1
    """

    exercise: str
    version: int
    student: str
    draw: int
    page: int

    def text(self, secret: bytes) -> str:
        """The text of the code, signed with the secret.

        >>> SheetCode("inversion-arm", 3, "Anna M", 0, 1).text(b"secret")
        'GC1/inversion-arm/3/Anna%20M/0/1/e10609d7'
        """
        names = _short_name(self.exercise), str(self.version), _short_name(self.student), str(self.draw), str(self.page)
        said = "/".join((CODE_PREFIX, *names))
        return f"{said}/{_signature(said, secret)}"

    @staticmethod
    def from_text(text: str, secret: bytes, students: Iterable[str], exercise: str = "") -> SheetCode:
        """What a code says that was found on a photograph.

        students : the ids of those in the course
        exercise : the name of the one that the course is about, where that is known

        Raises
        ------
        TaskError : it is none of ours, of another course, or somebody wrote it who has not the secret
        """
        kind, *fields = text.split("/")
        if kind != CODE_PREFIX or len(fields) != 6:
            limit = say("that of a worksheet")
            raise _refused(say("none of graphcam's"), limit, say("photograph the worksheet of this course"))
        said, _, signature = text.rpartition("/")
        if not hmac.compare_digest(signature.encode(), _signature(said, secret).encode()):
            found = say("signed with another secret, or changed")
            limit = say("signed with this course's secret")
            raise _refused(found, limit, say("look whose sheet it is, and of which course"))
        name, version, student, draw, page = fields[:5]
        if exercise and name != _short_name(exercise):
            raise _refused(f"of {unquote(name)!r}", f"of {exercise!r}", say("put it to the other exercise"))
        of = next((each for each in students if _short_name(each) == student), None)
        if of is None:
            who = f"of {unquote(student)!r}"
            raise _refused(who, say("of a student of this course"), say("look whether the roster has changed"))
        # It is signed, so these are numbers.
        return SheetCode(exercise or unquote(name), int(version), of, int(draw), int(page))


def _refused(found: Words, wanted: Words, remedy: Words) -> TaskError:
    return TaskError("photograph", say("the code of the sheet"), found, wanted, remedy)


def _short_name(name: str) -> str:
    quoted = quote(name, safe="", errors="surrogatepass")
    if len(quoted) <= MAX_NAME_LENGTH and not quoted.startswith(DIGEST_PREFIX):
        return quoted
    return DIGEST_PREFIX + hashlib.sha256(name.encode("utf-8", "surrogatepass")).hexdigest()[:16]


def _signature(said: str, secret: bytes) -> str:
    # Apart from what else is made of the secret.
    return hmac.digest(secret, b"graphcam sheet " + said.encode("utf-8", "surrogatepass"), "sha256").hex()[
        :SIGNATURE_DIGITS
    ]
