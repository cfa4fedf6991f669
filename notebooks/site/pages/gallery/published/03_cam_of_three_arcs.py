"""A cam of three circular arcs

Source: C. Lanni, M. Ceccarelli, G. Figliolini, Mechanism and Machine Theory 37 (2002), example 1. The printed data are
rounded, so the ends of the last arc are off by up to 0.13 mm.
"""

import numpy as np

import graphcam as gc

data = {"D": (51.68, 18.81), "G": (22.24, 37.84), "A": (0, 40), "C1": (35.71, 13.00), "C2": (0, -75.64)}
cam = next(root for root in gc.three_arc_cam(rho1=17, **data) if root.sound)
print(f"F = {cam.F.round(2)}, C3 = {cam.C3.round(2)} mm")
printed = [46.78, 25.91], [11.99, -14.47]
assert np.abs(np.array([cam.F, cam.C3]) - printed).max() < 0.13
