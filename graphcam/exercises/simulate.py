"""Monte Carlo of an exercise: how often careful work loses a point, wrong work passes, a mistake is misnamed."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

from graphcam.exercises.answers import Answers
from graphcam.exercises.certificate import Certificate
from graphcam.exercises.exercise import Exercise
from graphcam.exercises.issue import issue
from graphcam.exercises.marking import mark
from graphcam.exercises.misconceptions import misconception
from graphcam.exercises.record import Record
from graphcam.exercises.scatter import Change, Drawn, answers_of
from graphcam.exercises.variant import Variant

NOTHING = "none"
"""In the matrix: no catalogued mistake was named."""


@dataclass(frozen=True)
class Row:
    """Hand-ins with one mistake: how many there were, how many earned all marks, and what was named how often."""

    hands: int
    accepted: int
    named: dict[str, int]

    def right(self, name: str) -> float:
        """Part of the hand-ins in which the mistake was named."""
        return self.named.get(name, 0) / self.hands


@dataclass
class _Watch:
    """Counts hand-ins, and the processor's seconds that marking them took."""

    count: int = 0
    seconds: float = 0.0


@dataclass(frozen=True)
class Simulation:
    """What many simulated students showed.

    losing : careful hands that lost any point; too_exact : those remarked on as too exact
    rows : by the misconception's name
    marked_per_second : hand-ins that one core marked in a second, certificates being at hand
    draws : parameters drawn for every variant until all mistakes could be told
    """

    exercise: str
    variants: int
    careful: int
    losing: int
    too_exact: int
    rows: dict[str, Row]
    draws: float
    marked_per_second: float

    @property
    def false_rejections(self) -> float:
        """Part of the careful hands that lost any point."""
        return self.losing / self.careful

    @property
    def false_acceptances(self) -> float:
        """Part of the hand-ins with a mistake that earned all marks."""
        hands = sum(row.hands for row in self.rows.values())
        return sum(row.accepted for row in self.rows.values()) / hands if hands else 0.0

    @property
    def right_diagnoses(self) -> float:
        """Part of the hand-ins with a mistake in which that mistake was named."""
        hands = sum(row.hands for row in self.rows.values())
        return sum(row.named.get(name, 0) for name, row in self.rows.items()) / hands if hands else 1.0

    def to_dict(self) -> dict[str, Any]:
        """As JSON takes it."""
        rates = ("false_rejections", "false_acceptances", "right_diagnoses")
        return asdict(self) | {name: getattr(self, name) for name in rates}


def simulate(
    exercise: Exercise, secret: bytes, variants: int, hands: int, step: Callable[[int, int], None] = lambda a, b: None
) -> Simulation:
    """Draw variants, and on each of them as many careful students, and as many with every mistake.

    step : hears how many variants of how many are done
    """
    careful: list[Record] = []
    wrong: dict[str, list[Record]] = {name: [] for name in exercise.misconceptions}
    draws, watch = 0, _Watch()
    for k in range(variants):
        variant, certificate = issue(exercise, f"student {k}", secret)
        draws += variant.draw + 1
        careful += _marked(variant, certificate, hands, None, k, watch)
        for name in wrong:
            wrong[name] += _marked(variant, certificate, hands, misconception(name).change, k, watch)
        step(k + 1, variants)
    return Simulation(
        exercise.name, variants, len(careful), sum(record.total < record.of for record in careful),
        sum(record.too_exact for record in careful), {name: _row(records) for name, records in wrong.items()},
        draws / variants, watch.count / watch.seconds,
    )  # fmt: skip


def _marked(
    variant: Variant, certificate: Certificate, hands: int, change: Change | None, k: int, watch: _Watch
) -> list[Record]:
    exercise = variant.exercise
    # Never the seed of the hands that the certificate was made from.
    drawn = answers_of(exercise, variant.task, hands, seed=1 + k, change=change)
    given = [_hand_in(exercise, drawn, row) for row in range(hands)]
    start = time.process_time()
    records = [mark(exercise, certificate, answers) for answers in given]
    watch.seconds += time.process_time() - start
    watch.count += hands
    return records


def _hand_in(exercise: Exercise, drawn: Drawn, row: int) -> Answers:
    pairs = zip(exercise.answers, drawn, strict=True)
    return Answers({a.name: float(v[row]) if a.kind == "number" else v[row] for a, v in pairs})


def _row(records: list[Record]) -> Row:
    named = Counter(record.diagnosis.misconception if record.diagnosis else NOTHING for record in records)
    return Row(len(records), sum(record.total >= record.of for record in records), dict(named))
