"""Whether readings are as exact as a program's: so many agree with it as hardly a careful hand's do.

A remark for the teacher, never a mark and never for the student: a CAD drawing is exact by honest means too.
"""

import math
from collections.abc import Iterable, Sequence

from graphcam.drafting.slips import UNIFORM_DEVIATION
from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import CALCULATION_DEVIATION
from graphcam.exercises.marking.diagnosis import ComparedAnswer

REMARK_RATE = 1e-3
"""The maximum part of careful hands that are remarked on."""
DEPENDENCE_MARGIN = 0.2
"""The limit is set for this part of them: readings of one drawing are not independent, as is assumed here."""
DECIMAL_ROUNDING = 1e-6
"""The part of the last decimal by which a program's reading may miss by the arithmetic alone."""


def too_exact(answer_key: AnswerKey, compared: Sequence[ComparedAnswer]) -> bool:
    """Whether the drawn numbers agree with a program's in more places than a careful hand's do by chance.

    Only numbers that a hand's errors are in count: what is calculated agrees anyway, and of drawn points and curves a
    CAD program gives all exactly.
    """
    chances, agreeing = list[float](), 0
    for each in compared:
        key = answer_key.keys[each.asked.name]
        if key.drawn and isinstance(each.given, float) and isinstance(each.key.value, float):
            chances.append(chance(each.asked, each.key.value, float(each.key.scatter)))
            agreeing += abs(each.given - each.key.value) <= (0.5 + DECIMAL_ROUNDING) * 10.0**-each.asked.decimals
    return probability_of_at_least(chances, agreeing) < DEPENDENCE_MARGIN * REMARK_RATE


def chance(asked: AskedAnswer, value: float, scatter: float) -> float:
    """The probability that a careful hand reads just the rounded value of a program.

    scatter : of the hand with its rounding, which is taken out; where calculating alone may have set it, the hand's
        own errors are smaller by nobody knows how much, and it agrees always

    >>> asked = AskedAnswer("v", "A length.", "integration", reading="v", decimals=1)
    >>> round(chance(asked, 20.0, 0.3), 3), chance(asked, 20.0, 0.02)
    (0.133, 1.0)
    """
    step = 10.0**-asked.decimals
    drawn = math.sqrt(max(0.0, scatter**2 - (UNIFORM_DEVIATION * step) ** 2))
    if not drawn or scatter <= (1 + DECIMAL_ROUNDING) * CALCULATION_DEVIATION * abs(value):
        return 1.0
    middle = round(value, asked.decimals)
    below, above = ((middle + side * step / 2 - value) / (math.sqrt(2) * drawn) for side in (-1, 1))
    return (math.erf(above) - math.erf(below)) / 2


def probability_of_at_least(chances: Iterable[float], count: int) -> float:
    """The probability that so many or more of independent events happen (the Poisson binomial distribution).

    >>> probability_of_at_least([0.5, 0.5, 0.5], 2), probability_of_at_least([], 0)
    (0.5, 1.0)
    """
    happened = [1.0]
    for each in chances:
        happened = [
            stays * (1 - each) + comes * each for stays, comes in zip([*happened, 0.0], [0.0, *happened], strict=True)
        ]
    return math.fsum(happened[count:])
