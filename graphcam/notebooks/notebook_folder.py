"""The notebook of a task into a folder: the notebook, its task, and if asked for its pages as HTML and PDF.

A page stands alone: formulas are MathML, figures inside, nothing is fetched.
"""

import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

import nbformat
from nbconvert.exporters import HTMLExporter
from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath
from nbformat import NotebookNode
from traitlets.config import Config

from graphcam.files import OutputError, whole_folder
from graphcam.notebooks.generate import notebook_title, write_notebook
from graphcam.notebooks.running import execute
from graphcam.report.note_page import mathml
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_writer import task_files
from graphcam.words import Words, bare, say

TEMPLATES = Path(__file__).parent / "templates"
SHOWN = ["text/html", "text/markdown", "image/svg+xml", "image/png", "text/plain"]
"""What a page shows of an output, the first that there is; of sliders it shows the stills."""
BROWSERS = (
    *("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "msedge"),
    r"C:\Program Files\Google\Chrome\Application\chrome.exe",
    r"C:\Program Files (x86)\Microsoft\Edge\Application\msedge.exe",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
)
"""Programs of Chromium's family, by their names on the path, or where Windows and macOS have them."""
NO_BROWSER = (
    say("there is no Chromium to print it"),
    say("install Chromium or Chrome, or print the page of --html from your browser"),
)
"""Why there is no PDF, and what to do."""
LONGEST = 120
"""Seconds that printing may take."""
NOTEBOOK, PAGE, PRINT = "notebook.ipynb", "notebook.html", "notebook.pdf"


class _Renderer(IPythonRenderer):
    """Markdown with formulas as MathML, which browsers draw without a script."""

    def block_math(self, body: str) -> str:
        """A formula on lines of its own."""
        return mathml(body, "block")

    def inline_math(self, body: str) -> str:
        """A formula within a line."""
        return mathml(body)

    def latex_environment(self, name: str, body: str) -> str:
        """A named arrangement of formulas, such as aligned ones."""
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
        NbConvertBase={"display_data_priority": SHOWN},
        CSSHTMLHeaderPreprocessor={"style": "friendly", "highlight_class": ".highlight"},
    )
    template = {"template_name": "graphcam", "extra_template_basedirs": [str(TEMPLATES)]}
    exporter = HTMLExporter(config=config, language_code=language, **template)
    exporter.register_filter("markdown2html", markdown_page)
    page, _ = exporter.from_notebook_node(notebook, resources={"metadata": {"title": title, "name": title}})
    return page


def browser() -> str | None:
    """The path of an installed Chromium, or None."""
    return next((path for name in BROWSERS if (path := shutil.which(name))), None)


def print_pdf(page: Path, pdf: Path) -> None:
    """Print a page's file as PDF.

    Raises
    ------
    OutputError : there is no Chromium, or it cannot print the page
    """
    program = browser()
    if program is None:
        raise OutputError(pdf, *NO_BROWSER)
    with tempfile.TemporaryDirectory() as profile:
        options = ["--headless", "--disable-gpu", f"--user-data-dir={profile}", "--no-pdf-header-footer"]
        # Chromium does not start its sandbox for the superuser.
        options += ["--no-sandbox"] if hasattr(os, "geteuid") and os.geteuid() == 0 else []
        command = [program, *options, f"--print-to-pdf={pdf.resolve()}", page.resolve().as_uri()]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise OutputError(pdf, bare(f"{Path(program).name}: {error}")) from error
    if done.returncode or not pdf.exists():
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        why = say("{name} says: {last}", name=Path(program).name, last=last)
        raise OutputError(pdf, why, say("print the page of --html from your browser"))


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

    run : executes it; html, pdf : make a page of it, which executes it too
    returns : the names of the files

    Raises
    ------
    DesignError : there is no such cam
    OutputError : the folder cannot be written, or there is no Chromium for the PDF
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    NotebookError : a cell fails
    """
    if pdf and browser() is None:
        raise OutputError(Path(folder, PRINT), *NO_BROWSER)
    progress(say("writing the notebook"))
    notebook, files = write_notebook(task), task_files(task)
    with whole_folder(folder) as draft:
        for name, text in files.items():
            (draft / name).write_text(text, encoding="utf-8", newline="\n")
        if run or html or pdf:
            progress(say("executing it"))
            notebook = execute(notebook, draft)
        nbformat.write(notebook, draft / NOTEBOOK)
        if html or pdf:
            progress(say("making a page of it"))
            page = to_html(notebook, notebook_title(task), task.drawing.language)
            (draft / PAGE).write_text(page, encoding="utf-8", newline="\n")
        if pdf:
            progress(say("printing the page"))
            print_pdf(draft / PAGE, draft / PRINT)
        if not html:
            (draft / PAGE).unlink(missing_ok=True)
        return sorted(path.name for path in draft.iterdir())
