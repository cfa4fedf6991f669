"""Hand-ins that mean harm or mean nothing, built in a folder: data that breaks readers, and code that breaks out."""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Callable
from pathlib import Path

import ezdxf
from ezdxf.document import Drawing

from graphcam.exercises.running.launcher import MIME

Build = Callable[[Path], object]


def toml(text: str) -> Build:
    return lambda folder: (folder / "answers.toml").write_text(text)


def raw(name: str, data: bytes) -> Build:
    return lambda folder: (folder / name).write_bytes(data)


def notebook(source: str, tags: tuple[str, ...] = ("answers",)) -> Build:
    cell = {"cell_type": "code", "metadata": {"tags": list(tags)}, "source": source, "outputs": []}
    return raw("answers.ipynb", json.dumps({"cells": [cell], "metadata": {}, "nbformat": 4}).encode())


def _device(folder: Path) -> None:
    # Only root may make one; for everybody else a link to one is as near as it gets.
    if os.getuid() == 0:
        os.mknod(folder / "answers.toml", 0o20666, os.makedev(1, 5))
    else:
        (folder / "answers.toml").symlink_to("/dev/zero")


def _many_files(folder: Path) -> None:
    for k in range(10_000):
        (folder / f"{k}.toml").touch()


def _zip_bomb(folder: Path) -> None:
    with zipfile.ZipFile(folder / "answers.ipynb", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("answers.ipynb", b"0" * 20_000_000)


def _sparse(folder: Path) -> None:
    with (folder / "answers.dxf").open("wb") as file:
        file.truncate(50 << 30)


def drawing(draw: Callable[[Drawing], object]) -> Build:
    def build(folder: Path) -> None:
        document = ezdxf.new("R2010")
        draw(document)
        document.saveas(folder / "answers.dxf")

    return build


def _empty_blocks(document: Drawing) -> None:
    document.blocks.new("NOTHING")
    places = {"row_count": 30_000, "column_count": 30_000, "row_spacing": 1, "column_spacing": 1}
    document.modelspace().add_blockref("NOTHING", (0, 0), dxfattribs=places)


def _spline_through(count: int) -> Build:
    return drawing(lambda document: document.modelspace().add_spline([(k % 7, k % 5) for k in range(count)]))


DATA: dict[str, Build] = {
    "infinite": toml("{0} = inf"),
    "not a number": toml("{0} = nan"),
    "1e999": toml("{0} = 1e999"),
    "a huge integer": toml("{0} = " + "9" * 4000),
    "a huger integer": toml("{0} = " + "9" * 60_000),
    "a boolean": toml("{0} = true"),
    "a text": toml('{0} = "12"'),
    "a table": toml("{0} = {{a = 1}}"),
    "a date": toml("{0} = 2020-01-01"),
    "a list": toml("{0} = [1, 2, 3]"),
    "nested a million deep in TOML": toml("{0} = " + "[" * 60_000),
    "dotted keys": toml("a" + ".a" * 31_000 + " = 1"),
    "dotted keys of quoted points": toml('"[".' * 15_000 + "a = 1"),
    "a key twice in TOML": toml("{0} = 1\n{0} = 2"),
    "answers is no table": toml("answers = 3"),
    "not UTF-8": raw("answers.toml", b"\xff\xfe\x00"),
    "an empty file": raw("answers.toml", b""),
    "a formula": toml('"=HYPERLINK(1)" = 1'),
    "a row twice in CSV": raw("answers.csv", b"{0},1\n{0},2\n"),
    "inf in CSV": raw("answers.csv", b"{0},inf\n"),
    "a quote that never ends": raw("answers.csv", b'"' + b"x" * 190_000),
    "a million cells": raw("answers.csv", b"," * 190_000),
    "a NUL in CSV": raw("answers.csv", b"{0},\x00\n"),
    "an empty notebook": raw("answers.ipynb", b""),
    "no JSON": raw("answers.ipynb", b"{cells"),
    "JSON of another kind": raw("answers.ipynb", b"[1, 2]"),
    "a corrupt notebook": raw("answers.ipynb", b'{"cells": [1, {"cell_type": "code", "metadata": 3, "source": {}}]}'),
    "no tagged cell": notebook("{0} = 1", tags=()),
    "nested a million deep in JSON": raw("answers.ipynb", b"[" * 1_000_000),
    "nested deep in a cell": notebook("{0} = " + "[" * 30_000),
    "a long chain of signs": notebook("{0} = " + "-" * 60_000 + "1"),
    "a long sum": notebook("{0} = 1" + "+1" * 30_000),
    "code for a literal": notebook("{0} = __import__('os').system('touch /tmp/graphcam-owned')"),
    "a cell that is too long": notebook("{0} = 1 #" + "x" * 100_000),
    "a power for a literal": notebook("{0} = 9**9**9"),
    "a key twice in a cell": notebook("answers = {{'{0}': 1, '{0}': 2}}"),
    "an infinite literal": notebook("{0} = 1e999"),
    "a pipe": lambda folder: os.mkfifo(folder / "answers.toml"),
    "a link to the key": lambda folder: (folder / "answers.toml").symlink_to(folder.parent / "key.toml"),
    "a link to itself": lambda folder: (folder / "answers.toml").symlink_to("answers.toml"),
    "a folder for a file": lambda folder: (folder / "answers.toml").mkdir(),
    "a device": _device,
    "ten thousand files": _many_files,
    "a zip bomb": _zip_bomb,
    "a sparse file of 50 GB": _sparse,
    "no DXF": raw("answers.dxf", b"0\nSECTION\n2\n" + b"x" * 1000),
    "a DWG": raw("answers.dxf", b"AC1032" + bytes(1000)),
    "a DXF of zeros": raw("answers.dxf", bytes(1_000_000)),
    "a binary DXF of zeros": raw("answers.dxf", b"AutoCAD Binary DXF\r\n\x1a\0" + bytes(4_000_000)),
    "a DXF of a million lines": raw("answers.dxf", b"0\nLINE\n" * 500_000),
    "a block a billion times": drawing(_empty_blocks),
    "a spline through ten thousand points": _spline_through(10_000),
}
"""What is read and never run; "{0}" stands for the name of an answer."""

CODE: dict[str, str] = {
    "an endless loop": "while True: pass",
    "a loop that ignores being interrupted": """
import signal
for number in (signal.SIGINT, signal.SIGTERM, signal.SIGALRM, signal.SIGXCPU):
    signal.signal(number, signal.SIG_IGN)
while True:
    try:
        while True: pass
    except BaseException: pass""",
    "20 GB": "x = bytearray(20 << 30)",
    "memory bit by bit": "x = []\nwhile True: x.append(bytearray(10 << 20))",
    "a fork bomb": "import os\nwhile True:\n    try: os.fork()\n    except OSError: pass",
    "threads without end": "import threading as t, time\nwhile True: t.Thread(target=time.sleep, args=(60,)).start()",
    "60 MB of output": "for _ in range(60): print('x' * 1_000_000)",
    "sys.exit": "import sys\nsys.exit(0)",
    "os._exit": "import os\nos._exit(0)",
    "a crash of the interpreter": "import ctypes\nctypes.string_at(0)",
    "a process that stays": """
import os, time
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        time.sleep(300)
    os._exit(0)""",
    "abs redefined": "import builtins, math\nbuiltins.abs = lambda x: 0.0\nmath.isclose = lambda *a, **k: True",
    "reading the key": "{0} = open({key!r}).read()",
    "reading the secret": "{0} = open({secret!r}).read()",
    "reading a neighbour": "{0} = open({neighbour!r}).read()",
    "looking for the key": """
import os
{0} = [os.path.join(a, f) for a, _, fs in os.walk('/') if not a.startswith(('/proc', '/sys', '/usr')) for f in fs
       if 'secret' in f or 'certificate' in f and f.endswith('.json')]""",
    "writing the grade book": "open({grades!r}, 'w').write('all right')",
    "the network": "import socket\nsocket.create_connection(('127.0.0.1', {port}), 2).send(b'hello')",
    "path traversal": "open('../../../../../../tmp/graphcam-owned', 'w')",
    "infinite answers": "{0} = float('inf')",
    "answers that are no JSON": "import os\nos.write({pipe}, b'{{not json\\n')",
    "answers without end": "import os\nwhile True: os.write({pipe}, b'[' * 65536)",
    "answers twice in one": 'import os\nos.write({pipe}, b\'{{"{0}": 1, "{0}": 2}}\\n\')',
    "deep answers": "import os\nos.write({pipe}, b'[' * 100000 + b'\\n')",
    "a display of nonsense": "display({{'" + MIME + "': {{'{0}': 'all right', 'total': 100}}}}, raw=True)",
}
"""What is run; the names in braces are filled in."""
