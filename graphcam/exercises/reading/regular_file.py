"""The bytes of a file that a stranger put there: a regular file of bounded size, or a reason why not."""

import errno
import os
import stat
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from graphcam.errors import UnreadableError
from graphcam.file_descriptors import READ_FLAGS
from graphcam.words import Caption, say


def _closed_error(name: str) -> UnreadableError:
    return UnreadableError(say("{name} cannot be opened", name=name))


def _too_long_error(name: str, limit: int) -> UnreadableError:
    return UnreadableError(say("{name} is longer than the {limit} bytes that are read", name=name, limit=limit))


OPENS_BY_DESCRIPTOR = hasattr(os, "O_DIRECTORY") and os.open in os.supports_dir_fd
"""Whether the system opens a file by the open folder in which it is; Windows does not."""


@contextmanager
def open_folder(folder: str | os.PathLike[str]) -> Generator[int | Path]:
    """A folder that is no link, for :func:`os.listdir` and :func:`read_regular`.

    By its descriptor, so that it is the folder that was opened; where the system has none, by its path.

    Raises
    ------
    OSError : it is not there, no folder, or a link
    """
    if not OPENS_BY_DESCRIPTOR:
        if not stat.S_ISDIR(os.lstat(folder).st_mode):
            raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), os.fspath(folder))
        yield Path(folder)
        return
    descriptor = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC)
    try:
        yield descriptor
    finally:
        os.close(descriptor)


def _open(path: str | os.PathLike[str], folder: int | Path | None) -> int:
    """A descriptor of what is there and is no link.

    Raises
    ------
    OSError : it cannot be opened; ELOOP of a link
    """
    if isinstance(folder, Path):
        path, folder = folder / path, None
    if hasattr(os, "O_NOFOLLOW"):
        return os.open(path, READ_FLAGS | os.O_NOFOLLOW, dir_fd=folder)
    before = os.lstat(path)
    if stat.S_ISLNK(before.st_mode):
        raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))
    descriptor = os.open(path, READ_FLAGS)
    if os.path.samestat(before, os.fstat(descriptor)):
        return descriptor
    # A link took its place meanwhile.
    os.close(descriptor)
    raise OSError(errno.ELOOP, os.strerror(errno.ELOOP))


def read_regular(path: str | os.PathLike[str], limit: int, folder: int | Path | None = None) -> bytes:
    """The bytes of a regular file of at most ``limit`` bytes.

    folder : that ``path`` starts from, of :func:`open_folder`

    Nothing is followed and nothing is waited for: a link may point at the key, a FIFO never ends.

    Raises
    ------
    UnreadableError : a link, a folder, a FIFO, a device, a socket, too large, or not permitted

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as place:
    ...     _ = Path(place, "a").write_text("abc")
    ...     os.symlink("a", Path(place, "b"))
    ...     read_regular(Path(place, "a"), 3)
    ...     read_regular(Path(place, "b"), 3)
    Traceback (most recent call last):
    ...
    graphcam.errors.UnreadableError: b is a link; hand in the file itself
    """
    name = Path(path).name
    try:
        descriptor = _open(path, folder)
    except OSError as error:
        if error.errno == errno.ELOOP:
            raise UnreadableError(say("{name} is a link; hand in the file itself", name=name)) from None
        raise _closed_error(name) from None
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise UnreadableError(_irregular_file_remark(name, status.st_mode))
        if status.st_size > limit:
            raise _too_long_error(name, limit)
        # One byte more tells a file that grew meanwhile.
        data = _read_bytes(descriptor, limit + 1)
    except OSError:
        raise _closed_error(name) from None
    finally:
        os.close(descriptor)
    if len(data) > limit:
        raise _too_long_error(name, limit)
    return data


def _read_bytes(descriptor: int, limit: int) -> bytes:
    parts: list[bytes] = []
    while limit > 0 and (part := os.read(descriptor, min(limit, 1 << 20))):
        parts.append(part)
        limit -= len(part)
    return b"".join(parts)


def _irregular_file_remark(name: str, mode: int) -> Caption:
    found = {
        stat.S_IFDIR: say("{name} is a folder, not a file", name=name),
        stat.S_IFIFO: say("{name} is a pipe, not a file", name=name),
        stat.S_IFSOCK: say("{name} is a socket, not a file", name=name),
    }
    return found.get(stat.S_IFMT(mode), say("{name} is a device, not a file", name=name))
