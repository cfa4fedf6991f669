"""Graphical integration with a pole, twice: acceleration to velocity to displacement.

The ordinate at the middle of each part is projected on the axis and joined to the pole, which lies the distance H to
the left: the ray.  A chord parallel to the ray carries the integral over the part.  A chord rises by y dx/H, so the
scales follow as mu_v = mu_s/(mu_phi H2) and mu_a = mu_v/(mu_phi H1), and mu_s from the known lift.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from graphcam.constructions.acceleration import AccelerationDiagram, AccelerationGivens
from graphcam.constructions.axes import SUBSCRIPTS, numbers, once, phi_axes, pole_marks
from graphcam.constructions.views import ACCELERATION, DISPLACEMENT, VELOCITY
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, between, reckoned, showing
from graphcam.drafting.ink import Caption, Construction, Step, View, say
from graphcam.drafting.marks import Dimension, Line, Role, Segments
from graphcam.drafting.meaning import Compared, Converges, Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
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
class IntegrationGivens(AccelerationGivens):
    """What lies on the board of the diagram, the diagram itself, and the distances of the two poles [mm of paper]."""

    diagram: AccelerationDiagram
    poles: tuple[float, float]


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
            say("greatest v"), "max v", "lift/rad", (Compared("max_v"),), Converges("greatest velocity", "max_v")
        ),
        "max_a": ReadingMeaning(
            say("greatest a"), "max a", "lift/rad²", (Compared("max_a"),), Converges("greatest acceleration", "max_a")
        ),
        "closing_v": ReadingMeaning(say("closing error of v"), "Δv", "lift/rad"),
        "closing_s": ReadingMeaning(say("closing error of s"), "Δs", "lift"),
    },
    "report.paragraphs.integration",
    scales={"acceleration": "a", "velocity": "v", "displacement": "s", "combined": "s"},
    scales_found_by="integration",
)


def integration(diagram: AccelerationDiagram, poles: tuple[float, float], pencil: Pencil) -> Integrated:
    """Integrate the acceleration diagram twice and fix its scale by the known lift.

    poles : H1 (acceleration to velocity) and H2 (velocity to displacement) [mm of paper]

    Readings besides those of the meaning: ``a_before``, at the stations as ``a``, on the near side of a jump.
    """
    givens = IntegrationGivens(**vars(diagram.givens), diagram=diagram, poles=poles)
    hand, motion, stations, mu_phi = Hand(pencil, MEANING, givens.unit), givens.motion, givens.stations, givens.mu_phi
    axis, origin, left = hand.found(diagram, "axis"), hand.given("vertical axis", along=UP), stations.left
    middles = hand.divide("middles of the parts", axis[left], axis[left + 1], 0.5)
    uprights = hand.erect("uprights", axis)

    # Every phase starts and ends at rest, so a velocity left at its end is taken up by turning the base line.
    a_heights, polygons = _integrated(hand, givens, 1, hand.carry(diagram.readings["middles"]), uprights, origin)
    v_chords = hand.take("v_chords", polygons)
    v = hand.lay_off("v_curve", axis, UP, reckoned(partial(_above_base, givens), between(axis, v_chords, UP)))

    # The middle ordinate is read from the curve's chord, halfway between its ends.
    halves = hand.divide("middles of v", v[left], v[left + 1], 0.5)
    v_heights, polygons = _integrated(hand, givens, 2, halves, uprights, origin)
    heights = between(axis, polygons, UP)
    raised, shared_out, closing = (reckoned(partial(_stacked, givens, part), heights) for part in range(3))
    s_chords, s = hand.raised("s_chords", polygons, raised), hand.lay_off("s_curve", axis, UP, shared_out)

    x, top = axis.points.real, _top(motion, stations)
    span = stations.phases[stations.moving[top]]
    # A phase may be as narrow as it likes: what counts is whether it has risen by what its own ordinates give.
    full = diagram.readings["greatest"].paper[..., stations.moving[top]] * (x[..., top] - x[..., span.start]) ** 2
    mu_s = motion.lift / _measurable(s.points[..., top].imag, full / (poles[0] * poles[1]), pencil)
    mu_v = mu_s / (mu_phi.per_mm * poles[1])
    mu_a = mu_v / (mu_phi.per_mm * poles[0])
    hand.read("s", between(axis, s, UP), mu_s)
    hand.read("v", between(axis, v, UP), mu_v)
    hand.read("a", hand.carry(diagram.readings["stations"]), mu_a)
    hand.read("a_before", hand.carry(diagram.readings["before"]), mu_a, f"{givens.unit}/rad²")
    down = hand.tangent("lowest v", v, stations.pieces, -UP)
    ends = (between(origin, hand.tangent("highest v", v, stations.pieces, UP), UP), between(down, origin, UP))
    hand.read("max_v", reckoned(np.maximum, *ends), mu_v)
    hand.read("max_a", reckoned(partial(np.max, axis=-1), hand.carry(diagram.readings["greatest"])), mu_a)
    hand.read("closing_v", between(axis[stations.last], v_chords[stations.last], UP), mu_v, rounded=False)
    hand.read("closing_s", closing, mu_s, rounded=False)
    projected = {"a_projected": middles.points.real + a_heights.points}
    projected["v_projected"] = halves.points.real + v_heights.points
    curves = {"v_chords": v_chords, "v_curve": v, "s_chords": s_chords, "s_curve": s}
    return hand.finished(givens, _draw, projected | curves)


def _integrated(
    hand: Hand, givens: IntegrationGivens, index: int, ordinates: Drawn | Setting, uprights: Drawn, origin: Drawn
) -> tuple[Drawn, Drawn]:
    """The middle ordinates carried to the vertical axis, and the chords parallel to the rays to them from the pole."""
    stations, target = givens.stations, "vs"[index - 1]
    pole = hand.lay_off(f"P{index}", hand.given("origin"), -RIGHT, givens.poles[index - 1])
    heights = hand.project(f"heights for {target}", ordinates, origin)
    rays = hand.join(f"rays of {target}", pole, heights)
    chains = tuple(zip(stations.phases, stations.parts, strict=True))
    return heights, hand.end_to_end(f"chords of {target}", rays, uprights, chains)


def _above_base(givens: IntegrationGivens, polygons: Floats) -> Floats:
    """Heights (..., m) of chords above the base lines, turned to join the ends of every phase."""
    stations = givens.stations
    return polygons - polygons[..., stations.last[stations.moving]] * stations.u


def _stacked(givens: IntegrationGivens, part: int, polygons: Floats) -> Floats:
    """Set each phase's polygon (..., m) on the end of the one before, and share out what is left after the turn.

    part : 0 for how much each station rises by that, 1 for the heights as shared out, both above the lowest rest, 2
        for the closing error (...)
    """
    stations, ends = givens.stations, polygons[..., givens.stations.last]
    closing = ends.sum(axis=-1)
    # The returns bring the follower back, so they take up the error, each in proportion to its length.
    phases = [givens.motion.phases[k] for k in stations.phase[stations.last]]
    share = np.array([phase.angle if phase.direction < 0 else 0.0 for phase in phases])
    turned = closing[..., None] * share / share.sum()
    starts = np.cumsum(ends - turned, axis=-1) - (ends - turned)
    lowest = np.minimum(starts.min(axis=-1), 0.0)[..., None]
    raised = (np.cumsum(ends, axis=-1) - ends)[..., stations.moving] - lowest
    heights = polygons - turned[..., stations.moving] * stations.u + starts[..., stations.moving] - lowest
    return (raised, heights, closing)[part]


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
    pole, levelled, polygon = (c.acts[name] for name in (f"P{run.index}", f"heights for {target}", f"{target}_chords"))
    curve, left = c.acts[f"{target}_curve"], float(np.max(np.abs(c.first(f"closing_{target}"))))
    # Projections that fall on one another are drawn once, from the farthest ordinate.
    height, farthest, kept = levelled.shown.imag, c.first(f"{source}_projected").real, once(levelled)
    reach = np.array([farthest[np.abs(height - height[k]) < SAME_HEIGHT].max() for k in kept])
    laid_out = pole_marks(pole, distance, index, height[kept])
    projected = levelled.first[kept]
    rays = (
        Segments(projected.points, reach + projected.points, Role.CONSTRUCTION, of=levelled.act),
        c.acts[f"rays of {target}"].first[kept].ways(Role.CONSTRUCTION),
    )
    axes = phi_axes(motion, mu_phi, curve.shown.imag, target)
    polygons = (
        *(polygon.first[span].line(Role.CONSTRUCTION) for span in stations.phases),
        curve.from_(curve.shown.real + 0j, Role.CONSTRUCTION),
    )
    smooth = showing(c)
    curves = tuple(smooth.fair(f"{target}", curve.first, [piece]).line(Role.RESULT) for piece in stations.pieces)
    joined = say(
        "The pole P{index} lies H{index} = {distance:.1f} mm to the left on the axis. Every middle ordinate of "
        "{source} is projected on the vertical axis and joined to the pole."
    ).where(index=index, distance=distance, source=source)
    set_on = say(
        "From the start of each phase a chord is drawn in every part parallel to its ray, each from the end of the one "
        "before. {closing}"
    ).where(closing=run.closing.where(left=left))
    faired = say("A smooth curve is faired through the ends of the chords, from jump to jump of the acceleration.")
    titles = say("Pole and rays, {source} to {target}"), say("Chords parallel to the rays: {target}")
    to_rays, to_chords = (title.where(source=source, target=target) for title in titles)
    return [
        Step(to_rays, joined, run.source, (*laid_out, *rays), given=laid_out),
        Step(to_chords, set_on, run.target, (*axes, *polygons), given=axes),
        Step(say("Curve of {target}", target=target), faired, run.target, (*curves, *rests(c, curve))),
    ]


def rests(c: Integrated, curve: Drawn) -> list[Line]:
    """The level lines of the dwells: between the phases' curves, and to the start and the end of the turn."""
    ends = [k for span in c.givens.stations.phases for k in (span.start, span.stop - 1)]
    level = showing(c).erect("rests", curve.first[[*ends, -1]], RIGHT)
    *places, last = level.points
    turn = FULL_TURN / c.givens.mu_phi.per_mm
    bounds = np.array([last.imag * UP, *places, turn + last.imag * UP])
    return [Line(pair, Role.RESULT, of=level.act) for pair in bounds.reshape(-1, 2)]


def _draw_scales(c: Integrated) -> Step:
    motion, stations, curve = c.givens.motion, c.givens.stations, c.acts["s_curve"]
    top = curve.first[_top(motion, stations)].place
    named = numbers(c.acts["acceleration: axis"], stations, -UP)
    mu_s, mu_v, mu_a = (c.readings[name].per_mm for name in ("s", "v", "a"))
    said = say(
        "The greatest displacement measures {paper:.2f} mm and stands for the known lift of {lift:.6g} {unit}, so μₛ = "
        "{mu_s:.5g} {unit}/mm. Through the poles follow μᵥ = μₛ/(μᵩ·H₂) = {mu_v:.5g} ({unit}/rad)/mm and μₐ = "
        "μᵥ/(μᵩ·H₁) = {mu_a:.5g} ({unit}/rad²)/mm."
    ).where(paper=top.imag, unit=unit(c.givens.unit), lift=motion.lift, mu_s=mu_s, mu_v=mu_v, mu_a=mu_a)
    height = Dimension(top.real + 0j, top, say("{y:.1f}", y=top.imag), -6.0, c.readings["s"].act)
    reads = ("max_v", "max_a", "s", "v", "a", "closing_v", "closing_s")
    return Step(say("The scales"), said, DISPLACEMENT, (height, *named), reads, given=named)
