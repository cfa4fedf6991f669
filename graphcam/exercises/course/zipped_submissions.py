"""A zip of all submissions, as a learning system gives it: unpacked aside, nothing but what can hold answers."""

import io
import stat
import struct
import zipfile
import zlib
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory

from graphcam.drafting.ink import Caption, say
from graphcam.errors import TaskError
from graphcam.exercises.course.submissions import Refused
from graphcam.exercises.reading.regular_file import read_regular
from graphcam.exercises.reading.submission_files import BYTE_LIMITS

MAX_ENTRIES = 100_000
MAX_BYTES = 4_000_000_000
"""The maximum size of all files together, unpacked; a bomb says less of itself and is stopped all the same."""
MAX_FILE_BYTES = max(BYTE_LIMITS.values())
MAX_DEPTH = 4
"""Parts of a path: a student's folder, the assignment in it, the file, and one more."""
FILE_ENDINGS = (*(Path(name).suffix for name in BYTE_LIMITS), ".txt", ".zip")
"""Endings of files that can hold answers, or tell about an attempt; of others there is no more than the name."""
MAX_STUDENT_ENTRIES, MAX_STUDENT_BYTES = 1_000, 100_000_000
"""The maximum numbers of entries and bytes of a zip that a single student handed in."""


@contextmanager
def unpacked(place: Path) -> Generator[tuple[Path, list[Refused]]]:
    """A folder of submissions: the place itself, or what is packed in it; and the entries that are not taken.

    Raises
    ------
    TaskError : it is no zip that can be read, or one that grows beyond all bounds
    """
    if place.is_dir():
        yield place, []
        return
    with TemporaryDirectory(prefix="graphcam-") as scratch:
        try:
            with zipfile.ZipFile(place) as archive:
                refused = _unpack(archive, place, Path(scratch), MAX_ENTRIES, MAX_BYTES)
        except (OSError, zipfile.BadZipFile) as error:
            what, found = say("the zip"), say("not readable ({error})", error=str(error))
            raise TaskError(str(place), what, found, say("a whole zip file"), say("download it again")) from None
        yield Path(scratch), refused


def unpack_one(path: Path, folder: Path) -> None:
    """Unpack a zip that a student handed in into a folder; what is not safe is left out.

    Raises
    ------
    UnreadableError : it is no file of bounded size
    TaskError : it is no zip that can be read, or one that grows beyond all bounds
    """
    data = read_regular(path, MAX_FILE_BYTES)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            _unpack(archive, path, folder, MAX_STUDENT_ENTRIES, MAX_STUDENT_BYTES)
    # What zipfile makes of bytes that somebody chose.
    except (OSError, zipfile.BadZipFile, NotImplementedError, EOFError, ValueError, struct.error) as error:
        found = say("not readable ({error})", error=str(error))
        raise TaskError(str(path), say("the zip"), found, say("a whole zip file"), say("hand it in again")) from None


def _unpack(archive: zipfile.ZipFile, place: Path, folder: Path, most: int, most_bytes: int) -> list[Refused]:
    """The entries that are not taken; the others lie in the folder.

    most, most_bytes : entries, and bytes of all that is unpacked
    """
    entries = archive.infolist()
    if len(entries) > most:
        what = say("the number of entries")
        raise TaskError(str(place), what, len(entries), say("at most {most}", most=most), say("unpack it"))
    refused: list[Refused] = []
    left = most_bytes
    for entry in entries:
        path = PurePosixPath(entry.filename)
        if why := _unsafe(entry, path):
            refused.append(Refused(entry.filename, why))
            continue
        if "__MACOSX" in path.parts:
            continue
        is_read = not entry.is_dir() and path.suffix.strip().lower() in FILE_ENDINGS
        # Counted before it is unpacked: the same bytes may stand there under many names, or fail their check.
        left -= min(entry.file_size, MAX_FILE_BYTES + 1) if is_read else 0
        if left < 0:
            expected = say("at most {most_bytes} bytes unpacked", most_bytes=most_bytes)
            raise TaskError(str(place), say("the size"), say("larger"), expected, say("look into it by hand"))
        try:
            (folder / (path if entry.is_dir() else path.parent)).mkdir(parents=True, exist_ok=True)
            if is_read:
                _write(archive, entry, folder / path)
            elif not entry.is_dir():
                (folder / path).touch()
        # What zlib and the checks of the archive say; a name that is too long, or twice there.
        except (OSError, zipfile.BadZipFile, NotImplementedError, EOFError, ValueError, zlib.error):
            refused.append(Refused(entry.filename, say("it cannot be unpacked")))
    return refused


def _unsafe(entry: zipfile.ZipInfo, path: PurePosixPath) -> Caption | None:
    """The reason why an entry is not unpacked: it would lie elsewhere, or it is no file."""
    if path.is_absolute() or ".." in path.parts or "\\" in entry.filename or not path.parts:
        return say("its path leads out of the folder")
    if len(path.parts) > MAX_DEPTH:
        return say("it lies too deep")
    kind = stat.S_IFMT(entry.external_attr >> 16)
    if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
        return say("it is a link or a device, not a file")
    return say("it is encrypted") if entry.flag_bits & 1 else None


def _write(archive: zipfile.ZipFile, entry: zipfile.ZipInfo, path: Path) -> None:
    """Write a file; of one that is too long one byte more than is read, so that it is told."""
    with archive.open(entry) as packed:
        data = packed.read(MAX_FILE_BYTES + 1)
    with path.open("xb") as file:
        file.write(data)
