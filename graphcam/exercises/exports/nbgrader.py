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

SCHEMA = 3
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
