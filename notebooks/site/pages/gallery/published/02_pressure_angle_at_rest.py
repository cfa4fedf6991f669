"""The pressure angle of an offset follower at rest

Source: Tran Minh Quang, Nguyen Quang Hung (2015): base radius 80, offset 20, roller 15 mm.
"""

from math import degrees, radians

import graphcam as gc

sixth = radians(60)
rise, back = gc.Rise(12, 2 * sixth, "cosine"), gc.Return(12, 2 * sixth, "cosine")
motion = gc.Motion([rise, gc.Dwell(sixth), back, gc.Dwell(sixth)])
cam = gc.Cam(motion, gc.Translating(offset=20, roller_radius=15), prime_radius=95, rotation="cw")
angle = degrees(cam.pressure_angle(0))
print(f"pressure angle at rest {angle:.2f} degrees")
printed = 12.15
assert abs(angle - printed) < 0.005
