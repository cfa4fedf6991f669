"""The oscillating flat-faced follower: the profile is the envelope of a face that swings about a pivot at (c, 0).

With psi the angle of the face to the line of centres, e^(-i psi) = -d and n = -i d: along the face, away from the
pivot, points d, and away from the cam n.  The face is c sin(psi) - f from the cam centre, and as seen from the cam
its normal turns by -sigma w, w = 1 + sigma v, for each radian of the cam angle.  So it touches the profile at the foot
of the perpendicular from the pole of cam and follower, which lies c/w from the pivot on the line of centres, and

    rho = c ((2 w - 1) sin(psi)/w^2 + a cos(psi)/w^3) - f

Source: F. Y. Chen, *Mechanics and Design of Cam Mechanisms* (1982), chapter 4, for the envelope of a line; the rest is
derived from it, and held to envelopes at 50 digits in the tests.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np

from graphcam.errors import DesignError, check_number
from graphcam.given.follower import Limits, OscillatingFlat, Rotation, sense, swing_remedy
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion
from graphcam.given.spring_load import FollowerLoad, PlacedArmLoad, largest
from graphcam.mechanism.flat_faced import FlatMinimumRadius
from graphcam.mechanism.kinematics import Appearance, Complexes, Contour, Kinematics, Pair, Values
from graphcam.mechanism.turn_extremes import highest_places, velocity_range
from graphcam.words import say

CURVATURE_TOLERANCE = 1e-9
"""By what part of the centre distance the radius of curvature may miss the permitted one at the minimum radius."""


@dataclass(frozen=True)
class FaceReach:
    """Where a face that swings touches its cam: the nearest and the farthest place from the foot of the pivot [mm].

    It is the minimum face; a design adds a margin on either side.
    """

    near: float
    far: float

    @property
    def length(self) -> float:
        """The length of the face between them [mm]."""
        return self.far - self.near


def check_swing(motion: Motion, sigma: int) -> None:
    """Check that a face never turns with its cam as fast as the cam: the contact would go to infinity.

    Raises
    ------
    DesignError : it does
    """
    fastest = max(-sigma * v for v in velocity_range(motion))
    if not fastest < OscillatingFlatKinematics.max_speed_with_cam:
        found, limit = say("{v:.4g} rad/rad", v=fastest), say("less than 1 where the face turns with the cam")
        remedy = say("swing less, or in a larger cam angle, or let the cam turn the other way")
        raise DesignError(say("angular velocity of the face"), found, limit, remedy)


@dataclass(frozen=True, eq=False)
class OscillatingFlatKinematics(Kinematics):
    """The face touches the cam c cos(psi)/w from the foot of the pivot on it, with w = 1 + sigma v.

    rho is signed, as under a flat face that slides: 0 at a cusp, negative where the envelope runs backwards.

    distance, face_offset : c and f [mm];  swing : the greatest s [rad]
    """

    distance: Any
    face_offset: Any
    swing: Any
    takes_roller = False
    swings = True
    max_speed_with_cam = 1.0

    @classmethod
    def of(cls, sizes: OscillatingFlat, prime_radius: Any, sigma: Any, lift: Any) -> Self:
        """The kinematics of a face on its pivot; the lift is an angle."""
        made = cls(sigma, prime_radius, sizes.distance, sizes.face_offset, lift)
        _ = made.psi0  # so that its parts know it
        return made

    def check(self) -> None:
        """Check that the face meets the base circle, and stays above the line of centres as long as it swings."""
        c, f, r0 = self.distance, self.face_offset, self.prime_radius
        if not r0 + f < c:
            limit = say(
                "less than {room:g} mm, the centre distance of {distance:g} mm less the face offset of {offset:g} mm",
                room=c - f,
                distance=c,
                offset=f,
            )
            raise DesignError(
                say("prime radius"), r0, limit, say("make the prime radius smaller or move the pivot away")
            )
        if not r0 + f > -c:
            limit = say("more than {least:g} mm, where the face still meets the prime circle", least=-c - r0)
            raise DesignError(say("face offset"), f, limit, say("bring the face nearer to its pivot"))
        if math.isnan(self.psi0):
            left = 90.0 - math.degrees(math.asin((r0 + f) / c))
            limit = say(
                "less than the {left:g} degrees from the lower dwell to a face square to the line of centres", left=left
            )
            remedy = say("make the lift or the prime radius smaller, or the centre distance longer")
            lift = say("{degrees:g} degrees", degrees=math.degrees(self.swing))
            raise DesignError("lift", lift, limit, swing_remedy(self.swing, remedy))

    def check_motion(self, motion: Motion) -> None:
        """Check that the face never turns with the cam as fast as the cam."""
        check_swing(motion, self.sigma)

    @cached_property
    def psi0(self) -> Any:
        """The angle between the face and the line of centres at the low rest [rad].

        >>> face = OscillatingFlatKinematics(+1, prime_radius=40, distance=100, face_offset=10, swing=0.2)
        >>> round(math.degrees(face.psi0), 9)
        30.0
        """
        sine, c = self.prime_radius + self.face_offset, self.distance
        with np.errstate(invalid="ignore"):
            # Factored, because c^2 less the square loses its digits where the face is nearly square to the centres.
            angle = np.arctan2(sine, np.sqrt((c - sine) * (c + sine)))
        fits = (np.abs(sine) < c) & (angle + self.swing < math.pi / 2)
        return np.where(fits, angle, np.nan)[()]

    # --- the geometry ------------------------------------------------------------------------------------------------

    def _sine_cosine(self, values: Values) -> tuple[Any, Any]:
        """The sine and cosine of psi, by the half angle: what carries derivatives along knows its tangent."""
        t = np.tan((self.psi0 + values[0]) / 2)
        return 2 * t / (1 + t * t), (1 - t) * (1 + t) / (1 + t * t)

    def _turning(self, values: Values) -> Any:
        """w = 1 + sigma v, how far the normal of the face turns against the cam for each radian of the cam angle."""
        return 1 + self.sigma * values[1]

    def contact(self, values: Values) -> Floats:
        """How far from the foot of the pivot the face touches the cam [mm], along the face."""
        _, cosine = self._sine_cosine(values)
        return self.distance * cosine / self._turning(values)

    def path(self, values: Values) -> tuple[Pair, Pair, Floats]:
        """The point where the face touches the profile [mm], the normal of the face, the profile's curvature [1/mm]."""
        sine, cosine = self._sine_cosine(values)
        along = self.distance * cosine / self._turning(values)
        x = self.distance - along * cosine - self.face_offset * sine
        return (x, along * sine - self.face_offset * cosine), (sine, cosine), self.curvature(values)

    def convex_radius(self, values: Values) -> Floats:
        """rho [mm]: 0 at a cusp, negative where the envelope runs backwards; infinite where the contact is."""
        sine, cosine = self._sine_cosine(values)
        by_sine, by_cosine = self.factors(values)
        return self.distance * (by_sine * sine + by_cosine * cosine) - self.face_offset

    def factors(self, values: Values) -> tuple[Any, Any]:
        """(2 w - 1)/w^2 and a/w^3, the factors of c sin(psi) and c cos(psi) in rho."""
        w = self._turning(values)
        return (2 * w - 1) / (w * w), values[2] / (w * w * w)

    def curvature(self, values: Values) -> Floats:
        """1/rho [1/mm]; infinite at a cusp."""
        rho = self.convex_radius(values)
        return np.divide(1.0, rho, out=np.full_like(rho, np.inf), where=rho != 0)

    def sharpness(self, values: Values) -> Floats:
        """The measure of sharpness: -rho [mm]."""
        return -self.convex_radius(values)

    def sharpness_and_slope(self, values: Values) -> tuple[Floats, Floats]:
        """-rho, and its derivative."""
        _, v, a, j = values
        w, (sine, cosine), (by_sine, by_cosine) = (
            self._turning(values),
            self._sine_cosine(values),
            self.factors(values),
        )
        sine1, cosine1 = -2 * a * v / w**3, j / w**3 - 3 * self.sigma * a * a / w**4
        slope = (sine1 - v * by_cosine) * sine + (cosine1 + v * by_sine) * cosine
        return self.sharpness(values), -self.distance * slope

    @staticmethod
    def radius_of(sharpness: Floats) -> Floats:
        """The radius of curvature rho [mm] of a sharpness."""
        return -sharpness

    def relative_radius(self, values: Values, roller: Any) -> Floats:
        """rho: a face is not curved."""
        return self.convex_radius(values)

    def speed(self, values: Values, inset: float) -> Floats:
        """(rho - inset) w [mm/rad]: the face turns with the cam and with itself."""
        return (self.convex_radius(values) - inset) * self._turning(values)

    # --- pressure angle and friction ---------------------------------------------------------------------------------

    def pressure(self, values: Values) -> tuple[Pair, Pair]:
        """q = c cos(psi)/w - i f, whose argument is the pressure angle, and q': 0 where the face meets its pivot.

        The normal of the face, seen along the motion of the contact point about the pivot; measured, like that of an
        arm, in one sense whichever way the cam turns.
        """
        _, v, a, _ = values
        w, (sine, cosine) = self._turning(values), self._sine_cosine(values)
        along = self.distance * cosine / w
        across = -self.face_offset + 0 * along
        return (along, across), (-self.distance * v * sine / w - self.sigma * a * along / w, 0 * along)

    def steepest(self, lift: Any, speed: Any) -> Any:
        """The bound |f| (1 + |v|)/(c cos(psi)) of the pressure angle's tangent; the cosine is least at an end."""
        least = np.minimum(np.cos(self.psi0), np.cos(self.psi0 + lift))
        return np.abs(self.face_offset) * (1 + speed) / (self.distance * least)

    @property
    def leaning(self) -> Any:
        """sigma: alpha is measured in one sense about the pivot, whichever way the cam turns."""
        return self.sigma

    def sliding(self, values: Values, roller: float) -> tuple[Floats, Floats]:
        """c sin(psi) - f w: the cam slides along the face, which turns."""
        _, v, a, _ = values
        sine, cosine = self._sine_cosine(values)
        slope = self.distance * cosine * v - self.sigma * self.face_offset * a
        return self.distance * sine - self.face_offset * self._turning(values), slope

    def reach(self, values: Values) -> tuple[Any, Any]:
        """The distance of the contact from the pivot [mm]; the normal force turns the face with q of it."""
        (along, across), (slope, _) = self.pressure(values)
        length = np.sqrt(along * along + across * across)
        return length, along * slope / length

    def pressed_by(self, load: Any) -> FollowerLoad:
        """A torque about the pivot.

        Raises
        ------
        DesignError : as for every load, or it is a force on the end of an arm
        """
        super().pressed_by(load)
        placed = PlacedArmLoad(load, 0.0, self.distance, self.psi0)
        if largest(load.load):
            limit = say("left out, for a face has no end of an arm on which it would act")
            raise DesignError("load", say("given"), limit, say("give its moment as the preload of a torsion spring"))
        if np.ndim(self.psi0) == 0:
            placed.check(self.swing)
        return placed

    def face_ends(self, motion: Motion) -> Mapping[str, float]:
        """The nearest and the farthest contact from the foot of the pivot."""
        reach = self.face_reach(motion)
        return {"face_near": reach.near, "face_far": reach.far}

    def face_reach(self, motion: Motion) -> FaceReach:
        """Where the contact lies on the face over a turn."""
        places = (highest_places(motion, lambda values, sign=sign: sign * self.contact(values)) for sign in (-1, 1))
        near, far = (self.contact(place.values) for place in places)
        return FaceReach(float(near.min()), float(far.max()))

    # --- as it is made, and as it is designed ------------------------------------------------------------------------

    def lift_per_error(self, values: Values) -> dict[str, Any]:
        """1/q by the profile and by the offset of the face, -sin(psi)/q by c: what moves the face where it touches."""
        sine, cosine = self._sine_cosine(values)
        lift = self._turning(values) / (self.distance * cosine)
        return {"profile": lift, "distance": -sine * lift, "face_offset": lift}

    def gap(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any]:
        """How far the tangent passes from the pivot, beyond the offset of the face."""
        distance, offset = self._made_sizes(sizes)
        out = contour.point - distance
        turned = -1j * self.sigma * contour.turning * contour.normal
        return (out * contour.normal.conj()).real + offset, (out * turned.conj()).real

    def motion_on_contour(self, contour: Contour, sizes: Mapping[str, Any]) -> tuple[Any, Any, Any]:
        """psi from the normal, w from the place of the contact on the face, a from the curvature."""
        distance, offset = self._made_sizes(sizes)
        along = 1j * contour.normal
        psi, q = -np.angle(-along), ((contour.point - distance) * along.conj()).real
        w = distance * np.cos(psi) / q
        bent = (1 / contour.curvature + offset) / distance - (2 * w - 1) / (w * w) * np.sin(psi)
        return psi - self.psi0, self.sigma * (w - 1), bent * w**3 / np.cos(psi)

    def _made_sizes(self, sizes: Mapping[str, Any]) -> tuple[Any, Any]:
        """c and f as they are made [mm]."""
        return self.distance + sizes.get("distance", 0.0), self.face_offset + sizes.get("face_offset", 0.0)

    def _angle_by_sizes_at_rest(self) -> dict[str, Any]:
        """The derivatives of psi0, c sin(psi0) = r0 + f, by r0, f and c [rad/mm]."""
        by_radius = 1 / (self.distance * np.cos(self.psi0))
        return {"prime_radius": by_radius, "face_offset": by_radius, "distance": -np.tan(self.psi0) / self.distance}

    def angle_by_sizes(self, values: Values) -> dict[str, Floats]:
        """alpha = arg(q - i f) turns by (f dq - q df)/(q^2 + f^2), with q = c cos(psi)/w."""
        s, v, _, _ = values
        w, (sine, cosine) = self._turning(values), self._sine_cosine(values)
        q, by_psi = self.distance * cosine / w, -self.distance * sine / w
        along = {name: by_psi * turn for name, turn in self._angle_by_sizes_at_rest().items()}
        along["distance"] = along["distance"] + cosine / w
        along["lift"] = by_psi * s - self.sigma * v * q / w
        squared = q * q + self.face_offset * self.face_offset
        across = {"face_offset": q}
        return {name: (self.face_offset * by - across.get(name, 0.0)) / squared for name, by in along.items()}

    def radius_by_sizes(self, values: Values) -> dict[str, Floats]:
        """The derivatives of rho by the sizes."""
        s, v, a, _ = values
        w, (sine, cosine), (by_sine, by_cosine) = (
            self._turning(values),
            self._sine_cosine(values),
            self.factors(values),
        )
        by_psi = self.distance * (by_sine * cosine - by_cosine * sine)
        found = {name: by_psi * turn for name, turn in self._angle_by_sizes_at_rest().items()}
        found["distance"] = found["distance"] + by_sine * sine + by_cosine * cosine
        found["face_offset"] = found["face_offset"] - 1
        bent = -2 * v * v / w**3 * sine + (a / w**3 - 3 * self.sigma * a * v / w**4) * cosine
        return found | {"lift": by_psi * s + self.distance * bent}

    def appearance(self, motion: Motion, values: Values) -> Appearance:
        """A face on its pivot, as long as the contact wanders; from the left it swings clockwise on the rise."""
        contact, pivot = self.point(values), complex(self.distance)
        reach = self.face_reach(motion)
        way: Complexes = -1j * (contact - pivot)
        return Appearance("blade", contact, way / np.abs(way), pivot, (reach.near, reach.far))


def face_reach(motion: Motion, follower: OscillatingFlat, prime_radius: float, rotation: Rotation = "ccw") -> FaceReach:
    """Where the contact lies on an oscillating flat face over a turn, c cos(psi)/(1 + sigma v) from its pivot's foot.

    Raises
    ------
    DesignError : there is no such cam

    >>> import graphcam as gc
    >>> from math import pi, radians
    >>> swing = radians(15)
    >>> motion = gc.Motion([gc.Rise(swing, pi / 2), gc.Dwell(pi / 2), gc.Return(swing, pi / 2), gc.Dwell(pi / 2)])
    >>> reach = gc.face_reach(motion, gc.OscillatingFlat(distance=100), prime_radius=40)
    >>> round(reach.near, 3), round(reach.far, 3)
    (64.463, 125.295)
    """
    kin = OscillatingFlatKinematics.of(follower, prime_radius, sense(rotation), motion.lift)
    kin.check()
    kin.check_motion(motion)
    return kin.face_reach(motion)


def oscillating_flat_minimum_radius(
    motion: Motion, follower: OscillatingFlat, sigma: int, limits: Limits, curvature: float | None = None
) -> FlatMinimumRadius:
    """The minimum prime radius at which rho is nowhere less than the permitted ``curvature`` radius [mm].

    With R and delta of A = (2 w - 1)/w^2 = R cos(delta) and B = a/w^3 = R sin(delta), a place of the motion needs
    R sin(psi0 + s + delta) >= (rho + f)/c: an arc of psi0.  The greatest of their beginnings decides, and that
    no arc ends before it is checked.

    Raises
    ------
    DesignError : at this centre distance no prime radius will do

    >>> from math import pi, radians
    >>> import graphcam as gc
    >>> swing = radians(15)
    >>> motion = gc.Motion([gc.Rise(swing, pi / 2), gc.Dwell(pi / 2), gc.Return(swing, pi / 2), gc.Dwell(pi / 2)])
    >>> least = gc.minimum_radius(motion, gc.OscillatingFlat(distance=100), curvature=8.0).prime_radius
    >>> cam = gc.Cam(motion, gc.OscillatingFlat(distance=100), least)
    >>> round(cam.extremes().min_convex_radius[0], 9)
    8.0
    """
    least = curvature or 0.0
    check_number(say("minimum radius of curvature"), least, say("a finite length of 0 mm or more"), least=0)
    c, f = follower.distance, follower.face_offset
    # The factors do not depend on the prime radius, so any will do here.
    kin = OscillatingFlatKinematics(sigma, 0.0, c, f, motion.lift)
    kin.check_motion(motion)

    def needed(values: Values) -> Floats:
        """The least psi0 [rad] with which rho is the permitted one at a place."""
        by_sine, by_cosine = kin.factors(values)
        share = (least + f) / c / np.hypot(by_sine, by_cosine)
        return np.arcsin(np.clip(share, -1.0, 1.0)) - np.arctan2(by_cosine, by_sine) - values[0]

    psi0 = float(np.max(needed(highest_places(motion, needed).values)))
    radius = c * math.sin(max(psi0, -math.pi / 2)) - f
    if not radius > 0:
        return FlatMinimumRadius(0.0, ())
    if psi0 + motion.lift < math.pi / 2:
        found = OscillatingFlatKinematics.of(follower, radius, sigma, motion.lift)
        rho = found.convex_radius(highest_places(motion, found.sharpness).values).min()
        if rho >= least - CURVATURE_TOLERANCE * c:
            return FlatMinimumRadius(radius, ("curvature",))
    remedy = say("lengthen the centre distance, swing less, or in a larger cam angle")
    if not least:
        raise DesignError(say("centre distance"), c, say("so long that some prime radius gives a convex cam"), remedy)
    limit = say("so small that some prime radius has it at a centre distance of {distance:g} mm", distance=c)
    raise DesignError(say("minimum radius of curvature"), least, limit, remedy)
