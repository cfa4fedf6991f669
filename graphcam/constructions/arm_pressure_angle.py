"""The pressure angle of an oscillating follower, from the velocity plan and at every arm position.

v2 = l omega ds/dphi is square to the arm, so the plan v2 = v1 + v21 (follower, cam, follower on cam) turned by 90
degrees has v2 along the arm: l v is laid off from B along the arm to D, outward when cam and arm turn in opposite
senses on the rise, towards the pivot when in the same sense.  The angle of D A with the arm's normal is the pressure
angle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.arm_minimum_radius import arm_positions
from graphcam.constructions.axes import station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.pressure_angle import (
    ANGLES,
    MeasuredGivens,
    angle_at,
    angle_readings,
    shown_station,
    velocity_plan,
)
from graphcam.constructions.views import PLAN, at_scale
from graphcam.drafting.euclid import UP, circles_meet, unit
from graphcam.drafting.ink import Construction, Step, reading, say
from graphcam.drafting.marks import Dots, Label, Line, Mark, Role
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

    integrated : from :func:`~graphcam.constructions.integration.integration`, of an angle s [rad]
    prime_radius, arm, distance : of the cam centre A from the start of the lift and from the pivot [mm]
    mu_l : scale of the drawing [mm/mm]

    Readings at the stations: ``alpha`` and ``transmission`` [rad]; ``psi0`` between arm and line of centres at the
    start of the lift [rad].
    """
    hand = Hand(pencil, MEANING)
    drawn = arm_positions(hand, integrated, rotation, arm, mu_l)
    # The cam centre, where circles about the pivot and about the start of the lift meet: below the arm.
    circles = (
        hand.circle("circle of the centre", drawn.pivot, distance / mu_l.per_mm),
        hand.circle("prime circle", drawn.start, prime_radius / mu_l.per_mm),
    )
    centre = hand.cross("centre", *circles)
    normals = hand.perpendicular("normals", drawn.arms, drawn.tips)
    alpha = hand.angle("alpha", normals, hand.join("rays", drawn.tips, centre))
    hand.read("transmission", reckoned(_transmission, hand.carry(alpha)), 1.0, rounded=False)
    hand.angle("psi0", drawn.rest, hand.join("line of centres", drawn.pivot, centre))
    givens = ArmPressureAngleGivens(integrated, rotation, prime_radius, arm, distance, mu_l)
    return hand.finished(givens, _draw, {"ends": drawn.ends, "tips": drawn.tips, "centre": centre})


def _transmission(alpha: Floats) -> Floats:
    """90 degrees - |alpha|, which some schools read instead."""
    return np.pi / 2 - np.abs(alpha)


# --- the steps -------------------------------------------------------------------------------------------------------

PLAN_ARM = 70.0
"""The plan is drawn at the largest standard scale at which the arm is not longer [mm]."""


def _draw(measured: Construction[ArmPressureAngleGivens]) -> list[Step]:
    k, sigma, arm = shown_station(measured), sense(measured.givens.rotation), measured.givens.arm
    scale = standard_scale(arm, PLAN_ARM)
    plan = at_scale(PLAN, scale)
    shrink = measured.givens.mu_l.per_mm / scale.per_mm
    alpha = float(measured.first("alpha")[k])
    shown = say("α = {alpha:.1f}°", alpha=np.degrees(alpha))
    name = station_names(measured.givens.integrated.givens.stations)[k]
    # Turned so that the line of centres is level, with the cam centre at the origin.
    a = complex(measured.first("centre"))
    places = (measured.first("ends")[k], measured.first("tips")[k], 0j)
    b, d, c = (complex((place - a) * -abs(a) / a * shrink) for place in places)
    v = (d - b) * sigma  # l v along the arm, outwards
    normal = UP * (b - c) / abs(b - c)  # square to the arm, towards the cam
    across, along = sigma * UP * b, -UP * v
    pole = complex(c.real + abs(across) * 0.6 + 12.0, 0.0)
    closed = say(
        "In the plan v₂ = v₁ + v₂₁ the cam's point has v₁ = ω·AB across the radius AB, {across:.1f} mm; the follower "
        "has v₂ square to the arm, {along:.1f} mm; v₂₁ along the profile closes the plan with {closing:.1f} mm."
    ).where(across=abs(across), along=abs(along), closing=abs(along - across))
    side = say("away from the pivot") if abs(d - c) >= abs(b - c) else say("towards the pivot")
    laid_off = say(
        "Turned by 90°, v₂ lies along the arm: {paper:.1f} mm of paper are laid off from B {side} to D, at {ratio} the "
        "segment l·ds/dφ = {length:.2f} mm."
    ).where(paper=abs(v), side=side, ratio=ratio_text(scale.per_mm), length=abs(v) * scale.per_mm)
    found = say(
        "The angle of DA with the arm's normal is the pressure angle at station {name}: {alpha:.2f}°, and the "
        "transmission angle {transmission:.2f}°. Both are measured in every position of the arm."
    ).where(name=name, alpha=np.degrees(alpha), transmission=90 - abs(np.degrees(alpha)))
    angle = (
        Line(np.array([d, 0j]), Role.LIMIT),
        Line(np.array([d, d + 0.7 * abs(d) * normal]), Role.CONSTRUCTION),
        angle_at(d, np.angle(normal), np.angle(-d), 0.6 * abs(d), shown),
    )
    return [
        Step(say("Velocity plan at station {name}", name=name), closed, plan, velocity_plan(pole, across, along)),
        Step(say("The segment along the arm"), laid_off, plan, _mechanism(b, c, d)),
        Step(say("The pressure angle"), found, plan, angle, reads=("psi0", "alpha", "transmission")),
    ]


def _mechanism(b: complex, c: complex, d: complex) -> tuple[Mark, ...]:
    """The arm CB with the segment BD along it, and the line of centres from the cam centre A at the origin."""
    return (
        Line(np.array([0j, c]), Role.AXIS),
        Line(np.array([c, b]), Role.CURVE),
        Line(np.array([b, d]), Role.RESULT),
        Line(np.array([0j, b]), Role.CONSTRUCTION),
        Dots(np.array([0j, b, c, d])),
        Label(0j, "A", towards=-1 - 1j),
        Label(b, "B", towards=1 + 1j),
        Label(c, "C", towards=1 - 1j),
        Label(d, "D", towards=-1 + 1j),
    )
