"""The views of a worksheet that is photographed: what is given in each, and the room for all that is to be drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.axes import OVERHANG, ordinate
from graphcam.constructions.chain import Chain
from graphcam.constructions.views import PROFILE, at_scale
from graphcam.drafting.marks import Mark
from graphcam.drafting.scale import Scale
from graphcam.errors import DesignError
from graphcam.exercises.definition.blank_axes import ROOM, marked_axes, room_of
from graphcam.exercises.definition.drawn_answers import construction_of
from graphcam.exercises.definition.exercise import Diagram, Exercise
from graphcam.photo.printed import PrintedView
from graphcam.sheets.box import Box
from graphcam.words import Tell, say

RIGHT_OF_TURN = 1.0
"""The room beyond the tip of the axis of the cam angle, mm."""


@dataclass(frozen=True, eq=False)
class MarkedView:
    """A view about its origin.

    name : as in ``Page.origins``
    room : the box that is kept for what is drawn, nothing black in it
    marks : the givens
    title : said above it, or beside one that is a diagram
    end_title : said at the end of a diagram's axis
    turn : the length of a diagram's axis [mm], 0 where a curve runs round the origin
    """

    name: str
    room: Box
    marks: tuple[Mark, ...]
    title: str
    end_title: str = ""
    turn: float = 0.0

    def printed(self, origin: complex) -> PrintedView:
        """The view as it is printed on its page."""
        room = self.room.moved(origin)
        edges = room.left, room.bottom, room.right, room.top
        return PrintedView(origin, edges, closed=not self.turn, end=self.turn)


def marked_views(exercise: Exercise, chain: Chain, side: float, tell: Tell) -> list[MarkedView]:
    """The views of an exercise's worksheet: its diagrams in order, and the profile.

    side : of the room of the profile [mm]

    Raises
    ------
    DesignError : the worksheet shows a view for which no room is known
    """
    steps = [step for name, count in exercise.sheet.items() for step in construction_of(chain, name).steps()[:count]]
    for step in steps:
        if step.view.name != PROFILE.name:
            limit = say("the profile and empty axes alone where worksheets are photographed")
            raise DesignError("sheet", step.view.name, limit, say("leave papers out"))
    views = [_diagram(exercise, chain, name, tell) for name in exercise.axes]
    marks = [mark for step in steps for mark in step.told(tell).marks]
    if marks:
        views.append(_profile(chain, side, marks, tell))
    return views


def _profile(chain: Chain, side: float, marks: Sequence[Mark], tell: Tell) -> MarkedView:
    """The cam's profile in the room for which its scale was chosen, whatever the cam."""
    room = Box(-side / 2, -side / 2, side / 2, side / 2)
    title = tell(at_scale(PROFILE, chain.profile_scale).title)
    return MarkedView(PROFILE.name, room, tuple(marks), title)


def _diagram(exercise: Exercise, chain: Chain, name: Diagram, tell: Tell) -> MarkedView:
    """Empty axes that reach up to the edges of their room; what they are called stands outside."""
    (low, high), (view, marks, before) = room_of(exercise, name), marked_axes(exercise, chain, name)
    mu_phi = chain.board.mu_phi
    turn = 2 * np.pi / mu_phi.per_mm
    room = Box(-before, low, turn + OVERHANG + RIGHT_OF_TURN, high)
    unit = ordinate(ROOM[name][0], chain.board.follower.unit)
    title = tell(say("{title}: {unit}", title=view.title, unit=unit))
    return MarkedView(view.name, room, marks, title, _scale_said(mu_phi, tell), turn)


def _scale_said(mu_phi: Scale, tell: Tell) -> str:
    return tell(say("φ, °; μᵩ = {mu:.4g}°/mm", mu=np.degrees(mu_phi.per_mm)))
