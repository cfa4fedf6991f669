"""How an answer follows from the student's own earlier ones: the construction drawn again from these.

The construction is drawn again when the answer key is made (:mod:`graphcam.exercises.key.redrawing`), from a range of
values in place of each earlier answer, the others before it being right and those after it following; marking only
looks up.  A student with several answers off gets the effects put together, by factors or by sums, whichever agrees
better with drawings from several own values at once.  What an own answer owes to those before it is in their effects
already, so it counts as :meth:`Dependence.moved` says: one slip that all the rest follows is exactly one effect.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

NODE_COUNT = 33
"""Own values from which each later answer is drawn again."""
OWN_VALUE_RANGE = 16.0
"""The own values reach over so many times the right one, to both sides, and down to that part of it: from an absurd
value, and from nought above all, anything follows."""
Together = Literal["product", "sum"]


@dataclass(frozen=True, eq=False)
class Effect:
    """What an answer becomes where one earlier answer is the student's own, at equally spaced t.

    An own value x is centre + width sinh(t): near the right one the values lie densely, and they reach far.
    power : where the answer goes with a power of the own one, as a scale with another, that power; the one value is
        then that at the centre
    """

    centre: float
    width: float
    values: tuple[float | None, ...]
    power: int | None = None

    def at(self, own: float) -> float:
        """The answer that follows; NaN where none was drawn, and from a value too small to have been drawn."""
        # What is nought but for the scatter may be small: there the width is more than a part of the centre.
        if abs(own) * OWN_VALUE_RANGE < abs(self.centre) and self.width < abs(self.centre):
            return math.nan
        if self.power is not None:
            near = abs(own - self.centre) <= OWN_VALUE_RANGE * max(abs(self.centre), self.width)
            return (self.values[0] or 0.0) * (own / self.centre) ** self.power if near else math.nan
        t = (math.asinh((own - self.centre) / self.width) / span(self.centre, self.width) + 1) * (NODE_COUNT - 1) / 2
        if not 0 <= t <= NODE_COUNT - 1:
            return math.nan
        k = min(max(round(t), 1), NODE_COUNT - 2)
        left, middle, right = self.values[k - 1 : k + 2]
        if left is None or middle is None or right is None:
            return math.nan
        # The parabola through the three nearest drawings, over the own values: what goes straight with them is exact.
        a, b, c = (self._own(k + step) for step in (-1, 0, 1))
        bend = ((right - middle) / (c - b) - (middle - left) / (b - a)) / (c - a)
        return middle + (own - b) * ((middle - left) / (b - a) + (own - a) * bend)

    def _own(self, k: int) -> float:
        """The own value from which the drawing of that number started."""
        t = (2 * k / (NODE_COUNT - 1) - 1) * span(self.centre, self.width)
        return self.centre + self.width * math.sinh(t)


@dataclass(frozen=True, eq=False)
class Dependence:
    """All effects on one answer, by the name of the earlier answer, and how they go together.

    scatter : standard deviation of what a careful hand answers about what follows from its own earlier answers, in the
        unit of the answer
    """

    effects: Mapping[str, Effect]
    together: Together
    scatter: float

    def expected(self, key: float, own: Mapping[str, float]) -> float:
        """The answer that follows from a student's own values, each moved; NaN where it cannot be drawn."""
        found = key
        for name, effect in self.effects.items():
            if name in own:
                alone = effect.at(own[name])
                found = found * alone / key if self.together == "product" else found + alone - key
        return found

    def moved(self, key: float, given: float, expected: float) -> float:
        """An own answer as it would be if all before it were right; NaN where what follows cannot be drawn.

        key : the right answer; expected : what follows from those before it

        >>> Dependence({}, "product", 0.1).moved(30.0, given=45.0, expected=45.0)  # it follows from them
        30.0
        """
        if self.together == "sum":
            return given - expected + key
        return given * key / expected if expected else math.nan

    def to_json(self) -> str:
        """The dependence as JSON text."""
        effects = {
            name: [each.centre, each.width, list(each.values), each.power] for name, each in self.effects.items()
        }
        said = {"together": self.together, "effects": effects, "scatter": self.scatter}
        return json.dumps(said, allow_nan=False)

    @staticmethod
    def from_json(text: str) -> Dependence:
        """The dependence in the text that :meth:`to_json` wrote."""
        said = json.loads(text)
        effects = {name: Effect(c, w, tuple(values), power) for name, (c, w, values, power) in said["effects"].items()}
        return Dependence(effects, said["together"], said["scatter"])


def span(centre: float, width: float) -> float:
    """The greatest t of the own values about a centre."""
    return math.asinh(OWN_VALUE_RANGE * max(abs(centre), width) / width)
