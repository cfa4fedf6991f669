"""A field of the form of sizes, as the page reads it: its name, its range, what was found for it."""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from graphcam.drafting.scale import printed_unit
from graphcam.studio.size_ranges import SizeRange
from graphcam.studio.task_paths import value_at
from graphcam.tasks.arcs_task import ArcsTable, ArcsTask
from graphcam.tasks.declared_numbers import DeclaredNumber, Ruled, declared, numbers_of
from graphcam.tasks.spring_tables import ArmSpringTable
from graphcam.tasks.task import Task
from graphcam.tasks.units import HeldIn
from graphcam.words import Caption, Tell, Words, say, say_in

Field = dict[str, Any]
MOTION, FOLLOWER, CAM = say("Motion"), say("Follower"), say("Cam")
LIMITS, SPRING, MATERIAL, DRAWING = say("Limits"), say("Spring"), say("Material"), say("Drawing")
DEGREE_SIGN = "°"
GROUPS = {
    "motion.radii": CAM,
    "follower": FOLLOWER,
    "cam": CAM,
    "arcs": CAM,
    "arcs.dwell": MOTION,
    "limits": LIMITS,
    "spring": SPRING,
    "material": MATERIAL,
    "drawing": DRAWING,
    "pencil": DRAWING,
}
"""The groups of the form by the table whose numbers stand in them, or by the number; all others are of the motion."""
PENCIL = DeclaredNumber(say("Error of the pencil"), Ruled(), HeldIn("mm"), is_open=False)
"""The number of the form that a request gives beside the task."""
POINT_NAMES = {
    "D": say("Point D, end of the rise"),
    "G": say("Point G, where the second and third arcs meet"),
    "A": say("Point A, start of the rise"),
    "C1": say("Centre C₁ of the first arc"),
    "C2": say("Centre C₂ of the second arc"),
}
ALWAYS_GIVEN = "motion.tolerance", "motion.radii", "limits.pressure_angle_rise"
"""Numbers that a file may leave out, but a task has."""


PHASE_NAMES = {
    "angle": say_in("a phase", "Angle"),
    "lift": say_in("a phase", "Lift"),
    "law": say_in("a phase", "Law"),
    "ratio": say_in("a phase", "Ratio of the accelerations"),
}
"""The names of the fields of a phase, by their keys."""


def form_names() -> dict[str, Caption]:
    """The names of the numbers that a form may have, by their paths, of every phase by one without its number.

    >>> str(form_names()["spring.damping"]), str(form_names()["motion.phases.lift"])
    ('Damping d', 'Lift')
    """
    numbers = {**declared(ArcsTask), **declared(Task), "pencil": PENCIL}
    of_phases = {f"motion.phases.{key}": name for key, name in PHASE_NAMES.items()}
    return of_phases | {path: number.name for path, number in numbers.items() if number.name}


def group_of(path: str) -> Caption:
    """The group of a number.

    >>> str(group_of("spring.at.anchor[0]")), str(group_of("motion.radii.lift"))
    ('Spring', 'Cam')
    """
    of = (path, path.rpartition(".")[0], path.partition(".")[0])
    return next((GROUPS[part] for part in of if part in GROUPS), MOTION)


def unit_of(task: Task | ArcsTask, path: str, number: DeclaredNumber) -> str:
    """The unit of a number as it is printed, in English; empty if it has none.

    >>> import graphcam as gc
    >>> task = gc.builtin_task("arm")
    >>> unit_of(task, "motion.tolerance", declared(Task)["motion.tolerance"])
    '°'
    """
    if number.held is None:
        return ""
    own = number.held.own
    if number.held.of_turning and isinstance(task, Task):
        spring = task.spring if path.startswith("spring") else None
        turning = spring.at is None if isinstance(spring, ArmSpringTable) else task.follower.column == "s_deg"
        own = number.held.of_turning if turning else own
    return DEGREE_SIGN if own == "deg" else str(printed_unit(own))


def lift_unit(column: str) -> str:
    """The unit of a lift, by the column of a table that has it: "s_mm" or "s_deg"."""
    return DEGREE_SIGN if column == "s_deg" else "mm"


def coordinate_name(point: str, k: int) -> Caption:
    """The name of a coordinate of a point of the arcs."""
    return say("{point}, {axis}", point=POINT_NAMES[point], axis="xy"[k])


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

    task : whose tables declare the numbers
    said : the task as plain data, with what was asked for and with its defaults
    ranges : of the numbers, by their paths
    adopted : what was found for numbers that are left open, by their paths
    tell : says captions in the language of the page
    """

    task: Task | ArcsTask
    said: Mapping[str, Any]
    ranges: Mapping[str, SizeRange]
    adopted: Mapping[str, float | None]
    tell: Tell

    def numbers(self, table: str) -> Iterator[Field]:
        """The numbers of a table that stand in the form."""
        for path, number in self._declared.items():
            if number.name and path in self.ranges and path.startswith(table):
                yield self.number(path)

    @cached_property
    def _declared(self) -> Mapping[str, DeclaredNumber]:
        return {**numbers_of(self.task), "pencil": PENCIL}

    def number(self, path: str, name: Caption | None = None) -> Field:
        """A number, with what was adopted for it if it may be left open; its name, if not that of its declaration.

        Of a list that is left open as a whole, ``first`` is put there before one of its numbers is.
        """
        number, value = self._declared[path], value_at(self.said, path)
        called, unit = name or number.name, unit_of(self.task, path, number)
        assert called
        field = self.field(path, "number", called, value, unit, **self.ranges[path].plain())
        whole, bracket, _ = path.partition("[")
        if not number.is_open or path.startswith(ALWAYS_GIVEN) or (bracket and path not in self.adopted):
            return field
        field |= {"kind": "open-number", "adopted": self.adopted.get(path)}
        if not bracket:
            return field
        field["open"] = whole
        first = [value for each, value in self.adopted.items() if each.startswith(f"{whole}[")]
        return field if value is not None else field | {"first": {whole: first}}

    def field(self, path: str, kind: str, name: Caption, value: Any, unit: str = "", **more: Any) -> Field:
        """What every field says, and more."""
        named = {"path": path, "group": self.tell(group_of(path)), "name": self.tell(name), "unit": self.unit(unit)}
        return {**named, "kind": kind, "value": value, **more}

    def choice(self, path: str, name: Caption, choices: Iterable[tuple[Any, Words]]) -> Field:
        """A field for one of several; what stands in the task is among them."""
        value = value_at(self.said, path)
        offered = [{"value": each, "name": self.tell(title)} for each, title in choices]
        if value is not None and all(each["value"] != value for each in offered):
            offered.append({"value": value, "name": str(value)})
        return self.field(path, "choice", name, value, choices=offered)

    def unit(self, unit: str) -> str:
        """A unit in the language of the page."""
        return self.tell(printed_unit(unit))
