"""Where the profile is how smooth: its stretches of continuous curvature, and what lies between them.

The curvature jumps where the acceleration does; the profile has a corner where an undercut has left one, or a cusp.
"""

from itertools import pairwise

from graphcam.mechanism.envelope import Envelope
from graphcam.mechanism.undercut import Lost, kept_arcs

SAME_CURVATURE = 1e-9
"""A curvature that changes at a break by more than this part of 1/r0 jumps there."""
Span = tuple[float, float, int]
"""Cam angles between which the profile has all derivatives, and its piece."""


def stretches(envelope: Envelope, lost: list[Lost]) -> tuple[list[list[Span]], list[bool]]:
    """Stretches of continuous curvature, in order, and whether the tangent is continuous at the end of each.

    No joints and one stretch if the curvature is continuous all around.
    """
    spans, joints = _spans(envelope, lost)
    ends = [k for k, joint in enumerate(joints) if joint is not None]
    if not ends:
        return [spans], []
    # Begun behind a joint, so that the curve has its ends at one.
    first = ends[-1] + 1
    spans, joints = spans[first:] + spans[:first], joints[first:] + joints[:first]
    found: list[list[Span]] = [[]]
    for span, joint in zip(spans, joints, strict=True):
        found[-1].append(span)
        if joint is not None:
            found.append([])
    return found[:-1], [joint for joint in joints if joint is not None]


def _spans(envelope: Envelope, lost: list[Lost]) -> tuple[list[Span], list[bool | None]]:
    """The spans in order; at the end of each True for a jump of the curvature, False for a corner, else None."""
    corners = envelope.touching
    spans: list[Span] = []
    joints: list[bool | None] = []
    for begin, end in kept_arcs(envelope, lost):
        cuts = sorted({begin, end, *(x for x in (*envelope.edges.tolist(), *corners) if begin < x < end)})
        spans += [(low, high, int(envelope.piece((low + high) / 2))) for low, high in pairwise(cuts)]
        joints += [False if cut in corners else None for cut in cuts[1:-1]] + [False]
    joints[-1] = None  # the turn is closed without a corner, in the lowest place
    following = [*spans[1:], spans[0]]
    for k, (here, there) in enumerate(zip(spans, following, strict=True)):
        if joints[k] is None and _jumps(envelope, here, there):
            joints[k] = True
    return spans, joints


def _jumps(envelope: Envelope, here: Span, there: Span) -> bool:
    before, after = (float(envelope.curvature(phi, piece)) for phi, piece in ((here[1], here[2]), (there[0], there[2])))
    return abs(after - before) > SAME_CURVATURE / envelope.prime_radius
