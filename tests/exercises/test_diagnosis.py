"""The diagnosis is Bayes' rule: each mistake is as probable as it makes the answers, and so is "something else"."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
import pytest
from issued_variants import issued

from graphcam.exercises.definition.exercise import AskedAnswer
from graphcam.exercises.key.answer_key import AnswerKey, Hypothesis
from graphcam.exercises.key.expected_answers import Expected
from graphcam.exercises.marking import diagnosis as module
from graphcam.exercises.marking.diagnosis import ComparedAnswer, diagnose

BOUND = 2.0
NUMBER = AskedAnswer("number", "A length.", "integration", reading="s", unit="mm")
POINTS = AskedAnswer("points", "The stations.", "inversion", points="pitch", kind="points", layer="PITCH")


def at(place: float, scatter: float = 1.0) -> Expected:
    """A number that is expected there."""
    return Expected(place, scatter)


def drawn_at(place: complex, scatter: float = 1.0) -> Expected:
    """A point that is expected there."""
    return Expected(np.array([place]), np.array([scatter]))


def answer(place: int, given: float | complex, key: Expected, wrong: bool | None = None) -> ComparedAnswer:
    """An answer beside its key; a complex one is drawn."""
    asked = POINTS if isinstance(given, complex) else NUMBER
    read = np.array([given]) if isinstance(given, complex) else given
    off = key.deviation_of(read, asked.kind)
    return ComparedAnswer(place, asked, read, key, off, abs(off.deviation) > BOUND if wrong is None else wrong)


def key_with(**mistakes: list[Expected]) -> AnswerKey:
    """An answer key whose mistakes bring these answers."""
    hypotheses = {name: Hypothesis.of(values) for name, values in mistakes.items()}
    return replace(issued("integration")[1], bound=BOUND, hypotheses=hypotheses)


def density(off: float, scatter: float = 1.0) -> float:
    """Of an answer so many standard deviations off: no normal one beyond five, for there anything is as probable."""
    return math.exp(-(min(abs(off), 5.0) ** 2) / 2) / scatter


def bayes(key: AnswerKey, compared: list[ComparedAnswer]) -> tuple[str, float, set[str], set[int]] | None:
    """The mistake, its probability, those that are not told from it, and the answers it brings: without short cuts."""

    def off(name: str, each: ComparedAnswer) -> float:
        return key.hypotheses[name][each.place].deviation(each.given, each.asked.kind)

    def width(value: Expected) -> float:
        return value.scatter if isinstance(value.scatter, float) else 1.0

    def looks_like(name: str, each: ComparedAnswer) -> bool:
        nought = isinstance(each.given, float) and abs(each.given) <= BOUND * key.hypotheses[name][each.place].scatter
        return each.wrong and abs(off(name, each)) <= 5.0 and not nought

    def anywhere(each: ComparedAnswer) -> float:
        if not each.wrong:
            return density(each.off.deviation, width(each.key))
        if not isinstance(each.given, float):
            return density(5.0)
        larger = abs(each.given) / max(abs(each.key.value), each.key.scatter)
        return math.exp(-8.0) / (width(each.key) * min(100.0, max(1.0, larger)))

    def most(name: str) -> bool:
        def speaks_against(each: ComparedAnswer) -> bool:
            mistaken = key.hypotheses[name][each.place].value
            would_be_right = isinstance(mistaken, float) and abs(mistaken - each.key.value) <= BOUND * each.key.scatter
            return abs(off(name, each)) > 5.0 and (each.wrong or not would_be_right)

        against = sum(map(speaks_against, compared))
        like = sum(each.wrong and abs(off(name, each)) <= 5.0 for each in compared)
        return 100 * like >= 85 * (like + against)

    other = math.prod(map(anywhere, compared))
    brought = {
        name: math.prod(density(off(name, each), width(values[each.place])) for each in compared)
        for name, values in key.hypotheses.items()
        if any(looks_like(name, each) for each in compared) and most(name)
    }
    if not brought:
        return None
    best, total = max(brought, key=lambda name: brought[name]), sum(brought.values()) + other
    alike = {name for name, each in brought.items() if each >= 0.1 * brought[best]} - {best}
    if sum(brought[name] for name in (best, *alike)) < 0.5 * total:
        return None
    explained = {each.place for each in compared if looks_like(best, each) and abs(off(best, each)) <= BOUND}
    return best, brought[best] / total, alike, explained


def random_work(random: np.random.Generator) -> tuple[AnswerKey, list[ComparedAnswer]]:
    """Answers near the key or near one of three mistakes, numbers and drawn points, with scatters of all sizes."""
    drawn = [False] * random.integers(0, 4) + [True] * random.integers(0, 3)
    scatters = random.choice([0.25, 0.5, 1.0, 2.0], (4, len(drawn)))
    places = np.cumsum(random.choice([0.0, 0.0, 1.0, 3.0, 8.0], (4, len(drawn))), axis=0) + 6.0
    values = [
        [(drawn_at(complex(p), s) if d else at(p, s)) for d, p, s in zip(drawn, *row, strict=True)]
        for row in zip(places.tolist(), scatters.tolist(), strict=True)
    ]
    own = places[random.integers(0, 4)] + random.choice([-9.0, -1.0, 0.0, 0.5, 2.0, 4.0], len(drawn))
    given = [complex(g) if d else float(g) for d, g in zip(drawn, own, strict=True)]
    compared = [answer(k, *pair) for k, pair in enumerate(zip(given, values[0], strict=True))]
    return key_with(first=values[1], second=values[2], third=values[3]), compared


def test_the_diagnosis_is_the_most_probable_mistake_by_bayes_rule():
    random, seen = np.random.default_rng(4), Counter[str]()
    for _ in range(1000):
        key, compared = random_work(random)
        expected, found = bayes(key, compared), diagnose(key, compared)
        if expected is None:
            assert found is None
            seen["none"] += 1
            continue
        assert found is not None
        best, probability, alike, explained = expected
        told, places = found
        # Several may be equally probable.
        assert best in (told.misconception, *told.alike)
        assert told.confidence == pytest.approx(probability, rel=2e-6)
        if told.misconception == best:
            assert (set(told.alike), places) == (alike, explained)
        seen.update(["named", *(["alike"] if alike else []), *(["explained"] if explained else [])])
        seen["in doubt"] += probability < 0.9
    assert min(seen[each] for each in ("none", "named", "alike", "explained", "in doubt")) > 50


def test_a_mistake_as_probable_as_something_else_is_still_named():
    # At four deviations from what the mistake brings something else is exactly as probable.
    for given, beyond in ((13.999, 14.001), (6.001, 5.999)):
        told, explained = diagnose(key_with(slip=[at(10.0)]), [answer(0, given, at(30.0))])
        assert (told.misconception, told.confidence, told.alike) == ("slip", pytest.approx(0.5, abs=1e-3), ())
        assert explained == set()
        assert diagnose(key_with(slip=[at(10.0)]), [answer(0, beyond, at(30.0))]) is None


@pytest.mark.parametrize(("near", "named"), [(1, False), (10, False), (16, False), (17, True), (20, True)])
def test_a_mistake_that_leaves_more_than_15_percent_of_the_wrong_answers_unexplained_is_not_named(near, named):
    # Each answer that is near speaks for the mistake beyond doubt: only their share can speak against it.
    compared = [answer(k, 100.0 if k < near else 160.0, at(500.0)) for k in range(20)]
    assert (diagnose(key_with(slip=[at(100.0)] * 20), compared) is not None) == named


@pytest.mark.parametrize(("brought", "named"), [(506.0, False), (494.0, False), (501.9, True), (500.0, True)])
def test_right_answers_that_a_mistake_would_have_made_wrong_speak_against_it(brought, named):
    # The last answer is right, and so far from what the mistake brings that it was not made, or that is right as well.
    compared = [answer(k, 100.0, at(500.0)) for k in range(5)] + [answer(5, 500.0, at(500.0))]
    narrow = at(brought, 0.3)
    assert (diagnose(key_with(slip=[*[at(100.0)] * 5, narrow]), compared) is not None) == named


@pytest.mark.parametrize(("right", "named"), [(500j, False), (100j, True)])
def test_a_right_drawing_that_a_mistake_would_have_made_another_speaks_against_it(right, named):
    compared = [answer(k, 100.0, at(500.0)) for k in range(5)] + [answer(5, right, drawn_at(right))]
    assert (diagnose(key_with(slip=[*[at(100.0)] * 5, drawn_at(100j)]), compared) is not None) == named


def test_an_answer_of_more_marks_counts_for_more_in_what_is_explained():
    heavy = replace(NUMBER, marks=6.0)
    for first, named in ((heavy, True), (NUMBER, False)):
        compared = [answer(k, 100.0 if k == 0 else 160.0, at(500.0)) for k in range(2)]
        compared[0] = compared[0]._replace(asked=first)
        # An answer elsewhere costs 15; what is asked first lies so near that only the share decides.
        found = diagnose(key_with(slip=[at(100.0, 1e-9), at(100.0)]), compared)
        assert (found is not None) == named


def test_a_mistake_that_makes_a_number_larger_is_named_though_its_scatter_is_larger_too():
    # Fifty times the number with fifty times the scatter: as near to what the mistake brings as any.
    told, _ = diagnose(key_with(slip=[at(5000.0, 50.0)]), [answer(0, 5050.0, at(100.0))])
    assert told.confidence > 0.98


def test_a_drawing_five_deviations_off_still_looks_like_the_mistake():
    assert diagnose(key_with(slip=[drawn_at(10)]), [answer(0, 15 + 0j, drawn_at(30))]) is not None
    assert diagnose(key_with(slip=[drawn_at(10)]), [answer(0, 15.001 + 0j, drawn_at(30))]) is None


@pytest.mark.parametrize("kind", [float, complex])
def test_what_the_mistake_brings_within_the_tolerance_is_explained_its_edge_included(kind):
    expected = drawn_at if kind is complex else at
    for off, explained in ((2.0, {0}), (2.001, set())):
        _, places = diagnose(key_with(slip=[expected(10.0)]), [answer(0, kind(10.0 + off), expected(30.0))])
        assert places == explained


def test_who_answers_nought_does_not_make_the_mistake_that_makes_an_answer_small():
    for given, named in ((2.0, False), (2.001, True), (-2.0, False)):
        found = diagnose(key_with(slip=[at(0.5 * math.copysign(1, given))]), [answer(0, given, at(30.0))])
        assert (found is not None) == named


def test_an_answer_that_is_right_by_a_wide_tolerance_costs_no_more_than_one_that_is_anywhere():
    # Seven deviations, which are right here: as probable as five, for something else as for the mistake.
    right, wrong = answer(0, 7.0, at(0.0), wrong=False), answer(1, 13.0, at(30.0))
    told, _ = diagnose(key_with(slip=[at(0.0), at(10.0)]), [right, wrong])
    assert told.confidence == pytest.approx(1 / (1 + math.exp(-3.5)), rel=1e-12)
    told, _ = diagnose(key_with(slip=[at(7.0), at(10.0)]), [right, wrong])
    assert told.confidence == pytest.approx(1 / (1 + math.exp(-16.0)), rel=1e-12)


@pytest.mark.parametrize(("part", "alike"), [(0.11, ("other",)), (0.09, ())])
def test_a_tenth_as_probable_as_the_best_is_not_told_from_it(part, alike):
    off = math.sqrt(-2 * math.log(part))
    told, _ = diagnose(key_with(one=[at(10.0)], other=[at(10.0 + off)]), [answer(0, 10.0, at(30.0))])
    assert told.alike == alike


def test_a_tenth_of_the_best_is_meant_also_where_something_else_is_more_probable_than_that():
    # All as far off as "something else" costs, so that only the scatters count: 0.8, 0.8 and 0.1 to 1 for that.
    off = 4.0
    one, third = [at(200 - 1.25 * off, 1.25)], [at(200 - 10 * off, 10.0)]
    told, _ = diagnose(key_with(one=one, two=one, third=third), [answer(0, 200.0, at(300.0))])
    assert (told.misconception, told.alike) == ("one", ("two", "third"))
    assert told.confidence == pytest.approx(0.8 / 2.7, rel=1e-9)


def test_right_answers_are_no_sign_of_a_mistake():
    both = [at(10.0), at(10.0)]
    assert diagnose(key_with(slip=both), [answer(k, 10.0, at(10.0)) for k in range(2)]) is None
    both = [drawn_at(10), drawn_at(10)]
    assert diagnose(key_with(slip=both), [answer(k, 10 + 0j, drawn_at(10)) for k in range(2)]) is None


def test_mistakes_that_bring_the_same_are_alike_however_strictly_they_are_told(monkeypatch):
    monkeypatch.setattr(module, "ALIKE_PROBABILITY", 1.0)
    told, _ = diagnose(key_with(one=[at(10.0)], same=[at(10.0)]), [answer(0, 10.0, at(30.0))])
    assert (told.misconception, told.alike) == ("one", ("same",))


def test_hundreds_of_answers_that_one_mistake_explains_and_another_does_not_are_told():
    # The densities themselves would be too small or too large for a number.
    for scatter in (1e-6, 1e6):
        one, another = [at(10.0 * scatter, scatter)] * 200, [at(20.0 * scatter, scatter)] * 200
        compared = [answer(k, 10.0 * scatter, at(40.0 * scatter, scatter)) for k in range(200)]
        told, explained = diagnose(key_with(one=one, another=another), compared)
        assert (told.misconception, told.confidence, len(explained)) == ("one", 1.0, 200)
        assert diagnose(key_with(another=another), compared) is None


@dataclass
class Watched(Hypothesis):
    """A mistake that knows whether its drawings were looked at."""

    said: list
    looked: bool = False

    def __getitem__(self, place: int) -> Expected:
        self.looked = True
        return super().__getitem__(place)


def looked_for(offs: list[float], drawn: int, wrong: int, right: dict[str, list[Expected]]) -> bool:
    """Whether a mistake that brings numbers so far off is looked for in so many wrong drawings.

    wrong : so many of the numbers are wrong, 30 from a key of 0; the others are right
    """
    given = [30.0] * wrong + [0.0] * (len(offs) - wrong)
    compared = [answer(k, each, at(0.0)) for k, each in enumerate(given)]
    compared += [answer(len(offs) + k, 90 + 0j, drawn_at(0)) for k in range(drawn)]
    brought = [at(each + off) for each, off in zip(given, offs, strict=True)] + [drawn_at(0)] * drawn
    watched = Watched(Hypothesis.of(brought).said)
    key = key_with(**right)
    diagnose(replace(key, hypotheses={**key.hypotheses, "watched": watched}), compared)
    return watched.looked


def test_a_mistake_is_looked_for_in_a_drawing_unless_the_numbers_make_it_hopeless():
    # Beside "something else", which costs 25 for the wrong drawing: 25 + 25 + 4 + 1 is worse by exactly 30.
    assert looked_for([9.0, 9.0, 2.0, 1.0], 1, 0, {})
    assert not looked_for([9.0, 9.0, 2.0, 1.01], 1, 0, {})
    # Beside a mistake that explains all numbers, even if no drawing: that costs 25 for each of two drawings.
    explains = {"explains": [at(30.0), at(30.0), at(0.0), at(0.0), at(0.0), drawn_at(0), drawn_at(0)]}
    assert looked_for([9.0, 9.0, 9.0, 2.0, 1.0], 2, 2, explains)
    assert not looked_for([9.0, 9.0, 9.0, 2.0, 1.01], 2, 2, explains)
    # One that explains none of the wrong numbers is no reason not to look.
    explains_none = {"none": [at(50.0), at(50.0), at(0.0), at(0.0), at(0.0), drawn_at(0), drawn_at(0)]}
    assert looked_for([9.0, 9.0, 9.0, 2.0, 1.01], 2, 2, explains_none)
