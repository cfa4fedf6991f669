"""The kind of impact of a motion: where its velocity or its acceleration jumps.

A jump of the velocity would need an infinite force, a rigid impact; a jump of the acceleration is a jump of the force,
a soft impact.  Source: J. E. Shigley, *Theory of Machines* (1961), chapter 6.
"""

from dataclasses import dataclass

import numpy as np

from graphcam.given.motion import Dwell, Motion

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
    """The rigid impacts: where v jumps [mm/rad].

    >>> from math import pi
    >>> import graphcam as gc
    >>> velocity_jumps(gc.Motion([gc.Rise(30, pi, "rectangular"), gc.Return(30, pi, "2-3")]))
    []
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
    starts = u == 0
    before = motion.at(np.where(starts, phase - 1, phase) % len(inner), np.where(starts, 1.0, u), "left")[derivative]
    after, phi = motion.at(phase, u)[derivative], motion.angle_at(phase, u)
    scale = max(phase.lift / phase.angle**derivative for phase in motion.phases)
    jumped = np.abs(after - before) > JUMP_ROUNDING * scale
    columns = (column[jumped].tolist() for column in (phi, before, after))
    return [Jump(*row) for row in zip(*columns, strict=True)]
