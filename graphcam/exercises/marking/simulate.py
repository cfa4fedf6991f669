"""Monte Carlo of an exercise: how often careful work loses a point, wrong work passes, a mistake is misnamed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import partial
from itertools import permutations
from typing import Any

from graphcam.constructions.chain import Chain
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.definition.student_hands import HANDS, HandTable
from graphcam.exercises.definition.variant import Variant
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.answer_scatter import Drawn, answers_of
from graphcam.exercises.key.coinciding_answers import MAX_COINCIDENCE_SHARE
from graphcam.exercises.key.mistake_separation import perfect_hands
from graphcam.exercises.key.unlisted_mistakes import UnlistedOutcomes, unlisted_answers, unlisted_outcomes
from graphcam.exercises.marking.course_variants import GROUP_SIZE, course_variants
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.record import Diagnosis
from graphcam.workers import executor_of, ordered_results


def key_without(answer_key: AnswerKey, name: str) -> AnswerKey:
    """The answer key that knows neither one mistake nor those that it does not tell from it."""
    unknown = {name, *answer_key.inseparable_from(name)}
    others = {other: each for other, each in answer_key.hypotheses.items() if other not in unknown}
    return replace(answer_key, hypotheses=others)


UNLISTED_STEP = 5
"""The step between variants that are done with the mistakes not listed too: there are several times as many."""
NO_MISTAKE = "none"
"""The column of the matrix for no catalogued mistake."""


@dataclass(frozen=True)
class SimulatedRow:
    """Submissions with one mistake: how many there were, how many earned all marks, and what was named how often."""

    hands: int
    accepted: int
    named: dict[str, int]

    def named_share(self, name: str) -> float:
        """The part of the submissions in which the mistake was named."""
        return self.named.get(name, 0) / self.hands


@dataclass(frozen=True)
class OutsideCount:
    """Wrong submissions of a mistake that is not among those looked for, and how many were given a name."""

    hands: int = 0
    named: int = 0


@dataclass(frozen=True)
class UnlistedCount:
    """Mistakes that the exercise does not list, made by a perfect hand on every variant.

    shown : by the mistake's name, variants in which some answer differs from the right one by 1 % of itself or 0.5 mm
    kept : those of them in which it keeps all marks
    near : variants in which another law makes no difference on paper that a pencil line shows; they are not in shown
    """

    shown: Mapping[str, int] = field(default_factory=dict[str, int])
    kept: Mapping[str, int] = field(default_factory=dict[str, int])
    near: Mapping[str, int] = field(default_factory=dict[str, int])

    @property
    def rate(self) -> float:
        """The part of these mistakes that keep all marks."""
        return sum(self.kept.values()) / sum(self.shown.values()) if self.shown else 0.0


@dataclass(frozen=True)
class HandCount:
    """Students of one kind of hand who draw everything right, and how many of them lose any point."""

    hands: int = 0
    losing: int = 0

    @property
    def rate(self) -> float:
        """The part of the hands that lose any point."""
        return self.losing / self.hands if self.hands else 0.0


@dataclass(frozen=True)
class CopyGain:
    """Copies of the answers to other variants.

    pairs : how many were marked;  best : the largest part of the marks that one earned
    above_half : how many earned more than half of the marks
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
    return CopyGain(len(parts), max(parts, default=0.0), sum(part > MAX_COINCIDENCE_SHARE for part in parts))


@dataclass
class _Tally:
    """What is counted of like submissions, over all variants.

    made : the mistake of all of them, where it is one that is looked for
    """

    made: str = ""
    hands: int = 0
    accepted: int = 0
    wrong: int = 0
    too_exact: int = 0
    named: Counter[str] = field(default_factory=Counter[str])

    def mark(self, exercise: Exercise, answer_key: AnswerKey, chain: Chain) -> None:
        """Mark and count what every hand of a chain answers."""
        self.mark_answers(exercise, answer_key, answers_of(exercise, chain), chain.pencil.samples or 0)

    def mark_answers(self, exercise: Exercise, answer_key: AnswerKey, drawn: Drawn, hands: int) -> None:
        """Mark and count the answers of so many hands."""
        given = (submission(exercise, drawn, row) for row in range(hands))
        records = [mark(exercise, answer_key, answers) for answers in given]
        self.hands += len(records)
        self.accepted += sum(record.total >= record.of for record in records)
        self.wrong += sum(record.diagnosis is not None or record.total < record.of for record in records)
        self.too_exact += sum(record.too_exact for record in records)
        self.named.update(_name_of(record.diagnosis, answer_key, self.made) for record in records)

    def add(self, other: _Tally) -> None:
        """Count what another one has counted, too."""
        self.hands += other.hands
        self.accepted += other.accepted
        self.wrong += other.wrong
        self.too_exact += other.too_exact
        self.named.update(other.named)


def _name_of(diagnosis: Diagnosis | None, answer_key: AnswerKey, made: str) -> str:
    """What was named: the mistake made, too, where it is named with one that the answers cannot tell from it."""
    if diagnosis is None:
        return NO_MISTAKE
    together = made in diagnosis.alike and diagnosis.misconception in answer_key.inseparable_from(made)
    return made if together else diagnosis.misconception


_Tallies = dict[tuple[str, str], _Tally]
"""What is counted of the students of one variant, or of several, by their kind, and a name within it."""


def _no_tallies(exercise: Exercise) -> _Tallies:
    """Nothing counted yet of the hands, the mistakes, the fields of :class:`UnlistedCount`, and the others."""
    names = {"population": HANDS, "wrong": exercise.misconceptions, "unlisted": UnlistedOutcomes._fields}
    named = {(kind, name): _Tally(name if kind == "wrong" else "") for kind, those in names.items() for name in those}
    return named | {(kind, ""): _Tally() for kind in ("careful", "outside", "left out")}


def _of_kind(tallies: _Tallies, kind: str) -> dict[str, _Tally]:
    """The tallies of a kind, by name."""
    return {name: tally for (each, name), tally in tallies.items() if each == kind}


@dataclass(frozen=True)
class Simulation:
    """What many simulated students showed.

    careful : students with the hands of the exercise who draw everything right
    losing : those of them who lost any point; too_exact : those remarked on as exact as a program
    rows : by the misconception's name; named is also one that stands beside another which its answers cannot tell
    issued : how many variants were issued at the first draw of the parameters, at the second, and so on: the first in
        which all mistakes could be told
    outside : hands with catalogued mistakes that the exercise does not list, on every fifth variant
    left_out : hands with each of its mistakes, marked as if that one were not listed
    unlisted : mistakes that the exercise does not list, by a perfect hand, on every variant
    populations : by the name of the hand, students who draw everything right with it and are marked by the same keys
    copies : what a careful student of one variant earns by the key of another
    """

    exercise: str
    version: int
    variants: int
    careful: int
    losing: int
    too_exact: int
    rows: dict[str, SimulatedRow]
    issued: tuple[int, ...]
    outside: OutsideCount = OutsideCount()
    left_out: OutsideCount = OutsideCount()
    unlisted: UnlistedCount = field(default_factory=UnlistedCount)
    copies: CopyGain = field(default_factory=CopyGain)
    populations: dict[str, HandCount] = field(default_factory=dict[str, HandCount])

    @property
    def outside_named(self) -> float:
        """The part of the submissions with a mistake not looked for, to which another one was attributed."""
        hands = self.outside.hands + self.left_out.hands
        return (self.outside.named + self.left_out.named) / hands if hands else 0.0

    @property
    def unlisted_kept(self) -> float:
        """The part of the mistakes that are not listed, of those that show in an answer, that keep all marks."""
        return self.unlisted.rate

    @property
    def false_rejections(self) -> float:
        """The part of the careful hands that lost any point."""
        return self.losing / self.careful

    @property
    def false_acceptances(self) -> float:
        """The part of the submissions with a mistake that earned all marks."""
        hands = sum(row.hands for row in self.rows.values())
        return sum(row.accepted for row in self.rows.values()) / hands if hands else 0.0

    @property
    def right_diagnoses(self) -> float:
        """The part of the submissions with a mistake in which that mistake was named."""
        hands = sum(row.hands for row in self.rows.values())
        return sum(row.named.get(name, 0) for name, row in self.rows.items()) / hands if hands else 1.0

    @property
    def draws(self) -> float:
        """Draws of the parameters for a variant, on average."""
        return sum(count * draw for draw, count in enumerate(self.issued, 1)) / self.variants

    def to_dict(self) -> dict[str, Any]:
        """The simulation as JSON takes it."""
        rates = ("false_rejections", "false_acceptances", "right_diagnoses", "outside_named", "unlisted_kept", "draws")
        return asdict(self) | {name: getattr(self, name) for name in rates}


def simulate(
    exercise: Exercise,
    secret: bytes,
    variants: int,
    hands: int,
    step: Callable[[int, int], None] = lambda a, b: None,
    *,
    workers: int = 1,
    cluster: str = "",
) -> Simulation:
    """Draw variants, and on each of them as many careful students, and as many with every mistake.

    step : progress callback (done, total)
    workers, cluster : processes here, or the address of a dask scheduler; the figures are the same

    Raises
    ------
    DesignError : there is a student for whom no draw of the parameters can be diagnosed
    OSError : no scheduler answers at the address
    """
    whole = _no_tallies(exercise)
    issued: Counter[int] = Counter()
    done: list[tuple[AnswerKey, Answers]] = []
    with executor_of(workers, cluster) as executor:
        course = course_variants(exercise, (f"student {k}" for k in range(variants)), secret, executor)
        counted = ordered_results(executor, partial(_counted_attempt, exercise, hands), enumerate(course))
        for k, (draw, of_variant, careful_work) in enumerate(counted, 1):
            issued[draw] += 1
            for kind, tally in whole.items():
                tally.add(of_variant[kind])
            done += careful_work
            step(k, variants)
    careful, wrong = whole["careful", ""], _of_kind(whole, "wrong")
    populations, unlisted = _of_kind(whole, "population"), _of_kind(whole, "unlisted")
    rows = {name: SimulatedRow(each.hands, each.accepted, dict(each.named)) for name, each in wrong.items()}
    counts = (careful.hands, careful.hands - careful.accepted, careful.too_exact)
    draws = tuple(issued[draw] for draw in range(max(issued) + 1))
    return Simulation(
        exercise.name,
        exercise.version,
        variants,
        *counts,
        rows,
        draws,
        _outside_count(whole["outside", ""]),
        _outside_count(whole["left out", ""]),
        UnlistedCount(**{name: dict(sorted(each.named.items())) for name, each in unlisted.items()}),
        copy_gain(exercise, done),
        {name: HandCount(each.hands, each.hands - each.accepted) for name, each in populations.items()},
    )


def _outside_count(tally: _Tally) -> OutsideCount:
    """Counts of those with a wrong answer: what does not show in the answers asked can be given no name."""
    return OutsideCount(tally.wrong, tally.hands - tally.named[NO_MISTAKE])


def _counted_attempt(
    exercise: Exercise, hands: int, job: tuple[int, tuple[Variant, AnswerKey]]
) -> tuple[int, _Tallies, list[tuple[AnswerKey, Answers]]]:
    """The counts of a variant with its number: its draw, the students who did it, the work of a careful one.

    That work, with the answer key, is there for the first variants alone: it is marked by the keys of all others.
    """
    k, (variant, answer_key) = job
    found = _no_tallies(exercise)
    # Never the seed of the hands that the answer key was made from.
    drawn = board_chain(variant.task, exercise.hand.pencil(hands, 1 + k))
    found["careful", ""].mark(exercise, answer_key, drawn)
    for name, tally in _of_kind(found, "population").items():
        if (table := HandTable(name)) == exercise.hand:
            tally.add(found["careful", ""])
        else:
            tally.mark(exercise, answer_key, drawn.by(table.pencil(hands, 1 + k)))
    for name, tally in _of_kind(found, "wrong").items():
        wrongly = misconception(name).change(drawn)
        tally.mark(exercise, answer_key, wrongly)
        found["left out", ""].mark(exercise, key_without(answer_key, name), wrongly)
    perfect = perfect_hands(exercise, drawn.perfect)
    keys = [answer_key.keys[asked.name].expected for asked in exercise.answers]
    outcomes = unlisted_outcomes(exercise, perfect, keys, answer_key.bound)
    for name, tally in _of_kind(found, "unlisted").items():
        tally.named.update(getattr(outcomes, name))
    if k % UNLISTED_STEP == 0:
        listed = [answers_of(exercise, misconception(name).change(drawn)) for name in exercise.misconceptions]
        for _, answers in unlisted_answers(exercise, drawn, listed):
            found["outside", ""].mark_answers(exercise, answer_key, answers, hands)
    careful_work = [(answer_key, submission(exercise, answers_of(exercise, drawn), 0))] if k < GROUP_SIZE else []
    return variant.draw, found, careful_work


def submission(exercise: Exercise, drawn: Drawn, row: int) -> Answers:
    """What one of the hands that drew answers."""
    pairs = zip(exercise.answers, drawn, strict=True)
    return Answers({a.name: float(v[row]) if a.kind == "number" else v[row] for a, v in pairs})
