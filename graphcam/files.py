"""Output that is there whole or not at all."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from graphcam.errors import GraphcamError


class OutputError(GraphcamError):
    """A folder or file that cannot be written.

    >>> print(OutputError("/proc/out", "No such file or directory"))
    the output '/proc/out' cannot be written (No such file or directory); choose another place
    """

    def __init__(self, path: str | Path, why: str, remedy: str = "choose another place") -> None:
        super().__init__(path, why, remedy)
        self.path = path
        self.why = why
        self.remedy = remedy

    def __str__(self) -> str:
        return f"the output '{self.path}' cannot be written ({self.why}); {self.remedy}"


@contextmanager
def whole_folder(folder: str | Path) -> Generator[Path]:
    """A temporary folder whose files move into ``folder`` when all of them are written.

    On an error nothing is left behind: neither the files nor a folder that was made for them.  Files that ``folder``
    held before stay, but for those of the same names.

    Raises
    ------
    OutputError : the folder cannot be made or written, or is a file

    >>> with tempfile.TemporaryDirectory() as place:
    ...     with whole_folder(Path(place, "out")) as draft:
    ...         _ = (draft / "a.txt").write_text("a")
    ...     sorted(path.name for path in Path(place, "out").iterdir())
    ['a.txt']
    """
    folder = Path(folder)
    # In the folder itself, so that each file moves by a rename within one file system.
    with _draft(folder, folder) as draft:
        yield draft
        try:
            _move(draft, folder)
        except OSError as error:
            raise _output_error(folder, error) from error


@contextmanager
def whole_file(path: str | Path) -> Generator[Path]:
    """A temporary file beside ``path`` that takes its place when it is written.

    On an error nothing is left behind, and a file that was there before stays.

    Raises
    ------
    OutputError : the file cannot be written

    >>> with tempfile.TemporaryDirectory() as place:
    ...     with whole_file(Path(place, "a.txt")) as draft:
    ...         _ = draft.write_text("a")
    ...     sorted(path.name for path in Path(place).iterdir())
    ['a.txt']
    """
    path = Path(path)
    # In a folder of its own, because readers and writers of some formats look at the ending.
    with _draft(path, path.parent) as folder:
        draft = folder / path.name
        yield draft
        try:
            draft.replace(path)
        except OSError as error:
            raise _output_error(path, error) from error


@contextmanager
def _draft(target: Path, place: Path) -> Generator[Path]:
    """A temporary folder in a place that is made where it is not there yet; on an error nothing is left of both."""
    made = _missing(place)
    try:
        if target != place and target.is_dir():
            raise IsADirectoryError("it is a folder")
        place.mkdir(parents=True, exist_ok=True)
        draft = Path(tempfile.mkdtemp(prefix=".graphcam-", dir=place))
    except (OSError, ValueError) as error:
        _remove(made)
        raise _output_error(target, error) from error
    try:
        yield draft
    except BaseException:
        shutil.rmtree(draft, ignore_errors=True)
        _remove(made)
        raise
    draft.rmdir()


def check_new(path: str | Path) -> None:
    """See, before long work, that there is a place for a file which must not be there yet.

    Raises
    ------
    OutputError : the file is there already, or its folder is not
    """
    if os.path.lexists(path):
        raise OutputError(path, "it is there already", "name a new file, or remove that one first")
    if not Path(path).parent.is_dir():
        raise OutputError(path, "its folder is not there", "make the folder first")


def write_new(path: str | Path, text: str) -> None:
    """Write a text file that must not be there yet.

    Raises
    ------
    OutputError : the file is there already, or cannot be written
    """
    try:
        with Path(path).open("x", encoding="utf-8") as file:
            file.write(text)
    except FileExistsError as error:
        raise OutputError(path, "it is there already", "name a new file, or remove that one first") from error
    except (OSError, ValueError) as error:
        raise _output_error(path, error) from error


def _move(draft: Path, folder: Path) -> None:
    for path in sorted(draft.iterdir()):
        # A folder of the same name cannot be replaced by a file: say so before the first file has moved.
        if (folder / path.name).is_dir():
            raise IsADirectoryError(f"{path.name} is a folder there")
    for path in sorted(draft.iterdir()):
        path.replace(folder / path.name)


def _missing(folder: Path) -> list[Path]:
    """The folders on the way to ``folder`` that are not there yet, the innermost first."""
    missing: list[Path] = []
    for path in (folder, *folder.parents):
        try:
            if path.exists():
                break
        except (OSError, ValueError):
            break
        missing.append(path)
    return missing


def _remove(made: list[Path]) -> None:
    for path in made:
        try:
            path.rmdir()
        except (OSError, ValueError):
            return


def _output_error(path: str | Path, error: OSError | ValueError) -> OutputError:
    why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return OutputError(path, why)
