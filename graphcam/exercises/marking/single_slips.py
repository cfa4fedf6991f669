"""Slips of one answer: a wrong sign, degrees for radians, twice or half, a power of ten, another answer, no scale.

They are looked for where no catalogued mistake explains the answers and one answer alone is off; what follows from it
is right.  A slip is named only where no other one brings the same number.
"""

import math
from collections.abc import Callable, Mapping, Sequence

from graphcam.drafting.ink import Caption, say
from graphcam.exercises.key.answer_key import Key
from graphcam.exercises.marking.diagnosis import ComparedAnswer

Slip = Callable[[float], float]
TENS = (0.001, 0.01, 0.1, 10.0, 100.0, 1000.0)
"""Factors by which a decimal point is set wrongly."""


def _times(factor: float) -> Slip:
    return lambda value: factor * value


SLIPS: Sequence[tuple[Caption, Sequence[Slip]]] = (
    (say("{name}: you seem to have given it with the wrong sign."), (_times(-1.0),)),
    (
        say("{name}: you seem to have taken degrees for radians, or radians for degrees: the answer is off by 180/π."),
        (_times(math.degrees(1)), _times(math.radians(1))),
    ),
    (say("{name}: you seem to have given twice the answer, or half of it."), (_times(2.0), _times(0.5))),
    (
        say("{name}: the decimal point seems to be in the wrong place; check the powers of ten."),
        tuple(map(_times, TENS)),
    ),
)
"""What is said of each slip, and what it makes of a right answer."""
COMPLEMENT = say("{name}: you seem to have measured the angle from the other axis: it is the complement of yours.")
ON_PAPER = say("You seem to have given a length as measured on paper: multiply it by its scale.")
OTHERS_VALUE = say("{name}: you have given the same number for {other}; it is right there.")


def single_slip(
    compared: Sequence[ComparedAnswer], following: set[str], bound: float, keys: Mapping[str, Key]
) -> Caption | None:
    """What is said of the slip in the one answer that is wrong; None where there are several or it fits no slip alone.

    following : the names of the answers that follow from the student's own earlier ones
    bound : pencil units within which an answer is right; keys : of all answers
    """
    wrong = [each for each in compared if each.wrong and each.asked.name not in following]
    if len(wrong) != 1 or not isinstance(given := wrong[0].given, float):
        return None
    answer, name = wrong[0], wrong[0].asked.name
    fitting = [caption for caption, slips in SLIPS if any(_fits(answer, given, slip, bound) for slip in slips)]
    if answer.asked.unit.startswith("deg") and _fits(answer, given, _complement, bound):
        fitting.append(COMPLEMENT)
    # Units of the answer in a millimetre of paper, NaN for what is no length there.
    scale = keys[name].tolerance / keys[name].tolerance_paper
    if scale > 0 and answer.asked.of == "value" and _fits(answer, given, _times(1 / scale), bound):
        fitting.append(ON_PAPER)
    found = [caption.with_values(name=name) for caption in fitting]
    # The same digits in two answers are seldom chance; a value that lies near another one often is.
    values: Mapping[str, float] = {
        each.asked.name: each.given for each in compared if not each.wrong and isinstance(each.given, float)
    }
    found += [OTHERS_VALUE.with_values(name=name, other=other) for other, value in values.items() if value == given]
    return found[0] if len(found) == 1 else None


def _fits(answer: ComparedAnswer, given: float, slip: Slip, bound: float) -> bool:
    """Whether the answer is what a slip makes of a right one; what may be nought by its scatter is no slip."""
    value, reach = float(answer.key.value), bound * float(answer.key.scatter)
    low, high = sorted((slip(value - reach), slip(value + reach)))
    rounding = 0.5 * 10.0**-answer.asked.decimals
    return abs(given) > rounding and abs(value) > reach and low - rounding <= given <= high + rounding


def _complement(degrees: float) -> float:
    return math.copysign(90.0, degrees) - degrees
