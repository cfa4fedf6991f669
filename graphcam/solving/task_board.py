"""Task to drawing board: what a hand starts from."""

from __future__ import annotations

import math

from graphcam.constructions.board import Board, DrawnFollower
from graphcam.constructions.drawn_arm import DrawnOscillating
from graphcam.constructions.drawn_flat_face import DrawnFlatFaced
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.drafting.scale import Scale
from graphcam.given.roller_rule import DEFAULT_RULE, roller_rule
from graphcam.sheets.layout import profile_room
from graphcam.solving.diagram_sizes import arm_room, chosen_ordinate, chosen_poles, diagram_room
from graphcam.tasks.task import OscillatingTable, Task, TranslatingTable


def board_of(task: Task) -> Board:
    """What the task puts on the drawing board."""
    drawing, motion = task.drawing, task.motion()
    follower = _drawn_follower(task)
    room = diagram_room(drawing, angles="angle_diagram" in follower.constructions)
    ordinate = drawing.ordinate or chosen_ordinate(motion, room)
    return Board(
        motion=motion,
        follower=follower,
        rotation=task.rotation,
        limits=task.limits(),
        prime_radius=task.cam.prime_radius,
        roller_radius=getattr(task.follower, "roller_radius", 0.0),
        roller_rule=roller_rule(getattr(task.follower, "roller_rule", DEFAULT_RULE)),
        divisions=drawing.divisions,
        ordinate=ordinate,
        poles=drawing.poles or chosen_poles(motion, room, ordinate),
        mu_phi=Scale(math.radians(room.degrees_per_mm), "rad"),
        rounding=drawing.rounding,
        profile_room=profile_room(drawing.format, drawing.frame, drawing.orientation),
    )


def _drawn_follower(task: Task) -> DrawnFollower:
    """The follower of the task, as it is drawn."""
    table = task.follower
    if isinstance(table, TranslatingTable):
        return DrawnTranslating(table.offset)
    if isinstance(table, OscillatingTable):
        return DrawnOscillating(table.arm, table.distance, arm_room(task.drawing))
    return DrawnFlatFaced(task.limits.min_curvature_radius or 0.0)
