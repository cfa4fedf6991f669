"""The pressure angle, from the velocity plan and at every station.

The velocity plan v2 = v1 + v21 (follower, cam, follower on cam) is similar to the triangle A B C of the mechanism,
with sides at right angles, so A C = ds/dphi.  Laid off from B across the motion, turned from v2 by 90 degrees in the
sense of the cam's rotation, it ends in D; the angle of D A with the motion is the pressure angle.  The profile is not
needed.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.minimum_radius import offset_line, velocities
from graphcam.constructions.views import COMBINED, PLAN, at_scale
from graphcam.drafting.acts import Act, Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Direction, Hand, between, reckoned, showing
from graphcam.drafting.ink import Caption, Construction, Step, Words, say
from graphcam.drafting.marks import AngleMark, Arrow, Label, Line, Mark, Role, Segments
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

    It is positive on an ordinary rise.
    """
    hand = Hand(pencil, MEANING)
    s, start, ends = integrated.readings["s"], hand.given("start of the lift"), velocities(hand, integrated, rotation)
    # The cam centre: on the line at the offset, as far from the start of the lift as the prime radius.
    line = offset_line(hand, start, offset, s)
    prime = hand.circle("prime circle", start, hand.at_scale(prime_radius, s))
    met, touch = hand.cross("circle and line", line, prime), hand.project("touch", start, line)
    # A line that misses the circle, by the hand's errors, is taken to touch it.
    either = hand.take("circle or touch", met, touch, which=np.isnan(met.points).astype(int)[..., None])
    centre = hand.take("centre", either[0])
    read_angles(hand, UP, hand.join("rays", centre, ends), sense(rotation))
    hand.read("s0", between(centre, start, UP), s.scale)
    givens = PressureAngleGivens(integrated, rotation, prime_radius, offset)
    return hand.finished(givens, _draw, {"ends": ends, "centre": centre})


def read_angles(hand: Hand, base: Direction, rays: Drawn, sense: int = 1) -> None:
    """Measure ``alpha``, and find ``transmission``, 90 degrees - |alpha|, that some schools read instead."""
    alpha = hand.angle("alpha", base, rays, sense)
    hand.read("transmission", reckoned(_complement, hand.carry(alpha)), 1.0, rounded=False)


def _complement(alpha: Floats) -> Floats:
    return np.pi / 2 - np.abs(alpha)


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
    centre, end, mu = measured.acts["centre"].first, measured.acts["ends"].first[k], measured.readings["s0"].per_mm
    scale = standard_scale((end.place - centre.place).imag * mu, PLAN_HEIGHT)
    plan, acts = at_scale(PLAN, scale), _plan(measured, k, mu / scale.per_mm)
    pole, v1, v2, v21 = (acts[name] for name in ("p", "v₁", "v₂", "v₂₁"))
    across, along, ac = v1.place - pole.place, v2.place - pole.place, abs(acts["C"].place)
    alpha, name = float(measured.first("alpha")[k]), station_names(measured.givens.integrated.givens.stations)[k]
    closed = say(
        "In the plan v₂ = v₁ + v₂₁ the cam's point has v₁ = ω·AB across the radius AB, {across:.1f} mm; the follower "
        "has v₂ along the guide, {along:.1f} mm; v₂₁ along the profile closes the plan with {closing:.1f} mm."
    ).where(across=abs(across), along=abs(along), closing=abs(along - across))
    similar = say(
        "Through the cam centre A the perpendicular to the motion meets the normal in C. The triangle ABC and the plan "
        "have perpendicular sides, so AC = ds/dφ: {length:.1f} mm · {mu:.4g} = {value:.2f} mm/rad."
    ).where(length=ac, mu=scale.per_mm, value=ac * scale.per_mm)
    turned = say(
        "AC is laid off from B across the motion, turned from v₂ by 90° in the sense of the rotation, to D. The angle "
        "of DA with the motion is the pressure angle at station {name}: {alpha:.2f}°, and the transmission angle "
        "{transmission:.2f}°."
    ).where(name=name, alpha=np.degrees(alpha), transmission=90 - abs(np.degrees(alpha)))
    everywhere = say(
        "With the adopted cam centre, r₀ = {r0:g} mm and e = {e:g} mm, the rays from A to the ends D of the combined "
        "diagram make the pressure angles with the motion at all stations."
    ).where(r0=measured.givens.prime_radius, e=measured.givens.offset)
    ray = Segments(centre.shown, end.shown, Role.CONSTRUCTION, of=measured.acts["rays"].act)
    rays, reads = (centre.dots(Role.RESULT), ray), ("s0", "alpha", "transmission")
    shown = say("α = {alpha:.1f}°", alpha=np.degrees(alpha))
    return [
        Step(say("Velocity plan at station {name}", name=name), closed, plan, velocity_plan(pole, v1, v2, v21)),
        Step(say("The mechanism's triangle"), similar, plan, _triangle(acts, sigma)),
        Step(say("The pressure angle"), turned, plan, _angle(acts, sigma, shown, measured.readings["alpha"].act)),
        Step(say("The pressure angle at every station"), everywhere, COMBINED, rays, reads),
    ]


def _plan(measured: Construction[PressureAngleGivens], k: int, times: float) -> Mapping[str, Drawn]:
    """The triangle of the mechanism at a station, enlarged about the cam centre A, and the plan beside it."""
    hand, sigma, centre = showing(measured), sense(measured.givens.rotation), measured.acts["centre"].first
    a = hand.enlarged("A", centre, centre, times)
    b = hand.enlarged("B", measured.acts["displacements"].first[k], centre, times)
    d = hand.enlarged("D", measured.acts["ends"].first[k], centre, times)
    v, radius = between(b, d), hand.join("AB", a, b)
    # The plan's pole stands clear of the mechanism's triangle, on the side away from D.
    right = max(b.place.real, sigma * float(v.amount), d.place.real, 0.0) + max(0.0, sigma * b.place.imag) + 22.0
    pole = hand.given("p", complex(right, 8.0))
    v1, v2 = hand.lay_off("v₁", pole, radius.turned(sigma * UP), between(a, b)), hand.lay_off("v₂", pole, UP, v)
    normal = hand.perpendicular("normal", hand.join("v₂₁", v1, v2), b)
    c = hand.cross("C", hand.erect("across the motion", a, RIGHT), normal, flat=True)
    for name, start, other in (("AC", a, c), ("BD", b, d), ("DA", d, a)):
        hand.join(name, start, other)
    hand.take("A, B, C", a, b, c)
    hand.erect("motion", d, -UP)
    return hand.acts


def _triangle(acts: Mapping[str, Drawn], sigma: int) -> tuple[Mark, ...]:
    """The triangle of the mechanism, with the cam centre A at the origin, and the guide through B."""
    b, c = acts["B"].place, acts["C"].place
    return (
        Line(np.array([complex(b.real, -6.0), b + 12 * UP]), Role.AXIS),
        *(acts[side].way(Role.CURVE) for side in ("AB", "AC")),
        Line(np.array([b + (b - c) * 0.12, c]), Role.CONSTRUCTION, of=acts["normal"].act),
        acts["A, B, C"].dots(),
        *(acts["A"].label("A", -1j - sigma), acts["B"].label("B"), acts["C"].label("C", -1j + sigma)),
    )


def _angle(acts: Mapping[str, Drawn], sigma: int, shown: Caption, read: Act | None) -> tuple[Mark, ...]:
    """A C laid off from B to D, and the angle of D A with the motion."""
    d, height = acts["D"], acts["B"].place.imag
    return (
        acts["BD"].way(Role.CURVE),
        acts["DA"].way(Role.LIMIT),
        Line(np.array([d.place, d.place - UP * 0.62 * height]), Role.CONSTRUCTION, of=acts["motion"].act),
        *(d.dots(), d.label("D", 1j - sigma)),
        angle_at(d.place, -np.pi / 2, float(np.angle(-d.place)), 0.55 * height, shown, read),
    )


def velocity_plan(pole: Drawn, v1: Drawn, v2: Drawn, v21: Drawn) -> tuple[Mark, ...]:
    """The plan from its pole: v₁ across the radius, v₂ along the motion, and the line v₂₁ that closes it."""
    start, one, other = pole.place, v1.place, v2.place
    side = np.sign((one - start).real)
    return (
        *(v1.arrow(pole, Role.CURVE), v2.arrow(pole, Role.CURVE), Arrow(one, other, Role.CURVE, v21.act)),
        Label((start + one) / 2, "v₁", -UP * side, of=v1.act),
        Label((start + other) / 2, "v₂", -side, of=v2.act),
        Label((one + other) / 2, "v₂₁", UP + side, of=v21.act),
        pole.label("p", -1 - 1j),
    )


def angle_at(place: complex, start: float, end: float, radius: float, text: Words, of: Act | None) -> AngleMark:
    """The smaller of the two angles between two directions [rad]; ``of`` as of every mark."""
    turn = (end - start + np.pi) % (2 * np.pi) - np.pi
    first, last = sorted((start, start + turn))
    return AngleMark(place, radius, first, last, text, of)
