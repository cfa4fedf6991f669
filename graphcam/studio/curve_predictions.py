"""Places on curves: how great the pressure angle becomes and where, and where the cam is sharpest."""

import cmath
import math

import numpy as np
from numpy.typing import NDArray

from graphcam.constructions.axes import station_names
from graphcam.constructions.chain import Chain
from graphcam.constructions.views import ANGLE, COMBINED, PROFILE, VELOCITY
from graphcam.drafting.marks import Points
from graphcam.given.follower import sense
from graphcam.given.laws import Floats
from graphcam.given.motion import FULL_TURN
from graphcam.solving.solution import Solution
from graphcam.studio.guesses import PENCIL_LINE, JudgedGuess, Prediction, nearest_on_polyline, shown_steps, steps_in
from graphcam.words import Caption, say, sequence

MAX_RAY_ANGLE = math.radians(75)
"""The ray turns so far from the motion."""
RAY_LENGTH_SHARE = 0.95
"""The length of the ray, in parts of the height from A to the end of the lift."""
CURVE_POINTS = 76
ALPHA_NAME = say("pressure angle α")
PHI_NAME = say("cam angle φ")
TURN_PLACES = 721
"""The number of places of the turn: every half degree."""
SAME_SHARPNESS = 0.005
"""What is less sharp by no more than this part is as sharp: an arc of a dwell is so all along."""
RHO_NAME = say("radius of curvature ρ")


def angle_foretold(chain: Chain) -> Prediction:
    """How far the ray with the greatest pressure angle of the rise leans.

    >>> import graphcam as gc
    >>> asked = angle_foretold(gc.solve(gc.builtin_task()).chain)
    >>> asked.view, round(asked.judge(asked.start).machine, 2)
    ('combined', -29.68)
    """
    measured, sigma = chain.pressure_angle, sense(chain.board.rotation)
    centre, ends = complex(measured.first("centre")), measured.acts["ends"].first.shown
    alpha = np.where(_rising_stations(chain), measured.first("alpha"), -np.inf)
    k, radius = int(np.argmax(alpha)), RAY_LENGTH_SHARE * float((ends - centre).imag.max())
    greatest = float(alpha[k])
    answer = centre + cmath.rect(radius, math.pi / 2 + sigma * greatest)

    def judged(guess: complex) -> JudgedGuess:
        lean = sigma * (cmath.phase(guess - centre) - math.pi / 2)
        difference = math.degrees(lean - greatest)
        paper = abs(complex(ends[k]) - centre) * abs(lean - greatest)
        said = _by_degrees(difference, math.degrees(lean), paper)
        return JudgedGuess(answer, paper, difference, "deg", ALPHA_NAME, said, _outermost(chain, k))

    steps = steps_in(chain, "pressure_angle", COMBINED.name)
    given = [*steps_in(chain, "minimum_radius", COMBINED.name)[:2], *steps[:-1]]
    construct = [step for step in shown_steps(chain, "pressure_angle", COMBINED.name) if step.step == steps[-1]]
    way = centre + radius * np.exp(1j * (math.pi / 2 + sigma * np.linspace(0.0, MAX_RAY_ANGLE, CURVE_POINTS)))
    question = say("At what angle to the motion is the ray from A that shows the maximum pressure angle of the rise?")
    return Prediction(question, COMBINED.name, given, construct, way, complex(way[0]), judged, pole=centre)


def _rising_stations(chain: Chain) -> NDArray[np.bool_]:
    return np.array([chain.board.motion.phases[k].direction > 0 for k in chain.board.stations.phase])


def _by_degrees(difference: float, lean: float, paper: float) -> Caption:
    if paper <= PENCIL_LINE:
        return say("Your ray at {lean:.1f}° shows the maximum pressure angle to within a pencil line.", lean=lean)
    said = (
        say(
            "Your ray at {lean:.1f}° is {difference:.1f}° too far from the motion, {paper:.1f} mm on paper at "
            "the end of v."
        )
        if difference > 0
        else say(
            "Your ray at {lean:.1f}° is {difference:.1f}° too close to the motion, {paper:.1f} mm on paper "
            "at the end of v."
        )
    )
    return said.with_values(lean=lean, difference=abs(difference), paper=paper)


def _outermost(chain: Chain, k: int) -> Caption:
    measured = chain.pressure_angle
    end = complex(measured.acts["ends"].first.shown[k]) - complex(measured.first("centre"))
    said = say(
        "The outermost ray goes to station {station}: the end of v lies {across:.1f} mm beside A and {up:.1f} mm above "
        "it, so tan α = {across:.1f}/{up:.1f}. A lower A, or one nearer to the side of v, makes the ray steeper."
    )
    return said.with_values(station=station_names(chain.board.stations)[k], across=abs(end.real), up=end.imag)


def steepest_foretold(chain: Chain) -> Prediction:
    """The prediction of the cam angle of the rises at which the pressure angle is greatest.

    >>> import graphcam as gc
    >>> asked = steepest_foretold(gc.solve(gc.builtin_task()).chain)
    >>> asked.view, round(asked.judge(30 + 0j).machine, 2)
    ('velocity', -10.0)
    """
    integrated, angles, per_mm = chain.integration, chain.angle_diagram, math.degrees(chain.board.mu_phi.per_mm)
    curve, rising = integrated.acts["v_curve"].first.shown, _rising_stations(chain)
    top = complex(angles.first("max_rise"))

    def on_curve(x: float) -> complex:
        """The place of the curve of v over a cam angle [mm of paper]."""
        return complex(x, float(np.interp(x, curve.real[rising], curve.imag[rising])))

    def judged(guess: complex) -> JudgedGuess:
        difference, paper = (guess.real - top.real) * per_mm, abs(guess.real - top.real)
        beside = {ANGLE.name: (guess.real + 0j, top.real + 0j)}
        said, why = _by_phi(difference, guess.real * per_mm, paper), _where_steep(chain, guess.real, curve, rising)
        return JudgedGuess(on_curve(top.real), paper, difference, "deg", PHI_NAME, said, why, beside)

    given = steps_in(chain, "integration", VELOCITY.name)
    way = curve[rising]
    question = say("Where on the rise does the pressure angle have its maximum?")
    construct = shown_steps(chain, "angle_diagram", ANGLE.name)
    return Prediction(question, VELOCITY.name, given, construct, way, complex(way[1]), judged)


def _by_phi(difference: float, phi: float, paper: float) -> Caption:
    if paper <= PENCIL_LINE:
        return say("Your point at φ = {phi:.1f}° is the maximum to within a pencil line.", phi=phi)
    said = (
        say("Your point at φ = {phi:.1f}° is {difference:.1f}° too late, {paper:.1f} mm on paper.")
        if difference > 0
        else say("Your point at φ = {phi:.1f}° is {difference:.1f}° too early, {paper:.1f} mm on paper.")
    )
    return said.with_values(phi=phi, difference=abs(difference), paper=paper)


def _where_steep(chain: Chain, x: float, curve: Points, rising: NDArray[np.bool_]) -> Caption:
    """The angles there and at the greatest, and where the velocity is greatest."""
    top, per_mm = complex(chain.angle_diagram.first("max_rise")), math.degrees(chain.board.mu_phi.per_mm)
    drawn = chain.angle_diagram.acts["curve"].first.shown[rising]
    fastest = float(curve[rising].real[np.argmax(curve[rising].imag)])
    told = say(
        "There α is {here:.1f}°; at φ = {phi:.1f}° it is {greatest:.1f}°.",
        here=float(np.interp(x, drawn.real, drawn.imag)) * per_mm,
        phi=top.real * per_mm,
        greatest=top.imag * per_mm,
    )
    apart = (top.real - fastest) * per_mm
    reason = say("The angle is due to the velocity, whose maximum is so sharp here that the two coincide.")
    if apart <= -1:
        reason = say(
            "The angle is due to the velocity, and a low position of the follower enlarges it: so α has its "
            "maximum {apart:.1f}° before v."
        )
    elif apart >= 1:
        reason = say(
            "The angle is due to the velocity, and here the position of the arm shifts its maximum to "
            "{apart:.1f}° after that of v."
        )
    return sequence([told, reason.with_values(apart=abs(apart))], " ")


# --- where the cam is sharpest ----------------------------------------------------------------------------------------


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
        said = _by_radius(paper, float(radii[here]), difference)
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


def _by_radius(paper: float, radius: float, difference: float) -> Caption:
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
