"""What random tasks read off the paper with a perfect pencil, to hold against what they read before.

``PYTHONPATH=tests/comparison:tests/mechanism python tests/golden_random.py`` writes ``tests/golden_random.json`` anew:
where a reading is meant to change.  The file keeps every digit, one task a line; of a task that no cam solves, why.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from golden import readings
from random_tasks import random_arm_task, random_flat_task, random_task
from three_arcs import given, sound_data

import graphcam as gc
from graphcam.tasks.arcs_task import ArcsDrawingTable, ArcsTable, ArcsTask, RollerTable
from graphcam.tasks.task import CamTable, SpringTable

FILE = Path(__file__).with_name("golden_random.json")
ARCS = tuple(sound_data(30))
LEFT_OUT = ((), ("C1",), ("C2",), ("C1", "C2"), ("A",))
"""What the data of three arcs may leave open."""
TOLERANCE = 1e-12
NEAR_NOTHING = 1.0
"""mm of paper, or rad: a shorter reading is rounded as one of this length, for it ends lines of that length."""
Readings = dict[str, list[Any]]


def random_arcs_task(seed: int) -> ArcsTask:
    """A sound cam of three arcs: whatever may be left open, every dwell, with a roller and without."""
    random = np.random.default_rng([seed, 6])
    data = given(ARCS[seed], *LEFT_OUT[seed % len(LEFT_OUT)])
    return ArcsTask(
        ArcsTable(**data, dwell=random.choice([0.0, round(random.uniform(5, 90))]).item()),
        RollerTable(random.choice([0.0, 5.0, 12.0]).item()),
        drawing=ArcsDrawingTable(divisions=int(random.integers(2, 9))),
    )


def random_spring_task(seed: int) -> gc.Task:
    """A translating follower under a spring with a given preload: one that is left open is found by a solver."""
    random = np.random.default_rng([seed, 7])
    mass, stiffness, preload = (round(random.uniform(*span), 2) for span in ((0.1, 0.5), (1, 8), (20, 200)))
    return replace(
        random_task(seed), speed_rpm=round(random.uniform(50, 300)), spring=SpringTable(mass, stiffness, preload)
    )


def with_large_roller(seed: int) -> gc.Task:
    """An arm whose roller is larger than its pivot is far: no prime radius suits it."""
    task = random_arm_task(seed)
    return replace(task, cam=CamTable(), follower=replace(task.follower, roller_radius=500.0))


# No cam solves the last arm and the last flat face.  Left out are an arm and cams of arcs with a crossing so flat, or a
# circle so small, that it magnifies rounding, which differs between processors, to about the tolerance or more.
TASKS = {
    **{f"translating {seed}": random_task(seed) for seed in range(20)},
    **{f"arm {seed}": random_arm_task(seed) for seed in (*range(14), *range(15, 20), 59)},
    "arm 60": with_large_roller(60),
    **{f"flat {seed}": random_flat_task(seed) for seed in (*range(19), 38)},
    **{f"arcs {seed}": random_arcs_task(seed) for seed in (0, *range(4, 11), *range(12, 24))},
    **{f"spring {seed}": random_spring_task(seed) for seed in range(20, 26)},
}

SOME = {name: TASKS[name] for name in TASKS if int(name.split()[1]) < 6 or name in ("arm 60", "flat 38", "spring 20")}
"""A third of them, of every kind, for what holds of every board."""


def read(task: gc.Task | ArcsTask) -> Readings | str:
    """Every reading of every construction, by the names of both; why there is none, where there is no cam."""
    try:
        solution = gc.solve(task)
        drawn = dict(solution.drawn)
    except gc.DesignError as why:
        return str(why)
    if isinstance(task, gc.Task) and task.spring:
        drawn["force_plan"] = solution.spring.force_plan
    return {f"{name}.{key}": value for name, one in drawn.items() for key, value in readings(one).items()}


def near(before: list[float], now: list[float], nothing: float) -> bool:
    """Whether numbers in a row are the same but for the tolerance, of the greatest among them or of ``nothing``."""
    if len(before) != len(now):
        return False
    old = np.array(before)
    greatest = np.abs(old[np.isfinite(old)]).max(initial=nothing)
    return np.allclose(now, old, rtol=0.0, atol=TOLERANCE * greatest, equal_nan=True)


def differences(before: Readings | str, now: Readings | str) -> list[str]:
    """The readings of a task that have gone, or are not what they were before; new ones may come."""
    if isinstance(before, str) or isinstance(now, str):
        return [] if before == now else [f"{before!r:.80} became {now!r:.80}"]

    def same(name: str) -> bool:
        (paper, scale, unit), (paper_now, scale_now, unit_now) = before[name], now[name]
        return unit == unit_now and near(paper, paper_now, NEAR_NOTHING) and near(scale, scale_now, 0.0)

    gone = [f"{name} is gone" for name in before.keys() - now.keys()]
    return gone + [f"{name}: {before[name]} became {now[name]}" for name in before if name in now and not same(name)]


if __name__ == "__main__":
    lines = (f"{json.dumps(name)}: {json.dumps(read(task), ensure_ascii=False)}" for name, task in TASKS.items())
    FILE.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
