"""Archives for Python in a browser: NumPy without what nobody runs there, and the engine with all that it imports.

They are not compressed: what carries them compresses the whole, which is smaller and is unpacked faster.
"""

from __future__ import annotations

import io
import tarfile
import zipfile
from collections.abc import Iterator, Mapping
from importlib.metadata import distribution
from importlib.resources import files
from pathlib import Path, PurePosixPath

UNUSED_FOLDERS = frozenset({"tests", "testing", "fft", "f2py", "include", "_examples", "_pyinstaller", "pkgconfig"})
UNUSED_ENDINGS = (".pyi", ".pxd", ".pyx", ".h", ".c", ".a", "RECORD")
"""Endings of NumPy's files for tests, compilers, type checkers or installers, and transforms that no drawing needs."""
ABOVE = frozenset({"__main__.py", "cli", "exercises", "notebooks", "bench", "plots"})
"""The rooms of graphcam that the studio stands below, so that its engine cannot import them."""
KEPT = frozenset({".py", ".pyi", ".json", ".po", ".toml", ".csv"})
"""Kinds of files of graphcam that the engine reads; pages, scripts and fonts are not for it."""
LIBRARIES = ("lazy_loader", "tomli_w", "typing_extensions")
"""What the engine imports besides NumPy."""
LONG_AGO = (1980, 1, 1, 0, 0, 0)
"""The date of every file in an archive, so that the same files always make the same archive."""


def stored_zip(contents: Mapping[str, bytes]) -> bytes:
    """A zip of files by their names, in their order, not compressed.

    >>> stored_zip({"a.txt": b"a"}) == stored_zip({"a.txt": b"a"})
    True
    """
    written = io.BytesIO()
    with zipfile.ZipFile(written, "w", zipfile.ZIP_STORED) as archive:
        for name in sorted(contents):
            archive.writestr(zipfile.ZipInfo(name, LONG_AGO), contents[name])
    return written.getvalue()


def numpy_archive(name: str, content: bytes) -> bytes:
    """What a browser needs of a NumPy, its licences among it.

    name, content : a wheel, or a package of conda for Emscripten
    """
    packed = _of_wheel(content) if name.endswith(".whl") else _of_conda(content)
    return stored_zip({path: file for path, file in packed if _is_used(PurePosixPath(path))})


def _is_used(path: PurePosixPath) -> bool:
    return not (UNUSED_FOLDERS & set(path.parts[:-1]) or path.name.endswith(UNUSED_ENDINGS))


def _of_wheel(content: bytes) -> Iterator[tuple[str, bytes]]:
    """The files of a wheel."""
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        for name in archive.namelist():
            if not name.endswith("/"):
                yield name, archive.read(name)


def _of_conda(content: bytes) -> Iterator[tuple[str, bytes]]:
    """The files of a package of conda, by their places below the folder of Python's packages."""
    with tarfile.open(fileobj=io.BytesIO(content)) as archive:
        for member in archive:
            _, there, path = member.name.partition("/site-packages/")
            if there and member.isfile() and (file := archive.extractfile(member)) is not None:
                yield path, file.read()


def engine_archive() -> bytes:
    """The engine of the studio, and what it imports but NumPy."""
    contents = dict(_of_graphcam())
    for library in LIBRARIES:
        contents |= _of_library(library)
    return stored_zip(contents)


def _of_graphcam() -> Iterator[tuple[str, bytes]]:
    """The files of graphcam that the engine reads."""
    package = Path(str(files("graphcam")))
    for path in package.rglob("*"):
        inside = path.relative_to(package)
        if inside.parts[0] not in ABOVE and path.suffix in KEPT and path.is_file():
            yield f"graphcam/{inside.as_posix()}", path.read_bytes()


def _of_library(name: str) -> dict[str, bytes]:
    """The modules of an installed library, and its licence."""
    kept = (path for path in distribution(name).files or () if path.suffix == ".py" or "LICEN" in path.name)
    return {path.as_posix(): path.read_binary() for path in kept}
