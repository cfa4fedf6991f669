"""What stays while the hand is down, and solving a task on the board that is held, once while nothing changes.

The hold goes to the page with every answer, and comes back with the next request while a handle is dragged.  So the
engine keeps nothing itself, and any engine can go on where another one was.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, replace
from functools import cache, lru_cache
from typing import Any

from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.constructions.pressure_angle import shown_station
from graphcam.constructions.views import REGION
from graphcam.drafting.ink import Construction
from graphcam.errors import DesignError
from graphcam.sheets.labels import LabelPlace
from graphcam.solving.arcs_solution import AnySolution, solve_arcs
from graphcam.solving.diagram_sizes import DrawnHeights
from graphcam.solving.solution import Solution, solved_on
from graphcam.solving.task_board import board_of
from graphcam.studio.view_steps import ViewName
from graphcam.studio.views_request import pencil_in, task_in
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.dataclass_reader import read_dataclass
from graphcam.tasks.task import Task
from graphcam.words import say

MAX_HEIGHT = 2000.0
"""The maximum height of the diagrams and of every view [mm of paper]; no sheet takes a fifth of it."""


CENTRE_SHARE = 0.8
"""The share of it that the cam centre may lie below the curve; the rest is for the curve and the labels."""
Plain = dict[str, Any]


@dataclass(frozen=True)
class HeldView:
    """What a view keeps.

    frame : left, bottom, right and top of the box that is shown, y upwards [mm]
    drawn, settled : the constructions that draw in it, and those that settle its scale
    labels : where its labels stand, by their names: x and y [mm], and the angle [rad]
    """

    frame: tuple[float, float, float, float]
    drawn: tuple[str, ...]
    settled: tuple[str, ...]
    labels: Mapping[str, tuple[float, float, float]]

    def __post_init__(self) -> None:
        """Check that all of it lies on paper."""
        _check_usable(abs(each) for place in (self.frame, *self.labels.values()) for each in place)

    @property
    def places(self) -> dict[str, LabelPlace]:
        """The places of the labels by their names."""
        return {name: LabelPlace(complex(x, y), angle) for name, (x, y, angle) in self.labels.items()}


@dataclass(frozen=True)
class HeldDiagrams:
    """What the diagrams over the cam angle keep, so that their scales stay.

    ordinate : of the first rise [mm of paper], at the greatest acceleration ``peak``
    poles : [mm of paper]
    asked : the ordinate and the poles that the task gave then, None for what it left open
    """

    ordinate: float
    peak: float
    poles: tuple[float, float]
    asked: tuple[float | None, tuple[float, float] | None]

    def __post_init__(self) -> None:
        """Check that they can be drawn by."""
        _check_usable((self.ordinate, self.peak, *self.poles, *(self.asked[1] or ())), 1 / MAX_DISTANCE)


@dataclass(frozen=True)
class DragHold:
    """What an answer leaves to the next one.

    scales : that views keep [mm/mm], by name;  diagrams : what the diagrams keep; a cam of arcs has none of these
    station : whose velocity plan is drawn
    views : by name and by whether they have labels
    names : what the answer says of all views of the task
    """

    scales: Mapping[str, float] = field(default_factory=dict[str, float])
    diagrams: HeldDiagrams | None = None
    station: int | None = None
    views: Mapping[str, HeldView] = field(default_factory=dict[str, HeldView])
    names: tuple[ViewName, ...] = ()

    def __post_init__(self) -> None:
        """Check that its scales can be drawn by."""
        _check_usable(self.scales.values(), 1 / MAX_DISTANCE)

    def plain(self) -> Plain:
        """The hold as plain data."""
        return json.loads(json.dumps(asdict(self)))

    def needs(self, keys: Iterable[str]) -> tuple[set[str], set[str]] | None:
        """The constructions that draw in the views of these keys, and others that settle their scales.

        It is None if one of the views is not known.
        """
        views = [self.views.get(key) for key in keys]
        if any(view is None for view in views):
            return None
        drawing = {name for view in views if view for name in view.drawn}
        return drawing, {name for view in views if view for name in view.settled} - drawing


MAX_DISTANCE = 1e9
"""No place on paper is farther away [mm], and no scale coarser."""


def _check_usable(numbers: Iterable[float], least: float = -1.0) -> None:
    for each in numbers:
        if not least < each < MAX_DISTANCE:
            raise DesignError("hold", each, say("what an earlier answer left, or left out"))


def hold_of(data: Mapping[str, Any]) -> DragHold:
    """What an earlier answer left, from its plain data.

    Raises
    ------
    DesignError : they are not what an answer left

    >>> hold_of(DragHold(scales={"profile": 0.5}).plain()).scales
    {'profile': 0.5}
    """
    if isinstance(found := read_dataclass(DragHold, data), list):
        raise DesignError("hold", say("unknown data"), say("what an earlier answer left, or left out"))
    return found


def is_usable_scale(value: float) -> bool:
    """Whether a scale can be kept."""
    return 1 / MAX_DISTANCE < value < MAX_DISTANCE


def held_solution(
    task: dict[str, Any], spoken: str = "en", hold: DragHold | None = None, station: int | None = None
) -> AnySolution:
    """The solution of a task in plain data, its constructions drawn when they are first asked for.

    spoken : the language of its texts;  hold : what its drawing keeps
    station : whose velocity plan is asked for

    Raises
    ------
    GraphcamError : it is no task, or there is no such cam
    """
    kept = replace(hold or DragHold(), views={}, names=()).plain()
    return _cached_solution(json.dumps(task), spoken, json.dumps(kept), station)


# Views of one task are asked for one after another, and a drag is told from where the hand took hold.
@lru_cache(maxsize=8)
def _cached_solution(task: str, spoken: str, kept: str, station: int | None) -> AnySolution:
    data, hold = json.loads(task), hold_of(json.loads(kept))
    given, pencil = task_in(data, spoken), pencil_in(data)
    if isinstance(given, ArcsTask):
        return solve_arcs(given, pencil, hold.scales)
    # Its page is dragged by the scale of the cam angle, as worksheets are read by it.
    whole = replace(given, drawing=replace(given.drawing, whole_turn=True))
    board = held_board(board_of(whole), given, hold)
    check_heights(board)
    board = board if station is None else replace(board, station=station)
    done = _drawn_diagrams(_DiagramBoard.of(board)) if pencil.perfect else None
    return solved_on(board, given, pencil, done)


@dataclass(frozen=True)
class _DiagramBoard:
    """A board by what the diagrams of the motion are drawn from, which most sizes leave as it is."""

    key: tuple[Any, ...]
    board: Board = field(compare=False)

    @classmethod
    def of(cls, board: Board) -> _DiagramBoard:
        divided = board.divisions, board.refine, board.jerk_pole, tuple((k, *cuts) for k, cuts in board.finer.items())
        follower = board.follower
        drawn_for = follower.unit, follower.divides_at_corners, follower.constructions
        return cls((board.motion, *divided, board.ordinate, board.poles, board.mu_phi, board.omega, *drawn_for), board)


@lru_cache(maxsize=4)
def _drawn_diagrams(on: _DiagramBoard) -> Mapping[str, Construction]:
    """Acceleration and integrations of a board, and their steps once they are asked for."""
    chain = Chain(on.board)
    return {each.name: replace(each, draw=cache(each.draw)) for each in (chain.acceleration, chain.integration)}


def check_heights(board: Board) -> None:
    """Check that no diagram is so high that its divisions and labels could not be drawn in reasonable time.

    Raises
    ------
    DesignError : one of them is
    """
    first, second = board.poles
    a, v, s = (board.ordinate * height for height in DrawnHeights(board.motion, board.mu_phi).unit)
    if (highest := max(a, v / first, s / (first * second))) > MAX_HEIGHT:
        largest = board.ordinate * MAX_HEIGHT / highest
        limit = say(
            "at most {largest:.3g} mm, so that no diagram is higher than {most:g} mm", largest=largest, most=MAX_HEIGHT
        )
        remedy = say("take a smaller one or leave it out, or lengthen the shortest phase")
        raise DesignError("drawing.ordinate", say("{length:.3g} mm", length=board.ordinate), limit, remedy)


def has_far_centre(solution: AnySolution) -> bool:
    """Whether the cam centre is too far away for the combined diagram, if there is one: its scale is that of s.

    >>> import graphcam as gc
    >>> task = gc.builtin_task().to_dict()
    >>> near, far = (held_solution(task | {"cam": {"prime_radius": radius}}) for radius in (60.0, 2000.0))
    >>> has_far_centre(near), has_far_centre(far)
    (False, True)
    """
    if not isinstance(solution, Solution):
        return False
    board = solution.chain.board
    first, second = board.poles
    height = board.ordinate * DrawnHeights(board.motion, board.mu_phi).unit[2] / (first * second)
    return solution.chain.prime_radius * height / board.motion.lift > CENTRE_SHARE * MAX_HEIGHT


def held_board(board: Board, task: Task, hold: DragHold) -> Board:
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
    return replace(board, ordinate=held.ordinate * (board.motion.reference[1] / held.peak), poles=held.poles)


def diagrams_of(solution: Solution) -> HeldDiagrams:
    """What the diagrams of a solution keep."""
    board, asked = solution.chain.board, solution.task.drawing
    return HeldDiagrams(board.ordinate, board.motion.reference[1], board.poles, (asked.ordinate, asked.poles))


def station_of(drawn: Mapping[str, Construction]) -> int | None:
    """The station whose velocity plan is drawn, None without one."""
    measured = drawn.get("pressure_angle")
    return None if measured is None else shown_station(measured)


def scales_of(solution: AnySolution, shown: dict[str, float]) -> dict[str, float]:
    """The scales that views keep, by name.

    shown : the drawing scales of the views
    """
    if isinstance(solution, Solution):
        return {name: scale for name, scale in shown.items() if is_usable_scale(scale)}
    of_diagrams = {name: scale["per_mm"] for name, scale in solution.scales.items() if name != "phi"}
    return {name: scale for name, scale in {**shown, **of_diagrams}.items() if is_usable_scale(scale)}
