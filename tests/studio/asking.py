"""Asking the engine as the page does, and reading its answers."""

import copy
import re

from studio_tasks import plain_task

from graphcam.studio.engine import answer
from graphcam.studio.task_paths import changed_task, value_at

PX_PER_MM = 1.9
"""How large the large view is shown."""


def ask(task, *views, px_per_mm=PX_PER_MM, **wanted):
    """The answer to a request of views of a task, which must be no error."""
    asked = [{"name": name, "px_per_mm": px_per_mm} for name in views]
    found = answer({"task": task, "views": asked, **wanted})
    assert found["ok"], found["error"]
    return found


def view_names(name):
    return [view["name"] for view in ask(plain_task(name))["names"]]


def moved(name, what, way):
    """A built-in task with one of its sizes a ``way`` farther on."""
    task = copy.deepcopy(plain_task(name))
    if what == "offset":
        return changed_task(task, {"follower.offset": value_at(task, "follower.offset") + way})
    if what == "prime radius":
        return changed_task(task, {"cam.prime_radius": START[name] + way})
    if what == "phase border":
        angles = [phase["angle"] for phase in task["motion"]["phases"]]
        border = {"motion.phases[0].angle": angles[0] + way, "motion.phases[-1].angle": angles[-1] - way}
        return changed_task(task, {path.replace("-1", str(len(angles) - 1)): angle for path, angle in border.items()})
    assert what == "lift"
    lifts = {
        f"motion.phases[{k}].lift": phase["lift"] + way
        for k, phase in enumerate(task["motion"]["phases"])
        if "lift" in phase
    }
    return changed_task(task, lifts)


START = {"coursework": 44.0, "arm": 61.0, "flat": 20.0, "measured": 27.0}
"""The prime radii that are adopted [mm]."""


def texts(svg):
    """Places and contents of the texts of SVG elements."""
    return re.findall(r'<text class="[^"]*"[^>]*? x="([^"]*)" y="([^"]*)"[^>]*>(.*?)</text>', svg)


def sizes_of_letters(svg):
    """The sizes of all fonts [mm]."""
    return [float(size) for size in re.findall(r'font-size="([\d.]+)"', svg)]
