"""Whether the answers can tell every catalogued mistake from careful work and from every other mistake."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.chain import Chain
from graphcam.errors import DesignError
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.key.answer_scatter import Drawn, answers_of, bulges_of, distances, expected, lengths_of
from graphcam.exercises.key.expected_answers import Expected

HAND_COUNT = 200
"""Careful hands behind the scatter of a mistake's answers."""
SEPARATION_SCATTERS = 3.5
"""Two mistakes are told apart where some answer differs by so many of both their scatters: one in 2000 is mistaken."""
DETECTION_SCATTERS = 3.3
"""A mistake is noticed where some answer lies outside the tolerance by so many of its scatters."""
CAREFUL_WORK = "careful"
"""What work without a mistake is called among the mistakes."""


class MistakeError(DesignError):
    """A drawing with a mistake that comes to nothing: the mistake's name, beside what is wrong with it."""

    def __init__(self, mistake: str, error: DesignError) -> None:
        super().__init__(*error.args)
        self.mistake = mistake

    def __reduce__(self) -> tuple[type["MistakeError"], tuple[str, DesignError]]:
        return MistakeError, (self.mistake, DesignError(*self.args))


@dataclass(frozen=True, eq=False)
class PerfectHands:
    """What perfect hands draw of one variant, and answer: one without a mistake, and one with each of the exercise's.

    lengths : units of each answer in one mm of paper
    """

    right: Chain
    wrong: dict[str, Chain]
    answers: Drawn
    wrong_answers: dict[str, Drawn]
    lengths: list[float]


def perfect_hands(exercise: Exercise, right: Chain) -> PerfectHands:
    """The right drawing and the wrong ones by perfect hands; what is the same in several of them is drawn once.

    Raises
    ------
    DesignError : the drawing comes to nothing
    MistakeError : one with a mistake does
    """
    answers, lengths = answers_of(exercise, right), lengths_of(exercise, right)
    wrong: dict[str, Chain] = {}
    wrong_answers: dict[str, Drawn] = {}
    for name in exercise.misconceptions:
        try:
            wrong[name] = misconception(name).change(right)
            wrong_answers[name] = answers_of(exercise, wrong[name])
        except DesignError as error:
            raise MistakeError(name, error) from None
    return PerfectHands(right, wrong, answers, wrong_answers, lengths)


def hypotheses(exercise: Exercise, drawn: PerfectHands) -> Iterator[tuple[str, tuple[Expected, ...]]]:
    """What a student with each of the exercise's mistakes answers, and how it scatters, by the mistake's name.

    Those that differ least from right work come first: they may be taken for it.

    Raises
    ------
    DesignError : the drawing with a mistake comes to nothing
    """
    careful = drawn.right.by(exercise.hand.pencil(HAND_COUNT))

    def difference(name: str) -> float:
        """The maximum difference of an answer from the right one, as a part of it."""
        pairs = zip(drawn.wrong_answers[name], drawn.answers, strict=True)
        return max(float(np.max(np.abs(wrong - right) / (np.abs(right) + 1))) for wrong, right in pairs)

    for name in sorted(drawn.wrong, key=difference):
        answers = drawn.wrong_answers[name]
        off = distances(exercise, answers, answers_of(exercise, misconception(name).change(careful)))
        bent = bulges_of(exercise, drawn.wrong[name])
        yield name, tuple(expected(exercise, answers, off, drawn.lengths, bent))


def inseparable_pairs(exercise: Exercise, wrong: Mapping[str, Sequence[Expected]]) -> tuple[tuple[str, str], ...]:
    """The pairs of mistakes that the answers do not tell apart."""
    return tuple((a, b) for a, b in combinations(wrong, 2) if not _are_separated(exercise, wrong[a], wrong[b]))


def forbidden(exercise: Exercise, pairs: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """The pairs that the exercise does not let be alike."""
    let = {frozenset(pair) for pair in exercise.alike}
    return [pair for pair in pairs if frozenset(pair) not in let]


def passing(
    exercise: Exercise, keys: Sequence[Expected], wrong: Mapping[str, Sequence[Expected]], bound: float
) -> list[tuple[str, str]]:
    """The mistakes that pass as careful work, or that no answer names, paired with that."""
    return [(name, CAREFUL_WORK) for name, values in wrong.items() if not _is_noticed(exercise, keys, values, bound)]


def out_of_sight(exercise: Exercise, keys: Sequence[Expected], wrong: Sequence[Expected], bound: float) -> bool:
    """Whether a mistake bears on no answer, or makes it too small to be told from nought."""
    return all(
        np.allclose(np.asarray(value.value), np.asarray(key.value), rtol=1e-9, atol=1e-9)
        or (asked.kind == "number" and abs(complex(value.value)) <= (bound + DETECTION_SCATTERS) * float(value.scatter))
        for asked, key, value in zip(exercise.answers, keys, wrong, strict=True)
    )


def _is_noticed(exercise: Exercise, keys: Sequence[Expected], wrong: Sequence[Expected], bound: float) -> bool:
    # What may be nought by its scatter names no mistake: whoever answers nought need not have made it.
    return any(
        bool(np.any(_gap(asked, key, value) > bound * key.scatter + DETECTION_SCATTERS * value.scatter))
        and (asked.kind != "number" or abs(complex(value.value)) > (bound + DETECTION_SCATTERS) * float(value.scatter))
        for asked, key, value in zip(exercise.answers, keys, wrong, strict=True)
    )


def _are_separated(exercise: Exercise, a: Sequence[Expected], b: Sequence[Expected]) -> bool:
    return any(
        bool(np.any(_gap(asked, x, y) > SEPARATION_SCATTERS * (x.scatter + y.scatter)))
        for asked, x, y in zip(exercise.answers, a, b, strict=True)
    )


def _gap(asked: AskedAnswer, a: Expected, b: Expected) -> NDArray[np.float64]:
    """How far two expected answers lie apart; of what is drawn the clear distance.

    A curve shows no shift along itself, and points do not show their numbers.
    """
    if asked.kind != "number":
        return a.distances(np.asarray(b.value), asked.kind)
    return np.abs(np.asarray(a.value) - np.asarray(b.value))


def endless(drawn: PerfectHands) -> list[str]:
    """Whose answers have no number, as a slope has none where the run is nought."""
    rows = {CAREFUL_WORK: drawn.answers, **drawn.wrong_answers}
    return [name for name, row in rows.items() if not all(np.isfinite(value).all() for value in row)]


def plainly_alike(exercise: Exercise, drawn: PerfectHands) -> tuple[tuple[str, str], ...]:
    """The pairs of mistakes, work without one among them, that rounding alone does not tell apart."""
    rows = {CAREFUL_WORK: drawn.answers, **drawn.wrong_answers}
    values = {
        name: expected(exercise, row, [np.zeros((1, *value.shape)) for value in row], drawn.lengths)
        for name, row in rows.items()
    }
    return inseparable_pairs(exercise, values)


def have_same_answers(drawn: PerfectHands, a: str, b: str) -> bool:
    """Whether two of the drawings have the same answers to the last digit."""
    rows = {CAREFUL_WORK: drawn.answers, **drawn.wrong_answers}
    return all(np.allclose(x, y, rtol=1e-9, atol=1e-9) for x, y in zip(rows[a], rows[b], strict=True))
