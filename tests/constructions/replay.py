"""A second drawing board, which shares no code with the first: it follows recorded acts in plain floats.

What an act takes is written down as plain data first, as it stands on a sheet: which act's places, lines or circles, at
which stations, set to what, in which direction.  Nothing that an act left, and no length that was taken up, is written
down; so what the second board lands on was found from the steps alone.
"""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache, partial
from typing import Any

import numpy as np
from scipy.optimize import brentq

from graphcam.drafting.acts import Act, Drawn, Setting
from graphcam.drafting.ink import Construction, Reading

ONE_DEGREE = math.pi / 180
NOWHERE = complex(math.nan, math.nan)


# --- writing down ----------------------------------------------------------------------------------------------------


class Sheet:
    """Acts and readings as JSON, each with a number; formulas and rules stand in a list, by number too.

    decisions : whether to write down which places were gone on with, and the scales found: both depend on the hand
    """

    def __init__(self, *, decisions: bool = True) -> None:
        self.decisions = decisions
        self.rows: list[dict[str, Any]] = []
        self.formulas: list[Callable[..., Any]] = []
        self._numbers: dict[int, int] = {}
        self._kept: list[Any] = []

    def number(self, act: Act) -> int:
        """The number of an act, which is written down with all that it stands on."""
        if id(act) not in self._numbers:
            row = {"kind": str(act.kind), "name": act.name, "construction": act.construction}
            row["takes"] = {key: self.plain(value) for key, value in act.takes.items() if self._belongs(key)}
            self._numbers[id(act)] = len(self.rows)
            self._kept.append(act)  # so that no other act takes its place in memory
            self.rows.append(row)
        return self._numbers[id(act)]

    def _belongs(self, key: str) -> bool:
        return self.decisions or key != "which"

    def plain(self, value: Any) -> Any:
        """One thing that an act takes, as plain data."""
        if isinstance(value, Drawn):
            return self._drawn(value)
        if isinstance(value, Setting):
            return self._setting(value)
        if isinstance(value, Reading):
            assert value.act is not None
            return {"reading": self.number(value.act)}
        if isinstance(value, slice):
            return {"slice": [value.start, value.stop]}
        if isinstance(value, tuple | list):
            return [self.plain(each) for each in value]
        if callable(value):
            self.formulas.append(value)
            return {"formula": len(self.formulas) - 1}
        if isinstance(value, np.ndarray):
            return {"array": [_number(each) for each in value.ravel().tolist()], "single": value.ndim == 0}
        return _number(value)

    def _drawn(self, drawn: Drawn) -> dict[str, Any]:
        if drawn.whole is None:
            return {"act": self.number(drawn.act)}
        part: dict[str, Any] = {"whole": self._drawn(drawn.whole), "turn": _number(complex(drawn.turn))}
        if drawn.at is not None and self.decisions:
            part["at"] = self.plain(drawn.at if isinstance(drawn.at, int | slice) else np.asarray(drawn.at))
        return part

    def _setting(self, setting: Setting) -> dict[str, Any]:
        if setting.ends is not None:
            return {"between": self.plain(setting.ends), "along": self.plain(setting.along)}
        if setting.formula is not None:
            return {"reckoned": self.plain(setting.formula), "given": self.plain(setting.given)}
        found = {"carried": self.plain(setting.reading)}
        if setting.value is not None:
            found["value"] = setting.value
        if self.decisions:
            found["scale"] = _first(setting.reading.scale)
            found["factor"] = _first(setting.factor)
        return found


def _first(value: Any) -> float:
    return float(np.ravel(np.asarray(value))[0])


def _number(value: Any) -> Any:
    return [value.real, value.imag] if isinstance(value, complex) else value


def written(construction: Construction, *, decisions: bool = True) -> tuple[str, list[Callable[..., Any]]]:
    """All that a construction did, as text, and the formulas that are reckoned in the head."""
    sheet = Sheet(decisions=decisions)
    acts = [sheet.number(drawn.act) for drawn in construction.acts.values()]
    readings = {name: sheet.number(read.act) for name, read in construction.readings.items() if read.act is not None}
    return json.dumps({"rows": sheet.rows, "acts": acts, "readings": readings}), sheet.formulas


# --- following -------------------------------------------------------------------------------------------------------


@dataclass
class Figure:
    """What lies on the second board: places, directions of lines, radii of circles, in lists; ``single``: but one."""

    points: list[complex]
    along: list[complex] | None = None
    radius: list[float] | None = None
    single: bool = False


@dataclass
class SecondBoard:
    """Follows the rows of a sheet, one after another, each when it is needed."""

    rows: list[dict[str, Any]]
    formulas: Sequence[Callable[..., Any]]
    lies: dict[int, Any] = field(default_factory=dict)

    def figure(self, number: int) -> Any:
        """What the act of that number leaves, or what was read, as a list of numbers."""
        if number not in self.lies:
            row = self.rows[number]
            done = getattr(self, "_" + row["kind"].replace(" ", "_"))
            self.lies[number] = done(**row["takes"])
        return self.lies[number]

    # --- what is taken -------------------------------------------------------------------------------------------

    def _taken(self, plain: dict[str, Any]) -> Figure:
        if "act" in plain:
            return self.figure(plain["act"])
        whole, turn = self._taken(plain["whole"]), complex(*plain["turn"])
        if "at" not in plain:
            assert whole.along is not None
            return Figure(whole.points, [d * turn for d in whole.along], None, whole.single)
        at = plain["at"]
        if isinstance(at, int):
            places, single = [at], True
        elif "slice" in at:
            places, single = list(range(len(whole.points)))[slice(*at["slice"])], False
        else:
            marked = at["array"]
            flags = bool(marked) and isinstance(marked[0], bool)
            places = [k for k, kept in enumerate(marked) if kept] if flags else [int(k) for k in marked]
            single = at["single"]
        along, radius = (None if each is None else [each[k] for k in places] for each in (whole.along, whole.radius))
        return Figure([whole.points[k] for k in places], along, radius, single)

    def _lengths(self, plain: Any) -> tuple[list[float], bool]:
        """Lengths or angles, and whether it is one for all."""
        if isinstance(plain, int | float):
            return [float(plain)], True
        if "array" in plain:
            return [float(each) for each in plain["array"]], plain["single"]
        if "between" in plain:
            a, b = (self._taken(end) for end in plain["between"])
            ways = [q - p for p, q in _pairs(a, b)]
            if plain["along"] is None:
                return [abs(w) for w in ways], a.single and b.single
            lines, one = self._direction(plain["along"])
            return [_part(w, d) / abs(d) for w, d in _rows(ways, lines)], a.single and b.single and one
        if "reckoned" in plain:
            given = [self._lengths(each) for each in plain["given"]]
            values = [np.array(each[0] if single else each) for each, single in given]
            found = np.asarray(self.formulas[plain["reckoned"]["formula"]](*values))
            return [float(each) for each in found.ravel()], found.ndim == 0
        paper, single = self.figure(plain["carried"]["reading"])
        if "value" in plain:
            return [plain["value"] / plain["scale"]], True
        return [each * plain["factor"] for each in paper], single

    def _direction(self, plain: Any) -> tuple[list[complex], bool]:
        if isinstance(plain, dict) and "array" in plain:
            return [_one(each) for each in plain["array"]], plain["single"]
        if not isinstance(plain, dict):
            return [_one(plain)], True
        line = self._taken(plain)
        assert line.along is not None
        return line.along, line.single

    # --- what is done --------------------------------------------------------------------------------------------

    def _given(self, points: Any = None, along: Any = None, place: Any = None, of: Any = None) -> Figure:
        if place is not None:
            assert of is not None, f"{place} names no act of the drawing before"
            return self._taken(of)
        at, single = self._direction(points)
        if along is None:
            return Figure(at, single=single)
        ways, one = self._direction(along)
        rows = _rows(at, ways)
        return Figure([p for p, _ in rows], [d for _, d in rows], None, single and one)

    def _take(self, of: Any, which: Any = None) -> Figure:
        parts = [self._taken(each) for each in of]
        points = [point for part in parts for point in part.points]
        along = None if parts[0].along is None else [d for part in parts for d in part.along or []]
        single = len(parts) == 1 and parts[0].single
        if which is None:
            return Figure(points, along, None, single)
        if isinstance(which, int):
            places, single = [which], True
        elif "slice" in which:
            places, single = list(range(len(points)))[slice(*which["slice"])], False
        else:
            places, single = [int(k) for k in which["array"]], which["single"]
        return Figure([points[k] for k in places], None if along is None else [along[k] for k in places], None, single)

    def _enlarge(self, of: Any, axis: Any = None, by: Any = None, **view: Any) -> Figure:
        shown = self._taken(of)
        if axis is not None:
            return _on_the_other_side(shown, self._taken(axis))
        if by is not None:
            heights, one = self._lengths(by)
            raised = [complex(p.real, p.imag + h) for p, h in _rows(shown.points, heights)]
            return Figure(raised, single=shown.single and one)
        scale, moved, origin = _one(view["times"]), _one(view["to"]), self._taken(view["origin"])
        along = None if shown.along is None else [d * scale for d in shown.along]
        radius = None if shown.radius is None else [r * abs(scale) for r in shown.radius]
        return Figure([(p - q) * scale + moved for p, q in _pairs(shown, origin)], along, radius, shown.single)

    def _divide(self, start: Any, end: Any, share: Any) -> Figure:
        a, b = self._taken(start), self._taken(end)
        shares, one = self._lengths(share)
        rows = _rows(a.points, b.points, shares)
        return Figure([p * (1 - t) + q * t for p, q, t in rows], single=a.single and b.single and one)

    def _lay_off(self, start: Any, along: Any, length: Any) -> Figure:
        a, (ways, one_way), (amount, one) = self._taken(start), self._direction(along), self._lengths(length)
        if isinstance(along, dict) and "array" not in along:
            ways = [cmath.rect(1.0, cmath.phase(w)) for w in ways]
        rows = _rows(a.points, ways, amount)
        return Figure([p + w * mm for p, w, mm in rows], single=a.single and one_way and one)

    def _line_through(self, places: Any, direction: Any, turn: complex) -> Figure:
        a, (ways, one) = self._taken(places), self._direction(direction)
        rows = _rows(a.points, ways)
        return Figure([p for p, _ in rows], [w * turn for _, w in rows], None, a.single and one)

    def _erect(self, feet: Any, along: Any) -> Figure:
        return self._line_through(feet, along, 1)

    def _parallel(self, **takes: Any) -> Figure:
        if "to" in takes:
            return self._line_through(takes["through"], takes["to"], 1)
        return self._end_to_end(**takes)

    def _end_to_end(self, lines: Any, cuts: Any, chains: Any) -> Figure:
        ways, feet = self._direction(lines)[0], self._taken(cuts).points
        points = list(feet)
        for cut, part in chains:
            k, end = cut["slice"]
            y = feet[k].imag
            points[k] = complex(feet[k].real, y)
            for way in ways[slice(*part["slice"])]:
                y += math.tan(math.atan2(way.imag, way.real)) * (feet[k + 1].real - feet[k].real)
                k += 1
                points[k] = complex(feet[k].real, y)
            assert k == end - 1
        return Figure(points)

    def _perpendicular(self, to: Any, through: Any) -> Figure:
        return self._line_through(through, to, 1j)

    def _join(self, start: Any, end: Any) -> Figure:
        a, b = self._taken(start), self._taken(end)
        pairs = _pairs(a, b)
        return Figure([p for p, _ in pairs], [q - p for p, q in pairs], None, a.single and b.single)

    def _project(self, points: Any, onto: Any) -> Figure:
        line = self._taken(onto)
        assert line.along is not None
        if "act" in points or "whole" in points:
            shown = self._taken(points)
            rows = _rows(shown.points, line.points, line.along)
            feet = [_where(q, d, p, d * 1j) for p, q, d in rows]
            return Figure(feet, single=shown.single and line.single)
        heights, one = self._lengths(points)
        rows = _rows(heights, line.points, line.along)
        return Figure([q + d / abs(d) * h for h, q, d in rows], single=one and line.single)

    def _cross(self, one: Any, other: Any = None, flat: bool = False, curve: Any = None) -> Figure:
        if curve is not None:
            faired = self.rows[curve["act"]]["takes"]
            pieces = [slice(*each["slice"]) for each in faired["pieces"]]
            return self._meet(self._taken(one), self._taken(faired["points"]).points, pieces)
        a, b = self._taken(one), self._taken(other)
        single = a.single and b.single
        if a.radius is not None:
            rows = _rows(a.points, a.radius, b.points, b.radius or [])
            return Figure([_two_circles(*row, flat=flat) for row in rows], single=single)
        ways = a.along or []
        if b.radius is not None:
            rows = _rows(a.points, ways, b.points, b.radius)
            return Figure([_line_and_circle(*row) for row in rows], single=single)
        rows = _rows(a.points, ways, b.points, b.along or [])
        return Figure([_where(*row, flat=flat) for row in rows], single=single)

    def _meet(self, one: Figure, points: list[complex], pieces: list[slice]) -> Figure:
        """Where rays, or circles left of the way from the origin to their centres, leave a faired curve."""
        found: list[tuple[complex, complex]] = []
        for k, at in enumerate(one.points):
            if one.radius is None:
                assert one.along is not None
                way = one.along[k] / abs(one.along[k])
                found.append(_leaves(points, pieces, partial(_by_ray, at, way), partial(_along_ray, at, way)))
            else:
                found.append(
                    _leaves(points, pieces, partial(_by_circle, at, one.radius[k]), partial(_left_of_centre, at))
                )
        return Figure([place for place, _ in found], [way for _, way in found])

    def _circle(self, centre: Any, radius: Any) -> Figure:
        a, (amount, one) = self._taken(centre), self._lengths(radius)
        rows = _rows(a.points, amount)
        return Figure([p for p, _ in rows], None, [r for _, r in rows], a.single and one)

    def _bisect(self, start: Any, end: Any) -> Figure:
        a, b = self._taken(start), self._taken(end)
        set_to = [(p, q, abs(q - p)) for p, q in _pairs(a, b)]
        arcs = [(_two_circles(p, r, q, r), _two_circles(q, r, p, r)) for p, q, r in set_to]
        return Figure([(c + d) / 2 for c, d in arcs], [c - d for c, d in arcs], None, a.single and b.single)

    def _protractor(self, vertex: Any, base: Any, angle: Any) -> Figure:
        a, (ways, one), (angles, single) = self._taken(vertex), self._direction(base), self._lengths(angle)
        rows = _rows(a.points, ways, angles)
        turned = [cmath.rect(abs(w), cmath.phase(w) + turn) for _, w, turn in rows]
        return Figure([p for p, *_ in rows], turned, None, a.single and one and single)

    def _tangent(self, points: Any, pieces: Any = (), inward: Any = None, rule: Any = None) -> Figure:
        shown = self._taken(points)
        if rule is not None:
            seen = np.asarray(self.formulas[rule["formula"]](np.array(shown.points)))
            return Figure(shown.points, [complex(d) for d in seen])
        if inward is None:
            return shown
        ways, single = self._direction(inward)
        ways = [way / abs(way) for way in ways]
        found = [[_farthest(shown.points[slice(*piece["slice"])], way) for piece in pieces] for way in ways]
        touch = [max(tops, key=lambda p: round(_part(p, way), 6)) for tops, way in zip(found, ways, strict=True)]
        return Figure(touch, [way * 1j for way in ways], None, single=single)

    def _fair(self, points: Any, pieces: Any, parts: int) -> Figure:
        plotted = self._taken(points)

        def smooth(places: list[complex]) -> list[complex]:
            return [p for piece in pieces for p in _smooth(places[slice(*piece["slice"])], parts)]

        if plotted.along is None:
            return Figure(smooth(plotted.points))
        angles = [cmath.phase(way) for way in plotted.along]
        turned = [angles[0] + math.remainder(angle - angles[0], math.tau) for angle in angles]
        ways = [cmath.rect(1.0, angle.real) for angle in smooth([complex(angle) for angle in turned])]
        return Figure(smooth(plotted.points), ways)

    def _read(self, length: Any = None, base: Any = None, line: Any = None, sense: int = 1) -> tuple[list[float], bool]:
        if length is not None:
            return self._lengths(length)
        (ways, one), (seen, single) = self._direction(base), self._direction(line)
        pairs = _rows(ways, seen)
        return [sense * math.remainder(cmath.phase(e) - cmath.phase(d), math.tau) for d, e in pairs], one and single


# --- the second board's ruler and compass ----------------------------------------------------------------------------


def _rows(*lists: Sequence[Any]) -> list[tuple[Any, ...]]:
    """Rows of several lists, of which one with a single entry holds for all rows."""
    n = max(map(len, lists)) if all(lists) else 0
    return list(zip(*((list(each) * n if len(each) == 1 else list(each)[:n]) for each in lists), strict=True))


def _pairs(a: Figure, b: Figure) -> list[tuple[complex, complex]]:
    return _rows(a.points, b.points)


def _one(plain: Any) -> complex:
    return complex(*plain) if isinstance(plain, list) else complex(plain)


def _part(p: complex, way: complex) -> float:
    return p.real * way.real + p.imag * way.imag


def _where(p: complex, d: complex, q: complex, e: complex, *, flat: bool = False) -> complex:
    """Where two lines meet, by the equations a x + b y = c of both."""
    a1, b1, c1 = d.imag, -d.real, d.imag * p.real - d.real * p.imag
    a2, b2, c2 = e.imag, -e.real, e.imag * q.real - e.real * q.imag
    by = a1 * b2 - a2 * b1
    if not abs(by) > 0 or (not flat and abs(by) < math.sin(ONE_DEGREE) * abs(d) * abs(e)):
        return NOWHERE
    return complex((c1 * b2 - c2 * b1) / by, (a1 * c2 - a2 * c1) / by)


def _on_the_other_side(shown: Figure, axis: Figure) -> Figure:
    """As far beyond the foot of the perpendicular on the line, or each on its own, and with its directions the same."""
    lines = axis.along or []

    def over(p: complex, q: complex, d: complex) -> complex:
        """The image of one place."""
        return 2 * _where(q, d, p, d * 1j) - p

    points = [over(*row) for row in _rows(shown.points, axis.points, lines)]
    along = None
    if shown.along is not None:
        along = [over(q + way, q, d) - q for way, q, d in _rows(shown.along, axis.points, lines)]
    return Figure(points, along, shown.radius, shown.single and axis.single)


def _line_and_circle(p: complex, d: complex, centre: complex, radius: float) -> complex:
    """The farther of the two roots of |p + t d - centre| = radius, by the quadratic equation."""
    d = d / abs(d)
    half, rest = _part(p - centre, d), abs(p - centre) ** 2 - radius**2
    under = half * half - rest
    return NOWHERE if not under >= 0 else p + d * (math.sqrt(under) - half)


def _two_circles(p: complex, r: float, q: complex, s: float, *, flat: bool = False) -> complex:
    """Left of the way from p to q, by the law of cosines."""
    c = abs(q - p)
    if not (c > 0 and r > 0 and s > 0):
        return NOWHERE
    cosine, between = (c * c + r * r - s * s) / (2 * c * r), (r * r + s * s - c * c) / (2 * r * s)
    if not (abs(cosine) <= 1 and abs(between) <= 1):
        return NOWHERE
    if not flat and math.sin(math.acos(between)) < math.sin(ONE_DEGREE):
        return NOWHERE
    return p + cmath.rect(r, cmath.phase(q - p) + math.acos(cosine))


def _farthest(points: list[complex], way: complex) -> complex:
    """The top, seen along ``way``, of the parabola through the three points about the farthest plotted one."""
    known = [k for k, p in enumerate(points) if not cmath.isnan(p)]
    best = max(known, key=lambda k: (_part(points[k], way), -k)) if known else 0
    if len(points) < 3:
        return points[best]
    m = min(max(best, 1), len(points) - 2)
    before, at, after = points[m - 1 : m + 2]
    h = [_part(p, way) for p in (before, at, after)]
    bend = h[0] - 2 * h[1] + h[2]
    if not bend < 0:
        return points[best]
    t = (h[0] - h[2]) / (2 * bend)
    if abs(t) > 1:
        return points[best]
    return before * t * (t - 1) / 2 + at * (1 - t * t) + after * t * (t + 1) / 2


def _by_ray(at: complex, way: complex, place: complex) -> float:
    return way.real * (place - at).imag - way.imag * (place - at).real


def _along_ray(at: complex, way: complex, place: complex) -> float:
    return _part(place - at, way) if _part(place - at, way) >= 0 else math.nan


def _by_circle(centre: complex, radius: float, place: complex) -> float:
    return abs(place - centre) - radius


def _left_of_centre(centre: complex, place: complex) -> float:
    return abs(place) if cmath.phase(place / centre) > 0 else math.nan


def _leaves(
    points: list[complex], pieces: list[slice], beside: Callable[[complex], float], out: Callable[[complex], float]
) -> tuple[complex, complex]:
    """The farthest place at which a faired curve is met, by false position, and how it runs there, by a difference."""
    best, where = -math.inf, None
    for piece in pieces:
        row = points[piece]
        for k in range(len(row) - 1):
            a, b = beside(row[k]), beside(row[k + 1])
            share = a / (a - b) if a != b else 0.0
            far = out(row[k]) * (1 - share) + out(row[k + 1]) * share
            if a * b <= 0 and far > best:
                best, where = far, (row, k)
    if where is None:
        return NOWHERE, NOWHERE
    row, k = where

    t = float(brentq(lambda t: beside(_blend(row, k, t)), 0.0, 1.0, xtol=1e-15))
    step = 1e-5
    return _blend(row, k, t), (_blend(row, k, t + step) - _blend(row, k, t - step)) / (2 * step)


def _blend(points: list[complex], k: int, t: float) -> complex:
    """Between point k and the next the mean, weighted by nearness, of the parabolas through them and a neighbour."""
    n = len(points)

    def parabola(k: int, t: float) -> complex:
        """Through the points k - 1, k and k + 1, at the place k + t; beyond an end the last three are used."""
        k, t = (1, t + k - 1) if k < 1 else (n - 2, t + k - n + 2) if k > n - 2 else (k, t)
        return points[k - 1] * t * (t - 1) / 2 + points[k] * (1 - t * t) + points[k + 1] * t * (t + 1) / 2

    return parabola(k, t) * (1 - t) + parabola(k + 1, t - 1) * t


def _smooth(points: list[complex], parts: int) -> list[complex]:
    """A curve through points, in so many chords from each to the next."""
    n = len(points)
    if n < 3:
        return points
    return [*(_blend(points, k, i / parts) for k in range(n - 1) for i in range(parts)), points[-1]]


BOARD = 100.0
"""mm: a crossing at a few degrees enlarges the rounding of what lies far away, and shrinks as far away as it lies."""


def off(here: Any, there: list[float] | list[complex]) -> float:
    """The greatest difference [mm, or rad], of what reaches farther than ``BOARD`` as a part of that.

    What neither board finds does not count.
    """
    ours, theirs = np.ravel(np.asarray(here)), np.asarray(there)
    assert ours.shape == theirs.shape
    unknown = np.isnan(ours)
    assert np.array_equal(unknown, np.isnan(theirs))
    finite = np.isfinite(ours)
    assert np.array_equal(ours[~finite & ~unknown], theirs[~finite & ~unknown])
    apart = np.abs(ours[finite] - theirs[finite]) / max(1.0, np.max(np.abs(ours[finite]), initial=0.0) / BOARD)
    return float(np.max(apart, initial=0.0))


def followed(construction: Construction) -> tuple[dict[str, list[float]], dict[str, Figure]]:
    """What the second board reads, by name, and what lies on it, by the name of the act."""
    text, formulas = written(construction)
    data = json.loads(text)
    board = SecondBoard(data["rows"], formulas)
    readings = {name: board.figure(number)[0] for name, number in data["readings"].items()}
    return readings, {data["rows"][number]["name"]: board.figure(number) for number in data["acts"]}


@lru_cache(maxsize=1000)
def figure_of(act: Act) -> Figure:
    """What one act leaves, by the second board; the marks of a drawing ask for the same acts again and again."""
    sheet = Sheet()
    number = sheet.number(act)
    return SecondBoard(json.loads(json.dumps(sheet.rows)), sheet.formulas).figure(number)
