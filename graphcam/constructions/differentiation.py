"""Graphical differentiation, twice: displacement to velocity to acceleration, by chords or by tangents.

It turns the integration round.  A ray through the pole parallel to a chord, or to a tangent, cuts the vertical axis at
the height y = H dy/dx: the ordinate of the derivative.  By chords it belongs to the middle of the interval, where it is
right to second order; by tangents to the station itself.  The scales follow as mu_v = mu_s/(mu_phi H1) and
mu_a = mu_v/(mu_phi H2).
"""

import math
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Literal

import numpy as np

from graphcam.constructions.axes import (
    NAMED_STATION_STEPS,
    SUBSCRIPTS,
    axes_over_phi,
    degrees_below,
    height_range,
    ordinate_title,
    pole_marks,
)
from graphcam.constructions.graduation import (
    close_ends_caption,
    coinciding_heights,
    graduation_marks,
    height_caption,
    ranges,
    ray_numbers,
    row_numbers,
    run_of_chord,
)
from graphcam.constructions.pole_scales import PoleTerms, pole_formula
from graphcam.drafting import telling
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Reading, Step, View, say
from graphcam.drafting.marks import Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Formula, Meaning, ReadingMeaning, Symbol
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, unit
from graphcam.errors import DesignError
from graphcam.given.laws import Floats
from graphcam.plane_vectors import dot
from graphcam.words import say_many, sequence

By = Literal["chords", "tangents"]
MIN_STATIONS = 4
"""Stations: with fewer no acceleration has a neighbour."""
TANGENT_HALF_LENGTH = 12.0
"""Half the length of a drawn tangent [mm of paper]."""
CROSS_HALF_WIDTH, ROWS_ROOM = 0.6, 2.5
"""Half the width of a cross at a row, and how far apart crosses stand at least [mm of paper]."""

DIAGRAM_VIEWS = {
    "s": View("measured displacement", say("Displacement s to differentiate"), across="measured phi", up="measured s"),
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
    rows: Points = field(default_factory=lambda: np.empty(0, dtype=np.complex128))


def _cam_angles(at: str, drawn: Construction[DifferentiationGivens]) -> list[Caption]:
    """Captions of the cam angles to which the values of a derivative belong."""
    return [say("φ = {phi:.4g}°", phi=phi) for phi in np.degrees(drawn.value(at))]


def _by_pole(drawn: Construction[DifferentiationGivens], source: str, pole: int) -> PoleTerms:
    givens = drawn.givens
    mu = givens.mu_s.per_mm if source == "s" else drawn.readings[source].per_mm
    return PoleTerms(mu, givens.mu_phi.per_mm, givens.poles[pole - 1])


FORMULAS = (
    Formula(
        r"y = H\,\frac{\Delta y}{\Delta x}",
        symbols=(
            Symbol("y", say("the height at which a ray ends on the vertical axis"), "mm of paper"),
            Symbol(r"\frac{\Delta y}{\Delta x}", say("the slope of its chord or tangent on the paper")),
            Symbol("H", say("the pole distance: H₁ of the first differentiation, H₂ of the second"), "mm of paper"),
        ),
    ),
    pole_formula("v", "s", 1, _by_pole),
    pole_formula("a", "v", 2, _by_pole),
)


MEANING = Meaning(
    "differentiation",
    say("Velocity and acceleration by differentiation"),
    say(
        "The displacement, differentiated: a parallel to each chord through the pole cuts off the "
        "velocity in the middle of the interval. Differentiation amplifies every drawing error."
    ),
    {
        "v": ReadingMeaning(say("velocity v"), "v", "lift/rad", over=partial(_cam_angles, "v_at")),
        "a": ReadingMeaning(say("acceleration a"), "a", "lift/rad²", over=partial(_cam_angles, "a_at")),
        "max_v": ReadingMeaning(say("maximum v"), "max v", "lift/rad"),
        "max_a": ReadingMeaning(say("maximum a"), "max a", "lift/rad²"),
    },
    FORMULAS,
    scales={DIAGRAM_VIEWS["s"].name: "rise", DIAGRAM_VIEWS["v"].name: "v", DIAGRAM_VIEWS["a"].name: "a"},
    scales_found_by="integration",
)


def differentiation(
    x: Floats,
    s: Floats | Reading,
    mu_phi: Scale,
    mu_s: Scale,
    poles: tuple[float, float],
    pencil: Pencil,
    *,
    turn: float | None = None,
    by: By = "chords",
    rows: Points | None = None,
    meaning: Meaning = MEANING,
) -> Construction[DifferentiationGivens]:
    """Differentiate a drawn displacement twice.

    x, s : (n,) stations on the axis of the cam angle, growing, and ordinates there [mm of paper], or what was read
    mu_phi, mu_s : scales of the axes [rad/mm; mm/mm or, of an arm, rad/mm]
    poles : H1 (displacement to velocity) and H2 (velocity to acceleration) [mm of paper]
    turn : length of one revolution [mm of paper] of a cyclic diagram, which goes on after the last station with the
        first; None for a diagram that ends there
    by : "chords", or "tangents" with a mirror ruler; the intervals may be unequal
    rows : (m,) places [mm of paper] of a table that the displacement smooths, to be shown beside it
    meaning : what the construction says of itself

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
    hand, shown = Hand(pencil, meaning, mu_s.unit), {} if rows is None else {"rows": rows}
    ordinates = hand.carry(s, s.per_mm / mu_s.per_mm) if isinstance(s, Reading) else np.asarray(s, dtype=np.float64)
    x, count = np.asarray(x, dtype=np.float64), (s.paper if isinstance(s, Reading) else np.asarray(s)).shape[-1:]
    _check(x, count, turn)
    givens = DifferentiationGivens(x, mu_phi, mu_s, poles, turn, by, **shown)
    origin = hand.given("origin")
    if rows is not None:
        hand.given("rows", np.asarray(rows))
    plotted = hand.lay_off("s", hand.lay_off("stations", origin, RIGHT, x), UP, ordinates)
    (start, end), v = _derived(hand, givens, 1, plotted, _extended_curve(hand, turn, plotted))
    v_on = _extended_curve(hand, turn, v)
    _, a = _derived(hand, givens, 2, v, v_on)
    mu_v = mu_s.per_mm / (mu_phi.per_mm * poles[0])
    mu_a = mu_v / (mu_phi.per_mm * poles[1])
    hand.read("rise", distance_between(start, end, UP), mu_s.per_mm, mu_s.unit)
    hand.read("run", distance_between(start, end, RIGHT), mu_phi.per_mm, "rad", rounded=False)
    for name, derived, scale in (("v", v, mu_v), ("a", a, mu_a)):
        hand.read(name, distance_between(origin, derived, UP), scale)
        hand.read(f"{name}_at", distance_between(origin, derived, RIGHT), mu_phi.per_mm, "rad", rounded=False)
    hand.read("max_v", _greatest_ordinate(hand, v, v_on), mu_v)
    hand.read("max_a", _greatest_ordinate(hand, a, _extended_curve(hand, turn, a)), mu_a)
    return hand.finished(givens, _draw, {"s": plotted, "v": v, "a": a})


def _check(x: Floats, count: tuple[int, ...], turn: float | None) -> None:
    checked = say("stations of the displacement")
    if x.ndim != 1 or x.shape != count or x.size < MIN_STATIONS:
        raise DesignError(checked, x.size, say("{least} or more, each with its ordinate", least=MIN_STATIONS))
    if not np.all(np.diff(x) > 0):
        raise DesignError(checked, say("not in order"), say("growing along the axis"), say("sort them"))
    if turn is not None and not x[-1] - x[0] < turn:
        remedy = say("leave out the last one where it is the first one again")
        found = say("over {value:g} mm", value=x[-1] - x[0])
        raise DesignError(checked, found, say("within one turn of {turn:g} mm", turn=turn), remedy)


def _extended_curve(hand: Hand, turn: float | None, curve: Drawn) -> Drawn:
    """The places of a curve; for a cyclic diagram in the turn before, its own and the one after."""
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


def _greatest_ordinate(hand: Hand, curve: Drawn, going_on: Drawn) -> Setting:
    """The maximum ordinate up or down, where the faired curve turns; for a cyclic diagram over its ends too."""
    name, count, ends = curve.act.name, curve.points.shape[-1], list[Setting]()
    for side, word in ((UP, "highest"), (-UP, "lowest")):
        # Of a cyclic diagram begun on the other side, so that the farthest ordinate has neighbours on both.
        begin = count + np.argmin(dot(side, curve.points), axis=-1)[..., None] if going_on is not curve else 0
        places = hand.take(f"{name} about its {word}", going_on, which=begin + np.arange(count))
        top = hand.tangent(f"{word} {name}", places, [slice(None)], side)
        ends.append(distance_between(hand.acts["origin"], top, side))
    return calculated_setting(np.maximum, *ends)


# --- the steps -------------------------------------------------------------------------------------------------------

READABLE_ANGLE = 0.05
"""Angles [degrees] of less are not told: they are nothing."""


@dataclass(frozen=True, eq=False)
class _Pass:
    """One differentiation as it is drawn: its number, and from which curve to which."""

    c: Construction[DifferentiationGivens]
    number: int
    source: str
    target: str

    def drawn(self, name: str) -> Drawn:
        """The places that an act of this pass left, in the first sample."""
        return self.c.acts[f"{name} {self.number}"].first

    @property
    def first_slope_number(self) -> int:
        """The number of the first slope: chords are numbered from 1, the points of the tangents from 0."""
        return int(self.c.givens.by == "chords")

    @property
    def names(self) -> list[str]:
        """The numbers of the chords or tangents."""
        return [f"{self.first_slope_number + k}" for k in range(self.drawn("slopes").shown.size)]

    def slope(self, k: int) -> Caption:
        """A caption of how a chord or a tangent runs."""
        way = complex(self.drawn("slopes").directions[k])
        if self.first_slope_number:
            return run_of_chord(way)
        angle = math.degrees(np.angle(way))
        if abs(angle) < READABLE_ANGLE:
            return say("is level")
        return say("rises at {angle:.1f}°", angle=angle) if angle > 0 else say("falls at {angle:.1f}°", angle=-angle)

    def height(self, k: int) -> Caption:
        """A caption of where a ray ends on the vertical axis."""
        return height_caption(float(self.drawn("heights").shown[k].imag), say("at the origin"))

    def told(self, *sentences: Caption) -> Caption:
        """Sentences with the values of the pass, and of the steepest slope, which is worked for all."""
        k, names = int(np.argmax(np.abs(self.drawn("heights").shown.imag))), self.names
        values = {"source": self.source, "target": self.target, "index": f"{self.number}".translate(SUBSCRIPTS)}
        values |= {"name": names[k], "count": len(names), "pole": self.c.givens.poles[self.number - 1]}
        values |= {"slope": self.slope(k), "height": self.height(k), "start": self.number - 1}
        return sequence([each.with_values(**values) for each in sentences], " ")


def _draw(c: Construction[DifferentiationGivens]) -> list[Step]:
    runs = _Pass(c, 1, "s", "v"), _Pass(c, 2, "v", "a")
    drawn = [draw(run) for run in runs for draw in (_traced, _with_rays, _curve_step)]
    return [_draw_source(c), *drawn, *(_scale(run) for run in runs)]


def _draw_source(c: Construction[DifferentiationGivens]) -> Step:
    s, stations, mu_s = c.acts["s"].first, c.acts["stations"].first, c.givens.mu_s
    k = int(np.argmax(np.abs(s.shown.imag)))
    below = row_numbers(stations, 0, np.full(s.shown.shape, -UP))
    axes = (*_axes(c, "s"), *graduation_marks(s.shown.imag, mu_s.per_mm, lift_unit=mu_s.unit))
    plotted = (*axes, s.dots(Role.CONSTRUCTION), s.segments_from(stations, Role.CONSTRUCTION), *below)
    plotted_at = say_many(
        "The displacement is plotted at {count} station.",
        "The displacement is plotted at {count} stations.",
        s.shown.size,
    )
    said = say(
        "Mark them on the axis, 1 mm = {degrees:.4g}°, and number them from 0. Draw the displacement as an "
        "ordinate at each, 1 mm = {mu:.4g} {unit}: station {name} lies {x:.2f} mm from the origin, and its "
        "ordinate is {y:.2f} mm. Join the ends by a smooth curve with the French curve."
    ).with_values(name=k, x=stations.shown[k].real, y=s.shown[k].imag, unit=unit(mu_s.unit), mu=mu_s.per_mm)
    told = [plotted_at, said.with_values(degrees=math.degrees(c.givens.mu_phi.per_mm))]
    if c.givens.turn:
        told.append(say("After the last station the next turn begins with station 0."))
    rows, curve, crosses = _shown_rows(c), _curve(c, "s"), ()
    if rows:
        told.append(say("The crosses are rows of the table, which the curve smooths."))
        arms = CROSS_HALF_WIDTH * np.array([1 + UP, 1 - UP])
        crosses = (Segments(rows[0].shown - a, rows[0].shown + a, Role.LIMIT).left_by(rows[0]) for a in arms)
    marks = (*plotted, *crosses, curve.line(Role.RESULT))
    why = say("The velocity is the slope of the displacement, and only a curve has a slope.")
    part, under = Part(sequence(told, " "), (*rows, curve)), _degrees(c, "s")
    return Step(say("The displacement"), (part,), _view(c, "s"), marks, given=plotted, why=why, under=under)


def _shown_rows(c: Construction[DifferentiationGivens]) -> tuple[Drawn, ...]:
    """The rows of a table that are shown as crosses, every k-th where they lie too close to one another."""
    rows = c.givens.rows
    if not rows.size:
        return ()
    spacing = float(np.median(np.diff(np.sort(rows.real))))
    every = next((k for k in NAMED_STATION_STEPS if k * spacing >= ROWS_ROOM), rows.size)
    return (c.acts["rows"].first[np.argsort(rows.real)[::every]],)


def _traced(run: _Pass) -> Step:
    c, slopes = run.c, run.drawn("slopes")
    places, along, outward = slopes.shown, slopes.directions, np.where(slopes.shown.imag < 0, -UP, UP)
    more = [say("Repeat for the others, {count} in all.")]
    if c.givens.by == "chords":
        # At each corner but the first one a chord ends.
        index = np.append(slopes.index[:1], slopes.index)
        line = Line(np.append(places, places[-1] + along[-1]), Role.LIMIT, of=slopes.act, index=index)
        # A number here would stand beside that of a point, and be taken for it; the rays have theirs.
        beside, numbers, title, called = run.drawn("middles"), (), say("Chords of {source}"), say("Chord {name}")
        # The points of s are counted from 0, those of v from 1.
        number = say("A chord has the number of the point at its end.")
        if run.source == "v":
            number = say("A chord has the number of the point where it begins.")
        said = say("With the ruler join each point of {source} to the next one."), number
        one = say("Chord {name} runs {slope}.")
        if c.givens.turn:
            more.append(say("The last one runs to point {start} of the next turn."))
        why = say("The mean slope of {source} over a part is very nearly its slope in the middle of the part.")
    else:
        title, called = say("Tangents to {source}"), say("Tangent {name}")
        beside, half = slopes, TANGENT_HALF_LENGTH * along / np.abs(along)
        line = Segments(places - half, places + half, Role.LIMIT).left_by(slopes)
        # The points of v have theirs already.
        numbers = row_numbers(slopes, run.first_slope_number, outward) if run.source == "s" else ()
        said = (
            say(
                "Set a mirror across the curve of {source} at a point, and turn it until the curve runs into its "
                "image without a corner: then it is on the normal. Draw the tangent square to it, and number it."
            ),
        )
        one = say("Tangent {name}, square to the mirror at point {name}, {slope}.")
        why = say(
            "The tangent has the slope of {source} at its point, and a mirror finds it more exactly than the eye."
        )
    part = telling.run(run.told(*said, one, *more), called, run.names, slopes, beside, settings=run.slope)
    return Step(run.told(title), (part,), _view(c, run.source), (line, *numbers), why=run.told(why))


def _with_rays(run: _Pass) -> Step:
    c, rays, heights, derived = run.c, run.drawn("rays"), run.drawn("heights"), run.c.acts[run.target].first
    groups, distance = coinciding_heights(heights), c.givens.poles[run.number - 1]
    kept, index = [int(group[0]) for group in groups], f"{run.number}".translate(SUBSCRIPTS)
    pole = pole_marks(c.acts[f"P{run.number}"], distance, index, heights.shown.imag)
    reach, shared_by = np.array([derived.shown.real[group].max() for group in groups]), [g.tolist() for g in groups]
    axes, outward = (*_axes(c, run.target), *pole), np.where(derived.shown.imag < 0, -UP, UP)
    carried = (
        Segments(rays.shown[kept], heights.shown[kept], Role.CONSTRUCTION, of=rays.act, index=rays.index[kept]),
        *(derived.segments_from(heights, Role.CONSTRUCTION), derived.dots(Role.CONSTRUCTION)),
        *ray_numbers(heights[kept], reach, shared_by, lambda slopes: ranges(run.first_slope_number + np.array(slopes))),
        *row_numbers(derived, run.first_slope_number, outward),
    )
    why = say(
        "The triangle of pole, origin and height has the slope of {source}, so the height is H{index} times that "
        "slope: an ordinate of {target}."
    )
    set_off = say(
        "With the dividers set off the pole P{index} on the axis, H{index} = {pole:.1f} mm to the left of the origin."
    )
    ray = say(
        "Slide the set square from tangent {name} to P{index}: ray {name} ends on the vertical axis, {height}. With "
        "the T-square carry that height to the vertical of station {name}: point {name} of {target}."
    )
    if c.givens.by == "chords":
        ray = say(
            "Slide the set square from chord {name} to P{index}: ray {name} ends on the vertical axis, {height}. With "
            "the T-square carry that height to the vertical in the middle of chord {name}: point {name} of {target}."
        )
    shared = [say("Slopes that are parallel share a ray.")] if len(groups) < rays.shown.size else []
    shared += close_ends_caption(heights[kept])
    said = run.told(set_off, ray, say("Repeat for the others, {count} in all."), *shared)
    part = telling.run(said, say("Ray {name}"), run.names, rays, heights, derived, settings=run.height)
    title, marks = say("Pole and rays, {source} to {target}"), (*axes, *carried)
    under = () if run.target == "a" else _degrees(c, run.target)
    return Step(run.told(title), (part,), _view(c, run.target), marks, given=axes, why=run.told(why), under=under)


def _curve_step(run: _Pass) -> Step:
    c, target, heights = run.c, run.target, run.c.acts[run.target].shown.imag
    up, down = (abs(c.acts[f"{way} {target}"].place.imag) for way in ("highest", "lowest"))
    near, longest = int(np.argmax(heights if up >= down else -heights)), float(c.first(f"max_{target}"))
    said = say(
        "Join the points by a smooth curve with the French curve. Its longest ordinate, {height}, is near point {name}."
    ).with_values(
        height=height_caption(longest if up >= down else -longest, say("at the origin")),
        name=run.first_slope_number + near,
    )
    why = say("The values of {target} are wanted between the points too, above all the maximum.")
    title, curve = run.told(say("Curve of {target}")), _curve(c, target)
    return Step(title, (Part(said, (curve,)),), _view(c, target), (curve.line(Role.RESULT),), why=run.told(why))


def _view(c: Construction[DifferentiationGivens], symbol: str) -> View:
    view = DIAGRAM_VIEWS[symbol]
    scale = c.givens.mu_s.per_mm if symbol == "s" else c.readings[symbol].scale
    per = unit(c.givens.mu_s.unit) if symbol == "s" else sequence(["(", unit(c.readings[symbol].unit), ")"], "")
    values = {"title": view.title, "index": {"s": "ₛ", "v": "ᵥ", "a": "ₐ"}[symbol], "mu": scale}
    return replace(view, title=say("{title}, μ{index} = {mu:.4g} {per}/{mm}", per=per, mm=unit("mm"), **values))


def _curve(c: Construction[DifferentiationGivens], name: str) -> Drawn:
    """The faired curve; for a cyclic diagram over the ends of the turn."""
    hand, turn = errorless_hand(c), c.givens.turn
    line = hand.fair(f"curve of {name}", _extended_curve(hand, turn, c.acts[name].first), [slice(None)])
    drawn = slice(None) if turn is None else (line.points.real >= 0) & (line.points.real <= turn)
    return line[drawn]


def _end(c: Construction[DifferentiationGivens]) -> float:
    """The end of the diagrams on the axis of the cam angle [mm of paper]."""
    return float(c.givens.x[-1]) if c.givens.turn is None else c.givens.turn


def _axes(c: Construction[DifferentiationGivens], symbol: str) -> tuple[Mark, ...]:
    heights, name = c.acts[symbol].shown.imag, ordinate_title(symbol, c.givens.mu_s.unit)
    return (*axes_over_phi(_end(c), c.givens.mu_phi, heights, name), *(_degrees(c, symbol) if symbol == "a" else ()))


def _degrees(c: Construction[DifferentiationGivens], symbol: str) -> tuple[Mark, ...]:
    """The numbers of the common axis, under the diagram of a quantity."""
    return degrees_below(_end(c), c.givens.mu_phi, height_range(c.acts[symbol].shown.imag)[0])


def _scale(run: _Pass) -> Step:
    c, name = run.c, run.target
    said = say(
        "The first pole gives μᵥ = μₛ/(μᵩ·H₁) = {mu_s:.4g}/({mu_phi:.4g} · {pole:g}) = {mu_v:.5g} ({unit}/rad)/mm: "
        "the maximum velocity is {mm:.2f} mm × {mu_v:.5g} = {value:.5g} {unit}/rad."
    )
    if name == "a":
        said = say(
            "The second gives μₐ = μᵥ/(μᵩ·H₂) = {mu_v:.5g}/({mu_phi:.4g} · {pole:g}) = {mu_a:.5g} ({unit}/rad²)/mm: "
            "the maximum acceleration is {mm:.2f} mm × {mu_a:.5g} = {value:.5g} {unit}/rad²."
        )
    values = {"mu_phi": c.givens.mu_phi.per_mm, "mu_s": c.givens.mu_s.per_mm, "unit": unit(c.givens.mu_s.unit)}
    values |= {f"mu_{each}": c.readings[each].scale for each in "va"}
    values |= {"mm": float(c.first(f"max_{name}")), "value": float(c.value(f"max_{name}"))}
    why = say("A ray cuts off H times a slope on paper, where {source} and φ have their scales.")
    end, heights, read = _end(c), c.acts[name].shown.imag, c.readings[name]
    upright = Line(end + UP * np.array(height_range(heights)), Role.SCALE)
    marks, part = (
        (
            upright,
            *graduation_marks(heights, float(read.scale), end, read.act, name=ordinate_title(name, c.givens.mu_s.unit)),
        ),
        Part(run.told(said.with_values(**values))),
    )
    title, reads = run.told(say("The scale of {target}")), (f"max_{name}", name)
    return Step(title, (part,), _view(c, name), marks, reads, why=run.told(why))
