"""What presses a translating follower on its cam: its inertia, a spring, friction in the guide.

Source: I. Voloder, M. Cohodar, S. Karic, *Annals of DAAAM* (2007): contact is kept while m (a omega^2 + v eps) + F0 +
c s is not negative.
"""

import math
from dataclasses import dataclass

from graphcam.errors import DesignError
from graphcam.given.angular_velocity import MM_PER_M, omega_of
from graphcam.given.laws import Floats
from graphcam.given.ranges import bounded

Values = tuple[Floats, Floats, Floats, Floats]
"""(s, v, a, j)"""


@dataclass(frozen=True)
class SpringLoad:
    """The load along the motion of a translating follower: F = m (a omega^2 + v eps) + F0 + c s, in N.

    mass : of the follower and all that moves with it [kg]
    speed_rpm : of the cam at the instant [rpm];  acceleration : eps of the cam at the instant [rad/s^2], 0 at a
        constant speed
    stiffness : c of the spring [N/mm];  preload : F0 at the lowest place [N], with a constant load of the follower
    friction : in the guide [N], whatever the side force: it acts against the motion, so the cam bears it on a rise and
        is relieved of it on a return

    Raises
    ------
    DesignError : a value is negative where it cannot be, or not finite

    >>> import numpy as np
    >>> import graphcam as gc
    >>> load = gc.SpringLoad(mass=0.2, speed_rpm=550, stiffness=3, preload=80)
    >>> rest = np.zeros(1)
    >>> load.force((rest, rest, rest, rest)).tolist()
    [80.0]
    """

    mass: float
    speed_rpm: float
    stiffness: float
    preload: float = 0.0
    acceleration: float = 0.0
    friction: float = 0.0

    def __post_init__(self) -> None:
        for quantity, unit in (("mass", "kg"), ("speed_rpm", "rpm"), ("stiffness", "N/mm"), ("friction", "N")):
            value = getattr(self, quantity)
            if not (math.isfinite(value) and value >= 0):
                raise DesignError(quantity, value, f"a finite number of 0 {unit} or more")
        bounded("speed_rpm", self.speed_rpm, "rpm")
        for quantity, unit in (("preload", "N"), ("acceleration", "rad/s^2")):
            if not math.isfinite(value := getattr(self, quantity)):
                raise DesignError(quantity, value, f"a finite number of {unit}")

    @property
    def omega(self) -> float:
        """Speed of the cam [rad/s]."""
        return omega_of(self.speed_rpm)

    def force(self, values: Values, direction: Floats | float = 0.0) -> Floats:
        """The force [N] that the cam must bear along the motion, from (s, v, a, j).

        direction : +1 on a rise, -1 on a return, 0 in a dwell, where the friction may act either way
        returns : negative where the cam would have to pull
        """
        s, v, a, _ = values
        inertia = self.mass / MM_PER_M * (a * self.omega**2 + v * self.acceleration)
        return inertia + self.preload + self.stiffness * s + self.friction * direction

    def slope(self, values: Values) -> Floats:
        """dF/dphi [N/rad], from (s, v, a, j)."""
        _, v, a, j = values
        return self.mass / MM_PER_M * (j * self.omega**2 + a * self.acceleration) + self.stiffness * v

    def size(self, values: Values) -> Floats:
        """The sum of the magnitudes of the force's terms [N]: what its rounding is a part of."""
        s, v, a, _ = values
        inertia = self.mass / MM_PER_M * (abs(a) * self.omega**2 + abs(v * self.acceleration))
        return inertia + abs(self.preload) + self.stiffness * s + self.friction


@dataclass(frozen=True)
class Guide:
    """Two bearings in which the stem of a translating follower slides.

    friction : mu, the coefficient of friction between stem and bearing
    overhang : b, from the roller's centre up to the nearer bearing with the follower at its lowest place [mm]
    length : l, from the nearer bearing to the farther one [mm]

    Raises
    ------
    DesignError : a value is negative or not finite, or the bearings are not apart

    >>> import graphcam as gc
    >>> gc.Guide(friction=0.1, overhang=40, length=80)
    Guide(friction=0.1, overhang=40, length=80)
    """

    friction: float
    overhang: float
    length: float

    def __post_init__(self) -> None:
        for quantity, unit in (("friction", ""), ("overhang", " mm")):
            value = getattr(self, quantity)
            if not (math.isfinite(value) and value >= 0):
                raise DesignError(quantity, value, f"a finite number of 0{unit} or more")
        if not (math.isfinite(self.length) and self.length > 0):
            raise DesignError("length", self.length, "a finite number greater than 0 mm")
