"""How well a hand drew: the radii of an arm's cam

Source: a coursework table: radii r0 + s at eighths of a cosine rise over 115 degrees, read off a drawing; prime radius 20,
lift along the arc 32 mm.
"""

import numpy as np

import graphcam as gc

rise, dwell, back, rest = np.radians([115, 20, 140, 85])
motion = gc.Motion([gc.Rise(32, rise, "cosine"), gc.Dwell(dwell), gc.Return(32, back, "2-3"), gc.Dwell(rest)])
exact = 20 + motion.at(0, np.linspace(0, 1, 9)).s
drawn = [20, 21.24, 24.7, 29.89, 36, 42.11, 47.3, 50.76, 52]
print("drawn - exact, mm:", np.subtract(drawn, exact).round(3))
assert np.abs(drawn - exact).max() <= 0.03
