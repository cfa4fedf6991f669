"""A whole course, graded: read, shared out, kept, and put together in the order of the names."""

from __future__ import annotations

from collections.abc import Callable, Generator
from functools import partial
from pathlib import Path
from typing import Any

from graphcam.drafting.ink import say
from graphcam.exercises.course.course_folder import AnswerKeys
from graphcam.exercises.grading.grade_one import Assignment, grade, unmarked
from graphcam.exercises.grading.record_store import Store
from graphcam.exercises.grading.submission import Submission, read_submission, students_in
from graphcam.exercises.running.levels import Level
from graphcam.workers import BATCH, WorkerPool, results

Records = list[dict[str, Any]]
"""Records as JSON takes them, in the order of the students' names."""
CRASHED = say("the grader broke down over this hand-in; look at it by hand")


def grade_folder(
    folder: Path,
    assignment: Assignment,
    pool: WorkerPool,
    store: Store,
    kept: AnswerKeys,
    step: Callable[[int, int], None] = lambda done, total: None,
) -> Records:
    """One record for each student's folder.

    kept : the students' answer keys; who has none yet gets one
    step : hears how many of how many are done

    Raises
    ------
    TaskError : there is no such folder
    """
    students = students_in(folder, kept.student, lambda student: bool(kept.find(student)))
    found: dict[str, dict[str, Any]] = {}

    def unfinished() -> Generator[Submission]:
        for student, path in students:
            submission = read_submission(student, path, kept.find(student), assignment.exercise.name)
            if (record := store.find(submission)) is not None:
                found[path.name] = record
                step(len(found), len(students))
            else:
                yield submission

    # Code takes so long that it travels alone, else one worker is left with the rest.
    batch = BATCH if assignment.level is Level.L0 else 1
    for submission, graded in results(pool, partial(grade, assignment), unfinished(), batch):
        if graded is not None and graded.answer_key and graded.answer_key != submission.answer_key:
            kept.keep(submission.student, graded.answer_key)
        record = graded.record if graded is not None else unmarked(assignment, submission.student, CRASHED)
        found[submission.place] = record.to_dict()
        store.keep(submission, found[submission.place])
        step(len(found), len(students))
    return [found[path.name] for _, path in students]
