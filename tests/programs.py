"""Foreign programs that read what graphcam writes."""

from __future__ import annotations

import importlib
import os
import shutil
from types import ModuleType
from typing import NoReturn

import pytest

from graphcam.sheets.fonts import pieces
from graphcam.sheets.model import Circles, Entity, Heads, Strokes, Text


def count(entity: Entity) -> int:
    """How many entities of a CAD program the entity makes."""
    match entity:
        case Strokes(starts=items) | Circles(centres=items) | Heads(corners=items):
            return len(items)
        case Text():
            return len(pieces(entity.text, entity.height))
        case _:
            return 1


def program(name: str) -> str:
    """Where a program is; without it the test fails in CI, which installs it, and is skipped elsewhere."""
    return shutil.which(name) or missing(f"the program {name} is not installed")


def library(name: str) -> ModuleType:
    """A package of another program, which may need libraries of the system that are not there; the same holds."""
    try:
        return importlib.import_module(name)
    except (ImportError, OSError) as error:
        missing(f"{name} cannot be loaded: {error}")


def missing(why: str) -> NoReturn:
    """Fail in CI, skip elsewhere."""
    if os.environ.get("CI"):
        pytest.fail(why)
    pytest.skip(why)
