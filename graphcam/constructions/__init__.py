"""The textbook constructions, one file each, drawn with ruler, compass and pencil.

Each is a function of what lies on the board and of the constructions before it, and returns a
:class:`~graphcam.drafting.ink.Construction`.  They use what the task gives and what was read off the paper, nothing
else.
"""
