"""The force plan of a translating follower with friction at the cam: the contact force leans from the normal.

Where the cam slides past the follower it drags it along the profile, in its own sense, with mu times the normal force.
Both together are the contact force F, which leans from the contact normal by the angle whose tangent is mu, so the
triangle of load, contact force and reaction is drawn as without friction, with the line of F turned by that angle.  The
square from its third corner to the normal parts F into the normal force N and the friction T = mu N.

Source: the equilibrium of a follower with friction at the cam, I. Voloder, M. Cohodar, S. Karic, *Annals of DAAAM*
(2007): N (cos alpha - mu sin alpha) is the load.
"""

import math
from dataclasses import dataclass

import numpy as np

from graphcam.constructions import force_plan as plain
from graphcam.constructions.force_plan import (
    BASE,
    LINE_OVERHANG,
    LOAD_LENGTH,
    jammed_step,
    load_step,
    reaction_step,
    towards,
)
from graphcam.constructions.pressure_angle import MeasuredAngles
from graphcam.drafting.euclid import RIGHT, UP
from graphcam.drafting.hand import Hand, calculated_setting, distance_between, errorless_hand
from graphcam.drafting.ink import Construction, Part, Step, View, say
from graphcam.drafting.marks import Arrow, Label, Line, Mark, Role
from graphcam.drafting.meaning import ALPHA, Formula, Meaning, ReadingMeaning, Symbol, Values
from graphcam.drafting.pencil import Pencil
from graphcam.drafting.scale import Scale, unit
from graphcam.drafting.telling import move_parts
from graphcam.given.follower import sense
from graphcam.given.spring_load import SpringLoad


@dataclass(frozen=True, eq=False)
class FrictionPlanGivens(plain.ForcePlanGivens):
    """What lies on the board; see :func:`friction_plan`.

    mu : the coefficient of friction between cam and follower, f₁
    """

    mu: float


def _in_equilibrium(plan: Construction[FrictionPlanGivens]) -> Values:
    """The formula's values, where the triangle closes: load, pressure angle, friction and forces at the station."""
    load, alpha, mu = float(plan.value("load")), math.radians(plain.alpha_at(plan)), plan.givens.mu
    if not math.isnan(float(plan.first("normal"))):
        normal = load / (math.cos(alpha) - mu * math.sin(alpha))
        forces = {"load": load, "normal": normal, "contact_friction": mu * normal}
        yield {**forces, "alpha": math.degrees(alpha), "mu": mu, "N": unit("N")}


FORMULAS = (
    Formula(
        r"N = \frac{Q}{\cos\alpha - f_1\sin\alpha}, \qquad T = f_1 N",
        r"N = \frac{<load:.1f>}{\cos(<alpha:.2f>^\circ) - <mu:g>\sin(<alpha:.2f>^\circ)} = <normal:.1f>\ \text{<N>}, "
        r"\qquad T = <mu:g> \cdot <normal:.1f> = <contact_friction:.1f>\ \text{<N>}",
        _in_equilibrium,
        (
            Symbol("N", say("the normal force"), "N"),
            Symbol("Q", say("the load on the follower"), "N"),
            ALPHA,
            Symbol("f_1", say("the coefficient of friction between cam and follower")),
            Symbol("T", say("the friction at the cam"), "N"),
        ),
        of="normal",
    ),
)


MEANING = Meaning(
    "force_plan",
    plain.MEANING.title,
    say(
        "Load, contact force and the reaction of the guide are in equilibrium. With friction the contact force "
        "is inclined to the normal. Three directions and one magnitude are known, which determine a triangle."
    ),
    {
        "load": plain.MEANING.readings["load"],
        "contact": ReadingMeaning(say("contact force F"), "F", "N"),
        "normal": ReadingMeaning(say("normal force N"), "N", "N"),
        "contact_friction": ReadingMeaning(say("friction at the cam T"), "T", "N"),
        "along": ReadingMeaning(say("N cos α"), "N cos α", "N"),
        "side": ReadingMeaning(say("N sin α"), "N sin α", "N"),
        "reaction": plain.MEANING.readings["reaction"],
    },
    FORMULAS,
)


def friction_plan(
    measured: MeasuredAngles,
    load: SpringLoad,
    pencil: Pencil,
    friction: float,
    station: int | None = None,
    mu_force: Scale | None = None,
) -> Construction[FrictionPlanGivens]:
    """Draw the force plan with friction at the cam at a station; the guide is without friction.

    friction : mu between cam and follower, greater than 0
    station : None for the one of :func:`~graphcam.constructions.force_plan.plan_station`
    mu_force : scale of forces [N/mm]; None for a round one

    Readings are NaN where the load does not press, or the follower jams.
    """
    hand, k = Hand(pencil, MEANING), plain.plan_station(measured, load) if station is None else station
    mu, foot, turn = plain.load_laid_off(hand, measured, load, k, mu_force)
    origin, sigma = hand.acts["origin"], sense(measured.givens.rotation)
    normal = hand.protractor("normal", foot, UP, turn)
    # The cam drags the follower in its own sense: the line of F is turned on from the normal in that sense.
    base = hand.lay_off("base", normal, normal, BASE)
    incline = hand.lay_off("incline", base, normal.turned(sigma * UP), BASE * friction)
    line = hand.join("line of F", foot, incline)
    across = hand.erect("line of R", origin, RIGHT)
    corner = plain.third_corner(hand, foot, line, across, foot.points.imag < 0)
    hand.join("F", foot, corner)
    hand.join("R", corner, origin)
    tip = hand.cross("tip of N", normal, hand.perpendicular("square", normal, corner))
    hand.join("N", foot, tip)
    hand.join("T", tip, corner)
    lengths = {
        "load": distance_between(foot, origin, UP),
        "contact": distance_between(foot, corner),
        "normal": distance_between(foot, tip),
        "contact_friction": distance_between(tip, corner),
        "along": distance_between(foot, tip, UP),
        "side": calculated_setting(np.abs, distance_between(foot, tip, RIGHT)),
        "reaction": distance_between(origin, corner),
    }
    for name, length in lengths.items():
        hand.read(name, length, mu.per_mm)
    givens = FrictionPlanGivens(measured, load, None, k, mu, friction)
    points = {"foot": foot, "corner": corner, "tip": tip, "contact_normal": normal.directions}
    return hand.finished(givens, _draw, {**points, "across": across.directions})


# --- the steps -------------------------------------------------------------------------------------------------------


def _draw(plan: Construction[FrictionPlanGivens]) -> list[Step]:
    return plain.plan_steps(plan, load_step, _normal, _line_of_force, reaction_step, jammed_step, _triangle_step)


def _normal(plan: Construction[FrictionPlanGivens], view: View) -> Step:
    normal, length, alpha = plan.acts["normal"].first, float(plan.first("normal")), plain.alpha_at(plan)
    said = say(
        "At the head of Q set the protractor to α = {alpha:.2f}° from the vertical {side}, and draw the contact "
        "normal of this station there."
    ).with_values(alpha=abs(alpha), side=towards(-1.0 if normal.directions.real < 0 else 1.0))
    reach = max(BASE, 2 * LOAD_LENGTH if math.isnan(length) else length) + LINE_OVERHANG
    why = say("Without friction the cam would push along the contact normal.")
    return Step(
        say("The contact normal"), (Part(said, (normal,)),), view, plain.leaning_line(normal, reach, alpha), why=why
    )


def _line_of_force(plan: Construction[FrictionPlanGivens], view: View) -> Step:
    base, incline, line = (plan.acts[name].first for name in ("base", "incline", "line of F"))
    sigma, mu, length = sense(plan.givens.measured.givens.rotation), plan.givens.mu, float(plan.first("contact"))
    values = {"base": BASE, "mu": mu, "height": BASE * mu, "side": towards(-float(sigma))}
    laid = say("With the dividers lay off {base:g} mm on the normal from the head of Q.")
    inclined = say(
        "From there lay off {base:g} · f₁ = {base:g} · {mu:g} = {height:.2f} mm square to the normal, {side}."
    )
    join = say("Join the head of Q to this point with the ruler: on this line lies the contact force F.")
    parts = move_parts([(laid, base), (inclined, incline), (join, line)], values)
    along = complex(line.directions) / abs(complex(line.directions))
    reach = max(abs(complex(line.directions)), 2 * LOAD_LENGTH if math.isnan(length) else length) + LINE_OVERHANG
    run = Line(np.array([line.place, line.place + reach * along]), Role.CONSTRUCTION).left_by(line)
    marks = (run, incline.line_from(base, Role.CONSTRUCTION), base.dots(Role.CONSTRUCTION))
    why = say(
        "The cam slides past the follower in its own sense and drags it along the profile with f₁N, so F makes the "
        "friction angle, whose tangent is f₁, with the normal."
    )
    return Step(say("The line of the contact force"), parts, view, marks, why=why)


def _triangle_step(plan: Construction[FrictionPlanGivens], view: View) -> Step:
    names = ("foot", "corner", "F", "R", "square", "tip of N", "N", "T")
    foot, corner, force, reaction, square, tip, normal, friction = (plan.acts[name].first for name in names)
    corner, shown, side = corner[0], errorless_hand(plan), plain.side_of(plan)
    level = shown.project("level", tip, shown.given("line of Q", 0j, UP))
    meet = say("Mark where the line of F meets that of R: the third corner.")
    up = say("F runs from the head of Q up to this corner: {contact_mm:.1f} mm × {mu:g} = {contact:.1f} N.")
    parted = say(
        "From the corner draw the perpendicular to the normal with the set squares. It cuts off on the normal the "
        "normal force N = {normal_mm:.1f} mm × {mu:g} = {normal:.1f} N, and it is itself the friction T = "
        "{contact_friction_mm:.1f} mm × {mu:g} = {contact_friction:.1f} N."
    )
    sides = say(
        "With the T-square carry the tip of N horizontally to the line of Q. Along the motion N cos α measures "
        "{along_mm:.1f} mm × {mu:g} = {along:.1f} N, and across it N sin α {side_mm:.1f} mm × {mu:g} = {side:.1f} N."
    )
    marks: tuple[Mark, ...] = (
        Arrow(foot.place, tip.place, Role.CURVE).left_by(normal),
        Arrow(tip.place, corner.place, Role.CURVE).left_by(friction),
        *(level.line_from(tip, Role.CONSTRUCTION), corner.dots(), tip.dots()),
        Label((foot.place + corner.place) / 2, "F", towards=side - 0.5j).left_by(force),
        Label(corner.place / 2, "R", towards=UP).left_by(reaction),
        Label((foot.place + tip.place) / 2, "N", towards=-side + 0j).left_by(normal),
        Label((tip.place + corner.place) / 2, "T", towards=UP).left_by(friction),
    )
    found = [(meet, corner), (up, force), (plain.REACTION_CAPTION, reaction)]
    return plain.triangle_step(plan, view, [*found, (parted, square, tip, normal, friction), (sides, level)], marks)
