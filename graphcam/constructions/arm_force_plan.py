"""The force plan of an arm at a station: the load reduced to the arm's end, the contact force and the reaction.

All that turns the arm towards the cam is the torque M about the pivot C.  Reduced to the arm's end B it is the force
Q = M/l square to the arm.  Of the contact force F the direction is known from the arm positions: the normal is parallel
to the line from the cam centre A to D, the end of l v laid off along the arm.  Both act at B and balance about C, so
the reaction R to both passes through B and through C: it lies along the arm.  Three directions and one size are known:
a triangle, drawn parallel to lines that lie on the board.

R is the reaction to F and to the reduced load; what the pivot bears besides, the arm's weight and the forces of its
inertia and of a spring that do not turn it, depends on their places and does not enter F.

Source: reduction of a torque to a point of its link, as in force plans of linkages; the normal as in
:mod:`graphcam.constructions.arm_pressure_angle`.
"""

import math
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from graphcam.constructions import force_plan as plain
from graphcam.constructions.arm_pressure_angle import ArmAngles
from graphcam.drafting.euclid import unit
from graphcam.drafting.hand import Hand, calculated_setting, distance_between
from graphcam.drafting.ink import Caption, Construction, Part, Step, View, say
from graphcam.drafting.marks import Label, Line, Mark, Role
from graphcam.drafting.meaning import ALPHA, ARM, Formula, Meaning, ReadingMeaning, Symbol, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, unit as unit_named
from graphcam.given.laws import Floats
from graphcam.given.spring_load import ArmLoad, PlacedArmLoad
from graphcam.plane_vectors import dot
from graphcam.words import sequence


@dataclass(frozen=True, eq=False)
class ArmForcePlanGivens:
    """What lies on the board; see :func:`arm_force_plan`."""

    measured: ArmAngles
    load: ArmLoad
    station: int
    mu_force: Scale


def _in_equilibrium(plan: Construction[ArmForcePlanGivens]) -> Values:
    """The formula's values, where the triangle closes: torque, pressure angle and forces at the station."""
    load, alpha = float(plan.value("load")), math.radians(abs(plain.alpha_at(plan)))
    arm = plan.givens.measured.givens.arm
    if not math.isnan(float(plan.first("normal"))):
        forces = {"load": load, "normal": load / math.cos(alpha), "reaction": load * math.tan(alpha)}
        yield {**forces, "torque": load * arm, "l": arm, "alpha": math.degrees(alpha), "N": unit_named("N")}


FORMULAS = (
    Formula(
        r"Q = \frac{M}{l}, \qquad F = \frac{Q}{\cos\alpha}, \qquad R = Q\tan|\alpha|",
        r"Q = \frac{<torque:.0f>}{<l:.6g>} = <load:.1f>\ \text{<N>}, \qquad "
        r"F = \frac{<load:.1f>}{\cos <alpha:.2f>^\circ} = <normal:.1f>\ \text{<N>}, \qquad "
        r"R = <load:.1f>\tan <alpha:.2f>^\circ = <reaction:.1f>\ \text{<N>}",
        _in_equilibrium,
        (
            Symbol("Q", say("the load reduced to the arm's end"), "N"),
            Symbol("M", say("the torque about the pivot"), "N·mm"),
            *(ARM, plain.CONTACT_FORCE, ALPHA),
            Symbol("R", say("the reaction of the pivot"), "N"),
        ),
        of="normal",
    ),
)


MEANING = Meaning(
    "force_plan",
    say("Force plan"),
    say(
        "The torque about the pivot, reduced to the arm's end, the contact force and the reaction along the arm "
        "are in equilibrium. Three directions and one magnitude are known, which determine a triangle."
    ),
    {
        "load": ReadingMeaning(say("reduced load Q"), "Q", "N"),
        "normal": ReadingMeaning(say("contact force F"), "F", "N"),
        "along": ReadingMeaning(say("F cos α"), "F cos α", "N"),
        "side": ReadingMeaning(say("F sin α"), "F sin α", "N"),
        "reaction": ReadingMeaning(say("reaction R"), "R", "N"),
    },
    FORMULAS,
)


def arm_force_plan(
    measured: ArmAngles, load: ArmLoad, pencil: Pencil, station: int | None = None, mu_force: Scale | None = None
) -> Construction[ArmForcePlanGivens]:
    """Draw the force plan of an arm at a station, without friction.

    station : None for the one of the velocity plan, or where the load is greatest if hardly any is left there
    mu_force : scale of forces [N/mm]; None for a round one

    Readings are NaN where the load does not press.
    """
    hand, k = Hand(pencil, MEANING), _plan_station(measured, load) if station is None else station
    givens, direction = measured.givens, plain.direction_at(measured, k)
    phi, psi0 = float(givens.integrated.givens.stations.phi[k]), hand.carry(measured.readings["psi0"])
    reduced = partial(_reduced, load, givens.arm, givens.distance, direction, phi)
    force = calculated_setting(reduced, *plain.station_settings(hand, measured, k, "s", "v", "a"), psi0)
    mu = mu_force or plain.round_scale(float(np.median(np.abs(force.amount))))

    # Of the arm positions: the arm C B, and A D.
    pivot, centre = hand.given("pivot"), hand.earlier_places(measured, "centre")
    arm = hand.join("arm", pivot, hand.earlier_places(measured, "ends")[k])
    ray = hand.join("AD", centre, hand.earlier_places(measured, "tips")[k])
    origin = hand.given("origin")
    down = hand.perpendicular("line of Q", arm, origin)
    foot = hand.lay_off("foot", origin, down, calculated_setting(partial(np.multiply, 1 / mu.per_mm), force))
    normal = hand.parallel("line of F", ray, foot)
    along_arm = hand.parallel("line of R", arm, origin)
    corner = plain.third_corner(hand, foot, normal, along_arm, dot(foot.points, down.directions) > 0)
    hand.join("F", foot, corner)
    hand.join("R", corner, origin)
    lengths = {
        "load": distance_between(origin, foot, down),
        "normal": distance_between(foot, corner),
        "along": distance_between(corner, foot, down),
        "side": calculated_setting(np.abs, distance_between(foot, corner, arm)),
        "reaction": distance_between(origin, corner),
    }
    for name, length in lengths.items():
        hand.read(name, length, mu.per_mm)
    directions = {"contact_normal": normal.directions, "across": along_arm.directions}
    return hand.finished(
        ArmForcePlanGivens(measured, load, k, mu), _draw, {"foot": foot, "corner": corner, **directions}
    )


def _reduced(
    load: ArmLoad,
    arm: float,
    distance: float,
    direction: int,
    phi: Floats | float,
    s: Floats,
    v: Floats,
    a: Floats,
    psi0: Floats | float,
) -> Floats:
    """The torque about the pivot over the arm's length [N], from the displacement and its derivatives."""
    return PlacedArmLoad(load, arm, distance, psi0).force((s, v, a, np.zeros_like(s)), direction, phi) / arm


def _plan_station(measured: ArmAngles, load: ArmLoad) -> int:
    """The station of the velocity plan, if the load presses there."""
    givens, integrated = measured.givens, measured.givens.integrated
    s, v, a = (integrated.value(name) for name in ("s", "v", "a"))
    phi, psi0 = integrated.givens.stations.phi, float(measured.first("psi0"))
    return plain.pressed_station(measured, _reduced(load, givens.arm, givens.distance, 1, phi, s, v, a, psi0))


# --- the steps -------------------------------------------------------------------------------------------------------

MIN_REACTION_LENGTH = 30.0
"""The line of the reaction is drawn so long at least [mm]."""


def _draw(plan: Construction[ArmForcePlanGivens]) -> list[Step]:
    return plain.plan_steps(plan, _load, _line_of_force, _line_of_reaction, _not_pressed, _triangle_step)


def _terms(plan: Construction[ArmForcePlanGivens]) -> list[tuple[Caption, float]]:
    """The terms that make up the torque [N mm], each with its name."""
    givens, load = plan.givens.measured.givens, plan.givens.load
    integrated, k = givens.integrated, plan.givens.station
    s, v, a = (np.array(float(integrated.value(name)[k])) for name in ("s", "v", "a"))
    phi, psi0 = float(integrated.givens.stations.phi[k]), float(plan.givens.measured.first("psi0"))
    none = replace(load, inertia=0.0, stiffness=0.0, preload=0.0, load=0.0, damping=0.0)
    inertia, spring = say("inertia {torque:.0f} N·mm"), say("spring {torque:.0f} N·mm")
    if not load.acceleration:
        inertia = say("inertia J·ω²·a = {inertia:g}·{omega:.5g}²·{a:.4g}/1000 = {torque:.0f} N·mm")
    if load.at is None:
        spring = say("spring c·s = {stiffness:g}·{s:.4g} = {torque:.0f} N·mm")
    alone = (
        (inertia.with_values(inertia=load.inertia, omega=load.omega, a=float(a)), replace(none, inertia=load.inertia)),
        (say("preload {torque:.0f} N·mm"), replace(none, preload=load.preload)),
        (spring.with_values(stiffness=load.stiffness, s=float(s)), replace(none, stiffness=load.stiffness)),
        (say("damping {torque:.0f} N·mm"), replace(none, damping=load.damping)),
        (say("load P {torque:.0f} N·mm"), replace(none, load=load.load)),
    )
    reduced = partial(
        _reduced, arm=givens.arm, distance=givens.distance, direction=1, phi=phi, s=s, v=v, a=a, psi0=psi0
    )
    return [(said, givens.arm * float(reduced(part))) for said, part in alone]


def _load(plan: Construction[ArmForcePlanGivens], view: View) -> Step:
    givens, mu = plan.givens.measured.givens, plan.givens.mu_force.per_mm
    terms, integrated, k = _terms(plan), givens.integrated, plan.givens.station
    s, a = float(integrated.value("s")[k]), float(integrated.value("a")[k])
    torque = sum(each for _, each in terms)
    told = sequence(
        [said.with_values(torque=each) for said, each in terms if abs(each) >= plain.READABLE_FORCE * givens.arm]
    )
    values = {"name": plain.station_name(plan), "s": math.degrees(s), "a": a, "arm": givens.arm}
    values |= {"torque": torque, "terms": told}
    values |= {"load": torque / givens.arm, "mu": mu, "paper": abs(torque) / givens.arm / mu}
    values["way"] = say("against the rise") if torque > 0 else say("in the sense of the rise")
    said = say(
        "At station {name} the drawn s = {s:.2f}° and a = {a:.3f} rad/rad² give the torque M = {torque:.0f} N·mm about "
        "C: {terms}. Reduced to the arm's end it is Q = M/l = {torque:.0f}/{arm:g} = {load:.1f} N. At μ_F = {mu:g} "
        "N/mm set the dividers to {paper:.1f} mm, and lay Q off from its tail square to the arm of this station, {way}."
    )
    why = say("A torque about the pivot has the same effect as a force at the arm's end, square to the arm.")
    return plain.load_arrow_step(plan, view, said.with_values(**values), -_corner_direction(plan), why)


def _corner_direction(plan: Construction[ArmForcePlanGivens]) -> complex:
    across, normal = (complex(unit(plan.acts[name].first.directions)) for name in ("line of R", "line of F"))
    return across if (normal * across.conjugate()).real >= 0 else -across


def _line_of_force(plan: Construction[ArmForcePlanGivens], view: View) -> Step:
    normal, up = plan.acts["line of F"].first, -complex(unit(plan.acts["line of Q"].first.directions))
    said = say(
        "In the arm positions lay the set squares along the line from A to D of station {name}. Carry it to the "
        "head of Q and draw the line of the contact force F there; it makes α = {alpha:.1f}° with Q."
    ).with_values(name=plain.station_name(plan), alpha=abs(plain.alpha_at(plan)))
    marks = plain.leaning_line(normal, plain.line_length(float(plan.first("normal"))), plain.alpha_at(plan), up)
    why = say("The contact normal passes through the centre of relative rotation, and A D is parallel to it.")
    return Step(say("The line of the contact force"), (Part(said, (normal,)),), view, marks, why=why)


def _line_of_reaction(plan: Construction[ArmForcePlanGivens], view: View) -> Step:
    line, side = plan.acts["line of R"].first, _corner_direction(plan)
    size = float(plan.first("reaction"))
    reach = MIN_REACTION_LENGTH if math.isnan(size) else max(MIN_REACTION_LENGTH, size + plain.LINE_OVERHANG)
    ends = line.place + side * np.array([-0.3 * MIN_REACTION_LENGTH, reach])
    said = say(
        "With the set squares draw the line of the reaction R through the tail of Q, parallel to the arm CB of station "
        "{name}.",
        name=plain.station_name(plan),
    )
    why = say("F and Q act at B and are in equilibrium about C, so the reaction to both passes through B and C.")
    mark = Line(ends, Role.CONSTRUCTION).left_by(line)
    return Step(say("The line of the pivot's reaction"), (Part(said, (line,)),), view, (mark,), why=why)


def _not_pressed(plan: Construction[ArmForcePlanGivens], view: View) -> Step:
    """The last step where the load does not press, so that there is no third corner."""
    said = say("The two lines do not meet where the cam could push: the load does not press the arm onto the cam.")
    return plain.open_triangle_step(view, said)


def _triangle_step(plan: Construction[ArmForcePlanGivens], view: View) -> Step:
    foot, corner, force, reaction = (plan.acts[name].first for name in ("foot", "corner", "F", "R"))
    corner, side, down = corner[0], _corner_direction(plan), complex(unit(plan.acts["line of Q"].first.directions))
    sides = say(
        "Square to the arm F cos α measures {along_mm:.1f} mm × {mu:g} = {along:.1f} N, and along the arm F sin α "
        "{side_mm:.1f} mm × {mu:g} = {side:.1f} N."
    )
    marks: tuple[Mark, ...] = (
        corner.dots(),
        Label((foot.place + corner.place) / 2, "F", towards=side + down / 2).left_by(force),
        Label(corner.place / 2, "R", towards=-down).left_by(reaction),
    )
    moves = [(plain.CORNER_CAPTION, corner), (plain.UP_TO_CORNER, force), (plain.REACTION_CAPTION, reaction)]
    return plain.triangle_step(plan, view, moves, marks, sides)
