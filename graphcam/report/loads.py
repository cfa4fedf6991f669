"""The note on the loads of a follower: contact, forces over the turn, contact stress."""

import numpy as np

from graphcam.constructions.axes import degrees, station_names
from graphcam.drafting.scale import unit
from graphcam.given.spring_load import ArmLoad, LoadCurve, SpringLoad
from graphcam.report.markdown import Block, Equation, Grid, formula, general, number, numbers, warning
from graphcam.solving.solution import Solution
from graphcam.solving.spring_design import SpringDesign
from graphcam.solving.spring_diagrams import IDLE_CAPTION, moved_part, with_unit
from graphcam.solving.stress_design import StressDesign, rounded_up
from graphcam.solving.turn_diagrams import at_side
from graphcam.words import Caption, Words, and_list, say, sequence

FORMULAS = {
    "slides": r"\xi = m\,a\,\omega^2 + F_0 + c\,s<outer>.",
    "slides, not evenly": r"\xi = m\,(a\,\omega^2 + v\,\varepsilon) + F_0 + c\,s<outer>.",
    "torsion": r"\xi = J\,(a\,\omega^2 + v\,\varepsilon) + F_0 + c\,s<outer>.",
    "at a point": r"\xi = J\,(a\,\omega^2 + v\,\varepsilon) + (F_0 + c\,x)\,\frac{dx}{ds}<outer>.",
}
"""The formula of the contact function, by the kinds of forces on the follower."""


def _spring(solution: Solution) -> SpringDesign:
    spring = solution.spring
    assert spring is not None
    return spring


def _formula(load: SpringLoad | ArmLoad) -> str:
    if isinstance(load, SpringLoad):
        kind, outer = ("slides, not evenly" if load.acceleration else "slides"), " + P"
    else:
        kind, outer = ("torsion" if load.at is None else "at a point"), r" + l\,P"
    damped = r" + d\,v\,\omega" if load.damping else ""
    return FORMULAS[kind].replace("<outer>", damped + (outer if load.load else ""))


def contact(solution: Solution) -> list[Block]:
    """The chapter on contact: the spring's preload, the minimum contact force, and where contact is lost."""
    spring = _spring(solution)
    load, needed, least, lost = (spring.load, spring.least, spring.contact.min_force(), and_list(spring.lost))
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
        said.append(IDLE_CAPTION)
    too_small = say("Contact is lost, φ = {where}: the spring's preload is too small.", where=lost)
    return [_presses(spring), Equation(_formula(load)), sequence(said, " "), warning(too_small) if lost else ""]


def _presses(spring: SpringDesign) -> Caption:
    """The sentence on the forces that press the follower, which the formula ends."""
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
        sentences.append(accelerated.with_values(epsilon=load.acceleration))
    if load.damping:
        damped = say("Damping of $d = {damping:g}$ {unit} acts against the motion.")
        sentences.append(damped.with_values(damping=load.damping, unit=unit(spring.damping_unit)))
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


NORMAL_FORCE = {
    ("stem", False): r"N = \frac{\xi}{\cos\alpha}, \qquad M = N\,v\cos\alpha.",
    ("stem", True): (
        r"N = \frac{\xi}{\cos\alpha - f_1\sin\alpha}, \qquad "
        r"M = N\,\bigl(v\,(\cos\alpha - f_1\sin\alpha) + f_1\,w\bigr)."
    ),
    ("arm", False): r"N = \frac{\xi}{l\cos\alpha}, \qquad M = N\,v\,l\cos\alpha.",
    ("arm", True): (
        r"N = \frac{\xi}{l\cos\alpha - \sigma f_1\,(l\sin\alpha - r)}, \qquad "
        r"M = v\,\xi + f_1\,N\,w."
    ),
    ("swinging face", False): r"N = \frac{\xi}{q}, \qquad M = v\,\xi, \qquad q = \frac{c\cos\psi}{1 + \sigma v}.",
    ("swinging face", True): (
        r"N = \frac{\xi}{q + \sigma f_1 f}, \qquad M = v\,\xi + f_1\,N\,w, \qquad "
        r"q = \frac{c\cos\psi}{1 + \sigma v}."
    ),
}
"""Normal force and torque, by what the force moves, and whether there is friction at the cam."""


def forces(solution: Solution) -> list[Block]:
    """The chapter on normal force and torque: formulas, extremes, and the values at the stations."""
    spring = _spring(solution)
    mean, most, fewest = spring.torques
    least, greatest = spring.forces.min_normal(), spring.max_normal
    rubs = say(
        "Between cam and follower there is friction with $f_1 = {friction}$: the force $f_1 N$ acts along the "
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
    return [
        rubs if spring.friction else "",
        say("The cam pushes along the normal with $N$, and the torque on the shaft is $M$:"),
        Equation(NORMAL_FORCE[moved_part(spring.cam), bool(spring.friction)]),
        extremes,
        _at_stations(solution, spring),
    ]


def _at_stations(solution: Solution, spring: SpringDesign) -> Grid:
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
    return Grid(say("Forces at the stations"), header, rows)


def _zero(value: float) -> float:
    """A value; zero in place of a rounding error."""
    return round(value, 9) + 0.0


SHEAR_SHARE, SHEAR_DEPTH = 0.300, 0.786
"""The maximum shear stress under a line contact as a part of the maximum pressure, and its depth in half-widths."""
MODULUS = r"\frac{1}{E'} = \frac{1-\nu_1^2}{E_1} + \frac{1-\nu_2^2}{E_2},\qquad E' = <modulus>\ \text{<unit>}."
PRESSURE = r"p_0 = \sqrt{\frac{N E'}{\pi\,w\,R}},\qquad b = \sqrt{\frac{4 N R}{\pi\,w\,E'}},\qquad "
RELATIVE_RADIUS = {
    "roller": PRESSURE + r"\frac{1}{R} = \frac{1}{\varrho} + \frac{1}{r}.",
    "face": PRESSURE + r"R = \varrho.",
}
IN_NUMBERS = (
    r"p_0 = \sqrt{\frac{<force> \cdot <modulus>}{\pi \cdot <width> \cdot <relative>}} = <stress>\ \text{<unit>}."
)
SHAPES = {
    "convex": say("There the profile is convex with a radius of $\\varrho = {radius}$ mm."),
    "concave": say("There the profile is concave with a radius of $|\\varrho| = {radius}$ mm; $\\varrho$ is negative."),
    "flat": say("There the profile is straight: $\\varrho$ is infinite."),
}
NO_STRESS_REASONS = {
    "knife edge": say(
        "The follower has a knife edge. It touches the cam along a line without width, so by Hertz the pressure "
        "is infinite under any force: there is no finite stress to compare. Give the follower a roller."
    ),
    "undercut": say("The profile is undercut and ends in an edge: there is no finite stress to compare."),
    "no force": say("Nothing presses the follower onto the cam, so there is no stress."),
}


def contact_stress(solution: Solution) -> list[Block]:
    """The chapter on contact stress: the forces, the maximum stress, and whether it is permitted."""
    stress = solution.stress
    assert stress is not None
    given = say(
        "Cam and follower touch over a width of $w = {width:g}$ mm; $E_1 = {young1:g}$ MPa and $\\nu_1 = {poisson1:g}$ "
        "are those of the cam, $E_2 = {young2:g}$ MPa and $\\nu_2 = {poisson2:g}$ those of the follower.",
        width=stress.material.width,
        young1=stress.material.young_cam,
        young2=stress.material.young_follower,
        poisson1=stress.material.poisson_cam,
        poisson2=stress.material.poisson_follower,
    )
    modulus = Equation(formula(MODULUS, modulus=number(stress.material().modulus, 0), unit=unit("MPa")))
    if stress.without:
        said = NO_STRESS_REASONS[stress.without]
        return [given, modulus, warning(said) if stress.without != "no force" else said]
    return [given, modulus, *_stress_blocks(stress)]


def _stress_blocks(stress: StressDesign) -> list[Block]:
    roller = stress.forces.cam.roller_radius
    at, greatest = stress.contact, stress.max_pressure
    assert at is not None
    assert greatest is not None
    force, half_width, radius = float(at.force), float(at.half_width), float(at.profile_radius)
    modulus = stress.material().modulus
    relative = modulus * half_width / 2 / greatest.value
    law = say(
        "By Hertz the force $N$ along the normal flattens a strip of half-width $b$; the pressure has its "
        "maximum in the middle:"
    )
    where = say(
        "The pressure has its maximum {at}, where $N = {force}$ N.",
        at=at_side(greatest, stress.forces.cam.motion),
        force=number(force, 1),
    )
    in_numbers = formula(
        f"$${IN_NUMBERS}$$",
        force=number(force, 1),
        modulus=number(modulus, 0),
        width=general(stress.material.width),
        relative=number(relative, 3),
        stress=number(greatest.value, 1),
        unit=unit("MPa"),
    )
    below = say(
        "The strip is {strip} mm wide. The maximum shear stress, {share:.2f} of that pressure or {shear} MPa, "
        "lies {depth} mm below the surface: there pitting begins.",
        strip=number(2 * half_width, 3),
        share=SHEAR_SHARE,
        shear=number(SHEAR_SHARE * greatest.value, 1),
        depth=number(SHEAR_DEPTH * half_width, 3),
    )
    kind = "roller" if roller else "face"
    shape = SHAPES[stress.shape].with_values(**numbers(radius=abs(radius)))
    return [law, Equation(RELATIVE_RADIUS[kind]), where, shape, in_numbers, below, *_verdict(stress)]


def _verdict(stress: StressDesign) -> list[Caption]:
    """The sentences on whether the stress is permitted, and on the width that it needs."""
    limit = stress.material.permitted_stress
    if limit is None or stress.max_pressure is None or stress.min_width is None:
        return []
    values = {"limit": limit, "width": number(rounded_up(stress.min_width))}
    if stress.permitted:
        kept = say("{limit:g} MPa are permitted: a contact {width} mm wide would be enough.")
        return [kept.with_values(**values)]
    return [
        warning(
            say("Only {limit:g} MPa are permitted. A contact {width} mm wide satisfies this.").with_values(**values)
        )
    ]
