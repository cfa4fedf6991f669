"""The minimum prime radius, by four laws of motion

Source: the assignment of the built-in coursework task: lift 30, offset 10 mm on the favourable side, phases 80, 45, 60 and
175 degrees, 30 degrees permitted.
"""

from math import radians

import graphcam as gc

laws = gc.law("rectangular"), gc.law("cosine"), gc.law("cycloidal"), gc.law("3-4-5")
known = (43.28, 102.05), (29.76, 82.30), (44.47, 102.96), (40.13, 96.93)
for law, radii in zip(laws, known, strict=True):
    rise, back = gc.Rise(30, radians(80), law), gc.Return(30, radians(60), law)
    motion = gc.Motion([rise, gc.Dwell(radians(45)), back, gc.Dwell(radians(175))])
    for back_limit, radius in zip((None, radians(30)), radii, strict=True):
        found = gc.minimum_radius(motion, gc.Translating(), "cw", radians(30), back_limit, offset=-10)
        closure = "force" if back_limit is None else "form"
        print(f"{law.name}, {closure}-closed: {found.prime_radius:.2f} mm")
        assert abs(found.prime_radius - radius) < 0.005
