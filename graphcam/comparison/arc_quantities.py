"""Drawn against exact for a cam of three circular arcs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from graphcam.comparison.bounds import Bounds
from graphcam.comparison.quantities import DEGREES, Quantity, Source, greatest
from graphcam.constructions.arc_chain import ArcChain
from graphcam.given.laws import Floats
from graphcam.mechanism.arc_motion import ArcMotion
from graphcam.mechanism.arcs import ThreeArcCam
from graphcam.mechanism.kinematics import Values
from graphcam.showing import by_parts
from graphcam.words import say, sequence

POINTS = ("C1", "C2", "C3", "F")
JOINTS = ("a_A", "a_G_before", "a_G_after", "a_F_before", "a_F_after", "a_D")
"""The accelerations at the two ends of every arc, in order."""


@dataclass(frozen=True, eq=False)
class ArcsComparison:
    """A drawn cam of arcs, the exact one, and what the roller does on it."""

    drawn: ArcChain
    cam: ThreeArcCam
    motion: ArcMotion
    __repr__ = by_parts

    @cached_property
    def bounds(self) -> Bounds:
        """How far the drawn values may be off."""
        return Bounds(self.drawn)

    @cached_property
    def quantities(self) -> dict[str, Quantity]:
        """The quantities by name; of a sampled pencil the first drawing is compared."""
        exact = dict.fromkeys(SOURCES, math.nan) | self._exact()
        return {name: source.quantity(name, self.drawn, self.bounds, exact[name]) for name, source in SOURCES.items()}

    def _exact(self) -> dict[str, float]:
        cam, motion = self.cam, self.motion
        steepest, radii = math.degrees(motion.max_pressure_angle()[0]), (cam.rho1, cam.rho2, cam.rho3)
        joints = zip(JOINTS, product(range(3), (0.0, 1.0)), strict=True)
        return {
            "max_v": motion.max_velocity()[0],
            "max_a": motion.max_acceleration()[0],
            "max_pressure_angle_rise_deg": steepest,
            "max_pressure_angle_return_deg": -steepest,
            "min_pitch_curvature_radius": min(motion.prime_radius, *(rho + motion.roller_radius for rho in radii)),
            **{name: getattr(motion, name) for name in ("roller_radius", "lift", "prime_radius")},
            **{name: getattr(cam, name) for name in ("rho2", "rho3")},
            **{f"{name}_{axis}": float(getattr(cam, name)[k]) for name in POINTS for k, axis in enumerate("xy")},
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


OF_ARCS: Mapping[str, Source] = {
    **{f"{p}_{axis}": Source(sequence([p, axis]), "three_arcs", f"{p}_{axis}") for p in POINTS for axis in "xy"},
    "rho2": Source(say("ρ₂"), "three_arcs", "rho2"),
    "rho3": Source(say("ρ₃"), "three_arcs", "rho3"),
}
SOURCES: Mapping[str, Source] = {
    "max_v": greatest(say("greatest v"), "arc_diagrams", "v"),
    "max_a": greatest(say("greatest a"), "arc_diagrams", "a"),
    # The least radius is not asked for: these are here because every solution has them.
    "minimum_prime_radius": Source(say("least radius r₀"), "three_arcs", "minimum_prime_radius", "mm"),
    "minimum_offset": Source(say("its offset e"), "three_arcs", "minimum_offset", "mm"),
    "max_pressure_angle_rise_deg": greatest(say("greatest α, rise"), "arc_diagrams", "alpha", DEGREES, "deg"),
    "max_pressure_angle_return_deg": greatest(say("greatest α, return"), "arc_diagrams", "alpha", -DEGREES, "deg"),
    "min_pitch_curvature_radius": Source(say("least ρ"), "arc_roller", "rho"),
    "roller_radius": Source(say("roller radius"), "arc_roller", "roller_radius"),
    "lift": Source(say("lift"), "arc_roller", "lift"),
    "prime_radius": Source(say("prime radius r₀"), "arc_roller", "prime_radius"),
    **OF_ARCS,
    **{
        f"phi_{name}_deg": Source(say("φ at {point}", point=name), "arc_roller", reading, "deg", DEGREES)
        for name, reading in (("G", "phi_G"), ("F", "phi_F"), ("D", "rise"))
    },
    "a_A": Source(say("a in {point}", point="A"), "arc_roller", "a_A"),
    **{
        f"a_{point}_{key}": Source(
            say("a in {point}, {side}", point=point, side=side), "arc_roller", f"a_{point}_{key}"
        )
        for point in "GF"
        for key, side in (("before", say("before")), ("after", say("after")))
    },
    "a_D": Source(say("a in {point}", point="D"), "arc_roller", "a_D"),
}
