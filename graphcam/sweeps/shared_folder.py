"""A folder that several machines share, on a disk or in object storage: its files are there whole or not at all."""

import hashlib
import io
from collections.abc import Generator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any
from uuid import uuid4

from graphcam.errors import installed
from graphcam.files import OutputError


@dataclass(frozen=True)
class SharedFolder:
    """A folder by its address, which holds on every machine that reaches the storage."""

    url: str

    @staticmethod
    def open_folder(folder: str) -> "SharedFolder":
        """The folder, made where it is not there yet.

        Raises
        ------
        OutputError : it cannot be reached or made
        TaskError : there is no fsspec

        >>> SharedFolder.open_folder("memory://results").sizes()
        {}
        """
        with installed("--out", "fsspec", "parquet"):
            from fsspec.core import url_to_fs
        try:
            system, path = url_to_fs(folder)
            system.makedirs(path, exist_ok=True)
            system.ls(path)
        except Exception as error:  # noqa: BLE001  every kind of storage fails in its own way
            raise OutputError(folder, " ".join(str(error).split()) or type(error).__name__) from None
        return SharedFolder(system.unstrip_protocol(path))

    def _file_system(self) -> tuple[Any, str]:
        from fsspec.core import url_to_fs

        system, path = url_to_fs(self.url)
        # Other machines write there too: what was listed before does not count.
        system.invalidate_cache()
        return system, path

    def sizes(self) -> dict[str, int]:
        """The names of the files in it and their sizes [bytes]."""
        system, path = self._file_system()
        found = system.ls(path, detail=True)
        return {entry["name"].rstrip("/").rpartition("/")[2]: entry["size"] or 0 for entry in found}

    def read(self, name: str) -> bytes:
        """The content of a file."""
        system, path = self._file_system()
        return system.cat_file(f"{path}/{name}")

    @contextmanager
    def open_for_writing(self, name: str) -> Generator[Any]:
        """A file to be written that takes its name when it is closed.

        Until then it has a name that readers of data sets pass over, and that nobody else writes.
        """
        system, path = self._file_system()
        draft = f"{path}/.{name}.{uuid4().hex}"
        try:
            with system.open(draft, "wb") as file:
                yield file
            system.mv(draft, f"{path}/{name}")
        except BaseException:
            with suppress(Exception):
                system.rm_file(draft)
            raise

    def clear_drafts(self) -> None:
        """Remove what workers that died had begun."""
        system, path = self._file_system()
        for name in self.sizes():
            if name.startswith("."):
                system.rm_file(f"{path}/{name}")


class SealedFile(io.RawIOBase):
    """A file that is written, with its size and its checksum."""

    def __init__(self, file: Any) -> None:
        self._file, self._size, self._sum = file, 0, hashlib.sha256()

    def writable(self) -> bool:
        """Whether the file can be written: it can."""
        return True

    def tell(self) -> int:
        """How much is written."""
        return self._size

    def write(self, data: Any) -> int:
        """Pass the data on."""
        self._sum.update(data)
        self._file.write(data)
        written = memoryview(data).nbytes
        self._size += written
        return written

    def record(self) -> dict[str, Any]:
        """Size and checksum of what was written."""
        return {"bytes": self._size, "sha256": self._sum.hexdigest()}
