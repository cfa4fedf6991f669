"""What sizes, speeds and loads are sensible: beyond, a slip of the unit or of a digit is likelier than such a cam.

The exact side knows no such bounds.  Files do, so that whatever they let pass can be computed, drawn and written.
"""

from numbers import Real

import numpy as np

from graphcam.errors import DesignError, check_number
from graphcam.words import Words, say

NUMBER_TYPES = Real, np.ndarray
"""What a number may be, one in an array of no axes too."""
PLAUSIBLE_RANGES = {
    str(unit): (least, most, unit)
    for unit, least, most in (
        (say("mm"), 1e-9, 1e9),
        (say("mm (degrees for an arm)"), 1e-9, 1e9),
        (say("mm on paper"), 1e-2, 1e4),
        (say("mm/rad"), 0.0, 1e9),
        (say("mm/rad^2"), 0.0, 1e9),
        (say("mm/rad^3"), 0.0, 1e9),
        (say("degrees"), 1e-6, 360.0),
        (say("degrees permitted"), 0.001, 90.0),
        (say("rpm"), 1e-3, 1e6),
        (say("mm/min"), 1e-3, 1e6),
        (say("micrometres"), 1e-3, 1e3),
        (say("kg"), 1e-6, 1e6),
        (say("kg/m^3"), 10.0, 30000.0),
        (say("N/mm"), 1e-6, 1e9),
        (say("N"), 0.0, 1e9),
        (say("MPa"), 1e-3, 1e7),
        (say("MPa of a modulus"), 1e3, 1e7),
        (say("kg mm^2"), 1e-6, 1e15),
        (say("N mm/rad"), 1e-6, 1e15),
        (say("N mm"), 0.0, 1e15),
        (say("N s/m"), 0.0, 1e9),
        (say("N mm s/rad"), 0.0, 1e15),
        (say("rad/s^2"), 0.0, 1e9),
    )
}
"""The least and the greatest size by its unit, and the unit as it is told; zero is none."""
UNIT_REMEDY = say("check its unit and its digits")


def check_positive(quantity: Words, value: float | None, unit: str) -> None:
    """Check a number that may be left out; ``unit`` is one that is listed, or empty.

    Raises
    ------
    DesignError : it is not positive, or beyond what is sensible

    >>> check_positive("lift", 1e30, "mm")
    Traceback (most recent call last):
    graphcam.errors.DesignError: lift is 1e+30, but must be from 1e-09 to 1000000000 mm; check its unit and its digits
    """
    if value is None:
        return
    if not unit:
        check_number(quantity, value, say("a finite number greater than 0"), above=0)
        return
    least, most, told = PLAUSIBLE_RANGES[unit]
    check_number(quantity, value, say("a finite number greater than 0 {unit}", unit=told), above=0)
    if not least <= value <= most:
        limit = say("from {least:g} to {most:.15g} {unit}", least=least, most=most, unit=told)
        in_gpa = unit == "MPa of a modulus" and least <= 1000 * value <= most
        remedy = say("if it is in GPa, write {mpa:.15g}", mpa=1000 * value) if in_gpa else UNIT_REMEDY
        raise DesignError(quantity, value, limit, remedy)


def bounded(quantity: Words, value: float | None, unit: str) -> None:
    """Check the magnitude of a number that may be left out, zero or negative.

    Raises
    ------
    DesignError : it is beyond what is sensible

    >>> bounded("offset", -1e-17, "mm")
    """
    _, most, told = PLAUSIBLE_RANGES[unit]
    if value is not None and not abs(value) <= most:
        raise DesignError(
            quantity, value, say("at most {most:.15g} {unit} in magnitude", most=most, unit=told), UNIT_REMEDY
        )
