"""Hidden folders in which files are written before they go to their place.

A run holds a lock on its draft, which the system gives free when the run ends, however it ends: so the next run tells a
draft that a killed one has left from one that is still being written.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path

from graphcam.locks import LOCK, lock as hold

PREFIX = ".graphcam-draft-"
"""How the names of drafts begin."""


@contextmanager
def draft_folder(place: Path) -> Generator[Path]:
    """A new folder in a place that is there, gone at the end; what killed runs left in the place goes too.

    Raises
    ------
    OSError : no folder can be made there

    >>> with tempfile.TemporaryDirectory() as place:
    ...     with draft_folder(Path(place)) as draft:
    ...         _ = (draft / "a.txt").write_text("a")
    ...     list(Path(place).iterdir())
    []
    """
    clear_drafts(place)
    draft, lock = _new_draft(place)
    try:
        yield draft
    finally:
        # Some systems do not remove what is still open.
        os.close(lock)
        shutil.rmtree(draft, ignore_errors=True)


def _new_draft(place: Path) -> tuple[Path, int]:
    """A new draft and its lock, a file descriptor."""
    while True:
        draft = Path(tempfile.mkdtemp(prefix=PREFIX, dir=place))
        lock: int | None = None
        with suppress(FileNotFoundError, BlockingIOError):
            lock = os.open(draft / LOCK, os.O_RDWR | os.O_CREAT)
            hold(lock)
            if os.path.lexists(draft / LOCK):
                return draft, lock
        # Before it was held, another run took it for one that a killed run left, and cleared it.
        if lock is not None:
            os.close(lock)


def clear_drafts(place: Path) -> None:
    """Remove the drafts in a place whose runs are no more."""
    with suppress(OSError):
        for path in list(place.glob(f"{PREFIX}*")):
            if path.is_dir() and not path.is_symlink():
                _clear(path)


def _clear(draft: Path) -> None:
    with suppress(OSError):
        lock = os.open(draft / LOCK, os.O_RDWR | os.O_CREAT)
        try:
            ended = hold(lock)
            if ended:
                shutil.rmtree(draft, ignore_errors=True)
        finally:
            os.close(lock)
        if ended:
            # Windows removes nothing that is open; nor does it now, if a new run has opened it meanwhile.
            (draft / LOCK).unlink()
            draft.rmdir()
