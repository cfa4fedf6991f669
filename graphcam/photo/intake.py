"""Pictures out of files that strangers made: photographs, scans, whole folders of them; one that cannot be is told.

What a file is, its content tells, not its name.  Its size is looked at before anything is unpacked, and one picture at
a time is in memory.
"""

from __future__ import annotations

import errno
import os
import stat
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

from graphcam.descriptors import READ
from graphcam.photo.images import HEIF_BRANDS, image_pictures
from graphcam.photo.pictures import Photograph
from graphcam.photo.refusal import PhotographError
from graphcam.photo.scans import scanned_pages
from graphcam.words import Words, say

MOST_BYTES = 200_000_000
"""The maximum number of bytes of a file."""
SNIFFED = 1024
"""Bytes in which a file says what it is."""
ENDINGS = frozenset({".jpg", ".jpeg", ".jpe", ".png", ".heic", ".heif", ".tif", ".tiff", ".pdf"})
"""Endings of files in a folder that are reported if they cannot be read; others are passed over."""
FOLDERS_DEEP = 1
"""Folders within a folder that are looked into."""

__all__ = ["Photograph", "Unopened", "pictures_in"]


@dataclass(frozen=True)
class Unopened:
    """A file of which no picture, or not all, could be had.

    name : of the file, as it was given or found
    why, remedy : to tell people
    """

    name: str
    why: Words
    remedy: Words


def pictures_in(paths: Sequence[Path]) -> Iterator[Photograph | Unopened]:
    """The pictures of files and folders, one after another; in a folder by name, and other files are passed over."""
    for path in paths:
        if path.is_dir():
            yield from _folder(path, path.name or str(path), FOLDERS_DEEP)
        else:
            yield from _file(path, path.name, named=True)


def _folder(folder: Path, name: str, deeper: int) -> Iterator[Photograph | Unopened]:
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


def _file(path: Path, name: str, named: bool) -> Iterator[Photograph | Unopened]:
    """The pictures of a file; ``named`` by the user, who wants to hear of every one that is none."""
    told = named or path.suffix.lower() in ENDINGS
    try:
        file = _opened(path)
    except PhotographError as error:
        if told:
            yield Unopened(name, error.why, error.advice)
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
                yield Unopened(name, error.why, error.advice)
                return


def _opened(path: Path) -> BinaryIO:
    """A regular file; nothing is waited for, as a pipe may never end."""
    descriptor = os.open(path, READ)
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise PhotographError(say("it is not a file"), say("send the picture itself"))
        if status.st_size == 0:
            raise PhotographError(say("the file is empty"), say("send it again"))
        if status.st_size > MOST_BYTES:
            most = MOST_BYTES // 1_000_000
            raise PhotographError(
                say("the file is larger than {most} MB", most=most), say("send a JPEG, or fewer pages in a file")
            )
    except BaseException:
        os.close(descriptor)
        raise
    return os.fdopen(descriptor, "rb")


def _pictures(file: BinaryIO, name: str, told: bool) -> Iterator[Photograph | Unopened]:
    try:
        head = file.read(SNIFFED)
        file.seek(0)
        if head.startswith((b"\xff\xd8\xff", b"\x89PNG\r\n\x1a\n", b"II*\0", b"MM\0*")) or head[4:12] in HEIF_BRANDS:
            yield from image_pictures(file, name)
        elif b"%PDF-" in head:
            for page in scanned_pages(file, name):
                yield Unopened(name, page.why, page.advice) if isinstance(page, PhotographError) else page
        elif told:
            raise PhotographError(
                say("it is neither JPEG, PNG, HEIC, TIFF nor PDF"), say("send the photograph as the camera made it")
            )
    except MemoryError:
        raise PhotographError(say("the picture does not fit into memory"), say("send a smaller one")) from None
    except OSError as error:
        raise PhotographError(*_why(error)) from None


def _unopened(name: str, error: OSError) -> Unopened:
    return Unopened(name, *_why(error))


def _why(error: OSError) -> tuple[Words, Words]:
    known: dict[int | None, tuple[Words, Words]] = {
        errno.ENOENT: (say("there is no such file"), say("check the name")),
        errno.EACCES: (say("it may not be read"), say("change its permissions")),
        errno.ELOOP: (say("it is a link that leads back to itself"), say("send the picture itself")),
    }
    return known.get(error.errno, (say("it cannot be read"), say("send it again")))
