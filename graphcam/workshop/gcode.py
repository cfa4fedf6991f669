"""The cutting file: the way of a cutter around the cam as a program of G-code, with straight and circular moves.

It uses what every controller knows: G17 (plane XY), G21 (mm), G40 (no compensation of its own), G90 (absolute), G94
(feed per minute), G0, G1, G2 and G3 with centres I, J counted from the start of the arc, and M30 at the end.  Depth,
spindle and coolant are the operator's.

Source: T. R. Kramer, F. M. Proctor, E. Messina, *The NIST RS274NGC Interpreter, version 3* (NISTIR 6556, 2000).
"""

from graphcam.errors import DesignError
from graphcam.words import say
from graphcam.workshop.biarcs import Move
from graphcam.workshop.cutter_path import CutterPath, cutter_path
from graphcam.workshop.outline import Outline

DECIMALS = 4
ROUNDING = 2e-4
"""How far rounded ends and centres may move a circle [mm]."""
SHORTEST_ARC = 0.001
"""A shorter one [mm] is straight: of so few digits it might turn the wrong way round."""
LEAST_TOLERANCE = 0.001
"""The minimum tolerance of the program [mm]: less is spent by rounding."""
TOLERANCE = 0.005
"""The tolerance where none is stated [mm]."""
FEED = 100.0
"""The feed where none is stated [mm/min]."""


def cutting_program(
    outline: Outline, *, cutter_radius: float = 0.0, tolerance: float = TOLERANCE, feed: float = FEED, name: str = ""
) -> str:
    """A program that leads a cutter of that radius around the cam, clockwise: a climb cut with a spindle that does too.

    outline : in cam coordinates, as in ``profile.csv``
    cutter_radius : mm; 0 for the profile itself, for a machine that is told its tool otherwise
    tolerance : how far the program may leave the exact way [mm]
    feed : mm/min

    Raises
    ------
    DesignError : the tolerance is finer than the program's digits, the feed is not positive, or the cutter does not
        reach into a hollow of the profile

    >>> import graphcam as gc
    >>> from graphcam.workshop.outline import outline_of
    >>> lines = cutting_program(outline_of(gc.solve(gc.builtin_task())), cutter_radius=8).splitlines()
    >>> lines[-1], [line for line in lines if line.startswith("G17")]
    ('M30', ['G17 G21 G40 G90 G94'])
    """
    if not tolerance >= LEAST_TOLERANCE:
        limit = say("{least:g} mm or more", least=LEAST_TOLERANCE)
        raise DesignError("tolerance", tolerance, limit, say("less is lost by rounding"))
    if not feed > 0:
        raise DesignError("part.feed", feed, say("more than 0 mm/min"))
    path = cutter_path(outline, cutter_radius, tolerance - ROUNDING)
    lines = [
        *_head(path, tolerance, feed, name),
        "G17 G21 G40 G90 G94",
        f"G0 {_at('XY', path.lead_in.start)}",
        *_moves([path.lead_in, *path.contour, path.lead_out], feed),
        "M30",
    ]
    return "".join(f"{line}\n" for line in lines)


def _head(path: CutterPath, tolerance: float, feed: float, name: str) -> list[str]:
    if path.cutter_radius:
        way = f"WAY OF THE CENTRE OF A CUTTER OF RADIUS {path.cutter_radius:g} MM"
    else:
        way = "WAY ALONG THE PROFILE ITSELF, CUTTER RADIUS 0"
    greatest = path.error + ROUNDING
    said = [
        f"GRAPHCAM: CAM PROFILE{' ' if name else ''}{_plain(name)}",
        "ZERO AT THE CAM CENTRE, X AND Y AS IN PROFILE.CSV, MM",
        way,
        f"TOLERANCE {tolerance:g} MM, GREATEST DISTANCE FROM THE EXACT WAY {greatest:.4f} MM",
        f"FEED {_feed(feed)} MM/MIN, CLOCKWISE; LED ON AND OFF OUTSIDE",
        "I, J FROM THE START OF THE ARC; DEPTH, SPINDLE AND COOLANT ARE THE OPERATOR'S",
    ]
    return [f"({line})" for line in said]


def _plain(name: str) -> str:
    """What of a name may stand in a comment: ASCII without brackets."""
    return "".join(c if c.isascii() and c.isprintable() and c not in "()%;" else "?" for c in name)


def _moves(moves: list[Move], feed: float) -> list[str]:
    lines: list[str] = []
    here = _rounded(moves[0].start)
    for move in moves:
        there = _rounded(move.end)
        # A circular move that ends where it begins would be a whole circle.
        if there == here:
            continue
        at = _at("XY", there)
        if move.centre is None or abs(there - here) < SHORTEST_ARC:
            lines.append(f"G1 {at}")
        else:
            lines.append(f"{'G2' if move.clockwise else 'G3'} {at} {_at('IJ', move.centre - here)}")
        here = there
    lines[0] += f" F{_feed(feed)}"
    return lines


def _feed(feed: float) -> str:
    """The feed as a word of G-code, in digits alone: controllers know no powers of ten."""
    return f"{feed:.{DECIMALS}f}".rstrip("0").rstrip(".")


def _rounded(point: complex) -> complex:
    return complex(round(point.real, DECIMALS), round(point.imag, DECIMALS))


def _at(letters: str, point: complex) -> str:
    # Zero has no sign here.
    x, y = (round(value, DECIMALS) + 0.0 for value in (point.real, point.imag))
    return f"{letters[0]}{x:.{DECIMALS}f} {letters[1]}{y:.{DECIMALS}f}"
