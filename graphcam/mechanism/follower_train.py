"""An elastic follower on a cam that turns steadily: how its end moves, and what presses it on the cam.

The train between cam and mass (roller, stem, rocker) has the stiffness k and the damping c, its mass m lies at its end,
where a return spring of the stiffness c_s presses it back.  With the lift s of the cam, the way x of the mass from its
place in the lowest dwell, and the spring's force F0 there, in time:

    m x'' + c (x' - s') + k (x - s) + c_s x = 0
    N = F0 + k (s - x) + c (s' - x') = F0 + c_s x + m x''

N presses the follower on the cam; where it would be negative the follower leaves it, and from there on this motion does
not hold.  The train cannot hold the spring by itself: of the lift the part c_s/(k + c_s) is lost at rest.  As k grows
x comes to s and N to the contact function of a rigid follower, m s'' + F0 + c_s s (:mod:`~graphcam.mechanism.contact`).

Sources: R. L. Norton, *Cam Design and Manufacturing Handbook* (2009), on dynamics of cam systems: the model of one mass
with a return spring, follower jump; H. A. Rothbart (ed.), *Cam Design Handbook* (2004), on modelling them.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphcam.errors import DesignError, check_number
from graphcam.former_names import renamed
from graphcam.given.follower import MM_PER_M, omega_of
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, wrap
from graphcam.given.root_finding import roots
from graphcam.mechanism.oscillator import Drive, DrivenOscillators, Oscillator, check_damping, steady
from graphcam.mechanism.shock_response import AnyMotion, turn_edges
from graphcam.mechanism.turn_extremes import VALUE_ROUNDING, Interval, ValueAt
from graphcam.showing import Plottable, value_text
from graphcam.words import say

MAX_VIBRATIONS = 10_000.0
"""Natural vibrations in a turn; beyond, the follower moves as a rigid one."""


@dataclass(frozen=True)
class FollowerTrain:
    """The elastic train of a translating follower, reduced to one mass at its end, and its return spring.

    mass : m of all that moves, reduced to the follower's motion [kg];  stiffness : k of the train [N/mm]
    damping : ratio c/c_critical, as a free vibration in a dwell shows it; 0.02 to 0.1 is usual
    spring : c_s, stiffness of the return spring [N/mm];  preload : F0, its force in the lowest position [N], with any
        constant load

    Raises
    ------
    DesignError : a value is impossible

    >>> import graphcam as gc
    >>> train = gc.FollowerTrain(mass=0.5, stiffness=2000, damping=0.05, spring=20, preload=200)
    >>> round(train.natural_frequency, 2)
    319.9
    >>> round(train.rise_ratio(angle=math.radians(80), speed_rpm=1200), 3)
    3.554
    """

    mass: float
    stiffness: float
    damping: float = 0.0
    spring: float = 0.0
    preload: float = 0.0

    def __post_init__(self) -> None:
        for quantity, unit in (("mass", "kg"), ("stiffness", "N/mm")):
            remedy = say("a rigid follower is gc.Contact") if quantity == "stiffness" else ""
            limit = say("a finite number greater than 0 {unit}", unit=unit)
            check_number(quantity, getattr(self, quantity), limit, remedy, above=0)
        check_damping(self.damping)
        check_number("spring", self.spring, say("a finite number of 0 N/mm or more"), least=0)
        check_number("preload", self.preload, say("a finite number of N"))

    @property
    def angular_frequency(self) -> float:
        """The angular frequency of the free, undamped vibration while the follower keeps to the cam [rad/s]."""
        return math.sqrt((self.stiffness + self.spring) * MM_PER_M / self.mass)

    @property
    def natural_frequency(self) -> float:
        """The natural frequency [Hz]."""
        return self.angular_frequency / math.tau

    @property
    def share(self) -> float:
        """k/(k + c_s): the part of the lift that arrives at the mass at rest."""
        return self.stiffness / (self.stiffness + self.spring)

    @property
    def damper(self) -> float:
        """The damping coefficient c [N s/mm]."""
        return 2 * self.damping * self.angular_frequency * self.mass / MM_PER_M

    def rise_ratio(self, angle: float, speed_rpm: float) -> float:
        """n, the time of a rise over an angle [rad] at a speed [rpm] over the natural period.

        Raises
        ------
        DesignError : angle or speed is not positive
        """
        check_number("angle", angle, say("a finite number greater than 0 rad"), above=0)
        return angle / omega_of(_angular_velocity(speed_rpm)) * self.natural_frequency


@dataclass(frozen=True, eq=False)
class TrainMotion:
    """The motion of the mass at cam angles; every array is shaped like them, derivatives are by the cam angle.

    phi : rad;  x, v, a : way of the mass [mm], [mm/rad], [mm/rad^2]
    deviation : x less what arrives of the lift at rest, k s/(k + c_s) [mm]
    force : N, on the cam [N]; negative where the cam would have to pull
    """

    phi: Floats
    x: Floats
    v: Floats
    a: Floats
    deviation: Floats
    force: Floats


@renamed(least_force="min_force", greatest_force="max_force")
@dataclass(frozen=True, eq=False, repr=False)
class VibratingFollower(Plottable):
    """The steady motion of an elastic follower on a cam that turns at one speed; call it with cam angles [rad].

    Its values are those of a follower that keeps to the cam: see :meth:`lost` before you trust them.

    Parameters
    ----------
    motion : the cam's, of a translating follower
    train : the follower's train
    speed_rpm : of the cam [rpm]

    Raises
    ------
    DesignError : the speed is not positive; without damping a natural vibration fits the turn a whole number of times,
        so that there is no steady motion; or the train is so stiff at this speed that nothing vibrates

    >>> from math import degrees
    >>> import graphcam as gc
    >>> motion = gc.builtin_task().motion()
    >>> train = gc.FollowerTrain(mass=0.5, stiffness=2000, damping=0.05, spring=20, preload=200)
    >>> follower = gc.VibratingFollower(motion, train, speed_rpm=600)
    >>> least = follower.min_force()
    >>> round(least.value, 2), round(degrees(least.phi), 2), round(follower.least_preload(), 2)
    (-106.76, 189.46, 306.76)
    >>> [[round(degrees(phi), 2) for phi in interval] for interval in follower.lost()]
    [[187.94, 191.02], [199.9, 201.57]]
    >>> follower([0.0, 0.7]).x.round(4).tolist()
    [0.001, 14.8542]
    """

    _drawn_in = "response_curves.plot"

    motion: AnyMotion
    train: FollowerTrain
    speed_rpm: float

    def __post_init__(self) -> None:
        _angular_velocity(self.speed_rpm)
        if self.vibrations > MAX_VIBRATIONS:
            limit = say("so high that at most {most:g} natural vibrations fit into a turn", most=MAX_VIBRATIONS)
            raise DesignError("speed_rpm", self.speed_rpm, limit, say("a rigid follower is gc.Contact"))
        _ = self._solution

    @property
    def vibrations(self) -> float:
        """Natural vibrations in a turn."""
        return self.train.angular_frequency / omega_of(self.speed_rpm)

    def __call__(self, phi: ArrayLike) -> TrainMotion:
        """The motion of the mass, and the force on the cam, at cam angles phi [rad], any real numbers."""
        phi = np.asarray(phi, dtype=np.float64)
        turned = wrap(phi.ravel())
        (y,), (y1,) = self._solution.at(np.where(np.isnan(turned), 0.0, turned))
        s, v, *_ = self.motion(turned)
        share = self.train.share
        x, x1, x2 = share * s + y, share * v + y1, self._acceleration(v, y, y1)
        force = self.train.preload + self._load(s, v, y, y1)
        unknown = 0.0 * turned  # NaN stays NaN
        return TrainMotion(phi, *((each + unknown).reshape(phi.shape) for each in (x, x1, x2, y, force)))

    def min_force(self) -> ValueAt:
        """The minimum N of the turn [N]; of equal ones the first."""
        return self._first_extreme(np.argmin)

    def max_force(self) -> ValueAt:
        """The maximum N of the turn [N]; of equal ones the first."""
        return self._first_extreme(np.argmax)

    def least_preload(self) -> float:
        """The minimum preload [N] with which the follower keeps to the cam at this speed."""
        return self.train.preload - self.min_force().value

    def lost(self) -> list[Interval]:
        """The intervals of phi [rad] in which the cam would have to pull, in order; empty where contact is kept.

        An end beyond 2 pi lies in the next turn.  Where the first one begins the follower leaves the cam; what it does
        then, and where it comes down, is another motion.
        """
        phi, force = self._stationary
        slack = VALUE_ROUNDING * float(np.abs(force).max())
        negative = force < -slack
        negative[-1] = negative[0]  # the turn is closed
        crossing = negative[:-1] != negative[1:]
        low, high = phi[:-1][crossing], phi[1:][crossing]
        ends = roots(lambda phi: self(phi).force, low, high).tolist()
        if not ends:
            return [Interval(0.0, FULL_TURN)] if negative[0] else []
        if negative[0]:
            ends = [*ends[1:], ends[0] + FULL_TURN]
        return [Interval(*ends) for ends in zip(ends[::2], ends[1::2], strict=True)]

    def __repr__(self) -> str:
        train, least, lost = self.train, self.min_force(), self.lost()
        places = ", ".join(f"{math.degrees(start):.4g}°" for start, _ in lost[:4])
        rows = [
            f"train of {train.mass:g} kg and {train.stiffness:g} N/mm, damping ratio {train.damping:g}",
            f"natural frequency {train.natural_frequency:.4g} Hz, {self.vibrations:.4g} vibrations in a turn",
            f"least force on the cam {least.value:.4g} N at {math.degrees(least.phi):.4g}°",
            f"leaves the cam at {places}" if lost else "keeps contact",
        ]
        last = "follower(phi) gives x, v, a, deviation and force at phi in rad; .plot() draws them"
        return value_text(f"VibratingFollower at {self.speed_rpm:g} rpm", rows, last)

    # --- how it is found ---------------------------------------------------------------------------------------------

    @cached_property
    def _solution(self) -> DrivenOscillators:
        train, nu = self.train, self.vibrations

        def forcing(phi: Floats) -> Floats:
            _, v, a, _ = self.motion(phi)
            return self._damped * v - train.share * a

        drive = Drive(np.append(turn_edges(self.motion), FULL_TURN), forcing)
        found = steady(Oscillator(np.array([nu]), float(train.damping)), drive)
        if found is None:
            limit = say("off resonance: {nu:.9g} natural vibrations fit into a turn, a whole number", nu=nu)
            raise DesignError("speed_rpm", self.speed_rpm, limit, say("give the train damping, or change the speed"))
        return found

    @property
    def _damped(self) -> float:
        """How much of the cam's velocity the damper passes on to y, because the spring keeps x back."""
        return 2 * self.train.damping * self.vibrations * (1 - self.train.share)

    def _acceleration(self, v: Floats, y: Floats, y1: Floats) -> Floats:
        """x'' by the cam angle, by the equation of motion: it does not jump where the cam's acceleration does."""
        nu, train = self.vibrations, self.train
        return nu * (2 * train.damping * ((1 - train.share) * v - y1) - nu * y)

    def _load(self, s: Floats, v: Floats, y: Floats, y1: Floats) -> Floats:
        """N less the preload [N]; of the derivatives of its arguments it is the derivative of N."""
        train, inertia = self.train, self.train.mass * omega_of(self.speed_rpm) ** 2 / MM_PER_M
        return train.spring * (train.share * s + y) + inertia * self._acceleration(v, y, y1)

    @cached_property
    def _stationary(self) -> tuple[Floats, Floats]:
        """Cam angles in order over the turn between which N is monotonous, and N there."""
        solved, train, nu = self._solution, self.train, self.vibrations

        def load_and_slope(cell: NDArray[np.intp], tau: Floats) -> tuple[Floats, Floats, Floats]:
            """The cam angle, N less the preload, and dN/dphi at places of cells."""
            phi = np.minimum(solved.times(cell, tau), FULL_TURN)
            y, y1, g = solved.values(np.zeros(cell.size, dtype=np.intp), cell, tau)
            y2 = g - nu * (2 * train.damping * y1 + nu * y)
            s, v, *_ = self.motion(phi)
            # The cam's acceleration as it is inside of the cell, on this side of a jump.
            a = (self._damped * v - g) / train.share
            return phi, self._load(s, v, y, y1), self._load(v, a, y1, y2)

        cell, tau = solved.places()
        phi, load, slope = load_and_slope(cell, tau)
        (left,) = np.nonzero((slope[:-1] * slope[1:] < 0) & (cell[1:] == cell[:-1]))
        inside = roots(lambda tau: load_and_slope(cell[left], tau)[2], tau[left], tau[left + 1])
        phi_inside, load_inside, _ = load_and_slope(cell[left], inside)
        every, values = np.concatenate([phi, phi_inside]), np.concatenate([load, load_inside])
        order = np.argsort(every, kind="stable")
        return every[order], values[order] + train.preload

    def _first_extreme(self, best: Callable[[Floats], np.intp]) -> ValueAt:
        phi, force = self._stationary
        as_good = np.abs(force - force[best(force)]) <= VALUE_ROUNDING * np.abs(force).max()
        k = int(np.flatnonzero(as_good)[0])
        return ValueAt(float(force[k]), float(phi[k]), "right")


def _angular_velocity(speed_rpm: float) -> float:
    check_number("speed_rpm", speed_rpm, say("a finite number greater than 0 rpm"), above=0)
    return speed_rpm
