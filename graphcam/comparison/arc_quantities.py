"""Drawn against exact for a cam of three circular arcs."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import product

import numpy as np

from graphcam.comparison.bounds import Bounds
from graphcam.comparison.quantities import Quantity, quantities_of
from graphcam.constructions.arc_chain import ArcChain
from graphcam.given.laws import Floats
from graphcam.mechanism.arc_motion import ArcMotion
from graphcam.mechanism.kinematics import Values
from graphcam.mechanism.three_arc_cam import ThreeArcCam
from graphcam.showing import parts_text

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
