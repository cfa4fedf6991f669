"""The note's chapter on the stress between cam and follower."""

from graphcam.drafting.units import unit
from graphcam.report.markdown import blocks, formula, number, numbers
from graphcam.report.paragraphs import general, warning
from graphcam.solving.solution import Solution
from graphcam.solving.stress_design import StressDesign, rounded_up
from graphcam.solving.turn_diagrams import at_side
from graphcam.words import Caption, say

SHEAR, DEPTH = 0.300, 0.786
"""The greatest shear stress under a line contact as a part of the peak pressure, and its depth in half-widths."""
MODULUS = r"$$\frac{1}{E'} = \frac{1-\nu_1^2}{E_1} + \frac{1-\nu_2^2}{E_2},\qquad E' = <modulus>\ \text{<unit>}.$$"
PRESSURE = r"$$p_0 = \sqrt{\frac{N E'}{\pi\,w\,R}},\qquad b = \sqrt{\frac{4 N R}{\pi\,w\,E'}},\qquad "
RELATIVE = {
    "roller": PRESSURE + r"\frac{1}{R} = \frac{1}{\varrho} + \frac{1}{r}.$$",
    "face": PRESSURE + r"R = \varrho.$$",
}
IN_NUMBERS = (
    r"$$p_0 = \sqrt{\frac{<force> \cdot <modulus>}{\pi \cdot <width> \cdot <relative>}} = <stress>\ \text{<unit>}.$$"
)
SHAPES = {
    "convex": say("There the profile is convex with a radius of $\\varrho = {radius}$ mm."),
    "concave": say("There the profile is concave with a radius of $|\\varrho| = {radius}$ mm; $\\varrho$ is negative."),
    "flat": say("There the profile is straight: $\\varrho$ is infinite."),
}
WITHOUT = {
    "knife edge": say(
        "The follower has a knife edge. It touches the cam along a line without width, so by Hertz the pressure "
        "is infinite under any force: there is no finite stress to compare. Give the follower a roller."
    ),
    "undercut": say("The profile is undercut and ends in an edge: there is no finite stress to compare."),
    "no force": say("Nothing presses the follower onto the cam, so there is no stress."),
}


def contact_stress(solution: Solution) -> str:
    """What presses how hard, the greatest stress, and whether it is permitted."""
    stress, tell = solution.stress, solution.tell
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
    modulus = formula(MODULUS, modulus=number(stress.material().modulus, 0), unit=unit("MPa"))
    if stress.without:
        said = WITHOUT[stress.without]
        return blocks(given, modulus, warning(said) if stress.without != "no force" else said, tell=tell)
    return blocks(given, modulus, *_found(stress), tell=tell)


def _found(stress: StressDesign) -> list[Caption]:
    """The greatest stress, and the verdict."""
    roller = stress.forces.cam.roller_radius
    at, greatest = stress.contact, stress.greatest
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
        IN_NUMBERS,
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
        share=SHEAR,
        shear=number(SHEAR * greatest.value, 1),
        depth=number(DEPTH * half_width, 3),
    )
    kind = "roller" if roller else "face"
    shape = SHAPES[stress.shape].where(**numbers(radius=abs(radius)))
    return [law, formula(RELATIVE[kind]), where, shape, in_numbers, below, *_verdict(stress)]


def _verdict(stress: StressDesign) -> list[Caption]:
    """Whether the stress is permitted, and what width it takes."""
    limit = stress.material.permitted_stress
    if limit is None or stress.greatest is None or stress.least_width is None:
        return []
    values = {"limit": limit, "width": number(rounded_up(stress.least_width))}
    if stress.permitted:
        kept = say("{limit:g} MPa are permitted: a contact {width} mm wide would be enough.")
        return [kept.where(**values)]
    return [
        warning(say("Only {limit:g} MPa are permitted. A contact {width} mm wide satisfies this.").where(**values)),
    ]
