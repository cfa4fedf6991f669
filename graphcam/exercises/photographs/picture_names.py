"""What pictures of a page are called that show no view."""

TABLE = "table of answers"
"""The picture name of the table; no view is called so."""
BARS = ("length of the bar across", "length of the bar up")
"""The picture names of the boxes in which the measured lengths of the scale bars are written."""
