"""The empty axes of a worksheet: how far they reach, and whether a drawing finds room on them."""

from collections.abc import Mapping

import numpy as np

from graphcam.constructions.axes import ordinate, phi_axes
from graphcam.constructions.chain import Chain
from graphcam.constructions.differentiation import VIEWS
from graphcam.constructions.views import ACCELERATION, DISPLACEMENT, VELOCITY
from graphcam.drafting.ink import Step, View
from graphcam.drafting.marks import Line, Role
from graphcam.exercises.definition.exercise import Diagram, Exercise

ROOM: Mapping[Diagram, tuple[str, View, float, float]] = {
    "acceleration": ("a", ACCELERATION, -80.0, 80.0),
    "velocity": ("v", VELOCITY, -80.0, 80.0),
    "displacement": ("s", DISPLACEMENT, 0.0, 140.0),
}
"""Symbol, view, and how far the empty axes reach [mm]: the same for everybody, so that they betray no ordinate."""
BEFORE = 60.0
"""How far the axes begin before the zero where a pole is set, mm: no pole is farther."""
READ: Mapping[Diagram, str] = {"acceleration": "max_a", "velocity": "max_v", "displacement": "s"}
"""The reading that is the greatest ordinate of a diagram, or has it among its values."""
GIVEN: Mapping[str, Diagram] = {"acceleration": "acceleration", "differentiation": "displacement"}
"""The diagram that the first steps of a construction show, where these are given."""


def empty_axes(exercise: Exercise, chain: Chain, name: Diagram) -> Step:
    """The axes to draw a diagram on, and left of them room for the pole."""
    symbol, view, low, high = ROOM[name]
    # Under the measured diagram, which has a cam angle of its own.
    view = VIEWS[symbol] if "differentiation" in exercise.sheet else view
    named = ordinate(symbol, chain.board.follower.unit)
    axes = phi_axes(chain.board.motion, chain.board.mu_phi, np.array([low, high]), named)
    pole = () if name == "displacement" else (Line(np.array([-BEFORE, 0]) + 0j, Role.CONSTRUCTION),)
    return Step(view.title, view.title, view, (*axes, *pole))


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
    derived = any(asked.construction == "differentiation" for asked in exercise.answers)
    shown: list[Diagram] = [*exercise.axes, *(GIVEN[name] for name in exercise.sheet if name in GIVEN)]
    for name in shown:
        _, _, low, high = ROOM[name]
        drawn = chain.differentiation if derived and name != "displacement" else chain.integration
        ordinates = drawn.readings[READ[name]].paper
        if np.min(ordinates) < low or np.max(ordinates) > high:
            return False
    return True
