"""What is odd about a course that was made: wide tolerances, and a scale in the text that is not that of the sheet."""

import math
import re
from collections.abc import Iterator, Sequence

import numpy as np

from graphcam.exercises.course.handouts import instructions
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey

WIDE = 0.1
"""A tolerance is wide that exceeds this part of the value."""
NUMBER = r"(\d+(?:[.,]\d+)?)"
STATEMENTS = (
    (re.compile(rf"{NUMBER} ?° ?(?:to|per|in|=|/|в) ?{NUMBER}? ?(?:mm|мм)"), 1, 2),
    (re.compile(rf"{NUMBER} ?(?:mm|мм) ?(?:to|=|per|изображает|соответствует|ứng với|表示) ?{NUMBER} ?°"), 2, 1),
)
"""How texts state the scale of the cam angle, and which of the numbers are degrees and millimetres."""


def wide_tolerances(exercise: Exercise, answer_keys: Sequence[AnswerKey]) -> dict[str, float]:
    """The numbers, by name, whose tolerance is wide in half of the variants, and which part of the value it is."""
    found: dict[str, float] = {}
    for asked in exercise.answers:
        keys = [each.keys[asked.name] for each in answer_keys]
        values = [(key.tolerance, abs(key.expected.value)) for key in keys if isinstance(key.expected.value, float)]
        parts = [tolerance / value if value else math.inf for tolerance, value in values]
        if parts and (part := float(np.median(parts))) > WIDE:
            found[asked.name] = part
    return found


def stated_scales(text: str) -> Iterator[tuple[str, float]]:
    """The scales of the cam angle that a text states, as it says them and in degrees a millimetre.

    >>> list(stated_scales("Lay off the cam angle at 1° to 1 mm; 2 мм изображает 1°."))
    [('1° to 1 mm', 1.0), ('2 мм изображает 1°', 0.5)]
    """
    for pattern, degrees, millimetres in STATEMENTS:
        for said in pattern.finditer(text):
            length = float((said[millimetres] or "1").replace(",", "."))
            if length:
                yield said[0], float(said[degrees].replace(",", ".")) / length


def other_scale(variant: Variant) -> tuple[str, float] | None:
    """What the text says of the scale of the cam angle where the sheet has another, and that of the sheet [deg/mm]."""
    drawn = math.degrees(board_chain(variant.task).board.mu_phi.per_mm)
    for said, scale in stated_scales(instructions(variant)):
        if not math.isclose(scale, drawn, rel_tol=1e-6):
            return said, drawn
    return None
