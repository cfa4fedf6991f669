"""An arm, by both senses of rotation

Source: a coursework: swing 15 degrees, arm 125, centre distance 150, prime radius 61 mm, phases 75, 10 and 75 degrees,
constant acceleration.
"""

import numpy as np

import graphcam as gc

swing, rise, dwell, rest = np.radians([15, 75, 10, 200])
law = gc.law("rectangular")
motion = gc.Motion([gc.Rise(swing, rise, law), gc.Dwell(dwell), gc.Return(swing, rise, law), gc.Dwell(rest)])
cams = [gc.Cam(motion, gc.Oscillating(arm=125, distance=150), 61, rotation) for rotation in ("ccw", "cw")]
angles = np.degrees([cam.extremes().pressure_angle_rise.value for cam in cams])
print("opposite senses {:.2f} degrees, the same sense {:.2f} degrees".format(*angles))
known = 31.00, -34.82
assert np.abs(angles - known).max() < 0.005
