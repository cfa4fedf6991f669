"""What a construction says of itself: what it is called, why it is drawn, its readings and their formulas.

Whoever shows, compares or asks for a construction goes by this alone.  Exact counterparts and ways of measuring are
named here, not computed: the drawn and the exact side meet in the comparison.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.drafting.scale import unit
from graphcam.errors import DesignError
from graphcam.words import Caption, Words, say

Rank = Callable[[NDArray[np.floating[Any]]], NDArray[np.floating[Any]]]
"""Which of several candidates is taken: the one of highest rank.  A rank undoes itself: of a rank it is the value."""
Measured = Literal["value", "at stations", "from the pitch curve", "from the profile"]
"""How far a reading is off: itself, the greatest at the stations, or the greatest distance of points from a curve."""
Named = Callable[[Any], Sequence[Words]]
"""What the several values of a reading belong to, of its construction: the names of parts, of phases, of proposals."""


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
    return (say("({unit})/mm") if "/" in name else say("{unit}/mm")).with_values(unit=unit(name))


def sharpness(radii: NDArray[np.floating[Any]]) -> NDArray[np.floating[Any]]:
    """The curvatures 1/r of radii (...), whose maximum is the smallest convex radius: flat places change them little.

    >>> sharpness(np.array([4.0, np.inf, 0.0])).tolist()
    [0.25, 0.0, inf]
    """
    return np.divide(1.0, radii, out=np.full_like(radii, np.inf), where=~(radii <= 0))


@dataclass(frozen=True)
class ComparedReading:
    """A reading as a quantity of the results, where it stands beside its exact counterpart.

    name, title : of the quantity, whose title is the reading's if it has none; an angle is told in degrees
    candidates, ranks : the reading that holds what it was chosen from, and how; by default the least is taken.  Of
        several ranks, which name the same candidate, that one tells how far it may be off which leaves less
    sides : of a signed greatest, the reading that holds the highest and the lowest: the one is compared that lies on
        the side of the exact one, for of two that are nearly equal the drawing may name the other
    beside : readings of the same place on the paper: it may move as far along one of them as it does along another
    sign : of the quantity where the reading is 1
    exact : the exact counterpart's name, where it is not that of the quantity
    """

    name: str
    title: Caption | None = None
    candidates: str = ""
    ranks: tuple[Rank, ...] = (np.negative,)
    sides: str = ""
    beside: tuple[str, ...] = ()
    sign: int = 1
    exact: str = ""


@dataclass(frozen=True)
class ReadingConvergence:
    """A reading whose error is followed over the number of parts, under the title ``quantity``.

    exact : the exact counterpart's name
    of : the reading that is measured, where it is not this one; of several values the first
    """

    quantity: str
    exact: str
    measured: Measured = "value"
    of: str = ""


@dataclass(frozen=True)
class ReadingMeaning:
    """What a reading is, for whoever reads, compares or asks for it.

    unit : of the value, in which ``lift`` stands for the unit of the lift, such as ``lift/rad``
    compared : the quantities of the results that it is, if any
    converges : how its convergence is measured, if it is
    over : what several values of it belong to, if not to the stations
    judged : which of them counts: the least, or whichever is greatest on either side
    """

    title: Caption
    symbol: str
    unit: str
    compared: tuple[ComparedReading, ...] = ()
    converges: ReadingConvergence | None = None
    over: Named | None = None
    judged: Literal["extremes", "least"] = "extremes"


@dataclass(frozen=True)
class Meaning:
    """What a construction tells of itself: title, reason, readings and formulas.

    title : of its chapter
    why : the paragraph that stands before its steps
    readings : those that a reader takes, by name; what else it reads is an aid of the draughtsman
    scales : the views whose scales it settles, each with a reading that is drawn in that scale
    scales_found_by : the construction by which they are found, if they are not chosen: they are answers then
    formulas : how its readings follow from what is given and read, for the note
    """

    name: str
    title: Caption
    why: Caption
    readings: Mapping[str, ReadingMeaning] = field(default_factory=dict[str, ReadingMeaning])
    formulas: tuple[Formula, ...] = ()
    scales: Mapping[str, str] = field(default_factory=dict[str, str])
    scales_found_by: str = ""

    def reading(self, name: str) -> ReadingMeaning:
        """What the reading of that name is.

        Raises
        ------
        DesignError : it says nothing of that reading
        """
        if name not in self.readings:
            quantity = say("reading of {name}", name=self.name)
            raise DesignError(quantity, name, say("told by its meaning: {names}", names=", ".join(self.readings)))
        return self.readings[name]

    @property
    def compared_readings(self) -> Iterator[tuple[str, ComparedReading]]:
        """The readings that are compared: the name of each, with a quantity that it is compared as."""
        return ((name, said) for name, reading in self.readings.items() for said in reading.compared)
