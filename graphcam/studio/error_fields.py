"""To which field of the form an error belongs: errors name a quantity in words, or a place of the task file."""

import re
from collections.abc import Mapping
from typing import Any

from graphcam.errors import DesignError, GraphcamError, TaskError
from graphcam.studio.task_paths import PATH, steps_of, value_at

FIELDS: Mapping[str, str] = {
    "angle": "motion.phases",
    "lift": "motion.phases",
    "law": "motion.phases",
    "ratio": "motion.phases",
    "motion": "motion.phases",
    "phases": "motion.phases",
    "sum of the phase angles": "motion.phases",
    "sum of rises less returns": "motion.phases",
    "table": "motion.table",
    "the table's lift": "motion.table",
    "shapes of the table's columns": "motion.table",
    "number of rows": "motion.table",
    "row": "motion.table",
    "last row": "motion.table",
    "cam angle": "motion.table",
    "turn that the rows cover": "motion.table",
    "tolerance": "motion.tolerance",
    "rotation": "rotation",
    "speed_rpm": "speed_rpm",
    "follower": "follower.kind",
    "offset": "follower.offset",
    "arm": "follower.arm",
    "centre distance": "follower.distance",
    "roller radius": "follower.roller_radius",
    "roller radius by the rule": "follower.roller_rule",
    "roller rule": "follower.roller_rule",
    "prime radius": "cam.prime_radius",
    "minimum prime radius": "cam.prime_radius",
    "undercut": "cam.prime_radius",
    "permitted pressure angle on the rise": "limits.pressure_angle_rise",
    "permitted pressure angle on the return": "limits.pressure_angle_return",
    "minimum radius of curvature": "limits.min_curvature_radius",
    "curvature": "limits.min_curvature_radius",
    "mass": "spring.mass",
    "stiffness": "spring.stiffness",
    "preload": "spring.preload",
    "inertia": "spring.inertia",
    "acceleration": "spring.acceleration",
    "friction": "spring.friction",
    "load": "spring.load",
    "at.arm": "spring.at.arm",
    "at.anchor": "spring.at.anchor[0]",
    "anchor": "spring.at.anchor[0]",
    "spring": "spring",
    "width": "material.width",
    "divisions": "drawing.divisions",
    "ordinate": "drawing.ordinate",
    "maximum displacement on paper": "drawing.ordinate",
    "poles[0]": "drawing.poles[0]",
    "poles[1]": "drawing.poles[1]",
    "rounding": "drawing.rounding",
    "face margin": "follower.face_margin",
    "format": "drawing.format",
    "frame": "drawing.frame",
    "orientation": "drawing.orientation",
    "language": "drawing.language",
    "pencil": "pencil",
    "pencil line": "pencil",
    "D": "arcs.D[0]",
    "G": "arcs.G[0]",
    "A": "arcs.A[0]",
    "C1": "arcs.C1[0]",
    "C2": "arcs.C2[0]",
    "rho1": "arcs.rho1",
    "dwell": "arcs.dwell",
    "rise, dwell and return": "arcs.dwell",
    "rise": "arcs.G[0]",
    "root": "arcs.G[0]",
    "three-arc cam": "arcs.G[0]",
    "pressure angle": "arcs.G[0]",
    "angle of the arc AG": "arcs.G[0]",
    "angle of the arc GF": "arcs.G[0]",
    "angle of the arc FD": "arcs.G[0]",
}
"""The field of a quantity; where several sizes together are wrong, the one that its remedy names first."""
TABLES = "motion", "follower", "cam", "limits", "spring", "material", "tolerances", "drawing", "arcs", "title", "part"
"""The tables of a task file: what begins so is a place of it."""
OF_WHOLE = re.compile(r" \(.*\)$")
"""What a message adds to a place in words, such as "(sum of the angles)"."""


def field_of(error: GraphcamError, task: Mapping[str, Any]) -> str:
    """The path of the field beside which an error is shown; empty where it belongs to none.

    task : plain data, whose follower decides what an open least radius asks for

    >>> field_of(DesignError("prime radius", -3, "greater than 0 mm"), {})
    'cam.prime_radius'
    >>> field_of(TaskError("task", "motion.phases (sum of the angles)", 350, "360 degrees"), {})
    'motion.phases'
    >>> field_of(DesignError("colour", "red", "blue"), {})
    ''
    """
    if isinstance(error, TaskError):
        return _place(error.field)
    if not isinstance(error, DesignError):
        return ""
    field = FIELDS.get(error.quantity) or _place(error.quantity)
    if error.quantity == "minimum prime radius" and value_at(task, "cam.prime_radius") is not None:
        return "follower.distance" if value_at(task, "follower.kind") == "oscillating" else "follower.offset"
    if field == "motion.phases" and value_at(task, "motion.table") is not None:
        return "motion.table"
    return field


def _place(words: str) -> str:
    """A place of the task file, if words are one."""
    path = OF_WHOLE.sub("", words)
    if not PATH.fullmatch(path):
        return ""
    first = steps_of(path)[0]
    if first not in TABLES:
        return FIELDS.get(path, "") if first == path else ""
    return path
