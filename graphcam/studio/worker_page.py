"""The page whose engine runs in the browser: what it is made of, and what it may do."""

from __future__ import annotations

import gzip
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

from graphcam.studio.engine import answer
from graphcam.studio.page import page
from graphcam.studio.plain_tasks import built_in_tasks, nearest_built_in, plain_task
from graphcam.studio.pyodide_parts import pyodide_parts
from graphcam.studio.script_names import script_names
from graphcam.studio.wasm_archives import engine_archive
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task

ENGINE = "graphcam.zip"
"""The engine as the page carries it."""
FIRST_VIEWS = ("combined", "region", "profile")
"""The view that the page opens with: the first of these that there is."""
PX_PER_MM = 2.0
"""The scale for which the first view is lettered."""
LICENCES = """\
graphcam: MIT.  Its lettering, osifont: LGPL-3.0-only or GPL-3.0-only with the font exception.
Pyodide: Mozilla Public License 2.0, https://github.com/pyodide/pyodide
CPython: Python Software Foundation License 2.0, https://github.com/python/cpython
NumPy: BSD 3-Clause; lazy_loader: BSD 3-Clause; tomli_w: MIT; typing_extensions: PSF 2.0.
Their texts stand in the archives numpy.zip and graphcam.zip.
"""


def engine_parts(pyodide: Path) -> dict[str, bytes]:
    """Everything that the worker is made of, by its names, each compressed.

    pyodide : the folder with Pyodide and NumPy

    Raises
    ------
    TaskError : a file of them is not there, or not known
    """
    parts = {**pyodide_parts(pyodide), ENGINE: engine_archive()}
    # Without the time: the same parts make the same bytes.
    return {name: gzip.compress(part, 9, mtime=0) for name, part in parts.items()}


def own_script(name: str) -> str:
    """A script that belongs to pages whose engine runs in the browser."""
    return (files("graphcam") / "data" / "studio" / name).read_text(encoding="utf-8")


def worker_page(task: Task | ArcsTask, language: str, policy: str, script: str, more: Mapping[str, Any]) -> str:
    """The page, with the first view drawn already; nothing but its own scripts may run in it.

    policy : content security policy with a place ``{scripts}`` for the names of the scripts
    script : stands before those of the page
    more : what the page must know besides
    """
    plain = plain_task(task)
    config = {
        "transport": "worker",
        "task": plain,
        "name": nearest_built_in(task),
        "builtin": built_in_tasks(),
        "language": language,
        "first": first_answer(plain, language),
        **more,
    }
    bare = page(config, "", (script,))
    return page(config, policy.format(scripts=script_names(bare)), (script,))


def first_answer(task: Mapping[str, Any], language: str) -> dict[str, Any]:
    """What the engine would answer first."""
    asked = {"ask": "views", "seq": 0, "task": task, "language": language}
    names = [view["name"] for view in answer({**asked, "views": []})["names"]]
    name = next((name for name in FIRST_VIEWS if name in names), names[0])
    wanted = dict.fromkeys(("told", "values", "warnings", "form", "mechanism"), True)
    return answer({**asked, **wanted, "views": [{"name": name, "px_per_mm": PX_PER_MM}]})
