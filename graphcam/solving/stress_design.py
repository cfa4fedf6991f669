"""What a solution says of the stress between cam and follower: over the turn, where greatest, whether permitted."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any, Literal

import numpy as np

from graphcam.constructions.axes import degrees
from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.scale import unit
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.hertz import ContactStress, Stresses
from graphcam.mechanism.turn_extremes import TurnCurve, ValueAt
from graphcam.sheets.tables import Table
from graphcam.showing import parts_text
from graphcam.solving.shown_solution import plain_number
from graphcam.solving.solution_warnings import Caution, beside_rows, profile_speed
from graphcam.solving.spring_design import PLAIN_POINTS, Row
from graphcam.solving.spring_diagrams import with_unit
from graphcam.solving.turn_diagrams import TurnDiagram, at_side, plain_place, turn_diagrams
from graphcam.tasks.material_table import MaterialTable
from graphcam.words import Words, say_in

STRESS_MEANING = Meaning(
    "contact_stress",
    say("Contact stress"),
    say("Cam and follower touch in a narrow strip. The pressure in its middle decides how long the surfaces last."),
)
STRESS_CAPTION = say(
    "p₀ is the pressure in the middle of the contact by Hertz, from the force along the normal and the curvatures of "
    "profile and follower, at {mu:g} MPa/mm."
)
JUDGED_STRESS_CAPTION = say(
    "p₀ is the pressure in the middle of the contact by Hertz, from the force along the normal and the "
    "curvatures of profile and follower, at {mu:g} MPa/mm. The horizontal line is the permitted stress; "
    "{verdict}."
)
FAR_LIMIT_CAPTION = say(
    "p₀ is the pressure in the middle of the contact by Hertz, from the force along the normal and the curvatures of "
    "profile and follower, at {mu:g} MPa/mm. The permitted stress of {limit:g} MPa lies beyond the diagram."
)
FAR_LIMIT_FACTOR = 3.0
"""A permitted stress of more than so many times the greatest would leave no room for the curve."""
KEPT_CAPTION = say("the curve does not cross it")
PASSED_CAPTION = say("where the curve lies above it, the axis is marked")
ENLARGED_SIZES = {True: say("the roller and the prime radius"), False: say("the prime radius")}
"""What flattens the contact where it is made larger, with a roller and without one."""
FLAT_RADIUS_RATIO = 1e6
"""A profile whose radius is so many times the roller's is told as flat: by then its curvature no longer matters."""
PROFILE_SHAPES = {
    "convex": say_in("a profile", "convex"),
    "concave": say_in("a profile", "concave"),
    "flat": say_in("a profile", "flat"),
}
NO_STRESS_REASONS = {
    "knife edge": say("a knife edge has no width of contact: the stress is infinite"),
    "undercut": say("the profile is undercut, and ends in an edge there"),
    "no force": say("nothing presses the follower onto the cam"),
}
"""Reasons why there is no greatest stress that is finite."""


@dataclass(frozen=True, eq=False)
class StressDesign:
    """The stress of the contact under the forces of a solution.

    chain : of the solution;  forces : on its follower;  material : the task's table
    """

    chain: Chain
    forces: CamForces
    material: MaterialTable
    __repr__ = parts_text

    @cached_property
    def without(self) -> Literal["knife edge", "undercut", "no force"] | None:
        """The reason why there is no greatest stress, if there is none."""
        cam = self.forces.cam
        if cam.kinematics.takes_roller and not cam.roller_radius > 0:
            return "knife edge"
        if not cam.roller_radius < cam.extremes().min_convex_radius[0]:
            return "undercut"
        return None if self.forces.max_normal().value > 0 else "no force"

    @cached_property
    def stress(self) -> ContactStress:
        """The stress over the turn; only where the follower has no knife edge."""
        return ContactStress(self.forces, self.material())

    @cached_property
    def max_pressure(self) -> ValueAt | None:
        """The greatest peak pressure [MPa]."""
        return None if self.without else self.stress.max_pressure()

    @cached_property
    def contact(self) -> Stresses | None:
        """The contact where the stress is greatest."""
        return self.stress.contact_at(self.max_pressure) if self.max_pressure else None

    @property
    def permitted(self) -> bool | None:
        """Whether the greatest stress is; None where none is judged."""
        limit = self.material.permitted_stress
        if limit is None or self.without == "no force":
            return None
        return self.max_pressure is not None and self.max_pressure.value <= limit

    @cached_property
    def min_width(self) -> float | None:
        """The width of the contact [mm] at which the greatest stress is the permitted one."""
        limit = self.material.permitted_stress
        return None if limit is None or self.max_pressure is None else self.stress.min_width(limit)

    @property
    def shape(self) -> Literal["convex", "concave", "flat"]:
        """The shape of the profile where the stress is greatest."""
        assert self.contact is not None
        radius, roller = float(self.contact.profile_radius), self.forces.cam.roller_radius
        if roller and abs(radius) > FLAT_RADIUS_RATIO * roller:
            return "flat"
        return "convex" if radius > 0 else "concave"

    @property
    def cautions(self) -> Iterator[Caution]:
        """What is to be warned of: a stress that is not permitted."""
        if self.permitted is not False:
            return
        if self.max_pressure is None:
            said = say("No contact stress is permitted: {why}.", why=NO_STRESS_REASONS[str(self.without)])
            if self.without == "undercut":
                said = beside_rows(self.forces.cam.motion, said, profile_speed(self.forces.cam))
            yield Caution(said, "contact stress")
            return
        said = say(
            "The contact stress reaches {stress:.4g} MPa at {phi}; {limit:g} MPa are permitted. Widen the contact to "
            "{width:.2f} mm, or enlarge {sizes}.",
            stress=self.max_pressure.value,
            phi=degrees(self.max_pressure.phi),
            limit=self.material.permitted_stress,
            width=rounded_up(self.min_width or 0.0),
            sizes=ENLARGED_SIZES[self.forces.cam.kinematics.takes_roller],
        )
        limit = self.material.permitted_stress or math.inf
        said = beside_rows(self.forces.cam.motion, said, lambda places: limit**2 - self.stress.squared_pressure(places))
        yield Caution(said, "contact stress", (self.max_pressure.phi,))

    @property
    def drawn(self) -> dict[str, Construction]:
        """The diagram by its name; none where there is no finite stress to draw."""
        return {STRESS_MEANING.name: self._construction} if self._construction else {}

    @cached_property
    def _construction(self) -> Construction | None:
        if self.max_pressure is None:
            return None
        limit, curve = self.material.permitted_stress, self.stress.curve()
        diagram = TurnDiagram(
            "contact_stress",
            say("The contact stress over the turn"),
            say("Contact stress p₀, μ_p = {mu:g} MPa/mm"),
            say("p₀, {unit}", unit=unit("MPa")),
            "MPa",
            self.forces.cam.motion,
            curve,
            self._caption,
            why=say("Surfaces suffer pitting where they are pressed too hard too often."),
            marked=((self.max_pressure, with_unit(self.max_pressure.value, "MPa")),),
            limit=None if limit is None or self._is_limit_far else (limit, with_unit(limit, "MPa")),
            wrong=() if limit is None else tuple(_stretches_above(curve, limit)),
        )
        return turn_diagrams(STRESS_MEANING, [diagram], self.chain.pencil)

    @property
    def _is_limit_far(self) -> bool:
        """Whether the permitted stress lies far above the greatest."""
        limit = self.material.permitted_stress
        return (
            limit is not None and self.max_pressure is not None and limit > FAR_LIMIT_FACTOR * self.max_pressure.value
        )

    @property
    def _caption(self) -> Caption:
        limit = self.material.permitted_stress
        if limit is None:
            return STRESS_CAPTION
        return (
            FAR_LIMIT_CAPTION.with_values(limit=limit)
            if self._is_limit_far
            else JUDGED_STRESS_CAPTION.with_values(verdict=KEPT_CAPTION if self.permitted else PASSED_CAPTION)
        )

    def to_dict(self) -> dict[str, Any]:
        """The results as plain data: MPa, N, mm and degrees."""
        limit, width = self.material.permitted_stress, self.min_width
        found: dict[str, Any] = {
            "greatest": None,
            "without": self.without,
            "permitted": limit and {"value": limit, "unit": "MPa", "kept": self.permitted},
            "least_width": width and {"value": width, "unit": "mm"},
        }
        if self.max_pressure is None or (at := self.contact) is None:
            return found
        there = {
            "normal_force": {"value": float(at.force), "unit": "N"},
            "profile_radius": {"value": plain_number(float(at.profile_radius)), "unit": "mm", "shape": self.shape},
            "half_width": {"value": float(at.half_width), "unit": "mm"},
        }
        curve = self.stress.curve(PLAIN_POINTS)
        over_turn = {"phi_deg": np.degrees(curve.phi).tolist(), "peak_pressure": curve.values.tolist()}
        return found | {"greatest": {**plain_place(self.max_pressure, "MPa"), **there}, "over_turn": over_turn}

    def table(self) -> Table:
        """The contact and its results for the sheet."""
        modulus = self.material().modulus
        given = (
            (say("width of the contact"), with_unit(self.material.width, "mm"), ""),
            (say("modulus E′ of both materials"), say("{modulus:.0f} MPa", modulus=modulus), ""),
        )
        rows = (*given, *self._results(), *self._judged())
        found = frozenset(product(range(len(given), len(rows)), (1, 2)))
        return Table(say("Contact stress"), (say("quantity"), say("value"), ""), rows, found)

    def _results(self) -> Iterator[Row]:
        if self.max_pressure is None or (at := self.contact) is None:
            yield say("maximum stress"), say("none"), NO_STRESS_REASONS[str(self.without)]
            return
        yield (
            say("maximum stress"),
            with_unit(self.max_pressure.value, "MPa"),
            at_side(self.max_pressure, self.forces.cam.motion),
        )
        yield say("normal force there"), with_unit(float(at.force), "N"), ""
        radius = "∞" if self.shape == "flat" else with_unit(abs(float(at.profile_radius)), "mm")
        yield say("radius of the profile there"), radius, PROFILE_SHAPES[self.shape]
        yield say("half-width of the strip"), with_unit(float(at.half_width), "mm"), ""

    def _judged(self) -> Iterator[Row]:
        """The rows of what is permitted, if a stress is judged."""
        limit = self.material.permitted_stress
        if limit is not None:
            verdicts: dict[bool | None, Words] = {True: say_in("a stress", "kept"), False: say("exceeded"), None: ""}
            yield say("permitted stress"), with_unit(limit, "MPa"), verdicts[self.permitted]
        if self.min_width is not None:
            yield say("minimum width for it"), with_unit(self.min_width, "mm"), ""


def rounded_up(width: float) -> float:
    """The size rounded up to hundredths of a millimetre: what is less would not keep to the limit.

    >>> rounded_up(13.741)
    13.75
    """
    return math.ceil(width * 100) / 100


def _stretches_above(curve: TurnCurve, limit: float) -> Iterator[tuple[float, float]]:
    """The stretches of the cam angle [rad] in which a curve passes a limit, straight between its points."""
    over = curve.values - limit
    ends = np.flatnonzero(np.diff(np.concatenate([[False], over > 0, [False]]).astype(np.int8)))
    last = curve.phi.size - 1

    def crossing(before: int, after: int) -> float:
        if not (before >= 0 and after <= last):
            return float(curve.phi[min(max(before, 0), last)])
        share = over[before] / (over[before] - over[after])
        return float(curve.phi[before] + share * (curve.phi[after] - curve.phi[before]))

    for first, beyond in ends.reshape(-1, 2).tolist():
        yield crossing(first - 1, first), crossing(beyond - 1, beyond)
