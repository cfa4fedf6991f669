"""The papers for worksheets that are made to be photographed."""

PAPER_NAMES = ("A1", "A3", "A4")
"""What an exercise may say that it is made for."""
TILED_A3 = "A3-tiles"
"""A3 on two sheets of A4, for who has no larger printer."""


def format_of(paper: str) -> str:
    """The format of a paper.

    >>> format_of("A3-tiles"), format_of("A4")
    ('A3', 'A4')
    """
    return paper.removesuffix("-tiles")


def orientation_of(paper: str) -> str:
    """The orientation of a sheet: A4 stands, so that the diagrams have room one under the other.

    >>> orientation_of("A4"), orientation_of("A3-tiles")
    ('portrait', 'landscape')
    """
    return "portrait" if paper == "A4" else "landscape"
