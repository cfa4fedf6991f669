"""Units of the numbers in a task file: text such as "1.25 in" becomes a number of the field's own unit.

The types at the end are those of the fields of tables: a field has its unit there, and nowhere else.
"""

import dataclasses
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from decimal import Decimal
from typing import Annotated, Any

from graphcam.errors import DesignError
from graphcam.given.table_file import CurveTable
from graphcam.tasks.number_limits import Bounded, NotNegative, Positive, Within
from graphcam.typed_words import meant
from graphcam.words import Caption, Words, or_list, say

Factors = Mapping[str, float]
RADIAN, INCH, POUND = 180 / math.pi, 25.4, 0.45359237
"""A radian [degrees], an inch [mm], a pound [kg]."""
KILOPOND = 9.80665
POUND_FORCE = POUND * KILOPOND
"""The weights of a kilogram and of a pound [N]."""


def _per_angle(units: Factors, order: int = 1) -> Factors:
    """Units over a power of the cam angle."""
    power = f"^{order}" if order > 1 else ""
    angles = {"rad": 1.0, "deg": RADIAN}
    return {
        f"{name}/{angle}{power}": factor * per**order for angle, per in angles.items() for name, factor in units.items()
    }


_MOMENTS = {"N mm": 1.0, "N m": 1000.0, "lbf in": POUND_FORCE * INCH}
_PSI = POUND_FORCE / INCH**2
UNITS: Mapping[str, Factors] = {
    "mm": {"mm": 1.0, "cm": 10.0, "m": 1e3, "um": 1e-3, "in": INCH, "mil": 0.0254, "thou": 0.0254, "ft": 304.8},
    "deg": {"deg": 1.0, "°": 1.0, "rad": RADIAN, "grad": 0.9},
    **{f"mm/rad{n}": _per_angle({"mm": 1.0, "m": 1e3, "in": INCH}, k) for k, n in enumerate(("", "^2", "^3"), 1)},
    **{f"deg/rad{n}": _per_angle({"deg": 1.0, "rad": RADIAN}, k) for k, n in enumerate(("", "^2", "^3"), 1)},
    "rpm": {"rpm": 1.0, "1/min": 1.0, "rad/s": 30 / math.pi, "deg/s": 1 / 6, "Hz": 60.0},
    "rad/s^2": {"rad/s^2": 1.0, "deg/s^2": 1 / RADIAN},
    "mm/min": {"mm/min": 1.0, "mm/s": 60.0, "m/min": 1e3, "in/min": INCH},
    "kg": {"kg": 1.0, "g": 1e-3, "lb": POUND, "oz": POUND / 16},
    "kg mm^2": {"kg mm^2": 1.0, "kg cm^2": 100.0, "kg m^2": 1e6, "lb in^2": POUND * INCH**2},
    "kg/m^3": {"kg/m^3": 1.0, "g/cm^3": 1e3, "lb/in^3": POUND / 0.0254**3},
    "N": {"N": 1.0, "kN": 1e3, "lbf": POUND_FORCE, "kgf": KILOPOND},
    "N mm": _MOMENTS,
    "N/mm": {"N/mm": 1.0, "N/m": 1e-3, "kN/m": 1.0, "lbf/in": POUND_FORCE / INCH, "kgf/mm": KILOPOND},
    "N mm/rad": _per_angle(_MOMENTS),
    "N s/m": {"N s/m": 1.0, "N s/mm": 1e3, "kg/s": 1.0, "lbf s/in": 1e3 * POUND_FORCE / INCH},
    "N mm s/rad": {f"{moment} s{per}": factor for moment, factor in _MOMENTS.items() for per in ("/rad", "")},
    "MPa": {"MPa": 1.0, "N/mm^2": 1.0, "GPa": 1e3, "kPa": 1e-3, "psi": _PSI, "ksi": 1e3 * _PSI},
    "um": {"um": 1.0, "mm": 1e3, "uin": 0.0254},
}
"""The known units by the one in which a field holds its number, and how many of that each is."""
_NUMBER_AND_UNIT = re.compile(r"([-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)\s*(.*)", re.DOTALL)
_TYPED_SIGNS = str.maketrans({"−": "-", "·": " ", "*": " ", "²": "^2", "³": "^3", "µ": "u", "μ": "u"})


class InUnit(float):
    """A number in its field's own unit, which a file gives as text with a unit.

    text : as the file has it;  unit : in the text;  own : of the number;  field : where it stands
    """

    text: str
    unit: str
    own: str
    field: "HeldIn"


@dataclass(frozen=True)
class HeldIn:
    """Marks a number of a file with its unit, so that it may be text with another one.

    own : in which the number is held
    of_turning : that of a number about a rotation, where the table may be about one: a lift in degrees; "" if never
    """

    own: str
    of_turning: str = ""

    @property
    def expected(self) -> Caption:
        """What such a number must be."""
        owns = [own for own in (self.own, self.of_turning) if own]
        names = [name for own in owns for name in UNITS[own]]
        told = say("a number of {own} (without quotes), or text with its unit: {names}")
        return told.with_values(own=or_list(owns), names=", ".join(names))

    def number(self, text: str) -> InUnit | Words:
        """The number that a text gives, or the remedy if it gives none.

        >>> HeldIn("mm").number("1.25 in"), HeldIn("deg").number("1 rad")
        (31.75, 57.29577951308232)
        >>> print(HeldIn("mm").number("1,25 in"), HeldIn("mm").number("3 lbf"), sep="; ")
        write "1.25 in"; lbf converts to N, not to mm
        >>> print(HeldIn("mm").number("8,5 мм"))
        write "8.5 mm"
        """
        found = _NUMBER_AND_UNIT.fullmatch(text.translate(_TYPED_SIGNS).strip())
        if found is None or not math.isfinite(float(found[1])):
            return ""
        said, unit = found[1], " ".join(found[2].split())
        for own in (self.own, self.of_turning):
            if own and unit in UNITS[own]:
                # In decimals, so that 0.1 in is 2.54 mm to the last digit.
                number = InUnit(Decimal(said) * Decimal(repr(UNITS[own][unit])))
                number.text, number.unit, number.own, number.field = text, unit, own, self
                return number
        numbers = [said]
        if comma := re.match(r",([0-9]+) ?", unit):
            # Three digits behind a comma may be thousands.
            numbers = [said + by + comma[1] for by in (".", "")[: 1 + (len(comma[1]) == 3)]]
            unit = unit[comma.end() :]
        if not unit:
            return say('write {number} without quotes, or "{number} {unit}"', number=numbers[0], unit=self.own)
        known = [*UNITS[self.own], *UNITS.get(self.of_turning, ())]
        if name := meant(unit, known):
            return say("write {word}", word=or_list([f'"{number} {name}"' for number in numbers]))
        if other := [own for own, units in UNITS.items() if unit in units]:
            return _other_unit(unit, other[0], self.own)
        return say("convert the number to one of these units")


def numbers_in_units(table: Any, path: str = "") -> Iterator[tuple[str, InUnit]]:
    """The numbers of a task or table that its file gives as text with a unit, with their paths."""
    if isinstance(table, InUnit):
        yield path, table
    elif isinstance(table, tuple):
        for k, part in enumerate(table):  # pyright: ignore[reportUnknownVariableType, reportUnknownArgumentType]
            yield from numbers_in_units(part, f"{path}[{k}]")
    # The rows of a measured motion, which are many, have the unit of their column.
    elif dataclasses.is_dataclass(table) and not isinstance(table, CurveTable):
        for name in (each.name for each in dataclasses.fields(table) if each.init):
            yield from numbers_in_units(getattr(table, name), f"{path}.{name}".lstrip("."))


def check_turning(table: Any, *, turning: bool, path: str = "") -> None:
    """Check that numbers whose unit depends on a rotation are given in one that fits.

    Raises
    ------
    DesignError : one is not
    """
    for place, number in numbers_in_units(table, path):
        own = number.field.of_turning if turning else number.field.own
        if number.field.of_turning and number.own != own:
            raise DesignError(place, number.text, HeldIn(own).expected, _other_unit(number.unit, number.own, own))


def _other_unit(unit: str, other: str, own: str) -> Caption:
    return say("{unit} converts to {other}, not to {own}", unit=unit, other=other, own=own)


Length = Annotated[float, HeldIn("mm"), Bounded("mm")]
Size = Annotated[Length, Positive("mm")]
"""A length greater than 0."""
SizeOrZero = Annotated[Length, Positive("mm", or_zero=True)]
PaperLength = Annotated[float, HeldIn("mm"), Positive("mm on paper")]
Angle = Annotated[float, HeldIn("deg")]
PhaseAngle = Annotated[Angle, Positive("degrees")]
PermittedAngle = Annotated[Angle, Positive("degrees permitted")]
PartOfTurn = Annotated[Angle, Within(0.0, 360.0, say("at least 0 and less than 360 degrees"), open_end=True)]
LIFT = HeldIn("mm", "deg")
Lift = Annotated[float, LIFT, Bounded("mm (degrees for an arm)")]
PhaseLift = Annotated[Lift, Positive("mm (degrees for an arm)")]
Velocity = Annotated[float, HeldIn("mm/rad", "deg/rad"), Bounded("mm/rad")]
Acceleration = Annotated[float, HeldIn("mm/rad^2", "deg/rad^2"), Bounded("mm/rad^2")]
Jerk = Annotated[float, HeldIn("mm/rad^3", "deg/rad^3"), Bounded("mm/rad^3")]
Speed = Annotated[float, HeldIn("rpm"), Positive("rpm")]
AngularAcceleration = Annotated[float, HeldIn("rad/s^2"), Bounded("rad/s^2")]
Mass = Annotated[float, HeldIn("kg"), Positive("kg")]
Inertia = Annotated[float, HeldIn("kg mm^2"), Positive("kg mm^2")]
Force = Annotated[float, HeldIn("N"), Bounded("N")]
Preload = Annotated[float, HeldIn("N"), NotNegative("N")]
Stiffness = Annotated[float, HeldIn("N/mm"), Positive("N/mm")]
ArmStiffness = Annotated[float, HeldIn("N/mm", "N mm/rad")]
ArmPreload = Annotated[float, HeldIn("N", "N mm")]
"""Those of a spring on an arm: its table checks them in the unit that they have there."""
Damping = Annotated[float, HeldIn("N s/m"), NotNegative("N s/m")]
ArmDamping = Annotated[float, HeldIn("N mm s/rad"), NotNegative("N mm s/rad")]
Stress = Annotated[float, HeldIn("MPa"), Positive("MPa")]
Modulus = Annotated[float, HeldIn("MPa"), Positive("MPa of a modulus")]
Density = Annotated[float, HeldIn("kg/m^3"), Positive("kg/m^3")]
Roughness = Annotated[float, HeldIn("um"), Positive("micrometres")]
Feed = Annotated[float, HeldIn("mm/min"), Positive("mm/min")]
