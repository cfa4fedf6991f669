"""What holds for every test: each file gives its memory back, and a process that dies ends the run."""

from __future__ import annotations

import ctypes
import gc
import sys

import pytest


def pytest_configure(config: pytest.Config) -> None:
    """Let a worker that is killed, mostly for want of memory, fail the run at once.

    A new worker in its place would wait for ever for the tests of the file that the dead one held (pytest-xdist 3.8,
    ``--dist loadfile``).
    """
    if config.pluginmanager.hasplugin("xdist") and config.option.maxworkerrestart is None:
        config.option.maxworkerrestart = "0"


@pytest.fixture(autouse=True, scope="module")
def memory_given_back():
    """Return to the system what a file's tests have freed: the C library keeps hundreds of MB of it in pieces."""
    yield
    gc.collect()
    if sys.platform == "linux":
        ctypes.CDLL(None).malloc_trim(0)
