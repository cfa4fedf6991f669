"""Where a student's construction first goes off: the step, the notebook on it, and the drawing as it stands before.

The drawing holds nothing of an answer that was not given right: it ends before the first step that shows any of them.
Only where what is right may be shown, it has the step that is off as well.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.drafting.act_order import all_places, sources
from graphcam.drafting.acts import Act, Drawn, Kind
from graphcam.drafting.ink import Construction, Step
from graphcam.drafting.marks import Points
from graphcam.exercises.definition.drawn_answers import board_chain, construction_of, per_mm
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.variant import fill_in
from graphcam.words import Tell, Words

WRONG_OUTCOMES = ("wrong", "partial", "unreadable")
NOTEBOOK_NUMBERS = {
    "acceleration": 1,
    "integration": 2,
    "differentiation": 2,
    "pressure_angle": 3,
    "minimum_radius": 4,
    "inversion": 5,
    "working_profile": 6,
    "curvature": 6,
    "roller": 6,
}
"""The course's notebook that explains a construction, by the number that its name begins with."""
PASSING_KINDS = (Kind.READ, Kind.TAKE, Kind.PROJECT, Kind.TANGENT, Kind.FAIR, Kind.ENLARGE)
"""What adds no place of its own: where it starts from tells as much as what it leaves."""
TRACED_KINDS = (*PASSING_KINDS, Kind.JOIN)
"""A line is told by its ends as well, though it is a step of its own."""
GIVEN_KINDS = (Kind.GIVEN, Kind.DIVIDE)
VIEW_RADIUS = 500.0
"""A distance beyond every view [mm of paper]."""
DECIMALS_PATTERN = re.compile(r"\d+\.\d\d")


@dataclass(frozen=True)
class StepPicture:
    """A construction as far as it may be shown, in mm of paper as SVG has them.

    drawn : elements of SVG;  own : what the student answered as points "x,y x,y ...", empty where it has no place
    joined : whether these are a line
    """

    width: float
    height: float
    drawn: str
    own: str
    joined: bool


@dataclass(frozen=True)
class StepOff:
    """The first step that is off.

    construction, step : their titles;  notebook : its number, 0 where none is about it
    picture : None where nothing is drawn before that step
    told : whether the picture has that step as well, as it should be
    """

    answer: str
    construction: Words
    step: Words
    notebook: int
    picture: StepPicture | None
    told: bool


def first_step_off(exercise: Exercise, record: dict[str, Any], *, right: bool = False) -> StepOff | None:
    """The step of a record that is off first; None where none is, or where the variant is not known.

    right : whether what is right may be shown
    """
    # What draws is for the pages alone; grading starts without it.
    from graphcam.plots.step_board import ancestors

    marked = list(zip(exercise.answers, record["answers"], strict=True))
    asked, answer = next(((each, own) for each, own in marked if own["outcome"] in WRONG_OUTCOMES), (None, None))
    if asked is None or answer is None or not record["parameters"]:
        return None
    chain = board_chain(fill_in(exercise, record["parameters"]))
    construction = construction_of(chain, asked.construction)
    steps = construction.steps()
    off = first_step_showing(construction, asked, PASSING_KINDS)
    hidden = [] if right else [each for each, own in marked if own["outcome"] != "right"]
    within = [first_step_showing(construction, each) for each in hidden if each.construction == asked.construction]
    last = min(within, default=off + 1)
    closed = {each.construction for each in hidden}
    before = [step for each in ancestors(construction) if each.name not in closed for step in each.steps()]
    own, joined = _own_points(chain, asked, answer["given"]), asked.kind != "points"
    shown = _picture(before, steps[:last], exercise.tell, own, joined=joined) if last else None
    notebook = NOTEBOOK_NUMBERS.get(construction.name, 0)
    return StepOff(asked.name, construction.meaning.title, steps[off].title, notebook, shown, right)


def first_step_showing(construction: Construction, asked: AskedAnswer, through: tuple[Kind, ...] = TRACED_KINDS) -> int:
    """The index of the first step that shows where an answer is read, or what it is read from.

    through : kinds of acts behind which it is looked for
    """
    steps = construction.steps()
    found = [k for k, step in enumerate(steps) if asked.reading in step.reads]
    if asked.reading:
        start = construction.readings[asked.reading].act
    else:
        left: Any = construction.acts.get(asked.points)
        start = left.act if isinstance(left, Drawn) else left
    acts = set(_unchanged_sources(start, through)) if isinstance(start, Act) else set[Act]()
    found += [k for k, step in enumerate(steps) for mark in step.marks if mark.of in acts]
    # What is known of no step is shown by the first.
    return min(found, default=0)


def _unchanged_sources(act: Act, through: tuple[Kind, ...]) -> Iterator[Act]:
    """An act, and the acts that its places come from unchanged."""
    waiting, known = [act], {act}
    while waiting:
        each = waiting.pop()
        yield each
        if each.kind in through:
            behind = {piece.act for piece in sources(all_places(each), scales=False)} - known
            known |= behind
            waiting += [one for one in behind if one.kind not in GIVEN_KINDS]


def _picture(
    before: Sequence[Step], steps: Sequence[Step], tell: Tell, own: Points, *, joined: bool
) -> StepPicture | None:
    from graphcam.plots.step_board import StepBoard
    from graphcam.sheets.player_svg import group_svg

    views = {step.view.name for step in steps if step.marks}
    if not views:
        return None
    told = tuple(step.translated(tell) for step in steps)
    former = tuple(step.translated(tell) for step in before if step.view.name in views)
    board = StepBoard(former, told)
    page = board.page(len(told) - 1)
    drawn = "".join(group_svg(group, page.height) for group in page.groups)
    # A tenth of a millimetre is enough for a picture, and measuring in it tells less.
    drawn = DECIMALS_PATTERN.sub(lambda number: f"{float(number[0]):.1f}", drawn)
    # In several views it is not known to which of them a place belongs.
    at = board.origin + board.factor * own if len(views) == 1 else own[:0]
    said = " ".join(f"{z.real:.1f},{page.height - z.imag:.1f}" for z in at)
    return StepPicture(page.width, page.height, drawn, said, joined)


def _own_points(chain: Chain, asked: AskedAnswer, given: Any) -> Points:
    """What can be marked of a student's answer in the view (n,): its points, of a coordinate a line across the view."""
    if isinstance(given, list):
        return np.array([complex(x, y) for x, y in given])
    coordinate = asked.component or asked.reading
    if given is None or asked.of == "scale" or coordinate not in ("x", "y"):
        return np.empty(0, dtype=np.complex128)
    length = given / per_mm(chain, asked) if asked.of == "value" else given
    across = np.array([-VIEW_RADIUS, VIEW_RADIUS])
    return length + 1j * across if coordinate == "x" else across + 1j * length
