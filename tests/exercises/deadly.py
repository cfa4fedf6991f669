"""Grading that dies: a module of its own, so that other processes find it."""

from __future__ import annotations

import os
import signal

from graphcam.exercises.grading import grade_one as work
from graphcam.exercises.grading.grade_one import Submission


def grade(assignment: work.Assignment, submission: Submission) -> work.GradedSubmission:
    """Grade, but for a hand-in that takes its worker with it."""
    if submission.student.startswith("deadly"):
        os.kill(os.getpid(), signal.SIGKILL)
    return work.grade(assignment, submission)
