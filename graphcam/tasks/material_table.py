"""The table ``[material]`` of a task file: the materials of cam and follower, and the permitted stress."""

from dataclasses import dataclass
from typing import Annotated

from graphcam.errors import DesignError
from graphcam.given.plausible_ranges import check_positive
from graphcam.given.roller_contact import STEEL_POISSON_RATIO, STEEL_YOUNG_MODULUS, RollerContact
from graphcam.tasks.declared_numbers import About, Fixed
from graphcam.tasks.units import Length, Stress
from graphcam.words import say


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
    RollerContact(width=15, young1=206000.0, young2=206000.0, poisson1=0.3, poisson2=0.3)
    """

    width: Annotated[Length, say("Width of the contact"), About(15.0)]
    young_cam: Annotated[Stress, say("Modulus of elasticity E₁, cam"), About(STEEL_YOUNG_MODULUS)] = STEEL_YOUNG_MODULUS
    young_follower: Annotated[Stress, say("Modulus of elasticity E₂, follower"), About(STEEL_YOUNG_MODULUS)] = (
        STEEL_YOUNG_MODULUS
    )
    poisson_cam: Annotated[float, say("Poisson's ratio ν₁, cam"), Fixed(0.0, 0.5, 0.01)] = STEEL_POISSON_RATIO
    poisson_follower: Annotated[float, say("Poisson's ratio ν₂, follower"), Fixed(0.0, 0.5, 0.01)] = STEEL_POISSON_RATIO
    permitted_stress: Annotated[Stress | None, say("Permitted contact stress"), About(1200.0)] = None

    def __post_init__(self) -> None:
        check_positive("width", self.width, "mm")
        check_positive("permitted_stress", self.permitted_stress, "MPa")
        for name in ("young_cam", "young_follower"):
            check_positive(name, getattr(self, name), "MPa of a modulus")
        for name in ("poisson_cam", "poisson_follower"):
            if not 0 <= getattr(self, name) <= 0.5:
                raise DesignError(name, getattr(self, name), say("from 0 to 0.5"), say("metals have about 0.3"))

    def __call__(self) -> RollerContact:
        """The contact."""
        bodies = self.young_cam, self.young_follower, self.poisson_cam, self.poisson_follower
        return RollerContact(self.width, *bodies)
