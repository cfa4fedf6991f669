"""Answers out of a drawing, and a student's own answer put back into it."""

import math
import re
from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction, Reading
from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError
from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.definition.marked_scale import MarkedDrawing, on_marked_paper
from graphcam.given.stations import Stations
from graphcam.tasks.task import Task
from graphcam.words import say

T = TypeVar("T")
PRIME_SIGNS = "'’′"
"""How a second or third moving phase is marked on a keyboard and in print."""
PART_READINGS = ("middles",)
PHASE_READINGS = ("greatest", "closing_v", "phase_angles")
"""Readings whose places are numbered from 1: parts, moving phases, phases."""
FIRST_OF_TURN = {"differentiation": 1, "analysis": 0}
"""The number of the first place of constructions that divide the whole turn: of a chord, of a position."""


def board_chain(task: Task, pencil: Pencil | None = None) -> Chain:
    """The drawing of a task."""
    # Marking needs the catalogue of mistakes, which redraw, but draws nothing itself.
    from graphcam.solving.task_board import board_of

    board = board_of(task)
    if isinstance(task.drawing, MarkedDrawing):
        board = on_marked_paper(board, task.drawing)
    return Chain(board, pencil or Pencil())


def construction_of(chain: Chain, name: str) -> Construction:
    """A construction by its name; of a law too the differentiation, which stands beside the others.

    Raises
    ------
    DesignError : there is none of that name
    """
    if name == "differentiation":
        return chain.differentiation
    return _item_by_name(chain, name, "construction", "differentiation")


def views_of(chain: Chain, asked: AskedAnswer) -> set[str]:
    """The views in which an answer may be drawn: the one that it names, or those of its construction."""
    if asked.place:
        return {asked.place}
    return {step.view.name for step in construction_of(chain, asked.construction).steps()}


def drawn_answer(chain: Chain, asked: AskedAnswer) -> NDArray[Any]:
    """What a hand that drew this answers: ([samples,]) numbers in the student's unit, or complex points ([samples,] m).

    Raises
    ------
    DesignError : there is no such place in the drawing
    """
    construction = construction_of(chain, asked.construction)
    if asked.points:
        points = _item_by_name(construction.points, asked.points, "points")
        if asked.kind != "number":
            return points
        place = points[..., place_of(chain, asked)] if asked.station else points
        return place.real if asked.component == "x" else place.imag
    reading = _item_by_name(construction.readings, asked.reading, "reading")
    unit = math.degrees(1) if asked.unit.startswith("deg") else 1.0
    if asked.of == "scale":
        return unit * np.asarray(reading.scale, dtype=np.float64)
    values = reading.value if asked.of == "value" else reading.paper
    return unit * (values[..., place_of(chain, asked)] if asked.station else values)


def per_mm(chain: Chain, asked: AskedAnswer) -> float:
    """Units of the answer in one millimetre of paper; NaN for an angle or a scale, which has no length."""
    if not is_length(chain, asked):
        return math.nan
    if asked.points or asked.of == "paper":
        return 1.0
    return construction_of(chain, asked.construction).readings[asked.reading].per_mm


def is_length(chain: Chain, asked: AskedAnswer) -> bool:
    """Whether the answer is measured as a length, on paper or times a scale: an angle or a scale is not."""
    if asked.points or asked.of != "value":
        return asked.of != "scale"
    return construction_of(chain, asked.construction).readings[asked.reading].unit != "rad"


def place_of(chain: Chain, asked: AskedAnswer) -> int:
    """The place of the answer in its array.

    Raises
    ------
    DesignError : the station's name is not one of the drawing's
    """
    name = re.fullmatch(rf"(\d+)([{PRIME_SIGNS}]*)", asked.station)
    stations = chain.board.stations
    if name is None:
        raise DesignError("station", asked.station, say("a number, with a prime for each phase after the first"))
    number, phase = int(name[1]), len(name[2])
    if asked.reading in PHASE_READINGS or asked.construction in FIRST_OF_TURN:
        first = 1 if asked.reading in PHASE_READINGS else FIRST_OF_TURN[asked.construction]
        drawn = construction_of(chain, asked.construction)
        there = drawn.points[asked.points] if asked.points else drawn.readings[asked.reading].paper
        if not 0 <= number - first < there.shape[-1]:
            limit = say("from {least} to {most}", least=first, most=first + there.shape[-1] - 1)
            raise DesignError("station", asked.station, limit)
        return number - first
    if phase >= len(stations.phases):
        limit = say("in one of {phases} moving phases", phases=len(stations.phases))
        raise DesignError("station", asked.station, limit)
    return _in_phase(stations, number, phase, asked)


def _in_phase(stations: Stations, number: int, phase: int, asked: AskedAnswer) -> int:
    span, first = (stations.parts, 1) if asked.reading in PART_READINGS else (stations.phases, 0)
    place = span[phase].start + number - first
    if not span[phase].start <= place < span[phase].stop:
        limit = say("up to {value}", value=span[phase].stop - span[phase].start - 1 + first)
        raise DesignError("station", asked.station, limit)
    return place


def with_own_answers(chain: Chain, asked: AskedAnswer, values: NDArray[np.float64]) -> Chain:
    """The drawing gone on with from a student's own answers ([samples,]), numbers: what comes later follows them."""
    if asked.points:
        return chain  # a point's own coordinates go no further than its construction
    return chain.continued_from(_replaced(chain, construction_of(chain, asked.construction), asked, values))


def _replaced(
    chain: Chain, construction: Construction, asked: AskedAnswer, values: NDArray[np.float64]
) -> Construction:
    reading = construction.readings[asked.reading]
    values = values / (math.degrees(1) if asked.unit.startswith("deg") else 1.0)
    if asked.of == "scale":
        return rescaled(construction, asked.reading, values)
    paper = values if asked.of == "paper" else values / np.asarray(reading.scale)
    if not asked.station:
        return with_reading(construction, asked.reading, paper)
    if asked.reading == "greatest":
        factor = np.ones((*values.shape, len(chain.board.stations.phases)))
        factor[..., place_of(chain, asked)] = paper / reading.paper[..., place_of(chain, asked)]
        return with_ordinates(construction, factor)
    changed = np.array(np.broadcast_to(reading.paper, (*values.shape, *reading.paper.shape[values.ndim :])))
    changed[..., place_of(chain, asked)] = paper
    drawn = with_reading(construction, asked.reading, changed)
    if construction.name == "integration" and asked.reading == "s" and asked.of == "paper":
        # The greatest displacement on paper is what the known lift is divided by.
        top = int(np.argmax(chain.perfect.integration.readings["s"].paper))
        if place_of(chain, asked) == top:
            return rescaled(drawn, "s", chain.board.motion.lift / paper)
    return drawn


NEXT_SCALES = {
    "s": ("s", "v", "a", "a_before", "max_v", "max_a"),
    "v": ("v", "a", "a_before", "max_v", "max_a"),
    "a": ("a", "a_before", "max_a"),
}
"""Scales that are found from one another, each with those that follow from it."""


def rescaled(construction: Construction, name: str, scale: NDArray[np.float64]) -> Construction:
    """The construction read with another scale, and with it the scales that follow from that one."""
    factor = scale / np.asarray(construction.readings[name].scale)
    following = NEXT_SCALES.get(name, (name,)) if construction.name in ("integration", "differentiation") else (name,)
    readings = dict(construction.readings)
    for each in following:
        if each in readings:
            readings[each] = replace(readings[each], scale=np.asarray(readings[each].scale) * factor)
    return replace(construction, readings=readings)


def redrawn(chain: Chain, board: Board) -> Chain:
    """Everything drawn from the start with other givens; the diagrams stay where motion, ordinate and poles do."""
    before = chain.board
    same = (board.motion, board.ordinate, board.poles) == (before.motion, before.ordinate, before.poles)
    done = {"acceleration": chain.acceleration, "integration": chain.integration} if same else {}
    return replace(chain, board=board, done=done)


def with_reading(construction: Construction, name: str, paper: NDArray[np.float64]) -> Construction:
    """The construction with another length or angle read off the paper."""
    reading = construction.readings[name]
    return replace(construction, readings={**construction.readings, name: Reading(paper, reading.scale, reading.unit)})


def with_ordinates(diagram: Construction, factor: NDArray[np.float64]) -> Construction:
    """The acceleration diagram with the ordinates of every moving phase (..., phases) times a factor."""
    stations: Stations = diagram.givens.stations
    of_part = np.repeat(np.arange(len(stations.parts)), [part.stop - part.start for part in stations.parts])
    phases = {"greatest": slice(None), "middles": of_part, "stations": stations.moving, "before": stations.moving}
    readings = {
        name: Reading(diagram.readings[name].paper * factor[..., phase], diagram.readings[name].scale, "mm of paper")
        for name, phase in phases.items()
    }
    return replace(diagram, readings={**diagram.readings, **readings})


def _item_by_name(things: Mapping[str, T], name: str, what: str, *others: str) -> T:
    if name not in things:
        raise DesignError(what, name, say("one of {names}", names=", ".join((*things, *others))))
    return things[name]
