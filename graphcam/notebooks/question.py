"""Questions in a notebook: an answer gets a verdict or a hint, never the number."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape

from graphcam.comparison.quantities import Quantity
from graphcam.drafting.ink import Reading
from graphcam.drafting.scale import UNITS
from graphcam.language import MINUS_SIGN
from graphcam.words import Caption, Tell, Words, say

EXAMPLE_NUMBER = 12.3
"""The example in the hint on how numbers are written."""
CAREFUL_HAND_ERROR = 1.0
"""The error permitted to a careful drawing [mm of paper]: twice half a division, for drawing and reading."""
RIGHT_VERDICT, NEARLY_VERDICT, WRONG_VERDICT, OPEN_VERDICT = "right", "nearly", "wrong", "open"
PAPER_LENGTH_HINT = say("that is the length on paper; multiply it by the scale")
DOUBLE_STOP_PATTERN = re.compile(r"([.?!…。？！])[.。](?=\s|$)")
"""A full stop after a sign that ends the sentence already."""
ROUGH_TOLERANCES = 3.0
"""The error, in tolerances, up to which a wrong answer counts as the right way drawn roughly."""


@dataclass(frozen=True)
class Verdict:
    """The verdict on an answer: ``status`` is "right", "nearly", "wrong" or "open"; ``text`` is for the reader."""

    status: str
    text: str

    def _repr_mimebundle_(self, **_: object) -> dict[str, str]:
        return {"text/html": f'<p class="verdict {self.status}">{escape(self.text)}</p>', "text/plain": self.text}


@dataclass(frozen=True)
class Question:
    """A number that the reader is to find, with hints for the mistakes that are usually made.

    value, tolerance : in ``unit``
    look : where to look again if nothing else is known ("step 3")
    mistakes : hints by the wrong answer that each belongs to
    tell : translates the texts of the verdicts; ``look`` and ``mistakes`` stay as they are

    >>> radius = Question(43.28, 0.6, "mm", "step 5", {"the distance is still in mm of paper": 72.13})
    >>> print(radius.check(43.0).text)
    Right, within drawing accuracy.
    >>> print(radius.check(72.0).text)
    Not yet: the distance is still in mm of paper. Look again at step 5.
    >>> print(radius.check(-43.3).text)
    Not yet: the size is right, the sign is not. Look again at step 5.
    """

    value: float
    tolerance: float
    unit: str
    look: str
    mistakes: Mapping[str, float] = field(default_factory=dict[str, float])
    tell: Tell = str

    @classmethod
    def of(
        cls, reading: Reading, look: str, mistakes: Mapping[str, float] | None = None, at: int | None = None
    ) -> Question:
        """The question for a reading, with the tolerance of a careful drawing; ``at`` is the station.

        >>> from graphcam.drafting.ink import reading
        >>> print(Question.of(reading(50.0, 0.6, "mm"), "step 7").check(50.0).text)
        Not yet: that is the length on paper; multiply it by the scale. Look again at step 7.
        """
        paper = float(reading.paper if at is None else reading.paper[at])
        scale = reading.per_mm
        on_paper = {} if scale == 1 else {str(PAPER_LENGTH_HINT): paper}
        return cls(scale * paper, CAREFUL_HAND_ERROR * scale, reading.unit, look, {**on_paper, **(mistakes or {})})

    @classmethod
    def about(cls, quantity: Quantity, tell: Tell = str) -> Question:
        """The question for a quantity of a solution, with the tolerance of a careful drawing.

        >>> import graphcam as gc
        >>> greatest = gc.solve(gc.builtin_task()).comparison.quantities["max_v"]
        >>> print(Question.about(greatest).check(-57.3).text)
        Not yet: the size is right, the sign is not. Look again at maximum v.
        """
        # A length of paper that is the value itself is no mistake.
        equal = math.isclose(quantity.per_mm, 1.0)
        mistakes = {} if equal else {tell(PAPER_LENGTH_HINT): quantity.drawn / quantity.per_mm}
        tolerance = CAREFUL_HAND_ERROR * quantity.per_mm
        return cls(quantity.drawn, tolerance, quantity.unit, tell(quantity.title), mistakes, tell)

    def check(self, answer: float | str | None) -> Verdict:
        """The verdict on an answer; without an answer an invitation.

        answer : a number, or a text with one, with a decimal point or comma

        >>> radius = Question(170.9, 1.0, "mm", "step 5: which line was measured?")
        >>> [radius.check(answer).status for answer in (171, "171", "170,9", " 170.9 mm", None)]
        ['right', 'right', 'right', 'right', 'open']
        >>> print(radius.check("about 171").text)
        Not yet: "about 171" is not a number; write it like 12.3, in mm.
        >>> print(radius.check("160,0").text)
        Not yet: that is too small. Look again at step 5: which line was measured?
        """
        status, words = self._verdict(answer)
        return Verdict(status, DOUBLE_STOP_PATTERN.sub(r"\1", self.tell(words)))

    def _verdict(self, given: float | str | None) -> tuple[str, Caption]:
        unit = UNITS.get(self.unit, self.unit)
        if given is None or (isinstance(given, str) and not given.strip()):
            return OPEN_VERDICT, say("Your turn: replace None by your number (in {unit}) and run this cell.", unit=unit)
        answer = _number(given, (self.unit, self.tell(unit)))
        if answer is None:
            said = {"given": str(given), "example": EXAMPLE_NUMBER, "unit": unit}
            return WRONG_VERDICT, say('Not yet: "{given}" is not a number; write it like {example}, in {unit}.', **said)
        if not math.isfinite(answer):
            return WRONG_VERDICT, say("Not yet: enter a finite number, in {unit}.", unit=unit)
        off, look = abs(answer - self.value), self.look
        if off <= self.tolerance:
            return RIGHT_VERDICT, say("Right, within drawing accuracy.")
        if hint := self._mistake(answer):
            return WRONG_VERDICT, say("Not yet: {hint}. Look again at {look}.", hint=hint, look=look)
        if off <= ROUGH_TOLERANCES * self.tolerance:
            return NEARLY_VERDICT, say(
                "Nearly: the method is right, but a line is not exact enough. Repeat {look}.", look=look
            )
        if answer > self.value:
            return WRONG_VERDICT, say("Not yet: that is too large. Look again at {look}.", look=look)
        return WRONG_VERDICT, say("Not yet: that is too small. Look again at {look}.", look=look)

    def _mistake(self, answer: float) -> Words:
        degree = math.degrees(1.0)
        usual: list[tuple[Words, float]] = [
            (say("the size is right, the sign is not"), -self.value),
            (
                say("that is twice the value: a diameter instead of a radius, or the whole instead of half"),
                2 * self.value,
            ),
            (
                say("that is half the value: a radius instead of a diameter, or half instead of the whole"),
                self.value / 2,
            ),
            (say("degrees and radians are mixed up"), self.value * degree),
            (say("radians and degrees are mixed up"), self.value / degree),
        ]
        for hint, wrong in [*self.mistakes.items(), *usual]:
            if abs(answer - wrong) <= self.tolerance * max(1.0, abs(wrong / self.value) if self.value else 1.0):
                return hint
        return ""


def _number(given: float | str, units: tuple[str, ...]) -> float | None:
    """The number in an answer, which may be a text with a unit; None where there is none.

    >>> _number("−1 234,5 mm", ("mm",)), _number("1,234.5", ("mm",)), _number("5 cm", ("mm",))
    (-1234.5, None, None)
    """
    text = str(given).strip()
    for unit in units:
        text = text.removesuffix(unit)
    text = "".join(text.split()).replace(MINUS_SIGN, "-")
    # A point beside a comma: one of them parts thousands, and nobody can tell which.
    text = text if "." in text else text.replace(",", ".")
    try:
        return float(text)
    except ValueError:
        return None
