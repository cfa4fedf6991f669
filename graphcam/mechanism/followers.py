"""Which file knows which follower: the one place of the exact side that asks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from graphcam.given.follower import FOLLOWERS, FlatFaced, Follower, Oscillating, Translating
from graphcam.mechanism.flat_faced import FlatFacedKinematics, FlatMinimumRadius, ManyFlatFaced, flat_minimum_radius
from graphcam.mechanism.kinematics import Kinematics
from graphcam.mechanism.least_radius_arm import ArmMinimumRadius, arm_minimum_radius
from graphcam.mechanism.least_radius_translating import MinimumRadius, translating_minimum_radius
from graphcam.mechanism.oscillating import ManyOscillating, OscillatingKinematics
from graphcam.mechanism.translating import ManyTranslating, TranslatingKinematics

LeastRadius = MinimumRadius | ArmMinimumRadius | FlatMinimumRadius
ManyKinematics = ManyTranslating | ManyOscillating | ManyFlatFaced


@dataclass(frozen=True)
class ExactFunctions:
    """What the exact side has for one kind of follower.

    kinematics, many : on one cam, and on many at once
    least_radius : of (motion, follower, sigma, limits, condition)
    condition : the argument of ``minimum_radius`` that is its own
    """

    kinematics: type[Kinematics]
    many: type[ManyKinematics]
    least_radius: Callable[..., LeastRadius]
    condition: Literal["offset", "curvature"] | None


EXACT: dict[type[Follower], ExactFunctions] = {
    Translating: ExactFunctions(TranslatingKinematics, ManyTranslating, translating_minimum_radius, "offset"),
    Oscillating: ExactFunctions(OscillatingKinematics, ManyOscillating, arm_minimum_radius, None),
    FlatFaced: ExactFunctions(FlatFacedKinematics, ManyFlatFaced, flat_minimum_radius, "curvature"),
}


def kinematics(follower: Follower, prime_radius: float, sigma: int, lift: float) -> Kinematics:
    """The kinematics of that follower on a cam of that prime radius [mm] that turns in the sense sigma.

    lift : the greatest s, mm or, for an arm, rad

    Raises
    ------
    DesignError : the follower does not fit the prime radius or the lift, or an arm's centre distance is open

    >>> kinematics(Translating(offset=30), prime_radius=50, sigma=+1, lift=20)
    TranslatingKinematics(sigma=1, offset=30, prime_radius=50)
    """
    return EXACT[type(follower)].kinematics.of(follower, prime_radius, sigma, lift)


def many_kinematics(kind: str, sizes: Any, prime_radius: Any, sigma: Any, lift: Any) -> ManyKinematics:
    """The same of many followers of a kind, whose ``sizes`` are arrays by the names of the follower's."""
    return EXACT[FOLLOWERS[kind]].many.of(sizes, prime_radius, sigma, lift)
