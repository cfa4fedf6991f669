"""Levels of isolation, and what a student's code may use up."""

from dataclasses import dataclass
from enum import StrEnum


class Level(StrEnum):
    """How far a student's code is kept from everything else; in order, the stricter the later."""

    L0 = "L0"
    """Nothing is run: answers are data."""
    L1 = "L1"
    """A process with limits of time and memory, for students whom you trust.

    It keeps nothing else: as an ordinary user, code reads, overwrites and deletes what the grader can, the secret and
    the answers of others among it, and reaches the network.  Of root it gets a user of its own and no right.
    """
    L2 = "L2"
    """Bubblewrap: no network, no file but Python itself, no process that outlives it, no keys, no further name space.

    The memory of all its processes together is watched, since the kernel's own bound (a control group) is seldom given
    to users; what takes more is killed.  It trusts the kernel: an error in that is a way out.
    """


MEBIBYTE = 1 << 20


@dataclass(frozen=True)
class ResourceLimits:
    """Limits of one run.

    seconds : of wall time
    memory : bytes of address space of each process, and of memory of all of them together
    processes : at once, threads among them
    written : bytes of a file, and of the folder for temporary files
    handed_out : bytes of answers that are read
    kept : bytes of output that are kept; the rest is thrown away as it comes
    """

    seconds: float = 10.0
    memory: int = 1024 * MEBIBYTE
    processes: int = 16
    written: int = 32 * MEBIBYTE
    handed_out: int = MEBIBYTE
    kept: int = 20_000

    def resources(self, processes_already: int) -> dict[str, int]:
        """The limits of :mod:`resource` by name.

        >>> ResourceLimits(seconds=3).resources(0)["RLIMIT_CPU"]
        4
        """
        return {
            "RLIMIT_AS": self.memory,
            # For what escapes the clock on the wall.
            "RLIMIT_CPU": int(self.seconds) + 1,
            "RLIMIT_NPROC": processes_already + self.processes,
            "RLIMIT_FSIZE": self.written,
            "RLIMIT_NOFILE": 128,
            "RLIMIT_CORE": 0,
        }
