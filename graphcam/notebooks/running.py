"""Executing a notebook from a clean kernel."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

from nbformat import NotebookNode

from graphcam.errors import GraphcamError
from graphcam.notebooks.extra import needed

LONGEST = 120
"""Seconds that one cell may take."""


class NotebookError(GraphcamError):
    """A notebook whose cell fails, or warns: the cell's source and what it said.

    >>> print(NotebookError("1 / 0", "ZeroDivisionError: division by zero"))
    ZeroDivisionError: division by zero
    in the cell
    1 / 0
    """

    def __init__(self, cell: str, said: str) -> None:
        super().__init__(cell, said)
        self.cell = cell
        self.said = said

    def __str__(self) -> str:
        return f"{self.said}\nin the cell\n{self.cell}"


def execute(notebook: NotebookNode, folder: Path | str = ".") -> NotebookNode:
    """The notebook with its outputs, executed in the folder by a new kernel.

    Raises
    ------
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    NotebookError : a cell fails, or warns (writes to standard error)
    """
    nbclient = needed("nbclient", "executing a notebook")
    needed("ipykernel", "executing a notebook")
    executed = NotebookNode(notebook)
    client = nbclient.NotebookClient(executed, timeout=LONGEST, kernel_name="python3")
    client.resources = {"metadata": {"path": str(folder)}}
    client.extra_arguments = ["--log-level=ERROR"]
    # What the sliders show is on the page as well.
    client.store_widget_state = False
    # What failed stands in the outputs, beside what only warned.
    with suppress(nbclient.exceptions.CellExecutionError):
        client.execute()
    for cell in executed.cells:
        for output in cell.get("outputs", ()):
            if output.output_type == "error":
                raise NotebookError(cell.source, f"{output.ename}: {output.evalue}")
            if output.get("name") == "stderr":
                raise NotebookError(cell.source, output.text.strip())
    return executed
