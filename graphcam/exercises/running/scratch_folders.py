"""A folder for code that is not trusted, removed without following what the code has put in its place.

Everything is reached from an open descriptor of the folder: its name may be another's by the time it is removed.
"""

import os
import shutil
import stat
import tempfile
from collections.abc import Generator
from contextlib import contextmanager, suppress
from itertools import count
from pathlib import Path

FOLDER_FLAGS = os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW


@contextmanager
def scratch_folder(owner: int | None = None) -> Generator[str]:
    """A new folder that is gone afterwards, whatever was put into it and wherever it was moved.

    owner : user to whom it is given; left out, it stays the caller's

    >>> with scratch_folder() as folder:
    ...     os.symlink("/", os.path.join(folder, "all"))
    >>> os.path.lexists(folder)
    False
    """
    folder = tempfile.mkdtemp(prefix="graphcam-run-")
    top = os.open(folder, FOLDER_FLAGS)
    try:
        if owner is not None:
            os.fchown(top, owner, owner)
        yield folder
    finally:
        try:
            _empty_folder(top)
            _remove(top, folder)
        finally:
            os.close(top)


def _empty_folder(top: int) -> None:
    """Remove all that is in a folder; nested ones are first moved up, so that depth needs no stack and no long path."""
    os.fchmod(top, stat.S_IRWXU)
    fresh = (f".{number}" for number in count())
    removed = True
    # Where nothing more goes, this user cannot remove what is left.
    while removed and (folders := _unlink_files(top)):
        removed = False
        for name in folders:
            with suppress(OSError):
                _flatten(top, name, fresh)
                os.rmdir(name, dir_fd=top)
                removed = True


def _flatten(top: int, name: str, fresh: Generator[str]) -> None:
    """Move the folders within a folder to the top, and remove its files."""
    folder = _open_folder(top, name)
    try:
        for inner in _unlink_files(folder):
            # A folder moves only if its owner may write in it.
            os.close(_open_folder(folder, inner))
            place = next(one for one in fresh if not _exists(top, one))
            os.rename(inner, place, src_dir_fd=folder, dst_dir_fd=top)
    finally:
        os.close(folder)


def _exists(folder: int, name: str) -> bool:
    try:
        os.lstat(name, dir_fd=folder)
    except FileNotFoundError:
        return False
    return True


def _open_folder(parent: int, name: str) -> int:
    """A descriptor of a folder, which gets all permissions of its owner."""
    # What has no permission can still be named by such a descriptor, and no link is followed.
    place = os.open(name, os.O_PATH | os.O_DIRECTORY | os.O_NOFOLLOW, dir_fd=parent)
    try:
        Path(f"/proc/self/fd/{place}").chmod(stat.S_IRWXU)
    finally:
        os.close(place)
    return os.open(name, FOLDER_FLAGS, dir_fd=parent)


def _unlink_files(folder: int) -> list[str]:
    """Remove what is no folder; the names of the folders."""
    with os.scandir(folder) as entries:
        found = [(entry.name, entry.is_dir(follow_symlinks=False)) for entry in entries]
    for name, is_folder in found:
        if not is_folder:
            with suppress(OSError):
                os.unlink(name, dir_fd=folder)
    return [name for name, is_folder in found if is_folder]


def _remove(top: int, folder: str) -> None:
    """Remove the empty folder where it is now, and a link that stands in its place."""
    with suppress(OSError):
        now = Path(f"/proc/self/fd/{top}").readlink()
        if os.path.samestat(now.lstat(), os.fstat(top)):
            now.rmdir()
    with suppress(OSError):
        Path(folder).unlink()
    # Code that renamed its folder may have made another in its place.
    shutil.rmtree(folder, ignore_errors=True)
