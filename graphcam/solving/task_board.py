"""Task to drawing board: what a hand starts from."""

from __future__ import annotations

import math
from functools import singledispatch

from graphcam.constructions.board import Board, DrawnFollower
from graphcam.constructions.drawn_arm import DrawnOscillating
from graphcam.constructions.drawn_flat_face import DrawnFlatFaced
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.drafting.scale import Scale
from graphcam.given.roller_rule import roller_rule
from graphcam.sheets.layout import profile_room
from graphcam.solving.diagram_sizes import arm_room, chosen_ordinate, chosen_poles, diagram_room
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
