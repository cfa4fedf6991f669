"""Drawings on a page, as paths of an SVG: the student's over the key, or the student's alone; and all of an answer.

These stand in one picture whatever the variants: how far each lies off its own key, unrolled.  Along the picture runs
the way round the key's curve, across it the deviation normal to the key, outwards upwards.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.exercises.definition.exercise import Kind
from graphcam.exercises.key.expected_answers import Expected, Floats, paired

# --- one drawing -----------------------------------------------------------------------------------------------------

PICTURE_MARGIN = 5.0
"""mm around what is shown."""
MAX_CURVE_POINTS = 600
"""Points of a curve that a picture shows."""
BAR_ROOM = 3.0
"""The room under what is shown, for the bar that tells the scale [mm of paper]."""
DETAIL_HALF_SIDE = 12.0
"""Half the side of the enlarged detail about the worst place [mm of paper]."""


@dataclass(frozen=True)
class Window:
    """The part of the paper that a picture shows, y downwards as SVG has it.

    >>> Window(-5.0, -10.0, 20.0, 15.0).box
    '-5.0 -10.0 20.0 15.0'
    """

    left: float
    top: float
    width: float
    height: float

    @property
    def box(self) -> str:
        """The box as SVG has it: left, top, width, height."""
        return f"{self.left:.1f} {self.top:.1f} {self.width:.1f} {self.height:.1f}"


@dataclass(frozen=True)
class CurvePicture:
    """A picture in mm of paper, y downwards as SVG has it.

    window : what it shows;  lines : what is drawn, each as "x,y x,y ...", by its class
    spot : the place of the largest deviation
    """

    window: Window
    lines: tuple[tuple[str, str], ...]
    dots: tuple[tuple[str, float, float], ...]
    spot: tuple[float, float] | None

    @property
    def detail(self) -> Window | None:
        """What is shown enlarged: the surroundings of the spot."""
        if self.spot is None:
            return None
        return Window(
            self.spot[0] - DETAIL_HALF_SIDE, self.spot[1] - DETAIL_HALF_SIDE, 2 * DETAIL_HALF_SIDE, 2 * DETAIL_HALF_SIDE
        )


def picture(curves: Sequence[tuple[str, Points, bool]], spot: complex | None) -> CurvePicture:
    """A picture of curves or points.

    curves : class for its style, points (n,) [mm of paper], whether they are joined by a line

    >>> picture([("own", np.array([0j, 10 + 5j]), True)], None).window.box
    '-5.0 -10.0 20.0 18.0'
    """
    everything = np.concatenate([points for _, points, _ in curves])
    left, right = float(everything.real.min()) - PICTURE_MARGIN, float(everything.real.max()) + PICTURE_MARGIN
    # Under the drawing stands the bar.
    low, high = float(everything.imag.min()) - PICTURE_MARGIN - BAR_ROOM, float(everything.imag.max()) + PICTURE_MARGIN
    lines = tuple((kind, _line(points)) for kind, points, joined in curves if joined)
    dots = tuple((kind, float(z.real), -float(z.imag)) for kind, points, joined in curves if not joined for z in points)
    at = None if spot is None else (float(spot.real), -float(spot.imag))
    return CurvePicture(Window(left, -high, right - left, high - low), lines, dots, at)


def points_of(answer: dict[str, Any]) -> Points:
    """The points (n,) of a marked answer, out of its record."""
    return np.array([complex(x, y) for x, y in answer["given"]])


def worst_place(key: Expected, answer: dict[str, Any], kind: Kind) -> complex | None:
    """The student's own place that is meant to be the key's worst point; None where there is none.

    Of points it is the one that is paired with it, of a curve the nearest place.
    """
    if answer["station"] is None or not isinstance(answer["given"], list):
        return None
    stations = np.atleast_1d(np.asarray(key.value))
    wanted, own = complex(stations[answer["station"]]), points_of(answer)
    if kind == "points":
        return complex(paired(own, stations)[answer["station"]])
    return complex(nearest_places(np.array([wanted]), own)[0])


def nearest_places(wanted: Points, own: Points) -> Points:
    """The places (m,) on the line through the vertices ``own`` (n,) that are nearest to the wanted ones (m,).

    >>> nearest_places(np.array([1 + 1j, 5 + 0j]), np.array([0j, 2 + 0j])).tolist()
    [(1+0j), (2+0j)]
    """
    if own.size < 2:
        return np.broadcast_to(own[0], wanted.shape)
    start, way = own[:-1], np.diff(own)
    length = np.abs(way) ** 2
    along = ((wanted[:, None] - start) * way.conj()).real / np.where(length > 0, length, 1.0)
    feet = start + np.clip(along, 0.0, 1.0) * way
    nearest = np.abs(feet - wanted[:, None]).argmin(axis=1)
    return feet[np.arange(wanted.size), nearest]


def _line(points: Points) -> str:
    shown = points[np.unique(np.linspace(0, points.size - 1, min(points.size, MAX_CURVE_POINTS)).astype(int))]
    return " ".join(f"{z.real:.2f},{-z.imag:.2f}" for z in shown)


# --- all drawings ----------------------------------------------------------------------------------------------------


def over_key(key: Expected, answer: dict[str, Any], kind: Kind, spot: complex | None) -> CurvePicture:
    """The picture of a drawn answer of a record, the key's stations as dots, and of a curve its line.

    spot : the place that is circled, None where none is
    """
    curves = [("key", np.atleast_1d(np.asarray(key.value)), False), ("own", points_of(answer), kind == "curve")]
    if kind == "curve":
        curves.insert(0, ("key", key_line(key), True))
    return picture(curves, spot)


PICTURE_WIDTH, PICTURE_HEIGHT = 640, 200
"""Pixels of the picture, without its labels."""
CURVE_PLACES = 61
"""Places along the curve at which deviations are taken."""
PLACES_PER_PART = 4
"""Places on every part of the key's curve: an arc becomes as many chords."""
MAX_LINES = 300
"""Drawings that are shown; the median and the quartiles are those of all."""
MIN_RANGE, MAX_RANGE = 2.0, 10.0
"""Deviations that the picture shows at least, and at most [mm of paper]."""
MAX_STEP_FACTOR = 1.5
"""How many times the longest part of a drawing is still one step."""
SHOWN_PERCENT = 90
"""Percent of all deviations that the picture's range holds, where that lies between these."""


@dataclass(frozen=True)
class Bundle:
    """The drawings of a group, in pixels from the upper left corner.

    count : of drawings;  lines, median : each as "x,y x,y ...";  quartiles : the area between them, likewise
    band : top and height of what is accepted
    ticks : y and the deviation there [mm of paper]
    """

    count: int
    lines: tuple[str, ...]
    median: str
    quartiles: str
    band: tuple[float, float]
    ticks: tuple[tuple[float, float], ...]
    width: int = PICTURE_WIDTH
    height: int = PICTURE_HEIGHT


def key_line(key: Expected) -> Points:
    """Places (n,) all along the curve of a key, its arcs as chords.

    >>> half_circle = key_line(Expected(np.array([1 + 0j, -1 + 0j]), np.ones(2), np.ones(1)))
    >>> abs(half_circle).round(9).tolist() == [1.0] * (PLACES_PER_PART + 1)
    True
    """
    stations = np.atleast_1d(np.asarray(key.value))
    if not key.bulge.size:
        return stations
    start, end = stations[: key.bulge.size], np.append(stations, stations[0])[1 : key.bulge.size + 1]
    t = np.arange(PLACES_PER_PART) / PLACES_PER_PART
    # The tangent of a quarter of an arc's angle is its bulge; an arc of no angle is its chord.
    turn = 4 * np.arctan(key.bulge)[:, None]
    straight = np.abs(turn) < 1e-9
    along = np.where(straight, t, np.expm1(1j * turn * t) / np.where(straight, 1.0, np.expm1(1j * turn)))
    return np.append(start[:, None] + (end - start)[:, None] * along, end[-1])


def deviations_along(key: Expected, own: Points, kind: Kind) -> Floats:
    """How far a drawing lies off at places (CURVE_PLACES,) equally spaced along the key, outwards positive [mm of
    paper].

    >>> square = Expected(np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j]), np.ones(4), np.zeros(4))
    >>> outside = 2 * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j, 1 + 1j])
    >>> float(deviations_along(square, outside, "curve")[8])
    1.0
    """
    line = np.atleast_1d(np.asarray(key.value)) if kind == "points" else key_line(key)
    way = np.append(0.0, np.cumsum(np.abs(np.diff(line))))
    at = np.linspace(0.0, way[-1], CURVE_PLACES)
    if kind == "points":
        off = paired(own, line) - line
        return np.interp(at, way, np.sign((off * line.conj()).real) * np.abs(off))
    part = np.clip(np.searchsorted(way, at, side="right") - 1, 0, line.size - 2)
    wanted = np.interp(at, way, line)
    normal = -1j * (line[part + 1] - line[part])
    # The cam's centre is the origin, and a curve goes round it either way.
    if np.sum((normal * wanted.conj()).real) < 0:
        normal = -normal
    off = nearest_places(wanted, _closed_drawing(own) if key.bulge.size == np.size(key.value) else own) - wanted
    return np.where((off * normal.conj()).real < 0, -1.0, 1.0) * np.abs(off)


def _closed_drawing(own: Points) -> Points:
    """A drawing that stops one step short of its first point is a table of points, and goes back to it."""
    steps = np.abs(np.diff(own))
    return np.append(own, own[0]) if steps.size and abs(own[0] - own[-1]) <= MAX_STEP_FACTOR * steps.max() else own


def bundle(deviations: Sequence[Floats], tolerance: float) -> Bundle:
    """The picture of drawings that lie so far off, each (CURVE_PLACES,) [mm of paper].

    tolerance : what is accepted on either side [mm of paper]

    >>> bundle([np.zeros(CURVE_PLACES), np.ones(CURVE_PLACES)], 0.5).ticks
    ((200.0, -2.0), (150.0, -1.0), (100.0, 0.0), (50.0, 1.0), (0.0, 2.0))
    """
    values = np.array(deviations)
    low, middle, high = np.percentile(values, (25, 50, 75), axis=0)
    most = float(np.ceil(np.clip(np.percentile(np.abs(values), SHOWN_PERCENT), MIN_RANGE, MAX_RANGE)))
    unit = PICTURE_HEIGHT / (2 * most)

    def drawn(line: Floats) -> list[str]:
        # What is far outside is cut off anyway, and would only make long numbers.
        y = PICTURE_HEIGHT / 2 - unit * np.clip(line, -3 * most, 3 * most)
        return [f"{x:.0f},{each:.1f}" for x, each in zip(np.linspace(0, PICTURE_WIDTH, CURVE_PLACES), y, strict=True)]

    shown = np.unique(np.linspace(0, len(values) - 1, min(len(values), MAX_LINES)).astype(int))
    reach = min(tolerance, most)
    return Bundle(
        count=len(values),
        lines=tuple(" ".join(drawn(values[k])) for k in shown),
        median=" ".join(drawn(middle)),
        quartiles=" ".join(drawn(low) + drawn(high)[::-1]),
        band=(PICTURE_HEIGHT / 2 - unit * reach, 2 * unit * reach),
        ticks=tuple((PICTURE_HEIGHT / 2 - unit * part * most, part * most) for part in (-1.0, -0.5, 0.0, 0.5, 1.0)),
    )
