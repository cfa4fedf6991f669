"""The files of a sizing: chart, front as a table, results as JSON and the sized task; all of them or none."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING

from graphcam.files import digest, whole_folder
from graphcam.language import language as language_of
from graphcam.report.output_folder import SHEET_KINDS, ignore_progress, write_sheet, written_before
from graphcam.report.sheet_contents import title_block
from graphcam.report.sizing_sheet import TITLES_BY_OBJECTIVE, sizing_sheet
from graphcam.solving.sizing_design import plain_cam
from graphcam.tasks.task_writer import TASK_FILE, task_files
from graphcam.words import Words, say

if TYPE_CHECKING:
    from graphcam.sheets.model import Drawing
    from graphcam.solving.sizing_design import Sizing

RESULTS_FILE = "sizing.json"
"""The name of the file that lists all others."""
FRONT_FILE = "front.csv"
SIZED_TASK_FILE = "sized.toml"
"""The name of the sized task, which ``graphcam solve`` draws."""
FILE_STEM = "sizing"


def write(
    sizing: Sizing, folder: Path | str, language: str | None = None, progress: Callable[[Words], None] | None = None
) -> dict[str, str]:
    """Write a sizing into a folder, as :meth:`~graphcam.solving.sizing_design.Sizing.write` says."""
    report = progress or ignore_progress
    with whole_folder(folder, written_before(Path(folder), RESULTS_FILE)) as draft:
        report(say("laying out the chart"))
        files = write_sheet(chart(sizing, language), draft, FILE_STEM, SHEET_KINDS, "plain", report)
        (draft / FRONT_FILE).write_text(_csv(sizing), encoding="utf-8", newline="")
        files |= {"csv": FRONT_FILE, **write_task(sizing, draft)}
        files["json"] = RESULTS_FILE
        digests = {path.name: digest(path) for path in sorted(draft.iterdir())}
        document = {**sizing.to_dict(), "files": files, "written": digests}
        text = json.dumps(document, indent=2, ensure_ascii=False, allow_nan=False)
        (draft / RESULTS_FILE).write_text(text + "\n", encoding="utf-8", newline="\n")
    return files


def chart(sizing: Sizing, language: str | None = None) -> Drawing:
    """The sheet of a sizing, on the task's paper with its title block.

    language : by default the task's
    """
    paper = sizing.task.drawing
    language = paper.language if language is None else language
    spoken = language_of(language)
    block = title_block(sizing.task.title, spoken.text, spoken.remark)
    return sizing_sheet(
        sizing.best,
        paper.format,
        paper.frame,
        language,
        front=sizing.front,
        adopted=sizing.adopted,
        title=TITLES_BY_OBJECTIVE[sizing.objective],
        block=block,
        orientation=paper.orientation,
    )


def write_task(sizing: Sizing, folder: Path) -> dict[str, str]:
    """Write the sized task, and the table of a measured motion beside it; returns the file names by kind."""
    written: dict[str, str] = {}
    for name, text in task_files(sizing.sized_task).items():
        kind, name = ("task", SIZED_TASK_FILE) if name == TASK_FILE else ("table", name)
        (folder / name).write_text(text, encoding="utf-8", newline="")
        written[kind] = name
    return written


def _csv(sizing: Sizing) -> str:
    text = StringIO(newline="")
    rows = [plain_cam(cam) for cam in sizing.front]
    table = csv.DictWriter(text, rows[0])
    table.writeheader()
    table.writerows(rows)
    return text.getvalue()
