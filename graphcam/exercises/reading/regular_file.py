"""The bytes of a file that a stranger put there: a regular file of bounded size, or a reason why not."""

from __future__ import annotations

import errno
import os
import stat
from pathlib import Path

from graphcam.drafting.ink import Caption, say


class UnreadableError(Exception):
    """What is handed in cannot be read; ``why`` is the sentence for the record.

    >>> print(UnreadableError("{name} is empty", name="answers.toml").why)
    answers.toml is empty
    """

    def __init__(self, template: str, **values: object) -> None:
        super().__init__(template, values)
        self.why: Caption = say(template, **values)

    def __str__(self) -> str:
        return str(self.why)


CANNOT = "{name} cannot be read ({why})"
TOO_LONG = "{name} is longer than the {limit} bytes that are read"


def read_regular(path: str | os.PathLike[str], limit: int, folder: int | None = None) -> bytes:
    """The bytes of a regular file of at most ``limit`` bytes; ``folder`` is an open folder that ``path`` starts from.

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
    graphcam.exercises.reading.regular_file.UnreadableError: b is a link; hand in the file itself
    """
    name = Path(path).name
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY,
                             dir_fd=folder)  # fmt: skip
    except OSError as error:
        if error.errno == errno.ELOOP:
            raise UnreadableError("{name} is a link; hand in the file itself", name=name) from None
        raise UnreadableError(CANNOT, name=name, why=error.strerror) from None
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise UnreadableError(_not_a_file(status.st_mode), name=name)
        if status.st_size > limit:
            raise UnreadableError(TOO_LONG, name=name, limit=limit)
        # One byte more tells a file that grew meanwhile.
        data = _read(descriptor, limit + 1)
    except OSError as error:
        raise UnreadableError(CANNOT, name=name, why=error.strerror) from None
    finally:
        os.close(descriptor)
    if len(data) > limit:
        raise UnreadableError(TOO_LONG, name=name, limit=limit)
    return data


def _read(descriptor: int, limit: int) -> bytes:
    parts: list[bytes] = []
    while limit > 0 and (part := os.read(descriptor, min(limit, 1 << 20))):
        parts.append(part)
        limit -= len(part)
    return b"".join(parts)


def _not_a_file(mode: int) -> str:
    templates = {
        stat.S_IFDIR: "{name} is a folder, not a file",
        stat.S_IFIFO: "{name} is a pipe, not a file",
        stat.S_IFSOCK: "{name} is a socket, not a file",
    }
    return templates.get(stat.S_IFMT(mode), "{name} is a device, not a file")
