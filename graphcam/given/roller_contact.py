"""What cam and follower are made of where they touch: a strip of a certain width, between two elastic bodies."""

from dataclasses import dataclass

from graphcam.errors import check_number
from graphcam.words import say

STEEL_YOUNG_MODULUS, STEEL_POISSON_RATIO = 206000.0, 0.3
"""Young's modulus [MPa] and Poisson's ratio of steel."""


@dataclass(frozen=True)
class RollerContact:
    """Cam and follower as they touch: the width of the contact [mm], moduli [MPa] and Poisson's ratios; 1 is the cam.

    2 is the roller, or the follower's flat face.

    Raises
    ------
    DesignError : a value is impossible

    >>> import graphcam as gc
    >>> round(gc.RollerContact(width=15).modulus, 3)
    113186.813
    """

    width: float
    young1: float = STEEL_YOUNG_MODULUS
    young2: float = STEEL_YOUNG_MODULUS
    poisson1: float = STEEL_POISSON_RATIO
    poisson2: float = STEEL_POISSON_RATIO

    def __post_init__(self) -> None:
        for name, unit in (("width", "mm"), ("young1", "MPa"), ("young2", "MPa")):
            check_number(name, getattr(self, name), say("a finite number greater than 0 {unit}", unit=unit), above=0)
        for name in ("poisson1", "poisson2"):
            check_number(name, getattr(self, name), say("from 0 to 0.5"), least=0, most=0.5)

    @property
    def modulus(self) -> float:
        """The equivalent modulus E' of cam and roller [MPa]."""
        return 1 / ((1 - self.poisson1**2) / self.young1 + (1 - self.poisson2**2) / self.young2)
