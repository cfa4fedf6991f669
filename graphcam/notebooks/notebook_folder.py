"""A folder with the notebook of a task, the task itself, and if asked for pages as HTML and PDF.

A page stands alone: formulas are MathML, figures inside, nothing is fetched.
"""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

import nbformat
import nbformat.v4 as nb
from nbconvert.exporters import HTMLExporter
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath
from nbformat import NotebookNode
from traitlets.config import Config

from graphcam.drafting.scale import unit
from graphcam.files import OutputError, whole_folder
from graphcam.notebooks.notebook_execution import PYTHON_METADATA, execute
from graphcam.report import markdown
from graphcam.report.documents import mathml
from graphcam.report.sheet_contents import all_constructions, drawn_by_design
from graphcam.solving.arcs_solution import AnySolution, ArcsSolution
from graphcam.solving.solve import solve
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.sheet_tables import DEFAULT_NAME
from graphcam.tasks.task import Task
from graphcam.tasks.task_writer import TASK_FILE, task_files
from graphcam.words import Tell, Words, bare_caption, say, say_in

TEMPLATE_FOLDER = Path(__file__).parent / "templates"
SHOWN_OUTPUT_TYPES = ["text/html", "text/markdown", "image/svg+xml", "image/png", "text/plain"]
"""The types of an output, of which a page shows the first that there is; of sliders it shows the stills."""
BROWSERS = (
    *("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge"),
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
)
"""Programs of Chromium's family, by their names on the path, or where Windows and macOS have them."""
NO_BROWSER_ERROR = (
    say("there is no Chromium to print it"),
    say("install Chromium or Chrome, or print the page of --html from your browser"),
)
"""Fault and remedy where there is no browser to print with."""
PRINT_SECONDS = 120
"""The time limit of printing [s]."""
NOTEBOOK_FILE, PAGE_FILE, PRINT_FILE = "notebook.ipynb", "notebook.html", "notebook.pdf"


INTRODUCTION = say(
    "Every construction of this cam, step by step: what is done, the drawing so far with the current step in "
    "colour, and the readings, as millimetres of paper times a scale. graphcam wrote this notebook from the task "
    "below."
)
CHECK_INTRODUCTION = say(
    "Draw it on paper and enter your readings here. Each cell answers with a hint; the tolerance allows for "
    "careful drawing by hand."
)
ERRORS_INTRODUCTION = say(
    "An ideal pencil leaves only the error of the method: curves are replaced by chords, and between stations a "
    "smooth curve is drawn. This error falls with the square of the number of parts. Drawing by hand adds errors "
    "of line position (0.1 to 0.2 mm), dividers (0.1 to 0.3 mm), rule (0.5 mm) and protractor (0.5°), and each "
    "error is passed on to everything drawn from it. With more parts the method becomes more exact and the "
    "drawing errors grow."
)
COMPARED_INTRODUCTION = say(
    "The ideal pencil makes no error but that of the method. The careful drawings are 400 by a pencil of 0.2 mm: "
    "their bias is how far their mean is from the exact value, their scatter the standard deviation."
)
PARTS_INTRODUCTION = say("More parts, fewer parts: what changes, and which is worth the work?")
CLOSING_QUESTIONS = say(
    "1. Which reading decides the size of this cam, and how would you make it more exact?\n2. What changes on the "
    "drawing if the cam turns the other way?\n3. Where does the acceleration jump, and what happens in the "
    "mechanism there?\n4. Which of the drawn values would you trust to 1 %, and which not even to 10 %?"
)
SETUP_CODE = f"""\
import graphcam as gc
from graphcam.notebooks import Question, Slider, changed, compared, drawing, explore, player, show_steps

task = gc.load_task("{TASK_FILE}")
solution = gc.solve(task)
tell = task.drawing.tell"""
PARTS_CODE = """\
def with_parts(parts):
    finer = gc.solve(changed(task, {{"drawing.divisions": parts}}))
    return drawing(finer.drawn["{construction}"], "{view}", tell=tell)

explore(with_parts, parts=Slider("{parts}", {values}, {start}, {shown}))"""


def notebook_of(solution: AnySolution) -> NotebookNode:
    """The notebook of a solution, with all constructions of its chain, to be executed beside :func:`task_files`.

    >>> import graphcam as gc
    >>> notebook = notebook_of(gc.solve(gc.builtin_task("flat")))
    >>> [cell.source.splitlines()[0] for cell in notebook.cells if cell.source.startswith("## ")][:3]
    ['## The task', '## 1. Kinematic diagram', '## 2. Acceleration diagram']
    """
    toml, tell, title = task_files(solution.task)[TASK_FILE], solution.tell, notebook_title(solution.task)
    warned = (say("**Note:** {warning}", warning=markdown.text(sentence)) for sentence in solution.warnings)
    cells = [
        _text_cell(f"# {markdown.text(title)}\n\n{tell(INTRODUCTION)}"),
        _section(tell, say("The task"), f"```toml\n{toml.strip()}\n```"),
        _hidden_cell(SETUP_CODE),
        *(_text_cell(f"> {tell(warning)}") for warning in warned),
        *(
            cell
            for number, name in enumerate(all_constructions(solution), 1)
            for cell in _chapter(number, name, solution)
        ),
        _section(tell, say("Try it yourself"), CHECK_INTRODUCTION),
        *(cell for name in _asked_quantities(solution) for cell in _question_cells(solution, name)),
        _section(tell, say("Move the sliders"), PARTS_INTRODUCTION),
        _hidden_cell(_parts_slider(solution)),
        _section(tell, say("Drawn and exact"), COMPARED_INTRODUCTION),
        _hidden_cell("compared(solution)"),
        _section(tell, say("Where the error comes from"), ERRORS_INTRODUCTION),
        _section(tell, say("The sheet, step by step")),
        _hidden_cell("player(solution)"),
        _section(tell, say("Questions"), CLOSING_QUESTIONS),
    ]
    # Without random names a notebook that is written anew is the same.
    for k, cell in enumerate(cells):
        cell["id"] = f"cell-{k}"
    return nb.new_notebook(cells=cells, metadata={"title": title, **PYTHON_METADATA})


def notebook_title(task: Task | ArcsTask) -> str:
    """The title of a task's notebook, which is that of its sheet."""
    tell = task.drawing.tell
    return task.title.translated_name(tell) or tell(DEFAULT_NAME)


def _text_cell(source: str) -> NotebookNode:
    return nb.new_markdown_cell(source)


def _section(tell: Tell, title: Words, *paragraphs: Words) -> NotebookNode:
    return _text_cell(markdown.blocks(f"## {tell(title)}", *map(tell, paragraphs)))


def _hidden_cell(source: str) -> NotebookNode:
    return nb.new_code_cell(source, metadata={"tags": ["remove-input"], "jupyter": {"source_hidden": True}})


def _chapter(number: int, name: str, solution: AnySolution) -> list[NotebookNode]:
    """Title, reason and steps of a construction of the solution, or of one of its designs, as cells."""
    meaning = all_constructions(solution)[name].meaning
    title = say("{number}. {title}", number=number, title=meaning.title)
    added = (f"solution.{design}" for design, drawn in drawn_by_design(solution).items() if name in drawn)
    of = next(added, "solution")
    # Its rays are drawn in the combined diagram.
    on = ', on=solution.drawn["minimum_radius"]' * (name == "pressure_angle")
    shown = _hidden_cell(f'show_steps({of}.drawn["{name}"], within=solution{on})')
    return [_section(solution.tell, title, meaning.why), shown]


def _asked_quantities(solution: AnySolution) -> list[str]:
    asked = ("max_v", "minimum_prime_radius", "max_pressure_angle_rise_deg", "min_pitch_curvature_radius", "lift")
    quantities = solution.comparison.quantities
    return [name for name in asked if name in quantities and quantities[name].drawn == quantities[name].drawn]


def _question_cells(solution: AnySolution, name: str) -> list[NotebookNode]:
    q = solution.comparison.quantities[name]
    question = f'Question.about(solution.comparison.quantities["{name}"], tell)'
    source = f"your_{name} = None  # {solution.tell(unit(q.unit))}\n{question}.check(your_{name})"
    return [nb.new_code_cell(source, metadata={"tags": ["try-it"]})]


def _parts_slider(solution: AnySolution) -> str:
    """The code of a slider for the number of parts, on the drawing that shows them best."""
    arcs = isinstance(solution, ArcsSolution)
    construction, view = ("arc_diagrams", "acceleration") if arcs else ("integration", "displacement")
    start = solution.chain.board.divisions
    values, shown = sorted({2, 4, 8, 12, 24, start}), tuple(sorted({4, start}))
    parts = solution.tell(say_in("of a slider", "parts"))
    return PARTS_CODE.format(construction=construction, view=view, values=values, start=start, shown=shown, parts=parts)


class _Renderer(IPythonRenderer):
    """A renderer of Markdown with formulas as MathML, which browsers draw without a script."""

    def block_math(self, body: str) -> str:
        """A formula on a line of its own."""
        return mathml(body, "block")

    def inline_math(self, body: str) -> str:
        """A formula within a line."""
        return mathml(body)

    def latex_environment(self, name: str, body: str) -> str:
        """An environment of LaTeX, such as aligned formulas."""
        return mathml(f"\\begin{{{name}}}{body}\\end{{{name}}}", "block")


def markdown_page(source: str) -> str:
    r"""Markdown as HTML, its formulas as MathML.

    >>> "<math" in markdown_page(r"The angle $\\alpha$"), "$" in markdown_page(r"The angle $\\alpha$")
    (True, False)
    """
    return MarkdownWithMath(renderer=_Renderer(escape=False, exclude_anchor_links=True)).render(source)


def to_html(notebook: NotebookNode, title: str, language: str = "en") -> str:
    """An executed notebook as a page.

    language : of the page, such as "en"

    Raises
    ------
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    """
    config = Config(
        NbConvertBase={"display_data_priority": SHOWN_OUTPUT_TYPES},
        CSSHTMLHeaderPreprocessor={"style": "friendly", "highlight_class": ".highlight"},
    )
    template = {"template_name": "graphcam", "extra_template_basedirs": [str(TEMPLATE_FOLDER)]}
    exporter = HTMLExporter(config=config, language_code=language, **template)
    exporter.register_filter("markdown2html", markdown_page)
    page, _ = exporter.from_notebook_node(notebook, resources={"metadata": {"title": title, "name": title}})
    return page


def browser() -> str | None:
    """The path of an installed browser of Chromium's family, or None."""
    return next((path for name in BROWSERS if (path := shutil.which(name))), None)


def print_pdf(page: Path, pdf: Path) -> None:
    """Print the file of a page as PDF.

    Raises
    ------
    OutputError : there is no Chromium, or it cannot print the page
    """
    program = browser()
    if program is None:
        raise OutputError(pdf, *NO_BROWSER_ERROR)
    with tempfile.TemporaryDirectory() as profile:
        options = ["--headless", "--disable-gpu", f"--user-data-dir={profile}", "--no-pdf-header-footer"]
        # Chromium does not start its sandbox for the superuser.
        options += ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        command = [program, *options, f"--print-to-pdf={pdf.resolve()}", page.resolve().as_uri()]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=PRINT_SECONDS, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise OutputError(pdf, bare_caption(f"{Path(program).name}: {error}")) from error
    if done.returncode or not pdf.exists():
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        why = say("{name} says: {last}", name=Path(program).name, last=last)
        raise OutputError(pdf, why, say("print the page of --html from your browser"))


def check_browser(place: Path | str) -> None:
    """Check that there is a program to print with, before anything is executed for a place.

    Raises
    ------
    OutputError : there is none
    """
    if browser() is None:
        raise OutputError(place, *NO_BROWSER_ERROR)


def write_page(page: str, path: Path, *, html: bool, pdf: bool) -> None:
    """Write the text of a page as HTML, as PDF beside it, or both.

    Raises
    ------
    OutputError : the page cannot be printed
    """
    path.write_text(page, encoding="utf-8", newline="\n")
    if pdf:
        print_pdf(path, path.with_suffix(".pdf"))
    if not html:
        path.unlink()


def write_folder(
    task: Task | ArcsTask,
    folder: Path | str,
    *,
    run: bool = False,
    html: bool = False,
    pdf: bool = False,
    progress: Callable[[Words], None] = lambda _: None,
) -> list[str]:
    """Write the notebook of a task into a folder: all of it, or nothing.

    run : whether it is executed; html, pdf : whether a page is made of it, which executes it too
    returns : the names of the files

    Raises
    ------
    DesignError : there is no such cam
    OutputError : the folder cannot be written, or there is no Chromium for the PDF
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    NotebookError : a cell fails
    """
    if pdf:
        check_browser(Path(folder, PRINT_FILE))
    progress(say("writing the notebook"))
    notebook, files = notebook_of(solve(task)), task_files(task)
    with whole_folder(folder) as draft:
        for name, text in files.items():
            (draft / name).write_text(text, encoding="utf-8", newline="\n")
        if run or html or pdf:
            progress(say("executing it"))
            notebook = execute(notebook, draft)
        nbformat.write(notebook, draft / NOTEBOOK_FILE)
        if html or pdf:
            progress(say("making a page of it"))
            page = to_html(notebook, notebook_title(task), task.drawing.language)
            if pdf:
                progress(say("printing the page"))
            write_page(page, draft / PAGE_FILE, html=html, pdf=pdf)
        return sorted(path.name for path in draft.iterdir())
