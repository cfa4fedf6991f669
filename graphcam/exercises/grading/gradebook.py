"""nbgrader's grade book: scores entered through nbgrader's own API."""

import hashlib
import json
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from graphcam.errors import TaskError
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.grading.overrides import TOTAL_ANSWER
from graphcam.words import Caption, say

BY_HAND = say("{student}: the total given by hand is not in the grade book, which adds up the answers")
ENTERED_FILE = "gradebook.json"
"""The teacher's file of what was entered into grade books."""
Entered = dict[str, dict[str, list[Any]]]
"""The score and the comment that were entered last, by student and answer."""
NOTEBOOK_NAME = "answers"
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
        why = say(
            "{database} ({value})", database=database, value=getattr(error, "orig", None) or "no address of a database"
        )
        remedy = say("sqlite:///gradebook.db is the file gradebook.db in this folder")
        what = say("the grade book")
        raise TaskError("--gradebook", what, why, say("a database that can be opened"), remedy) from None


def enter_scores(database: str, exercise: Exercise, records: Sequence[dict[str, Any]], entered: Path) -> list[Caption]:
    """Enter scores and comments into the grade book of a course that was exported for nbgrader.

    What somebody has changed there since stays, and is told: a sentence for each.

    database : as SQLAlchemy names it, "sqlite:///gradebook.db"
    entered : file that notes what was entered, by which what somebody changed is known

    Raises
    ------
    ImportError : nbgrader is not installed
    """
    from nbgrader.api import Gradebook  # pyright: ignore[reportMissingImports]

    # Of the address only a digest is noted, since it may hold a password.
    about = hashlib.sha256(f"{database} {exercise.name}".encode()).hexdigest()[:16]
    noted = _noted(entered)
    scores: Entered = noted.setdefault(about, {})
    told: list[Caption] = []
    with Gradebook(database, exercise.name) as book:
        book.update_or_create_assignment(exercise.name)
        book.update_or_create_notebook(NOTEBOOK_NAME, exercise.name)
        for asked in exercise.answers:
            cell: Any = {"max_score": asked.marks, "cell_type": "code"}
            book.update_or_create_grade_cell(asked.name, NOTEBOOK_NAME, exercise.name, **cell)
            book.update_or_create_solution_cell(asked.name, NOTEBOOK_NAME, exercise.name)
        for record in records:
            student = record["student"]
            book.update_or_create_student(student)
            book.update_or_create_submission(exercise.name, student)
            former = scores.setdefault(student, {})
            for answer in record["answers"]:
                told += _enter(book, exercise.name, record, answer, former)
            if any(one["answer"] == TOTAL_ANSWER for one in record.get("overrides", [])):
                told.append(BY_HAND.with_values(student=student))
        book.db.commit()
    entered.parent.mkdir(parents=True, exist_ok=True)
    draft = entered.with_name(f"{entered.name}.new")
    draft.write_text(json.dumps(noted) + "\n", encoding="utf-8", newline="\n")
    draft.replace(entered)
    return told


def _noted(entered: Path) -> dict[str, Entered]:
    """What was entered by former runs; without the file whatever differs counts as somebody's."""
    try:
        noted = json.loads(entered.read_bytes())
    except (OSError, ValueError):
        return {}
    return noted if isinstance(noted, dict) else {}


def _enter(
    book: Any, assignment: str, record: dict[str, Any], answer: dict[str, Any], former: dict[str, list[Any]]
) -> list[Caption]:
    """Enter one answer's score and comment, each unless it is somebody's; a sentence where it is."""
    where = answer["name"], NOTEBOOK_NAME, assignment, record["student"]
    grade, comment = book.find_grade(*where), book.find_comment(*where)
    said = "\n".join(each for each in record["feedback"] if each.startswith(f"{answer['name']}:"))
    marks, words = former.get(answer["name"], [None, None])
    told: list[Caption] = []
    place = f"{record['student']}, {answer['name']}"
    if grade.manual_score in (None, marks, answer["marks"]):
        grade.manual_score, grade.needs_manual_grade = answer["marks"], False
        marks = answer["marks"]
    else:
        keeps = say("{place}: the grade book keeps {kept:g}, not {found:g}")
        told.append(keeps.with_values(place=place, kept=grade.manual_score, found=answer["marks"]))
    if comment.manual_comment in (None, "", words, said):
        comment.manual_comment = words = said
    else:
        told.append(say("{place}: the grade book keeps its comment", place=place))
    former[answer["name"]] = [marks, words]
    return told
