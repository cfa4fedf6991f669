"""A picture as a file in PNG, by the standard (ISO/IEC 15948): a signature, and chunks with a checksum each.

A sheet is mostly white, so its rows are compressed as they are.  Imaging libraries try five filters on each row first,
which takes as long as drawing the sheet, and saves a twentieth of the file.
"""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

SIGNATURE = b"\x89PNG\r\n\x1a\n"
INCH = 0.0254
"""m"""
QUICK = 1
"""How hard is compressed: lines on white get hardly smaller by more."""


def png_of(pixels: NDArray[np.uint8], dpi: float) -> bytes:
    """The file of a picture (rows, columns, 4) of red, green, blue and opacity, with so many dots an inch.

    >>> white = png_of(np.full((2, 3, 4), 255, dtype=np.uint8), 100.0)
    >>> white[:4], int.from_bytes(white[16:20]), int.from_bytes(white[20:24])
    (b'\\x89PNG', 3, 2)
    """
    height, width, _ = pixels.shape
    # 8 bits a channel, four channels; no filter, no interlacing.
    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    a_metre = round(dpi / INCH)
    rows = np.zeros((height, 1 + 4 * width), dtype=np.uint8)
    rows[:, 1:] = pixels.reshape(height, -1)
    chunks = (
        (b"IHDR", header),
        (b"tEXt", b"Software\0graphcam"),
        (b"pHYs", struct.pack(">IIB", a_metre, a_metre, 1)),
        (b"IDAT", zlib.compress(rows.data, QUICK)),
        (b"IEND", b""),
    )
    return SIGNATURE + b"".join(_chunk(name, data) for name, data in chunks)


def _chunk(name: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(data, zlib.crc32(name)))
