"""Pixels to millimetres: drawings by hand on a printed sheet, read off a photograph; nothing here knows cams."""
