"""Solving a task for the studio: on the board that is held while the hand is down, once while nothing changes."""

import json
import math
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

from graphcam.constructions.board import Board
from graphcam.constructions.pressure_angle import shown_station
from graphcam.constructions.views import REGION
from graphcam.drafting.ink import Construction
from graphcam.errors import DesignError
from graphcam.given.motion import Motion, Rise
from graphcam.solving.arcs_solution import AnySolution, solve_arcs
from graphcam.solving.diagram_sizes import DrawnHeights
from graphcam.solving.solution import Solution, solved_on
from graphcam.solving.task_board import board_of
from graphcam.studio.hold import HeldDiagrams, Hold, hold_of, known
from graphcam.studio.request import pencil_in, task_in
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.words import say

TALLEST = 2000.0
"""The maximum height of the diagrams and of every view [mm of paper]; no sheet takes a fifth of it."""


def solved(
    task: dict[str, Any], spoken: str = "en", hold: Hold | None = None, station: int | None = None
) -> AnySolution:
    """The solution of a task in plain data, its constructions drawn when they are first asked for.

    spoken : the language of its texts;  hold : what its drawing keeps
    station : whose velocity plan is asked for

    Raises
    ------
    GraphcamError : it is no task, or there is no such cam
    """
    kept = {} if hold is None else replace(hold, views={}, names=()).plain()
    return _solved(json.dumps(task), spoken, json.dumps(kept), station)


# Views of one task are asked for one after another, and a drag is told from where the hand took hold.
@lru_cache(maxsize=8)
def _solved(task: str, spoken: str, kept: str, station: int | None) -> AnySolution:
    data, held = json.loads(task), json.loads(kept)
    given, pencil, hold = task_in(data, spoken), pencil_in(data), hold_of(held) if held else Hold()
    if isinstance(given, ArcsTask):
        return solve_arcs(given, pencil, hold.scales)
    board = held_board(board_of(given), given, hold)
    check_heights(board)
    return solved_on(board if station is None else replace(board, station=station), given, pencil)


def check_heights(board: Board) -> None:
    """Check that no diagram is so high that its divisions and labels could not be drawn in reasonable time.

    Raises
    ------
    DesignError : one of them is
    """
    (first, second), degrees = board.poles, math.degrees(board.mu_phi.per_mm)
    a, v, s = (board.ordinate * height for height in DrawnHeights(board.motion, degrees).unit)
    if (highest := max(a, v / first, s / (first * second))) > TALLEST:
        largest = board.ordinate * TALLEST / highest
        limit = say(
            "at most {largest:.3g} mm, so that no diagram is higher than {most:g} mm", largest=largest, most=TALLEST
        )
        remedy = say("take a smaller one or leave it out, or lengthen the shortest phase")
        raise DesignError("drawing.ordinate", say("{length:.3g} mm", length=board.ordinate), limit, remedy)


def held_board(board: Board, task: Task, hold: Hold) -> Board:
    """The board with the scales that are held.

    With a fixed ordinate the scale of the acceleration, and with it all others, would go with the greatest
    acceleration: so the ordinate grows with it instead, unless it is the ordinate that is changed.
    """
    board = replace(board, paper=replace(board.paper, held={**board.paper.held, **hold.scales}), station=hold.station)
    if REGION.name in hold.scales:
        board = replace(board, follower=board.follower.with_positions_at(hold.scales[REGION.name]))
    held = hold.diagrams
    if held is None or held.asked != (task.drawing.ordinate, task.drawing.poles):
        return board
    return replace(board, ordinate=held.ordinate * (peak_of(board.motion) / held.peak), poles=held.poles)


def diagrams_of(solution: Solution) -> HeldDiagrams:
    """What the diagrams of a solution keep."""
    board, asked = solution.chain.board, solution.task.drawing
    return HeldDiagrams(board.ordinate, peak_of(board.motion), board.poles, (asked.ordinate, asked.poles))


def station_of(drawn: Mapping[str, Construction]) -> int | None:
    """The station whose velocity plan is drawn, None without one."""
    measured = drawn.get("pressure_angle")
    return None if measured is None else shown_station(measured)


def scales_of(solution: AnySolution, shown: dict[str, float]) -> dict[str, float]:
    """The scales that views keep, by name.

    shown : the drawing scales of the views
    """
    if isinstance(solution, Solution):
        return {name: scale for name, scale in shown.items() if known(scale)}
    of_diagrams = {name: scale["per_mm"] for name, scale in solution.scales.items() if name != "phi"}
    return {name: scale for name, scale in {**shown, **of_diagrams}.items() if known(scale)}


def peak_of(motion: Motion) -> float:
    """The greatest acceleration of the first rise [lift/rad²].

    >>> import graphcam as gc
    >>> from math import pi
    >>> round(peak_of(gc.Motion([gc.Rise(30, 1.0, "rectangular"), gc.Return(30, 2 * pi - 1, "rectangular")])), 9)
    120.0
    """
    rise = next(phase for phase in motion.phases if isinstance(phase, Rise))
    return rise.normalised.peak_acceleration * rise.lift / rise.angle**2
