"""Paper: scales, a pencil, ruler and compass on arrays, and ink.  Knows nothing of cams.

Points of the paper are complex numbers x + iy in millimetres, x to the right and y up, in arrays of any shape; so a
step along the paper is an addition and a turn is a multiplication.
"""
