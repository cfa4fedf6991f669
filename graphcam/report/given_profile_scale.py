"""A scale of the profile that the task gives: refused where no page takes the profile at it."""

from dataclasses import replace

from graphcam.constructions.views import PROFILE
from graphcam.drafting.scale import ratio_text
from graphcam.errors import DesignError
from graphcam.report.sheet_contents import all_drawn, scaled_steps
from graphcam.sheets.leaves import fits
from graphcam.sheets.panels import panels
from graphcam.sheets.runs import GAPS
from graphcam.solving.sheet_papers import format_of
from graphcam.solving.solution import Solution, solved_on
from graphcam.solving.task_board import HOPELESS, board_of, given_profile_scale
from graphcam.words import say


def check_profile_size(solution: Solution) -> None:
    """That a page takes the profile at the scale that the task gives.

    A profile that is far too large is refused without being drawn, for its strokes alone would fill the memory.

    Raises
    ------
    DesignError : none does

    >>> import graphcam as gc
    >>> task = gc.builtin_task()
    >>> check_profile_size(gc.solve(replace(task, drawing=replace(task.drawing, profile_scale="5:1"))))
    Traceback (most recent call last):
    graphcam.errors.DesignError: drawing.profile_scale is 5:1, but must be at most 2.5:1 on A1 landscape; take ...
    """
    task = solution.task
    if (given := given_profile_scale(task.drawing)) is None or _fits(solution, given):
        return
    smaller = (1 / ratio for ratio in solution.chain.board.paper.ratios if 1 / ratio > given)
    largest = next(mu for mu in smaller if _fits(solution, mu))
    value = ratio_text(given)
    limit = say("at most {ratio_text} on {said}", ratio_text=ratio_text(largest), said=format_of(task.drawing).said)
    raise DesignError("drawing.profile_scale", value, limit, say("take a larger format, or leave it out"))


def check_profile_hopeful(solution: Solution) -> None:
    """The same of a profile that is so large that its strokes alone would fill the memory.

    Raises
    ------
    DesignError : it is
    """
    given = given_profile_scale(solution.task.drawing)
    if given is not None and _hopeless(solution, given):
        check_profile_size(solution)


def _hopeless(solution: Solution, per_mm: float) -> bool:
    """Whether a scale is many times that at which the profile fits its room."""
    board = board_of(replace(solution.task, drawing=replace(solution.task.drawing, profile_scale=None)))
    return HOPELESS * per_mm < solved_on(board, solution.task).chain.profile_scale.per_mm


def _fits(solution: Solution, per_mm: float) -> bool:
    """Whether a page takes the profile at a scale [mm/mm]."""
    if _hopeless(solution, per_mm):
        return False
    board, sheet = solution.chain.board, format_of(solution.task.drawing)
    held = {**board.paper.held, PROFILE.name: per_mm}
    tried = solved_on(replace(board, paper=replace(board.paper, held=held)), solution.task)
    steps = (step for _, _, step in scaled_steps(all_drawn(tried)) if step.view.name == PROFILE.name)
    return all(fits(sheet, [panel], GAPS[-1]) for panel in panels(steps, sheet.lettering))
