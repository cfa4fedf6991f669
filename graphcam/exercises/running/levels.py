"""Levels of isolation, from reading data to the host's own container."""

from __future__ import annotations

from enum import StrEnum


class Level(StrEnum):
    """How far a student's code is kept from everything else; in order, the stricter the later."""

    L0 = "L0"
    """Nothing is run: answers are data."""
    L1 = "L1"
    """A process with limits of time and memory: for practice, since it reads what the grader can read."""
    L2 = "L2"
    """Bubblewrap: no network, no file but Python itself, no process that outlives it."""
