"""Graphical integration with a pole, twice: acceleration to velocity to displacement.

The ordinate at the middle of each part is projected on the axis and joined to the pole, which lies the distance H to
the left: the ray.  A chord parallel to the ray carries the integral over the part.  A chord rises by y dx/H, so the
scales follow as mu_v = mu_s/(mu_phi H2) and mu_a = mu_v/(mu_phi H1), and mu_s from the known lift.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.acceleration import AccelerationDiagram, moving_phases
from graphcam.constructions.axes import (
    SUBSCRIPTS,
    first_at_height,
    joined_parts,
    number_labels,
    ordinate_title,
    phase_names,
    phase_title,
    pole_marks,
    station_names,
)
from graphcam.constructions.curve_over_phi import CONTINUOUS_TANGENT, CORNER, curve_over_phi
from graphcam.constructions.graduation import (
    close_ends_caption,
    graduated_at_speed,
    graduation_marks,
    ray_numbers,
    time_scale_caption,
)
from graphcam.constructions.pole_scales import PoleTerms, pole_formula
from graphcam.constructions.turn_board import TurnGivens
from graphcam.constructions.views import ACCELERATION, DISPLACEMENT, VELOCITY
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Row, Step, View, say
from graphcam.drafting.marks import Dimension, Mark, Points, Role, Segments
from graphcam.drafting.meaning import (
    LIFT,
    ComparedReading,
    Formula,
    Meaning,
    ReadingConvergence,
    ReadingMeaning,
    Symbol,
    Values,
    per_mm,
)
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import NEGLIGIBLE_SIZE, Scale, unit
from graphcam.drafting.telling import introduced_parts
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.given.motion import Motion, MovingPhase
from graphcam.given.stations import Stations
from graphcam.words import sequence

AXIS_NUMBER_DISTANCE = 6.0
"""Points of s so near to the axis [mm of paper] are called by the numbers there."""
SAME_HEIGHT = 1e-9
"""Ordinates that differ by less than this part of the greatest are equally high."""
NEGLIGIBLE_DISPLACEMENT = 1e-9
"""A displacement of less, as part of what the greatest ordinate gives over the phase, is rounding."""


@dataclass(frozen=True, eq=False)
class IntegrationGivens(TurnGivens):
    """The acceleration diagram with what lies on its board, and the distances of the two poles [mm of paper].

    lowest : whether no diagram follows below that of s, so that the phases' angles stand there
    combined : the scale of the combined diagram of s and v [mm/mm], None for that of s
    """

    diagram: AccelerationDiagram
    poles: tuple[float, float]
    lowest: bool = False
    combined: Scale | None = None

    def integrated_parts(self, index: int) -> NDArray[np.bool_]:
        """(p,) the parts that the first or second integration has a ray for: there is none in a blow.

        Nor is there one in a phase without any acceleration between its blows, whose v is laid off.
        """
        stations = self.stations
        moving = moving_phases(self.motion, stations)
        still = np.array([not phase.steady_acceleration for phase in moving])
        return ~stations.blows & ~(still[stations.moving[stations.left]] & (index == 1))

    def highest_ordinate(self, drawn: Floats) -> Floats:
        """The maximum of the phases' ordinates (..., k), or of a blow, which is calculated [mm of paper]."""
        highest = max((abs(blow.acceleration) for blow in self.motion.blows), default=0.0)
        return np.maximum(np.max(drawn, axis=-1), self.ordinate * highest / self.motion.reference[1])

    def velocity_jumps(self) -> Floats:
        """(m,) by how much the velocities of the blows so far raise v at the stations [mm of paper].

        mu_v = mu_a mu_phi H1, and mu_a follows from the chosen ordinate.
        """
        stations, left = self.stations, self.stations.left
        v = self.motion.at(stations.phase, stations.u)[1]
        jumps = np.zeros(stations.u.size)
        jumps[left + 1] = np.where(stations.blows, v[left + 1] - v[left], 0.0)
        raised = np.cumsum(jumps)
        # Every phase begins at rest.
        starts = np.array([span.start for span in stations.phases])
        mu_v = self.motion.reference[1] / self.ordinate * self.mu_phi.per_mm * self.poles[0]
        return (raised - raised[starts][stations.moving]) / mu_v


Integrated = Construction[IntegrationGivens]


def _of_the_lift(drawn: Integrated) -> Values:
    """The formula's values: the scale of s, from the known lift."""
    read, lift = drawn.readings["s"], drawn.givens.motion.lift
    yield {"lift": lift, "paper": lift / read.per_mm, "mu_s": read.per_mm, "of_s": per_mm(read.unit)}


def _by_pole(drawn: Integrated, source: str, pole: int) -> PoleTerms:
    return PoleTerms(drawn.readings[source].per_mm, drawn.givens.mu_phi.per_mm, drawn.givens.poles[pole - 1])


FORMULAS = (
    Formula(
        r"\Delta y = \frac{y\,\Delta x}{H}",
        symbols=(
            Symbol(r"\Delta y", say("what a chord climbs"), "mm of paper"),
            Symbol("y", say("the middle ordinate of its part"), "mm of paper"),
            Symbol(r"\Delta x", say("the width of the part"), "mm of paper"),
            Symbol("H", say("the pole distance: H₁ of the first integration, H₂ of the second"), "mm of paper"),
        ),
    ),
    Formula(
        r"\mu_s = \frac{h}{y_s}",
        r"\mu_s = \frac{<lift:.6g>}{<paper:.2f>} = <mu_s:.5g>\ \text{<of_s>}",
        _of_the_lift,
        (
            Symbol(r"\mu_s", say("the scale of the displacement"), "lift/mm"),
            LIFT,
            Symbol("y_s", say("the maximum ordinate of s"), "mm of paper"),
        ),
        of="s",
    ),
    pole_formula("v", "s", 2, _by_pole),
    pole_formula("a", "v", 1, _by_pole),
)


MEANING = Meaning(
    "integration",
    say("Velocity, displacement and the scales"),
    say(
        "A ray from the pole to an ordinate y has the slope y/H; a chord parallel to it across a part Δx climbs "
        "by y·Δx/H: the area of the part, divided by the pole distance. After two integrations the known lift "
        "fixes the scales: μᵥ = μₛ/(μᵩ·H₂), μₐ = μᵥ/(μᵩ·H₁)."
    ),
    {
        "s": ReadingMeaning(
            say("displacement s"), "s", "lift", converges=ReadingConvergence("displacement", "s", "at stations")
        ),
        "v": ReadingMeaning(
            say("velocity v"), "v", "lift/rad", converges=ReadingConvergence("velocity", "v", "at stations")
        ),
        "a": ReadingMeaning(say("acceleration a"), "a", "lift/rad²"),
        "max_v": ReadingMeaning(
            say("maximum v"),
            "max v",
            "lift/rad",
            (ComparedReading("max_v"),),
            ReadingConvergence("maximum velocity", "max_v"),
        ),
        "max_a": ReadingMeaning(
            say("maximum a"),
            "max a",
            "lift/rad²",
            (ComparedReading("max_a"),),
            ReadingConvergence("maximum acceleration", "max_a"),
        ),
        "closing_v": ReadingMeaning(say("closing error of v"), "Δv", "lift/rad", over=phase_names),
        "closing_s": ReadingMeaning(say("closing error of s"), "Δs", "lift"),
    },
    FORMULAS,
    scales={"acceleration": "a", "velocity": "v", "displacement": "s", "combined": "s"},
    scales_found_by="integration",
)


def integration(
    diagram: AccelerationDiagram,
    poles: tuple[float, float],
    pencil: Pencil,
    *,
    lowest: bool = False,
    combined: Scale | None = None,
) -> Integrated:
    """Integrate the acceleration diagram twice and fix its scale by the known lift.

    poles : H1 (acceleration to velocity) and H2 (velocity to displacement) [mm of paper]
    lowest : whether no diagram follows below that of s
    combined : the scale of the combined diagram of s and v [mm/mm], None for that of s

    Readings besides those of the meaning: ``a_before``, at the stations as ``a``, on the near side of a jump.
    """
    givens = IntegrationGivens(**vars(diagram.givens), diagram=diagram, poles=poles, lowest=lowest, combined=combined)
    hand, motion, stations, mu_phi = Hand(pencil, MEANING, givens.unit), givens.motion, givens.stations, givens.mu_phi
    axis, origin, left = hand.earlier_places(diagram, "axis"), hand.given("vertical axis", along=UP), stations.left
    middles = hand.divide("middles of the parts", axis[left], axis[left + 1], 0.5)
    uprights = hand.erect("verticals", axis)

    # Every phase starts and ends at rest, so a velocity left at its end is taken up by turning the base line.
    a_heights, polygons = _integrated(hand, givens, 1, hand.carry(diagram.readings["middles"]), uprights, origin)
    if stations.blows.any():  # where the velocity jumps, it is laid off
        v_chords = hand.raised("v_chords", polygons, calculated_setting(givens.velocity_jumps))
    else:
        v_chords = hand.take("v_chords", polygons)
    v = hand.lay_off(
        "v_curve", axis, UP, calculated_setting(partial(_above_base, givens), distance_between(axis, v_chords, UP))
    )

    # The middle ordinate is read from the curve's chord, halfway between its ends.
    halves = hand.divide("middles of v", v[left], v[left + 1], 0.5)
    v_heights, polygons = _integrated(hand, givens, 2, halves, uprights, origin)
    heights = distance_between(axis, polygons, UP)
    raised, shared_out, closing = (
        calculated_setting(partial(_stacked_polygons, givens, part), heights) for part in range(3)
    )
    s_chords, s = hand.raised("s_chords", polygons, raised), hand.lay_off("s_curve", axis, UP, shared_out)

    x, top = axis.points.real, _top(motion, stations)
    span = stations.phases[stations.moving[top]]
    # A phase may be as narrow as it likes: what counts is whether it has risen by what its own ordinates give.
    full = diagram.readings["greatest"].paper[..., stations.moving[top]] * (x[..., top] - x[..., span.start]) ** 2
    mu_s = motion.lift / _measurable(s.points[..., top].imag, full / (poles[0] * poles[1]), pencil)
    mu_v = mu_s / (mu_phi.per_mm * poles[1])
    mu_a = mu_v / (mu_phi.per_mm * poles[0])
    hand.read("s", distance_between(axis, s, UP), mu_s)
    hand.read("v", distance_between(axis, v, UP), mu_v)
    hand.read("a", hand.carry(diagram.readings["stations"]), mu_a)
    hand.read("a_before", hand.carry(diagram.readings["before"]), mu_a, f"{givens.unit}/rad²")
    down = hand.tangent("lowest v", v, stations.pieces, -UP)
    ends = (
        distance_between(origin, hand.tangent("highest v", v, stations.pieces, UP), UP),
        distance_between(down, origin, UP),
    )
    hand.read("max_v", calculated_setting(np.maximum, *ends), mu_v)
    tallest = calculated_setting(givens.highest_ordinate, hand.carry(diagram.readings["greatest"]))
    hand.read("max_a", tallest, mu_a)
    hand.read("closing_v", distance_between(axis[stations.last], v_chords[stations.last], UP), mu_v, rounded=False)
    hand.read("closing_s", closing, mu_s, rounded=False)
    projected = {"a_projected": middles.points.real + a_heights.points}
    projected["v_projected"] = halves.points.real + v_heights.points
    curves = {"v_chords": v_chords, "v_curve": v, "s_chords": s_chords, "s_curve": s}
    return hand.finished(givens, _draw, projected | curves)


def _integrated(
    hand: Hand, givens: IntegrationGivens, index: int, ordinates: Drawn | Setting, uprights: Drawn, origin: Drawn
) -> tuple[Drawn, Drawn]:
    """The middle ordinates carried to the vertical axis, and the chords parallel to the rays from the pole to them."""
    stations, target = givens.stations, "vs"[index - 1]
    pole = hand.lay_off(f"P{index}", hand.given("origin"), -RIGHT, givens.poles[index - 1])
    heights = hand.project(f"heights for {target}", ordinates, origin)
    rays = hand.join(f"rays of {target}", pole, heights)
    # Of rays that fall on one another one is drawn, and serves for all.
    each = hand.take(f"ray of each part for {target}", rays, which=first_at_height(heights.points.imag))
    chains = tuple(zip(stations.phases, stations.parts, strict=True))
    return heights, hand.end_to_end(f"chords of {target}", each, uprights, chains)


def _above_base(givens: IntegrationGivens, polygons: Floats) -> Floats:
    """Heights (..., m) of chords above the base lines, turned to join the ends of every phase."""
    stations = givens.stations
    return polygons - polygons[..., stations.last[stations.moving]] * stations.u


def _stacked_polygons(givens: IntegrationGivens, part: int, polygons: Floats) -> Floats:
    """Each phase's polygon (..., m) set on the end of the one before, less what is left after the turn.

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
    """The maximum displacement on paper, NaN in a sample where nothing has risen above the axis.

    full : what the greatest ordinate would give over the whole phase [mm of paper]
    """
    risen = top > NEGLIGIBLE_DISPLACEMENT * full
    if pencil.samples is None and not risen:
        remedy = say("leave drawing.divisions out, or divide into more parts")
        quantity = say("maximum displacement on paper")
        raise DesignError(quantity, say("{length:.3g} mm", length=float(top)), say("above the axis"), remedy)
    return np.where(risen, top, np.nan)


def _top(motion: Motion, stations: Stations) -> int:
    """The station at the end of the phase that reaches the known maximum displacement."""
    reached = motion.levels[stations.phase[stations.last] + 1]
    return int(stations.last[np.argmax(reached)])


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(c: Integrated) -> list[Step]:
    passes = list[Step]()
    for run in _INTEGRATIONS:
        # Where the velocity is constant between its jumps there is nothing to integrate.
        rays = [_draw_rays(c, run)] if c.givens.integrated_parts(run.index).any() else []
        passes += [*rays, _draw_chords(c, run), _draw_curve(c, run)]
    return [*passes, *_draw_scales(c)]


@dataclass(frozen=True)
class _Integrating:
    """The views, symbols and sentences in which one integration differs from the other."""

    index: int
    source: View
    target: View
    symbols: tuple[str, str]
    carried: Caption
    closing: Caption
    joined: Caption
    met: Caption

    @property
    def subscript(self) -> str:
        """The index of the pole as it is written."""
        return f"{self.index}".translate(SUBSCRIPTS)


_AT_REST = say(
    "Each phase ends at rest: the residual velocity there, at most {left:.2f} mm, is removed by rotating the base line."
)
_SHARED_OUT = say("The residual displacement at the end of the turn, {left:.2f} mm, is distributed over the returns.")
_ORDINATES_CAPTION = say(
    "Carry each middle ordinate of {source} horizontally to the vertical axis with the T-square, join it there to the "
    "pole with the ruler, and give the ray the number of the part; equal ordinates share one ray."
)
_OF_CHORDS = say(
    "Take the ordinate at the middle of each chord of {source}, carry it horizontally to the vertical axis with the "
    "T-square, join it there to the pole with the ruler, and give the ray the number of the part; equal ordinates "
    "share one ray."
)
_CORNERS_REASON = say("The slope of v is the acceleration: v has a corner where it jumps, and is smooth elsewhere.")
_CORNER_OF_S_REASON = say("The slope of s is the velocity: where that jumps s has a corner, and is smooth elsewhere.")
_SMOOTH_REASON = say("The slope of s is the velocity, which never jumps, so adjoining pieces of s share a tangent.")
_INTEGRATIONS = (
    _Integrating(1, ACCELERATION, VELOCITY, ("a", "v"), _ORDINATES_CAPTION, _AT_REST, _CORNERS_REASON, CORNER),
    _Integrating(2, VELOCITY, DISPLACEMENT, ("v", "s"), _OF_CHORDS, _SHARED_OUT, _SMOOTH_REASON, CONTINUOUS_TANGENT),
)


def _draw_rays(c: Integrated, run: _Integrating) -> Step:
    """The step that draws the pole, and of all rays each that falls on no other."""
    stations, distance, (source, target) = c.givens.stations, c.givens.poles[run.index - 1], run.symbols
    used = c.givens.integrated_parts(run.index)
    pole, levelled, rays = (c.acts[name] for name in (f"P{run.index}", f"heights for {target}", f"rays of {target}"))
    height, farthest = levelled.shown.imag, c.first(f"{source}_projected").real
    alike = first_at_height(height)
    kept = np.unique(alike[used]).tolist()
    same = [np.flatnonzero((alike == k) & used).tolist() for k in kept]
    # Their projections are drawn once too, from the farthest ordinate.
    reach = np.array([farthest[parts].max() for parts in same])
    projected, names = levelled.first[kept], [joined_parts(parts, stations) for parts in same]
    laid_out = pole_marks(pole, distance, run.subscript, height[kept])
    halves = [c.acts["middles of v"]] if run.index == 2 else []
    marks = (
        *(places.dots(Role.CONSTRUCTION) for places in halves),
        Segments(projected.points, reach + projected.points, Role.CONSTRUCTION).left_by(projected),
        rays.first[kept].segments(Role.CONSTRUCTION),
        *ray_numbers(projected, reach, same, partial(joined_parts, stations=stations)),
    )
    marked = say("Mark the pole P{index} on the axis, H{index} = {distance:.1f} mm to the left of 0.")
    marked = marked.with_values(index=run.subscript, distance=distance)
    rows = tuple(
        Row(
            (say("Rays {name}") if len(own) > 1 else say("Ray {name}")).with_values(name=name),
            say("{source} = {y:z.2f} mm", source=source, y=height[k]),
            (*(places.first[own] for places in halves), levelled.first[[k]], rays.first[[k]]),
        )
        for k, own, name in zip(kept, same, names, strict=True)
    )
    carried = run.carried.with_values(source=source), *close_ends_caption(projected)
    said = sequence([*carried, rows[min(2, len(rows) - 1)].caption], " ")
    why = say(
        "A ray rises by the ordinate y over the distance H, so its slope y/H is the slope that {target} has there."
    ).with_values(target=target)
    title = say("Pole and rays, {source} to {target}", source=source, target=target)
    parts = Part(marked, (pole.first,)), Part(said, rows=rows)
    return Step(title, parts, run.source, (*laid_out, *marks), given=laid_out, why=why)


def _draw_chords(c: Integrated, run: _Integrating) -> Step:
    stations, (source, target) = c.givens.stations, run.symbols
    polygon, curve = c.acts[f"{target}_chords"], c.acts[f"{target}_curve"]
    y, left = polygon.shown.imag, float(np.max(np.abs(c.first(f"closing_{target}"))))
    heights, far = curve.shown.imag, np.abs(y) >= 0
    axes, under = c.givens.axes(target, heights), c.givens.degrees_under(heights)
    if run.index == 2:
        # What is near the numbers of the axis needs none of its own.
        axes, far = (
            (*axes, *number_labels(c.acts["acceleration: axis"], stations, -UP)),
            np.abs(y) > AXIS_NUMBER_DISTANCE,
        )
        if c.givens.lowest:
            axes, under = (*axes, *c.givens.phases_under(heights)), ()
    marks = (
        *(polygon.first[span].line(Role.CONSTRUCTION) for span in stations.phases),
        curve.segments_from(curve.shown.real + 0j, Role.CONSTRUCTION),
        *number_labels(polygon, stations, _outward_directions(y, stations), far),
    )
    # The fourth chord is worked in full, or the first one after it that climbs.
    integrated = c.givens.integrated_parts(run.index)
    climbing = np.flatnonzero((np.abs(np.diff(y)[stations.left]) >= NEGLIGIBLE_SIZE) & integrated)
    part = int(climbing[min(np.searchsorted(climbing, 3), climbing.size - 1)]) if climbing.size else 0
    k, names = int(stations.left[part]) + 1, station_names(stations)
    width = polygon.shown.real[k] - polygon.shown.real[k - 1]
    values = {"name": names[k], "before": names[k - 1], "width": width, "distance": c.givens.poles[run.index - 1]}
    values |= {"rise": y[k] - y[k - 1], "height": c.acts[f"heights for {target}"].shown.imag[part]}
    said = say(
        "In each part draw a chord parallel to its ray with two set squares, from the end of the previous chord "
        "to the next vertical, and number its end. Chord {name}: slide the set square from ray {name} to point "
        "{before} and draw as far as vertical {name}; it climbs by y·Δx/H = {height:.2f}·{width:.2f}/{distance:.1f} = "
        "{rise:.2f} mm."
    ).with_values(**values)
    why = say(
        "A chord with the slope y/H climbs by y·Δx/H, the area of its part divided by H, so chords set end to end "
        "add up the area under {source}."
    ).with_values(source=source)
    if run.index == 1 and c.givens.motion.blows:
        said = sequence([*([said] if integrated.any() else []), _laid_off(c)], " ")
    chords = Part(said, rows=tuple(row for k in range(len(stations.phases)) for row in _chord_rows(c, run, k)))
    checks = tuple(_ordinates(c, run))
    checks = introduced_parts(run.closing.with_values(left=left), checks) if left > NEGLIGIBLE_SIZE else checks
    title = say("Chords parallel to the rays: {target}", target=target)
    if not integrated.any():
        title, why = say("The velocity by the law"), say("A velocity that jumps has no acceleration to be integrated.")
    return Step(title, (chords, *checks), run.target, (*axes, *marks), given=axes, why=why, under=under)


def _laid_off(c: Integrated) -> Caption:
    """The sentences on the velocities that jump, which are laid off."""
    (k, reference), h1 = c.givens.motion.reference, c.givens.poles[0]
    phases = moving_phases(c.givens.motion, c.givens.stations)
    blown = next(phase for phase in phases if any(phase.normalised.blows))
    v = float(np.max(np.abs(c.givens.velocity_jumps()[c.givens.stations.phases[phases.index(blown)]])))
    first = c.givens.motion.phases[k]
    title = phase_title(c.givens.motion, c.givens.motion.phases.index(blown))
    said = say(
        "Where the velocity jumps lay off its jump, vertically: {v:.2f} mm on {phase}, and of others in proportion to "
        "h/φ. This length is chosen; its scale is found at the end."
    )
    if isinstance(first, MovingPhase) and first.steady_acceleration:
        said = say(
            "Where the velocity jumps, lay off its jump, vertically: of {phase} {v:.2f} mm = y₁·(f′·h/φ)/((C₁·h₁/φ₁²)·"
            "μᵩ·H₁), with the y₁ = {y:.1f} mm that was chosen, and of others in proportion."
        )
    return said.with_values(v=v, phase=title, y=c.givens.ordinate, h1=h1, reference=reference)


def _outward_directions(y: Floats, stations: Stations) -> Points:
    """Directions to the outer side of the curves: left where they leave the axis, right where they come back to it."""
    leaving = np.concatenate([np.gradient(np.abs(y[span])) >= -NEGLIGIBLE_SIZE for span in stations.phases])
    return np.where(leaving, -RIGHT, RIGHT) + 0j


def _chord_rows(c: Integrated, run: _Integrating, phase: int) -> Iterator[Row]:
    """The rows of the chords of a phase, one after another; for s with the start of the first."""
    stations, polygon = c.givens.stations, c.acts[f"{run.symbols[1]}_chords"]
    span, y, names = stations.phases[phase], polygon.shown.imag, station_names(stations)
    if run.index == 2:
        start = _START_CAPTIONS[0 if abs(y[span.start]) < NEGLIGIBLE_SIZE else 1 if phase else 2]
        title = say("Start of {phase}", phase=phase_title(c.givens.motion, int(stations.phase[span.start])))
        yield Row(title, start.with_values(y=y[span.start], name=names[span.start]), (polygon.first[[span.start]],))
    blows = (stations.left[stations.blows] + 1).tolist()
    for k in range(span.start + 1, span.stop):
        rise = y[k] - y[k - 1]
        if k in blows:
            if run.index == 1:
                title = say("From {first} to {last}", first=names[k - 1], last=names[k])
                yield Row(
                    title, _JUMP_CAPTIONS[int(rise > 0)].with_values(jump=abs(rise)), (polygon.first[[k - 1, k]],)
                )
            continue
        change = _CHORD_CAPTIONS[0 if abs(rise) < NEGLIGIBLE_SIZE else 1 if rise > 0 else 2].with_values(rise=abs(rise))
        # The first chord of v starts at rest, where the phase does.
        first = k == span.start + 1 and run.index == 1
        said = say("{change} from {before} on the axis", before=names[k - 1], change=change) if first else change
        yield Row(
            say("Chord {name}", name=names[k].replace("⁻", "")), said, (polygon.first[[k - 1, k] if first else [k]],)
        )


_START_CAPTIONS = (
    say("vertical {name}, on the axis"),
    say("carry the end of the previous phase, {y:.2f} mm high, horizontally to vertical {name}"),
    say("vertical {name}; the axis, through the lowest dwell, will lie {y:.2f} mm below"),
)
_JUMP_CAPTIONS = say("v falls {jump:.2f} mm at once"), say("v rises {jump:.2f} mm at once")
_CHORD_CAPTIONS = say("is horizontal"), say("climbs {rise:.2f} mm"), say("falls {rise:.2f} mm")


def _ordinates(c: Integrated, run: _Integrating) -> Iterator[Part]:
    """The parts that draw the ordinates of each phase at the ends of its chords, less what is left at its end."""
    stations, names = c.givens.stations, station_names(c.givens.stations)
    polygon, curve = (c.acts[f"{run.symbols[1]}_{name}"] for name in ("chords", "curve"))
    fastest = np.abs(c.acts["v_curve"].shown.imag)
    for span in stations.phases:
        first, last = span.start, span.stop - 1
        highest = np.flatnonzero(fastest[span] > (1 - SAME_HEIGHT) * np.max(fastest[span]))
        k = first + int(highest[highest.size // 2])
        off = (curve.shown - polygon.shown).imag[[first, last]]
        # What is nothing has no sign.
        y, end = (float(np.round(curve.shown.imag[each], 2)) + 0.0 for each in (k, last))
        ends = {"first": names[first], "last": names[last]}
        said = _CHECK_CAPTIONS[int(end != 0)].with_values(symbol=run.symbols[1], y=y, name=names[k], end=end, **ends)
        if np.abs(off).max() > NEGLIGIBLE_SIZE:
            shared = _RESIDUAL_CAPTIONS[int(np.abs(off[0]) > NEGLIGIBLE_SIZE)].with_values(
                start=off[0], by=off[1], **ends
            )
            said = sequence([shared, said], " ")
        yield Part(said, (curve.first[span],))


_CHECK_CAPTIONS = (
    say("Check: {symbol} is {y:.2f} mm at {name} and zero at {last}."),
    say("Check: {symbol} is {y:.2f} mm at {name} and {end:.2f} mm at {last}."),
)
_RESIDUAL_CAPTIONS = (
    say("Distribute the residual: {by:+.2f} mm at {last}, decreasing in proportion back to {first}."),
    say("Distribute the residual: {start:+.2f} mm at {first} to {by:+.2f} mm at {last}, in proportion between them."),
)


def _draw_curve(c: Integrated, run: _Integrating) -> Step:
    target = run.symbols[1]
    lines, parts = curve_over_phi(c.givens, errorless_hand(c), target, c.acts[f"{target}_curve"], run.met)
    why = _CORNER_OF_S_REASON if run.index == 2 and c.givens.motion.blows else run.joined
    return Step(say("Curve of {target}", target=target), parts, run.target, lines, why=why)


def _draw_scales(c: Integrated) -> Iterator[Step]:
    at, (h1, h2), lift = _top(c.givens.motion, c.givens.stations), c.givens.poles, c.givens.motion.lift
    top, mu = c.acts["s_curve"].first[[at]], {name: c.readings[name].per_mm for name in "sva"}
    values = {"unit": unit(c.givens.unit), "paper": top.place.imag, "lift": lift, "mu_phi": c.givens.mu_phi.per_mm}
    values |= {"mu_s": mu["s"], "mu_v": mu["v"], "mu_a": mu["a"], "h1": h1, "h2": h2}
    height = Dimension(top.place.real + 0j, top.place, say("{y:.1f}", y=top.place.imag), -6.0).left_by(top)
    known = say(
        "The maximum of s measures {paper:.2f} mm and stands for the known lift of {lift:.6g} {unit}, so μₛ = "
        "{lift:.6g} {unit}/{paper:.2f} mm = {mu_s:.5g} {unit}/mm."
    )
    through = {
        "v": say("Divide by μᵩ·H₂: μᵥ = {mu_s:.5g}/({mu_phi:.5g}·{h2:.6g}) = {mu_v:.5g} ({unit}/rad)/mm."),
        "a": say("Divide by μᵩ·H₁: μₐ = {mu_v:.5g}/({mu_phi:.5g}·{h1:.6g}) = {mu_a:.5g} ({unit}/rad²)/mm."),
    }
    yield _scale(c, "s", known.with_values(**values), top, (height,))
    if not c.first("a").any() and c.givens.motion.blows:  # of arrows there is no scale
        del through["a"]
    for name, said in through.items():
        yield _scale(c, name, said.with_values(**values))


def _scale(c: Integrated, name: str, found: Caption, of: Drawn | None = None, marks: tuple[Mark, ...] = ()) -> Step:
    view, title, why, reads = _SCALES[name]
    stations, mu, turn = c.givens.stations, c.readings[name].per_mm, c.givens.end
    k = int(stations.left[min(3, stations.left.size - 1)]) + 1
    read = {"y": c.first(name)[k], "value": c.value(name)[k], "unit": unit(c.readings[name].unit)}
    told = say("Station {name}: {symbol} = {y:.2f} mm × {mu:.5g} = {value:.5g} {unit}; repeat for the others.")
    told = told.with_values(name=station_names(stations)[k], symbol=name, mu=mu, **read)
    # From the pole rays run to the axis on the left.
    heights = np.concatenate([c.first("a"), c.first("a_before")]) if name == "a" else c.acts[f"{name}_curve"].shown.imag
    lift_unit = c.readings[name].unit
    at = None if name == "s" else turn
    title_of_axis = "" if at is None else ordinate_title(name, c.givens.unit)
    divided = graduation_marks(heights, mu, at, c.readings[name].act, lift_unit, title_of_axis)
    if lift_unit == "rad":
        told = sequence([told, say("In degrees the scale is {mu:.5g}°/mm.", mu=np.degrees(mu))], " ")
    if c.givens.omega is not None and name != "s":
        told = sequence([told, time_scale_caption(mu, name, c.givens.omega, c.givens.unit)], " ")
        divided += graduated_at_speed(heights, mu, name, c.givens.omega, c.givens.unit, turn, c.readings[name].act)
    parts = Part(found, () if of is None else (of,)), Part(told)
    return Step(title, parts, view, (*marks, *divided), reads, why=why)


_SCALES = {
    "s": (
        DISPLACEMENT,
        say("The scale of s"),
        say("The lift is known, so its length on paper fixes the scale."),
        ("s", "closing_s"),
    ),
    "v": (
        VELOCITY,
        say("The scale of v"),
        say("A chord of s climbs by y·Δx/H₂, so the second integration has divided the scale by μᵩ·H₂."),
        ("v", "max_v", "closing_v"),
    ),
    "a": (
        ACCELERATION,
        say("The scale of a"),
        say("A chord of v climbs by y·Δx/H₁, so the first integration has divided the scale by μᵩ·H₁."),
        ("a", "max_a"),
    ),
}
