"""How a pole ties the scales of two diagrams to one another, as a formula with its numbers."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, NamedTuple

from graphcam.drafting.ink import Construction, say
from graphcam.drafting.meaning import Formula, Symbol, Values, per_mm
from graphcam.drafting.scale import unit


class PoleTerms(NamedTuple):
    """The terms of a scale: the other diagram's scale, that of the cam angle [rad/mm], and H [mm of paper]."""

    mu: float
    mu_phi: float
    distance: float


Terms = Callable[[Any, str, int], PoleTerms]
"""The terms of a construction, by the symbol of the other diagram and the number of the pole."""
SCALE = (
    r"\mu_<name> = \frac{\mu_<source>}{\mu_\varphi H_<pole>}",
    r"\mu_<name> = \frac{<mu_source:.5g>}{<mu_phi:.6f> \cdot <distance:g>} = <mu:.5g>\ \text{<per_mm>}",
)
GREATEST = (
    r", \qquad <name>_{\max} = \mu_<name>\,y_<name>",
    r", \qquad <name>_{\max} = <mu:.5g> \cdot <paper:.2f> = <value:.5g>\ \text{<unit>}",
)
"""The end of the formula for the maximum value: in general, and with the numbers."""
SYMBOLS: Mapping[str, tuple[Symbol, ...]] = {
    "v": (
        Symbol(r"\mu_v", say("the scale of the velocity"), "(lift/rad)/mm"),
        Symbol("y_v", say("the maximum ordinate of v"), "mm of paper"),
    ),
    "a": (
        Symbol(r"\mu_a", say("the scale of the acceleration"), "(lift/rad²)/mm"),
        Symbol("y_a", say("the maximum ordinate of a"), "mm of paper"),
    ),
    "j": (
        Symbol(r"\mu_j", say("the scale of the jerk"), "(lift/rad³)/mm"),
        Symbol("H_3", say("the pole distance of the differentiation"), "mm of paper"),
    ),
}


def pole_formula(name: str, source: str, pole: int, terms: Terms, *, greatest: bool = True) -> Formula:
    """The formula for the scale of a diagram from that of another, its derivative or its integral.

    name : of the reading that is drawn in that scale
    greatest : whether the greatest value follows, the reading ``max_`` of that name
    """
    general, numbers = SCALE
    if greatest:
        general, numbers = general + GREATEST[0], numbers + GREATEST[1]
    return Formula(general, numbers, partial(_values, name, source, pole, terms), SYMBOLS[name], of=name)


def _values(name: str, source: str, pole: int, terms: Terms, drawn: Construction) -> Values:
    read, most, (mu_source, mu_phi, distance) = drawn.readings[name], f"max_{name}", terms(drawn, source, pole)
    given = {"name": name, "source": source, "pole": str(pole), "mu_source": mu_source, "mu_phi": mu_phi}
    found = {"mu": read.per_mm, "paper": float(drawn.first(most)), "value": float(drawn.value(most))}
    yield {**given, "distance": distance, **found, "per_mm": per_mm(read.unit), "unit": unit(read.unit)}
