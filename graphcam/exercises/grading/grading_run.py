"""A whole course, graded: read, shared out, kept, and put together in the order of the names."""

from __future__ import annotations

from collections.abc import Callable, Generator
from functools import partial
from pathlib import Path
from typing import Any

from graphcam.drafting.ink import say
from graphcam.exercises.course.course_folder import Certificates
from graphcam.exercises.grading.grade_one import Assignment, grade, unmarked
from graphcam.exercises.grading.record_store import Store
from graphcam.exercises.grading.submission import HandIn, read_hand_in, students_in
from graphcam.exercises.grading.worker_pool import BATCH, Crew, results
from graphcam.exercises.running.levels import Level

Records = list[dict[str, Any]]
"""Records as JSON takes them, in the order of the students' names."""
CRASHED = say("the grader broke down over this hand-in; look at it by hand")


def grade_folder(
    folder: Path, assignment: Assignment, crew: Crew, store: Store, kept: Certificates,
    step: Callable[[int, int], None] = lambda done, total: None,
) -> Records:  # fmt: skip
    """One record for each student's folder.

    kept : the students' certificates; what has none yet gets one
    step : hears how many of how many are done

    Raises
    ------
    TaskError : there is no such folder
    """
    students = students_in(folder, kept.student, lambda student: bool(kept.find(student)))
    found: dict[str, dict[str, Any]] = {}

    def unfinished() -> Generator[HandIn]:
        for student, path in students:
            hand_in = read_hand_in(student, path, kept.find(student), assignment.exercise.name)
            if (record := store.find(hand_in)) is not None:
                found[path.name] = record
                step(len(found), len(students))
            else:
                yield hand_in

    # Code takes so long that it travels alone, else one worker is left with the rest.
    batch = BATCH if assignment.level is Level.L0 else 1
    for hand_in, graded in results(crew, partial(grade, assignment), unfinished(), batch):
        if graded is not None and graded.certificate and graded.certificate != hand_in.certificate:
            kept.keep(hand_in.student, graded.certificate)
        record = graded.record if graded is not None else unmarked(assignment, hand_in.student, CRASHED)
        found[hand_in.place] = record.to_dict()
        store.keep(hand_in, found[hand_in.place])
        step(len(found), len(students))
    return [found[path.name] for _, path in students]
