"""Velocity and acceleration of a valve

Source: a solved problem: roller follower, harmonic motion, lift 50 mm, phases 120, 30 and 60 degrees, 100 rpm.
"""

import numpy as np

import graphcam as gc

rise, dwell, back, rest = np.radians([120, 30, 60, 150])
motion = gc.Motion([gc.Rise(50, rise, "cosine"), gc.Dwell(dwell), gc.Return(50, back, "cosine"), gc.Dwell(rest)])
omega, u = 100 * np.pi / 30, np.linspace(0, 1, 1001)
ways = [motion.at(phase, u) for phase in (0, 2)]
velocity = [np.abs(way.v).max() * omega / 1000 for way in ways]
acceleration = [np.abs(way.a).max() * omega**2 / 1000 for way in ways]
print("rise and return: {:.2f}, {:.3f} m/s and {:.2f}, {:.2f} m/s²".format(*velocity, *acceleration))
printed = [0.39, 0.785], [6.17, 24.67]
assert np.abs(np.subtract(velocity, printed[0])).max() < 0.005
assert np.abs(np.subtract(acceleration, printed[1])).max() < 0.005
