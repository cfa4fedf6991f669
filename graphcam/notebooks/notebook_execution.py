"""Executing a notebook from a clean kernel, with what the extra ``notebooks`` installs, loaded when it is used."""

from contextlib import suppress
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import ModuleType

from nbformat import NotebookNode

from graphcam.errors import GraphcamError, install_advice
from graphcam.words import Caption, say

PYTHON_METADATA = {"kernelspec": {"name": "python3", "display_name": "Python 3"}, "language_info": {"name": "python"}}
"""Metadata of a notebook whose code is Python."""
CELL_SECONDS = 120
"""The time limit of a cell [s]."""
MAY_FAIL = "raises-exception"
"""The tag of a cell whose error stops nothing: it stands in its output."""


@dataclass(eq=False, repr=False)
class MissingExtraError(GraphcamError):
    """A library of an extra that is not installed.

    >>> print(MissingExtraError("executing a notebook", "nbclient"))  # doctest: +ELLIPSIS
    executing a notebook needs nbclient, which is not installed; in the folder of graphcam's source run: python -m ...
    """

    what: str
    library: str

    @property
    def fault(self) -> Caption:
        """The sentence that names the library, and what needs it."""
        return say("{what} needs {library}, which is not installed", what=self.what, library=self.library)

    def __post_init__(self) -> None:
        self.advice = install_advice("notebooks")


def required_library(library: str, what: str) -> ModuleType:
    """The module of a library of the extra ``notebooks``; ``what`` names its use for the message.

    Raises
    ------
    MissingExtraError : the library is not installed
    """
    try:
        return import_module(library)
    except ImportError as error:
        raise MissingExtraError(what, library.split(".", maxsplit=1)[0]) from error


@dataclass(eq=False, repr=False)
class NotebookError(GraphcamError):
    """A notebook with a cell that fails, or warns: the cell's source and its message.

    >>> print(NotebookError("1 / 0", "ZeroDivisionError: division by zero"))
    ZeroDivisionError: division by zero
    in the cell
    1 / 0
    """

    cell: str
    said: str

    @property
    def fault(self) -> Caption:
        """The message, and the source of the cell."""
        return say("{said}\nin the cell\n{cell}", said=self.said, cell=self.cell)


def execute(notebook: NotebookNode, folder: Path | str = ".") -> NotebookNode:
    """The notebook with its outputs, executed in the folder by a new kernel.

    Raises
    ------
    MissingExtraError : the libraries of the extra ``notebooks`` are not installed
    NotebookError : a cell fails, or warns (writes to standard error)
    """
    nbclient = required_library("nbclient", "executing a notebook")
    required_library("ipykernel", "executing a notebook")
    executed = NotebookNode(notebook)
    client = nbclient.NotebookClient(executed, timeout=CELL_SECONDS, kernel_name="python3")
    client.resources = {"metadata": {"path": str(folder)}}
    client.extra_arguments = ["--log-level=ERROR"]
    # What the sliders show is on the page as well.
    client.store_widget_state = False
    # What failed stands in the outputs, beside what only warned.
    with suppress(nbclient.exceptions.CellExecutionError):
        client.execute()
    for cell in executed.cells:
        may_fail = MAY_FAIL in cell.metadata.get("tags", ())
        for output in cell.get("outputs", ()):
            if output.output_type == "error" and not may_fail:
                raise NotebookError(cell.source, f"{output.ename}: {output.evalue}")
            if output.get("name") == "stderr":
                raise NotebookError(cell.source, output.text.strip())
    return executed
