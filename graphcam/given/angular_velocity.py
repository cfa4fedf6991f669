"""The speed of a cam, and the units in which speeds are told."""

import math

MM_PER_M = 1000.0


def omega_of(speed_rpm: float) -> float:
    """The angular velocity [rad/s] at a speed [rpm].

    >>> round(omega_of(300), 3)
    31.416
    """
    return speed_rpm * math.tau / 60
