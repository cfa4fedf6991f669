"""The scale of a profile on a worksheet that is photographed: its room there is larger than on other sheets."""

from dataclasses import fields, replace

from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.constructions.views import PROFILE
from graphcam.drafting.scale import standard_scale
from graphcam.sheets.marked_paper import MARKED_PAPERS
from graphcam.tasks.task import DrawingTable

PROFILE_MARGIN = 10.0
"""What the room of a profile has beyond the cam with its roller, mm."""


class MarkedDrawing(DrawingTable):
    """``[drawing]`` of a task whose worksheet is photographed."""

    @staticmethod
    def of(drawing: DrawingTable) -> "MarkedDrawing":
        """The table of a drawing, for a worksheet that is photographed."""
        return MarkedDrawing(**{field.name: getattr(drawing, field.name) for field in fields(drawing)})


def on_marked_paper(board: Board, drawing: MarkedDrawing) -> Board:
    """The board with the largest standard scale at which the cam with its roller finds room for every direction.

    Nothing else stands about it there, as on other sheets the angles of the phases do.

    Raises
    ------
    DesignError : sizes that the task leaves open cannot be found
    """
    chain = Chain(board)
    reach = board.follower.reach(
        chain.prime_radius, chain.place, board.motion, max(chain.roller_radius, 0.0), board.rotation
    )
    scale = standard_scale(2 * reach, MARKED_PAPERS[drawing.format].square - 2 * PROFILE_MARGIN, board.paper.ratios)
    return replace(board, paper=replace(board.paper, held={**board.paper.held, PROFILE.name: scale.per_mm}))
