"""nbgrader's grade book: scores entered through nbgrader's own API."""

from collections.abc import Sequence
from importlib.util import find_spec
from typing import Any

from graphcam.errors import TaskError
from graphcam.exercises.definition.exercise import Exercise

NOTEBOOK = "answers"
"""Name of the notebook without its ending: as graphcam reads it."""


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
        remedy = "sqlite:///gradebook.db is the file gradebook.db in this folder"
        raise TaskError("--gradebook", "the grade book", why, "a database that can be opened", remedy) from None


def enter_scores(database: str, exercise: Exercise, records: Sequence[dict[str, Any]]) -> None:
    """Enter scores and comments into the grade book of a course that was exported for nbgrader.

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
