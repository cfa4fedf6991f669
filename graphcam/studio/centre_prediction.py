"""Where the cam centre comes to lie: on the line of the offset, on the circle about the pivot, below the crossing.

A guess is judged as the construction would judge it: the pressure angles of a cam with its centre there are drawn.
"""

import math

import numpy as np

from graphcam.constructions.axes import station_names
from graphcam.constructions.chain import Chain
from graphcam.drafting.euclid import UP
from graphcam.drafting.marks import Points
from graphcam.drafting.pencil import Pencil
from graphcam.errors import DesignError
from graphcam.studio.guesses import PENCIL_LINE, JudgedGuess, Prediction, shown_steps, steps_in
from graphcam.words import Caption, say, sequence

SHOWN_STEPS = 2
"""The number of steps of the region that are drawn before: what is laid off, and the curve; then come the limits."""
GUESS_RANGE = 1.7
"""The guess may move so many times as far as the lift is high, or as the centre lies away."""
CURVE_POINTS = 73
"""The number of points of a curve on which the guess moves."""
LEAST_RADIUS_NAME = say("minimum prime radius")


def centre_foretold(chain: Chain) -> Prediction:
    """The prediction of the cam centre with the least radius.

    >>> import graphcam as gc
    >>> asked = centre_foretold(gc.solve(gc.builtin_task()).chain)
    >>> asked.view, len(asked.given), round(asked.judge(16.67 - 60j).machine, 2)
    ('combined', 2, -5.92)
    """
    region = chain.minimum_radius
    flat = _by_curvature(chain)
    view = region.steps()[0].view.name
    steps = steps_in(chain, "minimum_radius", view)
    construct = [step for step in shown_steps(chain, "minimum_radius") if step.step not in steps[:SHOWN_STEPS]]
    origin = complex(region.acts["start"].first.place) if _about_pivot(chain) else 0j
    answer = complex((region.acts["A"] if flat else region.acts["centre"]).first.place)
    mu = region.readings["prime_radius"].per_mm

    def judged(guess: complex) -> JudgedGuess:
        radius = abs(guess - origin) * mu
        difference = radius - abs(answer - origin) * mu
        near = abs(guess - answer) <= PENCIL_LINE
        why = _convex(chain, radius) if flat else _permitted(chain, guess, origin, mu, near)
        said = _answer_caption(radius, difference, abs(guess - answer))
        return JudgedGuess(answer, abs(guess - answer), difference, "mm", LEAST_RADIUS_NAME, said, why)

    way, free = _way(chain, answer, origin)
    start = complex(way.mean()) if free else complex(way[4 * len(way) // 5])
    return Prediction(_question(chain, free), view, steps[:SHOWN_STEPS], construct, way, start, judged, free)


def _about_pivot(chain: Chain) -> bool:
    """Whether the cam centre is sought about a pivot: then its distance is read."""
    return "distance" in chain.minimum_radius.readings


def _by_curvature(chain: Chain) -> bool:
    """Whether it is the curvature of the profile that asks for a radius."""
    return "need" in chain.minimum_radius.readings


def _question(chain: Chain, free: bool) -> Caption:
    if _by_curvature(chain):
        return say(
            "How far below the axis of a does the cam centre A lie, if the radius of curvature of the "
            "profile is just permitted?"
        )
    if free:
        return say(
            "Where does the cam centre A lie, if the limits are satisfied and the prime radius is as small as possible?"
        )
    if _about_pivot(chain):
        return say("Where on the circle about the pivot does the cam centre A lie for the minimum prime radius?")
    return say("Where on the line of the offset does the cam centre A lie for the minimum prime radius?")


def _way(chain: Chain, answer: complex, origin: complex) -> tuple[Points, bool]:
    """The way on which the guess moves, and whether it is free between two corners."""
    region, follower = chain.minimum_radius, chain.board.follower
    if _by_curvature(chain):
        height = float(region.acts["displacements"].first.shown.imag.max())
        return _line_downwards(GUESS_RANGE * _round_up(max(height, abs(answer)))), False
    places = region.acts["tips" if _about_pivot(chain) else "ends"].first.shown
    size = _round_up(max(float(np.ptp(places.imag)), abs(answer - origin)))
    if follower.place is None:
        corners = origin + np.array([-size - GUESS_RANGE * size * UP, size + 0j])
        return corners, True
    if _about_pivot(chain):
        # From the line of B₀ downwards: the cam lies below the arm.
        radius, towards = abs(answer), math.pi
        turns = np.linspace(0.0, min(1.2, GUESS_RANGE * size / radius), CURVE_POINTS)
        return np.exp(1j * (towards + turns)) * np.complex128(radius), False
    return answer.real + _line_downwards(GUESS_RANGE * size), False


def _line_downwards(length: float) -> Points:
    return np.linspace(0.0, -length, 6) * np.complex128(UP)


def _round_up(mm: float) -> float:
    """A round length, so that the line does not tell where it ends."""
    return 20.0 * math.ceil(mm / 20)


def _answer_caption(radius: float, difference: float, paper: float) -> Caption:
    if paper <= PENCIL_LINE:
        return say("Your A lies on the cam centre: {paper:.1f} mm off on paper.", paper=paper)
    apart = say("Your A lies {paper:.1f} mm from the cam centre on paper.", paper=paper)
    more = (
        say("Its prime radius of {radius:.1f} mm is {difference:.1f} mm larger than the minimum.")
        if difference >= 0
        else say("Its prime radius of {radius:.1f} mm is {difference:.1f} mm smaller than the minimum.")
    ).with_values(radius=radius, difference=abs(difference))
    return sequence([apart, more], " ")


def _permitted(chain: Chain, guess: complex, origin: complex, mu: float, near: bool) -> Caption:
    """What the pressure angles of a cam with its centre there come to."""
    if near:
        return say("A line at a permitted angle just touches what was laid off: higher up, a limit is exceeded.")
    worst = _worst_station(chain, guess, origin, mu)
    if worst is None:
        return say("The follower cannot be in this position: the prime circle does not reach its line of motion.")
    station, angle, limit = worst
    values = {"station": station, "angle": math.degrees(angle), "limit": math.degrees(limit)}
    if angle > limit:
        said = say(
            "From there the pressure angle at station {station} would be {angle:.1f}°, more than the {limit:.1f}° "
            "permitted, so A must lie farther away."
        )
        return said.with_values(**values)
    said = say(
        "From there all limits are satisfied, with {angle:.1f}° of {limit:.1f}° at station {station}. But they "
        "are also satisfied nearer to B₀: the cam would be larger than necessary."
    )
    return said.with_values(**values)


def _worst_station(chain: Chain, guess: complex, origin: complex, mu: float) -> tuple[str, float, float] | None:
    """The station that is nearest to its limit or passes it most, its angle and the limit [rad]; None without a cam."""
    board, integrated, limits = chain.board, chain.integration, chain.board.limits
    arm = _about_pivot(chain)
    place = abs(guess) * mu if arm else -guess.real * mu
    try:
        measured = board.follower.pressure_angle(integrated, board.rotation, abs(guess - origin) * mu, place, Pencil())
    except DesignError:
        return None
    alpha = np.asarray(measured.first("alpha"))
    rising = np.array([board.motion.phases[k].direction > 0 for k in board.stations.phase])
    angle = np.where(rising, alpha, -alpha if limits.return_ is not None else -np.inf)
    if limits.rest:
        angle = np.where(rising | (limits.return_ is not None), np.abs(alpha), angle)
    permitted = np.where(rising, limits.rise, limits.rise if limits.return_ is None else limits.return_)
    worst = int(np.nanargmax(angle - permitted)) if np.isfinite(angle - permitted).any() else None
    if worst is None:
        return None
    return station_names(board.stations)[worst], float(angle[worst]), float(permitted[worst])


def _convex(chain: Chain, radius: float) -> Caption:
    """What the least radius of curvature comes to under a flat face."""
    need = float(chain.minimum_radius.value("need"))
    least = chain.minimum_radius.givens.least_curvature
    rho = radius - need
    if rho < 0:
        said = say("Then r₀ + s + a would fall to {rho:.1f} mm: the profile would turn inside out and be cut away.")
    elif rho < least:
        said = say(
            "Then the radius of curvature would fall to ρ = {rho:.1f} mm, and {least:g} mm is the permitted minimum."
        )
    else:
        said = say("Then the minimum of ρ = r₀ + s + a is {rho:.1f} mm, and {least:g} mm is enough.")
    return said.with_values(rho=rho, least=least)
