"""Flags for opening files of unknown origin without waiting: a pipe, for instance, may never end."""

import os

BINARY_FLAGS, INHERITANCE_FLAGS, NONBLOCKING_FLAGS = (
    ("O_BINARY",),
    ("O_CLOEXEC", "O_NOINHERIT"),
    ("O_NONBLOCK", "O_NOCTTY"),
)
"""Names of flags on Windows or Unix: bytes unchanged; not inherited by other processes; no waiting, no terminal."""
READ_FLAGS = os.O_RDONLY | sum(getattr(os, name, 0) for name in (*BINARY_FLAGS, *INHERITANCE_FLAGS, *NONBLOCKING_FLAGS))
"""Flags for :func:`os.open`, as far as the system has them."""
