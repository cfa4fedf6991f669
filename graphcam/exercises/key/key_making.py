"""Making an answer key: the variant drawn by a perfect hand, by many careful ones, and with every mistake.

Parameters are drawn until every catalogued mistake can be told, and until no one number is right in most answers.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Reading
from graphcam.errors import DesignError, GraphcamError
from graphcam.exercises.definition.blank_axes import finds_room
from graphcam.exercises.definition.drawn_answers import board_chain, construction_of
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.exercises.key.answer_key import AnswerKey, Hypothesis, Key
from graphcam.exercises.key.answer_scatter import answers_of, bulges_of, deviations, distances, expected, torn
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.key.mistake_separation import (
    CAREFUL_WORK,
    MistakeError,
    PerfectHands,
    endless,
    forbidden,
    have_same_answers,
    hypotheses,
    inseparable_pairs,
    out_of_sight,
    passing,
    perfect_hands,
    plainly_alike,
)
from graphcam.exercises.key.redrawing import dependences
from graphcam.words import Caption, say

MAX_COINCIDENCE_SHARE = 0.5
"""The maximum part of all marks that one number, or a copy of another variant, may have."""


def by_one_number(exercise: Exercise, keys: Sequence[Expected], tolerances: Sequence[float]) -> float:
    """The largest part of all marks that one number earns by being right in two answers or more.

    It is handed in with the sign that each answer wants.  What is drawn, a number does not earn.

    keys, tolerances : of every answer, in the order of the exercise and in the unit of the answer

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> exercise = find_exercise("pressure-angle")
    >>> keys = [Expected(value, 0.5) for value in (60.0, 30.0, -31.5, 25.0, 20.0, 10.0, -5.0)]
    >>> by_one_number(exercise, keys, [1.0] * 7)  # the second and the third, of 2 marks of 8
    0.25
    """
    sizes = [
        (abs(float(key.value)), most, asked.marks)
        for asked, key, most in zip(exercise.answers, keys, tolerances, strict=True)
        if asked.kind == "number"
    ]
    # Wherever some tolerances overlap, they do so at the upper end of one of them.
    together = [
        [marks for size, most, marks in sizes if size - most <= edge + reach <= size + most] for edge, reach, _ in sizes
    ]
    return max((sum(earned) for earned in together if len(earned) > 1), default=0.0) / exercise.marks


Kind = Literal["nothing", "mistake", "room", "alike", "sides", "number"]
MAX_REFUSED_DRAWS = 40
"""Draws after which nobody draws on, if the same was in the way every time and no parameter bears on it."""
MIN_READING_CHANGE = 0.1
"""A reading is proposed that a mistake changes by this part or more."""


@dataclass(frozen=True)
class RefusalReason:
    """A reason why a draw has no answer key.

    kind : the drawing comes to nothing, or the one with a mistake; no room for it; mistakes are alike; careful hands
        name different sides; one number earns too much
    first, second : the mistakes of which it is true, the second also what work without a mistake is called
    """

    kind: Kind
    first: str = ""
    second: str = ""


@dataclass(frozen=True, eq=False)
class RefusedDraw:
    """A draw without an answer key.

    reasons : what stood in the way
    always : those of them that other parameters hardly change: every answer is the same to the last digit, or as good
        as nought
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
REMEDY_CAPTIONS: Mapping[Kind, Caption] = {
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


def _remedy(reason: RefusalReason, count: int, asked: str) -> Caption:
    """What to do about it; ``asked`` is a reading that would tell two drawings apart."""
    alike = (NOT_RIGHT if reason.second == CAREFUL_WORK else ALIKE)[bool(asked)]
    told = alike if reason.kind == "alike" else REMEDY_CAPTIONS[reason.kind]
    return told.with_values(count=count, first=reason.first, second=reason.second, asked=asked)


def telling(drawings: Mapping[str, Chain], first: str, second: str) -> str:
    """A reading that two drawings show differently, as an exercise's file asks for it; empty where there is none.

    What the mistake's own construction shows comes first.

    >>> from graphcam.exercises.definition.drawn_answers import board_chain
    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> from graphcam.exercises.definition.mistakes import misconception
    >>> from graphcam.exercises.definition.variant import drawn
    >>> right = board_chain(drawn(find_exercise("integration"), "Anna", b"secret", 0).task)
    >>> mistake = "degree-for-radian: integration"
    >>> telling({CAREFUL_WORK: right, mistake: misconception(mistake).change(right)}, mistake, CAREFUL_WORK)
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
            if of := _differing_part(mine[reading], theirs[reading]):
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


HAND_COUNT = 2000
"""Careful hands behind the tolerances."""
LOSS_RATE_MARGIN = 0.6
"""The bound is set for this part of the permitted rate of losses: a rate from finitely many hands is uncertain."""
MAX_DRAWS = 400
"""Draws after which an exercise is held to have no variant that can be diagnosed."""


def key_or_reason(variant: Variant) -> AnswerKey | RefusedDraw:
    """The answer key of a variant, or why it has none: its answers cannot tell every mistake from every other.

    Named together are those that the exercise lets be alike.  A variant has no key either whose diagrams find no room
    on the worksheet, or in which one number handed in for all answers earns more than half of the marks.  What is
    quickly found out comes first: of several draws most are turned away.

    Raises
    ------
    DesignError : a careful hand comes to nothing with it
    """
    found = _drawn_or_refused(variant)
    if isinstance(found, RefusedDraw):
        return found
    exercise, drawn = variant.exercise, found
    chains = {CAREFUL_WORK: drawn.right, **drawn.wrong}
    wrong = hypotheses(exercise, drawn)
    not_told = inseparable_pairs(exercise, wrong)
    if pairs := forbidden(exercise, not_told):
        return RefusedDraw(of_pairs(pairs), drawings=chains)
    hands = answers_of(exercise, drawn.right.by(exercise.hand.pencil(HAND_COUNT)))
    if torn(exercise, drawn.right, hands):
        return RefusedDraw((RefusalReason("sides"),))
    far = distances(exercise, drawn.answers, hands)
    keys = expected(exercise, drawn.answers, far, drawn.lengths, bulges_of(exercise, drawn.right))
    off = deviations(exercise, keys, far)
    bound = float(np.quantile(off.max(axis=1), 1 - LOSS_RATE_MARGIN * exercise.careful))
    tolerances = [bound * float(np.max(key.scatter)) for key in keys]
    if pairs := passing(exercise, keys, wrong, bound):
        certain = (pair for pair in pairs if out_of_sight(exercise, keys, wrong[pair[0]], bound))
        return RefusedDraw(of_pairs(pairs), of_pairs(certain), chains)
    if by_one_number(exercise, keys, tolerances) > MAX_COINCIDENCE_SHARE:
        return RefusedDraw((RefusalReason("number"),))
    # Not by their standard deviation, which rounding keeps from nought.
    by_hand = [bool(np.any(samples != samples[0])) for samples in hands]
    rows = zip(exercise.answers, keys, tolerances, drawn.lengths, by_hand, strict=True)
    return AnswerKey(
        *(exercise.name, exercise.version, variant.student, variant.draw, variant.parameters),
        bound=bound,
        careful=float(np.mean(off.max(axis=1) > bound)),
        keys={asked.name: Key(key, most, most / length, is_drawn) for asked, key, most, length, is_drawn in rows},
        hypotheses={name: Hypothesis.of(values) for name, values in wrong.items()},
        alike=not_told,
        dependences=dependences(exercise, drawn.right, keys, bound),
    )


def _drawn_or_refused(variant: Variant) -> PerfectHands | RefusedDraw:
    """What perfect hands draw, where nothing in it is in the way; this is quickly found out."""
    exercise = variant.exercise
    try:
        right = board_chain(variant.task)
        if not finds_room(exercise, right):
            return RefusedDraw((RefusalReason("room"),))
        drawn = perfect_hands(exercise, right)
    except MistakeError as error:
        return RefusedDraw((RefusalReason("mistake", error.mistake),))
    except GraphcamError:
        return RefusedDraw((RefusalReason("nothing"),))
    if names := endless(drawn):
        return RefusedDraw(
            tuple(RefusalReason("nothing" if name == CAREFUL_WORK else "mistake", name) for name in names)
        )
    if pairs := forbidden(exercise, plainly_alike(exercise, drawn)):
        same = of_pairs(pair for pair in pairs if have_same_answers(drawn, *pair))
        return RefusedDraw(of_pairs(pairs), same, {CAREFUL_WORK: right, **drawn.wrong})
    return drawn


def issue(exercise: Exercise, student: str, secret: bytes, first: int = 0) -> tuple[Variant, AnswerKey]:
    """The student's variant and its answer key: the first draw that :func:`key_or_reason` does not turn away.

    The same exercise, student and secret give the same variant on every machine.

    first : the draw to begin with

    Raises
    ------
    DesignError : no draw can be diagnosed
    """
    refusals = Refusals(exercise)
    for draw in range(first, first + MAX_DRAWS):
        candidate = drawn(exercise, student, secret, draw)
        found = key_or_reason(candidate)
        if not isinstance(found, RefusedDraw):
            return candidate, found
        refusals.add(found)
        if refusals.is_hopeless:
            break
    raise refusals.error()
