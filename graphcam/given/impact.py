"""The kind of impact of a motion: where its velocity or its acceleration jumps.

A jump of the velocity would need an infinite force, a rigid impact; a jump of the acceleration is a jump of the force,
a soft impact.  Source: J. E. Shigley, *Theory of Machines* (1961), chapter 6.
"""

import math
from dataclasses import dataclass

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.motion import Dwell, Motion, Phase
from graphcam.words import say

NO_FORCE = say("at a jump the acceleration is infinite, and with it every force: give the law blends")
"""What to do where a force is asked for."""
JUMP_ROUNDING = 1e-9
"""A jump of less, as a fraction of lift over angle (squared for the acceleration), is rounding."""


@dataclass(frozen=True)
class Jump:
    """A jump of the motion: cam angle [rad], and the values before and after."""

    phi: float
    before: float
    after: float

    @property
    def size(self) -> float:
        """The value after the jump less the value before."""
        return self.after - self.before


def velocity_jumps(motion: Motion) -> list[Jump]:
    """The rigid impacts: where v jumps [mm/rad], as it does at the ends of a uniform velocity.

    >>> from math import pi
    >>> import graphcam as gc
    >>> velocity_jumps(gc.Motion([gc.Rise(30, pi, "rectangular"), gc.Return(30, pi, "2-3")]))
    []
    >>> uniform = gc.constant_velocity_law(0, 0.25)
    >>> velocity_jumps(gc.Motion([gc.Rise(30, pi, uniform), gc.Return(30, pi, "2-3")]))
    [Jump(phi=0.0, before=0.0, after=10.91...)]
    """
    return _jumps(motion, derivative=1)


def acceleration_jumps(motion: Motion) -> list[Jump]:
    """The soft impacts: where a jumps [mm/rad^2].

    >>> from math import pi
    >>> import graphcam as gc
    >>> jumps = acceleration_jumps(gc.Motion([gc.Rise(30, 2, "cosine"), gc.Return(30, 2 * pi - 2, "3-4-5")]))
    >>> [(jump.phi, round(jump.size, 3)) for jump in jumps]
    [(0.0, 37.011), (2.0, 37.011)]
    """
    return _jumps(motion, derivative=2)


def _jumps(motion: Motion, derivative: int) -> list[Jump]:
    """The jumps of a derivative, seen from inside the phases: as a cam angle a break is rounded."""
    inner = [() if isinstance(phase, Dwell) else phase.normalised.breaks for phase in motion.phases]
    phase = np.repeat(np.arange(len(inner)), [1 + len(breaks) for breaks in inner])
    u = np.concatenate([(0.0, *breaks) for breaks in inner])
    starts, phi = u == 0, motion.angle_at(phase, u)
    # A velocity that jumps is seen from beyond the blend by which it is computed.
    low, high = np.array([_seen_from(phase) for phase in motion.phases]).T
    earlier = np.where(starts, phase - 1, phase) % len(inner)
    before = motion.at(earlier, np.where(starts, high[earlier], u), "left")[derivative]
    after = motion.at(phase, np.where(starts, low[phase], u))[derivative]
    scale = max(phase.lift / phase.angle**derivative for phase in motion.phases)
    jumped = np.abs(after - before) > JUMP_ROUNDING * scale
    columns = (column[jumped].tolist() for column in (phi, before, after))
    return [Jump(*row) for row in zip(*columns, strict=True)]


def _seen_from(phase: Phase) -> tuple[float, float]:
    """The fractions of a phase from which its ends are seen."""
    if isinstance(phase, Dwell):
        return 0.0, 1.0
    law = phase.normalised
    first, last = law.velocity_jumps
    return law.steady[0] if first else 0.0, law.steady[1] if last else 1.0


def check_finite_acceleration(motion: Motion) -> None:
    """Refuse to tell forces of a motion whose velocity jumps.

    Raises
    ------
    DesignError : it does
    """
    if jumps := velocity_jumps(motion):
        found = say("one whose velocity jumps at {phi:.6g} degrees", phi=math.degrees(jumps[0].phi))
        raise DesignError("motion", found, say("one with a continuous velocity for forces"), NO_FORCE)
