"""What holds for every test: only what may run is read, memory is given back, a process that dies ends the run."""

from __future__ import annotations

import ctypes
import gc
import os
import re
import sys
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path
from typing import ClassVar

import pytest

from graphcam.errors import GraphcamError

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
    config.pluginmanager.register(Read())
    # A variable, for a worker reads its options before it knows this file.
    if folder := os.environ.get("GRAPHCAM_MESSAGES"):
        Path(folder).mkdir(parents=True, exist_ok=True)
        config.pluginmanager.register(Messages(Path(folder, f"{os.getpid()}.txt")))


class Read:
    """Leaves files unread in which nothing may run: reading all of them takes longer than many of their tests."""

    SLOW = "\npytestmark = pytest.mark.slow\n"
    OF_EXTRAS: ClassVar = {
        **dict.fromkeys(("graphcam/studio/widget.py", "graphcam/studio/__init__.py"), "anywidget"),
        **dict.fromkeys(("graphcam/notebooks/construction_stages.py", "graphcam/notebooks/shown_tables.py"), "IPython"),
        **dict.fromkeys(("graphcam/bench/sweep_curve.py", "graphcam/sweeps/shared_folder.py"), "pyarrow"),
    }
    """Modules whose examples need an extra, and what they import; .ci/run tries them by name."""

    def pytest_ignore_collect(self, collection_path: Path, config: pytest.Config) -> bool | None:
        """Whether a file has neither tests nor doctests, or slow ones alone where slow ones do not run."""
        if collection_path.suffix != ".py" or not collection_path.is_file():
            return None
        text = collection_path.read_text(encoding="utf-8")
        if collection_path.name.startswith("test_"):
            return (config.option.markexpr == "not slow" and self.SLOW in text) or None
        needed = self.OF_EXTRAS.get("/".join(collection_path.parts[-3:]))
        return (needed is not None and find_spec(needed) is None) or ">>>" not in text or None


class Messages:
    """Collects every message of a graphcam error, a line each: before and after a change they are the same set.

    Folders and addresses in memory, which change from run to run, are left out.
    """

    CHANGING = re.compile(r"/tmp/[^ ;:,'\"]*/(?=[^/])|0x[0-9a-f]{6,}")

    def __init__(self, file: Path) -> None:
        self.file = file
        self.made: list[GraphcamError] = []

        def remembered(kind: type[GraphcamError], /, *args: object, **_: object) -> GraphcamError:
            error = Exception.__new__(kind, *args)
            self.made.append(error)
            return error

        GraphcamError.__new__ = staticmethod(remembered)

    @pytest.hookimpl(trylast=True)
    def pytest_runtest_teardown(self) -> None:
        """Write down what the test has made; one that was not made whole has no message."""
        with self.file.open("a", encoding="utf-8") as file:
            for error in self.made:
                with suppress(AttributeError, IndexError, KeyError, TypeError):
                    said = self.CHANGING.sub("", str(error)).replace("\n", "\\n")
                    file.write(f"{type(error).__name__}\t{said}\n")
        self.made.clear()


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
