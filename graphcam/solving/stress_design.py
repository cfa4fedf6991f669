"""What a solution says of the stress between cam and follower: where it is greatest, and whether it is permitted."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any, Literal

from graphcam.constructions.axes import degrees
from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.hertz import ContactStress, Stresses
from graphcam.mechanism.stationary import ValueAt
from graphcam.sheets.tables import Table
from graphcam.showing import by_parts
from graphcam.solving.shown_solution import plain_number
from graphcam.solving.spring_design import at_side
from graphcam.solving.stress_diagram import MEANING, StressOverTurn, in_mpa, stress_steps
from graphcam.solving.warnings import Caution
from graphcam.tasks.material_table import MaterialTable
from graphcam.words import say_in

FLAT = 1e6
"""A profile whose radius is so many times the roller's is told as flat: by then its curvature no longer matters."""
SHAPES = {
    "convex": say_in("a profile", "convex"),
    "concave": say_in("a profile", "concave"),
    "flat": say_in("a profile", "flat"),
}
WITHOUT = {
    "knife edge": say("a knife edge has no width in which to be flattened: the stress is infinite"),
    "undercut": say("the profile is undercut, and ends in an edge there"),
    "no force": say("nothing presses the follower on the cam"),
}
"""Why there is no greatest stress that is finite."""


@dataclass(frozen=True, eq=False)
class StressDesign:
    """The stress of the contact under the forces of a solution.

    chain : of the solution;  forces : on its follower;  material : the task's table
    """

    chain: Chain
    forces: CamForces
    material: MaterialTable
    __repr__ = by_parts

    @cached_property
    def without(self) -> Literal["knife edge", "undercut", "no force"] | None:
        """Why there is no greatest stress, if there is none."""
        cam = self.forces.cam
        if cam.kinematics.takes_roller and not cam.roller_radius > 0:
            return "knife edge"
        if not cam.roller_radius < cam.extremes().min_convex_radius[0]:
            return "undercut"
        return None if self.forces.greatest_normal().value > 0 else "no force"

    @cached_property
    def stress(self) -> ContactStress:
        """Over the turn; only where the follower has no knife edge."""
        return ContactStress(self.forces, self.material())

    @cached_property
    def greatest(self) -> ValueAt | None:
        """The greatest peak pressure [MPa]."""
        return None if self.without else self.stress.greatest()

    @cached_property
    def contact(self) -> Stresses | None:
        """The contact where the stress is greatest."""
        return self.stress.contact_at(self.greatest) if self.greatest else None

    @property
    def permitted(self) -> bool | None:
        """Whether the greatest stress is; None where none is judged."""
        limit = self.material.permitted_stress
        if limit is None or self.without == "no force":
            return None
        return self.greatest is not None and self.greatest.value <= limit

    @property
    def least_width(self) -> float | None:
        """The width of the contact [mm] at which the greatest stress is the permitted one."""
        limit = self.material.permitted_stress
        return None if limit is None or self.greatest is None else self.stress.least_width(limit)

    @property
    def shape(self) -> Literal["convex", "concave", "flat"]:
        """Of the profile where the stress is greatest."""
        assert self.contact is not None
        radius, roller = float(self.contact.profile_radius), self.forces.cam.roller_radius
        if roller and abs(radius) > FLAT * roller:
            return "flat"
        return "convex" if radius > 0 else "concave"

    @property
    def cautions(self) -> Iterator[Caution]:
        """What is to be warned of: a stress that is not permitted."""
        if self.permitted is not False:
            return
        limit = self.material.permitted_stress
        if self.greatest is None:
            said = say("No contact stress is permitted: {why}.", why=WITHOUT[str(self.without)])
            yield Caution(said, "contact stress")
            return
        said = say(
            "The contact stress reaches {stress:.4g} MPa at {phi}; {limit:g} MPa are permitted. Widen the contact to "
            "{width} mm, or enlarge the roller and the prime radius.",
            stress=self.greatest.value,
            phi=degrees(self.greatest.phi),
            limit=limit,
            width=say("{width:.2f}", width=math.ceil((self.least_width or 0.0) * 100) / 100),
        )
        yield Caution(said, "contact stress", (self.greatest.phi,))

    def to_dict(self) -> dict[str, Any]:
        """The results as plain data: MPa, N, mm and degrees."""
        found: dict[str, Any] = {"greatest": None, "without": self.without}
        if self.greatest is not None and (at := self.contact) is not None:
            value, phi, side = self.greatest
            found["greatest"] = {
                "value": value,
                "unit": "MPa",
                "phi_deg": math.degrees(phi),
                "side": side,
                "normal_force": {"value": float(at.force), "unit": "N"},
                "profile_radius": {"value": plain_number(float(at.profile_radius)), "unit": "mm", "shape": self.shape},
                "half_width": {"value": float(at.half_width), "unit": "mm"},
            }
        limit, width = self.material.permitted_stress, self.least_width
        found["permitted"] = limit and {"value": limit, "unit": "MPa", "kept": self.permitted}
        found["least_width"] = width and {"value": width, "unit": "mm"}
        return found

    @property
    def drawn(self) -> dict[str, Construction]:
        """The diagram by its name; none where there is no finite stress to draw."""
        if self.greatest is None:
            return {}
        curve, motion = self.stress.curve(), self.forces.cam.motion
        turn = StressOverTurn(motion, curve.phi, curve.values, self.greatest, self.material.permitted_stress)
        return {MEANING.name: Construction(MEANING, turn, self.chain.pencil, {}, {}, stress_steps)}

    def table(self) -> Table:
        """The contact and its results for the sheet."""
        modulus, width = self.material().modulus, self.material.width
        given = (
            (say("width of the contact"), _in_mm(width), ""),
            (say("modulus E′ of both materials"), say("{modulus:.0f} MPa", modulus=modulus), ""),
        )
        rows = (*given, *self._results(), *self._judged())
        found = frozenset(product(range(len(given), len(rows)), (1, 2)))
        return Table(say("Contact stress"), (say("quantity"), say("value"), ""), rows, found)

    def _results(self) -> Iterator[tuple[Caption, Caption, Any]]:
        """The rows of what was found."""
        if self.greatest is None or (at := self.contact) is None:
            yield say("greatest stress"), say("none"), WITHOUT[str(self.without)]
            return
        yield say("greatest stress"), in_mpa(self.greatest.value), at_side(self.greatest)
        yield say("normal force there"), say("{force:.4g} N", force=float(at.force)), ""
        radius = say("∞") if self.shape == "flat" else _in_mm(abs(float(at.profile_radius)))
        yield say("radius of the profile there"), radius, SHAPES[self.shape]
        yield say("half-width of the strip"), _in_mm(float(at.half_width)), ""

    def _judged(self) -> Iterator[tuple[Caption, Caption, Any]]:
        """The rows of what is permitted, if a stress is judged."""
        limit = self.material.permitted_stress
        if limit is not None:
            verdicts: dict[bool | None, Any] = {True: say_in("a stress", "permitted"), False: say("exceeded"), None: ""}
            yield say("permitted stress"), in_mpa(limit), verdicts[self.permitted]
        if self.least_width is not None:
            yield say("least width for it"), _in_mm(self.least_width), ""


def _in_mm(length: float) -> Caption:
    return say("{length:.4g} mm", length=length)
