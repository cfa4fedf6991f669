"""What the motion laws are called."""

from __future__ import annotations

from collections.abc import Mapping

from graphcam.given.laws import Law
from graphcam.words import Words, say

LAWS: Mapping[str, Words] = {
    "rectangular": say("rectangular"),
    "triangular": say("triangular"),
    "cosine": say("cosine"),
    "cycloidal": say("cycloidal"),
    "trapezoidal": say("trapezoidal"),
    "modified-trapezoidal": say("modified-trapezoidal"),
    "modified-sine": say("modified-sine"),
    "measured": say("measured"),
}
"""The laws that have a name in words; polynomials are called by their powers."""


def law_name(law: Law) -> Words:
    """The name of a law.

    >>> from graphcam.given.laws import law
    >>> str(law_name(law("cosine"))), str(law_name(law("3-4-5")))
    ('cosine', '3-4-5')
    """
    return LAWS.get(law.name, law.name)
