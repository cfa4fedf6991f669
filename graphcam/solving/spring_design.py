"""What a solution says of a spring: contact, forces and their extremes, what is drawn of them, a table of the sheet."""

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np

from graphcam.constructions.axes import degrees, phase_kind
from graphcam.constructions.chain import Chain
from graphcam.drafting.ink import Caption, Construction, say
from graphcam.drafting.scale import unit
from graphcam.given.follower import MM_PER_M
from graphcam.given.spring_load import ArmLoad, LoadCurve, SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.contact import Contact, SpringPreload, spring_preload
from graphcam.mechanism.forces import CamForces, Forces, jamming_margin, mean_torque
from graphcam.mechanism.turn_extremes import ValueAt, places_in, smooth_pieces
from graphcam.sheets.tables import Table
from graphcam.showing import parts_text
from graphcam.solving.solution_warnings import Caution, beside_rows
from graphcam.solving.spring_diagrams import (
    CONTACT_MEANING,
    FORCES_MEANING,
    contact_diagram,
    force_diagrams,
    with_unit,
    without_rounding,
)
from graphcam.solving.turn_diagrams import at_angle, at_side, plain_place, turn_diagrams
from graphcam.words import Words, and_list, sequence

Row = tuple[Words, Words, Words]
PLAIN_POINTS = 12
"""Points of a smooth piece in the plain data."""


@dataclass(frozen=True, eq=False)
class SpringDesign:
    """A follower that a spring holds on the cam of a solution.

    chain, cam : of the solution
    given : the load without a preload that the task leaves open
    open_preload : whether it does: then the least preload is taken
    friction : mu, between cam and follower
    """

    chain: Chain
    cam: Cam
    given: SpringLoad | ArmLoad
    open_preload: bool
    friction: float = 0.0
    __repr__ = parts_text

    @cached_property
    def least(self) -> SpringPreload:
        """The least preload that keeps contact."""
        return spring_preload(self.cam, self.given)

    @property
    def needed(self) -> float:
        """The least preload [N, or N mm], none where contact is kept without one: a spring cannot pull."""
        return max(0.0, self.least.preload)

    @cached_property
    def load(self) -> SpringLoad | ArmLoad:
        """The load with its preload; an open one is what is needed."""
        return replace(self.given, preload=self.needed) if self.open_preload else self.given

    @cached_property
    def forces(self) -> CamForces:
        """The forces under this load."""
        return CamForces(self.cam, self.load, friction=self.friction)

    @cached_property
    def contact(self) -> Contact:
        """The contact under this load; of an arm in torques."""
        return Contact(self.cam.motion, self.forces.pressing)

    @cached_property
    def max_normal(self) -> ValueAt:
        """The greatest force along the contact normal [N]."""
        return self.forces.max_normal()

    @cached_property
    def force_plan(self) -> Construction | None:
        """The force plan at the station of the velocity plan, if that is loaded."""
        return self.chain.board.follower.force_plan(self.chain, self.load, self.chain.pencil, self.friction)

    def check(self) -> None:
        """Check that there is such a design.

        Raises
        ------
        DesignError : the follower jams at the cam, or a spring at a point of an arm passes over the pivot
        """
        CamForces(self.cam, self.given, friction=self.friction).check()

    @property
    def idle(self) -> bool:
        """Whether nothing presses in the lower dwell, though contact is kept: only preload and load act there."""
        motion = self.cam.motion
        low = any(phase_kind(motion, k) == "lower dwell" for k in range(len(motion.phases)))
        return low and not self.load.preload and not self.load.load and not self.lost

    @property
    def lost(self) -> list[Caption]:
        """The intervals of the cam angle in which contact is lost, as captions."""
        return [say("{start} to {end}", start=degrees(start), end=degrees(end)) for start, end in self.contact.lost()]

    @property
    def cautions(self) -> Iterator[Caution]:
        """What is to be warned of: a given preload with which contact is lost."""
        lost, (_, preload, _) = self.contact.lost(), self.units
        if not lost:
            return
        where = [
            say("from {start:.1f}° to {end:.1f}°", start=math.degrees(start), end=math.degrees(end))
            for start, end in lost
        ]
        said = say(
            "Contact is lost {where}: a preload of {needed} keeps it, {given} are given.",
            where=and_list(where),
            needed=with_unit(_rounded_up(self.needed), preload),
            given=say("{value:.12g} {unit}", value=self.load.preload, unit=unit(preload)),
        )
        yield Caution(beside_rows(self.cam.motion, said, self.forces.normal), "contact", tuple(s for s, _ in lost))

    @property
    def units(self) -> tuple[str, str, str]:
        """The units of what presses along the motion, of the preload, and of the stiffness."""
        if isinstance(self.load, SpringLoad):
            return "N", "N", "N/mm"
        return ("N·mm", "N·mm", "N·mm/rad") if self.load.at is None else ("N·mm", "N", "N/mm")

    @property
    def damping_unit(self) -> str:
        """The unit of the damping."""
        return "N·s/m" if isinstance(self.load, SpringLoad) else "N·mm·s/rad"

    @cached_property
    def torques(self) -> tuple[float, ValueAt, ValueAt]:
        """The mean torque on the cam [N mm], the greatest and the least."""
        return mean_torque(self.forces), self.forces.max_torque(), self.forces.min_torque()

    def power(self, torque: float) -> float:
        """The power of the camshaft [W] at a torque [N mm]."""
        return torque * self.load.omega / MM_PER_M

    def to_dict(self) -> dict[str, Any]:
        """The results as plain data: N, N mm and degrees."""
        least, (along, preload, _) = self.contact.min_force(), self.units
        mean, most, fewest = self.torques
        return {
            "least_preload": {"value": self.needed, "unit": preload, "phi_deg": math.degrees(self.least.phi)},
            "preload": {"value": self.load.preload, "unit": preload},
            "least_contact_force": plain_place(least, along),
            "least_normal_force": plain_place(self.forces.min_normal(), "N"),
            "greatest_normal_force": plain_place(self.max_normal, "N"),
            "contact_lost_deg": [[math.degrees(phi) for phi in interval] for interval in self.contact.lost()],
            "friction": self.friction,
            "least_transmission": plain_place(jamming_margin(self.cam, self.friction), ""),
            "torque": {
                "mean": {"value": without_rounding(mean), "unit": "N·mm"},
                "greatest": plain_place(most, "N·mm"),
                "least": plain_place(fewest, "N·mm"),
            },
            "power": {
                "mean": {"value": without_rounding(self.power(mean)), "unit": "W"},
                "greatest": plain_place(most._replace(value=self.power(most.value)), "W"),
            },
            "over_turn": self._over_turn(),
        }

    def _over_turn(self) -> dict[str, list[float]]:
        """What the diagrams show, at points of every smooth piece and both its ends."""
        motion, knots, share = self.cam.motion, self.forces.pressing.knots, np.linspace(0, 1, PLAIN_POINTS + 1)
        phase, u0, u1 = smooth_pieces(motion, knots)
        inside = places_in(motion, phase[:, None], u0[:, None] * (1 - share) + u1[:, None] * share)
        at, ends = self.forces.of(inside), self.forces.of(places_in(motion, phase, u1, "left"))
        columns = {"phi_deg": np.degrees(inside.phi).ravel().tolist()}
        for key, name in PLAIN_FORCE_COLUMNS.items():
            values = getattr(at, name) + 0.0
            values[:, -1] = getattr(ends, name)
            columns[key] = values.ravel().tolist()
        return columns

    @property
    def drawn(self) -> dict[str, Construction]:
        """What is drawn of it by name: the contact function, the forces over the turn, the force plan."""
        pencil = self.chain.pencil
        drawn = (
            turn_diagrams(CONTACT_MEANING, [contact_diagram(self.contact, self.load, idle=self.idle)], pencil),
            turn_diagrams(FORCES_MEANING, force_diagrams(self.forces, self.max_normal, self.torques), pencil),
            self.force_plan,
        )
        return {each.name: each for each in drawn if each}

    def at_stations(self) -> Forces:
        """The forces at the stations of the drawing."""
        stations = self.chain.board.stations
        return self.forces.at(stations.phase, stations.u)

    def table(self) -> Table:
        """The load and its results for the sheet."""
        given, found = self._given_rows(), self._found_rows()
        first = len(given) - (1 if self.open_preload else 0)
        rows = (*given, *found)
        return Table(
            say("Spring"),
            (say("quantity"), say("value"), ""),
            rows,
            frozenset(product(range(first, len(rows)), (1, 2))),
        )

    def _given_rows(self) -> list[Row]:
        load, (_, preload, stiffness) = self.load, self.units
        rows: list[Row] = [
            (say("moving mass"), say("{mass:g} kg", mass=load.mass), "")
            if isinstance(load, SpringLoad)
            else (say("moment of inertia"), say("{inertia:g} kg·mm²", inertia=load.inertia), ""),
            (say("stiffness c"), say("{stiffness:g} {unit}", stiffness=load.stiffness, unit=unit(stiffness)), ""),
        ]
        if self.friction:
            rows.append((say("friction at the cam f₁"), say("{friction:g}", friction=self.friction), ""))
        if load.acceleration:
            value = say("{acceleration:g} rad/s²", acceleration=load.acceleration)
            rows.append((say("angular acceleration ε"), value, ""))
        if load.damping:
            value = say("{damping:g} {unit}", damping=load.damping, unit=unit(self.damping_unit))
            rows.append((say("damping d"), value, ""))
        if isinstance(load.load, LoadCurve):
            least, most = min(load.load.force), max(load.load.force)
            rows.append((say("load P"), say("{least:g} to {most:g} N", least=least, most=most), say("by table")))
        elif load.load:
            rows.append((say("load P"), with_unit(load.load, "N"), ""))
        open_or_not = say("minimum needed") if self.open_preload else say("given")
        return [*rows, (say("preload F₀"), with_unit(load.preload, preload), open_or_not)]

    def _found_rows(self) -> list[Row]:
        least, greatest, (along, preload, _) = self.contact.min_force(), self.max_normal, self.units
        mean, most, fewest = self.torques
        lost, margin = sequence(self.lost, "; "), jamming_margin(self.cam, self.friction)
        contact = say("minimum contact force") if along == "N" else say("minimum contact torque")
        rows: list[Row] = [
            (say("minimum preload"), with_unit(self.needed, preload), at_angle(self.least.phi)),
            (contact, with_unit(without_rounding(least.value), along), at_side(least, self.cam.motion)),
            (say("maximum normal force"), with_unit(greatest.value, "N"), at_side(greatest, self.cam.motion)),
            (say("maximum torque"), with_unit(most.value, "N·mm"), at_side(most, self.cam.motion)),
            (say("minimum torque"), with_unit(fewest.value, "N·mm"), at_side(fewest, self.cam.motion)),
            (say("mean torque"), with_unit(without_rounding(mean), "N·mm"), ""),
            (say("maximum power"), with_unit(self.power(most.value), "W"), at_side(most, self.cam.motion)),
            (say("mean power"), with_unit(without_rounding(self.power(mean)), "W"), ""),
        ]
        if self.friction:
            rows.append(
                (
                    say("minimum transmission τ"),
                    say("{value:.3f}", value=margin.value),
                    at_side(margin, self.cam.motion),
                )
            )
        return [*rows, (say("contact"), say("lost, {where}", where=lost) if self.lost else say("kept"), "")]


PLAIN_FORCE_COLUMNS = {
    "transmission": "transmission",
    "normal_force": "normal",
    "along": "along",
    "side": "side",
    "torque": "torque",
}
"""The columns of the plain data over the turn, and the fields of the forces."""


def _rounded_up(force: float) -> float:
    """The value rounded up to four digits, and no less: with less preload contact is lost."""
    unit_of_last = 10.0 ** (math.floor(math.log10(force)) - 3) if force > 0 else 1.0
    return math.ceil(force / unit_of_last) * unit_of_last
