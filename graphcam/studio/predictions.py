"""Foretell, then construct: the studio's request "predict".

Without a guess the answer says what is shown before and where the guess may move; with one, where the construction
lies, how far apart they are, and why.  A seed draws another task of the same kind first.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from random import Random
from typing import Annotated, Any

from graphcam.constructions.chain import Chain
from graphcam.errors import DesignError, choice_limit
from graphcam.given.follower import FlatFaced, Oscillating, OscillatingFlat, Translating
from graphcam.language import language
from graphcam.solving.solution import Solution
from graphcam.solving.solve import solve
from graphcam.studio.centre_prediction import centre_foretold
from graphcam.studio.curve_predictions import angle_foretold, sharpest_foretold, steepest_foretold
from graphcam.studio.guesses import Prediction
from graphcam.studio.handle import MAX_DISTANCE, on_page, place_of
from graphcam.studio.size_ranges import has_angles
from graphcam.studio.task_paths import changed_task
from graphcam.studio.views_request import TaskRequest, read_request, task_in
from graphcam.tasks.number_limits import Within
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import builtin_task
from graphcam.words import Caption, Tell, say

MAX_SEED = 10**9
MILLIMETRES_CAPTION = say("{size:.1f} mm")
DIFFERENCE_CAPTIONS = {"mm": say("{size:+.1f} mm"), "deg": say("{size:+.1f}°")}
"""How far a guess is off in the machine, by the unit."""
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


DRAWN_LAWS = ("cosine", "cycloidal", "3-4-5", "modified-sine", "rectangular")
SMOOTH_LAWS = ("cycloidal", "3-4-5", "modified-sine")
"""Laws whose acceleration does not jump: under a flat face a jump hides where the profile is sharpest."""
STEEP, SHARP = "limits.pressure_angle_rise", "limits.min_curvature_radius"
SEEDED_TASKS: Mapping[str, tuple[str, Sequence[int], Mapping[str, Sequence[int]]]] = {
    Translating.kind: ("coursework", range(20, 46, 5), {"follower.offset": range(-16, 17, 2), STEEP: range(25, 38)}),
    Oscillating.kind: ("arm", range(12, 19), {STEEP: range(38, 48)}),
    FlatFaced.kind: ("flat", range(20, 36, 5), {SHARP: range(5, 13)}),
    OscillatingFlat.kind: (
        "swinging-face",
        range(6, 11),
        {"follower.face_offset": range(-10, 16, 5), SHARP: range(5, 13)},
    ),
}
"""By the kind of follower a built-in task, and ranges in which one would draw it: of its lift, of sizes by paths."""
RISE_ANGLES, DWELL_ANGLES, RETURN_ANGLES = range(80, 131, 5), range(20, 61, 5), range(70, 121, 5)
"""Cam angles of the first three phases [degrees]; the last dwell is what is left of the turn."""


def seeded_task(kind: str, seed: int) -> dict[str, Any]:
    """The tables of another task with a follower of a kind; its prime radius and roller are left open.

    >>> seeded_task("translating", 7) == seeded_task("translating", 7) != seeded_task("translating", 8)
    True
    """
    chance, (built_in, lifts, ranges) = Random(f"{kind} {seed}"), SEEDED_TASKS[kind]
    task, lift = builtin_task(built_in), float(chance.choice(lifts))
    laws = DRAWN_LAWS if has_angles(task) else SMOOTH_LAWS
    rise, dwell, fall = (float(chance.choice(angles)) for angles in (RISE_ANGLES, DWELL_ANGLES, RETURN_ANGLES))
    phases = [
        {"kind": "rise", "angle": rise, "lift": lift, "law": chance.choice(laws)},
        {"kind": "dwell", "angle": dwell},
        {"kind": "return", "angle": fall, "lift": lift, "law": chance.choice(laws)},
        {"kind": "dwell", "angle": 360.0 - rise - dwell - fall},
    ]
    # Poles and ordinate of the built-in task suit its own angles only.
    open_ = dict.fromkeys(("cam", "limits", "drawing.ordinate", "drawing.poles"))
    sizes = {path: float(chance.choice(values)) for path, values in ranges.items()}
    given = {"rotation": chance.choice(("ccw", "cw")), "motion": {"phases": phases}}
    return changed_task(task.to_dict(), {**open_, **given, **sizes})


def kinds_of(chain: Chain) -> list[str]:
    """What can be foretold of a chain.

    >>> import graphcam as gc
    >>> kinds_of(gc.solve(gc.builtin_task("flat")).chain)
    ['centre', 'sharpest']
    """
    return [name for name, (_, _, has) in PREDICTION_KINDS.items() if has(chain)]


@dataclass(frozen=True, eq=False, kw_only=True)
class PredictRequest(TaskRequest):
    """What is to be foretold of a task, or of another one by a seed, and a guess, ``[x, y]`` in mm of the view."""

    kind: str | None = None
    seed: Annotated[int, Within(0, MAX_SEED)] | None = None
    guess: Any = None


def prediction_answer(request: Mapping[str, Any]) -> dict[str, Any]:
    """The answer to a request "predict"."""
    of = read_request(PredictRequest, request)
    tell, task, solution = language(of.language).text, of.task, solution_of(of.task, of.language)
    if of.seed is not None:
        task = seeded_task(solution.task.follower.kind, of.seed)
        solution = solution_of(task, of.language)
    kinds = kinds_of(solution.chain)
    kind = of.kind or kinds[0]
    if kind not in kinds:
        raise DesignError("kind", kind, *choice_limit(kind, kinds))
    asked = PREDICTION_KINDS[kind][1](solution)
    said = {
        "kind": kind,
        "kinds": [{"kind": name, "title": tell(PREDICTION_KINDS[name][0])} for name in kinds],
        **_prediction_data(asked, tell),
        "task": task,
        "name": SEEDED_TASKS[solution.task.follower.kind][0],
    }
    return said if of.guess is None else said | {"judged": _judged(asked, place_of("guess", of.guess), tell)}


def _prediction_data(asked: Prediction, tell: Tell) -> dict[str, Any]:
    """What the view shows before, and where the guess may move."""
    return {
        "question": tell(asked.question),
        "view": asked.view,
        "given": list(asked.given),
        "construct": [{**asdict(shown), "title": tell(shown.title)} for shown in asked.construct],
        "way": [on_page(place) for place in asked.way.tolist()],
        "free": asked.free,
        "start": on_page(asked.start),
        "pole": None if asked.pole is None else on_page(asked.pole),
    }


def _judged(asked: Prediction, guess: complex, tell: Tell) -> dict[str, Any]:
    place = asked.on_the_way(guess)
    found = asked.judge(place)
    finite = abs(found.machine) < MAX_DISTANCE
    at = {asked.view: (place, found.answer)} | dict(found.beside)
    return {
        "at": {view: {"guess": on_page(mine), "answer": on_page(right)} for view, (mine, right) in at.items()},
        "paper": round(found.paper, 3),
        "paper_said": tell(MILLIMETRES_CAPTION.with_values(size=found.paper)),
        "machine": round(found.machine, 4) if finite else None,
        "machine_said": tell(DIFFERENCE_CAPTIONS[found.unit].with_values(size=found.machine + 0.0)) if finite else "",
        "unit": found.unit,
        "quantity": tell(found.quantity),
        "said": tell(found.said),
        "why": tell(found.why),
    }


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
