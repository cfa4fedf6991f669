"""The memory that a process and all its descendants take together."""

import os
from contextlib import suppress
from pathlib import Path

KIBIBYTE = 1 << 10
COUNTED = ("Pss:", "SwapPss:")
"""Shares of pages that several processes have in common: the sum over the processes counts every page once."""
COUNTED_OTHERWISE = ("RssAnon:", "RssShmem:", "VmSwap:")
"""Fields of pages that are no file's, where the shares cannot be read; one in common counts in every process."""

IN_MEMORY = ("/tmp", "/dev/shm")
"""Folders where the sandbox has file systems of its own, whose bytes are bounded, not their number."""
FILE = 1 << 10
"""Bytes that the kernel takes for a file or folder with nothing in it, measured."""


def tree_memory(leader: int) -> int:
    """Bytes that a process and its descendants take, now, with what their files in memory cost the kernel.

    >>> import os, sys
    >>> tree_memory(os.getpid()) > 1_000_000 or sys.platform != "linux"
    True
    """
    tree = _tree(leader)
    return sum(_memory(number) for number in tree) + FILE * _files(tree)


def _tree(leader: int) -> list[int]:
    """The numbers of a process and its descendants."""
    found = [leader]
    for number in found:
        with suppress(OSError):
            for task in Path(f"/proc/{number}/task").iterdir():
                found += map(int, (task / "children").read_text(encoding="utf-8").split())
    return found


def _files(tree: list[int]) -> int:
    """How many files there are in the file systems that these processes have and this one has not."""
    ours = {os.stat(place).st_dev for place in IN_MEMORY if os.path.isdir(place)}  # noqa: PTH112, PTH116
    found: dict[int, int] = {}
    for place in (f"/proc/{number}/root{place}" for number in tree for place in IN_MEMORY):
        with suppress(OSError):
            device, held = os.stat(place).st_dev, os.statvfs(place)  # noqa: PTH116
            found[device] = held.f_files - held.f_ffree
    return sum(count for device, count in found.items() if device not in ours)


def _memory(number: int) -> int:
    for file, names in (("smaps_rollup", COUNTED), ("status", COUNTED_OTHERWISE)):
        with suppress(OSError):
            lines = Path(f"/proc/{number}/{file}").read_text(encoding="utf-8").splitlines()
            return KIBIBYTE * sum(int(line.split()[1]) for line in lines if line.startswith(names))
    return 0
