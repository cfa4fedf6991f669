"""Files of strangers, opened so that nothing is waited for: a pipe, for instance, may never end."""

from __future__ import annotations

import os

BINARY_FLAGS, INHERITANCE_FLAGS, NONBLOCKING_FLAGS = (
    ("O_BINARY",),
    ("O_CLOEXEC", "O_NOINHERIT"),
    ("O_NONBLOCK", "O_NOCTTY"),
)
"""What Windows or Unix calls it: bytes as they are; for this process alone; without waiting, and as no terminal."""
READ_FLAGS = os.O_RDONLY | sum(getattr(os, name, 0) for name in (*BINARY_FLAGS, *INHERITANCE_FLAGS, *NONBLOCKING_FLAGS))
"""Flags for :func:`os.open`, each where the system knows it."""
