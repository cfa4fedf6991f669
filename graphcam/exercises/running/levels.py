"""Levels of isolation, from reading data to the host's own container."""

from __future__ import annotations

from enum import StrEnum


class Level(StrEnum):
    """How far a student's code is kept from everything else; in order, the stricter the greater.

    >>> Level.L2.contains(Level.L1), Level.L0.contains(Level.L1)
    (True, False)
    """

    L0 = "L0"
    """Nothing is run: answers are data."""
    L1 = "L1"
    """A process with limits of time and memory: for practice, since it reads what the grader can read."""
    L2 = "L2"
    """Bubblewrap: no network, no file but Python itself, no process that outlives it."""

    def contains(self, other: Level) -> bool:
        """Whether whatever may run at ``other`` may run here too."""
        return self >= other
