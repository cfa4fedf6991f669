"""A cam of three arcs whose second centre is not given

Source: C. Lanni, M. Ceccarelli, G. Figliolini, Mechanism and Machine Theory 37 (2002), example 2: the centre C2 of the flank
lies on the line of the cam centre and A. The printed data are rounded to 0.01 mm.
"""

import graphcam as gc

cam, other = gc.three_arc_cam(D=(51.68, 18.81), G=(22.24, 37.84), A=(0, 40), C1=(35.71, 13.00), rho1=17)
print(f"C2 = {cam.C2.round(2)} mm; the other root is not sound: {other.why}")
printed = -75.64
assert cam.sound
assert not other.sound
assert abs(cam.C2[1] - printed) < 0.08
