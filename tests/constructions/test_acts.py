"""What every construction owes to its acts: they suffice to draw it again, none is exact, no mark is without one."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
from golden_random import SOME as RANDOM
from over_all import over_all
from replay import Figure, SecondBoard, figure_of, followed, off, written

import graphcam as gc
from graphcam.drafting.acts import Act, Drawn, Kind
from graphcam.drafting.ink import Construction, Step
from graphcam.drafting.marks import (
    AngleMark,
    Arc,
    Arrow,
    Circle,
    Dimension,
    Dots,
    Label,
    Line,
    Mark,
    Region,
    Role,
    Segments,
)
from graphcam.errors import DesignError
from graphcam.tasks.spring_tables import ArmSpringTable, SpringTable
from graphcam.tasks.task_file import task_from

REPLAYED, ON_THE_FIGURE = 1e-9, 1e-6
"""mm: how far the second board may land beside the first, and a mark beside what its act left."""
HANDS = gc.Pencil(line=0.2, dividers=0.2, protractor=math.radians(0.5), samples=60, seed=4)
BUILT_IN = {name: gc.builtin_task(name) for name in ("coursework", "arm", "flat", "swinging-face", "measured")}
RUBBING = replace(BUILT_IN["coursework"], speed_rpm=120.0, spring=SpringTable(0.5, 2.0, 150.0, friction=0.15, load=9.0))
SPRUNG = replace(BUILT_IN["arm"], speed_rpm=90.0, spring=ArmSpringTable(900.0, 4000.0, 3000.0, load=9.0))
ROUNDED = {"base_radius": 30, "flank_radius": 120, "nose_radius": 10, "lift": 12}
GIVEN_CAMS = {
    f"a given cam, {name}": task_from({"arcs": arcs, "follower": follower, **more})
    for name, arcs, follower, more in (
        ("central", {"base_radius": 28, "ascent": 67, "lift": 15, "flank_radius": "straight"},
         {"kind": "translating", "offset": 0, "roller_radius": 16}, {}),
        ("offset", ROUNDED | {"dwell": 20}, {"kind": "translating", "offset": -8, "roller_radius": 6},
         {"rotation": "cw"}),
        ("arm", ROUNDED, {"kind": "oscillating", "arm": 80, "distance": 95, "roller_radius": 10}, {}),
        ("flat", ROUNDED, {"kind": "flat-faced"}, {"rotation": "cw"}),
    )
}  # fmt: skip
TASKS = BUILT_IN | RANDOM | {"friction at the cam": RUBBING, "an arm's spring": SPRUNG} | GIVEN_CAMS
EVERY = over_all("name", TASKS)
SHOWN = over_all("name", [*BUILT_IN, *GIVEN_CAMS, *list(RANDOM)[::5], "friction at the cam", "an arm's spring"])


@cache
def drawn(name: str, pencil: gc.Pencil | None = None) -> dict[str, Construction]:
    """All constructions of a task, the force plan of a spring among them; none where no cam solves it."""
    try:
        solution = gc.solve(TASKS[name], pencil)
        found = dict(solution.drawn)
    except DesignError:
        return {}
    spring = getattr(solution, "spring", None)
    return found | ({"force plan": spring.force_plan} if spring and spring.force_plan else {})


# --- the acts suffice ------------------------------------------------------------------------------------------------


@EVERY
def test_a_second_board_follows_the_acts_to_the_same_readings_and_places(name):
    for construction in drawn(name).values():
        readings, lies = followed(construction)
        assert set(readings) == set(construction.readings), construction.name
        for key, read in construction.readings.items():
            assert off(read.paper, readings[key]) < REPLAYED, (construction.name, key)
        for key, left in construction.acts.items():
            assert off(left.points, lies[key].points) < REPLAYED, (construction.name, key)


def test_a_sense_taken_wrongly_would_be_found():
    """The second board goes by what is written down: turned round there, it lands elsewhere."""
    text, formulas = written(drawn("coursework")["integration"])
    data = json.loads(text)
    pole = next(row for row in data["rows"] if row["name"] == "P2")
    pole["takes"]["length"] *= 1.001
    s = SecondBoard(data["rows"], formulas).figure(data["readings"]["s"])[0]
    assert off(drawn("coursework")["integration"].readings["s"].paper, s) > 0.01


@SHOWN
def test_no_act_takes_a_number_that_only_the_hand_could_know(name):
    """Two hands that err differently do the same by the same numbers: what differs was found on their paper."""
    hands = [gc.Pencil(line=0.02, dividers=0.02, protractor=math.radians(0.05), seed=seed) for seed in (1, 2)]
    for one, other in zip(*(drawn(name, hand).values() for hand in hands), strict=True):
        texts = [written(each, decisions=False)[0] for each in (one, other)]
        if texts[0] != texts[1]:
            rows = zip(*(json.loads(text)["rows"] for text in texts), strict=True)
            raise AssertionError((one.name, next(pair for pair in rows if pair[0] != pair[1])))


# --- none is exact ---------------------------------------------------------------------------------------------------


def steady(construction: Construction) -> Iterator[str]:
    """The readings whose values are the same for all hands."""
    for key, read in construction.readings.items():
        values = np.where(np.isfinite(read.value), read.value, np.nan)
        known = np.isfinite(values).sum(axis=0) > 1
        laid_off = np.any(values[:, known] if known.ndim else values)  # a knife edge, of radius zero, is no length
        if known.any() and laid_off and not np.nanstd(values[:, known] if known.ndim else values, axis=0).max() > 1e-9:
            yield key


@SHOWN
def test_no_reading_is_without_scatter(name):
    for construction in drawn(name, HANDS).values():
        assert list(steady(construction)) == [], construction.name


KNIFE_EDGES = {
    "working_profile": {"radius"},
    "arc_roller": {"prime_radius", "roller_radius", "rho"},
}
"""Without a roller nothing is drawn for these: they are read of the pitch curve, or of the outline, once more."""


def by_own_errors(name: str) -> Iterator[tuple[str, Construction]]:
    """Every construction of a task by trembling hands, on what perfect hands drew before; with its force plan."""
    solution = gc.solve(TASKS[name])
    before = solution.chain.redrawn(pencil=gc.Pencil(samples=HANDS.samples))
    for own in before:
        earlier = {key: drawn for key, drawn in before.items() if key != own}
        yield own, replace(before, pencil=HANDS, done=earlier)[own]
    if spring := getattr(solution, "spring", None):
        follower = spring.chain.board.follower
        if plan := follower.force_plan(before, spring.load, HANDS, spring.friction):
            yield "force plan", plan


@SHOWN
def test_no_reading_is_without_scatter_of_its_own(name):
    """With everything perfect that it starts from, every construction still errs, in each of its readings."""
    try:
        constructions = dict(by_own_errors(name))
    except DesignError:
        return  # no cam solves it
    assert constructions
    for own, construction in constructions.items():
        roller = getattr(TASKS[name].follower, "roller_radius", None) or 0.0
        excused = KNIFE_EDGES.get(own, set[str]()) if not roller else set[str]()
        assert set(steady(construction)) <= excused, own


def test_the_constructions_of_every_follower_err_of_their_own():
    """The four built-in tasks, arcs and a spring are all among those that are tried."""
    shown = [*BUILT_IN, *list(RANDOM)[::5], "friction at the cam"]
    tried = {key for name in shown for key in drawn(name)}
    assert tried >= {
        *drawn("coursework"),
        *drawn("arm"),
        *drawn("flat"),
        *drawn("swinging-face"),
        "differentiation",
        "three_arcs",
        "arc_roller",
    }
    assert tried >= {"arc_diagrams", "force plan"}


def test_a_reading_without_scatter_would_be_found():
    assert list(steady(gc.solve(gc.builtin_task(), gc.Pencil(samples=3)).drawn["integration"])) != []


# --- no mark stands without an act -----------------------------------------------------------------------------------

GIVEN_ROLES = (Role.AXIS, Role.SCALE)
"""Axes and centre lines are drawn before the first act."""


def own_marks(step: Step) -> list[Mark]:
    """The marks that are neither given nor axes."""
    return [mark for mark in step.own_marks if getattr(mark, "role", None) not in GIVEN_ROLES]


@SHOWN
def test_every_mark_names_the_act_that_left_it_or_the_reading_that_it_bears(name):
    for construction in drawn(name).values():
        for step in construction.steps():
            for mark in own_marks(step):
                assert isinstance(mark.of, Act), (construction.name, str(step.title), mark)


def vertices(mark: Mark) -> list[list[complex]]:
    """The places of a mark, line by line."""
    match mark:
        case Line(points=points):
            return [[complex(p) for p in points]]
        case Segments(starts=starts, ends=ends):
            return [[complex(a), complex(b)] for a, b in zip(starts, ends, strict=True)]
        case Dots(points=points):
            return [[complex(p)] for p in points]
        case Arrow(start=start, end=end):
            return [[start, end]]
        case Region(boundary=boundary):
            return [[complex(p)] for p in boundary]
        case _:
            return []


def traces(act: Act, figure: Figure) -> list[tuple[complex, complex]]:
    """The segments that a pencil or a pair of dividers runs over in an act: from where it starts to what it leaves."""
    found = list(pairwise(figure.points))
    for key in ("start", "points", "cuts"):
        if isinstance(source := act.takes.get(key), Drawn):
            starts = whole_figure(source).points
            n = len(figure.points)
            found += zip(starts * n if len(starts) == 1 else starts, figure.points, strict=False)
    return found


def whole_figure(drawn: Drawn) -> Figure:
    """What is taken, by the second board."""
    taken = Act(Kind.TAKE, "test", "taken", {"of": (drawn,), "which": None}, drawn.shown.size)
    return figure_of(taken)


def from_segments(points: np.ndarray, starts: np.ndarray, ends: np.ndarray) -> np.ndarray:
    """How far each place (rows) lies from each segment (columns)."""
    ways = ends - starts
    squares = np.where(ways == 0, 1.0, np.abs(ways) ** 2)
    share = np.clip(((points[:, None] - starts) * ways.conj()).real / squares, 0, 1)
    return np.abs(points[:, None] - starts - share * ways)


def from_lines(points: np.ndarray, places: np.ndarray, ways: np.ndarray) -> np.ndarray:
    """How far each place (rows) lies from each line (columns)."""
    return np.abs(((points[:, None] - places) * ways.conj()).imag) / np.abs(ways)


def least(distances: np.ndarray, axis: int) -> np.ndarray:
    """The least that is a number."""
    return np.fmin.reduce(distances, axis=axis, initial=np.inf)


AT_ONCE = 300
"""Of so many places of a curve at a time the distances are held."""


def beside(mark: Mark, act: Act, figure: Figure) -> float:
    """How far, at most, a mark lies beside what its act left: each of its lines beside one place, line or circle."""
    if isinstance(mark, Circle | Arc):
        circles = zip(figure.points, figure.radius or [], strict=True)
        return min(abs(mark.centre - centre) + abs(mark.radius - radius) for centre, radius in circles)
    ways = [(p, d) for p, d in zip(figure.points, figure.along or [], strict=False) if not np.isnan(p) and abs(d) > 0]
    if act.kind is Kind.PROJECT:  # square to the line that it is projected on
        onto = whole_figure(act.takes["onto"])
        ways = [(p, (onto.along or [])[min(k, len(onto.points) - 1)] * 1j) for k, p in enumerate(figure.points)]
    lines, segments = (np.array(pairs, complex).reshape(-1, 2).T for pairs in (ways, traces(act, figure)))
    left = np.array(figure.points, complex)
    rounds = np.array(figure.radius or [])

    def from_parts(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How far places lie from what is straight, and from the nearest place or circle that was left."""
        apart = np.abs(points[:, None] - left)
        straight = np.hstack([from_lines(points, *lines), from_segments(points, *segments)])
        return straight, least(np.hstack([apart, np.abs(apart[:, : rounds.size] - rounds)]), axis=1)

    def near(line: np.ndarray) -> float:
        """How far the farthest place of a line lies from the nearest of all."""
        chunks = (from_parts(line[k : k + AT_ONCE]) for k in range(0, line.size, AT_ONCE))
        return max(np.minimum(least(straight, axis=1), single).max() for straight, single in chunks)

    def along(line: np.ndarray) -> float:
        """How far a segment lies from the nearest line or trace, at its farther end."""
        straight = from_parts(line)[0]
        ends = least(np.abs(line[:, None] - left), axis=1).max()
        return min(ends, least(straight.max(axis=0), axis=0))

    every = [np.array(line) for line in vertices(mark)]
    return max((along(line) if line.size == 2 else near(line) for line in every), default=0.0)


@SHOWN
def test_every_mark_lies_on_what_its_act_left(name):
    """The figure is the second board's, so a mark that strays, or an act that would not be followed so, is found."""
    for construction in drawn(name).values():
        for step in construction.steps():
            for mark in own_marks(step):
                if isinstance(mark, Label | Dimension | AngleMark):
                    continue  # a name stands beside its place, and a number beside what it measures
                if isinstance(mark, Segments) and isinstance(mark.of, Act) and mark.of.name == "rows":
                    # A cross marks a place by its middle.
                    mark = Dots((mark.starts + mark.ends) / 2, of=mark.of, index=mark.index)
                assert beside(mark, mark.of, figure_of(mark.of)) < ON_THE_FIGURE, (
                    construction.name,
                    str(step.title),
                    mark,
                )


def test_a_mark_that_strays_would_be_found():
    """By two thousandths of a millimetre, askew to all lines."""
    steps = [step for construction in drawn("coursework").values() for step in construction.steps()]
    dots = [mark for step in steps for mark in own_marks(step) if isinstance(mark, Dots)]
    assert len(dots) > 10
    for mark in dots:
        moved = replace(mark, points=np.asarray(mark.points) + (0.001 + 0.0017j))
        assert beside(moved, mark.of, figure_of(mark.of)) > 100 * ON_THE_FIGURE
