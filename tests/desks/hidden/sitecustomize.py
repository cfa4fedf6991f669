"""Python begins by this file where it is on the path: what only Unix has is hidden then, as on Windows.

What Python itself is made of here stays Unix: the modules of the standard library that choose by the system are loaded
first, and the few names that they look up when they are called are not hidden.
"""

import asyncio  # noqa: F401
import multiprocessing.context
import multiprocessing.popen_spawn_posix
import multiprocessing.process
import multiprocessing.resource_tracker
import os
import shutil
import signal
import socket  # noqa: F401
import subprocess  # noqa: F401
import sys
import tempfile  # noqa: F401

MODULES = (
    "fcntl", "resource", "pwd", "grp", "termios", "tty", "pty", "syslog", "readline", "curses", "_curses",
    "crypt", "spwd", "nis", "ossaudiodev",
)  # fmt: skip
OF_OS = (
    "fork", "forkpty", "setsid", "setpgid", "getpgid", "getgid", "getegid", "setuid", "setgid",
    "setgroups", "killpg", "nice", "chown", "lchown", "fchown", "chroot", "mkfifo", "mknod", "statvfs",
    "pread", "pwrite", "openpty", "sched_getaffinity", "getloadavg", "sysconf", "waitid", "memfd_create",
    "posix_spawn", "O_NOFOLLOW", "O_NONBLOCK", "O_NOCTTY", "O_DIRECTORY", "O_PATH", "O_SYNC",
)  # fmt: skip
OF_SIGNAL = (
    "SIGKILL", "SIGHUP", "SIGALRM", "SIGPROF", "SIGUSR1", "SIGUSR2", "SIGCHLD", "SIGPIPE", "SIGSTOP", "SIGCONT",
    "setitimer", "getitimer", "alarm", "pause", "sigwait", "ITIMER_PROF", "ITIMER_REAL", "ITIMER_VIRTUAL",
)  # fmt: skip

for name in MODULES:
    sys.modules[name] = None
for module, names in ((os, OF_OS), (signal, OF_SIGNAL)):
    for name in names:
        if hasattr(module, name):
            delattr(module, name)
os.supports_dir_fd, os.supports_fd, os.supports_follow_symlinks = set(), set(), set()
shutil._use_fd_functions = False
shutil._rmtree_impl = shutil._rmtree_unsafe  # Python 3.14 has chosen by now
opened, listed = os.open, os.listdir


def of_nobody():
    """Libraries that know the system by its name ask for the user; graphcam must not."""
    if sys._getframe(1).f_globals["__name__"].startswith("graphcam"):
        raise AttributeError("module 'os' has no attribute 'getuid'")
    return user


user = os.getuid()
os.getuid = os.geteuid = of_nobody


def open_(path, flags, mode=0o777, *, dir_fd=None):
    if dir_fd is not None:
        raise NotImplementedError("dir_fd unavailable on this platform")
    if not flags & getattr(os, "O_CREAT", 0) and os.path.isdir(path):  # noqa: PTH112
        raise PermissionError(13, "Permission denied", path)
    return opened(path, flags, mode)


def listdir(path="."):
    if isinstance(path, int):
        raise TypeError("listdir: path should be string, bytes, os.PathLike or None, not int")
    return listed(path)


os.listdir = listdir
spawning = {"spawn": multiprocessing.context._concrete_contexts["spawn"]}
multiprocessing.context._concrete_contexts = spawning
multiprocessing.context._default_context._default_context = spawning["spawn"]
multiprocessing.get_all_start_methods = multiprocessing.context._default_context.get_all_start_methods = lambda: [
    "spawn"
]
os.open = open_
