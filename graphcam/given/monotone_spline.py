"""A periodic quintic spline through the rows of a table: it rests where they rest, and rises or falls in between.

The knots are single, and double at the ends of rests, so s is smooth to the fourth derivative, and to the third where
a rest begins or ends.  They lie closer than the rows; what keeps the noise of the rows out of the derivatives is what
is known of motions: acceleration and jerk change little, but where they do, they may jump.  So the coefficients are
those that make least

    sum (s - rows)^2/(2 noise^2) + sum log(1 + (steps of the jerk/usual)^2) + sum |steps of the acceleration|/usual.

This is the most likely motion for rows with independent Gaussian noise, when steps of the jerk are spread as Cauchy's
distribution is and those of the acceleration as Laplace's is: many small ones, a few great ones.  It is found by least
squares with weights that are made anew from the solution before (P. W. Holland, R. E. Welsch 1977).  A spline changes
its sign no more often than its coefficients do (C. de Boor, *A Practical Guide to Splines*, 1978, chapter XI), so
coefficients of the velocity that are of one sign on every leg make a motion that turns nowhere on its way.

scipy's smoothing splines have one stiffness for the whole turn: where it lets a jump pass, it lets pass the noise too.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError
from graphcam.given.b_splines import basis_functions, solve_banded
from graphcam.given.laws import Floats
from graphcam.given.leg_detection import Leg
from graphcam.given.motion import FULL_TURN
from graphcam.given.motion_law import Law
from graphcam.given.piecewise_polynomial import PiecewisePolynomial
from graphcam.given.polynomial_law import leg_law
from graphcam.given.reproducible_sums import ordered_sum
from graphcam.words import say

DEGREE = 5
MIN_INTERVALS, MAX_INTERVALS, INTERVALS_PER_ROW = 12, 180, 3.0
"""A leg is divided into so many intervals for each of its rows, but into no fewer and no more than these."""
JERK_STEP = 20.0
"""The usual step of the jerk over a part of a leg, in h/F^3 times the root of the part."""
ACCELERATION_STEP, NOISE_ACCELERATION_STEP = 0.1, 12.0
"""The usual step of the acceleration in h/F^2, and the same for each root of noise/h, if that is less."""
NEIGHBOUR_COUNT = 7
"""A coefficient is judged by the greatest usual step of so many neighbours: beside a fast leg a slow one may bend."""
WRONG_SIGN_WEIGHT = 1e3
"""A velocity of the wrong sign counts so many times what the noise of a row would, were it to last over the leg."""
INITIAL_WEIGHT_SHARE = 0.1
"""The weights with which the jerk begins, as a part of those that steps of the usual size would have."""
MIN_STEP_SHARE = 1e-2
"""Steps of the acceleration below this part of the usual one count as this."""
WEIGHT_ROUNDS, SETTLED_MOVE = 40, 0.02
"""The weights are made anew so often, or until no row moves by so many standard deviations of the noise."""
PULL_ROUNDS, PULL_FACTOR = 3, 4.0
"""The spline is sought so often; each time a row that is off by more than the tolerance counts so many times more."""


def folded_order(number: NDArray[np.intp], count: int) -> NDArray[np.intp]:
    """Unknowns that are numbered around a circle, counted from both ends by turns, so that neighbours are near.

    >>> folded_order(np.arange(6), 6).tolist()
    [0, 2, 4, 5, 3, 1]
    """
    return np.minimum(2 * number, 2 * (count - 1 - number) + 1)


@dataclass(frozen=True, eq=False)
class LinearForms:
    """Linear forms of unknowns.

    unknowns : (m, w) which ones each form takes;  factors : (m, w) how many times

    >>> differences = LinearForms(np.array([[0, 1], [1, 2]]), np.array([[-1.0, 1.0], [-1.0, 1.0]]))
    >>> differences(np.array([1.0, 4.0, 9.0])).tolist()
    [3.0, 5.0]
    >>> differences.normal_matrix(np.array([1.0, 10.0]), 3, 2).tolist()
    [[1.0, 11.0, 10.0], [-1.0, -10.0, 0.0]]
    """

    unknowns: NDArray[np.intp]
    factors: Floats

    def __call__(self, z: Floats) -> Floats:
        """The values of the forms at z, (m,)."""
        return ordered_sum(self.factors * z[self.unknowns])

    def transposed(self, values: Floats, size: int) -> Floats:
        """(size,) the sum of values times forms."""
        return _sums_by_place(self.unknowns, self.factors * values[:, None], size)

    def normal_matrix(self, weights: Floats, size: int, bands: int) -> Floats:
        """(bands, size) the lower diagonals of the sum of weight times form times its transpose."""
        apart, first, products = self._products
        return _sums_by_place(apart * size + first, products * weights[:, None], bands * size).reshape(bands, size)

    @property
    def bands(self) -> int:
        """How many diagonals the squares have."""
        return int(self._products[0].max()) + 1

    @cached_property
    def _products(self) -> tuple[NDArray[np.intp], NDArray[np.intp], Floats]:
        """For every two unknowns of a form: how far apart they are, the first, and the product of their factors."""
        left, right = np.triu_indices(self.unknowns.shape[1])
        a, b = self.unknowns[:, left], self.unknowns[:, right]
        # Two factors of one unknown meet twice on the diagonal.
        times = np.where((left != right) & (a == b), 2.0, 1.0)
        return np.abs(a - b), np.minimum(a, b), times * self.factors[:, left] * self.factors[:, right]


def _sums_by_place(places: NDArray[np.intp], values: Floats, size: int) -> Floats:
    """The sums (size,) of the values that go to the same place."""
    sums: Floats = np.zeros(size)
    np.add.at(sums, places.ravel(), values.ravel())
    return sums


def fit(phi: Floats, s: Floats, legs: list[Leg], tolerance: float, noise: float) -> PiecewisePolynomial:
    """The most likely periodic spline that keeps every row to the tolerance, over three turns.

    phi, s : (n,) cam angles [rad] within the turn that begins with the first leg, in order, and displacements
    legs : from :func:`~graphcam.given.leg_detection.find_legs`
    noise : the standard deviation of the displacements

    Raises
    ------
    DesignError : no spline that rises and falls so keeps to the tolerance
    """
    circle, counts, off = _circle(phi, legs), np.ones(s.size), np.zeros(s.size)
    likelihood = _likelihood(circle, phi, s, legs, noise)
    for _ in range(PULL_ROUNDS):
        fitted = _closed_spline(circle, likelihood, _most_likely_unknowns(likelihood, s, counts))
        off = np.abs(fitted(phi)[0] - s)
        if off.max() <= tolerance:
            return fitted
        counts[off > tolerance] *= PULL_FACTOR
    limit = say("more than {max:.3g}, what the best spline leaves at a row", max=off.max())
    raise DesignError("tolerance", tolerance, limit)


# --- the coefficients around the turn --------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Circle:
    """The knots and coefficients of one turn; coefficient i is that of the basis function over the knots i .. i + 6.

    knots : (n,) [rad];  turns : (3n,) the same in three turns
    index : (n,) which unknown each coefficient is; those over a rest are one
    """

    knots: Floats
    turns: Floats
    index: NDArray[np.intp]

    def width(self, knots: int) -> Floats:
        """(n,) the angle over so many intervals from each knot on."""
        n = self.knots.size
        return self.turns[n + knots : 2 * n + knots] - self.knots

    def middles(self, degree: int) -> Floats:
        """(n,) where the coefficients are about the spline's values (T. N. E. Greville)."""
        n = self.knots.size
        return np.mean([self.turns[n + k : 2 * n + k] for k in range(1, degree + 1)], axis=0)

    def derivative(self, factors: Floats, degree: int) -> Floats:
        """(n, w + 1) the next derivative's coefficients; column k is the factor of the k-th coefficient of s before."""
        return _steps(factors) * (degree / self.width(degree))[:, None]

    def forms(self, factors: Floats) -> LinearForms:
        """The linear forms in the unknowns."""
        n, w = factors.shape
        return LinearForms(self.index[(np.arange(n)[:, None] - np.arange(w)) % n], factors)


def _circle(phi: Floats, legs: list[Leg]) -> _Circle:
    knots = np.concatenate([_leg_knots(leg, int(np.sum((phi >= leg.start) & (phi <= leg.end)))) for leg in legs])
    n, same = knots.size, np.zeros(knots.size, dtype=np.bool_)
    ends = np.searchsorted(knots, [leg.end for leg in legs if leg.to_rest], side="right") - 1
    same[(ends[:, None] - np.arange(DEGREE)) % n] = True
    count = n - int(np.sum(same))
    turns = np.concatenate([knots - FULL_TURN, knots, knots + FULL_TURN])
    return _Circle(knots, turns, folded_order((np.cumsum(~same) - 1) % count, count))


def _leg_knots(leg: Leg, rows: int) -> Floats:
    """The knots of a leg, but for the last if the next leg begins there; at a rest double."""
    parts = round(min(max(INTERVALS_PER_ROW * rows, MIN_INTERVALS), MAX_INTERVALS))
    # With single knots s would leave its rest as x^5; laws leave it as x^2, x^3 or x^4.
    times = np.ones(parts + 1, dtype=np.intp)
    times[0], times[-1] = 1 + leg.from_rest, 2 * leg.to_rest
    return np.repeat(np.linspace(leg.start, leg.end, parts + 1), times)


def _steps(factors: Floats) -> Floats:
    """(n, w + 1) each coefficient less the one before."""
    apart = np.zeros((factors.shape[0], factors.shape[1] + 1))
    apart[:, :-1] = factors
    apart[:, 1:] -= np.roll(factors, 1, axis=0)
    return apart


# --- what is most likely ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Likelihood:
    """What the unknowns are judged by.

    rows : the displacements at the rows, with the standard deviation ``noise``
    velocity : the velocity's coefficients; ``one_way`` is the sign that they must have, or 0, ``strictly`` their weight
    accelerations, jerks : the steps of their coefficients, with the usual ones
    """

    rows: LinearForms
    noise: float
    velocity: LinearForms
    one_way: Floats
    strictly: Floats
    accelerations: LinearForms
    usual_acceleration: Floats
    jerks: LinearForms
    usual_jerk: Floats


def _likelihood(circle: _Circle, phi: Floats, s: Floats, legs: list[Leg], noise: float) -> _Likelihood:
    n = circle.knots.size
    numbers, values = basis_functions(circle.turns, DEGREE, phi)
    rows = LinearForms(circle.index[numbers % n], values)
    velocity = circle.derivative(np.ones((n, 1)), DEGREE)
    acceleration = circle.derivative(velocity, DEGREE - 1)
    jerk = circle.derivative(acceleration, DEGREE - 2)
    lift, angle, one_way = _on_legs(phi, s, legs, circle.middles(DEGREE - 1))
    sways = np.minimum(ACCELERATION_STEP, NOISE_ACCELERATION_STEP * np.sqrt(noise / lift)) * lift / angle**2
    jerks = _neighbourhood_maximum(JERK_STEP * lift / (angle * angle * angle * np.sqrt(angle)))
    part = circle.width(DEGREE - 1) / (DEGREE - 1)
    return _Likelihood(
        *(rows, noise, circle.forms(velocity), one_way, (WRONG_SIGN_WEIGHT * angle / noise) ** 2),
        *(circle.forms(_steps(acceleration)), _neighbourhood_maximum(sways)),
        *(circle.forms(_steps(jerk)), jerks * np.sqrt(part)),
    )


def _neighbourhood_maximum(values: Floats) -> Floats:
    """(n,) the greatest of each value and its neighbours around the turn."""
    return np.max([np.roll(values, k) for k in range(-(NEIGHBOUR_COUNT // 2), NEIGHBOUR_COUNT // 2 + 1)], axis=0)


def _on_legs(phi: Floats, s: Floats, legs: list[Leg], places: Floats) -> tuple[Floats, Floats, Floats]:
    """(n,) of the leg at each place: lift, angle, and the sign of its velocity, 0 where it turns."""
    starts, ends = np.array([(leg.start, leg.end) for leg in legs]).T
    first = legs[0].start
    on = np.searchsorted(starts, first + (places - first) % FULL_TURN, side="right") - 1
    below, above = (np.interp(at, phi, s, period=FULL_TURN) for at in (starts, ends))
    one_way = np.array([float(leg.direction) for leg in legs])[on]
    for a, b in pairwise([*legs, legs[0]]):
        if not a.to_rest and a.direction != b.direction:
            one_way[np.argmin(np.abs((places - a.end + FULL_TURN / 2) % FULL_TURN - FULL_TURN / 2))] = 0.0
    return np.maximum(np.abs(above - below), MIN_STEP_SHARE * np.ptp(s))[on], (ends - starts)[on], one_way


def _most_likely_unknowns(given: _Likelihood, s: Floats, counts: Floats) -> Floats:
    """The most likely unknowns, for rows that count so many times."""
    terms = given.rows, given.jerks, given.accelerations, given.velocity
    size, bands = int(given.velocity.unknowns.max()) + 1, max(term.bands for term in terms)
    measured = counts / given.noise**2
    right = given.rows.transposed(s * measured, size)
    jerk = INITIAL_WEIGHT_SHARE / given.usual_jerk**2
    acceleration = velocity = np.zeros(given.one_way.size)
    z, before = np.zeros(size), np.full(s.size, np.inf)
    for _ in range(WEIGHT_ROUNDS):
        weights = measured, jerk, acceleration, velocity
        band = np.sum([term.normal_matrix(w, size, bands) for term, w in zip(terms, weights, strict=True)], axis=0)
        z = solve_banded(band, right)
        now = given.rows(z)
        if np.abs(now - before).max() < SETTLED_MOVE * given.noise:
            break
        before = now
        jerk = 2 / (given.usual_jerk**2 + given.jerks(z) ** 2)
        usual = given.usual_acceleration
        acceleration = 1 / (usual * np.maximum(np.abs(given.accelerations(z)), MIN_STEP_SHARE * usual))
        velocity = np.where(given.one_way * given.velocity(z) < 0, given.strictly, 0.0)
    return z


def _closed_spline(circle: _Circle, given: _Likelihood, z: Floats) -> PiecewisePolynomial:
    """The spline of the unknowns, with velocities of the right sign, and closed, to the last digit."""
    velocity = given.velocity(z)
    velocity[given.one_way * velocity < 0] = 0.0
    # The coefficients of s are sums of those of v: c_i = c_(i-1) + v_i (t_(i+5) - t_i)/5.
    widths = circle.width(DEGREE) / DEGREE
    rises = velocity * widths
    velocity[rises < 0] *= np.sum(rises[rises > 0]) / -np.sum(rises[rises < 0])
    c = z[circle.index[0]] + np.cumsum(velocity * widths) - velocity[0] * widths[0]
    n, first = circle.knots.size, circle.knots[:1]
    # The digits of v do not come from differences of s.
    coefficients = velocity[np.arange(circle.turns.size - DEGREE) % n]
    s = PiecewisePolynomial.of_spline(circle.turns, coefficients, DEGREE - 1).integral()
    numbers, values = basis_functions(circle.turns, DEGREE, first)
    return s.seen(0.0, base=(s(first)[0] - ordered_sum(values * c[numbers % n])).item())


MEASURED_LAW = "measured"
"""The name of the law of a measured motion."""
MIN_SAMPLES = 3
"""Samples of a law."""
SAME_KNOT = 1e-9
"""Knots nearer to one another than this fraction of the phase are one."""


def sampled_law(name: str, u: ArrayLike, f: ArrayLike, accelerations: tuple[float, float] = (0.0, 0.0)) -> Law:
    """The law through samples, smooth to the fourth derivative: a quintic spline from rest to rest.

    Parameters
    ----------
    name : what it is called on the sheet
    u : (n,) growing from 0 to 1;  f : (n,) the lift there, growing from 0 to 1
    accelerations : f'' at the start and at the end, 0 for a law without impact

    Raises
    ------
    DesignError : the samples are fewer than three, not numbers, or not in order; or the spline through them is no law

    >>> import graphcam as gc
    >>> u = np.linspace(0, 1, 21)
    >>> law = gc.sampled_law("half a turn", u, (1 - np.cos(np.pi * u)) / 2, accelerations=(np.pi**2 / 2, -np.pi**2 / 2))
    >>> round(law.peak_velocity, 6)
    1.570796
    """
    from scipy.interpolate import make_interp_spline

    u, f = np.asarray(u, dtype=np.float64), np.asarray(f, dtype=np.float64)
    if u.ndim != 1 or u.shape != f.shape or u.size < MIN_SAMPLES:
        shapes = say("{shape} and {shape2}", shape=u.shape, shape2=f.shape)
        limit = say("one f for every u, {least} or more", least=MIN_SAMPLES)
        raise DesignError(say("shapes of the samples of the law '{name}'", name=name), shapes, limit)
    for symbol, values in (("u", u), ("f", f)):
        least, most = np.diff(values).min(), np.abs(values[[0, -1]] - [0.0, 1.0]).max()
        if not (least >= 0 and most <= SAME_KNOT) or (symbol == "u" and least <= SAME_KNOT):
            found = say("{values} numbers from {values2:g} to {values3:g}, the smallest step {least:g}")
            found = found.with_values(values=len(values), values2=values[0], values3=values[-1], least=least)
            remedy = say("divide by the last one; where the lift falls, begin another phase")
            quantity = say("samples {symbol} of the law '{name}'", symbol=symbol, name=name)
            raise DesignError(quantity, found, say("growing from 0 to 1"), remedy)
    ends = tuple([(1, 0.0), (2, acceleration)] for acceleration in accelerations)
    spline = make_interp_spline(u, f, k=DEGREE, bc_type=ends)
    # These coefficients are the ends' f, f' and f''; without their rounding what is small near an end keeps its digits.
    at_start, at_end = (2 if acceleration else 3 for acceleration in accelerations)
    spline.c[:at_start], spline.c[-at_end:] = 0.0, 1.0
    leg = (
        PiecewisePolynomial.of_spline(spline.t, spline.c, DEGREE)
        .at_rest(float(u[0]), at_start)
        .at_rest(float(u[-1]), at_end)
    )
    return leg_law(name, leg, trusted=False)[1]
