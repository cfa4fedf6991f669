"""Boards to draw on: the built-in coursework task and variations of it, arms and flat faces."""

from __future__ import annotations

from dataclasses import replace
from math import radians
from typing import Any

import numpy as np

from graphcam.constructions.board import Board
from graphcam.constructions.chain import AdoptedSizes
from graphcam.constructions.drawn_arm import MAX_ARM_ON_PAPER, DrawnOscillating
from graphcam.constructions.drawn_flat_face import DrawnFlatFaced
from graphcam.constructions.drawn_swinging_face import DrawnOscillatingFlat
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.drafting.scale import GOST_2_302, Paper, Scale, standard_scale
from graphcam.given.follower import Limits
from graphcam.given.motion import FULL_TURN, Dwell, Motion, Return, Rise
from graphcam.given.roller_rule import DEFAULT_RULE, roller_rule

SIZES = AdoptedSizes(prime_radius=46.0, place=-10.0, roller_radius=12.0)
"""A cam for every division, so that what converges is one cam's drawing."""


def motion_of(*phases: tuple[Any, ...]) -> Motion:
    """Phases as (signed lift [mm], degrees, law, ratio); without a law, a dwell.  A dwell fills up the turn."""
    parts: list[Rise | Dwell | Return] = []
    for lift, degrees, *law in phases:
        kind = Rise if lift > 0 else Return
        parts.append(kind(abs(lift), radians(degrees), *law) if lift else Dwell(radians(degrees)))
    rest = FULL_TURN - sum(part.angle for part in parts)
    return Motion([*parts, Dwell(rest)] if rest > 1e-9 else parts)


def coursework_motion(law: str, ratio: float = 1.0) -> Motion:
    """30 mm up in 80 degrees, rest 45, down in 60, rest 175."""
    return motion_of((30, 80, law, ratio), (0, 45), (-30, 60, law, ratio))


def limits(rise: float, return_: float | None = None, *, rest: bool = True) -> Limits:
    """Permitted angles in degrees."""
    return Limits(radians(rise), None if return_ is None else radians(return_), rest)


def board_of(motion: Motion, offset: float | None = -10.0, **changes: Any) -> Board:
    """The built-in task's board with another motion, and other ``changes``."""
    choices: dict[str, Any] = {
        "rotation": "cw", "limits": limits(30), "prime_radius": None, "roller_radius": None,
        "roller_rule": roller_rule(DEFAULT_RULE), "divisions": 12, "ordinate": 50.0, "poles": (40.0, 40.0),
        "mu_phi": Scale(radians(1), "rad"), "rounding": None, "paper": Paper(330.0, 330.0, GOST_2_302),
    }  # fmt: skip
    return Board(motion=motion, follower=DrawnTranslating(offset), **(choices | changes))


def coursework(law: str = "rectangular", ratio: float = 1.0, **changes: Any) -> Board:
    """The built-in task's board with any law."""
    return board_of(coursework_motion(law, ratio), **changes)


def order(parts: Any, errors: Any) -> float:
    """The order of convergence: the slope of log error on log n, fitted by least squares."""
    return -float(np.polyfit(np.log(parts), np.log(errors), 1)[0])


# --- arms and flat faces ---------------------------------------------------------------------------------------------

ARM = 100.0
"""Length of the arm of :func:`arm_board` [mm]."""


def arm_motion_of(*phases: tuple[Any, ...]) -> Motion:
    """As :func:`motion_of`, with the lifts of an arm in degrees."""
    return motion_of(*((radians(lift), *rest) for lift, *rest in phases))


def arm_motion(law: str, lift: float = 20.0, ratio: float = 1.0) -> Motion:
    """20 degrees up in 90 degrees, rest 40, down in 80, rest 150."""
    return arm_motion_of((lift, 90, law, ratio), (0, 40), (-lift, 80, law, ratio))


def arm_board(motion: Motion, distance: float | None = 120.0, arm: float = ARM, **changes: Any) -> Board:
    """A board for an arm at the usual limit of 45 degrees, and other ``changes``."""
    board = board_of(motion, **({"rotation": "ccw", "limits": limits(45)} | changes))
    mu_l = standard_scale(arm, MAX_ARM_ON_PAPER, board.paper.ratios)
    return replace(board, follower=DrawnOscillating(arm, distance, mu_l))


def flat_motion(law: str, ratio: float = 1.0) -> Motion:
    """30 mm up in 120 degrees, rest 30, down in 100, rest 110."""
    return motion_of((30, 120, law, ratio), (0, 30), (-30, 100, law, ratio))


def flat_board(motion: Motion, least_curvature: float = 8.0, **changes: Any) -> Board:
    """A board for a flat face with a least permitted radius of curvature [mm], and other ``changes``."""
    board = board_of(motion, **({"rotation": "ccw", "roller_radius": 0.0} | changes))
    return replace(board, follower=DrawnFlatFaced(least_curvature))


def swinging_face_board(
    motion: Motion, distance: float = 150.0, face_offset: float = 10.0, least_curvature: float = 8.0, **changes: Any
) -> Board:
    """A board for a flat face on a pivot [mm] with a least permitted radius of curvature, and other ``changes``."""
    board = board_of(motion, **({"rotation": "ccw", "roller_radius": 0.0} | changes))
    mu_l = standard_scale(distance, MAX_ARM_ON_PAPER, board.paper.ratios)
    return replace(board, follower=DrawnOscillatingFlat(distance, face_offset, least_curvature, mu_l))
