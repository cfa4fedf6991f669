"""The documents of a solution, whichever kind of task it solves, at a scale for which a page has room."""

import re
from contextlib import suppress
from dataclasses import replace
from functools import lru_cache
from html import escape
from importlib import resources

from graphcam.constructions.views import PROFILE
from graphcam.drafting.scale import ratio_text
from graphcam.errors import DesignError
from graphcam.report.arcs_report import arcs_contents, arcs_note
from graphcam.report.markdown import FORMULA_PATTERN
from graphcam.report.mechanism_view import MechanismScene, arcs_scene, cam_scene
from graphcam.report.note import note
from graphcam.report.own_scales import with_own_scales
from graphcam.report.sheet_contents import Contents, all_constructions, motion_contents, scaled_steps
from graphcam.sheets.layout import compose_pages
from graphcam.sheets.model import Drawing
from graphcam.sheets.page_filling import DIAGRAM_GAPS, SAME_COST, TooLargeError
from graphcam.sheets.page_space import fits_on_sheet
from graphcam.sheets.view_panels import panels
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solution import Solution, solved_on
from graphcam.solving.task_board import MAX_OVERSIZE, board_of, check_given_sizes, format_of, given_profile_scale
from graphcam.words import say

DECIMAL_COMMA = re.compile(r"<mn>(\d+)</mn><mrow><mo>&#x0002C;</mo></mrow><mn>(\d+)</mn>")
"""A decimal comma in MathML, which is no operator with a gap behind it."""
TAG = re.compile(r"\\tag\{(\d+)\}")
TABLE = re.compile("<table>(?=(.*?)</thead>)", re.DOTALL)
MIN_WIDE_COLUMNS = 7
"""The number of "<th" in the head of a table, its own among them, above which its letters are smaller."""


def mathml(latex: str, display: str = "inline") -> str:
    r"""A formula in LaTeX as MathML; display : "inline" or "block".

    >>> mathml(r"0{,}5")
    '<math xmlns="http://www.w3.org/1998/Math/MathML" display="inline"><mrow><mn>0,5</mn></mrow></math>'
    """
    # The engine of the studio runs where there is no such library.
    from latex2mathml.converter import convert

    return DECIMAL_COMMA.sub(r"<mn>\1,\2</mn>", convert(latex.strip(), display=display))


def note_page(note: str, language: str) -> str:
    """A note in Markdown as a page of HTML that stands alone.

    >>> page = note_page("# Cam\\n\\nWith $r$:\\n\\n$$s = r \\\\tag{1}$$\\n", "en")
    >>> "<h1>Cam</h1>" in page, page.count("<math"), '<span class="number">(1)</span>' in page
    (True, 2, True)
    """
    import mistune

    parts = FORMULA_PATTERN.split(note)
    source = "".join(_formula(part) if k % 2 else part for k, part in enumerate(parts))
    body = str(mistune.create_markdown(escape=False, plugins=["table"])(source))
    body = TABLE.sub(
        lambda found: '<table class="wide">' if found[1].count("<th") > MIN_WIDE_COLUMNS else "<table>", body
    )
    css = resources.files("graphcam").joinpath("data", "note", "note.css").read_text(encoding="utf-8")
    title = escape(re.sub(r"\\(.)", r"\1", note.partition("\n")[0].removeprefix("# ")))
    head = f'<meta charset="utf-8"><title>{title}</title>\n<style>\n{css}</style>'
    return f'<!DOCTYPE html>\n<html lang="{language}">\n<head>\n{head}\n</head>\n<body>\n{body}</body>\n</html>\n'


def _formula(tex: str) -> str:
    """The MathML of a formula between dollars: within a line, or on lines of its own with its number."""
    if not tex.startswith("$$"):
        return mathml(tex.strip("$"))
    tex = tex.strip("$")
    number = "".join(f'<span class="number">({found})</span>' for found in TAG.findall(tex))
    # What stands side by side may also stand one below the other.
    lines = "".join(mathml(r"\displaystyle " + part) for part in TAG.sub("", tex).split(r"\qquad"))
    return f'<div class="formula"><span class="lines">{lines}</span>{number}</div>'


def check_profile_size(solution: Solution) -> None:
    """Refuse a profile that no page can take at the scale that the task gives.

    A profile that is far too large is refused without being drawn, for its strokes alone would fill the memory.

    Raises
    ------
    DesignError : no page can take it

    >>> import graphcam as gc
    >>> task = gc.builtin_task()
    >>> check_profile_size(gc.solve(replace(task, drawing=replace(task.drawing, profile_scale="5:1"))))
    Traceback (most recent call last):
    graphcam.errors.DesignError: drawing.profile_scale is 5:1, but must be at most 2.5:1 on A1 landscape; take ...
    """
    task = solution.task
    if (given := given_profile_scale(task.drawing)) is None or _scale_fits(solution, given):
        return
    smaller = (1 / ratio for ratio in solution.chain.board.paper.ratios if 1 / ratio > given)
    largest = next(mu for mu in smaller if _scale_fits(solution, mu))
    value = ratio_text(given)
    limit = say(
        "at most {ratio_text} on {said}", ratio_text=ratio_text(largest), said=format_of(task.drawing).description
    )
    raise DesignError("drawing.profile_scale", value, limit, say("take a larger format, or leave it out"))


def check_profile_strokes(solution: Solution) -> None:
    """Refuse a profile that is so large that its strokes alone would fill the memory.

    Raises
    ------
    DesignError : it is so large
    """
    given = given_profile_scale(solution.task.drawing)
    if given is not None and _is_far_too_large(solution, given):
        check_profile_size(solution)


def _is_far_too_large(solution: Solution, per_mm: float) -> bool:
    """Whether a scale is many times that at which the profile fits its room."""
    board = board_of(replace(solution.task, drawing=replace(solution.task.drawing, profile_scale=None)))
    return MAX_OVERSIZE * per_mm < solved_on(board, solution.task).chain.profile_scale.per_mm


def _scale_fits(solution: Solution, per_mm: float) -> bool:
    if _is_far_too_large(solution, per_mm):
        return False
    board, sheet = solution.chain.board, format_of(solution.task.drawing)
    held = {**board.paper.held, PROFILE.name: per_mm}
    tried = solved_on(replace(board, paper=replace(board.paper, held=held)), solution.task)
    steps = (step for _, _, step in scaled_steps(all_constructions(tried)) if step.view.name == PROFILE.name)
    return all(fits_on_sheet(sheet, [panel], DIAGRAM_GAPS[-1]) for panel in panels(steps, sheet.lettering))


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
    return drawing_of(contents_of(solution, per_construction=per_construction), upto, per_construction=per_construction)


def drawing_of(contents: Contents, upto: int | str | None = None, *, per_construction: bool = False) -> Drawing:
    """The sheets of contents that are made already; see :func:`sheet_of`."""
    paper = contents.solution.task.drawing
    last = None if upto is None else contents.last_step(upto)
    pages = contents.pages(per_construction=per_construction)
    try:
        return compose_pages(pages, contents.title, format_of(paper), last, paper.tell)
    except TooLargeError:
        # What the task gives may be to blame: then it is named.
        if isinstance(contents.solution, Solution):
            check_profile_size(contents.solution)
            check_given_sizes(contents.solution.task)
            _check_enlarged_radius(contents.solution)
        raise


def _check_enlarged_radius(solution: Solution) -> None:
    """Check that no roller, bore or permitted curvature asks for a prime radius whose views fit no page.

    Raises
    ------
    DesignError : one does
    """
    chain, task = solution.chain, solution.task
    if len(chain.trials) < 2:
        return
    roller, permitted = chain.board.roller_radius or 0.0, chain.board.min_profile_radius or 0.0
    first, bore = chain.trials[0], task.part and task.part.bore
    if bore and first.too_thin > first.too_sharp:
        field, size = "part.bore", bore
    else:
        field = "follower.roller_radius" if roller >= permitted else "limits.min_curvature_radius"
        size = max(roller, permitted)
    sheet = format_of(task.drawing).description
    limit = say("small enough for a cam whose views fit on {sheet}", sheet=sheet)
    remedy = say("the prime radius found for it is {radius:g} mm", radius=chain.prime_radius)
    raise DesignError(field, say("{length:g} mm", length=size), limit, remedy)


@lru_cache(maxsize=2)
def contents_of(solution: AnySolution, *, per_construction: bool = False) -> Contents:
    """The contents of the sheets of a solution, in the largest standard scales for which their pages have room.

    Its solution is drawn in these.  The last are kept, for the command line and the files ask for the same.

    Raises
    ------
    DesignError : with the sizes in the task, diagrams or the profile are far larger than a page
    """
    if isinstance(solution, ArcsSolution):
        return arcs_contents(solution)
    check_profile_strokes(solution)
    contents = motion_contents(solution)
    with suppress(TooLargeError):
        pages = contents.pages(per_construction=per_construction)
        if (redrawn := with_own_scales(solution, pages)) is not solution:
            larger = motion_contents(redrawn)
            # Tables may have moved to where they leave a page half empty.
            cost = sum(each.cost for each in larger.pages(per_construction=per_construction))
            return larger if cost <= sum(each.cost for each in pages) + SAME_COST else contents
    return contents


def note_of(solution: AnySolution) -> str:
    """The note of a solution in Markdown."""
    return arcs_note(solution) if isinstance(solution, ArcsSolution) else note(solution)


def note_page_of(solution: AnySolution) -> str:
    """The note of a solution as a page of HTML for printing."""
    return note_page(note_of(solution), solution.task.drawing.language)


def scene_of(solution: AnySolution) -> MechanismScene:
    """The mechanism of a solution over a turn."""
    return arcs_scene(solution) if isinstance(solution, ArcsSolution) else cam_scene(solution)
