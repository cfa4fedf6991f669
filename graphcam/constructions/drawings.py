"""Constructions by name, in the order in which they are drawn: what a chain of them has in common with every other.

A construction is drawn when it is first asked for, and with it only what it depends on; then it lies on the board.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from textwrap import wrap
from typing import Any, ClassVar, Self, overload

from graphcam.drafting.ink import Construction
from graphcam.drafting.meaning import Meaning
from graphcam.errors import DesignError, choice_limit
from graphcam.showing import MAX_WIDTH, Plottable, value_text
from graphcam.words import say

Draw = Callable[[Any], Construction]
"""Draws a construction from the chain that it belongs to."""


class DrawnOnce:
    """The attribute of a chain that draws one of its constructions; it decorates the function that does."""

    def __init__(self, draw: Draw) -> None:
        self.draw, self.__doc__ = draw, draw.__doc__

    def __set_name__(self, chain: type[Drawings], name: str) -> None:
        self.name = name
        chain.own = {**chain.own, name: self.draw}

    @overload
    def __get__(self, chain: None, kind: type[Drawings]) -> DrawnOnce: ...
    @overload
    def __get__(self, chain: Drawings, kind: type[Drawings]) -> Construction: ...
    def __get__(self, chain: Drawings | None, kind: type[Drawings]) -> DrawnOnce | Construction:
        return self if chain is None else chain.drawn(self.name)


@dataclass(frozen=True, eq=False, repr=False)
class Drawings(Plottable, Mapping[str, Construction]):
    """Constructions of one cam by name.

    further : what draws those that were added, by name
    done : constructions that lie on the board already, by name, and are not drawn again
    lying : what lies on the board so far
    own : what draws the chain's own constructions, by name
    """

    further: Mapping[str, Draw] = field(default_factory=dict[str, Draw], kw_only=True)
    done: Mapping[str, Construction] = field(default_factory=dict[str, Construction], kw_only=True)
    lying: dict[str, Construction] = field(default_factory=dict[str, Construction], init=False)
    own: ClassVar[Mapping[str, Draw]] = {}
    _drawn_in = "construction_drawing.plot"

    def __post_init__(self) -> None:
        self.lying.update(self.done)

    @property
    def names(self) -> tuple[str, ...]:
        """The names of all constructions, in the order in which they are drawn."""
        return (*self.own, *self.further)

    def __getitem__(self, name: str) -> Construction:
        if name not in self.names:
            raise KeyError(str(DesignError(say("the construction"), name, *choice_limit(f"{name}", self.names))))
        return self.drawn(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        last = "chain[name] is a construction, drawn when it is first asked for"
        return value_text(f"{type(self).__name__} of {len(self)} constructions", wrap(", ".join(self), MAX_WIDTH), last)

    def drawn(self, name: str) -> Construction:
        """The construction of that name, which is drawn if it does not lie on the board yet."""
        if name not in self.lying:
            self.lying[name] = {**self.own, **self.further}[name](self)
        return self.lying[name]

    def adding(self, meaning: Meaning, draw: Draw) -> Self:
        """The chain with one more construction: what it tells of itself, and what draws it from the chain.

        >>> import graphcam as gc
        >>> from graphcam.constructions.kinematic_diagram import MEANING, scheme
        >>> chain = gc.solve(gc.builtin_arcs_task()).chain
        >>> list(chain.adding(MEANING, lambda chain: scheme(chain.board, chain.pencil)))[-2:]
        ['arc_diagrams', 'scheme']
        """
        return replace(self, further={**self.further, meaning.name: draw})
