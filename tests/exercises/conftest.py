"""What the tests of the exercises share."""

from __future__ import annotations

import pytest

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.definition.exercise_file import find_exercise


@pytest.fixture(scope="module")
def exercise() -> Exercise:
    return find_exercise("acceleration-and-scales")
