"""Contact stress between follower and cam: Hertz's line contact, for one place and over the revolution.

With 1/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2 and 1/R = 1/R1 + 1/R2, a force F over the width w flattens a strip of the
half-width sqrt(4 F R/(pi w E')) under the peak pressure sqrt(F E'/(pi w R)).

Source: K. L. Johnson, *Contact Mechanics* (1985), chapter 4.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, overload

import numpy as np
from numpy.typing import ArrayLike

from graphcam.errors import DesignError, check_kind, check_number
from graphcam.former_names import renamed
from graphcam.given.laws import Floats, Side
from graphcam.given.roller_contact import STEEL_POISSON_RATIO, STEEL_YOUNG_MODULUS, RollerContact, equivalent_modulus
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.kinematics import Kinematics, Values
from graphcam.mechanism.turn_extremes import Places, TurnCurve, ValueAt, over_turn, places_from, turn_maximum
from graphcam.showing import Plottable, parts_text
from graphcam.words import say


class LineContact(NamedTuple):
    """Peak pressure [MPa] and half-width of the flattened strip [mm]."""

    peak_pressure: float
    half_width: float


def hertz_line_contact(
    force: float,
    width: float,
    radius1: float,
    radius2: float,
    young1: float = STEEL_YOUNG_MODULUS,
    young2: float = STEEL_YOUNG_MODULUS,
    poisson1: float = STEEL_POISSON_RATIO,
    poisson2: float = STEEL_POISSON_RATIO,
) -> LineContact:
    """The peak pressure between two cylinders with parallel axes, and the half-width of their contact.

    force : N, 0 or more;  width : of the contact along the axes [mm]
    radius1, radius2 : mm; a concave one is negative, a flat one infinite
    young1, young2 : MPa;  poisson1, poisson2 : from 0 to 0.5

    Raises
    ------
    DesignError : a value is impossible, or a hollow is no wider than what lies in it: they touch in no single line

    >>> import graphcam as gc
    >>> pressure, half_width = gc.hertz_line_contact(1000, 20, 30, 15)
    >>> round(pressure, 6), round(half_width, 9)
    (424.431865, 0.074996698)
    >>> round(gc.hertz_line_contact(1000, 20, radius1=-20, radius2=15).peak_pressure, 6)
    173.273583
    """
    check_number("force", force, say("a finite number of 0 N or more"), least=0)
    stiffness = equivalent_modulus(width, young1=young1, young2=young2, poisson1=poisson1, poisson2=poisson2)
    bend = _relative_curvature(radius1, radius2)
    load = force / width / math.pi
    return LineContact(math.sqrt(load * stiffness * bend), 2 * math.sqrt(load / stiffness / bend))


def _relative_curvature(radius1: float, radius2: float) -> float:
    """1/R1 + 1/R2 [1/mm]."""
    for quantity, value in (("radius1", radius1), ("radius2", radius2)):
        if math.isnan(value) or value == 0:
            raise DesignError(quantity, value, say("a radius in mm, negative for a hollow, infinite for a plane"))
    if math.isinf(radius1) or math.isinf(radius2):
        bend = 1 / radius1 + 1 / radius2
    else:
        # The sum first: of a roller in a hollow that is hardly wider it is exact, the difference of quotients is not.
        bend = (radius1 + radius2) / radius1 / radius2
    if not bend > 0:
        found = say("{radius1:g} and {radius2:g} mm", radius1=radius1, radius2=radius2)
        remedy = say("a hollow must be wider than what lies in it")
        raise DesignError(say("pair of radii"), found, say("such that they touch along one line"), remedy)
    return bend


@dataclass(frozen=True, eq=False)
class Stresses:
    """The contact at places of a cam; every array is shaped like the places.

    phi : rad;  force : normal [N]
    profile_radius : rho - roller radius of the working profile [mm]: positive convex, negative concave, inf flat
    peak_pressure : MPa, 0 without contact;  half_width : mm; both NaN where the follower undercuts the profile
    """

    phi: Floats
    force: Floats
    profile_radius: Floats
    peak_pressure: Floats
    half_width: Floats


@renamed(greatest="max_pressure", least_width="min_width")
@dataclass(frozen=True)
class ContactStress(Plottable):
    """The stress between the follower and the working profile of a cam under forces.

    The profile's radius under a roller is rho - r, so 1/R = 1/(rho - r) + 1/r = 1/(r (1 - kappa r)) on convex, flat and
    concave profiles alike.  The hollows that a roller leaves are wider than itself.  A flat face is not curved, so R is
    the profile's radius r0 + s + a.

    Raises
    ------
    DesignError : the follower has a knife edge

    >>> from math import degrees, radians
    >>> import graphcam as gc
    >>> motion = gc.Motion([gc.Rise(30, radians(120)), gc.Dwell(radians(60)), gc.Return(30, radians(120)),
    ...     gc.Dwell(radians(60))])
    >>> cam = gc.Cam(motion, gc.Translating(offset=10, roller_radius=12), prime_radius=50)
    >>> forces = gc.CamForces(cam, gc.SpringLoad(mass=0.5, speed_rpm=300, stiffness=4, preload=100))
    >>> stress, phi, _ = gc.ContactStress(forces, gc.RollerContact(width=15)).max_pressure()
    >>> round(stress, 3), round(degrees(phi), 3)
    (228.67, 189.467)
    """

    _drawn_in = "force_curves.plot_stress"

    forces: CamForces
    contact: RollerContact

    def __repr__(self) -> str:
        try:
            most = self.max_pressure()
        except DesignError as error:
            return f"{parts_text(self)}\n  {error}"
        return f"{parts_text(self)}\n  maximum pressure: {most.value:.4g} MPa at {math.degrees(most.phi):.4g} degrees"

    def __post_init__(self) -> None:
        check_kind("forces", self.forces, CamForces, remedy=say("CamForces(cam, load) has them"))
        check_kind("contact", self.contact, RollerContact, remedy=say("RollerContact(width=...) gives the width in mm"))
        if self._kinematics.takes_roller and not self._roller > 0:
            reason = say("a knife edge has no line contact: the pressure on it is infinite")
            raise DesignError(say("roller radius"), self._roller, say("greater than 0 mm"), reason)

    @overload
    def at(self, phi: ArrayLike, /, *, side: Side = "right") -> Stresses: ...
    @overload
    def at(self, phase: ArrayLike, u: ArrayLike, side: Side = "right") -> Stresses: ...
    def at(self, phase: ArrayLike, u: ArrayLike | None = None, side: Side = "right") -> Stresses:
        """The contact at cam angles phi [rad], or at fractions of phases, as :meth:`CamForces.at` takes them.

        The fields of what it returns, each an array of that shape: phi [rad], force [N], profile_radius [mm],
        peak_pressure [MPa], half_width [mm].
        """
        return self.of(places_from(self.forces.cam.motion, phase, u, side))

    def of(self, places: Places) -> Stresses:
        """The contact at places that belong to phases."""
        force, modulus = self.forces.normal(places), self.contact.modulus
        relative = self._kinematics.relative_radius(places.values, self._roller)
        sound = np.where(relative > 0, relative, np.nan)
        load = np.maximum(force, 0) / self.contact.width / math.pi
        peak, half_width = np.sqrt(load * modulus / sound), 2 * np.sqrt(load * sound / modulus)
        return Stresses(places.phi, force, self._profile_radius(places.values), peak, half_width)

    def curve(self, parts: int = 60) -> TurnCurve:
        """The peak pressure over the turn [MPa], with ``parts`` points on every smooth piece and both its ends."""
        knots = self.forces.pressing.knots
        return over_turn(self.forces.cam.motion, lambda places: self.of(places).peak_pressure, knots, parts)

    def max_pressure(self) -> ValueAt:
        """The maximum peak pressure over the turn [MPa], both sides of every jump included.

        Raises
        ------
        DesignError : the follower undercuts the profile, the guide jams, or nothing presses
        """
        cam = self.forces.cam
        rho, _ = cam.extremes().min_convex_radius
        if not self._roller < rho:
            raise self._undercut(rho)
        if self.forces.max_normal().value <= 0:
            found = say("nowhere positive")
            raise DesignError(say("contact force"), found, say("greater than 0 N somewhere"), say("preload the spring"))
        squared, phi, side = turn_maximum(cam.motion, self.squared_pressure, self.forces.pressing.knots)
        return ValueAt(math.sqrt(squared), phi, side)

    def contact_at(self, found: ValueAt) -> Stresses:
        """The contact at the place of a peak pressure, such as the maximum: arrays of the shape ()."""
        values = self.forces.cam.motion(found.phi, found.side)
        relative = self._kinematics.relative_radius(values, self._roller)
        # p = E' b/(2 R) and F = pi/2 p b w.
        half_width = 2 * found.value * relative / self.contact.modulus
        force = math.pi / 2 * found.value * half_width * self.contact.width
        peak, phi = np.asarray(found.value), np.asarray(found.phi)
        return Stresses(phi, force, self._profile_radius(values), peak, half_width)

    def min_width(self, permitted: float) -> float:
        """The width [mm] at which the maximum peak pressure is the permitted one [MPa]; p^2 falls as 1/width."""
        check_number(say("permitted stress"), permitted, say("a finite number greater than 0 MPa"), above=0)
        return self.contact.width * (self.max_pressure().value / permitted) ** 2

    def squared_pressure(self, places: Places) -> Floats:
        """The square of the peak pressure [MPa^2] at places inside phases; negative where nothing presses."""
        relative = self._kinematics.relative_radius(places.values, self._roller)
        return self.forces.normal(places) * self.contact.modulus / (math.pi * self.contact.width * relative)

    @property
    def _roller(self) -> float:
        return self.forces.cam.roller_radius

    @property
    def _kinematics(self) -> Kinematics:
        return self.forces.cam.kinematics

    def _profile_radius(self, values: Values) -> Floats:
        with np.errstate(divide="ignore"):
            return np.divide(1.0, self._kinematics.curvature(values)) - self._roller

    def _undercut(self, rho: float) -> DesignError:
        if not self._kinematics.takes_roller:
            limit = say("so large that the minimum radius of curvature, {rho:.6g} mm, is greater than 0 mm", rho=rho)
            quantity = say("prime radius")
            return DesignError(quantity, self.forces.cam.prime_radius, limit, say("enlarge the prime radius"))
        limit = say("less than the minimum radius of curvature of {rho:.6g} mm", rho=rho)
        quantity = say("roller radius")
        return DesignError(quantity, self._roller, limit, say("take a smaller roller or enlarge the prime radius"))
