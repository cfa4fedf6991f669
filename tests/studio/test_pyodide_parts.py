"""The parts of Pyodide: found loose and packed, and none that is not known goes into a page."""

from __future__ import annotations

import hashlib
import io
import json
import re
import tarfile
import zipfile
from pathlib import Path

import pytest

from graphcam.errors import TaskError
from graphcam.studio import pyodide_parts as parts
from graphcam.studio.pyodide_parts import stored_zip

CONDA, WHEEL = "numpy-2.0.1-py312h4e66579_0.tar.gz", "numpy-2.0.2-cp312-cp312-pyodide_2024_0_wasm32.whl"
PYTHON_FILES = {
    "numpy/__init__.py": b"", "numpy/_core/tests/test_array.py": b"", "numpy/_core/include/array.h": b"",
    "numpy/__init__.pyi": b"", "numpy-2.dist-info/LICENSE.txt": b"BSD",
}  # fmt: skip


def sum_of(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def tar_of(contents: dict[str, bytes]) -> bytes:
    written = io.BytesIO()
    with tarfile.open(fileobj=written, mode="w:gz") as archive:
        for name, content in contents.items():
            member = tarfile.TarInfo(name)
            member.size = len(content)
            archive.addfile(member, io.BytesIO(content))
    return written.getvalue()


NUMPIES = {
    CONDA: tar_of({f"lib/python3.12/site-packages/{name}": content for name, content in PYTHON_FILES.items()}),
    WHEEL: stored_zip(PYTHON_FILES),
}
LISTED = {"file_name": WHEEL, "sha256": sum_of(NUMPIES[WHEEL])}
CORE = {name: name.encode() for name in parts.CORE_FILES} | {
    parts.LOCK_FILE: json.dumps({"info": {"python": "3.12.7"}, "packages": {"numpy": LISTED}}).encode()
}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """Loose files of known sums, and no NumPy yet."""
    monkeypatch.setattr(parts, "KNOWN_SUMS", {name: sum_of(content) for name, content in {**CORE, **NUMPIES}.items()})
    for name, content in CORE.items():
        (tmp_path / name).write_bytes(content)
    return tmp_path


@pytest.mark.parametrize("name", NUMPIES)
def test_of_numpy_only_what_runs_is_taken_and_its_licence(name, folder):
    (folder / name).write_bytes(NUMPIES[name])
    found = parts.pyodide_parts(folder)
    assert {key: found[key] for key in parts.CORE_FILES} == CORE
    assert zipfile.ZipFile(io.BytesIO(found[parts.NUMPY_FILE])).namelist() == [
        "numpy-2.dist-info/LICENSE.txt", "numpy/__init__.py",
    ]  # fmt: skip


def test_packages_of_npm_are_looked_into(folder):
    (folder / CONDA).write_bytes(NUMPIES[CONDA])
    loose = parts.pyodide_parts(folder)
    for path in list(folder.iterdir()):
        path.unlink()
    (folder / "pyodide-0.27.7.tgz").write_bytes(tar_of({f"package/{name}": each for name, each in CORE.items()}))
    (folder / "emscripten-forge-numpy-2.0.1.tgz").write_bytes(tar_of({f"package/pkg/{CONDA}": NUMPIES[CONDA]}))
    assert parts.pyodide_parts(folder) == loose


def test_a_numpy_is_known_by_the_list_of_pyodide(folder, monkeypatch):
    (folder / WHEEL).write_bytes(NUMPIES[WHEEL])
    monkeypatch.setattr(parts, "KNOWN_SUMS", {name: known for name, known in parts.KNOWN_SUMS.items() if name != WHEEL})
    assert parts.NUMPY_FILE in parts.pyodide_parts(folder)
    (folder / WHEEL).write_bytes(stored_zip({"numpy/__init__.py": b"other"}))
    with pytest.raises(TaskError, match=f"the SHA-256 of {WHEEL} is '.*{LISTED['sha256']}.*{parts.SUMS_FILE}"):
        parts.pyodide_parts(folder)


def test_what_is_not_known_needs_a_sum_of_the_users_own(folder):
    (folder / CONDA).write_bytes(NUMPIES[CONDA])
    (folder / parts.BINARY_FILE).write_bytes(b"newer")
    with pytest.raises(
        TaskError,
        match=rf"SHA-256 of {parts.BINARY_FILE} is '{sum_of(b'newer')}'.*{parts.KNOWN_SUMS[parts.BINARY_FILE]}",
    ):
        parts.pyodide_parts(folder)
    (folder / parts.SUMS_FILE).write_text(
        f"{sum_of(b'newer').upper()} *{parts.BINARY_FILE}\n\nnonsense\n", encoding="utf-8"
    )
    assert parts.pyodide_parts(folder)[parts.BINARY_FILE] == b"newer"
    (folder / parts.BINARY_FILE).write_bytes(b"newest")
    with pytest.raises(TaskError, match=parts.BINARY_FILE):
        parts.pyodide_parts(folder)


def test_what_is_missing_is_named_with_the_command_that_brings_it(folder):
    with pytest.raises(
        TaskError, match=r"there is no file numpy-\S* or \S* for Python 3\.12\.7 in .*npm pack pyodide@"
    ):
        parts.pyodide_parts(folder)
    (folder / "numpy-2.2.0-cp313-cp313-pyodide_2025_0_wasm32.whl").write_bytes(b"")
    with pytest.raises(TaskError, match="there is no file numpy-"):
        parts.pyodide_parts(folder)
    for name in NUMPIES:
        (folder / name).write_bytes(NUMPIES[name])
    with pytest.raises(TaskError, match=r"NumPy is .*remove the others"):
        parts.pyodide_parts(folder)
    (folder / parts.GLUE_FILE).unlink()
    with pytest.raises(TaskError, match=rf"there is no file {parts.GLUE_FILE} in "):
        parts.pyodide_parts(folder)
    with pytest.raises(TaskError, match=r"there is no file pyodide\.js in .*elsewhere; run there: npm"):
        parts.pyodide_parts(folder / "elsewhere")


def test_a_package_that_is_cut_off_is_told(folder):
    (folder / "pyodide.tgz").write_bytes(NUMPIES[CONDA][:50])
    with pytest.raises(TaskError, match="not readable"):
        parts.pyodide_parts(folder)


def test_the_sums_that_are_known_stand_in_the_how_to():
    page = Path(__file__).parents[2] / "notebooks/site/pages/how-to/put-the-studio-on-a-course-page.md"
    told = dict(re.findall(r"^\| `(\S+)` \| `(\w{64})` \|$", page.read_text(encoding="utf-8"), re.MULTILINE))
    assert told == dict(parts.KNOWN_SUMS)
