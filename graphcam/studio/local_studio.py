"""The studio of this machine: the page, the engine and the files that it writes, behind the local server."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from graphcam.errors import DesignError, GraphcamError, choice_limit
from graphcam.files import digest
from graphcam.language import ENGLISH, language
from graphcam.showing import higher_function
from graphcam.solving.shown_solution import CUTTING_KINDS, DEFAULT_KINDS
from graphcam.solving.solve import solve
from graphcam.studio.address import StudioPlace, address_of
from graphcam.studio.engine import answer, error_data
from graphcam.studio.server import StudioServer
from graphcam.studio.studio_page import page
from graphcam.studio.task_paths import table_in
from graphcam.studio.task_text import built_in_tasks, nearest_built_in, page_config, plain_task
from graphcam.studio.views_request import TaskRequest, read_request, task_in
from graphcam.tasks.arcs_task import ArcsTask
from graphcam.tasks.task import Task
from graphcam.tasks.task_file import builtin_task

TABLE_FILE = "measured.csv"
"""What the file of a measured table is called, for the page can name no file."""
PART_CHOICE, NOTEBOOK_CHOICE = "working drawing", "notebook"
FILES_BY_CHOICE: Mapping[str, tuple[str, ...]] = {
    "sheet": ("pdf", "svg", "png", "dxf", "player"),
    "note": ("csv", "md", "note", "note_html"),
    NOTEBOOK_CHOICE: (),
    PART_CHOICE: ("profile_dxf", "profile_csv", "profile_xyz", *CUTTING_KINDS),
    "all": DEFAULT_KINDS,
}
"""What can be asked for, and the kinds of files of a solution that it is."""


@dataclass
class WrittenFiles:
    """The files of a session, in one folder that holds one cam: what was asked for before comes along anew.

    Files in the folder that the session has not written, or that somebody has changed since, are not replaced unasked.

    folder : where they go; the page cannot choose another
    language : of what is written, where the task says none
    own : the files that the session has written, with their digests
    """

    folder: Path
    language: str = "en"
    kinds: frozenset[str] = field(default=frozenset(), init=False)
    own: dict[Path, str] = field(default_factory=dict[Path, str], init=False)

    def write(self, request: Mapping[str, Any]) -> dict[str, Any]:
        """Write the files of a request's "kind" for its "task": their names and the folder, or what is wrong.

        Where there are files of others, their names and the folder alone, unless the request says "replace".

        >>> WrittenFiles(Path("out")).write({"kind": "../notes", "task": {}})["error"]["message"]
        "kind is '../notes', but must be one of sheet, note, notebook, working drawing, all"
        """
        from graphcam.report.output_folder import SOLUTION_FILE

        try:
            kind = request.get("kind")
            if not isinstance(kind, str) or kind not in FILES_BY_CHOICE:
                raise DesignError("kind", kind, *choice_limit(kind, FILES_BY_CHOICE))
            task = self._task(request)
            folder = self.folder / kind if kind == NOTEBOOK_CHOICE else self.folder
            if (others := self._others(folder)) and request.get("replace") is not True:
                return {"others": others, "folder": str(folder)}
            names = self._written(kind, task, folder)
            written = {*names, SOLUTION_FILE}
            self.own |= {path: digest(path) for path in _files_in(folder) if path.name in written}
        except GraphcamError as error:
            return {"error": {"field": "", **error_data(error, language(self.language))}}
        except OSError as error:
            return {"error": {"field": "", "message": str(error), "remedy": ""}}
        return {"files": names, "folder": str(folder)}

    def _task(self, request: Mapping[str, Any]) -> Task | ArcsTask:
        data = read_request(TaskRequest, request).task
        said = table_in(data, "drawing").get("language")
        task = task_in(data, self.language if said is None else said)
        if isinstance(task, ArcsTask) or task.motion.table is None:
            return task
        return replace(task, motion=replace(task.motion, table=replace(task.motion.table, file=TABLE_FILE)))

    def _others(self, folder: Path) -> list[str]:
        """The names of files in a folder that are not as the session has written them."""
        return [path.name for path in _files_in(folder) if path not in self.own or self.own[path] != digest(path)]

    def _written(self, kind: str, task: Task | ArcsTask, folder: Path) -> list[str]:
        if kind == NOTEBOOK_CHOICE:
            return higher_function("notebooks.notebook_folder.write_folder")(task, folder)
        solution, kinds = solve(task), self.kinds | {kind}
        part = PART_CHOICE in kinds
        if part and kind != PART_CHOICE:
            part = _has_part(solution)
        files = (file for each in (kinds if part else kinds - {PART_CHOICE}) for file in FILES_BY_CHOICE[each])
        names = solution.write(folder, list(dict.fromkeys(files)), working_drawing=part)
        self.kinds = kinds
        return [name for name in names.values() if name]


def _files_in(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.is_file()) if folder.is_dir() else []


def _has_part(solution: Any) -> bool:
    """Whether there can be a working drawing of another cam than that for which it was asked."""
    from graphcam.report.output_folder import check_choices

    try:
        check_choices(solution, working_drawing=True)
    except DesignError:
        return False
    return True


WRITTEN_KINDS = "sheet", "note", NOTEBOOK_CHOICE, PART_CHOICE
"""What the page offers to write."""
MAX_ADDRESS_LENGTH = 100_000
"""Characters of an address that is opened here and sent to nobody, and may tell a measured table."""


def local_studio(folder: Path, language: str = ENGLISH.name) -> StudioServer:
    """A server with the page, for any task.

    folder : where files are written
    language : of the page

    >>> with local_studio(Path("out")) as server:
    ...     "<title>" in server.page
    True
    """
    config = page_config(builtin_task(), language, transport="server", writes=WRITTEN_KINDS)
    return StudioServer(page(config), answer, WrittenFiles(folder, language).write)


def opened_address(server: StudioServer, task: Task | ArcsTask) -> str:
    """The address at which the page shows a task's mechanism: the page has no data in itself, so the address tells it.

    Raises
    ------
    DesignError : an address cannot tell so large a task

    >>> import graphcam as gc
    >>> with local_studio(Path("out")) as server:
    ...     opened_address(server, gc.builtin_task("arm")).removeprefix(server.address)[:3]
    '&1.'
    """
    place = StudioPlace(plain_task(task), nearest_built_in(task), view="mechanism")
    return f"{server.address}&{address_of(place, built_in_tasks(), MAX_ADDRESS_LENGTH).removeprefix('#')}"
