"""The note's paragraphs on the constructions of a translating follower."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from graphcam.constructions.axes import degrees, station_names, turning
from graphcam.constructions.drawn_translating import DrawnTranslating
from graphcam.constructions.minimum_radius import LINES, active
from graphcam.constructions.pressure_angle import shown_station
from graphcam.drafting.ink import Construction
from graphcam.errors import DesignError
from graphcam.given.follower import sense
from graphcam.given.limits import Limits
from graphcam.report.markdown import blocks, number
from graphcam.report.paragraphs import LAST_DIGIT, Paragraph, scale_of, warning
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Words, say, sequence

ONE_DEGREE = math.radians(1)


@dataclass(frozen=True)
class Condition:
    """A line that bounds the region: s0 tan(angle) + side sigma e >= v - s tan(angle), where it touches at (s, v)."""

    name: str
    angle: float
    side: int
    s: float
    v: float

    @property
    def least(self) -> float:
        """The right-hand side [mm]."""
        return self.v - self.s * math.tan(self.angle)

    def told(self) -> Caption:
        """The condition as a formula."""
        said = CONDITIONS[self.name]
        values = {
            "left": say(
                "s_0 \\tan {angle} {sign} \\sigma e", angle=_degrees(self.angle), sign="+" if self.side > 0 else "-"
            ),
            "tangent": say("\\tan {angle}", angle=_degrees(self.angle)),
            "v": number(self.v), "s": number(self.s), "least": number(self.least),
        }  # fmt: skip
        return replace(said, values=values)


CONDITIONS = {
    "rise": say(
        "- rise: ${left} \\ge v - s {tangent} = {v} - {s} {tangent} = {least}$ mm, where the tangent touches the "
        "rise's curve."
    ),
    "return": say(
        "- return: ${left} \\ge |v| - s {tangent} = {v} - {s} {tangent} = {least}$ mm, where the tangent touches the "
        "return's curve."
    ),
    "rest": say("- rest: ${left} \\ge 0$, so that the angle at the low rest keeps the rise's limit."),
}


def _degrees(angle: float) -> Caption:
    return say("{angle:.6g}^\\circ", angle=math.degrees(angle))


def _conditions(region: Construction) -> list[Condition]:
    limits, mu = region.givens["limits"], scale_of(region, "prime_radius")
    found: list[Condition] = []
    for name, angle, side in (("rise", limits.rise, 1), ("return", limits.return_, -1), ("rest", limits.rise, -1)):
        if name in region.points and angle is not None:
            touch = complex(region.first(name)) * mu
            found.append(Condition(name, angle, side, touch.imag, abs(touch.real)))
    return found


def least_radius(solution: Solution) -> str:
    """The conditions of the region, the lines that bind, the least radius, and what is adopted."""
    region, board, tell = solution.drawn["minimum_radius"], solution.chain.board, solution.tell
    spring = say("A spring drives the return (force closure), so the return sets no condition.")
    conditions = say(
        "In the combined diagram the velocities are laid off at the displacements, both in the scale of s. A cam "
        "centre A that lies $s_0$ below the start of the lift, with the follower's line $e$ to the right of it, keeps "
        "the permitted angles under these conditions, with $\\sigma = {sigma}$ for a cam that turns {turning}:",
        sigma=sense(board.rotation), turning=turning(board.rotation),
    )  # fmt: skip
    return blocks(
        tell(conditions),
        "\n".join(tell(condition.told()) for condition in _conditions(region)),
        *(tell(said) for said in _centre(region)),
        "" if board.limits.return_ is not None else tell(spring),
        tell(_adopted(solution)),
        tell(_sensitivity(solution)),
    )


def _centre(region: Construction) -> list[Caption]:
    """The place that is taken for the cam centre, and its distance from the start of the lift."""
    s0, e, r0 = (float(region.value(name)) for name in ("s0", "offset", "prime_radius"))
    if math.isnan(r0):
        unreadable = say("No cam centre can be read, because the lines that bound the region cross at under a degree.")
        return [warning(unreadable)]
    bound_by, given = [LINES[line.name] for line in active(region)], region.givens["offset"]
    place = (
        say("Of the region the place that is nearest to the start of the lift is taken.")
        if given is None
        else say("The highest permitted place on the line at the given $e = {e:g}$ mm is taken.", e=given)
    )
    lies = say("It lies on the limit of: {lines}.", lines=sequence(bound_by)) if bound_by else say("No line binds it.")
    read = say("There $s_0 = {s0}$ mm and $e = {e}$ mm are read, so", s0=number(s0), e=number(e))
    square = say("({e})^2", e=number(e)) if e < 0 else say("{e}^2", e=number(e))
    return [
        sequence([place, lies, read], " "),
        say(
            "$$r_0 = \\sqrt{{s_0^2 + e^2}} = \\sqrt{{{s0}^2 + {square}}} = {r0}\\ \\text{{mm}}.$$",
            s0=number(s0), square=square, r0=number(r0),
        ),
        say("This is the least prime radius."),
    ]  # fmt: skip


def _adopted(solution: Solution) -> Caption:
    """The prime radius and the offset that are built, and why these."""
    chain, board = solution.chain, solution.chain.board
    least = float(solution.drawn["minimum_radius"].value("prime_radius"))
    said: list[Caption] = []
    if board.follower.place is None:
        said.append(
            say(
                "The offset is adopted as $e = {e:g}$ mm, a multiple of {rounding:g} mm.",
                e=chain.place, rounding=chain.rounding,
            )
        )  # fmt: skip
    if board.prime_radius is None:
        said += _rounded_up(solution)
    elif board.prime_radius < least - LAST_DIGIT:
        smaller = say(
            "The task gives $r_0 = {r0:g}$ mm, which is smaller: the permitted pressure angles cannot be kept.",
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
    said: list[Caption] = []
    if board.follower.place is None:
        said.append(say("The combined diagram, read again at this offset, gives {radius} mm.", radius=radius))
    elif not chain.pencil.perfect:
        said.append(say("A hand without error reads {radius} mm.", radius=radius))
    adopted = say(
        "Rounded up to a multiple of {rounding:g} mm the prime radius is adopted as $r_0 = {r0:g}$ mm.",
        rounding=chain.rounding, r0=chain.prime_radius,
    )  # fmt: skip
    return [*said, adopted]


def _sensitivity(solution: Solution) -> Words:
    """What one more degree of permitted angle is worth, from the combined diagram drawn again."""
    chain, limits = solution.chain, solution.chain.board.limits
    try:
        wider = Limits(limits.rise + ONE_DEGREE, limits.return_ and limits.return_ + ONE_DEGREE, limits.rest)
    except DesignError:
        return say("The permitted angle is so large that a degree more cannot be drawn.")
    again = replace(chain, board=replace(chain.board, limits=wider)).minimum_radius
    least, then = (float(c.value("prime_radius")) for c in (chain.minimum_radius, again))
    if math.isnan(then - least):
        return ""
    return say(
        "Drawn again with every permitted angle greater by one degree, the combined diagram gives {then} mm: the least "
        "radius changes by {change} mm per degree.",
        then=number(then), change=number(then - least),
    )  # fmt: skip


def pressure_angle(solution: Solution) -> str:
    """The velocity plan at the station of the greatest angle."""
    measured, integrated = solution.drawn["pressure_angle"], solution.drawn["integration"]
    board, chain, k, tell = solution.chain.board, solution.chain, shown_station(measured), solution.tell
    s, v = (number(float(integrated.value(name)[k])) for name in ("s", "v"))
    s0, offset = number(float(measured.value("s0"))), sense(board.rotation) * chain.place
    return blocks(
        tell(
            say(
                "The velocity plan $\\vec v_2 = \\vec v_1 + \\vec v_{{21}}$ (cam 1, follower 2) is similar to the "
                "triangle ABC of the mechanism, so $AC = ds/d\\varphi = v$. Laid off from B across the motion it "
                "gives D, and the angle of DA with the motion is the pressure angle:"
            )
        ),
        tell(say("$$\\tan\\alpha = \\frac{{v - \\sigma e}}{{s_0 + s}}.$$")),
        tell(
            say(
                "With the adopted sizes $s_0 = {s0}$ mm and $\\sigma e = {offset}$ mm. At station {name} (φ = {phi}) "
                "$s = {s}$ mm and $v = {v}$ mm/rad, so",
                s0=s0, offset=number(offset), name=station_names(board.stations)[k],
                phi=degrees(board.stations.phi[k]), s=s, v=v,
            )
        ),
        tell(
            say(
                "$$\\tan\\alpha = \\frac{{{v} {sign} {offset}}}{{{s0} + {s}}}, \\qquad \\alpha = {alpha}^\\circ.$$",
                v=v, sign="-" if offset >= 0 else "+", offset=number(abs(offset)), s0=s0, s=s,
                alpha=number(math.degrees(float(measured.value("alpha")[k]))),
            )
        ),
    )  # fmt: skip


def inversion(solution: Solution) -> str:
    """The pitch curve's points in polar coordinates."""
    inverted, measured, tell = solution.drawn["inversion"], solution.drawn["pressure_angle"], solution.tell
    k, names = shown_station(measured), station_names(solution.chain.board.stations)
    return blocks(
        tell(
            say(
                "The cam is held still and the follower's line is turned about its centre against the rotation; it "
                "touches the circle of the offset. From the prime circle the displacement is laid off along it, so a "
                "point of the pitch curve has the polar radius"
            )
        ),
        "$$R = \\sqrt{e^2 + (s_0 + s)^2}.$$",
        tell(
            say(
                "At station {name} $R = \\sqrt{{{e}^2 + ({s0} + {s})^2}} = {radius}$ mm, in the direction of {angle}°.",
                name=names[k], e=number(abs(solution.chain.place)), s0=number(float(measured.value("s0"))),
                s=number(float(solution.drawn["integration"].value("s")[k])),
                radius=number(float(inverted.value("radius")[k])),
                angle=number(math.degrees(float(inverted.value("polar_angle")[k]))),
            )
        ),
    )  # fmt: skip


OF_TRANSLATING: Mapping[str, Paragraph] = {
    "minimum_radius": least_radius,
    "pressure_angle": pressure_angle,
    "inversion": inversion,
}
"""By the construction that each is about."""
