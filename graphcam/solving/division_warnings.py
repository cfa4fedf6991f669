"""What is said of divisions that are too coarse for the acceleration, and of what cannot be told on the paper."""

from collections.abc import Iterator, Mapping
from functools import partial

from graphcam.comparison.bounds import DEVIATION_COUNT
from graphcam.comparison.chord_readings import MAX_S_SHARE, MAX_V_SHARE, chord_readings, finer_parts
from graphcam.comparison.quantities import Quantity
from graphcam.constructions.axes import phase_title
from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.constructions.curvature import CurvatureGivens, too_small_on_paper
from graphcam.drafting.ink import Construction
from graphcam.drafting.pencil import Pencil
from graphcam.solving.adopted_sizes import MAX_DIVISIONS
from graphcam.solving.solution_warnings import Caution
from graphcam.words import Caption, Words, and_list, say

TRIED_DIVISIONS = (12, 24, 36, 48, 60, MAX_DIVISIONS)
"""Divisions of all phases, of which the first that reads v and s within what is permitted is named."""


def coarse_divisions(chain: Chain) -> Iterator[Caution]:
    """The sentence on phases that are divided so coarsely that their acceleration is missed or counted whole."""
    board = chain.board
    found = chord_readings(board.motion, board.stations)
    if not (coarse := found.too_coarse):
        return
    said = say(
        "The parts are too long for the acceleration of {phases}: as it is drawn, s is off by {s} of the lift and v "
        "by {v} of its maximum, where {most_s} and {most_v} are permitted, and what follows is as wrong. {remedy}"
    )
    shares = {"s": found.s.max(), "v": found.v.max(), "most_s": MAX_S_SHARE, "most_v": MAX_V_SHARE}
    values: dict[str, Words] = {name: say("{share:.3g} %", share=100 * share) for name, share in shares.items()}
    phases = and_list([phase_title(board.motion, k) for k in coarse])
    yield Caution(said.with_values(phases=phases, remedy=_remedy(board), **values), "divisions")


def _remedy(board: Board) -> Caption:
    """Divisions with which the readings are within what is permitted."""
    tried = (n for n in TRIED_DIVISIONS if not chord_readings(board.motion, board.divided(n, {})).too_coarse)
    enough, left_out = next(tried, None), partial(board.divided, TRIED_DIVISIONS[0])
    finer = {} if board.finer else finer_parts(board.motion, TRIED_DIVISIONS[0], left_out)
    if finer and not chord_readings(board.motion, left_out(finer)).too_coarse:
        said = say("Leave the number of parts open.")
        if enough is not None:
            said = say("Divide each phase into {n} parts, or leave their number open.", n=enough)
        return said
    if enough is None:
        return say("No number of parts that is drawn by hand suffices: let the acceleration last longer.")
    return say("Divide each phase into {n} parts.", n=enough)


def unreadable_bend(drawn: Mapping[str, Construction]) -> list[Caption]:
    """The sentence on a radius of curvature that three points cannot tell at the scale of the profile."""
    curved = drawn["curvature"]
    return too_small_on_paper(curved) if isinstance(curved.givens, CurvatureGivens) else []


def disagreement(quantities: Mapping[str, Quantity], pencil: Pencil) -> list[Caption]:
    """The sentence on the drawn values that differ from the exact ones by more than their bounds; none without them."""
    if not (beyond := [q.title for q in quantities.values() if q.is_beyond_bound]):
        return []
    outside = and_list(beyond)
    if pencil.perfect:
        return [say("Outside the bound: {names}; draw such a value with more parts.", names=outside)]
    said = say(
        "Outside the bound: {names}; this is the scatter of the drawing errors, which seldom exceeds "
        "{deviations:g} standard deviations."
    )
    return [said.with_values(names=outside, deviations=DEVIATION_COUNT)]
