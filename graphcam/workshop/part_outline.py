"""The outline of the part: the exact profile that can be cut, as a curve that runs once around the bore.

It is followed span by span, each smooth and in the order in which the follower meets it: along the profile of the
exact side, and of an undercut cam around its corners, where the point stays and the normal turns.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Protocol

import numpy as np

from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.mechanism.arc_motion import ArcMotion
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.conjugate_cam import ConjugateCam
from graphcam.mechanism.envelope import GAUSS_NODES, GAUSS_WEIGHTS, Envelope
from graphcam.mechanism.kinematics import Complexes
from graphcam.mechanism.undercut import LostStretch, kept_arcs, lost_parts
from graphcam.plane_vectors import cross
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.words import say

OUTLINE_SAMPLES, MIN_SPAN_SAMPLES = 12_000, 33
"""The number of samples of the whole outline, and the minimum number for each of its spans."""
CUT_SHARE = 1e-9
"""The part of an outline's greatest radius below which a cutter cuts nothing off."""
SPAN_PARTS = 8
"""The number of parts of a span for integration."""


class Span(Protocol):
    """A smooth part of the outline over a parameter, from ``begin`` to ``end`` [rad]."""

    @property
    def begin(self) -> float:
        """The parameter at which the span begins."""
        ...

    @property
    def end(self) -> float:
        """The parameter at which the span ends."""
        ...

    def point(self, at: Floats) -> Complexes:
        """The points (n,) in cam coordinates [mm]."""
        ...

    def velocity(self, at: Floats) -> Complexes:
        """The derivatives (n,) of the points by the parameter [mm/rad]."""
        ...

    def normal(self, at: Floats) -> Complexes:
        """The unit normals (n,), away from the cam."""
        ...


@dataclass(frozen=True, eq=False)
class EnvelopeSpan:
    """A smooth part of a cam's profile, over the cam angle.

    turn : the unit vector by which it is turned about the cam centre
    """

    envelope: Envelope
    piece: int
    begin: float
    end: float
    turn: complex = 1 + 0j

    def point(self, at: Floats) -> Complexes:
        """The points (n,) in cam coordinates [mm]."""
        return self.turn * self.envelope.point(at, np.full(at.shape, self.piece))

    def velocity(self, at: Floats) -> Complexes:
        """The derivatives (n,) of the points by the cam angle [mm/rad]."""
        return self.turn * self.envelope.velocity(at, np.full(at.shape, self.piece))

    def normal(self, at: Floats) -> Complexes:
        """The unit normals (n,), away from the cam."""
        tangent = self.envelope.tangent(at, np.full(at.shape, self.piece))
        return 1j * self.envelope.kinematics.sigma * self.turn * tangent


@dataclass(frozen=True, eq=False)
class ArcSpan:
    """An arc of a cam of circular arcs, over the cam angle at which a knife edge would stand on it."""

    knife_edge: ArcMotion
    start: complex
    begin: float
    end: float

    def point(self, at: Floats) -> Complexes:
        """The points (n,) in cam coordinates [mm]."""
        return self._values(at)[0] * self._direction(at)

    def velocity(self, at: Floats) -> Complexes:
        """The derivatives (n,) of the points by the angle [mm/rad]."""
        radius, slope = self._values(at)
        return (slope - 1j * self.knife_edge.sigma * radius) * self._direction(at)

    def normal(self, at: Floats) -> Complexes:
        """The unit normals (n,), away from the cam."""
        along = self.velocity(at)
        return 1j * self.knife_edge.sigma * along / np.abs(along)

    def _values(self, at: Floats) -> tuple[Floats, Floats]:
        # Within the arc, so that its end is seen from inside.
        middle = (self.begin + self.end) / 2
        s, v, *_ = (np.where(at < middle, *pair) for pair in zip(*self._sides(at), strict=True))
        return self.knife_edge.prime_radius + s, v

    def _sides(self, at: Floats) -> tuple[tuple[Floats, ...], tuple[Floats, ...]]:
        return self.knife_edge(at, side="right"), self.knife_edge(at, side="left")

    def _direction(self, at: Floats) -> Complexes:
        return self.start * np.exp(-1j * self.knife_edge.sigma * at)


@dataclass(frozen=True, eq=False)
class CornerSpan:
    """A corner that an undercut leaves, over the angle by which the normal turns there."""

    at: complex
    first: complex
    sense: int
    end: float
    begin: float = 0.0

    def point(self, at: Floats) -> Complexes:
        """The corner (n,), the same for all parameters [mm]."""
        return np.full(at.shape, self.at)

    def velocity(self, at: Floats) -> Complexes:
        """The derivatives (n,) of the points, which are zero."""
        return np.zeros(at.shape, dtype=np.complex128)

    def normal(self, at: Floats) -> Complexes:
        """The unit normals (n,), from that of the side before to that of the side behind."""
        return self.first * np.exp(1j * self.sense * at)


@dataclass(frozen=True, eq=False)
class Outline:
    """The outline of the part, as spans in order.

    zero : direction of the zero mark in cam coordinates [rad]: that in which the follower meets the cam at cam angle 0
    zero_met : whether the follower does meet it there; an undercut may have lost that place
    sense : in which the outline is followed and its angles are counted, +1 for anticlockwise: against the rotation
    """

    spans: tuple[Span, ...]
    zero: float
    sense: int
    zero_met: bool = True

    def as_seen(self, points: Complexes) -> Complexes:
        """Points or vectors (n,) turned so that the zero mark is at the right and angles are anticlockwise."""
        turned = points * np.exp(-1j * self.zero)
        return turned if self.sense > 0 else np.conj(turned)

    @cached_property
    def sampled(self) -> list[tuple[Floats, Complexes, Complexes]]:
        """Dense parameters, points and normals (n,) of each span, as :meth:`as_seen`."""
        total = math.fsum(span.end - span.begin for span in self.spans)
        samples: list[tuple[Floats, Complexes, Complexes]] = []
        for span in self.spans:
            share = (span.end - span.begin) / total
            at = np.linspace(span.begin, span.end, max(MIN_SPAN_SAMPLES, round(share * OUTLINE_SAMPLES)))
            samples.append((at, self.as_seen(span.point(at)), self.as_seen(span.normal(at))))
        return samples

    @cached_property
    def points(self) -> Complexes:
        """Dense points (n,) on the closed outline, as :meth:`as_seen`, none twice in a row."""
        parts = [points[:-1] for _, points, _ in self.sampled if abs(points[-1] - points[0]) > 0]
        return np.concatenate(parts)

    @property
    def corners(self) -> list[complex]:
        """The corners, as :meth:`as_seen` [mm]."""
        return [complex(self.as_seen(np.array(span.at))) for span in self.spans if isinstance(span, CornerSpan)]

    @cached_property
    def least_radius(self) -> float:
        """The minimum radius of the outline about the axis [mm]."""
        return float(np.abs(self.points).min())

    @cached_property
    def greatest_radius(self) -> float:
        """The maximum radius of the outline about the axis [mm]."""
        return float(np.abs(self.points).max())

    @cached_property
    def area(self) -> float:
        """The area inside the outline [mm^2]."""
        total = 0.0
        for span in self.spans:
            ends = np.linspace(span.begin, span.end, SPAN_PARTS + 1)
            width = np.diff(ends)[:, None]
            at = ((ends[:-1] + ends[1:]) / 2)[:, None] + width * GAUSS_NODES
            swept = cross(span.point(at.ravel()), span.velocity(at.ravel())).reshape(at.shape)
            total += float(np.sum(swept * width * GAUSS_WEIGHTS)) / 2
        return abs(total)

    @cached_property
    def least_hollow(self) -> float:
        """The minimum radius of curvature of the hollows [mm]; infinite if the outline is convex."""
        least = math.inf
        for _, points, normals in self.sampled:
            way = np.abs(np.diff(points))
            turn = np.angle(normals[1:] / normals[:-1])
            hollow = (turn < 0) & (way > 0)
            if hollow.any():
                least = min(least, float((way[hollow] / -turn[hollow]).min()))
        return least

    def check_cutter(self, radius: float) -> None:
        """Refuse a cutter whose radius [mm] is larger than that of a hollow, or which cuts elsewhere at the same time.

        Raises
        ------
        DesignError : the cutter does not reach into a hollow of the profile
        """
        if not math.isfinite(self.least_hollow):
            return  # seen from every place of its way a cutter has only one nearest place of a convex cam
        remedy = say("take a smaller cutter, or leave it out")
        if not radius < self.least_hollow:
            limit = say("less than {least_hollow:.4g} mm, the minimum radius of the profile's hollows")
            limit = limit.with_values(least_hollow=self.least_hollow)
            raise DesignError("part.cutter_radius", radius, limit, remedy)
        from scipy.spatial import KDTree

        centres = np.concatenate([at + radius * normal for _, at, normal in self.sampled])
        around, ways = (np.stack([z.real, z.imag], axis=-1) for z in (self.points, centres))
        nearest, _ = KDTree(around).query(ways)
        cut = radius - float(nearest.min())
        if cut > CUT_SHARE * self.greatest_radius:
            limit = say("small enough for the hollows: it would cut {cut:.2g} mm off the other side", cut=cut)
            raise DesignError("part.cutter_radius", radius, limit, remedy)


@dataclass(frozen=True, eq=False)
class Groove:
    """A groove in the face of a disk, in which a roller runs: between the profile and an outer wall.

    depth : mm;  wall : the outer wall, its angles counted as those of the profile
    """

    depth: float
    wall: Outline

    @property
    def disk_radius(self) -> float:
        """The radius of the disk [mm]: the rim is as thick as the groove is deep, to the next millimetre across."""
        return math.ceil(2 * (self.wall.greatest_radius + self.depth)) / 2


def outline_of(solution: AnySolution) -> Outline:
    """The outline of the cam of a solution.

    Raises
    ------
    DesignError : no profile can be cut
    """
    return _of_arcs(solution) if isinstance(solution, ArcsSolution) else of_cam(solution.cam)


def of_cam(cam: Cam | ConjugateCam, envelope: Envelope | None = None) -> Outline:
    """The outline of a cam, or of the second one of a conjugate pair.

    envelope : that of another wall of the same cam; left out: of its profile

    Raises
    ------
    DesignError : no profile can be cut

    >>> from math import radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> outline = of_cam(gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50))
    >>> round(outline.least_radius, 4), round(outline.greatest_radius, 4), round(outline.area, 1)
    (38.0, 67.6203, 9138.5)
    """
    envelope, sense, turn = envelope or cam.envelope, -cam.sigma, cam.table_turn
    lost = lost_parts(envelope)
    arcs = kept_arcs(envelope, lost)
    spans: list[Span] = []
    for k, (begin, end) in enumerate(arcs):
        cuts = sorted({begin, end, *(x for x in envelope.edges.tolist() if begin < x < end)})
        spans += [EnvelopeSpan(envelope, int(envelope.piece((a + b) / 2)), a, b, turn) for a, b in pairwise(cuts)]
        if k < len(lost):
            spans.append(_corner(envelope, lost[k], sense, turn))
    first = envelope.edges[0] + (-cam.motion.origin - envelope.edges[0]) % FULL_TURN
    met = turn * complex(envelope.point(first, envelope.piece(first)))
    return Outline(tuple(spans), float(np.angle(met)), sense, not any(part.begin < first < part.end for part in lost))


def _corner(envelope: Envelope, lost: LostStretch, sense: int, turned: complex) -> CornerSpan:
    before = complex(envelope.tangent(lost.begin, envelope.piece(lost.begin, "left")))
    behind = complex(envelope.tangent(lost.end, envelope.piece(lost.end)))
    turn = abs(float(np.angle(behind / before)))
    return CornerSpan(turned * lost.at, 1j * envelope.kinematics.sigma * turned * before, sense, turn)


def _of_arcs(solution: ArcsSolution) -> Outline:
    """The outline of a cam of arcs, by a knife edge on it, whose trace point is the point of contact."""
    knife_edge = solution.cam.motion(0.0, solution.motion.dwell)
    a = complex(*solution.cam.A)
    ends = [0.0, *(edge for edge in knife_edge.edges[1:].tolist() if edge < FULL_TURN), FULL_TURN]
    spans = [ArcSpan(knife_edge, a / abs(a), begin, end) for begin, end in pairwise(ends) if end > begin]
    return Outline(tuple(spans), float(np.angle(a)), -knife_edge.sigma)
