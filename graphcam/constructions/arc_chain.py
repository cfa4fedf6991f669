"""The constructions of a cam of three arcs one after another, each fed by the readings of those before it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from graphcam.constructions.arc_diagrams import DIAGRAM_HEIGHTS, arc_diagrams
from graphcam.constructions.arc_outline import ARCS, three_arcs
from graphcam.constructions.arc_profile import ArcStations, divide_arcs
from graphcam.constructions.arc_roller import arc_roller
from graphcam.constructions.drawings import Drawings, DrawnOnce
from graphcam.drafting.ink import Construction
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import UNLIMITED, Paper, Scale, coarsest_scale, standard_scale
from graphcam.given.three_arcs import ThreeArcs

CENTRES_ROOM = complex(40.0, 50.0)
"""What letters, axes and the title need about the cam and its centres [mm of paper]."""


@dataclass(frozen=True)
class ArcBoard:
    """What lies on the board of a cam of three arcs: the task, and the draughtsman's choices.

    dwell : angle [rad] for which the outer circle holds the follower up
    roller_radius : mm
    divisions : equal parts of each arc
    mu_phi : rad/mm
    paper : what the cam may take of the sheet
    extent : how wide + i high the cam and all the centres of its arcs are [mm];  page : what a page has for them
    heights : that the diagrams of a, v and s should keep to [mm of paper]
    omega : of the cam [rad/s], where the task gives a speed
    """

    given: ThreeArcs
    dwell: float
    roller_radius: float
    divisions: int
    mu_phi: Scale
    paper: Paper
    extent: complex = 0j
    page: Paper = UNLIMITED
    heights: Mapping[str, float] = field(default_factory=lambda: DIAGRAM_HEIGHTS)
    omega: float | None = None

    @property
    def mu_l(self) -> Scale:
        """The largest standard scale at which the cam and the roller, and C2 if it is given, fit their paper.

        It is coarser where no page would take a centre that is found far away.
        """
        if (kept := self.paper.kept_scale(ARCS.name)) is not None:
            return kept
        outer = math.hypot(*self.given.D) + 2 * self.roller_radius
        below = outer if self.given.C2 is None else max(outer, math.hypot(*self.given.C2))
        usual = standard_scale(outer + below, min(self.paper.width, self.paper.height), self.paper.ratios)
        return coarsest_scale(usual, self.page.scale(self.extent, CENTRES_ROOM))


@dataclass(frozen=True, eq=False, repr=False)
class ArcChain(Drawings):
    """All constructions of one cam of three arcs by name, in the order in which they are drawn.

    pencil : the hand that draws
    """

    board: ArcBoard
    pencil: Pencil = field(default_factory=Pencil)

    @cached_property
    def stations(self) -> ArcStations:
        """The ends of the parts into which the arcs are divided."""
        return divide_arcs(self.board.divisions)

    @DrawnOnce
    def three_arcs(self) -> Construction:
        """The centres of the arcs and their points of contact."""
        board = self.board
        return three_arcs(board.given, board.dwell, board.mu_l, self.pencil, board.paper)

    @DrawnOnce
    def arc_roller(self) -> Construction:
        """Lift, velocity and acceleration at the stations."""
        drawn = arc_roller(self.three_arcs, self.board.roller_radius, self.stations, self.pencil)
        return replace(drawn, givens=replace(drawn.givens, omega=self.board.omega))

    @DrawnOnce
    def arc_diagrams(self) -> Construction:
        """Lift, velocity, acceleration and pressure angle over the cam angle, and their maxima."""
        return arc_diagrams(self.arc_roller, self.board.mu_phi, self.pencil, self.board.heights)

    @property
    def spans(self) -> tuple[slice, ...]:
        """The slice of each arc among all stations."""
        return self.stations.spans

    def redrawn(self, refine: int = 1, pencil: Pencil | None = None) -> ArcChain:
        """The same cam, every part divided in ``refine``, drawn by another hand; by default one without error."""
        board = replace(self.board, divisions=refine * self.board.divisions)
        return replace(self, board=board, pencil=pencil or Pencil())
