"""What presses a follower that slides on its cam: its inertia, a spring, a load, friction in the guide.

Source: I. Voloder, M. Cohodar, S. Karic, *Annals of DAAAM* (2007): contact is kept while m (a omega^2 + v eps) + F0 +
c s is not negative.
"""

import math
from dataclasses import dataclass

import numpy as np

from graphcam.errors import check_kind, check_number
from graphcam.given.angular_velocity import MM_PER_M, omega_of
from graphcam.given.follower_load import Values
from graphcam.given.laws import Floats
from graphcam.given.load_curve import Load, check_load, knots_of, largest, load_at, load_slope
from graphcam.given.ranges import NUMBER, bounded
from graphcam.words import say


@dataclass(frozen=True)
class SpringLoad:
    """The load along the motion of a follower that slides: F = m (a omega^2 + v eps) + F0 + c s + P, in N.

    mass : of the follower and all that moves with it [kg]
    speed_rpm : of the cam at the instant [rpm];  acceleration : eps of the cam at the instant [rad/s^2], 0 at a
        constant speed
    stiffness : c of the spring [N/mm];  preload : F0 in the lowest position [N], with a constant load of the follower
    friction : in the guide [N], whatever the side force: it acts against the motion, so it loads the cam on a rise and
        is relieved of it on a return
    load : P, a further force on the follower [N], positive towards the cam: a number, or a
        :class:`~graphcam.LoadCurve` over the turn

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
    load: Load = 0.0

    def __post_init__(self) -> None:
        for quantity, unit in (("mass", "kg"), ("speed_rpm", "rpm"), ("stiffness", "N/mm"), ("friction", "N")):
            limit = say("a finite number of 0 {unit} or more", unit=unit)
            check_number(quantity, getattr(self, quantity), limit, least=0)
        bounded("speed_rpm", self.speed_rpm, "rpm")
        for quantity, unit in (("preload", "N"), ("acceleration", "rad/s^2")):
            value = getattr(self, quantity)
            if isinstance(value, tuple):  # all that is said of the preload, in place of the number alone
                limit = say("a number of {unit}", unit=unit)
                check_kind(quantity, value, NUMBER, limit, say("write spring_preload(...).preload"))
            check_number(quantity, value, say("a finite number of {unit}", unit=unit))
        check_load(self.load)

    @property
    def omega(self) -> float:
        """Speed of the cam [rad/s]."""
        return omega_of(self.speed_rpm)

    @property
    def knots(self) -> tuple[float, ...]:
        """The cam angles [rad] at which the load's slope may jump inside a phase."""
        return knots_of(self.load)

    def force(self, values: Values, direction: Floats | float = 0.0, phi: Floats | float = math.nan) -> Floats:
        """The force [N] that the cam must bear along the motion, from (s, v, a, j).

        direction : +1 on a rise, -1 on a return, 0 in a dwell, where the friction may act either way
        phi : cam angles [rad], for a load that depends on them
        returns : negative where the cam would have to pull
        """
        s, v, a, _ = values
        inertia = self.mass / MM_PER_M * (a * self.omega**2 + v * self.acceleration)
        return inertia + self.preload + self.stiffness * s + self.friction * direction + load_at(self.load, phi)

    def slope(self, values: Values, phi: Floats | float = math.nan) -> Floats:
        """dF/dphi [N/rad] inside a phase, from (s, v, a, j)."""
        _, v, a, j = values
        inertia = self.mass / MM_PER_M * (j * self.omega**2 + a * self.acceleration)
        return inertia + self.stiffness * v + load_slope(self.load, phi)

    def size(self, values: Values) -> Floats:
        """The sum of the magnitudes of the force's terms [N], to which its rounding is relative."""
        s, v, a, _ = values
        inertia = self.mass / MM_PER_M * (abs(a) * self.omega**2 + abs(v * self.acceleration))
        return inertia + abs(self.preload) + self.stiffness * s + self.friction + largest(self.load)

    def leverage(self, values: Values) -> tuple[Floats, Floats]:
        """1 and 0: the spring acts along the motion."""
        return np.ones_like(values[0]), np.zeros_like(values[0])


@dataclass(frozen=True)
class Guide:
    """Two bearings in which the stem of a translating follower slides.

    friction : mu, the coefficient of friction between stem and bearing
    overhang : b, from the roller's centre up to the nearer bearing with the follower in its lowest position [mm]
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
        for quantity, unit in (("friction", ""), ("overhang", say(" mm"))):
            limit = say("a finite number of 0{unit} or more", unit=unit)
            check_number(quantity, getattr(self, quantity), limit, least=0)
        check_number("length", self.length, say("a finite number greater than 0 mm"), above=0)
