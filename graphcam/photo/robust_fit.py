"""Least squares from many starts at once, by Levenberg and Marquardt's method with little weight for outliers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Numbers = NDArray[np.float64]
STRAY_MISS = 3.0
"""The miss, as a multiple of the expected one, from about which on misses weigh less."""
PARAMETER_STEP = 1e-6
"""The step of a parameter for the slope of a miss; parameters are of the order of 1."""
CONVERGED_SHARE = 1e-7
"""The relative decrease of the sum below which a fit ends."""


@dataclass(frozen=True, eq=False)
class Prior:
    """The prior of parameters (m,): their values and standard deviations, infinite where nothing is known."""

    values: Numbers
    spread: Numbers

    def misses(self, parameters: Numbers) -> Numbers:
        """The misses (..., m) of parameters (..., m), as multiples of their deviations."""
        return (parameters - self.values) / self.spread


@dataclass(frozen=True, eq=False)
class FittedParameters:
    """The best of several fits.

    parameters : (m,)
    loss : half the sum of squares, those of outliers reduced
    covariance : (m, m) of the parameters, if misses are as large as expected
    """

    parameters: Numbers
    loss: float
    covariance: Numbers


def best_fit(misses: Callable[[Numbers], Numbers], prior: Prior, starts: Numbers, rounds: int) -> FittedParameters:
    """The best fit from starts (b, m).

    misses : of parameters (..., m), as (..., n) multiples of what is expected
    rounds : maximum number of rounds
    """
    parameters = np.array(starts, float)
    damping = np.full(len(parameters), 1e-3)
    loss, slope, bend = _normal(misses, prior, parameters)
    for _ in range(rounds):
        diagonal = np.einsum("bii->bi", bend)
        damped = bend + np.eye(bend.shape[-1]) * (damping[:, None] * diagonal + 1e-12)[:, None]
        tried = parameters - np.linalg.solve(damped, slope[..., None])[..., 0]
        new_loss, new_slope, new_bend = _normal(misses, prior, tried)
        better = new_loss < loss
        settled = np.abs(loss - new_loss) <= CONVERGED_SHARE * loss
        parameters[better], loss[better] = tried[better], new_loss[better]
        slope[better], bend[better] = new_slope[better], new_bend[better]
        damping = np.clip(np.where(better, damping / 5, damping * 4), 1e-9, 1e9)
        if (settled & better | (damping > 1e6)).all():
            break
    best = int(np.argmin(loss))
    return FittedParameters(parameters[best], float(loss[best]), np.linalg.pinv(bend[best], hermitian=True))


def _normal(
    misses: Callable[[Numbers], Numbers], prior: Prior, parameters: Numbers
) -> tuple[Numbers, Numbers, Numbers]:
    """Losses (b,), their slopes (b, m), and the second derivatives (b, m, m) without the misses' own."""
    count = parameters.shape[-1]
    shifted = np.concatenate([parameters[:, None], parameters[:, None] + PARAMETER_STEP * np.eye(count)], 1)
    values = misses(shifted)
    values = np.where(np.isfinite(values), values, 1e6)
    here, slopes = values[:, 0], (values[:, 1:] - values[:, :1]) / PARAMETER_STEP
    # Soft absolute values: the square of a small miss, twice the absolute value of a large one.
    size = np.sqrt(1 + (here / STRAY_MISS) ** 2)
    weights = 1 / size
    before = prior.misses(parameters)
    loss = STRAY_MISS**2 * (size - 1).sum(-1) + 0.5 * (before**2).sum(-1)
    slope = np.einsum("bmn,bn->bm", slopes, weights * here) + before / prior.spread
    bend = np.einsum("bmn,bn,bkn->bmk", slopes, weights, slopes) + np.diag(1 / prior.spread**2)
    return loss, slope, bend
