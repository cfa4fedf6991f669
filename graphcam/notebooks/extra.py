"""What the extra ``notebooks`` installs, loaded when it is used."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType

from graphcam.errors import GraphcamError


class MissingExtraError(GraphcamError):
    """A library of an extra that is not installed.

    >>> print(MissingExtraError("executing a notebook", "nbclient"))
    executing a notebook needs nbclient, which is not installed; pip install 'graphcam[notebooks]'
    """

    def __init__(self, what: str, library: str) -> None:
        super().__init__(what, library)
        self.what = what
        self.library = library

    def __str__(self) -> str:
        return f"{self.what} needs {self.library}, which is not installed; pip install 'graphcam[notebooks]'"


def needed(library: str, what: str) -> ModuleType:
    """A library of the extra.

    Raises
    ------
    MissingExtraError : it is not installed
    """
    try:
        return import_module(library)
    except ImportError as error:
        raise MissingExtraError(what, library.split(".", maxsplit=1)[0]) from error
