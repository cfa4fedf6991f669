"""What a load on a follower says of itself, whatever the follower: the force along its motion, that the cam must bear.

Along the motion means in the direction in which the coordinate s shrinks: of a follower that slides a force in N, of an
arm, whose s is an angle, a torque about its pivot in N mm.
"""

from typing import Protocol

from graphcam.given.laws import Floats

Values = tuple[Floats, Floats, Floats, Floats]
"""(s, v, a, j)"""


class FollowerLoad(Protocol):
    """A load on a follower, as it stands beside its cam."""

    @property
    def preload(self) -> float:
        """The preload of the spring at the lowest place."""
        ...

    @property
    def knots(self) -> tuple[float, ...]:
        """The cam angles [rad] inside a phase at which the force's slope may jump."""
        ...

    def force(self, values: Values, direction: Floats | float = 0.0, phi: Floats | float = ...) -> Floats:
        """The force along the motion [N; of an arm N mm] that the cam must bear, from (s, v, a, j).

        direction : +1 on a rise, -1 on a return, 0 in a dwell;  phi : cam angles [rad], for a load that depends on them
        returns : negative where the cam would have to pull
        """
        ...

    def slope(self, values: Values, phi: Floats | float = ...) -> Floats:
        """The derivative of the load by phi inside a phase."""
        ...

    def size(self, values: Values) -> Floats:
        """The sum of the magnitudes of its terms: what its rounding is a part of."""
        ...

    def leverage(self, values: Values) -> tuple[Floats, Floats]:
        """How much the force grows with the spring's preload, and the derivative of that by phi."""
        ...
