"""What an elastic follower makes of a rise: the response, the vibration that is left, and both over the speed.

A mass on the end of an elastic train follows a rise of the cam as x'' + 2 zeta Omega (x' - f') + Omega^2 (x - f) = 0,
in lifts and rise times, with Omega = 2 pi n and the ratio n of the rise time to the natural period.  The acceleration
x'' is what the train is strained by, so its maximum values are what counts: the *primary* one during the rise, the
*residual* one in the dwell after it.  Over n they make the shock spectrum (dynamic response spectrum) of the law.

Without damping the residual one is Omega |integral of f'' exp(i Omega u) du|.  By it, as tests show again:

    constant acceleration  16 sin^2(pi n/2)                          zero at even n
    cosine                 4 pi^2 n^2 |cos(pi n)|/|4 n^2 - 1|        zero at n = 3/2, 5/2, ...
    cycloidal              4 pi n |sin(pi n)|/|n^2 - 1|              zero at n = 2, 3, ...

A law whose k-th derivative is the first that jumps leaves a vibration that falls as n^(2 - k).

Sources: H. A. Rothbart (ed.), *Cam Design Handbook* (2004), section 13.2: the dynamic response spectrum, peak
acceleration over the ratio of the pulse's duration to the natural period, T1/TN in its figures 13.4 and 13.5; F. Y.
Chen, *Mechanics and Design of Cam Mechanisms* (1982), on dynamics: primary and residual spectra of a system of one
degree of freedom.  The definition and the axes are theirs; no number of theirs was at hand, so the numbers are held by
the closed forms above.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError
from graphcam.former_names import renamed
from graphcam.given.impact import NO_FORCE, check_finite_acceleration
from graphcam.given.laws import Floats, LawName, law as law_of
from graphcam.given.motion import FULL_TURN, Motion, MovingPhase
from graphcam.given.motion_law import Law
from graphcam.given.root_finding import roots
from graphcam.mechanism.arc_motion import ArcMotion
from graphcam.mechanism.oscillator import (
    ALL_OSCILLATORS,
    Drive,
    DrivenOscillators,
    Oscillator,
    Which,
    check_damping,
    driven,
)
from graphcam.showing import Plottable, value_text
from graphcam.words import say

MAX_RATIO = 1000.0
"""Natural periods in a rise; a follower still stiffer follows the cam."""
BATCH_CELLS = 2048
"""Cells of all oscillators that are solved at a time, which bounds the memory."""
NEAR_MAXIMUM_SHARE = 0.9
"""An extreme cannot be the maximum where the values beside it stay below this part of the maximum one."""
DEFAULT_RATIOS = np.linspace(0.1, 10.0, 397)
"""The ratios n of a spectrum for which none are given, the whole numbers and their halves among them."""
AnyMotion = Motion | ArcMotion


@dataclass(frozen=True, eq=False)
class Event:
    """The cam's motion from one dwell to the next, in lifts and rise times: of a law, or of a motion.

    name : of the law, or the phases;  drive : minus the acceleration, from 0 to the end of the event
    lift : s, v, a at times from 0 to the end;  level : s in the dwell after it
    peak : the maximum |a|, a law's C_a
    """

    name: str
    drive: Drive
    lift: Callable[[Floats], tuple[Floats, Floats, Floats]]
    level: float
    peak: float

    @property
    def end(self) -> float:
        """The end of the rise, where the dwell begins [rise times]: 1 for a law."""
        return float(self.drive.edges[-1])


def event_of(law: LawName | Law | AnyMotion) -> Event:
    """The rise by a law; of a motion its first rise that follows a dwell, with what comes until the next dwell.

    Raises
    ------
    DesignError : there is no such law, or the motion has no dwell before a rise

    >>> import graphcam as gc
    >>> event_of("cosine").end, event_of(gc.builtin_task().motion()).level
    (1.0, 1.0)
    """
    if isinstance(law, Motion | ArcMotion):
        if isinstance(law, Motion):
            check_finite_acceleration(law)
        return _of_motion(law)
    found = law_of(law)
    if any(found.velocity_jumps):
        raise DesignError("law", found.name, say("one of continuous velocity"), NO_FORCE)

    def lift(u: Floats) -> tuple[Floats, Floats, Floats]:
        f, f1, f2 = found(u, 2)
        return f, f1, f2

    drive = Drive(np.array([0.0, *found.edges, 1.0]), lambda u: -lift(u)[2])
    return Event(found.name, drive, lift, 1.0, found.peak_acceleration)


def _of_motion(motion: AnyMotion) -> Event:
    phases = motion.timing
    first = next((k for k, (kind, *_) in enumerate(phases) if kind == "rise" and phases[k - 1][0] == "dwell"), None)
    if first is None:
        remedy = say("the steady motion of one without dwells is gc.VibratingFollower")
        raise DesignError("motion", say("without a dwell before a rise"), say("one with such a dwell"), remedy)
    turned = [*phases[first:], *((kind, a + FULL_TURN, b + FULL_TURN) for kind, a, b in phases[:first])]
    count = next(k for k, (kind, *_) in enumerate(turned) if kind == "dwell")
    start, end, stop = turned[0][1], turned[0][2], turned[count][1]
    inside = turn_edges(motion)
    inside = np.concatenate([inside, inside + FULL_TURN])
    edges = np.concatenate([[start], inside[(inside > start) & (inside < stop)], [stop]])
    (below, above, level), angle = motion(np.array([start, end, stop]))[0].tolist(), end - start
    height = above - below

    def lift(u: Floats) -> tuple[Floats, Floats, Floats]:
        s, v, a, _ = motion(start + angle * u)
        return (s - below) / height, v * angle / height, a * angle**2 / height

    name = " and ".join(kind for kind, *_ in turned[:count])
    if isinstance(motion, Motion):
        met = [motion.phases[(first + k) % len(phases)] for k in range(count)]
        moving = [phase for phase in met if isinstance(phase, MovingPhase)]
        name = moving[0].normalised.name if count == 1 else name
        peak = max(phase.peak_acceleration for phase in moving)
    else:
        peak = motion.max_acceleration()[0]
    drive = Drive((edges - start) / angle, lambda u: -lift(u)[2])
    return Event(name, drive, lift, (level - below) / height, peak * angle**2 / height)


def turn_edges(motion: AnyMotion) -> Floats:
    """The cam angles [rad] between which a motion is smooth: 0, and where a phase or another formula begins."""
    if not isinstance(motion, Motion):
        return motion.breaks
    inner = [
        start + phase.angle * edge
        for start, phase in zip(motion.starts.tolist(), motion.phases, strict=True)
        if isinstance(phase, MovingPhase)
        for edge in phase.normalised.edges
    ]
    return np.unique([*motion.starts.tolist(), *inner])


# --- the response to one rise ----------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class FollowerResponse(Plottable):
    """What the mass does during a rise and after it; call it with times in rise times for (x, x', x''), in lifts.

    Made by :func:`follower_response`.  Before u = 0 it is at rest, after the event it vibrates freely.

    n : rise time over natural period;  damping : ratio to the critical one
    event : what the cam does
    """

    _drawn_in = "response_curves.plot"

    event: Event
    n: float
    damping: float
    solved: DrivenOscillators

    def __call__(self, u: ArrayLike) -> tuple[Floats, Floats, Floats]:
        """(x, x', x'') at times u [rise times], each shaped like u; NaN stays NaN."""
        u = np.asarray(u, dtype=np.float64)
        flat = np.maximum(u.ravel(), 0.0)
        s, v = np.full(flat.size, self.event.level), np.zeros(flat.size)
        driven = flat < self.event.end
        s[driven], v[driven], _ = self.event.lift(flat[driven])
        (y,), (y1,) = self.solved.at(flat)
        values = np.stack([s + y, v + y1, _acceleration(self.solved.oscillator, y, y1)])
        values[:, flat == 0] = 0.0
        values[:, np.isnan(flat)] = np.nan
        x, x1, x2 = values.reshape(3, *u.shape)
        return x, x1, x2

    @cached_property
    def primary(self) -> float:
        """The maximum |x''| up to the dwell [lifts/rise time^2]."""
        return float(_primary(self.solved)[0])

    @cached_property
    def residual(self) -> float:
        """The maximum |x''| in the dwell [lifts/rise time^2]; without damping the amplitude."""
        return float(_residual(self.solved)[0][0])

    @cached_property
    def amplitude(self) -> float:
        """How far the mass swings off its place in the dwell at most [lifts]; without damping the amplitude."""
        return float(_residual(self.solved)[1][0])

    def __repr__(self) -> str:
        sizes = (
            f"damping ratio {self.damping:g}",
            f"maximum acceleration {self.primary:.6g} during it, {self.residual:.6g} after it (lifts/rise time²)",
            f"amplitude after it {self.amplitude:.6g} lifts",
        )
        first = f"FollowerResponse, {self.event.name}, n = {self.n:g} natural periods in the rise"
        return value_text(first, sizes, "response(u) gives x, x' and x'' at u in rise times; .plot() draws them")


def follower_response(law: LawName | Law | AnyMotion, n: float, damping: float = 0.0) -> FollowerResponse:
    """The response of an elastic follower to a rise, and its vibration in the dwell after it.

    The follower is a mass on the end of a train with stiffness and damping (:class:`FollowerTrain`), at rest before.

    Parameters
    ----------
    law : a law's name, a :class:`Law`, or a motion: its first rise after a dwell, and what follows up to the next dwell
    n : the time of the rise over the natural period, up to 1000
    damping : ratio to the critical damping

    Raises
    ------
    DesignError : there is no such law; n or the damping is impossible; the motion has no dwell before a rise

    >>> import graphcam as gc
    >>> response = gc.follower_response("cycloidal", n=2.5)
    >>> x, x1, x2 = response([0.5, 1.0, 1.1])
    >>> x.round(4).tolist(), round(response.residual, 4), round(response.amplitude, 4)
    ([0.5121, 1.0, 0.9757], 5.984, 0.0243)
    >>> gc.follower_response("cycloidal", n=3).amplitude < 1e-15
    True
    """
    check_damping(damping)
    event, _ = event_of(law), _check_ratios(np.asarray(n, dtype=np.float64).ravel())
    oscillator = Oscillator(np.array([FULL_TURN * float(n)]), float(damping))
    return FollowerResponse(event, float(n), float(damping), driven(oscillator, event.drive))


def _check_ratios(n: Floats) -> None:
    for value in n[~((n > 0) & (n <= MAX_RATIO))][:1].tolist():
        limit = say("greater than 0 and at most {most:g}", most=MAX_RATIO)
        remedy = say("n is the rise time over the natural period")
        if value > MAX_RATIO:
            remedy = say("so stiff a follower follows the cam")
        raise DesignError("n", value, limit, remedy)
    if not n.size:
        raise DesignError("n", say("empty"), say("one ratio or more"), say("leave it out for the usual range"))


# --- over the ratio of times -----------------------------------------------------------------------------------------


@renamed(greatest="maximum")
@dataclass(frozen=True, eq=False, repr=False)
class ShockSpectrum(Plottable):
    """The maximum accelerations of elastic followers under one law, over n; made by :func:`shock_spectrum`.

    law : its name, or the phases from one dwell of a motion to the next;  damping : ratio to the critical one
    n : (k,) rise time over natural period
    primary, residual : (k,) the maximum |x''| during the rise, and in the dwell after it [lifts/rise time^2]
    amplitude : (k,) how far the mass swings off its place in the dwell at most [lifts]
    peak : the maximum |f''| of the cam itself, C_a [lifts/rise time^2]
    """

    _drawn_in = "response_curves.plot_spectrum"

    law: str
    damping: float
    n: Floats
    primary: Floats
    residual: Floats
    amplitude: Floats
    peak: float

    @property
    def maximum(self) -> Floats:
        """(k,) the maximum |x''| at any time (maximax) [lifts/rise time^2]."""
        return np.maximum(self.primary, self.residual)

    @property
    def factor(self) -> Floats:
        """(k,) the dynamic factor: the maximum |x''| over the cam's own."""
        return self.maximum / self.peak

    def __repr__(self) -> str:
        top = int(np.argmax(self.factor))
        sizes = (
            f"n from {self.n.min():g} to {self.n.max():g}, {self.n.size} in all; damping ratio {self.damping:g}",
            f"greatest dynamic factor {self.factor[top]:.4g} at n = {self.n[top]:g}, of C_a = {self.peak:.6g}",
        )
        last = "primary, residual, amplitude, factor: of each n; .plot() draws them"
        return value_text(f"ShockSpectrum, {self.law}", sizes, last)


def shock_spectrum(law: LawName | Law | AnyMotion, n: ArrayLike | None = None, damping: float = 0.0) -> ShockSpectrum:
    """The shock spectrum of a law: maximum accelerations during the rise and after it over n = T_rise/T_natural.

    Parameters
    ----------
    law : a law's name, a :class:`Law`, or a motion: its first rise after a dwell, and what follows up to the next dwell
    n : (k,) ratios, up to 1000; by default from 0.1 to 10
    damping : ratio to the critical damping

    Raises
    ------
    DesignError : there is no such law; n or the damping is impossible; the motion has no dwell before a rise

    >>> import graphcam as gc
    >>> spectrum = gc.shock_spectrum("rectangular", n=[1, 2, 3])
    >>> (spectrum.residual + 0.0).round(9).tolist()
    [16.0, 0.0, 16.0]
    >>> gc.shock_spectrum("cycloidal", n=[1, 2, 3.5]).primary.round(4).tolist()
    [19.7392, 10.8828, 8.6628]
    """
    check_damping(damping)
    event = event_of(law)
    ratios = DEFAULT_RATIOS.copy() if n is None else np.asarray(n, dtype=np.float64).ravel()
    _check_ratios(ratios)
    primary, residual, amplitude = np.empty((3, ratios.size))
    counts = event.drive.counts(Oscillator(FULL_TURN * ratios, float(damping)))
    _, group = np.unique(counts, axis=0, return_inverse=True)
    for number in range(int(group.max()) + 1):
        members = np.flatnonzero(group.ravel() == number)
        size = max(BATCH_CELLS // int(np.abs(counts[members[0]]).sum()), 1)
        for first in range(0, members.size, size):
            some = members[first : first + size]
            solved = driven(Oscillator(FULL_TURN * ratios[some], float(damping)), event.drive)
            primary[some] = _primary(solved)
            residual[some], amplitude[some] = _residual(solved)
    return ShockSpectrum(event.name, float(damping), ratios, primary, residual, amplitude, event.peak)


def _acceleration(oscillator: Oscillator, y: Floats, y1: Floats, who: Which = ALL_OSCILLATORS) -> Floats:
    """x'', by the equation of motion: it needs no second derivative, and does not jump where the cam's does."""
    nu = oscillator.frequency[who]
    nu = nu[:, None] if isinstance(who, slice) and np.ndim(y) > 1 else nu
    return -nu * (2 * oscillator.damping * y1 + nu * y)


def _residual(solved: DrivenOscillators) -> tuple[Floats, Floats]:
    """(N,) the maximum |x''| and the maximum |y| of the free vibration that the drive leaves."""
    y, y1 = solved.final
    swing = solved.oscillator
    a = _acceleration(swing, y, y1)
    # x'' of a free vibration is one itself.
    return swing.free_peak(a, -swing.frequency * (2 * swing.damping * a + swing.frequency * y1)), swing.free_peak(y, y1)


def _primary(solved: DrivenOscillators) -> Floats:
    """(N,) the maximum |x''| while the drive lasts."""
    oscillator = solved.oscillator
    cell, tau = solved.places()

    def quantity(who: Which, cell: NDArray[np.intp], tau: Floats) -> tuple[Floats, Floats]:
        y, y1, g = solved.values(who, cell, tau)
        a = _acceleration(oscillator, y, y1, who)
        return a, _acceleration(oscillator, y1, g + a, who)

    a, slope = quantity(ALL_OSCILLATORS, cell, tau)
    size = np.abs(a)
    top = size.max(axis=1)
    beside = np.maximum(size[:, 1:], size[:, :-1]) >= NEAR_MAXIMUM_SHARE * top[:, None]
    who, left = np.nonzero((slope[:, :-1] * slope[:, 1:] < 0) & (cell[1:] == cell[:-1]) & beside)
    at = roots(lambda tau: quantity(who, cell[left], tau)[1], tau[left], tau[left + 1])
    np.maximum.at(top, who, np.abs(quantity(who, cell[left], at)[0]))
    return top
