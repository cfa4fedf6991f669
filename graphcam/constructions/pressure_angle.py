"""The pressure angle, from the velocity plan and at every station.

The velocity plan v2 = v1 + v21 (follower, cam, follower on cam) is similar to the triangle A B C of the mechanism,
with sides at right angles, so A C = ds/dphi.  Laid off from B across the motion, turned from v2 by 90 degrees in the
sense of the cam's rotation, it ends in D; the angle of D A with the motion is the pressure angle.  The profile is not
needed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.views import COMBINED, PLAN, at_scale
from graphcam.drafting.euclid import UP, along_to_circle
from graphcam.drafting.ink import Construction, Reading, Step, Words, reading, say
from graphcam.drafting.marks import AngleMark, Arrow, Dots, Label, Line, Mark, Role, Segments
from graphcam.drafting.meaning import Converges, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import standard_scale
from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import Floats


@dataclass(frozen=True, eq=False)
class MeasuredGivens:
    """A follower's velocity and displacement, and where the cam centre lies [mm]; what every pressure angle needs."""

    integrated: Integrated
    rotation: Rotation
    prime_radius: float


MeasuredAngles = Construction[MeasuredGivens]


@dataclass(frozen=True, eq=False)
class PressureAngleGivens(MeasuredGivens):
    """What lies on the board; see :func:`pressure_angle`."""

    offset: float


ANGLES = {
    "alpha": ReadingMeaning(
        say("pressure angle α"), "α", "rad", converges=Converges("pressure angle", "pressure_angle", "at stations")
    ),
    "transmission": ReadingMeaning(say("transmission angle"), "γ", "rad"),
}
"""The angles at the stations, of any follower."""
MEANING = Meaning(
    "pressure_angle",
    say("Pressure angle"),
    say(
        "The velocity plan and the mechanism contain similar triangles. So the velocity ds/dφ is a length of the "
        "mechanism, and the angle between normal and motion is found without the profile."
    ),
    {**ANGLES, "s0": ReadingMeaning(say("distance s₀"), "s₀", "mm")},
    "report.translating_paragraphs.pressure_angle",
)


def pressure_angle(
    integrated: Integrated, rotation: Rotation, prime_radius: float, offset: float, pencil: Pencil
) -> Construction[PressureAngleGivens]:
    """Measure the pressure angle at every station, with the cam centre at the prime radius and offset [mm].

    integrated : from :func:`~graphcam.constructions.integration.integration`

    Readings at the stations: ``alpha`` [rad], positive on an ordinary rise, and ``transmission`` [rad]; ``s0`` [mm].
    """
    hand = pencil.hand("pressure_angle")
    sigma = sense(rotation)
    s, v, stations = integrated.readings["s"], integrated.readings["v"], integrated.givens.stations
    mu, count = np.asarray(s.scale), stations.u.size
    # The cam centre: on the line at the offset, as far from the start of the lift as the prime radius.
    centre = along_to_circle(-offset / mu + 0j, np.asarray(-UP), 0j, prime_radius / mu)
    segment = v.value / mu[..., None] + hand.dividers(count)
    ends = -sigma * segment + UP * (s.paper + hand.line(count))
    ray = ends - centre[..., None]
    alpha = sigma * np.arctan2(-ray.real, ray.imag) + hand.protractor(count)
    return Construction(
        MEANING,
        PressureAngleGivens(integrated, rotation, prime_radius, offset),
        pencil,
        angle_readings(alpha) | hand.readings(mu, "mm", s0=-centre.imag),
        {"ends": ends, "centre": centre},
        _draw,
    )


def angle_readings(alpha: Floats) -> dict[str, Reading]:
    """The pressure angles [rad], and the transmission angles 90 degrees - |alpha| that some schools read instead."""
    return {"alpha": reading(alpha, 1.0, "rad"), "transmission": reading(np.pi / 2 - np.abs(alpha), 1.0, "rad")}


# --- the steps -------------------------------------------------------------------------------------------------------

PLAN_HEIGHT = 70.0
"""The velocity plan is drawn at the largest standard scale at which the mechanism's triangle is not taller [mm]."""


SLOW = 0.25
"""The plan is not drawn where the follower is slower than this part of its greatest velocity."""


def shown_station(measured: MeasuredAngles) -> int:
    """The station at which the plan is drawn: where the angle is greatest while the follower rises at some speed."""
    # At rest the plan shrinks to a point, though the angle may be greatest there.
    return int(np.argmax(np.where(moving_up(measured), np.abs(measured.first("alpha")), -1.0)))


def moving_up(measured: MeasuredAngles) -> NDArray[np.bool_]:
    """At which stations the follower rises at some speed."""
    integrated = measured.givens.integrated
    motion, stations, v = integrated.givens.motion, integrated.givens.stations, integrated.value("v")
    rising = np.array([motion.phases[k].direction > 0 for k in stations.phase])
    return rising & (v >= SLOW * np.max(v))


def _draw(measured: Construction[PressureAngleGivens]) -> list[Step]:
    k, sigma = shown_station(measured), sense(measured.givens.rotation)
    integrated, mu = measured.givens.integrated, measured.readings["s0"].per_mm
    centre, ends = complex(measured.first("centre")), measured.first("ends")
    scale = standard_scale((ends[k] - centre).imag * mu, PLAN_HEIGHT)
    plan = at_scale(PLAN, scale)
    b = complex(-centre.real, ends[k].imag - centre.imag) * mu / scale.per_mm
    v = float(integrated.value("v")[k]) / scale.per_mm
    alpha = float(measured.first("alpha")[k])
    name = station_names(integrated.givens.stations)[k]
    d, c = b - sigma * v, complex(sigma * v, 0)
    # The plan's pole stands clear of the mechanism's triangle, on the side away from D.
    across, along = sigma * UP * b, UP * v
    pole = complex(max(b.real, c.real, d.real, 0.0) + max(0.0, -across.real) + 22.0, 8.0)
    closed = say(
        "In the plan v₂ = v₁ + v₂₁ the cam's point has v₁ = ω·AB across the radius AB, {across:.1f} mm; the follower "
        "has v₂ along the guide, {along:.1f} mm; v₂₁ along the profile closes the plan with {closing:.1f} mm."
    ).where(across=abs(across), along=abs(along), closing=abs(along - across))
    similar = say(
        "Through the cam centre A the perpendicular to the motion meets the normal in C. The triangle ABC and the plan "
        "have perpendicular sides, so AC = ds/dφ: {length:.1f} mm · {mu:.4g} = {value:.2f} mm/rad."
    ).where(length=abs(c), mu=scale.per_mm, value=abs(c) * scale.per_mm)
    turned = say(
        "AC is laid off from B across the motion, turned from v₂ by 90° in the sense of the rotation, to D. The angle "
        "of DA with the motion is the pressure angle at station {name}: {alpha:.2f}°, and the transmission angle "
        "{transmission:.2f}°."
    ).where(name=name, alpha=np.degrees(alpha), transmission=90 - abs(np.degrees(alpha)))
    everywhere = say(
        "With the adopted cam centre, r₀ = {r0:g} mm and e = {e:g} mm, the rays from A to the ends D of the combined "
        "diagram make the pressure angles with the motion at all stations."
    ).where(r0=measured.givens.prime_radius, e=measured.givens.offset)
    ray = Segments(np.full(1, centre), ends[k : k + 1], Role.CONSTRUCTION)
    rays, reads = (Dots(np.array([centre]), Role.RESULT), ray), ("s0", "alpha", "transmission")
    return [
        Step(say("Velocity plan at station {name}", name=name), closed, plan, velocity_plan(pole, across, along)),
        Step(say("The mechanism's triangle"), similar, plan, _triangle(b, c, sigma)),
        Step(say("The pressure angle"), turned, plan, _angle(b, d, sigma, alpha)),
        Step(say("The pressure angle at every station"), everywhere, COMBINED, rays, reads),
    ]


def _triangle(b: complex, c: complex, sigma: int) -> tuple[Mark, ...]:
    """The triangle of the mechanism, with the cam centre A at the origin, and the guide through B."""
    return (
        Line(np.array([complex(b.real, -6.0), b + 12 * UP]), Role.AXIS),
        Line(np.array([0j, b]), Role.CURVE),
        Line(np.array([0j, c]), Role.CURVE),
        Line(np.array([b + (b - c) * 0.12, c]), Role.CONSTRUCTION),
        Dots(np.array([0j, b, c])),
        Label(0j, "A", towards=-1j - sigma),
        Label(b, "B", towards=1 + 1j),
        Label(c, "C", towards=-1j + sigma),
    )


def _angle(b: complex, d: complex, sigma: int, alpha: float) -> tuple[Mark, ...]:
    """A C laid off from B to D, and the angle of D A with the motion."""
    return (
        Line(np.array([b, d]), Role.CURVE),
        Line(np.array([d, 0j]), Role.LIMIT),
        Line(np.array([d, d - UP * 0.62 * b.imag]), Role.CONSTRUCTION),
        Dots(np.array([d])),
        Label(d, "D", towards=1j - sigma),
        angle_at(d, -np.pi / 2, float(np.angle(-d)), 0.55 * b.imag, say("α = {alpha:.1f}°", alpha=np.degrees(alpha))),
    )


def velocity_plan(pole: complex, across: complex, along: complex) -> tuple[Mark, ...]:
    """The plan from its pole: v₁ across the radius, v₂ along the motion, and v₂₁ that closes it."""
    side = np.sign(across.real)
    return (
        Arrow(pole, pole + across, Role.CURVE),
        Arrow(pole, pole + along, Role.CURVE),
        Arrow(pole + across, pole + along, Role.CURVE),
        Label(pole + across / 2, "v₁", towards=-UP * side),
        Label(pole + along / 2, "v₂", towards=-side),
        Label(pole + (across + along) / 2, "v₂₁", towards=UP + side),
        Label(pole, "p", towards=-1 - 1j),
    )


def angle_at(place: complex, start: float, end: float, radius: float, text: Words) -> AngleMark:
    """The smaller of the two angles between two directions [rad]."""
    turn = (end - start + np.pi) % (2 * np.pi) - np.pi
    first, last = sorted((start, start + turn))
    return AngleMark(place, radius, first, last, text)
