"""Python for browsers, as it is found in a folder: Pyodide's files and a NumPy for it, each of a sum that is known.

A page carries these files to everybody who opens it, so none goes into it unchecked: what graphcam was tested with is
known here by its SHA-256, the NumPy of such a release by the list that Pyodide itself keeps, and anything else only by
a file ``SHA256SUMS`` of the user's own.
"""

from __future__ import annotations

import hashlib
import json
import re
import tarfile
from collections.abc import Iterator, Mapping
from pathlib import Path

from graphcam.errors import MissingFileError, TaskError
from graphcam.studio.wasm_archives import numpy_archive
from graphcam.words import bare, either, say

LOADER, GLUE, BINARY = "pyodide.js", "pyodide.asm.js", "pyodide.asm.wasm"
STANDARD_LIBRARY, LOCK = "python_stdlib.zip", "pyodide-lock.json"
CORE = (LOADER, GLUE, BINARY, STANDARD_LIBRARY, LOCK)
"""The files of Pyodide itself."""
NUMPY = "numpy.zip"
"""NumPy as the page carries it."""
KNOWN: Mapping[str, str] = {
    LOADER: "b4cb23a53aba19c221659b9fb40a2f18281d685691dc06647fb0afd0681baf98",
    GLUE: "6b4c90de5b7172873f04f21884d0e9d2274e305fe32116558fe3e4fbe3618d51",
    BINARY: "a50dd1843f805a0b7c45b61037ee0d7b26dfe85efe0e18ef95a34ad24e401f5f",
    STANDARD_LIBRARY: "16611534726e5d8ac2bd8f926410b2dcb8d6f49aa24913463533b457a2115c16",
    LOCK: "9c45b916001a750f4102fc287494f3eab215909c7535c626a20db80fd6333e2c",
    "numpy-2.0.1-py312h4e66579_0.tar.gz": "608a8525a002505e620f9264738a9f95710de52d577276b37ccb881d662be6d6",
}
"""SHA-256 of what graphcam was tested with: npm's pyodide 0.27.7 and @emscripten-forge/numpy 2.0.1."""
PACKING = say("npm pack pyodide@0.27.7 @emscripten-forge/numpy@2.0.1-py312h4e66579-0")
SUMS = "SHA256SUMS"
"""A user's own file of sums, as ``sha256sum`` writes it."""
_A_NUMPY = re.compile(r"numpy-[^-]+-.*\.(whl|tar\.gz)")


def pyodide_parts(folder: Path) -> dict[str, bytes]:
    """The files of :data:`CORE` and :data:`NUMPY`, whole and checked.

    folder : has the files themselves, or the packages of npm that they come in

    Raises
    ------
    TaskError : one is not there, or its sum is not known
    """
    found = dict(_contents(folder))
    for name in CORE:
        if name not in found:
            raise _missing(folder, name)
    own = _own_sums(found)
    for name in CORE:
        _check(folder, name, found[name], {KNOWN[name], own.get(name)})
    lock = json.loads(found[LOCK])
    name = _numpy_for(folder, list(found), lock["info"]["python"])
    listed = lock["packages"].get("numpy", {})
    of_lock = listed.get("sha256") if listed.get("file_name") == name else None
    _check(folder, name, found[name], {KNOWN.get(name), own.get(name), of_lock})
    return {**{core: found[core] for core in CORE}, NUMPY: numpy_archive(name, found[name])}


def _contents(folder: Path) -> Iterator[tuple[str, bytes]]:
    """The files that matter of a folder, and of the packages of npm in it, by their names."""
    if not folder.is_dir():
        raise _missing(folder, LOADER)
    try:
        for path in sorted(folder.iterdir()):
            if path.suffix == ".tgz":
                yield from _packed(path)
            elif _matters(path.name):
                yield path.name, path.read_bytes()
    except (OSError, tarfile.TarError, EOFError) as error:
        broken = say("not readable ({error})", error=str(error))
        what = say("a file there")
        raise TaskError(str(folder), what, broken, say("whole"), say("run there: {packing}", packing=PACKING)) from None


def _packed(package: Path) -> Iterator[tuple[str, bytes]]:
    """The files that matter of one package."""
    with tarfile.open(package) as archive:
        for member in archive:
            name = member.name.rpartition("/")[2]
            if member.isfile() and _matters(name) and (file := archive.extractfile(member)) is not None:
                yield name, file.read()


def _matters(name: str) -> bool:
    return name in CORE or name == SUMS or _A_NUMPY.fullmatch(name) is not None


def _own_sums(found: Mapping[str, bytes]) -> dict[str, str]:
    """The sums that the user states, by the names of the files."""
    lines = (line.split(maxsplit=1) for line in found.get(SUMS, b"").decode(errors="replace").splitlines())
    return {line[1].lstrip("*").strip(): line[0].lower() for line in lines if len(line) == 2}


def _check(folder: Path, name: str, content: bytes, known: set[str | None]) -> None:
    """Check that a file is one that is known."""
    found = hashlib.sha256(content).hexdigest()
    if found not in known:
        trusted = sorted(each for each in known if each)
        sums = either(trusted) if trusted else say("one that is known")
        remedy = say("take the files of '{packing}', or state the sums that you trust in a file {sums} there")
        remedy = remedy.where(packing=PACKING, sums=SUMS)
        raise TaskError(str(folder), say("the SHA-256 of {name}", name=name), found, sums, remedy)


def _numpy_for(folder: Path, names: list[str], python: str) -> str:
    """The one NumPy that is for a version of Python, by its name."""
    tag = "".join(python.split(".")[:2])
    fitting = [name for name in names if _A_NUMPY.fullmatch(name) and re.search(rf"-(cp|py){tag}(?!\d)", name)]
    if not fitting:
        raise MissingFileError(
            "numpy-*.whl or numpy-*.tar.gz",
            say("run there: {packing}", packing=PACKING),
            where=say("for Python {python} in {folder}", python=python, folder=folder),
        )
    if len(fitting) > 1:
        several = bare(", ".join(fitting))
        raise TaskError(str(folder), "NumPy", several, say("one of them alone"), say("remove the others"))
    return fitting[0]


def _missing(folder: Path, name: str) -> TaskError:
    remedy = say("run there: {packing}", packing=PACKING)
    return MissingFileError(name, remedy, where=say("in the folder {folder}", folder=folder))
