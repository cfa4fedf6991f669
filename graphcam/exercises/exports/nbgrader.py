"""A course for nbgrader: an assignment with a cell for every answer, and scores entered through nbgrader's own API.

The notebook is the same for all; a student's parameters stand on the student's own sheet and are derived again when it
is graded.  A locked cell could not hold them: nbgrader's autograde puts the teacher's cell back in its place.
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from graphcam.errors import TaskError
from graphcam.exercises.certificate import Certificate
from graphcam.exercises.exercise import Asked, Exercise
from graphcam.exercises.folders import folder_name
from graphcam.exercises.reading.notebook import TAG
from graphcam.exercises.template import sentence
from graphcam.words import Tell, say

SCHEMA = 3
NOTEBOOK = "answers"
"""Name of the notebook without its ending: as graphcam reads it."""
CONFIG = '''"""The settings of this course; graphcam grades, nbgrader keeps the scores."""

c = get_config()
c.CourseDirectory.course_id = {course!r}
# Stands in the student's notebook in place of a solution.
c.ClearSolutions.code_stub = {{"python": {stub!r}}}
'''
SOLUTION = "### BEGIN SOLUTION\n### END SOLUTION"
"""Without these nbgrader takes a whole cell for the solution, and the student gets one without the answer's name."""


def write_course(folder: Path, exercise: Exercise, certificates: Sequence[Certificate]) -> None:
    """The folder of a course: settings, the assignment's source, and a sheet of parameters for every student."""
    import nbformat

    tell = exercise.tell
    stub = "# " + tell(say("Write what you read in place of None."))
    (folder / "nbgrader_config.py").write_text(CONFIG.format(course=exercise.name, stub=stub), encoding="utf-8")
    source = folder / "source" / exercise.name
    source.mkdir(parents=True)
    notebook = nbformat.from_dict(_notebook(exercise))
    nbformat.validate(notebook)
    nbformat.write(notebook, source / f"{NOTEBOOK}.ipynb")
    sheets = folder / "sheets"
    sheets.mkdir()
    for certificate in certificates:
        told = sentence(exercise.text, certificate.parameters, tell)
        text = f"# {exercise.title}\n\n{certificate.student}\n\n{told}"
        (sheets / f"{folder_name(certificate.student)}.md").write_text(text, encoding="utf-8")


def check_gradebook(database: str) -> None:
    """See whether the grade book can be opened, before anything is graded for it.

    Raises
    ------
    ImportError : nbgrader is not installed
    TaskError : it is not the address of a database, or the database cannot be opened
    """
    if find_spec("nbgrader") is None:
        raise ImportError("nbgrader")
    from sqlalchemy import create_engine
    from sqlalchemy.exc import SQLAlchemyError

    try:
        create_engine(database).connect().close()
    except SQLAlchemyError as error:
        why = f"{database} ({getattr(error, 'orig', None) or 'no address of a database'})"
        raise TaskError("--gradebook", "the grade book", why, "a database that can be opened",
                        "sqlite:///gradebook.db is the file gradebook.db in this folder") from None  # fmt: skip


def enter_scores(database: str, exercise: Exercise, records: Sequence[dict[str, Any]]) -> None:
    """Enter scores and comments into the grade book of a course that :func:`write_course` wrote.

    database : as SQLAlchemy names it, "sqlite:///gradebook.db"

    Raises
    ------
    ImportError : nbgrader is not installed
    """
    from nbgrader.api import Gradebook  # pyright: ignore[reportMissingImports]

    with Gradebook(database, exercise.name) as book:
        book.update_or_create_assignment(exercise.name)
        book.update_or_create_notebook(NOTEBOOK, exercise.name)
        for asked in exercise.answers:
            cell: Any = {"max_score": asked.marks, "cell_type": "code"}
            book.update_or_create_grade_cell(asked.name, NOTEBOOK, exercise.name, **cell)
            book.update_or_create_solution_cell(asked.name, NOTEBOOK, exercise.name)
        for record in records:
            book.update_or_create_student(record["student"])
            book.update_or_create_submission(exercise.name, record["student"])
            for answer in record["answers"]:
                _enter(book, exercise.name, record, answer)
        book.db.commit()


def _enter(book: Any, assignment: str, record: dict[str, Any], answer: dict[str, Any]) -> None:
    where = answer["name"], NOTEBOOK, assignment, record["student"]
    grade = book.find_grade(*where)
    grade.manual_score, grade.needs_manual_grade = answer["marks"], False
    comment = book.find_comment(*where)
    comment.manual_comment = "\n".join(said for said in record["feedback"] if said.startswith(f"{answer['name']}:"))


def _notebook(exercise: Exercise) -> dict[str, Any]:
    how = say("Your parameters stand on your own sheet. Replace each `None` by what you read.")
    cells = [_markdown("task", f"# {exercise.title}\n\n{exercise.tell(how)}")]
    for asked in exercise.answers:
        cells += [_markdown(f"{asked.name}-asked", _question(asked, exercise.tell)), _answer(asked)]
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    return {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}


def _question(asked: Asked, tell: Tell) -> str:
    unit = f" [{tell(asked.unit_said)}]" if asked.unit else ""
    points = tell(say("A list of points `[x, y]` in mm of paper."))
    text = asked.text if asked.kind == "number" else f"{asked.text} {points}"
    return f"**{asked.name}**{unit} {text}"


def _markdown(name: str, text: str) -> dict[str, Any]:
    return {"id": name, "cell_type": "markdown", "source": text,
            "metadata": {"nbgrader": _said(name, locked=True)}}  # fmt: skip


def _answer(asked: Asked) -> dict[str, Any]:
    """A cell that is graded by hand as nbgrader sees it: graphcam is the hand."""
    said = _said(asked.name, grade=True, solution=True) | {"points": asked.marks}
    return {"id": asked.name, "cell_type": "code", "source": f"{asked.name} = None\n{SOLUTION}", "outputs": [],
            "execution_count": None, "metadata": {"tags": [TAG], "nbgrader": said}}  # fmt: skip


def _said(name: str, *, locked: bool = False, grade: bool = False, solution: bool = False) -> dict[str, Any]:
    return {"schema_version": SCHEMA, "grade_id": name, "grade": grade, "solution": solution, "locked": locked,
            "task": False}  # fmt: skip
