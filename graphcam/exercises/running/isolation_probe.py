"""What this machine can hold students' code in, found out by trying."""

import functools
import json
import os
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import GraphcamError
from graphcam.exercises.running.isolation_levels import MEBIBYTE, Level, ResourceLimits
from graphcam.words import Caption, Words, and_chain, say

PROBE_LIMITS = ResourceLimits(seconds=20.0, memory=512 * MEBIBYTE, processes=8)
ESCAPE_ATTEMPTS = """
import os, socket, time
broken = []
def attempt(name, reach):
    try:
        reach()
    except (OSError, MemoryError):
        return
    broken.append(name)
def too_many():
    children = []
    try:
        for _ in range({processes}):
            child = os.fork()
            if child == 0:
                time.sleep(60)
                os._exit(0)
            children.append(child)
    finally:
        for child in children:
            os.kill(child, 9)
attempt("more processes than its limit", too_many)
attempt("more memory than its limit", lambda: bytearray({memory}))
if {closed}:
    attempt("the host's files", lambda: open({canary!r}).read())
    attempt("the network", lambda: socket.create_connection(("127.0.0.1", {port}), 1))
    attempt("the system", lambda: open("/usr/graphcam-was-here", "w"))
"""
"""What must fail inside; ``broken`` names what did not."""


@dataclass(eq=False, repr=False)
class LevelError(GraphcamError):
    """A level of isolation that this machine, or this command, does not give.

    >>> print(LevelError(Level.L2, "the program bwrap is not installed"))
    level L2 is not available: the program bwrap is not installed
    """

    level: Level
    why: Words

    @property
    def fault(self) -> Caption:
        """What is not available, and why."""
        return say("level {level} is not available: {why}", level=str(self.level), why=self.why)


@functools.cache
def reason_unavailable(level: Level) -> Words:
    """The reason why the level is not available here, in one sentence; empty where it is.

    A program that does what must be impossible is run once; that it fails is the evidence.
    """
    import shutil

    if level is Level.L0:
        return ""
    if sys.platform != "linux":
        return say("it needs Linux and the program bwrap (bubblewrap); level L0, which runs no code, grades everywhere")
    if level is Level.L2 and shutil.which("bwrap") is None:
        return say("the program bwrap (bubblewrap) is not installed")
    if level is Level.L1 and os.getuid() == 0 and not _is_readable_by_all(Path(sys.executable)):
        return say("its code runs as another user than root, who cannot read {executable}", executable=sys.executable)
    try:
        return _broken_limits(level)
    except OSError as error:
        return say("the launcher does not start ({strerror})", strerror=error.strerror)


def require(level: Level, private: tuple[Path, ...] = ()) -> None:
    """Refuse to go on below a level.

    private : files and folders that students' code must not see

    Raises
    ------
    LevelError : it is not available, or a private file lies where the code can read
    """
    if why := reason_unavailable(level):
        raise LevelError(level, why)
    if level is not Level.L2:
        return
    from graphcam.exercises.running.sandbox import visible_folders

    for path in private:
        for folder in visible_folders():
            if path.resolve().is_relative_to(folder):
                raise LevelError(
                    level, say("{path} lies in {folder}, which the code can read; move it", path=path, folder=folder)
                )


def _is_readable_by_all(program: Path) -> bool:
    """Whether every user can reach a program: through its folders, also where it is a link."""
    places = [program, program.resolve()]
    folders = {folder for place in places for folder in place.parents}
    return all(folder.stat().st_mode & 0o001 for folder in folders)


def _broken_limits(level: Level) -> Words:
    import socket

    # Made of what only Linux has: not to be loaded before it is known to be one.
    from graphcam.exercises.running.sandbox import run_cells

    # Not hidden by the sandbox's own /tmp.
    outside = Path.home() if os.access(Path.home(), os.W_OK) else Path.cwd()
    with tempfile.NamedTemporaryFile(dir=outside) as canary, socket.create_server(("127.0.0.1", 0)) as server:
        Path(canary.name).chmod(0o644)
        size = {"processes": PROBE_LIMITS.processes + (0 if os.getuid() == 0 else 4096), "memory": PROBE_LIMITS.memory}
        hidden = {"canary": canary.name, "port": server.getsockname()[1]}
        escapes = ESCAPE_ATTEMPTS.format(closed=level is Level.L2, **size, **hidden)
        ended = run_cells(level, [escapes], ["broken"], PROBE_LIMITS)
    try:
        broken = json.loads(ended.handed_out)["broken"]
    except (ValueError, KeyError):
        last = ended.text.strip().splitlines()[-1:] or [f"status {ended.status}"]
        return say("a program in it does not run ({last})", last=last[0])
    return say("code in it reaches {names}", names=and_chain(broken)) if broken else ""
