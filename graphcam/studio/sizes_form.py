"""The form of a task's sizes: what can be typed or moved, in the order shown, in the words of the field."""

from collections.abc import Iterator, Sequence
from typing import Any, get_args

from graphcam.constructions.axes import phase_symbol
from graphcam.constructions.law_names import LAW_TITLES
from graphcam.given.arm_load import ArmLoad
from graphcam.given.laws import LAWS
from graphcam.given.load_curve import LoadCurve
from graphcam.given.polynomial_law import CONSTANT_VELOCITY
from graphcam.given.roller_rule import DEFAULT_RULE, NAMED_RULES
from graphcam.language import languages
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.solving.spring_design import SpringDesign
from graphcam.studio.follower_kinds import kind_choices
from graphcam.studio.form_fields import DEGREES, DRAWING, FOLLOWER, LIMITS, MOTION, Field, FieldMaker, must_agree
from graphcam.studio.phase_edits import with_dwell, with_step, without
from graphcam.studio.size_ranges import (
    LEAST_ANGLE,
    MOST_PHASES,
    SizeRange,
    has_angles,
    ranges,
    round_up,
    sizes_of,
    step_for,
)
from graphcam.tasks.sheet_tables import Format, Frame
from graphcam.words import Tell, Words, say, say_in

PENCIL = SizeRange(0.0, 0.5, 0.05)
"""Standard deviation of a line [mm]; 0.2 is a careful student's."""
RATIO = SizeRange(0.2, 5.0, 0.1)
"""The range of the ratio of accelerations of the rectangular law's parts."""
KIND_NAMES = {"rise": say("rise"), "dwell": say("dwell"), "return": say_in("a phase", "return")}
TURNING = {"cw": say("clockwise"), "ccw": say("anticlockwise")}
LIFTS = {"angle": say("angle of the arm, degrees"), "arc": say("arc of its end, mm")}
JERK = {False: say("not drawn"), True: say("drawn by differentiation")}
"""Whether the diagram of the jerk is drawn."""
AT_REST = {True: say("within the limit"), False: say("not limited")}
LANGUAGES = {"en": "English", "ru": "русский", "vi": "tiếng Việt", "zh": "简体中文"}
"""Each in itself; another one by its sign."""
FRAMES = {"gost": say("frame by GOST"), "iso": say("frame by ISO")}


def form_of(solution: AnySolution, tell: Tell) -> list[Field]:
    """The fields of a task, in the order shown.

    solution : says what the task leaves open, and what was found for that
    tell : says captions in the language of the page

    >>> import graphcam as gc
    >>> fields = form_of(gc.solve(gc.builtin_task()), str)
    >>> [(field["path"], field["value"], field["adopted"]) for field in fields if "adopted" in field][1:4]
    [('follower.offset', -10.0, -10.0), ('follower.roller_radius', None, 17.0), ('cam.prime_radius', None, 44.0)]
    """
    found = ranges(solution) | {"pencil": PENCIL}
    # What the task leaves out has its default.
    said = solution.task.to_dict() | {"pencil": solution.chain.pencil.line}
    make = FieldMaker(said, found, tell)
    if isinstance(solution, ArcsSolution):
        return [*_arcs(make, solution), *_sheet(make)]
    fields = _motion(make, solution), _follower(make, solution), _limits(make, solution), _drawing(make, solution)
    return [*(field for part in fields for field in part), *_sheet(make)]


def _arcs(make: FieldMaker, solution: ArcsSolution) -> Iterator[Field]:
    """The points and radii of a cam of three arcs."""
    arcs, cam = solution.task.arcs, solution.cam
    for name in ("D", "G"):
        yield from (make.coordinate(arcs, name, k, None) for k in (0, 1))
    yield make.number("arcs.rho1") | {"first": dict.fromkeys(must_agree(arcs, "rho1"))}
    for name in ("A", "C1", "C2"):
        # A may be left out only where the centre tells where the rise begins, and the other way round.
        open_ = name == "C1" or getattr(arcs, "A" if name == "C2" else "C2") is not None
        adopted = tuple(round(float(x), 6) for x in getattr(cam, name)) if open_ else None
        yield from (make.coordinate(arcs, name, k, adopted) for k in (0, 1))
    yield make.number("arcs.dwell")
    yield make.number("follower.roller_radius")
    yield make.open_number("speed_rpm", None)
    yield make.number("drawing.divisions")


def _motion(make: FieldMaker, solution: Solution) -> Iterator[Field]:
    if solution.task.motion.table is not None:
        yield make.number("motion.tolerance")
    elif solution.task.motion.phases is not None:
        yield _phases(make, solution)
    yield make.choice("rotation", MOTION, say("Rotation of the cam"), TURNING.items())
    yield make.open_number("speed_rpm", None)


def _phases(make: FieldMaker, solution: Solution) -> Field:
    """The phases, and what becomes of them when one is added or taken away."""
    phases: Sequence[dict[str, Any]] = make.said["motion"]["phases"]
    motion, tell = solution.cam.motion, make.tell
    lift = max(phase.get("lift", 0.0) for phase in phases)
    rows = [
        {
            **phase,
            "name": tell(KIND_NAMES[phase["kind"]]),
            "symbol": tell(phase_symbol(motion, k)),
            "edits": {"remove": without(phases, k), "dwell": with_dwell(phases, k), "step": with_step(phases, k)},
        }
        for k, phase in enumerate(phases)
    ]
    lifts = SizeRange(step_for(lift), round_up(1.6 * lift), step_for(lift))
    return {
        "path": "motion.phases",
        "group": tell(MOTION),
        "name": tell(say("Phases")),
        "kind": "phases",
        "phases": rows,
        "laws": [{"value": law, "name": tell(LAW_TITLES[law])} for law in (*LAWS, CONSTANT_VELOCITY)],
        # Only this law has parts whose accelerations differ.
        "ratio": RATIO.plain() | {"law": "rectangular"},
        "angle": SizeRange(LEAST_ANGLE, 360.0 - LEAST_ANGLE * (len(rows) - 1), 1.0).plain() | {"unit": DEGREES},
        "lift": lifts.plain() | {"unit": _lift_unit(make, solution)},
        "most": MOST_PHASES,
    }


def _lift_unit(make: FieldMaker, solution: Solution) -> str:
    return DEGREES if sizes_of(solution.task).get("lift") == "angle" else make.unit("mm")


def _follower(make: FieldMaker, solution: Solution) -> Iterator[Field]:
    """The follower, its sizes, and the prime radius."""
    sizes, chain = sizes_of(solution.task), solution.chain
    kinds = make.choice("follower.kind", FOLLOWER, say("Kind of follower"), ())
    yield kinds | {"choices": kind_choices(solution, make.tell)}
    if "offset" in sizes:
        yield make.open_number("follower.offset", chain.place)
    if "arm" in sizes:
        yield make.number("follower.arm")
        yield make.open_number("follower.distance", chain.place)
        yield make.choice("follower.lift", FOLLOWER, say("Lifts of the phases"), LIFTS.items())
    if "roller_radius" in sizes:
        yield make.open_number("follower.roller_radius", chain.roller_radius)
        rules: list[tuple[str, Words]] = [(DEFAULT_RULE, DEFAULT_RULE)]
        rules += [(name, f"{each.rule} ({name})") for name, each in NAMED_RULES.items()]
        yield make.choice("follower.roller_rule", FOLLOWER, say("Rule for the roller"), rules)
    yield make.open_number("cam.prime_radius", chain.prime_radius)


def _limits(make: FieldMaker, solution: Solution) -> Iterator[Field]:
    """What the cam must keep to, and the spring and the material if there are such."""
    if not has_angles(solution.task):
        yield make.open_number("limits.min_curvature_radius", None)
    else:
        yield make.number("limits.pressure_angle_rise")
        yield make.open_number("limits.pressure_angle_return", None)
        yield make.choice("limits.rest", LIMITS, say("Angle in the lower dwell"), AT_REST.items())
    if solution.spring is not None:
        yield from _spring(make, solution.spring)
    if solution.task.material is not None:
        for name in ("width", "young_cam", "young_follower", "poisson_cam", "poisson_follower"):
            yield make.number(f"material.{name}")
        yield make.open_number("material.permitted_stress", None)


def _spring(make: FieldMaker, spring: SpringDesign) -> Iterator[Field]:
    """What presses the follower on the cam."""
    load, (_, preload, stiffness) = spring.load, spring.units
    yield make.number("spring.inertia" if isinstance(load, ArmLoad) else "spring.mass")
    yield make.number("spring.stiffness") | {"unit": make.unit(stiffness)}
    yield make.open_number("spring.preload", load.preload) | {"unit": make.unit(preload)}
    if isinstance(load, ArmLoad) and load.at is not None:
        yield from map(make.number, ("spring.at.arm", "spring.at.anchor[0]", "spring.at.anchor[1]"))
    yield make.number("spring.friction")
    yield make.number("spring.acceleration")
    if not isinstance(load.load, LoadCurve):
        yield make.number("spring.load")


def _drawing(make: FieldMaker, solution: Solution) -> Iterator[Field]:
    """The choices of the draughtsman."""
    board = solution.chain.board
    yield make.number("drawing.divisions")
    yield make.open_number("drawing.ordinate", board.ordinate)
    yield from (make.entry("drawing.poles", board.poles, k) for k in (0, 1))
    yield make.choice("drawing.jerk", DRAWING, say("Jerk"), JERK.items())


def _sheet(make: FieldMaker) -> Iterator[Field]:
    """The hand, and what the sheet is."""
    yield make.number("pencil")
    yield make.choice("drawing.format", DRAWING, say("Format"), [(each, each) for each in get_args(Format)])
    yield make.choice("drawing.frame", DRAWING, say("Frame"), [(each, FRAMES[each]) for each in get_args(Frame)])
    spoken = [(each, LANGUAGES.get(each, each)) for each in languages()]
    yield make.choice("drawing.language", DRAWING, say("Language of the sheet"), spoken)
