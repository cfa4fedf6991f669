"""Which file knows which follower: the one place of the exact side that asks."""

from collections.abc import Callable
from typing import Literal, NamedTuple

from graphcam.given.follower import FlatFaced, Follower, Oscillating, OscillatingFlat, Translating
from graphcam.mechanism.flat_faced import FlatFacedKinematics, FlatMinimumRadius, flat_minimum_radius
from graphcam.mechanism.kinematics import Kinematics
from graphcam.mechanism.least_radius_lines import (
    ArmMinimumRadius,
    MinimumRadius,
    arm_minimum_radius,
    translating_minimum_radius,
)
from graphcam.mechanism.oscillating import OscillatingKinematics
from graphcam.mechanism.oscillating_flat import OscillatingFlatKinematics, oscillating_flat_minimum_radius
from graphcam.mechanism.translating import TranslatingKinematics

LeastRadius = MinimumRadius | ArmMinimumRadius | FlatMinimumRadius


class ExactFunctions(NamedTuple):
    """What the exact side has for one kind of follower.

    least_radius : of (motion, follower, sigma, limits) and the condition
    condition : the argument of ``minimum_radius`` that is its own
    """

    kinematics: type[Kinematics]
    least_radius: Callable[..., LeastRadius]
    condition: Literal["offset", "curvature"] | None


EXACT_FUNCTIONS: dict[type[Follower], ExactFunctions] = {
    Translating: ExactFunctions(TranslatingKinematics, translating_minimum_radius, "offset"),
    Oscillating: ExactFunctions(OscillatingKinematics, arm_minimum_radius, None),
    FlatFaced: ExactFunctions(FlatFacedKinematics, flat_minimum_radius, "curvature"),
    OscillatingFlat: ExactFunctions(OscillatingFlatKinematics, oscillating_flat_minimum_radius, "curvature"),
}


def kinematics(follower: Follower, prime_radius: float, sigma: int, lift: float) -> Kinematics:
    """The kinematics of that follower on a cam of that prime radius [mm] that turns in the sense sigma.

    lift : the greatest s, mm or, for an arm, rad

    Raises
    ------
    DesignError : the follower does not fit the prime radius or the lift, or an arm's centre distance is open

    >>> import graphcam as gc
    >>> kinematics(gc.Translating(offset=30), prime_radius=50, sigma=+1, lift=20)
    TranslatingKinematics(sigma=1, prime_radius=50, offset=30)
    """
    found = EXACT_FUNCTIONS[type(follower)].kinematics.of(follower, prime_radius, sigma, lift)
    found.check()
    return found
