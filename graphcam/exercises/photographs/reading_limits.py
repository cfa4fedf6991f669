"""What the process that reads a stranger's picture may use up: past its limits it ends, and its file is told.

A file of a few hundred bytes can ask the library that unpacks it for all the memory there is, or never come to an end;
no check of the file itself foresees that.
"""

from __future__ import annotations

import faulthandler
import os
from collections.abc import Callable, Generator
from contextlib import contextmanager
from pathlib import Path

OPENED_WITHIN = 20.0
"""Seconds in which one picture is unpacked; it takes one or two."""
READ_WITHIN = 120.0
"""Seconds in which one picture is read; it takes a few, and several are read at once on a slow machine."""
MEMORY_GIGABYTES = 2
"""That a reading may take beside what its process has already; the largest picture takes less than half of it."""
MEMORY_FILE = Path("/proc/self/statm")
"""Where Linux tells first how many pages of addresses a process has."""

Allow = Callable[[float], None]
"""Gives the process so many seconds from now on."""


@contextmanager
def limited(gigabytes: float = MEMORY_GIGABYTES) -> Generator[Allow]:
    """Within it this process ends where it is past its time, wherever it is, and gets no more memory than its limit.

    Where there are no limits of memory, as on Windows, that of time holds alone.
    """
    with _limited_memory(gigabytes), Path(os.devnull).open("w", encoding="utf-8", newline="\n") as nowhere:
        try:
            # The clock is C's: it needs nothing of Python, which may wait for a library that never comes back.
            yield lambda seconds: faulthandler.dump_traceback_later(seconds, exit=True, file=nowhere)
        finally:
            faulthandler.cancel_dump_traceback_later()


@contextmanager
def _limited_memory(gigabytes: float) -> Generator[None]:
    try:
        import resource

        taken = int(MEMORY_FILE.read_text(encoding="ascii").split()[0]) * resource.getpagesize()
    except (ImportError, OSError):
        yield
        return
    before = resource.getrlimit(resource.RLIMIT_AS)
    most = taken + int(gigabytes * 1e9)
    # A limit that is tighter already stays.
    bounds = [most, *(bound for bound in before if bound != resource.RLIM_INFINITY)]
    resource.setrlimit(resource.RLIMIT_AS, (min(bounds), before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)
