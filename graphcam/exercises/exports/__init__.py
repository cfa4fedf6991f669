"""Exercises for other systems: question banks, courses, autograders."""

from enum import StrEnum


class LearningSystem(StrEnum):
    """A system that keeps questions, courses or scores."""

    MOODLE = "moodle"
    MOODLE_CLOZE = "moodle-cloze"
    CANVAS = "canvas"
    QTI = "qti"
    PRAIRIELEARN = "prairielearn"
    NBGRADER = "nbgrader"
    GRADESCOPE = "gradescope"
