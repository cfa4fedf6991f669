"""A course for nbgrader: an assignment with a cell for every answer.

The notebook is the same for all; a student's parameters stand on the student's own sheet and are derived again when it
is graded.  A locked cell could not hold them: nbgrader's autograde puts the teacher's cell back in its place.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from graphcam.exercises.course.folder_names import folder_name
from graphcam.exercises.definition.exercise import Asked, Exercise
from graphcam.exercises.definition.template import sentence
from graphcam.exercises.grading.gradebook import NOTEBOOK
from graphcam.exercises.key.answer_key import AnswerKey
from graphcam.exercises.reading.notebook import TAG
from graphcam.words import Tell, say

CELL = {"schema_version": 3, "grade": False, "solution": False, "locked": False, "task": False}
"""What nbgrader wants to know of every cell."""
CONFIG = '''"""The settings of this course; graphcam grades, nbgrader keeps the scores."""

c = get_config()
c.CourseDirectory.course_id = {course!r}
# Stands in the student's notebook in place of a solution.
c.ClearSolutions.code_stub = {{"python": {stub!r}}}
'''
SOLUTION = "### BEGIN SOLUTION\n### END SOLUTION"
"""Without these nbgrader takes a whole cell for the solution, and the student gets one without the answer's name."""


def write_course(folder: Path, exercise: Exercise, answer_keys: Sequence[AnswerKey]) -> None:
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
    for answer_key in answer_keys:
        told = sentence(exercise.text, answer_key.parameters, tell)
        text = f"# {exercise.title}\n\n{answer_key.student}\n\n{told}"
        (sheets / f"{folder_name(answer_key.student)}.md").write_text(text, encoding="utf-8")


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
    graded = CELL | {"grade_id": name, "locked": True}
    return {"id": name, "cell_type": "markdown", "source": text, "metadata": {"nbgrader": graded}}


def _answer(asked: Asked) -> dict[str, Any]:
    """A cell that is graded by hand as nbgrader sees it: graphcam is the hand."""
    graded = CELL | {"grade_id": asked.name, "grade": True, "solution": True, "points": asked.marks}
    metadata, source = {"tags": [TAG], "nbgrader": graded}, f"{asked.name} = None\n{SOLUTION}"
    cell = {"id": asked.name, "cell_type": "code", "source": source, "metadata": metadata}
    return cell | {"outputs": [], "execution_count": None}
