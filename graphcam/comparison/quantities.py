"""Drawn against exact: the quantities a design ends with, and the values at the stations."""

import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, field
from functools import cached_property, partial
from itertools import product
from typing import Any

import numpy as np

from graphcam.comparison.bounds import DEGREES_PER_RADIAN, Bounds, HonestRange, honest_range
from graphcam.comparison.double_integration import proved_bounds
from graphcam.constructions.arc_chain import ArcChain
from graphcam.constructions.board import Board
from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction, Reading
from graphcam.drafting.meaning import ComparedReading
from graphcam.drafting.slips import PROTRACTOR_RADIUS
from graphcam.errors import DesignError
from graphcam.given.follower import MM_PER_M, omega_of
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion, MovingPhase
from graphcam.mechanism.arc_motion import ArcMotion
from graphcam.mechanism.cam import Cam, CamPoints
from graphcam.mechanism.followers import LeastRadius
from graphcam.mechanism.kinematics import Values
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.mechanism.three_arc_cam import ThreeArcCam
from graphcam.mechanism.turn_extremes import max_acceleration, max_jerk, max_velocity
from graphcam.showing import parts_text
from graphcam.words import Caption, say, sequence

PRINTED_ERROR = 5e-4
"""mm of paper: errors and bounds that differ by less are one in print."""


@dataclass(frozen=True)
class PhaseAtSpeed:
    """One phase: its time [s], and its greatest velocity and acceleration, 0 in a dwell [m/s, m/s^2; an arm: rad/s]."""

    time: float
    max_velocity: float
    max_acceleration: float

    @property
    def greatest(self) -> tuple[float, float]:
        """The greatest velocity and acceleration."""
        return self.max_velocity, self.max_acceleration


def at_speed(motion: Motion, speed_rpm: float, unit: str = "mm") -> list[PhaseAtSpeed]:
    """The phases of a motion at a speed of the cam [rpm]: t = F/omega, v = C_v h omega/F, a = C_a h (omega/F)^2.

    unit : of the lift, "mm" or "rad"

    Source: a solved textbook problem, roller follower, harmonic, lift 50, 120/30/60 degrees, 100 rpm: 0.39 and 0.785
    m/s, 6.17 and 24.67 m/s^2.

    >>> from math import radians
    >>> import graphcam as gc
    >>> rise, back = gc.Rise(50, radians(120), "cosine"), gc.Return(50, radians(60), "cosine")
    >>> motion = gc.Motion([rise, gc.Dwell(radians(30)), back, gc.Dwell(radians(150))])
    >>> [round(phase.max_acceleration, 2) for phase in at_speed(motion, 100)]
    [6.17, 0.0, 24.67, 0.0]
    """
    per_speed = UNITS_PER_SPEED[unit]
    omega = omega_of(speed_rpm)
    phases: list[PhaseAtSpeed] = []
    for phase in motion.phases:
        velocity = acceleration = 0.0
        if isinstance(phase, MovingPhase):
            velocity = phase.normalised.peak_velocity * phase.lift * omega / phase.angle / per_speed
            acceleration = phase.normalised.peak_acceleration * phase.lift * (omega / phase.angle) ** 2 / per_speed
        phases.append(PhaseAtSpeed(phase.angle / omega, velocity, acceleration))
    return phases


@dataclass(frozen=True)
class Quantity:
    """One drawn value beside the exact one.

    drawn, exact : in ``unit``; NaN where there is none
    per_mm : scale of the paper it was read from [unit/mm]
    tolerance_paper : how far the drawn value may lie off [mm of paper, or of the edge of a protractor that measures an
        angle], estimated from redrawings in more parts and by the same pencil
    proved_paper : the same, proved beforehand for a hand without error; NaN where no theorem tells it
    settled : whether the changes by redrawings in more parts fall; else the bound is wider, and rougher
    draw_by_hands : gives the values by many careful hands, in the unit; None where there is no reading
    """

    name: str
    title: Caption
    drawn: float
    exact: float
    unit: str
    per_mm: float
    tolerance_paper: float
    proved_paper: float = math.nan
    settled: bool = True
    draw_by_hands: Callable[[], Floats] | None = field(default=None, repr=False, compare=False)

    @property
    def exists(self) -> bool:
        """Whether the follower has the quantity."""
        return math.isfinite(self.drawn) or math.isfinite(self.exact)

    @property
    def error(self) -> float:
        """Drawn less exact [unit]."""
        return self.drawn - self.exact

    @property
    def error_paper(self) -> float:
        """The error on the paper [mm]."""
        return self.error / self.per_mm

    @cached_property
    def by_hands(self) -> Floats:
        """The values that many careful hands read [unit], drawn when they are asked for; none without a reading."""
        return self.draw_by_hands() if self.draw_by_hands else np.array([])

    @property
    def honest(self) -> HonestRange:
        """The range of the honest answers [unit]: of who draws with care, and of who computes."""
        return honest_range(self.drawn, self.by_hands, self.per_mm, self.exact)

    @property
    def is_beyond_bound(self) -> bool:
        """Whether drawn and exact differ by more than is estimated, or than is proved, so that it shows in print."""
        off = abs(self.error_paper) - PRINTED_ERROR
        return off > self.tolerance_paper or off > self.proved_paper


def exact_minimum(board: Board) -> LeastRadius:
    """The exact minimum prime radius of what lies on a board.

    Raises
    ------
    DesignError : no prime radius satisfies the limits
    """
    follower = board.follower.built(board.follower.place, 0.0)
    conditions: dict[str, Any] = asdict(board.limits) | dict(board.follower.conditions)
    return minimum_radius(board.motion, follower, board.rotation, **conditions)


@dataclass(frozen=True, eq=False)
class Comparison:
    """A drawn chain and the exact cam with the sizes that were adopted from it."""

    drawn: Chain
    cam: Cam
    __repr__ = parts_text

    @cached_property
    def least(self) -> tuple[float, float]:
        """The exact least prime radius of the task and its place [mm]; NaN where no place keeps all the limits."""
        try:
            least = exact_minimum(self.drawn.board)
        except DesignError:  # an arm at a given distance; the cam itself may be given all the same
            return math.nan, math.nan
        return least.prime_radius, least.place

    @cached_property
    def bounds(self) -> Bounds:
        """How far the drawn values may be off."""
        return Bounds(self.drawn)

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """The quantities by name; of a sampled pencil the first drawing is compared."""
        return quantities_of(self.drawn, self.bounds, self.exact, self.proved)

    @cached_property
    def proved(self) -> Mapping[str, float]:
        """The bounds that are proved beforehand, by name, in machine units; none for a hand that errs."""
        board = self.drawn.board
        return proved_bounds(board.motion, board.stations) if self.drawn.pencil.perfect else {}

    @cached_property
    def exact(self) -> Mapping[str, float]:
        """The exact counterparts by name, in the order in which they are told."""
        board, extremes = self.drawn.board, self.cam.extremes()
        least, place = self.least
        rho = extremes.min_convex_radius[0]
        # A corner limits no roller: none can follow it.
        limiting = math.inf if board.motion.corners else rho
        by_rule = min(term(rho=limiting, r0=self.cam.prime_radius) for term in board.roller_rule)
        return {
            "max_v": max_velocity(board.motion),
            "max_a": max_acceleration(board.motion),
            **({} if board.jerk_pole is None else {"max_j": max_jerk(board.motion)}),
            "minimum_prime_radius": least,
            "minimum_offset": place,
            "minimum_distance": place,
            "max_pressure_angle_rise_deg": math.degrees(extremes.pressure_angle_rise[0]),
            "max_pressure_angle_return_deg": math.degrees(extremes.pressure_angle_return[0]),
            "min_pitch_curvature_radius": rho,
            "roller_radius": by_rule if board.roller_radius is None else board.roller_radius,
            **self.cam.kinematics.face_ends(board.motion),
            "lift": math.degrees(board.motion.lift) if board.follower.unit == "rad" else board.motion.lift,
            "rise_deg": math.degrees(board.motion.phases[0].angle),
            # Of these the errors are followed over the number of parts; they are not told.
            "max_pressure_angle_rise": extremes.pressure_angle_rise[0],
            "min_moving_curvature_radius": extremes.min_convex_radius_moving[0],
        }

    def phases(self, speed_rpm: float | None) -> list[PhaseAtSpeed]:
        """Times, velocities and accelerations of the phases at a speed; empty without one."""
        return at_speed(self.cam.motion, speed_rpm, self.drawn.board.follower.unit) if speed_rpm else []

    @cached_property
    def exact_stations(self) -> CamPoints:
        """The exact cam at the stations, each seen from its phase."""
        stations = self.drawn.board.stations
        return self.cam.at(stations.phase, stations.u)

    @cached_property
    def drawn_stations(self) -> Mapping[str, Floats]:
        """What was read at the stations: s, v, a, pressure angle [rad], pitch x and y."""
        count = self.drawn.board.stations.u.size
        sources = {"integration": ("s", "v", "a"), "pressure_angle": ("alpha",), "inversion": ("x", "y")}
        return {
            name: self.drawn[construction].value(name) if construction in self.drawn else np.full(count, np.nan)
            for construction, names in sources.items()
            for name in names
        }


def transmission_deg(alpha: Floats) -> Floats:
    """The transmission angles 90 - |alpha| [degrees] at pressure angles [rad], which some schools tell instead.

    >>> transmission_deg(np.radians([-30.0, 0.0])).round(9).tolist()
    [60.0, 90.0]
    """
    return 90.0 - np.abs(np.degrees(alpha))


NONE: Mapping[str, float] = {}


def quantities_of(
    drawn: Mapping[str, Construction], bounds: Bounds, exact: Mapping[str, float], proved: Mapping[str, float] = NONE
) -> dict[str, Quantity]:
    """What the constructions say that their readings are compared as, in the order of the exact counterparts.

    exact, proved : the exact values and the proved bounds by name
    """
    found = [
        (said.exact or said.name, _quantity(construction, reading, said, bounds, exact, proved))
        for construction in drawn.values()
        for reading, said in construction.meaning.compared_readings
    ]
    nan, there = math.nan, {quantity.name for _, quantity in found}
    missing = {
        name: Quantity(name, sequence([name]), nan, nan, unit, nan, nan) for name, unit in COMMON_QUANTITIES.items()
    }
    found += [(name, quantity) for name, quantity in missing.items() if name not in there]
    order = list(exact)
    return {quantity.name: quantity for _, quantity in sorted(found, key=lambda pair: order.index(pair[0]))}


def _quantity(
    construction: Construction,
    reading: str,
    said: ComparedReading,
    bounds: Bounds,
    exact: Mapping[str, float],
    proved: Mapping[str, float],
) -> Quantity:
    counterpart = said.exact or said.name
    if counterpart not in exact:
        raise DesignError(say("exact counterpart"), counterpart, say("one of {names}", names=", ".join(exact)))
    read = construction.readings[said.sides or reading]
    size, unit = told_unit(read)
    factor = size * said.sign
    side = (side_of(exact[counterpart]),) if said.sides else ()
    if said.candidates:
        bound = bounds.of_choice(construction.name, said.candidates, said.ranks)
    else:
        bound = max(float(bounds.of(construction.name, each)[side]) for each in (said.sides or reading, *said.beside))
    drawn = factor * float(construction.value(said.sides or reading)[side])
    asked = construction.name, said.sides or reading, side[0] if side else None
    title = said.title or construction.meaning.reading(reading).title
    # An angle that is measured itself is read at the edge of the protractor.
    radius = PROTRACTOR_RADIUS if read.unit == "rad" and read.per_mm == 1 else 1.0
    per_mm, bound = factor * read.per_mm / radius, bound * radius
    settled = bool(bounds.settled(construction.name, said.sides or reading)[side])
    by_hands = partial(_by_hands, bounds, asked, factor)
    beforehand = proved.get(said.name, math.nan) / abs(per_mm)
    return Quantity(said.name, title, drawn, exact[counterpart], unit, per_mm, bound, beforehand, settled, by_hands)


def _by_hands(bounds: Bounds, asked: tuple[str, str, int | None], factor: float) -> Floats:
    return factor * bounds.by_hands(*asked)


def told_unit(reading: Reading) -> tuple[float, str]:
    """The unit in which a reading is told, and how many of it make the one it is read in: angles are in degrees."""
    return (DEGREES_PER_RADIAN, "deg") if reading.unit == "rad" else (1.0, reading.unit)


def side_of(extreme: float) -> int:
    """The index of a signed value's extreme of greatest magnitude in a pair: 0 for the highest, 1 for the lowest."""
    return 0 if extreme >= 0 else 1


COMMON_QUANTITIES: Mapping[str, str] = {
    **dict.fromkeys(("minimum_prime_radius", "minimum_offset", "roller_radius"), "mm"),
    **dict.fromkeys(("max_pressure_angle_rise_deg", "max_pressure_angle_return_deg"), "deg"),
}
"""The quantities that every solution names, though its follower may not have them, and their units."""


# --- a cam of three arcs ---------------------------------------------------------------------------------------------

POINT_NAMES = ("C1", "C2", "C3", "F")
JOINT_READINGS = ("a_A", "a_G_before", "a_G_after", "a_F_before", "a_F_after", "a_D")
"""The accelerations at the two ends of every arc, in order."""


@dataclass(frozen=True, eq=False)
class ArcsComparison:
    """A drawn cam of arcs, the exact one, and what the roller does on it."""

    drawn: ArcChain
    cam: ThreeArcCam
    motion: ArcMotion
    __repr__ = parts_text

    @cached_property
    def bounds(self) -> Bounds:
        """How far the drawn values may be off."""
        return Bounds(self.drawn)

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """The quantities by name; of a sampled pencil the first drawing is compared."""
        return quantities_of(self.drawn, self.bounds, self.exact)

    @cached_property
    def exact(self) -> Mapping[str, float]:
        """The exact counterparts by name, in the order in which they are told."""
        cam, motion = self.cam, self.motion
        steepest, radii = math.degrees(motion.max_pressure_angle()[0]), (cam.rho1, cam.rho2, cam.rho3)
        joints = zip(JOINT_READINGS, product(range(3), (0.0, 1.0)), strict=True)
        return {
            "max_v": motion.max_velocity()[0],
            "max_a": motion.max_acceleration()[0],
            # The least radius is not asked for: these are here because every solution has them.
            **dict.fromkeys(("minimum_prime_radius", "minimum_offset"), math.nan),
            "max_pressure_angle_rise_deg": steepest,
            "max_pressure_angle_return_deg": -steepest,
            "min_pitch_curvature_radius": min(motion.prime_radius, *(rho + motion.roller_radius for rho in radii)),
            **{name: getattr(motion, name) for name in ("roller_radius", "lift", "prime_radius")},
            **{f"{name}_{axis}": float(getattr(cam, name)[k]) for name in POINT_NAMES for k, axis in enumerate("xy")},
            **{name: getattr(cam, name) for name in ("rho2", "rho3")},
            **{f"phi_{name}_deg": math.degrees(motion.edges[k]) for k, name in enumerate("GFD", 1)},
            **{name: float(motion.at(np.array(arc), np.array(u))[1][2]) for name, (arc, u) in joints},
        }

    @cached_property
    def exact_stations(self) -> tuple[Floats, Values, Floats, Floats]:
        """Exact at the stations: cam angle [rad], (s, v, a, j), pressure angle [rad], pitch curve (m, 2)."""
        stations, motion = self.drawn.stations, self.motion
        phi, values = motion.at(stations.arc, stations.u)
        alpha: Floats = np.arctan2(values[1], motion.prime_radius + values[0])
        return phi, values, alpha, motion.pitch_curve(phi)

    @cached_property
    def drawn_stations(self) -> Mapping[str, Floats]:
        """What was read at the stations: s, v, a, pressure angle [rad], pitch x and y."""
        return {name: self.drawn["arc_roller"].value(name) for name in ("s", "v", "a", "alpha", "x", "y")}


UNITS_PER_SPEED = {"mm": MM_PER_M, "rad": 1.0}
"""How many units of the lift make the one in which speeds are told: a metre, or for an arm a radian."""
