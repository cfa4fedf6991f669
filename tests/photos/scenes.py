"""One photograph of a trial, drawn from its number: what is drawn, with what, on which print, how it is taken."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from bent_paper import Points
from curves_drawn import Lines, Work, bad_lines, mistakes_of, work
from exposure import Sensor
from hand import by_hand, cross, dot, even, goes, hatching, ring, scribble, straight
from nuisances import random_placing, random_shot
from pencil import PENS, Leaf, Pen, Stroke
from photograph import Shot, photographed
from printed_courses import GIVEN_CAM, KINDS, Course, CourseKind, course_of
from printer import PER_MM, Placing

from graphcam.constructions.views import DISPLACEMENT
from graphcam.photo.printed_page import PrintedPage, PrintedView

Rng = np.random.Generator
KIND_SHARES: Mapping[str, float] = {
    "careful": 0.13,
    "usual": 0.06,
    "mistake": 0.12,
    "scribble": 0.08,
    "half": 0.10,
    "no dwells": 0.06,
    "double": 0.10,
    "foreign": 0.10,
    "another's": 0.08,
    "empty": 0.03,
    "marks": 0.05,
    "rollers": 0.04,
    "diagram": 0.03,
    "too bad": 0.02,
}
"""How many of the photographs show what; "marks" are points and lines of no exercise, "diagram" is a
displacement curve, "too bad" a right drawing that nobody can read off its photograph."""
RIGHT = ("careful", "usual", "too bad")
PLOTTED = ("marks", "rollers")
"""Kinds without a curve."""
CURVES = tuple(kind for kind in KIND_SHARES if kind not in (*PLOTTED, "diagram"))
"""Kinds with a curve about the origin, or with none where one is asked."""
BAD = ("scribble", "half", "no dwells", "double", "foreign", "another's", "empty")
WOBBLES = {"careful": (0.1, 0.2), "usual": (0.15, 0.3)}
"""Standard deviation of how far the line of a hand strays, mm."""


@dataclass(frozen=True, eq=False)
class Truth:
    """What is known of a scene.

    lines : drawn as a curve, each (n,), in true mm from the view's origin; closed : of each
    made : the mistake that was made
    marks : (n,) plotted points, by what they look like; rays : start and end, in true mm from the origin
    """

    work: Work
    lines: Lines
    made: str = ""
    marks: Mapping[str, list[complex]] = field(default_factory=dict[str, list[complex]])
    rays: list[tuple[complex, complex]] = field(default_factory=list[tuple[complex, complex]])


@dataclass(frozen=True, eq=False)
class Scene:
    """A photograph, and everything that is known of it."""

    number: int
    kind: str
    course: Course
    student: str
    page_number: int
    page: PrintedPage
    pen: str
    megapixels: int
    bend: str
    renderer: str
    shot: Shot
    truth: Truth
    jpeg: bytes

    @property
    def view(self) -> PrintedView:
        """The view in which is drawn."""
        return self.page.views[_view_of(self.kind, self.course)]


def scene_of(number: int, seed: int, scratch: Path, kinds: tuple[CourseKind, ...] = KINDS, *, kind: str = "") -> Scene:
    """The photograph of a number in the trial of a seed.

    kind : of the scene, where it is not left to chance
    """
    rng = np.random.default_rng([seed, number])
    drawn = str(rng.choice(list(KIND_SHARES), p=list(KIND_SHARES.values())))
    kind = kind or drawn
    if kind not in CURVES and all(each.exercise == GIVEN_CAM for each in kinds):
        kind = "careful"  # its worksheet asks for a curve alone, and has no diagram
    suited = [each for each in kinds if each.curve != (kind in PLOTTED)]
    course = course_of(suited[rng.integers(len(suited))], scratch)
    student = course.kind.students[rng.integers(len(course.kind.students))]
    page_number, page = course.page(student, _view_of(kind, course))
    print_, renderer = course.print_of(student, page_number, scratch)
    megapixels = int(rng.choice([12, 5, 0], p=[0.5, 0.3, 0.2]))
    bend = str(rng.choice(["flat", "curl", "fold"], p=[0.6, 0.2, 0.2])) if megapixels else "flat"
    placing = random_placing(rng)
    said = {"placing": placing}
    if kind == "too bad":
        megapixels = megapixels or 12
        bend, sensor = [("strong curl", None), ("two folds", None), ("flat", _shaken(rng)), ("flat", _unsharp(rng))][
            rng.integers(4)
        ]
        said |= {"sensor": sensor}
    shot = random_shot((page.width, page.height), rng, megapixels, bend, **said)
    pen = str(rng.choice(list(PENS)))
    leaf = Leaf(print_, page.height, PER_MM, rng)
    easel = _Easel(leaf, page.views[_view_of(kind, course)], placing, PENS[pen], rng)
    truth = _drawn(easel, kind, course, student)
    jpeg = photographed(leaf.light, (page.width, page.height), PER_MM, shot, rng)
    return Scene(
        number, kind, course, student, page_number, page, pen, megapixels, bend, renderer, shot, truth, jpeg
    )  # fmt: skip


def _view_of(kind: str, course: Course) -> str:
    return DISPLACEMENT.name if kind == "diagram" else course.kind.view


def _shaken(rng: Rng) -> Sensor:
    return Sensor(moved=rng.uniform(12, 25) * np.exp(1j * rng.uniform(0, np.pi)))


def _unsharp(rng: Rng) -> Sensor:
    return Sensor(blur=float(rng.uniform(5, 9)), sharpened=0.0)


@dataclass(frozen=True, eq=False)
class _Easel:
    """Draws in a view, in true millimetres from its origin."""

    leaf: Leaf
    view: PrintedView
    placing: Placing
    pen: Pen
    rng: Rng

    @property
    def reach(self) -> float:
        """From the origin to the nearest edge of the room."""
        left, low, right, high = self.view.room
        x, y = self.view.origin.real, self.view.origin.imag
        return min(x - left, right - x, y - low, high - y)

    def draw(self, strokes: list[Stroke], pen: Pen | None = None) -> None:
        """Draw strokes."""
        self.leaf.draw([Stroke(self.on_page(each.points), each.pressure) for each in strokes], pen or self.pen)

    def on_page(self, points: Points) -> Points:
        """Places on the page."""
        return self.view.origin + self.placing.by_hand(np.asarray(points))

    def inside(self, points: Points) -> Points:
        """Those of points (n,) that lie in the room."""
        left, low, right, high = self.view.room
        at = self.on_page(points)
        return points[(at.real > left) & (at.real < right) & (at.imag > low) & (at.imag < high)]


def _drawn(easel: _Easel, kind: str, course: Course, student: str) -> Truth:
    rng = easel.rng
    hand = "usual" if kind == "usual" else "careful"
    seed, made = int(rng.integers(1, 1 << 30)), ""
    if kind == "mistake":
        names = mistakes_of(course, student)
        made = names[rng.integers(len(names))]
    constructed = work(course, student, hand, seed, made)
    if kind == "marks":
        marks, rays = _plotted(easel)
        return Truth(constructed, [], made, marks, rays)
    if kind == "rollers":
        _rollers(easel, constructed)
        return Truth(constructed, [], made, {"cross": constructed.stations.tolist()})
    if kind == "diagram":
        return Truth(constructed, _diagram(easel))
    _clutter(easel, constructed, kind)
    if kind in RIGHT or kind == "mistake":
        plan = [(constructed.line, True)]
    elif kind == "scribble":
        return Truth(constructed, _scribbled(easel))
    else:
        plan = bad_lines(kind, course, student, constructed.line, easel.reach, rng)
    lines: Lines = []
    for line, closed in plan:
        drawn = by_hand(line, float(rng.uniform(*WOBBLES[hand])), rng, closed=closed)
        easel.draw([Stroke.of(each, rng) for each in goes(drawn, rng, closed=closed, apart=0.06)])
        lines.append((drawn, closed))
    return Truth(constructed, lines, made)


def _diagram(easel: _Easel) -> Lines:
    """The displacement over the cam angle: up, along, down, along the axis; with its ordinates."""
    rng, start, end = easel.rng, easel.view.start, easel.view.end
    high = rng.uniform(0.5, 0.85) * (easel.view.room[3] - easel.view.origin.imag)
    knots = start + (end - start) * np.cumsum(rng.uniform([0.25, 0.08, 0.2], [0.4, 0.2, 0.35]))
    at = np.linspace(start, end, 721)
    part = np.interp(at, [start, *knots, end], [0.0, 1.0, 1.0, 0.0, 0.0])
    line = at + 1j * high * (part - np.sin(2 * np.pi * part) / (2 * np.pi))
    if rng.random() < 0.6:
        fine = easel.pen.lighter(0.7, 0.6)
        easel.draw([straight(z.real, z, rng, over=0.3) for z in line[30:-30:30] if z.imag > 3], fine)
    if rng.random() < 0.6:
        easel.draw([stroke for z in line[::30] for stroke in cross(z, rng, 1.0)], easel.pen.lighter(0.9, 0.7))
    drawn = by_hand(line, float(rng.uniform(0.1, 0.2)), rng, closed=False)
    easel.draw([Stroke.of(each, rng) for each in goes(drawn, rng, closed=False, apart=0.06)])
    return [(drawn, False)]


def _scribbled(easel: _Easel) -> Lines:
    rng, lines = easel.rng, list[tuple[Points, bool]]()
    for _ in range(int(rng.integers(2, 8))):
        middle = rng.uniform(10, 60) * np.exp(1j * rng.uniform(0, 2 * np.pi))
        stroke = scribble(middle, rng.uniform(15, 45), rng)
        points = stroke.points[: easel.inside(stroke.points).size]
        if points.size > 40:
            easel.draw([Stroke(points, stroke.pressure[: points.size])])
            lines.append((points, False))
    return lines


def _clutter(easel: _Easel, constructed: Work, kind: str) -> None:
    """What else stands on a worksheet: rays, crosses, numbers, hatching, rubbed out lines, smears."""
    rng, stations = easel.rng, constructed.stations
    fine, much = easel.pen.lighter(0.7, 0.6), rng.random(6)
    every = stations[:: int(rng.integers(1, 3))]
    if kind != "empty" and much[0] < 0.7:
        easel.draw([straight(0, easel.inside(np.array([1.0, 1.06, 1.12]) * z)[-1], rng) for z in every], fine)
    if kind != "empty" and much[1] < 0.75:
        easel.draw([stroke for z in every for stroke in cross(z, rng, 1.3)], easel.pen.lighter(0.9, 0.7))
    if kind != "empty" and much[2] < 0.6:
        _numbers(easel, every)
    if much[3] < 0.15:
        _hatched(easel, stations)
    if much[4] < 0.15 and kind not in BAD:
        apart = rng.uniform(2.5, 9) * rng.choice([-1, 1])
        ghost = even(constructed.line * (1 + apart / np.abs(constructed.line)), closed=True)
        easel.draw(
            [Stroke.of(g, rng) for g in goes(ghost, rng, closed=True)], easel.pen.lighter(rng.uniform(0.1, 0.28))
        )
    if much[5] < 0.15:
        _smear(easel)


def _numbers(easel: _Easel, every: Points) -> None:
    size, script = easel.rng.uniform(2.3, 3.6), bool(easel.rng.random() < 0.5)
    for k, place in enumerate(every):
        beside = place * (1 + easel.rng.uniform(2.5, 5) / abs(place))
        if easel.inside(np.array([beside + 2 * size])).size:
            easel.leaf.write(str(k), complex(easel.on_page(beside)), size, easel.pen.lighter(0.9, 0.7), script=script)


def _hatched(easel: _Easel, stations: Points) -> None:
    rng = easel.rng
    middle = 0.55 * stations[rng.integers(stations.size)]
    outline = middle + rng.uniform(8, 18) * np.exp(2j * np.pi * np.arange(40) / 40)
    easel.draw(hatching(outline, rng.uniform(0, np.pi), rng.uniform(1.5, 4), rng), easel.pen.lighter(0.75, 0.6))


def _smear(easel: _Easel) -> None:
    rng = easel.rng
    middle, turns = rng.uniform(10, 70) * np.exp(1j * rng.uniform(0, 2 * np.pi)), np.linspace(0, 2 * np.pi, 60)
    outline = middle + (rng.uniform(8, 25) * np.cos(turns) + 1j * rng.uniform(4, 9) * np.sin(turns)) * np.exp(
        1j * rng.uniform(0, 3)
    )
    tone = rng.uniform(0.82, 0.95)
    easel.leaf.fill(easel.on_page(outline), Pen(1.0, (tone, tone, tone), 0.15), rng.uniform(1, 3))


def _plotted(easel: _Easel) -> tuple[dict[str, list[complex]], list[tuple[complex, complex]]]:
    """Rays from about the origin, and crosses, dots and rings, on them and elsewhere."""
    rng, reach = easel.rng, easel.reach
    angles = np.sort(rng.choice(np.arange(0, 360, 15), 8, replace=False) + rng.uniform(-2, 2, 8))
    rays: list[tuple[complex, complex]] = []
    for angle in np.radians(angles):
        start = rng.uniform(2, 14) * np.exp(1j * angle)
        rays.append((start, start + rng.uniform(0.45, 0.75) * reach * np.exp(1j * (angle + rng.uniform(-0.1, 0.1)))))
    easel.draw(
        [straight(start, end, rng, over=0.3, deviation=0.03) for start, end in rays], easel.pen.lighter(0.75, 0.6)
    )
    taken: list[complex] = []
    marks: dict[str, list[complex]] = {"cross": [], "dot": [], "ring": []}
    for kind, draw in (("cross", cross), ("dot", dot), ("ring", ring)):
        for k in range(10):
            place = _free(rays, taken, reach, rng, on_ray=k % 3 == 0)
            if place is not None:
                taken.append(place)
                marks[kind].append(place)
                easel.draw(draw(place, rng))
    return marks, rays


def _rollers(easel: _Easel, constructed: Work) -> None:
    rng = easel.rng
    if rng.random() < 0.6:
        easel.draw([straight(0, 0.97 * z, rng) for z in constructed.stations[::2]], easel.pen.lighter(0.7, 0.6))
    if rng.random() < 0.6:
        _numbers(easel, constructed.stations[::2])
    easel.draw([stroke for z in constructed.stations for stroke in cross(z, rng, 1.4)])


def _free(
    rays: list[tuple[complex, complex]], taken: list[complex], reach: float, rng: Rng, *, on_ray: bool
) -> complex | None:
    for _ in range(200):
        start, end = rays[rng.integers(len(rays))]
        place = start + (end - start) * rng.uniform(0.2, 0.9)
        if not on_ray:
            place = rng.uniform(15, 0.85 * reach) * np.exp(1j * rng.uniform(0, 2 * np.pi))
        apart = [abs(((place - a) * np.conj(b - a)).imag) / abs(b - a) for a, b in rays]
        if all(abs(place - other) > 7 for other in taken) and (on_ray or min(apart) > 3):
            return complex(place)
    return None
