"""Foreign programs that read what graphcam writes."""

from __future__ import annotations

import os
import shutil

import pytest

from graphcam.sheets.model import Circles, Entity, Heads, Strokes


def count(entity: Entity) -> int:
    """How many entities of a CAD program the entity makes."""
    match entity:
        case Strokes(starts=items) | Circles(centres=items) | Heads(corners=items):
            return len(items)
        case _:
            return 1


def program(name: str) -> str:
    """Where a program is; without it the test fails in CI, which installs it, and is skipped elsewhere."""
    if found := shutil.which(name):
        return found
    why = f"the program {name} is not installed"
    if os.environ.get("CI"):
        pytest.fail(why)
    pytest.skip(why)
