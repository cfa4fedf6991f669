"""Another task of the same kind by a number: the next variant of a question, the same on every machine."""

import hashlib
from collections.abc import Mapping, Sequence
from typing import Any

from graphcam.tasks.task_file import builtin_task

BASES = {"translating": "coursework", "oscillating": "arm", "flat-faced": "flat"}
"""The built-in task of each kind of follower."""
LAWS = ("cosine", "cycloidal", "3-4-5", "modified-sine", "rectangular")
SMOOTH = ("cycloidal", "3-4-5", "modified-sine")
"""Laws whose acceleration does not jump: under a flat face a jump hides where the profile is sharpest."""
SIZES: Mapping[str, Mapping[str, Sequence[float | str]]] = {
    "translating": {"offset": range(-16, 17, 2), "limit": range(25, 38), "lift": range(20, 46, 5), "laws": LAWS},
    "oscillating": {"limit": range(38, 48), "lift": range(12, 19), "laws": LAWS},
    "flat-faced": {"curvature": range(5, 13), "lift": range(20, 36, 5), "laws": SMOOTH},
}
"""Ranges in which one would draw the cam oneself."""
RISES, DWELLS, RETURNS = range(80, 131, 5), range(20, 61, 5), range(70, 121, 5)
"""Cam angles of the first three phases [degrees]; the last dwell is what is left of the turn."""


class Draws:
    """Whole numbers out of a seed, one after another.

    >>> Draws("a").one_of(range(10)) == Draws("a").one_of(range(10))
    True
    """

    def __init__(self, seed: str) -> None:
        self._left = int.from_bytes(hashlib.sha512(seed.encode()).digest())

    def one_of(self, values: Sequence[Any]) -> Any:
        """A randomly drawn value of several."""
        self._left, place = divmod(self._left, len(values))
        return values[place]


def seeded_task(kind: str, seed: int) -> dict[str, Any]:
    """The tables of another task with a follower of a kind; its prime radius and roller are left open.

    >>> seeded_task("translating", 7) == seeded_task("translating", 7) != seeded_task("translating", 8)
    True
    """
    draws, sizes = Draws(f"{kind} {seed}"), SIZES[kind]
    task = builtin_task(BASES[kind]).to_dict()
    lift, law, back = draws.one_of(sizes["lift"]), draws.one_of(sizes["laws"]), draws.one_of(sizes["laws"])
    rise, dwell, fall = (float(draws.one_of(angles)) for angles in (RISES, DWELLS, RETURNS))
    rest = 360.0 - rise - dwell - fall
    task["rotation"] = draws.one_of(("ccw", "cw"))
    task["motion"] = {
        "phases": [
            {"kind": "rise", "angle": rise, "lift": float(lift), "law": law},
            {"kind": "dwell", "angle": dwell},
            {"kind": "return", "angle": fall, "lift": float(lift), "law": back},
            {"kind": "dwell", "angle": rest},
        ]
    }
    # Poles and ordinate of the built-in task suit its own angles only.
    task["drawing"] = {key: value for key, value in task["drawing"].items() if key not in ("ordinate", "poles")}
    task["cam"] = {}
    if kind == "translating":
        task["follower"]["offset"] = float(draws.one_of(sizes["offset"]))
    if kind == "flat-faced":
        task["limits"] = {"min_curvature_radius": float(draws.one_of(sizes["curvature"]))}
    else:
        task["limits"] = {"pressure_angle_rise": float(draws.one_of(sizes["limit"]))}
    return task
