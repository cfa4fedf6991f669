"""The force plan of a translating follower at a station: load, contact force and the guide's reaction close a triangle.

The three forces on the follower are in equilibrium, so their arrows close.  The load Q is known in size and direction;
of the contact force F the direction is known from the drawn pressure angle; of the reaction R of the guide it is known
too: across the motion, or, with friction in the bearings, inclined against the motion by the angle whose tangent is
mu (l + 2 b)/l.  The lines of F and R through the ends of Q meet in the third corner.

Source: the equilibrium of a follower in two bearings, H. A. Rothbart, *Cam Design Handbook* (2004), chapter 6.
"""

import cmath
import math
from dataclasses import dataclass, replace
from functools import partial
from operator import itemgetter

import numpy as np

from graphcam.constructions.axes import station_names
from graphcam.constructions.pressure_angle import MeasuredAngles, angle_at, moving_up, shown_station
from graphcam.constructions.views import FORCES
from graphcam.drafting.acts import Drawn
from graphcam.drafting.euclid import NOWHERE, RIGHT, UP
from graphcam.drafting.hand import Hand, between, reckoned, showing
from graphcam.drafting.ink import Caption, Construction, Step, say
from graphcam.drafting.marks import Arrow, Dots, Label, Line, Mark, Role
from graphcam.drafting.meaning import Meaning, ReadingMeaning
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.spring_load import Guide, SpringLoad
from graphcam.plane import dot

LOAD_LENGTH = 50.0
"""The load is drawn at the largest round scale at which its arrow is not longer [mm]."""
BASE = 30.0
"""The length of the bearings is drawn as this, to find the inclination of the reaction [mm]."""
LEAST_LOAD = 0.1
"""Of the greatest load on the rises: under less the triangle would show nothing but the errors of the drawn a and s."""
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


MEANING = Meaning(
    "force_plan",
    say("Force plan"),
    say(
        "Load, contact force and the reaction of the guide are in balance. Three directions and one size are known: "
        "a triangle."
    ),
    {
        "load": ReadingMeaning(say("load Q"), "Q", "N"),
        "normal": ReadingMeaning(say("contact force F"), "F", "N"),
        "along": ReadingMeaning(say("F cos α"), "F cos α", "N"),
        "side": ReadingMeaning(say("F sin α"), "F sin α", "N"),
        "friction": ReadingMeaning(say("friction in the guide"), "T", "N"),
        "reaction": ReadingMeaning(say("reaction R"), "R", "N"),
    },
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
    integrated, sigma = measured.givens.integrated, sense(measured.givens.rotation)
    direction = integrated.givens.motion.phases[integrated.givens.stations.phase[k]].direction
    read = (*(integrated.readings[name] for name in ("s", "v", "a")), measured.readings["alpha"])
    s, v, a, alpha = (reckoned(itemgetter((..., k)), hand.carry(each, np.asarray(each.scale))) for each in read)
    force = reckoned(partial(_force, load, direction), s, v, a)
    mu = mu_force or round_scale(float(np.median(np.abs(force.amount))))

    origin = hand.given("origin")
    foot = hand.lay_off("foot", origin, -UP, reckoned(partial(np.multiply, 1 / mu.per_mm), force))
    # A turn by alpha in the sense of the rotation: against it the cam pushes the stem along.
    turn = reckoned(partial(np.multiply, sigma), alpha)
    normal = hand.protractor("line of F", foot, UP, turn)
    if guide is None:
        across = hand.erect("line of R", origin, RIGHT)
    else:
        base = hand.lay_off("base", origin, -RIGHT, reckoned(partial(np.copysign, BASE), turn))
        incline = hand.lay_off("incline", base, UP, reckoned(partial(_incline, guide, direction), s))
        across = hand.join("line of R", origin, incline)
    # Beyond the jamming angle the lines meet on the other side, where no force can push.
    meeting = hand.cross("meeting", normal, across)
    pushes = (foot.points.imag < 0) & (dot(meeting.points - foot.points, normal.directions) > 0)
    found = hand.take("corner", meeting, hand.given("nowhere", NOWHERE), which=np.where(pushes, 0, 1)[..., None])
    corner = found[0]
    hand.join("F", foot, corner)
    hand.join("R", corner, origin)
    beside = [reckoned(np.abs, between(origin, corner, way)) for way in (RIGHT, UP)]
    contact = between(foot, origin, UP), between(foot, corner), between(foot, corner, UP)
    for name, length in zip(MEANING.readings, [*contact, *beside, between(origin, corner)], strict=True):
        hand.read(name, length, mu.per_mm)
    directions = {"contact_normal": normal.directions, "across": across.directions}
    givens, points = ForcePlanGivens(measured, load, guide, k, mu), {"foot": foot, "corner": corner}
    return hand.finished(givens, _draw, {**points, **directions})


def _force(load: SpringLoad, direction: int, s: Floats, v: Floats, a: Floats) -> Floats:
    """The load [N], from the displacement and its derivatives."""
    return load.force((s, v, a, np.zeros_like(s)), direction)


def _incline(guide: Guide, direction: int, s: Floats) -> Floats:
    """Over the base the part mu (l + 2 b)/l of it: what the bearings hold back, with the roller s mm up."""
    return direction * BASE * guide.friction * (guide.length + 2 * (guide.overhang - s)) / guide.length


def plan_station(measured: MeasuredAngles, load: SpringLoad) -> int:
    """The station of the velocity plan, where the pressure angle on the rises is greatest.

    With the least preload hardly any load may be left just there: then the station on the rises where it is greatest.
    """
    integrated = measured.givens.integrated
    s, v, a = (integrated.value(name) for name in ("s", "v", "a"))
    force = np.where(moving_up(measured), _force(load, 1, s, v, a), 0.0)
    k = shown_station(measured)
    return k if abs(force[k]) >= LEAST_LOAD * np.max(force) else int(np.argmax(force))


def round_scale(load: float) -> Scale:
    """The largest round scale of forces at which a load [N] is not longer than :data:`LOAD_LENGTH`.

    >>> round_scale(160).per_mm
    5.0
    """
    least = max(load, 1e-6) / LOAD_LENGTH
    power = 10.0 ** math.floor(math.log10(least))
    return Scale(next(n for n in ROUND_NUMBERS if n * power >= least) * power, "N")


# --- the steps -------------------------------------------------------------------------------------------------------

BEYOND = 8.0
"""How far a line runs on beyond its corner [mm]."""


def _draw(plan: Construction[ForcePlanGivens]) -> list[Step]:
    k, guide, mu = plan.givens.station, plan.givens.guide, plan.givens.mu_force.per_mm
    measured, acts = plan.givens.measured, plan.acts
    name = station_names(measured.givens.integrated.givens.stations)[k]
    foot, corner, normal = acts["foot"], acts["corner"].first[0], acts["line of F"].first
    side = -1.0 if normal.directions.real < 0 else 1.0
    alpha, length = float(measured.first("alpha")[k]), float(plan.first("normal"))
    forces = {key: float(plan.value(key)) for key in plan.readings}
    view = replace(FORCES, title=say("Force plan, μF = {mu:g} N/mm", mu=mu))
    loaded = say(
        "At station {name} inertia, spring and preload hold the follower down with Q = {load:.1f} N, found from the "
        "drawn a and s. At μF = {mu:g} N/mm its arrow is {paper:.1f} mm long, against the motion."
    ).where(name=name, load=forces["load"], mu=mu, paper=float(plan.first("load")))
    tail_and_head = Dots(np.array([0j, foot.place]), of=foot.act)
    load = (foot.arrow(0j, Role.CURVE), Label(foot.place / 2, "Q", towards=-side + 0j, of=foot.act), tail_and_head)
    parallel = say(
        "Through the head of Q the line of the contact force is drawn parallel to the contact normal, at the measured "
        "pressure angle of {alpha:.2f}° with the motion."
    ).where(alpha=math.degrees(alpha))
    steps = [
        Step(say("Force plan at station {name}: the load", name=name), loaded, view, load, reads=("load",)),
        Step(say("The line of the contact force"), parallel, view, _normal_line(normal, length, alpha)),
        Step(say("The line of the guide's reaction"), _reaction_caption(guide), view, _reaction_line(plan, side)),
    ]
    if math.isnan(length):
        unreadable = say(
            "The two lines do not meet where the cam could push: at this pressure angle the follower jams in its "
            "guide, or the load does not press it on the cam."
        )
        return [*steps, Step(say("The triangle does not close"), unreadable, view, ())]
    closing = say(
        "The lines meet in the third corner. The contact force is F = {f_mm:.1f} mm · {mu:g} = {f:.1f} N; along the "
        "motion it gives F cos α = {along:.1f} N, across it F sin α = {side:.1f} N, which the guide bears with the "
        "friction of {friction:.1f} N."
    ).where(f_mm=length, mu=mu, f=forces["normal"], **forces)
    shown = showing(plan)
    level = shown.project("level", corner, shown.given("line of Q", 0j, UP))
    marks: tuple[Mark, ...] = (
        Arrow(foot.place, corner.place, Role.RESULT, of=acts["F"].act),
        Arrow(corner.place, 0j, Role.RESULT, of=acts["R"].act),
        *(level.line_from(corner, Role.CONSTRUCTION), corner.dots()),
        Label((foot.place + corner.place) / 2, "F", towards=side - 0.5j, of=acts["F"].act),
        Label(corner.place / 2, "R", towards=UP, of=acts["R"].act),
    )
    return [*steps, Step(say("The triangle of forces"), closing, view, marks, reads=tuple(MEANING.readings)[1:])]


def _normal_line(normal: Drawn, length: float, alpha: float) -> tuple[Mark, ...]:
    reach = 2 * LOAD_LENGTH if math.isnan(length) else length + BEYOND
    radius, foot, direction = 0.4 * min(reach, LOAD_LENGTH), normal.place, complex(normal.directions)
    said = say("α = {alpha:.1f}°", alpha=math.degrees(alpha))
    return (
        Line(np.array([foot, foot + reach * direction]), Role.CONSTRUCTION, of=normal.act),
        Line(np.array([foot, foot + (radius + BEYOND) * UP]), Role.AXIS),
        angle_at(foot, math.pi / 2, cmath.phase(direction), radius, said, normal.act),
    )


def _reaction_caption(guide: Guide | None) -> Caption:
    if guide is None:
        return say("Without friction the guide only pushes across the motion: its line is drawn through the tail of Q.")
    return say(
        "The nearer bearing bears (l + b)/l of the side force and the farther one b/l, so friction is μ(l + 2b)/l of "
        "it. With l laid off across the motion and μ(l + 2b) along it, μ = {mu:g}, l = {length:g} mm, the slope of "
        "the reaction through the tail of Q is found."
    ).where(mu=guide.friction, length=guide.length)


def _reaction_line(plan: Construction[ForcePlanGivens], side: float) -> tuple[Mark, ...]:
    line, end, laid_off = plan.acts["line of R"], complex(BASE * side), list[Mark]()
    if plan.givens.guide is not None:
        base, incline = plan.acts["base"], plan.acts["incline"]
        end = incline.place
        if plan.givens.guide.friction:
            laid_off = [base.line_from(0j, Role.CONSTRUCTION), incline.line_from(base, Role.CONSTRUCTION)]
    return (Line(line.place + end * np.array([-0.3, 1.0]), Role.CONSTRUCTION, of=line.act), *laid_off)
