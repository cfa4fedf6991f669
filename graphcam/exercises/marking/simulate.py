"""Monte Carlo of an exercise: how often careful work loses a point, wrong work passes, a mistake is misnamed."""

from collections import Counter
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from typing import Any

from graphcam.constructions.chain import Chain
from graphcam.exercises.definition.drawn_answers import board_chain
from graphcam.exercises.definition.exercise import Answers, Exercise
from graphcam.exercises.definition.mistakes import misconception
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.key.keying import issue
from graphcam.exercises.key.scatter import Drawn, answers_of
from graphcam.exercises.marking.marking import mark

NOTHING = "none"
"""In the matrix: no catalogued mistake was named."""


@dataclass(frozen=True)
class SimulatedRow:
    """Submissions with one mistake: how many there were, how many earned all marks, and what was named how often."""

    hands: int
    accepted: int
    named: dict[str, int]

    def right(self, name: str) -> float:
        """Part of the submissions in which the mistake was named."""
        return self.named.get(name, 0) / self.hands


@dataclass
class _Tally:
    """What is counted of like submissions, over all variants."""

    hands: int = 0
    accepted: int = 0
    too_exact: int = 0
    named: Counter[str] = field(default_factory=Counter[str])

    def mark(self, exercise: Exercise, answer_key: AnswerKey, chain: Chain) -> None:
        """Mark all that these hands drew."""
        drawn = answers_of(exercise, chain)
        given = (_submission(exercise, drawn, row) for row in range(chain.pencil.samples or 0))
        records = [mark(exercise, answer_key, answers) for answers in given]
        self.hands += len(records)
        self.accepted += sum(record.total >= record.of for record in records)
        self.too_exact += sum(record.too_exact for record in records)
        self.named.update(record.diagnosis.misconception if record.diagnosis else NOTHING for record in records)


@dataclass(frozen=True)
class Simulation:
    """What many simulated students showed.

    losing : careful hands that lost any point; too_exact : those remarked on as too exact
    rows : by the misconception's name
    issued : how many variants were issued at the first draw of the parameters, at the second, and so on: the first in
        which all mistakes could be told
    """

    exercise: str
    version: int
    variants: int
    careful: int
    losing: int
    too_exact: int
    rows: dict[str, SimulatedRow]
    issued: tuple[int, ...]

    @property
    def false_rejections(self) -> float:
        """Part of the careful hands that lost any point."""
        return self.losing / self.careful

    @property
    def false_acceptances(self) -> float:
        """Part of the submissions with a mistake that earned all marks."""
        hands = sum(row.hands for row in self.rows.values())
        return sum(row.accepted for row in self.rows.values()) / hands if hands else 0.0

    @property
    def right_diagnoses(self) -> float:
        """Part of the submissions with a mistake in which that mistake was named."""
        hands = sum(row.hands for row in self.rows.values())
        return sum(row.named.get(name, 0) for name, row in self.rows.items()) / hands if hands else 1.0

    @property
    def draws(self) -> float:
        """Draws of the parameters for a variant, on average."""
        return sum(count * draw for draw, count in enumerate(self.issued, 1)) / self.variants

    def to_dict(self) -> dict[str, Any]:
        """As JSON takes it."""
        rates = ("false_rejections", "false_acceptances", "right_diagnoses", "draws")
        return asdict(self) | {name: getattr(self, name) for name in rates}


def simulate(
    exercise: Exercise, secret: bytes, variants: int, hands: int, step: Callable[[int, int], None] = lambda a, b: None
) -> Simulation:
    """Draw variants, and on each of them as many careful students, and as many with every mistake.

    step : hears how many variants of how many are done

    Raises
    ------
    DesignError : there is a student for whom no draw of the parameters can be diagnosed
    """
    careful, wrong = _Tally(), {name: _Tally() for name in exercise.misconceptions}
    issued: Counter[int] = Counter()
    for k in range(variants):
        variant, answer_key = issue(exercise, f"student {k}", secret)
        issued[variant.draw] += 1
        # Never the seed of the hands that the answer key was made from.
        drawn = board_chain(variant.task, exercise.hand.pencil(hands, 1 + k))
        careful.mark(exercise, answer_key, drawn)
        for name, tally in wrong.items():
            tally.mark(exercise, answer_key, misconception(name).change(drawn))
        step(k + 1, variants)
    rows = {name: SimulatedRow(each.hands, each.accepted, dict(each.named)) for name, each in wrong.items()}
    counts = (careful.hands, careful.hands - careful.accepted, careful.too_exact)
    draws = tuple(issued[draw] for draw in range(max(issued) + 1))
    return Simulation(exercise.name, exercise.version, variants, *counts, rows, draws)


def _submission(exercise: Exercise, drawn: Drawn, row: int) -> Answers:
    pairs = zip(exercise.answers, drawn, strict=True)
    return Answers({a.name: float(v[row]) if a.kind == "number" else v[row] for a, v in pairs})
