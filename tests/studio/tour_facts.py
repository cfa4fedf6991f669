"""What the cards of the tours rest on, found by solving."""

from __future__ import annotations

import math
from functools import cache
from json import dumps, loads

import numpy as np

import graphcam as gc
from graphcam.studio.task_paths import changed_task
from graphcam.tasks.task_file import task_of

FALLEN, SAME = -1, 0
ALIKE = 1e-6


@cache
def _facts(task: str) -> dict[str, float]:
    solution = gc.solve(task_of("card", loads(task)))
    extremes, integrated = solution.cam.extremes(), solution.chain.integration
    phi = np.linspace(0, 360, 36_001)
    curvature = solution.cam.pitch_curvature(np.radians(phi))
    return {
        **solution.comparison.exact,
        **{f"mu_{name}": integrated.readings[name].per_mm for name in "sva"},
        "height_v": float(np.ptp(integrated.readings["v"].paper)),
        "undercuts": float(len(solution.cam.undercuts())),
        "phi_steepest": math.degrees(extremes.pressure_angle_rise[1]),
        # A rise and a return by the same law are equally sharp: the cards tell of the return.
        "phi_sharpest": float(phi[curvature > (1 - ALIKE) * curvature.max()][-1]),
    }


def facts(task: dict) -> dict[str, float]:
    """The quantities of a task, those of its drawing among them."""
    return _facts(dumps(task, sort_keys=True))


def trend(task: dict, rests: dict) -> int:
    """Whether a quantity grows (1), stays (0) or falls (-1) with the changes of a card."""
    before, after = (facts(each)[rests["quantity"]] for each in (task, changed_task(task, rests["with"])))
    return 0 if math.isclose(before, after, rel_tol=ALIKE) else int(np.sign(after - before))


def right_choice(task: dict, card: dict) -> int:
    """Which choice of a card is right."""
    rests = card["rests"]
    after = facts(changed_task(task, rests.get("with", {})))
    if "each" in rests:
        moved = [not math.isclose(facts(task)[name], after[name], rel_tol=ALIKE) for name in rests["each"]]
        return moved.index(rests["which"] == "changes") if moved.count(rests["which"] == "changes") == 1 else -1
    name = rests["quantity"]
    before = facts(task)[name]
    for key, value in (
        ("numbers", after[name]),
        ("ratios", after[name] / before),
        ("differences", after[name] - before),
    ):
        if key in rests:
            return int(np.argmin(np.abs(np.array(rests[key]) - value)))
    said = {1: "It grows", 0: "It stays the same", -1: "It falls"}[trend(task, rests)]
    return card["choices"].index(said)
