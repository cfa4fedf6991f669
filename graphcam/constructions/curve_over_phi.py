"""The curve of a diagram over the cam angle: piece by piece through its points, and level in the dwells."""

import numpy as np

from graphcam.constructions.axes import BREAK_GAP, station_names
from graphcam.constructions.turn_board import TurnGivens
from graphcam.drafting import euclid
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand
from graphcam.drafting.ink import Caption, Part, Row, say
from graphcam.drafting.marks import Line, Points, Role
from graphcam.drafting.scale import Scale
from graphcam.drafting.telling import FRENCH_CURVE, RULER, stretch_caption
from graphcam.given.motion import FULL_TURN, MovingPhase
from graphcam.plane_vectors import dot
from graphcam.words import sequence

STRAIGHTNESS = 0.05
"""Points that lie so near to a line [mm of paper] are joined with the ruler."""
MIN_DWELL_ANGLE = 1e-9
"""A dwell is longer [rad]."""

_ALL_STRAIGHT = say(
    "From jump to jump of the acceleration the points lie on one line: join them with the ruler, because the "
    "chords are the curve."
)
_ALL_BENT = say("Draw a smooth curve through the points with the French curve, from jump to jump of the acceleration.")
_CURVE_WITH_JUMPS = say(
    "Draw the curve through the points from jump to jump of the acceleration: with the ruler where they lie on one "
    "line, elsewhere with the French curve."
)
_CURVE_WITH_CORNERS = say(
    "Draw the curve through the points from jump to jump and from corner to corner of the acceleration: with the ruler "
    "where they lie on one line, elsewhere with the French curve."
)
CORNER = say("at {first} it has a corner")
CONTINUOUS_TANGENT = say("at {first} the tangent is continuous")
_DWELL_CAPTION = say("In the dwells draw it horizontally with the T-square.")


def curve_over_phi(
    givens: TurnGivens, hand: Hand, name: str, curve: Drawn, met: Caption
) -> tuple[tuple[Line, ...], tuple[Part, ...]]:
    """The lines of the curve of that ``name``, and the parts that draw them: piece by piece, then in the dwells.

    met : what happens at station {first} in a phase, where the acceleration jumps and one piece meets the next
    """
    stations, names = givens.stations, station_names(givens.stations)
    begins = {span.start for span in stations.phases}
    straight, lines, rows = [_on_one_line(curve.shown[piece]) for piece in stations.pieces], list[Line](), list[Row]()
    either, blows = any(straight) and not all(straight), stations.left[stations.blows]
    for piece, by_ruler in zip(stations.pieces, straight, strict=True):
        tool = [RULER if by_ruler else FRENCH_CURVE] if either else []
        # A phase with stations moves.
        phase = givens.motion.phases[int(stations.phase[piece.start])]
        place, law = float(stations.u[piece.start]), phase.normalised if isinstance(phase, MovingPhase) else None
        meeting = met if law and place in law.jumps else CORNER if law and place in law.steady else CONTINUOUS_TANGENT
        if piece.start in blows and np.ptp(curve.shown[piece].imag) < STRAIGHTNESS:
            continue  # what does not jump has no width in a blow
        corner = [] if piece.start in begins else [meeting.with_values(first=names[piece.start])]
        faired = hand.fair(name, curve.first, [piece])
        ends = stretch_caption(names[piece.start], names[piece.stop - 1])
        rows.append(Row(ends, sequence([*tool, *corner], "; ") if tool or corner else "", (faired,)))
        lines.append(faired.line(Role.RESULT))
    told = _ALL_STRAIGHT if all(straight) else _CURVE_WITH_JUMPS if either else _ALL_BENT
    told = _CURVE_WITH_CORNERS if stations.finer else told
    level, resting = _dwell_levels(givens, hand, curve)
    rests = (Part(_DWELL_CAPTION, (level,)),) if resting else ()
    return (*lines, *resting), (Part(told, rows=tuple(rows)), *rests)


def _on_one_line(points: Points) -> bool:
    """Whether points lie so near to the line from the first to the last that the ruler draws them."""
    way = euclid.unit(points[-1:] - points[:1])
    return bool(np.abs(dot(way * UP, points - points[0])).max() < STRAIGHTNESS)


def _dwell_levels(givens: TurnGivens, hand: Hand, curve: Drawn) -> tuple[Drawn, tuple[Line, ...]]:
    """The levels of a curve before the dwells, and its level lines from each to the next phase."""
    stations = givens.stations
    ends = [k for span in stations.phases for k in (span.start, span.stop - 1)]
    level = hand.erect("rests", curve.first[[*ends, -1]], RIGHT)
    *places, last = level.points
    turn = givens.end
    bounds = np.array([last.imag * UP, *places, turn + last.imag * UP]).reshape(-1, 2)
    angles = np.array([0.0, *stations.phi[ends], FULL_TURN]).reshape(-1, 2)
    resting = np.flatnonzero(np.diff(angles)[:, 0] > MIN_DWELL_ANGLE)
    # At the start of the turn the follower rests where it does at its end.
    before = np.arange(-1, len(ends), 2)[resting] % len(level.points)
    lines = zip(bounds[resting], before, strict=True)
    return level[before], tuple(
        Line(stretch, Role.RESULT, False, of=level.act, index=np.array([k, k]))
        for pair, k in lines
        for stretch in _around_breaks(pair, givens.mu_phi)
    )


def _around_breaks(pair: Points, mu_phi: Scale) -> list[Points]:
    """The two stretches of a level line over a broken dwell; one over any other."""
    breaks = [x for x in mu_phi.middles if pair[0].real < x < pair[1].real]
    if not breaks:
        return [pair]
    left, right = (breaks[0] + side * BREAK_GAP + pair[0].imag * UP for side in (-1, 1))
    return [np.array([pair[0], left]), np.array([right, pair[1]])]
