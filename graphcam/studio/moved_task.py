"""The task of a request as it is drawn: with the sizes that a dragged handle gives it."""

from dataclasses import dataclass
from typing import Any

from graphcam.solving.arcs_solution import AnySolution
from graphcam.studio.handle import Changes
from graphcam.studio.handles import dragged_within
from graphcam.studio.held_board import solved
from graphcam.studio.hold import Hold
from graphcam.studio.request import ViewsRequest
from graphcam.studio.task_paths import changed

SHOWN = "phi", "station"
"""What a handle may change that is no size of the task."""


@dataclass(frozen=True)
class MovedTask:
    """A task as it is drawn, with the sizes of a dragged handle.

    solution : of the task with the changes
    changes : by the dragged handle, by their paths
    phi, station : the cam angle [degrees] and the station that are shown
    """

    solution: AnySolution
    changes: Changes
    phi: float
    station: int | None


def moved_task(request: ViewsRequest, hold: Hold | None) -> MovedTask:
    """The solution of a request's task, its handle dragged if one is.

    Raises
    ------
    GraphcamError : the task has no solution, or no such handle
    """

    def with_changes(changes: Changes) -> AnySolution:
        """The solution with other sizes; what is only shown changes nothing."""
        sizes: dict[str, Any] = {path: value for path, value in changes.items() if path not in SHOWN}
        task = changed(request.task, sizes) if sizes else request.task
        return solved(task, request.language, hold, changes.get("station", request.station))

    if request.drag is None:
        return MovedTask(with_changes({}), {}, request.phi, request.station)
    grabbed = with_changes({})
    changes, solution = dragged_within(grabbed, request.drag, with_changes, request.phi, request.station)
    return MovedTask(solution, changes, changes.get("phi", request.phi), changes.get("station", request.station))
