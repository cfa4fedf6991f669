"""Curves and points on a page, as paths of an SVG: the student's over the key, or the student's alone."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphcam.drafting.marks import Points
from graphcam.exercises.definition.exercise import Kind
from graphcam.exercises.key.expectation import Expected, paired

MARGIN = 5.0
"""mm around what is shown."""
MOST = 600
"""Points of a curve that a picture shows."""


@dataclass(frozen=True)
class CurvePicture:
    """A picture in mm of paper, y downwards as SVG has it.

    box : left, top, width, height;  lines : what is drawn, each as "x,y x,y ...", by its class
    spot : the place of the largest deviation
    """

    box: str
    lines: tuple[tuple[str, str], ...]
    dots: tuple[tuple[str, float, float], ...]
    spot: tuple[float, float] | None
    width: float
    height: float


def picture(curves: Sequence[tuple[str, Points, bool]], spot: complex | None) -> CurvePicture:
    """A picture of curves or points.

    curves : class for its style, points (n,) [mm of paper], whether they are joined by a line

    >>> picture([("own", np.array([0j, 10 + 5j]), True)], None).box
    '-5.0 -10.0 20.0 15.0'
    """
    everything = np.concatenate([points for _, points, _ in curves])
    left, right = float(everything.real.min()) - MARGIN, float(everything.real.max()) + MARGIN
    low, high = float(everything.imag.min()) - MARGIN, float(everything.imag.max()) + MARGIN
    lines = tuple((kind, _line(points)) for kind, points, joined in curves if joined)
    dots = tuple((kind, float(z.real), -float(z.imag)) for kind, points, joined in curves if not joined for z in points)
    at = None if spot is None else (float(spot.real), -float(spot.imag))
    box = f"{left:.1f} {-high:.1f} {right - left:.1f} {high - low:.1f}"
    return CurvePicture(box, lines, dots, at, right - left, high - low)


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
    if own.size < 2:
        return complex(own[0])
    start, way = own[:-1], np.diff(own)
    length = np.abs(way) ** 2
    along = np.divide(((wanted - start) * way.conj()).real, length, out=np.zeros(way.shape), where=length > 0)
    feet = start + np.clip(along, 0.0, 1.0) * way
    return complex(feet[np.argmin(np.abs(feet - wanted))])


def _line(points: Points) -> str:
    shown = points[np.unique(np.linspace(0, points.size - 1, min(points.size, MOST)).astype(int))]
    return " ".join(f"{z.real:.2f},{-z.imag:.2f}" for z in shown)
