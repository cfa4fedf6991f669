"""Pictures from files of unknown origin: photographs, scans, folders of them; what cannot be read is reported.

The kind of a file is found by its content, not its name.  Its size is checked before it is unpacked, and one picture at
a time is in memory.
"""

from __future__ import annotations

import errno
import os
import stat
import struct
import warnings
from collections.abc import Iterator, Sequence
from contextlib import closing
from ctypes import c_float, c_uint
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
import pillow_heif
from PIL import Image, UnidentifiedImageError
from pypdfium2 import PdfDocument, PdfiumError, PdfPage, raw

from graphcam.file_descriptors import READ_FLAGS
from graphcam.photo.pictures import (
    COLOUR_PIXEL_BYTES,
    MAX_KEPT_PIXELS,
    Photograph,
    PhotographError,
    bounded,
    check_size,
    focal_length,
    picture_of,
)
from graphcam.words import Words, say

MAX_BYTES = 200_000_000
"""The maximum number of bytes of a file."""
SIGNATURE_BYTES = 1024
"""The number of bytes in which a file's kind is looked for."""
PICTURE_ENDINGS = frozenset({".jpg", ".jpeg", ".jpe", ".png", ".heic", ".heif", ".tif", ".tiff", ".pdf"})
"""Endings of files in a folder that are reported if they cannot be read; others are passed over."""
MAX_FOLDER_DEPTH = 1
"""The depth of folders within a folder that are searched."""

__all__ = ["Photograph", "UnopenedFile", "pictures_in"]


POINTS_PER_INCH = 72.0
RENDERING_DPI = 300.0
"""The resolution at which a page that is more than one picture is drawn."""
MIN_COVERED_SHARE = 0.9
"""The minimum part of a page that its one picture covers."""
MAX_GROUP_DEPTH = 8
"""The depth of groups within groups in which pictures are looked for."""


def scanned_pages(file: BinaryIO, name: str) -> Iterator[Photograph | PhotographError]:
    """The pages of a PDF in order, each as a photograph or the error that it makes.

    Raises
    ------
    PhotographError : it has no pages
    """
    try:
        document = PdfDocument(file)
    except PdfiumError as error:
        if "password" in str(error).lower():
            raise PhotographError(say("the PDF is locked with a password"), say("save it without one")) from None
        raise PhotographError(say("the PDF is damaged or incomplete"), say("send it again")) from None
    with closing(document):
        count = len(document)
        if not count:
            raise PhotographError(say("the PDF has no pages"), say("send it again"))
        if count > MAX_PAGES:
            raise PhotographError(
                say("the PDF has more than {most} pages", most=MAX_PAGES), say("send fewer pages in a file")
            )
        for number in range(count):
            page_name = name if count == 1 else f"{name}, {number + 1}"
            try:
                yield _picture(document, number, page_name)
            except PhotographError as error:
                yield error
            except PdfiumError:
                yield PhotographError(say("page {number} is damaged", number=number + 1), say("scan it again"))


def _picture(document: PdfDocument, number: int, name: str) -> Photograph:
    with closing(document[number]) as page:
        width, height = page.get_size()
        if not (width > 0 and height > 0):
            raise PhotographError(say("page {number} is empty", number=number + 1), say("scan it again"))
        scale: Any = min(_scale(page, width * height), float(np.sqrt(MAX_KEPT_PIXELS / (width * height))))
        with closing(page.render(scale=scale)) as bitmap:
            pixels = np.asarray(bitmap.to_numpy())
            if pixels.ndim == 2 or pixels.shape[2] == 1:
                pixels = np.repeat(pixels.reshape(*pixels.shape[:2], 1), 3, axis=2)
            return Photograph(name, np.ascontiguousarray(pixels[..., :3], np.uint8))


def _scale(page: PdfPage, area: float) -> float:
    """Pixels per point: those of the page's one picture, or the default.

    Raises
    ------
    PhotographError : a picture in it is too large
    """
    found = [
        _measured(picture.raw) for picture in page.get_objects([raw.FPDF_PAGEOBJ_IMAGE], max_depth=MAX_GROUP_DEPTH)
    ]
    for columns, rows, _ in found:
        check_size(columns, rows, COLOUR_PIXEL_BYTES)
    if len(found) == 1:
        columns, rows, covered = found[0]
        if covered >= MIN_COVERED_SHARE * area:
            return float(np.sqrt(columns * rows / covered))
    return RENDERING_DPI / POINTS_PER_INCH


def _measured(picture: Any) -> tuple[int, int, float]:
    """Columns and rows of a picture in a PDF, and the area of the page that it covers [square points].

    The library's own methods for it are called differently in its versions 4 and 5.
    """
    columns, rows = c_uint(), c_uint()
    left, bottom, right, top = (c_float() for _ in range(4))
    raw.FPDFImageObj_GetImagePixelSize(picture, columns, rows)
    raw.FPDFPageObj_GetBounds(picture, left, bottom, right, top)
    return columns.value, rows.value, (right.value - left.value) * (top.value - bottom.value)


@dataclass(frozen=True)
class UnopenedFile:
    """A file of which no picture, or not all, could be read.

    name : of the file, as it was given or found
    why, remedy : for the user
    """

    name: str
    why: Words
    remedy: Words


def pictures_in(paths: Sequence[Path]) -> Iterator[Photograph | UnopenedFile]:
    """The pictures of files and folders, in order; in a folder by name, and files of other kinds are passed over."""
    for path in paths:
        if path.is_dir():
            yield from _folder(path, path.name or str(path), MAX_FOLDER_DEPTH)
        else:
            yield from _file(path, path.name, named=True)


def _folder(folder: Path, name: str, deeper: int) -> Iterator[Photograph | UnopenedFile]:
    try:
        entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
    except OSError as error:
        yield _unopened(name, error)
        return
    for entry in entries:
        if entry.name.startswith("."):
            continue
        within = f"{name}/{entry.name}"
        if entry.is_dir(follow_symlinks=False):
            if deeper:
                yield from _folder(Path(entry.path), within, deeper - 1)
        else:
            yield from _file(Path(entry.path), within, named=False)


def _file(path: Path, name: str, named: bool) -> Iterator[Photograph | UnopenedFile]:
    """The pictures of a file, and errors; errors of every kind only if the user ``named`` the file."""
    told = named or path.suffix.lower() in PICTURE_ENDINGS
    try:
        file = _opened_file(path)
    except PhotographError as error:
        if told:
            yield UnopenedFile(name, error.why, error.advice)
        return
    except OSError as error:
        if told:
            yield _unopened(name, error)
        return
    with file:
        pictures = _pictures(file, name, told)
        while True:
            try:
                yield next(pictures)
            except StopIteration:
                return
            except PhotographError as error:
                yield UnopenedFile(name, error.why, error.advice)
                return


def _opened_file(path: Path) -> BinaryIO:
    """A regular file, open for reading; others are refused without waiting, as a pipe may never end."""
    descriptor = os.open(path, READ_FLAGS)
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise PhotographError(say("it is not a file"), say("send the picture itself"))
        if status.st_size == 0:
            raise PhotographError(say("the file is empty"), say("send it again"))
        if status.st_size > MAX_BYTES:
            most = MAX_BYTES // 1_000_000
            raise PhotographError(
                say("the file is larger than {most} MB", most=most), say("send a JPEG, or fewer pages in a file")
            )
    except BaseException:
        os.close(descriptor)
        raise
    return os.fdopen(descriptor, "rb")


def _pictures(file: BinaryIO, name: str, told: bool) -> Iterator[Photograph | UnopenedFile]:
    try:
        head = file.read(SIGNATURE_BYTES)
        file.seek(0)
        if head.startswith((b"\xff\xd8\xff", b"\x89PNG\r\n\x1a\n", b"II*\0", b"MM\0*")) or head[4:12] in HEIF_BRANDS:
            yield from image_pictures(file, name)
        elif b"%PDF-" in head:
            for page in scanned_pages(file, name):
                yield UnopenedFile(name, page.why, page.advice) if isinstance(page, PhotographError) else page
        elif told:
            raise PhotographError(
                say("it is neither JPEG, PNG, HEIC, TIFF nor PDF"), say("send the photograph as the camera made it")
            )
    except MemoryError:
        raise PhotographError(say("the picture does not fit into memory"), say("send a smaller one")) from None
    except OSError as error:
        raise PhotographError(*_open_error_words(error)) from None


def _unopened(name: str, error: OSError) -> UnopenedFile:
    return UnopenedFile(name, *_open_error_words(error))


def _open_error_words(error: OSError) -> tuple[Words, Words]:
    known: dict[int | None, tuple[Words, Words]] = {
        errno.ENOENT: (say("there is no such file"), say("check the name")),
        errno.EACCES: (say("it may not be read"), say("change its permissions")),
        errno.ELOOP: (say("it is a link that leads back to itself"), say("send the picture itself")),
    }
    return known.get(error.errno, (say("it cannot be read"), say("send it again")))


PILLOW_FORMATS = ("JPEG", "PNG", "TIFF")
"""The formats for which Pillow is used; fewer readers leave a hostile file fewer ways in."""
HEIF_BRANDS = tuple(b"ftyp" + brand for brand in (b"heic", b"heix", b"hevc", b"heim", b"heis", b"mif1", b"msf1"))
"""The beginnings of a HEIC file, after its first four bytes."""
MAX_PAGES = 500
"""The maximum number of pages of a file."""
HEIC_PIXEL_BYTES = 6
"""The number of bytes per pixel that a HEIC needs while it is unpacked."""
FILE_ERRORS = (OSError, SyntaxError, ValueError, TypeError, KeyError, IndexError, OverflowError, EOFError, struct.error)
"""The exceptions that Pillow's readers raise for broken files."""


def image_pictures(file: BinaryIO, name: str) -> Iterator[Photograph]:
    """The pictures of a file, those of a TIFF with many pages in order.

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
        with _image_of(file) as image:
            yield _page(image, name)
            if image.format != "TIFF":
                return
            for number in range(1, MAX_PAGES):
                if not _turn_to_page(image, number):
                    return
                yield _page(image, f"{name}, {number + 1}")


def _image_of(file: BinaryIO) -> Image.Image:
    try:
        return Image.open(file, formats=PILLOW_FORMATS)
    except Image.DecompressionBombError:
        raise PhotographError(
            say("the picture is too large"), say("send it with 12 megapixels, or scan it at 300 dpi")
        ) from None
    except (UnidentifiedImageError, *FILE_ERRORS):
        raise _broken_file_error() from None


def _page(image: Image.Image, name: str) -> Photograph:
    try:
        return picture_of(image, name)
    except Image.DecompressionBombError:
        check_size(*image.size)
        raise _broken_file_error() from None
    except FILE_ERRORS:
        raise _broken_file_error() from None


def _turn_to_page(image: Image.Image, page: int) -> bool:
    try:
        image.seek(page)
    except EOFError:
        return False
    except (Image.DecompressionBombError, *FILE_ERRORS):
        raise _broken_file_error() from None
    return True


def _heif(file: BinaryIO, name: str) -> Photograph:
    try:
        image = pillow_heif.open_heif(file, convert_hdr_to_8bit=True)
        check_size(*image.size, HEIC_PIXEL_BYTES)
        exif = Image.Exif()
        said = image.info.get("exif")
        if isinstance(said, bytes):
            exif.load(said)
        size = image.size
        pixels = np.asarray(image)
    except (RuntimeError, *FILE_ERRORS):
        raise _broken_file_error() from None
    # The file's own turns have been made, and what EXIF says of them has been heeded.
    grey = pixels.ndim == 2 or pixels.shape[2] < 3
    colours = pixels.reshape(*pixels.shape[:2], -1)[..., 0] if grey else pixels[..., :3]
    return bounded(np.ascontiguousarray(colours), name, focal_length(exif, size), max(size))


def _broken_file_error() -> PhotographError:
    return PhotographError(say("the file is damaged or incomplete"), say("send it again"))
