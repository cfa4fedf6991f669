"""Calls of the kernel that students' code is refused, as a program of the kernel's packet filter (seccomp)."""

import errno
import platform
import struct

LOAD_WORD, JUMP_IF_EQUAL, JUMP_IF_BITS, RETURN_VALUE = 0x20, 0x15, 0x45, 0x06
"""Operations: load a word, jump if equal, jump if any bit is set, return."""
NUMBER_OFFSET, ARCHITECTURE_OFFSET, FLAGS_OFFSET = 0, 4, 16
"""Bytes into the kernel's ``seccomp_data``; the last is the lower word of the first argument."""
ALLOW_ACTION, ERROR_ACTION, KILL_ACTION = 0x7FFF0000, 0x00050000, 0x80000000
NEW_USER_FLAG = 0x10000000
"""The flag CLONE_NEWUSER."""
FOREIGN_CALLS_START = 0x40000000
"""The number from which on calls are those of another way to call (x32)."""

REFUSED_CALLS = {
    # Memory that belongs to no process, or outlives it.
    "memfd_create": (319, 279), "memfd_secret": (447, 447), "shmget": (29, 194), "semget": (64, 190),
    "msgget": (68, 186), "mq_open": (240, 180),
    # Keys of whoever grades.
    "add_key": (248, 217), "request_key": (249, 218), "keyctl": (250, 219),
    # Name spaces, in which more is allowed.
    "unshare": (272, 97), "setns": (308, 268), "mount": (165, 40),
    # Wide doors into the kernel, which no answer needs.
    "userfaultfd": (323, 282), "bpf": (321, 280), "perf_event_open": (298, 241), "io_uring_setup": (425, 425),
    "ptrace": (101, 117),
}  # fmt: skip
"""Numbers of the refused calls on x86_64 and aarch64."""
MACHINE_NUMBERS = {"x86_64": (0, 0xC000003E, 56), "aarch64": (1, 0xC00000B7, 220)}
"""Column above, the kernel's number of the architecture, the number of ``clone``."""
CLONE3 = 435
KEYCTL = REFUSED_CALLS["keyctl"]


def refusals() -> bytes:
    """The filter for this machine; empty where its calls are not known.

    >>> len(refusals()) % 8
    0
    """
    if platform.machine() not in MACHINE_NUMBERS:
        return b""
    column, architecture, clone = MACHINE_NUMBERS[platform.machine()]
    program = [
        _step(LOAD_WORD, 0, 0, ARCHITECTURE_OFFSET),
        _step(JUMP_IF_EQUAL, 1, 0, architecture),
        _step(RETURN_VALUE, 0, 0, KILL_ACTION),
    ]
    program += [
        _step(LOAD_WORD, 0, 0, NUMBER_OFFSET),
        _step(JUMP_IF_BITS, 0, 1, FOREIGN_CALLS_START),
        _step(RETURN_VALUE, 0, 0, KILL_ACTION),
    ]
    for numbers in REFUSED_CALLS.values():
        program += _refuse(numbers[column], errno.EPERM)
    # Its flags lie in memory, where a filter cannot look; the C library then takes clone.
    program += _refuse(CLONE3, errno.ENOSYS)
    program += [
        _step(JUMP_IF_EQUAL, 0, 3, clone),
        _step(LOAD_WORD, 0, 0, FLAGS_OFFSET),
        _step(JUMP_IF_BITS, 0, 1, NEW_USER_FLAG),
    ]
    return b"".join(
        [*program, _step(RETURN_VALUE, 0, 0, ERROR_ACTION | errno.EPERM), _step(RETURN_VALUE, 0, 0, ALLOW_ACTION)]
    )


def new_keyring() -> int:
    """The number of the call that joins a new session keyring; 0 where it is not known."""
    return KEYCTL[MACHINE_NUMBERS[platform.machine()][0]] if platform.machine() in MACHINE_NUMBERS else 0


def _refuse(number: int, error: int) -> list[bytes]:
    return [_step(JUMP_IF_EQUAL, 0, 1, number), _step(RETURN_VALUE, 0, 0, ERROR_ACTION | error)]


def _step(operation: int, if_true: int, if_false: int, value: int) -> bytes:
    """One instruction of the filter; the jumps count the instructions that are left out."""
    return struct.pack("=HBBI", operation, if_true, if_false, value)
