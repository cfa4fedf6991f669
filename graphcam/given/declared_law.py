"""The declaration of a law that graphcam knows by its name: what other rooms need to know of it, told once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from graphcam.given.motion_law import Law
from graphcam.words import Caption

Printed = Callable[[Any, Any], Any]
"""f(u), of a number of any kind and of the functions for it: pi, sin and cos, of ``math`` or of ``mpmath.mp``."""


@dataclass(frozen=True, kw_only=True)
class DeclaredLaw:
    """A law with a name.  It is declared in a module of its family, and listed in :mod:`graphcam.given.laws`.

    title : what it is called; the English title is the name
    make : the law, of the ratio |a1|/|a2| of its two parts, which is 1 of a law without such parts
    printed : the displacement as the books print it, which the bench and the tests hold the law against
    fifth_derivatives : the greatest |f'''''| of each piece of the first half, and by how much f'''' jumps between
        these; so in the second half.  The bound of double integration is proved with them; None if there is none
    rise_fall : whether it is for a rise without a dwell behind it; a return by its name then runs backwards
    has_ratio : whether it has two parts whose accelerations may differ
    """

    title: Caption
    make: Callable[[float], Law]
    printed: Printed
    fifth_derivatives: tuple[tuple[float, ...], tuple[float, ...]] | None
    rise_fall: bool = False
    has_ratio: bool = False

    @property
    def name(self) -> str:
        """The name in task files and in Python."""
        return str(self.title)


def mirrored_print(first_half: Printed) -> Printed:
    """The displacement of a law of which the second half mirrors the first: 1 - f(1 - u).

    >>> import math
    >>> mirrored_print(lambda u, _: 2 * u**2)(0.75, math)
    0.875
    """

    def printed(u: Any, functions: Any) -> Any:
        return first_half(u, functions) if 2 * u <= 1 else 1 - first_half(1 - u, functions)

    return printed
