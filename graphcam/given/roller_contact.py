"""What cam and follower are made of where they touch: a strip of a certain width, between two elastic bodies."""

from __future__ import annotations

from dataclasses import dataclass

from graphcam.errors import check_number
from graphcam.former_names import renamed
from graphcam.words import say

STEEL_YOUNG_MODULUS, STEEL_POISSON_RATIO = 206000.0, 0.3
"""Young's modulus [MPa] and Poisson's ratio of steel."""


@renamed(young1="young_cam", young2="young_follower", poisson1="poisson_cam", poisson2="poisson_follower")
@dataclass(frozen=True)
class RollerContact:
    """Cam and follower as they touch: the width of the contact [mm], moduli [MPa] and Poisson's ratios.

    The follower touches with its roller, or with its flat face.

    Raises
    ------
    DesignError : a value is impossible

    >>> import graphcam as gc
    >>> round(gc.RollerContact(width=15).modulus, 3)
    113186.813
    """

    width: float
    young_cam: float = STEEL_YOUNG_MODULUS
    young_follower: float = STEEL_YOUNG_MODULUS
    poisson_cam: float = STEEL_POISSON_RATIO
    poisson_follower: float = STEEL_POISSON_RATIO

    def __post_init__(self) -> None:
        _ = self.modulus

    @property
    def modulus(self) -> float:
        """The equivalent modulus E' of cam and follower [MPa]."""
        names = "young_cam", "young_follower", "poisson_cam", "poisson_follower"
        return equivalent_modulus(self.width, **{name: getattr(self, name) for name in names})


def equivalent_modulus(width: float, **bodies: float) -> float:
    """E' [MPa] of two bodies that touch over a width [mm]: their moduli [MPa], then their Poisson's ratios, by name.

    Raises
    ------
    DesignError : a value is impossible

    >>> round(equivalent_modulus(15, young1=206000, young2=206000, poisson1=0.3, poisson2=0.3), 3)
    113186.813
    """
    (one, young1), (two, young2), *ratios = bodies.items()
    for name, value, unit in (("width", width, "mm"), (one, young1, "MPa"), (two, young2, "MPa")):
        check_number(name, value, say("a finite number greater than 0 {unit}", unit=unit), above=0)
    for name, ratio in ratios:
        check_number(name, ratio, say("from 0 to 0.5"), least=0, most=0.5)
    (_, poisson1), (_, poisson2) = ratios
    return 1 / ((1 - poisson1**2) / young1 + (1 - poisson2**2) / young2)
