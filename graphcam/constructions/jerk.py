"""The jerk, by graphical differentiation of the acceleration diagram as it is drawn.

The chords between neighbouring stations of the acceleration are carried to a pole: a parallel through it cuts off the
height y = H dy/dx on the vertical axis, which is the jerk in the middle of the part, to second order.  So the scale is
mu_j = mu_a/(mu_phi H3).  No chord is drawn across a jump or a corner of the acceleration: both fall on stations.  To
the ends of such a stretch the curve is carried on straight through its last two points, which is of second order too.
Where the acceleration jumps, the jerk is infinite: an arrow stands for it.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from graphcam.constructions.axes import (
    ARROW_OVERHANG,
    MIN_INFINITE_ARROW,
    degrees,
    height_range,
    joined_parts,
    ordinate_title,
    part_names,
    part_titles,
    pole_marks,
    station_names,
)
from graphcam.constructions.graduation import (
    close_ends_caption,
    coinciding_heights,
    graduated_at_speed,
    graduation_marks,
    height_caption,
    ray_numbers,
    run_of_chord,
    time_scale_caption,
)
from graphcam.constructions.integration import Integrated
from graphcam.constructions.pole_scales import PoleTerms, pole_formula
from graphcam.constructions.views import ACCELERATION, JERK
from graphcam.drafting import telling
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, say
from graphcam.drafting.marks import Arrow, Label, Mark, Role, Segments
from graphcam.drafting.meaning import ComparedReading, Meaning, ReadingConvergence, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, unit
from graphcam.given.impact import acceleration_jumps
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.given.stations import Stations
from graphcam.words import sequence

GRADUATION_OFFSET = 6.0
"""The graduation stands so far beside an arrow at the end of the turn [mm of paper]."""


@dataclass(frozen=True, eq=False)
class JerkGivens:
    """The diagrams, and the distance of the pole [mm of paper]."""

    integrated: Integrated
    pole: float


DrawnJerk = Construction[JerkGivens]


def _parts(drawn: DrawnJerk) -> list[Caption]:
    return part_titles(drawn.givens.integrated)


def _by_pole(drawn: DrawnJerk, source: str, _: int) -> PoleTerms:
    integrated = drawn.givens.integrated
    return PoleTerms(integrated.readings[source].per_mm, integrated.givens.mu_phi.per_mm, drawn.givens.pole)


MEANING = Meaning(
    "jerk",
    say("Jerk"),
    say(
        "The jerk is the slope of the acceleration: a parallel through the pole to a chord of a cuts it off. It is "
        "drawn by differentiation, which amplifies drawing errors; where the acceleration jumps it is infinite."
    ),
    {
        "j": ReadingMeaning(say("jerk j"), "j", "lift/rad³", over=_parts),
        "max_j": ReadingMeaning(
            say("maximum j"),
            "max j",
            "lift/rad³",
            (ComparedReading("max_j"),),
            ReadingConvergence("maximum jerk", "max_j"),
        ),
    },
    (pole_formula("j", "a", 3, _by_pole, greatest=False),),
    scales={JERK.name: "j"},
    scales_found_by="integration",
)


def jerk(integrated: Integrated, pole: float, pencil: Pencil) -> DrawnJerk:
    """Differentiate the drawn acceleration diagram by chords; pole : H3, acceleration to jerk [mm of paper].

    Readings besides those of the meaning: ``j_at``, the cam angles to which the jerk of each part belongs.
    """
    diagram, stations, mu_phi = integrated.givens.diagram, integrated.givens.stations, integrated.givens.mu_phi
    hand, left = Hand(pencil, MEANING, integrated.givens.unit), stations.left
    axis, origin = hand.earlier_places(diagram, "axis"), hand.given("origin")
    after, before = hand.earlier_places(diagram, "plotted"), hand.earlier_places(diagram, "near side")
    uprights = hand.erect("uprights", axis)
    chords = hand.join("chords", after[left], before[left + 1])
    middles = hand.divide("middles of the parts", axis[left], axis[left + 1], 0.5)
    rays = hand.parallel("rays", chords, hand.lay_off("P3", origin, -RIGHT, pole))
    heights = hand.cross("heights", rays, hand.given("vertical axis", along=UP), flat=True)
    found = hand.project("j", heights, hand.erect("ordinates", middles))
    curve = _to_the_ends(hand, stations, found, uprights)
    pieces = list(curve_pieces(stations))
    ends = (
        distance_between(origin, hand.tangent("highest j", curve, pieces, UP), UP),
        distance_between(hand.tangent("lowest j", curve, pieces, -UP), origin, UP),
    )
    mu_j = np.asarray(integrated.readings["a"].scale) / (mu_phi.per_mm * pole)
    hand.read("j", distance_between(origin, found, UP), mu_j)
    along = calculated_setting(mu_phi.value, distance_between(origin, found, RIGHT))
    hand.read("j_at", along, 1.0, "rad", rounded=False)
    hand.read("max_j", calculated_setting(np.maximum, *ends), mu_j)
    return hand.finished(JerkGivens(integrated, pole), _draw, {"j": found, "curve": curve})


def _own_parts(stations: Stations) -> list[np.ndarray]:
    """The numbers of the parts in every stretch between jumps and corners of the acceleration."""
    left = stations.left
    return [np.flatnonzero((left >= s.start) & (left < s.stop - 1)) for s in stations.stretches]


def curve_pieces(stations: Stations) -> list[slice]:
    """The smooth pieces of the curve: the start of every stretch, the middles of its parts, and its end."""
    sizes = [parts.size + 2 for parts in _own_parts(stations)]
    stops = np.cumsum(sizes).tolist()
    return [slice(stop - size, stop) for size, stop in zip(sizes, stops, strict=True)]


def _to_the_ends(hand: Hand, stations: Stations, found: Drawn, uprights: Drawn) -> Drawn:
    """The points of the curve, with those to which it is carried on at the ends of every stretch."""
    own = list(zip(stations.stretches, _own_parts(stations), strict=True))
    # One part alone tells no slope: there the curve is level.
    several = [(parts, s) for s, parts in own if parts.size > 1]
    alone = [(parts[0], at) for s, parts in own if parts.size == 1 for at in (s.start, s.stop - 1)]
    near = [(parts[k], parts[n], at) for parts, s in several for k, n, at in ((0, 1, s.start), (-1, -2, s.stop - 1))]
    rows: list[Drawn] = []
    if near:
        outer, inner, at = np.array(near).T
        rows.append(hand.cross("carried on", hand.join("last two", found[inner], found[outer]), uprights[at]))
    if alone:
        part, at = np.array(alone).T
        rows.append(hand.project("level ends", found[part], uprights[at]))
    which, carried, level, first = list[int](), 0, 2 * len(several), 2 * len(own)
    for _, parts in own:
        start = carried if parts.size > 1 else level
        carried, level = (carried + 2, level) if parts.size > 1 else (carried, level + 2)
        which += [start, *(first + parts).tolist(), start + 1]
    return hand.take("curve", *rows, found, which=np.array(which))


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(c: DrawnJerk) -> list[Step]:
    return [_chords(c), _with_rays(c), _curve_step(c), _scale(c)]


def _steepest(c: DrawnJerk) -> int:
    """The number of the part that is worked in full."""
    return int(np.argmax(np.abs(c.acts["heights"].first.shown.imag)))


def _chords(c: DrawnJerk) -> Step:
    chords, names, k = c.acts["chords"].first, part_names(c.givens.integrated.givens.stations), _steepest(c)
    slopes = [run_of_chord(way) for way in chords.directions.tolist()]
    said = say(
        "In the acceleration diagram join with the ruler the ends of the ordinates at neighbouring stations, on the "
        "near side of every jump: chord {name} runs {slope}."
    ).with_values(name=names[k], slope=slopes[k])
    part = telling.run(said, say("Chord {name}"), names, chords, settings=slopes.__getitem__)
    why = say("The slope of a chord is very nearly that of the acceleration in the middle of the part.")
    return Step(say("Chords of a"), (part,), ACCELERATION, (chords.segments(Role.LIMIT),), why=why)


def _heights(c: DrawnJerk) -> Floats:
    """The heights [mm of paper] to which the diagram and its arrows reach."""
    low, high = height_range(c.acts["curve"].first.shown.imag)
    jumps = [jump.size for jump in acceleration_jumps(c.givens.integrated.givens.motion)]
    up, down = any(size > 0 for size in jumps), any(size < 0 for size in jumps)
    return np.array(
        [
            min(low - ARROW_OVERHANG, -MIN_INFINITE_ARROW) if down else low,
            max(high + ARROW_OVERHANG, MIN_INFINITE_ARROW) if up else high,
        ]
    )


def _with_rays(c: DrawnJerk) -> Step:
    givens, rays, heights, found = c.givens.integrated.givens, *(c.acts[n].first for n in ("rays", "heights", "j"))
    names, k, distance = part_names(givens.stations), _steepest(c), c.givens.pole
    pole = pole_marks(c.acts["P3"], distance, "₃", heights.shown.imag)
    groups = coinciding_heights(heights)
    kept = [int(group[0]) for group in groups]
    axes = (*givens.axes("j", _heights(c)), *pole)
    reach, shared_by = np.array([found.shown.real[group].max() for group in groups]), [g.tolist() for g in groups]
    marks = (
        Segments(rays.shown[kept], heights.shown[kept], Role.CONSTRUCTION, of=rays.act, index=rays.index[kept]),
        *(found.segments_from(heights, Role.CONSTRUCTION), found.dots(Role.CONSTRUCTION)),
        *ray_numbers(heights[kept], reach, shared_by, partial(joined_parts, stations=givens.stations)),
    )
    ends = [height_caption(y, say("at the origin")) for y in heights.shown.imag.tolist()]
    said = say(
        "Over a new axis mark the pole P₃, H₃ = {distance:g} mm to the left of 0. Slide the set square from each chord "
        "to P₃ and draw the ray, parallel to the chord, as far as the vertical axis; with the T-square carry the level "
        "of its end to the vertical in the middle of the part. Ray {name} ends {height}."
    ).with_values(distance=distance, name=names[k], height=ends[k])
    said = sequence([said, *close_ends_caption(heights[kept])], " ")
    part = telling.run(said, say("Ray {name}"), names, rays, heights, found, settings=ends.__getitem__)
    why = say("The triangle of pole, origin and height has the slope of the chord, so the height is H₃ times it.")
    title, under = say("Pole and rays, a to j"), givens.degrees_under(_heights(c))
    return Step(title, (part,), JERK, (*axes, *marks), given=axes, why=why, under=under)


def _curve_step(c: DrawnJerk) -> Step:
    givens, curve, hand = c.givens.integrated.givens, c.acts["curve"].first, errorless_hand(c)
    names, marks, rows = station_names(givens.stations), list[Mark](), list[Row]()
    for piece, stretch in zip(curve_pieces(givens.stations), givens.stations.stretches, strict=True):
        faired = hand.fair("curve of j", curve, [piece])
        marks.append(faired.line(Role.RESULT))
        called = telling.stretch_caption(names[stretch.start], names[stretch.stop - 1])
        rows.append(Row(called, "", (faired,)))
    said = [
        say(
            "Between jumps and corners of the acceleration join the points with the French curve, and carry it on "
            "straight to the stations at both ends. In the dwells the jerk is zero."
        )
    ]
    if jumps := acceleration_jumps(givens.motion):
        marks += _arrows(c)
        places = sequence([degrees(jump.phi) for jump in jumps])
        jumping = say("At {places} the acceleration jumps: there the jerk is infinite, as an arrow shows.")
        said.append(jumping.with_values(places=places))
    else:
        said.append(say("The acceleration nowhere jumps, so the jerk is finite everywhere."))
    why = say("The slope is found in the middles, and is wanted everywhere between the places where it jumps.")
    return Step(say("Curve of j"), (Part(sequence(said, " "), rows=tuple(rows)),), JERK, tuple(marks), why=why)


def _arrows(c: DrawnJerk) -> list[Mark]:
    """Arrows with the sign of infinity where the acceleration jumps; a jump at 0 is shown at the end of the turn."""
    givens, (low, high) = c.givens.integrated.givens, _heights(c).tolist()
    marks = list[Mark]()
    for jump in acceleration_jumps(givens.motion):
        foot = complex(givens.mu_phi.paper(jump.phi or FULL_TURN))
        tip = foot + UP * (high if jump.size > 0 else low)
        marks += [Arrow(foot, tip, Role.LIMIT), Label(tip, "∞", towards=-1 + 0j)]
    return marks


def _scale(c: DrawnJerk) -> Step:
    givens, read = c.givens.integrated.givens, c.readings["j"]
    mu, lift, mu_a = read.per_mm, unit(givens.unit), c.givens.integrated.readings["a"].per_mm
    values = {"mu_a": mu_a, "mu_phi": givens.mu_phi.per_mm, "pole": c.givens.pole, "mu": mu, "unit": lift}
    values |= {"mm": (greatest := float(c.first("max_j"))), "value": float(c.value("max_j"))}
    found = say("The maximum finite jerk is {mm:.2f} mm × {mu:.5g} = {value:.5g} {unit}/rad³.")
    if greatest < NEGLIGIBLE_SIZE:
        found = say("Between its jumps the acceleration is constant, so the finite jerk is zero.")
    gives = say("The pole gives μⱼ = μₐ/(μᵩ·H₃) = {mu_a:.5g}/({mu_phi:.5g}·{pole:g}) = {mu:.5g} ({unit}/rad³)/mm.")
    told = [gives.with_values(**values), found.with_values(**values)]
    heights, end = c.acts["curve"].first.shown.imag, givens.end
    # At the end of the turn an arrow may stand.
    end += GRADUATION_OFFSET if any(not jump.phi for jump in acceleration_jumps(givens.motion)) else 0.0
    marks = list[Mark]()
    if height_range(heights) != (0.0, 0.0):
        marks += graduation_marks(heights, mu, end, read.act, name=ordinate_title("j", givens.unit))
    if givens.omega is not None:
        told.append(time_scale_caption(mu, "j", givens.omega, givens.unit))
        marks += graduated_at_speed(heights, mu, "j", givens.omega, givens.unit, end, read.act) if marks else []
    part = Part(sequence(told, " "))
    why = say("A ray cuts off H₃ times a slope on paper, where a and φ have their scales.")
    return Step(say("The scale of j"), (part,), JERK, tuple(marks), ("j", "max_j"), why=why)
