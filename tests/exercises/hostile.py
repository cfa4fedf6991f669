"""Hand-ins that mean harm or mean nothing, built in a folder: data that breaks readers.  Code stands elsewhere."""

from __future__ import annotations

import json
import os
import socket
import struct
import zipfile
from collections.abc import Callable
from functools import partial
from io import BytesIO
from pathlib import Path

import ezdxf
from ezdxf.document import Drawing

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


def _overlapping_zip(folder: Path) -> None:
    """Twenty thousand entries that are one stored file."""
    body = BytesIO()
    with zipfile.ZipFile(body, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("answers.toml", b"0" * 1_000_000)
    data = body.getvalue()
    listed, end = data.rfind(b"PK\x01\x02"), bytearray(data[data.rfind(b"PK\x05\x06") :])
    entries = data[listed : data.rfind(b"PK\x05\x06")] * 20_000
    struct.pack_into("<HHII", end, 8, 20_000, 20_000, len(entries), listed)
    (folder / "answers.zip").write_bytes(data[:listed] + entries + bytes(end))


def cells(*contents: object, **top: object) -> Build:
    """A notebook of cells as they are, with further entries at its top."""
    return raw("answers.ipynb", json.dumps({"cells": contents, "metadata": {}, "nbformat": 4, **top}).encode())


def tagged(**changed: object) -> dict[str, object]:
    """An answer cell, but for what is changed."""
    return {"cell_type": "code", "metadata": {"tags": ["answers"]}, "source": "{0} = []", "outputs": [], **changed}


def dxf(*groups: object) -> Build:
    """A drawing of nothing but group codes and values."""
    return raw("answers.dxf", "".join(f"{group}\n" for group in groups).encode("utf-8", "surrogatepass"))


def entities(*groups: object) -> Build:
    """A drawing whose section of entities is made of group codes and values."""
    return dxf(0, "SECTION", 2, "ENTITIES", *groups, 0, "ENDSEC", 0, "EOF")


def _hard_link(folder: Path) -> None:
    (folder / "answers.ipynb").write_bytes(b"[1]")
    os.link(folder / "answers.ipynb", folder / "answers.toml")


def _long_chain(folder: Path) -> None:
    for k in range(60):
        (folder / f"link{k}").symlink_to(f"link{k + 1}")
    (folder / "answers.csv").symlink_to("link0")


def _at_time(seconds: int) -> Build:
    def build(folder: Path) -> None:
        (folder / "answers.toml").write_text("{0} = []")
        os.utime(folder / "answers.toml", (seconds, seconds))

    return build


def _socket(folder: Path) -> None:
    place = os.open(folder, os.O_RDONLY)
    with socket.socket(socket.AF_UNIX) as server:
        # The path of a socket may be 107 bytes long.
        server.bind(f"/proc/self/fd/{place}/answers.toml")
    os.close(place)


def _closed(folder: Path) -> None:
    (folder / "answers.toml").write_text("{0} = []")
    (folder / "answers.toml").chmod(0)


def _blocks_in_blocks(document: Drawing) -> None:
    for k in range(40):
        block = document.blocks.new(f"B{k}")
        for _ in range(2 if k else 0):
            block.add_blockref(f"B{k - 1}", (0, 0))
    document.modelspace().add_blockref("B39", (0, 0))


def _block_of_itself(document: Drawing) -> None:
    document.blocks.new("SELF").add_blockref("SELF", (0, 0))
    document.modelspace().add_blockref("SELF", (0, 0))


def _blocks_of_each_other(document: Drawing) -> None:
    document.blocks.new("ONE").add_blockref("OTHER", (0, 0))
    document.blocks.new("OTHER").add_blockref("ONE", (0, 0))
    document.modelspace().add_blockref("ONE", (0, 0))


def _scaled_block(scale: float, document: Drawing) -> None:
    document.blocks.new("SIZE").add_lwpolyline([(0, 0), (1, 2), (3, 4)], dxfattribs={"layer": "PITCH"})
    document.modelspace().add_blockref("SIZE", (0, 0), dxfattribs={"xscale": scale, "yscale": scale})


DATA: dict[str, Build] = {
    "infinite": toml("{0} = inf"),
    "not a number": toml("{0} = nan"),
    "1e999": toml("{0} = 1e999"),
    "a huge integer": toml("{0} = " + "9" * 4000),
    "a huger integer": toml("{0} = " + "9" * 60_000),
    "a boolean": toml("{0} = true"),
    "a text": toml('{0} = "двенадцать"'),
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
    # Encodings.
    "TOML in UTF-16": raw("answers.toml", "{0} = 1".encode("utf-16")),
    "TOML in UTF-32": raw("answers.toml", "{0} = 1".encode("utf-32")),
    "TOML in UTF-7": raw("answers.toml", b"+AHM- +AD0- 1"),
    "TOML in EBCDIC": raw("answers.toml", "{0} = 1".encode("cp500")),
    "half a surrogate": raw("answers.toml", b"{0} = '\xed\xa0\x80'"),
    "an overlong NUL": raw("answers.toml", b"{0} = '\xc0\x80'"),
    "Latin letters in CSV": raw("answers.csv", "{0},\xe9\xff\n".encode("latin-1")),
    "CSV in UTF-16": raw("answers.csv", "{0},1\n".encode("utf-16")),
    "a notebook in UTF-16": raw("answers.ipynb", '{{"cells": []}}'.encode("utf-16-le")),
    "a notebook of half surrogates": raw(
        "answers.ipynb", b'{{"cells": [{{"cell_type": "code", "source": "\\ud800"}}]}}'
    ),
    # TOML.
    "a control character": raw("answers.toml", b"{0} = '\x01'"),
    "a bare carriage return": raw("answers.toml", b"{0} = 1\r{0} = 2"),
    "an offset of time": toml("{0} = 1979-05-27T07:32:00-99:99"),
    "a time of the day": toml("{0} = 23:59:59.999999999999"),
    "a hexadecimal of ten thousand digits": toml("{0} = 0x" + "f" * 10_000),
    "ten thousand tables": toml("".join(f"[t{k}]\n" for k in range(7_000))),
    "an array of tables twice": toml("[[answers]]\n{0} = 1\n[[answers]]\n{0} = 2"),
    "a table over a value": toml("{0} = 1\n[{0}]\na = 1"),
    "an inline table that grows": toml("a = {{}}\na.b = 1"),
    "a text that never ends in TOML": toml('{0} = """' + "x" * 60_000),
    "an escape beyond Unicode": toml('{0} = "\\UFFFFFFFF"'),
    "nested inline tables": toml("{0} = " + "{{a=" * 12_000),
    "an empty key": toml('"" = 1'),
    "an answer under an answer": toml("[{0}]\n{0} = 1"),
    # Names that look like others.
    "full-width letters": raw("answers.toml", '"\uff53_max" = 1'.encode()),
    "a name turned round": raw("answers.toml", '"\u202e{0}" = 1'.encode()),
    "a name with nothing in it": raw("answers.toml", '"{0}\u200b" = 1'.encode()),
    "a hundred accents": raw("answers.toml", ('"{0}' + "\u0301" * 5_000 + '" = 1').encode()),
    "terminal codes in a name": raw("answers.toml", b'"\\u001b]0;x\\u0007\\u001b[2J" = 1'),
    "a line break in a name": raw("answers.toml", b'"a\\nTOML: CSV" = 1'),
    "HTML in a name": raw("answers.toml", b'"<a href=//x>" = 1'),
    "a template in a name": raw("answers.toml", b'"{{{{ 7 * 7 }}}}%s%n" = 1'),
    "a command for a spreadsheet": raw("answers.csv", b"=cmd|' /C calc'!A0,1\n@SUM(1),2\n+1,3\n-1,4\n\t=1,5\n"),
    "a thousand unknown names": toml("".join(f"x{k} = 1\n" for k in range(3_000))),
    # CSV.
    "three columns": raw("answers.csv", b"{0},1,2\n{0},1,3\n"),
    "one column": raw("answers.csv", b"{0}\n"),
    "decimal commas without quotes": raw("answers.csv", b"{0},1,5,7\n{0};1,5\n"),
    "a decimal comma that hides a thousand": raw("answers.csv", b'{0},"1,234,5"\n'),
    "a hundred thousand lines": raw("answers.csv", b"\n" * 190_000),
    "a field of 199 kB": raw("answers.csv", b"{0}," + b"9" * 199_000),
    "digits of another script": raw("answers.csv", "{0},\u0967\u0968\u00b2\n".encode()),
    "underscores in a number": raw("answers.csv", b"{0},1_0__0\n"),
    "an infinite number spelled out": raw("answers.csv", b"{0},-Infinity\n"),
    "a number and a formula": raw("answers.csv", b'{0},"=1+1"\n'),
    "a file over its limit": raw("answers.csv", b"{0},1\n" * 100_000),
    # Notebooks.
    "a cell that is a list": cells([[]], [tagged()]),
    "tags that are no list": cells(tagged(metadata={"tags": {"answers": 1}})),
    "a source of numbers": cells(tagged(source=[1, 2, 3])),
    "a source of lists": cells(tagged(source=[["{0} = 1"]])),
    "cells that are a table": raw("answers.ipynb", b'{{"cells": {{"0": 1}}}}'),
    "a notebook of version 2": raw("answers.ipynb", b'{{"worksheets": [{{"cells": []}}], "nbformat": 2}}'),
    "NaN in JSON": raw("answers.ipynb", b'{{"cells": [NaN, Infinity]}}'),
    "JSON with a huge integer": raw("answers.ipynb", b'{{"cells": ' + b"9" * 10_000 + b"}}"),
    "a hundred thousand cells": cells(*[{"cell_type": "code"}] * 100_000),
    "two tagged cells that disagree": cells(tagged(source="{0} = 'a'"), tagged(source="{0} = 'b'")),
    "a list of itself in a cell": cells(tagged(source="{0} = [...]")),
    "bytes for a literal": cells(tagged(source="{0} = b'12'")),
    "a complex number": cells(tagged(source="{0} = 1e999j")),
    "a set for a literal": cells(tagged(source="{0} = {{1, 2}}")),
    "a lambda for a literal": cells(tagged(source="{0} = (lambda: 1)()")),
    "a comprehension for a literal": cells(tagged(source="{0} = [0 for _ in range(10 ** 9)][0]")),
    "a walrus": cells(tagged(source="({0} := 1)")),
    "an f-string": cells(tagged(source="{0} = f'{{9 ** 9 ** 9}}'")),
    "a NUL in a cell": cells(tagged(source="{0} = 1\0")),
    "a sum with an octal integer of old": cells(tagged(source="{0} = 0777 + 1")),
    "a literal times a literal": cells(tagged(source="{0} = 'x' * 10 ** 10")),
    "a starred target": cells(tagged(source="*{0}, = 1,")),
    "other scripts' letters in a cell": cells(tagged(source="\u0455_max = 1")),
    # DXF.
    "a section that never ends": dxf(0, "SECTION", 2, "ENTITIES", 0, "LINE", 8, "PITCH"),
    "group codes that are no numbers": entities("zero", "LINE", "eight", "PITCH"),
    "a coordinate of text": entities(0, "LINE", 8, "PITCH", 10, "ten", 20, "twenty"),
    "a coordinate of 1e999": entities(0, "LINE", 8, "PITCH", 10, "1e999", 20, "nan", 11, "inf", 21, 0),
    "a polyline that promises a billion": entities(0, "LWPOLYLINE", 8, "PITCH", 90, 10**9, 10, 0, 20, 0),
    "a polyline that promises less than nothing": entities(0, "LWPOLYLINE", 8, "PITCH", 90, -1, 10, 0, 20, 0),
    "a spline without knots": entities(0, "SPLINE", 8, "PITCH", 71, 3, 72, 0, 73, 0),
    "a spline of degree a million": entities(0, "SPLINE", 8, "PITCH", 71, 10**6, 72, 3, 73, 1, 40, 0, 10, 0, 20, 0),
    "a circle of negative radius": entities(0, "CIRCLE", 8, "PITCH", 10, 0, 20, 0, 40, -5),
    "an arc of a million turns": entities(0, "ARC", 8, "PITCH", 10, 0, 20, 0, 40, 1, 50, 0, 51, 1e300),
    "an ellipse of no ratio": entities(0, "ELLIPSE", 8, "PITCH", 10, 0, 20, 0, 11, 0, 21, 0, 40, 0),
    "a layer of 100 kB": entities(0, "POINT", 8, "L" * 100_000, 10, 0, 20, 0),
    "an odd number of lines": raw("answers.dxf", b"0\nSECTION\n2\nENTITIES\n0\nLINE\n8"),
    "blocks in blocks in blocks": drawing(_blocks_in_blocks),
    "a block of itself": drawing(_block_of_itself),
    "an attribute that leads outside": entities(0, "IMAGE", 8, "PITCH", 1, "/etc/passwd"),
    "a spline of degree 900": entities(
        *(0, "SPLINE", 8, "PITCH", 71, 900, 72, 1901, 73, 1000),
        *(part for k in range(1901) for part in (40, k)),
        *(part for k in range(1000) for part in (10, k % 7, 20, k % 5)),
    ),
    "a block at a scale of 1e300": drawing(partial(_scaled_block, 1e300)),
    "a block at a scale of nought": drawing(partial(_scaled_block, 0.0)),
    "two blocks of each other": drawing(_blocks_of_each_other),
    "an ellipse of a billion turns": entities(
        *(0, "ELLIPSE", 8, "PITCH", 10, 0, 20, 0, 11, 5, 21, 0, 40, 0.5, 41, -1e9, 42, 1e9)
    ),
    "a spline of degree 40 by five thousand points": drawing(
        lambda document: document.modelspace().add_open_spline([(k % 7, k % 5) for k in range(5000)], degree=40)
    ),
    "a polyline of bulges of 1e308": drawing(
        lambda document: document.modelspace().add_lwpolyline([(0, 0, 0, 0, 1e308), (1, 1, 0, 0, -1e308)])
    ),
    "a layer with a direction": drawing(
        lambda document: document.modelspace().add_line((0, 0), (1, 1), dxfattribs={"layer": "\u202ePITCH\u2066"})
    ),
    "an overlapping zip": _overlapping_zip,
    "not by the ten thousand": notebook("{0} = " + "not " * 20_000 + "1"),
    "units by the ten thousand": toml('{0} = "12' + " mm" * 15_000 + '"'),
    "a unit with a direction": toml('{0} = "12 \u202emm\u202c"'),
    "decimal commas by the ten thousand": toml('{0} = "1' + ",1" * 20_000 + '"'),
    "an exponent of ten thousand digits": toml("{0} = 1e" + "9" * 10_000),
    "minus signs by the ten thousand": raw("answers.toml", b"{0} = " + "\u2212 ".encode() * 15_000 + b"1"),
    "outputs nested without end": raw(
        "answers.ipynb", b'{{"cells": [{{"outputs": ' + b"[" * 50_000 + b"]" * 50_000 + b"}}]}}"
    ),
    # What lies in the folder.
    "a hard link to another kind": _hard_link,
    "links to links": _long_chain,
    "before the epoch": _at_time(-(1 << 31)),
    "far in the future": _at_time(1 << 33),
    "a socket": _socket,
    "a file that nobody may read": _closed,
    "an endless file of the system": lambda folder: (folder / "answers.csv").symlink_to("/proc/self/mem"),
    "a link out by a descriptor": lambda folder: (folder / "answers.dxf").symlink_to("/proc/self/fd/0"),
    "names of another case": raw("Answers.TOML ", b"{0} = 1"),
    "an empty folder": lambda folder: None,
}
"""What is read and never run; "{0}" stands for the name of an answer."""

NUMBERS = {
    "the largest number": "1.7976931348623157e308",
    "the least number": "5e-324",
    "a number below the least": "1e-400",
    "a zero with a sign": "-0.0",
    "the largest negative number": "-1.7976931348623157e308",
    "more digits than a number holds": "0." + "9" * 5_000,
    "the largest whole number": str((1 << 63) - 1),
    "a whole number that no double holds": str((1 << 53) + 1),
    "an octal number": "0o777",
}
"""Numbers that are read, in TOML, and are wrong."""
