"""The studio as a folder for any web server: it is kept at the first visit, and then works without a network."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from graphcam.files import whole_folder
from graphcam.language import ENGLISH
from graphcam.studio.worker_page import LICENCES, engine_parts, own_script, worker_page
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task

POLICY = (
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
    text = worker_page(task, language, POLICY, own_script("keep_site.js"), more)
    # The page belongs to the build too, although its name stays.
    kept = f"{build}-{_build({'index.html': text.encode()})}"
    files = json.dumps(list(named))
    service = f"const BUILD = {json.dumps(kept)}, FILES = {files};\n{own_script('service_worker.js')}"
    with whole_folder(folder) as draft:
        for name, content in named.items():
            (draft / name).write_bytes(content)
        (draft / "index.html").write_text(text, encoding="utf-8", newline="\n")
        (draft / "service-worker.js").write_text(service, encoding="utf-8", newline="\n")
        (draft / "licences.txt").write_text(LICENCES, encoding="utf-8", newline="\n")


def _build(contents: dict[str, bytes]) -> str:
    """The sum of some files."""
    total = hashlib.sha256()
    for name, content in contents.items():
        total.update(f"{name} {len(content)}\n".encode() + content)
    return total.hexdigest()[:BUILD_DIGITS]
