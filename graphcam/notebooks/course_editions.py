"""The course with a lecturer's own task: the student's edition, the teacher's, and what grading needs.

The student's edition has no model answers, no cells that check the author, and no formula of an answer: its questions
are kept as text, as :func:`~graphcam.notebooks.question.kept_questions` reads it.
"""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from importlib import resources
from pathlib import Path

import nbformat
import nbformat.v4 as nb
from nbformat import NotebookNode

from graphcam.files import whole_folder
from graphcam.notebooks.notebook_execution import MAY_FAIL, NotebookError, execute
from graphcam.notebooks.notebook_folder import check_browser, to_html, write_page
from graphcam.notebooks.question import QUESTIONS_FILE, Question, kept_questions, kept_text
from graphcam.solving.solve import solve
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_writer import task_files
from graphcam.words import Words, say
from graphcam.workers import executor_of, ordered_results

STUDENT_FOLDER, TEACHER_FOLDER = "student", "teacher"
CHECK_PATTERN = re.compile(r"^(?P<answer>your_\w+) = None.*\n(?P<question>\w+)\.check\((?P=answer)\)\s*$")
"""A cell in which the student puts a number."""
MODEL_ANSWERS_PATTERN = re.compile(r"\s*<details><summary>Model answers</summary>.*?</details>", re.DOTALL)
CLOSING_QUESTION_PATTERN = re.compile(r"^(\d+)\. ", re.MULTILINE)
FAILED_LINE_PATTERN = re.compile(r"^-+> *\d+ (.*)$", re.MULTILINE)
TERMINAL_COLOUR_PATTERN = re.compile(r"\x1b\[[0-9;]*m")
"""What a traceback marks the line with that failed, and what colours it."""
OF_AUTHOR, OF_STUDENT = "remove-cell", "try-it"
"""Tags of the cells that hold the author's checks, and the student's numbers."""
GRADED = {"schema_version": 3, "grade": True, "solution": False, "locked": True, "task": False, "points": 1}
"""What nbgrader wants to know of a cell that gives a mark."""
KEEPING_CODE = """\
import json, pathlib
from graphcam.notebooks.question import Question, kept_text
kept = {{name: kept_text([found]) for name, found in list(globals().items()) if isinstance(found, Question)}}
pathlib.Path("{file}").write_text(json.dumps(kept))"""
FOR_STUDENTS = """\
> Draw first, then put your number in the place of `None` and run the cell: it answers with a hint. Write a number, \
such as 12.3 or "12,3 mm", not a formula. Answer the closing questions in the cells below them, and hand in this \
file."""


def course_source() -> Path:
    """The folder of the course's notebooks: installed beside the code, in a checkout at the top level."""
    installed = Path(str(resources.files("graphcam").joinpath("notebooks", "course")))
    return installed if installed.is_dir() else Path(__file__).parents[2] / "notebooks"


@dataclass(frozen=True, eq=False)
class Lesson:
    """A notebook of the course for one task.

    name : of its file, without the ending
    teacher : with its outputs
    questions : by the names that they have in the notebook
    doubts : the author's checks that do not hold for the task: what the text says of it may not be so
    """

    name: str
    teacher: NotebookNode
    questions: Mapping[str, Question]
    doubts: tuple[str, ...] = ()

    @property
    def answers(self) -> dict[str, Question]:
        """The questions by the names of the student's numbers, in their order."""
        return {found["answer"]: self.questions[found["question"]] for found in _checks(self.teacher)}

    @property
    def student(self) -> NotebookNode:
        """The student's edition, without outputs."""
        first, *rest = self.teacher.cells
        told = nb.new_markdown_cell(FOR_STUDENTS)
        cells = [_copy(first), told, *(made for cell in rest for made in self._for_student(cell))]
        for number, cell in enumerate(cells):
            cell["id"] = f"cell-{number}"
        return nb.new_notebook(cells=cells, metadata=self.teacher.metadata)

    def _for_student(self, cell: NotebookNode) -> Iterator[NotebookNode]:
        tags = cell.metadata.get("tags", ())
        if cell.cell_type == "markdown":
            text = MODEL_ANSWERS_PATTERN.sub("", cell.source)
            yield _copy(cell, text)
            if text != cell.source:
                numbers = CLOSING_QUESTION_PATTERN.findall(text[text.index("## Questions") :])
                yield from (self._closing_answer(number) for number in numbers)
        elif asked := [
            name for name in self.questions if re.search(rf"^{name} = Question\b", cell.source, re.MULTILINE)
        ]:
            kept = kept_text([self.questions[name] for name in asked])
            names = ", ".join(asked) + "," * (len(asked) == 1)
            code = f'from graphcam.notebooks import kept_questions\n\n{names} = kept_questions("{kept}")'
            yield _copy(cell, code)
        elif OF_AUTHOR not in tags:
            yield _copy(cell)
            if OF_STUDENT in tags and (found := CHECK_PATTERN.match(cell.source)):
                yield self._mark(found["question"], found["answer"])

    def _closing_answer(self, number: str) -> NotebookNode:
        graded = GRADED | {"solution": True, "locked": False, "grade_id": f"{self.name}-closing-{number}"}
        return nb.new_markdown_cell(f"**Answer {number}.** ", metadata={"nbgrader": graded})

    def _mark(self, question: str, answer: str) -> NotebookNode:
        """The cell whose value nbgrader takes for the mark: an answer that is not there yet stops nothing."""
        hidden = {"tags": ["remove-cell"], "jupyter": {"source_hidden": True}}
        graded = {"nbgrader": GRADED | {"grade_id": f"{self.name}-{answer}"}, **hidden}
        return nb.new_code_cell(f'int({question}.check({answer}).status == "right")', metadata=graded)


def _copy(cell: NotebookNode, source: str | None = None) -> NotebookNode:
    text = cell.source if source is None else source
    make = nb.new_markdown_cell if cell.cell_type == "markdown" else nb.new_code_cell
    return make(text, metadata=cell.metadata)


def _checks(notebook: NotebookNode) -> list[re.Match[str]]:
    sources = (cell.source for cell in notebook.cells if cell.cell_type == "code")
    return [found for source in sources if (found := CHECK_PATTERN.match(source))]


def lesson_of(path: Path, folder: Path) -> Lesson:
    """The lesson of a notebook of the course, executed in a folder that holds the task.

    Raises
    ------
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    NotebookError : a cell fails, but for an assertion of the author
    """
    notebook, kept = nbformat.read(path, 4), folder / f"{path.stem}.json"
    keeping = nb.new_code_cell(KEEPING_CODE.format(file=kept.name), id="keeping")
    checks = [cell for cell in notebook.cells if OF_AUTHOR in cell.metadata.get("tags", ())]
    for cell in checks:
        cell.metadata["tags"].append(MAY_FAIL)
    notebook.cells.append(keeping)
    executed = execute(notebook, folder)
    executed.cells.pop()
    said: dict[str, str] = json.loads(kept.read_text(encoding="utf-8"))
    kept.unlink()
    doubts = [doubt for cell in checks for doubt in _doubts(cell)]
    questions = {name: kept_questions(text)[0] for name, text in said.items()}
    return Lesson(path.stem, executed, questions, tuple(doubts))


def _doubts(cell: NotebookNode) -> Iterator[str]:
    """The lines of an author's cell that do not hold, which is left without its output."""
    cell.metadata["tags"].remove(MAY_FAIL)
    for output in cell.pop("outputs"):
        if output.output_type == "error":
            lines = FAILED_LINE_PATTERN.findall(TERMINAL_COLOUR_PATTERN.sub("", "\n".join(output.traceback)))
            if output.ename != "AssertionError" or not lines:
                raise NotebookError(cell.source, f"{output.ename}: {output.evalue}")
            yield lines[0]
    cell["outputs"] = []


def write_course(
    task: Task | ArcsTask,
    folder: Path | str,
    *,
    html: bool = False,
    pdf: bool = False,
    progress: Callable[[Words], None] = lambda _: None,
) -> list[str]:
    """Write the course for a task into a folder: the editions of student and teacher, all of it or nothing.

    html, pdf : whether pages of both editions are made
    returns : the folders of both editions

    Raises
    ------
    DesignError : there is no such cam
    OutputError : the folder cannot be written, or there is no Chromium for the PDF
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    NotebookError : a cell fails
    """
    if pdf:
        check_browser(folder)
    solve(task)  # whatever is wrong with it is told before
    source, needed = course_source(), task_files(task)
    scripts = sorted(source.glob("[0-9][0-9]_*.ipynb"))
    with whole_folder(folder) as draft:
        editions = [draft / STUDENT_FOLDER, draft / TEACHER_FOLDER]
        for edition in editions:
            edition.mkdir()
            for name, text in needed.items() | {("hard_cases.toml", (source / "hard_cases.toml").read_text("utf-8"))}:
                (edition / name).write_text(text, encoding="utf-8", newline="\n")
        # Every notebook is executed by a process of its own.
        with executor_of(os.cpu_count() or 1) as executor:
            progress(say("executing {count} notebooks", count=len(scripts)))
            lessons = list(ordered_results(executor, partial(lesson_of, folder=editions[1]), scripts))
            for lesson in lessons:
                for doubt in lesson.doubts:
                    said = say("{name}: what the text says may not hold for this task: {check}")
                    progress(said.with_values(name=lesson.name, check=doubt))
                nbformat.write(lesson.student, editions[0] / f"{lesson.name}.ipynb")
                nbformat.write(lesson.teacher, editions[1] / f"{lesson.name}.ipynb")
            if html or pdf:
                progress(say("making pages"))
                students = [lesson.student for lesson in lessons]
                handed_out = ordered_results(executor, partial(execute, folder=editions[0]), students)
                for lesson, student in zip(lessons, handed_out, strict=True):
                    for edition, notebook in zip(editions, (student, lesson.teacher), strict=True):
                        page = to_html(notebook, notebook.metadata.get("title", lesson.name))
                        write_page(page, edition / f"{lesson.name}.html", html=html, pdf=pdf)
        kept = {one.name: {answer: kept_text([q]) for answer, q in one.answers.items()} for one in lessons}
        (editions[1] / QUESTIONS_FILE).write_text(json.dumps(kept, indent=1) + "\n", encoding="utf-8", newline="\n")
    return [STUDENT_FOLDER, TEACHER_FOLDER]
