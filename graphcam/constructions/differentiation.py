"""Graphical differentiation, twice: displacement to velocity to acceleration, by chords or by tangents.

It turns the integration round.  A ray through the pole parallel to a chord, or to a tangent, cuts the vertical axis at
the height y = H dy/dx: the ordinate of the derivative.  By chords it belongs to the middle of the interval, where it is
right to second order; by tangents to the station itself.  The scales follow as mu_v = mu_s/(mu_phi H1) and
mu_a = mu_v/(mu_phi H2).
"""

from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np

from graphcam.constructions.axes import SUBSCRIPTS, axes_over_phi, once, pole_marks
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import RIGHT, UP, divided
from graphcam.drafting.hand import Hand, between, reckoned, showing
from graphcam.drafting.ink import Caption, Construction, Step, View, say
from graphcam.drafting.marks import Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.drafting.units import unit
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.plane import dot
from graphcam.words import say_many, sequence

By = Literal["chords", "tangents"]
FEWEST = 4
"""Stations: with fewer no acceleration has a neighbour."""
TANGENT = 12.0
"""Half the length of a drawn tangent [mm of paper]."""

VIEWS = {
    "s": View("measured displacement", say("Measured displacement s"), across="measured phi", up="measured s"),
    "v": View("measured velocity", say("Velocity v by differentiation"), across="measured phi", up="measured v"),
    "a": View(
        "measured acceleration", say("Acceleration a by differentiation"), across="measured phi", up="measured a"
    ),
}
"""The drawings, by what they show."""


@dataclass(frozen=True, eq=False)
class DifferentiationGivens:
    """What lies on the board; see :func:`differentiation`."""

    x: Floats
    mu_phi: Scale
    mu_s: Scale
    poles: tuple[float, float]
    turn: float | None
    by: By


MEANING = Meaning(
    "differentiation",
    say("Velocity and acceleration by differentiation"),
    say(
        "The measured displacement, differentiated: a parallel to each chord through the pole cuts off the velocity "
        "in the middle of the interval. Differentiation enlarges every error of the hand."
    ),
    {
        "v": ReadingMeaning(say("velocity v"), "v", "lift/rad"),
        "a": ReadingMeaning(say("acceleration a"), "a", "lift/rad²"),
        "max_v": ReadingMeaning(say("greatest v"), "max v", "lift/rad"),
        "max_a": ReadingMeaning(say("greatest a"), "max a", "lift/rad²"),
    },
    scales={VIEWS["s"].name: "rise", VIEWS["v"].name: "v", VIEWS["a"].name: "a"},
    scales_found_by="integration",
)


def measured_differentiation(
    motion: Motion, parts: int, mu_phi: Scale, mu_s: Scale, poles: tuple[float, float], pencil: Pencil
) -> Construction[DifferentiationGivens]:
    """Differentiate the drawn curve of a measured motion over its turn, in equal parts, by chords.

    parts : of the turn;  the others as in :func:`differentiation`
    """
    turn = FULL_TURN / mu_phi.per_mm
    x = divided(0j, turn + 0j, parts).real[:-1]
    s = motion(x * mu_phi.per_mm)[0] / mu_s.per_mm
    return differentiation(x, s, mu_phi, mu_s, poles, pencil, turn=turn)


def differentiation(
    x: Floats,
    s: Floats,
    mu_phi: Scale,
    mu_s: Scale,
    poles: tuple[float, float],
    pencil: Pencil,
    *,
    turn: float | None = None,
    by: By = "chords",
) -> Construction[DifferentiationGivens]:
    """Differentiate a drawn displacement twice.

    x, s : (n,) stations on the axis of the cam angle, growing, and ordinates there [mm of paper]
    mu_phi, mu_s : scales of the axes [rad/mm; mm/mm or, of an arm, rad/mm]
    poles : H1 (displacement to velocity) and H2 (velocity to acceleration) [mm of paper]
    turn : length of one revolution [mm of paper] of a cyclic diagram, which goes on after the last station with the
        first; None for a diagram that ends there
    by : "chords", or "tangents" with a mirror ruler; the intervals may be unequal

    Readings besides those of the meaning: ``v_at`` and ``a_at``, the cam angles that they belong to; ``rise`` and
    ``run`` of every chord or tangent of s.

    Raises
    ------
    DesignError : there are fewer than four stations, they do not grow, or pass the end of the turn

    >>> import graphcam as gc
    >>> x = np.arange(0.0, 60.0, 10.0)
    >>> drawn = differentiation(x, x**2 / 100, gc.Scale(0.02, "rad"), gc.Scale(0.5, "mm"), (50.0, 50.0), gc.Pencil())
    >>> drawn.readings["v"].paper.round(9).tolist(), drawn.readings["v"].scale
    ([5.0, 15.0, 25.0, 35.0, 45.0], 0.5)
    >>> drawn.readings["v_at"].paper.tolist()
    [5.0, 15.0, 25.0, 35.0, 45.0]
    """
    x, s = np.asarray(x, dtype=np.float64), np.asarray(s, dtype=np.float64)
    _check(x, s, turn)
    hand, givens = Hand(pencil, MEANING, mu_s.unit), DifferentiationGivens(x, mu_phi, mu_s, poles, turn, by)
    origin = hand.given("origin")
    plotted = hand.lay_off("s", hand.lay_off("stations", origin, RIGHT, x), UP, s)
    (start, end), v = _derived(hand, givens, 1, plotted, _going_on(hand, turn, plotted))
    v_on = _going_on(hand, turn, v)
    _, a = _derived(hand, givens, 2, v, v_on)
    mu_v = mu_s.per_mm / (mu_phi.per_mm * poles[0])
    mu_a = mu_v / (mu_phi.per_mm * poles[1])
    hand.read("rise", between(start, end, UP), mu_s.per_mm, mu_s.unit)
    hand.read("run", between(start, end, RIGHT), mu_phi.per_mm, "rad", rounded=False)
    for name, derived, scale in (("v", v, mu_v), ("a", a, mu_a)):
        hand.read(name, between(origin, derived, UP), scale)
        hand.read(f"{name}_at", between(origin, derived, RIGHT), mu_phi.per_mm, "rad", rounded=False)
    hand.read("max_v", _greatest(hand, v, v_on), mu_v)
    hand.read("max_a", _greatest(hand, a, _going_on(hand, turn, a)), mu_a)
    return hand.finished(givens, _draw, {"s": plotted, "v": v, "a": a})


def _check(x: Floats, s: Floats, turn: float | None) -> None:
    checked = "stations of the displacement"
    if x.ndim != 1 or x.shape != s.shape or x.size < FEWEST:
        raise DesignError(checked, x.size, f"{FEWEST} or more, each with its ordinate")
    if not np.all(np.diff(x) > 0):
        raise DesignError(checked, "not in order", "growing along the axis", "sort them")
    if turn is not None and not x[-1] - x[0] < turn:
        remedy = "leave out the last one where it is the first one again"
        raise DesignError(checked, f"over {x[-1] - x[0]:g} mm", f"within one turn of {turn:g} mm", remedy)


def _going_on(hand: Hand, turn: float | None, curve: Drawn) -> Drawn:
    """The places of a curve; of a cyclic diagram in the turn before, in its own and in the one after."""
    if turn is None:
        return curve
    name, origin = curve.act.name, hand.given("origin")
    before, after = (hand.enlarged(f"{name} {k:+} turn", curve, origin, 1, k * turn) for k in (-1, 1))
    return hand.take(f"{name} going on", before, curve, after)


def _derived(
    hand: Hand, givens: DifferentiationGivens, number: int, curve: Drawn, going_on: Drawn
) -> tuple[tuple[Drawn, Drawn], Drawn]:
    """The derivative of a curve, and the two ends between which the rise and the run of each slope are read."""
    if givens.by == "chords":
        # Each slope belongs to the middle of its interval; after the last place of a turn follows the first again.
        count = curve.points.shape[-1]
        joined = curve if going_on is curve else going_on[count : 2 * count + 1]
        ends = joined[:-1], joined[1:]
        slopes, places = hand.join(f"slopes {number}", *ends), hand.divide(f"middles {number}", *ends, 0.5)
    else:
        # A mirror turned until the curve runs into its image without a corner stands on the normal.
        slopes, places = hand.tangents_at(f"slopes {number}", curve, partial(_directions, givens.turn)), curve
        ends = None
    pole = hand.lay_off(f"P{number}", hand.acts["origin"], -RIGHT, givens.poles[number - 1])
    rays = hand.parallel(f"rays {number}", slopes, pole)
    # However steep the ray: what it cuts off may lie far up, but is one point of the axis.
    heights = hand.cross(f"heights {number}", rays, hand.given("vertical axis", along=UP), flat=True)
    derived = hand.project("va"[number - 1], heights, hand.erect(f"ordinates {number}", places))
    return ends or (pole, heights), derived


def _directions(turn: float | None, points: Points) -> Points:
    """The directions at plotted points (..., n) of the curve through each and its neighbours."""
    if turn is not None:
        points = np.concatenate([points[..., -1:] - turn, points, points[..., :1] + turn], axis=-1)
    chord = np.diff(points)
    run, slope = chord.real, chord.imag / chord.real
    # The parabola through three points has the slope of either chord in its middle, and between them it is straight.
    bend = np.diff(slope) / (run[..., :-1] + run[..., 1:])
    inside = slope[..., :-1] + bend * run[..., :-1]
    if turn is None:
        start = slope[..., :1] - bend[..., :1] * run[..., :1]
        end = slope[..., -1:] + bend[..., -1:] * run[..., -1:]
        inside = np.concatenate([start, inside, end], axis=-1)
    return 1 + UP * inside


def _greatest(hand: Hand, curve: Drawn, going_on: Drawn) -> Setting:
    """The greatest ordinate up or down, where the faired curve turns; of a cyclic diagram over its ends too."""
    name, count, ends = curve.act.name, curve.points.shape[-1], list[Setting]()
    for side, word in ((UP, "highest"), (-UP, "lowest")):
        # Of a cyclic diagram begun on the other side, so that the farthest ordinate has neighbours on both.
        begin = count + np.argmin(dot(side, curve.points), axis=-1)[..., None] if going_on is not curve else 0
        places = hand.take(f"{name} about its {word}", going_on, which=begin + np.arange(count))
        top = hand.tangent(f"{word} {name}", places, [slice(None)], side)
        ends.append(between(hand.acts["origin"], top, side))
    return reckoned(np.maximum, *ends)


# --- the steps -------------------------------------------------------------------------------------------------------

_TRACED: dict[By, tuple[Caption, Caption]] = {
    "chords": (
        say("Chords of {source}"),
        say("The ends of neighbouring ordinates of {source} are joined by chords, {count} of them."),
    ),
    "tangents": (
        say("Tangents to {source}"),
        say(
            "At each of the {count} stations a mirror is set across the curve of {source} and turned until the curve "
            "runs into its image without a corner: it stands on the normal, and the tangent is drawn across it."
        ),
    ),
}
_RAYS: dict[By, Caption] = {
    "chords": say(
        "The pole P{index} lies H{index} = {pole:.1f} mm to the left on the axis. Through it a ray is drawn parallel "
        "to each of the chords; what it cuts off on the vertical axis is the ordinate of {target} in the middle of its "
        "interval."
    ),
    "tangents": say(
        "The pole P{index} lies H{index} = {pole:.1f} mm to the left on the axis. Through it a ray is drawn parallel "
        "to each of the tangents; what it cuts off on the vertical axis is the ordinate of {target} at its station."
    ),
}


def _draw(c: Construction[DifferentiationGivens]) -> list[Step]:
    return [_draw_source(c), *_draw_pass(c, "s", "v", 1), *_draw_pass(c, "v", "a", 2), _draw_scales(c)]


def _draw_source(c: Construction[DifferentiationGivens]) -> Step:
    s, x = c.acts["s"], c.givens.x
    plotted = (*_axes(c, "s"), s.dots(), s.from_(c.acts["stations"], Role.CONSTRUCTION))
    said = say_many(
        "The displacement is plotted at {count} station.", "The displacement is plotted at {count} stations.", x.size
    )
    if c.givens.turn:
        said = sequence([said, say("After the last of them the revolution goes on with the first.")], " ")
    return Step(say("The displacement"), said, _view(c, "s"), (*plotted, _curve(c, "s")), given=plotted)


def _draw_pass(c: Construction[DifferentiationGivens], source: str, target: str, number: int) -> list[Step]:
    derived, distance, by = c.acts[target], c.givens.poles[number - 1], c.givens.by
    rays, heights, index = c.acts[f"rays {number}"], c.acts[f"heights {number}"], f"{number}".translate(SUBSCRIPTS)
    title, traced = (said.where(source=source, count=derived.shown.size) for said in _TRACED[by])
    kept, titled = once(heights), say("Pole and rays, {source} to {target}", source=source, target=target)
    axes = (*_axes(c, target), *pole_marks(c.acts[f"P{number}"], distance, index, heights.shown.imag))
    carried = (
        Segments(rays.shown[kept], heights.shown[kept], Role.CONSTRUCTION, of=rays.act),
        derived.from_(heights, Role.CONSTRUCTION),
    )
    smooth = say(
        "A smooth curve is faired through the plotted points; its greatest ordinate measures {greatest:.2f} mm."
    ).where(greatest=float(c.first(f"max_{target}")))
    parallel = _RAYS[by].where(index=index, pole=distance, target=target)
    return [
        Step(title, traced, _view(c, source), (_traces(c, number),)),
        Step(titled, parallel, _view(c, target), (*axes, *carried), given=axes),
        Step(say("Curve of {target}", target=target), smooth, _view(c, target), (derived.dots(), _curve(c, target))),
    ]


def _view(c: Construction[DifferentiationGivens], symbol: str) -> View:
    """The view, with its scale in the title."""
    view = VIEWS[symbol]
    scale = c.givens.mu_s.per_mm if symbol == "s" else c.readings[symbol].scale
    per = unit(c.givens.mu_s.unit) if symbol == "s" else sequence(["(", unit(c.readings[symbol].unit), ")"], "")
    values = {"title": view.title, "index": {"s": "ₛ", "v": "ᵥ", "a": "ₐ"}[symbol], "mu": scale}
    return replace(view, title=say("{title}, μ{index} = {mu:.4g} {per}/{mm}", per=per, mm=unit("mm"), **values))


def _traces(c: Construction[DifferentiationGivens], number: int) -> Mark:
    """The chords, or short pieces of the tangents."""
    slopes = c.acts[f"slopes {number}"]
    places, along = slopes.shown, slopes.first.directions
    if c.givens.by == "chords":
        return Line(np.append(places, places[-1] + along[-1]), Role.LIMIT, of=slopes.act)
    half = TANGENT * along / np.abs(along)
    return Segments(places - half, places + half, Role.LIMIT, of=slopes.act)


def _curve(c: Construction[DifferentiationGivens], name: str) -> Mark:
    """The faired curve; of a cyclic diagram over the ends of the turn."""
    hand, turn = showing(c), c.givens.turn
    line = hand.fair(f"curve of {name}", _going_on(hand, turn, c.acts[name].first), [slice(None)])
    drawn = slice(None) if turn is None else (line.points.real >= 0) & (line.points.real <= turn)
    return line[drawn].line(Role.RESULT)


def _axes(c: Construction[DifferentiationGivens], symbol: str) -> tuple[Mark, ...]:
    end = float(c.givens.x[-1]) if c.givens.turn is None else c.givens.turn
    return axes_over_phi(end, c.acts[symbol].shown.imag, symbol)


def _draw_scales(c: Construction[DifferentiationGivens]) -> Step:
    greatest = {"v": float(c.value("max_v")), "a": float(c.value("max_a"))}
    said = say(
        "The poles give μᵥ = μₛ/(μᵩ·H₁) = {mu_v:.5g} ({unit}/rad)/mm and μₐ = μᵥ/(μᵩ·H₂) = {mu_a:.5g} "
        "({unit}/rad²)/mm: the greatest velocity is {v:.5g} {unit}/rad, the greatest acceleration {a:.5g} {unit}/rad²."
    ).where(mu_v=c.readings["v"].scale, mu_a=c.readings["a"].scale, unit=unit(c.givens.mu_s.unit), **greatest)
    return Step(say("The scales of the derivatives"), said, _view(c, "a"), (), ("max_v", "max_a", "v", "a"))
