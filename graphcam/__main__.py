"""The entry point of ``graphcam`` and ``python -m graphcam``; Ctrl-C works even while the libraries load."""

import gc
import os
import signal
import sys
from io import TextIOWrapper
from types import FrameType

INTERRUPTED_STATUS = 130
"""Exit status after Ctrl-C, as of a shell."""
OUTPUT_ERROR_STATUS = 2
"""Exit status when what is printed cannot be written."""


def main() -> None:
    """Run the command line; Ctrl-C ends it with one line."""
    # Whoever starts it in the background may want it not to hear.
    heard = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if heard:
        signal.signal(signal.SIGINT, _end)
    for stream in (sys.stdout, sys.stderr):
        # A file or a pipe on Windows may have no letters for a rule or an index: better another sign than no table.
        if isinstance(stream, TextIOWrapper) and stream.errors == "strict":
            stream.reconfigure(errors="replace")
    # Nothing that is loaded becomes garbage.
    gc.disable()
    from graphcam.cli import main as run

    gc.freeze()
    gc.enable()
    if heard:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        run()
    except KeyboardInterrupt:
        _end()
    except SystemExit as end:
        # So the command line ends after Ctrl-C, without a word.
        if end.code == INTERRUPTED_STATUS:
            _end()
        # All is done, and the end of Python itself is not worth interrupting.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        raise
    except OSError as error:
        # The commands tell of the files; what is left is that to which they print.
        os.write(2, f"graphcam: the standard output cannot be written ({error.strerror})\n".encode())
        os._exit(OUTPUT_ERROR_STATUS)


def _end(signal_number: int = signal.SIGINT, _frame: FrameType | None = None) -> None:
    """Print one line and end at once; nothing needs clearing away at this time."""
    os.write(2, b"graphcam: interrupted\n")
    os._exit(INTERRUPTED_STATUS)


if __name__ == "__main__":
    main()
