"""Lift, velocity, acceleration and pressure angle of a roller on a cam of arcs, over the cam angle."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np

from graphcam.constructions.arc_outline import unreadable_step
from graphcam.constructions.arc_plan import worked_station
from graphcam.constructions.arc_profile import RollerOnArcs
from graphcam.constructions.axes import (
    PHASES_OFFSET,
    axes_over_phi,
    degrees_below,
    height_range,
    ordinate_title,
    standing_apart,
)
from graphcam.constructions.graduation import graduation_marks
from graphcam.constructions.views import ACCELERATION, ANGLE, DISPLACEMENT, VELOCITY
from graphcam.drafting import telling
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Construction, Part, Step, View, Words, say
from graphcam.drafting.marks import Dimension, Label, Mark, Role, Segments
from graphcam.drafting.meaning import ComparedReading, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import GOST_2_302, NEGLIGIBLE_SIZE, Scale, standard_scale
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.words import sequence

VIEWS: Mapping[str, View] = {"a": ACCELERATION, "v": VELOCITY, "s": DISPLACEMENT, "alpha": ANGLE}
"""From the top down."""
SYMBOLS = {"a": "a", "v": "v", "s": "s", "alpha": "α"}
MIRROR_SIGNS = {"a": 1, "v": -1, "s": 1, "alpha": -1}
"""What becomes of a quantity on the mirrored flank, which is run over backwards."""
ENDS = {"highest": UP, "lowest": -UP}
DIAGRAM_HEIGHTS = {"a": 100.0, "v": 80.0, "s": 60.0}
"""Each diagram takes the largest standard scale at which it is not higher [mm of paper]."""


@dataclass(frozen=True, eq=False)
class ArcDiagramsGivens:
    """What lies on the board; see :func:`arc_diagrams`."""

    rolled: RollerOnArcs
    mu_phi: Scale
    heights: Mapping[str, float]


MEANING = Meaning(
    "arc_diagrams",
    say("Motion of the follower"),
    say(
        "The readings at the stations, plotted over the cam angle. The acceleration jumps where one arc meets the next."
    ),
    {
        "lift": ReadingMeaning(say("lift h"), "h", "mm"),
        "max_v": ReadingMeaning(
            say("maximum v"),
            "max v",
            "mm/rad",
            (ComparedReading("max_v", candidates="v_candidates", ranks=(np.positive,)),),
        ),
        "max_a": ReadingMeaning(
            say("maximum a"),
            "max a",
            "mm/rad²",
            (ComparedReading("max_a", candidates="a_candidates", ranks=(np.positive,)),),
        ),
        "max_alpha": ReadingMeaning(
            say("maximum α"),
            "max α",
            "rad",
            (
                ComparedReading(
                    "max_pressure_angle_rise_deg", say("maximum α, rise"), "alpha_candidates", (np.positive,)
                ),
                ComparedReading(
                    "max_pressure_angle_return_deg",
                    say("maximum α, return"),
                    "alpha_candidates",
                    (np.positive,),
                    sign=-1,
                ),
            ),
        ),
    },
    scales={"acceleration": "max_a", "velocity": "max_v", "displacement": "lift", "angle": "max_alpha"},
)


def arc_diagrams(
    rolled: RollerOnArcs, mu_phi: Scale, pencil: Pencil, heights: Mapping[str, float] = DIAGRAM_HEIGHTS
) -> Construction[ArcDiagramsGivens]:
    """Carry what was found at the stations over to diagrams, fair the curves arc by arc, and read their tops.

    mu_phi : scale of the cam angle, and of the pressure angle [rad/mm]
    heights : that the diagrams of a, v and s should keep to [mm of paper]

    Readings besides those of the meaning: the candidates (..., 2), highest and lowest, for each of the greatest.
    Points: the plotted ``a``, ``v``, ``s`` and ``alpha`` of the rise, and ``a_tops`` ..., highest and lowest.
    """
    hand, stations, turn = Hand(pencil, MEANING), rolled.givens.stations, rolled.readings["edges"]
    o = hand.given("O")
    over = partial(_over_the_turn, rolled.givens.arcs.givens.dwell / mu_phi.per_mm, FULL_TURN / mu_phi.per_mm)
    ends = hand.lay_off("ends", o, RIGHT, calculated_setting(over, hand.carry(turn, 1 / mu_phi.per_mm)))
    feet = hand.divide("stations", ends[stations.arc], ends[stations.arc + 1], stations.u)
    points: dict[str, Drawn] = {}
    for name in VIEWS:
        source = rolled.readings[name]
        scale = mu_phi.per_mm if name == "alpha" else _scale(rolled, name, heights[name]).per_mm
        points[name] = hand.lay_off(name, feet, UP, hand.carry(source, source.scale / scale))
        if name == "s":
            hand.read("lift", distance_between(o, points[name][-1], UP), scale)
            continue
        sides = [hand.tangent(f"{name} {end}", points[name], stations.spans, way) for end, way in ENDS.items()]
        points[f"{name}_tops"] = hand.take(f"{name}_tops", *sides)
        greatest = calculated_setting(np.abs, distance_between(o, points[f"{name}_tops"], UP))
        hand.read(f"max_{name}", calculated_setting(partial(np.max, axis=-1), greatest), scale)
        hand.read(f"{name}_candidates", greatest, scale, source.unit)
    return hand.finished(ArcDiagramsGivens(rolled, mu_phi, heights), _draw, points)


def _over_the_turn(dwell: float, turn: float, edges: Floats) -> Floats:
    """Where the arcs, the ``dwell`` and the turn begin and end, (..., 9), from the ``edges`` (..., 4) of the rise."""
    down = 2 * edges[..., -1:] + dwell - edges[..., ::-1]
    return np.concatenate([edges, down, np.full_like(down[..., :1], turn)], axis=-1)


def _scale(rolled: RollerOnArcs, name: str, height: float) -> Scale:
    """The scale at which a diagram is at most ``height`` mm high, by the readings of the first sample."""
    values: Floats = np.nan_to_num(rolled.value(name))
    low, high = min(0.0, float(values.min())), max(0.0, float(values.max()))
    # On the return the velocity goes as far down as it went up.
    size = (2 * high if name == "v" else high - low) or 1.0
    # The scale of a diagram is no drawing scale, so that the finer series serves every frame.
    return rolled.givens.arcs.givens.paper.kept_scale(name) or standard_scale(size, height, GOST_2_302)


# --- the steps -------------------------------------------------------------------------------------------------------


TITLES = {
    "a": say("Acceleration over the cam angle"),
    "v": say("Velocity over the cam angle"),
    "s": say("Displacement over the cam angle"),
    "alpha": say("Pressure angle over the cam angle"),
}
SPAN_CAPTIONS = (
    say("rise {angle:.2f}°"),
    say("dwell {angle:.2f}°"),
    say("return {angle:.2f}°"),
    say("dwell {angle:.2f}°"),
)
"""The phases and their angles."""
PLOT_CAPTIONS = {
    "a": say(
        "Plot the accelerations OM over the cam angle, {degree:.4g}° a millimetre. Each is laid off at {mu:g} "
        "(mm/rad²)/mm, up from the axis if M lies beyond O, otherwise down: for station {name}, {there}. Where two "
        "arcs meet, each has its own."
    ),
    "v": say(
        "Plot the velocities OK over the cam angle, {degree:.4g}° a millimetre. Each is laid off at {mu:g} "
        "(mm/rad)/mm, up from the axis: for station {name}, {there}."
    ),
    "s": say(
        "Plot the displacements over the cam angle, {degree:.4g}° a millimetre. The distance of B outside the "
        "prime circle is laid off at {mu:g} mm/mm, up from the axis: for station {name}, {there}. The lift measures "
        "{paper:.2f} mm, which is {value:.3f} mm."
    ),
    "alpha": say(
        "Plot the angles between rod and ray over the cam angle, {degree:.4g}° a millimetre. Each is laid off at "
        "{mu:g}° a millimetre, up from the axis: for station {name}, {there}."
    ),
}
MAXIMUM_CAPTIONS = {
    "a": say("The maximum magnitude is {value:.3f} mm/rad²."),
    "v": say("The maximum is {value:.3f} mm/rad."),
    "alpha": say("The maximum is {value:.3f}°."),
}
RETURN_CAPTIONS = {
    1: say(
        "Return: mirror the curve of the rise in the vertical at {middle:.2f} mm, half-way between rise and return."
    ),
    -1: say(
        "Return: rotate the curve of the rise by 180° about the point at {middle:.2f} mm on the axis, half-way between "
        "rise and return."
    ),
}
"""How the curve goes on, by what becomes of the quantity on the return."""
REASONS = {
    "a": say(
        "The force that moves the follower is proportional to its acceleration, which jumps where the radius of "
        "the arc changes."
    ),
    "v": say(
        "On the mirrored flank the follower goes down as it went up, so the same velocities recur with the "
        "opposite sign."
    ),
    "s": say("The follower has risen by the increase of OB since the start."),
    "alpha": say("The follower may jam where this angle is large, so its maximum decides whether the cam is usable."),
}


def _draw(plotted: Construction[ArcDiagramsGivens]) -> list[Step]:
    if np.isnan(plotted.givens.rolled.first("phi")).any():
        said = say("Without a path of the roller there is nothing to plot.")
        return [unreadable_step(say("No diagrams"), said, DISPLACEMENT)]
    return [_diagram(plotted, name) for name in VIEWS]


def _diagram(plotted: Construction[ArcDiagramsGivens], name: str) -> Step:
    hand, mu_phi, ends = errorless_hand(plotted), plotted.givens.mu_phi, plotted.acts["ends"].first
    curve, dots, feet = _whole_turn(plotted, hand, name), plotted.acts[name].first, plotted.acts["stations"].first
    low, high = height_range(curve.shown.imag)
    end, per_mm = float(ends.shown[-1].real), _per_mm(plotted, name)
    axes = axes_over_phi(end, mu_phi, curve.shown.imag, ordinate_title(SYMBOLS[name], "mm"))
    axes += graduation_marks(curve.shown.imag, per_mm)
    below = degrees_below(end, mu_phi, low)
    axes += below if name == "alpha" else ()
    limits = hand.erect("limits", ends[1:])
    marks: list[Mark] = [
        *axes,
        Segments(limits.points + low * UP, limits.points + high * UP, Role.CONSTRUCTION).left_by(limits),
        dots.segments_from(feet, Role.CONSTRUCTION),
        *(dots.dots(Role.CONSTRUCTION), curve.line(Role.RESULT)),
        *(_phases(ends, mu_phi, low - PHASES_OFFSET) if name == "alpha" else ()),
    ]
    stations, key = plotted.givens.rolled.givens.stations, "lift" if name == "s" else f"max_{name}"
    lengths, paper = _lengths(plotted, name), float(plotted.first(key))
    at, middle = worked_station(stations, (dots.shown - feet.shown).imag), float(ends.shown.real[3:5].mean())
    values = {"degree": float(np.degrees(mu_phi.per_mm)), "mu": per_mm, "paper": paper, "value": paper * per_mm}

    def laid_off(k: int) -> Words:
        """What is laid off at a station, in mm of paper."""
        place, x = dots.shown[k], round(float(feet.shown[k].real), 2)
        if np.isnan(place):
            return say("nothing was read, so nothing is plotted at {x:g} mm", x=x)
        said = say("{length} at {x:g} mm")
        if name == "a" and abs(place.imag) > NEGLIGIBLE_SIZE:
            said = say("{length} up at {x:g} mm") if place.imag > 0 else say("{length} down at {x:g} mm")
        return said.with_values(length=lengths[k], x=x)

    carried = PLOT_CAPTIONS[name].with_values(**values, name=stations.names[at], there=laid_off(at))
    parts = [
        _edges(ends, limits),
        telling.run(carried, telling.STATION, stations.titles, feet, dots, settings=laid_off),
        *_along_the_curve(plotted, name, curve, middle),
    ]
    if name != "s" and np.isfinite(paper):
        found, touched = _maximum(plotted, hand, name, values)
        marks, parts = marks + found, [*parts, touched]
    marks += _names(plotted, dots)  # the number of the maximum finds its place first
    under = () if name == "alpha" else below
    return Step(TITLES[name], tuple(parts), VIEWS[name], tuple(marks), (key,), axes, why=REASONS[name], under=under)


def _maximum(
    plotted: Construction[ArcDiagramsGivens], hand: Hand, name: str, values: Mapping[str, Any]
) -> tuple[list[Mark], Part]:
    """The marks and the part of the place where a level line touches the curve farthest from the axis."""
    tops = plotted.acts[f"{name}_tops"].first
    top = hand.take("top", tops, which=int(np.argmax(np.abs(tops.shown.imag))))
    side, read = np.sign(top.place.imag), plotted.readings[f"max_{name}"].act
    touched = say("Slide the T-square down until it touches the curve: {paper:.2f} mm above the axis.")
    if side < 0:
        touched = say("Slide the T-square up until it touches the curve: {paper:.2f} mm below the axis.")
    shown = say("{value:.2f}°") if name == "alpha" else say("{value:.2f}")
    number = Label(top.place, shown.with_values(value=side * values["value"]), side * UP, of=read)
    said = sequence([each.with_values(**values) for each in (touched, MAXIMUM_CAPTIONS[name])], " ")
    return [top.dots(Role.LIMIT), number], Part(said, (top,))


def _per_mm(plotted: Construction[ArcDiagramsGivens], name: str) -> float:
    """The scale of a diagram [unit/mm], in degrees for the pressure angle."""
    if name == "alpha":
        return math.degrees(plotted.givens.mu_phi.per_mm)
    return plotted.readings["lift" if name == "s" else f"max_{name}"].per_mm


def _lengths(plotted: Construction[ArcDiagramsGivens], name: str) -> list[Words]:
    """The lengths laid off at the stations, each with its origin."""
    dots, degrees = plotted.acts[name].first, np.degrees(plotted.givens.rolled.first(name)).tolist()
    if name != "alpha":
        return [telling.setting(dots[k]) for k in range(dots.shown.size)]
    paper = dots.shown.imag.tolist()
    said = say("{degrees:.2f}° are {paper:.2f} mm")
    return [
        said.with_values(degrees=a, paper=y) if y > NEGLIGIBLE_SIZE else "0"
        for a, y in zip(degrees, paper, strict=True)
    ]


def _edges(ends: Drawn, limits: Drawn) -> Part:
    # Without an upper dwell the return begins where the rise ends.
    places = sequence([say("{at:.2f}", at=x) for x in np.unique(ends.shown[1:].real.round(6)).tolist()])
    said = say("On the axis mark the ends of arcs and phases from 0, at {places} mm, and draw a thin vertical in each.")
    return Part(said.with_values(places=places), (ends, limits))


def _along_the_curve(plotted: Construction[ArcDiagramsGivens], name: str, curve: Drawn, middle: float) -> list[Part]:
    """The parts that draw the curve over the rise, the dwells and the return."""
    arcs, ends = plotted.givens.rolled.givens.arcs, plotted.acts["ends"].shown.real
    n = (curve.shown.size - 4) // 2
    held = Part(say("Upper dwell: a horizontal line, drawn with the T-square."), (curve[n : n + 2],))
    back = RETURN_CAPTIONS[MIRROR_SIGNS[name]].with_values(middle=middle)
    return [
        Part(say("Join the points with the French curve, each arc by itself."), (curve[:n],)),
        *([held] if arcs.givens.dwell else []),
        Part(back, (curve[n + 2 : -2] if arcs.givens.dwell else curve[n:-2],)),
        Part(say("Lower dwell: go over the axis as far as {end:.2f} mm.", end=ends[-1]), (curve[-2:],)),
    ]


def _names(plotted: Construction[ArcDiagramsGivens], dots: Drawn) -> list[Mark]:
    """The names of the plotted stations, as many as have room."""
    stations, at = plotted.givens.rolled.givens.stations, dots.shown
    return [
        dots[k].label(stations.names[k], UP if at[k].imag >= 0 else -UP, small=True)
        for k in standing_apart(at, stations.ends_first)
    ]


def _whole_turn(plotted: Construction[ArcDiagramsGivens], hand: Hand, name: str) -> Drawn:
    """The curve over the turn: the faired rise, the dwell, the rise mirrored, the rest."""
    places, o, ends = (plotted.acts[each].first for each in (name, "O", "ends"))
    known = [places[span][~np.isnan(places.shown[span])] for span in plotted.givens.rolled.givens.stations.spans]
    pieces = [hand.fair(f"arc {k}", piece, [slice(None)]) for k, piece in enumerate(known)]
    rise = hand.take("rise", o, *pieces)
    backwards, middle = rise[np.arange(rise.shown.size)[::-1]], hand.divide("middle", ends[3], ends[4], 0.5)
    back = hand.mirrored("return", backwards, hand.erect("middle of the dwell", middle))
    if MIRROR_SIGNS[name] < 0:
        back = hand.enlarged("half a turn", backwards, middle, -1, middle.place)
    dwell = hand.raised("dwell", ends[3:5], distance_between(o, places[-1], UP)) if name == "s" else ends[3:5]
    return hand.take("turn", rise, dwell, back, ends[-2:])


def _phases(ends: Drawn, mu_phi: Scale, height: float) -> list[Mark]:
    """The angles of rise, dwells and return; the last one takes what rounding the others leaves of the turn."""
    bounds = ends.shown[[0, 3, 4, 7, 8]] + UP * height
    angles = np.degrees(np.diff(bounds.real) * mu_phi.per_mm).round(2)
    angles[-1] = 360 - angles[:-1].sum()
    return [
        Dimension(a, b, said.with_values(angle=angle)).left_by(ends[3:4])
        for (a, b), said, angle in zip(pairwise(bounds), SPAN_CAPTIONS, angles, strict=True)
        if abs(b - a) > 0
    ]
