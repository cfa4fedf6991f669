"""The page whose engine runs in the browser, in one file of HTML or as a folder for any web server."""

from __future__ import annotations

import gzip
import hashlib
import json
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from graphcam.files import whole_file, whole_folder
from graphcam.language import ENGLISH
from graphcam.studio.engine import answer
from graphcam.studio.pyodide_parts import (
    LOCK_FILE,
    STANDARD_LIBRARY_FILE,
    engine_archive,
    library_archive,
    lock_without_packages,
    pyodide_parts,
)
from graphcam.studio.studio_page import page, script_names
from graphcam.studio.task_text import page_config
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task

ENGINE_FILE = "graphcam.zip"
"""The engine as the page carries it."""
FIRST_VIEWS = ("acceleration", "velocity", "displacement", "angle")
"""The views that the page opens with, beside the mechanism: those of these that there are."""
PX_PER_MM = 1.0
"""The scale for which the first views are lettered."""
USUAL_ANGLE = 30.0
"""The cam angle with which it opens [degrees]."""
LICENCE_NOTE = """\
graphcam: MIT.  Its lettering, osifont: LGPL-3.0-only or GPL-3.0-only with the font exception.
Pyodide: Mozilla Public License 2.0, https://github.com/pyodide/pyodide
CPython: Python Software Foundation License 2.0, https://github.com/python/cpython
NumPy: BSD 3-Clause; lazy_loader: BSD 3-Clause; tomli_w: MIT.
Their texts stand in the archives numpy.zip and graphcam.zip.
"""


def engine_parts(pyodide: Path) -> dict[str, bytes]:
    """Everything that the worker is made of, by its names, each compressed.

    pyodide : the folder with Pyodide and NumPy

    Raises
    ------
    TaskError : a file of them is not there, or not known
    """
    parts = {**pyodide_parts(pyodide), ENGINE_FILE: engine_archive()}
    parts[STANDARD_LIBRARY_FILE] = library_archive(parts[STANDARD_LIBRARY_FILE])
    parts[LOCK_FILE] = lock_without_packages(parts[LOCK_FILE])
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
    config = page_config(task, language, transport="worker", **more)
    config["first"] = first_answer(config["task"], language)
    bare = page(config, "", (script,))
    return page(config, policy.format(scripts=script_names(bare)), (script,))


def first_answer(task: Mapping[str, Any], language: str) -> dict[str, Any]:
    """What the engine would answer first."""
    asked = {"ask": "views", "seq": 0, "task": task, "language": language, "phi": USUAL_ANGLE}
    wanted = dict.fromkeys(("told", "values", "warnings", "form", "mechanism"), True)
    views = [{"name": name, "px_per_mm": PX_PER_MM, "plain": True} for name in FIRST_VIEWS]
    return answer({**asked, **wanted, "views": views})


LETTERS = np.array([b"!" if code == ord("<") else bytes([code]) for code in range(ord("#"), ord("~"))])
"""The digits of :func:`lettered`: printable letters that need no care in a script, without the one that ends it."""
LETTERED_BITS = 13
"""Two of them hold so many bits: a sixteenth less room than base64 takes."""


def lettered(content: bytes) -> str:
    """Bytes as letters: how many they are, a colon, and two digits for thirteen bits.

    >>> lettered(b"graphcam"), len(lettered(bytes(1300)))
    ('8:GE=jg+4N+%', 1605)
    """
    bits = np.unpackbits(np.frombuffer(content, dtype=np.uint8))
    pairs = np.pad(bits, (0, -bits.size % LETTERED_BITS)).reshape(-1, LETTERED_BITS)
    digits = np.divmod(pairs @ (1 << np.arange(LETTERED_BITS, dtype=np.uint16)[::-1]), LETTERS.size)
    return f"{len(content)}:{LETTERS[np.column_stack(digits)].tobytes().decode('ascii')}"


FILE_POLICY = (
    "default-src 'none'; script-src {scripts} 'wasm-unsafe-eval' blob:; worker-src blob:; style-src 'unsafe-inline'; "
    "font-src data:; img-src data:; base-uri 'none'; form-action 'none'"
)
"""The content policy of the file: its own scripts and a worker made of them; no connection of any kind."""


def write_one_file(path: Path, pyodide: Path, task: Task | ArcsTask, language: str = ENGLISH.name) -> None:
    """Write the studio as one file.

    pyodide : folder with Pyodide and NumPy, see :mod:`graphcam.studio.pyodide_parts`
    task : with which it opens
    language : of the page

    Raises
    ------
    TaskError : a part of Pyodide is not there, or not known
    OutputError : the file cannot be written
    """
    parts = engine_parts(pyodide)
    text = worker_page(task, language, FILE_POLICY, own_script("start_engine.js"), {"engine": own_script("worker.js")})
    carried = "\n".join(
        f'<script type="text/plain" data-part="{name}">{lettered(part)}</script>' for name, part in parts.items()
    )
    before, end, after = text.rpartition("</body>")
    with whole_file(path) as draft:
        draft.write_text(f"{before}<!--\n{LICENCE_NOTE}-->\n{carried}\n{end}{after}", encoding="utf-8", newline="\n")


SITE_POLICY = (
    "default-src 'none'; script-src {scripts} 'self'; worker-src 'self'; connect-src 'self'; "
    "style-src 'unsafe-inline'; font-src data:; img-src data:; base-uri 'none'; form-action 'none'"
)
"""The content policy of the site: its own scripts, and what lies in the same folder."""
BUILD_DIGITS = 12
"""Digits of the sum that names a build."""


def write_site(folder: Path, pyodide: Path, task: Task | ArcsTask, language: str = ENGLISH.name) -> None:
    """Write the studio as a folder: ``index.html``, and beside it the files of this build, named by their sum.

    pyodide : folder with Pyodide and NumPy, see :mod:`graphcam.studio.pyodide_parts`
    task : with which it opens
    language : of the page

    Raises
    ------
    TaskError : a part of Pyodide is not there, or not known
    OutputError : the folder cannot be written
    """
    beside = {f"{name}.gz": part for name, part in engine_parts(pyodide).items()}
    beside["worker.js"] = own_script("worker.js").encode()
    build = _build(beside)
    named = {f"{build}-{name}": content for name, content in beside.items()}
    more = {"worker": f"{build}-worker.js"}
    text = worker_page(task, language, SITE_POLICY, own_script("keep_site.js"), more)
    # The page belongs to the build too, although its name stays.
    kept = f"{build}-{_build({'index.html': text.encode()})}"
    files = json.dumps(list(named))
    service = f"const BUILD = {json.dumps(kept)}, FILES = {files};\n{own_script('service_worker.js')}"
    with whole_folder(folder) as draft:
        for name, content in named.items():
            (draft / name).write_bytes(content)
        (draft / "index.html").write_text(text, encoding="utf-8", newline="\n")
        (draft / "service-worker.js").write_text(service, encoding="utf-8", newline="\n")
        (draft / "licences.txt").write_text(LICENCE_NOTE, encoding="utf-8", newline="\n")


def _build(contents: dict[str, bytes]) -> str:
    """The check sum of some files, as a name."""
    total = hashlib.sha256()
    for name, content in contents.items():
        total.update(f"{name} {len(content)}\n".encode() + content)
    return total.hexdigest()[:BUILD_DIGITS]
