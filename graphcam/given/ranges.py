"""What sizes, speeds and loads are sensible: beyond, a slip of the unit or of a digit is likelier than such a cam.

The exact side knows no such bounds.  Files do, so that whatever they let pass can be computed, drawn and written.
"""

import math
from numbers import Real

import numpy as np

from graphcam.errors import DesignError, check_number
from graphcam.words import say

NUMBER = Real, np.ndarray
"""What a number may be, one in an array of no axes too."""
SENSIBLE = {
    "mm": (1e-9, 1e9),
    "mm (degrees for an arm)": (1e-9, 1e9),
    "mm on paper": (1e-2, 1e4),
    "mm/rad^2": (0.0, 1e9),
    "degrees": (1e-6, 360.0),
    "degrees permitted": (0.001, 90.0),
    "rpm": (1e-3, 1e6),
    "mm/min": (1e-3, 1e6),
    "micrometres": (1e-3, 1e3),
    "kg": (1e-6, 1e6),
    "kg/m^3": (10.0, 30000.0),
    "N/mm": (1e-6, 1e9),
    "N": (0.0, 1e9),
    "MPa": (1e-3, 1e7),
    "kg mm^2": (1e-6, 1e15),
    "N mm/rad": (1e-6, 1e15),
    "N mm": (0.0, 1e15),
    "rad/s^2": (0.0, 1e9),
}
"""The least and the greatest size by its unit; zero is none."""
REMEDY = say("check its unit and its digits")


def positive(quantity: str, value: float | None, unit: str) -> None:
    """Check a number that may be left out.

    Raises
    ------
    DesignError : it is not positive, or beyond what is sensible

    >>> positive("lift", 1e30, "mm")
    Traceback (most recent call last):
    graphcam.errors.DesignError: lift is 1e+30, but must be from 1e-09 to 1000000000 mm; check its unit and its digits
    """
    if value is None:
        return
    check_number(quantity, value, f"a finite number greater than 0 {unit}".rstrip(), above=0)
    least, most = SENSIBLE.get(unit, (0.0, math.inf))
    if not least <= value <= most:
        limit = say("from {least:g} to {most:.15g} {unit}", least=least, most=most, unit=unit)
        raise DesignError(quantity, value, limit, REMEDY)


def bounded(quantity: str, value: float | None, unit: str) -> None:
    """Check the magnitude of a number that may be left out, zero or negative.

    Raises
    ------
    DesignError : it is beyond what is sensible

    >>> bounded("offset", -1e-17, "mm")
    """
    _, most = SENSIBLE[unit]
    if value is not None and not abs(value) <= most:
        raise DesignError(quantity, value, say("at most {most:.15g} {unit} in magnitude", most=most, unit=unit), REMEDY)
