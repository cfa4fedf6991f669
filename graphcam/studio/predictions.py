"""Foretell, then construct: the studio's request "predict".

Without a guess the answer says what is shown before and where the guess may move; with one, where the construction
lies, how far apart they are, and why.  A seed draws another task of the same kind first.
"""

import hashlib
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from graphcam.constructions.chain import Chain
from graphcam.errors import DesignError, choice_limit
from graphcam.given.follower import FlatFaced, Oscillating, OscillatingFlat, Translating
from graphcam.language import language
from graphcam.solving.solution import Solution
from graphcam.solving.solve import solve
from graphcam.studio.centre_prediction import centre_foretold
from graphcam.studio.curve_predictions import angle_foretold, sharpest_foretold, steepest_foretold
from graphcam.studio.guesses import JudgedGuess, Prediction, ShownStep
from graphcam.studio.views_request import number, optional_value, optional_whole_number, task_data, task_in
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import builtin_task
from graphcam.words import Caption, Tell, say

MAX_SEED = 10**9
MILLIMETRES_CAPTION = say("{size:.1f} mm")
DIFFERENCE_CAPTIONS = {"mm": say("{size:+.1f} mm"), "deg": say("{size:+.1f}°")}
"""How far a guess is off in the machine, by the unit."""
MAX_DISTANCE = 1e5
"""A guess lies no farther away [mm]."""
PREDICTION_KINDS: Mapping[str, tuple[Caption, Callable[[Solution], Prediction], Callable[[Chain], bool]]] = {
    "centre": (
        say("The cam centre"),
        lambda solution: centre_foretold(solution.chain),
        lambda chain: "need" in chain.minimum_radius.readings or "centre" in chain.minimum_radius.acts,
    ),
    "angle": (
        say("The maximum pressure angle"),
        lambda solution: angle_foretold(solution.chain),
        lambda chain: "s0" in chain.minimum_radius.readings,
    ),
    "steepest": (
        say("Where the pressure angle has its maximum"),
        lambda solution: steepest_foretold(solution.chain),
        lambda chain: "angle_diagram" in chain.names,
    ),
    "sharpest": (say("The sharpest point"), sharpest_foretold, lambda chain: True),
}
"""What can be foretold: its name, the question of a solution, and whether a chain has it."""


BASE_TASKS = {
    Translating.kind: "coursework",
    Oscillating.kind: "arm",
    FlatFaced.kind: "flat",
    OscillatingFlat.kind: "swinging-face",
}
"""The built-in task of each kind of follower."""
DRAWN_LAWS = ("cosine", "cycloidal", "3-4-5", "modified-sine", "rectangular")
SMOOTH_LAWS = ("cycloidal", "3-4-5", "modified-sine")
"""Laws whose acceleration does not jump: under a flat face a jump hides where the profile is sharpest."""
SIZE_RANGES: Mapping[str, Mapping[str, Sequence[float | str]]] = {
    Translating.kind: {
        "offset": range(-16, 17, 2),
        "limit": range(25, 38),
        "lift": range(20, 46, 5),
        "laws": DRAWN_LAWS,
    },
    Oscillating.kind: {"limit": range(38, 48), "lift": range(12, 19), "laws": DRAWN_LAWS},
    FlatFaced.kind: {"curvature": range(5, 13), "lift": range(20, 36, 5), "laws": SMOOTH_LAWS},
    OscillatingFlat.kind: {
        "face_offset": range(-10, 16, 5),
        "curvature": range(5, 13),
        "lift": range(6, 11),
        "laws": SMOOTH_LAWS,
    },
}
"""Ranges in which one would draw the cam oneself."""
RISE_ANGLES, DWELL_ANGLES, RETURN_ANGLES = range(80, 131, 5), range(20, 61, 5), range(70, 121, 5)
"""Cam angles of the first three phases [degrees]; the last dwell is what is left of the turn."""


class SeededDraws:
    """Whole numbers out of a seed, one after another.

    >>> SeededDraws("a").one_of(range(10)) == SeededDraws("a").one_of(range(10))
    True
    """

    def __init__(self, seed: str) -> None:
        self._left = int.from_bytes(hashlib.sha512(seed.encode()).digest())

    def one_of(self, values: Sequence[Any]) -> Any:
        """A randomly drawn value of several."""
        self._left, place = divmod(self._left, len(values))
        return values[place]


def seeded_task(kind: str, seed: int) -> dict[str, Any]:
    """The tables of another task with a follower of a kind; its prime radius and roller are left open.

    >>> seeded_task("translating", 7) == seeded_task("translating", 7) != seeded_task("translating", 8)
    True
    """
    draws, sizes = SeededDraws(f"{kind} {seed}"), SIZE_RANGES[kind]
    task = builtin_task(BASE_TASKS[kind]).to_dict()
    lift, law, back = draws.one_of(sizes["lift"]), draws.one_of(sizes["laws"]), draws.one_of(sizes["laws"])
    rise, dwell, fall = (float(draws.one_of(angles)) for angles in (RISE_ANGLES, DWELL_ANGLES, RETURN_ANGLES))
    rest = 360.0 - rise - dwell - fall
    task["rotation"] = draws.one_of(("ccw", "cw"))
    task["motion"] = {
        "phases": [
            {"kind": "rise", "angle": rise, "lift": float(lift), "law": law},
            {"kind": "dwell", "angle": dwell},
            {"kind": "return", "angle": fall, "lift": float(lift), "law": back},
            {"kind": "dwell", "angle": rest},
        ]
    }
    # Poles and ordinate of the built-in task suit its own angles only.
    task["drawing"] = {key: value for key, value in task["drawing"].items() if key not in ("ordinate", "poles")}
    task["cam"] = {}
    for size in ("offset", "face_offset"):
        if size in sizes:
            task["follower"][size] = float(draws.one_of(sizes[size]))
    if "curvature" in sizes:
        task["limits"] = {"min_curvature_radius": float(draws.one_of(sizes["curvature"]))}
    else:
        task["limits"] = {"pressure_angle_rise": float(draws.one_of(sizes["limit"]))}
    return task


def kinds_of(chain: Chain) -> list[str]:
    """What can be foretold of a chain.

    >>> import graphcam as gc
    >>> kinds_of(gc.solve(gc.builtin_task("flat")).chain)
    ['centre', 'sharpest']
    """
    return [name for name, (_, _, has) in PREDICTION_KINDS.items() if has(chain)]


def prediction_answer(request: Mapping[str, Any]) -> dict[str, Any]:
    """The answer to a request "predict"."""
    spoken = optional_value(request, "language", str, "en")
    tell, task = language(spoken).text, task_data(request)
    seed = optional_whole_number(request, "seed", None, 0, MAX_SEED)
    solution = solution_of(task, spoken)
    if seed is not None:
        kind_of_follower = solution.task.follower.kind
        task = seeded_task(kind_of_follower, seed)
        solution = solution_of(task, spoken)
    kinds = kinds_of(solution.chain)
    kind = request.get("kind") or kinds[0]
    if kind not in kinds:
        raise DesignError("kind", kind, *choice_limit(kind, kinds))
    asked = PREDICTION_KINDS[kind][1](solution)
    said = {
        "kind": kind,
        "kinds": [{"kind": name, "title": tell(PREDICTION_KINDS[name][0])} for name in kinds],
        **_prediction_data(asked, tell),
        "task": task,
        "name": BASE_TASKS[solution.task.follower.kind],
    }
    guess = optional_value(request, "guess", list, None)
    return said if guess is None else said | {"judged": _judged(asked, _place(guess), tell)}


def _place(guess: list[Any]) -> complex:
    """A guess in the view's millimetres as a place of the construction."""
    if len(guess) != 2:
        raise DesignError("guess", len(guess), say("two numbers, x and y [mm of the view]"))
    x, y = (number({"guess": each}, "guess", math.nan, -MAX_DISTANCE, MAX_DISTANCE) for each in guess)
    if math.isnan(x + y):
        raise DesignError("guess", say("missing"), say("two numbers, x and y [mm of the view]"))
    return complex(x, -y)


def _prediction_data(asked: Prediction, tell: Tell) -> dict[str, Any]:
    """What the view shows before, and where the guess may move."""
    return {
        "question": tell(asked.question),
        "view": asked.view,
        "given": list(asked.given),
        "construct": [_plain_step(shown, tell) for shown in asked.construct],
        "way": _in_view(asked.way),
        "free": asked.free,
        "start": _in_view([asked.start])[0],
        "pole": None if asked.pole is None else _in_view([asked.pole])[0],
    }


def _plain_step(shown: ShownStep, tell: Tell) -> dict[str, str]:
    return {"view": shown.view, "step": shown.step, "title": tell(shown.title)}


def _judged(asked: Prediction, guess: complex, tell: Tell) -> dict[str, Any]:
    place = asked.on_the_way(guess)
    found: JudgedGuess = asked.judge(place)
    finite = abs(found.machine) < MAX_DISTANCE
    at = {asked.view: (place, found.answer)} | dict(found.beside)
    return {
        "at": {view: dict(zip(("guess", "answer"), _in_view(pair), strict=True)) for view, pair in at.items()},
        "paper": round(found.paper, 3),
        "paper_said": tell(MILLIMETRES_CAPTION.with_values(size=found.paper)),
        "machine": round(found.machine, 4) if finite else None,
        "machine_said": tell(DIFFERENCE_CAPTIONS[found.unit].with_values(size=found.machine + 0.0)) if finite else "",
        "unit": found.unit,
        "quantity": tell(found.quantity),
        "said": tell(found.said),
        "why": tell(found.why),
    }


def _in_view(places: Sequence[complex] | Any) -> list[list[float]]:
    """Places in the view's millimetres, y down."""
    return [[round(float(place.real), 3), round(-float(place.imag) + 0.0, 3)] for place in places]


def solution_of(task: dict[str, Any], spoken: str) -> Solution:
    """The task of plain data, solved.

    Raises
    ------
    GraphcamError : it is none, or a cam of arcs, whose construction has nothing to foretell
    """
    found = task_in(task, spoken)
    if not isinstance(found, Task):
        shown = say("a cam of arcs")
        raise DesignError("task", shown, say("one with phases of motion"), say("take another task to predict"))
    return solve(found)
