"""Draws of the parameters that have no answer key: why, and what the author of the exercise can do about it."""

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Reading
from graphcam.errors import DesignError, GraphcamError
from graphcam.exercises.definition.drawn_answers import construction_of
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.key.mistake_separation import CAREFUL_WORK
from graphcam.words import Caption, say

Kind = Literal["nothing", "mistake", "room", "alike", "sides", "number", "copied", "unlisted"]
MAX_REFUSED_DRAWS = 40
"""Draws after which nobody draws on, if the same was in the way every time and no parameter bears on it."""
MIN_READING_CHANGE = 0.1
"""A reading is proposed that a mistake changes by this part or more."""


@dataclass(frozen=True)
class RefusalReason:
    """A reason why a draw has no answer key.

    kind : the drawing comes to nothing, or the one with a mistake; no room for it; mistakes are alike; careful hands
        name different sides; one number earns too much; the prime radius is right for another radius; a mistake that
        is not listed keeps all marks
    first, second : the mistakes of which it is true, the second also what work without a mistake is called; or the
        answer and the number of the text
    """

    kind: Kind
    first: str = ""
    second: str = ""


@dataclass(frozen=True, eq=False)
class RefusedDraw:
    """A draw without an answer key.

    reasons : what stood in the way
    always : those of them that other parameters hardly change: every answer is the same to the last digit, or as good
        as nought; or that would show in a reading that is not asked
    drawings : of right work, by the name :data:`separation.CAREFUL`, and of every mistake; empty where there are none
    """

    reasons: tuple[RefusalReason, ...]
    always: tuple[RefusalReason, ...] = ()
    drawings: Mapping[str, Chain] | None = None


class Refusals:
    """The draws of one exercise that were turned away so far."""

    def __init__(self, exercise: Exercise) -> None:
        self.exercise = exercise
        self.draws = self.compared = 0
        self.counts: Counter[RefusalReason] = Counter()
        self.certain: Counter[RefusalReason] = Counter()
        self.last: dict[RefusalReason, RefusedDraw] = {}

    def add(self, away: RefusedDraw) -> None:
        """Count one more refused draw."""
        self.draws += 1
        self.compared += away.drawings is not None
        self.counts.update(away.reasons)
        self.certain.update(away.always)
        self.last |= dict.fromkeys(away.reasons, away)

    @property
    def is_hopeless(self) -> bool:
        """Whether no further draw can do better: in all that were drawn to the end stood the same."""
        return self.compared >= MAX_REFUSED_DRAWS and self.compared in self.certain.values()

    def error(self) -> DesignError:
        """The message, on the reason that was there most often; of several, the one that no parameter changes."""
        reason = max(self.counts, key=lambda each: (self.counts[each], self.certain[each]))
        asked = telling(self.last[reason].drawings or {}, reason.first, reason.second, self.exercise)
        remedy = _remedy(reason, self.counts[reason], asked)
        limit = say("diagnosable in {draws} draws", draws=self.draws)
        return DesignError("exercise", self.exercise.name, limit, remedy)


ALIKE = (
    say(
        "in {count} of them '{first}' cannot be told from '{second}'; leave one of the two out, or list the pair in "
        "alike"
    ),
    say(
        "in {count} of them '{first}' cannot be told from '{second}'; ask for {asked}, leave one of the two out, or "
        "list the pair in alike"
    ),
)
NOT_RIGHT = (
    say("in {count} of them '{first}' cannot be told from right work; leave it out or widen the parameters"),
    say("in {count} of them '{first}' cannot be told from right work; ask for {asked} or leave it out"),
)
UNLISTED = (
    say("in {count} of them '{first}', which is not among the misconceptions, keeps all marks; ask for more readings"),
    say("in {count} of them '{first}', which is not among the misconceptions, keeps all marks; ask for {asked} too"),
)
REMEDY_CAPTIONS: Mapping[Kind, Caption] = {
    "nothing": say("in {count} of them nothing can be drawn; change the ranges of the parameters"),
    "mistake": say("in {count} of them nothing can be drawn to the end with '{first}'; leave it out, or ask for less"),
    "room": say(
        "in {count} of them the diagrams do not fit on the worksheet; choose a smaller ordinate or longer poles, or "
        "leave both out"
    ),
    "sides": say("in {count} of them careful work finds an extreme on either side; ask for another reading"),
    "copied": say(
        "in {count} of them '{second}', or a simple multiple of it, is right for the answer '{first}'; ask for "
        "another reading"
    ),
    "number": say(
        "in {count} of them one number, given for every answer, earns more than half of the marks; ask for more "
        "readings, or change their marks"
    ),
}


def _remedy(reason: RefusalReason, count: int, asked: str) -> Caption:
    """What to do about it; ``asked`` is a reading that would tell two drawings apart."""
    alike = (UNLISTED if reason.kind == "unlisted" else NOT_RIGHT if reason.second == CAREFUL_WORK else ALIKE)[
        bool(asked)
    ]
    told = alike if reason.kind in ("alike", "unlisted") else REMEDY_CAPTIONS[reason.kind]
    return told.with_values(count=count, first=reason.first, second=reason.second, asked=asked)


def telling(drawings: Mapping[str, Chain], first: str, second: str, exercise: Exercise) -> str:
    """A reading that two drawings show differently, as an exercise's file asks for it; empty where there is none.

    What the mistake's own construction shows comes first.  What the exercise asks already is not proposed.

    >>> from graphcam.exercises.definition.drawn_answers import board_chain
    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.definition.mistakes import misconception
    >>> from graphcam.exercises.definition.variant import drawn
    >>> exercise = find_exercise("curvature-and-roller")
    >>> right = board_chain(drawn(exercise, "Anna", b"secret", 0).task)
    >>> mistake = "degree-for-radian: integration"
    >>> telling({CAREFUL_WORK: right, mistake: misconception(mistake).change(right)}, mistake, CAREFUL_WORK, exercise)
    'integration.v (of = "scale")'
    """
    if first not in drawings or second not in drawings:
        return ""
    one, other = drawings[first], drawings[second]
    named = first.partition(":")[2].partition(".")[0].strip()
    present = {(asked.construction, asked.reading, asked.of) for asked in exercise.answers}
    for name in sorted(one.names, key=lambda each: each != named):
        try:
            mine, theirs = construction_of(one, name).readings, construction_of(other, name).readings
        except GraphcamError:
            continue
        for reading in (key for key in mine if key in theirs):
            of = _differing_part(mine[reading], theirs[reading])
            if of and (name, reading, of) not in present:
                return f'{name}.{reading} (of = "{of}")'
    return ""


def _differing_part(mine: Reading, theirs: Reading) -> str:
    """What of a reading differs, by the name that an answer asks for it."""
    for of, pair in (("scale", (mine.scale, theirs.scale)), ("paper", (mine.paper, theirs.paper))):
        a, b = (np.asarray(each, dtype=np.float64) for each in pair)
        if a.shape == b.shape and np.nanmax(np.abs(a - b), initial=0.0) > MIN_READING_CHANGE * np.nanmax(
            np.abs(b), initial=0.0
        ):
            return of
    return ""


def of_pairs(pairs: Iterable[tuple[str, str]]) -> tuple[RefusalReason, ...]:
    """The reasons for refusing a draw, from pairs of works that look alike.

    >>> of_pairs([("careful", "offset-sign")])
    (RefusalReason(kind='alike', first='offset-sign', second='careful'),)
    """
    return tuple(RefusalReason("alike", *((b, a) if a == CAREFUL_WORK else (a, b))) for a, b in pairs)
