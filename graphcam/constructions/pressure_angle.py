"""The pressure angle, from the velocity plan and at every station.

The velocity plan v2 = v1 + v21 (follower, cam, follower on cam) is similar to the triangle A B C of the mechanism,
with sides at right angles, so A C = ds/dphi.  Laid off from B across the motion, turned from v2 by 90 degrees in the
sense of the cam's rotation, it ends in D; the angle of D A with the motion is the pressure angle.  The profile is not
needed.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.adoption import ChainSettings, adoption_step
from graphcam.constructions.axes import sense_caption, station_names
from graphcam.constructions.combined_diagram import (
    combined_length,
    combined_scale,
    combined_view,
    offset_caption,
    offset_line,
    side_caption,
    velocities,
)
from graphcam.constructions.integration import Integrated
from graphcam.constructions.velocity_plan import VelocityScale, velocity_plan
from graphcam.constructions.views import PLAN
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Direction, Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Construction, Part, Step, View, say
from graphcam.drafting.marks import Arc, Line, Mark, Role, angle_at
from graphcam.drafting.meaning import (
    ALPHA,
    OFFSET,
    R0,
    S0,
    SIGMA,
    Formula,
    Meaning,
    ReadingConvergence,
    ReadingMeaning,
    S,
    Symbol,
    V,
    Values,
)
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, coarsest_scale, ratio_text, standard_scale
from graphcam.drafting.telling import run
from graphcam.given.follower import Rotation, sense
from graphcam.given.laws import Floats
from graphcam.words import sequence


@dataclass(frozen=True, eq=False)
class MeasuredGivens(ChainSettings):
    """What every pressure angle needs: velocity and displacement of a follower, and the cam centre's place [mm].

    omega : of the cam [rad/s], where the task gives a speed
    station : whose plan is asked for, None for the one that shows most
    """

    integrated: Integrated
    rotation: Rotation
    prime_radius: float
    omega: float | None = field(default=None, kw_only=True)
    station: int | None = field(default=None, kw_only=True)

    @property
    def path_per_lift(self) -> float:
        """The path of the follower [mm] for a unit of lift: 1, or of an arm its length."""
        return 1.0


MeasuredAngles = Construction[MeasuredGivens]


@dataclass(frozen=True, eq=False)
class PressureAngleGivens(MeasuredGivens):
    """What lies on the board; see :func:`pressure_angle`."""

    offset: float


ANGLE_MEANINGS = {
    "alpha": ReadingMeaning(
        say("pressure angle α"),
        "α",
        "rad",
        converges=ReadingConvergence("pressure angle", "pressure_angle", "at stations"),
    ),
    "transmission": ReadingMeaning(say("transmission angle"), "γ", "rad", judged="least"),
}
"""The angles at the stations, of any follower."""


def _centre_height(measured: Construction[PressureAngleGivens]) -> Values:
    """The formula's values: the place of the cam centre at the adopted sizes."""
    r0, e = measured.givens.prime_radius, abs(measured.givens.offset)
    yield {"r0": r0, "e": e, "s0": math.sqrt(r0**2 - e**2)}


def _worked_values(measured: Construction[PressureAngleGivens]) -> Values:
    givens, k = measured.givens, shown_station(measured)
    s, v = (float(givens.integrated.value(name)[k]) for name in "sv")
    across = sense(givens.rotation) * givens.offset
    s0 = float(measured.value("s0"))
    alpha = math.degrees(math.atan2(v - across, s0 + s))
    yield {"v": v, "less": "-" if across >= 0 else "+", "e": abs(across), "s0": s0, "s": s, "alpha": alpha}


FORMULAS = (
    Formula(
        r"s_0 = \sqrt{r_0^2 - e^2}",
        r"s_0 = \sqrt{<r0:g>^2 - <e:g>^2} = <s0:.2f>\ \text{<mm>}",
        _centre_height,
        (S0, R0, OFFSET),
        of="s0",
    ),
    Formula(
        r"\tan\alpha = \frac{v - \sigma e}{s_0 + s}, \qquad \gamma = 90^\circ - |\alpha|",
        r"\tan\alpha = \frac{<v:.2f> <less> <e:.2f>}{<s0:.2f> + <s:.2f>}, \qquad \alpha = <alpha:.2f>^\circ",
        _worked_values,
        (ALPHA, V, SIGMA, S, Symbol(r"\gamma", say("the transmission angle"), "°")),
        of="alpha",
    ),
)


MEANING = Meaning(
    "pressure_angle",
    say("Pressure angle"),
    say(
        "The velocity plan and the mechanism contain similar triangles. So the velocity ds/dφ is a length of the "
        "mechanism, and the angle between normal and motion is found without the profile."
    ),
    {**ANGLE_MEANINGS, "s0": ReadingMeaning(say("distance s₀"), "s₀", "mm")},
    FORMULAS,
)


def pressure_angle(
    integrated: Integrated, rotation: Rotation, prime_radius: float, offset: float, pencil: Pencil
) -> Construction[PressureAngleGivens]:
    """Measure the pressure angle at every station, with the cam centre at the prime radius and offset [mm].

    It is positive on an ordinary rise.
    """
    hand = Hand(pencil, MEANING)
    start, ends = hand.given("start of the lift"), velocities(hand, integrated, rotation)
    # The cam centre: on the line at the offset, as far from the start of the lift as the prime radius.
    line = offset_line(hand, start, integrated, offset)
    prime = hand.circle("prime circle", start, combined_length(hand, integrated, prime_radius))
    met, touch = hand.cross("circle and line", line, prime), hand.project("touch", start, line)
    # A line that misses the circle, by the hand's errors, is taken to touch it.
    either = hand.take("circle or touch", met, touch, which=np.isnan(met.points).astype(int)[..., None])
    centre = hand.take("centre", either[0])
    read_angles(hand, UP, hand.join("rays", centre, ends), sense(rotation))
    hand.read("s0", distance_between(centre, start, UP), combined_scale(integrated))
    givens = PressureAngleGivens(integrated, rotation, prime_radius, offset)
    return hand.finished(givens, _draw, {"ends": ends, "centre": centre})


def read_angles(hand: Hand, base: Direction, rays: Drawn, sense: int = 1) -> None:
    """Measure ``alpha``, and find ``transmission``, 90 degrees - |alpha|, that some schools read instead."""
    alpha = hand.angle("alpha", base, rays, sense)
    hand.read("transmission", calculated_setting(_complement, hand.carry(alpha)), 1.0, rounded=False)


def _complement(alpha: Floats) -> Floats:
    return np.pi / 2 - np.abs(alpha)


# --- the steps -------------------------------------------------------------------------------------------------------

PLAN_HEIGHT = 70.0
"""The velocity plan is drawn at the largest standard scale at which the mechanism's triangle is not taller [mm]."""
PLAN_MARGINS = complex(50.0, 45.0)
"""What stands beside the triangle and the plan, and between them: letters, the ends of lines, the title [mm]."""
PRIME_ARC_LENGTH = 7.0
"""The compass draws so much of the prime circle to either side of the cam centre [mm]."""
SLOW_SHARE = 0.25
"""The plan is not drawn where the follower is slower than this part of its greatest velocity."""
FLAT_PLAN_SHARE = 0.14
"""The plan is drawn elsewhere if v is less than this part of the prime radius: 10 mm of a plan as tall as usual."""


def shown_station(measured: MeasuredAngles) -> int:
    """The station at which the plan is drawn: where the angle is greatest while the follower rises at some speed.

    Where the plan would be nearly a line there, as at a large offset, it is drawn where the follower is fastest.  Of a
    station that is asked for it is the nearest at which the follower rises at some speed.
    """
    possible, asked = moving_up(measured), measured.givens.station
    if asked is not None:
        return int(np.argmin(np.where(possible, np.abs(np.arange(possible.size) - asked), possible.size + asked)))
    v = np.where(possible, measured.givens.integrated.value("v"), 0.0)
    return int(np.argmax(v)) if _is_flat(measured) else _steepest(measured)


def _steepest(measured: MeasuredAngles) -> int:
    """The station of the greatest angle while the follower rises at some speed."""
    # At rest the plan shrinks to a point, though the angle may be greatest there.
    return int(np.argmax(np.where(moving_up(measured), np.abs(measured.first("alpha")), -1.0)))


def _is_flat(measured: MeasuredAngles) -> bool:
    """Whether the plan would be nearly a line where the angle is largest."""
    givens, v = measured.givens, measured.givens.integrated.value("v")[_steepest(measured)]
    return bool(givens.path_per_lift * v < FLAT_PLAN_SHARE * givens.prime_radius)


def moving_up(measured: MeasuredAngles) -> NDArray[np.bool_]:
    """The stations (n,) at which the follower rises at some speed, as a mask."""
    integrated = measured.givens.integrated
    motion, stations, v = integrated.givens.motion, integrated.givens.stations, integrated.value("v")
    rising = np.array([motion.phases[k].direction > 0 for k in stations.phase])
    return rising & (v >= SLOW_SHARE * np.max(v))


def _draw(measured: Construction[PressureAngleGivens]) -> list[Step]:
    k, mu, decided = shown_station(measured), measured.readings["s0"].per_mm, measured.givens.adopted()
    end, centre = measured.acts["ends"].first[k], measured.acts["centre"].first
    scale = plan_scale(measured, k, (end.place - centre.place) * mu)
    scales = VelocityScale(scale, measured.givens.omega)
    shown = _PlanStation(measured, k, scales, _plan(measured, k, mu / scale.per_mm))
    rounding = [adoption_step(decided, "e", mu, combined_view(measured.givens.integrated))] if decided else []
    return [
        *(*rounding, _cam_centre(measured)),
        *(_mechanism(shown), _velocities(shown), _normal(shown), _angle(shown)),
        _all_stations_step(measured, k),
    ]


def plan_scale(measured: Construction[PressureAngleGivens], k: int, d: complex) -> Scale:
    """The largest standard scale at which the triangle is no taller than usual, and the paper takes the plan beside it.

    d : the end of v, from the cam centre [mm]
    """
    paper, v = measured.givens.paper, sense(measured.givens.rotation) * float(measured.givens.integrated.value("v")[k])
    # v₁ lies across the radius: it is as wide as B lies high.
    triangle = np.ptp([0.0, d.real, v, d.real + v])
    size = complex(float(triangle) + d.imag, max(d.imag, abs(v)))
    usual = coarsest_scale(standard_scale(d.imag, PLAN_HEIGHT, paper.ratios), paper.scale(size, PLAN_MARGINS))
    return paper.kept_scale(PLAN.name) or usual


@dataclass(frozen=True, eq=False)
class _PlanStation:
    """The station at which the plan is drawn, with its scales."""

    measured: Construction[PressureAngleGivens]
    station: int
    scales: VelocityScale
    hand: Hand

    @property
    def mu(self) -> float:
        """The scale of the plan's lengths [mm, or mm/rad, to a mm of paper]."""
        return self.scales.mu_l.per_mm

    @property
    def view(self) -> View:
        """The view of the plan, with its scale in the title."""
        return self.scales.view(self.name)

    @property
    def acts(self) -> Mapping[str, Drawn]:
        """What the acts of the plan left, by their names."""
        return self.hand.acts

    @property
    def name(self) -> str:
        """The name of the station, as "4′"."""
        return station_names(self.measured.givens.integrated.givens.stations)[self.station]

    @property
    def sigma(self) -> int:
        """The sign of the rotation: 1 for a cam that turns counter-clockwise."""
        return sense(self.measured.givens.rotation)


def _plan(measured: Construction[PressureAngleGivens], k: int, times: float) -> Hand:
    """The hand that draws the mechanism's triangle at a station, enlarged about A, with the plan beside it."""
    hand, sigma, centre = errorless_hand(measured), sense(measured.givens.rotation), measured.acts["centre"].first
    low, high = measured.acts["displacements"].first[k], measured.acts["ends"].first[k]

    def enlarged(length: Setting) -> Setting:
        """A length of the diagrams as it is laid off here [mm of paper]."""
        return calculated_setting(partial(np.multiply, times), length)

    a = hand.given("A")
    guide = hand.erect("guide", hand.lay_off("foot", a, RIGHT, enlarged(distance_between(centre, low, RIGHT))))
    b = hand.lay_off("B", guide, UP, enlarged(distance_between(centre, low, UP)))
    v, radius = enlarged(distance_between(low, high)), hand.join("AB", a, b)
    # The plan's pole stands clear of the mechanism's triangle, on the side away from D.
    right = max(b.place.real, b.place.real - sigma * float(v.amount), sigma * float(v.amount), 0.0)
    pole = hand.given("p", complex(right + max(0.0, sigma * b.place.imag) + 22.0, 8.0))
    v1, v2 = (
        hand.lay_off("v₁", pole, radius.turned(sigma * UP), distance_between(a, b)),
        hand.lay_off("v₂", pole, UP, v),
    )
    normal = hand.perpendicular("normal", hand.join("v₂₁", v1, v2), b)
    c = hand.cross("C", hand.erect("across the motion", a, RIGHT), normal, flat=True)
    ac = hand.join("AC", a, c)
    d = hand.lay_off("D", b, ac.turned(-1), distance_between(a, c))
    hand.join("BD", b, d)
    hand.angle("alpha", hand.erect("motion", d, -UP), hand.join("DA", d, a), sigma)
    return hand


def _stroke(drawn: Drawn, start: complex, end: complex, role: Role) -> Line:
    return Line(np.array([start, end]), role).left_by(drawn)


def _cam_centre(measured: Construction[PressureAngleGivens]) -> Step:
    mu, offset, r0 = measured.readings["s0"].per_mm, measured.givens.offset, measured.givens.prime_radius
    centre, prime, line = (measured.acts[name].first for name in ("centre", "prime circle", "line of the offset"))
    displacements, ends = measured.acts["displacements"].first, measured.acts["ends"].first
    radius, towards = float(np.asarray(prime.radius)), float(np.angle(centre.place - prime.place))
    span = towards - PRIME_ARC_LENGTH / radius, towards + PRIME_ARC_LENGTH / radius
    marks: list[Mark] = [
        Arc(prime.place, radius, *span, Role.CONSTRUCTION).left_by(prime),
        *(laid_off.dots(Role.CONSTRUCTION) for laid_off in (displacements, ends)),
        centre.dots(Role.RESULT),
        centre.label(say("A (r₀ = {r0:g}, e = {e:g})", r0=r0, e=offset + 0.0), -1j - np.sign(centre.place.real)),
    ]
    cut = say(
        "Compass {paper:.2f} mm, {r0:g}/{mu:.5g}, about B₀: below it the arc cuts {upright} in A. Measured "
        "vertically, A lies {below:.2f} mm × {mu:.5g} = {s0:.3f} mm = s₀ below B₀."
    )
    upright = say("this vertical") if offset else say("the line of motion itself, as e = 0,")
    read = {"below": float(measured.first("s0")), "s0": float(measured.value("s0"))}
    cut = cut.with_values(upright=upright, paper=r0 / mu, r0=r0, mu=mu, **read)
    combined = say("Work in the combined diagram, with B₀ and the ends of v as laid off there.")
    parts = [Part(combined, (displacements, ends)), Part(cut, (prime, centre))]
    if offset:
        parts.insert(1, Part(offset_caption(offset, mu), (line,)))
        marks.append(_stroke(line, centre.place - 6 * UP, centre.place.real + 6 * UP, Role.AXIS))
    why = say("A lies on the vertical at the offset, and its distance from B₀ is the prime radius.")
    return Step(
        say("The cam centre at the adopted radius"),
        tuple(parts),
        combined_view(measured.givens.integrated),
        tuple(marks),
        ("s0",),
        why=why,
    )


def _mechanism(shown: _PlanStation) -> Step:
    measured, acts, k = shown.measured, shown.acts, shown.station
    a, b, guide, offset = acts["A"], acts["B"], acts["guide"], measured.givens.offset
    taken = say(
        "Take station {name}, where the rays will show the maximum angle of the rise, slow parts of the motion "
        "left aside."
    )
    if measured.givens.station is None and _is_flat(measured):
        taken = say(
            "Take station {name}, where the follower rises fastest; where the angle is at its maximum, the plan would "
            "be too small to draw."
        )
    beside = say("Mark A in a new drawing at {ratio}, and draw the guide vertical through A.")
    if offset:
        beside = say("Mark A in a new drawing at {ratio}, and draw the guide vertical, {paper:.2f} mm {side} of A.")
    taken = taken.with_values(name=shown.name)
    beside = beside.with_values(ratio=ratio_text(shown.mu), paper=abs(b.place.real), side=side_caption(offset))
    s0, s = float(measured.value("s0")), float(measured.givens.integrated.value("s")[k])
    above = say(
        "On the guide mark B, s₀ + s = {s0:.5g} + {s:.5g} = {sum:.5g} mm above A, which is {paper:.2f} mm of paper. "
        "Join A to B: {ab:.2f} mm."
    ).with_values(s0=s0, s=s, sum=s0 + s, paper=b.place.imag, ab=abs(b.place))
    parts = Part(sequence([taken, beside], " "), (a, guide)), Part(above, (b, acts["AB"]))
    marks = (
        _stroke(guide, complex(b.place.real, -6.0), b.place + 12 * UP, Role.AXIS),
        acts["AB"].way(Role.CURVE),
        *(a.dots(), b.dots(), a.label("A", -1j - shown.sigma), b.label("B")),
    )
    why = say("The plan needs AB, the radius on which the point of the cam that drives B turns.")
    return Step(say("The mechanism at station {name}", name=shown.name), parts, shown.view, marks, why=why)


def _velocities(shown: _PlanStation) -> Step:
    pole, v1, v2, v21 = (shown.acts[name] for name in ("p", "v₁", "v₂", "v₂₁"))
    one, two = v1.place - pole.place, v2.place - pole.place
    combined = abs(shown.measured.acts["ends"].first[shown.station].place.real)
    mu_s = shown.measured.readings["s0"].per_mm
    turned = say(
        "Divide all speeds by ω, so 1 mm of the plan is {mu:.5g} mm/rad. From the pole p draw v₁ = AB = {across:.2f} "
        "mm, with set squares square to AB, turned from it {rotation}."
    ).with_values(mu=shown.mu, across=abs(one), rotation=sense_caption(shown.measured.givens.rotation))
    up = say(
        "From p draw v₂ straight up: v of station {name} in the combined diagram, {combined:.2f} mm × {mu_s:.5g} = "
        "{v:.2f} mm/rad, is {paper:.2f} mm here."
    ).with_values(name=shown.name, combined=combined, mu_s=mu_s, v=abs(two) * shown.mu, paper=abs(two))
    closing = say("Join the tip of v₁ to the tip of v₂: v₂₁ measures {closing:.2f} mm.", closing=abs(two - one))
    closing = sequence([closing, *shown.scales.speed_captions(pole, v1, v2)], " ")
    parts = Part(turned, (pole, v1)), Part(up, (v2,)), Part(closing, (v21,))
    why = say(
        "B of the follower moves with the point of the cam under it and also slides along the profile: v₂ = v₁ + v₂₁."
    )
    title = say("Velocity plan at station {name}", name=shown.name)
    return Step(title, parts, shown.view, velocity_plan(pole, v1, v2, v21, shown.scales), why=why)


def _normal(shown: _PlanStation) -> Step:
    b, c, normal, ac = (shown.acts[name] for name in ("B", "C", "normal", "AC"))
    square = say("With two set squares draw through B the normal, square to v₂₁.")
    level = say(
        "Draw the horizontal through A with the T-square; it meets the normal in C, {length:.2f} mm {side} of A: "
        "AC = {length:.2f} mm × {mu:.5g} = {value:.2f} mm/rad, equal in length to v₂."
    ).with_values(length=abs(c.place), side=side_caption(c.place.real), mu=shown.mu, value=abs(c.place) * shown.mu)
    parts = Part(square, (normal,)), Part(level, (c, ac))
    marks = (
        _stroke(normal, b.place + (b.place - c.place) * 0.12, c.place, Role.CONSTRUCTION),
        ac.way(Role.CURVE),
        *(c.dots(), c.label("C", -1j + shown.sigma)),
    )
    why = say(
        "The velocity v₂₁ lies along the profile and the normal is square to it, so the sides of ABC are square to "
        "those of the plan, and AC = v₂/ω = ds/dφ."
    )
    return Step(say("The normal and the triangle ABC"), parts, shown.view, marks, why=why)


def _angle(shown: _PlanStation) -> Step:
    acts, height, reading = shown.acts, shown.acts["B"].place.imag, shown.hand.readings["alpha"]
    d, bd, da, motion = (acts[name] for name in ("D", "BD", "DA", "motion"))
    alpha = float(np.degrees(reading.paper))
    laid_off = say(
        "Lay AC off from B horizontally {side}, {length:.2f} mm to D: A, C, B and D make a parallelogram."
    ).with_values(side=side_caption((d.place - acts["B"].place).real), length=abs(acts["C"].place))
    joining = say("Join D to A: DA is parallel to the normal BC.")
    measuring = say(
        "Draw a vertical at D and measure its angle to DA with the protractor: at station {name} the pressure "
        "angle is α = {alpha:.2f}°, and the transmission angle 90° − |α| = {transmission:.2f}°."
    ).with_values(name=shown.name, alpha=alpha, transmission=90 - abs(alpha))
    parts = Part(laid_off, (d, bd)), Part(joining, (da,)), Part(measuring, (motion,))
    label = say("α = {alpha:.1f}°", alpha=alpha)
    marks = (
        *(bd.way(Role.CURVE), da.way(Role.LIMIT)),
        _stroke(motion, d.place, d.place - UP * 0.62 * height, Role.CONSTRUCTION),
        *(d.dots(), d.label("D", 1j - shown.sigma)),
        angle_at(d.place, -np.pi / 2, float(np.angle(-d.place)), 0.55 * height, label, reading.act),
    )
    why = say(
        "DA is parallel to the normal, and D is the end of v in the combined diagram, where the angle can be measured "
        "at every station."
    )
    return Step(say("The pressure angle at station {name}", name=shown.name), parts, shown.view, marks, why=why)


def _all_stations_step(measured: Construction[PressureAngleGivens], shown: int) -> Step:
    integrated, rays = measured.givens.integrated, measured.acts["rays"]
    names, alpha = station_names(integrated.givens.stations), np.degrees(measured.first("alpha"))
    sigma, most = sense(measured.givens.rotation), int(np.argmax(np.abs(alpha)))
    said = say(
        "In the combined diagram join A to every end with the ruler, and measure with the protractor the angle "
        "of each ray to the vertical, positive where it leans {side} going up. Ray {shown}, the one of the plan: "
        "{angle:.2f}°. The angle of maximum magnitude is {greatest:.2f}°, at {name}; there the transmission angle "
        "90° − |α| has its minimum, {transmission:.2f}°. The maximum angle between stations is read from the angle "
        "diagram."
    ).with_values(
        side=side_caption(-sigma), shown=names[shown], angle=alpha[shown], greatest=alpha[most], name=names[most]
    )
    said = said.with_values(transmission=90 - abs(alpha[most]))
    joined = run(said, say("Ray {name}"), names, rays, settings=lambda k: say("{alpha:z.2f}°", alpha=alpha[k]))
    why = say("The ray from A to an end is parallel to the normal at its station, as DA is.")
    title, reads = say("The pressure angle at every station"), ("alpha", "transmission")
    return Step(title, (joined,), combined_view(integrated), (rays.segments(Role.CONSTRUCTION),), reads, why=why)
