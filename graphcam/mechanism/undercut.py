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

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import wrap
from graphcam.mechanism.envelope import Backward, Envelope, Indices
from graphcam.mechanism.kinematics import Complexes
from graphcam.plane import cross

NEWTON_STEPS = 40
CLOSED = 1e-12
"""How far the two branches may be apart at their crossing, as part of the prime radius."""
SETTLED = 0.01
"""Greatest last step of a crossing's cam angles, as part of their difference: rounding leaves so much in tiny loops."""
SHORTEST_LOOP = 1e-6
"""A curve without cusps needs more than this angle [rad] to come back to itself."""
MOST_SAMPLES = 1500
"""On the whole profile, shared by its pieces."""
FEWEST_PER_PIECE, MOST_PER_PIECE = 9, 65


@dataclass(frozen=True)
class Undercut:
    """A part of the profile that is lost, from one side of a corner of the cam to the other.

    cusps : the cam angles [rad] of the cusps in it, in order: two, or more where loops have swallowed each other, or
        none where two flanks cross.  Two equal ones are a single cusp without a loop
    crossing : (phi1, phi2, x, y), the cam angles [rad] on the two branches and the corner [mm]; what lies from phi1 on
        to phi2 is lost
    """

    cusps: tuple[float, ...]
    crossing: tuple[float, float, float, float]

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
class Lost:
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
    cusps = [phi for part in envelope.backward for phi in (part.begin, part.end)]
    found = [(part, [phi for phi in cusps if part.begin <= phi <= part.end]) for part in lost]
    for phi in envelope.touching:
        if not any(part.begin < phi < part.end for part in lost):
            at = complex(envelope.point(phi, envelope.piece(phi)))
            found.append((Lost(phi, phi, at), [phi, phi]))
    return [
        Undercut(tuple(map(_wrapped, inside)), (_wrapped(part.begin), _wrapped(part.end), part.at.real, part.at.imag))
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
        raise DesignError("number of points", n, f"{least} or more for this profile")
    # One point where each arc begins, the others shared out by the arcs' angles.
    shares = np.cumsum([0.0, *(end - begin for begin, end in arcs)])
    counts = 1 + np.diff(np.round(shares / shares[-1] * (n - len(arcs))).astype(int))
    phi = np.concatenate([np.linspace(*arc, count, endpoint=False) for arc, count in zip(arcs, counts, strict=True)])
    points = envelope.point(phi, envelope.piece(phi))
    corner = np.zeros(n, dtype=bool)
    corner[np.cumsum(counts)[:-1]] = True
    points[corner] = [part.at for part in lost]
    return CutProfile(wrap(phi), np.stack([points.real, points.imag], axis=-1), corner)


def kept_arcs(envelope: Envelope, lost: list[Lost]) -> list[tuple[float, float]]:
    """The cam angles, unwrapped, at which each arc that stays begins and ends."""
    ends = [envelope.edges[0], *(phi for part in lost for phi in (part.begin, part.end)), envelope.edges[-1]]
    return [(float(begin), float(end)) for begin, end in zip(ends[::2], ends[1::2], strict=True)]


def lost_parts(envelope: Envelope) -> list[Lost]:
    """The parts of the profile that are lost, in order.

    Raises
    ------
    DesignError : the loops cannot be told apart
    """
    phi, piece, arc = _samples(envelope)
    if not envelope.backward and np.all(envelope.support(phi, piece) > 0):
        return []  # seen from the centre the profile never turns back, so it cannot meet itself
    # The two arcs that each backward stretch leads from and to may meet.
    ways = zip(envelope.backward, pairwise(_forward(envelope)), strict=True)
    beside = (_crossing(envelope, _seed(envelope, part), before, after) for part, (before, after) in ways)
    crossings = [*filter(None, beside), *_far_apart(envelope, phi, piece, arc)]
    lost: list[Lost] = []
    here = envelope.edges[0]
    for crossing in sorted(crossings, key=lambda crossing: crossing.begin):
        if crossing.begin >= here:
            lost.append(crossing)
            here = crossing.end
    if not all(any(part.begin <= b.begin and b.end <= part.end for part in lost) for b in envelope.backward):
        smaller = f"take a roller well below {envelope.least_radius:g} mm"
        remedy = smaller if envelope.kinematics.takes_roller else "enlarge the prime radius"
        raise DesignError("undercut", "made of loops that cannot be told apart", "of separate loops", remedy)
    return lost


# --- crossings -------------------------------------------------------------------------------------------------------


def _forward(envelope: Envelope) -> list[tuple[float, float]]:
    """Where the arcs that run forwards begin and end."""
    turns = [phi for part in envelope.backward for phi in (part.begin, part.end)]
    ends = [float(envelope.edges[0]), *turns, float(envelope.edges[-1])]
    return list(zip(ends[::2], ends[1::2], strict=True))


def _seed(envelope: Envelope, part: Backward) -> tuple[float, float]:
    """Where the two branches make up for the way back, by the first terms of the speed about the cusps."""
    begin, end, length = part.begin, part.end, part.end - part.begin
    back = abs(envelope.way(begin, end))
    speed_before = float(envelope.speed(begin, envelope.piece(begin, "left")))
    speed_after = float(envelope.speed(end, envelope.piece(end, "right")))
    if part.begin_jumps and part.end_jumps:
        return begin - back / 2 / speed_before, end + back / 2 / speed_after
    if part.begin_jumps:
        return begin - 0.75 * back / speed_before, end + length / 2
    if part.end_jumps:
        return begin - length / 2, end + 0.75 * back / speed_after
    reach = (math.sqrt(3) - 1) / 2 * length
    return begin - reach, end + reach


def _far_apart(envelope: Envelope, phi: Floats, piece: Indices, arc: Indices) -> Iterator[Lost]:
    """The crossings of forward arcs that the polygon through their samples shows."""
    arcs = _forward(envelope)
    for i, j in _polygon_crossings(envelope.point(phi, piece), arc):
        first, second = arcs[arc[i]], arcs[arc[j]]
        middles = float(phi[i] + phi[i + 1]) / 2, float(phi[j] + phi[j + 1]) / 2
        found = _crossing(envelope, middles, first, second)
        if found and found.end - found.begin > (SHORTEST_LOOP if arc[i] == arc[j] else 0):
            yield found


def _crossing(
    envelope: Envelope, seed: tuple[float, float], first: tuple[float, float], second: tuple[float, float]
) -> Lost | None:
    """Where the arcs ``first`` and ``second`` (their cam angles) cross, by Newton's method; None if it finds none."""
    phi1, phi2 = (min(max(phi, low), high) for phi, (low, high) in zip(seed, (first, second), strict=True))
    last, settled = math.inf, False
    for _ in range(NEWTON_STEPS):
        gap = envelope.way(phi1, phi2)
        v1 = complex(envelope.velocity(phi1, envelope.piece(phi1, "left")))
        v2 = complex(envelope.velocity(phi2, envelope.piece(phi2, "right")))
        across = float(cross(v1, v2))
        if across == 0:
            return None
        new1 = _within(phi1, phi1 + float(cross(gap, v2)) / across, first)
        new2 = _within(phi2, phi2 + float(cross(gap, v1)) / across, second)
        moved = abs(new1 - phi1) + abs(new2 - phi2)
        phi1, phi2 = new1, new2
        settled = moved <= SETTLED * (phi2 - phi1)
        if settled and moved >= last / 2:
            break  # what is left is rounding
        last = moved
    if not settled or abs(envelope.way(phi1, phi2)) > CLOSED * envelope.prime_radius:
        return None
    at = (envelope.point(phi1, envelope.piece(phi1, "left")) + envelope.point(phi2, envelope.piece(phi2))) / 2
    return Lost(phi1, phi2, complex(at))


def _within(old: float, new: float, bounds: tuple[float, float]) -> float:
    """The new angle, or, where it lies beyond a bound, the middle between the old one and the bound."""
    low, high = bounds
    return (old + low) / 2 if new < low else (old + high) / 2 if new > high else new


def _samples(envelope: Envelope) -> tuple[Floats, Indices, Indices]:
    """Samples of the forward arcs: cam angle, piece, and number of the arc."""
    count = min(max(MOST_SAMPLES // (envelope.edges.size - 1), FEWEST_PER_PIECE), MOST_PER_PIECE)
    # Densely at the ends, which may be cusps.
    share = np.sin(np.linspace(0, np.pi / 2, count)) ** 2
    parts: list[tuple[Floats, int]] = []
    for k, (begin, end) in enumerate(_forward(envelope)):
        inner = envelope.edges[(begin < envelope.edges) & (envelope.edges < end)]
        ends = np.concatenate([[begin], inner, [end]])
        phi = (ends[:-1, None] * (1 - share) + ends[1:, None] * share).ravel()
        parts.append((np.unique(phi), k))
    phi = np.concatenate([part for part, _ in parts])
    return phi, envelope.piece(phi), np.repeat([k for _, k in parts], [part.size for part, _ in parts])


def _polygon_crossings(points: Complexes, arc: Indices) -> list[tuple[int, int]]:
    """Which sides i < j of polygons cross each other; side i leads from point i to the next of the same arc."""
    sides = points[1:] - points[:-1]
    left = (np.conj(sides)[:, None] * (points - points[:-1, None])).imag >= 0
    parted = left[:, :-1] != left[:, 1:]  # whether the ends of the second side lie on both sides of the first
    same = arc[1:] == arc[:-1]
    i, j = np.nonzero(np.triu(parted & parted.T & same & same[:, None], k=2))
    return list(zip(i.tolist(), j.tolist(), strict=True))


def _wrapped(phi: float) -> float:
    return float(wrap(phi))
