"""The form of a task's sizes: what can be typed, moved, added or chosen, in order, in the words of the field."""

import math
from collections.abc import Iterator, Mapping
from typing import Any, get_args

from graphcam.given.follower import MM_PER_M, FlatFaced, Oscillating, OscillatingFlat, Translating
from graphcam.given.roller_rule import DEFAULT_RULE, NAMED_RULES
from graphcam.language import languages
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.studio.form_fields import POINT_NAMES, Field, FieldMaker, coordinate_name, lift_unit, must_agree
from graphcam.studio.phase_fields import phases_field
from graphcam.studio.size_ranges import (
    SizeRange,
    adopted,
    has_angles,
    lift_of,
    lift_size,
    ranges,
    round_up,
    sizes_of,
)
from graphcam.tasks.sheet_tables import Format, Frame, plain_data
from graphcam.tasks.spring_tables import ArmSpringTable, SpringTable
from graphcam.tasks.task import table_of
from graphcam.words import Caption, Tell, Words, say, say_in

PENCIL_RANGE = {"pencil": SizeRange(0.0, 0.5, 0.05)}
"""Standard deviation of a line [mm], which a request gives beside the task; 0.2 is a careful student's."""
SENSE_NAMES = {"cw": say("clockwise"), "ccw": say("anticlockwise")}
LIFT_NAMES = {"angle": say("angle of the arm, degrees"), "arc": say("arc of its end, mm")}
JERK_CHOICES = {False: say("not drawn"), True: say("drawn by differentiation")}
"""Whether the diagram of the jerk is drawn."""
DWELL_LIMIT_CHOICES = {True: say("within the limit"), False: say("not limited")}
LANGUAGE_NAMES = {"en": "English", "ru": "русский", "vi": "tiếng Việt", "zh": "简体中文"}
"""Each in itself; another one by its sign."""
FRAME_NAMES = {"gost": say("frame by GOST"), "iso": say("frame by ISO")}


def form_of(solution: AnySolution, tell: Tell) -> list[Field]:
    """The fields of a task, in the order shown.

    solution : says what the task leaves open, and what was found for that
    tell : says captions in the language of the page

    >>> import graphcam as gc
    >>> fields = form_of(gc.solve(gc.builtin_task()), str)
    >>> [(field["path"], field["value"], field["adopted"]) for field in fields if "adopted" in field][1:4]
    [('follower.offset', -10.0, -10.0), ('follower.roller_radius', None, 17.0), ('cam.prime_radius', None, 44.0)]
    """
    # What the task leaves out has its default.
    said = solution.task.to_dict() | {"pencil": solution.chain.pencil.line}
    make = FieldMaker(solution.task, said, ranges(solution) | PENCIL_RANGE, adopted(solution), tell)
    if isinstance(solution, ArcsSolution):
        return [*_arcs(make, solution), *_sheet(make)]
    return [*_motion(make, solution), *_follower(make, solution), *_limits(make, solution), *_sheet(make)]


def _arcs(make: FieldMaker, solution: ArcsSolution) -> Iterator[Field]:
    """The points and radii of a cam of three arcs."""
    for name in ("D", "G", "rho1", "A", "C2"):
        coordinates = [(f"arcs.{name}[{k}]", coordinate_name(name, k)) for k in (0, 1)] if name in POINT_NAMES else []
        for path, called in coordinates or [(f"arcs.{name}", None)]:
            field = make.number(path, called)
            freed = dict.fromkeys(must_agree(solution.task.arcs, name))
            yield field | {"first": freed | field.get("first", {})}
    yield make.number("arcs.dwell")
    yield make.number("follower.roller_radius")
    yield make.number("speed_rpm")
    yield make.number("drawing.divisions")


def _motion(make: FieldMaker, solution: Solution) -> Iterator[Field]:
    yield from make.numbers("motion.tolerance")
    if solution.task.motion.phases is not None:
        yield phases_field(make, solution)
    if lift := lift_size(solution.task):
        named = make.field(lift.path, "number", say("Lift h"), lift.value, lift_unit(solution.task.follower.column))
        yield {**named, **lift.range.plain(), "with": lift.shares}
    yield from make.numbers("motion.radii")
    yield make.choice("rotation", say("Rotation of the cam"), SENSE_NAMES.items())
    yield make.number("speed_rpm")


def _follower(make: FieldMaker, solution: Solution) -> Iterator[Field]:
    """The fields of the follower, its sizes, and the prime radius."""
    sizes = sizes_of(solution.task)
    choices = kind_choices(solution, make.tell)
    yield make.field("follower.kind", "choice", say("Kind of follower"), sizes["kind"], choices=choices)
    yield from make.numbers("follower")
    if "lift" in sizes:
        yield make.choice("follower.lift", say("Lifts of the phases"), LIFT_NAMES.items())
    if "roller_rule" in sizes:
        rules: list[tuple[str, Words]] = [(DEFAULT_RULE, _in_letters(DEFAULT_RULE))]
        rules += [(name, f"{_in_letters(each.rule)} ({name})") for name, each in NAMED_RULES.items()]
        yield make.choice("follower.roller_rule", say("Rule for the roller"), rules)
    if not solution.task.motion.gives_cam:
        yield from make.numbers("cam")


def _in_letters(rule: str) -> str:
    """A rule of the roller as a textbook writes it."""
    return rule.replace("rho", "ρ").replace("r0", "r₀")


def _limits(make: FieldMaker, solution: Solution) -> Iterator[Field]:
    """What the cam must keep to, the spring and the material if there are such, the draughtsman's choices."""
    yield from make.numbers("limits")
    if has_angles(solution.task):
        yield make.choice("limits.rest", say("Angle in the lower dwell"), DWELL_LIMIT_CHOICES.items())
    yield _added(make, "spring", say("Forces and spring"), _added_spring(solution))
    yield from make.numbers("spring")
    if solution.task.spring is not None:
        yield _added(make, "material", say("Contact stress"), {"material": {"width": USUAL_WIDTH}})
    yield from make.numbers("material")
    yield from make.numbers("drawing")
    yield make.choice("drawing.jerk", say("Jerk"), JERK_CHOICES.items())


def _added(make: FieldMaker, path: str, name: Caption, added: dict[str, Any]) -> Field:
    """A choice whether the task has a table; ``added`` is what changes with it."""
    chosen = make.said.get(path) is not None
    gone = dict.fromkeys(("spring", "material") if path == "spring" else (path,))
    choices = [
        {"value": value, "name": make.tell(title), "changes": {} if value == chosen else changes}
        for value, title, changes in ((False, say("not calculated"), gone), (True, say("calculated"), added))
    ]
    return make.field(path, "choice", name, chosen, choices=choices)


def _added_spring(solution: Solution) -> dict[str, Any]:
    """The usual spring and mass of a follower whose preload is found, and a speed if the task has none."""
    follower, straight = plain_data(solution.task.follower), {"mass": USUAL_MASS, "stiffness": USUAL_STIFFNESS}
    speed = {"speed_rpm": USUAL_SPEED} if solution.task.speed_rpm is None else {}
    if not table_of(follower).swings:
        return {"spring": straight, **speed}
    lever = _lever(solution, follower)
    return {"spring": _rounded({"inertia": USUAL_MASS * lever**2, "stiffness": USUAL_STIFFNESS * lever**2}), **speed}


def _lever(solution: Solution, follower: Mapping[str, Any]) -> float:
    """How far from its pivot a follower is moved [mm]."""
    return float(follower.get("arm") or follower.get("distance") or solution.chain.place)


def _rounded(sizes: Mapping[str, float]) -> dict[str, float]:
    return {key: float(f"{value:.{SIZE_DIGITS}g}") for key, value in sizes.items()}


def _sheet(make: FieldMaker) -> Iterator[Field]:
    """The fields of the drawing error and of the sheet."""
    yield make.number("pencil")
    yield make.choice("drawing.format", say("Format"), [(each, each) for each in get_args(Format)])
    yield make.choice("drawing.frame", say("Frame"), [(each, FRAME_NAMES[each]) for each in get_args(Frame)])
    spoken = [(each, LANGUAGE_NAMES.get(each, each)) for each in languages()]
    yield make.choice("drawing.language", say("Language of the sheet"), spoken)


KINDS: dict[str, Caption] = {
    Translating.kind: say_in("a kind of follower", "translating"),
    Oscillating.kind: say_in("a kind of follower", "oscillating"),
    FlatFaced.kind: say_in("a kind of follower", "flat-faced"),
    OscillatingFlat.kind: say_in("a kind of follower", "oscillating flat-faced"),
}
ARM_LIFT_RATIO = 4.0
"""An arm about so many times as long as its tip's path swings by some 14 degrees."""
DEFAULT_ARM = 100.0
"""One whose lifts are angles [mm]."""
DEFAULT_DISTANCE = 200.0
"""The centre distance of a face that swings, where no pivot is known [mm]."""
USUAL_MASS, USUAL_STIFFNESS, USUAL_SPEED = 1.0, 3.0, 120.0
"""Of a follower to which a spring is added: its mass [kg], the spring [N/mm] and the cam [rpm]."""
USUAL_WIDTH = 15.0
"""Of a contact whose stress is asked for [mm]."""
SIZE_DIGITS = 4
"""Digits of the sizes of a spring that goes with another kind of follower."""


def kind_choices(solution: Solution, tell: Tell) -> list[dict[str, Any]]:
    """The kinds that the task's motion goes with; ``table`` is a follower of that kind, ``changes`` all that changes.

    >>> import graphcam as gc
    >>> [choice["value"] for choice in kind_choices(gc.solve(gc.builtin_task()), str)]
    ['translating', 'oscillating', 'flat-faced']
    """
    tables = {kind: _table(solution, kind) for kind in KINDS}
    return [
        {"value": kind, "name": tell(KINDS[kind]), "table": table, "changes": _changes(solution, table)}
        for kind, table in tables.items()
        if _can_follow(solution, table)
    ]


def _table(solution: Solution, kind: str) -> dict[str, Any]:
    """The present follower if it is of that kind; else one whose place and roller are found."""
    present = plain_data(solution.task.follower)
    if kind == present["kind"]:
        return present
    # Lifts in mm stay what they are: they are the arc that the tip of the arm describes.
    in_mm = solution.task.follower.column == "s_mm"
    arm = round_up(ARM_LIFT_RATIO * lift_of(solution)) if in_mm else DEFAULT_ARM
    pivots = {
        Oscillating.kind: {"arm": arm, "lift": "arc" if in_mm else "angle"},
        OscillatingFlat.kind: {"distance": DEFAULT_DISTANCE},
    }
    return {"kind": kind, **pivots.get(kind, {})}


def _can_follow(solution: Solution, table: dict[str, Any]) -> bool:
    """Whether a follower can do the motion: measured angles are nothing for a stem, millimetres nothing for a face."""
    measured, present = solution.task.motion.table, solution.task.follower.column
    column = table_of(table)(**table).column
    return column == "s_mm" or present == column if measured is None else measured.column in ("a", column)


def _changes(solution: Solution, follower: dict[str, Any]) -> dict[str, Any]:
    """The follower, sizes of the cam found anew, its spring, and no limits, ranges or tolerances that it lacks."""
    if follower == plain_data(solution.task.follower):
        return {"follower": follower}
    angles = dict.fromkeys(("limits.pressure_angle_rise", "limits.pressure_angle_return"))
    other: dict[str, Any] = {"follower": follower, "cam.prime_radius": None, **angles}
    fixed = {"limits.min_curvature_radius": None, "tolerances": None, "sizing": None}
    return other | fixed | _spring_of_kind(solution, follower)


def _spring_of_kind(solution: Solution, follower: dict[str, Any]) -> dict[str, Any]:
    """The spring as the other kind has it; what presses besides, the friction and the material stay as they are.

    At the end of an arm a mass m and a spring c do what the moment of inertia m l^2 and the torsion spring c l^2 do.
    """
    spring, swings = solution.task.spring, table_of(follower).swings
    if spring is None or spring.swings == swings:
        return {}
    present = plain_data(solution.task.follower)
    lever = _lever(solution, follower if swings else present)
    said = plain_data(spring)
    kept = {key: said[key] for key in ("acceleration", "friction", "load")}
    if isinstance(spring, SpringTable):
        turned = {"inertia": spring.mass * lever**2, "stiffness": spring.stiffness * lever**2}
        turned["damping"] = spring.damping / MM_PER_M * lever**2
        turned |= {} if spring.preload is None else {"preload": spring.preload * lever}
    else:
        turned = _straightened(spring, lever)
    return {"spring": {**_rounded(turned), **kept}}


def _straightened(spring: ArmSpringTable, lever: float) -> dict[str, float]:
    """The spring of an arm of that length [mm] as that of a stem; one at a point is taken as it is."""
    square = lever**2 if spring.at is None else 1.0
    straight = {"mass": spring.inertia / lever**2, "stiffness": spring.stiffness / square}
    straight["damping"] = spring.damping * MM_PER_M / lever**2
    return straight | ({} if spring.preload is None else {"preload": spring.preload / math.sqrt(square)})
