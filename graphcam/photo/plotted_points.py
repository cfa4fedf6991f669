"""Plotted points: crosses, dots and small rings, found by their shapes wherever they are drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from graphcam.photo.flag_runs import flag_runs
from graphcam.photo.pencil_ink import Ink
from graphcam.photo.printed_page import Points, PrintedView
from graphcam.photo.raster import Raster

Mark = Literal["cross", "dot", "ring"]
PIXELS_PER_MM = 6.0
"""Pixels of the picture in which marks are looked for."""
MIN_SCORES: Mapping[Mark, float] = {"cross": 0.73, "dot": 0.78, "ring": 0.68}
"""Correlation with a mark's shape, also on a ray: little else is as round as a ring, but much is like a cross, and a
printed arrowhead is like a dot."""
MIN_DENSITY = 0.06
"""Density of the faintest mark."""
MIN_RESIDUE_FACTOR = 3.0
"""Times what is left of the print, that a mark passes beside print, where printed lines cross."""
MIN_SIGNAL_TO_NOISE = 5.0
"""Standard deviations of noise that a mark passes."""
CROSS_TURNS = (0, 15, 30, 45, 60, 75)
"""Degrees by which crosses may be turned."""
ARM_LENGTH = 1.5
"""Half the length of a cross [mm]."""
STROKE_WIDTH = 0.2
"""Deviation of the Gauss curve across a stroke [mm]."""
DOT_RADIUS = 0.45
"""Radius of a dot [mm]."""
RING_RADII = (0.75, 1.1)
"""Radii of rings [mm]."""
PATTERN_HALF_SIDE = 2.2
"""Half the side of a pattern [mm]."""
MIN_MARK_DISTANCE = 2.0
"""The minimum distance of two marks [mm]: nearer ones are one."""
MAX_CONTINUATION_SHARE = 0.6
"""Share of its strength that an arm of a cross has at most where it should have ended; construction lines run on."""
ARM_SPAN, BEYOND_ARM_SPAN = (0.5, 1.2), (2.2, 3.2)
"""The spans along an arm, and behind its end, that are looked at [mm]."""
DOT_RADII = (0.05, 0.15, 0.25)
"""Radii [mm] in a dot."""
SURROUNDING_RADII = (1.0, 1.2, 1.4)
"""Radii [mm] about a dot."""
MIN_DOT_CONTRAST = 2.15
"""Times the density of the lines about it that a dot has; where lines cross, their densities add to twice."""
MIN_DOT_CONTRAST_ON_LINE = 1.95
"""Times the density about it that a dot has where one line runs through."""
RING_SEARCH_RADII = np.arange(0.4, 1.75, 0.1)
"""Radii [mm] at which a ring may lie."""
RING_RADIUS_TOLERANCE, MIN_RING_SHARE = 0.25, 0.7
"""So near to one radius [mm] a ring lies in that share of all directions: rays cross it, and a nought is no ring."""
RING_GAP_DENSITY, MIN_CLOSED_SHARE = 0.4, 0.92
"""In that share of directions a ring has at least this part of its usual density: the bowl of a 3 or 5 is open."""
RING_OUTER_RADII = ((0.45, 0.55, 0.65), (0.75, 0.85, 0.95))
"""How far outside a ring [mm] it is looked what meets it: of a 6, 8 or 9 the rest of the digit."""
RING_RAY_DENSITY, FAINT_RAY_DENSITY = 0.5, 0.2
"""Shares of a ring's density that such a line has, and a ray that goes on."""
MAX_RAY_ANGLE, MAX_OPPOSITE_ANGLE = np.radians(14.0), np.radians(25.0)
"""A ray keeps its direction from the one distance to the other, and goes on at the ring's other side."""
RING_DIRECTIONS = np.exp(2j * np.pi * np.arange(48) / 48)


@dataclass(frozen=True, eq=False)
class PointReading:
    """Points that were found: those that are sure, then the others, each by their scores.

    points : (n,) mm of paper from the view's origin
    kinds : (n,) their shapes;  scores : (n,) correlations with these
    """

    points: Points
    kinds: tuple[Mark, ...]
    scores: NDArray[np.float64]

    @property
    def sure(self) -> NDArray[np.bool_]:
        """Flags (n,) of marks wherever they are drawn; of the others somebody knows that a mark may be there."""
        return self.scores > np.array([MIN_SCORES[kind] for kind in self.kinds])


@dataclass(frozen=True, eq=False)
class Pattern:
    """A mark's shape: ``kernel`` (n, n) answers with the mark's density; ``window`` (n, n), of sum one, is its room.

    norm : by which, and by the spread in the window, an answer becomes a correlation
    """

    kind: Mark
    turn: float
    kernel: NDArray[np.float32]
    window: NDArray[np.float32]
    norm: float


def read_points(ink: Ink, view: PrintedView, less: float = 0.0) -> PointReading:
    """The points in a view's room.

    less : by so much less than ``LEAST_SCORES`` a point may be like its shape
    """
    picture = ink.sharp.reduced(PIXELS_PER_MM)
    least: dict[Mark, float] = {kind: score - less for kind, score in MIN_SCORES.items()}
    found = _summits(picture, max(MIN_DENSITY, MIN_SIGNAL_TO_NOISE * ink.noise), view, least)
    marks = [mark for mark in found if _is_mark(ink, picture, mark)]
    # What is sure first, so that what is less like its own shape takes no place from it.
    marks.sort(key=lambda mark: (mark.score <= MIN_SCORES[mark.pattern.kind], -mark.score))
    apart: list[FoundMarks] = []
    for mark in marks:
        if all(abs(mark.place - other.place) > MIN_MARK_DISTANCE for other in apart):
            apart.append(mark)
    return PointReading(
        points=np.array([mark.place - view.origin for mark in apart], complex),
        kinds=tuple(mark.pattern.kind for mark in apart),
        scores=np.array([mark.score for mark in apart], float),
    )


@dataclass(frozen=True, eq=False)
class FoundMarks:
    """Places that look like marks: correlation, place on the page, and pattern."""

    score: float
    place: complex
    pattern: Pattern


def _summits(picture: Raster, faintest: float, view: PrintedView, least: Mapping[Mark, float]) -> Iterator[FoundMarks]:
    """The places in the room that look more like a mark than those about, for each kind of mark.

    least : score of each kind
    """
    wide = np.ones((2 * round(MIN_MARK_DISTANCE * PIXELS_PER_MM) + 1,) * 2, np.uint8)
    left, bottom, right, top = view.room
    for kind, (score, number) in _correlations(picture, faintest).items():
        rows, columns = np.nonzero((score > least[kind]) & (score >= cv2.dilate(score, wide)))
        for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
            down, across = _refined(score, row, column)
            place = complex(picture.places(np.array(column + across), np.array(row + down)))
            if left < place.real < right and bottom < place.imag < top:
                yield FoundMarks(float(score[row, column]), place, patterns()[number[row, column]])


def _is_mark(ink: Ink, picture: Raster, mark: FoundMarks) -> bool:
    """Whether it is not print, nor lines of a construction that cross."""
    place, pattern = mark.place, mark.pattern
    core = float(picture.at(place + _circles(DOT_RADII)).mean())
    darkest = max(core, float(picture.at(place + _circles(RING_RADII)).mean(1).max()))
    if bool(ink.beside_print(np.array(place))) and darkest < MIN_DENSITY + MIN_RESIDUE_FACTOR * ink.residue:
        return False
    if pattern.kind == "cross":
        return _ends(picture, place, pattern.turn)
    if pattern.kind == "dot":
        return _stands_out(picture.at(place + _circles(SURROUNDING_RADII)), core)
    radius = _round(picture.at(place + _circles(tuple(RING_SEARCH_RADII))))
    return radius is not None and _only_rays_about(picture, place, radius)


def _stands_out(around: NDArray[np.float32], core: float) -> bool:
    """Whether a dot's core is darker than the lines about it, by densities (radii, places) on circles."""
    line = float(np.median(np.sort(around, axis=1)[:, -4:].mean(1)))
    arms = np.median([len(flag_runs(circle > circle.max() / 2, wraps=True)) for circle in around])
    return core > (MIN_DOT_CONTRAST if arms > 2 else MIN_DOT_CONTRAST_ON_LINE) * line


def _round(around: NDArray[np.float32]) -> float | None:
    """The radius of a ring, by densities (radii, directions) about its middle; None if it is no ring."""
    radius, height = RING_SEARCH_RADII[around.argmax(0)], around.max(0)
    middle = float(np.median(radius))
    even = (np.abs(radius - middle) < RING_RADIUS_TOLERANCE).mean() > MIN_RING_SHARE
    whole = (height > RING_GAP_DENSITY * np.median(height)).mean() > MIN_CLOSED_SHARE
    return middle if even and whole else None


def _only_rays_about(picture: Raster, place: complex, radius: float) -> bool:
    """Whether what meets a ring from outside runs straight away from it, through it or, once, up to it."""
    ring = float(picture.at(place + _circles((radius,))).mean())
    near, far = (picture.at(place + _circles(tuple(radius + np.array(more)))).mean(0) for more in RING_OUTER_RADII)
    arms = _arms(near > RING_RAY_DENSITY * ring)
    goes_on, faint = _arms(far > FAINT_RAY_DENSITY * ring), _arms(near > FAINT_RAY_DENSITY * ring)
    if not all(_any_along(goes_on, arm, MAX_RAY_ANGLE) for arm in arms):
        return False
    return sum(not _any_along(faint, -arm, MAX_OPPOSITE_ANGLE) for arm in arms) <= 1


def _any_along(arms: Points, direction: complex, within: float) -> bool:
    return bool((np.abs(np.angle(arms / direction)) < within).any())


def _arms(dark: NDArray[np.bool_]) -> Points:
    """The directions (n,), of length one, of the dark pieces of a circle (48,)."""
    return np.array(
        [complex(np.exp(1j * np.angle(RING_DIRECTIONS[run].sum()))) for run in flag_runs(dark, wraps=True)], complex
    )


def _circles(radii: tuple[float, ...]) -> Points:
    """Places (radii, 48) on circles."""
    return np.array(radii)[:, None] * RING_DIRECTIONS


@cache
def patterns() -> tuple[Pattern, ...]:
    """The shapes that are looked for.

    >>> sorted({pattern.kind for pattern in patterns()})
    ['cross', 'dot', 'ring']
    """
    return tuple(_patterns())


def _patterns() -> Iterator[Pattern]:
    side = (
        np.arange(-round(PATTERN_HALF_SIDE * PIXELS_PER_MM), round(PATTERN_HALF_SIDE * PIXELS_PER_MM) + 1)
        / PIXELS_PER_MM
    )
    z = side + 1j * side[::-1, None]
    for degrees in CROSS_TURNS:
        turned = z * np.exp(-1j * np.radians(degrees))
        arms = [
            _stroke(u) * (np.abs(v) < ARM_LENGTH) for u, v in ((turned.real, turned.imag), (turned.imag, turned.real))
        ]
        yield _pattern("cross", np.radians(degrees), np.maximum(*arms), np.abs(z) < ARM_LENGTH + 0.4)
    yield _pattern("dot", 0.0, 1 / (1 + np.exp((np.abs(z) - DOT_RADIUS) / 0.08)), np.abs(z) < DOT_RADIUS + 0.95)
    for radius in RING_RADII:
        yield _pattern("ring", 0.0, _stroke(np.abs(z) - radius), np.abs(z) < radius + 0.75)


def _stroke(across: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.exp(-((across / STROKE_WIDTH) ** 2) / 2)


def _pattern(kind: Mark, turn: float, shape: NDArray[np.float64], room: NDArray[np.bool_]) -> Pattern:
    window = room / room.sum()
    even = (shape - (shape * window).sum()) * window
    square = float((even * shape).sum())
    return Pattern(kind, turn, (even / square).astype(np.float32), window.astype(np.float32), float(np.sqrt(square)))


def _correlations(picture: Raster, faintest: float) -> dict[Mark, tuple[NDArray[np.float32], NDArray[np.int8]]]:
    """For each kind the best correlation at each pixel (rows, columns), and the number of its pattern."""
    density = picture.values
    best: dict[Mark, tuple[NDArray[np.float32], NDArray[np.int8]]] = {}
    window, spread = np.zeros(0), density
    for number, pattern in enumerate(patterns()):
        if not np.array_equal(pattern.window, window):
            window = pattern.window
            mean = cv2.filter2D(density, -1, window)
            spread = np.sqrt(np.maximum(cv2.filter2D(density * density, -1, window) - mean * mean, 1e-6))
        strength = cv2.filter2D(density, -1, pattern.kernel)
        score = np.where(strength > faintest, strength * np.float32(pattern.norm) / spread, np.float32(-1))
        if pattern.kind not in best:
            best[pattern.kind] = score, np.full(score.shape, number, np.int8)
            continue
        highest, numbers = best[pattern.kind]
        better = score > highest
        highest[better] = score[better]
        numbers[better] = number
    return best


def _refined(score: NDArray[np.float32], row: int, column: int) -> tuple[float, float]:
    """How far the summit of the correlation lies below and right of its pixel, from its neighbours."""
    if not (0 < row < score.shape[0] - 1 and 0 < column < score.shape[1] - 1):
        return 0.0, 0.0
    return _summit(score[row - 1 : row + 2, column]), _summit(score[row, column - 1 : column + 2])


def _summit(three: NDArray[np.float32]) -> float:
    before, here, behind = (float(value) for value in three)
    return float(np.clip((before - behind) / (2 * (before + behind - 2 * here) - 1e-9), -0.5, 0.5))


def _ends(picture: Raster, place: complex, turn: float) -> bool:
    """Whether one of a cross's strokes ends at both its ends, as those of two crossing construction lines do not."""
    return any(_stroke_ends(picture, place, np.exp(1j * (turn + quarter * np.pi / 2))) for quarter in (0, 1))


def _stroke_ends(picture: Raster, place: complex, ahead: complex) -> bool:
    across = 1j * ahead * np.arange(-0.4, 0.45, 0.2)
    inside, outside = (np.linspace(*span, 6)[:, None] * np.array([-1, 1])[None] for span in (ARM_SPAN, BEYOND_ARM_SPAN))
    strong = picture.at(place + inside[..., None] * ahead + across).max(-1).mean()
    behind = picture.at(place + outside[..., None] * ahead + across).max(-1).mean(0)
    return bool((behind < MAX_CONTINUATION_SHARE * strong).all())
