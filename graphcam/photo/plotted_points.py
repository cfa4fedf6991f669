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
"""The resolution of the picture in which marks are looked for [px/mm]."""
MIN_SCORES: Mapping[Mark, float] = {"cross": 0.73, "dot": 0.78, "ring": 0.68}
"""The minimum correlation with a mark's shape: little else is as round as a ring, but much is like a cross, and a
printed arrowhead is like a dot."""
MIN_DENSITY = 0.06
"""The density of the faintest mark."""
MIN_RESIDUE_FACTOR = 3.0
"""The minimum density of a mark beside print, where printed lines cross, as a multiple of their residue."""
MIN_SIGNAL_TO_NOISE = 5.0
"""The minimum density of a mark, in standard deviations of noise."""
CROSS_TURNS = (0, 15, 30, 45, 60, 75)
"""The angles of crosses that are looked for [degrees]."""
ARM_LENGTH = 1.5
"""Half the length of a cross [mm]."""
STROKE_WIDTH = 0.2
"""The standard deviation of the Gauss curve across a stroke [mm]."""
DOT_RADIUS = 0.45
"""The radius of a dot [mm]."""
RING_RADII = (0.75, 1.1)
"""The radii of rings that are looked for [mm]."""
PATTERN_HALF_SIDE = 2.2
"""Half the side of a pattern [mm]."""
MIN_MARK_DISTANCE = 2.0
"""The minimum distance of two marks [mm]: nearer ones are one."""
MAX_CONTINUATION_SHARE = 0.6
"""The maximum strength behind the end of a cross's arm, as a share of the arm's; construction lines run on."""
ARM_SPAN, BEYOND_ARM_SPAN = (0.5, 1.2), (2.2, 3.2)
"""The spans along an arm, and behind its end, in which strengths are measured [mm]."""
DOT_RADII = (0.05, 0.15, 0.25)
"""The radii in a dot at which densities are measured [mm]."""
SURROUNDING_RADII = (1.0, 1.2, 1.4)
"""The radii about a dot at which densities are measured [mm]."""
MIN_DOT_CONTRAST = 2.15
"""The minimum density of a dot as a multiple of lines about it; where lines cross, their densities add to twice."""
MIN_DOT_CONTRAST_ON_LINE = 1.95
"""The minimum density of a dot as a multiple of that about it, where one line runs through."""
RING_SEARCH_RADII = np.arange(0.4, 1.75, 0.1)
"""The radii at which the line of a ring is looked for [mm]."""
RING_RADIUS_TOLERANCE, MIN_RING_SHARE = 0.25, 0.7
"""The tolerance of a ring's radius [mm], and the minimum share of directions within it: a nought is no ring."""
RING_GAP_DENSITY, MIN_CLOSED_SHARE = 0.4, 0.92
"""The density below which a ring is open, as a share of its usual one, and the minimum share of closed directions."""
RING_OUTER_RADII = ((0.45, 0.55, 0.65), (0.75, 0.85, 0.95))
"""Distances outside a ring at which lines that meet it are looked for [mm]: those of a 6, 8 or 9 are digits."""
RING_RAY_DENSITY, FAINT_RAY_DENSITY = 0.5, 0.2
"""The densities of a line that meets a ring, and of a ray that goes on, as shares of the ring's."""
MAX_RAY_ANGLE, MAX_OPPOSITE_ANGLE = np.radians(14.0), np.radians(25.0)
"""The maximum turn of a ray between both distances, and between the two sides of the ring [rad]."""
RING_DIRECTIONS = np.exp(2j * np.pi * np.arange(48) / 48)


@dataclass(frozen=True, eq=False)
class PointReading:
    """The points that were found: the sure ones, then the others, each in the order of their scores.

    points : (n,) mm of paper from the view's origin
    kinds : (n,) their shapes;  scores : (n,) correlations with these
    """

    points: Points
    kinds: tuple[Mark, ...]
    scores: NDArray[np.float64]

    @property
    def sure(self) -> NDArray[np.bool_]:
        """Flags (n,) of marks that are sure anywhere; the others count only where a mark is expected."""
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
    """The points that are plotted in a view's room.

    less : reduction of ``MIN_SCORES`` for points that are not sure
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
    """A place that looks like a mark: correlation, place on the page, and pattern."""

    score: float
    place: complex
    pattern: Pattern


def _summits(picture: Raster, faintest: float, view: PrintedView, least: Mapping[Mark, float]) -> Iterator[FoundMarks]:
    """The local maxima of correlation in the room, for each kind of mark.

    least : the minimum score of each kind
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
    """Whether a place is a mark, and neither print nor crossing lines of a construction."""
    place, pattern = mark.place, mark.pattern
    core = float(picture.at(place + _circles(DOT_RADII)).mean())
    darkest = max(core, float(picture.at(place + _circles(RING_RADII)).mean(1).max()))
    if bool(ink.beside_print(np.array(place))) and darkest < MIN_DENSITY + MIN_RESIDUE_FACTOR * ink.residue:
        return False
    if pattern.kind == "cross":
        # Those of two crossing construction lines run on.
        turns = (pattern.turn, pattern.turn + np.pi / 2)
        return any(_stroke_ends(picture, place, np.exp(1j * turn)) for turn in turns)
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
    """Whether all lines that meet a ring from outside are rays that run straight through it or, once, up to it."""
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
    """Places (radii, 48) on circles about the origin [mm]."""
    return np.array(radii)[:, None] * RING_DIRECTIONS


@cache
def patterns() -> tuple[Pattern, ...]:
    """The patterns of all marks that are looked for.

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
    """The offsets of the maximum of correlation below and right of its pixel [px], from its neighbours."""
    if not (0 < row < score.shape[0] - 1 and 0 < column < score.shape[1] - 1):
        return 0.0, 0.0
    return _summit(score[row - 1 : row + 2, column]), _summit(score[row, column - 1 : column + 2])


def _summit(three: NDArray[np.float32]) -> float:
    before, here, behind = (float(value) for value in three)
    return float(np.clip((before - behind) / (2 * (before + behind - 2 * here) - 1e-9), -0.5, 0.5))


def _stroke_ends(picture: Raster, place: complex, ahead: complex) -> bool:
    across = 1j * ahead * np.arange(-0.4, 0.45, 0.2)
    inside, outside = (np.linspace(*span, 6)[:, None] * np.array([-1, 1])[None] for span in (ARM_SPAN, BEYOND_ARM_SPAN))
    strong = picture.at(place + inside[..., None] * ahead + across).max(-1).mean()
    behind = picture.at(place + outside[..., None] * ahead + across).max(-1).mean(0)
    return bool((behind < MAX_CONTINUATION_SHARE * strong).all())
