"""Locks that the system releases when the process that holds them ends, however it ends: on Unix, or on Windows."""

import importlib
import os
from collections.abc import Generator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

LOCK_SUFFIX = "lock"
"""The ending of files that exist only to be locked."""


def lock(descriptor: int) -> bool:
    """Lock an open file until it is closed; False where the system or the file system knows no locks.

    Raises
    ------
    BlockingIOError : another process holds it
    """
    try:
        import fcntl
    except ImportError:
        return _lock_of_windows(descriptor)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise
    except OSError:
        return False
    return True


def _lock_of_windows(descriptor: int) -> bool:
    try:
        # By its name: a type check for another system knows nothing of what is in it.
        msvcrt: Any = importlib.import_module("msvcrt")
    except ImportError:
        return False
    try:
        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
    except PermissionError as error:
        raise BlockingIOError(error.errno, error.strerror) from None
    except OSError:
        return False
    return True


@contextmanager
def locked_folder(folder: Path) -> Generator[None]:
    """Hold a lock on a folder, or on a file beside it where only files can be locked; that file is removed at the end.

    Raises
    ------
    BlockingIOError : another process holds it
    OSError : the folder does not exist or cannot be opened

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as place, locked_folder(Path(place)):
    ...     with locked_folder(Path(place)):
    ...         pass
    Traceback (most recent call last):
    BlockingIOError: [Errno 11] Resource temporarily unavailable
    """
    unix = hasattr(os, "O_DIRECTORY")
    place = folder if unix else folder.with_name(f"{folder.name}.{LOCK_SUFFIX}")
    descriptor = os.open(place, os.O_RDONLY if unix else os.O_RDWR | os.O_CREAT)
    try:
        lock(descriptor)
        yield
    finally:
        os.close(descriptor)
        if not unix:
            # It stays where another process has opened it meanwhile.
            with suppress(OSError):
                place.unlink()
