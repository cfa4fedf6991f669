"""The note's paragraphs on the constructions of a flat-faced follower."""

import math

from graphcam.constructions.adoption import adoption_step
from graphcam.constructions.axes import station_names
from graphcam.constructions.flat_minimum_radius import nearest_station
from graphcam.constructions.profile_view import worked_station
from graphcam.constructions.views import PROFILE
from graphcam.drafting.units import unit
from graphcam.given.follower import sense
from graphcam.report.markdown import blocks, formula, number, numbers
from graphcam.report.paragraphs import STROKES, general, polar_point, warning
from graphcam.solving.solution import Solution
from graphcam.words import say, sequence

CONVEX = (
    r"$$\rho = r_0 + s + \frac{d^2 s}{d\varphi^2} \ge [\rho], \qquad "
    r"r_0 \ge [\rho] - \min\left(s + \frac{d^2 s}{d\varphi^2}\right).$$"
)
LEAST = r"$$r_0 = [\rho] - \min(s + a) = <rho> <sign> <sum> = <r0>\ \text{<mm>}.$$"
SHARPEST = r"$$\rho_{\min} = r_0 + \min(s + a) = <r0> <sign> <sum> = <rho>\ \text{<mm>}.$$"
WIDTHS = (
    r"$$b_l = <left_of> = <left>\ \text{<mm>}, \qquad b_r = <right_of> = <right>\ \text{<mm>}, \qquad "
    r"b = b_l + b_r = <width>\ \text{<mm>}.$$"
)
EXTREMES = {
    1: (r"-\min\frac{ds}{d\varphi}", r"\max\frac{ds}{d\varphi}"),
    -1: (r"\max\frac{ds}{d\varphi}", r"-\min\frac{ds}{d\varphi}"),
}
"""What the face must reach to, left and right, by the sense in which the cam turns."""
SUM_DIGITS = 3


def least_radius(solution: Solution) -> str:
    """The condition of convexity, where it binds, and what is adopted."""
    region, tell = solution.drawn["minimum_radius"], solution.tell
    mu, least = region.readings["need"].per_mm, region.givens.least_curvature
    touch, need = complex(region.first("touch")) * mu, float(region.value("need"))
    adopted = solution.drawn["inversion"].givens.adopted()
    view = solution.drawn["inversion"].givens.mu_l.per_mm
    values = {"rho": general(least), "sum": number(abs(need), SUM_DIGITS), "mm": unit("mm")}
    return blocks(
        say("The profile is nowhere sharper than the permitted radius of curvature $[\\rho]$ if"),
        CONVEX,
        say(
            "In the diagram of $s$ over $a = d^2s/d\\varphi^2$ the sum is constant along lines at 45°. The lowest of "
            "them touches the curve near station {name}, at $s = {s}$ mm and $a = {a}$ mm, and meets the axis of $s$ "
            "at $\\min(s + a) = {paper} \\cdot {mu:.5g} = {sum}$ mm. With $[\\rho] = {rho:g}$ mm",
            name=nearest_station(region),
            s=number(touch.imag),
            a=number(touch.real),
            paper=number(-float(region.first("need"))),
            mu=mu,
            sum=number(-need, SUM_DIGITS),
            rho=least,
        ),
        formula(LEAST, sign="+" if need >= 0 else "-", r0=number(least + need, SUM_DIGITS), **values),
        "" if least + need > 0 else say("It is not positive, so any prime radius satisfies the condition."),
        adoption_step(adopted, "e", view, PROFILE).caption if adopted else "",
        STROKES,
        tell=tell,
    )


def curvature(solution: Solution) -> str:
    """The least radius of curvature of the profile, beside the permitted one."""
    curved, region = solution.drawn["curvature"], solution.drawn["minimum_radius"]
    need, least, rho = float(region.value("need")), region.givens.least_curvature, float(curved.value("rho"))
    r0 = curved.givens.prime_radius
    kept = say("At least {least:g} mm is required: the condition is satisfied.", least=least)
    if rho < least - 10**-SUM_DIGITS / 2:
        kept = warning(say("At least {least:g} mm is required: the condition is not satisfied.", least=least))
    return blocks(
        say("At the adopted prime radius the minimum radius of curvature of the profile is"),
        formula(
            SHARPEST,
            r0=general(r0),
            sign="-" if need >= 0 else "+",
            sum=number(abs(need), SUM_DIGITS),
            rho=number(r0 - need, SUM_DIGITS),
            mm=unit("mm"),
        ),
        sequence([say("On the drawing it measures {drawn} mm.", drawn=number(rho)), kept], " "),
        STROKES,
        tell=solution.tell,
    )


POLAR = r"R = \sqrt{(<r0> + <s>)^2 + <v>^2} = <radius>"


def inversion(solution: Solution) -> str:
    """The contact points in polar coordinates, and the width of the face."""
    inverted, integrated = solution.drawn["inversion"], solution.drawn["integration"]
    stations, r0, sigma = solution.chain.board.stations, inverted.givens.prime_radius, sense(inverted.givens.rotation)
    k = worked_station(stations)
    s, v = (float(integrated.value(name)[k]) for name in "sv")
    left, right = (float(inverted.value(f"face_{side}")) for side in ("left", "right"))
    left_of, right_of = EXTREMES[sigma]
    polar = formula(POLAR, r0=general(r0), **numbers(s=s, v=abs(v), radius=math.hypot(r0 + s, v)))
    return blocks(
        say(
            "The face lies at $r_0 + s$ from the cam centre and touches the profile $ds/d\\varphi$ beside its ray, so "
            "a contact point has the polar radius"
        ),
        r"$$R = \sqrt{(r_0 + s)^2 + \left(\frac{ds}{d\varphi}\right)^2}.$$",
        polar_point(solution, k, station_names(stations)[k], polar),
        say("The face must be at least so wide to the left and to the right of the line of motion, and in all:"),
        formula(
            WIDTHS,
            left_of=left_of,
            right_of=right_of,
            mm=unit("mm"),
            **numbers(left=left, right=right, width=left + right),
        ),
        STROKES,
        tell=solution.tell,
    )
