"""Foreign programs that read what graphcam writes."""

from __future__ import annotations

import os
import shutil

import pytest


def program(name: str) -> str:
    """Where a program is; without it the test fails in CI, which installs it, and is skipped elsewhere."""
    if found := shutil.which(name):
        return found
    why = f"the program {name} is not installed"
    if os.environ.get("CI"):
        pytest.fail(why)
    pytest.skip(why)
