"""The pressure angle of an offset roller follower

Source: a lecture script: lift 50, prime radius 45, offset 10 on the favourable side, roller 6 mm, phases 120, 90, 90 and 60
degrees, cosine rise, constant acceleration on the return.
"""

import numpy as np

import graphcam as gc

rise, dwell, back, rest = np.radians([120, 90, 90, 60])
motion = gc.Motion([gc.Rise(50, rise, "cosine"), gc.Dwell(dwell), gc.Return(50, back, "rectangular"), gc.Dwell(rest)])
sides = [gc.Cam(motion, gc.Translating(10, 6), 45, rotation).extremes() for rotation in ("ccw", "cw")]
right, wrong = (np.degrees(found.pressure_angle_rise) for found in sides)
print(f"rise: {right[0]:.2f} degrees at {right[1]:.1f}; with the offset on the wrong side {wrong[0]:.2f} degrees")
known = 22.79, 49.6, 37.04
assert np.abs(np.subtract([*right, wrong[0]], known)).max() < 0.05
