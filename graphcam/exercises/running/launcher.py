"""Runs the cells of one notebook; this file is a program of its own, on the inside of the sandbox.

It needs the standard library alone, so that it starts quickly.  It reads one JSON object from standard input and hands
the answers out as lines of JSON on a pipe.  It guards nothing: the limits are set before the first cell is run, and
whoever reads the pipe trusts nothing that comes out of it.
"""

import ctypes
import json
import os
import resource
import sys
import traceback
import types
from collections.abc import Callable
from typing import Any

ANSWER_MIME_TYPE = "application/vnd.graphcam.answer.v1+json"


JOIN_SESSION_KEYRING, SET_NO_NEW_PRIVS, SET_SECCOMP, SECCOMP_FILTER = 1, 38, 22, 2
"""Numbers of the kernel's, of keyctl and prctl."""


class SocketFilter(ctypes.Structure):
    """The kernel's ``sock_fprog``: how many instructions of 8 bytes, and where they are."""

    _fields_ = (("length", ctypes.c_ushort), ("code", ctypes.c_char_p))


def main() -> None:
    """Take the limits upon oneself, then run the cells."""
    order = json.loads(sys.stdin.buffer.read())
    sys.stdin.close()
    set_limits(order)
    keep_out(order)
    sys.path[:0] = order["path"]
    namespace: dict[str, Any] = {"__name__": "__main__"}
    shown: list[dict[str, Any]] = []

    def hand_out(values: dict[str, Any]) -> None:
        shown.append(values)
        os.write(order["pipe"], json.dumps(values, default=plain_values).encode() + b"\n")

    offer_display(namespace, hand_out)
    try:
        for cell in order["cells"]:
            exec(compile(cell, "<cell>", "exec"), namespace)
    # A sys.exit and an interrupt end the notebook too, not the handing out.
    except BaseException:  # noqa: BLE001
        traceback.print_exc(limit=-1)
    if not shown:
        hand_out({name: namespace[name] for name in order["names"] if name in namespace})
    sys.stdout.flush()
    sys.stderr.flush()
    # Threads and handlers that were left behind have nothing more to say.
    os._exit(0)


def set_limits(order: dict[str, Any]) -> None:
    """Set the limits, the last first that would forbid setting the others."""
    for name, limit in order["limits"].items():
        resource.setrlimit(getattr(resource, name), (limit, limit))
    if os.getuid() == 0 and order["user"]:
        # The limit of processes does not bind root, and counts those of one user.
        os.setgroups([])
        os.setgid(order["user"])
        os.setuid(order["user"])


def keep_out(order: dict[str, Any]) -> None:
    """Leave the keys of whoever grades behind, and give up for ever the calls that code is refused."""
    library = ctypes.CDLL(None, use_errno=True)
    if order["keyring"]:
        library.syscall(order["keyring"], JOIN_SESSION_KEYRING, None)
    code = bytes.fromhex(order["refused"])
    if not code:
        return
    program = SocketFilter(len(code) // 8, code)
    given = library.prctl(SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    if given or library.prctl(SET_SECCOMP, SECCOMP_FILTER, ctypes.byref(program), 0, 0):
        raise OSError(ctypes.get_errno(), "the kernel takes no list of refused calls")


def offer_display(namespace: dict[str, Any], hand_out: Callable[[dict[str, Any]], None]) -> None:
    """What a notebook calls ``display``, also under the name by which IPython has it."""

    def display(*values: Any, raw: bool = False, **_: Any) -> None:
        for value in values:
            bundle = value if raw else bundle_of(value)
            if isinstance(bundle, dict) and isinstance(bundle.get(ANSWER_MIME_TYPE), dict):
                hand_out(bundle[ANSWER_MIME_TYPE])
            else:
                print(value)  # noqa: T201  the output of the notebook

    namespace["display"] = display
    module = types.ModuleType("IPython.display")
    # Pictures and formatted texts are for the student's eyes, not for grading.
    module.__dict__.update({"display": display, "__getattr__": ignoring})
    package = types.ModuleType("IPython")
    # The version is what matplotlib looks at: since this one it needs no help to show its pictures.
    version = {"version_info": (8, 24, 0), "__version__": "8.24.0"}
    package.__dict__.update({"display": module, "get_ipython": lambda: None, "__path__": [], **version})
    sys.modules.update({"IPython": package, "IPython.display": module})


def ignoring(_: str) -> Callable[..., None]:
    """A function for anything else that a notebook wants to show."""

    def show(*_: Any, **__: Any) -> None:
        """Show nothing: there is no screen."""

    return show


def bundle_of(value: Any) -> Any:
    """What an object shows of itself, if it says so."""
    make = getattr(value, "_repr_mimebundle_", None)
    return make() if callable(make) else None


def plain_values(value: Any) -> Any:
    """Arrays as lists, complex numbers as [x, y]."""
    if isinstance(value, complex):
        return [value.real, value.imag]
    return value.tolist() if hasattr(value, "tolist") else str(value)


if __name__ == "__main__":
    main()
