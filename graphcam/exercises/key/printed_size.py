"""Answers read on a print that is not true to size, as they would be on a true one.

What is printed is smaller there; all else is as long as the student's own ruler says, and is reckoned with the scales
of the text.  So every answer has a factor of its own: the width of the axis goes into v once, and into s twice.
"""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import say
from graphcam.exercises.definition.diagram_mistakes import other_scales
from graphcam.exercises.definition.drawn_answers import board_chain, with_ordinates, with_reading
from graphcam.exercises.definition.exercise import BAR, Answers, Exercise, Given
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import answer_of
from graphcam.words import Words

TRUE_LENGTH, LENGTHS = 100.0, (90.0, 105.0)
"""How long the worksheet's rule is on a true print, and what it measures on any other [mm]."""
NEGLIGIBLE = 0.25
"""A rule that is off by less is read no better [mm]."""
NEAR_NOUGHT = 5.0
"""A value whose factor is farther from 1 than so many times the print's own size lies near nought, and has none."""


def on_true_print(exercise: Exercise, answer_key: AnswerKey, answers: Answers) -> Answers:
    """The answers as they would be on a true print, where the rule's length among them says that theirs was none.

    A length that no print can have is told, and the answers stay as they are.
    """
    wrong: Words | None = answers.problems.get(BAR.name)
    length = float(answers.values.get(BAR.name, TRUE_LENGTH))
    if wrong is None and not LENGTHS[0] <= length <= LENGTHS[1]:
        wrong = say("{name} is {length:g} mm", name=BAR.name, length=length)
    if wrong is not None:
        note = say(
            "{wrong}; the rule of 100 mm measures from {least:g} to {most:g} mm on a print: measure it again, or print "
            "the sheet again; the answers are taken as read on a print of 100 %",
            wrong=wrong,
            least=LENGTHS[0],
            most=LENGTHS[1],
        )
        return replace(answers, notes=(*answers.notes, note))
    if abs(length - TRUE_LENGTH) <= NEGLIGIBLE:
        return answers
    size, values = length / TRUE_LENGTH, dict(answers.values)
    right = board_chain(Variant(exercise, answer_key.student, answer_key.draw, answer_key.parameters).task)
    printed = drawn_on_print(exercise, right, size)
    for asked in exercise.answers:
        if asked.name in values:
            true, small = (np.atleast_1d(answer_of(chain, asked)) for chain in (right, printed))
            values[asked.name] = _divided(values[asked.name], true, small, NEAR_NOUGHT * abs(size - 1))
    note = say(
        "the answers are taken as read on a print of {percent:.3g} % and told as they would be at 100 %",
        percent=length,
    )
    return replace(answers, values=values, notes=(*answers.notes, note))


def _divided(given: Given, true: NDArray[Any], small: NDArray[Any], near: float) -> Given:
    """An answer over its factor, points each over that of the nearest place; near nought as far off as it was."""
    nearest = np.abs(np.subtract.outer(np.atleast_1d(given), small)).argmin(axis=1)
    true, small = true[nearest], small[nearest]
    near_nought = np.abs(small - true) >= near * np.abs(true)
    found = np.where(near_nought, given - small + true, given * true / np.where(near_nought, 1.0, small))
    return found if isinstance(given, np.ndarray) else float(found[0])


def drawn_on_print(exercise: Exercise, right: Chain, size: float) -> Chain:
    """What a perfect hand draws on a worksheet that was printed at a size, in parts of the true one.

    Printed are the axis of the cam angle, the circles of a profile and what else the worksheet shows at its beginning:
    the acceleration, the displacement, or the outline of a given cam.
    """
    board, shown = right.board, exercise.sheet
    if "differentiation" in shown:
        # Displacement and axis are smaller together: no slope is another.
        drawn = right.differentiation
        return right.continued_from(with_reading(drawn, "rise", size * drawn.readings["rise"].paper))
    mu_phi = replace(board.mu_phi, per_mm=board.mu_phi.per_mm / size)
    chain = replace(right, board=replace(board, mu_phi=mu_phi), done={})
    if "acceleration" in shown:
        chain = chain.continued_from(with_ordinates(chain.acceleration, np.full(len(chain.spans), size)))
    if "analysis" in chain.names:
        givens = right.analysis.givens
        outline = replace(givens.outline, points=size * givens.outline.points)
        # The prime circle touches the pitch curve, whose roller is no smaller.
        radius = size * givens.prime_radius + (1 - size) * givens.roller_radius
        smaller = replace(givens, outline=outline, prime_radius=radius)
        chain = chain.continued_from(board.follower.analysis(smaller, chain.pencil))
    derived = "differentiation" if "analysis" in chain.names else "integration"
    chain = other_scales(chain, derived, (size, size))
    if "inversion" in shown:
        circles = size * right.prime_radius, size * right.place
        drawn = chain.integration, board.rotation, *circles, right.profile_scale, chain.pencil
        chain = chain.continued_from(board.follower.inversion(*drawn))
    return chain
