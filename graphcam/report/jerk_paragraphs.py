"""The note's paragraphs on the jerk: its scale, its values in the parts, and where it is infinite."""

import numpy as np

from graphcam.constructions.axes import degrees, part_names
from graphcam.constructions.time_axis import scale_at_speed
from graphcam.drafting.units import unit
from graphcam.given.impact import acceleration_jumps
from graphcam.report.markdown import blocks, formula, number, table
from graphcam.report.paragraphs import digits, general
from graphcam.solving.solution import Solution
from graphcam.words import Caption, say, sequence

SCALE = r"$$\mu_j = \frac{\mu_a}{\mu_\varphi H_3} = \frac{<mu_a>}{<mu_phi> \cdot <h3>} = <mu>\ \text{<of_j>}.$$"


def jerk(solution: Solution) -> str:
    """Pole, scale, the greatest value, all parts drawn and exact, and the places where the jerk is infinite."""
    c, board = solution.drawn["jerk"], solution.chain.board
    read, of_lift = c.readings["j"], board.follower.unit
    values = {
        "mu_a": general(solution.drawn["integration"].readings["a"].per_mm, 5),
        "mu_phi": number(board.mu_phi.per_mm, 6),
        "h3": general(c.givens.pole),
        "mu": general(read.per_mm, 5),
        "of_j": say("({unit}/rad³)/mm", unit=unit(of_lift)),
    }
    names, places = part_names(board.stations), digits(read.per_mm)
    rows = [
        (name, number(phi, 2), number(drawn, places), number(exact, places + 1))
        for name, phi, drawn, exact in zip(
            names,
            np.degrees(c.value("j_at")).tolist(),
            c.value("j").tolist(),
            solution.exact_jerk.tolist(),
            strict=True,
        )
    ]
    header = (say("part"), "φ", say("{name} drawn", name="j"), say("{name} exact", name="j"))
    return blocks(
        say(
            "The acceleration diagram that was drawn is differentiated by chords, each from station to station between "
            "jumps and corners of the acceleration, with a pole $H_3 = {h3}$ mm to the left of the origin:",
            **values,
        ),
        formula(SCALE, **values),
        *_greatest(solution),
        say("These are the jerks in the middles of the parts, in {unit}.", unit=unit(f"{of_lift}/rad³")),
        table(header, rows, solution.tell),
        _infinite(solution),
        tell=solution.tell,
    )


def _greatest(solution: Solution) -> list[Caption]:
    """The greatest finite jerk, at a speed over time too."""
    c, board = solution.drawn["jerk"], solution.chain.board
    of_lift, value = board.follower.unit, float(c.value("max_j"))
    said = [
        say(
            "The maximum finite jerk measures {mm} mm, which is {value} {unit}.",
            mm=number(float(c.first("max_j"))),
            value=number(value, digits(c.readings["j"].per_mm)),
            unit=unit(f"{of_lift}/rad³"),
        )
    ]
    if board.omega is not None:
        at = scale_at_speed(1.0, "j", board.omega, of_lift)
        at_speed = general(at.per_mm * value, 4)
        said.append(say("At the given speed it is {value} {unit}.", value=at_speed, unit=unit(at.unit)))
    return [sequence(said, " ")]


def _infinite(solution: Solution) -> Caption:
    """Where the acceleration jumps."""
    jumps = acceleration_jumps(solution.cam.motion)
    if not jumps:
        return say("The acceleration nowhere jumps: the jerk is finite everywhere.")
    return say(
        "Where the acceleration jumps, at {places}, the jerk is infinite; an arrow stands for it in the diagram. It "
        "cannot be read off: what counts there is the jump itself, told below with the kind of impact.",
        places=sequence([degrees(jump.phi) for jump in jumps]),
    )
