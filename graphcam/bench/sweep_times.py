"""A sweep beside a loop over the cams, and how far the two are apart."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from graphcam.bench.scenes import ARM
from graphcam.bench.timing import Timer
from graphcam.sweeps.designs import Designs
from graphcam.sweeps.sweep import CHUNK_OF_DESIGNS, sweep
from graphcam.sweeps.sweep_quantities import QUANTITIES

STATIONS = 181
"""Stations of one design, whose sines and cosines are the unit."""
LOOPED = 8
"""Designs of the loop, in which every cam takes as long as the other."""
RUNS = 12
"""Of a sweep, the best of which counts: beside other work most of them lose the cache."""
SWEEPS = (
    *(("translating", law) for law in ("3-4-5", "cycloidal", "modified-trapezoidal")),
    ("arm", "3-4-5"),
)
"""Followers and laws."""


@dataclass(frozen=True)
class SweepTime:
    """One sweep: seconds a design, of it and of the loop, of 181 pairs; the greatest relative difference."""

    name: str
    seconds: float
    looped: float
    pairs: float
    error: float


def designs(follower: str, law: str, n: int) -> Designs:
    """Cams of random sizes, always the same: with a translating follower or an arm.

    >>> len(designs("arm", "3-4-5", 10))
    10
    """
    random = np.random.default_rng(1)
    lift, place = random.uniform(10, 40, n), random.uniform(-20, 20, n)
    own: dict[str, Any] = {"lift": lift, "offset": place}
    if follower == "arm":
        own = {"follower": "oscillating", "lift": lift / ARM, "arm": ARM, "distance": 1.2 * ARM + place / 2}
    up, down, dwell = (random.uniform(*limits, n) for limits in ((1, 2.5), (1, 2), (0, 1.2)))
    angles, radius = {"rise_angle": up, "return_angle": down, "dwell_angle": dwell}, random.uniform(40, 80, n)
    return Designs(prime_radius=radius, rise_law=law, return_law=law, **angles, **own)


def sweep_times(timer: Timer) -> list[SweepTime]:
    """All quantities of a chunk of designs."""
    pairs, patient = timer.pairs(STATIONS * LOOPED) / LOOPED, Timer(timer.budget, max(timer.least_runs, RUNS))
    times: list[SweepTime] = []
    for follower, law in SWEEPS:
        many = designs(follower, law, CHUNK_OF_DESIGNS)
        seconds = patient.seconds(lambda many=many: sweep(many)) / CHUNK_OF_DESIGNS
        looped = timer.seconds(lambda many=many: [many.cam(k).extremes() for k in range(LOOPED)]) / LOOPED
        times.append(SweepTime(f"{follower}, {law}", seconds, looped, pairs, _error(many)))
    return times


def _error(many: Designs) -> float:
    some = many.part(slice(0, LOOPED))
    found = sweep(some, QUANTITIES[:3])
    cams = [some.cam(k).extremes() for k in range(LOOPED)]
    exact = [[e.pressure_angle_rise[0], e.pressure_angle_return[0], e.min_convex_radius[0]] for e in cams]
    return float(np.abs(np.array([found[name] for name in QUANTITIES[:3]]).T / np.array(exact) - 1).max())
