"""What the analogues mean at a speed: phase times, velocities in m/s, accelerations in m/s^2."""

from dataclasses import dataclass

from graphcam.given.follower import MM_PER_M, omega_of
from graphcam.given.motion import Motion, MovingPhase

UNITS_PER_SPEED = {"mm": MM_PER_M, "rad": 1.0}
"""How many units of the lift make the one in which speeds are told: a metre, or for an arm a radian."""


@dataclass(frozen=True)
class PhaseAtSpeed:
    """One phase: its time [s], and its greatest velocity and acceleration, 0 in a dwell [m/s, m/s^2; an arm: rad/s]."""

    time: float
    max_velocity: float
    max_acceleration: float

    @property
    def greatest(self) -> tuple[float, float]:
        """The greatest velocity and acceleration."""
        return self.max_velocity, self.max_acceleration


def at_speed(motion: Motion, speed_rpm: float, unit: str = "mm") -> list[PhaseAtSpeed]:
    """The phases of a motion at a speed of the cam [rpm]: t = F/omega, v = C_v h omega/F, a = C_a h (omega/F)^2.

    unit : of the lift, "mm" or "rad"

    Source: a solved textbook problem, roller follower, harmonic, lift 50, 120/30/60 degrees, 100 rpm: 0.39 and 0.785
    m/s, 6.17 and 24.67 m/s^2.

    >>> from math import radians
    >>> import graphcam as gc
    >>> rise, back = gc.Rise(50, radians(120), "cosine"), gc.Return(50, radians(60), "cosine")
    >>> motion = gc.Motion([rise, gc.Dwell(radians(30)), back, gc.Dwell(radians(150))])
    >>> [round(phase.max_acceleration, 2) for phase in at_speed(motion, 100)]
    [6.17, 0.0, 24.67, 0.0]
    """
    per_speed = UNITS_PER_SPEED[unit]
    omega = omega_of(speed_rpm)
    phases: list[PhaseAtSpeed] = []
    for phase in motion.phases:
        velocity = acceleration = 0.0
        if isinstance(phase, MovingPhase):
            velocity = phase.normalised.peak_velocity * phase.lift * omega / phase.angle / per_speed
            acceleration = phase.normalised.peak_acceleration * phase.lift * (omega / phase.angle) ** 2 / per_speed
        phases.append(PhaseAtSpeed(phase.angle / omega, velocity, acceleration))
    return phases
