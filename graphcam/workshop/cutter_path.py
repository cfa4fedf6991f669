"""The path of a cutter around the cam: the outline moved outwards by its radius, as arcs and lines, and as G-code.

It begins and ends where it is farthest from the axis.  There a quarter of a circle leads on and off: it stays beyond
the tangent, which no other place of the path reaches, since all are nearer to the axis.

The program uses what every controller knows: G17 (plane XY), G21 (mm), G40 (no compensation of its own), G90
(absolute), G94 (feed per minute), G0, G1, G2 and G3 with centres I, J counted from the start of the arc, and M30 at the
end.  Depth, spindle and coolant are the operator's.

Source: T. R. Kramer, F. M. Proctor, E. Messina, *The NIST RS274NGC Interpreter, version 3* (NISTIR 6556, 2000).
"""

from dataclasses import dataclass

import numpy as np

from graphcam.errors import DesignError
from graphcam.mechanism.kinematics import Complexes
from graphcam.words import say
from graphcam.workshop.biarcs import Move, arcs_along, merged_moves
from graphcam.workshop.part_outline import Outline

SAMPLE_COUNTS = 2048, 8192, 32768, 131072, 524288
"""Numbers of samples of the path; the first that suffices is taken."""
MIN_SPAN_SAMPLES = 17
"""The minimum number of samples of a span."""
SAME_TANGENT = 1e-6
"""The maximum difference of two tangents, or relative difference of curvatures, that count as the same."""
MIN_SPAN_LENGTH = 1e-9
"""The minimum length of a span [mm]; at a shorter one the cutter passes a corner."""
LEAD_RADIUS_SHARE = 0.1
"""The radius of the lead-in and lead-out, as a part of the maximum radius; at least that of the cutter."""

Samples = tuple[Complexes, Complexes]
"""Points [mm] and unit tangents, in order."""


@dataclass(frozen=True, eq=False)
class CutterPath:
    """The path of the cutter's centre, clockwise around the cam, in cam coordinates [mm].

    contour : the closed path;  lead_in, lead_out : arcs that touch it where it begins
    cutter_radius : 0 for the outline itself
    error : maximum distance from the exact path [mm]
    """

    contour: list[Move]
    lead_in: Move
    lead_out: Move
    cutter_radius: float
    error: float


def cutter_path(outline: Outline, cutter_radius: float, tolerance: float) -> CutterPath:
    """The path around the outline, within a tolerance [mm].

    Raises
    ------
    DesignError : the cutter does not reach into a hollow of the profile

    >>> import graphcam as gc
    >>> from graphcam.workshop.part_outline import outline_of
    >>> path = cutter_path(outline_of(gc.solve(gc.builtin_task())), 8.0, 0.005)
    >>> path.contour[0].start == path.contour[-1].end, path.error < 0.005
    (True, True)
    """
    outline.check_cutter(cutter_radius)
    for count in SAMPLE_COUNTS:
        pieces = _rotated_to_farthest(_sampled(outline, cutter_radius, count))
        found = [arcs_along(points, tangents, tolerance) for points, tangents in pieces]
        fitted = [piece for piece in found if piece is not None]
        if len(fitted) == len(found):
            contour = merged_moves([move for moves, _ in fitted for move in moves])
            start = contour[0].start
            ways = _lead_moves(start, max(cutter_radius, LEAD_RADIUS_SHARE * abs(start)))
            return CutterPath(contour, *ways, cutter_radius, max(error for _, error in fitted))
    limit = say("greater for this profile")
    raise DesignError("tolerance", tolerance, limit, say("give a larger part.profile_tolerance"))


def _sampled(outline: Outline, cutter_radius: float, count: int) -> list[Samples]:
    """The exact path of the cutter's centre, span by span and clockwise."""
    # Densely at the ends, where a cusp may be near.
    each = max(MIN_SPAN_SAMPLES, count // len(outline.spans))
    share = np.sin(np.linspace(0, np.pi / 2, each)) ** 2
    pieces: list[Samples] = []
    for span in outline.spans:
        at = span.begin + (span.end - span.begin) * share
        normals = span.normal(at)
        points, tangents = span.point(at) + cutter_radius * normals, -1j * normals
        if np.abs(np.diff(points)).sum() > MIN_SPAN_LENGTH:
            pieces.append((points, tangents) if outline.sense < 0 else (points[::-1], tangents[::-1]))
    return _joined_pieces(pieces if outline.sense < 0 else pieces[::-1])


def _joined_pieces(pieces: list[Samples]) -> list[Samples]:
    """The pieces, neighbours joined where the path has no corner; arcs stay by themselves, so that they are exact."""
    joined: list[list[Samples]] = []
    after_arc = True
    for piece in pieces:
        arc = _is_arc(*piece)
        if arc or after_arc or abs(piece[1][0] - joined[-1][-1][1][-1]) > SAME_TANGENT:
            joined.append([])
        joined[-1].append(piece)
        after_arc = arc
    return [_concatenated(parts) for parts in joined]


def _is_arc(points: Complexes, tangents: Complexes) -> bool:
    """Whether samples have the same curvature everywhere."""
    curvature = np.angle(tangents[1:] / tangents[:-1]) / np.maximum(np.abs(np.diff(points)), MIN_SPAN_LENGTH)
    return bool(np.ptp(curvature) <= SAME_TANGENT * np.abs(curvature).max())


def _concatenated(parts: list[Samples]) -> Samples:
    """The samples of all parts in order; where two parts have a point in common it stands once."""
    points, tangents = (np.concatenate([*(part[k][:-1] for part in parts[:-1]), parts[-1][k]]) for k in (0, 1))
    return points, tangents


def _rotated_to_farthest(pieces: list[Samples]) -> list[Samples]:
    k = int(np.argmax([np.abs(points).max() for points, _ in pieces]))
    points, tangents = pieces[k]
    j = int(np.argmax(np.abs(points)))
    parts = (points[j:], tangents[j:]), (points[: j + 1], tangents[: j + 1])
    around = [parts[0], *pieces[k + 1 :], *pieces[:k], parts[1]]
    return [(points, tangents) for points, tangents in around if points.size > 1]


def _lead_moves(start: complex, radius: float) -> tuple[Move, Move]:
    outward = start / abs(start)
    centre, along = start + radius * outward, -1j * outward * radius
    return Move(centre - along, start, centre), Move(start, centre + along, centre)


DECIMALS = 4
CIRCLE_ROUNDING = 2e-4
"""The maximum shift of a circle by the rounding of its ends and centre [mm]."""
MIN_ARC_LENGTH = 0.001
"""The minimum length of an arc [mm]; a shorter one is a line, since rounded it might turn the wrong way."""
MIN_TOLERANCE = 0.001
"""The minimum tolerance of the program [mm]; a finer one would be used up by rounding."""
DEFAULT_TOLERANCE = 0.005
"""The default tolerance of the program [mm]."""
DEFAULT_FEED = 100.0
"""The default feed [mm/min]."""


def cutting_program(
    outline: Outline,
    *,
    cutter_radius: float = 0.0,
    tolerance: float = DEFAULT_TOLERANCE,
    feed: float = DEFAULT_FEED,
    name: str = "",
) -> str:
    """The G-code that leads a cutter clockwise around the cam, a climb cut if the spindle turns clockwise too.

    outline : in cam coordinates, as in ``profile.csv``
    cutter_radius : mm; 0 for the profile itself, for a machine that is told its tool otherwise
    tolerance : the permitted distance of the program from the exact path [mm]
    feed : mm/min

    Raises
    ------
    DesignError : the tolerance is finer than the program's digits, the feed is not positive, or the cutter does not
        reach into a hollow of the profile

    >>> import graphcam as gc
    >>> from graphcam.workshop.part_outline import outline_of
    >>> lines = cutting_program(outline_of(gc.solve(gc.builtin_task())), cutter_radius=8).splitlines()
    >>> lines[-1], [line for line in lines if line.startswith("G17")]
    ('M30', ['G17 G21 G40 G90 G94'])
    """
    if not tolerance >= MIN_TOLERANCE:
        limit = say("{least:g} mm or more", least=MIN_TOLERANCE)
        raise DesignError("tolerance", tolerance, limit, say("less is lost by rounding"))
    if not feed > 0:
        raise DesignError("part.feed", feed, say("more than 0 mm/min"))
    path = cutter_path(outline, cutter_radius, tolerance - CIRCLE_ROUNDING)
    lines = [
        *_head(path, tolerance, feed, name),
        "G17 G21 G40 G90 G94",
        f"G0 {_coordinates('XY', path.lead_in.start)}",
        *_moves([path.lead_in, *path.contour, path.lead_out], feed),
        "M30",
    ]
    return "".join(f"{line}\n" for line in lines)


def _head(path: CutterPath, tolerance: float, feed: float, name: str) -> list[str]:
    if path.cutter_radius:
        way = f"WAY OF THE CENTRE OF A CUTTER OF RADIUS {path.cutter_radius:g} MM"
    else:
        way = "WAY ALONG THE PROFILE ITSELF, CUTTER RADIUS 0"
    greatest = path.error + CIRCLE_ROUNDING
    said = [
        f"GRAPHCAM: CAM PROFILE{' ' if name else ''}{_comment_text(name)}",
        "ZERO AT THE CAM CENTRE, X AND Y AS IN PROFILE.CSV, MM",
        way,
        f"TOLERANCE {tolerance:g} MM, GREATEST DISTANCE FROM THE EXACT WAY {greatest:.4f} MM",
        f"FEED {_feed(feed)} MM/MIN, CLOCKWISE; LED ON AND OFF OUTSIDE",
        "I, J FROM THE START OF THE ARC; DEPTH, SPINDLE AND COOLANT ARE THE OPERATOR'S",
    ]
    return [f"({line})" for line in said]


def _comment_text(name: str) -> str:
    """The letters of a name that may stand in a comment: ASCII without brackets."""
    return "".join(c if c.isascii() and c.isprintable() and c not in "()%;" else "?" for c in name)


def _moves(moves: list[Move], feed: float) -> list[str]:
    lines: list[str] = []
    here = _rounded_point(moves[0].start)
    for move in moves:
        there = _rounded_point(move.end)
        # A circular move that ends where it begins would be a whole circle.
        if there == here:
            continue
        at = _coordinates("XY", there)
        if move.centre is None or abs(there - here) < MIN_ARC_LENGTH:
            lines.append(f"G1 {at}")
        else:
            lines.append(f"{'G2' if move.clockwise else 'G3'} {at} {_coordinates('IJ', move.centre - here)}")
        here = there
    lines[0] += f" F{_feed(feed)}"
    return lines


def _feed(feed: float) -> str:
    """The word for a feed, in digits alone: controllers know no powers of ten."""
    return f"{feed:.{DECIMALS}f}".rstrip("0").rstrip(".")


def _rounded_point(point: complex) -> complex:
    return complex(round(point.real, DECIMALS), round(point.imag, DECIMALS))


def _coordinates(letters: str, point: complex) -> str:
    # Zero has no sign here.
    x, y = (round(value, DECIMALS) + 0.0 for value in (point.real, point.imag))
    return f"{letters[0]}{x:.{DECIMALS}f} {letters[1]}{y:.{DECIMALS}f}"
