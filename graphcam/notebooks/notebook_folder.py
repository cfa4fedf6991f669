"""The notebook of a task into a folder: the notebook, its task, and if asked for its pages as HTML and PDF."""

from collections.abc import Callable
from pathlib import Path

import nbformat

from graphcam.files import OutputError, whole_folder
from graphcam.notebooks.generate import notebook_title, write_notebook
from graphcam.notebooks.html_pages import NO_BROWSER, browser, print_pdf, to_html
from graphcam.notebooks.running import execute
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_writer import task_files

NOTEBOOK, PAGE, PRINT = "notebook.ipynb", "notebook.html", "notebook.pdf"


def write_folder(
    task: Task | ArcsTask,
    folder: Path | str,
    *,
    run: bool = False,
    html: bool = False,
    pdf: bool = False,
    progress: Callable[[str], None] = lambda _: None,
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
    progress("writing the notebook")
    notebook, files = write_notebook(task), task_files(task)
    with whole_folder(folder) as draft:
        for name, text in files.items():
            (draft / name).write_text(text, encoding="utf-8")
        if run or html or pdf:
            progress("executing it")
            notebook = execute(notebook, draft)
        nbformat.write(notebook, draft / NOTEBOOK)
        if html or pdf:
            progress("making a page of it")
            page = to_html(notebook, notebook_title(task), task.drawing.language)
            (draft / PAGE).write_text(page, encoding="utf-8")
        if pdf:
            progress("printing the page")
            print_pdf(draft / PAGE, draft / PRINT)
        if not html:
            (draft / PAGE).unlink(missing_ok=True)
        return sorted(path.name for path in draft.iterdir())
