"""The player's page suffices to draw all again: a second board follows its moves, in order, to the readings."""

from __future__ import annotations

import html
import json
import math
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest
from golden_random import random_arcs_task
from over_all import over_all, over_seeds
from random_tasks import random_arm_task, random_flat_task, random_task
from replay import SecondBoard, off

import graphcam as gc
from graphcam.errors import DesignError
from graphcam.report.documents import contents_of, drawing_of
from graphcam.report.sheet_contents import Contents
from graphcam.report.step_player import player_of, slides

pytestmark = pytest.mark.slow

REACHED = 2e-5
"""mm or rad: the page writes numbers to 9 decimals, which crossings at a degree enlarge."""
BUILT_IN = {name: gc.builtin_task(name) for name in ("coursework", "arm", "flat", "measured", "sizing")}
TASKS = BUILT_IN | {"arcs": gc.builtin_arcs_task()}
SHOWN = range(0, 30, 10)
RANDOM = {
    "translating": random_task,
    "arm": random_arm_task,
    "flat": random_flat_task,
    "arcs": random_arcs_task,
}


def page_of(contents: Contents) -> tuple[dict[str, Any], list[Callable[..., Any]]]:
    """The data that the player's page carries, and the formulas by which one reckons."""
    page = player_of(contents, drawing_of(contents))
    (text,) = re.findall(r'<script[^>]*type="application/json"[^>]*>(.*?)</script>', page, re.DOTALL)
    return known(json.loads(html.unescape(text))), slides(contents)[1].record.formulas


def known(plain: Any) -> Any:
    """The same with numbers for what is nowhere, or infinitely far."""
    if isinstance(plain, dict):
        return {key: value if key in ("slice", "moves") else known(value) for key, value in plain.items()}
    if isinstance(plain, list):
        words = {"inf": math.inf, "-inf": -math.inf}
        return [math.nan if x is None else words.get(x, x) if isinstance(x, str) else known(x) for x in plain]
    return plain


@dataclass
class PageBoard(SecondBoard):
    """Draws only what a part says, and only from what lies there: places by the number of the act."""

    lies_there: dict[int, set[int]] = field(default_factory=dict[int, set[int]])

    def _lengths(self, plain: Any) -> tuple[list[float], bool]:
        """What is reckoned in the head comes to what the page says."""
        found = super()._lengths(plain)
        if isinstance(plain, dict) and "set to" in plain:
            assert off(np.array(plain["set to"], dtype=float), found[0]) < REACHED
        return found

    def size(self, number: int) -> int:
        """How many places an act leaves, or how many values are read."""
        found = self.figure(number)
        return len(found[0]) if isinstance(found, tuple) else len(found.points)

    def draw(self, number: int, at: list[int] | None) -> None:
        """Do one move: all that it takes must lie there."""
        places = list(range(self.size(number))) if at is None else at
        row = self.rows[number]
        there = self.lies_there.setdefault(number, set())
        there.update(places)
        for other, needed in self.needed(row, number, places):
            missing = set(needed) - self.lies_there.get(other, set())
            assert not missing, f"{row['name']} at {places} needs {self.rows[other]['name']} at {sorted(missing)}"

    def needed(self, row: dict[str, Any], number: int, places: list[int]) -> list[tuple[int, list[int]]]:
        """What a move takes: acts by number, and which places of each."""
        takes, size = row["takes"], self.size(number)
        if row["kind"] == "take":
            line = [(act, k) for part in takes["of"] for act, index in [self.indices(part)] for k in index]
            chosen = self.chosen(takes.get("which"), len(line))
            return [(line[chosen[k]][0], [line[chosen[k]][1]]) for k in places]
        if "chains" in takes:
            lines, cuts = self.indices(takes["lines"]), self.indices(takes["cuts"])
            found = [(cuts[0], [cuts[1][k] for k in places])]
            for cut, part in takes["chains"]:
                start, end = cut["slice"]
                inside = [k for k in places if start < k < end]
                found.append((lines[0], [lines[1][part["slice"][0] + k - start - 1] for k in inside]))
                found += [(number, list(range(start, k))) for k in inside]
            return found
        return [found for value in takes.values() for found in self.operands(value, size, places)]

    @staticmethod
    def chosen(which: Any, count: int) -> list[int]:
        """The numbers of what is taken of a row."""
        if which is None:
            return list(range(count))
        if isinstance(which, int):
            return [which]
        return list(range(count))[slice(*which["slice"])] if "slice" in which else [int(k) for k in which["array"]]

    def indices(self, plain: dict[str, Any]) -> tuple[int, list[int]]:
        """The act that a part of it belongs to, and which of its places."""
        if "act" in plain:
            return plain["act"], list(range(self.size(plain["act"])))
        act, whole = self.indices(plain["whole"])
        if "at" not in plain:
            return act, whole
        at = plain["at"]
        if isinstance(at, dict) and "array" in at and at["array"] and isinstance(at["array"][0], bool):
            return act, [k for k, kept in zip(whole, at["array"], strict=True) if kept]
        return act, [whole[k] for k in self.chosen(at, len(whole))]

    def operands(self, plain: Any, size: int, places: list[int]) -> list[tuple[int, list[int]]]:
        """What one thing that is taken stands on, at the same places or at all of its own."""
        if isinstance(plain, list):
            return [found for part in plain for found in self.operands(part, size, places)]
        if not isinstance(plain, dict):
            return []
        if "act" in plain or "whole" in plain:
            act, index = self.indices(plain)
            return [(act, [index[k] for k in places] if len(index) == size else index)]
        if "reading" in plain:
            own = self.size(plain["reading"])
            return [(plain["reading"], places if own == size else list(range(own)))]
        return [found for part in plain.values() for found in self.operands(part, size, places)]


def follow(contents: Contents) -> int:
    """Draw all that the page says, part by part; how many readings were reached."""
    data, formulas = page_of(contents)
    board, reached = PageBoard(data["acts"], formulas), 0
    for (_, name, step), said in zip(contents.steps, data["steps"], strict=True):
        for part in said["parts"]:
            for number, at in part["moves"]:
                board.draw(number, at)
        assert set(said["reads"]) == set(step.reads)
        for key, number in said["reads"].items():
            assert len(board.lies_there[number]) == board.size(number)
            paper = contents.drawn[name].readings[key].paper
            assert off(paper, board.figure(number)[0]) < REACHED, (name, key)
            reached += 1
    return reached


@over_all("name", TASKS)
def test_the_page_of_a_built_in_task_leads_to_all_readings(name):
    assert follow(contents_of(gc.solve(TASKS[name]))) > 10


def follow_random(kind: str, seed: int) -> int:
    """The same of a random task; of one that no cam solves there is no page."""
    try:
        task = RANDOM[kind](seed)
        # What fits no page has none.
        left_open = {"ordinate": None} if isinstance(task, gc.Task) else {}
        contents = contents_of(gc.solve(replace(task, drawing=replace(task.drawing, **left_open))))
    except DesignError:
        return 0
    return follow(contents)


@over_all("kind", RANDOM)
def test_the_pages_of_random_tasks_lead_to_all_readings(kind):
    assert sum(follow_random(kind, seed) > 10 for seed in SHOWN) >= len(SHOWN) - 1


@over_seeds([3])
@over_all("kind", RANDOM)
def test_the_page_of_a_random_task_of_every_follower_leads_to_all_readings(kind, seed):
    reached = follow_random(kind, seed)
    assert reached == 0 or reached > 10


def test_a_setting_that_is_missing_or_wrong_would_be_found():
    """With another pole distance the board lands elsewhere, and without a move what follows has nothing to stand on."""
    data, formulas = page_of(contents_of(gc.solve(TASKS["coursework"])))
    board = PageBoard(data["acts"], formulas)
    pole = next(row for row in data["acts"] if row["name"] == "P2")
    reads = next(step["reads"] for step in data["steps"] if "closing_s" in step["reads"])
    assert off(np.zeros(26), board.figure(reads["s"])[0]) > 10
    pole["takes"]["length"] *= 1.001
    with pytest.raises(AssertionError):
        PageBoard(data["acts"], formulas).figure(reads["s"])
    moves = [move for step in data["steps"] for part in step["parts"] for move in part["moves"]]
    number, at = next(move for move in moves if data["acts"][move[0]]["kind"] == "lay off")
    with pytest.raises(AssertionError, match="needs"):
        PageBoard(data["acts"], formulas).draw(number, at)
