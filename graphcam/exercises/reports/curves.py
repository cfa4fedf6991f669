"""Curves and points on a page, as paths of an SVG: the student's over the key, or the student's alone."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.exercises.definition.exercise import Kind
from graphcam.exercises.key.expected_answers import Expected, paired

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
