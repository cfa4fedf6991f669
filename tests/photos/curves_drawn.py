"""The curves that students draw: right ones, wrong ones that the catalogue knows, and what is none at all.

All are points (n,) from the view's origin, in true millimetres of paper.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from bent_paper import Points
from hand import Rng, even
from printed_courses import Course
from scipy.spatial import cKDTree

from graphcam.constructions.chain import Chain
from graphcam.drafting.curve import faired_line
from graphcam.errors import GraphcamError
from graphcam.exercises.definition.drawn_answers import board_chain, drawn_answer
from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.student_hands import HandTable
from graphcam.exercises.key.answer_scatter import Drawn, answers_of, curve_of
from graphcam.exercises.marking.simulate import submission

Lines = list[tuple[Points, bool]]
"""Points (n,) of each, and whether it is closed."""
BETWEEN = 8
"""Chords that make the curve between two stations, and the arc between two points of a dwell."""
SECOND_APART = 1.2
"""mm that half of a second curve lies beside the first at least; nearer ones are one curve of a thick pencil."""


@dataclass(frozen=True, eq=False)
class Work:
    """What one student constructed.

    answers : by name, as the student would type them; the curve as its plotted points
    stations : (n,) plotted points of the curve;  line : (m,) the smooth closed curve through them
    """

    answers: dict[str, float | Points]
    stations: Points
    line: Points


def work(course: Course, student: str, hand: str, seed: int, mistake: str = "") -> Work:
    """What a student with one of the hands constructs, right or with a catalogued mistake.

    Raises
    ------
    GraphcamError : the mistake cannot be made here
    """
    chain = board_chain(course.variant(student).task, HandTable(hand).pencil(1, seed))
    chain = misconception(mistake).change(chain) if mistake else chain
    drawn: Drawn = answers_of(course.exercise, chain)
    given = submission(course.exercise, drawn, 0)
    return Work(dict(given.values), drawn_answer(chain, course.drawn)[0], closed_line(chain, course.drawn))


def mistakes_of(course: Course, student: str) -> list[str]:
    """The mistakes of the exercise that can be made."""
    found: list[str] = []
    for name in course.exercise.misconceptions:
        try:
            work(course, student, "careful", 1, name)
        except GraphcamError:
            continue
        found.append(name)
    return found


def closed_line(chain: Chain, asked: AskedAnswer) -> Points:
    """The curve of the first hand (n,): faired through the stations, by the compasses along the dwells."""
    plotted = drawn_answer(chain, asked)[0]
    if asked.construction == "analysis":
        pieces = [faired_line(plotted[piece], between=BETWEEN) for piece in chain.analysis.givens.outline.pieces]
        return np.concatenate([piece[:-1] for piece in pieces])
    stations, given = chain.board.stations, curve_of(chain, asked)[0]
    found: list[Points] = []
    at = 0
    for k, span in enumerate(stations.phases):
        phase = plotted[span]
        found.append(faired_line(phase, between=BETWEEN))
        at += phase.size
        following = plotted[stations.phases[(k + 1) % len(stations.phases)]][0]
        arc = [phase[-1]]
        while at < given.size and given[at] != following:
            arc.append(given[at])
            at += 1
        found.append(_by_compasses(np.array([*arc, following]))[1:])
    line = np.concatenate(found)
    return line[np.append(True, np.abs(np.diff(line)) > 1e-6)]


def _by_compasses(points: Points) -> Points:
    """Points on an arc about the origin (n,), with some between."""
    at = np.linspace(0, points.size - 1, (points.size - 1) * BETWEEN + 1)
    angle = np.unwrap(np.angle(points))
    radius = np.interp(at, np.arange(points.size), np.abs(points))
    return radius * np.exp(1j * np.interp(at, np.arange(points.size), angle))


def dwells(line: Points) -> list[tuple[int, int]]:
    """Where on a closed line (n,) of equal steps the radius stays: first place and the one behind the last."""
    radius = np.abs(line)
    flat = np.abs(np.roll(radius, -8) - np.roll(radius, 8)) < 0.03
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flat, [False]]).astype(int)))
    return [(int(a), int(b)) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a > 60]


def bad_lines(
    kind: str, course: Course, student: str, line: Points, reach: float, rng: Rng
) -> list[tuple[Points, bool]]:
    """The lines of a drawing that is not to be marked as right, each with whether it is closed.

    line : (n,) the right one;  reach : from the origin to the nearest edge of the room
    """
    line = even(line, closed=True)
    if kind == "half":
        part = int(rng.uniform(0.4, 0.85) * line.size)
        return [(np.roll(line, -int(rng.integers(line.size)))[:part], False)]
    if kind == "no dwells":
        gaps = dwells(line)
        kept = np.ones(line.size, bool)
        for start, end in gaps:
            kept[start:end] = False
        turned = np.roll(np.arange(line.size), -gaps[0][0]) if gaps else np.arange(line.size)
        cuts = np.flatnonzero(np.diff(kept[turned].astype(int))) + 1
        return [(line[run], False) for run in np.split(turned, cuts) if kept[run[0]]]
    if kind == "double":
        return [(line, True), (_second(course, student, line, rng), True)]
    if kind == "foreign":
        return [(_foreign(line, reach, rng), True)]
    if kind == "another's":
        others = [each for each in course.kind.students if each != student]
        return [(work(course, others[rng.integers(len(others))], "careful", int(rng.integers(1, 1 << 30))).line, True)]
    return []


def _second(course: Course, student: str, line: Points, rng: Rng) -> Points:
    if rng.random() < 0.6:
        apart = rng.uniform(2, 7) * rng.choice([-1, 1])
        return line * (1 + apart / np.abs(line))
    seed, tree = int(rng.integers(1, 1 << 30)), cKDTree(np.column_stack((line.real, line.imag)))
    wrong = [work(course, student, "careful", seed, name).line for name in mistakes_of(course, student)]
    apart = [float(np.median(tree.query(np.column_stack((each.real, each.imag)))[0])) for each in wrong]
    far = [each for each, distance in zip(wrong, apart, strict=True) if distance >= SECOND_APART]
    return far[rng.integers(len(far))]


def _foreign(line: Points, reach: float, rng: Rng) -> Points:
    far = rng.uniform(8, 30)
    room = reach - np.abs(line).max() - 3
    if rng.random() < 0.5:
        far = min(far, room) if rng.random() < 0.5 and room > 8 else -min(far, np.abs(line).min() - 6)
        return line * (1 + far / np.abs(line))
    return line + max(min(far, room), 6.0) * np.exp(1j * rng.uniform(0, 2 * np.pi))
