"""The table ``[material]`` of a task file: the materials of cam and follower, and the permitted stress."""

from dataclasses import dataclass
from typing import Annotated

from graphcam.given.roller_contact import (
    STEEL_POISSON_RATIO as STEEL_RATIO,
    STEEL_YOUNG_MODULUS as STEEL_MODULUS,
    RollerContact,
)
from graphcam.tasks.declared_numbers import About, Fixed
from graphcam.tasks.number_limits import Within, check_limits
from graphcam.tasks.units import Modulus, Size, Stress
from graphcam.words import say

PoissonRatio = Annotated[float, Within(0.0, 0.5, say("from 0 to 0.5"), say("metals have about 0.3"))]


@dataclass(frozen=True)
class MaterialTable:
    """``[material]``: of cam and follower where they touch, for the contact stress; it needs a ``[spring]``.

    width : mm, of the contact along the axes
    young_cam : MPa, modulus of elasticity; left out: steel
    young_follower : MPa, of the roller or the flat face
    poisson_cam : Poisson's ratio; left out: steel
    poisson_follower : of the roller or the flat face
    permitted_stress : MPa, of the pressure in the middle of the contact; left out: no stress is judged

    Raises
    ------
    DesignError : a value that cannot be

    >>> MaterialTable(width=15)()
    RollerContact(width=15, young_cam=206000.0, young_follower=206000.0, poisson_cam=0.3, poisson_follower=0.3)
    """

    width: Annotated[Size, say("Width of the contact"), About(15.0)]
    young_cam: Annotated[Modulus, say("Modulus of elasticity E₁, cam"), About(STEEL_MODULUS)] = STEEL_MODULUS
    young_follower: Annotated[Modulus, say("Modulus of elasticity E₂, follower"), About(STEEL_MODULUS)] = STEEL_MODULUS
    poisson_cam: Annotated[PoissonRatio, say("Poisson's ratio ν₁, cam"), Fixed(0.0, 0.5, 0.01)] = STEEL_RATIO
    poisson_follower: Annotated[PoissonRatio, say("Poisson's ratio ν₂, follower"), Fixed(0.0, 0.5, 0.01)] = STEEL_RATIO
    permitted_stress: Annotated[Stress | None, say("Permitted contact stress"), About(1200.0)] = None

    def __post_init__(self) -> None:
        check_limits(self)

    def __call__(self) -> RollerContact:
        """The contact."""
        bodies = self.young_cam, self.young_follower, self.poisson_cam, self.poisson_follower
        return RollerContact(self.width, *bodies)
