"""Standards for bores: tolerances, diameters (ISO 3, GOST 6636, series R20) and keyways of parallel keys.

DIN 6885-1 form A and GOST 23360-78 give a keyway the same width and depths (ISO/R 773) by the shaft's diameter, so
there is one table.
"""

import math
from bisect import bisect_left
from dataclasses import dataclass

from graphcam.words import say

# Up to [mm]: IT6, IT7, IT8, IT9 [micrometres].
_TOLERANCES_BY_SIZE = (
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
_FINEST_GRADE = 6
_R20_VALUES = (10, 11, 12, 14, 16, 18, 20, 22, 25, 28, 32, 36, 40, 45, 50, 56, 63, 71, 80, 90)
"""The values of the series R20 in one decade."""
_DECADES = range(-12, 4)


MIN_WALL = 0.15
"""The thinnest wall between the bottom of a keyway and the profile or the hub, as a part of the bore."""


def tolerance(size: float, grade: int) -> float | None:
    """The standard tolerance [mm] of a size [mm] in a grade from 6 to 9; None for sizes over 500 mm.

    >>> tolerance(20.0, 7), tolerance(20.0, 9)
    (0.021, 0.052)
    """
    row = bisect_left(_TOLERANCES_BY_SIZE, (size,))
    return _TOLERANCES_BY_SIZE[row][1][grade - _FINEST_GRADE] / 1000 if row < len(_TOLERANCES_BY_SIZE) else None


def standard_diameters() -> list[float]:
    """Standard diameters, in order [mm].

    >>> [d for d in standard_diameters() if 20 <= d <= 32]
    [20.0, 22.0, 25.0, 28.0, 32.0]
    """
    return [
        value * 10.0**decade if decade >= 0 else value / 10.0**-decade for decade in _DECADES for value in _R20_VALUES
    ]


# d up to [mm], width b of the key, its height h, depth t2 in the hub; each row holds from the one before on.
_KEY_SECTIONS = (
    (8.0, 2.0, 2.0, 1.0),
    (10.0, 3.0, 3.0, 1.4),
    (12.0, 4.0, 4.0, 1.8),
    (17.0, 5.0, 5.0, 2.3),
    (22.0, 6.0, 6.0, 2.8),
    (30.0, 8.0, 7.0, 3.3),
    (38.0, 10.0, 8.0, 3.3),
    (44.0, 12.0, 8.0, 3.3),
    (50.0, 14.0, 9.0, 3.8),
    (58.0, 16.0, 10.0, 4.3),
    (65.0, 18.0, 11.0, 4.4),
    (75.0, 20.0, 12.0, 4.9),
    (85.0, 22.0, 14.0, 5.4),
    (95.0, 25.0, 14.0, 5.4),
    (110.0, 28.0, 16.0, 6.4),
    (130.0, 32.0, 18.0, 7.4),
    (150.0, 36.0, 20.0, 8.4),
    (170.0, 40.0, 22.0, 9.4),
    (200.0, 45.0, 25.0, 10.4),
    (230.0, 50.0, 28.0, 11.4),
    (260.0, 56.0, 32.0, 12.4),
    (290.0, 63.0, 32.0, 12.4),
    (330.0, 70.0, 36.0, 14.4),
    (380.0, 80.0, 40.0, 15.4),
    (440.0, 90.0, 45.0, 17.4),
    (500.0, 100.0, 50.0, 19.5),
)
# Width b of the key up to [mm], minimum and maximum radius of the keyway's corners [mm].
_FILLETS = (
    (4.0, 0.08, 0.16),
    (8.0, 0.16, 0.25),
    (18.0, 0.25, 0.4),
    (32.0, 0.4, 0.6),
    (50.0, 0.7, 1.0),
    (80.0, 1.2, 1.6),
    (100.0, 2.0, 2.5),
)
MIN_SHAFT, MAX_SHAFT = 6.0, 500.0
"""The range of diameters for which the standards have keys: over the first, up to the second [mm]."""
STANDARD_NAMES = {"din6885": "DIN 6885-1", "gost23360": say("GOST 23360-78")}


@dataclass(frozen=True)
class KeySection:
    """A keyway in a bore: width and height of its key, and its depth in the hub beyond the bore [mm].

    The depth may be greater by ``depth_over`` and not less.
    """

    width: float
    height: float
    depth: float

    @property
    def depth_over(self) -> float:
        """The upper deviation of the depth [mm]; the lower one is zero."""
        return 0.1 if self.width <= 6 else 0.2 if self.width <= 32 else 0.3

    @property
    def fillets(self) -> tuple[float, float]:
        """The minimum and the maximum radius of the corners at the keyway's bottom [mm], by the same standards."""
        return _FILLETS[bisect_left(_FILLETS, (self.width,))][1:]

    @property
    def symmetry(self) -> float | None:
        """The tolerance of symmetry to the bore's axis [mm]: that of the width, to one digit."""
        width = tolerance(self.width, 9)
        return None if width is None else float(f"{width:.1g}")

    def area(self, bore: float) -> float:
        """The area that the keyway removes outside the bore [mm^2].

        >>> round(KeySection(6, 6, 2.8).area(20), 3)
        17.713
        """
        radius, half = bore / 2, self.width / 2
        # The circle between the keyway's sides, from its middle up.
        circle = half * math.sqrt(radius**2 - half**2) + radius**2 * math.asin(half / radius)
        return self.width * (radius + self.depth) - circle


def key_section(bore: float) -> KeySection | None:
    """The keyway for a bore [mm]; None where the standards have no key.

    >>> key_section(22.0), key_section(5.0)
    (KeySection(width=6.0, height=6.0, depth=2.8), None)
    """
    if not MIN_SHAFT < bore <= MAX_SHAFT:
        return None
    _, width, height, depth = _KEY_SECTIONS[bisect_left(_KEY_SECTIONS, (bore,))]
    return KeySection(width, height, depth)


def keyway_top(bore: float, keyed: bool = True) -> float:
    """The distance [mm] from the axis of a bore [mm] to the bottom of its keyway, or to the bore where it has none."""
    section = key_section(bore) if keyed else None
    return bore / 2 + (section.depth if section else 0.0)


def shaft_radius(bore: float, keyed: bool = True) -> float:
    """The radius [mm] that a bore [mm] takes with its keyway and the thinnest wall; no profile may come nearer.

    >>> round(shaft_radius(28.0), 3), round(shaft_radius(28.0, keyed=False), 3)
    (21.5, 18.2)
    """
    return keyway_top(bore, keyed) + MIN_WALL * bore
