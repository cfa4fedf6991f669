"""Mistakes of the catalogue that an exercise does not list: which show in its answers, and which keep all marks."""

import math
from collections.abc import Iterable, Iterator, Sequence
from itertools import repeat
from typing import Any, NamedTuple

import numpy as np

from graphcam.constructions.chain import Chain
from graphcam.errors import GraphcamError
from graphcam.exercises.definition.catalogue import LAW_ARGUMENT, READING_ARGUMENT
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.mistakes import CATALOGUE, misconception
from graphcam.exercises.key.answer_scatter import Drawn, answer_of, answers_of
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.key.mistake_separation import PerfectHands
from graphcam.given.laws import DWELL_TO_DWELL_LAWS

MIN_MOVED_SHARE = 0.01
"""An answer is another one where it differs by this part of itself,"""
MIN_MOVED_LENGTH = 0.5
"""or by this length on paper [mm]."""
PENCIL_LINE = 0.2
"""Lengths that differ by less are drawn as one line [mm of paper]."""
LAW_MISTAKES = ("wrong-law", "laws-swapped")
"""Mistakes that draw another law of motion, which may be as good as the same one."""
MAX_KEPT_SHARE = 0.03
"""The maximum part of the mistakes not listed that may keep all marks in a variant."""


def unlisted_names(exercise: Exercise) -> list[str]:
    """Every catalogued mistake that the exercise does not list, with every argument that has to do with its answers.

    Another law is taken as often as there are laws between dwells.
    """
    asked = exercise.answers
    diagrams = ["integration"] + ["differentiation"] * any(each.construction == "differentiation" for each in asked)
    lengths = dict.fromkeys(f"{each.construction}.{each.reading}" for each in asked if each.reading)
    names: list[str] = []
    for name, entry in CATALOGUE.items():
        if entry.takes == LAW_ARGUMENT:
            names += [f"{name}: {law}" for law in DWELL_TO_DWELL_LAWS]
        elif entry.takes == READING_ARGUMENT:
            names += [f"{name}: {length}" for length in lengths]
        else:
            names += [f"{name}: {diagram}" for diagram in diagrams] if entry.takes else [name]
    return [name for name in names if name not in exercise.misconceptions]


def unlisted_answers(
    exercise: Exercise, chain: Chain, listed: Iterable[Drawn], names: Sequence[str] | None = None
) -> Iterator[tuple[str, Drawn]]:
    """The names and the answers of the hands of a drawing with every mistake that its exercise does not list.

    Left out are what cannot be drawn here, and what is stroke by stroke the drawing with a mistake that is listed, such
    as another law where that is the law of the other phase.

    listed : the answers with each mistake that is
    names : only of these; None for all
    """
    listed = list(listed)
    for name in unlisted_names(exercise) if names is None else names:
        try:
            answers = answers_of(exercise, misconception(name).change(chain))
        except GraphcamError:
            continue
        finite = all(np.isfinite(values).all() for values in answers)
        if finite and not any(all(map(np.array_equal, answers, others)) for others in listed):
            yield name, answers


class UnlistedOutcomes(NamedTuple):
    """What becomes of the mistakes that an exercise does not list, each drawn by a perfect hand.

    shown : the names of those by which some answer is another one
    kept : of these, those that keep all marks
    near : laws that make some answer another one and no length on paper by more than a pencil line; they are not shown
    """

    shown: tuple[str, ...]
    kept: tuple[str, ...]
    near: tuple[str, ...]

    @property
    def too_many(self) -> bool:
        """Whether more of them keep all marks than may."""
        return len(self.kept) > MAX_KEPT_SHARE * len(self.shown)


def unlisted_outcomes(
    exercise: Exercise,
    drawn: PerfectHands,
    keys: Sequence[Expected],
    bound: float,
    names: Sequence[str] | None = None,
) -> UnlistedOutcomes:
    """What becomes of every mistake of the catalogue that the exercise does not list.

    keys, bound : of the answer key; an answer within so many pencil units is right
    names : only of these; None for all
    """
    shown: list[str] = []
    kept: list[str] = []
    near: list[str] = []
    for name, answers in unlisted_answers(exercise, drawn.right, drawn.wrong_answers.values(), names):
        rows = list(zip(exercise.answers, drawn.answers, answers, drawn.lengths, strict=True))
        if not any(_is_another(*row) for row in rows):
            continue
        if name.partition(":")[0] in LAW_MISTAKES and all(_moved_on_paper(*row) <= PENCIL_LINE for row in rows):
            near.append(name)
            continue
        shown.append(name)
        if all(map(_is_right, exercise.answers, keys, answers, repeat(bound))):
            kept.append(name)
    return UnlistedOutcomes(tuple(shown), tuple(kept), tuple(near))


def too_many_kept(exercise: Exercise, drawn: PerfectHands, keys: Sequence[Expected], bound: float) -> tuple[str, ...]:
    """The mistakes not listed that keep all marks, where they are more than may; none where they are not.

    Each is drawn to its first wrong answer; all answers of all are drawn only where their number decides.
    """
    all_right: list[str] = []
    wrong = 0
    for name in unlisted_names(exercise):
        try:
            chain = misconception(name).change(drawn.right)
            pairs = zip(exercise.answers, keys, strict=True)
            is_right = all(_is_right(asked, key, answer_of(chain, asked), bound) for asked, key in pairs)
        except GraphcamError:
            continue
        wrong += not is_right
        all_right += [name] * is_right
    outcomes = unlisted_outcomes(exercise, drawn, keys, bound, all_right)
    # No more than these show.
    if not outcomes.kept or len(outcomes.kept) > MAX_KEPT_SHARE * (wrong + len(outcomes.shown)):
        return outcomes.kept
    every = unlisted_outcomes(exercise, drawn, keys, bound)
    return every.kept if every.too_many else ()


def _is_right(asked: AskedAnswer, key: Expected, answer: Any, bound: float) -> bool:
    given = round(float(answer), asked.decimals) if asked.kind == "number" and np.isfinite(answer) else answer
    return abs(key.deviation(given, asked.kind)) <= bound


def _is_another(asked: AskedAnswer, right: Any, wrong: Any, length: float) -> bool:
    """Whether an answer differs so much from the right one that it is another."""
    if _moved_on_paper(asked, right, wrong, length) > MIN_MOVED_LENGTH:
        return True
    return asked.kind == "number" and bool(abs(wrong - right) > MIN_MOVED_SHARE * abs(right))


def _moved_on_paper(asked: AskedAnswer, right: Any, wrong: Any, length: float) -> float:
    """How far an answer lies from the right one on paper [mm]; what is no length there is nowhere."""
    if asked.kind == "number":
        return float(abs(wrong - right) / length) if math.isfinite(length) else 0.0
    return float(Expected(right, 1.0).distances(wrong, asked.kind).max())
