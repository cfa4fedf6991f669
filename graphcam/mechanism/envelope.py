"""The working profile as a curve c(phi), which may run backwards where the roller is too large.

It is parallel to the pitch curve at the roller radius r, so c' = p' (1 - r kappa): where the pitch curve is more
sharply bent than the roller, c runs backwards, between two cusps.  At a smooth cusp c' passes through zero.  Where the
acceleration jumps, so does the curvature, and c may turn back from one speed to another: the profile then meets
itself with a common tangent but without slowing down.

The curve is followed once round from a place at which the follower stands lowest.  That place always stays on the
cam: the cam's centre is nowhere nearer to the pitch curve than there, so the roller circle about it touches the
profile and no other roller circle reaches in.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from graphcam.errors import DesignError
from graphcam.given.laws import Floats, Side
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.given.root_finding import roots
from graphcam.mechanism.kinematics import Complexes, Values
from graphcam.mechanism.turn_extremes import Places, highest_places, smooth_pieces, stationary_places, turn_maximum
from graphcam.words import say

Indices = NDArray[np.intp]
CUSP_TOLERANCE = 1e-12
"""A roller that misses the least radius of curvature by no more than this part of it makes one cusp, and no loop."""
JUMP_SHARE = 1e-9
"""A speed that changes at a break by more than this part of the prime radius jumps there."""
SMALL_LOOP_ANGLE = 0.2
"""The cam angle [rad] up to which the way round a loop is integrated; beyond, it is a difference of two points."""
COORDINATE_ROUNDING = 4 * float(np.finfo(np.float64).eps)
"""What a coordinate may be off by, as a part of the point's distance from the cam centre."""
GAUSS_NODES, GAUSS_WEIGHTS = (0.5 * x for x in np.polynomial.legendre.leggauss(16))


@dataclass(frozen=True)
class BackwardStretch:
    """A stretch of the profile that runs backwards.

    begin, end : its cusps [rad];  begin_jumps, end_jumps : whether the speed jumps there rather than pass through zero
    """

    begin: float
    end: float
    begin_jumps: bool
    end_jumps: bool


class _FollowedPath(Protocol):
    """What an envelope needs of the pitch curve, as :class:`~graphcam.mechanism.kinematics.Kinematics` has it."""

    takes_roller: ClassVar[bool]

    @property
    def sigma(self) -> Any: ...
    @property
    def prime_radius(self) -> Any: ...
    def point(self, values: Values) -> Complexes: ...
    def normal(self, values: Values) -> Complexes: ...
    def speed(self, values: Values, inset: float) -> Floats: ...
    def curvature(self, values: Values) -> Floats: ...
    def sharpness(self, values: Values) -> Floats: ...
    def convex_radius(self, values: Values) -> Floats: ...


@dataclass(frozen=True, eq=False)
class Envelope:
    """The profile of a cam over one turn, from the lowest place on.

    Cam angles run from ``edges[0]`` to ``edges[-1]``, a full turn later, and may exceed 2 pi.

    kinematics : of the follower on its cam;  roller_radius : r [mm], 0 for a knife edge or a flat face
    """

    motion: Motion
    kinematics: _FollowedPath
    roller_radius: float

    @cached_property
    def _pieces(self) -> tuple[Indices, Floats, Floats]:
        """Phase, and the fractions of it at both ends, of every smooth piece from the lowest place on."""
        phase, u0, u1 = smooth_pieces(self.motion)
        lowest = int(np.argmin(self.motion.at(phase, u0)[0]))
        return np.roll(phase, -lowest), np.roll(u0, -lowest), np.roll(u1, -lowest)

    @cached_property
    def edges(self) -> Floats:
        """(p + 1,) cam angles at which the p smooth pieces begin, and the last one ends."""
        phase, u0, _ = self._pieces
        phi = self.motion.angle_at(phase, u0)
        phi = np.where(phi < phi[0], phi + FULL_TURN, phi)
        return np.append(phi, phi[0] + FULL_TURN)

    # --- values: all take cam angles and the pieces they belong to, so that a break is seen from a named side ---------

    def piece(self, phi: Floats | float, side: Side = "right") -> Indices:
        """The smooth piece that cam angles belong to; at an edge that of the named side."""
        return np.clip(np.searchsorted(self.edges, phi, side=side) - 1, 0, self.edges.size - 2)

    def values(self, phi: Floats | float, piece: Indices | int) -> Values:
        """(s, v, a, j)."""
        phase, u0, u1 = (part[piece] for part in self._pieces)
        share = (phi - self.edges[piece]) / (self.edges[np.asarray(piece) + 1] - self.edges[piece])
        u = np.clip(u0 + (u1 - u0) * share, u0, u1)
        left, right = (self.motion.at(phase, u, side) for side in ("left", "right"))
        s, v, a, j = (np.where(u < u1, r, x) for r, x in zip(right, left, strict=True))
        return s, v, a, j

    def point(self, phi: Floats | float, piece: Indices | int) -> Complexes:
        """c [mm], x + i y on the cam."""
        values = self.values(phi, piece)
        at = self.kinematics.point(values) - self.roller_radius * self.kinematics.normal(values)
        return at * self._unit_vectors(phi)

    def tangent(self, phi: Floats | float, piece: Indices | int) -> Complexes:
        """The unit tangent, along which the profile runs where it runs forwards."""
        return -1j * self.kinematics.sigma * self.kinematics.normal(self.values(phi, piece)) * self._unit_vectors(phi)

    def velocity(self, phi: Floats | float, piece: Indices | int) -> Complexes:
        """The derivative c' of the centre by the cam angle [mm/rad]."""
        return self.speed(phi, piece) * self.tangent(phi, piece)

    def speed(self, phi: Floats | float, piece: Indices | int) -> Floats:
        """|c'| [mm/rad], negative where the profile runs backwards."""
        return self.kinematics.speed(self.values(phi, piece), self.roller_radius)

    def curvature(self, phi: Floats | float, piece: Indices | int) -> Floats:
        """Curvature kappa of the pitch curve [1/mm]."""
        return self.kinematics.curvature(self.values(phi, piece))

    def support(self, phi: Floats | float, piece: Indices | int) -> Floats:
        """c.n [mm], how far the profile's tangent passes from the cam centre; negative if on the wrong side."""
        values = self.values(phi, piece)
        along_normal = (np.conj(self.kinematics.normal(values)) * self.kinematics.point(values)).real
        return along_normal - self.roller_radius

    def margin(self, phi: Floats | float, piece: Indices | int) -> Floats:
        """(rho - r)/r: by which part the pitch curve's radius of curvature exceeds the roller's, inf in hollows.

        With a flat face it is rho/r0.
        """
        radius = self.kinematics.convex_radius(self.values(phi, piece)) - self.roller_radius
        return radius / (self.roller_radius or self.prime_radius)

    def _unit_vectors(self, phi: Floats | float) -> Complexes:
        return np.exp(-1j * self.kinematics.sigma * np.asarray(phi))

    def way(self, begin: Floats, end: Floats) -> Complexes:
        """c(end) - c(begin) [mm], which keeps its digits however small the loop between: there by integration of c'."""
        there, here = self.point(end, self.piece(end)), self.point(begin, self.piece(begin))
        way = there - here
        small = np.flatnonzero(end - begin <= SMALL_LOOP_ANGLE)
        if small.size:
            inner = self._integrated(begin[small], end[small])
            # Where the difference finds another way, the nodes were too few for what the curve does between them.
            rounding = COORDINATE_ROUNDING * (np.abs(there[small]) + np.abs(here[small]))
            way[small] = np.where(np.abs(inner - way[small]) <= rounding, inner, way[small])
        return way

    def _integrated(self, begin: Floats, end: Floats) -> Complexes:
        """The integrals of c', piece by piece; at least one."""
        first, last = self.piece(begin), self.piece(end, "left")
        count = np.maximum(last - first, 0) + 1
        starts = np.cumsum(count) - count
        loop = np.repeat(np.arange(count.size), count)
        piece = first[loop] + np.arange(loop.size) - starts[loop]
        low, high = np.maximum(self.edges[piece], begin[loop]), np.minimum(self.edges[piece + 1], end[loop])
        width = (high - low)[:, None]
        phi = (low + high)[:, None] / 2 + width * GAUSS_NODES
        velocity = self.velocity(phi, np.repeat(piece[:, None], GAUSS_NODES.size, axis=1))
        return np.add.reduceat(np.sum(velocity * GAUSS_WEIGHTS * width, axis=1), starts)

    @property
    def prime_radius(self) -> float:
        """The prime radius r0 [mm]."""
        return self.kinematics.prime_radius

    @cached_property
    def _places(self) -> Places:
        """The places where the pitch curve's curvature is stationary, and both ends of every piece."""
        return stationary_places(self.motion, lambda places: self.kinematics.sharpness(places.values))

    @property
    def least_radius(self) -> float:
        """The least convex radius of the pitch curve [mm], or the prime radius where that is less."""
        kin = self.kinematics
        sharpest = highest_places(self.motion, kin.sharpness)
        return min(float(kin.convex_radius(sharpest.values).min()), self.prime_radius)

    # --- cusps -------------------------------------------------------------------------------------------------------

    @cached_property
    def _nodes(self) -> tuple[Floats, Indices]:
        """Cam angle and piece of both ends of every piece and of the places of stationary curvature, in order.

        Between neighbours the curvature is monotonous, so there is one cusp at most.
        """
        places = self._places
        phi: list[Floats] = []
        for k, (phase, u0, u1) in enumerate(zip(*self._pieces, strict=True)):
            inner = np.unique(places.u[(places.phase == phase) & (u0 < places.u) & (places.u < u1)])
            share = np.concatenate([[0.0], (inner - u0) / (u1 - u0), [1.0]])
            ends = self.edges[k], self.edges[k + 1]
            phi.append(ends[0] * (1 - share) + ends[1] * share)
        return np.concatenate(phi), np.repeat(np.arange(len(phi)), [part.size for part in phi])

    @cached_property
    def backward_stretches(self) -> list[BackwardStretch]:
        """The stretches that run backwards, in order; not those that are a cusp within tolerance."""
        phi, piece = self._nodes
        behind = self.speed(phi, piece) < 0
        turns = np.flatnonzero(behind[:-1] != behind[1:])
        cusps, jumps = self._cusps(turns), self._jumps(turns)
        margin = self.margin(phi, piece)
        return [
            BackwardStretch(float(cusps[k]), float(cusps[k + 1]), bool(jumps[k]), bool(jumps[k + 1]))
            for k in range(0, turns.size, 2)
            if margin[turns[k] + 1 : turns[k + 1] + 1].min() < -CUSP_TOLERANCE
        ]

    @cached_property
    def touching(self) -> list[float]:
        """The cam angles at which the roller has the curve's own radius, within tolerance: cusps without a loop."""
        phi, piece = self._nodes
        just = phi[np.abs(self.margin(phi, piece)) <= CUSP_TOLERANCE]
        just = just[
            [not any(b.begin - JUMP_SHARE <= x <= b.end + JUMP_SHARE for b in self.backward_stretches) for x in just]
        ]
        apart = np.diff(just, prepend=-np.inf) > JUMP_SHARE
        return [float(x) for x in just[apart]]

    def _cusps(self, before: Indices) -> Floats:
        """The cam angles between a node and the next at which the profile turns back."""
        phi, piece = self._nodes
        cusps, inside = phi[before], piece[before] == piece[before + 1]
        if inside.any():
            low = before[inside]
            cusps[inside] = roots(lambda phi: self.speed(phi, piece[low]), phi[low], phi[low + 1])
        return cusps

    def _jumps(self, before: Indices) -> NDArray[np.bool_]:
        phi, piece = self._nodes
        change = np.abs(self.speed(phi[before + 1], piece[before + 1]) - self.speed(phi[before], piece[before]))
        return (piece[before] != piece[before + 1]) & (change > JUMP_SHARE * self.prime_radius)


def outer_wall(motion: Motion, path: _FollowedPath, roller_radius: float) -> Envelope:
    """The outer wall of a groove for a roller: the pitch curve moved outwards by its radius.

    Raises
    ------
    DesignError : there is no roller, or it does not fit the hollows of its path
    """
    if not roller_radius:
        limit = say("left or right, without a roller")
        raise DesignError("side", "outer", limit, say("a groove guides a roller"))
    hollow = turn_maximum(motion, lambda places: -path.curvature(places.values))
    if hollow.value * roller_radius >= 1:
        limit = say("less than {radius:.4g} mm, the radius of the hollow of its path at {phi:.4g} degrees")
        limit = limit.with_values(radius=1 / hollow.value, phi=math.degrees(hollow.phi))
        raise DesignError(say("roller radius"), roller_radius, limit, say("take a smaller roller"))
    return Envelope(motion, path, -roller_radius)
