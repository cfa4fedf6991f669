"""The pressure angle of an oscillating follower, from the velocity plan and at every arm position.

v2 = l omega ds/dphi is square to the arm, so the plan v2 = v1 + v21 (follower, cam, follower on cam) turned by 90
degrees has v2 along the arm: l v is laid off from B along the arm to D, outward when cam and arm turn in opposite
senses on the rise, towards the pivot when in the same sense.  The angle of D A with the arm's normal is the pressure
angle.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from graphcam.constructions.adoption import adoption_step
from graphcam.constructions.arm_positions import (
    arc_through,
    arm_positions,
    arm_sense_caption,
    cam_centre,
    detail_scale,
    enlarged_centre_step,
    stroke,
)
from graphcam.constructions.axes import number_labels, sense_caption, station_names
from graphcam.constructions.integration import Integrated
from graphcam.constructions.pressure_angle import ANGLE_MEANINGS, MeasuredGivens, read_angles, shown_station
from graphcam.constructions.velocity_plan import VelocityScale, velocity_plan
from graphcam.constructions.views import ARM_ANGLES, PLAN, REGION, at_scale
from graphcam.drafting.acts import Floats, Setting
from graphcam.drafting.euclid import RIGHT, UP, unit
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Step, say
from graphcam.drafting.marks import Points, Role, Segments, angle_at
from graphcam.drafting.meaning import (
    ALPHA,
    ARM,
    DISTANCE,
    PSI0,
    R0,
    SIGMA,
    Formula,
    Meaning,
    ReadingMeaning,
    S,
    Symbol,
    V,
    Values,
)
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, coarsest_scale, ratio_text, standard_scale
from graphcam.drafting.telling import STATION, run
from graphcam.errors import DesignError
from graphcam.given.follower import Rotation, sense
from graphcam.words import sequence


@dataclass(frozen=True, eq=False)
class ArmPressureAngleGivens(MeasuredGivens):
    """What lies on the board; see :func:`arm_pressure_angle`."""

    arm: float
    distance: float
    mu_l: Scale

    @property
    def path_per_lift(self) -> float:
        """The path of the arm's end for a radian of lift [mm]: the arm's length."""
        return self.arm


ArmAngles = Construction[ArmPressureAngleGivens]


def _at_start(measured: ArmAngles) -> Values:
    """The formula's values: the triangle of the adopted sizes."""
    arm, c, r0 = measured.givens.arm, measured.givens.distance, measured.givens.prime_radius
    yield {"l": arm, "c": c, "r0": r0, "psi0": math.degrees(np.angle(-cam_centre(arm, c, r0)))}


def _worked_values(measured: ArmAngles) -> Values:
    givens, k, (at_start,) = measured.givens, shown_station(measured), _at_start(measured)
    s, v = (float(givens.integrated.value(name)[k]) for name in "sv")
    along, psi = sense(givens.rotation) * v, math.radians(at_start["psi0"]) + s
    tangent = (givens.arm * (1 + along) - givens.distance * math.cos(psi)) / (givens.distance * math.sin(psi))
    found = {"tangent": tangent, "alpha": math.degrees(math.atan(tangent))}
    yield {**at_start, "v": abs(along), "sign": "-" if along < 0 else "+", "s": math.degrees(s), **found}


FORMULAS = (
    Formula(
        r"\psi_0 = \arccos\frac{l^2 + c^2 - r_0^2}{2lc}",
        r"\psi_0 = \arccos\frac{<l:.6g>^2 + <c:.6g>^2 - <r0:.6g>^2}{2 \cdot <l:.6g> \cdot <c:.6g>} = <psi0:.3f>^\circ",
        _at_start,
        (PSI0, ARM, DISTANCE, R0),
        of="psi0",
    ),
    Formula(
        r"\tan\alpha = \frac{l\,(1 + \sigma v) - c\cos(\psi_0 + s)}{c\,\sin(\psi_0 + s)}, \qquad "
        r"\gamma = 90^\circ - |\alpha|",
        r"\tan\alpha = \frac{<l:.6g>\,(1 <sign> <v:.4f>) - <c:.6g>\cos(<psi0:.3f>^\circ + <s:.3f>^\circ)}"
        r"{<c:.6g>\,\sin(<psi0:.3f>^\circ + <s:.3f>^\circ)} = <tangent:.4f>, \qquad \alpha = <alpha:.2f>^\circ",
        _worked_values,
        (ALPHA, SIGMA, V, S, Symbol(r"\gamma", say("the transmission angle"), "°")),
        of="alpha",
    ),
)


MEANING = Meaning(
    "pressure_angle",
    say("Pressure angle"),
    say(
        "The velocity plan and the mechanism contain similar triangles. So the velocity of the arm's end, l·ds/dφ, is "
        "a length along the arm, and the angle between normal and motion is found without the profile."
    ),
    {**ANGLE_MEANINGS, "psi0": ReadingMeaning(say("angle ψ₀"), "ψ₀", "rad")},
    FORMULAS,
)


def arm_pressure_angle(
    integrated: Integrated,
    rotation: Rotation,
    prime_radius: float,
    arm: float,
    distance: float,
    mu_l: Scale,
    pencil: Pencil,
) -> ArmAngles:
    """Measure the pressure angle at every station.

    integrated : of an angle s [rad]
    prime_radius, distance : of the cam centre A from the start of the lift and from the pivot [mm]
    mu_l : scale of the drawing [mm/mm]

    Raises
    ------
    DesignError : in a single drawing the cam centre is not found
    """
    hand = Hand(pencil, MEANING)
    drawn = arm_positions(hand, integrated, rotation, arm, mu_l)
    pivot, start, tips = drawn["pivot"], drawn["start"], drawn["tips"]
    # The cam centre, where circles about the pivot and about the start of the lift meet: below the arm.
    about_pivot = hand.circle("circle of the centre", pivot, distance / mu_l.per_mm)
    about_start = hand.circle("prime circle", start, prime_radius / mu_l.per_mm)
    # Where a triangle has these sides, circles that miss one another by a hand's errors are taken to touch.
    closes = bool(np.isfinite(cam_centre(arm, distance, prime_radius)))
    centre = hand.cross("centre", about_pivot, about_start, flat=closes)
    normals = hand.perpendicular("normals", drawn["arms"], tips)
    read_angles(hand, normals, hand.join("rays", tips, centre))
    hand.angle("psi0", drawn["arm at rest"], hand.join("line of centres", pivot, centre))
    givens = ArmPressureAngleGivens(integrated, rotation, prime_radius, arm, distance, mu_l)
    measured = hand.finished(givens, _draw, {"ends": drawn["ends"], "tips": tips, "centre": centre})
    if pencil.samples is None:
        check_centre(measured)
    return measured


# --- the steps -------------------------------------------------------------------------------------------------------

MAX_PLAN_ARM = 70.0
"""The plan is drawn at the largest standard scale at which the arm is not longer [mm]."""
PLAN_MARGINS = complex(40.0, 40.0)
"""What stands beside the mechanism and the plan, and between them: letters, the ends of lines, the title [mm]."""
POLE_DISTANCE = 0.6
"""The plan's pole lies so far beyond C, in lengths of AB."""
NORMAL_LENGTH = 9.0
"""So much of the normal to each arm is drawn [mm]."""
ARC_HALF_ANGLE = 0.2
"""How far to both sides of the cam centre the arcs that find it are drawn [rad]."""


def check_centre(measured: ArmAngles) -> None:
    """Check that the cam centre was found: beside a flat triangle the arcs may miss each other on the paper.

    Raises
    ------
    DesignError : it was not
    """
    if not np.isfinite(measured.first("psi0")):
        limit = say("such that its arc meets that of the centre distance on the paper")
        remedy = say("make the triangle of arm, centre distance and prime radius less flat")
        raise DesignError("prime radius", measured.givens.prime_radius, limit, remedy)


def _draw(measured: ArmAngles) -> list[Step]:
    check_centre(measured)
    k = shown_station(measured)
    scale = plan_scale(measured, k)
    scales = VelocityScale(scale, measured.givens.omega)
    plan, decided, mu_l = _plan(measured, k, scale), measured.givens.adopted(), measured.givens.mu_l
    rounding = [adoption_step(decided, "c", mu_l.per_mm, at_scale(REGION, mu_l))] if decided else []
    return [
        *rounding,
        _centre(measured),
        *_enlarged(measured),
        _mechanism(measured, plan, k, scales),
        _velocities(measured, plan, k, scales),
        _angle(measured, plan, k, scales),
        _all_stations_step(measured, k),
    ]


def plan_scale(measured: ArmAngles, k: int) -> Scale:
    """The largest standard scale at which the arm is no longer than usual, and the paper takes the plan beside it."""
    givens, sigma = measured.givens, sense(measured.givens.rotation)
    s, v = (float(givens.integrated.value(name)[k]) for name in "sv")
    # About the cam centre [mm], the pivot level with it.
    arm = -givens.arm * np.exp(-1j * (float(measured.first("psi0")) + s))
    b, pole = givens.distance + arm, givens.distance + POLE_DISTANCE * abs(givens.distance + arm)
    d = b + sigma * v * arm
    places: Points = np.array([0, b, d, pole, pole + sigma * UP * b, pole + sigma * UP * (b - d)])
    size = complex(float(np.ptp(places.real)), float(np.ptp(places.imag)))
    usual = standard_scale(givens.arm, MAX_PLAN_ARM, givens.paper.ratios)
    return givens.paper.kept_scale(PLAN.name) or coarsest_scale(usual, givens.paper.scale(size, PLAN_MARGINS))


def _centre(measured: ArmAngles) -> Step:
    givens, acts, length = measured.givens, measured.acts, measured.givens.mu_l.paper
    pivot, start, tips, centre = (acts[name] for name in ("pivot", "start", "tips", "centre"))
    circles, sides = (
        (acts["circle of the centre"], acts["prime circle"]),
        np.exp([-1j * ARC_HALF_ANGLE, 1j * ARC_HALF_ANGLE]),
    )
    arcs = [arc_through(circle, circle.place + (centre.place - circle.place) * sides) for circle in circles]
    radius = errorless_hand(measured).join("prime radius", start.first, centre.first)
    psi0, line = float(np.degrees(measured.first("psi0"))), acts["line of centres"].first
    begin, end = (float(np.angle(way.directions)) for way in (acts["arm at rest"].first, line))
    angle = angle_at(pivot.place, begin, end, 0.3 * length(givens.arm), say("ψ₀ = {psi0:.2f}°", psi0=psi0), line.act)
    sizes = {"c": givens.distance, "r0": givens.prime_radius}
    sizes |= {"about_c": length(givens.distance), "about_b": length(givens.prime_radius), "psi0": psi0}
    before = say("Continue in the drawing of the arm positions, which holds C, B₀ and the ends D of all stations.")
    first = say("With the compass draw an arc of {about_c:.1f} mm about C below the arm, for c = {c:g} mm.")
    second = say(
        "Cut it with an arc of {about_b:.1f} mm about B₀, for r₀ = {r0:g} mm: the crossing below the arm is the cam "
        "centre A."
    )
    third = say("Join C to A and measure the angle B₀CA with the protractor: ψ₀ = {psi0:.2f}°.")
    marks = (
        *(tips.dots(Role.CONSTRUCTION), *arcs),
        *(radius.way(Role.LIMIT), line.way(Role.CONSTRUCTION), centre.dots(Role.RESULT)),
        centre.label(_centre_caption(givens), -UP),
        angle,
    )
    parts = (
        Part(before, (start, tips)),
        Part(first.with_values(**sizes), (circles[0],)),
        Part(second.with_values(**sizes), (circles[1], centre, radius)),
        Part(third.with_values(**sizes), (line,)),
    )
    why = say("The cam centre is as far from C as the centre distance, and from B₀ as the prime radius.")
    return Step(say("The cam centre"), parts, at_scale(REGION, givens.mu_l), marks, ("psi0",), why=why)


def _centre_caption(givens: ArmPressureAngleGivens) -> Caption:
    return say("A (r₀ = {r0:g}, c = {c:g})", r0=givens.prime_radius, c=givens.distance)


def _enlarged(measured: ArmAngles) -> list[Step]:
    """The step that marks the adopted cam centre beside the one found, where both are enlarged; else none."""
    givens = measured.givens
    scale = givens.adopted() and detail_scale(givens.prime_radius, givens.mu_l, givens.paper.ratios)
    return [enlarged_centre_step(measured, scale, _centre_caption(givens))] if scale else []


def _carried(drawn: Construction, name: str, factor: float = 1.0) -> Setting:
    """The setting that carries a reading over as it is shown, times a factor."""
    return Setting(drawn.first(name) * factor, reading=drawn.readings[name], factor=factor)


def _clockwise(psi0: Floats, s: Floats) -> Floats:
    """The turns [rad] from CA to the arm, which lies clockwise of it: negative."""
    return -(psi0 + s)


def _plan(measured: ArmAngles, k: int, scale: Scale) -> Hand:
    """The hand that draws the mechanism at a station, its line of centres level, with the velocity plan beside it."""
    hand, givens, sigma = errorless_hand(measured), measured.givens, sense(measured.givens.rotation)
    arm, (s, v) = givens.arm / scale.per_mm, (givens.integrated.readings[name].per_mm for name in "sv")
    a = hand.given("A", 0j)
    c = hand.lay_off("C", a, RIGHT, givens.distance / scale.per_mm)
    angle = calculated_setting(_clockwise, _carried(measured, "psi0"), _carried(givens.integrated, "s", s))
    b = hand.lay_off("B", c, hand.protractor("arms", c, hand.join("CA", c, a), angle), arm)
    cb = hand.join("CB", c, b)
    d = hand.lay_off("D", b, cb.turned(sigma), _carried(givens.integrated, "v", arm * v))
    # The plan stands clear of the mechanism: v₁ lies across the radius, v₂ across the arm.
    pole = hand.given("p", c.place.real + abs(b[k].place) * POLE_DISTANCE + 12.0)
    ab, bd = hand.join("AB", a, b), hand.join("BD", b, d)
    v1 = hand.lay_off("v₁", pole, ab[k].turned(sigma * UP), distance_between(a, b[k]))
    v2 = hand.lay_off("v₂", pole, bd[k].turned(-sigma * UP), distance_between(b[k], d[k]))
    hand.join("v₂₁", v1, v2)
    normal = hand.perpendicular("normal", cb[k], d[k])
    hand.angle("alpha", normal, hand.join("DA", d[k], a))
    return hand


def _mechanism(measured: ArmAngles, plan: Hand, k: int, scales: VelocityScale) -> Step:
    givens, (a, b, c, d) = measured.givens, (plan.acts[each] for each in "ABCD")
    ab, bd, cb = (plan.acts[each] for each in ("AB", "BD", "CB"))
    integrated, names = givens.integrated, station_names(givens.integrated.givens.stations)
    psi0, s = (np.degrees(float(each)) for each in (measured.first("psi0"), integrated.value("s")[k]))
    v, arm, ratio = float(integrated.first("v")[k]), scales.mu_l.paper(givens.arm), ratio_text(scales.mu_l.per_mm)
    factor = arm * integrated.readings["v"].per_mm
    sizes = {"ratio": ratio, "ac": c.place.real, "psi0": psi0, "s": s, "psi": psi0 + s, "arm": arm}
    sizes |= {
        "v": abs(v),
        "factor": factor,
        "bd": abs(v) * factor,
        "side": arm_sense_caption(sense(givens.rotation) * v),
    }
    texts = (
        say("At {ratio} draw AC horizontally, {ac:.1f} mm long, with C on the right."),
        say(
            "At C set off the angle of the arm, ψ₀ + s = {psi0:.2f}° + {s:.2f}° = {psi:.2f}°, upwards from CA with the "
            "protractor, and lay off the arm, CB = {arm:.1f} mm."
        ),
        say("Join A to B."),
        say(
            "From B lay off l·ds/dφ along the arm, {side}, with the dividers: {v:.2f} mm × {factor:.5g} = {bd:.2f} mm, "
            "to D."
        ),
    )
    marks = (
        *(c.line_from(a, Role.AXIS), cb[k].way(Role.CURVE), bd[k].way(Role.RESULT), ab[k].way(Role.CONSTRUCTION)),
        *(a.dots(), b[k].dots(), c.dots(), d[k].dots()),
        *(a.label("A", -1 - 1j), b[k].label("B", 1 + 1j), c.label("C", 1 - 1j), d[k].label("D", -1 + 1j)),
    )
    draws = ((a, c), (cb[k], b[k]), (ab[k],), (bd[k], d[k]))
    parts = tuple(Part(text.with_values(**sizes), drawn) for text, drawn in zip(texts, draws, strict=True))
    why = say(
        "The velocity of B turned by 90°, l·ds/dφ, is a length along the arm, so it can be drawn in the mechanism."
    )
    return Step(say("The mechanism at station {name}", name=names[k]), parts, scales.view(names[k]), marks, why=why)


def _velocities(measured: ArmAngles, plan: Hand, k: int, scales: VelocityScale) -> Step:
    names, rotation = station_names(measured.givens.integrated.givens.stations), measured.givens.rotation
    pole, v1, v2, v21 = (plan.acts[name] for name in ("p", "v₁", "v₂", "v₂₁"))
    across, along = v1.place - pole.place, v2.place - pole.place
    sizes = {"across": abs(across), "along": abs(along), "closing": abs(along - across)}
    sizes |= {"turn": sense_caption(rotation), "back": sense_caption("cw" if rotation == "ccw" else "ccw")}
    first = say(
        "All velocities are divided by ω, so v₁ = ω·AB is drawn as long as AB. From a pole p draw with the set squares "
        "v₁ = AB = {across:.1f} mm, square to AB: the direction of AB turned by 90° {turn}."
    )
    second = say(
        "From p draw v₂ = BD = {along:.1f} mm, square to the arm: the direction of BD turned by 90° {back}."
    ).with_values(**sizes)
    third = say("Join the tip of v₁ to the tip of v₂: v₂₁ measures {closing:.1f} mm.").with_values(**sizes)
    closing = sequence([third, *scales.speed_captions(pole, v1, v2)], " ")
    return Step(
        say("Velocity plan at station {name}", name=names[k]),
        (Part(first.with_values(**sizes), (pole, v1)), Part(second, (v2,)), Part(closing, (v21,))),
        *(scales.view(names[k]), velocity_plan(pole, v1, v2, v21, scales)),
        why=say(
            "The velocity of the arm's end is that of the cam's point and the sliding along the profile together, "
            "v₂ = v₁ + v₂₁."
        ),
    )


def _angle(measured: ArmAngles, plan: Hand, k: int, scales: VelocityScale) -> Step:
    normal, ray, d = (plan.acts[name] for name in ("normal", "DA", "D"))
    name, reading = station_names(measured.givens.integrated.givens.stations)[k], plan.readings["alpha"]
    alpha, length, tip = float(np.degrees(reading.paper)), abs(d[k].place), d[k].place
    sizes = {"name": name, "alpha": alpha, "transmission": 90 - abs(alpha)}
    begin, end = (float(np.angle(line.directions)) for line in (normal, ray))
    text = say("α = {alpha:.1f}°", alpha=alpha)
    marks = (
        *(ray.way(Role.LIMIT), stroke(normal, 0.7 * length)),
        angle_at(tip, begin, end, 0.6 * length, text, ray.act),
    )
    square = say("At D draw the normal to the arm downwards, square to CD, with the set squares.")
    measure = say(
        "Join D to A and measure the angle from the normal to DA with the protractor: the pressure angle at station "
        "{name} is {alpha:.2f}°, and the transmission angle 90° − |α| = {transmission:.2f}°."
    ).with_values(**sizes)
    why = say(
        "The plan turned by 90° is the triangle ABD: v₂ lies along BD, so DA is square to v₂₁ and has the direction "
        "of the normal to the profile."
    )
    parts = Part(square, (normal,)), Part(measure, (ray,))
    return Step(say("The pressure angle"), parts, scales.view(name), marks, why=why)


def _all_stations_step(measured: ArmAngles, k: int) -> Step:
    names, alpha = station_names(measured.givens.integrated.givens.stations), np.degrees(measured.first("alpha"))
    rays, normals = measured.acts["rays"], measured.acts["normals"]
    # At the shown station as far as the arc of its angle, at the others only their direction.
    lengths = np.where(np.arange(len(names)) == k, 4.4 * NORMAL_LENGTH, NORMAL_LENGTH)
    down = normals.shown + lengths * unit(normals.first.directions)
    strokes = Segments(normals.shown, down, Role.CONSTRUCTION).left_by(normals)
    begin, end = (float(np.angle(line.first[k].directions)) for line in (normals, rays))
    shown = say("α = {alpha:.1f}°", alpha=alpha[k])
    angle = angle_at(rays.first[k].place, begin, end, 4 * NORMAL_LENGTH, shown, rays.act)
    angle = replace(angle, index=rays[k].index)
    worst = int(np.nanargmax(np.abs(alpha)))
    apart = say(
        "Prick A and the ends D of all stations through onto a separate drawing, where the lines at the limits do not "
        "cross the rays."
    )
    said = say(
        "From every D draw the normal to its arm downwards with the set squares, join D to A and measure the angle "
        "from the normal to DA with the protractor, positive anticlockwise. Station {name}: {alpha:.2f}°. The minimum "
        "transmission angle is 90° − |α| = {least:.2f}°, at station {worst}."
    ).with_values(name=names[k], alpha=alpha[k], least=90 - abs(alpha[worst]), worst=names[worst])
    tips, centre = measured.acts["tips"], measured.acts["centre"]
    places = (tips.dots(Role.CONSTRUCTION), centre.dots(Role.RESULT), centre.label("A", -UP))
    named = number_labels(tips, measured.givens.integrated.givens.stations, UP)
    every = run(said, STATION, names, normals, rays, settings=lambda n: say("{alpha:z.2f}°", alpha=alpha[n]))
    marks = (strokes, rays.segments(Role.CONSTRUCTION), *places, *named, angle)
    title, view = say("The pressure angle at every station"), at_scale(ARM_ANGLES, measured.givens.mu_l)
    why = say("What holds at one station holds at all: only D and the arm differ; A is the same.")
    return Step(title, (Part(apart, (tips, centre)), every), view, marks, ("alpha", "transmission"), why=why)
