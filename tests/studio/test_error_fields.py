"""Every error that a task of the studio can meet has a field of the form to stand beside."""

import ast
import functools
import re
from pathlib import Path

import pytest
from studio_tasks import BUILT_IN, plain_task, rebuilt, solved

import graphcam as gc
from graphcam.studio.engine import FIELDS_BY_QUANTITY, field_of
from graphcam.studio.sizes_form import form_of
from graphcam.studio.task_paths import changed_task
from graphcam.tasks.declared_numbers import declared
from graphcam.tasks.task import Task

PACKAGE = Path(gc.__file__).parent
ROOMS = "comparison", "constructions", "drafting", "mechanism", "solving"
"""What a task that was read goes through as it is drawn and computed; what is refused when it is read has its place."""
CHECKS = (
    "DesignError",
    "RowError",
    "check_positive",
    "bounded",
    "check_choice",
    "_check_length",
    "check_number",
    "check_kind",
)
"""What raises, and which argument names the quantity."""
NOT_REACHED = {
    "exact counterpart": "a construction of the package itself names its counterpart",
    "reading of *": "a construction of the package itself names its readings",
    "stations of the displacement": "the package divides the turn of a measured motion itself",
    "side": "named by the package itself",
    "number of points": "only an export asks for a number of points",
    **dict.fromkeys(("pencil samples", "pencil seed"), "one hand draws in the studio"),
    "overhang": "a guide stands in Python only",
    "at": "second cams stand in Python only",
    **dict.fromkeys(("force", "pair of radii", "contact force"), "Hertzian stress is worked out in Python only"),
    "the construction": "only Python asks for a construction by its name",
    "errors": "making errors stand in Python only; a task has [tolerances]",
    "prime_radius and base_radius": "ranges stand in files and in Python: the form keeps them",
    **dict.fromkeys(("minimum contact force", "range of the *"), "sizing stands in Python and in exercises only"),
    "sizes": "deviations stand in Python only",
    **dict.fromkeys(
        ("guide", "forces", "contact", "deviations", "task"), "kinds of arguments are checked in Python only"
    ),
    "n": "elastic followers stand in Python only",
    **dict.fromkeys(("deviation", "profile", "control_points"), "only an export asks for a spline"),
    **dict.fromkeys(("samples", "tolerances.*"), "tolerances stand in files and in Python: the form keeps them"),
}
"""Quantities that no request of the studio meets, and why."""
PARAMETERS = {
    "pencil *": ("pencil line",),
    "drawing.poles[*]": ("drawing.poles[0]", "drawing.poles[1]"),
    "angle of the arc *": tuple(f"angle of the arc {arc}" for arc in ("AG", "GF", "FD")),
}
"""What stands in the places of a text."""


def literal(node):
    """A text or the template of a caption, its places as stars; None for what is no text."""
    if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "say":
        return re.sub(r"{[^{}]*}", "*", node.args[0].value)
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(part.value if isinstance(part, ast.Constant) else "*" for part in node.values)
    return None


def texts_of(node, scope):
    """The texts that a node may be: its own, or those that the scope gives to its name."""
    given = [each.value for each in ast.walk(scope) if isinstance(each, ast.Assign) and named(each.targets[0], node)]
    return {literal(each) for each in (node, *given)} - {None}


def named(target, node):
    return isinstance(target, ast.Name) and isinstance(node, ast.Name) and target.id == node.id


def scopes_of(file):
    """The functions of a file with all their nodes, and the file with its own."""
    module = ast.parse(file.read_text(encoding="utf-8"))
    functions = [node for node in ast.walk(module) if isinstance(node, ast.FunctionDef)]
    inside = {id(node) for function in functions for node in ast.walk(function)}
    outside = [node for node in ast.walk(module) if id(node) not in inside]
    return [*((function, list(ast.walk(function))) for function in functions), (ast.Module([], []), outside)]


@functools.cache
def quantities():
    """The texts by which errors of the rooms name a quantity, with where each is raised."""
    found = {}
    for room in ROOMS:
        for file in sorted((PACKAGE / room).rglob("*.py")):
            for scope, nodes in scopes_of(file):
                for node in nodes:
                    name = getattr(getattr(node, "func", None), "id", "")
                    if name in CHECKS and node.args:
                        for text in texts_of(node.args[1 if name == "RowError" else 0], scope):
                            found.setdefault(text, []).append(f"{room}/{file.name}:{node.lineno}")
    return found


@functools.cache
def of_variables():
    """Where an error is raised for a quantity that a variable names, the texts of the function around it."""
    found = set()
    for room in ROOMS:
        for file in sorted((PACKAGE / room).rglob("*.py")):
            for function in ast.walk(ast.parse(file.read_text())):
                if isinstance(function, ast.FunctionDef) and raises_of_variables(function):
                    found |= {literal(node) for node in ast.walk(function)} - {None}
    return found


def raises_of_variables(function):
    called = "DesignError", "check_number"
    calls = [node for node in ast.walk(function) if getattr(getattr(node, "func", None), "id", "") in called]
    return any(isinstance(call.args[0], ast.Name) for call in calls)


@pytest.mark.slow
def test_every_quantity_has_a_field_or_a_reason():
    unknown = {}
    for text, places in quantities().items():
        if text in NOT_REACHED:
            continue
        for quantity in PARAMETERS.get(text, (text,)):
            if not field_of(gc.DesignError(quantity, 0, "another"), {}):
                unknown[quantity] = places
    # The part is no matter of the studio's form; its errors name their place.
    assert not {name: places for name, places in unknown.items() if not all("part_table" in each for each in places)}


@pytest.mark.slow
def test_no_reason_is_out_of_date():
    assert set(NOT_REACHED) <= set(quantities()) | of_variables()
    assert set(PARAMETERS) <= set(quantities())


def test_quantities_are_collected():
    """The search sees plain texts, texts with places, and those that a check is given."""
    assert {"minimum prime radius", "offset", "drawing.poles[*]", "centre distance", "drawing.ordinate"} <= set(
        quantities()
    )


def test_fields_are_in_the_form():
    """What is shown beside a field must find it."""
    shown = {field["path"] for name in BUILT_IN for field in form_of(solved(name), str)}
    assert set(FIELDS_BY_QUANTITY.values()) <= shown
    sprung = changed_task(
        plain_task("coursework"), {"spring": {"mass": 0.5, "stiffness": 2.0}, "material": {"width": 15.0}}
    )
    at = {"arm": 60.0, "anchor": [120.0, -60.0]}
    arm = changed_task(
        plain_task("arm"),
        {"speed_rpm": 200.0, "spring": {"inertia": 900.0, "stiffness": 2.0, "friction": 0.1, "at": at}},
    )
    there = {field["path"] for task in (sprung, arm) for field in form_of(gc.solve(rebuilt(task)), str)}
    numbers = {path for path, number in declared(Task).items() if number.name}
    assert {path for path in numbers if path.startswith(("spring", "material"))} <= there


@pytest.mark.parametrize(
    ("at", "units"), [(None, ["N·mm/rad", "N·mm"]), ({"arm": 60.0, "anchor": [120.0, -60.0]}, ["N/mm", "N"])]
)
def test_the_units_of_an_arm_s_spring_are_those_of_its_kind(at, units):
    spring = {"inertia": 900.0, "stiffness": 2.0, **({"at": at} if at else {})}
    task = changed_task(plain_task("arm"), {"speed_rpm": 200.0, "spring": spring})
    shown = {field["path"]: field for field in form_of(gc.solve(rebuilt(task)), str)}
    assert [shown[f"spring.{name}"]["unit"] for name in ("stiffness", "preload")] == units


SPRING = {"mass": 0.5, "stiffness": 2.0}
LIFTS = "motion.phases[0].lift", "motion.phases[2].lift"
WRONG = [
    ("coursework", {"follower.offset": "left"}, "follower.offset"),
    ("coursework", {"cam.prime_radius": -3}, "cam.prime_radius"),
    ("coursework", {"cam.prime_radius": 10.0, "follower.offset": 12.0}, "follower.offset"),
    ("coursework", {"motion.phases[0].angle": 81}, "motion.phases"),
    ("coursework", {"motion.phases[0].lift": 31}, "motion.phases"),
    ("coursework", {"motion.phases[1].angle": -5}, "motion.phases[1].angle"),
    ("coursework", {"motion.phases[0].law": "quartic"}, "motion.phases[0].law"),
    ("coursework", {"limits.pressure_angle_rise": 95.0}, "limits.pressure_angle_rise"),
    ("coursework", {"limits.min_curvature_radius": -5.0}, "limits.min_curvature_radius"),
    ("coursework", {"follower.roller_rule": "rho / 2"}, "follower.roller_rule"),
    ("coursework", {"follower.roller_rule": "rho - 5000"}, "follower.roller_rule"),
    ("coursework", {"drawing.divisions": 0}, "drawing.divisions"),
    ("coursework", {"drawing.poles": [40.0, -1.0]}, "drawing.poles[1]"),
    ("coursework", {"drawing.language": "xx"}, "drawing.language"),
    ("coursework", {"rotation": "left"}, "rotation"),
    ("coursework", {"spring": {"mass": 1.0, "stiffness": -2.0}}, "spring.stiffness"),
    ("coursework", {"material": {"width": 15.0}}, "spring"),
    ("coursework", {"spring": SPRING, "material": {"width": -15.0}}, "material.width"),
    ("coursework", {"spring": SPRING, "material": {"width": 15.0, "poisson_cam": 0.7}}, "material.poisson_cam"),
    ("coursework", {"spring": SPRING, "material": {"width": 15.0, "young_follower": 0.0}}, "material.young_follower"),
    ("coursework", {"spring": {"mass": 1.0, "stiffness": 2.0, "friction": -1.0}}, "spring.friction"),
    ("coursework", {"spring": {"mass": 1.0, "stiffness": 2.0, "friction": 1.9}}, "spring.friction"),
    ("coursework", {"spring": {"mass": 1.0, "stiffness": 2.0, "load": [[0, 1], [270, 1]]}}, "spring.load"),
    ("coursework", {"spring": {"inertia": 1.0, "stiffness": 2.0}}, "spring.inertia"),
    ("arm", {"speed_rpm": 90.0, "spring": {"inertia": -1.0, "stiffness": 2.0}}, "spring.inertia"),
    ("arm", {"speed_rpm": 90.0, "spring": {"mass": 1.0, "stiffness": 2.0}}, "spring.mass"),
    (
        "arm",
        {"speed_rpm": 90.0, "spring": {"inertia": 1.0, "stiffness": 2.0, "at": {"arm": 9.0, "anchor": [81.4, 41.1]}}},
        "spring.at.anchor[0]",
    ),
    ("coursework", {"follower.kind": "magnetic"}, "follower.kind"),
    (
        "coursework",
        {"follower.offset": None, "limits.pressure_angle_return": 0.5, "limits.pressure_angle_rise": 0.4},
        "limits.pressure_angle_rise",
    ),
    ("arm", {**dict.fromkeys(LIFTS, 95.0), "follower.distance": None}, "motion.phases"),
    ("arm", {**dict.fromkeys(LIFTS, 95.0), "follower.distance": None, "cam.prime_radius": None}, "motion.phases"),
    ("arm", {"cam.prime_radius": 20.0, "follower.roller_radius": 1.0}, "cam.prime_radius"),
    ("arm", {"follower.arm": 0.0}, "follower.arm"),
    ("arm", {"follower.roller_radius": 70.0}, "follower.roller_radius"),
    ("arm", dict.fromkeys(LIFTS, 170.0), "motion.phases"),
    ("measured", {"motion.tolerance": -1.0}, "motion.tolerance"),
    ("measured", {"motion.tolerance": 1e-9}, "motion.tolerance"),
    ("arcs", {"arcs.rho1": -1.0}, "arcs.rho1"),
    ("arcs", {"arcs.D": [60.0, 18.0]}, "arcs.D[0]"),
    ("arcs", {"arcs.G": [50.0, 37.0], "arcs.C2": None}, "arcs.G[0]"),
    ("arcs", {"arcs.dwell": 350.0}, "arcs.dwell"),
]


@pytest.mark.parametrize(("name", "changes", "field"), WRONG)
def test_a_wrong_size_is_told_beside_its_field(name, changes, field):
    task = changed_task(plain_task(name), changes)
    with pytest.raises(gc.GraphcamError) as caught:
        gc.solve(rebuilt(task))
    assert field_of(caught.value, task) == field, str(caught.value)
