"""Bands of displacement, velocity and acceleration of cams as they are made, and which error brings how much.

To the first order every error lifts the follower by its size times a function of the cam angle (see ``lifted`` of
:mod:`~graphcam.mechanism.kinematics`): a wave A cos(n phi + beta) of the profile by

    g A cos(n phi + beta),    g = 1/cos(alpha) of a follower that slides,

and its first two derivatives by phi contain n and n^2: a wave that lifts the follower by a micrometre at n = 30 adds 30
micrometres per radian to the velocity and 900 micrometres per radian^2 to the acceleration.  That is why a profile that
is good enough in position may knock at speed.  Independent errors add as the squares: the variance of the whole is the
sum of the variances.

That is compared with a sample of mechanisms, each of which is solved: where its follower touches its wavy profile
(:mod:`~graphcam.mechanism.made_cam`).

Sources: R. L. Norton, *Cam Design and Manufacturing Handbook* (2009), chapter 13, for errors of cam profiles; JCGM
100:2008, *Guide to the expression of uncertainty in measurement*, section 5.1, for the propagation.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError, check_kind
from graphcam.given.laws import Floats
from graphcam.given.making_errors import TOLERANCED_SIZES, MakingErrors, deviations_within, wave_name
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.kinematics import Kinematics, Values
from graphcam.mechanism.made_cam import MadeCam, lifts_by_error
from graphcam.mechanism.turn_extremes import Places, ValueAt, smooth_pieces, turn_maximum, zero_angles
from graphcam.showing import Plottable, value_text
from graphcam.words import say

SAMPLE_SIZE = 2000
"""Mechanisms of a sample."""
COVERAGE = 0.95
"""The part of all mechanisms that a band holds."""
TURN_PLACES, MIN_PIECE_PLACES = 180, 4
"""Cam angles of a band over the turn, and on a smooth piece of the motion at least."""
BATCH_SIZE = 2**16
"""Contacts that are solved at a time, or those at one cam angle if they are more: some tens of megabytes."""
MAX_WAVE_SHARE = 0.5
"""Waves are refused that reach so great a part of what makes a cusp: nearer to one the first order says little."""
ERROR_SIZES: dict[str, tuple[str, float]] = {"roller_diameter": ("roller_radius", 0.5)}
"""What a tolerance is an error of, where that has another name, and how much of it."""


class Share(NamedTuple):
    """What one error does where the bands are widest.

    reach : mm, how far it may be off: an amplitude, or half a tolerance zone
    effects : (3,) by how much it moves s, v and a there at the most;  shares : (3,) its parts of their variances
    """

    name: str
    reach: float
    effects: Floats
    shares: Floats


class MotionSample(NamedTuple):
    """A sample of mechanisms that were solved, (3, n) each, as differences from the nominal s, v, a.

    deviation : standard deviation;  low, high : lower and upper end of the band
    """

    deviation: Floats
    low: Floats
    high: Floats

    @property
    def half_width(self) -> Floats:
        """The half-width of the band of a sample."""
        return (self.high - self.low) / 2


@dataclass(frozen=True, eq=False, repr=False)
class MotionBands(Plottable):
    """How far s, v and a may be off over the turn, of cams and followers as they are made.

    The first axis of all arrays is s, v, a: mm, mm/rad, mm/rad^2, or of an arm rad, rad/rad, rad/rad^2.

    phi : (n,) cam angles [rad]
    coverage : the part of all mechanisms that lies within the bands at each cam angle
    samples, seed : of :attr:`sample`, which is solved when it is first asked for
    """

    _drawn_in = "motion_curves.plot_bands"

    cam: Cam
    errors: MakingErrors
    phi: Floats
    coverage: float = COVERAGE
    samples: int = SAMPLE_SIZE
    seed: int = 0

    def __repr__(self) -> str:
        rows = [
            f"{share.name} ±{1e3 * share.reach:.4g} µm: "
            + ", ".join(f"{part:.0%} of {symbol}" for symbol, part in zip("sva", share.shares.tolist(), strict=True))
            for share in self.table()
        ]
        last = (
            ".half_width to the first order, .sample of mechanisms that are solved, .table(); .plot() draws the bands"
        )
        return value_text(f"MotionBands, which hold {self.coverage:g} of all cams", rows, last)

    @cached_property
    def nominal(self) -> Floats:
        """(3, n) s, v and a as they are designed."""
        return np.array(self.cam.motion(self.phi)[:3])

    @cached_property
    def effects(self) -> Mapping[str, Floats]:
        """The maximum effects (3, n) of each error on s, v and a, to the first order."""
        return self._effects_at(self.cam.motion(self.phi))

    @cached_property
    def deviation(self) -> Floats:
        """(3, n) standard deviations to the first order: the root of the sum of squares."""
        return np.sqrt(variance_of(self.effects, self.errors))

    @cached_property
    def worst(self) -> Floats:
        """(3, n) all errors at their ends at once, which no mechanism exceeds to the first order."""
        return np.sum(list(self.effects.values()), axis=0)

    @cached_property
    def half_width(self) -> Floats:
        """(3, n) of the bands to the first order: that of a normal distribution, but never beyond the worst case.

        A sum of several errors is nearly normal.  A single wave of random phase is not: it never lies beyond its
        amplitude, and where it dominates this is too wide, by up to two fifths.  :attr:`sample` is free of this.
        """
        return half_widths(self.effects, self.errors, self.coverage)

    @property
    def shares(self) -> Mapping[str, Floats]:
        """The shares (3, n) of each error in the variance; 0 where nothing is off."""
        return shares_of(self.effects, self.errors)

    @cached_property
    def widest(self) -> tuple[ValueAt, ValueAt, ValueAt]:
        """The maximum half-widths of the bands of s, v and a to the first order, to full precision, and where.

        At a jump of the acceleration a band is often widest just beside it, where no sample is taken.
        """
        s, v, a = (self._widest(k) for k in range(3))
        return s, v, a

    def _widest(self, k: int) -> ValueAt:
        def both(places: Places) -> tuple[Floats, Floats]:
            normal, worst = _normal_and_worst(self._effects_at(places.values), self.errors, self.coverage)
            return normal[k], worst[k]

        # Where one of two takes over from the other, the band has a corner.
        several = len(self.errors.reaches) > 1
        corners = zero_angles(self.cam.motion, lambda places: np.subtract(*both(places))) if several else []
        return turn_maximum(self.cam.motion, lambda places: np.minimum(*both(places)), list(corners))

    def _effects_at(self, values: Values) -> dict[str, Floats]:
        return effects_of(self.cam.kinematics, self.errors, values)

    def table(self) -> list[Share]:
        """What each error does where the bands are widest; the one that matters most for s first."""
        at_widest = [self._effects_at(self.cam.motion(phi, side)) for _, phi, side in self.widest]
        shares = [shares_of(effects, self.errors) for effects in at_widest]
        found = [
            Share(name, reach, *(np.array([each[name][k] for k, each in enumerate(by)]) for by in (at_widest, shares)))
            for name, reach in self.errors.reaches.items()
        ]
        return sorted(found, key=lambda share: -share.shares[0])

    @cached_property
    def sample(self) -> MotionSample:
        """The motions of a sample of mechanisms, each of which is solved, not taken to the first order.

        Raises
        ------
        DesignError : a mechanism of the sample loses its contact
        """
        made, nominal = MadeCam(self.cam, self.errors.sample(self.samples, self.seed)), self.nominal
        ends = (1 - self.coverage) / 2, (1 + self.coverage) / 2
        found = MotionSample(*(np.empty_like(nominal) for _ in range(3)))
        for here in _batches(self.phi.size, self.samples):
            off = np.array(made(self.phi[here])) - nominal[:, None, here]
            if np.isnan(off).any():
                remedy = say("take smaller tolerances, or a larger prime radius")
                shown = say("too wide")
                raise DesignError("tolerances", shown, say("such that every follower reaches its cam"), remedy)
            found.deviation[:, here] = off.std(axis=1)
            found.low[:, here], found.high[:, here] = np.quantile(off, ends, axis=1)
        return found


def motion_bands(
    cam: Cam,
    errors: MakingErrors,
    phi: ArrayLike | None = None,
    *,
    coverage: float = COVERAGE,
    samples: int = SAMPLE_SIZE,
    seed: int = 0,
) -> MotionBands:
    """The bands of s, v and a of a cam and its follower as they are made: to the first order, and of a sample.

    phi : (n,) cam angles [rad]; None takes about :data:`TURN_PLACES`, none of them at a jump of the acceleration, which
        on every cam that is made lies elsewhere
    coverage : the part of all mechanisms that a band holds at each cam angle;  samples, seed : of the sample, 2 or more

    Raises
    ------
    DesignError : an error of a size that the follower does not have, too few samples, a coverage not between 0 and 1,
        an undercut profile, or waves with hollows that the follower bridges

    >>> import graphcam as gc
    >>> from math import pi
    >>> motion = gc.Motion([gc.Rise(10, pi, "cycloidal"), gc.Return(10, pi, "cycloidal")])
    >>> cam = gc.Cam(motion, gc.Translating(roller_radius=8), prime_radius=30)
    >>> bands = gc.motion_bands(cam, gc.MakingErrors((0.002,), (30,), roller_diameter=0.04, offset=0.1))
    >>> bands
    MotionBands, which hold 0.95 of all cams
      roller_diameter ±20 µm: 50% of s, 0% of v, 0% of a
      offset ±50 µm: 41% of s, 1% of v, 0% of a
      waviness 30 ±2 µm: 9% of s, 99% of v, 100% of a
    .half_width to the first order, .sample of mechanisms that are solved, .table(); .plot() draws the bands
    >>> (1e3 * bands.half_width.max(axis=1)).round(1).tolist()  # micrometres, per radian, per radian^2
    [9.4, 70.3, 1849.4]
    >>> (1e3 * bands.sample.half_width.max(axis=1)).round(1).tolist()
    [9.8, 62.0, 1825.7]
    """
    deviations_within(coverage)  # says at once what is wrong
    check_kind("cam", cam, Cam)
    check_kind("errors", errors, MakingErrors)
    check_errors(cam, errors)
    places = band_places(cam) if phi is None else np.atleast_1d(np.asarray(phi, dtype=np.float64))
    errors.sample(2, seed)
    if samples < 2:
        raise DesignError("samples", samples, say("2 or more"))
    return MotionBands(cam, errors, places, coverage, samples, seed)


def effects_of(kin: Kinematics, errors: MakingErrors, values: Values) -> dict[str, Floats]:
    """The maximum effects (3, ...) of each error on s, v and a, to the first order, from (s, v, a, j).

    A wave reaches its maximum displacement, velocity and acceleration at different phases.
    """
    lifted, found = lifts_by_error(kin, values), dict[str, Floats]()
    waves = {wave_name(n): n for n in errors.harmonics}
    for name, size, reach in _error_reaches(errors):
        by, n = lifted[size], waves.get(name, 0)
        v = np.hypot(by.slope, n * by.value)
        a = np.hypot(by.bend - n * n * by.value, 2 * n * by.slope)
        found[name] = reach * np.array([np.abs(by.value), v, a])
    return found


def variance_of(effects: Mapping[str, Floats], errors: MakingErrors) -> Floats:
    """The variance of independent errors: the sum of their variances."""
    return np.sum([(errors.part(name) * effect) ** 2 for name, effect in effects.items()], axis=0)


def half_widths(effects: Mapping[str, Floats], errors: MakingErrors, coverage: float) -> Floats:
    """The half-widths of the bands to the first order, shaped like the effects of the errors."""
    return np.minimum(*_normal_and_worst(effects, errors, coverage))


def _normal_and_worst(effects: Mapping[str, Floats], errors: MakingErrors, coverage: float) -> tuple[Floats, Floats]:
    """The half-widths of a normal distribution, and with all errors at their ends at once."""
    normal = deviations_within(coverage) * np.sqrt(variance_of(effects, errors))
    return normal, np.sum(list(effects.values()), axis=0)


def shares_of(effects: Mapping[str, Floats], errors: MakingErrors) -> dict[str, Floats]:
    """The share of each error in the variance; 0 where nothing is off."""
    variance = variance_of(effects, errors)
    return {
        name: np.divide((errors.part(name) * by) ** 2, variance, out=np.zeros_like(by), where=variance > 0)
        for name, by in effects.items()
    }


def position_band(kin: Kinematics, errors: MakingErrors, within: float, values: Values) -> Any:
    """The half-width of the band of s to the first order, from (s, v); of many cams at once too.

    within : standard deviations that it holds of a normal distribution, on either side
    """
    lifted = kin.lift_per_error(values)
    scatter = [(reach * errors.part(name), lifted[size]) for name, size, reach in _error_reaches(errors)]
    normal = within * np.sqrt(sum(deviation * deviation * by * by for deviation, by in scatter))
    return np.minimum(normal, sum(reach * np.abs(lifted[size]) for _, size, reach in _error_reaches(errors)))


def position_band_slope(kin: Kinematics, errors: MakingErrors, within: float, values: Values) -> Floats:
    """What has the sign of its derivative by phi."""
    lifted = lifts_by_error(kin, values)
    variance = worst = slope = worst_slope = np.zeros(())
    for name, size, reach in _error_reaches(errors):
        by, scatter = lifted[size], (reach * errors.part(name)) ** 2
        variance, slope = variance + scatter * by.value**2, slope + scatter * by.value * by.slope
        worst, worst_slope = worst + reach * np.abs(by.value), worst_slope + reach * np.sign(by.value) * by.slope
    return np.where(within * np.sqrt(variance) <= worst, slope, worst_slope)


def _error_reaches(errors: MakingErrors) -> Iterator[tuple[str, str, float]]:
    """Every error with the name of what it lifts the follower by, and how far that may be off [mm]."""
    for name, reach in errors.reaches.items():
        size, part = ERROR_SIZES.get(name, (name, 1.0)) if name in TOLERANCED_SIZES else ("profile", 1.0)
        yield name, size, reach * part


def check_errors(cam: Cam, errors: MakingErrors) -> None:
    """Refuse tolerances of sizes that a follower does not have, and waves that it cannot follow.

    A roller of the radius r bridges the hollows of waves where r (amplitude n^2) reaches L M, the product of how fast
    pitch curve and profile run on [mm/rad], and a face where amplitude n^2 reaches rho.  Half of it is let pass.

    Raises
    ------
    DesignError : there is one
    """
    check_sizes(cam.kinematics, errors)
    roller, kin = cam.roller_radius, cam.kinematics
    if errors.roller_diameter and not roller > 0:
        remedy = say("or give the follower a roller")
        limit = say("left out: a knife edge has no roller")
        raise DesignError("roller_diameter", errors.roller_diameter, limit, remedy)
    least = cam.extremes().min_convex_radius[0]
    if not least > roller:
        limit = say("sound for its errors to be found")
        raise DesignError("profile", say("undercut"), limit, say("enlarge the prime radius"))
    waves = [a * n * n for a, n in zip(errors.waviness, errors.harmonics, strict=True)]
    values = cam.motion(band_places(cam))
    room = kin.speed(values, roller)
    if kin.takes_roller:  # a knife edge reaches into every hollow
        room = room * kin.speed(values, 0.0) / roller if roller else np.inf
    if sum(waves) >= (room := MAX_WAVE_SHARE * float(np.min(room))):
        k = int(np.argmax(waves))
        n = errors.harmonics[k]
        why = say("a face would bridge the hollows of deep ones")
        if roller:
            why = say("a roller would bridge the hollows of deep ones")
        limit = say("less than {value:.3g} mm at {n} waves per turn: {why}", value=room / n**2, n=n, why=why)
        raise DesignError(f"waviness[{k}]", errors.waviness[k], limit, say("take smaller amplitudes or fewer waves"))


def check_sizes(kin: Kinematics, errors: MakingErrors) -> None:
    """Refuse tolerances of sizes that a follower does not have.

    Raises
    ------
    DesignError : there is one
    """
    still = np.zeros(())
    own = kin.lift_per_error((still, still, still, still))
    for name in TOLERANCED_SIZES:
        tolerance = getattr(errors, name)
        if tolerance and ERROR_SIZES.get(name, (name, 1.0))[0] not in own:
            limit = say("left out: this follower has no such size")
            raise DesignError(name, tolerance, limit, say("give those that it has"))


def band_places(cam: Cam) -> Floats:
    """(n,) cam angles [rad] in the middles of parts of the smooth pieces, so that none lies at a jump."""
    phase, low, high = smooth_pieces(cam.motion)
    angles = (high - low) * cam.motion.angles[phase]
    found: list[Floats] = []
    for k, begin, angle in zip(phase, low, angles, strict=True):
        parts = max(MIN_PIECE_PLACES, round(TURN_PLACES * angle / angles.sum()))
        found.append(cam.motion.angle_at(k, begin) + angle * (np.arange(parts) + 0.5) / parts)
    return np.concatenate(found)


def _batches(places: int, samples: int) -> Iterator[slice]:
    step = max(1, BATCH_SIZE // samples)
    for k in range(0, places, step):
        yield slice(k, k + step)
