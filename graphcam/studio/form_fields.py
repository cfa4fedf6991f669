"""A field of the form of sizes, as the page reads it: its name, its range, what was found for it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

from graphcam.drafting.scale import printed_unit
from graphcam.studio.size_ranges import SizeRange
from graphcam.studio.task_paths import steps_of, value_at
from graphcam.tasks.arcs_task import ArcsTable, ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.units import mark_at
from graphcam.words import Caption, Tell, Words, say

Field = dict[str, Any]
MOTION, FOLLOWER, CAM = say("Motion"), say("Follower"), say("Cam")
LIMITS, SPRING, MATERIAL, DRAWING = say("Limits"), say("Spring"), say("Material"), say("Drawing")
DEGREE_SIGN = "°"
NUMBER_FIELDS: dict[str, tuple[Caption, Caption]] = {
    "motion.tolerance": (MOTION, say("Tolerance of the fit")),
    "motion.radii.base_radius": (CAM, say("Base radius")),
    "motion.radii.flank_radius": (CAM, say("Flank radius")),
    "motion.radii.nose_radius": (CAM, say("Nose radius")),
    "motion.radii.lift": (CAM, say("Lift")),
    "motion.radii.ascent": (CAM, say("Angle of ascent")),
    "motion.radii.dwell": (CAM, say("Upper dwell")),
    "speed_rpm": (MOTION, say("Speed")),
    "follower.offset": (FOLLOWER, say("Offset e")),
    "follower.arm": (FOLLOWER, say("Arm length l")),
    "follower.distance": (FOLLOWER, say("Centre distance c")),
    "follower.face_offset": (FOLLOWER, say("Face offset f")),
    "follower.roller_radius": (FOLLOWER, say("Roller radius r")),
    "cam.prime_radius": (CAM, say("Prime radius r₀")),
    "limits.pressure_angle_rise": (LIMITS, say("Permitted pressure angle, rise")),
    "limits.pressure_angle_return": (LIMITS, say("Permitted pressure angle, return")),
    "limits.min_curvature_radius": (LIMITS, say("Minimum radius of curvature of the profile")),
    "spring.mass": (SPRING, say("Moving mass")),
    "spring.stiffness": (SPRING, say("Stiffness c")),
    "spring.preload": (SPRING, say("Preload F₀")),
    "spring.inertia": (SPRING, say("Moment of inertia J")),
    "spring.acceleration": (SPRING, say("Angular acceleration ε")),
    "spring.friction": (SPRING, say("Friction at the cam μ")),
    "spring.load": (SPRING, say("Load P")),
    "spring.damping": (SPRING, say("Damping d")),
    "spring.at.arm": (SPRING, say("Spring from the pivot")),
    "spring.at.anchor[0]": (SPRING, say("Anchor of the spring, x")),
    "spring.at.anchor[1]": (SPRING, say("Anchor of the spring, y")),
    "material.width": (MATERIAL, say("Width of the contact")),
    "material.young_cam": (MATERIAL, say("Modulus of elasticity E₁, cam")),
    "material.young_follower": (MATERIAL, say("Modulus of elasticity E₂, follower")),
    "material.poisson_cam": (MATERIAL, say("Poisson's ratio ν₁, cam")),
    "material.poisson_follower": (MATERIAL, say("Poisson's ratio ν₂, follower")),
    "material.permitted_stress": (MATERIAL, say("Permitted contact stress")),
    "drawing.divisions": (DRAWING, say("Divisions of a phase")),
    "drawing.ordinate": (DRAWING, say("Maximum ordinate of the first rise")),
    "drawing.poles[0]": (DRAWING, say("Pole distance H₁")),
    "drawing.poles[1]": (DRAWING, say("Pole distance H₂")),
    "pencil": (DRAWING, say("Error of the pencil")),
    "arcs.rho1": (CAM, say("Radius of the first arc ρ₁")),
    "arcs.dwell": (MOTION, say("Upper dwell")),
}
"""Group and name of the numbers by their paths."""
POINT_NAMES = {
    "D": say("Point D, end of the rise"),
    "G": say("Point G, where the second and third arcs meet"),
    "A": say("Point A, start of the rise"),
    "C1": say("Centre C₁ of the first arc"),
    "C2": say("Centre C₂ of the second arc"),
}
AXIS_NAMES = ("x", "y")


@cache
def unit_at(path: str) -> str:
    """The unit of the number at a path of a task; empty if it has none.

    >>> unit_at("limits.pressure_angle_rise"), unit_at("spring.at.anchor[0]"), unit_at("material.poisson_cam")
    ('°', 'mm', '')
    """
    steps = steps_of(path)
    if path == "pencil":
        return "mm"
    mark = mark_at(Task, steps) or mark_at(ArcsTask, steps)
    return "" if mark is None else DEGREE_SIGN if mark.own == "deg" else str(printed_unit(mark.own))


def must_agree(arcs: ArcsTable, name: str) -> list[str]:
    """The paths of what has to agree with a size of the arcs, and is left open where that is moved.

    >>> must_agree(ArcsTable(D=(51.68, 18.81), G=(22.24, 37.84), rho1=17, A=(0, 40), C2=(0, -75.64)), "A")
    ['arcs.C2']
    """
    # C1 lies on the line to D, rho1 from there; C2 on the line to A, as far from A as from G.
    with_it = {"D": "C1", "rho1": "C1", "A": "C2", "C2": "A"}
    if arcs.A is not None:
        with_it["G"] = "C2"
    return [f"arcs.{with_it[name]}"] if name in with_it else []


@dataclass(frozen=True)
class FieldMaker:
    """Makes the fields of a task.

    said : the task as plain data, with what was asked for and with its defaults
    ranges : of the numbers, by their paths
    tell : says captions in the language of the page
    """

    said: Mapping[str, Any]
    ranges: Mapping[str, SizeRange]
    tell: Tell

    def number(self, path: str) -> Field:
        """A number that always stands in the task."""
        return self._number(path, *NUMBER_FIELDS[path])

    def _number(self, path: str, group: Caption, name: Caption) -> Field:
        return {
            "path": path,
            "group": self.tell(group),
            "name": self.tell(name),
            "unit": self.unit(unit_at(path)),
            "kind": "number",
            "value": value_at(self.said, path),
            **self.ranges[path].plain(),
        }

    def open_number(self, path: str, adopted: float | None) -> Field:
        """A number that may be left open, and what was adopted for it then."""
        return {**self.number(path), "kind": "open-number", "adopted": adopted}

    def entry(self, path: str, adopted: tuple[float, ...], k: int) -> Field:
        """A number of a list that is left open as a whole: ``first`` is put there before one of its numbers is."""
        field = self.open_number(f"{path}[{k}]", adopted[k]) | {"open": path}
        return field if field["value"] is not None else field | {"first": {path: list(adopted)}}

    def coordinate(self, arcs: ArcsTable, name: str, k: int, adopted: tuple[float, ...] | None) -> Field:
        """A coordinate of a point of the arcs, with what was found if the point may be left out."""
        path = f"arcs.{name}"
        called = say("{point}, {axis}", point=POINT_NAMES[name], axis=AXIS_NAMES[k])
        field = self._number(f"{path}[{k}]", CAM, called)
        freed = dict.fromkeys(must_agree(arcs, name))
        if adopted is None:
            return field | {"first": freed}
        field |= {"kind": "open-number", "adopted": adopted[k], "open": path}
        first = {} if field["value"] is not None else {path: list(adopted)}
        return field | {"first": {**freed, **first}}

    def choice(self, path: str, group: Caption, name: Caption, choices: Iterable[tuple[Any, Words]]) -> Field:
        """A field for one of several; what stands in the task is among them."""
        value = value_at(self.said, path)
        offered = [{"value": each, "name": self.tell(title)} for each, title in choices]
        if value is not None and all(each["value"] != value for each in offered):
            offered.append({"value": value, "name": str(value)})
        return {
            "path": path,
            "group": self.tell(group),
            "name": self.tell(name),
            "unit": "",
            "kind": "choice",
            "value": value,
            "choices": offered,
        }

    def unit(self, unit: str) -> str:
        """A unit in the language of the page."""
        return self.tell(printed_unit(unit))
