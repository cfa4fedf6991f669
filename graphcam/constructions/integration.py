"""Graphical integration with a pole, twice: acceleration to velocity to displacement.

The ordinate at the middle of each part is projected on the axis and joined to the pole, which lies the distance H to
the left: the ray.  A chord parallel to the ray carries the integral over the part.  A chord rises by y dx/H, so the
scales follow as mu_v = mu_s/(mu_phi H2) and mu_a = mu_v/(mu_phi H1), and mu_s from the known lift.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from graphcam.constructions.acceleration import AccelerationDiagram
from graphcam.constructions.axes import SUBSCRIPTS, levels, numbers, phi_axes, pole_marks
from graphcam.constructions.views import ACCELERATION, DISPLACEMENT, VELOCITY
from graphcam.drafting.curve import faired, farthest_of
from graphcam.drafting.euclid import UP, climb_along
from graphcam.drafting.ink import Caption, Construction, Step, View, reading, say
from graphcam.drafting.marks import Dimension, Line, Points, Role, Segments
from graphcam.drafting.meaning import Compared, Converges, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.drafting.units import unit
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.given.stations import Stations

FLAT = 1e-9
"""A displacement of less, as part of what the greatest ordinate gives over the phase, is rounding."""
SAME_HEIGHT = 2e-3
"""Projections this near to one another [mm] fall on one line."""


@dataclass(frozen=True, eq=False)
class IntegrationGivens:
    """The acceleration diagram, and the distances of the two poles [mm of paper]."""

    diagram: AccelerationDiagram
    poles: tuple[float, float]

    @property
    def motion(self) -> Motion:
        """The motion that the diagram shows."""
        return self.diagram.givens.motion

    @property
    def stations(self) -> Stations:
        """Its stations."""
        return self.diagram.givens.stations

    @property
    def mu_phi(self) -> Scale:
        """The scale of its cam angle [rad/mm]."""
        return self.diagram.givens.mu_phi

    @property
    def unit(self) -> str:
        """The unit of the lift."""
        return self.diagram.givens.unit


Integrated = Construction[IntegrationGivens]


MEANING = Meaning(
    "integration",
    say("Velocity, displacement and the scales"),
    say(
        "A ray from the pole to an ordinate y has the slope y/H; a chord parallel to it across a part Δx climbs by "
        "y·Δx/H: the area of the part, divided by the pole distance. Twice, and the known lift fixes the scales: "
        "μᵥ = μₛ/(μᵩ·H₂), μₐ = μᵥ/(μᵩ·H₁)."
    ),
    {
        "s": ReadingMeaning(
            say("displacement s"), "s", "lift", converges=Converges("displacement", "s", "at stations")
        ),
        "v": ReadingMeaning(say("velocity v"), "v", "lift/rad", converges=Converges("velocity", "v", "at stations")),
        "a": ReadingMeaning(say("acceleration a"), "a", "lift/rad²"),
        "max_v": ReadingMeaning(
            say("greatest v"),
            "max v",
            "lift/rad",
            (Compared("max_v", say("greatest v")),),
            Converges("greatest velocity", "max_v"),
        ),
        "max_a": ReadingMeaning(
            say("greatest a"),
            "max a",
            "lift/rad²",
            (Compared("max_a", say("greatest a")),),
            Converges("greatest acceleration", "max_a"),
        ),
        "closing_v": ReadingMeaning(say("closing error of v"), "Δv", "lift/rad"),
        "closing_s": ReadingMeaning(say("closing error of s"), "Δs", "lift"),
    },
    "report.paragraphs.integration",
)


def integration(diagram: AccelerationDiagram, poles: tuple[float, float], pencil: Pencil) -> Integrated:
    """Integrate the acceleration diagram twice and fix its scale by the known lift.

    diagram : from :func:`~graphcam.constructions.acceleration.acceleration_diagram`
    poles : H1 (acceleration to velocity) and H2 (velocity to displacement) [mm of paper]

    Readings at the stations: ``s``, ``v``, ``a``, and ``a_before`` on the near side of a jump; ``max_v``, ``max_a``.
    In mm of paper the closing errors: ``closing_v`` (one a moving phase, taken up by turning its base line) and
    ``closing_s`` (shared out by the returns).
    """
    hand = pencil.hand("integration")
    givens = IntegrationGivens(diagram, poles)
    motion, stations, mu_phi, lift_unit = givens.motion, givens.stations, givens.mu_phi, givens.unit
    x = diagram.points["axis"].real
    width = x[..., stations.left + 1] - x[..., stations.left]
    middle = x[..., stations.left] + width / 2
    count = stations.left.size

    # First integration.  The hand errs where it projects an ordinate and where it ends a chord; the next chord starts
    # from that end.  Every phase starts and ends at rest, so a velocity left at its end is taken up by the base line.
    a_projected = diagram.readings["middles"].paper + hand.line(count)
    v_chords = _polygons(climb_along(poles[0] + UP * a_projected, width) + hand.line(count), stations)
    closing_v = v_chords[..., stations.last]
    v = v_chords - closing_v[..., stations.moving] * stations.u

    # Second integration: the middle ordinate is read from the polygon, halfway between the chord's ends.
    v_projected = (v[..., stations.left] + v[..., stations.left + 1]) / 2 + hand.line(count)
    s_chords, s, closing_s = _stacked(
        _polygons(climb_along(poles[1] + UP * v_projected, width) + hand.line(count), stations), motion, stations
    )
    top = _top(motion, stations)
    span = stations.phases[stations.moving[top]]
    # A phase may be as narrow as it likes: what counts is whether it has risen by what its own ordinates give.
    full = diagram.readings["greatest"].paper[..., stations.moving[top]] * (x[..., top] - x[..., span.start]) ** 2
    mu_s = motion.lift / _measurable(s[..., top], full / (poles[0] * poles[1]), pencil)
    mu_v = mu_s / (mu_phi.per_mm * poles[1])
    mu_a = mu_v / (mu_phi.per_mm * poles[0])
    fastest = [farthest_of(x + UP * side * v, stations.pieces, UP).imag for side in (1, -1)]
    a, before, greatest = (diagram.readings[name].paper for name in ("stations", "before", "greatest"))
    readings = {
        **hand.readings(mu_s, lift_unit, s=s),
        **hand.readings(mu_v, f"{lift_unit}/rad", v=v),
        **hand.readings(mu_a, f"{lift_unit}/rad²", a=a, a_before=before),
        **hand.readings(mu_v, f"{lift_unit}/rad", max_v=np.maximum(*fastest)),
        **hand.readings(mu_a, f"{lift_unit}/rad²", max_a=greatest.max(axis=-1)),
        "closing_v": reading(closing_v, mu_v, f"{lift_unit}/rad"),
        "closing_s": reading(closing_s, mu_s, lift_unit),
    }
    first = {"a_projected": middle + UP * a_projected, "v_chords": x + UP * v_chords, "v_curve": x + UP * v}
    second = {"v_projected": middle + UP * v_projected, "s_chords": x + UP * s_chords, "s_curve": x + UP * s}
    return Construction(MEANING, givens, pencil, readings, first | second, _draw)


def _polygons(rises: Floats, stations: Stations) -> Floats:
    """Chords set end to end from zero, in every phase anew: heights at the stations (..., m) from rises (..., p)."""
    heights = np.zeros((*rises.shape[:-1], stations.u.size))
    for span, parts in zip(stations.phases, stations.parts, strict=True):
        heights[..., span.start + 1 : span.stop] = np.cumsum(rises[..., parts], axis=-1)
    return heights


def _stacked(polygons: Floats, motion: Motion, stations: Stations) -> tuple[Floats, Floats, Floats]:
    """Set each phase's polygon on the end of the one before, and share out what is left at the end of the turn.

    returns : heights (..., m) above the lowest rest as drawn and as shared out, and the closing error (...)
    """
    ends = polygons[..., stations.last]
    closing = ends.sum(axis=-1)
    # The returns bring the follower back, so they take up the error, each in proportion to its length.
    phases = [motion.phases[k] for k in stations.phase[stations.last]]
    share = np.array([phase.angle if phase.direction < 0 else 0.0 for phase in phases])
    turned = closing[..., None] * share / share.sum()
    drawn = polygons + (np.cumsum(ends, axis=-1) - ends)[..., stations.moving]
    starts = np.cumsum(ends - turned, axis=-1) - (ends - turned)
    shared = polygons - turned[..., stations.moving] * stations.u + starts[..., stations.moving]
    lowest = np.minimum(starts.min(axis=-1), 0.0)[..., None]
    return drawn - lowest, shared - lowest, closing


def _measurable(top: Floats, full: Floats, pencil: Pencil) -> Floats:
    """The greatest displacement on paper, NaN in a sample where nothing has risen above the axis.

    full : what the greatest ordinate would give over the whole phase [mm of paper]
    """
    risen = top > FLAT * full
    if pencil.samples is None and not risen:
        remedy = "divide into more parts, or draw longer ordinates"
        raise DesignError("greatest displacement on paper", f"{float(top):.3g} mm", "above the axis", remedy)
    return np.where(risen, top, np.nan)


def _top(motion: Motion, stations: Stations) -> int:
    """The station at the end of the phase that reaches the known greatest displacement."""
    reached = motion.levels[stations.phase[stations.last] + 1]
    return int(stations.last[np.argmax(reached)])


def _draw(c: Integrated) -> list[Step]:
    return [*(step for run in _PASSES for step in _draw_pass(c, run)), _draw_scales(c)]


@dataclass(frozen=True)
class _Pass:
    """What tells one integration from the other on the paper."""

    index: int
    source: View
    target: View
    symbols: tuple[str, str]
    closing: Caption


_AT_REST = say(
    "A phase ends at rest: the velocity left there, {left:.2f} mm at most, is taken up by turning the base line."
)
_SHARED_OUT = say("The displacement left at the end of the turn, {left:.2f} mm, is shared out along the returns.")
_PASSES = (
    _Pass(1, ACCELERATION, VELOCITY, ("a", "v"), _AT_REST),
    _Pass(2, VELOCITY, DISPLACEMENT, ("v", "s"), _SHARED_OUT),
)


def _draw_pass(c: Integrated, run: _Pass) -> list[Step]:
    motion, stations, mu_phi = c.givens.motion, c.givens.stations, c.givens.mu_phi
    distance, index = c.givens.poles[run.index - 1], f"{run.index}".translate(SUBSCRIPTS)
    source, target = run.symbols
    projected, chords = c.first(f"{source}_projected"), c.first(f"{target}_chords")
    curve, left = c.first(f"{target}_curve"), float(np.max(np.abs(c.first(f"closing_{target}"))))
    # Projections that fall on one another are drawn once, from the farthest ordinate.
    heights = levels(projected.imag)
    reach = np.array([projected.real[np.abs(projected.imag - y) < SAME_HEIGHT].max() for y in heights])
    laid_out = pole_marks(distance, index, heights)
    rays = (
        Segments(UP * heights, reach + UP * heights, Role.CONSTRUCTION),
        Segments(np.full(heights.size, -distance + 0j), UP * heights, Role.CONSTRUCTION),
    )
    axes = phi_axes(motion, mu_phi, curve.imag, target)
    polygons = (
        *(Line(chords[span], Role.CONSTRUCTION) for span in stations.phases),
        Segments(curve.real + 0j, curve, Role.CONSTRUCTION),
    )
    curves = tuple(Line(faired(curve[piece]), Role.RESULT) for piece in stations.pieces)
    return [
        Step(
            say("Pole and rays, {source} to {target}", source=source, target=target),
            say(
                "The pole P{index} lies H{index} = {distance:.1f} mm to the left on the axis. Every middle ordinate of "
                "{source} is projected on the vertical axis and joined to the pole."
            ).where(index=index, distance=distance, source=source),
            run.source,
            (*laid_out, *rays),
            given=laid_out,
        ),
        Step(
            say("Chords parallel to the rays: {target}", target=target),
            say(
                "From the start of each phase a chord is drawn in every part parallel to its ray, each from the end of "
                "the one before. {closing}"
            ).where(closing=run.closing.where(left=left)),
            run.target,
            (*axes, *polygons),
            given=axes,
        ),
        Step(
            say("Curve of {target}", target=target),
            say("A smooth curve is faired through the ends of the chords, from jump to jump of the acceleration."),
            run.target,
            (*curves, *_rests(c, curve)),
        ),
    ]


def _rests(c: Integrated, curve: Points) -> list[Line]:
    """The level lines of the dwells: between the phases' curves, and to the start and the end of the turn."""
    level, turn = UP * curve[-1].imag, FULL_TURN / c.givens.mu_phi.per_mm
    moving = [curve[k] for span in c.givens.stations.phases for k in (span.start, span.stop - 1)]
    ends = [level, *moving, turn + level]
    return [Line(np.array(pair), Role.RESULT) for pair in zip(ends[::2], ends[1::2], strict=True)]


def _draw_scales(c: Integrated) -> Step:
    motion, stations, curve = c.givens.motion, c.givens.stations, c.first("s_curve")
    top = complex(curve[_top(motion, stations)])
    named = numbers(curve.real + 0j, stations, -UP)
    mu_s, mu_v, mu_a = (c.readings[name].per_mm for name in ("s", "v", "a"))
    said = say(
        "The greatest displacement measures {paper:.2f} mm and stands for the known lift of {lift:.6g} {unit}, so μₛ = "
        "{mu_s:.5g} {unit}/mm. Through the poles follow μᵥ = μₛ/(μᵩ·H₂) = {mu_v:.5g} ({unit}/rad)/mm and μₐ = "
        "μᵥ/(μᵩ·H₁) = {mu_a:.5g} ({unit}/rad²)/mm."
    ).where(paper=top.imag, unit=unit(c.givens.unit), lift=motion.lift, mu_s=mu_s, mu_v=mu_v, mu_a=mu_a)
    height = Dimension(top.real + 0j, top, say("{y:.1f}", y=top.imag), aside=-6.0)
    reads = ("max_v", "max_a", "s", "v", "a", "closing_v", "closing_s")
    return Step(say("The scales"), said, DISPLACEMENT, (height, *named), reads, given=named)
