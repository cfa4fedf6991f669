"""What was read off photographs, kept from run to run: a photograph is read once, whatever it is called."""

from __future__ import annotations

from collections.abc import Generator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from graphcam.errors import TaskError
from graphcam.exercises.course.photo_reports import READINGS_FOLDER
from graphcam.exercises.photographs.read_photo import ReadPhoto, from_json, to_json
from graphcam.file_locks import locked_folder
from graphcam.files import OutputError, whole_folder
from graphcam.words import say

READINGS_FILE = "readings.json"
DIGEST_DIGITS = 32
"""Digits of the digest of a file: no two files of a course share so many."""


@dataclass(frozen=True)
class KeptPhotographs:
    """The photographs of a course that were read.

    folder : of the readings
    basis : tells what they are read with; who gives a photograph again that was read with something else, has it read
        anew
    """

    folder: Path
    basis: str

    def find(self, digest: str) -> list[ReadPhoto] | None:
        """The photographs of a file; None where it is to be read."""
        try:
            photos, basis = self._read_file(self._folder_of(digest))
        except (OSError, TaskError):
            return None
        return photos if basis == self.basis else None

    def keep(self, digest: str, photos: list[ReadPhoto], pictures: Mapping[str, bytes]) -> None:
        """Keep the photographs of a file, and their pictures, by their names.

        Raises
        ------
        OutputError : they cannot be written
        """
        with whole_folder(self._folder_of(digest)) as draft:
            for name, data in pictures.items():
                (draft / name).write_bytes(data)
            (draft / READINGS_FILE).write_text(to_json(photos, self.basis), encoding="utf-8", newline="\n")

    def all_photographs(self) -> list[ReadPhoto]:
        """All photographs, in the order of their names; a reading of another program is left out."""
        found: list[ReadPhoto] = []
        for path in sorted((self.folder / READINGS_FOLDER).glob("*")):
            try:
                photos, _ = self._read_file(path)
            except (OSError, TaskError):
                continue
            found += photos
        return sorted(found, key=lambda photo: (photo.name, photo.digest))

    def picture(self, photo: ReadPhoto, name: str) -> bytes | None:
        """A picture of a photograph as JPEG; None where there is none."""
        if name not in photo.pictures:
            return None
        try:
            return (self._folder_of(photo.digest) / photo.pictures[name].file).read_bytes()
        except OSError:
            return None

    @contextmanager
    def lock(self) -> Generator[None]:
        """Keep other runs out meanwhile: of two that write the same files the slower one would win.

        Raises
        ------
        OutputError : another run is at it, or the folder cannot be made
        """
        place = self.folder / READINGS_FOLDER
        with ExitStack() as stack:
            try:
                place.mkdir(parents=True, exist_ok=True)
                stack.enter_context(locked_folder(place))
            except BlockingIOError:
                why = say("another run reads photographs into it")
                raise OutputError(self.folder, why, say("wait until it ends")) from None
            except OSError as error:
                raise OutputError(self.folder, error.strerror or str(error)) from None
            yield

    def _folder_of(self, digest: str) -> Path:
        """The folder of a file, by its digest or by that of a photograph in it."""
        return self.folder / READINGS_FOLDER / digest[:DIGEST_DIGITS]

    def _read_file(self, path: Path) -> tuple[list[ReadPhoto], str]:
        return from_json((path / READINGS_FILE).read_text(encoding="utf-8"), str(path))
