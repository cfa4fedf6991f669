"""Questions in a notebook, for a number or for an array: an answer gets a verdict or a hint, never the number."""

from __future__ import annotations

import base64
import json
import math
import re
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from graphcam.comparison.bounds import CAREFUL_PENCIL, HonestRange, honest_range
from graphcam.comparison.quantities import DEGREES_PER_RADIAN, Quantity, told_unit
from graphcam.drafting.ink import Reading
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import UNITS, unit_factor
from graphcam.errors import DesignError
from graphcam.language import MINUS_SIGN
from graphcam.words import Caption, Tell, Words, say

EXAMPLE_NUMBER = 12.3
"""The example in the hint on how numbers are written."""
RIGHT_VERDICT, NEARLY_VERDICT, WRONG_VERDICT, OPEN_VERDICT = "right", "nearly", "wrong", "open"
PAPER_LENGTH_HINT = say("that is the length on paper; multiply it by the scale")
POWER_OF_TEN_HINT = say("a power of ten is wrong: look at the units, and at the place of the decimal point")
POWERS_OF_TEN = (-3, -2, -1, 1, 2, 3)
DOUBLE_STOP_PATTERN = re.compile(r"([.?!…。？！])[.。](?=\s|$)")
"""A full stop after a sign that ends the sentence already."""
ANSWER_PATTERN = re.compile(rf"([-+{MINUS_SIGN}]?[\d.,\s]*[\d.,](?:[eE][-+]?\d+)?)\s*([^\d.,\s].*)?")
"""A number, and a unit behind it if there is one."""
ROUGH_TOLERANCES = 2.0
"""The error, in tolerances, up to which a wrong answer counts as the right way done roughly."""
QUESTIONS_FILE = "questions.json"
"""The file of the teacher with all questions of a course, by notebook and by the name of the student's number."""
KEPT_FIELDS = "value", "tolerance", "unit", "look", "mistakes", "found_by", "bias"
FoundBy = Literal["drawing", "calculation", "counting"]
"""How the reader comes to the number."""


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
    mistakes : hints by the wrong answer that each belongs to, outside the tolerance
    tell : translates the texts of the verdicts; ``look`` and ``mistakes`` stay as they are
    found_by : whether it is drawn, calculated or counted
    bias : how far the middle of the answers that are right lies from the value

    >>> radius = Question(43.28, 0.6, "mm", "step 5", {"the distance is still in mm of paper": 72.13})
    >>> print(radius.check(43.0).text)
    Right, within drawing accuracy.
    >>> print(radius.check(72.0).text)
    Not yet: the distance is still in mm of paper. Look again at step 5.
    >>> print(radius.check(-43.3).text)
    Not yet: the size is right, the sign is not. Look again at step 5.

    Raises
    ------
    DesignError : a mistake lies within the tolerance, so that it would be called right
    """

    value: float
    tolerance: float
    unit: str
    look: str
    mistakes: Mapping[str, float] = field(default_factory=dict[str, float])
    tell: Tell = str
    found_by: FoundBy = "drawing"
    bias: float = 0.0

    def __post_init__(self) -> None:
        for hint, wrong in self.mistakes.items():
            if self._is_right(wrong):
                limit = say("further from {value} than {tolerance}", value=self.value, tolerance=self.tolerance)
                raise DesignError(say("mistake {hint}", hint=hint), wrong, limit, say("choose other numbers"))

    @classmethod
    def by(
        cls,
        draw: Callable[[Pencil], Reading],
        look: str,
        mistakes: Mapping[str, float] | None = None,
        exact: float = math.nan,
    ) -> Question:
        """The question for a reading that a function draws with any pencil: right is what careful hands read.

        mistakes : those that careful hands may read are left out
        exact : is right too

        >>> import graphcam as gc
        >>> chain = gc.solve(gc.builtin_task()).chain
        >>> radius = Question.by(
        ...     lambda pencil: chain.by(pencil)["minimum_radius"].readings["prime_radius"], "step 7"
        ... )
        >>> print(radius.check("7,2 cm").text)
        Not yet: that is the length on paper; multiply it by the scale. Look again at step 7.
        """
        read = draw(Pencil())
        size, unit = told_unit(read)
        value = size * float(read.value)
        paper = {} if read.per_mm == 1 else {str(PAPER_LENGTH_HINT): float(read.paper)}
        honest = honest_range(value, size * draw(CAREFUL_PENCIL).value, size * read.per_mm, exact)
        return cls._within(honest, value, unit, look, {**paper, **(mistakes or {})})

    @classmethod
    def about(cls, quantity: Quantity, tell: Tell = str) -> Question:
        """The question for a quantity of a solution: right is what careful hands read, and what is exact.

        >>> import graphcam as gc
        >>> greatest = gc.solve(gc.builtin_task()).comparison.quantities["max_v"]
        >>> print(Question.about(greatest).check(-57.3).text)
        Not yet: the size is right, the sign is not. Look again at maximum v.
        """
        # No mistake is a length of paper that is the value itself, and an angle has none.
        none = any(math.isclose(quantity.per_mm, scale) for scale in (1.0, DEGREES_PER_RADIAN))
        mistakes = {} if none else {tell(PAPER_LENGTH_HINT): quantity.drawn / quantity.per_mm}
        return cls._within(quantity.honest, quantity.drawn, quantity.unit, tell(quantity.title), mistakes, tell)

    @classmethod
    def _within(
        cls,
        honest: HonestRange,
        value: float,
        unit: str,
        look: str,
        mistakes: Mapping[str, float],
        tell: Tell = str,
    ) -> Question:
        low, high = honest
        told = {hint: wrong for hint, wrong in mistakes.items() if not low <= wrong <= high}
        return cls(value, (high - low) / 2, unit, look, told, tell, bias=(low + high) / 2 - value)

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
        answer = _number(given, self.unit)
        if answer is None:
            said = {"given": str(given), "example": EXAMPLE_NUMBER, "unit": unit}
            return WRONG_VERDICT, say('Not yet: "{given}" is not a number; write it like {example}, in {unit}.', **said)
        if not math.isfinite(answer):
            return WRONG_VERDICT, say("Not yet: enter a finite number, in {unit}.", unit=unit)
        if self._is_right(answer):
            drawn = say("Right, within drawing accuracy.")
            return RIGHT_VERDICT, drawn if self.found_by == "drawing" else say("Right.")
        look = self.look
        if hint := self._mistake(answer):
            return WRONG_VERDICT, say("Not yet: {hint}. Look again at {look}.", hint=hint, look=look)
        if self._is_right(answer, ROUGH_TOLERANCES) and self.found_by != "counting":
            drawn = say("Nearly: the method is right, but a line is not exact enough. Repeat {look}.", look=look)
            computed = say("Nearly: the method is right, but a figure is not exact enough. Repeat {look}.", look=look)
            return NEARLY_VERDICT, drawn if self.found_by == "drawing" else computed
        if answer > self.value:
            return WRONG_VERDICT, say("Not yet: that is too large. Look again at {look}.", look=look)
        return WRONG_VERDICT, say("Not yet: that is too small. Look again at {look}.", look=look)

    def _is_right(self, answer: float, tolerances: float = 1.0) -> bool:
        return abs(answer - self.value - self.bias) <= tolerances * self.tolerance

    def _mistake(self, answer: float) -> Words:
        """The hint of the mistake whose number is nearest, where it is near: one of the question's before the usual."""
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
            *((POWER_OF_TEN_HINT, self.value * 10.0**power) for power in POWERS_OF_TEN),
        ]
        for hints in ([*self.mistakes.items()], usual):
            near = [(abs(answer - wrong) / self._tolerance_at(wrong), hint) for hint, wrong in hints]
            off, hint = min(near, key=lambda pair: pair[0], default=(math.inf, ""))
            if off <= 1:
                return hint
        return ""

    def _tolerance_at(self, wrong: float) -> float:
        return self.tolerance * max(1.0, abs(wrong / self.value) if self.value else 1.0)


@dataclass(frozen=True)
class ArrayQuestion:
    """An array that a few lines of the reader's code are to give, with hints for the mistakes that are usually made.

    values : (n,) numbers, or places as complex numbers
    tolerance : by which each may differ
    look : where to look again
    mistakes : hints by the wrong array that each belongs to

    Its verdicts are in English, as the notebooks are that ask for code.

    >>> ends = ArrayQuestion([0.0, 2.0, 6.0], 0.01, "the chord's climb", {"the pole is forgotten": [0.0, 80.0, 240.0]})
    >>> [ends.check(given).status for given in (None, [0, 2, 6], (0, 2.001, 6))]
    ['open', 'right', 'right']
    >>> print(ends.check([0, 80, 240]).text)
    Not yet: the pole is forgotten. Look again at the chord's climb.
    >>> print(ends.check([0, 2, 5]).text)
    Not yet: value 3 of 3 is the first that is not right. Look again at the chord's climb.
    """

    values: Sequence[complex]
    tolerance: float
    look: str
    mistakes: Mapping[str, Sequence[complex]] = field(default_factory=dict[str, Sequence[complex]])

    def check(self, answer: object) -> Verdict:
        """The verdict on an array, or on anything that NumPy makes one of; on ``None`` an invitation."""
        if answer is None:
            return Verdict(OPEN_VERDICT, "Your turn: put your lines in the place of None, and run this cell.")
        right = np.asarray(self.values, dtype=np.complex128)
        try:
            given = np.asarray(answer, dtype=np.complex128)
        except (TypeError, ValueError):
            return Verdict(WRONG_VERDICT, "Not yet: that is no array of numbers.")
        if given.shape != right.shape:
            shapes = f"your array has the shape {given.shape}, and should have {right.shape}"
            return Verdict(WRONG_VERDICT, f"Not yet: {shapes}.")
        off = np.flatnonzero(~self._near(given, right))
        if not off.size:
            return Verdict(RIGHT_VERDICT, "Right.")
        wrong = {hint: np.asarray(values, dtype=np.complex128) for hint, values in self.mistakes.items()}
        first = f"value {off[0] + 1} of {right.size} is the first that is not right"
        hint = next((hint for hint, values in wrong.items() if self._near(given, values).all()), first)
        return Verdict(WRONG_VERDICT, f"Not yet: {hint}. Look again at {self.look}.")

    def _near(self, given: NDArray[np.complex128], right: NDArray[np.complex128]) -> NDArray[np.bool_]:
        """Which values differ by no more than the tolerance; what is not finite is not near."""
        return np.abs(given - right) <= self.tolerance


AnyQuestion = Question | ArrayQuestion


def kept_text(questions: Sequence[AnyQuestion]) -> str:
    """Questions as one text, so that who reads a notebook does not read their answers: no secret, but out of sight."""
    kept = json.dumps([_kept_fields(question) for question in questions], ensure_ascii=False)
    return base64.b64encode(zlib.compress(kept.encode(), 9)).decode("ascii")


def _kept_fields(question: AnyQuestion) -> list[Any] | dict[str, Any]:
    """What JSON can hold of a question: of a number a list, of an array a table, in which places are pairs."""
    if isinstance(question, Question):
        return [getattr(question, name) if name != "mistakes" else dict(question.mistakes) for name in KEPT_FIELDS]
    mistakes = {hint: _pairs(wrong) for hint, wrong in question.mistakes.items()}
    return vars(question) | {"values": _pairs(question.values), "mistakes": mistakes}


def _pairs(values: Sequence[complex]) -> list[list[float]]:
    return [[number.real, number.imag] for number in map(complex, values)]


def kept_questions(text: str) -> tuple[AnyQuestion, ...]:
    """The questions that :func:`kept_text` kept.

    >>> asked = Question(43.28, 0.6, "mm", "step 5", {"on paper": 72.13}), ArrayQuestion([1, 2j], 0.1, "step 6")
    >>> radius, places = kept_questions(kept_text(asked))
    >>> radius.check(43.0).status, radius.mistakes, places.check([1, 2j]).status
    ('right', {'on paper': 72.13}, 'right')
    """
    return tuple(map(_kept_question, json.loads(zlib.decompress(base64.b64decode(text)))))


def _kept_question(fields: list[Any] | dict[str, Any]) -> AnyQuestion:
    if isinstance(fields, list):
        return Question(**dict(zip(KEPT_FIELDS, fields, strict=True)))
    mistakes = {hint: [complex(*pair) for pair in wrong] for hint, wrong in fields["mistakes"].items()}
    values = [complex(*pair) for pair in fields["values"]]
    return ArrayQuestion(values, fields["tolerance"], fields["look"], mistakes)


def _number(given: object, unit: str) -> float | None:
    """The number in an answer, in the unit that is asked for, which may be a text with a unit; None where none is.

    >>> _number("−1 234,5 mm", "mm"), _number("1,234.5", "mm"), _number("4.4 cm", "mm"), _number("20.1°", "degrees")
    (-1234.5, None, 44.0, 20.1)
    """
    if isinstance(given, int | float | np.number) and not isinstance(given, bool):
        return float(given)
    said = ANSWER_PATTERN.fullmatch(str(given).strip())
    factor = unit_factor(said[2] or unit, unit) if said else None
    if said is None or factor is None:
        return None
    text = "".join(said[1].split()).replace(MINUS_SIGN, "-")
    # A point beside a comma: one of them parts thousands, and nobody can tell which.
    text = text if "." in text else text.replace(",", ".")
    try:
        return factor * float(text)
    except ValueError:
        return None
