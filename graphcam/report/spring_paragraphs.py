"""The note's paragraphs on what presses the follower on the cam: contact, the forces over the turn."""

import numpy as np

from graphcam.constructions.axes import degrees, station_names
from graphcam.drafting.units import unit
from graphcam.given.arm_load import ArmLoad
from graphcam.given.load_curve import LoadCurve
from graphcam.given.spring_load import SpringLoad
from graphcam.report.markdown import blocks, number, table
from graphcam.report.paragraphs import general, warning
from graphcam.solving.solution import Solution
from graphcam.solving.spring_design import IDLE, SpringDesign, with_unit
from graphcam.solving.turn_diagrams import at_side
from graphcam.words import Caption, Words, joined, say, sequence

FORMULAS = {
    "slides": r"$$\xi = m\,a\,\omega^2 + F_0 + c\,s<outer>.$$",
    "slides, not evenly": r"$$\xi = m\,(a\,\omega^2 + v\,\varepsilon) + F_0 + c\,s<outer>.$$",
    "torsion": r"$$\xi = J\,(a\,\omega^2 + v\,\varepsilon) + F_0 + c\,s<outer>.$$",
    "at a point": r"$$\xi = J\,(a\,\omega^2 + v\,\varepsilon) + (F_0 + c\,x)\,\frac{dx}{ds}<outer>.$$",
}
"""The contact function, by what presses."""


def _spring(solution: Solution) -> SpringDesign:
    spring = solution.spring
    assert spring is not None
    return spring


def _formula(load: SpringLoad | ArmLoad) -> str:
    if isinstance(load, SpringLoad):
        kind, outer = ("slides, not evenly" if load.acceleration else "slides"), " + P"
    else:
        kind, outer = ("torsion" if load.at is None else "at a point"), r" + l\,P"
    return FORMULAS[kind].replace("<outer>", outer if load.load else "")


def contact(solution: Solution) -> str:
    """The spring's preload, the least contact force, and where contact is lost."""
    tell, spring = solution.tell, _spring(solution)
    load, needed, least, lost = spring.load, spring.least, spring.contact.least_force(), joined(spring.lost)
    along, preload, _ = spring.units
    keeps = say(
        "A preload of at least {preload} {unit} keeps contact over the whole turn; it is needed at φ = {phi}.",
        preload=number(needed.preload),
        unit=unit(preload),
        phi=degrees(needed.phi),
    )
    values = {"preload": number(load.preload), "unit": unit(preload)}
    least_values = {"force": number(least.value), "unit": unit(along), "at": at_side(least, solution.cam.motion)}
    said = [
        keeps if needed.preload > 0 else say("Contact is kept even without a preload."),
        say("The preload is adopted as $F_0 = {preload}$ {unit}.", **values)
        if spring.open_preload
        else say("The preload is given as $F_0 = {preload}$ {unit}.", **values),
        say("The minimum contact force is {force} {unit}, {at}.", **least_values)
        if isinstance(load, SpringLoad)
        else say("The minimum torque with which the cam pushes the arm is {force} {unit}, {at}.", **least_values),
    ]
    if spring.idle:
        said.append(IDLE)
    too_small = say("Contact is lost, φ = {where}: the spring's preload is too small.", where=lost)
    return blocks(_presses(spring), _formula(load), sequence(said, " "), warning(too_small) if lost else "", tell=tell)


def _presses(spring: SpringDesign) -> Caption:
    """What presses, in a sentence that the formula ends."""
    load = spring.load
    if isinstance(load, SpringLoad):
        sentences = [
            say(
                "A spring of $c = {stiffness:g}$ N/mm presses the moving mass of $m = {mass:g}$ kg onto the cam.",
                stiffness=load.stiffness,
                mass=load.mass,
            )
        ]
    elif load.at is None:
        sentences = [
            say(
                "A torsion spring of $c = {stiffness:g}$ N·mm/rad presses the arm, whose moment of inertia about "
                "the pivot is $J = {inertia:g}$ kg·mm², onto the cam.",
                stiffness=load.stiffness,
                inertia=load.inertia,
            )
        ]
    else:
        sentences = [
            say(
                "A spring of $c = {stiffness:g}$ N/mm acts {arm:g} mm from the pivot on the arm, whose moment of "
                "inertia about the pivot is $J = {inertia:g}$ kg·mm²; its other end is anchored at ({x:g}, "
                "{y:g}) mm from the cam centre, and $x$ is its deflection beyond that in the lowest position.",
                stiffness=load.stiffness,
                inertia=load.inertia,
                arm=load.at.arm,
                x=load.at.anchor[0],
                y=load.at.anchor[1],
            )
        ]
    if load.acceleration:
        accelerated = say("The angular acceleration of the cam is $\\varepsilon = {epsilon:g}$ rad/s².")
        sentences.append(accelerated.where(epsilon=load.acceleration))
    if isinstance(load.load, LoadCurve):
        least, most = min(load.load.force), max(load.load.force)
        varies = say(
            "A load $P$ from {least:g} to {most:g} N, given by the table, also presses the follower onto the cam.",
            least=least,
            most=most,
        )
        sentences.append(varies)
    elif load.load:
        sentences.append(say("A load of $P = {force:g}$ N also presses the follower onto the cam.", force=load.load))
    bears = (
        say("The cam pushes the follower with the force")
        if isinstance(load, SpringLoad)
        else say("The cam drives the arm with the torque about the pivot")
    )
    return sequence([*sentences, bears], " ")


NORMAL = {
    (True, False): r"$$N = \frac{\xi}{\cos\alpha}, \qquad M = N\,v\cos\alpha.$$",
    (True, True): (
        r"$$N = \frac{\xi}{\cos\alpha - \mu\sin\alpha}, \qquad "
        r"M = N\,\bigl(v\,(\cos\alpha - \mu\sin\alpha) + \mu\,w\bigr).$$"
    ),
    (False, False): r"$$N = \frac{\xi}{l\cos\alpha}, \qquad M = N\,v\,l\cos\alpha.$$",
    (False, True): (
        r"$$N = \frac{\xi}{l\cos\alpha - \sigma\mu\,(l\sin\alpha - r)}, \qquad "
        r"M = v\,\xi + \mu\,N\,w.$$"
    ),
}
"""Normal force and torque, by whether the follower slides, and whether there is friction at the cam."""


def forces(solution: Solution) -> str:
    """Normal force and torque: formulas, extremes, and the values at the stations."""
    tell, spring = solution.tell, _spring(solution)
    mean, most, fewest = spring.torques
    least, greatest = spring.forces.least_normal(), spring.greatest_normal
    rubs = say(
        "Between cam and follower there is friction with $\\mu = {friction}$: the force $\\mu N$ acts along the "
        "profile, in the cam's sense, and $w$ is the sliding speed divided by $\\omega$.",
        friction=general(spring.friction),
    )
    extremes = say(
        "The normal force is at least {least}, {at_least}, and at most {greatest}, {at_greatest}. The torque that "
        "drives the cam reaches {most}, {at_most}, and {fewest}, {at_fewest}; its mean over the turn is {mean}.",
        least=with_unit(_zero(least.value), "N"),
        at_least=at_side(least, solution.cam.motion),
        greatest=with_unit(greatest.value, "N"),
        at_greatest=at_side(greatest, solution.cam.motion),
        most=with_unit(most.value, "N·mm"),
        at_most=at_side(most, solution.cam.motion),
        fewest=with_unit(fewest.value, "N·mm"),
        at_fewest=at_side(fewest, solution.cam.motion),
        mean=with_unit(_zero(mean), "N·mm"),
    )
    return blocks(
        rubs if spring.friction else "",
        say("The cam pushes along the normal with $N$, and the torque on the shaft is $M$:"),
        NORMAL[isinstance(spring.load, SpringLoad), bool(spring.friction)],
        extremes,
        _at_stations(solution, spring),
        tell=tell,
    )


def _at_stations(solution: Solution, spring: SpringDesign) -> str:
    """The forces at the stations, as the cam without errors has them."""
    stations, at = solution.chain.board.stations, spring.at_stations()
    header: tuple[Words, ...] = (
        *(say("station"), "φ", say("ξ, {unit}", unit=unit(spring.units[0]))),
        *(say("{name}, {unit}", name=name, unit=unit("N")) for name in ("N", "N cos α", "N sin α")),
        say("{name}, {unit}", name="M", unit=unit("N·mm")),
    )
    columns = [np.ravel(each) for each in (at.load, at.normal, at.along, at.side, at.torque)]
    rows = [
        (name, degrees(phi), *(number(_zero(float(column[k])), 1) for column in columns))
        for k, (name, phi) in enumerate(zip(station_names(stations), stations.phi.tolist(), strict=True))
    ]
    return table(header, rows, solution.tell)


def _zero(value: float) -> float:
    """A value without the rounding that is left where it is zero."""
    return round(value, 9) + 0.0
