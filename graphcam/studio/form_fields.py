"""A field of the form of sizes, as the page reads it: its name, its range, what was found for it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from graphcam.studio.size_ranges import SizeRange
from graphcam.studio.task_paths import value_at
from graphcam.tasks.arcs_task import ArcsTable
from graphcam.words import Caption, Tell, Words, say

Field = dict[str, Any]
MOTION, FOLLOWER, CAM = say("Motion"), say("Follower"), say("Cam")
LIMITS, SPRING, MATERIAL, DRAWING = say("Limits"), say("Spring"), say("Material"), say("Drawing")
DEGREE_SIGN = "°"
UNIT_CAPTIONS = {
    str(unit): unit
    for unit in (
        *(say("rpm"), say("kg"), say("N/mm"), say("N"), say("mm"), say("MPa")),
        *(say("kg·mm²"), say("rad/s²"), say("N·mm"), say("N·mm/rad")),
    )
}

NUMBER_FIELDS: dict[str, tuple[Caption, Caption, str]] = {
    "motion.tolerance": (MOTION, say("Tolerance of the fit"), "mm"),
    "motion.radii.base_radius": (CAM, say("Base radius"), "mm"),
    "motion.radii.flank_radius": (CAM, say("Flank radius"), "mm"),
    "motion.radii.nose_radius": (CAM, say("Nose radius"), "mm"),
    "motion.radii.lift": (CAM, say("Lift"), "mm"),
    "motion.radii.ascent": (CAM, say("Angle of ascent"), DEGREE_SIGN),
    "motion.radii.dwell": (CAM, say("Upper dwell"), DEGREE_SIGN),
    "speed_rpm": (MOTION, say("Speed"), "rpm"),
    "follower.offset": (FOLLOWER, say("Offset e"), "mm"),
    "follower.arm": (FOLLOWER, say("Arm length l"), "mm"),
    "follower.distance": (FOLLOWER, say("Centre distance c"), "mm"),
    "follower.face_offset": (FOLLOWER, say("Face offset f"), "mm"),
    "follower.roller_radius": (FOLLOWER, say("Roller radius r"), "mm"),
    "cam.prime_radius": (CAM, say("Prime radius r₀"), "mm"),
    "limits.pressure_angle_rise": (LIMITS, say("Permitted pressure angle, rise"), DEGREE_SIGN),
    "limits.pressure_angle_return": (LIMITS, say("Permitted pressure angle, return"), DEGREE_SIGN),
    "limits.min_curvature_radius": (LIMITS, say("Minimum radius of curvature of the profile"), "mm"),
    "spring.mass": (SPRING, say("Moving mass"), "kg"),
    "spring.stiffness": (SPRING, say("Stiffness c"), "N/mm"),
    "spring.preload": (SPRING, say("Preload F₀"), "N"),
    "spring.inertia": (SPRING, say("Moment of inertia J"), "kg·mm²"),
    "spring.acceleration": (SPRING, say("Angular acceleration ε"), "rad/s²"),
    "spring.friction": (SPRING, say("Friction at the cam μ"), ""),
    "spring.load": (SPRING, say("Load P"), "N"),
    "spring.at.arm": (SPRING, say("Spring from the pivot"), "mm"),
    "spring.at.anchor[0]": (SPRING, say("Anchor of the spring, x"), "mm"),
    "spring.at.anchor[1]": (SPRING, say("Anchor of the spring, y"), "mm"),
    "material.width": (MATERIAL, say("Width of the contact"), "mm"),
    "material.young_cam": (MATERIAL, say("Modulus of elasticity E₁, cam"), "MPa"),
    "material.young_follower": (MATERIAL, say("Modulus of elasticity E₂, follower"), "MPa"),
    "material.poisson_cam": (MATERIAL, say("Poisson's ratio ν₁, cam"), ""),
    "material.poisson_follower": (MATERIAL, say("Poisson's ratio ν₂, follower"), ""),
    "material.permitted_stress": (MATERIAL, say("Permitted contact stress"), "MPa"),
    "drawing.divisions": (DRAWING, say("Divisions of a phase"), ""),
    "drawing.ordinate": (DRAWING, say("Maximum ordinate of the first rise"), "mm"),
    "drawing.poles[0]": (DRAWING, say("Pole distance H₁"), "mm"),
    "drawing.poles[1]": (DRAWING, say("Pole distance H₂"), "mm"),
    "pencil": (DRAWING, say("Error of the pencil"), "mm"),
    "arcs.rho1": (CAM, say("Radius of the first arc ρ₁"), "mm"),
    "arcs.dwell": (MOTION, say("Upper dwell"), DEGREE_SIGN),
}
"""Group, name and unit of the numbers by their paths."""
POINT_NAMES = {
    "D": say("Point D, end of the rise"),
    "G": say("Point G, where the second and third arcs meet"),
    "A": say("Point A, start of the rise"),
    "C1": say("Centre C₁ of the first arc"),
    "C2": say("Centre C₂ of the second arc"),
}
AXIS_NAMES = ("x", "y")


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
        group, name, unit = NUMBER_FIELDS[path]
        return {
            "path": path,
            "group": self.tell(group),
            "name": self.tell(name),
            "unit": self.unit(unit),
            "kind": "number",
            "value": value_at(self.said, path),
            **self.span(path),
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
        field: Field = {
            "path": f"{path}[{k}]",
            "group": self.tell(CAM),
            "name": self.tell(called),
            "unit": self.unit("mm"),
            "kind": "number",
            "value": value_at(self.said, f"{path}[{k}]"),
            **self.span(f"{path}[{k}]"),
        }
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
        return self.tell(UNIT_CAPTIONS.get(unit, unit))

    def span(self, path: str) -> dict[str, float]:
        """The range of a number."""
        return self.ranges[path].plain()
