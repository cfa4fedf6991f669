"""Grades as learning platforms read them: a CSV file for Moodle's grade book and one for Canvas's.

Moodle asks what each column is, so its headings need only tell the columns apart: the ID number finds the student, and
the feedback is HTML.  Canvas takes the headings as they are and reads the points possible from a second row.
"""

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

from graphcam.exercises.course.roster import MOODLE_ID_HEADING
from graphcam.exercises.course.spreadsheet import table
from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.marking.record import is_handed_in

CANVAS_STUDENT_COLUMNS = ("Student", "ID", "SIS User ID", "SIS Login ID", "Section")
"""Canvas's headings before the assignment's; ID is a number of Canvas's own, which is left empty."""
POINTS_POSSIBLE_CELL = "    Points Possible"
"""The cell that begins Canvas's second row; the spaces are Canvas's."""


def moodle_grades(exercise: Exercise, records: Sequence[Mapping[str, Any]], heading: str = MOODLE_ID_HEADING) -> str:
    """A row a student: id, grade, feedback, as Moodle's import of grades from a CSV file maps them.

    heading : of the roster's column of the ids: "Email address" where nobody has an ID number

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> record = {"student": "7", "total": 2.5, "feedback": ["v: 1 < 2.", "Again."]}
    >>> moodle_grades(find_exercise("pressure-angle"), [record]).splitlines()[1]
    '"7","2.5","v: 1 &lt; 2.<br>Again."'
    """
    head = (heading, exercise.title, "Feedback")
    return table(head, ([one["student"], grade_of(one), _comment_text(one)] for one in records))


def canvas_grades(exercise: Exercise, records: Sequence[Mapping[str, Any]]) -> str:
    """Canvas's headings, the points possible, and a row a student.

    The id stands for the name, for the SIS User ID and for the SIS Login ID: courses differ in which of them it is.

    >>> from graphcam.exercises.definition.exercise_file import find_exercise
    >>> canvas_grades(find_exercise("pressure-angle"), [{"student": "7", "total": 2.5}]).splitlines()[2]
    '"7","","7","7","","2.5"'
    """
    possible = [POINTS_POSSIBLE_CELL, "", "", "", "", exercise.marks]
    rows = [[one["student"], "", one["student"], one["student"], "", grade_of(one)] for one in records]
    return table((*CANVAS_STUDENT_COLUMNS, exercise.title), [possible, *rows])


def grade_of(record: Mapping[str, Any]) -> float | None:
    """The marks; of one who has not handed in None, for an empty cell, which changes nothing in a grade book."""
    return record["total"] if is_handed_in(record) else None


def _comment_text(record: Mapping[str, Any]) -> str:
    """What the student is told, and what must be said of the submission; of one who has not handed in only that."""
    notes = list(record.get("notes", ()))
    told = [*record["feedback"], *notes] if is_handed_in(record) else notes
    # Each sentence on its own line.
    return "<br>".join(escape(said, quote=False) for said in dict.fromkeys(told))
