"""Task to drawing board: what a hand starts from, and how large the diagrams are drawn where the task leaves it open.

These are the scale of the cam angle, the ordinate and the poles.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import singledispatch

import numpy as np

from graphcam.constructions.board import Board, DrawnFollower
from graphcam.constructions.drawn_arm import ARM_ON_PAPER, DrawnOscillating
from graphcam.constructions.drawn_flat_face import DrawnFlatFaced
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.drafting.scale import Scale
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion, Rise
from graphcam.given.roller_rule import roller_rule
from graphcam.sheets.layout import profile_room
from graphcam.tasks.sheet_tables import SheetTable
from graphcam.tasks.task import FlatFacedTable, FollowerTable, OscillatingTable, Task, TranslatingTable


def board_of(task: Task) -> Board:
    """What the task puts on the drawing board."""
    drawing, motion = task.drawing, task.motion()
    follower = drawn_follower(task.follower, task)
    room = diagram_room(drawing, angles="angle_diagram" in follower.constructions)
    ordinate = drawing.ordinate or chosen_ordinate(motion, room)
    return Board(
        motion=motion,
        follower=follower,
        rotation=task.rotation,
        limits=task.limits(),
        prime_radius=task.cam.prime_radius,
        roller_radius=task.follower.roller_radius,
        roller_rule=roller_rule(task.follower.roller_rule),
        divisions=drawing.divisions,
        ordinate=ordinate,
        poles=drawing.poles or chosen_poles(motion, room, ordinate),
        mu_phi=Scale(math.radians(room.degrees_per_mm), "rad"),
        rounding=drawing.rounding,
        profile_room=profile_room(drawing.format, drawing.frame, drawing.orientation),
    )


@singledispatch
def drawn_follower(table: FollowerTable, task: Task) -> DrawnFollower:
    """The follower of a task's table, as it is drawn: the one place of the drawn side that asks which it is."""
    raise TypeError(table)


@drawn_follower.register
def _(table: TranslatingTable, task: Task) -> DrawnTranslating:
    return DrawnTranslating(table.offset)


@drawn_follower.register
def _(table: OscillatingTable, task: Task) -> DrawnOscillating:
    return DrawnOscillating(table.arm, table.distance, arm_room(task.drawing))


@drawn_follower.register
def _(table: FlatFacedTable, task: Task) -> DrawnFlatFaced:
    return DrawnFlatFaced(task.limits.min_curvature_radius or 0.0)


ORDINATES = (80.0, 60.0, 50.0, 40.0, 30.0, 25.0, 20.0, 15.0, 12.0, 10.0, 8.0, 6.0, 5.0)
"""Ordinates that are chosen from [mm of paper]."""
POLES = (12.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 80.0)
"""Pole distances that are chosen from [mm of paper]."""
USUAL_POLE = 40.0
"""At 1 degree a millimetre [mm of paper]; where the axis is shorter it is shorter in proportion, so that chords keep
their slopes."""
LOW = 0.7
"""A diagram that is lower than this part of its room gets a shorter pole, as long as it keeps to the room."""
LONGEST_POLE = 0.25
"""Of the axis of the cam angle: a longer pole would take the room of the diagrams."""


@dataclass(frozen=True)
class DiagramRoom:
    """What the diagrams of a format are drawn for.

    degrees_per_mm : of the cam angle, so that a turn and the poles fit across the sheet
    a, v, s : heights that the whole diagrams should keep to [mm of paper]
    """

    degrees_per_mm: float
    a: float
    v: float
    s: float


ROOMS = {
    ("A1", "landscape"): DiagramRoom(1.0, 180.0, 130.0, 60.0),
    ("A1", "portrait"): DiagramRoom(1.0, 120.0, 100.0, 50.0),
    ("A2", "landscape"): DiagramRoom(1.0, 75.0, 60.0, 36.0),
    ("A2", "portrait"): DiagramRoom(2.0, 110.0, 90.0, 50.0),
    ("A3", "landscape"): DiagramRoom(2.0, 90.0, 75.0, 40.0),
    ("A3", "portrait"): DiagramRoom(2.0, 80.0, 70.0, 40.0),
    ("A4", "landscape"): DiagramRoom(2.0, 45.0, 40.0, 30.0),
    ("A4", "portrait"): DiagramRoom(3.0, 75.0, 65.0, 40.0),
}
"""By format and orientation."""
WITHOUT_ANGLES = 1.6
"""So many times its height the displacement may have where no diagram of the pressure angle stands under it; not on A4,
where the combined diagram, which has the same scale, would be wider than the sheet."""


def diagram_room(drawing: SheetTable, *, angles: bool = True) -> DiagramRoom:
    """What the diagrams of a sheet are drawn for, with or without that of the pressure angle."""
    room = ROOMS[drawing.format, drawing.orientation]
    return room if angles or drawing.format == "A4" else replace(room, s=WITHOUT_ANGLES * room.s)


def arm_room(drawing: SheetTable) -> float:
    """How long an arm may be where its positions are drawn [mm of paper]: on A4 all of it would not fit as usual."""
    return ARM_ON_PAPER / 2 if drawing.format == "A4" else ARM_ON_PAPER


def chosen_ordinate(motion: Motion, room: DiagramRoom) -> float:
    """The largest ordinate of the first rise [mm of paper] at which the acceleration keeps to its room.

    >>> from math import pi
    >>> import graphcam as gc
    >>> slow, steep = gc.Return(30, 4 * pi / 3, "3-4-5"), gc.Return(30, pi / 4, "3-4-5")
    >>> a3 = ROOMS["A3", "landscape"]
    >>> chosen_ordinate(gc.Motion([gc.Rise(30, 2 * pi / 3, "3-4-5"), slow]), a3)
    40.0
    >>> chosen_ordinate(gc.Motion([gc.Rise(30, 7 * pi / 4, "3-4-5"), steep]), a3)
    5.0
    """
    _, _, a = _values(motion)
    height = _height(a) / _first_peak(motion)
    return next((y for y in ORDINATES if y * height <= room.a), ORDINATES[-1])


def chosen_poles(motion: Motion, room: DiagramRoom, ordinate: float) -> tuple[float, float]:
    """The pole distances, acceleration to velocity and on to displacement [mm of paper].

    The usual ones; longer ones where a diagram would be too high, shorter ones where it would be much lower than its
    room.
    """
    s, v, _ = _values(motion)
    # mu_v = mu_a mu_phi H1, mu_s = mu_v mu_phi H2.
    mu_phi = np.radians(room.degrees_per_mm)
    mu_a = _first_peak(motion) / ordinate
    first = _pole(room, room.v, lambda pole: _height(v) / (mu_a * mu_phi * pole))
    second = _pole(room, room.s, lambda pole: _height(s) / (mu_a * mu_phi * first * mu_phi * pole))
    return first, second


SAMPLES = 361
"""Of each phase, however short it is."""


def _values(motion: Motion) -> tuple[Floats, Floats, Floats]:
    """s, v and a over the turn."""
    phase, u = np.meshgrid(np.arange(len(motion.phases)), np.linspace(0.0, 1.0, SAMPLES), indexing="ij")
    return motion.at(phase.ravel(), u.ravel())[:3]


def _height(values: Floats) -> float:
    """Of a whole diagram, with its axis."""
    return float(max(0.0, values.max()) - min(0.0, values.min()))


def _first_peak(motion: Motion) -> float:
    """The greatest acceleration of the first rise."""
    first = next(phase for phase in motion.phases if isinstance(phase, Rise))
    return first.normalised.peak_acceleration * first.lift / first.angle**2


def _pole(room: DiagramRoom, high: float, height: Callable[[float], float]) -> float:
    usual, longest = USUAL_POLE / room.degrees_per_mm, LONGEST_POLE * 360 / room.degrees_per_mm
    possible = [pole for pole in POLES if pole <= longest]
    k = min(range(len(possible)), key=lambda k: abs(possible[k] - usual))
    while k + 1 < len(possible) and height(possible[k]) > high:
        k += 1
    while k > 0 and height(possible[k]) < LOW * high and height(possible[k - 1]) <= high:
        k -= 1
    return possible[k]
