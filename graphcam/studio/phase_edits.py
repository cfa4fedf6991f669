"""Phases that are added and taken away, so that the angles still make a turn and the lifts still close."""

from collections.abc import Sequence
from typing import Any

from graphcam.studio.size_ranges import LEAST_ANGLE, MOST_PHASES

PhaseData = dict[str, Any]
"""A phase as the task file says it."""
PhaseList = list[PhaseData]


def without(phases: Sequence[PhaseData], k: int) -> PhaseList | None:
    """The phases without one of them; None where it must stay.

    The angle of a dwell goes to the phase before it; angle and lift of a rise or return to another one of its kind.

    >>> turn = [{"kind": "rise", "angle": 100, "lift": 9}, {"kind": "dwell", "angle": 80},
    ...     {"kind": "return", "angle": 180, "lift": 9}]
    >>> [phase["angle"] for phase in without(turn, 1)], without(turn, 0)
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
    angles = _parts(phases, k, 2)
    beside = phases[(k + 1) % len(phases)]
    if angles is None or "dwell" in (phases[k]["kind"], beside["kind"]):
        return None
    return [*_copies(phases[:k]), phases[k] | {"angle": angles[0]}, _dwell(angles[1]), *_copies(phases[k + 1 :])]


def with_step(phases: Sequence[PhaseData], k: int) -> PhaseList | None:
    """The phases with a rise or return done in two, a dwell between them, or a rise and a return within a dwell.

    >>> turn = [{"kind": "rise", "angle": 100, "lift": 8, "law": "cosine"},
    ...     {"kind": "return", "angle": 260, "lift": 8, "law": "cosine"}]
    >>> [(phase["kind"], phase["angle"], phase.get("lift")) for phase in with_step(turn, 0)]
    [('rise', 34, 4.0), ('dwell', 33, None), ('rise', 33, 4.0), ('return', 260, 8)]
    """
    phase = phases[k]
    within = phase["kind"] == "dwell"
    angles = _parts(phases, k, 4 if within else 3)
    if angles is None:
        return None
    if within:
        law = next(dict(each) for each in phases if each["kind"] == "rise")
        halved = law | {"lift": law["lift"] / 2}
        between = [halved | {"kind": kind} for kind in ("rise", "return")]
        new = [
            _dwell(angles[0]),
            between[0] | {"angle": angles[1]},
            between[1] | {"angle": angles[2]},
            _dwell(angles[3]),
        ]
    else:
        half = phase | {"lift": phase["lift"] / 2}
        new = [half | {"angle": angles[0]}, _dwell(angles[1]), half | {"angle": angles[2]}]
    return [*_copies(phases[:k]), *new, *_copies(phases[k + 1 :])]


def _dwell(angle: float) -> PhaseData:
    return {"kind": "dwell", "angle": angle}


def _copies(phases: Sequence[PhaseData]) -> PhaseList:
    return [dict(phase) for phase in phases]


def _parts(phases: Sequence[PhaseData], k: int, count: int) -> list[float] | None:
    """The angle of a phase in parts of whole degrees but one; None if these, or so many phases, are too many."""
    angle = phases[k]["angle"]
    part = angle // count
    if part < LEAST_ANGLE or len(phases) + count - 1 > MOST_PHASES:
        return None
    # The first takes what is left; one degree more goes to each of the next while there are some.
    return [angle - (count - 1) * part, *[part] * (count - 1)]
