"""Making an answer key: the variant drawn by a perfect hand, by many careful ones, and with every mistake.

Parameters are drawn until every catalogued mistake can be told, and until no one number is right in most answers.
"""

from collections.abc import Sequence

import numpy as np

from graphcam.errors import GraphcamError
from graphcam.exercises.definition.blank_axes import finds_room
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.variant import Variant, drawn
from graphcam.exercises.key.answer_key import AnswerKey, Hypothesis, Key
from graphcam.exercises.key.answer_scatter import (
    answers_of,
    bulges_of,
    deviations,
    distances,
    expected,
    torn,
)
from graphcam.exercises.key.coinciding_answers import (
    MAX_COINCIDENCE_SHARE,
    by_one_number,
    guessed_radii,
)
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
from graphcam.exercises.key.refused_draws import RefusalReason, Refusals, RefusedDraw, of_pairs
from graphcam.exercises.key.unlisted_mistakes import too_many_kept

HAND_COUNT = 2000
"""Careful hands behind the tolerances."""
LOSS_RATE_MARGIN = 0.8
"""The bound is set for this part of the permitted rate of losses: a rate from finitely many hands is uncertain."""
MAX_DRAWS = 400
"""Draws after which an exercise is held to have no variant that can be diagnosed."""
SAME_RADIUS = 1e-9
"""Radii that differ by less are the same [mm]."""


def key_or_reason(variant: Variant, hands: PerfectHands | None = None) -> AnswerKey | RefusedDraw:
    """The answer key of a variant, or why it has none: its answers cannot tell every mistake from every other.

    Named together are those that the exercise lets be alike.  A variant has no key either whose diagrams find no room
    on the worksheet, or in which one number handed in for all answers earns more than half of the marks.  What is
    quickly found out comes first: of several draws most are turned away.

    hands : what :func:`drawn_or_refused` found, where that is known

    Raises
    ------
    DesignError : a careful hand comes to nothing with it
    """
    drawn = hands or drawn_or_refused(variant)
    if isinstance(drawn, RefusedDraw):
        return drawn
    exercise, radius = variant.exercise, variant.task.cam.prime_radius
    chains = {CAREFUL_WORK: drawn.right, **drawn.wrong}
    careful = answers_of(exercise, drawn.right.by(exercise.hand.pencil(HAND_COUNT)))
    if torn(exercise, drawn.right, careful):
        return RefusedDraw((RefusalReason("sides"),))
    far = distances(exercise, drawn.answers, careful)
    keys = expected(exercise, drawn.answers, far, drawn.lengths, bulges_of(exercise, drawn.right))
    off = deviations(exercise, keys, far)
    bound = float(np.quantile(off.max(axis=1), 1 - LOSS_RATE_MARGIN * exercise.careful))
    tolerances = [bound * float(np.max(key.scatter)) for key in keys]
    if by_one_number(exercise, keys, tolerances) > MAX_COINCIDENCE_SHARE:
        return RefusedDraw((RefusalReason("number"),))
    if names := guessed_radii(exercise, keys, tolerances, radius):
        return _copied(names)
    wrong: dict[str, tuple[Expected, ...]] = {}
    for name, values in hypotheses(exercise, drawn):
        wrong[name] = values
        alike = forbidden(exercise, inseparable_pairs(exercise, wrong))
        if pairs := [*passing(exercise, keys, {name: values}, bound), *alike]:
            certain = (pair for pair in pairs if CAREFUL_WORK in pair and out_of_sight(exercise, keys, values, bound))
            return RefusedDraw(of_pairs(pairs), of_pairs(certain), chains)
    if names := too_many_kept(exercise, drawn, keys, bound):
        reasons = tuple(RefusalReason("unlisted", name, CAREFUL_WORK) for name in names)
        wrongly = {name: misconception(name).change(drawn.right) for name in names}
        return RefusedDraw(reasons, reasons, chains | wrongly)
    # Not by their standard deviation, which rounding keeps from nought.
    by_hand = [bool(np.any(samples != samples[0])) for samples in careful]
    rows = zip(exercise.answers, keys, tolerances, drawn.lengths, by_hand, strict=True)
    return AnswerKey(
        *(exercise.name, exercise.version, variant.student, variant.draw, variant.parameters),
        bound=bound,
        careful=float(np.mean(off.max(axis=1) > bound)),
        keys={asked.name: Key(key, most, most / length, is_drawn) for asked, key, most, length, is_drawn in rows},
        hypotheses={name: Hypothesis.of(wrong[name]) for name in exercise.misconceptions},
        alike=inseparable_pairs(exercise, {name: wrong[name] for name in exercise.misconceptions}),
        dependences=dependences(exercise, drawn.right, keys, bound, careful, drawn.lengths),
    )


def _copied(names: Sequence[str]) -> RefusedDraw:
    """A draw in which the prime radius of the text is right for other radii, whose names these are."""
    return RefusedDraw(tuple(RefusalReason("copied", name, "cam.prime_radius") for name in names), drawings={})


def drawn_or_refused(variant: Variant) -> PerfectHands | RefusedDraw:
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
    # Where the answer is that radius itself, no hand need be asked how it scatters.
    plain = [Expected(value, 0.0) for value in drawn.answers]
    if names := guessed_radii(exercise, plain, [SAME_RADIUS] * len(plain), variant.task.cam.prime_radius):
        return _copied(names)
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
