"""Drawn against exact: the quantities a design ends with, and the values at the stations."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from functools import cached_property
from typing import Any

import numpy as np

from graphcam.comparison.bounds import Bounds, Rank
from graphcam.comparison.speed import PhaseAtSpeed, at_speed
from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Construction
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.mechanism.cam import Cam, CamPoints
from graphcam.mechanism.flat_faced import face_width
from graphcam.mechanism.least_radius import minimum_radius
from graphcam.mechanism.peaks import max_acceleration, max_velocity
from graphcam.showing import by_parts
from graphcam.words import Caption, say


@dataclass(frozen=True)
class Quantity:
    """One drawn value beside the exact one.

    drawn, exact : in ``unit``; NaN where there is none
    per_mm : scale of the paper it was read from [unit/mm]
    tolerance_paper : how far the drawn value may lie off [mm of paper], from the number of parts and the pencil
    """

    name: str
    title: Caption
    drawn: float
    exact: float
    unit: str
    per_mm: float
    tolerance_paper: float

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


@dataclass(frozen=True, eq=False)
class Comparison:
    """A drawn chain and the exact cam with the sizes that were adopted from it."""

    drawn: Chain
    cam: Cam
    __repr__ = by_parts

    @cached_property
    def least(self) -> tuple[float, float]:
        """The exact least prime radius of the task and its place [mm]; NaN where no place keeps all the limits."""
        board = self.drawn.board
        follower = board.follower.built(board.follower.place, 0.0)
        conditions: dict[str, Any] = asdict(board.limits) | dict(board.follower.conditions)
        try:
            least = minimum_radius(board.motion, follower, board.rotation, **conditions)
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
        exact = self._exact()
        return {
            name: source.quantity(name, self.drawn, self.bounds, exact[name])
            for name, source in SOURCES.items()
            if name in ALWAYS or source.stands_on(self.drawn)
        }

    def _exact(self) -> Mapping[str, float]:
        board, extremes = self.drawn.board, self.cam.extremes()
        least, place = self.least
        face = face_width(board.motion, board.rotation)
        rho = extremes.min_convex_radius[0]
        by_rule = min(term(rho=rho, r0=self.cam.prime_radius) for term in board.roller_rule)
        return {
            "max_v": max_velocity(board.motion),
            "max_a": max_acceleration(board.motion),
            "minimum_prime_radius": least,
            "minimum_offset": place,
            "minimum_distance": place,
            "max_pressure_angle_rise_deg": math.degrees(extremes.pressure_angle_rise[0]),
            "max_pressure_angle_return_deg": math.degrees(extremes.pressure_angle_return[0]),
            "min_pitch_curvature_radius": rho,
            "roller_radius": by_rule if board.roller_radius is None else board.roller_radius,
            "face_left": face.left,
            "face_right": face.right,
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


Drawings = Mapping[str, Construction]


@dataclass(frozen=True)
class Source:
    """Where on the paper a quantity is read, and its unit where it is not the reading's.

    candidates, rank : the reading that holds what it was chosen from, and how; by default the least is taken
    """

    title: Caption
    construction: str
    reading: str
    unit: str = ""
    factor: float = 1.0
    candidates: str = ""
    rank: Rank = np.negative

    def stands_on(self, chain: Drawings) -> bool:
        """Whether the chain's follower has the quantity."""
        return self.construction in chain and self.reading in chain[self.construction].readings

    def quantity(self, name: str, chain: Drawings, bounds: Bounds, exact: float) -> Quantity:
        """The drawn value beside the exact one; NaN where the follower has no such quantity."""
        if not self.stands_on(chain):
            return Quantity(name, self.title, math.nan, math.nan, self.unit, math.nan, math.nan)
        construction, where = chain[self.construction], (self.construction, self.reading)
        read, drawn = construction.readings[self.reading], self.factor * float(construction.value(self.reading))
        bound = bounds.of_choice(*where, self.candidates, self.rank) if self.candidates else bounds.of(*where)
        return Quantity(name, self.title, drawn, exact, self.unit or read.unit, self.factor * read.per_mm, bound)


DEGREES = math.degrees(1.0)


def greatest(title: Caption, construction: str, name: str, factor: float = 1.0, unit: str = "") -> Source:
    """The greatest of a quantity, read off its diagram."""
    return Source(title, construction, f"max_{name}", unit, factor, f"{name}_candidates", np.abs)


SOURCES: Mapping[str, Source] = {
    "max_v": Source(say("greatest v"), "integration", "max_v"),
    "max_a": Source(say("greatest a"), "integration", "max_a"),
    "minimum_prime_radius": Source(say("least radius r₀"), "minimum_radius", "prime_radius", "mm"),
    "minimum_offset": Source(say("its offset e"), "minimum_radius", "offset", "mm"),
    "minimum_distance": Source(say("its centre distance c"), "minimum_radius", "distance", "mm"),
    "max_pressure_angle_rise_deg": greatest(say("pressure angle, rise"), "angle_diagram", "rise", DEGREES, "deg"),
    "max_pressure_angle_return_deg": greatest(say("pressure angle, return"), "angle_diagram", "return", DEGREES, "deg"),
    "min_pitch_curvature_radius": Source(
        say("least curvature radius ρ"), "curvature", "rho", "mm", candidates="rho_candidates"
    ),
    "roller_radius": Source(say("roller radius"), "roller", "roller_radius", "mm", candidates="candidates"),
    "face_left": Source(say("face to the left"), "inversion", "face_left", "mm"),
    "face_right": Source(say("face to the right"), "inversion", "face_right", "mm"),
}
ALWAYS = tuple(name for name in SOURCES if name not in ("minimum_distance", "face_left", "face_right"))
"""The quantities that every solution names, though a follower may not have them."""
