"""Foreign programs that read what graphcam writes."""

from __future__ import annotations

import importlib
import os
import shutil
import subprocess
from pathlib import Path
from types import ModuleType
from typing import NoReturn

import pytest

from graphcam.sheets.fonts import letters_of
from graphcam.sheets.model import Circles, Entity, Heads, Strokes, Text


def count(entity: Entity) -> int:
    """How many entities of a CAD program the entity makes."""
    match entity:
        case Strokes(starts=items) | Circles(centres=items) | Heads(corners=items):
            return len(items)
        case Text():
            return len(letters_of(entity.text, entity.height))
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


def freecad(script: str, folder: Path) -> list[str]:
    """What FreeCAD finds: the words behind FOUND in the one line that the script prints so."""
    place = folder / "read.py"
    place.write_text(script, encoding="utf-8")
    # Its own Python must not meet ours.
    clean = {key: value for key, value in os.environ.items() if key not in ("VIRTUAL_ENV", "PYTHONPATH")}
    command, windowless = [program("freecadcmd"), place], clean | {"QT_QPA_PLATFORM": "offscreen"}
    out = subprocess.run(
        command, check=False, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300, env=windowless
    ).stdout
    (line,) = (line for line in out.splitlines() if line.startswith("FOUND"))
    return line.split()[1:]


def missing(why: str) -> NoReturn:
    """Fail in CI, skip elsewhere."""
    if os.environ.get("CI"):
        pytest.fail(why)
    pytest.skip(why)
