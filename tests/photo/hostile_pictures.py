"""Files that are not what they seem, for who opens pictures."""

from __future__ import annotations

import os
import struct
import zlib

import numpy as np
import pillow_heif
from PIL import Image

KEYED = bytes.fromhex("28bf4e5e4e758a4164004e56fffa01082e2e00b6d0683e802f0ca9fe6453697a")


def sample(width=400, height=300) -> Image.Image:
    """White with a red corner at the upper left and a blue one at the lower left."""
    pixels = np.full((height, width, 3), 240, np.uint8)
    pixels[: height // 3, : width // 4] = 250, 10, 10
    pixels[-height // 3 :, : width // 4] = 10, 10, 250
    return Image.fromarray(pixels)


def png(width, height, data, bits=8, colour=2) -> bytes:
    """A PNG that says its size, whatever its data are."""

    def chunk(kind, content):
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b"")


def locked_pdf() -> bytes:
    """A PDF that says it is encrypted with a password that nobody has."""
    parts = [
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 100 100] >>",
        b"<< /Filter /Standard /V 1 /R 2 /Length 40 /P -4 /O <" + KEYED.hex().encode() + b"> /U <"
        + KEYED[::-1].hex().encode() + b"> >>",
    ]  # fmt: skip
    return pdf_of(parts, b"/Encrypt 4 0 R /ID [<00112233445566778899aabbccddeeff> <00112233445566778899aabbccddeeff>] ")


def pdf_of(parts: list[bytes], more=b"") -> bytes:
    """A PDF of objects, the first of which is its catalog."""
    data, places = b"%PDF-1.4\n", []
    for number, part in enumerate(parts, 1):
        places.append(len(data))
        data += b"%d 0 obj\n" % number + part + b"\nendobj\n"
    table = b"".join(b"%010d 00000 n \n" % place for place in places)
    start = len(data)
    data += b"xref\n0 %d\n0000000000 65535 f \n" % (len(parts) + 1) + table
    return data + b"trailer << /Size %d /Root 1 0 R %s>>\nstartxref\n%d\n%%%%EOF\n" % (len(parts) + 1, more, start)


def fill(folder) -> None:
    """A folder with two good pictures and everything that is none, or too much."""
    good = sample()
    good.save(folder / "a good.jpg")
    good.save(folder / "z good.png")
    data = (folder / "a good.jpg").read_bytes()
    (folder / "half.jpg").write_bytes(data[: len(data) // 2])
    (folder / "head.jpg").write_bytes(data[:20])
    (folder / "empty.jpg").write_bytes(b"")
    (folder / "text.jpg").write_text("Dear teacher, my dog ate the photograph.")
    (folder / "notes.txt").write_text("no picture")
    (folder / "bomb.png").write_bytes(png(60_000, 60_000, bytes(100_000)))
    (folder / "large bomb.png").write_bytes(png(11_000, 10_000, bytes(100_000)))
    (folder / "bomb.tif").write_bytes(tiff(65_000, 65_000))
    (folder / "junk.pdf").write_bytes(b"%PDF-1.7\nnothing of the kind\n" * 9)
    (folder / "locked.pdf").write_bytes(locked_pdf())
    (folder / "bomb.pdf").write_bytes(image_bomb_pdf())
    (folder / "half.heic").write_bytes(heic(good)[:-300])
    Image.fromarray(np.zeros((30, 40), np.float32)).save(folder / "float.tif")
    os.mkfifo(folder / "pipe.jpg")
    (folder / "loop.jpg").symlink_to("loop.jpg")
    (folder / "device.jpg").symlink_to("/dev/zero")
    with (folder / "long.jpg").open("wb") as file:
        file.truncate(300_000_000)


def heic(image) -> bytes:
    """A picture as HEIC."""
    from io import BytesIO

    file = BytesIO()
    pillow_heif.from_pillow(image).save(file)
    return file.getvalue()


def tiff(width, height) -> bytes:
    """A TIFF that says its size and has next to no data."""
    entries = [
        (256, width),
        (257, height),
        (258, 8),
        (259, 1),
        (262, 1),
        (273, 200),
        (277, 1),
        (278, height),
        (279, 50),
    ]
    table = b"".join(struct.pack("<HHII", tag, 4, 1, value) for tag, value in entries)
    head = b"II*\0" + struct.pack("<IH", 8, len(entries)) + table + bytes(4)
    return head + bytes(300 - len(head))


def image_bomb_pdf() -> bytes:
    """A PDF of one page with an image of 60000 x 60000 pixels."""
    stream = zlib.compress(bytes(100_000))
    image = (
        b"<< /Type /XObject /Subtype /Image /Width 60000 /Height 60000 /ColorSpace /DeviceGray /BitsPerComponent 8 "
        b"/Filter /FlateDecode /Length %d >>\nstream\n" % len(stream) + stream + b"\nendstream"
    )
    paint = b"100 0 0 100 0 0 cm /I Do"
    return pdf_of([
        b"<< /Type /Catalog /Pages 2 0 R >>",
        b"<< /Type /Pages /Kids [3 0 R] /Count 1 >>",
        (b"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 100 100] /Contents 4 0 R "
        b"/Resources << /XObject << /I 5 0 R >> >> >>"),
        b"<< /Length %d >>\nstream\n" % len(paint) + paint + b"\nendstream",
        image,
    ])  # fmt: skip
