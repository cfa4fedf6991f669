"""The pressure angle of an oscillating follower, from the velocity plan and at every arm position.

v2 = l omega ds/dphi is square to the arm, so the plan v2 = v1 + v21 (follower, cam, follower on cam) turned by 90
degrees has v2 along the arm: l v is laid off from B along the arm to D, outward when cam and arm turn in opposite
senses on the rise, towards the pivot when in the same sense.  The angle of D A with the arm's normal is the pressure
angle.
"""

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.arm_minimum_radius import arm_positions
from graphcam.constructions.axes import station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.pressure_angle import (
    ANGLES,
    MeasuredGivens,
    angle_at,
    read_angles,
    shown_station,
    velocity_plan,
)
from graphcam.constructions.views import PLAN, at_scale
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import UP, circles_meet
from graphcam.drafting.hand import Hand, between, showing
from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.marks import Mark, Role
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, ratio_text, standard_scale
from graphcam.given.follower import Rotation, sense


@dataclass(frozen=True, eq=False)
class ArmPressureAngleGivens(MeasuredGivens):
    """What lies on the board; see :func:`arm_pressure_angle`."""

    arm: float
    distance: float
    mu_l: Scale


MEANING = Meaning(
    "pressure_angle",
    say("Pressure angle"),
    say(
        "The velocity plan and the mechanism contain similar triangles. So the velocity of the arm's end, l·ds/dφ, is "
        "a length along the arm, and the angle between normal and motion is found without the profile."
    ),
    {**ANGLES, "psi0": ReadingMeaning(say("angle ψ₀"), "ψ₀", "rad")},
)


def arm_pressure_angle(
    integrated: Integrated,
    rotation: Rotation,
    prime_radius: float,
    arm: float,
    distance: float,
    mu_l: Scale,
    pencil: Pencil,
) -> Construction[ArmPressureAngleGivens]:
    """Measure the pressure angle at every station.

    integrated : of an angle s [rad]
    prime_radius, distance : of the cam centre A from the start of the lift and from the pivot [mm]
    mu_l : scale of the drawing [mm/mm]
    """
    hand = Hand(pencil, MEANING)
    drawn = arm_positions(hand, integrated, rotation, arm, mu_l)
    pivot, start, tips = drawn["pivot"], drawn["start"], drawn["tips"]
    # The cam centre, where circles about the pivot and about the start of the lift meet: below the arm.
    about_pivot = hand.circle("circle of the centre", pivot, distance / mu_l.per_mm)
    about_start = hand.circle("prime circle", start, prime_radius / mu_l.per_mm)
    # Where a triangle has these sides, circles that miss one another by a hand's errors are taken to touch.
    closes = bool(np.isfinite(circles_meet(np.asarray(0j), distance, np.asarray(-arm + 0j), prime_radius)))
    centre = hand.cross("centre", about_pivot, about_start, flat=closes)
    normals = hand.perpendicular("normals", drawn["arms"], tips)
    read_angles(hand, normals, hand.join("rays", tips, centre))
    hand.angle("psi0", drawn["arm at rest"], hand.join("line of centres", pivot, centre))
    givens = ArmPressureAngleGivens(integrated, rotation, prime_radius, arm, distance, mu_l)
    return hand.finished(givens, _draw, {"ends": drawn["ends"], "tips": tips, "centre": centre})


# --- the steps -------------------------------------------------------------------------------------------------------

PLAN_ARM = 70.0
"""The plan is drawn at the largest standard scale at which the arm is not longer [mm]."""


def _draw(measured: Construction[ArmPressureAngleGivens]) -> list[Step]:
    k, sigma, reading = shown_station(measured), sense(measured.givens.rotation), measured.readings["alpha"]
    scale, alpha = standard_scale(measured.givens.arm, PLAN_ARM), float(np.degrees(measured.first("alpha")[k]))
    plan, name = at_scale(PLAN, scale), station_names(measured.givens.integrated.givens.stations)[k]
    # Turned so that the line of centres is level, with the cam centre at the origin.
    hand, found = showing(measured), {name: left.first for name, left in measured.acts.items()}
    centre, shrink = found["centre"], measured.givens.mu_l.per_mm / scale.per_mm
    turn = -abs(centre.place) / centre.place * shrink
    places = {"A": centre, "B": found["ends"][k], "C": found["pivot"], "D": found["tips"][k], "n": found["normals"][k]}
    a, b, c, d, normal = (hand.enlarged(name, place, centre, turn) for name, place in places.items())
    # The plan stands clear of the mechanism: v₁ lies across the radius, v₂ across the arm.
    pole = hand.given("p", c.place.real + abs(b.place) * 0.6 + 12.0)
    v1 = hand.lay_off("v₁", pole, hand.join("AB", a, b).turned(sigma * UP), between(a, b))
    v2 = hand.lay_off("v₂", pole, hand.join("BD", b, d).turned(-sigma * UP), between(b, d))
    across, along, v21 = v1.place - pole.place, v2.place - pole.place, hand.join("v₂₁", v1, v2)
    closed = say(
        "In the plan v₂ = v₁ + v₂₁ the cam's point has v₁ = ω·AB across the radius AB, {across:.1f} mm; the follower "
        "has v₂ square to the arm, {along:.1f} mm; v₂₁ along the profile closes the plan with {closing:.1f} mm."
    ).where(across=abs(across), along=abs(along), closing=abs(along - across))
    side = say("away from the pivot") if abs(d.place - c.place) >= abs(b.place - c.place) else say("towards the pivot")
    laid_off = say(
        "Turned by 90°, v₂ lies along the arm: {paper:.1f} mm of paper are laid off from B {side} to D, at {ratio} the "
        "segment l·ds/dφ = {length:.2f} mm."
    ).where(paper=abs(along), side=side, ratio=ratio_text(scale.per_mm), length=abs(along) * scale.per_mm)
    measured_angle = say(
        "The angle of DA with the arm's normal is the pressure angle at station {name}: {alpha:.2f}°, and the "
        "transmission angle {transmission:.2f}°. Both are measured in every position of the arm."
    ).where(name=name, alpha=alpha, transmission=90 - abs(alpha))
    ray, long, shown = hand.join("DA", d, a), abs(d.place), say("α = {alpha:.1f}°", alpha=alpha)
    start, end = (float(np.angle(line.directions)) for line in (normal, ray))
    angle = (
        ray.way(Role.LIMIT),
        hand.lay_off("far on the normal", normal, normal, 0.7 * long).line_from(normal, Role.CONSTRUCTION),
        angle_at(d.place, start, end, 0.6 * long, shown, reading.act),
    )
    return [
        Step(say("Velocity plan at station {name}", name=name), closed, plan, velocity_plan(pole, v1, v2, v21)),
        Step(say("The segment along the arm"), laid_off, plan, _mechanism(hand, a, b, c, d)),
        Step(say("The pressure angle"), measured_angle, plan, angle, reads=("psi0", "alpha", "transmission")),
    ]


def _mechanism(hand: Hand, a: Drawn, b: Drawn, c: Drawn, d: Drawn) -> tuple[Mark, ...]:
    """The arm CB with the segment BD along it, and the line of centres from the cam centre A."""
    return (
        c.line_from(a, Role.AXIS),
        hand.join("CB", c, b).way(Role.CURVE),
        hand.join("BD", b, d).way(Role.RESULT),
        hand.join("AB", a, b).way(Role.CONSTRUCTION),
        hand.take("A, B, C, D", a, b, c, d).dots(),
        *(a.label("A", -1 - 1j), b.label("B", 1 + 1j), c.label("C", 1 - 1j), d.label("D", -1 + 1j)),
    )
