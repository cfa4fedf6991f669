"""The force plan of a translating follower at a station: load, contact force and the guide's reaction close a triangle.

The three forces on the follower are in equilibrium, so their arrows close.  The load Q is known in size and direction;
of the contact force F the direction is known from the drawn pressure angle; of the reaction R of the guide it is known
too: across the motion, or, with friction in the bearings, inclined against the motion by the angle whose tangent is
mu (l + 2 b)/l.  The lines of F and R through the ends of Q meet in the third corner.

Source: the equilibrium of a follower in two bearings, H. A. Rothbart, *Cam Design Handbook* (2004), chapter 6.
"""

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import itemgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import station_names
from graphcam.constructions.graduation import round_up
from graphcam.constructions.pressure_angle import MeasuredAngles, moving_up, shown_station
from graphcam.constructions.views import FORCES
from graphcam.drafting.acts import Drawn, Setting
from graphcam.drafting.euclid import NOWHERE, RIGHT, UP, unit as unit_along
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Caption, Construction, Part, Reading, Step, View, say
from graphcam.drafting.marks import Arrow, Dots, Label, Line, Mark, Role, angle_at
from graphcam.drafting.meaning import ALPHA, Formula, Meaning, ReadingMeaning, Symbol, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, unit
from graphcam.drafting.telling import Move, move_parts
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.spring_load import Guide, SpringLoad
from graphcam.plane_vectors import dot
from graphcam.words import sequence

LOAD_LENGTH = 50.0
"""The load is drawn at the largest round scale at which its arrow is not longer [mm]."""
BASE = 30.0
"""The length of the bearings is drawn as this, to find the inclination of the reaction [mm]."""
MIN_LOAD_SHARE = 0.1
"""The minimum share of the maximum load on the rises: less would show the errors of the drawn a and s alone."""
ROUND_NUMBERS = (1.0, 2.0, 2.5, 5.0, 10.0)
"""Round scales are these times a power of ten."""


@dataclass(frozen=True, eq=False)
class ForcePlanGivens:
    """What lies on the board; see :func:`force_plan`."""

    measured: MeasuredAngles
    load: SpringLoad
    guide: Guide | None
    station: int
    mu_force: Scale


CONTACT_FORCE = Symbol("F", say("the contact force"), "N")


def _in_equilibrium(plan: Construction[ForcePlanGivens]) -> Values:
    """The formula's values, where the triangle closes under a guide without friction: load, pressure angle, forces."""
    load, alpha = float(plan.value("load")), math.radians(abs(alpha_at(plan)))
    if not (plan.givens.guide or math.isnan(float(plan.first("normal")))):
        forces = {"load": load, "normal": load / math.cos(alpha), "reaction": load * math.tan(alpha)}
        yield {**forces, "alpha": math.degrees(alpha), "N": unit("N")}


FORMULAS = (
    Formula(
        r"F = \frac{Q}{\cos\alpha}, \qquad R = Q\tan|\alpha|",
        r"F = \frac{<load:.1f>}{\cos <alpha:.2f>^\circ} = <normal:.1f>\ \text{<N>}, \qquad "
        r"R = <load:.1f>\tan <alpha:.2f>^\circ = <reaction:.1f>\ \text{<N>}",
        _in_equilibrium,
        (
            CONTACT_FORCE,
            Symbol("Q", say("the load on the follower"), "N"),
            ALPHA,
            Symbol("R", say("the reaction of the guide"), "N"),
        ),
        of="normal",
    ),
)


MEANING = Meaning(
    "force_plan",
    say("Force plan"),
    say(
        "Load, contact force and the reaction of the guide are in equilibrium. Three directions and one "
        "magnitude are known, which determine a triangle."
    ),
    {
        "load": ReadingMeaning(say("load Q"), "Q", "N"),
        "normal": ReadingMeaning(say("contact force F"), "F", "N"),
        "along": ReadingMeaning(say("F cos α"), "F cos α", "N"),
        "side": ReadingMeaning(say("F sin α"), "F sin α", "N"),
        "friction": ReadingMeaning(say("friction in the guide"), "T", "N"),
        "reaction": ReadingMeaning(say("reaction R"), "R", "N"),
    },
    FORMULAS,
)


def force_plan(
    measured: MeasuredAngles,
    load: SpringLoad,
    pencil: Pencil,
    guide: Guide | None = None,
    station: int | None = None,
    mu_force: Scale | None = None,
) -> Construction[ForcePlanGivens]:
    """Draw the force plan at a station.

    guide : None for one without friction
    station : None for the one of :func:`plan_station`
    mu_force : scale of forces [N/mm]; None for a round one

    Readings are NaN where the load does not press, or the guide jams.
    """
    hand, k = Hand(pencil, MEANING), plan_station(measured, load) if station is None else station
    mu, foot, turn = load_laid_off(hand, measured, load, k, mu_force)
    origin, normal = hand.acts["origin"], hand.protractor("line of F", foot, UP, turn)
    if guide is None:
        across = hand.erect("line of R", origin, RIGHT)
    else:
        base = hand.lay_off("base", origin, -RIGHT, calculated_setting(partial(np.copysign, BASE), turn))
        (s,), direction = station_settings(hand, measured, k, "s"), direction_at(measured, k)
        incline = hand.lay_off("incline", base, UP, calculated_setting(partial(_incline, guide, direction), s))
        across = hand.join("line of R", origin, incline)
    corner = third_corner(hand, foot, normal, across, foot.points.imag < 0)
    hand.join("F", foot, corner)
    hand.join("R", corner, origin)
    beside = [calculated_setting(np.abs, distance_between(origin, corner, way)) for way in (RIGHT, UP)]
    contact = distance_between(foot, origin, UP), distance_between(foot, corner), distance_between(foot, corner, UP)
    for name, length in zip(MEANING.readings, [*contact, *beside, distance_between(origin, corner)], strict=True):
        hand.read(name, length, mu.per_mm)
    directions = {"contact_normal": normal.directions, "across": across.directions}
    givens, points = ForcePlanGivens(measured, load, guide, k, mu), {"foot": foot, "corner": corner}
    return hand.finished(givens, _draw, {**points, **directions})


def load_laid_off(
    hand: Hand, measured: MeasuredAngles, load: SpringLoad, k: int, mu_force: Scale | None
) -> tuple[Scale, Drawn, Setting]:
    """The load of a stem, laid off straight down from its tail: its scale, its head, and the turn to the normal.

    mu_force : N/mm; None for a round one
    """
    phi = float(measured.givens.integrated.givens.stations.phi[k])
    s, v, a = station_settings(hand, measured, k, "s", "v", "a")
    force = calculated_setting(partial(force_at, load, direction_at(measured, k), phi), s, v, a)
    mu = mu_force or round_scale(float(np.median(np.abs(force.amount))))
    alpha = station_setting(hand, measured.readings["alpha"], k)
    length = calculated_setting(partial(np.multiply, 1 / mu.per_mm), force)
    # A turn by alpha in the sense of the rotation: against it the cam pushes the stem along.
    turn = calculated_setting(partial(np.multiply, sense(measured.givens.rotation)), alpha)
    return mu, hand.lay_off("foot", hand.given("origin"), -UP, length), turn


def station_setting(hand: Hand, reading: Reading, k: int) -> Setting:
    """The machine value of a reading at one station, as a setting."""
    return calculated_setting(itemgetter((..., k)), hand.carry(reading, np.asarray(reading.scale)))


def station_settings(hand: Hand, measured: Construction, k: int, *names: str) -> list[Setting]:
    """The machine values at one station of displacement and derivatives, by their names."""
    return [station_setting(hand, measured.givens.integrated.readings[name], k) for name in names]


def direction_at(measured: Construction, k: int) -> int:
    """The direction of the lift at a station: 1 on a rise, -1 on a return."""
    integrated = measured.givens.integrated.givens
    return integrated.motion.phases[integrated.stations.phase[k]].direction


def third_corner(hand: Hand, foot: Drawn, line: Drawn, across: Drawn, presses: NDArray[np.bool_]) -> Drawn:
    """The meeting of the contact force's line from the foot with the reaction's; NaN where no force can push so.

    presses : whether the load does; beyond the jamming angle the lines meet on the other side of the foot
    """
    meeting = hand.cross("meeting", line, across)
    pushes = presses & (dot(meeting.points - foot.points, line.directions) > 0)
    return hand.take("corner", meeting, hand.given("nowhere", NOWHERE), which=np.where(pushes, 0, 1)[..., None])[0]


def force_at(load: SpringLoad, direction: int, phi: Floats | float, s: Floats, v: Floats, a: Floats) -> Floats:
    """The load [N] at a cam angle, from the displacement and its derivatives."""
    return load.force((s, v, a, np.zeros_like(s)), direction, phi)


def _incline(guide: Guide, direction: int, s: Floats) -> Floats:
    """The part mu (l + 2 b)/l of the base: what the bearings hold back, with the roller s mm up."""
    return direction * BASE * guide.friction * (guide.length + 2 * (guide.overhang - s)) / guide.length


def plan_station(measured: MeasuredAngles, load: SpringLoad) -> int:
    """The station of the velocity plan, where the pressure angle on the rises is greatest.

    With the least preload hardly any load may be left just there: then the station on the rises where it is greatest.
    """
    integrated = measured.givens.integrated
    s, v, a = (integrated.value(name) for name in "sva")
    return pressed_station(measured, force_at(load, 1, integrated.givens.stations.phi, s, v, a))


def pressed_station(measured: MeasuredAngles, force: Floats) -> int:
    """The station of the velocity plan, or that of the greatest force [N] on the rises if hardly any is left there."""
    force, k = np.where(moving_up(measured), force, 0.0), shown_station(measured)
    return k if abs(force[k]) >= MIN_LOAD_SHARE * np.max(force) else int(np.argmax(force))


def round_scale(load: float) -> Scale:
    """The largest round scale of forces at which a load [N] is not longer than :data:`LOAD_LENGTH`.

    >>> round_scale(160).per_mm
    5.0
    """
    return Scale(round_up(max(load, 1e-6) / LOAD_LENGTH, ROUND_NUMBERS)[0], "N")


# --- the steps -------------------------------------------------------------------------------------------------------

LINE_OVERHANG = 8.0
"""How far a line runs on beyond its corner [mm]."""
READABLE_FORCE = 0.05
"""Forces of less are not told [N]: they are nothing."""


def _draw(plan: Construction[ForcePlanGivens]) -> list[Step]:
    return plan_steps(plan, load_step, _line_of_force, reaction_step, jammed_step, _triangle_step)


def plan_steps(plan: Construction, *draws: Callable[[Any, View], Step]) -> list[Step]:
    """The steps of a plan in their view, the last but one where the triangle does not close, else the last."""
    view = replace(FORCES, title=say("Force plan, μ_F = {mu:g} N/mm", mu=plan.givens.mu_force.per_mm))
    *first, not_closed, closed = draws
    last = not_closed if math.isnan(float(plan.first("normal"))) else closed
    return [draw(plan, view) for draw in (*first, last)]


def side_of(plan: Construction[ForcePlanGivens]) -> float:
    """The side of the load on which the triangle lies: -1 for the left, 1 for the right."""
    return -1.0 if plan.acts["line of F"].first.directions.real < 0 else 1.0


def towards(side: float) -> Caption:
    """The word for a side: the left below zero."""
    return say("to the left") if side < 0 else say("to the right")


def _values(plan: Construction[ForcePlanGivens], *names: str) -> list[float]:
    integrated = plan.givens.measured.givens.integrated
    return [float(integrated.value(name)[plan.givens.station]) for name in names]


def alpha_at(plan: Construction) -> float:
    """The drawn pressure angle at the station [degrees]."""
    return math.degrees(plan.givens.measured.first("alpha")[plan.givens.station])


def _terms(plan: Construction[ForcePlanGivens]) -> list[tuple[Caption, float]]:
    """The terms that make up the load [N], each with its name."""
    load, values = plan.givens.load, [np.array(value) for value in _values(plan, "s", "v", "a")]
    none = replace(load, mass=0.0, stiffness=0.0, preload=0.0, friction=0.0, load=0.0, damping=0.0)
    alone = (
        (say("inertia {force:.1f} N"), replace(none, mass=load.mass)),
        (say("preload {force:.1f} N"), replace(none, preload=load.preload)),
        (say("spring {force:.1f} N"), replace(none, stiffness=load.stiffness)),
        (say("friction {force:.1f} N"), replace(none, friction=load.friction)),
        (say("damping {force:.1f} N"), replace(none, damping=load.damping)),
        (say("load P {force:.1f} N"), replace(none, load=load.load)),
    )
    k = plan.givens.station
    phi = float(plan.givens.measured.givens.integrated.givens.stations.phi[k])
    return [(said, float(force_at(part, direction_at(plan.givens.measured, k), phi, *values))) for said, part in alone]


def load_step(plan: Construction[ForcePlanGivens], view: View) -> Step:
    """The step that lays the load off, straight down from its tail."""
    name, mu = station_name(plan), plan.givens.mu_force.per_mm
    terms, (s, a) = _terms(plan), _values(plan, "s", "a")
    load = sum(force for _, force in terms)
    told = sequence([said.with_values(force=force) for said, force in terms if abs(force) >= READABLE_FORCE])
    said = say(
        "At station {name} the drawn s = {s:.2f} mm and a = {a:.2f} mm/rad² give the load Q = {load:.1f} N: {terms}. "
        "At μ_F = {mu:g} N/mm set the dividers to {size:.1f}/{mu:g} = {paper:.1f} mm, and lay Q off from its tail "
        "straight {way}."
    ).with_values(name=name, s=s, a=a, load=load, terms=told, mu=mu, size=abs(load), paper=abs(load) / mu)
    said = said.with_values(way=say("down") if load > 0 else say("up"))
    why = say("Inertia, spring and preload act along the motion: this force is known in magnitude and direction.")
    return load_arrow_step(plan, view, said, -side_of(plan) + 0j, why)


def station_name(plan: Construction) -> str:
    """The name of the station for which a plan is drawn."""
    return station_names(plan.givens.measured.givens.integrated.givens.stations)[plan.givens.station]


def load_arrow_step(plan: Construction, view: View, said: Caption, beside: complex, why: Caption) -> Step:
    """The step that draws the load as an arrow from its tail, with its name on the side ``beside``."""
    foot = plan.acts["foot"].first
    marks = (
        foot.arrow(0j, Role.CURVE),
        Label(foot.place / 2, "Q", towards=beside).left_by(foot),
        Dots(np.array([0j, foot.place])).left_by(foot),
    )
    title = say("Force plan at station {name}: the load", name=station_name(plan))
    return Step(title, (Part(said, (foot,)),), view, marks, ("load",), why=why)


def line_length(length: float) -> float:
    """The length at which a line is drawn that ends after ``length`` [mm]; NaN where it meets nothing."""
    return 2 * LOAD_LENGTH if math.isnan(length) else length + LINE_OVERHANG


def leaning_line(line: Drawn, reach: float, alpha: float, up: complex = UP) -> tuple[Mark, ...]:
    """A line through the head of the load, and the angle [degrees] that it makes with ``up`` there, as marks."""
    radius, foot, way = 0.4 * min(reach, LOAD_LENGTH), line.place, complex(unit_along(line.directions))
    start, named = cmath.phase(up), say("α = {alpha:.1f}°", alpha=alpha)
    return (
        Line(np.array([foot, foot + reach * way]), Role.CONSTRUCTION).left_by(line),
        Line(np.array([foot, foot + (radius + LINE_OVERHANG) * up]), Role.AXIS),
        angle_at(foot, start, start + cmath.phase(way / up), radius, named, line.act),
    )


def _line_of_force(plan: Construction[ForcePlanGivens], view: View) -> Step:
    normal, alpha = plan.acts["line of F"].first, alpha_at(plan)
    said = say(
        "At the head of Q set the protractor to α = {alpha:.2f}° from the vertical {side}, and draw the line of "
        "the contact force F there, parallel to the contact normal of this station."
    ).with_values(alpha=abs(alpha), side=towards(side_of(plan)))
    marks = leaning_line(normal, line_length(float(plan.first("normal"))), alpha)
    why = say("The cam pushes along the contact normal, which makes the pressure angle with the motion.")
    return Step(say("The line of the contact force"), (Part(said, (normal,)),), view, marks, why=why)


def reaction_step(plan: Construction[ForcePlanGivens], view: View) -> Step:
    """The step that draws the line of the reaction through the tail of the load."""
    line, guide, side = plan.acts["line of R"].first, plan.givens.guide, side_of(plan)
    title, end = say("The line of the guide's reaction"), BASE * side + 0j
    if guide is not None:
        end = plan.acts["incline"].first.place
    across = Line(line.place + end * np.array([-0.3, 1.0]), Role.CONSTRUCTION).left_by(line)
    if guide is None or not guide.friction:
        said = say(
            "With the T-square draw the horizontal line through the tail of Q: on it lies the reaction R of the guide."
        )
        why = say("A guide without friction can push only square to the motion.")
        return Step(title, (Part(said, (line,)),), view, (across,), why=why)
    base, incline, (s,) = plan.acts["base"].first, plan.acts["incline"].first, _values(plan, "s")
    height = float(_incline(guide, direction_at(plan.givens.measured, plan.givens.station), np.array(s)))
    values = {"base": BASE, "side": towards(side), "mu": guide.friction, "length": guide.length, "height": abs(height)}
    values |= {"overhang": guide.overhang - s, "way": say("up") if height > 0 else say("down")}
    laid = say("With the dividers lay off {base:g} mm from the tail of Q horizontally {side}, for l = {length:g} mm.")
    inclined = say(
        "From there lay off {base:g} · f₂(l + 2b)/l = {base:g} · {mu:g} · ({length:g} + 2 · "
        "{overhang:.2f})/{length:g} = {height:.2f} mm straight {way}."
    )
    join = say("Join the tail of Q to this point with the ruler: on this line lies the reaction R of the guide.")
    parts = move_parts([(laid, base), (inclined, incline), (join, line)], values)
    marks = (across, base.line_from(0j, Role.CONSTRUCTION), incline.line_from(base, Role.CONSTRUCTION))
    why = say(
        "The nearer bearing carries (l + b)/l of the side force and the farther one b/l, so friction is f₂(l + 2b)/l "
        "of it and acts against the motion."
    )
    return Step(title, parts, view, marks, why=why)


def open_triangle_step(view: View, said: Caption) -> Step:
    """The last step where there is no third corner, with what that means."""
    why = say("A cam can only push: F must point from the head of Q towards the crossing.")
    return Step(say("The triangle does not close"), (Part(said),), view, (), why=why)


def jammed_step(plan: Construction[ForcePlanGivens], view: View) -> Step:
    """The last step where the guide jams, so that there is no third corner."""
    said = say(
        "The two lines do not meet where the cam could push: at this pressure angle the follower jams in its "
        "guide, or the load does not press it onto the cam."
    )
    return open_triangle_step(view, said)


CORNER_CAPTION = say("Mark where the two lines cross: the third corner.")
UP_TO_CORNER = say("F runs from the head of Q up to this corner: {normal_mm:.1f} mm × {mu:g} = {normal:.1f} N.")
REACTION_CAPTION = say(
    "R runs from the corner back to the tail of Q: {reaction_mm:.1f} mm × {mu:g} = {reaction:.1f} N."
)


def triangle_step(
    plan: Construction, view: View, moves: Sequence[Move], marks: tuple[Mark, ...], *last: Caption
) -> Step:
    """The step of the closed triangle of forces, with what is measured on it.

    moves, last : what is done, and what is said at the end; with the readings in their places, on paper ``{name_mm}``
    marks : besides the two forces that are found
    """
    foot, corner, force, reaction = (plan.acts[name].first for name in ("foot", "corner", "F", "R"))
    corner = corner[0]
    arrows = Arrow(foot.place, corner.place, Role.RESULT), Arrow(corner.place, 0j, Role.RESULT)
    marks = arrows[0].left_by(force), arrows[1].left_by(reaction), *marks
    values = {name: float(plan.value(name)) for name in plan.readings} | {"mu": plan.givens.mu_force.per_mm}
    values |= {f"{name}_mm": float(plan.first(name)) for name in plan.readings}
    reads, why = tuple(plan.readings)[1:], say("Forces in equilibrium, drawn head to tail, form a closed polygon.")
    parts = move_parts(moves, values, last=last)
    return Step(say("The triangle of forces"), parts, view, marks, reads, why=why)


def _triangle_step(plan: Construction[ForcePlanGivens], view: View) -> Step:
    foot, corner, force, reaction = (plan.acts[name].first for name in ("foot", "corner", "F", "R"))
    corner, shown, side = corner[0], errorless_hand(plan), side_of(plan)
    level = shown.project("level", corner, shown.given("line of Q", 0j, UP))
    sides = say(
        "With the T-square carry the corner horizontally to the line of Q. Along the motion F cos α measures "
        "{along_mm:.1f} mm × {mu:g} = {along:.1f} N, and across it F sin α {side_mm:.1f} mm × {mu:g} = {side:.1f} N."
    )
    friction = say("The friction in the guide is {friction_mm:.1f} mm × {mu:g} = {friction:.1f} N.")
    borne = (friction,) if float(plan.value("friction")) >= READABLE_FORCE else ()
    marks: tuple[Mark, ...] = (
        *(level.line_from(corner, Role.CONSTRUCTION), corner.dots()),
        Label((foot.place + corner.place) / 2, "F", towards=side - 0.5j).left_by(force),
        Label(corner.place / 2, "R", towards=UP).left_by(reaction),
    )
    moves = [(CORNER_CAPTION, corner), (UP_TO_CORNER, force), (REACTION_CAPTION, reaction), (sides, level)]
    return triangle_step(plan, view, moves, marks, *borne)
