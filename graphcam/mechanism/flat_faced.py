"""The flat-faced follower: the profile is the envelope of the face, which moves along its own normal.

Source: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapter 4.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.mechanism.kinematics import Complexes, Pair, Values
from graphcam.mechanism.peaks import velocity_range


@dataclass(frozen=True)
class FlatFacedKinematics:
    """The face touches the cam at sigma v + i (r0 + s), where the profile has the radius rho = r0 + s + a.

    rho is signed.  A face cannot reach into a hollow: the profile is never concave.  Where rho is negative the envelope
    runs backwards between two cusps (rho = 0) and cannot be cut, and kappa = 1/rho is negative there.

    sigma : the sense in which the cam turns;  prime_radius : r0 [mm], the profile's least radius; of many cams an array
    """

    sigma: int
    prime_radius: float | Floats

    def path(self, values: Values) -> tuple[Pair, Pair, Floats]:
        """The point where the face touches the profile [mm], the normal of the face, the profile's curvature [1/mm]."""
        s, v, _, _ = values
        return (self.sigma * v, self.prime_radius + s), (0.0, 1.0), self.curvature(values)

    def point(self, values: Values) -> Complexes:
        """The point where the face touches the profile [mm]."""
        (x, y), _, _ = self.path(values)
        return x + 1j * np.asarray(y)

    def normal(self, values: Values) -> Complexes:
        """The normal of the face."""
        return 1j * _ones(values)

    def pressure(self, values: Values) -> tuple[Pair, Pair]:
        """1 and 0: the face is perpendicular to the motion, and the pressure angle is zero."""
        one = _ones(values)
        return (one, 0 * one), (0.0, 0.0)

    def speed(self, values: Values, inset: float) -> Floats:
        """rho - inset [mm/rad]: the face turns with the cam."""
        return self.convex_radius(values) - inset

    def curvature(self, values: Values) -> Floats:
        """1/rho [1/mm]; infinite at a cusp."""
        rho = self.convex_radius(values)
        return np.divide(1.0, rho, out=np.full_like(rho, np.inf), where=rho != 0)

    def curvature_slope(self, values: Values) -> Floats:
        """-rho', of the sign of kappa'."""
        _, v, _, j = values
        return -(v + j)

    def convex_radius(self, values: Values) -> Floats:
        """rho [mm]: 0 at a cusp, negative where the envelope runs backwards."""
        s, _, a, _ = values
        return self.prime_radius + s + a


def _ones(values: Values) -> Floats:
    return np.where(np.isnan(values[0]), np.nan, 1.0)


@dataclass(frozen=True)
class FaceWidth:
    """How far the contact wanders on the face, to the left and to the right of the follower's axis [mm].

    It is the least face; a design adds a margin.
    """

    left: float
    right: float


def face_width(motion: Motion, rotation: Rotation = "ccw") -> FaceWidth:
    """The least half-widths of a flat face: the contact wanders by sigma v from the follower's axis.

    >>> from math import pi, radians
    >>> from graphcam.given.motion import Dwell, Return, Rise
    >>> motion = Motion([Rise(30, radians(120)), Return(30, radians(90)), Dwell(radians(150))])
    >>> width = face_width(motion, "ccw")
    >>> round(width.left, 4), round(width.right, 4)
    (35.8099, 26.8574)
    """
    least, greatest = velocity_range(motion)
    return FaceWidth(-least, greatest) if sense(rotation) > 0 else FaceWidth(greatest, -least)
