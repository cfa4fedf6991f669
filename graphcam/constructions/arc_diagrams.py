"""Lift, velocity, acceleration and pressure angle of a roller on a cam of arcs, over the cam angle."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from itertools import pairwise

import numpy as np

from graphcam.constructions.arc_roller import RollerOnArcs
from graphcam.constructions.axes import axes_over_phi, degree_ticks, reach
from graphcam.constructions.views import ACCELERATION, ANGLE, DISPLACEMENT, VELOCITY
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, between, reckoned, showing
from graphcam.drafting.ink import Construction, Step, View, say
from graphcam.drafting.marks import Dimension, Label, Mark, Role, Segments
from graphcam.drafting.meaning import Compared, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, standard_scale
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN

VIEWS: Mapping[str, View] = {"a": ACCELERATION, "v": VELOCITY, "s": DISPLACEMENT, "alpha": ANGLE}
"""From the top down."""
SYMBOLS = {"a": "a", "v": "v", "s": "s", "alpha": "α"}
MIRROR = {"a": 1, "v": -1, "s": 1, "alpha": -1}
"""What becomes of a quantity on the mirrored flank, which is run over backwards."""
ENDS = {"highest": UP, "lowest": -UP}
HEIGHTS = {"a": 100.0, "v": 80.0, "s": 60.0}
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
    say("What was read at the stations, over the cam angle. Where the arcs change, the acceleration jumps."),
    {
        "lift": ReadingMeaning(say("lift h"), "h", "mm"),
        "max_v": ReadingMeaning(
            say("greatest v"), "max v", "mm/rad", (Compared("max_v", candidates="v_candidates", ranks=(np.positive,)),)
        ),
        "max_a": ReadingMeaning(
            say("greatest a"), "max a", "mm/rad²", (Compared("max_a", candidates="a_candidates", ranks=(np.positive,)),)
        ),
        "max_alpha": ReadingMeaning(
            say("greatest α"),
            "max α",
            "rad",
            (
                Compared("max_pressure_angle_rise_deg", say("greatest α, rise"), "alpha_candidates", (np.positive,)),
                Compared(
                    "max_pressure_angle_return_deg",
                    say("greatest α, return"),
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
    rolled: RollerOnArcs, mu_phi: Scale, pencil: Pencil, heights: Mapping[str, float] = HEIGHTS
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
    ends = hand.lay_off("ends", o, RIGHT, reckoned(over, hand.carry(turn, 1 / mu_phi.per_mm)))
    feet = hand.divide("stations", ends[stations.arc], ends[stations.arc + 1], stations.u)
    points: dict[str, Drawn] = {}
    for name in VIEWS:
        source = rolled.readings[name]
        scale = mu_phi.per_mm if name == "alpha" else _scale(rolled, name, heights[name]).per_mm
        points[name] = hand.lay_off(name, feet, UP, hand.carry(source, source.scale / scale))
        if name == "s":
            hand.read("lift", between(o, points[name][-1], UP), scale)
            continue
        sides = [hand.tangent(f"{name} {end}", points[name], stations.spans, way) for end, way in ENDS.items()]
        points[f"{name}_tops"] = hand.take(f"{name}_tops", *sides)
        greatest = reckoned(np.abs, between(o, points[f"{name}_tops"], UP))
        hand.read(f"max_{name}", reckoned(partial(np.max, axis=-1), greatest), scale)
        hand.read(f"{name}_candidates", greatest, scale, source.unit)
    return hand.finished(ArcDiagramsGivens(rolled, mu_phi, heights), _draw, points)


def _over_the_turn(dwell: float, turn: float, edges: Floats) -> Floats:
    """Where the arcs, the ``dwell`` and the turn begin and end, (..., 9), from the rise's ``edges`` (..., 4)."""
    down = 2 * edges[..., -1:] + dwell - edges[..., ::-1]
    return np.concatenate([edges, down, np.full_like(down[..., :1], turn)], axis=-1)


def _scale(rolled: RollerOnArcs, name: str, height: float) -> Scale:
    """The scale of a diagram that should not be higher, by what is read in the first sample."""
    values: Floats = np.nan_to_num(rolled.value(name))
    low, high = min(0.0, float(values.min())), max(0.0, float(values.max()))
    # On the return the velocity goes as far down as it went up.
    return standard_scale((2 * high if name == "v" else high - low) or 1.0, height)


# --- the steps -------------------------------------------------------------------------------------------------------


TITLES = {
    "a": say("Acceleration over the cam angle"),
    "v": say("Velocity over the cam angle"),
    "s": say("Displacement over the cam angle"),
    "alpha": say("Pressure angle over the cam angle"),
}
SPANS = say("rise {angle:.2f}°"), say("dwell {angle:.2f}°"), say("return {angle:.2f}°"), say("rest {angle:.2f}°")
"""The phases and their angles."""
CARRIED = {
    "a": say(
        "Plotted over the cam angle, {degree:.4g}° a millimetre, are the accelerations OM, laid off at {mu:g} "
        "(mm/rad²)/mm; they jump where one arc takes over from another. The greatest measures {paper:.2f} mm, which is "
        "{value:.3f} mm/rad². The curve is faired arc by arc, and the return is the mirror image."
    ),
    "v": say(
        "Plotted over the cam angle, {degree:.4g}° a millimetre, are the velocities OK, laid off at {mu:g} "
        "(mm/rad)/mm. The greatest measures {paper:.2f} mm, which is {value:.3f} mm/rad. The curve is faired arc by "
        "arc, and the return is the mirror image."
    ),
    "s": say(
        "Plotted over the cam angle, {degree:.4g}° a millimetre, are the displacements, laid off at {mu:g} mm/mm, up "
        "to the lift of {lift:.3f} mm. The curve is faired arc by arc, and the return is the mirror image."
    ),
    "alpha": say(
        "Plotted over the cam angle, {degree:.4g}° a millimetre, are the angles between the line of centres and the "
        "ray, laid off at {mu:g}° a millimetre. The greatest is {value:.3f}°. The curve is faired arc by arc, and the "
        "return is the mirror image."
    ),
}


def _draw(plotted: Construction[ArcDiagramsGivens]) -> list[Step]:
    if np.isnan(plotted.givens.rolled.first("phi")).any():
        said = say("Without a path of the roller there is nothing to plot.")
        return [Step(say("No diagrams"), said, DISPLACEMENT, ())]
    return [_diagram(plotted, name) for name in VIEWS]


def _diagram(plotted: Construction[ArcDiagramsGivens], name: str) -> Step:
    hand, mu_phi, ends = showing(plotted), plotted.givens.mu_phi, plotted.acts["ends"].first
    curve = _whole_turn(plotted, hand, name)
    low, high = reach(curve.shown.imag)
    axes = axes_over_phi(float(ends.shown[-1].real), curve.shown.imag, SYMBOLS[name])
    axes += degree_ticks(mu_phi) if name == "alpha" else ()
    limits = hand.erect("limits", ends[1:])
    marks: list[Mark] = [
        *axes,
        Segments(limits.points + low * UP, limits.points + high * UP, Role.CONSTRUCTION, of=limits.act),
        plotted.acts[name].dots(Role.CONSTRUCTION),
        curve.line(Role.RESULT),
        *(_phases(ends, mu_phi, low - 24.0) if name == "alpha" else ()),
    ]
    key = "lift" if name == "s" else f"max_{name}"
    degree = np.degrees(mu_phi.per_mm)
    mu = degree if name == "alpha" else plotted.readings[key].per_mm
    values = {"degree": degree, "mu": mu, "lift": float(plotted.value("lift"))}
    if name != "s":
        tops, paper = plotted.acts[f"{name}_tops"].first, float(plotted.first(key))
        top = hand.take("top", tops, which=int(np.argmax(np.abs(tops.shown.imag))))
        values, side = values | {"paper": paper, "value": paper * mu}, np.sign(top.place.imag)
        said = say("{value:.2f}", value=side * paper * mu)
        marks += [top.dots(Role.LIMIT), Label(top.place, said, side * UP, of=plotted.readings[key].act)]
    return Step(TITLES[name], CARRIED[name].where(**values), VIEWS[name], tuple(marks), (key,), axes)


def _whole_turn(plotted: Construction[ArcDiagramsGivens], hand: Hand, name: str) -> Drawn:
    """The curve over the turn: the faired rise, the dwell, the rise mirrored, the rest."""
    places, o, ends = (plotted.acts[each].first for each in (name, "O", "ends"))
    known = [places[span][~np.isnan(places.shown[span])] for span in plotted.givens.rolled.givens.stations.spans]
    pieces = [hand.fair(f"arc {k}", piece, [slice(None)]) for k, piece in enumerate(known)]
    rise = hand.take("rise", o, *pieces)
    backwards, middle = rise[np.arange(rise.shown.size)[::-1]], hand.divide("middle", ends[3], ends[4], 0.5)
    back = hand.mirrored("return", backwards, hand.erect("middle of the dwell", middle))
    if MIRROR[name] < 0:
        back = hand.enlarged("half a turn", backwards, middle, -1, middle.place)
    dwell = hand.raised("dwell", ends[3:5], between(o, places[-1], UP)) if name == "s" else ends[3:5]
    return hand.take("turn", rise, dwell, back, ends[-2:])


def _phases(ends: Drawn, mu_phi: Scale, height: float) -> list[Mark]:
    """The angles of rise, dwell and return."""
    bounds = ends.shown[[0, 3, 4, 7, 8]] + UP * height
    spans = zip(pairwise(bounds), SPANS, np.degrees(np.diff(bounds.real) * mu_phi.per_mm), strict=True)
    return [Dimension(a, b, said.where(angle=angle), of=ends.act) for (a, b), said, angle in spans if angle > 0]
