"""The profile as one clamped cubic B-spline, for programs that know no cams; of an undercut cam what can be cut.

Over its own arc length the profile is as smooth as its curvature is.  So the spline is

- C2, curvature included, wherever the exact curvature is continuous: its knots are simple there, and of a cam without
  jumps the two ends meet so too;
- C1 over the arc length, with the exact tangent, where the acceleration jumps and the exact curvature with it: double
  knots.  A spline that were smoother than the cam would swing about it there;
- C0 with both exact tangents at the corners that an undercut leaves, and at a cusp: triple knots.

It passes through the exact points at its knots and is clamped there by the exact tangents, stretch by stretch.  Its
error goes by the fourth derivative and the fourth power of the knots' distance, so the knots are set for equal errors;
the deviation is then measured between them, and where it is missed there come more.
"""

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.complete_spline import closed_spline_through, spline_through
from graphcam.mechanism.envelope import GAUSS_NODES, GAUSS_WEIGHTS, Envelope, Indices
from graphcam.mechanism.kinematics import Complexes
from graphcam.mechanism.undercut import Lost, kept_arcs, lost_parts

DEVIATION = 0.001
"""How far the spline may lie from the exact profile [mm]."""
LEAST_DEVIATION = 1e-9
"""Nearer than this [mm] rounding would be approximated ..."""
LEAST_PART = 1e-12
"""... or than this part of the cam."""
ROUNDS = 40
"""Of taking more knots where the deviation was missed."""
LEAST_GROWTH = 1.02
"""How many times as many they are then at least."""
NEED_SAMPLES = 129
"""Between two breaks, to see how densely knots are needed."""
GRADE = 1.0
"""By how many mm the distance of two knots may grow over a mm of the profile."""
TINY = 1e-30
"""In place of a fourth derivative of zero [1/mm^3]."""
PROBES = (np.arange(16) + 0.5) / 16
"""Where between two knots the spline is measured."""
SAME_CURVATURE = 1e-9
"""A curvature that changes at a break by more than this part of 1/r0 jumps there."""


@dataclass(frozen=True, eq=False, repr=False)
class ProfileSpline:
    """A closed profile as a clamped cubic B-spline; the parameter is the arc length [mm] from its start.

    knots : (m + 4,) the first four equal, and the last four;  control : (m, 2) control points [mm]
    deviation : greatest distance from the exact profile along its normal [mm], measured
    """

    knots: Floats
    control: Floats
    deviation: float

    def __repr__(self) -> str:
        size = f"{len(self.control)} control points, length {self.knots[-1]:.6g} mm, deviation {self.deviation:.2g} mm"
        return f"ProfileSpline of {size}; .knots, .control"

    def __call__(self, at: ArrayLike, derivative: int = 0) -> Floats:
        """(..., 2) the points, or a derivative by the parameter, at parameters from 0 to ``knots[-1]``."""
        from scipy.interpolate import BSpline

        return BSpline(self.knots, self.control, 3)(np.asarray(at, dtype=np.float64), nu=derivative)


def profile_spline(cam: Cam, deviation: float = DEVIATION, *, trimmed: bool = False) -> ProfileSpline:
    """The profile, no farther than ``deviation`` mm from the exact one.

    trimmed : of an undercut cam what can be cut is wanted, without what is lost, as :meth:`Cam.trimmed_profile` tells
        it in points

    Raises
    ------
    DesignError : the cam is undercut, and ``trimmed`` is not given; the deviation is smaller than can be told from
        rounding; or as for :meth:`Cam.undercuts`

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> spline = gc.profile_spline(gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50))
    >>> len(spline.control), spline.deviation < 0.001, spline(0).round(4).tolist()
    (43, True, [7.6, 37.2322])
    """
    least = max(LEAST_DEVIATION, LEAST_PART * (cam.prime_radius + cam.motion.lift))
    if not deviation >= least:
        raise DesignError("deviation", deviation, f"{least:g} mm or more")
    envelope = cam.envelope
    lost = lost_parts(envelope)
    if lost and not trimmed:
        where = " and ".join(f"from {math.degrees(part.begin):.2f} to {math.degrees(part.end):.2f}" for part in lost)
        remedy = "take a smaller roller or a larger cam; trimmed=True gives what can be cut, as trimmed_profile(n) does"
        raise DesignError("profile", f"undercut {where} degrees", "without undercut", remedy)
    stretches, joints = _stretches(envelope, lost)
    closed = not joints
    splines = [_fitted(envelope, stretch, deviation, periodic=closed) for stretch in stretches]
    return _joined(splines, [True] if closed else joints)


# --- where the profile is as smooth as the spline --------------------------------------------------------------------

Span = tuple[float, float, int]
"""Cam angles between which the profile has all derivatives, and its piece."""


def _stretches(envelope: Envelope, lost: list[Lost]) -> tuple[list[list[Span]], list[bool]]:
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
    stretches: list[list[Span]] = [[]]
    for span, joint in zip(spans, joints, strict=True):
        stretches[-1].append(span)
        if joint is not None:
            stretches.append([])
    return stretches[:-1], [joint for joint in joints if joint is not None]


def _spans(envelope: Envelope, lost: list[Lost]) -> tuple[list[Span], list[bool | None]]:
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


# --- the spline of one stretch ---------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Fit:
    """A spline through exact points: its knots and control points as complex numbers, and the error in each part.

    cuts : the cam angles of the knots, for each span
    errors : (parts,) greatest distance along the exact normal [mm]
    """

    cuts: list[Floats]
    knots: Floats
    control: Complexes
    errors: Floats


def _fitted(envelope: Envelope, stretch: list[Span], deviation: float, *, periodic: bool) -> _Fit:
    """A spline with about the fewest parts that keep the deviation."""
    needs = _needs(envelope, stretch, deviation, periodic=periodic)
    counts = np.array([need.parts[-1] for need in needs])
    for _ in range(ROUNDS):
        cuts = [need.cuts(max(1, math.ceil(count))) for need, count in zip(needs, counts, strict=True)]
        fit = _through(envelope, stretch, cuts, periodic=periodic)
        if fit.errors.max() <= deviation:
            return fit
        starts = np.cumsum([0, *(cut.size - 1 for cut in cuts[:-1])])
        missed = np.maximum.reduceat(fit.errors, starts) / deviation
        # A poor span spoils its neighbours too, so the worst are mended first.
        poor = missed > max(1.0, missed.max() / 2)
        counts = np.where(poor, np.ceil(counts) * np.maximum(missed**0.25, LEAST_GROWTH), counts)
    remedy = "state a larger one, or take a smaller roller"
    raise DesignError("deviation", f"{deviation:g} mm", "larger for this profile", remedy)


@dataclass(frozen=True, eq=False)
class _Need:
    """How many parts a span wants from its start on: (n,) cam angles, and the number of parts up to there."""

    phi: Floats
    parts: Floats

    def cuts(self, count: int) -> Floats:
        """The cam angles that divide the span into so many parts of equal need."""
        cuts = np.interp(np.linspace(0, self.parts[-1], count + 1), self.parts, self.phi)
        cuts[[0, -1]] = self.phi[[0, -1]]
        return cuts


def _needs(envelope: Envelope, stretch: list[Span], deviation: float, *, periodic: bool) -> list[_Need]:
    # Densely at the ends, where a cusp may be near.
    share = np.sin(np.linspace(0, np.pi / 2, NEED_SAMPLES)) ** 2
    low, high, piece = (np.array(column)[:, None] for column in zip(*stretch, strict=True))
    ends = low + (high - low) * share
    lengths = _length(envelope, ends[:, :-1], ends[:, 1:], np.repeat(piece, NEED_SAMPLES - 1, axis=1))
    middles = np.cumsum(lengths).reshape(lengths.shape) - lengths / 2
    fourth = np.stack([_fourth(envelope, *row) for row in zip(ends, middles, piece[:, 0], strict=True)])
    # Of a function with the fourth derivative d, a cubic spline with the step h misses d h^4/384.
    steps = (384 * deviation / np.maximum(fourth, TINY)) ** 0.25
    parts = np.cumsum(lengths / _graded(steps.ravel(), middles.ravel(), periodic).reshape(steps.shape), axis=1)
    return [_Need(phi, np.append(0.0, row)) for phi, row in zip(ends, parts, strict=True)]


def _fourth(envelope: Envelope, ends: Floats, at: Floats, piece: int) -> Floats:
    """|c''''| by the arc length, at the arc lengths ``at`` in the middles between the cam angles ``ends``."""
    middles = (ends[:-1] + ends[1:]) / 2
    kappa = envelope.curvature(middles, np.full(middles.size, piece))
    kappa = kappa / (1 - envelope.roller_radius * kappa)
    slope = np.gradient(kappa, at)
    # c'' = kappa n, of which the derivatives along the normal and along the tangent.
    return np.hypot(np.gradient(slope, at) - kappa**3, 3 * kappa * slope)


def _graded(steps: Floats, at: Floats, periodic: bool) -> Floats:
    """Steps that grow along the curve by no more than GRADE: a long one beside a short one would magnify its error."""
    if periodic:
        n, turn = at.size, at[0] + at[-1]
        return _graded(np.tile(steps, 3), np.concatenate([at - turn, at, at + turn]), periodic=False)[n : 2 * n]
    ahead = np.minimum.accumulate(steps - GRADE * at) + GRADE * at
    back = np.minimum.accumulate((steps + GRADE * at)[::-1])[::-1] - GRADE * at
    return np.minimum(ahead, back)


def _through(envelope: Envelope, stretch: list[Span], cuts: list[Floats], *, periodic: bool) -> _Fit:
    begin, end = (np.concatenate([cut[part] for cut in cuts]) for part in (slice(None, -1), slice(1, None)))
    piece = np.repeat([piece for *_, piece in stretch], [cut.size - 1 for cut in cuts])
    at = np.concatenate([[0.0], np.cumsum(_length(envelope, begin, end, piece))])
    points = np.append(envelope.point(begin, piece), envelope.point(end[-1], piece[-1]))
    if periodic:
        points[-1] = points[0]
        spline = closed_spline_through(at, points)
    else:
        first, last = envelope.tangent(begin[0], piece[0]), envelope.tangent(end[-1], piece[-1])
        spline = spline_through(at, points, complex(first), complex(last))
    probes = begin[:, None] + (end - begin)[:, None] * PROBES
    pieces = np.repeat(piece[:, None], PROBES.size, axis=1)
    near = spline.beyond(_length(envelope, np.repeat(begin[:, None], PROBES.size, axis=1), probes, pieces))
    off = (near - envelope.point(probes, pieces)) / envelope.tangent(probes, pieces)
    return _Fit(cuts, spline.knots, spline.control, np.abs(off.imag).max(axis=1))


def _length(envelope: Envelope, begin: Floats, end: Floats, piece: Indices) -> Floats:
    """The arc length [mm] between cam angles of a piece."""
    width = (end - begin)[..., None]
    phi = (begin + end)[..., None] / 2 + width * GAUSS_NODES
    return np.sum(envelope.speed(phi, piece[..., None]) * GAUSS_WEIGHTS * width, axis=-1)


def _joined(fits: list[_Fit], smooth: list[bool]) -> ProfileSpline:
    """One spline of several, each joined to the next smoothly or with a corner."""
    knots, control = [fits[0].knots[:4]], [fits[0].control[:1]]
    length = 0.0
    for k, (fit, joined) in enumerate(zip(fits, smooth, strict=True)):
        length_here = length + fit.knots
        last = k == len(fits) - 1
        # With one tangent on both sides the common end lies between its neighbours and is no control point.
        control.append(fit.control[1 : (-1 if joined and not last else None)])
        knots += [length_here[4:-4], length_here[-4:] if last else length_here[-4 : (-2 if joined else -1)]]
        length = float(length_here[-1])
    points = np.concatenate(control)
    return ProfileSpline(
        np.concatenate(knots),
        np.stack([points.real, points.imag], axis=-1),
        float(max(fit.errors.max() for fit in fits)),
    )
