"""The documents that a solution gets, whichever kind of task it solves."""

from graphcam.report.arcs_report import arcs_contents, arcs_note
from graphcam.report.given_profile_scale import check_profile_hopeful, check_profile_size
from graphcam.report.mechanism_scene import MechanismScene, arcs_scene, cam_scene
from graphcam.report.note import note
from graphcam.report.note_page import note_page
from graphcam.report.sheet_contents import Contents, motion_contents
from graphcam.sheets.layout import compose_parts
from graphcam.sheets.model import Drawing
from graphcam.sheets.runs import TooLargeError
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.sheet_papers import format_of
from graphcam.solving.solution import Solution
from graphcam.solving.task_board import check_given_sizes


def sheet_of(solution: AnySolution, upto: int | str | None = None, *, per_construction: bool = False) -> Drawing:
    """The sheets: finished, or drawn up to a step.

    upto : the last step that is drawn, its number or the name of the construction that it ends; of what follows only
        axes, divisions and what the task gives stands there, in its place.  0 for a blank worksheet,
        which may be laid over the finished sheet.
    per_construction : every construction on sheets of its own, with what was drawn before in the same views

    Raises
    ------
    DesignError : there is no such step or construction, or a view fits no page of the format at the scale that is given

    >>> import graphcam as gc
    >>> blank, finished = sheet_of(gc.solve(gc.builtin_task()), 0), sheet_of(gc.solve(gc.builtin_task()))
    >>> len(blank.pages) == len(finished.pages), len(blank.pages[0].groups) < len(finished.pages[0].groups)
    (True, True)
    """
    return drawing_of(contents_of(solution), upto, per_construction=per_construction)


def drawing_of(contents: Contents, upto: int | str | None = None, *, per_construction: bool = False) -> Drawing:
    """The same of contents that are at hand."""
    paper = contents.solution.task.drawing
    last = None if upto is None else contents.last_step(upto)
    drawn = contents.parts if per_construction else [contents.whole]
    try:
        return compose_parts(drawn, contents.title, format_of(paper), last, paper.tell)
    except TooLargeError:
        # What the task gives may be to blame: then it is named.
        if isinstance(contents.solution, Solution):
            check_profile_size(contents.solution)
            check_given_sizes(contents.solution.task)
        raise


def contents_of(solution: AnySolution) -> Contents:
    """What stands on the sheets.

    Raises
    ------
    DesignError : what the task gives makes diagrams, or the profile, far larger than a page
    """
    if isinstance(solution, ArcsSolution):
        return arcs_contents(solution)
    check_profile_hopeful(solution)
    return motion_contents(solution)


def note_of(solution: AnySolution) -> str:
    """The note in Markdown."""
    return arcs_note(solution) if isinstance(solution, ArcsSolution) else note(solution)


def note_page_of(solution: AnySolution) -> str:
    """The note as a page that prints."""
    return note_page(note_of(solution), solution.task.drawing.language)


def scene_of(solution: AnySolution) -> MechanismScene:
    """The mechanism over a turn."""
    return arcs_scene(solution) if isinstance(solution, ArcsSolution) else cam_scene(solution)
