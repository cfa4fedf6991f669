"""Graphical differentiation, twice: displacement to velocity to acceleration, by chords or by tangents.

It turns the integration round.  A ray through the pole parallel to a chord, or to a tangent, cuts the vertical axis at
the height y = H dy/dx: the ordinate of the derivative.  By chords it belongs to the middle of the interval, where it is
right to second order; by tangents to the station itself.  The scales follow as mu_v = mu_s/(mu_phi H1) and
mu_a = mu_v/(mu_phi H2).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from graphcam.constructions.axes import SUBSCRIPTS, axes_over_phi, levels, pole_marks
from graphcam.drafting.curve import faired, farthest
from graphcam.drafting.euclid import UP, divided
from graphcam.drafting.hand import showing
from graphcam.drafting.ink import Caption, Construction, Step, View, reading, say
from graphcam.drafting.marks import Dots, Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Hand, Pencil
from graphcam.drafting.scale import Scale
from graphcam.drafting.units import unit
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Motion
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

    Readings: ``v`` and ``a``, and the cam angles they belong to, ``v_at`` and ``a_at``; ``rise`` and ``run`` of every
    chord or tangent of s [mm of paper]; ``max_v`` and ``max_a``, the greatest ordinates up or down.

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
    hand = pencil.hand("differentiation")
    derive = _chords if by == "chords" else _tangents
    plotted = pencil.sheets(s) + hand.line(s.size)
    first = derive(x, plotted, poles[0], turn, hand)
    second = derive(first.x, first.y, poles[1], turn, hand)
    mu_v = mu_s.per_mm / (mu_phi.per_mm * poles[0])
    mu_a = mu_v / (mu_phi.per_mm * poles[1])
    readings = {
        **hand.readings(mu_s.per_mm, mu_s.unit, rise=first.slope * first.run),
        "run": reading(pencil.sheets(first.run), mu_phi.per_mm, "rad"),
        **hand.readings(mu_v, f"{mu_s.unit}/rad", v=first.y),
        "v_at": reading(pencil.sheets(first.x), mu_phi.per_mm, "rad"),
        **hand.readings(mu_a, f"{mu_s.unit}/rad²", a=second.y),
        "a_at": reading(pencil.sheets(second.x), mu_phi.per_mm, "rad"),
        **hand.readings(mu_v, f"{mu_s.unit}/rad", max_v=_greatest(first, turn)),
        **hand.readings(mu_a, f"{mu_s.unit}/rad²", max_a=_greatest(second, turn)),
    }
    points = {"s": x + UP * plotted, "v": first.x + UP * first.y, "a": second.x + UP * second.y}
    givens = DifferentiationGivens(x, mu_phi, mu_s, poles, turn, by)
    return Construction(MEANING, givens, pencil, readings, points, _draw)


def _check(x: Floats, s: Floats, turn: float | None) -> None:
    checked = "stations of the displacement"
    if x.ndim != 1 or x.shape != s.shape or x.size < FEWEST:
        raise DesignError(checked, x.size, f"{FEWEST} or more, each with its ordinate")
    if not np.all(np.diff(x) > 0):
        raise DesignError(checked, "not in order", "growing along the axis", "sort them")
    if turn is not None and not x[-1] - x[0] < turn:
        remedy = "leave out the last one where it is the first one again"
        raise DesignError(checked, f"over {x[-1] - x[0]:g} mm", f"within one turn of {turn:g} mm", remedy)


@dataclass(frozen=True, eq=False)
class _Derivative:
    """Places (m,) [mm], ordinates ([samples,] m) [mm], and the slopes they came from, over their runs (m,) [mm]."""

    x: Floats
    y: Floats
    slope: Floats
    run: Floats


def _chords(x: Floats, y: Floats, pole: float, turn: float | None, hand: Hand) -> _Derivative:
    """The derivative in the middle of each interval; of a cyclic diagram in that from the last place to the first."""
    if turn is not None:
        x, y = np.append(x, x[0] + turn), np.concatenate([y, y[..., :1]], axis=-1)
    run = np.diff(x)
    slope = np.diff(y, axis=-1) / run
    return _Derivative(x[:-1] + run / 2, pole * slope + hand.line(run.size), slope, run)


def _tangents(x: Floats, y: Floats, pole: float, turn: float | None, hand: Hand) -> _Derivative:
    """The derivative at each place: of the curve faired through it and its neighbours.

    A mirror is set across the curve and turned until the curve runs into its image without a corner: it stands on the
    normal.  The hand errs in that angle.
    """
    count = x.size
    if turn is not None:
        x = np.concatenate([x[-1:] - turn, x, x[:1] + turn])
        y = np.concatenate([y[..., -1:], y, y[..., :1]], axis=-1)
    run = np.diff(x)
    chord = np.diff(y, axis=-1) / run
    # The parabola through three points has the slope of either chord in its middle, and between them it is straight.
    bend = np.diff(chord, axis=-1) / (run[:-1] + run[1:])
    inside = chord[..., :-1] + bend * run[:-1]
    if turn is None:
        start = chord[..., :1] - bend[..., :1] * run[0]
        end = chord[..., -1:] + bend[..., -1:] * run[-1]
        inside = np.concatenate([start, inside, end], axis=-1)
    else:
        x = x[1:-1]
    slope = np.tan(np.arctan(inside) + hand.protractor(count))
    return _Derivative(x, pole * slope + hand.line(count), slope, np.full(count, pole))


def _greatest(derivative: _Derivative, turn: float | None) -> Floats:
    """The greatest ordinate up or down, where the faired curve turns; of a cyclic diagram over its ends too."""
    cyclic = turn is not None
    return np.maximum(_highest(derivative.y, cyclic=cyclic), _highest(-derivative.y, cyclic=cyclic))


def _highest(y: Floats, *, cyclic: bool) -> Floats:
    if cyclic:
        # Begun at the lowest ordinate, so that the highest one has neighbours on both sides.
        order = (np.argmin(y, axis=-1)[..., None] + np.arange(y.shape[-1])) % y.shape[-1]
        y = np.take_along_axis(y, order, -1)
    return farthest(UP * y, UP).imag


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
    s = c.first("s")
    plotted = (*_axes(c, s, "s"), Dots(s), Segments(s.real + 0j, s, Role.CONSTRUCTION))
    said = say_many(
        "The displacement is plotted at {count} station.", "The displacement is plotted at {count} stations.", s.size
    )
    cyclic = say("After the last of them the revolution goes on with the first.")
    return Step(
        say("The displacement"),
        sequence([said, cyclic], " ") if c.givens.turn else said,
        _view(c, "s"),
        (*plotted, Line(_curve(c, s), Role.RESULT)),
        given=plotted,
    )


def _draw_pass(c: Construction[DifferentiationGivens], source: str, target: str, number: int) -> list[Step]:
    derived, pole, by = c.first(target), c.givens.poles[number - 1], c.givens.by
    index, heights = f"{number}".translate(SUBSCRIPTS), levels(derived.imag)
    title, traced = (said.where(source=source, count=derived.size) for said in _TRACED[by])
    traces = (_traces(c, c.first(source), derived, pole),)
    joined = say("Pole and rays, {source} to {target}", source=source, target=target)
    axes = (*_axes(c, derived, target), *pole_marks(showing(c).given("pole", -pole + 0j), pole, index, heights))
    rays = (
        Segments(np.full(heights.size, -pole + 0j), UP * heights, Role.CONSTRUCTION),
        Segments(UP * derived.imag, derived, Role.CONSTRUCTION),
    )
    smooth = say(
        "A smooth curve is faired through the plotted points; its greatest ordinate measures {greatest:.2f} mm."
    ).where(greatest=float(c.first(f"max_{target}")))
    curve = (Dots(derived), Line(_curve(c, derived), Role.RESULT))
    parallel = _RAYS[by].where(index=index, pole=pole, target=target)
    return [
        Step(title, traced, _view(c, source), traces),
        Step(joined, parallel, _view(c, target), (*axes, *rays), given=axes),
        Step(say("Curve of {target}", target=target), smooth, _view(c, target), curve),
    ]


def _view(c: Construction[DifferentiationGivens], symbol: str) -> View:
    """The view, with its scale in the title."""
    view = VIEWS[symbol]
    scale = c.givens.mu_s.per_mm if symbol == "s" else c.readings[symbol].scale
    per = unit(c.givens.mu_s.unit) if symbol == "s" else sequence(["(", unit(c.readings[symbol].unit), ")"], "")
    values = {"title": view.title, "index": {"s": "ₛ", "v": "ᵥ", "a": "ₐ"}[symbol], "mu": scale}
    return replace(view, title=say("{title}, μ{index} = {mu:.4g} {per}/{mm}", per=per, mm=unit("mm"), **values))


def _traces(c: Construction[DifferentiationGivens], curve: Points, derived: Points, pole: float) -> Mark:
    """The chords, or short pieces of the tangents."""
    turn = c.givens.turn
    if c.givens.by == "chords":
        return Line(curve if turn is None else np.append(curve, curve[0] + turn), Role.LIMIT)
    direction = pole + UP * derived.imag
    along = TANGENT * direction / np.abs(direction)
    return Segments(curve - along, curve + along, Role.LIMIT)


def _curve(c: Construction[DifferentiationGivens], points: Points) -> Points:
    """The faired curve; of a cyclic diagram over the ends of the turn."""
    turn = c.givens.turn
    if turn is None:
        return faired(points)
    line = faired(np.concatenate([points[-2:] - turn, points, points[:2] + turn]))
    return line[(line.real >= 0) & (line.real <= turn)]


def _axes(c: Construction[DifferentiationGivens], points: Points, symbol: str) -> tuple[Mark, ...]:
    turn = c.givens.turn
    return axes_over_phi(float(c.givens.x[-1]) if turn is None else turn, points.imag, symbol)


def _draw_scales(c: Construction[DifferentiationGivens]) -> Step:
    greatest = {"v": float(c.value("max_v")), "a": float(c.value("max_a"))}
    said = say(
        "The poles give μᵥ = μₛ/(μᵩ·H₁) = {mu_v:.5g} ({unit}/rad)/mm and μₐ = μᵥ/(μᵩ·H₂) = {mu_a:.5g} "
        "({unit}/rad²)/mm: the greatest velocity is {v:.5g} {unit}/rad, the greatest acceleration {a:.5g} {unit}/rad²."
    ).where(mu_v=c.readings["v"].scale, mu_a=c.readings["a"].scale, unit=unit(c.givens.mu_s.unit), **greatest)
    return Step(say("The scales of the derivatives"), said, _view(c, "a"), (), ("max_v", "max_a", "v", "a"))
