"""The note's paragraphs on the constructions of a translating follower."""

import math
from collections.abc import Iterator
from dataclasses import replace

from graphcam.constructions.axes import degrees, station_names, turning
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.constructions.minimum_radius import LINES, active
from graphcam.constructions.pressure_angle import shown_station
from graphcam.drafting.ink import Construction
from graphcam.drafting.units import unit
from graphcam.errors import DesignError
from graphcam.given.follower import sense
from graphcam.given.limits import Limits
from graphcam.report.markdown import blocks, formula, number, numbers
from graphcam.report.paragraphs import LAST_DIGIT, general, warning
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Words, say, sequence

ONE_DEGREE = math.radians(1)
TAN = say("\\tan")
CONDITIONS = {
    "rise": say(
        "- rise: ${left} \\ge v - s {tangent} = {v} - {s} {tangent} = {least}$ mm, at the point where the tangent "
        "touches the curve of the rise."
    ),
    "return": say(
        "- return: ${left} \\ge |v| - s {tangent} = {v} - {s} {tangent} = {least}$ mm, at the point where the "
        "tangent touches the curve of the return."
    ),
    "rest": say("- dwell: ${left} \\ge 0$, so that the angle in the lower dwell stays within the limit of the rise."),
}


def _conditions(region: Construction) -> Iterator[Caption]:
    """The lines that bound the region: s0 tan(angle) + side sigma e >= v - s tan(angle), each touching at (s, v)."""
    limits, mu = region.givens.limits, region.readings["prime_radius"].per_mm
    for name, angle, side in (("rise", limits.rise, "+"), ("return", limits.return_, "-"), ("rest", limits.rise, "-")):
        if name in region.points and angle is not None:
            touch = complex(region.first(name)) * mu
            s, v = touch.imag, abs(touch.real)
            tangent = formula(r"<tan> <angle>^\circ", tan=TAN, angle=general(math.degrees(angle)))
            left = formula(r"s_0 <tangent> <side> \sigma e", tangent=tangent, side=side)
            read = numbers(v=v, s=s, least=v - s * math.tan(angle))
            yield replace(CONDITIONS[name], values={"left": left, "tangent": tangent, **read})


def least_radius(solution: Solution) -> str:
    """The conditions of the region, the lines that bind, the least radius, and what is adopted."""
    region, board, tell = solution.drawn["minimum_radius"], solution.chain.board, solution.tell
    spring = say("A spring drives the return (force closure), so the return imposes no condition.")
    conditions = say(
        "In the combined diagram the velocities are laid off at the displacements, both in the scale of s. A cam "
        "centre A that lies $s_0$ below the start of the lift, with the follower's line $e$ to the right of it, "
        "satisfies the permitted angles under these conditions, with $\\sigma = {sigma}$ for a cam that turns "
        "{turning}:",
        sigma=sense(board.rotation),
        turning=turning(board.rotation),
    )
    return blocks(
        conditions,
        "\n".join(map(tell, _conditions(region))),
        *_centre(region),
        "" if board.limits.return_ is not None else spring,
        _adopted(solution),
        _sensitivity(solution),
        tell=tell,
    )


def _centre(region: Construction) -> list[Caption]:
    """The place that is taken for the cam centre, and its distance from the start of the lift."""
    s0, e, r0 = (float(region.value(name)) for name in ("s0", "offset", "prime_radius"))
    if math.isnan(r0):
        unreadable = say(
            "No cam centre can be read, because the lines that bound the region cross at less than a degree."
        )
        return [warning(unreadable)]
    values = numbers(s0=s0, e=e, r0=r0)
    bound_by, given = [LINES[line.name] for line in active(region)], region.givens.offset
    place = (
        say("The point of the region nearest to the start of the lift is taken.")
        if given is None
        else say("The highest permitted point on the line at the given $e = {e:g}$ mm is taken.", e=given)
    )
    lies = (
        say("It lies on the limit set by: {lines}.", lines=sequence(bound_by))
        if bound_by
        else say("No line limits it.")
    )
    read = say("The readings there are $s_0 = {s0}$ mm and $e = {e}$ mm, so", **values)
    values |= {"square": formula("(<e>)^2" if e < 0 else "<e>^2", **values), "mm": unit("mm")}
    radius = r"$$r_0 = \sqrt{s_0^2 + e^2} = \sqrt{<s0>^2 + <square>} = <r0>\ \text{<mm>}.$$"
    return [sequence([place, lies, read], " "), formula(radius, **values), say("This is the minimum prime radius.")]


def _adopted(solution: Solution) -> Caption:
    """The prime radius and the offset that are built, and why these."""
    chain, board, least = solution.chain, solution.chain.board, solution.drawn["minimum_radius"].value("prime_radius")
    said: list[Caption] = []
    if board.follower.place is None:
        offset = {"e": chain.place, "rounding": chain.rounding}
        said.append(say("The offset is adopted as $e = {e:g}$ mm, a multiple of {rounding:g} mm.", **offset))
    if board.prime_radius is None:
        said += _rounded_up(solution)
    elif board.prime_radius < float(least) - LAST_DIGIT:
        smaller = say(
            "The task gives $r_0 = {r0:g}$ mm, which is smaller: the permitted pressure angles are exceeded.",
            r0=board.prime_radius,
        )
        said.append(warning(smaller))
    else:
        said.append(say("The task gives $r_0 = {r0:g}$ mm.", r0=board.prime_radius))
    return sequence(said, " ")


def _rounded_up(solution: Solution) -> list[Caption]:
    """How the prime radius follows from the least one at the adopted offset, as a hand without error reads it."""
    chain, board = solution.chain, solution.chain.board
    there = replace(chain.perfect, board=replace(board, follower=DrawnTranslating(chain.place)))
    radius = number(float(there.minimum_radius.value("prime_radius")))
    adopted = say(
        "Rounded up to a multiple of {rounding:g} mm, the prime radius is adopted as $r_0 = {r0:g}$ mm.",
        rounding=chain.rounding,
        r0=chain.prime_radius,
    )
    if board.follower.place is None:
        return [say("Read again at this offset, the combined diagram gives {radius} mm.", radius=radius), adopted]
    if chain.pencil.perfect:
        return [adopted]
    return [say("The ideal pencil gives {radius} mm.", radius=radius), adopted]


def _sensitivity(solution: Solution) -> Words:
    """What one more degree of permitted angle is worth, from the combined diagram drawn again."""
    chain, limits = solution.chain, solution.chain.board.limits
    try:
        wider = Limits(limits.rise + ONE_DEGREE, limits.return_ and limits.return_ + ONE_DEGREE, limits.rest)
    except DesignError:
        return say("The permitted angle is so large that one degree more cannot be drawn.")
    again = replace(chain, board=replace(chain.board, limits=wider)).minimum_radius
    least, then = (float(c.value("prime_radius")) for c in (chain.minimum_radius, again))
    if math.isnan(then - least):
        return ""
    return say(
        "If every permitted angle is raised by 1°, the combined diagram gives {then} mm: the minimum radius "
        "changes by {change} mm per degree.",
        **numbers(then=then, change=then - least),
    )


def pressure_angle(solution: Solution) -> str:
    """The velocity plan at the station of the greatest angle."""
    values = _at_shown_station(solution)
    return blocks(
        say(
            "The velocity plan ${plan}$ (cam 1, follower 2) is similar to the triangle ABC of the mechanism, so "
            "$AC = ds/d\\varphi = v$. Laid off from B across the motion it gives D, and the angle between DA and "
            "the motion is the pressure angle:",
            plan=r"\vec v_2 = \vec v_1 + \vec v_{21}",
        ),
        formula(r"$$<tan>\alpha = \frac{v - \sigma e}{s_0 + s}.$$", tan=TAN),
        say(
            "With the adopted sizes $s_0 = {s0}$ mm and $\\sigma e = {offset}$ mm. At station {name} (φ = {phi}) "
            "$s = {s}$ mm and $v = {v}$ mm/rad, so",
            **values,
        ),
        formula(r"$$<tan>\alpha = \frac{<v> <less> <place>}{<s0> + <s>}, \qquad \alpha = <alpha>^\circ.$$", **values),
        tell=solution.tell,
    )


def inversion(solution: Solution) -> str:
    """The pitch curve's points in polar coordinates."""
    values = _at_shown_station(solution)
    return blocks(
        say(
            "The cam is held still and the follower's line is turned about its centre against the rotation; it "
            "always touches the offset circle. From the prime circle the displacement is laid off along it, so a "
            "point of the pitch curve has the polar radius"
        ),
        r"$$R = \sqrt{e^2 + (s_0 + s)^2}.$$",
        say(
            "At station {name} ${polar}$ mm, in the direction of {angle}°.",
            polar=formula(r"R = \sqrt{<place>^2 + (<s0> + <s>)^2} = <radius>", **values),
            **values,
        ),
        tell=solution.tell,
    )


def _at_shown_station(solution: Solution) -> dict[str, Words]:
    """What was read at the station of the velocity plan."""
    integrated, measured, inverted = (solution.drawn[name] for name in ("integration", "pressure_angle", "inversion"))
    stations, k = solution.chain.board.stations, shown_station(measured)
    offset = sense(solution.chain.board.rotation) * solution.chain.place
    angles = {"alpha": measured.value("alpha")[k], "angle": inverted.value("polar_angle")[k]}
    return {
        **numbers(s0=measured.value("s0"), s=integrated.value("s")[k], v=integrated.value("v")[k]),
        **numbers(offset=offset, place=abs(offset), radius=inverted.value("radius")[k]),
        **numbers(**{name: math.degrees(angle) for name, angle in angles.items()}),
        "name": station_names(stations)[k],
        "phi": degrees(stations.phi[k]),
        "less": "-" if offset >= 0 else "+",
        "tan": TAN,
    }
