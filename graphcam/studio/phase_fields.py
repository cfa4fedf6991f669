"""The phases of a motion in the form: their fields, and what becomes of them when one is added or taken away."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

from graphcam.constructions.axes import phase_symbol
from graphcam.constructions.law_names import LAW_TITLES
from graphcam.given.laws import DECLARED_LAWS, LAWS
from graphcam.given.polynomial_law import CONSTANT_VELOCITY, USUAL_BLENDS
from graphcam.solving.solution import Solution
from graphcam.studio.form_fields import DEGREE_SIGN, MOTION, PHASE_NAMES, Field, FieldMaker, lift_unit
from graphcam.studio.size_ranges import MAX_PHASES, MIN_PHASE_ANGLE, SizeRange, round_up, step_for
from graphcam.words import Caption, say, say_in

RATIO_RANGE = SizeRange(0.2, 5.0, 0.1)
"""The range of the ratio of accelerations of a law's parts."""
BLEND_RANGE = SizeRange(0.01, 0.98, 0.01)
"""The range of the part of a phase that a blend takes."""
PHASE_LAWS = (*LAWS, CONSTANT_VELOCITY)
RATIO_LAWS = frozenset(name for name, law in DECLARED_LAWS.items() if law.has_ratio)
"""Only these laws have parts whose accelerations differ."""
BLEND_NAMES = {
    "first_blend": say_in("a phase", "Part of the first blend"),
    "second_blend": say_in("a phase", "Part of the second blend"),
}
KIND_NAMES = {"rise": say("rise"), "dwell": say("dwell"), "return": say_in("a phase", "return")}

PhaseData = dict[str, Any]
"""A phase as the task file says it."""
PhaseList = list[PhaseData]


def phases_without(phases: Sequence[PhaseData], k: int) -> PhaseList | None:
    """The phases without one of them; None where it must stay.

    The angle of a dwell goes to the phase before it; angle and lift of a rise or return to another one of its kind.

    >>> turn = [{"kind": "rise", "angle": 100, "lift": 9}, {"kind": "dwell", "angle": 80},
    ...     {"kind": "return", "angle": 180, "lift": 9}]
    >>> [phase["angle"] for phase in phases_without(turn, 1)], phases_without(turn, 0)
    ([180, 180], None)
    """
    left = [dict(phase) for phase in phases]
    gone = left.pop(k)
    heirs = left[k - 1 : k or None] if gone["kind"] == "dwell" else [p for p in left if p["kind"] == gone["kind"]]
    if not heirs:
        return None
    heir = heirs[0]
    heir["angle"] += gone["angle"]
    if gone["kind"] != "dwell":
        heir["lift"] += gone["lift"]
    return left


def with_dwell(phases: Sequence[PhaseData], k: int) -> PhaseList | None:
    """The phases with a dwell after one of them, out of half its angle; None where there is no room.

    >>> turn = [{"kind": "rise", "angle": 101, "lift": 9}, {"kind": "return", "angle": 259, "lift": 9}]
    >>> [(phase["kind"], phase["angle"]) for phase in with_dwell(turn, 0)]
    [('rise', 51), ('dwell', 50), ('return', 259)]
    """
    if "dwell" in (phases[k]["kind"], phases[(k + 1) % len(phases)]["kind"]):
        return None
    return _divided(phases, k, [phases[k], {"kind": "dwell"}])


def with_step(phases: Sequence[PhaseData], k: int) -> PhaseList | None:
    """The phases with a rise or return done in two, a dwell between them, or a rise and a return within a dwell.

    >>> turn = [{"kind": "rise", "angle": 100, "lift": 8, "law": "cosine"},
    ...     {"kind": "return", "angle": 260, "lift": 8, "law": "cosine"}]
    >>> [(phase["kind"], phase["angle"], phase.get("lift")) for phase in with_step(turn, 0)]
    [('rise', 34, 4.0), ('dwell', 33, None), ('rise', 33, 4.0), ('return', 260, 8)]
    """
    phase = phases[k]
    if phase["kind"] == "dwell":
        law = next(each for each in phases if each["kind"] == "rise")
        half = law | {"lift": law["lift"] / 2}
        new = [phase, half, half | {"kind": "return"}, phase]
    else:
        half = phase | {"lift": phase["lift"] / 2}
        new = [half, {"kind": "dwell"}, half]
    return _divided(phases, k, new)


def _divided(phases: Sequence[PhaseData], k: int, new: PhaseList) -> PhaseList | None:
    """The phases with others in place of one, whose angle these take in whole degrees but one.

    It is None where there are too many of them, or too few degrees.
    """
    angle, count = phases[k]["angle"], len(new)
    part = angle // count
    if part < MIN_PHASE_ANGLE or len(phases) + count - 1 > MAX_PHASES:
        return None
    # The first takes what is left; one degree more goes to each of the next while there are some.
    angles = [angle - (count - 1) * part, *[part] * (count - 1)]
    divided = [each | {"angle": angle} for each, angle in zip(new, angles, strict=True)]
    return [*phases[:k], *divided, *phases[k + 1 :]]


def phases_field(make: FieldMaker, solution: Solution) -> Field:
    """The phases with their fields, and what becomes of them when one is added or taken away."""
    phases: PhaseList = make.said["motion"]["phases"]
    tell = make.tell
    rows = [
        {
            **phase,
            "name": tell(KIND_NAMES[phase["kind"]]),
            "symbol": tell(phase_symbol(solution.cam.motion, k)),
            "fields": list(_phase_fields(make, phases, k, lift_unit(solution.task.follower.column))),
            "edits": {
                "remove": phases_without(phases, k),
                "dwell": with_dwell(phases, k),
                "step": with_step(phases, k),
            },
        }
        for k, phase in enumerate(phases)
    ]
    named = {"group": tell(MOTION), "name": tell(say("Phases")), "kind": "phases"}
    return {"path": "motion.phases", **named, "phases": rows}


def _phase_fields(make: FieldMaker, phases: PhaseList, k: int, unit: str) -> Iterator[Field]:
    """The fields of a phase: its angle goes to a neighbour, and with its lift go those of the other sense."""
    phase, path, tell = phases[k], f"motion.phases[{k}]", make.tell

    def number(key: str, name: Caption, at: str, value: float, room: SizeRange, unit: str = "", **more: Any) -> Field:
        """A number of the phase."""
        room = room.widened_to(value)
        return make.field(f"{path}.{at}", "number", name, value, unit, key=f"phase-{key}", **room.plain(), **more)

    if len(phases) > 1:
        other = k + 1 if k < len(phases) - 1 else k - 1
        total = phase["angle"] + phases[other]["angle"]
        rest = {"path": f"motion.phases[{other}].angle", "total": total}
        room = SizeRange(MIN_PHASE_ANGLE, total - MIN_PHASE_ANGLE, 1.0)
        yield number("angle_of_phase", PHASE_NAMES["angle"], "angle", phase["angle"], room, DEGREE_SIGN, sum=rest)
    if phase["kind"] == "dwell":
        return
    lifts = {f"motion.phases[{j}].lift": each["lift"] for j, each in enumerate(phases) if _opposed(each, phase)}
    same = math.fsum(each["lift"] for each in phases if each["kind"] == phase["kind"]) - phase["lift"]
    shares = {at: lift / sum(lifts.values()) for at, lift in lifts.items()}
    beyond = {at: share * same for at, share in shares.items() if same}
    step = step_for(max(each.get("lift", 0.0) for each in phases))
    room, gone = SizeRange(step, round_up(1.6 * phase["lift"]), step), {"with": shares, "beyond": beyond}
    yield number("lift", PHASE_NAMES["lift"], "lift", phase["lift"], room, unit, **gone)
    laws = [{"value": law, "name": tell(LAW_TITLES[law]), "changes": _with_law(path, phase, law)} for law in PHASE_LAWS]
    yield make.field(f"{path}.law", "choice", PHASE_NAMES["law"], phase["law"], key="phase-law", choices=laws)
    if phase["law"] in RATIO_LAWS:
        yield number("ratio", PHASE_NAMES["ratio"], "ratio", phase.get("ratio", 1.0), RATIO_RANGE)
    if phase["law"] == CONSTANT_VELOCITY:
        blends = list(phase.get("blends", USUAL_BLENDS))
        for j, (key, name) in enumerate(BLEND_NAMES.items()):
            first = {f"{path}.blends": blends}
            yield number(key, name, f"blends[{j}]", blends[j], BLEND_RANGE, first=first)


def _opposed(one: PhaseData, other: PhaseData) -> bool:
    """Whether one is a rise and the other a return."""
    return {one["kind"], other["kind"]} == {"rise", "return"}


def _with_law(path: str, phase: PhaseData, law: str) -> dict[str, Any]:
    """The changes that give a phase another law, without the ratio or the blends that it lacks."""
    lacks = {"ratio": law not in RATIO_LAWS, "blends": law != CONSTANT_VELOCITY}
    return {f"{path}.law": law, **{f"{path}.{key}": None for key, gone in lacks.items() if gone and key in phase}}
