"""Right or wrong without the key: answers of an exercise held against salted hashes, the studio's request "exercise".

An answer x is rounded to the number of the cell that it falls into, floor((x - offset)/width), where a cell is as wide
as what counts as right, and the key lies in the middle of its own.  So all neighbours within the tolerance have one
number, and one hash of it is enough.  The page does the same by WebCrypto (``data/studio/exercise.js``).

What this is worth: it hides a key from a look, not from a program.  An answer of four digits has a few hundred cells,
which are tried in seconds whatever the hash costs; width and offset tell the tolerance, and the answer but for a
multiple of the width; where the engine runs in the page, as in the one-file build, it can solve the task itself.  So
marks are given by ``graphcam exercise grade`` alone, which knows the key, and a page with hashes is for practice.
"""

import base64
import hashlib
import hmac
import math
from collections.abc import Mapping, Sequence
from typing import Any

from graphcam.errors import DesignError
from graphcam.words import say

ITERATIONS = 20_000
"""Iterations of PBKDF2 with SHA-256: a course has fifty hashes a student, and no number of them withstands guessing."""
MOST_ITERATIONS = 1_000_000
HASH_BYTES = 6
"""Bytes of a hash that are kept: they stand in an address, and a number hits one of them by chance once in 10^14."""
CELL_DIGITS = 7
"""Digits to which offset and width are written."""
CELL_MARGIN = 1e-5
"""A cell is wider than the tolerance by this part, which writing takes away again."""
MAX_ANSWERS = 100


def check_of(
    name: str,
    key: float,
    tolerance: float,
    salt: bytes,
    mistakes: Sequence[tuple[float, int]] = (),
    iterations: int = ITERATIONS,
) -> dict[str, Any]:
    """What the page knows of an answer, by its name, as plain data.

    key, tolerance : what counts as right: everything within the tolerance on either side
    mistakes : answers of usual mistakes, and the number of the sentence for each; those in the key's cell are right
    returns : ``offset`` and ``width`` of the cells, in the answer's unit; ``right``, the hash of the right one; and if
        there are such ``hints``, by the hash of a cell into which a usual mistake leads, the number of its sentence

    >>> made = check_of("r0", 43.28, 0.4, b"salt")
    >>> [checked("r0", x, made, b"salt")["right"] for x in (42.87, 42.88, 43.3, 43.68, 43.69)]
    [False, True, True, True, False]
    """
    width = _written(2 * tolerance * (1 + CELL_MARGIN))
    offset = _written((key - width / 2) % width)
    right = cell(key, offset, width)
    hints: dict[str, int] = {}
    for value, sentence in mistakes:
        number = cell(value, offset, width)
        if number != right:
            hints.setdefault(hashed(name, number, salt, iterations), sentence)
    made = {"offset": offset, "width": width, "right": hashed(name, right, salt, iterations)}
    return made | ({"hints": hints} if hints else {})


def cell(answer: float, offset: float, width: float) -> int:
    """The number of the cell that an answer falls into.

    >>> cell(43.28, 0.1, 0.8), cell(-43.28, 0.1, 0.8)
    (53, -55)
    """
    return math.floor((answer - offset) / width)


def hashed(name: str, number: int, salt: bytes, iterations: int = ITERATIONS) -> str:
    """The hash of a cell's number, in letters that an address takes.

    >>> hashed("r0", 53, b"salt", 1)
    '5Cs5zhFq'
    """
    made = _derived(f"{name}:{number}".encode(), salt, iterations)[:HASH_BYTES]
    return base64.urlsafe_b64encode(made).decode()


def _derived(password: bytes, salt: bytes, iterations: int) -> bytes:
    """The first block of PBKDF2 with HMAC-SHA-256; a Python in a browser has no OpenSSL for it."""
    if hasattr(hashlib, "pbkdf2_hmac"):
        return hashlib.pbkdf2_hmac("sha256", password, salt, iterations)
    keyed, link, total = hmac.new(password, digestmod="sha256"), salt + (1).to_bytes(4, "big"), 0
    for _ in range(iterations):
        (turn := keyed.copy()).update(link)
        link = turn.digest()
        total ^= int.from_bytes(link, "big")
    return total.to_bytes(len(link), "big")


def salt_of(secret: bytes, *said: str) -> bytes:
    """A salt that the same secret makes of the same words: every page has its own, and can be made again."""
    return hmac.digest(secret, "\n".join(("studio", *said)).encode(), "sha256")[:12]


def _written(number: float) -> float:
    """A number as it is written down, so that everybody calculates with the same."""
    return float(f"{number:.{CELL_DIGITS}g}")


def checked(
    name: str, answer: Any, check: Mapping[str, Any], salt: bytes, iterations: int = ITERATIONS
) -> dict[str, Any]:
    """Whether an answer falls into the right cell, and if not the number of the sentence for it, None without one."""
    made = hashed(name, cell(float(answer), float(check["offset"]), float(check["width"])), salt, iterations)
    right = hmac.compare_digest(made, str(check["right"]))
    return {"right": right, "hint": None if right else dict(check.get("hints", {})).get(made)}


def exercise_answer(request: Mapping[str, Any]) -> dict[str, Any]:
    """The answer to a request "exercise", for a page without WebCrypto: which answers are right, and which hint fits.

    It takes ``exercise``, as the page has it, and ``given``, numbers by the answers' names.

    Raises
    ------
    DesignError : senseless data
    """
    exercise, given = request.get("exercise"), request.get("given")
    if not isinstance(exercise, Mapping) or not isinstance(given, Mapping) or len(given) > MAX_ANSWERS:
        shown = say("not readable")
        raise DesignError("exercise", shown, say("a table with the exercise, and one with the answers given"))
    iterations = exercise.get("iterations", ITERATIONS)
    if not isinstance(iterations, int) or not 1 <= iterations <= MOST_ITERATIONS:
        raise DesignError("exercise.iterations", iterations, say("from 1 to {most}", most=MOST_ITERATIONS))
    try:
        salt = base64.urlsafe_b64decode(str(exercise["salt"]))
        checks = {str(asked["name"]): asked["check"] for asked in exercise["answers"] if "check" in asked}
        found = {name: checked(name, given[name], checks[name], salt, iterations) for name in given if name in checks}
    except (KeyError, TypeError, ValueError, OverflowError, ZeroDivisionError) as error:
        shown = say("not readable ({error})", error=str(error))
        raise DesignError("exercise", shown, say("an exercise as a link of graphcam has it")) from None
    return {"checked": found}
