"""The systems that exercises can be exported for."""

from enum import StrEnum


class LearningSystem(StrEnum):
    """A system that keeps questions, courses or scores."""

    MOODLE = "moodle"
    NBGRADER = "nbgrader"
    GRADESCOPE = "gradescope"
