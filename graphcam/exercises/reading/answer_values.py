"""What an answer may be: a finite number, or points in mm of paper."""

import re
import unicodedata
from collections.abc import Sequence
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import UnreadableError
from graphcam.words import Words, say

Points = NDArray[np.complex128]
MAX_NUMBER = 1e9
"""No reading of a drawing is greater; a number that is cannot be meant."""
MAX_POINTS = 20_000
DASHES = dict.fromkeys("−–—‐‑‒―", "-")
"""What word processors and keyboards write for a minus sign."""
_TYPED_SIGNS = str.maketrans({**DASHES, "º": "°", "˚": "°", **dict.fromkeys("\u200b\u200e\u200f\u2060\ufeff", "")})
MAX_SHOWN_LETTERS = 40
"""Letters of what a stranger wrote that a sentence repeats."""


def number(name: str, value: object) -> float:
    """A finite number, as written in a file.

    Raises
    ------
    UnreadableError : no number, or none that can be meant

    >>> number("v_max", 12)
    12.0
    >>> number("v_max", True)
    Traceback (most recent call last):
    ...
    graphcam.errors.UnreadableError: v_max is True, which is not a number
    """
    # bool is an int in Python, not for a student.
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise _no_number_error(name, value)
    # An int of any length compares, but does not always convert; a NaN is not less than anything.
    if not -MAX_NUMBER <= value <= MAX_NUMBER:
        raise UnreadableError(say("{answer} is not a number that a drawing can show", answer=short_text(name)))
    return float(value)


def points(name: str, value: object) -> Points:
    """Points (n,) from one pair [x, y] or a list of pairs, mm of paper.

    >>> points("touch", [[1, 2], [3.5, 4]])
    array([1. +2.j, 3.5+4.j])
    >>> points("touch", [1, 2])
    array([1.+2.j])
    """
    if not isinstance(value, list | tuple) or not value:
        raise UnreadableError(say("{answer} must be points [x, y] in mm of paper", answer=short_text(name)))
    listed: Sequence[Any] = value
    pairs: Sequence[Any] = (
        [listed] if len(listed) == 2 and not any(isinstance(x, list | tuple) for x in listed) else listed
    )
    if len(pairs) > MAX_POINTS:
        raise UnreadableError(say("{answer} has more than {most} points", answer=short_text(name), most=MAX_POINTS))
    if not {*map(type, pairs)} <= {list, tuple} or {*map(len, pairs)} != {2}:
        raise UnreadableError(say("{answer} must be points [x, y] in mm of paper", answer=short_text(name)))
    numbers = [*chain.from_iterable(pairs)]
    # Looked at together, which is faster, and one by one only to say which of them is wrong.
    if {*map(type, numbers)} <= {int, float} and min(numbers) >= -MAX_NUMBER and max(numbers) <= MAX_NUMBER:
        found = np.array(numbers, dtype=np.float64)
        if np.isfinite(found).all():
            return found.view(np.complex128)
    return np.array([number(name, x) for x in numbers]).view(np.complex128)


def plain_signs(text: str) -> str:
    """A text with the minus sign, the spaces and the digits of the keyboard, and without what is not seen.

    >>> plain_signs("–37.1\\u00a0mm"), plain_signs("３７.１")
    ('-37.1 mm', '37.1')
    >>> plain_signs("- 20.1")
    '-20.1'
    """
    plain = text if text.isascii() else unicodedata.normalize("NFKC", text.translate(_TYPED_SIGNS))
    return re.sub(r"^(\s*[-+])\s+(?=[\d.,])", r"\1", plain) if "-" in plain or "+" in plain else plain


def decimal(name: str, text: str) -> float:
    """A number as a person writes it: with a point or with a comma, and with the minus of a word processor.

    >>> decimal("v_max", " 12,5 "), decimal("v_max", "−12.5")
    (12.5, -12.5)
    """
    # float() would also take "nan", "1_000" and digits of other scripts.
    plain = plain_signs(text).strip().replace(",", ".")
    if not plain or not plain.isascii() or "_" in plain:
        raise _no_number_error(name, text)
    try:
        return number(name, float(plain))
    except ValueError:
        raise _no_number_error(name, text) from None


def _no_number_error(name: str, value: object) -> UnreadableError:
    if isinstance(value, list | tuple):
        # In a notebook 12,5 is a pair.
        why = say("{answer} is a list, not a number; decimals follow a point, not a comma", answer=short_text(name))
        return UnreadableError(why)
    return UnreadableError(
        say("{answer} is {value}, which is not a number", answer=short_text(name), value=_value_description(value))
    )


def _value_description(value: object) -> Words:
    """What stands in place of a number, for a sentence."""
    if isinstance(value, str):
        return short_text(value)
    # repr() of a deep or long value may not end.
    return str(value) if value is None or isinstance(value, bool | float) else say("something else")


def short_text(text: str) -> str:
    """A stranger's text for a sentence: short, in one line, without control characters.

    >>> short_text("a" * 50)
    'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa…'
    """
    text = "".join(letter if letter.isprintable() else " " for letter in text[: MAX_SHOWN_LETTERS + 1])
    return text if len(text) <= MAX_SHOWN_LETTERS else text[: MAX_SHOWN_LETTERS - 1] + "…"
