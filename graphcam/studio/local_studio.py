"""The studio of this machine: the page, the engine and the folder, behind the local server."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from graphcam.language import ENGLISH
from graphcam.studio.address import StudioPlace, address_of
from graphcam.studio.engine import answer
from graphcam.studio.page import page
from graphcam.studio.plain_tasks import built_in_tasks, nearest_built_in, plain_task
from graphcam.studio.server import StudioServer
from graphcam.studio.written_files import NOTEBOOK, PART, WrittenFiles
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task

WRITES = "sheet", "note", NOTEBOOK, PART
"""What the page offers to write."""
LONGEST = 100_000
"""Characters of an address that is opened here and sent to nobody, and may tell a measured table."""


def local_studio(folder: Path, language: str = ENGLISH.name) -> StudioServer:
    """A server with the page, for any task.

    folder : where files are written
    language : of the page

    >>> with local_studio(Path("out")) as server:
    ...     b"<title>" in server.page
    True
    """
    builtin = built_in_tasks()
    config: dict[str, Any] = {
        "transport": "server",
        "task": builtin["coursework"],
        "name": "coursework",
        "builtin": builtin,
        "language": language,
        "writes": WRITES,
    }
    return StudioServer(page(config), answer, WrittenFiles(folder, language).write)


def opened_address(server: StudioServer, task: Task | ArcsTask) -> str:
    """The address at which the page shows a task: the page has no data in itself, so the address tells it.

    Raises
    ------
    DesignError : an address cannot tell so large a task

    >>> import graphcam as gc
    >>> with local_studio(Path("out")) as server:
    ...     opened_address(server, gc.builtin_task("arm")).removeprefix(server.address)[:3]
    '&1.'
    """
    place = StudioPlace(plain_task(task), nearest_built_in(task))
    return f"{server.address}&{address_of(place, built_in_tasks(), LONGEST).removeprefix('#')}"
