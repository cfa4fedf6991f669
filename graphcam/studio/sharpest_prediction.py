"""Where the cam is sharpest: the place of the least radius of curvature on the curve of the cam."""

import math

import numpy as np

from graphcam.constructions.views import PROFILE
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.solving.solution import Solution
from graphcam.studio.guesses import PENCIL_LINE, JudgedGuess, Prediction, nearest_on_polyline, shown_steps, steps_in
from graphcam.words import Caption, say, sequence

TURN_PLACES = 721
"""The number of places of the turn: every half degree."""
SAME_SHARPNESS = 0.005
"""What is less sharp by no more than this part is as sharp: an arc of a dwell is so all along."""
RHO_NAME = say("radius of curvature ρ")


def sharpest_foretold(solution: Solution) -> Prediction:
    """Predict where the radius of curvature is least: on the pitch curve, under a flat face on the profile.

    >>> import graphcam as gc
    >>> asked = sharpest_foretold(gc.solve(gc.builtin_task()))
    >>> asked.view, asked.judge(asked.start).machine > 10
    ('profile', True)
    """
    chain, cam = solution.chain, solution.cam
    phi = np.linspace(0.0, FULL_TURN, TURN_PLACES)
    xy, mu = cam.pitch_curve(phi), chain.inversion.readings["radius"].per_mm
    way = (xy[:, 0] + 1j * xy[:, 1]) / mu
    least, at = cam.extremes().min_convex_radius
    radii = _convex_radii(cam.pitch_curvature(phi), cam.kinematics.takes_roller)
    sharp = np.flatnonzero(radii <= least + SAME_SHARPNESS * abs(least))
    places = way[sharp] if sharp.size else way[[np.argmin(np.abs(phi - at))]]

    def judged(guess: complex) -> JudgedGuess:
        answer = complex(places[np.argmin(np.abs(places - guess))])
        here = int(np.argmin(np.abs(way - nearest_on_polyline(way, guess))))
        paper, difference = abs(guess - answer), float(radii[here]) - least
        said = _answer_caption(paper, float(radii[here]), difference)
        return JudgedGuess(
            answer, paper, difference, "mm", RHO_NAME, said, _explanation(solution, float(phi[here]), least, at)
        )

    steps = steps_in(chain, "inversion", PROFILE.name)
    question = (
        say("Where on the convex parts of the pitch curve is the cam sharpest?")
        if cam.kinematics.takes_roller
        else say("Where on the profile is the cam sharpest?")
    )
    # Under a flat face the radius is read off the region's own drawing.
    before = [] if cam.kinematics.takes_roller else shown_steps(chain, "minimum_radius")
    construct = [*before, *shown_steps(chain, "curvature")]
    return Prediction(
        question, PROFILE.name, steps, construct, way, complex(way[np.argmax(cam.motion(phi)[0])]), judged
    )


def _convex_radii(curvature: Floats, hollows: bool) -> Floats:
    """Radii of curvature; infinite in a hollow, where no roller is too large for the outside."""
    with np.errstate(divide="ignore"):
        return np.where(curvature > 0, 1 / curvature, math.inf) if hollows else 1 / curvature


def _answer_caption(paper: float, radius: float, difference: float) -> Caption:
    if paper <= PENCIL_LINE:
        return say("Your point is the sharpest: {paper:.1f} mm off on paper.", paper=paper)
    apart = say("Your point is {paper:.1f} mm from the sharpest one on paper.", paper=paper)
    if math.isinf(radius):
        return sequence([apart, say("There the curve is concave.")], " ")
    there = say("There ρ is {radius:.1f} mm, {difference:.1f} mm more.", radius=radius, difference=max(difference, 0.0))
    return sequence([apart, there], " ")


def _explanation(solution: Solution, phi: float, least: float, at: float) -> Caption:
    """The accelerations at the guess and at the sharpest place."""
    here, there = (float(solution.cam.motion(np.array(angle))[2]) for angle in (phi, at))
    said = say(
        "A negative acceleration, a < 0, bends the curve more sharply; a positive one makes it flatter, or "
        "concave. At your point a = {here:.3g} {unit}, at φ = {phi:.1f}° it is {there:.3g} {unit}, and ρ = "
        "{least:.2f} mm."
    )
    unit = solution.chain.integration.readings["a"].unit
    said = said.with_values(here=here, there=there, unit=unit, phi=math.degrees(at), least=least)
    if math.isclose(here, there, rel_tol=SAME_SHARPNESS):
        alike = say("Where a is the same, the point nearer to the cam centre is sharper.")
        return sequence([said, alike], " ")
    return said
