"""Why draws of the parameters have no answer key, counted for a message on what the exercise's author may change."""

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
from graphcam.exercises.key.separation import CAREFUL
from graphcam.words import Caption, say

Kind = Literal["nothing", "mistake", "room", "alike", "sides", "number"]
ENOUGH = 40
"""Draws after which nobody draws on, if the same was in the way every time and no parameter bears on it."""
CLEARLY = 0.1
"""A reading is proposed that a mistake changes by this part or more."""


@dataclass(frozen=True)
class Reason:
    """A reason why a draw has no answer key.

    kind : the drawing comes to nothing, or the one with a mistake; no room for it; mistakes are alike; careful hands
        name different sides; one number earns too much
    first, second : the mistakes of which it is true, the second also what work without a mistake is called
    """

    kind: Kind
    first: str = ""
    second: str = ""


@dataclass(frozen=True, eq=False)
class TurnedAway:
    """A draw without an answer key.

    reasons : what stood in the way
    always : those of them that other parameters hardly change: every answer is the same to the last digit, or as good
        as nought
    drawings : of right work, by the name :data:`separation.CAREFUL`, and of every mistake; empty where there are none
    """

    reasons: tuple[Reason, ...]
    always: tuple[Reason, ...] = ()
    drawings: Mapping[str, Chain] | None = None


class Refusals:
    """The draws of one exercise that were turned away so far."""

    def __init__(self, exercise: Exercise) -> None:
        self.exercise = exercise
        self.draws = self.compared = 0
        self.counts: Counter[Reason] = Counter()
        self.certain: Counter[Reason] = Counter()
        self.last: dict[Reason, TurnedAway] = {}

    def add(self, away: TurnedAway) -> None:
        """Count one more."""
        self.draws += 1
        self.compared += away.drawings is not None
        self.counts.update(away.reasons)
        self.certain.update(away.always)
        self.last |= dict.fromkeys(away.reasons, away)

    @property
    def hopeless(self) -> bool:
        """Whether no further draw can do better: in all that were drawn to the end stood the same."""
        return self.compared >= ENOUGH and self.compared in self.certain.values()

    def error(self) -> DesignError:
        """The message, on the reason that was there most often; of several, the one that no parameter changes."""
        reason = max(self.counts, key=lambda each: (self.counts[each], self.certain[each]))
        asked = telling(self.last[reason].drawings or {}, reason.first, reason.second)
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
REMEDIES: Mapping[Kind, Caption] = {
    "nothing": say("in {count} of them nothing can be drawn; change the ranges of the parameters"),
    "mistake": say("in {count} of them nothing can be drawn to the end with '{first}'; leave it out, or ask for less"),
    "room": say(
        "in {count} of them the diagrams do not fit on the worksheet; choose a smaller ordinate or longer poles, or "
        "leave both out"
    ),
    "sides": say("in {count} of them careful work finds an extreme on either side; ask for another reading"),
    "number": say(
        "in {count} of them one number, given for every answer, earns more than half of the marks; ask for more "
        "readings, or change their marks"
    ),
}


def _remedy(reason: Reason, count: int, asked: str) -> Caption:
    """What to do about it; ``asked`` is a reading that would tell two drawings apart."""
    alike = (NOT_RIGHT if reason.second == CAREFUL else ALIKE)[bool(asked)]
    told = alike if reason.kind == "alike" else REMEDIES[reason.kind]
    return told.where(count=count, first=reason.first, second=reason.second, asked=asked)


def telling(drawings: Mapping[str, Chain], first: str, second: str) -> str:
    """A reading that two drawings show differently, as an exercise's file asks for it; empty where there is none.

    What the mistake's own construction shows comes first.

    >>> from graphcam.exercises.definition.drawn_answers import board_chain
    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.definition.mistakes import misconception
    >>> from graphcam.exercises.definition.variant import drawn
    >>> right = board_chain(drawn(find_exercise("integration"), "Anna", b"secret", 0).task)
    >>> mistake = "degree-for-radian: integration"
    >>> telling({CAREFUL: right, mistake: misconception(mistake).change(right)}, mistake, CAREFUL)
    'integration.v (of = "scale")'
    """
    if first not in drawings or second not in drawings:
        return ""
    one, other = drawings[first], drawings[second]
    named = first.partition(":")[2].partition(".")[0].strip()
    for name in sorted(one.names, key=lambda each: each != named):
        try:
            mine, theirs = construction_of(one, name).readings, construction_of(other, name).readings
        except GraphcamError:
            continue
        for reading in (key for key in mine if key in theirs):
            if of := _differs(mine[reading], theirs[reading]):
                return f'{name}.{reading} (of = "{of}")'
    return ""


def _differs(mine: Reading, theirs: Reading) -> str:
    """What of a reading differs, by the name that an answer asks for it."""
    for of, pair in (("scale", (mine.scale, theirs.scale)), ("paper", (mine.paper, theirs.paper))):
        a, b = (np.asarray(each, dtype=np.float64) for each in pair)
        if a.shape == b.shape and np.nanmax(np.abs(a - b), initial=0.0) > CLEARLY * np.nanmax(np.abs(b), initial=0.0):
            return of
    return ""


def of_pairs(pairs: Iterable[tuple[str, str]]) -> tuple[Reason, ...]:
    """Each of these pairs as a reason.

    >>> of_pairs([("careful", "offset-sign")])
    (Reason(kind='alike', first='offset-sign', second='careful'),)
    """
    return tuple(Reason("alike", *((b, a) if a == CAREFUL else (a, b))) for a, b in pairs)
