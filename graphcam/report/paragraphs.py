"""The note's paragraphs on what several followers have in common: the formula, the numbers put in, the result."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

import numpy as np

from graphcam.constructions.acceleration import equal_parts, moving_phases
from graphcam.constructions.axes import degrees, phase_title, station_names
from graphcam.drafting.ink import Construction
from graphcam.drafting.scale import ratio_text
from graphcam.drafting.units import unit
from graphcam.given.motion import FULL_TURN
from graphcam.report.markdown import blocks, number, table
from graphcam.report.sheet_data import law_title
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Words, joined, say, sequence

Paragraph = Callable[[Solution], str]
"""Writes what stands under one heading."""
FINEST_READING = 0.01
"""What is told of a length on paper [mm]."""
LAST_DIGIT = 0.005
"""Lengths [mm] and angles [degrees] are told to two decimals; what differs by less does not differ in print."""


def scale_of(construction: Construction, reading: str) -> float:
    """The scale of a reading, in the first sample [unit/mm]."""
    return float(np.ravel(construction.readings[reading].scale)[0])


def digits(per_mm: float) -> int:
    """As many decimals as the finest reading on paper has in the machine.

    >>> digits(0.48), digits(2.0), digits(500.0)
    (3, 2, 0)
    """
    return max(0, math.ceil(-math.log10(FINEST_READING * per_mm)))


def warning(sentence: Words) -> Caption:
    """A sentence that must not be overlooked."""
    return say("**{sentence}**", sentence=sentence)


def g6(value: float) -> Caption:
    """A number with six digits, without needless zeros."""
    return say("{value:.6g}", value=value)


def g5(value: float) -> Caption:
    """A number with five digits, without needless zeros."""
    return say("{value:.5g}", value=value)


def lengths(values: Iterable[float]) -> Words:
    """Lengths one after another, each with its unit."""
    return joined([say("{length} mm", length=number(value)) for value in values])


def acceleration(solution: Solution) -> str:
    """The ordinates, from closure."""
    tell = solution.tell
    diagram, motion, stations = solution.drawn["acceleration"], solution.cam.motion, solution.chain.board.stations
    phases, index = moving_phases(motion, stations), stations.phase[stations.last].tolist()
    greatest, base = diagram.first("greatest"), float(diagram.first("base"))
    first = next(k for k, phase in enumerate(phases) if phase.direction > 0)
    factors = [
        say("{c} \\cdot {h}/{phi}^2", c=g6(p.normalised.peak_acceleration), h=g6(p.lift), phi=g6(math.degrees(p.angle)))
        for p in phases
    ]
    numbers = [
        tell(
            say(
                "$$y_{{{index}}} = {chosen} \\cdot \\frac{{{factor}}}{{{first}}} = {y}\\ \\text{{mm}}$$",
                index=i + 1, chosen=g6(greatest[first]), factor=factor, first=factors[first], y=number(y),
            )
        )
        for k, (i, factor, y) in enumerate(zip(index, factors, greatest, strict=True))
        if k != first
    ]  # fmt: skip
    rows = [
        (phase_title(motion, i), law_title(motion, i), g6(phase.normalised.peak_acceleration), g6(phase.lift),
         degrees(phase.angle), number(y))
        for i, phase, y in zip(index, phases, greatest, strict=True)
    ]  # fmt: skip
    parts = joined([f"{span.stop - span.start}" for span in stations.parts])
    y1, c1 = f"y_{{{index[first] + 1}}}", f"{{{index[first] + 1}}}"
    return blocks(
        tell(
            say(
                "One revolution is laid off as {base} mm, so $\\mu_\\varphi = 2\\pi/{base} = {mu}$ rad/mm. The moving "
                "phases are divided into {parts} parts, {equal}, and the ordinate is erected at the middle of each "
                "part.",
                base=number(base), mu=number(solution.chain.board.mu_phi.per_mm, 6), parts=parts,
                equal=equal_parts(stations),
            )
        ),
        tell(
            say(
                "The diagram is drawn in a scale that is not yet known: the greatest ordinate of the first rise is "
                "chosen, ${symbol} = {chosen}$ mm. The lift of a phase goes as $y\\varphi^2/C$, where $C$ is the law's "
                "factor in $a_{{\\max}} = C h/\\varphi^2$. So that the displacement comes back to the axis, every "
                "other ordinate is",
                symbol=y1, chosen=g6(greatest[first]),
            )
        ),
        f"$$y_k = {y1}\\,\\frac{{C_k h_k/\\varphi_k^2}}{{C_{c1} h_{c1}/\\varphi_{c1}^2}}.$$",
        *numbers,
        table(
            (say("phase"), say("law"), "C", say("h, {unit}", unit=unit(diagram.givens["unit"])), "φ",
             say("y, mm of paper")),
            rows, tell,
        ),
    )  # fmt: skip


def integration(solution: Solution) -> str:
    """Chords, closing errors, scales, the greatest velocity and acceleration."""
    tell = solution.tell
    c, diagram, lift = solution.drawn["integration"], solution.drawn["acceleration"], solution.cam.motion.lift
    h1, h2 = (say("{h:g}", h=h) for h in c.givens["poles"])
    x, of_lift = c.first("s_curve").real, unit(c.givens["unit"])
    y, width, chord = float(diagram.first("middles")[0]), x[1] - x[0], c.first("v_chords")[1].imag
    mu_phi = number(solution.chain.board.mu_phi.per_mm, 6)
    mu_s, mu_v, mu_a = (scale_of(c, name) for name in ("s", "v", "a"))
    v, a = float(c.first("max_v")), float(c.first("max_a"))
    return blocks(
        tell(
            say(
                "The poles lie $H_1 = {h1}$ mm and $H_2 = {h2}$ mm to the left of the origin. In every part of the "
                "width $\\Delta x$ a chord is drawn parallel to the ray of the middle ordinate $y$, so it rises by",
                h1=h1, h2=h2,
            )
        ),
        "$$\\Delta y_v = y_a\\,\\Delta x/H_1, \\qquad \\Delta y_s = y_v\\,\\Delta x/H_2.$$",
        tell(
            say(
                "In the first part $\\Delta y_v = {y} \\cdot {width}/{h1}$, which the drawing gives as {chord} mm. The "
                "velocity that is left at the end of each moving phase, {left}, is taken up by turning its base line; "
                "the displacement that is left at the end of the turn, {left_s} mm, is shared out along the returns.",
                y=number(y), width=number(width), h1=h1, chord=number(chord),
                left=lengths(np.atleast_1d(c.first("closing_v")).tolist()), left_s=number(float(c.first("closing_s"))),
            )
        ),
        tell(
            say(
                "The greatest displacement measures {paper} mm and stands for the known lift of {lift} {unit}; the "
                "other scales follow through the poles:",
                paper=number(lift / mu_s), lift=g6(lift), unit=of_lift,
            )
        ),
        tell(
            say(
                "$$\\mu_s = \\frac{{{lift}}}{{{paper}}} = {mu_s}\\ \\text{{{unit}/mm}},$$",
                lift=g6(lift), paper=number(lift / mu_s), mu_s=g5(mu_s), unit=of_lift,
            )
        ),
        tell(
            say(
                "$$\\mu_v = \\frac{{\\mu_s}}{{\\mu_\\varphi H_2}} = \\frac{{{mu_s}}}{{{mu_phi} \\cdot {h2}}} = {mu_v}"
                "\\ \\text{{({unit}/rad)/mm}},$$",
                mu_s=g5(mu_s), mu_phi=mu_phi, h2=h2, mu_v=g5(mu_v), unit=of_lift,
            )
        ),
        tell(
            say(
                "$$\\mu_a = \\frac{{\\mu_v}}{{\\mu_\\varphi H_1}} = \\frac{{{mu_v}}}{{{mu_phi} \\cdot {h1}}} = {mu_a}"
                "\\ \\text{{({unit}/rad²)/mm}}.$$",
                mu_v=g5(mu_v), mu_phi=mu_phi, h1=h1, mu_a=g5(mu_a), unit=of_lift,
            )
        ),
        tell(
            say(
                "The greatest velocity measures {v} mm, so $v_{{\\max}} = {mu_v} \\cdot {v} = {max_v}$ {unit}/rad; the "
                "greatest acceleration measures {a} mm, so $a_{{\\max}} = {mu_a} \\cdot {a} = {max_a}$ {unit}/rad².",
                v=number(v), mu_v=g5(mu_v), max_v=number(float(c.value("max_v")), digits(mu_v)), a=number(a),
                mu_a=g5(mu_a), max_a=number(float(c.value("max_a")), digits(mu_a)), unit=of_lift,
            )
        ),
    )  # fmt: skip


def greatest_angles(solution: Solution) -> str:
    """The greatest pressure angles, beside what is permitted."""
    plotted, limits = solution.drawn["angle_diagram"], solution.chain.board.limits
    rise, back = (float(plotted.value(name)) for name in ("max_rise", "max_return"))
    mu_phi = solution.chain.board.mu_phi.per_mm
    at_rise, at_return = (
        number(math.degrees(complex(plotted.first(name)).real * mu_phi), 1) for name in ("max_rise", "max_return")
    )
    greatest = say(
        "The angles are plotted over the cam angle. The greatest are {rise}° on the rise, at φ = {at_rise}°, and "
        "{back}° on the return, at φ = {at_return}°.",
        rise=number(math.degrees(rise)), at_rise=at_rise, back=number(math.degrees(back)), at_return=at_return,
    )  # fmt: skip
    against = [_against("rise", rise, limits.rise, solution), _against("return", back, limits.return_, solution)]
    return solution.tell(sequence([greatest, *against], " "))


KEPT = {
    "rise": say("On the rise {limit} are permitted, which is kept{exactly}."),
    "return": say("On the return {limit} are permitted, which is kept{exactly}."),
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
        values = {"limit": degrees(limit), "exactly": _exactly(word, limit, solution)}
        return replace(KEPT[word], values=values)
    return warning(
        replace(EXCEEDED[word], values={"limit": degrees(limit), "why": _why_exceeded(word, angle, solution)})
    )


def _exactly(word: str, limit: float, solution: Solution) -> Words:
    """What is to be added where the drawn angle keeps the limit [rad] and the exact one does not."""
    extremes, rise = solution.cam.extremes(), word == "rise"
    angle = (extremes.pressure_angle_rise if rise else extremes.pressure_angle_return)[0]
    over = math.degrees(abs(angle) - limit)
    unlimited = rise and angle < 0 and not solution.chain.board.limits.rest  # the angle at the low rest
    if unlimited or not over > LAST_DIGIT:
        return ""
    exact = number(math.degrees(abs(angle)))
    return say(" as drawn; exactly it is {exact}°, {over}° over", exact=exact, over=number(over))


def _why_exceeded(word: str, angle: float, solution: Solution) -> Caption:
    chain, least = solution.chain, float(solution.drawn["minimum_radius"].value("prime_radius"))
    given = chain.board.prime_radius
    if given is not None and given < least:
        return say(
            "the given prime radius of {given:g} mm is smaller than the least one, {least} mm",
            given=given, least=number(least),
        )  # fmt: skip
    if word == "rise" and angle < 0 and not chain.board.limits.rest:
        return say("it is the angle at the low rest, which this task does not limit")
    if not chain.pencil.perfect:
        return say("the hand's errors are larger than what the prime radius was rounded up by")
    if given is not None:
        return say("at the adopted offset the given prime radius is too small")
    return say("with so few parts the diagrams do not agree better")


def curvature(solution: Solution) -> str:
    """The three points, their chords, and the radius."""
    curved, mu_l = solution.drawn["curvature"], solution.chain.profile_scale
    triple, centre = curved.first("triple"), complex(curved.first("centre"))
    if np.isnan(centre):
        return solution.tell(
            say("No bend can be read: the bisectors of neighbouring chords cross at less than a degree everywhere.")
        )
    angles = np.degrees(curved.first("phi") % FULL_TURN).tolist()
    return solution.tell(
        say(
            "The pitch curve is sharpest at the points of φ = {phi}. Their two chords measure {chords} at {ratio}; the "
            "perpendicular bisectors meet in O, and from O to the middle point B are {radius} mm. So $\\rho = {mu:g} "
            "\\cdot {radius} = {rho}$ mm is the least radius of curvature of the pitch curve.",
            phi=joined([say("{phi}°", phi=number(phi, 1)) for phi in angles]),
            chords=lengths(np.abs(np.diff(triple)).tolist()), ratio=ratio_text(mu_l.per_mm),
            radius=number(abs(centre - triple[1])), mu=mu_l.per_mm, rho=number(float(curved.value("rho"))),
        )
    )  # fmt: skip


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
        rho=number(float(solution.drawn["curvature"].value("rho"))), r0=chain.prime_radius, terms=joined(terms),
        least=number(float(rolled.value("roller_radius"))),
    )  # fmt: skip
    if chain.pencil.perfect:
        return proposed
    perfect = number(float(chain.perfect.roller.value("roller_radius")))
    return sequence([proposed, say("A hand without error reads {radius} mm.", radius=perfect)], " ")


def _rounded_down(rounding: float, adopted: float) -> Caption:
    if adopted < rounding:
        return say("It is less than the rounding of {rounding:g} mm and adopted as it is.", rounding=rounding)
    return say(
        "Rounded down to a multiple of {rounding:g} mm the roller is adopted as $r = {adopted:.6g}$ mm.",
        rounding=rounding, adopted=adopted,
    )  # fmt: skip


def working_profile(solution: Solution) -> str:
    """The envelope's radii, and whether it is undercut."""
    profile, radius = solution.drawn["working_profile"], solution.chain.roller_radius
    radii = profile.value("radius")
    how = (
        say(
            "The working profile is the inner envelope of the roller's circles about the points of the pitch curve: "
            "the touch point lies $r = {radius:.6g}$ mm from the pitch point, square to the pitch curve.",
            radius=radius,
        )
        if radius
        else say("The knife edge runs on the pitch curve itself.")
    )
    runs = say(
        "Its radii at the stations run from {least} to {greatest} mm.",
        least=number(np.nanmin(radii)), greatest=number(np.nanmax(radii)),
    )  # fmt: skip
    return solution.tell(sequence([how, runs, *_undercut(solution, radius)], " "))


def _undercut(solution: Solution, radius: float) -> list[Caption]:
    rho = float(solution.drawn["curvature"].value("rho"))
    lost = ~np.isnan(solution.drawn["working_profile"].first("covered"))
    covered = [name for name, gone in zip(station_names(solution.chain.board.stations), lost, strict=True) if gone]
    if covered:
        said = say(
            "At the stations {stations} the touch point lies inside another roller circle: the profile is undercut, "
            "and the follower will not follow its motion there. Take a smaller roller or a larger prime radius.",
            stations=joined(covered),
        )
        return [warning(said)]
    if radius >= rho:
        said = say(
            "The roller is not smaller than the least radius of curvature, {rho} mm: the profile is undercut or "
            "pointed there. Take a smaller roller or a larger prime radius.",
            rho=number(rho),
        )
        return [warning(said)]
    if radius and math.isfinite(rho):
        return [say("The roller is smaller than ρ = {rho} mm, so the profile is not undercut.", rho=number(rho))]
    return []


OF_ALL: Mapping[str, Paragraph] = {"acceleration": acceleration, "integration": integration}
"""What every follower has, by the construction that each paragraph is about."""
OF_ROLLERS: Mapping[str, Paragraph] = {
    "angle_diagram": greatest_angles,
    "curvature": curvature,
    "roller": roller,
    "working_profile": working_profile,
}
"""What a follower with a roller or a knife edge has too."""
