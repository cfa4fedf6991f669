"""Files of photographs: each is read once, by a worker, and what was read is kept at once.

It needs the libraries of the extra ``photo``, and is loaded by who reads photographs only.
"""

from __future__ import annotations

import hashlib
import os
import stat
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

import cv2

from graphcam.exercises.definition.exercise import Exercise
from graphcam.exercises.photographs.page_owner import PrintedSheets
from graphcam.exercises.photographs.photo_reader import read_halves, read_photograph
from graphcam.exercises.photographs.photograph_store import DIGEST_DIGITS, KeptPhotographs
from graphcam.exercises.photographs.read_photo import ReadPhoto
from graphcam.exercises.photographs.reading_limits import OPENED_WITHIN, READ_WITHIN, Allow, limited
from graphcam.file_descriptors import READ_FLAGS
from graphcam.files import OutputError
from graphcam.photo.file_intake import MAX_BYTES, MAX_FOLDER_DEPTH, PICTURE_ENDINGS, UnopenedFile, pictures_in
from graphcam.photo.pictures import Photograph, PhotographError
from graphcam.photo.printed_page import SIDE_NAMES, Side
from graphcam.words import say

CHUNK_BYTES = 1 << 20
"""Bytes of a file that are looked at together."""


@dataclass(frozen=True)
class ReadingJob:
    """What all photographs of a course have in common; it travels to the workers."""

    exercise: Exercise
    sheets: PrintedSheets
    kept: KeptPhotographs


@dataclass(frozen=True)
class PhotoFile:
    """A file that may hold photographs.

    name : as it is told;  named : whether the user named it, and wants to hear that it holds none
    """

    path: Path
    name: str
    named: bool

    @property
    def is_reported(self) -> bool:
        """Whether somebody wants to hear that it holds no photograph."""
        return self.named or self.path.suffix.lower() in PICTURE_ENDINGS


def read_file(job: ReadingJob, file: PhotoFile) -> list[ReadPhoto]:
    """Read the photographs in a file and keep what was read; those that are not kept are given back, with the reason.

    It does not raise: one photograph that none foresaw is told like any other that cannot be read.  Past its limits of
    time and memory it ends the process, a worker's.
    """
    return _guarded(job, file.name, lambda allow: _read_file(job, file, allow))


def _guarded(job: ReadingJob, name: str, read: Callable[[Allow], list[ReadPhoto]]) -> list[ReadPhoto]:
    """What a reading gives back, or why it came to nothing."""
    try:
        # Other workers have the other cores.
        cv2.setNumThreads(1)
        with limited() as allow:
            return read(allow)
    except OutputError as error:
        why, remedy = say("the reading cannot be saved ({error})", error=error.why), error.advice
    except Exception as error:  # noqa: BLE001  # one photograph never stops the others
        why = say("it cannot be read ({error})", error=f"{type(error).__name__}: {error}"[:200])
        remedy = say("photograph the sheet again, and save it as JPEG")
    return [ReadPhoto(name, "", why=job.exercise.tell(why), remedy=job.exercise.tell(remedy))]


def _read_file(job: ReadingJob, file: PhotoFile, allow: Allow) -> list[ReadPhoto]:
    digest = digest_of(file.path)
    if digest and job.kept.find(digest) is not None:
        return []
    photos: list[ReadPhoto] = []
    unread: list[ReadPhoto] = []
    pictures: dict[str, bytes] = {}
    tell = job.exercise.tell
    for number, found in enumerate(_in_time(pictures_in([file.path]), allow)):
        name = file.name + found.name.removeprefix(file.path.name)
        if isinstance(found, UnopenedFile):
            unread.append(ReadPhoto(name, "", why=tell(found.why), remedy=tell(found.remedy)))
        else:
            picture = replace(found, name=name)
            photo, shown = read_photograph(job.sheets, job.exercise, picture, f"{digest}-{number}", f"{number}-")
            photos.append(photo)
            pictures |= shown
    # Of a scan that is broken in its middle what comes before counts.
    if photos:
        job.kept.keep(digest, photos, pictures)
    return unread if file.is_reported else []


def _in_time(found: Iterator[Photograph | UnopenedFile], allow: Allow) -> Iterator[Photograph | UnopenedFile]:
    """The pictures of a file, each unpacked, and then read, within its time."""
    allow(OPENED_WITHIN)
    for one in found:
        allow(READ_WITHIN)
        yield one
        allow(OPENED_WITHIN)


@dataclass(frozen=True)
class Halves:
    """Photographs of the two sheets of a page, each in a file.

    name : of both, as they are told;  digest : of both together
    left, right : the file, and the number of the picture in it
    """

    name: str
    digest: str
    left: tuple[Path, int]
    right: tuple[Path, int]


def read_halves_of(job: ReadingJob, halves: Halves) -> list[ReadPhoto]:
    """Read a page off photographs of its two sheets and keep what was read; it does not raise, as :func:`read_file`."""
    return _guarded(job, halves.name, lambda allow: _read_halves(job, halves, allow))


def _read_halves(job: ReadingJob, halves: Halves, allow: Allow) -> list[ReadPhoto]:
    of = {"left": halves.left, "right": halves.right}
    photographs: dict[Side, Photograph] = {side: _picture(*of[side], allow) for side in SIDE_NAMES}
    photo, shown = read_halves(job.sheets, job.exercise, photographs, f"{halves.digest}-0", "0-")
    job.kept.keep(halves.digest, [replace(photo, name=halves.name)], shown)
    return []


def _picture(path: Path, number: int, allow: Allow) -> Photograph:
    found = next(islice(_in_time(pictures_in([path]), allow), number, None))
    if isinstance(found, UnopenedFile):
        raise PhotographError(found.why, found.remedy)
    return found


def halves_in(photos: Iterable[ReadPhoto], files: Iterable[PhotoFile], kept: KeptPhotographs) -> Iterator[Halves]:
    """The pages on two sheets of which both are photographed, and that are not read yet.

    files : that are at hand: what was kept of a half is not its picture
    """
    best: dict[tuple[str, int], dict[str, ReadPhoto]] = {}
    for photo in sorted(photos, key=lambda one: -one.residual):
        if photo.half and not photo.why:
            best.setdefault((photo.student, photo.page), {})[photo.half] = photo
    pairs = [(sides["left"], sides["right"]) for sides in best.values() if len(sides) == len(SIDE_NAMES)]
    paths = {digest_of(file.path): file.path for file in files} if pairs else {}
    for pair in pairs:
        digest = hashlib.sha256(" ".join(photo.digest for photo in pair).encode()).hexdigest()[:DIGEST_DIGITS]
        places = [photo.digest.split("-") for photo in pair]
        if kept.find(digest) is None and all(of in paths for of, _ in places):
            left, right = ((paths[of], int(number)) for of, number in places)
            yield Halves(" + ".join(photo.name for photo in pair), digest, left, right)


def digest_of(path: Path) -> str:
    """Tells a file from all others, whatever it is called; empty of what is no file, or too large to be read."""
    try:
        descriptor = os.open(path, READ_FLAGS)
    except OSError:
        return ""
    try:
        status = os.fstat(descriptor)
        if not stat.S_ISREG(status.st_mode) or status.st_size > MAX_BYTES:
            return ""
        digest = hashlib.sha256()
        while part := os.read(descriptor, CHUNK_BYTES):
            digest.update(part)
        return digest.hexdigest()[:DIGEST_DIGITS]
    except OSError:
        return ""
    finally:
        os.close(descriptor)


def files_in(paths: Iterable[Path]) -> Iterator[PhotoFile]:
    """The files that are named, and those in the folders that are: sorted, and one folder deeper too."""
    for path in paths:
        if path.is_dir():
            yield from _files(path, path.name or str(path), MAX_FOLDER_DEPTH)
        else:
            yield PhotoFile(path, path.name, named=True)


def _files(folder: Path, name: str, deeper: int) -> Iterator[PhotoFile]:
    try:
        paths = sorted(folder.iterdir())
    except OSError:
        # Who reads it says why it cannot be.
        yield PhotoFile(folder, name, named=True)
        return
    for path in paths:
        if path.name.startswith("."):
            continue
        within = f"{name}/{path.name}"
        if not path.is_dir() or path.is_symlink():
            yield PhotoFile(path, within, named=False)
        elif deeper:
            yield from _files(path, within, deeper - 1)
