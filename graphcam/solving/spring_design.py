"""What a solution says of a spring: contact over the turn, forces, the force plan, a view and a table of the sheet."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise, product
from typing import Any

import numpy as np

from graphcam.constructions.axes import axes_over_phi, degrees, degrees_below, phase_ends, phase_symbol, reach
from graphcam.constructions.chain import Chain
from graphcam.constructions.force_plan import round_scale
from graphcam.constructions.graduation import graduated
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Caption, Construction, Step, View, say
from graphcam.drafting.marks import Dots, Label, Line, Role, Segments
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.scale import Scale
from graphcam.given.motion import FULL_TURN
from graphcam.given.spring_load import SpringLoad
from graphcam.mechanism.cam import Cam
from graphcam.mechanism.contact import Contact, SpringPreload, spring_preload
from graphcam.mechanism.forces import CamForces
from graphcam.mechanism.stationary import ValueAt
from graphcam.sheets.tables import Table
from graphcam.showing import by_parts
from graphcam.words import sequence

CONTACT_MEANING = Meaning(
    "contact",
    say("Contact force"),
    say("A spring presses the follower on the cam, but no cam can pull: where it would have to, contact is lost."),
    calculation="report.note.contact",
)
CONTACT = View("contact", say("Contact force ξ"), across="contact phi", up="contact force")
WIDTH = 120.0
"""A turn is this long on paper [mm]."""
OVERHANG = 6.0
"""How far the axes run on beyond the curve [mm]."""


@dataclass(frozen=True, eq=False)
class SpringDesign:
    """A follower that a spring holds on the cam of a solution.

    chain, cam : of the solution
    given : the load without a preload that the task leaves open
    open_preload : whether it does: then the least preload is taken
    """

    chain: Chain
    cam: Cam
    given: SpringLoad
    open_preload: bool
    __repr__ = by_parts

    @cached_property
    def least(self) -> SpringPreload:
        """The least preload that keeps contact."""
        load = self.given
        return spring_preload(self.cam.motion, load.mass, load.speed_rpm, load.stiffness)

    @property
    def needed(self) -> float:
        """The least preload [N], none where contact is kept without one: a spring cannot pull."""
        return max(0.0, self.least.preload)

    @cached_property
    def load(self) -> SpringLoad:
        """The load with its preload; an open one is what is needed."""
        return replace(self.given, preload=self.needed) if self.open_preload else self.given

    @cached_property
    def contact(self) -> Contact:
        """The contact under this load."""
        return Contact(self.cam.motion, self.load)

    @cached_property
    def forces(self) -> CamForces:
        """At the contact."""
        return CamForces(self.cam, self.load)

    @cached_property
    def greatest_normal(self) -> ValueAt:
        """The greatest force along the contact normal [N]."""
        return self.forces.greatest_normal()

    @cached_property
    def force_plan(self) -> Construction | None:
        """The force plan of a translating follower at the station of its velocity plan, if that is loaded."""
        return self.chain.board.follower.force_plan(self.chain, self.load, self.chain.pencil)

    @property
    def lost(self) -> list[Caption]:
        """Between which cam angles contact is lost."""
        return [say("{start} to {end}", start=degrees(start), end=degrees(end)) for start, end in self.contact.lost()]

    def to_dict(self) -> dict[str, Any]:
        """The results as plain data: N and degrees."""
        least, greatest = self.contact.least_force(), self.greatest_normal
        return {
            "least_preload": {"value": self.needed, "unit": "N", "phi_deg": math.degrees(self.least.phi)},
            "preload": {"value": self.load.preload, "unit": "N"},
            "least_contact_force": _at(least),
            "greatest_normal_force": _at(greatest),
            "contact_lost_deg": [[math.degrees(phi) for phi in interval] for interval in self.contact.lost()],
        }

    @property
    def drawn(self) -> dict[str, Construction]:
        """What is drawn of it by name: the contact function, and the force plan."""
        drawn = Construction(CONTACT_MEANING, self.contact, self.chain.pencil, {}, {}, contact_steps)
        return {each.name: each for each in (drawn, self.force_plan) if each}

    def table(self) -> Table:
        """The load and its results for the sheet."""
        least, greatest, load = self.contact.least_force(), self.greatest_normal, self.load
        lost = sequence(self.lost, "; ")
        rows = (
            (say("moving mass"), say("{mass:g} kg", mass=load.mass), ""),
            (say("stiffness c"), say("{stiffness:g} N/mm", stiffness=load.stiffness), ""),
            (say("preload F₀"), _newtons(load.preload), say("least") if self.open_preload else say("given")),
            (say("least preload"), _newtons(self.needed), say("at {phi}", phi=degrees(self.least.phi))),
            (say("least contact force"), _newtons(_clean(least.value)), at_side(least)),
            (say("greatest normal force"), _newtons(greatest.value), at_side(greatest)),
            (say("contact"), say("lost, {where}", where=lost) if self.lost else say("kept"), ""),
        )
        given = 2 if self.open_preload else 3
        found = frozenset(product(range(given, len(rows)), (1, 2)))
        return Table(say("Spring"), (say("quantity"), say("value"), ""), rows, found)


def at_side(found: ValueAt) -> Caption:
    """At which cam angle, and on which side of it where it is a jump."""
    phi = degrees(found.phi)
    return say("just before {phi}", phi=phi) if found.side == "left" else say("just after {phi}", phi=phi)


def _newtons(force: float) -> Caption:
    return say("{force:.4g} N", force=force)


def contact_steps(drawn: Construction[Contact]) -> list[Step]:
    """The contact function xi(phi) of Voloder, Cohodar and Karic, with its least value and where it is negative."""
    contact = drawn.givens
    curve, motion = contact.curve(), contact.motion
    mu_force, mu_phi = round_scale(float(np.abs(curve.force).max())), Scale(FULL_TURN / WIDTH, "rad")
    points = curve.phi / mu_phi.per_mm + UP * curve.force / mu_force.per_mm
    low, high = reach(points.imag)
    ends = phase_ends(motion, mu_phi)
    least = contact.least_force()
    bottom = least.phi / mu_phi.per_mm + UP * least.value / mu_force.per_mm
    axes = (
        *axes_over_phi(WIDTH, mu_phi, points.imag, say("ξ, N")),
        *graduated(points.imag, mu_force.per_mm),
        *degrees_below(WIDTH, mu_phi, low),
        Segments(ends[1:] + low * UP, ends[1:] + high * UP, Role.CONSTRUCTION),
        *(
            Label(complex((a + b) / 2), phase_symbol(motion, k), towards=-UP, small=True)
            for k, (a, b) in enumerate(pairwise(ends))
        ),
    )
    lost = [part for interval in contact.lost() for part in _in_turn(*interval)]
    marks = (
        *axes,
        Line(points, Role.RESULT),
        Dots(np.array([bottom]), Role.LIMIT),
        Label(bottom, _newtons(_clean(least.value)), towards=-UP),
        *(Line(np.array(ends) / mu_phi.per_mm + 0j, Role.LIMIT) for ends in lost),
    )
    mu = {"mu": mu_force.per_mm}
    view = replace(CONTACT, title=say("Contact force ξ, μ = {mu:g} N/mm", **mu))
    return [Step(say("The contact function"), replace(LOST if lost else KEPT, values=mu), view, marks, given=axes)]


LOST = say(
    "ξ = m(aω² + vε) + F₀ + cs is the force with which the cam bears the follower, at {mu:g} N/mm. Where it is "
    "negative, as marked on the axis, the cam would have to pull: contact is lost."
)
KEPT = say(
    "ξ = m(aω² + vε) + F₀ + cs is the force with which the cam bears the follower, at {mu:g} N/mm. It is nowhere "
    "negative: contact is kept."
)


def _in_turn(start: float, end: float) -> list[tuple[float, float]]:
    """An interval that may run over the end of the turn, in parts inside it."""
    return [(start, end)] if end <= FULL_TURN else [(start, FULL_TURN), (0.0, end - FULL_TURN)]


def _at(found: ValueAt) -> dict[str, Any]:
    return {"value": found.value, "unit": "N", "phi_deg": math.degrees(found.phi), "side": found.side}


def _clean(force: float) -> float:
    """A force without the rounding that is left where the least preload makes it zero."""
    return round(force, 9) + 0.0
