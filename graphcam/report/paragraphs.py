"""The note's paragraphs on what several followers have in common: the formula, the numbers put in, the result."""

import math
from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from graphcam.constructions.acceleration import equal_parts, moving_phases
from graphcam.constructions.angle_diagram import inside
from graphcam.constructions.axes import degrees, phase_title, station_names
from graphcam.constructions.law_names import law_title
from graphcam.drafting.ink import Construction
from graphcam.drafting.scale import ratio_text
from graphcam.drafting.units import unit
from graphcam.given.motion import FULL_TURN, Moving
from graphcam.report.markdown import blocks, formula, number, numbers, table
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Words, joined, say, sequence

FINEST_READING = 0.01
"""What is told of a length on paper [mm]."""
LAST_DIGIT = 0.005
"""Lengths [mm] and angles [degrees] are told to two decimals; what differs by less does not differ in print."""


def digits(per_mm: float) -> int:
    """As many decimals as the finest reading on paper has in the machine.

    >>> digits(0.48), digits(2.0), digits(500.0)
    (3, 2, 0)
    """
    return max(0, math.ceil(-math.log10(FINEST_READING * per_mm)))


STROKES = say("The appendix tells under the same title how it is drawn.")
"""Where a paragraph calculates what the steps draw."""


def polar_point(solution: Solution, station: int, name: Words, worked: Words) -> Caption:
    """The polar radius at a station as a formula gives it, and as it was drawn."""
    inverted = solution.drawn["inversion"]
    radius, angle = (float(inverted.value(each)[station]) for each in ("radius", "polar_angle"))
    return say(
        "At station {name} ${polar}$ mm; on the drawing it measures {radius} mm, in the direction of {angle}°.",
        name=name,
        polar=worked,
        **numbers(radius=radius, angle=math.degrees(angle)),
    )


def as_drawn(drawn: Construction) -> Caption:
    """What the steps of a construction say, where no paragraph puts the numbers into formulas."""
    return sequence([step.caption for step in drawn.steps()], " ")


def warning(sentence: Words) -> Caption:
    """A sentence that must not be overlooked."""
    return say("**{sentence}**", sentence=sentence)


def general(value: float, digits: int = 6) -> Caption:
    """A number with so many digits, without needless zeros."""
    return say("{value:.{digits}g}", value=value, digits=digits)


def lengths(values: Iterable[float]) -> Words:
    """Lengths one after another, each with its unit."""
    return joined([say("{length} mm", length=number(value)) for value in values])


ORDINATE = r"$$y_{<k>} = <chosen> \cdot \frac{<factor>}{<first>} = <y>\ \text{<mm>}$$"


def acceleration(solution: Solution) -> str:
    """The ordinates, from closure."""
    diagram, motion, stations = solution.drawn["acceleration"], solution.cam.motion, solution.chain.board.stations
    phases, index = moving_phases(motion, stations), stations.phase[stations.last].tolist()
    greatest, first = diagram.first("greatest"), next(k for k, phase in enumerate(phases) if phase.direction > 0)
    k1, factors = f"{index[first] + 1}", [_factor(phase) for phase in phases]
    alike = {"chosen": general(greatest[first]), "first": factors[first], "mm": unit("mm")}
    ordinates = [
        formula(ORDINATE, k=f"{i + 1}", factor=factor, y=number(y), **alike)
        for k, (i, factor, y) in enumerate(zip(index, factors, greatest, strict=True))
        if k != first
    ]
    rows = [
        (phase_title(motion, i), law_title(motion, i), *_peak_and_lift(phase), degrees(phase.angle), number(y))
        for i, phase, y in zip(index, phases, greatest, strict=True)
    ]
    lift = say("h, {unit}", unit=unit(diagram.givens.unit))
    return blocks(
        say(
            "One revolution is laid off as {base} mm, so $\\mu_\\varphi = 2\\pi/{base} = {mu}$ rad/mm. The moving "
            "phases are divided into {parts} parts, {equal}, and an ordinate is drawn at the middle of each part.",
            base=number(float(diagram.first("base"))),
            mu=number(solution.chain.board.mu_phi.per_mm, 6),
            parts=joined([f"{span.stop - span.start}" for span in stations.parts]),
            equal=equal_parts(stations),
        ),
        say(
            "The maximum ordinate of the first rise is chosen, ${symbol} = {chosen}$ mm; the scale follows "
            "later. The lift of a phase is proportional to $y\\varphi^2/C$, where $C$ is the law's factor in "
            "${greatest} = C h/\\varphi^2$. For the displacement to return to the axis, every other ordinate must "
            "be",
            symbol=formula("y_{<k>}", k=k1),
            greatest="a_{\\max}",
            **alike,
        ),
        formula(r"$$y_k = y_{<k>}\,\frac{C_k h_k/\varphi_k^2}{C_{<k>} h_{<k>}/\varphi_{<k>}^2}.$$", k=k1),
        *ordinates,
        table((say("phase"), say("law"), "C", lift, "φ", say("y, mm of paper")), rows, solution.tell),
        tell=solution.tell,
    )


def _peak_and_lift(phase: Moving) -> tuple[Caption, Caption]:
    """The law's factor C and the lift h."""
    return general(phase.normalised.peak_acceleration), general(phase.lift)


def _factor(phase: Moving) -> Caption:
    """What the greatest ordinate of a phase goes as."""
    c, h = _peak_and_lift(phase)
    return formula(r"<c> \cdot <h>/<phi>^2", c=c, h=h, phi=general(math.degrees(phase.angle)))


SCALES = (
    r"$$\mu_s = \frac{<lift>}{<paper>} = <mu_s>\ \text{<of_s>},$$",
    r"$$\mu_v = \frac{\mu_s}{\mu_\varphi H_2} = \frac{<mu_s>}{<mu_phi> \cdot <h2>} = <mu_v>\ \text{<of_v>},$$",
    r"$$\mu_a = \frac{\mu_v}{\mu_\varphi H_1} = \frac{<mu_v>}{<mu_phi> \cdot <h1>} = <mu_a>\ \text{<of_a>}.$$",
)
"""How the scales follow from the lift and the poles."""


def integration(solution: Solution) -> str:
    """Chords, closing errors, scales, the greatest velocity and acceleration."""
    c, values = solution.drawn["integration"], _integrated(solution)
    return blocks(
        say(
            "The poles lie $H_1 = {h1}$ mm and $H_2 = {h2}$ mm to the left of the origin. In every part, of "
            "width $\\Delta x$, a chord is drawn parallel to the ray of the middle ordinate $y$, so it rises by",
            **values,
        ),
        r"$$\Delta y_v = y_a\,\Delta x/H_1, \qquad \Delta y_s = y_v\,\Delta x/H_2.$$",
        say(
            "In the first part $\\Delta y_v = {y} \\cdot {width}/{h1}$; on the drawing it measures {chord} mm. The "
            "residual velocity at the end of each moving phase, {left}, is removed by rotating its base line; "
            "the residual displacement at the end of the turn, {left_s} mm, is distributed over the returns.",
            left=lengths(np.atleast_1d(c.first("closing_v")).tolist()),
            **values,
        ),
        say(
            "The maximum displacement measures {paper} mm and stands for the known lift of {lift} {unit}; the "
            "other scales follow through the poles:",
            **values,
        ),
        *(formula(scale, **values) for scale in SCALES),
        say(
            "The maximum velocity measures {v} mm, so ${velocity}$ {unit}/rad; the maximum acceleration measures "
            "{a} mm, so ${acceleration}$ {unit}/rad².",
            velocity=formula(r"v_{\max} = <mu_v> \cdot <v> = <max_v>", **values),
            acceleration=formula(r"a_{\max} = <mu_a> \cdot <a> = <max_a>", **values),
            **values,
        ),
        _in_degrees(solution) if c.givens.unit == "rad" else "",
        tell=solution.tell,
    )


def _in_degrees(solution: Solution) -> Caption:
    """The lift of an arm and the scale of its displacement, as a protractor has them."""
    lift, mu = solution.cam.motion.lift, solution.drawn["integration"].readings["s"].per_mm
    return say(
        "The displacement $s$ is the angle of the arm: in degrees the lift is {lift}° and $\\mu_s = {mu}$ °/mm.",
        lift=general(math.degrees(lift)),
        mu=general(math.degrees(mu), 5),
    )


def _integrated(solution: Solution) -> dict[str, Caption]:
    """What was measured on the integrals, and their scales."""
    c, lift, middles = solution.drawn["integration"], solution.cam.motion.lift, solution.drawn["acceleration"]
    x, chord, of_lift = c.first("s_curve").real, c.first("v_chords")[1].imag, unit(c.givens.unit)
    return {
        **numbers(y=middles.first("middles")[0], width=x[1] - x[0], chord=chord, left_s=c.first("closing_s")),
        **numbers(v=c.first("max_v"), a=c.first("max_a"), paper=lift / c.readings["s"].per_mm),
        **{name: general(c.readings[name[-1]].per_mm, 5) for name in ("mu_s", "mu_v", "mu_a")},
        **{name: say("{h:g}", h=h) for name, h in zip(("h1", "h2"), c.givens.poles, strict=True)},
        "mu_phi": number(solution.chain.board.mu_phi.per_mm, 6),
        "lift": general(lift),
        "unit": of_lift,
        "of_s": say("{unit}/mm", unit=of_lift),
        "of_v": say("({unit}/rad)/mm", unit=of_lift),
        "of_a": say("({unit}/rad²)/mm", unit=of_lift),
        **{f"max_{name}": number(float(c.value(f"max_{name}")), digits(c.readings[name].per_mm)) for name in "va"},
    }


def greatest_angles(solution: Solution) -> str:
    """The greatest pressure angles, beside what is permitted."""
    plotted, board = solution.drawn["angle_diagram"], solution.chain.board
    rise, back = (float(plotted.value(name)) for name in ("max_rise", "max_return"))
    places = {"at_rise": plotted.first("max_rise"), "at_return": plotted.first("max_return")}
    mu_phi, limits = board.mu_phi.per_mm, board.limits
    at = {name: number(math.degrees(complex(place).real * mu_phi), 1) for name, place in places.items()}
    greatest = say(
        "The angles are plotted over the cam angle. The maxima are {rise}° on the rise, at φ = {at_rise}°, and "
        "{back}° on the return, at φ = {at_return}°.",
        **numbers(rise=math.degrees(rise), back=math.degrees(back)),
        **at,
    )
    against = [_against("rise", rise, limits.rise, solution), _against("return", back, limits.return_, solution)]
    return solution.tell(sequence([greatest, *_inside(solution), *against], " "))


INSIDE = {
    "rise": say("Inside the rise, at φ = {at}°, the maximum is {alpha}°; the larger one is at an end of the phase."),
    "return": say(
        "Inside the return, at φ = {at}°, the maximum is {alpha}°; the larger one is at an end of the phase."
    ),
}


def _inside(solution: Solution) -> list[Caption]:
    """The maxima of the other sign inside the phases, where the larger ones are at their ends."""
    plotted, board = solution.drawn["angle_diagram"], solution.chain.board
    told: list[Caption] = []
    for phase, said in INSIDE.items():
        if other := inside(plotted, phase):
            alpha = math.degrees(other.place.imag * plotted.givens.mu_alpha.per_mm)
            phi = math.degrees(other.place.real * board.mu_phi.per_mm)
            told.append(replace(said, values={"at": number(phi, 1), "alpha": number(alpha)}))
    return told


KEPT = {
    "rise": say("On the rise {limit} are permitted; the limit is satisfied{exactly}."),
    "return": say("On the return {limit} are permitted; the limit is satisfied{exactly}."),
}
EXCEEDED = {
    "rise": say("On the rise only {limit} are permitted, so the limit is exceeded: {why}."),
    "return": say("On the return only {limit} are permitted, so the limit is exceeded: {why}."),
}


def _against(word: str, angle: float, limit: float | None, solution: Solution) -> Caption:
    """A sentence on the greatest angle of rise or return beside its limit [rad]."""
    if limit is None:
        return say("A spring drives the return (force closure), so the return's angle does not limit the cam.")
    if not math.degrees(abs(angle)) > math.degrees(limit) + LAST_DIGIT:
        return replace(KEPT[word], values={"limit": degrees(limit), "exactly": _exactly(word, limit, solution)})
    values = {"limit": degrees(limit), "why": _why_exceeded(word, angle, solution)}
    return warning(replace(EXCEEDED[word], values=values))


def _exactly(word: str, limit: float, solution: Solution) -> Words:
    """What is to be added where the drawn angle keeps the limit [rad] and the exact one does not."""
    extremes, rise = solution.cam.extremes(), word == "rise"
    angle = (extremes.pressure_angle_rise if rise else extremes.pressure_angle_return)[0]
    over = math.degrees(abs(angle) - limit)
    unlimited = rise and angle < 0 and not solution.chain.board.limits.rest  # the angle at the low rest
    if unlimited or not over > LAST_DIGIT:
        return ""
    exact = number(math.degrees(abs(angle)))
    return say(" as drawn; exactly the angle is {exact}°, {over}° over", exact=exact, over=number(over))


def _why_exceeded(word: str, angle: float, solution: Solution) -> Caption:
    chain, least = solution.chain, float(solution.drawn["minimum_radius"].value("prime_radius"))
    given = chain.board.prime_radius
    if given is not None and given < least:
        return say(
            "the given prime radius of {given:g} mm is smaller than the minimum, {least} mm",
            given=given,
            least=number(least),
        )
    if word == "rise" and angle < 0 and not chain.board.limits.rest:
        return say("it is the angle in the lower dwell, which this task does not limit")
    if not chain.pencil.perfect:
        return say("the drawing errors exceed the amount by which the prime radius was rounded up")
    if given is not None:
        return say("at the adopted offset the given prime radius is too small")
    return say("with so few parts the diagrams agree no better")


UNREADABLE_BEND = say(
    "The curvature cannot be read: the bisectors of neighbouring chords cross at less than a degree everywhere."
)


def curvature(solution: Solution) -> str:
    """The three points, their chords, and the radius."""
    curved, mu, tell = solution.drawn["curvature"], solution.chain.profile_scale.per_mm, solution.tell
    triple, centre = curved.first("triple"), complex(curved.first("centre"))
    if np.isnan(centre):
        return tell(UNREADABLE_BEND)
    angles = np.degrees(curved.first("phi") % FULL_TURN).tolist()
    said = say(
        "The pitch curve is sharpest at the points φ = {phi}. Their two chords measure {chords} at {ratio}; the "
        "perpendicular bisectors meet in O, and the distance from O to the middle point B is {radius} mm. So "
        "$\\rho = {mu:g} \\cdot {radius} = {rho}$ mm is the minimum radius of curvature of the pitch curve.",
        phi=joined([say("{phi}°", phi=number(phi, 1)) for phi in angles]),
        chords=lengths(np.abs(np.diff(triple)).tolist()),
        **numbers(radius=abs(centre - triple[1]), rho=curved.value("rho")),
        ratio=ratio_text(mu),
        mu=mu,
    )
    return tell(said)


def roller(solution: Solution) -> str:
    """The rule's terms, and what is adopted."""
    chain, given, tell = solution.chain, solution.chain.board.roller_radius, solution.tell
    if given == 0:
        return tell(say("The follower has a knife edge: the working profile is the pitch curve itself."))
    if given is not None:
        return tell(say("The task gives a roller of $r = {given:g}$ mm.", given=given))
    return tell(sequence([_proposed(solution), _rounded_down(chain.rounding, chain.roller_radius)], " "))


def _proposed(solution: Solution) -> Caption:
    rolled, chain = solution.drawn["roller"], solution.chain
    terms = [
        say("{term} = {radius} mm", term=term.said, radius=number(radius))
        for term, radius in zip(chain.board.roller_rule, rolled.value("candidates").tolist(), strict=True)
    ]
    proposed = say(
        "With ρ = {rho} mm and r₀ = {r0:g} mm the rule proposes {terms}. The smallest is {least} mm.",
        **numbers(rho=solution.drawn["curvature"].value("rho"), least=rolled.value("roller_radius")),
        r0=chain.prime_radius,
        terms=joined(terms),
    )
    if chain.pencil.perfect:
        return proposed
    perfect = number(float(chain.perfect.roller.value("roller_radius")))
    return sequence([proposed, say("The ideal pencil gives {radius} mm.", radius=perfect)], " ")


def _rounded_down(rounding: float, adopted: float) -> Caption:
    if adopted < rounding:
        return say("It is less than the rounding step of {rounding:g} mm and is adopted unchanged.", rounding=rounding)
    return say(
        "Rounded down to a multiple of {rounding:g} mm, the roller radius is adopted as $r = {adopted:.6g}$ mm.",
        rounding=rounding,
        adopted=adopted,
    )


def working_profile(solution: Solution) -> str:
    """The envelope's radii, and whether it is undercut."""
    profile, radius = solution.drawn["working_profile"], solution.chain.roller_radius
    if "roller" not in solution.drawn:
        return solution.tell(as_drawn(profile))
    radii = profile.value("radius")
    how = (
        say(
            "The working profile is the inner envelope of the roller's circles about the points of the pitch "
            "curve: the contact point lies $r = {radius:.6g}$ mm from the pitch point, square to the pitch curve.",
            radius=radius,
        )
        if radius
        else say("The knife edge runs on the pitch curve itself.")
    )
    runs = say(
        "Its radii at the stations run from {least} to {greatest} mm.",
        **numbers(least=np.nanmin(radii), greatest=np.nanmax(radii)),
    )
    return solution.tell(sequence([how, runs, *_undercut(solution, radius), *_low_dwells(profile)], " "))


def _low_dwells(profile: Construction) -> list[Caption]:
    """The angles of the arcs of the lower dwells, as they are measured on the profile."""
    if "low_dwells" not in profile.readings:
        return []
    known = [angle for angle in np.degrees(profile.value("low_dwells")).tolist() if not math.isnan(angle)]
    said = say("On the working profile the arc of the lower dwell takes {angles}.")
    return [said.where(angles=joined([say("{angle}°", angle=number(angle, 1)) for angle in known]))] if known else []


def _undercut(solution: Solution, radius: float) -> list[Caption]:
    rho = float(solution.drawn["curvature"].value("rho"))
    lost = ~np.isnan(solution.drawn["working_profile"].first("covered"))
    covered = [name for name, gone in zip(station_names(solution.chain.board.stations), lost, strict=True) if gone]
    if covered:
        undercut = say(
            "At the stations {stations} the contact point lies inside another roller circle: the profile is "
            "undercut, and the follower cannot follow the required motion there. Take a smaller roller or a "
            "larger prime radius.",
            stations=joined(covered),
        )
        return [warning(undercut)]
    if radius >= rho:
        said = say(
            "The roller is not smaller than the minimum radius of curvature, {rho} mm: the profile is undercut "
            "or pointed there. Take a smaller roller or a larger prime radius.",
            rho=number(rho),
        )
        return [warning(said)]
    if radius and math.isfinite(rho):
        return [say("The roller is smaller than ρ = {rho} mm, so the profile is not undercut.", rho=number(rho))]
    return []
