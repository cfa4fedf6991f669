"""Task files and addresses that an earlier graphcam made open as they did: people keep them in courses and in mail.

``data/kept`` was made once, by the graphcam of commit 4d74b9f, and stays as it is: 20 task files as ``init``, the
built-in tasks, the studio's download and the variants of exercises write them, with what each says; 17 addresses of the
step player and 13 of the studio, with what each opens.  A step may be worded anew and its parts may stand in a table:
what a place draws stays.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import graphcam as gc
from graphcam.drafting.act_order import pieces_of
from graphcam.drafting.ink import Step
from graphcam.report.documents import contents_of
from graphcam.studio.address import place_of
from graphcam.studio.task_text import built_in_tasks
from graphcam.tasks.task_file import load_task

ADDED = {"10.5/2": [["working_profile", "instant centres", [19]]]}
"""What a place draws besides what it drew: the normal at the profile goes through the instant centre."""
NO_DAMPING = ("damping", 0.0)
KEPT = Path(__file__).parent / "data" / "kept"
Plain = dict[str, Any]


def kept(name: str) -> Any:
    return json.loads((KEPT / f"{name}.json").read_text(encoding="utf-8"))


TASKS: Plain = kept("tasks")
PLAYER: list[Plain] = kept("player")
STUDIO: list[Plain] = kept("studio")


def as_json(data: object) -> Any:
    return json.loads(json.dumps(data))


def as_then(says: Plain) -> Plain:
    """What a task says, with the divisions that were filled in where it leaves them out: 12, as they are drawn now.

    Nor did a spring say that it has no damping, or a drawing that its dwells may be broken.

    (More only where an acceleration lasts less than a part; no kept task has one, as the sizes that they keep prove.)
    """
    if "spring" in says:
        says = says | {"spring": {key: value for key, value in says["spring"].items() if (key, value) != NO_DAMPING}}
    if "arcs" in says:
        return says
    drawing = {key: value for key, value in says.get("drawing", {}).items() if (key, value) != ("whole_turn", False)}
    return says | {"drawing": {"divisions": 12} | drawing}


def task_of(name: str) -> gc.Task | gc.ArcsTask:
    return load_task(KEPT / "tasks" / f"{name}.toml")


def sizes_of(solution: gc.Solution | gc.ArcsSolution) -> dict[str, float]:
    """The sizes that are read off the drawing, or given [mm]; three arcs have none."""
    names = ("prime_radius", "place", "roller_radius") if isinstance(solution, gc.Solution) else ()
    return {name: getattr(solution.chain, name) for name in names}


@cache
def contents(name: str):
    return contents_of(gc.solve(task_of(name)))


def places_of(step: Step) -> list[Any]:
    """What the player goes through: the parts of a step, of one with a table every row of it."""
    return list(getattr(step, "places", None) or step.parts)


def opened(name: str, address: str) -> Plain:
    """What the page of a task shows at ``7.2/14``, the fourteenth place of a step, at ``7.2`` or at ``7``."""
    number, _, which = address.partition("/")
    shown = contents(name)
    found = [each for each in shown.steps if f"{shown.numbers[each[0]]}.".startswith(f"{number}.")]
    running, construction, step = found[0]
    places = places_of(step)
    drawn = places[int(which) - 1].draws if which else [each for place in places for each in place.draws]
    acts = [[piece.act.construction, piece.act.name, list(piece.at)] for piece in pieces_of(drawn)]
    if not which:
        acts = sorted({(construction, name) for construction, name, _ in acts})
    return as_json(
        {"step": shown.numbers[running], "construction": construction, "view": step.view.name, "draws": acts}
    )


def test_there_are_20_task_files_and_30_addresses():
    assert len(TASKS) == len(list((KEPT / "tasks").glob("*.toml"))) == 20
    assert len(PLAYER) + len(STUDIO) == 30


@pytest.mark.parametrize("name", TASKS)
def test_a_kept_task_file_says_what_it_said(name):
    assert as_then(as_json(task_of(name).to_dict())) == TASKS[name]["says"]


@pytest.mark.parametrize("name", TASKS)
def test_a_kept_task_is_drawn_as_it_was(name):
    solution = gc.solve(task_of(name))
    assert list(solution.drawn) == TASKS[name]["constructions"]
    assert sizes_of(solution) == pytest.approx(TASKS[name]["sizes"], rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("one", PLAYER, ids=[f"{one['task']}#{one['address']}" for one in PLAYER])
def test_a_kept_address_of_the_player_opens_what_it_opened(one):
    now = opened(one["task"], one["address"])
    for added in ADDED.get(one["address"], []):
        now["draws"].remove(added)
    assert now == one["opens"]


@pytest.mark.parametrize("one", STUDIO, ids=[one["address"][:24] for one in STUDIO])
def test_a_kept_address_of_the_studio_opens_what_it_opened(one):
    place = place_of(one["address"], as_json(built_in_tasks()))
    # An address says more now; those of then say nothing of it.
    opens = {name: value for name, value in as_json(vars(place)).items() if name in one["opens"] or value is not None}
    then = {name: as_then(opens[name]) for name in ("task", "pin") if opens.get(name)}
    assert opens | then == one["opens"]
