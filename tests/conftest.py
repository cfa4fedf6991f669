"""What holds for every test: memory is given back, and a process that dies ends the run."""

from __future__ import annotations

import ctypes
import gc
import sys
from pathlib import Path

import pytest

PAGE = 4096
MUCH = 200 << 20
"""Bytes that may gather before they are given back."""


def pytest_configure(config: pytest.Config) -> None:
    """Let a worker that is killed, mostly for want of memory, fail the run at once.

    A new worker in its place would wait for ever for the tests of the file that the dead one held (pytest-xdist 3.8,
    ``--dist loadfile``).
    """
    if config.pluginmanager.hasplugin("xdist") and config.option.maxworkerrestart is None:
        config.option.maxworkerrestart = "0"


kept = sys.maxsize
"""The least that this process held since it last gave memory back [bytes]."""


@pytest.hookimpl(wrapper=True)
def pytest_runtest_protocol():
    """Return to the system what the tests have freed: the C library keeps hundreds of MB of it in pieces."""
    global kept
    if sys.platform != "linux":
        return (yield)
    kept = min(kept, held())
    done = yield
    if held() > kept + MUCH:
        gc.collect()
        ctypes.CDLL(None).malloc_trim(0)
        kept = held()
    return done


def held() -> int:
    """The memory of this process [bytes]."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * PAGE
