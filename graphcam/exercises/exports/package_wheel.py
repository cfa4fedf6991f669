"""graphcam itself as a wheel, made of its installed files: what a grading machine installs is what made the variants.

A wheel is a zip with the package and a folder of metadata; see the binary distribution format of the Python Packaging
User Guide.  Nothing is built or downloaded.
"""

import base64
import hashlib
from collections.abc import Iterator
from importlib import metadata, resources
from pathlib import Path, PurePosixPath

from graphcam.errors import TaskError
from graphcam.exercises.definition.exercise_file import exercise_path, library
from graphcam.exercises.exports.repeatable_zip import write_zip
from graphcam.words import say

PACKAGE = "graphcam"
LIBRARY = f"{PACKAGE}/exercises/library"
"""The place of the exercises in an installed package; in a checkout they stand at the top level."""
TAG = "py3-none-any"
SAYS = f"Wheel-Version: 1.0\nGenerator: {PACKAGE}\nRoot-Is-Purelib: true\nTag: {TAG}\n"


def write_wheel(folder: Path) -> Path:
    """Write the wheel into a folder; its path.

    Raises
    ------
    TaskError : graphcam is run from a folder and not installed, so its dependencies are not known
    """
    try:
        distribution = metadata.distribution(PACKAGE)
    except metadata.PackageNotFoundError:
        remedy = say("install it with pip, a checkout with 'pip install -e .'")
        raise TaskError(PACKAGE, say("the package"), say("not installed"), say("installed"), remedy) from None
    about = f"{PACKAGE}-{distribution.version}.dist-info"
    held = dict(_package()) | dict(_about(distribution, about))
    record = [f"{name},sha256={_digest(data)},{len(data)}" for name, data in held.items()]
    held[f"{about}/RECORD"] = "\n".join([*record, f"{about}/RECORD,,", ""]).encode()
    wheel = folder / f"{PACKAGE}-{distribution.version}-{TAG}.whl"
    write_zip(wheel, held)
    return wheel


def _package() -> Iterator[tuple[str, bytes]]:
    """The files of the package by their names in the wheel, the exercises among them."""
    root = Path(str(resources.files(PACKAGE)))
    for path in sorted(root.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts:
            yield str(PurePosixPath(PACKAGE, *path.relative_to(root).parts)), path.read_bytes()
    for name in library():
        yield f"{LIBRARY}/{name}.toml", exercise_path(name).read_bytes()


def _about(distribution: metadata.Distribution, folder: str) -> Iterator[tuple[str, bytes]]:
    """The files of the folder of metadata: dependencies, commands and licences, as they were installed."""
    yield f"{folder}/WHEEL", SAYS.encode()
    for name in ("METADATA", "entry_points.txt"):
        if text := distribution.read_text(name):
            yield f"{folder}/{name}", text.encode()
    for path in distribution.files or ():
        if path.parts[0] == folder and "licenses" in path.parts:
            yield path.as_posix(), path.read_binary()


def _digest(data: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
