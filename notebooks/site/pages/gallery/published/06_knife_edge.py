"""Velocity and acceleration of a knife-edge follower

Source: a solved problem: lift 30 mm, constant acceleration over 120 degrees, dwell 30, harmonic return over 90, 800 rpm.
"""

import numpy as np

import graphcam as gc

rise, dwell, back, rest = np.radians([120, 30, 90, 120])
motion = gc.Motion([gc.Rise(30, rise, "rectangular"), gc.Dwell(dwell), gc.Return(30, back, "cosine"), gc.Dwell(rest)])
omega, u = 800 * np.pi / 30, np.linspace(0, 1, 1001)
ways = [motion.at(phase, u) for phase in (0, 2)]
velocity = [np.abs(way.v).max() * omega / 1000 for way in ways]
acceleration = [np.abs(way.a).max() * omega**2 / 1000 for way in ways]
print("rise and return: {:.3f}, {:.3f} m/s and {:.1f}, {:.1f} m/s²".format(*velocity, *acceleration))
known = [2.400, 2.513], [192.0, 421.1]
assert np.abs(np.subtract(velocity, known[0])).max() < 0.0005
assert np.abs(np.subtract(acceleration, known[1])).max() < 0.05
