"""The stress between cam and follower as a diagram over the turn."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from graphcam.constructions.axes import axes_over_phi, degrees_below, phase_ends, phase_symbol, reach
from graphcam.constructions.force_plan import round_scale
from graphcam.constructions.graduation import graduated
from graphcam.drafting.euclid import UP
from graphcam.drafting.ink import Caption, Construction, Step, View, say
from graphcam.drafting.marks import Dots, Label, Line, Mark, Points, Role, Segments
from graphcam.drafting.meaning import Meaning
from graphcam.drafting.scale import Scale
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN, Motion
from graphcam.mechanism.stationary import ValueAt
from graphcam.solving.spring_design import WIDTH

MEANING = Meaning(
    "contact_stress",
    say("Contact stress"),
    say("Cam and follower touch in a narrow strip. The pressure in its middle decides how long the surfaces last."),
    calculation="report.stress_note.contact_stress",
)
VIEW = View("contact stress", say("Contact stress p₀"), across="stress phi", up="contact stress")
STRESS = say(
    "The pressure in the middle of the contact by Hertz, from the force along the normal and the curvatures of profile "
    "and follower, at {mu:g} MPa/mm."
)
OVER = say("{curve} The dashed line is the permitted stress; above it the curve is marked.", curve=STRESS)
UNDER = say("{curve} The dashed line is the permitted stress.", curve=STRESS)
"""What is said of the curve."""


@dataclass(frozen=True, eq=False)
class StressOverTurn:
    """What is drawn: the stress (n,) [MPa] over cam angles (n,) [rad], its greatest, and what is permitted [MPa]."""

    motion: Motion
    phi: Floats
    stress: Floats
    greatest: ValueAt
    permitted: float | None


def stress_steps(drawn: Construction[StressOverTurn]) -> list[Step]:
    """The stress over the cam angle, where it is greatest, and what is permitted."""
    turn = drawn.givens
    greatest, limit, motion = turn.greatest, turn.permitted, turn.motion
    scale, mu_phi = round_scale(max(greatest.value, limit or 0.0)), Scale(FULL_TURN / WIDTH, "rad")
    points = turn.phi / mu_phi.per_mm + UP * turn.stress / scale.per_mm
    heights = points.imag if limit is None else np.append(points.imag, limit / scale.per_mm)
    (low, high), ends = reach(heights), phase_ends(motion, mu_phi)
    axes = (
        *axes_over_phi(WIDTH, mu_phi, heights, say("p₀, MPa")),
        *graduated(heights, scale.per_mm),
        *degrees_below(WIDTH, mu_phi, low),
        Segments(ends[1:] + low * UP, ends[1:] + high * UP, Role.CONSTRUCTION),
        *(
            Label(complex((a + b) / 2), phase_symbol(motion, k), towards=-UP, small=True)
            for k, (a, b) in enumerate(pairwise(ends))
        ),
    )
    top = greatest.phi / mu_phi.per_mm + UP * greatest.value / scale.per_mm
    most = (Dots(np.array([top]), Role.LIMIT), Label(top, in_mpa(greatest.value), towards=UP))
    permitted = [] if limit is None else _permitted(points, limit / scale.per_mm, limit)
    mu = {"mu": scale.per_mm}
    view = replace(VIEW, title=say("Contact stress p₀, μ = {mu:g} MPa/mm", **mu))
    said = replace(STRESS, values=mu)
    if limit is not None:
        said = (UNDER if greatest.value <= limit else OVER).where(curve=said)
    marks = (*axes, Line(points, Role.RESULT), *permitted, *most)
    return [Step(say("The contact stress over the turn"), said, view, marks, given=axes)]


def _permitted(points: Points, height: float, limit: float) -> list[Mark]:
    """The permitted stress, and the parts of the curve that lie above it."""
    level = np.array([0.0, WIDTH]) + height * UP
    marks: list[Mark] = [Line(level, Role.HIDDEN), Label(complex(WIDTH, height), in_mpa(limit), towards=1, small=True)]
    above = points.imag > height
    starts = np.flatnonzero(np.diff(np.concatenate([[False], above, [False]]).astype(int)))
    return [*marks, *(Line(points[a:b], Role.LIMIT) for a, b in starts.reshape(-1, 2).tolist() if b - a > 1)]


def in_mpa(stress: float) -> Caption:
    """A stress with its unit."""
    return say("{stress:.4g} MPa", stress=stress)
