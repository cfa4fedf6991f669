"""The studio in one file of HTML: it opens by a double click and asks nobody for anything."""

from __future__ import annotations

import base64
from pathlib import Path

from graphcam.files import whole_file
from graphcam.language import ENGLISH
from graphcam.studio.worker_page import LICENCES, engine_parts, own_script, worker_page
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task

POLICY = (
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
    text = worker_page(task, language, POLICY, own_script("start_engine.js"), {"engine": own_script("worker.js")})
    carried = "\n".join(
        f'<script type="text/plain" data-part="{name}">{base64.b64encode(part).decode()}</script>'
        for name, part in parts.items()
    )
    before, end, after = text.rpartition("</body>")
    with whole_file(path) as draft:
        draft.write_text(f"{before}<!--\n{LICENCES}-->\n{carried}\n{end}{after}", encoding="utf-8", newline="\n")
