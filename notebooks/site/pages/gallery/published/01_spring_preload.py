"""The preload that keeps a follower on its cam

Source: I. Voloder, M. Cohodar, S. Karic, Annals of DAAAM (2007). Its angular velocity is rounded to 57.5958 rad/s.
"""

from math import degrees, radians

import graphcam as gc

angle = radians(45)
rise, back = gc.Rise(30, angle, "cosine"), gc.Return(30, angle, "cosine")
motion = gc.Motion([rise, gc.Dwell(angle), back, gc.Dwell(5 * angle)])
preload, phi = gc.spring_preload(motion, mass=0.2, speed_rpm=550, stiffness=3)
print(f"preload {preload:.4f} N, needed at {degrees(phi):.0f} degrees")
printed = 69.2292
assert abs(preload - printed) < 0.0005
