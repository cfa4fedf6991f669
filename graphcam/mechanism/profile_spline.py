"""The profile as one clamped B-spline, for programs that know no cams; of an undercut cam what can be cut.

Over its own arc length the profile is as smooth as its curvature is.  So the spline, a cubic one if nothing else is
asked for, is

- C2, curvature included, wherever the exact curvature is continuous, and of a cam without jumps the two ends meet so
  too.  Where the slope of the curvature jumps, one of degree 4 or 5 has knots so often repeated that it is no smoother
  than the cam; elsewhere its knots are simple;
- C1 over the arc length, with the exact tangent, where the acceleration jumps and the exact curvature with it: double
  knots in a cubic one.  A spline that were smoother than the cam would swing about it there;
- C0 with both exact tangents at the corners that an undercut leaves, and at a cusp: triple knots.

Between those places it is the nearest one in the sense of least squares.  Of the degree p its error goes by the
derivative p + 1 and that power of the knots' distance, so the knots are set for equal errors; the deviation is then
measured, and where it is missed there come more.

The curvature jumps where the acceleration does; the profile has a corner where an undercut has left one, or a cusp.

Curves fitted by B-splines of any degree: least squares, with what must hold at the ends held exactly.

A spline through given points misses a curve between them and always to the same side; that of the least squares of the
error swings about the curve, so that with the same knots it stays about twice as near.  What has to hold exactly (ends,
tangents, a smooth seam) comes in by Lagrange's multipliers.

Written for itself because ``scipy.interpolate`` takes longer to load than a task takes to be solved.  Source: C. de
Boor, *A Practical Guide to Splines* (rev. ed., 2001), chapters X and XIV.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.given.b_splines import basis_functions
from graphcam.given.laws import Floats
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.conjugate_cam import ConjugateCam
from graphcam.mechanism.envelope import Envelope, Indices
from graphcam.mechanism.kinematics import Complexes
from graphcam.mechanism.undercut import LostStretch, kept_arcs, lost_parts
from graphcam.plane_vectors import turned
from graphcam.words import and_chain, or_list, say

# --- curves fitted by B-splines --------------------------------------------------------------------------------------

SOLUTION_COUNT = 2
"""The first one, and one of what rounding left of it, which normal equations magnify."""


@dataclass(frozen=True, eq=False)
class Conditions:
    """What control points must fulfil exactly: ``rows`` (k, m) @ control = ``values`` (k,)."""

    rows: Floats
    values: Complexes


@dataclass(frozen=True, eq=False)
class Basis:
    """The B-splines of degree p at places: numbers and values of those that are not zero there, both (n, p + 1).

    size : m, how many control points there are
    """

    numbers: Indices
    values: Floats
    size: int

    def at(self, control: Complexes) -> Complexes:
        """(n,) the points of the spline with these control points."""
        return np.sum(self.values * control[self.numbers], axis=1)

    def shares(self, of: Floats) -> Floats:
        """(m,) numbers (n,) at the places, summed for each control point as far as it is there."""
        return _sums_by_number(self.numbers, self.values * of[:, None], self.size)

    @property
    def products(self) -> Floats:
        """(m, p + 1) of each B-spline with itself and with the p next ones, summed over the places; others are zero."""
        width = self.numbers.shape[1]
        first, second = np.triu_indices(width)
        places = self.numbers[:, first] * width + second - first
        products = self.values[:, first] * self.values[:, second]
        return _sums_by_number(places, products, self.size * width).reshape(self.size, width)


def basis(knots: Floats, degree: int, at: Floats) -> Basis:
    """The B-splines over these knots at parameters (n,).

    >>> splines = basis(np.array([0.0, 0, 0, 1, 2, 2, 2]), 2, np.array([0.5, 2.0]))
    >>> splines.numbers.tolist(), splines.values.tolist()
    ([[0, 1, 2], [1, 2, 3]], [[0.25, 0.625, 0.125], [0.0, 0.0, 1.0]])
    """
    return Basis(*basis_functions(knots, degree, at), knots.size - degree - 1)


def at_ends(knots: Floats, degree: int, derivative: int) -> tuple[Floats, Floats]:
    """(m,) what each control point gives to a derivative at the start and at the end of a clamped spline.

    >>> [row.tolist() for row in at_ends(np.array([0.0, 0, 0, 2, 2, 2]), 2, 1)]
    [[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]]
    """
    first, last = np.zeros((2, knots.size - degree - 1))
    first[: derivative + 1] = _at_start(knots, degree, derivative)
    last[-derivative - 1 :] = (-1) ** derivative * _at_start(-knots[::-1], degree, derivative)[::-1]
    return first, last


def _at_start(knots: Floats, degree: int, derivative: int) -> Floats:
    """What the first control points give, by the derivatives' own control points."""
    rows = np.eye(derivative + 1)
    for k in range(derivative):
        widths = knots[degree + 1 : degree + 1 + derivative - k] - knots[k + 1 : derivative + 1]
        rows = (degree - k) * np.diff(rows, axis=0) / widths[:, None]
    return rows[0]


def fitted_control_points(splines: Basis, points: Complexes, conditions: Conditions) -> Complexes:
    """(m,) the control points of the spline nearest to points (n,), in the sense of least squares.

    >>> knots, at = np.array([0.0, 0, 0, 0, 1, 2, 2, 2, 2]), np.linspace(0, 2, 20)
    >>> ends = Conditions(np.stack(at_ends(knots, 3, 0)), np.array([0j, 2 + 2j]))
    >>> fitted_control_points(basis(knots, 3, at), (1 + 1j) * at, ends).imag.round(6)[1:].tolist()
    [0.333333, 1.0, 1.666667, 2.0]
    """
    # Rows of derivatives are as large as their parts are short.
    size = np.abs(conditions.rows).max(axis=1)
    rows, wanted, products = conditions.rows / size[:, None], conditions.values / size, splines.products
    control = np.zeros(splines.size, dtype=complex)
    for _ in range(SOLUTION_COUNT):
        off, left = points - splines.at(control), wanted - rows @ control
        free = np.stack([splines.shares(off.real), splines.shares(off.imag)], axis=1)
        solved = solve_banded(products, np.hstack([free, rows.T]))
        free, of_rows = solved[:, :2], solved[:, 2:]
        missing = np.stack([left.real, left.imag], axis=1) - rows @ free
        found = free + of_rows @ np.linalg.solve(rows @ of_rows, missing)
        control += found[:, 0] + 1j * found[:, 1]
    return control


def solve_banded(bands: Floats, right: Floats) -> Floats:
    """(m, n) the solution of a positive definite symmetric system for columns (m, n), by elimination in order.

    bands : (m, p + 1) of each row what stands on the diagonal and in the p places to the right of it

    >>> solve_banded(np.array([[2.0, 1.0], [2.0, 0.0]]), np.array([[4.0], [5.0]])).tolist()
    [[1.0], [2.0]]
    """
    upper, right = bands.copy(), right.copy()
    m, width = upper.shape
    for i in range(m):
        for k in range(1, min(width, m - i)):
            factor = upper[i, k] / upper[i, 0]
            upper[i + k, : width - k] -= factor * upper[i, k:]
            right[i + k] -= factor * right[i]
    for i in reversed(range(m)):
        reach = min(width, m - i)
        right[i] = (right[i] - upper[i, 1:reach] @ right[i + 1 : i + reach]) / upper[i, 0]
    return right


def _sums_by_number(numbers: Indices, values: Floats, size: int) -> Floats:
    return np.bincount(numbers.ravel(), values.ravel(), size).astype(np.float64)


# --- the profile -----------------------------------------------------------------------------------------------------

Degree = Literal[2, 3, 4, 5]
DEFAULT_DEVIATION = 0.0005
"""How far the spline may lie from the exact profile [mm]."""
MIN_DEVIATION = 1e-9
"""The minimum deviation [mm]: nearer, rounding would be approximated."""
MIN_DEVIATION_SHARE = 2.5e-13
"""The minimum deviation as a part of the cam."""
MAX_CONTROL_POINTS = 2000
"""The maximum number of control points that may be asked for."""
MAX_PARTS = 20_000
"""A demanded deviation that takes more is not looked for: the parts would fill the memory before they kept it."""
SEEN_DEVIATION_SHARE = 0.97
"""The part of the deviation that may be seen where it is measured: between these places it may be a little more."""
REFINEMENT_ROUNDS = 40
"""Rounds in which knots are added where the deviation was missed."""
MOVING_ROUNDS = 8
"""Rounds in which knots are moved there, where their number is given."""
MIN_GROWTH = 1.02
"""How many times as many they are then at least."""
KNOT_DENSITY_SAMPLES = 129
"""Samples between two breaks, to see how densely knots are needed."""
MAX_SPACING_GROWTH = 1.0
"""How many mm the distance of two knots may grow over a mm of the profile."""
TINY_DERIVATIVE = 1e-30
"""A derivative of zero is replaced by this."""
PROBE_FRACTIONS = np.arange(16) / 16
"""Where from one knot to the next the spline is fitted and measured: at the knots and in the middles it errs most."""
GAUSS_NODES, GAUSS_WEIGHTS = (0.5 * x for x in np.polynomial.legendre.leggauss(4))
"""The nodes and weights of Gauss for the arc length from one probe to the next."""
LEAST_SQUARES_CONSTANTS = {2: 124.0, 3: 720.0, 4: 4900.0, 5: 30240.0}
"""Constants of least squares with even knots, by degree p: the error is d h^(p+1) over this, d the derivative p + 1.

Its reciprocal is the maximum value of Bernoulli's polynomial over (p + 1)!.
"""


SAME_CURVATURE = 1e-9
"""A curvature that changes at a break by more than this part of 1/r0 jumps there."""
Span = tuple[float, float, int]
"""Cam angles between which the profile has all derivatives, and its piece."""


def stretches(envelope: Envelope, lost: list[LostStretch]) -> tuple[list[list[Span]], list[bool]]:
    """Stretches of continuous curvature, in order, and whether the tangent is continuous at the end of each.

    No joints and one stretch if the curvature is continuous all around.
    """
    spans, joints = _spans(envelope, lost)
    ends = [k for k, joint in enumerate(joints) if joint is not None]
    if not ends:
        return [spans], []
    # Begun behind a joint, so that the curve has its ends at one.
    first = ends[-1] + 1
    spans, joints = spans[first:] + spans[:first], joints[first:] + joints[:first]
    found: list[list[Span]] = [[]]
    for span, joint in zip(spans, joints, strict=True):
        found[-1].append(span)
        if joint is not None:
            found.append([])
    return found[:-1], [joint for joint in joints if joint is not None]


def _spans(envelope: Envelope, lost: list[LostStretch]) -> tuple[list[Span], list[bool | None]]:
    """The spans in order; at the end of each True for a jump of the curvature, False for a corner, else None."""
    corners = envelope.touching
    spans: list[Span] = []
    joints: list[bool | None] = []
    for begin, end in kept_arcs(envelope, lost):
        cuts = sorted({begin, end, *(x for x in (*envelope.edges.tolist(), *corners) if begin < x < end)})
        spans += [(low, high, int(envelope.piece((low + high) / 2))) for low, high in pairwise(cuts)]
        joints += [False if cut in corners else None for cut in cuts[1:-1]] + [False]
    joints[-1] = None  # the turn is closed without a corner, in the lowest place
    following = [*spans[1:], spans[0]]
    for k, (here, there) in enumerate(zip(spans, following, strict=True)):
        if joints[k] is None and _jumps(envelope, here, there):
            joints[k] = True
    return spans, joints


def _jumps(envelope: Envelope, here: Span, there: Span) -> bool:
    before, after = (float(envelope.curvature(phi, piece)) for phi, piece in ((here[1], here[2]), (there[0], there[2])))
    return abs(after - before) > SAME_CURVATURE / envelope.prime_radius


@dataclass(frozen=True, eq=False, repr=False)
class ProfileSpline:
    """A closed profile as a clamped B-spline; the parameter is the arc length [mm] from its start.

    degree : p
    knots : (m + p + 1,), the first p + 1 equal, and the last p + 1;  control : (m, 2) control points [mm]
    deviation : maximum distance from the exact profile along its normal [mm], measured
    """

    degree: Degree
    knots: Floats
    control: Floats
    deviation: float

    def __repr__(self) -> str:
        size = f"{len(self.control)} control points, length {self.knots[-1]:.6g} mm, deviation {self.deviation:.2g} mm"
        return f"ProfileSpline of degree {self.degree}, {size}; .knots, .control"

    def __call__(self, at: ArrayLike, derivative: int = 0) -> Floats:
        """The points (..., 2), or a derivative by the parameter, at parameters from 0 to ``knots[-1]``."""
        from scipy.interpolate import BSpline

        return BSpline(self.knots, self.control, self.degree)(np.asarray(at, dtype=np.float64), nu=derivative)

    def turned(self, by: complex) -> ProfileSpline:
        """The spline turned about the cam centre by the unit vector."""
        return replace(self, control=turned(self.control, by))


def profile_spline(
    cam: Cam | ConjugateCam,
    deviation: float = DEFAULT_DEVIATION,
    *,
    degree: Degree = 3,
    control_points: int | None = None,
    trimmed: bool = False,
    side: Literal["inner", "outer"] = "inner",
) -> ProfileSpline:
    """The profile, no farther than ``deviation`` mm from the exact one, or with a given number of control points.

    degree : 2 to 5
    control_points : their number, placed as well as possible; the spline's own ``deviation`` says how close it is, and
        no deviation is required.  None takes as many as the required deviation needs
    trimmed : for an undercut cam take the profile that can be cut, without the lost parts, as
        :meth:`Cam.trimmed_profile` gives it in points
    side : "outer" is the outer wall of a groove

    Raises
    ------
    DesignError : there is no such wall; the cam is undercut, and ``trimmed`` is not given; the deviation is smaller
        than can be told from rounding; the degree or the number of control points cannot be; or as for
        :meth:`Cam.undercuts`

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50)
    >>> gc.profile_spline(cam)
    ProfileSpline of degree 3, 45 control points, length 340.836 mm, deviation 0.00046 mm; .knots, .control
    >>> gc.profile_spline(cam, degree=5, control_points=60)
    ProfileSpline of degree 5, 60 control points, length 340.836 mm, deviation 5.6e-06 mm; .knots, .control
    >>> gc.profile_spline(cam)(0).round(3).tolist() == cam.profile(0).round(3).tolist()
    True
    """
    check_kind("cam", cam, (Cam, ConjugateCam))
    if degree not in get_args(Degree):
        raise DesignError("degree", degree, or_list("2345"))
    least = max(MIN_DEVIATION, MIN_DEVIATION_SHARE * (cam.prime_radius + cam.motion.lift))
    check_number("deviation", deviation, say("{least:g} mm or more", least=least), least=least)
    envelope = cam.outer_wall if side == "outer" else cam.envelope
    lost = lost_parts(envelope)
    if lost and not trimmed:
        ends = [(math.degrees(part.begin), math.degrees(part.end)) for part in lost]
        where = and_chain([say("from {begin:.2f} to {end:.2f}", begin=begin, end=end) for begin, end in ends])
        remedy = say(
            "take a smaller roller or a larger cam; trimmed=True gives what can be cut, as trimmed_profile(n) does"
        )
        raise DesignError("profile", say("undercut {where} degrees", where=where), say("without undercut"), remedy)
    spans, joints = stretches(envelope, lost)
    closed = not joints
    curves = [_Stretch(envelope, stretch, degree, closed) for stretch in spans]
    smooth = [True] if closed else joints
    if control_points is None:
        fits = [_near_fit(curve, deviation) for curve in curves]
    else:
        fits = _best_with_points(curves, control_points, smooth, deviation)
    return _joined_splines(fits, smooth, degree)


# --- the spline of one stretch ---------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Stretch:
    """A stretch of continuous curvature and the degree of its spline; ``closed`` if it is the whole turn."""

    envelope: Envelope
    spans: list[Span]
    degree: Degree
    closed: bool

    @property
    def repeated(self) -> int:
        """How often the knot between two spans stands there: the spline is C2 there, one of degree 2 C1."""
        return max(1, self.degree - 2)

    @property
    def min_parts(self) -> int:
        """Parts of a span: the ends alone take four control points."""
        return 2 if self.degree == 2 else 1

    def size(self, parts: int) -> int:
        """Control points that so many parts have."""
        return parts + self.degree + (len(self.spans) - 1) * (self.repeated - 1)


@dataclass(frozen=True, eq=False)
class _Fit:
    """The nearest spline: its knots and control points as complex numbers, and the maximum error in each span.

    errors : (spans,) maximum distance along the exact normal [mm]
    """

    knots: Floats
    control: Complexes
    errors: Floats


def _near_fit(stretch: _Stretch, deviation: float) -> _Fit:
    """A spline with about the fewest parts that keep the deviation."""
    aim = SEEN_DEVIATION_SHARE * deviation
    needs = _needs(stretch, aim)
    counts = np.array([need.parts[-1] for need in needs])
    for _ in range(REFINEMENT_ROUNDS):
        if counts.sum() > MAX_PARTS:
            break
        fit = _fit(stretch, needs, np.ceil(counts))
        if fit.errors.max() <= aim:
            return fit
        missed = fit.errors / aim
        # A poor span spoils its neighbours too, so the worst are mended first.
        poor = missed > max(1.0, missed.max() / 2)
        more = np.maximum(missed ** (1 / (stretch.degree + 1)), MIN_GROWTH)
        counts = np.where(poor, np.ceil(counts) * more, counts)
    remedy = say("state a larger one, or take a smaller roller")
    raise DesignError("deviation", say("{length:g} mm", length=deviation), say("larger for this profile"), remedy)


def _best_with_points(
    stretches: list[_Stretch], control_points: int, smooth: list[bool], deviation: float
) -> list[_Fit]:
    """The best of some splines that have so many control points together."""
    spans = [len(stretch.spans) for stretch in stretches]
    fewest = np.repeat([stretch.min_parts for stretch in stretches], spans)
    least = _fewest_points(stretches, smooth)
    if not least <= control_points <= MAX_CONTROL_POINTS:
        limit = say("{least} to {most} for this profile with degree {degree}")
        limit = limit.with_values(least=least, most=MAX_CONTROL_POINTS, degree=stretches[0].degree)
        raise DesignError("control_points", control_points, limit)
    needs = [_needs(stretch, deviation) for stretch in stretches]
    wants = np.array([need.parts[-1] for parts in needs for need in parts])
    best: list[_Fit] = []
    for _ in range(MOVING_ROUNDS):
        counts = np.split(_shared_parts(wants, fewest, control_points - least), np.cumsum(spans)[:-1])
        fits = [_fit(*part) for part in zip(stretches, needs, counts, strict=True)]
        errors = np.concatenate([fit.errors for fit in fits])
        if not best or errors.max() < max(fit.errors.max() for fit in best):
            best = fits
        wants = wants * np.maximum(errors / errors.max(), TINY_DERIVATIVE) ** (1 / (stretches[0].degree + 1))
    return best


def _fewest_points(stretches: list[_Stretch], smooth: list[bool]) -> int:
    """The number of control points of the splines with the fewest parts."""
    least = sum(stretch.size(stretch.min_parts * len(stretch.spans)) for stretch in stretches)
    # Where two stretches meet smoothly the ends of both are given away, at a corner one.
    return least - sum(2 if joint else 1 for joint in smooth[:-1])


def _shared_parts(wants: Floats, fewest: NDArray[np.int64], more: int) -> NDArray[np.int64]:
    """The numbers of parts of the pieces: the fewest, and ``more`` in all, each given where it is wanted most."""
    counts = fewest.copy()
    for _ in range(more):
        counts[np.argmax(wants / counts)] += 1
    return counts


@dataclass(frozen=True, eq=False)
class _KnotNeed:
    """How many parts a span wants from its start on: (n,) cam angles, and the number of parts up to there."""

    phi: Floats
    parts: Floats

    def cuts(self, count: int) -> Floats:
        """The cam angles that divide the span into so many parts of equal need."""
        cuts = np.interp(np.linspace(0, self.parts[-1], count + 1), self.parts, self.phi)
        cuts[[0, -1]] = self.phi[[0, -1]]
        return cuts


def _needs(stretch: _Stretch, deviation: float) -> list[_KnotNeed]:
    # Densely at the ends, where a cusp may be near.
    envelope, degree = stretch.envelope, stretch.degree
    share = np.sin(np.linspace(0, np.pi / 2, KNOT_DENSITY_SAMPLES)) ** 2
    low, high, piece = (np.array(column)[:, None] for column in zip(*stretch.spans, strict=True))
    ends = low + (high - low) * share
    lengths = _lengths(envelope, ends, piece)
    middles = np.cumsum(lengths).reshape(lengths.shape) - lengths / 2
    highest = np.stack([_highest(envelope, degree, *row) for row in zip(ends, middles, piece[:, 0], strict=True)])
    steps = (LEAST_SQUARES_CONSTANTS[degree] * deviation / np.maximum(highest, TINY_DERIVATIVE)) ** (1 / (degree + 1))
    parts = np.cumsum(lengths / _graded(steps.ravel(), middles.ravel(), stretch.closed).reshape(steps.shape), axis=1)
    return [_KnotNeed(phi, np.append(0.0, row)) for phi, row in zip(ends, parts, strict=True)]


def _highest(envelope: Envelope, degree: int, ends: Floats, at: Floats, piece: int) -> Floats:
    """The size of the derivative p + 1 by the arc length, at the lengths ``at`` in the middles between cam angles."""
    middles = (ends[:-1] + ends[1:]) / 2
    kappa = envelope.curvature(middles, np.full(middles.size, piece))
    kappa = kappa / (1 - envelope.roller_radius * kappa)
    # Seen from the tangent, which turns by kappa itself.
    derivative = np.ones(at.size, dtype=complex)
    for _ in range(degree):
        derivative = np.gradient(derivative, at) + 1j * kappa * derivative
    return np.abs(derivative)


def _graded(steps: Floats, at: Floats, periodic: bool) -> Floats:
    """Steps that grow along the curve by no more than MAX_SPACING_GROWTH: a long one beside a short one would magnify
    its error."""
    if periodic:
        n, turn = at.size, at[0] + at[-1]
        return _graded(np.tile(steps, 3), np.concatenate([at - turn, at, at + turn]), periodic=False)[n : 2 * n]
    ahead = np.minimum.accumulate(steps - MAX_SPACING_GROWTH * at) + MAX_SPACING_GROWTH * at
    back = np.minimum.accumulate((steps + MAX_SPACING_GROWTH * at)[::-1])[::-1] - MAX_SPACING_GROWTH * at
    return np.minimum(ahead, back)


def _fit(stretch: _Stretch, needs: list[_KnotNeed], counts: ArrayLike) -> _Fit:
    """The nearest spline with so many parts in each span, but for the fewest."""
    envelope, degree = stretch.envelope, stretch.degree
    parts = np.maximum(np.asarray(counts, dtype=int), stretch.min_parts)
    cuts = [need.cuts(count) for need, count in zip(needs, parts.tolist(), strict=True)]
    begin, end = (np.concatenate([cut[part] for cut in cuts]) for part in (slice(None, -1), slice(1, None)))
    piece = np.repeat([piece for *_, piece in stretch.spans], parts)[:, None]
    probes = begin[:, None] + (end - begin)[:, None] * PROBE_FRACTIONS
    lengths = _lengths(envelope, np.column_stack([probes, end]), piece)
    ends = np.append(0.0, np.cumsum(lengths)[PROBE_FRACTIONS.size - 1 :: PROBE_FRACTIONS.size])
    knots = _knots(ends, np.cumsum(parts)[:-1], degree, stretch.repeated)
    at = (ends[:-1, None] + np.cumsum(lengths, axis=1) - lengths).ravel()
    pieces = np.broadcast_to(piece, probes.shape)
    points, splines = envelope.point(probes, pieces), basis(knots, degree, at)
    control = fitted_control_points(splines, points.ravel(), _conditions(stretch, knots))
    off = (splines.at(control).reshape(points.shape) - points) / envelope.tangent(probes, pieces)
    first = np.cumsum(parts) - parts
    return _Fit(knots, control, np.maximum.reduceat(np.abs(off.imag).max(axis=1), first))


def _knots(ends: Floats, breaks: Indices, degree: int, repeated: int) -> Floats:
    times = np.ones(ends.size, dtype=int)
    times[breaks] = repeated
    times[[0, -1]] = degree + 1
    return np.repeat(ends, times)


def _conditions(stretch: _Stretch, knots: Floats) -> Conditions:
    """A closed curve is as smooth at its seam as between spans; another one has exact ends, and tangents there."""
    orders = stretch.degree - stretch.repeated + 1 if stretch.closed else 2
    rows = [at_ends(knots, stretch.degree, derivative) for derivative in range(orders)]
    if stretch.closed:
        return Conditions(np.stack([last - first for first, last in rows]), np.zeros(orders, dtype=complex))
    (begin, _, first), (_, end, last) = stretch.spans[0], stretch.spans[-1]
    envelope = stretch.envelope
    places = ((begin, first), (end, last))
    values = [f(phi, piece) for f in (envelope.point, envelope.tangent) for phi, piece in places]
    return Conditions(np.stack([row for pair in rows for row in pair]), np.array(values))


def _lengths(envelope: Envelope, phi: Floats, piece: Indices) -> Floats:
    """The arc lengths [mm] from each of the cam angles (..., n) to the next; a row has one piece (..., 1)."""
    width = np.diff(phi)[..., None]
    nodes = (phi[..., :-1] + phi[..., 1:])[..., None] / 2 + width * GAUSS_NODES
    speed = envelope.speed(nodes, np.broadcast_to(piece[..., None], nodes.shape))
    return np.sum(speed * GAUSS_WEIGHTS * width, axis=-1)


def _joined_splines(fits: list[_Fit], smooth: list[bool], degree: Degree) -> ProfileSpline:
    """One spline of several, each joined to the next smoothly or with a corner."""
    p = degree
    knots, control = [fits[0].knots[: p + 1]], [fits[0].control[:1]]
    length = 0.0
    for k, (fit, joined) in enumerate(zip(fits, smooth, strict=True)):
        length_here = length + fit.knots
        last = k == len(fits) - 1
        # With one tangent on both sides the common end lies between its neighbours and is no control point.
        control.append(fit.control[1 : (-1 if joined and not last else None)])
        common = length_here[-p - 1 :] if last else length_here[-p - 1 : (-2 if joined else -1)]
        knots += [length_here[p + 1 : -p - 1], common]
        length = float(length_here[-1])
    points = np.concatenate(control)
    points[-1] = points[0]  # to the last digit, by which some programs tell a closed curve
    return ProfileSpline(
        degree,
        np.concatenate(knots),
        np.stack([points.real, points.imag], axis=-1),
        float(max(fit.errors.max() for fit in fits)),
    )
