"""Straight lines drawn in a view, such as rays, tangents and limit lines, and where two of them cross.

Each piece of a ridge votes for the line in its own direction (P. Hough, US patent 3069654, 1962); the lines are then
placed by the middles of their strokes.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.photo.line_tracks import above_foot
from graphcam.photo.pencil_ink import Ink
from graphcam.photo.pictures import PhotographError
from graphcam.photo.printed_page import Points, PrintedView
from graphcam.photo.raster import DIRECTION_COUNT, PIXELS_PER_MM, Raster, ridges, spread
from graphcam.words import say

MIN_SIGNAL_TO_NOISE = 7.0
"""The minimum strength of a piece of a line, in standard deviations of noise."""
MIN_DENSITY = 0.03
"""The density of the faintest line."""
MIN_LINE_LENGTH = 20.0
"""The minimum length of a line [mm]; shorter ones have no reliable direction."""
MAX_GAP = 4.0
"""The maximum gap in a line [mm]; beyond it another begins."""
MIN_COVER = 0.6
"""The minimum share of its length on which a line is drawn."""
MIN_CROSSING_COVER = 0.7
"""The minimum share of its length on which a line is drawn, for a crossing to be taken from it."""
MIN_CROSSING_ANGLE = 20.0
"""The minimum angle of a crossing [degrees]; at less a pencil's width moves it by half a mm."""
VOTING_DEGREES = 6
"""The range about a piece's own direction for which it votes [degrees]."""
VOTING_BIN = 0.5
"""The width of the bins for votes on the distance from the middle [mm]."""
MAX_PIECE_ANGLE = 14.0
"""The maximum angle between a piece and its line [degrees]."""
FITTING_HALF_WIDTHS = (0.8, 0.5, 0.4, 0.4)
"""Half the widths of the strips whose pieces belong to a line, in the rounds of its fit [mm]."""
MAX_SAG = 0.3
"""The maximum sag of a line in its middle [mm]; more is an arc."""
MAX_LINES = 80
"""The maximum number of lines; a construction of 24 stations has a third of these."""
MIN_PIECES = 20
"""The minimum number of pieces of a line."""
PROFILE_HALF_WIDTHS = (0.7, 0.4)
"""Half the widths of the profiles by which a line is placed first and again [mm]; the second holds no neighbour."""
LINE_STEP = 0.5
"""The step along a line between its profiles [mm]."""
STRENGTH_SHARE, STRENGTH_PERCENTILE = 0.3, 80
"""The minimum strength where a line is drawn, as a share of this percentile of its strength."""
OUTLIER_DISTANCE = 0.1
"""The distance of a place from its line above which it weighs less [mm]: a digit, another line."""


@dataclass(frozen=True)
class Segment:
    """A straight line: its ends [mm of paper from the view's origin], and the share of its length that is drawn."""

    start: complex
    end: complex
    cover: float

    @property
    def length(self) -> float:
        """The distance between the ends [mm]."""
        return abs(self.end - self.start)


@dataclass(frozen=True, eq=False)
class Pieces:
    """Pieces of ridges, one per pixel: places (n,) on the page, and directions (n,) [rad]."""

    places: Points
    directions: NDArray[np.float64]

    def selected(self, kept: NDArray[np.bool_]) -> Pieces:
        """The pieces that a mask chooses."""
        return Pieces(self.places[kept], self.directions[kept])


def read_lines(ink: Ink, view: PrintedView) -> list[Segment]:
    """The straight lines in a view's room, the longest first."""
    pieces = _pieces(ink.pencil.reduced(PIXELS_PER_MM), view)
    placed = (_placed_line(ink.sharp, start, end) for start, end in _candidate_lines(pieces))
    lines = [
        Segment(line.start - view.origin, line.end - view.origin, line.cover)
        for line in placed
        if line is not None and line.length >= MIN_LINE_LENGTH and line.cover >= MIN_COVER
    ]
    return sorted(lines, key=lambda line: -line.length)


def crossing(one: Segment, other: Segment) -> complex:
    """The crossing of two lines, prolonged if need be [mm of paper from the view's origin].

    Raises
    ------
    PhotographError : they cross at less than ``MIN_CROSSING_ANGLE``, or one of them is drawn in pieces

    >>> crossing(Segment(-2 + 0j, 2 + 0j, 1.0), Segment(1 - 1j, 1 + 1j, 1.0))
    (1+0j)
    """
    ahead, across = one.end - one.start, other.end - other.start
    angle = abs(np.degrees(np.angle(ahead / across)))
    angle = min(angle, 180 - angle)
    if angle < MIN_CROSSING_ANGLE:
        why = say("the lines cross at {angle:.0f}°, and {least:.0f}° are needed", angle=angle, least=MIN_CROSSING_ANGLE)
        raise PhotographError(why, say("enter it in the review page"))
    cover = min(one.cover, other.cover)
    if cover < MIN_CROSSING_COVER:
        why = say("{share:.0f} % of a line can be seen", share=100 * cover)
        raise PhotographError(why, say("draw over the line and take the photograph again"))
    along = ((other.start - one.start) * across.conjugate()).imag / (ahead * across.conjugate()).imag
    return one.start + along * ahead


def _pieces(picture: Raster, view: PrintedView) -> Pieces:
    """The crests of the ridges in the room."""
    best = np.full(picture.values.shape, -1, np.float32)
    direction = np.zeros(picture.values.shape, np.int8)
    quiet: list[NDArray[np.float32]] = []
    for k, (_, answer) in enumerate(ridges(picture)):
        better = answer.values > best
        best[better] = answer.values[better]
        direction[better] = k
        quiet.append(answer.values[::6, ::6].ravel())
    strong = best > max(MIN_SIGNAL_TO_NOISE * spread(np.concatenate(quiet)), MIN_DENSITY)
    strong[[0, -1]] = strong[:, [0, -1]] = False
    rows, columns = np.nonzero(strong)
    angle = np.pi * direction[rows, columns] / DIRECTION_COUNT
    right, down = np.round(-np.sin(angle)).astype(int), np.round(-np.cos(angle)).astype(int)
    here = best[rows, columns]
    crest = (here >= best[rows + down, columns + right]) & (here >= best[rows - down, columns - right])
    places = picture.places(columns, rows)
    left, bottom, right_edge, top = view.room
    crest &= (left < places.real) & (places.real < right_edge) & (bottom < places.imag) & (places.imag < top)
    return Pieces(places[crest], angle[crest])


def _candidate_lines(pieces: Pieces) -> Iterator[tuple[complex, complex]]:
    """Start and end of the lines that the pieces make, on the page, those with the most votes first."""
    if pieces.places.size < MIN_PIECES:
        return
    middle = complex(pieces.places.mean())
    votes, bins = _votes(pieces, middle)
    free = np.ones(pieces.places.size, np.bool_)
    for _ in range(MAX_LINES):
        count = np.bincount(votes[free].ravel(), minlength=180 * bins).reshape(180, bins)
        count = count + np.roll(count, 1, 1)
        degrees, distance = divmod(int(count.argmax()), bins)
        if count[degrees, distance] < MIN_PIECES:
            return
        angle, offset = np.radians(degrees + 0.5), (distance - bins // 2) * VOTING_BIN
        fit = _fitted_line(pieces, free, middle, float(angle), offset)
        if fit is None:
            free[(votes == degrees * bins + distance).any(1) | (votes == degrees * bins + distance - 1).any(1)] = False
            continue
        angle, offset, run, taken = fit
        free &= ~taken
        if run[-1] - run[0] >= MIN_LINE_LENGTH:
            ahead = complex(np.exp(1j * angle))
            yield middle + ahead * complex(float(run[0]), offset), middle + ahead * complex(float(run[-1]), offset)


def _votes(pieces: Pieces, middle: complex) -> tuple[NDArray[np.int64], int]:
    """The bins of direction and distance for which each piece votes (n, m), and the number of bins of distance."""
    reach = float(np.abs(pieces.places - middle).max()) + 2 * VOTING_BIN
    bins = 2 * int(np.ceil(reach / VOTING_BIN)) + 2
    degrees = np.degrees(pieces.directions)[:, None] + np.arange(-VOTING_DEGREES, VOTING_DEGREES + 1)
    angle = np.radians(degrees % 180)
    distance = ((pieces.places - middle)[:, None] * np.exp(-1j * angle)).imag
    column = np.floor(distance / VOTING_BIN).astype(np.int64) + bins // 2
    return np.floor(degrees % 180).astype(np.int64) * bins + column, bins


def _fitted_line(
    pieces: Pieces, free: NDArray[np.bool_], middle: complex, angle: float, offset: float
) -> tuple[float, float, NDArray[np.float64], NDArray[np.bool_]] | None:
    """Direction and offset of a line, places (m,) of its pieces along it, and flags (n,) of pieces used up; or None."""
    from_middle = pieces.places - middle
    for width in FITTING_HALF_WIDTHS:
        turned = from_middle * np.exp(-1j * angle)
        on = (
            free
            & (np.abs(turned.imag - offset) < width)
            & _similar_directions(pieces.directions, angle, MAX_PIECE_ANGLE)
        )
        if on.sum() < MIN_PIECES:
            return None
        centre = from_middle[on].mean()
        # The greater axis of the places: total least squares.
        angle = float(np.angle(((from_middle[on] - centre) ** 2).sum()) / 2 % np.pi)
        offset = float((centre * np.exp(-1j * angle)).imag)
    turned = from_middle * np.exp(-1j * angle)
    on = (
        free
        & (np.abs(turned.imag - offset) < FITTING_HALF_WIDTHS[-1])
        & _similar_directions(pieces.directions, angle, MAX_PIECE_ANGLE)
    )
    if on.sum() < MIN_PIECES:
        return None
    along = np.sort(turned.real[on])
    run = max(np.split(along, np.flatnonzero(np.diff(along) > MAX_GAP) + 1), key=lambda part: part[-1] - part[0])
    beside = (turned.real >= run[0] - 0.5) & (turned.real <= run[-1] + 0.5) & (np.abs(turned.imag - offset) < 0.7)
    return angle, offset, run, free & beside & (_similar_directions(pieces.directions, angle, 20.0) | on)


def _similar_directions(directions: NDArray[np.float64], angle: float, degrees: float) -> NDArray[np.bool_]:
    return np.abs((directions - angle + np.pi / 2) % np.pi - np.pi / 2) < np.radians(degrees)


def _placed_line(sharp: Raster, start: complex, end: complex) -> Segment | None:
    """The line placed by the middles of its stroke; None if it is an arc, or hardly a stroke."""
    line: Segment | None = Segment(start, end, 0.0)
    for reach in PROFILE_HALF_WIDTHS:
        line = None if line is None else _through_middles(sharp, line, reach)
    return line


def _through_middles(sharp: Raster, line: Segment, reach: float) -> Segment | None:
    ahead = (line.end - line.start) / line.length
    along, offsets = np.arange(LINE_STEP / 2, line.length, LINE_STEP), np.arange(-reach, reach + 0.025, 0.05)
    profile = sharp.at((line.start + ahead * along)[:, None] + 1j * ahead * offsets)
    weights = above_foot(profile, offsets)
    height = weights.max(1)
    drawn = height > max(MIN_DENSITY, STRENGTH_SHARE * float(np.percentile(height, STRENGTH_PERCENTILE)))
    if drawn.sum() < MIN_PIECES:
        return None
    middle = weights @ offsets / np.maximum(weights.sum(1), 1e-9)
    scaled, use = 2 * along / line.length - 1, drawn.astype(float)
    bulge = 0.0
    for _ in range(6):
        fit = np.polyfit(scaled, middle, 2, w=np.sqrt(use))
        use = drawn / (1 + ((middle - np.polyval(fit, scaled)) / OUTLIER_DISTANCE) ** 2)
        bulge = abs(float(fit[0]))
    if bulge > MAX_SAG:
        return None
    straight = np.polyfit(scaled, middle, 1, w=np.sqrt(use))
    first, last = np.flatnonzero(drawn)[[0, -1]]
    start, end = (
        line.start + ahead * complex(along[k] + side * LINE_STEP / 2, np.polyval(straight, scaled[k]))
        for k, side in ((first, -1), (last, 1))
    )
    return Segment(start, end, float(drawn[first : last + 1].mean()))
