"""The empty axes of a worksheet: how far they reach, and whether a drawing finds room on them."""

from collections.abc import Mapping

import numpy as np

from graphcam.constructions.axes import AXIS_OVERHANG, axes_over_phi, ordinate_title, phase_ends, phi_axes
from graphcam.constructions.chain import Chain
from graphcam.constructions.differentiation import DIAGRAM_VIEWS
from graphcam.constructions.views import ACCELERATION, DISPLACEMENT, VELOCITY
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Step, View
from graphcam.drafting.marks import Label, Line, Mark, Role, Segments
from graphcam.exercises.definition.exercise import Diagram, Exercise
from graphcam.exercises.definition.marked_formats import format_of
from graphcam.given.laid_outline import GivenCamMotion
from graphcam.given.motion import FULL_TURN

AXES_ROOM: Mapping[Diagram, tuple[str, View, float, float]] = {
    "acceleration": ("a", ACCELERATION, -80.0, 80.0),
    "velocity": ("v", VELOCITY, -80.0, 80.0),
    "displacement": ("s", DISPLACEMENT, 0.0, 140.0),
}
"""Symbol, view, and how far the empty axes reach [mm]: the same for everybody, so that they betray no ordinate."""
POLE_ROOM = 60.0
"""How far the axes begin before the zero where a pole is set, mm: no pole is farther."""
MARKED_REACH: Mapping[str, tuple[Mapping[Diagram, tuple[float, float]], float]] = {
    "A1": ({"acceleration": (-84.0, 84.0), "velocity": (-84.0, 84.0), "displacement": (0.0, 144.0)}, POLE_ROOM),
    "A3": ({"acceleration": (-43.0, 43.0), "velocity": (-44.0, 44.0), "displacement": (0.0, 64.0)}, 45.0),
    "A4": ({"acceleration": (-38.0, 38.0), "velocity": (-42.0, 42.0), "displacement": (0.0, 42.0)}, 30.0),
}
"""The reach of the axes by format, and how far they begin before the zero, on worksheets that are made to be
photographed: so that the three diagrams stand on one page, one under the other, as parallels are carried over [mm]."""
CURVE_CLEARANCE = 2.0
"""The gap between a curve that is read off a photograph and the end of its room, mm."""
DWELL_ROOM = 3.0
"""What the room has below an axis at its lower end, on which dwells are drawn, mm."""
GREATEST_READINGS: Mapping[Diagram, str] = {"acceleration": "max_a", "velocity": "max_v", "displacement": "s"}
"""The reading that is the greatest ordinate of a diagram, or has it among its values."""
GIVEN_DIAGRAMS: Mapping[str, Diagram] = {"acceleration": "acceleration", "differentiation": "displacement"}
"""The diagram that the first steps of a construction show, where these are given."""


def reach_of(exercise: Exercise, name: Diagram) -> tuple[float, float]:
    """How far below and above the zero the empty axes of a diagram reach [mm]."""
    return MARKED_REACH[format_of(exercise.paper)][0][name] if exercise.paper else AXES_ROOM[name][2:]


def room_of(exercise: Exercise, name: Diagram) -> tuple[float, float]:
    """How far the room of a diagram that is photographed reaches below and above the zero [mm]."""
    low, high = reach_of(exercise, name)
    return min(low, -DWELL_ROOM), high


def empty_axes(exercise: Exercise, chain: Chain, name: Diagram) -> Step:
    """The axes to draw a diagram on, and left of them room for the pole."""
    (symbol, view, *_), (low, high) = AXES_ROOM[name], reach_of(exercise, name)
    named, board, heights = ordinate_title(symbol, chain.board.follower.unit), chain.board, np.array([low, high])
    axes = phi_axes(board.motion, board.stations, board.mu_phi, heights, named)
    if _is_differentiated(exercise):
        # With lines at quarters of the turn: where the phases of a given cam end is not to be seen.
        view, turn = DIAGRAM_VIEWS[symbol], FULL_TURN / board.mu_phi.per_mm
        quarters = turn * np.arange(1, 5) / 4
        lines = Segments(quarters + low * UP, quarters + high * UP, Role.CONSTRUCTION)
        axes = (*axes_over_phi(turn, board.mu_phi, heights, named), lines)
    pole = () if name == "displacement" else (Line(np.array([-POLE_ROOM, 0]) + 0j, Role.CONSTRUCTION),)
    return Step(view.title, (), view, (*axes, *pole))


def _is_differentiated(exercise: Exercise) -> bool:
    """Whether the diagrams are those of a differentiation."""
    return any(asked.construction == "differentiation" for asked in exercise.answers)


def marked_axes(exercise: Exercise, chain: Chain, name: Diagram) -> tuple[View, tuple[Mark, ...], float]:
    """The axes without texts, and no mark beyond their room; the view, the marks, and how far left they begin [mm]."""
    (low, high), before = reach_of(exercise, name), MARKED_REACH[format_of(exercise.paper)][1]
    board, step = chain.board, empty_axes(exercise, chain, name)
    ends = phase_ends(board.motion, board.mu_phi)
    axes = axes_over_phi(ends[-1], board.mu_phi, np.array([low, high - AXIS_OVERHANG]), "")
    lines = Segments(ends[1:] + low * UP, ends[1:] + high * UP, Role.CONSTRUCTION)
    pole = () if name == "displacement" else (Line(np.array([-before, 0]) + 0j, Role.CONSTRUCTION),)
    return step.view, (*(mark for mark in axes if not isinstance(mark, Label)), lines, *pole), before


def finds_room(exercise: Exercise, chain: Chain) -> bool:
    """Whether the diagrams, drawn or given, stay within the axes of the worksheet: on larger ones it is not to scale.

    chain : drawn by a perfect hand

    >>> from graphcam.exercises.definition.drawn_answers import board_chain
    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.definition.variant import fill_in
    >>> exercise = find_exercise("acceleration-and-scales")
    >>> given = {name: parameter.values[0] for name, parameter in exercise.parameters.items()}
    >>> tasks = [fill_in(exercise, given | {"rise": rise, "back": 110}) for rise in (100, 140)]
    >>> [finds_room(exercise, board_chain(task)) for task in tasks]
    [True, False]
    """
    derived = _is_differentiated(exercise)
    shown: list[Diagram] = [
        *exercise.axes,
        *(GIVEN_DIAGRAMS[name] for name in exercise.sheet if name in GIVEN_DIAGRAMS),
    ]
    for name in shown:
        if name == "displacement" and isinstance(chain.board.motion, GivenCamMotion):
            continue  # carried over with the dividers, as often as it finds room
        (low, high), clear = reach_of(exercise, name), CURVE_CLEARANCE if exercise.paper else 0.0
        drawn = chain.differentiation if derived and name != "displacement" else chain.integration
        ordinates = drawn.readings[GREATEST_READINGS[name]].paper
        if np.min(ordinates) < min(low + clear, 0.0) or np.max(ordinates) > high - clear:
            return False
    return True
