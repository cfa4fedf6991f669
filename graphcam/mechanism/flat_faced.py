"""The flat-faced follower: the profile is the envelope of the face, which moves along its own normal.

Source: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapter 4.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal, Self

import numpy as np

from graphcam.errors import check_number
from graphcam.given.follower import FlatFaced, Limits, Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.mechanism.kinematics import Appearance, Complexes, Contour, Kinematics, Pair, Values
from graphcam.mechanism.turn_extremes import highest_places, velocity_range
from graphcam.words import say


@dataclass(frozen=True, eq=False)
class FlatFacedKinematics(Kinematics):
    """The face touches the cam at sigma v + i (r0 + s), where the profile has the radius rho = r0 + s + a.

    rho is signed.  A face cannot reach into a hollow: the profile is never concave.  Where rho is negative the envelope
    runs backwards between two cusps (rho = 0) and cannot be cut, and kappa = 1/rho is negative there.
    """

    takes_roller = False
    has_pressure_angle = False

    @classmethod
    def of(cls, sizes: FlatFaced, prime_radius: Any, sigma: Any, lift: Any) -> Self:
        """The kinematics of a flat-faced follower, which has no sizes."""
        return cls(sigma, prime_radius)

    def check(self) -> None:
        """Any prime radius will do."""

    def path(self, values: Values) -> tuple[Pair, Pair, Floats]:
        """The point where the face touches the profile [mm], the normal of the face, the profile's curvature [1/mm]."""
        s, v, _, _ = values
        return (self.sigma * v, self.prime_radius + s), (0.0, 1.0), self.curvature(values)

    def normal(self, values: Values) -> Complexes:
        """The normal of the face."""
        return 1j * _ones_like(values)

    def pressure(self, values: Values) -> tuple[Pair, Pair]:
        """1 and 0: the face is perpendicular to the motion, and the pressure angle is zero."""
        one = _ones_like(values)
        return (one, 0 * one), (0.0, 0.0)

    def steepness(self, values: Values) -> Floats:
        """The tangent of the pressure angle: 0 under a face."""
        return 0 * values[0]

    def sliding(self, values: Values, roller: float) -> tuple[Floats, Floats]:
        """r0 + s: the cam slides along the face."""
        s, v, _, _ = values
        return self.prime_radius + s, v

    def tipping(self, values: Values, friction: float, roller: float) -> Floats:
        """-v: the contact wanders from the middle of the face."""
        return -values[1]

    def speed(self, values: Values, inset: float) -> Floats:
        """rho - inset [mm/rad]: the face turns with the cam."""
        return self.convex_radius(values) - inset

    def curvature(self, values: Values) -> Floats:
        """1/rho [1/mm]; infinite at a cusp."""
        rho = self.convex_radius(values)
        return np.divide(1.0, rho, out=np.full_like(rho, np.inf), where=rho != 0)

    def sharpness_and_slope(self, values: Values) -> tuple[Floats, Floats]:
        """-rho, and its derivative."""
        _, v, _, j = values
        return self.sharpness(values), -(v + j)

    def sharpness(self, values: Values) -> Floats:
        """The measure of sharpness: -rho [mm]."""
        return -self.convex_radius(values)

    def convex_radius(self, values: Values) -> Floats:
        """rho [mm]: 0 at a cusp, negative where the envelope runs backwards."""
        s, _, a, _ = values
        return self.prime_radius + s + a

    def relative_radius(self, values: Values, roller: Any) -> Floats:
        """rho: a face is not curved."""
        return self.convex_radius(values)

    def lift_per_error(self, values: Values) -> dict[str, Any]:
        """1 by the profile: the face is square to its motion."""
        return {"profile": 1.0 + 0.0 * values[0]}

    def gap(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any]:
        """How far the normal leans from that of the face."""
        along = -1j * self.sigma * contour.turning * contour.normal
        return contour.normal.real, along.real

    def motion_on_contour(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any, Any]:
        """The place is sigma v + i (r0 + s), the radius of curvature r0 + s + a."""
        height = contour.point.imag
        return height - self.prime_radius, self.sigma * contour.point.real, 1 / contour.curvature - height

    def angle_by_sizes(self, values: Values) -> dict[str, Floats]:
        """The derivatives of the pressure angle by the sizes: all 0."""
        still = 0 * values[0]
        return {"prime_radius": still, "lift": still}

    def radius_by_sizes(self, values: Values) -> dict[str, Floats]:
        """The derivatives of rho = r0 + s + a by the sizes."""
        s, _, a, _ = values
        return {"prime_radius": _ones_like(values), "lift": s + a}

    @staticmethod
    def radius_of(sharpness: Floats) -> Floats:
        """The radius of curvature rho [mm] of a sharpness."""
        return -sharpness

    def face_ends(self, motion: Motion) -> Mapping[str, float]:
        """How far the contact wanders to the left and to the right of the axis."""
        width = face_width(motion, "ccw" if self.sigma > 0 else "cw")
        return {"face_left": width.left, "face_right": width.right}

    def appearance(self, motion: Motion, values: Values) -> Appearance:
        """A face whose middle slides upwards, as wide as the contact wanders."""
        width = face_width(motion, "ccw" if self.sigma > 0 else "cw")
        stem = super().appearance(motion, values)
        return replace(stem, kind="face", trace=1j * stem.trace.imag, face=(-width.left, width.right))


def _ones_like(values: Values) -> Floats:
    return np.where(np.isnan(values[0]), np.nan, 1.0)


@dataclass(frozen=True)
class FaceWidth:
    """How far the contact moves on the face, to the left and to the right of the follower's axis [mm].

    It is the minimum face; a design adds a margin.
    """

    left: float
    right: float


def face_width(motion: Motion, rotation: Rotation = "ccw") -> FaceWidth:
    """The minimum half-widths of a flat face: the contact moves by sigma v from the follower's axis.

    >>> from math import pi, radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Return(30, radians(90)), gc.Dwell(radians(150))])
    >>> width = gc.face_width(motion, "ccw")
    >>> round(width.left, 4), round(width.right, 4)
    (35.8099, 26.8574)
    """
    least, greatest = velocity_range(motion)
    return FaceWidth(-least, greatest) if sense(rotation) > 0 else FaceWidth(greatest, -least)


@dataclass(frozen=True)
class FlatMinimumRadius:
    """The minimum prime radius [mm] under a flat face; ``active`` is ("curvature",), or () where any radius will do."""

    prime_radius: float
    active: tuple[Literal["curvature"], ...]
    place_name = None
    place = 0.0
    """A flat face may stand anywhere across its motion."""


def flat_minimum_radius(
    motion: Motion, follower: FlatFaced, sigma: int, limits: Limits, curvature: float | None = None
) -> FlatMinimumRadius:
    """The minimum prime radius at which rho = r0 + s + a is nowhere less than the permitted ``curvature`` radius [mm].

    >>> from math import pi
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, pi / 2, "cosine"), gc.Return(30, pi / 2, "cosine"), gc.Dwell(pi)])
    >>> round(flat_minimum_radius(motion, gc.FlatFaced(), +1, Limits(), curvature=8.0).prime_radius, 9)
    38.0
    """
    least = curvature or 0.0
    check_number(say("minimum radius of curvature"), least, say("a finite length of 0 mm or more"), least=0)
    s, _, a, _ = highest_places(motion, lambda values: -(values[0] + values[2])).values
    radius = least - float(np.min(s + a))
    return FlatMinimumRadius(radius, ("curvature",)) if radius > 0 else FlatMinimumRadius(0.0, ())
