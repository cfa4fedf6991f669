"""The step-by-step notebook of a task."""

import nbformat.v4 as nb
from nbformat import NotebookNode

from graphcam.drafting.units import unit
from graphcam.notebooks.running import PYTHON
from graphcam.report import markdown
from graphcam.report.sheet_contents import all_drawn
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solve import solve
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.sheet_tables import UNNAMED
from graphcam.tasks.task import Task
from graphcam.tasks.task_writer import TASK_FILE, task_files
from graphcam.words import Tell, Words, say, say_in

FIRST = say(
    "Every construction of this cam, step by step: what is done, the drawing so far with the current step in "
    "colour, and the readings, as millimetres of paper times a scale. graphcam wrote this notebook from the task "
    "below."
)
CHECKED = say(
    "Draw it on paper and enter your readings here. Each cell answers with a hint; the tolerance allows for "
    "careful drawing by hand."
)
ERRORS = say(
    "An ideal pencil leaves only the error of the method: curves are replaced by chords, and between stations a "
    "smooth curve is drawn. This error falls with the square of the number of parts. Drawing by hand adds errors "
    "of line position (0.1 to 0.2 mm), dividers (0.1 to 0.3 mm), rule (0.5 mm) and protractor (0.5°), and each "
    "error is passed on to everything drawn from it. With more parts the method becomes more exact and the "
    "drawing errors grow."
)
MOVED = say("More parts, fewer parts: what changes, and which is worth the work?")
QUESTIONS = say(
    "1. Which reading decides the size of this cam, and how would you make it more exact?\n2. What changes on the "
    "drawing if the cam turns the other way?\n3. Where does the acceleration jump, and what happens in the "
    "mechanism there?\n4. Which of the drawn values would you trust to 1 %, and which not even to 10 %?"
)
SETUP = f"""\
import graphcam as gc
from graphcam.notebooks import Question, Slider, changed, compared, drawing, explore, player, show_steps

task = gc.load_task("{TASK_FILE}")
solution = gc.solve(task)
tell = task.drawing.tell"""
PARTS = """\
def with_parts(parts):
    finer = gc.solve(changed(task, {{"drawing.divisions": parts}}))
    return drawing(finer.drawn["{construction}"], "{view}", tell=tell)

explore(with_parts, parts=Slider("{parts}", {values}, {start}, {shown}))"""


def write_notebook(task: Task | ArcsTask) -> NotebookNode:
    """The notebook of a task, to be executed beside its :func:`task_files`.

    >>> import graphcam as gc
    >>> notebook = write_notebook(gc.builtin_task("flat"))
    >>> [cell.source.splitlines()[0] for cell in notebook.cells if cell.source.startswith("## ")][:3]
    ['## The task', '## 1. Kinematic diagram', '## 2. Acceleration diagram']

    Raises
    ------
    DesignError : there is no such cam
    """
    return notebook_of(solve(task))


def notebook_of(solution: AnySolution) -> NotebookNode:
    """The same of a task that is solved, with all that its chain draws.

    >>> import graphcam as gc
    >>> notebook_of(gc.solve(gc.builtin_task("flat"))) == write_notebook(gc.builtin_task("flat"))
    True
    """
    toml, tell, title = task_files(solution.task)[TASK_FILE], solution.tell, notebook_title(solution.task)
    warned = (say("**Note:** {warning}", warning=markdown.text(sentence)) for sentence in solution.warnings)
    cells = [
        _text(f"# {markdown.text(title)}\n\n{tell(FIRST)}"),
        _section(tell, say("The task"), f"```toml\n{toml.strip()}\n```"),
        _hidden(SETUP),
        *(_text(f"> {tell(warning)}") for warning in warned),
        *(cell for number, name in enumerate(all_drawn(solution), 1) for cell in _chapter(number, name, solution)),
        _section(tell, say("Try it yourself"), CHECKED),
        *(cell for name in _asked(solution) for cell in _question(solution, name)),
        _section(tell, say("Move the sliders"), MOVED),
        _hidden(_parts(solution)),
        _section(tell, say("Drawn and exact"), say("Error and bound are in millimetres on paper.")),
        _hidden("compared(solution)"),
        _section(tell, say("Where the error comes from"), ERRORS),
        _section(tell, say("The sheet, step by step")),
        _hidden("player(solution)"),
        _section(tell, say("Questions"), QUESTIONS),
    ]
    # Without random names a notebook that is written anew is the same.
    for k, cell in enumerate(cells):
        cell["id"] = f"cell-{k}"
    return nb.new_notebook(cells=cells, metadata={"title": title, **PYTHON})


def notebook_title(task: Task | ArcsTask) -> str:
    """What the notebook of a task is called: as its sheet."""
    tell = task.drawing.tell
    return task.title.told_name(tell) or tell(UNNAMED)


def _text(source: str) -> NotebookNode:
    return nb.new_markdown_cell(source)


def _section(tell: Tell, title: Words, *paragraphs: Words) -> NotebookNode:
    return _text(markdown.blocks(f"## {tell(title)}", *map(tell, paragraphs)))


def _hidden(source: str) -> NotebookNode:
    return nb.new_code_cell(source, metadata={"tags": ["remove-input"], "jupyter": {"source_hidden": True}})


def _chapter(number: int, name: str, solution: AnySolution) -> list[NotebookNode]:
    """Number, title, why and steps of a construction of the solution, or of its spring."""
    meaning = all_drawn(solution)[name].meaning
    title = say("{number}. {title}", number=number, title=meaning.title)
    of = "solution" if name in solution.drawn else "solution.spring"
    # Its rays are drawn in the combined diagram.
    on = ', on=solution.drawn["minimum_radius"]' * (name == "pressure_angle")
    shown = _hidden(f'show_steps({of}.drawn["{name}"], within=solution{on})')
    return [_section(solution.tell, title, meaning.why), shown]


def _asked(solution: AnySolution) -> list[str]:
    """The quantities that a reader of the drawing is asked for."""
    asked = ("max_v", "minimum_prime_radius", "max_pressure_angle_rise_deg", "min_pitch_curvature_radius", "lift")
    quantities = solution.comparison.quantities
    return [name for name in asked if name in quantities and quantities[name].drawn == quantities[name].drawn]


def _question(solution: AnySolution, name: str) -> list[NotebookNode]:
    q = solution.comparison.quantities[name]
    question = f'Question.about(solution.comparison.quantities["{name}"], tell)'
    source = f"your_{name} = None  # {solution.tell(unit(q.unit))}\n{question}.check(your_{name})"
    return [nb.new_code_cell(source, metadata={"tags": ["try-it"]})]


def _parts(solution: AnySolution) -> str:
    """A slider for the number of parts, on the drawing that shows them best."""
    arcs = isinstance(solution, ArcsSolution)
    construction, view = ("arc_diagrams", "acceleration") if arcs else ("integration", "displacement")
    start = solution.task.drawing.divisions
    values, shown = sorted({2, 4, 8, 12, 24, start}), tuple(sorted({4, start}))
    parts = solution.tell(say_in("of a slider", "parts"))
    return PARTS.format(construction=construction, view=view, values=values, start=start, shown=shown, parts=parts)
