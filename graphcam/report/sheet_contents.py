"""The contents of the sheets of a solution: finished, half done, or a blank worksheet."""

import math
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import count

import numpy as np

from graphcam.drafting.ink import Construction, Step, say
from graphcam.drafting.scale import ratio_text, unit
from graphcam.errors import DesignError, suggestion
from graphcam.mechanism.cam import Cam
from graphcam.report.sheet_data import comparison, conditions_on_sheet, data, phases_at_speed
from graphcam.sheets.layout import Numbered, PagesOfPart, SheetPart
from graphcam.sheets.sheet_frame import TitleBlock
from graphcam.sheets.tables import Table
from graphcam.solving.arcs_solution import AnySolution
from graphcam.solving.solution import Solution
from graphcam.solving.task_board import MAX_OVERSIZE, check_given_sizes, format_of
from graphcam.tasks.sheet_tables import TitleTable
from graphcam.words import Tell

MAX_LIFT_RATIO = 1000
"""The maximum lift as a multiple of the prime radius; with more the paper would be as long as a hall."""


@dataclass(frozen=True, eq=False)
class Contents:
    """The contents of the sheets of a solution.

    drawn : the constructions by name
    steps : (number, name of the construction, step), in order
    givens, results : tables that stand with the first construction, and with the last
    """

    solution: AnySolution
    title: TitleBlock
    drawn: Mapping[str, Construction]
    steps: Numbered
    givens: tuple[Table, ...]
    results: tuple[Table, ...]

    @cached_property
    def numbers(self) -> Mapping[int, str]:
        """The number of each step within the task, such as "3.2", by its running number."""
        return chapter_numbers(self.steps)

    def last_step(self, upto: int | str) -> int:
        """The running number of the last step that is drawn; it may be named as within the task, "3.2".

        Raises
        ------
        DesignError : there is no such step or construction
        """
        last = {name: number for number, name, _ in self.steps}
        known = last | {said: number for number, said in self.numbers.items()}
        if isinstance(upto, str) and upto in known:
            return known[upto]
        if isinstance(upto, int) and 0 <= upto <= len(self.steps):
            return upto
        limit = say("a number of steps from 0 to {steps}, or one of {names}, or a step such as 2.1")
        limit = limit.with_values(steps=len(self.steps), names=", ".join(last))
        raise DesignError("upto", upto, limit, suggestion(str(upto), last))

    @property
    def as_one_part(self) -> SheetPart:
        """All contents as one part."""
        return SheetPart(self.steps, self.givens + self.results, tuple(self.solution.warnings), self.numbers)

    @property
    def parts(self) -> list[SheetPart]:
        """A part for each construction that draws something, with what was drawn before in its views."""
        drawing = list(dict.fromkeys(name for _, name, step in self.steps if step.marks))
        return [self._part(name, first=name == drawing[0], last=name == drawing[-1]) for name in drawing]

    def pages(self, *, per_construction: bool = False) -> list[PagesOfPart]:
        """The pages of all contents, or of each construction; what has been found on them is kept."""
        return self._pages_by_construction if per_construction else self._pages_of_all

    @cached_property
    def _pages_of_all(self) -> list[PagesOfPart]:
        return self._laid_out([self.as_one_part])

    @cached_property
    def _pages_by_construction(self) -> list[PagesOfPart]:
        return self._laid_out(self.parts)

    def _laid_out(self, parts: Iterable[SheetPart]) -> list[PagesOfPart]:
        drawing = self.solution.task.drawing
        return [PagesOfPart(format_of(drawing), part.translated(drawing.tell)) for part in parts]

    def _part(self, construction: str, *, first: bool, last: bool) -> SheetPart:
        own = [(number, step) for number, name, step in self.steps if name == construction]
        views = {step.view.name for _, step in own if step.marks}
        shown = tuple(row for row in self.steps if row[0] <= own[-1][0] and row[2].view.name in views)
        tables = (self.givens if first else ()) + (self.results if last else ())
        return SheetPart(shown, tables, tuple(self.solution.warnings) if last else (), self.numbers)


def chapter_numbers(steps: Numbered) -> dict[int, str]:
    """The number of each step within the task by its running number: "3.2" is the second of the third construction.

    >>> import graphcam as gc
    >>> from graphcam.report.documents import contents_of
    >>> list(chapter_numbers(contents_of(gc.solve(gc.builtin_task("flat"))).steps).values())[:3]
    ['1.1', '2.1', '2.2']
    """
    chapters, taken = chapters_of(name for _, name, _ in steps), Counter[str]()
    numbers = dict[int, str]()
    for number, name, _ in steps:
        taken[name] += 1
        numbers[number] = f"{chapters[name]}.{taken[name]}"
    return numbers


def chapters_of(names: Iterable[str]) -> dict[str, int]:
    """The numbers of chapters, by the names of their constructions in order."""
    return {name: k for k, name in enumerate(dict.fromkeys(names), 1)}


def all_constructions(solution: AnySolution) -> dict[str, Construction]:
    """All constructions of a solution by name, in the order in which they are shown: chain, then additions."""
    return {name: construction_named(solution, name) for name in names_of(solution)}


def names_of(solution: AnySolution) -> list[str]:
    """The names of all constructions of a solution, in the order in which they are shown; nothing is drawn for it."""
    return [*solution.drawn, *_added_constructions(solution)]


def construction_named(solution: AnySolution, name: str) -> Construction:
    """The construction of a solution by its name."""
    return solution.drawn[name] if name in solution.drawn else _added_constructions(solution)[name]


def _added_constructions(solution: AnySolution) -> Mapping[str, Construction]:
    """The constructions that a spring, the materials and the tolerances add, by name."""
    return {name: drawn for added in drawn_by_design(solution).values() for name, drawn in added.items()}


def drawn_by_design(solution: AnySolution) -> dict[str, Mapping[str, Construction]]:
    """What a spring, the materials and the tolerances add, by the names that they have in the solution."""
    if not isinstance(solution, Solution):
        return {}
    designs = {"spring": solution.spring, "stress": solution.stress, "tolerances": solution.tolerances}
    return {name: design.drawn for name, design in designs.items() if design}


def motion_contents(solution: Solution) -> Contents:
    """The contents of its sheets: every construction, the data, the scales, and drawn against exact values.

    Raises
    ------
    DesignError : the lift is too small to be drawn beside the cam
    """
    _check_drawable(solution.cam)
    check_given_sizes(solution.task, MAX_OVERSIZE)
    drawn = all_constructions(solution)
    results = [comparison(solution.comparison.quantities)]
    if solution.spring:
        results.append(solution.spring.table())
    if solution.stress:
        results.append(solution.stress.table())
    if solution.tolerances:
        results.append(solution.tolerances.table())
    title = title_block(solution.task.title, solution.tell, solution.task.drawing.remark)
    given = data(solution), phases_at_speed(solution), *conditions_on_sheet(solution)
    return Contents(solution, title, drawn, scaled_steps(drawn), given, tuple(results))


def _check_drawable(cam: Cam) -> None:
    """Refuse a lift and a prime radius that cannot both be seen at one scale."""
    still = np.zeros(2)
    low, high = cam.kinematics.point((np.array([0.0, cam.motion.lift]), still, still, still)).tolist()
    travel = abs(high - low)
    if cam.prime_radius > MAX_LIFT_RATIO * travel:
        limit = say("at most {most} times the lift of {travel:g} mm, to be drawn at one scale with it")
        limit = limit.with_values(most=MAX_LIFT_RATIO, travel=travel)
        found = say("{length:g} mm", length=cam.prime_radius)
        raise DesignError(say("prime radius"), found, limit, say("check the units of both"))


def title_block(title: TitleTable, tell: Tell = str, remark: str = "") -> TitleBlock:
    """The title block from the task's table, with a remark below it."""
    return TitleBlock(
        name=title.translated_name(tell),
        number=title.document,
        organisation=title.organisation,
        group=title.group,
        author=title.author,
        checked=title.checked,
        mass=title.mass,
        scale=title.scale,
        remark=remark,
    )


def scaled_steps(drawn: Mapping[str, Construction], silent: Collection[str] = ()) -> Numbered:
    """The steps of all constructions, in whose view titles the scales are filled in.

    silent : constructions that settle scales, but whose steps are not asked for
    """
    settled = {view: by for by in drawn.values() for view in by.meaning.scales}
    steps = steps_of({name: each for name, each in drawn.items() if name not in silent})
    return tuple((number, name, _with_scale_title(step, settled.get(step.view.name))) for number, name, step in steps)


def steps_of(drawn: Mapping[str, Construction]) -> Numbered:
    """The steps of all constructions, in order, with their running numbers."""
    numbers = count(1)
    return tuple((next(numbers), name, step) for name, each in drawn.items() for step in each.steps())


def scales_found(drawn: Mapping[str, Construction], steps: Numbered) -> dict[str, int]:
    """The running number of the step that finds the scale of a view, by view, where drawing finds it."""
    # A construction may settle the scale of a view that this task has not.
    seen = {step.view.name for _, _, step in steps}
    reading_in: dict[tuple[str, str], int] = {}
    for number, name, step in steps:
        for read in step.reads:
            reading_in.setdefault((name, read), number)
    return {
        view: reading_in[by.name, reading]
        for by in drawn.values()
        if by.meaning.scales_found_by
        for view, reading in by.meaning.scales.items()
        if view in seen and (by.name, reading) in reading_in
    }


def _with_scale_title(step: Step, by: Construction | None) -> Step:
    """The step with its view's title; the scale in it is an answer if drawing finds it."""
    # A view may have a scale of its own already.
    if by is None or step.view.mu_l is not None:
        return step
    view, read = step.view, by.readings[by.meaning.scales[step.view.name]]
    mu = read.per_mm
    values = {"unit": unit(read.unit), "degrees": math.degrees(mu), "ratio": ratio_text(mu)}
    if view.scale is not None:
        mu_l = mu if view.main else None
        view = replace(view, title=view.scale.with_values(mu=mu, **values), mu_l=mu_l)
    if found_by := by.meaning.scales_found_by:
        view = replace(view, answer=view.blank.with_values(mu=mu, **values), found_by=found_by)
    return replace(step, view=view)
