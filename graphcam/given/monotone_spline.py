"""A periodic quintic spline through the rows of a table: it rests where they rest, and rises or falls in between.

The knots are single, and double at the ends of rests, so s is smooth to the fourth derivative, and to the third where
a rest begins or ends.  They lie closer than the rows; what keeps the noise of the rows out of the derivatives is what
is known of motions: acceleration and jerk change little, but where they do, they may jump.  So the coefficients are
those that make least

    sum (s - rows)^2/(2 noise^2) + sum log(1 + (steps of the jerk/usual)^2) + sum |steps of the acceleration|/usual.

It is the most likely motion for rows with independent Gaussian noise, when steps of the jerk are spread as Cauchy's
distribution is and those of the acceleration as Laplace's is: many small ones, a few great ones.  It is found by least
squares with weights that are made anew from the solution before (P. W. Holland, R. E. Welsch 1977).  A spline changes
its sign no more often than its coefficients do (C. de Boor, *A Practical Guide to Splines*, 1978, chapter XI), so
coefficients of the velocity that are of one sign on every leg make a motion that turns nowhere on its way.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.legs import Leg
from graphcam.given.motion import FULL_TURN

if TYPE_CHECKING:
    from scipy.interpolate import BSpline

DEGREE = 5
FEWEST, MOST, PARTS_OF_ROWS = 12, 180, 3.0
"""A leg is divided into so many intervals for each of its rows, but into no fewer and no more than these."""
MOST_LEGS = 24
"""What rises and falls more often is noise."""
LESS_NOISE = "give a greater tolerance, or a table with less noise"
JERKS, SWAY, SWAY_OF_NOISE = 20.0, 0.1, 12.0
"""The usual step of the jerk, h/F^3 times the root of its part of the leg; of the acceleration, h/F^2."""
ROUNDS, SETTLED = 40, 0.02
"""The weights are made anew so often, or until no row is off by so many sd of the noise more or less."""
NEAR = 7
"""A coefficient is judged by the greater one of two legs if the other is this near."""
ONE_WAY = 1e3
"""A velocity of the wrong sign counts so many times what the noise of a row would, were it to last over the leg."""
PULLS, PULL = 12, 4.0
"""A row that is off by more than the tolerance counts so many times more, so often."""


@dataclass(frozen=True, eq=False)
class Fit:
    """A periodic spline s(phi), its derivative, whose digits do not come from differences of s, and its knots [rad].

    They reach over three turns, of which the first leg begins the middle one.
    """

    spline: BSpline
    velocity: BSpline
    knots: Floats


class _Forms(NamedTuple):
    """Linear forms of the unknowns, (m, w): which unknowns they take, and how many times."""

    unknowns: NDArray[np.intp]
    factors: Floats

    def __call__(self, z: Floats) -> Floats:
        """(m,) their values."""
        return np.einsum("mw,mw->m", self.factors, z[self.unknowns])


def fit(phi: Floats, s: Floats, legs: list[Leg], tolerance: float, noise: float) -> Fit:
    """The most likely spline that keeps every row to the tolerance.

    phi, s : (n,) cam angles [rad] within the turn that begins with the first leg, in order, and displacements
    legs : from :func:`~graphcam.given.legs.find_legs`
    noise : the standard deviation of the displacements

    Raises
    ------
    DesignError : there are too many legs, or no spline that rises and falls so keeps to the tolerance
    """
    if len(legs) > MOST_LEGS:
        limit = f"greater than the noise that turns the table {len(legs)} times"
        raise DesignError("tolerance", tolerance, limit, LESS_NOISE)
    likelihood = _Likelihood(phi, s, legs, noise)
    counts = np.ones(s.size)
    for _ in range(PULLS):
        fitted = likelihood.best(counts)
        off = np.abs(fitted.spline(phi) - s)
        if off.max() <= tolerance:
            return fitted
        counts[off > tolerance] *= PULL
    limit = f"more than {off.max():.3g}, what the best spline leaves at a row"
    raise DesignError("tolerance", tolerance, limit, LESS_NOISE)


class _Likelihood:
    """What a motion's coefficients are judged by.

    knots : (n,) of one turn; coefficient i is that of the basis function over the knots i .. i + 6
    index : (n,) which unknown each coefficient is; those over a rest are the same
    """

    def __init__(self, phi: Floats, s: Floats, legs: list[Leg], noise: float) -> None:
        from scipy.interpolate import BSpline
        from scipy.ndimage import maximum_filter1d

        self.s, self.noise = s, noise
        self.knots = np.concatenate([_divided(leg, np.count_nonzero((phi >= leg.start) & (phi <= leg.end))) for leg in legs])
        n = self.knots.size
        self.turns = np.concatenate([self.knots - FULL_TURN, self.knots, self.knots + FULL_TURN])
        self.index = self._unknowns(legs)
        basis = BSpline.design_matrix(phi, self.turns, DEGREE)
        columns = basis.indices.reshape(-1, DEGREE + 1) % n
        self.rows = _Forms(self.index[columns], basis.data.reshape(-1, DEGREE + 1))
        forms = np.ones((n, 1))
        derivatives = [forms := self._derivative(forms, order) for order in range(3)]
        velocity, acceleration, jerk = derivatives
        self.velocity, self.accelerating, self.jerking = map(self._of_unknowns, (velocity, _steps(acceleration), _steps(jerk)))
        middle = self._middles(DEGREE - 1)
        lift, angle, direction, one_way = _on_legs(phi, s, legs, middle)
        self.forbidden = direction * one_way
        self.one_way = (ONE_WAY * angle / noise) ** 2
        self.usual_acceleration = maximum_filter1d(np.minimum(SWAY, SWAY_OF_NOISE * np.sqrt(noise / lift)) * lift / angle**2, NEAR, mode="wrap")
        jerks = maximum_filter1d(JERKS * lift / angle**3.5, NEAR, mode="wrap")
        width = self._width(DEGREE - 1) / (DEGREE - 1)
        self.usual_jerk = jerks * np.sqrt(width)

    def best(self, counts: Floats) -> Fit:
        """The most likely spline; ``counts`` are how many times the rows count."""
        from scipy.linalg import solveh_banded

        measured = counts / self.noise**2
        size = int(self.index.max()) + 1
        right = np.bincount(self.rows.unknowns.ravel(), (self.rows.factors * (self.s * measured)[:, None]).ravel(), size)
        jerk, acceleration, velocity = 0.1 / self.usual_jerk**2, np.zeros(self.knots.size), np.zeros(self.knots.size)
        terms = [_Gram(forms, size) for forms in (self.rows, self.jerking, self.accelerating, self.velocity)]
        bands = max(term.bands for term in terms)
        before = np.full(self.s.size, np.inf)
        for _ in range(ROUNDS):
            weights = measured, jerk, acceleration, velocity
            matrix = sum(term(weight, bands) for term, weight in zip(terms, weights, strict=True))
            z = solveh_banded(matrix, right, lower=True, check_finite=False)
            now = self.rows(z)
            if np.abs(now - before).max() < SETTLED * self.noise:
                break
            before = now
            jerk = 2 / (self.usual_jerk**2 + self.jerking(z) ** 2)
            steps = np.maximum(np.abs(self.accelerating(z)), 1e-2 * self.usual_acceleration)
            acceleration = 1 / (self.usual_acceleration * steps)
            velocity = np.where(self.forbidden * self.velocity(z) < 0, self.one_way, 0.0)
        return self._closed(z)

    def _closed(self, z: Floats) -> Fit:
        """The spline with velocities of the right sign to the last digit."""
        from scipy.interpolate import BSpline

        n = self.knots.size
        velocity = self.velocity(z)
        velocity[self.forbidden * velocity < 0] = 0.0
        # The coefficients of s are sums of those of v: c_i = c_(i-1) + v_i (t_(i+5) - t_i)/5.
        widths = self._width(DEGREE) / DEGREE
        rises = velocity * widths
        velocity[rises < 0] *= np.sum(rises[rises > 0]) / -np.sum(rises[rises < 0])
        c = z[self.index[0]] + np.cumsum(velocity * widths) - velocity[0] * widths[0]
        turn = np.arange(3 * n)
        s = BSpline(self.turns, c[turn[: -DEGREE - 1] % n], DEGREE)
        return Fit(s, BSpline(self.turns, velocity[turn[:-DEGREE] % n], DEGREE - 1), np.unique(self.turns))

    def _unknowns(self, legs: list[Leg]) -> NDArray[np.intp]:
        """Which unknown each coefficient is: counted around the turn, then from both ends by turns.

        So neighbours, also those across the ends of the turn, are near to one another, and the matrix is a band.
        """
        n = self.knots.size
        ends = np.searchsorted(self.knots, [leg.end for leg in legs if leg.to_rest], side="right") - 1
        same = np.zeros(n, dtype=np.bool_)
        same[(ends[:, None] - np.arange(DEGREE)) % n] = True
        count = n - np.count_nonzero(same)
        number = (np.cumsum(~same) - 1) % count
        return np.minimum(2 * number, 2 * (count - 1 - number) + 1)

    def _width(self, knots: int) -> Floats:
        """(n,) the angle over so many intervals from each knot on."""
        n = self.knots.size
        return self.turns[n + knots : 2 * n + knots] - self.knots

    def _middles(self, degree: int) -> Floats:
        """(n,) where the coefficients are about the spline's values (T. N. E. Greville)."""
        n = self.knots.size
        return np.mean([self.turns[n + k : 2 * n + k] for k in range(1, degree + 1)], axis=0)

    def _derivative(self, forms: Floats, order: int) -> Floats:
        """(n, w + 1) the coefficients of the next derivative; column k is the factor of the k-th coefficient before."""
        degree = DEGREE - order
        return _steps(forms) * (degree / self._width(degree))[:, None]

    def _of_unknowns(self, forms: Floats) -> _Forms:
        n, w = forms.shape
        return _Forms(self.index[(np.arange(n)[:, None] - np.arange(w)) % n], forms)


class _Gram:
    """The band of the matrix sum weight_k form_k form_k^T."""

    def __init__(self, forms: _Forms, size: int) -> None:
        first, second = np.triu_indices(forms.unknowns.shape[1])
        a, b = forms.unknowns[:, first], forms.unknowns[:, second]
        # Two factors of one unknown meet twice on the diagonal.
        times = np.where((first != second) & (a == b), 2.0, 1.0)
        self.products = times * forms.factors[:, first] * forms.factors[:, second]
        apart = np.abs(a - b)
        self.places = (apart * size + np.minimum(a, b)).ravel()
        self.bands, self.size = int(apart.max()) + 1, size

    def __call__(self, weights: Floats, bands: int) -> Floats:
        """(bands, size) the lower diagonals."""
        values = (self.products * weights[:, None]).ravel()
        return np.bincount(self.places, values, bands * self.size).reshape(bands, self.size)


def _steps(forms: Floats) -> Floats:
    """(n, w + 1) the differences of forms, each less the one before."""
    apart = np.zeros((forms.shape[0], forms.shape[1] + 1))
    apart[:, :-1] = forms
    apart[:, 1:] -= np.roll(forms, 1, axis=0)
    return apart


def _divided(leg: Leg, rows: int) -> Floats:
    """The knots of a leg, but for the last if the next leg begins there; at a rest double."""
    parts = int(np.clip(PARTS_OF_ROWS * rows, FEWEST, MOST))
    # With single knots s would leave its rest as x^5; laws leave it as x^2, x^3 or x^4.
    times = np.ones(parts + 1, dtype=np.intp)
    times[0], times[-1] = 1 + leg.from_rest, 2 * leg.to_rest
    return np.repeat(np.linspace(leg.start, leg.end, parts + 1), times)


def _on_legs(phi: Floats, s: Floats, legs: list[Leg], places: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """(n,) of the leg at each place: lift, angle, direction, and whether the velocity has that sign, 1, or any, 0."""
    first = legs[0].start
    starts, ends = np.array([(leg.start, leg.end) for leg in legs]).T
    within = first + (places - first) % FULL_TURN
    on = np.searchsorted(starts, within, side="right") - 1
    levels = np.interp(np.append(starts, ends), phi, s, period=FULL_TURN).reshape(2, -1)
    directions = np.array([float(leg.direction) for leg in legs])
    one_way = np.ones(places.size)
    for a, b in pairwise([*legs, legs[0]]):
        if not a.to_rest and a.direction != b.direction:
            away = np.abs((places - a.end + FULL_TURN / 2) % FULL_TURN - FULL_TURN / 2)
            one_way[np.argmin(away)] = 0.0
    lifts = np.maximum(np.abs(levels[1] - levels[0]), 1e-3 * np.ptp(s))
    return lifts[on], (ends - starts)[on], directions[on], one_way
