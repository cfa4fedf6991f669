"""The note's paragraphs on the constructions of an oscillating follower."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from graphcam.constructions.adoption import adoption_step
from graphcam.constructions.arm_minimum_radius import DWELLS, NO_CENTRE, ArmRegion, found_at
from graphcam.constructions.arm_positions import directions
from graphcam.constructions.axes import degrees, station_names, turning
from graphcam.constructions.pressure_angle import shown_station
from graphcam.constructions.views import REGION
from graphcam.drafting.units import unit
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.report.markdown import blocks, formula, number, numbers
from graphcam.report.paragraphs import STROKES, general, polar_point, warning
from graphcam.report.translating_paragraphs import TAN
from graphcam.solving.solution import Solution
from graphcam.words import Caption, Words, say, sequence

ANGLE_DIGITS = 3
"""Decimals of an angle in degrees in a formula, so that its cosine gives lengths to hundredths of a millimetre."""
TANGENT = (
    r"$$<tan>\alpha = \frac{l\,(1 + \sigma v) - c\cos(\psi_0 + s)}{c\,\sin(\psi_0 + s)}, "
    r"\qquad v = \frac{ds}{d\varphi}.$$"
)
WORKED = (
    r"<tan>\alpha = \frac{<l>\,(1 <sign> <v>) - <c>\cos(<psi0>^\circ + <s>^\circ)}"
    r"{<c>\,\sin(<psi0>^\circ + <s>^\circ)} = <tangent>, \qquad \alpha = <alpha>^\circ"
)
AT_REST = (
    r"<tan>\alpha = \frac{<l> - <c>\cos <psi>^\circ}{<c>\,\sin <psi>^\circ} = <tangent>, "
    r"\qquad \alpha = <alpha>^\circ"
)
"""The same in a dwell, where v is 0."""
RADIUS = (
    r"$$r_0 = \sqrt{l^2 + c^2 - 2lc\cos\psi_0} = "
    r"\sqrt{<l>^2 + <c>^2 - 2 \cdot <l> \cdot <c>\cos <psi0>^\circ} = <r0>\ \text{<mm>}.$$"
)
START = (
    r"$$\psi_0 = \arccos\frac{l^2 + c^2 - r_0^2}{2lc} = "
    r"\arccos\frac{<l>^2 + <c>^2 - <r0>^2}{2 \cdot <l> \cdot <c>} = <psi0>^\circ.$$"
)
POLAR = r"R = \sqrt{<l>^2 + <c>^2 - 2 \cdot <l> \cdot <c>\cos(<psi0>^\circ + <s>^\circ)} = <radius>"


@dataclass(frozen=True)
class _Centres:
    """The triangle of cam centre, pivot and arm: lengths [mm], the angle at the start of the lift [rad], the sense."""

    arm: float
    distance: float
    psi0: float
    sigma: int

    def tangent(self, s: Floats, v: Floats) -> Floats:
        """Of the pressure angles at displacements [rad] with velocities [rad/rad]."""
        c, psi = self.distance, self.psi0 + s
        return (self.arm * (1 + self.sigma * v) - c * np.cos(psi)) / (c * np.sin(psi))

    def radius(self, s: float) -> float:
        """From the cam centre to the end of the arm [mm], at a displacement [rad]."""
        arm, c = self.arm, self.distance
        return math.sqrt(arm**2 + c**2 - 2 * arm * c * math.cos(self.psi0 + s))

    @property
    def told(self) -> dict[str, Caption]:
        """The numbers of the triangle, as a formula has them."""
        psi0 = number(math.degrees(self.psi0), ANGLE_DIGITS)
        return {"l": general(self.arm), "c": general(self.distance), "psi0": psi0}

    def worked(self, s: float, v: float) -> Caption:
        """The pressure angle at a displacement [rad], with the numbers put into the formula."""
        tangent, along = float(self.tangent(np.asarray(s), np.asarray(v))), self.sigma * v
        return formula(
            WORKED if v else AT_REST,
            tan=TAN,
            sign="-" if along < 0 else "+",
            v=number(abs(along), 4),
            s=number(math.degrees(s), ANGLE_DIGITS),
            psi=number(math.degrees(self.psi0 + s), ANGLE_DIGITS),
            tangent=number(tangent, 4),
            alpha=number(math.degrees(math.atan(tangent))),
            **self.told,
        )


def _adopted_centres(solution: Solution) -> _Centres:
    """The triangle of the adopted sizes."""
    givens = solution.drawn["pressure_angle"].givens
    arm, c = givens.arm, givens.distance
    with np.errstate(invalid="ignore"):
        psi0 = float(np.arccos((arm**2 + c**2 - givens.prime_radius**2) / (2 * arm * c)))
    return _Centres(arm, c, psi0, sense(givens.rotation))


LEAST = {1: r"\le", -1: r"\ge"}
"""How an angle is limited towards the pivot, and away from it."""
CONDITIONS = {
    "rise": say("- rise: ${condition}$; the worst station is {station}, where ${worked}$."),
    "return": say("- return: ${condition}$; the worst station is {station}, where ${worked}$."),
    "rest": say("- dwell: ${condition}$; the worst is at arm {station}, where ${worked}$."),
    "rest after the return": say("- dwell: ${condition}$; the worst is at arm {station}, where ${worked}$."),
}


def _conditions(region: ArmRegion, centres: _Centres) -> Iterator[Caption]:
    """What is permitted of each family of lines, and how near the cam centre comes to it."""
    integrated, limits, sigma = region.givens.integrated, region.givens.limits, centres.sigma
    s, v = (integrated.value(name) for name in "sv")
    moving, names = directions(region.givens), station_names(integrated.givens.stations)
    at_rest = np.zeros_like(moving, bool)
    at_rest[[0, int(np.argmax(s))]] = True
    for name, angle, side, of in (
        ("rise", limits.rise, sigma, moving > 0),
        ("return", limits.return_, -sigma, moving < 0),
        ("rest", limits.rise, -sigma, at_rest),
        ("rest after the return", limits.return_, sigma, at_rest),
    ):
        if f"limits: {name}" in region.acts and angle is not None:
            speed = np.zeros_like(v) if name in DWELLS else v
            k = int(np.argmax(np.where(of, side * centres.tangent(s, speed), -np.inf)))
            limit = general(side * math.degrees(angle))
            bound = formula(r"\alpha <least> <angle>^\circ", angle=limit, least=LEAST[side])
            station = "B₀" if name in DWELLS and k == 0 else names[k]
            worked = centres.worked(float(s[k]), float(speed[k]))
            yield CONDITIONS[name].where(condition=bound, station=station, worked=worked)
    if "limits: reach" in region.acts:
        yield say(
            "- the arm stays above the line of centres: $0 < \\psi_0 + s < 180^\\circ$; the maximum is ${psi0}^\\circ "
            "+ {s}^\\circ = {psi}^\\circ$."
        ).where(
            psi0=number(math.degrees(centres.psi0)),
            s=number(math.degrees(float(s.max()))),
            psi=number(math.degrees(centres.psi0 + float(s.max()))),
        )


def least_radius(solution: Solution) -> str:
    """The conditions at the cam centre that was found, its prime radius, and what is adopted."""
    region, tell = solution.drawn["minimum_radius"], solution.tell
    centre = complex(region.first("centre")) * region.givens.mu_l.per_mm
    adopted = solution.drawn["pressure_angle"].givens.adopted()
    decided = adoption_step(adopted, "c", region.givens.mu_l.per_mm, REGION).caption if adopted else ""
    if np.isnan(centre):
        return blocks(warning(NO_CENTRE[region.givens.distance is not None]), decided, STROKES, tell=tell)
    rotation = region.givens.rotation
    centres = _Centres(region.givens.arm, abs(centre), float(np.angle(-centre)), sense(rotation))
    r0 = float(region.value("prime_radius"))
    values = centres.told | {"r0": number(centres.radius(0.0)), "mm": unit("mm")}
    return blocks(
        say(
            "The arm has the length $l$; at the start of the lift it makes the angle $\\psi_0$ = B₀CA with the line of "
            "centres CA = $c$. At the displacement $s$ the pressure angle is"
        ),
        formula(TANGENT, tan=TAN),
        say(
            "It is counted from the normal to the arm towards the pivot, with $\\sigma = {sigma}$ for a cam that turns "
            "{turning}. A₀ is {place}; there $c = {c}$ mm and $\\psi_0 = {psi0}^\\circ$, so the "
            "conditions are:",
            sigma=sense(rotation),
            turning=turning(rotation),
            place=found_at(region),
            **{name: values[name] for name in ("c", "psi0")},
        ),
        "\n".join(map(tell, _conditions(region, centres))),
        say("The minimum prime radius is the distance of A₀ from B₀:"),
        formula(RADIUS, **values),
        sequence([say("On the drawing it measures {drawn} mm.", drawn=number(r0)), decided], " ") if decided else "",
        STROKES,
        tell=tell,
    )


def pressure_angle(solution: Solution) -> str:
    """The velocity plan at the station of the greatest angle, by numbers and as measured."""
    measured, centres = solution.drawn["pressure_angle"], _adopted_centres(solution)
    name, k, s, v = _at_shown_station(solution)
    alpha = np.degrees(measured.value("alpha"))
    worst = int(np.nanargmax(np.abs(alpha)))
    stations = solution.chain.board.stations
    return blocks(
        say(
            "The velocity plan ${plan}$ (cam 1, follower 2), turned by 90°, is the triangle ABD of the mechanism, so "
            "$BD = l\\,ds/d\\varphi = l v$ lies along the arm. The angle from the normal to the arm in D to DA is the "
            "pressure angle:",
            plan=r"\vec v_2 = \vec v_1 + \vec v_{21}",
        ),
        formula(TANGENT, tan=TAN),
        say(
            "With $\\sigma = {sigma}$ and the adopted sizes the angle between the arm and the line of centres at the "
            "start of the lift is",
            sigma=centres.sigma,
        ),
        formula(START, r0=general(measured.givens.prime_radius), **centres.told),
        say(
            "On the drawing it measures {psi0}°. At station {name} (φ = {phi}) $s = {s}^\\circ$ and $v = {v}$, so",
            psi0=number(float(np.degrees(measured.first("psi0")))),
            name=name,
            phi=degrees(stations.phi[k]),
            s=number(math.degrees(s), ANGLE_DIGITS),
            v=number(v, 4),
        ),
        formula("$$<worked>.$$", worked=centres.worked(s, v)),
        say(
            "On the drawing it measures {alpha}°, so the transmission angle is $\\gamma = 90^\\circ - |\\alpha| = "
            "{gamma}^\\circ$. The minimum transmission angle is {least}°, at station {worst}.",
            **numbers(alpha=alpha[k], gamma=90 - abs(alpha[k]), least=90 - abs(alpha[worst])),
            worst=station_names(stations)[worst],
        ),
        STROKES,
        tell=solution.tell,
    )


def inversion(solution: Solution) -> str:
    """The pitch curve's points in polar coordinates."""
    centres, (name, k, s, _) = _adopted_centres(solution), _at_shown_station(solution)
    values = centres.told | {"s": number(math.degrees(s), ANGLE_DIGITS), "radius": number(centres.radius(s))}
    return blocks(
        say(
            "In every position the arm makes the angle $\\psi_0 + s$ with the line of centres, so a point of the pitch "
            "curve has the polar radius"
        ),
        r"$$R = \sqrt{l^2 + c^2 - 2lc\cos(\psi_0 + s)}.$$",
        polar_point(solution, k, name, formula(POLAR, **values)),
        STROKES,
        tell=solution.tell,
    )


def _at_shown_station(solution: Solution) -> tuple[Words, int, float, float]:
    """The station of the velocity plan: its name, its number, displacement [rad] and velocity [rad/rad]."""
    k, integrated = shown_station(solution.drawn["pressure_angle"]), solution.drawn["integration"]
    s, v = (float(integrated.value(each)[k]) for each in "sv")
    return station_names(solution.chain.board.stations)[k], k, s, v
