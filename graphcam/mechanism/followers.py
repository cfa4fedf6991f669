"""Which file knows which follower."""

from __future__ import annotations

from graphcam.errors import DesignError
from graphcam.given.follower import Follower, Oscillating, Translating
from graphcam.mechanism.flat_faced import FlatFacedKinematics
from graphcam.mechanism.kinematics import Kinematics
from graphcam.mechanism.oscillating import OscillatingKinematics
from graphcam.mechanism.translating import TranslatingKinematics


def kinematics(follower: Follower, prime_radius: float, sigma: int, lift: float) -> Kinematics:
    """The kinematics of that follower on a cam of that prime radius [mm] that turns in the sense sigma.

    lift : the greatest s, mm or, for an arm, rad

    Raises
    ------
    DesignError : the follower does not fit the prime radius or the lift, or an arm's centre distance is open

    >>> kinematics(Translating(offset=30), prime_radius=50, sigma=+1, lift=20).s0
    40.0
    """
    if isinstance(follower, Translating):
        return TranslatingKinematics(sigma, follower.offset, prime_radius)
    if isinstance(follower, Oscillating):
        if follower.distance is None:
            raise DesignError(
                "centre distance", "left open", "given for a cam", "take the one that minimum_radius(...) finds"
            )
        return OscillatingKinematics(sigma, follower.arm, follower.distance, prime_radius, lift)
    return FlatFacedKinematics(sigma, prime_radius)
