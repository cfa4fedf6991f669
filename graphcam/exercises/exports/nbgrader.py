"""A course for nbgrader: an assignment with a cell for every answer.

The notebook is the same for all; a student's parameters stand on the student's own sheet and are derived again when it
is graded.  A locked cell could not hold them: nbgrader's autograde puts the teacher's cell back in its place.
"""

from collections.abc import Sequence
from pathlib import Path

import nbformat
import nbformat.v4 as nb
from nbformat import NotebookNode

from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.definition.variant import sentence
from graphcam.exercises.grading.gradebook import NOTEBOOK_NAME
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reading.notebook import ANSWER_TAG
from graphcam.notebooks.notebook_execution import PYTHON_METADATA
from graphcam.words import Tell, say

CELL = {"schema_version": 3, "grade": False, "solution": False, "locked": False, "task": False}
"""What nbgrader wants to know of every cell."""
CONFIG = '''"""The settings of this course; graphcam grades, nbgrader keeps the scores."""

c = get_config()
c.CourseDirectory.course_id = {course!r}
# Stands in the student's notebook in place of a solution.
c.ClearSolutions.code_stub = {{"python": {stub!r}}}
'''
SOLUTION_MARKS = "### BEGIN SOLUTION\n### END SOLUTION"
"""Marks of a solution: without them nbgrader takes the whole cell, and with it the answer's name."""


def write_course(folder: Path, exercise: Exercise, answer_keys: Sequence[AnswerKey]) -> None:
    """The folder of a course: settings, the assignment's source, and a sheet of parameters for every student."""
    tell = exercise.tell
    stub = "# " + tell(say("Replace None by your reading."))
    (folder / "nbgrader_config.py").write_text(
        CONFIG.format(course=exercise.name, stub=stub), encoding="utf-8", newline="\n"
    )
    source = folder / "source" / exercise.name
    source.mkdir(parents=True)
    how = say("Your parameters are on your own sheet. Replace each `None` by your reading.")
    cells = [_markdown("task", f"# {exercise.title}\n\n{tell(how)}")]
    for asked in exercise.answers:
        cells += [_markdown(f"{asked.name}-asked", _question(asked, tell)), _answer(asked)]
    nbformat.write(nb.new_notebook(cells=cells, metadata=PYTHON_METADATA), source / f"{NOTEBOOK_NAME}.ipynb")
    sheets = folder / "sheets"
    sheets.mkdir()
    for answer_key in answer_keys:
        told = sentence(exercise.text, answer_key.parameters, tell)
        text = f"# {exercise.title}\n\n{answer_key.student}\n\n{told}"
        (sheets / f"{folder_name(answer_key.student)}.md").write_text(text, encoding="utf-8", newline="\n")


def _question(asked: AskedAnswer, tell: Tell) -> str:
    unit = f" [{tell(asked.unit_caption)}]" if asked.unit else ""
    points = tell(say("A list of points `[x, y]` in mm of paper."))
    text = asked.text if asked.kind == "number" else f"{asked.text} {points}"
    return f"**{asked.name}**{unit} {text}"


def _markdown(name: str, text: str) -> NotebookNode:
    return nb.new_markdown_cell(text, id=name, metadata={"nbgrader": CELL | {"grade_id": name, "locked": True}})


def _answer(asked: AskedAnswer) -> NotebookNode:
    """A cell that is graded by hand as nbgrader sees it: graphcam is the hand."""
    graded = CELL | {"grade_id": asked.name, "grade": True, "solution": True, "points": asked.marks}
    source = f"{asked.name} = None\n{SOLUTION_MARKS}"
    return nb.new_code_cell(source, id=asked.name, metadata={"tags": [ANSWER_TAG], "nbgrader": graded})
