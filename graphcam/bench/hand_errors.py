"""Pencil error against the number of parts: more parts lower the method's error and raise the drawing error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from graphcam.bench.convergence import distance_from_profile
from graphcam.bench.scenes import FOLLOWERS, LIFT, TestScene, free_scene, motion_of, scene
from graphcam.comparison.error_budget import ErrorBudget
from graphcam.drafting.pencil import Pencil
from graphcam.given.laws import Floats

SIGMA = 0.2
"""The error of a line, of a setting and at the edge of the protractor [mm]."""
PARTS = (3, 4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20, 24, 32, 48, 64, 96)
QUANTILES = (5.0, 95.0)
"""A band of drawings is between these percentiles."""


@dataclass(frozen=True)
class Hands:
    """Errors of many drawings of the displacement of one rise, by the number of parts, relative to the lift.

    mean, low, high : the maximum error of a drawing, its mean and its quantiles over the drawings
    method : the same with an ideal pencil
    """

    law: str
    parts: tuple[int, ...]
    mean: tuple[float, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    method: tuple[float, ...]

    @property
    def _best(self) -> int:
        return int(np.argmin(self.mean))

    @property
    def best(self) -> int:
        """The number of parts with the smallest mean error."""
        return self.parts[self._best]

    @property
    def floor(self) -> float:
        """The minimum of the mean errors, which drawing by hand does not improve."""
        return self.mean[self._best]

    @property
    def band(self) -> tuple[float, float]:
        """The quantiles at the best number of parts."""
        return self.low[self._best], self.high[self._best]


def by_hand(law: str, hands: int, parts: Sequence[int] = PARTS) -> Hands:
    """Draw one rise on a base of 120 mm, with an ordinate of 50 mm and poles of 40 mm."""
    fixed = scene("translating", law)
    where = replace(fixed, board=replace(fixed.board, motion=motion_of(law, LIFT, 120, 60, 120)))
    pencil = Pencil.of(SIGMA, hands)
    errors = np.array([shape_errors(where, n, pencil) for n in parts])
    low, high = np.percentile(errors, QUANTILES, axis=1).tolist()
    method = [float(shape_errors(where, n, Pencil(samples=1))[0]) for n in parts]
    return Hands(law, tuple(parts), tuple(errors.mean(axis=1).tolist()), tuple(low), tuple(high), tuple(method))


def shape_errors(where: TestScene, parts: int, pencil: Pencil) -> Floats:
    """The maximum error of s on the rise in every drawing, relative to the lift."""
    chain = where.chain(parts, pencil)
    stations = chain.board.stations
    rise = stations.phases[0]
    exact = chain.board.motion.at(0, stations.u[rise])[0]
    return np.abs(chain["integration"].readings["s"].value[:, rise] - exact).max(axis=1) / LIFT


@dataclass(frozen=True)
class BudgetRow:
    """What makes one reading of a construction scatter.

    deviation : standard deviation [mm of paper; an angle that was measured itself: rad]
    parts : of its variance by the kind of act, and what they bring together only
    """

    follower: str
    construction: str
    reading: str
    deviation: float
    parts: Mapping[str, float]


def budgets(law: str, parts: int = 12) -> list[BudgetRow]:
    """The error budget of every reading of every follower."""
    rows: list[BudgetRow] = []
    for follower in FOLLOWERS:
        chain = scene(follower, law).chain(parts)
        budget = ErrorBudget(chain, Pencil.of(SIGMA))
        for name, drawn in chain.items():
            for reading in drawn.meaning.readings:
                shares = budget.of(name, reading)
                brought = {kind.value: share for kind, share in shares.of.items()} | {"together": shares.together}
                rows.append(BudgetRow(follower, name, reading, shares.deviation, brought))
    return rows


def bands(law: str, hands: int, parts: int = 12) -> Mapping[str, tuple[float, float]]:
    """The relative errors between which nine drawings in ten are, with the usual number of parts, by question."""
    pencil = Pencil.of(SIGMA, hands)
    fixed, free = scene("translating", law), free_scene(law)
    least = free.chain(parts, pencil)["minimum_radius"].readings["prime_radius"].value
    errors = {
        "displacement": shape_errors(fixed, parts, pencil),
        "minimum prime radius": np.abs(least / free.least().prime_radius - 1),
        "profile": _profile_errors(fixed, parts, pencil),
    }
    return {question: tuple(np.nanpercentile(found, QUANTILES).tolist()) for question, found in errors.items()}


def _profile_errors(where: TestScene, parts: int, pencil: Pencil) -> Floats:
    """The maximum distance of a drawing's contact points from the exact profile, relative to the prime radius."""
    chain = where.chain(parts, pencil)
    profile = chain["working_profile"]
    touch = profile.points["touch"] * profile.givens.inverted.givens.mu_l.per_mm
    near = np.broadcast_to(chain.board.stations.phi, touch.shape)
    kept = np.isfinite(touch)  # a touch point that another circle covers is not drawn
    distance = np.zeros(touch.shape)
    distance[kept] = distance_from_profile(where.cam, touch[kept], near[kept])
    return distance.max(axis=1) / where.sizes.prime_radius
