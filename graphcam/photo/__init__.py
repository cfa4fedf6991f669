"""Pixels to millimetres: what is drawn by hand on a printed sheet, read off a photograph; it knows no cams."""
