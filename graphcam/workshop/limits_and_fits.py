"""Standard tolerances of ISO 286 (GOST 25346), and standard diameters of ISO 3 and GOST 6636, series R20."""

from __future__ import annotations

from bisect import bisect_left

# Up to [mm]: IT6, IT7, IT8, IT9 [micrometres].
_GRADES = (
    (3.0, (6, 10, 14, 25)),
    (6.0, (8, 12, 18, 30)),
    (10.0, (9, 15, 22, 36)),
    (18.0, (11, 18, 27, 43)),
    (30.0, (13, 21, 33, 52)),
    (50.0, (16, 25, 39, 62)),
    (80.0, (19, 30, 46, 74)),
    (120.0, (22, 35, 54, 87)),
    (180.0, (25, 40, 63, 100)),
    (250.0, (29, 46, 72, 115)),
    (315.0, (32, 52, 81, 130)),
    (400.0, (36, 57, 89, 140)),
    (500.0, (40, 63, 97, 155)),
)
_FINEST = 6
_R20 = (10, 11, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 63, 71, 80, 90)
"""Round values of the series R20, which goes on in every decade."""
_DECADES = range(-12, 4)


def tolerance(size: float, grade: int) -> float | None:
    """The standard tolerance of a grade from 6 to 9 [mm]; None beyond the table, which ends at 500 mm.

    >>> tolerance(20.0, 7), tolerance(20.0, 9)
    (0.021, 0.052)
    """
    row = bisect_left(_GRADES, (size,))
    return _GRADES[row][1][grade - _FINEST] / 1000 if row < len(_GRADES) else None


def standard_diameters() -> list[float]:
    """Standard diameters in order [mm].

    >>> [d for d in standard_diameters() if 20 <= d <= 32]
    [20.0, 22.0, 25.0, 28.0, 32.0]
    """
    return [value * 10.0**decade if decade >= 0 else value / 10.0**-decade for decade in _DECADES for value in _R20]
