"""The least radius under a flat face: the displacement drawn over the acceleration.

The profile under a flat face perpendicular to its motion has the radius of curvature rho = r0 + s + a.  In a diagram of
s over a with equal scales, places of equal s + a lie on lines at 45 degrees; the lowest of them that touches the curve
meets the axis of s where the greatest of -(s + a) is read.  With unequal scales the tangent would lean by
arctan(mu_a/mu_s) in place of 45 degrees.
"""

from dataclasses import dataclass, replace
from itertools import pairwise
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.adoption import ChainSettings
from graphcam.constructions.axes import AXIS_OVERHANG, number_labels, station_names
from graphcam.constructions.curvature import LEAST_CURVATURE
from graphcam.constructions.integration import Integrated
from graphcam.constructions.region import LEAST_RADIUS
from graphcam.constructions.views import COMBINED
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, say
from graphcam.drafting.marks import AngleMark, Arrow, Dimension, Label, Line, Mark, Points, Role
from graphcam.drafting.meaning import R0, RHO, A, ComparedReading, Formula, Meaning, ReadingMeaning, S, Symbol, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NEGLIGIBLE_SIZE
from graphcam.drafting.telling import STATION, stretch_caption
from graphcam.given.laws import Floats
from graphcam.given.motion import Dwell
from graphcam.words import sequence

OVER_ACCELERATION = replace(COMBINED, title=say("Displacement over acceleration: the minimum radius"))
"""Where another follower has the velocity, a flat face has the acceleration."""
DOWN_LEFT = -RIGHT - UP
"""Square to the lines of equal s + a, towards smaller ones."""


@dataclass(frozen=True, eq=False)
class FlatLeastRadiusGivens(ChainSettings):
    """The diagrams, and the least permitted radius of curvature of the profile [mm].

    adopted : tells which prime radius is taken in the end, where one is: the axis of s is drawn as far as there
    """

    integrated: Integrated
    least_curvature: float


FlatRegion = Construction[FlatLeastRadiusGivens]


@dataclass(frozen=True, eq=False)
class FlatCurvatureGivens:
    """The diagram of s over a, and the adopted prime radius [mm]."""

    region: FlatRegion
    prime_radius: float


FlatCurved = Construction[FlatCurvatureGivens]


def _sharpest(region: FlatRegion, r0: float) -> dict[str, Any]:
    """The formula's values: the minimum sum of displacement and acceleration, with a radius to which it is added."""
    least = -float(region.value("need"))
    return {"rho": region.givens.least_curvature, "sum": abs(least), "sign": "-" if least < 0 else "+", "r0": r0}


def _enough_radius(region: FlatRegion) -> Values:
    """The formula's values: the minimum prime radius; not positive where any is permitted."""
    r0 = region.givens.least_curvature + float(region.value("need"))
    values = _sharpest(region, r0)
    yield {**values, "sign": "+" if values["sign"] == "-" else "-"}


def _least_bend(curved: FlatCurved) -> Values:
    """The formula's values: the minimum radius of curvature at the adopted prime radius."""
    r0 = curved.givens.prime_radius
    yield {**_sharpest(curved.givens.region, r0), "least": r0 - float(curved.givens.region.value("need"))}


SUM_SYMBOL = Symbol(r"\min(s + a)", say("the minimum of the sum of displacement and acceleration"), "mm")
FORMULAS = (
    Formula(
        r"\rho = r_0 + s + \frac{d^2 s}{d\varphi^2} \ge [\rho], \qquad r_0 \ge [\rho] - \min(s + a)",
        r"r_0 \ge <rho:g> <sign> <sum:.3f> = <r0:.3f>\ \text{<mm>}",
        _enough_radius,
        (RHO, R0, S, A, Symbol(r"[\rho]", say("the permitted radius of curvature"), "mm"), SUM_SYMBOL),
        of="prime_radius",
    ),
)
CURVATURE_FORMULAS = (
    Formula(
        r"\rho_{\min} = r_0 + \min(s + a)",
        r"\rho_{\min} = <r0:g> <sign> <sum:.3f> = <least:.3f>\ \text{<mm>}",
        _least_bend,
        (Symbol(r"\rho_{\min}", say("the minimum radius of curvature"), "mm"),),
        of="rho",
    ),
)


LEAST_RADIUS_MEANING = Meaning(
    "minimum_radius",
    say("Minimum prime radius"),
    say(
        "Under a flat face the profile has the radius of curvature ρ = r₀ + s + a, and no pressure angle limits "
        "it. Drawn over the acceleration, the displacement shows where s + a has its minimum: a tangent at 45° "
        "touches it there."
    ),
    {"prime_radius": LEAST_RADIUS, "need": ReadingMeaning(say("maximum of −(s + a)"), "−(s + a)", "mm")},
    FORMULAS,
)
CURVATURE_MEANING = Meaning(
    "curvature",
    say("Minimum radius of curvature"),
    say(
        "The prime radius is adopted, and s + a is drawn already: their sum is the radius of curvature of the "
        "profile. Its minimum tells how sharp the cam is."
    ),
    # It may be negative here, and has no rival.
    {
        "rho": replace(
            LEAST_CURVATURE["rho"],
            compared=(ComparedReading("min_pitch_curvature_radius", say("minimum radius of curvature ρ")),),
        )
    },
    CURVATURE_FORMULAS,
)


def flat_least_radius(integrated: Integrated, least_curvature: float, pencil: Pencil) -> FlatRegion:
    """Find the least prime radius at which the profile is nowhere sharper than permitted.

    least_curvature : the least permitted radius of curvature of the profile [mm]
    """
    hand = Hand(pencil, LEAST_RADIUS_MEANING)
    s, a, before = (integrated.readings[name] for name in ("s", "a", "a_before"))
    origin, axis = hand.given("origin"), hand.given("axis of s", along=UP)
    heights = hand.project("displacements", hand.carry(s), axis)
    # Equal scales: the accelerations are laid off in the scale of s.  At a jump the curve has two ends.
    equal = np.asarray(a.scale) / np.asarray(s.scale)
    after = hand.lay_off("accelerations", heights, RIGHT, hand.carry(a, equal))
    jumps = jump_stations(integrated)
    nearer = calculated_setting(itemgetter((..., jumps)), hand.carry(before, equal))
    near = hand.lay_off("before the jumps", heights[jumps], RIGHT, nearer)
    curve = hand.take("curve", after, near, which=order_with_jumps(integrated))
    # Where the follower rests there is no acceleration: a point of the axis of s.
    rests = hand.take("rests", heights, which=dwell_stations(integrated))
    tangent = hand.tangent("touch", hand.take("curve and rests", curve, rests), smooth_pieces(integrated), DOWN_LEFT)
    zero = hand.cross("zero", tangent, axis)
    need = distance_between(zero, origin, UP)
    radius = calculated_setting(_sufficient_radius, hand.at_scale(least_curvature, s), need)
    hand.lay_off("A", origin, -UP, hand.carry(hand.read("prime_radius", radius, s.scale)))
    hand.read("need", need, s.scale)
    givens = FlatLeastRadiusGivens(integrated, least_curvature)
    return hand.finished(givens, _draw, {"curve": curve, "rests": rests, "touch": tangent, "zero": zero})


def order_with_jumps(integrated: Integrated) -> NDArray[np.intp]:
    """The places of a curve that has two at every jump, those before the jumps standing after all others."""
    stations, jumps = integrated.givens.stations, jump_stations(integrated)
    ends = np.arange(stations.u.size)
    ends[jumps] = stations.u.size + np.arange(jumps.size)
    return np.concatenate([np.append(np.arange(p.start, p.stop - 1), ends[p.stop - 1]) for p in stations.stretches])


def jump_stations(integrated: Integrated) -> NDArray[np.intp]:
    """The stations at which the acceleration jumps."""
    a, before = (integrated.readings[name].paper for name in ("a", "a_before"))
    return np.flatnonzero((a != before).reshape(-1, a.shape[-1]).any(axis=0))


def _sufficient_radius(least: Floats, need: Floats) -> Floats:
    """The minimum prime radius; where s + a is never negative, what the permitted curvature itself needs."""
    return np.maximum(least + need, 0.0)


def smooth_pieces(integrated: Integrated) -> list[slice]:
    """The pieces of the curve that are faired, and then the dwells, each by itself."""
    ends = np.cumsum([stretch.stop - stretch.start for stretch in integrated.givens.stations.stretches]).tolist()
    ends += [ends[-1] + k + 1 for k in range(dwell_stations(integrated).size)]
    return [slice(start, end) for start, end in pairwise([0, *ends])]


def dwell_stations(integrated: Integrated) -> NDArray[np.intp]:
    """The last stations of the moving phases that a dwell follows."""
    motion, last = integrated.givens.motion, integrated.givens.stations.last
    following = (integrated.givens.stations.phase[last] + 1) % len(motion.phases)
    return last[[isinstance(motion.phases[k], Dwell) for k in following]]


def flat_curvature(region: FlatRegion, prime_radius: float, pencil: Pencil) -> FlatCurved:
    """Read the least radius of curvature of the profile off the same diagram, at the adopted prime radius [mm].

    It is negative where the profile under the face would have to turn inside out, and its own only candidate.
    """
    hand, need = Hand(pencil, CURVATURE_MEANING), region.readings["need"]
    origin, zero = hand.given("origin"), hand.earlier_places(region, "zero")
    centre = hand.lay_off("A", origin, -UP, hand.at_scale(prime_radius, need))
    rho = calculated_setting(np.subtract, distance_between(centre, origin, UP), hand.carry(need))
    hand.read("rho", rho, need.scale)
    hand.read("rho_candidates", calculated_setting(itemgetter((..., None)), rho), need.scale, "mm")
    return hand.finished(FlatCurvatureGivens(region, prime_radius), _draw_curvature, {"zero": zero})


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(region: FlatRegion) -> list[Step]:
    return [_displacement_step(region), _curve_step(region), _touched_tangent_step(region), _radius_step(region)]


def _displacement_step(region: FlatRegion) -> Step:
    integrated, names = region.givens.integrated, ("displacements", "accelerations", "before the jumps")
    heights, after, near = (region.acts[name].first for name in names)
    stations, jumps = integrated.givens.stations, jump_stations(integrated).tolist()
    named, lowest = station_names(stations), [region.acts[name].place.imag for name in ("A", "zero")]
    if adopted := region.givens.adopted():
        lowest.append(-adopted.prime_radius / region.readings["prime_radius"].per_mm)
    axes = _axes(region.first("curve"), min(lowest) - AXIS_OVERHANG)
    marks = [after.segments_from(heights, Role.CONSTRUCTION), *number_labels(after, stations, _outward(after))]
    if jumps:
        marks.append(near.segments_from(heights[jumps], Role.CONSTRUCTION))
        marks += [near[k].label(named[jump], complex(_outward(near)[k]), small=True) for k, jump in enumerate(jumps)]
    ends = [(near[jumps.index(k)], after[k]) if k in jumps else (after[k],) for k in range(after.shown.size)]
    worked = int(np.argmax(np.round(np.abs(after.shown.real) * after.shown.imag, 3)))
    said = say(
        "With the T-square carry each displacement across to a vertical axis. From there lay off the acceleration "
        "horizontally with the dividers, in the scale of s: times μₐ/μₛ = {mu_a:.5g}/{mu_s:.5g} = {factor:.4f}, to the "
        "right where it is positive. Station {name}: {there}. Number the ends."
    ).with_values(name=named[worked], there=_station(region, worked), factor=_factor(region))
    said = said.with_values(**{f"mu_{name}": integrated.readings[name].per_mm for name in "as"})
    rows = tuple(Row(STATION.with_values(name=named[k]), _station(region, k), draws) for k, draws in enumerate(ends))
    why = say("The radius of curvature is ρ = r₀ + s + a, and lengths in one scale can be added on the paper.")
    title, marks = say("Displacement over acceleration"), (*axes, *marks)
    return Step(title, (Part(said, rows=rows),), OVER_ACCELERATION, marks, given=axes, why=why)


def _outward(ends: Drawn) -> Points:
    """The side of the axis on which numbers stand, as directions."""
    return np.where(ends.shown.real < 0, -RIGHT, RIGHT)


def _factor(region: FlatRegion) -> float:
    """The ratio of the scales of a and s, by which an ordinate of a is drawn in the scale of s."""
    readings = region.givens.integrated.readings
    return readings["a"].per_mm / readings["s"].per_mm


def _station(region: FlatRegion, k: int) -> Caption:
    """A caption of what is marked and laid off at a station: where the acceleration jumps, on both sides."""
    s, a, before = (float(region.givens.integrated.first(name)[k]) for name in ("s", "a", "a_before"))
    said = say("{height}, from there {after}")
    if k in jump_stations(region.givens.integrated):
        said = say("{height}, from there before the jump {near}, after it {after}")
    elif abs(a) < NEGLIGIBLE_SIZE:
        said = say("{height}; the acceleration is zero")
    return said.with_values(height=_height_caption(s), near=_level(before, region), after=_level(a, region))


def _height_caption(y: float) -> Caption:
    if abs(y) < NEGLIGIBLE_SIZE:
        return say("at the axis of a")
    return say("{mm:.2f} mm above the axis of a", mm=y) if y > 0 else say("{mm:.2f} mm below the axis of a", mm=-y)


def _level(a: float, region: FlatRegion) -> Caption:
    """A caption of how an ordinate of the acceleration [mm of paper] is laid off."""
    factor = _factor(region)
    if abs(a) < NEGLIGIBLE_SIZE:
        return say("nothing")
    said = (
        say("{mm:.2f} mm × {factor:.4f} = {length:.2f} mm to the right")
        if a > 0
        else say("{mm:.2f} mm × {factor:.4f} = {length:.2f} mm to the left")
    )
    return said.with_values(mm=abs(a), factor=factor, length=abs(a) * factor)


def _curve_step(region: FlatRegion) -> Step:
    integrated, smooth, curve = region.givens.integrated, errorless_hand(region), region.acts["curve"].first
    stations, rests, marks, rows = integrated.givens.stations, region.acts["rests"].first, list[Mark](), list[Row]()
    names = station_names(stations)
    for piece, stretch in zip(smooth_pieces(integrated), stations.stretches, strict=False):
        start, end = names[stretch.start], names[stretch.stop - 1]
        line = smooth.fair(f"from {start}", curve[piece], [slice(None)])
        marks.append(line.line(Role.RESULT))
        rows.append(Row(stretch_caption(start, end), "", (line,)))
    for k, last in enumerate(dwell_stations(integrated)):
        called = say("In the dwell after {name}", name=names[last])
        rows.append(Row(called, _height_caption(rests.shown[k].imag), (rests[k],)))
    said = say(
        "Join the ends by smooth curves with the French curve, from each jump or corner of the acceleration to the "
        "next. In a dwell the acceleration is zero: mark a point of the axis."
    )
    why = say("The sum s + a is wanted between the stations too, and in a dwell a is zero.")
    marks, part = (*marks, rests.dots(Role.RESULT)), Part(said, rows=tuple(rows))
    return Step(say("The curve of s over a"), (part,), OVER_ACCELERATION, marks, why=why)


def _touched_tangent_step(region: FlatRegion) -> Step:
    """The step that draws the tangent at 45 degrees, to where it meets the axis of s."""
    line, zero, need = region.acts["touch"].first, region.acts["zero"].first, float(region.value("need")) + 0.0
    slide = say(
        "Hold a set square at 45° so that its edge falls to the right, and slide it in from the lower left until the "
        "edge touches the curve and crosses it nowhere: near {name}."
    ).with_values(name=nearest_station(region))
    read = say(
        "The edge meets the axis of s {height}, so the maximum of −(s + a) is {paper:.2f} mm × {mu:.5g} = "
        "{need:.3f} mm."
    )
    paper = float(region.first("need")) + 0.0
    if abs(paper) < NEGLIGIBLE_SIZE:
        read = say("The edge meets the axis of s {height}, so the maximum of −(s + a) is zero.")
    values = {"mu": region.readings["need"].per_mm, "paper": paper, "need": need}
    read = read.with_values(height=_height_caption(zero.place.imag), **values)
    lean = say(
        "If a had kept its own scale, the edge would have to fall by arctan(μₐ/μₛ) = {angle:.1f}°.",
        angle=np.degrees(np.arctan(_factor(region))),
    )
    places = np.array([line.place + 12 * (UP - RIGHT), zero.place + 16 * (RIGHT - UP)])
    marks = (
        Line(places, Role.LIMIT).left_by(line),
        *(line.dots(Role.LIMIT), zero.dots(Role.LIMIT)),
        AngleMark(zero.place, 12.0, -np.pi / 2, -np.pi / 4, "45°").left_by(line),
    )
    parts = Part(slide, (line,)), Part(sequence([read, lean], " "), (zero,))
    why = say("Along a line at 45° s + a is constant, and on every line farther to the lower left it is smaller.")
    return Step(say("The tangent at 45 degrees"), parts, OVER_ACCELERATION, marks, ("need",), why=why)


def nearest_station(region: FlatRegion) -> str:
    """The name of the station whose end, or whose dwell, is nearest to where the tangent touches."""
    integrated, acts, place = region.givens.integrated, region.acts, region.acts["touch"].first.place
    stretches = [np.arange(each.start, each.stop) for each in integrated.givens.stations.stretches]
    places, of = (
        np.append(acts["curve"].shown, acts["rests"].shown),
        np.concatenate([*stretches, dwell_stations(integrated)]),
    )
    return station_names(integrated.givens.stations)[of[np.argmin(np.round(np.abs(places - place), 3))]]


def _radius_step(region: FlatRegion) -> Step:
    centre, least, mu = region.acts["A"].first, region.givens.least_curvature, region.readings["prime_radius"].per_mm
    r0, need = (float(region.value(name)) for name in ("prime_radius", "need"))
    if r0 > 0:
        said = say(
            "The radius of curvature of the profile must be at least ρ = {least:g} mm: r₀ = {sum} = {r0:.3f} mm. "
            "Set the dividers to {r0:.3f}/{mu:.5g} = {paper:.2f} mm and lay it off from the crossing of the axes "
            "straight down to the cam centre A₀."
        ).with_values(least=least, sum=_sum(least, need), r0=r0, mu=mu, paper=r0 / mu)
    else:
        said = say(
            "The radius of curvature of the profile must be at least ρ = {least:g} mm, and r₀ = {sum} is not "
            "positive: any prime radius will do, and the cam centre A₀ is the crossing of the axes."
        ).with_values(least=least, sum=_sum(least, need))
    radius = say("min r₀ = {r0:.2f}", r0=r0)
    marks = (
        *(centre.dots(Role.RESULT), centre.label("A₀", 1 - 1j)),
        Dimension(0j, centre.place, radius, -10.0, of=region.readings["prime_radius"].act),
    )
    why = say("The minimum of ρ = r₀ + s + a is r₀ minus the maximum of −(s + a), and must equal the permitted ρ.")
    parts = (Part(said, (centre,)),)
    return Step(say("The minimum prime radius"), parts, OVER_ACCELERATION, marks, ("prime_radius",), why=why)


def _sum(least: float, need: float) -> Caption:
    """The permitted radius and the maximum of -(s + a) [mm], as a sum."""
    if abs(need) < NEGLIGIBLE_SIZE / 10:
        return say("ρ")
    plus, minus = say("{least:g} + {need:.3f}"), say("{least:g} − {need:.3f}")
    return (plus if need > 0 else minus).with_values(least=least, need=abs(need))


def _axes(curve: Points, below: float) -> tuple[Mark, ...]:
    top, right = float(curve.imag.max()) + AXIS_OVERHANG, float(curve.real.max()) + AXIS_OVERHANG
    return (
        Arrow(below * UP, top * UP, Role.SCALE),
        Arrow(curve.real.min() + 0j, right + 0j, Role.SCALE),
        Label(top * UP, "s", towards=-1 + 0j),
        Label(right + 0j, "a", towards=-1j),
    )


def _draw_curvature(curved: FlatCurved) -> list[Step]:
    centre, zero, rho = curved.acts["A"].first, complex(curved.first("zero")), curved.readings["rho"]
    r0, value, mu = curved.givens.prime_radius, float(curved.value("rho")), rho.per_mm
    placed = say(
        "Set the dividers to {r0:g}/{mu:.5g} = {paper:.2f} mm, the adopted prime radius, and lay it off from the "
        "crossing of the axes straight down to the cam centre A."
    ).with_values(r0=r0, mu=mu, paper=r0 / mu)
    measured = (
        say("From A up to where the 45° line meets the axis it measures {paper:.2f} mm × {mu:.5g} = {rho:.3f} mm.")
        if value > 0
        else say(
            "The 45° line meets the axis {paper:.2f} mm × {mu:.5g} below A: ρ = {rho:.3f} mm, so the profile "
            "would turn inside out."
        )
    ).with_values(paper=abs(float(curved.first("rho"))), mu=mu, rho=value)
    named = say("ρ = {rho:.2f}", rho=value)
    label = centre.label(say("A (r₀ = {r0:g})", r0=r0), -1 - 1j)
    marks = (centre.dots(Role.RESULT), label, Dimension(centre.place, zero, named, -14.0, of=rho.act))
    parts = Part(placed, (centre,)), Part(measured)
    why = say(
        "A lies r₀ below the axis of a, and the line lies the maximum of −(s + a) below it: the difference is the "
        "minimum of r₀ + s + a."
    )
    return [Step(say("The minimum radius of curvature"), parts, OVER_ACCELERATION, marks, ("rho",), why=why)]
