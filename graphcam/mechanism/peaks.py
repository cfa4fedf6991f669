"""The greatest velocity and acceleration of a motion.

Source: R. L. Norton, *Cam Design and Manufacturing Handbook* (2009), chapter 3: v_max = C_v h/F, a_max = C_a h/F^2.
"""

from __future__ import annotations

from graphcam.given.motion import Dwell, Motion


def velocity_range(motion: Motion) -> tuple[float, float]:
    """The least v, on a return, and the greatest, on a rise [mm/rad].

    >>> from math import pi
    >>> import graphcam as gc
    >>> velocity_range(gc.Motion([gc.Rise(30, 2.5, "cycloidal"), gc.Dwell(2 * pi - 4.5), gc.Return(30, 2.0, "2-3")]))
    (-22.5, 24.0)
    """
    moving = [p for p in motion.phases if not isinstance(p, Dwell)]
    peaks = [p.direction * p.normalised.peak_velocity * p.lift / p.angle for p in moving]
    return min(peaks), max(peaks)


def max_velocity(motion: Motion) -> float:
    """The greatest |v| over the turn [mm/rad].

    >>> from math import pi
    >>> import graphcam as gc
    >>> max_velocity(gc.Motion([gc.Rise(30, 2.0, "cycloidal"), gc.Return(30, 2 * pi - 2, "cycloidal")]))
    30.0
    """
    return max(p.normalised.peak_velocity * p.lift / p.angle for p in motion.phases if not isinstance(p, Dwell))


def max_acceleration(motion: Motion) -> float:
    """The greatest |a| over the turn [mm/rad^2], of the two sides at a jump.

    >>> from math import pi
    >>> import graphcam as gc
    >>> max_acceleration(gc.Motion([gc.Rise(30, 2.0, "rectangular"), gc.Return(30, 2 * pi - 2, "rectangular")]))
    30.0
    """
    return max(p.normalised.peak_acceleration * p.lift / p.angle**2 for p in motion.phases if not isinstance(p, Dwell))
