"""Making an answer key: the variant drawn by a perfect hand, by many careful ones, and with every mistake.

Parameters are drawn until every catalogued mistake can be told, and until no one number is right in most answers.
"""

import numpy as np

from graphcam.errors import GraphcamError
from graphcam.exercises.definition.blank_axes import finds_room
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.exercises.key.answer_key import AnswerKey, Hypothesis, Key
from graphcam.exercises.key.coinciding import HALF, by_one_number
from graphcam.exercises.key.redrawing import dependences
from graphcam.exercises.key.scatter import answers_of, bulges_of, deviations, distances, expected, torn
from graphcam.exercises.key.separation import (
    CAREFUL,
    MistakeError,
    PerfectHands,
    alike,
    endless,
    forbidden,
    hypotheses,
    out_of_sight,
    passing,
    perfect_hands,
    plainly_alike,
    the_same,
)
from graphcam.exercises.key.turned_away import Reason, Refusals, TurnedAway, of_pairs

HANDS = 2000
"""Careful hands behind the tolerances."""
MARGIN = 0.6
"""The bound is set for this part of the permitted rate of losses: a rate from finitely many hands is uncertain."""
MOST_DRAWS = 400
"""Draws after which an exercise is held to have no variant that can be diagnosed."""


def draw_key(variant: Variant) -> AnswerKey | None:
    """The answer key of a variant; None where its answers cannot tell every mistake from every other.

    Named together are those that the exercise lets be alike.  None has a variant either whose diagrams find no room on
    the worksheet, or in which one number handed in for all answers earns more than half of the marks.  What is quickly
    found out comes first: of several draws most are turned away.

    Raises
    ------
    DesignError : a careful hand comes to nothing with it
    """
    found = key_or_reason(variant)
    return None if isinstance(found, TurnedAway) else found


def key_or_reason(variant: Variant) -> AnswerKey | TurnedAway:
    """What :func:`draw_key` finds, or why it finds nothing."""
    found = _drawn(variant)
    if isinstance(found, TurnedAway):
        return found
    exercise, drawn = variant.exercise, found
    chains = {CAREFUL: drawn.right, **drawn.wrong}
    wrong = hypotheses(exercise, drawn)
    not_told = alike(exercise, wrong)
    if pairs := forbidden(exercise, not_told):
        return TurnedAway(of_pairs(pairs), drawings=chains)
    hands = answers_of(exercise, drawn.right.by(exercise.hand.pencil(HANDS)))
    if torn(exercise, drawn.right, hands):
        return TurnedAway((Reason("sides"),))
    far = distances(exercise, drawn.answers, hands)
    keys = expected(exercise, drawn.answers, far, drawn.lengths, bulges_of(exercise, drawn.right))
    off = deviations(exercise, keys, far)
    bound = float(np.quantile(off.max(axis=1), 1 - MARGIN * exercise.careful))
    tolerances = [bound * float(np.max(key.scatter)) for key in keys]
    if pairs := passing(exercise, keys, wrong, bound):
        certain = (pair for pair in pairs if out_of_sight(exercise, keys, wrong[pair[0]], bound))
        return TurnedAway(of_pairs(pairs), of_pairs(certain), chains)
    if by_one_number(exercise, keys, tolerances) > HALF:
        return TurnedAway((Reason("number"),))
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


def _drawn(variant: Variant) -> PerfectHands | TurnedAway:
    """What perfect hands draw, where nothing in it is in the way; this is quickly found out."""
    exercise = variant.exercise
    try:
        right = board_chain(variant.task)
        if not finds_room(exercise, right):
            return TurnedAway((Reason("room"),))
        drawn = perfect_hands(exercise, right)
    except MistakeError as error:
        return TurnedAway((Reason("mistake", error.mistake),))
    except GraphcamError:
        return TurnedAway((Reason("nothing"),))
    if names := endless(drawn):
        return TurnedAway(tuple(Reason("nothing" if name == CAREFUL else "mistake", name) for name in names))
    if pairs := forbidden(exercise, plainly_alike(exercise, drawn)):
        same = of_pairs(pair for pair in pairs if the_same(drawn, *pair))
        return TurnedAway(of_pairs(pairs), same, {CAREFUL: right, **drawn.wrong})
    return drawn


def issue(exercise: Exercise, student: str, secret: bytes, first: int = 0) -> tuple[Variant, AnswerKey]:
    """The student's variant and its answer key: the first draw that :func:`draw_key` does not turn away.

    The same exercise, student and secret give the same variant on every machine.

    first : the draw to begin with

    Raises
    ------
    DesignError : no draw can be diagnosed
    """
    refusals = Refusals(exercise)
    for draw in range(first, first + MOST_DRAWS):
        candidate = drawn(exercise, student, secret, draw)
        found = key_or_reason(candidate)
        if not isinstance(found, TurnedAway):
            return candidate, found
        refusals.add(found)
        if refusals.hopeless:
            break
    raise refusals.error()
