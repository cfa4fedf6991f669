"""The cam itself: pitch curve, working profile, pressure angle, curvature, and their extremes.

It is the same for every follower; what differs stands in the follower's
:class:`~graphcam.mechanism.kinematics.Kinematics`, as values of the frame that are seen here from the turning cam.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import asdict, dataclass, field
from functools import cached_property
from textwrap import shorten
from typing import Literal, NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.given.follower import FOLLOWER_CLASSES, Follower, Rotation, sense
from graphcam.given.laws import Floats, Side
from graphcam.given.motion import Motion, angles_of, wrap
from graphcam.given.piecewise import chunks, sine_cosine
from graphcam.mechanism.envelope import Envelope, outer_wall
from graphcam.mechanism.followers import kinematics
from graphcam.mechanism.kinematics import Kinematics, Pair, Values
from graphcam.mechanism.turn_extremes import Extreme, Places, first_index, highest_places, places_from
from graphcam.mechanism.undercut import Undercut, trimmed_profile, undercuts
from graphcam.showing import MAX_WIDTH, Plottable, value_text
from graphcam.words import say


@dataclass(frozen=True, eq=False)
class CamPoints:
    """A cam at places that belong to phases; every array is shaped like the places.

    phi : cam angle [rad];  values : (s, v, a, j);  pitch, profile : (..., 2) cam coordinates [mm]
    pressure_angle : signed [rad];  curvature : of the pitch curve, positive where convex [1/mm]
    """

    phi: Floats
    values: Values
    pitch: Floats
    profile: Floats
    pressure_angle: Floats
    curvature: Floats


class Curves(NamedTuple):
    """The curves of a cam: pitch and profile (..., 2) [mm], and the curvature (...) of the pitch curve [1/mm]."""

    pitch: Floats
    profile: Floats
    curvature: Floats


@dataclass(frozen=True)
class Extremes:
    """The extremes of a cam, each as (value, phi) to full precision; equal ones are told by the first.

    pressure_angle_rise, pressure_angle_return : the signed value [rad] of maximum magnitude in any rise, any return
    min_convex_radius : the minimum radius of curvature [mm] of the convex parts of the pitch curve; at a jump of the
        acceleration both one-sided values count.  Of a flat-faced follower the minimum rho = r0 + s + a, signed: at 0
        the profile has a cusp, below 0 it cannot be cut
    min_convex_radius_moving : the same over the rises and returns alone; (inf, nan) if nothing there is convex
    """

    pressure_angle_rise: Extreme
    pressure_angle_return: Extreme
    min_convex_radius: Extreme
    min_convex_radius_moving: Extreme


@dataclass(frozen=True, repr=False)
class Cam(Plottable):
    """A disk cam that gives the motion to the follower.

    Parameters
    ----------
    motion : displacement over one revolution
    follower : one of graphcam's; of one with a flat face pitch curve and profile are the same curve
    prime_radius : r0 [mm], the minimum radius of the pitch curve
    rotation : "ccw" or "cw"

    Raises
    ------
    DesignError : a length is not positive, the offset, the arm or the roller does not fit the prime radius, an arm's
        centre distance is left open, or the rotation is unknown

    Cam angles are in radians; for degrees write ``cam.profile(gc.cam_angle(60))``.

    A roller larger than the minimum radius of curvature is no error here: the profile is then the whole envelope, with
    its loops; :meth:`undercuts` finds them.  The same holds for a flat face on too small a cam.

    >>> import graphcam as gc
    >>> from math import degrees, radians
    >>> rise, dwell, back = gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120))
    >>> motion, follower = gc.Motion([rise, dwell, back, dwell]), gc.Translating(offset=10, roller_radius=12)
    >>> cam = gc.Cam(motion, follower, prime_radius=50)
    >>> cam
    Cam that turns ccw, prime radius 50 mm
      translating follower, offset 10 mm, roller radius 12 mm
      rise 120°, dwell 60°, return 120°, dwell 60°
    .pitch_curve(phi), .profile(phi), .pressure_angle(phi) at phi in rad; .extremes(); .plot() draws it
    >>> cam.pitch_curve(0).round(4).tolist()
    [10.0, 48.9898]
    >>> cam.profile(0).round(4).tolist()
    [7.6, 37.2322]
    >>> cam.profile(gc.cam_angle(60)).round(4).tolist()  # at 60 degrees
    [51.8958, 14.8852]
    >>> round(degrees(cam.pressure_angle(radians(60))), 4), cam.pitch_curvature(radians(150)).round(6).tolist()
    (14.7586, 0.01256)
    >>> cam.at(phase=2, u=[0.0, 1.0]).pitch.round(4).tolist()
    [[-10.0, -78.9898], [-37.4264, 33.1552]]
    >>> value, phi = cam.extremes().pressure_angle_rise
    >>> round(degrees(value), 4), round(degrees(phi), 4)
    (14.9781, 55.8179)
    """

    _drawn_in = "cam_outline.plot"

    motion: Motion
    follower: Follower
    prime_radius: float
    rotation: Rotation = "ccw"
    sigma: int = field(init=False, repr=False)
    """+1 for a counter-clockwise cam, -1 for a clockwise one"""

    def __post_init__(self) -> None:
        check_kind("motion", self.motion, Motion)
        check_kind("follower", self.follower, FOLLOWER_CLASSES)
        check_number(say("prime radius"), self.prime_radius, say("a finite length of more than 0 mm"), above=0)
        if not self.roller_radius < self.prime_radius:
            limit = say("smaller than the prime radius of {prime_radius} mm", prime_radius=self.prime_radius)
            remedy = say("take a smaller roller or enlarge the prime radius")
            raise DesignError(say("roller radius"), self.roller_radius, limit, remedy)
        object.__setattr__(self, "sigma", sense(self.rotation))
        self.kinematics.check_motion(self.motion)

    @property
    def roller_radius(self) -> float:
        """Radius of the follower's roller [mm], 0 for a knife edge or a flat face."""
        return self.follower.roller_radius

    @cached_property
    def kinematics(self) -> Kinematics:
        """The follower's kinematics on this cam: trace point, pressure angle and curvature from (s, v, a, j)."""
        return kinematics(self.follower, self.prime_radius, self.sigma, self.motion.lift)

    @cached_property
    def envelope(self) -> Envelope:
        """The profile as a curve, with its loops."""
        return Envelope(self.motion, self.kinematics, self.roller_radius)

    @cached_property
    def outer_wall(self) -> Envelope:
        """The outer wall of a groove for the roller: the pitch curve moved outwards by its radius.

        Raises
        ------
        DesignError : the follower has no roller, or the roller does not fit the hollows of its path
        """
        return outer_wall(self.motion, self.kinematics, self.roller_radius)

    @property
    def table_turn(self) -> complex:
        """What turns points x + i y so that cam angle 0 is that of a measured table, or of the parts of a motion."""
        return complex(np.exp(-1j * self.sigma * self.motion.origin))

    def __repr__(self) -> str:
        sizes = [f"{name.replace('_', ' ')} {size:.6g} mm" for name, size in asdict(self.follower).items()]
        phases = [f"{kind} {math.degrees(end - start):.6g}°" for kind, start, end in self.motion.timing]
        first = f"Cam that turns {self.rotation}, prime radius {self.prime_radius:.6g} mm"
        follower = ", ".join([f"{self.follower.kind} follower", *sizes])
        turn = shorten(", ".join(phases), MAX_WIDTH, placeholder=" ...")
        last = ".pitch_curve(phi), .profile(phi), .pressure_angle(phi) at phi in rad; .extremes(); .plot() draws it"
        return value_text(first, (follower, turn), last)

    def pitch_curve(self, phi: ArrayLike, side: Side = "right") -> Floats:
        """(..., 2) the trace point's path on the cam [mm], at cam angles phi [rad]; NaN for NaN."""
        return self._in_chunks(self._write_pitch, phi, side, points=1)[0]

    def profile(self, phi: ArrayLike, side: Side | Literal["outer"] = "right") -> Floats:
        """(..., 2) the working profile on the cam [mm]: the pitch curve moved inwards by the roller radius.

        side : which value at a break; "outer" is the other wall of a groove, the pitch curve moved outwards

        Raises
        ------
        DesignError : there is no outer wall, as for :attr:`outer_wall`
        """
        if side == "outer":
            _ = self.outer_wall  # says what does not fit
            return 2 * self.pitch_curve(phi) - self.profile(phi)
        return self._in_chunks(self._write_profile, phi, side, points=1)[0]

    def pressure_angle(self, phi: ArrayLike) -> Floats:
        """alpha [rad] between the contact normal and the trace point's motion.

        It is positive on an ordinary rise; of an arm only on a cam that turns counter-clockwise, else negative.
        """
        return self._pressure_angle(self.motion(phi))

    def pitch_curvature(self, phi: ArrayLike, side: Side = "right") -> Floats:
        """Curvature kappa of the pitch curve [1/mm], positive where the cam is convex."""
        return self._in_chunks(self._write_curvature, phi, side, numbers=1)[0]

    def curves(self, phi: ArrayLike, side: Side = "right") -> Curves:
        """Pitch curve, profile (..., 2) [mm] and curvature of the pitch curve [1/mm] together, in half the time."""
        pitch, profile, curvature = self._in_chunks(self._write_curves, phi, side, points=2, numbers=1)
        return Curves(pitch, profile, curvature)

    @overload
    def at(self, phi: ArrayLike, /, *, side: Side = "right") -> CamPoints: ...
    @overload
    def at(self, phase: ArrayLike, u: ArrayLike, side: Side = "right") -> CamPoints: ...
    def at(self, phase: ArrayLike, u: ArrayLike | None = None, side: Side = "right") -> CamPoints:
        """All quantities at cam angles phi [rad], or at fractions of phases, whose ends are seen from inside then.

        ``at(phi)``: any real numbers; at a break the value of the named side.
        ``at(phase, u)``: the index of the phase, one or as many as there are fractions u.
        """
        places = places_from(self.motion, phase, u, side)
        phi, values = places.phi, places.values
        (pitch, profile), curvature = np.empty((2, *phi.shape, 2)), np.empty(phi.shape)
        self._write_curves(phi, values, pitch, profile, curvature)
        return CamPoints(phi, values, pitch, profile, self._pressure_angle(values), curvature)

    def extremes(self) -> Extremes:
        """Maximum pressure angles and minimum convex radii of curvature, to full precision.

        The fields of what it returns: pressure_angle_rise and pressure_angle_return [rad], min_convex_radius and
        min_convex_radius_moving [mm]; each is a pair (value, phi) with the cam angle [rad] of the place.

        No extreme hides beside another or between two samples: the search follows each quantity with as many parts as
        it needs (see :mod:`graphcam.given.extreme_search`).
        """
        kin = self.kinematics
        steep = highest_places(self.motion, kin.steepness, signed=True)
        sharp = highest_places(self.motion, kin.sharpness)
        direction = self.motion.directions
        return Extremes(
            self._steepest(steep.selected(direction[steep.phase] > 0)),
            self._steepest(steep.selected(direction[steep.phase] < 0)),
            self._sharpest(sharp),
            self._sharpest(sharp.selected(direction[sharp.phase] != 0)),
        )

    def undercuts(self) -> list[Undercut]:
        """The parts of the profile that are lost if the roller is too large, in order; an empty list for a sound cam.

        A flat face undercuts a cam that is too small.

        Raises
        ------
        DesignError : the loops cannot be told apart

        >>> import graphcam as gc
        >>> from math import degrees, radians
        >>> rise, back = gc.Rise(30, radians(60)), gc.Return(30, radians(90))
        >>> motion = gc.Motion([rise, gc.Dwell(radians(90)), back, gc.Dwell(radians(120))])
        >>> lost, = gc.Cam(motion, gc.Translating(offset=5, roller_radius=20), prime_radius=30).undercuts()
        >>> [round(degrees(phi), 2) for phi in lost.cusps], [round(x, 4) for x in lost.crossing[2:]]
        ([42.22, 54.12], [35.6465, 17.6731])
        """
        return undercuts(self.envelope)

    def trimmed_profile(self, n: int) -> Floats:
        """(n, 2) the closed profile that can be cut [mm]: what is lost left out, and the corners there included.

        The first point is the lowest place; between corners the steps of the cam angle are about equal.

        Raises
        ------
        DesignError : there are too few points for the corners, or as for :meth:`undercuts`
        """
        return trimmed_profile(self.envelope, n).points

    def _steepest(self, places: Places) -> Extreme:
        alpha = self._pressure_angle(places.values)
        k = first_index(np.abs(alpha), places.phi)
        return Extreme(float(alpha[k]), float(places.phi[k]))

    def _sharpest(self, places: Places) -> Extreme:
        radius = self.kinematics.convex_radius(places.values)
        k = first_index(-radius, places.phi) if np.isfinite(radius).any() else 0
        return Extreme(float(radius[k]), float(places.phi[k]) if radius[k] < math.inf else math.nan)

    def _in_chunks(
        self, write: Callable[..., None], phi: ArrayLike, side: Side, points: int = 0, numbers: int = 0
    ) -> list[Floats]:
        """Arrays of points and of numbers that are computed from the angles and (s, v, a, j), chunk by chunk."""
        phi = angles_of(phi)
        flat = phi.ravel()
        # Points in one block: finding new memory for every array takes the system up to a fifth of the time.
        arrays = [*np.empty((points, phi.size, 2)), *np.empty((numbers, phi.size))]
        for here in chunks(phi.size):
            turned = wrap(flat[here])
            write(turned, self.motion(turned, side), *(array[here] for array in arrays))
        return [array.reshape((*phi.shape, *array.shape[1:])) for array in arrays]

    # What follows from (s, v, a, j) alone, whatever the angle or the phase they came from.

    def _write_pitch(self, phi: Floats, values: Values, pitch: Floats) -> None:
        z = self.kinematics.point(values)
        _see((z.real, z.imag), self._axes(phi), pitch)

    def _write_profile(self, phi: Floats, values: Values, profile: Floats) -> None:
        point, normal, _ = self.kinematics.path(values)
        _see(self._inset(point, normal), self._axes(phi), profile)

    def _write_curvature(self, _: Floats, values: Values, curvature: Floats) -> None:
        curvature[...] = self.kinematics.curvature(values)

    def _write_curves(self, phi: Floats, values: Values, pitch: Floats, profile: Floats, curvature: Floats) -> None:
        point, normal, curvature[...] = self.kinematics.path(values)
        axes = self._axes(phi)
        _see(point, axes, pitch)
        _see(self._inset(point, normal), axes, profile)

    def _inset(self, point: Pair, normal: Pair) -> Pair:
        """Points as far inside of a curve as the roller reaches."""
        r = self.roller_radius
        return point[0] - r * normal[0], point[1] - r * normal[1]

    def _axes(self, phi: Floats) -> Pair:
        """Cosine and sine of sigma phi, by which the frame turns as it is seen from the cam."""
        sine, cosine = sine_cosine(phi)
        return cosine, self.sigma * sine

    def _pressure_angle(self, values: Values) -> Floats:
        (along, across), _ = self.kinematics.pressure(values)
        return np.arctan2(across, along)


def largest_roller(cam: Cam) -> float:
    """The roller radius [mm] that a sound profile stays below: the minimum convex radius of the pitch curve.

    The prime radius limits it too.  It is a matter of the pitch curve alone, whatever roller the follower has.

    Raises
    ------
    DesignError : the follower has no roller
    """
    check_kind("cam", cam, Cam)
    if not cam.kinematics.takes_roller:
        limit = say("one with a roller")
        raise DesignError("follower", cam.follower.kind, limit, say("enlarge the prime radius instead"))
    return cam.envelope.least_radius


def _see(vector: Pair, axes: Pair, out: Floats) -> None:
    """Write the cam coordinates of vectors of the frame to (..., 2)."""
    (x, y), (c, s) = vector, axes
    np.add(x * c, y * s, out=out[..., 0])
    np.subtract(y * c, x * s, out=out[..., 1])
