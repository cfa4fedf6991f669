"""The handles of the views of a solution, and what becomes of the sizes when one is dragged."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, TypeVar

from graphcam.constructions.views import ACCELERATION, ANGLE, COMBINED, DISPLACEMENT, PLAN, PROFILE, REGION, VELOCITY
from graphcam.errors import DesignError, GraphcamError
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solution import Solution
from graphcam.studio import handles_diagrams as diagrams, handles_profile as profile, handles_region as region
from graphcam.studio.handle import Changes, Handle, phi_axis, place_of
from graphcam.words import Tell, say

MECHANISM_VIEW = "mechanism"
"""The view of the turning mechanism, which the page draws itself."""
WAY_HALVINGS = 7
"""Halvings of the way of a hand that goes where there is no design."""
Solved = TypeVar("Solved")


def handles_of(solution: AnySolution, views: Sequence[str], tell: Tell, phi: float = 0.0) -> list[dict[str, Any]]:
    """The handles of some views as the page reads them: see :class:`~graphcam.studio.handle.Handle`.

    phi : cam angle [degrees];  tell : says captions in the language of the page

    >>> import graphcam as gc
    >>> [handle["id"] for handle in handles_of(gc.solve(gc.builtin_task()), ["combined"], str)]
    ['combined/A', 'combined/tangent rise', 'combined/D']
    """
    found = (handle for view in views for handle in _of_view(solution, view, phi % 360.0))
    return [handle.plain(tell) for handle in found if math.isfinite(abs(handle.at))]


def dragged(
    solution: AnySolution,
    drag: Mapping[str, Any],
    solve: Callable[[Changes], Solved],
    phi: float = 0.0,
) -> tuple[Changes, Solved]:
    """The sizes, by their paths, to which a handle is dragged: ``{"handle", "to": [x, y], "fine"}``.

    A hand that goes on to where there is no design is followed to the last one on its way.

    solution : of the task at which the hand took hold;  phi : cam angle [degrees], as it was then
    solve : the solution with some changes, or a GraphcamError
    returns : the changes, on a step or a magnet, within their ranges, "phi" or "station" for what is no size; and the
        solution with them

    Raises
    ------
    DesignError : there is no such handle, or no such place

    >>> import graphcam as gc
    >>> def no_larger(changes):
    ...     if changes.get("cam.prime_radius", 0.0) > 50.0:
    ...         raise DesignError("prime radius", changes["cam.prime_radius"], "at most 50 mm")
    ...     return "drawn"
    >>> dragged(gc.solve(gc.builtin_task()), {"handle": "profile/r0", "to": [0, 120]}, no_larger)
    ({'cam.prime_radius': 50.0}, 'drawn')
    """
    handle, to = _handle(solution, drag, phi % 360.0), place_of("drag.to", drag.get("to"))
    fine = bool(drag.get("fine", False))
    found: tuple[Changes, Solved] | None = None
    reached, beyond = 0.0, 2.0
    for _ in range(WAY_HALVINGS):
        share = (reached + beyond) / 2
        changes = handle.drag(handle.at + share * (to - handle.at), fine)
        try:
            found, reached = (changes, solve(changes)), share
        except GraphcamError:
            beyond = share
        if reached >= 1:
            break
    return ({}, solve({})) if found is None else found


def _handle(solution: AnySolution, drag: Mapping[str, Any], phi: float) -> Handle:
    name = str(drag.get("handle"))
    for handle in _of_view(solution, name.split("/")[0], phi):
        if handle.id == name and math.isfinite(abs(handle.at)):
            return handle
    raise DesignError("drag.handle", name[:40], say("one of the view's handles"))


def _of_view(solution: AnySolution, view: str, phi: float) -> Iterator[Handle]:
    """The handles of a view, each made when it is come to."""
    if view == MECHANISM_VIEW:
        # The page knows how far it was turned.
        yield Handle(view, "phi", say("Cam angle φ"), 0j, "turn", (phi_axis(phi),), lambda to, fine: {})
    elif isinstance(solution, ArcsSolution):
        yield from profile.of_arcs(solution, view, phi)
    elif view in (ACCELERATION.name, VELOCITY.name, DISPLACEMENT.name):
        yield from diagrams.of_diagram(solution, view, phi)
    elif view in VIEW_HANDLES and VIEW_HANDLES[view][0] in solution.chain.names:
        yield from VIEW_HANDLES[view][1](solution, phi)


VIEW_HANDLES: dict[str, tuple[str, Callable[[Solution, float], Iterator[Handle]]]] = {
    ANGLE.name: ("angle_diagram", diagrams.of_angles),
    COMBINED.name: ("minimum_radius", region.of_combined),
    REGION.name: ("minimum_radius", region.of_positions),
    PROFILE.name: ("inversion", profile.of_profile),
    PLAN.name: ("pressure_angle", region.station),
}
"""The construction that a view needs, and its handles."""
