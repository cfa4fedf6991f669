"""Step players of solved tasks, and what is seen of them in a browser."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import graphcam as gc
from graphcam.language import ENGLISH
from graphcam.report.documents import contents_of, drawing_of, scene_of
from graphcam.report.step_player import player_of, slides
from graphcam.tasks.task import DrawingTable
from graphcam.tasks.task_file import builtin_arcs_task, builtin_task

if TYPE_CHECKING:
    from playwright.sync_api import Page


def task_of(name: str) -> gc.Task:
    if name == "arcs":
        return builtin_arcs_task()
    task = builtin_task("coursework" if name in ("pages", "knife") else name)
    if name == "pages":
        return replace(task, drawing=DrawingTable(format="A3"))
    return replace(task, follower=replace(task.follower, roller_radius=0.0)) if name == "knife" else task


class Solved:
    """A solution, its sheet, and its player in a file."""

    def __init__(self, name: str, folder: Path) -> None:
        self.solution = gc.solve(task_of(name))
        contents = contents_of(self.solution)
        self.drawing = drawing_of(contents)
        self.text = player_of(contents, self.drawing)
        self.file = folder / f"{name}.html"
        self.file.write_text(self.text, encoding="utf-8")
        self.slides, _ = slides(contents, ENGLISH.text)
        self.scene = scene_of(self.solution)


def watch(page: Page, file: Path, complaints: list[str]) -> None:
    page.on("console", lambda message: complaints.append(message.text))
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("request", lambda request: outside(request.url, file) and complaints.append(request.url))


def outside(url: str, file: Path) -> bool:
    return not (url.startswith("data:") or url.split("#")[0] == file.as_uri())
