"""The answer to "views": a task drawn in the views that are asked for, with what is said of it."""

import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, TypeVar

from graphcam.constructions.views import COMBINED
from graphcam.language import Language, language
from graphcam.report.documents import scene_of
from graphcam.report.mechanism_view import mechanism_view
from graphcam.sheets.formats import Lettering
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.solution import Solution
from graphcam.solving.task_board import format_of
from graphcam.studio.drawn_views import DrawnView, digest, drawn_view, key_of
from graphcam.studio.handle import Changes
from graphcam.studio.handles import MECHANISM_VIEW, dragged, handles_of
from graphcam.studio.held_solutions import (
    DragHold,
    diagrams_of,
    has_far_centre,
    held_solution,
    hold_of,
    scales_of,
    station_of,
)
from graphcam.studio.sizes_form import form_of
from graphcam.studio.studio_values import compared_quantities, given_sizes, sizes, values, warnings
from graphcam.studio.task_paths import changed_task
from graphcam.studio.view_steps import StepsData, ViewName, ViewSteps, steps_data, view_steps
from graphcam.studio.views_request import AskedView, ViewsRequest, views_request
from graphcam.studio.what_if import swept_fields

T = TypeVar("T")
Plain = dict[str, Any]


STATE_PATHS = "phi", "station"
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


def moved_task(request: ViewsRequest, hold: DragHold | None) -> MovedTask:
    """The solution of a request's task, its handle dragged if one is.

    Raises
    ------
    GraphcamError : the task has no solution, or no such handle
    """

    def with_changes(changes: Changes) -> AnySolution:
        """The solution with other sizes; what is only shown changes nothing."""
        sizes: dict[str, Any] = {path: value for path, value in changes.items() if path not in STATE_PATHS}
        task = changed_task(request.task, sizes) if sizes else request.task
        return held_solution(task, request.language, hold, changes.get("station", request.station))

    if request.drag is None:
        return MovedTask(with_changes({}), {}, request.phi, request.station)
    grabbed = with_changes({})
    changes, solution = dragged(grabbed, request.drag, with_changes, request.phi)
    return MovedTask(solution, changes, changes.get("phi", request.phi), changes.get("station", request.station))


@dataclass
class Clock:
    """How long the parts of an answer took [ms of the processor]."""

    ms: dict[str, float] = field(default_factory=dict[str, float])

    def timed(self, name: str, work: Callable[[], T]) -> T:
        """What some work comes to."""
        start = time.process_time()
        done = work()
        self.ms[name] = round(self.ms.get(name, 0.0) + 1e3 * (time.process_time() - start), 2)
        return done


def views_answer(data: Mapping[str, Any]) -> Plain:
    """The answer to a request of views.

    Raises
    ------
    GraphcamError : a senseless request, or a task that has no solution
    """
    request, clock = views_request(data), Clock()
    spoken, hold = language(request.language), hold_of(request.hold) if request.hold else None
    moved = clock.timed("construct", lambda: moved_task(request, hold))
    solution = moved.solution
    known = clock.timed("construct", lambda: _steps(solution, request, hold))
    asked = [view for view in request.views if view.name in known.views]
    told = clock.timed("told", lambda: _steps_of_request(request, known, asked, spoken))
    drawn = clock.timed("svg", lambda: _drawn_views(solution, known, asked, spoken, hold))
    plain = clock.timed("svg", lambda: [_view(view, drawn[key_of(view)], known, told, spoken) for view in asked])
    names = hold.names if hold else known.names(spoken.text)
    # What cannot be drawn is not offered: else it would be refused where it is looked at.
    if not hold and has_far_centre(solution):
        names = tuple(each for each in names if each.name != COMBINED.name)
    return {
        "changes": moved.changes,
        "names": [asdict(each) for each in names],
        "views": plain,
        **clock.timed("exact", lambda: _numbers(solution, known, request, spoken)),
        "sizes": given_sizes(solution) if request.upto else sizes(solution),
        "form": form_of(solution, spoken.text) if request.form and not request.upto else [],
        "swept": swept_fields(solution, spoken.text) if request.form and not request.upto else [],
        "handles": clock.timed("handles", lambda: _handles(moved, asked, request, spoken)),
        # What is kept tells scales and accelerations, and where nothing is dragged nothing need be kept.
        "hold": None if request.upto else _kept_hold(solution, known, drawn, names, hold).plain(),
        "station": moved.station,
        "stations": [round(math.degrees(phi), 3) for phi in _stations(solution)],
        "degrees_per_mm": math.degrees(solution.chain.board.mu_phi.per_mm),
        "ms": clock.ms,
    }


def _stations(solution: AnySolution) -> Sequence[float]:
    """The cam angles [rad] at which a velocity plan may be drawn, in the order of the stations."""
    return solution.chain.board.stations.phi.tolist() if isinstance(solution, Solution) else []


def _steps(solution: AnySolution, request: ViewsRequest, hold: DragHold | None) -> ViewSteps:
    """The steps that are drawn: at rest all of them, while the hand is down those of the views that are asked for."""
    needs = hold.needs(key_of(view) for view in request.views) if hold and not request.told else None
    if needs is None:
        return view_steps(solution, upto=request.upto)
    return view_steps(solution, needs[0] | needs[1], needs[1], request.upto)


def _handles(moved: MovedTask, asked: Iterable[AskedView], request: ViewsRequest, spoken: Language) -> list[Plain]:
    """The handles of the views that are asked for, and of the mechanism with it; an exercise has none."""
    if request.upto:
        return []
    views = [*(view.name for view in asked), *([MECHANISM_VIEW] if request.mechanism else [])]
    return handles_of(moved.solution, views, spoken.text, moved.phi)


def _steps_of_request(
    request: ViewsRequest, known: ViewSteps, asked: Iterable[AskedView], spoken: Language
) -> StepsData | None:
    return steps_data(known, {view.name for view in asked if not view.plain}, spoken.text) if request.told else None


def _drawn_views(
    solution: AnySolution, known: ViewSteps, asked: Sequence[AskedView], spoken: Language, hold: DragHold | None
) -> dict[str, DrawnView]:
    """The views that are asked for, by what they are kept by."""
    paper: Lettering = format_of(solution.task.drawing).lettering
    held = hold.views if hold else {}
    found: dict[str, DrawnView] = {}
    for view in asked:
        key, name = key_of(view), view.name
        constructions, steps = (known.drawing_in(name), known.settling(name)), known.of_view(name)
        lowest = view is asked[-1]
        found[key] = drawn_view(steps, constructions, view, paper, spoken.text, held.get(key), lowest=lowest)
    return found


def _view(asked: AskedView, drawn: DrawnView, known: ViewSteps, told: StepsData | None, spoken: Language) -> Plain:
    """A view as plain data; of a step that the page has already only its hash, and of a plain view nothing is told."""
    told = None if asked.plain else told
    svg = drawn.svg(told.acts.shown_by if told else None)
    steps: dict[str, Plain] = {}
    for each, _ in drawn.steps:
        found = digest(svg[each.id])
        new = {} if asked.have.get(each.id) == found else {"svg": svg[each.id]}
        steps[each.id] = {"hash": found, **new, **(told.plain(each) if told else {})}
    title = spoken.text(drawn.steps[-1][0].step.view.title)
    shown = {
        "name": asked.name,
        "title": title,
        "plain": asked.plain,
        "ordinate": known.ordinate(asked.name, spoken.text),
    }
    return {**shown, "frame": drawn.frame, "order": list(steps), "steps": steps}


def _numbers(solution: AnySolution, known: ViewSteps, request: ViewsRequest, spoken: Language) -> Plain:
    """What is asked for in numbers; of an exercise no more than is read in the constructions that are shown."""
    quantities = solution.comparison.quantities if request.values else {}
    if request.upto:
        there = compared_quantities(known.drawn)
        kept = {name: quantity for name, quantity in quantities.items() if name in there}
        return {"values": values(kept, spoken), "warnings": [], "scales": {}, "mechanism": None}
    return {
        "values": values(quantities, spoken),
        "warnings": warnings(solution, spoken) if request.warnings else [],
        "scales": solution.scales if request.hold is None else {},
        "mechanism": mechanism_view(scene_of(solution), spoken.text, spoken.decimal) if request.mechanism else None,
    }


def _kept_hold(
    solution: AnySolution,
    known: ViewSteps,
    drawn: Mapping[str, DrawnView],
    names: tuple[ViewName, ...],
    hold: DragHold | None,
) -> DragHold:
    """What the next answer may keep of this one; what was held before stays held."""
    former = hold or DragHold()
    shown = {name: view.mu_l for name, view in known.views.items() if view.mu_l}
    scales = former.scales if hold else scales_of(solution, shown)
    of_motion = diagrams_of(solution) if isinstance(solution, Solution) else None
    views = {**former.views, **{key: view.kept for key, view in drawn.items()}}
    station = former.station if hold else station_of(known.drawn)
    return DragHold(scales, former.diagrams if hold else of_motion, station, views, names)
