"""Names that hide who somebody is: from the course's secret, so that only its keeper can find them again."""

import base64
import hashlib
import hmac
from collections.abc import Iterable

SHORTEST = 6
"""Letters of a name: of 3000 students two agree in so many in one course out of 240."""


def hidden_names(secret: bytes, exercise: str, students: Iterable[str]) -> dict[str, str]:
    """A name of small letters and digits for each student, another one in every exercise; no two are the same.

    >>> names = hidden_names(b"secret", "whole-cam", ["s1", "s2"])
    >>> len(set(names.values())), len(names["s1"])
    (2, 6)
    >>> names["s1"] == hidden_names(b"secret", "integration", ["s1"])["s1"]
    False
    """
    whole = {student: _name(secret, exercise, student) for student in students}
    length = SHORTEST
    # Of the whole digests no two agree.
    while len({name[:length] for name in whole.values()}) < len(whole):
        length += 1
    return {student: name[:length] for student, name in whole.items()}


def _name(secret: bytes, exercise: str, student: str) -> str:
    # No name of an exercise has a zero in it, so the two parts stand apart.
    said = f"graphcam hidden name\0{exercise}\0{student}".encode("utf-8", "surrogatepass")
    return base64.b32encode(hmac.digest(secret, said, hashlib.sha256)).decode("ascii").rstrip("=").lower()
