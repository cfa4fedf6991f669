"""The inverse problem of a cam that was made: the motion of the follower on a wavy profile, in a mechanism that is off.

With N the profile's outer normal, tau = -i sigma N along it, and L = |p'|, the profile as it is made lies delta too far
out.  Its derivative by the parameter theta, the cam angle at which the nominal follower would touch that place, is

    W' = M tau + delta' N,    M = L (1 - (r - delta) kappa)

so its normal leans by gamma, tan(gamma) = delta'/M, and the normal turns by L kappa - gamma'.  The roller that is made
runs on the parallel curve at its radius.  At the cam angle phi the follower touches where that curve, turned by
sigma phi, meets its path; so s follows from a root theta, and v and a follow from normal and curvature there.  Nothing
is neglected, and no derivative is a difference.

Quantities that carry their first two derivatives by phi along, by the rules of Leibniz.

A function of numpy's four operations, square roots and tangents takes such quantities as it takes arrays.

Source: A. Griewank, A. Walther, *Evaluating Derivatives* (2008), chapter 13.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields
from typing import Any, cast

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import ArrayLike

from graphcam.errors import DesignError, check_kind, nearest_word_remedy
from graphcam.given.laws import Floats
from graphcam.given.making_errors import Deviations
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.kinematics import Contour, Values
from graphcam.words import say

# --- quantities with two derivatives ---------------------------------------------------------------------------------

Constant = Floats | float


@dataclass(eq=False, repr=False)
class Jet(NDArrayOperatorsMixin):
    """A quantity with its first two derivatives, arrays of one shape.

    >>> x = Jet(np.array([2.0]), np.array([1.0]), np.array([0.0]))
    >>> square = x * x
    >>> square.value.item(), square.slope.item(), square.bend.item()
    (4.0, 4.0, 2.0)
    """

    value: Floats
    slope: Floats
    bend: Floats

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any) -> Any:
        rule = _UFUNC_RULES.get(ufunc)
        return NotImplemented if rule is None or method != "__call__" else rule(*inputs)


def _jet(f: Jet | Constant) -> Jet:
    return f if isinstance(f, Jet) else Jet(np.asarray(f), _ZERO, _ZERO)


_ZERO = np.zeros(())


def _negative(f: Jet) -> Jet:
    return Jet(-f.value, -f.slope, -f.bend)


def _add(f: Jet | Constant, g: Jet | Constant) -> Jet:
    f, g = _jet(f), _jet(g)
    return Jet(f.value + g.value, f.slope + g.slope, f.bend + g.bend)


def _subtract(f: Jet | Constant, g: Jet | Constant) -> Jet:
    return _add(f, -g)


def _multiply(f: Jet | Constant, g: Jet | Constant) -> Jet:
    f, g = _jet(f), _jet(g)
    bend = f.bend * g.value + 2 * (f.slope * g.slope) + f.value * g.bend
    return Jet(f.value * g.value, f.slope * g.value + f.value * g.slope, bend)


def _divide(f: Jet | Constant, g: Jet | Constant) -> Jet:
    f, g = _jet(f), _jet(g)
    value = f.value / g.value
    slope = (f.slope - value * g.slope) / g.value
    return Jet(value, slope, (f.bend - value * g.bend - 2 * slope * g.slope) / g.value)


def _sqrt(f: Jet) -> Jet:
    root = np.sqrt(f.value)
    slope = f.slope / (2 * root)
    return Jet(root, slope, (f.bend - 2 * slope * slope) / (2 * root))


def _tan(f: Jet) -> Jet:
    tangent = np.tan(f.value)
    rate = 1 + tangent * tangent
    return Jet(tangent, rate * f.slope, rate * (f.bend + 2 * tangent * f.slope * f.slope))


_UFUNC_RULES: dict[np.ufunc, Callable[..., Jet]] = {
    np.add: _add,
    np.subtract: _subtract,
    np.multiply: _multiply,
    np.divide: _divide,
    np.negative: _negative,
    np.sqrt: _sqrt,
    np.tan: _tan,
}
"""How each of numpy's operations treats such quantities."""


# --- the motion on a cam that was made -------------------------------------------------------------------------------

MAX_NEWTON_STEPS = 20
"""Newton's steps; three or four do where waves are shallow."""
CONVERGED_STEP = 1e-13
"""A step that is no longer [rad] ends the search ..."""
DIVERGED_STEP = 1e-9
"""A search whose last step [rad] is longer than this has found no contact."""


@dataclass(frozen=True, eq=False)
class MadeCam:
    """A cam and its follower as they were made.

    cam : as it was designed;  deviations : what is off, of one cam or of many

    Raises
    ------
    DesignError : the follower has no such size as one of the deviations

    >>> import graphcam as gc
    >>> from math import pi
    >>> motion = gc.Motion([gc.Rise(10, pi), gc.Return(10, pi)])
    >>> cam = gc.Cam(motion, gc.Translating(roller_radius=8), prime_radius=30)
    >>> larger = gc.MadeCam(cam, gc.Deviations((), np.zeros(0), {"roller_radius": 0.01}))
    >>> s, v, a = larger([0.0, pi / 2])
    >>> s.round(6).tolist()  # in the lower dwell by 0.01, on the steep flank by 0.01/cos(alpha)
    [0.01, 5.010144]
    """

    cam: Cam
    deviations: Deviations

    def __post_init__(self) -> None:
        check_kind("cam", self.cam, Cam)
        check_kind("deviations", self.deviations, Deviations, remedy=say("MakingErrors.sample(...) draws them"))
        own = [size.name for size in fields(self.cam.follower)]
        for name in self.deviations.sizes:
            if name not in own:
                limit = say("a size of the {kind} follower", kind=self.cam.follower.kind)
                raise DesignError("sizes", name, limit, nearest_word_remedy(name, own) if own else say("leave it out"))

    def __call__(self, phi: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """(s, v, a) at cam angles phi [rad], counted from the nominal lowest place; shaped like phi and the deviations.

        NaN where the follower cannot follow: a roller too large for a hollow of the waves, or a flat face over one.
        Where the acceleration jumps it jumps at another cam angle than it was designed to.
        """
        phi = np.asarray(phi, dtype=np.float64)
        theta = phi + np.zeros(self.deviations.shape)
        step = np.full(np.shape(theta), np.inf)
        for _ in range(MAX_NEWTON_STEPS):
            contour = self._contour(theta, phi)
            beyond, slope = self.cam.kinematics.gap(contour, self.deviations.sizes)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = beyond / slope
            theta = theta - step
            if not np.nanmax(np.abs(step), initial=0.0) > CONVERGED_STEP:
                break
        contour = self._contour(theta, phi)
        follows = (np.abs(step) < DIVERGED_STEP) & (contour.speed > 0)
        if not self.cam.kinematics.takes_roller:
            follows &= contour.turning > 0  # a face lies on summits alone
        s, v, a = self.cam.kinematics.motion_on_contour(contour, self.deviations.sizes)
        return np.where(follows, s, np.nan), np.where(follows, v, np.nan), np.where(follows, a, np.nan)

    def _contour(self, theta: Floats, phi: Floats) -> Contour:
        """The parallel curve of the profile at the roller's radius, seen from the frame at the cam angle phi."""
        kin, r = self.cam.kinematics, self.cam.roller_radius
        s, v, a, j = self.cam.motion(theta)
        delta, slope, bend = self.deviations.waviness(theta)
        values = s, v, a, j
        (x, y), (nx, ny), kappa = kin.path(values)
        normal = nx + 1j * np.asarray(ny)
        length = kin.speed(values, 0.0)
        along = cast(Jet, kin.speed(_followed(values), cast(Any, Jet(r - delta, -slope, -bend))))
        forwards = np.hypot(along.value, slope)
        leaning = (bend * along.value - slope * along.slope) / (forwards * forwards)
        turning = length * kappa - leaning
        made = normal * (along.value + 1j * self.cam.sigma * slope) / forwards
        reach = r + np.asarray(self.deviations.sizes.get("roller_radius", 0.0))
        speed = forwards + reach * turning
        seen = np.exp(1j * self.cam.sigma * (phi - theta))
        point = x + 1j * np.asarray(y) + (delta - r) * normal + reach * made
        return Contour(point * seen, made * seen, turning / speed, speed, turning)


def lifts_by_error(kin: Any, values: Values) -> dict[str, Jet]:
    """The lift of the follower by what is too large, with the first two derivatives by phi."""
    return kin.lift_per_error(_followed(values))


def _followed(values: Values) -> Values:
    """(s, v, a, j) as quantities that know their derivatives by phi."""
    return cast(Values, tuple(_derivatives(values)))


def _derivatives(values: Values) -> Iterator[Any]:
    s, v, a, j = values
    yield Jet(s, v, a)
    yield Jet(v, a, j)
    yield Jet(a, j, np.zeros(()))  # its second derivative is asked for by nobody
    yield j
