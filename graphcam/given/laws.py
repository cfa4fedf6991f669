"""The twelve normalised motion laws, and what else textbooks call them.

Every law is written as it looks from the nearer end of the phase: the first half as a function of the distance
x = u from the start, the second half as a function of the distance x = w = 1 - u from the end.  The formulas are
factored, because a product costs less than a power and rounds less than a sum.

Two of them are for a rise and a fall without a dwell between: the acceleration they end with is no jump where the fall
begins with the same.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache
from typing import Literal, cast

from graphcam.errors import DesignError, nearest_word_remedy
from graphcam.given.declared_laws import TEXTBOOK_LAWS, DeclaredLaw
from graphcam.given.motion_law import Law
from graphcam.given.piecewise import Floats, Side
from graphcam.given.polynomial_law import CONSTANT_VELOCITY, constant_velocity_law
from graphcam.typed_words import names_of, plain
from graphcam.words import say

__all__ = ["LAWS", "Floats", "LawName", "Side", "law"]

LawName = Literal[
    "rectangular",
    "triangular",
    "cosine",
    "cycloidal",
    "trapezoidal",
    "modified-trapezoidal",
    "modified-sine",
    "2-3",
    "3-4-5",
    "4-5-6-7",
    "double-harmonic",
    "eighth-degree",
    "constant-velocity",
]
"""All names that a law is asked for by; what textbooks call them is read too."""

MAX_PART_RATIO = 1e12
"""Greatest ratio of a law's parts: of more, the shorter is lost beside the longer."""
DECLARED_LAWS: Mapping[str, DeclaredLaw] = {law.name: law for law in (*TEXTBOOK_LAWS,)}
"""The laws by their names."""
LAWS = cast(tuple[LawName, ...], (*DECLARED_LAWS,))
DWELL_TO_DWELL_LAWS = tuple(name for name in LAWS if not DECLARED_LAWS[name].rise_fall)
"""The laws that look the same from both ends."""
RISE_FALL_LAWS = tuple(name for name in LAWS if DECLARED_LAWS[name].rise_fall)
"""The laws of a rise without a dwell behind it; a return by them runs backwards, from the same acceleration to rest."""
KNOWN_LAWS = (*LAWS, CONSTANT_VELOCITY)
"""All names that a law is asked for by."""
_NAMES_BY_PLAIN = {plain(name): name for name in KNOWN_LAWS}


def canonical_law(name: str | Law) -> LawName | Law:
    """The name in graphcam of a law that textbooks call so; another name, or a law of your own, as it is.

    >>> [canonical_law(name) for name in ("UARM", "Simple Harmonic", "равноускоренный", "3–4–5", "cicloidal")]
    ['rectangular', 'cosine', 'rectangular', '3-4-5', 'cicloidal']
    """
    if not isinstance(name, str) or name in KNOWN_LAWS:
        return name
    return cast(LawName, _NAMES_BY_PLAIN.get(plain(name)) or next(iter(names_of(name, "laws")), name))


def law(name: LawName | Law, ratio: float = 1.0) -> Law:
    """The normalised motion law of that name; a law of your own is returned as it is.

    Parameters
    ----------
    name : one of :data:`LAWS`, or what a textbook calls it, such as "SHM" or "parabolic"; "constant-velocity" has
        blends of a quarter; or a :class:`~graphcam.given.motion_law.Law`
    ratio : nu = |a1|/|a2|, first part's acceleration over the second's, of a law that may have unequal parts.  It is
        kept as nearly as the place u = 1/(1 + nu) between the parts is a number of the machine

    Raises
    ------
    DesignError : the name is unknown, the ratio is not positive or out of range, or the law has no ratio

    >>> import graphcam as gc
    >>> gc.law("cycloidal").peak_velocity
    2.0
    >>> f, df, ddf, dddf = gc.law("rectangular", ratio=3.0)(1 / 4)
    >>> float(f), float(df), round(float(ddf), 12)
    (0.25, 2.0, -2.666666666667)
    >>> gc.law("trapezoidal").corners, gc.law("modified-trapezoidal").corners
    ((0.125, 0.375, 0.625, 0.875), ())
    """
    name = canonical_law(name)
    if name == CONSTANT_VELOCITY:
        name = constant_velocity_law()
    own = isinstance(name, Law)
    if not own and name not in LAWS:
        remedy = nearest_word_remedy(f"{name}", KNOWN_LAWS)
        if callable(name):
            remedy = say("a law of your own is gc.Law(name, formula)")
        raise DesignError("law", name, say("a motion law that graphcam knows"), remedy)
    if not 1 / MAX_PART_RATIO <= ratio <= MAX_PART_RATIO:
        limit = say(
            "a finite number greater than 0, from {value:g} to {most:g}", value=1 / MAX_PART_RATIO, most=MAX_PART_RATIO
        )
        raise DesignError("ratio", ratio, limit, say("leave it out for equal parts"))
    if ratio != 1 and (own or not DECLARED_LAWS[name].has_ratio):
        called = name.name if own else name
        limit = say("1 for the {called} law", called=called)
        names = ", ".join(name for name, declared in DECLARED_LAWS.items() if declared.has_ratio)
        raise DesignError("ratio", ratio, limit, say("laws with unequal parts are {names}", names=names))
    return name if own else _built_law(name, ratio)


def law_of_return(name: LawName | Law, ratio: float = 1.0) -> Law:
    """The law of a return, of that name: one of :data:`RISE_FALL_LAWS` runs backwards there.

    >>> law_of_return("eighth-degree")(0.0)[2].item(), law_of_return("cosine") == law("cosine")
    (5.2683, True)
    """
    found = law(name, ratio)
    return found.reversed if canonical_law(name) in RISE_FALL_LAWS else found


@lru_cache(maxsize=256)
def _built_law(name: str, ratio: float) -> Law:
    # Cached, so that phases of the same law share their formulas and are computed together.
    return DECLARED_LAWS[name].make(ratio)
