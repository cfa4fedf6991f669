"""What a copy earns: the careful answers of one variant, marked by the key of another."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import permutations

from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.coinciding import HALF
from graphcam.exercises.marking.marking import mark

GROUP = 40
"""Students who sit together.  Of so many every one is marked by every other's key: the work grows with the square."""


@dataclass(frozen=True)
class CopyGain:
    """Copies of other variants.

    pairs : how many were marked;  best : the largest part of the marks that one earned
    above_half : how many earned more than half of the marks

    >>> CopyGain(pairs=4, best=0.8, above_half=1).part_above_half
    0.25
    """

    pairs: int = 0
    best: float = 0.0
    above_half: int = 0

    @property
    def part_above_half(self) -> float:
        """The part of the copies that earn more than half of the marks."""
        return self.above_half / self.pairs if self.pairs else 0.0


def copy_gain(exercise: Exercise, done: Sequence[tuple[AnswerKey, Answers]]) -> CopyGain:
    """The gain by copies of the answers to some variants, each marked by the keys of all others."""
    parts = [
        (record := mark(exercise, answer_key, answers)).total / record.of
        for (answer_key, _), (_, answers) in permutations(done, 2)
    ]
    return CopyGain(len(parts), max(parts, default=0.0), sum(part > HALF for part in parts))
