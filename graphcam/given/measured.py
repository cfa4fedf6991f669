"""Motions that were measured: a table of displacements or of accelerations in place of laws.

A spline is fitted to the table and cut where it rests and where it turns, so that it becomes a motion of rises, dwells
and returns as any other, whose laws are the pieces of the spline.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError, check_number
from graphcam.former_names import renamed
from graphcam.given.laws import Floats
from graphcam.given.leg_detection import MIN_LEG_LIFT, Leg, find_legs
from graphcam.given.monotone_spline import MEASURED_LAW, fit
from graphcam.given.motion import FULL_TURN, NEAR_TURN_SHARE, Dwell, Motion, Phase, Return, Rise
from graphcam.given.piecewise_polynomial import PiecewisePolynomial
from graphcam.given.polynomial_law import leg_law
from graphcam.given.reproducible_sums import ordered_sum
from graphcam.given.root_finding import roots
from graphcam.words import Caption, Words, say

DEFAULT_TOLERANCE = 0.01
"""How far the motion may pass a row of its table [mm]."""
MIN_ROWS, MAX_ROWS = 8, 10_000
MAX_GAP_RATIO = 2.0
"""The gap that closes the turn may be so many times the widest gap between rows."""
MIN_TURN_SHARE = 0.85
"""The part of a turn that a table covers at least which ends a step before it; below, another unit is looked for."""
MAX_VALUE, MIN_TOLERANCE = 1e100, 1e-100
"""A value of a row and a tolerance between which squares are numbers still."""
LEG_SAMPLES = 50
"""Places of a leg among which one is sought where it moves fast."""
NOISE_TOLERANCE = 4.5
"""The tolerance is at least so many standard deviations of the noise; one row in 150,000 is off by more."""
MIN_NOISE = 3e-6
"""What the spline, whose acceleration cannot jump, may be off by itself, as a part of the lift."""
MISFIT_FACTOR = 7.0
"""Stops that are off by more than so many times the noise are not explained by it."""
SCATTER_FACTOR = 1.25
"""Stops that are off by more than so many times the noise scatter by more, where the rows do."""
RUN_OUT_FACTOR = 3.0
"""A run-out moves the ends of a rest by so many times what it moves its middle half."""
TRIED_TOLERANCES, TOLERANCE_STEP = 12, 1.4
"""So many tolerances are tried in place of one that is too small, each so many times the one before."""
NEIGHBOURS, OUTLIER_FACTOR = 3, 10.0
"""Rows on either side that say where a row lies, and how far one that is off lies beside all others."""
MAX_FALL_SHARE = 0.6
"""A part of the lift; what moves by more from the last row to the first does not return."""
TURNS_SHARE = 0.05
"""What moves back by less than this part of the lift goes one way only."""
NOISE_WINDOW, ROWS_PER_PART = 7, 30
"""Rows through which a polynomial is laid to see the noise, and those of a part of the turn."""
NORMAL_MEDIAN = 0.6745
"""The median of |x| for a normal distribution of standard deviation 1."""
REST_ZEROS, TURNING_ZEROS = 4, 2
"""How many of the first Taylor coefficients are zero: s is smooth to the third derivative at a rest, else v is zero."""
ANGLE_ROUNDING = 1e-9
"""Cam angles nearer to one another than this [rad] are the same."""
MIN_SHOWN_SHIFT = 1e-3
"""A shift of the cam angle that is told [degrees]."""


class RowError(DesignError):
    """A row of a table that cannot be; ``row`` counts from 0."""

    def __init__(self, row: int, quantity: Words, value: object, limit: Words, remedy: Words) -> None:
        super().__init__(quantity, value, limit, remedy)
        self.row = row


@renamed(greatest_residual="max_residual")
@dataclass(frozen=True, eq=False, repr=False)
class MeasuredMotion(Motion):
    """A motion through the rows of a table; made by :func:`measured_motion` and :func:`integrated_motion`.

    Attributes
    ----------
    zero : the cam angle [rad] of the table where this motion's begins: 0, unless the follower moves there
    phi, measured : (n,) the table: its cam angles [rad], and displacements [mm] above the motion's lowest
    tolerance : how far the motion may be from a row [mm]
    """

    zero: float
    phi: Floats
    measured: Floats
    tolerance: float

    @property
    def origin(self) -> float:
        """The cam angle [rad] of the table at which the first phase begins."""
        return self.zero

    def _summary(self) -> str:
        begins = math.degrees(self.zero)
        shifted = f", from {begins:.4g}° of the table" if abs(begins) >= MIN_SHOWN_SHIFT else ""
        return f"{super()._summary()}, through {self.phi.size} rows to {self.tolerance:g}{shifted}"

    @property
    def residuals(self) -> Floats:
        """(n,) the motion less the table [mm]."""
        return self(self.phi - self.zero)[0] - self.measured

    @property
    def max_residual(self) -> float:
        """The maximum |residual| [mm]; it is at most the tolerance."""
        return float(np.max(np.abs(self.residuals)))

    @property
    def rms_residual(self) -> float:
        """The root of the residuals' mean square [mm]."""
        return float(np.sqrt(np.mean(self.residuals**2)))


@dataclass(frozen=True, eq=False, repr=False)
class IntegratedMotion(MeasuredMotion):
    """A motion whose accelerations were measured; made by :func:`integrated_motion`.

    Attributes
    ----------
    accelerations : (n,) the table [mm/rad^2];  ``measured`` is its second integral
    closing : what was taken from every acceleration to close the turn [mm/rad^2]
    """

    accelerations: Floats
    closing: float


def measured_motion(phi: ArrayLike, s: ArrayLike, tolerance: float = DEFAULT_TOLERANCE) -> MeasuredMotion:
    """The motion through measured displacements, smooth to the third derivative.

    Where the rows stay at one level the motion dwells; otherwise it rises or falls from each dwell or turning point to
    the next, by a quintic spline, the most likely one (:mod:`graphcam.given.monotone_spline`).

    The errors of the rows are assumed to be independent, with Gaussian noise of one standard deviation, which is found
    from neighbouring rows and is at most tolerance/4.5, or what the dwells show.  So give a tolerance of 4.5 times the
    scatter of the table, or more: if it is smaller, noise becomes motion; if it is larger, small motions are not seen.
    Where dwells are off their level by more than such noise explains, as with waves or after an integration,
    tolerance/4.5 is used instead.  What moves smoothly by less than twice the tolerance, as the run-out of a base
    circle, is a dwell.  Ends of phases are found as exactly as the noise permits: with the 4-5-6-7 law they
    are hidden for several degrees.

    A motion begins where a phase begins, but a table may begin anywhere, and noise moves the end of a dwell: the cam
    angle 0 of the motion is the angle ``zero`` of the table.  At the row of phi it is ``motion(phi - motion.zero)``.

    Parameters
    ----------
    phi : (n,) cam angles [rad], growing, over one turn; the last row may repeat the first one a turn later
    s : (n,) displacements [mm; an arm's: rad]
    tolerance : how far the motion may be from a row, in the unit of s

    Raises
    ------
    DesignError : the rows are too few, not numbers, not in order, leave a part of the turn open or do not close; the
        displacement does not move by more than the tolerance; or no spline keeps to the tolerance

    >>> import graphcam as gc
    >>> phi = np.radians(np.arange(0, 360, 5))
    >>> motion = gc.measured_motion(phi, 10 - 10 * np.cos(phi))
    >>> [phase.kind for phase in motion.phases], round(motion.lift, 2)
    (['rise', 'return'], 20.0)
    >>> motion.max_residual <= motion.tolerance
    True
    >>> float(np.max(np.abs(motion(phi - motion.zero)[0] - motion.measured))) == motion.max_residual
    True
    """
    check_number("tolerance", tolerance, say("a finite number greater than 0"), above=0)
    if tolerance < MIN_TOLERANCE:
        limit = say("at least {smallest:g}", smallest=MIN_TOLERANCE)
        raise DesignError("tolerance", tolerance, limit, say("give what the table was measured to"))
    phi, s = check_rows(phi, s, tolerance)
    try:
        return _measured(phi, s, tolerance)
    except DesignError as error:
        if error.quantity != "tolerance":
            raise
        raise DesignError("tolerance", tolerance, error.args[2], _remedy(phi, s, tolerance)) from None


def _measured(phi: Floats, s: Floats, tolerance: float) -> MeasuredMotion:
    """The motion through rows that may be.

    Raises
    ------
    DesignError : of the quantity "tolerance", where that is too small
    """
    legs, noise = _legs(phi, s, tolerance)
    start = legs[0].start
    shifted = start + (phi - start) % FULL_TURN
    order = np.argsort(shifted)
    fitted = fit(shifted[order], s[order], legs, tolerance, noise)
    phases, zero, level = _phases(fitted, legs)
    return MeasuredMotion(phases, zero, phi, s - level, tolerance)


def _legs(phi: Floats, s: Floats, tolerance: float) -> tuple[list[Leg], float]:
    """The legs of a table, and the standard deviation of its rows."""
    least, scatter = MIN_NOISE * float(np.ptp(s)), _scatter(phi, s)
    most = max(tolerance / NOISE_TOLERANCE, least)
    noise = min(max(scatter, least), most)
    legs, misfit = find_legs(phi, s, tolerance, noise)
    if misfit > MISFIT_FACTOR and noise < most:
        # The rows err in other ways than each for itself, so the tolerance must say by how much.
        noise = most
        legs, _ = find_legs(phi, s, tolerance, noise)
    elif misfit > SCATTER_FACTOR and noise < scatter:
        # A tolerance of less than 4.5 times the scatter: the rests tell the noise, or else noise would move their ends.
        noise = min(noise * misfit, scatter)
        legs, _ = find_legs(phi, s, tolerance, noise)
    elif noise < most:
        # A smooth run-out moves where the follower rests, by less than the tolerance.
        coarse, _ = find_legs(phi, s, tolerance, most)
        run_out = _run_out(phi, s, coarse)
        if run_out > SCATTER_FACTOR * noise:
            noise = min(RUN_OUT_FACTOR * run_out, most)
            legs, _ = find_legs(phi, s, tolerance, noise)
            if len(_rests(coarse)) > len(_rests(legs)):
                legs, noise = coarse, most
    return legs, noise


def _rests(legs: list[Leg]) -> list[tuple[float, float]]:
    """Where the follower rests between legs, from and to [rad]."""
    pairs = zip(legs, [*legs[1:], legs[0].a_turn_later], strict=True)
    return [(leg.end, following.start) for leg, following in pairs if leg.to_rest]


def _run_out(phi: Floats, s: Floats, legs: list[Leg]) -> float:
    """The standard deviation of the rows about the level of a rest, in the middle half of the least steady one."""
    middles = [(start + (end - start) / 4, (end - start) / 2) for start, end in _rests(legs)]
    rows = [s[(phi - start) % FULL_TURN <= angle] for start, angle in middles]
    return max([float(np.std(row)) for row in rows if row.size], default=0.0)


def integrated_motion(phi: ArrayLike, a: ArrayLike, tolerance: float = DEFAULT_TOLERANCE) -> IntegratedMotion:
    """The motion whose accelerations were measured [mm/rad^2 at cam angles in rad]: integrated twice, then fitted.

    Between rows the acceleration is assumed to be linear.  So that the follower returns to its initial place, the mean
    acceleration is subtracted from every row, and the initial velocity makes its own mean zero; ``closing`` is what was
    subtracted.  The tolerance holds for the displacements.

    Raises
    ------
    DesignError : as :func:`measured_motion`

    >>> import graphcam as gc
    >>> phi = np.radians(np.arange(0, 360, 5))
    >>> motion = gc.integrated_motion(phi, 10 * np.cos(phi) + 0.5)
    >>> round(motion.lift, 1), round(motion.closing, 3)
    (20.0, 0.5)
    """
    phi, a = check_rows(phi, a, math.inf)
    step = np.diff(np.append(phi, phi[0] + FULL_TURN))
    closing = float(np.sum(step * (a + np.roll(a, -1)) / 2)) / FULL_TURN
    closed = a - closing
    after = np.roll(closed, -1)
    v = np.append(0.0, np.cumsum(step * (closed + after) / 2)[:-1])
    # Over a part the displacement grows by v dx + (2 a + a') dx^2/6, all parts together by nothing.
    rises = v * step + (2 * closed + after) * step**2 / 6
    rises -= step * np.sum(rises) / FULL_TURN
    s = np.append(0.0, np.cumsum(rises)[:-1])
    motion = measured_motion(phi, s, tolerance)
    return IntegratedMotion(motion.phases, motion.zero, phi, motion.measured, tolerance, a, closing)


def check_rows(phi: ArrayLike, values: ArrayLike, closes_to: float) -> tuple[Floats, Floats]:
    """The rows as arrays, without a last one that repeats the first, when they cover a turn in order.

    closes_to : how far a last row that repeats the first may miss it

    Raises
    ------
    RowError : a row that cannot be, the first there is
    """
    try:
        phi, values = np.asarray(phi, dtype=np.float64), np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise DesignError("table", say("not of numbers"), say("a list of cam angles and one of values")) from None
    closes_to = min(closes_to, float(np.finfo(np.float64).max))  # a whole number of a file may be larger
    if phi.ndim != 1 or phi.shape != values.shape:
        shapes = say("{shape} and {shape2}", shape=phi.shape, shape2=values.shape)
        quantity = say("shapes of the table's columns")
        raise DesignError(quantity, shapes, say("one number for each cam angle"), say("give two lists"))
    if not MIN_ROWS <= phi.size <= MAX_ROWS:
        limit = say("from {least} to {most}", least=MIN_ROWS, most=MAX_ROWS)
        more = say("measure at more cam angles")
        remedy = more if phi.size < MIN_ROWS else say("leave rows out: every second one, say")
        raise RowError(max(phi.size - 1, 0), say("number of rows"), phi.size, limit, remedy)
    for k, number in enumerate(np.isfinite(phi) & np.isfinite(values)):
        if not number:
            found = say("{phi:g}, {values:g}", phi=phi[k], values=values[k])
            raise RowError(k, say("row"), found, say("finite numbers"), say("measure it"))
    for k in np.flatnonzero(np.abs(values) > MAX_VALUE)[:1]:
        found = say("{phi:g}, {values:g}", phi=phi[k], values=values[k])
        limit = say("numbers up to {most:g}", most=MAX_VALUE)
        raise RowError(int(k), say("row"), found, limit, say("measure again"))
    for k, step in enumerate(np.diff(phi), 1):
        if step <= ANGLE_ROUNDING:
            remedy = (
                say("give every cam angle once") if step >= -ANGLE_ROUNDING else say("sort the rows by the cam angle")
            )
            limit = say("greater than the one before, {degrees}", degrees=_degrees(phi[k - 1]))
            raise RowError(k, say("cam angle"), _degrees(phi[k]), limit, remedy)
    span, widest = float(phi[-1] - phi[0]), float(np.max(np.diff(phi)))
    last = phi.size - 1
    if span > FULL_TURN + ANGLE_ROUNDING or FULL_TURN - span > MAX_GAP_RATIO * widest:
        limit, remedy = say("360 degrees, or a step less"), _turn_remedy(span)
        if math.isfinite(closes_to) and _is_rise(values):
            remedy = _return_remedy(phi)
        raise RowError(last, say("turn that the rows cover"), _degrees(span), limit, remedy)
    falls = abs(float(values[-1] - values[0])) > MAX_FALL_SHARE * float(np.ptp(values)) and _is_rise(values)
    closed = span >= FULL_TURN - ANGLE_ROUNDING
    if abs(values[-1] - values[0]) > closes_to and (closed or falls):
        limit = say("{values:g} as in the first, a turn before", values=values[0])
        remedy = _return_remedy(phi) if falls else say("end where the turn began, or leave the last row out")
        raise RowError(last, say("last row"), say("{values:g}", values=values[-1]), limit, remedy)
    if closed:
        phi, values = phi[:-1], values[:-1]
    if math.isfinite(closes_to):
        _check_single_row(phi, values, closes_to)
    return phi, values


def _is_rise(values: Floats) -> bool:
    """Whether the rows go one way only, but for dwells."""
    steps = np.diff(values)
    ways = float(np.sum(np.maximum(steps, 0))), float(np.sum(np.maximum(-steps, 0)))
    return min(ways) < TURNS_SHARE * float(np.ptp(values))


def _return_remedy(phi: Floats) -> Words:
    """What to do about rows that only rise."""
    told = say(
        "from {first} to {last} the rows only rise or only fall: add those of the way back, or write "
        "motion.symmetric = true if it is the same in mirror image"
    )
    return told.with_values(first=_degrees(phi[0]), last=_degrees(phi[-1]))


def _turn_remedy(span: float) -> Words:
    """What to do about rows that do not cover a turn: perhaps their angles are in the other unit."""
    for turn, remedy in (
        (360.0, say("angles are in radians here: convert them by numpy.radians")),
        (math.radians(FULL_TURN), say("about 2 pi: give the angles in degrees, not in radians")),
    ):
        if MIN_TURN_SHARE * turn < span < (1 + NEAR_TURN_SHARE) * turn:
            return remedy
    return say("give one revolution of the cam")


def _degrees(angle: float) -> Caption:
    return say("{degrees:.10g} degrees", degrees=math.degrees(angle))


def _remedy(phi: Floats, s: Floats, tolerance: float) -> Words:
    """What to do about a tolerance that is too small: give the first of those tried with which there is a motion."""
    enough = max(tolerance, NOISE_TOLERANCE * _scatter(phi, s))
    for _ in range(TRIED_TOLERANCES):
        digit = 10.0 ** (math.floor(math.log10(enough)) - 1)
        enough = math.ceil(enough / digit) * digit
        try:
            if enough > tolerance:
                _measured(phi, s, float(f"{enough:.2g}"))
                return say("give a greater tolerance, as {enough}, or a table with less noise", enough=f"{enough:.2g}")
        except DesignError as error:
            if error.quantity != "tolerance":
                break
        enough *= TOLERANCE_STEP
    return say("give a table with less noise")


def _check_single_row(phi: Floats, s: Floats, tolerance: float) -> None:
    """Refuse a row alone off the others: if it lay where its neighbours say, they would all be right.

    Raises
    ------
    RowError : there is such a row
    """
    off = s - _by_neighbours(phi, s)
    k = int(np.argmax(np.abs(off)))
    moved = s.copy()
    moved[k] -= off[k]
    near = (k + np.arange(-NEIGHBOURS, NEIGHBOURS + 1)) % s.size
    left = np.abs(moved - _by_neighbours(phi, moved))[near].max()
    if abs(off[k]) > max(MIN_LEG_LIFT * tolerance, OUTLIER_FACTOR * max(float(left), _scatter(phi, s))):
        limit = say("about {there:.4g}, as the rows on both sides say", there=moved[k])
        raise RowError(k, say("row"), say("{row:g}", row=s[k]), limit, say("measure it again, or leave it out"))


def _by_neighbours(phi: Floats, s: Floats) -> Floats:
    """(n,) what three rows on either side of each say of it: the value there of the polynomial through them."""
    steps = [k for k in range(-NEIGHBOURS, NEIGHBOURS + 1) if k]
    x = np.stack([(np.roll(phi, k) - phi + math.pi) % FULL_TURN - math.pi for k in steps])
    rows = np.stack([np.roll(s, k) for k in steps])
    apart = x[None, :] - x[:, None]  # x_j - x_i
    factors = np.where(apart == 0, 1.0, x[None, :] / np.where(apart == 0, 1.0, apart))
    return ordered_sum((rows * np.prod(factors, axis=1)).T)


def _scatter(phi: Floats, s: Floats) -> float:
    """The standard deviation of the rows, from what a polynomial of the fifth degree through every seven leaves.

    The median of a part of the turn does not see the few rows about a jump; the maximum of the parts is taken,
    because rounding is smaller where the follower rests.
    """
    rows = np.arange(s.size)[:, None] + np.arange(NOISE_WINDOW)
    x = phi[rows % s.size] + FULL_TURN * (rows // s.size)
    apart = (x[:, :, None] - x[:, None, :]) / (x[:, -1:, None] - x[:, :1, None]) + np.eye(NOISE_WINDOW)
    weights = 1 / np.cumprod(apart, axis=2)[..., -1]
    left = ordered_sum(weights * s[rows % s.size]) / np.sqrt(ordered_sum(weights**2))
    parts = np.array_split(np.abs(left), max(s.size // ROWS_PER_PART, 1))
    return max(float(np.median(part)) for part in parts) / NORMAL_MEDIAN


# --- from the spline to phases ---------------------------------------------------------------------------------------


def _phases(fitted: PiecewisePolynomial, legs: list[Leg]) -> tuple[list[Phase], float, float]:
    """The phases of one turn, the cam angle [rad] at which they begin, and the lowest displacement."""
    ends = [
        leg.end if leg.to_rest else _turning_angle(fitted, leg, following)
        for leg, following in zip(legs, [*legs[1:], legs[0].a_turn_later], strict=True)
    ]
    before = [ends[-1] - FULL_TURN, *ends[:-1]]
    starts = [leg.start if leg.from_rest else end for leg, end in zip(legs, before, strict=True)]
    for leg, start, end in zip(legs, starts, ends, strict=True):
        fitted = fitted.at_rest(start, REST_ZEROS if leg.from_rest else TURNING_ZEROS)
        fitted = fitted.at_rest(end, REST_ZEROS if leg.to_rest else TURNING_ZEROS)
    phases: list[tuple[float, Phase]] = []
    for leg, start, end, following in zip(legs, starts, ends, [*starts[1:], starts[0] + FULL_TURN], strict=True):
        lift, law = leg_law(MEASURED_LAW, fitted.between(start, end))
        phases.append((start, (Rise if leg.direction > 0 else Return)(abs(lift), end - start, law)))
        if leg.to_rest:
            phases.append((end, Dwell(following - end)))
    return *from_zero(phases), float(fitted(starts)[0].min())


def _turning_angle(fitted: PiecewisePolynomial, leg: Leg, following: Leg) -> float:
    """The cam angle [rad] between two legs where the velocity changes its sign."""
    before = np.linspace(leg.start, leg.end, LEG_SAMPLES)
    after = np.linspace(leg.end, following.end, LEG_SAMPLES)
    fastest = [x[np.argmax(way * leg.direction * fitted(x)[1])] for x, way in ((before, 1), (after, -1))]
    return float(roots(lambda x: fitted(x)[1], *fastest))


def from_zero(phases: list[tuple[float, Phase]]) -> tuple[list[Phase], float]:
    """The phases from the cam angle 0 on, or from the nearest end of a phase to it, if the follower moves at 0.

    phases : with the cam angles at which they begin [rad], in order over one turn
    returns : the phases, and the angle at which they begin
    """
    starts = np.array([start for start, _ in phases]) % FULL_TURN
    k = int(np.argmax(starts))  # the phase that reaches over 0
    (_, over), start = phases[k], float(starts[k]) - FULL_TURN
    others = [phase for _, phase in [*phases[k + 1 :], *phases[:k]]]
    end = start + over.angle
    if isinstance(over, Dwell) and min(-start, end) > ANGLE_ROUNDING:
        return [Dwell(end), *others, Dwell(-start)], 0.0
    return ([over, *others], start) if -start < end else ([*others, over], end)
