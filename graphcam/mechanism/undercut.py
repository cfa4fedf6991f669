"""Undercut: where a roller is too large for its cam, what is lost of the profile, and what can be cut.

The pitch curve itself never crosses itself: the distance from the cam centre tells s, and s the place in the frame, so
two points at the same distance are apart by their cam angles.  A cutter that follows it leaves standing what no roller
circle covers, and of that the part about the cam centre.  Its edge is made of arcs of the profile that run forwards, in
the order of the cam angle; where it passes from one arc to a later one the profile crosses itself, and the cam has a
corner.  So the edge is found by following the profile from the lowest place, which always stays, and turning into the
other branch at every crossing on the way.

Beside a pair of cusps the profile crosses itself close by.  A crossing is the place where the way from one branch to
the other vanishes; as the mean of c' over the loop that way keeps its digits for the smallest of loops.  Seed: of
two smooth cusps at m -+ t the crossing lies near m -+ sqrt(3) t.  Crossings of branches that are far apart are seeded
by those of a polygon through points of the profile.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import wrap
from graphcam.mechanism.envelope import Envelope, Indices
from graphcam.mechanism.kinematics import Complexes
from graphcam.plane_vectors import cross
from graphcam.words import say

NEWTON_STEPS = 40
CROSSING_TOLERANCE = 1e-12
"""How far the two branches may be apart at their crossing, as part of the prime radius."""
SETTLED_STEP = 0.01
"""Greatest last step of a crossing's cam angles, as part of their difference: rounding leaves so much in tiny loops."""
BLOW_ANGLE = 1e-6
"""A piece of the motion over less of the cam angle [rad] is a blow."""
MIN_LOOP_ANGLE = 1e-6
"""A curve without cusps needs more than this angle [rad] to come back to itself."""
PROFILE_SAMPLES = 1500
"""About how many samples of the whole profile, shared by its pieces, the search for crossings begins with."""
MIN_PIECE_SAMPLES, MAX_PIECE_SAMPLES = 9, 65


class Crossing(NamedTuple):
    """The corner (x, y) [mm] that an undercut leaves, and the cam angles [rad] on the two branches that meet there."""

    phi1: float
    phi2: float
    x: float
    y: float


@dataclass(frozen=True)
class Undercut:
    """A part of the profile that is lost, from one side of a corner of the cam to the other.

    cusps : the cam angles [rad] of the cusps in it, in order: two, or more where loops have swallowed each other, or
        none where two flanks cross.  Two equal ones are a single cusp without a loop
    crossing : the corner; what lies from its phi1 on to its phi2 is lost
    """

    cusps: tuple[float, ...]
    crossing: Crossing

    @property
    def is_cusp(self) -> bool:
        """Whether this is a cusp within tolerance: nothing is lost, but the cam has an edge."""
        return self.crossing[0] == self.crossing[1]


@dataclass(frozen=True, eq=False)
class CutProfile:
    """The closed profile that can be cut, as points in order.

    phi : (n,) cam angles [rad] in [0, 2 pi), of a corner that of the branch that begins there
    points : (n, 2) [mm]
    corner : (n,) whether the point is a corner
    """

    phi: Floats
    points: Floats
    corner: NDArray[np.bool_]


@dataclass(frozen=True)
class LostStretch:
    """What lies between the cam angles begin and end, unwrapped, and where the two branches cross, x + i y."""

    begin: float
    end: float
    at: complex


def undercuts(envelope: Envelope) -> list[Undercut]:
    """The parts of the profile that are lost, in order of the cam angle from the lowest place on; none if it is sound.

    Raises
    ------
    DesignError : the loops cannot be told apart
    """
    lost = lost_parts(envelope)
    cusps = [phi for part in envelope.backward_stretches for phi in (part.begin, part.end)]
    found = [(part, [phi for phi in cusps if part.begin <= phi <= part.end]) for part in lost]
    for phi in envelope.touching:
        if not any(part.begin < phi < part.end for part in lost):
            at = complex(envelope.point(phi, envelope.piece(phi)))
            found.append((LostStretch(phi, phi, at), [phi, phi]))
    return [
        Undercut(
            tuple(map(_wrapped, inside)), Crossing(_wrapped(part.begin), _wrapped(part.end), part.at.real, part.at.imag)
        )
        for part, inside in sorted(found, key=lambda item: item[0].begin)
    ]


def trimmed_profile(envelope: Envelope, n: int) -> CutProfile:
    """The profile that can be cut, as n points: the corners, and between them about equal steps of the cam angle.

    The first point is the lowest place, the start of a lift or of the rest before it.

    Raises
    ------
    DesignError : there are too few points for the corners, or as for :func:`undercuts`
    """
    lost = lost_parts(envelope)
    arcs = kept_arcs(envelope, lost)
    least = len(arcs) + 2
    if n < least:
        raise DesignError(say("number of points"), n, say("{least} or more for this profile", least=least))
    # One point where each arc begins, the others shared out by the arcs' angles.
    knots, turned = _turning(envelope)
    bounds = np.array(arcs) if turned is knots else np.interp(np.array(arcs), knots, turned)
    shares = np.cumsum([0.0, *(end - begin for begin, end in bounds)])
    counts = 1 + np.diff(np.round(shares / shares[-1] * (n - len(arcs))).astype(int))
    steps = [np.linspace(a, b, count, endpoint=False) for (a, b), count in zip(bounds, counts, strict=True)]
    phi = np.concatenate(steps)
    phi = phi if turned is knots else np.interp(phi, turned, knots)
    points = envelope.point(phi, envelope.piece(phi))
    corner = np.zeros(n, dtype=bool)
    corner[np.cumsum(counts)[:-1]] = True
    points[corner] = [part.at for part in lost]
    return CutProfile(wrap(phi), np.stack([points.real, points.imag], axis=-1), corner)


def _turning(envelope: Envelope) -> tuple[Floats, Floats]:
    """Cam angles, and what they come to where a blow, in which the profile turns at one place, counts by its turn."""
    edges = envelope.edges
    width, piece = np.diff(edges), np.arange(edges.size - 1)
    if np.all(width >= BLOW_ANGLE):
        return edges, edges
    turn = np.angle(envelope.tangent(edges[1:], piece) * np.conj(envelope.tangent(edges[:-1], piece)))
    return edges, edges[0] + np.append(0.0, np.cumsum(np.where(width < BLOW_ANGLE, np.abs(turn), width)))


def kept_arcs(envelope: Envelope, lost: list[LostStretch]) -> list[tuple[float, float]]:
    """The cam angles, unwrapped, at which each arc that stays begins and ends."""
    ends = [envelope.edges[0], *(phi for part in lost for phi in (part.begin, part.end)), envelope.edges[-1]]
    return [(float(begin), float(end)) for begin, end in zip(ends[::2], ends[1::2], strict=True)]


def lost_parts(envelope: Envelope) -> list[LostStretch]:
    """The parts of the profile that are lost, in order.

    Raises
    ------
    DesignError : the loops cannot be told apart
    """
    phi, piece, arc = _samples(envelope)
    if not envelope.backward_stretches and np.all(envelope.support(phi, piece) > 0):
        return []  # seen from the centre the profile never turns back, so it cannot meet itself
    arcs = _forward_arcs(envelope)
    i, j = _sides_that_cross(envelope.point(phi, piece), arc)
    middles = (phi[:-1] + phi[1:]) / 2
    # The two arcs that each backward stretch leads from and to may meet, and those that cross as polygons.
    seeds = np.vstack([_seeds(envelope), np.stack([middles[i], middles[j]], axis=1)])
    first, second = np.append(np.arange(len(arcs) - 1), arc[i]), np.append(np.arange(1, len(arcs)), arc[j])
    begin, end, at = _crossings(envelope, seeds, arcs[first], arcs[second])
    found = np.flatnonzero(end - begin > np.where(first == second, MIN_LOOP_ANGLE, 0))  # not the NaN of those missed
    lost: list[LostStretch] = []
    for k in found[np.argsort(begin[found], kind="stable")].tolist():
        if begin[k] >= (lost[-1].end if lost else envelope.edges[0]):
            lost.append(LostStretch(float(begin[k]), float(end[k]), complex(at[k])))
    if not all(any(part.begin <= b.begin and b.end <= part.end for part in lost) for b in envelope.backward_stretches):
        smaller = say("take a roller well below {least_radius:g} mm", least_radius=envelope.least_radius)
        remedy = smaller if envelope.kinematics.takes_roller else say("enlarge the prime radius")
        raise DesignError("undercut", say("made of loops that cannot be told apart"), say("of separate loops"), remedy)
    return lost


# --- crossings -------------------------------------------------------------------------------------------------------


def _forward_arcs(envelope: Envelope) -> Floats:
    """(m, 2) where the arcs that run forwards begin and end."""
    turns = [phi for part in envelope.backward_stretches for phi in (part.begin, part.end)]
    return np.array([envelope.edges[0], *turns, envelope.edges[-1]]).reshape(-1, 2)


def _seeds(envelope: Envelope) -> Floats:
    """(m, 2) where the branches beside each backward stretch make up for the way back.

    By the first terms of the speed about the cusps.
    """
    cusps = np.array([(part.begin, part.end) for part in envelope.backward_stretches]).reshape(-1, 2)
    jumps = np.array([(part.begin_jumps, part.end_jumps) for part in envelope.backward_stretches]).reshape(-1, 2) != 0
    begin, end = cusps.T
    before, after = envelope.piece(begin, "left"), envelope.piece(end, "right")
    speed = np.stack([envelope.speed(begin, before), envelope.speed(end, after)], axis=1)
    way = np.where(jumps.all(axis=1), 0.5, 0.75) * np.abs(envelope.way(begin, end))
    reach = np.where(jumps.any(axis=1), 0.5, (math.sqrt(3) - 1) / 2) * (end - begin)
    from_cusp = np.repeat(reach[:, None], 2, axis=1)
    np.divide(way[:, None], speed, out=from_cusp, where=jumps)
    return cusps + from_cusp * [-1, 1]


def _crossings(envelope: Envelope, seeds: Floats, first: Floats, second: Floats) -> tuple[Floats, Floats, Complexes]:
    """Where arcs ``first`` and ``second`` cross, (n, 2) each: cam angles of both and point; NaN where there is none.

    By Newton's method, of all at once.
    """
    phi1, phi2 = (np.clip(phi, *arc.T) for phi, arc in zip(seeds.T, (first, second), strict=True))
    last, settled = np.full(phi1.shape, np.inf), np.zeros(phi1.shape, dtype=bool)
    going = np.arange(phi1.size)
    for _ in range(NEWTON_STEPS):
        if not going.size:
            break
        old1, old2 = phi1[going], phi2[going]
        gap = envelope.way(old1, old2)
        v1 = envelope.velocity(old1, envelope.piece(old1, "left"))
        v2 = envelope.velocity(old2, envelope.piece(old2, "right"))
        across = cross(v1, v2)
        across[across == 0] = np.nan  # parallel branches have no next place
        new1 = _bounded_angles(old1, old1 + cross(gap, v2) / across, first[going])
        new2 = _bounded_angles(old2, old2 + cross(gap, v1) / across, second[going])
        moved = np.abs(new1 - old1) + np.abs(new2 - old2)
        phi1[going], phi2[going] = new1, new2
        settled[going] = moved <= SETTLED_STEP * (new2 - new1)
        rounding = settled[going] & (moved >= last[going] / 2)  # what is left is rounding
        last[going] = moved
        going = going[~rounding & np.isfinite(moved)]
    at = (envelope.point(phi1, envelope.piece(phi1, "left")) + envelope.point(phi2, envelope.piece(phi2))) / 2
    met = settled & (np.abs(envelope.way(phi1, phi2)) <= CROSSING_TOLERANCE * envelope.prime_radius)
    return np.where(met, phi1, np.nan), np.where(met, phi2, np.nan), at


def _bounded_angles(old: Floats, new: Floats, bounds: Floats) -> Floats:
    """The new angles, or, where they lie beyond a bound, the middle between the old one and the bound."""
    low, high = bounds.T
    return np.where(new < low, (old + low) / 2, np.where(new > high, (old + high) / 2, new))


def _samples(envelope: Envelope) -> tuple[Floats, Indices, Indices]:
    """Samples of the forward arcs: cam angle, piece, and number of the arc."""
    count = min(max(PROFILE_SAMPLES // (envelope.edges.size - 1), MIN_PIECE_SAMPLES), MAX_PIECE_SAMPLES)
    # Densely at the ends, which may be cusps.
    share = np.sin(np.linspace(0, np.pi / 2, count)) ** 2
    parts: list[tuple[Floats, int]] = []
    for k, (begin, end) in enumerate(_forward_arcs(envelope).tolist()):
        inner = envelope.edges[(begin < envelope.edges) & (envelope.edges < end)]
        ends = np.concatenate([[begin], inner, [end]])
        phi = (ends[:-1, None] * (1 - share) + ends[1:, None] * share).ravel()
        parts.append((np.unique(phi), k))
    phi = np.concatenate([part for part, _ in parts])
    return phi, envelope.piece(phi), np.repeat([k for _, k in parts], [part.size for part, _ in parts])


def _sides_that_cross(points: Complexes, arc: Indices) -> tuple[Indices, Indices]:
    """Which sides i < j of polygons cross each other; side i leads from point i to the next of the same arc.

    Only sides whose boxes overlap are looked at.  In the order of their left edges the sides that begin before one ends
    follow it, and on a cam they are few.
    """
    side = np.flatnonzero(arc[1:] == arc[:-1])
    side = side[np.argsort(np.minimum(points.real[side], points.real[side + 1]), kind="stable")]
    (left, bottom), (right, top) = (
        (extreme(points.real[side], points.real[side + 1]), extreme(points.imag[side], points.imag[side + 1]))
        for extreme in (np.minimum, np.maximum)
    )
    count = np.searchsorted(left, right, side="right") - np.arange(1, side.size + 1)
    one = np.repeat(np.arange(side.size), count)
    other = one + 1 + np.arange(one.size) - np.repeat(np.cumsum(count) - count, count)
    over = (bottom[one] <= top[other]) & (bottom[other] <= top[one])
    i, j = np.sort([side[one[over]], side[other[over]]], axis=0)
    crossing = (j - i >= 2) & _ends_on_both_sides(points, i, j) & _ends_on_both_sides(points, j, i)
    return i[crossing], j[crossing]


def _ends_on_both_sides(points: Complexes, i: Indices, j: Indices) -> NDArray[np.bool_]:
    side = points[i + 1] - points[i]
    return (cross(side, points[j] - points[i]) >= 0) != (cross(side, points[j + 1] - points[i]) >= 0)


def _wrapped(phi: float) -> float:
    return float(wrap(phi))
