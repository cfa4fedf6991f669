"""A process that is ended in time, whatever it does, and whose output fills no memory."""

import os
import selectors
import signal
import subprocess
import time
from collections.abc import Callable
from contextlib import ExitStack, suppress
from dataclasses import dataclass, field
from io import FileIO
from pathlib import Path

from graphcam.exercises.running.isolation_levels import ResourceLimits

KIBIBYTE = 1 << 10
SHARED_PAGE_FIELDS = ("Pss:", "SwapPss:")
"""Shares of pages that several processes have in common: the sum over the processes counts every page once."""
PRIVATE_PAGE_FIELDS = ("RssAnon:", "RssShmem:", "VmSwap:")
"""Fields of pages that are no file's, where the shares cannot be read; one in common counts in every process."""

MEMORY_FOLDERS = ("/tmp", "/dev/shm")
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
    ours = {os.stat(place).st_dev for place in MEMORY_FOLDERS if os.path.isdir(place)}  # noqa: PTH112, PTH116
    found: dict[int, int] = {}
    for place in (f"/proc/{number}/root{place}" for number in tree for place in MEMORY_FOLDERS):
        with suppress(OSError):
            device, held = os.stat(place).st_dev, os.statvfs(place)  # noqa: PTH116
            found[device] = held.f_files - held.f_ffree
    return sum(count for device, count in found.items() if device not in ours)


def _memory(number: int) -> int:
    for file, names in (("smaps_rollup", SHARED_PAGE_FIELDS), ("status", PRIVATE_PAGE_FIELDS)):
        with suppress(OSError):
            lines = Path(f"/proc/{number}/{file}").read_text(encoding="utf-8").splitlines()
            return KIBIBYTE * sum(int(line.split()[1]) for line in lines if line.startswith(names))
    return 0


CHUNK_BYTES = 1 << 16
CHECK_INTERVAL = 0.02
"""Seconds between two looks at a process that says nothing, and at its memory."""
PIPE_CLOSE_SECONDS = 0.3
"""Seconds in which a killed group lets go of its pipes."""


@dataclass(frozen=True)
class RunEnd:
    """The end of a run: its answers, its text and its exit status.

    handed_out : what came through the pipe for the answers, cut at its limit
    text : the last of what was written to standard output and error
    status : exit status; negative for a signal
    late : whether it was killed when its time was over
    large : whether it was killed since its processes together took more memory than the limit
    """

    handed_out: bytes
    text: str
    status: int
    late: bool
    large: bool = False


@dataclass
class _ByteSink:
    """Keeps the first or the last bytes of what comes."""

    most: int
    last: bool
    held: bytearray = field(default_factory=bytearray)

    def take(self, data: bytes) -> None:
        """Keep data, of too much the first or the last part."""
        self.held += data
        if len(self.held) > self.most:
            self.held = self.held[-self.most :] if self.last else self.held[: self.most]


def run_limited(
    command: list[str], order: Callable[[int], bytes], limits: ResourceLimits, folder: str, environment: dict[str, str]
) -> RunEnd:
    """Run a command in a process group of its own, and kill the group when its time is over or its work is done.

    order : what the command reads on standard input; it hears the number of the pipe for its answers

    Raises
    ------
    OSError : the command cannot be started
    """
    with ExitStack() as stack:
        (in_read, in_write), (out_read, out_write), (pipe_read, pipe_write) = (os.pipe() for _ in range(3))
        source = stack.enter_context(FileIO(in_write, "w"))
        for mine in (out_read, pipe_read):
            stack.callback(os.close, mine)
        os.set_blocking(in_write, False)
        try:
            process = subprocess.Popen(
                command,
                stdin=in_read,
                stdout=out_write,
                stderr=out_write,
                pass_fds=(pipe_write,),
                start_new_session=True,
                cwd=folder,
                env=environment,
            )
        finally:
            for theirs in (in_read, out_write, pipe_write):
                os.close(theirs)
        stack.callback(_end, process)
        answers, text = _ByteSink(limits.handed_out, last=False), _ByteSink(limits.kept, last=True)
        sinks = {pipe_read: answers, out_read: text}
        late, large = _attend(process, (source, order(pipe_write)), sinks, limits)
        return RunEnd(bytes(answers.held), text.held.decode(errors="replace"), process.returncode, late, large)


def _attend(
    process: subprocess.Popen[bytes], feed: tuple[FileIO, bytes], sinks: dict[int, _ByteSink], limits: ResourceLimits
) -> tuple[bool, bool]:
    """Feed and drain until the process has ended or a limit is passed; whether it was late, or too large."""
    deadline, looked, large = time.monotonic() + limits.seconds, 0.0, False
    source, order = feed
    with selectors.DefaultSelector() as selector:
        selector.register(source, selectors.EVENT_WRITE)
        for number in sinks:
            selector.register(number, selectors.EVENT_READ)
        while not large and not _has_ended(process) and time.monotonic() < deadline:
            for key, _ in selector.select(min(CHECK_INTERVAL, max(0.0, deadline - time.monotonic()))):
                if key.fileobj is source:
                    order = _feed_pipe(selector, source, order)
                else:
                    _drain_pipe(selector, key.fd, sinks[key.fd])
            if time.monotonic() - looked > CHECK_INTERVAL:
                large = tree_memory(process.pid) > limits.memory
                looked = time.monotonic()
        late = not large and not _has_ended(process)
        _end(process)
        # What is still in the pipes; they end when the last of the group has gone.
        if not source.closed:
            selector.unregister(source)
        until = time.monotonic() + PIPE_CLOSE_SECONDS
        while selector.get_map() and time.monotonic() < until:
            for key, _ in selector.select(max(0.0, until - time.monotonic())):
                _drain_pipe(selector, key.fd, sinks[key.fd])
    return late, large


def _feed_pipe(selector: selectors.BaseSelector, source: FileIO, order: bytes) -> bytes:
    try:
        order = order[source.write(order[:CHUNK_BYTES]) or 0 :]
    except BrokenPipeError:
        order = b""
    if not order:
        selector.unregister(source)
        source.close()
    return order


def _drain_pipe(selector: selectors.BaseSelector, number: int, sink: _ByteSink) -> None:
    data = os.read(number, CHUNK_BYTES)
    sink.take(data)
    if not data:
        selector.unregister(number)


def _end(process: subprocess.Popen[bytes]) -> None:
    """Kill the whole group, and wait for its leader."""
    if process.returncode is not None:
        return
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def _has_ended(process: subprocess.Popen[bytes]) -> bool:
    """Whether the leader has ended.  It is not reaped yet: its number stays the group's, and nobody else's."""
    if process.returncode is not None:
        return True
    return os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None
