"""The command lines that start the launcher at each level, and what it finds there."""

import functools
import importlib.util
import json
import os
import shutil
import signal
import sys
import threading
from contextlib import suppress
from pathlib import Path

from graphcam.exercises.running import launcher
from graphcam.exercises.running.isolation_levels import MEBIBYTE, Level, ResourceLimits
from graphcam.exercises.running.limited_process import RunEnd, run_limited
from graphcam.exercises.running.scratch_folders import scratch_folder
from graphcam.exercises.running.system_calls import new_keyring, refusals

SYSTEM_FOLDERS = ("/usr", "/bin", "/sbin", "/lib", "/lib64", "/lib32")
SETTINGS_PATHS = ("/etc/ld.so.cache", "/etc/alternatives", "/etc/fonts")
"""What the loader of shared libraries and matplotlib want; nothing of the host's own."""
FIRST_USER, USER_COUNT = 20_000, 40_000
"""Numbers that no account has, one for each run at a time, so that one cannot use up another's processes."""
SHARED_MEMORY_BYTES = 32 * MEBIBYTE
"""Bytes of /dev/shm in the sandbox."""
REMOVAL_ATTEMPTS = 20
"""How often what was left behind is looked for: it may go on forking meanwhile."""


def run_cells(level: Level, cells: list[str], names: list[str], limits: ResourceLimits | None = None) -> RunEnd:
    """Run a notebook's cells at a level.

    cells : their code
    names : variables that are handed out where nothing was displayed
    """
    if level is Level.L0:
        raise ValueError("at L0 nothing is run")
    limits = limits or ResourceLimits()
    resources = limits.resources(0 if os.getuid() == 0 else _processes_of(os.getuid()))
    numpy, graphcam = _packages()
    path = [str(numpy), str(graphcam.parent)]
    with scratch_folder(_user() or None) as folder:

        def order(pipe: int) -> bytes:
            ran = {"cells": cells, "names": names, "limits": resources, "user": _user(), "path": path, "pipe": pipe}
            kept_out = {"keyring": new_keyring(), "refused": refusals().hex()}
            return json.dumps(ran | kept_out).encode()

        try:
            return run_limited(_command(level, limits), order, limits, folder, _environment(level, folder))
        finally:
            if level is Level.L1:
                _end_left_behind(folder)


def _end_left_behind(folder: str) -> None:
    """Kill what a run at L1 has left in the background: it has a user of its own, or its folder in the environment."""
    for _ in range(REMOVAL_ATTEMPTS):
        theirs = [int(process.name) for process in Path("/proc").glob("[0-9]*") if _uses_folder(process, folder)]
        for number in theirs:
            with suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)
        if not theirs:
            return


def _uses_folder(process: Path, folder: str) -> bool:
    try:
        if os.getuid() == 0:
            return process.stat().st_uid == _user()
        return os.fsencode(folder) in (process / "environ").read_bytes()
    except OSError:
        return False


def visible_folders() -> list[Path]:
    """The folders of the host that code at L2 can read."""
    folders = [Path(sys.prefix), Path(sys.base_prefix), Path(sys.exec_prefix), *_packages()]
    return sorted({folder.resolve() for folder in folders if folder.is_dir()} | {Path(name) for name in SYSTEM_FOLDERS})


def _command(level: Level, limits: ResourceLimits) -> list[str]:
    # A virtual environment is found by the name of its own python.
    python = [sys.executable, "-I", "-B", "-X", "utf8"]
    if level is Level.L1:
        return [*_another_user(), *python, launcher.__file__]
    return [*_bubblewrap_command(limits), *python, "/launcher.py"]


def _another_user() -> list[str]:
    """The start of root's command line that runs as nobody else does, with none of root's rights."""
    if os.getuid() != 0:
        return []
    program, user = shutil.which("setpriv") or "setpriv", str(_user())
    others = ["--reuid", user, "--regid", user, "--clear-groups"]
    return [program, *others, "--inh-caps=-all", "--ambient-caps=-all", "--bounding-set=-all", "--no-new-privs"]


def _bubblewrap_command(limits: ResourceLimits) -> list[str]:
    program = shutil.which("bwrap") or "bwrap"
    unshared = [f"--unshare-{name}" for name in ("ipc", "pid", "net", "uts", "cgroup-try")]
    command = [program, *unshared, "--die-with-parent", "--new-session", "--hostname", "sandbox", "--cap-drop", "ALL"]
    # As root another user is taken inside; otherwise the kernel gives a name space in which nobody is anybody.
    # In neither can a further one be made: the launcher is refused the calls for it.
    command += ["--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"] if os.getuid() == 0 else ["--unshare-user"]
    for folder in SYSTEM_FOLDERS:
        if Path(folder).is_symlink():
            command += ["--symlink", str(Path(folder).readlink()), folder]
        elif Path(folder).is_dir():
            command += ["--ro-bind", folder, folder]
    for place in SETTINGS_PATHS:
        command += ["--ro-bind-try", place, place]
    # Before the folders of Python, which may lie in /tmp themselves.
    command += ["--perms", "1777", "--size", str(limits.written), "--tmpfs", "/tmp"]
    for folder in visible_folders():
        if not any(folder.is_relative_to(other) for other in SYSTEM_FOLDERS):
            for parent in reversed(folder.parents[:-1]):
                command += ["--perms", "0755", "--dir", str(parent)]
            command += ["--ro-bind", str(folder), str(folder)]
    command += ["--proc", "/proc", "--dev", "/dev", "--remount-ro", "/dev"]
    command += ["--perms", "1777", "--size", str(SHARED_MEMORY_BYTES), "--tmpfs", "/dev/shm"]
    command += ["--ro-bind", launcher.__file__, "/launcher.py"]
    return [*command, "--chdir", "/tmp", "--remount-ro", "/"]


def _environment(level: Level, folder: str) -> dict[str, str]:
    """Nothing of the host's environment: it may hold passwords."""
    home = folder if level is Level.L1 else "/tmp"
    places = {"PATH": "/usr/bin:/bin", "HOME": home, "TMPDIR": home, "LANG": "C.UTF-8"}
    # One thread each: more cost memory and processes, and gain nothing here.
    threads = {f"{library}_NUM_THREADS": "1" for library in ("OPENBLAS", "OMP", "MKL")}
    return {**places, "MPLBACKEND": "agg", "MPLCONFIGDIR": home, **threads}


@functools.cache
def _packages() -> tuple[Path, ...]:
    """graphcam itself, and the packages it needs."""
    found = [importlib.util.find_spec(name) for name in ("numpy", "graphcam")]
    places = [Path(spec.origin).parent for spec in found if spec is not None and spec.origin]
    # Packages that were installed stand beside numpy, in one folder; a checkout is only its own.
    return (places[0].parent, places[1])


def _user() -> int:
    return FIRST_USER + threading.get_native_id() % USER_COUNT if os.getuid() == 0 else 0


def _processes_of(user: int) -> int:
    """Processes and threads of a user: older kernels count those outside of a sandbox as well."""
    count = 0
    for task in Path("/proc").glob("[0-9]*"):
        try:
            if task.stat().st_uid == user:
                count += sum(1 for _ in (task / "task").iterdir())
        except OSError:
            continue
    return count
