"""The figures of a simulation are counts of the records that marking made, every hand of every variant once."""

from __future__ import annotations

from collections import defaultdict
from types import SimpleNamespace

import numpy as np
import pytest
from issued_variants import issued, key
from typer.testing import CliRunner

from graphcam.cli import app
from graphcam.exercises.definition.exercise import Answers
from graphcam.exercises.definition.student_hands import HANDS
from graphcam.exercises.key.unlisted_mistakes import UnlistedOutcomes
from graphcam.exercises.marking import simulate as module
from graphcam.exercises.marking.marking import mark
from graphcam.exercises.marking.simulate import CopyGain, HandCount, SimulatedRow, Simulation, copy_gain, simulate

MISTAKES = ("offset-sign", "base-circle")
CAREFUL = [(8, None, True), (8, None, True), (8, None, False), (7, "base-circle", False), (8, None, False)]
"""Marks of 8, the mistake named, and whether it is remarked on as exact as a program: of five hands on each variant."""
SLIPS = {
    "offset-sign": [(8, None, False)] * 2 + [(5, "base-circle", True)] + [(3, "offset-sign", False)] * 2,
    "base-circle": [(3, "base-circle", False)] * 4 + [(8, "base-circle", False)],
}
DRAWS = (0, 2, 2)
"""Of the three variants, the draw of the parameters that could be diagnosed."""


@pytest.fixture
def figures(monkeypatch) -> tuple[Simulation, list[tuple[int, int]], list[dict[str, object]]]:
    """What is simulated of records that are known, what was told of the progress, and all answers marked."""
    marked: list[dict[str, object]] = []

    def chain(records, seed):
        pencil = SimpleNamespace(samples=len(records), seed=seed)
        # By the hands of any population all is drawn as by the exercise's.
        return SimpleNamespace(
            records=records, pencil=pencil, by=lambda other: chain(CAREFUL, other.seed), perfect=None
        )

    def answers_of(exercise, chain):
        return [np.arange(10.0 * k, 10.0 * k + 5) for k in range(4)] + [np.arange(10.0).reshape(5, 2) + 0j]

    records: list = []

    def counted(self, exercise, answer_key, drawn):
        records[:] = drawn.records
        original(self, exercise, answer_key, drawn)

    def mark(exercise, answer_key, answers):
        marked.append(dict(answers.values))
        total, named, too_exact = records.pop(0)
        diagnosis = SimpleNamespace(misconception=named, alike=()) if named else None
        return SimpleNamespace(total=total, of=8, diagnosis=diagnosis, too_exact=too_exact)

    original = module._Tally.mark
    monkeypatch.setattr(module._Tally, "mark", counted)
    monkeypatch.setattr(module, "answers_of", answers_of)
    monkeypatch.setattr(module, "unlisted_answers", lambda *_: ())
    monkeypatch.setattr(module, "perfect_hands", lambda *_: None)
    outcomes = UnlistedOutcomes(("polar-angle", "end-ordinate"), ("end-ordinate",), ("wrong-law: 3-4-5",))
    monkeypatch.setattr(module, "unlisted_outcomes", lambda *_: outcomes)
    monkeypatch.setattr(module, "copy_gain", lambda _, done: CopyGain(len(done)))
    monkeypatch.setattr(module, "key_without", lambda *_: None)
    monkeypatch.setattr(module, "mark", mark)
    key_of_one = SimpleNamespace(expected=None)
    variants = [
        (SimpleNamespace(draw=draw, task=None), SimpleNamespace(keys=defaultdict(lambda: key_of_one), bound=3))
        for draw in DRAWS
    ]
    monkeypatch.setattr(module, "course_variants", lambda *_: iter(variants))
    monkeypatch.setattr(module, "board_chain", lambda task, pencil: chain(CAREFUL, pencil.seed))
    changes = {name: SimpleNamespace(change=lambda drawn, each=each: chain(each, 0)) for name, each in SLIPS.items()}
    monkeypatch.setattr(module, "misconception", changes.__getitem__)
    asked = [SimpleNamespace(name=name, kind="curve" if name == "p" else "number") for name in "abcdp"]
    hand = SimpleNamespace(pencil=lambda hands, seed: SimpleNamespace(seed=seeds.append((hands, seed))))
    seeds: list[tuple[int, int]] = []
    exercise = SimpleNamespace(name="toy", version=3, misconceptions=MISTAKES, answers=asked, hand=hand)
    progress: list[tuple[int, int]] = []
    found = simulate(exercise, b"", 3, 5, lambda *done: progress.append(done))
    # Every variant has hands of its own, never those of the answer key.
    assert seeds == [(5, 1), (5, 2), (5, 3)]
    return found, progress, marked


def test_every_record_is_counted_once(figures):
    found, progress, marked = figures
    assert (found.exercise, found.version, found.variants) == ("toy", 3, 3)
    assert (found.careful, found.losing, found.too_exact) == (15, 3, 6)
    assert found.rows == {
        "offset-sign": SimulatedRow(15, 6, {"offset-sign": 6, "none": 6, "base-circle": 3}),
        "base-circle": SimulatedRow(15, 3, {"base-circle": 15}),
    }
    assert found.issued == (1, 0, 2)
    assert progress == [(1, 3), (2, 3), (3, 3)]
    # The three populations, and the ten wrong ones again, their mistake left out of the key.
    assert len(marked) == 3 * (25 + 3 * 5)
    assert found.populations == dict.fromkeys(HANDS, HandCount(15, 3))
    first, points = marked[2], marked[2]["p"]
    assert [first[name] for name in "abcd"] == [2.0, 12.0, 22.0, 32.0]
    assert {type(first[name]) for name in "abcd"} == {float}
    assert points.tolist() == [4, 5]


def test_a_mistake_is_named_too_beside_one_that_the_answers_cannot_tell_from_it():
    key = SimpleNamespace(inseparable_from=lambda made: {"base-circle"} if made == "offset-sign" else set())

    def counted(name: str, *alike: str) -> str:
        return module._name_of(SimpleNamespace(misconception=name, alike=alike), key, "offset-sign")

    assert counted("base-circle", "offset-sign") == "offset-sign"
    assert counted("base-circle") == "base-circle"
    assert counted("end-ordinate", "offset-sign") == "end-ordinate"


def test_the_rates_are_parts_of_the_hands(figures):
    found = figures[0]
    assert found.false_rejections == 3 / 15
    assert found.false_acceptances == 9 / 30
    assert found.right_diagnoses == 21 / 30
    # Marked once more without their mistake: six of thirty earn all marks and are told nothing.
    assert found.left_out == module.OutsideCount(24, 24)
    assert found.outside_named == 1.0
    assert found.draws == (1 * 1 + 3 + 3) / 3
    said = found.to_dict()
    assert found.unlisted.rate == said["unlisted_kept"] == 1 / 2
    assert said["unlisted"]["shown"] == {"end-ordinate": 3, "polar-angle": 3}
    assert (said["unlisted"]["kept"], said["unlisted"]["near"]) == ({"end-ordinate": 3}, {"wrong-law: 3-4-5": 3})
    assert said["copies"] == {"pairs": 3, "best": 0.0, "above_half": 0}
    assert [said[rate] for rate in ("false_rejections", "right_diagnoses", "draws")] == [0.2, 0.7, 7 / 3]
    assert found.rows["offset-sign"].named_share("offset-sign") == 6 / 15
    assert found.rows["offset-sign"].named_share("polar-angle") == 0.0


def test_a_mistake_that_is_never_named_is_not_diagnosed_at_all():
    rows = {"offset-sign": SimulatedRow(4, 0, {"none": 4}), "base-circle": SimulatedRow(4, 1, {"base-circle": 4})}
    found = Simulation("toy", 1, 1, 4, 0, 0, rows, (1,))
    assert (found.false_acceptances, found.right_diagnoses) == (1 / 8, 4 / 8)


def test_an_exercise_without_mistakes_has_none_that_pass_or_are_misnamed():
    found = Simulation("toy", 1, 1, 5, 0, 0, {}, (1,))
    assert (found.false_acceptances, found.right_diagnoses) == (0.0, 1.0)


def test_real_hands_are_all_marked():
    exercise, _ = issued("integration")
    found = simulate(exercise, b"any", 1, 4)
    assert (found.careful, [row.hands for row in found.rows.values()]) == (4, [4] * len(exercise.misconceptions))


def test_every_variant_is_marked_by_every_others_key():
    exercise, first = issued("integration")
    second = issued("integration", "Boris")[1]
    right = [(each, Answers(key(each))) for each in (first, second)]
    parts = [mark(exercise, each, Answers(key(other))).total / exercise.marks for each, other in
             ((first, second), (second, first))]  # fmt: skip
    found = copy_gain(exercise, right)
    assert found == CopyGain(2, max(parts), sum(part > 0.5 for part in parts))
    assert found.best < 1.0
    # Who copies from the same variant has all marks, and one alone has nobody to copy from.
    assert copy_gain(exercise, [right[0], right[0]]) == CopyGain(2, 1.0, 2)
    assert copy_gain(exercise, right[:1]) == CopyGain()


def test_the_share_of_copies_is_simulated_and_printed():
    result = CliRunner().invoke(app, ["exercise", "simulate", "integration", "--variants", "2", "--hands", "2"])
    assert "by a copy of another variant, of 2:" in " ".join(result.output.split())
