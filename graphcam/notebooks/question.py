"""Questions of the cells in which the reader tries it: an answer gets a verdict or a hint, never the number."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape

import numpy as np

from graphcam.comparison.quantities import Quantity
from graphcam.drafting.ink import Reading

CAREFUL_HAND = 1.0
"""How far a careful drawing may be off [mm of paper]: twice half a division, for a line drawn and a length read."""
RIGHT, NEARLY, WRONG, OPEN = "right", "nearly", "wrong", "open"
ROUGH = 3.0
"""Up to so many tolerances the way was right and the hand was not."""


@dataclass(frozen=True)
class Verdict:
    """What an answer gets: ``status`` is "right", "nearly", "wrong" or "open"; ``text`` says it."""

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

    >>> radius = Question(43.28, 0.6, "mm", "step 5", {"the distance is still in mm of paper": 72.13})
    >>> print(radius.check(43.0).text)
    Right, within what a pencil can do.
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

    @classmethod
    def of(
        cls, reading: Reading, look: str, mistakes: Mapping[str, float] | None = None, at: int | None = None
    ) -> Question:
        """The question for a reading, to be answered as a careful hand draws; ``at`` is the station.

        >>> from graphcam.drafting.ink import reading
        >>> print(Question.of(reading(50.0, 0.6, "mm"), "step 7").check(50.0).text)
        Not yet: that is the length on paper; multiply by the scale. Look again at step 7.
        """
        paper = float(reading.paper if at is None else reading.paper[at])
        scale = float(np.ravel(reading.scale)[0])
        on_paper = {} if scale == 1 else {"that is the length on paper; multiply by the scale": paper}
        return cls(scale * paper, CAREFUL_HAND * scale, reading.unit, look, {**on_paper, **(mistakes or {})})

    @classmethod
    def about(cls, quantity: Quantity) -> Question:
        """The question for a quantity of a solution, to be answered as a careful hand draws.

        >>> from graphcam.main_job import solve
        >>> from graphcam.task_file import builtin_task
        >>> greatest = solve(builtin_task()).comparison.quantities["max_v"]
        >>> print(Question.about(greatest).check(-57.3).text)
        Not yet: the size is right, the sign is not. Look again at greatest v.
        """
        on_paper = {"that is the length on paper; multiply by the scale": quantity.drawn / quantity.per_mm}
        # A length of paper that is the value itself is no mistake.
        mistakes = {} if math.isclose(quantity.per_mm, 1.0) else on_paper
        return cls(quantity.drawn, CAREFUL_HAND * quantity.per_mm, quantity.unit, str(quantity.title), mistakes)

    def check(self, answer: float | None) -> Verdict:
        """What the answer is worth; without one an invitation."""
        if answer is None:
            return Verdict(OPEN, f"Your turn: put your number (in {self.unit}) in place of None and run this cell.")
        if not math.isfinite(answer):
            return Verdict(WRONG, f"Not yet: a finite number is asked for, in {self.unit}.")
        off = abs(answer - self.value)
        if off <= self.tolerance:
            return Verdict(RIGHT, "Right, within what a pencil can do.")
        if hint := self._mistake(answer):
            return Verdict(WRONG, f"Not yet: {hint}. Look again at {self.look}.")
        if off <= ROUGH * self.tolerance:
            return Verdict(NEARLY, f"Nearly: the way is right, a line is not sharp enough. Repeat {self.look}.")
        return Verdict(WRONG, f"Not yet: that is too {'large' if answer > self.value else 'small'}. "
                       f"Look again at {self.look}.")  # fmt: skip

    def _mistake(self, answer: float) -> str:
        degree = math.degrees(1.0)
        usual = {
            "the size is right, the sign is not": -self.value,
            "that is twice as much: a diameter for a radius, or the whole for the half": 2 * self.value,
            "that is half of it: a radius for a diameter, or the half for the whole": self.value / 2,
            "degrees and radians are mixed up": self.value * degree,
            "radians and degrees are mixed up": self.value / degree,
        }
        for hint, wrong in {**self.mistakes, **usual}.items():
            if abs(answer - wrong) <= self.tolerance * max(1.0, abs(wrong / self.value) if self.value else 1.0):
                return hint
        return ""
