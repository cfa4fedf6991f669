"""Photographs and scans that are pictures already: JPEG, PNG, TIFF of one page or many, HEIC."""

from __future__ import annotations

import struct
import warnings
from collections.abc import Iterator
from typing import BinaryIO

import numpy as np
import pillow_heif
from PIL import Image, UnidentifiedImageError

from graphcam.photo.pictures import Photograph, bounded, check_size, focal_length, picture_of
from graphcam.photo.refusal import PhotographError
from graphcam.words import say

FORMATS = ("JPEG", "PNG", "TIFF")
"""The formats that Pillow is to read; the fewer its readers, the fewer doors for a hostile file."""
HEIF_BRANDS = tuple(b"ftyp" + brand for brand in (b"heic", b"heix", b"hevc", b"heim", b"heis", b"mif1", b"msf1"))
"""The brands with which a HEIC file begins, after four bytes."""
MOST_PAGES = 500
"""The maximum number of pages of a file."""
UNPACKED_AT_ONCE = 6
"""Bytes a pixel that a HEIC takes while it is unpacked."""
BROKEN = (OSError, SyntaxError, ValueError, TypeError, KeyError, IndexError, OverflowError, EOFError, struct.error)
"""What Pillow raises for broken files, all of it seen in its readers."""


def image_pictures(file: BinaryIO, name: str) -> Iterator[Photograph]:
    """The pictures of a file, of a TIFF's many pages one after another.

    Raises
    ------
    PhotographError : it is broken, or too large
    """
    if file.read(12)[4:12] in HEIF_BRANDS:
        file.seek(0)
        yield _heif(file, name)
        return
    file.seek(0)
    with warnings.catch_warnings():
        # Sizes are looked at here, and strange tags are no matter.
        warnings.simplefilter("ignore")
        with _opened(file) as image:
            yield _page(image, name)
            if image.format != "TIFF":
                return
            for number in range(1, MOST_PAGES):
                if not _turned_to(image, number):
                    return
                yield _page(image, f"{name}, {number + 1}")


def _opened(file: BinaryIO) -> Image.Image:
    try:
        return Image.open(file, formats=FORMATS)
    except Image.DecompressionBombError:
        raise PhotographError(
            say("the picture is too large"), say("send it with 12 megapixels, or scan it at 300 dpi")
        ) from None
    except (UnidentifiedImageError, *BROKEN):
        raise _broken() from None


def _page(image: Image.Image, name: str) -> Photograph:
    try:
        return picture_of(image, name)
    except Image.DecompressionBombError:
        check_size(*image.size)
        raise _broken() from None
    except BROKEN:
        raise _broken() from None


def _turned_to(image: Image.Image, page: int) -> bool:
    try:
        image.seek(page)
    except EOFError:
        return False
    except (Image.DecompressionBombError, *BROKEN):
        raise _broken() from None
    return True


def _heif(file: BinaryIO, name: str) -> Photograph:
    try:
        image = pillow_heif.open_heif(file, convert_hdr_to_8bit=True)
        check_size(*image.size, UNPACKED_AT_ONCE)
        exif = Image.Exif()
        said = image.info.get("exif")
        if isinstance(said, bytes):
            exif.load(said)
        size = image.size
        pixels = np.asarray(image)
    except (RuntimeError, *BROKEN):
        raise _broken() from None
    # The file's own turns have been made, and what EXIF says of them has been heeded.
    grey = pixels.ndim == 2 or pixels.shape[2] < 3
    colours = pixels.reshape(*pixels.shape[:2], -1)[..., 0] if grey else pixels[..., :3]
    return bounded(np.ascontiguousarray(colours), name, focal_length(exif, size), max(size))


def _broken() -> PhotographError:
    return PhotographError(say("the file is damaged or incomplete"), say("send it again"))
