"""Why no cam in the ranges keeps the limits: which of them cannot be met, and how near the nearest cam comes."""

from __future__ import annotations

import math
from typing import NoReturn

from graphcam.errors import DesignError
from graphcam.mechanism.sizing_limits import CURVATURE, NO_UNDERCUT, RETURN, RISE, SHARE, STRESS, Sizes
from graphcam.mechanism.sizing_problem import BINDS, SizingProblem
from graphcam.mechanism.sizing_search import nearest
from graphcam.words import Caption, Words, chained, say

ALIKE = 1e-3
"""Limits that the nearest cam exceeds by parts that differ by less stand in each other's way."""
MANY = say("no cam in the ranges keeps them all")


def refuse(problem: SizingProblem) -> NoReturn:
    """Say which limit no cam of the ranges keeps, or which of them not together, and where they come nearest.

    Raises
    ------
    DesignError : always
    """
    near = nearest(problem)
    left = problem.exact_margins(near)
    worst = min(left.values())
    together = [name for name in problem.limits.kept if left[name] <= worst + ALIKE and left[name] < -BINDS]
    for name in together:
        alone = nearest(problem, [name])
        if problem.exact_margins(alone)[name] < -BINDS:
            raise _error(problem, alone, [name], say("no cam in the ranges keeps it, even without the other limits"))
    raise _error(problem, near, together, say("no cam in the ranges keeps both") if len(together) == 2 else MANY)


def _error(problem: SizingProblem, near: Sizes, names: list[str], why: Words) -> DesignError:
    said = [_told(problem, near, name) for name in names]
    found, limit = map(chained, zip(*said, strict=True))
    sizes = zip(problem.ranges, problem.values(near), strict=True)
    at = ", ".join(f"{name} {value:.6g}" for name, value in sizes)
    remedy = say("{why}: the nearest has {at} mm; widen the ranges or permit more", why=why, at=at)
    return DesignError(chained(names), found, limit, remedy)


def _told(problem: SizingProblem, near: Sizes, name: str) -> tuple[Caption, Caption]:
    """What the cam has of a limit, and what is permitted."""
    limits = problem.limits
    if name in (RISE, RETURN):
        permitted = limits.rise if name == RISE else limits.return_ or math.inf
        steepness = math.tan(permitted) * (1 - problem.exact_margins(near)[name])
        return say("{degrees:.4g} degrees", degrees=math.degrees(math.atan(steepness))), say(
            "at most {degrees:.4g} degrees", degrees=math.degrees(permitted)
        )
    if name in (CURVATURE, SHARE):
        rho = problem.stress(near).forces.cam.extremes().min_convex_radius[0]
        kind = "rho" if name == CURVATURE else "r0"
        terms = [term for term in (*limits.rule, NO_UNDERCUT) if term.of == kind]
        most = min(terms, key=lambda term: term(rho, near.radius))
        least = say("{radius:.4g} mm of prime radius", radius=near.radius)
        if name == CURVATURE:
            least = say("{rho:.4g} mm of curvature", rho=rho)
        return say("a roller of {roller:.4g} mm on {least}", roller=near.roller, least=least), say(
            "a roller of at most {text}", text=most.text
        )
    assert name == STRESS
    stress = limits.stress * math.sqrt(problem.exact_width(near) / near.width)
    return say("{stress:.5g} MPa", stress=stress), say("at most {stress:.5g} MPa", stress=limits.stress)
