"""What every step owes to who draws it again: a reason, a caption, and parts that together draw all of it, once."""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from golden_random import SOME as RANDOM
from numbers_on_the_board import not_on_the_board, share_found
from over_all import over_all
from test_acts import own_marks

import graphcam as gc
from graphcam.drafting.acts import Act, Kind
from graphcam.drafting.ink import Construction, Part, Step
from graphcam.errors import DesignError
from graphcam.report.sheet_contents import all_constructions

BUILT_IN = {name: gc.builtin_task(name) for name in ("coursework", "arm", "flat", "measured", "sizing")}
FILES = Path(__file__).parents[1] / "data" / "told_once"
OF_FILES = {file.stem: gc.load_task(file) for file in sorted(FILES.glob("*.toml"))}
TASKS = {"arcs": gc.builtin_arcs_task()} | BUILT_IN | OF_FILES | RANDOM
Place = tuple[Act, int]
EVERY = over_all("name", TASKS)


@cache
def steps(name: str) -> list[tuple[str, Construction, Step]]:
    """Every step of every construction of a task, with where it is found; none where no cam solves it."""
    try:
        solution = gc.solve(TASKS[name])
        drawn = all_constructions(solution)
    except DesignError:
        return []
    return [(f"{key}: {step.title}", each, step) for key, each in drawn.items() for step in each.steps()]


def sentences(text: str) -> list[str]:
    """The sentences of a text: one ends where a point, a question or an exclamation is followed by a capital."""
    return re.split(r"(?<=[.!?])\s+(?=[A-ZΑ-Ω])", text)


@EVERY
def test_every_step_has_a_reason_of_one_sentence_and_a_caption(name):
    for where, construction, step in steps(name):
        why, caption = str(step.why), str(step.caption)
        if not why and not construction.acts:
            continue  # a diagram that is computed: nobody draws it step by step
        assert why, where
        assert len(sentences(why)) == 1, (where, why)
        for said in (why, caption):
            # A symbol, such as p₀, begins as it is written.
            assert not re.match("[a-z]+[ ,.]", said), (where, said)
            assert said.endswith("."), (where, said)
            assert not re.search(r"\b(nan|inf)\b|\{|\}|-0\.0+\b", said), (where, said)


@EVERY
def test_a_reason_stands_alone_as_a_sentence(name):
    found = [(where, str(step.why)) for where, _, step in steps(name)]
    assert [(where, why) for where, why in found if why.startswith("Because")] == []


@EVERY
def test_the_captions_of_places_are_sentences_and_all_different(name):
    for where, _, step in steps(name):
        said = [str(part.caption) for part in (*step.places, *(part for part in step.parts if part.rows))]
        for each in said:
            assert each.endswith("."), (where, each)
            assert not re.search(r"\b(nan|inf)\b|\{|\}|-0\.0+\b", each), (where, each)
        assert [text for text, n in Counter(said).items() if n > 1] == [], where


def told_twice(step: Step) -> list[str]:
    """The sentences of a step that are told more than once."""
    every = [sentence for part in step.parts for sentence in sentences(str(part.caption))]
    return [sentence for sentence, n in Counter(every).items() if n > 1]


@EVERY
def test_no_sentence_of_a_step_is_told_twice(name):
    found = [(where, told) for where, each, step in steps(name) for told in told_twice(step)]
    assert found == []


def drawn_by(step: Step) -> list[list[Place]]:
    """The places that each place of a step draws."""
    return [[(each.act, k) for each in part.draws for k in each.index.tolist()] for part in step.places]


def left_out(step: Step) -> list[str]:
    """The marks of a step that no part draws, whole or at some place; a reading's number comes with the last part."""
    drawn = {place for part in drawn_by(step) for place in part}
    acts = {act for act, _ in drawn}
    found: list[str] = []
    for mark in own_marks(step):
        assert isinstance(mark.of, Act)
        if mark.of.kind is not Kind.READ:
            places = {(mark.of, 0)} if mark.index is None else {(mark.of, k) for k in mark.index.tolist()}
            known = mark.of in acts if mark.index is None else places <= drawn
            found += [] if known else [f"{type(mark).__name__} of {mark.of.name!r}, {sorted(k for _, k in places)}"]
    return found


@EVERY
def test_the_parts_of_a_step_draw_all_its_marks(name):
    for where, construction, step in steps(name):
        if construction.acts:
            assert left_out(step) == [], where


@EVERY
def test_no_place_is_drawn_by_two_parts(name):
    for where, _, step in steps(name):
        parts = Counter(place for part in drawn_by(step) for place in set(part))
        assert [(act.name, k) for (act, k), n in parts.items() if n > 1] == [], where


@EVERY
def test_every_part_draws_something_that_is_shown(name):
    """Given marks and axes count: what lies there already may be gone over.  What is reckoned draws nothing."""
    for where, _, step in steps(name):
        marked = {mark.of: mark.index for mark in step.marks if isinstance(mark.of, Act)}
        for part in step.places:
            shown = any(each.act in marked for each in part.draws) or not part.draws or not own_marks(step)
            assert shown, (where, str(part.caption))


@EVERY
def test_the_places_of_parts_and_marks_are_those_of_their_acts(name):
    for where, _, step in steps(name):
        for mark in step.marks:
            if isinstance(mark.of, Act) and mark.index is not None:
                assert np.all((mark.index >= 0) & (mark.index < mark.of.size)), where
        for act, k in (place for part in drawn_by(step) for place in part):
            assert 0 <= k < act.size, where


def test_a_part_that_is_missing_or_said_twice_would_be_found():
    _, _, found = next(each for each in steps("arcs") if str(each[2].title) == "Stations")
    step = replace(found, parts=tuple(Part(part.caption, part.draws) for part in found.places))
    assert left_out(step) == []
    assert left_out(replace(step, parts=step.parts[1:])) != []
    twice = replace(step, parts=(*step.parts, step.parts[0]))
    assert max(Counter(place for part in drawn_by(twice) for place in set(part)).values()) == 2
    assert told_twice(twice) == sentences(str(step.parts[0].caption))
    assert len(sentences("It is so. And so.")) == 2


# --- numbers ---------------------------------------------------------------------------------------------------------

TOLD = ("coursework", "arcs")
"""Tried always; as every task takes seconds, the others are slow."""
WATCHED = [*(name for name in TASKS if name not in RANDOM), "spring 20"]


def strays(name: str) -> list[tuple[str, str]]:
    """The numbers that steps of a task tell though they do not stand on the board, by step."""
    try:
        solution = gc.solve(TASKS[name])
    except DesignError:
        return []
    return [(where, found) for where, _, found in not_on_the_board(solution)]


@over_all("name", TOLD)
def test_every_number_that_a_part_tells_stands_on_the_board(name):
    assert strays(name) == []


@pytest.mark.slow
@over_all("name", [name for name in WATCHED if name not in TOLD])
def test_every_number_that_a_part_of_other_tasks_tells_stands_on_the_board(name):
    """Of more tasks: ``python tests/constructions/numbers_on_the_board.py --seed 1 --size 100``."""
    assert strays(name) == []


@pytest.mark.slow
def test_most_numbers_that_are_told_wrong_would_be_found():
    """Told 1.7 % off, as far as that is more than the digits that are printed."""
    assert share_found(gc.solve(TASKS["coursework"]), 1.017) > 0.7
