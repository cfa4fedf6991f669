"""Formulas as data: in LaTeX, with named values, and with the letters that several constructions share."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from graphcam.drafting.units import unit
from graphcam.words import Caption, say

Values = Iterable[Mapping[str, Any]]
"""Numbers and words by name, once for every time that a formula is applied."""


@dataclass(frozen=True)
class Symbol:
    """A letter of a formula.

    tex : in LaTeX;  caption : what it stands for
    unit : as of a reading, ``lift`` for the unit of the lift; empty of a mere number
    """

    tex: str
    caption: Caption
    unit: str = ""


@dataclass(frozen=True)
class Formula:
    """How a reading follows from others, and the numbers put in.

    general : in LaTeX
    numbers : the same where a value stands in place of its name in angle brackets, with its format: ``<mu:.5g>``
    values : of a construction the values by name, once for every time that the formula is applied
    symbols : what is said of its letters below it
    of : the reading with whose step it stands; without one it stands before the steps
    """

    general: str
    numbers: str = ""
    values: Callable[[Any], Values] | None = None
    symbols: tuple[Symbol, ...] = ()
    of: str = ""


S = Symbol("s", say("the displacement"), "lift")
V = Symbol("v", say("the velocity ds/dφ"), "lift/rad")
A = Symbol("a", say("the acceleration d²s/dφ²"), "lift/rad²")
LIFT = Symbol("h", say("the lift"), "lift")
R0 = Symbol("r_0", say("the prime radius"), "mm")
RADIUS = Symbol("R", say("the polar radius of a point of the curve"), "mm")
RHO = Symbol(r"\rho", say("the radius of curvature"), "mm")
ALPHA = Symbol(r"\alpha", say("the pressure angle"), "°")
SIGMA = Symbol(r"\sigma", say("1 for a cam that turns anticlockwise, −1 for one that turns clockwise"))
OFFSET = Symbol("e", say("the offset, positive where the line of motion passes the cam centre on the right"), "mm")
S0 = Symbol("s_0", say("the height of the start of the lift above the cam centre"), "mm")
ARM = Symbol("l", say("the length of the arm"), "mm")
DISTANCE = Symbol("c", say("the centre distance"), "mm")
PSI0 = Symbol(r"\psi_0", say("the angle between the arm and the line of centres at the start of the lift"), "°")
MU_PHI = Symbol(r"\mu_\varphi", say("the scale of the cam angle"), "rad/mm")


def per_mm(name: str) -> Caption:
    """The unit of a scale: what a millimetre of paper stands for of a quantity with the unit of that name.

    >>> str(per_mm("mm/rad")), str(per_mm("mm"))
    ('(mm/rad)/mm', 'mm/mm')
    """
    return (say("({unit})/mm") if "/" in name else say("{unit}/mm")).where(unit=unit(name))
