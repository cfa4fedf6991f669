"""Requests at random: sizes that can be, sizes that hardly can, and what is no size at all."""

import copy
import math
import random

from studio_tasks import BUILT_IN, plain_task

VIEWS = ["profile", "combined", "region", "plan", "acceleration", "velocity", "curvature", "angle", "arcs", "no view"]
NUMBERS = [0, 1, -1, 0.1, 1e-9, 1e9, -1e9, 1e300, 3, 12, 30, 45, 90, 180, 360, 1000, math.pi, 10**400, 5e-324, True]
OTHERS = [
    None,
    "",
    "A4",
    "iso",
    "ru",
    [],
    {},
    [1],
    [1, 2, 3],
    {"a": 1},
    "cycloidal",
    "flat-faced",
    "cw",
    math.nan,
    "💥",
]
FURTHER = {
    "follower": ["roller_radius", "offset", "distance", "arm", "kind", "roller_rule"],
    "cam": ["prime_radius"],
    "drawing": ["divisions", "ordinate", "poles", "rounding", "format", "frame", "orientation"],
    "limits": ["pressure_angle_rise", "pressure_angle_return", "rest", "min_curvature_radius"],
    "spring": ["mass", "stiffness"],
    "material": ["width", "permitted_stress"],
    "": ["speed_rpm", "pencil", "junk"],
}
"""Keys that a task need not have, by their tables."""


def random_request(seed):
    """A request, the same for a seed."""
    chance = random.Random(seed)
    name = chance.choice(BUILT_IN)
    task = copy.deepcopy(plain_task(name))
    for _ in range(chance.choice([1, 1, 2, 4])):
        _change(chance, task, bold=chance.random() < 0.4)
    if chance.random() < 0.8:
        _close(task)
    wanted = {what: chance.random() < 0.4 for what in ("told", "values", "warnings", "form", "mechanism")}
    views = [{"name": chance.choice(VIEWS), "px_per_mm": chance.choice([0.3, 1.9, 4])}]
    request = {"seq": seed, "task": task, "views": views, "language": chance.choice(["en", "ru"]), **wanted}
    if chance.random() < 0.1:
        request[chance.choice([*request, "phi", "hold", "drag", "upto", "station"])] = chance.choice(OTHERS + NUMBERS)
    return request


def _change(chance, task, *, bold):
    """Another value somewhere in a task."""
    places = [*_numbers_in(task)]
    if bold and chance.random() < 0.5:
        table = chance.choice([*FURTHER])
        inside = task.setdefault(table, {}) if table else task
        if isinstance(inside, dict):
            inside[chance.choice(FURTHER[table])] = chance.choice(NUMBERS + OTHERS)
    elif places:
        inside, key = chance.choice(places)
        if bold:
            inside[key] = chance.choice(NUMBERS + OTHERS)
        else:
            size = inside[key] * chance.uniform(0.5, 1.6)
            inside[key] = round(size) if isinstance(inside[key], int) else size


def _numbers_in(inside):
    """Where numbers stand in plain data; of a table of a measured motion in the first rows."""
    entries = inside.items() if isinstance(inside, dict) else enumerate(inside[:6])
    for key, value in entries:
        if isinstance(value, dict | list):
            yield from _numbers_in(value)
        elif isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e9:
            yield inside, key


def _close(task):
    """Phases that make a whole turn again, and fall as far as they rise, where they are phases at all."""
    try:
        phases = task["motion"]["phases"]
        turn = math.fsum(phase["angle"] for phase in phases)
        lift = next(phase["lift"] for phase in phases if "lift" in phase)
        for phase in phases:
            phase["angle"] *= 360 / turn
            if "lift" in phase:
                phase["lift"] = lift
    except (KeyError, TypeError, ZeroDivisionError, OverflowError):
        return
