"""Times as ratios: the unit is one sine plus one cosine, measured in the same run, so it holds on every machine.

A time is the processor time of this thread.  It includes neither other work on the machine nor the threads that a
matrix routine starts.
"""

import math
import os
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np

MIN_RUN_TIME = max(1e-4, 10 * time.get_clock_info("thread_time").resolution)
"""A run of less than this [s] is repeated within one measurement, so that the clock's own steps do not count."""


@dataclass(frozen=True)
class Timer:
    """Measures work for about ``budget`` seconds each, and at least ``least_runs`` times."""

    budget: float = 0.05
    least_runs: int = 3

    def patient(self, runs: int) -> Self:
        """For work that meets other work on the machine: only the best of many runs is its own time."""
        return replace(self, least_runs=max(self.least_runs, runs))

    def seconds(self, work: Callable[..., object], *given: Any) -> float:
        """The minimum time of one run of the work with what it is given: longer times were disturbed.

        >>> Timer(0.0).seconds(sum, [1, 2]) > 0
        True
        """
        repeats, best, spent, runs = 1, math.inf, 0.0, 0
        while runs < self.least_runs or spent < self.budget:
            start = time.thread_time()
            for _ in range(repeats):
                work(*given)
            taken = time.thread_time() - start
            best = min(best, taken / repeats)
            if taken < MIN_RUN_TIME:
                repeats *= 4
                continue
            spent += taken
            runs += 1
        return best

    def pairs(self, n: int) -> float:
        """The time [s] of n sines and n cosines: one SC(n)."""
        x = np.linspace(0, 2 * np.pi, n, endpoint=False)
        out = np.empty(n)
        return self.seconds(lambda: (np.sin(x, out), np.cos(x, out)))


def seconds_of_programs() -> float:
    """The processor's seconds of all programs that this one has run to their end; 0 where the system does not tell."""
    used = os.times()
    return used.children_user + used.children_system
